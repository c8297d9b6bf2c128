"""City models of others as outlines, solids and surfaces that every step takes."""

from __future__ import annotations

from contextlib import ExitStack

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import CITY_MODEL_FILTER, tr
from ..framework.layers.crs import crs_name, wkt_of
from ..framework.layers.layers import make_fields, own_fields
from .city_outputs import given_source

COLUMNS = (("building_id", "text"), ("lod", "text"), ("ground", "real"), ("top", "real"), ("height", "real"),
           ("parts", "int"), ("note", "text"), ("attributes", "text"))
ROADS = (("road_id", "text"), ("lod", "text"), ("class", "text"), ("function", "text"), ("usage", "text"),
         ("section", "text"), ("width", "real"), ("note", "text"), ("attributes", "text"))
STREET_OBJECTS = (("object_id", "text"), ("kind", "text"), ("lod", "text"), ("class", "text"), ("function", "text"),
                  ("usage", "text"), ("species", "text"), ("ground", "real"), ("top", "real"), ("height", "real"),
                  ("note", "text"), ("attributes", "text"))
SURFACES = (("building_id", "text"), ("roof_id", "int"), ("surface_type", "text"))


class LoadCityModel(UrbanMapAlgorithm):
    """CityGML (PLATEAU) and CityJSON to layers."""

    ID = "loadcitymodel"
    NAME = "Load city model"
    HELP = (
        "Loads buildings of city models as outlines with heights and all attributes, and their solids and surfaces, "
        "for the other steps.\n"
        "CityGML as PLATEAU has it (.gml, .zip or its folder; roads where “Roads” is asked for, city furniture and "
        "trees where “Street objects” is; files of other things are passed over), CityJSON and CityJSONSeq are read, "
        "levels of detail 0 to 2. Codes get their meaning where the lists are beside the "
        "files. A building whose id is not its own, whose solid is not closed or whose parts cannot be read keeps its "
        "row; the field “note” says why. Nothing is read from the network."
    )
    SOURCE = "OGC 12-019 (CityGML 2.0), CityJSON 2.0.1"
    KEYWORDS = ("CityGML", "CityJSON", "CityJSONSeq", "PLATEAU", "LOD", "3D", "footprints", "建築物", "都市モデル")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj")

    def declare(self):
        self.add_file(
            "INPUT", "City model",
            "CityGML (.gml, or a .zip of them), CityJSON (.json) or CityJSONSeq (.jsonl). The path of a folder, such "
            "as that of a PLATEAU data set, can be typed here as well.",
            filter=CITY_MODEL_FILTER, optional=True)
        self.add_file(
            "INPUT_FOLDER", "Folder of city models",
            "All city models in this folder and its subfolders; instead of the file or beside it.", folder=True,
            optional=True)
        self.add_crs(
            "CRS", "Coordinate reference system",
            "Projected system of the result. If none is chosen, that of the model, or for degrees in Japan the zone of "
            "the Japan Plane Rectangular CS in which the first building lies.", optional=True)
        self.add_crs("SOURCE_CRS", "CRS of the city model", "Of files that name none, or one that is not known.",
                     optional=True, advanced=True)
        self.add_layer_output(
            "OUTPUT", "Buildings",
            "MultiPolygon outlines (footprint, else roof edge, else the plan of the solid) with building_id (the "
            "model's own id), lod (levels there are), ground and top (heights in m), height (m, measuredHeight where "
            "it is given), parts, note (what is wrong), attributes (all, as JSON), and simple attributes as fields.")
        self.add_layer_output(
            "OUTPUT_MODELS", "Building models",
            "MultiPolygonZ, one feature a building with all faces of its most detailed solid, as “Building models” "
            "writes them.", optional=True, solids=True)
        self.add_layer_output(
            "OUTPUT_SURFACES", "Surfaces", "PolygonZ, one feature a face, with building_id, roof_id and surface_type: "
            "roof, outer wall, inner wall, ground, overhang.", optional=True)
        self.add_layer_output(
            "OUTPUT_ROADS", "Roads",
            "MultiPolygon surfaces of the roads (tran:Road) of CityGML, of their plainest level of detail: road_id, "
            "lod, class, function, usage, section (code of the kind of section), width (m), note, attributes (all, as "
            "JSON).", optional=True)
        self.add_layer_output(
            "OUTPUT_OBJECTS", "Street objects",
            "MultiPolygonZ, city furniture and single trees (frn, veg) of CityGML, the faces of their most detailed "
            "level: object_id, kind (furniture, tree), lod, class, function, usage, species (codes), ground and top "
            "(m), height (m, as given, else of the faces), note, attributes (all, as JSON).", optional=True)
        self.add_number_output("BUILDINGS", "Number of buildings", "Number of buildings written.")
        self.add_number_output("PROBLEMS", "Buildings with a note", "Buildings in which something is wrong.")
        self.add_text_output("HEIGHTS", "Height system", "As the model says it: unknown, JGD2011, JGD2024, ...")

    def check(self, parameters, context):
        if not self.input_paths(parameters, context):
            raise InputError(tr("No file was given: choose a city model (.gml, .json, .jsonl, .zip) or a folder."))
        for name in ("CRS", "SOURCE_CRS"):
            if parameters.get(name) and not self.parameterAsCrs(parameters, name, context).isValid():
                raise InputError(tr("{0}: {1} is not known; choose another.").format(
                    self.label_of(name), parameters[name]))
        if parameters.get("CRS"):
            self.require_projected("CRS", self.parameterAsCrs(parameters, "CRS", context))

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.citymodel.city_sources import open_city_model, placed_model
        from ...urbanmap_qgis.citymodel.reading_notes import ReadingNotes
        from ...urbanmap_qgis.citymodel.tables.building_table import TableNotes, building_rows
        from ...urbanmap_qgis.citymodel.tables.road_table import RoadTable
        from ...urbanmap_qgis.citymodel.tables.street_table import StreetTable
        from ...urbanmap_qgis.citymodel.tables.table_store import TableStore

        reading, counts, sentences = ReadingNotes(), TableNotes(), []
        wanted = self.parameterAsCrs(parameters, "CRS", context)
        with ExitStack() as stack:
            model = open_city_model(self.input_paths(parameters, context), stack, reading,
                                    given_source(self, parameters, context), progress.part(0.0, 0.6),
                                    _modules(parameters))
            wkt, buildings, places = placed_model(model, wkt_of(wanted) or None, sentences)
            self.require_projected("CRS", wkt)
            store = stack.enter_context(TableStore(bool(parameters.get("OUTPUT_MODELS")),
                                                   bool(parameters.get("OUTPUT_SURFACES"))))
            roads, things = RoadTable(places, counts.unknown), StreetTable(places, counts.unknown)
            others = things.without_street_objects(roads.without_roads(buildings))
            for row in building_rows(others, places, counts):
                store.add(row)
            for sentence in sentences + reading.sentences():
                progress.warn(sentence)
            if (roads.outlines or things.models) and not counts.buildings:
                progress.warn(tr("The files hold roads or street objects and no building: the layer of buildings is "
                                 "empty."))
            if counts.with_problems:
                progress.warn(tr("{0} of {1} buildings have something wrong; the field “note” says what.").format(
                    counts.with_problems, counts.buildings))
            if counts.unknown:
                progress.message(tr("{0} values stand for “unknown” ({1}): their fields are empty, a height is top "
                                    "less ground.").format(sum(counts.unknown.values()), ", ".join(
                                        f"{name} {count}" for name, count in counts.unknown.most_common(6))))
            progress.message(tr("{0} buildings in {1}, heights: {2}").format(
                counts.buildings, crs_name(wkt), tr(model.reference.heights)))
            results = self._write(parameters, context, store, wkt, progress)
        if parameters.get("OUTPUT_ROADS"):
            results |= self.write_layer(
                parameters, "OUTPUT_ROADS", context, make_fields(*ROADS), roads.columns, wkt, roads.outlines,
                "MultiPolygon", "loaded_roads")
        if parameters.get("OUTPUT_OBJECTS"):
            results |= self.write_layer(
                parameters, "OUTPUT_OBJECTS", context, make_fields(*STREET_OBJECTS), things.columns, wkt,
                things.models, "MultiPolygonZ", "loaded_street_objects")
        return {**results, "BUILDINGS": counts.buildings, "PROBLEMS": counts.with_problems,
                "HEIGHTS": model.reference.heights}

    def _write(self, parameters, context, store, wkt, progress):
        """The layers that are wanted."""
        results = {}
        if parameters.get("OUTPUT_SURFACES"):
            results |= self.write_layer(
                parameters, "OUTPUT_SURFACES", context, make_fields(*SURFACES), store.surface_columns, wkt,
                store.surfaces, "PolygonZ", "building_surfaces", progress.part(0.6, 0.8))
        fields = make_fields(*COLUMNS)
        for item in own_fields(make_fields(*store.more_fields(name for name, _ in COLUMNS)))[1]:
            fields.append(item)  # attributes of the file: they keep their own words
        if parameters.get("OUTPUT_MODELS"):
            columns = {name: [store.columns[name][row] for row in store.modelled] for name in store.columns}
            results |= self.write_layer(
                parameters, "OUTPUT_MODELS", context, fields, columns, wkt, store.models, "MultiPolygonZ",
                "loaded_models", progress.part(0.8, 0.9))
        results |= self.write_layer(
            parameters, "OUTPUT", context, fields, store.columns or {name: [] for name, _ in COLUMNS}, wkt,
            store.outlines, "MultiPolygon",
            "loaded_buildings", progress.part(0.9, 1.0))
        return results


def _modules(parameters) -> frozenset[str]:
    """Modules of CityGML whose layers are asked for, besides the buildings."""
    from ...urbanmap_qgis.citymodel.citygml.reader import ROADS as ROAD_MODULES
    from ...urbanmap_qgis.citymodel.citygml.reader import STREET_THINGS

    asked = {"OUTPUT_ROADS": ROAD_MODULES, "OUTPUT_OBJECTS": STREET_THINGS}
    return frozenset().union(*(modules for name, modules in asked.items() if parameters.get(name)))
