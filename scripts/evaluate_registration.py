#!/usr/bin/env python3
"""Tables of Javanmardi 2018 (3-3 to 3-7 and 4-1) for any surveys with control points, as Markdown.

    python scripts/evaluate_registration.py --city FOLDER --markings mask.tif --ground ground.tif
    python scripts/evaluate_registration.py --survey POINTS TRAJECTORY CONTROL [--survey ...] --calibration FILE \\
        --markings mask.tif [--ground ground.tif] --output tables.md

A sample city has everything but the reference markings: make them with “Road markings from aerial frames”. Compared are
the survey as reported, landmark updating with some of the control points, the paper's method to the letter (rigid
windows in plan, each patch moved by its own), and the method of “Register mobile survey”.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from urbanmap_qgis.errors import UrbanMapError
from urbanmap_qgis.io.pointcloud import open_cloud
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.control import ControlPoints, accuracy, in_survey_time, read_control, residuals
from urbanmap_qgis.mobile.landmark_update import update_by_landmarks
from urbanmap_qgis.mobile.markings.marking_stage import ExtractionSettings
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.pose_correction import correction_between
from urbanmap_qgis.mobile.registration.records import RegistrationSettings, WindowResults
from urbanmap_qgis.mobile.registration.register import register_windows
from urbanmap_qgis.mobile.registration.stage import RegistrationRun, register_markings, survey_markings
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.trajectory import Trajectory, path_chainage
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

START_ERROR = 3.0
"""m, initial error of the trials of success."""

SUCCESS = 0.10
"""m, mean error in plan at control points that counts as success."""


@dataclass(frozen=True)
class Survey:
    """A survey's marking points, trajectory and control points; every `landmarks`-th of these is used for updating."""

    name: str
    markings: MarkingPoints
    trajectory: Trajectory
    control: ControlPoints
    points: int
    landmarks: int

    @property
    def checks(self) -> ControlPoints:
        """Control points that no method may use."""
        return self.control.take(~self._used())

    @property
    def marks(self) -> ControlPoints:
        """Control points for landmark updating."""
        return self.control.take(self._used())

    def _used(self) -> np.ndarray:
        return np.arange(len(self.control)) % self.landmarks == self.landmarks // 2

    def errors(self, corrected: Trajectory | None) -> np.ndarray:
        """(n, 3) m at the control points that no method may use."""
        return residuals(self.checks, correction_between(self.trajectory, corrected) if corrected else None)


def read_survey(name: str, points: Path, trajectory: Path, control: Path, calibration: Path | None,
                landmarks: int) -> Survey:
    """A survey from its files, with its markings extracted."""
    cloud = open_cloud([points])
    driven = read_trajectory(trajectory, cloud.crs_wkt).trajectory
    known, _ = in_survey_time(read_control(control), driven)
    markings = survey_markings(cloud, driven, ExtractionSettings(),
                               read_calibration(calibration) if calibration else None)
    return Survey(name, markings, driven, known, cloud.point_count, landmarks)


def by_patches(trajectory: Trajectory, windows: WindowResults) -> Trajectory:
    """Each patch moved by its own window, as the paper does; patches without one by the nearest that has one."""
    good = np.flatnonzero(np.isfinite(windows.correction[:, 0]))
    middle = windows.time[good]
    nearest = good[np.searchsorted(0.5 * (middle[1:] + middle[:-1]), trajectory.time)]
    change = np.nan_to_num(windows.correction[nearest])
    return Trajectory(trajectory.time, trajectory.place + change[:, :3], trajectory.angles + change[:, 3:])


