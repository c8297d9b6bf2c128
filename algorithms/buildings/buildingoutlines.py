"""urbanmap:buildingoutlines."""

from __future__ import annotations

from ...urbanmap_qgis.settings.buildings import DetectionSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import crs_from
from ..framework.layers.layers import table_of_box
from ..framework.layers.reprojection import ground_heights


class BuildingOutlines(UrbanMapAlgorithm):
    ID = "buildingoutlines"
    NAME = "Building outlines from ALS"
    SOURCE = "Javanmardi, 5.3.3"
    KEYWORDS = ("building", "footprint", "outline", "detection", "ALS", "lidar")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "rasterio", "cv2")
    HELP = (
        "Finds the buildings in airborne laser points and draws their outlines, where there is no register of "
        "outlines or an old one.\n"
        "Points of class 6 are taken where the cloud has them. In other clouds roofs are told from trees by their "
        "surfaces: large and smooth ones whose points end their pulses. Roofs that touch make one outline, as party "
        "walls cannot be seen from above. An outline is that of the roof, which may hang over the wall, made straight "
        "and square where the points say so.\n"
        "What may be a vehicle, a bridge or a ship keeps its outline and says so in its status."
    )

    def declare(self):
        self.add_points()
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres. Without it the ground is made "
                        "from the points.", optional=True)
        self.add_settings(DetectionSettings)
        self.add_points_crs()
        self.add_workers()
        self.add_layer_output("OUTPUT", "Building outlines", "MultiPolygon, one feature a building: building_id, area "
                              "(m2), height above the ground and ground (m), points, density (points a m2), sigma of "
                              "the edges (m), confidence (probability of a roof, mean over the points), status (ok, "
                              "low, movable, deck, no ground) and reason.")
        self.add_report("HTML report: counts, areas, and what may be no building.")
        self.add_number_output("BUILDINGS", "Buildings", "Outlines with status ok.")
        self.add_number_output("OTHERS", "Others", "Outlines of what may be no building.")
        self.add_number_output("AREA", "Area", "Area of the buildings.", "m2")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.buildings.detection.detection_report import detected_columns, write_detection_report
        from ...urbanmap_qgis.buildings.detection.detection_stage import detect_buildings

        cloud = self.projected_cloud(parameters, context)
        box = table_of_box(self.label_of("POINTS"), crs_from(cloud.crs_wkt), cloud.minimum, cloud.maximum)
        ground = ground_heights(self, parameters, context, box, progress, "POINTS")
        settings = self.settings(DetectionSettings, parameters, context)
        with self.workers(parameters, context) as executor:
            found = detect_buildings(cloud, settings, ground, executor, progress.part(0.0, 0.95))
        columns = detected_columns(found)
        good = [building for building in found.buildings if building.status == "ok"]
        progress.message(tr("{0} buildings; {1} outlines of what may be no building; {2} groups of points are smaller "
                            "than {3} m2, {4} look like crowns.").format(
            len(good), len(found.buildings) - len(good), found.too_small, settings.min_area, found.crowns))
        results = self.write_file(parameters, "OUTPUT_REPORT", context, write_detection_report, found)
        results |= self.write_layer(parameters, "OUTPUT", context, None, columns, box.crs,
                                    [building.outline for building in found.buildings], "MultiPolygon",
                                    "detected_outlines", progress.part(0.95, 1.0))
        return {**results, "BUILDINGS": len(good), "OTHERS": len(found.buildings) - len(good),
                "AREA": float(sum(building.area for building in good))}
