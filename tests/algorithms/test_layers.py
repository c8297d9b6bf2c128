"""Features of a layer come in batches, from arrays as from files."""

from __future__ import annotations

import sqlite3
from contextlib import closing

import numpy as np
import pytest
import shapely

from tests.small_disk import small_disk


@pytest.mark.parametrize("stored", [False, True])
def test_batches_are_whole_and_in_order(plugin, tmp_path, stored):
    from qgis.core import NULL

    module = plugin("algorithms.framework.layers.layers")
    count = 2 * module.BATCH + 7
    polygons = shapely.box(np.arange(count), 0, np.arange(count) + 1.0, 1)
    geometries = polygons
    if not stored:
        polygons[5] = None
    else:
        geometries = plugin("urbanmap_qgis.aerial.markings.stored_polygons").StoredPolygons(tmp_path)
        geometries.add(polygons)
    number = np.arange(count, dtype=float)
    number[3] = np.nan
    columns = {"number": number, "name": [f"n{row}" for row in range(count)]}
    fields = module.make_fields(("number", "real"), ("name", "text"))
    batches = list(module.features_of(fields, columns, geometries))
    assert [len(batch) for batch in batches] == [module.BATCH, module.BATCH, 7]
    features = [feature for batch in batches for feature in batch]
    assert [feature["name"] for feature in features] == columns["name"]
    assert features[3]["number"] == NULL
    assert [feature["number"] for feature in features[4:]] == list(range(4, count))
    assert features[5].hasGeometry() == stored
    assert all(features[row].geometry().boundingBox().xMinimum() == row for row in (0, 999, 1000, count - 1))


def test_columns_of_different_length_are_refused(plugin):
    module = plugin("algorithms.framework.layers.layers")
    fields = module.make_fields(("number", "int"),)
    with pytest.raises(ValueError, match="differ in length"):
        list(module.features_of(fields, {"number": [1, 2]}, [shapely.box(0, 0, 1, 1)]))


def test_a_layer_without_features_that_a_full_disk_cut_off_is_told(plugin, tmp_path):
    from qgis.core import QgsCoordinateReferenceSystem, QgsProcessingContext

    algorithm = plugin("algorithms.roadmap.roadmodel").RoadModel().create()
    module = plugin("algorithms.framework.layers.layers")
    with small_disk(tmp_path / "disk", "40k"), pytest.raises(
            plugin("urbanmap_qgis.errors").OutputError, match="not written whole .*make room"):
        algorithm.write_layer({"OUTPUT": str(tmp_path / "disk" / "roads.gpkg")}, "OUTPUT", QgsProcessingContext(),
                              module.make_fields(("kind", "text")), {"kind": []},
                              QgsCoordinateReferenceSystem("EPSG:6677"), [], "Polygon", "road_surfaces")


def test_a_file_in_which_no_layer_was_entered_is_told(plugin, tmp_path, monkeypatch):
    """As on a disk with room for the file of a GeoPackage and not for its layer's entry."""
    from qgis.core import QgsCoordinateReferenceSystem, QgsProcessingContext

    algorithm = plugin("algorithms.roadmap.roadmodel").RoadModel().create()
    module, styles = plugin("algorithms.framework.layers.layers"), plugin("algorithms.framework.layers.styles")
    whole = styles.field_names

    def without_entry(path):
        with closing(sqlite3.connect(path)) as database, database:
            database.execute("DELETE FROM gpkg_contents")
        return whole(path)

    monkeypatch.setattr(styles, "field_names", without_entry)
    with pytest.raises(plugin("urbanmap_qgis.errors").OutputError, match="not written whole .*make room"):
        algorithm.write_layer({"OUTPUT": str(tmp_path / "roads.gpkg")}, "OUTPUT", QgsProcessingContext(),
                              module.make_fields(("kind", "text")), {"kind": []},
                              QgsCoordinateReferenceSystem("EPSG:6677"), [], "Polygon", "road_surfaces")
