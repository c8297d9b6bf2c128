"""What all steps of the GNSS part hand to each other: code observations with everything modelled but the clock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields, replace

import numpy as np

SYSTEM_NAMES = {"G": "GPS", "R": "GLONASS", "E": "Galileo", "C": "BeiDou", "J": "QZSS"}
"""Systems by the letter of RINEX."""


@dataclass(frozen=True)
class Epochs:
    """Times at which the receiver measured, in increasing order within each observation file.

    Attributes
    ----------
    time : (e,) seconds in the time of the trajectory.
    gps_time : (e,) seconds since 1980-01-06 in GPS time, as the receiver stamped them.
    place : (e, 3) antenna, east, north, height in the map's CRS and the trajectory's heights, m.
    source : (e,) number of the observation file, from 0.
    """

    time: np.ndarray
    gps_time: np.ndarray
    place: np.ndarray
    source: np.ndarray

    def __len__(self) -> int:
        return len(self.time)


@dataclass(frozen=True)
class Signals:
    """Code observations, one row each; every array has n rows, sorted by epoch.

    A reflected signal arrives late: its residual is the receiver's clock plus the excess path plus noise. The clock
    is common to the signals of one system at one epoch (`receiver_clock.pass_clocks`).

    Attributes
    ----------
    epochs : the e epochs.
    epoch : (n,) row in `epochs`.
    time : (n,) seconds in the time of the trajectory (= epochs.time[epoch]).
    satellite : (n,) names as in RINEX, "G05" (str of 3).
    system : (n,) its first letter (str of 1).
    code : (n,) measured code range, m.
    cn0 : (n,) carrier to noise density, dB-Hz; NaN where the file tells none.
    place : (n, 3) antenna, east, north, height in the map's CRS, m (= epochs.place[epoch]).
    direction : (n, 3) unit vector to the satellite along GRID east, GRID north and up.
    elevation, azimuth : (n,) degrees; azimuth clockwise from GRID north, 0 to 360.
    residual : (n,) code minus range, satellite clock, group delay, troposphere and ionosphere, m: receiver clock,
        excess path and noise remain. Centred so that the median of each file is small (`clock_datum`).
    sigma : (n,) standard deviation expected of a line-of-sight residual (clock aside), m, by strength and elevation.
    troposphere, ionosphere : (n,) delays that were taken off, m: modelled, the ionosphere's measured where it can be.
    age : (n,) seconds between the observation and the reference time of its ephemeris; 0 with precise orbits.
    clock_datum : (files,) m taken off the residuals of each observation file, so that they are small numbers.
    geoid_separation : ellipsoidal minus map height that was used, m.
    geoid_sigma : its standard deviation where it was estimated from the signals, m; NaN where it was given.
    left_out : observations that were not used, counted by reason (a sentence fragment).
    notes : sentences about the files for the user and the report.
    ionosphere_measured : whether the delays of the ionosphere are measured in all files, by satellites whose delays
        between the bands are known, not only modelled.
    """

    epochs: Epochs
    epoch: np.ndarray
    time: np.ndarray
    satellite: np.ndarray
    system: np.ndarray
    code: np.ndarray
    cn0: np.ndarray
    place: np.ndarray
    direction: np.ndarray
    elevation: np.ndarray
    azimuth: np.ndarray
    residual: np.ndarray
    sigma: np.ndarray
    troposphere: np.ndarray
    ionosphere: np.ndarray
    age: np.ndarray
    clock_datum: np.ndarray
    geoid_separation: float
    geoid_sigma: float = float("nan")
    left_out: dict[str, int] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    ionosphere_measured: bool = False

    def __len__(self) -> int:
        return len(self.epoch)

    def raised(self, metres: float) -> Signals:
        """The same signals as if the antenna were higher by so many metres (a correction of the geoid separation).

        Raising the antenna shortens the range to a satellite by metres times the sine of its elevation. `place`
        stays: it is in the heights of the map.
        """
        return replace(self, residual=self.residual + metres * self.direction[:, 2],
                       geoid_separation=self.geoid_separation + metres)


_COLUMNS = ("epoch", "time", "satellite", "system", "code", "cn0", "place", "direction", "elevation", "azimuth",
            "residual", "sigma", "troposphere", "ionosphere", "age")


def join_signals(parts: Sequence[Signals]) -> Signals:
    """Signals of several drives in one, files and epochs numbered on; all must lie in the same CRS.

    Estimated geoid separations are brought to their mean, weighted by their sigmas; given ones stay as they are.
    """
    if len(parts) == 1:
        return parts[0]
    sigmas = np.array([part.geoid_sigma for part in parts])
    separation, sigma = float(np.mean([part.geoid_separation for part in parts])), float("nan")
    if np.isfinite(sigmas).all():
        weights = 1 / np.maximum(sigmas, 0.01) ** 2
        separation = float(np.average([part.geoid_separation for part in parts], weights=weights))
        # What the models of the atmosphere leave is common to all drives: no mean is better than its best part.
        sigma = float(sigmas.min())
        parts = [part.raised(separation - part.geoid_separation) for part in parts]
    first_epoch = np.cumsum([0, *(len(part.epochs) for part in parts)])
    first_file = np.cumsum([0, *(len(part.clock_datum) for part in parts)])
    epochs = Epochs(*(np.concatenate([getattr(part.epochs, item.name) for part in parts]) for item in fields(Epochs)
                      if item.name != "source"),
                    np.concatenate([part.epochs.source + start for part, start in zip(parts, first_file)]))
    columns = {name: np.concatenate([getattr(part, name) for part in parts]) for name in _COLUMNS}
    columns["epoch"] = np.concatenate([part.epoch + start for part, start in zip(parts, first_epoch)])
    left_out: dict[str, int] = {}
    for part in parts:
        for reason, count in part.left_out.items():
            left_out[reason] = left_out.get(reason, 0) + count
    return Signals(epochs, **columns, clock_datum=np.concatenate([part.clock_datum for part in parts]),
                   geoid_separation=separation, geoid_sigma=sigma, left_out=left_out,
                   notes=tuple(note for part in parts for note in part.notes),
                   ionosphere_measured=all(part.ionosphere_measured for part in parts))
