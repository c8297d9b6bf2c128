"""Segments that may divide a plan among planes: intersections first, then height steps, then outline directions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import cv2
import numpy as np
import shapely

from ..polygons.partition_lines import LabelBoundaries, edge_rows, inward_walls, label_boundaries, main_axes
from .label_raster import LabelRaster
from .plan_faces import expected_faces
from .step_lines import building_directions, cracks_by_pair, step_lines

# Difference of two planes' slopes below which they have no useful intersection (about 4 degrees).
LEAST_BEND = 0.07
LEAST_LENGTH = 1.0  # Metres of common border that make a segment.
# Metres by which segments are drawn on beyond the place where one of their two planes ends: the first of these that
# cuts no more than about `many_faces` faces, or the last.
EXTENSIONS = 6.0, 3.0, 1.5
MANY_FACES = 8_000.0
# Parallel lines nearer than this (m) are one; the intersection of planes stays, else the stronger one.
MERGE = 0.3
MOST_WALLS = 12
OVERHANG = 1.0  # Metres by which the sides of a patch's rectangle are drawn on.

PARALLEL = np.sin(np.radians(5.0))


def candidate_segments(raster: LabelRaster, planes: np.ndarray, outline: shapely.Geometry, points: np.ndarray,
                       label: np.ndarray, enclosed: Sequence[int] = ()) -> np.ndarray:
    """Segments (m, 2, 2) in plan, m, coordinates as the raster's.

    Parameters
    ----------
    planes : (k, 3) a, b, c of z = a x + b y + c.
    points, label : (n, 3) and (n,), to place steps exactly.
    enclosed : planes of small patches, which get a rectangle each.
    """
    cracks = label_boundaries(raster.label, raster.x, raster.y)
    reach = 1.5 * raster.cell + 0.2
    drawn = _Segments(_plane_corners(raster, len(planes)))
    explained = _intersections(drawn, cracks, planes, raster.cell, reach)
    rest = LabelBoundaries(cracks.xy[~explained], cracks.left[~explained], cracks.right[~explained])
    normals = building_directions(edge_rows(outline)[:, 2:], planes)
    for line, along, pair in step_lines(rest, normals, raster.cell, LEAST_LENGTH, points[:, :2], label):
        drawn.add(line, drawn.reach(line, along, pair), True)
    for line, along in _rectangles(raster, main_axes(outline) if len(enclosed) else np.zeros((0, 2)), enclosed):
        drawn.add(line, along)
    bounds = outline.bounds
    whole = float(np.hypot(bounds[2] - bounds[0], bounds[3] - bounds[1])) + 1.0
    for line in inward_walls(outline, LEAST_LENGTH)[:MOST_WALLS]:
        drawn.add(line, _around(line, bounds, whole))
    segments = drawn.ends(EXTENSIONS[0])
    for extension in EXTENSIONS[1:]:
        if expected_faces(outline, segments) <= MANY_FACES:
            break
        segments = drawn.ends(extension)
    return segments


def _plane_corners(raster: LabelRaster, count: int) -> list[np.ndarray]:
    """Corners (c, 2) of the hull of the cells that show each plane."""
    row, column = np.nonzero(raster.inside)
    label = raster.label[row, column]
    order = np.argsort(label, kind="stable")
    ends = np.cumsum(np.bincount(label, minlength=count))
    corners = []
    for members in np.split(order, ends[:-1]):
        cells = np.column_stack([column[members], row[members]]).astype(np.int32)
        hull = cv2.convexHull(cells).reshape(-1, 2) if len(cells) else cells
        corners.append(np.column_stack([raster.x[hull[:, 0]], raster.y[hull[:, 1]]]))
    return corners


def _intersections(drawn: _Segments, cracks: LabelBoundaries, planes: np.ndarray, cell: float,
                   reach: float) -> np.ndarray:
    """Draw lines where planes meet at equal height beside their common border; which cracks (n,) lie there."""
    explained = np.zeros(len(cracks.left), bool)
    for one, two, members in cracks_by_pair(cracks, len(planes)):
        difference = planes[one] - planes[two]
        bend = float(np.hypot(difference[0], difference[1]))
        if bend < LEAST_BEND:
            continue
        line = (difference[0] / bend, difference[1] / bend, -difference[2] / bend)
        near = members[np.abs(cracks.xy[members] @ np.array(line[:2]) - line[2]) < reach]
        if len(near) * cell < LEAST_LENGTH:
            continue
        explained[near] = True
        along = cracks.xy[near] @ np.array([-line[1], line[0]])
        drawn.add(line, drawn.reach(line, (float(along.min()), float(along.max())), (one, two)), True)
    return explained


def _rectangles(raster: LabelRaster, axes: np.ndarray, enclosed: Sequence[int]) -> Iterator[tuple[tuple, list[float]]]:
    """Sides of the rectangle about the cells of each plane of `enclosed`, along the axes (2, 2), with their ends."""
    for plane in enclosed:
        row, column = np.nonzero(raster.label == plane)
        ends = np.column_stack([raster.x[column], raster.y[row]]) @ axes.T
        low, high = ends.min(axis=0) - raster.cell / 2, ends.max(axis=0) + raster.cell / 2
        # Along (-ny, nx): the second axis runs so for the first, the first the other way for the second.
        for offset in (low[0], high[0]):
            yield (*axes[0], offset), [low[1] - OVERHANG, high[1] + OVERHANG]
        for offset in (low[1], high[1]):
            yield (*axes[1], offset), [-high[0] - OVERHANG, -low[0] + OVERHANG]


def _around(line: tuple, bounds: tuple, reach: float) -> list[float]:
    """Places along a line that span the whole plan."""
    middle = np.array([bounds[0] + bounds[2], bounds[1] + bounds[3]]) / 2
    centre = float(middle @ np.array([-line[1], line[0]]))
    return [centre - reach, centre + reach]


class _Segments:
    """Lines (nx, ny, offset) with the first and last place along (-ny, nx), and whether they are to be drawn on; no two
    of them on each other."""

    def __init__(self, corners: list[np.ndarray]):
        self.corners = corners
        self.rows = np.zeros((64, 6))
        self.count = 0

    def reach(self, line: tuple, along: tuple[float, float], pair: tuple[int, int]) -> list[float]:
        """Places where a line ends that was seen between two places, not drawn on: where one of its two planes does."""
        direction = np.array([-line[1], line[0]])
        spans = [self.corners[plane] @ direction for plane in pair if len(self.corners[plane])]
        low = max((float(span.min()) for span in spans), default=along[0])
        high = min((float(span.max()) for span in spans), default=along[1])
        return [min(along[0], low), max(along[1], high)]

    def add(self, line: tuple, along: list[float], drawn_on: bool = False) -> None:
        """Add a line, or lengthen the one that it lies on."""
        rows = self.rows[:self.count]
        turned = rows[:, 0] * line[0] + rows[:, 1] * line[1]
        middle = np.array(line[:2]) * line[2] + np.array([-line[1], line[0]]) * (along[0] + along[1]) / 2
        start, end = np.where(turned > 0, along[0], -along[1]), np.where(turned > 0, along[1], -along[0])
        on = np.abs(line[0] * rows[:, 1] - line[1] * rows[:, 0]) < PARALLEL
        on &= np.abs(rows[:, :2] @ middle - rows[:, 2]) < MERGE
        if on.any():
            place = int(np.argmax(on))
            self.rows[place, 3:] = (min(rows[place, 3], start[place]), max(rows[place, 4], end[place]),
                                    max(rows[place, 5], drawn_on))
            return
        if self.count == len(self.rows):
            self.rows = np.concatenate([self.rows, np.zeros_like(self.rows)])
        self.rows[self.count] = *line, *along, drawn_on
        self.count += 1

    def ends(self, extension: float) -> np.ndarray:
        """Ends (m, 2, 2) of the segments, drawn on by `extension` (m) at both where they are to be."""
        normal, offset, along, drawn_on = np.split(self.rows[:self.count], [2, 3, 5], axis=1)
        along = along + drawn_on * np.array([-extension, extension])
        direction = np.column_stack([-normal[:, 1], normal[:, 0]])
        foot = normal * offset
        return np.stack([foot + direction * along[:, :1], foot + direction * along[:, 1:]], axis=1)
