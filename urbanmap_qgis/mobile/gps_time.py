"""GPS time of point clouds and trajectories: seconds of the week, adjusted standard time or full seconds."""

from __future__ import annotations

import itertools
from functools import lru_cache

import laspy
import numpy as np

from ..errors import InputError
from ..io.points.coordinate_steps import probes
from ..io.points.decoded_points import FileState, file_state
from ..io.points.pointcloud import PointCloud, can_be_entered, iter_chunks
from ..wording import known, mark, say
from .trajectory import Trajectory

EPOCH = np.datetime64("1980-01-06", "D")
"""Day from which full GPS seconds are counted."""

WEEK = 604_800.0
"""Seconds of a GPS week."""

ADJUSTMENT = 1e9
"""Adjusted standard GPS time is full GPS seconds less this (LAS 1.2 and later)."""

_ENOUGH = 0.5
_FEW = 0.05  # of the points, whose times may be wrong

# Name, seconds in its unit, and seconds to add to be full GPS seconds.
_COUNTS = ((mark("Unix time (seconds since 1970)"), 1.0, -315_964_800.0), (mark("milliseconds"), 1e-3, 0.0),
           (mark("microseconds"), 1e-6, 0.0), (mark("nanoseconds"), 1e-9, 0.0),
           (mark("milliseconds of Unix time"), 1e-3, -315_964_800.0),
           (mark("microseconds of Unix time"), 1e-6, -315_964_800.0),
           (mark("nanoseconds of Unix time"), 1e-9, -315_964_800.0))
_PERIODS = ((mark("seconds of the day"), 86_400.0), (mark("seconds of the hour"), 3600.0))


def time_range(cloud: PointCloud) -> tuple[float, float]:
    """First and last gps_time of a cloud, s, as stored; those that are no numbers are left out.

    Raises
    ------
    InputError : the points carry no gps_time.
    """
    if not cloud.has_dimension("gps_time"):
        raise InputError(say("The points of {paths} carry no GPS time, which ties them to the trajectory: export the "
                             "survey with it.", paths=cloud.paths[0].name))
    first, last, zeros, count, lowest = np.inf, -np.inf, 0, 0, np.inf
    for chunk in iter_chunks(cloud):
        count += len(chunk)
        time = np.asarray(chunk["gps_time"])
        time = time[np.isfinite(time)]
        if len(time):
            first, last = min(first, float(time.min())), max(last, float(time.max()))
            zeros += int(np.count_nonzero(time == 0.0))
            lowest = min(lowest, float(time[time != 0.0].min(initial=np.inf)))
    if count and not np.isfinite(first):
        raise InputError(say("No GPS time in {paths} is a number: export the survey with the points' times.",
                             paths=cloud.paths[0].name))
    if not last > first and last == 0.0:
        raise InputError(say("All GPS times in {paths} are zero: export the survey with the points' times.",
                             paths=cloud.paths[0].name))
    if zeros and first == 0.0 and lowest > last - lowest:  # zero is no time of this survey
        raise InputError(say("{zeros} of {count} points in {paths} have the GPS time 0, and the others {lowest:.1f} to "
                             "{last:.1f} s: remove those without a time, or export the survey again.", zeros=zeros,
                             count=count, paths=cloud.paths[0].name, lowest=lowest, last=last))
    return first, last


def sampled_span(cloud: PointCloud) -> tuple[float, float]:
    """Span that most of a cloud's gps_times lie in by samples, s: enough to tell how they are counted.

    Raises
    ------
    InputError : the points carry no gps_time.
    """
    if not cloud.has_dimension("gps_time") or not all(map(can_be_entered, cloud.headers)):
        return time_range(cloud)
    try:
        span = _sampled(tuple(file_state(path) for path, header in zip(cloud.paths, cloud.headers)
                              if header.point_count))
    except (laspy.errors.LaspyException, RuntimeError, OSError, ValueError, EOFError):
        # Not every LAZ can be entered in its middle; one that is damaged says so when it is read through.
        return time_range(cloud)
    return span or time_range(cloud)


@lru_cache(maxsize=8)
def _sampled(files: tuple[FileState, ...]) -> tuple[float, float] | None:
    """Span of the samples of files; None where all times are 0. Each stage of a chain asks it for the same files.

    Times that are no numbers are left out: such points lie outside of any trajectory.
    """
    times = np.concatenate([np.asarray(points["gps_time"]) for file in files for points in probes(file)])
    times = times[np.isfinite(times)]
    return tuple(np.quantile(times, [_FEW, 1.0 - _FEW]).tolist()) if times.any() else None


