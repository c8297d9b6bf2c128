"""The drift of a trajectory as one adjustment of all tie points: best estimate and sigma at every epoch.

Errors of position and heading wander: from one node of time to the next they change by a random walk of q sqrt(dt)
metres and q_turn sqrt(dt) radians. Where positions come from dead reckoning (between GNSS fixes, in Z the INS), an
error of heading also rotates the course driven since: the walk is then coupled, and the correction rotates
the course as Z's relative motions do. Which of the two the navigation does, the coefficients of the random walk and the
sigma of the tie points are what makes the tie points most likely.

Where the navigation states how good its places are, errors may walk faster where it states more: in outages of GNSS
(`WalkPace.power`), or come back to nought after them (`WalkPace.memory`); within the seconds of a set they may walk
slower, as filtered solutions do (`WalkPace.smoothing`). The tie points tell which.

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

START_SIGMA = 1000.0
MIN_STEP = 1e-3
NODE_STEPS = 1.0, 5.0  # s
ITERATIONS = 3
BAND = 5
COUPLING_EVIDENCE = 20.0
MIN_SHARE = 1e-9
LEAST_ODDS = 1e-6
LEAST_PACE = 1e-4  # of an even walk
STATED_DOUBT = 5.0  # logarithm of the odds that sets must show against the accuracy that is stated
MEMORIES = 0.0, 20.0, 100.0  # s
SMOOTHINGS = 0.0, 5.0  # s
# Errors that nothing was seen of walk this many times as fast as expected: so that most navigations do not
# faster.
UNSEEN = 2.0

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
class WalkPace:
    """How the variance that a walk adds is spread over time.

    Attributes
    ----------
    power : it grows as this power of the standard deviation that the navigation states; 0: evenly.
    memory : s; positions keep what they are off by for this time only (times the accuracy stated, a first-order
        Gauss-Markov process); 0: for ever, a walk.
    smoothing : s; from the first to the last pair of a set, T seconds, errors walk as much as a walk whose velocity is
        correlated over this time: T - smoothing (1 - exp(-T / smoothing)) instead of T.
    """

    power: float = 0.0
    memory: float = 0.0
    smoothing: float = 0.0

    @property
    def is_stated(self) -> bool:
        """Whether the accuracy that the navigation states has a part in it."""
        return self.power > 0.0


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
    growth : (k - 1, 3) s: the variances that the walk adds from a node to the next are its squares times these.
    pace : what these come from.
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
    growth: np.ndarray
    pace: WalkPace = WalkPace()
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
        bridge = self.growth[before] * u * (1 - u) * np.array([self.walk.position_walk, self.walk.position_walk,
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
            unseen = np.maximum((UNSEEN * np.array([POSITION_WALK, POSITION_WALK,
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
    whether errors of heading rotate the course, and the pace of the walk.
    """
    system = _System(pairs, trajectory)
    start = np.zeros((len(system.time), 3))
    found = []
    for pace in _paces(trajectory):
        system.take_pace(pace)
        system.linearise(start)
        found += [(pace, *_most_likely(system, replace(walk, coupled=coupled), fixed_sigma))
                  for coupled in ((False,) if pace.memory else (False, True))]
    evidence = np.array([likelihood for _, _, likelihood, _ in found])
    if trajectory.place_sigma is not None:
        evidence -= STATED_DOUBT * np.array([not pace.is_stated for pace, *_ in found])
    chosen = _chosen(evidence, np.array([mode.coupled for _, mode, _, _ in found]))
    odds = np.exp(np.clip(evidence - evidence[chosen], -50.0, 50.0))
    odds /= odds.sum()
    alternatives = [(float(odds[k]), _widened(system, *found[k], start))
                    for k in np.flatnonzero(odds > LEAST_ODDS)]
    system.take_pace(found[chosen][0])
    return replace(_model(system, found[chosen][1], start), alternatives=tuple(alternatives))


def _paces(trajectory: Trajectory) -> list[WalkPace]:
    """What the tie points choose from: an even walk; where the navigation states its accuracy, walks that follow it."""
    spread = [WalkPace()]
    if trajectory.place_sigma is not None:
        spread += [WalkPace(2.0, memory) for memory in MEMORIES]
    return [replace(pace, smoothing=smoothing) for pace in spread for smoothing in SMOOTHINGS]


def _chosen(evidence: np.ndarray, coupled: np.ndarray) -> int:
    """Which of the walks is taken, by the logarithms of how likely they are (n,).

    Without clear evidence errors are not carried along the course driven: that would bend it.
    """
    uncoupled = np.where(coupled, -np.inf, evidence)
    best = int(np.argmax(evidence))
    return best if evidence[best] > uncoupled.max() + COUPLING_EVIDENCE else int(np.argmax(uncoupled))


