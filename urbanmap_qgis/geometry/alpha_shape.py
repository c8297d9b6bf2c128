"""Alpha shape of roof points: the ordered boundary points of a roof (J 5.3.3, step 2)."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial import Delaunay, QhullError, cKDTree

from ..errors import InputError
from ..wording import say

ALPHA_SPACINGS = 2.0
"""Default alpha in mean point spacings. For points without order the share of Delaunay circles wider than
R is (1 + pi d R^2) exp(-pi d R^2) with density d: 6e-5 at two spacings, so that chance opens no holes."""


def default_alpha(density: float) -> float:
    """Alpha in metres that fits the density (points per m2): larger gaps are courtyards or bays."""
    if not density > 0:
        raise InputError(say("The point density must be above zero points per square metre."))
    return ALPHA_SPACINGS / math.sqrt(density)


def alpha_shape(xy: np.ndarray, alpha: float, left_out: np.ndarray | None = None) -> list[np.ndarray]:
    """Boundary rings of the alpha shape: Delaunay triangles with a circumradius below `alpha`.

    Parameters
    ----------
    xy : (n, 2) coordinates in metres.
    alpha : metres.
    left_out : (m, 2) points well within the shape, round which all triangles would be small enough; they are not
        triangulated. What they leave is filled with triangles whose circles hold one of them, and only with these:
        all these count, and the rings are those of all points together.

    Returns
    -------
    Rings as index arrays into `xy`, each in order and without repeating its first point. Outer rings run
    counterclockwise, holes (courtyards) clockwise; the largest outer ring comes first, then by falling area.
    Rings that touch in a point stay separate. Empty where no triangle is small enough.
    """
    xy = np.asarray(xy, float)
    if xy.ndim != 2 or xy.shape[1] != 2:
        raise InputError(say("An alpha shape needs points with two coordinates."))
    if not alpha > 0:
        raise InputError(say("Alpha must be above zero metres."))
    if len(xy) < 3:
        return []
    middle = xy.mean(axis=0)
    local = xy - middle
    try:
        net = Delaunay(local)
    except QhullError:  # all points on one line: no triangle, so no area
        return []
    within = _small_triangles(local, net.simplices, alpha)
    if left_out is not None and len(left_out):
        large = np.flatnonzero(~within)
        within[large] = _circles_hold(local, net.simplices[large], left_out - middle)
    start, end = _boundary_edges(local, net, within)
    rings = _trace(local, start, end)
    areas = [signed_area(local[ring]) for ring in rings]
    order = sorted(range(len(rings)), key=lambda i: (-areas[i], int(rings[i][0])))
    return [rings[i] for i in order]


def signed_area(ring: np.ndarray) -> float:
    """Area of an open or closed ring (n, 2), positive where it runs counterclockwise."""
    x, y = ring[:, 0] - ring[0, 0], ring[:, 1] - ring[0, 1]
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def _small_triangles(xy: np.ndarray, triangles: np.ndarray, alpha: float) -> np.ndarray:
    """Which triangles (t,) have a circumradius < alpha."""
    a, b, c = xy[triangles[:, 0]], xy[triangles[:, 1]], xy[triangles[:, 2]]
    u, v = b - a, c - a
    twice_area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    sides = np.hypot(*u.T) * np.hypot(*v.T) * np.hypot(*(c - b).T)
    return sides < 2.0 * alpha * np.abs(twice_area)  # R = abc / (4 area)


def _circles_hold(xy: np.ndarray, triangles: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Which triangles (t,) have one of the points (m, 2) in their circumcircle."""
    a = xy[triangles[:, 0]]
    u, v = xy[triangles[:, 1]] - a, xy[triangles[:, 2]] - a
    uu, vv = (u * u).sum(axis=1), (v * v).sum(axis=1)
    twice = 2.0 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
    with np.errstate(divide="ignore", invalid="ignore"):
        away = np.column_stack([v[:, 1] * uu - u[:, 1] * vv, u[:, 0] * vv - v[:, 0] * uu]) / twice[:, None]
    hold = np.isfinite(away).all(axis=1)  # three points on a line have no circle
    nearest = cKDTree(points).query((a + away)[hold])[0]
    hold[hold] = nearest < np.hypot(*away[hold].T)
    return hold


def _boundary_edges(xy: np.ndarray, net: Delaunay, within: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Directed edges (start, end) between the triangles `within` and the others, the former on their left."""
    inside = np.append(within, False)  # -1, no neighbour, looks up the last
    triangle, corner = np.nonzero(within[:, None] & ~inside[net.neighbors])  # the neighbour opposite of each corner
    corners = net.simplices[triangle].astype(np.int64)
    row = np.arange(len(triangle))
    opposite, start, end = (corners[row, (corner + turn) % 3] for turn in range(3))
    u, v = xy[start] - xy[opposite], xy[end] - xy[opposite]
    clockwise = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] < 0
    start[clockwise], end[clockwise] = end[clockwise], start[clockwise]
    order = np.lexsort((end, start))
    return start[order], end[order]


def _trace(xy: np.ndarray, start: np.ndarray, end: np.ndarray) -> list[np.ndarray]:
    """Chain directed boundary edges to rings of point indices."""
    if len(start) == 0:
        return []
    following = np.searchsorted(start, end)  # the first edge that leaves where this one arrives
    departures = np.searchsorted(start, end, side="right") - following
    for edge in np.flatnonzero(departures > 1):
        first = following[edge]
        leaving = np.arange(first, first + departures[edge])
        following[edge] = leaving[_next_through_inside(xy, start[edge], end[edge], end[leaving])]
    jump, origin = following.tolist(), start.tolist()
    free = [True] * len(origin)
    rings = []
    for seed in range(len(origin)):
        ring = []
        edge = seed
        while free[edge]:
            free[edge] = False
            ring.append(origin[edge])
            edge = jump[edge]
        if ring:
            rings.append(np.array(ring, np.int64))
    return rings


def _next_through_inside(xy: np.ndarray, before: int, node: int, targets: np.ndarray) -> int:
    """Which way to leave a point where rings touch: the first met turning clockwise through the inside."""
    back = xy[before] - xy[node]
    out = xy[targets] - xy[node]
    turn = (math.atan2(back[1], back[0]) - np.arctan2(out[:, 1].copy(), out[:, 0].copy())) % (2.0 * math.pi)
    return int(np.argmin(turn))
