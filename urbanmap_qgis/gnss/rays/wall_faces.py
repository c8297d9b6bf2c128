"""The walls of building models, as the rays of satellite signals meet them (J 5.6).

A model is a solid whose faces are given as polygons with heights (MultiPolygonZ, CityJSON), or an outline with the
height of its top and, if known, of its foot. Every upright face is cut into pieces that are straight in plan, with
a lower and an upper edge; pieces of a building that lie in one plane and face the same way make one wall: it is
the wall that is moved as a whole.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...errors import InputError
from ...wording import say

_UPRIGHT = 0.02
"""Vertical part of the unit normal of a face that still counts as a wall."""

_SHORTEST = 0.02
"""Edges shorter than this in plan are no walls, m."""

_SAME_DIRECTION = np.cos(np.radians(1.0))
_SAME_PLANE = 0.05
"""Pieces within 1 degree and 5 cm of one plane belong to one wall."""


@dataclass(frozen=True)
class WallPieces:
    """Pieces of walls. Walking from start to end, the building is on the left and the open on the right.

    Attributes
    ----------
    start, end : (n, 2) ends in plan, m.
    low, top : (n, 2) heights of the lower and upper edge at start and end, m; low is -inf where it is not known.
    normal : (n, 2) unit vector outwards.
    offset : (n,) normal . point for the points of the piece, m.
    building : (n,) row of the building.
    wall : (n,) number of the wall, from 0 over all buildings.
    """

    start: np.ndarray
    end: np.ndarray
    low: np.ndarray
    top: np.ndarray
    normal: np.ndarray
    offset: np.ndarray
    building: np.ndarray
    wall: np.ndarray

    def __len__(self) -> int:
        return len(self.offset)

    @property
    def count(self) -> int:
        """Number of walls (of which each has one or several pieces)."""
        return int(self.wall.max()) + 1 if len(self.wall) else 0


@dataclass(frozen=True)
class WallTable:
    """The walls, one row each.

    Attributes
    ----------
    building : (k,) row of the building.
    edge : (k,) number of the wall in its building, from 1.
    start, end : (k, 2) outermost ends in plan, m.
    normal : (k, 2) outwards.
    low, top : (k,) lowest and highest height, m; low is NaN where it is not known.
    """

    building: np.ndarray
    edge: np.ndarray
    start: np.ndarray
    end: np.ndarray
    normal: np.ndarray
    low: np.ndarray
    top: np.ndarray

    def __len__(self) -> int:
        return len(self.building)

    @property
    def length(self) -> np.ndarray:
        """(k,) length in plan between the outermost ends, m."""
        return np.linalg.norm(self.end - self.start, axis=1)


def building_walls(shapes: Sequence[shapely.Geometry | None], building: np.ndarray | None = None,
                   top: np.ndarray | None = None, low: np.ndarray | None = None) -> WallPieces:
    """Walls of building models.

    Parameters
    ----------
    shapes : (n,) faces of solids (MultiPolygonZ), or outlines (Polygon, MultiPolygon); None is passed over.
    building : (n,) which building a shape is part of (any whole numbers); each its own where not given.
    top, low : (n,) heights of outlines, m. An outline with z and without `top` has its top there. NaN in `low` means
        not known: the wall then reaches down without end.

    Raises
    ------
    InputError : there is no shape, or an outline has no height.
    """
    names = np.arange(len(shapes)) if building is None else np.asarray(building)
    rows = np.unique(names, return_inverse=True)[1].ravel()
    pieces, owner = [], []
    without = 0
    for number, shape in enumerate(shapes):
        if shape is None or shape.is_empty:
            continue
        if is_solid(shape):
            found = _solid_pieces(shape)
        else:
            heights = _outline_heights(shape, number, top, low)
            if heights is None:
                without += 1
                continue
            found = _outline_pieces(shape, *heights)
        pieces.append(found)
        owner.append(np.full(len(found), rows[number]))
    if without:
        raise InputError(say("{without} of {shapes_count} buildings have no heights: give solids, outlines with z, "
                             "or the field with the height of their tops.", without=without, shapes_count=len(shapes)))
    if not pieces or not sum(map(len, pieces)):
        raise InputError(say("The buildings have no walls: give solids or outlines with heights."))
    return _assembled(np.concatenate(pieces), np.concatenate(owner))


def is_solid(shape: shapely.Geometry) -> bool:
    """Whether a shape has upright faces: the faces of a solid, not an outline."""
    if not shape.has_z:
        return False
    return any(abs(_normal(_ring(part.exterior))[2]) < _UPRIGHT for part in shapely.get_parts(shape))


def wall_table(walls: WallPieces) -> WallTable:
    """The walls of which `walls` are the pieces, in the order of their numbers."""
    order = np.argsort(walls.wall, kind="stable")
    first = np.searchsorted(walls.wall[order], np.arange(walls.count))
    head = order[first]
    along = np.column_stack([-walls.normal[head, 1], walls.normal[head, 0]])
    axis = along[walls.wall]
    near = np.minimum(np.einsum("ij,ij->i", walls.start, axis), np.einsum("ij,ij->i", walls.end, axis))
    far = np.maximum(np.einsum("ij,ij->i", walls.start, axis), np.einsum("ij,ij->i", walls.end, axis))
    near, far = (operation.reduceat(values[order], first)
                 for operation, values in ((np.minimum, near), (np.maximum, far)))
    on = walls.normal[head] * walls.offset[head, None]
    low = np.minimum.reduceat(walls.low.min(axis=1)[order], first)
    top = np.maximum.reduceat(walls.top.max(axis=1)[order], first)
    building = walls.building[head]
    edge = np.arange(len(head)) - np.searchsorted(building, building) + 1
    return WallTable(building, edge, on + near[:, None] * along, on + far[:, None] * along, walls.normal[head],
                     np.where(np.isfinite(low), low, np.nan), top)


def _outline_heights(shape: shapely.Geometry, number: int, top, low) -> tuple[float, float] | None:
    """Foot (-inf if not known) and top of an outline; None without a top."""
    high = float(top[number]) if top is not None else np.nan
    if not np.isfinite(high) and shape.has_z:
        z = shapely.get_coordinates(shape, include_z=True)[:, 2]
        high = float(np.median(z)) if np.isfinite(z).all() else np.nan
    if not np.isfinite(high):
        return None
    foot = float(low[number]) if low is not None else np.nan
    return (foot if np.isfinite(foot) else -np.inf), high


def _outline_pieces(shape: shapely.Geometry, low: float, top: float) -> np.ndarray:
    """Pieces (n, 8) of an outline: x0, y0, x1, y1, low0, low1, top0, top1."""
    pieces = []
    for part in shapely.get_parts(shape):
        if part.geom_type != "Polygon":
            continue
        outline = shapely.geometry.polygon.orient(shapely.force_2d(part), 1.0)
        for ring in (outline.exterior, *outline.interiors):
            corners = shapely.get_coordinates(ring)
            heights = np.tile([low, low, top, top], (len(corners) - 1, 1))
            pieces.append(np.column_stack([corners[:-1], corners[1:], heights]))
    return np.concatenate(pieces) if pieces else np.zeros((0, 8))


def _solid_pieces(shape: shapely.Geometry) -> np.ndarray:
    """Pieces (n, 8) of the upright faces of a solid, turned outwards."""
    faces = [part for part in shapely.get_parts(shape) if part.geom_type == "Polygon"]
    rings = [_ring(face.exterior) for face in faces]
    origin = np.concatenate(rings).mean(axis=0)
    volume, face_pieces = 0.0, []
    for face, ring in zip(faces, rings):
        area = _area_vector(ring)
        volume += area @ (ring[0] - origin)
        size = np.linalg.norm(area)
        if size > 0 and abs(area[2]) < _UPRIGHT * size:
            face_pieces.append(_face_pieces(face, area[:2] / np.hypot(*area[:2])))
    pieces = np.concatenate(face_pieces) if face_pieces else np.zeros((0, 8))
    # Faces that look inwards as a whole are turned over.
    return pieces if volume >= 0 else pieces[:, [2, 3, 0, 1, 5, 4, 7, 6]]


def _face_pieces(face: shapely.Polygon, normal: np.ndarray) -> np.ndarray:
    """Pieces of an upright face: the strips between the corners, each between a lower and an upper edge.

    In every strip the edges that cross it are paired from below, so that gables and openings come out right.
    """
    along = np.array([-normal[1], normal[0]])
    rings = [_ring(ring) for ring in (face.exterior, *face.interiors)]
    a = np.concatenate(rings)
    b = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])
    base = a[0, :2]
    s0, s1 = (a[:, :2] - base) @ along, (b[:, :2] - base) @ along
    cuts = np.unique(np.round(s0, 4))
    strips = []
    for left, right in zip(cuts[:-1], cuts[1:]):
        if right - left < _SHORTEST:
            continue
        middle = (left + right) / 2
        crossing = np.flatnonzero((np.minimum(s0, s1) < middle) & (np.maximum(s0, s1) > middle))
        slope = (b[crossing, 2] - a[crossing, 2]) / (s1[crossing] - s0[crossing])
        at_left, at_right, at_middle = (a[crossing, 2] + slope * (s - s0[crossing]) for s in (left, right, middle))
        order = np.argsort(at_middle)
        for lower, upper in zip(order[::2], order[1::2]):
            strips.append([*(base + left * along), *(base + right * along), at_left[lower], at_right[lower],
                           at_left[upper], at_right[upper]])
    return np.array(strips).reshape(-1, 8)


def _ring(line: shapely.Geometry) -> np.ndarray:
    """Corners (n, 3) of a ring, not closed."""
    return shapely.get_coordinates(line, include_z=True)[:-1]


def _area_vector(ring: np.ndarray) -> np.ndarray:
    """Area of a ring times its normal (3,), counterclockwise seen from its tip."""
    local = ring - ring[0]
    return np.cross(local, np.roll(local, -1, axis=0)).sum(axis=0) / 2


def _normal(ring: np.ndarray) -> np.ndarray:
    area = _area_vector(ring)
    size = np.linalg.norm(area)
    # A ring without an area is no wall.
    return area / size if size > 0 else np.array([0.0, 0.0, 1.0])


def _assembled(pieces: np.ndarray, building: np.ndarray) -> WallPieces:
    """Walls of pieces (n, 8), sorted by building, with their planes."""
    edge = pieces[:, 2:4] - pieces[:, :2]
    length = np.hypot(edge[:, 0], edge[:, 1])
    long_enough = length > _SHORTEST
    pieces, building, edge, length = pieces[long_enough], building[long_enough], edge[long_enough], length[long_enough]
    order = np.argsort(building, kind="stable")
    pieces, building, edge, length = pieces[order], building[order], edge[order], length[order]
    normal = np.column_stack([edge[:, 1], -edge[:, 0]]) / length[:, None]
    offset = np.einsum("ij,ij->i", normal, (pieces[:, :2] + pieces[:, 2:4]) / 2)
    wall = np.zeros(len(pieces), np.int64)
    number = 0
    for first, last in _runs(building):
        planes = _planes(pieces[first:last], normal[first:last], length[first:last])
        wall[first:last] = number + planes
        number += planes.max() + 1
    return WallPieces(pieces[:, :2], pieces[:, 2:4], pieces[:, 4:6], pieces[:, 6:8], normal, offset, building, wall)


def _runs(values: np.ndarray) -> list[tuple[int, int]]:
    """Begins and ends of the runs of equal values."""
    cuts = np.flatnonzero(np.diff(values)) + 1
    edges = [0, *cuts.tolist(), len(values)]
    return list(zip(edges[:-1], edges[1:]))


def _planes(pieces: np.ndarray, normal: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Numbers (n,) of the planes in which the pieces of one building lie, by order of appearance.

    The longest piece of a plane defines it, so that short pieces of uncertain direction follow.
    """
    middle = (pieces[:, :2] + pieces[:, 2:4]) / 2
    plane = np.full(len(pieces), -1)
    for piece in np.argsort(-length, kind="stable"):
        if plane[piece] >= 0:
            continue
        off = np.abs((middle - middle[piece]) @ normal[piece])
        same = (plane < 0) & (normal @ normal[piece] > _SAME_DIRECTION) & (off < _SAME_PLANE)
        plane[same] = piece
        plane[piece] = piece
    _, first, inverse = np.unique(plane, return_index=True, return_inverse=True)
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return rank[inverse.ravel()]
