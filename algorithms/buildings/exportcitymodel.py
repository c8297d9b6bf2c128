"""urbanmap:exportcitymodel."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError, OutputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import CITY_MODEL_FILTER, CITYJSON_FILTER, tr
from ..framework.layers.building_layers import read_buildings
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import column
from ..framework.layers.trajectories import GEOID_FILTER
from .city_outputs import add_plateau_parameters, check_parquet, whole_model, write_files
from .loadcitymodel import LoadCityModel

CITYJSONSEQ_FILTER = "CityJSONSeq (*.city.jsonl *.jsonl)"
OWN_IDS = ("gml_id", "building_id")
"""Fields taken for the ids where none is named, the first that is there."""

FILES = ("OUTPUT_CITYJSON", "OUTPUT_CITYJSONSEQ", "OUTPUT_CITYGML", "OUTPUT_TILES")


class ExportCityModel(UrbanMapAlgorithm):
    ID = "exportcitymodel"
    NAME = "Export city model"
    KEYWORDS = ("CityJSON", "CityJSONSeq", "CityGML", "PLATEAU", "3D Tiles", "Cesium", "GeoParquet", "building", "LOD")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "cv2")
    HELP = (
        "Writes building models of any step as CityJSON, CityGML (in Japan as PLATEAU lays it out) and 3D Tiles.\n"
        "Each building has its levels of detail 0 (outline and roof outline), 1.2, 1.3 and 2.2 side by side, parts "
        "where they stand alone, all attributes of the layer, and figures: heights of its roofs, volumes, areas, "
        "storeys as estimated. A solid that is not closed is kept as surfaces, and the field “problems” says so."
    )

    def declare(self):
        self.add_polygons("BUILDINGS", "Building models", "MultiPolygonZ with all faces of each building, such as "
                          "those of “Building models”. Without it give a city model.", optional=True)
        self.add_file("CITY_MODEL", "City model", "CityGML (.gml, .zip) or CityJSON file instead of the layer: its "
                      "buildings are written with all that they hold, and nothing is added. Of CityGML roads, city "
                      "furniture and trees are written, too.", CITY_MODEL_FILTER, optional=True)
        self.add_from(LoadCityModel, "SOURCE_CRS")
        self.add_vector("SURFACES", "Surfaces", "Surfaces of “Building models”, for the roofs' ids and the types of "
                        "walls; without them types are told by the faces.", optional=True)
        self.add_file("TEXTURES", "Textured model", "CityJSON file of “Facade textures” of the same buildings: its "
                      "images go along.", CITYJSON_FILTER, optional=True)
        self.add_field("ID_FIELD", "Id field", "Field with the source's own ids. Without it gml_id or building_id is "
                       "taken.", "BUILDINGS")
        self.add_text("HEIGHTS", "Height system", "What heights count from, where the layer's CRS does not say it: "
                      "JGD2011, JGD2024, ellipsoidal or the EPSG code of a vertical system.", advanced=True)
        self.add_file("GEOID", "Geoid model", "GeoTIFF, GTX or text grid of GSI (.asc, .isg) of the geoid's heights "
                      "above the ellipsoid: 3D Tiles then have ellipsoidal heights, as globes want them.", GEOID_FILTER,
                      optional=True, advanced=True)
        self.add_number("GEOID_HEIGHT", "Height of the geoid", "One height above the ellipsoid for all places, instead "
                        "of a model.", None, -120.0, 120.0, unit="m", optional=True, advanced=True)
        add_plateau_parameters(self)
        self.add_text("DATA_DATE", "Date of the data", "Day on which the buildings were measured, such as 2026-04-01.",
                      advanced=True)
        self.add_text("TITLE", "Title", "Title of the data set.", "UrbanMap building models", advanced=True)
        self.add_layer_output("OUTPUT", "Buildings with figures", "The models with the fields of the layer, city_id, "
                              "ground_height, roof_min, roof_50, roof_70, roof_max (m above the ground), volume_lod12, "
                              "volume_lod13, volume_lod22 (m3), area_ground, area_roof_flat, area_roof_sloped, "
                              "area_outer_walls, area_party_walls (m2), storeys_estimated, data_date, problems. A name "
                              "ending in .parquet gives GeoParquet where GDAL has it.", optional=True, by_default=True,
                              solids=True)
        self.add_file_output("OUTPUT_CITYJSON", "CityJSON", "CityJSON 2.0 file.", CITYJSON_FILTER, optional=True)
        self.add_file_output("OUTPUT_CITYJSONSEQ", "CityJSONSeq", "CityJSON sequence, a line a building, for large "
                             "areas.", CITYJSONSEQ_FILTER, optional=True)
        self.add_folder_output("OUTPUT_CITYGML", "CityGML", "Folder of CityGML 2.0: in Japan udx/bldg with a file a "
                               "mesh, EPSG:6697, and codelists; elsewhere one file.", optional=True)
        self.add_folder_output("OUTPUT_TILES", "3D Tiles", "Folder with tileset.json and its tiles.", optional=True)
        self.add_number_output("BUILDINGS_WRITTEN", "Buildings", "Number of buildings.")
        self.add_number_output("NOT_CLOSED", "Not closed", "Buildings of which a solid is not closed or not valid.")

    def check(self, parameters, context):
        from ...urbanmap_qgis.citymodel.citygml.plateau import check_city_code
        from ...urbanmap_qgis.citymodel.citygml.writer import gml_folder_trouble
        from ...urbanmap_qgis.citymodel.tiles.tiles_writer import tiles_folder_trouble

        check_city_code(self.parameterAsString(parameters, "CITY_CODE", context))
        self.day_of(parameters, "DATA_DATE", context)
        check_parquet(self, parameters, "OUTPUT", context)
        if bool(parameters.get("BUILDINGS")) == bool(parameters.get("CITY_MODEL")):
            raise InputError(tr("Give either {0} or {1}.").format(self.label_of("BUILDINGS"),
                                                                  self.label_of("CITY_MODEL")))
        if not any(parameters.get(name) for name in ("OUTPUT", *FILES)):
            raise InputError(tr("No output is asked for; choose one."))
        if parameters.get("CITY_MODEL") and not any(parameters.get(name) for name in FILES):
            raise InputError(tr("A city model is written to other files only; for a layer use “Load city model”."))
        for name, trouble_of in (("OUTPUT_CITYGML", gml_folder_trouble), ("OUTPUT_TILES", tiles_folder_trouble)):
            folder = parameters.get(name) and self.parameterAsString(parameters, name, context)
            trouble = trouble_of(folder) if folder else ""
            if trouble:
                raise OutputError(trouble)

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.buildings.city_export import export_buildings
        from ...urbanmap_qgis.citymodel.cityjson.textured_faces import read_textured_faces

        if parameters.get("CITY_MODEL"):
            return self._converted(parameters, context, progress)
        table = read_buildings(self, parameters, "BUILDINGS", context, progress)
        reference = self._reference(parameters, context, table)
        textured = self.input_path(parameters, "TEXTURES", context)
        textures = read_textured_faces(textured) if textured else None
        date = self.day_of(parameters, "DATA_DATE", context)
        rows = [{name: values[row] for name, values in table.columns.items()} | ({"data_date": date} if date else {})
                for row in range(len(table))]
        lods = column(table, "lod") or [None] * len(table)
        result = export_buildings(self._ids(parameters, context, table), table.geometries, rows, lods,
                                  self._surfaces(parameters, context, table, progress), textures,
                                  progress.part(0.0, 0.6))
        self._tell(result, textures, progress)
        results = self._write_files(parameters, context, result, reference, textures, date, progress.part(0.6, 0.9))
        layer = self._write_layer(parameters, context, table, result, date, progress.part(0.9, 1.0))
        return {**layer, **results, "BUILDINGS_WRITTEN": len(result.objects),
                "NOT_CLOSED": sum(bool(item.problems) for item in result.objects)}

    def _reference(self, parameters, context, table):
        from ...urbanmap_qgis.citymodel.reference import city_reference
        from ..framework.layers.crs import stated_wkt

        return city_reference(stated_wkt(table.crs), self.parameterAsString(parameters, "HEIGHTS", context) or "")

    def _ids(self, parameters, context, table):
        """The source's ids, one a row."""
        name = self.parameterAsString(parameters, "ID_FIELD", context)
        found = [column(table, known) for known in ((name,) if name else OWN_IDS)]
        if name and found[0] is None:
            raise InputError(tr("{0}: there is no field {1}; choose one of the layer.").format(
                self.label_of("ID_FIELD"), name))
        return next((values for values in found if values is not None), table.ids.tolist())

    def _surfaces(self, parameters, context, table, progress):
        """Types and roofs of faces, and what was seen of them, where a layer of surfaces is given."""
        import shapely

        from ...urbanmap_qgis.buildings.city_export import SurfaceRows, known_remarks

        surfaces = self.read_vector(parameters, "SURFACES", context, progress)
        if surfaces is None:
            return None
        self.same_crs("SURFACES", surfaces.crs, "BUILDINGS", table.crs)
        kinds = column(surfaces, "surface_type")
        if kinds is None:
            raise InputError(tr("{0}: the field surface_type is missing; give the surfaces of “Building models”."
                                ).format(self.label_of("SURFACES")))
        present = [row for row, missing in enumerate(shapely.is_missing(surfaces.geometries)) if not missing]
        roofs = column(surfaces, "roof_id") or [None] * len(surfaces)
        said = {name: values for name in ("seen", "sigma") if (values := column(surfaces, name)) is not None}
        return SurfaceRows(surfaces.geometries[present], [kinds[row] for row in present],
                           [roofs[row] for row in present], known_remarks(said, present))

    def _tell(self, exported, textures, progress):
        """What the user should know of the models."""
        bare = sum(not any(part.shapes for part in item.objects()) for item in exported.objects)
        if bare == len(exported.objects):
            raise InputError(tr("{0}: no feature has faces with heights; give building models (MultiPolygonZ), such as "
                                "those of “Building models”.").format(self.label_of("BUILDINGS")))
        if bare:
            progress.message(tr("{0} of {1} buildings have no model and are written without a shape.").format(
                bare, len(exported.objects)))
        if exported.renamed:
            progress.warn(tr("{0} of {1} ids were empty or there more than once; they got a number.").format(
                exported.renamed, len(exported.objects)))
        flawed = sum(bool(item.problems) for item in exported.objects)
        if flawed:
            progress.warn(tr("{0} of {1} buildings have a solid that is not closed or not valid; it is written as "
                             "surfaces, and the field “problems” says why.").format(flawed, len(exported.objects)))
        if textures is not None and textures.missing:
            progress.warn(tr("{0} images of textures are missing ({1}); their faces have none.").format(
                len(textures.missing), ", ".join(textures.missing[:3])))
        if textures is not None and not exported.textured:
            progress.warn(tr("No face of {0} has a texture in {1}; check that both are of the same buildings.").format(
                self.label_of("BUILDINGS"), self.label_of("TEXTURES")))

    def _converted(self, parameters, context, progress):
        """The files of a city model that is one already."""
        from contextlib import ExitStack

        from ...urbanmap_qgis.citymodel.model import STREET_SPACE

        if parameters.get("OUTPUT"):
            progress.message(tr("{0} is not written from a city model; for a layer use “Load city model”.").format(
                self.label_of("OUTPUT")))
        with ExitStack() as stack:
            model = whole_model(self, parameters, context, stack, progress.part(0.0, 0.5))
            results = write_files(self, parameters, context, FILES, model, progress.part(0.5, 1.0))
        buildings = [item for item in model.buildings if item.type not in STREET_SPACE]
        return {**results, "BUILDINGS_WRITTEN": len(buildings),
                "NOT_CLOSED": sum(bool(item.problems) for item in buildings)}

    def _write_files(self, parameters, context, exported, reference, textures, date, progress):
        """The files that are wanted, by output name."""
        from ...urbanmap_qgis.citymodel.model import CityModel

        model = CityModel(reference, exported.objects, textures.images if textures is not None else {},
                          self.parameterAsString(parameters, "TITLE", context), date)
        return write_files(self, parameters, context, FILES, model, progress)

    def _write_layer(self, parameters, context, table, exported, date, progress):
        """The layer with the figures, where wanted."""
        from ...urbanmap_qgis.buildings.model_figures import FIGURES, figure_columns

        columns = {**table.columns, **figure_columns(exported.figures),
                   "city_id": [item.id for item in exported.objects],
                   "problems": ["; ".join(item.problems) for item in exported.objects],
                   "data_date": [date or None] * len(table)}
        fields = make_fields("city_id", *FIGURES, "data_date", "problems", base=table.fields)
        return self.write_layer(parameters, "OUTPUT", context, fields, columns, table.crs, table.geometries,
                                "MultiPolygonZ", "building_models", progress)
