"""Alpha shape of roof points: the ordered boundary points of a roof (J 5.3.3, step 2)."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial import Delaunay, QhullError

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


def alpha_shape(xy: np.ndarray, alpha: float) -> list[np.ndarray]:
    """Boundary rings of the alpha shape: Delaunay triangles with a circumradius below `alpha`.

    Parameters
    ----------
    xy : (n, 2) coordinates in metres.
    alpha : metres.

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
    local = xy - xy.mean(axis=0)
    try:
        triangles = Delaunay(local).simplices
    except QhullError:  # all points on one line: no triangle, so no area
        return []
    triangles = _small_triangles(local, triangles, alpha)
    start, end = _boundary_edges(triangles, len(local))
    rings = _trace(local, start, end)
    areas = [signed_area(local[ring]) for ring in rings]
    order = sorted(range(len(rings)), key=lambda i: (-areas[i], int(rings[i][0])))
    return [rings[i] for i in order]


def signed_area(ring: np.ndarray) -> float:
    """Area of an open or closed ring (n, 2), positive where it runs counterclockwise."""
    x, y = ring[:, 0] - ring[0, 0], ring[:, 1] - ring[0, 1]
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def _small_triangles(xy: np.ndarray, triangles: np.ndarray, alpha: float) -> np.ndarray:
    """Triangles with circumradius < alpha, turned counterclockwise."""
    a, b, c = xy[triangles[:, 0]], xy[triangles[:, 1]], xy[triangles[:, 2]]
    u, v = b - a, c - a
    twice_area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    sides = np.hypot(*u.T) * np.hypot(*v.T) * np.hypot(*(c - b).T)
    keep = sides < 2.0 * alpha * np.abs(twice_area)  # R = abc / (4 area)
    triangles = triangles[keep].astype(np.int64)
    clockwise = twice_area[keep] < 0
    triangles[clockwise] = triangles[clockwise][:, [0, 2, 1]]
    return triangles


def _boundary_edges(triangles: np.ndarray, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Directed edges (start, end) that belong to one triangle only, the triangle on their left."""
    start = triangles.ravel()
    end = np.roll(triangles, -1, axis=1).ravel()
    lone = ~np.isin(start * n + end, end * n + start)
    start, end = start[lone], end[lone]
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
