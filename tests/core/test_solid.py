"""Solids over known plans: valid, closed, with the volume and the surfaces that geometry says."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from shapely import affinity, box

from urbanmap_qgis.buildings.solids.plan_partition import Cell, partition_plan
from urbanmap_qgis.buildings.solids.solid import building_solids
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.polygon_rings import polygon_rings
from urbanmap_qgis.geometry.solid import multipolygon, surfaces, volume
from urbanmap_qgis.geometry.triangulation import clip_ears, triangulate_face


def build(footprint, roofs, heights, base=0.0):
    cells = partition_plan(footprint, [roof & footprint for roof in roofs], heights, list(range(len(roofs))))
    return building_solids(cells, base), cells


def signed_volume(solid):
    """Volume by the divergence theorem from the faces alone."""
    points = solid.vertices - solid.vertices.min(axis=0)
    total = 0.0
    for face in solid.faces:
        for ring in face:
            p = points[list(ring)]
            total += np.sum(np.cross(p[1:-1] - p[0], p[2:] - p[0]) @ p[0]) / 6
    return total


def areas_by_type(solid):
    """3D area of each kind of surface, from Newell's vectors."""
    total = {}
    for face, kind in zip(solid.faces, solid.surface_type):
        vector = sum(np.cross(p - p[0], np.roll(p, -1, axis=0) - p[0]).sum(axis=0) / 2
                     for p in (solid.vertices[list(ring)] for ring in face))
        total[kind] = total.get(kind, 0.0) + np.linalg.norm(vector)
    return total


def assert_sound(solids):
    for solid in solids:
        assert check_solid(solid) == ()
        assert solid.unrepaired_nodes == 0
        assert signed_volume(solid) == pytest.approx(volume(solid), rel=1e-9)
        ends = np.array([pair for face in solid.faces for ring in face for pair in zip(ring, (*ring[1:], ring[0]))])
        steps = solid.vertices[ends[:, 1]] - solid.vertices[ends[:, 0]]
        assert np.linalg.norm(steps, axis=1).min() > 0.0009999
        points = np.round(solid.vertices, 4)
        assert len(np.unique(points, axis=0)) == len(points)


PLANS = {
    "box": (box(0, 0, 8, 5), [box(0, 0, 8, 5)], [3]),
    "L": (box(0, 0, 8, 5) | box(0, 0, 3, 9), [box(-1, -1, 9, 10)], [3]),
    "T": (box(0, 6, 9, 9) | box(3, 0, 6, 9), [box(0, 6, 9, 9), box(3, 0, 6, 6)], [4, 7]),
    "courtyard": (box(0, 0, 12, 12) - box(4, 4, 8, 8), [box(0, 0, 6, 12), box(6, 0, 12, 12)], [5, 9]),
    "two levels": (box(0, 0, 8, 5), [box(0, 0, 3, 5), box(3, 0, 8, 5)], [3, 6]),
    "tower inside": (box(0, 0, 8, 8), [box(0, 0, 8, 8), box(2, 2, 5, 5)], [3, 9]),
    "pit inside": (box(0, 0, 8, 8), [box(0, 0, 8, 8) - box(2, 2, 5, 5), box(2, 2, 5, 5)], [9, 3]),
    "T node": (box(0, 0, 8, 8), [box(0, 0, 8, 4), box(0, 4, 3, 8), box(3, 4, 8, 8)], [3, 5, 9]),
    "equal heights": (box(0, 0, 8, 8), [box(0, 0, 8, 4), box(0, 4, 3, 8), box(3, 4, 8, 8)], [3, 5, 5]),
    "four levels": (box(0, 0, 8, 8), [box(0, 0, 4, 4), box(4, 0, 8, 4), box(4, 4, 8, 8), box(0, 4, 4, 8)],
                    [3, 5, 9, 7]),
}


