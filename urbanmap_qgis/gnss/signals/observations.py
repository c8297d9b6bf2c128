"""From observation and navigation files and a trajectory to signals: code residuals with all known terms taken off.

A code range is the geometric range (with the rotation of the earth during the travel), plus the receiver's clock, minus
the satellite's clock, plus group delay, troposphere, ionosphere, excess path of a reflection, and noise (J 5.6).
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...geometry.grouped_median import grouped_median
from ...mobile.gps_time import ADJUSTMENT, WEEK
from ...mobile.trajectory import Trajectory, body_to_map, gaps
from ...progress import SILENT, Progress
from ...settings.gnss import SignalSettings
from ...wording import say
from ..orbits.earth_fixed import SPEED_OF_LIGHT, EarthPlaces, MapFrame, directions, elevation_azimuth
from ..orbits.ephemeris import (
    NO_EPHEMERIS,
    UNHEALTHY,
    Navigation,
    SatelliteStates,
    geometric_ranges,
    read_navigation,
    sagnac_corrected,
)
from ..rinex.gnss_time import UNIX_START, leap_seconds, span_text, spans_text
from ..rinex.observation_file import BESIDE_ONLY, Observations, read_observations
from .antenna_height import estimate_height, strong_scatter, strong_signals
from .atmosphere import ionosphere, nearest_model, troposphere
from .measured_ionosphere import MeasuredIonosphere, TwoBands, layer_mapping, measure_ionosphere
from .tables import SYSTEM_NAMES, Epochs, Signals

# Heights that differ from what the satellites say by more than this, m, are taken for a mix-up of heights; by more
# where the ionosphere is only modelled, as what the model leaves of a vertical delay (up to once the model's at the
# solar maximum) moves the height by so many times as much.
HEIGHT_LIMIT = 12.0
HEIGHT_BY_DELAY = 3.0
LARGEST_SEPARATION = 120.0  # The geoid is nowhere farther from the ellipsoid, m.
# Scatter of the strongest signals, m: up to which no other time is tried, that is told, and that is refused.
USUAL_SCATTER = 1.5
WIDE_SCATTER = 5.0
LARGEST_SCATTER = 30.0
GLONASS_FACTOR = 1.5
GLONASS_CHANNEL = 2.5
NO_CN0 = 38.0
MODEL_ERROR = 0.3  # Share of the delay by which the ionosphere's model is off.


def load_observations(observation_paths: Sequence[str | os.PathLike], navigation_paths: Sequence[str | os.PathLike],
                      trajectory: Trajectory, crs_wkt: str, geoid_separation: float | None = None,
                      settings: SignalSettings | None = None, progress: Progress = SILENT) -> Signals:
    """Read observations and model everything but the receiver's clock.

    Parameters
    ----------
    observation_paths : RINEX 2.11 or 3.x observation files, each of one receiver on the trajectory.
    navigation_paths : RINEX navigation files and SP3 orbits that cover them.
    trajectory : times in seconds of GPS week, full GPS seconds, adjusted standard GPS time or Unix time.
    crs_wkt : of the trajectory's places.
    geoid_separation : ellipsoidal less map height, m, 0 where the trajectory has ellipsoidal heights. None: it is
        estimated from the signals (with an antenna height the trajectory does not have), which is told in the notes;
        once it is known which signals are in line of sight, `antenna_height.estimate_height` and
        `Signals.raised` make it better.

    Raises
    ------
    InputError : a file cannot be used; observations, navigation and trajectory are not of one time or place; the
        heights differ from what the satellites say by tens of metres.
    InsufficientDataError : no signal is left.
    """
    settings = settings or SignalSettings()
    if not observation_paths:
        raise InputError(say("No observation file is given: give the receiver's RINEX observation files."))
    files = [read_observations(path, settings.systems, progress.part(0.3 * i / len(observation_paths), 0.3 * (
        i + 1) / len(observation_paths))) for i, path in enumerate(observation_paths)]
    navigation = read_navigation(navigation_paths)
    _check_same_days(files, navigation)
    progress.step(0.35)
    shift = trajectory_shift(trajectory, [(file.time[0], file.time[-1]) for file in files])

    def measured(seconds: float, part: Progress) -> list[_Measured]:
        """All files with the trajectory's times shifted by so many seconds."""
        found = []
        for number, file in enumerate(files):
            found.append(_measured(file, navigation, trajectory, seconds, crs_wkt, settings))
            part.step((number + 1) / len(files))
        return found

    parts = measured(shift, progress.part(0.35, 0.75))
    signals = _with_height(geoid_separation, settings, lambda value: _gathered(
        parts, files, navigation, crs_wkt, value, settings), lambda seconds, separation: _gathered(
        measured(shift + seconds, Progress(cancelled=progress.cancelled)), files, navigation, crs_wkt, separation,
        settings))
    progress.step(1.0)
    for note in signals.notes:
        progress.warn(note)
    return signals


