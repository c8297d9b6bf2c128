"""What walls across the street say of the pitch: they stand upright, and a pitch that is off leans them.

The points of a scanner lie in one line ahead of the vehicle, so that road and markings hardly tell the pitch. A wall
that faces the drive is scanned from top to foot while the vehicle comes nearer: a wrong pitch leans it by as much, and
so does what the trajectory drifts along its normal meanwhile, which the correction knows and which is taken out. Walls
along the street lean with the roll, which the ground tells better.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ....estimation.held_observations import HeldObservations
from ....geometry.tolerances import SIGMA_OF_MAD
from .facade_planes import FacadePlanes, own_walls


@dataclass(frozen=True)
class UprightWallsLimits:
    """Limits of upright walls, each with its unit."""

    across: float = 0.5  # of the pitch that leans a wall, at least
    fewest: int = 6  # planes of a wall
    walls: int = 4  # from which it can be told how far they stand out of plumb
    # degrees by which walls stand out of plumb: least, and where too few are seen
    plumb: tuple[float, float] = (0.1, 0.3)
    plane: float = 0.2  # degrees, of a single plane at least
    soft: float = 2.5  # standard deviations from which a plane and a wall lose weight
    step: float = 2.0  # m of path over which the correction's drift is taken


LIMITS = UprightWallsLimits()

_PITCH = 4


@dataclass(frozen=True)
class UprightWalls:
    """Planes of walls across the street.

    Attributes
    ----------
    planes : (n,) of them.
    rate : (n, 6) radians by which each parameter of a correction leans them.
    wall : (n,) number of each plane's wall, from 0.
    """

    planes: FacadePlanes
    rate: np.ndarray
    wall: np.ndarray

    @classmethod
    def among(cls, planes: FacadePlanes) -> UprightWalls | None:
        """Those of a survey's facades; None where none stands across."""
        if planes.tilt is None:
            return None
        east, north = planes.normal.T
        rate = north[:, None] * planes.back[:, 3, :] - east[:, None] * planes.back[:, 4, :]
        across = np.abs(np.degrees(rate[:, _PITCH])) >= LIMITS.across
        planes, rate = planes.select(across), rate[across]
        wall = own_walls(planes.place[:, :2], planes.normal, planes.place[:, 2])
        many = np.bincount(wall)[wall] >= LIMITS.fewest if len(wall) else across[:0]
        if not many.any():
            return None
        return cls(planes.select(many), rate[many], np.unique(wall[many], return_inverse=True)[1].ravel())

    def about(self, curve: Callable[[np.ndarray], np.ndarray], active: Sequence[int]) -> HeldObservations:
        """Their leans, radians, as distances that the pitch among the parameters `active` takes out, about a curve.

        A plane counts by its scatter and its wall's: all planes of a wall share what that stands out of plumb, which is
        found from how walls differ. What the curve (m, 6) at path parameters (m,) says of the drift and the other
        angles is taken for known: walls off plumb must not turn the roll, which the ground tells.
        """
        planes, parameters = self.planes, np.array(active)
        change = curve(planes.path_parameter)
        pitch = np.where(np.arange(change.shape[1]) == _PITCH, self.rate, 0.0)
        target = self._drift(curve) - planes.tilt - ((self.rate - pitch) * change).sum(axis=1)
        weight = _weights(target - (pitch * change).sum(axis=1), self.rate[:, _PITCH], self.wall)
        return HeldObservations(planes.path_parameter, pitch[:, parameters], target, weight, 0.0, (0.0, 1.0))

    def _drift(self, curve: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
        """(n,) radians by which the change of a correction leans planes while they are scanned from below upwards."""
        planes = self.planes
        ends = [curve(planes.path_parameter + 0.5 * side * LIMITS.step)[:, :2] for side in (-1, 1)]
        return (planes.normal * (ends[1] - ends[0])).sum(axis=1) / LIMITS.step * planes.sweep


def _weights(off: np.ndarray, rate: np.ndarray, wall: np.ndarray) -> np.ndarray:
    """(n,) 1 / radian2, of planes that lean by `off` (n,) radians, the pitch's rate (n,), walls numbered from 0 (n,).
    """
    left = off - rate * np.median(off / rate)
    plane = max(np.radians(LIMITS.plane), SIGMA_OF_MAD * float(np.median(np.abs(left))))
    trust = 1.0 / (1.0 + (left / (LIMITS.soft * plane)) ** 2) ** 2
    count = np.bincount(wall, trust)
    lean = np.bincount(wall, trust * left) / count
    least, unknown = np.radians(LIMITS.plumb)
    plumb = max(least, SIGMA_OF_MAD * float(np.median(np.abs(lean)))) if len(lean) >= LIMITS.walls else unknown
    trusted = 1.0 / (1.0 + (lean / (LIMITS.soft * plumb)) ** 2) ** 2
    return trust * (trusted / (plane**2 + count * plumb**2))[wall]
