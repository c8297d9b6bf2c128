"""How the error of a survey's trajectory drifts: a Gauss-Markov process over the driven path and over time.

The error's rate wanders and forgets itself within a length (an integrated Ornstein-Uhlenbeck process), on top of a
small random walk: smooth where it is observed, and nearly rigid with growing uncertainty where it is not. The clock of
the process is the driven way, to which time adds a little: a waiting vehicle is neither forgotten nor frozen.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...trajectory import Trajectory, jumps, path_chainage


@dataclass(frozen=True)
class DriftModel:
    """Sizes of the process for dx, dy, dz (m) and droll, dpitch, dheading (degrees).

    Attributes
    ----------
    rate : (6,) standard deviation of the drift, per metre of clock.
    length : m of clock in which the rate forgets itself.
    wander : (6,) random walk, in the root of a metre of clock.
    initial : (6,) standard deviation of the error as a whole.
    standing : m/s; a second counts as so many metres driven.
    waiting : m in the root of a second: random walk of the place while the vehicle stands.
    """

    rate: np.ndarray
    length: float
    wander: np.ndarray
    initial: np.ndarray
    standing: float
    waiting: float

    def scaled(self, factor: float) -> DriftModel:
        """The same with drift and wander `factor` times as large."""
        return replace(self, rate=self.rate * factor, wander=self.wander * factor)

    def with_angles(self, factor: float) -> DriftModel:
        """The same with errors of the angles `factor` times as large."""
        part = np.array([1.0, 1.0, 1.0, factor, factor, factor])
        return replace(self, rate=self.rate * part, wander=self.wander * part, initial=self.initial * part)

    def steps(self, clock: np.ndarray, waited: np.ndarray, torn: np.ndarray,
              active: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
        """Transitions (k, 2, 2) of (error, rate) and their precisions (k, d, 2, 2) between k + 1 clock readings.

        Parameters
        ----------
        waited : (k,) s that the vehicle stands in each step.
        torn : (k,) m by which the trajectory jumps: the error may jump by so much too, and angles by a degree a metre.
        """
        place = np.isin(active, (0, 1, 2))
        loose = np.where(place, self.waiting**2 * waited[:, None], 0.0) + torn[:, None] ** 2
        h = np.maximum(np.diff(clock), 1e-6)[:, None]
        rate2 = (self.rate[list(active)] ** 2)[None, :]
        ratio = h / self.length
        keep = np.exp(-ratio)
        transition = np.zeros((len(h), 2, 2))
        transition[:, 0, 0], transition[:, 1, 1] = 1.0, keep[:, 0]
        transition[:, 0, 1] = self.length * -np.expm1(-ratio[:, 0])
        # Of short steps by the series, which the closed form loses in rounding.
        spread = np.where(ratio < 0.02, 2 * ratio**3 / 3 - ratio**4 / 2, 2 * ratio - 3 + 4 * keep - keep**2)
        error = rate2 * self.length**2 * spread + (self.wander[list(active)] ** 2)[None, :] * h + loose
        both = rate2 * self.length * np.expm1(-ratio) ** 2
        rates = rate2 * -np.expm1(-2 * ratio)
        determinant = error * rates - both**2
        precision = np.stack([np.stack([rates, -both], -1), np.stack([-both, error], -1)], -2)
        return transition, precision / determinant[:, :, None, None]


def drift_clock(trajectory: Trajectory, standing: float) -> np.ndarray:
    """Readings (n,) of the process's clock at the trajectory's epochs, m."""
    return path_chainage(trajectory) + standing * (trajectory.time - trajectory.time[0])


def waited_steps(trajectory: Trajectory, time: np.ndarray) -> np.ndarray:
    """(k,) s that the vehicle stands between k + 1 times."""
    still = np.diff(path_chainage(trajectory)) == 0
    waited = np.concatenate([[0.0], np.cumsum(np.diff(trajectory.time) * still)])
    return np.diff(np.interp(time, trajectory.time, waited))


def torn_steps(trajectory: Trajectory, time: np.ndarray) -> np.ndarray:
    """(k,) m by which the trajectory jumps between k + 1 times; 0 where it does not."""
    torn = np.zeros(len(time) - 1)
    for start, end in jumps(trajectory):
        first, last = np.searchsorted(trajectory.time, [start, end])
        step = float(np.linalg.norm(trajectory.place[last] - trajectory.place[first]))
        k = int(np.clip(np.searchsorted(time, 0.5 * (start + end)) - 1, 0, len(torn) - 1))
        torn[k] = max(torn[k], step)
    return torn
