"""Normal equations of each patch, which add up to those of any window.

A movement is (shift, turn) about a centre, in the map's axes, m and radians. A patch's sums are kept about one common
origin; a window's are the differences of running sums, taken to the window's own centre.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .ndt_match import cross_matrices

PLANE = (0, 1, 5)
"""Parameters in 2D: shift east, shift north, turn about up."""

SPACE = (0, 1, 2, 3, 4, 5)


@dataclass(frozen=True)
class PatchSums:
    """Gradient and information (less second derivative) of each patch's score.

    Attributes
    ----------
    gradient : (n, 6).
    information : (n, 6, 6).
    """

    gradient: np.ndarray
    information: np.ndarray

    def __add__(self, other: PatchSums) -> PatchSums:
        return PatchSums(self.gradient + other.gradient, self.information + other.information)

    def times(self, factor: float) -> PatchSums:
        """The sums of a score that counts `factor` times."""
        return PatchSums(self.gradient * factor, self.information * factor)

    def about(self, lever_arms: np.ndarray) -> PatchSums:
        """The same about other centres, which lie `lever_arms` (n, 3) from the origin."""
        transfer = centre_transfers(-lever_arms)
        return PatchSums(np.einsum("nji,nj->ni", transfer, self.gradient),
                         np.swapaxes(transfer, 1, 2) @ self.information @ transfer)

    def windows(self, first: np.ndarray, last: np.ndarray) -> PatchSums:
        """Sums over the patches `first` to `last`, both included, of each window (k,)."""
        return PatchSums(window_sums(self.gradient, first, last), window_sums(self.information, first, last))


def window_sums(values: np.ndarray, first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """(k, ...) sums of the rows (n, ...) from `first` to `last`, both included."""
    running = np.concatenate([np.zeros((1, *values.shape[1:])), np.cumsum(values, axis=0)])
    return running[last + 1] - running[first]


def centre_transfers(lever_arms: np.ndarray) -> np.ndarray:
    """(n, 6, 6): movement about a centre to the same movement about the place `lever_arms` (n, 3) away from it."""
    transfer = np.broadcast_to(np.eye(6), (len(lever_arms), 6, 6)).copy()
    transfer[:, :3, 3:] = cross_matrices(lever_arms)
    return transfer


def by_patch(values: np.ndarray, patch: np.ndarray, patches: int) -> np.ndarray:
    """(patches, ...) sums of rows (m, ...) whose patches (m,) do not fall."""
    return _summed(values, patch, _first_rows(patch), patches)


def _first_rows(patch: np.ndarray) -> np.ndarray:
    """The first row of each patch, of patches (m,) that do not fall."""
    changed = np.ones(len(patch), bool)
    np.greater(patch[1:], patch[:-1], out=changed[1:])
    return np.flatnonzero(changed)


def _summed(values: np.ndarray, patch: np.ndarray, start: np.ndarray, patches: int) -> np.ndarray:
    result = np.zeros((patches, *values.shape[1:]))
    if len(patch):
        result[patch[start]] = np.add.reduceat(values, start, axis=0)
    return result


def sum_points(r: np.ndarray, gradient: tuple, hessian: dict, patch: np.ndarray, patches: int) -> PatchSums:
    """Sums of the points' terms by patch.

    Parameters
    ----------
    r : (m, 3) m, from the origin.
    gradient : (m,) by axis; None for an axis without any.
    hessian : {(a, b): (m,)} with a <= b, only what is not zero.
    """
    moves, start = _moves(r), _first_rows(patch)
    total = np.zeros((patches, 6))
    information = np.zeros((patches, 6, 6))
    for axis, values in enumerate(gradient):
        if values is not None:
            for number, move in moves[axis].items():
                total[:, number] += _summed(values * move, patch, start, patches)
    products: dict[tuple[int, int], np.ndarray] = {}
    for (a, b), values in hessian.items():
        for i, by_i in moves[a].items():
            for j, by_j in moves[b].items():
                product = values * by_i * by_j
                for pair in {(i, j)} if a == b else ((i, j), (j, i)):
                    if pair[0] <= pair[1]:
                        products[pair] = products.get(pair, 0.0) + product
    for (i, j), product in products.items():
        information[:, i, j] = -_summed(product, patch, start, patches)
        information[:, j, i] = information[:, i, j]
    return PatchSums(total, information)


def _moves(r: np.ndarray) -> tuple[dict, dict, dict]:
    """By axis: how much each parameter moves points along it, where it does at all."""
    x, y, z = r.T
    return {0: 1.0, 4: z, 5: -y}, {1: 1.0, 3: -z, 5: x}, {2: 1.0, 3: y, 4: -x}


def point_gradients(r: np.ndarray, gradient: tuple) -> np.ndarray:
    """(m, 6) what each point adds to the gradient by a movement about the origin."""
    result = np.zeros((len(r), 6))
    for axis, values in enumerate(gradient):
        if values is not None:
            for number, move in _moves(r)[axis].items():
                result[:, number] += values * move
    return result
