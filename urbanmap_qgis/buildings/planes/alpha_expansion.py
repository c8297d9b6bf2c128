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
    for _ in range(_SWEEPS):
        before = energy
        for alpha in range(data.shape[1]):
            tried = _expanded(data, pairs, smoothness, labels, alpha)
            found = energy_of(data, pairs, smoothness, tried)
            if found < energy - 1e-9:
                labels, energy = tried, found
        if energy >= before - 1e-9:
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
    # E(keep, keep) = both, E(keep, take) = first, E(take, keep) = second, E(take, take) = 0
    np.add.at(keep, one, both)
    np.add.at(take, one, second)
    np.add.at(take, two, -second)
    capacity = np.maximum(first + second - both, 0.0)
    floor = np.minimum(keep, take)
    keep, take = keep - floor, take - floor
    changed = _cut(n, keep, take, one, two, capacity)
    return np.where(changed, alpha, labels)


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
