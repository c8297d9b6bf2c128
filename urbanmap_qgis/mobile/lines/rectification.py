"""Rectification of a trajectory by tie points and the ground (Z 3): position and heading first, then height.

The tie points are looked through for contradictions, the drift between them is found by one of the methods, and where
a ground is given the heights follow it along the rectified course. Roll and pitch stay, as in Z 3.1.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...geometry.tolerances import SIGMA_OF_MAD
from ...progress import SILENT, Progress
from ...settings.lines import RectifySettings
from ...wording import say
from ..trajectory import Trajectory, interpolate
from .course_heights import CourseHeights, course_heights, sampled_heights
from .drift_adjustment import (
    SIGMA,
    RandomWalk,
    RandomWalkDrift,
    TiePairs,
    fit_drift,
    leave_one_out_misfits,
    misfit_of_excluded,
)
from .ground_truths import misfit, rotated_vectors, set_drift, two_pair_drift
from .relative_motion import adjust_relative_motion
from .tie_points import TiePoints, pairs_within

USED, POSITION_ONLY, SUSPECT, BLUNDER, CONTRADICTING = "used", "position only", "suspect", "blunder", "contradicting"
ONE_PAIR = "one pair"
"""What became of a set: used, though it may tell no heading or hardly fit its neighbours; the others are left out."""

EXTRAPOLATED, BETWEEN = 0, 1
"""Of an epoch: before the first or after the last set, where the correction is extrapolated; between two sets."""

Ground = Callable[[np.ndarray, np.ndarray], np.ndarray]

CONTRADICTION = 5.0  # sigmas of the misfit within a set
SUSPECT_LIMIT = 3.5  # sigmas of what the other sets alone say
BLUNDER_LIMIT = 8.0  # sigmas
SETS_TRIED = 3  # of those that stand out most, how many are left out in turn
MIN_SUSPECT = 0.1  # m
# m, m/s
JUMP = 1.0
MAX_DRIFT_RATE = 0.5
MIN_SETS_TO_COMPARE = 4
MIN_SETS_TO_LEAVE_OUT = 5
MIN_SETS_FOR_SIGMA = 4
SHORT_SHARE = 0.5

_MAX_ROTATION = np.radians(10.0)


@dataclass(frozen=True)
class TieSet:
    """A set of tie points and what it showed.

    Attributes
    ----------
    name : as given.
    time : mean, s.
    place : (3,) of the vehicle as reported then.
    pairs : used of `given`.
    shift : (2,) m east and north, and `heading`, degrees clockwise: what the result adds to position and heading there.
    before, after : mean distance of its pairs from the reference, m, as reported and rectified.
    misfit : largest misfit within the set, m.
    predicted : how far off it would lie without itself, m (NaN: not known).
    status : one of `USED`, `POSITION_ONLY`, `SUSPECT`, `BLUNDER`, `CONTRADICTING`, `ONE_PAIR`.
    """

    name: str
    time: float
    place: np.ndarray
    pairs: int
    given: int
    shift: np.ndarray
    heading: float
    before: float
    after: float
    misfit: float
    predicted: float
    status: str

    @property
    def is_used(self) -> bool:
        return self.status not in (BLUNDER, CONTRADICTING, ONE_PAIR)


@dataclass(frozen=True)
class Rectified:
    """A rectified trajectory and how good it is.

    Attributes
    ----------
    trajectory : same epochs.
    sets : in the order of time.
    drift : the model of all tie points, from which the sigmas come.
    plan_sigma, heading_sigma : (n,) of a coordinate, m, and degrees; with the factor below. By the
        paper's method what it differs from the best estimate is in them.
    sigma_factor : by how much the sets miss each other more than the model of the drift says; at least 1.
    status : (n,) `EXTRAPOLATED` or `BETWEEN`.
    heights : None where no ground was given.
    settings : as used.
    """

    trajectory: Trajectory
    sets: tuple[TieSet, ...]
    drift: RandomWalkDrift
    plan_sigma: np.ndarray
    heading_sigma: np.ndarray
    sigma_factor: float
    status: np.ndarray
    heights: CourseHeights | None
    settings: RectifySettings

    @property
    def used(self) -> list[TieSet]:
        """The sets that count."""
        return [item for item in self.sets if item.is_used]

    def figures(self) -> dict[str, float]:
        """Figures of quality, m (see the outputs of `rectifytrajectory`); a height without a ground is missing."""
        between = self.status == BETWEEN
        values = {"BEFORE": _mean(item.before for item in self.used), "AFTER": _mean(item.after for item in self.used),
                  "PREDICTED": _mean(item.predicted for item in self.used),
                  "MEAN_SIGMA": _mean(self.plan_sigma[between]), "MAX_SIGMA": float(self.plan_sigma.max()),
                  "HELD_SHARE": float(1.0 - between.mean())}
        if self.heights is not None:
            values.update(HEIGHT_BEFORE=self.heights.before, HEIGHT_AFTER=self.heights.after)
        return {name: value for name, value in values.items() if np.isfinite(value)}


def rectify(trajectory: Trajectory, ties: TiePoints, ground: Ground | None = None,
            settings: RectifySettings | None = None, progress: Progress = SILENT) -> Rectified:
    """Rectify a trajectory.

    Parameters
    ----------
    ground : heights (k,) of the ground at x, y (k,), NaN where there are none; None leaves heights as they are.

    Raises
    ------
    InputError : no tie point lies within the trajectory's time, or the paper's method lacks the origin's height.
    InsufficientDataError : all sets contradict themselves, the paper's method has no set of two pairs, or the ground
        does not reach the course.
    """
    settings = settings or RectifySettings()
    if settings.method == "paper" and ground is not None and settings.sensor_height is None:
        raise InputError(say("The paper's method needs the height of the trajectory's origin above the ground: give "
                             "it, or leave out the ground."))
    ties = pairs_within(ties, trajectory, progress)
    names, number = ties.numbers()
    place = interpolate(trajectory, ties.time).place[:, :2]
    paper = settings.method == "paper"
    keep, status = (_first_two if paper else _consistent)(ties, names, number, place, settings, progress)
    progress.step(0.1)
    model = _model(trajectory, ties, number, place, keep, status, names,
                   replace(settings, keep_blunders=settings.keep_blunders or paper), progress)
    progress.step(0.5)
    status[_weak(ties, number, place, keep, status, model.walk)] = POSITION_ONLY
    _warn_of_jumps(ties, number, keep, status, names, progress)
    corrected = _corrected(trajectory, ties, number, place, keep, model, settings)
    _warn_of_extent(trajectory, model, progress)
    if not settings.tie_sigma and len(np.unique(number[keep])) < MIN_SETS_FOR_SIGMA:
        progress.warn(say("{unique_count} sets do not tell how good the tie points are: give their sigma, or add "
                          "sets.", unique_count=len(np.unique(number[keep]))))
    progress.step(0.7)
    heights = None
    if ground is not None:
        heights = (sampled_heights(corrected, ground, settings.sensor_height) if paper
                   else course_heights(corrected, ground, settings.sensor_height, progress))
        if heights.left_out > 0.5 * heights.samples:
            progress.warn(say("{left_out} of {samples} samples of the ground along the course stand out and are left "
                              "out: check that it is the ground that was driven on.", left_out=heights.left_out,
                              samples=heights.samples))
        raised = corrected.place + np.outer(heights.error, [0.0, 0.0, 1.0])
        corrected = Trajectory(corrected.time, raised, corrected.angles)
    variance = model.total_variances(trajectory.time) + _difference(trajectory, corrected, model) ** 2
    sigma, factor = np.sqrt(variance), _sigma_factor(ties, number, place, keep, model)
    between = (trajectory.time >= model.first) & (trajectory.time <= model.last)
    sets = _sets(trajectory, corrected, ties, names, number, place, keep, status, model)
    progress.step(1.0)
    return Rectified(corrected, sets, model, factor * np.sqrt((sigma[:, :2] ** 2).mean(axis=1)),
                     factor * np.degrees(sigma[:, 2]), factor, np.where(between, BETWEEN, EXTRAPOLATED), heights,
                     settings)


def _consistent(ties: TiePoints, names: list[str], number: np.ndarray, place: np.ndarray, settings: RectifySettings,
                progress: Progress) -> tuple[np.ndarray, np.ndarray]:
    """Pairs to use (n,) and status of the sets (s,): pairs and sets that contradict themselves are left out."""
    keep = np.ones(len(ties), bool)
    status = np.full(len(names), USED, dtype=object)
    limit = _misfit_limit(ties, number, place, settings)
    for members in (np.flatnonzero(number == k) for k in range(len(names))):
        name = names[number[members[0]]]
        left, fit = _without_outliers(ties, place, members, limit)
        if len(left) < len(members) and fit <= limit:
            progress.warn(say("Set {name}: {own_count} of {own_count_2} pairs contradict the others and are left out.",
                              name=name, own_count=len(members) - len(left), own_count_2=len(members)))
            keep[np.setdiff1d(members, left)] = False
        reason = say("its pairs do not fit each other by {fit:.2f} m", fit=fit) if fit > limit else ""
        rotation = _set_rotation(ties, place, left, settings)
        if not reason and abs(rotation) > _MAX_ROTATION + 3 * np.radians(settings.heading_sigma):
            reason = say("it would rotate the vehicle by {rotation:.0f} degrees; its points may be swapped",
                         rotation=np.degrees(rotation))
        if reason:
            progress.warn(say("Set {name} contradicts itself and is left out: {reason}.", name=name, reason=reason))
            keep[members], status[number[members[0]]] = False, CONTRADICTING
    if not keep.any():
        raise InsufficientDataError(say("All {names_count} sets of tie points contradict themselves: check which "
                                        "place belongs to which, and the coordinate reference system.",
                                        names_count=len(names)))
    return keep, status


def _first_two(ties: TiePoints, names: list[str], number: np.ndarray, place: np.ndarray, settings: RectifySettings,
               progress: Progress) -> tuple[np.ndarray, np.ndarray]:
    """Pairs and status as of `_consistent`, by Z 3.2: the first two pairs of each set, whether they fit or not."""
    keep = np.zeros(len(ties), bool)
    status = np.full(len(names), USED, dtype=object)
    limit = _misfit_limit(ties, number, place, settings)
    for k, name in enumerate(names):
        members = np.flatnonzero(number == k)
        if len(members) < 2:
            progress.warn(say("Set {name} has one pair and is left out: the paper's method needs two.", name=name))
            status[k] = ONE_PAIR
            continue
        if len(members) > 2:
            progress.warn(say("Set {name} has {own_count} pairs: the paper's method takes the first two.", name=name,
                              own_count=len(members)))
        members = members[:2]
        keep[members] = True
        fit = float(misfit(place[members], ties.measured[members], ties.reference[members]).max())
        if fit > limit:
            progress.warn(say("Set {name} contradicts itself by {fit:.2f} m; the paper's method uses it all the same.",
                              name=name, fit=fit))
            status[k] = SUSPECT
    if not keep.any():
        raise InsufficientDataError(say("No set has two pairs: the paper's method needs sets of two; add pairs, or "
                                        "take another method."))
    return keep, status


def _misfit_limit(ties: TiePoints, number: np.ndarray, place: np.ndarray, settings: RectifySettings) -> float:
    """Largest misfit within a set, m: five sigmas of it, which are what most sets show."""
    if settings.tie_sigma:
        return CONTRADICTION * np.sqrt(2.0) * settings.tie_sigma
    least = CONTRADICTION * np.sqrt(2.0) * SIGMA
    sets = [np.flatnonzero(number == k) for k in range(number.max() + 1)]
    shown = [misfit(place[rows], ties.measured[rows], ties.reference[rows]).max() for rows in sets if len(rows) > 1]
    usual = SIGMA_OF_MAD * float(np.median(shown)) if len(shown) >= MIN_SETS_FOR_SIGMA else 0.0
    return max(least, CONTRADICTION * usual)


def _without_outliers(ties: TiePoints, place: np.ndarray, members: np.ndarray,
                      limit: float) -> tuple[np.ndarray, float]:
    """Pairs of a set that fit each other, and their largest misfit: of more than two the worst are taken out."""
    def fit(rows: np.ndarray) -> float:
        return float(misfit(place[rows], ties.measured[rows], ties.reference[rows]).max())

    worst = fit(members)
    while worst > limit and len(members) > 2:
        worst, members = min(((fit(rest), rest) for rest in (np.delete(members, k) for k in range(len(members)))),
                             key=lambda found: found[0])
    return members, worst


def _set_rotation(ties: TiePoints, place: np.ndarray, members: np.ndarray, settings: RectifySettings) -> float:
    """Rotation of a set, radians, with what is expected of it."""
    return set_drift(place[members], ties.measured[members], ties.reference[members], settings.tie_sigma or SIGMA,
                     np.radians(settings.heading_sigma)).rotation


def _pairs(ties: TiePoints, number: np.ndarray, place: np.ndarray, keep: np.ndarray) -> tuple[TiePairs, np.ndarray]:
    """Observations of the pairs kept, and the sets that they are of."""
    sets, set_number = np.unique(number[keep], return_inverse=True)
    return TiePairs(ties.measured[keep] - place[keep], ties.reference[keep] - place[keep], ties.time[keep],
                    set_number.ravel()), sets


def _model(trajectory: Trajectory, ties: TiePoints, number: np.ndarray, place: np.ndarray, keep: np.ndarray,
           status: np.ndarray, names: list[str], settings: RectifySettings, progress: Progress) -> RandomWalkDrift:
    """The drift of all tie points; sets that do not fit their neighbours are left out of it (`keep`, `status`)."""
    start = RandomWalk(sigma=settings.tie_sigma or SIGMA, heading_sigma=np.radians(settings.heading_sigma))
    fixed = settings.tie_sigma > 0.0
    pairs, sets = _pairs(ties, number, place, keep)
    model = fit_drift(pairs, trajectory, start, fixed)
    examined = np.zeros(len(names), bool)
    # At most a quarter of the sets can be blunders: more would be a drift that jumps.
    for _ in range(max(1, len(names) // 4) if len(sets) >= MIN_SETS_TO_COMPARE else 0):
        found = _worst_set(trajectory, ties, number, place, keep, examined, model, start, fixed, progress)
        if found is None:
            break
        worst, away, sigmas_off, without = found
        examined[worst], name, suspect = True, names[worst], number == worst
        if (sigmas_off > BLUNDER_LIMIT and len(sets) >= MIN_SETS_TO_LEAVE_OUT and not settings.keep_blunders):
            progress.warn(say("Set {name} lies {away:.2f} m from where the other sets put it and is left out: check "
                              "that survey and reference show the same place.", name=name, away=away))
            status[worst], keep[suspect] = BLUNDER, False
            sets, model = np.setdiff1d(sets, worst), without
        else:
            progress.warn(say("Set {name} lies {away:.2f} m from where the other sets put it: check that survey and "
                              "reference show the same place.", name=name, away=away))
            status[worst] = SUSPECT
    return model


def _worst_set(trajectory: Trajectory, ties: TiePoints, number: np.ndarray, place: np.ndarray, keep: np.ndarray,
               examined: np.ndarray, model: RandomWalkDrift, start: RandomWalk, fixed: bool,
               progress: Progress) -> tuple[int, float, float, RandomWalkDrift] | None:
    """The set that lies farthest from where the others alone put it: its number, m, sigmas, and their drift; None where
    none lies farther than `SUSPECT_LIMIT`.

    A wrong set widens what is held possible, and draws its neighbours along: hence a drift of its own without each.
    """
    pairs, sets = _pairs(ties, number, place, keep)
    shown = np.where(examined[sets], 0.0, leave_one_out_misfits(pairs, model)[1])
    worst = None
    for k in sets[np.argsort(-shown)[:SETS_TRIED]]:
        progress.check()
        if examined[k]:
            continue
        others, _ = _pairs(ties, number, place, keep & (number != k))
        without = fit_drift(others, trajectory, start, fixed)
        away, sigmas_off = misfit_of_excluded(_pairs(ties, number, place, keep & (number == k))[0], without)
        if away > MIN_SUSPECT and sigmas_off > (worst[2] if worst else SUSPECT_LIMIT):
            worst = int(k), away, sigmas_off, without
    return worst


def _warn_of_jumps(ties: TiePoints, number: np.ndarray, keep: np.ndarray, status: np.ndarray, names: list[str],
                   progress: Progress) -> None:
    """Warn of neighbouring sets between which no navigation could have drifted so fast."""
    used = [k for k in range(len(names)) if keep[number == k].any()]
    rows = [(number == k) & keep for k in used]
    time = np.array([ties.time[members].mean() for members in rows])
    shift = np.array([(ties.reference - ties.measured)[members].mean(axis=0) for members in rows])
    change, step = np.hypot(*np.diff(shift, axis=0).T), np.diff(time)
    for k in np.flatnonzero((change > JUMP) & (change > MAX_DRIFT_RATE * step)):
        progress.warn(say("Sets {names} and {names_2} contradict each other: within {step:.1f} s the drift would "
                          "change by {change:.1f} m; check both.", names=names[used[k]], names_2=names[used[k + 1]],
                          step=step[k], change=change[k]))
        status[[used[k], used[k + 1]]] = SUSPECT


def _weak(ties: TiePoints, number: np.ndarray, place: np.ndarray, keep: np.ndarray, status: np.ndarray,
          walk: RandomWalk) -> np.ndarray:
    """Mask (s,) of sets used whose pairs tell the heading worse than what is expected of it."""
    weak = np.zeros(len(status), bool)
    for k in np.flatnonzero(status == USED):
        members = np.flatnonzero((number == k) & keep)
        seen = ties.measured[members] - place[members]
        spread = np.sqrt(((seen - seen.mean(axis=0)) ** 2).sum())
        weak[k] = walk.sigma >= walk.heading_sigma * spread
    return weak


def _corrected(trajectory: Trajectory, ties: TiePoints, number: np.ndarray, place: np.ndarray, keep: np.ndarray,
               model: RandomWalkDrift, settings: RectifySettings) -> Trajectory:
    """Position and heading rectified by the method wanted."""
    if settings.method == "drift":
        drift = model.interpolate(trajectory.time)
        angles = trajectory.angles - np.degrees(drift[:, 2:]) * [0.0, 0.0, 1.0]
        shift = np.column_stack([drift[:, :2], np.zeros(len(drift))])
        return Trajectory(trajectory.time, trajectory.place + shift, angles)
    epochs, drift = [], []
    for k in np.unique(number[keep]):
        members = np.flatnonzero((number == k) & keep)
        shift, rotation = two_pair_drift(place[members], ties.measured[members], ties.reference[members])
        # What two pairs tell by eq. 13 to 17 holds at the first of them.
        epochs.append(int(np.abs(trajectory.time - ties.time[members[0]]).argmin()))
        drift.append([*shift, rotation])
    # Sets that fall on one epoch count together.
    once, which = np.unique(epochs, return_inverse=True)
    mean = np.array([np.mean([drift[k] for k in np.flatnonzero(which.ravel() == e)], axis=0) for e in range(len(once))])
    return adjust_relative_motion(trajectory, once, mean)


def _difference(before: Trajectory, rectified: Trajectory, model: RandomWalkDrift) -> np.ndarray:
    """(n, 3) what a rectified trajectory differs from the model's drift: east and north, m, and rotation, radians."""
    rotation = np.radians(before.angles[:, 2:] - rectified.angles[:, 2:])
    return np.hstack([rectified.place[:, :2] - before.place[:, :2], rotation]) - model.interpolate(before.time)


