"""urbanmap:adjustframes."""

from __future__ import annotations

import math

from ...urbanmap_qgis.settings.aerial import BundleSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from .frame_inputs import read_camera_and_poses
from .orthorectifyframes import OrthorectifyFrames


class AdjustFrames(UrbanMapAlgorithm):
    ID = "adjustframes"
    NAME = "Adjust frames to control points"
    SOURCE = "Javanmardi, 6.1 (calibration of the aerial data with few ground control points); bundle adjustment"
    KEYWORDS = ("aerial", "frames", "control points", "bundle adjustment", "exterior orientation", "calibration")
    REQUIRES = ("numpy", "scipy")
    HELP = (
        "Corrects the exterior orientation of aerial frames by few control points whose places in the frames were "
        "measured. All frames share a shift and a tilt, each has errors of its own; how much they share is found from "
        "the points. Points without coordinates tie frames to each other.\n"
        "Each control point is left out once and predicted by the others: that figure, or check points, tells what the "
        "orientation is worth away from the points. Points that contradict the others, too few of them, and points "
        "that lie close together are told.\n"
        "Give the corrected orientation to “Orthorectify frames” or “Road markings from aerial frames”."
    )

    def declare(self):
        self.add_from(OrthorectifyFrames, "CAMERA", "EXTERIOR")
        self.add_file("CONTROL", "Points in the frames", "CSV file point,image,column,row,x,y,z: a row for each frame "
                      "in which a point was measured, pixels from the centre of the upper left one, coordinates in "
                      "metres, none for tie points; role: control or check.", "Points in frames (*.csv *.txt)")
        self.add_settings(BundleSettings)
        self.add_from(OrthorectifyFrames, "ANGLE_ORDER", "ANGLE_UNIT")
        self.add_crs("CRS", "Coordinate system", "Of the points and the orientation, for the layer of residuals.",
                     optional=True, advanced=True)
        self.add_file_output("OUTPUT", "Corrected exterior orientation", "As the input, in degrees and the papers' "
                             "order of angles, with standard deviations.", "Exterior orientation (*.csv)")
        self.add_layer_output("OUTPUT_POINTS", "Residuals", "Control and check points with their errors on the ground, "
                              "as given, after, and left out.", optional=True, by_default=True, kind="point")
        self.add_report("Errors at the points and accuracy of the frames.", by_default=True)
        self.add_number_output("POINTS", "Control points", "Number of control points.")
        self.add_number_output("RMS_BEFORE", "RMS before", "RMS error of the control points that do not "
                               "contradict the others, in plan, as given.", "m")
        self.add_number_output("RMS_AFTER", "RMS after", "The same after the adjustment.", "m")
        self.add_number_output("RMS_LEFT_OUT", "RMS left out", "The same, each point left out in turn.", "m")
        self.add_number_output("RMS_CHECK", "RMS of check points", "RMS error of the check points in plan, after.", "m")
        self.add_number_output("WRONG", "Contradicting points", "Control points that contradict the others.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.aerial.orientation.image_points import read_image_points
        from ...urbanmap_qgis.aerial.orientation.stage import control_frames, write_exterior

        camera, poses = read_camera_and_poses(self, parameters, context)
        points = read_image_points(self.input_path(parameters, "CONTROL", context))
        result = control_frames(camera, poses, points, self.settings(BundleSettings, parameters, context),
                                progress.part(0.0, 0.95))
        for sentence in result.findings:
            progress.warn(sentence)
        output = self.output_path(parameters, "OUTPUT", context)
        write_exterior(output, result.adjusted)
        return {"OUTPUT": str(output), **self._figures(result, progress), **self._tell(parameters, context, result)}

    def _figures(self, adjusted, progress) -> dict:
        points = adjusted.points
        results = {"POINTS": int(points.control.sum()), "RMS_BEFORE": adjusted.rms(adjusted.followed, before=True),
                   "RMS_AFTER": adjusted.rms(adjusted.followed), "WRONG": int(adjusted.wrong.sum())}
        progress.message(tr("{0} control points: {1:.3f} m off in plan as given, {2:.3f} m after (RMS).").format(
            int(adjusted.followed.sum()), results["RMS_BEFORE"], results["RMS_AFTER"]))
        left_out, checks = adjusted.left_out_rms(), points.known & points.check
        if math.isfinite(left_out):
            results["RMS_LEFT_OUT"] = left_out
            progress.message(tr("Each control point left out in turn: {0:.3f} m.").format(left_out))
        if checks.any():
            results["RMS_CHECK"] = adjusted.rms(checks)
        return results

    def _tell(self, parameters, context, adjusted) -> dict:
        """Write the layer of residuals and the report."""
        import shapely

        from ...urbanmap_qgis.aerial.orientation.report import write_control_report
        from ...urbanmap_qgis.aerial.orientation.stage import residual_columns

        places = shapely.points(adjusted.points.place[adjusted.points.known])
        results = self.write_layer(parameters, "OUTPUT_POINTS", context, None, residual_columns(adjusted),
                                   self.parameterAsCrs(parameters, "CRS", context), places, "PointZ",
                                   style="control_residuals")
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_control_report, adjusted)
        return results
