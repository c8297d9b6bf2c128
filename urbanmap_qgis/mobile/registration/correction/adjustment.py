"""One smooth correction of the trajectory from the windows' results: no step between patches, with honest sigma.

Windows give evidence on the error near their patches (J 3.2.4.3). Here it is adjusted together with a model of how the
error drifts, robustly: sections whose observations contradict the rest lose their weight, gaps are bridged, and each
patch says how its correction was found.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, field, replace

import numpy as np

from ....errors import InsufficientDataError
from ....progress import SILENT, Progress
from ...trajectory import Trajectory, gaps, jumps
from ..matching.block_chain import solve_chain
from ..records import WindowResults
from .error_steps import window_steps
from .gauss_markov import GaussMarkovDrift, jump_steps, path_parameters_of, stop_steps
from .normal_equations import NormalEquations, normal_equations_of
from .patch_status import (
    BRIDGED,
    DISTRUSTED,
    REGISTERED,
    contradicted,
    opposing_spread,
    own_sigma,
    patch_statuses,
    plan_sigma,
)

Evaluate = Callable[[Callable[[np.ndarray], np.ndarray], float], NormalEquations]
"""Normal equations about a correction curve (corrections (m, 6) at path parameters (m,)), the reference blurred by so
many metres."""

_PASSES = 6
_SEARCHED = (1,)  # rounds on the points in which the size of the drift is looked for again
_CONVERGED = 0.002  # m
_ANGLE_PRIOR = 0.25  # of their usual size that angles may be off by until gross markings have lost their weight
_FACTORS = (1.0, 2.0, 4.0, 8.0)
_FACTOR_SPREAD = 1.0  # how far from the expected drift, in powers of two, a survey's usually lies
_WEIGHT_TOLERANCE = 0.02
_REGION = 5  # pieces to either side that are a piece's region
_MIN_USUAL = 0.1  # reduced chi square of single pieces below which none is held against them
_MIN_NOISE = 0.3  # of the stated variance of the evidence, whatever the survey says
_MIN_REPORTED = 0.6  # the same for the standard deviations: how quiet a short survey looks is partly luck
_SEARCH_MARGIN, _SEARCH_SHARE = 0.4, 0.02  # m from the largest error looked for; share of patches that may be there
_MIN_BLOCKS = 5  # from which the variance of the evidence can be told
_SINGULAR = 1e-6  # ratio of information below which a direction is not observed
_STEP_SOFTNESS = 0.2  # share of the information that pieces on a step keep
_NO_WEIGHT = 0.02  # weight that stands for evidence that is not believed at all


@dataclass(frozen=True)
class CorrectionSettings:
    """Parameters of the adjustment.

    Attributes
    ----------
    node_length : m of path parameter between the nodes of the correction.
    rate_sigma, rate_correlation_length, random_walk, initial_sigma, time_weight, stop_walk : see `GaussMarkovDrift`;
        the survey itself scales the rate and the random walk.
    block_length : m of path whose observations are tested, and lose their weight, as one.
    single : how many times as large as usual a single piece's misfit may be (its root).
    region : how many times as large as usual the mean misfit of the pieces around may be.
    gross : standard deviations from which a block's contradiction is gross.
    min_margin : log-likelihood by which a position must beat all others.
    search : m, largest error east or north that the windows looked for: a correction as large is no find.
    support_length : m of path to either side whose markings must fix the position of a registered patch.
    registered_sigma : m in plan, a registered patch has at most, also by the markings around alone.
    trusted_sigma : m in plan, a patch that is to be trusted has at most.
    blurs : m, by which the reference is softened in the rounds on the points.
    reference_sigma, reference_sigma_z : m, what the reference itself is off by, added to every sigma.
    """

    node_length: float = 2.0
    rate_sigma: tuple[float, ...] = (2e-3, 2e-3, 1.5e-3, 1.2e-3, 1.2e-3, 1.2e-3)
    rate_correlation_length: float = 40.0
    random_walk: tuple[float, ...] = (1.5e-3, 1.5e-3, 1.0e-3, 1e-3, 1e-3, 1e-3)
    initial_sigma: tuple[float, ...] = (3.0, 3.0, 5.0, 0.15, 0.15, 0.2)
    time_weight: float = 1.0
    stop_walk: float = 0.1
    block_length: float = 10.0
    single: float = 4.0
    region: float = 3.0
    gross: float = 5.0
    min_margin: float = 3.0
    search: float = np.inf
    support_length: float = 15.0
    registered_sigma: float = 0.10
    trusted_sigma: float = 0.30
    blurs: tuple[float, ...] = (0.15, 0.05, 0.0, 0.0, 0.0)
    reference_sigma: float = 0.01
    reference_sigma_z: float = 0.015

    def model(self) -> GaussMarkovDrift:
        """The drift as these settings expect it."""
        return GaussMarkovDrift(np.array(self.rate_sigma), self.rate_correlation_length, np.array(self.random_walk),
                                np.array(self.initial_sigma), self.time_weight, self.stop_walk)


@dataclass(frozen=True)
class Correction:
    """The correction along the path; what T_corrected has more than T_reported: place (m) and angles (degrees).

    Attributes
    ----------
    time : (n,) s, chainage : (n,) m, of the patches.
    value : (n, 6) dx, dy, dz, droll, dpitch, dheading; 0 for what was not estimated.
    covariance : (n, 6, 6), the reference's own error included; NaN for what was not estimated.
    status : (n,) int8, REGISTERED, BRIDGED or DISTRUSTED.  reason : (n,) why it is not simply registered, or "".
    weight : (n,) 0 to 1, of the patch's own evidence; NaN where it has none.
    residual : (n, 6) the window's own correction less this one; NaN where there is none.
    three_d : whether height, roll and pitch were estimated.
    drift_factor : how many times as large as expected the drift is. noise_factor : of the observations' variance.
    """

    time: np.ndarray
    chainage: np.ndarray
    value: np.ndarray
    covariance: np.ndarray
    status: np.ndarray
    reason: np.ndarray
    weight: np.ndarray
    residual: np.ndarray
    three_d: bool
    drift_factor: float
    noise_factor: float
    _node_parameter: np.ndarray = field(repr=False)
    _node_state: np.ndarray = field(repr=False)
    _active: tuple[int, ...] = field(repr=False)
    _time_weight: float = field(repr=False)

    def __len__(self) -> int:
        return len(self.time)

    def sigma(self) -> np.ndarray:
        """(n, 6) standard deviations, m and degrees."""
        return np.sqrt(np.einsum("nii->ni", self.covariance))

    def plan_sigma(self) -> np.ndarray:
        """(n,) standard deviation in the worst direction in plan, m."""
        return plan_sigma(self.covariance)


def correct_trajectory(trajectory: Trajectory, correction: Correction) -> Trajectory:
    """The trajectory with the correction at all its epochs; before the first and after the last node it is rigid."""
    path_parameter = path_parameters_of(trajectory, correction._time_weight)
    change = np.zeros((len(path_parameter), 6))
    change[:, correction._active] = _smooth_between(correction._node_parameter, correction._node_state, path_parameter)
    return Trajectory(trajectory.time, trajectory.place + change[:, :3], trajectory.angles + change[:, 3:])


def adjust_correction(windows: WindowResults, trajectory: Trajectory,
                      settings: CorrectionSettings = CorrectionSettings(), points: Evaluate | None = None,
                      progress: Progress = SILENT) -> Correction:
    """Adjust the windows' results to one smooth correction.

    Parameters
    ----------
    points : gives the evidence of the points themselves about any course (see `PointObservations.about`); with it the
        correction goes on from the windows' to where the points put it.

    Raises
    ------
    InsufficientDataError : no window was registered.
    """
    path_parameter = path_parameters_of(trajectory, settings.time_weight)
    normals = normal_equations_of(windows, np.interp(windows.time, trajectory.time, path_parameter))
    if not normals.present.any():
        raise InsufficientDataError(
            "No section of the survey could be registered to the reference markings: check that both show the same "
            "streets in the same coordinate system, and that the survey has intensities that show paint.")
    model, at_patches = settings.model(), normals.path_parameter
    nodes = _nodes(path_parameter, settings.node_length)
    chain = _Chain(normals, nodes, trajectory, path_parameter,
                   window_steps(windows, np.interp(nodes, at_patches, windows.chainage), settings.min_margin))
    sure = windows.margin >= settings.min_margin
    allowed = np.where(sure, 1.0, 0.0) if (sure & normals.present).any() else np.ones(len(windows))
    if points is not None:
        model = model.with_angles(_ANGLE_PRIOR)
    fit = _robust_fit(chain, model, allowed, settings, progress.part(0.0, 0.4))
    doubtful = normals.present & ~sure
    if doubtful.any() and (allowed == 0).any():
        agreeing = doubtful & _only_own_mode_fits(windows, *chain.at(fit.state, fit.covariance, at_patches), settings)
        if agreeing.any():
            allowed, doubtful = np.where(agreeing, 1.0, allowed), doubtful & ~agreeing
            fit = _robust_fit(chain, model, allowed, settings, progress.part(0.4, 0.5))
    if points is not None:
        at_nodes = np.interp(chain.nodes, at_patches, allowed)
        chain, fit = _onto_points(points, chain, fit, settings.model(), at_nodes, settings, progress.part(0.5, 1.0))
    model = settings.model().scaled(fit.drift_factor)
    reported = chain.solve(model, fit.weight / max(fit.noise_factor, _MIN_REPORTED))[1]
    made = _result(windows, chain, replace(fit, covariance=reported), at_patches, doubtful, settings)
    return _distrusted(made, trajectory, settings)


def _onto_points(points: Evaluate, chain: _Chain, fit: _Fit, free: GaussMarkovDrift, allowed: np.ndarray,
                 settings: CorrectionSettings, progress: Progress) -> tuple[_Chain, _Fit]:
    """Gauss and Newton's method on the points' own normal equations, from the windows' correction."""
    held = free.with_angles(_ANGLE_PRIOR)
    for number, blur in enumerate(settings.blurs):
        progress.step(number / len(settings.blurs))
        model = held if blur > 0 else free
        last, normals = fit.state, points(_Curve(chain, fit.state), blur)
        chain = chain.with_normals(normals)
        here = np.interp(normals.path_parameter, chain.nodes, allowed) > 0.5
        if not (here & normals.present).any():
            here = np.ones(len(here), bool)
        if number in _SEARCHED:
            fit = _robust_fit(chain, model, here.astype(float), settings, SILENT)
        else:
            fit = replace(_reweighted_fit(chain, model.scaled(fit.drift_factor), here.astype(float), settings)[0],
                          drift_factor=fit.drift_factor)
        if blur == settings.blurs[-1] and np.abs(fit.state - last)[:, :2, 0].max() < _CONVERGED:
            break
    return chain, fit


