"""The drift of a trajectory as one adjustment of all tie points: best estimate and sigma at every epoch.

Errors of position and heading wander: from one tie point to the next they change by a random walk of q sqrt(dt)
metres and q_turn sqrt(dt) radians. With the observation equations of Z (eq. 14, for every pair at its own time) this
is one least squares problem with a banded matrix. Between tie points its solution is linear in time, and its sigma
grows and shrinks like a bridge; before the first and after the last the drift is held and its sigma grows. The
walk's pace and the tie points' own sigma are estimated from the tie points (most likely values).

Against the paper's way (see relative_motion.py): a pair need not share its time with the other of its set, weak
headings borrow from their neighbours, and every epoch has its sigma.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cho_solve_banded, cholesky_banded
from scipy.optimize import minimize

from .ground_truths import turned

PACE, TURN_PACE, SIGMA = 0.05, np.radians(0.01), 0.05
"""What is expected of the walk (m and radians per square root of a second) and of tie points (m)."""

_SPREAD = np.log([4.0, 4.0, 3.0])
_START_SIGMA = 1000.0
_LEAST_STEP = 1e-3
_ROUNDS = 4
_BAND = 5
_COLUMNS_AT_ONCE = 600


@dataclass(frozen=True)
class Walk:
    """How errors change.

    Attributes
    ----------
    pace : m per square root of a second.  turn_pace : radians likewise.  sigma : of a tie point's coordinate, m.
    heading_sigma : expected error of the heading, radians.
    """

    pace: float = PACE
    turn_pace: float = TURN_PACE
    sigma: float = SIGMA
    heading_sigma: float = np.radians(1.0)


@dataclass(frozen=True)
class Pairs:
    """Observations, (n,) in the order of time: seen (n, 2) p - o, true (n, 2) p' - o, time, number of the set."""

    seen: np.ndarray
    true: np.ndarray
    time: np.ndarray
    sets: np.ndarray


@dataclass(frozen=True)
class DriftModel:
    """The drift at nodes (k,), the times of the tie points.

    Attributes
    ----------
    time : (k,) s.  value : (k, 3) shift east and north, m, and turn anticlockwise, radians.
    covariance : (k, 3, 3).  lag : (k - 1, 3, 3) covariance of each node with the next.
    walk : what was found or taken.
    """

    time: np.ndarray
    value: np.ndarray
    covariance: np.ndarray
    lag: np.ndarray
    walk: Walk

    def at(self, time: np.ndarray) -> np.ndarray:
        """Drift (m, 3) at times (m,): linear between nodes, held outside."""
        return np.column_stack([np.interp(time, self.time, column) for column in self.value.T])

    def variances(self, time: np.ndarray) -> np.ndarray:
        """Variances (m, 3) of the drift at times (m,)."""
        own = np.einsum("kii->ki", self.covariance)
        outside = np.maximum(self.time[0] - time, 0.0) + np.maximum(time - self.time[-1], 0.0)
        walked = np.array([self.walk.pace, self.walk.pace, self.walk.turn_pace]) ** 2
        if len(self.time) == 1:
            return own[0] + outside[:, None] * walked
        before = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        length = self.time[before + 1] - self.time[before]
        share = np.clip((time - self.time[before]) / length, 0.0, 1.0)
        u, v = share[:, None], 1.0 - share[:, None]
        with_next = np.einsum("kii->ki", self.lag)[before]
        bridge = (length * share * (1.0 - share) + outside)[:, None] * walked
        return v * v * own[before] + u * u * own[before + 1] + 2.0 * u * v * with_next + bridge


def fit_drift(pairs: Pairs, walk: Walk, estimate: bool = True, fixed_sigma: bool = False) -> DriftModel:
    """The most likely drift of pairs.

    Parameters
    ----------
    estimate : find the walk's pace and the tie points' sigma too, starting from `walk`; else take them as they are.
    fixed_sigma : keep the tie points' sigma.
    """
    system = _System(pairs)
    value = np.zeros((len(system.time), 3))
    for _ in range(_ROUNDS):
        system.linearise(value)
        if estimate:
            walk = _most_likely(system, walk, fixed_sigma)
        value = system.solve(walk)[0]
    covariance, lag = system.covariances(walk)
    return DriftModel(system.time, value, covariance, lag, walk)


def predicted_misfits(pairs: Pairs, model: DriftModel) -> tuple[np.ndarray, np.ndarray]:
    """Of every set (s,): how far its pairs lie from where the other sets put them, m, and that in sigmas.

    The walk stays as the model has it.
    """
    count = int(pairs.sets.max()) + 1
    away, sigmas = np.full(count, np.nan), np.full(count, np.nan)
    for number in range(count) if count > 1 else ():
        own = pairs.sets == number
        others = Pairs(pairs.seen[~own], pairs.true[~own], pairs.time[~own], pairs.sets[~own])
        rest = fit_drift(others, model.walk, estimate=False)
        drift, variance = rest.at(pairs.time[own]), rest.variances(pairs.time[own])
        miss = pairs.true[own] - drift[:, :2] - turned(pairs.seen[own], drift[:, 2])
        mean = miss.mean(axis=0)
        reach = np.hypot(*pairs.seen[own].T).mean()
        spread = (variance[:, :2].sum(axis=1) / 2).mean() + reach**2 / 2 * variance[:, 2].mean()
        away[number] = np.hypot(*mean)
        sigmas[number] = away[number] / np.sqrt(spread + model.walk.sigma**2 / own.sum())
    return away, sigmas