def trajectory_shift(trajectory: Trajectory, spans: Sequence[tuple[float, float]], what: str = "observations") -> float:
    """Seconds to add to the trajectory's time to get GPS seconds since 1980-01-06.

    `spans` : first and last GPS time of the observations (or of what else `what` says), the likeliest first. For each
    its week, full GPS seconds, adjusted standard GPS time and Unix time are tried; the first that brings the two
    together is taken.

    Raises
    ------
    InputError : none does.
    """
    first, last = float(trajectory.time[0]), float(trajectory.time[-1])
    for low, high in spans:
        week = WEEK * np.floor(low / WEEK)
        unix = -UNIX_START + float(leap_seconds(np.array([low]))[0])
        for shift in (week, week - WEEK, week + WEEK, 0.0, ADJUSTMENT, unix):
            if min(last + shift, high) - max(first + shift, low) >= 0:
                return float(shift)
    start, end = min(span[0] for span in spans), max(span[1] for span in spans)
    week = WEEK * np.floor(start / WEEK)
    trajectory_span = (say("{first:.0f} to {last:.0f} s of week", first=first, last=last) if last < 2 * WEEK else
                       span_text(*(time + (ADJUSTMENT if last < 0.9e9 else 0.0) for time in (first, last))))
    raise InputError(say("Trajectory and {what} are not of one time: the trajectory covers {told}, the {what} cover "
                         "{span_text} GPS time ({start:.0f} to {end:.0f} s of week).", what=what, told=trajectory_span,
                         span_text=span_text(start, end), start=start - week, end=end - week))


def _check_same_days(files: Sequence[Observations], navigation: Navigation) -> None:
    for file in files:
        if not navigation.covers(file.time[0], file.time[-1]):
            observed, good = span_text(file.time[0], file.time[-1]), spans_text(navigation.spans())
            raise InputError(say("{file} was observed {observed} GPS time, but the navigation files are good for "
                                 "{good}: give those of the same day.", file=file.name, observed=observed, good=good))


@dataclass(frozen=True)
class _Measured:
    """Observations of one file that have a place and a satellite; rows n, epochs e.

    `difference` (n,) is the code on the second band less that on the first, without the satellite's delay, m, as far
    as that is `known`.
    """

    time: np.ndarray
    gps_time: np.ndarray
    place: np.ndarray
    epoch: np.ndarray
    satellite: np.ndarray
    code: np.ndarray
    cn0: np.ndarray
    difference: np.ndarray
    known: np.ndarray
    states: SatelliteStates
    bands: dict[str, str]
    second_bands: dict[str, str]
    left_out: Counter
    unplaced: dict[int, set[str]]


