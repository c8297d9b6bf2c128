"""Several drives past the same buildings as one trajectory."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..errors import InputError
from ..mobile.trajectory import Trajectory, unwrapped


def joined(trajectories: Sequence[Trajectory], names: Sequence[str] = ()) -> Trajectory:
    """One trajectory of several that follow each other in time, in any order.

    Between two of them there is a gap, in which no observation is used.

    Raises
    ------
    InputError : two overlap in time.
    """
    order = sorted(range(len(trajectories)), key=lambda number: trajectories[number].time[0])
    for before, after in zip(order[:-1], order[1:]):
        if trajectories[after].time[0] <= trajectories[before].time[-1]:
            who = " and ".join(names[number] for number in (before, after)) if names else "Two trajectories"
            raise InputError(f"{who} overlap in time: give times that count on over the weeks (full GPS seconds), or "
                             "each place of the vehicle once.")
    parts = [trajectories[number] for number in order]
    return Trajectory(np.concatenate([part.time for part in parts]), np.concatenate([part.place for part in parts]),
                      unwrapped(np.concatenate([part.angles for part in parts])))
