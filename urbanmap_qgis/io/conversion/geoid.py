"""Geoid models: how far the geoid lies above the ellipsoid, from GeoTIFF, GTX, GSI's text grids or one number."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeVar

import numpy as np
import rasterio

from ...errors import InputError
from ...wording import say
from ..files.guard import read_text, reads, unreadable_part
from ..raster import OPENING_ERRORS, own_gdal

_Number = TypeVar("_Number", int, float)

HIGHEST = 120.0
"""m: the geoid is nowhere farther from the ellipsoid."""

_TEXT_SUFFIXES = (".asc", ".isg", ".txt", ".ver")
_SECOND = 1.0 / 3600.0
_DEGREES = re.compile(r"""^([+-]?\d+)°\s*(\d+)'\s*([\d.]+)(?:"|'')?$""")


@dataclass(frozen=True)
class Geoid:
    """Heights of the geoid above the ellipsoid, m.

    Attributes
    ----------
    name : of the file, or the number as text.
    heights : (rows, columns) at nodes from south to north and west to east, NaN where unknown; (1, 1): everywhere.
    south, west : latitude and longitude of the first node, degrees.
    steps : (2,) between nodes, degrees.
    """

    name: str
    heights: np.ndarray
    south: float = 0.0
    west: float = 0.0
    steps: tuple[float, float] = (1.0, 1.0)

    @classmethod
    def constant(cls, height: float) -> Geoid:
        """The same height everywhere, m."""
        return cls(f"{height:g} m", np.array([[float(height)]]))

    def interpolate(self, longitude: np.ndarray, latitude: np.ndarray) -> np.ndarray:
        """Bilinear heights (n,), m, at longitudes and latitudes (n,) in degrees.

        Raises
        ------
        InputError : a place lies outside the model.
        """
        longitude, latitude = np.asarray(longitude, float), np.asarray(latitude, float)
        if self.heights.size == 1:
            return np.full(longitude.shape, float(self.heights[0, 0]))
        rows, columns = self.heights.shape
        around = round(360.0 / self.steps[1])
        row = (latitude - self.south) / self.steps[0]
        column = np.mod((longitude - self.west) / self.steps[1], around)
        wide = np.column_stack([self.heights, self.heights[:, :1]]) if columns == around else self.heights
        inside = (row >= 0) & (row <= rows - 1) & (column <= wide.shape[1] - 1)
        top, left = (np.clip(np.floor(np.where(inside, value, 0)).astype(int), 0, size - 2)
                     for value, size in ((row, rows), (column, wide.shape[1])))
        up, right = row - top, column - left
        height = ((wide[top, left] * (1 - right) + wide[top, left + 1] * right) * (1 - up)
                  + (wide[top + 1, left] * (1 - right) + wide[top + 1, left + 1] * right) * up)
        bad = ~inside | ~np.isfinite(height)
        if bad.any():
            first = int(np.argmax(bad))
            raise InputError(say("{name} does not reach latitude {flat:.4f}, longitude {flat_2:.4f}: give the geoid "
                                 "model of the survey's place.", name=self.name, flat=latitude.flat[first],
                                 flat_2=longitude.flat[first]))
        return height


@reads("a geoid model")
def read_geoid(path: str | os.PathLike) -> Geoid:
    """Read a geoid model: a raster in latitude and longitude (GeoTIFF, GTX), or a text grid of GSI (.asc, .isg).

    Raises
    ------
    InputError : it is neither, or its values are no heights of a geoid.
    """
    path = Path(path)
    geoid = _from_text(path) if path.suffix.lower() in _TEXT_SUFFIXES else _from_raster(path)
    if not (math.isfinite(geoid.south) and math.isfinite(geoid.west)
            and all(0.0 < step < 90.0 for step in geoid.steps)):
        raise InputError(say("{path} is no geoid model: its header must name its first node and the steps between "
                             "nodes in degrees, all greater than 0.", path=path.name))
    known = geoid.heights[np.isfinite(geoid.heights)]
    if min(geoid.heights.shape) < 2 or not len(known) or np.abs(known).max() > HIGHEST:
        raise InputError(say("{path} is no geoid model: its values must be heights of the geoid above the ellipsoid "
                             "in metres, none beyond {highest:g}.", path=path.name, highest=HIGHEST))
    return geoid


