"""Steps of the reference that several drives show in one place: two trajectories do not step alike.

What a drive's correction changes by at a place against the reference is its own step, or one of the reference. Where
another drive is tied to it before and after the place and their difference does not change, neither of them stepped.
Steps are looked for over chainage, so that one at a stop is as sharp as any other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import SIGMA_OF_MAD
from ...wording import say
from ..registration.correction.error_steps import MIN_CHANGE
from .network import NONE, REFERENCE, RELATIVE_KINDS, NetworkObservations


@dataclass(frozen=True)
class ReferenceStepLimits:
    """Limits of reference steps, each with its unit."""

    beside: float = 40.0  # m of path to either side whose observations tell the change
    gap: float = 5.0  # m to either side that are left out: a re-registration bends there
    fewest: int = 3  # observations on each side
    least: float = 0.06  # m: smaller steps are within what markings and their reference are off by
    proof: float = 5.0  # times the usual change of the drive, by the median of all places
    usual: float = 0.02  # m, of the usual change at least
    same: float = 0.5  # of the change, by which the other drive's may differ, and that their tie may change
    undone: float = 0.4  # of the smaller of two steps, that their sum has at most where they undo each other
    separation: float = 40.0  # m of path within which two are one step


LIMITS = ReferenceStepLimits()


@dataclass(frozen=True)
class ReferenceStep:
    """A step of the reference: the drive that shows it, the chainage, m, and the change (2,) m of its correction."""

    drive: int
    chainage: float
    change: np.ndarray

    @property
    def size(self) -> float:
        """m."""
        return float(np.hypot(*self.change))

    def sentence(self, drive: str) -> str:
        """What is to be told of it, with the drive's name."""
        return say("The reference steps by {size:.2f} m at {chainage:.0f} m of {drive}, where the drives do not: "
                   "nobody can say which side of it is right, so that reference markings beside it are left out.",
                   size=self.size, chainage=self.chainage, drive=drive)


@dataclass(frozen=True)
class _Course:
    """Observed values (n, 2) m of a drive at rising chainages (n,) m."""

    chainage: np.ndarray
    value: np.ndarray

    @classmethod
    def of(cls, chainage: np.ndarray, value: np.ndarray) -> _Course:
        """In the order of chainage."""
        order = np.argsort(chainage, kind="stable")
        return cls(chainage[order], value[order])

    def change_at(self, at: float) -> np.ndarray | None:
        """(2,) m, the jump at a place of a line through both sides; None where one has too few observations."""
        near = self.chainage - at
        some = (np.abs(near) >= LIMITS.gap) & (np.abs(near) <= LIMITS.beside)
        after = near[some] > 0
        if min(np.count_nonzero(after), np.count_nonzero(~after)) < LIMITS.fewest:
            return None
        design = np.column_stack([np.ones(len(after)), near[some], after])
        return np.linalg.lstsq(design, self.value[some], rcond=None)[0][2]


def reference_steps(observations: NetworkObservations, chainage: np.ndarray,
                    other_chainage: np.ndarray) -> list[ReferenceStep]:
    """Steps of the reference, those of each drive in the order driven.

    Parameters
    ----------
    chainage, other_chainage : (n,) m of each observation along its drive and along the other one.
    """
    known = np.isfinite(observations.value[:, :2]).all(axis=1)
    against = known & (observations.kind == REFERENCE)
    courses = {int(number): _Course.of(chainage[rows], observations.value[rows, :2])
               for number in np.unique(observations.drive[against])
               for rows in [np.flatnonzero(against & (observations.drive == number))]}
    found: list[ReferenceStep] = []
    for number, course in courses.items():
        ties = _ties(observations, known, chainage, other_chainage, number)
        found += _steps_of(number, course, ties, courses)
    return found