class _System:
    """The normal equations of the pairs, linear about a drift, in banded form (upper, `_BAND` diagonals above)."""

    def __init__(self, pairs: Pairs):
        self.pairs = pairs
        self.time, self.node = np.unique(pairs.time, return_inverse=True)
        self.node = self.node.ravel()
        self.step = np.maximum(np.diff(self.time), _LEAST_STEP)

    def linearise(self, value: np.ndarray) -> None:
        """Take the drift (k, 3) about which the turn is linear."""
        turn = value[self.node, 2]
        lever = turned(self.pairs.seen, turn + np.pi / 2)
        observed = self.pairs.true - turned(self.pairs.seen, turn) + lever * turn[:, None]
        size = 3 * len(self.time)
        self.normal, self.right = np.zeros((_BAND + 1, size)), np.zeros(size)
        column = 3 * self.node
        for axis in (0, 1):
            np.add.at(self.normal[_BAND], column + axis, 1.0)
            np.add.at(self.normal[_BAND - 2 + axis], column + 2, lever[:, axis])
            np.add.at(self.right, column + axis, observed[:, axis])
        np.add.at(self.normal[_BAND], column + 2, (lever**2).sum(axis=1))
        np.add.at(self.right, column + 2, (lever * observed).sum(axis=1))
        self.squares, self.observations = float((observed**2).sum()), 2 * len(observed)

    def prior(self, walk: Walk) -> tuple[np.ndarray, float]:
        """Banded information of the walk and the logarithm of its determinant."""
        band = np.zeros_like(self.normal)
        start = np.array([_START_SIGMA, _START_SIGMA, walk.heading_sigma]) ** -2.0
        weight = np.array([walk.pace, walk.pace, walk.turn_pace]) ** -2.0 / self.step[:, None]
        diagonal = np.zeros((len(self.time), 3))
        diagonal[0] += start
        diagonal[:-1] += weight
        diagonal[1:] += weight
        band[_BAND] = diagonal.ravel()
        band[_BAND - 3, 3:] = -weight.ravel()
        return band, float(np.log(start).sum() + np.log(weight).sum())

    def solve(self, walk: Walk) -> tuple[np.ndarray, float]:
        """Drift at the nodes (k, 3) and the logarithm of its likelihood (but for a constant)."""
        prior, determinant = self.prior(walk)
        factor = cholesky_banded(prior + self.normal / walk.sigma**2)
        right = self.right / walk.sigma**2
        value = cho_solve_banded((factor, False), right)
        misfit = self.squares / walk.sigma**2 - float(right @ value)
        likelihood = 0.5 * (determinant - misfit) - np.log(factor[_BAND]).sum() - self.observations * np.log(walk.sigma)
        return value.reshape(-1, 3), likelihood

    def covariances(self, walk: Walk) -> tuple[np.ndarray, np.ndarray]:
        """Covariances of the nodes (k, 3, 3) and of each with the next (k - 1, 3, 3)."""
        factor = cholesky_banded(self.prior(walk)[0] + self.normal / walk.sigma**2)
        count = len(self.time)
        own, lag = np.empty((count, 3, 3)), np.empty((max(count - 1, 0), 3, 3))
        for first in range(0, 3 * count, _COLUMNS_AT_ONCE):
            columns = np.arange(first, min(first + _COLUMNS_AT_ONCE, 3 * count))
            unit = np.zeros((3 * count, len(columns)))
            unit[columns, columns - first] = 1.0
            part = cho_solve_banded((factor, False), unit).reshape(count, 3, -1, 3)
            node = columns[::3] // 3
            own[node] = part[node, :, node - first // 3]
            before = node[node > 0]
            lag[before - 1] = part[before - 1, :, before - first // 3]
        return own, lag


def _most_likely(system: _System, walk: Walk, fixed_sigma: bool) -> Walk:
    """Pace, pace of turning and sigma that make the observations most likely, given what is expected of them."""
    expected = np.log([PACE, TURN_PACE, SIGMA])
    start = np.log([walk.pace, walk.turn_pace, walk.sigma])
    free = slice(0, 2 if fixed_sigma else 3)

    def walk_of(logs: np.ndarray) -> Walk:
        pace, turn_pace, *sigma = np.exp(np.clip(logs, -16.0, 5.0))
        return Walk(pace, turn_pace, sigma[0] if sigma else walk.sigma, walk.heading_sigma)

    def unlikely(logs: np.ndarray) -> float:
        try:
            likelihood = system.solve(walk_of(logs))[1]
        except LinAlgError:
            return np.inf
        return 0.5 * float((((logs - expected[free]) / _SPREAD[free]) ** 2).sum()) - likelihood

    options = {"xatol": 0.02, "fatol": 0.01, "maxiter": 300}
    found = minimize(unlikely, start[free], method="Nelder-Mead", options=options)
    return walk_of(found.x)
