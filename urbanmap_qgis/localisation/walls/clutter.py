"""Vehicles and trees around a vehicle, which hide walls from its scanner."""

from __future__ import annotations

import numpy as np

from ..localisation_settings import VehicleScanner

PATTERNS = 16  # Arrangements of vehicles and trees over which the prediction is the mean.
TRUCK = (8.0, 2.5, 3.2)
CAR = (4.5, 1.8, 1.5)
TRUNK = (0.35, 0.35, 7.0)
CROWN = (4.0, 4.0, 4.0)
CROWN_FOOT = 3.0
THROUGH_CROWN = 0.3
ALONG = 35.0
LANES = (2.8, 6.0)
PAVEMENT = (6.0, 9.0)

_HIDDEN_BY_ONE = {"2D": 0.08, "multi-layer": 0.18}
"""What the usual number of vehicles and trees hides, -log(1 - share): means over the sample city."""


def clutter_patterns(scanner: VehicleScanner, elevation: np.ndarray, azimuths: int) -> np.ndarray:
    """(patterns, layers, azimuths) m to the first vehicle or tree, azimuths clockwise from the heading."""
    angle = np.arange(azimuths) * 2 * np.pi / azimuths
    up, round_ = (values.ravel() for values in np.meshgrid(elevation, angle, indexing="ij"))
    direction = np.column_stack([np.cos(up) * np.sin(round_), np.cos(up) * np.cos(round_), np.sin(up)])
    reaches = [clutter_reach(direction, 0.0, scanner, np.random.default_rng([7, number]))
               for number in range(PATTERNS)]
    return np.stack(reaches).reshape(PATTERNS, len(elevation), azimuths)


def clutter_reach(direction: np.ndarray, heading: float, scanner: VehicleScanner, rng: np.random.Generator
                  ) -> np.ndarray:
    """(rays,) m along rays (rays, 3) to the first vehicle or tree around a vehicle, inf where there is none.

    There are as many as hide about the share of the rays that the scanner's settings say. `heading` in radians.
    """
    amount = -np.log(1.0 - scanner.hidden) / _HIDDEN_BY_ONE[scanner.kind]
    reach = np.full(len(direction), np.inf)
    ahead = direction[:, 0] * np.sin(heading) + direction[:, 1] * np.cos(heading)
    right = direction[:, 0] * np.cos(heading) - direction[:, 1] * np.sin(heading)
    local = np.column_stack([ahead, right, direction[:, 2]])
    for size, foot, sides, usual in ((TRUCK, 0.0, LANES, 0.7), (CAR, 0.0, LANES, 6.3),
                                     (TRUNK, 0.0, PAVEMENT, 5.0),
                                     (CROWN, CROWN_FOOT, PAVEMENT, 5.0)):
        for _ in range(rng.poisson(usual * amount)):
            middle = np.array([rng.uniform(-ALONG, ALONG), rng.choice([-1, 1]) * rng.uniform(*sides),
                               foot + size[2] / 2 - scanner.height])
            enter, leave = _through_box(local, middle, np.array(size))
            met = enter < leave
            if foot > 0:
                # Crowns are porous: some rays pass, others end within.
                met &= rng.random(len(enter)) > THROUGH_CROWN
                enter = enter + rng.random(len(enter)) * np.where(met, leave - enter, 0.0)
            reach = np.where(met & (enter > 0.5), np.minimum(reach, enter), reach)
    return reach


def _through_box(direction: np.ndarray, middle: np.ndarray, size: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where rays from the origin enter and leave a box, m; enter is beyond leave where they miss it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (middle - size / 2) / direction, (middle + size / 2) / direction
    low, high = np.fmin(one, other), np.fmax(one, other)
    return low.max(axis=1), high.min(axis=1)
