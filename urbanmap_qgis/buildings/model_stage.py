"""Building models of all footprints (J 5.3.4): roofs to closed solids, checked and measured, none lost."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field

import numpy as np
import shapely

from ..errors import Cancelled, InputError, trouble_words
from ..execution import checkpoint, in_order
from ..io.points.pointcloud import PointCloud, PointLayout
from ..progress import SILENT, Progress, notice
from ..settings.buildings import LEVELS, PLANES
from ..wording import say
from .building_model import (
    ASSUMED,
    FROM_NEIGHBOURS,
    KNOWN,
    BuildingModel,
    FitPoints,
    RoofInput,
    model_building,
    unmodelled,
)
from .building_points import BUILDINGS_AT_ONCE, coordinates, iter_building_blocks, require_dimension
from .fit_points import candidate_points
from .outlines.evidence import BUILDING_CLASS
from .outlines.footprint import Footprints
from .planes.plane_solids import is_sloped
from .seen.cloud_cover import CloudCover

NEIGHBOUR_RANGE, NEIGHBOURS = 100.0, 5
"""Distance (m) within which, and number of nearest outlines from which, an unknown ground height is taken."""

SUPERTALL = 300.0
"""m; higher buildings are "supertall" (CTBUH, criteria for tall buildings): of no town are half of the roofs."""


@dataclass(frozen=True)
class ModelPiece:
    """One piece of work: a block of buildings with their roofs, base heights and points."""

    ids: np.ndarray
    outlines: np.ndarray
    notes: np.ndarray
    base: np.ndarray
    roofs: list[RoofInput]
    sloped: bool
    source: np.ndarray
    open_share: np.ndarray
    points: list[FitPoints] | None = field(default=None)
    cover: CloudCover | None = None


def build_models(footprints: Footprints, roofs: RoofInput, base: np.ndarray, cloud: PointCloud | None = None,
                 executor: Executor | None = None, progress: Progress = SILENT,
                 roof_shape: str = LEVELS, open_share: np.ndarray | None = None,
                 cover: CloudCover | None = None) -> list[BuildingModel]:
    """A model, or the reason why there is none, for every footprint, in their order.

    Parameters
    ----------
    roofs : polygons and heights of the roofs.
    base : (n,) ground height of each building, m, NaN where unknown.
    cloud : points with `building_id` and `roof_id`, for the figures of fit.
    open_share : (n,) share of each official outline that was cut out before, see `segmentation`.
    cover : the cloud about each outline, see `segmentation`; without it density is told by the building's own points.
    roof_shape : `PLANES`: roofs as their polygons' z has them (LoD2.2, where any is sloped); `LEVELS`: all at their one
        height (LoD1.3).

    Raises
    ------
    InputError : no roof belongs to any of the footprints.
    """
    if len(roofs.building_id) and not np.isin(roofs.building_id, footprints.ids).any():
        raise InputError(say("No roof has a building_id that the outlines have: give the outlines that the roofs "
                             "were made with."))
    models: list[BuildingModel | None] = [None] * len(footprints)
    base, source = bases_with_neighbours(footprints, base)
    _tell_heights(roofs, dict(zip(footprints.ids.tolist(), base.tolist())))
    sloped = roof_shape == PLANES and any(is_sloped(polygon) for polygon in roofs.polygon)
    shares = np.zeros(len(footprints)) if open_share is None else np.nan_to_num(open_share)
    pieces = _pieces(footprints, roofs, base, source, shares, cover, cloud, sloped, progress)
    for rows, built in in_order(_model_piece, pieces, executor, progress.check):
        for row, model in zip(rows, built):
            models[row] = model
        progress.check()
    return models


def _tell_heights(roofs: RoofInput, base: Mapping[int, float]) -> None:
    """Say that heights are in other units where half of all roofs are higher above the ground than all but towers."""
    heights = np.array([height - base.get(number, np.nan) for number, height in zip(
        roofs.building_id.tolist(), roofs.height.tolist())], float)
    middle = float(np.median(heights[np.isfinite(heights)])) if np.isfinite(heights).any() else 0.0
    if middle > SUPERTALL:
        notice(say("Half of the roofs lie more than {height:.0f} m above the ground: the heights of points or ground "
                   "are in other units, such as centimetres; export them in metres.", height=middle))


def bases_with_neighbours(footprints: Footprints, base: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Base heights (n,), unknown ones taken from the nearest outlines that have one, and where each comes from."""
    base, source = np.array(base, float), np.full(len(base), KNOWN, object)
    known = np.flatnonzero(np.isfinite(base) & footprints.usable)
    centres = shapely.get_coordinates(shapely.centroid(footprints.polygons[known]))
    for row in np.flatnonzero(~np.isfinite(base)):
        source[row] = ASSUMED
        if len(known) and footprints.polygons[row] is not None:
            centre = shapely.get_coordinates(shapely.centroid(footprints.polygons[row]))[0]
            distance = np.hypot(*(centres - centre).T)
            near = np.argsort(distance, kind="stable")[:NEIGHBOURS]
            near = near[distance[near] <= NEIGHBOUR_RANGE]
            if len(near):
                base[row], source[row] = float(np.median(base[known[near]])), FROM_NEIGHBOURS
    return base, source


