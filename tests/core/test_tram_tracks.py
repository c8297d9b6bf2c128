"""Low edges of a tram's tracks amid a measured carriageway."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.core.surveyed_scene import carriageway, crossing, edge, official, road_height
from urbanmap_qgis.roadspace.survey.area_records import CARRIAGEWAY, CROSSING, ISLAND, EdgeLine
from urbanmap_qgis.roadspace.survey.survey_roads import SurveyInputs, surveyed_roads


def low(y, x0=-40.0, x1=40.0, height=0.06, chain=20, bend=0.0):
    """A low edge along the road to the east, 1.5 cm (standard deviation) beside its place, with a wave of `bend` m."""
    rng = np.random.default_rng(chain)
    x = np.arange(x0, x1 + 0.1, 0.5)
    return edge(np.column_stack([x, y + bend * np.sin(x / 9.0) + 0.015 * rng.standard_normal(len(x))]), height, chain)


def ring(length, half, height=0.06):
    """The closed edge of a strip with round ends in the arm to the west."""
    strip = shapely.LineString([[-37.0, 0.0], [-37.0 + length, 0.0]]).buffer(half, quad_segs=4)
    return [edge(shapely.get_coordinates(strip.exterior), height, 30)]


def model_with(more, level="3.3"):
    return surveyed_roads([*crossing(), *more], level, SurveyInputs([official()], ground=road_height))


def area_of(model, *kinds):
    return shapely.union_all([area.polygon for area in model.areas if area.kind in kinds])


@pytest.mark.parametrize("more", [
    [low(1.3, chain=20), low(-1.3, chain=21)],
    [low(2.9, chain=20, bend=0.4), low(0.3, chain=21, bend=0.4)],
    [low(1.3, -36.0, -12.0, 0.08, 20), low(-1.3, -36.0, -12.0, 0.05, 21)],
    [low(y, height=0.03, chain=20 + k) for k, y in enumerate((-2.2, -1.13, 1.13, 2.2))],
    [low(-1.3, chain=20), low(-0.53, height=0.02, chain=21), low(0.53, height=0.02, chain=22), low(1.3, chain=23)],
    ring(23.0, 1.3),
], ids=["bed through a junction", "winding bed", "bed of one arm", "four rails", "rails on a bed", "closed bed"])
def test_tracks_are_a_part_of_the_carriageway_and_are_told(more):
    model = model_with(more)
    assert not area_of(model, ISLAND).area
    made = area_of(model, CARRIAGEWAY, CROSSING)
    assert shapely.intersection(made, carriageway()).area / shapely.union(made, carriageway()).area > 0.999
    assert [finding.kind for finding in model.findings].count("tram track") == len({one.chain for one in more})


@pytest.mark.parametrize("more", [ring(12.0, 1.3), ring(23.0, 1.3, 0.15), ring(23.0, 0.85)],
                         ids=["short", "high", "of no track's width"])
def test_islands_stay_islands(more):
    model = model_with(more)
    true = shapely.Polygon(more[0].plan)
    assert area_of(model, ISLAND).area == pytest.approx(true.area, rel=0.02)
    assert "tram track" not in {finding.kind for finding in model.findings}


def test_low_kerbs_of_a_narrow_carriageway_that_rise_away_from_it_are_no_track():
    """Borders stand behind low kerbs 3 m apart: what lies between borders and kerbs is no carriageway."""
    sides = []
    for chain, side in enumerate((1.0, -1.0)):
        foot = edge([[0.0, 1.5 * side], [60.0, 1.5 * side]], 0.05, chain)
        sides.append(EdgeLine(foot.foot, foot.top + np.array([0.0, 0.02 * side, 0.0]), 0.05, 0.01, 0.005, chain, 0.0))
        sides.append(edge([[0.0, 4.0 * side], [60.0, 4.0 * side]], 0.0, 10 + chain))
    model = surveyed_roads(sides, "3.3")
    assert "tram track" not in {finding.kind for finding in model.findings}
