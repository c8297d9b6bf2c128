"""Move a survey's points and image poses with its corrected trajectory (J 3.2.4.3): only coordinates change."""

from __future__ import annotations

import copy
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import BinaryIO

import laspy
import numpy as np

from ..errors import InputError, InsufficientDataError
from ..io.files.atomic import written_beside
from ..io.points.pointcloud import NAMES_NOT_ASCII, PointCloud, PointLayout, iter_chunks, open_cloud
from ..io.points.whole_records import copied_records
from ..progress import SILENT, Progress
from ..wording import say
from .gps_time import time_shift
from .image_poses import ImagePoses, move_images, read_image_poses, write_image_poses
from .pose_correction import PoseCorrection, correction_between
from .survey_tiles import CHUNK
from .trajectory import Trajectory

OUTSIDE = ("move", "keep", "refuse")
"""What is done with points that were measured before or after the trajectories: moved with the nearest pose, kept where
they are, or the run is refused."""

COARSEST_SCALE = 0.001
"""m: files stored coarser are written with this step, or the correction would be rounded away."""

_LARGEST = 2**31 - 1
_COPC = ("copc",)


@dataclass(frozen=True)
class CorrectionSummary:
    """What was done.

    Attributes
    ----------
    points : all points.
    outside : those without a pose in both trajectories.
    in_gaps : those measured in a gap of one.
    mean, largest : movement of the points that have poses, m.
    images, images_outside : image poses moved, and those of them without a pose of the trajectories.
    """

    points: int
    outside: int
    in_gaps: int
    mean: float
    largest: float
    images: int = 0
    images_outside: int = 0


def apply_correction(paths: Sequence[str | os.PathLike], reported: Trajectory, corrected: Trajectory,
                     output: str | os.PathLike, outside: str = "move",
                     progress: Progress = SILENT) -> CorrectionSummary:
    """Write a survey as the corrected trajectory places it; attributes, VLRs, EVLRs and the points' order are kept.

    Parameters
    ----------
    paths : LAS, LAZ or COPC files with gps_time; several are written as one, one after the other.
    output : LAZ or LAS file.
    outside : one of `OUTSIDE`.

    Raises
    ------
    InputError : cloud and trajectories do not overlap in time, or points lie outside and `outside` is "refuse".
    """
    if Path(output).suffix.lower() not in (".las", ".laz"):
        raise InputError(say("{output} must end in .laz or .las.", output=Path(output).name))
    cloud = open_cloud(paths)
    movement = correction_between(reported, corrected)
    shift = time_shift(cloud, reported)
    writing = _Writing(cloud, movement, progress)
    statistics = _Statistics()
    with written_beside(output) as temporary:
        compress = Path(output).suffix.lower() == ".laz"
        with laspy.open(temporary, mode="w", header=writing.header, do_compress=compress,
                        encoding_errors=NAMES_NOT_ASCII) as writer:
            for chunk in iter_chunks(cloud, progress, CHUNK):
                writer.write_points(writing.transformed(chunk, np.asarray(chunk.gps_time) + shift, outside, statistics))
            _write_evlrs(writer, _evlrs(cloud))
    moved = statistics.result()
    _report(moved, outside, progress)
    return moved


def apply_to_images(path: str | os.PathLike, reported: Trajectory, corrected: Trajectory,
                    output: str | os.PathLike, moved: CorrectionSummary,
                    progress: Progress = SILENT, counted: str = "degrees") -> CorrectionSummary:
    """Write image poses as the corrected trajectory gives them; `moved` with their numbers is given back.

    Images taken outside the trajectories move with the nearest pose. `counted` says how the table counts angles, one
    of `trajectory_reading.ANGLES`.

    Raises
    ------
    InputError : the table cannot be read, or no image was taken during the survey.
    """
    poses = read_image_poses(path, counted)
    start, end = max(reported.time[0], corrected.time[0]), min(reported.time[-1], corrected.time[-1])
    away = (poses.time < start) | (poses.time > end)
    if away.all():
        raise InputError(say("{path}: no image was taken between {start:.1f} and {end:.1f} s, the time of the "
                             "trajectory: give the poses of this survey.", path=Path(path).name, start=start, end=end))
    within: ImagePoses = replace(poses, time=np.clip(poses.time, start, end))
    write_image_poses(output, replace(move_images(within, reported, corrected), time=poses.time))
    if away.any():
        progress.warn(say("{away_count:,} of {away_count_2:,} images were taken outside the trajectory's time: they "
                          "were moved with its nearest pose.", away_count=np.count_nonzero(away),
                          away_count_2=len(away)))
    return replace(moved, images=len(away), images_outside=int(np.count_nonzero(away)))


class _Statistics:
    """Counts over the chunks."""

    def __init__(self):
        self.points = self.outside = self.in_gaps = 0
        self.total = self.largest = 0.0

    def add(self, movement: np.ndarray, within: np.ndarray, in_gap: np.ndarray) -> None:
        self.points += len(within)
        self.outside += int(np.count_nonzero(~within))
        self.in_gaps += int(np.count_nonzero(in_gap))
        if within.any():
            length = np.linalg.norm(movement[within], axis=1)
            self.total += float(length.sum(dtype=np.float64))
            self.largest = max(self.largest, float(length.max()))

    def result(self) -> CorrectionSummary:
        inside = self.points - self.outside
        if not inside:
            raise InsufficientDataError(say("No point was measured during the trajectory: give those of one survey."))
        return CorrectionSummary(self.points, self.outside, self.in_gaps, self.total / inside, self.largest)


