"""What a vehicle to be localised measures with, as parameters of the map of localisation accuracy."""

from __future__ import annotations

from qgis.core import QgsProcessing, QgsProcessingParameterMultipleLayers

from ..framework.declaring.parameters import Declarations, tr

SCANNERS = ("2D", "multi-layer")
MATCHING = ("NDT", "ICP")


class LocalisationSensors(Declarations):
    """Methods with which the algorithm declares sensors, satellites and the simulation, and reads their settings."""

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
        self.add_number("HIDDEN", "Share of hidden rays", "Rays that end at vehicles, trees or people.", 0.1, 0.0, 0.9,
                        advanced=True)
        self.add_distance("CELL", "Cells of the NDT", "Side of the cells of the normal distributions.", 2.0, 0.2, 10.0,
                          advanced=True)
        self.add_distance("COMMON_SIGMA", "Common sigma of a building", "Standard deviation of a displacement that all "
                          "walls of a building share.", 0.0, 0.0, 5.0, advanced=True)
        self.add_distance("START_SIGMA", "Sigma before matching", "What is known before, of east and of north: a "
                          "direction without evidence keeps it.", 1.0, 0.1, 10.0, advanced=True)
        self.add_number("START_HEADING", "Sigma of the heading before matching", "Likewise.", 2.0, 0.1, 20.0,
                        unit="degrees", advanced=True)
        self.add_distance("SEARCH", "Search for repetitions", "Places that look alike are searched for within this "
                          "distance; 0: not at all.", 15.0, 0.0, 40.0, advanced=True)
        self.add_distance("MARKING_RANGE", "Range of markings", "Markings farther away are not seen.", 25.0, 2.0, 100.0,
                          advanced=True)
        self.add_number("MARKING_VIEW", "View of markings", "Angle ahead in which markings are seen: 360 for the "
                        "intensity of a scanner around, about 100 for a camera.", 360.0, 10.0, 360.0, unit="degrees",
                        advanced=True)
        self.add_number("DETECTION", "Detection rate of markings", "Share of the markings within sight that are "
                        "found.", 0.8, 0.05, 1.0, advanced=True)
        self.add_distance("CODE_SIGMA", "Sigma of satellite ranges", "Standard deviation of a code range at the "
                          "zenith.", 2.0, 0.1, 50.0, advanced=True)
        self.add_number("NLOS_SHARE", "Share of reflected signals", "Of the hidden satellites those that are received "
                        "by reflection and used.", 0.3, 0.0, 1.0, advanced=True)
        self.add_distance("GOOD", "Limit of good", "Largest sigma of the weakest direction of a good place.", 0.3, 0.01,
                          10.0, advanced=True)
        self.add_distance("USABLE", "Limit of usable", "The same of a usable place.", 1.0, 0.01, 20.0, advanced=True)

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
