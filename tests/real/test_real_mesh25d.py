"""2.5D meshes of real terraced houses: closed, valid, near their points."""

from __future__ import annotations

import sqlite3

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.mesh25d.mesh_stage import mesh_buildings
from urbanmap_qgis.buildings.outlines.footprint import clean_footprints
from urbanmap_qgis.io.points.pointcloud import open_cloud

SOME = 24


@pytest.fixture(scope="module")
def meshes(real_data):
    folder = real_data / "als" / "delft_west"
    if not folder.is_dir():
        pytest.skip("the points of Delft are not there")
    connection = sqlite3.connect(folder / "outlines.gpkg")
    table, column = connection.execute("select table_name, column_name from gpkg_geometry_columns").fetchone()
    skip = {0: 8, 1: 40, 2: 56, 3: 56, 4: 72}
    blobs = [row[0] for row in connection.execute(f'select "{column}" from "{table}"')]
    outlines = shapely.from_wkb([blob[skip[blob[3] >> 1 & 7]:] for blob in blobs])[:SOME]
    footprints = clean_footprints(outlines)
    return mesh_buildings(open_cloud([folder / "points_2_per_m2.laz"]), footprints, np.full(SOME, np.nan))


def test_all_are_closed_and_valid(meshes):
    made = [item for item in meshes if item.mesh is not None]
    assert len(made) >= SOME - 2
    assert all(item.watertight for item in made)
    assert sum(item.valid is True for item in made) >= len(made) - 1


def test_they_lie_near_their_points_or_say_that_they_do_not(meshes):
    fits = [item.fit for item in meshes if item.fit]
    within = np.average([fit.within for fit in fits], weights=[fit.points for fit in fits])
    assert within > 0.9
    for item in meshes:
        if item.mesh is not None and item.fit.within < 0.95:
            assert "of its uppermost points lie within" in item.reason
