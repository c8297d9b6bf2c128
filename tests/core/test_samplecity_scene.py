"""The sample city's scene, its outlines, and rays cast into it."""

from __future__ import annotations

import sqlite3
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.official.gsi import read_gsi_buildings, reproject
from urbanmap_qgis.samplecity.laser.raycast import Hit, RayCaster
from urbanmap_qgis.samplecity.laser.surfaces import hit_material
from urbanmap_qgis.samplecity.scene.faces import box_faces
from urbanmap_qgis.samplecity.scene.ground import KERB_HEIGHT, Surface
from urbanmap_qgis.samplecity.scene.model import AERIAL, GROUND, FaceKind, Material
from urbanmap_qgis.samplecity.scene.paint import Paint
from urbanmap_qgis.samplecity.scene.world import SCENES, make_scene
from urbanmap_qgis.samplecity.truth import outlines
from urbanmap_qgis.samplecity.truth.geopackage import Layer, write_geopackage
from urbanmap_qgis.samplecity.truth.lines import true_lines
from urbanmap_qgis.samplecity.truth.road_surfaces import REACH, true_carriageway, true_junctions


@pytest.fixture(scope="module")
def canyon():
    return make_scene(200, "canyon", 1)


def test_faces_are_flat_closed_outwards_and_level_where_they_should(canyon):
    faces = canyon.faces_at(100.0, AERIAL)
    assert np.abs(np.einsum("nij,nj->ni", faces.corners, faces.normal) - faces.offset[:, None]).max() < 1e-9
    top = np.isin(faces.kind, [FaceKind.ROOF, FaceKind.PARAPET_TOP])
    assert faces.normal[top, 2].min() > 0.5
    boxes = canyon.vehicles_at(100.0, AERIAL)
    sides = boxes.faces()
    middle = np.repeat(sides.corners.reshape(len(boxes), 5, 4, 3).mean(axis=(1, 2)), 5, axis=0)
    assert (np.einsum("ij,ij->i", sides.normal, sides.corners.mean(axis=1) - middle) > 0).all()


def test_roof_faces_cover_the_plans_exactly(canyon):
    faces = canyon.static_faces(GROUND)
    for building in canyon.buildings:
        area = 0.0
        for corners in faces.corners[(faces.building == building.id)
                                     & np.isin(faces.kind, [FaceKind.ROOF, FaceKind.PARAPET_TOP])]:
            area += shapely.Polygon(corners[:, :2]).area
        assert area == pytest.approx(sum(part.plan.area for part in building.parts), abs=1e-3)


def test_walls_stand_between_roof_and_whatever_is_below(canyon):
    """The area of a building's walls is the length of its outline times its height, less what neighbours cover."""
    faces = canyon.static_faces(GROUND)
    for building in canyon.buildings:
        if building.shape != "curved":
            continue
        part = building.parts[0]
        walls = faces.corners[(faces.building == building.id) & (faces.kind == FaceKind.WALL)]
        area = sum(np.linalg.norm(np.cross(c[1] - c[0], c[3] - c[0])) for c in walls)
        assert area == pytest.approx(part.plan.length * (part.z_top - building.z_base), rel=1e-6)


def test_buildings_stand_within_the_city_beside_the_streets_and_apart(canyon):
    parts = [part.plan for building in canyon.buildings for part in building.parts]
    union = shapely.union_all(parts)
    assert union.area == pytest.approx(sum(part.area for part in parts), abs=1.0)
    assert canyon.extent.buffer(0.5).covers(union)
    corners = shapely.get_coordinates(union)
    assert canyon.ground.kerb_distance(*corners.T).min() > 1.0
    assert {"L", "T", "U", "podium", "curved", "gable", "rectangle"} <= {b.shape for b in canyon.buildings}
    assert any(a.outline.intersection(b.outline).length > 5 for i, a in enumerate(canyon.buildings)
               for b in canyon.buildings[:i] if a.outline.dwithin(b.outline, 0.01))


