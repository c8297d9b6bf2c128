"""urbanmap:markinglines."""

from __future__ import annotations

from collections import Counter

from qgis.core import QgsProcessingParameterDefinition

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.roadmap import LineSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr


class MarkingLines(UrbanMapAlgorithm):
    ID = "markinglines"
    NAME = "Lines from road markings"
    SOURCE = "Javanmardi, 6.2"
    KEYWORDS = ("road", "marking", "lane", "line", "dashed", "crosswalk", "stop line", "arrow", "lane map", "HD map")
    REQUIRES = ("numpy", "scipy", "shapely", "rasterio")
    HELP = (
        "Turns polygons of road markings into line work: centre lines with kind, width, colour and sigma, stop lines, "
        "crosswalks, and symbols such as arrows and diamonds.\n"
        "Pieces of paint that continue each other become one line, also across the gaps of dashes, of wear and of "
        "vehicles; how much was bridged is a field. A line is dashed where a periodic pattern explains its paint "
        "better than a solid line; begins and ends of the dashes are a field. Centre lines are fitted to "
        "cross-sections of the paint and smoothed over 3 m.\n"
        "How wide the paint is comes from marking points: outlines from images show where a line lies, not how wide "
        "it is. A line without points takes what the outlines of lines alike are too wide by; where nothing tells the "
        "width to 3 cm it is left empty.\n"
        "Arrows are told by their shape, and only where one shape is clearly better than the others. Paint that is "
        "neither line nor known shape keeps its polygon, with the class unknown."
    )

    def declare(self):
        self.add_polygons("MARKINGS", "Road markings", "Polygons of the markings, such as those of “Road markings from "
                          "orthophoto”, in a projected CRS in metres. A field colour (white, yellow) is used where "
                          "there is one.", optional=True)
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres, in the CRS of the markings: "
                        "gives lines and areas their heights.", optional=True)
        self.add_settings(LineSettings, "source_sigma")
        points = self.add_points("POINTS", "Marking points", "LAS, LAZ or COPC files of “Road markings of a mobile "
                                 "survey”, from a corrected survey. They show paint that vehicles, trees or shadows "
                                 "hide from the air: what the polygons do not show is added to them. Without polygons "
                                 "they are all the paint.", optional=True)
        points.setFlags(points.flags() | QgsProcessingParameterDefinition.Flag.FlagAdvanced)
        self.add_points_crs()
        self.add_settings(LineSettings)
        self.add_layer_output("OUTPUT", "Marking lines", "Lines, with heights where a ground is given: class (solid, "
                              "dashed, stop line, guiding strip), colour, width and width_sigma (m, of the paint; by "
                              "marking points, or empty where nothing tells it to 3 cm), sigma (m, across), length "
                              "(m), bridged (m without paint that should be there), period and dash (m), dashes "
                              "(begins and ends along the line, m), chain (sections of one line), partner (chain that "
                              "makes it a double line), confidence (0 to 1: share of the paint that should be there "
                              "and is seen; of a stop line less where only lines' ends or only a crosswalk show it), "
                              "placed (ends among the dashes' that are worn and lie where whole dashes ask for them, "
                              "m), sigmas (m, at each vertex, growing with the distance to the paint).", kind="line")
        self.add_layer_output("OUTPUT_AREAS", "Marking areas", "Polygons: class (crosswalk; arrow straight, ..., or "
                              "arrow, kind unknown; diamond; unknown), colour, heading (degrees from grid north in "
                              "which it is read), score (0 to 1: agreement with the shape; of a crosswalk paint at its "
                              "bars' places less that between them).", kind="polygon")
        self.add_number_output("LINES", "Lines", "Number of lines.")
        self.add_number_output("LENGTH", "Length", "Length of all lines.", "m")
        self.add_number_output("CROSSWALKS", "Crosswalks", "Number of crosswalks.")
        self.add_number_output("UNKNOWN_SHARE", "Unknown paint", "Share of the area of the markings that is neither "
                               "line nor known shape, 0 to 1.")

    def check(self, parameters, context):
        if not parameters.get("MARKINGS") and not self.point_files(parameters, "POINTS", context):
            raise InputError(tr("Neither road markings nor marking points were given: give one or both."))

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.roadmap.lines.line_work import line_work, with_ground_heights

        polygons, colours, crs, source, drives = self._paint(parameters, context, progress.part(0.0, 0.05))
        settings = self.settings(LineSettings, parameters, context)
        work = line_work(polygons, colours, settings, progress.part(0.05, 0.8), drives)
        with self.sampled_raster(parameters, "GROUND", context, source, crs) as ground:
            if ground is not None:
                work = with_ground_heights(work, ground.sample)
                self._tell_heights(work, progress)
        self._tell(work, progress)
        lines = self._write_lines(parameters, context, work, crs, ground is not None, progress.part(0.8, 0.9))
        areas = self._write_areas(parameters, context, work, crs, ground is not None, progress.part(0.9, 1.0))
        unknown = sum(area.polygon.area for area in work.areas if area.kind == "unknown")
        return {**lines, **areas, "LINES": len(work.lines),
                "LENGTH": float(sum(line.plan.length for line in work.lines)),
                "CROSSWALKS": sum(area.kind == "crosswalk" for area in work.areas),
                "UNKNOWN_SHARE": float(unknown / max(sum(shape.area for shape in polygons), 1e-9))}

    def _paint(self, parameters, context, progress):
        """Polygons of all paint with their colours, their CRS, the name of the input that it comes from, and the
        marking points (n, 2) of each file."""
        import shapely

        polygons, colours, crs, source, drives = [], [], None, "MARKINGS", []
        table = self.read_polygons(parameters, "MARKINGS", context, progress.part(0.0, 0.5))
        if table is not None:
            rows = [row for row, shape in enumerate(table.geometries) if shape is not None]
            names = table.columns.get("colour") or table.columns.get("color") or [""] * len(table)
            parts, owner = shapely.get_parts(shapely.force_2d(table.geometries[rows]), return_index=True)
            polygons, colours, crs = list(parts), [names[rows[k]] or "" for k in owner], table.crs
        files = self.point_files(parameters, "POINTS", context)
        if files:
            from ...urbanmap_qgis.io.points.pointcloud import open_cloud
            from ...urbanmap_qgis.roadmap.lines.point_paint import (
                check_same_place,
                drive_points,
                drive_polygons,
                hidden_paint,
            )

            cloud = open_cloud(files)
            self.require_projected("POINTS", cloud.crs_wkt)
            if crs is None:
                crs, source = cloud.crs_wkt, "POINTS"
            self.same_crs("POINTS", cloud.crs_wkt, source, crs)
            drives = drive_points(files, progress.part(0.5, 0.8))
            check_same_place(polygons, drives)
            added = hidden_paint(polygons, drive_polygons(drives))
            progress.message(tr("Marking points add {0} pieces of paint, {1} m².").format(
                len(added), round(sum(shape.area for shape in added), 1)))
            polygons, colours = [*polygons, *added], [*colours, *[""] * len(added)]
        return polygons, colours, crs, source, drives

    def _write_lines(self, parameters, context, work, crs, has_heights, progress):
        import numpy as np
        import shapely

        from ...urbanmap_qgis.roadmap.map_tables import told_sigmas

        lines = work.lines
        columns = {
            "line_id": np.array(range(len(lines)), np.int64), "class": [line.kind for line in lines],
            "colour": [line.colour or None for line in lines], "width": np.array([line.width for line in lines]),
            "sigma": [line.sigma for line in lines], "length": [line.plan.length for line in lines],
            "bridged": [line.bridged for line in lines], "period": np.array([line.period for line in lines]),
            "dash": np.array([line.dash for line in lines]),
            "dashes": [";".join(f"{start:.2f}-{end:.2f}" for start, end in line.dashes) for line in lines],
            "chain": [line.chain for line in lines],
            "partner": [None if line.partner < 0 else line.partner for line in lines],
            "confidence": [line.confidence for line in lines],
            "placed": [";".join(f"{end:.2f}" for end in line.placed) or None for line in lines],
            "sigmas": [told_sigmas(line.sigmas) for line in lines],
            "width_sigma": np.array([line.width_sigma for line in lines])}
        return self.write_layer(parameters, "OUTPUT", context, None, columns, crs,
                                [shapely.linestrings(line.points) if has_heights else line.plan for line in lines],
                                "LineStringZ" if has_heights else "LineString", style="marking_lines",
                                progress=progress)

    def _write_areas(self, parameters, context, work, crs, has_heights, progress):
        from ...urbanmap_qgis.roadmap.lines.line_work import grid_heading

        areas = work.areas
        columns = {"area_id": list(range(len(areas))), "class": [area.kind for area in areas],
                   "colour": [area.colour or None for area in areas],
                   "heading": [grid_heading(area.heading) for area in areas], "score": [area.score for area in areas],
                   "area": [area.polygon.area for area in areas]}
        return self.write_layer(parameters, "OUTPUT_AREAS", context, None, columns, crs,
                                [area.multipolygon for area in areas],
                                "MultiPolygonZ" if has_heights else "MultiPolygon", style="marking_areas",
                                progress=progress)

    def _tell_heights(self, work, progress):
        share = work.share_without_heights()
        if share == 1.0 and work.lines:
            raise InputError(tr("{0} has no value at any line: check that it is of the same place as the "
                                "markings.").format(self.label_of("GROUND")))
        if share > 0.0:
            progress.warn(tr("{0} has no value at {1} % of the lines' places: they stay without heights.").format(
                self.label_of("GROUND"), max(1, round(100 * share))))

    def _tell(self, work, progress):
        kinds = Counter(line.kind for line in work.lines)
        progress.message(", ".join(f"{tr(kind)}: {count}" for kind, count in sorted(kinds.items())) or tr("No lines."))
        if not work.lines:
            progress.warn(tr("No line was found in the {0} polygons: check that they are road markings in metres, and "
                             "lower the minimum line length for short ones.").format(work.polygons))
