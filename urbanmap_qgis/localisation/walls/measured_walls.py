"""Which measured walls tell how accurately the walls of a map stand."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...buildings.merging.wall_match import FOLDED, NEIGHBOUR, NOT_SEEN, TOO_FAR
from ...gnss.walls.adjustment import HELD, NOT_OBSERVABLE

LEFT = frozenset((NOT_OBSERVABLE, HELD, NOT_SEEN, TOO_FAR, NEIGHBOUR, FOLDED))
"""What became of walls that stand in the map where they stood before they were measured."""


def sigmas_of_moved(sigma: np.ndarray, status: Sequence[str | None] | None) -> np.ndarray:
    """(n,) sigmas, m, of measured walls, NaN for those that were left where they were.

    Observations that did not move a wall say how well they would have placed it, not how well the map has it.

    Parameters
    ----------
    sigma : (n,) m.
    status : (n,) what became of each wall, as `adjustwalls` and `mergebuildingmodels` say; None where nothing tells it.
    """
    if status is None:
        return np.asarray(sigma, float)
    return np.where(np.array([each in LEFT for each in status], bool), np.nan, np.asarray(sigma, float))
