"""Owners of the points that can be building: by class where it can be trusted, else by height."""

from __future__ import annotations

import numpy as np

from ...io.points.point_buckets import stable_order
from ...settings.buildings import SegmentationParameters
from ..point_assignment import Assignment, assign_points
from ..unclassified_roofs import unclassified_roof_points
from .evidence import BUILDING_CLASS
from .segmented_buildings import MIN_ROOF_POINTS

_NOT_BUILDING = (2, 3, 4, 5, 9, 11, 17)
"""LAS classes that are never roofs: ground, vegetation, water, road surface, bridge deck."""

_MIN_CLASSED_SHARE = 0.2
"""Class 6 is trusted for a building where it holds at least this share of its high points."""


def assign_candidates(x: np.ndarray, y: np.ndarray, z: np.ndarray, classes: np.ndarray, above: np.ndarray,
                      several: np.ndarray, outlines: np.ndarray, parameters: SegmentationParameters) -> Assignment:
    """Owners of the points that can be building.

    Parameters
    ----------
    x, y, z, above : (n,) m; `above` the ground.
    classes : (n,) of LAS.
    several : (n,) whether the pulse had several returns.
    outlines : (k,) where the buildings stand.
    """
    owner = np.full(len(x), -1, np.int64)
    primary = np.zeros(len(x), bool)
    open_to_all = np.ones(256, bool)
    open_to_all[[*_NOT_BUILDING, BUILDING_CLASS]] = False
    high = np.flatnonzero(open_to_all[classes] & ~(above < parameters.minimum_height))

    def assign(candidates: np.ndarray, wanted: np.ndarray) -> Assignment:
        found = assign_points(x[candidates], y[candidates], z[candidates], wanted, parameters.expansion)
        taken = found.owner >= 0
        owner[candidates[taken]], primary[candidates[taken]] = found.owner[taken], found.primary[taken]
        return found

    classed = np.flatnonzero(classes == BUILDING_CLASS)
    if not len(classed):
        assign(high, outlines)
        return Assignment(owner, primary & (owner >= 0))
    found = assign(classed, outlines)
    others = assign_points(x[high], y[high], np.zeros(len(high)), outlines, 0.0)
    trusted = _trusted_classes(found, others, len(outlines))
    owner[(owner >= 0) & ~trusted[owner]] = -1
    other_rows, found_rows = (_rows_by_owner(claims.owner, len(outlines)) for claims in (others, found))
    for row in np.flatnonzero(trusted):
        mine, known = high[other_rows[row]], classed[found_rows[row]]
        density = np.count_nonzero(found.primary[found_rows[row]]) / outlines[row].area
        roof = mine[unclassified_roof_points(x[mine], y[mine], z[mine], several[mine], x[known], y[known],
                                             outlines[row], max(density, 0.1))]
        owner[roof], primary[roof] = row, True
    assign(high, np.where(trusted, None, outlines))
    return Assignment(owner, primary & (owner >= 0))


def _rows_by_owner(owner: np.ndarray, count: int) -> list[np.ndarray]:
    """Ascending numbers of the points of each of `count` buildings; `owner` (n,) is -1 where there is none."""
    order = stable_order(owner + 1)
    ends = np.cumsum(np.bincount(owner + 1, minlength=count + 1))
    return [order[start:end] for start, end in zip(ends, ends[1:])]


def _trusted_classes(found: Assignment, others: Assignment, count: int) -> np.ndarray:
    """Mask of the buildings whose class 6 points (`found`) describe them: enough, and not few beside the `others`."""
    classed = np.bincount(found.owner[found.primary & (found.owner >= 0)], minlength=count)
    unclassed = np.bincount(others.owner[others.owner >= 0], minlength=count)
    return (classed >= MIN_ROOF_POINTS) & (classed >= _MIN_CLASSED_SHARE * (classed + unclassed))