def time_shift(cloud: PointCloud, trajectory: Trajectory) -> float:
    """Seconds to add to a cloud's gps_time so that it is in the trajectory's time.

    Seconds of the week, adjusted standard time and full GPS seconds are told from each other by the header and the
    values; a survey may run over the end of a week. Few points without a time tell nothing.

    Raises
    ------
    InputError : no time at all, or cloud and trajectory overlap by less than half of the cloud's time.
    """
    first, last = sampled_span(cloud)
    return shift_between((first, last), (float(trajectory.time[0]), float(trajectory.time[-1])),
                         f"The points of {cloud.paths[0].name}", _kind(cloud, first))


def shift_between(span: tuple[float, float], wanted: tuple[float, float], what: str, kind: str = "") -> float:
    """Seconds to add to times of `span` so that they lie in the span `wanted`: none, whole weeks or an adjustment.

    `what` begins the sentence of the error, "The points of x.las"; `kind` says how its times are counted.

    Raises
    ------
    InputError : the two overlap by less than half of `span`.
    """
    share, shift = _best_shift(span, wanted)
    if share < _ENOUGH:
        raise InputError(" ".join([say("{what} were measured from {span:.1f} to {span_2:.1f} s{kind}, but the "
                                       "trajectory runs from {wanted:.1f} to {wanted_2:.1f} s: give those of one "
                                       "survey.", what=what, span=span[0], span_2=span[1], kind=kind,
                                       wanted=wanted[0], wanted_2=wanted[1]), *_other_count(span, wanted)]))
    return shift


def _best_shift(span: tuple[float, float], wanted: tuple[float, float]) -> tuple[float, float]:
    """Largest share of `span` that lies in `wanted` after a shift by whole weeks or an adjustment, and the shift, s."""
    if max(span[1] - span[0], wanted[1] - wanted[0]) > WEEK:  # anything fits there by some number of weeks
        return _overlap(span, wanted), 0.0
    shifts = []
    for base in (0.0, ADJUSTMENT, -ADJUSTMENT):
        shifts += [base, base + WEEK * np.round((0.5 * sum(wanted) - 0.5 * sum(span) - base) / WEEK)]
    shares = [_overlap((span[0] + shift, span[1] + shift), wanted) for shift in shifts]
    best = int(np.argmax(shares))
    return shares[best], float(shifts[best])


def _other_count(span: tuple[float, float], wanted: tuple[float, float]) -> list[str]:
    """Which of the two counts time in another usual way, if that lets them overlap: one sentence, or none."""
    fitting = []
    for (name, factor, offset), of_trajectory in itertools.product(_COUNTS, (False, True)):
        both = [span, wanted]
        first, last = both[of_trajectory]
        both[of_trajectory] = factor * first + offset, factor * last + offset
        if both[of_trajectory][0] >= 0.0 and _best_shift(*both)[0] >= _ENOUGH:
            lengths = [max(end - begin, 1e-3) for begin, end in both]
            fitting.append((max(lengths) / min(lengths), of_trajectory, name))
    if fitting:
        _, of_trajectory, name = min(fitting)
        return [_count_sentence(of_trajectory, known(name))]
    for name, period in _PERIODS:
        for of_trajectory, one, other in ((False, span, wanted), (True, wanted, span)):
            turns = period * np.round((sum(other) - sum(one)) / (2.0 * period))
            shifted = one[0] + turns, one[1] + turns
            share = _overlap(other, shifted) if of_trajectory else _overlap(shifted, other)
            if one[0] >= 0.0 and one[1] <= 1.5 * period and share >= _ENOUGH:
                return [_count_sentence(bool(of_trajectory), known(name))]
    return []


def _count_sentence(of_trajectory: bool, count: str) -> str:
    if of_trajectory:
        return say("They fit if the trajectory counts {count}: convert its times to GPS seconds.", count=count)
    return say("They fit if the former count {count}: convert their times to GPS seconds.", count=count)


def _overlap(span: tuple[float, float], wanted: tuple[float, float]) -> float:
    """Share of `span` that lies in `wanted`."""
    length = max(span[1] - span[0], 1e-3)
    inside = min(span[1], wanted[1]) - max(span[0], wanted[0])
    return float(np.clip((inside + 1e-3) / length, 0.0, 1.0))


def _kind(cloud: PointCloud, first: float) -> str:
    standard = int(cloud.headers[0].global_encoding.gps_time_type) == 1
    if standard and not 0.0 <= first < WEEK:
        return " of adjusted standard GPS time"
    return " of the GPS week" if 0.0 <= first < WEEK else ""
