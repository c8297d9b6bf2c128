"""urbanmap:buildingsfromals."""

from __future__ import annotations

from ...urbanmap_qgis.settings.buildings import PAPER
from ..buildings.buildingmodels import BuildingModels
from ..buildings.roofpolygons import RoofPolygons
from ..buildings.segmentbuildings import SegmentBuildings
from ..buildings.segmentroofs import SegmentRoofs
from ..framework.base import UrbanMapAlgorithm
from ..framework.running.chain import GivenParameters


class BuildingsFromAls(UrbanMapAlgorithm):
    ID = "buildingsfromals"
    NAME = "Buildings from ALS"
    SOURCE = "Javanmardi, chapter 5"
    KEYWORDS = ("building", "3D", "ALS", "lidar", "CityJSON", "LOD1", "LOD2", "workflow")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "cv2")
    HELP = (
        "Goes from airborne laser points and rough outlines to closed 3D building models in one run: segment "
        "buildings, segment roofs, roof polygons, building models.\n"
        "The method “paper” runs the paper's way whole: all points in the expanded outlines, the histogram alone, "
        "alpha shape and Hough lines, the highest point.\n"
        "The same chain is there as a model that can be changed in the modeller."
    )

    def declare(self):
        self.add_from(SegmentBuildings, "POINTS", "FOOTPRINTS", "GROUND", "EXPANSION")
        self.add_from(SegmentRoofs, "ROOFS")
        self.add_from(SegmentRoofs, "MIN_ROOF_AREA")
        self.add_from(SegmentBuildings, "MAX_DISPLACEMENT", advanced=True)
        self.add_from(SegmentRoofs, "HEIGHT_RMSE", "PLANE_TOLERANCE", advanced=True)
        self.add_from(RoofPolygons, "METHOD", label="Method", advanced=True, help="partition: outlines divided among "
                      "their roofs; points: outlines drawn from the points, then divided; paper: the paper's method in "
                      "every step.")
        self.add_from(SegmentRoofs, "PARAPET_THRESHOLD", advanced=True)
        self.add_from(RoofPolygons, "MIN_LINE_POINTS", advanced=True)
        self.add_from(RoofPolygons, "HEIGHT", advanced=True)
        self.add_from(BuildingModels, "BASE_FIELD", advanced=True)
        self.add_from(BuildingModels, "WORKERS", "SCHEDULER", "OUTPUT", "OUTPUT_SURFACES", "OUTPUT_MESH",
                      "OUTPUT_MESHES")
        self.add_from(BuildingModels, "OUTPUT_CITYJSON", "OUTPUT_REPORT", by_default=True)
        self.add_from(BuildingModels, "BUILDINGS", "MODELLED", "RMSE_Z95")

    def compute(self, parameters, context, feedback):
        given = GivenParameters(parameters)
        as_paper = self.parameterAsString(parameters, "METHOD", context) == PAPER
        stage_method = PAPER if as_paper else "full"
        run = self.child_runner(context, feedback, 4)
        buildings = run("segmentbuildings", **given.pick("POINTS", "FOOTPRINTS", "GROUND", "EXPANSION",
                                                         "MAX_DISPLACEMENT", "WORKERS"), METHOD=stage_method,
                        OUTPUT=self.temporary_file(context, "buildings.las"), OUTPUT_BUILDINGS="TEMPORARY_OUTPUT")
        roofs = run("segmentroofs", **given.pick("ROOFS", "MIN_ROOF_AREA", "PARAPET_THRESHOLD", "HEIGHT_RMSE",
                                                  "PLANE_TOLERANCE", "WORKERS"),
                    METHOD=stage_method, POINTS=[buildings["OUTPUT"]],
                    FOOTPRINTS=buildings["OUTPUT_BUILDINGS"], OUTPUT=self.temporary_file(context, "roofs.las"),
                    OUTPUT_ROOFS="TEMPORARY_OUTPUT")
        polygons = run("roofpolygons", **given.pick("METHOD", "ROOFS", "HEIGHT", "MIN_LINE_POINTS", "WORKERS"),
                       POINTS=[roofs["OUTPUT"]], FOOTPRINTS=buildings["OUTPUT_BUILDINGS"], OUTPUT="TEMPORARY_OUTPUT")
        models = run("buildingmodels", **given.pick("GROUND", "BASE_FIELD", "WORKERS", "OUTPUT", "OUTPUT_SURFACES",
                                                    "OUTPUT_CITYJSON", "OUTPUT_REPORT", "OUTPUT_MESH", "OUTPUT_MESHES"),
                     ROOFS=polygons["OUTPUT"], FOOTPRINTS=buildings["OUTPUT_BUILDINGS"], POINTS=[roofs["OUTPUT"]],
                     ROOF_SHAPE=self.parameterAsString(parameters, "ROOFS", context))
        return {name: models[name] for name in models if name in {item.name() for item in self.outputDefinitions()}}
