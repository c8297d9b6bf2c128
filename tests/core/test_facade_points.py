"""Points and planes of facades."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError
from urbanmap_qgis.facades.building_plans import building_plans, outline_edges
from urbanmap_qgis.facades.facade_points import NearestOutline, facade_points, ground_plane
from urbanmap_qgis.facades.normals import voxel_normals
from urbanmap_qgis.facades.statistical_outliers import statistical_outliers
from urbanmap_qgis.facades.wall_planes import wall_segments
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.settings.facades import WallSettings

X0, Y0 = -7000.0, -34000.0


def box(x, y, width, depth):
    return shapely.box(X0 + x, Y0 + y, X0 + x + width, Y0 + y + depth)


def solid_faces(polygon, low, high):
    """All faces of a prism as a MultiPolygon with z."""
    ring = shapely.get_coordinates(shapely.force_2d(polygon.exterior))[:-1]
    if not polygon.exterior.is_ccw:
        ring = ring[::-1]
    top = shapely.Polygon([(*p, high) for p in ring])
    bottom = shapely.Polygon([(*p, low) for p in ring[::-1]])
    walls = [shapely.Polygon([(*a, low), (*b, low), (*b, high), (*a, high)])
             for a, b in zip(ring, np.roll(ring, -1, axis=0))]
    return shapely.MultiPolygon([bottom, top, *walls])


def test_plans_of_outlines_and_solids_are_the_same():
    outline = box(0, 0, 20, 10)
    plans = building_plans([outline, solid_faces(outline, 3.0, 18.5), None], [4, 7, 9])
    assert plans.plan[0].equals(outline) and plans.plan[1].symmetric_difference(outline).area < 1e-6
    assert plans.plan[2] is None
    assert np.isnan(plans.top[[0, 2]]).all()
    assert plans.base[1] == 3.0 and plans.top[1] == 18.5


def test_an_outline_with_one_z_tells_no_height():
    plans = building_plans([shapely.force_3d(box(0, 0, 5, 5), 12.0)], [1])
    assert np.isnan(plans.base[0]) and np.isnan(plans.top[0])


def test_bad_plans_are_refused():
    with pytest.raises(InputError, match="same building_id"):
        building_plans([box(0, 0, 5, 5)] * 2, [1, 1])
    with pytest.raises(InsufficientDataError, match="No building has a polygon"):
        building_plans([None, shapely.Point(1, 2)], [1, 2])


@pytest.mark.parametrize("turned", [False, True])
def test_edges_face_outwards_also_in_courtyards(turned):
    outer, hole = box(0, 0, 20, 10), box(5, 3, 4, 4)
    plan = outer.difference(hole)
    ends, outward = outline_edges(shapely.reverse(plan) if turned else plan)
    assert len(ends) == 8
    middle = ends.mean(axis=1)
    just_out, just_in = shapely.points(middle + 0.01 * outward), shapely.points(middle - 0.01 * outward)
    assert not shapely.contains(plan, just_out).any() and shapely.contains(plan, just_in).all()
    along = ends[:, 1] - ends[:, 0]
    assert (along[:, 0] * -outward[:, 1] - along[:, 1] * -outward[:, 0] > 0).all()  # the building at the left


def test_lookup_agrees_with_exact_distances():
    rng = np.random.default_rng(3)
    shapes = [box(0, 0, 20, 10), box(22, 0, 15, 10), box(0, 14, 37, 12).difference(box(10, 17, 12, 6)),
              box(140, 3, 8, 8)]
    plans = building_plans(shapes, range(4))
    x, y = X0 + rng.uniform(-12, 160, 20_000), Y0 + rng.uniform(-12, 40, 20_000)
    row, distance = NearestOutline(plans, 4.0).of(x, y)
    points = shapely.points(x, y)
    outside = np.array([shapely.distance(shape, points) for shape in shapes])
    exact = outside.min(axis=0)
    inside = exact == 0
    assert (row[exact > 4.5] == -1).all() and np.isinf(distance[exact > 4.5]).all()
    assert (row[exact < 3.5] >= 0).all()
    assert (row[inside] == outside.argmin(axis=0)[inside]).mean() > 0.985
    assert (distance[inside] <= 0.36).all()
    near = ~inside & (exact < 3.5)
    assert np.abs(distance[near] - exact[near]).max() < 0.4
    second = np.sort(outside, axis=0)[1]
    clear = near & (second - exact > 0.6)
    assert (row[clear] == outside.argmin(axis=0)[clear]).all()


def test_ground_plane_ignores_what_lies_above_and_a_few_points_below():
    rng = np.random.default_rng(5)
    xy = rng.uniform(0, 30, (400, 2))
    z = 10.0 + 0.03 * xy[:, 0] - 0.02 * xy[:, 1] + rng.normal(0, 0.02, 400)
    z[:120] += rng.uniform(1, 12, 120)
    z[120:126] -= 3.0
    plane = ground_plane(xy, z)
    assert plane == pytest.approx([10.0, 0.03, -0.02], abs=0.05)


def test_few_cells_give_a_level_ground():
    assert ground_plane(np.zeros((3, 2)), np.array([5.0, 5.1, 9.0])) == pytest.approx([5.0, 0, 0], abs=0.1)


@pytest.fixture
def street(make_cloud, tmp_path):
    """A wall of 30 m height along the south side of a building, a pavement, a car; on a slope of 2 %."""
    rng = np.random.default_rng(1)
    n = 6000
    wall = np.column_stack([rng.uniform(0, 20, n), np.full(n, -0.5), rng.uniform(0, 30, n)])
    ground = np.column_stack([rng.uniform(-5, 25, n), rng.uniform(-8, -0.5, n), np.zeros(n)])
    car = np.column_stack([rng.uniform(5, 9, 500), rng.uniform(-5, -3.2, 500), rng.uniform(0.3, 1.6, 500)])
    points = np.concatenate([wall, ground, car])
    points[:, 2] += 11.0 + 0.02 * points[:, 0]
    return make_cloud(tmp_path / "survey.laz", X0 + points[:, 0], Y0 + points[:, 1], points[:, 2],
                      gps_time=np.linspace(100, 160, len(points)))


def collected(path, plans, **settings):
    with facade_points(open_cloud([path]), plans, WallSettings(**settings)) as buildings:
        return dict(buildings)


def test_points_below_the_height_above_sloping_ground(street):
    plans = building_plans([box(0, 0, 20, 10), box(200, 0, 5, 5)], [1, 2])
    found = collected(street, plans, max_height=12.0)
    assert list(found) == [0]
    points = found[0]
    assert points.ground[1:] == pytest.approx([0.02, 0.0], abs=0.003)
    height = points.points[:, 2] - 11.0 - 0.02 * (points.points[:, 0] - X0)
    assert height.min() > -0.1 and 11.7 < height.max() < 12.1
    assert (points.points[:, 1] - Y0 > -2.4).all() and np.isfinite(points.time).all()
    beyond = points.front[:, 1] - Y0
    assert (beyond < -3).sum() > 50, "what stands before the facade is kept thinned"


def test_a_building_with_too_many_points_is_thinned_and_says_so(street):
    plans = building_plans([box(0, 0, 20, 10)], [1])
    points = collected(street, plans, max_points=1500)[0]
    assert len(points.points) < 2000 and points.kept_share < 0.3


def test_a_survey_of_another_place_is_told(street):
    plans = building_plans([box(2000, 0, 20, 10)], [1])
    with pytest.raises(InsufficientDataError, match="same place"):
        collected(street, plans)


def test_settings_are_checked():
    with pytest.raises(InputError, match="greater than 0"):
        WallSettings(max_height=0)
    with pytest.raises(InputError, match="Tolerance of the outlines"):
        WallSettings(reach=0.0)


def wall(rng, n, azimuth, lean=0.0, noise=0.01):
    """Points of a wall of 10 x 6 m through a far place, and its normal."""
    turn, tilt = np.radians(azimuth), np.radians(lean)
    normal = np.array([np.sin(turn) * np.cos(tilt), np.cos(turn) * np.cos(tilt), np.sin(tilt)])
    along = np.array([-np.cos(turn), np.sin(turn), 0.0])
    up = np.cross(along, normal)
    uv = rng.uniform([0, 0], [10, 6], (n, 2))
    points = np.array([-7000.0, -34000.0, 20.0]) + uv[:, :1] * along + uv[:, 1:] * up
    return points + rng.normal(0, noise, (n, 1)) * normal, normal


@pytest.mark.paper("J 5.7, normals")
@pytest.mark.parametrize(("azimuth", "lean"), [(0, 0), (37, 0), (200, 8), (271, -12)])
def test_normals_of_walls(azimuth, lean):
    rng = np.random.default_rng(azimuth)
    points, normal = wall(rng, 6000, azimuth, lean)
    voxels = voxel_normals(points)
    angle = np.degrees(np.arccos(np.minimum(np.abs(voxels.normal @ normal), 1)))
    assert np.median(angle) < 1.0 and np.quantile(angle, 0.95) < 4.0
    assert voxels.upright.mean() > 0.97
    assert np.median(voxels.thickness) == pytest.approx(0.01, abs=0.002)


def test_voxels_hold_their_points():
    rng = np.random.default_rng(2)
    points = rng.uniform([-7000, 5000, 3], [-6995, 5004, 6], (3000, 3))
    voxels = voxel_normals(points)
    assert voxels.count.sum() == 3000
    for voxel in (0, 11, len(voxels.count) - 1):
        own = points[voxels.of_point == voxel]
        assert own.mean(axis=0) == pytest.approx(voxels.mean[voxel], abs=1e-6)
        assert (np.ptp(own, axis=0) <= voxels.size + 1e-6).all()
    # The covariance of a neighbourhood against numpy's own.
    at = int(np.argmax(voxels.support))
    around = np.abs(voxels.index - voxels.index[at]).max(axis=1) <= 1
    near = points[np.isin(voxels.of_point, np.flatnonzero(around))]
    assert len(near) == voxels.support[at]
    values = np.sqrt(np.linalg.eigvalsh(np.cov(near.T, bias=True)))
    assert [voxels.thickness[at], voxels.extent[at]] == pytest.approx(values[:2].tolist(), rel=1e-6)


@pytest.mark.paper("J 5.7, normals")
def test_roofs_ground_and_foliage_are_no_walls():
    rng = np.random.default_rng(4)
    flat = np.column_stack([rng.uniform(0, 10, (5000, 2)), 3 + rng.normal(0, 0.01, 5000)])
    assert not voxel_normals(flat).upright.any()
    bank = wall(rng, 5000, 77, 50)[0]
    assert not voxel_normals(bank).upright.any() and np.isnan(voxel_normals(bank).normal).mean() > 0.9
    leaves = rng.uniform(0, 4, (5000, 3))
    assert voxel_normals(leaves).upright.mean() < 0.02


def test_voxels_grow_where_points_are_thin():
    rng = np.random.default_rng(6)
    dense, thin = wall(rng, 6000, 20)[0], wall(rng, 250, 20)[0]
    assert voxel_normals(dense).size < voxel_normals(thin).size
    assert voxel_normals(thin).upright.mean() > 0.8


@pytest.mark.paper("J 5.7, outliers")
def test_outliers_are_lonely_points():
    rng = np.random.default_rng(7)
    places = np.concatenate([rng.uniform(0, 5, (2000, 3)) * (1, 1, 0.01), [[2, 2, 3.0], [9, 9, 9.0]]])
    found = statistical_outliers(places)
    assert found[-2:].all() and found[:-2].mean() < 0.02


def test_few_points_have_no_outliers_and_bad_settings_are_refused():
    assert not statistical_outliers(np.eye(3)).any()


ORIGIN = np.array([-7000.0, -34000.0])


def facade(rng, start, end, low, high, density=40.0, noise=0.01):
    """Points on an upright wall between two places in plan."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    length = np.hypot(*(end - start))
    n = int(length * (high - low) * density)
    along = (end - start) / length
    normal = np.array([along[1], -along[0]])
    xy = start + rng.uniform(0, length, (n, 1)) * along + rng.normal(0, noise, (n, 1)) * normal
    return np.column_stack([xy + ORIGIN, rng.uniform(low, high, n)])


