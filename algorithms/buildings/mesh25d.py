"""urbanmap:mesh25d."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import replace

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.settings.buildings import MeshSettings
from ..framework.base import UrbanMapAlgorithm
from ..framework.declaring.parameters import OBJ_FILTER, tr
from ..framework.layers.layers import make_fields
from ..framework.layers.outlines import building_names, footprints_of, numbers, open_points
from ..framework.layers.reprojection import ground_heights, with_heights_of_points

PLY_FILTER = "PLY mesh (*.ply)"


class Mesh25D(UrbanMapAlgorithm):
    ID = "mesh25d"
    SUCCESSOR = "buildingmodels"
    NAME = "2.5D mesh of buildings"
    SOURCE = "Javanmardi, 5.7"
    KEYWORDS = ("building", "mesh", "2.5D", "TIN", "curved", "complex", "OBJ", "PLY")
    REQUIRES = ("numpy", "scipy", "shapely", "pyproj", "laspy", "lazrs")
    HELP = (
        "Makes closed meshes of complex or curved buildings from their points: triangulated roofs, upright walls where "
        "the heights step, a level ground.\n"
        "The mesh is simplified as far as the stated error allows: at least 95 % of a building's uppermost points "
        "shall lie within it. Where that cannot be reached, as with what stands on roofs, the building says so; so "
        "it does of a second surface under the first, which has no place in a 2.5D mesh.\n"
        "Points with building_id are taken by their number; from others the outlines cut their points, of "
        "classified ones those of class 6."
    )

    def declare(self):
        self.add_points(help="Points with building_id from “Segment buildings”, or any points of airborne scanning.")
        self.add_polygons("FOOTPRINTS", "Building outlines", "One feature a building, where it stands. A field ground "
                          "gives the height of the ground in metres.")
        self.add_settings(MeshSettings, "max_error")
        self.add_raster("GROUND", "Ground elevation", "Heights of the ground in metres; the lowest along an outline is "
                        "the foot of its walls.", optional=True)
        self.add_settings(MeshSettings)
        self.add_workers()
        self.add_layer_output("OUTPUT", "Meshes", "MultiPolygonZ, one feature a building with all triangles; status, "
                              "reason, triangles, surfaces, base, height (m), points, rmse, p95, max_error (m), within "
                              "(share of the uppermost points), watertight, valid.", solids=True)
        self.add_file_output("OUTPUT_MESH", "OBJ mesh", "Wavefront OBJ file, a group for each building.", OBJ_FILTER,
                             optional=True)
        self.add_file_output("OUTPUT_PLY", "PLY mesh", "All meshes in one binary PLY file, which QGIS opens as a mesh "
                             "layer.", PLY_FILTER, optional=True)
        self.add_number_output("BUILDINGS", "Buildings", "Number of outlines.")
        self.add_number_output("MESHED", "Meshed", "Buildings with a mesh.")
        self.add_number_output("WATERTIGHT", "Watertight", "Meshes that are closed.")
        self.add_number_output("WITHIN", "Points within the error", "Share of the uppermost points within the stated "
                               "error.")
        self.add_number_output("RMSE", "RMSE", "Of all points from their meshes.", "m")
        self.add_number_output("TRIANGLES", "Triangles", "Number of all triangles.")

    def work(self, parameters, context, progress):
        import numpy as np

        from ...urbanmap_qgis.buildings.base_height import outline_ground
        from ...urbanmap_qgis.buildings.mesh25d.mesh_stage import COARSE, mesh_buildings, mesh_columns, total_fit

        table = self.read_polygons(parameters, "FOOTPRINTS", context, progress)
        footprints = footprints_of(table, progress)
        cloud = open_points(self, parameters, context, table, progress)
        table = with_heights_of_points(table, cloud, progress)
        base = numbers(table, "ground")
        base = np.full(len(footprints), np.nan) if base is None else base
        ground = ground_heights(self, parameters, context, table, progress)
        if ground is not None:
            given = outline_ground(footprints.polygons, *ground)
            base = np.where(np.isfinite(given), given, base)
        settings = self.settings(MeshSettings, parameters, context)
        with self.workers(parameters, context) as executor:
            meshes = mesh_buildings(cloud, footprints, base, settings, executor, progress.part(0.0, 0.9))
        columns = mesh_columns(meshes)
        self._tell(meshes, COARSE, progress)
        results = self._write(parameters, context, table, meshes, columns, progress.part(0.9, 1.0))
        within, rmse = total_fit(meshes)
        return {**results, "BUILDINGS": len(meshes), "MESHED": sum(item.mesh is not None for item in meshes),
                "WATERTIGHT": sum(item.watertight for item in meshes), "WITHIN": within, "RMSE": rmse,
                "TRIANGLES": sum(columns["triangles"])}

    def _tell(self, meshes, coarse, progress):
        """Say how many buildings have no mesh or one beyond the error."""
        without = sum(item.mesh is None for item in meshes)
        if without:
            progress.warn(tr("{0} of {1} buildings have no mesh; the field “reason” tells why.").format(
                without, len(meshes)))
        beyond = sum(item.status == coarse for item in meshes)
        if beyond:
            progress.warn(tr("{0} of {1} meshes have fewer than 95 % of their uppermost points within the stated "
                             "error; the field “within” tells how many.").format(beyond, len(meshes)))

    def _write(self, parameters, context, table, meshes, columns, progress):
        from ...urbanmap_qgis.buildings.mesh25d.mesh_stage import write_ply
        from ...urbanmap_qgis.citymodel.obj import write_obj
        from ...urbanmap_qgis.geometry.solid import multipolygon
        from ...urbanmap_qgis.io.files.atomic import written_beside

        results = {}
        paths = {name: self.output_path(parameters, name, context) for name in ("OUTPUT_MESH", "OUTPUT_PLY")}
        with ExitStack() as unfinished:
            if paths["OUTPUT_PLY"] is not None:
                write_ply(unfinished.enter_context(written_beside(paths["OUTPUT_PLY"])), meshes)
                results["OUTPUT_PLY"] = str(paths["OUTPUT_PLY"])
            progress.step(0.3)
            shapes = [multipolygon([item.mesh]) if item.mesh is not None else None for item in meshes]
            results |= self.write_layer(
                parameters, "OUTPUT", context, make_fields(*columns, base=table.fields),
                {**table.columns, **columns}, table.crs, shapes, "MultiPolygonZ", "building_meshes", progress,
                building_names(table))
            if paths["OUTPUT_MESH"] is not None:
                # Its file of materials is named in it, so that it cannot be renamed: written when all else is done.
                write_obj(paths["OUTPUT_MESH"], mesh_buildings_of(meshes, columns, building_names(table)),
                          progress=replace(progress, cancelled=lambda: False))
                results["OUTPUT_MESH"] = str(paths["OUTPUT_MESH"])
        return results


def meshes_beside(algorithm, parameters, context, feedback) -> dict:
    """The layer of meshes by the name OUTPUT_MESHES, which “Building models” makes of its points; none where it is not
    wanted."""
    if not parameters.get("OUTPUT_MESHES"):
        return {}
    if not parameters.get("POINTS"):
        raise InputError(tr("{0} are made of points: give “{1}”, or leave them out.").format(
            algorithm.label_of("OUTPUT_MESHES"), algorithm.label_of("POINTS")))
    run = algorithm.child_runner(context, feedback, 1)
    given = {name: parameters[name] for name in ("POINTS", "FOOTPRINTS", "GROUND", "WORKERS") if name in parameters}
    return {"OUTPUT_MESHES": run("mesh25d", **given, OUTPUT=parameters["OUTPUT_MESHES"])["OUTPUT"]}


def mesh_buildings_of(meshes, columns, names):
    """The meshes as the writer of OBJ files takes them, one after another."""
    from ...urbanmap_qgis.citymodel.solids import solid_object

    for row, item in enumerate(meshes):
        attributes = {name: values[row] for name, values in names.columns(columns).items()}
        yield solid_object(names.of(item.building_id), attributes, [item.mesh] if item.mesh is not None else [])
