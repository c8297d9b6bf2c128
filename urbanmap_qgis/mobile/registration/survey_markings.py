"""Marking points of a survey's files, in its trajectory's time (J 3.2.3)."""

from __future__ import annotations

from concurrent.futures import Executor

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...io.points.pointcloud import PointCloud, iter_chunks
from ...progress import SILENT, Progress
from ...wording import say
from ..calibration import Calibration
from ..gps_time import time_shift
from ..markings.extraction import WEIGHT, ExtractionSettings
from ..markings.marking_stage import extract_markings
from ..markings.records import MarkingPoints
from ..trajectory import Trajectory


def survey_markings(cloud: PointCloud, trajectory: Trajectory, settings: ExtractionSettings,
                    calibration: Calibration | None, progress: Progress = SILENT,
                    executor: Executor | None = None) -> MarkingPoints:
    """Marking points of a cloud in the trajectory's time: the cloud's own, or extracted from a survey."""
    if cloud.has_dimension(WEIGHT):
        return _read_markings(cloud, trajectory, progress)
    progress.message(say("Taking road markings out of the survey."))
    extraction = extract_markings(cloud, trajectory, calibration, settings, progress, executor)
    if not len(extraction.points):
        raise InsufficientDataError(say("No road marking was found in the survey: check its intensities with “Road "
                                        "markings of a mobile survey”."))
    return extraction.points


def _read_markings(cloud: PointCloud, trajectory: Trajectory, progress: Progress) -> MarkingPoints:
    shift = time_shift(cloud, trajectory)
    columns: dict[str, list[np.ndarray]] = {name: [] for name in ("x", "y", "z", "gps_time", WEIGHT, "point_source_id")}
    for chunk in iter_chunks(cloud, progress):
        for name, pieces in columns.items():
            pieces.append(np.asarray(chunk[name], np.float64))
    x, y, z, time, weight, source = (np.concatenate(pieces) for pieces in columns.values())
    if not np.isfinite(weight).all() or (weight < 0).any():
        raise InputError(say("The attribute {weight} of {paths} holds values below 0: give markings as “Road "
                             "markings of a mobile survey” writes them, or the survey itself.", weight=WEIGHT,
                             paths=cloud.paths[0].name))
    return MarkingPoints(x, y, z, time + shift, weight, source.astype(np.int64))
