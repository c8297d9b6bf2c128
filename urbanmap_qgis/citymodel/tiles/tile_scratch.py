"""Buildings of a tile kept in a scratch file while others are read: a head as JSON, then the coordinates.

A record is the length of its head (4 bytes, little endian), the head, and the arrays that it names, one after another,
as little-endian numbers of 8 bytes. Nothing in such a file is ever run, whoever wrote it.
"""

from __future__ import annotations

import json
import os
import struct
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import OutputError
from ...wording import say
from .tile_content import TileBuilding

_LENGTH = struct.Struct("<I")
_NUMBERS = np.dtype("<f8")


def append_building(path: Path, building: TileBuilding) -> None:
    """Put a building behind those of a scratch file, which is made where it is not there."""
    head = {"attributes": dict(building.attributes), "triangles": _counts(building.triangles),
            "places": _counts(building.places)}
    text = json.dumps(head, ensure_ascii=True, separators=(",", ":")).encode("ascii")
    arrays = [*building.triangles.values(), *building.places.values()]
    with open(path, "ab") as file:
        file.write(_LENGTH.pack(len(text)) + text)
        file.writelines(np.ascontiguousarray(array, _NUMBERS).tobytes() for array in arrays)


def stored_buildings(path: Path) -> Iterator[TileBuilding]:
    """Buildings of a scratch file, in the order in which they came.

    Raises
    ------
    OutputError : the file ends within a building.
    """
    with open(path, "rb") as file:
        end = os.fstat(file.fileno()).st_size
        while file.tell() < end:
            (length,) = _LENGTH.unpack(_whole(file, _LENGTH.size))
            head: dict[str, Any] = json.loads(_whole(file, length))
            triangles = {look: _array(file, (count, 3, 3)) for look, count in head["triangles"].items()}
            places = {look: _array(file, (count, 3, 2)) for look, count in head["places"].items()}
            yield TileBuilding(head["attributes"], triangles, places)


def _counts(arrays: Mapping[str, np.ndarray]) -> dict[str, int]:
    return {look: len(array) for look, array in arrays.items()}


def _array(file, shape: tuple[int, ...]) -> np.ndarray:
    """An array of the file (read-only), as its own memory."""
    data = _whole(file, _NUMBERS.itemsize * int(np.prod(shape)))
    return np.frombuffer(data, _NUMBERS).reshape(shape)


def _whole(file, size: int) -> bytes:
    data = file.read(size)
    if len(data) < size:
        raise OutputError(say("The temporary file {path} is cut off: make room on the disk of temporary files, and run "
                              "again.", path=file.name))
    return data
