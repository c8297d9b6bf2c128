"""How markings are taken out of a survey, and what is then known of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ...settings.mobile import ReachRules
from ...settings.terrain import ClothSettings
from ...terrain.cloth import JAVANMARDI
from .intensity_calibration import IntensityCurve
from .lasers import LaserGains
from .marking_points import MarkingPointSettings
from .plain_threshold import PlainThreshold
from .records import MarkingPoints

CALIBRATED, WEIGHT = "calibrated_intensity", "marking_weight"
"""Names of the attributes that marking points get."""


@dataclass(frozen=True)
class ExtractionSettings(ReachRules):
    """How markings are taken out of a survey.

    Parameters
    ----------
    marking : how points are told.
    cloth : the ground filter, where the points are not classified.
    plain : the paper's threshold, which then tells them instead.
    """

    marking: MarkingPointSettings = field(default_factory=MarkingPointSettings)
    cloth: ClothSettings = JAVANMARDI
    plain: PlainThreshold | None = None


DEFAULTS = ExtractionSettings()


@dataclass(frozen=True)
class Extraction:
    """The marking points of a survey, in the order of its files.

    Attributes
    ----------
    points : with their times in the trajectory's time.
    number : (m,) their numbers in the files, from 0.
    intensity : (m,) float32, calibrated: asphalt has `reference`.
    contrast : (m,) float32, intensity over that of the ground beside.
    curves : of each scanner, by the least of its point source ids (0 where all ids are taken together).
    failed : why a scanner has no curve, by point source id; its points are left out.
    reference : I_ref of J eq. 4.
    read, outside, standing, near, ground, in_range : points read; at times without a place of the vehicle; left out
        because the vehicle stood; within range; on the ground; of these within R2 of a curve.
    ground_method : "classes" or "cloth".
    marked_share : share of the units of path (20 m) with marking points.
    height_scatter : m, of ground points within 20 cm.
    lasers : of scanners of many lasers, what their intensities were freed of.
    """

    points: MarkingPoints
    number: np.ndarray
    intensity: np.ndarray
    contrast: np.ndarray
    curves: Mapping[int, IntensityCurve]
    failed: Mapping[int, str]
    reference: float
    read: int
    outside: int
    standing: int
    near: int
    ground: int
    in_range: int
    ground_method: str
    marked_share: float
    height_scatter: float
    lasers: Mapping[int, LaserGains] = field(default_factory=dict)
