"""Given roads a metre beside the measured kerbs, as edges of a map at 1:2500 lie."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.core.surveyed_scene import carriageway, crossing, official
from urbanmap_qgis.roadspace.survey.area_records import SIDEWALK
from urbanmap_qgis.roadspace.survey.given_roads import laid_on_kerbs
from urbanmap_qgis.roadspace.survey.survey_roads import SurveyInputs, surveyed_roads

KERBS = shapely.union_all([shapely.linestrings(one.plan) for one in crossing()])


def shifted(shape, east, north):
    return shapely.transform(shape, lambda corners: corners + np.array([east, north]))


@pytest.mark.parametrize("east, north", [(1.0, 0.0), (-0.6, 0.8), (0.0, -1.5)])
def test_roads_without_sidewalks_are_moved_onto_the_kerbs_and_it_is_said(east, north):
    model = surveyed_roads(crossing(), "2", SurveyInputs([shifted(carriageway(), east, north)]))
    assert not model.count(SIDEWALK)
    told = [one for one in model.findings if one.kind == "given roads moved"]
    assert len(told) == 1 and f"{np.hypot(east, north):.2f} m" in told[0].text
    assert shapely.distance(KERBS, shapely.points(told[0].x, told[0].y)) < 0.01


def test_without_a_shift_nothing_is_moved_or_said():
    roads = [carriageway()]
    assert laid_on_kerbs(roads, KERBS) == (roads, [])


@pytest.mark.parametrize("east, north", [(0.0, 0.0), (1.0, 0.5)])
def test_roads_with_sidewalks_stay(east, north):
    roads = [shifted(official(), east, north)]
    assert laid_on_kerbs(roads, KERBS) == (roads, [])
    assert surveyed_roads(crossing(), "2", SurveyInputs(roads)).count(SIDEWALK) == 4


def test_kerbs_of_another_place_and_too_few_move_nothing():
    far = [shifted(carriageway(), 500.0, 0.0)]
    assert laid_on_kerbs(far, KERBS) == (far, [])
    few = [shifted(carriageway(), 1.0, 0.0)]
    assert laid_on_kerbs(few, shapely.linestrings([[30.0, 6.0], [35.0, 6.0]])) == (few, [])
    assert laid_on_kerbs((), KERBS) == ((), [])


def test_one_kerb_beside_its_sidewalk_moves_nothing():
    """The border 2.5 m behind the one kerb that was seen is that of a sidewalk, or of a road drawn beside its place."""
    kerb = shapely.linestrings([[-30.0, 6.0], [30.0, 6.0]])
    roads = [shapely.box(-40.0, -9.0, 40.0, 8.5)]
    assert laid_on_kerbs(roads, kerb) == (roads, [])


@pytest.mark.parametrize("far", [1e15, -1e12, 1e308])
def test_a_road_with_a_corner_far_away_shows_no_shift_and_hinders_none(far):
    spike = shapely.Polygon([(0, 0), (30, 0), (far, 20), (0, 8)])
    assert laid_on_kerbs([spike], KERBS) == ([spike], [])
    moved, told = laid_on_kerbs([spike, shifted(carriageway(), 1.0, 0.0)], KERBS)
    assert [one.kind for one in told] == ["given roads moved"] and moved[1].distance(carriageway()) == 0