class _Writing:
    """How the chunks of a cloud become records of the output."""

    def __init__(self, cloud: PointCloud, movement: PoseCorrection, progress: Progress):
        self.movement = movement
        self.layout = PointLayout(cloud) if len(cloud.paths) > 1 else None
        header = copy.deepcopy(self.layout.header if self.layout else cloud.headers[0])
        for number in reversed([k for k, vlr in enumerate(header.vlrs) if vlr.user_id in _COPC]):
            header.vlrs.pop(number)
        self.coarse = header.scales > COARSEST_SCALE
        margin = movement.max_displacement(np.stack([cloud.minimum, cloud.maximum])) + 1.0
        scales = np.where(self.coarse, COARSEST_SCALE, header.scales)
        offsets = header.offsets.copy()
        low, high = cloud.minimum - margin, cloud.maximum + margin
        far = np.maximum(np.abs(low - offsets), np.abs(high - offsets)) / scales > _LARGEST
        offsets[far] = np.floor(0.5 * (low + high))[far]
        if (np.maximum(high - offsets, offsets - low) / scales > _LARGEST).any():
            raise InputError(say("{paths} is too wide for coordinates in steps of {min:g} m: store it in tiles or "
                                 "with a coarser step.", paths=cloud.paths[0].name, min=scales.min()))
        if self.coarse.any():
            progress.warn(say("The coordinates are stored in steps of {max:g} m, too coarse for the correction: they "
                              "are written in steps of {coarsest_scale:g} m.", max=header.scales.max(),
                              coarsest_scale=COARSEST_SCALE))
        header.scales, header.offsets = scales, offsets
        self.header = header

    def transformed(self, chunk: laspy.ScaleAwarePointRecord, time: np.ndarray, outside: str,
                    statistics: _Statistics) -> laspy.PackedPointRecord:
        """The chunk's records with new coordinates."""
        within = self.movement.within(time)
        if outside == "refuse" and not within.all():
            raise InputError(say("Points were measured at {time:.3f} s, outside the trajectory ({time_2:.3f} to "
                                 "{time_3:.3f} s): give the trajectory of the whole survey, or let them be moved "
                                 "with the nearest pose.", time=time[~within][0], time_2=self.movement.time[0],
                                 time_3=self.movement.time[-1]))
        places = np.column_stack([chunk.x, chunk.y, chunk.z])
        movement = self.movement.translations(places, time)
        if outside == "keep":
            movement[~within] = 0.0
        statistics.add(movement, within, self.movement.in_gap(time))
        records = self.layout.adapt(chunk, np.ones(len(chunk), bool)) if self.layout else copied_records(chunk.array)
        same = np.array_equal(chunk.scales, self.header.scales) and np.array_equal(chunk.offsets, self.header.offsets)
        for axis, name in enumerate("XYZ"):
            if same:  # added in the file's own steps, nothing that does not move is rounded
                values = chunk.array[name].astype(np.int64) + np.rint(movement[:, axis] / self.header.scales[axis])
            else:
                values = np.rint((places[:, axis] + movement[:, axis] - self.header.offsets[axis])
                                 / self.header.scales[axis])
            if len(values) and np.abs(values).max() > _LARGEST:
                raise InputError(say("A point lies outside the bounds that the header of its file states: repair the "
                                     "header (lasinfo -repair)."))
            records[name] = values.astype(np.int32)
        return laspy.PackedPointRecord(records, self.header.point_format)


def _evlrs(cloud: PointCloud) -> list:
    """Extended records of all files, each once; those of COPC's octree hold no more."""
    found = []
    for path in cloud.paths:
        with laspy.open(path) as reader:
            for record in reader.evlrs or ():
                twin = any(record.user_id == other.user_id and record.record_id == other.record_id
                           and record.record_data_bytes() == other.record_data_bytes() for other in found)
                if record.user_id not in _COPC and not twin:
                    found.append(record)
    return found


class _ExtendedRecords(laspy.vlrs.vlrlist.VLRList):
    """Extended records whose names need not be ASCII: laspy's writer does not hand on how such are written."""

    def write_to(self, stream: BinaryIO, as_extended: bool = True, encoding_errors: str = NAMES_NOT_ASCII) -> None:
        super().write_to(stream, as_extended, encoding_errors)


def _write_evlrs(writer: laspy.LasWriter, records: list) -> None:
    """Append extended records; the header is told where waveforms begin."""
    if not records:
        return
    extended = _ExtendedRecords()
    extended.extend(records)
    writer.write_evlrs(extended)
    place = writer.header.start_of_first_evlr
    for record in records:
        if record.user_id == "LASF_Spec" and record.record_id == 65535:
            writer.header.start_of_waveform_data_packet_record = place
        place += 60 + len(record.record_data_bytes())


def _report(moved: CorrectionSummary, outside: str, progress: Progress) -> None:
    if moved.outside:
        done = say("moved with its nearest pose") if outside == "move" else say("left where they were")
        progress.warn(say("{outside:,} of {points:,} points were measured outside the trajectory's time: they were "
                          "{done} and are not to be trusted.", outside=moved.outside, points=moved.points, done=done))
    if moved.in_gaps:
        progress.warn(say("{in_gaps:,} of {points:,} points were measured in gaps of the trajectory: they were moved "
                          "by what lies between the gap's ends and are not to be trusted.", in_gaps=moved.in_gaps,
                          points=moved.points))
