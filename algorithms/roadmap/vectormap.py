"""urbanmap:vectormap."""

from __future__ import annotations

from collections import Counter

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.roadmap import MapSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from .driven_paths import add_street_objects, read_drives, with_photo
from .map_outputs import DATUMS, write_map_files, write_map_layers
from .map_report import write_map_report

TRAFFIC = ("auto", "left", "right")
PROJECTORS = ("TransverseMercator", "MGRS")
CLASSES = ("solid", "dashed", "stop line", "guiding strip", "road border", "virtual")
DIALECTS = ("lanelet2", "autoware")
OSM_FILTER = "Lanelet2 (*.osm)"
XODR_FILTER = "OpenDRIVE (*.xodr)"


class VectorMap(UrbanMapAlgorithm):
    ID = "vectormap"
    NAME = "Lane map"
    SOURCE = "Javanmardi, 6.2"
    KEYWORDS = ("lane", "HD map", "vector map", "Lanelet2", "OpenDRIVE", "Autoware", "automated driving", "road")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")
    HELP = (
        "Makes lanes of line work and drives: bounds shared with the lanes beside, centre lines, width, direction, "
        "successors, neighbours, stop lines and crosswalks; as layers, as Lanelet2 file with the tags that Autoware "
        "expects, and as OpenDRIVE file.\n"
        "Lines side by side are a road section. A lane is made between two lines at a lane's width, where a drive, an "
        "arrow or a stop line shows its direction, or a lane across a dashed line or across a yellow or double centre "
        "line does. Nothing else becomes a lane: strips without evidence, open ends, bounds that were not seen and "
        "ways that were driven outside all lanes are findings with a place.\n"
        "Through junctions a virtual lane is made where a drive shows it, and for movements that arrows, ends of "
        "lanes and the rule of the road allow; its evidence tells which. Traffic keeps to the side that the drives "
        "show, unless it is given. Trajectories must be corrected ones: an error of a metre puts a drive into the "
        "wrong lane."
    )

    def declare(self):
        self.add_vector("LINES", "Marking lines", "Lines of “Lines from road markings” (fields class, colour, width, "
                        "sigma, chain, partner; class alone is enough), in a projected CRS in metres; or bounds of an "
                        "earlier run that were edited by hand, whose ids are kept.", kind="line")
        self.add_polygons("AREAS", "Marking areas", "Crosswalks and arrows of “Lines from road markings” (fields "
                          "class, heading).", optional=True)
        self.add_vector("EDGES", "Road edges", "Lines of kerbs, road borders or rails, in the CRS of the lines: they "
                        "are bounds of lanes too.", optional=True, kind="line")
        self.add_raster("ORTHOPHOTO", "Orthophoto", "Image of the place with pixels of 0.15 m or finer, in the CRS of "
                        "the lines: edges of the road that its surface shows become bounds where no kerb was measured, "
                        "faint lines are looked for where the width of the lanes asks for one, and lines beyond the "
                        "edge of the road are left out. Findings tell each.", optional=True)
        self.add_files("TRAJECTORY", "Trajectories", "Corrected trajectories of drives in the CRS of the lines: they "
                       "show directions and ways through junctions.", optional=True)
        self.add_vector("ROADS", "Road axes", "Axes of roads of another map, in the CRS of the lines, with any of the "
                        "fields oneway, lanes and speed_limit or maxspeed as OpenStreetMap has them: they tell "
                        "directions where nothing else does, and speed limits.", optional=True, kind="line")
        self.add_vector("OBJECTS", "Street objects", "Points of “Street objects”, in the CRS of the lines: posts, "
                        "boards and signals go into the Lanelet2 and OpenDRIVE files, signals with the stop line above "
                        "whose lanes they hang.", optional=True, kind="point")
        self.add_vector("RAILS", "Guard rails", "Lines of guard rails of “Street objects”, in the CRS of the lines, "
                        "for the Lanelet2 and OpenDRIVE files.", optional=True, kind="line")
        self.add_settings(MapSettings)
        self.add_number("SPEED_LIMIT", "Speed limit", "Of lanes for which road axes tell none; left empty, they have "
                        "none.", None, 1.0, 200.0, unit="km/h", optional=True)
        self.add_choice("DIALECT", "Dialect of Lanelet2", "Of stop lines and crosswalks in the Lanelet2 file. lanelet2:"
                        " elements that every reader takes (traffic_sign, right_of_way); autoware: road_marking and "
                        "crosswalk, as Autoware asks, which other programs refuse without Autoware's extension.",
                        DIALECTS, "lanelet2", advanced=True)
        self.add_choice("PROJECTOR", "Projector", "Of the local coordinates in the Lanelet2 file, for Autoware.",
                        PROJECTORS, "TransverseMercator", advanced=True)
        self.add_choice("VERTICAL_DATUM", "Vertical datum", "Of the lines' heights, for Autoware's projector file.",
                        DATUMS, "not stated", advanced=True)
        self.add_layer_output("OUTPUT_LANES", "Lanes", "Polygons: lane_id, kind (lane, virtual), direction's evidence, "
                              "width and narrowest (m), turn, arrows, successors, left, right and opposite (ids of "
                              "neighbours), stop_lines and crosswalks (numbers), yields_to (lane_ids that have the way "
                              "before it, inferred), yields_by (why), confidence (of ways that no drive shows).",
                              kind="polygon")
        self.add_layer_output("OUTPUT_CENTRES", "Centre lines of lanes", "Lines in the direction of traffic: lane_id, "
                              "width (m).", optional=True, by_default=True, kind="line")
        self.add_layer_output("OUTPUT_BOUNDS", "Bounds of lanes", "Lines: bound_id, class, colour, width, sigma (m), "
                              "sigmas (m, at each vertex, growing with the distance to a line), double, unseen (m "
                              "without a line), lanes (number of lanes that have it).", kind="line")
        self.add_file_output("OUTPUT_LANELET2", "Lanelet2 file", "Lanes, intersections, stop lines and crosswalks with "
                             "the tags of Lanelet2 and Autoware.", OSM_FILTER, optional=True)
        self.add_file_output("OUTPUT_PROJECTOR", "Projector file", "Autoware's map_projector_info.yaml of the Lanelet2 "
                             "file.", "YAML (*.yaml)", optional=True)
        self.add_file_output("OUTPUT_OPENDRIVE", "OpenDRIVE file", "Roads, junctions, road marks, stop lines and "
                             "crosswalks as ASAM OpenDRIVE 1.7; coordinates are those of the CRS less the header's "
                             "offset.", XODR_FILTER, optional=True)
        self.add_layer_output("OUTPUT_FINDINGS", "Findings", "Points: kind and a sentence on what is missing or "
                              "contradicts.", optional=True, by_default=True, kind="point")
        self.add_report("HTML report: verdict, figures, pictures of the junctions and findings with their places.")
        self.add_number_output("LANES", "Lanes", "Number of lanes, virtual ones included.")
        self.add_number_output("LENGTH", "Length of lanes", "Of their centre lines, virtual ones not counted.", "m")
        self.add_number_output("FINDINGS", "Findings", "Number of findings.")

    def check(self, parameters, context):
        source = self.parameterAsSource(parameters, "LINES", context)
        if source is not None:
            self.require_projected("LINES", source.sourceCrs())

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.roadmap.bound_ids import bound_ids
        from ...urbanmap_qgis.roadmap.vector_map import build_vector_map

        table = self.read_vector(parameters, "LINES", context, progress.part(0.0, 0.05))
        lines = self._lines(table, "class")
        edges = self.read_vector(parameters, "EDGES", context)
        if edges is not None:
            self.same_crs("LINES", table.crs, "EDGES", edges.crs)
            lines += self._lines(edges, None)
        drives = read_drives(self, parameters, context, table.crs_wkt, progress)
        settings = self.settings(MapSettings, parameters, context)
        areas = self._areas(parameters, context, table)
        lines, seen = with_photo(self, parameters, context, table, lines, areas, settings, progress.part(0.05, 0.1))
        built = build_vector_map(lines, areas, drives, settings, progress.part(0.1, 0.8),
                                 self._axes(parameters, context, table))
        built.findings += seen
        add_street_objects(self, parameters, context, built, table)
        self._tell(built, lines, drives, progress)
        results = write_map_layers(self, parameters, context, built, table.crs, bound_ids(built, lines))
        results |= write_map_files(self, parameters, context, built, table.crs_wkt,
                                   self._limit(parameters, context), progress)
        results |= write_map_report(self, parameters, context, built, drives)
        results = {name: place for name, place in results.items() if place}
        return {**results, "LANES": len(built.lanes), "FINDINGS": len(built.findings), "LENGTH": built.driven_length()}

    def _lines(self, table, kind_field):
        """The core's lines of a table; without a field for the kind they are road borders."""
        from ...urbanmap_qgis.roadmap.map_records import lines_of

        if kind_field is not None and kind_field not in table.columns:
            raise InputError(tr("{0} has no field class; give the lines of “Lines from road markings”.").format(
                table.label))
        lines = lines_of(table.geometries, table.columns, kind_field)
        if len(table) and not lines:
            raise InputError(tr("{0}: none of the {1} features has a line; choose a line layer.").format(
                table.label, len(table)))
        if kind_field is not None and lines and not any(line.kind in CLASSES for line in lines):
            raise InputError(tr("{0}: the field class holds none of the words {1}; give the lines of “Lines from road "
                                "markings”, or write these words.").format(table.label, ", ".join(CLASSES)))
        return lines

    def _areas(self, parameters, context, lines):
        from ...urbanmap_qgis.roadmap.map_records import areas_of

        table = self.read_vector(parameters, "AREAS", context)  # a road without symbols has none
        if table is None:
            return []
        self.same_crs("LINES", lines.crs, "AREAS", table.crs)
        if not {"class", "heading"} <= set(table.columns):
            raise InputError(tr("{0} has no fields class and heading; give the areas of “Lines from road "
                                "markings”.").format(table.label))
        return areas_of(table.geometries, table.columns)

    def _axes(self, parameters, context, lines):
        from ...urbanmap_qgis.roadmap.lanes.road_axes import axes_of

        table = self.read_vector(parameters, "ROADS", context)
        if table is None:
            return []
        self.same_crs("LINES", lines.crs, "ROADS", table.crs)
        return axes_of(table.geometries, table.columns)

    def _limit(self, parameters, context):
        given = parameters.get("SPEED_LIMIT") not in (None, "")
        return self.parameterAsDouble(parameters, "SPEED_LIMIT", context) if given else None

    def _tell(self, built, lines, drives, progress):
        for kind, count in sorted(Counter(finding.kind for finding in built.findings).items()):
            progress.message(f"{tr(kind)}: {count}")
        if not drives:
            progress.warn(tr("Without trajectories only arrows and stop lines tell directions: most strips stay "
                             "findings, and ways through junctions are inferred."))
        if not lines:
            progress.warn(tr("There are no marking lines: no lane can be made."))
        elif drives and not any(lane.kind == "lane" for lane in built.lanes):
            progress.warn(tr("No lane was made: the drives run beside all lines; check that both are of one place, in "
                             "one CRS, and that the trajectories are corrected."))
