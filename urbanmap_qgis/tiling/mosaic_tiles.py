"""Rasters cut for tiles, and those of tiles as one raster."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import rasterio
from rasterio.errors import RasterioError
from rasterio.transform import Affine
from rasterio.windows import Window

from ..errors import InputError, OutputError
from ..io.files.atomic import written_beside
from ..io.raster import own_gdal
from ..progress import SILENT, Progress
from ..wording import say
from .tile_grid import Bounds, GridTile

_BLOCK = 512


def write_tile_raster(source: str | os.PathLike, bounds: Bounds, path: str | os.PathLike) -> bool:
    """Copy the pixels of a raster that a box meets, as they are; False, and no file, where it meets none."""
    with own_gdal(), rasterio.open(source) as raster:
        left, top = _cells(raster.transform, bounds[0], bounds[3])
        right, bottom = _cells(raster.transform, bounds[2], bounds[1])
        left, top = max(math.floor(left), 0), max(math.floor(top), 0)
        right, bottom = min(math.ceil(right), raster.width), min(math.ceil(bottom), raster.height)
        if right <= left or bottom <= top:
            return False
        window = Window(left, top, right - left, bottom - top)
        profile = {**raster.profile, "driver": "GTiff", "width": window.width, "height": window.height,
                   "transform": raster.window_transform(window), "compress": "deflate", "zlevel": 1, "tiled": True,
                   "blockxsize": 256, "blockysize": 256}
        profile.pop("photometric", None)
        with rasterio.open(path, "w", **profile) as target:
            target.write(raster.read(window=window))
            target.colorinterp = raster.colorinterp
        return True


def mosaic_tiles(parts: Sequence[tuple[Path, GridTile]], path: str | os.PathLike,
                 progress: Progress = SILENT) -> None:
    """Write one GeoTIFF of the cores of tiles' rasters; memory is that of one tile.

    Parameters
    ----------
    parts : raster of each tile, and the tile. A cell belongs to the tile that its centre lies in.

    Raises
    ------
    InputError : the rasters' cells do not fall on each other.
    """
    with own_gdal():
        with rasterio.open(parts[0][0]) as first:
            profile, place, tags = first.profile, first.transform, first.tags()
        left, top, right, bottom = _extent([Path(part) for part, _ in parts], place)
        transform = place * Affine.translation(left, top)
        profile.update(driver="GTiff", width=right - left, height=bottom - top, transform=transform, tiled=True,
                       blockxsize=_BLOCK, blockysize=_BLOCK, compress="deflate", bigtiff="if_safer")
        try:
            with written_beside(path) as temporary, rasterio.open(temporary, "w+", **profile) as target:
                target.update_tags(**{key: value for key, value in tags.items() if key != "AREA_OR_POINT"})
                for done, (part, tile) in enumerate(parts):
                    _write_core(part, tile, target)
                    progress.step((done + 1) / len(parts))
        except RasterioError as error:
            raise OutputError(say("{path} cannot be written ({error}).", path=Path(path).name, error=error)) from error


def _cells(place: Affine, x: float, y: float) -> tuple[float, float]:
    """Column and row, with fractions, of a point in a raster placed so."""
    return ~place * (x, y)


def _extent(paths: Sequence[Path], place: Affine) -> tuple[int, int, int, int]:
    """Columns and rows (left, top, right, bottom) around all rasters, counted in the cells of `place`."""
    boxes = []
    for path in paths:
        with rasterio.open(path) as source:
            column, row = _cells(place, source.transform.c, source.transform.f)
            same = abs(source.transform.a - place.a) < 1e-9 * abs(place.a)
            if not same or max(abs(column - round(column)), abs(row - round(row))) > 1e-3:
                raise InputError(say("{path} of the tile {parent} has other cells than the first tile: the rasters "
                                     "cannot be put together.", path=path.name, parent=path.parent.name))
            boxes.append((round(column), round(row), round(column) + source.width, round(row) + source.height))
    return (min(box[0] for box in boxes), min(box[1] for box in boxes), max(box[2] for box in boxes),
            max(box[3] for box in boxes))


def _write_core(path: Path, tile: GridTile, target: rasterio.io.DatasetWriter) -> None:
    """Copy the cells of a raster whose centres lie in the tile."""
    with rasterio.open(path) as source:
        x_min, y_min, x_max, y_max = tile.core
        left, top = _cells(source.transform, x_min, y_max)
        right, bottom = _cells(source.transform, x_max, y_min)
        first = max(math.ceil(left - 0.5), 0), max(math.floor(top - 0.5) + 1, 0)
        last = min(math.ceil(right - 0.5), source.width), min(math.floor(bottom - 0.5) + 1, source.height)
        if last[0] <= first[0] or last[1] <= first[1]:
            return
        window = Window(first[0], first[1], last[0] - first[0], last[1] - first[1])
        x, y = source.transform * (first[0], first[1])
        column, row = (round(value) for value in _cells(target.transform, x, y))
        values, target_window = source.read(window=window), Window(column, row, window.width, window.height)
        if not tile.fills_core:  # what lies in the box but in a neighbour stays as it is
            column, row = np.meshgrid(np.arange(first[0], last[0]), np.arange(first[1], last[1]))
            in_tile = tile.owns(*(source.transform * (column.ravel() + 0.5, row.ravel() + 0.5)))
            values = np.where(in_tile.reshape(column.shape), values, target.read(window=target_window))
        target.write(values, window=target_window)
