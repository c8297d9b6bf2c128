"""Segments that may divide a plan among planes: intersections first, then height steps, then outline directions."""

from __future__ import annotations

import numpy as np
import shapely

from ..polygons.partition_lines import LabelBoundaries, edge_rows, inward_walls, label_boundaries
from .label_raster import LabelRaster
from .step_lines import building_directions, step_lines

LEAST_BEND = 0.07
"""Difference of two planes' slopes below which they have no useful intersection (about 4 degrees)."""

LEAST_LENGTH = 1.0
"""Metres of common border that make a segment."""

EXTENSION = 30.0
"""Metres by which segments are drawn longer than the border they come from."""

MERGE = 0.3
"""Parallel lines nearer than this (m) are one; the intersection of planes stays, else the stronger one."""

PARALLEL = np.sin(np.radians(5.0))
MOST_WALLS = 12


def candidate_segments(raster: LabelRaster, planes: np.ndarray, outline: shapely.Geometry, points: np.ndarray,
                       label: np.ndarray) -> np.ndarray:
    """Segments (m, 2, 2) in plan, m, coordinates as the raster's.

    Parameters
    ----------
    planes : (k, 3) a, b, c of z = a x + b y + c. points, label : (n, 3) and (n,), to place steps exactly.
    """
    cracks = label_boundaries(raster.label, raster.x, raster.y)
    reach = 1.5 * raster.cell + 0.2
    lines, ends, explained = _intersections(cracks, planes, raster.cell, reach)
    rest = LabelBoundaries(cracks.xy[~explained], cracks.left[~explained], cracks.right[~explained])
    normals = building_directions(edge_rows(outline)[:, 2:], planes)
    for line, along in step_lines(rest, normals, raster.cell, LEAST_LENGTH, points[:, :2], label):
        _add(lines, ends, line, along)
    bounds = outline.bounds
    whole = float(np.hypot(bounds[2] - bounds[0], bounds[3] - bounds[1])) + 1.0
    for line in inward_walls(outline, LEAST_LENGTH)[:MOST_WALLS]:
        _add(lines, ends, line, _around(line, bounds, whole))
    return _segments(lines, ends)


def _intersections(cracks: LabelBoundaries, planes: np.ndarray, cell: float, reach: float):
    """Lines and extents where planes meet at equal height beside their common border; which cracks lie there."""
    count = len(planes)
    low, high = np.minimum(cracks.left, cracks.right), np.maximum(cracks.left, cracks.right)
    code = low * count + high
    explained = np.zeros(len(code), bool)
    lines: list[tuple] = []
    ends: list[list[float]] = []
    for pair in np.unique(code).tolist():
        one, two = divmod(pair, count)
        difference = planes[one] - planes[two]
        bend = float(np.hypot(difference[0], difference[1]))
        if bend < LEAST_BEND:
            continue
        line = (difference[0] / bend, difference[1] / bend, -difference[2] / bend)
        members = np.flatnonzero(code == pair)
        near = members[np.abs(cracks.xy[members] @ np.array(line[:2]) - line[2]) < reach]
        if len(near) * cell < LEAST_LENGTH:
            continue
        explained[near] = True
        along = cracks.xy[near] @ np.array([-line[1], line[0]])
        lines.append(line)
        ends.append([float(along.min()), float(along.max())])
    return lines, ends, explained


def _around(line: tuple, bounds: tuple, reach: float) -> list[float]:
    """Places along a line that span the whole plan."""
    middle = np.array([bounds[0] + bounds[2], bounds[1] + bounds[3]]) / 2
    centre = float(middle @ np.array([-line[1], line[0]]))
    return [centre - reach, centre + reach]


def _add(lines: list, ends: list, line: tuple, along: list[float]) -> None:
    """Add a line, or lengthen the one that it lies on."""
    for place, (mx, my, other) in enumerate(lines):
        dot = line[0] * mx + line[1] * my
        if abs(line[0] * my - line[1] * mx) < PARALLEL:
            sign = 1.0 if dot > 0 else -1.0
            middle = np.array(line[:2]) * line[2] + np.array([-line[1], line[0]]) * (along[0] + along[1]) / 2
            if abs(middle @ np.array([mx, my]) - other) < MERGE:
                start, end = sorted((sign * along[0], sign * along[1]))
                ends[place] = [min(ends[place][0], start), max(ends[place][1], end)]
                return
    lines.append(line)
    ends.append(list(along))


def _segments(lines: list, ends: list) -> np.ndarray:
    """Ends (m, 2, 2) of the segments, drawn longer."""
    if not lines:
        return np.zeros((0, 2, 2))
    line, along = np.array(lines), np.array(ends)
    normal = line[:, :2]
    direction = np.column_stack([-normal[:, 1], normal[:, 0]])
    foot = normal * line[:, 2:]
    return np.stack([foot + direction * (along[:, :1] - EXTENSION), foot + direction * (along[:, 1:] + EXTENSION)],
                    axis=1)
