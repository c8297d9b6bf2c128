"""Crosswalks that the lines of a road run past: rows of other paint that only look like one (J 6.2)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ..map_records import MapArea, MapLine

PARALLEL = np.cos(np.radians(15.0))
BEFORE = 2.0
"""A line runs past where it goes on for so long before and behind, m."""

BESIDE = (0.5, 12.0)
"""Lines so far from the crosswalk's ends are of the same road, m."""

FEW = 2
"""Solid lines that may run past on one side, as kerb and the edge of the pavement do beside a true crosswalk."""


def without_passed(crosswalks: Sequence[MapArea], lines: Sequence[MapLine]) -> list[MapArea]:
    """The crosswalks without those past which a dashed line, or more than `FEW` solid ones on one side, run on.

    Lines of lanes end before a crosswalk, which reaches over the whole road. Arrows in a row, hatching and shadows of
    poles look like a short one within it.
    """
    plans = [shapely.LineString(line.points[:, :2]) for line in lines]
    tree = shapely.STRtree(plans)
    return [area for area in crosswalks if not _is_passed(area, lines, plans, tree)]


def _is_passed(area: MapArea, lines: Sequence[MapLine], plans: Sequence[shapely.LineString],
               tree: shapely.STRtree) -> bool:
    outline = shapely.get_coordinates(area.polygon)
    middle, along = outline.mean(axis=0), area.heading
    across = np.array([-along[1], along[0]])
    reach = np.abs((outline - middle) @ along).max() + BEFORE
    half = np.abs((outline - middle) @ across).max()
    solid = {1: 0, -1: 0}
    for number in tree.query(area.polygon, predicate="dwithin", distance=BESIDE[1]):
        offset = _offset_past(plans[number], middle, along, across, reach)
        if not half + BESIDE[0] < abs(offset) < half + BESIDE[1]:
            continue
        if lines[number].kind == "dashed":
            return True
        solid[int(np.sign(offset))] += lines[number].kind == "solid"
    return max(solid.values()) > FEW


def _offset_past(line: shapely.LineString, middle: np.ndarray, along: np.ndarray, across: np.ndarray,
                 reach: float) -> float:
    """Offset (m to the left) at which a line passes a place for `reach` m to both sides; NaN if it does not."""
    points = shapely.get_coordinates(line) - middle
    at, offset = points @ along, points @ across
    if at[0] > at[-1]:
        at, offset = at[::-1], offset[::-1]
    if at[0] > -reach or at[-1] < reach or (np.diff(at) <= 0).any():
        return np.nan
    ends = np.interp([-reach, reach], at, offset)
    if 2 * reach < PARALLEL * np.hypot(2 * reach, ends[1] - ends[0]):
        return np.nan
    return float(np.interp(0.0, at, offset))
