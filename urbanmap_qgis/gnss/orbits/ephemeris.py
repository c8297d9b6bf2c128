"""Places and clocks of satellites by broadcast or precise orbits.

Broadcast models by the interface documents: IS-GPS-200 (20.3.3), Galileo OS SIS ICD (5.1), BeiDou B1I ICD (5.2.4.12,
with the inclined frame of the geostationary satellites), GLONASS ICD (A.3.1.2, integrated by Runge and Kutta).
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ...io.files.guard import reads
from ...wording import say
from ..rinex.civil_delays import NO_DELAYS, CivilDelays
from ..rinex.navigation import GlonassRecords, Ionosphere, KeplerRecords, NavigationRecords, read_navigation_files
from ..rinex.observation_file import BESIDE_ONLY
from .earth_fixed import SPEED_OF_LIGHT
from .sp3 import PreciseOrbits, interpolate_orbits, is_sp3, read_sp3

EARTH_ROTATION_RATE = 7.2921151467e-5  # Angular rate of the earth, rad/s (WGS 84).
GLONASS_GRAVITY = 3.9860044e14
GLONASS_RADIUS = 6378136.0
GLONASS_J2 = 1.0826257e-3
GLONASS_ROTATION_RATE = 7.292115e-5
GLONASS_STEP = 60.0

MAX_EPHEMERIS_AGE = {"G": 7500.0, "J": 7500.0, "E": 14400.0, "C": 7500.0, "R": 1830.0}
"""Largest distance in time, s, from an ephemeris's reference time at which it is used."""

OK, NO_EPHEMERIS, UNHEALTHY = 0, 1, 2
"""Status of a satellite at a time."""

_GRAVITY = {"G": 3.986005e14, "J": 3.986005e14, "E": 3.986004418e14, "C": 3.986004418e14}
_ROTATION_RATE = {"G": EARTH_ROTATION_RATE, "J": EARTH_ROTATION_RATE, "E": EARTH_ROTATION_RATE,
                  "C": 7.292115e-5}
_GEOSTATIONARY_TILT = np.radians(-5.0)
_GAMMA = {("G", "2"): (77 / 60) ** 2, ("J", "2"): (77 / 60) ** 2, ("E", "7"): (154 / 118) ** 2,
          ("E", "5"): (154 / 115) ** 2}
_INAV, _FNAV = 512, 256


@dataclass(frozen=True)
class Navigation:
    """Everything known of the satellites.

    Attributes
    ----------
    kepler, glonass : broadcast records.
    precise : SP3 orbits, used before the broadcast ones where they extend.
    ionosphere : coefficients of the files.
    notes : sentences on damage.
    civil : group delays of GPS's and QZSS's civil signals.
    """

    kepler: KeplerRecords
    glonass: GlonassRecords
    precise: tuple[PreciseOrbits, ...]
    ionosphere: tuple[Ionosphere, ...]
    notes: tuple[str, ...]
    civil: CivilDelays = NO_DELAYS

    def satellites(self) -> np.ndarray:
        """Names of all satellites with an orbit."""
        return np.unique(np.concatenate([self.kepler.satellite, self.glonass.satellite,
                                         *(orbits.satellite for orbits in self.precise)]).astype("U3"))

    def span(self) -> tuple[float, float]:
        """First and last GPS time for which there may be an orbit."""
        first, last = [], []
        for names, times in ((self.kepler.satellite, self.kepler.toe), (self.glonass.satellite, self.glonass.toe)):
            if len(times):
                max_age = np.array([MAX_EPHEMERIS_AGE.get(name[0], 0.0) for name in names])
                first.append((times - max_age).min())
                last.append((times + max_age).max())
        for orbits in self.precise:
            first.append(orbits.time[0])
            last.append(orbits.time[-1])
        return float(min(first)), float(max(last))

    def spans(self) -> list[tuple[float, float]]:
        """First and last GPS times of the connected times for which there may be an orbit, that of most records first.

        One record of another day, as receivers write them, so does not make a span of months.
        """
        times = [np.zeros((0, 2))]
        for names, toe in ((self.kepler.satellite, self.kepler.toe), (self.glonass.satellite, self.glonass.toe)):
            max_age = np.array([MAX_EPHEMERIS_AGE.get(name[0], 0.0) for name in names])
            times.append(np.stack([toe - max_age, toe + max_age], axis=1).reshape(-1, 2))
        times += [np.array([[orbits.time[0], orbits.time[-1]]]) for orbits in self.precise]
        records = np.concatenate(times)
        records = records[np.argsort(records[:, 0], kind="stable")]
        reached = np.maximum.accumulate(records[:, 1])
        starts = np.flatnonzero(np.concatenate([[True], records[1:, 0] > reached[:-1]]))
        ends = np.append(starts[1:], len(records))
        most = np.argsort(-(ends - starts), kind="stable")
        return [(float(records[starts[part], 0]), float(reached[ends[part] - 1])) for part in most]

    def covers(self, first: float, last: float) -> bool:
        """Whether any orbit is good for a time between two GPS times."""
        for names, times in ((self.kepler.satellite, self.kepler.toe), (self.glonass.satellite, self.glonass.toe)):
            max_age = np.array([MAX_EPHEMERIS_AGE.get(name[0], 0.0) for name in names])
            if np.any((times + max_age >= first) & (times - max_age <= last)):
                return True
        return any(orbits.time[-1] >= first and orbits.time[0] <= last for orbits in self.precise)


