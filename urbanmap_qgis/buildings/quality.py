"""How well a building model fits its points: the figures that every model carries."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

BEST_SHARE = 0.95
"""Share of the points, those that fit best, that the trimmed RMSE is taken over."""


EXPLAINED = 0.5
"""Distance (m) to the nearest surface of the model up to which it explains a point."""

PARAPET_HEIGHT, PARAPET_REACH = 1.5, 1.0
"""A point up to so much over a roof (m) and so near to its edge (m) is its parapet, which the model leaves out."""

WALL_POINT = 1.0
"""Distance (m) of a point that no roof took from a wall up to which it is a point of that wall: outlines are rough."""


@dataclass(frozen=True)
class RoofCell:
    """One roof of a model: its plan polygon and its height (m) at `place`, rising from there by `gradient` (m a m)."""

    polygon: shapely.Polygon
    height: float
    roof_id: int = 0
    gradient: tuple[float, float] = (0.0, 0.0)
    place: tuple[float, float] = (0.0, 0.0)

    def heights(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Heights (n,) of the roof's plane, m."""
        return self.height + self.gradient[0] * (x - self.place[0]) + self.gradient[1] * (y - self.place[1])


@dataclass(frozen=True)
class ModelFit:
    """Figures of fit of one building's model, all distances in m; NaN where there are no points.

    Attributes
    ----------
    points : points that can be roof, used for the figures.
    rmse_z : root mean square height difference of the points over a roof.
    rmse_z95 : the same of the 95 % that fit best.
    median_dz : median of the absolute height difference.
    rmse_3d : root mean square distance to the nearest surface of the model.
    p95 : 95th percentile of that distance.
    coverage : share of the points that lie over or under a roof of the model.
    not_explained : share of the points farther than `EXPLAINED` from every surface of the model, parapets left out.
    """

    points: int
    rmse_z: float
    rmse_z95: float
    median_dz: float
    rmse_3d: float
    p95: float
    coverage: float
    not_explained: float = float("nan")


def model_fit(x: np.ndarray, y: np.ndarray, z: np.ndarray, cells: list[RoofCell], walls: np.ndarray,
              on_roof: np.ndarray | None = None) -> ModelFit:
    """Fit of points (n,) to a model of level or sloped roofs and vertical walls.

    `walls` (w, 6): x and y of a wall's two ends, its lowest and its highest z; or (w, 8): lowest at both ends, highest
    at both ends. `on_roof` (n,): whether a roof took the point; of the others those on walls have no height error.
    """
    if not len(x) or not cells:
        return ModelFit(len(x), *[np.nan] * 5, 0.0 if len(x) else np.nan, 1.0 if len(x) else np.nan)
    dz = height_differences(x, y, z, cells)
    over = np.isfinite(dz)
    on_wall = np.zeros(len(x), bool)
    if on_roof is not None and len(walls) and not on_roof.all():
        other = np.flatnonzero(~on_roof)
        on_wall[other] = _wall_distances(x[other], y[other], z[other], walls).min(axis=1) < WALL_POINT
        over &= ~on_wall
    distance = surface_distances(x, y, z, cells, walls)
    absolute = np.sort(np.abs(dz[over]))
    best = absolute[:max(int(np.ceil(BEST_SHARE * len(absolute))), 1)]
    median = float(np.median(absolute)) if len(absolute) else np.nan
    return ModelFit(len(x), _rms(absolute), _rms(best), median, _rms(distance), float(np.percentile(distance, 95)),
                    float(np.isfinite(dz).mean()),
                    float((unexplained_points(x, y, dz, distance, cells) & ~on_wall).mean()))


def unexplained_points(x: np.ndarray, y: np.ndarray, dz: np.ndarray, distance: np.ndarray,
                       cells: list[RoofCell]) -> np.ndarray:
    """Mask (n,) of the points that neither a surface of the model nor a parapet on one of its roofs explains."""
    far = distance > EXPLAINED
    low = np.flatnonzero(far & (dz > 0) & (dz <= PARAPET_HEIGHT))
    if len(low):
        edges = shapely.union_all([shapely.boundary(cell.polygon) for cell in cells])
        shapely.prepare(edges)
        far[low] = ~shapely.dwithin(edges, shapely.points(x[low], y[low]), PARAPET_REACH)
    return far


