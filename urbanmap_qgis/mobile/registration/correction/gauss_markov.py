"""How the error of a survey's trajectory drifts: a Gauss-Markov process over path and time.

The error's rate wanders and forgets itself within a length (an integrated Ornstein-Uhlenbeck process), on top of a
small random walk: smooth where it is observed, and nearly rigid with growing uncertainty where it is not. It runs
over a path parameter: chainage, to which time adds a little, so that a standing vehicle drifts on slowly.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...trajectory import Trajectory, jumps, path_chainage


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

    def with_angles(self, factor: float) -> GaussMarkovDrift:
        """The same with errors of the angles `factor` times as large."""
        part = np.array([1.0, 1.0, 1.0, factor, factor, factor])
        return replace(self, rate_sigma=self.rate_sigma * part, random_walk=self.random_walk * part,
                       initial_sigma=self.initial_sigma * part)

    def steps(self, path_parameter: np.ndarray, stopped: np.ndarray, jump: np.ndarray,
              active: tuple[int, ...], fast: np.ndarray | float = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """Transitions (k, 2, 2) of (error, rate) and their precisions (k, d, 2, 2) between k + 1 path parameters.

        Parameters
        ----------
        stopped : (k,) s that the vehicle stands in each step.
        jump : (k,) m by which the trajectory jumps: the error may jump by so much too, and angles by a degree a metre.
        fast : (k,) m by which the error in plan changes in each step where it does so faster than drift (a re-fix).
        """
        place = np.isin(active, (0, 1, 2))
        loose = np.where(place, self.stop_walk**2 * stopped[:, None], 0.0) + jump[:, None] ** 2
        loose = loose + np.isin(active, (0, 1)) * np.broadcast_to(fast, len(jump))[:, None] ** 2
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


def path_parameters_of(trajectory: Trajectory, time_weight: float) -> np.ndarray:
    """Path parameters (n,) at the trajectory's epochs, m."""
    return path_chainage(trajectory) + time_weight * (trajectory.time - trajectory.time[0])


def stop_steps(trajectory: Trajectory, time: np.ndarray) -> np.ndarray:
    """(k,) s that the vehicle stands between k + 1 times."""
    still = np.diff(path_chainage(trajectory)) == 0
    stopped = np.concatenate([[0.0], np.cumsum(np.diff(trajectory.time) * still)])
    return np.diff(np.interp(time, trajectory.time, stopped))


def jump_steps(trajectory: Trajectory, time: np.ndarray) -> np.ndarray:
    """(k,) m by which the trajectory jumps between k + 1 times; 0 where it does not."""
    jump = np.zeros(len(time) - 1)
    for start, end in jumps(trajectory):
        first, last = np.searchsorted(trajectory.time, [start, end])
        step = float(np.linalg.norm(trajectory.place[last] - trajectory.place[first]))
        k = int(np.clip(np.searchsorted(time, 0.5 * (start + end)) - 1, 0, len(jump) - 1))
        jump[k] = max(jump[k], step)
    return jump
