"""From a mobile survey's points to its road-marking points (J 3.2.3)."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from concurrent.futures import Executor
from functools import partial

import numpy as np

from ...execution import in_order
from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import PointCloud
from ...io.points.whole_records import joined_records, record_rows
from ...progress import SILENT, Progress
from ...terrain.surface import ground_source
from ...wording import say
from ..calibration import Calibration
from ..trajectory import Trajectory
from .asphalt import Asphalt
from .extraction import DEFAULTS, Extraction, ExtractionSettings
from .records import MarkingPoints
from .stretch_markings import ground_of_stretch, markings_of_stretch, plain_markings_of_stretch
from .survey_points import RECORD, SurveyPoints, require_points

_PIECE_POINTS = 1_500_000
_MAX_UNITS = 8
_MARGIN = 2
_BUCKET_MEMORY = 80_000_000


def extract_markings(cloud: PointCloud, trajectory: Trajectory, calibration: Calibration | None = None,
                     settings: ExtractionSettings = DEFAULTS, progress: Progress = SILENT,
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
        run.asphalt.fit(progress)
        run.asphalt.tell_lasers(ground, run.ground_points, progress)
        run.asphalt.require_curves()
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
        self.asphalt = Asphalt(survey, settings.max_range)
        self.ground_points = self.in_range = 0
        self.scatter = 0.0
        self.method = ground_source(survey.read_counts.classes, settings.ground).method

    @property
    def pieces(self) -> int:
        """Number of stretches, about."""
        return max(len(self.survey.units) // self.length, 1)

    def find_ground(self, near: PointBuckets, ground: PointBuckets, progress: Progress) -> None:
        """Put the ground points of each stretch into other buckets, and count them by range and intensity."""
        progress.message(say("Finding the ground.") if self.method == "cloth" else say("Taking the points of ground "
                                                                                  "classes."))
        owned: deque[np.ndarray] = deque()
        work = partial(ground_of_stretch, settings=self.settings.cloth, by_class=self.method == "classes")
        margin = _MARGIN if self.method == "cloth" else 0

        def pieces() -> Iterator[tuple[np.ndarray, np.ndarray]]:
            for records, in_stretch in self.survey.stretches(near, self.length, margin):
                first = int(in_stretch.argmax())  # a stretch's own points follow each other
                owned.append(records[first:first + int(np.count_nonzero(in_stretch))])
                yield records[["x", "y", "z", "ground"]], in_stretch

        scatters = []
        for step, (mask, scatter) in enumerate(in_order(work, pieces(), self.executor, progress.check)):
            records = record_rows(owned.popleft(), mask)
            scatters.append(scatter)
            self.ground_points += len(records)
            self.asphalt.count(records)
            ground.add(self.survey.unit(records["time"]), records)
            progress.step(min((step + 1) / self.pieces, 1.0))
        judged = self.survey.read_counts.nearby if self.method == "cloth" else 0  # classes are the user's own word
        require_points(self.ground_points, judged, self.survey.cloud.paths[0].name)
        known = np.array(scatters)[np.isfinite(scatters)]
        self.scatter = float(np.median(known)) if len(known) else 0.0

    def find_markings(self, ground: PointBuckets, progress: Progress) -> Extraction:
        """The marking points of all stretches."""
        progress.message(say("Finding the markings."))
        owned: deque[tuple[np.ndarray, np.ndarray]] = deque()
        plain, asphalt = self.settings.plain, self.asphalt
        work = (partial(markings_of_stretch, noise=asphalt.noise(self.scatter), settings=self.settings.marking)
                if plain is None else partial(plain_markings_of_stretch, white=asphalt.white(), settings=plain))

        def pieces() -> Iterator[tuple[np.ndarray, ...]]:
            for records, in_stretch in self.survey.stretches(ground, self.length, _MARGIN):
                brightness = asphalt.calibrated(records)
                keep = np.isfinite(brightness)
                mine = np.flatnonzero(keep & in_stretch)
                owned.append((records, mine))
                self.in_range += len(mine)
                yield (*(records[name][keep] for name in "xyz"), brightness[keep], in_stretch[keep])

        found = []
        for step, (rows, weight, contrast, brightness) in enumerate(
                in_order(work, pieces(), self.executor, progress.check)):
            records, mine = owned.popleft()
            found.append((record_rows(records, mine[rows]), weight, contrast, brightness))
            progress.step(min((step + 1) / self.pieces, 1.0))
        return self._result(found)

    def _result(self, found: list[tuple[np.ndarray, ...]]) -> Extraction:
        read_counts, asphalt = self.survey.read_counts, self.asphalt
        if found:
            records, *figures = zip(*found)
            records, (weight, contrast, brightness) = joined_records(records), map(np.concatenate, figures)
        else:
            records, weight, contrast, brightness = np.empty(0, RECORD), *(np.empty(0, np.float32) for _ in range(3))
        order = np.argsort(records["number"], kind="stable")
        records = record_rows(records, order)
        weight, contrast, brightness = (part[order] for part in (weight, contrast, brightness))
        points = MarkingPoints(*(records[name] for name in ("x", "y", "z", "time")), weight.astype(float),
                               records["source"].astype(np.int64))
        marked = len(np.unique(self.survey.unit(records["time"]))) / max(len(self.survey.units), 1)
        return Extraction(points, records["number"], (brightness * asphalt.reference).astype(np.float32), contrast,
                          asphalt.curves, asphalt.failed, asphalt.reference, read_counts.points, read_counts.outside,
                          read_counts.standing, read_counts.nearby, self.ground_points, self.in_range,
                          self.method, marked, self.scatter,
                          {number: item.gains for number, item in asphalt.lasers.items()})
