"""Roof edges by an iterative Hough transform over ordered boundary points (J 5.3.3, step 3)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ...wording import say

ANGLE_STEP = 1.0
"""Degrees between the directions of the accumulator; the line found is then fitted to its points."""

MIN_SEQUENCE = 3
"""Boundary points that a sequence on a line needs to be an edge: of fewer the first and last are all there is, and
both stay as possible corners (J 5.3.3, step 3)."""


@dataclass(frozen=True)
class BoundaryLine:
    """One detected edge of a boundary.

    Parameters
    ----------
    point, direction : (2,) a point of the line and its unit direction, along the order of the boundary.
    first, last : indices of the first and last boundary points of its sequence (J's first and last points).
    count : points in the sequence, both ends included.
    """

    point: np.ndarray
    direction: np.ndarray
    first: int
    last: int
    count: int

    def project(self, xy: np.ndarray) -> np.ndarray:
        """Perpendicular image of a point (2,) on the line."""
        return self.point + self.direction * float(np.dot(np.asarray(xy) - self.point, self.direction))


class HoughAccumulator:
    """Votes of points over direction and distance, kept up to date while points are removed.

    Parameters
    ----------
    xy : (n, 2) metres, near the origin.
    bin_width : metres; a line takes the votes of two neighbouring bins.
    """

    def __init__(self, xy: np.ndarray, bin_width: float):
        angles = np.radians(np.arange(0.0, 180.0, ANGLE_STEP))
        self.normals = np.stack([np.cos(angles), np.sin(angles)])
        rho = xy @ self.normals
        self.columns = math.ceil(2.0 * np.abs(rho).max() / bin_width) + 3
        bins = np.floor(rho / bin_width).astype(np.int64) + self.columns // 2
        self.cells = bins + np.arange(len(angles)) * self.columns
        self.size = len(angles) * self.columns
        self.votes = self._count(self.cells)
        self.weights = np.ones(self.size - 1)

    def _count(self, cells: np.ndarray) -> np.ndarray:
        return np.bincount(cells.ravel(), minlength=self.size)

    def remove(self, points: np.ndarray) -> None:
        """Take back the votes of points, given by index or mask."""
        self.votes -= self._count(self.cells[points])

    def best(self) -> tuple[int, int]:
        """Cell with most votes together with its neighbour (so that no bin edge splits a line), and votes."""
        pairs = self.votes[:-1] + self.votes[1:]
        cell = int(np.argmax(pairs * self.weights))
        return cell, int(pairs[cell]) if self.weights[cell] > 0 else 0

    def members(self, cell: int) -> np.ndarray:
        """Mask of the points that vote for the pair of bins starting at the cell."""
        voted = self.cells[:, cell // self.columns]
        return (voted == cell) | (voted == cell + 1)

    def discard(self, cell: int) -> None:
        """Never propose this cell again."""
        self.weights[cell] = 0.0


def hough_lines(boundary_xy: np.ndarray, min_points: int = 5, distance: float = 0.3) -> list[BoundaryLine]:
    """Edges of a closed boundary, in the order of detection (J 5.3.3: best line first).

    Repeats: the best line of the Hough transform; on it the sequences of consecutive boundary points nearer
    than `distance` (circular order); from each an edge, whose points leave the boundary except its first and
    last, which may be corners of two edges. Ends when no line has `min_points`: n is asked of the line, not of
    each sequence on it.

    Parameters
    ----------
    boundary_xy : (n, 2) ordered points of a ring in metres, the first not repeated.
    min_points : J's n, the fewest points of a detected line.
    distance : J's d in metres.
    """
    xy = np.asarray(boundary_xy, float)
    if min_points < 3:
        raise InputError(say("A detected line needs at least three boundary points."))
    if not distance > 0:
        raise InputError(say("The distance of boundary points to their line must be above zero metres."))
    if len(xy) < min_points:
        return []
    centre = xy.mean(axis=0)
    local = xy - centre
    accumulator = HoughAccumulator(local, distance)
    remaining = np.ones(len(xy), bool)
    lines = []
    while True:
        cell, votes = accumulator.best()
        if votes < min_points:
            return lines
        found = _edges_on_line(local, remaining, accumulator.members(cell), distance)
        if not found:
            accumulator.discard(cell)
            continue
        for point, direction, run in found:
            lines.append(BoundaryLine(point + centre, direction, int(run[0]), int(run[-1]), len(run)))
            inner = run[1:-1]
            inner = inner[remaining[inner]]
            remaining[inner] = False
            accumulator.remove(inner)


def _edges_on_line(xy: np.ndarray, remaining: np.ndarray, voters: np.ndarray,
                   distance: float) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Point, direction and sequence of each edge on the line of the voters; none if no sequence is long enough."""
    point, direction = fit_line(xy[voters & remaining])
    runs = _sequences(remaining & (_distances(xy, point, direction) < distance))
    if not runs:
        return []
    point, direction = fit_line(xy[np.concatenate(runs)])
    return [(point, direction if np.dot(xy[run[-1]] - xy[run[0]], direction) >= 0 else -direction, run)
            for run in runs]


def _distances(xy: np.ndarray, point: np.ndarray, direction: np.ndarray) -> np.ndarray:
    relative = xy - point
    return np.abs(relative[:, 0] * direction[1] - relative[:, 1] * direction[0])


def _sequences(near: np.ndarray) -> list[np.ndarray]:
    """Index arrays of the circular runs of True with at least `MIN_SEQUENCE` members."""
    n = len(near)
    if near.all():
        return [np.arange(n)]
    shift = int(np.argmin(near))  # start counting at a gap, so that no run crosses the end of the array
    turned = np.concatenate([[0], np.roll(near, -shift).astype(np.int8), [0]])
    steps = np.diff(turned)
    begin, end = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)
    return [(np.arange(b, e) + shift) % n for b, e in zip(begin, end) if e - b >= MIN_SEQUENCE]


def fit_line(xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean point and unit direction of the total least squares line through points (n, 2)."""
    centre = xy.mean(axis=0)
    dx, dy = (xy - centre).T
    angle = 0.5 * math.atan2(2.0 * float(dx @ dy), float(dx @ dx) - float(dy @ dy))
    return centre, np.array([math.cos(angle), math.sin(angle)])
