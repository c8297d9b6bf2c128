"""Which roof each piece of a plan belongs to: what its cells say, with short borders and no confetti."""

from __future__ import annotations

import numpy as np
import shapely

from .plan_arrangement import Arrangement

MIN_WIDTH = 0.5
"""Metres; narrower pieces of the plan belong to the neighbour that they touch most."""
THIN_WEIGHT = 1e-3
"""A strip between a dividing line and a wall nearly on it says nothing of the roofs: its cells count this much."""
MAX_SWEEPS = 10


def choose_roofs(cost: np.ndarray, arrangement: Arrangement, smoothness: float,
                 min_roof_area: float) -> np.ndarray:
    """Roof index (n,) of each piece.

    Least cost of the cells plus `smoothness` times the length of borders between roofs, by iterated
    conditional modes; then connected parts smaller than `min_roof_area` join the neighbour that costs least.

    Parameters
    ----------
    cost : (n, k) square metres of wrong cells if the piece goes to the roof.
    smoothness : metres.
    min_roof_area : square metres.
    """
    area = shapely.area(arrangement.pieces)
    thin = 2.0 * area < MIN_WIDTH * shapely.length(arrangement.pieces)
    cost = np.where(thin[:, None], THIN_WEIGHT, 1.0) * cost
    shared = arrangement.shared * smoothness
    chosen = _smooth(cost, shared)
    return without_small_parts(chosen, cost, shared, area, min_roof_area)


def _smooth(cost: np.ndarray, shared: np.ndarray) -> np.ndarray:
    k = cost.shape[1]
    chosen = np.argmin(cost, axis=1)
    for _ in range(MAX_SWEEPS):
        before = chosen.copy()
        for i in range(len(chosen)):
            agree = np.bincount(chosen, shared[i], minlength=k)
            chosen[i] = np.argmin(cost[i] - agree)
        if (chosen == before).all():
            break
    return chosen


def without_small_parts(chosen: np.ndarray, cost: np.ndarray, shared: np.ndarray, area: np.ndarray,
                         min_roof_area: float) -> np.ndarray:
    chosen = chosen.copy()
    k = cost.shape[1]
    for _ in range(len(chosen)):
        part = _connected(chosen, shared > 0)
        part_area = np.bincount(part, area)
        small = np.flatnonzero(part_area < min_roof_area)
        for candidate in small[np.argsort(part_area[small], kind="stable")]:
            members = part == candidate
            contact = np.bincount(chosen[~members], shared[members][:, ~members].sum(axis=0), minlength=k)
            if contact.any():
                total = cost[members].sum(axis=0) - contact
                chosen[members] = np.argmin(np.where(contact > 0, total, np.inf))
                break
        else:  # what is still small stands alone, as a part of the outline of its own
            break
    return chosen


def _connected(chosen: np.ndarray, touching: np.ndarray) -> np.ndarray:
    """Number of the connected part that each piece belongs to, parts being pieces of one roof that touch."""
    same = touching & (chosen[:, None] == chosen[None, :])
    part = np.arange(len(chosen))
    while True:
        lower = np.minimum(part, np.where(same, part[None, :], len(part)).min(axis=1))
        lower = lower[lower]
        if (lower == part).all():
            return np.unique(part, return_inverse=True)[1]
        part = lower
