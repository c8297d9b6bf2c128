"""A survey's marking points as a file, with all attributes that they have in the survey."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import Executor

import laspy
import numpy as np

from ...io.points.decoded_points import decoded_once
from ...io.points.pointcloud import PointCloud, PointLayout, cloud_writer, iter_chunks, open_cloud
from ...progress import SILENT, Progress
from ..calibration import Calibration
from ..trajectory import Trajectory
from .extraction import CALIBRATED, DEFAULTS, WEIGHT, Extraction, ExtractionSettings
from .marking_stage import extract_markings


def markings_to_file(paths: Sequence[str | os.PathLike], output: str | os.PathLike, trajectory: Trajectory,
                     calibration: Calibration | None = None, settings: ExtractionSettings = DEFAULTS,
                     progress: Progress = SILENT, executor: Executor | None = None) -> Extraction:
    """Write a survey's marking points with all their attributes and `calibrated_intensity` and `marking_weight`.

    The points keep their order, times and places. See `extract_markings`.
    """
    cloud = open_cloud(paths)
    with decoded_once():
        extraction = extract_markings(cloud, trajectory, calibration, settings, progress.part(0.0, 0.75), executor)
        _write(cloud, output, extraction, progress.part(0.75, 1.0))
    return extraction


def _write(cloud: PointCloud, output: str | os.PathLike, extraction: Extraction, progress: Progress) -> None:
    layout = PointLayout(cloud)
    known = set(layout.header.point_format.dimension_names)
    layout.header.add_extra_dims([laspy.ExtraBytesParams(name, np.float32, text) for name, text in (
        (CALIBRATED, "intensity free of range"), (WEIGHT, "how surely paint, 0 to 1")) if name not in known])
    layout.dtype = layout.header.point_format.dtype()
    first = 0
    with cloud_writer(output, layout) as writer:
        for chunk in iter_chunks(cloud, progress):
            start, end = np.searchsorted(extraction.number, [first, first + len(chunk)])
            keep = np.zeros(len(chunk), dtype=bool)
            keep[extraction.number[start:end] - first] = True
            view = layout.view(layout.adapt(chunk, keep))
            view[CALIBRATED], view[WEIGHT] = extraction.intensity[start:end], extraction.points.weight[start:end]
            writer.write(view.array)
            first += len(chunk)
