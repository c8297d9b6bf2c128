"""Drives of surveys as lane maps take them."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.declaring.parameters import tr
from ..framework.layers.trajectories import trajectory_exists, trajectory_of


def _files(stage, parameters, context) -> list[str]:
    return [text for text in stage.parameterAsFileList(parameters, "TRAJECTORY", context) if text]


def check_drives(stage, parameters, context) -> None:
    """Refuse trajectories that are not there."""
    for text in _files(stage, parameters, context):
        if not trajectory_exists(text, context):
            raise InputError(tr("{0}: the file {1} does not exist; check its name.").format(
                stage.label_of("TRAJECTORY"), text))


def read_drives(stage, parameters, context, crs_wkt, progress) -> list:
    """The core's drives of all trajectories, in the CRS of the lines."""
    from ...urbanmap_qgis.roadmap.map_records import DrivenPath

    drives = []
    for text in _files(stage, parameters, context):
        read = trajectory_of(text, stage.label_of("TRAJECTORY"), context, crs_wkt)
        if read.crs_wkt:
            stage.same_crs("LINES", crs_wkt, "TRAJECTORY", read.crs_wkt)
        for note in read.notes:
            progress.warn(note)
        drives.append(DrivenPath(read.trajectory.place))
    return drives
