"""Roads that turn back on themselves, as roundabouts do, cut into stretches that one axis can serve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from ..map_records import MapLine

LARGEST_TURN = np.radians(120.0)
"""A road that turns by more is cut."""

STRETCH_TURN = np.radians(70.0)
"""Each stretch turns by so much at the most."""

SHORTEST = 1.0
"""Shorter ends of lines in a stretch are left out, m."""


def unwound_roads(axis: np.ndarray,
                  chains: Sequence[Sequence[MapLine]]) -> list[tuple[np.ndarray, list[list[MapLine]]]]:
    """The axis (n, 2) of a road and its lines by chain, cut where the axis has turned by `STRETCH_TURN`.

    Each line is cut where the axis' nearest place changes from one stretch to the next. A road that does not turn
    back comes back whole.
    """
    plan = shapely.LineString(axis).simplify(0.3)
    coarse = shapely.get_coordinates(plan)
    heading = np.unwrap(np.arctan2(*np.diff(coarse, axis=0).T[::-1]))
    if np.ptp(heading) <= LARGEST_TURN:
        return [(axis, [list(chain) for chain in chains])]
    line = shapely.LineString(axis)
    at = shapely.line_locate_point(line, shapely.points(coarse[1:-1]))
    turned = np.floor(np.abs(heading - heading[0]) / STRETCH_TURN)
    cuts = [0.0, *at[np.flatnonzero(np.diff(turned) != 0)], line.length]
    unwound = []
    for begin, end in zip(cuts[:-1], cuts[1:]):
        if end - begin < SHORTEST:
            continue
        chain_parts = [[part for one in chain for part in _within(one, line, begin, end)] for chain in chains]
        where = np.unique(np.concatenate([np.arange(begin, end, 1.0), [end]]))
        places = shapely.get_coordinates(shapely.line_interpolate_point(line, where))
        unwound.append((places, [parts for parts in chain_parts if parts]))
    return unwound


def _within(line: MapLine, axis: shapely.LineString, begin: float, end: float) -> list[MapLine]:
    """The parts of a line whose nearest place on the axis lies between two chainages."""
    steps = np.linalg.norm(np.diff(line.points[:, :2], axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    fine = np.unique(np.concatenate([at, np.arange(0.0, at[-1], 0.1)]))
    points = np.column_stack([np.interp(fine, at, column) for column in line.points.T])
    chainage = shapely.line_locate_point(axis, shapely.points(points[:, :2]))
    inside = (chainage >= begin) & (chainage <= end)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], inside.astype(np.int8), [0]]))).reshape(-1, 2)
    parts = []
    for first, last in edges:
        rows = sorted({first, last - 1, *np.arange(first, last, 5)})
        if fine[last - 1] - fine[first] >= SHORTEST:
            parts.append(replace(line, points=points[rows]))
    return parts
