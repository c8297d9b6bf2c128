"""Observations of single distances that keep their weights while the evidence of markings is weighed against itself."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix

from ..matching.block_chain import ChainSolution, solve_chain

_COLUMNS = 256
"""Right sides that are solved for at once: memory grows with them and the path alone."""


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
    normal: np.ndarray
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
        normal, right = np.diag(precision), np.zeros(len(precision))
        right[0] = (mean - self.offset) * precision[0]
        places = node[:, None] * (2 * size) + np.arange(2 * size)
        of_node = (weight[:, None, None] * full).reshape(len(self), -1)
        for of_level in column.T:
            right += np.bincount(of_level, weight * self.target, len(precision))
            for other in column.T:
                np.add.at(normal, (of_level, other), weight)
        pull = coo_matrix((np.tile(of_node.ravel(), column.shape[1]), (
            np.tile(places.ravel(), column.shape[1]), np.repeat(column.T.ravel(), 2 * size))),
            shape=(nodes * 2 * size, len(precision)))
        return OffsetEquations(known[0], known[1], pull.tocsr(), normal, right)

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


class HeldSystem:
    """Normal equations of nodes and of the offsets of what is held, the offsets eliminated.

    Parameters
    ----------
    diagonal, ahead, right : (k, p, p), (k - 1, p, p), (k, p) of the nodes without what is held.
    """

    def __init__(self, diagonal: np.ndarray, ahead: np.ndarray, right: np.ndarray, equations: OffsetEquations):
        shape = diagonal.shape
        self._diagonal, self._ahead = diagonal + equations.information.reshape(shape), ahead
        self.right, self._equations = right + equations.node_right.reshape(right.shape), equations
        self._covariance: np.ndarray | None = None

    def _solve(self, sides: np.ndarray) -> ChainSolution:
        """The nodes for right sides (k p, r), the offsets fixed."""
        return solve_chain(self._diagonal, self._ahead, sides.reshape(*self.right.shape, -1))

    @property
    def offset_covariance(self) -> np.ndarray:
        """(m, m) m2, given all."""
        if self._covariance is None:
            pull, cross = self._equations.pull, []
            for first in range(0, pull.shape[1], _COLUMNS):
                followed = self._solve(pull[:, first:first + _COLUMNS].toarray()).state
                cross.append(pull.T @ followed.reshape(pull.shape[0], -1))
            self._covariance = np.linalg.inv(self._equations.normal - np.concatenate(cross, axis=1))
        return self._covariance

    def settled(self) -> tuple[np.ndarray, np.ndarray, ChainSolution]:
        """States (k, p), offsets (m,), and the nodes' solution with the offsets as their observations have them."""
        pull = self._equations.pull
        fixed = self._solve(self.right.ravel())
        offset = self.offset_covariance @ (self._equations.right - pull.T @ fixed.state.ravel())
        return self._solve(self.right.ravel() - pull @ offset).state[..., 0], offset, fixed

    def followers(self) -> Iterator[np.ndarray]:
        """Columns (k, p, r), some at a time: the sum of their products is what unknown offsets add to covariances."""
        pull, root = self._equations.pull, np.linalg.cholesky(self.offset_covariance)
        for first in range(0, root.shape[1], _COLUMNS):
            yield self._solve(pull @ root[:, first:first + _COLUMNS]).state

    def response(self, sides: np.ndarray) -> np.ndarray:
        """(k, p, r) states for right sides (k p, r) of the nodes alone, the offsets following them."""
        pull = self._equations.pull
        fixed = self._solve(sides).state.reshape(sides.shape)
        return self._solve(sides + pull @ (self.offset_covariance @ (pull.T @ fixed))).state
