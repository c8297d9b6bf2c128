"""Building models of all footprints (J 5.3.4): roofs to closed solids, checked and measured, none lost."""

from __future__ import annotations

import math
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from ..errors import InputError, InsufficientDataError
from ..execution import in_order
from ..geometry.grid import Grid
from ..geometry.solid import GROUND, INNER_WALL, OUTER_WALL, ROOF, Solid, surfaces
from ..geometry.solid_faces import face_normal
from ..io.pointcloud import PointCloud, PointLayout
from ..progress import SILENT, Progress
from .building_points import BUILDINGS_AT_ONCE, coordinates, iter_building_blocks, require_dimension
from .outlines.footprint import Footprints
from .planes.plane_detection import LEVELS, PLANES
from .planes.plane_solids import checked_sloped_solids, is_sloped
from .planes.roof_type import roof_type
from .quality import ModelFit, RoofCell, model_fit
from .solids.plan_partition import partition_plan
from .solids.solid import building_solids
from .solids.validity import check_solid

LEVEL_LOD, SLOPED_LOD = "1.3", "2.2"

STOREY = 2.5
"""Height (m) given to a building whose ground is not known, below its lowest roof."""

OK, BLOCK, SIMPLIFIED, GROUND_UNKNOWN, NOT_MODELLED = (
    "ok", "plain block", "simplified", "ground unknown", "not modelled")
"""Status of a model: sound; one height for all; detail left out as it made no valid solid; base assumed; none."""


@dataclass(frozen=True)
class RoofInput:
    """Roof polygons, one row each: polygon (with z where its roof is a plane), building, roof, height (m), status."""

    polygon: np.ndarray
    building_id: np.ndarray
    roof_id: np.ndarray
    height: np.ndarray
    status: np.ndarray


@dataclass(frozen=True)
class BuildingModel:
    """The model of one footprint.

    Attributes
    ----------
    building_id : number of the building.
    solids : closed solids, one for each part that stands alone; empty where there is no model.
    base : height of the ground face, m.
    roofs : number of roofs.
    status, reason : one of the words above, and why.
    fit : figures of fit to the points; None where no points were given.
    density : roof points a m2 of the plan, NaN where no points were given.
    unseen : share of the plan without roof points, NaN where no points were given.
    lod : level of detail, "2.2" with roofs on their planes, "1.3" with level ones.
    roof_type : what the roof is, a word of `roof_type`; empty without a model.
    """

    building_id: int
    solids: tuple[Solid, ...]
    base: float
    roofs: int
    status: str
    reason: str
    fit: ModelFit | None = None
    density: float = float("nan")
    unseen: float = float("nan")
    lod: str = LEVEL_LOD
    roof_type: str = ""


@dataclass(frozen=True)
class ModelPiece:
    """One piece of work: a block of buildings with their roofs, base heights and points."""

    ids: np.ndarray
    outlines: np.ndarray
    notes: np.ndarray
    base: np.ndarray
    roofs: list[RoofInput]
    sloped: bool
    points: list[np.ndarray] | None = field(default=None)


def build_models(footprints: Footprints, roofs: RoofInput, base: np.ndarray, cloud: PointCloud | None = None,
                 executor: Executor | None = None, progress: Progress = SILENT,
                 roof_shape: str = LEVELS) -> list[BuildingModel]:
    """A model, or the reason why there is none, for every footprint, in their order.

    Parameters
    ----------
    roofs : polygons and heights of the roofs. base : (n,) ground height of each building, m, NaN where unknown.
    cloud : points with `building_id` and `roof_id`, for the figures of fit.
    roof_shape : `PLANES`: roofs as their polygons' z has them (LoD2.2, where any is sloped); `LEVELS`: all at their one
        height (LoD1.3).

    Raises
    ------
    InputError : no roof belongs to any of the footprints.
    """
    if len(roofs.building_id) and not np.isin(roofs.building_id, footprints.ids).any():
        raise InputError("No roof has a building_id that the outlines have: give the outlines that the roofs "
                         "were made with.")
    models: list[BuildingModel | None] = [None] * len(footprints)
    sloped = roof_shape == PLANES and any(is_sloped(polygon) for polygon in roofs.polygon)
    pieces = _pieces(footprints, roofs, base, cloud, sloped, progress)
    for rows, made in in_order(_model_piece, pieces, executor, progress.check):
        for row, model in zip(rows, made):
            models[row] = model
        progress.check()
    return models


