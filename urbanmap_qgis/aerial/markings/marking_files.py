"""Road markings of an orthophoto file of any size: tile by tile, into a mask file and polygons (J 3.2.2)."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import numpy as np
import rasterio
from rasterio.errors import RasterioError
from rasterio.windows import Window

from ...errors import OutputError
from ...execution import in_order
from ...io.files.atomic import written_beside
from ...io.raster import own_gdal
from ...progress import SILENT, Progress
from ...wording import say
from ..worker_resources import WorkerResource, sent_polygons, worker_resource
from .image_strips import within
from .marking_evidence import SearchTally, evidence_of_light
from .marking_polygons import CACHE, MarkingPolygons, TilePolygons, merge_tile_polygons, tile_polygons
from .orthophoto_reader import OrthophotoReader, SearchArea
from .road_markings import LevelAdjustment, Markings, MarkingSettings, find_markings, margin_pixels, tile_step
from .road_model import RoadModel
from .sampled_levels import sampled_levels


@dataclass(frozen=True)
class MarkingFilesLimits:
    """Limits of marking files, each with its unit."""

    # m. Finer pixels are taken together to this size or just below twice it: paint has no smaller detail.
    min_pixel: float = 0.06
    mask_block: int = 256


LIMITS = MarkingFilesLimits()

TILE = 2560
"""Pixels, side of a tile at most: what is worked on round tiles is then up to 0.65 of their own, and a process takes
0.6 GB."""


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


def markings_from_orthophoto(path: str | os.PathLike, output: str | os.PathLike, places: SearchArea | None = None,
                             settings: MarkingSettings | None = None, metres_per_unit: float = 1.0,
                             tile: int = TILE, progress: Progress = SILENT,
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
        scene = open_orthophoto(path, places, settings, metres_per_unit, stack)
        if not scene.mask_covers():
            progress.warn(say("{mask} does not cover all of {path}: where it does not, nothing is taken as hidden.",
                              mask=Path(places.mask).name, path=scene.path.name))
        levels = sampled_levels(scene, settings, progress.part(0.0, 0.1))
        scene.tell_white_specks()
        profile = {"driver": "GTiff", "width": scene.source.width, "height": scene.source.height, "count": 1,
                   "dtype": "uint8", "transform": scene.source.transform, "crs": scene.source.crs, "tiled": True,
                   "blockxsize": LIMITS.mask_block, "blockysize": LIMITS.mask_block, "compress": "deflate",
                   "bigtiff": "if_safer"}
        given: OrthophotoReader | WorkerResource[OrthophotoReader] = scene
        if executor is not None:
            stored = SearchArea(stack.enter_context(sent_polygons(places.roads)),
                                stack.enter_context(sent_polygons(places.buildings)), places.mask)
            given = stack.enter_context(worker_resource(partial(
                OrthophotoReader, path, stored, metres_per_unit, _min_pixel(settings))))
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
        scene = open_orthophoto(path, places or SearchArea(), settings, metres_per_unit, stack)
        levels = sampled_levels(scene, settings, progress)
        scene.tell_white_specks()
        return levels


def open_orthophoto(path: str | os.PathLike, places: SearchArea, settings: MarkingSettings, metres_per_unit: float,
                    stack: ExitStack) -> OrthophotoReader:
    """An orthophoto to be read piece by piece, as long as the stack is open."""
    return OrthophotoReader(path, places, metres_per_unit, _min_pixel(settings), stack)


def _min_pixel(settings: MarkingSettings) -> float:
    return 0.0 if settings.paper else LIMITS.min_pixel


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


def _found_in_tiles(given: OrthophotoReader | WorkerResource, scene: OrthophotoReader,
                    levels: LevelAdjustment | None, settings: MarkingSettings, tile: int, progress: Progress,
                    executor: Executor | None) -> Iterator[_TileFound]:
    """Work on all tiles, here or on the executor."""
    step = tile_step(scene.pixel, settings)

    def places() -> Iterator[tuple[slice, slice]]:
        for rows, columns, done in image_tiles(scene, max(tile // scene.factor, 1), step):
            progress.step(done)
            yield rows, columns

    work = partial(_tile_found, given, levels, settings)
    return in_order(work, places(), executor, progress.check)


def _tile_found(given: OrthophotoReader | WorkerResource, levels: LevelAdjustment | None, settings: MarkingSettings,
                place: tuple[slice, slice]) -> _TileFound:
    rows, columns = place
    if levels is None:
        nothing = np.zeros((rows.stop - rows.start, columns.stop - columns.start), bool)
        return _TileFound(rows, columns, nothing, None, 0)
    with own_gdal(CACHE):
        scene = given.get() if isinstance(given, WorkerResource) else given
        markings, searched, window = _tile_markings(scene, rows, columns, levels, settings)
    mask = markings.mask[within((rows, columns), window)].copy()
    pieces = tile_polygons(markings, window, rows, columns, scene.transform) if mask.any() else None
    return _TileFound(rows, columns, mask, pieces, searched, markings.evidence)


def _gathered(found: Iterator[_TileFound], scene: OrthophotoReader, settings: MarkingSettings,
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


def tile_window(scene: OrthophotoReader, rows: slice, columns: slice, settings: MarkingSettings
                ) -> tuple[slice, slice]:
    """Rows and columns of a tile with all that its result depends on."""
    step = tile_step(scene.pixel, settings)
    around = -(-margin_pixels(scene.pixel, settings) // step) * step
    return (slice(max(rows.start - around, 0), min(rows.stop + around, scene.rows)),
            slice(max(columns.start - around, 0), min(columns.stop + around, scene.columns)))


def _tile_markings(scene: OrthophotoReader, rows: slice, columns: slice, levels: LevelAdjustment,
                   settings: MarkingSettings) -> tuple[Markings, int, tuple[slice, slice]]:
    """Markings of a tile and of the first line of the next ones, how many pixels of the tile may show some, and rows
    and columns of the markings."""
    window = tile_window(scene, rows, columns, settings)
    wanted = (slice(rows.start, min(rows.stop + 1, scene.rows)),
              slice(columns.start, min(columns.stop + 1, scene.columns)))
    bands, seen, roads = scene.read(*window)
    allowed = seen if roads is None else seen & roads
    if not allowed.any():
        empty = np.zeros((wanted[0].stop - wanted[0].start, wanted[1].stop - wanted[1].start), np.float32)
        return Markings(empty > 0, empty - 1, empty, empty > 0, empty), 0, wanted
    searched = int(np.count_nonzero(allowed[within((rows, columns), window)]))
    markings = find_markings(bands, seen, roads, scene.pixel, levels, settings, within(wanted, window))
    place = within((rows, columns), window)
    light = evidence_of_light(bands[:, place[0], place[1]], seen[place], scene.top)
    return replace(markings, evidence=markings.evidence + light), searched, wanted


def image_tiles(scene: OrthophotoReader, most: int, step: int) -> Iterator[tuple[slice, slice, float]]:
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
    if factor > 1:
        values = np.repeat(np.repeat(values, factor, axis=0), factor, axis=1)
    row, column = rows.start * factor, columns.start * factor
    values = values[:target.height - row, :target.width - column]
    target.write(values, 1, window=Window(column, row, values.shape[1], values.shape[0]))
