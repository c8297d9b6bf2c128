"""Which of numbered things hang together by links between two of them."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

_FEW = 300
"""Things and links together up to which joining them one by one costs less than making a matrix."""


def linked_groups(one: np.ndarray, two: np.ndarray, count: int) -> tuple[int, np.ndarray]:
    """Number of groups of `count` things linked in pairs (m,), (m,), and the group (count,) of each.

    Groups are numbered in the order of their first members.
    """
    if count + len(one) > _FEW:
        links = coo_matrix((np.ones(len(one), np.int8), (one, two)), shape=(count, count))
        return connected_components(links, directed=False)
    first = list(range(count))  # one of the group that comes no later; the first member has itself
    for here, there in zip(one.tolist(), two.tolist()):
        here, there = _first_of(first, here), _first_of(first, there)
        first[max(here, there)] = min(here, there)
    groups = 0
    number = [0] * count
    for thing, before in enumerate(first):
        if before == thing:
            number[thing] = groups
            groups += 1
        else:
            number[thing] = number[before]
    return groups, np.array(number, np.int32)


def linked_members(one: np.ndarray, two: np.ndarray, count: int) -> list[np.ndarray]:
    """Numbers, in order, of the members of each group of `linked_groups`."""
    group = linked_groups(np.asarray(one, np.int64), np.asarray(two, np.int64), count)[1]
    order = np.argsort(group, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(group[order])) + 1) if count else []


def _first_of(first: list[int], thing: int) -> int:
    """The first member of a thing's group, found on ways that become shorter."""
    while first[thing] != thing:
        first[thing] = first[first[thing]]
        thing = first[thing]
    return thing