@dataclass(frozen=True)
class SatelliteStates:
    """Of n satellites, each at its own time.

    Attributes
    ----------
    place : (n, 3) earth-fixed at that time, m; NaN where the status is not `OK`.
    clock : (n,) s ahead of GPS time, with the relativity of the orbit, without group delay.
    delay : (n,) group delay of the signal's band, s: the clock of the signal is `clock - delay`.
    second_delay : (n,) group delay of the system's second band less that of the first, s; NaN where none is broadcast.
    age : (n,) s from the ephemeris's reference time; 0 with precise orbits.
    status : (n,) `OK`, `NO_EPHEMERIS` or `UNHEALTHY`.
    """

    place: np.ndarray
    clock: np.ndarray
    delay: np.ndarray
    second_delay: np.ndarray
    age: np.ndarray
    status: np.ndarray


@reads("navigation files")
def read_navigation(paths: Sequence[str | os.PathLike]) -> Navigation:
    """Read navigation files (RINEX 2.11, 3.x) and precise orbits (SP3), in any mixture.

    Raises
    ------
    InputError : no file, or one that is neither.
    """
    if not paths:
        raise InputError(say("No navigation file is given: give the satellites' navigation files of the day."))
    precise = [path for path in paths if is_sp3(path)]
    records: NavigationRecords = read_navigation_files([path for path in paths if path not in precise])
    return Navigation(records.kepler, records.glonass, tuple(read_sp3(path) for path in precise), records.ionosphere,
                      records.notes, records.civil)


def satellite_states(navigation: Navigation, satellite: np.ndarray, time: np.ndarray,
                     bands: dict[str, str] | None = None,
                     second_bands: dict[str, str] | None = None) -> SatelliteStates:
    """States of satellites (n,) at GPS times of transmission (n,).

    Parameters
    ----------
    bands : RINEX band of each system's signals, for the group delay; without it the first of each system.
    second_bands : those of a second signal, for the difference of the two group delays.

    Of several records of a satellite the one nearest in time is taken; an unhealthy satellite is told as such.
    """
    satellite, time = np.asarray(satellite, "U3"), np.asarray(time, float)
    bands = bands or {"G": "1", "R": "1", "E": "1", "C": "2", "J": "1"}
    count = len(satellite)
    states = SatelliteStates(np.full((count, 3), np.nan), np.full(count, np.nan), np.zeros(count),
                             np.full(count, np.nan), np.zeros(count), np.full(count, NO_EPHEMERIS))
    _from_kepler(navigation.kepler, satellite, time, bands, second_bands or {}, states)
    _with_civil_delays(navigation.civil, satellite, time, bands, second_bands or {}, states)
    _from_glonass(navigation.glonass, satellite, time, states)
    for orbits in navigation.precise:
        _from_precise(orbits, satellite, time, states)
    return states


