"""Errors of the reference's heights that neighbouring heights share: how large they are, what they leave unknown.

Heights of an airborne ground wander by centimetres to decimetres over tens of metres. To a short piece of the drive
such an error looks like one of its own height, roll and pitch, so that it must not count as knowledge of them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....geometry.tolerances import SIGMA_OF_MAD

LENGTH = 25.0
"""m in which an error of the heights forgets itself (Gaussian: correlation exp(-d2 / 2 L2))."""


@dataclass(frozen=True)
class GroundErrorsLimits:
    """Limits of ground errors, each with its unit."""

    cell: float = 2.0  # m, in which differences to the ground are averaged
    group: int = 6  # pieces in which the survey's own error counts as one rigid body
    # m apart: the difference of two cells by noise, and by errors that bend
    near: tuple[float, ...] = (1.0, 4.0)
    far: tuple[float, ...] = (7.0, 13.0)
    fewest: int = 30  # pairs from which the size of the errors can be told
    tilt: float = 2.0  # times the slope of such an error: across a road it bends too
    # m
    least: float = 0.01
    most: float = 0.5
    unknown: float = 0.05  # m, where it cannot be told


LIMITS = GroundErrorsLimits()


@dataclass(frozen=True)
class HeightDifferences:
    """Ground less survey at marking points: piece (m,), offset from the body forward and right (m, 2) m, off (m,) m."""

    piece: np.ndarray
    offset: np.ndarray
    off: np.ndarray


def ground_sigma(differences: HeightDifferences) -> float:
    """Standard deviation of the errors that neighbouring heights share, m, by how the ground bends against the survey.

    From pairs of cells seen within a few metres of path, 10 m apart against 2.5 m apart; a constant roll and pitch is
    taken out first.
    """
    offset, off, first, second = _pairs(differences)
    if not len(first):
        return LIMITS.unknown
    distance = np.hypot(*(offset[first] - offset[second]).T)
    turn, step = offset[first] - offset[second], off[first] - off[second]
    near, far = ((distance > low) & (distance < high) for low, high in (LIMITS.near, LIMITS.far))
    if near.sum() < LIMITS.fewest or far.sum() < LIMITS.fewest:
        return LIMITS.unknown
    step = step - turn @ np.linalg.lstsq(turn[far], step[far], rcond=None)[0]
    squares = [(SIGMA_OF_MAD * np.median(np.abs(step[mask]))) ** 2 for mask in (near, far)]
    shared = [np.exp(-0.5 * (np.mean(distance[mask]) / LENGTH) ** 2) for mask in (near, far)]
    return float(np.clip(np.sqrt(max(squares[1] - squares[0], 0.0) / (2 * (shared[0] - shared[1]))), LIMITS.least,
                         LIMITS.most))


def _pairs(differences: HeightDifferences) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Offsets (c, 2) and means (c,) of the cells, and the numbers of those that pair, within their group of pieces."""
    group = differences.piece // LIMITS.group
    cell = np.floor(differences.offset / LIMITS.cell).astype(np.int64)
    cell -= cell.min(axis=0, initial=0)
    size = cell.max(axis=0, initial=0) + 1
    code, number = np.unique((group * size[0] + cell[:, 0]) * size[1] + cell[:, 1], return_inverse=True)
    count = np.bincount(number)
    offset = np.column_stack([np.bincount(number, axis) / count for axis in differences.offset.T])
    off = np.bincount(number, differences.off) / count
    ends = np.flatnonzero(np.r_[True, np.diff(code // size.prod()) != 0, True])
    firsts, seconds = [np.zeros(0, int)], [np.zeros(0, int)]
    for start, end in zip(ends[:-1], ends[1:]):
        first, second = np.triu_indices(end - start, 1)
        firsts.append(first + start)
        seconds.append(second + start)
    return offset, off, np.concatenate(firsts), np.concatenate(seconds)


def without_shared_errors(gradient: np.ndarray, information: np.ndarray, sigma: float,
                          length: float) -> tuple[np.ndarray, np.ndarray]:
    """Normal equations of heights, by pieces, less what errors of the reference leave unknown.

    A piece's ground may be raised by `sigma` and tilted by `sigma` over `LENGTH`. The pieces within that length share
    these errors: for each of them they count as so many times larger in variance as there are pieces.

    Parameters
    ----------
    gradient (n, 6), information (n, 6, 6) : about the body; shift in m, rotation vector in the map's axes in radians.
    length : m of path of a piece.
    """
    shared = max(np.sqrt(2 * np.pi) * LENGTH / length, 1.0)
    tilt = LIMITS.tilt * sigma / LENGTH
    spread = shared * np.diag([0.0, 0.0, sigma**2, tilt**2, tilt**2, 0.0])
    keep = np.linalg.inv(np.eye(6) + information @ spread)
    return np.einsum("nij,nj->ni", keep, gradient), keep @ information
