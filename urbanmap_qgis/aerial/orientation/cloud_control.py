"""A laser point cloud shifted to control points, each held against the others (J 6.1, step 3)."""

from __future__ import annotations

import copy
import os
from dataclasses import dataclass

import numpy as np

from ...errors import InsufficientDataError
from ...geometry.tolerances import SIGMA_OF_MAD
from ...io.points.pointcloud import PointCloud, PointLayout, cloud_writer, iter_chunks
from ...progress import SILENT, Progress
from ...wording import mark, say
from .cloud_points import CloudPoints

CONTRADICTING = 4.0  # standard deviations from the others
JUDGED = 4  # points: fewer do not tell which of them is wrong
FEW = 3  # points
NARROW = 0.3  # of the length of the cloud that the control points take in
TRUSTED = 3.0  # sigmas of the shift: less is no shift that is shown


@dataclass(frozen=True)
class CloudControl:
    """How a cloud is shifted.

    Attributes
    ----------
    points : what was measured.
    shift, sigma : (3,) east, north, up that bring the cloud to the truth, and standard deviations, m; 0 and NaN where
        no point tells.
    used : (n, 3) bool, control points that the shift follows, by axis.
    wrong : (n,) bool, control points that contradict the others.
    left_out : (n, 3) error of each control point after the shift that the others give, m; NaN where not tried.
    findings : sentences on few, wrong and clustered points, and on what is not told.
    """

    points: CloudPoints
    shift: np.ndarray
    sigma: np.ndarray
    used: np.ndarray
    wrong: np.ndarray
    left_out: np.ndarray
    findings: tuple[str, ...]

    @property
    def after(self) -> np.ndarray:
        """(n, 3) errors after the shift, m."""
        return self.points.errors + self.shift

    def rms(self, errors: np.ndarray, rows: np.ndarray) -> tuple[float, float]:
        """RMS in plan and in height of errors (n, 3) of some rows (n,) bool, m; NaN where there is none."""
        plan = errors[rows & np.isfinite(errors[:, :2]).all(axis=1), :2]
        height = errors[rows & np.isfinite(errors[:, 2]), 2]
        return (float(np.sqrt(np.mean(np.sum(plan**2, axis=1)))) if len(plan) else float("nan"),
                float(np.sqrt(np.mean(height**2))) if len(height) else float("nan"))


def control_cloud(points: CloudPoints, control_sigma: float, extent: np.ndarray) -> CloudControl:
    """The shift of a cloud by its control points.

    Parameters
    ----------
    points : with heights measured in the cloud (`cloud_points.measured_heights`).
    control_sigma : standard deviation of a control point's coordinates and of its place in the cloud, m.
    extent : (2,) of the cloud in plan, m.

    Raises
    ------
    InsufficientDataError : no control point lies in the cloud, or all contradict each other.
    """
    errors = points.errors
    sigma = np.hypot(np.column_stack([np.zeros((len(points), 2)), np.nan_to_num(points.sigma)]), control_sigma)
    control = np.isfinite(errors) & ~points.check[:, None]
    if not control.any():
        raise InsufficientDataError(say("No control point was found in the cloud: give points on open ground within "
                                        "it, or their places in it as x_als, y_als."))
    wrong = _contradicting(errors, sigma, control)
    used = control & ~wrong[:, None]
    shift, accuracy = np.zeros(3), np.full(3, np.nan)
    left_out = np.full(errors.shape, np.nan)
    for axis in range(3):
        rows = np.flatnonzero(used[:, axis])
        if len(rows):
            shift[axis], accuracy[axis] = _weighted(-errors[rows, axis], sigma[rows, axis])
        for row in np.flatnonzero(control[:, axis]):
            others = rows[rows != row]
            if len(others):
                left_out[row, axis] = errors[row, axis] + _weighted(-errors[others, axis], sigma[others, axis])[0]
    found = CloudControl(points, shift, accuracy, used, wrong, left_out, ())
    return CloudControl(points, shift, accuracy, used, wrong, left_out, _findings(found, extent))


