"""What a place is good for, in words, and why nothing can be said of some."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...wording import mark
from ..ellipses import PlanEllipse
from ..localisation_settings import LocalisationSettings

GOOD, USABLE, POOR, NONE = mark("good"), mark("usable"), mark("poor"), mark("none")
"""Classes of a place by the standard deviation of its weakest direction; "none" where nothing fixes it."""

INSIDE = "inside a building"
TUNNEL = "in a tunnel"
BELOW = "below the ground"
OUTSIDE = "outside the building models"
NO_HEIGHT = "no height of the road or of the buildings is known"
HEIGHTS_DIFFER = "heights of the road and of the buildings differ"
MARKING_HEIGHTS_DIFFER = "heights of the road and of the markings differ"

_WEAK = 0.7
"""Share of what was known before that a direction keeps where the map tells nothing of it."""


@dataclass(frozen=True)
class SourceSigns:
    """What is known of n places besides their covariances.

    Attributes
    ----------
    refused : (n,) why nothing can be said, empty where something can.
    points, walls : (n,) seen on walls.
    left_out : (n,) buildings without heights within range.
    has_walls, has_markings, has_satellites : whether the source was given.
    marking_samples : (n,).
    other_level : (n,) whether markings lie too high or low.
    fixed : (n,) whether satellites fix a position.
    alias_share, alias_distance : (n,), 0 and NaN where there is none.
    """

    refused: np.ndarray
    points: np.ndarray
    walls: np.ndarray
    left_out: np.ndarray
    has_walls: bool
    has_markings: bool
    has_satellites: bool
    marking_samples: np.ndarray
    other_level: np.ndarray
    fixed: np.ndarray
    alias_share: np.ndarray
    alias_distance: np.ndarray


def undetermined_directions(ellipse: PlanEllipse, settings: LocalisationSettings) -> np.ndarray:
    """(n,) number of axes of each ellipse that keep what was known before, 0 to 2; NaN where nothing can be said."""
    weak = _WEAK * settings.start_sigma
    return np.where(np.isfinite(ellipse.major), (ellipse.major > weak) + 1.0 * (ellipse.minor > weak), np.nan)


def place_classes(ellipse: PlanEllipse, signs: SourceSigns, settings: LocalisationSettings) -> np.ndarray:
    """(n,) class of each place; one that repeats, or keeps in a direction what was known before, is poor."""
    major = ellipse.major
    kind = np.where(major <= settings.good, GOOD, np.where(major <= settings.usable, USABLE, POOR)).astype(object)
    kind[(signs.alias_share >= settings.alias_share) | (major > _WEAK * settings.start_sigma)] = POOR
    kind[~np.isfinite(major)] = NONE
    return kind


def place_words(along: np.ndarray, across: np.ndarray, signs: SourceSigns, settings: LocalisationSettings
                ) -> np.ndarray:
    """(n,) status of each place in words: why it is none, or what is weak, or "ok"."""
    words = np.empty(len(along), object)
    weak = _WEAK * settings.start_sigma
    for row in range(len(along)):
        if signs.refused[row]:
            words[row] = signs.refused[row]
            continue
        found = _missing(row, signs, settings)
        if np.isfinite(along[row]):
            found += _weak(along[row] > weak, across[row] > weak)
        if signs.alias_share[row] >= settings.alias_share:
            found.append(f"repeats every {signs.alias_distance[row]:.0f} m")
        words[row] = ", ".join(found) or "ok"
    return words


def _missing(row: int, signs: SourceSigns, settings: LocalisationSettings) -> list[str]:
    found = []
    if signs.left_out[row]:
        found.append(f"{signs.left_out[row]} buildings without heights left out")
    if signs.has_walls and not signs.points[row]:
        found.append("no walls within range")
    elif signs.has_walls and signs.points[row] < settings.min_points:
        found.append("few points on walls")
    if signs.has_markings and not signs.marking_samples[row]:
        found.append(MARKING_HEIGHTS_DIFFER if signs.other_level[row] else "no markings within sight")
    if signs.has_satellites and not signs.fixed[row]:
        found.append("no position by satellites")
    return found


def _weak(along: bool, across: bool) -> list[str]:
    if along and across:
        return ["fixed in no direction"]
    return ["slides along the street"] if along else ["slides across the street"] if across else []
