"""Vehicles taken out of orthophotos of the same ground (J 3.2.1.2), for users who have no frames."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import Executor
from contextlib import ExitStack
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import rasterio
from rasterio.enums import MaskFlags, Resampling
from rasterio.errors import RasterioError
from rasterio.transform import Affine
from rasterio.vrt import WarpedVRT
from rasterio.windows import Window

from ...errors import InputError
from ...geometry.grid import Grid
from ...io.raster import OPENING_ERRORS, own_gdal
from ...progress import SILENT, Progress
from ...wording import say
from .frame_shifts import FrameShift, frame_shifts, warn_of_shifts
from .mosaic import GroundView, Mosaic, MosaicFiles, PixelSelection, Workers, write_mosaic

_EDGE = 3  # pixels next to no data that a resampled orthophoto does not show surely


class OrthophotoSource:
    """An orthophoto on the grid of the first one, as a source of views. Use as a context manager.

    Attributes
    ----------
    bounds : (x_min, y_min, x_max, y_max) of that grid.
    bands, dtype : of the image without its alpha band.

    Raises
    ------
    InputError : the file is no raster or has no place.
    """

    def __init__(self, path: str | os.PathLike, grid: Grid | None = None, crs=None):
        self.name = Path(path).name
        with own_gdal():
            try:
                self._file = rasterio.open(path)
            except OPENING_ERRORS as error:
                raise InputError(say("{name} cannot be read as an image: check the file.", name=self.name)) from error
        if self._file.crs is None:
            self._file.close()
            raise InputError(say("{name} has no coordinate reference system: set it first.", name=self.name))
        self.crs = self._file.crs
        self.bands = 3 if self._file.count >= 3 else 1
        self.dtype = self._file.dtypes[0]
        self._masked = any(MaskFlags.all_valid not in flags for flags in self._file.mask_flag_enums[:self.bands])
        self.grid = grid or _grid_of(self._file, self.name)
        self.bounds = self.grid.bounds
        place = Affine(self.grid.cell, 0, self.grid.x_min, 0, -self.grid.cell, self.grid.y_max)
        same = self._file.transform.almost_equals(place) and crs in (None, self.crs)
        with own_gdal():
            self._view = self._file if same and self._file.shape == self.grid.shape else WarpedVRT(
                self._file, crs=crs or self.crs, transform=place, width=self.grid.columns, height=self.grid.rows,
                resampling=Resampling.cubic, add_alpha=MaskFlags.alpha not in self._file.mask_flag_enums[0])

    def __enter__(self) -> OrthophotoSource:
        return self

    def __exit__(self, *_exception: object) -> None:
        self._view.close()
        self._file.close()

    def lean(self, _x: np.ndarray, _y: np.ndarray) -> None:
        """None: the file does not say from where its pixels were taken."""

    def view(self, grid: Grid) -> GroundView | None:
        """The orthophoto's pixels on a window of its grid, which may reach beyond it."""
        top = round((self.grid.y_max - grid.y_max) / grid.cell)
        left = round((grid.x_min - self.grid.x_min) / grid.cell)
        rows = slice(max(top - _EDGE, 0), min(top + grid.rows + _EDGE, self.grid.rows))
        columns = slice(max(left - _EDGE, 0), min(left + grid.columns + _EDGE, self.grid.columns))
        if rows.stop <= rows.start or columns.stop <= columns.start:
            return None
        window = Window(columns.start, rows.start, columns.stop - columns.start, rows.stop - rows.start)
        try:
            with own_gdal():
                image = self._view.read(list(range(1, self.bands + 1)), window=window)
                mask = self._view.dataset_mask(window=window) > 0
        except RasterioError as error:
            raise InputError(say("{name} is damaged: {error}.", name=self.name, error=error)) from error
        if not mask.any():
            return None
        if self._view is not self._file:
            mask = cv2.erode(mask.astype(np.uint8), np.ones((_EDGE, _EDGE), np.uint8)) > 0
        values = np.zeros((*grid.shape, self.bands), np.float32)
        seen = np.zeros(grid.shape, bool)
        own_rows = slice(max(rows.start, top), min(rows.stop, top + grid.rows))
        own_columns = slice(max(columns.start, left), min(columns.stop, left + grid.columns))
        source = (slice(own_rows.start - rows.start, own_rows.stop - rows.start),
                  slice(own_columns.start - columns.start, own_columns.stop - columns.start))
        target = (slice(own_rows.start - top, own_rows.stop - top),
                  slice(own_columns.start - left, own_columns.stop - left))
        values[target] = np.moveaxis(image, 0, -1)[source]
        seen[target] = mask[source]
        return GroundView(values, seen, seen, partial(np.zeros, grid.shape, np.float32))


