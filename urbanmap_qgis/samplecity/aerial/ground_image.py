"""The ground of the sample city seen straight from above: its colours, its height, the sun on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from ...progress import Progress
from ..scene.model import Faces
from ..scene.world import Scene
from .ground_paint import paint_markings
from .ground_texture import GroundTexture
from .sunlight import ShadowMap

CELL = 0.06
"""Of the colours, m: half a pixel of a frame."""

LIT_CELLS, HEIGHT_CELLS, KIND_CELLS = 2, 4, 16
"""Cells of the sunlight, of the heights and of the search for edges between surfaces, in cells of the colours."""

STRIP = 512
"""Rows of colours that are made at once; a multiple of the cells above."""


@dataclass(frozen=True)
class GroundImage:
    """Ground as rasters of local places: relative to `origin` in plan.

    Attributes
    ----------
    west, north : local place of the rasters' corner, m.
    colour : (rows, columns, 3) uint8 in full light, cells of `CELL`.
    height : float32, cells of `CELL` * `HEIGHT_CELLS`.
    lit : uint8, 0 in cast shadow to 255 in the sun, cells of `CELL` * `LIT_CELLS`.
    """

    origin: np.ndarray
    west: float
    north: float
    colour: np.ndarray
    height: np.ndarray
    lit: np.ndarray

    def height_at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Ground heights (float32) at local places (2D float32 arrays)."""
        return self._sample(self.height, x, y, HEIGHT_CELLS)

    def colour_at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Colours (..., 3) uint8 at local places (2D float32 arrays)."""
        return self._sample(self.colour, x, y, 1)

    def lit_at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Sunlight (uint8) at local places (2D float32 arrays)."""
        return self._sample(self.lit, x, y, LIT_CELLS)

    def with_shadows(self, things: Sequence[Faces], shadows: ShadowMap) -> GroundImage:
        """The same ground with the shadows of more things, which `shadows` holds: it is made anew around each."""
        lit = self.lit.copy()
        cell = CELL * LIT_CELLS
        for thing in things:
            x_min, y_min, x_max, y_max = shadows.reach_of(thing.corners, thing.corners[..., 2].min() - 0.3)
            rows = slice(max(int((self.north - y_max) / cell) - 4, 0), max(int((self.north - y_min) / cell) + 5, 0))
            columns = slice(max(int((x_min - self.west) / cell) - 4, 0), max(int((x_max - self.west) / cell) + 5, 0))
            patch = lit[rows, columns]
            if patch.size:
                np.minimum(patch, self._sunlight(shadows, rows, columns), out=patch)
        return GroundImage(self.origin, self.west, self.north, self.colour, self.height, lit)

    def _sunlight(self, shadows: ShadowMap, rows: slice, columns: slice) -> np.ndarray:
        rows, columns = slice(*rows.indices(self.lit.shape[0])), slice(*columns.indices(self.lit.shape[1]))
        cell = CELL * LIT_CELLS
        x, y = np.meshgrid(
            (self.west + (np.arange(columns.start, columns.stop) + 0.5) * cell).astype(np.float32),
            (self.north - (np.arange(rows.start, rows.stop) + 0.5) * cell).astype(np.float32))
        lit = shadows.lit(x, y, self.height_at(x, y)).astype(np.uint8) * np.uint8(255)
        return cv2.GaussianBlur(lit, (0, 0), 0.9, borderType=cv2.BORDER_REPLICATE)

    def _sample(self, raster: np.ndarray, x: np.ndarray, y: np.ndarray, cells: int) -> np.ndarray:
        scale = np.float32(1 / (CELL * cells))
        column = (x - np.float32(self.west)) * scale - np.float32(0.5)
        row = (np.float32(self.north) - y) * scale - np.float32(0.5)
        return cv2.remap(raster, column, row, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)


def make_ground_image(scene: Scene, bounds: np.ndarray, shadows: ShadowMap, rng: np.random.Generator,
                      progress: Progress) -> GroundImage:
    """Draw the ground within `bounds` (local x_min, y_min, x_max, y_max)."""
    block = CELL * KIND_CELLS
    origin = shadows.origin
    west, north = np.floor(bounds[0] / block) * block, np.ceil(bounds[3] / block) * block
    columns, rows = (int(np.ceil(length / block)) * KIND_CELLS for length in (bounds[2] - west, north - bounds[1]))
    colour = np.empty((rows, columns, 3), np.uint8)
    height = _heights(scene, origin, west, north, rows // HEIGHT_CELLS, columns // HEIGHT_CELLS)
    progress.check()
    texture = GroundTexture(scene, origin, west, north, (rows, columns), CELL, rng)
    for top in range(0, rows, STRIP):
        progress.step(0.8 * top / rows)
        strip = colour[top:top + STRIP]
        kind = surface_kinds(scene, origin, west, north - top * CELL, strip.shape[:2])
        texture.colour(strip, kind, top)
        paint_markings(strip, scene, origin, west, north - top * CELL, CELL)
    lit = np.empty((rows // LIT_CELLS, columns // LIT_CELLS), np.uint8)
    image = GroundImage(origin, west, north, colour, height, lit)
    for top in range(0, len(lit), STRIP):
        progress.step(0.8 + 0.2 * top / len(lit))
        rows_of = slice(top, min(top + STRIP, len(lit)))
        lit[rows_of] = image._sunlight(shadows, rows_of, slice(None))
    return image


def surface_kinds(scene: Scene, origin: np.ndarray, west: float, north: float, shape: tuple[int, int]) -> np.ndarray:
    """`Surface` of each cell of a strip; only blocks through which an edge may run are asked cell by cell."""
    size = KIND_CELLS * CELL
    rows, columns = shape[0] // KIND_CELLS, shape[1] // KIND_CELLS
    x = origin[0] + west + (np.arange(columns + 3) - 1) * size
    y = origin[1] + north - (np.arange(rows + 3) - 1) * size
    nodes = scene.surface_kind(*np.meshgrid(x, y))
    spread = cv2.dilate(nodes, np.ones((3, 3), np.uint8)) != cv2.erode(nodes, np.ones((3, 3), np.uint8))
    mixed = spread[1:-2, 1:-2] | spread[1:-2, 2:-1] | spread[2:-1, 1:-2] | spread[2:-1, 2:-1]
    kind = np.repeat(np.repeat(nodes[1:-2, 1:-2], KIND_CELLS, axis=0), KIND_CELLS, axis=1)
    blocks = kind.reshape(rows, KIND_CELLS, columns, KIND_CELLS)
    row, column = np.nonzero(mixed)
    inner = (np.arange(KIND_CELLS) + 0.5) * CELL
    x, y = (x[column + 1][:, None, None] + inner, y[row + 1][:, None, None] - inner[:, None])
    blocks[row, :, column, :] = scene.surface_kind(*np.broadcast_arrays(x, y))
    return kind


def _heights(scene: Scene, origin: np.ndarray, west: float, north: float, rows: int, columns: int) -> np.ndarray:
    cell = CELL * HEIGHT_CELLS
    x = origin[0] + west + (np.arange(columns) + 0.5) * cell
    y = origin[1] + north - (np.arange(rows) + 0.5) * cell
    return np.concatenate([scene.ground_height(*np.meshgrid(x, part)).astype(np.float32)
                           for part in np.array_split(y, max(rows // 256, 1))])
