"""What is known of the place around each patch, and the status that this gives it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....estimation.normal_equations import NormalEquations
from ....wording import say
from ..records import WindowResults
from .settings import CorrectionSettings

REGISTERED, BRIDGED, DISTRUSTED = range(3)
STATUS_NAMES = ("registered", "bridged", "not to be trusted")
"""registered: found from markings around the patch. bridged: between or beyond registered patches, by the model of the
drift. not to be trusted: too far from them, or contradictory or ambiguous markings."""


@dataclass(frozen=True)
class PatchStatusLimits:
    """Limits of patch status, each with its unit."""

    rejected: float = 0.2  # weight below which a piece's own evidence counts as contradicted


LIMITS = PatchStatusLimits()

MOST_SPAN = 8.0
"""m without evidence: between markings farther apart a step of the error may hide."""

LEAST_MET = 0.2
"""Share of the points around that lie on reference markings: less is near what chance gives."""


def patch_statuses(window_sigma: np.ndarray, weight: np.ndarray, sigma: np.ndarray, doubtful: np.ndarray,
                   registered: float, trusted: float) -> tuple[np.ndarray, np.ndarray]:
    """Status (n,) and its reason (n,) of each patch.

    Parameters
    ----------
    own : (n,) standard deviation in plan that the markings around the patch give alone, m.
    weight : (n,) of the patch's own evidence, 0 to 1.
    sigma : (n,) of the correction in plan, m.
    doubtful : (n,) mask of patches for which another place fits as well.
    registered, trusted : sigma in plan that a registered patch, and one that is to be trusted, has at most, m.
    """
    n = len(window_sigma)
    reason = np.full(n, "", dtype=object)
    status = np.where((window_sigma <= registered) & (sigma <= registered), REGISTERED, BRIDGED).astype(np.int8)
    reason[sigma > registered] = say("the markings do not fix the position well")
    reason[window_sigma > registered] = say("the markings around do not fix the position in all directions")
    reason[~np.isfinite(window_sigma)] = say("no markings registered around the patch")
    rejected = weight <= LIMITS.rejected
    status[rejected], reason[rejected] = BRIDGED, say("the markings here contradict those around")
    status[doubtful], reason[doubtful] = BRIDGED, say("another position of the markings fits as well")
    status[sigma > trusted] = DISTRUSTED
    if not (np.isfinite(window_sigma) & ~doubtful).any():
        status[:] = DISTRUSTED
    return status, reason


def only_own_mode_fits(windows: WindowResults, value: np.ndarray, covariance: np.ndarray,
                        settings: CorrectionSettings) -> np.ndarray:
    """Mask (n,) of patches of doubt whose own position lies where all sure ones say, and no other one does."""
    inverse = np.linalg.inv(covariance[:, :2, :2] + np.eye(2) * settings.reference_sigma**2)

    def away(place):
        off = place - value[:, :2]
        return np.einsum("ni,nij,nj->n", off, inverse, off)

    others = [away(windows.modes[:, k]) for k in range(1, windows.modes.shape[1])]
    nearest = np.min([np.where(np.isfinite(item), item, np.inf) for item in others], axis=0)
    own_distance = away(windows.correction[:, :2])
    return (own_distance < 9.0) & (nearest - own_distance > 2 * 3.0 * settings.min_margin)


def evidence_spans(normals: NormalEquations, weight: np.ndarray, path_parameter: np.ndarray) -> np.ndarray:
    """(n,) m from the last piece of evidence before each path parameter to the next after it; infinite at an end."""
    evidence = normals.path_parameter[normals.present & (weight > LIMITS.rejected)]
    half = 0.5 * float(np.median(np.diff(normals.path_parameter))) if len(normals.path_parameter) > 1 else 0.0
    ends = np.concatenate([[-np.inf], evidence, [np.inf]])
    before = ends[np.searchsorted(evidence, path_parameter + half, side="right")]
    after = ends[np.searchsorted(evidence, path_parameter - half, side="left") + 1]
    return np.maximum(after - before, 0.0)


def evidence_gaps(normals: NormalEquations) -> list[tuple[float, float]]:
    """Path parameters between which no markings are, for more than `MOST_SPAN` m."""
    seen = normals.path_parameter[normals.present]
    return [(float(begin), float(end)) for begin, end in zip(seen[:-1], seen[1:]) if end - begin > MOST_SPAN]


def own_information(normals: NormalEquations, weight: np.ndarray, path_parameter: np.ndarray,
                    extent: float | np.ndarray) -> np.ndarray:
    """(n, 2, 2) what the observations within `extent` m of path parameters (n,) know of the place in plan."""
    running = np.concatenate([np.zeros((1, 2, 2)),
                              np.cumsum(normals.information[:, :2, :2] * weight[:, None, None], axis=0)])
    low, high = (np.searchsorted(normals.path_parameter, path_parameter + side) for side in (-extent, extent))
    return running[high] - running[low]


def plan_sigma_of(information: np.ndarray) -> np.ndarray:
    """(n,) m, worst standard deviation in plan by information (n, 2, 2); infinite where a direction has none."""
    least = np.linalg.eigvalsh(information)[:, 0]
    return np.where(least > 1e-3, 1.0 / np.sqrt(np.maximum(least, 1e-3)), np.inf)


def plan_sigma(covariance: np.ndarray) -> np.ndarray:
    """(n,) root of the larger eigenvalue of the covariances in plan."""
    a, b, c = covariance[:, 0, 0], covariance[:, 0, 1], covariance[:, 1, 1]
    return np.sqrt(0.5 * (a + c) + np.sqrt(0.25 * (a - c) ** 2 + b**2))
