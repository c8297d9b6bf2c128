"""Boards of few points at thin posts among leaves: the window beside a post that holds most more than its sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .crown_boards import LIMITS as FACES
from .crown_boards import plane_beside_post
from .object_records import StemAxis


@dataclass(frozen=True)
class ThinBoardsLimits:
    """Limits of boards of few points, each with its unit."""

    turn: float = 6.0  # degrees from one direction that is tried to the next
    layer: float = 0.02  # m, of what is counted across a face; three are a face
    beside: tuple[int, int] = (4, 8)  # layers before and behind the middle of a face, where leaves would go on
    off: float = 0.12  # m from the axis to the middle of a face
    cell: float = 0.05  # m, along and up a face
    half: tuple[float, float] = (0.3, 0.5)  # m from the axis to either edge
    tall: tuple[float, float] = (0.4, 1.0)  # m
    highest: float = 4.0  # m over the lowest of what hangs there, for its upper edge
    few: int = 15  # points of a face beside its post
    quarter: float = 0.05  # of these, at least, in each quarter of it: forks of branches fill some only
    thick: float = 0.14  # m, diameter over which a stem among leaves may be a young tree
    edge_on: float = 4.0  # degrees; where it is seen flatter than so, a scanner's own plane passes for a face
    clear: float = 25.0  # log likelihood ratio of as many points, to what is counted before or behind
    denser: float = 10.0  # than what lies before or behind it
    frame: tuple[float, float] = (0.08, 0.38)  # m outside its edges, where a board does not go on as a wall does
    thinner: float = 0.5  # points there, of those for the same area of the board


LIMITS = ThinBoardsLimits()


def face_of_few(place: np.ndarray, axis: StemAxis, seen_from: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Rows of the points of a board that reaches as far to either side of its post, and its unit normal (3,); None
    where no window is clearly fuller than what lies before and behind it (a Poisson scan statistic: Kulldorff, 1997).

    Parameters
    ----------
    place : (n, 3) what hangs about the post, m.
    seen_from : (2,) where the survey passed, m.
    """
    offset = place[:, :2] - axis.plan_at(place[:, 2])
    near = np.flatnonzero((np.hypot(*offset.T) < FACES.reach)
                          & (place[:, 2] < place[:, 2].min(initial=np.inf) + LIMITS.highest))
    if axis.diameter > LIMITS.thick or len(near) < LIMITS.few:
        return None
    view = seen_from - axis.middle[:2]
    angle = np.radians(np.arange(0.0, 180.0, LIMITS.turn))
    across = np.column_stack([np.cos(angle), np.sin(angle)])
    least = np.sin(np.radians(LIMITS.edge_on)) * np.hypot(*view)
    across = across[np.abs(across @ view) > least]
    best = max((_fullest_window(offset[near], place[near, 2], normal) for normal in across),
               key=lambda window: window.ratio)
    if best.ratio < LIMITS.clear:
        return None
    beyond = best.beyond(offset[near], place[near, 2])
    rows = near[(beyond <= 0.0).all(axis=1) & (np.abs(offset[near] @ best.normal - best.off) < FACES.thin)]
    for _ in range(3):
        middle, normal = plane_beside_post(place[rows], offset[rows])
        away = (place[near] - middle) @ normal
        rows = near[(beyond <= 0.0).all(axis=1) & (np.abs(away) < FACES.thin)]
        if len(rows) < LIMITS.few:
            return None
    flat = np.std((place[rows] - middle) @ normal) < FACES.flat and abs(view @ normal[:2]) > least
    return (rows, normal) if flat and best.ends(offset[near], beyond, np.abs(away) < FACES.thin) else None


