"""The smooth curve of the correction along the path, that all windows are adjusted about.

A curve is a translation and a rotation for each patch. It is the most likely one under the points' scores and an error
that changes slowly with chainage (a random walk): a banded system, solved at once for the whole section.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, solveh_banded

from ....estimation.block_chain import solve_chain
from ....geometry.tolerances import LEAST_DIVISOR
from ..start.patch_points import PatchPoints
from .ndt_match import rotation_matrix
from .patch_sums import PatchSums

DRIFT = np.array([0.02, 0.02, 0.02, 3e-4, 3e-4, 3e-4])
"""Random walk of an error in the root of a metre driven: m, and radians."""

STANDING_DRIFT = np.array([0.15, 0.15, 0.15, 5e-4, 5e-4, 5e-4])
"""Random walk of an error in the root of a second that the vehicle stands: m, and radians."""

_PRIOR_SIGMA = np.array([3.0, 3.0, 5.0, 0.01, 0.01, 0.01])  # standard deviation of the whole error, m and radians


@dataclass(frozen=True)
class CorrectionCurve:
    """Correction of n patches that follow each other.

    Attributes
    ----------
    chainage, stop_time : (n,) m driven and s waited up to the patches' middles.
    translation : (n, 3) m.
    rotation : (n, 3) rotation vectors in the map's axes, radians.
    fast_drift : (n,) or one for all, m a metre: what the error in plan may change by beside the usual wander.
    """

    chainage: np.ndarray
    stop_time: np.ndarray
    translation: np.ndarray
    rotation: np.ndarray
    fast_drift: np.ndarray | float = 0.0

    def transform(self, points: PatchPoints) -> np.ndarray:
        """(m, 3) the points as this curve corrects them."""
        path_parameter = self.chainage + self.stop_time
        before = np.clip(np.searchsorted(path_parameter, points.path_parameter) - 1, 0, max(len(path_parameter) - 2, 0))
        after = np.minimum(before + 1, len(path_parameter) - 1)
        span = np.maximum(path_parameter[after] - path_parameter[before], LEAST_DIVISOR)
        share = np.clip((points.path_parameter - path_parameter[before]) / span, 0, 1)[:, None]
        translation = self.translation[before] + share * (self.translation[after] - self.translation[before])
        rotation = self.rotation[before] + share * (self.rotation[after] - self.rotation[before])
        side = np.cross(rotation, points.lever_arm)
        return points.place + translation + side + 0.5 * np.cross(rotation, side)

    def plus(self, step: np.ndarray) -> CorrectionCurve:
        """After small movements (n, 6) about the corrected places."""
        small = np.abs(self.rotation).max(initial=0.0) + np.abs(step[:, 3:]).max(initial=0.0) < 0.02
        rotation = self.rotation + step[:, 3:] if small else _composed(step[:, 3:], self.rotation)
        return CorrectionCurve(self.chainage, self.stop_time, self.translation + step[:, :3], rotation,
                               self.fast_drift)


def _composed(second: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Rotation vectors of rotations (n, 3) one after another."""
    matrix = rotation_matrix(second) @ rotation_matrix(first)
    cosine = np.clip((np.trace(matrix, axis1=1, axis2=2) - 1) / 2, -1, 1)
    axis = np.stack([matrix[:, 2, 1] - matrix[:, 1, 2], matrix[:, 0, 2] - matrix[:, 2, 0],
                     matrix[:, 1, 0] - matrix[:, 0, 1]], axis=1) / 2
    return axis / np.sinc(np.arccos(cosine) / np.pi)[:, None]


def curve_step(curve: CorrectionCurve, sums: PatchSums, active: tuple[int, ...]) -> np.ndarray:
    """(n, 6) movements of the patches about their corrected places, towards the most likely curve.

    Parameters
    ----------
    sums : of the patches, each about its own corrected place.
    active : the parameters that move.
    """
    count, parameters = len(curve.chainage), list(active)
    width = len(parameters)
    state = np.concatenate([curve.translation, curve.rotation], axis=1)[:, parameters]
    stiff = _stiffness(curve, parameters)
    hold = 1.0 / (_PRIOR_SIGMA[parameters] ** 2 * max(count, 1))
    gradient = sums.gradient[:, parameters] - hold * state
    tie = stiff * np.diff(state, axis=0)
    gradient[:-1] += tie
    gradient[1:] -= tie
    diagonal = np.zeros((count, width)) + hold
    diagonal[:-1] += stiff
    diagonal[1:] += stiff
    blocks = sums.information[:, parameters][:, :, parameters]
    step = np.zeros((count, 6))
    try:
        step[:, parameters] = _solve_chain(blocks, diagonal, stiff, gradient)
    except LinAlgError:  # not yet near a maximum: absolute curvatures lead uphill all the same
        step[:, parameters] = _solve_chain(absolute_curvatures(blocks), diagonal, stiff, gradient)
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


def _stiffness(curve: CorrectionCurve, parameters: list[int]) -> np.ndarray:
    """(n - 1, p) inverse variances of the random walk from each patch to the next."""
    driven, stopped = np.maximum(np.diff(curve.chainage), 1e-3)[:, None], np.diff(curve.stop_time)[:, None]
    fast = np.broadcast_to(curve.fast_drift, len(curve.chainage))
    fast = np.maximum(fast[1:], fast[:-1])[:, None] * (np.array(parameters) < 2)
    return 1.0 / (DRIFT[parameters] ** 2 * driven + (fast * driven) ** 2 + STANDING_DRIFT[parameters] ** 2 * stopped)


def curve_covariance(curve: CorrectionCurve, information: np.ndarray, active: tuple[int, ...]) -> np.ndarray:
    """(n, 6, 6) covariance of the curve at each patch, 0 in what is not active, from observations and random walk.

    `information` (n, 6, 6) of the patches, each about its own corrected place, not curved upwards anywhere.
    """
    count, parameters = len(curve.chainage), list(active)
    blocks = information[:, parameters][:, :, parameters]
    stiff = _stiffness(curve, parameters)
    diagonal = blocks + np.diag(1.0 / (_PRIOR_SIGMA[parameters] ** 2 * count))
    each = np.arange(len(parameters))
    diagonal[:-1, each, each] += stiff
    diagonal[1:, each, each] += stiff
    ahead = np.zeros((count - 1, len(parameters), len(parameters)))
    ahead[:, each, each] = -stiff
    full = np.zeros((count, 6, 6))
    full[np.ix_(np.arange(count), parameters, parameters)] = solve_chain(
        diagonal, ahead, np.zeros((count, len(parameters)))).covariance
    return full


def absolute_curvatures(information: np.ndarray) -> np.ndarray:
    """Curvatures (n, p, p) with negative ones made positive."""
    values, vectors = np.linalg.eigh(information)
    return np.einsum("nij,nj,nkj->nik", vectors, np.abs(values), vectors)
