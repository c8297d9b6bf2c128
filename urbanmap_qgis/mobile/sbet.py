"""Applanix SBET: latitude and longitude in radians, angles in radians from true north, ellipsoidal heights."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from pyproj import CRS, Proj, Transformer

from ..errors import InputError
from ..io.conversion.geoid import Geoid
from ..io.files.guard import first_not_finite
from ..io.reference.system_parts import parsed_crs, plan_part
from ..wording import say
from .trajectory import Trajectory

SBET_SUFFIXES = (".out", ".sbet")

_RECORD = np.dtype([(name, "<f8") for name in (
    "time", "latitude", "longitude", "altitude", "velocity_x", "velocity_y", "velocity_z", "roll", "pitch", "heading",
    "wander", "acceleration_x", "acceleration_y", "acceleration_z", "rate_x", "rate_y", "rate_z")])
_TURN = 6.4  # radians; no angle of a body is more


def read_sbet(path: Path, crs_wkt: str | None) -> np.ndarray:
    """The records (n,) of a file as it holds them.

    Raises
    ------
    InputError : it is no SBET file or is cut off, a value is no number, or no map coordinates (`crs_wkt`) are known.
    """
    if not crs_wkt:
        raise InputError(say("{path} is in latitude and longitude: the coordinate reference system of the survey "
                             "must be known; store it in the point cloud or give it.", path=path.name))
    size = path.stat().st_size
    if size == 0 or size % _RECORD.itemsize:
        raise InputError(say("{path} is no SBET file or is cut off: its length is no multiple of {itemsize} bytes.",
                             path=path.name, itemsize=_RECORD.itemsize))
    records = np.fromfile(path, _RECORD)
    if not (np.abs(records["latitude"]) < 1.6).all() or not (np.abs(records["longitude"]) < 6.3).all():
        raise InputError(say("{path} is no SBET file: its latitudes are no angles in radians.", path=path.name))
    bad = first_not_finite(records.view("<f8").reshape(len(records), -1))
    if bad is not None:
        raise InputError(say("{path} has no number in record {bad}: export it again, or remove the record.",
                             path=path.name, bad=bad + 1))
    if any(np.abs(records[name]).max() > _TURN for name in ("roll", "pitch", "heading")):
        raise InputError(say("{path}: its angles are no radians, as those of an SBET are: export it again.",
                             path=path.name))
    return records


def sbet_poses(records: np.ndarray, crs_wkt: str, geoid: Geoid | None, name: str) -> tuple[np.ndarray, str]:
    """Time, place (m) and angles (degrees) of records in map coordinates (n, 7), and a sentence on their heights.

    Raises
    ------
    InputError : a record lies outside the coordinate reference system.
    """
    x, y, convergence = _projected(records, crs_wkt)
    height, applied = _heights(records, geoid, name)
    table = np.column_stack([records["time"], x, y, height, *np.degrees([records["roll"],
                             records["pitch"]]), np.degrees(records["heading"]) - convergence])
    bad = first_not_finite(table)
    if bad is not None:
        raise InputError(say("{path} lies outside the coordinate reference system of the survey at record {bad}: "
                             "choose the right one.", path=name, bad=bad + 1))
    return table, applied


def sbet_records(trajectory: Trajectory, given: Mapping[str, Sequence], crs_wkt: str,
                 geoid: Geoid | None) -> np.ndarray:
    """Records (n,) of a trajectory; velocities, accelerations and rates are those of the fields given."""
    records = np.empty(len(trajectory), _RECORD)
    for name in _RECORD.names:
        records[name] = given[name]
    crs = plan_part(parsed_crs(crs_wkt))
    back = Transformer.from_crs(crs, crs.geodetic_crs, always_xy=True)
    longitude, latitude = back.transform(trajectory.place[:, 0], trajectory.place[:, 1])
    records["longitude"], records["latitude"] = np.radians(longitude), np.radians(latitude)
    above = 0.0 if geoid is None else geoid.interpolate(longitude, latitude)
    records["altitude"] = trajectory.place[:, 2] + above
    heading = trajectory.angles[:, 2] + _convergence(crs, longitude, latitude)
    records["roll"], records["pitch"] = np.radians(trajectory.angles[:, :2].T)
    records["heading"] = np.radians((heading + 180.0) % 360.0 - 180.0)
    return records


def _heights(records: np.ndarray, geoid: Geoid | None, name: str) -> tuple[np.ndarray, str]:
    """Heights (n,), above the geoid where one is given, and a sentence on it."""
    if geoid is None:
        return records["altitude"], ""
    above = geoid.interpolate(np.degrees(records["longitude"]), np.degrees(records["latitude"]))
    return records["altitude"] - above, (say("{name}: ellipsoidal heights were lowered by {min:.3f} to {max:.3f} m "
                                             "to heights above the geoid ({geoid}).", name=name, min=above.min(),
                                             max=above.max(), geoid=geoid.name))


def _projected(records: np.ndarray, crs_wkt: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Map coordinates and meridian convergence (degrees, grid north east of true north)."""
    crs = plan_part(parsed_crs(crs_wkt))
    longitude, latitude = np.degrees(records["longitude"]), np.degrees(records["latitude"])
    x, y = Transformer.from_crs(crs.geodetic_crs, crs, always_xy=True).transform(longitude, latitude)
    return x, y, _convergence(crs, longitude, latitude)


def _convergence(crs: CRS, longitude: np.ndarray, latitude: np.ndarray) -> np.ndarray:
    return np.asarray(Proj(crs).get_factors(longitude, latitude).meridian_convergence)
