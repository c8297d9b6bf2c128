"""The correction at the patches: how accurate it is there, how it was found, and whether it is to be trusted."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ....estimation.chain import NodeChain, smooth_between
from ....estimation.error_model import PoseErrorModel
from ....estimation.latent_steps import UnseenSteps
from ....wording import say
from ...trajectory import Trajectory, gaps, jumps
from ..records import WindowResults
from ..trajectory_stops import path_parameters_of
from .patch_status import (
    BRIDGED,
    DISTRUSTED,
    LEAST_MET,
    MOST_SPAN,
    REGISTERED,
    evidence_spans,
    own_information,
    patch_statuses,
    plan_sigma,
    plan_sigma_of,
)
from .reference_steps import Adjusted, CorrectionStep
from .robust_fit import Fit
from .second_witness import WitnessConflict, settled_offset, wall_shares, with_conflict
from .settings import CorrectionSettings


@dataclass(frozen=True)
class PatchCorrectionLimits:
    """Limits of the correction at the patches, each with its unit."""

    around_step: float = 20.0  # m from a step within which quiet evidence is not believed
    on_step: float = 10.0  # m from a step within which a patch counts as on it
    step_support: float = 5.0  # m of path to either side whose markings must fix a patch on a step
    beside_jump: float = 15.0  # m of path to either side of a trajectory's jump that are not trusted
    # Of the stated variance in plan, whatever the survey says: by points, and by windows, which look quiet as they
    # share theirs.
    min_reported: float = 0.05
    min_of_windows: float = 0.6
    search_margin: float = 0.4  # m from the largest error looked for
    search_share: float = 0.02  # of the patches that may be there
    fix: float = 20.0  # m without markings: a fix of the drive takes as much, and shows at an end
    determined: float = 0.5  # of the stated variance: an angle that keeps less of it was measured


LIMITS = PatchCorrectionLimits()

_ROLL, _PITCH, _HEADING = 3, 4, 5


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
    unseen : steps of the reference that nothing would show; the covariance has them. None where nobody asked.
    unseen_variance : (n, 2, 2) m2 of the covariance in plan that is theirs.
    reference_sigma : m in plan, what the reference itself was said to be off by; the covariance has it. NaN where it is
        a floor only (J's patches).
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
    unseen: UnseenSteps | None = None
    unseen_variance: np.ndarray | None = None
    reference_sigma: float = np.nan

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

    def relative_sigma(self) -> np.ndarray | None:
        """(n,) the same relative to the reference: without what that may be off by itself; None where not known."""
        if self.unseen is None:
            return None
        return plan_sigma(self.covariance[:, :2, :2] - self.unseen_variance - self.reference_sigma**2 * np.eye(2))


def correct_trajectory(trajectory: Trajectory, correction: Correction) -> Trajectory:
    """The trajectory with the correction at all its epochs; before the first and after the last node it is rigid."""
    path_parameter = path_parameters_of(trajectory, correction._time_weight)
    change = correction.along(path_parameter)
    return Trajectory(trajectory.time, trajectory.place + change[:, :3], trajectory.angles + change[:, 3:])


def with_plan_noise(chain: NodeChain, fit: Fit, model: PoseErrorModel, on_points: bool) -> Fit:
    """The fit with covariances in plan by the noise that the blocks' contradictions show."""
    least = LIMITS.min_reported if on_points else LIMITS.min_of_windows
    noise = np.where(chain.fast_near(chain.normals.path_parameter, LIMITS.around_step), max(fit.found_noise, 1.0),
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


def correction_at_patches(windows: WindowResults, found: Adjusted, at_patches: np.ndarray, doubtful: np.ndarray,
                          settings: CorrectionSettings, conflict: WitnessConflict,
                          model: PoseErrorModel) -> Correction:
    """The correction at the patches with its quality."""
    chain, fit, n, unseen = found.chain, found.fit, len(windows), found.unseen
    normals = chain.normals
    active = list(normals.active)
    value, covariance = np.zeros((n, 6)), np.full((n, 6, 6), np.nan)
    state = fit.state.copy()
    state[:, :2, 0] -= found.changes(chain.nodes)
    value[:, active], spread = chain.interpolate(state, fit.covariance, at_patches)
    floor = np.zeros(6)
    floor[:2], floor[2] = settings.reference_sigma**2, settings.reference_sigma_z**2
    covariance[np.ix_(range(n), active, active)] = spread + np.diag(floor[active])
    covariance[:, range(3), range(3)] += settings.rounding_variance
    piece = np.searchsorted(0.5 * (normals.path_parameter[1:] + normals.path_parameter[:-1]), at_patches)
    weight = np.where(normals.present, fit.weight, np.nan)[piece]
    weight[found.changes(at_patches).any(axis=1)] *= 0.0  # of markings that lie elsewhere
    residual = windows.correction - value
    spans = evidence_spans(normals, fit.weight, at_patches)
    wide = spans > MOST_SPAN
    if chain.held is not None:  # where no markings are, walls hold the place, and the windows reach for others
        doubtful = doubtful & ~wide
    if windows.spread is not None:
        covariance[doubtful, :2, :2] += windows.spread[doubtful]
    against, either = conflict.mask_and_variance(windows.chainage)
    covariance[:, :2, :2] += found.variance(at_patches) + either
    # whether markings fix a place does not hang on how far the reference may be off
    relative = plan_sigma(covariance[:, :2, :2] - np.diag(floor[:2]))
    by_unseen = unseen.followed(chain.shift_response(model, fit.weight / fit.noise_factor, at_patches), at_patches)
    covariance[:, :2, :2] += by_unseen
    support = np.where(chain.fast_near(at_patches, LIMITS.on_step), LIMITS.step_support, settings.support_length)
    by_paint = own_information(normals, fit.weight / fit.noise_factor, at_patches, support)
    by_walls = chain.held.plan_information(at_patches, support) if chain.held else np.zeros_like(by_paint)
    near_walls = np.where(np.einsum("nii->n", by_walls) > 0, relative, np.inf)
    by_own_windows = np.minimum(plan_sigma_of(by_paint + by_walls), near_walls)
    status, reason = patch_statuses(by_own_windows, weight, relative, doubtful, settings.registered_sigma,
                                    settings.trusted_sigma)
    wide &= (spans > LIMITS.fix) & (near_walls > settings.registered_sigma)  # walls alone may fix the place
    status, reason = _bridged(status, reason, wide, say("no markings just before or after the patch"))
    if normals.met is not None:
        few = (normals.met[piece] < LEAST_MET) & (near_walls > settings.registered_sigma)
        status, reason = _bridged(status, reason, few, say("few of the markings here are in the reference"))
    status, reason = found.statuses(status, reason, at_patches)
    status, reason = with_conflict(status, reason, against)
    return Correction(windows.time, windows.chainage, value, covariance, status, reason, weight, residual,
                      normals.three_d, fit.drift_factor, fit.noise_factor, fit.heading_factor, chain.nodes, state,
                      normals.active, settings.time_weight,
                      walls=wall_shares(by_paint, by_walls) if chain.held else None, unseen=unseen,
                      unseen_variance=by_unseen, reference_sigma=settings.reference_sigma)


def _bridged(status: np.ndarray, reason: np.ndarray, mask: np.ndarray, why: str) -> tuple[np.ndarray, np.ndarray]:
    """Statuses and reasons with registered patches of a mask (n,) bridged."""
    changed = mask & (status == REGISTERED)
    return np.where(changed, BRIDGED, status).astype(np.int8), np.where(changed, why, reason)


def shown_factor(value: np.ndarray, covariance: np.ndarray, stated: np.ndarray) -> float:
    """How many times as large as stated the errors of the measured angles are, 1 at least and where none was measured.

    Parameters
    ----------
    value : (n,) degrees, corrections of one angle.
    covariance : (n,) degrees2, their variances.
    stated : (n,) degrees, standard deviations before.
    """
    measured = covariance < LIMITS.determined * stated**2
    if not measured.any():
        return 1.0
    share = (value[measured] ** 2 + covariance[measured]) / stated[measured] ** 2
    return max(1.0, float(np.sqrt(share.mean())))


def with_shown_pitch(correction: Correction, stated: np.ndarray) -> Correction:
    """The correction with a pitch that is as accurate as roll and heading show the unit to be.

    The points of a scanner lie in one line ahead of or behind the vehicle: the ground tells the roll, the markings tell
    the heading, but the pitch mostly keeps what was reported, and with it the accuracy that was stated. One unit
    measures all three: where roll or heading were off by more than stated, the pitch is taken for as much worse. A
    heading that was let loose is a misaligned unit's, and shows nothing.

    `stated` : (n, 3) degrees, of roll, pitch and heading before.
    """
    value, variance = correction.value, np.einsum("nii->ni", correction.covariance)
    factors = [shown_factor(value[:, _ROLL], variance[:, _ROLL], stated[:, 0])]
    if correction.heading_factor == 1.0:
        factors.append(shown_factor(value[:, _HEADING], variance[:, _HEADING], stated[:, 2]))
    undetermined = variance[:, _PITCH] >= LIMITS.determined * stated[:, 1] ** 2
    size = np.ones(variance.shape)
    size[undetermined, _PITCH] = max(factors)
    return replace(correction, covariance=correction.covariance * size[:, :, None] * size[:, None, :])


def with_distrusted(correction: Correction, trajectory: Trajectory, beyond: bool,
                     settings: CorrectionSettings) -> Correction:
    """The correction with patches distrusted where the trajectory is broken, or all of them beyond the search."""
    status, reason = correction.status.copy(), correction.reason.copy()
    for spans, extent, why in ((gaps(trajectory), 2 * settings.node_length, say("the trajectory has a gap here")),
                              (jumps(trajectory), LIMITS.beside_jump, say("the trajectory jumps here"))):
        for start, end in spans:
            ends = np.interp([start, end], correction.time, correction.chainage) + np.array([-extent, extent])
            broken = (correction.chainage >= ends[0]) & (correction.chainage <= ends[1])
            status[broken], reason[broken] = DISTRUSTED, why
    reached = (np.abs(correction.value[:, :2]) > settings.search - LIMITS.search_margin).any(axis=1)
    if beyond or reached.mean() > LIMITS.search_share:
        status[:], reason[:] = DISTRUSTED, say("the correction reaches the largest error looked for")
    return replace(correction, status=status, reason=reason)
