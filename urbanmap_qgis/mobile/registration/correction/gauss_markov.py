"""How the error of a survey's trajectory drifts: a Gauss-Markov process over path and time.

The error's rate wanders and forgets itself within a length (an integrated Ornstein-Uhlenbeck process), on top of a
small random walk: smooth where it is observed, and nearly rigid with growing uncertainty where it is not. It runs
over a path parameter: chainage, to which time adds a little, so that a standing vehicle drifts on slowly.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ....geometry.tolerances import LEAST_DIVISOR
from ...trajectory import Trajectory, jumps, path_chainage

STILL, CREPT = 0.03, 0.25
"""m that a vehicle moves while it counts as standing (standard deviation), and more of it as a share of what its
trajectory wanders ahead: it may have crept."""

MIN_STOP = 1.0  # s, of a stop whose wandering tells a speed

NOT_AHEAD, AHEAD = 0.3, 0.5
"""m/s, below which a vehicle stands whose trajectory goes ahead by less than this share of its way."""

SLOW = 1.5
"""m/s, below which a vehicle counts as slowing down for a stop or leaving it: as fast as its trajectory wanders in the
stop it may wander there, unseen. Half of that is taken for its error, with half of it as standard deviation."""


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

    def steps(self, path_parameter: np.ndarray, stopped: np.ndarray, jump: np.ndarray,
              active: tuple[int, ...], fast: np.ndarray | float = 0.0,
              stop_variance: np.ndarray | None = None,
              fast_up: np.ndarray | float = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """Transitions (k, 2, 2) of (error, rate) and their precisions (k, d, 2, 2) between k + 1 path parameters.

        Parameters
        ----------
        stopped : (k,) s that the vehicle stands in each step.
        jump : (k,) m by which the trajectory jumps: the error may jump by so much too, and angles by a degree a metre.
        fast : (k,) m by which the error in plan changes in each step where it does so faster than drift (a re-fix).
        stop_variance : (k,) m2 of the place in the time that the vehicle stands, where its movement is known.
        fast_up : (k,) m by which the error in height changes faster than drift.
        """
        place = np.isin(active, (0, 1, 2))
        standing = self.stop_walk**2 * stopped if stop_variance is None else stop_variance
        loose = np.where(place, standing[:, None], 0.0) + jump[:, None] ** 2
        for axes, change in (((0, 1), fast), ((2,), fast_up)):
            loose = loose + np.isin(active, axes) * np.broadcast_to(change, len(jump))[:, None] ** 2
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


@dataclass(frozen=True)
class StopMovement:
    """What a standing vehicle's trajectory wanders is its error: the vehicle does not move.

    Attributes
    ----------
    moved : (k, 3) m, by which the reported place wanders in the stops between k + 1 times.
    variance : (k,) m2, of what the vehicle may have moved itself there.
    """

    moved: np.ndarray
    variance: np.ndarray

    @classmethod
    def of(cls, trajectory: Trajectory, time: np.ndarray) -> StopMovement:
        """Of a trajectory between times (k + 1,)."""
        wandered, spread = still_wandering(trajectory), standing_variance(trajectory)
        return cls(np.diff(np.column_stack([np.interp(time, trajectory.time, axis) for axis in wandered.T]), axis=0),
                   np.diff(np.interp(time, trajectory.time, spread)))


def _goes_ahead(trajectory: Trajectory) -> np.ndarray:
    """(e - 1,) mask of steps between epochs that go ahead for the most part, over about a second."""
    time, heading = trajectory.time, np.unwrap(np.radians(trajectory.angles[:, 2]))
    middle = 0.5 * (time[1:] + time[:-1])
    begin, end = (np.column_stack([np.interp(middle + side, time, axis) for axis in trajectory.place[:, :2].T])
                  for side in (-0.5, 0.5))
    east, north = (end - begin).T
    heading = np.interp(middle, time, heading)
    return east * np.sin(heading) + north * np.cos(heading) > AHEAD * np.hypot(east, north)


@dataclass(frozen=True)
class _Stops:
    """Runs of slow steps of a trajectory, those about a stop.

    Attributes
    ----------
    still, beside : (e - 1,) steps in which the vehicle stands, and those in which it slows down or starts.
    span : (e - 1,) s.
    run : (e - 1,) number of each step's run, 0 for none.
    total : (r, 3) m, wandered while standing.
    ahead : (r,) m, of that ahead.
    """

    still: np.ndarray
    beside: np.ndarray
    span: np.ndarray
    run: np.ndarray
    total: np.ndarray
    ahead: np.ndarray

    @classmethod
    def of(cls, trajectory: Trajectory) -> _Stops:
        """The stops of a trajectory."""
        still, creeping, slow = (np.diff(path_chainage(trajectory, *speed)) == 0
                                 for speed in ((), (NOT_AHEAD,), (SLOW,)))
        still |= creeping & ~_goes_ahead(trajectory)
        slow |= still
        run = np.where(slow, np.cumsum(slow & ~np.concatenate([[False], slow[:-1]])), 0)
        step = np.diff(trajectory.place, axis=0) * still[:, None]
        heading = np.radians(trajectory.angles[:-1, 2])
        ahead = step[:, 0] * np.sin(heading) + step[:, 1] * np.cos(heading)
        return cls(still, slow & ~still, np.diff(trajectory.time), run,
                   np.column_stack([np.bincount(run, axis) for axis in step.T]),
                   np.maximum(np.bincount(run, ahead), 0.0))

    def _seconds(self, mask: np.ndarray) -> np.ndarray:
        """(r,) s of each run's steps of a mask."""
        return np.bincount(self.run, self.span * mask)

    def speed(self) -> np.ndarray:
        """(r, 3) m/s, at which the trajectory wanders while the vehicle stands."""
        return self.total / np.maximum(self._seconds(self.still), MIN_STOP)[:, None]

    def variance(self) -> np.ndarray:
        """(e - 1,) m2, of what the vehicle may have moved in each step beyond what is taken for its error."""
        standing, beside = self._seconds(self.still), self._seconds(self.beside)
        still = np.where(standing > 0, (STILL + CREPT * self.ahead) ** 2 / np.maximum(standing, LEAST_DIVISOR), 0.0)
        slow = (0.5 * np.linalg.norm(self.speed(), axis=1)) ** 2 * beside
        return self.span * np.where(self.still, still[self.run], np.where(self.beside, slow[self.run], 0.0))


