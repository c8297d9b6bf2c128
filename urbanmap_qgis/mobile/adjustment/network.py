"""Least-squares network of several drives: drifting corrections tied to each other, to control and to a reference.

The correction of each drive is a Gauss-Markov process along its path (see `gauss_markov`). Ties state the difference of
two corrections, control points and reference markings the correction itself. One sparse normal matrix holds them all;
gross observations lose their weight (Cauchy). Place and heading are adjusted; roll and pitch stay as reported: they are
better known from the inertial unit than from markings. How far facades stand inside the outlines is one unknown of all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix
from scipy.sparse.linalg import splu

from ...wording import mark
from ..registration.correction.gauss_markov import GaussMarkovDrift

TIE, CONTROL, REFERENCE, PLANE, WALL = range(5)
KINDS = (mark("tie"), mark("control point"), mark("reference marking"), mark("plane"), mark("wall"))
RELATIVE_KINDS = (TIE, PLANE)
"""Kinds that state the difference of two corrections; the others place a drive."""

ACROSS_KINDS = (PLANE, WALL)
"""Kinds that are known in one direction in plan, and say next to nothing along it."""

NONE = -1
"""Number of the other drive of an observation of one drive alone."""


@dataclass(frozen=True)
class AdjustmentNetworkLimits:
    """Limits of adjustment network, each with its unit."""

    factors: tuple[float, ...] = (1.0, 2.0, 4.0, 8.0)
    passes: int = 30
    converged: float = 1e-3  # change of weights
    columns: int = 384  # of the covariance that are solved for at once
    active: tuple[float, ...] = (0, 1, 2, 5)  # of the drift's parameters: east, north, up, heading


LIMITS = AdjustmentNetworkLimits()

_DIMENSIONS = len(LIMITS.active)
_RADIANS = np.pi / 180.0


@dataclass(frozen=True)
class DriveNodes:
    """Nodes of a drive's correction.

    Attributes
    ----------
    parameter : (k,) m, of the path with its stops (see `gauss_markov`), increasing.
    stops : (k - 1,) s that the vehicle stands between nodes.
    jumps : (k - 1,) m by which the trajectory jumps there.
    fast : (k - 1,) m by which its error in plan changes there faster than drift; None for nowhere.
    """

    parameter: np.ndarray
    stops: np.ndarray
    jumps: np.ndarray
    fast: np.ndarray | None = None

    def __len__(self) -> int:
        return len(self.parameter)


@dataclass(frozen=True)
class NetworkObservations:
    """What is known of corrections, a row each.

    Attributes
    ----------
    drive : (n,) number of the drive.
    parameter : (n,) m, its path parameter there.
    arm : (n, 2) m east, north, from the drive's body to the place that is observed.
    other : (n,) the drive that it is tied to, or NONE.
    other_parameter, other_arm : the same of it; 0 where there is none.
    value : (n, 4) by how much `drive` moves the place more than `other`: east, north, up (m), and turns it, clockwise
        (degrees); NaN for what is not observed.
    covariance : (n, 4, 4), m and degrees.
    kind : (n,) TIE, CONTROL, REFERENCE, PLANE or WALL.
    outward : (n, 2) unit vectors of walls, by which a common offset of all of them moves what is observed; 0 of others.
    """

    drive: np.ndarray
    parameter: np.ndarray
    arm: np.ndarray
    other: np.ndarray
    other_parameter: np.ndarray
    other_arm: np.ndarray
    value: np.ndarray
    covariance: np.ndarray
    kind: np.ndarray
    outward: np.ndarray | None = None

    def __post_init__(self) -> None:
        if self.outward is None:
            object.__setattr__(self, "outward", np.zeros((len(self.drive), 2)))

    def __len__(self) -> int:
        return len(self.drive)

    def select(self, which: np.ndarray) -> NetworkObservations:
        """Some of the rows, by mask or index."""
        return NetworkObservations(*(getattr(self, field.name)[which] for field in fields(self)))

    @classmethod
    def none(cls) -> NetworkObservations:
        """No observation."""
        whole, real, arm = np.zeros(0, int), np.zeros(0), np.zeros((0, 2))
        return cls(whole, real, arm, whole, real, arm, np.zeros((0, _DIMENSIONS)),
                   np.zeros((0, _DIMENSIONS, _DIMENSIONS)), whole)

    @classmethod
    def joined(cls, parts: Sequence[NetworkObservations]) -> NetworkObservations:
        """All rows of several, in their order."""
        parts = [cls.none(), *parts]
        return cls(*(np.concatenate([getattr(part, field.name) for part in parts]) for field in fields(cls)))


def plan_residuals(observations: NetworkObservations, residual: np.ndarray) -> np.ndarray:
    """Size (n,) in plan, m, of residuals (n, 4); of planes and walls only across them."""
    size = np.hypot(*residual[:, :2].T)
    planes = np.isin(observations.kind, ACROSS_KINDS)
    if planes.any():
        across = np.linalg.eigh(observations.covariance[planes, :2, :2])[1][:, :, 0]
        size[planes] = np.abs((residual[planes, :2] * across).sum(axis=1))
    return size


def plan_information(observations: NetworkObservations) -> np.ndarray:
    """(n,) 1 / m2, what each row says of the place in plan, over both directions; nothing of the heading."""
    return np.trace(_information(observations)[:, :2, :2], axis1=1, axis2=2)


@dataclass(frozen=True)
class NetworkSettings:
    """Parameters of the adjustment.

    Attributes
    ----------
    model : drift of the reported trajectories (see `GaussMarkovDrift`); its size is looked for, its shape is not.
    gross : standard deviations from which an observation loses its weight.
    least_noise : of the stated variance of the observations, however small their residuals: neighbouring ties share
        markings.
    offset_sigma : m, standard deviation of the common offset of all walls before any observation.
    """

    model: GaussMarkovDrift
    gross: float = 3.0
    least_noise: float = 1.0
    offset_sigma: float = 0.3


@dataclass(frozen=True)
class Network:
    """The adjusted network.

    Attributes
    ----------
    state : for each drive (k, 4, 2): correction east, north, up (m), heading (degrees) and its rate at the nodes.
    covariance : for each drive (k, 4, 4), m and degrees, of the corrections at the nodes.
    residual : (n, 4), observed less adjusted; NaN where not observed.
    weight : (n,) 0 to 1, by which gross observations were kept.
    drift_factor, noise_factor : found sizes of drift and of the observations' variance.
    offset : m, by which all walls stand farther inside than their observations took them to; 0 without walls.
    """

    state: tuple[np.ndarray, ...]
    covariance: tuple[np.ndarray, ...]
    residual: np.ndarray
    weight: np.ndarray
    drift_factor: float
    noise_factor: float
    offset: float = 0.0


def adjust_network(drives: Sequence[DriveNodes], observations: NetworkObservations,
                   settings: NetworkSettings) -> Network:
    """Adjust all drives at once; the size of their drift is the most likely one of a few.

    Without any observation of a drive alone (control, reference) the drives' mean error is not observed: the
    covariance then holds what `settings.model.initial_sigma` says of it.
    """
    design = _design(drives, observations)
    fits = [_robust_fit(drives, design, observations, settings, factor) for factor in LIMITS.factors]
    best = max(fits, key=lambda fit: fit.likelihood)
    offsets = np.concatenate([[0], np.cumsum([len(drive) for drive in drives])])
    state = best.solution[:2 * _DIMENSIONS * offsets[-1]].reshape(-1, _DIMENSIONS, 2)
    covariance = _covariances(best.factors, offsets[-1])
    parts = [slice(first, last) for first, last in zip(offsets[:-1], offsets[1:])]
    return Network(tuple(state[part] for part in parts), tuple(covariance[part] for part in parts),
                   np.where(np.isfinite(observations.value), best.residual, np.nan), best.weight, best.drift_factor,
                   best.noise, float(best.solution[2 * _DIMENSIONS * offsets[-1]:].sum()))


@dataclass(frozen=True)
class _Fit:
    solution: np.ndarray
    factors: object  # SuperLU
    residual: np.ndarray
    weight: np.ndarray
    drift_factor: float
    noise: float
    likelihood: float


def _design(drives: Sequence[DriveNodes], observations: NetworkObservations) -> csc_matrix:
    """Matrix (4 n, 8 k) that takes the states of all nodes to the observed differences; with walls (4 n, 8 k + 1)."""
    offsets = np.concatenate([[0], np.cumsum([len(drive) for drive in drives])])
    rows, columns, values = [], [], []
    heading = _DIMENSIONS - 1
    for drive, parameter, arm, sign in ((observations.drive, observations.parameter, observations.arm, 1.0),
                                    (observations.other, observations.other_parameter, observations.other_arm, -1.0)):
        for number, nodes in enumerate(drives):
            of_drive = np.flatnonzero(drive == number)
            node = np.searchsorted(0.5 * (nodes.parameter[1:] + nodes.parameter[:-1]), parameter[of_drive])
            ahead = parameter[of_drive] - nodes.parameter[node]
            # Clockwise rotation moves what lies north to the east, and what lies east to the south.
            terms = [(axis, axis, np.ones(len(of_drive))) for axis in range(_DIMENSIONS)]
            terms += [(0, heading, _RADIANS * arm[of_drive, 1]), (1, heading, -_RADIANS * arm[of_drive, 0])]
            for seen, axis, factor in terms:
                column = 2 * ((offsets[number] + node) * _DIMENSIONS + axis)
                rows += [of_drive * _DIMENSIONS + seen] * 2
                columns += [column, column + 1]
                values += [sign * factor, sign * factor * ahead]
    walls = np.flatnonzero(observations.kind == WALL)
    for axis in range(2):
        rows.append(walls * _DIMENSIONS + axis)
        columns.append(np.full(len(walls), 2 * _DIMENSIONS * offsets[-1]))
        values.append(observations.outward[walls, axis])
    size = (len(observations) * _DIMENSIONS, 2 * _DIMENSIONS * offsets[-1] + _offsets(observations))
    return coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=size).tocsc()


def _offsets(observations: NetworkObservations) -> int:
    """Number of unknowns behind those of the nodes: with walls their common offset."""
    return int((observations.kind == WALL).any())


def _prior(drives: Sequence[DriveNodes], model: GaussMarkovDrift, offsets: int,
           offset_sigma: float) -> tuple[csc_matrix, float]:
    """Normal matrix (8 k, 8 k) of the drift of all drives, and the logarithm of its determinant.

    `offsets` more unknowns are known to `offset_sigma` m.
    """
    rows, columns, values, determinant, first = [], [], [], 0.0, 0
    axes, active = np.arange(_DIMENSIONS), list(LIMITS.active)
    for nodes in drives:
        transition, precision = model.steps(nodes.parameter, nodes.stops, nodes.jumps, LIMITS.active,
                                            0.0 if nodes.fast is None else nodes.fast)
        k = len(nodes)
        index = 2 * ((first + np.arange(k))[:, None, None] * _DIMENSIONS + axes[:, None]) + np.arange(2)  # (k, 4, 2)
        # A step's error is state[i + 1] - F state[i]: blocks F'PF, -F'P, -PF, P.
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
        first += k
    last = np.arange(offsets) + 2 * _DIMENSIONS * first
    rows.append(last)
    columns.append(last)
    values.append(np.full(offsets, offset_sigma**-2.0))
    size = 2 * _DIMENSIONS * first + offsets
    matrix = coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(size, size))
    return matrix.tocsc(), determinant


def _robust_fit(drives: Sequence[DriveNodes], design: csc_matrix, observations: NetworkObservations,
                settings: NetworkSettings, factor: float) -> _Fit:
    """The adjustment with one size of drift, weights and variance of the observations iterated to convergence."""
    prior, log_prior = _prior(drives, settings.model.scaled(factor), _offsets(observations), settings.offset_sigma)
    information, value = _information(observations), np.nan_to_num(observations.value)
    weight, noise = np.ones(len(observations)), 1.0
    for _ in range(LIMITS.passes):
        normal = (design.T @ _block_diagonal(information * (weight / noise)[:, None, None]) @ design + prior).tocsc()
        right = design.T @ np.einsum("nij,nj->ni", information * (weight / noise)[:, None, None], value).ravel()
        factors = splu(normal, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        solution = factors.solve(right)
        residual = value - (design @ solution).reshape(-1, _DIMENSIONS)
        misfit = np.einsum("ni,nij,nj->n", residual, information, residual) / _observed(observations)
        last, weight = weight, 1.0 / (1.0 + misfit / noise / settings.gross**2)
        noise_before, noise = noise, _noise(misfit, settings)
        if not len(weight) or (np.abs(weight - last).max() < LIMITS.converged
                               and abs(noise / noise_before - 1.0) < LIMITS.converged):
            break
    return _Fit(solution, factors, residual, weight, factor, noise,
                _likelihood(solution, prior, log_prior, factors, misfit, noise, observations, settings))


def _likelihood(solution: np.ndarray, prior: csc_matrix, log_prior: float, factors, misfit: np.ndarray, noise: float,
                observations: NetworkObservations, settings: NetworkSettings) -> float:
    """Logarithm of the evidence for a size of drift (Laplace), with the robust loss of the observations."""
    count = _observed(observations)
    loss = 0.5 * count * (settings.gross**2 * np.log1p(misfit / noise / settings.gross**2) + np.log(noise))
    log_normal = float(np.log(np.abs(factors.U.diagonal())).sum())
    return 0.5 * (log_prior - log_normal) - 0.5 * float(solution @ (prior @ solution)) - float(loss.sum())


def _observed(observations: NetworkObservations) -> np.ndarray:
    """(n,) how many of east, north, up and heading each row observes."""
    return np.maximum(np.isfinite(observations.value).sum(axis=1), 1)


def _information(observations: NetworkObservations) -> np.ndarray:
    """(n, 4, 4) inverse covariances; zero for what is not observed."""
    known = np.isfinite(observations.value)
    both = known[:, :, None] & known[:, None, :]
    covariance = np.where(both, observations.covariance, np.eye(_DIMENSIONS))
    return np.where(both, np.linalg.inv(covariance), 0.0)


def _block_diagonal(blocks: np.ndarray) -> csc_matrix:
    """Sparse matrix (4 n, 4 n) with (n, 4, 4) on its diagonal."""
    n = len(blocks)
    index = np.arange(n * _DIMENSIONS).reshape(n, _DIMENSIONS)
    rows = np.broadcast_to(index[:, :, None], blocks.shape).ravel()
    columns = np.broadcast_to(index[:, None, :], blocks.shape).ravel()
    return coo_matrix((blocks.ravel(), (rows, columns)), shape=(n * _DIMENSIONS,) * 2).tocsc()


def _noise(misfit: np.ndarray, settings: NetworkSettings) -> float:
    """Factor of the observations' variance by the median of their squared misfit; the median bears outliers."""
    if len(misfit) < 10:
        return 1.0
    return max(settings.least_noise, float(np.median(misfit)) / 0.84)  # the median of a reduced chi square of 4


def _covariances(factors, nodes: int) -> np.ndarray:
    """(nodes, 4, 4) covariance of the corrections at each node."""
    covariance = np.empty((nodes, _DIMENSIONS, _DIMENSIONS))
    size = factors.shape[0]
    at_once = max(LIMITS.columns // _DIMENSIONS, 1)
    for first in range(0, nodes, at_once):
        chunk = np.arange(first, min(first + at_once, nodes))
        position = 2 * (chunk[:, None] * _DIMENSIONS + np.arange(_DIMENSIONS))  # (m, 4)
        right = np.zeros((size, position.size))
        right[position.ravel(), np.arange(position.size)] = 1.0
        columns = factors.solve(right).reshape(size, len(chunk), _DIMENSIONS)
        covariance[chunk] = columns[position, np.arange(len(chunk))[:, None], :]
    return 0.5 * (covariance + np.swapaxes(covariance, 1, 2))
