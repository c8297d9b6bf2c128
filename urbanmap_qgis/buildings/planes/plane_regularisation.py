"""Planes made level, parallel and mirrored where the points agree within their noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR
from .plane_moments import mean_square, solve


@dataclass(frozen=True)
class PlaneRegularisationLimits:
    """Limits of plane regularisation, each with its unit."""

    level_error: float = 0.04  # A plane is level where that adds no more than this root mean square error, m.
    level_slope: float = 0.02  # So is one of less slope.
    # Planes are turned to the building's directions, and made mirror images, where that adds no more error, m.
    turn_error: float = 0.015
    # Planes of nearly one slope (rise over run) are one where that adds no more error to any of them, m.
    same_slope: float = 0.03
    same_error: float = 0.03
    # Parallel planes nearer in height than this (m) are one: no step of some centimetres is left between them.
    one_height: float = 0.06
    mirror_slope: float = 0.08  # Largest difference of two slopes that are made one.


LIMITS = PlaneRegularisationLimits()

MOST_TURN = np.radians(6.0)


def regular_planes(table: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """Planes (k, 3) of the moments (k, 10) of their points, regular where the points agree.

    Parameters
    ----------
    directions : (d, 2) unit vectors of the outline's main directions and across; a plane may fall along them.
    """
    table = _pooled(table)
    planes, squares = solve(table)
    n = np.maximum(table[:, 0], 1.0)
    fit_error = squares / n
    planes = planes.copy()
    level = _level(table)
    slope = np.hypot(planes[:, 0], planes[:, 1])
    flat = (level - fit_error < LIMITS.level_error**2) | (slope < LIMITS.level_slope)
    for row in range(len(planes)):
        if flat[row]:
            planes[row] = 0.0, 0.0, table[row, 3] / n[row]
    sloped = np.flatnonzero(~flat)
    axis = {row: _turned(table[row], planes[row], float(fit_error[row]), directions) for row in sloped.tolist()}
    for row, fixed in axis.items():
        if fixed is not None:
            planes[row] = _along(table[row], fixed)
    _mirror(table, planes, fit_error, axis)
    _one_height(planes, n)
    return planes


def _pooled(table: np.ndarray) -> np.ndarray:
    """Moments (k, 10), those of planes that one plane fits as well added: of a slope, say, that a dormer parts."""
    planes, squares = solve(table)
    fit_error = squares / np.maximum(table[:, 0], 1.0)
    group = np.arange(len(table))
    sums = table.copy()
    for one, two in _like_pairs(table, planes):
        if group[one] == group[two]:
            continue
        members = np.flatnonzero((group == group[one]) | (group == group[two]))
        together = sums[one] + sums[two]
        plane = solve(together[None])[0][0]
        if all(mean_square(table[row], plane) - fit_error[row] < LIMITS.same_error**2 for row in members.tolist()):
            group[members] = group[one]
            sums[members] = together
    return sums


def _like_pairs(table: np.ndarray, planes: np.ndarray) -> list[tuple[int, int]]:
    """Pairs of planes that may be one, those with most points first."""
    one, two = np.nonzero(np.triu(like_planes(table, planes), 1))
    order = np.argsort(-np.minimum(table[one, 0], table[two, 0]), kind="stable")
    return list(zip(one[order].tolist(), two[order].tolist()))


def like_planes(table: np.ndarray, planes: np.ndarray) -> np.ndarray:
    """Mask (k, k) of planes of nearly one slope, each near the other's middle in height; `table` (k, 10): moments."""
    middle = table[:, 1:4] / np.maximum(table[:, 0], 1.0)[:, None]
    off = np.abs(middle[:, :2] @ planes[:, :2].T + planes[:, 2] - middle[:, 2:])
    alike = np.maximum(off, off.T) < LIMITS.one_height
    for axis in range(2):
        alike &= np.abs(planes[:, axis, None] - planes[:, axis]) < LIMITS.same_slope
    return alike


