"""From the windows' results to one correction, smooth or patch by patch, and the trajectory corrected by it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...progress import Progress
from ..markings.records import MarkingPoints
from ..trajectory import Trajectory
from .correction.adjustment import adjust_correction
from .correction.moved_markings import LEAST_BELIEVED, moved_markings, with_moved
from .correction.patch_corrections import Correction, correct_trajectory
from .correction.patchwise import correct_patchwise, patchwise_correction
from .correction.point_observations import PointObservations
from .records import WindowResults
from .run import RegistrationRun
from .start.reference import Reference
from .trajectory_stops import path_parameters_of
from .walls.witness import WallWitness


def corrected_path(windows: WindowResults, markings: MarkingPoints, trajectory: Trajectory, reference: Reference,
                   run: RegistrationRun, progress: Progress,
                   walls: WallWitness | None) -> tuple[Trajectory, Correction]:
    """The corrected trajectory and its correction: smooth by default, patch by patch as in the paper."""
    if run.windows.shared_windows:
        correction = _smooth_correction(windows, markings, trajectory, reference, run, progress, walls)
        return correct_trajectory(trajectory, correction), correction
    correction = patchwise_correction(windows, run.correction)
    return correct_patchwise(trajectory, windows, run.windows.patch_length), correction


def _smooth_correction(windows: WindowResults, markings: MarkingPoints, trajectory: Trajectory, reference: Reference,
                       run: RegistrationRun, progress: Progress, walls: WallWitness | None) -> Correction:
    """One smooth correction from the windows' results and the points themselves."""
    path_parameter = path_parameters_of(trajectory, run.correction.time_weight)
    points = None
    if run.windows.refinement:
        points = PointObservations.of(markings, trajectory, path_parameter, run.correction.node_length, reference,
                                      run.windows)
    settings = replace(run.correction, search=windows.search) if run.windows.start else run.correction
    if points is None:
        return adjust_correction(windows, trajectory, settings, None, progress)
    correction = adjust_correction(windows, trajectory, settings, points.about, progress, walls)
    believed = np.interp(points.path_parameter, np.interp(windows.time, trajectory.time, path_parameter),
                         np.nan_to_num(correction.weight)) > LEAST_BELIEVED
    return with_moved(correction, moved_markings(points, correction.along, believed))
