"""urbanmap:roadmodel."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.layers import make_fields
from .streetobjects import StreetObjects, creation_day
from .surveyed_model import compute_surveyed, tell_kinds, write_no_areas

# QGIS takes whole numbers for places in this list: 1 and 2 stand at theirs.
LEVELS, FROM_ROADS, FINEST = ("3.3", "1", "2", "3.0", "3.1", "3.2", "finest"), "1", "finest"

MAP_LEVELS = ("none", "500", "1000", "2500", "5000")
MATERIALS = ("GSI fundamental data", "digital topographic map", "other data")
FIELDS = ("road_id", "kind", "function", "width", "arms", "area", ("source", "text"), "status", "finding")


class RoadModel(UrbanMapAlgorithm):
    ID = "roadmodel"
    NAME = "Road model"
    KEYWORDS = ("road", "PLATEAU", "CityGML", "LOD1", "junction", "intersection", "corner cut-off", "road edge")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")
    SOURCE = ("Project PLATEAU, standard product specification of 3D city models 5.0, 4.3, and its working procedure, "
              "annex D")
    HELP = (
        "Makes road models as PLATEAU defines them. LOD1 comes from edges or surfaces of roads alone: cut at "
        "junctions, bridges and tunnels, with middle lines, findings and a CityGML file. LOD2 and LOD3.0 to 3.3 come "
        "from the edges that a survey measured: carriageways, junctions cut at the extension of stop lines (from 3.1; "
        "else at corners), lanes (from 3.1), sidewalks, islands; with steps from 15 cm (3.2) or 2 cm (3.3) as faces. "
        "What the survey did not see is never made up: it is drawn on over short gaps and told, left undivided where "
        "only the given roads show it, and each area says its source.\n"
        "Surfaces are dissolved and cut anew; lines along both edges are closed to surfaces, where two ends lie across "
        "a road from each other. A junction is where three or more roads meet. Its arms are cut as the working "
        "procedure says: at the ends of the corner cut-offs, else at the corners; with four or more arms from contact "
        "to contact, with three across the road at the outermost contact. Junctions that overlap are one.\n"
        "Surfaces share their edges to the bit. Heights are 0, as the specification asks of LOD1. What is doubtful is "
        "a finding with its place: arms without a corner, edges that do not close, surfaces that cross themselves."
    )

    def declare(self):
        self.add_vector("ROADS", "Edges or surfaces of roads", "Polygons of roads, which are dissolved, or lines along "
                        "both edges of roads, such as the GSI's road edges (RdEdg), in a projected CRS in metres. LOD1 "
                        "is made of them; for finer levels they tell where sidewalks end.", optional=True)
        self.add_choice("LOD", "Level of detail", "1 of the roads given, 2 and finer of measured edges: 2 without "
                        "heights; 3.0 with one height across; 3.1 also with lanes and cuts at stop lines; 3.2 with "
                        "steps from 15 cm; 3.3 with steps from 2 cm; finest: 3.3 where measured edges are given, "
                        "else 1.", LEVELS, FINEST)
        self.add_vector("EDGES", "Measured edges", "Lines of “Road edges”; needed for LOD2 and finer.", optional=True,
                        kind="line")
        self.add_vector("TOPS", "Upper edges", "Upper edges of “Road edges”: heights of steps by place. Without them a "
                        "kerb has its median height all along.", optional=True, kind="line")
        self.add_polygons("LANES", "Lanes", "Lanes of “Lane map”; where one edge of a road was seen, they tell how far "
                          "its carriageway goes.", optional=True)
        self.add_vector("STOP_LINES", "Stop lines", "Lines of “Lines from road markings”, of which the stop lines are "
                        "taken, or a layer of stop lines.", optional=True, kind="line")
        self.add_raster("GROUND", "Ground elevation", "Heights in metres of what lies more than half a metre from "
                        "kerbs; without it they come from the edges about.", optional=True)
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
        self.add_from(StreetObjects, "DATA_DATE")
        self.add_layer_output("OUTPUT", "Road surfaces", "Polygons: road_id, kind (road, junction, bridge, tunnel), "
                              "function (code), width (mean, m), arms (roads that meet, of a junction), area (m²), "
                              "source (official, measured), status (made, to look at), finding.")
        self.add_layer_output("OUTPUT_AREAS", "Areas of roads", "PolygonZ, of LOD2 and finer: area_id, road_id of its "
                              "surface, kind (carriageway, junction, lane, sidewalk, island; road, not surveyed), "
                              "function (code), width (m), area (m²), source (measured, doubtful, continued, "
                              "official: the weakest of its border), seen (share of the border measured as a kerb "
                              "without doubt), step (highest, m), sigma (m).", optional=True, by_default=True)
        self.add_layer_output("OUTPUT_STEPS", "Steps", "LineStringZ along the upper edge of each face: area_id, "
                              "height, length (m); of LOD3.2 and 3.3.", optional=True, kind="line")
        self.add_layer_output("OUTPUT_AXES", "Middle lines of roads", "Lines equally far from both edges: road_id of "
                              "their surface, kind, width and length (m).", optional=True, by_default=True, kind="line")
        self.add_layer_output("OUTPUT_FINDINGS", "Findings", "Points: kind and a sentence on what to look at.",
                              optional=True, by_default=True, kind="point")
        self.add_folder_output("OUTPUT_CITYGML", "CityGML folder", "CityGML 2.0 with i-UR 3.2 as PLATEAU lays it out: "
                               "udx/tran by third meshes, with the lists of codes.", optional=True)
        self.add_report("HTML report: verdict, figures, a map, pictures of the junctions to look at, findings.")
        self.add_number_output("SURFACES", "Surfaces", "Number of surfaces.")
        self.add_number_output("JUNCTIONS", "Junctions", "Number of junctions.")
        self.add_number_output("FINDINGS", "Findings", "Number of findings.")

    def level(self, parameters, context):
        """The level of detail: what was asked for, or the finest that the inputs allow."""
        level = self.parameterAsString(parameters, "LOD", context)
        if level != FINEST:
            return level
        return FROM_ROADS if parameters.get("EDGES") in (None, "") else LEVELS[0]

    def check(self, parameters, context):
        from ...urbanmap_qgis.roadspace.road_city import check_function

        surveyed = self.level(parameters, context) != FROM_ROADS
        needed = "EDGES" if surveyed else "ROADS"
        if parameters.get(needed) in (None, ""):
            raise InputError(tr("{0} is not given: it is what this level of detail is made of.").format(
                self.label_of(needed)))
        for name in ("ROADS", "EDGES"):
            source = self.parameterAsSource(parameters, name, context)
            if source is not None:
                self.require_projected(name, source.sourceCrs())
        check_function(self.parameterAsString(parameters, "FUNCTION", context))
        self.day_of(parameters, "DATA_DATE", context)

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.roadspace.road_city import known_functions
        from ...urbanmap_qgis.roadspace.road_model import Structures, build_road_model, with_functions
        from ...urbanmap_qgis.roadspace.road_surface import surface_of
        from .road_report import write_road_report

        if self.level(parameters, context) != FROM_ROADS:
            return compute_surveyed(self, parameters, context, progress)
        table = self.read_vector(parameters, "ROADS", context, progress.part(0.0, 0.05))
        structures = Structures(*(self._outlines(parameters, name, context, table) for name in ("BRIDGES", "TUNNELS")))
        surface = surface_of(table.geometries)
        built = build_road_model(surface, structures, progress=progress.part(0.1, 0.8))
        built = with_functions(built, table.geometries, known_functions(table.columns.get("function", ())))
        tell_kinds(built.pieces, progress)
        tell_kinds(built.findings, progress)
        results = {**self.write_road_layers(parameters, context, built, table.crs),
                   **write_no_areas(self, parameters, context, table.crs)}
        folder = self.output_path(parameters, "OUTPUT_CITYGML", context)
        if folder is not None:
            results["OUTPUT_CITYGML"] = self._write_citygml(parameters, context, folder, built, table, progress)
        results |= self.write_file(parameters, "OUTPUT_REPORT", context, write_road_report, built)
        return {**results, "SURFACES": len(built.pieces), "JUNCTIONS": built.count("junction"),
                "FINDINGS": len(built.findings)}

    def _outlines(self, parameters, name, context, roads):
        """Polygons of an optional layer in the CRS of the roads."""
        table = self.read_polygons(parameters, name, context)
        if table is None:
            return ()
        self.same_crs("ROADS", roads.crs, name, table.crs)
        return [shape for shape in table.geometries if shape is not None]

    def write_road_layers(self, parameters, context, built, crs):
        import shapely

        function = self.parameterAsString(parameters, "FUNCTION", context)
        columns = {"road_id": list(range(1, len(built.pieces) + 1)),
                   **{name: [getattr(piece, name) for piece in built.pieces]
                      for name in ("kind", "width", "arms", "source", "status", "finding")},
                   "area": [piece.polygon.area for piece in built.pieces],
                   "function": [piece.function or function for piece in built.pieces]}
        results = self.write_layer(
            parameters, "OUTPUT", context, make_fields(*FIELDS), columns, crs,
            [piece.polygon for piece in built.pieces], "Polygon", style="road_surfaces")
        owners = [built.pieces[axis.piece] for axis in built.axes]
        lines = [shapely.linestrings(axis.points) for axis in built.axes]
        results |= self.write_layer(
            parameters, "OUTPUT_AXES", context, None, {
                "road_id": [axis.piece + 1 for axis in built.axes], "kind": [owner.kind for owner in owners],
                "width": [owner.width for owner in owners], "length": [line.length for line in lines]},
            crs, lines, "LineString", style="road_axes")
        results |= self.write_layer(
            parameters, "OUTPUT_FINDINGS", context, None,
            {name: [getattr(one, name) for one in built.findings] for name in ("kind", "text")}, crs,
            [shapely.points(one.x, one.y) for one in built.findings], "Point", style="road_findings")
        return results

    def _write_citygml(self, parameters, context, folder, built, table, progress):
        from ...urbanmap_qgis.roadspace.road_city import write_road_citygml

        delivery = self.delivery(parameters, context, progress)
        write_road_citygml(folder, built, table.crs_wkt, delivery, progress.part(0.8, 0.95))
        return str(folder)

    def delivery(self, parameters, context, progress):
        """What holds for all roads in CityGML."""
        from ...urbanmap_qgis.roadspace.road_city import RoadDelivery

        level = self.parameterAsString(parameters, "MAP_LEVEL", context)
        return RoadDelivery(function=self.parameterAsString(parameters, "FUNCTION", context),
                            material=self.parameterAsString(parameters, "MATERIAL", context),
                            map_level=int(level) if level.isdigit() else 0,
                            created=creation_day(self, parameters, context, progress))
