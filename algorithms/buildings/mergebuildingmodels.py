"""urbanmap:mergebuildingmodels."""

from __future__ import annotations

from contextlib import ExitStack

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.buildings import MergeSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import CITYJSON_FILTER, OBJ_FILTER, tr
from ..framework.layers.building_layers import add_gnss_walls, read_buildings, read_gnss_walls
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import BuildingNames, building_names, column, numbers
from ..framework.layers.overlays import add_orthophoto, orthophoto_pictures

_USABLE = ("ok", "partly seen")


class MergeBuildingModels(UrbanMapAlgorithm):
    ID = "mergebuildingmodels"
    NAME = "Merge building models with measured walls"
    SOURCE = "Javanmardi, 5.7"
    KEYWORDS = ("building", "model", "wall", "facade", "MMS", "ALS", "merge", "CityJSON")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "rasterio", "cv2")
    HELP = (
        "Joins building models from airborne scanning with walls measured from the street: below a height the walls "
        "lie where the survey found them, above it the models stay as they were.\n"
        "Walls move within stated limits and never into a neighbour. A roof that stands out over the measured wall "
        "stays, with a level underside; so does what stands out at the height. Walls that were not driven past stay "
        "and are marked; where satellites tell them (“Adjust walls by GNSS”), they move, weighed by their sigma.\n"
        "Every result is checked: closed, planar, oriented outwards, no self-intersection. A building that cannot be "
        "merged keeps its model and says why."
    )

    def declare(self):
        self.add_polygons("MODELS", "Building models", "MultiPolygonZ of “Building models”: level roofs, upright "
                          "walls. Without them give a CityJSON file.", optional=True)
        self.add_file("MODELS_CITYJSON", "Building models (CityJSON)", "CityJSON file with solids, in the coordinate "
                      "system of the walls, instead of the layer.", CITYJSON_FILTER, optional=True)
        self.add_polygons("WALLS", "Walls", "PolygonZ of “Walls from a mobile survey”. Walls of few points, rough "
                          "ones, those inside the outlines and what stands before facades are left out.")
        add_gnss_walls(self)
        self.add_settings(MergeSettings)
        self.add_workers()
        self.add_layer_output("OUTPUT", "Merged models", "MultiPolygonZ, one feature a building with all faces of its "
                              "solids; status, reason, valid, walls, walls_moved, measured (share of the walls' "
                              "length), mean_offset, max_offset, base, height (m), volume, volume_change (m3).",
                              solids=True)
        self.add_layer_output("OUTPUT_WALLS", "Walls of the models", "PolygonZ, one feature an outer wall below the "
                              "height, with what became of it: building_id, edge, status, note, wall (row of the "
                              "measured wall), length, offset (m), turn (degrees), seen (share), rmse, sigma (m).",
                              optional=True, by_default=True)
        self.add_file_output("OUTPUT_CITYJSON", "CityJSON", "CityJSON 2.0 file with the solids.", CITYJSON_FILTER,
                             optional=True)
        self.add_file_output("OUTPUT_MESH", "OBJ mesh", "Wavefront OBJ file, a group for each building.", OBJ_FILTER,
                             optional=True)
        add_orthophoto(self)
        self.add_report("What was merged and what not, and edges before and after over the orthophoto, as HTML.")
        self.add_number_output("BUILDINGS", "Buildings", "Number of models.")
        self.add_number_output("MERGED", "Merged", "Buildings with a wall that moved.")
        self.add_number_output("NOT_MERGED", "Not merged", "Buildings that could not be merged.")
        self.add_number_output("VALID", "Valid", "Buildings whose solids passed the check.")
        self.add_number_output("WALLS_MOVED", "Walls moved", "Outer walls that lie on measured ones now.")

    def check(self, parameters, context):
        given = [bool(parameters.get("MODELS")), bool(parameters.get("MODELS_CITYJSON"))]
        if sum(given) != 1:
            raise InputError(tr("Give the building models either as a layer or as a CityJSON file."))

    def work(self, parameters, context, progress):
        from ...urbanmap_qgis.buildings.merging.merge_stage import (
            MERGED,
            NOT_MERGED,
            edge_columns,
            merge_models,
            merged_columns,
        )

        walls_table = self.read_vector(parameters, "WALLS", context, progress)
        self.require_projected("WALLS", walls_table.crs)
        walls = self._walls(walls_table, progress)
        names, models, base_fields, base_columns = self._models(parameters, context, walls_table, progress)
        if walls and column(walls_table, "status") is None:
            raise InputError(tr("{0}: the walls have no field status, which tells how well each was measured; give the "
                                "result of “Walls from a mobile survey”.").format(walls_table.label))
        settings = self.settings(MergeSettings, parameters, context)
        satellites = read_gnss_walls(self, parameters, context, walls_table.crs, progress)
        with self.workers(parameters, context) as executor:
            merged = merge_models(names.numbers.tolist(), list(models), walls, settings, executor,
                                  progress.part(0.0, 0.85), satellites)
        columns, edges = merged_columns(merged), edge_columns(merged)
        left = sum(building.status == NOT_MERGED for building in merged)
        if left:
            progress.warn(tr("{0} of {1} buildings could not be merged and keep their models; the field “reason” tells "
                             "why.").format(left, len(merged)))
        with ExitStack() as unfinished:
            files = self._write_files(parameters, context, walls_table.crs, merged, columns, names,
                                      progress.part(0.85, 0.9), unfinished)
            layers = self._write_layers(parameters, context, walls_table.crs, merged, columns, edges,
                                        (base_fields, base_columns), names, progress.part(0.9, 1.0))
            layers.update(self._write_report(parameters, context, walls_table.crs, models, merged, (columns, edges),
                                             names))
        return {**layers, **files, "BUILDINGS": len(merged), "NOT_MERGED": left,
                "MERGED": sum(building.status == MERGED for building in merged),
                "VALID": sum(building.valid for building in merged), "WALLS_MOVED": sum(columns["walls_moved"])}

    def _walls(self, table, progress):
        """Usable measured walls of the layer."""
        import numpy as np
        import shapely

        from ...urbanmap_qgis.buildings.merging.wall_match import measured_wall
        empty = np.full(len(table), np.nan)
        rmse, sigma = numbers(table, "rmse"), numbers(table, "sigma")
        rmse, sigma = empty if rmse is None else rmse, empty if sigma is None else sigma
        points = column(table, "points") or [0] * len(table)
        status = column(table, "status") or [_USABLE[0]] * len(table)
        walls, flat = [], 0
        for row, geometry in enumerate(table.geometries):
            if geometry is None or status[row] not in _USABLE:
                continue
            if not geometry.has_z:
                raise InputError(tr("{0}: the walls have no heights; give the result of “Walls from a mobile survey”.")
                                 .format(table.label))
            for part in shapely.get_parts(geometry):
                wall = measured_wall(row, part, float(rmse[row]), float(sigma[row]), int(points[row] or 0)) \
                    if part.geom_type == "Polygon" else None
                flat += wall is None
                walls += [wall] if wall is not None else []
        if flat:
            progress.message(tr("{0} walls are no upright faces and are left out.").format(flat))
        return walls

    def _models(self, parameters, context, walls_table, progress):
        """Names, faces, fields and columns of the models."""
        path = self.input_path(parameters, "MODELS_CITYJSON", context)
        if path is not None:
            from ...urbanmap_qgis.buildings.merging.model_files import models_from_cityjson

            ids, models, names = models_from_cityjson(path)
            return BuildingNames(ids), models, make_fields(("object_id", "text")), {"object_id": names}
        table = read_buildings(self, parameters, "MODELS", context, progress)
        self.same_crs("MODELS", table.crs, "WALLS", walls_table.crs)
        return building_names(table), table.geometries, table.fields, table.columns

    def _write_layers(self, parameters, context, crs, merged, columns, edges, base, names, progress):
        from ...urbanmap_qgis.geometry.solid import multipolygon

        results = {}
        if parameters.get("OUTPUT_WALLS"):
            results |= self.write_layer(
                parameters, "OUTPUT_WALLS", context, None, edges, crs,
                [edge.wall for building in merged for edge in building.edges], "PolygonZ", "merged_walls",
                progress.part(0.0, 0.5), names)
        shapes = [multipolygon(building.solids) if building.solids else None for building in merged]
        fields, carried = base
        results |= self.write_layer(
            parameters, "OUTPUT", context, make_fields(*columns, base=fields), {**carried, **columns}, crs,
            shapes, "MultiPolygonZ", "merged_models", progress.part(0.5, 1.0), names)
        return results

    def _write_report(self, parameters, context, crs, models, merged, tables, names):
        """The report, where it is wanted."""
        path = self.output_path(parameters, "OUTPUT_REPORT", context)
        if path is None:
            return {}
        from ...urbanmap_qgis.buildings.merging.merge_report import write_merge_report
        from ...urbanmap_qgis.geometry.solid import multipolygon

        shapes = [multipolygon(building.solids) if building.solids else None for building in merged]
        write_merge_report(path, merged, *tables, [names.of(building.building_id) for building in merged],
                           orthophoto_pictures(self, parameters, context, crs, "WALLS", models, shapes))
        return {"OUTPUT_REPORT": str(path)}

    def _write_files(self, parameters, context, crs, merged, columns, names, progress, unfinished):
        """CityJSON and OBJ, where wanted; the CityJSON takes its place when `unfinished` is closed."""
        from ...urbanmap_qgis.citymodel.cityjson.writer import write_model_cityjson
        from ...urbanmap_qgis.citymodel.model import CityModel, CityReference
        from ...urbanmap_qgis.citymodel.obj import write_obj
        from ...urbanmap_qgis.io.files.atomic import written_beside

        results = {}
        path = self.output_path(parameters, "OUTPUT_CITYJSON", context)
        if path is not None:
            code = crs.authid().removeprefix("EPSG:")
            model = CityModel(CityReference(epsg=int(code) if code.isdigit() else None),
                              city_buildings(merged, columns, names), title="UrbanMap merged building models")
            write_model_cityjson(unfinished.enter_context(written_beside(path)), model, progress)
            results["OUTPUT_CITYJSON"] = str(path)
        results |= self.write_file(parameters, "OUTPUT_MESH", context, write_obj,
                                   city_buildings(merged, columns, names), progress=progress)
        return results


def city_buildings(merged, columns, names):
    """The merged models with their figures as the writers of files take them, one after another."""
    from ...urbanmap_qgis.citymodel.solids import solid_object

    for row, building in enumerate(merged):
        attributes = {name: values[row] for name, values in names.columns(columns).items()}
        yield solid_object(names.of(building.building_id), attributes, building.solids)
