"""Tables of Javanmardi (3-3 to 3-7 and 4-1) for any surveys with control points, as Markdown.

MARKINGS is the mask raster of the reference, GROUND one of heights (then in space). A sample city (--city) has
everything but the reference: make it with “Road markings from aerial frames”. Other surveys: --surveys POINTS
TRAJECTORY CONTROL, once or several times in turn. Every LANDMARKS-th control point is a landmark; POLYGONS of markings
(GeoPackage) give virtual control points. Compared are the survey as reported, landmark updating with some of the
control points, the paper's methods to the letter (3.2.4 in plan, chapter 4 in space) and the method of “Register mobile
survey”. The letter has two rows: with the markings that METHOD=paper finds in a survey, as “Georeference mobile survey”
runs it, and with those of this program, which the other tables take for both. The judge `papers` puts the same on its
page.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import shapely

from scripts.bench_table import Table
from scripts.judges.faults import ATTITUDE_HEADER, FAULTS, DrivenSurvey, Outcome, attitude_row, peak_memory
from scripts.judges.faults import HEADER as FAULT_HEADER
from scripts.judges.faults import row as fault_row
from scripts.judges.faults import run as run_fault
from scripts.judges.virtual_control import reference_corners, survey_corners, virtual_control
from scripts.layers import plans_of
from urbanmap_qgis.errors import UrbanMapError
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.control import ControlPoints, accuracy, in_survey_time, read_control, residuals
from urbanmap_qgis.mobile.landmark_update import update_by_landmarks
from urbanmap_qgis.mobile.markings.extraction import ExtractionSettings
from urbanmap_qgis.mobile.markings.plain_threshold import PlainThreshold
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.pose_correction import correction_between
from urbanmap_qgis.mobile.registration.correction.patch_status import REGISTERED
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.registered_survey import RegisteredSurvey
from urbanmap_qgis.mobile.registration.run import RegistrationRun
from urbanmap_qgis.mobile.registration.stage import register_markings
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.registration.survey_markings import survey_markings
from urbanmap_qgis.mobile.trajectory import Trajectory, interpolate, path_chainage
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

START_ERRORS = (0.5, 1.0, 2.0, 3.0)
"""m, initial errors of the trials of success."""

SUCCESS = 0.10
"""m, mean error in plan at control points that counts as success."""


@dataclass(frozen=True)
class Survey:
    """A survey's marking points, trajectory and control points; every `landmarks`-th of these is used for updating.

    `plain` are the marking points by the paper's threshold. `true` is the true trajectory, where it is known.
    """

    name: str
    markings: MarkingPoints
    plain: MarkingPoints
    trajectory: Trajectory
    control: ControlPoints
    points: int
    landmarks: int
    true: Trajectory | None = None

    @property
    def checks(self) -> ControlPoints:
        """Control points that no method may use."""
        return self.control.select(~self._used())

    @property
    def marks(self) -> ControlPoints:
        """Control points for landmark updating."""
        return self.control.select(self._used())

    def _used(self) -> np.ndarray:
        return np.arange(len(self.control)) % self.landmarks == self.landmarks // 2

    def patch_errors(self, corrected: Trajectory, time: np.ndarray) -> np.ndarray:
        """(n,) m in plan of the trajectory at the patches' times, or at the control points without a true one."""
        if self.true is None:
            return np.hypot(*self.errors(corrected)[:, :2].T)
        time = time[self.true.within(time)]
        return np.hypot(*(interpolate(corrected, time).place - interpolate(self.true, time).place)[:, :2].T)

    def errors(self, corrected: Trajectory | None) -> np.ndarray:
        """(n, 3) m at the control points that no method may use."""
        return residuals(self.checks, correction_between(self.trajectory, corrected) if corrected else None)


