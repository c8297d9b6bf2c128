"""Polygons of marking points, alone and beside those of images."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.roadmap.lines.line_work import line_work
from urbanmap_qgis.roadmap.lines.point_paint import hidden_paint, point_polygons


def scanned(shapes, step=0.07, seed=1):
    """Points of scans `step` apart on the shapes, with a scatter of a centimetre."""
    shape = shapely.union_all(shapes)
    x_min, y_min, x_max, y_max = shape.bounds
    along, across = np.arange(x_min + 0.02, x_max, step), np.arange(y_min + 0.015, y_max, 0.03)
    x, y = (axis.ravel() for axis in np.meshgrid(along, across))
    inside = shapely.contains_xy(shape, x, y)
    return np.column_stack([x, y])[inside] + np.random.default_rng(seed).normal(0.0, 0.01, (inside.sum(), 2))


def dashes(length):
    return [shapely.box(x, -0.075, x + 3.0, 0.075) for x in np.arange(0.0, length, 7.5)]


def test_dashes_of_points_have_their_place_and_size_across_tiles():
    found = sorted(point_polygons(scanned(dashes(80.0))), key=lambda shape: shape.bounds[0])
    assert len(found) == len(dashes(80.0))
    for shape, true in zip(found, dashes(80.0)):
        assert shape.bounds == pytest.approx(true.bounds, abs=0.08)
        assert shape.intersection(true).area > 0.9 * true.area


def test_lines_of_a_double_line_stay_two():
    found = point_polygons(scanned([shapely.box(0, 0, 20, 0.15), shapely.box(0, 0.5, 20, 0.65)]))
    assert len(found) == 2


def test_points_add_what_the_images_do_not_show_and_nothing_twice():
    seen = [shape for k, shape in enumerate(dashes(60.0)) if k not in (3, 4)]
    added = hidden_paint(seen, point_polygons(scanned(dashes(60.0))))
    assert sorted(round(shape.bounds[0] / 7.5) for shape in added) == [3, 4]
    (line,) = line_work([*seen, *added], [""] * 8).lines
    assert line.kind == "dashed" and len(line.dashes) == 8 and line.bridged < 0.5


def test_points_of_whole_surfaces_are_refused():
    with pytest.raises(InputError, match="whole surfaces"):
        point_polygons(scanned([shapely.box(0, 0, 8, 8)]))


def test_no_points_are_no_paint():
    assert point_polygons(np.zeros((0, 2))) == [] and hidden_paint(dashes(9.0), []) == []


def test_surfaces_are_refused_and_much_paint_is_not():
    def filled(*boxes):
        return np.concatenate([np.stack(np.meshgrid(np.arange(x, x + width, 0.04), np.arange(y, y + depth, 0.04)),
                                        -1).reshape(-1, 2) for x, y, width, depth in boxes])
    strokes = [(0.0, 3.0 * k, 20.0, 0.4) for k in range(8)]
    plaza = (30.0, 0.0, 3.0, 3.0)  # a tenth of all that is painted
    assert sum(one.area for one in point_polygons(filled(*strokes, plaza))) == pytest.approx(73.0, rel=0.2)
    with pytest.raises(InputError, match="whole surfaces"):
        point_polygons(filled(plaza))
