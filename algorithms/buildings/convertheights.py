"""Heights of points, rasters and layers from one height system into another."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import LAZ_FILTER, tr
from ..framework.layers.crs import stated_wkt
from ..framework.layers.trajectories import GEOID_FILTER

PAIRS = (("POINTS", "OUTPUT_POINTS"), ("RASTER", "OUTPUT_RASTER"), ("LAYER", "OUTPUT_LAYER"))

HEIGHT_FIELDS = {"base", "ground", "top", "z_base", "z_top", "height_max"}
"""Fields of other steps that hold heights."""


class ConvertHeights(UrbanMapAlgorithm):
    """By a geoid model or a grid of corrections that the user gives."""

    ID = "convertheights"
    NAME = "Convert heights"
    HELP = (
        "Takes heights of point clouds, a raster or a layer from one height system into another, with a grid that you "
        "give: GSI's corrections between JGD2011 and JGD2024, or a geoid model.\n"
        "The result states its height system, and the change is told: its least, mean and largest. In Japan heights of "
        "JGD2024 (since April 2025) differ from JGD2011 by up to +57 and -67 cm; plane coordinates are the same."
    )
    SOURCE = "GSI, revision of heights in Japan of April 2025 (JGD2024)"
    KEYWORDS = ("height", "geoid", "JGD2011", "JGD2024", "orthometric", "ellipsoidal", "標高", "ジオイド", "標高改定")
    REQUIRES = ("numpy", "shapely", "pyproj", "rasterio", "laspy", "lazrs")

    def declare(self):
        self.add_points("POINTS", "Point clouds", "LAS, LAZ or COPC files; they become one.", optional=True)
        self.add_raster("RASTER", "Raster of heights", "Such as a ground elevation.", optional=True)
        self.add_vector("LAYER", "Layer with heights", "Features with z, such as building models.", optional=True)
        self.add_text("SOURCE_HEIGHTS", "Height system of the data", "JGD2000, JGD2011, JGD2024, ellipsoidal or the "
                      "EPSG code of a vertical system; needed where the data do not state it.")
        self.add_text("TARGET_HEIGHTS", "Height system of the result", "Likewise.", default="JGD2024", optional=False)
        self.add_file("GRID", "Grid", "Corrections (added to the older system's heights) or a geoid model: GSI's text "
                      "grid (.isg, .asc), GeoTIFF or GTX, in latitude and longitude, m.", GEOID_FILTER, optional=True)
        self.add_number("CHANGE", "One value", "Instead of a grid, one correction or geoid height for all places.",
                        None, -120.0, 120.0, unit="m", optional=True, advanced=True)
        self.add_boolean("REVERSE", "Against the grid", "The corrections of the grid lead from the result's system to "
                         "that of the data. Between JGD2000, JGD2011 and JGD2024 this is known and need not be said.",
                         advanced=True)
        self.add_file_output("OUTPUT_POINTS", "Point cloud", "With converted heights, all attributes kept.", LAZ_FILTER,
                             optional=True)
        self.add_raster_output("OUTPUT_RASTER", "Raster", "With converted heights.", optional=True)
        self.add_layer_output("OUTPUT_LAYER", "Layer", "The features with converted z. Heights in fields, such as base "
                              "or ground, stay as they are: a warning names them.", optional=True)
        self.add_number_output("LEAST", "Least change", "Of all heights.", "m")
        self.add_number_output("MEAN", "Mean change", "Of all heights.", "m")
        self.add_number_output("LARGEST", "Largest change", "Of all heights.", "m")

    def check(self, parameters, context):
        given = [pair for pair in PAIRS if parameters.get(pair[0])]
        if len(given) != 1 or not parameters.get(given[0][1]):
            raise InputError(tr("Give point clouds, a raster or a layer, one of them, and the output of that kind."))
        if bool(parameters.get("GRID")) == (parameters.get("CHANGE") is not None):
            raise InputError(tr("Give a grid, or one value in its place."))

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.io.conversion.geoid import Geoid, read_geoid
        from ...urbanmap_qgis.io.reference.height_systems import height_system

        path = self.input_path(parameters, "GRID", context)
        grid = read_geoid(path) if path else Geoid.constant(self.parameterAsDouble(parameters, "CHANGE", context))
        how = {"stated": height_system(self.parameterAsString(parameters, "SOURCE_HEIGHTS", context)),
               "target": height_system(self.parameterAsString(parameters, "TARGET_HEIGHTS", context)),
               "grid": grid, "reverse": self.parameterAsBool(parameters, "REVERSE", context)}
        name, output = next(pair for pair in PAIRS if parameters.get(pair[0]))
        convert = {"POINTS": self._points, "RASTER": self._raster, "LAYER": self._layer}[name]
        place, change = convert(parameters, context, progress, how)
        progress.message(tr("{0} heights changed by {1:+.3f} to {2:+.3f} m, {3:+.3f} m in the mean, into {4}").format(
            change.count, change.lowest, change.highest, change.mean, how["target"]))
        return {output: str(place), "LEAST": change.lowest, "MEAN": change.mean, "LARGEST": change.highest}

    def _points(self, parameters, context, progress, how):
        from ...urbanmap_qgis.io.conversion.height_conversion import convert_points

        place = self.output_path(parameters, "OUTPUT_POINTS", context)
        return place, convert_points(self.point_files(parameters, "POINTS", context), place, **how, progress=progress)

    def _raster(self, parameters, context, progress, how):
        from ...urbanmap_qgis.io.conversion.height_conversion import convert_raster

        place = self.output_layer_path(parameters, "OUTPUT_RASTER", context, style="ground")
        wkt = stated_wkt(self.parameterAsRasterLayer(parameters, "RASTER", context).crs())
        return place, convert_raster(self.raster_path(parameters, "RASTER", context), place, wkt, **how,
                                     progress=progress)

    def _layer(self, parameters, context, progress, how):
        from ...urbanmap_qgis.io.conversion.height_conversion import convert_geometries, height_conversion

        table = self.read_vector(parameters, "LAYER", context, progress)
        conversion = height_conversion(stated_wkt(table.crs), **how)
        geometries = convert_geometries(table.geometries, conversion)
        if not conversion.change.count:
            raise InputError(tr("{0}: no feature has heights (z); there is nothing to convert.").format(table.label))
        fields = sorted({item.name() for item in table.fields} & HEIGHT_FIELDS)
        if fields:
            progress.warn(tr("{0}: the fields {1} hold heights of before; compute them anew.").format(
                table.label, ", ".join(fields)))
        place = self.write_layer(parameters, "OUTPUT_LAYER", context, table.fields, table.columns, conversion.wkt,
                                 geometries, self._geometry_type(parameters, context), style="", progress=progress)
        return place["OUTPUT_LAYER"], conversion.change

    def _geometry_type(self, parameters, context) -> str:
        """Name of the layer's own type with z."""
        from qgis.core import QgsWkbTypes

        return QgsWkbTypes.displayString(QgsWkbTypes.addZ(
            self.parameterAsSource(parameters, "LAYER", context).wkbType()))
