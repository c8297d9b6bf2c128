"""The model of one building from its roofs (J 5.3.4): valid solids, their fit to the points, a status and why."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import shapely

from ..errors import InsufficientDataError
from ..geometry.solid import ROOF, Solid
from ..wording import say
from .model_status import (
    BLOCK,
    GROUND_UNKNOWN,
    LOST_AREA,
    LOST_ROOFS,
    MAX_RMSE,
    MAX_RMSE_SLOPED,
    MAX_UNSEEN,
    MAX_UNSEEN_EXACT,
    NOT_MODELLED,
    OK,
    SIMPLIFIED,
    ModelFacts,
    judge,
    quality,
)
from .model_surfaces import ModelSurfaces
from .outlines.footprint import has_curved_walls
from .planes.lost_planes import broad_area
from .planes.plane_solids import checked_sloped_solids
from .planes.roof_type import roof_type
from .quality import ModelFit, height_differences, model_fit, surface_distances, unexplained_points
from .seen.seen_roofs import SeenRoofs, seen_roofs, unseen_share
from .solids.solid import checked_level_solids

LEVEL_LOD, SLOPED_LOD = "1.3", "2.2"

STOREY = 2.5
"""Height (m) given to a building whose ground is not known, below its lowest roof."""

MOST_FIT_POINTS = 50_000
"""Points of one building that the figures of fit are taken from; of more a regular choice."""

UNKNOWN_COVER = (math.nan, math.nan)
"""Density of the cloud about a building, and share of its outline beyond the cloud's edge, where neither is known."""

KNOWN, FROM_NEIGHBOURS, ASSUMED = "", "taken from its neighbours", f"assumed {STOREY} m under its lowest roof"
"""Where a base height comes from."""


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
    status, reason : one of `model_status.STATUSES`, and why.
    fit : figures of fit to the points; None where no points were given.
    base_source : where the base comes from: `KNOWN`, `FROM_NEIGHBOURS` or `ASSUMED`.
    quality : 0 to 1, see `model_status.quality`.
    beyond : share of the outline beyond the cloud's edge, NaN where it is not known.
    seen : what the points have seen of its roofs, in the order of the solids' roof faces; None where no points were
        given or the density of the cloud is not known.
    density : roof points a m2 of the plan, NaN where no points were given.
    unseen : share of the plan without roof points, NaN where no points were given; where the density of the cloud is
        known, the share farther than two of its spacings from every roof point.
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
    quality: float = float("nan")
    base_source: str = KNOWN
    beyond: float = float("nan")
    seen: SeenRoofs | None = None


@dataclass(frozen=True)
class FitPoints:
    """Points (n, 3) that can be roof, m, and the roof that took each (n,), 0 for none."""

    xyz: np.ndarray
    roof: np.ndarray


def model_building(number: int, outline: shapely.Geometry | None, note: str, roofs: RoofInput, base: float,
                   points: FitPoints | None = None, sloped: bool = False, source: str = KNOWN,
                   open_share: float = 0.0, cover: tuple[float, float] = UNKNOWN_COVER) -> BuildingModel:
    """The model of one building from its roofs, sloped or level, with its figures of fit to `points`.

    `source` : where the base height comes from; without a base it is assumed. `cover` : density of the cloud about the
    building, points a m2, and share of the outline beyond the cloud's edge, NaN where not known.
    """
    if not len(roofs.height):
        return unmodelled(number, base, note or say("no roof was found in its points"))
    status, reason = _roofs_status(roofs, note)
    base, source = _base(base, source, _lowest_roof(roofs, sloped))
    if source != KNOWN:
        status = GROUND_UNKNOWN if status == OK else status
        reason = "; ".join(filter(None, (reason, say("its ground is not known, {source}", source=source))))
    try:
        solids, status, reason, lod = _valid_solids(outline, roofs, base, sloped, status, reason)
    except InsufficientDataError as error:
        return unmodelled(number, base, str(error))
    model = BuildingModel(number, solids, base, len(set(roofs.roof_id.tolist())), status, reason, lod=lod,
                          base_source=source)
    if not solids:
        return replace(model, quality=0.0)
    faces = ModelSurfaces.of(solids)
    model = replace(model, roof_type=roof_type(faces.cells))
    if points is not None:
        model = _measured(model, points, faces, *cover)
    return _judged(model, outline, _lost_roofs(points, roofs, faces), open_share, faces.ground_area)


