"""Standard deviations along and across, and error ellipses, of covariances in the plan."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class PlanEllipse:
    """Error ellipses (one sigma) of n places.

    Attributes
    ----------
    major, minor : (n,) semi-axes, m.
    bearing : (n,) of the major axis, degrees clockwise from north, 0 to 180.
    """

    major: np.ndarray
    minor: np.ndarray
    bearing: np.ndarray


def along_and_across(covariance: np.ndarray, heading: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n,) standard deviations, m, along and across headings (n,), radians, of covariances (n, 2+, 2+)."""
    plan = covariance[:, :2, :2]
    ahead = np.column_stack([np.sin(heading), np.cos(heading)])
    right = np.column_stack([np.cos(heading), -np.sin(heading)])
    return tuple(np.sqrt(np.einsum("ni,nij,nj->n", axis, plan, axis)) for axis in (ahead, right))


def plan_ellipses(covariance: np.ndarray) -> PlanEllipse:
    """Ellipses of covariances (n, 2+, 2+), m2; NaN where these are."""
    good = np.isfinite(covariance[:, :2, :2]).all(axis=(1, 2))
    axes, bearing = np.full((len(covariance), 2), np.nan), np.full(len(covariance), np.nan)
    values, vectors = np.linalg.eigh(covariance[good, :2, :2])
    axes[good] = np.sqrt(np.maximum(values, 0.0))
    bearing[good] = np.degrees(np.arctan2(vectors[:, 0, 1], vectors[:, 1, 1])) % 180.0
    return PlanEllipse(axes[:, 1], axes[:, 0], bearing)
