"""urbanmap:buildingsfromals."""

from __future__ import annotations

from .base import UrbanMapAlgorithm
from .parameters import CITYJSON_FILTER, HTML_FILTER, OBJ_FILTER


class BuildingsFromAls(UrbanMapAlgorithm):
    ID = "buildingsfromals"
    NAME = "Buildings from ALS"
    GROUP = "workflows"
    SOURCE = "Javanmardi 2018, chapter 5"
    KEYWORDS = ("building", "3D", "ALS", "lidar", "CityJSON", "LOD1", "workflow")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "cv2", "skimage")
    HELP = (
        "Goes from airborne laser points and rough outlines to closed 3D building models in one run: segment "
        "buildings, segment roofs, roof polygons, building models.\n"
        "The same chain is there as a model that can be changed in the modeller."
    )

    def declare(self):
        self.add_points()
        self.add_polygons("FOOTPRINTS", "Building outlines", "Rough outlines, one feature a building, in the same "
                          "coordinate system as the points.")
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres. Without it the ground is made "
                        "from the points.", optional=True)
        self.add_distance("EXPANSION", "Expansion", "Distance in metres by which outlines are expanded before they "
                          "take their points.", 1.0, 0.0, 20.0)
        self.add_number("MIN_ROOF_AREA", "Least roof area", "Area in square metres that a maximum of the height "
                        "histogram must hold to be a roof.", 50.0, 0.5, 100000.0, "m2")
        self.add_distance("MAX_DISPLACEMENT", "Largest displacement", "Distance in metres by which an outline may be "
                          "moved to its points; 0 leaves all outlines in their places.", 2.5, 0.0, 5.0, advanced=True)
        self.add_distance("HEIGHT_RMSE", "Height error of sloped roofs", "Sloped roofs are cut into level ones until "
                          "the building's root mean square height error in metres is below this; 0 keeps the roofs of "
                          "the paper whole.", 0.45, 0.0, 10.0, advanced=True)
        self.add_choice("METHOD", "Method of the roof polygons", "The outline divided among its roofs, the same with "
                        "an outline drawn from the points, or each roof outlined on its own as in the paper.",
                        ("partition", "points", "paper"), "partition", advanced=True)
        self.add_choice("HEIGHT", "Roof height", "The median of a roof's points, or the highest as in the paper.",
                        ("robust", "maximum"), "robust", advanced=True)
        self.add_field("BASE_FIELD", "Field with the foot's height", "Field of the outlines with the height of the "
                       "foot of the walls in metres; used where the ground is not known.", "FOOTPRINTS", advanced=True)
        self.add_workers()
        self.add_layer_output("OUTPUT", "Building models", "MultiPolygonZ, one feature a building, with its figures of "
                              "quality; see “Building models”.")
        self.add_layer_output("OUTPUT_SURFACES", "Surfaces", "PolygonZ, one feature a surface: roof, outer wall, inner "
                              "wall, ground.", optional=True)
        self.add_file_output("OUTPUT_CITYJSON", "CityJSON", "CityJSON 2.0 file with solids, surface types and the "
                             "figures of each building.", CITYJSON_FILTER, optional=True, by_default=True)
        self.add_file_output("OUTPUT_REPORT", "Report", "HTML report: counts, quality, the worst buildings with "
                             "reasons.", HTML_FILTER, optional=True, by_default=True)
        self.add_file_output("OUTPUT_MESH", "OBJ mesh", "Wavefront OBJ file, a group for each building.", OBJ_FILTER,
                             optional=True)
        self.add_number_output("BUILDINGS", "Buildings", "Number of outlines.")
        self.add_number_output("MODELLED", "Modelled", "Buildings with a model.")
        self.add_number_output("RMSE_Z95", "Mean RMSE of height, best 95 %", "Mean over the buildings.", "m")

    def compute(self, parameters, context, feedback):
        given = {name: parameters[name] for name in parameters if parameters[name] is not None}

        def pick(*names):
            return {name: given[name] for name in names if name in given}

        run = self.child_runner(context, feedback, 4)
        buildings = run("segmentbuildings", **pick("POINTS", "FOOTPRINTS", "GROUND", "EXPANSION", "MAX_DISPLACEMENT",
                                                   "WORKERS"), OUTPUT=self.temporary_file(context, "buildings.laz"),
                        OUTPUT_BUILDINGS="TEMPORARY_OUTPUT")
        roofs = run("segmentroofs", **pick("MIN_ROOF_AREA", "HEIGHT_RMSE", "WORKERS"), POINTS=[buildings["OUTPUT"]],
                    FOOTPRINTS=buildings["OUTPUT_BUILDINGS"], OUTPUT=self.temporary_file(context, "roofs.laz"),
                    OUTPUT_ROOFS="TEMPORARY_OUTPUT")
        polygons = run("roofpolygons", **pick("METHOD", "HEIGHT", "WORKERS"), POINTS=[roofs["OUTPUT"]],
                       FOOTPRINTS=buildings["OUTPUT_BUILDINGS"], OUTPUT="TEMPORARY_OUTPUT")
        settings = "; ".join(f"{label}: {value}" for label, value in self.settings_of(parameters).items() if value)
        models = run("buildingmodels", **pick("GROUND", "BASE_FIELD", "WORKERS", "OUTPUT", "OUTPUT_SURFACES",
                                              "OUTPUT_CITYJSON", "OUTPUT_REPORT", "OUTPUT_MESH"),
                     ROOFS=polygons["OUTPUT"], FOOTPRINTS=buildings["OUTPUT_BUILDINGS"], POINTS=[roofs["OUTPUT"]],
                     NOTE=settings)
        return {name: models[name] for name in models if name in {item.name() for item in self.outputDefinitions()}}
