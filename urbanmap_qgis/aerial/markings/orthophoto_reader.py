"""An orthophoto file of any size, read by pieces: its bands, where ground is seen, and what limits the search."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import rasterio
import shapely
from rasterio.enums import ColorInterp
from rasterio.errors import RasterioError
from rasterio.features import rasterize
from rasterio.transform import Affine
from rasterio.vrt import WarpedVRT
from rasterio.windows import Window

from ...errors import InputError
from ...geometry.tolerances import ROUNDING
from ...io.raster import OPENING_ERRORS
from ...io.reference.true_lengths import require_true_lengths
from ...progress import notice
from ...wording import say
from ..valid_pixels import valid_pixels

MAX_PIXEL = 0.5
"""m. Markings are 0.1 to 0.45 m wide: with larger pixels there is nothing to see."""


@dataclass(frozen=True)
class SearchArea:
    """Where markings are searched for; shapely polygons in the orthophoto's CRS, and a raster file.

    Parameters
    ----------
    roads : only inside them; None for everywhere.
    buildings : not inside them.
    mask : raster, not where it is above 0.
    """

    roads: Sequence[shapely.Geometry] | None = None
    buildings: Sequence[shapely.Geometry] | None = None
    mask: str | os.PathLike | None = None


class OrthophotoReader:
    """Open orthophoto and what limits the search; reads pieces of them by blocks of `factor` pixels."""

    def __init__(self, path: str | os.PathLike, places: SearchArea, metres_per_unit: float, min_pixel: float,
                 stack: ExitStack):
        self.path = Path(path)
        try:
            self.source = stack.enter_context(rasterio.open(self.path))
        except OPENING_ERRORS as error:
            raise InputError(say("{path} cannot be read as a raster: check the file.", path=self.path.name)) from error
        self.bands = colour_bands(self.source, self.path)
        place = self.source.transform
        if not np.isfinite(place[:6]).all():
            raise InputError(say("{path} says where it lies in numbers that are not finite: it is damaged; export it "
                                 "again.", path=self.path.name))
        across, down = math.hypot(place.a, place.d), math.hypot(place.b, place.e)
        if not across * down:
            raise InputError(say("{path} has cells of no size: it is damaged; export it again.", path=self.path.name))
        if not 0.9 < across / down < 1.1 or abs(place.a * place.b + place.d * place.e) > 0.1 * across * down:
            raise InputError(say("{path} has pixels that are not square: warp it to square pixels first.",
                                 path=self.path.name))
        self.own_pixel = math.sqrt(across * down) * metres_per_unit
        if self.own_pixel > MAX_PIXEL:
            raise InputError(say("{path} has pixels of {own_pixel:.2f} m, in which road markings cannot be seen: use "
                                 "an orthophoto of {max_pixel} m or finer.", path=self.path.name,
                                 own_pixel=self.own_pixel, max_pixel=MAX_PIXEL))
        require_true_lengths(self.path.name, self.source.crs and self.source.crs.to_wkt(), self.source.bounds)
        self.factor = max(int(min_pixel / self.own_pixel), 1)
        self.pixel = self.own_pixel * self.factor
        self.rows = -(-self.source.height // self.factor)
        self.columns = -(-self.source.width // self.factor)
        self.transform = place * Affine.scale(self.factor)
        kind = np.dtype(self.source.dtypes[0])
        self.top = np.iinfo(kind).max if kind.kind in "iu" else np.inf  # that values can have
        self._white = self._pixels = 0
        self.roads = _tree(places.roads)
        self.buildings = _tree(places.buildings)
        self.mask = self._mask_on_grid(places.mask, stack) if places.mask else None

    def _mask_on_grid(self, path: str | os.PathLike, stack: ExitStack) -> WarpedVRT:
        try:
            mask = stack.enter_context(rasterio.open(path))
        except OPENING_ERRORS as error:
            raise InputError(say("{path} cannot be read as a raster: check the file.", path=Path(path).name)) from error
        bounds, other = self.source.bounds, mask.bounds
        if (bounds.left >= other.right or bounds.right <= other.left or bounds.bottom >= other.top
                or bounds.top <= other.bottom):
            raise InputError(say("{path} does not reach {path_2}: give a mask of the same place.", path=Path(path).name,
                                 path_2=self.path.name))
        return stack.enter_context(WarpedVRT(
            mask, crs=self.source.crs, src_crs=mask.crs or self.source.crs, transform=self.source.transform,
            width=self.source.width, height=self.source.height, add_alpha=False))

    def mask_covers(self) -> bool:
        """Whether the mask, if any, reaches over the whole orthophoto."""
        if self.mask is None:
            return True
        bounds, other, slack = self.source.bounds, self.mask.src_dataset.bounds, abs(self.transform.a) + ROUNDING
        return (other.left <= bounds.left + slack and other.right >= bounds.right - slack
                and other.bottom <= bounds.bottom + slack and other.top >= bounds.top - slack)

    def tell_white_specks(self) -> None:
        """Tell which share of what was read so far has the no-data value and is taken as white."""
        if self._white:
            notice(say("{path} has the no-data value {nodata:g} within the image too, as saturated paint has: specks "
                       "of it ({share:.2f} % of the pixels looked at) are taken as white.", path=self.path.name,
                       nodata=self.source.nodata, share=100.0 * self._white / self._pixels))

    def read(self, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
        """Bands, where ground is seen, and roads (or None) of a piece, in blocks of `factor` pixels."""
        factor = self.factor
        height = min(rows.stop * factor, self.source.height) - rows.start * factor
        width = min(columns.stop * factor, self.source.width) - columns.start * factor
        window = Window(columns.start * factor, rows.start * factor, width, height)
        try:
            bands = self.source.read(self.bands, window=window)
            seen, white = valid_pixels(self.source, window)
            if self.mask is not None:
                seen &= self.mask.read(1, window=window) == 0
        except RasterioError as error:
            raise InputError(say("{path} is damaged: {error}.", path=self.path.name, error=error)) from error
        self._white += white
        self._pixels += seen.size
        if np.issubdtype(bands.dtype, np.floating):
            seen &= np.isfinite(bands).all(axis=0)
            bands = np.where(seen, bands, 0)
        bands, seen = _in_blocks(bands, seen, factor)
        shape, place = seen.shape, self.transform * Affine.translation(columns.start, rows.start)
        if self.buildings is not None:
            seen &= ~_burnt(self.buildings, shape, place)
        return bands, seen, None if self.roads is None else _burnt(self.roads, shape, place)


def colour_bands(source: rasterio.DatasetReader, path: Path) -> list[int]:
    """Numbers of the red, green and blue bands, or of the grey one.

    Raises
    ------
    InputError : there is none, or the file is damaged.
    """
    try:
        kinds = source.colorinterp
    except OPENING_ERRORS as error:
        raise InputError(say("{path} is damaged: {error}.", path=path.name, error=error)) from error
    if ColorInterp.palette in kinds:
        raise InputError(say("{path} has a colour table: convert it to red, green and blue first.", path=path.name))
    if source.dtypes and source.dtypes[0].startswith("complex"):
        raise InputError(say("{path} holds complex numbers, no image: give an orthophoto.", path=path.name))
    wanted = ColorInterp.red, ColorInterp.green, ColorInterp.blue
    colours = [kinds.index(kind) + 1 for kind in wanted if kind in kinds]
    if len(colours) == 3:
        return colours
    plain = [band + 1 for band, kind in enumerate(kinds) if kind != ColorInterp.alpha]
    if not plain:
        raise InputError(say("{path} has no image bands: give an orthophoto in grey or in red, green and blue.",
                             path=path.name))
    return plain[:3] if len(plain) >= 3 else plain[:1]


def _in_blocks(bands: np.ndarray, seen: np.ndarray, factor: int) -> tuple[np.ndarray, np.ndarray]:
    """Means of blocks of pixels; a block is seen where all of it is."""
    if factor == 1:
        return bands, seen
    shape = -(-seen.shape[0] // factor), -(-seen.shape[1] // factor)
    pad = ((0, shape[0] * factor - seen.shape[0]), (0, shape[1] * factor - seen.shape[1]))
    seen = np.pad(seen, pad, mode="edge").reshape(shape[0], factor, shape[1], factor).all(axis=(1, 3))
    size = shape[1], shape[0]
    return np.stack([cv2.resize(np.pad(band, pad, mode="edge").astype(np.float32), size, interpolation=cv2.INTER_AREA)
                     for band in bands]), seen


def _tree(polygons: Sequence[shapely.Geometry] | None) -> shapely.STRtree | None:
    return None if polygons is None else shapely.STRtree(list(polygons))


def _burnt(tree: shapely.STRtree, shape: tuple[int, int], place: Affine) -> np.ndarray:
    """Pixels whose centre lies in one of the polygons, bool."""
    corners = [place @ corner if hasattr(place, "__matmul__") else place * corner
               for corner in ((0, 0), (shape[1], 0), (shape[1], shape[0]), (0, shape[0]))]
    near = tree.geometries[tree.query(shapely.Polygon(corners))]
    if not len(near):
        return np.zeros(shape, dtype=bool)
    return rasterize([(geometry, 1) for geometry in near], shape, transform=place, dtype="uint8") > 0
