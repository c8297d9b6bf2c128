"""Surfaces cut by lines: known areas, shared edges to the bit, slivers given away."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.roadspace.road_cuts import cut_surface

SQUARE = shapely.box(0.0, 0.0, 10.0, 10.0)


def areas(pieces):
    return sorted(piece.area for piece in pieces)


def test_a_cut_keeps_its_bends():
    """Bent up by 2 m in its middle, the cut gives the lower piece a triangle of 10 m2."""
    pieces = cut_surface(SQUARE, [np.array([[0.0, 5.0], [5.0, 7.0], [10.0, 5.0]])])
    assert areas(pieces) == pytest.approx([40.0, 60.0])
    shared = shapely.intersection(*pieces)
    assert shared.length == pytest.approx(2 * np.hypot(5.0, 2.0))
    assert [5.0, 7.0] in shapely.get_coordinates(shared).tolist()


def test_ends_are_put_onto_the_boundary_and_onto_corners_near_them():
    pieces = cut_surface(SQUARE, [np.array([[0.01, -0.3], [9.99, 10.4]])])
    assert areas(pieces) == pytest.approx([50.0, 50.0])
    assert {tuple(place) for piece in pieces for place in shapely.get_coordinates(piece)} == {
        (0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)}
    assert all(piece.exterior.is_ccw for piece in pieces)


def test_a_sliver_goes_to_the_neighbour_with_the_longest_edge():
    lines = [np.array([[4.0, 0.0], [4.0, 10.0]]), np.array([[4.004, 0.0], [4.004, 10.0]])]
    assert len(cut_surface(SQUARE, lines, sliver=0.0)) == 3
    pieces = cut_surface(SQUARE, lines)
    assert len(pieces) == 2 and sum(areas(pieces)) == pytest.approx(100.0, abs=1e-9)
