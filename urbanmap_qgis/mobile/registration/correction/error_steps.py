"""Where the windows' own curve changes faster than drift, and what steps of the reference nothing would show.

The final correction may follow fast changes. One side of a place predicts the other through the model of the drift:
what that leaves open, a frame of the reference may be off by (internal reliability, Baarda 1968). Where a place
contradicts the model a little, or says little, a step of the reference is about as likely as none, and goes into the
accuracy of both of its sides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...trajectory import Trajectory
from ..records import WindowResults
from ..start.fast_drift import fast_drift_rate
from .chain import NodeChain
from .disagreements import NodeStep, step_tests
from .error_model import PoseErrorModel
from .gauss_markov import still_wandering
from .robust_fit import Fit

COHERENT = 4.0
"""m of path in which a step goes one way: over so much its change is the rate times it, not that of a random walk."""

MIN_CHANGE = 0.35
"""m in 20 m: the curve is known to centimetres, and drifts by 0.3 m in 20 m at most without a stop (four cities)."""


MIN_CHANGE_UP = 0.2
"""m in height in 20 m: heights drift slower, and what the ground is off by changes by less over so much path."""


def window_steps(windows: WindowResults, chainage: np.ndarray, min_margin: float,
                 trajectory: Trajectory) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviations (k,) m of the error's change between k + 1 chainages where it is faster than drift.

    In plan and in height; 0 elsewhere. What the reported trajectory wanders while the vehicle stands is no step.
    Only windows that carry a correction with information of their own count, and whose place beats all others by
    `min_margin` (log-likelihood); a GNSS re-fix shows in them as a step.
    """
    known = windows.usable & np.isfinite(windows.linearised[:, :2]).all(axis=1) & windows.information.any(axis=(1, 2))
    known &= windows.margin >= min_margin
    none = np.zeros(len(chainage) - 1)
    if np.count_nonzero(known) < 2:
        return none, none
    wandered = still_wandering(trajectory)
    moving = windows.linearised[known, :3] + np.column_stack([
        np.interp(windows.time[known], trajectory.time, axis) for axis in wandered.T])
    shift = np.column_stack([np.interp(chainage, windows.chainage[known], axis) for axis in moving.T])
    height = np.column_stack([shift[:, 2], np.zeros(len(shift))]) if np.isfinite(shift[:, 2]).all() else None
    changes = [none if part is None else _rates(chainage, part, least)
               for part, least in ((shift[:, :2], MIN_CHANGE), (height, MIN_CHANGE_UP))]
    return changes[0], changes[1]


def _rates(chainage: np.ndarray, shift: np.ndarray, least: float) -> np.ndarray:
    """Standard deviation (k,) m of the change of shifts (k + 1, 2) m where it is more than `least` m in 20 m."""
    rate = fast_drift_rate(chainage, shift, least)
    return np.maximum(rate[1:], rate[:-1]) * np.sqrt(np.diff(chainage) * COHERENT)


@dataclass(frozen=True)
class UnseenStepLimits:
    """Limits of unseen steps, each with its unit."""

    between_changes: float = 500.0  # m of path between two places where a reference changes its frame or strip
    size: float = 0.2  # m, standard deviation of a step that is worth the name, in each direction
    side: float = 30.0  # m of path with evidence that a side has at least
    detectable: float = 4.5  # standard deviations from which a step is told
    certain: float = 100.0  # log-likelihood beyond which a step is certain
    sure: float = 1e6  # times as likely as none, which is as good as more
    either: float = 0.5  # of a step's variance, for each of its sides: one of the two is off by all of it
    longest: float = 20.0  # m of path parameter without markings: a re-fix takes as much, and shows at an end


LIMITS = UnseenStepLimits()


