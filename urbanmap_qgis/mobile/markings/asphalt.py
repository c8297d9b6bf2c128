"""The brightness of asphalt as each scanner of a survey sees it, and that of points in its measure (J 3.2.3)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...errors import InsufficientDataError
from ...io.points.point_buckets import PointBuckets
from ...io.points.whole_records import joined_records
from ...progress import Progress
from ...wording import say
from ..calibration import scanner_of
from .intensity_calibration import (
    MIN_INTENSITY,
    IntensityCurve,
    RangeHistogram,
    brightness_counts,
    calibrated,
    fit_curve,
    scatter_about,
)
from .lasers import RESTLESS, Lasers, told_apart
from .marking_points import Noise
from .plain_threshold import WHITE_SHARE
from .survey_points import RECORD, SurveyPoints

MAX_SCANNERS = 16
"""More different point source ids, without a calibration, are no scanners but something else, such as sweeps."""

_LASER_POINTS = 500_000


class Asphalt:
    """Intensity of asphalt over range, by scanner.

    Attributes
    ----------
    histograms : of intensity and range, by number of the scanner.
    curves : of the scanners whose asphalt can be told.
    failed : why the others have none.
    lasers : what the intensities of scanners of many lasers are freed of.
    """

    def __init__(self, survey: SurveyPoints, max_range: float):
        self.survey, self.max_range = survey, max_range
        self.together = survey.calibration is None and len(survey.tracks.by_source) > MAX_SCANNERS
        self.first_id = _first_ids(survey)
        self.histograms: dict[int, RangeHistogram] = {}
        self.curves: dict[int, IntensityCurve] = {}
        self.failed: dict[int, str] = {}
        self.lasers: dict[int, Lasers] = {}

    def _scanner(self, source: np.ndarray) -> np.ndarray:
        """Number of the scanner by which curves are kept, of each point (n,): the first of its point source ids."""
        if self.together:
            return np.zeros_like(source)
        return self.first_id[source]

    def count(self, records: np.ndarray) -> None:
        """Count ground points (`RECORD`) by range and intensity."""
        scanner = self._scanner(records["source"])
        for number in np.unique(scanner).tolist():
            some = records[scanner == number]
            intensity = self._intensity(number, some)
            heard = np.isfinite(intensity)
            histogram = self.histograms.setdefault(number, RangeHistogram(self.max_range))
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

    def tell_lasers(self, ground: PointBuckets, count: int, progress: Progress) -> None:
        """Free intensities of what the lasers of a scanner differ by, where its asphalt scatters much.

        `count` : points of the ground.
        """
        restless = [number for number in self.histograms
                    if number not in self.curves or self.curves[number].scatter > RESTLESS]
        sample = self._sample(ground, count) if restless else np.empty(0, RECORD)
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

    def _sample(self, ground: PointBuckets, count: int) -> np.ndarray:
        """Ground points of units spread over the path, as many as lasers are judged by."""
        units = sorted(self.survey.units)
        wanted = max(int(_LASER_POINTS * len(units) / max(count, 1)), 1)
        chosen = [units[k] for k in np.unique(np.linspace(0, len(units) - 1, min(wanted, len(units))).astype(int))]
        return joined_records([ground.read(unit) for unit in chosen])[:2 * _LASER_POINTS]

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
            self.count(records[np.isin(self._scanner(records["source"]), list(self.lasers))])
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

    def white(self) -> float:
        """The brightness (asphalt: 1) that all but 0.1 % of the ground's points stay below."""
        values, counts = zip(*(brightness_counts(self.histograms[number], curve)
                               for number, curve in self.curves.items()))
        value, count = np.concatenate(values), np.concatenate(counts)
        order = np.argsort(value)
        running = np.cumsum(count[order])
        return float(value[order][np.searchsorted(running, WHITE_SHARE * running[-1])])

    def noise(self, height_scatter: float) -> Noise:
        """Scatter of heights (m), and of asphalt's brightness over all scanners."""
        points, scatter = np.array([(curve.points[curve.used].sum(), curve.scatter)
                                    for curve in self.curves.values()]).T
        return Noise(height_scatter, float((points * scatter).sum() / points.sum()))

    def calibrated(self, records: np.ndarray) -> np.ndarray:
        """Brightness (n,) float32 of records (asphalt: 1), NaN beyond R2."""
        scanner = self._scanner(records["source"])
        brightness = np.full(len(records), np.nan, dtype=np.float32)
        for number, curve in self.curves.items():
            some = slice(None) if len(self.histograms) == 1 else scanner == number
            brightness[some] = calibrated(self._intensity(number, records[some]), records["range"][some], curve, 1.0)
        return brightness


def _first_ids(survey: SurveyPoints) -> np.ndarray:
    """The least point source id of the same scanner, by point source id (65536,): a calibration may know but one."""
    first = np.arange(1 << 16, dtype=np.uint16)
    if survey.calibration is not None:
        tracks = survey.tracks.by_source
        for source, track in tracks.items():
            first[source] = min(other for other, same in tracks.items() if same is track)
    return first
