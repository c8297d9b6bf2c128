"""Road markings of an orthophoto file of any size: tile by tile, into a mask file and polygons (J 3.2.2)."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from functools import partial
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

from ...errors import InputError, OutputError
from ...execution import in_order
from ...geometry.tolerances import ROUNDING
from ...io.files.atomic import written_beside
from ...io.raster import OPENING_ERRORS, own_gdal
from ...progress import SILENT, Progress
from ...wording import say
from ..worker_resources import WorkerResource, sent_polygons, worker_resource
from .colour_cast import ColourCast
from .image_strips import row_strips, within
from .marking_evidence import SearchTally, evidence_of_light
from .marking_filter import coarse_step
from .marking_polygons import CACHE, MarkingPolygons, TilePolygons, merge_tile_polygons, tile_polygons
from .road_markings import (
    LevelAdjustment,
    Markings,
    MarkingSettings,
    find_markings,
    margin_pixels,
)
from .road_model import RoadModel
from .sampled_levels import sampled_levels
from .surroundings import cell_pixels


@dataclass(frozen=True)
class MarkingFilesLimits:
    """Limits of marking files, each with its unit."""

    # m. Finer pixels are taken together to this size or just below twice it: paint has no smaller detail.
    min_pixel: float = 0.06
    max_pixel: float = 0.5  # m. Markings are 0.1 to 0.45 m wide: with larger pixels there is nothing to see.
    mask_block: int = 256


LIMITS = MarkingFilesLimits()

_TILE = 2560
"""Pixels, side of a tile at most: what is worked on round tiles is then up to 0.65 of their own, and a process takes
0.6 GB."""


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


@dataclass(frozen=True)
class MarkingResult:
    """What was found.

    Attributes
    ----------
    polygons : markings with their attributes.
    pixel : side, m.
    searched_area : m2 of the image that could have shown some.
    marked_area : m2 of paint in the mask.
    road : the image's own road; None where it was not looked at.
    evidence : what was taken and rejected; None as well.
    paint_level : brightness that new paint has on ground as light as the median, as a share of the highest number that
        the image can hold; None as well.
    """

    polygons: MarkingPolygons
    pixel: float
    searched_area: float
    marked_area: float
    road: RoadModel | None = None
    evidence: SearchTally | None = None
    paint_level: float | None = None


class _OrthophotoReader:
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
        if self.own_pixel > LIMITS.max_pixel:
            raise InputError(say("{path} has pixels of {own_pixel:.2f} m, in which road markings cannot be seen: use "
                                 "an orthophoto of {max_pixel} m or finer.", path=self.path.name,
                                 own_pixel=self.own_pixel, max_pixel=LIMITS.max_pixel))
        self.factor = max(int(min_pixel / self.own_pixel), 1)
        self.pixel = self.own_pixel * self.factor
        self.rows = -(-self.source.height // self.factor)
        self.columns = -(-self.source.width // self.factor)
        self.transform = place * Affine.scale(self.factor)
        kind = np.dtype(self.source.dtypes[0])
        self.top = np.iinfo(kind).max if kind.kind in "iu" else np.inf  # that values can have
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

    def read(self, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
        """Bands, where ground is seen, and roads (or None) of a piece, in blocks of `factor` pixels."""
        factor = self.factor
        height = min(rows.stop * factor, self.source.height) - rows.start * factor
        width = min(columns.stop * factor, self.source.width) - columns.start * factor
        window = Window(columns.start * factor, rows.start * factor, width, height)
        try:
            bands = self.source.read(self.bands, window=window)
            seen = self.source.dataset_mask(window=window) > 0
            if self.mask is not None:
                seen &= self.mask.read(1, window=window) == 0
        except RasterioError as error:
            raise InputError(say("{path} is damaged: {error}.", path=self.path.name, error=error)) from error
        if np.issubdtype(bands.dtype, np.floating):
            seen &= np.isfinite(bands).all(axis=0)
            bands = np.where(seen, bands, 0)
        bands, seen = _in_blocks(bands, seen, factor)
        shape, place = seen.shape, self.transform * Affine.translation(columns.start, rows.start)
        if self.buildings is not None:
            seen &= ~_burnt(self.buildings, shape, place)
        return bands, seen, None if self.roads is None else _burnt(self.roads, shape, place)


    def places(self, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray]:
        """x and y of the pixels' centres of a piece, in the CRS; (rows, columns) or what broadcasts to it."""
        row = np.arange(rows.start, rows.stop)[:, None] + 0.5
        column = np.arange(columns.start, columns.stop)[None] + 0.5
        place = self.transform
        if not place.b and not place.d:
            return place.a * column + place.c, place.e * row + place.f
        return place.a * column + place.b * row + place.c, place.d * column + place.e * row + place.f

    def balanced(self, bands: np.ndarray, rows: slice, columns: slice, cast: ColourCast | None) -> np.ndarray:
        """Bands of a piece without a cast."""
        if cast is None or len(bands) < 3:
            return bands
        balanced_bands = np.empty_like(bands)
        for strip, _, _ in row_strips(bands.shape[1]):
            x, y = self.places(slice(rows.start + strip.start, rows.start + strip.stop), columns)
            balanced_bands[:, strip] = cast.removed(bands[:, strip], x, y)
        return balanced_bands


