"""A drive's marking points as reference: the paint in a box, wherever the box lies to the tiles."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.mobile.adjustment.point_reference import PointReference
from urbanmap_qgis.mobile.markings.records import MarkingPoints


@pytest.fixture(scope="module")
def points():
    rng = np.random.default_rng(5)
    return np.column_stack([rng.uniform(1000.0, 1100.0, 2000), rng.uniform(2000.0, 2060.0, 2000), np.full(2000, 7.5)])


@pytest.mark.parametrize("box", [(1010.0, 2010.0, 1030.0, 2020.0), (900.0, 1900.0, 1200.0, 2200.0),
                                 (1090.0, 2050.0, 1130.0, 2100.0), (900.0, 2000.0, 990.0, 2060.0)])
def test_points_of_a_box_are_all_that_lie_in_it(points, box):
    n = len(points)
    reference = PointReference.of(MarkingPoints(*points.T, np.zeros(n), np.linspace(0.1, 1.0, n), np.zeros(n, int)))
    found, weight = reference._inside(*box)
    x, y = points[:, 0], points[:, 1]
    inside = np.flatnonzero((x >= box[0]) & (x <= box[2]) & (y >= box[1]) & (y <= box[3]))
    order = np.lexsort(found.T)
    assert found[order] == pytest.approx(points[inside][np.lexsort(points[inside].T)])
    assert np.sort(weight) == pytest.approx(np.linspace(0.1, 1.0, n)[inside])
    assert (reference.coverage(*box).share.max(initial=0.0) > 0) == (len(inside) > 0)
