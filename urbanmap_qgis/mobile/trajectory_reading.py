"""How a trajectory's file counts angles and heights, and whether its headings go with the direction of travel.

Files of other programs hold radians, or headings counted counter-clockwise from east; read as degrees clockwise from
north such a trajectory turns every lever arm. The direction of travel tells: a vehicle drives where it heads.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..geometry.tolerances import ROUNDING
from ..io.conversion.geoid import Geoid
from ..wording import known, mark, say
from .trajectory import Trajectory, gaps, jumps, path_chainage, unwrapped

ANGLES = ("degrees", "radians", "degrees_from_east", "radians_from_east")
"""Ways of counting: unit of all angles, and headings clockwise from grid north or counter-clockwise from grid east."""

ANGLE_NAMES = (mark("degrees clockwise from grid north"), mark("radians clockwise from grid north"),
               mark("degrees counter-clockwise from east"), mark("radians counter-clockwise from east"))

STEP = 2.0  # m of path over which the direction of travel is taken
STEPS = 8  # so many of them say enough
AGREES = 5.0  # degrees; side slip and the mounting of the inertial unit stay below
STRANGE = 20.0
CLEARLY = 3.0

_RADIAN_LIMIT = 2.0 * np.pi + 0.01


@dataclass(frozen=True)
class TrajectoryReading:
    """How a file is read.

    Attributes
    ----------
    angles : one of `ANGLES`; SBET says it itself.
    geoid : by which ellipsoidal heights of SBET become those above sea level; None leaves them as they are.
    """

    angles: str = "degrees"
    geoid: Geoid | None = None

USUAL = TrajectoryReading()
"""Degrees clockwise from grid north, heights as they are."""


def from_file_angles(angles: np.ndarray, counted: str) -> np.ndarray:
    """Roll, pitch, heading (n, 3) of a file as degrees, headings clockwise from grid north."""
    degrees = np.degrees(angles) if counted.startswith("radians") else np.array(angles, float)
    if counted.endswith("from_east"):
        degrees[:, 2] = 90.0 - degrees[:, 2]
    return degrees


def to_file_angles(angles: np.ndarray, counted: str) -> np.ndarray:
    """The other way round."""
    converted = np.array(angles, float)
    if counted.endswith("from_east"):
        converted[:, 2] = 90.0 - converted[:, 2]
    return np.radians(converted) if counted.startswith("radians") else converted


def judged_headings(trajectory: Trajectory, angles: np.ndarray, counted: str, name: str) -> list[str]:
    """Notes on headings that do not go with the direction of travel.

    Parameters
    ----------
    angles : (n, 3) as the file has them.
    counted : how they were read, one of `ANGLES`.

    Raises
    ------
    InputError : read in another way of counting they go with it.
    """
    if counted.startswith("radians") and np.abs(angles).max(initial=0.0) > _RADIAN_LIMIT:
        raise InputError(say("{name}: angles of up to {max:.0f} are no radians: they are degrees; say so.", name=name,
                             max=np.abs(angles).max()))
    away = {way: _away(trajectory, angles, way) for way in ANGLES}
    off = away[counted]
    if not np.isfinite(off) or off <= AGREES:
        return []
    best = min(away, key=lambda way: away[way])
    if best != counted and angles.any() and away[best] <= AGREES and off > CLEARLY * away[best]:
        raise InputError(say("{name}: the headings lie {off:.0f}° beside the direction of travel (median), but read "
                             "as {angle_names} they go with it ({away:.1f}°): say that the angles are counted so, or "
                             "convert them to {angle_names_2}.", name=name, off=off,
                             angle_names=known(ANGLE_NAMES[ANGLES.index(best)]), away=away[best],
                             angle_names_2=known(ANGLE_NAMES[0])))
    if not np.ptp(angles, axis=0).any():
        return [say("{name} holds no attitude: roll, pitch and heading are {angles} at all epochs. Mounting angles and "
                    "corrections of the attitude are wrong by it; export the trajectory with its angles.", name=name,
                    angles=", ".join(f"{angle:g}" for angle in angles[0]))]
    if off > 180.0 - AGREES:
        return [say("{name}: the vehicle drove backwards, or its headings are half a turn off: they point against "
                    "the direction of travel.", name=name)]
    if off > STRANGE:
        return [say("{name}: the headings lie {off:.0f}° beside the direction of travel (median): where the body's x "
                    "axis does not point forward, the calibration must say the same; otherwise the headings are "
                    "wrong.", name=name, off=off)]
    return []


def axes_of_travel(orders: Mapping[bool, Trajectory]) -> bool | None:
    """Which of two orders of east and north lets headings go with the direction of travel; None where both or none do.

    Parameters
    ----------
    orders : the trajectory as it is if X counts north (True), and if it counts east (False).
    """
    away = {x_north: _away(found, found.angles, "degrees") for x_north, found in orders.items()}
    better = min(away, key=lambda x_north: away[x_north])
    # Not known (NaN) is no answer either.
    decided = away[better] <= AGREES and away[not better] > max(STRANGE, CLEARLY * away[better])
    return better if decided else None


def _away(trajectory: Trajectory, angles: np.ndarray, counted: str) -> float:
    """Median angle, degrees, between headings read in a way and the direction of travel; NaN where none is known."""
    if counted.startswith("radians") and np.abs(angles).max(initial=0.0) > _RADIAN_LIMIT:
        return np.inf
    chainage = path_chainage(trajectory)
    at = np.arange(0.0, chainage[-1] + ROUNDING, STEP)
    if len(at) <= STEPS:
        return np.nan
    rising = np.concatenate([[True], np.diff(chainage) > 0])
    time = np.interp(at, chainage[rising], trajectory.time[rising])
    x, y = (np.interp(time, trajectory.time, axis) for axis in trajectory.place[:, :2].T)
    course = np.degrees(np.arctan2(np.diff(x), np.diff(y)))
    heading = unwrapped(from_file_angles(angles, counted))[:, 2]
    middle = np.interp(0.5 * (time[1:] + time[:-1]), trajectory.time, heading)
    off = np.abs((middle - course + 180.0) % 360.0 - 180.0)[_driven(trajectory, time)]
    return float(np.median(off)) if len(off) >= STEPS else np.nan


def _driven(trajectory: Trajectory, time: np.ndarray) -> np.ndarray:
    """Mask (n - 1,) of the steps between times (n,) that lie in no gap and no jump of the trajectory."""
    driven = np.ones(len(time) - 1, bool)
    for start, end in np.concatenate([gaps(trajectory), jumps(trajectory)]):
        driven &= (time[1:] <= start) | (time[:-1] >= end)
    return driven
