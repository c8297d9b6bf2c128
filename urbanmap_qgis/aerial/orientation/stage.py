"""From orientations and points in frames to corrected orientations, with what the points say of each other."""

from __future__ import annotations

import csv
import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import InsufficientDataError
from ...io.files.atomic import written_beside
from ...progress import SILENT, Progress
from ...settings.aerial import BundleSettings
from ...wording import mark, say
from ..frames.camera import ExteriorOrientation, FrameCamera
from .bundle import POSE, AdjustedFrames, adjust_frames, contradicting, errors_on_ground, left_out_error
from .image_points import ImagePoints

_FEW = 3  # control points: fewer do not tell a shift from a tilt
_NARROW = 0.3  # of the length of the area that the frames' centres and their ground take in
_MOST_LEFT_OUT = 50  # control points that are each left out once


@dataclass(frozen=True)
class FrameControl:
    """Adjusted frames and how well they fit.

    Attributes
    ----------
    points : what was measured.
    before : (n, 2) m east and north, see `errors_on_ground`, with the orientations as given.
    adjusted : the orientations corrected.
    left_out : (k, 2) m east and north, mean over its frames, of each control point while the others alone were used;
        NaN where it was not tried.
    wrong : (k,) bool, control points that contradict the others.
    findings : sentences on few, clustered or wrong points and on frames without any.
    """

    points: ImagePoints
    before: np.ndarray
    adjusted: AdjustedFrames
    left_out: np.ndarray
    wrong: np.ndarray
    findings: tuple[str, ...]

    @property
    def followed(self) -> np.ndarray:
        """(k,) bool, control points that do not contradict the others."""
        return self.points.control & ~self.wrong

    def rms(self, which: np.ndarray, before: bool = False) -> float:
        """RMS in plan, m, of some points (k,) bool, each the mean of its frames; NaN where there is none."""
        errors = mean_of_points(self.points, self.before if before else self.adjusted.ground_error)[which]
        return _rms(errors)

    def left_out_rms(self) -> float:
        """RMS in plan, m, of the control points that were left out in turn; NaN where none was."""
        return _rms(self.left_out[~self.wrong])


def control_frames(camera: FrameCamera, poses: Sequence[ExteriorOrientation], points: ImagePoints,
                   settings: BundleSettings | None = None, progress: Progress = SILENT) -> FrameControl:
    """Adjust frames to control points, each control point held against the others.

    Raises
    ------
    InputError : see `adjust_frames`.
    InsufficientDataError : no control point is in any frame, or all contradict the frames.
    """
    settings = settings or BundleSettings()
    adjusted = adjust_frames(camera, poses, points, settings)
    wrong = contradicting(points, adjusted)
    if not (points.control & ~wrong).any():
        raise InsufficientDataError(say("All control points contradict the frames: check the coordinate system, the "
                                        "order of the angles and the points' names."))
    left_out = np.full((len(points.points), 2), np.nan)
    tried = np.flatnonzero(points.control)[:_MOST_LEFT_OUT]
    for count, number in enumerate(tried if points.control.sum() > 1 else ()):
        progress.step(count / len(tried))
        left_out[number] = left_out_error(camera, poses, points, adjusted, number, settings)
    return FrameControl(points, errors_on_ground(camera, poses, points), adjusted, left_out, wrong,
                        _findings(poses, points, wrong))


def mean_of_points(points: ImagePoints, errors: np.ndarray) -> np.ndarray:
    """(k, 2) means over the observations of each point, NaN where there is none."""
    count = np.bincount(points.point, minlength=len(points.points))
    return np.column_stack([np.bincount(points.point, axis, len(count)) for axis in errors.T]) / count[:, None]


def residual_columns(result: FrameControl) -> dict[str, list]:
    """Columns of the layer of residuals, a row for each point with coordinates; m, east and north."""
    points, known = result.points, np.flatnonzero(result.points.known)
    before, after = (mean_of_points(points, errors)[known] for errors in (result.before, result.adjusted.ground_error))
    role = np.where(points.check, mark("check"), np.where(result.wrong, mark("wrong"), mark("control")))[known]
    seen = np.bincount(points.point, minlength=len(points.points))[known]
    columns = {"id": [points.points[number] for number in known], "role": role.tolist(), "frames": seen.tolist(),
               "plan_before": np.hypot(*before.T).tolist(), "plan_after": np.hypot(*after.T).tolist()}
    for name, values in (("before", before), ("after", after), ("left_out", result.left_out[known])):
        columns |= {f"east_{name}": values[:, 0].tolist(), f"north_{name}": values[:, 1].tolist()}
    return columns


def write_exterior(path: str | os.PathLike, adjusted: AdjustedFrames) -> None:
    """Write corrected orientations as `read_exterior` takes them (papers' order, degrees), with standard deviations."""
    with written_beside(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as target:
        writer = csv.writer(target)
        writer.writerow(["image", *POSE, *(f"sd_{name}" for name in POSE)])
        for pose, sigma in zip(adjusted.poses, adjusted.sigma):
            values = [getattr(pose, name) for name in POSE]
            writer.writerow([pose.image, *(f"{value:.4f}" for value in values[:3]),
                             *(f"{value:.6f}" for value in values[3:]), *(f"{value:.4f}" for value in sigma[:3]),
                             *(f"{value:.6f}" for value in sigma[3:])])


def _rms(errors: np.ndarray) -> float:
    known = errors[np.isfinite(errors).all(axis=1)]
    return float(np.sqrt(np.mean(np.sum(known**2, axis=1)))) if len(known) else float("nan")


def _findings(poses: Sequence[ExteriorOrientation], points: ImagePoints, wrong: np.ndarray) -> tuple[str, ...]:
    """What must be looked at."""
    found, control = [], points.control
    seen = {points.images[number] for number in np.unique(points.image[control[points.point]])}
    if control.sum() < _FEW:
        found.append(say("{count} control points tell a shift of the block, not how it is tilted: measure three or "
                         "more, far from each other.", count=int(control.sum())))
    elif _extent(points.place[control]) < _NARROW * _extent(np.array([pose.centre for pose in poses])):
        found.append(say("The control points lie close together: away from them the frames may be tilted."))
    if wrong.any():
        found.append(say("Points that contradict the others, and were not followed: {names}.",
                         names=", ".join(np.array(points.points)[wrong])))
    alone = [pose.image for pose in poses if pose.image not in seen]
    if alone:
        found.append(say("{count} frames see no control point and follow the others: {names}.", count=len(alone),
                         names=", ".join(alone[:5]) + (" ..." if len(alone) > 5 else "")))
    return tuple(found)


def _extent(places: np.ndarray) -> float:
    """Length of the box around places (n, 3) in plan, m."""
    return float(np.hypot(*np.ptp(places[:, :2], axis=0)))
