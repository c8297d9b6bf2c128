"""urbanmap:aerialmarkings."""

from __future__ import annotations

from qgis.core import QgsProcessing, QgsProcessingParameterMultipleLayers

from .base import UrbanMapAlgorithm
from .parameters import tr


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
        self.add_distance("BLOCK_SIZE", "Block size", "Side of the block over which the mean is taken.", 2.5, 0.5, 50.0,
                          advanced=True)
        self.add_number("CONTRAST", "Contrast", "How much brighter than the mean paint is; see “Road markings from "
                        "orthophoto”.", 17, 1, 200, unit="grey values", advanced=True)
        self.add_raster_output("OUTPUT", "Marking mask", "255 where there is a marking, otherwise 0.")
        self.add_layer_output("OUTPUT_POLYGONS", "Road markings", "PolygonZ, one feature a marking.", optional=True,
                              by_default=True)
        self.add_raster_output("OUTPUT_ORTHOPHOTO", "Orthophoto", "Mosaic of the frames on the ground.", optional=True,
                               by_default=True)
        self.add_raster_output("OUTPUT_GROUND", "Ground", "Heights of the ground in metres.", optional=True,
                               by_default=True)
        self.add_number_output("COUNT", "Markings", "Number of polygons.")
        self.add_number_output("HOLE_AREA", "Area of holes", "Ground outside buildings that no frame sees.", "m2")

    def compute(self, parameters, context, feedback):
        given = {name: parameters[name] for name in parameters if parameters[name] is not None}

        def pick(*names):
            return {name: given[name] for name in names if name in given}

        def place(name, file):
            return given.get(name) or self.temporary_file(context, file)

        run = self.child_runner(context, feedback, 3)
        als = run("surfacefromals", POINTS=self.parameterAsFileList(parameters, "ALS", context),
                  OUTPUT=self.temporary_file(context, "surface.tif"),
                  OUTPUT_GROUND=place("OUTPUT_GROUND", "ground.tif"))
        ortho = run("orthorectifyframes", **pick("FRAMES", "CAMERA", "EXTERIOR", "FOOTPRINTS", "RESOLUTION",
                                                 "FILTER_VEHICLES"), GROUND=als["OUTPUT_GROUND"], DSM=als["OUTPUT"],
                    OUTPUT=place("OUTPUT_ORTHOPHOTO", "orthophoto.tif"))
        found = run("roadmarkingsfromorthophoto", **pick("ROADS", "BLOCK_SIZE", "CONTRAST", "OUTPUT",
                                                         "OUTPUT_POLYGONS"), INPUT=ortho["OUTPUT"],
                    GROUND=als["OUTPUT_GROUND"])
        results = {"OUTPUT": found["OUTPUT"], "COUNT": found["COUNT"], "HOLE_AREA": ortho["HOLE_AREA"],
                   "OUTPUT_ORTHOPHOTO": ortho["OUTPUT"], "OUTPUT_GROUND": als["OUTPUT_GROUND"]}
        if "OUTPUT_POLYGONS" in found:
            results["OUTPUT_POLYGONS"] = found["OUTPUT_POLYGONS"]
        return {name: value for name, value in results.items()
                if name not in ("OUTPUT_ORTHOPHOTO", "OUTPUT_GROUND") or name in given}
