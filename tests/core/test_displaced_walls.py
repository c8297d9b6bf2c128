"""Outlines as delivered: which walls of a building's parts stand outside."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.samplecity.gnss.displaced_walls import _Lines


@pytest.mark.parametrize("box, outside", [((0, 0, 5, 10), {(0.0, 5.0), (2.5, 0.0), (2.5, 10.0)}),
                                          ((5, 0, 10, 10), {(10.0, 5.0), (7.5, 0.0), (7.5, 10.0)})])
def test_walls_between_parts_are_not_on_the_outline(box, outside):
    """Two halves of a square: three walls of each stand outside, the one between them does not."""
    lines = object.__new__(_Lines)
    lines._outline = shapely.union_all([shapely.box(0, 0, 5, 10), shapely.box(5, 0, 10, 10)])
    lines.rings = [shapely.get_coordinates(shapely.box(*box, ccw=True))[:-1]]
    ends, normal = lines.edges(0)
    on = lines._on_outline(ends, normal)
    assert {tuple(middle) for middle in ends.mean(axis=1)[on].tolist()} == outside
    assert np.count_nonzero(~on) == 1
