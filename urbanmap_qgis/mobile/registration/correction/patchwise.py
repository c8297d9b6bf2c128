"""Each patch moved by the matrix of its own window, as in the paper (J eq. 8 and 9; chapter 4, eq. 4).

No model of the drift, no weights and no bridging: between patches there are steps. The statuses say which windows are
not to be trusted; these patches are moved all the same, as the paper does.
"""

from __future__ import annotations

import numpy as np

from ....errors import InsufficientDataError
from ....wording import say
from ...trajectory import Trajectory, attitude_angles, rotations
from ..records import AMBIGUOUS, NO_MARKINGS, NOT_CONVERGED, WEAK, WindowResults
from ..start.patches import divide_path
from .patch_corrections import Correction
from .patch_status import DISTRUSTED, REGISTERED, plan_sigma
from .settings import CorrectionSettings

_REASONS = {WEAK: "the markings of the window do not fix the position well",
            AMBIGUOUS: "another position of the markings fits as well or better",
            NO_MARKINGS: "no markings in the window: moved as the patch before",
            NOT_CONVERGED: "the matching of the window did not converge"}


def patchwise_correction(windows: WindowResults, settings: CorrectionSettings) -> Correction:
    """The windows' own corrections with statuses: registered, or not to be trusted and why.

    The covariance of a patch whose window was not determined is NaN.

    Raises
    ------
    InsufficientDataError : no window has a correction.
    """
    if not windows.usable.any():
        raise InsufficientDataError(
            say("No window of the survey could be registered to the reference markings: check that both show the "
                "same streets in the same coordinate system, and that the survey has intensities that show paint."))
    n = len(windows)
    covariance = windows.covariance
    status = np.full(n, REGISTERED, np.int8)
    reason = np.full(n, "", dtype=object)
    for code, words in _REASONS.items():
        status[windows.status == code], reason[windows.status == code] = DISTRUSTED, words
    wide = (plan_sigma(covariance) > settings.trusted_sigma) & (status == REGISTERED)
    status[wide], reason[wide] = DISTRUSTED, _REASONS[WEAK]
    return Correction(windows.time, windows.chainage, np.nan_to_num(windows.correction), covariance, status, reason,
                      np.where(windows.usable, 1.0, np.nan), np.full((n, 6), np.nan), windows.three_d, np.nan, np.nan,
                      1.0, np.zeros(0), np.zeros((0, 0, 2)), (), 0.0)


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