def height_differences(x: np.ndarray, y: np.ndarray, z: np.ndarray, cells: list[RoofCell]) -> np.ndarray:
    """Height (n,) of each point above the roof at its place, m; NaN where there is no roof."""
    dz = np.full(len(x), np.nan)
    for cell in sorted(cells, key=lambda cell: cell.height):
        shapely.prepare(cell.polygon)
        inside = shapely.intersects_xy(cell.polygon, x, y)
        dz[inside] = z[inside] - cell.heights(x[inside], y[inside])
    return dz


def surface_distances(x: np.ndarray, y: np.ndarray, z: np.ndarray, cells: list[RoofCell],
                      walls: np.ndarray) -> np.ndarray:
    """Distance (n,) of each point to the nearest roof or wall, m; `walls` as for `model_fit`."""
    points = shapely.points(x, y)
    nearest = np.full(len(x), np.inf)
    for cell in cells:
        nearest = np.minimum(nearest, _roof_distances(x, y, z, points, cell))
    for start in range(0, len(walls), 64):  # bounds the memory of points times walls
        nearest = np.minimum(nearest, _wall_distances(x, y, z, walls[start:start + 64]).min(axis=1))
    return nearest


def _roof_distances(x: np.ndarray, y: np.ndarray, z: np.ndarray, points: np.ndarray, cell: RoofCell) -> np.ndarray:
    """Distances (n,) of points to one roof, m."""
    if cell.gradient == (0.0, 0.0):
        return np.hypot(shapely.distance(cell.polygon, points), z - cell.height)
    a, b = cell.gradient
    above = (z - cell.heights(x, y)) / (1.0 + a * a + b * b)
    foot = shapely.intersects_xy(cell.polygon, x + a * above, y + b * above)
    distance = np.abs(above) * np.sqrt(1.0 + a * a + b * b)
    beside = np.flatnonzero(~foot)
    if len(beside):
        distance[beside] = _edge_distances(np.column_stack([x, y, z])[beside], cell)
    return distance


def _edge_distances(points: np.ndarray, cell: RoofCell) -> np.ndarray:
    """Distances (n,) of points (n, 3) to the edges of a roof, m."""
    nearest = np.full(len(points), np.inf)
    for ring in shapely.get_rings(cell.polygon):
        x, y = shapely.get_coordinates(ring).T
        corners = np.column_stack([x, y, cell.heights(x, y)])
        for start, end in zip(corners[:-1], corners[1:]):
            along = end - start
            from_start = points - start
            # Summed by hand: a matrix product's last digit depends on where the arrays lie in memory.
            run = from_start[:, 0] * along[0] + from_start[:, 1] * along[1] + from_start[:, 2] * along[2]
            share = np.clip(run / max(along[0] ** 2 + along[1] ** 2 + along[2] ** 2, 1e-12), 0.0, 1.0)
            nearest = np.minimum(nearest, np.linalg.norm(from_start - share[:, None] * along, axis=1))
    return nearest


def _wall_distances(x: np.ndarray, y: np.ndarray, z: np.ndarray, walls: np.ndarray) -> np.ndarray:
    """Distances (n, w) of points to vertical walls, m."""
    if walls.shape[1] == 6:
        walls = walls[:, [0, 1, 2, 3, 4, 4, 5, 5]]
    start, end, low, high = walls[:, 0:2], walls[:, 2:4], walls[:, 4:6], walls[:, 6:8]
    along = end - start
    length2 = np.maximum((along**2).sum(axis=1), 1e-12)
    dx, dy = x[:, None] - start[:, 0], y[:, None] - start[:, 1]
    share = np.clip((dx * along[:, 0] + dy * along[:, 1]) / length2, 0.0, 1.0)
    plan = np.hypot(dx - share * along[:, 0], dy - share * along[:, 1])
    bottom = low[:, 0] + share * (low[:, 1] - low[:, 0])
    top = high[:, 0] + share * (high[:, 1] - high[:, 0])
    over = np.maximum(np.maximum(z[:, None] - top, bottom - z[:, None]), 0.0)
    return np.hypot(plan, over)


def _rms(values: np.ndarray) -> float:
    """Root mean square, NaN of nothing."""
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else float("nan")