def segments_of(points, plan, **settings):
    ends, outward = outline_edges(shapely.transform(plan, lambda c: c + ORIGIN))
    return wall_segments(points, np.full(len(points), np.nan), ends, outward, WallSettings(**settings))


def azimuths(segments):
    return [round(np.degrees(np.arctan2(*segment.plane.normal[:2])) % 360.0) for segment in segments]


@pytest.mark.paper("J 5.7, segments")
def test_walls_of_a_recess_are_parted():
    """A front with a bay 0.8 m deep: planes 0.8 m apart, and of its narrow cheeks at least one."""
    rng = np.random.default_rng(1)
    walls = [((0, 0), (6, 0)), ((6, 0), (6, 0.8)), ((6, 0.8), (12, 0.8)), ((12, 0.8), (12, 0)), ((12, 0), (20, 0))]
    points = np.concatenate([facade(rng, *wall, 1, 15) for wall in walls])
    found = segments_of(points, shapely.box(0, 0, 20, 12))
    depth = sorted(round(float(s.plane.distance(np.array([*ORIGIN, 8.0])[None])[0]), 2)
                   for s in found if azimuths([s]) == [180])
    assert depth == pytest.approx([0.0, 0.0, 0.8], abs=0.01) or depth == pytest.approx([0.0, 0.8], abs=0.01)
    cheeks = [azimuth for azimuth in azimuths(found) if azimuth != 180]
    assert cheeks and all(min(abs(azimuth - 90), abs(azimuth - 270)) <= 2 for azimuth in cheeks)


