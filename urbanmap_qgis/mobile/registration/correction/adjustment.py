"""One smooth correction of the trajectory from the windows' results: no step between patches, with honest sigma.

Windows give evidence on the error near their patches (J 3.2.4.3). Here it is adjusted together with a model of how the
error drifts, robustly: sections whose observations contradict the rest lose their weight, gaps are bridged, and each
patch says how its correction was found.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from ....estimation.chain import NodeChain, nodes_along
from ....estimation.error_model import PoseErrorModel
from ....progress import SILENT, Progress
from ...trajectory import Trajectory, path_chainage
from ..records import WindowResults
from ..trajectory_stops import links_along, path_parameters_of
from .patch_corrections import (
    Correction,
    correction_at_patches,
    with_distrusted,
    with_plan_noise,
    with_shown_pitch,
)
from .patch_status import only_own_mode_fits
from .reference_steps import Adjusted, PlacedStep, loose_changes, path_steps
from .robust_fit import LIMITS, Evaluate, Fit, onto_points, reweighted_fit, robust_fit
from .second_witness import Witness, WitnessConflict, where_walls_want_it, with_upright_walls, with_witness
from .settings import CorrectionSettings
from .side_slip import SideSlip
from .window_factors import normal_equations_of


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
    at_patches, nodes = normals.path_parameter, nodes_along(path_parameter, settings.node_length)
    model = settings.error_model(_angle_sigma(trajectory, path_parameter, nodes, settings))
    rising = np.concatenate([[True], np.diff(path_parameter) > 0])
    chain = NodeChain(normals, nodes, links_along(trajectory, np.interp(nodes, path_parameter[rising],
                                                                        trajectory.time[rising])))
    sure = windows.margin >= settings.min_margin
    allowed = np.where(sure, 1.0, 0.0) if (sure & normals.present).any() else np.ones(len(windows))
    chain, fit, steps = _followed(chain, model, allowed, settings, progress.part(0.0, 0.4))
    doubtful = normals.present & ~sure
    if doubtful.any() and (allowed == 0).any():
        value, covariance = chain.interpolate(fit.state, fit.covariance, at_patches)
        agreeing = doubtful & only_own_mode_fits(windows, value, covariance, settings)
        if agreeing.any():
            allowed, doubtful = np.where(agreeing, 1.0, allowed), doubtful & ~agreeing
            chain, fit, steps = _followed(chain, model, allowed, settings, progress.part(0.4, 0.5))
    if walls is not None:
        agreeing = doubtful & where_walls_want_it(walls, chain, fit, model, windows, at_patches, settings)
        allowed, doubtful = np.where(agreeing, 1.0, allowed), doubtful & ~agreeing
    if points is not None:
        at_nodes = np.interp(chain.nodes, at_patches, allowed)
        chain, fit = onto_points(points, chain, fit, model, at_nodes, settings, progress.part(0.5, 1.0))
    model = model.scaled(fit.drift_factor).with_heading(fit.heading_factor)
    found = Adjusted(chain, fit, *path_steps(chain, model, fit.weight / fit.noise_factor, known=steps)).judged(
        SideSlip.of(trajectory, path_parameter))
    found = found if settings.reference_steps else found.of_drives()
    found, conflict = with_witness(walls, found, model) if walls is not None else (found, WitnessConflict(()))
    found, model = with_upright_walls(walls, found, model) if walls is not None else (found, model)
    found = replace(found, fit=with_plan_noise(found.chain, found.fit, model, points is not None))
    correction = correction_at_patches(windows, found, at_patches, doubtful, settings, conflict, model)
    if correction.three_d:
        correction = with_shown_pitch(correction, _angle_sigma(trajectory, path_parameter, at_patches, settings))
    listed = (*found.listed(partial(_along, trajectory, path_parameter)),
              *conflict.listed(windows.chainage, windows.time))
    correction = replace(correction, steps=tuple(sorted(listed, key=lambda step: step.place)))
    # Walls hold the survey where few markings let the start wander off.
    return with_distrusted(correction, trajectory, windows.beyond and found.chain.held is None, settings)


_LIVELY = 4.0  # times the usual drift, which no step is to be taken for


def _followed(chain: NodeChain, model: PoseErrorModel, allowed: np.ndarray, settings: CorrectionSettings,
              progress: Progress) -> tuple[NodeChain, Fit, list[PlacedStep]]:
    """The chain that follows the windows over the steps that they show, its fit, and the steps in plan.

    Large steps first, so that they do not pass for a lively drift; then those that stand out from the drift as found.
    """
    weight = allowed * chain.normals.present
    chain, _ = _with_changes(chain, model.scaled(_LIVELY), weight)
    fit = robust_fit(chain, model, allowed, settings, progress)
    model = model.scaled(fit.drift_factor).with_heading(fit.heading_factor)
    chain, steps = _with_changes(chain, model, weight / max(fit.found_noise, LIMITS.min_noise))
    again = reweighted_fit(chain, model, allowed, settings)[0]
    return chain, replace(again, drift_factor=fit.drift_factor, heading_factor=fit.heading_factor), steps


def _with_changes(chain: NodeChain, model: PoseErrorModel, weight: np.ndarray) -> tuple[NodeChain, list[PlacedStep]]:
    """The chain that may change over the steps in plan and in height that it shows, and those in plan."""
    axes = ((0, 1), (2,)) if chain.normals.three_d else ((0, 1),)
    steps = [path_steps(chain, model, weight, some)[0] for some in axes]
    return chain.with_fast(*(loose_changes(each, len(chain.nodes) - 1) for each in steps)), steps[0]


def _angle_sigma(trajectory: Trajectory, path_parameter: np.ndarray, nodes: np.ndarray,
                 settings: CorrectionSettings) -> np.ndarray:
    """(k, 3) degrees, accuracy of the reported angles at nodes (k,): the trajectory's own, or as the settings say."""
    if trajectory.angle_sigma is None:
        return np.tile(np.array(settings.attitude_sigma), (len(nodes), 1))
    return np.column_stack([np.interp(nodes, path_parameter, axis) for axis in trajectory.angle_sigma.T])


def _along(trajectory: Trajectory, path_parameter: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Chainages, m, and times, s, at path parameters (n,)."""
    return (np.interp(at, path_parameter, path_chainage(trajectory)), np.interp(at, path_parameter, trajectory.time))