def test_ground_has_camber_kerb_and_no_other_steps(canyon):
    ground = canyon.ground
    v = np.linspace(-30, 30, 60001)
    x, y = ground.to_world(np.full_like(v, 30.0), v)
    height = canyon.ground_height(x, y) - ground.plane(x, y)
    steps = np.abs(np.diff(height))
    assert np.count_nonzero(steps > 0.01) == 2
    assert steps.max() == pytest.approx(KERB_HEIGHT, abs=0.002)
    crown = np.interp([0.0, 8.69], v, height)
    assert crown[0] - crown[1] == pytest.approx(0.015 * 8.7, abs=0.02)
    u, v = np.random.default_rng(3).uniform(-120, 120, (2, 200_000))
    x, y = ground.to_world(u, v)
    low, high = ground.bounds_of_relief()
    relief = canyon.ground_height(x, y) - ground.plane(x, y)
    assert relief.min() >= low and relief.max() <= high
    near = canyon.ground_height(*ground.to_world(u + 1e-4, v)) - canyon.ground_height(x, y)
    same = canyon.surface_kind(*ground.to_world(u + 1e-4, v)) == canyon.surface_kind(x, y)
    assert np.abs(near[same]).max() < 2e-5


def test_markings_lie_on_the_carriageway_and_paint_is_found_there(canyon):
    paint = canyon.paint(GROUND)
    road = [m for m in canyon.markings_at(GROUND) if m.kind not in ("tactile", "bay")]
    corners = shapely.get_coordinates([m.plan for m in road])
    assert (canyon.surface_kind(*corners.T) == Surface.CARRIAGEWAY).all()
    places = shapely.get_coordinates([m.plan.representative_point() for m in canyon.markings_at(GROUND)])
    assert (paint.marking_at(*places.T) >= 0).all()
    stop = max((m for m in road if m.kind == "stop"), key=lambda m: m.wear)
    x, y = shapely.get_coordinates(shapely.points(np.random.default_rng(1).uniform(
        stop.plan.bounds[:2], stop.plan.bounds[2:], (20000, 2)))).T
    inside = shapely.contains_xy(stop.plan, x, y)
    painted = canyon.ground_material(x[inside], y[inside], GROUND) == Material.PAINT_WHITE
    assert painted.mean() == pytest.approx(1 - stop.wear, abs=0.15)


def test_traffic_keeps_left_and_survey_lanes_are_free(canyon):
    surveyed = {lane for lane in canyon.lanes if lane.survey}
    assert not any(vehicle.lane in surveyed for vehicle in canyon.moving(GROUND))
    for lane in canyon.lanes:
        middle = np.mean([lane.start, lane.end], axis=0)
        ahead = (np.array(lane.end) - lane.start) / lane.length
        street = next(s for s in canyon.ground.streets if s.name == lane.street)
        u, v = canyon.ground.to_local(*middle)
        centre = canyon.ground.to_world(*((u, street.at) if street.along == "u" else (street.at, v)))
        right = np.array([ahead[1], -ahead[0]])
        assert (centre - middle) @ right == pytest.approx(0.5 * lane.width, abs=1e-6) or (
            centre - middle) @ right == pytest.approx(1.5 * lane.width, abs=1e-6)


def test_scenes_differ_as_told(canyon):
    few, repainted, elevated = (make_scene(200, name, 1) for name in SCENES[1:])
    assert len(few.markings_at(GROUND)) < 0.6 * len(canyon.markings_at(GROUND))
    assert set(canyon.markings_at(AERIAL)) == set(canyon.markings_at(GROUND))
    assert set(repainted.markings_at(AERIAL)) != set(repainted.markings_at(GROUND))
    deck = elevated.static_faces(GROUND)
    assert (deck.kind == FaceKind.BRIDGE).any() and not (canyon.static_faces(GROUND).kind == FaceKind.BRIDGE).any()
    u = np.linspace(-100, 100, 50)
    below = elevated.ground_height(*elevated.ground.to_world(u, 0 * u))
    assert deck.corners[deck.kind == FaceKind.BRIDGE][..., 2].min() > below.min() + 4.5


