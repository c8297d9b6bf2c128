"""What a trajectory wanders while the vehicle stands: its own error, as the vehicle does not move."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...estimation.gauss_markov import PathLinks
from ...geometry.tolerances import LEAST_DIVISOR
from ..trajectory import Trajectory, jumps, path_chainage

STILL, CREPT = 0.03, 0.25
"""m that a vehicle moves while it counts as standing (standard deviation), and more of it as a share of what its
trajectory wanders ahead: it may have crept."""

MIN_STOP = 1.0  # s, of a stop whose wandering tells a speed

NOT_AHEAD, AHEAD = 0.3, 0.5
"""m/s, below which a vehicle stands whose trajectory goes ahead by less than this share of its way."""

SLOW = 1.5
"""m/s, below which a vehicle counts as slowing down for a stop or leaving it: as fast as its trajectory wanders in the
stop it may wander there, unseen. Half of that is taken for its error, with half of it as standard deviation."""


def path_parameters_of(trajectory: Trajectory, time_weight: float) -> np.ndarray:
    """Path parameters (n,) at the trajectory's epochs, m."""
    return path_chainage(trajectory) + time_weight * (trajectory.time - trajectory.time[0])


def stop_steps(trajectory: Trajectory, time: np.ndarray) -> np.ndarray:
    """(k,) s that the vehicle stands between k + 1 times."""
    still = np.diff(path_chainage(trajectory)) == 0
    stopped = np.concatenate([[0.0], np.cumsum(np.diff(trajectory.time) * still)])
    return np.diff(np.interp(time, trajectory.time, stopped))


def links_along(trajectory: Trajectory, time: np.ndarray) -> PathLinks:
    """What a trajectory did between times (k + 1,), s."""
    wandered, spread = still_wandering(trajectory), standing_variance(trajectory)
    moved = np.diff(np.column_stack([np.interp(time, trajectory.time, axis) for axis in wandered.T]), axis=0)
    return PathLinks(stop_steps(trajectory, time), jump_steps(trajectory, time), moved,
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
