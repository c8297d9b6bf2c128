"""Marking points as they go from their extraction to the registration."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ...errors import InputError
from ...wording import say


@dataclass(frozen=True)
class MarkingPoints:
    """Points on road markings as the survey reports them.

    Attributes
    ----------
    x, y, z : (n,) m, as placed by the reported trajectory.
    time : (n,) s, in the trajectory's time.
    weight : (n,) how surely a point is paint, 0 to 1 (1 where unknown).
    scanner : (n,) number of the scanner (0 where unknown).
    """

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    time: np.ndarray
    weight: np.ndarray
    scanner: np.ndarray

    def __post_init__(self) -> None:
        if len({len(getattr(self, field.name)) for field in fields(self)}) != 1:
            raise InputError(say("The marking points' columns differ in length."))

    def __len__(self) -> int:
        return len(self.x)

    def select(self, which: np.ndarray | slice) -> MarkingPoints:
        """Some of the points, by mask, index or slice."""
        return MarkingPoints(*(getattr(self, field.name)[which] for field in fields(self)))
