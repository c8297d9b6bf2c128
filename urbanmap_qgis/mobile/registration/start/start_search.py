"""The search for where the windows start from: the best path through the scores of all shifts (J 4.2)."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ....errors import InsufficientDataError
from ....execution import in_order
from ....progress import Progress
from ....wording import say
from ..records import RegistrationSettings
from .correlation_start import CELL, OBSERVATION_AREA, best_path, centred, score_image, shift_scores
from .fast_drift import fast_drift_rate
from .initial_shifts import InitialShifts, path_margins
from .patch_points import PatchPoints
from .patches import Patches
from .reference import Reference

BLOCK = 5
"""Patches of a block, whose scores of shifts are found together."""

_BLOCKS_AT_ONCE = 80  # of one piece of work


@dataclass(frozen=True)
class StartSearchLimits:
    """Limits of the search, each with its unit."""

    drift: float = 0.05  # m in the root of a metre: random walk of the error that the start allows
    standing_drift: float = 0.15  # m in the root of a second that the vehicle stands
    wider: float = 2.0  # times the search, where the first one leaves doubt
    # m from the edge of the search; share of blocks that may lie there
    border: float = 0.4
    border_share: float = 0.02
    # log-likelihood by which a block's place beats others; share of such blocks
    proof: float = 3.0
    sure_share: float = 0.5
    gain: float = 1.08  # times the narrow search's score: right places had 1.12 or more, wrong ones 1.02 (four cities)


LIMITS = StartSearchLimits()

_PRIOR_SIGMA = 2.5  # m


@dataclass(frozen=True)
class _Blocks:
    """Some blocks of the path with their points: what one piece of work of the start gets."""

    first: int
    count: int
    points: PatchPoints


def search_start(points: PatchPoints, patches: Patches, reference: Reference, settings: RegistrationSettings,
                 progress: Progress, executor: Executor | None) -> tuple[InitialShifts, float]:
    """Shifts of all blocks, and how far they were looked for, m: farther where the first search leaves doubt."""
    found = _correlated(points, patches, reference, settings, progress.part(0.0, 0.4), executor)
    if not settings.start or not (at_border(found, settings.search) or _sure_share(found) < LIMITS.sure_share):
        return found, settings.search
    search = LIMITS.wider * settings.search
    wide = _correlated(points, patches, reference, replace(settings, search=search), progress.part(0.4, 1.0), executor)
    same = np.median(np.abs(wide.best - found.best).max(axis=1)) * CELL < LIMITS.border
    better = same or wide.score > LIMITS.gain * found.score
    if better and not at_border(wide, search) and _sure_share(wide) >= max(LIMITS.sure_share, _sure_share(found)):
        return wide, search
    return found, settings.search


def at_border(start: InitialShifts, search: float) -> bool:
    """Whether the best path runs along the edge of what was searched."""
    return float((np.abs(start.best * CELL) > search - LIMITS.border).any(axis=1).mean()) > LIMITS.border_share


def _sure_share(start: InitialShifts) -> float:
    """Share of the blocks with markings whose place beats all others."""
    with_markings = start.scores.any(axis=(1, 2))
    return float((path_margins(start)[with_markings] >= LIMITS.proof).mean()) if with_markings.any() else 0.0


def _correlated(points: PatchPoints, patches: Patches, reference: Reference, settings: RegistrationSettings,
                progress: Progress, executor: Executor | None) -> InitialShifts:
    """Shifts of all blocks by correlation (or none, with what fits there all the same)."""
    blocks = -(-len(patches) // BLOCK)
    step = _BLOCKS_AT_ONCE
    pieces = [_Blocks(first, min(step, blocks - first), points.of_patches(first * BLOCK, (first + step) * BLOCK - 1))
              for first in range(0, blocks, step)]
    scores, markings = [], 0
    work = partial(_block_scores, reference=reference, settings=settings)
    for score, near in in_order(work, pieces, executor, progress.check):
        scores.append(score)
        markings += near
        progress.step(len(scores) / len(pieces))
    if not markings:
        raise InsufficientDataError(say("There is no reference marking near the survey: check the CRS of both and "
                                        "that the reference covers the drive."))
    scores = np.concatenate(scores)
    variances = _step_variances(patches)
    path = best_path(scores, variances, _PRIOR_SIGMA)
    middle = patches.chainage[_block_middles(patches)]
    fast = fast_drift_rate(middle, path.shift * CELL)
    if fast.any():  # once more, with the step let loose where the first way has one
        loose = np.maximum(fast[1:], fast[:-1]) * np.diff(middle)
        path = best_path(scores, np.maximum(variances, loose**2), _PRIOR_SIGMA)
    shift = path.shift if settings.start else np.zeros_like(path.shift)
    about = centred(scores, path.shift)
    middle = scores.shape[1] // 2
    return InitialShifts(BLOCK, shift * CELL, about, path.deficit, path.shift, float(about[:, middle, middle].sum()))


def _step_variances(patches: Patches) -> np.ndarray:
    """(b - 1,) m2, variance of the error's change from each block to the next."""
    middle = _block_middles(patches)
    driven, stood = np.diff(patches.chainage[middle]), np.diff(patches.stop_time[middle])
    return LIMITS.drift ** 2 * driven + LIMITS.standing_drift ** 2 * stood


def _block_middles(patches: Patches) -> np.ndarray:
    """(b,) numbers of the patches in the middle of the blocks."""
    return np.minimum(np.arange(0, len(patches), BLOCK) + BLOCK // 2, len(patches) - 1)


def _block_scores(piece: _Blocks, reference: Reference, settings: RegistrationSettings) -> tuple[np.ndarray, int]:
    """Scores of all shifts of each block (b, s, s), and how many reference cells are markings."""
    max_shift = int(np.ceil(settings.search / CELL))
    size = 2 * max_shift + 1
    scores = np.zeros((piece.count, size, size), dtype=np.float32)
    if not len(piece.points):
        return scores, 0
    x, y = piece.points.place[:, 0], piece.points.place[:, 1]
    around = settings.search + 2.0
    coverage = reference.coverage(x.min() - around, y.min() - around, x.max() + around, y.max() + around)
    image = score_image(coverage, settings.background)
    point_weight = piece.points.weight * settings.subsampling ** 2 / OBSERVATION_AREA
    start = np.searchsorted(piece.points.patch // BLOCK, piece.first + np.arange(piece.count + 1))
    for number in range(piece.count):
        part = slice(start[number], start[number + 1])
        if part.stop > part.start:
            scores[number] = shift_scores(x[part], y[part], point_weight[part], image, max_shift)
    return scores, int((coverage.share > 0).sum())
