"""urbanmap:satellitevisibility."""

from __future__ import annotations

from qgis.core import QgsProcessingParameterExtent

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from .inputs import GnssInputs

SYSTEM_FIELDS = {"gps": "G", "glonass": "R", "galileo": "E", "beidou": "C", "qzss": "J"}


class SatelliteVisibility(GnssInputs, UrbanMapAlgorithm):
    ID = "satellitevisibility"
    SUCCESSOR = "localisationaccuracy"
    NAME = "Satellite visibility"
    SOURCE = "Javanmardi, 3.3 (figure 3-20)"
    KEYWORDS = ("GNSS", "GPS", "satellite", "line of sight", "LOS", "visibility", "PDOP", "sky", "planning")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio")
    HELP = (
        "Counts the navigation satellites in line of sight among building models: along a trajectory, or over an area "
        "at a given time.\n"
        "Fewer than four satellites of one system do not give a position; with each further system one more is "
        "needed for its clock (QZSS keeps that of GPS). The PDOP tells how much larger the error of a position is than "
        "that of a range; it is empty where the satellites in line of sight fix no position.\n"
        "Walls hide satellites; trees, vehicles and bridges do not. Where walls of the models stand a metre off, "
        "satellites near their edges are counted wrongly."
    )

    def declare(self):
        self.add_gnss_buildings()
        self.add_files("NAVIGATION", "Navigation", "RINEX navigation files or SP3 orbits of the day.")
        self.add_files("TRAJECTORY", "Trajectories", "Drives along which to count, in the CRS of the buildings: CSV "
                       "time,x,y,z,roll,pitch,heading, SBET, or point layers. Left empty, an area is filled.",
                       optional=True)
        self.add_text("TIME", "Time", "Time in UTC for an area, such as 2024-04-18 02:30:00; a trajectory has times of "
                      "its own.")
        self.declare_parameter(QgsProcessingParameterExtent("EXTENT", tr("Area"), None, True),
                               "Area to fill where no trajectory is given; left empty, that of the buildings.")
        self.add_distance("RESOLUTION", "Resolution", "Distance in metres between the places in an area.", 5.0, 0.2,
                          1000.0)
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres, for an area. Without it the "
                        "ground is level at the feet of the buildings.", optional=True)
        self.add_distance("ANTENNA_HEIGHT", "Height of the antenna", "Above the ground, in metres, for an area.", 2.0,
                          0.0, 100.0)
        self.add_number("EVERY", "Seconds between places", "Along a trajectory.", 1.0, 0.01, 3600.0, unit="s")
        self.add_number("ELEVATION_MASK", "Elevation mask", "Satellites lower than this are not counted.", 10.0, 0.0,
                        80.0, unit="degrees")
        self.add_text("SYSTEMS", "Satellite systems", "Letters of those that are counted: G GPS, R GLONASS, E Galileo, "
                      "C BeiDou, J QZSS.", "GRECJ")
        self.add_antenna()
        self.add_layer_output("OUTPUT", "Visible satellites", "PointZ: time (of the trajectory, or GPS seconds), "
                              "satellites (in line of sight), gps, glonass, galileo, beidou, qzss (of them), above "
                              "(satellites above the mask, hidden ones too), pdop.", kind="point")
        self.add_raster_output("OUTPUT_RASTER", "Visible satellites over the area", "Number of satellites in line of "
                               "sight; no value inside buildings. Only without a trajectory.", optional=True)
        self.add_number_output("MEAN", "Mean", "Satellites in line of sight, mean over the places.")
        self.add_number_output("FEWER_THAN_4", "Share below four", "Share of the places with fewer than four "
                               "satellites in line of sight, 0 to 1.")
        self.add_number_output("WITHOUT_POSITION", "Share without a position", "Share of the places where the "
                               "satellites in line of sight fix no position, 0 to 1.")
        self.add_number_output("SATELLITES", "Satellites", "Number of different satellites above the mask.")

    def check(self, parameters, context):
        drives = self.files_of(parameters, "TRAJECTORY", context)
        time = self.parameterAsString(parameters, "TIME", context).strip()
        if not drives and not time:
            raise InputError(tr("Give a trajectory, or a time for an area."))
        if drives and parameters.get("OUTPUT_RASTER"):
            raise InputError(tr("{0}: a raster is made of an area only; leave out the trajectory or it.").format(
                self.label_of("OUTPUT_RASTER")))
        super().check(parameters, context)

    def work(self, parameters, context, progress):
        import numpy as np
        import shapely

        from ...urbanmap_qgis.gnss.orbits.ephemeris import read_navigation
        from ...urbanmap_qgis.gnss.rays.tracing import WallObstacles
        from ...urbanmap_qgis.gnss.rays.visibility import SkySettings
        from ...urbanmap_qgis.gnss.rays.wall_faces import building_walls

        buildings = self.read_gnss_buildings(parameters, context, progress)
        table = buildings.table
        walls = building_walls(table.geometries, buildings.building, buildings.top, buildings.base)
        navigation = read_navigation(self.files_of(parameters, "NAVIGATION", context))
        for note in navigation.notes:
            progress.warn(note)
        settings = SkySettings(self.parameterAsString(parameters, "SYSTEMS", context).upper(),
                               self.parameterAsDouble(parameters, "ELEVATION_MASK", context))
        progress.step(0.05)
        inputs = (WallObstacles.of(walls), walls, navigation, table, settings, progress.part(0.05, 0.9))
        along = self.files_of(parameters, "TRAJECTORY", context)
        time, place, seen, raster = (self._along if along else self._over)(parameters, context, *inputs)
        columns = {"time": time, "satellites": seen.satellites,
                   **{field: seen.by_system.get(letter, np.full(len(time), np.nan))
                      for field, letter in SYSTEM_FIELDS.items()}, "above": seen.above, "pdop": seen.pdop}
        layer = self.write_layer(parameters, "OUTPUT", context, None, columns, table.crs, shapely.points(place),
                                 "PointZ", "satellite_visibility", progress.part(0.9, 1.0))
        outside = np.isfinite(seen.satellites)
        if not outside.all():
            progress.warn(tr("{0} of {1} places lie inside buildings and have no number.").format(
                int((~outside).sum()), len(outside)))
        share = _share if outside.any() else lambda _values: None
        return {**layer, **({"OUTPUT_RASTER": raster} if raster else {}), "SATELLITES": len(seen.names),
                "MEAN": share(seen.satellites[outside]), "FEWER_THAN_4": share(seen.satellites[outside] < 4),
                "WITHOUT_POSITION": share(np.isnan(seen.pdop[outside]))}

    def _along(self, parameters, context, obstacles, _walls, navigation, table, settings, progress):
        from ...urbanmap_qgis.gnss.rays.visibility import visibility_along

        trajectory = self.joined_trajectory(parameters, context, table.crs_wkt, progress)
        time, place, seen = visibility_along(
            obstacles, navigation, trajectory, table.crs_wkt, settings, self._lever_arm(parameters, context),
            self.parameterAsDouble(parameters, "EVERY", context), progress)
        return time, place, seen, None

    def _over(self, parameters, context, obstacles, walls, navigation, table, settings, progress):
        import numpy as np

        from ...urbanmap_qgis.gnss.rays.visibility import area_grid, gps_time_of, visibility_over
        from ...urbanmap_qgis.io.raster import write_raster

        time = gps_time_of(self.parameterAsString(parameters, "TIME", context))
        grid = area_grid(self._bounds(parameters, context, table),
                         self.parameterAsDouble(parameters, "RESOLUTION", context))
        antenna = self._antenna(parameters, context, grid, walls, table)
        cells, place, seen = visibility_over(obstacles, navigation, grid, antenna, time, table.crs_wkt, settings,
                                             progress)
        path = self.output_layer_path(parameters, "OUTPUT_RASTER", context, style="satellite_visibility_area")
        if path:
            number = np.full(grid.shape, np.nan, np.float32)
            number[cells[:, 0], cells[:, 1]] = seen.satellites
            write_raster(path, number, grid, table.crs_wkt)
        return np.full(len(place), time), place, seen, str(path) if path else None

    def _bounds(self, parameters, context, table):
        """The area asked for, in the CRS of the buildings, or theirs."""
        import shapely

        box = self.parameterAsExtent(parameters, "EXTENT", context, table.crs)
        if box.isNull() or box.isEmpty():
            return tuple(shapely.total_bounds([shape for shape in table.geometries if shape is not None]))
        return box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum()

    def _antenna(self, parameters, context, grid, walls, table):
        """Heights of the antenna (rows, columns) over the ground, NaN beside the ground raster."""
        import numpy as np

        from ...urbanmap_qgis.gnss.rays.visibility import level_ground

        above = self.parameterAsDouble(parameters, "ANTENNA_HEIGHT", context)
        with self.sampled_raster(parameters, "GROUND", context, "BUILDINGS", table.crs) as ground:
            if ground is None:
                return np.full(grid.shape, level_ground(walls) + above)
            x, y = np.meshgrid(*grid.centres())
            return ground.sample(x.ravel(), y.ravel()).reshape(grid.shape) + above


def _share(values):
    return float(values.mean())
