"""urbanmap:comparemaps."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.roadmap import ComparisonSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import tr
from ..framework.layers.crs import crs_from
from ..framework.layers.layers import make_fields
from .comparison_report import write_comparison_report

OSM_FILTER = "Lanelet2 (*.osm)"
FIELDS = ("kind", "element", "before", "after", "length", "shift", "azimuth", "along", "across", "sigma",
          "significance", "old_id", "new_id")
SIDES = ("OLD", "NEW")
INPUTS = (("OLD", "Old map: Lanelet2 file", "Old map: lines", "Old map: areas", "Sigma of the old map"),
          ("NEW", "New map: Lanelet2 file", "New map: lines", "New map: areas", "Sigma of the new map"))


class CompareMaps(UrbanMapAlgorithm):
    ID = "comparemaps"
    NAME = "Compare lane maps"
    KEYWORDS = ("lane", "HD map", "vector map", "Lanelet2", "change detection", "difference", "update", "road")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")
    HELP = (
        "Compares a lane map with an older or foreign one: lines, stop lines, crosswalks and symbols that moved, were "
        "added, removed or painted otherwise, with places, shifts and how significant they are. Each map is a "
        "Lanelet2 file or layers: lines of “Lines from road markings” or bounds of “Lane map”, and areas.\n"
        "An offset of the whole map is found first and told once; elements are compared without it. A shift is told "
        "where it exceeds three times its sigma, which is that of both maps together; sigma of elements that state "
        "none is found from what did not change, and sigmas that are too small for what did not change are enlarged. "
        "Nothing is added or removed where the other map has no line of about the same course within 15 m: there it "
        "shows no road, unless an area is given that both show.\n"
        "How lines are cut, sampled and directed does not matter. Of a line only shifts to its side are seen. Two "
        "maps from line layers, or two from bounds, agree best: a double line is two lines in the first and one in the "
        "second."
    )

    def declare(self):
        for side, file, lines, areas, _ in INPUTS:
            self.add_file(side, file, "OSM file; or give lines.", OSM_FILTER, optional=True)
            self.add_vector(f"{side}_LINES", lines, "Lines with the field class, in place of a Lanelet2 file: marking "
                            "lines or bounds of lanes; colour, sigma and double are used where they are there.",
                            optional=True, kind="line")
            self.add_polygons(f"{side}_AREAS", areas, "Crosswalks and symbols of the map that is given as lines, with "
                              "the field class.", optional=True)
        self.add_polygons("AREA", "Area of both maps", "What both maps show: within it everything counts, also roads "
                          "that only one of them has; outside of it nothing is added or removed.", optional=True)
        self.add_settings(ComparisonSettings)
        for side, *_, sigma in INPUTS:
            self.add_distance(f"{side}_SIGMA", sigma, "Standard deviation of the places of elements that state none; "
                              "left empty, it is estimated.", None, 0.0001, 10.0, optional=True, advanced=True)
        self.add_layer_output("OUTPUT", "Changes", "Lines and outlines: kind (moved, added, removed, repainted, or "
                              "offset of the whole map, without geometry), element, before and after (class and "
                              "colour), length, shift, azimuth, along and across (m; across is to the left of the old "
                              "element), sigma, significance (shift over sigma), ids in both maps.", kind="line")
        self.add_report("HTML report: verdict, offset, table by kind and length, sigmas, map and list of the changes.")
        for name, label in (("MOVED", "Moved"), ("ADDED", "Added"), ("REMOVED", "Removed"),
                            ("REPAINTED", "Repainted")):
            self.add_number_output(name, label, "Number of such changes.")
        self.add_number_output("OFFSET_EAST", "Offset to the east", "Of the new map against the old one; 0 where it is "
                               "not significant.", "m")
        self.add_number_output("OFFSET_NORTH", "Offset to the north", "The same to the north.", "m")
        self.add_number_output("SAME", "Same length", "Of the old map's lines that are as they were.", "m")
        self.add_number_output("COMPARED", "Compared length", "Of the old map's lines where the new map shows the "
                               "road.", "m")

    def check(self, parameters, context):
        for side, label in (("OLD", tr("old map")), ("NEW", tr("new map"))):
            if bool(parameters.get(side)) == bool(parameters.get(f"{side}_LINES")):
                raise InputError(tr("Give the {0} either as Lanelet2 file or as lines.").format(label))
            if parameters.get(f"{side}_AREAS") and not parameters.get(f"{side}_LINES"):
                raise InputError(tr("{0}: areas go with a map that is given as lines.").format(
                    self.label_of(f"{side}_AREAS")))

    def work(self, parameters, context, progress):
        import numpy as np

        from ...urbanmap_qgis.roadmap.comparison.comparison_records import CHANGES
        from ...urbanmap_qgis.roadmap.comparison.comparison_tables import change_columns, change_shapes
        from ...urbanmap_qgis.roadmap.comparison.map_comparison import compare_maps

        maps, crs, crs_wkt = self._maps(parameters, context)
        sigmas = [self.parameterAsDouble(parameters, f"{side}_SIGMA", context)
                  if parameters.get(f"{side}_SIGMA") not in (None, "") else np.nan for side in SIDES]
        settings = self.settings(ComparisonSettings, parameters, context, old_sigma=sigmas[0], new_sigma=sigmas[1])
        found = compare_maps(*maps, settings, self._area(parameters, context, crs), progress.part(0.1, 0.9))
        for kind in CHANGES:
            progress.message(f"{tr(kind)}: {len(found.of(kind))}")
        results = self.write_layer(parameters, "OUTPUT", context, make_fields(*FIELDS, style="map_changes"),
                                   change_columns(found.changes), crs or crs_from(crs_wkt),
                                   change_shapes(found.changes), "LineString", style="map_changes",
                                   progress=progress.part(0.9, 1.0))
        results |= {kind.upper(): len(found.of(kind)) for kind in CHANGES}
        results |= write_comparison_report(self, parameters, context, found, maps, settings)
        taken = found.offset.significant
        return {**results, "OFFSET_EAST": found.offset.east if taken else 0.0,
                "OFFSET_NORTH": found.offset.north if taken else 0.0, "SAME": found.same, "COMPARED": found.compared}

    def _maps(self, parameters, context):
        """Elements of both maps, the layers' CRS or None, and that of Lanelet2 files as WKT."""
        from ...urbanmap_qgis.io.osm import read_osm
        from ...urbanmap_qgis.roadmap.comparison.map_elements import elements_of_lanelet2, map_crs

        files = {side: read_osm(path) for side in SIDES if (path := self.input_path(parameters, side, context))}
        tables = {side: self.read_vector(parameters, f"{side}_LINES", context) for side in SIDES if side not in files}
        for side, table in tables.items():
            self.require_projected(f"{side}_LINES", table.crs)
        if len(tables) == 2:
            self.same_crs("OLD_LINES", tables["OLD"].crs, "NEW_LINES", tables["NEW"].crs)
        crs = next((table.crs for table in tables.values()), None)
        wkt = next((table.crs_wkt for table in tables.values()), None)
        wkt = map_crs(list(files.values())) if wkt is None else wkt
        return [elements_of_lanelet2(files[side], wkt) if side in files
                else self._elements(parameters, context, side, tables[side]) for side in SIDES], crs, wkt

    def _elements(self, parameters, context, side, table):
        from ...urbanmap_qgis.roadmap.comparison.map_elements import elements_of_areas, elements_of_lines

        if "class" not in table.columns:
            raise InputError(tr("{0} has no field class; give marking lines or bounds of lanes.").format(table.label))
        areas = self.read_vector(parameters, f"{side}_AREAS", context)
        result = elements_of_lines(table.geometries, table.columns)
        if areas is None:
            return result
        self.same_crs(f"{side}_LINES", table.crs, f"{side}_AREAS", areas.crs)
        if "class" not in areas.columns:
            raise InputError(tr("{0} has no field class; give the areas of “Lines from road markings”.").format(
                areas.label))
        return result + elements_of_areas(areas.geometries, areas.columns)

    def _area(self, parameters, context, crs):
        from ...urbanmap_qgis.roadmap.comparison.map_elements import whole_area

        table = self.read_polygons(parameters, "AREA", context)
        if table is None:
            return None
        if crs is None:
            raise InputError(tr("{0}: an area goes with maps of which one is given as lines.").format(
                self.label_of("AREA")))
        self.same_crs("OLD_LINES" if parameters.get("OLD_LINES") else "NEW_LINES", crs, "AREA", table.crs)
        return whole_area(table.geometries)
