"""What measurements against an inaccurate map tell of a place: the sandwich of information and the map's errors.

A measurement i of a surface with the normal n at r from the vehicle sees a small movement (east, north, turn) of the
vehicle through its row a = [n_x, n_y, r_x n_y - r_y n_x]. A matcher that weighs it with u solves

    H x = sum u a e,   H = sum u a a^T + P,

P the information of what was known before. What e holds is the noise of the measurement, of its own in every row, and
displacements of the map that many rows share: a wall that stands s_w beside its place moves all its points. With
b_g = sum of u a f over the rows of a group g, f the share of the displacement in each row,

    C = H^-1 (sum u^2 s^2 a a^T + sum_g s_g^2 b_g b_g^T + P) H^-1.

With u = 1 / s^2, no groups and no P this is H^-1, which grows smaller with every point; the groups' part does not.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix


@dataclass(frozen=True)
class SharedError:
    """A displacement that groups of rows share.

    Attributes
    ----------
    group : (m,) number of the displaced thing, -1 for none.
    factor : (m,) share of it in each row.
    sigma : (m,) standard deviation, m, the same in all rows of a group.
    """

    group: np.ndarray
    factor: np.ndarray
    sigma: np.ndarray


@dataclass(frozen=True)
class Evidence:
    """Rows of measurements at places.

    Attributes
    ----------
    of : (m,) row of the place.
    row : (m, 3) derivatives by east, north (per m) and turn (per radian).
    weight : (m,) with which the matcher weighs them, 1/m2.
    noise : (m,) standard deviation of their own, m.
    shared : displacements of the map.
    """

    of: np.ndarray
    row: np.ndarray
    weight: np.ndarray
    noise: np.ndarray
    shared: tuple[SharedError, ...] = ()


def surface_rows(normal: np.ndarray, offset: np.ndarray) -> np.ndarray:
    """Rows (m, 3) of surfaces with normals (m, 2) at offsets (m, 2), m, from the vehicle."""
    turn = offset[:, 0] * normal[:, 1] - offset[:, 1] * normal[:, 0]
    return np.column_stack([normal, turn])


def information(evidence: Evidence, count: int) -> np.ndarray:
    """(count, 3, 3) sum of u a a^T at each place."""
    return _summed(evidence.of, evidence.row, evidence.weight, count)


def covariance(evidence: Evidence, count: int, prior: np.ndarray) -> np.ndarray:
    """(count, 3, 3) covariance of east, north (m2) and turn (rad2) at each place; `prior` (3, 3) is P."""
    return next(covariances_of_parts(evidence, [np.ones(len(evidence.of))], count, prior))


def covariances_of_parts(evidence: Evidence, parts: Iterable[np.ndarray], count: int,
                         prior: np.ndarray) -> Iterator[np.ndarray]:
    """`covariance` of the rows of which only shares (m,), 0 to 1, of the measurements are there, for each of the parts.

    A row of several measurements at one place loses weight with each that is hidden, and its noise grows.
    """
    both = np.column_stack([_products(evidence.row, evidence.weight),
                            _products(evidence.row, (evidence.weight * evidence.noise) ** 2)])
    order = np.argsort(evidence.of, kind="stable")
    starts = np.searchsorted(evidence.of[order], np.arange(count + 1))
    groups = [_Groups.of(evidence, error) for error in evidence.shared]
    for share in parts:
        # Row by row in their order: the sums that numpy's bincount gives, of all columns at once.
        sums = csr_matrix((share[order], order, starts), (count, len(order))) @ both
        h, middle = _symmetric(sums[:, :6]) + prior, _symmetric(sums[:, 6:]) + prior
        for group in groups:
            middle += group.summed(share, count)
        inverse = np.linalg.inv(h)
        yield inverse @ middle @ inverse


def _products(row: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Elements on and above the diagonal of u a a^T, (m, 6)."""
    return np.column_stack([weight * row[:, i] * row[:, j] for i in range(3) for j in range(i, 3)])


def _symmetric(elements: np.ndarray) -> np.ndarray:
    """(n, 3, 3) matrices of the elements (n, 6) on and above their diagonals."""
    return np.take(elements, [0, 1, 2, 1, 3, 4, 2, 4, 5], axis=1).reshape(-1, 3, 3)


@dataclass(frozen=True)
class _Groups:
    """The displacements of one kind as they meet places.

    Attributes
    ----------
    rows : (k,) numbers of the rows that have one.
    number : (k,) of the pair of place and displaced thing.
    parts : (3, k) u f a.
    place : (g,) place of each pair.
    variance : (g,) m2.
    """

    rows: np.ndarray
    number: np.ndarray
    parts: np.ndarray
    place: np.ndarray
    variance: np.ndarray

    @classmethod
    def of(cls, evidence: Evidence, error: SharedError) -> _Groups:
        """Pairs of a displacement."""
        rows = np.flatnonzero(error.group >= 0)
        width = int(error.group.max(initial=0)) + 1
        key, first, number = np.unique(evidence.of[rows] * width + error.group[rows], return_index=True,
                                       return_inverse=True)
        scaled = evidence.weight[rows] * error.factor[rows]
        parts = np.stack([scaled * evidence.row[rows, axis] for axis in range(3)])
        return cls(rows, number.ravel(), parts, key // width, error.sigma[rows[first]] ** 2)

    def summed(self, weight: np.ndarray, count: int) -> np.ndarray:
        """(count, 3, 3) sum of s^2 b b^T at each place."""
        weight = weight[self.rows]
        b = np.column_stack([np.bincount(self.number, part * weight, len(self.place)) for part in self.parts])
        return _summed(self.place, b, self.variance, count)


def fused(covariances: Sequence[np.ndarray], prior: np.ndarray) -> np.ndarray:
    """(n, 3, 3) covariance of several independent sources together, each of which holds the prior."""
    total = np.broadcast_to(prior, covariances[0].shape).copy()
    for each in covariances:
        gained = np.linalg.inv(each) - prior
        values, vectors = np.linalg.eigh((gained + np.swapaxes(gained, 1, 2)) / 2)
        # A source never takes away what was known before.
        total += np.einsum("nij,nj,nkj->nik", vectors, np.maximum(values, 0.0), vectors)
    return np.linalg.inv(total)


def _summed(of: np.ndarray, row: np.ndarray, weight: np.ndarray, count: int) -> np.ndarray:
    total = np.zeros((count, 3, 3))
    for i in range(3):
        for j in range(i, 3):
            total[:, i, j] = total[:, j, i] = np.bincount(of, weight * row[:, i] * row[:, j], count)
    return total
