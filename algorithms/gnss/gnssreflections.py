"""urbanmap:gnssreflections."""

from __future__ import annotations

from ...urbanmap_qgis.settings.gnss import TraceSettings
from ..framework.base import UrbanMapAlgorithm
from .inputs import GnssInputs


class GnssReflections(GnssInputs, UrbanMapAlgorithm):
    ID = "gnssreflections"
    NAME = "GNSS reflections"
    SOURCE = "Javanmardi, 5.6"
    KEYWORDS = ("GNSS", "GPS", "RINEX", "multipath", "NLOS", "ray tracing", "reflection", "satellite")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")
    HELP = (
        "Traces the observed satellite signals among building models: in line of sight, blocked, or reflected once by "
        "a wall.\n"
        "Each signal becomes a 3D line with its excess path as the model predicts it and the residual of its code "
        "measurement, after satellite, atmosphere and receiver clock. Signals that are blocked and received all the "
        "same have taken another path; where one wall alone can have reflected them, the residual should be the "
        "excess path.\n"
        "The class of a signal near an edge is not sure, as walls of models stand up to a metre or two off."
    )

    def declare(self):
        self.add_gnss_inputs()
        self.add_number("EVERY", "Seconds between lines", "Lines are drawn of epochs this far apart; figures are those "
                        "of all.", 1.0, 0.0, 3600.0, unit="s", advanced=True)
        self.add_distance("LENGTH", "Length of the lines", "Of the part towards the satellite.", 100.0, 1.0, 10000.0,
                          advanced=True)
        self.add_layer_output("OUTPUT", "Rays", "LineStringZ: time, pass, satellite, system, kind (LOS, NLOS, "
                              "reflected), sure, elevation, azimuth (degrees, from grid north), cn0, excess (predicted "
                              "excess path, m), residual (m), difference (residual minus excess), reflections (number "
                              "of walls that can have reflected it), building, edge (of the wall).", kind="line")
        self.add_report("HTML report: sky plot, residuals by class against prediction, what to distrust.")
        self.add_number_output("SIGNALS", "Signals", "Number of signals.")
        self.add_number_output("LOS", "In line of sight", "Number of signals.")
        self.add_number_output("NLOS", "Blocked", "Number of signals without a single wall to reflect them.")
        self.add_number_output("REFLECTED", "Reflected", "Number of signals.")
        self.add_number_output("LOS_MEDIAN", "Median residual in line of sight", "After the receiver's clock.", "m")
        self.add_number_output("LOS_IQR", "Quartile range in line of sight", "Of the residuals.", "m")
        self.add_number_output("WITHIN_5", "Within 5 m", "Share of the reflected signals within 5 m of prediction.")
        self.add_number_output("WITHIN_10", "Within 10 m", "Share of the reflected signals within 10 m of prediction.")

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.gnss.rays.ray_lines import ray_columns, ray_lines, ray_statistics, thinned
        from ...urbanmap_qgis.gnss.rays.reflections import LOS, NLOS, REFLECTED
        from ...urbanmap_qgis.gnss.rays.wall_faces import building_walls
        from ...urbanmap_qgis.gnss.reports.report import write_reflection_report
        from ...urbanmap_qgis.gnss.walls.residuals import trace_residuals

        buildings = self.read_gnss_buildings(parameters, context, progress)
        walls = building_walls(buildings.table.geometries, buildings.building, buildings.top, buildings.base)
        signals = self.read_signals(parameters, context, buildings, progress.part(0.02, 0.4))
        paths, corrected = trace_residuals(walls, signals, self.settings(TraceSettings, parameters, context),
                                           progress.part(0.4, 0.8))
        figures = ray_statistics(signals, paths, corrected)
        rows = thinned(signals, self.parameterAsDouble(parameters, "EVERY", context))
        report = self.write_file(parameters, "OUTPUT_REPORT", context, write_reflection_report, signals, paths,
                                 corrected, figures)
        layer = self.write_layer(
            parameters, "OUTPUT", context, None,
            ray_columns(walls, buildings.names, signals, paths, corrected, rows), buildings.table.crs,
            ray_lines(signals, paths, rows, self.parameterAsDouble(parameters, "LENGTH", context)), "LineStringZ",
            "gnss_rays", progress.part(0.8, 1.0))
        return {**layer, **report, "SIGNALS": len(signals),
                "LOS": figures.count[LOS], "NLOS": figures.count[NLOS], "REFLECTED": figures.count[REFLECTED],
                "LOS_MEDIAN": float(figures.los_median),
                "LOS_IQR": float(figures.los_iqr), "WITHIN_5": float(figures.within_5),
                "WITHIN_10": float(figures.within_10)}
