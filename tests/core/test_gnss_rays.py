"""Rays from satellites past the walls of buildings, in fans too."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import Cancelled, InputError
from urbanmap_qgis.gnss.rays.ray_fans import FanObstacles, RayFan
from urbanmap_qgis.gnss.rays.tracing import WallObstacles, legs_in_line_of_sight, mirror_reflections, rotated_directions
from urbanmap_qgis.gnss.rays.wall_faces import building_walls, is_solid, wall_table
from urbanmap_qgis.localisation.localisation_settings import VehicleScanner
from urbanmap_qgis.localisation.walls.wall_map import WallMap, wall_sigmas
from urbanmap_qgis.localisation.walls.wall_scan import AZIMUTHS, LAYERS, scan_walls
from urbanmap_qgis.progress import Progress


def town(rng, count=60, size=400.0):
    """Blocks at random, some touching, turned by random angles."""
    shapes = []
    for _ in range(count):
        x, y = rng.uniform(0, size, 2)
        block = shapely.box(x, y, x + rng.uniform(5, 30), y + rng.uniform(5, 30))
        shapes.append(shapely.affinity.rotate(block, rng.uniform(0, 90)))
    return building_walls(shapes, None, rng.uniform(5, 60, count), rng.uniform(0, 3, count))


def unit(azimuth, elevation):
    azimuth, elevation = np.radians(azimuth), np.radians(elevation)
    return np.column_stack([np.cos(elevation) * np.sin(azimuth), np.cos(elevation) * np.cos(azimuth),
                            np.sin(elevation)])


def brute_force(walls, start, direction):
    """Distance to the first wall, by testing every one: a ray in 3D against a quadrilateral in its plane."""
    best = np.full(len(start), np.inf)
    for k in range(len(walls)):
        a = np.array([*walls.start[k], walls.low[k, 0]])
        along = np.array([*(walls.end[k] - walls.start[k]), 0.0])
        up = np.array([0.0, 0.0, walls.top[k, 0] - walls.low[k, 0]])
        matrix = np.stack([direction, np.broadcast_to(-along, direction.shape), np.broadcast_to(-up, direction.shape)],
                          axis=-1)
        with np.errstate(all="ignore"):
            parallel = np.abs(np.linalg.det(matrix)) < 1e-12
            matrix[parallel] = np.eye(3)
            t, s, h = np.linalg.solve(matrix, (a - start)[..., None])[..., 0].T
        hit = ~parallel & (t > 1e-9) & (s >= 0) & (s <= 1) & (h >= 0) & (h <= 1)
        best = np.where(hit & (t < best), t, best)
    return best


def test_first_hit_is_that_of_testing_every_wall():
    rng = np.random.default_rng(4)
    walls = town(rng)
    start = np.column_stack([rng.uniform(-100, 500, (400, 2)), rng.uniform(0, 40, 400)])
    direction = unit(rng.uniform(0, 360, 400), rng.uniform(-20, 89, 400))
    piece, distance = WallObstacles.of(walls).first_hit(start, direction)
    expected = brute_force(walls, start, direction)
    assert np.array_equal(piece >= 0, np.isfinite(expected))
    assert 50 < np.count_nonzero(piece >= 0) < 350
    assert np.allclose(distance[piece >= 0], expected[piece >= 0], atol=1e-6)


def test_reach_ends_a_ray_before_the_wall():
    obstacles = WallObstacles.of(building_walls([shapely.box(10, -5, 20, 5)], top=np.array([30.0]),
                                                low=np.array([0.0])))
    start, east = np.array([[0.0, 0.0, 2.0]]), np.array([[1.0, 0.0, 0.0]])
    assert obstacles.free(start, east, 9.99)[0] and not obstacles.free(start, east, 10.01)[0]


@pytest.mark.parametrize("direction", [(0, 0, 1), (1, 0, 0), (0, 1, 0), (0, -1, 0), (-1, 0, 0)])
def test_rays_along_the_axes_of_the_grid(direction):
    walls = building_walls([shapely.box(30, -40, 50, 40), shapely.box(-40, 60, 40, 70), shapely.box(-40, -70, 40, -60),
                            shapely.box(-50, -40, -30, 40)], None, np.full(4, 20.0), np.zeros(4))
    piece, distance = WallObstacles.of(walls).first_hit(np.array([[0.0, 0.0, 2.0]]), np.array([direction], float))
    expected = {(0, 0, 1): np.inf, (1, 0, 0): 30, (0, 1, 0): 60, (0, -1, 0): 60, (-1, 0, 0): 30}[direction]
    assert distance[0] == pytest.approx(expected) and (piece[0] < 0) == np.isinf(expected)


def test_inside_a_building_is_told_from_outside():
    rng = np.random.default_rng(8)
    ring = shapely.Polygon(shapely.box(0, 0, 40, 40).exterior.coords, [shapely.box(10, 10, 30, 30).exterior.coords])
    obstacles = WallObstacles.of(building_walls([ring], top=np.array([30.0]), low=np.array([0.0])))
    xy = rng.uniform(-10, 50, (500, 2))
    xy = xy[shapely.distance(ring.boundary, shapely.points(xy)) > 0.01]
    place = np.column_stack([xy, np.full(len(xy), 2.0)])
    assert np.array_equal(obstacles.inside(place), shapely.contains_xy(ring, xy))
    above = place + np.array([0.0, 0.0, 40.0])
    assert not obstacles.inside(above).any()


@pytest.mark.paper("J 5.6")
def test_reflection_obeys_the_mirror_and_the_excess_is_the_longer_way():
    rng = np.random.default_rng(2)
    walls = town(rng, 30, 200.0)
    place = np.column_stack([rng.uniform(0, 200, (40, 2)), np.full(40, 2.0)])
    of_ray = np.repeat(np.arange(40), 25)
    direction = unit(rng.uniform(0, 360, 1000), rng.uniform(5, 80, 1000))
    found = mirror_reflections(walls, place, of_ray, direction, 300.0)
    assert len(found.ray) > 300
    normal = np.column_stack([walls.normal[found.piece], np.zeros(len(found.ray))])
    satellite, antenna = direction[found.ray], place[of_ray[found.ray]]
    back = found.place - antenna
    # Angle in = angle out, and all in one plane.
    assert np.allclose(back / np.linalg.norm(back, axis=1)[:, None] + 0 * satellite,
                       satellite - 2 * np.einsum("ij,ij->i", satellite, normal)[:, None] * normal, atol=1e-9)
    # From a satellite 20,000 km away the way by the wall is longer by the excess.
    far = antenna + 2e7 * satellite
    longer = np.linalg.norm(far - found.place, axis=1) + np.linalg.norm(back, axis=1) - 2e7
    assert np.allclose(longer, found.excess, atol=0.01)
    assert np.allclose(found.length, np.linalg.norm(back, axis=1))
    assert (found.inside >= 0).all()


def test_every_reflection_that_trying_all_walls_finds_is_found():
    rng = np.random.default_rng(3)
    walls = town(rng, 25, 150.0)
    place = np.column_stack([rng.uniform(0, 150, (10, 2)), np.full(10, 2.0)])
    of_ray = np.repeat(np.arange(10), 20)
    direction = unit(rng.uniform(0, 360, 200), rng.uniform(5, 80, 200))
    found = mirror_reflections(walls, place, of_ray, direction, 80.0)
    expected = set()
    for ray in range(200):
        at, way = place[of_ray[ray]], direction[ray]
        for k in range(len(walls)):
            front = walls.normal[k] @ at[:2] - walls.offset[k]
            slope = walls.normal[k] @ way[:2]
            ends = shapely.LineString([walls.start[k], walls.end[k]])
            if front <= 0.05 or slope <= 0.02 or shapely.distance(ends, shapely.Point(at[:2])) >= 80.0:
                continue
            point = at + front / slope * (way - 2 * slope * np.array([*walls.normal[k], 0.0]))
            share = (point[:2] - walls.start[k]) @ (walls.end[k] - walls.start[k]) / ends.length**2
            if 0 <= share <= 1 and walls.low[k, 0] <= point[2] <= walls.top[k, 0]:
                expected.add((ray, k))
    assert expected and set(zip(found.ray.tolist(), found.piece.tolist())) == expected


def test_both_legs_must_be_free():
    # A wall north of the antenna reflects a satellite in the south; things stand in the way of either leg.
    wall = shapely.box(-50, 30, 50, 40)
    antenna, satellite = np.array([[0.0, 0.0, 2.0]]), unit([180.0], [40.0])
    for other, height, free in ((None, 0, True), (shapely.box(-5, 10, 5, 12), 20, False),
                                (shapely.box(-5, -12, 5, -10), 70, False), (shapely.box(-5, -12, 5, -10), 60, True),
                                (shapely.box(20, 10, 25, 12), 60, True)):
        shapes = [wall] if other is None else [wall, other]
        walls = building_walls(shapes, None, np.array([60.0, height])[:len(shapes)], np.zeros(len(shapes)))
        found = mirror_reflections(walls, antenna, np.array([0]), satellite, 100.0)
        found = found.select(np.flatnonzero(found.excess > 40))
        assert len(found.ray) == 1
        assert legs_in_line_of_sight(WallObstacles.of(walls), antenna, satellite, found)[0] == free


def test_walls_without_a_known_foot_reach_down():
    walls = building_walls([shapely.box(10, -5, 20, 5)], top=np.array([30.0]))
    piece, _ = WallObstacles.of(walls).first_hit(np.array([[0.0, 0.0, -500.0]]), np.array([[1.0, 0.0, 0.0]]))
    assert piece[0] >= 0


def test_turned_rays_keep_their_length_and_stay_below_the_zenith():
    direction = unit([10.0, 350.0, 90.0], [20.0, 88.0, 45.0])
    moved = rotated_directions(direction, 5.0, 10.0)
    assert np.allclose(np.linalg.norm(moved, axis=1), 1.0)
    assert np.degrees(np.arcsin(moved[:, 2])) == pytest.approx([30.0, 90.0, 55.0], abs=1e-6)


def test_a_march_can_be_cancelled():
    walls = town(np.random.default_rng(1))
    with pytest.raises(Cancelled):
        WallObstacles.of(walls).first_hit(np.array([[0.0, 0.0, 1.0]]), unit([45.0], [1.0]),
                                          progress=Progress(cancelled=lambda: True))


LENGTH = 60.0


def blocks(seed: int):
    """Turned houses of all heights, some of them over others, a few without a foot, and a sloping parapet."""
    rng = np.random.default_rng(seed)
    shapes, top, low = [], [], []
    for x in range(-80, 80, 14):
        for y in range(-80, 80, 14):
            box = shapely.box(x, y, x + rng.uniform(4, 10), y + rng.uniform(4, 10))
            shapes.append(shapely.affinity.rotate(box, rng.uniform(0, 90)))
            top.append(rng.uniform(1, 15))
            low.append(rng.choice([0.0, np.nan, 6.0]))
    outlines = building_walls(np.array(shapes, object), None, np.array(top) + np.nan_to_num(low), np.array(low))
    raised = outlines.top + np.column_stack([np.zeros(len(outlines)), rng.uniform(0, 3, len(outlines))])
    return outlines.__class__(**{**outlines.__dict__, "top": raised})


def marched(walls, place: np.ndarray, fan: RayFan):
    """What `FanObstacles.first_hits` returns, by rays followed one by one."""
    angle = np.arange(fan.azimuths) * 2 * np.pi / fan.azimuths
    round_, up = np.meshgrid(angle, fan.elevation, indexing="ij")
    direction = np.stack([np.cos(up) * np.sin(round_), np.cos(up) * np.cos(round_), np.sin(up)], axis=2).reshape(-1, 3)
    piece, distance = WallObstacles.of(walls).first_hit(
        np.repeat(place, len(direction), axis=0), np.tile(direction, (len(place), 1)), fan.length)
    shape = (len(place), fan.azimuths, len(fan.elevation))
    return piece.reshape(shape), distance.reshape(shape) * np.cos(fan.elevation)


@pytest.mark.parametrize("seed", [1, 2])
def test_fans_meet_what_single_rays_meet(seed):
    walls = blocks(seed)
    rng = np.random.default_rng(seed)
    # In courts and streets, inside of houses, above the roofs, and far outside.
    place = np.column_stack([rng.uniform(-90, 90, (300, 2)), rng.uniform(0, 20, 300)])
    place = np.concatenate([place, [[500.0, 0.0, 2.0], [-110.0, 3.0, 2.0]]])
    fan = RayFan(97, np.radians([-15.0, -3.0, 0.0, 7.0, 30.0]), LENGTH)
    piece, distance = FanObstacles.of(walls).first_hits(place, fan)
    expected_piece, expected = marched(walls, place, fan)
    assert np.array_equal(piece, expected_piece)
    assert (piece >= 0).mean() > 0.3 and (piece[300] == -1).all()
    assert distance[piece >= 0] == pytest.approx(expected[piece >= 0], rel=1e-9)
    assert np.isinf(distance[piece < 0]).all()


def test_blocks_of_places_change_nothing(monkeypatch):
    walls, place = blocks(3), np.random.default_rng(3).uniform(0, 10, (40, 3))
    fan = RayFan(60, np.zeros(1), LENGTH)
    at_once = FanObstacles.of(walls).first_hits(place, fan)
    monkeypatch.setattr("urbanmap_qgis.gnss.rays.ray_fans._TESTED", 1)
    one_by_one = FanObstacles.of(walls).first_hits(place, fan)
    assert all(np.array_equal(one, other) for one, other in zip(at_once, one_by_one))


def test_a_row_of_a_scan_holds_the_layers_that_end_on_one_piece():
    pieces = blocks(4)
    walls, scanner = WallMap.of(pieces, wall_sigmas(pieces, 0.2)), VehicleScanner("multi-layer")
    sensor = np.random.default_rng(4).uniform(-60, 60, (20, 3)) * [1, 1, 0] + [0, 0, 2.0]
    scan = scan_walls(walls, sensor, scanner)
    piece, distance = marched(pieces, sensor, RayFan(AZIMUTHS, scanner.elevations(LAYERS), scanner.max_range))
    row, layer = np.nonzero(scan.layers)
    assert len(row) == (piece >= 0).sum() > len(scan.of) > 1000
    assert np.array_equal(piece[scan.of[row], scan.ray[row], layer], scan.piece[row])
    assert np.hypot(*scan.offset[row].T) == pytest.approx(distance[scan.of[row], scan.ray[row], layer], rel=1e-9)
    assert scan.distance[row, layer] == pytest.approx(
        np.hypot(*scan.offset[row].T) / np.cos(scanner.elevations(LAYERS))[layer], rel=1e-12)
    # 16 layers of 720 rays, of which 5 of 240 are followed.
    assert scan.weight == pytest.approx(scan.layers.sum(axis=1) * 16 * 720 / (5 * 240))
    assert (np.diff(scan.of) >= 0).all()


def box_solid(x0, y0, x1, y1, low, top, inwards=False):
    """Faces of a block as MultiPolygonZ."""
    a, b, c, d = (x0, y0), (x1, y0), (x1, y1), (x0, y1)
    faces = [[(*p, top) for p in (a, b, c, d)], [(*p, low) for p in (d, c, b, a)]]
    faces += [[(*p, low), (*q, low), (*q, top), (*p, top)] for p, q in ((a, b), (b, c), (c, d), (d, a))]
    if inwards:
        faces = [face[::-1] for face in faces]
    return shapely.MultiPolygon([shapely.Polygon(face) for face in faces])


@pytest.mark.parametrize("inwards", [False, True])
def test_walls_of_a_block_face_outwards_whichever_way_its_faces_turn(inwards):
    solid = box_solid(100, 200, 120, 230, 5, 35, inwards)
    walls = building_walls([solid])
    assert is_solid(solid) and len(walls) == walls.count == 4
    middle = (walls.start + walls.end) / 2
    outwards = middle - [110, 215]
    assert (np.einsum("ij,ij->i", outwards, walls.normal) > 0).all()
    assert np.allclose(np.einsum("ij,ij->i", middle, walls.normal), walls.offset)
    assert np.allclose(walls.low, 5) and np.allclose(walls.top, 35)
    # Outwards is on the right when walking from start to end.
    edge = walls.end - walls.start
    assert np.allclose(np.column_stack([edge[:, 1], -edge[:, 0]]) / np.linalg.norm(edge, axis=1)[:, None], walls.normal)


def test_outline_and_solid_give_the_same_walls():
    outline = building_walls([shapely.box(0, 0, 10, 20)], top=np.array([30.0]), low=np.array([2.0]))
    solid = building_walls([box_solid(0, 0, 10, 20, 2, 30)])

    def rows(walls):
        table = np.column_stack([walls.start, walls.end, walls.low, walls.top, walls.normal, walls.offset])
        return table[np.lexsort(table[:, :4].round(6).T)]

    assert np.allclose(rows(outline), rows(solid))


def test_courtyard_walls_face_the_courtyard_and_rings_may_turn_either_way():
    shape = shapely.Polygon([(0, 0), (0, 30), (30, 30), (30, 0)], [[(10, 10), (20, 10), (20, 20), (10, 20)]])
    walls = building_walls([shape], top=np.array([20.0]))
    outside = (walls.start + walls.end) / 2 + 0.1 * walls.normal
    assert len(walls) == 8
    assert not shapely.contains_xy(shape, outside).any()
    assert np.isneginf(walls.low).all() and np.isnan(wall_table(walls).low).all()


def test_height_of_an_outline_comes_from_its_z_unless_a_field_tells_it():
    shape = shapely.Polygon([(0, 0, 12), (10, 0, 12), (10, 10, 12), (0, 10, 12)])
    assert np.allclose(building_walls([shape]).top, 12)
    assert np.allclose(building_walls([shape], top=np.array([9.0])).top, 9)


def test_gable_is_a_wall_with_a_sloping_edge():
    face = [(0, 0, 0), (8, 0, 0), (8, 0, 6), (4, 0, 10), (0, 0, 6)]
    back = [(x, 12, z) for x, _, z in face[::-1]]
    sides = [[(8, 0, 0), (8, 12, 0), (8, 12, 6), (8, 0, 6)], [(0, 12, 0), (0, 0, 0), (0, 0, 6), (0, 12, 6)]]
    roofs = [[(8, 0, 6), (8, 12, 6), (4, 12, 10), (4, 0, 10)], [(4, 0, 10), (4, 12, 10), (0, 12, 6), (0, 0, 6)]]
    ground = [(0, 0, 0), (0, 12, 0), (8, 12, 0), (8, 0, 0)]
    solid = shapely.MultiPolygon([shapely.Polygon(ring) for ring in (face, back, *sides, *roofs, ground)])
    walls = building_walls([solid])
    assert walls.count == 4 and len(walls) == 6
    gable = walls.normal[:, 1] < -0.9
    ends = {(round(float(x), 3), round(float(z), 3)) for x, z in zip(
        np.r_[walls.start[gable, 0], walls.end[gable, 0]], np.r_[walls.top[gable, 0], walls.top[gable, 1]])}
    assert ends == {(0.0, 6.0), (4.0, 10.0), (8.0, 6.0)}


def test_pieces_in_one_plane_are_one_wall_but_not_across_buildings():
    left, right = shapely.box(0, 0, 10, 10), shapely.box(10, 0, 20, 15)
    tops = np.array([20.0, 20.0])
    together = building_walls([left, right], np.array([7, 7]), tops)
    apart = building_walls([left, right], np.array([7, 8]), tops)
    south = np.flatnonzero(together.normal[:, 1] < -0.9)
    assert len(np.unique(together.wall[south])) == 1
    assert len(np.unique(apart.wall[np.flatnonzero(apart.normal[:, 1] < -0.9)])) == 2
    table = wall_table(together)
    row = together.wall[south[0]]
    assert table.length[row] == pytest.approx(20.0)
    assert sorted(table.edge[table.building == 0]) == list(range(1, together.count + 1))


def test_outlines_without_heights_are_refused_with_a_count():
    with pytest.raises(InputError, match="1 of 2 buildings have no heights"):
        building_walls([shapely.box(0, 0, 1, 1), shapely.box(3, 0, 4, 1)], top=np.array([5.0, np.nan]))
    with pytest.raises(InputError, match="no walls"):
        building_walls([None, shapely.Polygon()], top=np.array([1.0, 1.0]))
