"""What a scanner sees of walls: rays from its place to the first wall (J 6.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..localisation_settings import VehicleScanner
from .wall_map import WallMap

LAYERS = 5
"""Layers of a multi-layer scanner that are followed: walls are upright, so that more tell nothing new."""


@dataclass(frozen=True)
class WallScan:
    """Points on walls as seen from n places.

    Attributes
    ----------
    of : (m,) row of the place.
    layer, ray : (m,) numbers of the ray's elevation and azimuth.
    offset : (m, 3) from the sensor to the point, m.
    piece : (m,) number of the piece of wall.
    weight : (m,) rays of the scanner that each ray stands for.
    reach : (n, azimuths) m, distance in plan to the first wall in the layer nearest to level, inf where free.
    covered : (n,) share of the azimuths with a wall within range in that layer.
    """

    of: np.ndarray
    layer: np.ndarray
    ray: np.ndarray
    offset: np.ndarray
    piece: np.ndarray
    weight: np.ndarray
    reach: np.ndarray
    covered: np.ndarray


AZIMUTHS = 240
"""Rays of a layer that are followed."""


def scan_walls(walls: WallMap, sensor: np.ndarray, scanner: VehicleScanner) -> WallScan:
    """Rays of a scanner from places (n, 3), m, to the first walls within range."""
    azimuths = AZIMUTHS
    angle = np.arange(azimuths) * 2 * np.pi / azimuths
    elevation = scanner.elevations(LAYERS)
    up, round_ = np.meshgrid(elevation, angle, indexing="ij")
    direction = np.column_stack([(np.cos(up) * np.sin(round_)).ravel(), (np.cos(up) * np.cos(round_)).ravel(),
                                 np.sin(up).ravel()])
    start = np.repeat(sensor, len(direction), axis=0)
    every = np.tile(direction, (len(sensor), 1))
    piece, distance = walls.obstacles.first_hit(start, every, scanner.max_range)
    level = int(np.argmin(np.abs(elevation)))
    shape = (len(sensor), len(elevation), azimuths)
    reach = (distance * np.hypot(every[:, 0], every[:, 1])).reshape(shape)[:, level]
    hit = np.flatnonzero(piece >= 0)
    stands_for = 360.0 / scanner.resolution / azimuths * len(scanner.elevations()) / len(elevation)
    return WallScan(hit // len(direction), hit % len(direction) // azimuths, hit % azimuths,
                    every[hit] * distance[hit, None], piece[hit], np.full(len(hit), stands_for), reach,
                    np.isfinite(reach).mean(axis=1))
