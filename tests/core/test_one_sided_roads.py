"""Road models of which the survey saw one kerb: what was seen, findings with places, nothing invented."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.core.surveyed_scene import edge, road_height
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.roadspace.survey.area_records import CARRIAGEWAY, CONTINUED, LANE, MEASURED, SIDEWALK, UNDIVIDED
from urbanmap_qgis.roadspace.survey.survey_roads import SurveyInputs, surveyed_roads

KERB = [[-30.0, 6.0], [30.0, 6.0]]
LANES = [shapely.box(-30.0, 0.0, 30.0, 3.25), shapely.box(-30.0, -3.25, 30.0, 0.0)]
"""Two lanes beside a row of parked cars under the kerb."""

OFFICIAL = shapely.box(-40.0, -9.0, 40.0, 8.5)
"""The road up to the outer borders of its sidewalks."""


def shown(model, kind):
    """The areas of a kind together."""
    return shapely.union_all([area.polygon for area in model.areas if area.kind == kind])


@pytest.mark.parametrize("turned", [0.0, 37.0])
def test_one_kerb_and_lanes_give_the_road_as_far_as_the_lanes(turned):
    angle = np.radians(turned)
    matrix = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])

    def placed(shape):
        return shapely.transform(shape, lambda corners: corners @ matrix.T)

    model = surveyed_roads([edge(np.array(KERB) @ matrix.T)], "2", SurveyInputs(lanes=[placed(one) for one in LANES]))
    true = placed(shapely.box(-30.0, -3.25, 30.0, 6.0))
    made = shown(model, CARRIAGEWAY)
    assert shapely.intersection(made, true).area / shapely.union(made, true).area > 0.975  # stations are 0.5 m apart
    assert {area.source for area in model.areas} == {CONTINUED}
    told = [finding for finding in model.findings if finding.kind == "other edge not seen"]
    assert len(told) == 1
    assert (told[0].x, told[0].y) == pytest.approx(matrix @ [0.0, -3.25], abs=1.0)


def test_no_sidewalk_is_invented_on_the_side_that_was_not_seen():
    model = surveyed_roads([edge(KERB)], "3.3", SurveyInputs([OFFICIAL], LANES, ground=road_height))
    walk = shown(model, SIDEWALK)
    assert walk.bounds == pytest.approx((-30.0, 6.0, 30.0, 8.5), abs=0.1)
    beyond = shown(model, UNDIVIDED)
    assert shapely.intersection(beyond, shapely.box(-30.0, -9.0, 30.0, -3.3)).area == pytest.approx(60 * 5.7, rel=0.01)
    assert {area.source for area in model.areas if area.kind == UNDIVIDED} == {"official"}
    assert len([area for area in model.areas if area.kind == LANE]) == 2
    assert all(step.ring[:, 1].min() > 5.9 for step in model.steps) and model.steps
    shapes = [area.polygon for area in model.areas]
    assert shapely.union_all(shapes).area == pytest.approx(sum(shape.area for shape in shapes), rel=1e-9)


def test_a_median_kerb_driven_on_one_side_goes_with_the_lanes_beside_it():
    """Lanes across the median lie farther from its kerb than those beside it."""
    near, far = shapely.box(-30.0, 2.0, 30.0, 5.5), shapely.box(-30.0, 8.0, 30.0, 11.5)
    made = shown(surveyed_roads([edge(KERB)], "2", SurveyInputs(lanes=[near, far])), CARRIAGEWAY)
    assert made.bounds == pytest.approx((-30.0, 2.0, 30.0, 6.0), abs=0.05)


def test_both_edges_where_they_were_seen_and_one_elsewhere():
    edges = [edge(KERB, chain=0), edge([[-30.0, -6.0], [-5.0, -6.0]], chain=1)]
    model = surveyed_roads(edges, "2", SurveyInputs(lanes=LANES))
    made = shown(model, CARRIAGEWAY)
    assert made.covers(shapely.box(-28.0, -5.9, -6.0, 5.9)) and made.covers(shapely.box(0.0, -3.2, 29.0, 5.9))
    assert shapely.intersection(made, shapely.box(0.0, -6.0, 30.0, -3.3)).area < 2.0
    assert "other edge not seen" in {finding.kind for finding in model.findings}


def test_an_edge_without_lanes_is_told_and_alone_is_refused():
    lonely = edge([[-30.0, 80.0], [30.0, 80.0]], chain=4)
    model = surveyed_roads([edge(KERB), lonely], "2", SurveyInputs(lanes=LANES))
    told = [finding for finding in model.findings if finding.kind == "edge without a carriageway"]
    assert [(round(one.x), round(one.y)) for one in told] == [(0, 80)]
    with pytest.raises(InputError, match="or lanes"):
        surveyed_roads([lonely], "2", SurveyInputs(lanes=LANES))


def test_the_same_road_is_the_same_with_and_without_lanes_where_both_edges_were_seen():
    edges = [edge(KERB, chain=0), edge([[-30.0, -6.0], [30.0, -6.0]], chain=1)]
    with_lanes, without = (surveyed_roads(edges, "2", SurveyInputs(lanes=lanes)) for lanes in (LANES, ()))
    assert shown(with_lanes, CARRIAGEWAY).equals(shown(without, CARRIAGEWAY))
    assert {area.source for area in with_lanes.areas} == {MEASURED}


def test_a_piece_beside_a_long_edge_bounds_no_carriageway_and_an_island_of_short_edges_stays():
    edges = [edge(KERB, chain=0), edge([[-30.0, -6.0], [30.0, -6.0]], chain=1), edge([[0.0, 4.6], [4.0, 4.6]], chain=2)]
    model = surveyed_roads(edges, "2")
    assert shown(model, CARRIAGEWAY).area == pytest.approx(60 * 12, rel=1e-3)
    told = [finding for finding in model.findings if finding.kind == "edge beside another"]
    assert [(round(one.x), round(one.y)) for one in told] == [(2, 5)]
    ring = shapely.LineString([[-2.0, 0.0], [1.0, 0.0]]).buffer(0.6, quad_segs=4).exterior
    with_island = surveyed_roads([*edges[:2], edge(shapely.get_coordinates(ring), chain=5)], "2")
    assert shown(with_island, "island").area == pytest.approx(shapely.Polygon(ring).area, rel=0.05)


def test_an_island_has_no_carriageway_behind_its_kerb_and_lanes_alone_no_junction():
    """Of an island between two directions the drive on one side saw one kerb: what lies behind it is not the road."""
    island = edge([[-30.0, 0.0], [30.0, 0.0]], chain=1)
    lanes = [shapely.box(-30.0, 1.0, 30.0, 4.5), shapely.box(-30.0, -4.5, 30.0, -1.0)]
    model = surveyed_roads([edge(KERB, chain=0), island], "3.1", SurveyInputs(lanes=lanes))
    made = shapely.union_all([area.polygon for area in model.areas])
    assert made.bounds == pytest.approx((-30.0, 0.0, 30.0, 6.0), abs=0.01)
    crossing_lanes = [shapely.box(-3.0, -20.0, 0.0, 5.0), *LANES]
    alone = surveyed_roads([edge(KERB)], "3.1", SurveyInputs(lanes=crossing_lanes))
    assert alone.count("junction") == 0
