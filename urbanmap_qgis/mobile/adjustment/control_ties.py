"""Control points as observations of the drives that measured them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...errors import InputError
from ...wording import say
from ..control import ControlPoints
from ..trajectory import Trajectory, interpolate
from .network import CONTROL, NONE, NetworkObservations
from .records import AdjustmentRun
from .ties import Drive

_REACH = 60.0
"""m from the vehicle within which it measures a control point."""


def control_observations(drives: Sequence[Drive], control: ControlPoints, run: AdjustmentRun) -> NetworkObservations:
    """Control points as observations of the drives that measured them.

    Raises
    ------
    InputError : a point was measured by none of the drives.
    """
    away = np.stack([_away(drive.trajectory, control) for drive in drives])
    number = np.argmin(away, axis=0)
    nearest = away.min(axis=0)
    if (nearest > _REACH).any():
        name = control.id[int(np.argmax(nearest))]
        raise InputError(say("Control point {name} was measured by none of the drives: no trajectory passes within "
                             "{control_reach:.0f} m of it at its time.", name=name, control_reach=_REACH))
    n = len(control)
    parameter, arm = np.zeros(n), np.zeros((n, 2))
    for k, drive in enumerate(drives):
        of_drive = number == k
        parameter[of_drive] = np.interp(control.time[of_drive], drive.trajectory.time,
                                        run.path_parameters(drive.trajectory))
        arm[of_drive] = (control.surveyed - interpolate(drive.trajectory, control.time, "hold").place)[of_drive, :2]
    value = np.column_stack([control.true - control.surveyed, np.full(n, np.nan)])
    variance = np.array([run.control_sigma, run.control_sigma, run.control_sigma_z, 1.0]) ** 2
    return NetworkObservations(number, parameter, arm, np.full(n, NONE), np.zeros(n), np.zeros((n, 2)), value,
                        np.tile(np.diag(variance), (n, 1, 1)), np.full(n, CONTROL))


def _away(trajectory: Trajectory, control: ControlPoints) -> np.ndarray:
    """Distance (n,) in plan, m, from the vehicle to each point in the survey at its time; inf outside the drive."""
    place = interpolate(trajectory, control.time, "hold").place
    away = np.hypot(*(control.surveyed - place)[:, :2].T)
    return np.where(trajectory.within(control.time), away, np.inf)
