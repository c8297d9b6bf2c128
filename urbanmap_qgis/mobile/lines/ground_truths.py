"""How far position and heading of a trajectory are off where tie points were measured (Z 3.2, eq. 11 to 17).

At time i the vehicle is reported at o_i, the survey shows a place at p_i, the reference at p_i'. With the error
(dx, dy, dkappa) the same for all pairs of a set,

    p_i' - o_i = (dx, dy) + R(dkappa) (p_i - o_i),    R(k) = [[cos k, -sin k], [sin k, cos k]], anticlockwise,

which is eq. 12 as it must be read (R takes the angle kappa_i + dkappa; the brackets of the print are lost). The
difference of two pairs is eq. 14. Eq. 15 gives the rotation by an arc cosine, which loses its sign: it is taken from
sine and cosine here. The vectors of eq. 14 need not have one length: their difference tells how well a set fits.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import LEAST_SQUARE


@dataclass(frozen=True)
class Drift:
    """Error of a pose: what must be added.

    Attributes
    ----------
    shift : (2,) east and north, m.
    rotation : radians, anticlockwise (the heading changes by the opposite).
    covariance : (3, 3) of shift and rotation, m and radians.
    """

    shift: np.ndarray
    rotation: float
    covariance: np.ndarray


def two_pair_drift(place: np.ndarray, measured: np.ndarray, reference: np.ndarray) -> tuple[np.ndarray, float]:
    """Shift (2,) and rotation (radians) of a set of two pairs as in Z eq. 13 to 17: exact at the first pair.

    Parameters
    ----------
    place : (2, 2) reported vehicle positions.
    measured, reference : (2, 2) the pairs' places.
    """
    seen, true = measured - place, reference - place
    before, after = seen[1] - seen[0], true[1] - true[0]
    rotation = float(np.arctan2(before[0] * after[1] - before[1] * after[0], before @ after))
    return true[0] - rotated_vectors(seen[0], rotation), rotation


def rotated_vectors(vectors: np.ndarray, angle: np.ndarray | float) -> np.ndarray:
    """Vectors (..., 2) rotated anticlockwise by an angle in radians."""
    cos, sin = np.cos(angle), np.sin(angle)
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)


def set_drift(place: np.ndarray, measured: np.ndarray, reference: np.ndarray, sigma: float,
              heading_sigma: float = np.inf) -> Drift:
    """Least squares over all pairs (n, 2) of a set: eq. 14 for more than two.

    Parameters
    ----------
    sigma : of a pair's coordinate, m.
    heading_sigma : expected error of the heading, radians; it keeps the rotation of pairs near each other within
        reason, and is all that is known of it where there is one pair.
    """
    seen, true = measured - place, reference - place
    centre, target = seen.mean(axis=0), true.mean(axis=0)
    a, b = seen - centre, true - target
    # A rotation of nought with the expected error is one more observation of weight (sigma / heading_sigma)^2.
    weight = (sigma / heading_sigma) ** 2
    spread = float((a * a).sum())
    rotation = float(np.arctan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum() + weight))
    shift = target - rotated_vectors(centre, rotation)
    return Drift(shift, rotation, _covariance(centre, rotation, len(seen), spread + weight, sigma))


def _covariance(centre: np.ndarray, rotation: float, count: int, spread: float, sigma: float) -> np.ndarray:
    """Covariance of shift and rotation: the centre is known by the mean, the rotation by the spread."""
    lever = rotated_vectors(centre, rotation + np.pi / 2)
    of_rotation = sigma**2 / max(spread, LEAST_SQUARE)
    covariance = np.zeros((3, 3))
    covariance[:2, :2] = sigma**2 / count * np.eye(2) + of_rotation * np.outer(lever, lever)
    covariance[:2, 2] = covariance[2, :2] = -of_rotation * lever
    covariance[2, 2] = of_rotation
    return covariance


def misfit(place: np.ndarray, measured: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """How far each pair (n,) of a set lies from where the others put it, m; two pairs share the misfit of lengths."""
    count = len(place)
    seen, true = measured - place, reference - place
    if count < 2:
        return np.zeros(count)
    if count == 2:
        return np.full(2, abs(np.hypot(*(seen[1] - seen[0])) - np.hypot(*(true[1] - true[0]))))
    misfits = np.empty(count)
    for pair in range(count):
        others = np.arange(count) != pair
        drift = set_drift(place[others], measured[others], reference[others], 1.0)
        misfits[pair] = np.hypot(*(true[pair] - drift.shift - rotated_vectors(seen[pair], drift.rotation)))
    return misfits
