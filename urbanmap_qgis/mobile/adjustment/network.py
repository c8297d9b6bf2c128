"""Least-squares network of several drives: drifting corrections tied to each other, to control and to a reference.

The correction of each drive is a Gauss-Markov process along its path (see `gauss_markov`). Ties state the difference of
two corrections, control points and reference markings the correction itself. One sparse normal matrix holds them all;
gross observations lose their weight (Cauchy). Place and heading are adjusted; roll and pitch stay as reported: they are
better known from the inertial unit than from markings. How far facades stand inside the outlines is one unknown of all;
what a building and each of its walls differ from it by are unknowns too, which all that was seen of them shares.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix
from scipy.sparse.linalg import splu

from ...estimation.gauss_markov import GaussMarkovDrift
from ...wording import mark
from .drive_drift import ACTIVE, DriftPrior, DriveNodes, drift_prior

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
    lively: tuple[float, ...] = (1.4, 2.0, 2.8, 4.0)  # by which single drives may drift more in plan
    passes: int = 30
    converged: float = 1e-3  # change of weights
    columns: int = 384  # of the covariance that are solved for at once


LIMITS = AdjustmentNetworkLimits()

_DIMENSIONS = len(ACTIVE)


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
    owner : (n, 2) numbers of a wall's building and of the wall, whose own offsets move it too; NONE of others.
    own_sigma : (n,) m, standard deviation of the place of a wall itself beside what walls differ by; 0 of others.
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
    owner: np.ndarray | None = None
    own_sigma: np.ndarray | None = None

    def __post_init__(self) -> None:
        if self.outward is None:
            object.__setattr__(self, "outward", np.zeros((len(self.drive), 2)))
        if self.owner is None:
            object.__setattr__(self, "owner", np.full((len(self.drive), 2), NONE))
        if self.own_sigma is None:
            object.__setattr__(self, "own_sigma", np.zeros(len(self.drive)))

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
    differ : m, standard deviations of what buildings differ from it by, and walls from their building.
    """

    model: GaussMarkovDrift
    gross: float = 3.0
    least_noise: float = 1.0
    offset_sigma: float = 0.3
    differ: tuple[float, float] = (0.3, 0.1)


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
    differ : m, by how much buildings differ from it and walls from their building, as the observations show it (root of
        the mean expected square); as stated where there are none.
    """

    state: tuple[np.ndarray, ...]
    covariance: tuple[np.ndarray, ...]
    residual: np.ndarray
    weight: np.ndarray
    drift_factor: float
    noise_factor: float
    offset: float = 0.0
    differ: tuple[float, float] = (0.3, 0.1)


def adjust_network(drives: Sequence[DriveNodes], observations: NetworkObservations,
                   settings: NetworkSettings) -> Network:
    """Adjust all drives at once; the size of their drift, and of each drive's in plan, is the most likely one of a few.

    Without any observation of a drive alone (control, reference) the drives' mean error is not observed: the
    covariance then holds what `settings.model.initial_sigma` says of it.
    """
    design = _design(drives, observations)
    fits = [_robust_fit(drives, design, observations, settings, factor) for factor in LIMITS.factors]
    best = _with_lively_drives(drives, design, observations, settings, max(fits, key=lambda fit: fit.likelihood))
    offsets = np.concatenate([[0], np.cumsum([len(drive) for drive in drives])])
    state = best.solution[:2 * _DIMENSIONS * offsets[-1]].reshape(-1, _DIMENSIONS, 2)
    covariance = _covariances(best.factors, offsets[-1])
    parts = [slice(first, last) for first, last in zip(offsets[:-1], offsets[1:])]
    return Network(tuple(state[part] for part in parts), tuple(covariance[part] for part in parts),
                   np.where(np.isfinite(observations.value), best.residual, np.nan), best.weight, best.drift_factor,
                   best.noise, *_wall_offsets(best, observations, settings))


@dataclass(frozen=True)
class _Fit:
    solution: np.ndarray
    factors: Any  # SuperLU
    residual: np.ndarray
    weight: np.ndarray
    drift_factor: float
    noise: float
    likelihood: float


def _with_lively_drives(drives: Sequence[DriveNodes], design: csc_matrix, observations: NetworkObservations,
                        settings: NetworkSettings, best: _Fit) -> _Fit:
    """The adjustment in which each drive drifts in plan as much more than all as is likeliest."""
    drives = list(drives)
    for number, usual in enumerate(drives):
        for lively in LIMITS.lively:
            tried = [*drives[:number], replace(usual, lively=lively), *drives[number + 1:]]
            fit = _robust_fit(tried, design, observations, settings, best.drift_factor)
            if fit.likelihood <= best.likelihood:
                break
            drives, best = tried, fit
    return best


def _design(drives: Sequence[DriveNodes], observations: NetworkObservations) -> csc_matrix:
    """Matrix (4 n, 8 k) that takes the states of all nodes to the observed differences; with walls more columns."""
    offsets = np.concatenate([[0], np.cumsum([len(drive) for drive in drives])])
    rows, columns, values = [], [], []
    heading = _DIMENSIONS - 1
    for drive, parameter, arm, sign in ((observations.drive, observations.parameter, observations.arm, 1.0),
                                    (observations.other, observations.other_parameter, observations.other_arm, -1.0)):
        for number, nodes in enumerate(drives):
            of_drive = np.flatnonzero(drive == number)
            node = nodes.nearest(parameter[of_drive])
            ahead = parameter[of_drive] - nodes.parameter[node]
            # Clockwise rotation moves what lies north to the east, and what lies east to the south.
            terms = [(axis, axis, np.ones(len(of_drive))) for axis in range(_DIMENSIONS)]
            terms += [(0, heading, np.radians(arm[of_drive, 1])), (1, heading, -np.radians(arm[of_drive, 0]))]
            for seen, axis, factor in terms:
                column = 2 * ((offsets[number] + node) * _DIMENSIONS + axis)
                rows += [of_drive * _DIMENSIONS + seen] * 2
                columns += [column, column + 1]
                values += [sign * factor, sign * factor * ahead]
    owners, levels, _ = _offset_unknowns(observations)
    walls = np.flatnonzero(observations.kind == WALL)
    for of_level in owners:
        for axis in range(2):
            rows.append(walls * _DIMENSIONS + axis)
            columns.append(2 * _DIMENSIONS * offsets[-1] + of_level)
            values.append(observations.outward[walls, axis])
    size = (len(observations) * _DIMENSIONS, 2 * _DIMENSIONS * offsets[-1] + len(levels))
    return coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=size).tocsc()


def _offset_unknowns(observations: NetworkObservations) -> tuple[list[np.ndarray], np.ndarray, np.ndarray]:
    """Unknowns behind those of the nodes: of each wall's row (w,) its column on every level, and each column's level
    and own standard deviation, m.

    Level 0 is the common offset of all walls, 1 what a building differs from it by, 2 what a wall differs from its
    building.
    """
    walls = observations.kind == WALL
    if not walls.any():
        return [], np.zeros(0, int), np.zeros(0)
    columns, levels, own = [np.zeros(np.count_nonzero(walls), int)], [np.zeros(1, int)], [np.zeros(1)]
    for level, number in enumerate(observations.owner[walls].T, start=1):
        _, first, column = np.unique(number, return_index=True, return_inverse=True)
        columns.append(sum(len(part) for part in levels) + column.ravel())
        levels.append(np.full(len(first), level))
        own.append(observations.own_sigma[walls][first] * (level == 2))
    return columns, np.concatenate(levels), np.concatenate(own)


def _wall_offsets(fit: _Fit, observations: NetworkObservations,
                  settings: NetworkSettings) -> tuple[float, tuple[float, float]]:
    """The common offset, m, and by how much buildings and walls differ: of each the expected square, given all that was
    observed, is what was found and its variance (expectation and maximisation: Dempster, Laird and Rubin 1977); of a
    wall whose place is unsure itself, of the part of it that the difference has.
    """
    _, levels, own = _offset_unknowns(observations)
    if not len(levels):
        return 0.0, settings.differ
    size = fit.factors.shape[0]
    right = np.zeros((size, len(levels)))
    right[size - len(levels):] = np.eye(len(levels))
    square = fit.solution[size - len(levels):] ** 2 + np.diag(fit.factors.solve(right)[size - len(levels):])
    stated = np.array([settings.offset_sigma, *settings.differ])[levels] ** 2
    share = stated / (stated + own**2)
    square = share**2 * square + share * own**2
    buildings, walls = (float(np.sqrt(square[levels == level].mean())) for level in (1, 2))
    return float(fit.solution[size - len(levels)]), (buildings, walls)


def _robust_fit(drives: Sequence[DriveNodes], design: csc_matrix, observations: NetworkObservations,
                settings: NetworkSettings, factor: float) -> _Fit:
    """The adjustment with one size of drift, weights and variance of the observations iterated to convergence."""
    _, levels, own = _offset_unknowns(observations)
    offset_sigma = np.hypot(np.array([settings.offset_sigma, *settings.differ])[levels], own)
    prior = drift_prior(drives, settings.model.scaled(factor), offset_sigma)
    information, value = _information(observations), np.nan_to_num(observations.value)
    weight, noise = np.ones(len(observations)), 1.0
    for _ in range(LIMITS.passes):
        weighted = information * (weight / noise)[:, None, None]
        normal = (design.T @ _block_diagonal(weighted) @ design + prior.matrix).tocsc()
        right = design.T @ np.einsum("nij,nj->ni", weighted, value).ravel() + prior.right
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
                _likelihood(solution, prior, factors, misfit, noise, observations, settings))


def _likelihood(solution: np.ndarray, prior: DriftPrior, factors, misfit: np.ndarray, noise: float,
                observations: NetworkObservations, settings: NetworkSettings) -> float:
    """Logarithm of the evidence for a size of drift (Laplace), with the robust loss of the observations."""
    count = _observed(observations)
    loss = 0.5 * count * (settings.gross**2 * np.log1p(misfit / noise / settings.gross**2) + np.log(noise))
    log_normal = float(np.log(np.abs(factors.U.diagonal())).sum())
    return 0.5 * (prior.determinant - log_normal) - 0.5 * prior.square(solution) - float(loss.sum())


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
