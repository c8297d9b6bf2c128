"""Small known answers of sums, sizes and tags."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import shapely

from urbanmap_qgis.aerial.markings.marking_files import LIMITS as FILE_LIMITS
from urbanmap_qgis.aerial.markings.marking_files import _side
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.imagery.overlays.overlay_layers import NearestPoints
from urbanmap_qgis.io.official.gsi import fitting_zone
from urbanmap_qgis.io.reference.crs_text import parse_wkt
from urbanmap_qgis.mobile.adjustment.drive_network import _node_status
from urbanmap_qgis.mobile.adjustment.records import RELATIVE
from urbanmap_qgis.mobile.registration.correction.disagreements import _APART, _without_fast
from urbanmap_qgis.mobile.registration.correction.point_observations import _share_met
from urbanmap_qgis.mobile.registration.start.correlation_start import CELL, score_image
from urbanmap_qgis.roadmap.checks.lane_rules import _local
from urbanmap_qgis.roadmap.formats.lanelet_map import _bound_tags
from urbanmap_qgis.roadmap.lines.point_paint import point_polygons
from urbanmap_qgis.roadmap.map_records import Bound
from urbanmap_qgis.samplecity.scene.model import Marking
from urbanmap_qgis.samplecity.scene.paint import Paint
from urbanmap_qgis.terrain.tiles import Tiling


def test_the_share_of_points_met_is_that_of_the_pieces_around():
    share = np.array([[10.0, 5.0], [0.0, 0.0], [30.0, 3.0], [0.0, 0.0], [0.0, 0.0]])
    assert _share_met(share, 1) == pytest.approx([0.5, 0.2, 0.1, 0.1, 0.0])


@pytest.mark.parametrize("tags, told", [(({"local_x": "1"}, {}), 2), (({}, {"local_y": "1"}), 2), (({}, {}), 0)])
def test_local_coordinates_are_looked_at_where_any_node_has_one(tags, told):
    nodes = {number: SimpleNamespace(tags=one) for number, one in enumerate(tags)}
    assert len(list(_local(SimpleNamespace(content=SimpleNamespace(nodes=nodes))))) == told


@pytest.mark.parametrize("y_max", [40.0, -400.0])
def test_the_image_of_scores_covers_the_reference(y_max):
    grid = Grid(30.0, y_max, 0.1, 200, 100)
    share = np.zeros(grid.shape, np.float32)
    share[50:60, 20:30] = 1.0
    image = score_image(SimpleNamespace(grid=grid, share=share), 0.1)
    assert image.score.shape == (round(20.0 / CELL), round(10.0 / CELL))
    row, column = np.unravel_index(image.score.argmax(), image.score.shape)
    assert -(image.top + row + 0.5) * CELL == pytest.approx(y_max - 5.5, abs=0.4)
    assert (image.left + column + 0.5) * CELL == pytest.approx(32.5, abs=0.4)


@pytest.mark.parametrize("text", ["", 'LOCAL_CS["a"] € ¥', '§LOCAL_CS["a"]'])
def test_text_with_what_is_no_wkt_is_refused(text):
    with pytest.raises(InputError, match="no WKT"):
        parse_wkt(text)


def test_tiles_share_a_length_evenly():
    most, block = 4 * FILE_LIMITS.mask_block, FILE_LIMITS.mask_block
    assert _side(3 * most, most, 1) == most
    assert _side(most + 1, most, 1) == 3 * block
    assert _side(2 * most - block, most, 1) == most
    assert _side(block, most, 1) == block


def test_buildings_of_two_zones_are_told_by_the_names_of_both():
    tokyo, osaka = shapely.box(139.7, 35.6, 139.701, 35.601), shapely.box(135.5, 34.6, 135.501, 34.601)
    notes = []
    assert fitting_zone(SimpleNamespace(geometries=np.array([tokyo, tokyo, osaka], object)), notes) == 6677
    assert len(notes) == 1 and "zone IX," in notes[0] and "in VI:" in notes[0] and notes[0].startswith("1 of 3")


def test_sigma_and_width_are_tags_where_they_are_known():
    known = _bound_tags(Bound([0, 1], "solid", "white", 0.15, 0.021), False)
    assert (known["sigma"], known["width"]) == ("0.021", "0.150")
    assert not {"sigma", "width", "color"} & set(_bound_tags(Bound([0, 1], "solid"), False))


@pytest.mark.parametrize("cell", [0.5, 2.0])
def test_tiles_hold_a_block_and_its_margin(cell):
    tiling = Tiling.for_blocks(cell, SimpleNamespace(side=400.0, radius=100.0))
    assert tiling.side == pytest.approx(1000.0, abs=cell)


def test_nodes_of_a_drive_without_ties_are_told_from_those_of_one_that_is_tied_to_drives_alone():
    nothing = SimpleNamespace(parameter=np.zeros(0), drive=np.zeros(0, int), other=np.zeros(0, int),
                              other_parameter=np.zeros(0))
    alone, none = (_node_status(["first", "second"], 0, nothing, np.zeros(0, bool), placed) for placed in (False, None))
    assert (alone == alone[0]).all() and (none == none[0]).all() and alone[0] != none[0]
    assert alone[0] == RELATIVE


def test_fast_changes_go_between_the_steps_of_a_pair_alone():
    chain = SimpleNamespace(nodes=np.arange(0.0, 10.0 * _APART, _APART), fast=np.ones(9), with_fast=lambda fast: fast)
    first, second = SimpleNamespace(node=4), SimpleNamespace(node=5)
    assert _without_fast(chain, [(first, second)]).tolist() == [1, 1, 1, 0, 0, 0, 1, 1, 1]


def test_surfaces_are_refused_and_much_paint_is_not():
    def filled(*boxes):
        return np.concatenate([np.stack(np.meshgrid(np.arange(x, x + width, 0.04), np.arange(y, y + depth, 0.04)),
                                        -1).reshape(-1, 2) for x, y, width, depth in boxes])
    strokes = [(0.0, 3.0 * k, 20.0, 0.4) for k in range(8)]
    plaza = (30.0, 0.0, 3.0, 3.0)  # a tenth of all that is painted
    assert sum(one.area for one in point_polygons(filled(*strokes, plaza))) == pytest.approx(73.0, rel=0.2)
    with pytest.raises(InputError, match="whole surfaces"):
        point_polygons(filled(plaza))


def test_paint_at_the_edge_of_all_is_known():
    paint = Paint([Marking(shapely.box(0.0, 0.0, 4.0, 3.0), "stop"), Marking(shapely.box(8.0, 1.0, 9.0, 2.0), "stop")])
    x, y = np.array([0.05, 3.95, 2.0, 8.5, 6.0, 2.0]), np.array([2.95, 0.05, 1.5, 1.5, 1.5, 3.4])
    assert paint.marking_at(x, y).tolist() == [0, 0, 0, 1, -1, -1]


def test_points_are_looked_for_within_the_image():
    seen = []

    def pixels(points, window, reach):
        seen.append((window, reach))
        return [], [], [], []

    near = NearestPoints(SimpleNamespace(size=lambda: (640, 480), pixels=pixels), 50.0)
    near.add(np.zeros((1, 3)), np.zeros(1))
    assert seen == [((0.0, 0.0, 639.0, 479.0), 50.0)]
