"""urbanmap:georeferencemms."""

from __future__ import annotations

from ..framework.base import UrbanMapAlgorithm
from ..framework.running.chain import GivenParameters, files_read_once
from ..mobile.applytrajectory import ApplyTrajectory, check_poses
from ..mobile.registermms import RegisterMms
from ..mobile.roadmarkingsfrommms import RoadMarkingsFromMms
from ..mobile.survey_inputs import read_survey_and_reference

FIGURES = ("WAY", "MEAN_CORRECTION", "MAX_CORRECTION", "REGISTERED_SHARE", "BRIDGED_SHARE", "DISTRUSTED_SHARE",
           "MEDIAN_SIGMA", "MAX_SIGMA")

ACCURACIES = ("REFERENCE_SIGMA", "GROUND_SIGMA", "ATTITUDE_SIGMA")
"""How accurate reference, ground and reported angles are."""

READING = ("ANGLES", "GEOID", "GEOID_HEIGHT")
"""How the trajectories are read, by all steps."""


class GeoreferenceMms(UrbanMapAlgorithm):
    ID = "georeferencemms"
    NAME = "Georeference mobile survey"
    SOURCE = "Javanmardi, 3.2.3, 3.2.4 and 4"
    KEYWORDS = ("MMS", "mobile", "georeferencing", "registration", "marking", "trajectory", "workflow")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2")
    HELP = (
        "Goes from a mobile survey to the same survey lying on the aerial reference, in one run: its road markings by "
        "intensity, their registration to the reference markings, and the points as the corrected trajectory places "
        "them.\n"
        "With ground heights the correction is in space; without them heights stay as they are. The reference is what "
        "“Road markings from aerial frames” makes."
    )

    def declare(self):
        self.add_from(RoadMarkingsFromMms, "POINTS", "TRAJECTORY", "CALIBRATION")
        self.add_from(RegisterMms, "MARKINGS", "GROUND", "BUILDINGS", "ALS", "ROAD_EDGES")
        self.add_from(ApplyTrajectory, "IMAGES")
        self.add_from(RegisterMms, "IMAGE")
        self.add_from(RegisterMms, "METHOD", "FEATURES", "PATCH_LENGTH", "WINDOW_PATCHES", "MAX_WINDOW_PATCHES",
                      "FEATURE_COUNT", "SEARCH", *ACCURACIES, *READING, "WORKERS", "SCHEDULER", advanced=True)
        self.add_from(RegisterMms, "POINTS_CRS")
        self.add_from(ApplyTrajectory, "OUTPUT", label="Georeferenced survey")
        self.add_from(RegisterMms, OUTPUT_TRAJECTORY="OUTPUT")
        self.add_from(RegisterMms, "OUTPUT_PATCHES", "OUTPUT_STEPS", "OUTPUT_AREAS", "OUTPUT_REPORT")
        self.add_from(ApplyTrajectory, "OUTPUT_IMAGES")
        self.add_from(RegisterMms, *FIGURES)

    def check(self, parameters, context):
        check_poses(self, parameters, context)

    def compute(self, parameters, context, feedback):
        with files_read_once():
            return self._run_stages(parameters, context, feedback)

    def _run_stages(self, parameters, context, feedback):
        given = GivenParameters(parameters)
        read_survey_and_reference(self, parameters, context, self.progress(feedback))
        run = self.child_runner(context, feedback, 3)
        points = self.parameterAsFileList(parameters, "POINTS", context)
        markings = run("roadmarkingsfrommms", **given.pick("TRAJECTORY", *READING, "CALIBRATION", "METHOD", "WORKERS"),
                       POINTS=points, OUTPUT=self.temporary_file(context, "markings.laz"))
        registered = run("registermms", **given.pick("TRAJECTORY", "MARKINGS", "GROUND", "IMAGE", "PATCH_LENGTH",
                                                     "WINDOW_PATCHES", "MAX_WINDOW_PATCHES", "FEATURE_COUNT",
                                                     "SEARCH", *ACCURACIES, *READING, "WORKERS", "METHOD",
                                                     "BUILDINGS", "ALS", "ROAD_EDGES", "FEATURES", "OUTPUT_PATCHES",
                                                     "OUTPUT_STEPS", "OUTPUT_AREAS", "OUTPUT_REPORT"),
                         POINTS=[markings["OUTPUT"]], SURVEY=points,
                         OUTPUT=self.parameterAsFileOutput(parameters, "OUTPUT_TRAJECTORY", context))
        moved = run("applytrajectory", **given.pick("TRAJECTORY", *READING, "IMAGES", "OUTPUT", "OUTPUT_IMAGES"),
                    POINTS=points, CORRECTED=registered["OUTPUT"])
        results = {name: registered[name] for name in (*FIGURES, "OUTPUT_PATCHES", "OUTPUT_STEPS", "OUTPUT_AREAS",
                                                       "OUTPUT_REPORT") if name in registered}
        results.update({name: moved[name] for name in ("OUTPUT", "OUTPUT_IMAGES") if name in moved})
        return {**results, "OUTPUT_TRAJECTORY": registered["OUTPUT"]}