def colour_bands(source: rasterio.DatasetReader, path: Path) -> list[int]:
    """Numbers of the red, green and blue bands, or of the grey one.

    Raises
    ------
    InputError : there is none.
    """
    kinds = source.colorinterp
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


def markings_from_orthophoto(path: str | os.PathLike, output: str | os.PathLike, places: SearchArea | None = None,
                             settings: MarkingSettings | None = None, metres_per_unit: float = 1.0,
                             tile: int = _TILE, progress: Progress = SILENT,
                             executor: Executor | None = None) -> MarkingResult:
    """Find the road markings of an orthophoto; write a mask (uint8, 255 = marking) on the orthophoto's pixels.

    Only a tile and its surroundings are in memory for each worker; outlines wait in a file beside `output` that
    vanishes with the result. The mask does not depend on `tile`, the side of a tile in pixels; polygons only where
    pieces hang together by a corner on a seam. Nothing depends on the executor, threads or processes.
    `metres_per_unit` : of the orthophoto's CRS.

    Raises
    ------
    InputError : the orthophoto or the mask cannot be used.
    OutputError : the mask cannot be written.
    """
    settings, places = settings or MarkingSettings(), places or SearchArea()
    with own_gdal(CACHE), ExitStack() as stack:
        min_pixel = 0.0 if settings.paper else LIMITS.min_pixel
        scene = _OrthophotoReader(path, places, metres_per_unit, min_pixel, stack)
        if not scene.mask_covers():
            progress.warn(say("{mask} does not cover all of {path}: where it does not, nothing is taken as hidden.",
                              mask=Path(places.mask).name, path=scene.path.name))
        levels = sampled_levels(scene, settings, progress.part(0.0, 0.1))
        profile = {"driver": "GTiff", "width": scene.source.width, "height": scene.source.height, "count": 1,
                   "dtype": "uint8", "transform": scene.source.transform, "crs": scene.source.crs, "tiled": True,
                   "blockxsize": LIMITS.mask_block, "blockysize": LIMITS.mask_block, "compress": "deflate",
                   "bigtiff": "if_safer"}
        given = scene
        if executor is not None:
            stored = SearchArea(stack.enter_context(sent_polygons(places.roads)),
                                stack.enter_context(sent_polygons(places.buildings)), places.mask)
            given = stack.enter_context(worker_resource(partial(
                _OrthophotoReader, path, stored, metres_per_unit, min_pixel)))
        try:
            with written_beside(output) as temporary, rasterio.open(temporary, "w", **profile) as target:
                found = _found_in_tiles(given, scene, levels, settings, tile, progress.part(0.1, 1.0), executor)
                result = _gathered(found, scene, settings, target, metres_per_unit)
                if levels is None or not settings.cleaning:
                    return result
                return replace(result, road=levels.road, paint_level=levels.high / float(scene.top))
        except RasterioError as error:
            raise OutputError(say("{output} cannot be written ({error}): choose another output.",
                                  output=Path(output).name, error=error)) from error


def levels_of_orthophoto(path: str | os.PathLike, places: SearchArea | None = None,
                         settings: MarkingSettings | None = None, metres_per_unit: float = 1.0,
                         progress: Progress = SILENT) -> LevelAdjustment | None:
    """Levels of an orthophoto that is worked on in parts; None where nothing of it is to be looked at.

    Parameters and errors are those of `markings_from_orthophoto`.
    """
    settings = settings or MarkingSettings()
    with own_gdal(CACHE), ExitStack() as stack:
        min_pixel = 0.0 if settings.paper else LIMITS.min_pixel
        scene = _OrthophotoReader(path, places or SearchArea(), metres_per_unit, min_pixel, stack)
        return sampled_levels(scene, settings, progress)


@dataclass(frozen=True)
class _TileFound:
    """What a tile holds: its rows and columns of the scene, mask, outlines, pixels that could show markings, and
    evidence."""

    rows: slice
    columns: slice
    mask: np.ndarray
    pieces: TilePolygons | None
    searched_area: int
    evidence: SearchTally = field(default_factory=SearchTally)


