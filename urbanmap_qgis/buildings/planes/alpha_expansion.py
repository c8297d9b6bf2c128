"""Labels of least energy by alpha expansion on the minimum cut of scipy (Boykov, Veksler, Zabih 2001).

Costs between neighbours are computed when they are asked for, and each expansion looks only at the faces that it can
change: memory is that of the faces, and time that of the faces that are in doubt. Labels that have nothing to do with
each other are tried in one cut.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

from ...execution import checkpoint
from ...geometry.tolerances import LEAST_SQUARE

_LARGEST = 2_000_000
"""Sum of the capacities at one node: whole numbers that 32 bits hold with room for their sums."""

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
    search = _Search(data, borders, start.copy())
    for sweep in range(_SWEEPS):
        before = search.labels
        for together in search.independent:
            checkpoint()
            search.expand(together, sweep)
        if (search.labels == before).all():
            break
    return search.labels


def _independent(able: np.ndarray, pairs: np.ndarray) -> list[np.ndarray]:
    """Labels in groups, one after the other: those of a group share no face and no border, and each comes after all
    lower ones that it shares some with, so that the result is as if each came alone.

    Parameters
    ----------
    able : (n, k) whether a face can have a label.
    pairs : (m, 2) faces beside each other.
    """
    count, (one, two) = able.shape[1], pairs.T
    if able.all():
        return [np.array([alpha]) for alpha in range(count)]
    able = csr_matrix(able.astype(np.int32))
    shared = (able.T @ able + able[one].T @ able[two]).toarray() > 0
    shared |= shared.T
    turn = np.zeros(count, np.int64)
    for alpha in range(1, count):
        turn[alpha] = turn[:alpha][shared[alpha, :alpha]].max(initial=-1) + 1
    return [np.flatnonzero(turn == one) for one in range(turn.max(initial=-1) + 1)]


class _Search:
    """The labels so far, and what each expansion needs to know of the turns before."""

    def __init__(self, data: np.ndarray, borders: Borders, labels: np.ndarray):
        self.borders, self.labels, self.count = borders, labels, data.shape[1]
        n, (one, two) = len(labels), borders.pairs.T
        self.limit = np.bincount(one, borders.most, n) + np.bincount(two, borders.most, n)
        # The borders of each face, as in a sparse matrix: rows of `pairs`, from `first` of the face on.
        rows = np.concatenate([np.arange(len(one)), np.arange(len(one))])
        order = np.argsort(borders.pairs.T.ravel(), kind="stable")
        self.border = rows[order]
        self.first = np.concatenate([[0], np.cumsum(np.bincount(borders.pairs.ravel(), minlength=n))])
        # The faces that can have each label, and what it costs there, from `start` of the label on.
        able = np.isfinite(data)
        label, self.face = np.nonzero(able.T)
        self.cost = data[self.face, label]
        self.start = np.concatenate([[0], np.cumsum(np.bincount(label, minlength=self.count))])
        self.independent = _independent(able, borders.pairs)
        self.lowest_cost = data[np.arange(n), labels]
        self.changed = np.full(n, -1)
        self.tried = np.full(self.count, -1)

    def expand(self, alphas: np.ndarray, sweep: int) -> None:
        """Give each of some independent labels to the faces that lower the energy most by taking it."""
        place, group = _ranges(self.start[alphas], self.start[alphas + 1])
        face = self.face[place]
        # A face whose data lose more than all its borders can win back keeps its label.
        doubtful = self.cost[place] - self.lowest_cost[face] <= self.limit[face]
        doubtful &= self.labels[face] != alphas[group]
        before, turns = self.tried[alphas], sweep * self.count + alphas
        self.tried[alphas] = turns
        if not doubtful.any():
            return
        doubt = _Doubt(face[doubtful], self.cost[place[doubtful]], group[doubtful])
        rows, owner = self._borders_of(doubt)
        latest = np.maximum(_largest(self.changed[doubt.face], doubt.group, len(alphas), -1),
                            _largest(self.changed[self.borders.pairs[rows]].max(axis=1), owner, len(alphas), -1))
        fresh = (before < 0) | (latest > before)  # the others are as when they were tried before
        if not fresh.all():
            left = fresh[doubt.group]
            doubt = _Doubt(doubt.face[left], doubt.take[left], doubt.group[left])
            rows, owner = rows[fresh[owner]], owner[fresh[owner]]
        if len(doubt.face):
            self._expand_among(alphas, turns, doubt, rows, owner)

    def _borders_of(self, doubt: _Doubt) -> tuple[np.ndarray, np.ndarray]:
        """Rows of the borders of faces, ascending in each group, and the group of each."""
        place, face = _ranges(self.first[doubt.face], self.first[doubt.face + 1])
        count = max(len(self.borders.pairs), 1)
        group, rows = np.divmod(np.unique(doubt.group[face] * count + self.border[place]), count)
        return rows, group

    def _expand_among(self, alphas: np.ndarray, turns: np.ndarray, doubt: _Doubt, rows: np.ndarray,
                      owner: np.ndarray) -> None:
        number = np.full(len(self.labels), -1)
        number[doubt.face] = np.arange(len(doubt.face))
        pairs, alpha = self.borders.pairs[rows], alphas[owner]
        one, two = self.labels[pairs].T
        both = self.borders.cost(rows, one, two)
        first = self.borders.cost(rows, one, alpha)  # the first keeps its label, the second takes alpha
        second = self.borders.cost(rows, alpha, two)
        keep, take = self.lowest_cost[doubt.face].copy(), doubt.take.copy()
        near, far = number[pairs].T
        inner = (near >= 0) & (far >= 0)
        # E(keep, keep) = both, E(keep, take) = first, E(take, keep) = second, E(take, take) = 0; the others keep.
        count = len(keep)
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
        taking = _cut(keep - floor, take - floor, doubt.group, near[inner], far[inner], capacity)
        if taking.any():
            self._take_if_better(alphas, turns, doubt, taking, rows, owner, both)

    def _take_if_better(self, alphas: np.ndarray, turns: np.ndarray, doubt: _Doubt, taking: np.ndarray,
                        rows: np.ndarray, owner: np.ndarray, before: np.ndarray) -> None:
        """Take the new labels where they lower the energy: rounded capacities can miss by a little."""
        tried = self.labels.copy()
        tried[doubt.face[taking]] = alphas[doubt.group[taking]]
        won = before - self.borders.cost(rows, *tried[self.borders.pairs[rows]].T)
        gain = np.bincount(doubt.group, taking * (self.lowest_cost[doubt.face] - doubt.take), len(alphas))
        better = gain + np.bincount(owner, won, len(alphas)) > 1e-9
        taking = taking & better[doubt.group]
        face, group = doubt.face[taking], doubt.group[taking]
        self.labels = self.labels.copy()
        self.labels[face] = alphas[group]
        self.lowest_cost[face] = doubt.take[taking]
        self.changed[face] = turns[group]


@dataclass(frozen=True)
class _Doubt:
    """Faces (m,) that may take a label: what it costs there, and the number of the label in its group of labels."""

    face: np.ndarray
    take: np.ndarray
    group: np.ndarray


def _ranges(start: np.ndarray, end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The numbers of ranges (r,) one after the other, and the range of each."""
    length = end - start
    row = np.repeat(np.arange(len(length)), length)
    return np.arange(len(row)) + (start - (np.cumsum(length) - length))[row], row


