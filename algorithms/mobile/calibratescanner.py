"""urbanmap:calibratescanner."""

from __future__ import annotations

from ...urbanmap_qgis.settings.lines import BoresightSettings
from ..framework.base import UrbanMapAlgorithm

FIELDS = ("scanner", "parameter", "unit", "correction", "sigma", "status")


class CalibrateScanner(UrbanMapAlgorithm):
    ID = "calibratescanner"
    NAME = "Calibrate scanners"
    SOURCE = "least-squares adjustment of planes seen from different sides"
    KEYWORDS = ("MMS", "mobile", "calibration", "boresight", "lever arm", "scanner")
    REQUIRES = ("numpy", "scipy", "pyproj", "laspy", "lazrs")
    HELP = (
        "Corrects boresight angles and lever arms of scanners on a vehicle. Small planes of road and walls that two "
        "scanners saw, or one scanner in passes of different directions, must coincide; the trajectory of each pass "
        "may be off as well.\n"
        "Drive a street with walls in both directions, correct the trajectories (“Adjust several drives” or “Register "
        "mobile survey”) and place the points with them first. A misalignment of the inertial unit that all passes "
        "have in common becomes part of the boresight.\n"
        "What the drives do not determine keeps its value and is called so: heights of lever arms mostly need control "
        "points."
    )

    def declare(self):
        self.add_points(help="The survey: LAS, LAZ or COPC files with GPS times and the number of the scanner as point "
                        "source id. Each file belongs to the trajectory along which it was measured.")
        self.add_trajectories()
        self.add_calibration()
        self.add_settings(BoresightSettings)
        self.add_file_output("OUTPUT", "Corrected calibration", "The calibration file with corrected values; for each "
                             "its standard deviation, or that it is not determined.", "Calibration (*.json)")
        self.add_layer_output("OUTPUT_TABLE", "Corrections", "Table: scanner, parameter, correction, standard "
                              "deviation, status.", optional=True, by_default=True, kind="any")
        self.add_report("Corrections with their standard deviations, and how far planes lie apart before and after.",
                        by_default=True)
        self.add_number_output("PAIRS", "Pairs of planes", "Planes that were compared.")
        self.add_number_output("RMS_BEFORE", "RMS before", "Distance between planes before, trajectories corrected.",
                               "m")
        self.add_number_output("RMS_AFTER", "RMS after", "Distance between planes after.", "m")
        self.add_number_output("DETERMINED", "Determined", "Number of values that are determined.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.mobile.adjustment.drive_clouds import assign_clouds
        from ...urbanmap_qgis.mobile.boresight.stage import calibrate_scanners, write_calibration

        paths = self.point_files(parameters, "POINTS", context)
        crs = self.projected_cloud(parameters, context).crs_wkt
        trajectories = [item.trajectory for item in self.read_trajectories(parameters, context, crs, progress)]
        names = [path.stem for path in self.trajectory_files(parameters, context)]
        source = self.input_path(parameters, "CALIBRATION", context)
        settings = self.settings(BoresightSettings, parameters, context)
        result = calibrate_scanners(assign_clouds(paths, trajectories, names), trajectories,
                                    self.read_calibration(parameters, context), settings, progress)
        output = self.output_path(parameters, "OUTPUT", context)
        write_calibration(output, source, result)
        return {"OUTPUT": str(output), **self._figures(result), **self._tell(parameters, context, result, progress)}

    def _figures(self, calibrated) -> dict:
        found = calibrated.boresights
        return {"PAIRS": found.pairs, "RMS_BEFORE": found.rms_before, "RMS_AFTER": found.rms_after,
                "DETERMINED": int(found.determined.sum())}

    def _tell(self, parameters, context, calibrated, progress) -> dict:
        """Write table and report."""
        from ...urbanmap_qgis.mobile.boresight.report import write_boresight_report

        columns = {name: list(values) for name, values in zip(FIELDS, zip(*calibrated.rows()))}
        results = self.write_layer(parameters, "OUTPUT_TABLE", context, None, columns, "",
                                   style="boresight_corrections", progress=progress)
        return results | self.write_file(parameters, "OUTPUT_REPORT", context, write_boresight_report, calibrated)
