"""A building's plan divided among its roofs without gaps or slivers (in place of J 5.3.3, step 4)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from scipy import ndimage
from shapely.affinity import translate
from skimage import measure

from ...errors import InputError
from ...geometry.grid import Grid
from ...wording import say
from .partition_lines import (
    MAX_WALL_LINES,
    LabelBoundaries,
    RoofPoints,
    candidate_lines,
    label_boundaries,
    main_axes,
    with_enclosing_lines,
)
from .piece_labels import choose_roofs
from .plan_arrangement import Arrangement, arrange, dissolve
from .small_roofs import insert_roof_patches, roof_patch


@dataclass(frozen=True)
class RoofPlanLimits:
    """Limits of roof plan, each with its unit."""

    guessed_cell_weight: float = 1.0  # Weight of a cell without data, which took the label of its nearest neighbour.
    # Least cost of giving a cell to the wrong roof, where both have the same height, as a share of the full cost.
    min_confusion: float = 0.3
    max_lines: int = 62  # Sides of this many lines fit into one integer.
    # Metres; label borders farther from a polygon's edge are clutter.
    near_border: float = 1.5


LIMITS = RoofPlanLimits()


@dataclass(frozen=True)
class PartitionParameters:
    """How a plan is divided.

    Attributes
    ----------
    min_line_length : metres of common border that make a dividing line.
    merge_distance : metres; roof borders nearer than this to a parallel outline edge's line follow it, and
        parallel dividing lines nearer than this are one.
    min_roof_area : square metres; smaller pieces of roof join the neighbour that fits best.
    smoothness : metres; a step in a border is kept where it pays more area than this times its length.
    full_step : metres; labels of roofs differing less in height are cheaper to confuse.
    max_lines : at most this many dividing lines found in the roofs' borders, the strongest (up to 50).
    """

    min_line_length: float = 1.5
    merge_distance: float = 0.6
    min_roof_area: float = 2.0
    smoothness: float = 0.4
    full_step: float = 1.0
    max_lines: int = 40


@dataclass(frozen=True)
class RoofPartition:
    """Polygons that fill the outline exactly.

    Attributes
    ----------
    polygons : (k) Polygons; neighbours share exact edges and nodes.
    roof_numbers : (k,) roof of each polygon; one roof can have several. 0 where there is no data at all.
    status : "ok"; "one roof"; "no data"; "lost roofs" (a roof larger than the least area found no place).
    coverage : (k,) share of each roof's area with labelled cells.
    boundary_rms : (k,) metres, from the roof borders in the raster to the polygon's border, those within
        `LIMITS.near_border`; nan without any.
    """

    polygons: tuple[shapely.Polygon, ...]
    roof_numbers: np.ndarray
    status: str
    coverage: np.ndarray
    boundary_rms: np.ndarray


@dataclass(frozen=True)
class _Cells:
    """Cells inside the outline: centres (n, 2), index of the roof (n,), whether it was measured (n,), side in m."""

    xy: np.ndarray
    roof: np.ndarray
    certain: np.ndarray
    side: float


def partition_roofs(outline: shapely.Geometry, labels_grid: Grid, labels: np.ndarray,
                    heights: np.ndarray | None = None, parameters: PartitionParameters | None = None,
                    points: tuple[np.ndarray, np.ndarray, np.ndarray] | None = None) -> RoofPartition:
    """Divide a building's plan among its roofs.

    Straight lines where roofs meet (see `partition_lines`) cut the outline; each piece goes to the roof that
    most of its cells say, smoothed; pieces of a roof are joined. All outer edges are the outline's own.

    Parameters
    ----------
    outline : valid Polygon or MultiPolygon, courtyards as holes, already at its right place; metres.
    labels_grid : where the raster lies.
    labels : (rows, columns) int, roof number of each cell, 0 = no data.
    heights : (rows, columns) heights of cells in metres, nan = none; roofs of like height are then cheap to confuse.
    points : x, y and roof number of each point (0 = none), instead of the raster (labels of 0) or beside it: cells that
        hold points take the roof most of them have.

    Raises
    ------
    InputError : raster and grid do not fit, or the outline has no area.
    """
    parameters = parameters or PartitionParameters()
    labels = np.asarray(labels)
    if labels.shape != labels_grid.shape:
        raise InputError(say("The roof raster has not the rows and columns of its grid."))
    if not 0 <= parameters.max_lines <= LIMITS.max_lines - MAX_WALL_LINES:
        raise InputError(say("At most {max_lines} dividing lines are possible: lower their number.",
                             max_lines=LIMITS.max_lines - MAX_WALL_LINES))
    if outline.is_empty or outline.area <= 0:
        raise InputError(say("The building outline has no area: repair or remove it."))
    rows, columns, grid = labels_grid.window(*outline.bounds)
    labels = labels[rows, columns]
    known = None
    if points is not None:
        known = _known_points(grid, *points)
        labels = _with_points(labels, grid, known)
    labels, numbers = _large_roofs(labels, parameters.min_roof_area / grid.cell ** 2)
    if len(numbers) < 2:
        return _undivided(outline, numbers, np.count_nonzero(labels) * grid.cell ** 2)
    heights = None if heights is None else np.asarray(heights)[rows, columns]
    return _divided(outline, grid, labels, numbers, heights, known, parameters)


def _known_points(grid: Grid, x: np.ndarray, y: np.ndarray, roof: np.ndarray) -> RoofPoints:
    """Points that have a roof and lie on the grid."""
    x, y, roof = np.asarray(x, float), np.asarray(y, float), np.asarray(roof)
    use = grid.cells(x, y)[2] & (roof > 0)
    return RoofPoints(np.column_stack([x[use], y[use]]), roof[use])


def _with_points(labels: np.ndarray, grid: Grid, points: RoofPoints) -> np.ndarray:
    """Label raster in which cells with points of roofs take the roof that most of them have."""
    if len(points.roof) == 0:
        return labels
    row, column, _ = grid.cells(*points.xy.T)
    numbers, index = np.unique(points.roof, return_inverse=True)
    cell = row * grid.columns + column
    pairs, votes = np.unique(cell * len(numbers) + index, return_counts=True)
    order = np.lexsort((pairs, votes))  # the last write of a cell is its best roof
    result = labels.copy()
    result.ravel()[pairs[order] // len(numbers)] = numbers[pairs[order] % len(numbers)]
    return result


def _large_roofs(labels: np.ndarray, smallest: float) -> tuple[np.ndarray, np.ndarray]:
    """Labels without the roofs of fewer cells than `smallest` (unless all are so small), and the numbers left."""
    numbers, index, cells = np.unique(labels, return_inverse=True, return_counts=True)
    keep = (cells >= smallest) & (numbers > 0)
    if not keep.any():
        keep = numbers > 0
    return np.where(keep, numbers, 0)[index].reshape(labels.shape), numbers[keep]


def _undivided(outline: shapely.Geometry, numbers: np.ndarray, labelled_area: float) -> RoofPartition:
    parts = tuple(shapely.get_parts(outline))
    number = int(numbers[0]) if len(numbers) else 0
    share = min(labelled_area / outline.area, 1.0)
    k = len(parts)
    return RoofPartition(parts, np.full(k, number), "one roof" if number else "no data", np.full(k, share),
                         np.full(k, np.nan))


def _divided(outline: shapely.Geometry, grid: Grid, labels: np.ndarray, numbers: np.ndarray,
             heights: np.ndarray | None, points: RoofPoints | None,
             parameters: PartitionParameters) -> RoofPartition:
    origin = np.floor([grid.x_min, grid.y_max])
    local = translate(outline, -origin[0], -origin[1])
    x, y = grid.centres()
    x, y = x - origin[0], y - origin[1]
    shapely.prepare(local)
    mask = shapely.contains_xy(local, *np.meshgrid(x, y))
    data = (labels > 0) & mask
    filled = _filled(np.searchsorted(numbers, labels), data, mask, parameters.min_roof_area / grid.cell ** 2)
    left = np.unique(filled[mask])
    if len(left) < 2:
        return _undivided(outline, numbers[left], np.count_nonzero(data) * grid.cell ** 2)
    boundaries = label_boundaries(filled, x, y)
    near = None if points is None else RoofPoints(points.xy - origin, points.roof)
    lines = candidate_lines(boundaries, local, grid.cell, parameters.min_line_length, parameters.merge_distance,
                            parameters.max_lines, near)
    row, column = np.nonzero(mask)
    cells = _Cells(np.column_stack([x[column], y[row]]), filled[row, column], data[row, column], grid.cell)
    confusion = _confusion(filled, data, heights, len(numbers), parameters.full_step)
    arrangement, piece, chosen = _label(local, lines, cells, confusion, parameters)
    lost = sorted(set(left.tolist()) - set(chosen.tolist()))
    if lost:
        regions = [cells.xy[cells.roof == roof] for roof in lost]
        more = with_enclosing_lines(lines, regions, local, grid.cell, parameters.merge_distance)
        if len(lines) < len(more) <= LIMITS.max_lines:
            arrangement, piece, chosen = _label(local, more, cells, confusion, parameters)
    polygons, label_of = dissolve(arrangement.pieces, chosen, local)
    polygons, label_of, given = _with_lost_roofs(polygons, label_of, chosen[piece], cells, left, local)
    quality = _quality(polygons, label_of, given, cells, boundaries, len(numbers))
    lost = set(left.tolist()) - set(label_of.tolist())
    moved = tuple(translate(polygon, *origin) for polygon in polygons)
    return RoofPartition(moved, numbers[label_of], "lost roofs" if lost else "ok", *quality)


def _with_lost_roofs(polygons: list, label_of: np.ndarray, given: np.ndarray, cells: _Cells, roofs: np.ndarray,
                     outline: shapely.Geometry) -> tuple[list, np.ndarray, np.ndarray]:
    """Polygons, their labels and the label given to each cell, with those of `roofs` that had found no place.

    Lines are limited in number and borders are smoothed, so that towers and factories with many small roofs lose
    some in the arrangement; each of these gets a patch of its own.
    """
    lost = sorted(set(roofs.tolist()) - set(label_of.tolist()))
    if not lost:
        return polygons, label_of, given
    axes = main_axes(outline)
    patches = [(roof, roof_patch(cells.xy[cells.roof == roof], cells.side, axes)) for roof in lost]
    polygons, label_of = dissolve(*insert_roof_patches(polygons, label_of, patches, outline), outline)
    given = given.copy()
    for roof, patch in patches:
        shapely.prepare(patch)
        given[shapely.contains_xy(patch, *cells.xy.T)] = roof
    return polygons, label_of, given


def _label(outline: shapely.Geometry, lines: np.ndarray, cells: _Cells, confusion: np.ndarray,
           parameters: PartitionParameters) -> tuple[Arrangement, np.ndarray, np.ndarray]:
    """Pieces that the lines cut, the piece of each cell, and the roof index of each piece."""
    arrangement = arrange(outline, lines)
    piece = _piece_of_cell(arrangement, lines, cells.xy)
    k = len(confusion)
    weight = np.where(cells.certain, 1.0, LIMITS.guessed_cell_weight) * cells.side ** 2
    votes = np.bincount(piece * k + cells.roof, weight, minlength=len(arrangement.pieces) * k).reshape(-1, k)
    chosen = choose_roofs(votes @ confusion, arrangement, parameters.smoothness, parameters.min_roof_area)
    return arrangement, piece, chosen


def _filled(index: np.ndarray, data: np.ndarray, mask: np.ndarray, smallest: float) -> np.ndarray:
    """Roof index of every cell of the mask, elsewhere -1; gaps and specks take the nearest cell's roof."""
    part = measure.label(_nearest(index, data, mask) + 1, background=0, connectivity=1)
    speck = np.bincount(part.ravel()) < smallest
    speck[0] = True
    solid = data & ~speck[part]
    return _nearest(index, solid if solid.any() else data, mask)


