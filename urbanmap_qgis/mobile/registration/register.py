"""Registration of a survey's marking points to the aerial reference, window by window (J 3.2.4 and chapter 4).

Three steps: the best path through the scores of all shifts gives the start; on sections of a few hundred metres the
correction's course is adjusted, first to normal distributions (NDT) from coarse to fine, then to the sub-pixel
coverage; last, each patch's window is adjusted as a rigid body about that curve and says how well it is determined.
"""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...errors import InputError, InsufficientDataError
from ...execution import in_order
from ...progress import SILENT, Progress
from ...wording import say
from ..markings.records import MarkingPoints
from ..trajectory import Trajectory
from .matching.path_section import PathSection, adjust_section
from .matching.results import InitialShifts, assemble, path_margins
from .matching.rigid_windows import register_rigid_windows
from .matching.windows import Windows, choose_windows
from .records import RegistrationSettings, WindowResults
from .start.correlation_start import CELL, OBSERVATION_AREA, best_path, centred, score_image, shift_scores
from .start.fast_drift import fast_drift_rate
from .start.patch_points import PatchPoints, thin_points
from .start.patches import Patches, divide_path
from .start.reference import Reference

BLOCK = 5
"""Patches of a block, whose scores of shifts are found together."""

_SECTION_PATCHES = 400  # patches of a section's core


@dataclass(frozen=True)
class RegistrationRegisterLimits:
    """Limits of registration register, each with its unit."""

    around: int = 10  # patches more than its windows need
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


LIMITS = RegistrationRegisterLimits()

_PRIOR_SIGMA = 2.5  # m


def register_windows(markings: MarkingPoints, trajectory: Trajectory, reference: Reference,
                     settings: RegistrationSettings | None = None, progress: Progress = SILENT,
                     executor: Executor | None = None) -> WindowResults:
    """Correction of every patch of a survey.

    Parameters
    ----------
    markings : points on paint, in the reference's CRS (m); what was measured outside the trajectory is left out.
    trajectory : the reported one.
    reference : markings, and heights where `settings.three_d`.
    executor : sections are worked on by it; results do not depend on it.

    Raises
    ------
    InputError : the reference has no heights in 3D, or heights belong to another datum.
    InsufficientDataError : no marking point lies within the trajectory's time, or no reference marking near the path.
    """
    settings = settings or RegistrationSettings()
    if settings.three_d and not reference.has_heights:
        raise InputError(say("A registration in 3D needs the ground's heights: give a ground raster or marking "
                             "polygons with z."))
    patches = divide_path(trajectory, settings.patch_length)
    usable = trajectory.within(markings.time) & np.isfinite(markings.x + markings.y + markings.z)
    if not usable.any():
        raise InsufficientDataError(say("No marking point was measured within the trajectory's time: check that both "
                                        "are of one survey."))
    markings = markings.select(usable)
    windows = choose_windows(markings.x, markings.y, patches.number_at(markings.time), len(patches), settings)
    points = thin_points(markings, trajectory, patches, settings.subsampling)
    progress.step(0.1)
    start, search = _start(points, patches, reference, settings, progress.part(0.1, 0.4), executor)
    settings = replace(settings, search=search)
    progress.step(0.4)
    if not settings.shared_windows:
        return register_rigid_windows(markings, patches, windows, start, reference, settings, progress.part(0.4, 1.0))
    sections = list(_sections(points, patches, windows, start))
    work = partial(adjust_section, reference=reference, settings=settings)
    adjusted = []
    for result in in_order(work, sections, executor, progress.check):
        adjusted.append(result)
        progress.step(0.4 + 0.6 * len(adjusted) / len(sections))
    return replace(assemble(patches, windows, start, adjusted, settings),
                   beyond=settings.start and _at_border(start, search))


@dataclass(frozen=True)
class _Blocks:
    """Some blocks of the path with their points: what one piece of work of the start gets."""

    first: int
    count: int
    points: PatchPoints


def _start(points: PatchPoints, patches: Patches, reference: Reference, settings: RegistrationSettings,
           progress: Progress, executor: Executor | None) -> tuple[InitialShifts, float]:
    """Shifts of all blocks, and how far they were looked for, m: farther where the first search leaves doubt."""
    found = _correlated(points, patches, reference, settings, progress.part(0.0, 0.4), executor)
    if not settings.start or not (_at_border(found, settings.search) or _sure_share(found) < LIMITS.sure_share):
        return found, settings.search
    search = LIMITS.wider * settings.search
    wide = _correlated(points, patches, reference, replace(settings, search=search), progress.part(0.4, 1.0), executor)
    same = np.median(np.abs(wide.best - found.best).max(axis=1)) * CELL < LIMITS.border
    better = same or wide.score > LIMITS.gain * found.score
    if better and not _at_border(wide, search) and _sure_share(wide) >= max(LIMITS.sure_share, _sure_share(found)):
        return wide, search
    return found, settings.search


def _at_border(start: InitialShifts, search: float) -> bool:
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
    step = max(_SECTION_PATCHES // BLOCK, 1)
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


def _sections(points: PatchPoints, patches: Patches, windows: Windows, start: InitialShifts):
    """Pieces of the path with the points of all windows in them."""
    fast = fast_drift_rate(patches.chainage, start.shift_at(np.arange(len(patches))))
    for core_first in range(0, len(patches), _SECTION_PATCHES):
        core_last = min(core_first + _SECTION_PATCHES, len(patches)) - 1
        core = slice(core_first, core_last + 1)
        first = max(int(windows.first[core].min()) - LIMITS.around, 0)
        last = min(int(windows.last[core].max()) + LIMITS.around, len(patches) - 1)
        rows = np.arange(first, last + 1)
        yield PathSection(first, core_first - first, core_last - first, patches.chainage[rows], patches.stop_time[rows],
                      patches.place[rows],
                      start.shift_at(rows), fast[rows], windows.first[core] - first, windows.last[core] - first,
                      points.of_patches(first, last))
