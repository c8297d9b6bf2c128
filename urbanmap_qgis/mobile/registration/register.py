"""Registration of a survey's marking points to the aerial reference, window by window (J 3.2.4 and chapter 4).

Three steps: the best path through the scores of all shifts gives the start; on sections of a few hundred metres the
correction's course is adjusted, first to normal distributions (NDT) from coarse to fine, then to the sub-pixel
coverage; last, each patch's window is adjusted as a rigid body about that curve and says how well it is determined.
"""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import replace

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...progress import SILENT, Progress
from ...wording import say
from ..markings.records import MarkingPoints
from ..trajectory import Trajectory
from .matching.results import assemble
from .matching.rigid_windows import register_rigid_windows
from .matching.sections import adjusted_sections
from .matching.windows import choose_windows
from .records import RegistrationSettings, WindowResults
from .start.patch_points import thin_points
from .start.patches import divide_path
from .start.reference import Reference
from .start.start_search import at_border, search_start


def register_windows(markings: MarkingPoints, trajectory: Trajectory, reference: Reference,
                     settings: RegistrationSettings | None = None, progress: Progress = SILENT,
                     executor: Executor | None = None) -> WindowResults:
    """Correction of every patch of a survey.

    Parameters
    ----------
    markings : points on paint, in the reference's CRS (m); what was measured outside the trajectory is left out.
    trajectory : the reported one.
    reference : markings, and heights where `settings.three_d`.
    executor : sections are worked on by it; results do not depend on it.

    Raises
    ------
    InputError : the reference has no heights in 3D, or heights belong to another datum.
    InsufficientDataError : no marking point lies within the trajectory's time, or no reference marking near the path.
    """
    settings = settings or RegistrationSettings()
    if settings.three_d and not reference.has_heights:
        raise InputError(say("A registration in 3D needs the ground's heights: give a ground raster or marking "
                             "polygons with z."))
    patches = divide_path(trajectory, settings.patch_length)
    usable = trajectory.within(markings.time) & np.isfinite(markings.x + markings.y + markings.z)
    if not usable.any():
        raise InsufficientDataError(say("No marking point was measured within the trajectory's time: check that both "
                                        "are of one survey."))
    markings = markings.select(usable)
    windows = choose_windows(markings.x, markings.y, patches.number_at(markings.time), len(patches), settings)
    points = thin_points(markings, trajectory, patches, settings.subsampling)
    progress.step(0.1)
    start, search = search_start(points, patches, reference, settings, progress.part(0.1, 0.4), executor)
    settings = replace(settings, search=search)
    progress.step(0.4)
    if not settings.shared_windows:
        return register_rigid_windows(markings, patches, windows, start, reference, settings, progress.part(0.4, 1.0))
    adjusted = adjusted_sections(points, patches, windows, start, reference, settings, progress.part(0.4, 1.0),
                                 executor)
    return replace(assemble(patches, windows, start, adjusted, settings),
                   beyond=settings.start and at_border(start, search))
