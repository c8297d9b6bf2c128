"""Steps that the coordinates of a cloud were rounded to, found from samples of its points."""

from __future__ import annotations

from functools import lru_cache

import laspy
import numpy as np

from ...progress import notice
from ...wording import say
from .decoded_points import FileState, file_state
from .pointcloud import PointCloud, can_be_entered

COARSE_STEP = 0.02
"""m; steps from this on are told: their rounding weighs beside what a survey is off by."""

_PLACES, _PROBE = 6, 20_000
_EVERY, _MANY_FILES = 40, 8
_FEW_VALUES = 12
_OFF_STEP = 0.05  # of a step


def probes(file: FileState, places: int = _PLACES) -> tuple[laspy.ScaleAwarePointRecord, ...]:
    """Some points of a file from several places on; all checks of a run ask the same ones."""
    return _probes(file, places)


@lru_cache(maxsize=4)
def _probes(file: FileState, places: int) -> tuple[laspy.ScaleAwarePointRecord, ...]:
    found = []
    with laspy.open(file[0]) as reader:
        for share in np.linspace(0.0, 1.0, places):
            if share:
                reader.seek(int(share * max(reader.header.point_count - _PROBE, 0)))
            found.append(reader.read_points(_PROBE))
    return tuple(found)


def sampled_points(cloud: PointCloud) -> tuple[np.ndarray, np.ndarray]:
    """gps_time (n,), s, and places (n, 2), m, of some points of each file that can be entered anywhere."""
    found = [np.empty((0, 3))]
    for path, header in zip(cloud.paths, cloud.headers):
        if header.point_count and can_be_entered(header):
            try:
                found.append(_thinned(file_state(path), -(-len(cloud.paths) // _MANY_FILES)))
            except (laspy.errors.LaspyException, RuntimeError, OSError, ValueError, EOFError):
                continue  # a damaged file says so when it is read through
    samples = np.concatenate(found)
    samples = samples[np.isfinite(samples).all(axis=1)]
    return samples[:, 0], samples[:, 1:]


@lru_cache(maxsize=64)
def _thinned(file: FileState, files: int) -> np.ndarray:
    return np.concatenate([np.column_stack([np.asarray(values)[::_EVERY * files] for values in (
        part["gps_time"], part.x, part.y)]) for part in probes(file)])


def told_steps(cloud: PointCloud) -> np.ndarray:
    """Steps (3,), m, of x, y and z, the largest of the files, told to the user where any is coarse; 0 where none is."""
    steps = np.zeros(3)
    for path, header in zip(cloud.paths, cloud.headers):
        if not header.point_count:
            continue
        try:
            found = np.array(_steps(file_state(path), _PLACES if can_be_entered(header) else 1))
        except (laspy.errors.LaspyException, RuntimeError, OSError, ValueError, EOFError):
            continue  # a damaged file says so when it is read through
        if found.any():
            notice(say("The coordinates of the points are rounded ({axes}), and what is found by them is no more "
                       "accurate: export the points with finer coordinates.",
                       axes=", ".join(say("{axis} in steps of {step:g} m", axis=axis, step=float(f"{step:.3g}"))
                                      for axis, step in zip("xyz", found) if step)))
        steps = np.maximum(steps, found)
    return steps


def rounding_variance(cloud: PointCloud) -> tuple[float, ...]:
    """Variances, m2, of x, y and z that come of their steps, which are told: even within a step."""
    return tuple((told_steps(cloud) ** 2 / 12.0).tolist())


@lru_cache(maxsize=64)
def _steps(file: FileState, places: int) -> tuple[float, ...]:
    points = probes(file, places)
    steps = [coordinate_step(np.concatenate([np.asarray(part[axis]) for part in points])) * float(scale)
             for axis, scale in zip("XYZ", points[0].scales)]
    return tuple(step if step >= COARSE_STEP else 0.0 for step in steps)


def coordinate_step(values: np.ndarray) -> float:
    """Step that all values (n,) are whole multiples of, counted from the first, in their unit; 0 where there is none
    to be told."""
    values = np.unique(values).astype(float)
    if len(values) < _FEW_VALUES:
        return 0.0
    gaps = np.diff(values)
    step = float(np.quantile(gaps, 0.05))
    number = np.concatenate([[0.0], np.cumsum(np.round(gaps / step))])
    step, start = np.polyfit(number, values, 1)
    off = np.abs(start + step * number - values)
    return float(step) if off.max() <= _OFF_STEP * step else 0.0
