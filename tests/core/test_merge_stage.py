"""Models joined with measured walls: edges move, roofs stay, neighbours are not crossed, every solid is valid."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
import shapely

from tests.solid_files import write_solids
from urbanmap_qgis.buildings.merging.merge_stage import (
    EDGE_COLUMNS,
    MERGED,
    MODEL_COLUMNS,
    NOT_MERGED,
    UNCHANGED,
    edge_columns,
    merge_models,
    merged_columns,
)
from urbanmap_qgis.buildings.merging.model_files import models_from_cityjson
from urbanmap_qgis.buildings.merging.model_parts import model_parts
from urbanmap_qgis.buildings.merging.plan_edges import Line, PlanEdges
from urbanmap_qgis.buildings.merging.wall_match import measured_wall
from urbanmap_qgis.buildings.solids.plan_partition import Cell
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.solids import solid_object
from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.geometry.solid import OVERHANG, multipolygon
from urbanmap_qgis.settings.buildings import MergeSettings

X0, Y0, BASE = -7000.0, -34000.0, 10.0


def box(x, y, width, depth):
    return shapely.box(X0 + x, Y0 + y, X0 + x + width, Y0 + y + depth)


def model(*parts):
    """MultiPolygonZ of parts (polygon, height above ground)."""
    cells = [Cell(polygon, number, BASE + height) for number, (polygon, height) in enumerate(parts)]
    return multipolygon(building_solids(cells, BASE))


def wall(start, end, low=0.5, high=18.0, rmse=0.01, number=0):
    """A measured wall with the building at the left of start to end (plan places), heights above ground."""
    (ax, ay), (bx, by) = start, end
    ring = [(ax, ay, low), (bx, by, low), (bx, by, high), (ax, ay, high)]
    return measured_wall(number, shapely.Polygon([(X0 + x, Y0 + y, BASE + z) for x, y, z in ring]), rmse, 0.001)


def one(models, walls, **settings):
    merged = merge_models(range(1, len(models) + 1), models, walls, MergeSettings(**settings))
    for building in merged:
        assert building.valid
        for solid in building.solids:
            assert check_solid(solid) == ()
    return merged if len(merged) > 1 else merged[0]


def lowest_plan(building):
    """What a building covers on the ground."""
    faces = [polygon for polygon in shapely.get_parts(multipolygon(building.solids))
             if np.ptp(shapely.get_coordinates(polygon, include_z=True)[:, 2]) == 0
             and shapely.get_coordinates(polygon, include_z=True)[0, 2] == BASE]
    return shapely.union_all(shapely.force_2d(faces))


def states(building):
    return sorted(edge.match.status for edge in building.edges)


@pytest.mark.paper("J 5.7, combination")
def test_a_wall_below_the_height_moves_and_the_model_above_stays():
    building = one([model((box(0, 0, 20, 10), 40.0))], [wall((0, -0.4), (20, -0.4))])
    assert building.status == MERGED and states(building) == ["moved", *["not seen"] * 3]
    assert lowest_plan(building).equals(box(0, -0.4, 20, 10.4))
    assert building.volume == pytest.approx(20 * 10 * 40 + 20 * 0.4 * 20)
    moved, = (edge for edge in building.edges if edge.match.status == "moved")
    assert moved.match.offset == pytest.approx(0.4) and moved.match.measured == pytest.approx(1.0)


def test_a_wall_behind_the_model_leaves_an_overhang_at_the_height():
    building = one([model((box(0, 0, 20, 10), 40.0))], [wall((0, 0.25), (20, 0.25))])
    solid, = building.solids
    hanging = [face for face, kind in zip(solid.faces, solid.surface_type) if kind == OVERHANG]
    assert {solid.vertices[vertex, 2] for face in hanging for vertex in face[0]} == {BASE + 20.0}
    assert building.volume == pytest.approx(200 * 40 - 20 * 0.25 * 20)


def test_a_turned_wall_turns_the_edge():
    building = one([model((box(0, 0, 20, 10), 15.0))], [wall((0, -0.2), (20, 0.1))])
    assert lowest_plan(building).area == pytest.approx(200 + 0.05 * 20, abs=0.15)
    corner = shapely.Point(X0, Y0 - 0.2)
    assert shapely.distance(corner, lowest_plan(building).boundary) < 0.012


def test_roofs_of_low_buildings_follow_small_moves_but_real_overhangs_stay():
    low = model((box(0, 0, 20, 10), 8.0))
    followed = one([low], [wall((0, 0.15), (20, 0.15), high=7.9)])
    assert OVERHANG not in followed.solids[0].surface_type
    assert followed.volume == pytest.approx(20 * 9.85 * 8)
    eaves = one([low], [wall((0, 0.6), (20, 0.6), high=7.5)])
    solid, = eaves.solids
    assert OVERHANG in solid.surface_type
    assert eaves.volume == pytest.approx(20 * 9.4 * 8 + 20 * 0.6 * 0.5), "the measured top tells the slab's height"


def test_two_walls_meet_in_a_new_corner():
    building = one([model((box(0, 0, 20, 10), 30.0))], [wall((0, -0.3), (20, -0.3)), wall((20.5, 0), (20.5, 10))])
    assert lowest_plan(building).equals(box(0, -0.3, 20.5, 10.3))


def test_a_plan_of_several_roofs_keeps_its_partition():
    parts = [(box(0, 0, 8, 10), 30.0), (box(8, 0, 12, 10), 12.0)]
    building = one([model(*parts)], [wall((0, -0.5), (20, -0.5))])
    assert building.volume == pytest.approx(80 * 30 + 120 * 12 + 8 * 0.5 * 20 + 12 * 0.5 * 12)


def test_courtyards_and_corners():
    ring = box(0, 0, 20, 20).difference(box(6, 6, 8, 8))
    building = one([model((ring, 25.0))], [wall((0, -0.2), (20, -0.2)), wall((6, 14.3), (6, 5.7))])
    assert building.status == MERGED
    assert lowest_plan(building).area == pytest.approx(400 - 64 + 20 * 0.2, abs=0.2)
    assert len(lowest_plan(building).interiors) == 1


def test_pieces_of_one_plane_are_summed():
    """37 % of an edge in three pieces, each too short to move it; a piece of another depth is not one of them."""
    pieces = [((1, -0.4), (3.4, -0.4)), ((8, -0.41), (10.4, -0.39)), ((16, -0.4), (18.6, -0.4))]
    walls = [wall(*ends, number=number) for number, ends in enumerate(pieces)]
    building = one([model((box(0, 0, 20, 10), 30.0))], walls)
    south = next(edge for edge in building.edges if edge.match.status == "moved")
    assert south.match.measured == pytest.approx(0.37) and south.match.offset == pytest.approx(0.4, abs=0.01)
    assert building.volume == pytest.approx(200 * 30 + 20 * 0.4 * 20, rel=1e-3)
    assert one([model((box(0, 0, 20, 10), 30.0))], walls[:2]).status == UNCHANGED
    apart = [walls[0], wall((8, 0.3), (10.4, 0.3), number=1), walls[2]]
    assert one([model((box(0, 0, 20, 10), 30.0))], apart).status == UNCHANGED


def test_bays_and_recesses_of_one_edge_are_followed():
    """An edge of 20 m whose facade steps: 0.5 m behind, a bay 0.6 m before, and 0.5 m behind again."""
    walls = [wall((0, 0.5), (8, 0.5)), wall((8, -0.6), (13, -0.6), number=1), wall((13, 0.5), (20, 0.5), number=2)]
    building = one([model((box(0, 0, 20, 10), 30.0))], walls)
    moved = [edge for edge in building.edges if edge.match.status == "moved"]
    assert building.status == MERGED and sorted(round(edge.length, 1) for edge in moved) == [5.0, 7.0, 8.0]
    plan = lowest_plan(building)
    assert plan.area == pytest.approx(200 - 15 * 0.5 + 5 * 0.6, abs=0.1)
    corners = {tuple(np.round(place - (X0, Y0), 2) + 0.0) for place in shapely.get_coordinates(plan)}
    assert {(8.0, 0.5), (8.0, -0.6), (13.0, -0.6), (13.0, 0.5)} <= corners
    assert building.volume == pytest.approx(20 * plan.area + 10 * 200 + 0.0, rel=0.01)


def test_walls_over_each_other_make_no_step():
    """A balcony before the middle of a facade that was measured all along: the facade has the place."""
    walls = [wall((0, 0.4), (20, 0.4)), wall((8, -0.9), (12, -0.9), low=6.0, high=9.0, number=1)]
    building = one([model((box(0, 0, 20, 10), 30.0))], walls)
    assert [edge.length for edge in building.edges if edge.match.status == "moved"] == [pytest.approx(20.0)]
    assert lowest_plan(building).area == pytest.approx(200 - 8.0, abs=0.05)


@pytest.mark.parametrize(("walls", "settings", "status", "words"), [
    ([((0, -2.5), (20, -2.5))], {}, "too far", "2.50 m outside"),
    ([((0, -0.9), (20, 0.9))], {"max_rotation": 3.0}, "too far", "rotated"),
    ([((0, -0.4), (3, -0.4))], {}, "not seen", "no measured wall"),
    ([((0, 0.004), (20, 0.004))], {}, "fits", ""),
    ([((20, -0.4), (0, -0.4))], {}, "not seen", "no measured wall"),
])
def test_limits_are_kept_and_said(walls, settings, status, words):
    near = [*(wall(*ends) for ends in walls), wall((20, 10.0), (0, 10.0))]
    building = one([model((box(0, 0, 20, 10), 30.0))], near, **settings)
    south = min(building.edges, key=lambda edge: shapely.get_coordinates(edge.wall)[:, 1].mean())
    assert south.match.status == status and words in south.match.note
    assert building.status == UNCHANGED and building.volume == pytest.approx(6000)


def test_rough_walls_are_not_used():
    walls = [wall((0, -0.4), (20, -0.4), rmse=0.3), wall((20, 10.0), (0, 10.0))]
    assert one([model((box(0, 0, 20, 10), 30.0))], walls).status == UNCHANGED


def test_a_wall_does_not_run_into_the_neighbour():
    models = [model((box(0, 0, 20, 10), 30.0)), model((box(20.5, 0, 10, 10), 30.0))]
    first, second = one(models, [wall((20.8, 0), (20.8, 10)), wall((0, -0.3), (20, -0.3))])
    assert "neighbour" in states(first) and "moved" in states(first)
    assert shapely.intersection(lowest_plan(first), lowest_plan(second)).area == 0


@pytest.mark.parametrize(("beside", "overlap", "status"), [
    (19.9, 0.015, "moved"), (19.9, 0.04, "moved"), (19.9, 0.07, "neighbour"), (20.0, 0.015, "moved"),
    (20.0, 0.04, "neighbour")])  # those that overlap already may do so by two walls' sigma more
def test_neighbours_that_overlap_by_what_walls_are_measured_to_do_not_stop_a_wall(beside, overlap, status):
    models = [model((box(0, 0, 20, 10), 30.0)), model((box(beside, 0, 10, 10), 30.0))]
    first, _ = one(models, [wall((20.0 + overlap, 0), (20.0 + overlap, 10))])
    assert status in states(first)


def test_a_facade_of_facets_does_not_pull_a_long_edge_to_one_of_them():
    facets = [wall((0, -0.2), (7, -0.9)), wall((7, -0.9), (13, -0.9)), wall((13, -0.9), (20, -0.2))]
    building = one([model((box(0, 0, 20, 10), 30.0))], facets, max_rotation=4.0)
    south = min(building.edges, key=lambda edge: shapely.get_coordinates(edge.wall)[:, 1].mean())
    assert south.match.status == "too far" and "not straight" in south.match.note


def gabled_house(eaves=10.0, ridge=14.0):
    """A house of 20 x 10 m with its ridge along x."""
    roof = [(0, 0, eaves), (20, 0, eaves), (20, 5, ridge), (0, 5, ridge)]
    back = [(0, 5, ridge), (20, 5, ridge), (20, 10, eaves), (0, 10, eaves)]
    ground = [(0, 0, 0), (0, 10, 0), (20, 10, 0), (20, 0, 0)]
    ends = [[(20, 0, 0), (20, 10, 0), (20, 10, eaves), (20, 5, ridge), (20, 0, eaves)],
            [(0, 10, 0), (0, 0, 0), (0, 0, eaves), (0, 5, ridge), (0, 10, eaves)]]
    sides = [[(0, 0, 0), (20, 0, 0), (20, 0, eaves), (0, 0, eaves)],
             [(20, 10, 0), (0, 10, 0), (0, 10, eaves), (20, 10, eaves)]]
    return shapely.MultiPolygon([[[(X0 + x, Y0 + y, BASE + z) for x, y, z in ring], []]
                                 for ring in (roof, back, ground, *ends, *sides)])


def test_a_sloped_roof_goes_on_to_the_moved_wall():
    building = one([gabled_house()], [wall((0, -0.3), (20, -0.3), high=9.0)])
    assert building.status == MERGED
    # The eaves are 0.3 m farther out and so 0.24 m lower: 0.8 m a metre.
    assert building.volume - building.volume_before == pytest.approx(20 * 0.3 * (10.0 - 0.12), abs=0.05)
    assert lowest_plan(building).area == pytest.approx(20 * 10.3, abs=0.01)
    assert max(solid.vertices[:, 2].max() for solid in building.solids) == pytest.approx(BASE + 14.0, abs=0.001)


def test_a_gable_wall_moves_and_the_ridge_with_it():
    building = one([gabled_house()], [wall((20.4, 0), (20.4, 10), high=9.0)])
    assert building.volume - building.volume_before == pytest.approx(0.4 * 10 * 12, abs=0.05)


def test_models_that_cannot_be_merged_keep_their_model_and_say_why():
    block = model((box(40, 0, 10, 10), 30.0))
    gabled, none, moved = merge_models([1, 2, 3], [gabled_house(8.0, 29.0), None, block],
                                       [wall((0, -0.3), (20, -0.3)), wall((40, -0.3), (50, -0.3))])
    assert gabled.status == NOT_MERGED and "sloped" in gabled.reason and gabled.valid
    assert gabled.volume == pytest.approx(20 * 10 * 18.5)
    assert none.status == NOT_MERGED and none.solids == () and not none.valid
    assert moved.status == MERGED


def test_bad_input_is_told():
    block = model((box(0, 0, 20, 10), 30.0))
    with pytest.raises(InsufficientDataError, match="no measured walls"):
        merge_models([1], [block], [])
    with pytest.raises(InsufficientDataError, match="same place"):
        merge_models([1], [block], [wall((2000, 0), (2020, 0))])
    with pytest.raises(InputError, match="Building 1 has no heights"):
        merge_models([1], [shapely.MultiPolygon([box(0, 0, 5, 5)])], [wall((0, -0.4), (20, -0.4))])
    with pytest.raises(InputError, match="same building_id"):
        merge_models([1, 1], [block, block], [wall((0, 0), (20, 0))])
    with pytest.raises(InputError):
        MergeSettings(height=0)
    assert measured_wall(0, shapely.Polygon([(0, 0, 5), (5, 0, 5), (5, 5, 5)])) is None, "a roof is no wall"
    assert model_parts([]).problem


@pytest.mark.parametrize("seed", range(10))
def test_random_blocks_and_walls_always_give_valid_solids(seed):
    rng = np.random.default_rng(seed)
    cut = float(np.round(rng.uniform(5, 15), 2))
    parts = [(box(0, 0, cut, 10), float(rng.uniform(6, 40))), (box(cut, 0, 20 - cut, 7), float(rng.uniform(6, 40)))]
    turned = [(shapely.affinity.rotate(polygon, 17.0, origin=(X0, Y0)), height) for polygon, height in parts]
    plan = shapely.union_all([polygon for polygon, _ in turned], grid_size=0.01)
    walls = []
    ring = shapely.get_coordinates(shapely.simplify(plan, 0.02).exterior if plan.exterior.is_ccw
                                   else shapely.simplify(plan, 0.02).exterior.reverse())
    for a, b in zip(ring[:-1], ring[1:]):
        if rng.random() < 0.7:
            along = (b - a) / np.hypot(*(b - a))
            off = rng.normal(0, 0.4, 2)
            start, end = (p + o * np.array([along[1], -along[0]]) for p, o in zip((a, b), off))
            walls.append(wall(start - (X0, Y0), end - (X0, Y0), high=rng.uniform(4, 19)))
    if walls:
        building = one([model(*turned)], walls)
        assert all(math.isfinite(edge.length) for edge in building.edges)


def test_edges_move_with_their_nodes_or_not_at_all():
    cells = [Cell(box(0, 0, 8, 10), 0, 20.0), Cell(box(8, 0, 12, 10), 1, 12.0)]
    edges = PlanEdges(cells)
    assert len(edges.edges) == 4 and sorted(round(edge.length) for edge in edges.edges) == [10, 10, 20, 20]
    south = next(number for number, edge in enumerate(edges.edges) if edge.ends[:, 1].max() == Y0)
    down = edges.moved_polygons({south: Line(np.array([X0, Y0 - 1.0]), np.array([1.0, 0.0]))})
    assert [polygon.area for polygon in down] == pytest.approx([88, 132])
    assert edges.moved_polygons({south: Line(np.array([X0, Y0 + 11.0]), np.array([1.0, 0.0]))}) is None, "folded over"


def test_tables(tmp_path):
    buildings = [one([model((box(0, 0, 20, 10), 40.0))], [wall((0, -0.4), (20, -0.4), number=6)])]
    columns, edges = merged_columns(buildings), edge_columns(buildings)
    assert list(columns) == list(MODEL_COLUMNS) and list(edges) == list(EDGE_COLUMNS)
    assert columns["walls_moved"] == [1] and columns["measured"][0] == pytest.approx(1 / 3)
    assert columns["volume_change"][0] == pytest.approx(160)
    assert [wall for wall in edges["wall"] if wall is not None] == [7]


def test_models_of_a_cityjson_file(tmp_path):
    path = tmp_path / "model.city.json"
    solids = building_solids([Cell(box(0, 0, 20, 10), 0, 40.0)], BASE)
    write_solids(path, [solid_object("building-31", {}, solids), solid_object("building-7", {}, ())], epsg=6677)
    ids, faces, names = models_from_cityjson(path)
    assert ids.tolist() == [31, 7] and names == ["building-31", "building-7"] and faces[1] is None
    merged = merge_models(ids.tolist(), list(faces), [wall((0, -0.4), (20, -0.4))])
    assert merged[0].status == MERGED and merged[0].valid

    content = json.loads(path.read_text(encoding="utf-8"))
    whole = content["CityObjects"]["building-31"]
    content["CityObjects"]["building-31-0"] = {**whole, "type": "BuildingPart", "parents": ["building-31"]}
    whole["children"] = ["building-31-0"]
    whole["geometry"] = []
    path.write_text(json.dumps(content), encoding="utf-8")
    _, faces, names = models_from_cityjson(path)
    assert names == ["building-31", "building-7"] and faces[0] is not None, "a building has the solids of its part"


def test_a_wall_that_stops_a_centimetre_beside_another_leaves_no_step():
    """As the specification asks: neighbouring corners lie 1 cm apart at least."""
    house = model((box(0, 0, 6, 8), 10.0), (box(6, 0.3, 6, 8), 10.0))
    merged = one([house], [wall((0, 0), (6, 0)), wall((6, 0.01), (12, 0.01), number=1)])
    assert merged.status == MERGED and sum(edge.match.status == "moved" for edge in merged.edges) == 1
    (solid,) = merged.solids
    sides = [np.linalg.norm(np.diff(solid.vertices[[*ring, ring[0]]], axis=0), axis=1)
             for face in solid.faces for ring in face]
    assert min(side.min() for side in sides) >= 0.012
    assert merged.volume == pytest.approx(merged.volume_before + 6 * 0.29 * 10, abs=6 * 0.01 * 10 + 1e-6)
