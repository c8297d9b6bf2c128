"""The drift of several drives as one prior: nodes along each path, and what joins neighbouring ones.

The correction of each drive is a Gauss-Markov process (see `gauss_markov`). While the vehicle stands, what its
trajectory wanders is its error, as in the registration of one survey.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix

from ...estimation.gauss_markov import GaussMarkovDrift, PathLinks

ACTIVE = (0, 1, 2, 5)
"""Of the drift's parameters: east, north, up, heading."""


@dataclass(frozen=True)
class DriveNodes:
    """Nodes of a drive's correction.

    Attributes
    ----------
    parameter : (k,) m, of the path with its stops (see `gauss_markov`), increasing.
    links : of the nodes.
    fast : (k - 1,) m by which its error in plan changes there faster than drift; None for nowhere.
    lively : by how much it drifts more in plan than the model.
    """

    parameter: np.ndarray
    links: PathLinks
    fast: np.ndarray | None = None
    lively: float = 1.0

    def __len__(self) -> int:
        return len(self.parameter)

    def nearest(self, parameter: np.ndarray) -> np.ndarray:
        """(n,) number of the node nearest to path parameters (n,)."""
        return np.searchsorted(0.5 * (self.parameter[1:] + self.parameter[:-1]), parameter)

    def changes(self) -> np.ndarray:
        """(k - 1, 4) m, degrees, by which the correction changes between nodes as the vehicle stands there."""
        change = np.zeros((len(self) - 1, len(ACTIVE)))
        change[:, :3] = -self.links.moved
        return change

    def steps(self, model: GaussMarkovDrift) -> tuple[np.ndarray, np.ndarray]:
        """Transitions (k - 1, 2, 2) and precisions (k - 1, 4, 2, 2) of the drift between the nodes."""
        more = np.where(np.arange(len(model.rate_sigma)) < 2, self.lively, 1.0)
        model = replace(model, rate_sigma=model.rate_sigma * more, random_walk=model.random_walk * more)
        return model.steps(self.parameter, self.links, ACTIVE, 0.0 if self.fast is None else self.fast)


@dataclass(frozen=True)
class DriftPrior:
    """What is known of the states x (u,) of all nodes, and of unknowns behind them, before any observation.

    Its square is x'Mx - 2 right'x + constant.

    Attributes
    ----------
    matrix : (u, u) M.
    right : (u,).
    constant : the square at x = 0.
    determinant : logarithm of the determinant of M.
    """

    matrix: csc_matrix
    right: np.ndarray
    constant: float
    determinant: float

    def square(self, state: np.ndarray) -> float:
        """At states (u,)."""
        return float(state @ (self.matrix @ state) - 2.0 * self.right @ state) + self.constant


def drift_prior(drives: Sequence[DriveNodes], model: GaussMarkovDrift, offset_sigma: np.ndarray) -> DriftPrior:
    """The drift of all drives, and offsets behind their nodes.

    Parameters
    ----------
    offset_sigma : (u,) m, of the unknowns behind those of the nodes.
    """
    rows, columns, values, determinant, first = [], [], [], 0.0, 0
    axes, active = np.arange(len(ACTIVE)), list(ACTIVE)
    right, constant = [], 0.0
    for nodes in drives:
        transition, precision = nodes.steps(model)
        k, changes = len(nodes), nodes.changes()
        index = 2 * ((first + np.arange(k))[:, None, None] * len(ACTIVE) + axes[:, None]) + np.arange(2)  # (k, 4, 2)
        # A step's error is state[i + 1] - F state[i] - change: blocks F'PF, -F'P, -PF, P.
        carried = np.einsum("kji,kdjl->kdil", transition, precision)
        blocks = ((index[:-1], index[:-1], np.einsum("kdil,klm->kdim", carried, transition)),
                  (index[:-1], index[1:], -carried), (index[1:], index[:-1], -np.swapaxes(carried, 2, 3)),
                  (index[1:], index[1:], precision))
        for row, column, block in blocks:
            rows.append(np.broadcast_to(row[..., :, None], block.shape).ravel())
            columns.append(np.broadcast_to(column[..., None, :], block.shape).ravel())
            values.append(block.ravel())
        start = np.stack([model.initial_sigma[active], model.rate_sigma[active]], axis=1) ** -2.0
        rows.append(index[0].ravel())
        columns.append(index[0].ravel())
        values.append(start.ravel())
        determinant += float(np.log(np.linalg.det(precision)).sum() + np.log(start).sum())
        of_drive = np.zeros((k, len(ACTIVE), 2))
        of_drive[1:] += precision[..., 0] * changes[:, :, None]
        of_drive[:-1] -= carried[..., 0] * changes[:, :, None]
        right.append(of_drive.ravel())
        constant += float((precision[..., 0, 0] * changes**2).sum())
        first += k
    last = np.arange(len(offset_sigma)) + 2 * len(ACTIVE) * first
    rows.append(last)
    columns.append(last)
    values.append(offset_sigma**-2.0)
    size = 2 * len(ACTIVE) * first + len(offset_sigma)
    matrix = coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(size, size))
    right.append(np.zeros(len(offset_sigma)))
    return DriftPrior(matrix.tocsc(), np.concatenate(right), constant,
                      determinant - 2.0 * float(np.log(offset_sigma).sum()))
