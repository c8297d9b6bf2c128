"""Ends of roads drawn on, so that a road that ends right beside a junction is seen as one of its arms.

Source: Project PLATEAU, standard working procedure of 3D city models, annex D, D.3.1.2.1: a junction is what roads meet
at. A neighbouring sheet holds the rest of a road that was cut off at a junction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from .road_axis import Ring
from .road_surface import GRID


@dataclass(frozen=True)
class EndLimits:
    """What the ends of roads are told by.

    Attributes
    ----------
    corner : least turn at each end of the edge that closes a road, degrees.
    both : least sum of the two, degrees.
    widest : longest edge that closes a road, in mean widths of the roads around it.
    around : roads so near are around it, in lengths of the edge.
    drawn_on : how far, in lengths of the edge: more than the depth of the least strip that is a road of its own.
    free : greatest share of what is drawn on that may lie on roads.
    """

    corner: float = 45.0
    both: float = 130.0
    widest: float = 1.5
    around: float = 4.0
    drawn_on: float = 2.5
    free: float = 0.05


LIMITS = EndLimits()


def with_ends_drawn_on(surface: shapely.Polygon) -> shapely.Polygon:
    """A valid polygon, m, with a strip at each edge that closes a road; itself where nothing can be drawn on."""
    strips = [strip for strip in _strips(surface)
              if shapely.area(shapely.intersection(strip, surface)) <= LIMITS.free * strip.area]
    if not strips:
        return surface
    whole = shapely.union_all([surface, *strips], grid_size=GRID)
    return whole if whole.geom_type == "Polygon" else surface


def _strips(surface: shapely.Polygon) -> list[shapely.Polygon]:
    ring = Ring(shapely.get_coordinates(shapely.geometry.polygon.orient(surface).exterior)[:-1])
    following = np.roll(ring.points, -1, axis=0)
    turn, next_turn = np.degrees(ring.turns), np.degrees(np.roll(ring.turns, -1))
    closes = (np.minimum(turn, next_turn) >= LIMITS.corner) & (turn + next_turn >= LIMITS.both)
    along = (following - ring.points) / ring.lengths[:, None]
    outwards = np.roll(along, 1, axis=0) - np.roll(along, -1, axis=0)  # as both sides of the road run
    outwards /= np.maximum(np.hypot(*outwards.T), GRID)[:, None]
    strips = []
    for number in np.flatnonzero(closes):
        start, end, length = ring.points[number], following[number], ring.lengths[number]
        if length <= LIMITS.widest * _width_around(surface, (start + end) / 2.0, LIMITS.around * length):
            step = outwards[number] * length * LIMITS.drawn_on
            strips.append(shapely.Polygon([start, end, end + step, start + step]))
    return strips


def _width_around(surface: shapely.Polygon, point: np.ndarray, radius: float) -> float:
    """Mean width of the roads around a point, m: twice their area by the length of their edges."""
    circle = shapely.buffer(shapely.points(point), radius)
    edges = shapely.length(shapely.intersection(shapely.boundary(surface), circle))
    return 2.0 * shapely.area(shapely.intersection(surface, circle)) / edges