def nearest_record(names: np.ndarray, toe: np.ndarray, satellite: np.ndarray, time: np.ndarray,
                   better: np.ndarray | None = None) -> np.ndarray:
    """(n,) row of the record nearest in time for each satellite and time, -1 where none is near enough.

    Parameters
    ----------
    names, toe : (m,) of the records.
    better : (m,) among records of one time the highest wins.
    """
    chosen = np.full(len(satellite), -1)
    for name in np.unique(satellite):
        candidates = np.flatnonzero(names == name)
        if not len(candidates):
            continue
        order = np.lexsort((np.zeros(len(candidates)) if better is None else better[candidates], toe[candidates]))
        candidates = candidates[order]
        last = np.append(np.diff(toe[candidates]) > 0.5, True)
        candidates = candidates[last]
        rows = np.flatnonzero(satellite == name)
        right = np.searchsorted(toe[candidates], time[rows])
        left, right = np.maximum(right - 1, 0), np.minimum(right, len(candidates) - 1)
        nearer = np.abs(toe[candidates[right]] - time[rows]) < np.abs(toe[candidates[left]] - time[rows])
        pick = candidates[np.where(nearer, right, left)]
        near = np.abs(toe[pick] - time[rows]) <= MAX_EPHEMERIS_AGE[name[0]]
        chosen[rows[near]] = pick[near]
    return chosen


def _from_kepler(records: KeplerRecords, satellite: np.ndarray, time: np.ndarray, bands: dict[str, str],
                 second_bands: dict[str, str], states: SatelliteStates) -> None:
    better = _galileo_preference(records, bands.get("E", "1"))
    row = nearest_record(records.satellite, records.toe, satellite, time, better)
    found = np.flatnonzero(row >= 0)
    if not len(found):
        return
    picked = KeplerRecords(*(getattr(records, name)[row[found]] for name in KeplerRecords.__dataclass_fields__))
    healthy = _healthy(picked)
    states.status[found] = np.where(healthy, OK, UNHEALTHY)
    place, clock = kepler_states(picked, time[found])
    states.place[found] = np.where(healthy[:, None], place, np.nan)
    states.clock[found] = clock
    states.delay[found] = _group_delay(picked, bands)
    states.second_delay[found] = _delay_between(picked, bands, second_bands)
    states.age[found] = np.abs(time[found] - picked.toe)


def _galileo_preference(records: KeplerRecords, band: str) -> np.ndarray:
    """Which of Galileo's two messages goes with a band: F/NAV with E5a, otherwise I/NAV."""
    wanted = _FNAV if band == "5" else _INAV
    return (records.source.astype(np.int64) & wanted) > 0


def _healthy(records: KeplerRecords) -> np.ndarray:
    system = records.satellite.astype("U1")
    health = records.health.astype(np.int64)
    # Galileo: bits 0 to 2 for E1-B, 3 to 5 for E5a, 6 to 8 for E5b; QZSS: bit 0 is the experimental L6 signal.
    return np.where(system == "E", health & 0b111000111 == 0, np.where(system == "J", health & ~1 == 0, health == 0))


def _group_delay(records: KeplerRecords, bands: dict[str, str]) -> np.ndarray:
    system = records.satellite.astype("U1")
    delay = np.zeros(len(records))
    for name in np.unique(system):
        band = bands.get(name, "1")
        of_system = system == name
        scale = _GAMMA.get((name, band), 1.0)
        if name == "E":
            fnav = records.source.astype(np.int64)[of_system] & _FNAV > 0
            delay[of_system] = scale * np.where(fnav, records.delay_a[of_system], records.delay_b[of_system])
        elif name == "C":
            delay[of_system] = {"2": records.delay_a[of_system], "7": records.delay_b[of_system]}.get(band, 0.0)
        else:
            delay[of_system] = scale * records.delay_a[of_system]
    return delay


