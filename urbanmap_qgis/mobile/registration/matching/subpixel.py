"""Sub-pixel adjustment: points against the reference's coverage as a smooth field, with exact derivatives.

A cell that is covered to a share stands for a cubic B-spline of that height, so that the field is the coverage
blurred by 0.58 of a cell, smooth to the second derivative. Along a line it does not ripple, as the normal
distributions of cells do, so that its curvature tells honestly what the markings fix.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from ....geometry.grid import Grid
from ..start.reference import Coverage

_PAD = 3
_PEAK_RADIUS = 0.15  # m beside the blur, within which a marking's peak is looked for
_MIN_PEAK = 0.15  # of coverage: what stays of a line of 0.1 m under the largest blur is 0.26


@dataclass(frozen=True)
class MarkingField:
    """Coverage as a smooth field.

    Attributes
    ----------
    grid : of the cells, with the padding.
    weights : (rows, columns) float32 of the splines.
    peaks : (rows, columns) the highest of them around, which a line narrower than the blur does not bring to 1.
    background : what stands for points off the markings: the score of a point is log(1 + coverage / background).
    """

    grid: Grid
    weights: np.ndarray
    peaks: np.ndarray
    background: float

    @classmethod
    def of(cls, coverage: Coverage, blur: float, background: float) -> MarkingField:
        """`blur` is, in m, the standard deviation of a Gaussian laid on besides the spline's own; 0 for none."""
        share = coverage.share
        pad = _PAD + int(np.ceil(3 * blur / coverage.grid.cell))
        share = cv2.copyMakeBorder(share, pad, pad, pad, pad, cv2.BORDER_CONSTANT, value=0.0)
        if blur > 0:
            share = cv2.GaussianBlur(share, (0, 0), blur / coverage.grid.cell, borderType=cv2.BORDER_CONSTANT)
        grid = coverage.grid
        return cls(Grid(grid.x_min - pad * grid.cell, grid.y_max + pad * grid.cell, grid.cell, *share.shape),
                   share, _peaks(share, (_PEAK_RADIUS + blur) / grid.cell), background)


def _peaks(share: np.ndarray, radius: float) -> np.ndarray:
    """Highest coverage within `radius` cells of each cell."""
    size = 2 * max(round(radius), 1) + 1
    return cv2.dilate(share, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size)))


@dataclass(frozen=True)
class FieldTerms:
    """Score of each point and its derivatives by x and y, (m,) each; 1/m and 1/m2.

    Attributes
    ----------
    value, gx, gy, hxx, hxy, hyy, and `share` : the coverage at the point, 0 to 1.
    on_marking : (m,) bool, whether it is half of the marking's own peak or more, so that lines count however narrow.
    """

    value: np.ndarray
    gx: np.ndarray
    gy: np.ndarray
    hxx: np.ndarray
    hxy: np.ndarray
    hyy: np.ndarray
    share: np.ndarray
    on_marking: np.ndarray


def field_terms(field: MarkingField, x: np.ndarray, y: np.ndarray) -> FieldTerms:
    """Scores of points (m,), m; outside the grid all is 0."""
    grid, columns = field.grid, field.grid.columns
    u = (x - grid.x_min) / grid.cell - 0.5
    v = (grid.y_max - y) / grid.cell - 0.5
    left, top = np.floor(u).astype(np.int64), np.floor(v).astype(np.int64)
    outside = (left < 1) | (left > columns - 3) | (top < 1) | (top > grid.rows - 3)
    left, top = np.clip(left, 1, columns - 3), np.clip(top, 1, grid.rows - 3)
    bu, bv = (_splines((at - whole).astype(np.float32)) for at, whole in ((u, left), (v, top)))
    flat, corner = field.weights.ravel(), (top - 1) * columns + (left - 1)
    sums = [np.zeros(len(x), dtype=np.float32) for _ in range(6)]
    for row in range(4):
        line = [np.zeros(len(x), dtype=np.float32) for _ in range(3)]
        for column in range(4):
            weight = flat[corner + (row * columns + column)]
            for order in range(3):
                line[order] += weight * bu[order][column]
        for number, (order_u, order_v) in enumerate(((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))):
            sums[number] += line[order_u] * bv[order_v][row]
    f, fx, fy, fxx, fxy, fyy = (np.where(outside, 0.0, s).astype(np.float64) for s in sums)
    peak = np.where(outside, 0.0, field.peaks[np.clip(np.rint(v).astype(np.int64), 0, grid.rows - 1),
                                              np.clip(np.rint(u).astype(np.int64), 0, columns - 1)])
    cell = grid.cell
    total = field.background + f
    gx, gy = fx / (cell * total), -fy / (cell * total)
    scale = 1.0 / (cell * cell * total)
    return FieldTerms(np.log(total / field.background), gx, gy, fxx * scale - gx * gx, -fxy * scale - gx * gy,
                      fyy * scale - gy * gy, f, (peak > _MIN_PEAK) & (f > 0.5 * peak))


def _splines(t: np.ndarray) -> tuple[tuple[np.ndarray, ...], ...]:
    """Values, first and second derivatives of the four cubic B-splines over a share t (m,) of a cell, 0 to 1."""
    s = 1 - t
    values = (s * s * s / 6, 2 / 3 - t * t * (1 - t / 2), 2 / 3 - s * s * (1 - s / 2), t * t * t / 6)
    first = (-s * s / 2, t * (1.5 * t - 2), -s * (1.5 * s - 2), t * t / 2)
    second = (s, 3 * t - 2, 3 * s - 2, t)
    return values, first, second
