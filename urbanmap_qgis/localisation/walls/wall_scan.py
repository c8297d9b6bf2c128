"""What a scanner sees of walls: rays from its place to the first wall (J 6.2).

Walls are upright, so that all layers of an azimuth which end on a piece of wall end at the same place of the plan: they
are one row with the layers' weight.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...gnss.rays.ray_fans import RayFan
from ..localisation_settings import VehicleScanner
from .wall_map import WallMap

LAYERS = 5
"""Layers of a multi-layer scanner that are followed: walls are upright, so that more tell nothing new."""


@dataclass(frozen=True)
class WallScan:
    """Pieces of walls as seen from n places, with l layers of rays.

    Attributes
    ----------
    of : (m,) row of the place, rising.
    ray : (m,) number of the azimuth.
    offset : (m, 2) in plan from the sensor to the points, m.
    piece : (m,) number of the piece of wall.
    layers : (m, l) which layers end there.
    distance : (m, l) m along the ray of each layer.
    weight : (m,) rays of the scanner that the layers stand for.
    reach : (n, azimuths) m, distance in plan to the first wall in the layer nearest to level, inf where free.
    covered : (n,) share of the azimuths with a wall within range in that layer.
    """

    of: np.ndarray
    ray: np.ndarray
    offset: np.ndarray
    piece: np.ndarray
    layers: np.ndarray
    distance: np.ndarray
    weight: np.ndarray
    reach: np.ndarray
    covered: np.ndarray


AZIMUTHS = 240
"""Rays of a layer that are followed."""


def scan_walls(walls: WallMap, sensor: np.ndarray, scanner: VehicleScanner) -> WallScan:
    """Rays of a scanner from places (n, 3), m, to the first walls within range."""
    elevation = scanner.elevations(LAYERS)
    piece, distance = walls.fans.first_hits(sensor, RayFan(AZIMUTHS, elevation, scanner.max_range))
    same = piece[..., None] == piece[..., None, :]
    of, ray, layer = np.nonzero((piece >= 0) & (same.argmax(axis=3) == np.arange(len(elevation))))
    at, layers = distance[of, ray, layer], same[of, ray, layer]
    angle = ray * (2 * np.pi / AZIMUTHS)
    reach = distance[:, :, int(np.argmin(np.abs(elevation)))]
    stands_for = 360.0 / scanner.resolution / AZIMUTHS * len(scanner.elevations()) / len(elevation)
    return WallScan(of, ray, at[:, None] * np.column_stack([np.sin(angle), np.cos(angle)]), piece[of, ray, layer],
                    layers, at[:, None] / np.cos(elevation), stands_for * layers.sum(axis=1), reach,
                    np.isfinite(reach).mean(axis=1))
