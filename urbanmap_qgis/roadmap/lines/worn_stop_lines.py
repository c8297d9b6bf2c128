"""Worn stop lines: paint across the road as far before a crosswalk as the sure ones of the map lie."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from .arrow_places import usual_values
from .crosswalks import Crosswalk
from .line_chains import StrokeChain
from .strokes import Stroke


@dataclass(frozen=True)
class WornStopLinesLimits:
    """Limits of worn stop lines, each with its unit."""

    # So many sure ones at one distance before crosswalks, to so much (m), make it a usual one; others lie so near (m)
    # to it.
    fewest: int = 3
    same: float = 0.2
    around: float = 0.3
    step: float = 0.1  # m between the distances that are looked at
    square: float = 0.1  # Cosine between them and the bars.
    farthest: float = 7.0  # Stop lines belong to a crosswalk so far ahead, m.
    beyond: float = 1.0  # They may reach so far beyond its bars, m.
    slice: float = 0.1  # Their place is looked at in slices of this length, m,
    across: tuple[float, ...] = (-0.3, -0.1, 0.1, 0.3)  # at these parts of their width,
    filled: float = 0.5  # of which so many must be painted.
    # Painted slices are one stop line with so much between them (m); it is so long (m) and has so much paint at least.
    gap: float = 1.2
    shortest: float = 1.4
    painted: float = 0.5


LIMITS = WornStopLinesLimits()


def worn_stop_lines(sure: Sequence[StrokeChain], crosswalks: Sequence[Crosswalk], strokes: Sequence[Stroke],
                    free: Sequence[int], paint: shapely.STRtree) -> list[StrokeChain]:
    """Stop lines in pieces, also narrow or slanting ones, where several sure ones show how far before a crosswalk.

    Parameters
    ----------
    sure : stop lines that show by themselves.
    free : numbers of the strokes that may be pieces.
    paint : tree over the polygons of white paint.
    """
    bars = [shapely.LineString(bar.axis) for bar in sure]
    apart = [shapely.distance(bar, row.area) for bar in bars for row in crosswalks
             if bar.distance(row.area) < LIMITS.farthest and abs(_course(bar) @ row.direction) < LIMITS.square]
    usual = usual_values(np.array(apart), LIMITS.same, LIMITS.fewest)
    if not usual:
        return []
    width = float(np.median([bar.width for bar in sure]))
    middles = shapely.STRtree([shapely.Point(strokes[n].axis.mean(axis=0)) for n in free])
    known, found = shapely.union_all(bars).buffer(1.0), []
    for row in crosswalks:
        for axis in _bands(row, usual[0], width, paint):
            band = shapely.LineString(axis)
            others = [other.area for other in crosswalks if other is not row]
            if band.intersects(known) or any(band.intersects(area) for area in others):
                continue
            own = [free[k] for k in middles.query(band, predicate="dwithin", distance=width)]
            if own:
                found.append(StrokeChain(axis, own, min(sum(strokes[n].length for n in own), band.length), width))
    return found


def _course(line: shapely.LineString) -> np.ndarray:
    ends = shapely.get_coordinates(line)
    return (ends[-1] - ends[0]) / max(line.length, LEAST_DIVISOR)


def _bands(row: Crosswalk, distance: float, width: float, paint: shapely.STRtree) -> list[np.ndarray]:
    """Axes (2, 2) of painted stretches at a distance before a crosswalk, on both of its sides."""
    corners = shapely.get_coordinates(row.area.exterior)[:4]
    sides = (corners[[0, 1]], corners[[3, 2]])
    found = []
    for edge, away in ((sides[0], sides[0].mean(axis=0) - sides[1].mean(axis=0)),
                       (sides[1], sides[1].mean(axis=0) - sides[0].mean(axis=0))):
        length = float(np.linalg.norm(edge[1] - edge[0]))
        along = (edge[1] - edge[0]) / length
        out = np.array([-along[1], along[0]])
        out = out if out @ away > 0.0 else -out
        at = np.arange(-LIMITS.beyond, length + LIMITS.beyond, LIMITS.slice) + LIMITS.slice / 2.0
        profiles = []
        for off in distance + np.arange(-LIMITS.around, LIMITS.around + LIMITS.step / 2.0, LIMITS.step):
            xy = edge[0] + at[:, None, None] * along + (off + np.array(LIMITS.across) * width)[:, None] * out
            share = _painted(xy.reshape(-1, 2), paint).reshape(len(at), -1).mean(axis=1)
            profiles.append((int((share >= LIMITS.filled).sum()), float(share.sum()), off, share >= LIMITS.filled))
        _, _, off, there = max(profiles, key=lambda one: one[:2])
        for first, last in _runs(there):
            if there[first:last].mean() >= LIMITS.painted and (last - first) * LIMITS.slice >= LIMITS.shortest:
                ends = at[[first, last - 1]] + np.array([-0.5, 0.5]) * LIMITS.slice
                found.append(edge[0] + ends[:, None] * along + off * out)
    return found


def _painted(xy: np.ndarray, paint: shapely.STRtree) -> np.ndarray:
    """Mask (n,) of the places (n, 2) in paint."""
    at, _ = paint.query(shapely.points(xy), predicate="intersects")
    return np.isin(np.arange(len(xy)), at)


def _runs(there: np.ndarray) -> list[tuple[int, int]]:
    """First and past the last slice of runs of painted ones with short gaps."""
    at = np.flatnonzero(there)
    if not len(at):
        return []
    cut = np.flatnonzero(np.diff(at) > LIMITS.gap / LIMITS.slice)
    return [(int(run[0]), int(run[-1]) + 1) for run in np.split(at, cut + 1)]