def still_wandering(trajectory: Trajectory) -> np.ndarray:
    """(e, 3) m, what the reported place wandered up to each epoch while the vehicle stood, or was about to."""
    stops = _Stops.of(trajectory)
    step = np.diff(trajectory.place, axis=0) * stops.still[:, None]
    step += 0.5 * stops.speed()[stops.run] * (stops.span * stops.beside)[:, None]
    return np.concatenate([np.zeros((1, 3)), np.cumsum(step, axis=0)])


def standing_variance(trajectory: Trajectory) -> np.ndarray:
    """(e,) m2, of what the vehicle itself may have moved up to each epoch in all that counts as standing."""
    return np.concatenate([[0.0], np.cumsum(_Stops.of(trajectory).variance())])


def stilled(trajectory: Trajectory) -> Trajectory:
    """The trajectory without what it wandered in stops: later places move by all that was wandered before."""
    return replace(trajectory, place=trajectory.place - still_wandering(trajectory))


def jump_steps(trajectory: Trajectory, time: np.ndarray) -> np.ndarray:
    """(k,) m by which the trajectory jumps between k + 1 times; 0 where it does not."""
    jump = np.zeros(len(time) - 1)
    for start, end in jumps(trajectory):
        first, last = np.searchsorted(trajectory.time, [start, end])
        step = float(np.linalg.norm(trajectory.place[last] - trajectory.place[first]))
        k = int(np.clip(np.searchsorted(time, 0.5 * (start + end)) - 1, 0, len(jump) - 1))
        jump[k] = max(jump[k], step)
    return jump