def read_survey(name: str, points: Path, trajectory: Path, control: Path, calibration: Path | None,
                landmarks: int) -> Survey:
    """A survey from its files, with its markings extracted; the true trajectory lies beside the control points."""
    cloud = open_cloud([points])
    driven = read_trajectory(trajectory, cloud.crs_wkt).trajectory
    known, _ = in_survey_time(read_control(control), driven)
    scanners = read_calibration(calibration) if calibration else None
    markings, plain = (survey_markings(cloud, driven, ExtractionSettings(plain=threshold), scanners)
                       for threshold in (None, PlainThreshold()))
    true = control.with_name(f"{points.stem}_trajectory.csv")
    true = read_trajectory(true, cloud.crs_wkt).trajectory if true.is_file() else None
    return Survey(name, markings, plain, driven, known, cloud.point_count, landmarks, true)


class Evaluation:
    """Runs the methods on surveys and writes tables."""

    def __init__(self, surveys: list[Survey], reference: Reference, trials: int, polygons: np.ndarray | None = None):
        self.surveys, self.reference, self.trials, self.polygons = surveys, reference, trials, polygons
        self.tables: list[Table] = []

    def table(self, title: str, header: tuple[str, ...], rows: list[tuple], note: str = "") -> None:
        """Add a table and show it."""
        self.tables.append(Table(title, header, rows, note))
        print(self.tables[-1].markdown(), flush=True)

    def ours(self, survey: Survey, **changes):
        """The survey registered by our method, and CPU seconds."""
        run = RegistrationRun(replace(RegistrationSettings(three_d=self.reference.has_heights), **changes))
        start = time.process_time()
        made = register_markings(survey.markings, survey.trajectory, self.reference, run)
        return made, time.process_time() - start

    def letter(self, survey: Survey, markings: MarkingPoints | None = None,
               **changes) -> tuple[RegisteredSurvey, float]:
        """The same by the paper's method to the letter, also where it calls no patch registered."""
        run = RegistrationRun(RegistrationSettings.paper(**changes))
        start = time.process_time()
        made = register_markings(markings or survey.markings, survey.trajectory, self.reference, run)
        return made, time.process_time() - start

    def registered(self, survey: Survey) -> dict[str, RegisteredSurvey]:
        """The survey registered by each method; ours last."""
        found = {}
        for chapter, three_d in (("3.2.4", False), ("chapter 4", True))[:1 + self.reference.has_heights]:
            for whose, markings in (("its own", survey.plain), ("this program's", survey.markings)):
                found[f"the paper to the letter ({chapter}), {whose} markings"] = self.letter(
                    survey, markings, three_d=three_d)[0]
        return {**found, "this program": self.ours(survey)[0]}

    def methods(self) -> None:
        """Tables 3-3, 3-7 and 4-1, at control points and at virtual ones."""
        collected: dict[str, list[np.ndarray]] = {}
        virtual: dict[str, list[np.ndarray]] = {}
        sure, statuses = [], []
        for survey in self.surveys:
            made = self.registered(survey)
            found = {"reported": None, "landmark updating": update_by_landmarks(survey.trajectory, survey.marks),
                     **{name: one.trajectory for name, one in made.items()}}
            vcp = self.virtual(survey, found["this program"])
            rows, length = [], float(path_chainage(survey.trajectory)[-1])
            for name, corrected in found.items():
                errors = survey.errors(corrected)
                collected.setdefault(name, []).append(errors)
                rows.append((name, *figures(errors)))
                if vcp is not None:
                    moved = correction_between(survey.trajectory, corrected) if corrected else None
                    virtual.setdefault(name, []).append(residuals(vcp, moved))
            self.table(f"Tables 3-3 and 4-1: {survey.name}, {length:.0f} m, {len(survey.checks)} control points, "
                       f"{len(survey.marks)} landmarks", HEADER, [*rows, *J_SURVEY_6])
            sure += [(survey.name, name, *covered(survey, one)) for name, one in made.items()]
            statuses += [(survey.name, name, *trust_of(survey, one)) for name, one in made.items()]
        self.table("Tables 3-7 and 4-1: all surveys, control points", HEADER,
                   [*((name, *figures(np.concatenate(errors))) for name, errors in collected.items()), *J_ALL])
        if virtual:
            count = sum(len(part) for part in virtual["reported"])
            self.table(f"All surveys, {count} virtual control points from corners of markings", HEADER,
                       [(name, *figures(np.concatenate(errors))) for name, errors in virtual.items()],
                       "The points' own scatter is part of these figures.")
        self.table("Figure 3-30: all surveys", ("survey", "method", *HEADER[1:4]),
                   [(self.surveys[k].name, name, *figures(errors[k])[:3]) for name, errors in collected.items()
                    for k in range(len(self.surveys))])
        self.table("Honesty of sigma", ("survey", "method", "within 1 sigma", "within 2 sigma", "median sigma (m)"),
                   sure)
        self.table("Statuses", ("survey", "method", "patches registered", "of these off by more than 0.2 m",
                                "of the others"), statuses)

    def virtual(self, survey: Survey, corrected: Trajectory) -> ControlPoints | None:
        """Virtual control points of a survey, None without polygons of the reference."""
        if self.polygons is None:
            return None
        corners = reference_corners(self.reference, self.polygons)
        if not self.reference.has_heights:
            corners[:, 2] = 0.0
        return virtual_control(survey_corners(survey.markings), corners,
                               correction_between(survey.trajectory, corrected))

    def sensitivity(self) -> None:
        """Tables 3-4 to 3-6 and the patch lengths of figure 3-29, on the first survey: errors of patches."""
        survey = self.surveys[0]
        header = ("", "letter mean 2D (m)", "letter max", "this program mean", "this program max", "windows min",
                  "mean", "max", "J mean (m)", "J windows min / mean / max", "CPU of letter (s)")
        for title, name, values, means, lengths in SENSITIVITY:
            rows = []
            for value, mean, window in zip(values, means, lengths):
                try:
                    letter, seconds = self.letter(survey, **{name: value})
                    made = self.ours(survey, **{name: value})[0]
                except UrbanMapError as error:
                    rows.append((f"{value:g}", "refused", str(error).split(":")[0], *[""] * (len(header) - 3)))
                    continue
                theirs, ours = (survey.patch_errors(one.trajectory, letter.windows.time) for one in (letter, made))
                patches = letter.windows.window_last - letter.windows.window_first + 1
                rows.append((f"{value:g}", theirs.mean(), theirs.max(), ours.mean(), ours.max(), int(patches.min()),
                             f"{patches.mean():.1f}", int(patches.max()), mean, window, f"{seconds:.0f}"))
            self.table(f"{title}, {survey.name}", header, rows)

    def heights(self) -> None:
        """From how large an error in height chapter 4 to the letter finds the ground, on the first survey."""
        if not self.reference.has_heights:
            return
        survey, rows = self.surveys[0], []
        bias = float(np.nanmedian(survey.errors(None)[:, 2]))
        for off in (0.0, 0.05, 0.1, 0.2, 0.5):
            moved = moved_survey(survey, np.array([0.0, 0.0, off - bias]))
            made = self.letter(moved, three_d=True)[0]
            errors = moved.errors(made.trajectory)
            rows.append((f"{off:g}", *figures(errors)[:2], float(np.abs(errors[:, 2]).mean()),
                         f"{100 * made.share(REGISTERED):.0f} %"))
        self.table(f"Chapter 4 to the letter from errors in height, {survey.name}",
                   ("initial error in height (m)", "mean 2D (m)", "max 2D", "mean error in height (m)", "registered"),
                   rows)

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

    def faults(self) -> None:
        """Steps, ramps, wrong headings and far starts put into the first survey, and its attitude."""
        survey, rows, attitudes = self.surveys[0], [], []
        if survey.true is None:
            return
        driven = DrivenSurvey(survey.name, survey.markings, survey.trajectory, survey.true)
        settings = RegistrationSettings(three_d=self.reference.has_heights)
        for fault in [item for kind in FAULTS.values() for item in kind]:
            made = run_fault(driven, fault, self.reference, settings)
            rows.append(fault_row(fault.name, survey.name, made))
            if isinstance(made, Outcome):
                attitudes.append(attitude_row(fault.name, survey.name, made))
        self.table("Faulty trajectories", FAULT_HEADER, rows, peak_memory())
        if attitudes and self.reference.has_heights:
            self.table("Faulty trajectories: heights and angles", ATTITUDE_HEADER, attitudes)

    def start_errors(self) -> None:
        """Mean errors at control points of trials from given initial errors, for the letter and this program."""
        rng, rows = np.random.default_rng(0), []
        for size in START_ERRORS:
            ended: dict[str, list[float]] = {"the paper to the letter (3.2.4)": [], "this program": []}
            for number in range(self.trials):
                survey = self.surveys[number % len(self.surveys)]
                direction = rng.uniform(0, 2 * np.pi)
                bias = residuals(survey.control)[:, :2].mean(axis=0)
                move = size * np.array([np.cos(direction), np.sin(direction)]) - bias
                moved = moved_survey(survey, np.append(move, 0.0))
                ended["the paper to the letter (3.2.4)"].append(mean_error(moved, self.letter))
                ended["this program"].append(mean_error(moved, self.ours))
            for name, values in ended.items():
                values = np.array(values)
                rows.append((f"{size:g}", name, len(values), f"{100 * np.mean(values < SUCCESS):.0f} %",
                             float(np.median(values)), float(values.max())))
        self.table("Stability against initial errors", ("initial error (m)", "method", "trials",
                                                        f"within {SUCCESS:g} m",
                                                        "median of mean 2D (m)", "worst"), rows)


