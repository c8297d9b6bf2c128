"""A bridge over a street: its edges cross those of the street in plan."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.core.surveyed_scene import HALF_EAST, HALF_NORTH, REACH, edge
from urbanmap_qgis.roadspace.survey.survey_roads import surveyed_roads


def roads(clearance):
    """A street to the east, and a road to the north that runs `clearance` above it."""
    street = [edge([[-REACH, side * HALF_EAST], [REACH, side * HALF_EAST]], chain=k) for k, side in enumerate((1, -1))]
    lift = np.array([0.0, 0.0, clearance])
    over = [edge([[side * HALF_NORTH, -REACH], [side * HALF_NORTH, REACH]], chain=5 + k)
            for k, side in enumerate((1, -1))]
    return [*street, *(replace(one, foot=one.foot + lift, top=one.top + lift) for one in over)]


def test_a_bridge_over_a_street_is_told_once_with_its_place_and_height():
    told = [one for one in surveyed_roads(roads(5.5), "3.0").findings if one.kind == "road above a road"]
    assert len(told) == 1 and "5.5 m" in told[0].text
    assert (abs(told[0].x), abs(told[0].y)) == pytest.approx((HALF_NORTH, HALF_EAST), abs=0.1)


@pytest.mark.parametrize("clearance", [0.0, 0.3, np.nan])
def test_edges_that_cross_at_one_height_or_an_unknown_one_are_no_bridge(clearance):
    assert "road above a road" not in {one.kind for one in surveyed_roads(roads(clearance), "3.0").findings}
