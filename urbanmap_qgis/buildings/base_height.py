"""Where a building meets the ground."""

from __future__ import annotations

import numpy as np
import shapely

from ..geometry.grid import Grid
from ..geometry.sampling import sample

STEP = 1.0
"""Distance (m) at most between the places along an outline where the ground is looked up."""


def outline_ground(polygons: np.ndarray, grid: Grid, heights: np.ndarray) -> np.ndarray:
    """Lowest ground height (n,) along each outline, m: walls that go down to it leave no gap.

    Parameters
    ----------
    polygons : (n,) outlines, may be missing.
    grid, heights : ground heights (rows, columns), m; NaN where unknown.

    Returns NaN for an outline off the raster.
    """
    lowest = np.full(len(polygons), np.nan)
    known = np.flatnonzero(~shapely.is_missing(polygons))
    lines = shapely.segmentize(shapely.boundary(polygons[known]), STEP)
    places, owner = shapely.get_coordinates(lines, return_index=True)
    found = sample(grid, np.asarray(heights, dtype=np.float64), places[:, 0], places[:, 1])
    use = np.isfinite(found)
    best = np.full(len(known), np.inf)
    np.minimum.at(best, owner[use], found[use])
    lowest[known] = np.where(np.isfinite(best), best, np.nan)
    return lowest
