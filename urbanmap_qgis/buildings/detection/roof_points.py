"""Roof points of one tile of a cloud, with their heights above the ground and the steps down to it."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...errors import InsufficientDataError
from ...geometry.grid import Grid
from ...geometry.sampling import sample
from ...terrain.surface import ground_raster
from ...wording import mark
from .roof_surfaces import SUREST, roof_odds

BUILDING_CLASS = 6
LEAST_HEIGHT = 1.5
"""Height (m) over the ground of the lowest points that can be roofs: below stand cars and hedges."""
CONTEXT = 10.0
"""Reach (m) about a tile of the points above the ground that are worked on with it."""
RIM = 2.0
"""Distance (m) from a roof point within which the ground beside it is looked for."""

CLASSES, ECHOES, SURFACES = mark("classes"), mark("echoes"), mark("surfaces")
"""How roofs are told: by class 6, by surfaces and the echoes of pulses, or by surfaces alone."""

POINT = np.dtype([("x", "f8"), ("y", "f8"), ("z", "f8"), ("code", "u1"), ("last", "?")])
"""A point of the cloud; `last`: the last echo of its pulse."""
ROOF = np.dtype([("x", "f8"), ("y", "f8"), ("z", "f8"), ("height", "f8"), ("step", "f8"), ("odds", "f8"),
                 ("roof", "?")])
"""A point on a roof or on the ground: metres, `height` above the ground, `step` down to the nearest ground point (NaN
without any near), and natural logarithm of the odds that it is a roof's."""


Box = tuple[float, float, float, float]


def roofs_of_tile(tile: tuple[np.ndarray, Box, tuple[Grid, np.ndarray] | None], told_by: str, density: float,
                  with_ground: bool = False) -> np.ndarray:
    """Points of a tile that lie on roofs (n,), as records `ROOF`, and last echoes on the ground where wanted.

    Parameters
    ----------
    tile : points (`POINT`) of a tile and about it, its bounds (m), and ground heights where they are given.
    told_by : `CLASSES`, `ECHOES` or `SURFACES`.
    density : last echoes/m2.
    """
    points, box, ground = tile
    above = _heights(points, ground)
    near = _within(points, box, CONTEXT)
    high = near & (above >= LEAST_HEIGHT)
    if told_by == CLASSES:
        high &= points["code"] == BUILDING_CLASS
    candidates = points[high]
    place = np.column_stack([candidates["x"] - box[0], candidates["y"] - box[1], candidates["z"]])
    odds = (np.full(len(candidates), SUREST) if told_by == CLASSES else
            roof_odds(place, candidates["last"], told_by == ECHOES, density))
    roof = (odds > 0) & _within(candidates, box, 0.0)
    low = near & (above < LEAST_HEIGHT) & points["last"]
    roofs = _records(candidates[roof], above[high][roof], odds[roof], True)
    roofs["step"] = _steps(roofs, points[low])
    if not with_ground:
        return roofs
    low &= _within(points, box, 0.0)
    return np.concatenate([roofs, _records(points[low], above[low], -SUREST, False)])


def _records(points: np.ndarray, height: np.ndarray, odds: np.ndarray | float, roof: bool) -> np.ndarray:
    """Records `ROOF` of points."""
    result = np.empty(len(points), ROOF)
    for name in ("x", "y", "z"):
        result[name] = points[name]
    result["height"], result["odds"], result["roof"], result["step"] = height, odds, roof, np.nan
    return result


def _heights(points: np.ndarray, ground: tuple[Grid, np.ndarray] | None) -> np.ndarray:
    """Heights (n,) of points above the ground, m; NaN where it is not known."""
    x, y, z = points["x"], points["y"], points["z"]
    if not len(points):
        return np.zeros(0)
    if ground is None:
        grid = Grid.covering(x.min(), y.min(), x.max(), y.max(), 1.0)
        try:
            ground = grid, ground_raster(x, y, z, points["code"] if points["code"].any() else None, grid)
        except InsufficientDataError:
            return np.full(len(points), np.nan)
    return z - sample(*ground, x, y)


def _steps(roofs: np.ndarray, ground: np.ndarray) -> np.ndarray:
    """Steps (n,) from roof points down to the nearest of some ground points, m; NaN where none is near."""
    if not len(ground) or not len(roofs):
        return np.full(len(roofs), np.nan)
    tree = cKDTree(np.column_stack([ground["x"], ground["y"]]))
    away, nearest = tree.query(np.column_stack([roofs["x"], roofs["y"]]), distance_upper_bound=RIM)
    low = ground["z"][np.minimum(nearest, len(ground) - 1)]
    return np.where(np.isfinite(away), roofs["z"] - low, np.nan)


def _within(points: np.ndarray, box: Box, reach: float) -> np.ndarray:
    """Which points (n,) lie in a box (m) or within a reach of it."""
    x, y = points["x"], points["y"]
    return (x >= box[0] - reach) & (x < box[2] + reach) & (y >= box[1] - reach) & (y < box[3] + reach)
