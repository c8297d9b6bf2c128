"""The walls of a map with what is known of their accuracy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...gnss.rays.ray_fans import FanObstacles
from ...gnss.rays.tracing import WallObstacles
from ...gnss.rays.wall_faces import WallPieces, building_walls, is_solid, wall_table

_ALONG = np.cos(np.radians(10.0))
_NEAR = 2.0
_FEET = 8


@dataclass(frozen=True)
class WallMap:
    """Walls as a vehicle's map holds them.

    Attributes
    ----------
    walls : the pieces.
    obstacles : the same in a grid, for rays.
    sigma : (walls,) standard deviation of each wall's place along its normal, m.
    """

    walls: WallPieces
    obstacles: WallObstacles
    sigma: np.ndarray

    @classmethod
    def of(cls, walls: WallPieces, sigma: np.ndarray) -> WallMap:
        """Map of walls with their standard deviations (walls,), m."""
        return cls(walls, WallObstacles.of(walls), np.asarray(sigma, float))

    @cached_property
    def fans(self) -> FanObstacles:
        """The same walls for fans of rays around places."""
        return FanObstacles.of(self.walls)

    def feet(self, xy: np.ndarray, reach: float) -> np.ndarray:
        """(n,) median height of the feet of the walls nearest to places (n, 2), m; NaN farther away than `reach`.

        The foot of a wall is that of its building: a tower's walls begin on its podium, far above the ground.
        """
        foot = np.full(int(self.walls.building.max(initial=-1)) + 1, np.inf)
        lowest = self.walls.low.min(axis=1)
        stands = np.isfinite(lowest)
        np.minimum.at(foot, self.walls.building[stands], lowest[stands])
        known = np.flatnonzero(np.isfinite(self.walls.low).all(axis=1))
        if not len(known):
            return np.full(len(xy), np.nan)
        tree = cKDTree((self.walls.start[known] + self.walls.end[known]) / 2)
        count = min(_FEET, len(known))
        distance, number = tree.query(xy, k=count)
        low = foot[self.walls.building[known]][number.reshape(len(xy), count)]
        low[distance.reshape(len(xy), count) > reach] = np.nan
        found = np.full(len(xy), np.nan)
        some = np.isfinite(low).any(axis=1)
        found[some] = np.nanmedian(low[some], axis=1)
        return found


def walls_with_heights(shapes: Sequence[shapely.Geometry | None], building: np.ndarray, top: np.ndarray | None,
                       low: np.ndarray | None) -> tuple[WallPieces | None, np.ndarray]:
    """Walls of the buildings that have heights, and the middles (k, 2) of those that have none.

    Parameters as of `gnss.rays.wall_faces.building_walls`; None where no building has a height.
    """
    with_height = np.array(shapes, object)
    without = []
    for row, shape in enumerate(with_height):
        if shape is None or shape.is_empty:
            continue
        known = top is not None and np.isfinite(top[row])
        if not known and shape.has_z:
            known = is_solid(shape) or np.isfinite(shapely.get_coordinates(shape, include_z=True)[:, 2]).all()
        if not known:
            without.append(shapely.get_coordinates(shape.centroid)[0])
            with_height[row] = None
    middles = np.array(without).reshape(-1, 2)
    if shapely.is_missing(with_height).all():
        return None, middles
    return building_walls(with_height, building, top, low), middles


def wall_sigmas(walls: WallPieces, otherwise: float, of_building: np.ndarray | None = None,
                measured: Sequence[shapely.Geometry | None] = (), measured_sigma: np.ndarray | None = None
                ) -> np.ndarray:
    """Standard deviations (walls,) of the walls' places, m.

    Parameters
    ----------
    otherwise : m, where nothing else tells it.
    of_building : (rows,) m by building row of `walls`, NaN where not known.
    measured : lines or upright polygons of walls with `measured_sigma` (m,), m: a wall of the map takes the sigma of
        the one that runs along it within 2 m and 10 degrees, the longest where there are several.
    """
    table = wall_table(walls)
    sigma = np.full(len(table), float(otherwise))
    if of_building is not None:
        stated = of_building[table.building]
        sigma = np.where(np.isfinite(stated) & (stated > 0), stated, sigma)
    if measured_sigma is None or not len(measured):
        return sigma
    lines, row = _plan_lines(measured)
    good = np.isfinite(measured_sigma[row]) & (measured_sigma[row] > 0)
    lines, row = lines[good], row[good]
    if not len(lines):
        return sigma
    wall_lines = shapely.linestrings(np.stack([table.start, table.end], axis=1))
    tree = shapely.STRtree(lines)
    wall, found = tree.query(wall_lines, predicate="dwithin", distance=_NEAR)
    ends = shapely.get_coordinates(lines).reshape(-1, 2, 2)
    direction = ends[:, 1] - ends[:, 0]
    length = np.hypot(direction[:, 0], direction[:, 1])
    along = np.column_stack([-table.normal[:, 1], table.normal[:, 0]])
    same = np.abs(np.einsum("ij,ij->i", along[wall], direction[found])) > _ALONG * length[found]
    wall, found = wall[same], found[same]
    order = np.argsort(length[found], kind="stable")
    sigma[wall[order]] = measured_sigma[row[found[order]]]
    return sigma


def _plan_lines(shapes: Sequence[shapely.Geometry | None]) -> tuple[np.ndarray, np.ndarray]:
    """Straight lines in plan between the outermost points of shapes, and the rows of these."""
    lines, rows = [], []
    for row, shape in enumerate(shapes):
        if shape is None or shape.is_empty:
            continue
        xy = shapely.get_coordinates(shape)
        off = xy - xy.mean(axis=0)
        axis = np.linalg.svd(off, full_matrices=False)[2][0]
        at = off @ axis
        if np.ptp(at) > 0.1:
            lines.append([xy.mean(axis=0) + at.min() * axis, xy.mean(axis=0) + at.max() * axis])
            rows.append(row)
    return (shapely.linestrings(np.array(lines)) if lines else np.zeros(0, object)), np.array(rows, np.int64)


def building_sigmas(building: np.ndarray, sigma: np.ndarray) -> np.ndarray:
    """(buildings,) largest sigma of the features (n,) of each building, m; NaN where none tells it."""
    rows = np.unique(building, return_inverse=True)[1].ravel()
    largest = np.full(rows.max() + 1, -np.inf)
    known = np.isfinite(sigma)
    np.maximum.at(largest, rows[known], sigma[known])
    return np.where(np.isfinite(largest), largest, np.nan)
