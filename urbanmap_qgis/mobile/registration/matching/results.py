"""Results of the patches: corrections in the trajectory's own angles, statuses, other positions that fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...trajectory import attitude_angles, rotations
from ..records import (
    AMBIGUOUS,
    MODES,
    NO_MARKINGS,
    NOT_CONVERGED,
    REGISTERED,
    WEAK,
    RegistrationSettings,
    WindowResults,
)
from ..start.correlation_start import CELL, BestPath, alternative_spread, peaks
from ..start.initial_shifts import InitialShifts, path_margins
from ..start.patches import Patches
from .ndt_match import rotation_matrix
from .windows import Windows


@dataclass(frozen=True)
class MatchingResultsLimits:
    """Limits of matching results, each with its unit."""

    min_points: int = 30
    min_overlap: float = 0.45  # below, most of the points contradict the place
    chance_overlap: float = 0.25  # below, it may be chance
    chance_sigma: float = 1.0  # m
    largest_sigma: float = 0.10  # m in plan
    proof: float = 3.0  # log-likelihood
    mode_distance: int = 3  # cells (0.6 m): positions nearer are one


LIMITS = MatchingResultsLimits()


@dataclass(frozen=True)
class AlternativePositions:
    """Other positions than the row's own.

    Attributes
    ----------
    alias_ratio, margin, own_scores : (n,).
    offsets : (n, MODES - 1, 2) m.
    scores : (n, MODES - 1).
    """

    alias_ratio: np.ndarray
    margin: np.ndarray
    offsets: np.ndarray
    scores: np.ndarray
    own_scores: np.ndarray


def alternative_positions(start: InitialShifts, windows: Windows, patches: int) -> AlternativePositions:
    """Second and third best positions of each window by its own points, and how surely any other is excluded."""
    running = np.concatenate([np.zeros((1, *start.scores.shape[1:])),
                              np.cumsum(start.scores, axis=0, dtype=np.float64)])
    middle = start.scores.shape[1] // 2
    ratio, peak = np.zeros(patches), np.zeros(patches)
    offsets, scores = np.full((patches, MODES - 1, 2), np.nan), np.full((patches, MODES - 1), np.nan)
    seen: dict[tuple[int, int], int] = {}
    for patch in range(patches):
        span = (windows.first[patch] // start.block, windows.last[patch] // start.block)
        if span in seen:
            same = seen[span]
            ratio[patch], peak[patch] = ratio[same], peak[same]
            offsets[patch], scores[patch] = offsets[same], scores[same]
            continue
        seen[span] = patch
        surface = (running[span[1] + 1] - running[span[0]]).astype(np.float32)
        peak[patch] = surface[middle - 1:middle + 2, middle - 1:middle + 2].max()
        alternatives, heights = peaks(surface, LIMITS.mode_distance, MODES - 1)
        offsets[patch, :len(alternatives)], scores[patch, :len(alternatives)] = alternatives * CELL, heights
        if len(heights) and peak[patch] > 0:
            ratio[patch] = heights[0] / peak[patch]
    margin = path_margins(start)[np.arange(patches) // start.block]
    return AlternativePositions(ratio, margin, offsets, scores, peak)


def assemble(patches: Patches, windows: Windows, start: InitialShifts, parts: Sequence, settings: RegistrationSettings
             ) -> WindowResults:
    """Rows of all patches from the sections' results (see `AdjustedSection`)."""
    def column(name: str) -> np.ndarray:
        return np.concatenate([getattr(part, name) for part in parts])

    translation, rotation, curve = column("translation"), column("rotation"), column("curve")
    to_angles = angle_rates(patches.angles)
    correction = np.column_stack([translation, angle_changes(patches.angles, rotation)])
    covariance = to_angles @ column("covariance") @ np.swapaxes(to_angles, 1, 2)
    floor = np.array([settings.reference_sigma, settings.reference_sigma, settings.reference_sigma_z])
    covariance[:, [0, 1, 2], [0, 1, 2]] += floor ** 2
    back = np.linalg.inv(to_angles)
    information = np.swapaxes(back, 1, 2) @ column("information") @ back
    gradient = np.einsum("nji,nj->ni", back, column("gradient"))
    linearised = np.column_stack([curve[:, :3], angle_changes(patches.angles, curve[:, 3:])])
    points, overlap = column("points"), column("overlap")
    covariance[:, [0, 1], [0, 1]] += _chance_variance(overlap)[:, None]
    alternatives = alternative_positions(start, windows, len(patches))
    spread = alternative_spread(BestPath(start.best, start.deficit), (LIMITS.mode_distance - 0.5) * CELL)[
        np.arange(len(patches)) // start.block]
    covariance[:, :2, :2] += spread
    status = _statuses(points, overlap, covariance, alternatives, column("converged"))
    if not settings.three_d:
        correction[:, 2:5] = covariance[:, 2:5] = covariance[:, :, 2:5] = np.nan
    lost = np.isin(status, (NO_MARKINGS, NOT_CONVERGED))
    correction[status == NO_MARKINGS] = np.nan
    covariance[lost] = np.nan
    return WindowResults(
        patches.time, patches.chainage, patches.place, patches.angles, correction, covariance, column("score"), overlap,
        windows.first, windows.last, (windows.last - windows.first + 1) * patches.length, windows.features, points,
        alternatives.alias_ratio, alternatives.margin, status, *_modes(correction, alternatives, status), linearised,
        information, gradient, settings.three_d, settings.search, spread=spread)


def _chance_variance(overlap: np.ndarray) -> np.ndarray:
    """(n,) m2, because a place that few points share, as of dashes that were all painted anew, may be chance."""
    lack = (LIMITS.min_overlap - np.nan_to_num(overlap)) / (LIMITS.min_overlap - LIMITS.chance_overlap)
    return (LIMITS.chance_sigma * np.clip(lack, 0.0, 1.0)) ** 2


def _modes(correction: np.ndarray, alternatives: AlternativePositions,
           status: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    position = correction[:, None, :2]
    modes = np.concatenate([position, position + alternatives.offsets], axis=1)
    scores = np.column_stack([alternatives.own_scores, alternatives.scores])
    scores[status == NO_MARKINGS] = np.nan
    return modes, scores


def _statuses(points: np.ndarray, overlap: np.ndarray, covariance: np.ndarray, alternatives: AlternativePositions,
              converged: np.ndarray) -> np.ndarray:
    status = np.full(len(points), REGISTERED, dtype=np.int8)
    with np.errstate(invalid="ignore"):
        largest = np.sqrt(np.linalg.eigvalsh(np.nan_to_num(covariance[:, :2, :2], nan=1e6))[:, -1])
        status[(largest > LIMITS.largest_sigma) | (overlap < LIMITS.min_overlap)] = WEAK
        status[alternatives.margin < LIMITS.proof] = AMBIGUOUS
        status[~converged] = NOT_CONVERGED
        status[(points < LIMITS.min_points) | ~(overlap > 0)] = NO_MARKINGS
    return status


def angle_changes(angles: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """(n, 3) degrees that turns (n, 3) (rotation vectors in the map's axes, radians) add to roll, pitch, heading."""
    change = attitude_angles(rotation_matrix(rotation) @ rotations(angles)) - angles
    return (change + 180.0) % 360.0 - 180.0


def angle_rates(angles: np.ndarray) -> np.ndarray:
    """(n, 6, 6) of shift (m) and turn (radians, map axes) to shift and roll, pitch, heading (degrees)."""
    step = 1e-6
    rates = np.broadcast_to(np.eye(6), (len(angles), 6, 6)).copy()
    for axis in range(3):
        rotation = np.zeros((len(angles), 3))
        rotation[:, axis] = step
        rates[:, 3:, 3 + axis] = (angle_changes(angles, rotation) - angle_changes(angles, -rotation)) / (2 * step)
    return rates
