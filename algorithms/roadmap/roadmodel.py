"""urbanmap:roadmodel."""

from __future__ import annotations

from collections import Counter

from qgis.core import QgsProcessing

from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import HTML_FILTER, tr
from ..framework.layers.layers import make_fields
from .data_date import day_of

MAP_LEVELS = ("none", "500", "1000", "2500", "5000")
MATERIALS = ("GSI fundamental data", "digital topographic map", "other data")
FIELDS = (("road_id", "int"), ("kind", "text"), ("function", "text"), ("width", "real"), ("arms", "int"),
          ("area", "real"), ("source", "text"), ("status", "text"), ("finding", "text"))
AXIS_FIELDS = (("road_id", "int"), ("kind", "text"), ("width", "real"), ("length", "real"))


class RoadModel(UrbanMapAlgorithm):
    ID = "roadmodel"
    NAME = "Road model"
    KEYWORDS = ("road", "PLATEAU", "CityGML", "LOD1", "junction", "intersection", "corner cut-off", "road edge")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")
    SOURCE = ("Project PLATEAU, standard product specification of 3D city models 5.0, 4.3, and its working procedure, "
              "annex D")
    HELP = (
        "Makes the road surfaces of PLATEAU's LOD1 from edges or surfaces of roads alone: cut at junctions, bridges "
        "and tunnels, with middle lines, findings and a CityGML file.\n"
        "Surfaces are dissolved and cut anew; lines along both edges are closed to surfaces, where two ends lie across "
        "a road from each other. A junction is where three or more roads meet. Its arms are cut as the working "
        "procedure says: at the ends of the corner cut-offs, else at the corners; with four or more arms from contact "
        "to contact, with three across the road at the outermost contact. Junctions that overlap are one.\n"
        "Surfaces share their edges to the bit. Heights are 0, as the specification asks of LOD1. What is doubtful is "
        "a finding with its place: arms without a corner, edges that do not close, surfaces that cross themselves."
    )

    def declare(self):
        self.add_vector("ROADS", "Edges or surfaces of roads", "Polygons of roads, which are dissolved, or lines along "
                        "both edges of roads, such as the GSI's road edges (RdEdg), in a projected CRS in metres.")
        self.add_polygons("BRIDGES", "Bridges", "Outlines of bridges and viaducts, in the CRS of the roads: surfaces "
                          "are cut there.", optional=True)
        self.add_polygons("TUNNELS", "Tunnels", "Outlines of tunnels, in the CRS of the roads: surfaces are cut "
                          "there.", optional=True)
        self.add_text("FUNCTION", "Code of the roads' function", "Of PLATEAU's list Road_function, for roads "
                      "that have no field function with one: 1 national expressway, 2 national road, 3 prefectural "
                      "road, 4 municipal road, 9000 not surveyed, 9020 unknown.", "9000")
        self.add_choice("MATERIAL", "Material of the edges", "What the edges are from, for the quality attributes of "
                        "CityGML.", MATERIALS, "other data")
        self.add_choice("MAP_LEVEL", "Map level of the edges", "Of the map that the edges are from, for the quality "
                        "attributes of CityGML.", MAP_LEVELS, MAP_LEVELS[0], advanced=True)
        self.add_text("DATA_DATE", "Date of the data", "Day on which the model was made, such as 2026-04-01; CityGML "
                      "has it as creationDate, which PLATEAU asks for.", "", advanced=True)
        line, point = QgsProcessing.SourceType.TypeVectorLine, QgsProcessing.SourceType.TypeVectorPoint
        self.add_layer_output("OUTPUT", "Road surfaces", "Polygons: road_id, kind (road, junction, bridge, tunnel), "
                              "function (code), width (mean, m), arms (roads that meet, of a junction), area (m²), "
                              "source (official), status (made, to look at), finding.")
        self.add_layer_output("OUTPUT_AXES", "Middle lines of roads", "Lines equally far from both edges: road_id of "
                              "their surface, kind, width and length (m).", optional=True, source_type=line,
                              by_default=True)
        self.add_layer_output("OUTPUT_FINDINGS", "Findings", "Points: kind and a sentence on what to look at.",
                              optional=True, source_type=point, by_default=True)
        self.add_folder_output("OUTPUT_CITYGML", "CityGML folder", "CityGML 2.0 with i-UR 3.2 as PLATEAU lays it out: "
                               "udx/tran by third meshes, with the lists of codes.", optional=True)
        self.add_file_output("OUTPUT_REPORT", "Report", "HTML report: verdict, figures, a map, pictures of the "
                             "junctions to look at, findings.", HTML_FILTER, optional=True)
        self.add_number_output("SURFACES", "Surfaces", "Number of surfaces.")
        self.add_number_output("JUNCTIONS", "Junctions", "Number of junctions.")
        self.add_number_output("FINDINGS", "Findings", "Number of findings.")

    def check(self, parameters, context):
        from ...urbanmap_qgis.roadspace.road_city import check_function

        source = self.parameterAsSource(parameters, "ROADS", context)
        if source is not None:
            self.require_projected("ROADS", source.sourceCrs())
        check_function(self.parameterAsString(parameters, "FUNCTION", context))
        day_of(self, parameters, context)

    def compute(self, parameters, context, feedback):
        from ...urbanmap_qgis.roadspace.road_city import known_functions
        from ...urbanmap_qgis.roadspace.road_model import Structures, build_road_model, with_functions
        from ...urbanmap_qgis.roadspace.road_surface import surface_of

        progress = self.progress(feedback)
        table = self.read_vector(parameters, "ROADS", context, progress.part(0.0, 0.05))
        structures = Structures(*(self._outlines(parameters, name, context, table) for name in ("BRIDGES", "TUNNELS")))
        surface = surface_of(table.geometries)
        built = build_road_model(surface, structures, progress=progress.part(0.1, 0.8))
        built = with_functions(built, table.geometries, known_functions(table.columns.get("function", ())))
        self._tell(built, progress)
        results = self._write_layers(parameters, context, built, table.crs)
        folder = self.output_path(parameters, "OUTPUT_CITYGML", context)
        if folder is not None:
            results["OUTPUT_CITYGML"] = self._write_citygml(parameters, context, folder, built, table, progress)
        report = self.output_path(parameters, "OUTPUT_REPORT", context)
        if report is not None:
            from .road_report import write_road_report

            write_road_report(report, built)
            results["OUTPUT_REPORT"] = str(report)
        return {**results, "SURFACES": len(built.pieces), "JUNCTIONS": built.count("junction"),
                "FINDINGS": len(built.findings)}

    def _outlines(self, parameters, name, context, roads):
        """Polygons of an optional layer in the CRS of the roads."""
        table = self.read_polygons(parameters, name, context)
        if table is None:
            return ()
        self.same_crs("ROADS", roads.crs, name, table.crs)
        return [shape for shape in table.geometries if shape is not None]

    def _write_layers(self, parameters, context, built, crs):
        import shapely

        function = self.parameterAsString(parameters, "FUNCTION", context)
        columns = {"road_id": list(range(1, len(built.pieces) + 1)),
                   **{name: [getattr(piece, name) for piece in built.pieces]
                      for name in ("kind", "width", "arms", "source", "status", "finding")},
                   "area": [piece.polygon.area for piece in built.pieces],
                   "function": [piece.function or function for piece in built.pieces]}
        results = {"OUTPUT": self.write_layer(
            parameters, "OUTPUT", context, make_fields(*FIELDS), columns, crs,
            [piece.polygon for piece in built.pieces], "Polygon", style="road_surfaces")}
        owners = [built.pieces[axis.piece] for axis in built.axes]
        lines = [shapely.linestrings(axis.points) for axis in built.axes]
        results["OUTPUT_AXES"] = self.write_layer(
            parameters, "OUTPUT_AXES", context, make_fields(*AXIS_FIELDS), {
                "road_id": [axis.piece + 1 for axis in built.axes], "kind": [owner.kind for owner in owners],
                "width": [owner.width for owner in owners], "length": [line.length for line in lines]},
            crs, lines, "LineString", style="road_axes")
        results["OUTPUT_FINDINGS"] = self.write_layer(
            parameters, "OUTPUT_FINDINGS", context, make_fields(("kind", "text"), ("text", "text")),
            {name: [getattr(one, name) for one in built.findings] for name in ("kind", "text")}, crs,
            [shapely.points(one.x, one.y) for one in built.findings], "Point", style="road_findings")
        return {name: place for name, place in results.items() if place}

    def _write_citygml(self, parameters, context, folder, built, table, progress):
        from ...urbanmap_qgis.roadspace.road_city import RoadDelivery, write_road_citygml

        level = self.parameterAsString(parameters, "MAP_LEVEL", context)
        delivery = RoadDelivery(function=self.parameterAsString(parameters, "FUNCTION", context),
                                material=self.parameterAsString(parameters, "MATERIAL", context),
                                map_level=int(level) if level.isdigit() else 0,
                                created=day_of(self, parameters, context))
        if not delivery.created:
            progress.warn(tr("{0} is not given: CityGML then has no creationDate, which PLATEAU asks for.").format(
                self.label_of("DATA_DATE")))
        write_road_citygml(folder, built, table.crs_wkt, delivery, progress.part(0.8, 0.95))
        return str(folder)

    def _tell(self, built, progress):
        for kind, count in sorted(Counter(piece.kind for piece in built.pieces).items()):
            progress.message(tr("{0}: {1}").format(tr(kind), count))
        for kind, count in sorted(Counter(one.kind for one in built.findings).items()):
            progress.warn(tr("{0}: {1}").format(tr(kind), count))
