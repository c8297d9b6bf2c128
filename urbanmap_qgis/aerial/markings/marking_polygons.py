"""Outlines of road markings, finer than pixels: the line half-way between paint and road (marching squares).

Tiles share the pixel centres along their seams, and outlines cross each line of pixel centres at a vertex of their own;
so the parts of a marking in several tiles fit exactly and are joined.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import shapely
from rasterio.transform import Affine
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ...geometry.tolerances import ROUNDING
from ...io.raster import RasterSampler, own_gdal
from .marching_squares import zero_lines
from .road_markings import Markings
from .stored_polygons import StoredPolygons, StoredRows, batches

WHITE, YELLOW = "white", "yellow"

CACHE = 128 * 2**20
"""Bytes that GDAL may keep of files while it reads them tile by tile; its own choice is 5 % of the memory."""

_OUTSIDE = np.float32(-1e9)
_DECIMALS = 5
_OFF_CENTRE = np.float32(0.05)
"""Grey values by which the field stays off zero: an outline through a pixel's centre would touch itself."""

_SIMPLIFIED = 0.05
"""Pixels that outlines may move when vertices on straight stretches are left out."""


@dataclass(frozen=True)
class TilePolygons:
    """Polygons of a tile in pixels (x = column, y = row, whole numbers at centres), and sums over their pixels.

    Attributes
    ----------
    polygons : (n,) shapely polygons.
    at_seam : (n,) bool, they touch the tile's edge.
    pixels, contrast, yellow, confidence : (n,) number of pixel centres inside, sum of contrasts, number of yellow ones,
        sum of confidences.
    measures : (n, 4) area, perimeter, north and west end, in the CRS, before whole ones (not at the seam) were
        simplified.
    top : first row of the tile.
    """

    polygons: np.ndarray
    at_seam: np.ndarray
    pixels: np.ndarray
    contrast: np.ndarray
    yellow: np.ndarray
    confidence: np.ndarray
    measures: np.ndarray
    top: int


@dataclass(frozen=True)
class MarkingPolygons:
    """Road markings, in the CRS of the orthophoto.

    Attributes
    ----------
    polygons : (n,) shapely polygons, an array or in a file.
    area : (n,) m2.
    length, width : (n,) m, of the stroke if it were straightened.
    contrast : (n,) mean grey values (of 255 after level adjustment) above the road.
    colour : (n,) "white" or "yellow".
    confidence : (n,) 0 to 1 that it is paint on a road; NaN where it was not measured.
    """

    polygons: np.ndarray | StoredPolygons
    area: np.ndarray
    length: np.ndarray
    width: np.ndarray
    contrast: np.ndarray
    colour: np.ndarray
    confidence: np.ndarray

    def __len__(self) -> int:
        return len(self.polygons)


def tile_polygons(markings: Markings, window: tuple[slice, slice], rows: slice, columns: slice,
                   transform: Affine) -> TilePolygons:
    """Outlines of the markings of a tile.

    Parameters
    ----------
    markings : of the tile with its surroundings, which take `window` of the image.
    rows, columns : of the tile.
    transform : from pixels (corners at whole numbers) to the CRS.
    """
    top, left = rows.start - window[0].start, columns.start - window[1].start
    height, width = rows.stop - rows.start, columns.stop - columns.start
    crop = np.s_[top:top + height + 1, left:left + width + 1]  # and the first line of the next tile
    field = markings.field[crop]
    field = np.where(np.abs(field) < _OFF_CENTRE, np.copysign(_OFF_CENTRE, field), field)
    field = np.pad(field, 1, constant_values=_OUTSIDE)
    points, counts = zero_lines(field)
    pieces = _pieces_inside(field, points, counts)
    points = np.round(points[:, ::-1] - 1, _DECIMALS)
    area = _signed_areas(points, np.cumsum(counts) - counts, np.cumsum(counts))
    polygons = _polygons_of_rings(points, counts, area, pieces[1])
    last_row, last_column = markings.field[crop].shape[0] - 1, markings.field[crop].shape[1] - 1
    bounds = shapely.bounds(polygons).reshape(-1, 4)
    at_seam = ((bounds[:, 0] <= 0) | (bounds[:, 1] <= 0) | (bounds[:, 2] >= last_column)
               | (bounds[:, 3] >= last_row))
    sums = _sums(markings, np.s_[top:top + height, left:left + width], *pieces)[:, area > 0]
    moved = shapely.transform(polygons, lambda points: points + np.array([columns.start, rows.start]))
    measures = _measures(moved, transform)
    moved[~at_seam] = _simplified(moved[~at_seam])
    return TilePolygons(moved, at_seam, *sums, measures, rows.start)


