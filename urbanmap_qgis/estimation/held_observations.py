"""Observations of single distances that keep their weights while the evidence of markings is weighed against itself."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix

from .offset_chain import OffsetChain, touched_states

_COLUMNS = 256
"""Right sides that are solved for at once: memory grows with them and the path alone."""

_MOST_NODES = 100
"""Nodes over which an offset is eliminated along the chain; one that is met again later is solved for beside it."""


@dataclass(frozen=True)
class OffsetEquations:
    """Normal equations of k nodes and m offsets of held observations.

    Attributes
    ----------
    information, node_right : (k, d, 2, d, 2), (k, d, 2) of the nodes.
    pull : (2 k d, m) between both.
    normal, right : (m, m), (m,) of the offsets, with what is known of them before.
    """

    information: np.ndarray
    node_right: np.ndarray
    pull: csr_matrix
    normal: csr_matrix
    right: np.ndarray


@dataclass(frozen=True)
class OwnOffsets:
    """Offsets that groups of observations share beside the common one, as the walls of a building share its eaves.

    Attributes
    ----------
    column : (n, l) number of each observation's offset on every level, from 0 over all levels.
    precision : (m,) 1 / m2, of each offset before any observation.
    level : (m,) from 0.
    weight : (n,) 1 / m2, of each observation once its offsets are known.
    """

    column: np.ndarray
    precision: np.ndarray
    level: np.ndarray
    weight: np.ndarray


@dataclass(frozen=True)
class HeldObservations:
    """Distances rate . c = target with weights, of corrections c at path parameters, all moved by one common offset.

    The weights take each observation for itself, with what its offsets leave unknown; see `OwnOffsets`.

    Attributes
    ----------
    path_parameter : (n,) m, not falling.
    rate : (n, d) m for each of the chain's d parameters.
    target : (n,) m.
    weight : (n,) 1 / m2.
    offset : m, in all targets.
    offset_prior : m, (mean, standard deviation) before any observation.
    own : further offsets, that groups of the observations share; None for none.
    """

    path_parameter: np.ndarray
    rate: np.ndarray
    target: np.ndarray
    weight: np.ndarray
    offset: float
    offset_prior: tuple[float, float]
    own: OwnOffsets | None = None

    def __len__(self) -> int:
        return len(self.target)

    def on_nodes(self, node: np.ndarray, ahead: np.ndarray, nodes: int) -> tuple[np.ndarray, np.ndarray]:
        """Information (k, d, 2, d, 2) and right side (k, d, 2) of k nodes.

        `node`, `ahead` : (n,) the node next to each observation, and m that the observation lies ahead of it.
        """
        full = self.rate[:, :, None] * np.stack([np.ones(len(self)), ahead], axis=1)[:, None]
        size = full.shape[1]
        information, right = np.zeros((nodes, size, 2, size, 2)), np.zeros((nodes, size, 2))
        filled, first = np.unique(node, return_index=True)  # nodes grow along the path
        weighted = full * self.weight[:, None, None]
        for begin, end, at in zip(first, np.append(first[1:], len(node)), filled):
            some = slice(begin, end)
            information[at] = np.tensordot(full[some], weighted[some], axes=(0, 0))
            right[at] = np.tensordot(self.target[some], weighted[some], axes=1)
        return information, right

    def offset_equations(self, node: np.ndarray, ahead: np.ndarray, nodes: int) -> OffsetEquations:
        """All offsets, the common one first, with the nodes; `node`, `ahead` as `on_nodes` takes them."""
        size, one = self.rate.shape[1], np.zeros((len(self), 1), int)
        column = one if self.own is None else np.column_stack([one, 1 + self.own.column])
        weight = self.weight if self.own is None else self.own.weight
        mean, sigma = self.offset_prior
        precision = np.array([sigma**-2.0]) if self.own is None else np.append(sigma**-2.0, self.own.precision)
        full = self.rate[:, :, None] * np.stack([np.ones(len(self)), ahead], axis=1)[:, None]
        known = replace(self, weight=weight).on_nodes(node, ahead, nodes)
        right, each = np.zeros(len(precision)), np.arange(len(precision))
        right[0] = (mean - self.offset) * precision[0]
        places = node[:, None] * (2 * size) + np.arange(2 * size)
        of_node = (weight[:, None, None] * full).reshape(len(self), -1)
        for of_level in column.T:
            right += np.bincount(of_level, weight * self.target, len(precision))
        levels = column.shape[1]
        normal = coo_matrix((np.append(precision, np.tile(weight, levels**2)), (
            np.append(each, np.repeat(column.T, levels, axis=0).ravel()),
            np.append(each, np.tile(column.T, (levels, 1)).ravel()))), shape=(len(precision), len(precision)))
        pull = coo_matrix((np.tile(of_node.ravel(), levels), (
            np.tile(places.ravel(), levels), np.repeat(column.T.ravel(), 2 * size))),
            shape=(nodes * 2 * size, len(precision)))
        return OffsetEquations(known[0], known[1], pull.tocsr(), normal.tocsr(), right)

    def residual(self, value: np.ndarray) -> np.ndarray:
        """(n,) m, what corrections (n, d) leave."""
        return (self.rate * value).sum(axis=1) - self.target

    def plan_information(self, path_parameter: np.ndarray, extent: float | np.ndarray) -> np.ndarray:
        """(m, 2, 2) what the observations within `extent` m of path parameters (m,) know of the place in plan."""
        plan = self.rate[:, :2]
        product = plan[:, :, None] * plan[:, None, :] * self.weight[:, None, None]
        running = np.concatenate([np.zeros((1, 2, 2)), np.cumsum(product, axis=0)])
        low, high = (np.searchsorted(self.path_parameter, path_parameter + side) for side in (-extent, extent))
        return running[high] - running[low]


@dataclass(frozen=True)
class HeldSolution:
    """What `HeldSystem` finds.

    Attributes
    ----------
    state, covariance : (k, p), (k, p, p) of the nodes.
    lagged : (k - 1, p, p) covariance of each node and the next one.
    offset, offset_variance : (m,) m, m2.
    """

    state: np.ndarray
    covariance: np.ndarray
    lagged: np.ndarray
    offset: np.ndarray
    offset_variance: np.ndarray


class HeldSystem:
    """Normal equations of nodes and of the offsets of what is held.

    Offsets that few nodes share are eliminated along the chain; the common one and those met again later, `far`, stand
    in a border of it.

    Parameters
    ----------
    diagonal, ahead, right : (k, p, p), (k - 1, p, p), (k, p) of the nodes without what is held.
    """

    def __init__(self, diagonal: np.ndarray, ahead: np.ndarray, right: np.ndarray, equations: OffsetEquations):
        self.right = right + equations.node_right.reshape(right.shape)
        pull, normal = equations.pull.tocsc(), equations.normal
        first, last = touched_states(pull, right.shape[1])
        far = last - first > _MOST_NODES
        far[0] = True
        self._near, self._far = np.flatnonzero(~far), np.flatnonzero(far)
        of_near, of_far = normal[self._near], normal[self._far]
        self._chain = OffsetChain(diagonal + equations.information.reshape(diagonal.shape), ahead,
                                  pull[:, self._near].tocsr(), of_near[:, self._near])
        self._pull, self._tie = pull[:, self._far], of_near[:, self._far].tocsc()
        self._offset_right = equations.right
        cross = [self._on_far(*self._solve(*part)) for part in self._border(np.eye(len(self._far)))]
        self._far_covariance = np.linalg.inv(of_far[:, self._far].toarray() - np.concatenate(cross, axis=1))

    def _solve(self, sides: np.ndarray, near: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Nodes (k, p, r) and near offsets for right sides (k p, r) and (n, r), the far offsets fixed."""
        return self._chain.solve(sides.reshape(*self.right.shape, -1), near)

    def _border(self, columns: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """What far offsets (f, r) do to the right sides of nodes and near offsets, some columns at a time."""
        for begin in range(0, columns.shape[1], _COLUMNS):
            some = columns[:, begin:begin + _COLUMNS]
            yield self._pull @ some, self._tie @ some

    def _on_far(self, state: np.ndarray, near: np.ndarray) -> np.ndarray:
        """(f, r) what nodes (k, p, r) and near offsets (n, r) do to the right sides of the far offsets."""
        return self._pull.T @ state.reshape(self._pull.shape[0], -1) + self._tie.T @ near

    def solved(self) -> HeldSolution:
        """States and offsets, both unknown, with their covariances."""
        chain, right = self._chain, self._offset_right
        sides, near = self.right.reshape(-1, 1), right[self._near, None]
        far = self._far_covariance @ (right[self._far, None] - self._on_far(*self._solve(sides, near)))
        state, found = self._solve(sides - self._pull @ far, near - self._tie @ far)
        offset, variance = np.empty((2, len(right)))
        offset[self._near], offset[self._far] = found[:, 0], far[:, 0]
        covariance, lagged, near_variance = chain.covariance.copy(), chain.lagged.copy(), chain.offset_variance.copy()
        for part in self._border(np.linalg.cholesky(self._far_covariance)):
            columns, of_near = self._solve(*part)
            covariance += columns @ np.swapaxes(columns, 1, 2)
            lagged += columns[:-1] @ np.swapaxes(columns[1:], 1, 2)
            near_variance += (of_near**2).sum(axis=1)
        variance[self._near], variance[self._far] = near_variance, np.diag(self._far_covariance)
        return HeldSolution(state[..., 0], covariance, lagged, offset, variance)

    def response(self, sides: np.ndarray) -> np.ndarray:
        """(k, p, r) states for right sides (k p, r) of the nodes alone, the offsets following them."""
        near = np.zeros((len(self._near), sides.shape[1]))
        far = self._far_covariance @ self._on_far(*self._solve(sides, near))
        return self._solve(sides + self._pull @ far, self._tie @ far)[0]