def _pieces(footprints: Footprints, roofs: RoofInput, base: np.ndarray, cloud: PointCloud | None,
            sloped: bool, progress: Progress):
    """Blocks of buildings, with their points where a cloud is given."""
    order = np.argsort(roofs.building_id, kind="stable")
    sorted_ids = roofs.building_id[order]

    def roofs_of(number: int) -> RoofInput:
        rows = order[np.searchsorted(sorted_ids, number):np.searchsorted(sorted_ids, number, "right")]
        return RoofInput(*(getattr(roofs, name)[rows] for name in RoofInput.__dataclass_fields__))

    done = 0
    for rows, points in _blocks(footprints, cloud, progress.part(0.0, 0.3)):
        yield rows, ModelPiece(footprints.ids[rows], footprints.polygons[rows], footprints.notes[rows], base[rows],
                               [roofs_of(int(number)) for number in footprints.ids[rows]], sloped, points)
        done += len(rows)
        progress.part(0.3, 1.0).step(done / len(footprints))


def _blocks(footprints: Footprints, cloud: PointCloud | None, progress: Progress):
    """Rows of the footprints and the roof points (n, 3) of each, block by block."""
    if cloud is None:
        for rows in np.array_split(np.arange(len(footprints)), max(len(footprints) // BUILDINGS_AT_ONCE, 1)):
            yield rows, None
        return
    for name in ("building_id", "roof_id"):
        require_dimension(cloud, name, "Segment roofs")
    layout = PointLayout(cloud)
    for rows, blocks in iter_building_blocks(cloud, layout, footprints.ids, progress):
        yield rows, [np.column_stack(coordinates(layout, records[records["roof_id"] > 0])) for records in blocks]


def _model_piece(piece: tuple[np.ndarray, ModelPiece]) -> tuple[np.ndarray, list[BuildingModel]]:
    rows, block = piece
    made = []
    for place, number in enumerate(block.ids.tolist()):
        points = None if block.points is None else block.points[place]
        made.append(model_building(number, block.outlines[place], block.notes[place], block.roofs[place],
                                   float(block.base[place]), points, block.sloped))
    return rows, made


def model_building(number: int, outline: shapely.Geometry | None, note: str, roofs: RoofInput, base: float,
                   points: np.ndarray | None = None, sloped: bool = False) -> BuildingModel:
    """The model of one building from its roofs, sloped or level, with its figures of fit to `points` (n, 3)."""
    if not len(roofs.height):
        reason = note or "no roof was found in its points"
        return BuildingModel(number, (), base, 0, NOT_MODELLED, reason)
    status, reason = OK, note
    if (roofs.roof_id == 0).all():
        status, reason = BLOCK, f"too few points for roofs; {note}".rstrip("; ")
    if not np.isfinite(base):
        base = float(roofs.height.min()) - STOREY
        status = GROUND_UNKNOWN if status == OK else status
        reason = f"its ground is not known, the base is put {STOREY} m under its lowest roof"
    try:
        solids, problems, lod = (), [""], SLOPED_LOD
        if sloped:
            lids = shapely.force_3d(roofs.polygon, roofs.height)
            solids, problems = checked_sloped_solids(outline, lids, roofs.roof_id, base)
        if problems:
            lod = LEVEL_LOD
            if sloped:
                status = SIMPLIFIED if status == OK else status
                why = f"level roofs, as the sloped solid is not valid ({problems[0]})"
                reason = f"{reason}; {why}" if reason else why
            solids, problems = _checked_solids(outline, roofs.polygon, roofs.height, roofs.roof_id, base)
        if problems:
            solids, status, reason = _simplified(outline, roofs, base, problems)
    except InsufficientDataError as error:
        return BuildingModel(number, (), base, 0, NOT_MODELLED, str(error))
    model = BuildingModel(number, solids, base, len(set(roofs.roof_id.tolist())), status, reason, lod=lod,
                          roof_type=roof_type(roof_cells(solids)) if solids else "")
    return model if points is None or not solids else _measured(model, points)


def _checked_solids(outline: shapely.Geometry | None, polygons: np.ndarray, heights: np.ndarray, ids: np.ndarray,
                    base: float) -> tuple[tuple[Solid, ...], list[str]]:
    """Solids and what the check says against them."""
    plan = partition_plan(outline, list(polygons), heights.tolist(), ids.tolist(), limit="roofs")
    solids = building_solids(plan.cells, base)
    return solids, [f"{problem.code} {problem.name}" for solid in solids for problem in check_solid(solid)]


def _simplified(outline: shapely.Geometry | None, roofs: RoofInput, base: float,
                problems: list[str]) -> tuple[tuple[Solid, ...], str, str]:
    """One block at the mean roof height, where the detailed solid is not valid; nothing where even that fails."""
    areas = shapely.area(roofs.polygon)
    height = float(np.average(roofs.height, weights=areas)) if areas.sum() else float(roofs.height.mean())
    whole = shapely.union_all(shapely.make_valid(roofs.polygon))
    solids, left = _checked_solids(outline, np.array([whole], dtype=object), np.array([height]), np.array([0]), base)
    if left:
        return (), NOT_MODELLED, f"no valid solid could be made ({left[0]})"
    return solids, SIMPLIFIED, f"one height for all roofs, as the detailed solid is not valid ({problems[0]})"


def _measured(model: BuildingModel, points: np.ndarray) -> BuildingModel:
    """The model with its figures of fit."""
    cells, walls = roof_cells(model.solids), wall_rectangles(model.solids)
    fit = model_fit(points[:, 0], points[:, 1], points[:, 2], cells, walls)
    plan = shapely.union_all([cell.polygon for cell in cells])
    density = len(points) / plan.area
    return replace(model, fit=fit, density=density, unseen=unseen_share(plan, points, density))


def unseen_share(plan: shapely.Geometry, points: np.ndarray, density: float) -> float:
    """Share of a plan's area without points (n, 3), on cells in which `density` points/m2 give four on average."""
    if not len(points):
        return 1.0
    grid = Grid.covering(*plan.bounds, 2.0 / math.sqrt(density))
    hit = np.zeros(grid.shape, bool)
    row, column, inside = grid.cells(points[:, 0], points[:, 1])
    hit[row[inside], column[inside]] = True
    x, y = np.meshgrid(*grid.centres())
    shapely.prepare(plan)
    within = shapely.contains_xy(plan, x, y)
    return float(1.0 - hit[within].mean()) if within.any() else 0.0


def roof_cells(solids: tuple[Solid, ...]) -> list[RoofCell]:
    """Roofs of solids as plan polygons with heights."""
    cells = []
    for solid in solids:
        for polygon, kind, face, roof_id in zip(surfaces(solid), solid.surface_type, solid.faces, solid.roof_id):
            if kind == ROOF:
                place, gradient = solid.vertices[face[0][0]].tolist(), (0.0, 0.0)
                if np.ptp(solid.vertices[list(face[0]), 2]) > 0:
                    normal = face_normal(solid.vertices, face)
                    gradient = float(-normal[0] / normal[2]), float(-normal[1] / normal[2])
                cells.append(RoofCell(shapely.force_2d(polygon), place[2], roof_id, gradient, (place[0], place[1])))
    return cells


def wall_rectangles(solids: tuple[Solid, ...]) -> np.ndarray:
    """Walls of solids (w, 8): x and y of both ends, lowest z at both, highest z at both."""
    rows = []
    for solid in solids:
        for face, kind in zip(solid.faces, solid.surface_type):
            if kind not in (OUTER_WALL, INNER_WALL):
                continue
            corners = solid.vertices[list(face[0])]
            along = corners[:, :2] - corners[0, :2]
            length2 = (along**2).sum(axis=1)
            far = int(np.argmax(length2))
            at_far = along @ along[far] > 0.5 * length2[far]
            ends = corners[~at_far, 2], corners[at_far, 2]
            rows.append([*corners[0, :2], *corners[far, :2], *(z.min() for z in ends), *(z.max() for z in ends)])
    return np.array(rows, dtype=float).reshape(-1, 8)


def ground_area(solids: tuple[Solid, ...]) -> float:
    """Plan area of solids, m2."""
    return float(sum(shapely.area(surfaces(solid)[np.array([kind == GROUND for kind in solid.surface_type])]).sum()
                     for solid in solids))
