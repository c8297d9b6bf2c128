"""Points near a place: the same rows as all distances give."""

from __future__ import annotations

import numpy as np

from urbanmap_qgis.roadmap.objects.sweep_index import SweepIndex


def test_rows_near_a_place_are_those_of_all_distances():
    plan = np.random.default_rng(3).uniform(-20.0, 20.0, (5000, 2))
    plan[::7, 0] = 1.5  # many on one line of the sweep, and on the border of a search
    index = SweepIndex(plan)
    for place in ([0.0, 0.0], [19.5, -19.5], [7.5, 1.0]):
        wanted = np.flatnonzero(((plan - place)**2).sum(axis=1) <= 36.0)
        assert np.sort(index.near(np.array(place), 6.0)).tolist() == wanted.tolist() and len(wanted)
    assert not len(index.near(np.array([100.0, 0.0]), 6.0))