@pytest.mark.parametrize("base", [0.0, -2.5, 1.25])
@pytest.mark.parametrize("name", PLANS)
def test_known_plans(name, base):
    footprint, roofs, heights = PLANS[name]
    solids, partition = build(footprint, roofs, heights, base)
    assert len(solids) == 1
    assert solids[0].mended_nodes == 0
    assert_sound(solids)
    expected = sum(cell.polygon.area * (cell.height - base) for cell in partition)
    assert volume(solids[0]) == pytest.approx(expected, rel=1e-12)
    areas = areas_by_type(solids[0])
    assert areas["roof"] == pytest.approx(areas["ground"]) == pytest.approx(footprint.area)


def test_walls_of_two_levels():
    solids, _ = build(*PLANS["two levels"])
    areas = areas_by_type(solids[0])
    assert areas["inner wall"] == pytest.approx(5 * 3)
    assert areas["outer wall"] == pytest.approx((3 + 5 + 3) * 3 + (5 + 5 + 5) * 6)
    assert solids[0].surface_type.count("ground") == 1


def test_no_wall_between_equal_heights():
    solids, _ = build(box(0, 0, 8, 5), [box(0, 0, 3, 5), box(3, 0, 8, 5)], [4, 4])
    assert "inner wall" not in solids[0].surface_type
    assert solids[0].surface_type.count("roof") == 2
    assert_sound(solids)


def test_vertical_edge_is_split_where_walls_end():
    solids, _ = build(*PLANS["T node"])
    tall = [face for face, kind in zip(solids[0].faces, solids[0].surface_type)
            if kind == "inner wall" and len(face[0]) == 5]
    assert len(tall) == 1


@pytest.mark.parametrize("angle", [0, 17, 45])
def test_checkerboard_is_mended(angle):
    footprint = affinity.rotate(box(0, 0, 8, 8), angle, origin=(0, 0))
    quarters = [box(0, 0, 4, 4), box(4, 0, 8, 4), box(4, 4, 8, 8), box(0, 4, 4, 8)]
    roofs = [affinity.rotate(quarter, angle, origin=(0, 0)) for quarter in quarters]
    solids, partition = build(footprint, roofs, [9, 3, 8, 4])
    assert len(solids) == 1 and solids[0].mended_nodes == 1
    assert_sound(solids)
    plain = sum(cell.polygon.area * cell.height for cell in partition)
    assert 0 < abs(volume(solids[0]) - plain) < 0.001


def star(seed):
    """Wedges of different heights round one point: up to twelve edges meet there, at any angle."""
    rng = np.random.default_rng(seed)
    turns = np.sort(rng.uniform(0, 2 * np.pi, rng.integers(4, 13)))
    turns = turns[np.append(np.diff(turns), turns[0] + 2 * np.pi - turns[-1]) > 0.1]
    x, y = rng.uniform(4, 6, 2)
    wedges = []
    for start, end in zip(turns, [*turns[1:], turns[0] + 2 * np.pi]):
        rim = np.linspace(start, end, 8)
        wedges.append(shapely.Polygon([(x, y), *zip(x + 20 * np.cos(rim), y + 20 * np.sin(rim))]))
    return wedges, rng.choice([3.0, 4.0, 5.0, 7.0, 9.5], len(wedges)).tolist()


@pytest.mark.parametrize("seed", range(40))
def test_many_roofs_meeting_in_a_point(seed):
    wedges, heights = star(seed)
    solids, partition = build(box(0, 0, 10, 10), wedges, heights)
    if any(solid.unrepaired_nodes for solid in solids):  # corners too sharp to be cut: the check says so
        assert any(check_solid(solid) for solid in solids)
    else:
        assert_sound(solids)
        expected = sum(cell.polygon.area * cell.height for cell in partition)
        assert sum(map(volume, solids)) == pytest.approx(expected, abs=0.1)


def test_courtyard_touching_the_outline():
    footprint = box(0, 0, 10, 10) - shapely.Polygon([(10, 5), (7, 7), (4, 5), (7, 3)])
    assert footprint.area == pytest.approx(100 - 12)
    solids, _ = build(footprint, [box(0, 0, 10, 10)], [6])
    assert len(solids) == 1 and solids[0].mended_nodes == 1
    assert_sound(solids)
    assert volume(solids[0]) == pytest.approx(6 * 88, abs=0.01)