def test_same_seed_same_city():
    first, second, other = make_scene(60, "canyon", 5), make_scene(60, "canyon", 5), make_scene(60, "canyon", 6)
    assert first.buildings == second.buildings and first.markings == second.markings
    assert first.vehicles == second.vehicles
    assert first.buildings != other.buildings


@pytest.mark.parametrize(("size", "scene"), [(-5, "canyon"), (1e9, "canyon"), (float("nan"), "canyon"), (100, "moon")])
def test_bad_parameters_are_refused(size, scene):
    with pytest.raises(InputError):
        make_scene(size, scene, 1)


def test_true_lines_lie_in_the_middle_of_their_paint_and_join_dashes(canyon):
    layer = true_lines(canyon, AERIAL)
    kinds, painted = np.array(layer.fields["class"]), shapely.union_all([
        marking.plan for marking in canyon.markings_at(AERIAL) if marking.kind in ("centre", "edge", "lane", "stop")])
    assert set(kinds) == {"solid", "dashed", "stop line"} and np.count_nonzero(kinds == "stop line") == 36
    covered = np.array([line.intersection(painted).length / line.length for line in layer.geometries])
    assert covered[kinds != "dashed"] == pytest.approx(1.0, abs=1e-6)
    for row in np.flatnonzero(kinds == "dashed"):
        line, dashes = layer.geometries[row], layer.fields["dashes"][row].split(";")
        count = round((line.length + 4.5) / 7.5)
        assert len(dashes) == count and covered[row] == pytest.approx(3.0 * count / line.length, abs=1e-3)
        middles = [line.interpolate(sum(map(float, dash.split("-"))) / 2) for dash in dashes]
        edge = shapely.distance(middles, painted.boundary)
        assert edge == pytest.approx(0.075, abs=1e-3)


def test_rails_stand_every_15_m_within_the_city(canyon):
    boxes = [shapely.minimum_rotated_rectangle(thing.plan) for thing in canyon.furniture]
    rails = [box for box in boxes if box.length == pytest.approx(2 * (6.0 + 0.08), abs=1e-3)]
    along = np.array([canyon.ground.to_local(box.centroid.x, box.centroid.y) for box in rails])
    off = np.abs((along + 91.0 + 7.5) % 15.0 - 7.5)  # the first begins 6 m inside, each is 6 m long
    assert len(rails) > 8 and np.abs(along).max() < 100.0 and (off.min(axis=1) < 1e-3).all()


def test_paint_is_where_it_was_put_and_nowhere_beyond():
    marking = SimpleNamespace(wear=0.0, colour="white", plan=shapely.MultiPolygon([shapely.box(100, 200, 103, 201)]))
    paint = Paint([marking])
    x, y = np.array([(101, 200.5), (101, 100), (101, 900), (0, 200.5), (300, 200.5), (0, 0), (300, 0)], float).T
    assert paint.marking_at(x, y).tolist() == [0, -1, -1, -1, -1, -1, -1]


# True areas of the sample city's roads, against areas reckoned from its streets


def test_carriageways_and_junctions_are_those_of_the_streets():
    scene = make_scene(120.0, "canyon", 3)
    streets, long = scene.ground.streets, scene.size + 2.0 * REACH
    crossings = [(one, other) for one in streets if one.along == "u" for other in streets if other.along == "v"]
    plain = sum(2.0 * street.half_width * long for street in streets)
    plain -= sum(4.0 * one.half_width * other.half_width for one, other in crossings)
    plain -= shapely.union_all(list(scene.ground.islands)).area
    road = true_carriageway(scene)
    rounded = road.area - plain  # corners of kerbs that are rounded off
    assert 0.0 <= rounded < 0.05 * plain
    junctions = true_junctions(scene)
    assert len(junctions) == len(crossings) > 0
    for shape, (one, other) in zip(junctions, crossings):
        centre = scene.ground.plan_to_world(shapely.Point(other.at, one.at))
        assert shape.within(road.buffer(1e-6)) and shape.area > 4.0 * one.half_width * other.half_width * 0.9
        assert np.hypot(*np.subtract(shape.centroid.coords[0], centre.coords[0])) == pytest.approx(0.0, abs=1.0)


