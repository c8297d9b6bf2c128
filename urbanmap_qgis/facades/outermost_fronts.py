"""Facades where the outermost front is wanted: walls behind balconies end where the balconies begin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from .standing_before import BALCONY, RECESS, WALL, PlacedWall
from .wall_contours import Contour, in_plane, on_map

BEFORE = 0.3  # Distance from which on a balcony stands before a wall, m.
FACING = 0.94  # Cosine of the greatest angle between both.
NARROW = 0.5  # Pieces of a wall narrower than this, m, go with what lies beside them.

Kind = tuple[str, float]


def cut_behind_balconies(placed: Sequence[PlacedWall], edges: Sequence[int], kinds: Sequence[Kind]
                         ) -> tuple[list[PlacedWall], list[int], list[Kind]]:
    """Walls with their edges and kinds (with the distance before the facade, m), cut at the ends of balconies.

    What lies behind balconies is a recess; what lies beside them stays wall.
    """
    balconies = [one for one, (kind, _) in zip(placed, kinds) if kind == BALCONY]
    cut: list[tuple[PlacedWall, int, Kind]] = []
    for one, edge, kind in zip(placed, edges, kinds):
        strips = _strips(one, balconies) if kind[0] == WALL else None
        if strips is None or strips.is_empty:
            cut.append((one, edge, kind))
            continue
        cut += [(piece, edge, kind) for piece in _pieces(one, shapely.difference(one.contour.polygon, strips))]
        cut += [(piece, edge, (RECESS, kind[1]))
                for piece in _pieces(one, shapely.intersection(one.contour.polygon, strips))]
    walls, numbers, found = zip(*cut)
    return list(walls), list(numbers), list(found)


def _strips(wall: PlacedWall, balconies: Sequence[PlacedWall]) -> shapely.Geometry:
    """Where balconies stand before a wall, as strips of its plane over its whole height."""
    left, low, right, high = wall.contour.polygon.bounds
    strips = []
    for balcony in balconies:
        if balcony.plane.normal @ wall.plane.normal < FACING:
            continue
        corners = shapely.get_coordinates(on_map(balcony.plane, shapely.box(*balcony.contour.polygon.bounds)),
                                          include_z=True)[:-1]
        if np.mean(wall.plane.distance(corners)) <= BEFORE:
            continue
        along = in_plane(wall.plane, corners)[:, 0]
        first, last = max(float(along.min()), left), min(float(along.max()), right)
        first = left if first - left < NARROW else first
        last = right if right - last < NARROW else last
        if last - first >= NARROW:
            strips.append(shapely.box(first, low - 1.0, last, high + 1.0))
    return shapely.union_all(strips)


def _pieces(wall: PlacedWall, shape: shapely.Geometry) -> list[PlacedWall]:
    """A wall's parts within a shape of its plane, each with its share of the points."""
    pieces = []
    for polygon in shapely.get_parts(shape):
        left, _, right, _ = polygon.bounds if not polygon.is_empty else (0.0,) * 4
        if polygon.geom_type == "Polygon" and right - left >= NARROW:
            given = wall.contour
            # Anticlockwise seen from in front, as contours are; cutting turns rings round.
            contour = Contour(orient(polygon), round(given.points * polygon.area / given.polygon.area), given.filled,
                              shapely.intersection(given.measured, polygon))
            pieces.append(replace(wall, contour=contour))
    return pieces
