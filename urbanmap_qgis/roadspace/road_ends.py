"""Ends of roads drawn on, so that a road that ends right beside a junction is seen as one of its arms.

Source: Project PLATEAU, standard working procedure of 3D city models, annex D, D.3.1.2.1: a junction is what roads meet
at. A neighbouring sheet holds the rest of a road that was cut off at a junction.
"""

from __future__ import annotations

import numpy as np
import shapely

from .road_axis import Ring
from .road_surface import GRID

# What the ends of roads are told by.
CORNER = 45.0  # least turn at each end of the edge that closes a road, degrees.
BOTH = 130.0  # least sum of the two, degrees.
WIDEST = 1.5  # longest edge that closes a road, in mean widths of the roads around it.
AROUND = 4.0  # roads so near are around it, in lengths of the edge.
DRAWN_ON = 2.5  # how far, in lengths of the edge: more than the depth of the least strip that is a road of its own.
FREE = 0.05  # greatest share of what is drawn on that may lie on roads.


def with_ends_drawn_on(surface: shapely.Polygon) -> shapely.Polygon:
    """A valid polygon, m, with a strip at each edge that closes a road; itself where nothing can be drawn on."""
    strips = [strip for strip in _strips(surface)
              if shapely.area(shapely.intersection(strip, surface)) <= FREE * strip.area]
    if not strips:
        return surface
    whole = shapely.union_all([surface, *strips], grid_size=GRID)
    return whole if whole.geom_type == "Polygon" else surface


def _strips(surface: shapely.Polygon) -> list[shapely.Polygon]:
    ring = Ring(shapely.get_coordinates(shapely.geometry.polygon.orient(surface).exterior)[:-1])
    following = np.roll(ring.points, -1, axis=0)
    turn, next_turn = np.degrees(ring.turns), np.degrees(np.roll(ring.turns, -1))
    closes = (np.minimum(turn, next_turn) >= CORNER) & (turn + next_turn >= BOTH)
    along = (following - ring.points) / ring.lengths[:, None]
    outwards = np.roll(along, 1, axis=0) - np.roll(along, -1, axis=0)  # as both sides of the road run
    outwards /= np.maximum(np.hypot(*outwards.T), GRID)[:, None]
    strips = []
    for number in np.flatnonzero(closes):
        start, end, length = ring.points[number], following[number], ring.lengths[number]
        if length <= WIDEST * _width_around(surface, (start + end) / 2.0, AROUND * length):
            step = outwards[number] * length * DRAWN_ON
            strips.append(shapely.Polygon([start, end, end + step, start + step]))
    return strips


def _width_around(surface: shapely.Polygon, point: np.ndarray, radius: float) -> float:
    """Mean width of the roads around a point, m: twice their area by the length of their edges."""
    circle = shapely.buffer(shapely.points(point), radius)
    edges = shapely.length(shapely.intersection(shapely.boundary(surface), circle))
    return 2.0 * shapely.area(shapely.intersection(surface, circle)) / edges