def _measured(file: Observations, navigation: Navigation, trajectory: Trajectory, shift: float, crs_wkt: str,
              settings: SignalSettings) -> _Measured:
    """Epochs of a file that the trajectory covers, with the satellites at transmission."""
    left_out: Counter = Counter()
    time = file.time - shift
    covered = within_trajectory(trajectory, time, settings.max_gap)
    _count(left_out, say("outside the trajectory or in a gap of it"), ~covered[file.epoch])
    rows = np.flatnonzero(covered[file.epoch])
    weak = file.cn0[rows] < settings.min_cn0
    _count(left_out, say("weaker than {min_cn0:g} dB-Hz", min_cn0=settings.min_cn0), weak)
    rows = rows[~weak]
    number = np.cumsum(covered) - 1
    time, gps_time, epoch = time[covered], file.time[covered], number[file.epoch[rows]]
    arm = np.asarray(settings.lever_arm, float)
    place = body_to_map(trajectory, time, arm)
    frame = MapFrame(crs_wkt)
    receiver = frame.places(place).earth_fixed if len(place) else np.zeros((0, 3))
    satellite, code = file.satellite[rows], file.code[rows]
    paths = geometric_ranges(navigation, satellite, gps_time[epoch], code, receiver[epoch], file.bands,
                             file.second_bands)
    unplaced = {}
    for status, reason in ((NO_EPHEMERIS, say("without an ephemeris")), (UNHEALTHY, say("of unhealthy satellites"))):
        _count(left_out, reason, paths.states.status == status)
        unplaced[status] = set(satellite[paths.states.status == status].tolist())
    good = np.isfinite(paths.distance)
    # The clock follows from the codes themselves; at the true time of reception the antenna was a little back.
    rough = code - paths.distance + SPEED_OF_LIGHT * (paths.states.clock - paths.states.delay)
    clock = grouped_median(rough[good], epoch[good], len(time))
    late = np.where(np.isfinite(clock) & (np.abs(clock) < 0.05 * SPEED_OF_LIGHT), clock, 0.0) / SPEED_OF_LIGHT
    received = np.clip(time - late, trajectory.time[0], trajectory.time[-1])
    place = body_to_map(trajectory, received, arm)
    states = SatelliteStates(*(getattr(paths.states, name)[good] for name in SatelliteStates.__dataclass_fields__))
    known = np.isfinite(states.second_delay)
    beside = [name for name, band in file.second_bands.items() if band == BESIDE_ONLY.get(name)]
    second_delay = np.where(~known & np.isin(satellite[good].astype("U1"), beside), 0.0, states.second_delay)
    difference = file.second_code[rows][good] - code[good] - SPEED_OF_LIGHT * second_delay
    return _Measured(time, gps_time, place, epoch[good], satellite[good], code[good], file.cn0[rows][good], difference,
                     known, states, file.bands, file.second_bands, left_out, unplaced)


def within_trajectory(trajectory: Trajectory, time: np.ndarray, max_gap: float) -> np.ndarray:
    """Which times (n,), in the trajectory's own time, lie in it and not in a gap longer than so many seconds."""
    covered = trajectory.within(time)
    spans = gaps(trajectory, max_gap)
    if len(spans):
        gap = np.searchsorted(spans[:, 0], time, side="left") - 1
        within = (gap >= 0) & (time < spans[np.maximum(gap, 0), 1])
        covered &= ~within
    return covered


def _count(left_out: Counter, reason: str, mask: np.ndarray) -> None:
    if mask.any():
        left_out[reason] += int(mask.sum())


