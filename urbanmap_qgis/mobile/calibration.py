"""Where scanners and cameras sit on the body: lever arms and boresights (the JSON calibration file)."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..io.files.columns import Entry
from ..io.files.guard import read_json, reads
from ..wording import say
from .trajectory import Trajectory, body_to_map

MOUNT_ANGLES = tuple(Entry(name, "degrees", default=0.0) for name in ("roll", "pitch", "heading"))
RANGE = Entry("max_range", "m", default=np.inf)
"""Entries of a scanner or camera beside its lever arm (m)."""

_MAX_LEVER_ARM = 20.0


@dataclass(frozen=True)
class Mount:
    """How a scanner or camera sits on the body.

    Attributes
    ----------
    id : its name.
    lever_arm : (3,) from the body's origin: forward, right, down, m.
    angles : (3,) roll, pitch, heading from the body's axes, degrees (boresight).
    """

    id: str
    lever_arm: np.ndarray
    angles: np.ndarray


@dataclass(frozen=True)
class MountedScanner(Mount):
    """A laser scanner.

    Attributes
    ----------
    point_source_id : number by which its points are marked; None where the file does not say.
    max_range : maximum range, m; infinite where the file does not say.
    """

    point_source_id: int | None = None
    max_range: float = np.inf


@dataclass(frozen=True)
class MountedCamera(Mount):
    """A camera; `properties` are all its entries of the file (focal length, rows, image centre)."""

    properties: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Calibration:
    """Scanners and cameras of a vehicle.

    Attributes
    ----------
    damaged_cameras : what is wrong with entries of cameras that cannot be used, a sentence each; only who needs a
        camera is told.
    """

    scanners: tuple[MountedScanner, ...]
    cameras: tuple[MountedCamera, ...] = ()
    damaged_cameras: tuple[str, ...] = ()


@reads("a calibration")
def read_calibration(path: str | os.PathLike) -> Calibration:
    """Read a calibration file (JSON with `scanners` and `camera` or `cameras`).

    Raises
    ------
    InputError : it is no such file, or an entry of a scanner is missing or no number. A camera that cannot be used is
        told in `damaged_cameras`.
    """
    name = Path(path).name
    content = read_json(path, "a calibration")
    if not isinstance(content, dict) or not any(key in content for key in ("scanners", "camera", "cameras")):
        raise InputError(say("{name} is no calibration: it needs an entry “scanners” or “cameras”.", name=name))
    scanners = tuple(_scanner(entry, name) for entry in _entries(content.get("scanners", []), name))
    return Calibration(scanners, *_cameras(content, name))


def _cameras(content: Mapping, name: str) -> tuple[tuple[MountedCamera, ...], tuple[str, ...]]:
    """The cameras that can be used, and what is wrong with the others."""
    entries = content.get("cameras", [content["camera"]] if "camera" in content else [])
    good, damaged = [], []
    for entry in entries if isinstance(entries, list) else [entries]:
        try:
            good += [_camera(one, name) for one in _entries([entry], name)]
        except InputError as error:
            damaged.append(str(error))
    return tuple(good), tuple(damaged)


def _entries(value: object, name: str) -> list[Mapping]:
    if not isinstance(value, list) or not all(isinstance(entry, dict) for entry in value):
        raise InputError(say("{name}: scanners and cameras must be lists of objects.", name=name))
    return value


def _scanner(entry: Mapping, name: str) -> MountedScanner:
    source = entry.get("point_source_id", entry.get("id"))
    try:
        source = int(source)
    except (TypeError, ValueError, OverflowError):
        source = None
    return MountedScanner(*_mount(entry, name), source, _number(entry, RANGE, name))


def _camera(entry: Mapping, name: str) -> MountedCamera:
    return MountedCamera(*_mount(entry, name), dict(entry))


def _mount(entry: Mapping, name: str) -> tuple[str, np.ndarray, np.ndarray]:
    """Name, lever arm and boresight of an entry."""
    identity = str(entry.get("id", ""))
    arm = entry.get("lever_arm_m")
    if not isinstance(arm, list) or len(arm) != 3 or not all(_is_number(value) for value in arm):
        raise InputError(say("{name}: “lever_arm_m” of {value} must be three numbers, metres forward, right and down.",
                             name=name, value=identity or "an entry"))
    if np.abs(arm).max() > _MAX_LEVER_ARM:
        raise InputError(say("{name}: the lever arm of {value} is {max:.0f} m long; it must be in metres.", name=name,
                             value=identity or "an entry", max=np.abs(arm).max()))
    angles = [_number(entry, angle, name) for angle in MOUNT_ANGLES]
    return identity, np.array(arm, float), np.array(angles)


def _number(entry: Mapping, known: Entry, name: str) -> float:
    value = entry.get(known.name, known.default)
    if not _is_number(value) and known.name in entry:
        raise InputError(say("{name}: “{key}” of {entry} is no number.", name=name, key=known.name,
                             entry=entry.get("id", "an entry")))
    return float(value)


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and bool(np.isfinite(float(value)))


def scanner_of(calibration: Calibration, point_source_id: int) -> MountedScanner:
    """The scanner whose points carry a number.

    A calibration of a single scanner without a number stands for all points.

    Raises
    ------
    InputError : the calibration does not know the number.
    """
    for scanner in calibration.scanners:
        if scanner.point_source_id == point_source_id:
            return scanner
    if len(calibration.scanners) == 1 and calibration.scanners[0].point_source_id is None:
        return calibration.scanners[0]
    known = ", ".join(str(scanner.point_source_id) for scanner in calibration.scanners) or "none"
    raise InputError(say("The calibration has no scanner with point source id {point_source_id} (it has: {known}): "
                         "add it, or choose the calibration of this survey.", point_source_id=point_source_id,
                         known=known))


def scanner_positions(trajectory: Trajectory, scanner: Mount, time: np.ndarray) -> np.ndarray:
    """Places (m, 3) of a scanner or camera in the map at times (m,): p(t) + R(t) lever arm.

    Raises
    ------
    InputError : a time lies outside the trajectory.
    """
    return body_to_map(trajectory, time, scanner.lever_arm)
