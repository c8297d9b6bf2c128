"""Owners of the points that can be building: by class where it can be trusted, else by height and surface."""

from __future__ import annotations

import numpy as np

from ...settings.buildings import SegmentationParameters
from ..detection.roof_regions import roof_density
from ..detection.roof_surfaces import roof_odds
from ..point_assignment import Assignment, assign_points
from .evidence import BUILDING_CLASS
from .segmented_buildings import MIN_ROOF_POINTS

_NOT_BUILDING = (2, 3, 4, 5, 9, 11, 17)
"""LAS classes that are never roofs: ground, vegetation, water, road surface, bridge deck."""

_MIN_CLASSED_SHARE = 0.2
"""Class 6 is trusted for a building where it holds at least this share of its high points."""


def assign_candidates(x: np.ndarray, y: np.ndarray, z: np.ndarray, classes: np.ndarray, above: np.ndarray,
                      last: np.ndarray, outlines: np.ndarray, parameters: SegmentationParameters
                      ) -> tuple[Assignment, np.ndarray]:
    """Owners of the points that can be building; mask (k,) of outlines that hold trees and no building.

    Parameters
    ----------
    x, y, z, above : (n,) m; `above` the ground.
    classes : (n,) of LAS.
    last : (n,) whether each is the last echo of its pulse.
    outlines : (k,) where the buildings stand.
    """
    owner = np.full(len(x), -1, np.int64)
    primary = np.zeros(len(x), bool)
    open_to_all = np.ones(256, bool)
    open_to_all[[*_NOT_BUILDING, BUILDING_CLASS]] = False
    high = np.flatnonzero(open_to_all[classes] & ~(above < parameters.minimum_height))
    if not len(high):
        roof = np.zeros(0, bool)
    else:
        place = np.column_stack([x, y, z])[high] - [x[0], y[0], 0.0]
        roof = roof_odds(place, last[high], not last.all(), roof_density(x[last], y[last])) > 0
    inside = assign_points(x[high], y[high], np.zeros(len(high)), outlines, 0.0).owner

    def assign(candidates: np.ndarray, wanted: np.ndarray) -> Assignment:
        found = assign_points(x[candidates], y[candidates], z[candidates], wanted, parameters.expansion)
        taken = found.owner >= 0
        owner[candidates[taken]], primary[candidates[taken]] = found.owner[taken], found.primary[taken]
        return found

    found = assign(np.flatnonzero(classes == BUILDING_CLASS), outlines)
    trusted = _trusted_classes(found, inside[roof], len(outlines))
    owner[(owner >= 0) & ~trusted[owner]] = -1
    left_out = roof & (inside >= 0) & trusted[inside]  # roofs that the classification does not know
    owner[high[left_out]], primary[high[left_out]] = inside[left_out], True
    trees = ~trusted & _mostly_crowns(inside[last[high]], roof[last[high]], len(outlines))
    assign(high[roof], np.where(trusted | trees, None, outlines))
    return Assignment(owner, primary & (owner >= 0)), trees


def _mostly_crowns(inside: np.ndarray, roof: np.ndarray, count: int) -> np.ndarray:
    """Mask (k,) of outlines of whose high last echoes, outline `inside` (n,) each, the more part is no roof."""
    inside, roof = inside[inside >= 0], roof[inside >= 0]
    return np.bincount(inside, roof, count) < np.bincount(inside, minlength=count) / 2.0


def _trusted_classes(found: Assignment, others: np.ndarray, count: int) -> np.ndarray:
    """Mask of the buildings whose class 6 points (`found`) describe them: enough, and not few beside the other roof
    points, `others` (n,) by their outline."""
    classed = np.bincount(found.owner[found.primary & (found.owner >= 0)], minlength=count)
    unclassed = np.bincount(others[others >= 0], minlength=count)
    return (classed >= MIN_ROOF_POINTS) & (classed >= _MIN_CLASSED_SHARE * (classed + unclassed))