def test_an_outline_that_is_off_and_turned_does_not_bind():
    rng = np.random.default_rng(2)
    points = np.concatenate([facade(rng, (0, 0), (20, 0), 0, 15), facade(rng, (20, 0), (20, 10), 0, 15)])
    outline = shapely.affinity.translate(shapely.affinity.rotate(shapely.box(0, 0, 20, 10), 4.0), 0.9, -0.7)
    found = segments_of(points, outline)
    assert azimuths(found) == [180, 90]
    for segment, axis, value in zip(found, (1, 0), (0.0, 20.0)):
        assert segment.plane.point[axis] - ORIGIN[axis] == pytest.approx(value, abs=0.003)
        assert segment.plane.rmse == pytest.approx(0.01, rel=0.1)


def test_walls_without_any_edge_of_the_outline_are_found():
    rng = np.random.default_rng(3)
    diagonal = facade(rng, (2, 2), (8, 8), 0, 12)
    found = segments_of(diagonal, shapely.box(0, 0, 20, 20))
    assert len(found) == 1 and azimuths(found)[0] in (135, 315)


def test_a_round_tower_gives_facets_all_round():
    rng = np.random.default_rng(4)
    turn = np.linspace(0, 2 * np.pi, 25)
    corners = 9.0 * np.column_stack([np.cos(turn), np.sin(turn)])
    points = np.concatenate([facade(rng, a, b, 0, 15) for a, b in zip(corners[:-1], corners[1:])])
    found = segments_of(points, shapely.Polygon(corners))
    covered = np.concatenate([segment.points for segment in found])
    assert len(np.unique(covered)) / len(points) > 0.9
    for segment in found:
        radial = segment.plane.point[:2] - ORIGIN
        assert radial @ segment.plane.normal[:2] > 0, "outwards"


