"""Drift spread over the epochs between two ground truths by adjusting the relative motions (Z 3.1, eq. 8 to 10).

Poses in plan are T = (x, y, kappa), kappa anticlockwise from east; t_ij = T_i^-1 T_j is the motion from i to j as the
vehicle sees it. When T_s is true and T_e should be T_e', every step between them takes its part of the error: eq. 8
closes the loop through the adjusted steps, the map motion C = T_e' T_e^-1 seen from epoch i, T_i^-1 C T_i, of which
each of the e - s steps takes its part. (The print leaves out primes and an inverse of eq. 8; as it stands it is no
correction.) The part is taken of the motion's three numbers, so the loop is not closed at once and eq. 9 is repeated.

Before the first ground truth and after each of them the course is moved rigidly. The algorithm box of Z 3.1 prints
T_i dT with dT = T_g^-1 T_g' for it: taken as printed, the shift would be constant in the vehicle's axes and rotate
with every bend, and the course would not keep its shape. It is read as dT T_i, dT = T_g' T_g^-1, a motion of the map.
"""

from __future__ import annotations

import numpy as np

from ...errors import InputError
from ...wording import say
from ..trajectory import Trajectory

CLOSED, CLOSED_ROTATION = 1e-5, 1e-8
"""The iteration ends when the loop is closed to this many metres and radians."""

MAX_ITERATIONS = 50


def adjust_relative_motion(trajectory: Trajectory, epochs: np.ndarray, drift: np.ndarray) -> Trajectory:
    """The trajectory through ground truths, its relative motions changed as little as they must be (Z 3.1).

    Rigid before the first and after the last ground truth. Heights, roll and pitch stay.

    Parameters
    ----------
    epochs : (k,) numbers of epochs, increasing.
    drift : (k, 3) what must be added there: east, north (m) and rotation anticlockwise (radians).

    Raises
    ------
    InputError : epochs do not increase.
    """
    epochs = np.asarray(epochs)
    if len(epochs) < 1 or np.any(np.diff(epochs) <= 0):
        raise InputError(say("Ground truths must be at different epochs, in the order of time."))
    origin = complex(*trajectory.place[epochs[0], :2])
    place = trajectory.place[:, 0] + 1j * trajectory.place[:, 1] - origin
    kappa = np.radians(90.0 - trajectory.angles[:, 2])
    true_place = place[epochs] + drift[:, 0] + 1j * drift[:, 1]
    true_kappa = kappa[epochs] + drift[:, 2]
    first = epochs[0]
    place, kappa = _transformed(place, kappa, *_motion(place[first], kappa[first], true_place[0], true_kappa[0]))
    for start, end, to_place, to_kappa in zip(epochs[:-1], epochs[1:], true_place[1:], true_kappa[1:]):
        rotation, translation = _motion(place[end], kappa[end], to_place, to_kappa)
        between = slice(start, end + 1)
        after = _transformed(place[end:], kappa[end:], rotation, translation)
        place[between], kappa[between] = _iterated(place[between], kappa[between], to_place, to_kappa)
        place[end:], kappa[end:] = after
    place = place + origin
    return Trajectory(trajectory.time, np.column_stack([place.real, place.imag, trajectory.place[:, 2]]),
                      np.column_stack([trajectory.angles[:, :2], 90.0 - np.degrees(kappa)]))


def _motion(place: complex, kappa: float, to_place: complex, to_kappa: float) -> tuple[float, complex]:
    """The map's motion T' T^-1 as a rotation and a translation: z goes to exp(i rotation) z + translation."""
    rotation = to_kappa - kappa
    return rotation, to_place - np.exp(1j * rotation) * place


def _transformed(place: np.ndarray, kappa: np.ndarray, rotation: float, translation: complex
                 ) -> tuple[np.ndarray, np.ndarray]:
    return np.exp(1j * rotation) * place + translation, kappa + rotation


def _iterated(place: np.ndarray, kappa: np.ndarray, to_place: complex,
              to_kappa: float) -> tuple[np.ndarray, np.ndarray]:
    """The paper's iteration (eq. 8, 9): every step takes an equal part of the open loop, as seen from where it starts.
    """
    part = 1.0 / (len(place) - 1)
    best = np.inf
    best_pose = place, kappa
    for _ in range(MAX_ITERATIONS):
        rotation, translation = _motion(place[-1], kappa[-1], to_place, to_kappa)
        open_loop = abs(to_place - place[-1]) + abs(rotation) * CLOSED / CLOSED_ROTATION
        if open_loop >= best:
            break
        best, best_pose = open_loop, (place, kappa)
        if abs(to_place - place[-1]) < CLOSED and abs(rotation) < CLOSED_ROTATION:
            break
        back = np.exp(-1j * kappa[:-1])
        step, rotations = back * np.diff(place), np.diff(kappa)
        whole = back * ((np.exp(1j * rotation) - 1.0) * place[:-1] + translation)
        step = part * whole + np.exp(1j * part * rotation) * step
        kappa = kappa[0] + np.concatenate([[0.0], np.cumsum(rotations + part * rotation)])
        place = place[0] + np.concatenate([[0.0], np.cumsum(np.exp(1j * kappa[:-1]) * step)])
    return best_pose