def _gathered(parts: Sequence[_Measured], files: Sequence[Observations], navigation: Navigation, crs_wkt: str,
              separation: float, settings: SignalSettings) -> Signals:
    """Signals of all files with a geoid separation."""
    frame = MapFrame(crs_wkt, separation)
    model = nearest_model(navigation.ionosphere, float(np.median(np.concatenate([file.time for file in files]))))
    first = np.cumsum([0, *(len(part.time) for part in parts)])
    columns, datum, left_out, airs = [], [], Counter(), []
    for number, part in enumerate(parts):
        left_out.update(part.left_out)
        table, low, base, air = _modelled(part, frame, model, separation, settings)
        _count(left_out, say("below {elevation_mask:g} degrees of elevation",
                             elevation_mask=settings.elevation_mask), low)
        table["epoch"] = table["epoch"] + first[number]
        columns.append(table)
        datum.append(base)
        airs.append(air)
    columns_of_all = {name: np.concatenate([table[name] for table in columns]) for name in columns[0]}
    if not len(columns_of_all["epoch"]):
        reasons = ", ".join(f"{count} {reason}" for reason, count in left_out.items())
        raise InsufficientDataError(say("No observation can be used ({value}): check that observations, navigation "
                                        "and trajectory belong together.", value=reasons or say("the files hold none")))
    epochs = Epochs(np.concatenate([part.time for part in parts]), np.concatenate([part.gps_time for part in parts]),
                    np.concatenate([part.place for part in parts]),
                    np.repeat(np.arange(len(parts)), [len(part.time) for part in parts]))
    row = columns_of_all["epoch"]
    notes = (*_notes(files, navigation, model is None and None in airs, parts),
             *_ionosphere_notes(airs, parts))
    return Signals(epochs=epochs, time=epochs.time[row], place=epochs.place[row],
                   system=columns_of_all["satellite"].astype("U1"), clock_datum=np.array(datum),
                   geoid_separation=separation, left_out=dict(left_out),
                   ionosphere_measured=all(air is not None and air.is_calibrated for air in airs),
                   notes=notes, **columns_of_all)


def _modelled(part: _Measured, frame: MapFrame, model, separation: float,
              settings: SignalSettings
              ) -> tuple[dict[str, np.ndarray], np.ndarray, float, MeasuredIonosphere | None]:
    """Columns of `Signals` for a file, which rows were below the mask, the datum of its clock, and the ionosphere if it
    was measured."""
    if not len(part.epoch):
        empty = np.zeros(0)
        names = ("code", "cn0", "elevation", "azimuth", "residual", "sigma", "troposphere", "ionosphere", "age")
        return {**dict.fromkeys(names, empty), "epoch": np.zeros(0, int), "satellite": np.zeros(0, "U3"),
                "direction": np.zeros((0, 3))}, np.zeros(0, bool), 0.0, None
    site: EarthPlaces = frame.places(part.place)
    epoch = part.epoch
    vector, distance = sagnac_corrected(part.states.place, site.earth_fixed[epoch])
    direction = directions(site.axes[epoch], vector)
    elevation, azimuth = elevation_azimuth(direction)
    above = np.degrees(elevation) >= settings.elevation_mask
    visible = np.flatnonzero(above)
    epoch, elevation, azimuth = epoch[visible], elevation[visible], azimuth[visible]
    system = part.satellite[visible].astype("U1")
    latitude, longitude = site.latitude[epoch], site.longitude[epoch]
    wet = troposphere(latitude, part.place[epoch, 2], elevation, settings.humidity)
    north = azimuth + site.convergence[epoch]
    free = (np.zeros(len(visible)) if model is None else
            ionosphere(model, system, part.bands, latitude, longitude, north, elevation, part.gps_time[epoch]))
    free_sigma = (5.0 / np.sin(elevation + 0.2)) if model is None else MODEL_ERROR * free
    noise = expected_code_noise(part.cn0[visible], system)
    air = measure_ionosphere(TwoBands(
        part.gps_time[epoch], part.place[epoch], part.satellite[visible], elevation, north, free, model is not None,
        part.difference[visible], noise, part.bands, part.second_bands,
        part.known[visible])) if settings.two_bands else None
    if air is not None:
        free, free_sigma = air.delay, air.sigma
    clock = SPEED_OF_LIGHT * (part.states.clock[visible] - part.states.delay[visible])
    residual = part.code[visible] - distance[visible] + clock - wet - free
    datum = float(np.median(residual)) if len(visible) else 0.0
    sigma = expected_sigma(noise, elevation, free_sigma)
    return {"epoch": epoch, "satellite": part.satellite[visible], "code": part.code[visible], "cn0": part.cn0[visible],
            "direction": direction[visible], "elevation": np.degrees(elevation), "azimuth": np.degrees(azimuth),
            "residual": residual - datum, "sigma": sigma, "troposphere": wet, "ionosphere": free,
            "age": part.states.age[visible]}, ~above, datum, air


