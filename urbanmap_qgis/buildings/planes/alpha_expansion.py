"""Labels of least energy by alpha expansion on the minimum cut of scipy (Boykov, Veksler, Zabih 2001).

Costs between neighbours are computed when they are asked for, and each expansion looks only at the faces that it can
change: memory is that of the faces, and time that of the faces that are in doubt.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

from ...execution import checkpoint
from ...geometry.tolerances import LEAST_SQUARE

_LARGEST = 2_000_000
"""Sum of the capacities at one node: whole numbers that 32 bits hold with room for their sums."""

_SMALL = 400
"""Nodes up to which a whole table of what is left of the capacities is made."""

_SWEEPS = 4


class Borders(Protocol):
    """Borders between faces: `pairs` (m, 2), the faces beside each; `most` (m,), the greatest cost of each."""

    pairs: np.ndarray
    most: np.ndarray

    def cost(self, rows: np.ndarray | slice, one: np.ndarray, two: np.ndarray) -> np.ndarray:
        """Cost (r,) of labels `one` and `two` (r,) or a single one beside the borders `rows`: symmetric, 0 for equal
        ones, a metric."""


def expand_labels(data: np.ndarray, borders: Borders, start: np.ndarray) -> np.ndarray:
    """Label (n,) of each face: least sum of data costs and of the costs between neighbours.

    Parameters
    ----------
    data : (n, k) cost of each label.
    start : (n,) labels to begin with.
    """
    search = _Search(np.asfortranarray(data), borders, start.copy())
    count = data.shape[1]
    for turn in range(_SWEEPS * count):
        checkpoint()
        search.expand(turn % count, turn)
        if turn - search.last_success >= count:
            break
    return search.labels


class _Search:
    """The labels so far, and what each expansion needs to know of the turns before."""

    def __init__(self, data: np.ndarray, borders: Borders, labels: np.ndarray):
        self.data, self.borders, self.labels = data, borders, labels
        n, (one, two) = len(labels), borders.pairs.T
        self.limit = np.bincount(one, borders.most, n) + np.bincount(two, borders.most, n)
        # The borders of each face, as in a sparse matrix: rows of `pairs`, from `first` of the face on.
        rows = np.concatenate([np.arange(len(one)), np.arange(len(one))])
        order = np.argsort(borders.pairs.T.ravel(), kind="stable")
        self.border = rows[order]
        self.first = np.concatenate([[0], np.cumsum(np.bincount(borders.pairs.ravel(), minlength=n))])
        self.lowest_cost = data[np.arange(n), labels]
        self.changed = np.zeros(n, np.int64)
        self.tried = np.full(data.shape[1], -1)
        self.last_success = -1

    def expand(self, alpha: int, turn: int) -> None:
        """Give `alpha` to the faces that lower the energy most by taking it."""
        take = self.data[:, alpha]
        # A face whose data lose more than all its borders can win back keeps its label.
        doubtful = np.flatnonzero((take - self.lowest_cost <= self.limit) & (self.labels != alpha))
        before, self.tried[alpha] = self.tried[alpha], turn
        if not len(doubtful):
            return
        rows = self._borders_of(doubtful)
        pairs = self.borders.pairs[rows]
        if before >= 0 and self.changed[pairs].max(initial=-1) <= before and self.changed[doubtful].max() <= before:
            return  # as when it was tried before
        self._expand_among(alpha, turn, doubtful, rows, pairs)

    def _borders_of(self, faces: np.ndarray) -> np.ndarray:
        """Ascending rows of the borders of faces."""
        start, length = self.first[faces], self.first[faces + 1] - self.first[faces]
        place = np.arange(length.sum()) + np.repeat(start - np.concatenate([[0], np.cumsum(length)[:-1]]), length)
        return np.unique(self.border[place])

    def _expand_among(self, alpha: int, turn: int, faces: np.ndarray, rows: np.ndarray, pairs: np.ndarray) -> None:
        number = np.full(len(self.labels), -1)
        number[faces] = np.arange(len(faces))
        one, two = self.labels[pairs].T
        both = self.borders.cost(rows, one, two)
        first = self.borders.cost(rows, one, alpha)  # the first keeps its label, the second takes alpha
        second = self.borders.cost(rows, alpha, two)
        keep, take = self.lowest_cost[faces].copy(), self.data[faces, alpha].copy()
        near, far = number[pairs].T
        inner = (near >= 0) & (far >= 0)
        # E(keep, keep) = both, E(keep, take) = first, E(take, keep) = second, E(take, take) = 0; the others keep.
        count = len(faces)
        keep += np.bincount(near[inner], both[inner], count)
        take += np.bincount(near[inner], second[inner], count) - np.bincount(far[inner], second[inner], count)
        for side, other, taken in ((near, far, second), (far, near, first)):
            border = (side >= 0) & (other < 0)
            keep += np.bincount(side[border], both[border], count)
            take += np.bincount(side[border], taken[border], count)
        if (take >= keep).all():
            return  # nothing flows: all keep
        floor = np.minimum(keep, take)
        capacity = np.maximum(first + second - both, 0.0)[inner]
        taking = _cut(count, keep - floor, take - floor, near[inner], far[inner], capacity)
        if taking.any():
            self._take_if_better(alpha, turn, faces[taking], rows, pairs, both)

    def _take_if_better(self, alpha: int, turn: int, faces: np.ndarray, rows: np.ndarray, pairs: np.ndarray,
                        before: np.ndarray) -> None:
        """Take the new labels where they lower the energy: rounded capacities can miss by a little."""
        tried = self.labels.copy()
        tried[faces] = alpha
        gain = self.lowest_cost[faces].sum() - self.data[faces, alpha].sum()
        gain += before.sum() - self.borders.cost(rows, *tried[pairs].T).sum()
        if gain > 1e-9:
            self.labels = tried
            self.lowest_cost[faces] = self.data[faces, alpha]
            self.changed[faces] = turn
            self.last_success = turn


def _cut(n: int, keep: np.ndarray, take: np.ndarray, one: np.ndarray, two: np.ndarray,
         capacity: np.ndarray) -> np.ndarray:
    """Which nodes (n,) lie on the sink's side of the minimum cut: those that change.

    A node that keeps pays `keep`, one that changes pays `take`; first kept and second changed pays `capacity`.
    """
    source, sink = n, n + 1
    nodes = np.arange(n)
    start = np.concatenate([np.full(n, source), nodes, one])
    end = np.concatenate([nodes, np.full(n, sink), two])
    weight = np.concatenate([take, keep, capacity])
    scale = _LARGEST / max(float(weight.max(initial=0.0)), LEAST_SQUARE)
    whole = np.minimum(np.rint(weight * scale), _LARGEST).astype(np.int32)
    graph = coo_matrix((whole, (start, end)), shape=(n + 2, n + 2)).tocsr()
    graph.sum_duplicates()
    return ~_reached(graph, maximum_flow(graph, source, sink).flow, source)[:n]


def _reached(graph: csr_matrix, flow: csr_matrix, source: int) -> np.ndarray:
    """Mask of the nodes that are reached from the source where capacity is left."""
    if graph.shape[0] <= _SMALL:  # whole tables cost less than sparse ones
        left = graph.toarray() > flow.toarray()
        reached = np.zeros(len(left), bool)
        fresh = np.arange(len(left)) == source
        while fresh.any():
            reached |= fresh
            fresh = left[fresh].any(axis=0) & ~reached
        return reached
    left = graph - flow
    left.data = np.maximum(left.data, 0)
    left.eliminate_zeros()
    reached = np.zeros(graph.shape[0], bool)
    reached[breadth_first_order(left, source, directed=True, return_predecessors=False)] = True
    return reached