def test_two_courtyards_touching():
    holes = [[(2, 2), (2, 5), (5, 5), (5, 2)], [(5, 5), (5, 8), (8, 8), (8, 5)]]
    solids, _ = build(shapely.Polygon(box(0, 0, 10, 10).exterior, holes), [box(0, 0, 10, 10)], [6])
    assert len(solids) == 1 and solids[0].mended_nodes == 1
    assert_sound(solids)


def test_parts_touching_in_a_point_are_two_solids():
    footprint = shapely.MultiPolygon([box(0, 0, 4, 4), box(4, 4, 8, 8)])
    solids, _ = build(footprint, [box(0, 0, 4, 4), box(4, 4, 8, 8)], [3, 5])
    assert len(solids) == 2
    assert [solid.mended_nodes for solid in solids] == [0, 0]
    assert_sound(solids)


def test_roof_touching_itself_needs_no_mend():
    ring = box(0, 0, 9, 9) - box(3, 3, 6, 6) - box(6, 6, 9, 9)
    solids, _ = build(box(0, 0, 9, 9), [ring, box(3, 3, 6, 6), box(6, 6, 9, 9)], [5, 8, 3])
    assert solids[0].mended_nodes == 0
    assert_sound(solids)


@pytest.mark.parametrize("seed", range(70))
def test_random_partitions_are_valid(seed):
    rng = np.random.default_rng(1000 + seed)
    xs, ys = (np.unique(np.r_[0, rng.integers(1, 20, 3), 20]) for _ in range(2))
    tiles = [box(x0, y0, x1, y1) for x0, x1 in zip(xs, xs[1:]) for y0, y1 in zip(ys, ys[1:])]
    heights = rng.choice([3.0, 4.0, 5.5, 9.0], len(tiles)).tolist()
    open_to_sky = rng.random(len(tiles)) < 0.2
    footprint = shapely.union_all(np.array(tiles)[~open_to_sky])
    angle = rng.uniform(0, 90)
    turn = lambda shape: affinity.rotate(shape, angle, origin=(0, 0))  # noqa: E731
    solids, partition = build(turn(footprint), [turn(tile) for tile in tiles], heights)
    assert_sound(solids)
    expected = sum(cell.polygon.area * cell.height for cell in partition)
    repairs = sum(solid.mended_nodes for solid in solids)
    assert sum(map(volume, solids)) == pytest.approx(expected, rel=1e-12, abs=0.01 * repairs)


@pytest.mark.parametrize("name", ["T node", "courtyard", "four levels"])
def test_national_coordinates_change_nothing(name):
    footprint, roofs, heights = PLANS[name]
    solids, _ = build(footprint, roofs, heights)
    far, _ = build(affinity.translate(footprint, 5e5, 5e6), [affinity.translate(r, 5e5, 5e6) for r in roofs], heights)
    assert far[0].faces == solids[0].faces
    assert np.abs(far[0].vertices - solids[0].vertices - (5e5, 5e6, 0)).max() < 1e-6
    assert_sound(far)


def test_roofs_at_or_below_the_base_are_raised_and_counted():
    solids, _ = build(box(0, 0, 8, 5), [box(0, 0, 3, 5), box(3, 0, 8, 5)], [-1, 6])
    assert solids[0].raised_roofs == 1
    assert volume(solids[0]) == pytest.approx(15 * 0.1 + 25 * 6)
    assert_sound(solids)


def test_nearly_equal_heights_become_one():
    solids, _ = build(box(0, 0, 8, 5), [box(0, 0, 3, 5), box(3, 0, 8, 5)], [4.0, 4.0006])
    assert "inner wall" not in solids[0].surface_type
    assert_sound(solids)


