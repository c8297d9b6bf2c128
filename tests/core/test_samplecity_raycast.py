"""Beams of the sample city against brute force and closed formulas."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from urbanmap_qgis.samplecity.laser.raycast import Hit, RayCaster
from urbanmap_qgis.samplecity.laser.surfaces import hit_material
from urbanmap_qgis.samplecity.scene.faces import box_faces
from urbanmap_qgis.samplecity.scene.model import GROUND, Material
from urbanmap_qgis.samplecity.scene.world import make_scene

RANGE = 120.0


@pytest.fixture(scope="module")
def city():
    return make_scene(100, "elevated road", 4)


@pytest.fixture(scope="module")
def caster(city):
    return RayCaster(city, GROUND)


@pytest.fixture(scope="module")
def rays(city):
    """Rays from a vehicle's height on the avenue and from the air, every way."""
    random = np.random.default_rng(8)
    n = 1500
    direction = random.normal(size=(n, 3))
    direction[n // 2:, 2] = -3.0 * np.abs(direction[n // 2:, 2]) - 1.0
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    x, y = city.ground.to_world(random.uniform(-45, 45, n), random.uniform(-6, 6, n))
    z = np.where(np.arange(n) < n // 2, city.ground_height(x, y) + 2.2, 110.0)
    return np.column_stack([x, y, z]), direction, random.uniform(0.0, 60.0, n)


def nearest_triangle(corners, origin, direction):
    """Moeller and Trumbore on two triangles a face, every ray with every face; distance and face of the nearest."""
    best, face = np.full(len(origin), np.inf), np.full(len(origin), -1)
    for number, (a, b, c, d) in enumerate(corners):
        for p, q, r in ((a, b, c), (a, c, d)):
            edge1, edge2 = q - p, r - p
            if np.linalg.norm(np.cross(edge1, edge2)) < 1e-9:
                continue
            across = np.cross(direction, edge2)
            scale = across @ edge1
            with np.errstate(divide="ignore", invalid="ignore"):
                offset = origin - p
                u = np.einsum("ij,ij->i", offset, across) / scale
                turned = np.cross(offset, edge1)
                v = np.einsum("ij,ij->i", direction, turned) / scale
                t = turned @ edge2 / scale
                hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-6) & (t < best)
            best[hit], face[hit] = t[hit], number
    return best, face


def test_beams_end_where_brute_force_says(city, caster, rays):
    origin, direction, _ = rays
    time = 30.0
    hits = caster.cast(origin, direction, time, RANGE)
    triangles, _ = nearest_triangle(city.faces_at(time, GROUND).corners, origin, direction)
    solid = np.isin(hits.source, [Hit.FACE, Hit.VEHICLE])
    assert np.count_nonzero(solid) > 400
    np.testing.assert_allclose(hits.distance[solid], triangles[solid], atol=1e-6)
    other = hits.distance[~solid]
    assert (other <= triangles[~solid] + 1e-6)[np.isfinite(other)].all()
    assert (triangles[~np.isfinite(hits.distance)] > RANGE).all()


def test_ground_is_met_on_its_formula_and_nothing_is_passed_through(city, caster, rays):
    origin, direction, time = rays
    hits = caster.cast(origin, direction, time, RANGE)
    low = hits.source == Hit.GROUND
    assert np.count_nonzero(low) > 200
    point = origin[low] + hits.distance[low, None] * direction[low]
    gap = point[:, 2] - city.ground_height(point[:, 0], point[:, 1])
    kerb = np.abs(gap) > 1e-5
    assert kerb.mean() < 0.02
    assert np.abs(city.ground.kerb_distance(*point[kerb, :2].T)).max(initial=0.0) < 1e-5
    for share in np.linspace(0.0, 0.999, 60):
        place = origin[low] + share * hits.distance[low, None] * direction[low]
        assert (place[:, 2] - city.ground_height(place[:, 0], place[:, 1])).min() > -0.005


def test_moving_vehicles_are_met_where_they_are_at_each_beam_s_time(city, caster):
    vehicle = city.moving(GROUND)[0]
    time = np.linspace(0.0, 3.0, 40)
    x, y = vehicle.position(time)
    z = city.ground_height(x, y)
    hits = caster.cast(np.column_stack([x, y, z + 3.6]), np.tile([0.0, 0.0, -1.0], (len(time), 1)), time, 50.0)
    roof = vehicle.cabin[2] if vehicle.cabin[0] <= 0.0 <= vehicle.cabin[1] else vehicle.height
    np.testing.assert_allclose(hits.distance, 3.6 - roof, atol=1e-6)
    assert (hits.source == Hit.VEHICLE).all() and (hits.index == 0).all()


def test_normals_face_the_beam_and_incidence_is_theirs(caster, rays):
    origin, direction, time = rays
    hits = caster.cast(origin, direction, time, RANGE)
    met = hits.source != Hit.NOTHING
    np.testing.assert_allclose(np.linalg.norm(hits.normal[met], axis=1), 1.0, atol=1e-9)
    np.testing.assert_allclose(-np.einsum("ij,ij->i", hits.normal, direction)[met], hits.cosine[met], atol=1e-12)


def test_leaves_let_the_stated_share_through(city, caster):
    tree = city.trees[0]
    n = 20000
    depth = np.random.default_rng(2).exponential(size=n)
    origin = np.array([tree.x + 0.3, tree.y, tree.z + tree.radius_z + 1.0])
    hits = caster.cast(origin, np.tile([0.0, 0.0, -1.0], (n, 1)), 0.0, 60.0, depth)
    way = 2 * tree.radius_z * np.sqrt(1 - (0.3 / tree.radius) ** 2)
    assert (hits.source == Hit.CROWN).mean() == pytest.approx(1 - np.exp(-way / tree.free_path), abs=0.01)


def test_level_rays_along_the_axes_of_the_grid(caster):
    """Rays that never change cell in one direction, and one that looks straight up."""
    origin = np.array([[-6950.0, -34100.0, 30.0]] * 3)
    direction = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
    expected, _ = nearest_triangle(caster.grid.faces.corners, origin, direction)
    got = caster.cast(origin, direction, 0.0, 200.0, np.full(3, 1e9)).distance
    np.testing.assert_allclose(got, np.where(expected < 200, expected, np.inf), atol=1e-6)


def test_result_does_not_depend_on_the_cut_or_the_executor(caster, rays, monkeypatch):
    origin, direction, time = rays
    leaf = np.random.default_rng(1).exponential(size=len(time))
    whole = caster.cast(origin, direction, time, RANGE, leaf)
    monkeypatch.setattr("urbanmap_qgis.samplecity.laser.raycast.CHUNK", 100)
    with ThreadPoolExecutor(2) as executor:
        pieces = caster.cast(origin, direction, time, RANGE, leaf, executor)
    for name in ("distance", "source", "index", "normal", "cosine"):
        np.testing.assert_array_equal(getattr(whole, name), getattr(pieces, name))


def test_materials_of_what_was_met(city, caster, rays):
    origin, direction, time = rays
    hits = caster.cast(origin, direction, time, RANGE)
    material = hit_material(city, GROUND, origin + np.where(np.isfinite(hits.distance), hits.distance, 0)[:, None]
                            * direction, hits)
    assert (material[hits.source == Hit.NOTHING] == 0).all()
    assert set(material[hits.source == Hit.GROUND]) <= {Material.ASPHALT, Material.PAVEMENT, Material.PLOT,
                                                        Material.PAINT_WHITE, Material.PAINT_YELLOW}
    assert (material[hits.source == Hit.CROWN] == Material.FOLIAGE).all()
    assert {Material.FACADE, Material.GLASS, Material.BRIDGE} <= set(material[hits.source == Hit.FACE])
    assert len(box_faces(city.vehicles_at(0.0, GROUND))) == 5 * len(city.vehicles_at(0.0, GROUND))