def expected_code_noise(cn0: np.ndarray, system: np.ndarray) -> np.ndarray:
    """Standard deviation (n,) of a code range by its strength (dB-Hz, NaN counts as a weak signal), m.

    A receiver delays GLONASS's channels differently, by some metres.
    """
    strength = np.where(np.isfinite(cn0), cn0, NO_CN0)
    noise = np.sqrt(0.25 ** 2 + 1500.0 * 10 ** (-strength / 10))
    return np.where(system == "R", np.hypot(GLONASS_FACTOR * noise, GLONASS_CHANNEL), noise)


def expected_sigma(noise: np.ndarray, elevation: np.ndarray, ionosphere_sigma: np.ndarray) -> np.ndarray:
    """Standard deviation (n,) of a line-of-sight code residual, m, clock aside.

    Broadcast orbits and clocks err by most of a metre, the troposphere's model by a tenth of a metre at the zenith.

    Parameters
    ----------
    noise : (n,) of the code, m.
    elevation : (n,) rad.
    ionosphere_sigma : (n,) of the delay that was taken off, m.
    """
    air = 0.1 / np.sin(elevation)
    return np.sqrt(0.7 ** 2 + noise ** 2 + air ** 2 + ionosphere_sigma ** 2)


def _ionosphere_notes(airs: Sequence[MeasuredIonosphere | None], parts: Sequence[_Measured]) -> tuple[str, ...]:
    """What two bands say of the ionosphere, in the mean of the files that have them."""
    found = [air for air in airs if air is not None]
    if not found:
        return ()
    unknown = sorted({str(name) for air, part in zip(airs, parts) if air is not None
                      for name in np.unique(part.satellite[np.isfinite(part.difference) & ~part.known])})
    notes = [say("L5 is measured, but no navigation file tells its group delays (they are in the CNAV messages of "
                 "RINEX 4): they are estimated for {names}, which is less sure.",
                 names=", ".join(unknown))] if unknown else []
    return (*notes, say("The ionosphere is measured on two bands in {count} of {files} observation files: "
                        "{vertical:.1f} m at the zenith (sigma {sigma:.1f} m) where the broadcast model says "
                        "{modelled:.1f} m.",
                        count=len(found), files=len(airs), vertical=float(np.mean([air.vertical for air in found])),
                        sigma=float(np.sqrt(np.mean([air.vertical_sigma**2 for air in found]))),
                        modelled=float(np.mean([air.modelled for air in found]))))


def _notes(files: Sequence[Observations], navigation: Navigation, without_ionosphere: bool,
           parts: Sequence[_Measured]) -> tuple[str, ...]:
    notes = [note for file in files for note in file.notes] + list(navigation.notes)
    if without_ionosphere:
        notes.append(say("The navigation files tell no coefficients of the ionosphere: its delay, some metres, is "
                         "not taken off; give a navigation file of GPS."))
    if navigation.precise and not len(navigation.kepler):
        notes.append(say("Precise orbits alone tell no group delays, up to some metres: they are not taken off; give "
                         "the navigation files too."))
    placed = {str(name) for part in parts for name in np.unique(part.satellite.astype("U1"))}
    for status, why in ((NO_EPHEMERIS, say("have no ephemeris near in time")), (UNHEALTHY, say("are unhealthy"))):
        names = sorted({name for part in parts for name in part.unplaced[status] if name[0] in placed})
        if names:
            notes.append(say("Satellites that {why} are left out: {names}.", why=why, names=", ".join(names)))
    for system in sorted({name[0] for part in parts for name in part.unplaced[NO_EPHEMERIS]} - placed):
        notes.append(say("No satellite of {system_names} can be placed: its signals are left out; give its "
                         "navigation file.", system_names=SYSTEM_NAMES[system]))
    return tuple(notes)


