"""What satellites tell of a place among buildings, hidden ones that are received by reflection among them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...gnss.orbits.earth_fixed import MapFrame
from ...gnss.orbits.ephemeris import Navigation
from ...gnss.rays.visibility import SKY_STEP, position_dilution, satellites_above
from ..localisation_settings import LocalisationSettings
from ..walls.wall_map import WallMap

_DOWNWEIGHTED = 0.25
"""Weight that receivers leave to signals whose strength shows that they are reflected."""

_LEAST_CONDITION = 1e-9


@dataclass(frozen=True)
class SkyTimes:
    """When the sky is looked at.

    Attributes
    ----------
    navigation : orbits.
    times : (t,) GPS seconds for all places, or (n, 1) a time for each.
    systems : letters.
    mask : elevation, degrees.
    crs_wkt : of the places.
    shift : GPS seconds less the time of the drive, s; None where places have no times of their own.
    """

    navigation: Navigation
    times: np.ndarray
    systems: str
    mask: float
    crs_wkt: str
    shift: float | None = None

    def with_times(self, time: np.ndarray) -> SkyTimes:
        """The sky over places of a drive at times (n,), s; over others the same as ever."""
        return self if self.shift is None else replace(self, times=(time + self.shift)[:, None])


@dataclass(frozen=True)
class SatellitePlan:
    """Positions by satellites at n places, means over the times.

    Attributes
    ----------
    covariance : (n, 2, 2) m2 of east and north; NaN where no position is fixed at some time.
    satellites : (n,) in line of sight.
    dilution : (n,) PDOP, NaN where none.
    fixed : (n,) share of the times with a position.
    """

    covariance: np.ndarray
    satellites: np.ndarray
    dilution: np.ndarray
    fixed: np.ndarray


def satellite_plan(walls: WallMap, antenna: np.ndarray, sky: SkyTimes, settings: LocalisationSettings) -> SatellitePlan:
    """Accuracy of positions by code ranges at antennas (n, 3).

    Each satellite in line of sight is a range with the sigma of the zenith over the sine of its elevation. A hidden
    one is received by reflection with a share `nlos_share`: it then stands in the solution with a quarter of the
    weight and an excess path of `nlos_delay` m, as an error of its own (see `evidence`).
    """
    frame = MapFrame(sky.crs_wkt)
    count = len(antenna)
    total, fixed = np.zeros((count, 2, 2)), np.zeros(count)
    satellites, dilution = np.zeros(count), np.zeros(count)
    table = np.broadcast_to(sky.times, (count, sky.times.shape[-1]))
    for column in table.T:
        step = np.round(column / SKY_STEP).astype(np.int64)
        for time in np.unique(step):
            rows = np.flatnonzero(step == time)
            names, direction = satellites_above(sky.navigation, frame, antenna[rows[len(rows) // 2]],
                                                time * SKY_STEP, sky.systems, sky.mask)
            system = names.astype("U1")
            free = walls.obstacles.free(np.repeat(antenna[rows], len(names), axis=0),
                                        np.tile(direction, (len(rows), 1))).reshape(len(rows), len(names))
            pdop = position_dilution(direction, system, free)
            good = np.isfinite(pdop)
            total[rows[good]] += _plan_covariance(direction, system, free[good], settings)
            fixed[rows] += good
            satellites[rows] += free.sum(axis=1)
            dilution[rows] += np.where(good, pdop, 0.0)
    times = table.shape[1]
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = total / fixed[:, None, None]
        # Without a position at half of the times there is none to rely on.
        mean[fixed < times / 2] = np.nan
        return SatellitePlan(mean, satellites / times, np.where(fixed > 0, dilution / fixed, np.nan), fixed / times)


def _plan_covariance(direction: np.ndarray, system: np.ndarray, free: np.ndarray, settings: LocalisationSettings
                     ) -> np.ndarray:
    """(n, 2, 2) of east and north, with free satellites (n, s)."""
    letters, number = np.unique(np.where(system == "J", "G", system), return_inverse=True)
    design = np.hstack([-direction, np.eye(len(letters))[number.ravel()]])
    weight = direction[:, 2] ** 2 / settings.code_sigma ** 2
    used = np.where(free, 1.0, settings.nlos_share * _DOWNWEIGHTED) * weight
    signal_weight = np.where(free, weight, settings.nlos_share * (_DOWNWEIGHTED * weight) ** 2
                             * (settings.code_sigma ** 2 + settings.nlos_delay ** 2))
    h = np.einsum("ns,si,sj->nij", used, design, design, optimize=True)
    middle = np.einsum("ns,si,sj->nij", signal_weight, design, design, optimize=True)
    clocks = np.arange(3, design.shape[1])
    h[:, clocks, clocks] += _LEAST_CONDITION
    inverse = np.linalg.inv(h)
    return (inverse @ middle @ inverse)[:, :2, :2]
