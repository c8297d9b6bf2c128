"""Which roof each piece of a plan belongs to: what its cells say, with short borders and no confetti."""

from __future__ import annotations

import heapq

import numpy as np
import shapely
from scipy.sparse import coo_matrix

from ...geometry.linked_groups import linked_groups
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
    worth = arrangement.length * smoothness
    chosen = _smooth(cost, arrangement.pairs, worth)
    return without_small_parts(chosen, cost, arrangement.pairs, worth, area, min_roof_area)


def _smooth(cost: np.ndarray, pairs: np.ndarray, worth: np.ndarray) -> np.ndarray:
    k, n = cost.shape[1], len(cost)
    around = coo_matrix((np.tile(worth, 2), (pairs.T.ravel(), pairs[:, ::-1].T.ravel())), shape=(n, n)).tocsr()
    chosen = np.argmin(cost, axis=1)
    for _ in range(MAX_SWEEPS):
        before = chosen.copy()
        for i in range(n):
            neighbours = slice(around.indptr[i], around.indptr[i + 1])
            agree = np.bincount(chosen[around.indices[neighbours]], around.data[neighbours], minlength=k)
            chosen[i] = np.argmin(cost[i] - agree)
        if (chosen == before).all():
            break
    return chosen


def without_small_parts(chosen: np.ndarray, cost: np.ndarray, pairs: np.ndarray, worth: np.ndarray, area: np.ndarray,
                        min_roof_area: float, strong: float = np.inf) -> np.ndarray:
    """Label (n,) of each piece with no connected part smaller than `min_roof_area` (m2), the smallest joined first.

    A part joins the neighbouring label that costs least; it stays where it has no neighbour, and where that would cost
    more than `strong` beside its own label.

    Parameters
    ----------
    chosen : (n,) labels.
    cost : (n, k) of each label.
    pairs, worth : (m, 2) and (m,) borders between pieces and what a border between two labels costs there.
    area : (n,) m2.
    """
    parts = _Parts(chosen, cost, pairs, worth, area)
    small = [(float(parts.area[part]), part) for part in parts.around if parts.area[part] < min_roof_area]
    heapq.heapify(small)
    while small:
        size, part = heapq.heappop(small)
        if part not in parts.around or parts.area[part] != size or not parts.around[part]:
            continue  # joined since, or alone: a part of the outline of its own
        if parts.loss(part) > strong:
            continue  # small, but plainly seen
        joined = parts.join_best(part)
        if parts.area[joined] < min_roof_area:
            heapq.heappush(small, (float(parts.area[joined]), joined))
    return parts.labels()


class _Parts:
    """Connected parts of one label, known by their first piece: area, costs, and the borders around each."""

    def __init__(self, chosen: np.ndarray, cost: np.ndarray, pairs: np.ndarray, worth: np.ndarray, area: np.ndarray):
        n = len(chosen)
        same = chosen[pairs[:, 0]] == chosen[pairs[:, 1]]
        count, number = linked_groups(*pairs[same].T, n)
        first = np.full(count, n)
        np.minimum.at(first, number, np.arange(n))
        self.part = first[number]
        self.owner = np.arange(n)
        self.label = chosen.copy()
        self.area = np.bincount(self.part, area, n)
        members = coo_matrix((np.ones(n), (self.part, np.arange(n))), shape=(n, n)).tocsr()
        self.cost = members @ cost
        self.around: dict[int, dict[int, float]] = {int(part): {} for part in first}
        for one, two, value in zip(*self.part[pairs[~same]].T.tolist(), worth[~same].tolist()):
            if value > 0:
                self.around[one][two] = self.around[one].get(two, 0.0) + value
                self.around[two][one] = self.around[two].get(one, 0.0) + value

    def _best(self, part: int) -> int:
        """The neighbouring label that costs least."""
        contact: dict[int, float] = {}
        for other, value in self.around[part].items():
            label = int(self.label[other])
            contact[label] = contact.get(label, 0.0) + value
        return min(sorted(contact), key=lambda label: self.cost[part, label] - contact[label])

    def loss(self, part: int) -> float:
        """What a part costs more with the best of the neighbouring labels than with its own."""
        return float(self.cost[part, self._best(part)] - self.cost[part, self.label[part]])

    def join_best(self, part: int) -> int:
        """Give a part to the neighbouring label that costs least; the part that it then belongs to."""
        best = self._best(part)
        self.label[part] = best
        for other in [other for other in self.around[part] if self.label[other] == best]:
            part = self._unite(part, other)
        return part

    def _unite(self, one: int, two: int) -> int:
        """Make two parts one, known by the lower of their numbers."""
        one, two = min(one, two), max(one, two)
        self.owner[two] = one
        self.area[one] += self.area[two]
        self.cost[one] += self.cost[two]
        for other, value in self.around.pop(two).items():
            del self.around[other][two]
            if other != one:
                self.around[one][other] = self.around[other][one] = self.around[one].get(other, 0.0) + value
        return one

    def labels(self) -> np.ndarray:
        """Label (n,) of each piece."""
        owner = self.owner
        while (owner[owner] != owner).any():
            owner = owner[owner]
        return self.label[owner[self.part]]
