"""How accurate a navigation says its angles and places are: columns of a table, or the RMS file of an Applanix SBET.

Stated accuracies of places are far too small between tall buildings, where reflected signals draw the solution away:
only how they differ from epoch to epoch is used (`lines/drift_adjustment.py`). Those of angles come from the inertial
unit and hold.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..io.files.named_table import number_table, numbers_of
from ..wording import say

SIGMA_COLUMNS = ("sd_roll", "sd_pitch", "sd_heading")
"""Columns with the standard deviations of the angles, in the unit of the angles; upper or lower case."""

PLACE_COLUMNS = (("sd_x", "sd_e", "sd_east", "sdeast"), ("sd_y", "sd_n", "sd_north", "sdnorth"))
"""Names of the columns with the standard deviations of easting and northing, m; upper or lower case."""

_LEAST_PLACE = 0.001  # m: what is stated below is taken as this
_LEAST = 0.001  # degrees: what is stated below is taken as this
_RMS = np.dtype([(name, "<f8") for name in ("time", "north", "east", "down", "velocity_north", "velocity_east",
                                           "velocity_down", "roll", "pitch", "heading")])
_MINUTES = 60.0  # of arc, in which the RMS file has angles


def sigma_of_columns(columns: Mapping[str, Sequence], counted: str, name: str) -> np.ndarray | None:
    """(n, 3) degrees, standard deviations of roll, pitch and heading by `SIGMA_COLUMNS`; None without these columns.

    `counted` : how the angles are counted, one of `trajectory_reading.ANGLES`.

    Raises
    ------
    InputError : one of the columns is missing, or a value is no number greater than 0.
    """
    known = {key.strip().lower(): key for key in columns}
    present = [column for column in SIGMA_COLUMNS if column in known]
    if not present:
        return None
    missing = [column for column in SIGMA_COLUMNS if column not in known]
    if missing:
        raise InputError(say("{name} has {there} but no {missing}: give the standard deviations of all three angles, "
                             "or of none.", name=name, there=", ".join(present), missing=", ".join(missing)))
    sigma = number_table(columns, known, SIGMA_COLUMNS, name)
    return _checked(np.degrees(sigma) if counted.startswith("radians") else sigma, name)


def place_sigma_of_columns(columns: Mapping[str, Sequence], name: str) -> np.ndarray | None:
    """(n, 2) m, standard deviations of easting and northing by `PLACE_COLUMNS`; None without these columns.

    Raises
    ------
    InputError : one of the two is missing, or a value is no number greater than 0.
    """
    known = {key.strip().lower(): key for key in columns}
    found = [next((known[other] for other in names if other in known), None) for names in PLACE_COLUMNS]
    if found == [None, None]:
        return None
    if None in found:
        raise InputError(say("{name} states the accuracy of {there} alone: give those of easting and northing "
                             "(sd_x, sd_y), or none.", name=name, there=found[0] or found[1]))
    sigma = np.array([numbers_of(columns[column], column, name) for column in found]).T
    return _checked_places(sigma, name)


def rms_file_of(path: Path) -> Path | None:
    """The RMS file of an SBET: `smrmsg_NAME.out` beside `sbet_NAME.out`, or `NAME_smrmsg.out`; None without one."""
    stem, suffix = path.stem, path.suffix
    names = [f"{stem}_smrmsg", f"smrmsg_{stem}"]
    if stem.lower().startswith("sbet"):
        names.insert(0, "smrmsg" + stem[4:])
    wanted = {f"{name}{ending}".lower() for name in names for ending in {suffix, ".out"}}
    return next((other for other in sorted(path.parent.iterdir()) if other.name.lower() in wanted), None)


def sigma_of_rms_file(path: Path, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviations at times (n,) from an Applanix RMS file: (n, 3) degrees of angles, (n, 2) m of east, north.

    Records of ten doubles, angles in minutes of arc.

    Raises
    ------
    InputError : it is no such file, or does not cover the times.
    """
    size = path.stat().st_size
    if size == 0 or size % _RMS.itemsize:
        raise InputError(say("{path} is no RMS file of an SBET or is cut off: its length is no multiple of "
                             "{itemsize} bytes; export it again, or put it elsewhere.", path=path.name,
                             itemsize=_RMS.itemsize))
    records = np.fromfile(path, _RMS)
    away = 1.0 + float(np.median(np.diff(records["time"]))) if len(records) > 1 else 1.0
    if not (np.diff(records["time"]) > 0).all() or records["time"][0] > time[0] + away or (
            records["time"][-1] < time[-1] - away):
        raise InputError(say("{path} does not belong to the trajectory: its times run from {time:.1f} to "
                             "{time_2:.1f} s, the trajectory's from {time_3:.1f} to {time_4:.1f} s; give that of the "
                             "same solution, or put it elsewhere.", path=path.name, time=records["time"][0],
                             time_2=records["time"][-1], time_3=time[0], time_4=time[-1]))
    angles, places = (np.column_stack([np.interp(time, records["time"], records[name]) for name in names])
                      for names in (("roll", "pitch", "heading"), ("east", "north")))
    return _checked(angles / _MINUTES, path.name), _checked_places(places, path.name)


def _checked(sigma: np.ndarray, name: str) -> np.ndarray:
    if not np.isfinite(sigma).all() or (sigma <= 0).any() or (sigma > 90.0).any():
        raise InputError(say("{name} holds a standard deviation of an angle that is not above 0 and below 90 "
                             "degrees: correct or remove it.", name=name))
    return np.maximum(sigma, _LEAST)


def _checked_places(sigma: np.ndarray, name: str) -> np.ndarray:
    if not np.isfinite(sigma).all() or (sigma <= 0).any():
        raise InputError(say("{name} holds a standard deviation of a place that is not above 0 m: correct or remove "
                             "it.", name=name))
    return np.maximum(sigma, _LEAST_PLACE)


def stated_place_accuracy(sigma: np.ndarray, name: str) -> str:
    """A sentence on what is stated of places."""
    plan = np.sqrt((sigma**2).mean(axis=1))
    return say("{name} states the accuracy of its places: {usual:.2f} m (median), at most {most:.2f} m.", name=name,
               usual=float(np.median(plan)), most=float(plan.max()))


def stated_accuracy(sigma: np.ndarray, name: str) -> str:
    """A sentence on what is stated."""
    roll, pitch, heading = np.median(sigma, axis=0)
    return (say("{name} states the accuracy of the angles: roll {roll:.3f}°, pitch {pitch:.3f}°, heading "
                "{heading:.3f}° (medians).", name=name, roll=roll, pitch=pitch, heading=heading))
