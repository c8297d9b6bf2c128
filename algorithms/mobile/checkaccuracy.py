"""urbanmap:checkaccuracy."""

from __future__ import annotations

from qgis.core import QgsProcessing

from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import HTML_FILTER, tr
from ..framework.layers.layers import make_fields
from .control_points import add_control, read_check_points

FIGURES = {"MEAN_2D": "Mean error in plan", "MAX_2D": "Maximum error in plan",
           "STD_2D": "Standard deviation of errors in plan", "MEAN_3D": "Mean error in space",
           "MAX_3D": "Maximum error in space", "STD_3D": "Standard deviation of errors in space"}


class CheckAccuracy(UrbanMapAlgorithm):
    ID = "checkaccuracy"
    NAME = "Check accuracy at control points"
    SOURCE = "Javanmardi, 3.3.5"
    KEYWORDS = ("control", "GCP", "accuracy", "residual", "error", "mobile", "survey")
    REQUIRES = ("numpy", "shapely", "pyproj", "laspy", "lazrs")
    HELP = (
        "Measures how far a mobile survey is off at control points, as it was reported and, where a corrected "
        "trajectory is given, as that places it.\n"
        "The numbers are of the corrected survey where one is given, otherwise of the survey as it is.\n"
        "A column “role” (check, adjusted) tells points apart: those that the survey was adjusted to are left out."
    )

    def declare(self):
        add_control(self)
        self.add_trajectory("TRAJECTORY", "Reported trajectory", "The trajectory with which the survey was placed: CSV "
                            "time,x,y,z,roll,pitch,heading, SBET, or a point layer with these fields.")
        self.add_trajectory("CORRECTED", "Corrected trajectory", "The same after a correction. Without it the survey "
                            "is measured as it is.", optional=True)
        self.add_trajectory_reading()
        self.add_layer_output("OUTPUT", "Residuals", "One point at each control point, with the error before and after "
                              "(m, east, north, up, in plan and in space).",
                              source_type=QgsProcessing.SourceType.TypeVectorPoint)
        self.add_file_output("OUTPUT_REPORT", "Report", "Figures, errors over time, the worst points.", HTML_FILTER,
                             optional=True, by_default=True)
        for name, label in FIGURES.items():
            self.add_number_output(name, label, f"{label} at the control points.", unit="m")
        self.add_number_output("POINTS_USED", "Control points used", "Those measured during the survey.")

    def compute(self, parameters, context, feedback):
        from ...urbanmap_qgis.mobile.accuracy_report import write_accuracy_report
        from ...urbanmap_qgis.mobile.control import accuracy, in_survey_time, residuals
        from ...urbanmap_qgis.mobile.pose_correction import correction_between

        progress = self.progress(feedback)
        control, crs, adjusted = read_check_points(self, parameters, context, progress)
        reported = self.read_trajectory(parameters, "TRAJECTORY", context, crs or None, progress)
        corrected = self.read_trajectory(parameters, "CORRECTED", context, crs or None, progress)
        used, left_out = in_survey_time(control, reported.trajectory)
        if left_out:
            progress.warn(tr("{0} control points were not measured during this survey: they are left out.").format(
                left_out))
        errors = {tr("as reported"): residuals(used)}
        if corrected:
            errors[tr("corrected")] = residuals(used, correction_between(reported.trajectory, corrected.trajectory))
        figures = accuracy(list(errors.values())[-1])
        results = {name: getattr(figures, name.lower()) for name in FIGURES}
        results = {name: value for name, value in results.items() if value == value}
        results["POINTS_USED"] = len(used)
        results["OUTPUT"] = self._write_residuals(parameters, context, used, list(errors.values()),
                                                  crs or reported.crs_wkt or "", progress)
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_accuracy_report, used, errors, left_out,
                                   adjusted)
        return results

    def _write_residuals(self, parameters, context, control, errors, crs, progress):
        """The layer of residuals; without a corrected trajectory its fields “after” are empty."""
        import numpy as np
        import shapely

        columns = {"id": list(control.id), "time": control.time}
        for suffix, values in zip(("before", "after"), (errors[0], errors[1] if len(errors) > 1 else None)):
            if values is None:
                values = np.full((len(control), 3), np.nan)
            columns.update({f"{axis}_{suffix}": values[:, k] for k, axis in enumerate(("east", "north", "up"))})
            columns[f"plan_{suffix}"] = np.hypot(values[:, 0], values[:, 1])
            columns[f"space_{suffix}"] = np.linalg.norm(values, axis=1)
        fields = make_fields("id", *((name, "real") for name in columns if name != "id"))
        places = shapely.points(np.where(np.isfinite(control.true), control.true, 0.0))
        return self.write_layer(parameters, "OUTPUT", context, fields, columns, crs, places, "PointZ",
                                style="control_residuals", progress=progress)
