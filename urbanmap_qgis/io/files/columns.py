"""Columns of tables and numbers of JSON files as data: names, units, and what other programs call them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Column:
    """A column that a reader knows.

    Attributes
    ----------
    name : as the project's own files have it.
    unit : "m", "s", "degrees"; "" for a text.
    others : other names, as `named_table.plain_name` gives them.
    needed : whether a table must have it.
    """

    name: str
    unit: str = ""
    others: tuple[str, ...] = ()
    needed: bool = True

    def optional(self) -> Column:
        """The same, which a table may lack."""
        return replace(self, needed=False)


@dataclass(frozen=True)
class Entry(Column):
    """A number of a JSON file; `default` where it may be missing, None where it must be there."""

    default: float | None = None


TIME = Column("time", "s", ("gpstime", "t", "gpsseconds", "gpssec", "sow", "weekseconds", "時刻", "時間", "gps時刻",
                            "gps時間", "gps秒"))
EAST = Column("x", "m", ("easting", "east", "東", "東座標", "東距", "東西", "e座標"))
NORTH = Column("y", "m", ("northing", "north", "北", "北座標", "北距", "南北", "n座標"))
UP = Column("z", "m", ("height", "altitude", "elevation", "ellipsoidheight", "ellipsoidalheight", "orthometricheight",
                       "hell", "hmsl", "標高", "高さ", "楕円体高", "z座標"))
LATITUDE = ("latitude", "lat", "latdeg", "latitudedeg", "緯度", "緯度度", "北緯",
            "y/latitude")
LONGITUDE = ("longitude", "lon", "long", "lng", "londeg", "longdeg", "longitudedeg", "経度", "経度度", "東経",
             "x/longitude")
"""Names of columns of places in degrees, which tables are imported from."""

ROLL = Column("roll", "degrees", ("ロール", "ロール角"))
PITCH = Column("pitch", "degrees", ("ピッチ", "ピッチ角"))
HEADING = Column("heading", "degrees", ("yaw", "azimuth", "ヘディング", "ヨー", "ヨー角", "方位", "方位角"))
IMAGE_NAMES = ("photoid", "imagename", "imageid", "filename", "photo", "photoname", "label", "画像", "画像名", "写真",
               "写真名", "写真番号", "写真id", "ファイル名")


def names_of(table: Iterable[Column]) -> tuple[str, ...]:
    """Names of all columns."""
    return tuple(column.name for column in table)


def needed_of(table: Iterable[Column]) -> tuple[str, ...]:
    """Names of those that a table must have."""
    return tuple(column.name for column in table if column.needed)


def aliases_of(table: Sequence[Column]) -> dict[str, str]:
    """The name of a column by each of its other names."""
    return {other: column.name for column in table for other in column.others}