def roof_remarks(model: BuildingModel) -> list[list[dict[str, float]]]:
    """What is said of each face of each solid: of roofs `seen` (share) and `sigma` (m), where they are known."""
    if model.seen is None:
        return [[{} for _ in solid.faces] for solid in model.solids]
    figures = iter(zip(model.seen.seen.tolist(), model.seen.sigma.tolist()))
    return [[_roof_remark(*next(figures)) if kind == ROOF else {} for kind in solid.surface_type]
            for solid in model.solids]


def _roof_remark(seen: float, sigma: float) -> dict[str, float]:
    """Rounded figures of one roof, those that are known."""
    return {name: round(value, 2) for name, value in (("seen", seen), ("sigma", sigma)) if math.isfinite(value)}


def unmodelled(number: int, base: float, reason: str) -> BuildingModel:
    """What stands for a building without a model."""
    return BuildingModel(number, (), base, 0, NOT_MODELLED, reason, quality=0.0)


def _roofs_status(roofs: RoofInput, note: str) -> tuple[str, str]:
    """Status and reason that the steps before have given the roofs."""
    status, reason = OK, note
    if (roofs.roof_id == 0).all():
        status, reason = BLOCK, say("too few points for roofs; {note}", note=note).rstrip("; ")
    simplified = next((str(words) for words in roofs.status if SIMPLIFIED in str(words)), "")
    if simplified:
        why = simplified[simplified.index(SIMPLIFIED) + len(SIMPLIFIED):].lstrip(": ")
        status, reason = SIMPLIFIED, "; ".join(filter(None, (why, note)))
    return status, reason


def _lowest_roof(roofs: RoofInput, sloped: bool) -> float:
    """Height (m) of the lowest place of roofs: of sloped ones their lowest corner."""
    heights = shapely.get_coordinates(shapely.force_3d(roofs.polygon, roofs.height), include_z=True)[:, 2]
    return float(heights.min() if sloped else roofs.height.min())


def _base(base: float, source: str, lowest_roof: float) -> tuple[float, str]:
    """Height of the ground face and where it comes from: under the lowest roof where nothing better is known."""
    too_high = source == FROM_NEIGHBOURS and base >= lowest_roof
    return (base, source) if np.isfinite(base) and not too_high else (lowest_roof - STOREY, ASSUMED)


def _valid_solids(outline: shapely.Geometry | None, roofs: RoofInput, base: float, sloped: bool, status: str,
                  reason: str) -> tuple[tuple[Solid, ...], str, str, str]:
    """The most detailed solids that are valid, with status, reason and level of detail: sloped, level, one block."""
    if sloped:
        lids = shapely.force_3d(roofs.polygon, roofs.height)
        solids, problems = checked_sloped_solids(outline, lids, roofs.roof_id, base)
        if not problems:
            return solids, status, reason, SLOPED_LOD
        status = SIMPLIFIED if status == OK else status
        why = say("level roofs, as the sloped solid is not valid ({problems})", problems=problems[0])
        reason = f"{reason}; {why}" if reason else why
    solids, problems = checked_level_solids(outline, roofs.polygon, roofs.height, roofs.roof_id, base)
    if problems:
        solids, status, reason = _simplified(outline, roofs, base, problems)
    return solids, status, reason, LEVEL_LOD


