"""One smooth correction of the trajectory from the windows' results: no step between patches, with honest sigma.

Windows give evidence on the error near their patches (J 3.2.4.3). Here it is adjusted together with a model of how the
error drifts, robustly: sections whose observations contradict the rest lose their weight, gaps are bridged, and each
patch says how its correction was found.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from ....progress import SILENT, Progress
from ...trajectory import Trajectory, path_chainage
from ..records import WindowResults
from .chain import NodeChain, nodes_along
from .error_steps import unseen_steps, window_steps
from .fast_changes import fast_changes, with_silences, with_steps, with_undecided
from .gauss_markov import path_parameters_of
from .normal_equations import normal_equations_of
from .patch_corrections import (
    Correction,
    correction_at_patches,
    with_distrusted,
    with_plan_noise,
    with_shown_pitch,
)
from .patch_status import only_own_mode_fits
from .robust_fit import Evaluate, chain_likelihood, onto_points, robust_fit
from .second_witness import Witness, WitnessConflict, where_walls_want_it, with_upright_walls, with_witness
from .settings import CorrectionSettings
from .side_slip import SideSlip, with_denied_gaps


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
    chain = NodeChain(normals, nodes, trajectory, path_parameter,
                   *window_steps(windows, np.interp(nodes, at_patches, windows.chainage), settings.min_margin,
                                 trajectory))
    sure = windows.margin >= settings.min_margin
    allowed = np.where(sure, 1.0, 0.0) if (sure & normals.present).any() else np.ones(len(windows))
    fit = robust_fit(chain, model, allowed, settings, progress.part(0.0, 0.4))
    doubtful = normals.present & ~sure
    if doubtful.any() and (allowed == 0).any():
        value, covariance = chain.interpolate(fit.state, fit.covariance, at_patches)
        agreeing = doubtful & only_own_mode_fits(windows, value, covariance, settings)
        if agreeing.any():
            allowed, doubtful = np.where(agreeing, 1.0, allowed), doubtful & ~agreeing
            fit = robust_fit(chain, model, allowed, settings, progress.part(0.4, 0.5))
    if walls is not None:
        agreeing = doubtful & where_walls_want_it(walls, chain, fit, model, windows, at_patches, settings)
        allowed, doubtful = np.where(agreeing, 1.0, allowed), doubtful & ~agreeing
    if points is not None:
        at_nodes = np.interp(chain.nodes, at_patches, allowed)
        chain, fit = onto_points(points, chain, fit, model, at_nodes, settings, progress.part(0.5, 1.0))
    model = model.scaled(fit.drift_factor).with_heading(fit.heading_factor)
    slip = SideSlip.of(trajectory, path_parameter)
    at_nodes = np.interp(chain.nodes, at_patches, allowed)
    changes = fast_changes(chain, fit, model, at_nodes, partial(chain_likelihood, settings=settings))
    found = with_steps(chain, fit, model, at_nodes, changes, points, settings)
    found, conflict = with_witness(walls, found, model) if walls is not None else (found, WitnessConflict(()))
    found = with_undecided(with_denied_gaps(found, slip), changes, model, slip)
    found = with_silences(found, model, at_patches, windows.correction[:, :2])
    found, model = with_upright_walls(walls, found, model) if walls is not None else (found, model)
    unseen = unseen_steps(found.chain, model, found.fit, found.all_steps)
    found = replace(found, fit=with_plan_noise(found.chain, found.fit, model, points is not None))
    correction = correction_at_patches(windows, found, at_patches, doubtful, settings, conflict, unseen, model)
    if correction.three_d:
        correction = with_shown_pitch(correction, _angle_sigma(trajectory, path_parameter, at_patches, settings))
    steps = (*found.listed(partial(_along, trajectory, path_parameter)),
             *conflict.listed(windows.chainage, windows.time))
    correction = replace(correction, steps=tuple(sorted(steps, key=lambda step: step.place)))
    # Walls hold the survey where few markings let the start wander off.
    return with_distrusted(correction, trajectory, windows.beyond and found.chain.held is None, settings)


def _angle_sigma(trajectory: Trajectory, path_parameter: np.ndarray, nodes: np.ndarray,
                 settings: CorrectionSettings) -> np.ndarray:
    """(k, 3) degrees, accuracy of the reported angles at nodes (k,): the trajectory's own, or as the settings say."""
    if trajectory.angle_sigma is None:
        return np.tile(np.array(settings.attitude_sigma), (len(nodes), 1))
    return np.column_stack([np.interp(nodes, path_parameter, axis) for axis in trajectory.angle_sigma.T])


def _along(trajectory: Trajectory, path_parameter: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Chainages, m, and times, s, at path parameters (n,)."""
    return (np.interp(at, path_parameter, path_chainage(trajectory)), np.interp(at, path_parameter, trajectory.time))