def _weighted(values: np.ndarray, sigma: np.ndarray) -> tuple[float, float]:
    """Weighted mean and its standard deviation, by the scatter where it is larger than the sigmas say."""
    weight = sigma**-2.0
    mean = float(np.average(values, weights=weight))
    scatter = np.sum(weight * (values - mean) ** 2) / max(len(values) - 1, 1)
    return mean, float(np.sqrt(max(scatter, 1.0) / weight.sum()))


def _contradicting(errors: np.ndarray, sigma: np.ndarray, control: np.ndarray) -> np.ndarray:
    """(n,) control points that lie far from the median of the others on some axis."""
    wrong = np.zeros(len(errors), bool)
    for axis in range(3):
        rows = np.flatnonzero(control[:, axis])
        if len(rows) < JUDGED:
            continue
        for row in rows:
            others = errors[rows[rows != row], axis]
            middle = np.median(others)
            spread = max(SIGMA_OF_MAD * float(np.median(np.abs(others - middle))), float(sigma[row, axis]))
            wrong[row] |= bool(abs(errors[row, axis] - middle) > CONTRADICTING * spread)
    return wrong


def _findings(found: CloudControl, extent: np.ndarray) -> tuple[str, ...]:
    """What must be looked at."""
    points, sentences = found.points, []
    heights, plan = int(found.used[:, 2].sum()), int(found.used[:, 0].sum())
    unmeasured = [name for name, error in zip(points.id, points.errors) if not np.isfinite(error[2])]
    if not plan:
        sentences.append(say("No point tells the cloud's place in plan (x_als, y_als): only its height is shifted."))
    if not heights:
        sentences.append(say("No point tells the cloud's height: only its place in plan is shifted."))
    for count, what in ((heights, say("height")), (plan, say("place in plan"))):
        if 0 < count < FEW:
            sentences.append(say("{count} control points tell the {what}: too few to show a wrong one among them.",
                                 count=count, what=what))
    places = points.true[found.used.any(axis=1), :2]
    if len(places) >= FEW and np.hypot(*np.ptp(places, axis=0)) < NARROW * np.hypot(*extent):
        sentences.append(say("The control points lie close together: away from them the cloud may be tilted."))
    if found.wrong.any():
        sentences.append(say("Points that contradict the others, and were not followed: {names}.",
                             names=", ".join(np.array(points.id)[found.wrong])))
    if unmeasured:
        sentences.append(say("The cloud has no ground around these points: {names}.", names=", ".join(unmeasured)))
    known = np.isfinite(found.sigma)
    if known.any() and not (np.abs(found.shift) > TRUSTED * found.sigma)[known].any():
        sentences.append(say("The shift is no larger than its accuracy: the cloud fits as it is."))
    return tuple(sentences)


def residual_rows(found: CloudControl) -> dict[str, list]:
    """Columns of the layer of residuals, a row each point; m, cloud less truth."""
    points = found.points
    role = np.where(points.check, mark("check"), np.where(found.wrong, mark("wrong"), mark("control")))
    columns: dict[str, list] = {"id": list(points.id), "role": role.tolist()}
    for name, values in (("before", points.errors), ("after", found.after), ("left_out", found.left_out)):
        columns |= {f"{axis}_{name}": values[:, k].tolist() for k, axis in enumerate(("east", "north", "up"))}
        if name != "left_out":
            columns[f"plan_{name}"] = np.hypot(*values[:, :2].T).tolist()
    return columns


def write_shifted(cloud: PointCloud, shift: np.ndarray, output: str | os.PathLike, progress: Progress = SILENT) -> int:
    """Write a cloud shifted by (3,) m as one LAZ or LAS file; the number of points.

    The shift goes into the file's offsets: no coordinate is rounded anew, everything else stays.

    Raises
    ------
    InputError : the name ends in neither, or a file is damaged.
    """
    layout = PointLayout(cloud)
    placed = copy.copy(layout)
    placed.header = copy.deepcopy(layout.header)
    placed.header.offsets = layout.header.offsets + shift
    count = 0
    with cloud_writer(output, placed) as writer:
        for chunk in iter_chunks(cloud, progress):
            writer.write(layout.adapt(chunk, np.ones(len(chunk), bool)))
            count += len(chunk)
    return count