@pytest.fixture(scope="module")
def city():
    return make_scene(100, "canyon", 2)


@pytest.fixture(scope="module")
def written(city, tmp_path_factory):
    folder = tmp_path_factory.mktemp("city")
    return folder / "footprints", outlines.write_outlines(city, folder, np.random.SeedSequence(1))


def test_outlines_are_rough_within_the_stated_limits(city):
    plans = {building.id: building.outline for building in city.buildings}
    rough = outlines.rough_outlines(city.buildings, np.random.default_rng(5))
    assert {outline.building for outline in rough} == set(plans)
    for outline in rough:
        true = plans[outline.building]
        reach = outlines.MAX_SHIFT + outlines.DETAIL + np.radians(outlines.MAX_ROTATION) * true.length / 4
        assert outline.plan.is_valid and outline.plan.hausdorff_distance(true) < reach
        assert outline.plan.centroid.distance(true.centroid) < outlines.MAX_SHIFT + 0.1
    shifts = [outline.plan.centroid.distance(plans[outline.building].centroid) for outline in rough]
    assert 0.15 < np.mean(shifts) < 0.5


def test_gml_reads_back_as_the_same_outlines(city, written):
    folder, summary = written
    path, = folder.glob("FG-GML-533946-BldA-*.xml")
    read = reproject(read_gsi_buildings(path), "EPSG:6677")
    expected = outlines.rough_outlines(city.buildings, np.random.default_rng(np.random.SeedSequence(1)))
    assert len(read) == len(expected) == summary["outlines"]
    for got, outline, identity in zip(read.geometries, expected, read.attributes["gml_id"]):
        assert got.hausdorff_distance(outline.plan) < 0.001
        assert summary["building_of"][identity] == outline.building
    assert set(read.attributes["type"]) <= {"堅ろう建物", "普通建物"}


def test_geopackage_holds_the_layers(written):
    folder, summary = written
    with sqlite3.connect(folder / "gsi_buildings.gpkg") as connection:
        assert connection.execute("PRAGMA application_id").fetchone() == (0x47504B47,)
        rows = connection.execute("SELECT geom, gml_id FROM BldA").fetchall()
        assert connection.execute("SELECT geometry_type_name, srs_id, z FROM gpkg_geometry_columns").fetchall() == [
            ("POLYGON", 6677, 0)]
        west, south, east, north = connection.execute(
            "SELECT min_x, min_y, max_x, max_y FROM gpkg_contents").fetchone()
    shapes = [shapely.from_wkb(blob[8:]) for blob, _ in rows]
    assert len(shapes) == summary["outlines"] and all(blob[:4] == b"GP\x00\x01" for blob, _ in rows)
    np.testing.assert_allclose(shapely.total_bounds(shapes), [west, south, east, north])


def test_geopackage_keeps_types_heights_and_empty_layers(tmp_path):
    point = shapely.Point(1.0, 2.0, 3.0)
    write_geopackage(tmp_path / "町.gpkg", [
        Layer("points", [point, point], {"n": np.array([1, 2]), "w": [0.5, None], "t": ["a", "b"], "f": [True, False]}),
        Layer("none", [], {"n": []})])
    with sqlite3.connect(tmp_path / "町.gpkg") as connection:
        rows = connection.execute("SELECT geom, n, w, t, f FROM points").fetchall()
        types = {name: kind for _, name, kind, *_ in connection.execute("PRAGMA table_info(points)")}
    assert [row[1:] for row in rows] == [(1, 0.5, "a", 1), (2, None, "b", 0)]
    assert types == {"fid": "INTEGER", "geom": "BLOB", "n": "INTEGER", "w": "DOUBLE", "t": "TEXT", "f": "BOOLEAN"}
    assert shapely.from_wkb(rows[0][0][8:]).equals(point) and shapely.from_wkb(rows[0][0][8:]).has_z


