"""Scans as a vehicle would take them in the true city: noise, vehicles and trees in the way (J 6.2)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...gnss.rays.tracing import WallObstacles
from ...gnss.rays.wall_faces import WallPieces
from ..localisation_settings import VehicleScanner
from ..walls.clutter import clutter_reach


@dataclass(frozen=True)
class SimulatedScan:
    """Points of one scan, from the sensor, in the map's directions.

    Attributes
    ----------
    offset : (m, 3) m.
    hidden : share of the rays to walls that vehicles or trees stopped.
    """

    offset: np.ndarray
    hidden: float


def displaced(walls: WallPieces, sigma: np.ndarray, rng: np.random.Generator, common: float = 0.0) -> WallPieces:
    """A true city that the map may stand for: every wall moved along its normal by its sigma (walls,), m, and every
    building by `common` m, east and north."""
    offset = rng.normal(0.0, 1.0, len(sigma)) * sigma
    moved = offset[walls.wall, None] * walls.normal
    if common > 0:
        moved = moved + rng.normal(0.0, common, (int(walls.building.max()) + 1, 2))[walls.building]
    return replace(walls, start=walls.start + moved, end=walls.end + moved,
                   offset=walls.offset + np.einsum("ij,ij->i", moved, walls.normal))


def ray_directions(scanner: VehicleScanner, azimuths: int) -> np.ndarray:
    """Unit vectors (rays, 3) of a scan, layer by layer."""
    angle = np.arange(azimuths) * 2 * np.pi / azimuths
    up, round_ = (values.ravel() for values in np.meshgrid(scanner.elevations(), angle, indexing="ij"))
    return np.column_stack([np.cos(up) * np.sin(round_), np.cos(up) * np.cos(round_), np.sin(up)])


def simulated_scans(truth: WallObstacles, sensor: np.ndarray, heading: np.ndarray, scanner: VehicleScanner,
                    azimuths: int, rng: np.random.Generator) -> list[SimulatedScan]:
    """Scans from sensors (n, 3) on vehicles with headings (n,), radians, over a level road.

    There are as many vehicles and trees that they hide about the share of the rays that the scanner's settings say.
    """
    direction = ray_directions(scanner, azimuths)
    count = len(direction)
    _, distance = truth.first_hit(np.repeat(sensor, count, axis=0), np.tile(direction, (len(sensor), 1)),
                                  scanner.max_range)
    scans = []
    with np.errstate(divide="ignore"):
        ground = np.where(direction[:, 2] < 0, -scanner.height / direction[:, 2], np.inf)
    for reach, ahead in zip(distance.reshape(len(sensor), count), heading):
        wall = np.isfinite(reach)
        reach = np.minimum(reach, ground)
        stopped = clutter_reach(direction, ahead, scanner, rng)
        hidden = float((stopped[wall] < reach[wall]).mean()) if wall.any() else 0.0
        reach = np.minimum(reach, stopped)
        hit = np.flatnonzero(reach < scanner.max_range)
        measured = reach[hit] + rng.normal(0.0, scanner.noise, len(hit))
        scans.append(SimulatedScan(direction[hit] * measured[:, None], hidden))
    return scans
