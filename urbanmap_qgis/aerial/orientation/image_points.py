"""Points that were measured in frames: control, check and tie points of a table."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...io.files.columns import EAST, IMAGE_NAMES, NORTH, UP, Column, aliases_of, names_of, needed_of
from ...io.files.guard import read_text, reads
from ...io.files.named_table import known_columns, named_rows
from ...wording import say
from .control_columns import check_rows, column_numbers

IMAGE_POINTS = (
    Column("point", "", ("id", "name", "pointid", "marker", "点名", "点番号", "点")),
    Column("image", "", ("frame", *IMAGE_NAMES)),
    Column("column", "", ("u", "px", "sample", "列")), Column("row", "", ("v", "py", "line", "行")),
    EAST.optional(), NORTH.optional(), UP.optional(), Column("role", "", ("use", "役割", "区分"), needed=False))
"""A row for each time a point was seen; pixels from the centre of the first one, coordinates in metres."""

COLUMNS, _NEEDED, _ALIASES = names_of(IMAGE_POINTS), needed_of(IMAGE_POINTS), aliases_of(IMAGE_POINTS)


@dataclass(frozen=True)
class ImagePoints:
    """Observations, a row each, and the points they are of.

    Attributes
    ----------
    image : (n,) number in `images`.
    point : (n,) number in `points`.
    pixel : (n, 2) column and row.
    images, points : names.
    place : (k, 3) m, NaN where it is not known (tie points).
    check : (k,) bool, points that are only compared.
    """

    image: np.ndarray
    point: np.ndarray
    pixel: np.ndarray
    images: tuple[str, ...]
    points: tuple[str, ...]
    place: np.ndarray
    check: np.ndarray

    @property
    def known(self) -> np.ndarray:
        """(k,) bool, points with coordinates."""
        return np.isfinite(self.place).all(axis=1)

    @property
    def control(self) -> np.ndarray:
        """(k,) bool, points that the frames are adjusted to."""
        return self.known & ~self.check


@reads("image points")
def read_image_points(path: str | os.PathLike) -> ImagePoints:
    """Image points of a CSV with the columns of `IMAGE_POINTS`, or what other programs call them.

    Raises
    ------
    InputError : a column is missing, a value is no number, a role is not known, a point has two places, or a point is
        twice in one image.
    """
    name = Path(path).name
    header, rows, _ = named_rows(read_text(path, "image points (CSV)"), _NEEDED, _ALIASES, name)
    columns = {key: [row[place].strip() if place < len(row) else "" for row in rows]
               for place, key in enumerate(header) if key}
    known = known_columns(columns, COLUMNS, _ALIASES, name)
    missing = [column for column in _NEEDED if column not in known]
    if missing:
        raise InputError(say("{name} has no column {missing}: points in images need {columns}; x, y, z where their "
                             "coordinates are known.", name=name, missing=", ".join(missing),
                             columns=",".join(_NEEDED)))
    if not rows:
        raise InputError(say("{name} holds no point in an image.", name=name))
    images, image = _numbered(columns[known["image"]])
    points, point = _numbered(columns[known["point"]])
    pair, count = np.unique(np.column_stack([image, point]), axis=0, return_counts=True)
    if (count > 1).any():
        twice = pair[count.argmax()]
        raise InputError(say("{name}: the point {point} is twice in {image}; keep one row.", name=name,
                             point=points[twice[1]], image=images[twice[0]]))
    pixel = np.column_stack([column_numbers(columns[known[key]], key, name, needed=True) for key in ("column", "row")])
    place = np.column_stack([column_numbers(columns[known[key]], key, name) if key in known
                             else np.full(len(rows), np.nan) for key in "xyz"])
    check = check_rows(columns, known, len(rows), name)
    return ImagePoints(image, point, pixel, images, points, _of_points(place, point, points, name),
                       np.bincount(point, check, len(points)) > 0)


def _numbered(texts: Sequence[str]) -> tuple[tuple[str, ...], np.ndarray]:
    """Names in the order of the file, and the number of each row's."""
    names = tuple(dict.fromkeys(texts))
    number = {name: place for place, name in enumerate(names)}
    return names, np.array([number[text] for text in texts])


def _of_points(place: np.ndarray, point: np.ndarray, points: Sequence[str], name: str) -> np.ndarray:
    """(k, 3) coordinates of the points; rows of one may leave them out, and must not differ."""
    known = np.isfinite(place).all(axis=1)
    partly = np.isfinite(place).any(axis=1) & ~known
    if partly.any():
        raise InputError(say("{name}: the point {point} has some of x, y and z only; give all three or none.",
                             name=name, point=points[point[partly.argmax()]]))
    found = np.full((len(points), 3), np.nan)
    found[point[known]] = place[known]
    differ = known & (np.abs(place - found[point]) > 1e-6).any(axis=1)
    if differ.any():
        raise InputError(say("{name}: the point {point} has two places; keep one.", name=name,
                             point=points[point[differ.argmax()]]))
    return found
