"""Offsets of walls from observations whose errors are one-sided and partly shared.

An observation's own error is Gaussian noise; with some probability an exponential delay on top (NLOS-delayed beyond the
path traced: always late); or the observation is an outlier (anything within tens of metres). How often and how
much is learnt from all observations. Offsets of all walls and the latent errors of all passes are estimated together,
so that an error shared by the observations of a pass widens the sigma of every wall that they speak of.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_matrix
from scipy.special import log_ndtr, logsumexp

from ...progress import SILENT, Progress
from .offset_observations import OffsetObservations

OUTLIER_SPAN = 80.0  # Outliers are spread evenly over this length, m.
CHUNK = 2000
# What no number of observations makes smaller, m: facades are not planes, and antennas are not where the
# trajectory says.
FACADE = 0.1
ANTENNA = 0.3  # What the trajectory of a pass may be off by before a wall, m; passes are off apart.
USUAL = 5.0  # Observations that the scatter of all observations counts for in that of one wall.

_GRID = np.arange(-4.0, 4.0001, 0.02)
"""Offsets that are tried for each wall, m."""

_ROUNDS, _JUMPS = 60, 10
"""Steps at most, and the first of them in which a wall may go to a better maximum."""


@dataclass(frozen=True)
class ErrorModel:
    """Error of an observation: `sigma` (m) besides its noise, factor `noise` on the variance of the noise, share and
    mean (m) of NLOS-delayed ones, share of outliers."""

    sigma: float = 0.6
    noise: float = 1.0
    nlos_share: float = 0.2
    nlos_mean_delay: float = 4.0
    outlier_share: float = 0.1

    def variance(self, noise: np.ndarray) -> np.ndarray:
        """Variance of undelayed errors, m2, by the variance of the observations' noise."""
        return self.sigma**2 + self.noise * noise

    def log_parts(self, error: np.ndarray, variance: np.ndarray) -> np.ndarray:
        """(3, ...) logarithms of the densities of errors: undelayed, NLOS-delayed, outlier, each with its share."""
        sigma = np.sqrt(self.variance(variance))
        rate = 1.0 / self.nlos_mean_delay
        inlier = -0.5 * (error / sigma) ** 2 - np.log(np.sqrt(2 * np.pi) * sigma)
        delayed = np.log(rate) + 0.5 * (sigma * rate) ** 2 - rate * error + log_ndtr(error / sigma - sigma * rate)
        outlier = np.full(error.shape, -np.log(OUTLIER_SPAN))
        return np.stack([inlier + np.log(1 - self.nlos_share - self.outlier_share), delayed + np.log(self.nlos_share),
                         outlier + np.log(self.outlier_share)])

    def shares(self, error: np.ndarray, variance: np.ndarray) -> np.ndarray:
        """(3, n) probabilities that errors are undelayed, NLOS-delayed, outlier."""
        logs = self.log_parts(error, variance)
        return np.exp(logs - logsumexp(logs, axis=0))


@dataclass(frozen=True)
class Offsets:
    """Estimates for the walls that have observations.

    Attributes
    ----------
    wall : (k,) their numbers.
    offset : (k,) outwards, m.
    sigma : (k,) m.
    rival : (k,) share of the probability that lies nearer to another maximum than to the best one.
    inlier : (v,) probability that each observation is neither NLOS-delayed nor an outlier.
    error : (v,) what is left of each observation, m.
    model : the error model learnt.
    """

    wall: np.ndarray
    offset: np.ndarray
    sigma: np.ndarray
    rival: np.ndarray
    inlier: np.ndarray
    error: np.ndarray
    model: ErrorModel


def estimate_offsets(observations: OffsetObservations, prior_sigma: float, model: ErrorModel | None = None,
                     learn: bool = True, progress: Progress = SILENT) -> Offsets:
    """Offsets of all walls with observations.

    Parameters
    ----------
    prior_sigma : how far walls are off before anything is measured, m (normal about 0).
    model : to begin with, or to keep.
    learn : whether the error model is fitted to the observations; else it is taken as it is.
    """
    model = model or ErrorModel()
    system = _System.of(observations, prior_sigma)
    offset, latent = system.start(model), [np.zeros(share.shape[1]) for share in system.share]
    fitted = np.zeros(len(observations))
    for number in range(_ROUNDS):
        progress.check()
        error = system.errors(offset, latent)
        if learn:
            model = _learnt(model, model.shares(error, observations.variance), error, observations.variance, fitted)
        new_offset, latent, covariance, fitted = system.improved(offset, latent, model)
        if number < _JUMPS:
            jumped = system.best_on_grid(latent, model)
            new_offset = np.where(np.abs(jumped - new_offset) > 0.25, jumped, new_offset)
        moved = np.abs(new_offset - offset).max(initial=0.0)
        offset = new_offset
        if moved < 1e-3 and number > 5:
            break
    return system.summary(offset, latent, model, covariance)


