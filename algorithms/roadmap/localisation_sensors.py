"""What a vehicle to be localised measures with, as parameters of the map of localisation accuracy."""

from __future__ import annotations

from ...urbanmap_qgis.settings.localisation import EvidenceSettings, ScannerSettings
from ..framework.declaring.parameters import Declarations


class LocalisationSensors(Declarations):
    """Methods with which the algorithm declares sensors, satellites and the simulation, and reads their settings."""

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
