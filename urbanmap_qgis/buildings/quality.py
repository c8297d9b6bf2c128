"""How well a building model fits its points: the figures that every model carries."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

BEST_SHARE = 0.95
"""Share of the points, those that fit best, that the trimmed RMSE is taken over."""


@dataclass(frozen=True)
class RoofCell:
    """One horizontal roof of a model: its plan polygon and its height (m)."""

    polygon: shapely.Polygon
    height: float
    roof_id: int = 0


@dataclass(frozen=True)
class ModelFit:
    """Figures of fit of one building's model, all distances in m; NaN where there are no points.

    Attributes
    ----------
    points : roof points used.
    rmse_z : root mean square height difference of the points over a roof.
    rmse_z95 : the same of the 95 % that fit best.
    median_dz : median of the absolute height difference.
    rmse_3d : root mean square distance to the nearest surface of the model.
    p95 : 95th percentile of that distance.
    coverage : share of the points that lie over or under a roof of the model.
    """

    points: int
    rmse_z: float
    rmse_z95: float
    median_dz: float
    rmse_3d: float
    p95: float
    coverage: float


def model_fit(x: np.ndarray, y: np.ndarray, z: np.ndarray, cells: list[RoofCell],
              walls: np.ndarray) -> ModelFit:
    """Fit of points (n,) to a model of flat roofs and vertical walls.

    `walls` (w, 6): x and y of a wall's two ends, its lowest and its highest z.
    """
    if not len(x) or not cells:
        return ModelFit(len(x), *[np.nan] * 5, 0.0 if len(x) else np.nan)
    dz = height_differences(x, y, z, cells)
    over = np.isfinite(dz)
    distance = surface_distances(x, y, z, cells, walls)
    absolute = np.sort(np.abs(dz[over]))
    best = absolute[:max(int(np.ceil(BEST_SHARE * len(absolute))), 1)]
    median = float(np.median(absolute)) if len(absolute) else np.nan
    return ModelFit(len(x), _rms(absolute), _rms(best), median, _rms(distance),
                    float(np.percentile(distance, 95)), float(over.mean()))


def height_differences(x: np.ndarray, y: np.ndarray, z: np.ndarray, cells: list[RoofCell]) -> np.ndarray:
    """Height (n,) of each point above the roof at its place, m; NaN where there is no roof."""
    dz = np.full(len(x), np.nan)
    for cell in sorted(cells, key=lambda cell: cell.height):
        shapely.prepare(cell.polygon)
        inside = shapely.intersects_xy(cell.polygon, x, y)
        dz[inside] = z[inside] - cell.height
    return dz


def surface_distances(x: np.ndarray, y: np.ndarray, z: np.ndarray, cells: list[RoofCell],
                      walls: np.ndarray) -> np.ndarray:
    """Distance (n,) of each point to the nearest roof or wall, m; `walls` as for `model_fit`."""
    points = shapely.points(x, y)
    nearest = np.full(len(x), np.inf)
    for cell in cells:
        nearest = np.minimum(nearest, np.hypot(shapely.distance(cell.polygon, points), z - cell.height))
    for start in range(0, len(walls), 64):  # bounds the memory of points times walls
        nearest = np.minimum(nearest, _wall_distances(x, y, z, walls[start:start + 64]).min(axis=1))
    return nearest


def _wall_distances(x: np.ndarray, y: np.ndarray, z: np.ndarray, walls: np.ndarray) -> np.ndarray:
    """Distances (n, w) of points to vertical rectangles, m."""
    start, end, low, high = walls[:, 0:2], walls[:, 2:4], walls[:, 4], walls[:, 5]
    along = end - start
    length2 = np.maximum((along**2).sum(axis=1), 1e-12)
    dx, dy = x[:, None] - start[:, 0], y[:, None] - start[:, 1]
    share = np.clip((dx * along[:, 0] + dy * along[:, 1]) / length2, 0.0, 1.0)
    plan = np.hypot(dx - share * along[:, 0], dy - share * along[:, 1])
    over = np.maximum(np.maximum(z[:, None] - high, low - z[:, None]), 0.0)
    return np.hypot(plan, over)


def _rms(values: np.ndarray) -> float:
    """Root mean square, NaN of nothing."""
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else float("nan")
