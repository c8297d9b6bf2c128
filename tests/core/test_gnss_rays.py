"""Rays among walls: against brute force, against the geometry of mirrors, at awkward places."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import Cancelled
from urbanmap_qgis.gnss.rays.tracing import WallObstacles, legs_in_line_of_sight, mirror_reflections, rotated_directions
from urbanmap_qgis.gnss.rays.wall_faces import building_walls
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
