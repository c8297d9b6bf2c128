"""Ground points of a mobile survey by the cloth filter (J 3.2.3.1), for files of any size."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..errors import InputError, InsufficientDataError
from ..execution import in_order
from ..geometry.grid import Grid
from ..io.points.decoded_points import decoded_once
from ..io.points.pointcloud import (
    PointCloud,
    PointLayout,
    cloud_writer,
    iter_chunks,
    of_classes,
    open_cloud,
    valid_points,
)
from ..io.reference.system_parts import metric_plane
from ..progress import SILENT, Progress
from ..settings.terrain import ClothSettings
from ..terrain.cloth import JAVANMARDI, LowestHeights, bottom_points, final_cloth, first_cloth
from ..terrain.outliers import isolation_limit, plausible
from ..terrain.tiles import ClothPart, TilePoints, layer_of_tile, lowest_heights_of_tile, point_margin
from ..wording import say
from .markings.survey_points import MIN_GROUND_SHARE
from .passes import SurveyPasses
from .survey_tiles import CHUNK, SurveyTiles, tiles_of_survey

GROUND, UNASSIGNED = 2, 1
UNDECIDED = (0, UNASSIGNED, GROUND)
"""Classes that say nothing of what a point is, or what the filter is to say anew."""

_CLASSES = np.uint8(GROUND), np.uint8(UNASSIGNED)
_MOST_NODES = 100_000_000


@dataclass(frozen=True)
class GroundSummary:
    """What was found.

    Attributes
    ----------
    points : in the files.
    usable : without noise, withheld points and absurd heights.
    ground : ground points.
    passes : passes that were filtered apart (1 without GPS time).
    crs_wkt : of the cloud.
    """

    points: int
    usable: int
    ground: int
    passes: int
    crs_wkt: str


@dataclass(frozen=True)
class PassGround:
    """The converged cloth of one pass.

    Attributes
    ----------
    grid : of the cloth's nodes.
    lowest : (rows, columns) believed lowest heights.
    cloth : converged heights, m.
    """

    grid: Grid
    lowest: np.ndarray
    cloth: np.ndarray

    def mask(self, x: np.ndarray, y: np.ndarray, z: np.ndarray, threshold: float) -> np.ndarray:
        """Points (n,) within `threshold` m of the cloth and not below the believed ground; all must be on the grid."""
        bottom = bottom_points(x, y, z, self.grid, self.lowest)
        found = np.zeros(len(z), dtype=bool)
        found[bottom.points[np.abs(bottom.z - bottom.place.heights(self.cloth)) <= threshold]] = True
        return found


def classify_ground_files(paths: Sequence[str | os.PathLike], output: str | os.PathLike,
                          settings: ClothSettings = JAVANMARDI, progress: Progress = SILENT,
                          executor: Executor | None = None, crs_wkt: str | None = None,
                          min_ground_share: float = MIN_GROUND_SHARE) -> GroundSummary:
    """Write a survey's points with ground as class 2; all else of them, and their order, stays as it is.

    Points of other classes than 0, 1 and 2 keep them. Passes through the same place are filtered apart by their GPS
    time (`passes`). The points are read twice; memory holds some tiles and the cloth. The result does not depend on the
    tiles nor on the executor.

    Parameters
    ----------
    paths : LAS, LAZ or COPC files.
    output : LAZ or LAS.
    crs_wkt : CRS where the files state none.
    min_ground_share : less ground among the usable points of undecided class, 0 to 1, is refused.

    Raises
    ------
    InputError : files, CRS or settings cannot be used.
    InsufficientDataError : no usable points, or a share of ground that cannot be right.
    """
    cloud = open_cloud(paths, crs_wkt)
    wkt = metric_plane(cloud.paths[0].name, cloud.crs_wkt).to_wkt()
    with decoded_once():
        with tiles_of_survey(cloud, settings.resolution, point_margin(settings), progress.part(0.0, 0.35)) as tiles:
            grounds = _grounds(tiles, settings, executor, progress.part(0.35, 0.65))
        ground = _write(cloud, output, tiles.passes, grounds, settings, min_ground_share, progress.part(0.65, 1.0))
    return GroundSummary(cloud.point_count, tiles.usable, ground, tiles.passes.count, wkt)


def _grounds(tiles: SurveyTiles, cloth: ClothSettings, executor: Executor | None,
             progress: Progress) -> list[PassGround | None]:
    """The cloth of each pass."""
    extents = tiles.extents(progress.part(0.0, 0.1))
    cloths: list[PassGround | None] = []
    share = 0.9 / tiles.passes.count
    for number, extent in enumerate(extents):
        part = progress.part(0.1 + share * number, 0.1 + share * (number + 1))
        cloths.append(_ground(partial(tiles.points, extent, number), extent, tiles.tiling.side, cloth, executor,
                              part) if extent else None)
    return cloths


def _ground(points: Callable[[float], Iterator[TilePoints]], extent: dict[int, tuple], side: float,
            cloth: ClothSettings, executor: Executor | None, progress: Progress) -> PassGround:
    """The cloth of one pass, from the points of its tiles of `side` m with a margin, m, round each."""
    table = np.array(list(extent.values()))
    (x_min, y_min), (x_max, y_max) = table[:, 1:3].min(axis=0), table[:, 3:5].max(axis=0)
    grid = Grid.covering(x_min, y_min, x_max, y_max, cloth.resolution)
    grid = Grid(grid.x_min, grid.y_max, grid.cell, grid.rows + 1, grid.columns + 1)
    if grid.rows * grid.columns > _MOST_NODES:
        raise InputError(say("The survey is too large for one cloth: choose a coarser cloth resolution, or "
                             "filter parts of it."))
    area = len(table) * side ** 2
    neighbours = isolation_limit(int(table[:, 0].sum()), min(area, max((x_max - x_min) * (y_max - y_min), 1.0)))
    levels = [np.full(grid.shape, fill) for fill in (np.inf, np.inf, 0)]
    work = partial(lowest_heights_of_tile, cloth_grid=grid, neighbours=neighbours)
    for step, part in enumerate(in_order(work, points(point_margin(cloth)), executor, progress.check)):
        _put(levels, part)
        progress.step(0.5 * (step + 1) / len(table))
    first, trend, lowest = first_cloth(LowestHeights(*levels), cloth, progress.part(0.5, 0.6))
    layer = [np.full(grid.shape, np.inf)]
    # Tiles are made of whole cells: of their neighbours no more is needed than what lies on their edges.
    work = partial(layer_of_tile, cloth_grid=grid, lowest=lowest, cloth=first)
    for step, part in enumerate(in_order(work, points(0.0), executor, progress.check)):
        _put(layer, part)
        progress.step(0.6 + 0.3 * (step + 1) / len(table))
    converged = final_cloth(layer[0], trend, cloth, progress.part(0.9, 1.0))
    return PassGround(grid, lowest, converged)


def _put(layers: list[np.ndarray], part: ClothPart) -> None:
    """Lay a tile's nodes into the whole."""
    for layer, values in zip(layers, part.layers):
        layer[part.rows, part.columns] = values


