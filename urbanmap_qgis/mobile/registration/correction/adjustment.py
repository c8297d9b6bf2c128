"""One smooth correction of the trajectory from the windows' results: no step between patches, with honest sigma.

Windows give evidence on the error near their patches (J 3.2.4.3). Here it is adjusted together with a model of how the
error drifts, robustly: sections whose observations contradict the rest lose their weight, gaps are bridged, and each
patch says how its correction was found.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from ....errors import InsufficientDataError
from ....progress import SILENT, Progress
from ....wording import say
from ...trajectory import Trajectory, gaps, jumps, path_chainage
from ..records import WindowResults
from .chain import NodeChain, nodes_along, smooth_between
from .disagreements import (
    CorrectionStep,
    Disagreements,
    either_side,
    hidden_factor,
    hidden_steps,
    settle,
    with_disagreements,
)
from .error_model import PoseErrorModel
from .error_steps import window_steps
from .fast_changes import FastChange, by_slip, fast_changes
from .gauss_markov import path_parameters_of
from .normal_equations import NormalEquations, normal_equations_of
from .patch_status import (
    BRIDGED,
    DISTRUSTED,
    LEAST_MET,
    MOST_SPAN,
    REGISTERED,
    contradicted,
    evidence_spans,
    opposing_spread,
    own_information,
    patch_statuses,
    plan_sigma,
    plan_sigma_of,
)
from .robust_fit import Fit, reweighted_fit, robust_fit
from .second_witness import (
    Witness,
    WitnessConflict,
    settled_offset,
    wall_shares,
    with_broken_walls,
    with_conflict,
    without_astray,
)
from .settings import CorrectionSettings
from .shown_accuracy import with_shown_pitch
from .side_slip import SideSlip

Evaluate = Callable[[Callable[[np.ndarray], np.ndarray], float], NormalEquations]
"""Normal equations about a correction curve (corrections (m, 6) at path parameters (m,)), the reference blurred by so
many metres."""

_SEARCHED = (1,)  # rounds on the points in which the size of the drift is looked for again
_CONVERGED = 0.002  # m
_AROUND_STEP, _ON_STEP = 20.0, 10.0
"""m from a step within which quiet evidence is not believed, and within which a patch counts as on it."""

_STEP_SUPPORT = 5.0  # m of path to either side whose markings must fix a patch on a step
_MIN_REPORTED, _MIN_OF_WINDOWS = 0.05, 0.6
"""Of the stated variance in plan, whatever the survey says: by points, and by windows, which look quiet as they share
theirs."""

_WALL_ROUNDS = 3  # in which the walls are matched anew
_SEARCH_MARGIN, _SEARCH_SHARE = 0.4, 0.02  # m from the largest error looked for; share of patches that may be there


@dataclass(frozen=True)
class Correction:
    """The correction along the path; what T_corrected has more than T_reported: place (m) and angles (degrees).

    Attributes
    ----------
    time : (n,) s.
    chainage : (n,) m, of the patches.
    value : (n, 6) dx, dy, dz, droll, dpitch, dheading; 0 for what was not estimated.
    covariance : (n, 6, 6), the reference's own error included; NaN for what was not estimated.
    status : (n,) int8, REGISTERED, BRIDGED or DISTRUSTED.
    reason : (n,) why it is not simply registered, or "".
    weight : (n,) 0 to 1, of the patch's own evidence; NaN where it has none.
    residual : (n, 6) the window's own correction less this one; NaN where there is none.
    three_d : whether height, roll and pitch were estimated.
    drift_factor : how many times as large as expected the drift is.
    noise_factor : of the observations' variance.
    heading_factor : how many times as large as stated the error of the heading was taken for, 1 as a rule.
    steps : where reference and survey disagree, in the order driven.
    walls : (n,) 0 to 1, share of the walls in what is known of the place in plan around; None where none were held.
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
    heading_factor: float
    _node_parameter: np.ndarray = field(repr=False)
    _node_state: np.ndarray = field(repr=False)
    _active: tuple[int, ...] = field(repr=False)
    _time_weight: float = field(repr=False)
    steps: tuple[CorrectionStep, ...] = ()
    walls: np.ndarray | None = None

    def __len__(self) -> int:
        return len(self.time)

    def sigma(self) -> np.ndarray:
        """(n, 6) standard deviations, m and degrees."""
        return np.sqrt(np.einsum("nii->ni", self.covariance))

    def along(self, path_parameter: np.ndarray) -> np.ndarray:
        """The correction (m, 6) at path parameters (m,)."""
        change = np.zeros((len(path_parameter), 6))
        change[:, self._active] = smooth_between(self._node_parameter, self._node_state, path_parameter)
        return change

    def plan_sigma(self) -> np.ndarray:
        """(n,) standard deviation in the worst direction in plan, m."""
        return plan_sigma(self.covariance)