def _ties(observations: NetworkObservations, known: np.ndarray, chainage: np.ndarray, other_chainage: np.ndarray,
          number: int) -> list[tuple[int, _Course, _Course]]:
    """The drives tied to one: number, how far they lie apart, and their own chainage, over that of the one."""
    tied, found = known & np.isin(observations.kind, RELATIVE_KINDS), []
    for mine, along, theirs, way, sign in ((observations.drive, chainage, observations.other, other_chainage, 1.0),
                                           (observations.other, other_chainage, observations.drive, chainage, -1.0)):
        for partner in np.unique(theirs[tied & (mine == number)]):
            rows = np.flatnonzero(tied & (mine == number) & (theirs == partner))
            if partner not in (number, NONE):
                found.append((int(partner), _Course.of(along[rows], sign * observations.value[rows, :2]),
                              _Course.of(along[rows], way[rows, None])))
    return found


def _steps_of(number: int, course: _Course, ties: Sequence[tuple[int, _Course, _Course]],
              courses: dict[int, _Course]) -> list[ReferenceStep]:
    """Steps of the reference in one drive's course: the largest within every `separation` m."""
    places = 0.5 * (course.chainage[1:] + course.chainage[:-1])
    changes = [(float(at), change) for at in places if (change := course.change_at(float(at))) is not None]
    if not changes:
        return []
    sizes = np.array([np.hypot(*change) for _, change in changes])
    usual = max(SIGMA_OF_MAD * float(np.median(sizes)), LIMITS.usual)
    chosen: list[ReferenceStep] = []
    for rank in np.argsort(-sizes, kind="stable"):
        at, change = changes[rank]
        if sizes[rank] < max(LIMITS.least, LIMITS.proof * usual):
            break
        if all(abs(at - step.chainage) > LIMITS.separation for step in chosen) and any(
                _of_reference(at, change, tie, courses.get(tie[0])) for tie in ties):
            chosen.append(ReferenceStep(number, at, change))
    return sorted(chosen, key=lambda step: step.chainage)


def _of_reference(at: float, change: np.ndarray, tie: tuple[int, _Course, _Course], other: _Course | None) -> bool:
    """Whether a tied drive says that a change is the reference's: it does not step, or shows the same step itself."""
    _, difference, way = tie
    of_tie = difference.change_at(at)
    size = float(np.hypot(*change))
    if of_tie is None or np.hypot(*of_tie) > LIMITS.same * size:
        return False
    forward = way.value[-1, 0] >= way.value[0, 0]
    seen = None if other is None else other.change_at(float(np.interp(at, way.chainage, way.value[:, 0])))
    if seen is None:
        return size > MIN_CHANGE
    return float(np.hypot(*(seen if forward else -seen) - change)) <= LIMITS.same * size


def undisputed(observations: NetworkObservations, chainage: np.ndarray, steps: Sequence[ReferenceStep]) -> np.ndarray:
    """Mask (n,) of observations that no step of the reference throws doubt on.

    Two steps of a drive that undo each other enclose markings that changed; of one alone nobody can say which side of
    it is right, so that all of the drive up to the next step is left out.
    """
    sure = np.ones(len(observations), bool)
    for number in {step.drive for step in steps}:
        of_drive = (observations.drive == number) & (observations.kind == REFERENCE)
        for begin, end in _doubted([step for step in steps if step.drive == number]):
            sure &= ~(of_drive & (chainage >= begin) & (chainage <= end))
    return sure


def _doubted(steps: Sequence[ReferenceStep]) -> list[tuple[float, float]]:
    """Stretches of chainage, m, whose reference is not to be believed."""
    spans, ends, number = [], [-np.inf, *(step.chainage for step in steps), np.inf], 0
    while number < len(steps):
        pair = steps[number:number + 2]
        rest = np.hypot(*(pair[0].change + pair[1].change)) if len(pair) == 2 else np.inf
        if rest <= LIMITS.undone * min(step.size for step in pair):
            spans.append((pair[0].chainage, pair[1].chainage))
            number += 2
        else:
            spans.append((ends[number], ends[number + 2]))
            number += 1
    return spans
