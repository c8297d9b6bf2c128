"""Scans as a vehicle would take them in the true city: noise, vehicles and trees in the way (J 6.2)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..gnss.rays.tracing import WallObstacles
from ..gnss.rays.wall_faces import WallPieces
from .localisation_settings import VehicleScanner

_TRUCK, _CAR = (8.0, 2.5, 3.2), (4.5, 1.8, 1.5)
_TRUNK, _CROWN = (0.35, 0.35, 7.0), (4.0, 4.0, 4.0)
_CROWN_FOOT = 3.0
_THROUGH_CROWN = 0.3
_ALONG = 35.0
_HIDDEN_BY_ONE = {"2D": 0.08, "multi-layer": 0.18}
"""What the usual number of vehicles and trees hides, -log(1 - share): means over the sample city."""

_LANES, _PAVEMENT = (2.8, 6.0), (6.0, 9.0)


@dataclass(frozen=True)
class SimulatedScan:
    """Points of one scan, from the sensor, in the map's directions.

    Attributes
    ----------
    offset : (m, 3) m.  hidden : share of the rays to walls that vehicles or trees stopped.
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
    clutter = -np.log(1.0 - scanner.hidden) / _HIDDEN_BY_ONE[scanner.kind]
    direction = ray_directions(scanner, azimuths)
    count = len(direction)
    _, distance = truth.first_hit(np.repeat(sensor, count, axis=0), np.tile(direction, (len(sensor), 1)),
                                  scanner.max_range)
    made = []
    with np.errstate(divide="ignore"):
        ground = np.where(direction[:, 2] < 0, -scanner.height / direction[:, 2], np.inf)
    for reach, ahead in zip(distance.reshape(len(sensor), count), heading):
        wall = np.isfinite(reach)
        reach = np.minimum(reach, ground)
        stopped = _clutter_reach(direction, ahead, scanner.height, rng, clutter)
        hidden = float((stopped[wall] < reach[wall]).mean()) if wall.any() else 0.0
        reach = np.minimum(reach, stopped)
        hit = np.flatnonzero(reach < scanner.max_range)
        measured = reach[hit] + rng.normal(0.0, scanner.noise, len(hit))
        made.append(SimulatedScan(direction[hit] * measured[:, None], hidden))
    return made


def _clutter_reach(direction: np.ndarray, heading: float, height: float, rng: np.random.Generator, clutter: float
                   ) -> np.ndarray:
    """(rays,) m to the first vehicle or tree, inf where there is none."""
    reach = np.full(len(direction), np.inf)
    ahead = direction[:, 0] * np.sin(heading) + direction[:, 1] * np.cos(heading)
    right = direction[:, 0] * np.cos(heading) - direction[:, 1] * np.sin(heading)
    local = np.column_stack([ahead, right, direction[:, 2]])
    for size, foot, sides, usual in ((_TRUCK, 0.0, _LANES, 0.7), (_CAR, 0.0, _LANES, 6.3),
                                     (_TRUNK, 0.0, _PAVEMENT, 5.0), (_CROWN, _CROWN_FOOT, _PAVEMENT, 5.0)):
        for _ in range(rng.poisson(usual * clutter)):
            middle = np.array([rng.uniform(-_ALONG, _ALONG), rng.choice([-1, 1]) * rng.uniform(*sides),
                               foot + size[2] / 2 - height])
            enter, leave = _through_box(local, middle, np.array(size))
            met = enter < leave
            if foot > 0:
                # Crowns are porous: some rays pass, others end within.
                met &= rng.random(len(enter)) > _THROUGH_CROWN
                enter = enter + rng.random(len(enter)) * np.where(met, leave - enter, 0.0)
            reach = np.where(met & (enter > 0.5), np.minimum(reach, enter), reach)
    return reach


def _through_box(direction: np.ndarray, middle: np.ndarray, size: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where rays from the origin enter and leave a box, m; enter is beyond leave where they miss it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (middle - size / 2) / direction, (middle + size / 2) / direction
    low, high = np.fmin(one, other), np.fmax(one, other)
    return low.max(axis=1), high.min(axis=1)
