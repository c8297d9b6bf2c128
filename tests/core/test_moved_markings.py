"""Markings that a shift brings back: whatever shift is tried, the reference is read as far as it leads."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.mobile.registration.correction.moved_markings import LIMITS, _on_markings


class Painted:
    """A reference that is painted everywhere, read where it is asked for."""

    def coverage(self, x_min, y_min, x_max, y_max):
        grid = Grid.covering(x_min, y_min, x_max, y_max, 0.1)
        return SimpleNamespace(grid=grid, share=np.ones(grid.shape))


def test_all_shifts_are_looked_up_whole():
    place = np.random.default_rng(2).uniform(0.0, 20.0, (50, 2))
    corner = np.array([-LIMITS.reach, 0.0, LIMITS.reach])
    assert _on_markings(SimpleNamespace(reference=Painted()), place, corner).tolist() == [50] * 9
