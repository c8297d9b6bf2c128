"""Vehicles taken out by comparing views of the same ground."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.aerial.orthophotos import vehicles
from urbanmap_qgis.aerial.orthophotos.vehicles import composite, darkest, majority_vote, steepest_view

ROAD, PAINT, WHITE_CAR, BLACK_CAR = 80.0, 200.0, 250.0, 20.0


@pytest.fixture
def crossing():
    """Four views of a road with a strip of paint; all see everything."""
    road = np.full((4, 20, 30, 3), ROAD, np.float32)
    road[:, :, 10:20] = PAINT
    return road, np.ones((4, 20, 30), bool)


def test_darkest_drops_a_light_vehicle_and_lets_a_dark_one_win(crossing):
    views, seen = crossing
    views[0, 5:9, 2:6], views[1, 5:9, 12:16] = WHITE_CAR, BLACK_CAR
    image = composite(views, darkest(views, seen))
    assert (image[5:9, 2:6] == ROAD).all()
    assert (image[5:9, 12:16] == BLACK_CAR).all()


def test_vote_drops_both(crossing):
    views, seen = crossing
    views[0, 5:9, 2:6], views[1, 5:9, 12:16] = WHITE_CAR, BLACK_CAR
    image = composite(views, majority_vote(views, seen, 255))
    assert (image[5:9, 2:6] == ROAD).all()
    assert (image[5:9, 12:16] == PAINT).all()


def test_two_views_are_decided_by_the_road_around(crossing):
    views, seen = crossing
    views, seen = views[:2], seen[:2]
    views[0, 5:9, 2:6], views[1, 5:9, 22:26] = WHITE_CAR, BLACK_CAR
    image = composite(views, majority_vote(views, seen, 255))
    assert (image[5:9, 2:6] == ROAD).all() and (image[5:9, 22:26] == ROAD).all()


def test_without_any_agreement_the_darkest_is_taken():
    views = np.array([250.0, 120.0, 30.0], np.float32)[:, None, None, None] * np.ones((1, 5, 5, 3), np.float32)
    assert (majority_vote(views, np.ones((3, 5, 5), bool), 255) == 2).all()


def test_vote_drops_vehicles_in_most_of_the_views(crossing):
    views, seen = crossing
    views[0, 8, 4], views[1, 8, 4] = 130.0, WHITE_CAR
    assert (composite(views, majority_vote(views, seen, 255, box=1))[8, 4] == ROAD).all()


def test_what_is_not_seen_has_no_say(crossing):
    views, seen = crossing
    views[2], seen[2] = 0.0, False
    seen[:, 0, 0] = False
    for number in (darkest(views, seen), majority_vote(views, seen, 255), steepest_view(views[..., 0], seen)):
        assert number[0, 0] == -1 and not (number == 2).any()
        assert (number[1:] >= 0).all()
        assert (composite(views, number)[0, 0] == 0).all()


@pytest.mark.parametrize("order", [(1, 0, 2, 3), (3, 2, 1, 0)])
def test_the_order_of_views_does_not_matter(crossing, order):
    views, seen = crossing
    views += np.random.default_rng(1).normal(0, 3, views.shape).astype(np.float32)
    seen &= np.random.default_rng(2).random(seen.shape) < 0.7
    for choose in (darkest, lambda v, s: majority_vote(v, s, 255)):
        first = composite(views, choose(views, seen))
        again = composite(views[list(order)], choose(views[list(order)], seen[list(order)]))
        np.testing.assert_array_equal(first, again)


def test_nearest_nadir():
    tangents = np.array([[[0.1, 0.3]], [[0.2, 0.2]]], np.float32)
    assert steepest_view(tangents, np.ones((2, 1, 2), bool)).tolist() == [[0, 1]]


def test_a_queue_in_most_views_gives_way_to_the_free_road():
    """Three of four views show the same two waiting vehicles, the fourth the lane line under them."""
    views = np.full((4, 90, 90, 3), ROAD, np.float32)
    views[:, :, 44:47] = PAINT
    views[:3, 20:58, 35:53], views[:3, 60:75, 35:53] = WHITE_CAR, BLACK_CAR
    image = composite(views, majority_vote(views, np.ones((4, 90, 90), bool), 255))
    free = (image == views[3]).all(axis=-1)
    # Corners of vehicles may stay: most of what is round them is road.
    assert free[22:73, 37:51].mean() > 0.97 and free.mean() > 0.98


def test_paint_is_not_erased_by_one_view_without_it():
    """A zebra crossing that three views show stays, although a grey vehicle in the fourth looks like the road."""
    views = np.full((4, 90, 90, 3), ROAD, np.float32)
    for left in range(10, 80, 8):
        views[:, 30:60, left:left + 4] = PAINT
    expected = views[0].copy()
    views[3, 35:55, 20:60] = ROAD * 1.05
    image = composite(views, majority_vote(views, np.ones((4, 90, 90), bool), 255))
    np.testing.assert_array_equal(image, expected)


def test_what_lies_beyond_the_reach_has_no_say():
    rng = np.random.default_rng(4)
    blocks = np.ones((1, 4, 4))
    grey = np.kron(rng.choice([60, 70, 90, 200], (4, vehicles.REACH, vehicles.REACH)), blocks)
    views = np.stack([grey, grey + 1, grey + 2], axis=-1).astype(np.float32)
    seen = np.kron(rng.random((4, vehicles.REACH, vehicles.REACH)) < 0.7, blocks) > 0
    whole = majority_vote(views, seen, 255)
    near = slice(vehicles.REACH - 1, 3 * vehicles.REACH + 1)
    cut = majority_vote(np.ascontiguousarray(views[:, near, near]), np.ascontiguousarray(seen[:, near, near]), 255)
    middle = slice(2 * vehicles.REACH - 1, 2 * vehicles.REACH + 1)
    here = slice(middle.start - near.start, middle.stop - near.start)
    assert np.array_equal(whole[middle, middle], cut[here, here])


@pytest.mark.parametrize("rows", [1, 31, 32, 33, 70])
def test_any_number_of_rows_is_voted_on(rows):
    views = np.full((3, rows, 9, 1), ROAD, np.float32)
    views[0, -1] = WHITE_CAR
    seen = np.ones(views.shape[:3], bool)
    assert set(majority_vote(views, seen, 255)[-1]) <= {1, 2}
    assert (majority_vote(views, np.zeros_like(seen), 255) == -1).all()