RANGE = 120.0


@pytest.fixture(scope="module")
def crossing():
    return make_scene(100, "elevated road", 4)


@pytest.fixture(scope="module")
def caster(crossing):
    return RayCaster(crossing, GROUND)


@pytest.fixture(scope="module")
def rays(crossing):
    """Rays from a vehicle's height on the avenue and from the air, every way."""
    random = np.random.default_rng(8)
    n = 1500
    direction = random.normal(size=(n, 3))
    direction[n // 2:, 2] = -3.0 * np.abs(direction[n // 2:, 2]) - 1.0
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    x, y = crossing.ground.to_world(random.uniform(-45, 45, n), random.uniform(-6, 6, n))
    z = np.where(np.arange(n) < n // 2, crossing.ground_height(x, y) + 2.2, 110.0)
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


def test_beams_end_where_brute_force_says(crossing, caster, rays):
    origin, direction, _ = rays
    time = 30.0
    hits = caster.cast(origin, direction, time, RANGE)
    triangles, _ = nearest_triangle(crossing.faces_at(time, GROUND).corners, origin, direction)
    solid = np.isin(hits.source, [Hit.FACE, Hit.VEHICLE])
    assert np.count_nonzero(solid) > 400
    np.testing.assert_allclose(hits.distance[solid], triangles[solid], atol=1e-6)
    other = hits.distance[~solid]
    assert (other <= triangles[~solid] + 1e-6)[np.isfinite(other)].all()
    assert (triangles[~np.isfinite(hits.distance)] > RANGE).all()


def test_ground_is_met_on_its_formula_and_nothing_is_passed_through(crossing, caster, rays):
    origin, direction, time = rays
    hits = caster.cast(origin, direction, time, RANGE)
    low = hits.source == Hit.GROUND
    assert np.count_nonzero(low) > 200
    point = origin[low] + hits.distance[low, None] * direction[low]
    gap = point[:, 2] - crossing.ground_height(point[:, 0], point[:, 1])
    kerb = np.abs(gap) > 1e-5
    assert kerb.mean() < 0.02
    assert np.abs(crossing.ground.kerb_distance(*point[kerb, :2].T)).max(initial=0.0) < 1e-5
    for share in np.linspace(0.0, 0.999, 60):
        place = origin[low] + share * hits.distance[low, None] * direction[low]
        assert (place[:, 2] - crossing.ground_height(place[:, 0], place[:, 1])).min() > -0.005


def test_moving_vehicles_are_met_where_they_are_at_each_beam_s_time(crossing, caster):
    vehicle = crossing.moving(GROUND)[0]
    time = np.linspace(0.0, 3.0, 40)
    x, y = vehicle.position(time)
    z = crossing.ground_height(x, y)
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


def test_leaves_let_the_stated_share_through(crossing, caster):
    tree = crossing.trees[0]
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


def test_materials_of_what_was_met(crossing, caster, rays):
    origin, direction, time = rays
    hits = caster.cast(origin, direction, time, RANGE)
    material = hit_material(crossing, GROUND, origin + np.where(np.isfinite(hits.distance), hits.distance, 0)[:, None]
                            * direction, hits)
    assert (material[hits.source == Hit.NOTHING] == 0).all()
    assert set(material[hits.source == Hit.GROUND]) <= {Material.ASPHALT, Material.PAVEMENT, Material.PLOT,
                                                        Material.PAINT_WHITE, Material.PAINT_YELLOW}
    assert (material[hits.source == Hit.CROWN] == Material.FOLIAGE).all()
    assert {Material.FACADE, Material.GLASS, Material.BRIDGE} <= set(material[hits.source == Hit.FACE])
    assert len(box_faces(crossing.vehicles_at(0.0, GROUND))) == 5 * len(crossing.vehicles_at(0.0, GROUND))
