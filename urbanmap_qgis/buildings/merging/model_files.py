"""Building models of a CityJSON file as the merging takes them."""

from __future__ import annotations

import os
import re

import numpy as np

from ...citymodel.cityjson.reader import read_cityjson
from ...citymodel.solids import solid_faces, solid_rows
from ...errors import InsufficientDataError
from ...wording import say


def models_from_cityjson(path: str | os.PathLike) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Numbers (n,), faces (n,) as MultiPolygonZ (None without a solid) and names of the buildings of a file.

    The number is the attribute building_id, or the digits at the end of the object's id, or its place in the file;
    it is taken only where all buildings have a different one.

    Raises
    ------
    InputError : the file cannot be read.
    InsufficientDataError : it holds no building.
    """
    rows = solid_rows(read_cityjson(path).buildings)
    if not rows:
        raise InsufficientDataError(say("{fspath} holds no building: give a CityJSON file with buildings.",
                                        fspath=os.fspath(path)))
    faces = np.full(len(rows), None, object)
    for row, (_, solids) in enumerate(rows):
        faces[row] = solid_faces(solids)
    objects = [item for item, _ in rows]
    return _numbers(objects), faces, [item.id for item in objects]


def _numbers(objects) -> np.ndarray:
    for source in (lambda item: item.attributes.get("building_id"),
                   lambda item: (re.search(r"\d+$", item.id) or [None])[0]):
        found = [source(item) for item in objects]
        try:
            numbers = [int(value) for value in found]
        except (TypeError, ValueError, OverflowError):
            continue
        if len(set(numbers)) == len(numbers) and all(abs(number) < 2**62 for number in numbers):
            return np.array(numbers, np.int64)
    return np.arange(1, len(objects) + 1)
