"""Main directions of a building, and outlines made parallel and square to them where the data say so."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from ...errors import InputError
from ...wording import say
from .hough_lines import fit_line

PARALLEL = np.sin(np.radians(3.0))
"""Sine of the angle below which neighbouring walls count as parallel."""
DIRECTION_WIDTH = 4.0
"""Degrees; edges within this of a main direction support it."""
SECOND_DIRECTION_SHARE = 0.25
"""Share of the edges' length that a further main direction needs."""
SNAP_ANGLE, FREE_EDGE = 12.0, 3.0
"""Edges nearer to a main direction (degrees) are turned into it; shorter ones (m) from twice as far, because their
direction is little known. Longer ones than twice that keep their own."""
STRAIGHT_SHARE = 0.6
"""Share of the length that straight walls must make, else the outline is curved."""


def main_directions(edges: np.ndarray) -> np.ndarray:
    """Main directions of edges in degrees from the x axis, 0 to 90, the strongest first.

    A direction stands for itself and its perpendicular. Length decides; a second and third direction are
    given where at least `SECOND_DIRECTION_SHARE` of the length follows them and not the ones before.

    Parameters
    ----------
    edges : (n, 2) edge vectors in metres.
    """
    length = np.hypot(edges[:, 0], edges[:, 1])
    angle = np.degrees(np.arctan2(edges[:, 1].copy(), edges[:, 0].copy())) % 90.0
    total = length.sum()
    free = length > 0
    found: list[float] = []
    while len(found) < 3 and free.any():
        deviation = (angle[:, None] - angle[None, free] + 45.0) % 90.0 - 45.0
        support = np.where(np.abs(deviation) < DIRECTION_WIDTH, length[free], 0.0).sum(axis=1) * free
        best = int(np.argmax(support))
        if found and support[best] < SECOND_DIRECTION_SHARE * total:
            break
        difference = (angle - angle[best] + 45.0) % 90.0 - 45.0
        near = free & (np.abs(difference) < DIRECTION_WIDTH)
        # the squared lengths let the long walls, which are drawn best, decide the last tenth of a degree
        mean = angle[best] + np.average(difference[near], weights=length[near] ** 2)
        found.append(float(mean % 90.0))
        free &= np.abs((angle - mean + 45.0) % 90.0 - 45.0) >= DIRECTION_WIDTH
    return np.array(found)


@dataclass(eq=False)
class _Edge:
    """A wall while the ring is worked on: unit direction, offset along its left normal, points that support it."""

    direction: np.ndarray
    points: np.ndarray
    offset: float = 0.0

    @property
    def normal(self) -> np.ndarray:
        return np.array([-self.direction[1], self.direction[0]])

    def fit(self) -> None:
        self.offset = float(np.mean(self.points @ self.normal))


def regularise_ring(boundary_xy: np.ndarray, tolerance: float,
                    outward: Callable[[np.ndarray, np.ndarray], float] | None = None) -> tuple[np.ndarray, bool, float]:
    """Straight walls through ordered boundary points, parallel and square to the main directions where they fit.

    Parameters
    ----------
    boundary_xy : (n, 2) ordered points of a counterclockwise ring, open, metres.
    tolerance : metres that the outline may move; about the spacing of the points it comes from.
    outward : metres by which a wall lies outside its boundary points, from two ends (2,) of the wall; the ring
        shrinks because no point lies exactly on the roof's edge (J 5.5).

    Returns
    -------
    Corners (n, 2) of the ring, open, counterclockwise as the points given; whether it is curved; the root mean square
    distance of the boundary points to it, metres. Where straight walls leave the points by more than the tolerance, or
    too many directions are needed, it is the simplified ring, and curved.
    """
    xy = np.asarray(boundary_xy, float)
    if len(xy) < 4:
        raise InputError(say("An outline needs at least four boundary points to be regularised."))
    centre = xy.mean(axis=0)
    local = xy - centre
    start = int(np.argmax(np.hypot(local[:, 0], local[:, 1])))  # a corner: simplification keeps its first point
    local = np.roll(local, -start, axis=0)
    corners = _corner_indices(local, tolerance)
    edges = _edges(local, corners, np.diff(local[np.append(corners, 0)], axis=0))
    if edges is not None:
        for edge in edges:
            edge.fit()
        edges = _joined(edges, tolerance)
    if edges is not None and len(edges) >= 4:
        ring = _corners(edges, outward, centre)
        fitted = shapely.LinearRing(_corners(edges, None, centre))
        rms, far = _deviation(fitted, local)
        if far <= 2.0 * tolerance and fitted.is_valid and shapely.Polygon(ring).is_valid:
            return ring + centre, False, rms
    simple = _simplified(local, tolerance, outward, centre)
    rms, _ = _deviation(shapely.LinearRing(local[corners]), local)
    return simple + centre, True, rms


def _corner_indices(ring: np.ndarray, tolerance: float) -> np.ndarray:
    """Indices of the points that a simplification (Douglas and Peucker) of the ring keeps."""
    corners = shapely.get_coordinates(shapely.simplify(shapely.LinearRing(ring), tolerance, preserve_topology=True))
    codes = ring[:, 0] + 1j * ring[:, 1]
    return np.flatnonzero(np.isin(codes, corners[:, 0] + 1j * corners[:, 1]))


