"""Rings of polygons are those of shapely, whatever the polygons are."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.geometry.polygon_rings import polygon_rings

BOX = shapely.from_wkt("POLYGON Z ((0 0 1, 4 0 2, 4 4 3, 0 4 2, 0 0 1))")
HOLE = shapely.box(0, 0, 9, 9).difference(shapely.box(2, 2, 3, 3))
CASES = ([BOX], [BOX, shapely.box(5, 5, 6, 7)], [BOX, HOLE, BOX], [shapely.Polygon(), BOX], [],
         [shapely.MultiPolygon([shapely.box(0, 0, 1, 1), HOLE]), BOX], [None, BOX],
         [shapely.LineString([(0, 0), (1, 1)])])


@pytest.mark.parametrize("case", range(len(CASES)))
def test_rings_and_their_owners_are_those_of_shapely(case):
    polygons = np.array(CASES[case], object)
    rings, owner = polygon_rings(polygons)
    wanted, wanted_owner = shapely.get_rings(polygons, return_index=True)
    assert shapely.to_wkt(rings).tolist() == shapely.to_wkt(wanted).tolist()
    assert owner.tolist() == wanted_owner.tolist()


@pytest.mark.parametrize("shape", [BOX, HOLE, shapely.MultiPolygon([shapely.box(0, 0, 1, 1)])])
def test_one_shape_is_taken_too(shape):
    assert polygon_rings(shape)[0].tolist() == shapely.get_rings(shape).tolist()
