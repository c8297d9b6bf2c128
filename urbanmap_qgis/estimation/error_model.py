"""How the error of poses goes along the path: places drift, angles stay within what their sensor is known for.

The error of a place is that of `GaussMarkovDrift`, which has no bounds. That of an angle is a stationary and smooth
process (Matern, 3/2), whose standard deviation is the accuracy of the inertial unit: however long the drive, markings
and ground must contradict the reported angle by more than it before they turn the body.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .gauss_markov import GaussMarkovDrift, PathLinks

ANGLES = (3, 4, 5)
PITCH = ANGLES[1]
_SHORT = 0.02  # of the correlation length: shorter steps by the leading terms, which the closed form loses in rounding


@dataclass(frozen=True)
class AttitudeError:
    """Stationary errors of roll, pitch and heading.

    Attributes
    ----------
    sigma : (k, 3) degrees, standard deviations at the k nodes.
    correlation_length : (3,) m of path parameter in which an error forgets itself.
    """

    sigma: np.ndarray
    correlation_length: np.ndarray

    def times(self, factor: tuple[float, float, float]) -> AttitudeError:
        """The same with standard deviations so many times as large, which change at the same rate: a constant error."""
        return AttitudeError(self.sigma * np.array(factor), self.correlation_length * np.array(factor))

    def start(self) -> np.ndarray:
        """(3, 2) variances of the error and of its rate at the first node."""
        rate = np.sqrt(3.0) / self.correlation_length
        return self.sigma[0][:, None] ** 2 * np.stack([np.ones(3), rate**2], axis=1)

    def steps(self, path_parameter: np.ndarray, jump: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Transitions (k - 1, 3, 2, 2) of (error, rate) and their precisions between the nodes.

        `jump` : (k - 1,) m by which the trajectory jumps: angles may jump by a degree a metre.
        """
        h = np.maximum(np.diff(path_parameter), 1e-6)
        units = [_unit_steps(np.sqrt(3.0) / length, h) for length in self.correlation_length]
        unit, spread = (np.stack(parts, axis=1) for parts in zip(*units))
        before, after = self.sigma[:-1], self.sigma[1:]
        transition = unit * (after / before)[:, :, None, None]
        variance = spread * (after**2)[:, :, None, None]
        variance[..., 0, 0] += jump[:, None] ** 2
        return transition, np.linalg.inv(variance)


def _unit_steps(rate: float, h: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Transitions (k, 2, 2) of the process with standard deviation 1 over steps (k,) m, and what comes in (k, 2, 2)."""
    keep, t = np.exp(-rate * h), rate * h
    transition = np.stack([np.stack([1 + t, h], -1), np.stack([-rate * t, 1 - t], -1)], -2) * keep[:, None, None]
    still = np.diag([1.0, rate**2])
    closed = still - transition @ still @ np.swapaxes(transition, 1, 2)
    density = 4 * rate**3
    series = density * np.stack([np.stack([h**3 / 3, h**2 / 2], -1), np.stack([h**2 / 2, h], -1)], -2)
    return transition, np.where((t < _SHORT)[:, None, None], series, 0.5 * (closed + np.swapaxes(closed, 1, 2)))


@dataclass(frozen=True)
class PoseErrorModel:
    """Of the place, and of the angles."""

    place: GaussMarkovDrift
    attitude: AttitudeError

    def scaled(self, factor: float) -> PoseErrorModel:
        """The same with `factor` times the drift of the place."""
        return replace(self, place=self.place.scaled(factor))

    def with_heading(self, factor: float) -> PoseErrorModel:
        """The same with `factor` times the error of the heading."""
        return replace(self, attitude=self.attitude.times((1.0, 1.0, factor)))

    def with_pitch(self, factor: float) -> PoseErrorModel:
        """The same with `factor` times the error of the pitch, as fast as before: it is one sensor's."""
        attitude = self.attitude
        return replace(self, attitude=replace(attitude, sigma=attitude.sigma * np.array([1.0, factor, 1.0])))

    def between(self, first: int, last: int) -> PoseErrorModel:
        """The same of the nodes from one number to another alone."""
        return replace(self, attitude=replace(self.attitude, sigma=self.attitude.sigma[first:last + 1]))

    def start(self, active: tuple[int, ...]) -> np.ndarray:
        """(d, 2) variances of error and rate at the first node."""
        place = np.stack([self.place.initial_sigma, self.place.rate_sigma], axis=1) ** 2
        place[list(ANGLES)] = self.attitude.start()
        return place[list(active)]

    def steps(self, path_parameter: np.ndarray, links: PathLinks, active: tuple[int, ...],
              fast: np.ndarray | float = 0.0, fast_up: np.ndarray | float = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """Transitions and precisions (k - 1, d, 2, 2) between k nodes, see `GaussMarkovDrift.steps`."""
        transition, precision = self.place.steps(path_parameter, links, active, fast, fast_up)
        transition = np.repeat(transition[:, None], len(active), axis=1)
        angle_transition, angle_precision = self.attitude.steps(path_parameter, links.jump)
        for number, parameter in enumerate(active):
            if parameter in ANGLES:
                transition[:, number] = angle_transition[:, parameter - ANGLES[0]]
                precision[:, number] = angle_precision[:, parameter - ANGLES[0]]
        return transition, precision
