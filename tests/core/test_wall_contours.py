"""Planes through points of walls, and the contours of walls."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.facades.plane_fit import WallPlane, pass_numbers, robust_plane
from urbanmap_qgis.facades.wall_contours import in_plane, on_map, wall_contours, wall_coverage
from urbanmap_qgis.settings.facades import WallSettings

SIDE = np.array([0.0, -1.0, 0.0])


def points_of(rng, n=2000, noise=0.02, lean=0.0, width=8.0, height=10.0):
    """Points of a wall at y = 0 that looks south and leans back by degrees."""
    x, z = rng.uniform(0, width, n), rng.uniform(0, height, n)
    y = np.tan(np.radians(lean)) * (z - height / 2) + rng.normal(0, noise, n)
    return np.column_stack([x - 7000, y - 34000, z + 12])


def place(plane):
    """y of the plane over the middle of the wall."""
    middle = np.array([-6996.0, -34000.0, 17.0])
    return (middle - plane.distance(middle[None])[0] * plane.normal)[1] + 34000


def test_place_and_noise():
    plane = robust_plane(points_of(np.random.default_rng(1)), np.full(2000, np.nan), SIDE)
    assert place(plane) == pytest.approx(0.0, abs=0.002)
    assert plane.rmse == pytest.approx(0.02, rel=0.08)
    assert plane.normal == pytest.approx([0, -1, 0], abs=0.001) and plane.tilt == 0.0
    assert plane.passes == 1 and np.isnan(plane.pass_spread)


def test_things_before_the_wall_do_not_move_it():
    rng = np.random.default_rng(2)
    points = points_of(rng)
    points[:500, 1] -= rng.uniform(0.06, 0.4, 500)
    plane = robust_plane(points, np.full(2000, np.nan), SIDE)
    assert abs(place(plane)) < 0.004 and plane.points < 1600


@pytest.mark.parametrize("lean", [-3.0, 1.5, 8.0])
def test_leaning_walls(lean):
    plane = robust_plane(points_of(np.random.default_rng(3), lean=lean), np.full(2000, np.nan), SIDE)
    assert plane.tilt == pytest.approx(lean, abs=0.05)
    along, up = plane.axes
    assert np.cross(along, up) == pytest.approx(plane.normal)
    assert along[2] == 0 and up[2] > 0.9


def test_noise_alone_does_not_make_a_wall_lean():
    leans = [robust_plane(points_of(np.random.default_rng(seed), 150, 0.03), np.full(150, np.nan), SIDE).tilt
             for seed in range(40)]
    assert np.count_nonzero(leans) <= 2


def test_sigma_covers_errors_that_square_metres_share():
    """Errors shared within a metre, as of a scan line: the stated sigma is neither far too small nor far too large."""
    normalised = []
    for seed in range(150):
        rng = np.random.default_rng(seed)
        points = points_of(rng, 3000, 0.005)
        block = (np.floor(points[:, 0]) * 100 + np.floor(points[:, 2])).astype(int)
        points[:, 1] += rng.normal(0, 0.02, block.max() - block.min() + 1)[block - block.min()]
        plane = robust_plane(points, np.full(3000, np.nan), SIDE)
        normalised.append(place(plane) / plane.sigma)
    assert 0.6 < np.sqrt(np.mean(np.square(normalised))) < 1.4


def test_passes_that_disagree_show_in_sigma():
    rng = np.random.default_rng(8)
    points, time = points_of(rng), np.repeat([100.0, 500.0], 1000) + np.tile(np.arange(1000) * 0.01, 2)
    points[1000:, 1] += 0.03
    plane = robust_plane(points, time, SIDE)
    assert plane.passes == 2
    assert plane.pass_spread == pytest.approx(0.03 / np.sqrt(2), rel=0.2)
    assert plane.sigma >= 0.9 * plane.pass_spread / np.sqrt(2)


def test_pass_numbers_follow_time_not_order():
    time = np.array([5.0, 400.0, 6.0, 401.0, 7.0])
    assert pass_numbers(time).tolist() == [0, 1, 0, 1, 0]
    assert pass_numbers(np.array([1.0, np.nan])).tolist() == [0, 0]


def test_too_few_points_give_no_plane():
    assert robust_plane(np.zeros((9, 3)), np.zeros(9), SIDE) is None


NAN = float("nan")


def plane_towards(azimuth, lean=0.0):
    turn, tilt = np.radians(azimuth), np.radians(lean)
    normal = np.array([np.sin(turn) * np.cos(tilt), np.cos(turn) * np.cos(tilt), np.sin(tilt)])
    return WallPlane(np.array([-7000.0, -34000.0, 20.0]), normal, 0.01, 0.001, 100, 1, NAN)


def points_on(plane, flat):
    along, up = plane.axes
    return plane.point + flat[:, :1] * along + flat[:, 1:] * up


def wall_with(rng, holes, n=12_000):
    """Places on a wall of 12 x 10 m without those in holes (x, y, width, height)."""
    flat = rng.uniform([-6, -5], [6, 5], (n, 2))
    for x, y, width, height in holes:
        flat = flat[~((flat[:, 0] > x) & (flat[:, 0] < x + width) & (flat[:, 1] > y) & (flat[:, 1] < y + height))]
    return flat


@pytest.mark.paper("J 5.7, contours")
@pytest.mark.parametrize(("azimuth", "lean"), [(0, 0), (133, 0), (250, 6)])
def test_contours_lie_on_the_plane_and_keep_openings(azimuth, lean):
    plane = plane_towards(azimuth, lean)
    rng = np.random.default_rng(1)
    flat = wall_with(rng, [(-4, -2, 2, 3), (1, -5, 2.5, 3)])
    contours = wall_contours(plane, points_on(plane, flat))
    assert len(contours) == 1
    assert contours[0].polygon.area == pytest.approx(120 - 6 - 7.5, rel=0.03)
    assert len(contours[0].polygon.interiors) == 1, "the passage at the foot is open below, no hole"
    assert contours[0].openings == pytest.approx(6 / 112.5, rel=0.15)
    made = on_map(plane, contours[0].polygon)
    corners = shapely.get_coordinates(made, include_z=True)
    assert np.abs(plane.distance(corners)).max() < 1e-6
    ring = shapely.get_coordinates(made.exterior, include_z=True)[:-1]
    away = ring - ring.mean(axis=0)
    area = np.cross(away, np.roll(away, -1, axis=0)).sum(axis=0) / 2
    assert area @ plane.normal > 100, "counterclockwise seen from in front"


def test_small_gaps_are_filled_and_told():
    plane = plane_towards(90)
    flat = wall_with(np.random.default_rng(2), [(-4, 0, 1.2, 1.2), (2, 1, 1.1, 1.1)])
    points = points_on(plane, flat)
    kept, = wall_contours(plane, points, WallSettings(min_opening=0.3))
    filled, = wall_contours(plane, points, WallSettings(min_opening=3.0))
    assert len(kept.polygon.interiors) == 2 and kept.filled < 0.003
    assert not filled.polygon.interiors and filled.filled == pytest.approx(2.2 / 120, rel=0.3)


def test_pieces_far_apart_are_contours_of_their_own_and_crumbs_none():
    plane = plane_towards(10)
    rng = np.random.default_rng(3)
    flat = np.concatenate([rng.uniform([0, 0], [4, 6], (2000, 2)), rng.uniform([9, 0], [12, 6], (1500, 2)),
                           rng.uniform([20, 0], [21, 1], (80, 2))])
    contours = wall_contours(plane, points_on(plane, flat))
    assert [round(contour.polygon.area) for contour in contours] == pytest.approx([24, 18], abs=1)


def test_what_was_seen_and_what_stands_in_front():
    plane = plane_towards(180)
    rng = np.random.default_rng(4)
    tree = (-3, -5, 4, 6)
    contours = wall_contours(plane, points_on(plane, wall_with(rng, [tree])))
    leaves = points_on(plane, rng.uniform([-2.5, -4.5], [0.5, 0.5], (200, 2))) + 3.0 * plane.normal
    seen = wall_coverage(plane, contours, 15.0, 27.0, leaves)
    assert seen.area == pytest.approx(12 * 12, rel=0.02)
    assert seen.coverage == pytest.approx((120 - 24) / 144, abs=0.02)
    assert seen.hidden == pytest.approx(24 / 144, abs=0.03)
    assert seen.coverage + seen.hidden + seen.unseen == pytest.approx(1.0)
    assert seen.unseen == pytest.approx(24 / 144, abs=0.03)
    nothing = wall_coverage(plane, contours, 15.0, 27.0, np.zeros((0, 3)))
    assert nothing.hidden == 0 and nothing.coverage == seen.coverage
    behind = wall_coverage(plane, contours, 15.0, 27.0, leaves - 6.0 * plane.normal)
    assert behind.hidden == 0


def test_pieces_near_each_other_are_one_contour_and_the_gap_is_told():
    """Three pieces of 3 m with gaps of 1 m, as trunks leave them: one contour of 11 m; 2 m apart they are three."""
    rng = np.random.default_rng(8)
    plane = plane_towards(120)
    made = {}
    for gap in (1.0, 2.5):
        along = np.concatenate([start + rng.uniform(0, 3, 3000) for start in (0, 3 + gap, 6 + 2 * gap)])
        flat = np.column_stack([along, rng.uniform(0, 5, len(along))])
        made[gap] = wall_contours(plane, points_on(plane, flat), WallSettings(max_gap=1.5))
    (whole,), apart = made[1.0], made[2.5]
    assert np.ptp(np.array(whole.polygon.bounds)[[0, 2]]) == pytest.approx(11.0, abs=0.2) and len(apart) == 3
    assert whole.filled == pytest.approx(2 * 5 / 55, abs=0.03) and whole.points > 8700
    seen = wall_coverage(plane, [whole], plane.point[2], plane.point[2] + 5.0, np.zeros((0, 3)))
    assert seen.coverage == pytest.approx(45 / 55, abs=0.05)
    # Pieces too small by themselves are a wall together.
    small = np.concatenate([flat[(flat[:, 1] < 0.8)] for flat in [np.column_stack([
        np.concatenate([start + rng.uniform(0, 3, 3000) for start in (0, 4, 8)]), rng.uniform(0, 5, 9000)])]])
    assert len(wall_contours(plane, points_on(plane, small), WallSettings(min_area=4.0, max_gap=1.5))) == 1
    assert not wall_contours(plane, points_on(plane, small), WallSettings(min_area=4.0, max_gap=0.0))


def test_plane_coordinates_are_lengths():
    plane = plane_towards(77, 5)
    flat = np.array([[0.0, 0.0], [3.0, 4.0], [-2.0, 1.0]])
    assert in_plane(plane, points_on(plane, flat)) == pytest.approx(flat, abs=1e-9)


def test_bad_settings():
    with pytest.raises(InputError):
        WallSettings(min_opening=-1.0)