def moved_survey(survey: Survey, move: np.ndarray) -> Survey:
    """The survey as if it had been reported elsewhere, by (3,) m."""
    place = Trajectory(survey.trajectory.time, survey.trajectory.place + move, survey.trajectory.angles)
    markings, plain = (replace(old, x=old.x + move[0], y=old.y + move[1], z=old.z + move[2])
                       for old in (survey.markings, survey.plain))
    control = replace(survey.control, surveyed=survey.control.surveyed + move)
    return replace(survey, trajectory=place, markings=markings, plain=plain, control=control)


def mean_error(survey: Survey, register: Callable[[Survey], tuple[RegisteredSurvey, float]]) -> float:
    """Mean error in plan at control points; infinite where the survey is refused."""
    try:
        return float(np.hypot(*survey.errors(register(survey)[0].trajectory)[:, :2].T).mean())
    except UrbanMapError:
        return np.inf


def trust_of(survey: Survey, made: RegisteredSurvey) -> tuple[str, str, str]:
    """Share of patches that are called registered, and how many of these and of others are far off."""
    sure, when = made.correction.status == REGISTERED, made.correction.time
    far = survey.patch_errors(made.trajectory, when) > 0.2 if survey.true is not None else np.zeros(len(sure), bool)
    if len(far) != len(sure):
        sure = sure[survey.true.within(when)]
    shares = (sure.mean(), far[sure].mean() if sure.any() else 0.0, far[~sure].mean() if (~sure).any() else 0.0)
    return tuple(f"{100 * share:.1f} %" for share in shares)