def _from_raster(path: Path) -> Geoid:
    try:
        with own_gdal(), rasterio.open(path) as source:
            place, crs = source.transform, source.crs
            heights = source.read(1, masked=True).astype(float).filled(np.nan)
    except OPENING_ERRORS as error:
        raise InputError(say("{path} cannot be read as a geoid model: give a GeoTIFF, a GTX or a text grid of GSI.",
                             path=path.name)) from error
    if place.b or place.d or place.a <= 0 or place.e >= 0 or (crs is not None and not crs.is_geographic):
        raise InputError(say("{path} is no geoid model: its cells must lie along latitude and longitude in degrees.",
                             path=path.name))
    rows = len(heights)
    # Values of a raster are those of the middles of its cells.
    return Geoid(path.name, heights[::-1], place.f + place.e * (rows - 0.5), place.c + 0.5 * place.a,
                 (-place.e, place.a))


def _from_text(path: Path) -> Geoid:
    text = read_text(path, "a geoid model")
    return _from_isg(path.name, text) if "end_of_head" in text else _from_gsi(path.name, text)


def _from_gsi(name: str, text: str) -> Geoid:
    """GSI's own grid: south, west, steps, rows, columns in the first line, then heights from south to north."""
    head, _, body = text.partition("\n")
    try:
        south, west, *steps = (float(value) for value in head.split()[:4])
        rows, columns = (int(value) for value in head.split()[4:6])
        d_latitude, d_longitude = map(_whole_seconds, steps)
    except (ArithmeticError, ValueError) as error:
        raise unreadable_part(name, say("line {number}", number=1), error) from error
    return Geoid(name, _grid(name, body, (rows, columns), 999.0, 2), south, west, (d_latitude, d_longitude))


def _from_isg(name: str, text: str) -> Geoid:
    """The text grid of the International Service for the Geoid: heights from north to south."""
    head, _, body = text.partition("end_of_head")
    entries = dict(re.split(r"\s*[:=]\s*", line.strip(), maxsplit=1) for line in head.splitlines()
                   if re.search(r"[:=]", line))
    number = partial(_entry, name, entries)
    south, north, west = (number(key, _angle) for key in ("lat min", "lat max", "lon min"))
    steps = tuple(_whole_seconds(number(key, _angle)) for key in ("delta lat", "delta lon"))
    rows, columns = number("nrows", int), number("ncols", int)
    nothing = number("nodata", float) if "nodata" in entries else -9999.0
    lines = head.count("\n") + 2
    heights = _grid(name, body.partition("\n")[2], (rows, columns), nothing, lines)[::-1]
    # Limits are those of the cells where there is one row for each step between them.
    half = 0.5 if abs(north - south - rows * steps[0]) < 0.5 * steps[0] else 0.0
    return Geoid(name, heights, south + half * steps[0], west + half * steps[1], steps)


def _entry(name: str, entries: Mapping[str, str], key: str, convert: Callable[[str], _Number]) -> _Number:
    """A number of the header."""
    try:
        value = convert(entries[key])
        if not math.isfinite(value):
            raise ValueError(f"could not convert string to float: {entries[key]!r}")
        return value
    except (ArithmeticError, LookupError, ValueError) as error:
        raise unreadable_part(name, say("“{name}” of its header", name=key), error) from error


def _angle(text: str) -> float:
    """Degrees, as a number or as degrees, minutes and seconds."""
    found = _DEGREES.match(text.strip())
    if not found:
        return float(text)
    degrees, minutes, seconds = found.groups()
    size = abs(int(degrees)) + int(minutes) / 60.0 + float(seconds) / 3600.0
    return -size if degrees.startswith("-") else size


def _whole_seconds(step: float) -> float:
    """A step whose decimals were cut, as the whole second that it is near."""
    seconds = round(step / _SECOND)
    return seconds * _SECOND if seconds and abs(step / _SECOND - seconds) < 0.01 else step


def _grid(name: str, body: str, shape: tuple[int, int], nothing: float, line: int) -> np.ndarray:
    """Heights (rows, columns) of a text that begins in a line of the file; NaN where they are `nothing`."""
    text = body.replace("end_of_data", "")
    try:
        values = np.array(text.split(), float)
    except ValueError as error:
        raise unreadable_part(name, say("line {number}", number=line + _bad_line(text)), error) from error
    if min(shape) < 1 or len(values) != shape[0] * shape[1]:
        raise InputError(say("{name} holds {values_count} heights, its header says {rows}: the file is cut off; "
                             "download it again.", name=name, values_count=len(values), rows=shape[0] * shape[1]))
    return np.where(np.isclose(values, nothing), np.nan, values).reshape(shape)


def _bad_line(text: str) -> int:
    """Number, from 0, of the first line of a text with something that is no number."""
    for number, line in enumerate(text.split("\n")):
        try:
            np.array(line.split(), float)
        except ValueError:
            return number
    return 0
