"""Changes of a lane map as columns and shapes of a layer, and as tables of a report."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from .comparison_records import CHANGES, MapChange, MapComparison
from .map_elements import ELEMENTS, LINE


def change_columns(changes: Sequence[MapChange]) -> dict[str, list]:
    """Columns of the changes' layer, one value a change; azimuths in degrees from grid north."""
    columns = {name: [getattr(one, name) or None for one in changes]
               for name in ("kind", "element", "before", "after", "old_id", "new_id")}
    columns |= {name: [getattr(one, name) for one in changes]
                for name in ("length", "shift", "along", "across", "sigma", "significance")}
    return columns | {"azimuth": [float(np.degrees(np.arctan2(one.east, one.north)) % 360.0) for one in changes]}


def change_shapes(changes: Sequence[MapChange]) -> list[shapely.LineString | None]:
    """Lines and outlines of changes; None for the offset of the whole map."""
    return [shapely.linestrings(one.points) if len(one.points) else None for one in changes]


def change_summary(found: MapComparison) -> list[tuple[str, str, int, float, float]]:
    """Kind, element, number, length (m, of lines) and median shift (m) of the changes that there are."""
    rows = []
    for kind in CHANGES:
        for element in ELEMENTS:
            these = found.of(kind, element)
            if these:
                shifts = [one.shift for one in these if np.isfinite(one.shift)]
                rows.append((kind, element, len(these), sum(one.length for one in these) if element == LINE else np.nan,
                             float(np.median(shifts)) if shifts else np.nan))
    return rows
