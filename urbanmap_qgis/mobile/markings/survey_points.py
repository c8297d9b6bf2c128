"""The points of a survey near the vehicle, with their ranges, sorted along the path."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import laspy
import numpy as np

from ...errors import InputError, InsufficientDataError
from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ...io.points.whole_records import joined_records
from ...progress import SILENT, Progress
from ...terrain.surface import GROUND_CLASSES
from ...wording import say
from ..calibration import Calibration
from ..gps_time import time_shift
from ..passes import BlockPositions
from ..survey_tiles import CHUNK
from ..trajectory import Trajectory, gaps, path_chainage
from .ranges import Tracks, ranges

RECORD = np.dtype([("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("time", "<f8"), ("number", "<i8"), ("intensity", "<f4"),
                   ("range", "<f4"), ("source", "<u2"), ("ground", "?"), ("laser", "u1")])
"""A point: m, s in the trajectory's time, its number in the files, m, point source id, of a ground class, and what may
be the number of its laser."""

MIN_GROUND_SHARE = 0.01
"""Ground is a third or more of the points near the vehicle; a smaller share than this cannot be right."""

FEW_INTENSITIES = 4
"""So few different intensities are none that a scanner measured."""

LASER_DIMENSIONS = ("ring", "laser", "laser_id", "laser_number", "channel", "beam", "user_data")
"""Attributes that may number the lasers of a scanner; the first one that the files have is taken."""

UNIT = 20.0
"""m of path whose points are kept together."""

STOPPED = 1.0
"""s; points measured after standing for longer are left out: they show again what is known, from a drifting place."""

LONG_STOP = 5.0
"""s; while a vehicle stands for longer its navigation may drift so far that points from before and after do not fit."""

RETURN = 10.0
"""s; the passes of a vehicle that comes back to a place after so long are kept apart likewise."""

_CREEP = 0.02
_PART = 1 << 32
_ABOVE, _BELOW = 0.5, 4.5
_RISE = 0.15


@dataclass
class ReadCounts:
    """What was read.

    Attributes
    ----------
    points : all.
    usable : no noise or withheld points.
    outside : before or after the trajectory, or in gaps of it.
    standing : measured while the vehicle stood.
    nearby : near the vehicle.
    classes : (256,) number of usable points by class.
    intensities : (65536,) whether any point has this intensity.
    height : m, median height over the vehicle of points near it in plan; NaN without any.
    """

    points: int = 0
    usable: int = 0
    outside: int = 0
    standing: int = 0
    nearby: int = 0
    classes: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    intensities: np.ndarray = field(default_factory=lambda: np.zeros(1 << 16, dtype=bool))
    heights: list[float] = field(default_factory=list)


class SurveyPoints:
    """Reads a survey into buckets along the path.

    Parameters
    ----------
    buckets : where the points go, `RECORD` each, by number of the unit of path.
    max_range : m; farther points are left out.
    """

    def __init__(self, cloud: PointCloud, trajectory: Trajectory, calibration: Calibration | None, max_range: float,
                 buckets: PointBuckets):
        self.cloud, self.trajectory, self.calibration = cloud, trajectory, calibration
        self.max_range, self.buckets = max_range, buckets
        self.shift = time_shift(cloud, trajectory)
        self.chainage = path_chainage(trajectory)
        self.gaps = gaps(trajectory)
        self.breaks = breaks(trajectory, self.chainage)
        self.tracks = Tracks(trajectory, calibration)
        self.laser_dimension = next(name for name in LASER_DIMENSIONS if cloud.has_dimension(name))
        self.read_counts = ReadCounts()
        self.units: set[int] = set()

    def read(self, progress: Progress = SILENT) -> None:
        """Read all points.

        Raises
        ------
        InputError : no intensity, a scanner that the calibration does not know, or no point near the trajectory.
        """
        for chunk in iter_chunks(self.cloud, progress, CHUNK):
            first = self.read_counts.points
            self.read_counts.points += len(chunk)
            keep = valid_points(chunk)
            classes = np.asarray(chunk.classification)
            self.read_counts.classes += np.bincount(classes[keep], minlength=256)
            self.read_counts.usable += int(np.count_nonzero(keep))
            self._add(chunk, np.flatnonzero(keep), classes, first)
        self._check()

    def _add(self, chunk: laspy.ScaleAwarePointRecord, rows: np.ndarray, classes: np.ndarray, first: int) -> None:
        """Take the points of a chunk that lie near the vehicle."""
        time = np.asarray(chunk["gps_time"])[rows] + self.shift
        inside = self._timed(time)
        rows, time = rows[inside], time[inside]
        if not len(rows):
            return
        x, y, z = (np.asarray(chunk[name])[rows] for name in "xyz")
        intensity, source = (np.asarray(chunk[name])[rows] for name in ("intensity", "point_source_id"))
        self.read_counts.intensities[intensity] = True
        near, distance = self._near(x, y, z, time, source)
        nearby = np.flatnonzero(near)
        self.read_counts.nearby += len(nearby)
        if not len(nearby):
            return
        rows, time = rows[nearby], time[nearby]
        records = np.empty(len(nearby), dtype=RECORD)
        for name, values in zip(("x", "y", "z", "range", "intensity", "source"),
                                (x, y, z, distance, intensity, source)):
            records[name] = values[nearby]
        records["time"], records["number"] = time, first + rows
        records["laser"] = np.asarray(chunk[self.laser_dimension])[rows].astype(np.int64) & 0xFF
        records["ground"] = np.isin(classes[rows], GROUND_CLASSES)
        key = self.unit(time)
        self.units.update(np.unique(key).tolist())
        self.buckets.add(key, records)

    def unit(self, time: np.ndarray) -> np.ndarray:
        """Key of the unit of path of each time (n,): units between two breaks follow each other."""
        chainage = np.interp(time, self.trajectory.time, self.chainage)
        return np.searchsorted(self.breaks, time) * _PART + np.floor(chainage / UNIT).astype(np.int64)

    def _timed(self, time: np.ndarray) -> np.ndarray:
        """Mask (n,) of times at which the vehicle's place is known and it does not stand."""
        known = self.trajectory.within(time)
        for start, end in self.gaps:
            known &= (time <= start) | (time >= end)
        self.read_counts.outside += int(np.count_nonzero(~known))
        way_now, way_before = (np.interp(at, self.trajectory.time, self.chainage) for at in (time, time - STOPPED))
        standing = known & (way_now - way_before < _CREEP) & (time - STOPPED > self.trajectory.time[0])
        self.read_counts.standing += int(np.count_nonzero(standing))
        return known & ~standing

    def _near(self, x: np.ndarray, y: np.ndarray, z: np.ndarray, time: np.ndarray,
              source: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Which points (n,) lie within range of their scanner and at heights where its road may be; their ranges, m."""
        near, distance = np.zeros(len(x), dtype=bool), np.empty(len(x), dtype=np.float32)
        sources = np.unique(source).tolist()
        for number in sources:
            some = slice(None) if len(sources) == 1 else np.flatnonzero(source == number)
            track = self.tracks.of(number)
            place = track.interpolate(time[some])
            distance[some] = away = ranges(x[some], y[some], z[some], place)
            height = z[some] - place[2]
            slope = _RISE * away
            near[some] = ((away <= min(self.max_range, track.max_range)) & (height <= _ABOVE + slope)
                          & (height >= -_BELOW - slope))
            if not near[some].any() and len(height):
                self.read_counts.heights.append(float(np.median(height)))
        return near, distance

    def _check(self) -> None:
        """Refuse a survey that cannot be used."""
        read_counts, name = self.read_counts, self.cloud.paths[0].name
        values = np.flatnonzero(read_counts.intensities)
        if len(values) == 1 and values[0] == 0:
            raise InputError(say("{name} has no intensity (all are 0), by which markings are told: export the survey "
                                 "with it.", name=name))
        if 0 < len(values) <= FEW_INTENSITIES:
            raise InputError(say("All points of {name} have the intensity {values}, by which markings cannot be told: "
                                 "export the survey with the measured intensities.", name=name,
                                 values=", ".join(map(str, values))))
        if not read_counts.nearby:
            heights = read_counts.heights
            difference = (say(" (they lie {heights:+.0f} m above the scanner)", heights=np.median(heights)) if heights
                          else "")
            raise InputError(say("No point of {name} lies within {max_range:g} m of the trajectory{apart}: give both "
                                 "in the same coordinate and height system.", name=name, max_range=self.max_range,
                                 apart=difference))

    def stretches(self, buckets: PointBuckets, length: int, margin: int) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Records of stretches of `length` units with those of `margin` units before and after, and which are own.

        `buckets` hold records by unit and are empty afterwards; stretches without own records are left out. No stretch
        reaches over a break.
        """
        loaded: dict[int, np.ndarray] = {}
        starts = sorted({unit // _PART * _PART + unit % _PART // length * length for unit in self.units})
        for first in starts:
            wanted = [unit for unit in range(first - margin, first + length + margin)
                      if unit in self.units and unit // _PART == first // _PART]
            loaded = {unit: loaded[unit] if unit in loaded else buckets.pop(unit) for unit in wanted}
            mine = np.repeat([first <= unit < first + length for unit in wanted],
                             [len(loaded[unit]) for unit in wanted])
            if mine.any():
                yield joined_records([loaded[unit] for unit in wanted]), mine


def breaks(trajectory: Trajectory, chainage: np.ndarray) -> np.ndarray:
    """Times (k,), s, over which points do not fit: long stops, gaps, and returns to a place.

    `chainage` (n,) as of `path_chainage`.
    """
    places = BlockPositions()
    places.add(*trajectory.place[:, :2].T, trajectory.time)
    returns = places.passes(RETURN).starts
    return np.unique(np.concatenate([long_stops(trajectory, chainage), gaps(trajectory).mean(axis=1), returns]))


def long_stops(trajectory: Trajectory, chainage: np.ndarray) -> np.ndarray:
    """Times (k,), s, in the middle of stops of more than `LONG_STOP` seconds; `chainage` (n,) as of `path_chainage`."""
    moving = np.flatnonzero(np.diff(chainage) > 0)
    if not len(moving):
        return np.empty(0)
    left, arrived = trajectory.time[moving[1:]], trajectory.time[moving[:-1] + 1]
    return (0.5 * (left + arrived))[left - arrived > LONG_STOP]


def require_points(number: int, near: int, name: str) -> None:
    """Refuse a survey without ground near the vehicle, or with a share of the `near` points that cannot be right."""
    if not number:
        raise InsufficientDataError(say("{name} has no ground points near the vehicle: give the survey with its road.",
                                        name=name))
    if number < MIN_GROUND_SHARE * near:
        raise InsufficientDataError(
            say("Only {ground:,} of {near:,} points near the vehicle of {name} were found to be ground "
                "({share:.2g} %), which cannot be right for a drive: look for many points below the road or a wrong "
                "height unit, or classify the ground first.", ground=number, near=near, name=name,
                share=100 * number / near))
