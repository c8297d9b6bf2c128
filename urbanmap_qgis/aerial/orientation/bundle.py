"""Exterior orientations adjusted to control points in one bundle, with what was measured of them as prior knowledge.

Each frame has six corrections of its own, all frames share six more (a datum's shift, a misaligned camera); control and
tie points are unknowns too, control points with their accuracy. With few points the shared part is found and what each
frame is off by stays as the navigation left it; points in a frame, and ties to its neighbours, find its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix, diags
from scipy.sparse.linalg import splu

from ...errors import InputError, InsufficientDataError
from ...settings.aerial import BundleSettings
from ...wording import say
from ..frames.camera import ExteriorOrientation, FrameCamera, frame_rays, project_places
from .image_points import ImagePoints

POSE = ("x", "y", "z", "omega", "phi", "kappa")
_SIX = len(POSE)
_STEP = np.array([1e-3, 1e-3, 1e-3, 1e-5, 1e-5, 1e-5])  # m, degrees, of the derivatives

ROUNDS = 20
ENOUGH = 0.01  # of a pixel, that the observations still move
GROSS = 3.0  # standard deviations from which an observation loses its weight
TIE_SIGMA = 1e4  # m, of the place of a tie point
FEWEST = 2  # frames that see a tie point
WRONG = 0.2  # weight below which a control point's observations contradict the others


@dataclass(frozen=True)
class AdjustedFrames:
    """What came out.

    Attributes
    ----------
    poses : corrected orientations, in the order given.
    sigma : (frames, 6) standard deviations, m and degrees.
    residual : (n, 2) pixels, measured less computed, of each observation; of check points with their given place.
    weight : (n,) 0 to 1; NaN of check points.
    ground_error : (n, 2) m east and north from a known point to its pixel's place at its height; NaN of ties.
    noise : standard deviation of the observations, times that assumed.
    own_scale : how much of the stated size the frames' own errors have, found from the points.
    state : (unknowns,) shared, frame by frame, point by point.
    """

    poses: tuple[ExteriorOrientation, ...]
    sigma: np.ndarray
    residual: np.ndarray
    weight: np.ndarray
    ground_error: np.ndarray
    noise: float
    own_scale: float
    state: np.ndarray

    @property
    def correction(self) -> np.ndarray:
        """(frames, 6) corrections, shared and own together, m and degrees."""
        return _corrections(self.state, len(self.poses))


def adjust_frames(camera: FrameCamera, poses: Sequence[ExteriorOrientation], points: ImagePoints,
                  settings: BundleSettings | None = None) -> AdjustedFrames:
    """Adjust the frames' exterior orientations to control points.

    Raises
    ------
    InputError : points were measured in an image without orientation, outside it, or behind its camera.
    InsufficientDataError : no control point is in any frame.
    """
    problem = _problem_of(camera, poses, points, settings or BundleSettings())
    nothing = np.zeros(_SIX * (1 + len(poses)) + 3 * len(points.points))
    tried = (_solved(problem, scale, nothing) for scale in problem.settings.own_scales)
    best = max(tried, key=lambda found: found.likelihood)
    adjusted, frame = _corrected(poses, best.state), problem.frame
    computed, _ = _linearised(problem, best.state)
    given = _projected(camera, adjusted, frame, points.place[points.point])
    computed = np.where(points.check[points.point][:, None], given, computed)
    error = _errors_on_ground(camera, adjusted, points, frame)
    return AdjustedFrames(adjusted, _sigma(best.factors, len(poses), len(best.state)), points.pixel - computed,
                          np.where(problem.used, best.weight, np.nan), error, best.noise, best.own_scale, best.state)


def errors_on_ground(camera: FrameCamera, poses: Sequence[ExteriorOrientation], points: ImagePoints) -> np.ndarray:
    """(n, 2) m east and north from a known point to where its pixel comes to lie at its height; NaN of ties.

    Raises
    ------
    InputError : points were measured in an image without orientation, or outside it.
    """
    return _errors_on_ground(camera, poses, points, _frames_of(camera, poses, points))


def left_out_error(camera: FrameCamera, poses: Sequence[ExteriorOrientation], points: ImagePoints,
                   adjusted: AdjustedFrames, number: int, settings: BundleSettings) -> np.ndarray:
    """(2,) m east and north, mean over its frames, by which a control point is off that only the others place."""
    check = points.check.copy()
    check[number] = True
    points = replace(points, check=check)
    problem = _problem_of(camera, poses, points, settings)
    found = _corrected(poses, _solved(problem, adjusted.own_scale, adjusted.state).state)
    return _apart(camera, found, points, problem.frame, points.point == number).mean(axis=0)


@dataclass(frozen=True)
class _Problem:
    """What is adjusted: see `adjust_frames`; `frame` (n,) of each observation, `start` (k, 3) m, `used` (n,) bool."""

    camera: FrameCamera
    poses: tuple[ExteriorOrientation, ...]
    points: ImagePoints
    frame: np.ndarray
    start: np.ndarray
    used: np.ndarray
    settings: BundleSettings


@dataclass(frozen=True)
class _Solution:
    """State (unknowns,), factors of its normal matrix, weights (n,), noise, and log-likelihood of the prior."""

    state: np.ndarray
    factors: object
    weight: np.ndarray
    noise: float
    likelihood: float
    own_scale: float


def _problem_of(camera: FrameCamera, poses: Sequence[ExteriorOrientation], points: ImagePoints,
                settings: BundleSettings) -> _Problem:
    frame = _frames_of(camera, poses, points)
    if not points.control[points.point].any():
        raise InsufficientDataError(say("No control point is in any frame: give points with x, y, z and their places "
                                        "in the images."))
    return _Problem(camera, tuple(poses), points, frame, _start(camera, poses, points, frame), _used(points), settings)


def _solved(problem: _Problem, scale: float, state: np.ndarray) -> _Solution:
    """Gauss and Newton's method with weights by the misfits, for frames whose own errors are `scale` times as large.

    `state` (unknowns,) is where it begins.
    """
    settings = problem.settings
    prior = _prior(len(problem.poses), problem.points, settings, scale)
    for _ in range(ROUNDS):
        computed, jacobian = _linearised(problem, state)
        misfit = problem.points.pixel - computed
        noise, weight = _reweighted(misfit, problem.used, settings.pixel)
        scaled = np.repeat(weight / (noise * settings.pixel) ** 2, 2)
        normal = (jacobian.T @ jacobian.multiply(scaled[:, None]) + diags(prior)).tocsc()
        factors = splu(normal, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        step = factors.solve(jacobian.T @ (scaled * misfit.ravel()) - prior * state)
        state = state + step
        if np.abs((jacobian @ step).reshape(-1, 2)[problem.used]).max() < ENOUGH:
            break
    size = np.hypot(*misfit.T)[problem.used] / (noise * settings.pixel)
    cost = float(np.sum(GROSS**2 * size**2 / (GROSS**2 + size**2)) + state @ (prior * state))
    volume = float(np.log(np.abs(factors.U.diagonal())).sum() - np.log(prior).sum())
    noisy = 4.0 * problem.used.sum() * np.log(noise)
    return _Solution(state, factors, weight, noise, -0.5 * (cost + volume + noisy), scale)


def contradicting(points: ImagePoints, adjusted: AdjustedFrames) -> np.ndarray:
    """(k,) bool, control points whose observations contradict all others."""
    heard = np.isfinite(adjusted.weight)
    count = np.maximum(np.bincount(points.point, heard, len(points.points)), 1)
    mean = np.bincount(points.point, np.where(heard, adjusted.weight, 0.0), len(points.points)) / count
    return points.control & (mean < WRONG)


def _frames_of(camera: FrameCamera, poses: Sequence[ExteriorOrientation], points: ImagePoints) -> np.ndarray:
    """(n,) number of the pose of each observation."""
    number = {pose.image: place for place, pose in enumerate(poses)}
    for image in points.images:
        if image not in number:
            raise InputError(say("Points were measured in {image}, which the exterior orientation does not name.",
                                 image=image))
    outside = ((points.pixel < -0.5) | (points.pixel > np.array([camera.width, camera.height]) - 0.5)).any(axis=1)
    if outside.any():
        first = int(outside.argmax())
        raise InputError(say("The point {point} lies outside {image}: columns and rows are counted in pixels from the "
                             "upper left.", point=points.points[points.point[first]],
                             image=points.images[points.image[first]]))
    return np.array([number[image] for image in points.images])[points.image]


def _used(points: ImagePoints) -> np.ndarray:
    """(n,) bool, observations that say something: of control points, and of ties in several frames."""
    seen = np.bincount(points.point, minlength=len(points.points))
    ties = ~points.known & (seen >= FEWEST)
    return (points.control | ties)[points.point]


def _start(camera: FrameCamera, poses: Sequence[ExteriorOrientation], points: ImagePoints,
           frame: np.ndarray) -> np.ndarray:
    """(k, 3) m: known places, and where the rays of tie points come nearest to each other."""
    place = points.place.copy()
    centre = np.array([pose.centre for pose in poses])[frame]
    ray = np.empty((len(frame), 3))
    for number in np.unique(frame):
        ray[frame == number] = frame_rays(camera, poses[number], *points.pixel[frame == number].T)
    across = np.eye(3) - ray[:, :, None] * ray[:, None, :]
    normal, right = np.zeros((len(place), 3, 3)), np.zeros((len(place), 3))
    np.add.at(normal, points.point, across)
    np.add.at(right, points.point, np.einsum("nij,nj->ni", across, centre))
    meeting = np.einsum("kij,kj->ki", np.linalg.pinv(normal, hermitian=True), right)
    down = (float(np.nanmean(place[:, 2])) - centre[:, 2]) / ray[:, 2]
    alone = np.empty_like(place)
    alone[points.point] = centre + down[:, None] * ray
    several = np.bincount(points.point, minlength=len(place)) >= FEWEST
    found = np.where(several[:, None], meeting, alone)
    place[~points.known] = found[~points.known]
    return place


def _prior(frames: int, points: ImagePoints, settings: BundleSettings, scale: float) -> np.ndarray:
    """Weights of all unknowns: shared, frame by frame (`scale` times as large as stated), point by point."""
    stated = np.repeat([settings.position, settings.angle], 3)
    place = np.where(points.control, settings.control, TIE_SIGMA)
    return np.concatenate([settings.shared * stated, np.tile(scale * stated, frames), np.repeat(place, 3)]) ** -2.0


def _corrected(poses: Sequence[ExteriorOrientation], state: np.ndarray) -> tuple[ExteriorOrientation, ...]:
    """The poses with the shared and their own corrections."""
    change = _corrections(state, len(poses))
    return tuple(replace(pose, **{name: getattr(pose, name) + float(value) for name, value in zip(POSE, row)})
                 for pose, row in zip(poses, change))


def _corrections(state: np.ndarray, frames: int) -> np.ndarray:
    """(frames, 6) shared and own corrections together, m and degrees."""
    return state[:_SIX] + state[_SIX:_SIX * (1 + frames)].reshape(-1, _SIX)


def _projected(camera: FrameCamera, poses: Sequence[ExteriorOrientation], frame: np.ndarray,
               place: np.ndarray) -> np.ndarray:
    """(n, 2) pixels of places (n, 3), each in its frame; NaN behind the camera."""
    pixel = np.full((len(frame), 2), np.nan)
    for number in np.unique(frame):
        rows = frame == number
        column, row, _ = project_places(camera, poses[number], *place[rows].T)
        pixel[rows] = np.column_stack([column, row])
    return pixel


def _linearised(problem: _Problem, state: np.ndarray) -> tuple[np.ndarray, csc_matrix]:
    """Pixels (n, 2) and their derivatives (2 n, unknowns)."""
    camera, poses, points, frame = problem.camera, problem.poses, problem.points, problem.frame
    frames, n = len(poses), len(frame)
    place = problem.start + state[_SIX * (1 + frames):].reshape(-1, 3)
    now = _corrected(poses, state)
    computed = _projected(camera, now, frame, place[points.point])
    if not np.isfinite(computed).all():
        lost = int(np.flatnonzero(~np.isfinite(computed).all(axis=1))[0])
        raise InputError(say("The point {point} lies behind the camera of {image}: check the exterior orientation and "
                             "the coordinates.", point=points.points[points.point[lost]],
                             image=points.images[points.image[lost]]))
    slopes = np.empty((n, 2, _SIX + 3))
    for k, name in enumerate(POSE):
        moved = [replace(pose, **{name: getattr(pose, name) + _STEP[k]}) for pose in now]
        slopes[:, :, k] = (_projected(camera, moved, frame, place[points.point]) - computed) / _STEP[k]
    for axis in range(3):
        shifted = place[points.point] + _STEP[0] * np.eye(3)[axis]
        slopes[:, :, _SIX + axis] = (_projected(camera, now, frame, shifted) - computed) / _STEP[0]
    six = np.arange(_SIX)
    column = np.concatenate([np.broadcast_to(six, (n, _SIX)), _SIX * (1 + frame)[:, None] + six,
                             _SIX * (1 + frames) + 3 * points.point[:, None] + np.arange(3)], axis=1)
    values = np.concatenate([slopes[:, :, :_SIX], slopes], axis=2)
    row = np.broadcast_to(np.arange(2 * n).reshape(n, 2, 1), values.shape)
    return computed, coo_matrix((values.ravel(), (row.ravel(), np.repeat(column[:, None], 2, axis=1).ravel())),
                                shape=(2 * n, len(state))).tocsc()


def _reweighted(misfit: np.ndarray, used: np.ndarray, pixel: float) -> tuple[float, np.ndarray]:
    """Noise, times that assumed, and weights (n,): what contradicts the rest loses its own."""
    size = np.hypot(*misfit.T) / pixel
    noise = max(1.0, float(np.median(size[used])) / 1.1774)  # the median of a Rayleigh distribution
    return noise, used / (1.0 + (size / (noise * GROSS)) ** 2) ** 2


def _sigma(factors, frames: int, size: int) -> np.ndarray:
    """(frames, 6) standard deviations of the shared and own corrections together, m and degrees."""
    sigma = np.empty((frames, _SIX))
    for number in range(frames):
        pick = np.zeros((size, _SIX))
        pick[np.arange(_SIX), np.arange(_SIX)] = 1.0
        pick[_SIX * (1 + number) + np.arange(_SIX), np.arange(_SIX)] = 1.0
        sigma[number] = np.sqrt(np.einsum("ji,ji->i", pick, factors.solve(pick)))
    return sigma


def _errors_on_ground(camera: FrameCamera, poses: Sequence[ExteriorOrientation], points: ImagePoints,
                      frame: np.ndarray) -> np.ndarray:
    """(n, 2) m, see `errors_on_ground`, with the pose `frame` (n,) of each observation."""
    known = points.known[points.point]
    errors = np.full((len(frame), 2), np.nan)
    errors[known] = _apart(camera, poses, points, frame, known)
    return errors


def _apart(camera: FrameCamera, poses: Sequence[ExteriorOrientation], points: ImagePoints, frame: np.ndarray,
           which: np.ndarray) -> np.ndarray:
    """(m, 2) m, from known points to where their pixels lie at their heights, of some observations (n,) bool."""
    rows = np.flatnonzero(which)
    place, errors = points.place[points.point[rows]], np.empty((len(rows), 2))
    for number in np.unique(frame[rows]):
        of_frame, pose = frame[rows] == number, poses[number]
        ray = frame_rays(camera, pose, *points.pixel[rows[of_frame]].T)
        along = (place[of_frame, 2] - pose.z) / ray[:, 2]
        errors[of_frame] = (pose.centre + along[:, None] * ray)[:, :2] - place[of_frame, :2]
    return errors
