"""Passes through the same place are told apart by time."""

from __future__ import annotations

import numpy as np

from urbanmap_qgis.mobile.passes import BlockPositions


def passes_of(x, y, time, pieces=1, order=None):
    places = BlockPositions()
    order = np.arange(len(time)) if order is None else order
    for part in np.array_split(order, pieces):
        places.add(x[part], y[part], time[part])
    return places.passes()


def drive(way, speed=10.0, points=20):
    """Times and positions of points along a way that is given as corners."""
    way = np.asarray(way, float)
    lengths = np.hypot(*np.diff(way, axis=0).T)
    at = np.linspace(0, lengths.sum(), int(lengths.sum() / speed * points))
    corner = np.concatenate([[0], np.cumsum(lengths)])
    return np.interp(at, corner, way[:, 0]), np.interp(at, corner, way[:, 1]), 1000.0 + at / speed


def test_one_way_is_one_pass():
    x, y, time = drive([(0, 0), (900, 0)])
    assert passes_of(x, y, time).count == 1


def test_out_and_back_are_two_passes():
    x, y, time = drive([(0, 0), (900, 0), (0, 0)])
    passes = passes_of(x, y, time)
    assert passes.count == 2
    # The second begins once a place is reached again that was left for half a minute: 15 s after the turn.
    assert 1000 + 90 <= passes.starts[0] <= 1000 + 90 + 18
    assert set(passes.of(time[time > 1110])) == {1}


def test_waiting_is_no_new_pass():
    x, y, time = drive([(0, 0), (300, 0)])
    after = time > 1015
    time[after] += 200.0
    wait = np.arange(1015.0, 1215.0, 0.1)
    spot = np.full(len(wait), 150.0)
    assert passes_of(np.concatenate([x, spot]), np.concatenate([y, 0 * spot]), np.concatenate([time, wait])).count == 1


def test_chunks_and_order_do_not_matter():
    x, y, time = drive([(0, 0), (500, 0), (500, 400), (0, 400), (0, 0), (500, 0)])
    turn = np.random.default_rng(3).permutation(len(x))
    a, b = passes_of(x, y, time), passes_of(x, y, time, 7, turn)
    assert a.count >= 2
    assert np.array_equal(a.starts, b.starts)


def test_far_apart_times_cost_no_memory():
    x = np.zeros(2)
    assert passes_of(x, x, np.array([0.0, 1e9])).count == 2
    assert passes_of(np.empty(0), np.empty(0), np.empty(0)).count == 1