def _widened(system: _System, pace: WalkPace, mode: RandomWalk, likelihood: float, spread: np.ndarray,
             start: np.ndarray) -> RandomWalkDrift:
    """The drift of a walk, its covariances with what is not known of its coefficients (`spread`, of logarithms)."""
    position, heading = (_scale_factor(size) for size in spread)
    wide = replace(mode, position_walk=mode.position_walk * position, heading_walk=mode.heading_walk * heading)
    system.take_pace(pace)
    model = _model(system, mode, start)
    covariance, gain = system.covariances(wide)
    return replace(model, covariance=covariance, gain=gain, walk=wide)


def _stated_growth(trajectory: Trajectory, power: float) -> np.ndarray:
    """(n,) s, growing from 0 to the trajectory's duration: as time does where the accuracy stated is even."""
    since = trajectory.time - trajectory.time[0]
    if power == 0.0:
        return since
    stated = np.sqrt((trajectory.place_sigma**2).mean(axis=1)) ** power
    growth = _integral(since, stated)
    return growth * (since[-1] / growth[-1])


def _integral(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(n,) of values (n,) from the first time on, by trapezia."""
    return np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(time))])


def _model(system: _System, walk: RandomWalk, start: np.ndarray) -> RandomWalkDrift:
    """The drift of a given random walk, the rotations linearised about it; `start` (k, 3) to begin with."""
    system.linearise(start)
    for _ in range(ITERATIONS):
        value = system.solve(walk)[0]
        system.linearise(value)
    covariance, gain = system.covariances(walk)
    time = system.pairs.time
    return RandomWalkDrift(system.time, value, covariance, gain, walk, float(time[0]), float(time[-1]), system.growth,
                           system.pace)


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
        left = mean @ axes / np.maximum(share, MIN_SHARE)
        misfit[number] = np.hypot(*(left @ axes.T @ residual[members].ravel()))
        sigmas[number] = misfit[number] / (model.walk.sigma * np.sqrt(np.trace(left @ axes.T @ mean.T)))
    return misfit, sigmas


def misfit_of_excluded(others: TiePairs, model: RandomWalkDrift) -> tuple[float, float]:
    """How far pairs that had no part in a model lie from where it puts them, m, and in sigmas of that.

    What is not known of the walk is in the sigmas.
    """
    drift, variance = model.interpolate(others.time), model.total_variances(others.time)
    misfit = np.hypot(*(others.true - drift[:, :2] - rotated_vectors(others.seen, drift[:, 2])).mean(axis=0))
    lever = np.hypot(*others.seen.mean(axis=0))
    spread = variance[:, :2].sum(axis=1).mean() + lever**2 * variance[:, 2].mean()
    return float(misfit), float(misfit / np.sqrt(spread + 2 * model.walk.sigma**2 / len(others.time)))


class _System:
    """The normal equations of the pairs, linear about a drift, banded (upper, `BAND` diagonals above)."""

    def __init__(self, pairs: TiePairs, trajectory: Trajectory):
        self.pairs = pairs
        step = np.clip(trajectory.duration / _NODES, *NODE_STEPS)
        count = int(np.clip(trajectory.duration / step, 2, _MAX_NODES))
        self.time = np.unique(np.concatenate([np.linspace(trajectory.time[0], trajectory.time[-1], count + 1),
                                              pairs.time]))
        self.node = np.searchsorted(self.time, pairs.time)
        self.step = np.maximum(np.diff(self.time), MIN_STEP)
        self.trajectory = trajectory
        self.take_pace(WalkPace())
        place = [np.interp(self.time, trajectory.time, axis) for axis in trajectory.place[:, :2].T]
        self.course = np.diff(np.column_stack(place), axis=0)

    def take_pace(self, pace: WalkPace) -> None:
        """Take how the variance of the walk is spread over the steps between the nodes."""
        self.pace = pace
        since = np.interp(self.time, self.trajectory.time, _stated_growth(self.trajectory, pace.power))
        growth, self.carried, self.start = np.diff(since), np.ones(len(self.step)), np.inf
        if pace.memory:
            growth, self.carried, self.start = self._with_memory(pace.memory)
        growth = np.maximum(growth, LEAST_PACE * self.step)
        slower = np.ones(len(self.step))
        for first, last in self._set_spans() if pace.smoothing else ():
            span = max(self.time[last] - self.time[first], MIN_STEP)
            slower[first:last] = 1.0 + np.expm1(-span / pace.smoothing) * pace.smoothing / span
        self.growth = slower[:, None] * np.column_stack([growth, growth, self.step])

    def _with_memory(self, memory: float) -> tuple[np.ndarray, np.ndarray, float]:
        """Growth (k - 1,) of the variance, s, what is carried on to the next node (k - 1,), and the start's growth.

        Errors are the accuracy stated times a first-order Gauss-Markov process.
        """
        stated = np.sqrt((self.trajectory.place_sigma**2).mean(axis=1))
        usual = np.sqrt(_integral(self.trajectory.time, stated**2)[-1] / self.trajectory.duration)
        at_node = np.interp(self.time, self.trajectory.time, stated) / usual
        carried = at_node[1:] / at_node[:-1] * np.exp(-self.step / memory)
        growth = -0.5 * memory * np.expm1(-2.0 * self.step / memory) * at_node[1:] ** 2
        return growth, carried, 0.5 * memory * float(at_node[0]) ** 2

    def _set_spans(self) -> list[tuple[int, int]]:
        """First and last node of each set of more than one time."""
        spans = []
        for number in np.unique(self.pairs.sets):
            nodes = self.node[self.pairs.sets == number]
            if nodes.max() > nodes.min():
                spans.append((int(nodes.min()), int(nodes.max())))
        return spans

    def linearise(self, value: np.ndarray) -> None:
        """Take the drift (k, 3) about which the rotation is linear."""
        rotation = value[self.node, 2]
        lever = rotated_vectors(self.pairs.seen, rotation + np.pi / 2)
        observed = self.pairs.true - rotated_vectors(self.pairs.seen, rotation) + lever * rotation[:, None]
        size = 3 * len(self.time)
        self.normal, self.right = np.zeros((BAND + 1, size)), np.zeros(size)
        column = 3 * self.node
        for axis in (0, 1):
            np.add.at(self.normal[BAND], column + axis, 1.0)
            np.add.at(self.normal[BAND - 2 + axis], column + 2, lever[:, axis])
            np.add.at(self.right, column + axis, observed[:, axis])
        np.add.at(self.normal[BAND], column + 2, (lever**2).sum(axis=1))
        np.add.at(self.right, column + 2, (lever * observed).sum(axis=1))
        self.squares, self.observations = float((observed**2).sum()), 2 * len(observed)

    def prior(self, walk: RandomWalk) -> tuple[np.ndarray, float]:
        """Banded information of the walk and the logarithm of its determinant.

        From a node x to the next y the walk is y - F x, F = [[a, 0, -dn], [0, a, de], [0, 0, 1]] with the course step
        (de, dn) where it is coupled, what is carried on a (1 for a walk), and weights w: F'wF, -F'w and w are added.
        """
        first = min(START_SIGMA, walk.position_walk * np.sqrt(self.start))
        start = np.array([first, first, walk.heading_sigma]) ** -2.0
        weight = np.array([walk.position_walk, walk.position_walk, walk.heading_walk]) ** -2.0 / self.growth
        across = np.column_stack([-self.course[:, 1], self.course[:, 0]]) * float(walk.coupled)
        diagonal = np.zeros((len(self.time), 3))
        diagonal[0] += start
        carry = np.column_stack([self.carried, self.carried, np.ones(len(self.carried))])
        diagonal[:-1] += carry**2 * weight
        diagonal[:-1, 2] += (across**2 * weight[:, :2]).sum(axis=1)
        diagonal[1:] += weight
        band = np.zeros_like(self.normal)
        band[BAND] = diagonal.ravel()
        band[BAND - 3, 3:] = -(carry * weight).ravel()
        for axis in (0, 1):
            carried = across[:, axis] * weight[:, axis]
            band[BAND - 2 + axis, 2:-1:3] += self.carried * carried
            band[BAND - 1 - axis, 3 + axis::3] -= carried
        return band, float(np.log(start).sum() + np.log(weight).sum())

    def solve(self, walk: RandomWalk) -> tuple[np.ndarray, float]:
        """Drift at the nodes (k, 3) and the logarithm of its likelihood (but for a constant)."""
        prior, determinant = self.prior(walk)
        factor = cholesky_banded(prior + self.normal / walk.sigma**2, check_finite=False)
        right = self.right / walk.sigma**2
        value = cho_solve_banded((factor, False), right, check_finite=False)
        misfit = self.squares / walk.sigma**2 - float(right @ value)
        likelihood = 0.5 * (determinant - misfit) - np.log(factor[BAND]).sum()
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
                    node_covariance[:, row, column] = factor[BAND + row - column, column::3]
                beside[:, row, column] = factor[BAND + row - column - 3, 3 + column::3]
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
