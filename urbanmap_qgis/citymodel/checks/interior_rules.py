"""Rules on rooms, openings and the sides that surfaces show (L-bldg-07, -10, -11, -12)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from ...io.files.rule_table import CheckRule
from .checked_file import CityBlock
from .city_rule_table import Violation, city_rule, violation
from .feature_walk import CityBody, CityFeature, CityThing
from .geometry_rules import PLANE
from .solid_rules import INNER_SURFACES, OPENINGS, boundary_ids, closed_rings, extent_of, member_polygons, near_lines

_INSIDE = ("bldg:Room", "bldg:IntBuildingInstallation", "bldg:BuildingFurniture")
_WHOLE = ("bldg:Building", "bldg:BuildingPart")


@city_rule("L-bldg-07")
def _opening_without_border(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    """Openings of LOD4 of which no side lies on a side of the surface that holds them."""
    owners: dict[int, list[int]] = {}
    for number, polygon in enumerate(block.shapes.polygons):
        if polygon.lod == 4:
            owners.setdefault(id(polygon.feature), []).append(number)
    for feature in block.features(*OPENINGS):
        inner, around = owners.get(id(feature)), owners.get(id(feature.parent))
        if not inner or not around:
            continue
        borders = closed_rings(block, around)
        sides = [np.stack([ring[:-1], (ring[:-1] + ring[1:]) / 2, ring[1:]], axis=1)
                 for ring in closed_rings(block, inner)]
        shared = [near_lines(side.reshape(-1, 3), borders).reshape(-1, 3).all(axis=1).any() for side in sides]
        if not any(shared):
            yield violation(feature, 4, block.shapes.first_place(inner[0]))


def _solids(thing: CityThing, types: tuple[str, ...], least: int, kinds: tuple[str, ...] = ("Solid",),
            ) -> Iterator[tuple[CityBody, list[tuple[int, bool]]]]:
    """Solids of features of some types from a level on, with the polygons in them and whether they are turned over."""
    for body in thing.bodies:
        if body.kind in kinds and body.members and body.feature.type in types and (body.lod or 0) >= least:
            yield body, member_polygons(thing, body) or []


@city_rule("L-bldg-10")
def _wrong_side(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    """Boundary surfaces that a building's solid turns over to look outwards, or a room's solid takes as they are.

    A solid's own faces look outwards, which L14 judges: of a room that is into the walls.
    """
    for thing in block.things:
        for types, least, wrong in ((_WHOLE, 2, True), (("bldg:Room",), 4, False)):
            for _, members in _solids(thing, types, least):
                for number, flipped in members:
                    polygon = thing.polygons[number]
                    if flipped == wrong and polygon.feature.type.endswith("Surface"):
                        yield violation(polygon.feature, polygon.lod, side="inwards" if wrong else "outwards",
                                        side_ja="内側" if wrong else "外側")


@city_rule("L-bldg-11")
def _room_not_turned(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    """Faces of a room's solid or surfaces that are no turned surface of the room or of its installations."""
    for thing in block.things:
        for body, members in _solids(thing, ("bldg:Room",), 4, ("Solid", "MultiSurface")):
            known = boundary_ids(thing, body.feature, INNER_SURFACES, 4)
            for number, flipped in members:
                if not flipped or thing.polygons[number].id not in known:
                    yield violation(body.feature, 4)


def _holder(feature: CityFeature) -> CityFeature | None:
    """The room, installation or piece of furniture that a feature belongs to; None outside of these."""
    one: CityFeature | None = feature
    while one is not None and one.type not in _INSIDE:
        one = one.parent
    return one


@city_rule("L-bldg-12")
def _outside_of_building(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    """Polygons of LOD4 of what is inside that stand out of the building's solids, in plan or above or below."""
    shapes = block.shapes
    for thing in block.things:
        inner = [(number, polygon) for polygon in thing.polygons
                 if polygon.lod == 4 and _holder(polygon.feature) is not None
                 and (number := shapes.number.get(id(polygon))) is not None]
        if not inner:
            continue
        bodies = [body for body in thing.bodies
                  if body.kind == "Solid" and body.lod == 4 and body.feature.type in _WHOLE]
        known = [box for body in bodies if (box := extent_of(block, thing, body)) is not None]
        if not known:
            continue
        plan = shapely.buffer(shapely.union_all([box[0] for box in known]), PLANE)
        low, high = min(box[1] for box in known) - PLANE, max(box[2] for box in known) + PLANE
        for number, polygon in inner:
            ring = shapes.outer_ring[number]
            places = shapes.metres[shapes.start[ring]:shapes.start[ring + 1]]
            inside = shapely.intersects_xy(plan, places[:, 0], places[:, 1]).all()
            if not inside or places[:, 2].min() < low or places[:, 2].max() > high:
                yield violation(_holder(polygon.feature), 4, shapes.first_place(number))
