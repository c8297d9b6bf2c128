"""urbanmap:roadmarkingsfrommms."""

from __future__ import annotations

from ...urbanmap_qgis.settings.mobile import ReachRules, StrokeRules
from ...urbanmap_qgis.settings.terrain import ClothSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import HTML_FILTER
from .survey_inputs import read_survey

METHODS = ("full", "paper")


class RoadMarkingsFromMms(UrbanMapAlgorithm):
    ID = "roadmarkingsfrommms"
    NAME = "Road markings of a mobile survey"
    SOURCE = "Javanmardi, 3.2.3"
    KEYWORDS = ("MMS", "marking", "paint", "lane", "intensity", "reflectance", "calibration", "lidar", "threshold")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "cv2", "rasterio")
    HELP = (
        "Takes the points on road markings out of a mobile laser survey by their intensity.\n"
        "Intensity falls with range and incidence: asphalt's is fitted as a curve over range for each scanner, and all "
        "intensities are divided by it. Points brighter than the ground round them are marking points, if they form "
        "strokes; kerbs, feet of walls and wide bright surfaces are left out.\n"
        "Ground is taken by class 2 where at least 1 % of the points have it, otherwise found by the cloth filter. The "
        "survey is worked on along the path: passes through the same place are not mixed, and what was measured "
        "while the vehicle stood for more than a second is left out. The files may be larger than memory."
    )

    def declare(self):
        self.add_points(help="The survey: LAS, LAZ or COPC files with intensities and GPS times, in one projected "
                        "coordinate system.")
        self.add_trajectory()
        self.add_calibration(optional=True)
        self.add_trajectory_reading()
        self.add_settings(ReachRules, "max_range")
        self.add_settings(StrokeRules, "block_size")
        self.add_choice("METHOD", "Method", "Full, or as in the paper to the letter: the adaptive threshold of block "
                        "and grey contrast alone, on an image of 12 cm; contrast, stroke width and length do not count "
                        "then, and kerbs, feet of walls and specks stay.", METHODS, "full", advanced=True)
        self.add_number("GREY_CONTRAST", "Grey contrast", "With the paper's method: by how many grey levels of 256 a "
                        "marking exceeds the weighted mean of its block (c). White is the intensity that 0.1 % of the "
                        "ground exceeds.", 17.0, 1.0, 200.0, advanced=True)
        self.add_settings(StrokeRules)
        self.add_settings(ReachRules)
        self.add_settings(ClothSettings, "resolution", "iterations", "threshold")
        self.add_points_crs()
        self.add_workers()
        self.add_points_output("OUTPUT", "Marking points", "Points on markings with all their attributes, and "
                               "calibrated_intensity (asphalt has the reference intensity) and marking_weight (0 to 1: "
                               "how far above the middle between ground and paint).")
        self.add_file_output("OUTPUT_CURVE", "Intensity over range", "Page with plot, table and quality of the fit of "
                             "each scanner.", HTML_FILTER, optional=True, by_default=True)
        self.add_number_output("POINTS_READ", "Points read", "All points in the files.")
        self.add_number_output("GROUND_POINTS", "Ground points", "Ground points within range of the vehicle.")
        self.add_number_output("MARKING_POINTS", "Marking points", "Points in the result.")
        self.add_number_output("MARKING_SHARE", "Marking share", "Marking points as a share of the ground points that "
                               "could be judged, 0 to 1.")
        self.add_number_output("PAINT_CONTRAST", "Contrast of paint", "Median intensity of marking points, in units of "
                               "that of the ground beside them; no value without markings.")
        self.add_number_output("FIT_RESIDUAL", "Residual of the fit", "By how much asphalt in bins of range departs "
                               "from the curve, as a share of it (robust standard deviation; worst scanner).")
        self.add_number_output("FIT_SCATTER", "Scatter of asphalt", "Standard deviation of single asphalt points round "
                               "the curve, as a share of it (of the same scanner).")
        self.add_number_output("SCANNERS", "Scanners", "Scanners with a curve.")
        self.add_number_output("FARTHEST_RANGE", "Maximum range used", "R2: range up to which points are used.", "m")
        self.add_number_output("MARKED_WAY", "Path with markings", "Share of the path, by 20 m, with marking "
                               "points, 0 to 1.")
        self.add_number_output("LEFT_OUT", "Points left out", "Points at times for which the trajectory has no place, "
                               "or at which the vehicle stood.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.mobile.markings.curve_report import doubts, facts_of, write_curve_report
        from ...urbanmap_qgis.mobile.markings.markings_file import markings_to_file

        paths, _, trajectory = read_survey(self, parameters, context, progress)
        calibration = self.read_calibration(parameters, context)
        output = self.output_path(parameters, "OUTPUT", context)
        with self.workers(parameters, context) as executor:
            result = markings_to_file(paths, output, trajectory.trajectory, calibration,
                                      self._settings(parameters, context), progress.part(0.0, 0.98), executor)
        for sentence in doubts(result):
            progress.warn(sentence)
        return {"OUTPUT": str(output), **facts_of(result), **self.write_file(
            parameters, "OUTPUT_CURVE", context, write_curve_report, result, [path.name for path in paths])}

    def _settings(self, parameters, context):
        from ...urbanmap_qgis.mobile.markings.extraction import ExtractionSettings
        from ...urbanmap_qgis.mobile.markings.marking_points import MarkingPointSettings
        from ...urbanmap_qgis.mobile.markings.plain_threshold import PlainThreshold

        marking, plain = self.settings(MarkingPointSettings, parameters, context), None
        if self.parameterAsString(parameters, "METHOD", context) == "paper":
            plain = PlainThreshold(marking.block_size, self.parameterAsDouble(parameters, "GREY_CONTRAST", context))
        return self.settings(ExtractionSettings, parameters, context, marking=marking, plain=plain,
                             cloth=self.settings(ClothSettings, parameters, context))
