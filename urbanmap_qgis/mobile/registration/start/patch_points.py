"""Marking points made ready: which patch measured them, thinned to even density, in the order driven."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ...markings.records import MarkingPoints
from ...trajectory import Trajectory, interpolate
from .patches import Patches

_GROUP = 10  # patches that are thinned together: what is seen again later stays


@dataclass(frozen=True)
class PatchPoints:
    """Thinned points, sorted by patch.

    Attributes
    ----------
    place : (m, 3) m, reported.
    lever_arm : (m, 3) m, from the body's reported place at the time of measuring.
    path_parameter : (m,) of the patches, when measured.
    patch : (m,) number, not falling.
    weight : (m,).
    """

    place: np.ndarray
    lever_arm: np.ndarray
    path_parameter: np.ndarray
    patch: np.ndarray
    weight: np.ndarray

    def __len__(self) -> int:
        return len(self.path_parameter)

    def of_patches(self, first: int, last: int) -> PatchPoints:
        """Points of the patches `first` to `last`."""
        part = slice(*np.searchsorted(self.patch, [first, last + 1]))
        return PatchPoints(*(getattr(self, field.name)[part] for field in fields(self)))


def thin_points(markings: MarkingPoints, trajectory: Trajectory, patches: Patches, cell: float) -> PatchPoints:
    """Mean of the points in each cell of `cell` m, separately for each 10 patches driven (J chapter 4: 0.3 m)."""
    patch = patches.number_at(markings.time)
    key = _cells(markings, patch // _GROUP, cell)
    order = np.argsort(key, kind="stable")
    start = np.flatnonzero(np.r_[True, np.diff(key[order]) != 0]) if len(order) else np.zeros(0, dtype=np.int64)
    count = np.diff(np.append(start, len(order)))
    body = interpolate(trajectory, markings.time).place
    reported = np.stack([markings.x, markings.y, markings.z], axis=1)

    def mean(values: np.ndarray) -> np.ndarray:
        if not len(start):
            return np.zeros((0, *values.shape[1:]))
        base = values[:1]  # keeps the digits of large coordinates
        total = np.add.reduceat((values - base)[order], start, axis=0)
        return base + total / (count if values.ndim == 1 else count[:, None])

    path_parameter = mean(patches.path_parameter_at(markings.time))
    place, lever_arm, weight = mean(reported), mean(reported - body), mean(np.asarray(markings.weight, float))
    chainage = np.interp(path_parameter, patches.epoch_chainage + patches.epoch_stop_time, patches.epoch_chainage)
    patch = np.clip((chainage / patches.length).astype(np.int64), 0, len(patches) - 1)
    order = np.argsort(patch, kind="stable")
    return PatchPoints(place[order], lever_arm[order], path_parameter[order], patch[order], weight[order])


def _cells(markings: MarkingPoints, group: np.ndarray, cell: float) -> np.ndarray:
    """One number for each point's cell and group."""
    column = np.floor((markings.x - _least(markings.x)) / cell).astype(np.int64)
    row = np.floor((markings.y - _least(markings.y)) / cell).astype(np.int64)
    return (group * (row.max(initial=0) + 1) + row) * (column.max(initial=0) + 1) + column


def _least(values: np.ndarray) -> float:
    return float(values.min()) if len(values) else 0.0
