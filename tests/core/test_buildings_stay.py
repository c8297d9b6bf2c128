"""What the building stages make of the sample city stays as it is (see tests/figures.py)."""

from __future__ import annotations

import sqlite3
from contextlib import closing

import numpy as np
import pytest
import shapely

from tests.figures import ENVELOPES, stays
from tests.solid_files import read_solids, write_solids
from urbanmap_qgis.buildings.building_model import RoofInput
from urbanmap_qgis.buildings.merging.merge_stage import edge_columns, merge_models, merged_columns
from urbanmap_qgis.buildings.merging.wall_match import measured_wall
from urbanmap_qgis.buildings.mesh25d.mesh_stage import mesh_buildings, mesh_columns, total_fit
from urbanmap_qgis.buildings.model_stage import build_models
from urbanmap_qgis.buildings.model_table import model_columns, write_model_report
from urbanmap_qgis.buildings.outlines.footprint import Footprints, clean_footprints
from urbanmap_qgis.buildings.polygon_stage import cloud_roof_polygons
from urbanmap_qgis.buildings.roof_stage import segment_cloud_roofs
from urbanmap_qgis.buildings.seen.cloud_cover import CloudCover
from urbanmap_qgis.buildings.segmentation import segment_buildings
from urbanmap_qgis.citymodel.obj import write_obj
from urbanmap_qgis.citymodel.solids import solid_object
from urbanmap_qgis.facades.building_plans import building_plans
from urbanmap_qgis.facades.wall_stage import find_walls, wall_columns
from urbanmap_qgis.geometry.solid import multipolygon
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.apply_correction import apply_correction
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.settings.buildings import (
    MergeSettings,
    MeshSettings,
    PlaneParameters,
    PolygonParameters,
    RoofParameters,
    SegmentationParameters,
)


@pytest.fixture(scope="module")
def outlines(small_city):
    """The official outlines, rough as they are."""
    with closing(sqlite3.connect(small_city / "footprints" / "gsi_buildings.gpkg")) as base:
        blobs = [row[0] for row in base.execute('SELECT geom FROM "BldA"')]
    polygons = shapely.from_wkb([blob[8 + ENVELOPES[blob[3] >> 1 & 7]:] for blob in blobs])
    return clean_footprints(np.array(polygons, dtype=object))


@pytest.fixture(scope="module", params=["levels", "planes"])
def chain(request, small_city, outlines, tmp_path_factory):
    """Segmentation, roofs, polygons and models; the roofs as levels or as planes."""
    folder = tmp_path_factory.mktemp("chain")
    found = segment_buildings(open_cloud([small_city / "als" / "als.laz"]), outlines, folder / "b.laz")
    placed = Footprints(outlines.ids, found.outlines, outlines.notes)
    planes = PlaneParameters(0.15, 1.0) if request.param == "planes" else None
    roofs = segment_cloud_roofs(open_cloud([folder / "b.laz"]), placed, folder / "r.laz", RoofParameters(),
                                found.ground, planes=planes)
    drawn = cloud_roof_polygons(open_cloud([folder / "r.laz"]), placed, PolygonParameters(roofs=request.param))
    table = RoofInput(np.array(drawn.polygon, object), np.array(drawn.building_id), np.array(drawn.roof_id),
                      np.array(drawn.height), np.array(drawn.status, object))
    models = build_models(placed, table, found.ground, open_cloud([folder / "r.laz"]),
                          cover=CloudCover(found.cloud_density, found.beyond))
    return request.param, folder, found, roofs, drawn, models, placed


@pytest.mark.slow
def test_points_roofs_and_polygons_stay(chain):
    kind, folder, found, roofs, drawn, _, _ = chain
    stays(f"buildings_roofs_{kind}", {"segmented": found, "roofs": roofs, "polygons": drawn, "files": folder})


def test_models_and_their_files_stay(chain, tmp_path):
    kind, _, _, _, _, models, placed = chain
    columns = model_columns(models)
    write_model_report(tmp_path / "report.html", columns, placed.polygons)
    buildings = [solid_object(str(model.building_id), {"height": 1.5}, model.solids) for model in models]
    write_solids(tmp_path / "models.json", buildings, epsg=6677)
    write_obj(tmp_path / "models.obj", buildings)
    stays(f"buildings_models_{kind}", {"columns": columns, "files": tmp_path,
                                       "read": list(read_solids(tmp_path / "models.json")),
                                       "solids": [multipolygon(model.solids) for model in models if model.solids]})


@pytest.mark.parametrize("method", [pytest.param("points", marks=pytest.mark.once), "paper"])
def test_polygons_of_other_methods_stay(small_city, outlines, tmp_path, method):
    """Which of two equally good corners an outline from points takes hangs on the last digit of sums, which releases of
    numpy round differently: its figures are those of one of them."""
    cloud = open_cloud([small_city / "als" / "als_classified.laz"])
    settings = SegmentationParameters(method="paper") if method == "paper" else SegmentationParameters()
    found = segment_buildings(cloud, outlines, tmp_path / "b.laz", settings)
    placed = Footprints(outlines.ids, found.outlines, outlines.notes)
    levels = RoofParameters(method="paper") if method == "paper" else RoofParameters()
    segment_cloud_roofs(open_cloud([tmp_path / "b.laz"]), placed, tmp_path / "r.laz", levels, found.ground)
    drawn = cloud_roof_polygons(open_cloud([tmp_path / "r.laz"]), placed, PolygonParameters(method, "levels"))
    stays(f"buildings_polygons_{method}", {"segmented": found, "polygons": drawn})


@pytest.mark.slow
def test_meshes_stay(small_city, outlines, tmp_path):
    found = segment_buildings(open_cloud([small_city / "als" / "als.laz"]), outlines, tmp_path / "b.laz")
    placed = Footprints(outlines.ids, found.outlines, outlines.notes)
    meshes = mesh_buildings(open_cloud([tmp_path / "b.laz"]), placed, found.ground, MeshSettings())
    stays("buildings_meshes", {"columns": mesh_columns(meshes), "fit": total_fit(meshes), "meshes": meshes}, 2e-3)


@pytest.fixture(scope="module")
def walls(small_city, outlines, tmp_path_factory):
    """Walls from the first mobile survey where the scanners truly were, and the counts."""
    path = tmp_path_factory.mktemp("walls") / "survey.laz"
    reported = read_trajectory(small_city / "mms" / "survey_01_trajectory.csv").trajectory
    true = read_trajectory(small_city / "truth" / "survey_01_trajectory.csv").trajectory
    apply_correction([small_city / "mms" / "survey_01.laz"], reported, true, path)
    return find_walls(open_cloud([path]), building_plans(outlines.polygons, outlines.ids))


def test_walls_stay(walls):
    stays("buildings_walls", {"counts": walls[1], "columns": wall_columns(walls[0]),
                              "contours": [wall.contour for wall in walls[0]]}, 1e-2)


@pytest.mark.slow
def test_merged_models_stay(chain, walls):
    kind, _, _, _, _, models, _ = chain
    measured = [measured_wall(row, part, 0.02, 0.002) for row, wall in enumerate(walls[0])
                for part in shapely.get_parts(wall.contour)]
    merged = merge_models([model.building_id for model in models],
                          [multipolygon(model.solids) if model.solids else None for model in models],
                          [wall for wall in measured if wall is not None], MergeSettings())
    stays(f"buildings_merged_{kind}", {"columns": merged_columns(merged), "edges": edge_columns(merged)}, 2e-3)
