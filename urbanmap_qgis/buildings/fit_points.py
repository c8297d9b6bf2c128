"""The points that a model is measured against: all that can be roof, whether or not a roof was made of them."""

from __future__ import annotations

import numpy as np
import shapely

from .roofs.roof_surface import roof_surface

MAX_ROUGHNESS = 0.3
"""Deviation (m) from the plane around it up to which a point that no roof took can still be one."""

MIN_HEIGHT = 2.0
"""Height (m) over the ground below which such a point is no roof."""


def candidate_points(x: np.ndarray, y: np.ndarray, z: np.ndarray, on_roof: np.ndarray, classed: np.ndarray,
                     outline: shapely.Geometry, ground: float) -> np.ndarray:
    """Mask (n,) of a building's points that can be roof.

    Points of roofs, and those in the outline well above the ground that the cloud classes as building or that lie on
    a smooth surface: a model that left a part of its building out must not be measured on the rest
    alone.

    Parameters
    ----------
    x, y, z : (n,) m.
    on_roof : (n,) whether a roof took the point.
    classed : (n,) whether it is of class 6.
    ground : height of the ground, m; NaN where unknown.
    """
    shapely.prepare(outline)
    inside = shapely.contains_xy(outline, x, y)
    high = z >= ground + MIN_HEIGHT if np.isfinite(ground) else np.ones(len(z), bool)
    result = on_roof | (inside & high & classed)
    left = inside & high & ~result
    if not left.any():
        return result
    use = np.flatnonzero(high)
    density = max(np.count_nonzero(inside & high), 1) / max(outline.area, 1.0)
    surface = roof_surface(x[use], y[use], z[use], outline, density)
    smooth = (surface.roughness <= MAX_ROUGHNESS)
    result[use] |= left[use] & smooth.ravel()[surface.cell_of_point]
    return result
