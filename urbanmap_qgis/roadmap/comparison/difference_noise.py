"""How well the difference between two maps is known: from what they state, or from what did not change."""

from __future__ import annotations

import numpy as np

from .comparison_records import MapNoise

SIGMAS = 3.0
"""A shift counts above so many sigma."""

FLOOR = 0.001
"""Files round coordinates: no sigma is estimated below this, m."""

EFFICIENCY = 0.87
"""The biweight scale knows the spread as well as the standard deviation of this share of the values does."""

TUNING = 9.0
"""Differences of more than so many times their median size count nothing in the biweight scale."""

BOTH = np.sqrt(11.829) / SIGMAS
"""Of two directions together chance exceeds so much more than `SIGMAS` of one as seldom (chi square)."""

FEWEST = 5
"""From fewer differences no sigma is estimated."""


def estimated_noise(differences: np.ndarray, old: np.ndarray, new: np.ndarray, extra: np.ndarray,
                    given: tuple[float, float], independent: float) -> MapNoise | None:
    """Noise of differences between matched elements, most of which did not change.

    Parameters
    ----------
    differences : (n,) m, without the offset between the maps.
    old, new : (n,) stated sigma of both elements, m; NaN where there is none.
    extra : (n,) m, of what else is known to make differences.
    given : sigma of elements that state none, old and new, m; NaN to estimate it.
    independent : how many of the differences are independent of each other.

    Returns
    -------
    None where it must be estimated from too few.
    """
    unstated = ~np.isfinite(old), ~np.isfinite(new)
    old, new = (np.where(lacking, value, stated) for lacking, value, stated in zip(unstated, given, (old, new)))
    lacking = ~np.isfinite(old), ~np.isfinite(new)
    sigma = np.sqrt(old ** 2 + new ** 2 + extra ** 2)
    if not (lacking[0].any() or lacking[1].any()):
        enough = independent >= FEWEST
        factor = max(1.0, robust_scale(differences / sigma)) if enough else 1.0
        is_unstated = any(one.any() for one in unstated)
        return MapNoise(*given, factor, SIGMAS, len(differences), "given" if is_unstated else "stated")
    if independent < FEWEST:
        return None
    known = np.nan_to_num(old) ** 2 + np.nan_to_num(new) ** 2 + extra ** 2
    rest = robust_scale(differences) ** 2 - np.median(known)
    value = np.sqrt(max(rest, FLOOR ** 2) / (2.0 if lacking[0].any() and lacking[1].any() else 1.0))
    return MapNoise(value if lacking[0].any() else given[0], value if lacking[1].any() else given[1], 1.0,
                    limit_of(EFFICIENCY * (independent - 1.0)), len(differences), "estimated")


def robust_scale(differences: np.ndarray) -> float:
    """Standard deviation of differences (n,) about zero, by the biweight midvariance: what changed counts little."""
    size = max(float(np.median(np.abs(differences))), FLOOR / TUNING)
    square = (differences / (TUNING * size)) ** 2
    square = np.where(square < 1.0, square, 1.0)
    top = np.sum(differences ** 2 * (1.0 - square) ** 4)
    return float(np.sqrt(len(differences) * top) / abs(np.sum((1.0 - square) * (1.0 - 5.0 * square))))


def limit_of(freedom: float) -> float:
    """Sigmas that chance exceeds as seldom as `SIGMAS` of a known sigma, where sigma has so many degrees of freedom."""
    from scipy.stats import norm, t

    return float(t.isf(norm.sf(SIGMAS), max(freedom, 1.0)))


def difference_sigma(noise: MapNoise, old: np.ndarray, new: np.ndarray, extra: np.ndarray | float = 0.0) -> np.ndarray:
    """Sigma of differences, m, of the stated sigmas (NaN where there is none) of both elements."""
    old, new = (np.where(np.isfinite(stated), stated, value) for stated, value in ((old, noise.old), (new, noise.new)))
    return noise.factor * np.sqrt(old ** 2 + new ** 2 + np.square(extra))
