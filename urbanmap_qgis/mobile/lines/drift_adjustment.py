"""The drift of a trajectory as one adjustment of all tie points: best estimate and sigma at every epoch.

Errors of position and heading wander: from one node of time to the next they change by a random walk of q sqrt(dt)
metres and q_turn sqrt(dt) radians. Where positions come from dead reckoning (between GNSS fixes, in Z the INS), an
error of heading also rotates the course driven since: the walk is then coupled, and the correction rotates
the course as Z's relative motions do. Which of the two the navigation does, the coefficients of the random walk and the
sigma of the tie points are what makes the tie points most likely.

With the observation equations of Z (eq. 14, for every pair at its own time) this is one least squares problem with a
banded matrix. Against the paper's method (relative_motion.py): a pair need not share its time with the other of its
set, a heading that is weakly known borrows from its neighbours, and every epoch has its sigma, which grows between sets
and beyond the first and the last.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import LinAlgError, cho_solve_banded, cholesky_banded
from scipy.optimize import minimize
from scipy.special import ndtr

from ..trajectory import Trajectory
from .ground_truths import rotated_vectors

POSITION_WALK, HEADING_WALK, SIGMA = 0.05, np.radians(0.01), 0.05
"""What is expected of the walk (m and radians per square root of a second) and of tie points (m)."""

_SPREAD = np.log([4.0, 4.0, 3.0])


@dataclass(frozen=True)
class DriftAdjustmentLimits:
    """Limits of drift adjustment, each with its unit."""

    start_sigma: float = 1000.0
    min_step: float = 1e-3
    node_steps: tuple[float, ...] = 1.0, 5.0  # s
    iterations: int = 3
    band: int = 5
    coupling_evidence: float = 20.0
    min_share: float = 1e-9
    # Errors that nothing was seen of walk this many times as fast as expected: so that most navigations do not
    # faster.
    unseen: float = 2.0


LIMITS = DriftAdjustmentLimits()

_NODES, _MAX_NODES = 600, 4000


@dataclass(frozen=True)
class RandomWalk:
    """How errors change: random walks of position and heading.

    Attributes
    ----------
    position_walk : of a coordinate, m per square root of a second.
    heading_walk : radians likewise.
    sigma : of a tie point's coordinate, m.
    heading_sigma : expected error of the heading, radians.
    coupled : errors of heading rotate the course (dead reckoning).
    """

    position_walk: float = POSITION_WALK
    heading_walk: float = HEADING_WALK
    sigma: float = SIGMA
    heading_sigma: float = np.radians(0.5)
    coupled: bool = False


@dataclass(frozen=True)
class TiePairs:
    """Pairs as observations, (n,) in the order of time: seen (n, 2) p - o, true (n, 2) p' - o, time, number of the
    set."""

    seen: np.ndarray
    true: np.ndarray
    time: np.ndarray
    sets: np.ndarray


@dataclass(frozen=True)
class RandomWalkDrift:
    """The drift at nodes (k,) over the whole trajectory.

    Attributes
    ----------
    time : (k,) s.
    value : (k, 3) shift east and north, m, and rotation anticlockwise, radians: to be added.
    covariance : (k, 3, 3).
    gain : (k - 1, 3, 3) G with covariance of node k and k + 1 = -G covariance[k + 1].
    walk : what was found or taken.
    first, last : times of the first and the last tie point.
    alternatives : probability and drift of every walk that the tie points leave possible, with covariances that hold
        what is not known of its coefficients; empty for one of them.
    """

    time: np.ndarray
    value: np.ndarray
    covariance: np.ndarray
    gain: np.ndarray
    walk: RandomWalk
    first: float
    last: float
    alternatives: tuple[tuple[float, RandomWalkDrift], ...] = ()

    def interpolate(self, time: np.ndarray) -> np.ndarray:
        """Drift (m, 3) at times (m,), linear between nodes."""
        return np.column_stack([np.interp(time, self.time, column) for column in self.value.T])

    def variances(self, time: np.ndarray) -> np.ndarray:
        """Variances (m, 3) of the drift at times (m,)."""
        at_node = np.einsum("kii->ki", self.covariance)
        before = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2)
        length = (self.time[before + 1] - self.time[before])[:, None]
        u = np.clip((time - self.time[before])[:, None] / length, 0.0, 1.0)
        with_next = -np.einsum("kij,kji->ki", self.gain, self.covariance[1:])[before]
        bridge = length * u * (1 - u) * np.array([self.walk.position_walk, self.walk.position_walk,
                                                  self.walk.heading_walk]) ** 2
        return (1 - u) ** 2 * at_node[before] + u**2 * at_node[before + 1] + 2 * u * (1 - u) * with_next + bridge

    def total_variances(self, time: np.ndarray) -> np.ndarray:
        """Variances (m, 3) of the drift at times (m,) with what the tie points do not tell of the walk itself.

        What they tell of it holds for as long a time as they span; farther beyond the first and the last of them
        errors are taken to walk at least twice as fast as is expected of a navigation.
        """
        drift = self.interpolate(time)
        beyond = np.maximum(self.first - time, time - self.last) - (self.last - self.first)
        total = np.zeros_like(drift)
        for weight, other in self.alternatives:
            known = np.array([other.walk.position_walk, other.walk.position_walk, other.walk.heading_walk])
            unseen = np.maximum((LIMITS.unseen * np.array([POSITION_WALK, POSITION_WALK,
                                                           HEADING_WALK])) ** 2 - known**2, 0.0)
            total += weight * (other.variances(time) + (other.interpolate(time) - drift) ** 2
                               + np.maximum(beyond, 0.0)[:, None] * unseen)
        return total

    def joint_covariance(self, nodes: np.ndarray) -> np.ndarray:
        """Covariance (m, 3, m, 3) of the drift at some nodes (m,), increasing."""
        joint = np.empty((len(nodes), 3, len(nodes), 3))
        for column, later in enumerate(nodes):
            part, row = self.covariance[later], column
            joint[column, :, column] = part
            for node in range(later - 1, nodes[0] - 1, -1):
                part = -self.gain[node] @ part
                if row and nodes[row - 1] == node:
                    row -= 1
                    joint[row, :, column], joint[column, :, row] = part, part.T
        return joint


def fit_drift(pairs: TiePairs, trajectory: Trajectory, walk: RandomWalk, fixed_sigma: bool = False) -> RandomWalkDrift:
    """The most likely drift of pairs; what `walk` says is expected, and its sigma of tie points kept if fixed.

    Its `alternatives` tell what the tie points leave open: how fast errors walk, where few or near sets hardly say it,
    and whether errors of heading rotate the course.
    """
    system = _System(pairs, trajectory)
    start = np.zeros((len(system.time), 3))
    system.linearise(start)
    found = [_most_likely(system, replace(walk, coupled=coupled), fixed_sigma) for coupled in (False, True)]
    # Without clear evidence errors are not carried along the course driven: that would bend it.
    chosen = int(found[1][1] > found[0][1] + LIMITS.coupling_evidence)
    odds = np.exp(np.clip([likelihood - found[chosen][1] for _, likelihood, _ in found], -50.0, 50.0))
    alternatives = []
    for weight, (mode, _, spread) in zip(odds / odds.sum(), found):
        position, heading = (_scale_factor(size) for size in spread)
        wide = replace(mode, position_walk=mode.position_walk * position, heading_walk=mode.heading_walk * heading)
        model = _model(system, mode, start)
        covariance, gain = system.covariances(wide)
        alternatives.append((float(weight), replace(model, covariance=covariance, gain=gain, walk=wide)))
    return replace(_model(system, found[chosen][0], start), alternatives=tuple(alternatives))


def _model(system: _System, walk: RandomWalk, start: np.ndarray) -> RandomWalkDrift:
    """The drift of a given random walk, the rotations linearised about it; `start` (k, 3) to begin with."""
    system.linearise(start)
    for _ in range(LIMITS.iterations):
        value = system.solve(walk)[0]
        system.linearise(value)
    covariance, gain = system.covariances(walk)
    time = system.pairs.time
    return RandomWalkDrift(system.time, value, covariance, gain, walk, float(time[0]), float(time[-1]))


def _scale_factor(spread: float) -> float:
    """Factor on a standard deviation whose logarithm is known to `spread`: 95 % of the errors lie within 1.96 of it."""
    nodes, weights = np.polynomial.hermite_e.hermegauss(31)
    weights = weights / weights.sum()
    low, high = 0.5, 50.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        within = weights @ (2.0 * ndtr(1.96 * middle * np.exp(-spread * nodes)) - 1.0)
        low, high = (middle, high) if within < 0.95 else (low, middle)
    return high


def leave_one_out_misfits(pairs: TiePairs, model: RandomWalkDrift) -> tuple[np.ndarray, np.ndarray]:
    """Of every set (s,): how far its pairs lie from where the other sets put them, m, and in sigmas of that.

    Left out one after the other in closed form: with residuals r of a set, covariance R of its observations and S of
    what the model puts there, the set is off by R (R - S)^-1 r without itself, with the covariance R (R - S)^-1 R.
    """
    count = int(pairs.sets.max()) + 1
    misfit, sigmas = np.full(count, np.nan), np.full(count, np.nan)
    drift = model.interpolate(pairs.time)
    residual = pairs.true - drift[:, :2] - rotated_vectors(pairs.seen, drift[:, 2])
    lever = rotated_vectors(pairs.seen, drift[:, 2] + np.pi / 2)
    for number in range(count) if count > 1 else ():
        members = np.flatnonzero(pairs.sets == number)
        nodes, which = np.unique(np.searchsorted(model.time, pairs.time[members]), return_inverse=True)
        design = np.zeros((2 * len(members), 3 * len(nodes)))
        for row, (pair, node) in enumerate(zip(members, which.ravel())):
            design[2 * row:2 * row + 2, 3 * node:3 * node + 3] = [[1, 0, lever[pair, 0]], [0, 1, lever[pair, 1]]]
        spread = design @ model.joint_covariance(nodes).reshape(3 * len(nodes), -1) @ design.T
        share, axes = np.linalg.eigh(np.eye(len(spread)) - spread / model.walk.sigma**2)
        mean = np.tile(np.eye(2), len(members)) / len(members)
        # What only this set determines has a share of nought: nothing is predicted there, its sigma is infinite.
        left = mean @ axes / np.maximum(share, LIMITS.min_share)
        misfit[number] = np.hypot(*(left @ axes.T @ residual[members].ravel()))
        sigmas[number] = misfit[number] / (model.walk.sigma * np.sqrt(np.trace(left @ axes.T @ mean.T)))
    return misfit, sigmas


def misfit_of_excluded(others: TiePairs, model: RandomWalkDrift) -> tuple[float, float]:
    """How far pairs that had no part in a model lie from where it puts them, m, and in sigmas of that."""
    drift, variance = model.interpolate(others.time), model.variances(others.time)
    misfit = np.hypot(*(others.true - drift[:, :2] - rotated_vectors(others.seen, drift[:, 2])).mean(axis=0))
    lever = np.hypot(*others.seen.mean(axis=0))
    spread = variance[:, :2].sum(axis=1).mean() + lever**2 * variance[:, 2].mean()
    return float(misfit), float(misfit / np.sqrt(spread + 2 * model.walk.sigma**2 / len(others.time)))


class _System:
    """The normal equations of the pairs, linear about a drift, banded (upper, `LIMITS.band` diagonals above)."""

    def __init__(self, pairs: TiePairs, trajectory: Trajectory):
        self.pairs = pairs
        step = np.clip(trajectory.duration / _NODES, *LIMITS.node_steps)
        count = int(np.clip(trajectory.duration / step, 2, _MAX_NODES))
        self.time = np.unique(np.concatenate([np.linspace(trajectory.time[0], trajectory.time[-1], count + 1),
                                              pairs.time]))
        self.node = np.searchsorted(self.time, pairs.time)
        self.step = np.maximum(np.diff(self.time), LIMITS.min_step)
        place = [np.interp(self.time, trajectory.time, axis) for axis in trajectory.place[:, :2].T]
        self.course = np.diff(np.column_stack(place), axis=0)

    def linearise(self, value: np.ndarray) -> None:
        """Take the drift (k, 3) about which the rotation is linear."""
        rotation = value[self.node, 2]
        lever = rotated_vectors(self.pairs.seen, rotation + np.pi / 2)
        observed = self.pairs.true - rotated_vectors(self.pairs.seen, rotation) + lever * rotation[:, None]
        size = 3 * len(self.time)
        self.normal, self.right = np.zeros((LIMITS.band + 1, size)), np.zeros(size)
        column = 3 * self.node
        for axis in (0, 1):
            np.add.at(self.normal[LIMITS.band], column + axis, 1.0)
            np.add.at(self.normal[LIMITS.band - 2 + axis], column + 2, lever[:, axis])
            np.add.at(self.right, column + axis, observed[:, axis])
        np.add.at(self.normal[LIMITS.band], column + 2, (lever**2).sum(axis=1))
        np.add.at(self.right, column + 2, (lever * observed).sum(axis=1))
        self.squares, self.observations = float((observed**2).sum()), 2 * len(observed)

    def prior(self, walk: RandomWalk) -> tuple[np.ndarray, float]:
        """Banded information of the walk and the logarithm of its determinant.

        From a node x to the next y the walk is y - F x, F = [[1, 0, -dn], [0, 1, de], [0, 0, 1]] with the course step
        (de, dn) where it is coupled, and weights w: F'wF, -F'w and w are added.
        """
        start = np.array([LIMITS.start_sigma, LIMITS.start_sigma, walk.heading_sigma]) ** -2.0
        weight = np.array([walk.position_walk, walk.position_walk, walk.heading_walk]) ** -2.0 / self.step[:, None]
        across = np.column_stack([-self.course[:, 1], self.course[:, 0]]) * float(walk.coupled)
        diagonal = np.zeros((len(self.time), 3))
        diagonal[0] += start
        diagonal[:-1] += weight
        diagonal[:-1, 2] += (across**2 * weight[:, :2]).sum(axis=1)
        diagonal[1:] += weight
        band = np.zeros_like(self.normal)
        band[LIMITS.band] = diagonal.ravel()
        band[LIMITS.band - 3, 3:] = -weight.ravel()
        for axis in (0, 1):
            carried = across[:, axis] * weight[:, axis]
            band[LIMITS.band - 2 + axis, 2:-1:3] += carried
            band[LIMITS.band - 1 - axis, 3 + axis::3] -= carried
        return band, float(np.log(start).sum() + np.log(weight).sum())

    def solve(self, walk: RandomWalk) -> tuple[np.ndarray, float]:
        """Drift at the nodes (k, 3) and the logarithm of its likelihood (but for a constant)."""
        prior, determinant = self.prior(walk)
        factor = cholesky_banded(prior + self.normal / walk.sigma**2, check_finite=False)
        right = self.right / walk.sigma**2
        value = cho_solve_banded((factor, False), right, check_finite=False)
        misfit = self.squares / walk.sigma**2 - float(right @ value)
        likelihood = 0.5 * (determinant - misfit) - np.log(factor[LIMITS.band]).sum()
        likelihood -= self.observations * np.log(walk.sigma)
        return value.reshape(-1, 3), likelihood

    def covariances(self, walk: RandomWalk) -> tuple[np.ndarray, np.ndarray]:
        """Covariances of the nodes (k, 3, 3) and gains (k - 1, 3, 3), from the factor backwards (Takahashi)."""
        factor = cholesky_banded(self.prior(walk)[0] + self.normal / walk.sigma**2)
        count = len(self.time)
        node_covariance, beside = np.zeros((count, 3, 3)), np.zeros((count - 1, 3, 3))
        for row in range(3):
            for column in range(3):
                if column >= row:
                    node_covariance[:, row, column] = factor[LIMITS.band + row - column, column::3]
                beside[:, row, column] = factor[LIMITS.band + row - column - 3, 3 + column::3]
        back = np.linalg.inv(node_covariance)
        gain = back[:-1] @ beside
        covariance = back @ back.transpose(0, 2, 1)
        for node in range(count - 2, -1, -1):
            covariance[node] += gain[node] @ covariance[node + 1] @ gain[node].T
        return covariance, gain


def _most_likely(system: _System, walk: RandomWalk, fixed_sigma: bool) -> tuple[RandomWalk, float, np.ndarray]:
    """Random walk of position and heading and sigma that make the observations most likely, given what is expected; how
    likely, and how well the logarithms of both coefficients are known (2,)."""
    expected = np.log([POSITION_WALK, HEADING_WALK, SIGMA])
    start = np.log([walk.position_walk, walk.heading_walk, walk.sigma])
    free = slice(0, 2 if fixed_sigma else 3)

    def walk_of(logs: np.ndarray) -> RandomWalk:
        position_walk, heading_walk, *sigma = np.exp(np.clip(logs, -16.0, 5.0))
        return replace(walk, position_walk=position_walk, heading_walk=heading_walk,
                       sigma=sigma[0] if sigma else walk.sigma)

    def negative_log_likelihood(logs: np.ndarray) -> float:
        try:
            likelihood = system.solve(walk_of(logs))[1]
        except LinAlgError:
            return np.inf
        return 0.5 * float((((logs - expected[free]) / _SPREAD[free]) ** 2).sum()) - likelihood

    options = {"xatol": 0.05, "fatol": 0.02, "maxiter": 150}
    found = minimize(negative_log_likelihood, start[free], method="Nelder-Mead", options=options)
    return walk_of(found.x), -float(found.fun), _log_spread(negative_log_likelihood, found.x)


def _log_spread(negative_log_likelihood, mode: np.ndarray) -> np.ndarray:
    """Standard deviations (2,) of the logarithms of both coefficients, by the curvature at the mode (Laplace)."""
    count, step = len(mode), 0.3
    middle, hessian = negative_log_likelihood(mode), np.zeros((count, count))
    shift = step * np.eye(count)
    one = [[negative_log_likelihood(mode + sign * shift[k]) for sign in (1, -1)] for k in range(count)]
    for a in range(count):
        hessian[a, a] = (sum(one[a]) - 2 * middle) / step**2
        for b in range(a):
            both = [negative_log_likelihood(mode + sign * (shift[a] + shift[b])) for sign in (1, -1)]
            hessian[a, b] = hessian[b, a] = (sum(both) - sum(one[a]) - sum(one[b]) + 2 * middle) / (2 * step**2)
    size, axes = np.linalg.eigh(hessian)
    # Nothing is known less than before anything was measured.
    covariance = (axes / np.maximum(size, _SPREAD[:1] ** -2.0)) @ axes.T
    return np.sqrt(np.diag(covariance)[:2])
