"""Labels of least energy by alpha expansion on the minimum cut of scipy (Boykov, Veksler, Zabih 2001)."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

_LARGEST = 2_000_000
"""Sum of the capacities at one node: whole numbers that 32 bits hold with room for their sums."""

_SWEEPS = 4


def expand_labels(data: np.ndarray, pairs: np.ndarray, smoothness: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Label (n,) of each face: least sum of data costs and of the costs between neighbours.

    Parameters
    ----------
    data : (n, k) cost of each label. pairs : (m, 2) neighbouring faces.
    smoothness : (m, k, k) cost of each two labels at a pair: symmetric, 0 for equal ones, a metric.
    start : (n,) labels to begin with.
    """
    labels = start.copy()
    energy = energy_of(data, pairs, smoothness, labels)
    unchanged = 0
    for turn in range(_SWEEPS * data.shape[1]):
        tried = _expanded(data, pairs, smoothness, labels, turn % data.shape[1])
        found = energy_of(data, pairs, smoothness, tried) if tried is not labels else energy
        unchanged += 1
        if found < energy - 1e-9:
            labels, energy, unchanged = tried, found, 0
        if unchanged >= data.shape[1]:
            break
    return labels


def energy_of(data: np.ndarray, pairs: np.ndarray, smoothness: np.ndarray, labels: np.ndarray) -> float:
    """Energy of labels (n,), see `expand_labels`."""
    one, two = labels[pairs[:, 0]], labels[pairs[:, 1]]
    return float(data[np.arange(len(labels)), labels].sum() + smoothness[np.arange(len(pairs)), one, two].sum())


def _expanded(data: np.ndarray, pairs: np.ndarray, smoothness: np.ndarray, labels: np.ndarray,
              alpha: int) -> np.ndarray:
    """The best labels that differ from `labels` only in faces that take `alpha`."""
    n, row = len(labels), np.arange(len(pairs))
    one, two = pairs.T
    keep, take = data[np.arange(n), labels].copy(), data[:, alpha].copy()
    both = smoothness[row, labels[one], labels[two]]
    first = smoothness[row, labels[one], alpha]  # the first keeps its label, the second takes alpha
    second = smoothness[row, alpha, labels[two]]
    # A face whose data lose more than all its borders can win back keeps its label: it leaves the graph.
    most = np.bincount(one, np.maximum(both, first), n) + np.bincount(two, np.maximum(both, second), n)
    free = (take - keep <= most) & (labels != alpha)
    if not free.any():
        return labels
    # E(keep, keep) = both, E(keep, take) = first, E(take, keep) = second, E(take, take) = 0; fixed faces keep, and
    # those that have alpha already cost the same either way.
    fixed = ~free & (labels != alpha)
    inner = ~fixed[one] & ~fixed[two]
    np.add.at(keep, one[inner], both[inner])
    np.add.at(take, one[inner], second[inner])
    np.add.at(take, two[inner], -second[inner])
    for near, far, taken in ((one, two, second), (two, one, first)):
        border = ~fixed[near] & fixed[far]
        np.add.at(keep, near[border], both[border])
        np.add.at(take, near[border], taken[border])
    nodes = np.flatnonzero(~fixed)
    number = np.cumsum(~fixed) - 1
    floor = np.minimum(keep, take)
    capacity = np.maximum(first + second - both, 0.0)[inner]
    changed = _cut(len(nodes), (keep - floor)[nodes], (take - floor)[nodes], number[one[inner]], number[two[inner]],
                   capacity)
    result = labels.copy()
    result[nodes[changed]] = alpha
    return result


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
    scale = _LARGEST / max(float(weight.max(initial=0.0)), 1e-12)
    whole = np.minimum(np.rint(weight * scale), _LARGEST).astype(np.int32)
    graph = coo_matrix((whole, (start, end)), shape=(n + 2, n + 2)).tocsr()
    graph.sum_duplicates()
    flow = maximum_flow(graph, source, sink).flow
    left = graph - flow
    left.data = np.maximum(left.data, 0)
    left.eliminate_zeros()
    reached = np.zeros(n + 2, bool)
    reached[breadth_first_order(left, source, directed=True, return_predecessors=False)] = True
    return ~reached[:n]
