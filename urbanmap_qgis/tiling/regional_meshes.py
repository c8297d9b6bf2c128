"""Tiles that are standard regional meshes of Japan (JIS X 0410): bounded by parallels and meridians."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import shapely

from ..errors import InputError
from ..geometry.mesh_code import COLUMNS, ROWS, WEST, regional_mesh_code
from ..io.reference.system_parts import plan_part
from ..wording import say
from .tile_grid import MAX_TILES, Bounds, GridTile, TileGrid

MESH_PARTS = {"mesh1km": 1, "mesh500m": 2, "mesh250m": 4}
"""Meshes along each side of a third mesh."""

_STEPS = 8
"""Pieces of straight lines as which the side of a mesh is drawn: its true curve departs from them by less than 1 mm."""


@lru_cache(maxsize=8)
def _transformers(crs_wkt: str):
    """From a projected CRS to its own longitude and latitude, and back: no change of datum."""
    from pyproj import CRS, Transformer

    crs = CRS.from_wkt(crs_wkt)
    plan = plan_part(crs)
    return (Transformer.from_crs(plan, plan.geodetic_crs, always_xy=True),
            Transformer.from_crs(plan.geodetic_crs, plan, always_xy=True))


def _numbers(crs_wkt: str, parts: int, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    longitude, latitude = _transformers(crs_wkt)[0].transform(np.asarray(x, float), np.asarray(y, float))
    return (np.floor((np.asarray(longitude) - WEST) * (COLUMNS * parts)).astype(np.int64),
            np.floor(np.asarray(latitude) * (ROWS * parts)).astype(np.int64))


@dataclass(frozen=True)
class MeshTile(GridTile):
    """A mesh; its name is its code. `core` is the box around it, which those of its neighbours overlap."""

    crs_wkt: str
    parts: int

    @property
    def name(self) -> str:
        """Code of eight, nine or ten digits."""
        return regional_mesh_code(self.row, self.column, self.parts)

    @property
    def fills_core(self) -> bool:
        """Whether the tile is all of the box `core`."""
        return False

    @property
    def square(self) -> shapely.Polygon:
        """The mesh as a polygon in the CRS of the data."""
        steps = np.arange(_STEPS) / _STEPS
        column = np.concatenate([steps, np.ones(_STEPS), 1 - steps, np.zeros(_STEPS)])
        row = np.concatenate([np.zeros(_STEPS), steps, np.ones(_STEPS), 1 - steps])
        longitude = WEST + (self.column + column) / (COLUMNS * self.parts)
        latitude = (self.row + row) / (ROWS * self.parts)
        return shapely.Polygon(np.column_stack(_transformers(self.crs_wkt)[1].transform(longitude, latitude)))

    def owns(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Mask (n,) of the points that lie in the mesh."""
        column, row = _numbers(self.crs_wkt, self.parts, x, y)
        return (column == self.column) & (row == self.row)


@dataclass(frozen=True)
class MeshGrid(TileGrid):
    """Meshes of one size.

    Parameters
    ----------
    size : about their side, m.
    crs_wkt : projected CRS of the data.
    parts : see `MESH_PARTS`.
    """

    crs_wkt: str = ""
    parts: int = 1

    @classmethod
    def of(cls, kind: str, crs_wkt: str, buffer: float) -> MeshGrid:
        """Meshes of a kind of `MESH_PARTS`. Raises `InputError` where the data has no CRS."""
        if not crs_wkt:
            raise InputError(say("The data states no coordinate reference system, which meshes need: give it "
                                 "(POINTS_CRS), or choose squares."))
        return cls(1000.0 / MESH_PARTS[kind], buffer, crs_wkt, MESH_PARTS[kind])

    @property
    def key(self) -> object:
        """What tells this grid from others, beside its buffer."""
        return f"meshes {self.parts} of {self.crs_wkt}"

    @property
    def title(self) -> str:
        """What the tiles are, for reports."""
        return say("regional meshes of about {size:g} m", size=self.size)

    def tile(self, column: int, row: int) -> MeshTile:
        """The mesh in a column and row, see `geometry.mesh_code`."""
        bare = MeshTile(column, row, (0.0,) * 4, (0.0,) * 4, self.crs_wkt, self.parts)
        core = tuple(float(value) for value in bare.square.bounds)
        return MeshTile(column, row, core, self.around(core), self.crs_wkt, self.parts)

    def numbers(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Column and row (n,) int64 of the meshes that own the points."""
        return _numbers(self.crs_wkt, self.parts, x, y)

    def covering(self, bounds: Bounds) -> list[GridTile]:
        """Meshes that meet a box, row by row from the south-west.

        Raises
        ------
        InputError : the box is not finite, is not in the meshes' range, or takes more than a million meshes.
        """
        if not all(map(math.isfinite, bounds)):
            raise InputError(say("The extent of the data is not a number: check its coordinates."))
        box = shapely.box(*bounds)
        outline = shapely.get_coordinates(shapely.segmentize(box, max(box.length / 64, 1e-6)))
        column, row = self.numbers(*outline.T)
        left, right, bottom, top = column.min(), column.max(), row.min(), row.max()
        if left < 0 or right >= 80 * COLUMNS * self.parts or bottom < 0 or top >= 66 * ROWS * self.parts:
            raise InputError(say("The data is not in the range of Japan's meshes, 0 to 66 degrees north and 100 to "
                                 "180 east: choose squares."))
        if (right - left + 1) * (top - bottom + 1) > MAX_TILES:
            raise InputError(say("The data would take more than a million meshes: choose larger ones, or check the "
                                 "coordinates."))
        tiles = [self.tile(number, line) for line in range(bottom, top + 1) for number in range(left, right + 1)]
        return [tile for tile in tiles if box.intersects(tile.square)]
