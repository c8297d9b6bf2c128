"""How well a mesh follows its points, and whether it is closed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...geometry.solid import INNER_WALL, OUTER_WALL, ROOF, Solid
from ...geometry.tolerances import LEAST_SQUARE

_BESIDE, _ABOVE = 0.3, 0.6


@dataclass(frozen=True)
class MeshFit:
    """Distances of a building's points from its mesh.

    Attributes
    ----------
    points : number.
    within : share of the uppermost points within the stated error.
    rmse, p95, max_distance : m, of all points to the nearest surface.
    under : share of the points that lie under the uppermost surface: facades, a second roof, what stands below eaves.
    """

    points: int
    within: float
    rmse: float
    p95: float
    max_distance: float
    under: float = 0.0


def is_watertight(mesh: Solid) -> bool:
    """Whether each directed edge of the triangles occurs once, and its reverse once."""
    corners = np.array([face[0] for face in mesh.faces])
    start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    size = len(mesh.vertices)
    code, back = np.sort(start * size + end), np.sort(end * size + start)
    return bool((np.diff(code) > 0).all() and np.array_equal(code, back))


def mesh_fit(mesh: Solid, points: np.ndarray, error: float) -> MeshFit:
    """Distances of points (n, 3) from roofs (across them) and walls, whichever is nearer, in m; `error` as stated."""
    distance = np.minimum(roof_distance(mesh, points), wall_distance(mesh, points, 4 * error))
    known = np.isfinite(distance)
    if not known.any():
        return MeshFit(len(points), 0.0, float("nan"), float("nan"), float("nan"))
    distance = np.where(known, distance, distance[known].max())
    under = np.zeros(len(points), bool)
    beyond = np.flatnonzero(distance > error)
    under[beyond] = under_others(points, beyond)
    upper = distance[~under]
    return MeshFit(len(points), float(np.mean(upper <= error)) if len(upper) else 0.0,
                   float(np.sqrt(np.mean(distance**2))), float(np.quantile(distance, 0.95)), float(distance.max()),
                   float(under.mean()))


def under_others(points: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Whether points `rows` (k,) of points (n, 3) lie under another: within `_BESIDE` in plan, `_ABOVE` higher.

    No roof that is less steep than 63 degrees does that to its own points.
    """
    near = cKDTree(points[:, :2]).query_ball_point(points[rows, :2], _BESIDE)
    return np.array([points[members, 2].max() - points[row, 2] > _ABOVE for row, members in zip(rows, near)], bool)


def roof_distance(mesh: Solid, points: np.ndarray) -> np.ndarray:
    """Distance (n,) of points from the roof over or under them, measured across it; inf beside all roofs."""
    corners = np.array([face[0] for face, kind in zip(mesh.faces, mesh.surface_type) if kind == ROOF])
    places = mesh.vertices[corners]
    shapes = shapely.polygons(places[..., :2])
    point, triangle = shapely.STRtree(shapes).query(shapely.points(points[:, :2]), predicate="intersects")
    result = np.full(len(points), np.inf)
    a, b, c = (places[triangle, k] for k in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    keep = normal[:, 2] > 1e-9
    across = np.abs(((points[point] - a) * normal).sum(axis=1)) / np.maximum(length, LEAST_SQUARE)
    np.minimum.at(result, point[keep], across[keep])
    return result


def wall_distance(mesh: Solid, points: np.ndarray, max_range: float) -> np.ndarray:
    """Distance (n,) of points from the walls' rectangles within `max_range`; inf beyond."""
    rows = wall_boxes(mesh)
    result = np.full(len(points), np.inf)
    if not len(rows):
        return result
    lines = shapely.linestrings(rows[:, :4].reshape(-1, 2, 2))
    point, wall = shapely.STRtree(lines).query(shapely.points(points[:, :2]), predicate="dwithin", distance=max_range)
    beside = shapely.distance(shapely.points(points[point, :2]), lines[wall])
    below = np.maximum(rows[wall, 4] - points[point, 2], 0.0)
    above = np.maximum(points[point, 2] - rows[wall, 5], 0.0)
    np.minimum.at(result, point, np.hypot(beside, below + above))
    return result


def wall_boxes(mesh: Solid) -> np.ndarray:
    """Plan ends, lowest and highest z (w, 6) of the walls, one row a plan edge; a slanting top counts by its mean."""
    spans: dict[tuple, list[np.ndarray]] = {}
    for face, kind in zip(mesh.faces, mesh.surface_type):
        if kind not in (OUTER_WALL, INNER_WALL):
            continue
        corners = mesh.vertices[list(face[0])]
        ends = sorted({tuple(place) for place in np.round(corners[:, :2], 3).tolist()})
        spans.setdefault((ends[0], ends[-1]), []).append(corners)
    rows = []
    for (one, two), pieces in spans.items():
        corners = np.concatenate(pieces)
        at_one = np.hypot(*(corners[:, :2] - one).T) < np.hypot(*(corners[:, :2] - two).T)
        z = [corners[side, 2] for side in (at_one, ~at_one) if side.any()]
        rows.append([*one, *two, np.mean([side.min() for side in z]), np.mean([side.max() for side in z])])
    return np.array(rows, float).reshape(-1, 6)