def correct_trajectory(trajectory: Trajectory, correction: Correction) -> Trajectory:
    """The trajectory with the correction at all its epochs; before the first and after the last node it is rigid."""
    path_parameter = path_parameters_of(trajectory, correction._time_weight)
    change = correction.along(path_parameter)
    return Trajectory(trajectory.time, trajectory.place + change[:, :3], trajectory.angles + change[:, 3:])


def adjust_correction(windows: WindowResults, trajectory: Trajectory,
                      settings: CorrectionSettings | None = None, points: Evaluate | None = None,
                      progress: Progress = SILENT, walls: Witness | None = None) -> Correction:
    """Adjust the windows' results to one smooth correction.

    Parameters
    ----------
    points : gives the evidence of the points themselves about any course (see `PointObservations.about`); with it the
        correction goes on from the windows' to where the points put it.
    walls : a second witness beside the markings; it needs `points`.

    Raises
    ------
    InsufficientDataError : no window was registered.
    """
    settings = settings or CorrectionSettings()
    path_parameter = path_parameters_of(trajectory, settings.time_weight)
    normals = normal_equations_of(windows, np.interp(windows.time, trajectory.time, path_parameter))
    if not normals.present.any():
        raise InsufficientDataError(
            say("No section of the survey could be registered to the reference markings: check that both show the "
                "same streets in the same coordinate system, and that the survey has intensities that show paint."))
    at_patches, nodes = normals.path_parameter, nodes_along(path_parameter, settings.node_length)
    model = settings.error_model(_angle_sigma(trajectory, path_parameter, nodes, settings))
    chain = NodeChain(normals, nodes, trajectory, path_parameter,
                   *window_steps(windows, np.interp(nodes, at_patches, windows.chainage), settings.min_margin,
                                 trajectory))
    sure = windows.margin >= settings.min_margin
    allowed = np.where(sure, 1.0, 0.0) if (sure & normals.present).any() else np.ones(len(windows))
    fit = robust_fit(chain, model, allowed, settings, progress.part(0.0, 0.4))
    doubtful = normals.present & ~sure
    if doubtful.any() and (allowed == 0).any():
        value, covariance = chain.interpolate(fit.state, fit.covariance, at_patches)
        agreeing = doubtful & _only_own_mode_fits(windows, value, covariance, settings)
        if agreeing.any():
            allowed, doubtful = np.where(agreeing, 1.0, allowed), doubtful & ~agreeing
            fit = robust_fit(chain, model, allowed, settings, progress.part(0.4, 0.5))
    if walls is not None:
        agreeing = doubtful & _where_walls_want_it(walls, chain, fit, model, windows, at_patches, settings)
        allowed, doubtful = np.where(agreeing, 1.0, allowed), doubtful & ~agreeing
    if points is not None:
        at_nodes = np.interp(chain.nodes, at_patches, allowed)
        chain, fit = _onto_points(points, chain, fit, model, at_nodes, settings, progress.part(0.5, 1.0))
    model = model.scaled(fit.drift_factor).with_heading(fit.heading_factor)
    slip = SideSlip.of(trajectory, path_parameter)
    at_nodes = np.interp(chain.nodes, at_patches, allowed)
    changes = fast_changes(chain, fit, model, at_nodes, partial(_likelihood, settings=settings))
    found = _settled(chain, fit, model, at_nodes, changes, slip, points, settings)
    found, conflict = _heard(walls, found, model) if walls is not None else (found, WitnessConflict(()))
    found = by_slip(found, changes, model, slip)
    found = replace(found, fit=_with_plan_noise(found.chain, found.fit, model, points is not None))
    chain = found.chain
    correction = _result(windows, found, at_patches, doubtful, settings, conflict)
    if correction.three_d:
        correction = _with_shown_pitch(correction, _angle_sigma(trajectory, path_parameter, at_patches, settings))
    steps = (*found.listed(partial(_along, trajectory, path_parameter)),
             *conflict.listed(windows.chainage, windows.time))
    correction = replace(correction, steps=tuple(sorted(steps, key=lambda step: step.place)))
    # Walls hold the survey where few markings let the start wander off.
    return _distrusted(correction, trajectory, windows.beyond and chain.held is None, settings)