@dataclass(frozen=True)
class UnseenSteps:
    """What steps of the reference that nothing shows would do.

    Attributes
    ----------
    place : (k,) path parameters at which there may be one, ascending.
    chance : (k,) how many times as likely one is there as none, `sure` at most.
    expected : (k, 2, 2) m2, what each adds in plan to a place that the markings alone hold.
    median, largest : m, the size from which a step is told, along the path; NaN where no two sides are seen.
    """

    place: np.ndarray
    chance: np.ndarray
    expected: np.ndarray
    median: float = np.nan
    largest: float = np.nan

    def variance(self, at: np.ndarray) -> np.ndarray:
        """(n, 2, 2) m2, that they add in plan at path parameters (n,): beyond the next changes of the reference
        another frame holds the place."""
        ends = [np.searchsorted(self.place, at + reach) for reach in (-LIMITS.between_changes, LIMITS.between_changes)]
        chance, expected = (np.concatenate([np.zeros((1, *one.shape[1:])), np.cumsum(one, axis=0)]) for one in
                            (self.chance, self.chance[:, None, None] * self.expected))
        near = [one[ends[1]] - one[ends[0]] for one in (chance, expected)]
        return near[1] / (1.0 + near[0])[:, None, None]

    def followed(self, response: np.ndarray, at: np.ndarray) -> np.ndarray:
        """(n, 2, 2) m2, that they add at path parameters (n,), which follow the markings by `response` (n, 2, 2)."""
        return np.einsum("nij,njk,nlk->nil", response, self.variance(at), response)


def unseen_steps(chain: NodeChain, model: PoseErrorModel, fit: Fit, known: Sequence[NodeStep]) -> UnseenSteps:
    """Steps that the adjustment would not show; those that are `known` are in its covariances."""
    seen = chain.nodes[chain.marked(fit.weight)] if chain.held is None else chain.nodes
    if chain.held is not None:  # walls show steps of the drive: of the reference's they tell with their own offsets
        chain = chain.with_held(replace(chain.held, own=None))
    tests = [] if not len(seen) else [
        step for step in step_tests(chain, model, fit, 1.0) if step is not None
        and seen[0] + LIMITS.side <= chain.nodes[step.node] <= seen[-1] - LIMITS.side
        and all(abs(chain.nodes[step.node] - chain.nodes[other.node]) >= LIMITS.side for other in known)]
    if not tests:
        return UnseenSteps(np.zeros(0), np.zeros(0), np.zeros((0, 2, 2)))
    chance = np.array([min(times_as_likely(step), LIMITS.sure) * (chain.nodes[step.node + 1] - chain.nodes[step.node])
                       for step in tests]) / LIMITS.between_changes
    detectable = LIMITS.detectable * np.sqrt([np.linalg.eigvalsh(step.covariance)[-1] for step in tests])
    place, expected = chain.nodes[[step.node for step in tests]], np.array([_expected(step) for step in tests])
    return UnseenSteps(place, chance, expected, float(np.median(detectable)), float(detectable.max()))


def short_gaps(chain: NodeChain, fit: Fit, hidden: Sequence[tuple[float, float, NodeStep]],
               at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mask (n,) of path parameters in short stretches without markings, and the variance (n, 2, 2) m2 that it adds.

    The drift predicts one end of such a stretch from the other. A step of usual size that this leaves open goes into
    the accuracy as likely as the ends make it, and so does what the correction changes there: no marking says where.
    """
    short, variance = np.zeros(len(at), bool), np.zeros((len(at), 2, 2))
    moving = fit.state[:, :2, 0].copy()  # but for what the reported place is known to have wandered in stops
    moving[1:] -= np.cumsum(chain.stop_changes()[:, :2], axis=0)
    for begin, end, step in hidden:
        inside = (at > begin) & (at < end) & (end - begin <= LIMITS.longest)
        first, last = np.column_stack([np.interp([begin, end], chain.nodes, axis) for axis in moving.T])
        chance = times_as_likely(step) * (end - begin) / LIMITS.between_changes
        short |= inside
        variance[inside] = (chance / (1.0 + chance) * _expected(step)
                            + LIMITS.either * np.outer(last - first, last - first))
    return short, variance


def times_as_likely(step: NodeStep) -> float:
    """How many times as likely a step of usual size makes what is seen across a place as none does."""
    loose = step.covariance + LIMITS.size**2 * np.eye(2)
    gain = step.square - step.change @ np.linalg.solve(loose, step.change)
    return float(np.sqrt(np.linalg.det(step.covariance) / np.linalg.det(loose))
                 * np.exp(min(0.5 * gain, LIMITS.certain)))


def _expected(step: NodeStep) -> np.ndarray:
    """(2, 2) m2, what a side is off by if there is a step of usual size: either none or all of it."""
    left = np.linalg.inv(np.linalg.inv(step.covariance) + np.eye(2) / LIMITS.size**2)
    likely = left @ np.linalg.solve(step.covariance, step.change)
    return LIMITS.either * (left + np.outer(likely, likely))
