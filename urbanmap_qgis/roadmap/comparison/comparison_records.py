"""What the comparison of two lane maps gives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...wording import mark

MOVED, ADDED, REMOVED, REPAINTED = mark("moved"), mark("added"), mark("removed"), mark("repainted")
OFFSET = mark("offset")
CHANGES = (MOVED, ADDED, REMOVED, REPAINTED)


@dataclass(frozen=True)
class MapChange:
    """One change.

    Attributes
    ----------
    kind : one of `CHANGES`, or `OFFSET` for the whole map.
    element : "line", "stop line", "crosswalk" or "symbol"; "" for the whole map.
    before, after : kind and colour in the old and in the new map, "" where it is not there.
    points : (n, 2) m, where it lies in the map that has it (of shifts: the new one); empty for the whole map.
    length : m.
    east, north : shift, m, without the offset between the maps; NaN where there is none.
    along, across : the same along the element's course and to its left, m; of a line `along` is NaN, not seen.
    sigma : of the shift, m.
    significance : shift over sigma, by the direction in which that is greatest.
    old_id, new_id : of the elements, "" where there is none.
    """

    kind: str
    element: str
    before: str
    after: str
    points: np.ndarray
    length: float = np.nan
    east: float = np.nan
    north: float = np.nan
    along: float = np.nan
    across: float = np.nan
    sigma: float = np.nan
    significance: float = np.nan
    old_id: str = ""
    new_id: str = ""

    @property
    def shift(self) -> float:
        return float(np.hypot(self.east, self.north))

    @property
    def middle(self) -> np.ndarray:
        """Where it is (2,), m: the point in the middle of the list."""
        return self.points[len(self.points) // 2] if len(self.points) else np.full(2, np.nan)


@dataclass(frozen=True)
class MapOffset:
    """Offset between two maps: what all of the new one lies beside the old one.

    Attributes
    ----------
    east, north : m; 0 in a direction that nothing shows.
    sigma_east, sigma_north : m; NaN where nothing shows the direction.
    significant : it exceeds three sigma, and was taken off before elements were compared.
    """

    east: float = 0.0
    north: float = 0.0
    sigma_east: float = np.nan
    sigma_north: float = np.nan
    significant: bool = False


@dataclass(frozen=True)
class MapNoise:
    """How well differences between elements of a kind are known.

    Attributes
    ----------
    old, new : sigma of elements that state none, m; NaN where all state one, or nothing shows it.
    factor : by which the stated sigmas are multiplied, since what did not change scatters so much more.
    limit : a shift counts above so many sigma: 3, more where sigma was estimated from few.
    count : matched elements from which it was estimated.
    source : "stated", "given", "estimated" or "all elements" (too few of the kind), or
        "unknown": no shift is told.
    """

    old: float
    new: float
    factor: float
    limit: float
    count: int
    source: str


@dataclass(frozen=True)
class MapComparison:
    """Two maps compared.

    Attributes
    ----------
    changes : the offset first, where it is significant.
    offset : between the maps.
    noises : by kind of element (stop lines and symbols also along and across), see `MapNoise`.
    compared, same : length of the old map's lines that the new map shows too, and of those that are as they were, m.
    unjudged : length of the old map's lines of which that is not known: no shift of them would be significant, m.
    outside_old, outside_new : length of lines where the other map shows no road, m: not judged.
    counts : number of matched stop lines, crosswalks and symbols by kind.
    """

    changes: list[MapChange]
    offset: MapOffset
    noises: dict[str, MapNoise]
    compared: float
    same: float
    unjudged: float
    outside_old: float
    outside_new: float
    counts: dict[str, int]

    def of(self, kind: str, element: str | None = None) -> list[MapChange]:
        """Changes of a kind, of all elements or of one."""
        return [one for one in self.changes if one.kind == kind and element in (None, one.element)]
