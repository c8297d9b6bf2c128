"""Whether anything can be said of a place, and at what height a vehicle stands there."""

from __future__ import annotations

import numpy as np
import shapely

from ..localisation_settings import LocalisationSettings
from ..walls.wall_map import WallMap
from .place_status import BELOW, HEIGHTS_DIFFER, INSIDE, NO_HEIGHT, OUTSIDE, TUNNEL
from .road_places import RoadPlaces

_DEEP = 3.0
"""A road so far below the ground, m, runs in a tunnel."""

_DIFFERENT = 15.0
"""Roads and the feet of the walls beside them do not differ by so much, m, unless their height systems do."""

_AROUND = 100.0
_SKY_AZIMUTHS, _SKY_ELEVATIONS = 24, 6


def refusals(city, places: RoadPlaces, settings: LocalisationSettings) -> tuple[RoadPlaces, np.ndarray]:
    """Places at the heights at which vehicles stand, and why nothing can be said of them (n,), empty where it can.

    The height is that of the ground raster, then of the road, then of the feet of the walls beside it.
    """
    count = len(places)
    refused = np.full(count, "", object)
    xy, stated = places.place[:, :2], places.place[:, 2]
    ground = places.ground
    feet = city.walls.feet(xy, _AROUND) if city.walls is not None else np.full(count, np.nan)
    height = np.where(np.isfinite(ground), ground, np.where(np.isfinite(stated), stated, feet))
    on_ground = places.with_heights(height)
    if city.walls is not None:
        refused[~np.isfinite(height)] = NO_HEIGHT
        beside = _reach_of(city.walls, xy, settings.scanner.max_range)
        # Far from all buildings no feet are known either; markings there still tell their part.
        refused[~beside] = OUTSIDE if city.markings is None else ""
        refused[np.abs(height - feet) > _DIFFERENT] = HEIGHTS_DIFFER
        look = np.flatnonzero((refused == "") & np.isfinite(height))
        sensor = on_ground.place[look] + [0.0, 0.0, settings.scanner.height]
        refused[look[city.walls.obstacles.inside(sensor)]] = INSIDE
    refused[stated < ground - _DEEP] = BELOW
    refused[places.tunnel] = TUNNEL
    return on_ground, refused


def sky_covered(walls: WallMap, sensor: np.ndarray) -> np.ndarray:
    """(n,) share of the sky above 5 degrees that buildings hide from places (n, 3), by solid angle."""
    edge = np.linspace(np.sin(np.radians(5.0)), 1.0, _SKY_ELEVATIONS + 1)
    elevation = np.arcsin((edge[1:] + edge[:-1]) / 2)
    azimuth = np.arange(_SKY_AZIMUTHS) * 2 * np.pi / _SKY_AZIMUTHS
    up, round_ = (values.ravel() for values in np.meshgrid(elevation, azimuth))
    direction = np.column_stack([np.cos(up) * np.sin(round_), np.cos(up) * np.cos(round_), np.sin(up)])
    free = walls.obstacles.free(np.repeat(sensor, len(direction), axis=0), np.tile(direction, (len(sensor), 1)))
    return 1.0 - free.reshape(len(sensor), len(direction)).mean(axis=1)


def _reach_of(walls: WallMap, xy: np.ndarray, distance: float) -> np.ndarray:
    """(n,) whether places lie within the area of the models, or within a distance of it."""
    ends = np.concatenate([walls.walls.start, walls.walls.end])
    area = shapely.buffer(shapely.convex_hull(shapely.multipoints(ends)), distance)
    return shapely.contains_xy(area, xy[:, 0], xy[:, 1])