def _pieces(footprints: Footprints, roofs: RoofInput, base: np.ndarray, source: np.ndarray, open_share: np.ndarray,
            cover: CloudCover | None, cloud: PointCloud | None, sloped: bool, progress: Progress):
    """Blocks of buildings, with their points where a cloud is given."""
    order = np.argsort(roofs.building_id, kind="stable")
    sorted_ids = roofs.building_id[order]

    def roofs_of(number: int) -> RoofInput:
        rows = order[np.searchsorted(sorted_ids, number):np.searchsorted(sorted_ids, number, "right")]
        return RoofInput(*(getattr(roofs, name)[rows] for name in RoofInput.__dataclass_fields__))

    done = 0
    for rows, points in _blocks(footprints, base, cloud, progress.part(0.0, 0.3)):
        yield rows, ModelPiece(footprints.ids[rows], footprints.polygons[rows], footprints.notes[rows], base[rows],
                               [roofs_of(int(number)) for number in footprints.ids[rows]], sloped, source[rows],
                               open_share[rows], points, None if cover is None else cover.select(rows))
        done += len(rows)
        progress.part(0.3, 1.0).step(done / len(footprints))


def _blocks(footprints: Footprints, base: np.ndarray, cloud: PointCloud | None, progress: Progress):
    """Rows of the footprints and the points that can be roof of each, block by block."""
    if cloud is None:
        for rows in np.array_split(np.arange(len(footprints)), max(len(footprints) // BUILDINGS_AT_ONCE, 1)):
            yield rows, None
        return
    for name in ("building_id", "roof_id"):
        require_dimension(cloud, name, "Segment roofs")
    layout = PointLayout(cloud)
    for rows, blocks in iter_building_blocks(cloud, layout, footprints.ids, progress, shape_only=True):
        yield rows, [_fit_points(layout, records, footprints.polygons[row], base[row])
                     for row, records in zip(rows, blocks)]


def _fit_points(layout: PointLayout, records: np.ndarray, outline: shapely.Geometry | None,
                base: float) -> FitPoints | None:
    """The points of one building that its model is measured against, None where it has none."""
    x, y, z = coordinates(layout, records)
    on_roof = records["roof_id"] > 0
    use = on_roof
    if outline is not None and not on_roof.all():
        points = layout.view(records)
        classed = np.asarray(points.classification) == BUILDING_CLASS
        use = candidate_points(x, y, z, on_roof, classed, outline, base)
    if not use.any():
        return None
    return FitPoints(np.column_stack([x, y, z])[use], records["roof_id"][use].astype(np.int64))


def _model_piece(piece: tuple[np.ndarray, ModelPiece]) -> tuple[np.ndarray, list[BuildingModel]]:
    rows, block = piece
    models = []
    for place, number in enumerate(block.ids.tolist()):
        checkpoint()
        points = None if block.points is None else block.points[place]
        base = float(block.base[place])
        try:
            models.append(model_building(number, block.outlines[place], block.notes[place], block.roofs[place], base,
                                         points, block.sloped, block.source[place], float(block.open_share[place]),
                                         *([] if block.cover is None else [block.cover.of_outline(place)])))
        except Cancelled:
            raise
        except Exception as error:  # one building's trouble is not the others'
            models.append(unmodelled(number, base, trouble_words(error)))
    return rows, models
