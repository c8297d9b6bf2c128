"""Which points lie near a place of the map, for a few places among many points."""

from __future__ import annotations

import numpy as np


class SweepIndex:
    """Points (n, 2) in the order of their first coordinate: cheaper to set up than a tree where few places are asked.

    Parameters
    ----------
    plan : m.
    """

    def __init__(self, plan: np.ndarray):
        self._order = np.argsort(plan[:, 0])
        self._plan = plan[self._order]

    def near(self, place: np.ndarray, distance: float) -> np.ndarray:
        """Rows (m,) of the points within `distance`, m, of a place (2,)."""
        first, last = np.searchsorted(self._plan[:, 0], [place[0] - distance, place[0] + distance], side="left")
        off = self._plan[first:last] - place
        return self._order[first:last][np.einsum("ij,ij->i", off, off) <= distance**2]
