"""Decks and podiums inside outlines that a ground filter took for ground: the street round them tells the ground."""

from __future__ import annotations

import numpy as np
import shapely

from ..point_assignment import PlanIndex

STREET_WIDTH = 3.0
"""Width (m) of the strip round an outline whose ground is that of the street."""

STREET_SHARE = 0.9
"""Share of the strip's ground below which the street is taken to lie: a slope's upper side is street, too."""

MAX_RISE = 1.5
"""Height (m) over the street from which ground inside an outline is a deck or a podium."""

MIN_AREA = 16.0
"""Area (m2) of such ground from which it is corrected."""


def ground_without_decks(outlines: np.ndarray, x: np.ndarray, y: np.ndarray, z: np.ndarray, ground: np.ndarray,
                         density: float) -> np.ndarray:
    """Ground height (n,) under each point, m, put to the street's where it runs over a deck inside an outline.

    Parameters
    ----------
    outlines : polygons at their right places; missing ones are passed over.
    x, y, z : (n,) all points, m.
    ground : (n,) height of the ground as filtered, m.
    density : points a m2.
    """
    result = ground.copy()
    outlines = outlines[~shapely.is_missing(outlines)]
    levels = _street_levels(outlines, x, y, ground, np.abs(z - ground) < MAX_RISE)
    if np.isnan(levels).all():
        return result
    high = np.flatnonzero(ground > np.nanmin(levels) + MAX_RISE)
    index = PlanIndex(x[high], y[high])
    for outline, level in zip(outlines, levels.tolist()):
        inside = high[index.inside(outline)]
        raised = inside[ground[inside] > level + MAX_RISE]
        seen = np.count_nonzero(np.abs(z[raised] - ground[raised]) < MAX_RISE)
        if len(raised) and seen >= MIN_AREA * density:
            result[raised] = level
    return result


def _street_levels(outlines: np.ndarray, x: np.ndarray, y: np.ndarray, ground: np.ndarray,
                   on_ground: np.ndarray) -> np.ndarray:
    """Height (k,) of the street round each outline from the points on the ground (n,), m; NaN without any."""
    points = np.flatnonzero(on_ground)
    index = PlanIndex(x[points], y[points])
    levels = np.full(len(outlines), np.nan)
    for row, strip in enumerate(shapely.difference(shapely.buffer(outlines, STREET_WIDTH), outlines)):
        street = ground[points[index.inside(strip)]]
        if len(street):
            levels[row] = np.quantile(street, STREET_SHARE)
    return levels