@dataclass(frozen=True)
class _Window:
    """A window that reaches `half` (m) to either side of a post, from `low` to `high` (m), `off` (m) from it across its
    `normal` (2,); `ratio`: log likelihood of what it holds."""

    ratio: float
    normal: np.ndarray
    off: float = 0.0
    half: float = 0.0
    low: float = 0.0
    high: float = 0.0

    def beyond(self, offset: np.ndarray, up: np.ndarray) -> np.ndarray:
        """How far (n, 3) places lie outside its sides, its foot and its top, m; 0 or less within these."""
        along = np.abs(offset @ [-self.normal[1], self.normal[0]])
        return np.column_stack([along - self.half, self.low - up, up - self.high])

    def ends(self, offset: np.ndarray, beyond: np.ndarray, on: np.ndarray) -> bool:
        """Whether what lies `on` its plane (n,) ends at each of its edges, as no wall does."""
        along = offset @ [-self.normal[1], self.normal[0]]
        on = on & (np.abs(along) > FACES.post)
        tall, wide = self.high - self.low, 2.0 * (self.half - FACES.post)
        within = beyond <= 0.0
        level = within[:, 1:].all(axis=1)
        strips = [(level & (along > 0), 0, tall), (level & (along < 0), 0, tall),
                  (within[:, [0, 2]].all(axis=1), 1, wide), (within[:, :2].all(axis=1), 2, wide)]
        near, far = LIMITS.frame
        most = LIMITS.thinner * np.count_nonzero(on & within.all(axis=1)) / (tall * wide) * (far - near)
        return all(np.count_nonzero(on & beside & (beyond[:, edge] > near) & (beyond[:, edge] < far)) < most * side
                   for beside, edge, side in strips)


def _fullest_window(offset: np.ndarray, up: np.ndarray, normal: np.ndarray) -> _Window:
    """The window across a direction that is fullest for what lies before and behind it.

    Parameters
    ----------
    offset : (n, 2) from the axis, m.
    up : (n,) heights, m.
    normal : (2,) unit vector.
    """
    away, along = offset @ normal, offset @ [-normal[1], normal[0]]
    low = up.min()
    level = ((up - low) / LIMITS.cell).astype(np.int64)
    least, most = LIMITS.beside
    middles = round(LIMITS.off / LIMITS.layer)
    layer = np.floor(away / LIMITS.layer + 0.5).astype(np.int64) + middles + most
    layers, widest, levels = 2 * (middles + most) + 1, round(LIMITS.half[1] / LIMITS.cell), int(level.max()) + 1
    column = (np.abs(along) / LIMITS.cell).astype(np.int64)
    kept = (layer >= 0) & (layer < layers) & (column < widest) & (np.abs(along) > FACES.post)
    shape = (2, layers, widest, levels)
    flat = np.ravel_multi_index(((along > 0)[kept].astype(np.int64), layer[kept], column[kept], level[kept]), shape)
    count = np.bincount(flat, minlength=int(np.prod(shape))).astype(np.int32).reshape(shape)
    for edge in (1, 2, 3):
        count = np.cumsum(count, axis=edge, dtype=np.int32)
    count = np.pad(count, ((0, 0), (1, 0), (0, 0), (1, 0)))[:, :, round(LIMITS.half[0] / LIMITS.cell) - 1:]
    first = np.arange(most, most + 2 * middles + 1)
    best = _Window(0.0, normal)
    for tall in range(round(LIMITS.tall[0] / LIMITS.cell), min(round(LIMITS.tall[1] / LIMITS.cell), levels) + 1, 2):
        window = count[..., tall:] - count[..., :-tall]
        lower = (count[..., tall // 2:] - count[..., :-(tall // 2)])[..., :window.shape[-1]]
        quarters = np.concatenate([part[:, first + 2] - part[:, first - 1] for part in (lower, window - lower)])
        on = quarters.sum(axis=0)
        about = np.maximum(*(window[:, first + end].sum(axis=0) - window[:, first + start].sum(axis=0)
                             for start, end in ((-most, 1 - least), (least, most + 1))))
        expected = about * 3.0 / (most - least + 1) + 0.5
        fit = (on >= LIMITS.few) & (on >= LIMITS.denser * expected) & (quarters.min(axis=0) >= LIMITS.quarter * on)
        if not fit.any():
            continue
        ratio = np.where(fit, on * np.log(np.maximum(on, 1) / expected) - (on - expected), 0.0)
        k = np.unravel_index(np.argmax(ratio), ratio.shape)
        if ratio[k] > best.ratio:
            foot = low + int(k[2]) * LIMITS.cell
            best = _Window(float(ratio[k]), normal, (int(k[0]) - middles) * LIMITS.layer,
                           LIMITS.half[0] + int(k[1]) * LIMITS.cell, foot, foot + tall * LIMITS.cell)
    return best
