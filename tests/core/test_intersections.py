"""Areas of intersections: the lanes that they take in."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.roadmap.lanes.intersections import add_intersections
from urbanmap_qgis.roadmap.map_records import Bound, MapLane, VectorMap


def lane_map(*lanes):
    """A map of lanes, each of its kind and its left and right bounds as places in plan."""
    built = VectorMap(left_hand=True)
    for kind, *sides in lanes:
        for side in sides:
            built.nodes += [np.array([*place, 0.0]) for place in side]
            built.bounds.append(Bound(list(range(len(built.nodes) - len(side), len(built.nodes))), "virtual"))
        centre = np.column_stack([np.mean([sides[0][k] for k in (0, -1)], axis=0),
                                  np.mean([sides[0][-1], sides[1][-1]], axis=0)]).T
        built.lanes.append(MapLane(len(built.bounds) - 2, len(built.bounds) - 1, True, True,
                                   np.column_stack([centre, np.zeros(2)]), 3.0, 3.0, kind, "", "straight"))
    return built


BULGING = ("virtual", [(0, 3), (5, 7), (10, 3)], [(0, 0), (5, 4), (10, 0)])
BESIDE = [("lane", [(-40, 9), (0, 9)], [(-40, 6), (0, 6)]), ("lane", [(10, 9), (50, 9)], [(10, 6), (50, 6)])]


@pytest.mark.parametrize("more, corners", [
    (BESIDE, {(0, 0), (10, 0), (10, 3), (10, 6), (10, 9), (0, 9), (0, 6), (0, 3)}),  # as wide as the roads beside
    ([*BESIDE, ("lane", [(2, 9), (8, 9)], [(2, 7), (8, 7)])], None),  # but for a lane that would lie in it
    ([], None)])
def test_the_area_of_a_way_that_bulges_takes_the_roads_beside_in(more, corners):
    built = lane_map(BULGING, *more)
    add_intersections(built)
    found = [({tuple(built.nodes[node][:2]) for node in one.ring}, one.lanes) for one in built.intersections]
    assert found == ([(corners, [0])] if corners else [])


def test_a_way_past_a_lane_stays_out_of_the_area():
    """Else the area would lie about the lane, which is no way through it."""
    short, long = ("virtual", [(0, 3), (10, 3)], [(0, 0), (10, 0)]), ("virtual", [(0, 6), (70, 6)], [(0, 3), (70, 3)])
    beside = ("lane", [(20, 2.5), (30, 2.5)], [(20, 1.5), (30, 1.5)])
    built = lane_map(short, long, beside)
    add_intersections(built)
    assert [one.lanes for one in built.intersections] == [[0]]
    alone = lane_map(short, long)
    add_intersections(alone)
    assert [one.lanes for one in alone.intersections] == [[0, 1]]