def _edges(ring: np.ndarray, corners: np.ndarray, vectors: np.ndarray) -> list[_Edge] | None:
    """One edge between two corners each, turned into a main direction where near; None where curved."""
    closed = np.vstack([ring, ring[:1]])
    ends = np.append(corners[1:], len(ring))
    points = [closed[a:b + 1] for a, b in zip(corners, ends)]
    length = np.hypot(vectors[:, 0], vectors[:, 1])
    fitted = np.array([_direction(p, v) for p, v in zip(points, vectors)])
    main = main_directions(fitted * length[:, None])
    angle = np.degrees(np.arctan2(fitted[:, 1].copy(), fitted[:, 0].copy()))
    deviation = (angle[:, None] - main[None, :] + 45.0) % 90.0 - 45.0
    nearest = deviation[np.arange(len(deviation)), np.argmin(np.abs(deviation), axis=1)]
    straight = (np.abs(nearest) < SNAP_ANGLE) | (length > 2.0 * FREE_EDGE)
    if length[straight].sum() < STRAIGHT_SHARE * length.sum():
        return None
    limit = np.where(length < FREE_EDGE, 2.0, 1.0) * SNAP_ANGLE
    turn = np.where(np.abs(nearest) < limit, nearest, 0.0)
    final = np.radians(angle - turn)
    return [_Edge(np.array([np.cos(a), np.sin(a)]), _inner(p)) for a, p in zip(final, points)]


def _inner(points: np.ndarray) -> np.ndarray:
    """Points of an edge without its two corners, which pull it inwards, where others are left."""
    return points[1:-1] if len(points) > 4 else points


def _direction(points: np.ndarray, along: np.ndarray) -> np.ndarray:
    _, direction = fit_line(_inner(points))
    return direction if direction @ along >= 0 else -direction


def _joined(edges: list[_Edge], tolerance: float) -> list[_Edge] | None:
    """Edges after joining parallel neighbours, with connectors at steps."""
    for _ in range(4 * len(edges)):
        if not _join_once(edges, tolerance):
            return edges
        if len(edges) < 4:
            return None
    return None


def _join_once(edges: list[_Edge], tolerance: float) -> bool:
    """Join or step the first pair of parallel neighbours; True if the list changed."""
    for i in range(len(edges)):
        one, two = edges[i], edges[(i + 1) % len(edges)]
        if abs(one.direction[0] * two.direction[1] - one.direction[1] * two.direction[0]) > PARALLEL:
            continue
        same_sense = one.direction @ two.direction > 0
        if same_sense and abs(one.offset - two.offset) >= tolerance:
            side = 1.0 if two.offset > one.offset else -1.0
            middle = 0.5 * (one.points[-1] + two.points[0])
            step = _Edge(side * one.normal, middle[None, :])
            step.fit()
            edges.insert(i + 1, step)
        elif same_sense:
            one.points = np.vstack([one.points, two.points])
            one.fit()
            edges.remove(two)
        else:  # a spike: the longer side stays
            edges.remove(one if len(one.points) < len(two.points) else two)
        return True
    return False


def _corners(edges: list[_Edge], outward: Callable | None, centre: np.ndarray) -> np.ndarray:
    """Corner i is where edge i - 1 and edge i meet."""
    normal = np.array([edge.normal for edge in edges])
    offset = np.array([edge.offset for edge in edges])
    if outward is not None:
        inner = _corners(edges, None, centre)
        ends = np.roll(inner, -1, axis=0)
        offset = offset - np.array([outward(a + centre, b + centre) for a, b in zip(inner, ends)])
    m, d = np.roll(normal, 1, axis=0), np.roll(offset, 1)
    det = m[:, 0] * normal[:, 1] - m[:, 1] * normal[:, 0]
    det = np.where(np.abs(det) < PARALLEL, np.nan, det)
    ring = np.column_stack([d * normal[:, 1] - offset * m[:, 1], offset * m[:, 0] - d * normal[:, 0]]) / det[:, None]
    for i in np.flatnonzero(np.isnan(det)):  # neighbours of nearly one direction: where their points meet
        ring[i] = 0.5 * (edges[i - 1].points[-1] + edges[i].points[0])
    return ring


def _simplified(ring: np.ndarray, tolerance: float, outward: Callable | None, centre: np.ndarray) -> np.ndarray:
    corners = ring[_corner_indices(ring, 0.5 * tolerance)]
    if outward is None:
        return corners
    ends = np.roll(corners, -1, axis=0)
    move = float(np.mean([outward(a + centre, b + centre) for a, b in zip(corners, ends)]))
    grown = shapely.Polygon(corners).buffer(move, join_style="mitre", mitre_limit=2.0)
    if grown.geom_type != "Polygon":
        return corners
    return shapely.get_coordinates(orient(grown).exterior)[:-1]


def _deviation(ring: shapely.LinearRing, points: np.ndarray) -> tuple[float, float]:
    """RMS and 95th percentile of the distance of points to a ring."""
    distance = shapely.distance(ring, shapely.points(points))
    return float(np.sqrt(np.mean(distance ** 2))), float(np.percentile(distance, 95))
