"""The facades of building models, and the places of their textures' pixels (texels)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.solid import OUTER_WALL, Solid
from ...geometry.solid_faces import face_normal
from ...geometry.tolerances import LEAST_DIVISOR

_MIN_SIDE = 0.3
"""Upright faces narrower or lower than this (m) are reveals and steps, and get no texture."""


@dataclass(frozen=True, eq=False)
class Facade:
    """An upright face of a building's solid, seen from outside.

    Attributes
    ----------
    solid, face : numbers of the solid in the building and of the face in the solid.
    origin : (3,) lower left corner of its frame, m.
    along : (3,) unit vector to the right.
    up : (3,) unit vector in the plane upwards.
    normal : (3,) unit vector outwards.
    width, height : of the frame, m.
    outline : polygon in the frame, m from the origin along `along` and `up`.
    """

    solid: int
    face: int
    origin: np.ndarray
    along: np.ndarray
    up: np.ndarray
    normal: np.ndarray
    width: float
    height: float
    outline: shapely.Polygon

    def places(self, right: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Map coordinates (n, 3) of places (n,) in the frame, m."""
        return self.origin + np.multiply.outer(right, self.along) + np.multiply.outer(high, self.up)


def facades_of(solids: Sequence[Solid]) -> list[Facade]:
    """The outer walls of a building that are large enough to carry a texture."""
    found = []
    for number, solid in enumerate(solids):
        for face, kind in enumerate(solid.surface_type):
            if kind == OUTER_WALL:
                facade = _facade(solid, number, face)
                if min(facade.width, facade.height) >= _MIN_SIDE:
                    found.append(facade)
    return found


def _facade(solid: Solid, number: int, face: int) -> Facade:
    """The frame of a face: `along` is level, `up` as steep as the face."""
    rings = solid.faces[face]
    normal = face_normal(solid.vertices, rings)
    along = np.array([-normal[1], normal[0], 0.0]) / max(np.hypot(normal[0], normal[1]), LEAST_DIVISOR)
    up = np.cross(normal, along)
    start = solid.vertices[rings[0][0]]
    flat = [np.column_stack([(solid.vertices[list(ring)] - start) @ axis for axis in (along, up)]) for ring in rings]
    low = flat[0].min(axis=0)
    width, height = np.ptp(flat[0], axis=0)
    outline = shapely.Polygon(flat[0] - low, [hole - low for hole in flat[1:]])
    return Facade(number, face, start + low[0] * along + low[1] * up, along, up, normal, float(width), float(height),
                  outline)


@dataclass(frozen=True)
class TexelGrid:
    """The texels of a facade: row 0 is the highest; the lower left corner of the last row is the frame's origin.

    Attributes
    ----------
    step : side of a texel, m.
    rows, columns : their numbers.
    """

    step: float
    rows: int
    columns: int

    def middles(self) -> tuple[np.ndarray, np.ndarray]:
        """Places right (columns,) and high (rows,) of the texels' middles in the facade's frame, m."""
        return ((np.arange(self.columns) + 0.5) * self.step,
                (self.rows - np.arange(self.rows) - 0.5) * self.step)


def texel_grid(facade: Facade, step: float) -> TexelGrid:
    """Texels of side `step` (m) that cover a facade's frame."""
    rows, columns = (max(int(np.ceil(side / step - 1e-6)), 1) for side in (facade.height, facade.width))
    return TexelGrid(step, rows, columns)


@dataclass(frozen=True, eq=False)
class Lattice:
    """Nodes on a facade, wider apart than its texels, and how texels lie between them.

    Attributes
    ----------
    rows, columns : of the nodes, the lowest row first.
    places : (rows * columns, 3) map coordinates, row by row.
    """

    rows: int
    columns: int
    places: np.ndarray
    _below: np.ndarray
    _left: np.ndarray
    _upper: np.ndarray
    _right: np.ndarray

    def between(self, values: np.ndarray) -> np.ndarray:
        """Values (rows, columns) of the texels, linear between those of the nodes (n,); NaN beside a node with NaN."""
        nodes = values.reshape(self.rows, self.columns)
        low, left = self._below[:, None], self._left[None, :]
        u, v = self._right[None, :], self._upper[:, None]
        lower = nodes[low, left] * (1 - u) + nodes[low, left + 1] * u
        return lower * (1 - v) + (nodes[low + 1, left] * (1 - u) + nodes[low + 1, left + 1] * u) * v

    def nearest(self, values: np.ndarray) -> np.ndarray:
        """Values (rows, columns) of the texels: those of the nearest nodes (n,)."""
        nodes = values.reshape(self.rows, self.columns)
        return nodes[(self._below + (self._upper > 0.5))[:, None], (self._left + (self._right > 0.5))[None, :]]


def lattice(facade: Facade, grid: TexelGrid, step: float) -> Lattice:
    """Nodes `step` (m) apart, from the frame's lower left corner to beyond its ends."""
    right, high = (values / step for values in grid.middles())
    left, below = np.floor(right).astype(int), np.floor(high).astype(int)
    columns, rows = left.max() + 2, below.max() + 2
    places = facade.places(np.tile(np.arange(columns) * step, rows), np.repeat(np.arange(rows) * step, columns))
    return Lattice(rows, columns, places, below, left, high - below, right - left)


def on_facade(facade: Facade, grid: TexelGrid) -> np.ndarray:
    """Mask (rows, columns) of the texels whose middle lies on the face itself."""
    right, high = grid.middles()
    return shapely.contains_xy(facade.outline, *np.meshgrid(right, high))