def _pieces_inside(field: np.ndarray, points: np.ndarray, counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number (from 1) of the connected piece of high ground at each value of a field, int32, and the number of the
    piece that each of its zero lines bounds."""
    high = field > 0
    _, pieces = cv2.connectedComponents(high.view(np.uint8), connectivity=4)
    starts = points[np.cumsum(counts) - counts]
    near, far = np.floor(starts).astype(np.intp), np.ceil(starts).astype(np.intp)
    place = np.where(high[near[:, 0], near[:, 1]][:, None], near, far)  # a line passes between high and low
    return pieces, pieces[place[:, 0], place[:, 1]]


def _sums(markings: Markings, window: tuple[slice, slice], pieces: np.ndarray, numbers: np.ndarray) -> np.ndarray:
    """Pixels of a part of the markings in the pieces of the numbers, and sums of their contrast, of yellow ones and of
    their confidence, (4, n); `pieces` as `_pieces_inside` has them."""
    inside = markings.mask[window]
    piece = pieces[1:inside.shape[0] + 1, 1:inside.shape[1] + 1][inside]
    count = int(pieces.max(initial=0)) + 1
    return np.stack([np.bincount(piece, weights=weights, minlength=count)[numbers].astype(np.float64) for weights in
                     (None, markings.contrast[window][inside], markings.yellow[window][inside],
                      markings.confidence[window][inside])])


def _measures(polygons: np.ndarray, transform: Affine) -> np.ndarray:
    """(n, 4) area, perimeter, north and west end in the CRS of polygons in pixels."""
    placed = shapely.transform(polygons, lambda points: _to_crs(points, transform))
    box = shapely.bounds(placed).reshape(-1, 4)
    return np.column_stack([shapely.area(placed), shapely.length(placed), box[:, 3], box[:, 0]])


def _simplified(polygons: np.ndarray) -> np.ndarray:
    """Polygons without vertices that hardly matter; as they are where that would break them."""
    outlines = _without_straight_vertices(polygons)
    broken = ~shapely.is_valid(outlines)
    if not broken.any():
        return outlines
    outlines[broken] = shapely.make_valid(shapely.simplify(polygons[broken], _SIMPLIFIED))
    return np.where(shapely.get_type_id(outlines) == 3, outlines, polygons)


def _without_straight_vertices(polygons: np.ndarray) -> np.ndarray:
    """Simplified polygons, the same as by `shapely.simplify`, which heeds the topology.

    Lines alone (Douglas and Peucker 1973) take a fifteenth of the time and give the same unless lines would cross, a
    ring is short, its first stretch is kept whole as one side, or its first vertex may go too: those few are left to
    the slow way; crossing ones are told by the polygons' validity.
    """
    rings, owner = shapely.get_rings(polygons, return_index=True)
    if not len(rings):
        return polygons.copy()
    given, ring = shapely.get_coordinates(rings, return_index=True)
    lines = shapely.simplify(shapely.linestrings(given, indices=ring), _SIMPLIFIED, preserve_topology=False)
    points, line = shapely.get_coordinates(lines, return_index=True)
    starts = np.searchsorted(line, np.arange(len(rings)))
    ends = np.append(starts[1:], len(points))
    off = _off_line(points[starts], points[ends - 2], points[starts + 1])
    special = (ends - starts < 6) | (off <= _SIMPLIFIED * (1 + ROUNDING))
    first = np.searchsorted(ring, np.arange(len(rings)))
    farthest = np.maximum.reduceat(np.hypot(*(given - given[first][ring]).T), first)
    special |= np.hypot(*(points[starts + 1] - points[starts]).T) > farthest * (1 - ROUNDING)
    slow = np.zeros(len(polygons), bool)
    slow[owner[special]] = True
    simplified = np.empty(len(polygons), object)
    simplified[slow] = shapely.simplify(polygons[slow], _SIMPLIFIED)
    corner = ~slow[owner]
    numbers = np.cumsum(~slow) - 1
    closed = shapely.linearrings(points[corner[line]], indices=(np.cumsum(corner) - 1)[line[corner[line]]])
    simplified[~slow] = shapely.polygons(closed, indices=numbers[owner[corner]])
    return simplified


def _off_line(points: np.ndarray, begin: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Distances of points from straight lines between two others, (n, 2) each."""
    along = end - begin
    square = np.maximum((along ** 2).sum(axis=1), 1e-30)
    share = np.clip(((points - begin) * along).sum(axis=1) / square, 0, 1)
    return np.hypot(*(points - begin - share[:, None] * along).T)


def _polygons_of_rings(points: np.ndarray, counts: np.ndarray, area: np.ndarray, piece: np.ndarray) -> np.ndarray:
    """Polygons with holes from closed lines round high and round low ground, (n, 2) points one line after the other.

    Parameters
    ----------
    area : (m,) of the lines, as `_signed_areas` has it.
    piece : (m,) number of the piece of high ground that they bound: a hole belongs to the outline of the same piece.
    """
    rings = shapely.linearrings(points, indices=np.repeat(np.arange(len(counts)), counts))
    outer, hole = area > 0, area < 0
    outline_of = np.full(int(piece.max(initial=0)) + 1, -1)
    outline_of[piece[outer]] = np.arange(np.count_nonzero(outer))
    hole &= outline_of[piece] >= 0
    owner = np.concatenate([np.arange(np.count_nonzero(outer)), outline_of[piece[hole]]])
    parts = np.concatenate([rings[outer], rings[hole]])
    turn = np.argsort(owner, kind="stable")  # the outline before its holes
    return shapely.polygons(parts[turn], indices=owner[turn])


def _signed_areas(points: np.ndarray, starts: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Twice the areas of closed lines in (column, row); positive round high ground, as `zero_lines` turns."""
    if not len(starts):
        return np.empty(0)
    x, y = points.T
    cross = np.append(x[:-1] * y[1:] - x[1:] * y[:-1], 0)
    cross[ends - 1] = 0
    areas = np.add.reduceat(cross, starts)
    for line in np.nonzero(np.abs(areas) < 1e-6)[0]:  # rounding decides: it must not depend on the other lines
        areas[line] = np.sum(cross[starts[line]:ends[line] - 1])
    return areas


def merge_tile_polygons(pieces: Iterable[TilePolygons], transform: Affine, metres_per_unit: float, min_area: float,
                 folder: str | os.PathLike) -> MarkingPolygons:
    """Join the parts of markings across seams and measure them.

    In memory are the parts at the seams of a row of tiles, and of markings that go on below it; outlines and figures of
    finished ones are in files that vanish with the result.

    Parameters
    ----------
    pieces : of tiles in rows from the top.
    transform : from pixels (corners at whole numbers) to the CRS.
    min_area : m2, smaller ones are left out.
    folder : for the files.
    """
    store, rows = StoredPolygons(folder), StoredRows(folder, len(_FIGURES))
    try:
        for polygons, figures in _finished(pieces, transform):
            valid = (figures[:, _AREA] * metres_per_unit ** 2 >= min_area) & (figures[:, _PIXELS] > 0)
            store.add(shapely.transform(polygons[valid], lambda points: _to_crs(points, transform)))
            rows.add(figures[valid])
        return _sorted(store, rows, metres_per_unit)
    finally:
        rows.close()


_FIGURES = _AREA, _PERIMETER, _NORTH, _WEST, _PIXELS, _CONTRAST, _YELLOW_PIXELS, _CONFIDENCE = range(8)


def _finished(pieces: Iterable[TilePolygons], transform: Affine) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Whole markings in pixels and their figures (n, 8), as soon as no further tile can hold a part of them."""
    waiting = _no_parts()
    top = None
    for piece in pieces:
        if top is not None and piece.top > top:
            waiting, done = _closed(waiting, piece.top)
            yield _joined(done, transform)
        top = piece.top
        sums = np.column_stack([piece.pixels, piece.contrast, piece.yellow, piece.confidence])
        inner = ~piece.at_seam
        yield piece.polygons[inner], np.column_stack([piece.measures[inner], sums[inner]])
        outlines = shapely.make_valid(piece.polygons[piece.at_seam])
        waiting = np.concatenate([waiting[0], outlines]), np.concatenate([waiting[1], sums[piece.at_seam]])
    yield _joined(waiting, transform)


def _no_parts() -> tuple[np.ndarray, np.ndarray]:
    return np.empty(0, dtype=object), np.empty((0, 4))


def _closed(waiting: tuple[np.ndarray, np.ndarray], top: int) -> tuple[tuple, tuple]:
    """Parts of markings that may go on at row `top` or below, and those that do not."""
    outlines, sums = waiting
    if not len(outlines):
        return waiting, waiting
    first, second = shapely.STRtree(outlines).query(outlines, predicate="intersects")
    count = len(outlines)
    _, group = connected_components(coo_matrix((np.ones(len(first), bool), (first, second)), (count, count)), False)
    goes_on = np.zeros(count, bool)
    goes_on[group[shapely.bounds(outlines)[:, 3] >= top]] = True
    opened = goes_on[group]
    return (outlines[opened], sums[opened]), (outlines[~opened], sums[~opened])


def _joined(parts: tuple[np.ndarray, np.ndarray], transform: Affine) -> tuple[np.ndarray, np.ndarray]:
    """Markings joined from their parts, and their figures."""
    outlines, sums = parts
    joined = shapely.get_parts(shapely.union_all(outlines))
    # Where a ring starts decides what is simplified: it must not depend on what else is joined at the time.
    joined = shapely.normalize(joined[shapely.get_type_id(joined) == 3])
    if not len(joined):
        return np.empty(0, dtype=object), np.empty((0, len(_FIGURES)))
    part, found = shapely.STRtree(joined).query(shapely.point_on_surface(outlines), predicate="intersects")
    totals = [np.bincount(found, weights=values[part], minlength=len(joined)) for values in sums.T]
    return _simplified(joined), np.column_stack([_measures(joined, transform), *totals])


def _sorted(store: StoredPolygons, rows: StoredRows, metres_per_unit: float) -> MarkingPolygons:
    """Markings from the north, whatever the tiles."""
    order = np.lexsort((rows.column(_WEST), -rows.column(_NORTH)))
    store.sort(order)
    area, half = rows.column(_AREA)[order] * metres_per_unit ** 2, rows.column(_PERIMETER)[order] * metres_per_unit / 2
    length = (half + np.sqrt(np.maximum(half ** 2 - 4 * area, 0))) / 2
    del half  # of millions of markings each column counts
    pixels = rows.column(_PIXELS)[order]
    contrast = rows.column(_CONTRAST)[order] / pixels
    yellow = rows.column(_YELLOW_PIXELS)[order] > 0.5 * pixels
    colour = np.array([WHITE, YELLOW], dtype=object)[yellow.astype(np.intp)]
    confidence = rows.column(_CONFIDENCE)[order] / pixels
    return MarkingPolygons(store, area, length, area / length, contrast, colour, confidence)


def _to_crs(points: np.ndarray, transform: Affine) -> np.ndarray:
    column, row = points[:, 0] + 0.5, points[:, 1] + 0.5
    return np.column_stack([transform.a * column + transform.b * row + transform.c,
                            transform.d * column + transform.e * row + transform.f])


def with_heights(polygons: Sequence, ground: RasterSampler) -> tuple[Sequence, int]:
    """Polygons with the ground's height at each vertex (J 4.1), and how many have vertices without one (NaN).

    An array becomes an array, stored polygons other stored ones.
    """
    without = 0

    def raised() -> Iterator[np.ndarray]:
        nonlocal without
        for batch in batches(polygons):
            points, owner = shapely.get_coordinates(batch, return_index=True)
            heights = ground.sample(points[:, 0], points[:, 1]).astype(np.float64)
            without += len(np.unique(owner[np.isnan(heights)]))
            yield shapely.set_coordinates(shapely.force_3d(batch), np.column_stack([points, heights]))

    with own_gdal(CACHE):
        with_z = (polygons.like(raised()) if isinstance(polygons, StoredPolygons)
                  else np.concatenate([np.empty(0, dtype=object), *raised()]))
    return with_z, without


def most_in_doubt(confidence: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Order of markings by their confidence (n,) and area (n,), those with the most area in doubt first: its variance,
    were all of a marking paint or none. Specks, which the eye can hardly tell, come last."""
    return np.argsort(-area * confidence * (1 - confidence), kind="stable")
