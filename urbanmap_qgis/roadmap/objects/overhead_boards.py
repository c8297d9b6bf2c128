"""Boards over a road on the beam of a gantry or a long arm: faces far from the post, in line with it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class OverheadBoardsLimits:
    """Limits of overhead boards, each with its unit."""

    low: float = 4.5  # m above the ground; lower ones would be in the way of vehicles
    away: float = 0.6  # m from the axis of the post, from which beams and boards are looked at
    column: float = 0.2  # m along the beam
    tall: float = 0.7  # m that a board is high; beams and heads of signals are lower
    few: int = 30  # points of a board
    beside: float = 0.4  # m off the line from the post, within which beam and boards lie
    off: float = 0.2  # share of what hangs there that may lie farther off
    thin: float = 0.04  # m to either side of its plane, that a board's points lie in
    ends: float = 5.4  # m from the axis, that the board ends before; what goes on is no board
    area: float = 1.0  # m2, smallest board
    along: float = 0.9  # cosine of the angle between the beam and a board, at least


LIMITS = OverheadBoardsLimits()


def overhead_face(offset: np.ndarray, up: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Rows of the points of a board over the road, and its unit normal (3,); None without one.

    Parameters
    ----------
    offset : (n, 2) from the axis of the post, of what hangs on that, m.
    up : (n,) above the ground, m.
    """
    out = np.flatnonzero((up > LIMITS.low) & (np.hypot(*offset.T) > LIMITS.away))
    if len(out) < LIMITS.few:
        return None
    beam = np.median(offset[out], axis=0)
    beam /= max(np.hypot(*beam), LIMITS.thin)
    side = np.array([-beam[1], beam[0]])
    along, across = offset[out] @ beam, offset[out] @ side
    inline = (along > 0.0) & (np.abs(across) < LIMITS.beside)
    if np.mean(~inline) > LIMITS.off:
        return None
    rows = out[inline][_tall_columns(along[inline], up[out[inline]])]
    if len(rows) < LIMITS.few or (offset[rows] @ beam).max() > LIMITS.ends:
        return None
    return _plane(np.column_stack([offset[rows], up[rows]]), rows, side)


def _tall_columns(along: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Mask (n,) of points at places along the beam where something as high as a board hangs."""
    column = np.floor(along / LIMITS.column).astype(np.int64)
    low, high = np.full(column.max() + 1, np.inf), np.full(column.max() + 1, -np.inf)
    np.minimum.at(low, column, up)
    np.maximum.at(high, column, up)
    return (high - low)[column] > LIMITS.tall


def _plane(place: np.ndarray, rows: np.ndarray, side: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """The upright plane along the beam in which most of the points (n, 3) lie; `side` (2,) across the beam."""
    across = place[:, :2] @ side
    step = np.floor(across / LIMITS.thin).astype(np.int64)
    fullest = np.argmax(np.bincount(step - step.min())) + step.min()
    mine = np.abs(across - (fullest + 0.5) * LIMITS.thin) < 2.0 * LIMITS.thin
    for _ in range(3):
        if np.count_nonzero(mine) < LIMITS.few:
            return None
        middle = place[mine, :2].mean(axis=0)
        _, axes = np.linalg.eigh(np.cov(place[mine, :2].T))
        normal = axes[:, 0]
        mine = np.abs((place[:, :2] - middle) @ normal) < LIMITS.thin
    if np.count_nonzero(mine) < LIMITS.few or abs(normal @ side) < LIMITS.along:
        return None
    return rows[mine], np.array([*normal, 0.0])