J_SURVEY_6 = [("J Table 3-3, reported", 1.186, 1.405, 0.19, "", "", ""),
              ("J Table 3-3, landmark updating", 0.208, 0.664, 0.11, "", "", ""),
              ("J Table 3-3, proposed", 0.102, 0.206, 0.05, "", "", "")]
J_ALL = [("J Table 3-7, reported", 0.997, 2.064, 0.22, "", "", ""),
         ("J Table 3-7, landmark updating", 0.208, 0.72, 0.16, "", "", ""),
         ("J Table 3-7, proposed", 0.116, 0.277, 0.07, "", "", ""),
         ("J Table 4-1, reported", "", "", "", 1.47, 2.07, 0.26),
         ("J Table 4-1, landmark updating", "", "", "", 0.26, 0.71, 0.10),
         ("J Table 4-1, proposed", "", "", "", 0.13, 0.39, 0.07)]
SENSITIVITY = (
    ("Table 3-4: NDT grid (m)", "ndt_grid", (0.5, 1.0, 2.0, 4.0), (5.01, 0.11, 1.20, 1.22), ("",) * 4),
    ("Table 3-5: initial window (patches)", "window_patches", (15, 30, 60, 120), (0.80, 0.52, 0.11, 3.34),
     ("39 / 59.2 / 95", "39 / 59.2 / 95", "60 / 64.7 / 95", "120 / 120 / 120")),
    ("Table 3-6: required feature count", "feature_count", (200, 400, 600, 800), (2.37, 0.11, 0.72, 3.58),
     ("60 / 60 / 60", "60 / 64.7 / 95", "69 / 90.1 / 130", "90 / 119.7 / 165")),
    ("Figure 3-29: patch length (m)", "patch_length", (0.5, 1.0, 2.0, 4.0), ("",) * 4, ("",) * 4))
