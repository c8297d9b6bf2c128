"""From a mobile survey's files to its road-marking points (J 3.2.3)."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from functools import partial

import laspy
import numpy as np

from ...errors import InputError, InsufficientDataError
from ...execution import in_order
from ...io.points.decoded_points import decoded_once
from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import PointCloud, PointLayout, cloud_writer, iter_chunks, open_cloud
from ...progress import SILENT, Progress
from ...terrain.cloth import JAVANMARDI, ClothSettings, classify_ground
from ...terrain.surface import ground_source
from ...wording import say
from ..calibration import Calibration, scanner_of
from ..trajectory import Trajectory
from .intensity_calibration import (
    MIN_INTENSITY,
    IntensityCurve,
    RangeHistogram,
    brightness_counts,
    calibrated,
    fit_curve,
    scatter_about,
)
from .lasers import RESTLESS, LaserGains, Lasers, told_apart
from .marking_points import MarkingAnswer, MarkingPointSettings, Noise, marking_points, roughness
from .plain_threshold import WHITE_SHARE, PlainThreshold, plain_marking_points
from .records import MarkingPoints
from .survey_points import RECORD, SurveyPoints, require_points

CALIBRATED, WEIGHT = "calibrated_intensity", "marking_weight"
"""Names of the attributes that marking points get."""

MAX_SCANNERS = 16
"""More different point source ids, without a calibration, are no scanners but something else, such as sweeps."""

_PIECE_POINTS = 1_500_000
_MAX_UNITS = 8
_MARGIN = 2
_BUCKET_MEMORY = 80_000_000
_LASER_POINTS = 500_000


@dataclass(frozen=True)
class ExtractionSettings:
    """How markings are taken out of a survey.

    Parameters
    ----------
    max_range : m; farther points are left out, whatever the intensity curve allows (R2).
    marking : how points are told.
    cloth : the ground filter, where the points are not classified.
    plain : the paper's threshold, which then tells them instead.
    ground : "automatic", "classes" or "cloth".
    """

    max_range: float = 25.0
    marking: MarkingPointSettings = field(default_factory=MarkingPointSettings)
    cloth: ClothSettings = JAVANMARDI
    plain: PlainThreshold | None = None
    ground: str = "automatic"

    def __post_init__(self) -> None:
        if not self.max_range > 0:
            raise InputError(say("The largest range must be greater than 0."))


@dataclass(frozen=True)
class Extraction:
    """The marking points of a survey, in the order of its files.

    Attributes
    ----------
    points : with their times in the trajectory's time.
    number : (m,) their numbers in the files, from 0.
    intensity : (m,) float32, calibrated: asphalt has `reference`.
    contrast : (m,) float32, intensity over that of the ground beside.
    curves : of each scanner, by the least of its point source ids (0 where all ids are taken together).
    failed : why a scanner has no curve, by point source id; its points are left out.
    reference : I_ref of J eq. 4.
    read, outside, standing, near, ground, in_range : points read; at times without a place of the vehicle; left out
        because the vehicle stood; within range; on the ground; of these within R2 of a curve.
    ground_method : "classes" or "cloth".
    marked_share : share of the units of path (20 m) with marking points.
    height_scatter : m, of ground points within 20 cm.
    lasers : of scanners of many lasers, what their intensities were freed of.
    """

    points: MarkingPoints
    number: np.ndarray
    intensity: np.ndarray
    contrast: np.ndarray
    curves: Mapping[int, IntensityCurve]
    failed: Mapping[int, str]
    reference: float
    read: int
    outside: int
    standing: int
    near: int
    ground: int
    in_range: int
    ground_method: str
    marked_share: float
    height_scatter: float
    lasers: Mapping[int, LaserGains] = field(default_factory=dict)


def extract_markings(cloud: PointCloud, trajectory: Trajectory, calibration: Calibration | None = None,
                     settings: ExtractionSettings = ExtractionSettings(), progress: Progress = SILENT,
                     executor: Executor | None = None) -> Extraction:
    """The road-marking points of a survey.

    The survey is read once and worked on in sections of the path, so that passes through one place are not
    mixed and memory holds some stretches. The result does not depend on the executor or the order of the points.

    Parameters
    ----------
    calibration : where the scanners sit on the body; None takes ranges from the body's origin.

    Raises
    ------
    InputError : no intensity, no GPS time, times that do not overlap, or an unknown scanner.
    InsufficientDataError : no ground near the vehicle, or no scanner whose asphalt can be told.
    """
    with PointBuckets(RECORD, _BUCKET_MEMORY) as ground:
        with PointBuckets(RECORD, _BUCKET_MEMORY) as near:
            survey = SurveyPoints(cloud, trajectory, calibration, settings.max_range, near)
            survey.read(progress.part(0.0, 0.5))
            _report_left_out(survey, progress)
            run = _Run(survey, settings, executor)
            run.find_ground(near, ground, progress.part(0.5, 0.7))
        run.fit(progress)
        run.tell_lasers(ground, progress)
        run.require_curves()
        return run.find_markings(ground, progress.part(0.7, 1.0))


def _report_left_out(survey: SurveyPoints, progress: Progress) -> None:
    """Warn of points that cannot be used."""
    read_counts = survey.read_counts
    if read_counts.outside:
        progress.warn(say("{outside:,} of {points:,} points were measured where the trajectory has no epochs and are "
                          "left out.", outside=read_counts.outside, points=read_counts.points))
    if read_counts.standing:
        progress.message(say("{standing:,} points measured while the vehicle stood are left out.",
                             standing=read_counts.standing))


class _Run:
    """The steps from points near the vehicle to marking points."""

    def __init__(self, survey: SurveyPoints, settings: ExtractionSettings, executor: Executor | None):
        self.survey, self.settings, self.executor = survey, settings, executor
        units = max(len(survey.units), 1)
        self.length = int(np.clip(_PIECE_POINTS * units / max(survey.read_counts.nearby, 1), 1, _MAX_UNITS))
        self.together = survey.calibration is None and len(survey.tracks.by_source) > MAX_SCANNERS
        self.first_id = _first_ids(survey)
        self.histograms: dict[int, RangeHistogram] = {}
        self.curves: dict[int, IntensityCurve] = {}
        self.failed: dict[int, str] = {}
        self.lasers: dict[int, Lasers] = {}
        self.ground_points = self.in_range = 0
        self.scatter = 0.0
        self.method = ground_source(survey.read_counts.classes, settings.ground).method

    @property
    def pieces(self) -> int:
        """Number of stretches, about."""
        return max(len(self.survey.units) // self.length, 1)

    def _scanner(self, source: np.ndarray) -> np.ndarray:
        """Number of the scanner by which curves are kept, of each point (n,): the first of its point source ids."""
        if self.together:
            return np.zeros_like(source)
        return self.first_id[source]

    def find_ground(self, near: PointBuckets, ground: PointBuckets, progress: Progress) -> None:
        """Put the ground points of each stretch into other buckets, and count them by range and intensity."""
        progress.message(say("Finding the ground.") if self.method == "cloth" else say("Taking the points of ground "
                                                                                  "classes."))
        owned: deque[np.ndarray] = deque()
        work = partial(_ground_of_stretch, settings=self.settings.cloth, by_class=self.method == "classes")
        margin = _MARGIN if self.method == "cloth" else 0

        def pieces() -> Iterator[tuple[np.ndarray, np.ndarray]]:
            for records, in_stretch in self.survey.stretches(near, self.length, margin):
                first = int(in_stretch.argmax())  # a stretch's own points follow each other
                owned.append(records[first:first + int(np.count_nonzero(in_stretch))])
                yield records[["x", "y", "z", "ground"]], in_stretch

        scatters = []
        for step, (mask, scatter) in enumerate(in_order(work, pieces(), self.executor, progress.check)):
            records = owned.popleft()[mask]
            scatters.append(scatter)
            self.ground_points += len(records)
            self._count(records)
            ground.add(self.survey.unit(records["time"]), records)
            progress.step(min((step + 1) / self.pieces, 1.0))
        judged = self.survey.read_counts.nearby if self.method == "cloth" else 0  # classes are the user's own word
        require_points(self.ground_points, judged, self.survey.cloud.paths[0].name)
        known = np.array(scatters)[np.isfinite(scatters)]
        self.scatter = float(np.median(known)) if len(known) else 0.0

    def _count(self, records: np.ndarray) -> None:
        scanner = self._scanner(records["source"])
        for number in np.unique(scanner).tolist():
            some = records[scanner == number]
            intensity = self._intensity(number, some)
            heard = np.isfinite(intensity)
            histogram = self.histograms.setdefault(number, RangeHistogram(self.settings.max_range))
            histogram.add(some["range"][heard], intensity[heard])

    def _intensity(self, number: int, records: np.ndarray) -> np.ndarray:
        """Intensity (n,) of a scanner's records, freed of what its lasers differ by; NaN where one is left out."""
        return self.lasers[number].freed(records) if number in self.lasers else records["intensity"]

    def fit(self, progress: Progress) -> None:
        """Fit the curve of each scanner."""
        for number, histogram in sorted(self.histograms.items()):
            try:
                self.curves[number] = fit_curve(histogram)
            except InsufficientDataError as error:
                self.failed[number] = str(error)
        progress.check()

    def tell_lasers(self, ground: PointBuckets, progress: Progress) -> None:
        """Free intensities of what the lasers of a scanner differ by, where its asphalt scatters much."""
        restless = [number for number in self.histograms
                    if number not in self.curves or self.curves[number].scatter > RESTLESS]
        sample = self._sample(ground) if restless else np.empty(0, RECORD)
        scanner = self._scanner(sample["source"])
        for number in restless:
            found = self._told_apart(number, sample[scanner == number])
            if found is not None:
                self.lasers[number] = found
                gains = found.gains
                progress.message(say("The lasers of scanner {number} are told apart by {told_by}: asphalt scatters "
                                     "by {after:.0f} % instead of {before:.0f} %.", number=number,
                                     told_by=gains.told_by, after=100 * gains.after, before=100 * gains.before))
        if self.lasers:
            self._count_again(ground, progress)

    def _sample(self, ground: PointBuckets) -> np.ndarray:
        """Ground points of units spread over the path, as many as lasers are judged by."""
        units = sorted(self.survey.units)
        wanted = max(int(_LASER_POINTS * len(units) / max(self.ground_points, 1)), 1)
        chosen = [units[k] for k in np.unique(np.linspace(0, len(units) - 1, min(wanted, len(units))).astype(int))]
        return np.concatenate([ground.read(unit) for unit in chosen])[:2 * _LASER_POINTS]

    def _told_apart(self, number: int, records: np.ndarray) -> Lasers | None:
        """The lasers of a scanner, if something tells them apart."""
        if not len(records):
            return None
        source = int(records["source"][0])
        mount = scanner_of(self.survey.calibration, source) if self.survey.calibration else None
        curve, intensity = self.curves.get(number), records["intensity"].astype(float)
        silent = intensity < MIN_INTENSITY
        level = np.median(intensity[~silent]) if (~silent).any() else 1.0
        brightness = intensity / (curve.intensity(records["range"]) if curve else level)
        return told_apart(records, brightness, silent, self.survey.tracks.of(source), mount, self.survey.trajectory)

    def _count_again(self, ground: PointBuckets, progress: Progress) -> None:
        """Count the scanners whose lasers are told apart anew, and fit those that had no curve."""
        for number in self.lasers:
            del self.histograms[number]
            self.failed.pop(number, None)
        # Gains are those about the curve with which they were found, and hold with it.
        fitted = dict(self.curves)
        for unit in sorted(self.survey.units):
            records = ground.read(unit)
            self._count(records[np.isin(self._scanner(records["source"]), list(self.lasers))])
        self.fit(progress)
        self.curves.update(fitted)
        for number in set(self.lasers) & set(fitted):
            self.curves[number] = replace(fitted[number], scatter=scatter_about(self.histograms[number],
                                                                                fitted[number]))
            self.failed.pop(number, None)

    def require_curves(self) -> None:
        """Refuse a survey of which no scanner has a curve."""
        if not self.curves:
            reason = next(iter(self.failed.values()))
            raise InsufficientDataError(say("The intensity of asphalt over range cannot be told in {paths} "
                                            "({reason}): give a longer stretch of road.",
                                            paths=self.survey.cloud.paths[0].name, reason=reason))

    @property
    def reference(self) -> float:
        """I_ref: asphalt's intensity at the shortest range, of the scanner that sees it brightest."""
        return max(float(curve.intensity(curve.nearest)) for curve in self.curves.values())

    def find_markings(self, ground: PointBuckets, progress: Progress) -> Extraction:
        """The marking points of all stretches."""
        progress.message(say("Finding the markings."))
        owned: deque[tuple[np.ndarray, np.ndarray]] = deque()
        plain = self.settings.plain
        work = (partial(_markings_of_stretch, noise=self._noise(), settings=self.settings.marking) if plain is None else
                partial(_plain_markings_of_stretch, white=self._white(), settings=plain))

        def pieces() -> Iterator[tuple[np.ndarray, ...]]:
            for records, in_stretch in self.survey.stretches(ground, self.length, _MARGIN):
                brightness = self._calibrated(records)
                keep = np.isfinite(brightness)
                mine = np.flatnonzero(keep & in_stretch)
                owned.append((records, mine))
                self.in_range += len(mine)
                yield (*(records[name][keep] for name in "xyz"), brightness[keep], in_stretch[keep])

        found = []
        for step, (rows, weight, contrast, brightness) in enumerate(
                in_order(work, pieces(), self.executor, progress.check)):
            records, mine = owned.popleft()
            found.append((records[mine[rows]], weight, contrast, brightness))
            progress.step(min((step + 1) / self.pieces, 1.0))
        return self._result(found)

    def _white(self) -> float:
        """The brightness (asphalt: 1) that all but 0.1 % of the ground's points stay below."""
        values, counts = zip(*(brightness_counts(self.histograms[number], curve)
                               for number, curve in self.curves.items()))
        value, count = np.concatenate(values), np.concatenate(counts)
        order = np.argsort(value)
        running = np.cumsum(count[order])
        return float(value[order][np.searchsorted(running, WHITE_SHARE * running[-1])])

    def _noise(self) -> Noise:
        """Scatter of heights, and of asphalt's brightness over all scanners."""
        points, scatter = np.array([(curve.points[curve.used].sum(), curve.scatter)
                                    for curve in self.curves.values()]).T
        return Noise(self.scatter, float((points * scatter).sum() / points.sum()))

    def _calibrated(self, records: np.ndarray) -> np.ndarray:
        """Brightness (n,) float32 of records (asphalt: 1), NaN beyond R2."""
        scanner = self._scanner(records["source"])
        brightness = np.full(len(records), np.nan, dtype=np.float32)
        for number, curve in self.curves.items():
            some = slice(None) if len(self.histograms) == 1 else scanner == number
            brightness[some] = calibrated(self._intensity(number, records[some]), records["range"][some], curve, 1.0)
        return brightness

    def _result(self, found: list[tuple[np.ndarray, ...]]) -> Extraction:
        read_counts = self.survey.read_counts
        if found:
            records, weight, contrast, brightness = (np.concatenate(parts) for parts in zip(*found))
        else:
            records, weight, contrast, brightness = np.empty(0, RECORD), *(np.empty(0, np.float32) for _ in range(3))
        order = np.argsort(records["number"], kind="stable")
        records, weight, contrast, brightness = (part[order] for part in (records, weight, contrast, brightness))
        points = MarkingPoints(*(records[name] for name in ("x", "y", "z", "time")), weight.astype(float),
                               records["source"].astype(np.int64))
        marked = len(np.unique(self.survey.unit(records["time"]))) / max(len(self.survey.units), 1)
        return Extraction(points, records["number"], (brightness * self.reference).astype(np.float32), contrast,
                          self.curves, self.failed, self.reference, read_counts.points, read_counts.outside,
                          read_counts.standing, read_counts.nearby, self.ground_points, self.in_range,
                          self.method, marked, self.scatter,
                          {number: item.gains for number, item in self.lasers.items()})


