"""Chains of states with offsets that short runs of them share, solved in time that grows with the chain alone.

The states are eliminated one after the other, each offset after the last state that it touches: what is left at any
time is the next state and the offsets that go on (the front, as of frontal elimination; Duff and Reid 1983). Of the
inverse only the blocks of each front are made.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.linalg.lapack import dpotrf, dtrtri
from scipy.sparse import csr_matrix

from ..wording import say


@dataclass(frozen=True)
class _Front:
    """What is left of the equations at a state: its p values, the offsets that end here, those that go on.

    Attributes
    ----------
    ending, onward : numbers of the offsets.
    entering : (c,) where the front before has left its values here.
    inverse, gain : (e, e), (e, g) of the e values that end here, and of them by the next state and those that go on.
    """

    ending: np.ndarray
    onward: np.ndarray
    entering: np.ndarray
    inverse: np.ndarray
    gain: np.ndarray


class OffsetChain:
    """The inverse of the normal equations of n states with p values each and of m offsets.

    Parameters
    ----------
    diagonal, ahead : (n, p, p), (n - 1, p, p), as `solve_chain` takes them.
    pull : (n p, m) between states and offsets.
    normal : (m, m) of the offsets; those that it ties touch a state together.

    Attributes
    ----------
    covariance : (n, p, p) of each state, given all.
    lagged : (n - 1, p, p) covariance of each state and the next one.
    offset_variance : (m,).
    """

    def __init__(self, diagonal: np.ndarray, ahead: np.ndarray, pull: csr_matrix, normal: csr_matrix):
        of_state = np.sqrt(np.einsum("kii->ki", diagonal))
        self._scale, self._offset_scale = 1.0 / of_state, 1.0 / np.sqrt(normal.diagonal())  # all in their own units
        self._fronts = list(self._eliminated(diagonal, ahead, pull, normal))
        self._select_inverse()

    def _eliminated(self, diagonal: np.ndarray, ahead: np.ndarray, pull: csr_matrix,
                    normal: csr_matrix) -> Iterator[_Front]:
        """Each state's front, along the chain."""
        n, p = self._scale.shape
        first, last = touched_states(pull, p)
        entries, ties = pull.tocoo(), normal.tocoo()
        ties_at = np.maximum(first[ties.row], first[ties.col])
        pulls = _rows_by_state(entries.row // p, n)
        tied = _rows_by_state(ties_at, n)
        begins, ends = _rows_by_state(first, n), _rows_by_state(last, n)
        slot, onward, carried = np.empty(pull.shape[1], int), np.zeros(0, int), np.zeros((p, p))
        for k in range(n):
            before, active = onward, np.concatenate([onward, begins[k]])
            ending, onward = ends[k], active[last[active] > k]
            here = np.concatenate([ending, onward])
            slot[here] = p + np.arange(len(here))
            scale = np.concatenate([self._scale[k], self._offset_scale[here]])
            whole = np.zeros((len(scale), len(scale)))
            whole[:p, :p] = diagonal[k]
            rows, columns = entries.row[pulls[k]] - k * p, slot[entries.col[pulls[k]]]
            whole[rows, columns] = whole[columns, rows] = entries.data[pulls[k]]
            whole[slot[ties.row[tied[k]]], slot[ties.col[tied[k]]]] = ties.data[tied[k]]
            whole *= scale[:, None] * scale
            entering = np.concatenate([np.arange(p), slot[before]])
            whole[np.ix_(entering, entering)] += carried
            e = p + len(ending)
            inverse = _inverse(whole[:e, :e])
            following = np.zeros((e, 0))
            if k < n - 1:
                following = np.concatenate([np.zeros((e, p)), whole[:e, e:]], axis=1)
                following[:p, :p] = ahead[k] * self._scale[k][:, None] * self._scale[k + 1]
            gain = inverse @ following
            carried = -following.T @ gain
            carried[p:, p:] += whole[e:, e:]
            yield _Front(ending, onward, entering, inverse, gain)

    def _select_inverse(self) -> None:
        """The covariances, from the last front back."""
        n, p = self._scale.shape
        self.covariance, self.lagged = np.empty((n, p, p)), np.empty((n - 1, p, p))
        self.offset_variance, after = np.empty(len(self._offset_scale)), np.zeros((0, 0))
        for k in range(n - 1, -1, -1):
            front = self._fronts[k]
            cross = -front.gain @ after
            own = front.inverse - cross @ front.gain.T
            self.covariance[k] = own[:p, :p]
            self.offset_variance[front.ending] = own.diagonal()[p:]
            if k < n - 1:
                self.lagged[k] = cross[:p, :p]
            whole = np.block([[own, cross[:, p:]], [cross[:, p:].T, after[p:, p:]]])
            after = whole[np.ix_(front.entering, front.entering)]
        self.covariance *= self._scale[:, :, None] * self._scale[:, None, :]
        self.lagged *= self._scale[:-1, :, None] * self._scale[1:, None, :]
        self.offset_variance *= self._offset_scale**2

    def solve(self, right: np.ndarray, offset_right: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """States (n, p, r) and offsets (m, r) for right sides (n, p, r) and (m, r)."""
        n, p, count = right.shape
        right, offset = right * self._scale[:, :, None], offset_right * self._offset_scale[:, None]
        carried, sides = np.zeros((p, count)), []
        for k, front in enumerate(self._fronts):
            side = np.concatenate([right[k], offset[front.ending], np.zeros((len(front.onward), count))])
            side[front.entering] += carried
            e = p + len(front.ending)
            sides.append(side[:e])
            carried = -front.gain.T @ side[:e]
            carried[p:] += side[e:]
        state, after = np.empty_like(right), np.zeros((0, count))
        for k in range(n - 1, -1, -1):
            front = self._fronts[k]
            own = front.inverse @ sides[k] - front.gain @ after
            state[k], offset[front.ending] = own[:p], own[p:]
            after = np.concatenate([own, after[p:]])[front.entering]
        return state * self._scale[:, :, None], offset * self._offset_scale[:, None]


def touched_states(pull: csr_matrix, size: int) -> tuple[np.ndarray, np.ndarray]:
    """First and last state, of `size` values each, that each offset (m,) touches; the first one where it touches none.
    """
    columns = pull.tocsc()
    columns.sort_indices()
    some = np.diff(columns.indptr) > 0
    first, last = np.zeros((2, pull.shape[1]), int)
    first[some] = columns.indices[columns.indptr[:-1][some]] // size
    last[some] = columns.indices[columns.indptr[1:][some] - 1] // size
    return first, last


def _rows_by_state(state: np.ndarray, states: int) -> list[np.ndarray]:
    """Rows of `state` (n,) that hold each number from 0 on."""
    order = np.argsort(state, kind="stable")
    return np.split(order, np.searchsorted(state[order], np.arange(1, states)))


def _inverse(matrix: np.ndarray) -> np.ndarray:
    """Of a symmetric positive definite matrix (e, e)."""
    lower, wrong = dpotrf(matrix, lower=1)
    if wrong:
        raise np.linalg.LinAlgError(say("Matrix is not positive definite"))
    half, _ = dtrtri(lower, lower=1)
    return half.T @ half