@dataclass(frozen=True)
class _Curve:
    """The correction (m, 6) at path parameters (m,)."""

    chain: _Chain
    state: np.ndarray

    def __call__(self, path_parameter: np.ndarray) -> np.ndarray:
        correction = np.zeros((len(path_parameter), 6))
        correction[:, self.chain.normals.active] = _smooth_between(self.chain.nodes, self.state, path_parameter)
        return correction


@dataclass(frozen=True)
class _Fit:
    """State of the adjustment: nodes' states (k, d, 2) and covariances, weights of the evidence, factors found."""

    state: np.ndarray
    covariance: np.ndarray
    weight: np.ndarray
    drift_factor: float
    noise_factor: float


class _Chain:
    """The normal equations: nodes along the path, the observations on the node next to each piece."""

    def __init__(self, normals: NormalEquations, nodes: np.ndarray, trajectory: Trajectory, path_parameter: np.ndarray,
                 fast: np.ndarray):
        self.nodes, self.fast = nodes, fast
        rising = np.concatenate([[True], np.diff(path_parameter) > 0])
        time = np.interp(nodes, path_parameter[rising], trajectory.time[rising])
        self.stopped, self.jump = stop_steps(trajectory, time), jump_steps(trajectory, time)
        self._take(normals)

    def _take(self, normals: NormalEquations) -> None:
        self.size = len(normals.active)
        self.node, self.ahead = self._next_node(normals.path_parameter)
        moving = np.concatenate([self.fast[:1], np.maximum(self.fast[1:], self.fast[:-1]), self.fast[-1:]]) > 0
        # Where the error changes fast its own linearisation is worth less.
        self.normals = normals.softened(np.where(moving[self.node], _STEP_SOFTNESS, 1.0)) if moving.any() else normals

    def with_normals(self, normals: NormalEquations) -> _Chain:
        """The same nodes with other normal equations."""
        other = copy(self)
        other._take(normals)
        return other

    def _next_node(self, path_parameter: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Number of the nearest node of each reading, and how far ahead of it the reading is, m."""
        node = np.searchsorted(0.5 * (self.nodes[1:] + self.nodes[:-1]), path_parameter)
        return node, path_parameter - self.nodes[node]

    def solve(self, model: GaussMarkovDrift, weight: np.ndarray):
        """Most likely states (k, d, 2), their covariances, and the log-likelihood of the model."""
        k, d = len(self.nodes), self.size
        diagonal, ahead, right = np.zeros((k, d, 2, d, 2)), np.zeros((k - 1, d, 2, d, 2)), np.zeros((k, d, 2))
        transition, precision = model.steps(self.nodes, self.stopped, self.jump, self.normals.active,
                                              self.fast)
        own = np.arange(d)
        carried = np.einsum("kji,kdjl->kdil", transition, precision)  # F' P
        diagonal[1:, own, :, own, :] += np.moveaxis(precision, 1, 0)
        diagonal[:-1, own, :, own, :] += np.moveaxis(np.einsum("kdil,klm->kdim", carried, transition), 1, 0)
        ahead[:, own, :, own, :] -= np.moveaxis(carried, 1, 0)
        start = np.stack([model.initial_sigma, model.rate_sigma], axis=1)[list(self.normals.active)] ** -2.0
        diagonal[0, own, 0, own, 0] += start[:, 0]
        diagonal[0, own, 1, own, 1] += start[:, 1]
        weighted = self.normals.information * weight[:, None, None]
        gradient = self.normals.normal_vector * weight[:, None]
        steps = np.stack([np.ones(len(self.ahead)), self.ahead], axis=1)
        for a in range(2):
            np.add.at(right[:, :, a], self.node, gradient * steps[:, a, None])
            for b in range(2):
                np.add.at(diagonal[:, :, a, :, b], self.node, weighted * (steps[:, a] * steps[:, b])[:, None, None])
        solution = solve_chain(diagonal.reshape(k, 2 * d, 2 * d), ahead.reshape(k - 1, 2 * d, 2 * d),
                               right.reshape(k, 2 * d))
        determinants = np.linalg.det(precision)
        prior = float(np.log(determinants).sum() + np.log(start).sum())
        likelihood = 0.5 * (float((right.reshape(k, -1) * solution.state).sum()) + prior - solution.log_determinant)
        return solution.state.reshape(k, d, 2), solution.covariance, likelihood

    def unconstrained_likelihood(self, weight: np.ndarray, allowed: np.ndarray) -> float:
        """Log-likelihood that the nodes would reach each on its own, with the densities that their weights stand for.

        With it likelihoods can be compared between models that weight the `allowed` (n,) evidence differently.
        """
        k, allowed = len(self.nodes), self.normals.present & (allowed > 0)
        information, gradient = np.zeros((k, self.size, self.size)), np.zeros((k, self.size))
        np.add.at(information, self.node, self.normals.information * weight[:, None, None])
        np.add.at(gradient, self.node, self.normals.normal_vector * weight[:, None])
        values, vectors = np.linalg.eigh(information)
        there = values > _SINGULAR * np.maximum(values[:, -1:], 1e-12)
        along = np.einsum("kji,kj->ki", vectors, gradient)
        best = 0.5 * (np.where(there, along**2, 0.0) / np.where(there, values, 1.0)).sum()
        count = np.bincount(self.node, allowed, k)
        mean = np.bincount(self.node, allowed * weight, k) / np.maximum(count, 1)
        rank = np.where(mean > 0, there.sum(axis=1), self.size) * (count > 0)
        return float(best) - 0.5 * float((rank * np.log(np.maximum(mean, _NO_WEIGHT))).sum())

    def at(self, state: np.ndarray, covariance: np.ndarray,
           path_parameter: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Values (n, d) and covariances (n, d, d) at path parameters (n,)."""
        node, ahead = self._next_node(path_parameter)
        value = _smooth_between(self.nodes, state, path_parameter)
        d = self.size
        blocks = covariance[node].reshape(-1, d, 2, d, 2)
        lever_arm = ahead[:, None, None]
        spread = (blocks[:, :, 0, :, 0] + lever_arm * (blocks[:, :, 0, :, 1] + blocks[:, :, 1, :, 0])
                  + lever_arm**2 * blocks[:, :, 1, :, 1])
        return value, spread


def _nodes(path_parameter: np.ndarray, length: float) -> np.ndarray:
    """Path parameters at which the correction has nodes, at most `length` apart, at least two."""
    count = max(int(np.ceil((path_parameter[-1] - path_parameter[0]) / length)), 1)
    return np.linspace(path_parameter[0], path_parameter[-1], count + 1)


def _robust_fit(chain: _Chain, model: GaussMarkovDrift, allowed: np.ndarray, settings: CorrectionSettings,
                progress: Progress) -> _Fit:
    """The adjustment with the size of drift that makes the survey likeliest, its gross blocks counted against it."""
    tried = []
    for number, factor in enumerate(_FACTORS):
        progress.step(number / len(_FACTORS))
        fit, likelihood = _reweighted_fit(chain, model.scaled(factor), allowed, settings)
        tried.append((likelihood - 0.5 * (np.log2(factor) / _FACTOR_SPREAD) ** 2, factor, fit))
    _, factor, fit = max(tried, key=lambda entry: entry[0])
    return replace(fit, drift_factor=factor)


def _reweighted_fit(chain: _Chain, model: GaussMarkovDrift, allowed: np.ndarray,
                    settings: CorrectionSettings) -> tuple[_Fit, float]:
    """Adjustment in which blocks that contradict the rest lose their weight, and the log-likelihood of the model."""
    normals = chain.normals
    block = ((normals.path_parameter - normals.path_parameter[0]) / settings.block_length).astype(int)
    single, share, noise = allowed.copy(), np.ones(block.max() + 1), 1.0
    weight = single
    for _ in range(_PASSES):
        scaled = weight / noise
        state, spread, likelihood = chain.solve(model, scaled)
        value, covariance = chain.at(state, spread, normals.path_parameter)
        test = _block_tests(normals, value, covariance, block, single, share, noise)
        single = _single_weights(normals.misfit(value), allowed, settings)
        share, noise_found = _block_shares(test, noise, settings)
        last, weight = weight, single * share[block]
        if np.abs(weight - last).max() < _WEIGHT_TOLERANCE and abs(noise_found / noise - 1.0) < _WEIGHT_TOLERANCE:
            break
        noise = noise_found
    likelihood -= chain.unconstrained_likelihood(scaled, allowed)
    return _Fit(state, spread, weight, 1.0, noise), likelihood


def _single_weights(misfit: np.ndarray, allowed: np.ndarray, settings: CorrectionSettings) -> np.ndarray:
    """Weights (n,) of single pieces: those with a much larger misfit than the survey's usual one lose theirs.

    They lie on markings that are not the reference's: painted anew beside the old ones, or something else that shines.
    """
    counted = (allowed > 0) & (misfit > 0)
    if not counted.any():
        return allowed
    usual = max(float(np.median(misfit[counted])), _MIN_USUAL)
    running = np.concatenate([np.zeros((1, 2)), np.cumsum(np.column_stack([misfit * counted, counted]), axis=0)])
    number = np.arange(len(misfit))
    total = (running[np.minimum(number + _REGION + 1, len(misfit))] - running[np.maximum(number - _REGION, 0)])
    around = total[:, 0] / np.maximum(total[:, 1], 1.0)
    regional = np.maximum(around / (settings.region * usual), 1.0)
    return allowed / (1.0 + misfit / (settings.single**2 * usual)) / regional


def _block_tests(normals: NormalEquations, value: np.ndarray, covariance: np.ndarray, block: np.ndarray,
                 single: np.ndarray, share: np.ndarray, noise: float) -> np.ndarray:
    """For each block (b,): how far its own observations in plan lie from what all others say, as a reduced chi square.

    `single` (n,) and `share` (b,) are the weights of pieces and blocks with which the values were found; NaN is given
    for a block without observations.
    """
    plan, count = normals.in_plan(), len(share)
    lean, information = np.zeros((count, len(plan))), np.zeros((count, len(plan), len(plan)))
    np.add.at(lean, block, normals.gradient_at(value)[:, plan] * (single / noise)[:, None])
    np.add.at(information, block, normals.information[:, plan][:, :, plan] * (single / noise)[:, None, None])
    covariance = covariance[:, plan][:, :, plan]
    ends = np.searchsorted(block, np.arange(count + 1))
    middle = np.minimum((ends[:-1] + ends[1:]) // 2, len(block) - 1)
    test = np.full(count, np.nan)
    for b in np.flatnonzero(information.any(axis=(1, 2))):
        own = information[b]
        others = np.linalg.inv(covariance[middle[b]]) - share[b] * own
        values, vectors = np.linalg.eigh(0.5 * (others + others.T))
        spread = (vectors / np.maximum(values, 1e-9 * max(values.max(), 1e-9))) @ vectors.T
        apart = lean[b] + share[b] * own @ (spread @ lean[b])
        scatter = own + own @ spread @ own
        sizes, axes = np.linalg.eigh(0.5 * (scatter + scatter.T))
        there = sizes > 1e-8 * sizes.max()
        test[b] = float(((axes[:, there].T @ apart) ** 2 / sizes[there]).sum()) / max(int(there.sum()), 1)
    return test


def _block_shares(test: np.ndarray, noise: float, settings: CorrectionSettings) -> tuple[np.ndarray, float]:
    """Weights (b,) of blocks by their reduced chi square, and the factor of the observations' variance."""
    fair = test[np.isfinite(test)]
    if len(fair) >= _MIN_BLOCKS:  # the median, so that gross blocks do not raise it
        noise = max(_MIN_NOISE, noise * float(np.clip(np.median(fair) / 0.8, 0.5, 2.0)))
    test = np.nan_to_num(test, nan=0.0)
    share = np.minimum(1.0, settings.gross**2 / 6.0 / np.maximum(test, 1e-9))
    return np.where(test > settings.gross**2 / 2.0, 0.0, share), noise


def _only_own_mode_fits(windows: WindowResults, value: np.ndarray, covariance: np.ndarray,
                        settings: CorrectionSettings) -> np.ndarray:
    """Mask (n,) of patches of doubt whose own position lies where all sure ones say, and no other one does."""
    inverse = np.linalg.inv(covariance[:, :2, :2] + np.eye(2) * settings.reference_sigma**2)

    def away(place):
        off = place - value[:, :2]
        return np.einsum("ni,nij,nj->n", off, inverse, off)

    others = [away(windows.modes[:, k]) for k in range(1, windows.modes.shape[1])]
    nearest = np.min([np.where(np.isfinite(item), item, np.inf) for item in others], axis=0)
    own = away(windows.correction[:, :2])
    return (own < 9.0) & (nearest - own > 2 * 3.0 * settings.min_margin)


def _result(windows: WindowResults, chain: _Chain, fit: _Fit, at_patches: np.ndarray, doubtful: np.ndarray,
            settings: CorrectionSettings) -> Correction:
    """The correction at the patches with its quality."""
    normals, n = chain.normals, len(windows)
    active = list(normals.active)
    value, covariance = np.zeros((n, 6)), np.full((n, 6, 6), np.nan)
    value[:, active], spread = chain.at(fit.state, fit.covariance, at_patches)
    floor = np.zeros(6)
    floor[:2], floor[2] = settings.reference_sigma**2, settings.reference_sigma_z**2
    covariance[np.ix_(range(n), active, active)] = spread + np.diag(floor[active])
    piece = np.searchsorted(0.5 * (normals.path_parameter[1:] + normals.path_parameter[:-1]), at_patches)
    weight = np.where(normals.present, fit.weight, np.nan)[piece]
    residual = windows.correction - value
    opposed = contradicted(residual[:, :2], covariance[:, :2, :2], windows.covariance[:, :2, :2], windows.usable)
    covariance[:, :2, :2] += opposing_spread(residual[:, :2], opposed)
    own = own_sigma(normals, fit.weight / fit.noise_factor, at_patches, settings.support_length)
    status, reason = patch_statuses(own, weight, plan_sigma(covariance), doubtful, settings.registered_sigma,
                           settings.trusted_sigma)
    status[opposed & (status == REGISTERED)], reason[opposed] = BRIDGED, "the window here contradicts the correction"
    return Correction(windows.time, windows.chainage, value, covariance, status, reason, weight, residual,
                      normals.three_d, fit.drift_factor, fit.noise_factor, chain.nodes, fit.state,
                      normals.active, settings.time_weight)


def _distrusted(made: Correction, trajectory: Trajectory, settings: CorrectionSettings) -> Correction:
    """The correction with patches distrusted where the trajectory is broken, or all of them beyond the search."""
    status, reason = made.status.copy(), made.reason.copy()
    for spans, extent, why in ((gaps(trajectory), 2 * settings.node_length, "the trajectory has a gap here"),
                              (jumps(trajectory), settings.support_length, "the trajectory jumps here")):
        for start, end in spans:
            ends = np.interp([start, end], made.time, made.chainage) + np.array([-extent, extent])
            broken = (made.chainage >= ends[0]) & (made.chainage <= ends[1])
            status[broken], reason[broken] = DISTRUSTED, why
    reached = (np.abs(made.value[:, :2]) > settings.search - _SEARCH_MARGIN).any(axis=1)
    if reached.mean() > _SEARCH_SHARE:
        status[:], reason[:] = DISTRUSTED, "the correction reaches the largest error looked for"
    return replace(made, status=status, reason=reason)


def _smooth_between(nodes: np.ndarray, state: np.ndarray, path_parameter: np.ndarray) -> np.ndarray:
    """Values (m, d) at path parameters (m,): cubics that meet the nodes' values and rates."""
    step = np.clip(np.searchsorted(nodes, path_parameter, side="right") - 1, 0, len(nodes) - 2)
    length = (nodes[step + 1] - nodes[step])[:, None]
    t = np.clip((path_parameter - nodes[step])[:, None] / length, 0.0, 1.0)
    before, after = state[step], state[step + 1]
    return (before[:, :, 0] * (1 + 2 * t) * (1 - t) ** 2 + after[:, :, 0] * t**2 * (3 - 2 * t)
            + length * t * (1 - t) * (before[:, :, 1] * (1 - t) - after[:, :, 1] * t))
