"""What registration makes of faulty trajectories: steps, ramps, wrong headings and far starts put into sample cities.

Each fault is added to the reported trajectory, the marking points move with it, and the corrected trajectory is
compared with the true one at every patch. `judge.py registration --tables faults` prints the table.
"""

from __future__ import annotations

import resource
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from urbanmap_qgis.errors import UrbanMapError
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.markings.extraction import ExtractionSettings
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.registration.correction.patch_status import DISTRUSTED, REGISTERED
from urbanmap_qgis.mobile.registration.correction.settings import CorrectionSettings
from urbanmap_qgis.mobile.registration.records import RegistrationSettings
from urbanmap_qgis.mobile.registration.run import RegistrationRun
from urbanmap_qgis.mobile.registration.stage import register_markings
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.registration.survey_markings import survey_markings
from urbanmap_qgis.mobile.registration.trajectory_stops import path_parameters_of
from urbanmap_qgis.mobile.registration.walls.witness import WallWitness
from urbanmap_qgis.mobile.trajectory import Trajectory, interpolate, move_points, path_chainage
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

WRONG = 0.3
"""m in plan: a patch that is farther off must not be called registered."""

NEAR_STEP = 20.0
"""m of path before and after a step in which the correction may be off within its sigma."""


@dataclass(frozen=True)
class DrivenSurvey:
    """A survey with its marking points, reported and true trajectory."""

    name: str
    markings: MarkingPoints
    reported: Trajectory
    true: Trajectory


@dataclass(frozen=True)
class Fault:
    """What is added to a reported trajectory: change (e, 6) of position (m) and angles (degrees) along it.

    Attributes
    ----------
    name : of the fault.  change : of chainage (e,) m and trajectory.  span : of chainage, m, in which it changes fast.
    """

    name: str
    change: Callable[[np.ndarray, Trajectory], np.ndarray]
    span: tuple[float, float] = (np.inf, np.inf)


def step_fault(size: float, length: float, share: float = 0.5, bearing: float = 40.0) -> Fault:
    """A GNSS re-fix: `size` m within `length` m of path after `share` of a survey of 190 m."""
    begin = 190.0 * share - 0.5 * length
    direction = np.array([np.sin(np.radians(bearing)), np.cos(np.radians(bearing))])

    def change(chainage, _trajectory):
        made = np.zeros((len(chainage), 6))
        made[:, :2] = size * np.clip((chainage - begin) / length, 0.0, 1.0)[:, None] * direction
        return made

    return Fault(f"step of {size:g} m in {length:g} m", change, (begin, begin + length))


def ramp_fault(size: float) -> Fault:
    """An error that grows evenly by `size` m along the drive (odometer scale)."""
    def change(chainage, trajectory):
        made, heading = np.zeros((len(chainage), 6)), np.radians(trajectory.angles[:, 2])
        along = size * (chainage / chainage[-1] - 0.5)
        made[:, 0], made[:, 1] = along * np.sin(heading[0]), along * np.cos(heading[0])
        return made

    return Fault(f"ramp of {size:g} m", change)


def constant_fault(name: str, change: tuple[float, ...]) -> Fault:
    """The same (6,) change everywhere."""
    return Fault(name, lambda chainage, _trajectory: np.tile(np.array(change, float), (len(chainage), 1)))


FAULTS = {
    "none": [constant_fault("as reported", (0, 0, 0, 0, 0, 0))],
    "step": [step_fault(size, length) for size, length in ((1.0, 20.0), (1.5, 20.0), (2.0, 20.0), (3.0, 20.0),
                                                           (1.5, 60.0), (3.0, 60.0))],
    "ramp": [ramp_fault(1.4), ramp_fault(4.0)],
    "heading": [constant_fault("heading 2 degrees off", (0, 0, 0, 0, 0, 2.0))],
    "start": [constant_fault("3 m off at the start", (2.1, -2.1, 0, 0, 0, 0)),
              constant_fault("5 m off at the start", (3.5, -3.5, 0, 0, 0, 0))],
}


def faulty(survey: DrivenSurvey, fault: Fault) -> DrivenSurvey:
    """The survey as a navigation with the fault would have placed it."""
    change = fault.change(path_chainage(survey.reported), survey.reported)
    wrong = Trajectory(survey.reported.time, survey.reported.place + change[:, :3],
                       survey.reported.angles + change[:, 3:])
    markings = survey.markings.select(survey.reported.within(survey.markings.time))
    place = move_points(np.column_stack([markings.x, markings.y, markings.z]), markings.time, survey.reported, wrong)
    return replace(survey, markings=replace(markings, x=place[:, 0], y=place[:, 1], z=place[:, 2]), reported=wrong)