def _nearest(index: np.ndarray, data: np.ndarray, mask: np.ndarray) -> np.ndarray:
    row, column = ndimage.distance_transform_edt(~data, return_distances=False, return_indices=True)
    return np.where(mask, index[row, column], -1)


def _piece_of_cell(arrangement: Arrangement, lines: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Number of the piece that each cell centre (n, 2) lies in."""
    powers = 1 << np.arange(len(lines), dtype=np.int64)

    def sides(p: np.ndarray) -> np.ndarray:
        return ((p @ lines[:, :2].T) > lines[:, 2]) @ powers

    codes, group = np.unique(sides(arrangement.inside), return_inverse=True)
    place = np.minimum(np.searchsorted(codes, sides(xy)), len(codes) - 1)
    first = np.zeros(len(codes), np.int64)
    first[group[::-1]] = np.arange(len(group))[::-1]
    result = first[place]
    for several in np.flatnonzero(np.bincount(group) > 1):  # separated by a bay of the outline, by no line
        cells = np.flatnonzero(place == several)
        for piece in np.flatnonzero(group == several):
            inside = shapely.contains_xy(arrangement.pieces[piece], xy[cells, 0], xy[cells, 1])
            result[cells[inside]] = piece
    return result


def _confusion(filled: np.ndarray, data: np.ndarray, heights: np.ndarray | None, k: int,
               full_step: float) -> np.ndarray:
    """(k, k) cost of giving a cell of one roof to another, 0 to 1, by their difference in height."""
    cost = 1.0 - np.eye(k)
    if heights is None:
        return cost
    usable = data & np.isfinite(heights)
    label, height = filled[usable], heights[usable]
    median = np.array([np.median(height[label == i]) if (label == i).any() else np.nan for i in range(k)])
    step = np.abs(median[:, None] - median[None, :])
    return cost * np.where(np.isfinite(step), np.clip(step / full_step, LIMITS.min_confusion, 1.0), 1.0)


def _quality(polygons: list, label_of: np.ndarray, given: np.ndarray, measured: _Cells, boundaries: LabelBoundaries,
             k: int) -> tuple[np.ndarray, np.ndarray]:
    """Coverage and boundary RMS of each polygon (a roof's figures go to all its polygons)."""
    coverage = np.bincount(given, measured.certain, minlength=k) / np.maximum(np.bincount(given, minlength=k), 1)
    places = shapely.points(boundaries.xy)
    rms = np.full(len(polygons), np.nan)
    for i in range(k):
        mine = np.flatnonzero(label_of == i)
        near = (boundaries.left == i) | (boundaries.right == i)
        if len(mine) and near.any():
            border = shapely.multilinestrings(shapely.get_rings([polygons[m] for m in mine]))
            shapely.prepare(border)
            distance = shapely.distance(border, places[near])
            distance = distance[distance < LIMITS.near_border]
            rms[mine] = np.sqrt(np.mean(distance ** 2)) if len(distance) else np.nan
    return coverage[label_of], rms
