"""urbanmap:updatebuildings."""

from __future__ import annotations

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.buildings import UpdateSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import CITY_MODEL_FILTER, CITYJSON_FILTER, tr
from ..framework.layers.building_layers import read_buildings
from ..framework.layers.crs import crs_from
from ..framework.layers.layers import layer_of, make_fields, table_of_layer
from ..framework.layers.outlines import BUILDING_ID, column, numbers, open_points
from ..framework.layers.reprojection import ground_heights
from ..framework.running.chain import GivenParameters

FILES = {"OUTPUT_CITYJSON": "city.json", "OUTPUT_CITYGML": "citygml"}
"""Outputs of city models, and the endings of their scratch places."""


class UpdateBuildings(UrbanMapAlgorithm):
    ID = "updatebuildings"
    NAME = "Update building models"
    SOURCE = "Zhao and Shibasaki"
    KEYWORDS = ("building", "change detection", "update", "city model", "ALS", "lidar", "CityJSON")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs", "rasterio", "cv2")
    HELP = (
        "Holds an old city model against a new point cloud: which buildings are the same, new, gone, raised, lowered, "
        "rebuilt, extended, reduced, or were not seen.\n"
        "How far the two epochs lie from each other as a whole is found from all roofs and counts as no change. A "
        "building is compared by roof and ground points, so that crowns over it and lorries beside it do not count. "
        "What changed and what is new is modelled anew from the points; all others keep their geometry and "
        "attributes. A building that too few points show is unseen, never the same and never gone."
    )

    def declare(self):
        self.add_polygons("BUILDINGS", "Old building models", "MultiPolygonZ with all faces of each building, such as "
                          "those of “Building models” or “Load city model”; outlines alone tell new and gone ones. A "
                          "field building_id names the buildings.", optional=True)
        self.add_file("CITY_MODEL", "Old city model", "CityGML (.gml) or CityJSON (.json) file instead "
                      "of the layer.", CITY_MODEL_FILTER,
                      optional=True)
        self.add_points("POINTS", "New point clouds")
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres. Without it the ground is made "
                        "from the points.", optional=True)
        self.add_settings(UpdateSettings)
        self.add_text("DATE", "Date of the points", "Day of the new survey, such as 2026-04-01.", advanced=True)
        self.add_points_crs()
        self.add_workers()
        self.add_layer_output("OUTPUT", "Updated buildings", "MultiPolygonZ, all buildings, gone ones with their old "
                              "shape: building_id, change, height_change (m), area_change (m2), significance "
                              "(in standard deviations), seen (share), reason, surveyed (day), and the old fields.",
                              solids=True)
        self.add_file_output("OUTPUT_CITYJSON", "CityJSON", "The updated city model; objects that stayed the same keep "
                             "all their values.", CITYJSON_FILTER, optional=True)
        self.add_folder_output("OUTPUT_CITYGML", "CityGML", "Folder with the updated CityGML: members that stayed the "
                               "same keep every byte, changed ones their id and attributes.", optional=True)
        self.add_report("HTML report: counts, offset of the epochs, changes.")
        for name, label in (("NEW", "New"), ("GONE", "Gone"), ("CHANGED", "Changed"), ("SAME", "Same"),
                            ("UNSEEN", "Not seen")):
            self.add_number_output(name, label, "Number of buildings.")

    def check(self, parameters, context):
        self.day_of(parameters, "DATE", context)
        if bool(parameters.get("BUILDINGS")) == bool(parameters.get("CITY_MODEL")):
            raise InputError(tr("Give either {0} or {1}.").format(self.label_of("BUILDINGS"),
                                                                  self.label_of("CITY_MODEL")))

    def compute(self, parameters, context, feedback):
        from ...urbanmap_qgis.buildings.update.update_stage import city_changes
        from ...urbanmap_qgis.buildings.update.update_table import counts_of, old_building

        progress = self.progress(feedback)
        table = self._old(parameters, context, feedback, progress)
        cloud = open_points(self, parameters, context, table, progress, name="BUILDINGS")
        ground = ground_heights(self, parameters, context, table, progress, "BUILDINGS")
        sigma = numbers(table, "rmse_z95")
        old = [old_building(geometry, float("nan") if sigma is None else float(sigma[row]))
               for row, geometry in enumerate(table.geometries)]
        with self.workers(parameters, context) as executor:
            found = city_changes(old, cloud, self.settings(UpdateSettings, parameters, context), ground, executor,
                                 progress.part(0.0, 0.5))
        changes = [*found.changes, *found.additions]
        models, failed = self._models(parameters, context, feedback, table, old, found)
        results = self._write(parameters, context, feedback, table, found, changes, models, failed, progress)
        counts = counts_of(changes)
        progress.message(tr("{0} new, {1} gone, {2} changed, {3} the same, {4} not seen.").format(
            *(counts[name] for name in ("NEW", "GONE", "CHANGED", "SAME", "UNSEEN"))))
        return {**results, **counts}

    def _old(self, parameters, context, feedback, progress):
        """The old buildings, those of a city model by way of a layer."""
        if parameters.get("BUILDINGS"):
            return read_buildings(self, parameters, "BUILDINGS", context, progress)
        from ...urbanmap_qgis.io.points.pointcloud import open_cloud

        run = self.child_runner(context, feedback, 1)
        crs = crs_from(open_cloud(self.point_files(parameters, "POINTS", context)).crs_wkt)
        loaded = run("loadcitymodel", INPUT=parameters["CITY_MODEL"], CRS=crs, OUTPUT="TEMPORARY_OUTPUT",
                     OUTPUT_MODELS="TEMPORARY_OUTPUT")
        table = table_of_layer(loaded["OUTPUT"], context, self.label_of("CITY_MODEL"))
        models = table_of_layer(loaded["OUTPUT_MODELS"], context, self.label_of("CITY_MODEL"))
        solids = dict(zip(models.columns[BUILDING_ID], models.geometries))
        for row, name in enumerate(table.columns[BUILDING_ID]):
            table.geometries[row] = solids.get(name, table.geometries[row])
        return table

    def _models(self, parameters, context, feedback, table, old, found):
        """New models of the buildings that need one: geometries and heights by row; sentences on those that failed."""
        from ...urbanmap_qgis.buildings.update.update_table import outlines_to_model

        rows, outlines = outlines_to_model(old, found)
        if not rows:
            return {}, []
        layer = layer_of(context, make_fields((BUILDING_ID, "int")), {BUILDING_ID: [row + 1 for row in rows]},
                         table.crs, outlines, "MultiPolygon")
        run = self.child_runner(context, feedback, 1)
        result = run("buildingsfromals", **GivenParameters(parameters).pick("POINTS", "GROUND", "WORKERS", "SCHEDULER"),
                     FOOTPRINTS=layer, MAX_DISPLACEMENT=0, OUTPUT="TEMPORARY_OUTPUT")
        made = table_of_layer(result["OUTPUT"], context, self.label_of("OUTPUT"))
        models, failed = {}, []
        for row, geometry in enumerate(made.geometries):
            number = int(made.columns[BUILDING_ID][row]) - 1
            if geometry is None:
                failed.append(tr("Building {0} changed, but no new model can be made: {1}").format(
                    self._name(table, number), made.columns["reason"][row]))
            else:
                models[number] = geometry, {name: made.columns[name][row] for name in made.columns}
        return models, failed

    @staticmethod
    def _name(table, row):
        """Id of an old building for messages; of a new one its number."""
        names = column(table, BUILDING_ID) or table.ids.tolist()
        return names[row] if row < len(names) else f"new {row - len(names) + 1}"

    def _write(self, parameters, context, feedback, table, found, changes, models, failed, progress):
        """Layer, CityJSON and report."""
        from ...urbanmap_qgis.buildings.update.update_table import new_ids, update_columns, write_update_report

        for sentence in failed:
            progress.warn(sentence)
        count, date = len(table), self.day_of(parameters, "DATE", context)
        names = column(table, BUILDING_ID) or list(range(1, count + 1))
        names = [*names, *new_ids(names, len(found.added))]
        carried = {name: [*values, *[None] * len(found.added)] for name, values in table.columns.items()
                   if name.lower() != BUILDING_ID}
        geometries = [*table.geometries, *[building.outline for building in found.added]]
        for row, (geometry, values) in models.items():
            geometries[row] = geometry
            for name in carried.keys() & values.keys():
                carried[name][row] = values[name]
        ours = {BUILDING_ID: names, **update_columns(changes),
                "surveyed": [date if row in models and date else None for row in range(len(names))]}
        kind = "int" if all(isinstance(name, int) for name in names) else "text"
        fields = make_fields((BUILDING_ID, kind), *[name for name in ours if name != BUILDING_ID], base=table.fields)
        columns = {**carried, **ours}
        results = self.write_layer(parameters, "OUTPUT", context, fields, columns, table.crs, geometries,
                                   "MultiPolygonZ", "updated_buildings", progress.part(0.9, 1.0))
        results.update(self.write_file(parameters, "OUTPUT_REPORT", context, write_update_report, names, changes, found,
                                       failed))
        gone = [row for row, change in enumerate(changes) if change.change == "gone"]
        wanted = sorted(models) if parameters.get("CITY_MODEL") else sorted(set(range(len(names))) - set(gone))
        part = layer_of(context, fields, {name: [values[row] for row in wanted] for name, values in columns.items()},
                        table.crs, [geometries[row] for row in wanted], "MultiPolygonZ") if wanted else None
        return {**results, **self._write_models(parameters, context, feedback, part, [names[row] for row in gone])}

    def _write_models(self, parameters, context, feedback, part, gone):
        """City models: of a layer written anew, of a city model spliced into it. `part` is the layer of the buildings
        to write, None without any; `gone` are ids."""
        wanted = [name for name in FILES if parameters.get(name)]
        if not wanted:
            return {}
        made = {name: self.temporary_file(context, f"changed.{FILES[name]}") for name in wanted}
        if part is not None:
            self.child_runner(context, feedback, 1)("exportcitymodel", BUILDINGS=part, ID_FIELD=BUILDING_ID, **made)
        from ...urbanmap_qgis.citymodel.spliced import write_updated

        results = {}
        for name in wanted:
            target = self.output_path(parameters, name, context)
            write_updated(parameters.get("CITY_MODEL") and self.input_path(parameters, "CITY_MODEL", context),
                          made[name] if part is not None else None, target, [str(each) for each in gone])
            results[name] = str(target)
        return results
