"""What the map of localisation accuracy takes: a map with its accuracy, roads, satellites, what a vehicle carries."""

from __future__ import annotations

from qgis.core import QgsProcessingParameterExtent

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.localisation import EvidenceSettings, ScannerSettings
from ..framework.declaring.parameters import tr
from ..framework.layers.building_layers import read_buildings
from ..framework.layers.outlines import column, numbers
from ..framework.layers.trajectories import TrajectoryParameters

SIGMA_FIELDS = ("wall_sigma", "sigma_xy")
DEFAULT_FIELDS = {"TOP_FIELD": ("z_top", "top", "z_max"),
                  "BASE_FIELD": ("z_base", "base", "z_low", "ground", "z_ground"),
                  "BUILDING_FIELD": ("building_id", "building", "building_i"), "SIGMA_FIELD": SIGMA_FIELDS}


class LocalisationInputs(TrajectoryParameters):
    """Methods with which the algorithm declares and reads what it takes."""

    def add_map_inputs(self):
        self.add_polygons("BUILDINGS", "Buildings", "Building models (MultiPolygonZ, such as those of “Building "
                          "models”) or outlines with heights, in a projected CRS in metres. Leave them out to ask for "
                          "markings alone.", optional=True)
        self.add_vector("WALLS", "Walls with sigma", "Walls whose accuracy was measured (field sigma), such as those "
                        "of “Merge building models” or “Adjust walls by GNSS”: walls of the buildings that run "
                        "along them take their sigma.", optional=True)
        self.add_distance("WALL_SIGMA", "Sigma of walls", "Standard deviation of the place of a wall across itself, "
                          "where neither a field nor WALLS tell it.", 0.3, 0.01, 5.0)
        self.add_vector("MARKINGS", "Road markings", "Polygons or lines of markings, such as those of “Lines from road "
                        "markings” (field sigma).", optional=True)
        self.add_distance("MARKING_SIGMA", "Sigma of markings", "Standard deviation of the place of a marking, where "
                          "no field sigma tells it.", 0.05, 0.005, 2.0)
        self.add_settings(EvidenceSettings, "marking_common")
        self.add_vector("ROADS", "Roads", "Lines along which vehicles drive, such as centre lines of lanes. A field "
                        "tunnel (yes, 1) is heeded.", optional=True, kind="line")
        self.add_files("TRAJECTORY", "Trajectories", "Drives in the CRS of the buildings instead of roads.",
                       optional=True)
        self.declare_parameter(QgsProcessingParameterExtent("EXTENT", tr("Area"), None, True),
                               "Area to fill where neither roads nor trajectories are given; left empty, that of the "
                               "map. Along is then north.")
        self.add_distance("SPACING", "Spacing", "Distance between the places.", 5.0, 0.2, 1000.0)
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres. Without it the roads' heights "
                        "are taken, or the feet of the buildings beside them.", optional=True)
        for name, label, help in (
                ("BUILDING_FIELD", "Field with the building", "Features with the same value are one building."),
                ("TOP_FIELD", "Field with the height of the top", "m; z_top and top are found by themselves."),
                ("BASE_FIELD", "Field with the height of the foot", "m; z_base and ground are found by themselves."),
                ("SIGMA_FIELD", "Field with the sigma of walls", "Of a building's walls, m; wall_sigma and sigma_xy "
                 "are found by themselves.")):
            self.add_field(name, label, help, "BUILDINGS", advanced=True)

    def add_satellites(self):
        self.add_files("NAVIGATION", "Navigation", "RINEX navigation files or SP3 orbits: then satellites count too.",
                       optional=True)
        self.add_text("TIME", "Time", "Time in UTC for roads and areas, such as 2024-04-18 02:30:00; left empty, six "
                      "times over the hours of the navigation files. A trajectory has times of its own.")
        self.add_number("ELEVATION_MASK", "Elevation mask", "Satellites lower than this are not used.", 10.0, 0.0, 60.0,
                        unit="degrees", advanced=True)
        self.add_text("SYSTEMS", "Satellite systems", "G GPS, R GLONASS, E Galileo, C BeiDou, J QZSS.", "GRECJ",
                      advanced=True)

    def add_sensors(self):
        self.add_settings(ScannerSettings, "kind", "max_range", "height")
        self.add_settings(EvidenceSettings, "matcher")
        self.add_settings(ScannerSettings)
        self.add_settings(EvidenceSettings)

    def add_simulation(self):
        self.add_boolean("SIMULATE", "Simulate scans", "Scans are simulated at some places and registered to the map: "
                         "observed against predicted accuracy in the report and among the results.")
        self.add_number("SIMULATE_EVERY", "Simulate every", "At every so many places that see walls.", 5, 1, 10000,
                        integer=True, advanced=True)
        self.add_number("DRAWS", "Scans a place", "Each in another true city, as the sigmas of the walls allow.", 20, 2,
                        1000, integer=True, advanced=True)
        self.add_polygons("TRUTH_BUILDINGS", "True buildings", "The true city to simulate in, with heights as "
                          "BUILDINGS has them; without it the map is displaced by its sigmas.", optional=True)
        self.add_number("SEED", "Seed", "Of the simulation.", 1, 0, integer=True, advanced=True)

    def settings_from(self, parameters, context):
        """The core's settings."""
        from ...urbanmap_qgis.localisation.localisation_settings import LocalisationSettings, VehicleScanner

        return self.settings(LocalisationSettings, parameters, context,
                             scanner=self.settings(VehicleScanner, parameters, context))

    def read_pieces(self, parameters, name, context, progress):
        """A layer of buildings, the core's walls (None without heights), the middles of the buildings that have none,
        the number of the building of each feature, and its sigma (None without a field)."""
        import numpy as np

        from ...urbanmap_qgis.localisation.walls.wall_map import walls_with_heights

        table = read_buildings(self, parameters, name, context, progress)
        chosen = parameters if name == "BUILDINGS" else {}
        field = {each: self.chosen_field(chosen, each, context, table) for each in DEFAULT_FIELDS}
        key = table.columns[field["BUILDING_FIELD"]] if field["BUILDING_FIELD"] else list(range(len(table)))
        first = {each: number for number, each in enumerate(dict.fromkeys(map(str, key)))}
        building = np.array([first[str(each)] for each in key])
        top, base, sigma = (numbers(table, field[each]) if field[each] else None
                            for each in ("TOP_FIELD", "BASE_FIELD", "SIGMA_FIELD"))
        return table, *walls_with_heights(table.geometries, building, top, base), building, sigma

    def read_truth(self, parameters, context, crs, progress):
        """Walls of the true city; None where none was given."""
        if not parameters.get("TRUTH_BUILDINGS"):
            return None
        table, pieces, *_ = self.read_pieces(parameters, "TRUTH_BUILDINGS", context, progress)
        self.same_crs("TRUTH_BUILDINGS", table.crs, "BUILDINGS", crs)
        if pieces is None:
            raise InputError(tr("{0}: no building has a height; give solids or outlines with heights.").format(
                table.label))
        return pieces

    def read_walls(self, parameters, context, progress):
        """The layer of buildings, the core's walls with their sigmas (None without heights), and the middles of the
        buildings that have none; None where no buildings were given."""
        if not parameters.get("BUILDINGS"):
            return None
        from ...urbanmap_qgis.localisation.walls.measured_walls import sigmas_of_moved
        from ...urbanmap_qgis.localisation.walls.wall_map import WallMap, building_sigmas, wall_sigmas

        table, pieces, without, building, sigma = self.read_pieces(parameters, "BUILDINGS", context, progress)
        if pieces is None:
            return table, None, without
        accuracy = None if sigma is None else building_sigmas(building, sigma)
        measured = self.read_vector(parameters, "WALLS", context)
        shapes, known = (), None
        if measured is not None:
            self.same_crs("BUILDINGS", table.crs, "WALLS", measured.crs)
            if "sigma" not in measured.columns:
                raise InputError(tr("{0} has no field sigma; give walls whose accuracy was measured.").format(
                    measured.label))
            shapes, known = measured.geometries, sigmas_of_moved(numbers(measured, "sigma"), column(measured, "status"))
        sigma = wall_sigmas(pieces, self.parameterAsDouble(parameters, "WALL_SIGMA", context), accuracy, shapes, known)
        return table, WallMap.of(pieces, sigma), without

    def chosen_field(self, parameters, name, context, table):
        """The field chosen, or the first usual one that the layer has; empty if neither."""
        chosen = self.parameterAsString(parameters, name, context)
        if chosen and chosen not in table.columns:
            raise InputError(tr("{0}: the layer has no field {1}.").format(self.label_of(name), chosen))
        return chosen or next((field for field in DEFAULT_FIELDS[name] if field in table.columns), "")

    def read_markings(self, parameters, context, progress):
        """The layer of markings and the core's map of them; None where none were given."""
        table = self.read_vector(parameters, "MARKINGS", context, progress)
        if table is None:
            return None
        import numpy as np

        from ...urbanmap_qgis.localisation.evidence.marking_map import marking_map

        self.require_projected("MARKINGS", table.crs)
        usual = self.parameterAsDouble(parameters, "MARKING_SIGMA", context)
        sigma = numbers(table, "sigma") if "sigma" in table.columns else np.full(len(table), usual)
        result = marking_map(table.geometries, np.where(sigma > 0, sigma, usual))
        if not len(result.xy):
            raise InputError(tr("{0}: no feature has an edge; give polygons or lines of markings.").format(table.label))
        return table, result

    def read_sky(self, parameters, context, table, drives, progress):
        """The core's sky (None without navigation), and GPS seconds less the drives' time."""
        import numpy as np

        from ...urbanmap_qgis.gnss.orbits.ephemeris import read_navigation
        from ...urbanmap_qgis.gnss.rays.visibility import gps_time_of
        from ...urbanmap_qgis.gnss.signals.observations import trajectory_shift
        from ...urbanmap_qgis.localisation.evidence.satellite_evidence import SkyTimes
        from ...urbanmap_qgis.localisation.report.accuracy_tables import times_of_day

        files = self.files_of(parameters, "NAVIGATION", context)
        if not files:
            return None, 0.0
        navigation = read_navigation(files)
        for note in navigation.notes:
            progress.warn(note)
        time = self.parameterAsString(parameters, "TIME", context).strip()
        shift = trajectory_shift(drives[0], [navigation.span()], "navigation files") if drives else 0.0
        times = np.array([gps_time_of(time)]) if time else times_of_day(navigation)
        return SkyTimes(navigation, times, self.parameterAsString(parameters, "SYSTEMS", context).upper(),
                        self.parameterAsDouble(parameters, "ELEVATION_MASK", context), table.crs_wkt,
                        0.0 if drives else None), shift