def _mean(values: Iterable[float]) -> float:
    """Mean of the values that are known; NaN where none is."""
    known = [value for value in values if np.isfinite(value)]
    return float(np.mean(known)) if known else float("nan")


def _sigma_factor(ties: TiePoints, number: np.ndarray, place: np.ndarray, keep: np.ndarray,
                  model: RandomWalkDrift) -> float:
    """Root mean square of the sets' misfits against the others, in sigmas of these; 1 where it is less."""
    pairs, sets = _pairs(ties, number, place, keep)
    if len(sets) < MIN_SETS_FOR_SIGMA:
        return 1.0
    return max(1.0, float(np.sqrt(np.mean(leave_one_out_misfits(pairs, model)[1] ** 2))))


def _warn_of_extent(trajectory: Trajectory, model: RandomWalkDrift, progress: Progress) -> None:
    """Warn where much of the course has no set on both sides."""
    if model.last - model.first < SHORT_SHARE * trajectory.duration:
        progress.warn(say("The tie points lie within {last:.0f} of {duration:.0f} s: the rest of the course is only "
                          "moved along with them, and its sigma grows; add sets there.", last=model.last - model.first,
                          duration=trajectory.duration))


def _sets(before: Trajectory, after: Trajectory, ties: TiePoints, names: list[str], number: np.ndarray,
          place: np.ndarray, keep: np.ndarray, status: np.ndarray, model: RandomWalkDrift) -> tuple[TieSet, ...]:
    """The sets with what they showed before and after."""
    pose, was = interpolate(after, ties.time), interpolate(before, ties.time)
    rotation = np.radians(was.angles[:, 2] - pose.angles[:, 2])
    moved = pose.place[:, :2] + rotated_vectors(ties.measured - place, rotation)
    off_before, off_after = (np.hypot(*(ties.reference - where).T) for where in (ties.measured, moved))
    pairs, used = _pairs(ties, number, place, keep)
    predicted = dict(zip(used.tolist(), leave_one_out_misfits(pairs, model)[0]))
    results = []
    for k, name in enumerate(names):
        rows = np.flatnonzero(number == k)
        left = rows[keep[rows]]
        some = left if len(left) else rows
        fit = float(misfit(place[some], ties.measured[some], ties.reference[some]).max())
        results.append(TieSet(name, float(ties.time[some].mean()), was.place[some].mean(axis=0), len(left), len(rows),
                              (pose.place - was.place)[some, :2].mean(axis=0),
                              -float(np.degrees(rotation[some].mean())),
                              float(off_before[some].mean()), float(off_after[some].mean()), fit,
                              float(predicted.get(k, np.nan)), str(status[k])))
    return tuple(results)
