"""Steps of the plan of sloped roofs and of meshes, on shapes with known answers."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from urbanmap_qgis.buildings.merging.wall_match import MeasuredWall, _summed
from urbanmap_qgis.buildings.mesh25d import node_heights
from urbanmap_qgis.buildings.planes.candidate_segments import _intersections
from urbanmap_qgis.buildings.planes.low_patches import _Cells
from urbanmap_qgis.buildings.polygons.partition_lines import LabelBoundaries


@pytest.mark.parametrize(("ridge", "lies_there"), [(20.0, True), (26.0, False)])
def test_a_ridge_is_drawn_where_planes_meet_at_their_border(ridge, lies_there):
    """The labels change at x = 20 over 5 m; the planes meet at equal height at `ridge`."""
    place = np.column_stack([np.full(10, 20.0), np.arange(10) * 0.5])
    cracks = LabelBoundaries(place, np.zeros(10, int), np.ones(10, int))
    planes = np.array([[0.3, 0.0, 0.0], [-0.3, 0.0, 0.6 * ridge]])
    lines = []
    drawn = SimpleNamespace(add=lambda line, *_: lines.append(line), reach=lambda line, along, pair: along)
    assert (_intersections(drawn, cracks, planes, 0.5, 1.0) == lies_there).all()
    assert len(lines) == lies_there
    if lies_there:
        assert np.abs(lines[0]) == pytest.approx([1.0, 0.0, 20.0])


@pytest.mark.parametrize(("tolerance", "left"), [(5, [0, 2, 4]), (25, [0, 4])])
def test_a_chain_keeps_the_node_that_lies_off_its_line(monkeypatch, tolerance, left):
    """Five nodes in a row, the middle one 20 units above the line through the ends."""
    heights = {(7, node): height for node, height in enumerate((0, 10, 20, 10, 0))}
    kept = []
    monkeypatch.setattr(node_heights, "_replace", lambda edges, chain, nodes: kept.append(nodes))
    node_heights._simplify_chain(SimpleNamespace(cell={(0, 1): 7}), list(range(5)), heights, tolerance)
    assert kept == [left]


def test_points_fall_into_the_cells_that_they_lie_in():
    """Columns from the west, rows from the north; what lies off the raster is in none."""
    x, y = np.array([10.5, 11.5, 12.5]), np.array([22.5, 21.5])
    raster = SimpleNamespace(x=x, y=y, cell=1.0, label=np.zeros((2, 3), int))
    column, row = (part.ravel() for part in np.meshgrid(range(3), range(2)))
    for off in (-0.4, 0.4):
        points = np.column_stack([x[column] + off, y[row] - off, 3.0 * row + column])
        cells = _Cells.of(raster, points)
        assert cells.on.all() and cells.row.tolist() == row.tolist() and cells.column.tolist() == column.tolist()
        assert cells.top.tolist() == [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]
    assert not _Cells.of(raster, np.array([[13.2, 22.0, 0.0], [11.0, 20.9, 0.0]])).on.any()


def test_two_walls_of_one_plane_are_the_line_through_both():
    """Of 8 m each, 4 m apart, one 10 cm before the other: samples at nine places of each, y on x by least squares."""
    walls = [MeasuredWall(number, np.array([x, y]), np.array([0.0, 1.0]), -4.0, 4.0, 0.0, 3.0, 24.0, 0.02, 0.01, 0.0)
             for number, (x, y) in enumerate(((-6.0, 0.0), (6.0, 0.1)))]
    whole = _summed(walls[0], walls)
    assert whole.point == pytest.approx([0.0, 0.05]) and whole.area == 48.0
    places = np.concatenate([np.linspace(-10, -2, 9), np.linspace(2, 10, 9)])
    slope = np.polyfit(places, np.repeat([0.0, 0.1], 9), 1)[0]
    assert whole.normal == pytest.approx([-slope, 1.0], abs=1e-4)
    assert (whole.left, whole.right) == pytest.approx((-10.0, 10.0), abs=1e-3)
