"""Ids of bounds that were edited by hand: a map that is made of them again keeps them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
import shapely

from .map_records import MapLine, VectorMap

STEP = 1.0
"""Distance of the places at which bounds are compared with lines, m."""

NEAR = 0.10
"""A bound runs along a line where it is so near, m."""

LEAST = 0.5
"""It has the line's id where it runs along it over this share of its length."""


def bound_ids(built: VectorMap, lines: Sequence[MapLine]) -> list[int]:
    """Id of each bound: that of the line along which it runs, which only one bound has; others are counted on.

    Of several bounds along one line that with the longest course along it has the id. Without lines that have ids
    bounds are counted from 0.
    """
    named = [line for line in lines if line.identifier >= 0]
    if not named:
        return list(range(len(built.bounds)))
    tree = shapely.STRtree([shapely.LineString(line.points[:, :2]) for line in named])
    courses = []
    for number, bound in enumerate(built.bounds):
        course = shapely.LineString(built.bound_points(bound)[:, :2])
        places = shapely.line_interpolate_point(course, np.arange(0.0, course.length + STEP / 2, STEP))
        at, which = tree.query(places, predicate="dwithin", distance=NEAR)
        counts = Counter({named[k].identifier: len(np.unique(at[which == k])) for k in np.unique(which)})
        courses += [(count, number, identifier) for identifier, count in counts.items()
                    if bound.kind != "virtual" and count >= LEAST * len(places)]
    ids: dict[int, int] = {}
    for _, number, identifier in sorted(courses, key=lambda one: (-one[0], one[1], one[2])):
        if number not in ids and identifier not in ids.values():
            ids[number] = identifier
    new = iter(range(max(line.identifier for line in named) + 1, 2 ** 62))
    return [ids[number] if number in ids else next(new) for number in range(len(built.bounds))]