def _judged(model: BuildingModel, outline: shapely.Geometry | None, lost: bool,
            open_share: float, area: float) -> BuildingModel:
    """The model, on `area` m2, with the status and the quality that its facts give."""
    fit = model.fit
    top = max(float(solid.vertices[:, 2].max()) for solid in model.solids)
    official = area if outline is None else outline.area / max(1.0 - open_share, 0.01)
    facts = ModelFacts(top - model.base, area, official,
                       fit.points if fit else math.nan, fit.not_explained if fit else math.nan, model.unseen,
                       fit.rmse_z95 if fit else math.nan,
                       lost, outline is not None and has_curved_walls(outline), model.beyond,
                       MAX_UNSEEN if model.seen is None else MAX_UNSEEN_EXACT,
                       MAX_RMSE_SLOPED if model.lod == SLOPED_LOD else MAX_RMSE)
    status, reason = judge(model.status, model.reason, facts)
    doubt = math.nan if model.seen is None else model.seen.doubt
    figure = quality(status, fit.rmse_z, fit.rmse_z95, fit.not_explained, model.unseen, doubt) if fit else math.nan
    return replace(model, status=status, reason=reason, quality=figure)


def _simplified(outline: shapely.Geometry | None, roofs: RoofInput, base: float,
                problems: list[str]) -> tuple[tuple[Solid, ...], str, str]:
    """One block at the mean roof height, where the detailed solid is not valid; nothing where even that fails."""
    areas = shapely.area(roofs.polygon)
    height = float(np.average(roofs.height, weights=areas)) if areas.sum() else float(roofs.height.mean())
    whole = shapely.union_all(shapely.make_valid(roofs.polygon))
    solids, left = checked_level_solids(outline, np.array([whole], dtype=object), np.array([height]), np.array([0]),
                                        base)
    if left:
        return (), NOT_MODELLED, say("no valid solid could be made ({left})", left=left[0])
    return solids, SIMPLIFIED, say("one height for all roofs, as the detailed solid is not valid ({problems})",
                                   problems=problems[0])


def _lost_roofs(points: FitPoints | None, roofs: RoofInput, faces: ModelSurfaces) -> bool:
    """Whether a roof found in the points is not in the model, and no other surface of it explains its points.

    What lies in narrow strips alone, as on parapets, is no roof.
    """
    said = any(str(status).startswith(LOST_ROOFS) for status in roofs.status)
    if points is None:
        return said
    step = -(-len(points.xyz) // MOST_FIT_POINTS)
    roof = points.roof[::step]
    absent = ~np.isin(roof, [0, *roofs.roof_id.tolist()])
    xyz = points.xyz[::step][absent]
    if not len(xyz):
        return False
    cells = faces.cells
    dz = height_differences(*xyz.T, cells)
    far = unexplained_points(*xyz[:, :2].T, dz, surface_distances(*xyz.T, cells, faces.walls), cells)
    density = np.count_nonzero(roof) / faces.ground_area
    missed, number = xyz[far & np.isfinite(dz)], roof[absent][far & np.isfinite(dz)]
    return any(broad_area(missed[number == one], density) >= LOST_AREA for one in np.unique(number))


def _measured(model: BuildingModel, points: FitPoints, faces: ModelSurfaces, cloud_density: float,
              beyond: float) -> BuildingModel:
    """The model with its figures of fit, and of what was seen of it."""
    on_roof = points.roof > 0
    step = -(-len(points.xyz) // MOST_FIT_POINTS)
    fit = model_fit(*np.ascontiguousarray(points.xyz[::step].T), faces.cells, faces.walls, on_roof[::step])
    fit = replace(fit, points=len(points.xyz))
    plan = shapely.union_all([cell.polygon for cell in faces.cells])
    roof = points.xyz[on_roof]
    density = len(roof) / plan.area
    model = replace(model, fit=fit, density=density, beyond=beyond)
    if not cloud_density > 0:
        return replace(model, unseen=unseen_share(plan, roof, density))
    seen = seen_roofs(faces.cells, roof, cloud_density, model.base)
    return replace(model, unseen=seen.unseen, seen=seen)