class Evaluation:
    """Runs the methods on surveys and writes tables."""

    def __init__(self, surveys: list[Survey], reference: Reference, trials: int):
        self.surveys, self.reference, self.trials = surveys, reference, trials
        self.lines: list[str] = []

    def table(self, title: str, header: tuple[str, ...], rows: list[tuple]) -> None:
        """Add a table and show it."""
        cells = [[f"{value:.3f}" if isinstance(value, float) else str(value) for value in row] for row in rows]
        lines = [f"### {title}", "", "| " + " | ".join(header) + " |", "|" + "---|" * len(header),
                 *("| " + " | ".join(row) + " |" for row in cells), ""]
        print("\n".join(lines), flush=True)
        self.lines += lines

    def ours(self, survey: Survey, **changes):
        """The survey registered by our method, and CPU seconds."""
        run = RegistrationRun(replace(RegistrationSettings(three_d=self.reference.has_heights), **changes))
        start = time.process_time()
        made = register_markings(survey.markings, survey.trajectory, self.reference, run)
        return made, time.process_time() - start

    def letter(self, survey: Survey, **changes) -> tuple[Trajectory, WindowResults, float]:
        """The same by the paper's method to the letter."""
        start = time.process_time()
        windows = register_windows(survey.markings, survey.trajectory, self.reference,
                                   RegistrationSettings.paper(**changes))
        return by_patches(survey.trajectory, windows), windows, time.process_time() - start

    def methods(self) -> None:
        """Tables 3-3, 3-7 and 4-1."""
        collected: dict[str, list[np.ndarray]] = {}
        sure = []
        for survey in self.surveys:
            made, seconds = self.ours(survey)
            ours = made.trajectory
            rows, length = [], float(path_chainage(survey.trajectory)[-1])
            for name, corrected in (("reported", None), ("landmark updating", update_by_landmarks(
                    survey.trajectory, survey.marks)), ("the paper to the letter", self.letter(survey)[0]),
                    ("this program", ours)):
                errors = survey.errors(corrected)
                collected.setdefault(name, []).append(errors)
                rows.append((name, *figures(errors)))
            self.table(f"Table 3-3 and 4-1: {survey.name}, {length:.0f} m, {len(survey.checks)} control points, "
                       f"{len(survey.marks)} landmarks, {seconds / length:.4f} s a metre", HEADER, rows)
            sure.append(covered(survey, made))
        self.table("Table 3-7: all surveys", HEADER, [(name, *figures(np.concatenate(errors)))
                                                      for name, errors in collected.items()])
        self.table("Honesty of sigma", ("survey", "within 1 sigma", "within 2 sigma", "median sigma (m)"),
                   [(survey.name, *shares) for survey, shares in zip(self.surveys, sure)])

    def sensitivity(self) -> None:
        """Tables 3-4 to 3-6 and the patch lengths of figure 3-29, on the first survey."""
        survey = self.surveys[0]
        header = ("", "paper mean 2D (m)", "paper max", "ours mean 2D (m)", "ours max", "windows min", "mean", "max")
        for title, name, values in (("Table 3-4: NDT grid (m)", "ndt_grid", (0.5, 1.0, 2.0, 4.0)),
                                    ("Table 3-5: initial window (patches)", "window_patches", (15, 30, 60, 120)),
                                    ("Table 3-6: feature count", "feature_count", (200, 400, 600, 800)),
                                    ("Figure 3-29: patch length (m)", "patch_length", (0.5, 1.0, 2.0, 4.0))):
            rows = []
            for value in values:
                change = {name: value}
                corrected, windows, _ = self.letter(survey, **change)
                theirs, ours = (np.hypot(*survey.errors(made)[:, :2].T)
                                for made in (corrected, self.ours(survey, **change)[0].trajectory))
                patches = windows.window_last - windows.window_first + 1
                rows.append((f"{value:g}", theirs.mean(), theirs.max(), ours.mean(), ours.max(), int(patches.min()),
                             f"{patches.mean():.1f}", int(patches.max())))
            self.table(f"{title}, {survey.name}", header, rows)

    def agreement(self) -> None:
        """How far several surveys lie apart at control points that they share."""
        places = []
        for survey in self.surveys:
            made, _ = self.ours(survey)
            left = residuals(survey.control, correction_between(survey.trajectory, made.trajectory))
            places.append(dict(zip(survey.control.id, left)))
        rows = []
        for first in range(len(places)):
            for second in range(first + 1, len(places)):
                shared = sorted(set(places[first]) & set(places[second]))
                if shared:
                    apart = np.array([places[first][key] - places[second][key] for key in shared])
                    rows.append((f"{self.surveys[first].name} and {self.surveys[second].name}", len(shared),
                                 *figures(apart)))
        if rows:
            self.table("Surveys of the same street: how far they lie apart", ("surveys", "points", *HEADER[1:]), rows)

    def start_errors(self) -> None:
        """Share of trials from an initial error of 3 m that end within 10 cm."""
        rng, ended = np.random.default_rng(0), []
        for number in range(self.trials):
            survey = self.surveys[number % len(self.surveys)]
            direction = rng.uniform(0, 2 * np.pi)
            bias = residuals(survey.control)[:, :2].mean(axis=0)
            move = START_ERROR * np.array([np.cos(direction), np.sin(direction)]) - bias
            ended.append(self.trial(survey, np.append(move, 0.0)))
        ended = np.array(ended)
        self.table(f"From {START_ERROR:g} m of initial error",
                   ("trials", f"within {SUCCESS:g} m", "mean 2D (m)", "worst"),
                   [(len(ended), f"{100 * np.mean(ended < SUCCESS):.0f} %", float(np.mean(ended)), float(ended.max()))])

    def trial(self, survey: Survey, move: np.ndarray) -> float:
        """Mean error in plan of a survey that was moved before; infinite where it is refused."""
        place = Trajectory(survey.trajectory.time, survey.trajectory.place + move, survey.trajectory.angles)
        markings = replace(survey.markings, x=survey.markings.x + move[0], y=survey.markings.y + move[1])
        control = ControlPoints(survey.control.id, survey.control.true, survey.control.time,
                                survey.control.surveyed + move)
        moved = replace(survey, trajectory=place, markings=markings, control=control)
        try:
            return float(np.hypot(*moved.errors(self.ours(moved)[0].trajectory)[:, :2].T).mean())
        except UrbanMapError:
            return np.inf


