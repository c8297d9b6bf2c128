"""urbanmap:aerialmarkings."""

from __future__ import annotations

from qgis.core import QgsProcessing, QgsProcessingParameterMultipleLayers

from .base import UrbanMapAlgorithm
from .orthorectifyframes import ANGLE_ORDERS, ANGLE_UNITS, METHODS
from .parameters import HTML_FILTER, tr


class AerialMarkings(UrbanMapAlgorithm):
    ID = "aerialmarkings"
    NAME = "Road markings from aerial frames"
    GROUP = "workflows"
    SOURCE = "Javanmardi 2018, 3.2.1, 3.2.2 and 4.1"
    KEYWORDS = ("road", "marking", "aerial", "frames", "orthophoto", "ALS", "reference", "workflow")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "laspy", "lazrs", "cv2", "skimage")
    HELP = (
        "Goes from aerial frames and airborne laser points to the reference that mobile surveys are tied to, in one "
        "run: surface and ground from ALS, orthophoto of the ground that the frames see, without moving vehicles, and "
        "road markings with their heights.\n"
        "Frames, points and outlines must be in one projected coordinate system in metres."
    )

    def declare(self):
        self.declare_parameter(QgsProcessingParameterMultipleLayers(
            "FRAMES", tr("Frames"), QgsProcessing.SourceType.TypeFile), "8 or 16 bit TIFF or JPEG images as the camera "
            "took them, each named in the exterior orientation.")
        self.add_file("CAMERA", "Camera", "JSON file of the camera; see “Orthorectify frames”.", "Camera (*.json)")
        self.add_file("EXTERIOR", "Exterior orientation", "CSV file image,x,y,z,omega,phi,kappa (metres, degrees).",
                      "Exterior orientation (*.csv *.txt)")
        self.add_points("ALS", "Airborne laser points")
        self.add_polygons("FOOTPRINTS", "Building outlines", "Ground inside them is masked too.", optional=True)
        self.add_polygons("ROADS", "Roads", "Markings are looked for only inside these polygons; without them, "
                          "everywhere.", optional=True)
        self.add_distance("RESOLUTION", "Resolution", "Side of an orthophoto's pixel; 0 for that of the frames.", 0.0,
                          0.0, 0.5)
        self.add_boolean("FILTER_VEHICLES", "Filter vehicles", "Leave out moving vehicles where several frames see the "
                         "road.", True)
        self.add_choice("METHOD", "Vehicle filter", "Vote, or the darkest frame; see “Orthorectify frames”.", METHODS,
                        "vote", advanced=True)
        self.add_distance("SURFACE_RESOLUTION", "Resolution of the surface", "Side of a cell of the surface that tells "
                          "hidden ground, in metres: about the distance between the laser points.", 0.5, 0.01, 100.0,
                          advanced=True)
        self.add_choice("ANGLE_ORDER", "Order of the angles", "Papers: R_omega R_phi R_kappa. Usual: R_kappa R_phi "
                        "R_omega, as most bundle adjustments write.", ANGLE_ORDERS, "papers", advanced=True)
        self.add_choice("ANGLE_UNIT", "Unit of the angles", "Automatic: degrees, and an error where they look "
                        "otherwise.", ANGLE_UNITS, "automatic", advanced=True)
        self.add_distance("BLOCK_SIZE", "Block size", "Side of the block over which the mean is taken.", 2.5, 0.5, 50.0,
                          advanced=True)
        self.add_number("CONTRAST", "Contrast", "How much brighter than the mean paint is; see “Road markings from "
                        "orthophoto”.", 17, 1, 200, unit="grey values", advanced=True)
        self.add_workers()
        self.add_raster_output("OUTPUT", "Marking mask", "255 where there is a marking, otherwise 0.")
        self.add_layer_output("OUTPUT_POLYGONS", "Road markings", "PolygonZ, one feature a marking.", optional=True,
                              by_default=True)
        self.add_raster_output("OUTPUT_ORTHOPHOTO", "Orthophoto", "Mosaic of the frames on the ground.", optional=True,
                               by_default=True)
        self.add_raster_output("OUTPUT_GROUND", "Ground", "Heights of the ground in metres.", optional=True,
                               by_default=True)
        self.add_layer_output("OUTPUT_SHIFTS", "Shifts between images", "Points on road markings with the shift "
                              "between two overlapping frames; see “Orthorectify frames”.", optional=True)
        self.add_file_output("OUTPUT_REPORT", "Report", "HTML report: numbers and areas, shifts between frames, "
                             "coverage and holes, pictures of the markings over the orthophoto, and what to distrust.",
                             HTML_FILTER, optional=True)
        self.add_number_output("COUNT", "Markings", "Number of polygons.")
        self.add_number_output("HOLE_AREA", "Area of holes", "Ground outside buildings that no frame sees.", "m2")
        self.add_number_output("LARGEST_SHIFT", "Largest shift", "Largest distance between the same road markings in "
                               "two overlapping frames, median over their places; no value where none are seen.", "m")

    def compute(self, parameters, context, feedback):
        given = {name: parameters[name] for name in parameters if parameters[name] is not None}

        def pick(*names):
            return {name: given[name] for name in names if name in given}

        def place(name, file):
            return given.get(name) or self.temporary_file(context, file)

        report = bool(given.get("OUTPUT_REPORT"))
        run = self.child_runner(context, feedback, 3)
        als = run("surfacefromals", POINTS=self.parameterAsFileList(parameters, "ALS", context),
                  RESOLUTION=self.parameterAsDouble(parameters, "SURFACE_RESOLUTION", context),
                  OUTPUT=self.temporary_file(context, "surface.tif"),
                  OUTPUT_GROUND=place("OUTPUT_GROUND", "ground.tif"))
        wanted = {"OUTPUT_SHIFTS": given.get("OUTPUT_SHIFTS") or "TEMPORARY_OUTPUT",
                  "OUTPUT_COUNT": self.temporary_file(context, "frames.tif")} if report else pick("OUTPUT_SHIFTS")
        ortho = run("orthorectifyframes", **pick("FRAMES", "CAMERA", "EXTERIOR", "FOOTPRINTS", "RESOLUTION",
                                                 "FILTER_VEHICLES", "METHOD", "ANGLE_ORDER", "ANGLE_UNIT", "WORKERS"),
                    **wanted, GROUND=als["OUTPUT_GROUND"], DSM=als["OUTPUT"],
                    OUTPUT=place("OUTPUT_ORTHOPHOTO", "orthophoto.tif"))
        told = {"SHIFTS": ortho["OUTPUT_SHIFTS"], "FRAME_COUNT": ortho["OUTPUT_COUNT"],
                "NOTE": self._note(parameters, ortho)} if report else {}
        found = run("roadmarkingsfromorthophoto", **pick("ROADS", "BLOCK_SIZE", "CONTRAST", "WORKERS", "OUTPUT",
                                                         "OUTPUT_POLYGONS", "OUTPUT_REPORT"), **told,
                    INPUT=ortho["OUTPUT"], GROUND=als["OUTPUT_GROUND"])
        results = {"OUTPUT": found["OUTPUT"], "COUNT": found["COUNT"], "HOLE_AREA": ortho["HOLE_AREA"],
                   "OUTPUT_ORTHOPHOTO": ortho["OUTPUT"], "OUTPUT_GROUND": als["OUTPUT_GROUND"]}
        results.update((name, made[name]) for made, name in (
            (ortho, "LARGEST_SHIFT"), (ortho, "OUTPUT_SHIFTS"), (found, "OUTPUT_POLYGONS"), (found, "OUTPUT_REPORT"))
            if name in made)
        return {name: value for name, value in results.items()
                if name not in ("OUTPUT_ORTHOPHOTO", "OUTPUT_GROUND", "OUTPUT_SHIFTS") or name in given}

    def _note(self, parameters, ortho) -> str:
        """What the chain did, for the report."""
        settings = "; ".join(f"{label}: {value}" for label, value in self.settings_of(parameters).items() if value)
        return tr("Frames used: {0}; holes that no frame sees outside buildings: {1:.0f} m2. {2}").format(
            ortho["FRAMES_USED"], ortho["HOLE_AREA"], settings)
