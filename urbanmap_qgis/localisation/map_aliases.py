"""Places that look alike: the score of what is seen against the map over all shifts (J 6.2, local similarity).

The log score of a shift d is S(d) = sum over the points seen of log(1 + coverage(point + d) / background). Compared
with the score in place it gives the odds of the shift, exp(-(S(0) - S(d)) evidence); local maxima apart from the place,
with a valley between, are other modes. Along a street without features the score is a ridge: that is no other mode but
a direction without evidence, which the covariance tells.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter, maximum_filter

STEP = 0.5
"""Cells and steps of the shifts, m."""

EVIDENCE_OF_CELL = 0.2
"""Share of an independent observation that a cell of the score, half a metre of wall or paint, counts for."""

_BACKGROUND = 0.05
_VALLEY = 0.6
_POINTS = 400


@dataclass(frozen=True)
class ScoreField:
    """What a point scores where it falls on the map.

    Attributes
    ----------
    left, bottom : of the first cell, m.
    score : (rows, columns) float32, rows northwards.
    """

    left: float
    bottom: float
    score: np.ndarray

    @classmethod
    def of(cls, points: np.ndarray, bounds: tuple[float, float, float, float], blur: float) -> ScoreField:
        """Score of a map whose features pass through points (m, 2), within bounds, blurred by `blur` m.

        Leave room for the shifts within the bounds.
        """
        left, bottom = np.floor(np.array(bounds[:2]) / STEP) * STEP
        columns, rows = (np.ceil((np.array(bounds[2:]) - [left, bottom]) / STEP).astype(int) + 1)
        cell = np.floor((points - [left, bottom]) / STEP).astype(np.int64)
        inside = ((cell >= 0) & (cell < [columns, rows])).all(axis=1)
        image = np.zeros((rows, columns), np.float32)
        image[cell[inside, 1], cell[inside, 0]] = 1.0
        image = gaussian_filter(image, blur / STEP)
        peak = 1.0 / (np.sqrt(2 * np.pi) * max(blur / STEP, 0.4))
        return cls(float(left), float(bottom), np.log1p(np.minimum(image / peak, 1.0) / _BACKGROUND).astype(np.float32))

    def shifted(self, points: np.ndarray, most: int) -> np.ndarray:
        """(2 most + 1, 2 most + 1) score of points (m, 2) over shifts in steps: rows north, columns east.

        A cell counts once however many points fall into it; points nearer to the bounds than the shifts count nothing.
        """
        cell = np.floor((points - [self.left, self.bottom]) / STEP).astype(np.int64)
        cell = _different_rows(cell)
        if len(cell) > _POINTS:
            cell = cell[np.linspace(0, len(cell) - 1, _POINTS).astype(int)]
        cell = cell - most
        views = np.lib.stride_tricks.sliding_window_view(self.score, (2 * most + 1, 2 * most + 1))
        inside = ((cell >= 0) & (cell < views.shape[1::-1])).all(axis=1)
        return views[cell[inside, 1], cell[inside, 0]].sum(axis=0, dtype=np.float64)


def _different_rows(cell: np.ndarray) -> np.ndarray:
    """Different rows of cells (m, 2) in the order of their first, then their second number."""
    if not len(cell):
        return cell
    low = cell.min(axis=0)
    height = int(cell[:, 1].max() - low[1]) + 1
    code = np.unique((cell[:, 0] - low[0]) * height + cell[:, 1] - low[1])
    return np.column_stack(np.divmod(code, height)) + low


@dataclass(frozen=True)
class AliasModes:
    """Other places where what is seen fits.

    Attributes
    ----------
    shift : (k, 2) m, east and north, the likeliest first.
    share : (k,) of the probability.
    """

    shift: np.ndarray
    share: np.ndarray


NO_ALIAS = AliasModes(np.zeros((0, 2)), np.zeros(0))
"""That of a place that looks like no other."""


def alias_modes(log_odds: np.ndarray, separation: float) -> AliasModes:
    """Modes of a surface of log odds over shifts, more than `separation` m from the middle, with a valley between.

    `log_odds` (s, s), rows north, columns east, steps of `STEP`.
    """
    size = len(log_odds)
    middle = size // 2
    odds = np.exp(log_odds - log_odds.max())
    top = (odds >= maximum_filter(odds, 3)) & (odds > 1e-4)
    row, column = np.nonzero(top)
    shift = np.column_stack([column - middle, row - middle]) * STEP
    far = np.hypot(*shift.T) > separation
    row, column, shift = row[far], column[far], shift[far]
    order = np.argsort(-odds[row, column], kind="stable")
    modes, mass = [], []
    taken = _basin(odds, middle, middle, separation)
    true_mode = odds[taken].sum()
    for k in order:
        if taken[row[k], column[k]] or _lowest_between(odds, row[k], column[k]) > _VALLEY * odds[row[k], column[k]]:
            continue
        basin = _basin(odds, row[k], column[k], separation) & ~taken
        taken |= basin
        modes.append(shift[k])
        mass.append(odds[basin].sum())
    total = true_mode + sum(mass)
    return AliasModes(np.array(modes).reshape(-1, 2), np.array(mass) / max(total, 1e-300))


def _basin(odds: np.ndarray, row: int, column: int, radius: float) -> np.ndarray:
    """Mask of the cells within `radius` m of one."""
    rows, columns = np.ogrid[:len(odds), :len(odds)]
    return (rows - row) ** 2 + (columns - column) ** 2 <= (radius / STEP) ** 2


def _lowest_between(odds: np.ndarray, row: int, column: int) -> float:
    """Lowest odds on the straight line from the middle to a cell."""
    middle = len(odds) // 2
    count = max(abs(row - middle), abs(column - middle)) + 1
    rows = np.round(np.linspace(middle, row, count)).astype(int)
    columns = np.round(np.linspace(middle, column, count)).astype(int)
    return float(odds[rows, columns].min())