def _where_walls_want_it(walls: Witness, chain: NodeChain, fit: Fit, model: PoseErrorModel, windows: WindowResults,
                         at_patches: np.ndarray, settings: CorrectionSettings) -> np.ndarray:
    """Mask (n,) of patches whose own position, and no other one of theirs, lies where the walls alone want it."""
    model, curve = model.scaled(fit.drift_factor).with_heading(fit.heading_factor), _Curve(chain, fit.state)
    walls = walls.fitted(chain, model, curve)
    wall_observations = None if walls.course is None else walls.about(walls.course, chain.normals.active)
    if wall_observations is None:
        return np.zeros(len(windows), bool)
    alone = walls.by_walls(chain.with_held(wall_observations), model)
    node = np.searchsorted(0.5 * (chain.nodes[1:] + chain.nodes[:-1]), at_patches)
    place = np.column_stack([np.interp(at_patches, chain.nodes, axis) for axis in alone.place.T])
    return _only_own_mode_fits(windows, place, alone.covariance[node], settings)


def _heard(walls: Witness, found: Disagreements, model: PoseErrorModel) -> tuple[Disagreements, WitnessConflict]:
    """What was found with what the walls say of it: steps that break them, and where outlines want the survey."""
    walls, none = walls.fitted(found.chain, model, _Curve(found.chain, found.fit.state)), WitnessConflict(())
    wall_observations = None if walls.course is None else walls.about(walls.course, found.chain.normals.active)
    if wall_observations is not None and not walls.alone:
        found = without_astray(found, wall_observations, model, walls)
    chain, fit = found.chain, found.fit
    curve, marked = _Curve(chain, fit.state), walls.among(partial(_marked, chain, fit))
    found = with_broken_walls(found, marked.jumps(curve))
    if wall_observations is None:
        return found, none
    conflict = none if walls.alone else WitnessConflict(marked.stretches(curve))
    if walls.alone:
        silent = chain.unsoftened.softened(np.zeros(len(fit.weight)))
        chain = chain.with_normals(replace(silent, present=np.zeros(len(fit.weight), bool)))
    for _ in range(_WALL_ROUNDS):
        chain = chain.with_held(wall_observations)
        fit, eaves = settled_offset(chain, fit, model, fit.weight / fit.noise_factor)
        walls = walls.with_eaves(eaves)
        wall_observations = walls.about(_Curve(chain, fit.state), chain.normals.active)
        if wall_observations is None:
            break
    return replace(found, chain=chain, fit=fit, hidden=hidden_steps(chain, model, fit, MOST_SPAN)), conflict


