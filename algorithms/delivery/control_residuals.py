"""Residuals of a mobile survey at control points, which “Acceptance report” judges it by."""

from __future__ import annotations

from dataclasses import replace

from ..framework.declaring.parameters import HTML_FILTER, tr
from ..mobile.control_points import CRS_HELP, read_check_points

FIGURES = {"MEAN_2D": "Mean error in plan", "MAX_2D": "Maximum error in plan",
           "STD_2D": "Standard deviation of errors in plan", "MEAN_3D": "Mean error in space",
           "MAX_3D": "Maximum error in space", "STD_3D": "Standard deviation of errors in space"}


class ControlResiduals:
    """What “Acceptance report” does with control points and the trajectory of a mobile survey (J 3.3.5)."""

    def add_survey(self) -> None:
        """Declare the survey that control points were measured in."""
        self.add_trajectory("TRAJECTORY", "Reported trajectory", "The trajectory with which a mobile survey was "
                            "placed: CSV time,x,y,z,roll,pitch,heading, SBET, or a point layer with these fields. The "
                            "check points are then control points: id,x,y,z (where a point truly lies, metres) and "
                            "time,x_mms,y_mms,z_mms (when the survey measured it, GPS seconds, and where it lies in "
                            "the survey); heights may be missing.", optional=True)
        self.add_trajectory("CORRECTED", "Corrected trajectory", "The same after a correction. Without it the survey "
                            "is measured as it is.", optional=True)
        self.add_trajectory_reading()
        self.add_crs("CRS", "Coordinate reference system", CRS_HELP, optional=True, advanced=True)

    def add_survey_outputs(self) -> None:
        """Declare what is told of control points."""
        self.add_layer_output("OUTPUT", "Residuals", "One point at each control point, with the error before and after "
                              "(m, east, north, up, in plan and in space).", optional=True, kind="point")
        self.add_file_output("OUTPUT_ERRORS", "Report of the residuals", "Figures, errors over time, the worst "
                             "points.", HTML_FILTER, optional=True)
        for name, label in FIGURES.items():
            self.add_number_output(name, label, f"{label} at the control points.", unit="m")
        self.add_number_output("POINTS_USED", "Control points used", "Those measured during the survey.")

    def check_survey(self, parameters) -> None:
        """Refuse a corrected trajectory or a trajectory that lacks what it is compared with.

        Raises
        ------
        InputError : with what to give.
        """
        from ...urbanmap_qgis.errors import InputError

        if parameters.get("CORRECTED") and not parameters.get("TRAJECTORY"):
            raise InputError(tr("A corrected trajectory is compared with the reported one: give this too."))
        if parameters.get("TRAJECTORY") and not parameters.get("INPUT"):
            raise InputError(tr("A trajectory is judged by control points: give these as check points."))
        told = [name for name in ("OUTPUT", "OUTPUT_ERRORS") if parameters.get(name)]
        if told and not parameters.get("TRAJECTORY"):
            raise InputError(tr("{0}: residuals are of control points in a survey: give its trajectory, or leave them "
                                "out.").format(self.label_of(told[0])))

    def check_table(self, parameters, context, progress):
        """Results at control points, where a trajectory is given, and the table of check points."""
        if parameters.get("TRAJECTORY"):
            return self.residuals_of_survey(parameters, context, progress)
        from ...urbanmap_qgis.acceptance.check_points import check_point_columns

        return {}, self.read_table(parameters, "INPUT", context, check_point_columns, progress)

    def residuals_of_survey(self, parameters, context, progress):
        """Results at the control points of INPUT, and a table of their residuals."""
        from ...urbanmap_qgis.mobile.accuracy_report import write_accuracy_report
        from ...urbanmap_qgis.mobile.control import accuracy, in_survey_time, residuals
        from ...urbanmap_qgis.mobile.pose_correction import correction_between

        control, crs, adjusted, table = read_check_points(self, parameters, "INPUT", context, progress)
        reported = self.read_trajectory(parameters, "TRAJECTORY", context, crs or None, progress)
        progress.step(0.3)
        corrected = self.read_trajectory(parameters, "CORRECTED", context, crs or None, progress)
        progress.step(0.6)
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
        columns, places = _residual_columns(used, list(errors.values()))
        if parameters.get("OUTPUT"):
            results |= self.write_layer(
                parameters, "OUTPUT", context, None, columns, crs or reported.crs_wkt or "", places, "PointZ",
                style="control_residuals", progress=progress)
        results |= self.write_file(parameters, "OUTPUT_ERRORS", context, write_accuracy_report, used, errors, left_out,
                                   adjusted)
        return results, replace(table, columns=columns, geometries=places)


def _residual_columns(control, errors):
    """Columns of the residuals and their places; without a corrected trajectory the columns “after” are empty."""
    import numpy as np
    import shapely

    columns = {"id": list(control.id), "time": control.time}
    for suffix, values in zip(("before", "after"), (errors[0], errors[1] if len(errors) > 1 else None)):
        if values is None:
            values = np.full((len(control), 3), np.nan)
        columns.update({f"{axis}_{suffix}": values[:, k] for k, axis in enumerate(("east", "north", "up"))})
        columns[f"plan_{suffix}"] = np.hypot(values[:, 0], values[:, 1])
        columns[f"space_{suffix}"] = np.linalg.norm(values, axis=1)
    return columns, shapely.points(np.where(np.isfinite(control.true), control.true, 0.0))
