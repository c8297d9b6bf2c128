"""How accurate the inertial unit shows itself to be, for the angle that a drive cannot tell.

The points of a scanner lie in one line ahead of or behind the vehicle: the ground tells the roll, the markings tell the
heading, but the pitch mostly keeps what was reported, and with it the accuracy that was stated. One unit measures all
three: where roll or heading were off by more than stated, the pitch is taken for as much worse.
"""

from __future__ import annotations

import numpy as np

_ROLL, _PITCH, _HEADING = 3, 4, 5
_DETERMINED = 0.5  # of the stated variance: an angle that keeps less of it was measured


def shown_factor(value: np.ndarray, covariance: np.ndarray, stated: np.ndarray) -> float:
    """How many times as large as stated the errors of the measured angles are, 1 at least and where none was measured.

    Parameters
    ----------
    value : (n,) degrees, corrections of one angle.
    covariance : (n,) degrees2, their variances.
    stated : (n,) degrees, standard deviations before.
    """
    measured = covariance < _DETERMINED * stated**2
    if not measured.any():
        return 1.0
    share = (value[measured] ** 2 + covariance[measured]) / stated[measured] ** 2
    return max(1.0, float(np.sqrt(share.mean())))


def with_shown_pitch(value: np.ndarray, covariance: np.ndarray, stated: np.ndarray,
                     heading_factor: float) -> np.ndarray:
    """Covariances (n, 6, 6), m and degrees, whose pitch is as accurate as roll and heading show the unit to be.

    Parameters
    ----------
    value : (n, 6) corrections.
    stated : (n, 3) degrees, of roll, pitch and heading before.
    heading_factor : by which the heading was let loose: where over 1 it is a misaligned unit's, and shows nothing.
    """
    variance = np.einsum("nii->ni", covariance)
    factors = [shown_factor(value[:, _ROLL], variance[:, _ROLL], stated[:, 0])]
    if heading_factor == 1.0:
        factors.append(shown_factor(value[:, _HEADING], variance[:, _HEADING], stated[:, 2]))
    determined = variance[:, _PITCH] >= _DETERMINED * stated[:, 1] ** 2
    size = np.ones(covariance.shape[:2])
    size[determined, _PITCH] = max(factors)
    return covariance * size[:, :, None] * size[:, None, :]
