"""Markings of which many lie elsewhere than the rest, all by one shift: which of the two is right they cannot say.

Where single markings here and there were painted anew, or the reference's were drawn from another frame, the larger
part carries the correction and the rest counts as noise. That rest lies on reference markings by one common shift.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ....wording import mark, say
from .patch_corrections import Correction
from .patch_status import BRIDGED, REGISTERED
from .point_observations import PointObservations
from .reference_steps import CorrectionStep

MOVED = mark("part of the markings lies elsewhere")
"""Kind of a step: by so much the markings that do not fit lie off those that do."""


LEAST_BELIEVED = 0.2
"""Weight of a piece of path from which its points count."""


@dataclass(frozen=True)
class MovedMarkingsLimits:
    """Limits of moved markings, each with its unit."""

    off: float = 0.2  # share of the points off all reference markings from which the rest is looked at
    reach: float = 1.2  # m, of shifts that are tried
    step: float = 0.1  # m
    near: float = 0.25  # m: smaller shifts are what lines are wide
    covered: float = 0.5  # of a cell that counts as marking
    explained: float = 0.4  # share of the points off that one shift must bring onto markings
    stands_out: float = 1.15  # times what the best shift at least 0.3 m from it explains: lines fit along themselves
    rival_distance: float = 0.3  # m


LIMITS = MovedMarkingsLimits()


@dataclass(frozen=True)
class MovedMarkings:
    """A shift (2,) m by which `share` of the points lie on other markings, and how much of the rest it explains."""

    shift: np.ndarray
    share: float
    explained: float


def moved_markings(points: PointObservations, curve: Callable[[np.ndarray], np.ndarray],
                   believed: np.ndarray) -> MovedMarkings | None:
    """The common shift of the markings that a correction does not fit; None where there are few, or it has none.

    Parameters
    ----------
    believed : (n,) bool, the pieces of path whose points count.
    """
    number = np.arange(-round(LIMITS.reach / LIMITS.step), round(LIMITS.reach / LIMITS.step) + 1)
    east, north = (part.ravel() * LIMITS.step for part in np.meshgrid(number, number))
    hits, total, off = np.zeros(len(east)), 0, 0
    for place, on_marking, part in points.placed(curve):
        some = believed[part]
        total, rest = total + int(some.sum()), place[some & ~on_marking]
        off += len(rest)
        if len(rest):
            hits += _on_markings(points, rest, number * LIMITS.step)
    if not off or off < LIMITS.off * total:
        return None
    share = np.where(np.hypot(east, north) >= LIMITS.near, hits / off, 0.0)
    best = int(share.argmax())
    other = share[np.hypot(east - east[best], north - north[best]) >= LIMITS.rival_distance].max()
    if share[best] < max(LIMITS.explained, LIMITS.stands_out * other):
        return None
    return MovedMarkings(np.array([east[best], north[best]]), off / total, float(share[best]))


def _on_markings(points: PointObservations, place: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """How many places (m, 2) lie on reference markings when moved north and, within that, east by shifts (s,)."""
    around = LIMITS.reach + LIMITS.step
    coverage = points.reference.coverage(*(place.min(axis=0) - around), *(place.max(axis=0) + around))
    marked = (coverage.share >= LIMITS.covered).ravel()
    row, column, _inside = coverage.grid.cells(place[:, 0] + shift[:, None], place[:, 1] + shift[:, None])
    row *= coverage.grid.columns
    return np.array([np.count_nonzero(marked[north + east]) for north in row for east in column])


def with_moved(correction: Correction, moved: MovedMarkings | None) -> Correction:
    """A correction that is not called registered anywhere, as a good part of the markings wants it elsewhere."""
    if moved is None:
        return correction
    status, reason, covariance = correction.status.copy(), correction.reason.copy(), correction.covariance.copy()
    status[status == REGISTERED] = BRIDGED
    reason[:] = say("a good part of the markings lies elsewhere by one shift")
    covariance[:, :2, :2] += np.outer(moved.shift, moved.shift)
    step = CorrectionStep(float(correction.chainage[0]), float(correction.time[0]), *moved.shift.tolist(),
                          LIMITS.step, MOVED, (float(correction.chainage[0]), float(correction.chainage[-1])))
    return replace(correction, status=status, reason=reason, covariance=covariance, steps=(step, *correction.steps))