def _settled(chain: NodeChain, fit: Fit, model: PoseErrorModel, at_nodes: np.ndarray, changes: list[FastChange],
             slip: SideSlip, points: Evaluate | None, settings: CorrectionSettings) -> Disagreements:
    """The adjustment with its steps found; those fast changes are suspects that are not spread over their stretch."""
    return settle(chain, fit, model, at_nodes,
                  partial(_adjusted_again, points=points, model=model, settings=settings),
                  partial(_likelihood, model=model, settings=settings), MOST_SPAN, slip.denies,
                  [change.step for change in changes if not change.spread])


def _marked(chain: NodeChain, fit: Fit, path_parameter: np.ndarray) -> np.ndarray:
    """Mask (n,) of path parameters that markings hold: elsewhere walls contradict nothing but the drift's model."""
    return evidence_spans(chain.normals, fit.weight, path_parameter) <= MOST_SPAN


def _adjusted_again(chain: NodeChain, fit: Fit, allowed: np.ndarray, points: Evaluate | None, model: PoseErrorModel,
                    settings: CorrectionSettings) -> tuple[NodeChain, Fit]:
    """The adjustment of a chain that may jump elsewhere, its drift as found before."""
    again = reweighted_fit(chain, model, _at_pieces(chain, allowed), settings)[0]
    again = replace(again, drift_factor=fit.drift_factor, heading_factor=fit.heading_factor)
    if points is None:
        return chain, again
    return _onto_points(points, chain, again, model, allowed, settings, SILENT, search=False)


def _likelihood(chain: NodeChain, allowed: np.ndarray, model: PoseErrorModel, settings: CorrectionSettings) -> float:
    """Log-likelihood of a model of the drift with a chain's evidence."""
    return reweighted_fit(chain, model, _at_pieces(chain, allowed), settings)[1]


def _at_pieces(chain: NodeChain, allowed: np.ndarray) -> np.ndarray:
    """(n,) 0 or 1, whether the evidence of the pieces may be believed, from the nodes (k,)."""
    return (np.interp(chain.normals.path_parameter, chain.nodes, allowed) > 0.5).astype(float)


