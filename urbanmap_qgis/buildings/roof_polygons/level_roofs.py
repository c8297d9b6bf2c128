"""A building's plan divided among its level roofs, without gaps and with common edges (J 5.3.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.grid import Grid
from ...geometry.tolerances import SIGMA_OF_MAD
from ...settings.buildings import MAXIMUM, PolygonParameters
from ..model_status import LOST_AREA, LOST_ROOFS
from ..polygons.roof_plan import partition_roofs
from ..quality import PARAPET_REACH
from .polygon_rows import DrawnRoof, RoofedBuilding, RoofPolygons

CELL = (0.25, 1.0)
"""Least and greatest cell (m) of the raster on which a plan is divided; the density sets it between them."""


@dataclass(frozen=True)
class LevelRoofLimits:
    """Limits of the heights of level roofs, each with its unit."""

    # A flat roof inside a parapet: so many points well inside, of no more spread (m, robust standard deviation),
    # and so much (m) below the middle of all its points.
    min_inner_points: int = 10
    flat_spread: float = 0.15
    min_parapet: float = 0.5


LIMITS = LevelRoofLimits()


def level_roofs(building: RoofedBuilding, parameters: PolygonParameters) -> RoofPolygons:
    """The whole outline divided among its roofs: no gaps, common edges."""
    table = RoofPolygons()
    on_roof = building.roof > 0
    (x, y, z), roof = (building.xyz[on_roof, axis] for axis in range(3)), building.roof[on_roof]
    cell = float(np.clip(1 / math.sqrt(max(len(x), 1) / building.outline.area), *CELL))
    grid = Grid.covering(*building.outline.bounds, cell)
    partition = partition_roofs(building.outline, grid, np.zeros(grid.shape, np.int32), _cell_heights(grid, x, y, z),
                                points=(x, y, roof))
    lost = _has_lost_roof(building.outline, x, y, roof, partition.roof_numbers)
    status = building.stated(LOST_ROOFS if lost else partition.status)
    levels = {roof_id: roof_height(z[roof == roof_id], parameters) for roof_id in np.unique(roof).tolist()}
    for place, (polygon, roof_id) in enumerate(zip(partition.polygons, partition.roof_numbers.tolist())):
        members = roof == roof_id
        shapely.prepare(polygon)
        members[members] = shapely.contains_xy(polygon, x[members], y[members])
        height = _inner_height(polygon, x[members], y[members], z[members],
                               parameters) if members.any() else levels[roof_id]
        top = float(z[members].max()) if members.any() else height
        table.add(building.number, DrawnRoof(roof_id, polygon, height, top, z[members], status,
                                             float(partition.coverage[place]), float(partition.boundary_rms[place])))
    return table


def _has_lost_roof(outline: shapely.Geometry, x: np.ndarray, y: np.ndarray, roof: np.ndarray,
                   drawn: np.ndarray) -> bool:
    """Whether a roof with points on `LOST_AREA` m2 or more of the outline has no polygon."""
    numbers = np.setdiff1d(roof, drawn)
    if not len(numbers):
        return False
    shapely.prepare(outline)
    inside = shapely.contains_xy(outline, x, y)
    return bool(np.bincount(roof[inside]).max(where=np.isin(np.arange(roof[inside].max(initial=0) + 1), numbers),
                                              initial=0) >= LOST_AREA * inside.sum() / outline.area)


def _cell_heights(grid: Grid, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Mean height of the points in each cell, NaN where there are none."""
    row, column, inside = grid.cells(x, y)
    cell = (row * grid.columns + column)[inside]
    size = grid.rows * grid.columns
    count = np.bincount(cell, minlength=size)
    total = np.bincount(cell, weights=z[inside], minlength=size)
    mean = np.full(size, np.nan)
    np.divide(total, count, out=mean, where=count > 0)
    return mean.reshape(grid.shape)


def roof_height(z: np.ndarray, parameters: PolygonParameters) -> float:
    """Height of a roof from its points' heights `z`, m."""
    return float(z.max() if parameters.height == MAXIMUM else np.median(z))


def _inner_height(polygon: shapely.Polygon, x: np.ndarray, y: np.ndarray, z: np.ndarray,
                  parameters: PolygonParameters) -> float:
    """Height of a roof from its points, m. A flat roof inside a parapet has the height of its inner points."""
    height = roof_height(z, parameters)
    if parameters.height == MAXIMUM:
        return height
    inner = shapely.buffer(polygon, -PARAPET_REACH)
    shapely.prepare(inner)
    heights = z[shapely.contains_xy(inner, x, y)]
    if len(heights) < LIMITS.min_inner_points:
        return height
    level = float(np.median(heights))
    flat = SIGMA_OF_MAD * float(np.median(np.abs(heights - level))) < LIMITS.flat_spread
    return level if flat and height - level >= LIMITS.min_parapet else height