def _write(cloud: PointCloud, output: str | os.PathLike, passes: SurveyPasses, grounds: list[PassGround | None],
           settings: ClothSettings, min_share: float, progress: Progress) -> int:
    """Write all points with their new classes; the number of ground points."""
    total = candidates = 0
    counts = []
    layout = PointLayout(cloud)
    with cloud_writer(output, layout) as writer:
        for chunk in iter_chunks(cloud, progress, CHUNK):
            ground = _ground_of(chunk, passes, grounds, settings.threshold)
            undecided = of_classes(chunk, UNDECIDED)
            candidate = undecided & valid_points(chunk)
            total, candidates = total + np.count_nonzero(ground), candidates + np.count_nonzero(candidate)
            counts.append(_counts(chunk[::_SOME], candidate[::_SOME], ground[::_SOME]))
            points = layout.view(layout.adapt(chunk, np.ones(len(chunk), dtype=bool)))
            points.classification = np.where(undecided, np.where(ground, *_CLASSES), np.asarray(chunk.classification))
            writer.write(points.array)
        _check_share(total, candidates, min_share)
    _tell_poor_seconds(np.vstack(counts), progress)
    return total


_SOME = 16
"""One point of so many tells the share of ground of a second."""


def _counts(chunk, candidate: np.ndarray, ground: np.ndarray) -> np.ndarray:
    """(k, 3) full seconds of some points (one where they have no times), undecided points in them, ground points."""
    if "gps_time" not in chunk.point_format.dimension_names or not candidate.any():
        return np.array([[0.0, np.count_nonzero(candidate), np.count_nonzero(ground)]])
    time = np.floor(np.asarray(chunk["gps_time"]))
    seconds, place = np.unique(time, return_inverse=True)
    return np.column_stack([seconds, np.bincount(place, candidate, len(seconds)),
                            np.bincount(place, ground, len(seconds))])


def _tell_poor_seconds(counts: np.ndarray, progress: Progress) -> None:
    """Warn where the share of ground is less than half of what the drive has elsewhere (its upper quartile)."""
    seconds, place = np.unique(counts[:, 0], return_inverse=True)
    candidates, ground = (np.bincount(place, column, len(seconds)) for column in counts[:, 1:].T)
    full = candidates > 0.5 * np.median(candidates)
    share = ground[full] / candidates[full]
    usual = np.percentile(share, 75)
    poor = share < 0.5 * usual
    if 20 * poor.sum() > len(poor):
        progress.warn(say("In {count} of {all} seconds of the drive, from {first:.0f} s on, less than half as many of "
                          "the points are ground as elsewhere ({poor:.0f} % for {usual:.0f} %): at steep or humped "
                          "stretches the cloth leaves ground out; look at them, or give a finer cloth.",
                          count=int(poor.sum()), all=len(poor), first=seconds[full][poor][0],
                          poor=100 * np.median(share[poor]), usual=100 * usual))


def _check_share(ground: int, candidates: int, min_share: float) -> None:
    """Refuse a share of ground that cannot be right, while the output still lies beside its place."""
    if ground < min_share * candidates:
        raise InsufficientDataError(
            say("Only {ground:,} of {candidates:,} points were found to be ground ({ground_2:.2g} %, needed "
                "{min_share:g} %), which cannot be right for a drive: look for many points below the road, a wrong "
                "height unit or a survey that does not show the ground; a smaller minimum ground share accepts it.",
                ground=ground, candidates=candidates, ground_2=100 * ground / candidates, min_share=100 * min_share))


def _ground_of(chunk, passes: SurveyPasses, grounds: list[PassGround | None], threshold: float) -> np.ndarray:
    """Which points of a chunk are ground, (n,) bool."""
    x, y, z = (np.asarray(chunk[name]) for name in "xyz")
    candidate = valid_points(chunk) & plausible(x, y, z) & of_classes(chunk, UNDECIDED)
    pass_number = passes.of(np.asarray(chunk["gps_time"])) if passes.count > 1 else np.zeros(len(z), dtype=int)
    found = np.zeros(len(z), dtype=bool)
    for number in np.flatnonzero(np.bincount(pass_number[candidate])).tolist():
        mine = candidate & (pass_number == number)
        some = slice(None) if mine.all() else np.flatnonzero(mine)
        if grounds[number] is not None:
            found[some] = grounds[number].mask(x[some], y[some], z[some], threshold)
    return found
