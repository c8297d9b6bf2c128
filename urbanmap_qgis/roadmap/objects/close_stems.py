"""Stems that stand so close together that they pass for one: the post of a sign beside a trunk."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ...geometry.linked_groups import linked_groups
from .object_records import Stem


@dataclass(frozen=True)
class CloseStemsLimits:
    """Limits of close stems, each with its unit."""

    cell: float = 0.01  # m: points this close in plan are one place
    gap: float = 0.03  # m in plan between two stems, wider than points of one face lie apart
    around: float = 0.02  # m in plan about a point of a face
    stray: int = 4  # points there, itself among them; of fewer are noise and twigs, which would join the two
    least: float = 0.2  # m, extent in plan of two posts with a gap between them
    few: int = 20  # points of each
    least_part: float = 0.1  # of the points of the most, as a half hidden thin post has; less are stray returns
    share: float = 0.6  # of the height of them together, that each shows
    slab: float = 0.3  # m of height
    filled: float = 0.75  # share of its slabs in which each shows
    wide: float = 0.05  # m, extent in plan along and across of each: one face alone may be a side of the other


LIMITS = CloseStemsLimits()


def close_stems(stem: Stem, place: np.ndarray) -> list[Stem]:
    """The stems among the points of one, the thickest first; itself alone where there is no gap.

    Parameters
    ----------
    place : (n, 3) of its points: in plan and above the ground, m.
    """
    if np.ptp(place[:, :2], axis=0).max() < LIMITS.least or len(place) < 2 * LIMITS.few:
        return [stem]
    part = _parts(place[:, :2])
    counts = np.bincount(part[part >= 0], minlength=1)
    enough = np.flatnonzero(counts >= max(LIMITS.few, LIMITS.least_part * counts.max()))
    if len(enough) < 2:
        return [stem]
    own = [np.flatnonzero(part == number) for number in enough]
    own = sorted((rows for rows in own if _shows(place[rows], stem)),
                 key=lambda rows: -np.linalg.norm(np.ptp(place[rows, :2], axis=0)))
    posts = [Stem(stem.rows[rows], float(place[rows, 2].min()), float(place[rows, 2].max()), _filled(place[rows, 2]),
                  beside=number > 0) for number, rows in enumerate(own)]
    return posts if len(posts) > 1 else [stem]


def _parts(plan: np.ndarray) -> np.ndarray:
    """Number (n,) of the part of places in plan (n, 2), m, that no gap goes through; -1 of stray ones."""
    dense = cKDTree(plan).query(plan, k=[LIMITS.stray])[0][:, 0] < LIMITS.around
    number = np.full(len(plan), -1)
    cells, own = np.unique(np.floor(plan[dense] / LIMITS.cell).astype(np.int64), axis=0, return_inverse=True)
    if not len(cells):
        return number
    pairs = cKDTree(cells * LIMITS.cell).query_pairs(LIMITS.gap, output_type="ndarray")
    number[dense] = linked_groups(*pairs.T, len(cells))[1][own.ravel()]
    return number


def _filled(height: np.ndarray) -> float:
    """Share of the slabs of height between the lowest and the highest that hold points."""
    levels = np.unique(np.floor(height / LIMITS.slab))
    return float(len(levels) / (levels[-1] - levels[0] + 1))


def _shows(place: np.ndarray, whole: Stem) -> bool:
    """Whether a part shows over most of the height, from more than one side."""
    centred = place[:, :2] - place[:, :2].mean(axis=0)
    across = centred @ np.linalg.eigh(np.cov(centred.T))[1]
    low, high = np.percentile(across, [2, 98], axis=0)
    return bool(np.ptp(place[:, 2]) > LIMITS.share * (whole.high - whole.low)
                and _filled(place[:, 2]) >= LIMITS.filled and (high - low).min() > LIMITS.wide)
