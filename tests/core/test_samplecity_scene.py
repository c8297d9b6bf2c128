"""The true world of the sample city."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.samplecity.scene.ground import KERB_HEIGHT, Surface
from urbanmap_qgis.samplecity.scene.model import AERIAL, GROUND, FaceKind, Material
from urbanmap_qgis.samplecity.scene.paint import Paint
from urbanmap_qgis.samplecity.scene.world import SCENES, make_scene
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
