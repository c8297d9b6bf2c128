"""Which points above the ground lie on roofs: smooth, large and closed surfaces are, crowns are not.

Each point takes the plane of that neighbourhood among its own and its neighbours' which it lies on best, so that planes
stay sharp at ridges and edges. Neighbours on each other's plane make a surface. A roof's surface is large and smooth,
and nearly all its points end their pulses; a crown falls into small rough pieces with many echoes above the last. The
odds of a surface follow from these three figures by logistic regression.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ...progress import SILENT, Progress

NEIGHBOURS = 11
"""Points of a neighbourhood, its centre included. With 7 to 13 the points told right differ by less than 1 %."""
MAX_ANGLE = np.cos(np.radians(20.0))
"""Cosine of the greatest angle between the planes of neighbours on one surface (15 to 20 degrees: no difference)."""
MAX_DISTANCE = 0.3
"""Distance (m) of a point from its neighbour's plane on one surface (0.2 to 0.3: no difference)."""
DECIMETRES = 10
LARGEST = 5.0
"""Natural logarithm of the area (m2) from which larger surfaces are no surer."""
BLOCK = 200_000
"""Neighbourhoods worked on together, for the memory."""


WITH_ECHOES = (-4.35, 0.55, -0.68, 6.23)
"""Natural logarithm of the odds that a surface is a roof: a constant, and weights of the logarithm of the area in m2,
of the roughness in decimetres, and of the share of last echoes.

Fitted on classified clouds of Delft (16 and 2 points/m2) and Bratislava; on Amsterdam, which was left out, 97 % of the
points called roofs are of class 6.
"""
WITHOUT_ECHOES = (-0.59, 1.10, -2.07, 0.0)
"""For clouds whose pulses all have one echo, by which nothing is told."""
SUREST = 6.0
"""Bound of the logarithm of the odds of one surface, so that none overrules all round it."""


def roof_odds(points: np.ndarray, last: np.ndarray, echoes: bool, density: float,
              progress: Progress = SILENT) -> np.ndarray:
    """Natural logarithm (n,) of the odds that each point lies on a roof.

    A point counts as its surface and those of its neighbours together: chimneys and edges go with the roof about
    them, single branches with the crown.

    Parameters
    ----------
    points : (n, 3) those above the ground, m, on a local origin.
    last : (n,) whether each is the last echo of its pulse.
    echoes : whether some pulse of the cloud has several echoes.
    density : last echoes/m2.
    """
    if len(points) < NEIGHBOURS:
        return np.full(len(points), -SUREST)
    neighbours = cKDTree(points).query(points, NEIGHBOURS)[1]
    progress.check()
    middle, normal, roughness = _smoothest_planes(points, neighbours)
    progress.check()
    surface = _surfaces(points, neighbours, middle, normal)
    count = np.bincount(surface)
    figures = [np.ones(len(count)), np.clip(np.log(count / density), 0.0, LARGEST),
               np.bincount(surface, roughness * DECIMETRES) / count, np.bincount(surface, last) / count]
    value = np.array(WITH_ECHOES if echoes else WITHOUT_ECHOES) @ np.array(figures)
    single = np.clip(value, -SUREST, SUREST)[surface]
    return single[neighbours].mean(axis=1)[neighbours].mean(axis=1)


def _smoothest_planes(points: np.ndarray, neighbours: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Middle (n, 3), unit normal (n, 3) and roughness (n,), m, of the plane that each point lies on best."""
    middle, normal = np.empty_like(points), np.empty_like(points)
    rough = np.empty(len(points))
    for start in range(0, len(points), BLOCK):
        part = slice(start, start + BLOCK)
        around = points[neighbours[part]]
        middle[part] = around.mean(axis=1)
        around -= middle[part, None]
        values, vectors = np.linalg.eigh(np.einsum("nki,nkj->nij", around, around) / NEIGHBOURS)
        normal[part], rough[part] = vectors[:, :, 0], np.sqrt(np.maximum(values[:, 0], 0.0))
    chosen, roughness = np.empty(len(points), np.int64), np.empty(len(points))
    for start in range(0, len(points), BLOCK):
        part = slice(start, start + BLOCK)
        of = neighbours[part]
        away = np.einsum("nki,nki->nk", points[part, None] - middle[of], normal[of])
        misfit = rough[of] ** 2 + (away / 2.0) ** 2
        best = np.argmin(misfit, axis=1)
        rows = np.arange(len(of))
        chosen[part], roughness[part] = of[rows, best], np.sqrt(misfit[rows, best])
    return middle[chosen], normal[chosen], roughness


def _surfaces(points: np.ndarray, neighbours: np.ndarray, middle: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Number (n,) of the surface of each point: neighbours that lie on each other's planes belong to one."""
    one = np.repeat(np.arange(len(points)), neighbours.shape[1] - 1)
    other = neighbours[:, 1:].ravel()
    alike = np.abs(np.einsum("ni,ni->n", normal[one], normal[other])) > MAX_ANGLE
    one, other = one[alike], other[alike]
    for _ in range(2):  # of each from the other's plane
        near = np.abs(np.einsum("ni,ni->n", points[one] - middle[other], normal[other])) < MAX_DISTANCE
        one, other = other[near], one[near]
    graph = coo_matrix((np.ones(len(one), bool), (one, other)), shape=(len(points), len(points)))
    return connected_components(graph, directed=False)[1]
