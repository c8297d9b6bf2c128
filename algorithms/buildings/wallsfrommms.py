"""urbanmap:wallsfrommms."""

from __future__ import annotations

from ...urbanmap_qgis.settings.facades import WallSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.building_layers import read_buildings
from ..framework.layers.outlines import building_names, open_points


class WallsFromMms(UrbanMapAlgorithm):
    ID = "wallsfrommms"
    NAME = "Walls from a mobile survey"
    SOURCE = "Javanmardi, 5.7"
    KEYWORDS = ("wall", "facade", "MMS", "mobile mapping", "lidar", "plane", "contour")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "rasterio", "cv2")
    HELP = (
        "Finds the walls of buildings in a mobile survey that has been put on the map.\n"
        "Points near the buildings' outlines and below a height above ground are separated into walls and the rest by "
        "their normals, freed of outliers and cut into planes. The alpha shape of each plane's points is the contour "
        "of a wall; holes in it are places where nothing was measured, such as windows, passages and shadows.\n"
        "Each wall says how well its points fit, how well its place is known, how much of it was seen and how much "
        "may be hidden behind trees, vehicles and the like. The accuracy is that of the wall in the survey; the place "
        "of the survey itself is not in it."
    )

    def declare(self):
        self.add_points("POINTS", "Mobile survey", "One or several LAS, LAZ or COPC files of a survey that lies on the "
                        "map, such as from “Apply corrected trajectory”.")
        self.add_polygons("BUILDINGS", "Buildings", "Outlines, or models with their heights (MultiPolygonZ of "
                          "“Building models”). A field building_id, of any type, names the buildings; "
                          "without it, buildings are numbered from 1 in the layer's order.")
        self.add_settings(WallSettings, "max_height", "front")
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres. Without it the ground is taken "
                        "from the lowest points round each building.", optional=True)
        self.add_trajectories("Where the vehicle was while it measured these points, in their time, CRS and heights, "
                              "such as the corrected trajectory of each drive: CSV, SBET, or point layers. With them "
                              "each wall tells what hid it along the lines of sight, and where beams went through it "
                              "(glass, openings); without them, hidden is a guess from what stands in front.", True)
        self.add_settings(WallSettings)
        self.add_workers()
        self.add_layer_output("OUTPUT", "Walls", "PolygonZ, one feature a contour: building_id, wall_id, status, note, "
                              "area (m2), height, length (m), azimuth and tilt (degrees), normal_x, normal_y, "
                              "normal_z, points, passes, rmse, sigma, pass_spread (m), coverage, hidden, unseen, "
                              "openings, filled (shares), edge and offset (outline edge, and m before it), kind "
                              "(wall, or what stands before the facade), through (share that beams went through; "
                              "empty without a trajectory).")
        self.add_number_output("WALLS", "Walls", "Number of contours.")
        self.add_number_output("BUILDINGS_WITH_WALLS", "Buildings with walls", "Buildings of which a wall was found.")
        self.add_number_output("BUILDINGS_NEAR", "Buildings reached", "Buildings near points of the survey.")
        self.add_number_output("AREA", "Area", "Area of all contours.", "m2")
        self.add_number_output("MEDIAN_SIGMA", "Median sigma", "Median over the walls of the standard deviation of "
                               "their place in the survey.", "m")

    def work(self, parameters, context, progress):
        import numpy as np

        from ...urbanmap_qgis.facades.building_plans import building_plans
        from ...urbanmap_qgis.facades.wall_stage import find_walls, wall_columns

        table = read_buildings(self, parameters, "BUILDINGS", context, progress)
        plans = building_plans(table.geometries, building_names(table).numbers)
        cloud = open_points(self, parameters, context, table, progress, name="BUILDINGS")
        trajectory = self._trajectory(parameters, context, table, progress)
        with (self.sampled_raster(parameters, "GROUND", context, "BUILDINGS", table.crs) as ground,
              self.workers(parameters, context) as executor):
            walls, counts = find_walls(cloud, plans, self.settings(WallSettings, parameters, context), ground, executor,
                                       progress.part(0.0, 0.95), trajectory)
        if counts.with_walls < counts.near:
            progress.message(tr("{0} of {1} buildings near the survey show no wall.").format(
                counts.near - counts.with_walls, counts.near))
        if not walls:
            progress.warn(tr("No wall was found: the survey shows too little of the buildings, or does not lie on the "
                             "map."))
        elif not np.isfinite(plans.top).any():
            progress.message(tr("The buildings tell no heights: coverage is counted up to the highest point seen of "
                                "each wall."))
        columns = wall_columns(walls)
        layer = self.write_layer(parameters, "OUTPUT", context, None, columns, table.crs,
                                 [wall.contour for wall in walls], "PolygonZ", "facade_walls", progress.part(0.95, 1.0),
                                 building_names(table))
        return {**layer, "WALLS": len(walls), "BUILDINGS_WITH_WALLS": counts.with_walls,
                "BUILDINGS_NEAR": counts.near, "AREA": float(sum(columns["area"])),
                "MEDIAN_SIGMA": float(np.median(columns["sigma"])) if walls else None}

    def _trajectory(self, parameters, context, table, progress):
        """One trajectory of all that were given, None where there is none."""
        if not self.files_of(parameters, "TRAJECTORY", context):
            return None
        return self.joined_trajectory(parameters, context, table.crs_wkt, progress)
