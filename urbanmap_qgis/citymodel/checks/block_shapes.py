"""The polygons of some city objects as arrays: places as in the file and in metres, rings, planes.

Metres are counted from each city object's first place, along the meridian and the parallel there: what is plane, closed
or simple stays so.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import shapely

from ...geometry.earth import curvature_radii
from .feature_walk import CityPolygon, CityThing

FARTHEST = 1e20
"""A coordinate (degrees or m) is smaller, or the products by which areas and lengths are told overflow."""

THINNEST = 1e-4
"""A ring whose area is less than this width (m) along its longest side has none: nine decimals of a degree."""


class BlockShapes:
    """Polygons of several city objects.

    Attributes
    ----------
    polygons : in the order of the file.
    thing : (P,) number of each one's city object.
    raw, metres : (N, 3) places of all rings, as in the file and in metres.
    start : (R + 1,) begin of each ring.
    polygon : (R,) number of each ring's polygon.
    outer : (R,) whether it is the outer one.
    unreadable : polygons with coordinates that are no numbers, beyond all, or not three a place; without rings here.
    """

    def __init__(self, things: Sequence[CityThing], geographic: bool):
        self.polygons: list[CityPolygon] = []
        self.unreadable: list[CityPolygon] = []
        self.number: dict[int, int] = {}
        values: list[float] = []
        counts, polygon, outer, thing = [], [], [], []
        for k, city_thing in enumerate(things):
            for one in city_thing.polygons:
                rings = _numbers(one)
                if rings is None:
                    self.unreadable.append(one)
                    continue
                for j, ring in enumerate(rings):
                    values += ring
                    counts.append(len(ring) // 3)
                    polygon.append(len(self.polygons))
                    outer.append(j < one.outer_rings)
                self.number[id(one)] = len(self.polygons)
                thing.append(k)
                self.polygons.append(one)
        self.raw = np.array(values, float).reshape(-1, 3)
        self.start = np.concatenate([[0], np.cumsum(counts)]).astype(int)
        self.polygon, self.outer = np.array(polygon, int), np.array(outer, bool)
        self.thing = np.array(thing, int)
        self.metres = self._in_metres(geographic)

    def _in_metres(self, geographic: bool) -> np.ndarray:
        """Places (N, 3): east, north, up of each city object's first place."""
        if not len(self.raw):
            return self.raw.copy()
        owner = self.thing[self.polygon][self.ring_of_place]
        first = np.searchsorted(owner, np.arange(owner.max() + 1))
        origin = self.raw[np.minimum(first, len(self.raw) - 1)][owner]
        moved = self.raw - origin
        if not geographic:
            return moved
        latitude = np.radians(origin[:, 0])
        across, along = curvature_radii(latitude)
        return np.column_stack([np.radians(moved[:, 1]) * across * np.cos(latitude), np.radians(moved[:, 0]) * along,
                                moved[:, 2]])

    @cached_property
    def ring_of_place(self) -> np.ndarray:
        """Number (N,) of each place's ring."""
        return np.repeat(np.arange(len(self.start) - 1), np.diff(self.start))

    @cached_property
    def lods(self) -> np.ndarray:
        """Level of detail (P,) of each polygon, -1 where it has none."""
        return np.array([-1 if one.lod is None else one.lod for one in self.polygons], int)

    @cached_property
    def closed(self) -> np.ndarray:
        """Whether each ring (R,) ends where it begins."""
        return (self.raw[self.start[:-1]] == self.raw[self.start[1:] - 1]).all(axis=1)

    @cached_property
    def side_lengths(self) -> np.ndarray:
        """Length (N,) of the way from each place to the next of its ring, NaN for the last one, m."""
        length = np.full(len(self.metres), np.nan)
        length[:-1] = np.linalg.norm(np.diff(self.metres, axis=0), axis=1)
        length[self.start[1:] - 1] = np.nan
        return length

    @cached_property
    def area_vectors(self) -> np.ndarray:
        """Vector (R, 3) along the normal of each ring, as long as its area (Newell), m2."""
        if not len(self.metres):
            return np.zeros((0, 3))
        local = self.metres - self.metres[self.start[:-1]][self.ring_of_place]
        following = np.roll(local, -1, axis=0)
        following[self.start[1:] - 1] = local[self.start[:-1]]
        return np.add.reduceat(np.cross(local, following), self.start[:-1], axis=0) / 2.0

    @cached_property
    def outer_ring(self) -> np.ndarray:
        """Number (P,) of each polygon's outer ring."""
        return np.searchsorted(self.polygon, np.arange(len(self.polygons)))

    def plan(self, polygon: int, swapped: bool) -> shapely.Polygon | None:
        """A polygon with its holes in plan, in the file's coordinates or with the first two `swapped`; None where its
        outer ring has fewer than four places."""
        first = self.outer_ring[polygon]
        last = np.searchsorted(self.polygon, polygon + 1)
        places = self.raw[:, 1::-1] if swapped else self.raw[:, :2]
        rings = [places[self.start[ring]:self.start[ring + 1]] for ring in range(first, last)
                 if ring == first or not self.outer[ring]]
        holes = [ring for ring in rings[1:] if len(ring) > 3]
        return shapely.Polygon(rings[0], holes) if len(rings[0]) > 3 else None

    @cached_property
    def vertex_numbers(self) -> np.ndarray:
        """A number (N,) for each place, the same for the same coordinates."""
        order = np.lexsort(self.raw.T)
        new = np.append(False, (np.diff(self.raw[order], axis=0) != 0).any(axis=1))
        number = np.empty(len(order), int)
        number[order] = np.cumsum(new)
        return number

    @cached_property
    def boxes(self) -> tuple[np.ndarray, np.ndarray]:
        """Least and greatest coordinates (P, 3) of each polygon, m."""
        begin = self.start[self.outer_ring]
        return np.minimum.reduceat(self.metres, begin, axis=0), np.maximum.reduceat(self.metres, begin, axis=0)

    @cached_property
    def normals(self) -> np.ndarray:
        """Unit normal (P, 3) of each polygon by its outer ring; zeros where it has no area."""
        vectors = self.area_vectors[self.outer_ring]
        length = np.linalg.norm(vectors, axis=1, keepdims=True)
        return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)

    @cached_property
    def flat(self) -> np.ndarray:
        """Places (N, 2) in the plane of their polygon, m; rings keep their turn."""
        normal = self.normals[self.polygon][self.ring_of_place]
        return _in_plane(self.metres, normal)

    @cached_property
    def out_of_plane(self) -> np.ndarray:
        """Distance (P,) of the farthest place from the mean plane of its polygon, m."""
        owner = self.polygon[self.ring_of_place]
        begin = np.searchsorted(owner, np.arange(len(self.polygons)))
        count = np.diff(np.append(begin, len(owner)))
        mean = np.add.reduceat(self.metres, begin, axis=0) / count[:, None]
        distance = np.abs(((self.metres - mean[owner]) * self.normals[owner]).sum(axis=1))
        return np.maximum.reduceat(distance, begin)

    @cached_property
    def thin(self) -> np.ndarray:
        """Whether each ring (R,) has no area."""
        longest = np.fmax.reduceat(self.side_lengths, self.start[:-1])
        area = np.linalg.norm(self.area_vectors, axis=1)
        return ~(2.0 * area > THINNEST * np.nan_to_num(longest)) | (np.nan_to_num(longest) == 0.0)

    @cached_property
    def whole(self) -> np.ndarray:
        """Whether each ring (R,) has three places at least besides one that closes it, so that it can be drawn."""
        return np.diff(self.start) - self.closed >= 3

    @cached_property
    def ring_lines(self) -> np.ndarray:
        """Rings (R,) as closed lines in the plane of their polygons; None where they have too few places."""
        lines = np.full(len(self.polygon), None, object)
        whole_rings = np.flatnonzero(self.whole)
        if len(whole_rings):
            places = self.whole[self.ring_of_place]
            number = np.full(len(self.polygon), -1)
            number[whole_rings] = np.arange(len(whole_rings))
            flat = self.flat.copy()
            last = self.start[1:][self.closed] - 1
            flat[last] = flat[self.start[:-1][self.closed]]
            lines[whole_rings] = shapely.linearrings(flat[places], indices=number[self.ring_of_place[places]])
        return lines

    def first_place(self, polygon: int) -> tuple[float, float]:
        """First place of a polygon as in the file: first and second coordinate."""
        first = self.raw[self.start[self.outer_ring[polygon]]]
        return float(first[0]), float(first[1])


def _numbers(polygon: CityPolygon) -> list[list[float]] | None:
    """The coordinates of all rings, three a place; None where they are not that, or beyond `FARTHEST`."""
    try:
        rings = [list(map(float, text.split())) for text in polygon.rings]
    except ValueError:
        return None
    fit = rings and all(ring and len(ring) % 3 == 0 for ring in rings)
    near = fit and all(np.isfinite(sum(ring)) and min(ring) > -FARTHEST and max(ring) < FARTHEST for ring in rings)
    return rings if near else None


def _in_plane(places: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Places (N, 2) along two axes at right angles to their normals."""
    upright = np.abs(normal[:, 2]) > 0.5
    helper = np.where(upright[:, None], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0])
    first = np.cross(helper, normal)
    length = np.linalg.norm(first, axis=1, keepdims=True)
    first = np.divide(first, length, out=np.zeros_like(first), where=length > 0)
    second = np.cross(normal, first)
    return np.column_stack([(places * first).sum(axis=1), (places * second).sum(axis=1)])
