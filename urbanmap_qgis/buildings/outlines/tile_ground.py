"""The ground of a tile, from its own points where none is given, and heights above it."""

from __future__ import annotations

import numpy as np
import shapely

from ...errors import InsufficientDataError
from ...geometry.grid import Grid
from ...geometry.sampling import sample
from ...progress import Progress
from ...terrain.surface import ground_raster
from .decks import ground_without_decks

BUFFER = 60.0
"""Reach (m) beyond a tile within which points and outlines are seen: wide enough for ground round blocks."""

_CELL = 1.0
"""Side (m) of the cells of the ground heights that are made where none are given."""


def ground_of_points(x: np.ndarray, y: np.ndarray, z: np.ndarray, classes: np.ndarray,
                     polygons: np.ndarray, progress: Progress) -> tuple[Grid, np.ndarray] | None:
    """Ground heights of a tile from its own points, None where they hold no ground."""
    if not len(x):
        return None
    x_min, y_min, x_max, y_max = shapely.total_bounds(polygons)
    grid = Grid.covering(max(x.min(), x_min - BUFFER), max(y.min(), y_min - BUFFER),
                         min(x.max(), x_max + BUFFER), min(y.max(), y_max + BUFFER), _CELL)
    try:
        return grid, ground_raster(x, y, z, classes if classes.any() else None, grid, progress=progress)
    except InsufficientDataError:
        return None


def heights_above(x: np.ndarray, y: np.ndarray, z: np.ndarray, ground: tuple[Grid, np.ndarray],
                  outlines: np.ndarray, density: float) -> np.ndarray:
    """(n,) m of points above the ground, bridge decks at the outlines left out of it."""
    return z - ground_without_decks(outlines, x, y, z, sample(*ground, x, y), density)
