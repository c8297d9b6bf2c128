"""Planes that the points show and a divided plan has no place for."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.planes.lost_planes import has_lost_plane


@pytest.mark.parametrize(("drawn", "lost"), [([1], True), ([1, 2], False)])
def test_a_plane_is_lost_that_has_points_and_no_polygon(drawn, lost):
    """Two level roofs of 36 m2, 2 m apart in height; polygons of the lower one cover both."""
    x, y = (values.ravel() for values in np.meshgrid(np.arange(0.25, 12.0, 0.5), np.arange(0.25, 6.0, 0.5)))
    roof = np.where(x < 6.0, 1, 2)
    points = np.column_stack([x, y, np.where(roof == 1, 8.0, 10.0)])
    polygons = [shapely.force_3d(shapely.box(0, 0, 12, 6), 8.0)] * len(drawn)
    assert has_lost_plane(polygons, drawn, points, roof, 4.0, 10.0) is lost
