"""urbanmap:adjustwalls."""

from __future__ import annotations

from ...urbanmap_qgis.settings.gnss import AdjustmentSettings, TraceSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from ..framework.layers.overlays import add_orthophoto, orthophoto_pictures
from .inputs import GnssInputs


class AdjustWalls(GnssInputs, UrbanMapAlgorithm):
    ID = "adjustwalls"
    NAME = "Adjust walls by GNSS"
    SOURCE = "Javanmardi, 5.6"
    KEYWORDS = ("GNSS", "GPS", "RINEX", "wall", "facade", "parapet", "multipath", "reflection", "ray tracing")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")
    HELP = (
        "Puts walls of building models where reflected satellite signals say they are: models made from roofs have "
        "their walls at the parapets, about a metre off.\n"
        "The code measurement of a signal that a wall has reflected is too long by twice the distance to the wall "
        "times a cosine. Only signals that are blocked for sure and that exactly one wall can have reflected are "
        "used; those of a satellite within half a minute count as one. A wall is adjusted if there are enough of them, "
        "of several satellites and passes, with one answer. Where they tell enough without deciding it is “likely”: "
        "moved too, with a larger standard deviation. All other walls stay where they are, with the reason. Buildings "
        "stay closed: neighbouring edges follow.\n"
        "Give as many passes as there are: with one or two nothing is moved, about ten are needed for a wall."
    )

    def declare(self):
        self.add_gnss_inputs()
        self.add_settings(AdjustmentSettings)
        self.add_layer_output("OUTPUT", "Adjusted buildings", "The buildings with their fields, and walls_adjusted "
                              "(number of walls moved by their own observations) and walls_moved_by (m, largest).",
                              solids=True)
        self.add_layer_output("OUTPUT_WALLS", "Walls", "LineStringZ where each wall now stands: building, edge, status "
                              "(adjusted, likely, not observable, held), reason why it is not adjusted, offset and "
                              "sigma (m, outwards), applied (m moved), observations, signals, satellites, passes, "
                              "on_time (share of the observations that are neither NLOS-delayed nor outliers), "
                              "distance (m to the nearest antenna), length, low, top (m).", optional=True,
                              by_default=True, kind="line")
        add_orthophoto(self)
        self.add_report("HTML report: sky plot, residuals by class against prediction, walls before and after, what to "
                        "distrust.", by_default=True)
        self.add_number_output("WALLS", "Walls", "Number of walls.")
        self.add_number_output("ADJUSTED", "Adjusted", "Walls whose own observations decide where they stand.")
        self.add_number_output("LIKELY", "Likely", "Walls that were moved by observations that are few or contradict "
                               "each other.")
        self.add_number_output("OBSERVATIONS_USED", "Observations used", "Independent observations of all walls.")
        self.add_number_output("PASSES", "Passes", "Observation files with usable signals.")
        self.add_number_output("MEDIAN_SIGMA", "Median sigma", "Of the offsets of the adjusted walls.", "m")
        self.add_number_output("MEDIAN_OFFSET", "Median offset", "Size of the offsets of the adjusted walls.", "m")

    def work(self, parameters, context, progress):
        import numpy as np

        from ...urbanmap_qgis.gnss.reports.report import write_adjustment_report
        from ...urbanmap_qgis.gnss.walls.adjustment import ADJUSTED, LIKELY, adjust_walls
        from ...urbanmap_qgis.gnss.walls.columns import adjusted_wall_columns, building_columns, wall_lines

        buildings = self.read_gnss_buildings(parameters, context, progress)
        table = buildings.table
        signals = self.read_signals(parameters, context, buildings, progress.part(0.02, 0.3))
        settings = self.settings(AdjustmentSettings, parameters, context,
                                 trace=self.settings(TraceSettings, parameters, context))
        result = adjust_walls(table.geometries, buildings.building, signals, buildings.top, buildings.base,
                              settings, progress.part(0.3, 0.95))
        adjusted = result.walls.status == ADJUSTED
        likely = int((result.walls.status == LIKELY).sum())
        progress.message(tr("{0} of {1} walls were adjusted, {2} more are likely.").format(
            int(adjusted.sum()), len(adjusted), likely))
        if not result.walls.is_moved.any():
            progress.warn(tr("No wall was moved: the observations do not decide; the field “reason” of the walls tells "
                             "why."))
        report = self.write_file(parameters, "OUTPUT_REPORT", context, lambda path: write_adjustment_report(
            path, signals, result, buildings.names, table.geometries, orthophoto_pictures(
                self, parameters, context, table.crs, "BUILDINGS", table.geometries, result.shapes)))
        walls = self.write_layer(parameters, "OUTPUT_WALLS", context, None,
                                 adjusted_wall_columns(result, buildings.names), table.crs,
                                 wall_lines(result, signals), "LineStringZ", "gnss_walls", progress.part(0.95, 0.97))
        extra = building_columns(result, buildings.building)
        layer = self.write_layer(
            parameters, "OUTPUT", context,
            make_fields("walls_adjusted", "walls_moved_by", base=table.fields),
            {**table.columns, **extra}, table.crs, result.shapes, geometry_type(result.shapes), "gnss_buildings",
            progress.part(0.97, 1.0))
        sizes = np.abs(result.walls.offset[adjusted])
        return {**layer, **walls, **report, "WALLS": len(adjusted), "ADJUSTED": int(adjusted.sum()),
                "LIKELY": likely, "OBSERVATIONS_USED": len(result.observations),
                "PASSES": len(np.unique(signals.epochs.source[signals.epoch])),
                "MEDIAN_SIGMA": float(np.median(result.walls.sigma[adjusted])) if adjusted.any() else None,
                "MEDIAN_OFFSET": float(np.median(sizes)) if adjusted.any() else None}


def geometry_type(shapes) -> str:
    """QGIS's name of the type that holds all the shapes."""
    present = [shape for shape in shapes if shape is not None]
    multi = any(shape.geom_type.startswith("Multi") for shape in present)
    return f"{'Multi' if multi else ''}Polygon{'Z' if any(shape.has_z for shape in present) else ''}"
