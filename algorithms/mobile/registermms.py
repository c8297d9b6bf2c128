"""urbanmap:registermms."""

from __future__ import annotations

from dataclasses import replace

from ...urbanmap_qgis.settings.mobile import TrustSettings, WindowChoice, WindowSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.layers.layers import make_fields
from .marking_reference import add_markings
from .survey_inputs import read_survey_and_reference
from .wall_inputs import add_walls, read_walls

METHODS = ("full", "paper")


class RegisterMms(UrbanMapAlgorithm):
    ID = "registermms"
    NAME = "Register mobile survey"
    SOURCE = "Javanmardi, 3.2.4 and 4"
    KEYWORDS = ("MMS", "mobile", "registration", "NDT", "trajectory", "correction", "marking", "georeferencing")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    HELP = (
        "Finds how the trajectory of a mobile survey is off, by laying its road markings on those of an aerial "
        "reference, and corrects it.\n"
        "The driven path is cut into short patches; each is registered with a window of patches round it that is as "
        "long as its markings need. The windows' results become one smooth correction over the path: stretches that "
        "contradict the rest lose their weight, gaps are bridged with growing uncertainty, and each patch says how its "
        "correction was found and how sure it is.\n"
        "With ground heights (a raster, or polygons with heights) the correction is in space; without them heights, "
        "roll and pitch stay as they are. With outlines or models of buildings the facades that the survey saw are a "
        "second witness beside the markings: they hold the survey where there is no paint, and where both disagree "
        "nothing is called registered. Apply the result with “Apply corrected trajectory”."
    )

    def declare(self):
        self.add_points(help="A survey (LAS, LAZ or COPC with intensities and GPS times) or, faster, its markings as "
                        "“Road markings of a mobile survey” writes them.")
        self.add_trajectory(help="Where the vehicle was: CSV time,x,y,z,roll,pitch,heading (GPS seconds, metres, "
                            "degrees; with sd_roll,sd_pitch,sd_heading where their accuracy is known), Applanix SBET "
                            "(with its smrmsg file beside it), or a point layer with these fields.")
        add_markings(self)
        add_walls(self)
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres, in the height system of the "
                        "survey. With it the correction is in space.", optional=True)
        self.add_calibration(optional=True)
        self.add_trajectory_reading()
        self.add_settings(WindowSettings, "patch_length")
        self.add_settings(WindowChoice, "window_patches", "max_window_patches")
        self.add_settings(WindowSettings, "feature_grid", "feature_count", "ndt_grid", "iterations")
        self.add_settings(WindowChoice)
        self.add_settings(WindowSettings, "search")
        self.add_choice("METHOD", "Method", "Full, or as in the paper to the letter: windows as rigid bodies, each "
                        "started from the one before, and each patch moved by the matrix of its own window; no "
                        "model of the drift, no weights, no bridging. In plan as in 3.2.4, with ground heights as in "
                        "chapter 4. The markings of a whole survey are found by the paper's threshold.",
                        METHODS, "full", advanced=True)
        self.add_settings(TrustSettings, "reference_sigma")
        self.add_settings(WindowSettings)
        self.add_number("ATTITUDE_SIGMA", "Accuracy of roll and pitch", "Standard deviation of the reported roll and "
                        "pitch; that of the heading is twice as large. Not used where the trajectory states its own "
                        "(columns sd_roll, sd_pitch, sd_heading, or the smrmsg file beside an SBET).", 0.05, 0.001,
                        10.0, unit="degrees", advanced=True)
        self.add_settings(TrustSettings)
        self.add_raster("IMAGE", "Aerial image", "Shown behind the markings in the report.", optional=True)
        self.add_points_crs()
        self.add_workers()
        self.add_trajectory_output()
        self.add_layer_output("OUTPUT_PATCHES", "Patches", "One point a patch at its corrected place, with correction "
                              "(m, degrees), standard deviations (absolute with REFERENCE_SIGMA and what steps of the "
                              "reference too small to be told add; sigma_relative without both), window, score, status "
                              "and its reason; with walls the share of each witness (paint, walls).", optional=True,
                              by_default=True, kind="point")
        self.add_layer_output("OUTPUT_STEPS", "Disagreements", "One point a place where reference and survey disagree: "
                              "edges of markings that changed after the flight, a reference that jumps, steps hidden "
                              "where there are no markings, stretches where walls want the survey elsewhere than the "
                              "markings; with size (m), direction (degrees from north) and standard deviation.",
                              optional=True, kind="point")
        self.add_layer_output("OUTPUT_AREAS", "Areas of disagreement", "One polygon a stretch of road in which "
                              "reference and survey disagree, as wide as its markings: markings that changed after the "
                              "flight, the road about a step of which nobody can say the right side, stretches where a "
                              "step hides or walls want the survey elsewhere; with chainages (m), size (m), direction "
                              "(degrees from north) and standard deviation.", optional=True, kind="polygon")
        self.add_report("Correction and its uncertainty along the path, pictures before and after, what to distrust.",
                        by_default=True)
        self.add_number_output("WAY", "Path length", "Length of the driven path.", "m")
        self.add_number_output("MEAN_CORRECTION", "Mean correction", "In plan, over the path.", "m")
        self.add_number_output("MAX_CORRECTION", "Maximum correction", "In plan.", "m")
        self.add_number_output("REGISTERED_SHARE", "Registered", "Share of the path that is registered, 0 to 1.")
        self.add_number_output("BRIDGED_SHARE", "Bridged", "Share of the path that is bridged, 0 to 1.")
        self.add_number_output("DISTRUSTED_SHARE", "Not to be trusted", "Share of the path not to be trusted, 0 to 1.")
        self.add_number_output("MEDIAN_SIGMA", "Median standard deviation", "In plan, over the whole path.", "m")
        self.add_number_output("MAX_SIGMA", "Maximum standard deviation", "In plan, over the whole path.", "m")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.mobile.registration.report import write_registration_report
        from ...urbanmap_qgis.mobile.registration.stage import register_survey

        paths, crs, trajectory, reference = read_survey_and_reference(self, parameters, context, progress)
        calibration = self.read_calibration(parameters, context)
        run = self._run(parameters, context, reference, paths)
        walls = read_walls(self, parameters, context, (paths, crs, trajectory.trajectory), run, progress.part(0.0, 0.2))
        with self.workers(parameters, context) as executor:
            result = register_survey(paths, trajectory.trajectory, reference, run, calibration,
                                     progress.part(0.2 if walls else 0.0, 0.95), executor, walls)
        results = {**self._figures(result), "OUTPUT": self.write_trajectory(
            parameters, "OUTPUT", context, trajectory, result.trajectory, crs)}
        for write in (self._write_patches, self._write_disagreements):
            results.update(write(parameters, context, result, crs, progress))
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_registration_report, result, reference,
                                   self.raster_path(parameters, "IMAGE", context))
        return results

    def _run(self, parameters, context, reference, paths):
        """The core's settings."""
        from ...urbanmap_qgis.io.points.coordinate_steps import rounding_variance
        from ...urbanmap_qgis.io.points.pointcloud import open_cloud
        from ...urbanmap_qgis.mobile.markings.extraction import ExtractionSettings
        from ...urbanmap_qgis.mobile.markings.plain_threshold import PlainThreshold
        from ...urbanmap_qgis.mobile.registration.correction.settings import CorrectionSettings
        from ...urbanmap_qgis.mobile.registration.records import RegistrationSettings
        from ...urbanmap_qgis.mobile.registration.run import RegistrationRun

        paper = self.parameterAsString(parameters, "METHOD", context) == "paper"
        make = RegistrationSettings.paper if paper else RegistrationSettings
        attitude = self.parameterAsDouble(parameters, "ATTITUDE_SIGMA", context)
        correction = self.settings(CorrectionSettings, parameters, context,
                                   rounding_variance=rounding_variance(open_cloud(paths)),
                                   attitude_sigma=(attitude, attitude, 2.0 * attitude))
        usual = make(three_d=reference.has_heights)
        chosen = vars(self.settings(WindowChoice, parameters, context))
        given = {**vars(self.settings(WindowSettings, parameters, context)),
                 **{name: value for name, value in chosen.items() if value is not None},
                 "reference_sigma": max(correction.reference_sigma, usual.reference_sigma)}
        if usual.window_points is not None:
            given["window_points"] = usual.feature_points * given["feature_count"]
        if "max_window_patches" not in given and usual.max_window_patches is not None:
            given["max_window_patches"] = max(usual.max_window_patches, given.get("window_patches", 0))
        return RegistrationRun(replace(usual, **given), correction,
                               ExtractionSettings(plain=PlainThreshold() if paper else None))

    def _figures(self, registered):
        import numpy as np

        from ...urbanmap_qgis.mobile.registration.correction.patch_status import BRIDGED, DISTRUSTED, REGISTERED

        length = np.hypot(registered.correction.value[:, 0], registered.correction.value[:, 1])
        middle, largest = registered.plan_accuracy()
        return {"WAY": float(registered.correction.chainage[-1]), "MEAN_CORRECTION": float(length.mean()),
                "MAX_CORRECTION": float(length.max()), "REGISTERED_SHARE": registered.share(REGISTERED),
                "BRIDGED_SHARE": registered.share(BRIDGED), "DISTRUSTED_SHARE": registered.share(DISTRUSTED),
                "MEDIAN_SIGMA": middle if np.isfinite(middle) else None,
                "MAX_SIGMA": largest if np.isfinite(largest) else None}

    def _write_patches(self, parameters, context, registered, crs, progress):
        import shapely

        from ...urbanmap_qgis.mobile.registration.registered_survey import patch_table

        columns, places = patch_table(registered)
        kinds = {"patch": "int", "features": "int", "points": "int", "status": "text", "reason": "text"}
        fields = make_fields(*((name, kinds.get(name, "real")) for name in columns))
        return self.write_layer(parameters, "OUTPUT_PATCHES", context, fields, columns, crs, shapely.points(places),
                                "PointZ", style="mms_patches", progress=progress)

    def _write_disagreements(self, parameters, context, registered, crs, progress):
        import shapely

        from ...urbanmap_qgis.mobile.registration.disagreement_areas import area_table
        from ...urbanmap_qgis.mobile.registration.registered_survey import step_table

        (steps, places), (areas, roads), results = step_table(registered), area_table(registered), {}
        for name, columns, at, kind, style in (("OUTPUT_STEPS", steps, shapely.points(places), "PointZ", "mms_steps"),
                                               ("OUTPUT_AREAS", areas, roads, "Polygon", "mms_areas")):
            results |= self.write_layer(parameters, name, context, None, columns, crs, at, kind,
                                             style=style, progress=progress)
        return results
