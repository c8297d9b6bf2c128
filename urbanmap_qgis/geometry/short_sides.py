"""Sides too short for a city model taken out of surfaces that share their borders, alike in all of them.

Source: Project PLATEAU, standard product specification of 3D city models 5.0, 6.3.2 L07: neighbouring vertices lie
0.01 m apart at least.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

import numpy as np
import shapely
from scipy.spatial import cKDTree

SHORTEST = 0.012
"""m; the specification's centimetre, and what coordinates are rounded by."""

_ROUNDS = 12  # each at least halves the corners of a dense curve

Corner = tuple[float, float]


def without_short_sides(polygons: Sequence[shapely.Polygon]) -> list[shapely.Polygon]:
    """The polygons with corners nearer than `SHORTEST` that follow each other made one, wherever they are corners.

    Needles go: corners between two as near as that, and thin parts of a ring between two such. What would not be valid
    any more by it keeps the corners that spoil it, and so do those that share them.

    Parameters
    ----------
    polygons : m; they may share corners to the bit.
    """
    made, kept = [_without_needles(polygon) for polygon in polygons], set()
    for _ in range(_ROUNDS):
        moves = _moves(made, kept)
        if not moves:
            break
        changed = [_without_spikes(_moved(polygon, moves)) for polygon in made]
        spoilt = {corner for polygon, other in zip(made, changed) if not _whole(other)
                  for corner in _spoiling(polygon, moves)}
        kept |= spoilt | {moves[corner] for corner in spoilt}
        if not spoilt:
            made = changed
    return made


def without_short_edges(faces: Sequence[shapely.Polygon]) -> list[shapely.Polygon | None]:
    """Faces of a plane that share all their borders to the bit, likewise; a face that is no wider goes into those
    beside it (None). All stay as they are where they would lie over each other.

    Parameters
    ----------
    faces : m, with corners wherever another's border ends.
    """
    made: list[shapely.Polygon | None] = list(faces)
    for _ in range(_ROUNDS):
        there = [face for face in made if face is not None]
        moves = _moves(there, set())
        if not moves:
            break
        made = [face and _moved(face, moves) for face in made]
    left = [face for face in made if face is not None]
    if not all(map(_whole, left)):
        return list(faces)
    overlap = sum(face.area for face in left) - shapely.union_all(left).area
    return made if abs(overlap) < SHORTEST**2 else list(faces)


def _corners(polygon: shapely.Polygon) -> Iterable[Corner]:
    return map(tuple, shapely.get_coordinates(polygon).tolist())


def _moves(polygons: Sequence[shapely.Polygon], kept: set[Corner]) -> dict[Corner, Corner]:
    """Where corners go to: the corner of more surfaces stays; of a chain of short sides every other one."""
    count = Counter(corner for polygon in polygons for corner in set(_corners(polygon)))
    short: dict[tuple[Corner, Corner], float] = {}
    for polygon in polygons:
        for ring in (polygon.exterior, *polygon.interiors):
            places = shapely.get_coordinates(ring)[:-1]
            for beside in (np.roll(places, -1, axis=0), np.roll(places, -2, axis=0)):
                length = np.hypot(*(beside - places).T)
                for k in np.flatnonzero((length > 0) & (length < SHORTEST)).tolist():
                    one, other = sorted((tuple(places[k].tolist()), tuple(beside[k].tolist())),
                                        key=lambda corner: (-count[corner], corner))
                    short[one, other] = float(length[k])
    moves: dict[Corner, Corner] = {}
    touched = set(kept)
    for one, other in sorted(short, key=lambda pair: (short[pair], pair)):
        if one not in touched and other not in touched:
            moves[other] = one
            touched |= {one, other}
    return moves


