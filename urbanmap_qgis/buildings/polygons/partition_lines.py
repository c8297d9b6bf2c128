"""Candidate lines along which a building's plan may be divided among its roofs (after J 5.3.3, step 3).

Where two roofs meet, the label raster has a boundary between two cells. A Hough transform over the boundaries proposes
straight lines, which are turned into the building's main directions where that fits.
Walls of the outline that end at an inward corner, drawn on into the building, are candidates too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from ...geometry.polygon_rings import polygon_rings
from .hough_lines import HoughAccumulator, fit_line
from .regularisation import main_directions

EDGE_PARALLEL = np.sin(np.radians(4.0))
"""Sine of the angle below which a line counts as parallel to an outline edge."""

ANGLE_STEP = 3.0
"""Degrees between the directions that are tried; the fit to the boundaries does the rest."""
MAIN_WEIGHT = 1.3
"""Votes in a main direction count so much more: two walls with a small step make a good oblique line, too."""
MAX_FAILURES = 20
"""Directions and places in vain after which the rest of the boundaries counts as noise."""
MIN_SIDE, MIN_FILL = 1.2, 0.7
"""Least side in metres, and share of its rectangle that a region must fill, to be enclosed by four lines."""
MAX_WALL_LINES = 12
"""At most this many walls, the longest, are drawn on into the building."""


@dataclass(frozen=True)
class LabelBoundaries:
    """Where cells of different roofs meet: middle points (n, 2) in metres, and both roofs (n,)."""

    xy: np.ndarray
    left: np.ndarray
    right: np.ndarray


def label_boundaries(labels: np.ndarray, x: np.ndarray, y: np.ndarray) -> LabelBoundaries:
    """LabelBoundaries of a label raster; cells of -1 lie outside and make none. x (columns,), y (rows,): centres."""
    row, column = np.nonzero((labels[:, 1:] != labels[:, :-1]) & (labels[:, 1:] >= 0) & (labels[:, :-1] >= 0))
    down, across = np.nonzero((labels[1:] != labels[:-1]) & (labels[1:] >= 0) & (labels[:-1] >= 0))
    xy = np.concatenate([np.column_stack([0.5 * (x[column] + x[column + 1]), y[row]]),
                         np.column_stack([x[across], 0.5 * (y[down] + y[down + 1])])])
    return LabelBoundaries(xy, np.concatenate([labels[row, column], labels[down, across]]),
                  np.concatenate([labels[row, column + 1], labels[down + 1, across]]))


@dataclass(frozen=True)
class RoofPoints:
    """Points (n, 2) in metres with the roof of each (n,), to place lines finer than cells can."""

    xy: np.ndarray
    roof: np.ndarray


def candidate_lines(boundaries: LabelBoundaries, outline: shapely.Geometry, cell: float, min_length: float,
                    merge: float, max_lines: int, points: RoofPoints | None = None) -> np.ndarray:
    """Lines as rows (nx, ny, offset): points p of a line have n . p = offset, n a unit normal.

    Parameters
    ----------
    boundaries : of the label raster, coordinates near the origin.
    outline : Polygon or MultiPolygon in the same coordinates; lines within `merge` metres of one of its parallel edges
        become that edge's own line, so that steps of the roof follow steps of the plan.
    cell : raster cell in metres.
    min_length : metres of boundaries that a line needs without a gap.
    merge : metres; parallel lines nearer than this are one.
    max_lines : strongest first.
    points : shifts each line to where it separates them best.
    """
    edges = edge_rows(outline)
    main = (main_directions(edges[:, 2:])[:, None] + np.array([0.0, 90.0])).ravel() % 180.0
    lines = []
    for members in _collect(boundaries.xy, cell, main, min_length, max_lines):
        line = _fitted(boundaries.xy[members], main, cell)
        if points is not None:
            line = _shifted_to_points(line, boundaries.xy[members], points, 1.5 * cell)
        lines.append(line)
    return _merged(_snapped(lines, edges, merge) + inward_walls(outline, min_length)[:MAX_WALL_LINES], merge)


def with_enclosing_lines(lines: np.ndarray, regions: list[np.ndarray], outline: shapely.Geometry, cell: float,
                         merge: float) -> np.ndarray:
    """Lines and, for each region that is about a rectangle in the first main direction, its four sides.

    For roofs too small to gather votes. regions: cell centres (n, 2) of each.
    """
    edges = edge_rows(outline)
    axes = main_axes(outline)
    sides = []
    for xy in regions:
        low, high = np.percentile(xy @ axes.T, [3.0, 97.0], axis=0)
        low, high = low - 0.5 * cell, high + 0.5 * cell
        if (high - low).min() >= MIN_SIDE and len(xy) * cell ** 2 >= MIN_FILL * np.prod(high - low):
            sides += [(*axis, offset) for axis, ends in zip(axes, zip(low, high)) for offset in ends]
    return _merged(list(map(tuple, lines.tolist())) + _snapped(sides, edges, merge), merge)


def main_axes(outline: shapely.Geometry) -> np.ndarray:
    """The first main direction of an outline and the one across it, unit vectors as rows (2, 2)."""
    angle = np.radians(main_directions(edge_rows(outline)[:, 2:])[0])
    return np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])


def edge_rows(outline: shapely.Geometry) -> np.ndarray:
    """Edges as rows (x, y, dx, dy)."""
    xy, ring = shapely.get_coordinates(polygon_rings(shapely.get_parts(outline))[0], return_index=True)
    same = ring[1:] == ring[:-1]
    return np.column_stack([xy[:-1], np.diff(xy, axis=0)])[same]


def inward_walls(outline: shapely.Geometry, min_length: float) -> list[tuple[float, float, float]]:
    """Lines of the walls of at least `min_length` that end at an inward corner, the longest first."""
    rings = shapely.get_rings([orient(part) for part in shapely.get_parts(outline)])
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


def _collect(xy: np.ndarray, cell: float, main: np.ndarray, min_length: float,
             max_lines: int) -> list[np.ndarray]:
    """Boundary numbers of each line, the strongest line first; `main`: favoured directions, degrees."""
    if len(xy) == 0:
        return []
    normals = np.concatenate([main, (main[0] + np.arange(ANGLE_STEP, 180.0, ANGLE_STEP)) % 180.0])
    weight = np.where(np.arange(len(normals)) < len(main), MAIN_WEIGHT, 1.0)
    accumulator = HoughAccumulator(xy, cell, normals, weight)
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
        lines.append(members)
        left[members] = False
        accumulator.remove(members)
    return lines


def _fitted(xy: np.ndarray, main: np.ndarray, cell: float) -> tuple[float, float, float]:
    """Line through boundaries, in a main direction where that moves no end by more than a cell."""
    centre, direction = fit_line(xy)
    normals = np.radians(main)
    normals = np.column_stack([np.cos(normals), np.sin(normals)])
    slant = np.abs(normals @ direction)
    best = int(np.argmin(slant))
    along = (xy - centre) @ direction
    if slant[best] * 0.5 * (along.max() - along.min()) <= cell:
        normal = normals[best]
    else:
        normal = np.array([-direction[1], direction[0]])
    return float(normal[0]), float(normal[1]), float(centre @ normal)


def _shifted_to_points(line: tuple[float, float, float], boundaries: np.ndarray, points: RoofPoints,
             reach: float) -> tuple[float, float, float]:
    """The line moved within `reach` to where the most points lie on the side of their roof."""
    normal, offset = np.array(line[:2]), line[2]
    direction = np.array([-normal[1], normal[0]])
    along, across = points.xy @ direction, points.xy @ normal - offset
    place = boundaries @ direction
    near = (np.abs(across) < 2.0 * reach) & (along > place.min()) & (along < place.max())
    across, roof = across[near], points.roof[near]
    below, above = roof[across < -0.5 * reach], roof[across > 0.5 * reach]
    if len(below) < 3 or len(above) < 3:
        return line
    low, high = np.bincount(below).argmax(), np.bincount(above).argmax()
    use = (np.abs(across) < reach) & ((roof == low) | (roof == high))
    if low == high or use.sum() < 3:
        return line
    order = np.argsort(across[use], kind="stable")
    sorted_across = across[use][order]
    gain = np.concatenate([[0], np.cumsum(np.where(roof[use][order] == low, 1, -1))])
    best = np.flatnonzero(gain == gain.max())
    bounds = np.concatenate([[-reach], sorted_across, [reach]])
    return line[0], line[1], offset + float(0.5 * np.mean(bounds[best] + bounds[best + 1]))


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
    distinct: list[tuple[float, float, float]] = []
    for nx, ny, offset in lines:
        for mx, my, other in distinct:
            dot = nx * mx + ny * my
            if abs(nx * my - ny * mx) < EDGE_PARALLEL and abs(offset - np.sign(dot) * other) < merge:
                break
        else:
            distinct.append((nx, ny, offset))
    return np.array(distinct).reshape(-1, 3)