def _learnt(model: ErrorModel, share: np.ndarray, error: np.ndarray, variance: np.ndarray,
            fitted: np.ndarray) -> ErrorModel:
    """The error model that fits errors best, one step of expectation and maximisation, with weak priors.

    The priors count as 20 observations, so that a handful of observations does not make a model of its own. `fitted` is
    the variance of what was fitted to each observation: what offsets and latent errors have taken up of the errors is
    added.
    """
    count, weight = share.shape[1], 20.0
    _, delayed, outlier = share.sum(axis=1)
    total = count + weight
    sigma2, noise = _spread(model, share[0], error**2 + np.minimum(fitted, model.variance(variance)), variance, weight)
    beyond = (share[1] * np.maximum(error, 0.0)).sum() + weight * 0.2 * 4.0
    return replace(model, sigma=float(np.sqrt(sigma2)), noise=float(noise),
                   nlos_share=float((delayed + 0.2 * weight) / total),
                   outlier_share=float((outlier + 0.1 * weight) / total),
                   nlos_mean_delay=float(np.clip(beyond / (delayed + 0.2 * weight), 1.0, 15.0)))


def _spread(model: ErrorModel, share: np.ndarray, square: np.ndarray, variance: np.ndarray, weight: float
            ) -> tuple[float, float]:
    """Variance besides the noise, and the factor of the noise, from squared undelayed errors by `share`.

    Weighted least squares of square = sigma2 + noise * variance; priors keep 0.6 m and 1.
    """
    expected = model.variance(variance)
    rate = share / (2 * expected**2)
    matrix = np.array([[rate.sum(), rate @ variance], [rate @ variance, rate @ variance**2]])
    right = np.array([rate @ square, rate @ (variance * square)])
    usual = np.array([0.6**2, 1.0])
    # A prior observation is one with an error of about its sigma, and a factor of the noise known to a third.
    prior = np.array([weight / (2 * 0.6**4), 9.0 / 2])
    sigma2, noise = np.linalg.solve(matrix + np.diag(prior), right + prior * usual)
    return float(np.clip(sigma2, 0.3**2, 6.0**2)), float(np.clip(noise, 0.3, 6.0))


