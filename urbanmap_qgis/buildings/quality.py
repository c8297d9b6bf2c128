"""How well a building model fits its points: the figures that every model carries."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ..execution import checkpoint
from ..geometry.polygon_rings import polygon_rings
from ..geometry.tolerances import LEAST_SQUARE, SAME_PLACE

BEST_SHARE = 0.95  # Share of the points, those that fit best, that the trimmed RMSE is taken over.
EXPLAINED = 0.5  # Distance (m) to the nearest surface of the model up to which it explains a point.
# Distance (m) of a point that no roof took from a wall up to which it is a point of that wall: outlines are
# rough.
WALL_POINT = 1.0

_AT_ONCE = 20_000
"""Points times edges whose distances are found at once: they stay in the processor's cache."""

PARAPET_HEIGHT, PARAPET_REACH = 1.5, 1.0
"""A point up to so much over a roof (m) and so near to its edge (m) is its parapet, which the model leaves out."""


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
    not_explained : share of points farther than `EXPLAINED` from all surfaces of the model, parapets apart.
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
    below = points_over(x, y, cells)
    dz = height_differences(x, y, z, cells, below)
    over = np.isfinite(dz)
    on_wall = np.zeros(len(x), bool)
    if on_roof is not None and len(walls) and not on_roof.all():
        other = np.flatnonzero(~on_roof)
        limit = np.full(len(other), WALL_POINT)
        on_wall[other] = _wall_distances(x[other], y[other], z[other], walls, limit) < WALL_POINT
        over &= ~on_wall
    distance = surface_distances(x, y, z, cells, walls, below)
    absolute = np.sort(np.abs(dz[over]))
    best = absolute[:max(int(np.ceil(BEST_SHARE * len(absolute))), 1)]
    median = (float(absolute[(len(absolute) - 1) // 2] + absolute[len(absolute) // 2]) / 2 if len(absolute)
              else np.nan)
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


def points_over(x: np.ndarray, y: np.ndarray, cells: list[RoofCell]) -> list[np.ndarray]:
    """Ascending numbers of the points over or under each roof, its edge included."""
    result = []
    for cell in cells:
        west, south, east, north = cell.polygon.bounds
        near = np.flatnonzero((x >= west) & (x <= east) & (y >= south) & (y <= north))
        shapely.prepare(cell.polygon)
        result.append(near[shapely.intersects_xy(cell.polygon, x[near], y[near])])
    return result


def height_differences(x: np.ndarray, y: np.ndarray, z: np.ndarray, cells: list[RoofCell],
                       below: list[np.ndarray] | None = None) -> np.ndarray:
    """Height (n,) of each point above the roof at its place, m; NaN where there is no roof.

    `below` : what `points_over` gives for these points, where it is known already.
    """
    dz = np.full(len(x), np.nan)
    for cell, rows in sorted(zip(cells, points_over(x, y, cells) if below is None else below),
                             key=lambda pair: pair[0].height):
        dz[rows] = z[rows] - cell.heights(x[rows], y[rows])
    return dz


def surface_distances(x: np.ndarray, y: np.ndarray, z: np.ndarray, cells: list[RoofCell],
                      walls: np.ndarray, below: list[np.ndarray] | None = None) -> np.ndarray:
    """Distance (n,) of each point to the nearest roof or wall, m; `walls` as for `model_fit`, `below` as above.

    The roof at a point's own place comes first: what lies farther away than that is not looked at.
    """
    nearest = np.full(len(x), np.inf)
    below = points_over(x, y, cells) if below is None else below
    for cell, rows in zip(cells, below):
        nearest[rows] = np.minimum(nearest[rows], _roof_distances(x[rows], y[rows], z[rows], cell, at_place=True))
    for cell, rows in zip(cells, below):
        checkpoint()
        near = _within_reach(x, y, z, cell, nearest + SAME_PLACE)
        near[rows] = False
        near = np.flatnonzero(near)
        if len(near):
            nearest[near] = np.minimum(nearest[near], _roof_distances(x[near], y[near], z[near], cell))
    for start in range(0, len(walls), 64):  # bounds the memory of points times walls
        checkpoint()
        nearest = np.minimum(nearest, _wall_distances(x, y, z, walls[start:start + 64], nearest))
    return nearest


def _within_reach(x: np.ndarray, y: np.ndarray, z: np.ndarray, cell: RoofCell, reach: np.ndarray) -> np.ndarray:
    """Mask (n,) of the points that may lie nearer to a roof than `reach` (n,): to its box and to its plane."""
    west, south, east, north = cell.polygon.bounds
    a, b = cell.gradient
    height = np.abs(z - cell.heights(x, y)) if a or b else np.abs(z - cell.height)
    return ((x + reach >= west) & (x - reach <= east) & (y + reach >= south) & (y - reach <= north)
            & (height <= reach * np.sqrt(1.0 + a * a + b * b)))


def _roof_distances(x: np.ndarray, y: np.ndarray, z: np.ndarray, cell: RoofCell,
                    at_place: bool = False) -> np.ndarray:
    """Distances (n,) of points to one roof, m; `at_place`: all of them lie over or under it."""
    if cell.gradient == (0.0, 0.0):
        off = z - cell.height
        return np.abs(off) if at_place else np.hypot(shapely.distance(cell.polygon, shapely.points(x, y)), off)
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
    coordinates, ring = shapely.get_coordinates(polygon_rings(cell.polygon)[0], return_index=True)
    corners = np.column_stack([*coordinates.T, cell.heights(*coordinates.T)])
    starts = np.flatnonzero(ring[1:] == ring[:-1])
    alongs = corners[starts + 1] - corners[starts]
    squares = np.maximum(alongs[:, 0] ** 2 + alongs[:, 1] ** 2 + alongs[:, 2] ** 2, LEAST_SQUARE)
    nearest = np.full(len(points), np.inf)
    several = max(1, _AT_ONCE // max(len(points), 1))
    for first in range(0, len(starts), several):
        edges = slice(first, first + several)
        along = alongs[edges, None]
        from_start = points - corners[starts[edges], None]
        # Summed by hand: a matrix product's last digit depends on where the arrays lie in memory.
        run = sum(from_start[..., axis] * along[..., axis] for axis in range(3))
        share = np.clip(run / squares[edges, None], 0.0, 1.0)
        nearest = np.minimum(nearest, np.linalg.norm(from_start - share[..., None] * along, axis=2).min(axis=0))
    return nearest


def _wall_distances(x: np.ndarray, y: np.ndarray, z: np.ndarray, walls: np.ndarray, limit: np.ndarray) -> np.ndarray:
    """Distance (n,) of each point to the nearest of vertical walls (w, 6 or 8), m; one of `limit` (n,) or more may be
    left out, and infinity stands where all are."""
    if walls.shape[1] == 6:
        walls = walls[:, [0, 1, 2, 3, 4, 4, 5, 5]]
    reach, nearest = limit + SAME_PLACE, np.full(len(x), np.inf)
    least, most = np.minimum(walls[:, [0, 1, 4]], walls[:, [2, 3, 5]]), np.maximum(walls[:, [0, 1, 6]],
                                                                                  walls[:, [2, 3, 7]])
    inside = np.ones(len(x), bool)
    for axis, place in enumerate((x, y, z)):  # first those near any of the walls: few where there are many walls
        inside &= (place + reach >= least[:, axis].min()) & (place - reach <= most[:, axis].max())
    inside = np.flatnonzero(inside)
    near = np.ones((len(inside), len(walls)), bool)
    for axis, place in enumerate((x, y, z)):
        near &= (place + reach)[inside, None] >= least[:, axis]
        near &= (place - reach)[inside, None] <= most[:, axis]
    point, wall = np.nonzero(near)
    point = inside[point]
    if len(point):
        distance = _distances_to_own(x[point], y[point], z[point], walls[wall])
        first = np.flatnonzero(np.r_[True, point[1:] != point[:-1]])
        nearest[point[first]] = np.minimum.reduceat(distance, first)
    return nearest


def _distances_to_own(x: np.ndarray, y: np.ndarray, z: np.ndarray, walls: np.ndarray) -> np.ndarray:
    """Distance (n,) of each point to the vertical wall (n, 8) of its row, m."""
    start, end, low, high = walls[:, 0:2], walls[:, 2:4], walls[:, 4:6], walls[:, 6:8]
    along = end - start
    length2 = np.maximum((along**2).sum(axis=1), LEAST_SQUARE)
    dx, dy = x - start[:, 0], y - start[:, 1]
    share = np.clip((dx * along[:, 0] + dy * along[:, 1]) / length2, 0.0, 1.0)
    plan = np.hypot(dx - share * along[:, 0], dy - share * along[:, 1])
    bottom = low[:, 0] + share * (low[:, 1] - low[:, 0])
    top = high[:, 0] + share * (high[:, 1] - high[:, 0])
    over = np.maximum(np.maximum(z - top, bottom - z), 0.0)
    return np.hypot(plan, over)


def _rms(values: np.ndarray) -> float:
    """Root mean square, NaN of nothing."""
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else float("nan")
