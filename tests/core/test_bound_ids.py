"""Ids of bounds that were edited by hand."""

from __future__ import annotations

import numpy as np

from urbanmap_qgis.roadmap.bound_ids import bound_ids
from urbanmap_qgis.roadmap.map_records import Bound, MapLine, VectorMap


def built_of(*courses):
    """A map of bounds along x from a to b at a y; kind after these."""
    built = VectorMap()
    for a, b, y, kind in courses:
        numbers = range(len(built.nodes), len(built.nodes) + 2)
        built.nodes += [np.array([x, y, 0.0]) for x in (a, b)]
        built.bounds.append(Bound(list(numbers), kind))
    return built


def line(a, b, y, identifier=-1):
    return MapLine(np.array([(a, y, 0.0), (b, y, 0.0)]), "solid", identifier=identifier)


def test_bounds_are_counted_where_no_line_has_an_id():
    assert bound_ids(built_of((0, 50, 0, "solid"), (0, 50, 3, "dashed")), [line(0, 50, 0)]) == [0, 1]


def test_each_id_goes_to_the_longest_bound_along_its_line_and_others_are_counted_on():
    built = built_of((0, 20, 0.05, "solid"), (20, 60, 0, "solid"), (0, 60, 3.0, "dashed"), (0, 60, 6.0, "virtual"),
                     (0, 60, 9.3, "solid"), (0, 60, 12.0, "solid"))
    lines = [line(0, 60, 0, 7), line(60, 0, 3.0, 12), line(0, 60, 6.0, 3), line(0, 60, 9.0, 5), line(0, 20, 12.0, 9)]
    # The virtual one is nobody's line, the next lies too far off, the last runs along its line for a third only.
    assert bound_ids(built, lines) == [13, 7, 12, 14, 15, 16]
