"""What the map of localisation accuracy takes: buildings and markings with their accuracy, roads, satellites."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessing, QgsProcessingParameterExtent, QgsProcessingParameterMultipleLayers

from ...urbanmap_qgis.errors import InputError
from ..framework.building_layers import read_buildings
from ..framework.outlines import numbers
from ..framework.parameters import Declarations, tr
from ..framework.trajectories import trajectory_exists, trajectory_of

SCANNERS = ("2D", "multi-layer")
MATCHING = ("NDT", "ICP")
SIGMA_FIELDS = ("wall_sigma", "sigma_xy")
DEFAULT_FIELDS = {"TOP_FIELD": ("z_top", "top"), "BASE_FIELD": ("z_base", "base", "z_low"),
                  "BUILDING_FIELD": ("building_id", "building", "building_i"), "SIGMA_FIELD": SIGMA_FIELDS}


class LocalisationInputs(Declarations):
    """Methods with which the algorithm declares and reads what it takes."""

    def add_map_inputs(self):
        line = QgsProcessing.SourceType.TypeVectorLine
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
        self.add_distance("MARKING_COMMON", "Common sigma of markings", "Standard deviation of a displacement that the "
                          "markings around a place share, such as that of the aerial block.", 0.03, 0.0, 2.0,
                          advanced=True)
        self.add_vector("ROADS", "Roads", "Lines along which vehicles drive, such as centre lines of lanes. A field "
                        "tunnel (yes, 1) is heeded.", optional=True, source_type=line)
        self.declare_parameter(QgsProcessingParameterMultipleLayers(
            "TRAJECTORY", tr("Trajectories"), QgsProcessing.SourceType.TypeFile, None, True),
            "Drives in the CRS of the buildings instead of roads.")
        self.declare_parameter(QgsProcessingParameterExtent("EXTENT", tr("Area"), None, True),
                               "Area to fill where neither roads nor trajectories are given; left empty, that of the "
                               "map. Along is then north.")
        self.add_distance("SPACING", "Spacing", "Distance between the places.", 5.0, 0.2, 1000.0)
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres. Without it the roads' heights "
                        "are taken, or the feet of the buildings beside them.", optional=True)
        for name, label, help in (
                ("BUILDING_FIELD", "Field with the building", "Features with the same value are one building."),
                ("TOP_FIELD", "Field with the height of the top", "m; z_top is found by itself."),
                ("BASE_FIELD", "Field with the height of the foot", "m; z_base is found by itself."),
                ("SIGMA_FIELD", "Field with the sigma of walls", "Of a building's walls, m; wall_sigma and sigma_xy "
                 "are found by themselves.")):
            self.add_field(name, label, help, "BUILDINGS", advanced=True)

    def add_satellites(self):
        self.declare_parameter(QgsProcessingParameterMultipleLayers(
            "NAVIGATION", tr("Navigation"), QgsProcessing.SourceType.TypeFile, None, True),
            "RINEX navigation files or SP3 orbits: then satellites count too.")
        self.add_text("TIME", "Time", "Time in UTC for roads and areas, such as 2024-04-18 02:30:00; left empty, six "
                      "times over the hours of the navigation files. A trajectory has times of its own.")
        self.add_number("ELEVATION_MASK", "Elevation mask", "Satellites lower than this are not used.", 10.0, 0.0, 60.0,
                        unit="degrees", advanced=True)
        self.add_text("SYSTEMS", "Satellite systems", "G GPS, R GLONASS, E Galileo, C BeiDou, J QZSS.", "GRECJ",
                      advanced=True)

    def add_sensors(self):
        self.add_choice("SCANNER", "Scanner", "Of the vehicle to be localised.", SCANNERS, "2D")
        self.add_distance("MAX_RANGE", "Range of the scanner", "Walls farther away are not seen.", 60.0, 2.0, 300.0)
        self.add_distance("SENSOR_HEIGHT", "Height of the scanner", "Above the road.", 2.0, 0.1, 10.0)
        self.add_choice("MATCHING", "Matching", "How scans are matched to the map.", MATCHING, "NDT")
        self.add_number("ANGLE_STEP", "Angular resolution", "Between rays of a layer.", 0.5, 0.05, 5.0, unit="degrees",
                        advanced=True)
        self.add_distance("NOISE", "Noise of ranges", "Standard deviation.", 0.03, 0.001, 1.0, advanced=True)
        self.add_number("LAYERS", "Layers", "Of a multi-layer scanner.", 16, 2, 256, integer=True, advanced=True)
        self.add_number("LOWEST", "Lowest layer", "Its elevation.", -15.0, -60.0, 60.0, unit="degrees", advanced=True)
        self.add_number("HIGHEST", "Highest layer", "Its elevation.", 15.0, -60.0, 80.0, unit="degrees", advanced=True)
        self.add_number("HIDDEN", "Share of hidden rays", "Rays that end at vehicles, trees or people.", 0.3, 0.0, 0.95,
                        advanced=True)
        self.add_distance("CELL", "Cells of the NDT", "Side of the cells of the normal distributions.", 2.0, 0.2, 10.0,
                          advanced=True)
        self.add_distance("COMMON_SIGMA", "Common sigma of a building", "Standard deviation of a displacement that all "
                          "walls of a building share.", 0.0, 0.0, 5.0, advanced=True)
        self.add_distance("START_SIGMA", "Sigma before matching", "What is known before, of east and of north: a "
                          "direction without evidence keeps it.", 2.0, 0.1, 10.0, advanced=True)
        self.add_number("START_HEADING", "Sigma of the heading before matching", "Likewise.", 2.0, 0.1, 20.0,
                        unit="degrees", advanced=True)
        self.add_distance("SEARCH", "Search for repetitions", "Places that look alike are searched for within this "
                          "distance; 0: not at all.", 15.0, 0.0, 40.0, advanced=True)
        self.add_distance("MARKING_RANGE", "Range of markings", "Markings farther away are not seen.", 25.0, 2.0, 100.0,
                          advanced=True)
        self.add_number("MARKING_VIEW", "View of markings", "Angle ahead in which markings are seen: 360 for the "
                        "intensity of a scanner around, about 100 for a camera.", 360.0, 10.0, 360.0, unit="degrees",
                        advanced=True)
        self.add_number("DETECTION", "Detection rate of markings", "Share of the markings within sight that are found.",
                        0.8, 0.05, 1.0, advanced=True)
        self.add_distance("CODE_SIGMA", "Sigma of satellite ranges", "Standard deviation of a code range at the "
                          "zenith.", 2.0, 0.1, 50.0, advanced=True)
        self.add_number("NLOS_SHARE", "Share of reflected signals", "Of the hidden satellites those that are received "
                        "by reflection and used.", 0.3, 0.0, 1.0, advanced=True)
        self.add_distance("GOOD", "Limit of good", "Largest sigma of the weakest direction of a good place.", 0.3, 0.01,
                          10.0, advanced=True)
        self.add_distance("USABLE", "Limit of usable", "The same of a usable place.", 1.0, 0.01, 20.0, advanced=True)

    def settings_from(self, parameters, context):
        """The core's settings."""
        from ...urbanmap_qgis.localisation.localisation_settings import LocalisationSettings, VehicleScanner

        def number(name):
            return self.parameterAsDouble(parameters, name, context)

        scanner = VehicleScanner(
            self.parameterAsString(parameters, "SCANNER", context), number("SENSOR_HEIGHT"), number("MAX_RANGE"),
            number("ANGLE_STEP"), number("NOISE"), self.parameterAsInt(parameters, "LAYERS", context),
            number("LOWEST"), number("HIGHEST"), number("HIDDEN"))
        return LocalisationSettings(
            scanner, self.parameterAsString(parameters, "MATCHING", context), number("CELL"), number("COMMON_SIGMA"),
            number("START_SIGMA"), number("START_HEADING"), number("SEARCH"), number("GOOD"), number("USABLE"),
            marking_range=number("MARKING_RANGE"), marking_view=number("MARKING_VIEW"), detection=number("DETECTION"),
            marking_common=number("MARKING_COMMON"), code_sigma=number("CODE_SIGMA"), nlos_share=number("NLOS_SHARE"))

    def files_of(self, parameters, name, context):
        """Files of a parameter that takes several; they exist."""
        texts = [text for text in self.parameterAsFileList(parameters, name, context) if text]
        for text in texts:
            there = trajectory_exists(text, context) if name == "TRAJECTORY" else Path(text).is_file()
            if not there:
                raise InputError(tr("{0}: the file {1} does not exist; check its name.").format(
                    self.label_of(name), text))
        return texts

    def read_walls(self, parameters, context, progress):
        """The layer of buildings, the core's walls with their sigmas (None without heights), and the middles of the
        buildings that have none; None where no buildings were given."""
        if not parameters.get("BUILDINGS"):
            return None
        import numpy as np

        from ...urbanmap_qgis.localisation.wall_map import WallMap, building_sigmas, wall_sigmas, walls_with_heights

        table = read_buildings(self, parameters, "BUILDINGS", context, progress)
        field = {name: self.chosen_field(parameters, name, context, table) for name in DEFAULT_FIELDS}
        key = table.columns[field["BUILDING_FIELD"]] if field["BUILDING_FIELD"] else list(range(len(table)))
        first = {name: number for number, name in enumerate(dict.fromkeys(map(str, key)))}
        building = np.array([first[str(name)] for name in key])
        top, base, sigma = (numbers(table, field[name]) if field[name] else None
                            for name in ("TOP_FIELD", "BASE_FIELD", "SIGMA_FIELD"))
        pieces, without = walls_with_heights(table.geometries, building, top, base)
        if pieces is None:
            return table, None, without
        own = None if sigma is None else building_sigmas(building, sigma)
        measured = self.read_vector(parameters, "WALLS", context)
        shapes, known = (), None
        if measured is not None:
            self.same_crs("BUILDINGS", table.crs, "WALLS", measured.crs)
            if "sigma" not in measured.columns:
                raise InputError(tr("{0} has no field sigma; give walls whose accuracy was measured.").format(
                    measured.label))
            shapes, known = measured.geometries, numbers(measured, "sigma")
        sigma = wall_sigmas(pieces, self.parameterAsDouble(parameters, "WALL_SIGMA", context), own, shapes, known)
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

        from ...urbanmap_qgis.localisation.marking_map import marking_map

        self.require_projected("MARKINGS", table.crs)
        usual = self.parameterAsDouble(parameters, "MARKING_SIGMA", context)
        sigma = numbers(table, "sigma") if "sigma" in table.columns else np.full(len(table), usual)
        made = marking_map(table.geometries, np.where(sigma > 0, sigma, usual))
        if not len(made.xy):
            raise InputError(tr("{0}: no feature has an edge; give polygons or lines of markings.").format(table.label))
        return table, made

    def drives_of(self, parameters, context, crs_wkt, progress):
        """The trajectories that were given, in the CRS of the map."""
        drives = []
        for text in self.files_of(parameters, "TRAJECTORY", context):
            read = trajectory_of(text, self.label_of("TRAJECTORY"), context, crs_wkt)
            if read.format == "layer" and read.crs_wkt:
                self.same_crs("TRAJECTORY", read.crs_wkt, "BUILDINGS", crs_wkt)
            for note in read.notes:
                progress.warn(note)
            drives.append(read.trajectory)
        return drives
