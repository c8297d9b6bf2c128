"""Which ground a frame truly sees (J 3.2.1.1, in the plane of the ground instead of the image).

Seen from the projection centre, a point at the horizontal distance r and the height z lies off the nadir by the tangent
r / (z_camera - z). A point is hidden as soon as anything nearer to the nadir in the same direction has a larger
tangent. So one running maximum along each direction tells for all points at once.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from ...geometry.grid import Grid

STEP = 0.5  # of a cell: distance between the samples along a direction, and between directions far out
# cells: what stands nearer than this before a point does not hide it; keeps cells from hiding themselves
CLEAR = 1.5
MAX_DIRECTIONS = 30_000  # cv2.remap takes images of up to 32766 rows
BATCH = 512


@dataclass(frozen=True)
class _PolarGrid:
    """Directions and distances round the nadir in which heights are looked at.

    Attributes
    ----------
    first, turn : radians, direction of row 0 and from row to row.
    directions : rows.
    near, step : m, distance of column 0 and from column to column.
    distances : columns.
    """

    first: float
    turn: float
    directions: int
    near: float
    step: float
    distances: int

    @classmethod
    def round(cls, x: float, y: float, grid: Grid) -> _PolarGrid:
        """The fan from a nadir that covers a grid."""
        left, bottom, right, top = grid.bounds
        aside = max(left - x, 0.0, x - right), max(bottom - y, 0.0, y - top)
        near = math.hypot(*aside)
        far = math.hypot(max(abs(left - x), abs(right - x)), max(abs(bottom - y), abs(top - y)))
        step = STEP * grid.cell
        turn = max(step / far, 2 * math.pi / MAX_DIRECTIONS)
        if near > 0:
            middle = math.atan2((bottom + top) / 2 - y, (left + right) / 2 - x)
            corners = np.arctan2([bottom - y, bottom - y, top - y, top - y], [left - x, right - x] * 2) - middle
            corners = (corners + math.pi) % (2 * math.pi) - math.pi
            first, last = middle + corners.min() - turn, middle + corners.max() + turn
        else:
            first, last = -math.pi - turn, math.pi + turn
        return cls(first, turn, math.ceil((last - first) / turn) + 1, near, step,
                   math.ceil((far - near) / step) + 2)

    def nodes(self, rows: slice) -> tuple[np.ndarray, np.ndarray]:
        """East and north of the samples of some directions from the nadir, (rows, distances), m."""
        angle = (self.first + self.turn * np.arange(rows.start, rows.stop))[:, None]
        distance = self.near + self.step * np.arange(self.distances)
        return np.cos(angle) * distance, np.sin(angle) * distance

    def project(self, east: np.ndarray, north: np.ndarray, distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Column and row (float32) of points at other distances in their own direction."""
        turned = (np.arctan2(north, east) - self.first) % (2 * math.pi)
        return (((distance - self.near) / self.step).astype(np.float32), (turned / self.turn).astype(np.float32))


def off_ground(surface: np.ndarray, ground: np.ndarray, threshold: float) -> np.ndarray:
    """Where the surface stands higher than `threshold` metres above the ground (J: 5 m, so that vehicles do not)."""
    with np.errstate(invalid="ignore"):
        return surface - ground > threshold


def visible_ground(centre: np.ndarray, grid: Grid, ground: np.ndarray, surface: np.ndarray | None = None,
                   threshold: float = 5.0) -> np.ndarray:
    """Whether a camera has a free line of sight to the ground in each cell.

    Parameters
    ----------
    centre : (3,) projection centre, m.
    grid : of both rasters.
    ground : (rows, columns) heights, NaN where unknown.
    surface : heights of the DSM, NaN where unknown; what stands higher than `threshold` above the ground hides what
        lies behind it. Without it only the ground hides ground.

    Returns
    -------
    (rows, columns) bool; False where the height of the ground is unknown. Ground under a roof counts as visible unless
    something nearer to the nadir hides it: see `off_ground` for the roofs themselves.
    """
    x, y = grid.centres()
    east, north = (x - centre[0]), (y - centre[1])
    distance = np.hypot(east[None, :], north[:, None])
    bare = _tangent(distance, ground, centre[2])
    standing = bare if surface is None else np.where(off_ground(surface, ground, threshold),
                                                     _tangent(distance, surface, centre[2]), bare)
    standing = np.where(np.isnan(standing), 0.0, standing).astype(np.float32)
    fan = _PolarGrid.round(float(centre[0]), float(centre[1]), grid)
    highest = _running_maximum(fan, standing, grid, east[0], north[0])
    seen = np.empty(grid.shape, bool)
    for top in range(0, grid.rows, BATCH):
        rows = slice(top, min(top + BATCH, grid.rows))
        column, row = fan.project(east[None, :], north[rows, None], distance[rows] - CLEAR * grid.cell)
        before = cv2.remap(highest, column, row, cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT, borderValue=0.0)
        with np.errstate(invalid="ignore"):
            seen[rows] = bare[rows] >= before
    return seen


def _tangent(distance: np.ndarray, height: np.ndarray, camera_height: float) -> np.ndarray:
    """Tangent of the angle off the nadir; infinite for what reaches up to the camera, NaN for unknown heights."""
    below = camera_height - height
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(below > 0, distance / below, np.where(np.isnan(height), np.nan, np.inf))


def _running_maximum(fan: _PolarGrid, standing: np.ndarray, grid: Grid, east: float, north: float) -> np.ndarray:
    """Largest tangent from the nadir up to each sample of the fan, (directions, distances) float32.

    `east`, `north` are the centre of the grid's first cell from the nadir.
    """
    highest = np.empty((fan.directions, fan.distances), np.float32)
    for first in range(0, fan.directions, BATCH):
        rows = slice(first, min(first + BATCH, fan.directions))
        node_east, node_north = fan.nodes(rows)
        sampled = cv2.remap(standing, ((node_east - east) / grid.cell).astype(np.float32),
                            ((north - node_north) / grid.cell).astype(np.float32), cv2.INTER_NEAREST,
                            borderMode=cv2.BORDER_CONSTANT, borderValue=0.0)
        np.maximum.accumulate(sampled, axis=1, out=highest[rows])
    return highest