def _with_height(given: float | None, settings: SignalSettings, at_height: Callable[[float], Signals],
                 retimed: Callable[[float, float], Signals]) -> Signals:
    """Signals with a geoid separation that fits; where it was given, it is checked.

    `at_height(separation)` and `retimed(seconds, separation)` make the signals anew.
    """
    signals = at_height(given or 0.0)
    if given is not None and not settings.check_height:
        return signals
    try:
        offset, sigma = estimate_height(signals, strong_signals(signals))
    except InsufficientDataError:
        if given is None:
            raise
        return signals
    note = _check_fit(signals, retimed)
    if given is None:
        if abs(offset) > LARGEST_SEPARATION:
            raise InputError(say("By the satellites the antenna is {offset:.0f} m above the heights of the "
                                 "trajectory, more than any geoid separation: trajectory and observations do not "
                                 "belong together.", offset=offset))
        signals = at_height(offset)
        further, sigma = estimate_height(signals, strong_signals(signals))
        derived = (say("The geoid separation was not given; the satellites say {offset:.1f} m (sigma {sigma:.1f} m), "
                       "which is used: the official value is better.", offset=offset + further, sigma=sigma))
        return replace(signals.raised(further), geoid_sigma=sigma, notes=(*signals.notes, *note, derived))
    doubt = 0.0 if signals.ionosphere_measured else HEIGHT_BY_DELAY * _vertical_delay(signals)
    if abs(offset) > max(HEIGHT_LIMIT + doubt, 4 * sigma):
        raise InputError(say("By the satellites the antenna is {offset:.0f} m {value} than the trajectory with a "
                             "geoid separation of {given:g} m says: heights above sea level and above the ellipsoid "
                             "seem to be mixed up; a separation of about {given_2:.0f} m would fit.",
                             offset=abs(offset), value=say("higher") if offset > 0 else say("lower"), given=given,
                             given_2=given + offset))
    return replace(signals, notes=(*signals.notes, *note))


def _vertical_delay(signals: Signals) -> float:
    """Delay of the ionosphere at the zenith, about, m."""
    return float(np.median(signals.ionosphere / layer_mapping(np.radians(signals.elevation))))


def _scatter(signals: Signals) -> float:
    """How far the strongest signals contradict each other, m, at the height that suits them best."""
    try:
        return strong_scatter(signals.raised(estimate_height(signals, strong_signals(signals))[0]))
    except InsufficientDataError:
        return float("nan")


def _check_fit(signals: Signals, retimed: Callable[[float, float], Signals]) -> tuple[str, ...]:
    """Whether the strongest signals agree at each epoch; a note where they do so badly.

    Raises
    ------
    InputError : the trajectory's times are UTC, or it does not belong to the observations.
    """
    scatter = _scatter(signals)
    if not scatter > USUAL_SCATTER:
        return ()
    leap = float(leap_seconds(signals.epochs.gps_time[:1])[0])
    for seconds, fault in ((leap, say("too early, as UTC is")), (-leap, say("too late"))):
        if _scatter(retimed(seconds, signals.geoid_separation)) < min(scatter / 2.5, WIDE_SCATTER):
            raise InputError(say("The trajectory's times are {leap:.0f} s {fault}: give them in GPS time.", leap=leap,
                                 fault=fault))
    if scatter > LARGEST_SCATTER:
        raise InputError(say("The code ranges do not fit the trajectory (the strongest signals contradict each other "
                             "by {scatter:.0f} m): its CRS, its times or the observation file are of another drive.",
                             scatter=scatter))
    if scatter < WIDE_SCATTER:
        return ()
    return (say("The strongest signals contradict each other by {scatter:.1f} m at the places of the trajectory, "
                "more than the 1 to 3 m that are usual: check its times, its places and the lever arm of the antenna.",
                scatter=scatter),)
