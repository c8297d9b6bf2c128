"""urbanmap:adjustals."""

from __future__ import annotations

import math

from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields

FIELDS = ("id", "role", "plan_before", "plan_after", "east_before", "north_before", "up_before", "east_after",
          "north_after", "up_after", "east_left_out", "north_left_out", "up_left_out")
AXES = ("EAST", "NORTH", "UP")


class AdjustAls(UrbanMapAlgorithm):
    ID = "adjustals"
    NAME = "Adjust laser points to control points"
    SOURCE = "Javanmardi, 6.1 (calibration of the aerial data with few ground control points)"
    KEYWORDS = ("ALS", "lidar", "control points", "height offset", "calibration", "shift")
    REQUIRES = ("numpy", "scipy", "laspy", "lazrs", "pyproj")
    HELP = (
        "Shifts an airborne laser point cloud to few control points. Where a point has only its true coordinates, the "
        "height of the cloud is measured there: a plane through the ground points around it. Where the point was "
        "found in the cloud, too (a roof's corner, a marking), its place there tells the shift in plan.\n"
        "Each control point is left out once and predicted by the others; points that contradict the others are named "
        "and not followed. Check points are only compared. Few or clustered points are told.\n"
        "All points are shifted alike and keep their attributes. Give the result to “Surface and ground from ALS” or "
        "“Road markings from aerial frames”."
    )

    def declare(self):
        self.add_points()
        self.add_file("CONTROL", "Control points", "CSV file id,x,y,z in the cloud's coordinate system and heights; "
                      "x_als,y_als,z_als where the point lies in the cloud, if it was found there; role: control or "
                      "check.", "Control points (*.csv *.txt)")
        self.add_distance("CONTROL_SIGMA", "Accuracy of the control points", "Standard deviation of their coordinates "
                          "and of their places in the cloud, in metres.", 0.03, 0.001, 10.0)
        self.add_points_crs()
        self.add_points_output("OUTPUT", "Shifted points", "All points in their order, with all attributes.")
        self.add_layer_output("OUTPUT_POINTS", "Residuals", "Control and check points with the cloud's errors, as "
                              "given, after, and left out.", optional=True, by_default=True, kind="point")
        self.add_report("The shift, its accuracy, and errors at the points.", by_default=True)
        for axis, name in zip(AXES, ("Shift east", "Shift north", "Shift up")):
            self.add_number_output(f"SHIFT_{axis}", name, "By how much the cloud was shifted.", "m")
        self.add_number_output("RMS_BEFORE", "RMS before", "RMS error in height of the control points that are "
                               "followed, as given.", "m")
        self.add_number_output("RMS_AFTER", "RMS after", "The same after the adjustment.", "m")
        self.add_number_output("RMS_LEFT_OUT", "RMS left out", "The same, each point left out in turn.", "m")
        self.add_number_output("RMS_CHECK", "RMS of check points", "RMS error of the check points in height, after.",
                               "m")
        self.add_number_output("WRONG", "Contradicting points", "Control points that contradict the others.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.aerial.orientation.cloud_control import control_cloud, write_shifted
        from ...urbanmap_qgis.aerial.orientation.cloud_points import measured_heights, read_cloud_points

        cloud = self.projected_cloud(parameters, context)
        points = measured_heights(read_cloud_points(self.input_path(parameters, "CONTROL", context)), cloud,
                                  progress.part(0.0, 0.4))
        adjusted = control_cloud(points, self.parameterAsDouble(parameters, "CONTROL_SIGMA", context),
                             (cloud.maximum - cloud.minimum)[:2])
        for sentence in adjusted.findings:
            progress.warn(sentence)
        output = self.output_path(parameters, "OUTPUT", context)
        write_shifted(cloud, adjusted.shift, output, progress.part(0.4, 0.95))
        progress.message(tr("Shifted by {0:.3f} m east, {1:.3f} m north, {2:.3f} m up.").format(*adjusted.shift))
        return {"OUTPUT": str(output), **_figures(adjusted), **self._tell(parameters, context, adjusted, cloud.crs_wkt)}

    def _tell(self, parameters, context, adjusted, crs_wkt) -> dict:
        """Write the layer of residuals and the report."""
        import shapely

        from ...urbanmap_qgis.aerial.orientation.cloud_control import residual_rows
        from ...urbanmap_qgis.aerial.orientation.cloud_report import write_cloud_report

        results = self.write_layer(parameters, "OUTPUT_POINTS", context, make_fields(*FIELDS), residual_rows(adjusted),
                                   crs_wkt, shapely.points(adjusted.points.true), "PointZ", style="control_residuals")
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_cloud_report, adjusted)
        return results


def _figures(adjusted) -> dict:
    control = adjusted.used.any(axis=1)
    figures = {f"SHIFT_{axis}": float(value) for axis, value in zip(AXES, adjusted.shift)}
    figures |= {"RMS_BEFORE": adjusted.rms(adjusted.points.errors, control)[1],
                "RMS_AFTER": adjusted.rms(adjusted.after, control)[1],
                "RMS_LEFT_OUT": adjusted.rms(adjusted.left_out, control)[1],
                "RMS_CHECK": adjusted.rms(adjusted.after, adjusted.points.check)[1], "WRONG": int(adjusted.wrong.sum())}
    return {name: value for name, value in figures.items() if math.isfinite(value)}