def _along(trajectory: Trajectory, path_parameter: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Chainages, m, and times, s, at path parameters (n,)."""
    return (np.interp(at, path_parameter, path_chainage(trajectory)), np.interp(at, path_parameter, trajectory.time))


def _with_plan_noise(chain: NodeChain, fit: Fit, model: PoseErrorModel, on_points: bool) -> Fit:
    """The fit with covariances in plan by the noise that the blocks' contradictions show."""
    least = _MIN_REPORTED if on_points else _MIN_OF_WINDOWS
    noise = np.where(chain.fast_near(chain.normals.path_parameter, _AROUND_STEP), max(fit.found_noise, 1.0),
                     max(fit.found_noise, least))
    quiet = (chain.solve(model, fit.weight / noise)[1] if chain.held is None
             else settled_offset(chain, fit, model, fit.weight / noise)[0].covariance)
    return replace(fit, covariance=_scaled_in_plan(chain, fit.covariance, quiet))


def _scaled_in_plan(chain: NodeChain, covariance: np.ndarray, found: np.ndarray) -> np.ndarray:
    """Covariances of the nodes with the variances east and north of others: heights and angles have noise of their own.

    Parameters
    ----------
    covariance, found : (k, 2 d, 2 d) of (error, rate) of each parameter, in the chain's order.
    """
    size = np.ones(covariance.shape[:2])
    east_north = slice(0, 2 * 2)
    ratio = np.einsum("nii->ni", found) / np.einsum("nii->ni", covariance)
    size[:, east_north] = np.sqrt(ratio[:, east_north])
    return covariance * size[:, :, None] * size[:, None, :]


def _angle_sigma(trajectory: Trajectory, path_parameter: np.ndarray, nodes: np.ndarray,
                 settings: CorrectionSettings) -> np.ndarray:
    """(k, 3) degrees, accuracy of the reported angles at nodes (k,): the trajectory's own, or as the settings say."""
    if trajectory.angle_sigma is None:
        return np.tile(np.array(settings.attitude_sigma), (len(nodes), 1))
    return np.column_stack([np.interp(nodes, path_parameter, axis) for axis in trajectory.angle_sigma.T])


def _onto_points(points: Evaluate, chain: NodeChain, fit: Fit, model: PoseErrorModel, allowed: np.ndarray,
                 settings: CorrectionSettings, progress: Progress, search: bool = True) -> tuple[NodeChain, Fit]:
    """Gauss and Newton's method on the points' own normal equations, from the windows' correction.

    With `search` the size of the drift is looked for; otherwise the model is taken as it is.
    """
    for number, blur in enumerate(settings.blurs):
        progress.step(number / len(settings.blurs))
        last, normals = fit.state, points(_Curve(chain, fit.state), blur)
        chain = chain.with_normals(normals)
        trusted = np.interp(normals.path_parameter, chain.nodes, allowed) > 0.5
        if not (trusted & normals.present).any():
            trusted = np.ones(len(trusted), bool)
        if search and number in _SEARCHED:
            fit = robust_fit(chain, model, trusted.astype(float), settings, SILENT)
        else:
            likely = model.scaled(fit.drift_factor).with_heading(fit.heading_factor) if search else model
            fit = replace(reweighted_fit(chain, likely, trusted.astype(float), settings)[0],
                          drift_factor=fit.drift_factor, heading_factor=fit.heading_factor)
        if blur == settings.blurs[-1] and np.abs(fit.state - last)[:, :2, 0].max() < _CONVERGED:
            break
    return chain, fit


@dataclass(frozen=True)
class _Curve:
    """The correction (m, 6) at path parameters (m,)."""

    chain: NodeChain
    state: np.ndarray

    def __call__(self, path_parameter: np.ndarray) -> np.ndarray:
        correction = np.zeros((len(path_parameter), 6))
        correction[:, self.chain.normals.active] = smooth_between(self.chain.nodes, self.state, path_parameter)
        return correction


def _only_own_mode_fits(windows: WindowResults, value: np.ndarray, covariance: np.ndarray,
                        settings: CorrectionSettings) -> np.ndarray:
    """Mask (n,) of patches of doubt whose own position lies where all sure ones say, and no other one does."""
    inverse = np.linalg.inv(covariance[:, :2, :2] + np.eye(2) * settings.reference_sigma**2)

    def away(place):
        off = place - value[:, :2]
        return np.einsum("ni,nij,nj->n", off, inverse, off)

    others = [away(windows.modes[:, k]) for k in range(1, windows.modes.shape[1])]
    nearest = np.min([np.where(np.isfinite(item), item, np.inf) for item in others], axis=0)
    own_distance = away(windows.correction[:, :2])
    return (own_distance < 9.0) & (nearest - own_distance > 2 * 3.0 * settings.min_margin)


def _result(windows: WindowResults, found: Disagreements, at_patches: np.ndarray, doubtful: np.ndarray,
            settings: CorrectionSettings, conflict: WitnessConflict) -> Correction:
    """The correction at the patches with its quality."""
    chain, fit, n = found.chain, found.fit, len(windows)
    normals = chain.normals
    active = list(normals.active)
    value, covariance = np.zeros((n, 6)), np.full((n, 6, 6), np.nan)
    value[:, active], spread = chain.interpolate(fit.state, fit.covariance, at_patches)
    floor = np.zeros(6)
    floor[:2], floor[2] = settings.reference_sigma**2, settings.reference_sigma_z**2
    covariance[np.ix_(range(n), active, active)] = spread + np.diag(floor[active])
    piece = np.searchsorted(0.5 * (normals.path_parameter[1:] + normals.path_parameter[:-1]), at_patches)
    weight = np.where(normals.present, fit.weight, np.nan)[piece]
    residual = windows.correction - value
    opposed = contradicted(residual[:, :2], covariance[:, :2, :2], windows.covariance[:, :2, :2], windows.usable)
    covariance[:, :2, :2] += opposing_spread(residual[:, :2], opposed)
    if windows.spread is not None:
        covariance[doubtful, :2, :2] += windows.spread[doubtful]
    covariance[:, :2, :2] *= hidden_factor(found.hidden, at_patches)[:, None, None]
    beside, variance = either_side(found.two_sided, chain.nodes, at_patches)
    covariance[:, :2, :2] += variance
    against, either = conflict.mask_and_variance(windows.chainage)
    covariance[:, :2, :2] += either
    support = np.where(chain.fast_near(at_patches, _ON_STEP), _STEP_SUPPORT, settings.support_length)
    by_paint = own_information(normals, fit.weight / fit.noise_factor, at_patches, support)
    by_walls = chain.held.plan_information(at_patches, support) if chain.held else np.zeros_like(by_paint)
    by_own_windows = plan_sigma_of(by_paint + by_walls)
    status, reason = patch_statuses(by_own_windows, weight, plan_sigma(covariance), doubtful, settings.registered_sigma,
                                    settings.trusted_sigma)
    wide = evidence_spans(normals, fit.weight, at_patches) > MOST_SPAN
    wide &= plan_sigma_of(by_walls) > settings.registered_sigma  # walls alone may fix the place
    status, reason = _bridged(status, reason, wide, say("no markings just before or after the patch"))
    if normals.met is not None:
        few = normals.met[piece] < LEAST_MET
        status, reason = _bridged(status, reason, few, say("few of the markings here are in the reference"))
    status, reason = _bridged(status, reason, opposed, say("the window here contradicts the correction"))
    status, reason = with_disagreements(status, reason, found, at_patches, beside)
    status, reason = with_conflict(status, reason, against)
    return Correction(windows.time, windows.chainage, value, covariance, status, reason, weight, residual,
                      normals.three_d, fit.drift_factor, fit.noise_factor, fit.heading_factor, chain.nodes, fit.state,
                      normals.active, settings.time_weight,
                      walls=wall_shares(by_paint, by_walls) if chain.held else None)


def _bridged(status: np.ndarray, reason: np.ndarray, mask: np.ndarray, why: str) -> tuple[np.ndarray, np.ndarray]:
    """Statuses and reasons with registered patches of a mask (n,) bridged."""
    changed = mask & (status == REGISTERED)
    return np.where(changed, BRIDGED, status).astype(np.int8), np.where(changed, why, reason)


def _with_shown_pitch(correction: Correction, stated: np.ndarray) -> Correction:
    """The correction with a pitch as accurate as roll and heading show it, of those `stated` (n, 3), degrees."""
    return replace(correction, covariance=with_shown_pitch(correction.value, correction.covariance, stated,
                                                           correction.heading_factor))


def _distrusted(correction: Correction, trajectory: Trajectory, beyond: bool,
                settings: CorrectionSettings) -> Correction:
    """The correction with patches distrusted where the trajectory is broken, or all of them beyond the search."""
    status, reason = correction.status.copy(), correction.reason.copy()
    for spans, extent, why in ((gaps(trajectory), 2 * settings.node_length, say("the trajectory has a gap here")),
                              (jumps(trajectory), settings.support_length, say("the trajectory jumps here"))):
        for start, end in spans:
            ends = np.interp([start, end], correction.time, correction.chainage) + np.array([-extent, extent])
            broken = (correction.chainage >= ends[0]) & (correction.chainage <= ends[1])
            status[broken], reason[broken] = DISTRUSTED, why
    reached = (np.abs(correction.value[:, :2]) > settings.search - _SEARCH_MARGIN).any(axis=1)
    if beyond or reached.mean() > _SEARCH_SHARE:
        status[:], reason[:] = DISTRUSTED, say("the correction reaches the largest error looked for")
    return replace(correction, status=status, reason=reason)
