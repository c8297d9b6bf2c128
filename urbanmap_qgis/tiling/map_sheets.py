"""Tiles that are the sheets of Japan's large-scale public survey maps.

Source: sheet lines of the standard symbols for public surveys (work regulations of the Geospatial Information Authority
of Japan): around the origin of a plane rectangular system, sheets of 40 by 30 km; a tenth of each side is a sheet of
level 5000, of which level 2500 is a half, level 1000 a fifth and level 500 a tenth.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..errors import InputError
from ..io.reference.system_parts import plan_part
from ..wording import say
from .tile_grid import Bounds, GridTile, TileGrid

SHEET_PARTS = {5000: 1, 2500: 2, 1000: 5, 500: 10}
"""Sheets of a level along each side of one of level 5000."""

WIDTH = 4000.0
HEIGHT = 3000.0
EAST = 160_000.0
NORTH = 300_000.0
# Latitude and longitude of the origins of the systems 1 to 19, degrees and minutes.
ORIGINS = ((33, 0, 129, 30), (33, 0, 131, 0), (36, 0, 132, 10), (33, 0, 133, 30),
                                          (36, 0, 134, 20), (36, 0, 136, 0), (36, 0, 137, 10), (36, 0, 138, 30),
                                          (36, 0, 139, 50), (40, 0, 140, 50), (44, 0, 140, 15), (44, 0, 142, 15),
                                          (44, 0, 144, 15), (26, 0, 142, 0), (26, 0, 127, 30), (26, 0, 124, 0),
                                          (26, 0, 131, 0), (20, 0, 136, 0), (26, 0, 154, 0))


def plane_system(crs_wkt: str) -> int:
    """Number, 1 to 19, of the plane rectangular system of Japan that a CRS is.

    Raises
    ------
    InputError : it is none of them.
    """
    from pyproj import CRS

    if not crs_wkt:
        raise InputError(say("The data states no coordinate reference system, which map sheets need: give it "
                             "(POINTS_CRS), or choose squares."))
    crs = CRS.from_wkt(crs_wkt)
    plan = plan_part(crs)
    given = {item.name: item.value for item in plan.coordinate_operation.params} if plan.coordinate_operation else {}
    place = [given.get(f"{name} of natural origin", 0.0) for name in ("Latitude", "Longitude")]
    scale = given.get("Scale factor at natural origin", 0.0)
    for number, (north, minutes, east, east_minutes) in enumerate(ORIGINS, 1):
        if (abs(place[0] - north - minutes / 60) < 1e-6 and abs(place[1] - east - east_minutes / 60) < 1e-6
                and abs(scale - 0.9999) < 1e-9):
            return number
    raise InputError(say("Map sheets need a plane rectangular system of Japan, and {plan} is none: choose squares or "
                         "meshes, or reproject the data.", plan=plan.name))


@dataclass(frozen=True)
class SheetTile(GridTile):
    """A sheet; its name is its code, such as ``09LD1885``."""

    system: int
    parts: int

    @property
    def name(self) -> str:
        """Code: system, sheet of 40 by 30 km by letters, sheet of level 5000 by two digits, its part."""
        column = self.column + round(EAST / WIDTH) * self.parts
        row = round(NORTH / HEIGHT) * self.parts - 1 - self.row
        big, part = (row // self.parts, column // self.parts), (row % self.parts, column % self.parts)
        code = f"{self.system:02d}{chr(65 + big[0] // 10)}{chr(65 + big[1] // 10)}{big[0] % 10}{big[1] % 10}"
        if self.parts == 2:
            return f"{code}{1 + part[1] + 2 * part[0]}"
        if self.parts == 5:
            return f"{code}{part[0]}{chr(65 + part[1])}"
        return code if self.parts == 1 else f"{code}{part[0]}{part[1]}"


@dataclass(frozen=True)
class SheetGrid(TileGrid):
    """Sheets of one level in one plane rectangular system; coordinates are east and north of its origin.

    Parameters
    ----------
    level : 5000, 2500, 1000 or 500.
    system : number of the system. `size` is the sheets' height, m.
    """

    level: int = 500
    system: int = 9

    @classmethod
    def of(cls, level: int, crs_wkt: str, buffer: float) -> SheetGrid:
        """Sheets of a level in a CRS. Raises `InputError` where it is no plane rectangular system."""
        return cls(HEIGHT / SHEET_PARTS[level], buffer, level, plane_system(crs_wkt))

    @property
    def sides(self) -> tuple[float, float]:
        """Width and height of a sheet, m."""
        return WIDTH / SHEET_PARTS[self.level], HEIGHT / SHEET_PARTS[self.level]

    @property
    def key(self) -> object:
        """What tells this grid from others, beside its buffer."""
        return f"sheets {self.level} of system {self.system}"

    @property
    def title(self) -> str:
        """What the tiles are, for reports."""
        return say("map sheets of level {level}, plane rectangular system {system}", level=self.level,
                   system=self.system)

    def tile(self, column: int, row: int) -> SheetTile:
        """The sheet in a column and row counted from the origin of the system."""
        plain = super().tile(column, row)
        return SheetTile(column, row, plain.core, plain.outer, self.system, SHEET_PARTS[self.level])

    def covering(self, bounds: Bounds) -> list[GridTile]:
        """As of `TileGrid`; raises `InputError` too where the box leaves the area that sheets cover."""
        x_min, y_min, x_max, y_max = bounds
        if not (x_min >= -EAST and x_max < EAST and y_min >= -NORTH and y_max < NORTH):
            raise InputError(say("The data leaves the area of the map sheets, 160 km east and west and 300 km north "
                                 "and south of the origin: choose squares or meshes."))
        return super().covering(bounds)
