"""Planes joined where one plane explains the points of both, and points given to the plane they fit best."""

from __future__ import annotations

import numpy as np

from ...execution import checkpoint
from .plane_moments import moments, solve


def merge_planes(points: np.ndarray, neighbours: np.ndarray, label: np.ndarray, tolerance: float) -> np.ndarray:
    """Labels with planes joined, cheapest first, while that costs less than a plane's three parameters are worth.

    Two planes become one where the root mean square residual that this adds, spread over the smaller one's points,
    is below `tolerance` (m).
    """
    count = int(label.max(initial=-1)) + 1
    if count < 2:
        return label
    table = list(moments(points, label, count))
    squares = [float(solve(m)[1]) for m in table]
    beside = _adjacency(neighbours, label, count)
    owner = np.arange(count)
    costs = {pair: _cost(table, squares, *pair) for pair in beside}
    while costs:
        checkpoint()
        (one, two), cost = min(costs.items(), key=lambda item: (item[1], item[0]))
        if cost > tolerance**2:
            break
        table[one] = table[one] + table[two]
        squares[one] = float(solve(table[one])[1])
        owner[owner == two] = one
        others = {a if b in (one, two) else b for a, b in costs if {a, b} & {one, two}} - {one, two}
        costs = {pair: value for pair, value in costs.items() if not {one, two} & set(pair)}
        for other in others:
            pair = min(one, other), max(one, other)
            costs[pair] = _cost(table, squares, *pair)
    renamed = np.where(label >= 0, owner[label], -1)
    names, index = np.unique(renamed, return_inverse=True)
    return index.ravel() - int(names[0] < 0)


def _cost(table: list, squares: list, one: int, two: int) -> float:
    """Squared residual (m2) that joining two planes adds, for each point of the smaller one."""
    joined = float(solve(table[one] + table[two])[1])
    return (joined - squares[one] - squares[two]) / min(table[one][0], table[two][0])


def _adjacency(neighbours: np.ndarray, label: np.ndarray, count: int) -> list[tuple[int, int]]:
    """Pairs of labels, the lower first, that have neighbouring points."""
    first, other = np.repeat(label, neighbours.shape[1]), label[neighbours].ravel()
    meets = (first >= 0) & (other >= 0) & (first != other)
    low, high = np.minimum(first, other)[meets], np.maximum(first, other)[meets]
    pairs, times = np.unique(low * count + high, return_counts=True)
    return [(int(pair // count), int(pair % count)) for pair in pairs[times >= 3]]
