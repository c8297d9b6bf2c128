"""Faces that segments cut out of an outline, and the plane of each by a graph cut."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ..polygons.plan_arrangement import GRID, ring_segments
from .alpha_expansion import expand_labels
from .label_raster import LabelRaster

SMOOTHNESS = 0.13
"""Cubic metres of misfit that a metre of border between two planes is worth."""

LEVEL_FAVOUR = 0.5
"""A border where two planes meet at equal height costs this share of one with a step."""

FULL_STEP = 0.3
"""Step (m) from which a border costs all."""

CAP = 2.0
"""Heights farther off (m) cost no more: what lies there is not this roof."""

UNSEEN_WEIGHT = 0.3
"""Weight of a cell without points, which tells the plane of its nearest neighbour."""

CLEARANCE = 0.3
"""A roof more than this (m) above the highest point near it is not seen."""

EXCESS_WEIGHT = 2.0
"""Cost (m3) of a square metre of roof that stands a metre too high."""


@dataclass(frozen=True)
class PlanFaces:
    """Polygons (n,) without overlap that fill the outline; pairs (m, 2) of neighbours, their common borders' lengths
    (m,), m, and their ends (m, 2, 2), the longest piece of each."""

    polygons: np.ndarray
    pairs: np.ndarray
    length: np.ndarray
    border: np.ndarray


def plan_faces(outline: shapely.Geometry, segments: np.ndarray) -> PlanFaces:
    """Cut an outline by segments (m, 2, 2); loose ends cut nothing."""
    network = shapely.union_all(np.append(shapely.linestrings(segments), shapely.boundary(outline)), grid_size=GRID)
    pieces = shapely.get_parts(shapely.polygonize([network]))
    inside = shapely.get_coordinates(shapely.point_on_surface(pieces))
    shapely.prepare(outline)
    pieces = pieces[shapely.contains_xy(outline, inside[:, 0], inside[:, 1])]
    xy, start, end, piece = ring_segments(pieces)
    key = np.minimum(start, end) * len(xy) + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    twins = np.flatnonzero(key[order[1:]] == key[order[:-1]])
    one, two = order[twins], order[twins + 1]
    ends = np.stack([xy[start[one]], xy[end[one]]], axis=1)
    pairs = np.sort(np.column_stack([piece[one], piece[two]]), axis=1)
    return PlanFaces(pieces, pairs, np.hypot(*(ends[:, 1] - ends[:, 0]).T), ends)


def label_faces(faces: PlanFaces, raster: LabelRaster, planes: np.ndarray, points: np.ndarray, label: np.ndarray,
                smoothness: float = SMOOTHNESS) -> tuple[np.ndarray, np.ndarray]:
    """Plane (n,) of each face, and the cost (n, k) of each plane in it.

    Parameters
    ----------
    planes : (k, 3). points, label : (n, 3) and (n,); those without a plane (-1) do not count.
    """
    data = _data_costs(faces, raster, planes, points, label)
    one, two = planes[:, None, :], planes[None, :, :]
    difference = (one - two).reshape(-1, 3)
    ends = faces.border.reshape(-1, 2)
    step = np.abs(ends @ difference[:, :2].T + difference[:, 2]).reshape(len(faces.pairs), 2, len(planes), len(planes))
    share = np.clip(step.mean(axis=1) / FULL_STEP, LEVEL_FAVOUR, 1.0)
    share[:, np.arange(len(planes)), np.arange(len(planes))] = 0.0
    cost = smoothness * faces.length[:, None, None] * share
    return expand_labels(data, faces.pairs, cost, data.argmin(axis=1)), data


def _data_costs(faces: PlanFaces, raster: LabelRaster, planes: np.ndarray, points: np.ndarray,
                label: np.ndarray) -> np.ndarray:
    """Cubic metres (n, k) between the points and each plane, over each face."""
    tree = shapely.STRtree(faces.polygons)
    count, _k, area = len(faces.polygons), len(planes), raster.cell**2
    own = label >= 0
    p = points[own]
    off = np.minimum(np.abs(p[:, 2:] - (p[:, :2] @ planes[:, :2].T + planes[:, 2])), CAP)
    column = np.searchsorted(raster.x + raster.cell / 2, p[:, 0])
    row = np.searchsorted(-raster.y + raster.cell / 2, -p[:, 1])
    cell = row * len(raster.x) + column
    weight = area / np.bincount(cell, minlength=raster.label.size + len(raster.x) + 1)[cell]
    data = _summed(tree, count, p[:, :2], off * weight[:, None])

    row, column = np.nonzero(raster.inside)
    xy = np.column_stack([raster.x[column], raster.y[row]])
    height = xy @ planes[:, :2].T + planes[:, 2]
    shown = height[np.arange(len(xy)), raster.label[row, column]]
    unseen = ~raster.seen[row, column]
    cost = np.where(unseen[:, None], np.minimum(np.abs(height - shown[:, None]), CAP) * UNSEEN_WEIGHT, 0.0)
    ceiling = raster.ceiling[row, column]
    cost += EXCESS_WEIGHT * np.clip(height - ceiling[:, None] - CLEARANCE, 0.0, 3.0)
    low, high = seen_heights(planes, points, label, raster.cell)
    cost += EXCESS_WEIGHT * np.clip(np.maximum(height - high, low - height), 0.0, 3.0)
    return data + _summed(tree, count, xy, cost * area)


def seen_heights(planes: np.ndarray, points: np.ndarray, label: np.ndarray,
                 spacing: float) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest height (k,) at which each plane is seen, with what `CLEARANCE` and the `spacing` of points
    leave open: no plane is drawn on to where it was not seen. One without points is free."""
    own = label >= 0
    low, high = np.full(len(planes), np.inf), np.full(len(planes), -np.inf)
    np.minimum.at(low, label[own], points[own, 2])
    np.maximum.at(high, label[own], points[own, 2])
    reach = CLEARANCE + spacing * np.hypot(planes[:, 0], planes[:, 1])
    return (np.where(np.isfinite(low), low - reach, -np.inf), np.where(np.isfinite(high), high + reach, np.inf))


def _summed(tree: shapely.STRtree, count: int, xy: np.ndarray, value: np.ndarray) -> np.ndarray:
    """Sum (count, k) over the places (n, 2) in each polygon of their values (n, k)."""
    place, face = tree.query(shapely.points(xy), predicate="intersects")
    return np.column_stack([np.bincount(face, column, count) for column in value[place].T])
