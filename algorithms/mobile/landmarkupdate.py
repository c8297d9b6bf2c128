"""urbanmap:landmarkupdate."""

from __future__ import annotations

from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from .control_points import add_control, read_control


class LandmarkUpdate(UrbanMapAlgorithm):
    ID = "landmarkupdate"
    SUCCESSOR = "adjustsurveys"
    NAME = "Landmark update"
    SOURCE = "Javanmardi, 3.1"
    KEYWORDS = ("landmark", "control", "GCP", "trajectory", "correction", "baseline")
    REQUIRES = ("numpy", "pyproj", "laspy", "lazrs")
    HELP = (
        "Moves a trajectory so that it meets control points: the usual method, to compare “Register mobile survey” "
        "with.\n"
        "The correction at each control point is its true place less its place in the survey. Between control points "
        "it is interpolated over time; before the first and after the last it stays as it is. Angles are not "
        "touched. The result is good near control points and follows the error of the survey between them."
    )

    def declare(self):
        self.add_trajectory()
        self.add_trajectory_reading()
        add_control(self)
        self.add_trajectory_output()
        self.add_number_output("POINTS_USED", "Control points used", "Those measured during the survey.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.mobile.control import in_survey_time
        from ...urbanmap_qgis.mobile.landmark_update import update_by_landmarks

        control, crs = read_control(self, parameters, context, progress)
        reported = self.read_trajectory(parameters, "TRAJECTORY", context, crs or None, progress)
        used, left_out = in_survey_time(control, reported.trajectory)
        if left_out:
            progress.warn(tr("{0} control points were not measured during this survey: they are left out.").format(
                left_out))
        updated = update_by_landmarks(reported.trajectory, used)
        return {"OUTPUT": self.write_trajectory(parameters, "OUTPUT", context, reported, updated, crs),
                "POINTS_USED": len(used)}
