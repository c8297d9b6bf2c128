"""Each patch moved by the matrix of its own window, as in the paper (J eq. 8 and 9; chapter 4, eq. 4).

No model of the drift, no weights and no bridging: between patches there are steps. The statuses say which windows are
not to be trusted; these patches are moved all the same, as the paper does. How accurate a patch is, the paper does not
say: a rigid window over a drifting trajectory is wrong by more than the fit of its points tells, so that what windows
differ by from those around them is counted, too.
"""

from __future__ import annotations

import numpy as np

from ....errors import InsufficientDataError
from ....wording import mark, say
from ...trajectory import Trajectory, attitude_angles, rotations
from ..records import AMBIGUOUS, NO_MARKINGS, NOT_CONVERGED, WEAK, WindowResults
from ..start.patches import divide_path
from .patch_corrections import Correction
from .patch_status import DISTRUSTED, REGISTERED, plan_sigma
from .settings import CorrectionSettings

_REASONS = {WEAK: mark("the markings of the window do not fix the position well"),
            AMBIGUOUS: mark("another position of the markings fits as well or better"),
            NO_MARKINGS: mark("no markings in the window: moved as the patch before"),
            NOT_CONVERGED: mark("the matching of the window did not converge")}


def patchwise_correction(windows: WindowResults, settings: CorrectionSettings) -> Correction:
    """The windows' own corrections with statuses: registered, or not to be trusted and why.

    The covariance is that of the window's own fit and the scatter of the windows around; NaN where a patch's window was
    not determined, and all along a drive that is too short to tell the scatter.

    Raises
    ------
    InsufficientDataError : no window has a correction.
    """
    if not windows.usable.any():
        raise InsufficientDataError(
            say("No window of the survey could be registered to the reference markings: check that both show the "
                "same streets in the same coordinate system, and that the survey has intensities that show paint."))
    n = len(windows)
    covariance = windows.covariance + _scatter(windows)
    status = np.full(n, REGISTERED, np.int8)
    reason = np.full(n, "", dtype=object)
    for code, words in _REASONS.items():
        status[windows.status == code], reason[windows.status == code] = DISTRUSTED, say(words)
    sigma = plan_sigma(covariance)
    for wide, words in ((plan_sigma(windows.covariance) > settings.trusted_sigma, say(_REASONS[WEAK])),
                        (sigma > settings.trusted_sigma, say("the windows around it contradict each other")),
                        (np.isnan(sigma), say("the drive is too short to tell how accurate it is"))):
        wide &= status == REGISTERED
        status[wide], reason[wide] = DISTRUSTED, words
    return Correction(windows.time, windows.chainage, np.nan_to_num(windows.correction), covariance, status, reason,
                      np.where(windows.usable, 1.0, np.nan), np.full((n, 6), np.nan), windows.three_d, np.nan, np.nan,
                      1.0, np.zeros(0), np.zeros((0, 0, 2)), (), 0.0)


def _scatter(windows: WindowResults) -> np.ndarray:
    """(n, 6, 6) covariance that neighbouring windows show, mean over the length of a window; NaN on a short drive.

    Compared are windows half a window apart, which share half of their markings: of three in a row, the middle one less
    the mean of the others has half the variance of one window.
    """
    rows, half = np.arange(len(windows)), (windows.window_last - windows.window_first + 1) // 2
    middle = np.flatnonzero((rows >= half) & (rows + half < len(rows)))
    if not len(middle):
        return np.full((len(rows), 6, 6), np.nan)
    value, away = windows.correction, half[middle]
    bend = value[middle] - 0.5 * (value[middle - away] + value[middle + away])
    running = np.concatenate([np.zeros((1, 6, 6)), np.cumsum(2.0 * bend[:, :, None] * bend[:, None, :], axis=0)])
    first = np.minimum(np.searchsorted(middle, rows - half), len(middle) - 1)
    end = np.maximum(np.searchsorted(middle, rows + half, side="right"), first + 1)
    return (running[end] - running[first]) / (end - first)[:, None, None]


def correct_patchwise(trajectory: Trajectory, windows: WindowResults, patch_length: float) -> Trajectory:
    """The trajectory with each patch moved rigidly: p' = R (p - c) + c + T, c the patch's middle (J eq. 9)."""
    patch = divide_path(trajectory, patch_length).number_at(trajectory.time)
    change = np.nan_to_num(windows.correction)
    centre, before = windows.place[patch], rotations(windows.angles)
    rotation = (rotations(windows.angles + change[:, 3:]) @ np.swapaxes(before, 1, 2))[patch]
    place = np.einsum("nij,nj->ni", rotation, trajectory.place - centre) + centre + change[patch, :3]
    if not windows.three_d:
        place[:, 2] = trajectory.place[:, 2]
        return Trajectory(trajectory.time, place, trajectory.angles + change[patch, 3:])
    added = attitude_angles(rotation @ rotations(trajectory.angles)) - trajectory.angles
    return Trajectory(trajectory.time, place, trajectory.angles + (added + 180.0) % 360.0 - 180.0)