HEADER = ("method", "mean 2D (m)", "max 2D", "std 2D", "mean 3D (m)", "max 3D", "std 3D")


def figures(errors: np.ndarray) -> tuple[float, ...]:
    """Mean, maximum and standard deviation in plan and in space."""
    item = accuracy(errors)
    return item.mean_2d, item.max_2d, item.std_2d, item.mean_3d, item.max_3d, item.std_3d


def covered(survey: Survey, made: RegisteredSurvey) -> tuple[float, float, float]:
    """Shares of the errors east and north at control points, of those that have a sigma, within one and two, and the
    median sigma."""
    errors = residuals(survey.control, correction_between(survey.trajectory, made.trajectory))[:, :2]
    sigma = made.correction.sigma()
    at = np.column_stack([np.interp(survey.control.time, made.correction.time, sigma[:, axis]) for axis in (0, 1)])
    known = np.isfinite(at).all(axis=1)
    ratio = np.abs(errors[known]) / at[known]
    return float((ratio < 1).mean()), float((ratio < 2).mean()), made.plan_accuracy()[0]


def read_surveys(city: Path | None, given: Sequence[Path], calibration: Path | None, landmarks: int) -> list[Survey]:
    """Surveys of a sample city, or those of files: points, trajectory and control points of each in turn."""
    files = list(zip(given[::3], given[1::3], given[2::3]))
    if city:
        calibration = calibration or city / "mms" / "calibration.json"
        files = [(path, path.with_name(f"{path.stem}_trajectory.csv"), city / "truth" / f"control_{path.stem}.csv")
                 for path in sorted(city.glob("mms/*.laz"))]
    return [read_survey(points.stem, points, trajectory, control, calibration, landmarks)
            for points, trajectory, control in files]


def judge(markings: Path, city: Path | None = None, surveys: tuple[Path, ...] = (), calibration: Path | None = None,
          ground: Path | None = None, landmarks: int = 15, polygons: Path | None = None, trials: int = 8,
          tables: tuple[str, ...] = ("methods", "sensitivity", "agreement", "heights", "start_errors", "faults"),
          output: Path | None = None) -> None:
    """Make the tables."""
    if not city and not surveys:
        raise SystemExit("Give --city or --surveys.")
    shapes = shapely.get_parts(plans_of(polygons)) if polygons else None
    evaluation = Evaluation(read_surveys(city, surveys, calibration, landmarks),
                            Reference.from_mask(markings, ground), trials, shapes)
    for name in tables:
        getattr(evaluation, name)()
    if output:
        output.write_text("\n".join(table.markdown() for table in evaluation.tables), encoding="utf-8")