def kepler_states(records: KeplerRecords, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3), m, and clocks with relativity (n,), s, of records (n,) at GPS times (n,)."""
    system = records.satellite.astype("U1")
    gravity, rate = (np.array([table[name] for name in system]) for table in (_GRAVITY, _ROTATION_RATE))
    since = time - records.toe
    major = records.sqrt_a ** 2
    mean = records.m0 + (np.sqrt(gravity / major ** 3) + records.delta_n) * since
    eccentric = _eccentric_anomaly(mean, records.e)
    true = np.arctan2(np.sqrt(1 - records.e ** 2) * np.sin(eccentric), np.cos(eccentric) - records.e)
    latitude = true + records.omega
    cos2, sin2 = np.cos(2 * latitude), np.sin(2 * latitude)
    argument = latitude + records.cuc * cos2 + records.cus * sin2
    radius = major * (1 - records.e * np.cos(eccentric)) + records.crc * cos2 + records.crs * sin2
    tilt = records.i0 + records.i_dot * since + records.cic * cos2 + records.cis * sin2
    still = _geostationary(records.satellite)
    node = records.omega0 + records.omega_dot * since - rate * (records.toe_own + np.where(still, 0.0, since))
    x, y = radius * np.cos(argument), radius * np.sin(argument)
    place = np.column_stack([x * np.cos(node) - y * np.cos(tilt) * np.sin(node),
                             x * np.sin(node) + y * np.cos(tilt) * np.cos(node), y * np.sin(tilt)])
    if still.any():
        place[still] = _rotated_geostationary(place[still], rate[still] * since[still])
    tick = time - records.toc
    relativity = -2 * np.sqrt(gravity * major) * records.e * np.sin(eccentric) / SPEED_OF_LIGHT ** 2
    return place, records.af0 + records.af1 * tick + records.af2 * tick ** 2 + relativity


def _eccentric_anomaly(mean: np.ndarray, e: np.ndarray) -> np.ndarray:
    eccentric = mean + e * np.sin(mean)
    for _ in range(12):
        step = (eccentric - e * np.sin(eccentric) - mean) / (1 - e * np.cos(eccentric))
        eccentric = eccentric - step
        if np.abs(step).max(initial=0.0) < 1e-14:
            break
    return eccentric


def _geostationary(satellite: np.ndarray) -> np.ndarray:
    """Whether satellites are BeiDou's geostationary ones, whose elements are given in a tilted frame."""
    return np.isin(satellite, [f"C{number:02d}" for number in (*range(1, 6), *range(59, 64))])


def _rotated_geostationary(place: np.ndarray, angle: np.ndarray) -> np.ndarray:
    cos, sin = np.cos(_GEOSTATIONARY_TILT), np.sin(_GEOSTATIONARY_TILT)
    x, y, z = place[:, 0], cos * place[:, 1] + sin * place[:, 2], -sin * place[:, 1] + cos * place[:, 2]
    return np.column_stack([np.cos(angle) * x + np.sin(angle) * y, -np.sin(angle) * x + np.cos(angle) * y, z])


def _from_glonass(records: GlonassRecords, satellite: np.ndarray, time: np.ndarray, states: SatelliteStates) -> None:
    row = nearest_record(records.satellite, records.toe, satellite, time)
    found = np.flatnonzero(row >= 0)
    if not len(found):
        return
    picked = GlonassRecords(*(getattr(records, name)[row[found]] for name in GlonassRecords.__dataclass_fields__))
    healthy = picked.health == 0
    states.status[found] = np.where(healthy, OK, UNHEALTHY)
    place, clock = glonass_states(picked, time[found])
    states.place[found] = np.where(healthy[:, None], place, np.nan)
    states.clock[found] = clock
    states.age[found] = np.abs(time[found] - picked.toe)