@dataclass(frozen=True)
class _System:
    """Observations with walls numbered 0 to k-1 and latent errors scaled to unit variance."""

    observations: OffsetObservations
    walls: np.ndarray
    wall: np.ndarray
    of_pass: tuple[np.ndarray, ...]
    share: tuple[np.ndarray, ...]
    prior: float

    @classmethod
    def of(cls, observations: OffsetObservations, prior: float) -> _System:
        walls, wall = np.unique(observations.wall, return_inverse=True)
        of_pass, share = [], []
        for number, (rows, covariance) in enumerate(zip(observations.share, observations.covariance)):
            members = np.flatnonzero(observations.source == number)
            if not len(members):
                continue
            of_pass.append(members)
            # What matters of the latent errors is what reaches the observations: their principal parts.
            u, size, _ = np.linalg.svd(rows @ np.linalg.cholesky(covariance), full_matrices=False)
            significant = size > 1e-3 * size.max(initial=0.0)
            share.append(u[:, significant] * size[significant])
        return cls(observations, walls, wall.ravel(), tuple(of_pass), tuple(share), prior)

    def errors(self, offset: np.ndarray, latent: list[np.ndarray]) -> np.ndarray:
        """(v,) what offsets and latent errors leave of the observations."""
        return self.observations.value - self.shared(latent) + 2 * self.observations.cosine * offset[self.wall]

    def shared(self, latent: list[np.ndarray]) -> np.ndarray:
        """(v,) what the latent errors add to the observations."""
        added = np.zeros(len(self.observations))
        for members, share, value in zip(self.of_pass, self.share, latent):
            added[members] = share @ value
        return added

    def log_posterior(self, latent: list[np.ndarray], model: ErrorModel) -> np.ndarray:
        """(k, grid) log probability of each offset of the grid for each wall, latent errors held."""
        remaining = self.observations.value - self.shared(latent)
        log = np.zeros((len(self.walls), len(_GRID)))
        for first in range(0, len(remaining), CHUNK):
            some = slice(first, first + CHUNK)
            error = remaining[some, None] + 2 * self.observations.cosine[some, None] * _GRID
            each = np.logaddexp.reduce(model.log_parts(error, self.observations.variance[some, None]), axis=0)
            of_wall = csr_matrix((np.ones(len(each)), (self.wall[some], np.arange(len(each)))), (len(log), len(each)))
            log += of_wall @ each
        return log - 0.5 * (_GRID / self.prior) ** 2

    def best_on_grid(self, latent: list[np.ndarray], model: ErrorModel) -> np.ndarray:
        """(k,) most probable offset of each wall."""
        return _GRID[self.log_posterior(latent, model).argmax(axis=1)]

    def start(self, model: ErrorModel) -> np.ndarray:
        return self.best_on_grid([np.zeros(share.shape[1]) for share in self.share], model)

    def improved(self, offset, latent, model):
        """One Newton step for all offsets and latent errors; covariance of the offsets; variance of what is fitted."""
        error = self.errors(offset, latent)
        slope, curvature = _derivatives(model, error, self.observations.variance)
        design = 2 * self.observations.cosine
        normal = np.diag(np.bincount(self.wall, design**2 * curvature) + self.prior**-2.0)
        right = -np.bincount(self.wall, design * slope) - offset / self.prior**2
        blocks = []
        for members, share, value in zip(self.of_pass, self.share, latent):
            weight = curvature[members]
            normal_matrix = (share * weight[:, None]).T @ share + np.eye(share.shape[1])
            cross = np.zeros((len(offset), share.shape[1]))
            np.add.at(cross, self.wall[members], -(design[members] * weight)[:, None] * share)
            gradient = share.T @ slope[members] - value
            inverse = np.linalg.inv(normal_matrix)
            normal -= cross @ inverse @ cross.T
            right -= cross @ (inverse @ gradient)
            blocks.append((inverse, cross, gradient))
        covariance = np.linalg.inv(normal)
        step = np.clip(covariance @ right, -0.5, 0.5)
        latent = [value + inverse @ (gradient - cross.T @ step)
                  for value, (inverse, cross, gradient) in zip(latent, blocks)]
        fitted = design**2 * np.diag(covariance)[self.wall]
        for members, share, (inverse, _, _) in zip(self.of_pass, self.share, blocks):
            fitted[members] += np.einsum("ij,jk,ik->i", share, inverse, share)
        return offset + step, latent, covariance, fitted

    def summary(self, offset, latent, model, covariance) -> Offsets:
        """Offsets with sigma: spread of the posterior, widened by what the shared errors add."""
        log = self.log_posterior(latent, model)
        density = np.exp(log - log.max(axis=1, keepdims=True))
        density /= density.sum(axis=1, keepdims=True)
        mean = density @ _GRID
        spread = np.einsum("kg,kg->k", density, (_GRID - mean[:, None]) ** 2)
        error = self.errors(offset, latent)
        _, curvature = _derivatives(model, error, self.observations.variance)
        separate = 1.0 / (np.bincount(self.wall, (2 * self.observations.cosine) ** 2 * curvature) + self.prior**-2.0)
        shared = np.maximum(np.diag(covariance) - separate, 0.0)
        inlier = model.shares(error, self.observations.variance)[0]
        widened = spread * self._scatter(error, inlier, model)
        limit = FACADE**2 + ANTENNA**2 / self._passes()
        return Offsets(self.walls, mean, np.sqrt(widened + shared + limit), _rival(density), inlier, error, model)

    def _passes(self) -> np.ndarray:
        """(k,) passes that have observations of each wall."""
        pairs = np.unique(np.column_stack([self.wall, self.observations.source]), axis=0)
        return np.bincount(pairs[:, 0], minlength=len(self.walls))

    def _scatter(self, error: np.ndarray, inlier: np.ndarray, model: ErrorModel) -> np.ndarray:
        """(k,) factor on the variance of walls whose observations scatter more than the model of all observations
        says."""
        square = np.bincount(self.wall, inlier * error**2 / model.variance(self.observations.variance))
        count = np.bincount(self.wall, inlier)
        return np.maximum((square + USUAL) / (np.maximum(count - 1.0, 0.0) + USUAL), 1.0)


def _derivatives(model: ErrorModel, error: np.ndarray, variance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First derivative of -log density by the error, and a positive curvature (that of expectation-maximisation)."""
    share = model.shares(error, variance)
    sigma = np.sqrt(model.variance(variance))
    x = error / sigma - sigma / model.nlos_mean_delay
    hazard = np.exp(-0.5 * x**2 - 0.5 * np.log(2 * np.pi) - log_ndtr(x))
    slope = share[0] * error / sigma**2 + share[1] * (1.0 / model.nlos_mean_delay - hazard / sigma)
    return slope, share[0] / sigma**2 + share[1] * np.maximum(hazard * (hazard + x), 0.0) / sigma**2 + 1e-9


def _rival(density: np.ndarray) -> np.ndarray:
    """(k,) probability beyond the valleys around the highest maximum."""
    rival = np.zeros(len(density))
    for row, values in enumerate(density):
        top = int(values.argmax())
        left = top
        while left > 0 and values[left - 1] <= values[left]:
            left -= 1
        right = top
        while right < len(values) - 1 and values[right + 1] <= values[right]:
            right += 1
        rival[row] = values[:left].sum() + values[right + 1:].sum()
    return rival