def test_ground_foliage_and_a_car_make_no_walls():
    rng = np.random.default_rng(5)
    ground = np.column_stack([rng.uniform(0, 20, 8000), rng.uniform(-2, 0, 8000), rng.normal(0, 0.01, 8000)])
    leaves = rng.uniform([5, -2, 3], [9, -0.2, 6], (3000, 3))
    points = np.concatenate([ground, leaves])
    points[:, :2] += ORIGIN
    assert segments_of(points, shapely.box(0, 0, 20, 10)) == []


def test_walls_on_one_plane_far_apart_are_two():
    rng = np.random.default_rng(6)
    points = np.concatenate([facade(rng, (0, 0), (6, 0), 0, 10), facade(rng, (11, 0), (20, 0), 0, 10)])
    assert len(segments_of(points, shapely.box(0, 0, 20, 10))) == 2
    assert len(segments_of(points, shapely.box(0, 0, 20, 10), max_gap=8.0)) == 1


def test_edges_of_a_building_of_two_parts_are_those_of_both():
    apart = shapely.multipolygons([shapely.box(0, 0, 5, 5), shapely.box(8, 0, 12, 5)])
    ends, outward = outline_edges(apart)
    assert len(ends) == 8 and sorted(set(ends[:, :, 0].ravel())) == [0, 5, 8, 12]
    middle = ends.mean(axis=1)
    assert not shapely.contains_xy(apart, *(middle + 0.1 * outward).T).any()
    assert shapely.contains_xy(apart, *(middle - 0.1 * outward).T).all()


def test_nothing_from_nothing():
    ends, outward = outline_edges(shapely.box(0, 0, 5, 5))
    assert wall_segments(np.zeros((0, 3)), np.zeros(0), ends, outward) == []
    assert wall_segments(np.random.default_rng(1).random((12, 3)), np.zeros(12), ends, outward) == []


def test_cancelling_and_bad_settings():
    rng = np.random.default_rng(7)
    points = facade(rng, (0, 0), (20, 0), 0, 15)
    ends, outward = outline_edges(shapely.transform(shapely.box(0, 0, 20, 10), lambda c: c + ORIGIN))
    with pytest.raises(Cancelled):
        wall_segments(points, np.zeros(len(points)), ends, outward, progress=Progress(cancelled=lambda: True))
    with pytest.raises(InputError):
        WallSettings(tolerance=0)