def _one_height(planes: np.ndarray, weight: np.ndarray) -> None:
    """One height for parallel planes that would lie within `LIMITS.one_height` of each other, changed in place."""
    _, slope = np.unique(np.round(planes[:, :2] / LEAST_DIVISOR), axis=0, return_inverse=True)
    by_slope = np.argsort(slope.ravel(), kind="stable")
    for rows in np.split(by_slope, np.flatnonzero(np.diff(slope.ravel()[by_slope])) + 1):
        order = rows[np.argsort(planes[rows, 2], kind="stable")]
        for group in _near_heights(planes[order, 2], weight[order]):
            planes[order[group], 2] = np.average(planes[order[group], 2], weights=weight[order[group]])


def _near_heights(height: np.ndarray, weight: np.ndarray) -> list[list[int]]:
    """Rows of rising heights (n,) in groups, the nearest joined first, until their weighted means lie apart."""
    groups = [[row] for row in range(len(height))]
    means, weights = height.tolist(), weight.tolist()
    while len(groups) > 1:
        steps = np.diff(means)
        low = int(np.argmin(steps))
        if steps[low] >= LIMITS.one_height:
            break
        total = weights[low] + weights[low + 1]
        means[low:low + 2] = [(means[low] * weights[low] + means[low + 1] * weights[low + 1]) / total]
        weights[low:low + 2] = [total]
        groups[low:low + 2] = [groups[low] + groups[low + 1]]
    return groups


def _level(table: np.ndarray) -> np.ndarray:
    """Mean square height error (k,) of level planes."""
    n = np.maximum(table[:, 0], 1.0)
    return np.maximum(table[:, 9] / n - (table[:, 3] / n) ** 2, 0.0)


def _turned(m: np.ndarray, plane: np.ndarray, fit_error: float, directions: np.ndarray) -> np.ndarray | None:
    """The building's direction that a plane may fall along; None where none is near or its points disagree."""
    slope = float(np.hypot(plane[0], plane[1]))
    if not len(directions) or slope == 0:
        return None
    cosine = directions @ plane[:2] / slope
    best = int(np.argmax(np.abs(cosine)))
    if abs(cosine[best]) < np.cos(MOST_TURN):
        return None
    direction = directions[best] * np.sign(cosine[best])
    turned = _along(m, direction)
    return direction if mean_square(m, turned) - fit_error < LIMITS.turn_error**2 else None


def _along(m: np.ndarray, direction: np.ndarray, slope: float | None = None) -> np.ndarray:
    """Best plane (3,) that rises along a direction, at a given slope or its own best."""
    n, mean = m[0], m[1:4] / m[0]
    if slope is None:
        xx, xy, yy = m[4] / n - mean[0]**2, m[5] / n - mean[0] * mean[1], m[6] / n - mean[1]**2
        xz, yz = m[7] / n - mean[0] * mean[2], m[8] / n - mean[1] * mean[2]
        u, v = direction
        slope = (u * xz + v * yz) / max(u * u * xx + 2 * u * v * xy + v * v * yy, LEAST_DIVISOR)
    gradient = np.asarray(direction) * slope
    return np.array([*gradient, mean[2] - gradient @ mean[:2]])


def _mirror(table: np.ndarray, planes: np.ndarray, fit_error: np.ndarray, axis: dict[int, np.ndarray | None]) -> None:
    """One slope for planes that fall along one axis, in the same or the opposite sense, changed in place."""
    left = sorted((row for row, fixed in axis.items() if fixed is not None), key=lambda row: -table[row, 0])
    while left:
        first = left.pop(0)
        slope = float(np.hypot(*planes[first, :2]))
        group = [first] + [row for row in left if abs(abs(axis[row] @ axis[first]) - 1) < 1e-9
                           and abs(np.hypot(*planes[row, :2]) - slope) < LIMITS.mirror_slope]
        if len(group) < 2:
            continue
        weight = table[group, 0]
        common = float(np.hypot(planes[group, 0], planes[group, 1]) @ weight / weight.sum())
        for row in group:
            mirrored = _along(table[row], axis[row], common)
            if mean_square(table[row], mirrored) - fit_error[row] < LIMITS.turn_error**2:
                planes[row] = mirrored
        left = [row for row in left if row not in group]