def _first_ids(survey: SurveyPoints) -> np.ndarray:
    """The least point source id of the same scanner, by point source id (65536,): a calibration may know but one."""
    first = np.arange(1 << 16, dtype=np.uint16)
    if survey.calibration is not None:
        tracks = survey.tracks.by_source
        for source, track in tracks.items():
            first[source] = min(other for other, same in tracks.items() if same is track)
    return first


def _ground_of_stretch(piece: tuple[np.ndarray, np.ndarray], settings: ClothSettings,
                       by_class: bool) -> tuple[np.ndarray, float]:
    """Which of a stretch's own points are ground, (own,) bool, and how much their heights scatter, m."""
    records, in_stretch = piece
    x, y, z = (np.ascontiguousarray(records[name]) for name in "xyz")
    ground = records["ground"] if by_class else classify_ground(x, y, z, settings)
    mine = ground & in_stretch
    return ground[in_stretch], roughness(x[mine], y[mine], z[mine])


def _markings_of_stretch(piece: tuple[np.ndarray, ...], noise: Noise,
                         settings: MarkingPointSettings) -> tuple[np.ndarray, ...]:
    """Rows among a stretch's own points that are paint, with weight, contrast and brightness."""
    return _answer_of_own(piece, settings.reach, lambda x, y, z, brightness: marking_points(
        x, y, z, brightness, noise, settings))


