"""Raw range scans placed in the map with trajectory and calibration (Z 2.2, eq. 1 and 4 to 7).

A return at angle a and range r lies at r (cos a, sin a, 0) in the scanner's axes, and in the map at
P = p(t) + R(t) (lever arm + R_bs r (cos a, sin a, 0)), position and unwrapped angles linear between epochs. This is
Z eq. 1 in our axes; Z counts from others, see docs/lines.md.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np
from pyproj import CRS

from ...errors import InputError, InsufficientDataError
from ...io.files.atomic import written_beside
from ...progress import SILENT, Progress
from ...settings.lines import ScanSettings
from ...wording import say
from ..calibration import Calibration, MountedScanner, scanner_of
from ..gps_time import WEEK, shift_between
from ..trajectory import Trajectory, body_to_map, gaps
from .line_camera import mount_matrix
from .range_scans import RangeScans, read_scans

MAX_GAP = 1.0  # s: between epochs farther apart nothing is placed.
SCALE = 0.001
MIN_ROWS_FOR_RADIANS = 1000


@dataclass(frozen=True)
class GeoreferencedScans:
    """What was done with the returns of a run.

    Attributes
    ----------
    read, written : returns.
    no_return : without a usable range or angle.
    too_near, too_far : outside the limits of range.
    outside : before or after the trajectory, or in a gap of it.
    by_scanner : points written by scanner number.
    shift : s added to the scans' times.
    """

    read: int
    written: int
    no_return: int
    too_near: int
    too_far: int
    outside: int
    by_scanner: Mapping[int, int]
    shift: float


def place_ranges(trajectory: Trajectory, scanner: MountedScanner, time: np.ndarray, angle: np.ndarray,
                 distance: np.ndarray) -> np.ndarray:
    """Points (n, 3) in the map of returns at times (n,) s, angles (n,) degrees and ranges (n,) m (Z eq. 1).

    Raises
    ------
    InputError : a time lies outside the trajectory.
    """
    angle_rad = np.radians(angle)
    axes = mount_matrix(scanner.angles)
    along_x, along_y = distance * np.cos(angle_rad), distance * np.sin(angle_rad)
    body = np.empty((len(angle_rad), 3))
    for axis in range(3):
        body[:, axis] = scanner.lever_arm[axis] + axes[axis, 0] * along_x + axes[axis, 1] * along_y
    return body_to_map(trajectory, time, body)


def georeference_scans(paths: Sequence[str | os.PathLike], trajectory: Trajectory, calibration: Calibration,
                       output: str | os.PathLike, crs_wkt: str | None = None, settings: ScanSettings | None = None,
                       progress: Progress = SILENT) -> GeoreferencedScans:
    """Place raw range scans and write them as LAZ (or LAS) with gps_time, intensity, point_source_id, angle and range.

    Returns outside the trajectory's time or in its gaps, without a range, or outside the limits of range are left
    out and counted. The points' times are the trajectory's.

    Raises
    ------
    InputError : a scanner is missing in the calibration, a file cannot be read, or its times fit no trajectory.
    InsufficientDataError : not one return can be placed.
    """
    settings = settings or ScanSettings()
    if Path(output).suffix.lower() not in (".las", ".laz"):
        raise InputError(say("{output} must end in .laz or .las.", output=Path(output).name))
    work = _Georeferencer(trajectory, calibration, settings, progress)
    with (written_beside(output) as temporary,
          laspy.open(temporary, mode="w", header=_header(trajectory, crs_wkt),
                     do_compress=Path(output).suffix.lower() == ".laz") as writer):
        for scans in read_scans(paths, settings.radians, progress):
            points, returns = work.georeference(scans)
            if len(returns):
                writer.write_points(_records(writer.header, points, returns))
            progress.check()
        return work.placed()


class _Georeferencer:
    """Places chunk after chunk and counts what is left out."""

    def __init__(self, trajectory: Trajectory, calibration: Calibration, settings: ScanSettings, progress: Progress):
        self.trajectory, self.calibration, self.settings, self.progress = trajectory, calibration, settings, progress
        self.shift: float | None = None
        self.span = [np.inf, -np.inf]
        self.counts = dict.fromkeys(("read", "no_return", "too_near", "too_far", "outside"), 0)
        self.by_scanner: dict[int, int] = {}
        self.holes = gaps(trajectory, MAX_GAP)

    def georeference(self, scans: RangeScans) -> tuple[np.ndarray, RangeScans]:
        """Points (m, 3) and returns of a chunk that can be placed; their scanner numbers are the calibration's."""
        self._count(scans)
        sound = np.isfinite(scans.time) & np.isfinite(scans.angle) & np.isfinite(scans.distance) & (scans.distance > 0)
        scans = self._select(scans, sound, "no_return")
        if not len(scans):
            return np.empty((0, 3)), scans
        time = self._times(scans.time)
        inside = self.trajectory.within(time)
        for start, end in self.holes:
            inside &= (time <= start) | (time >= end)
        scans = self._select(scans, inside, "outside")
        scans = self._select(scans, scans.distance >= self.settings.min_range, "too_near")
        parts = [self._of_scanner(scans, number) for number in np.unique(scans.scanner)]
        if not parts:
            return np.empty((0, 3)), scans
        points, row, number = (np.concatenate(column) for column in zip(*parts))
        order = np.argsort(row)
        row = row[order]
        returns = RangeScans(self._times(scans.time[row]), scans.angle[row], scans.distance[row], scans.intensity[row],
                             number[order])
        return points[order], returns

    def _of_scanner(self, scans: RangeScans, number: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Points, their rows in the chunk and scanner numbers of the returns of one scanner within its range."""
        scanner = self._scanner(int(number))
        of_scanner = np.flatnonzero(scans.scanner == number)
        limit = self.settings.max_range or scanner.max_range
        near = of_scanner[scans.distance[of_scanner] <= limit]
        self.counts["too_far"] += len(of_scanner) - len(near)
        points = place_ranges(self.trajectory, scanner, self._times(scans.time[near]), scans.angle[near],
                              scans.distance[near])
        source = int(number) if scanner.point_source_id is None else scanner.point_source_id
        source = max(source, 0)
        self.by_scanner[source] = self.by_scanner.get(source, 0) + len(near)
        return points, near, np.full(len(near), source)

    def _scanner(self, number: int) -> MountedScanner:
        """The scanner of a number; the only one where the files name none."""
        if number >= 0:
            return scanner_of(self.calibration, number)
        if len(self.calibration.scanners) != 1:
            raise InputError(say("The range scans do not say which scanner measured them, and the calibration has "
                                 "{scanners_count}: add a column scanner.",
                                 scanners_count=len(self.calibration.scanners)))
        return self.calibration.scanners[0]

    def _times(self, time: np.ndarray) -> np.ndarray:
        """Times of the files as the trajectory counts them; the shift is found at the first that fit it."""
        if self.shift is not None:
            return time + self.shift
        wanted = float(self.trajectory.time[0]), float(self.trajectory.time[-1])
        for moment in (float(np.median(time)), float(time.max()), float(time.min())):
            try:
                self.shift = shift_between((moment, moment), wanted, "The range scans")
            except InputError:
                continue
            return time + self.shift
        return time

    def _select(self, scans: RangeScans, keep: np.ndarray, reason: str) -> RangeScans:
        lost = len(keep) - int(np.count_nonzero(keep))
        self.counts[reason] += lost
        return scans.of(keep) if lost else scans

    def _count(self, scans: RangeScans) -> None:
        """Count, and tell once where angles look like radians."""
        time = scans.time[np.isfinite(scans.time)]
        if len(time):
            self.span = [min(self.span[0], float(time.min())), max(self.span[1], float(time.max()))]
        angle = np.abs(scans.angle[np.isfinite(scans.angle)])
        if (not self.counts["read"] and not self.settings.radians and len(angle) >= MIN_ROWS_FOR_RADIANS
                and angle.max() <= 2 * np.pi):
            self.progress.warn(say("All angles are within {max:.2f} degrees: if they are radians, say so.",
                                   max=angle.max()))
        self.counts["read"] += len(scans)

    def placed(self) -> GeoreferencedScans:
        """The counts; InputError or InsufficientDataError where nothing was placed."""
        written = sum(self.by_scanner.values())
        if not self.counts["read"]:
            raise InsufficientDataError(say("The files hold no returns: choose other range scans."))
        if self.shift is None and self.counts["outside"]:
            raise InputError(say("The range scans were measured from {span:.1f} to {span_2:.1f} s, but the "
                                 "trajectory runs from {time:.1f} to {time_2:.1f} s: give those of one survey.",
                                 span=self.span[0], span_2=self.span[1], time=self.trajectory.time[0],
                                 time_2=self.trajectory.time[-1]))
        if not written:
            raise InsufficientDataError(say("No return could be placed: all are without a range or outside the "
                                            "limits of range and time."))
        return GeoreferencedScans(written=written, by_scanner=dict(sorted(self.by_scanner.items())),
                                  shift=self.shift or 0.0, **self.counts)


def _header(trajectory: Trajectory, crs_wkt: str | None) -> laspy.LasHeader:
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales = [SCALE] * 3
    header.offsets = np.floor(trajectory.place.min(axis=0))
    header.generating_software = "UrbanMap"
    header.global_encoding.gps_time_type = int(trajectory.time[0] > WEEK)
    header.add_extra_dims([laspy.ExtraBytesParams("angle", np.float32, "degrees in the scanner's plane"),
                           laspy.ExtraBytesParams("range", np.float32, "m from the scanner")])
    if crs_wkt:
        header.add_crs(CRS.from_wkt(crs_wkt))
    return header


def _records(header: laspy.LasHeader, points: np.ndarray, scans: RangeScans) -> laspy.ScaleAwarePointRecord:
    record = laspy.ScaleAwarePointRecord.zeros(len(points), header=header)
    for name, values in zip("xyz", points.T):
        record[name] = values
    record["gps_time"], record["intensity"], record["point_source_id"] = scans.time, scans.intensity, scans.scanner
    record["angle"], record["range"] = scans.angle, scans.distance
    record["return_number"] = record["number_of_returns"] = np.ones(len(points), np.uint8)
    return record
