"""Many views of the ground made into one image, tile by tile."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol

import numpy as np
import rasterio
from rasterio.crs import CRS
from rasterio.errors import CRSError, RasterioError
from rasterio.transform import Affine
from rasterio.windows import Window

from ...errors import InputError, InsufficientDataError, OutputError
from ...execution import in_order
from ...geometry.grid import Grid
from ...io.files.atomic import written_beside
from ...io.raster import own_gdal
from ...progress import SILENT, Progress
from ...wording import say
from ..worker_resources import WorkerResource, worker_resource
from .gain_compensation import GainCorrection, RadiometricSamples, compensate_gains
from .vehicles import REACH, composite, darkest, majority_vote, steepest_view

TILE = 768
"""Rows and columns of the pieces that the mosaic is made in."""

_BLOCK = 256
_SAMPLES = 60_000  # ground points at which exposures are compared
_FULL_SCALE = {"uint8": 255, "uint16": 65535}


@dataclass(frozen=True)
class GroundView:
    """What one source shows of a grid.

    Attributes
    ----------
    values : (rows, columns, bands) float32.
    seen : (rows, columns), True where these are values of the ground.
    reached : True where they would be if nothing stood in the way; False where a building covers the ground.
    tangent : gives that of the angle between the ray and the vertical, float32, which few need.
    level : True where nothing stands on the ground; None where no surface tells.
    """

    values: np.ndarray
    seen: np.ndarray
    reached: np.ndarray
    tangent: Callable[[], np.ndarray]
    level: np.ndarray | None = None


class ViewSource(Protocol):
    """A frame or an orthophoto."""

    name: str
    bounds: tuple[float, float, float, float] | None

    def lean(self, x: np.ndarray, y: np.ndarray) -> np.ndarray | None:
        """How far what stands at places is displaced, m east and north a metre of height, (n, 2); None if unknown."""

    def view(self, grid: Grid) -> GroundView | None:
        """Its pixels on a grid; None where it shows nothing of it."""


@dataclass(frozen=True)
class PixelSelection:
    """How the mosaic takes each pixel.

    Attributes
    ----------
    method : "nadir" (the steepest view), "darkest" (J 3.2.1.2) or "vote" (see `vehicles.majority_vote`).
    even : whether gains of overlapping images are compensated first.
    """

    method: str = "vote"
    even: bool = True

    @classmethod
    def of(cls, method: str, even: bool) -> PixelSelection:
        """The choice by the name of a method; "paper" is the darkest view of the images as they are."""
        return cls("darkest", False) if method == "paper" else cls(method, even)

    def number(self, values: np.ndarray, seen: np.ndarray, views: Sequence[GroundView], full_scale: float
               ) -> np.ndarray:
        """Number of the view taken in each pixel, -1 for none; `values` are those of the views, compensated."""
        if self.method == "nadir":
            return steepest_view(np.stack([view.tangent() for view in views]), seen)
        return darkest(values, seen) if self.method == "darkest" else majority_vote(values, seen, full_scale)


@dataclass(frozen=True)
class Mosaic:
    """What was made.

    Attributes
    ----------
    grid : of the files.
    used : sources that gave pixels.
    pixels_seen : that hold an image.
    pixels_shared : that two or more sources see.
    pixels_hidden : in reach of a source, not covered by a building, but seen by none.
    gains : corrections of the sources.
    """

    grid: Grid
    used: int
    pixels_seen: int
    pixels_shared: int
    pixels_hidden: int
    gains: GainCorrection

    @property
    def share_seen(self) -> float:
        """Share of the ground in reach of the sources, outside buildings, that has an image, 0 to 1."""
        return self.pixels_seen / (self.pixels_seen + self.pixels_hidden)

    @property
    def hidden_area(self) -> float:
        """Holes, m2: ground outside buildings that no source sees."""
        return self.pixels_hidden * self.grid.cell ** 2


def covering_grid(sources: Sequence[ViewSource], cell: float) -> Grid:
    """Grid over all that the sources can show, its edges at multiples of `cell` (m)."""
    boxes = np.array([source.bounds for source in sources if source.bounds is not None])
    if not len(boxes):
        raise InsufficientDataError(say("No frame shows any of the ground: check that frames, exterior orientation "
                                        "and ground lie in the same place and coordinate system."))
    return Grid.covering(*boxes[:, :2].min(axis=0), *boxes[:, 2:].max(axis=0), cell)


def tiles(grid: Grid, side: int = TILE) -> Iterator[tuple[int, int, Grid]]:
    """First row, first column and grid of every piece."""
    for top in range(0, grid.rows, side):
        for left in range(0, grid.columns, side):
            yield top, left, Grid(grid.x_min + left * grid.cell, grid.y_max - top * grid.cell, grid.cell,
                                  min(side, grid.rows - top), min(side, grid.columns - left))


def _aligned_pieces(grid: Grid) -> Iterator[tuple[int, int, Grid]]:
    """Pieces that begin at blocks of the file; what is left at the right and below, up to a block, goes with the piece
    before, as the margin round a piece of its own would cost more than it."""
    tops, lefts = (list(range(0, max(size - _BLOCK, 1), TILE)) for size in grid.shape)
    for top, below in zip(tops, [*tops[1:], grid.rows]):
        for left, right in zip(lefts, [*lefts[1:], grid.columns]):
            yield top, left, Grid(grid.x_min + left * grid.cell, grid.y_max - top * grid.cell, grid.cell,
                                  below - top, right - left)


def gain_correction_of(sources: Sequence[ViewSource], grid: Grid, bands: int,
                       progress: Progress = SILENT) -> GainCorrection:
    """Corrections of the sources, from ground points spread evenly over the grid."""
    cell = max(4 * grid.cell, math.sqrt(grid.rows * grid.columns * grid.cell ** 2 / _SAMPLES))
    coarse = Grid.covering(*grid.bounds, cell)
    side = max(8, int(TILE * grid.cell / cell))
    parts = []
    for top, left, tile in tiles(coarse, side):
        progress.step(top / coarse.rows)
        point = np.arange(tile.columns) + left + (np.arange(tile.rows) + top)[:, None] * coarse.columns
        for number, source in reaching(sources, tile):
            view = source.view(tile)
            if view is not None and view.seen.any():
                parts.append((np.full(view.seen.sum(), number), point[view.seen], view.values[view.seen]))
    if not parts:
        return GainCorrection.identity(len(sources), bands)
    return compensate_gains(RadiometricSamples(*(np.concatenate(column) for column in zip(*parts))), len(sources))


def reaching(sources: Sequence[ViewSource], tile: Grid) -> Iterator[tuple[int, ViewSource]]:
    """Numbers and sources whose box reaches a tile."""
    x_min, y_min, x_max, y_max = tile.bounds
    for number, source in enumerate(sources):
        box = source.bounds
        if box is not None and box[0] < x_max and box[2] > x_min and box[1] < y_max and box[3] > y_min:
            yield number, source


def tile_image(sources: Sequence[ViewSource], tile: Grid, choice: PixelSelection, gains: GainCorrection, bands: int,
               full_scale: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """One piece of the mosaic; it does not depend on how the mosaic is cut.

    Returns
    -------
    image (rows, columns, bands) float32, number of the source of each pixel (-1 for none), how many sources see it,
    and whether one would if nothing stood in the way.
    """
    margin = REACH if choice.method == "vote" else 0
    wide = Grid(tile.x_min - margin * tile.cell, tile.y_max + margin * tile.cell, tile.cell,
                tile.rows + 2 * margin, tile.columns + 2 * margin)
    looked = [(number, source.view(wide)) for number, source in reaching(sources, wide)]
    looked = [(number, view) for number, view in looked if view is not None]
    if not looked:
        return (np.zeros((*tile.shape, bands), np.float32), np.full(tile.shape, -1), np.zeros(tile.shape, int),
                np.zeros(tile.shape, bool))
    numbers, views = np.array([number for number, _ in looked]), [view for _, view in looked]
    seen = np.stack([view.seen for view in views])
    reached = np.logical_or.reduce([view.reached for view in views])
    values = np.empty((len(looked), *views[0].values.shape), np.float32)
    for even, (number, view) in zip(values, looked):
        gains.apply(number, view.values, even)
    taken = choice.number(values, seen, views, full_scale)
    inner = slice(margin, margin + tile.rows), slice(margin, margin + tile.columns)
    source_number = np.where(taken >= 0, numbers[np.maximum(taken, 0)], -1)
    count = seen.sum(axis=0, dtype=np.int16)
    return composite(values, taken)[inner], source_number[inner], count[inner], reached[inner]


@dataclass(frozen=True)
class _Piece:
    """A finished piece of the mosaic: `image` (bands, rows, columns), the rest as `tile_image` has it."""

    top: int
    left: int
    image: np.ndarray
    number: np.ndarray
    count: np.ndarray
    hidden: int


def _piece(sources: Sequence[ViewSource] | WorkerResource, choice: PixelSelection, gains: GainCorrection,
           bands: int, dtype: str, place: tuple[int, int, Grid]) -> _Piece:
    """Work on one piece, here or in a worker."""
    top, left, tile = place
    opened = sources.get() if isinstance(sources, WorkerResource) else sources
    image, number, count, reached = tile_image(opened, tile, choice, gains, bands, _FULL_SCALE[dtype])
    seen = number >= 0
    whole = np.where(seen[..., None], np.clip(np.rint(image), 1, _FULL_SCALE[dtype]), 0).astype(dtype)
    return _Piece(top, left, np.moveaxis(whole, -1, 0), number.astype(np.int32), count.astype(np.uint16),
                  int((reached & ~seen).sum()))


@dataclass(frozen=True)
class MosaicFiles:
    """Where a mosaic goes: `image` and, optional, `count`, the raster of how many sources see each pixel."""

    image: str | os.PathLike
    count: str | os.PathLike | None = None


@dataclass(frozen=True)
class Workers:
    """Who works on the pieces: an executor, and how a worker opens the sources (picklable); None for here."""

    executor: Executor | None = None
    open_sources: Callable[[ExitStack], Sequence[ViewSource]] | None = None


def write_mosaic(sources: Sequence[ViewSource], grid: Grid, crs_wkt: str, bands: int, dtype: str, output: MosaicFiles,
                 choice: PixelSelection | None = None, progress: Progress = SILENT,
                 watch: Callable[[int, int, np.ndarray], None] | None = None,
                 workers: Workers | None = None) -> Mosaic:
    """Make the mosaic and write it as GeoTIFF, piece by piece; it does not depend on the workers.

    Pixels without an image hold 0 in all bands, the file's no-data value; all others hold at least 1.

    Parameters
    ----------
    bands, dtype : of the sources, "uint8" or "uint16".
    watch : called with the first row, first column and source numbers of each piece.

    Raises
    ------
    InsufficientDataError : no source sees any ground.
    OutputError : a file cannot be written.
    """
    choice, workers = choice or PixelSelection(), workers or Workers()
    if dtype not in _FULL_SCALE:
        raise InputError(say("The images hold {dtype} numbers: convert them to 8 or 16 bit without sign.", dtype=dtype))
    gains = GainCorrection.identity(len(sources), bands)
    if choice.even and len(sources) > 1:
        gains = gain_correction_of(sources, grid, bands, progress.part(0.0, 0.2))
    used, pixels_seen, pixels_shared, pixels_hidden = set(), 0, 0, 0
    done = progress.part(0.2, 1.0)
    with ExitStack() as stack:
        image_file, count_file = stack.enter_context(_written(output, grid, crs_wkt, bands, dtype, len(sources)))
        if workers.executor is not None:
            sources = stack.enter_context(worker_resource(workers.open_sources))
        work = partial(_piece, sources, choice, gains, bands, dtype)
        for piece in in_order(work, _announced(_aligned_pieces(grid), grid, done), workers.executor, progress.check):
            rows, columns = piece.number.shape
            window = Window(piece.left, piece.top, columns, rows)
            image_file.write(piece.image, window=window)
            if count_file is not None:
                count_file.write(piece.count.astype(count_file.dtypes[0]), 1, window=window)
            if watch is not None:
                watch(piece.top, piece.left, piece.number)
            used |= set(np.unique(piece.number[piece.number >= 0]).tolist())
            pixels_seen += int((piece.number >= 0).sum())
            pixels_shared += int((piece.count >= 2).sum())
            pixels_hidden += piece.hidden
        if not pixels_seen:
            raise InsufficientDataError(say("No frame sees any ground there: check that frames, exterior "
                                            "orientation, ground and surface lie in the same place and coordinate "
                                            "system."))
    return Mosaic(grid, len(used), pixels_seen, pixels_shared, pixels_hidden, gains)


def _announced(pieces: Iterator[tuple[int, int, Grid]], grid: Grid, progress: Progress
               ) -> Iterator[tuple[int, int, Grid]]:
    """The pieces, each told to the progress when it is asked for."""
    for top, left, tile in pieces:
        progress.step((top + left / grid.columns * tile.rows) / grid.rows)
        yield top, left, tile


@contextmanager
def _written(output: MosaicFiles, grid: Grid, crs_wkt: str, bands: int, dtype: str, sources: int) -> Iterator[tuple]:
    """The mosaic's file and that of the counts (or None), open for writing; they take their places at the end."""
    place = Affine(grid.cell, 0, grid.x_min, 0, -grid.cell, grid.y_max)
    common = {"driver": "GTiff", "width": grid.columns, "height": grid.rows, "transform": place, "tiled": True,
              "blockxsize": _BLOCK, "blockysize": _BLOCK, "compress": "deflate", "predictor": 2,
              "bigtiff": "if_safer"}
    image = {**common, "count": bands, "dtype": dtype, "nodata": 0}
    if bands == 3:
        image["photometric"] = "RGB"
    count = {**common, "count": 1, "dtype": "uint8" if sources < 256 else "uint16"}
    try:
        with ExitStack() as stack:
            stack.enter_context(own_gdal())
            crs = CRS.from_wkt(crs_wkt) if crs_wkt else None
            yield tuple(path and stack.enter_context(rasterio.open(
                stack.enter_context(written_beside(path)), "w", crs=crs, **profile))
                for path, profile in ((output.image, image), (output.count, count)))
    except CRSError as error:
        raise InputError(say("The coordinate reference system cannot be understood: set another one.")) from error
    except RasterioError as error:
        raise OutputError(say("{image} cannot be written ({error}): choose another output.",
                              image=Path(output.image).name, error=error)) from error