def test_polygons_of_a_solid():
    solids, _ = build(*PLANS["courtyard"])
    shapes = surfaces(solids[0])
    assert shapely.has_z(shapes).all() and len(shapes) == len(solids[0].faces)
    ground = shapes[solids[0].surface_type.index("ground")]
    assert len(ground.interiors) == 1 and not ground.exterior.is_ccw
    whole = multipolygon(solids)
    assert whole.geom_type == "MultiPolygon" and whole.has_z and len(whole.geoms) == len(shapes)


def test_refusals():
    cells = (Cell(box(0, 0, 2, 2), "a", 3.0), Cell(box(0, 0, 2, 2), "b", 4.0))
    with pytest.raises(InputError, match="overlap"):
        building_solids(cells, 0.0)
    with pytest.raises(InputError, match="base height"):
        building_solids(cells[:1], float("nan"))
    assert building_solids((), 0.0) == ()


# Rings of polygons are those of shapely, whatever the polygons are


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


# Faces cut into triangles: whole area, only the face's own vertices, by both ways


FACES = {
    "square": [[(0, 0), (4, 0), (4, 4), (0, 4)]],
    "points along a side": [[(0, 0), (1, 0), (3, 0), (4, 0), (4, 2), (4, 4), (0, 4), (0, 3), (0, 1)]],
    "comb": [[(0, 0), (7, 0), (7, 3), (6, 3), (6, 1), (5, 1), (5, 3), (4, 3), (4, 1), (3, 1), (3, 3), (0, 3)]],
    "hole": [[(0, 0), (6, 0), (6, 6), (0, 6)], [(2, 2), (2, 4), (4, 4), (4, 2)]],
    "three holes": [[(0, 0), (9, 0), (9, 6), (0, 6)], [(1, 1), (1, 2), (2, 2), (2, 1)],
                    [(4, 3), (4, 5), (5, 5), (5, 3)], [(6, 1), (6, 2), (8, 2), (8, 1)]],
    "hole touching the outer ring": [[(0, 0), (6, 0), (6, 6), (0, 6)], [(0, 0), (1, 3), (3, 1)]],
}


def laid(rings, turn):
    """Vertices in space and index rings of a flat face, standing upright or not."""
    points = list(dict.fromkeys(point for ring in rings for point in ring))
    flat = np.column_stack([np.array(points, dtype=float), np.zeros(len(points))])
    return flat @ turn.T, [[points.index(p) for p in ring] for ring in rings]


@pytest.mark.parametrize("turn", [np.eye(3), np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]),
                                  np.array([[0.6, 0, 0.8], [0, 1, 0], [-0.8, 0, 0.6]])])
@pytest.mark.parametrize("name", FACES)
def test_area_and_sense(name, turn):
    rings = FACES[name]
    vertices, face = laid(rings, turn.astype(float))
    area = shapely.Polygon(rings[0], rings[1:]).area
    place = {i: (p @ turn)[:2] for i, p in enumerate(vertices)}
    place = {i: (float(p[0]), float(p[1])) for i, p in place.items()}
    for triangles in (triangulate_face(vertices, face), clip_ears(place, face)):
        corners = vertices[np.array(triangles)]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        up = turn[:, 2]
        assert (across @ up > 0).all()
        assert (across @ up).sum() == pytest.approx(area)
        corners, touching = sum(map(len, face)), sum(map(len, face)) - len(vertices)
        assert len(triangles) == corners - 2 + 2 * (len(face) - 1) - 2 * touching


def test_a_ring_without_an_inside_is_refused():
    place = {0: (0.0, 0.0), 1: (0.0, 4.0), 2: (4.0, 4.0), 3: (4.0, 0.0)}
    with pytest.raises(ValueError, match="cannot be cut"):
        clip_ears(place, [[0, 1, 2, 3]])


def test_a_face_whose_hole_leaves_it_is_refused():
    outer = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    with pytest.raises(ValueError, match="cannot be cut"):
        triangulate_face(np.array([*outer, *outer], float), [(0, 1, 2, 3), (7, 6, 5, 4)])