def glonass_states(records: GlonassRecords, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 3), m, and clocks (n,), s, of records (n,) at GPS times (n,).

    Integrated by Runge and Kutta of order 4 in steps of a minute at most. The broadcast clock holds relativity already.
    """
    since = time - records.toe
    steps = max(int(np.ceil(np.abs(since).max(initial=0.0) / GLONASS_STEP)), 1)
    step = (since / steps)[:, None]
    state = np.hstack([records.place, records.velocity])
    for _ in range(steps):
        k1 = _glonass_motion(state, records.acceleration)
        k2 = _glonass_motion(state + step / 2 * k1, records.acceleration)
        k3 = _glonass_motion(state + step / 2 * k2, records.acceleration)
        k4 = _glonass_motion(state + step * k3, records.acceleration)
        state = state + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return state[:, :3], records.clock + records.drift * since


def _glonass_motion(state: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
    """Velocity and acceleration (n, 6) in the rotating frame: the earth's attraction with its flattening, sun and
    moon."""
    place, velocity = state[:, :3], state[:, 3:]
    squared = np.einsum("ij,ij->i", place, place)
    gravity = -GLONASS_GRAVITY / squared ** 1.5
    flat = 1.5 * GLONASS_J2 * GLONASS_GRAVITY * GLONASS_RADIUS ** 2 / squared ** 2.5
    share = 5 * place[:, 2] ** 2 / squared
    rate = GLONASS_ROTATION_RATE
    x = (gravity - flat * (1 - share) + rate ** 2) * place[:, 0] + 2 * rate * velocity[:, 1]
    y = (gravity - flat * (1 - share) + rate ** 2) * place[:, 1] - 2 * rate * velocity[:, 0]
    z = (gravity - flat * (3 - share)) * place[:, 2]
    return np.hstack([velocity, np.column_stack([x, y, z]) + acceleration])


def _delay_between(records: KeplerRecords, bands: dict[str, str], second_bands: dict[str, str]) -> np.ndarray:
    """(n,) group delay of the second band less that of the first, s; NaN for systems without a second band.

    Broadcast delays are those of the first band against the combination that the clock is for, and grow with the
    square of the wave's length (IS-GPS-200, 20.3.3.3.3.2; Galileo OS SIS ICD, 5.1.5); BeiDou's are against B3.
    """
    system = records.satellite.astype("U1")
    between = np.full(len(records), np.nan)
    for name, second in second_bands.items():
        of_system = np.flatnonzero(system == name)
        first, one, other = bands[name], records.delay_a[of_system], records.delay_b[of_system]
        if name == "C":
            delays = {"2": one, "7": other, "6": 0.0}
            between[of_system] = delays[second] - delays[first]
        elif name == "E":
            # Delays of E5a and of E5b against E1, whichever message the clock comes from.
            delays = {"1": 0.0, "5": (_GAMMA["E", "5"] - 1) * one, "7": (_GAMMA["E", "7"] - 1) * other}
            between[of_system] = delays[second] - delays[first]
        elif (name, "2") in _GAMMA and "5" not in (first, second):
            between[of_system] = (_GAMMA[name, "2"] - 1) * one * (1 if second == "2" else -1)
    return between


def _with_civil_delays(civil: CivilDelays, satellite: np.ndarray, time: np.ndarray, bands: dict[str, str],
                       second_bands: dict[str, str], states: SatelliteStates) -> None:
    """Group delays of the first band and of L5 beside it where CNAV tells them: T_GD less the signal's own correction,
    so that the two without the ionosphere make the range of IS-GPS-705, 20.3.3.3.1.2.2."""
    with_five = [name for name, second in second_bands.items() if second == BESIDE_ONLY.get(name)]
    rows = np.flatnonzero(np.isin(satellite.astype("U1"), with_five))
    if not len(rows) or not len(civil.satellite):
        return
    row = nearest_record(civil.satellite, civil.time, satellite[rows], time[rows])
    rows, row = rows[row >= 0], row[row >= 0]
    on_second = np.array([bands[name[0]] == "2" for name in satellite[rows]], bool)
    first = civil.tgd[row] - np.where(on_second, civil.isc_l2c[row], civil.isc_l1ca[row])
    between = civil.tgd[row] - civil.isc_l5[row] - first
    told = np.isfinite(between) & (states.status[rows] == OK)
    states.delay[rows[told]], states.second_delay[rows[told]] = first[told], between[told]


def _from_precise(orbits: PreciseOrbits, satellite: np.ndarray, time: np.ndarray, states: SatelliteStates) -> None:
    """Replace what precise orbits know better; group delays stay those of the navigation files."""
    row = np.searchsorted(orbits.satellite, satellite)
    row = np.minimum(row, len(orbits.satellite) - 1)
    covered = np.flatnonzero((orbits.satellite[row] == satellite) & (states.status != UNHEALTHY))
    if not len(covered):
        return
    place, clock = interpolate_orbits(orbits, row[covered], time[covered])
    (before, _), (after, _) = (interpolate_orbits(orbits, row[covered], time[covered] + shift) for shift in (-0.5, 0.5))
    speed = np.where(np.isfinite(before) & np.isfinite(after), after - before, 0.0)
    clock = clock - 2 * np.einsum("ij,ij->i", place, speed) / SPEED_OF_LIGHT ** 2
    good = np.isfinite(clock) & np.isfinite(place).all(axis=1) & (speed != 0).any(axis=1)
    covered = covered[good]
    states.place[covered], states.clock[covered] = place[good], clock[good]
    states.age[covered], states.status[covered] = 0.0, OK


@dataclass(frozen=True)
class GeometricRanges:
    """Geometric ranges of n signals from satellite to antenna.

    Attributes
    ----------
    states : of the satellites at transmission.
    vector : (n, 3) from the antenna to the satellite in the earth-fixed frame of the time of reception, m.
    distance : (n,) m.
    """

    states: SatelliteStates
    vector: np.ndarray
    distance: np.ndarray


def geometric_ranges(navigation: Navigation, satellite: np.ndarray, stamped: np.ndarray, code: np.ndarray,
                     antenna: np.ndarray, bands: dict[str, str] | None = None,
                     second_bands: dict[str, str] | None = None) -> GeometricRanges:
    """Ranges of signals (n,) from the times that their codes tell.

    Parameters
    ----------
    stamped : (n,) GPS time of reception by the receiver's clock, s.
    code : (n,) m. The time stamp less the code's travel time is the time of transmission by the satellite's
        clock, free of the receiver's clock.
    antenna : (n, 3) earth-fixed, m.
    """
    sent = np.asarray(stamped, float) - np.asarray(code, float) / SPEED_OF_LIGHT
    states = satellite_states(navigation, satellite, sent, bands)
    offset = np.where(np.isfinite(states.clock), states.clock - states.delay, 0.0)
    states = satellite_states(navigation, satellite, sent - offset, bands, second_bands)
    vector, distance = sagnac_corrected(states.place, antenna)
    return GeometricRanges(states, vector, distance)


def sagnac_corrected(place: np.ndarray, antenna: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vectors (n, 3) and distances (n,) from the antenna to satellites, with the rotation of the earth during
    the travel (Sagnac effect)."""
    distance = np.linalg.norm(place - antenna, axis=1)
    for _ in range(2):
        angle = EARTH_ROTATION_RATE * distance / SPEED_OF_LIGHT
        cos, sin = np.cos(angle), np.sin(angle)
        rotated = np.column_stack([cos * place[:, 0] + sin * place[:, 1], -sin * place[:, 0] + cos * place[:, 1],
                                   place[:, 2]])
        vector = rotated - antenna
        distance = np.linalg.norm(vector, axis=1)
    return vector, distance


def sky_at(navigation: Navigation, time: float, antenna: np.ndarray, systems: str) -> tuple[np.ndarray, np.ndarray]:
    """Healthy satellites at one GPS time: names (s,) and vectors (s, 3) to them from an earth-fixed place (3,), m."""
    names = navigation.satellites()
    names = names[np.isin(names.astype("U1"), list(systems))]
    # The travel time changes the direction by less than 0.001 degree over the sky: one value does for all.
    states = satellite_states(navigation, names, np.full(len(names), time - 0.075))
    good = states.status == OK
    vector, _ = sagnac_corrected(states.place[good], np.broadcast_to(antenna, (int(good.sum()), 3)))
    return names[good], vector
