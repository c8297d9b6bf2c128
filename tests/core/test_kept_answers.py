"""Answers kept with the thing they were given for, and products of rings."""

import gc
import pickle
import weakref

import numpy as np
import pytest

from urbanmap_qgis.geometry.kept_answers import Kept
from urbanmap_qgis.geometry.ring_products import cross_with_next


class Thing:
    def __init__(self, value):
        self.value = value


def test_each_thing_is_worked_on_once_and_forgotten_with_the_thing():
    asked = []

    @Kept
    def double(thing):
        """Twice its value."""
        asked.append(thing.value)
        return 2 * thing.value

    first, same = Thing(3), Thing(3)
    assert [double(first), double(first), double(same)] == [6, 6, 6] and asked == [3, 3]
    assert double.__name__ == "double" and double.__doc__ == "Twice its value."
    gone = weakref.ref(first)
    del first
    gc.collect()
    assert gone() is None
    assert pickle.loads(pickle.dumps(same)).value == 3


@pytest.mark.parametrize("corners", [1, 3, 8, 50])
def test_products_of_a_ring_are_numpys_to_the_last_digit(corners):
    ring = np.random.default_rng(corners).uniform(-1e5, 1e5, (corners, 3))
    assert np.array_equal(cross_with_next(ring), np.cross(ring, np.roll(ring, -1, axis=0)))