HEADER = ("method", "mean 2D (m)", "max 2D", "std 2D", "mean 3D (m)", "max 3D", "std 3D")


def figures(errors: np.ndarray) -> tuple[float, ...]:
    """Mean, maximum and standard deviation in plan and in space."""
    item = accuracy(errors)
    return item.mean_2d, item.max_2d, item.std_2d, item.mean_3d, item.max_3d, item.std_3d


def covered(survey: Survey, made) -> tuple[float, float, float]:
    """Shares of the errors east and north at control points within one and two sigma, and the median sigma."""
    errors = residuals(survey.control, correction_between(survey.trajectory, made.trajectory))[:, :2]
    sigma = made.correction.sigma()
    at = np.column_stack([np.interp(survey.control.time, made.correction.time, sigma[:, axis]) for axis in (0, 1)])
    ratio = np.abs(errors) / at
    return float((ratio < 1).mean()), float((ratio < 2).mean()), float(np.median(made.correction.plan_sigma()))


def arguments() -> argparse.Namespace:
    """Of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--city", type=Path, help="folder of a sample city")
    parser.add_argument("--survey", nargs=3, type=Path, action="append", default=[],
                        metavar=("POINTS", "TRAJECTORY", "CONTROL"))
    parser.add_argument("--calibration", type=Path)
    parser.add_argument("--markings", type=Path, required=True, help="mask raster of the reference markings")
    parser.add_argument("--ground", type=Path, help="raster of ground heights: in space")
    parser.add_argument("--landmarks", type=int, default=15, help="every so many-th control point is a landmark")
    parser.add_argument("--trials", type=int, default=40, help="trials from 3 m of initial error")
    parser.add_argument("--tables", default="methods,sensitivity,agreement,start_errors")
    parser.add_argument("--output", type=Path, help="Markdown file")
    return parser.parse_args()


def main() -> int:
    """Make the tables."""
    given = arguments()
    files, calibration = given.survey, given.calibration
    if given.city:
        calibration = calibration or given.city / "mms" / "calibration.json"
        files = [(path, path.with_name(f"{path.stem}_trajectory.csv"),
                  given.city / "truth" / f"control_{path.stem}.csv") for path in sorted(given.city.glob("mms/*.laz"))]
    if not files:
        print("Give --city or --survey.", file=sys.stderr)
        return 2
    surveys = [read_survey(points.stem, points, trajectory, control, calibration, given.landmarks)
               for points, trajectory, control in files]
    evaluation = Evaluation(surveys, Reference.from_mask(given.markings, given.ground), given.trials)
    for name in given.tables.split(","):
        getattr(evaluation, name.strip())()
    if given.output:
        given.output.write_text("\n".join(evaluation.lines), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
