"""The windows of a registration as normal equations of the pieces of the path."""

from __future__ import annotations

import numpy as np

from ....errors import InsufficientDataError
from ....estimation.normal_equations import PLANE, SPACE, NormalEquations
from ....wording import say
from ..records import WindowResults


def normal_equations_of(windows: WindowResults, path_parameter: np.ndarray) -> NormalEquations:
    """The normal equations of windows' results at path parameters (n,): those of the patches' own points where given.

    Otherwise windows are rigid and share their points; each counts for its own patch, with its share of the points.

    Raises
    ------
    InsufficientDataError : no window was registered.
    """
    active = SPACE if windows.three_d else PLANE
    pick = list(active)
    usable = windows.usable
    information = np.nan_to_num(windows.information[:, pick][:, :, pick])
    place, gradient = np.nan_to_num(windows.linearised[:, pick]), np.nan_to_num(windows.gradient[:, pick])
    if not information[usable].any():
        place, gradient = np.nan_to_num(windows.correction[:, pick]), np.zeros((len(windows), len(pick)))
        information = _shared(windows, pick, usable)
    information, gradient = _without_bends(information, gradient)
    information[~usable], gradient[~usable] = 0.0, 0.0
    present = usable & information.any(axis=(1, 2))
    if not present.any():
        raise InsufficientDataError(
            say("No section of the survey could be registered to the reference markings: check that both show the "
                "same streets in the same coordinate system, and that the survey has intensities that show paint."))
    return NormalEquations(active, path_parameter, place, gradient, information, present, windows.three_d)


def _shared(windows: WindowResults, pick: list[int], usable: np.ndarray) -> np.ndarray:
    """Information (n, d, d) of windows, divided by the number of patches that share it."""
    information = np.zeros((len(windows), len(pick), len(pick)))
    covariance = windows.covariance[usable][:, pick][:, :, pick]
    size = (windows.window_last - windows.window_first + 1)[usable]
    known = np.isfinite(covariance).all(axis=(1, 2))
    inverse = np.zeros_like(covariance)
    inverse[known] = np.linalg.inv(covariance[known])
    information[usable] = inverse / size[:, None, None]
    return information


def _without_bends(information: np.ndarray, gradient: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Directions in which a patch's score is not curved downwards say nothing: they are taken out."""
    values, vectors = np.linalg.eigh(0.5 * (information + np.swapaxes(information, 1, 2)))
    good = values > 0
    information = np.einsum("nij,nj,nkj->nik", vectors, np.where(good, values, 0.0), vectors)
    along = np.einsum("nji,nj->ni", vectors, gradient) * good
    return information, np.einsum("nij,nj->ni", vectors, along)
