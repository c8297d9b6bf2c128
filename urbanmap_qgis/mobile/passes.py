"""Passes of a survey: spans of time in which the vehicle visits no place twice.

When a street is driven again, the navigation's error is another one: the two passes may lie half a metre apart in
height. What looks at the neighbours of a point must therefore not mix them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

BLOCK = 1.0
"""s; the vehicle's place is the mean of the points of a block."""

MIN_ABSENCE = 30.0
"""s; who comes back to a place after so long has been away."""

CELL = 16.0
"""m, side of the cells of the grid on which places are compared."""

_FEW_PASSES = 8


class BlockPositions:
    """Collects the mean place of the points of each second, chunk by chunk."""

    def __init__(self) -> None:
        self._sums: dict[int, np.ndarray] = {}

    def add(self, x: np.ndarray, y: np.ndarray, time: np.ndarray) -> None:
        """Take points: x, y in m, time in s, (n,) each."""
        if not len(time):
            return
        block = np.floor(time / BLOCK).astype(np.int64)
        low, high = int(block.min()), int(block.max())
        if high - low < 4 * len(block):
            names, inverse = np.arange(low, high + 1), block - low
        else:
            names, inverse = np.unique(block, return_inverse=True)
        sums = np.column_stack([np.bincount(inverse, minlength=len(names)),
                                np.bincount(inverse, weights=x, minlength=len(names)),
                                np.bincount(inverse, weights=y, minlength=len(names))])
        for name, row in zip(names.tolist(), sums):
            if row[0]:
                self._sums[name] = self._sums.get(name, 0.0) + row

    def passes(self, min_absence: float = MIN_ABSENCE) -> SurveyPasses:
        """The passes of all points taken; who comes back to a place after `min_absence` seconds begins a new one."""
        blocks = np.array(sorted(self._sums), dtype=np.int64)
        if not len(blocks):
            return SurveyPasses(np.empty(0))
        count, x, y = np.array([self._sums[block] for block in blocks.tolist()]).T
        cells = np.floor(np.column_stack([x, y]) / count[:, None] / CELL).astype(np.int64)
        starts, seen = [], {}
        for block, (column, row) in zip(blocks.tolist(), cells.tolist()):
            around = [(column + i, row + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
            if any(block - seen.get(cell, block) > min_absence / BLOCK for cell in around):
                starts.append(block * BLOCK)
                seen = {}
            # A vehicle that waits has not been away.
            seen.update(dict.fromkeys(around, block))
        return SurveyPasses(np.array(starts))


@dataclass(frozen=True)
class SurveyPasses:
    """Passes of a survey.

    Attributes
    ----------
    starts : (k - 1,) s, times at which the second and later passes begin, increasing.
    """

    starts: np.ndarray

    @property
    def count(self) -> int:
        """Number of passes, k."""
        return len(self.starts) + 1

    def of(self, time: np.ndarray) -> np.ndarray:
        """Number of the pass, from 0, of each time (n,)."""
        if len(self.starts) > _FEW_PASSES:
            return np.searchsorted(self.starts, time, side="right")
        number = np.zeros(np.shape(time), np.int64)
        for start in self.starts:  # for a few starts several times faster than a search
            number += ~(time < start)
        return number