def _found_in_tiles(given: _OrthophotoReader | WorkerResource, scene: _OrthophotoReader,
                    levels: LevelAdjustment | None, settings: MarkingSettings, tile: int, progress: Progress,
                    executor: Executor | None) -> Iterator[_TileFound]:
    """Work on all tiles, here or on the executor."""
    step = coarse_step(settings.cleaning.vehicle_width / scene.pixel) if settings.cleaning else 1
    if settings.cleaning and settings.cleaning.trained:
        step = math.lcm(step, cell_pixels(scene.pixel))

    def places() -> Iterator[tuple[slice, slice]]:
        for rows, columns, done in _tiles(scene, max(tile // scene.factor, 1), step):
            progress.step(done)
            yield rows, columns

    work = partial(_tile_found, given, levels, settings, step)
    return in_order(work, places(), executor, progress.check)


def _tile_found(given: _OrthophotoReader | WorkerResource, levels: LevelAdjustment | None, settings: MarkingSettings,
                step: int, place: tuple[slice, slice]) -> _TileFound:
    rows, columns = place
    if levels is None:
        nothing = np.zeros((rows.stop - rows.start, columns.stop - columns.start), bool)
        return _TileFound(rows, columns, nothing, None, 0)
    with own_gdal(CACHE):
        scene = given.get() if isinstance(given, WorkerResource) else given
        markings, searched, window = _tile_markings(scene, rows, columns, levels, settings, step)
    mask = markings.mask[within((rows, columns), window)].copy()
    pieces = tile_polygons(markings, window, rows, columns, scene.transform) if mask.any() else None
    return _TileFound(rows, columns, mask, pieces, searched, markings.evidence)


def _gathered(found: Iterator[_TileFound], scene: _OrthophotoReader, settings: MarkingSettings,
              target: rasterio.io.DatasetWriter, metres_per_unit: float) -> MarkingResult:
    """Write the masks and join the outlines of all tiles."""
    searched_area = marked = 0
    evidence = SearchTally()

    def pieces() -> Iterator[TilePolygons]:
        nonlocal searched_area, marked, evidence
        for part in found:
            evidence += part.evidence
            searched_area += part.searched_area
            marked += int(part.mask.sum())
            _write(target, part.mask, part.rows, part.columns, scene.factor)
            if part.pieces is not None:
                yield part.pieces

    cell = scene.pixel ** 2
    min_area = settings.cleaning.min_area if settings.cleaning else 0.0
    polygons = merge_tile_polygons(pieces(), scene.transform, metres_per_unit, min_area, Path(target.name).parent)
    return MarkingResult(polygons, scene.own_pixel, searched_area * cell, marked * cell,
                         evidence=evidence if settings.cleaning else None)


def _tile_markings(scene: _OrthophotoReader, rows: slice, columns: slice, levels: LevelAdjustment,
                   settings: MarkingSettings, step: int) -> tuple[Markings, int, tuple[slice, slice]]:
    """Markings of a tile and of the first line of the next ones, how many pixels of the tile may show some, and rows
    and columns of the markings."""
    around = -(-margin_pixels(scene.pixel, settings) // step) * step
    window = (slice(max(rows.start - around, 0), min(rows.stop + around, scene.rows)),
              slice(max(columns.start - around, 0), min(columns.stop + around, scene.columns)))
    wanted = (slice(rows.start, min(rows.stop + 1, scene.rows)),
              slice(columns.start, min(columns.stop + 1, scene.columns)))
    bands, seen, roads = scene.read(*window)
    bands = scene.balanced(bands, *window, levels.cast)
    allowed = seen if roads is None else seen & roads
    if not allowed.any():
        empty = np.zeros((wanted[0].stop - wanted[0].start, wanted[1].stop - wanted[1].start), np.float32)
        return Markings(empty > 0, empty - 1, empty, empty > 0, empty), 0, wanted
    searched = int(np.count_nonzero(allowed[within((rows, columns), window)]))
    markings = find_markings(bands, seen, roads, scene.pixel, levels, settings, within(wanted, window))
    place = within((rows, columns), window)
    light = evidence_of_light(bands[:, place[0], place[1]], seen[place], scene.top)
    return replace(markings, evidence=markings.evidence + light), searched, wanted


def _tiles(scene: _OrthophotoReader, most: int, step: int) -> Iterator[tuple[slice, slice, float]]:
    """Rows and columns of every tile, and the fraction done before it.

    Tiles are about as large as each other, whole blocks of the mask's file where that fits, and multiples of `step`.
    """
    high, wide = (_side(length, most, step) for length in (scene.rows, scene.columns))
    down, across = -(-scene.rows // high), -(-scene.columns // wide)
    for number in range(down * across):
        row, column = number // across * high, number % across * wide
        yield (slice(row, min(row + high, scene.rows)), slice(column, min(column + wide, scene.columns)),
               number / (down * across))


def _side(length: int, most: int, step: int) -> int:
    """Side of tiles that share a length evenly, at most `most`."""
    most = max(most // step, 1) * step
    side = -(-length // -(-length // most))
    unit = math.lcm(LIMITS.mask_block, step)
    return min(-(-side // unit) * unit, most)


def _write(target: rasterio.io.DatasetWriter, mask: np.ndarray, rows: slice, columns: slice, factor: int) -> None:
    values = np.where(mask, np.uint8(255), np.uint8(0))
    values = np.repeat(np.repeat(values, factor, axis=0), factor, axis=1)
    row, column = rows.start * factor, columns.start * factor
    values = values[:target.height - row, :target.width - column]
    target.write(values, 1, window=Window(column, row, values.shape[1], values.shape[0]))


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
