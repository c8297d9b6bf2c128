"""urbanmap:georeferencemms."""

from __future__ import annotations

from qgis.core import QgsProcessing

from .base import UrbanMapAlgorithm
from .marking_reference import add_markings
from .outlines import check_points_output
from .parameters import HTML_FILTER

POSES_FILTER = "Image poses (*.csv *.txt)"
FIGURES = ("WAY", "MEAN_CORRECTION", "MAX_CORRECTION", "REGISTERED_SHARE", "BRIDGED_SHARE", "DISTRUSTED_SHARE",
           "MEDIAN_SIGMA", "MAX_SIGMA")


class GeoreferenceMms(UrbanMapAlgorithm):
    ID = "georeferencemms"
    NAME = "Georeference mobile survey"
    GROUP = "workflows"
    SOURCE = "Javanmardi 2018, 3.2.3, 3.2.4 and 4"
    KEYWORDS = ("MMS", "mobile", "georeferencing", "registration", "marking", "trajectory", "workflow")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2", "skimage")
    HELP = (
        "Goes from a mobile survey to the same survey lying on the aerial reference, in one run: its road markings by "
        "intensity, their registration to the reference markings, and the points as the corrected trajectory places "
        "them.\n"
        "With ground heights the correction is in space; without them heights stay as they are. The reference is what "
        "“Road markings from aerial frames” makes."
    )

    def declare(self):
        self.add_points(help="The survey: LAS, LAZ or COPC files with intensities and GPS times.")
        self.add_trajectory()
        self.add_calibration(optional=True)
        add_markings(self)
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres, in the height system of the "
                        "survey. With it the correction is in space.", optional=True)
        self.add_file("IMAGES", "Image poses", "CSV id,time,x,y,z,roll,pitch,heading of the survey's images.",
                      POSES_FILTER, optional=True)
        self.add_raster("IMAGE", "Aerial image", "Shown behind the markings in the report.", optional=True)
        self.add_distance("PATCH_LENGTH", "Patch length", "Length of path that counts as rigid.", 0.5, 0.1, 10.0,
                          advanced=True)
        self.add_number("WINDOW_PATCHES", "Window length", "Patches of the shortest window.", 60, 4, 400,
                        unit="patches", integer=True, advanced=True)
        self.add_number("FEATURE_COUNT", "Feature count", "Cells with markings that a window should have.", 400, 1,
                        100000, integer=True, unit="cells", advanced=True)
        self.add_distance("SEARCH", "Largest error", "How far off the survey may be in plan.", 4.0, 0.5, 20.0,
                          advanced=True)
        self.add_workers()
        self.add_points_output("OUTPUT", "Georeferenced survey", "All points in their order, with all attributes.")
        self.add_trajectory_output("OUTPUT_TRAJECTORY")
        self.add_layer_output("OUTPUT_PATCHES", "Patches", "One point a patch, with its correction, how sure it is and "
                              "how it was found.", optional=True,
                              source_type=QgsProcessing.SourceType.TypeVectorPoint, by_default=True)
        self.add_file_output("OUTPUT_REPORT", "Report", "Correction and its uncertainty over the way, pictures before "
                             "and after, what to distrust.", HTML_FILTER, optional=True, by_default=True)
        self.add_file_output("OUTPUT_IMAGES", "Corrected image poses", "The same rows with corrected poses.",
                             POSES_FILTER, optional=True)
        self.add_number_output("WAY", "Way driven", "Length of the path.", "m")
        self.add_number_output("MEAN_CORRECTION", "Mean correction", "In plan, over the path.", "m")
        self.add_number_output("MAX_CORRECTION", "Largest correction", "In plan.", "m")
        self.add_number_output("REGISTERED_SHARE", "Registered", "Share of the way that is registered, 0 to 1.")
        self.add_number_output("BRIDGED_SHARE", "Bridged", "Share of the way that is bridged, 0 to 1.")
        self.add_number_output("DISTRUSTED_SHARE", "Not to be trusted", "Share of the way not to be trusted, 0 to 1.")
        self.add_number_output("MEDIAN_SIGMA", "Median standard deviation", "In plan, over the path.", "m")
        self.add_number_output("MAX_SIGMA", "Largest standard deviation", "In plan.", "m")

    def check(self, parameters, context):
        check_points_output(self, parameters, context)

    def compute(self, parameters, context, feedback):
        given = {name: parameters[name] for name in parameters if parameters[name] is not None}

        def pick(*names):
            return {name: given[name] for name in names if name in given}

        run = self.child_runner(context, feedback, 3)
        points = self.parameterAsFileList(parameters, "POINTS", context)
        markings = run("roadmarkingsfrommms", **pick("TRAJECTORY", "CALIBRATION", "WORKERS"), POINTS=points,
                       OUTPUT=self.temporary_file(context, "markings.laz"))
        registered = run("registermms", **pick("TRAJECTORY", "MARKINGS", "GROUND", "IMAGE", "PATCH_LENGTH",
                                               "WINDOW_PATCHES", "FEATURE_COUNT", "SEARCH", "WORKERS",
                                               "OUTPUT_PATCHES", "OUTPUT_REPORT"), POINTS=[markings["OUTPUT"]],
                         OUTPUT=self.parameterAsFileOutput(parameters, "OUTPUT_TRAJECTORY", context))
        moved = run("applytrajectory", **pick("TRAJECTORY", "IMAGES", "OUTPUT", "OUTPUT_IMAGES"), POINTS=points,
                    CORRECTED=registered["OUTPUT"])
        results = {name: registered[name] for name in (*FIGURES, "OUTPUT_PATCHES", "OUTPUT_REPORT")
                   if name in registered}
        results.update({name: moved[name] for name in ("OUTPUT", "OUTPUT_IMAGES") if name in moved})
        return {**results, "OUTPUT_TRAJECTORY": registered["OUTPUT"]}
