"""Building models as objects of a city model: all levels of detail side by side, parts where they stand alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import shapely

from ..citymodel.model import (
    FOOTPRINT,
    GROUND_SURFACE,
    MULTI_SURFACE,
    ROOF_EDGE,
    ROOF_SURFACE,
    SOLID,
    CityObject,
    CityShape,
    CitySurface,
)
from ..citymodel.solids import in_parts, solid_surfaces
from ..geometry.solid import GROUND, INNER_WALL, OUTER_WALL, OVERHANG, FaceTexture, Solid, surfaces
from ..geometry.solid_faces import solids_of
from .levels_of_detail import block_solid, stepped_solids
from .model_figures import ModelFigures, model_figures, roof_outline
from .party_walls import party_wall_areas
from .solids.validity import check_solid

NOT_CLOSED = "not closed"
_INSIDE = 0.02
"""A wall's middle farther (m) inside the ground's outline than this is a step between roofs."""
_ROUND = 1e-4


@dataclass(frozen=True, eq=False)
class BuildingSource:
    """A building to put into a city model.

    Attributes
    ----------
    id : unique.
    attributes : figures and what the source says, in order.
    solids : its most detailed solids; empty where it has no model.
    lod : level of detail of the solids, "2.2" or "1.3".
    textures : for each solid one entry a face, or empty.
    remarks : for each solid further attributes of each face, or empty.
    problems : of each solid, what keeps it from being closed and valid, empty for none; may be left out.
    """

    id: str
    attributes: Mapping[str, Any] = field(default_factory=dict)
    solids: Sequence[Solid] = ()
    lod: str = "2.2"
    textures: Sequence[Sequence[FaceTexture | None]] = ()
    problems: Sequence[str] = ()
    remarks: Sequence[Sequence[Mapping[str, Any]]] = ()


def city_objects(buildings: Sequence[BuildingSource], walls: bool = True) -> Iterator[tuple[CityObject, ModelFigures]]:
    """Objects with all levels of detail, and the figures, of buildings, one after another.

    Attributes of an object are those of its source, then its figures, which replace those of the same name. A solid
    that is not closed or not valid is kept as loose surfaces, and the object's `problems` say so.

    `walls` : whether walls are told apart by the neighbours; not where neighbours may be missing, as in a tile.
    """
    party = party_wall_areas([building.solids for building in buildings]) if walls else np.full(len(buildings), np.nan)
    for building, area in zip(buildings, party.tolist()):
        yield _city_object(building, area)


def _city_object(building: BuildingSource, party_area: float) -> tuple[CityObject, ModelFigures]:
    problems = tuple(building.problems) or ("",) * len(building.solids)
    figures = model_figures(building.solids, building.lod.startswith("2"), party_area)
    attributes = {**building.attributes, **_figure_attributes(figures)}
    textures = building.textures or [()] * len(problems)
    remarks = building.remarks or [()] * len(problems)
    parts = [_shapes(solid, building.lod, problem, solid_surfaces(solid, faces, said))
             for solid, problem, faces, said in zip(building.solids, problems, textures, remarks)]
    found = tuple(dict.fromkeys(problem for problem in problems if problem))
    item = CityObject(building.id, attributes, _outlines(building.solids, figures), problems=found)
    return in_parts(item, parts), figures


def _figure_attributes(figures: ModelFigures) -> dict[str, Any]:
    """Figures as attributes, centimetres and below left out."""
    known = {name: getattr(figures, name) for name in ModelFigures.__dataclass_fields__}
    return {name: round(value, 2) if isinstance(value, float) else value for name, value in known.items()
            if value is not None and value == value}


def _shapes(solid: Solid, lod: str, problem: str, detailed: tuple[CitySurface, ...]) -> tuple[CityShape, ...]:
    """Shapes of one part, from coarse to detailed."""
    if problem:
        return (CityShape(lod, MULTI_SURFACE, (detailed,)),)
    shapes = [CityShape("1.2", SOLID, (solid_surfaces(one),)) for one in block_solid(solid)]
    if lod != "1.3":
        shapes += [CityShape("1.3", SOLID, (solid_surfaces(one),)) for one in stepped_solids(solid)]
    return (*shapes, CityShape(lod, SOLID, (detailed,)))


def _outlines(solids: Sequence[Solid], figures: ModelFigures) -> tuple[CityShape, ...]:
    """Level of detail 0: outline on the ground, and of the roofs at the height of the block."""
    if not solids:
        return ()
    grounds = shapely.union_all([plan for solid in solids for plan, kind in
                                 zip(shapely.force_2d(surfaces(solid)), solid.surface_type) if kind == GROUND])
    top = figures.ground_height + figures.roof_50
    return tuple(CityShape("0", shape, (flat,)) for shape, flat in (
        (FOOTPRINT, _flat(grounds, figures.ground_height, GROUND_SURFACE)),
        (ROOF_EDGE, _flat(roof_outline(solids), top, ROOF_SURFACE))) if flat)


def _flat(plan: shapely.Geometry, height: float, kind: str) -> tuple[CitySurface, ...]:
    """Polygons of a plan at one height, m, seen from above."""
    surfaces = []
    for polygon in shapely.get_parts(shapely.simplify(plan, _ROUND)):
        if polygon.geom_type != "Polygon" or polygon.is_empty:
            continue
        rings = shapely.get_rings(shapely.orient_polygons(polygon)) if hasattr(shapely, "orient_polygons") \
            else shapely.get_rings(shapely.geometry.polygon.orient(polygon))
        corners = [shapely.get_coordinates(ring)[:-1] for ring in rings]
        surfaces.append(CitySurface(tuple(np.column_stack([ring, np.full(len(ring), height)]) for ring in corners),
                                    kind, {"area": round(polygon.area, 2)}))
    return tuple(surfaces)


def building_source(identifier: str, faces: shapely.Geometry | None, attributes: Mapping[str, Any],
                    lod: str = "2.2") -> BuildingSource:
    """A building from the faces (MultiPolygon with z) of a layer of models, as any step writes them.

    Walls inside the plan are steps between roofs; faces that look down over the ground are undersides.
    """
    if faces is None or shapely.is_empty(faces) or not shapely.has_z(faces):
        return BuildingSource(identifier, attributes, lod=lod)
    solids = [_told_apart(solid) for solid in solids_of(faces)]
    problems = []
    for solid in solids:
        found = check_solid(solid)
        problems.append(f"{NOT_CLOSED}: {found[0].code} {found[0].name}" if found else "")
    return BuildingSource(identifier, attributes, solids, lod, problems=problems)


def _told_apart(solid: Solid) -> Solid:
    """A solid whose walls are outer or inner ones, and whose downward faces are the ground or undersides."""
    kinds = list(solid.surface_type)
    base = float(solid.vertices[:, 2].min())
    for face, kind in enumerate(kinds):
        if kind == GROUND and float(solid.vertices[list(solid.faces[face][0]), 2].mean()) > base + _INSIDE:
            kinds[face] = OVERHANG
    polygons = surfaces(solid)
    ground = [shapely.force_2d(polygon) for polygon, kind in zip(polygons, kinds) if kind in (GROUND, OVERHANG)]
    inside = shapely.buffer(shapely.union_all(shapely.make_valid(np.array(ground, object))), -_INSIDE)
    shapely.prepare(inside)
    for face, kind in enumerate(kinds):
        if kind == OUTER_WALL:
            middle = solid.vertices[list(solid.faces[face][0]), :2]
            span = (middle.min(axis=0) + middle.max(axis=0)) / 2.0
            kinds[face] = INNER_WALL if shapely.contains_xy(inside, *span) else OUTER_WALL
    return replace(solid, surface_type=tuple(kinds))
