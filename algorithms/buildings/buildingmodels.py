"""urbanmap:buildingmodels."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import replace
from itertools import chain

from ...urbanmap_qgis.settings.buildings import LEVELS, PLANES
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import CITYJSON_FILTER, tr
from ..framework.layers.crs import stated_wkt
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import building_names, building_numbers, column, footprints_of, numbers, open_points
from ..framework.layers.reprojection import ground_heights, with_heights_of_points
from .mesh25d import Mesh25D, meshes_beside


class BuildingModels(UrbanMapAlgorithm):
    ID = "buildingmodels"
    NAME = "Building models"
    SOURCE = "Javanmardi, 5.3.4"
    KEYWORDS = ("building", "3D", "solid", "LOD1", "CityJSON", "OBJ", "model")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs")
    HELP = (
        "Joins roof polygons at their heights to closed solids that stand on the ground.\n"
        "Each solid is checked: closed, planar, oriented outwards, no self-intersection. Where points are given, "
        "every building carries how well its model fits them. A building that cannot be modelled keeps its row, "
        "with the reason in words."
    )

    def declare(self):
        self.add_polygons("ROOFS", "Roof polygons", "Polygons from “Roof polygons” with the fields building_id, "
                          "roof_id and height (m).")
        self.add_polygons("FOOTPRINTS", "Buildings", "Outlines from “Segment buildings”. Each gets a row in the "
                          "result. A field ground gives the height of the ground in metres.")
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres; the lowest along an outline "
                        "is the base of its walls.", optional=True)
        self.add_field("BASE_FIELD", "Base height field", "Field of the buildings with the height of the "
                       "base of the walls in metres; used where there is no ground elevation.", "FOOTPRINTS",
                       advanced=True)
        self.add_points("POINTS", "Roof points", "Points with building_id and roof_id, from “Segment roofs”, for the "
                        "figures of fit.", optional=True)
        self.add_choice("ROOF_SHAPE", "Roofs", "planes: roofs as the polygons' heights have them (LoD2.2 where any is "
                        "sloped); levels: every roof at its one height (LoD1.3).", (PLANES, LEVELS), PLANES)
        self.add_workers()
        self.add_text("NOTE", "Note for the report", "Text that the report shows with its settings, such as the name "
                      "of the project.", advanced=True)
        self.add_layer_output("OUTPUT", "Building models", "MultiPolygonZ, one feature a building with all faces of "
                              "its solids; status, reason, roofs, base, height (m), area (m2), volume (m3), points, "
                              "density (points a m2), rmse_z, rmse_z95, median_dz, rmse_3d, p95 (m), coverage, "
                              "unseen, beyond (shares), lod, roof_type, not_explained (share of the points that can be "
                              "roof and lie far from the model), quality (0 to 1), roof_min, roof_50, roof_70, "
                              "roof_max (m above the ground), volume_lod12, volume_lod13, volume_lod22 (m3), "
                              "area_roof_flat, area_roof_sloped (m2), storeys_estimated.", solids=True)
        self.add_layer_output("OUTPUT_SURFACES", "Surfaces", "MultiPolygonZ, one feature a surface, with building_id, "
                              "roof_id and surface_type: roof, outer wall, inner wall, ground; of roofs seen (share "
                              "that the points have seen) and sigma (expected error of its height, m).", optional=True)
        self.add_file_output("OUTPUT_CITYJSON", "CityJSON", "CityJSON 2.0 file with outlines and solids at the levels "
                             "of detail 0, 1.2, 1.3 and 2.2, surface types, the fields of the outlines and the figures "
                             "of each building.", CITYJSON_FILTER, optional=True)
        self.add_from(Mesh25D, "OUTPUT_MESH")
        self.add_report("HTML report: counts, quality, the worst buildings with reasons.")
        self.add_from(Mesh25D, optional=True, by_default=False, label="2.5D meshes", OUTPUT_MESHES="OUTPUT")
        self.add_number_output("BUILDINGS", "Buildings", "Number of outlines.")
        self.add_number_output("MODELLED", "Modelled", "Buildings with a model.")
        self.add_number_output("RMSE_Z95", "Mean RMSE of height, best 95 %", "Mean over the buildings, where points "
                               "were given.", "m")

    def compute(self, parameters, context, feedback):
        import numpy as np

        from ...urbanmap_qgis.buildings.model_stage import build_models
        from ...urbanmap_qgis.buildings.model_status import GROUND_UNKNOWN, OK
        from ...urbanmap_qgis.buildings.model_table import model_columns
        from ...urbanmap_qgis.buildings.seen.cloud_cover import CloudCover
        from ...urbanmap_qgis.citymodel.obj import write_obj

        progress = self.progress(feedback)
        buildings = self.read_polygons(parameters, "FOOTPRINTS", context, progress)
        footprints = footprints_of(buildings, progress)
        roof_table = self._roof_table(parameters, context, progress)
        self.same_crs("ROOFS", roof_table.crs, "FOOTPRINTS", buildings.crs)
        cloud = open_points(self, parameters, context, buildings, progress, may_be_empty=True)
        buildings = with_heights_of_points(buildings, cloud, progress)
        base = self._base_heights(parameters, context, buildings, footprints, progress)
        with self.workers(parameters, context) as executor:
            models = build_models(footprints, self._roofs(roof_table), base, cloud, executor, progress.part(0.0, 0.85),
                                  self.parameterAsString(parameters, "ROOF_SHAPE", context),
                                  numbers(buildings, "open_share"),
                                  CloudCover.of(*(numbers(buildings, name) for name in ("cloud_density", "beyond"))))
        columns = model_columns(models)
        modelled = sum(bool(model.solids) for model in models)
        if modelled < len(models):
            progress.warn(tr("{0} of {1} buildings have no model; the field “reason” says why.").format(
                len(models) - modelled, len(models)))
        assumed = sum(bool(model.base_source) for model in models)
        if assumed:
            progress.warn(tr("{0} of {1} buildings ({2} %) have no ground under them: their bases are taken from "
                             "neighbours or assumed; give a ground elevation or a field with the base height.").format(
                                 assumed, len(models), round(100 * assumed / len(models))))
        doubtful = sum(bool(model.solids) and model.status not in (OK, GROUND_UNKNOWN) for model in models)
        if doubtful:
            progress.warn(tr("{0} of {1} models have a flaw; the fields “status” and “reason” say which.").format(
                doubtful, modelled))
        figures = np.array(columns["rmse_z95"], float)
        with ExitStack() as unfinished:
            files = self._write_files(parameters, context, buildings, models, columns, progress.part(0.85, 0.9),
                                      unfinished)
            progress.step(0.9)
            layers = self._write_layers(parameters, context, buildings, models, columns, progress.part(0.9, 1.0))
            if "OUTPUT_MESH" in files:
                # Not with the other files: the mesh names its file of materials, so that it cannot be renamed.
                write_obj(files["OUTPUT_MESH"], city_buildings(models, columns, building_names(buildings)))
        return {
            **layers, **files, **meshes_beside(self, parameters, context, feedback),
            "BUILDINGS": len(models), "MODELLED": modelled,
            "RMSE_Z95": float(np.nanmean(figures)) if np.isfinite(figures).any() else None,
        }

    def _roof_table(self, parameters, context, progress):
        """The layer of roofs, which has none where no building has one."""
        source = self.parameterAsSource(parameters, "ROOFS", context)
        if source is not None and source.featureCount() == 0:
            return self.read_vector(parameters, "ROOFS", context, progress)
        return self.read_polygons(parameters, "ROOFS", context, progress)

    def _roofs(self, table):
        """Roof polygons with their heights, for the core."""
        import numpy as np
        import shapely

        from ...urbanmap_qgis.buildings.building_model import RoofInput
        from ...urbanmap_qgis.errors import InputError

        found = {"building_id": building_numbers(table),
                 **{name: numbers(table, name) for name in ("roof_id", "height")}}
        for name, values in found.items():
            if values is None or not np.isfinite(values).all():
                raise InputError(tr("{0}: the field {1} is missing or has empty values; give the result of “Roof "
                                    "polygons”.").format(self.label_of("ROOFS"), name))
        status = np.array(column(table, "status") or [""] * len(table), dtype=object)
        present = ~shapely.is_missing(table.geometries)
        return RoofInput(table.geometries[present], found["building_id"].astype(np.int64)[present],
                         found["roof_id"].astype(np.int64)[present], found["height"][present], status[present])

    def _base_heights(self, parameters, context, table, footprints, progress):
        """Base of each building: from the raster, else a field, NaN where neither knows."""
        import numpy as np

        from ...urbanmap_qgis.buildings.base_height import outline_ground

        base = np.full(len(footprints), np.nan)
        ground = ground_heights(self, parameters, context, table, progress)
        if ground is not None:
            base = outline_ground(footprints.polygons, *ground)
        for name in (self.parameterAsString(parameters, "BASE_FIELD", context), "ground"):
            values = numbers(table, name) if name else None
            if values is not None:
                base = np.where(np.isfinite(base), base, values)
        return base

    def _write_layers(self, parameters, context, table, models, columns, progress):
        """The layer of buildings and, where wanted, that of surfaces."""
        from ...urbanmap_qgis.buildings.model_table import surface_columns
        from ...urbanmap_qgis.geometry.solid import multipolygon, surfaces

        results = {}
        if parameters.get("OUTPUT_SURFACES"):
            faces = [surfaces(solid) for model in models for solid in model.solids]
            results |= self.write_layer(
                parameters, "OUTPUT_SURFACES", context, None, surface_columns(models), table.crs,
                [*chain.from_iterable(faces)], "PolygonZ", "building_surfaces", progress, building_names(table))
        shapes = [multipolygon(model.solids) if model.solids else None for model in models]
        # Once the surfaces are in their place the rest follows, cancelled or not: no mixture of old and new results.
        last = replace(progress, cancelled=lambda: False) if results else progress
        results |= self.write_layer(
            parameters, "OUTPUT", context, make_fields(*columns, base=table.fields), {**table.columns, **columns},
            table.crs, shapes, "MultiPolygonZ", "building_models", last, building_names(table))
        return results

    def _write_files(self, parameters, context, table, models, columns, progress, unfinished):
        """CityJSON and report, where wanted; they take their places when `unfinished` is closed.

        Returns the paths of all files that are wanted, by output name.
        """
        from ...urbanmap_qgis.buildings.city_export import objects_of_models
        from ...urbanmap_qgis.buildings.model_table import write_model_report
        from ...urbanmap_qgis.citymodel.cityjson.writer import write_model_cityjson
        from ...urbanmap_qgis.citymodel.model import CityModel
        from ...urbanmap_qgis.citymodel.reference import city_reference
        from ...urbanmap_qgis.io.files.atomic import written_beside

        results = {name: self.output_path(parameters, name, context)
                   for name in ("OUTPUT_CITYJSON", "OUTPUT_MESH", "OUTPUT_REPORT")}
        paths = {name: unfinished.enter_context(written_beside(path))
                 for name, path in results.items() if path and name != "OUTPUT_MESH"}
        names = building_names(table)
        if "OUTPUT_CITYJSON" in paths:
            reference = city_reference(table.stated or stated_wkt(table.crs))
            write_model_cityjson(paths["OUTPUT_CITYJSON"], CityModel(reference, objects_of_models(
                models, {**table.columns, **columns}, names.of), title="UrbanMap building models"), progress)
        if "OUTPUT_REPORT" in paths:
            write_model_report(paths["OUTPUT_REPORT"], names.columns(columns), table.geometries,
                               self.parameterAsString(parameters, "NOTE", context))
        return {name: str(path) for name, path in results.items() if path}


def city_buildings(models, columns, names):
    """The models with their figures as the writers of files take them, one after another."""
    from ...urbanmap_qgis.citymodel.solids import solid_object

    for row, model in enumerate(models):
        attributes = {name: values[row] for name, values in columns.items() if name != "building_id"}
        yield solid_object(names.of(model.building_id), attributes, model.solids, lod=model.lod)
