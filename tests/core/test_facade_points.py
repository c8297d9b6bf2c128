"""Which points of a survey can lie on facades: outlines, reach, height above ground."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.facades.building_plans import building_plans, outline_edges
from urbanmap_qgis.facades.facade_points import NearestOutline, facade_points, ground_plane
from urbanmap_qgis.io.points.pointcloud import open_cloud
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
