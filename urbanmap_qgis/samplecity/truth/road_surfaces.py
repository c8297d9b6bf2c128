"""The true surfaces of the sample city's roads, as PLATEAU divides them: carriageways, sidewalks, junctions."""

from __future__ import annotations

import shapely

from ..scene.ground import KERB_RADIUS, Street
from ..scene.markings import BAR, STOP
from ..scene.world import Scene

REACH = 30.0
"""Roads are given up to here beyond the city's square, m."""


def official_roads(scene: Scene) -> list[shapely.Polygon]:
    """Surfaces up to the outer borders of the pavements, as a road register has them."""
    bands = [_band(scene, street, street.half_width + street.pavement) for street in scene.ground.streets]
    round_ = max(KERB_RADIUS - max(street.pavement for street in scene.ground.streets), 0.1)
    whole = shapely.union_all(bands).buffer(round_, quad_segs=16).buffer(-round_, quad_segs=16) & _extent(scene)
    return [part for part in shapely.get_parts(scene.ground.plan_to_world(whole)) if part.geom_type == "Polygon"]


def true_carriageway(scene: Scene) -> shapely.Geometry:
    """Between the kerbs, without islands."""
    bands = [_band(scene, street, street.half_width) for street in scene.ground.streets]
    whole = shapely.union_all(bands).buffer(KERB_RADIUS, quad_segs=64).buffer(-KERB_RADIUS, quad_segs=64)
    return scene.ground.plan_to_world((whole & _extent(scene)) - shapely.union_all(list(scene.ground.islands)))


def _band(scene: Scene, street: Street, half: float) -> shapely.Polygon:
    long = 2.0 * (scene.size / 2.0 + REACH)
    if street.along == "u":
        return shapely.box(-long, street.at - half, long, street.at + half)
    return shapely.box(street.at - half, -long, street.at + half, long)


def _extent(scene: Scene) -> shapely.Polygon:
    reach = scene.size / 2.0 + REACH
    return shapely.box(-reach, -reach, reach, reach)


def true_junctions(scene: Scene) -> list[shapely.Polygon]:
    """Carriageways between the stop lines of each crossing."""
    ground, road = scene.ground, true_carriageway(scene)
    back = STOP - BAR / 2.0
    found = []
    for one in (street for street in ground.streets if street.along == "u"):
        for other in (street for street in ground.streets if street.along == "v"):
            half_u, half_v = other.half_width + back, one.half_width + back
            box = shapely.box(other.at - half_u, one.at - half_v, other.at + half_u, one.at + half_v)
            bands = [shapely.box(other.at - half_u, one.at - one.half_width - KERB_RADIUS, other.at + half_u,
                                 one.at + one.half_width + KERB_RADIUS),
                     shapely.box(other.at - other.half_width - KERB_RADIUS, one.at - half_v,
                                 other.at + other.half_width + KERB_RADIUS, one.at + half_v)]
            found.append(ground.plan_to_world(box & shapely.union_all(bands)) & road)
    return found
