"""The normal distributions with which an NDT sees the walls of a map, and how well they stand for them.

A cell's distribution is that of the walls in it: the spread of their points, and the variance of each wall's place
along its normal. Where two walls meet in a cell, or one ends, the distribution is not that of a plane: it says less
about each of them (representation quality, J 6.2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...gnss.rays.wall_faces import WallPieces
from ...mobile.registration.matching.ndt_map import NdtMap
from .wall_map import WallMap

_STEP = 0.25
_LEAST = 0.03
"""Least standard deviation of a distribution, m: no wall is flatter."""

_OTHER_SURFACE = np.cos(np.radians(20.0))


@dataclass(frozen=True)
class PlanWallCells:
    """Distributions in the plan of the walls that a scanner meets.

    Attributes
    ----------
    ndt : the distributions.
    two : (k,) whether two surfaces meet in the cell.
    """

    ndt: NdtMap
    two: np.ndarray

    def of(self, xy: np.ndarray) -> np.ndarray:
        """(m,) number of the distribution at points (m, 2), -1 where there is none."""
        return self.ndt.number[self.ndt.cells_of(xy - self.ndt.origin)]


def wall_points(walls: WallPieces, pieces: np.ndarray, step: float = _STEP) -> tuple[np.ndarray, np.ndarray]:
    """Points (m, 2) about every `step` m along pieces of walls, and the number of the piece of each (m,)."""
    start, end = walls.start[pieces], walls.end[pieces]
    length = np.hypot(*(end - start).T)
    count = np.maximum(np.ceil(length / step).astype(np.int64), 1)
    row = np.repeat(np.arange(len(pieces)), count)
    share = (np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[row]
    return start[row] + share[:, None] * (end - start)[row], pieces[row]


def pieces_at_height(walls: WallPieces, above: float) -> np.ndarray:
    """Numbers of the pieces that stand at a height above the foot of their building, m."""
    base = np.full(int(walls.building.max()) + 1, np.inf)
    np.minimum.at(base, walls.building, walls.low.min(axis=1))
    foot = base[walls.building]
    level = np.where(np.isfinite(foot), foot, -np.inf) + above
    return np.flatnonzero((walls.low.min(axis=1) <= level) & (walls.top.max(axis=1) > level))


def wall_plan_cells(walls: WallMap, cell: float, above: float) -> PlanWallCells:
    """Distributions in the plan, of the walls at a height `above` the feet of their buildings, m."""
    points, piece = wall_points(walls.walls, pieces_at_height(walls.walls, above))
    normal = walls.walls.normal[piece]
    ndt, index = _distributions(points, normal, walls.sigma[walls.walls.wall[piece]], cell)
    # Twice the angle, so that both faces of a wall are one direction.
    angle = 2 * np.arctan2(normal[:, 1], normal[:, 0])
    size = np.bincount(index)
    mean = np.hypot(np.bincount(index, np.cos(angle)), np.bincount(index, np.sin(angle))) / size
    return PlanWallCells(ndt, mean < _OTHER_SURFACE)


def space_cells(walls: WallMap, cell: float, height: float, foot: float, xy: np.ndarray, reach: float,
                ground_sigma: float) -> NdtMap:
    """Distributions in space around a place (2,), m: walls within `reach` m up to `height` m above their feet, and a
    level road at the height `foot`, m, with its sigma."""
    middle = (walls.walls.start + walls.walls.end) / 2
    half = np.hypot(*(walls.walls.end - walls.walls.start).T) / 2
    plan, piece = wall_points(walls.walls, np.flatnonzero(np.hypot(*(middle - xy).T) - half < reach), 2 * _STEP)
    near = np.hypot(*(plan - xy).T) < reach
    plan, piece = plan[near], piece[near]
    low = walls.walls.low.min(axis=1)[piece]
    low = np.where(np.isfinite(low), low, foot)
    top = np.minimum(walls.walls.top.max(axis=1)[piece], foot + height)
    count = np.maximum(np.ceil((top - low) / (2 * _STEP)).astype(np.int64), 0)
    row = np.repeat(np.arange(len(plan)), count)
    share = (np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[row]
    points = np.column_stack([plan[row], low[row] + share * (top - low)[row]])
    normal = np.column_stack([walls.walls.normal[piece[row]], np.zeros(len(row))])
    east, north = (values.ravel() for values in np.meshgrid(*[np.arange(-reach, reach, 4 * _STEP)] * 2))
    road = np.column_stack([xy[0] + east, xy[1] + north, np.full(len(east), foot)])
    road = road[~walls.obstacles.inside(road + np.array([0.0, 0.0, 1.0]))]
    up = np.broadcast_to([0.0, 0.0, 1.0], road.shape)
    sigma = np.concatenate([walls.sigma[walls.walls.wall[piece[row]]], np.full(len(road), ground_sigma)])
    return _distributions(np.concatenate([points, road]), np.concatenate([normal, up]), sigma, cell)[0]


def _distributions(points: np.ndarray, normal: np.ndarray, sigma: np.ndarray, cell: float
                   ) -> tuple[NdtMap, np.ndarray]:
    """Map of distributions of points (m, d) on surfaces, and the number of each point's distribution."""
    dimensions = points.shape[1]
    origin = (np.floor(points.min(axis=0) / cell) - 2) * cell
    local = points - origin
    shape = tuple((np.floor(local.max(axis=0) / cell).astype(int) + 3).tolist())
    flat = np.ravel_multi_index(np.floor(local / cell).astype(np.int64).T, shape)
    filled, index = np.unique(flat, return_inverse=True)
    index = index.ravel()
    count = np.bincount(index)
    mean = np.stack([np.bincount(index, local[:, a]) / count for a in range(dimensions)], axis=1)
    off = local - mean[index]
    covariance = np.empty((len(filled), dimensions, dimensions))
    for a in range(dimensions):
        for b in range(a, dimensions):
            scatter = off[:, a] * off[:, b] + sigma ** 2 * normal[:, a] * normal[:, b]
            covariance[:, a, b] = covariance[:, b, a] = np.bincount(index, scatter) / count
    values, vectors = np.linalg.eigh(covariance)
    # Ends of walls are no better known than walls: a cell with little of a wall does not pin it along itself.
    least = np.maximum(np.bincount(index, sigma ** 2) / count, _LEAST ** 2)
    inverse = np.einsum("nij,nj,nkj->nik", vectors, 1.0 / np.maximum(values, least[:, None]), vectors)
    number = np.full(math.prod(shape), -1, dtype=np.int32)
    number[filled] = np.arange(len(filled), dtype=np.int32)
    return NdtMap(cell, origin, shape, number, mean, inverse), index
