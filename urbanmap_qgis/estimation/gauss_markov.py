"""How the error of a trajectory drifts: a Gauss-Markov process over path and time.

The error's rate wanders and forgets itself within a length (an integrated Ornstein-Uhlenbeck process), on top of a
small random walk: smooth where it is observed, and nearly rigid with growing uncertainty where it is not. It runs
over a path parameter: chainage, to which time adds a little, so that a standing vehicle drifts on slowly.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class PathLinks:
    """What the vehicle did between k + 1 nodes of a path.

    Attributes
    ----------
    stopped : (k,) s that it stands.
    jump : (k,) m by which its trajectory jumps: the error may jump by so much too, and angles by a degree a metre.
    moved : (k, 3) m, by which the reported place wanders in stops.
    stop_variance : (k,) m2, of what the vehicle may have moved itself there; None where that is not known.
    """

    stopped: np.ndarray
    jump: np.ndarray
    moved: np.ndarray
    stop_variance: np.ndarray | None = None

    @classmethod
    def none(cls, count: int) -> PathLinks:
        """Of a drive without stops or jumps."""
        return cls(np.zeros(count), np.zeros(count), np.zeros((count, 3)))

    def select(self, which: slice) -> PathLinks:
        """Those between some of the nodes."""
        return replace(self, stopped=self.stopped[which], jump=self.jump[which], moved=self.moved[which],
                       stop_variance=None if self.stop_variance is None else self.stop_variance[which])

    def variance(self, stop_walk: float) -> np.ndarray:
        """(k,) m2 of the place in the time that the vehicle stands, from a random walk where nothing else is known."""
        return stop_walk**2 * self.stopped if self.stop_variance is None else self.stop_variance


@dataclass(frozen=True)
class GaussMarkovDrift:
    """Sizes of the process for dx, dy, dz (m) and droll, dpitch, dheading (degrees).

    Attributes
    ----------
    rate_sigma : (6,) standard deviation of the drift, per metre of path parameter.
    correlation_length : m of path parameter in which the rate forgets itself.
    random_walk : (6,) random walk, in the root of a metre of path parameter.
    initial_sigma : (6,) standard deviation of the error as a whole.
    time_weight : m/s; a second counts as so many metres driven.
    stop_walk : m in the root of a second: random walk of the place while the vehicle stands.
    """

    rate_sigma: np.ndarray
    correlation_length: float
    random_walk: np.ndarray
    initial_sigma: np.ndarray
    time_weight: float
    stop_walk: float

    def scaled(self, factor: float) -> GaussMarkovDrift:
        """The same with drift and random walk `factor` times as large."""
        return replace(self, rate_sigma=self.rate_sigma * factor, random_walk=self.random_walk * factor)

    def steps(self, path_parameter: np.ndarray, links: PathLinks, active: tuple[int, ...],
              fast: np.ndarray | float = 0.0, fast_up: np.ndarray | float = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """Transitions (k, 2, 2) of (error, rate) and their precisions (k, d, 2, 2) between k + 1 path parameters.

        Parameters
        ----------
        links : of the k steps.
        fast : (k,) m by which the error in plan changes in each step where it does so faster than drift (a re-fix).
        fast_up : (k,) m by which the error in height changes faster than drift.
        """
        place = np.isin(active, (0, 1, 2))
        loose = np.where(place, links.variance(self.stop_walk)[:, None], 0.0) + links.jump[:, None] ** 2
        for axes, change in (((0, 1), fast), ((2,), fast_up)):
            loose = loose + np.isin(active, axes) * np.broadcast_to(change, len(links.jump))[:, None] ** 2
        h = np.maximum(np.diff(path_parameter), 1e-6)[:, None]
        rate2 = (self.rate_sigma[list(active)] ** 2)[None, :]
        ratio = h / self.correlation_length
        keep = np.exp(-ratio)
        transition = np.zeros((len(h), 2, 2))
        transition[:, 0, 0], transition[:, 1, 1] = 1.0, keep[:, 0]
        transition[:, 0, 1] = self.correlation_length * -np.expm1(-ratio[:, 0])
        # Of short steps by the series, which the closed form loses in rounding.
        spread = np.where(ratio < 0.02, 2 * ratio**3 / 3 - ratio**4 / 2, 2 * ratio - 3 + 4 * keep - keep**2)
        error = rate2 * self.correlation_length**2 * spread + (self.random_walk[list(active)] ** 2)[None, :] * h + loose
        both = rate2 * self.correlation_length * np.expm1(-ratio) ** 2
        rates = rate2 * -np.expm1(-2 * ratio)
        determinant = error * rates - both**2
        precision = np.stack([np.stack([rates, -both], -1), np.stack([-both, error], -1)], -2)
        return transition, precision / determinant[:, :, None, None]