def _grid_of(source: rasterio.DatasetReader, name: str) -> Grid:
    """Grid of the first orthophoto, which must be north-up with square pixels."""
    place = source.transform
    if not np.isfinite(place[:6]).all():
        raise InputError(say("{name} says where it lies in numbers that are not finite: it is damaged; export it "
                             "again.", name=name))
    if place.b or place.d or place.a <= 0 or not np.isclose(place.a, -place.e, rtol=1e-6):
        raise InputError(say("{name} is turned or its pixels are not square: warp it to a north-up raster first.",
                             name=name))
    return Grid(place.c, place.f, place.a, source.height, source.width)


def open_orthophotos(orthophotos: Sequence[str | os.PathLike], stack: ExitStack) -> list[OrthophotoSource]:
    """Orthophotos on the grid of the first one; their files are closed by the stack."""
    first = stack.enter_context(OrthophotoSource(orthophotos[0]))
    sources = [first]
    for path in orthophotos[1:]:
        source = stack.enter_context(OrthophotoSource(path, first.grid, first.crs))
        if (source.bands, source.dtype) != (first.bands, first.dtype):
            raise InputError(say("{source} has {bands} bands of {dtype} but {first} {bands_2} of {dtype_2}: give "
                                 "orthophotos of one kind.", source=source.name, bands=source.bands, dtype=source.dtype,
                                 first=first.name, bands_2=first.bands, dtype_2=first.dtype))
        sources.append(source)
    return sources


def filter_vehicles(orthophotos: Sequence[str | os.PathLike], output: str | os.PathLike,
                    choice: PixelSelection | None = None, progress: Progress = SILENT,
                    shifts: list[FrameShift] | None = None, metres: float = 1.0,
                    executor: Executor | None = None) -> Mosaic:
    """One orthophoto without moving vehicles from several of the same ground, on the grid of the first.

    The others are resampled onto it, also from another CRS. They must show the same ground true to position: what
    stands on the ground leans differently in each.

    Parameters
    ----------
    orthophotos : at least two, 8 or 16 bit, grey or red, green, blue; no data by value, alpha or mask.
    shifts : a list to which the shifts between them are added; None not to measure them.
    metres : in a unit of the first one's CRS.
    executor : threads or processes that work on the pieces; the result does not depend on it.

    Raises
    ------
    InputError : fewer than two, or of different kinds.
    InsufficientDataError : no pixel has data.
    """
    if len(orthophotos) < 2:
        raise InputError(say("Vehicles can only be told by comparing: give two or more orthophotos of the same "
                             "ground."))
    with ExitStack() as stack:
        opener = partial(open_orthophotos, orthophotos)
        sources = opener(stack)
        first = sources[0]
        if shifts is not None:
            shifts += frame_shifts(sources, first.grid, progress.part(0.0, 0.1), metres)
            warn_of_shifts(shifts, first.grid.cell * metres, progress)
        mosaic = write_mosaic(sources, first.grid, first.crs.to_wkt(), first.bands, first.dtype, MosaicFiles(output),
                              choice, progress.part(0.1, 1.0), workers=Workers(executor, opener))
        if not mosaic.pixels_shared:
            progress.warn(say("No two of the orthophotos show the same ground: no vehicle was filtered."))
        return mosaic
