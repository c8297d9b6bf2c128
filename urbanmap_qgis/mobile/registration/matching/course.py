"""The smooth course of the correction along the path, that all windows are adjusted about.

A course is a shift and a turn for each patch. It is the most likely one under the points' scores and an error that
wanders slowly with the way driven (a random walk): a banded system, solved at once for the whole stretch.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, solveh_banded

from ..start.patch_points import PatchPoints
from .block_chain import solve_chain
from .ndt_match import turn_matrix
from .patch_sums import PatchSums

DRIFT = np.array([0.02, 0.02, 0.02, 3e-4, 3e-4, 3e-4])
"""Wander of an error in the root of a metre driven: m, and radians."""

STANDING_DRIFT = np.array([0.15, 0.15, 0.15, 5e-4, 5e-4, 5e-4])
"""Wander of an error in the root of a second that the vehicle stands: m, and radians."""

_LIKELY = np.array([3.0, 3.0, 5.0, 0.01, 0.01, 0.01])  # standard deviation of the whole error, m and radians


@dataclass(frozen=True)
class Course:
    """Correction of n patches that follow each other.

    Attributes
    ----------
    way, standing : (n,) m driven and s waited up to the patches' middles. shift : (n, 3) m.
    turn : (n, 3) rotation vectors in the map's axes, radians.
    """

    way: np.ndarray
    standing: np.ndarray
    shift: np.ndarray
    turn: np.ndarray

    def moved(self, points: PatchPoints) -> np.ndarray:
        """(m, 3) the points as this course corrects them."""
        clock = self.way + self.standing
        before = np.clip(np.searchsorted(clock, points.clock) - 1, 0, max(len(clock) - 2, 0))
        after = np.minimum(before + 1, len(clock) - 1)
        span = np.maximum(clock[after] - clock[before], 1e-9)
        share = np.clip((points.clock - clock[before]) / span, 0, 1)[:, None]
        shift = self.shift[before] + share * (self.shift[after] - self.shift[before])
        turn = self.turn[before] + share * (self.turn[after] - self.turn[before])
        side = np.cross(turn, points.arm)
        return points.place + shift + side + 0.5 * np.cross(turn, side)

    def plus(self, step: np.ndarray) -> Course:
        """After small movements (n, 6) about the corrected places."""
        small = np.abs(self.turn).max(initial=0.0) + np.abs(step[:, 3:]).max(initial=0.0) < 0.02
        turn = self.turn + step[:, 3:] if small else _composed(step[:, 3:], self.turn)
        return Course(self.way, self.standing, self.shift + step[:, :3], turn)


def _composed(second: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Rotation vectors of turns (n, 3) one after another."""
    matrix = turn_matrix(second) @ turn_matrix(first)
    cosine = np.clip((np.trace(matrix, axis1=1, axis2=2) - 1) / 2, -1, 1)
    axis = np.stack([matrix[:, 2, 1] - matrix[:, 1, 2], matrix[:, 0, 2] - matrix[:, 2, 0],
                     matrix[:, 1, 0] - matrix[:, 0, 1]], axis=1) / 2
    return axis / np.sinc(np.arccos(cosine) / np.pi)[:, None]


def course_step(course: Course, sums: PatchSums, active: tuple[int, ...]) -> np.ndarray:
    """(n, 6) movements of the patches about their corrected places, towards the most likely course.

    Parameters
    ----------
    sums : of the patches, each about its own corrected place. active : the parameters that move.
    """
    count, parameters = len(course.way), list(active)
    width = len(parameters)
    state = np.concatenate([course.shift, course.turn], axis=1)[:, parameters]
    stiff = _stiffness(course, parameters)
    hold = 1.0 / (_LIKELY[parameters] ** 2 * max(count, 1))
    gradient = sums.gradient[:, parameters] - hold * state
    pull = stiff * np.diff(state, axis=0)
    gradient[:-1] += pull
    gradient[1:] -= pull
    diagonal = np.zeros((count, width)) + hold
    diagonal[:-1] += stiff
    diagonal[1:] += stiff
    blocks = sums.information[:, parameters][:, :, parameters]
    step = np.zeros((count, 6))
    try:
        step[:, parameters] = _solve_chain(blocks, diagonal, stiff, gradient)
    except LinAlgError:  # not yet near a maximum: curvatures turned about lead uphill all the same
        step[:, parameters] = _solve_chain(turned_about(blocks), diagonal, stiff, gradient)
    return step


def _solve_chain(blocks: np.ndarray, diagonal: np.ndarray, stiff: np.ndarray, right: np.ndarray) -> np.ndarray:
    """(n, p) solution of the system of blocks (n, p, p) with a diagonal (n, p), coupled to the next by -stiff (n-1, p).

    Raises
    ------
    LinAlgError : the system is not positive definite.
    """
    count, width = right.shape
    banded = np.zeros((width + 1, count * width))
    for a in range(width):
        for b in range(a, width):
            banded[width - (b - a), np.arange(count) * width + b] = blocks[:, a, b]
        banded[width, np.arange(count) * width + a] += diagonal[:, a]
        banded[0, np.arange(1, count) * width + a] = -stiff[:, a]
    return solveh_banded(banded, right.ravel(), check_finite=False).reshape(count, width)


def _stiffness(course: Course, parameters: list[int]) -> np.ndarray:
    """(n - 1, p) inverse variances of the wander from each patch to the next."""
    driven, waited = np.maximum(np.diff(course.way), 1e-3)[:, None], np.diff(course.standing)[:, None]
    return 1.0 / (DRIFT[parameters] ** 2 * driven + STANDING_DRIFT[parameters] ** 2 * waited)


def course_covariance(course: Course, information: np.ndarray, active: tuple[int, ...]) -> np.ndarray:
    """(n, 6, 6) covariance of the course at each patch, 0 in what is not active: what evidence and wander leave open.

    `information` (n, 6, 6) of the patches, each about its own corrected place, not curved upwards anywhere.
    """
    count, parameters = len(course.way), list(active)
    blocks = information[:, parameters][:, :, parameters]
    stiff = _stiffness(course, parameters)
    diagonal = blocks + np.diag(1.0 / (_LIKELY[parameters] ** 2 * count))
    each = np.arange(len(parameters))
    diagonal[:-1, each, each] += stiff
    diagonal[1:, each, each] += stiff
    ahead = np.zeros((count - 1, len(parameters), len(parameters)))
    ahead[:, each, each] = -stiff
    full = np.zeros((count, 6, 6))
    full[np.ix_(np.arange(count), parameters, parameters)] = solve_chain(
        diagonal, ahead, np.zeros((count, len(parameters)))).covariance
    return full


def turned_about(information: np.ndarray) -> np.ndarray:
    """Curvatures (n, p, p) with the sign of negative directions turned about."""
    values, vectors = np.linalg.eigh(information)
    return np.einsum("nij,nj,nkj->nik", vectors, np.abs(values), vectors)
