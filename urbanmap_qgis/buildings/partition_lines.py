"""Candidate lines along which a building's plan may be divided among its roofs (after J 5.3.3, step 3).

Where two roofs meet, the label raster has a crack between two cells. A Hough transform over the cracks, first
in the building's main directions only, then in all directions for what is left, proposes straight lines.
Walls of the outline that end at an inward corner, drawn on into the building, are candidates too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from .hough_lines import HoughAccumulator, fit_line
from .regularisation import main_directions

EDGE_PARALLEL = np.sin(np.radians(4.0))
"""Sine of the angle below which a line counts as parallel to an outline edge."""

MAX_FAILURES = 20
"""Directions and places in vain after which the rest of the cracks counts as noise."""
MAX_WALL_LINES = 12
"""At most this many walls, the longest, are drawn on into the building."""


@dataclass(frozen=True)
class Cracks:
    """Where cells of different roofs meet: middle points (n, 2) in metres, and both roofs (n,)."""

    xy: np.ndarray
    left: np.ndarray
    right: np.ndarray


def find_cracks(labels: np.ndarray, x: np.ndarray, y: np.ndarray) -> Cracks:
    """Cracks of a label raster; cells of -1 lie outside and make none. x (columns,), y (rows,): centres."""
    row, column = np.nonzero((labels[:, 1:] != labels[:, :-1]) & (labels[:, 1:] >= 0) & (labels[:, :-1] >= 0))
    down, across = np.nonzero((labels[1:] != labels[:-1]) & (labels[1:] >= 0) & (labels[:-1] >= 0))
    xy = np.concatenate([np.column_stack([0.5 * (x[column] + x[column + 1]), y[row]]),
                         np.column_stack([x[across], 0.5 * (y[down] + y[down + 1])])])
    return Cracks(xy, np.concatenate([labels[row, column], labels[down, across]]),
                  np.concatenate([labels[row, column + 1], labels[down + 1, across]]))


def candidate_lines(cracks: Cracks, outline: shapely.Geometry, cell: float, min_length: float,
                    merge: float, max_lines: int) -> np.ndarray:
    """Lines as rows (nx, ny, offset): points p of a line have n . p = offset, n a unit normal.

    Parameters
    ----------
    cracks : of the label raster, coordinates near the origin.
    outline : Polygon or MultiPolygon in the same coordinates; lines within `merge` metres of one of its
        parallel edges become that edge's own line, so that steps of the roof follow steps of the plan.
    cell : raster cell in metres. min_length : metres of cracks that a line needs without a gap.
    merge : metres; parallel lines nearer than this are one.
    max_lines : strongest first.
    """
    edges = _outline_edges(outline)
    directions = main_directions(edges[:, 2:])
    normals = (directions[:, None] + np.array([0.0, 90.0])).ravel() % 180.0
    remaining = np.ones(len(cracks.xy), bool)
    lines = _collect(cracks.xy, remaining, cell, normals, min_length, max_lines)
    if remaining.sum() * cell > 2.0 * min_length:
        lines += _collect(cracks.xy, remaining, cell, None, 2.0 * min_length, max_lines - len(lines))
    return _merged(_snapped(lines, edges, merge) + _inward_walls(outline, min_length)[:MAX_WALL_LINES], merge)


def _outline_edges(outline: shapely.Geometry) -> np.ndarray:
    """Edges as rows (x, y, dx, dy)."""
    xy, ring = shapely.get_coordinates(shapely.get_rings(shapely.get_parts(outline)), return_index=True)
    same = ring[1:] == ring[:-1]
    return np.column_stack([xy[:-1], np.diff(xy, axis=0)])[same]


def _inward_walls(outline: shapely.Geometry, min_length: float) -> list[tuple[float, float, float]]:
    """Lines of the walls of at least `min_length` that end at an inward corner, the longest first."""
    rings = shapely.get_rings(shapely.get_parts(shapely.orient_polygons(outline)))
    found = []
    for ring in rings:
        xy = shapely.get_coordinates(ring)[:-1]
        edge = np.roll(xy, -1, axis=0) - xy
        length = np.hypot(edge[:, 0], edge[:, 1])
        before = np.roll(edge, 1, axis=0)
        bend = before[:, 0] * edge[:, 1] - before[:, 1] * edge[:, 0]
        inward = bend < -np.sin(np.radians(30.0)) * length * np.roll(length, 1)
        for i in np.flatnonzero((inward | np.roll(inward, -1)) & (length >= min_length)):
            normal = np.array([-edge[i, 1], edge[i, 0]]) / length[i]
            found.append((float(length[i]), (*normal, float(normal @ xy[i]))))
    return [line for _, line in sorted(found, reverse=True)]


def _collect(xy: np.ndarray, remaining: np.ndarray, cell: float, normals: np.ndarray | None,
             min_length: float, max_lines: int) -> list[tuple[float, float, float]]:
    """Strongest lines one after another; their cracks leave `remaining` (changed in place)."""
    index = np.flatnonzero(remaining)
    if len(index) == 0:
        return []
    xy = xy[index]
    accumulator = HoughAccumulator(xy, cell, normals)
    left = np.ones(len(xy), bool)
    least = max(3, int(min_length / cell))
    lines = []
    failures = 0
    while len(lines) < max_lines and failures < MAX_FAILURES:
        cell_of_line, votes = accumulator.best()
        if votes < least:
            break
        normal = accumulator.normal(cell_of_line)
        members = np.flatnonzero(accumulator.members(cell_of_line) & left)
        along = xy[members] @ np.array([-normal[1], normal[0]])
        members = members[_in_long_runs(along, 3.0 * cell, min_length)]
        if len(members) < least:
            failures += 1
            accumulator.discard(cell_of_line)
            continue
        if normals is None:
            _, direction = fit_line(xy[members])
            normal = np.array([-direction[1], direction[0]])
        lines.append((*normal, float(np.mean(xy[members] @ normal))))
        left[members] = False
        accumulator.remove(members)
    remaining[index[~left]] = False
    return lines


def _in_long_runs(along: np.ndarray, gap: float, min_length: float) -> np.ndarray:
    """Mask of the positions along a line that belong to runs without gaps, at least `min_length` long."""
    order = np.argsort(along, kind="stable")
    run = np.concatenate([[0], np.cumsum(np.diff(along[order]) > gap)])
    bounds = np.flatnonzero(np.diff(np.concatenate([[-1], run, [run[-1] + 1]])))
    length = along[order[bounds[1:] - 1]] - along[order[bounds[:-1]]]
    result = np.zeros(len(along), bool)
    result[order] = (length >= min_length)[run]
    return result


def _snapped(lines: list[tuple[float, float, float]], edges: np.ndarray, tolerance: float) -> list:
    """Lines that run near a parallel outline edge's line become it exactly."""
    if not lines:
        return lines
    length = np.hypot(edges[:, 2], edges[:, 3])
    edges, length = edges[length > 0.5], length[length > 0.5]
    normal = np.column_stack([-edges[:, 3], edges[:, 2]]) / length[:, None]
    middle = edges[:, :2] + 0.5 * edges[:, 2:]
    result = []
    for nx, ny, offset in lines:
        parallel = np.abs(normal[:, 0] * ny - normal[:, 1] * nx) < EDGE_PARALLEL
        gap = np.where(parallel, np.abs(middle @ np.array([nx, ny]) - offset), np.inf)
        best = int(np.argmin(gap)) if len(gap) else 0
        if len(gap) and gap[best] < tolerance:
            sign = 1.0 if normal[best] @ (nx, ny) > 0 else -1.0
            nx, ny = sign * normal[best]
            offset = sign * float(normal[best] @ edges[best, :2])
        result.append((nx, ny, offset))
    return result


def _merged(lines: list[tuple[float, float, float]], merge: float) -> np.ndarray:
    """Drop lines that are parallel to a stronger one and nearer than `merge` to it."""
    kept: list[tuple[float, float, float]] = []
    for nx, ny, offset in lines:
        for mx, my, other in kept:
            dot = nx * mx + ny * my
            if abs(nx * my - ny * mx) < EDGE_PARALLEL and abs(offset - np.sign(dot) * other) < merge:
                break
        else:
            kept.append((nx, ny, offset))
    return np.array(kept).reshape(-1, 3)