def _moved(polygon: shapely.Polygon, moves: dict[Corner, Corner]) -> shapely.Polygon | None:
    """The polygon with its corners moved, without holes of which nothing is left; itself where none does, None where
    nothing of its outline would be left."""
    if not any(corner in moves for corner in _corners(polygon)):
        return polygon
    rings = []
    for ring in (polygon.exterior, *polygon.interiors):
        corners = [moves.get(corner, corner) for corner in map(tuple, shapely.get_coordinates(ring).tolist())]
        rings.append([corner for corner, before in zip(corners[1:], corners[:-1]) if corner != before])
    return _of_rings(rings)


def _of_rings(rings: Sequence[list[Corner]]) -> shapely.Polygon | None:
    """A polygon of its outline and holes, without the holes of fewer than three corners; None without an outline."""
    if len(rings[0]) < 3:
        return None
    return shapely.Polygon(rings[0], [ring for ring in rings[1:] if len(ring) > 2])


def _spoiling(polygon: shapely.Polygon, moves: dict[Corner, Corner]) -> set[Corner]:
    """Corners whose move alone spoils a polygon that all moves spoil; all that move where none does alone."""
    there = {corner for corner in _corners(polygon) if corner in moves}
    alone = {corner for corner in there if not _whole(_without_spikes(_moved(polygon, {corner: moves[corner]})))}
    return alone or there


def _without_needles(polygon: shapely.Polygon) -> shapely.Polygon:
    """The polygon without thin parts between two corners as near to each other as a side too short; itself where it
    would not be valid any more."""
    rings, found = [], False
    for ring in (polygon.exterior, *polygon.interiors):
        places = list(map(tuple, shapely.get_coordinates(ring)[:-1].tolist()))
        while len(places) > 3 and (less := _less_a_needle(places)) is not None:
            places, found = less, True
        rings.append(places)
    made = _of_rings(rings) if found else polygon
    return made if _whole(made) else polygon


def _less_a_needle(places: list[Corner]) -> list[Corner] | None:
    """A ring without one needle, of which the two corners at its foot stay; None without such. What is no longer than
    a few short sides is a dense curve and none."""
    pairs = cKDTree(places).query_pairs(SHORTEST, output_type="ndarray")
    at = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff([*places, places[0]], axis=0).T))])
    along = np.abs(np.diff(at[pairs], axis=1)[:, 0])
    apart = np.minimum(along, at[-1] - along) > 4.0 * SHORTEST
    for one, other in sorted(map(tuple, np.sort(pairs[apart], axis=1).tolist())):
        parts = places[one:other + 1], places[other:] + places[:one + 1]
        thin = [_thickness(part) < SHORTEST for part in parts]
        if any(thin) and not all(thin):
            return parts[thin.index(True) - 1]
    return None


def _without_spikes(polygon: shapely.Polygon | None) -> shapely.Polygon | None:
    """The polygon without corners whose border goes back the way it came, and without parts between two visits of one
    corner that are as thin: what a strip narrower than a side leaves."""
    if polygon is None or polygon.is_valid:
        return polygon
    rings = []
    for ring in (polygon.exterior, *polygon.interiors):
        places = list(map(tuple, shapely.get_coordinates(ring)[:-1].tolist()))
        while len(places) > 2 and (less := _less_a_thin_part(places)) is not None:
            places = less
        rings.append(places)
    return _of_rings(rings)


def _less_a_thin_part(places: list[Corner]) -> list[Corner] | None:
    """A ring without a part that begins and ends at one corner and is thinner than `SHORTEST`; None without such."""
    visits: dict[Corner, int] = {}
    for k, corner in enumerate(places):
        if corner in visits:
            parts = places[visits[corner]:k], places[k:] + places[:visits[corner]]
            thin = [_thickness(part) < SHORTEST for part in parts]
            if any(thin):
                return parts[thin.index(True) - 1]
        visits[corner] = k
    return None


def _thickness(ring: list[Corner]) -> float:
    """Twice the area of a ring over its length, m: about the width of a long strip."""
    if len(ring) < 3:
        return 0.0
    whole = shapely.make_valid(shapely.Polygon(ring))
    return 2.0 * whole.area / whole.length


def _whole(polygon: shapely.Polygon | None) -> bool:
    return polygon is not None and bool(polygon.is_valid)
