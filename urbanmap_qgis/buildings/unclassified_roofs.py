"""Roofs that a classification has left out: smooth surfaces over a building that hold no point of class 6."""

from __future__ import annotations

import numpy as np
import shapely
from scipy import ndimage

from ..settings.buildings import RoofParameters
from .roofs.roof_surface import roof_surface

MAX_ROUGHNESS = 0.15
"""Deviation (m) from the plane around it up to which a place is a roof; crowns of trees have 0.3 m and more."""

MIN_AREA = 9.0
"""Area (m2) of the smallest such roof: less may be a car on a deck, or furniture."""


def unclassified_roof_points(x: np.ndarray, y: np.ndarray, z: np.ndarray, several: np.ndarray,
                             classed_x: np.ndarray, classed_y: np.ndarray, outline: shapely.Geometry,
                             density: float) -> np.ndarray:
    """Mask (n,) of high points without a building class that lie on roofs of their own.

    Parameters
    ----------
    x, y, z : (n,) points high above the ground inside the outline, not of class 6, m.
    several : (n,) whether the pulse had several returns.
    classed_x, classed_y : (k,) points of class 6 of the building: where they lie the classification knew the roof.
    density : points a m2.
    """
    if len(x) < MIN_AREA * density / 2:
        return np.zeros(len(x), bool)
    surface = roof_surface(x, y, z, outline, density, several)
    grid = surface.grid
    row, column, on_grid = grid.cells(classed_x, classed_y)
    known = np.zeros(grid.shape, bool)
    known[row[on_grid], column[on_grid]] = True
    smooth = ((surface.count > 0) & (surface.roughness <= MAX_ROUGHNESS) & ~known
              & ~surface.trees(RoofParameters().max_roughness))
    closed = ndimage.binary_closing(np.pad(smooth, 1), np.ones((2, 2)))[1:-1, 1:-1] & ~known
    part, _ = ndimage.label(closed)
    large = np.bincount(part.ravel()) * grid.cell**2 >= MIN_AREA
    large[0] = False
    return large[part].ravel()[surface.cell_of_point] & smooth.ravel()[surface.cell_of_point]