def moved_walls(walls: WallWitness | None, before: Trajectory, after: Trajectory) -> WallWitness | None:
    """Facades or kerbs as another trajectory places them."""
    if walls is None:
        return None
    planes = walls.planes
    time_seen = np.interp(planes.chainage, path_chainage(before), before.time)
    place = move_points(planes.place, time_seen, before, after)
    if planes.tilt is None:
        return replace(walls, planes=replace(planes, place=place))
    turned = interpolate(after, time_seen).angles - interpolate(before, time_seen).angles
    rotation = np.einsum("nij,nj->ni", planes.back[:, 3:, 3:], turned)
    lean = rotation[:, 0] * planes.normal[:, 1] - rotation[:, 1] * planes.normal[:, 0]
    shift, way = after.place[:, :2] - before.place[:, :2], path_parameters_of(before, CorrectionSettings().time_weight)
    drift = [np.interp(planes.path_parameter + 1.0, way, axis) - np.interp(planes.path_parameter - 1.0, way, axis)
             for axis in shift.T]
    lean -= 0.5 * (planes.normal * np.column_stack(drift)).sum(axis=1) * planes.sweep
    return replace(walls, planes=replace(planes, place=place, tilt=planes.tilt + lean))


@dataclass(frozen=True)
class Outcome:
    """What came out of one run, at the patches: error (n, 6), sigma (n, 6), status (n,), near the step (n,) bool.

    `seconds` of CPU that registering `length` m took; `told` steps of the correction that were listed.
    """

    error: np.ndarray
    before: np.ndarray
    sigma: np.ndarray
    status: np.ndarray
    near: np.ndarray
    seconds: float
    length: float
    told: str = ""

    @property
    def plan(self) -> np.ndarray:
        """(n,) m."""
        return np.hypot(self.error[:, 0], self.error[:, 1])


def run(survey: DrivenSurvey, fault: Fault, reference: Reference, settings: RegistrationSettings,
        walls: WallWitness | None = None) -> Outcome | str:
    """The survey with the fault, registered, also by its walls where they are given; or why it was refused."""
    wrong = faulty(survey, fault)
    walls = moved_walls(walls, survey.reported, wrong.reported)
    begin = time.process_time()
    try:
        made = register_markings(wrong.markings, wrong.reported, reference, RegistrationRun(settings), walls=walls)
    except UrbanMapError as error:
        return str(error)
    correction = made.correction
    before, after, true = (interpolate(item, correction.time, "hold") for item in (wrong.reported, made.trajectory,
                                                                                   survey.true))
    error, old = (np.column_stack([item.place - true.place, (item.angles - true.angles + 180.0) % 360.0 - 180.0])
                  for item in (after, before))
    chainage = correction.chainage
    near = (chainage > fault.span[0] - NEAR_STEP) & (chainage < fault.span[1] + NEAR_STEP)
    told = "; ".join(f"{step.place:.0f} m: {step.size:.2f} m ({step.kind})" for step in correction.steps)
    return Outcome(error, old, correction.sigma(), correction.status, near, time.process_time() - begin,
                   float(chainage[-1]), told)


HEADER = ("fault", "city", "mean (m)", "max away from the step (m)", "max near it (m)", "near: within 2 sigma",
          "registered", "distrusted", "registered and wrong", "all: 1 sigma", "2 sigma", "CPU (ms/m)")


def row(fault: str, city: str, made: Outcome | str) -> tuple:
    """Figures of one run."""
    if isinstance(made, str):
        return (fault, city, f"refused: {made[:60]}", *[""] * (len(HEADER) - 3))
    ratio = np.abs(made.error[:, :2]) / made.sigma[:, :2]
    kept = made.status != DISTRUSTED
    plan, near = made.plan, made.near
    return (fault, city, float(plan.mean()), float(plan[~near].max(initial=0.0)), float(plan[near].max(initial=0.0)),
            percent((ratio[near] < 2).all(axis=1)), percent(made.status == REGISTERED), percent(~kept),
            int(((made.status == REGISTERED) & (plan > WRONG)).sum()), percent(ratio[kept] < 1),
            percent(ratio[kept] < 2), f"{1000 * made.seconds / made.length:.0f}")


def peak_memory() -> str:
    """The most memory that this process held, as text."""
    return f"Memory at most: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB."


ATTITUDE_HEADER = ("fault", "city", "height before (m)", "after", "2 sigma", "roll before (deg)", "after", "2 sigma",
                   "pitch before (deg)", "after", "2 sigma", "heading before (deg)", "after", "2 sigma")


def attitude_row(fault: str, city: str, made: Outcome) -> tuple:
    """Mean errors of height and angles before and after, and how many lie within two sigma."""
    kept, found = made.status != DISTRUSTED, []
    for axis in (2, 3, 4, 5):
        found += [float(np.abs(made.before[:, axis]).mean()), float(np.abs(made.error[:, axis]).mean()),
                  percent(np.abs(made.error[kept, axis]) < 2 * made.sigma[kept, axis])]
    return (fault, city, *found)


def percent(mask: np.ndarray) -> str:
    """Share of a mask, as text."""
    return f"{100 * mask.mean():.0f} %" if mask.size else "-"


def read_survey(city: Path, name: str) -> DrivenSurvey:
    """A survey of a sample city."""
    cloud = open_cloud([city / "mms" / f"{name}.laz"])
    reported = read_trajectory(city / "mms" / f"{name}_trajectory.csv", cloud.crs_wkt).trajectory
    true = read_trajectory(city / "truth" / f"{name}_trajectory.csv", cloud.crs_wkt).trajectory
    markings = survey_markings(cloud, reported, ExtractionSettings(),
                               read_calibration(city / "mms" / "calibration.json"))
    return DrivenSurvey(name, markings, reported, true)