def _plain_markings_of_stretch(piece: tuple[np.ndarray, ...], white: float,
                               settings: PlainThreshold) -> tuple[np.ndarray, ...]:
    """The same by the paper's threshold."""
    return _answer_of_own(piece, settings.reach, lambda x, y, _z, brightness: plain_marking_points(
        x, y, brightness, white, settings))


def _answer_of_own(piece: tuple[np.ndarray, ...], reach: float,
                   find: Callable[..., MarkingAnswer]) -> tuple[np.ndarray, ...]:
    """What `find` answers for a stretch's own points, from the points within `reach` m of them."""
    x, y, z, brightness, in_stretch = piece
    if not in_stretch.any():
        return np.empty(0, int), *(np.empty(0, np.float32) for _ in range(3))
    box = x[in_stretch].min(), x[in_stretch].max(), y[in_stretch].min(), y[in_stretch].max()
    near = ((x >= box[0] - reach) & (x <= box[1] + reach) & (y >= box[2] - reach) & (y <= box[3] + reach))
    answer = find(x[near], y[near], z[near], brightness[near])
    mine = in_stretch[near]
    rows = np.flatnonzero(answer.paint[mine])
    return rows, answer.weight[mine][rows], answer.contrast[mine][rows], brightness[in_stretch][rows]


def markings_to_file(paths: Sequence[str | os.PathLike], output: str | os.PathLike, trajectory: Trajectory,
                     calibration: Calibration | None = None, settings: ExtractionSettings = ExtractionSettings(),
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
