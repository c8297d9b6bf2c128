"""Thin upright things among a tile's points: places that stay narrow in plan from slab to slab of height."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ...geometry.linked_groups import linked_groups
from .hanging_parts import linked_parts
from .object_records import Stem


@dataclass(frozen=True)
class StemLimits:
    """Limits of stems, each with its unit."""

    cell: float = 0.15  # m in plan: what is farther apart is not joined
    slab: float = 0.3  # m of height
    lowest: float = 0.3  # m above the ground; below it grass, kerbs and feet
    highest: float = 16.0  # m above the ground
    fewest: int = 3  # points of a slab
    step: float = 0.2  # m between the middles of slabs that follow
    skipped: int = 5  # slabs; a board or an arm may hide the stem in them
    slabs: int = 2  # in which a stem shows
    filled: float = 0.6  # share of its slabs in which it shows
    hidden: float = 2.2  # m; stems that begin higher hang on something


LIMITS = StemLimits()


def find_stems(points: np.ndarray, height: np.ndarray, widest: float, where: np.ndarray) -> list[Stem]:
    """Stems among a tile's points.

    Parameters
    ----------
    points : (n,) with fields x, y, m.
    height : (n,) above the ground, m.
    widest : m, extent in plan of a stem's visible part.
    where : (n,) mask of points that are looked at.
    """
    band = np.flatnonzero(where & (height > LIMITS.lowest) & (height < LIMITS.highest))
    if len(band) < LIMITS.fewest * LIMITS.slabs:
        return []
    plan = np.column_stack([points["x"][band], points["y"][band]])
    slab = ((height[band] - LIMITS.lowest) / LIMITS.slab).astype(np.int64)
    # Slabs two cells apart do not hang together.
    part = linked_parts(np.column_stack([plan, (2.0 * slab + 0.5) * LIMITS.cell]), LIMITS.cell)
    order = np.argsort(part, kind="stable")
    starts = np.flatnonzero(np.diff(part[order], prepend=-1))
    count = np.diff(np.append(starts, len(order)))
    low, high = (extreme.reduceat(plan[order], starts) for extreme in (np.minimum, np.maximum))
    thin = np.flatnonzero((count >= LIMITS.fewest) & ((high - low).max(axis=1) <= widest))
    if len(thin) < LIMITS.slabs:
        return []
    middle, level = (low[thin] + high[thin]) / 2.0, slab[order][starts[thin]]
    chain = _chains(middle, level)
    stems = []
    for rows in _groups(chain):
        levels, filled = _filled_levels(np.unique(level[rows]))
        if len(levels) < LIMITS.slabs or LIMITS.lowest + LIMITS.slab * levels[0] > LIMITS.hidden:
            continue
        rows = rows[level[rows] <= levels[-1]]
        members = np.concatenate([band[order[starts[k]:starts[k] + count[k]]] for k in thin[rows]])
        stems.append(Stem(members, float(height[members].min()), float(height[members].max()), float(filled)))
    return stems


def _filled_levels(levels: np.ndarray) -> tuple[np.ndarray, float]:
    """The lowest of a chain's slabs (n,), up to where it shows in enough of them, and the share in which it does.

    A car's scanner sends its upper beams far apart: a post that they meet here and there is not cut off as a whole.
    """
    share = np.arange(1, len(levels) + 1) / (levels - levels[0] + 1)
    last = int(np.flatnonzero(share >= LIMITS.filled)[-1])
    return levels[:last + 1], float(share[last])


def _chains(middle: np.ndarray, level: np.ndarray) -> np.ndarray:
    """Number (n,) of the chain of thin parts that stand over each other."""
    pairs = cKDTree(middle).query_pairs(LIMITS.step, output_type="ndarray")
    rise = np.abs(level[pairs[:, 0]] - level[pairs[:, 1]])
    pairs = pairs[(rise >= 1) & (rise <= LIMITS.skipped)]
    return linked_groups(*pairs.T, len(level))[1]


def _groups(number: np.ndarray) -> list[np.ndarray]:
    """Rows of each number."""
    order = np.argsort(number, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(number[order])) + 1)
