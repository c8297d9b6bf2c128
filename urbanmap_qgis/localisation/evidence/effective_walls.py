"""How many walls a robust match really rests on: drawn displacements, and the solution that an NDT settles at (J 6.2).

The information of walls is not the sum of their points: all points of a wall are displaced together. A linear match
takes the mean of the walls' displacements, weighted by their points; an NDT turns away from walls that disagree and
follows the strongest, so that fewer walls count and its errors are larger.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from .information import Evidence
from .symmetric_systems import solved

DRAWS = 2
"""Displacements drawn for each arrangement of vehicles and trees."""

ITERATIONS = 4
"""Of the reweighted solution at each level of tolerance."""

_UPPER = [(i, j) for i in range(3) for j in range(i, 3)]

LEVELS = (1.0, 0.3)
"""Least sigmas of the walls at the levels before the last, m: walls that are farther off still pull."""


@dataclass(frozen=True)
class _Seen:
    """Walls as places see them in all arrangements, place by place.

    Attributes
    ----------
    place : (g,) numbers of the places, those of each arrangement after those of the one before.
    starts : (places + 1,) where each place's walls begin.
    row : (3, g) mean row of the wall's points.
    product : (g, 6) elements on and above the diagonal of the sum of u a a^T.
    pulling : (g, 3) sum of u times the mean row.
    point : (g,) u of one point, 1/m2.
    sigma : (g,) m.
    shift : (draws, g) drawn displacements, m.
    """

    place: np.ndarray
    starts: np.ndarray
    row: np.ndarray
    product: np.ndarray
    pulling: np.ndarray
    point: np.ndarray
    sigma: np.ndarray
    shift: np.ndarray

    def summed(self, factor: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(columns, places) sums of values (g, columns) times a factor (g,) of each."""
        size = len(factor)
        return (csr_matrix((factor, np.arange(size), self.starts), (len(self.starts) - 1, size)) @ values).T


def robust_excess(evidence: Evidence, rays: np.ndarray, wall: np.ndarray, sigma: np.ndarray,
                  parts: Sequence[np.ndarray], count: int, prior: np.ndarray, sharpness: float) -> np.ndarray:
    """(count, 3, 3) by which the covariance of an NDT exceeds that of the linear match: the difference of the second
    moments of both solutions for the same displacements, so that little chance is left in it.

    Parameters
    ----------
    evidence : m rows of the points on walls.
    rays, wall, sigma : (m,) rays that each row stands for, number of its wall, and that wall's sigma, m.
    parts : (m,) share of each row that each arrangement of vehicles and trees leaves.
    prior : (3, 3) information of what is known before.
    sharpness : of the NDT's mixture.
    """
    seen = _seen(evidence, rays, wall, sigma, parts, count)
    linear = _solved(seen, None, prior, 0.0, 0.0)
    found = linear
    for level in (*LEVELS, 0.0):
        for _ in range(ITERATIONS):
            found = _solved(seen, found, prior, sharpness, level)
    moments = np.einsum("din,djn->nij", found, found) - np.einsum("din,djn->nij", linear, linear)
    return moments.reshape(len(parts), count, 3, 3).sum(axis=0) / (DRAWS * len(parts))


def _seen(evidence: Evidence, rays: np.ndarray, wall: np.ndarray, sigma: np.ndarray, parts: Sequence[np.ndarray],
          count: int) -> _Seen:
    """Walls of the rows in all arrangements."""
    rng, width = np.random.default_rng(11), int(wall.max(initial=0)) + 1
    shifts, places, sums = [], [], []
    for number, (place, of_wall, found) in enumerate(_sums_of_walls(evidence, rays, wall, sigma, parts)):
        shifts.append(rng.normal(size=(width, DRAWS))[of_wall].T)
        places.append(place + number * count)
        sums.append(found)
    place, found = np.concatenate(places), np.concatenate(sums)
    total, of_rays, mean_sigma = found[:, 0], found[:, 10], found[:, 11] / found[:, 10]
    starts = np.searchsorted(place, np.arange(len(parts) * count + 1))
    row = np.ascontiguousarray((found[:, 7:10] / total[:, None]).T)
    return _Seen(place, starts, row, np.ascontiguousarray(found[:, 1:7]), np.ascontiguousarray(found[:, 7:10]),
                 total / of_rays, mean_sigma, np.concatenate(shifts, axis=1) * mean_sigma)


def _sums_of_walls(evidence: Evidence, rays: np.ndarray, wall: np.ndarray, sigma: np.ndarray,
                   parts: Sequence[np.ndarray]) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Of each part the places and walls that it leaves, rising, and their sums of u, u a a^T, u a, rays and sigmas."""
    width = int(wall.max(initial=0)) + 1
    key, number = np.unique(evidence.of * width + wall, return_inverse=True)
    weight, row = evidence.weight, evidence.row
    upper = [weight * row[:, i] * row[:, j] for i, j in _UPPER]
    columns = np.column_stack([weight, *upper, weight[:, None] * row, rays, sigma * rays])
    order = np.argsort(number.ravel(), kind="stable")
    starts = np.searchsorted(number.ravel()[order], np.arange(len(key) + 1))
    for share in parts:
        sums = csr_matrix((share[order], order, starts), (len(key), len(order))) @ columns
        left = np.flatnonzero(sums[:, 10] > 0)
        yield key[left] // width, key[left] % width, sums[left]


def _solved(seen: _Seen, at: np.ndarray | None, prior: np.ndarray, sharpness: float, level: float) -> np.ndarray:
    """(draws, 3, places) solutions with the weights that the residuals at `at` have; all walls alike without it."""
    softer = 1.0 / (1.0 + seen.point * (np.maximum(seen.sigma, level) ** 2 - seen.sigma ** 2))
    before = np.array([prior[i, j] for i, j in _UPPER])[:, None]
    found = []
    for number, shift in enumerate(seen.shift):
        factor = softer
        if at is not None:
            residual = shift - sum(seen.row[axis] * at[number, axis, seen.place] for axis in range(3))
            factor = softer * np.exp(-0.5 * sharpness * seen.point * softer * residual ** 2)
        found.append(solved(seen.summed(factor, seen.product) + before, seen.summed(factor * shift, seen.pulling)))
    return np.stack(found)
