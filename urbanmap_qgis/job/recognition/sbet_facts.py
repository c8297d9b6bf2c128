"""Trajectories of Applanix: SBET, told by their records."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...errors import InputError
from ...geometry.earth import WGS84
from ...io.conversion.reprojection import epsg_wkt
from ...mobile.gps_time import WEEK
from ...mobile.sbet import SBET_SUFFIXES
from ...wording import say
from ..file_facts import TRAJECTORY, FileFacts

_SBET_BYTES = 136


def is_sbet(path: Path, head: bytes) -> bool:
    """Whether a file holds records of an Applanix SBET: times that rise, latitudes and longitudes in radians."""
    if path.stat().st_size < 2 * _SBET_BYTES or b"\0" not in head:
        return False
    records = np.frombuffer(head[:len(head) // _SBET_BYTES * _SBET_BYTES], "<f8").reshape(-1, 17)
    return bool(np.isfinite(records).all() and (np.diff(records[:, 0]) > 0).all() and (records[:, 0] >= 0).all()
                and (np.abs(records[:, 1]) < 1.6).all() and (np.abs(records[:, 2]) < 3.2).all()
                and (np.abs(records[:, 3]) < 2e4).all() and (np.ptp(records[:, 0]) < WEEK))


def sbet_facts(path: Path, _head: bytes) -> list[FileFacts]:
    """What an SBET file is.

    Raises
    ------
    InputError : it is cut off within a record.
    """
    if path.stat().st_size % _SBET_BYTES:
        raise InputError(say("{path} is no SBET file or is cut off: its length is no multiple of {itemsize} bytes.",
                             path=path.name, itemsize=_SBET_BYTES))
    records = np.memmap(path, "<f8", "r").reshape(-1, 17)
    some = records[:: max(len(records) // 1000, 1)]
    places = np.degrees(some[:, [2, 1]])
    notes = () if path.suffix.lower() in SBET_SUFFIXES else (say(
        "{name} holds an SBET: let its name end in .out or .sbet, by which it is read.", name=path.name),)
    return [FileFacts(path, TRAJECTORY, detail="SBET", crs_wkt=epsg_wkt(WGS84), heights="ellipsoidal",
                      extent=(*map(float, places.min(axis=0)), *map(float, places.max(axis=0))),
                      times=(float(records[0, 0]), float(records[-1, 0])), count=len(records),
                      notes=notes)]
