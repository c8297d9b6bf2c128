"""Where the windows start from along the path, and how surely no other place fits as well."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_OTHER = 4  # cells: a path this far off goes through another position


@dataclass(frozen=True)
class InitialShifts:
    """The start along the path.

    Attributes
    ----------
    block : patches of a block.
    shift : (b, 2) m, east and north, where each block starts from.
    scores : (b, s, s) of all shifts about the best path's shift.
    deficit : (b, s, s) see `BestPath`.
    best : (b, 2) cells, shift of the best path.
    score : of the whole of it, log-likelihood.
    """

    block: int
    shift: np.ndarray
    scores: np.ndarray
    deficit: np.ndarray
    best: np.ndarray
    score: float

    def shift_at(self, patch: np.ndarray) -> np.ndarray:
        """(k, 2) m, linear between the blocks' middles."""
        middle = (np.arange(len(self.shift)) + 0.5) * self.block - 0.5
        return np.column_stack([np.interp(patch, middle, self.shift[:, axis]) for axis in (0, 1)])


def path_margins(start: InitialShifts) -> np.ndarray:
    """(b,) by how much the best path beats the best one through another position at the block.

    Any shift far enough off counts, whether or not it is a peak of the block's own surface: along lines alone, or where
    the next line's ridge runs into the search's edge, there is none.
    """
    size = start.deficit.shape[1]
    offset = np.arange(size) - size // 2
    margin = np.full(len(start.deficit), np.inf)
    for block, (east, north) in enumerate(start.best):
        far = np.maximum(np.abs(offset - north)[:, None], np.abs(offset - east)) >= _OTHER
        margin[block] = start.deficit[block][far].min(initial=np.inf)
    return margin
