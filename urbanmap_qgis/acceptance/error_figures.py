"""Figures of errors at check points, in plan and in height apart, and what so few points leave open."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

CONFIDENCE = 0.95

_LEAST_CROSSING = 0.1  # of the edges must run, in sum, across the main direction


@dataclass(frozen=True)
class ErrorFigures:
    """Figures of n errors, m; NaN where there are too few.

    Attributes
    ----------
    count : n.
    mean : of the signed errors; in plan of the distances.
    rmse : root of the mean square, which is the standard deviation about a mean of 0 by which map levels are judged.
    std : standard deviation about the mean, with n - 1.
    maximum : greatest size.
    bound : the standard deviation of all places is below this with a confidence of 95 %, if errors are normal.
    """

    count: int
    mean: float
    rmse: float
    std: float
    maximum: float
    bound: float


@dataclass(frozen=True)
class PointFigures:
    """Figures of check points by component: east, north, plan (distances), height."""

    east: ErrorFigures
    north: ErrorFigures
    plan: ErrorFigures
    height: ErrorFigures


def point_figures(errors: np.ndarray) -> PointFigures:
    """Figures of errors (n, 3), m; those without a height count in plan only."""
    plan = np.hypot(errors[:, 0], errors[:, 1])
    return PointFigures(signed_figures(errors[:, 0]), signed_figures(errors[:, 1]),
                        _figures(plan, _plan_freedom(errors[:, :2])), signed_figures(errors[:, 2]))


def signed_figures(errors: np.ndarray) -> ErrorFigures:
    """Figures of errors (n,) along one axis, m; missing ones are left out."""
    known = errors[np.isfinite(errors)]
    return _figures(known, len(known))


def across_figures(normals: np.ndarray, errors: np.ndarray) -> ErrorFigures:
    """Figures in plan of errors (n,) across edges with unit normals (n, 2), m.

    The mean square in plan is that across edges of one direction and across those at right angles to it together; each
    edge counts by how much it says beside the others (its leverage), so that many edges of one direction do not hide
    those of the other. Where nearly all run one way the figure is NaN. The mean is of the signed errors (outward), the
    maximum of their sizes.
    """
    if not len(errors):
        return _figures(errors, 0)
    moment = normals.T @ normals
    if np.linalg.eigvalsh(moment)[0] < _LEAST_CROSSING * len(errors):
        return replace(_figures(errors, len(errors)), rmse=np.nan, bound=np.nan)
    leverage = np.einsum("ij,jk,ik->i", normals, np.linalg.inv(moment), normals)
    rmse = float(np.sqrt(leverage @ errors ** 2))
    freedom = float(leverage.sum() ** 2 / (leverage @ leverage))  # n where all edges say as much
    return replace(_figures(errors, len(errors)), rmse=rmse, bound=rmse * _bound_factor(freedom))


def _plan_freedom(errors: np.ndarray) -> float:
    """Degrees of freedom of the mean square in plan of errors (n, 2): 2 n where they are alike in all directions.

    Where one direction holds most of the error it says little more than n errors along a line. Effective number after
    F. E. Satterthwaite, An approximate distribution of estimates of variance components (1946).
    """
    moment = errors.T @ errors
    size = float(np.sum(moment ** 2))
    return len(errors) * float(np.trace(moment)) ** 2 / size if size > 0.0 else 2.0 * len(errors)


def _figures(values: np.ndarray, freedom: float) -> ErrorFigures:
    if not len(values):
        return ErrorFigures(0, *[np.nan] * 5)
    rmse = float(np.sqrt(np.mean(values ** 2)))
    std = float(values.std(ddof=1)) if len(values) > 1 else np.nan
    return ErrorFigures(len(values), float(values.mean()), rmse, std, float(np.abs(values).max()),
                        rmse * _bound_factor(freedom))


def _bound_factor(freedom: float) -> float:
    """Upper bound of a standard deviation as a multiple of the one found with so many degrees of freedom.

    The sum of squares over the variance is chi-square distributed, so that the variance is at most the sum over the
    chi-square's lower quantile.
    """
    from scipy.special import chdtri

    return float(np.sqrt(freedom / chdtri(freedom, CONFIDENCE)))