def _largest(values: np.ndarray, group: np.ndarray, count: int, least: float) -> np.ndarray:
    """Largest of the values (m,) of each of `count` ascending groups, and at least `least`."""
    largest = np.full(count, least)
    if len(values):
        first = np.flatnonzero(np.r_[True, group[1:] != group[:-1]])
        largest[group[first]] = np.maximum(np.maximum.reduceat(values, first), least)
    return largest


def _cut(keep: np.ndarray, take: np.ndarray, group: np.ndarray, one: np.ndarray, two: np.ndarray,
         capacity: np.ndarray) -> np.ndarray:
    """Which nodes (n,) lie on the sink's side of the minimum cut: those that change.

    A node that keeps pays `keep`, one that changes pays `take`; first kept and second changed pays `capacity`. Nodes
    of one `group` have no border with those of another, and each group is rounded as if it were alone.
    """
    n = len(keep)
    source, sink, nodes = n, n + 1, np.arange(n)
    start = np.concatenate([np.full(n, source), nodes, one])
    end = np.concatenate([nodes, np.full(n, sink), two])
    weight, groups = np.concatenate([take, keep, capacity]), np.concatenate([group, group, group[one]])
    count = group[-1] + 1
    scale = _LARGEST / np.maximum(_largest(np.maximum(take, keep), group, count, LEAST_SQUARE),
                                  _largest(capacity, group[one], count, LEAST_SQUARE))
    whole = np.minimum(np.rint(weight * scale[groups]), _LARGEST).astype(np.int32)
    graph = coo_matrix((whole, (start, end)), shape=(n + 2, n + 2)).tocsr()
    graph.sum_duplicates()
    return ~_reached(graph, maximum_flow(graph, source, sink).flow, source)[:n]


def _reached(graph: csr_matrix, flow: csr_matrix, source: int) -> np.ndarray:
    """Mask of the nodes that are reached from the source where capacity is left."""
    left = graph - flow
    left.data = np.maximum(left.data, 0)
    left.eliminate_zeros()
    reached = np.zeros(graph.shape[0], bool)
    reached[breadth_first_order(left, source, directed=True, return_predecessors=False)] = True
    return reached
