"""Road models from measured edges: areas, cuts, heights and steps of a crossing of known measures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from tests.core.surveyed_scene import (
    HALF_EAST,
    HALF_NORTH,
    HEIGHT,
    PAVEMENT,
    RADIUS,
    REACH,
    carriageway,
    corner_line,
    crossing,
    edge,
    official,
    road_height,
)
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.roadspace.road_pictures import plan_picture
from urbanmap_qgis.roadspace.road_records import RoadFinding
from urbanmap_qgis.roadspace.survey.area_city import faces_of, survey_road_objects
from urbanmap_qgis.roadspace.survey.area_records import (
    CARRIAGEWAY,
    CONTINUED,
    CROSSING,
    DOUBTFUL,
    ISLAND,
    LANE,
    MEASURED,
    SIDEWALK,
    UNDIVIDED,
    corner_of,
    kerb_edge_lines,
    layer_parts,
    tops_by_number,
)
from urbanmap_qgis.roadspace.survey.stop_cuts import junction_cuts
from urbanmap_qgis.roadspace.survey.survey_roads import SurveyInputs, surveyed_roads

STOP = 18.0
"""m from the crossing's middle, of the stop lines of both roads."""


def stop_lines():
    """Stop lines on the left half of each arm, as who drives towards the crossing sees it."""
    ends = [[[-STOP, 0], [-STOP, HALF_EAST]], [[STOP, 0], [STOP, -HALF_EAST]],
            [[0, STOP], [HALF_NORTH, STOP]], [[0, -STOP], [-HALF_NORTH, -STOP]]]
    return [shapely.linestrings(np.array(line, float)) for line in ends]


def lanes():
    """Two lanes in the arm to the west that end half a metre before the stop line."""
    return [shapely.box(-35.0, 0.0, -STOP - 0.5, 3.25), shapely.box(-35.0, -3.25, -STOP - 0.5, 0.0)]


def of_kind(model, kind):
    """Areas of a kind."""
    return [area for area in model.areas if area.kind == kind]


def agreement(areas, true):
    """Intersection over union with a true surface."""
    made = shapely.union_all([area.polygon for area in areas])
    return shapely.intersection(made, true).area / shapely.union(made, true).area


def test_level_two_divides_carriageways_junction_and_sidewalks():
    model = surveyed_roads(crossing(), "2", SurveyInputs([official()]))
    assert agreement([*of_kind(model, CARRIAGEWAY), *of_kind(model, CROSSING)], carriageway()) > 0.999
    assert (model.count(CROSSING), model.count(CARRIAGEWAY), model.count(SIDEWALK)) == (1, 4, 4)
    # Cut where the rounded kerbs leave the arms' directions.
    junction = of_kind(model, CROSSING)[0].polygon
    assert junction.bounds == pytest.approx((-HALF_NORTH - RADIUS, -HALF_EAST - RADIUS, HALF_NORTH + RADIUS,
                                             HALF_EAST + RADIUS), abs=0.3)
    walks = shapely.difference(official(), carriageway()) & shapely.box(-REACH, -REACH, REACH, REACH)
    assert agreement(of_kind(model, SIDEWALK), walks) > 0.99
    assert all(height == 0.0 for area in model.areas for height in area.heights.values()) and not model.steps


def test_finer_levels_cut_at_the_extension_of_stop_lines():
    model = surveyed_roads(crossing(), "3.1", SurveyInputs([official()], lanes(), stop_lines()))
    junction = of_kind(model, CROSSING)[0].polygon
    assert junction.bounds == pytest.approx((-STOP, -STOP, STOP, STOP), abs=1e-3)
    assert "no stop line" not in {finding.kind for finding in model.findings}
    # The half metre between lanes and stop line belongs to the lanes.
    assert sorted(area.polygon.area for area in of_kind(model, LANE)) == pytest.approx([17 * 3.25] * 2, rel=3e-3)
    without = surveyed_roads(crossing(), "3.1", SurveyInputs([official()], lanes(), stop_lines()[:3]))
    assert of_kind(without, CROSSING)[0].polygon.bounds[1] == pytest.approx(-HALF_EAST - RADIUS, abs=0.3)
    assert [finding.kind for finding in without.findings].count("no stop line") == 1


def test_all_surfaces_share_their_borders_to_the_bit():
    model = surveyed_roads(crossing(), "3.3", SurveyInputs([official()], lanes(), stop_lines()))
    shapes = [area.polygon for area in model.areas]
    assert shapely.union_all(shapes).area == pytest.approx(sum(shape.area for shape in shapes), rel=1e-9)
    corners = {}
    for area in model.areas:
        for ring in (area.polygon.exterior, *area.polygon.interiors):
            points = list(map(corner_of, shapely.get_coordinates(ring).tolist()))
            for start, end in zip(points[:-1], points[1:]):
                corners[start, end] = corners.get((start, end), 0) + 1
    outer = shapely.union_all(shapes).boundary
    for (start, end), count in corners.items():
        assert count == 1  # no overlap
        middle = shapely.points((np.array(start) + end) / 2.0)
        assert (end, start) in corners or shapely.distance(outer, middle) < 1e-6  # and no gap
    assert min(shape.area for shape in shapes) > 0.05
    assert all(shape.exterior.is_ccw for shape in shapes)


@pytest.mark.parametrize("level, stepped", [("3.0", False), ("3.1", False), ("3.2", True), ("3.3", True)])
def test_one_height_across_or_steps(level, stepped):
    model = surveyed_roads(crossing(), level, SurveyInputs([official()], ground=road_height))
    for area in of_kind(model, SIDEWALK):
        for (x, y), z in area.heights.items():
            if abs(y) < HALF_EAST + 0.1 and abs(x) > HALF_NORTH + RADIUS + 1.0:
                assert z == pytest.approx(float(road_height(x, y)) + HEIGHT * stepped, abs=0.02)
    kerbs = sum(shapely.linestrings(corner_line(*sides)).length for sides in ((1, 1), (-1, 1), (-1, -1), (1, -1)))
    length = sum(step.length for step in model.steps)
    assert length == pytest.approx(kerbs * stepped, rel=0.01)
    assert all(step.height == pytest.approx(HEIGHT, abs=1e-3) for step in model.steps)
    for area in of_kind(model, CARRIAGEWAY):
        assert all(z == pytest.approx(float(road_height(*place)), abs=0.02) for place, z in area.heights.items())


def with_a_gap(begin, end, chains, gap):
    """The crossing whose first kerb was not seen from `begin` to `end`, m to the east."""
    rest = np.vstack([[begin, HALF_EAST], corner_line(1, 1)[1:]])
    return [*crossing()[1:], edge([[REACH, HALF_EAST], [end, HALF_EAST]], chain=chains[0], gap=gap),
            edge(rest, chain=chains[1])]


def test_a_kerb_not_seen_over_a_few_metres_keeps_the_step_of_both_sides():
    def between(x, y):
        """A raster that mixes road and sidewalk."""
        return road_height(x, y) + HEIGHT / 2.0
    model = surveyed_roads(with_a_gap(20.0, 26.0, (9, 9), 6.0), "3.3", SurveyInputs([official()], ground=between))
    inside = [step for step in model.steps if step.ring[:, 1].min() > 0 and step.ring[:, 0].max() > 20.0
              and step.ring[:, 0].min() < 26.0]
    assert sum(step.length for step in inside) >= 6.0
    for step in inside:
        assert step.height == pytest.approx(HEIGHT, abs=1e-3)
        assert step.ring[:, 2].min() == pytest.approx(float(road_height(step.ring[:, 0].min(), 0.0)), abs=0.01)


def test_beside_a_longer_gap_along_the_road_alone_there_is_no_sidewalk():
    model = surveyed_roads(with_a_gap(15.0, 29.0, (8, 9), 0.0), "3.3", SurveyInputs([official()]))
    kinds = [finding.kind for finding in model.findings]
    assert (kinds.count("edge continued"), kinds.count("end of the survey")) == (1, 4)
    walk = shapely.union_all([area.polygon for area in of_kind(model, SIDEWALK)])
    beside = shapely.box(10.0, HALF_EAST, 40.0, HALF_EAST + PAVEMENT)
    assert shapely.intersection(walk, beside).area == pytest.approx((30.0 - 14.0) * PAVEMENT, rel=0.01)
    length = sum(step.length for step in model.steps)
    assert length == pytest.approx(4 * shapely.linestrings(corner_line(1, 1)).length - 14.0, rel=0.01)


def test_lowered_kerbs_are_steps_of_the_finest_level_alone():
    lowered = edge([[REACH, HALF_EAST], [30.5, HALF_EAST]], 0.03, 9)
    rest = corner_line(1, 1)[1:]
    edges = [*crossing()[1:], lowered, edge(np.vstack([[30.0, HALF_EAST], rest]), chain=9)]
    low = {level: [step for step in surveyed_roads(edges, level, SurveyInputs([official()])).steps
                   if step.ring[:, 0].min() > 30.2 and step.ring[0, 1] > 0] for level in ("3.2", "3.3")}
    assert not low["3.2"] and low["3.3"]
    assert all(step.height == pytest.approx(0.03, abs=5e-3) for step in low["3.3"])


def test_gaps_are_drawn_on_and_told_and_long_ones_are_not():
    def broken(gap):
        """The edge in the north-east is not seen over some metres from 25 m on."""
        whole = corner_line(1, 1)
        first = edge([whole[0], [25.0, HALF_EAST]], chain=7, gap=gap)
        return [*crossing()[1:], first, edge(np.vstack([[25.0 - gap, HALF_EAST], whole[1:]]), chain=7)]

    model = surveyed_roads(broken(8.0), "2", SurveyInputs([official()]))
    told = [finding for finding in model.findings if finding.kind == "edge continued"]
    assert len(told) == 1 and (told[0].x, told[0].y) == pytest.approx((21.0, HALF_EAST), abs=0.1)
    assert agreement([*of_kind(model, CARRIAGEWAY), *of_kind(model, CROSSING)], carriageway()) > 0.999
    east = [area for area in of_kind(model, CARRIAGEWAY) if area.polygon.centroid.x > 10]
    assert [area.source for area in east] == [CONTINUED]
    assert {area.source for area in of_kind(model, CARRIAGEWAY) if area.polygon.centroid.x < -10} == {MEASURED}


def test_islands_are_areas_with_steps_of_their_own():
    ring = shapely.LineString([[-30, 0], [-20, 0]]).buffer(0.6, quad_segs=4).exterior
    model = surveyed_roads([*crossing(), edge(shapely.get_coordinates(ring), chain=5)], "3.3",
                           SurveyInputs([official()], ground=road_height))
    (island,) = of_kind(model, ISLAND)
    assert island.polygon.area == pytest.approx(shapely.Polygon(ring).area, rel=0.02)
    assert model.count(CROSSING) == 1
    number = model.areas.index(island)
    length = sum(step.length for step in model.steps if step.area == number)
    assert length == pytest.approx(ring.length, rel=0.02)


def test_what_was_not_surveyed_stays_undivided_and_no_sidewalk_is_invented():
    model = surveyed_roads(crossing(), "2", SurveyInputs([official()]))
    beyond = of_kind(model, UNDIVIDED)
    assert beyond and all(area.source == "official" for area in beyond)
    assert sum(area.polygon.area for area in beyond) == pytest.approx(
        official().area - shapely.intersection(official(), shapely.box(-REACH, -REACH, REACH, REACH)).area, rel=0.01)
    alone = surveyed_roads(crossing(), "2")
    assert not of_kind(alone, SIDEWALK) and "no sidewalks" in {finding.kind for finding in alone.findings}
    assert [finding.kind for finding in alone.findings].count("end of the survey") == 4


def test_one_side_alone_and_edges_of_nothing_are_refused_in_one_sentence():
    with pytest.raises(InputError, match=r"one side of the road|enclose no"):
        surveyed_roads([edge([[-30.0, 6.0], [30.0, 6.0]])], "2")
    with pytest.raises(InputError, match="no kerbs"):
        surveyed_roads([], "2")
    with pytest.raises(InputError, match="no level 4"):
        surveyed_roads(crossing(), "4")


def test_edges_of_a_table_are_kerbs_and_borders_with_their_upper_edges():
    foot = shapely.linestrings([[0.0, 0.0, 10.0], [5.0, 0.0, 10.0]])
    top = shapely.linestrings([[0.0, 0.1, 10.14], [5.0, 0.1, 10.16]])
    columns = {"edge_id": [3, 4, 5], "kind": ["kerb", "wall", "road border"], "height": [0.15, 3.0, None],
               "sigma": [0.01, 0.01, 0.02], "sigma_z": [0.01] * 3, "chain": [1, 2, 3], "gap": [0.0, 0.0, None]}
    kerb, border = kerb_edge_lines([foot, foot, foot], {3: top}, columns)
    assert kerb.plan[:, 1] == pytest.approx([0.05, 0.05]) and kerb.top[:, 2] == pytest.approx([10.14, 10.16])
    assert border.height == 0.0 and border.top == pytest.approx(border.foot)


def test_faces_are_plane_look_up_and_make_the_area():
    model = surveyed_roads(crossing(), "3.3", SurveyInputs([official()], ground=lambda x, y: road_height(x, y)
                                                           + 0.02 * np.sin(x)))
    for area in model.areas:
        faces = faces_of(area)
        plans = [shapely.Polygon(rings[0][:, :2], [ring[:, :2] for ring in rings[1:]]) for rings in faces]
        assert sum(plan.area for plan in plans) == pytest.approx(area.polygon.area, rel=1e-6)
        assert all(plan.exterior.is_ccw for plan in plans)


def test_roads_of_the_city_model_are_made_of_their_areas():
    from urbanmap_qgis.roadspace.road_city import RoadDelivery

    model = surveyed_roads(crossing(), "3.2", SurveyInputs([official()], lanes(), stop_lines()))
    roads = list(survey_road_objects(model, RoadDelivery(created="2026-04-01")))
    assert len(roads) == len(model.pieces) == 5
    assert sum(len(road.fittings) for road in roads) == sum(area.kind != UNDIVIDED for area in model.areas)
    functions = {area.attributes["function"].value for road in roads for area in road.fittings}
    assert functions == {"1000", "1010", "1020", "2000"}
    assert roads[0].attributes["uro:tranDataQualityAttribute"].values["lodType"].value == "3.2"
    plain = list(survey_road_objects(replace(model, level="2"), RoadDelivery()))
    assert "lodType" not in plain[0].attributes["uro:tranDataQualityAttribute"].values


def test_a_block_amid_the_road_is_no_island_of_the_road():
    """A square of houses that roads surround is left out; a hole that was not measured is told."""
    block = shapely.box(-16.0, -16.0, 16.0, 16.0)
    outer = shapely.box(-24.0, -24.0, 24.0, 24.0)
    edges = [edge(shapely.get_coordinates(shape.exterior), chain=number)
             for number, shape in enumerate((outer, block))]
    model = surveyed_roads(edges, "2")
    made = shapely.union_all([area.polygon for area in model.areas if area.kind != ISLAND])
    assert made.area == pytest.approx(48.0**2 - 32.0**2, rel=0.02)


def test_edges_that_do_not_close_are_told_where_they_end():
    short = edge([[-38.0, 20.0], [-30.0, 20.0]], chain=11)
    model = surveyed_roads([*crossing(), short], "2", SurveyInputs([official()]))
    assert agreement([*of_kind(model, CARRIAGEWAY), *of_kind(model, CROSSING)], carriageway()) > 0.99
    loose = [finding for finding in model.findings if finding.kind == "edge not closed"]
    assert {round(finding.x) for finding in loose} == {-38, -30}


def test_given_roads_a_metre_off_do_not_move_measured_kerbs():
    moved = shapely.transform(official(), lambda corners: corners + np.array([0.0, 1.0]))
    model = surveyed_roads(crossing(), "2", SurveyInputs([moved]))
    assert agreement([*of_kind(model, CARRIAGEWAY), *of_kind(model, CROSSING)], carriageway()) > 0.999
    shapes = [area.polygon for area in model.areas]
    assert shapely.union_all(shapes).area == pytest.approx(sum(shape.area for shape in shapes), rel=1e-9)


def test_a_fence_across_the_road_is_no_kerb():
    """Rails and walls among the edges, such as those of a building site, are passed over."""
    line = shapely.linestrings([[0.0, -6.0, 10.0], [0.0, 6.0, 10.0]])
    assert not kerb_edge_lines([line, line], {}, {"kind": ["guard rail", "wall"]})


@pytest.mark.parametrize(("field", "value", "words"), [
    ("height", 1e308, "Edge 1.*height"), ("height", 12.0, "“12.0” in the field height"),
    ("sigma", "wide", "“wide” in the field sigma"),
    ("chain", float("inf"), "in the field chain"), ("z", -1e308, "Edge 1 lies at a height"),
    ("z", 2e5, "where no road is"), ("x", 1e308, "where no map reaches"), ("y", float("nan"), "where no map reaches"),
    ("x", -5e6, "Edge 1: two of its corners .* lie 5000.0 km apart")])
def test_figures_of_edges_that_cannot_be_meant_are_told(field, value, words):
    place = {"x": 0.0, "y": 0.0, "z": 0.0}
    columns = {"kind": ["kerb"]} | ({} if field in place else {field: [value]})
    line = shapely.LineString([tuple((place | {field: value})[axis] for axis in place), (9, 0, 0.0)])
    with pytest.raises(InputError, match=words):
        kerb_edge_lines([line], {}, columns)


def test_unknown_figures_and_heights_of_edges_are_let_pass():
    """NaN is how files say that a number is not known; a place without a height takes that of the others about."""
    nan = float("nan")
    edges = crossing()
    edges[0].foot[3:6, 2] = nan
    columns = {"height": [0.15, nan, 0.15, 0.15], "chain": [0, nan, 2, 3], "edge_id": [nan] * 4, "gap": [nan] * 4}
    lines = kerb_edge_lines([shapely.linestrings(one.foot) for one in edges], {}, columns)
    assert [line.height for line in lines] == [0.15, 0.0, 0.15, 0.15] and lines[1].chain == -2
    assert np.isnan(lines[0].top[3:6, 2]).all()
    model = surveyed_roads(lines, "3.0")
    heights = np.concatenate([list(area.heights.values()) for area in model.areas])
    assert np.isfinite(heights).all() and heights.min() == pytest.approx(9.6, abs=0.01)


def test_upper_edges_without_heights_are_as_high_as_their_kerb():
    kerb = shapely.linestrings([[0.0, 0.0, 10.0], [5.0, 0.0, 10.5]])
    flat = shapely.linestrings([[0.0, 0.1], [5.0, 0.1]])
    (line,) = kerb_edge_lines([kerb], {3: flat}, {"edge_id": [3], "height": [0.15]})
    assert line.plan[:, 1] == pytest.approx([0.05, 0.05]) and line.top[:, 2] == pytest.approx([10.15, 10.65])


def test_edges_without_heights_make_level_2_and_are_refused_for_others():
    lines = kerb_edge_lines([shapely.linestrings(one.foot[:, :2]) for one in crossing()], {}, {})
    assert surveyed_roads(lines, "2").count(CARRIAGEWAY) == 4
    with pytest.raises(InputError, match="no heights"):
        surveyed_roads(lines, "3.0")


@pytest.mark.parametrize(("kind", "count"), [("Polygon", 2), ("LineString", 0)])
def test_lanes_that_cross_themselves_are_repaired_and_places_off_the_map_told(kind, count):
    bow = shapely.Polygon([(0, 0), (4, 4), (4, 0), (0, 4)])
    parts = layer_parts("Lanes", [None, bow], kind)
    assert len(parts) == count and all(part.is_valid for part in parts)
    assert sum(part.area for part in parts) == pytest.approx(4.0 * count)
    with pytest.raises(InputError, match="Lanes: shape 2 .* no map"):
        layer_parts("Lanes", [bow, shapely.LineString([(0, 0), (1e300, 3)])], kind)


def test_upper_edges_without_a_number_are_left_out_and_words_are_told():
    line = shapely.LineString([(0, 0, 0), (9, 0, 0)])
    assert list(tops_by_number({"edge_id": [4, None, 6]}, [line, line, None])) == [4]
    with pytest.raises(InputError, match="“left” in the field edge_id"):
        tops_by_number({"edge_id": ["left"]}, [line])


def test_doubtful_kerbs_make_doubtful_areas_and_are_told_with_their_place():
    """The kerb in the north-east is doubtful from 25 m on: the arm to the east says so, the others do not."""
    whole, reason = corner_line(1, 1), "its face is not seen"
    doubtful = replace(edge([whole[0], [25.0, HALF_EAST]], chain=7, sigma=0.06), doubt=reason)
    rest = edge(np.vstack([[25.0, HALF_EAST], whole[1:]]), chain=7)
    model = surveyed_roads([*crossing()[1:], doubtful, rest], "3.3", SurveyInputs([official()], ground=road_height))
    east = [area for area in of_kind(model, CARRIAGEWAY) if area.polygon.centroid.x > 10]
    assert [area.source for area in east] == [DOUBTFUL] and east[0].seen < 0.62
    walk = [area for area in of_kind(model, SIDEWALK) if min(shapely.get_coordinates(
        shapely.centroid(area.polygon))[0]) > 0]
    assert [area.source for area in walk] == [DOUBTFUL]
    others = [area for area in of_kind(model, CARRIAGEWAY) if area.polygon.centroid.x < 10]
    assert {area.source for area in others} == {MEASURED} and len(others) == 3
    told = [finding for finding in model.findings if finding.kind == "edge doubtful"]
    assert [(finding.x, finding.y) for finding in told] == [pytest.approx((32.5, HALF_EAST), abs=0.01)]
    assert reason in told[0].text and "15.0 m" in told[0].text
    # The shapes are those that edges without doubt would make.
    sure = surveyed_roads([*crossing()[1:], replace(doubtful, doubt=""), rest], "3.3",
                          SurveyInputs([official()], ground=road_height))
    assert [area.polygon.wkb for area in sure.areas] == [area.polygon.wkb for area in model.areas]
    assert DOUBTFUL not in {area.source for area in sure.areas}
    assert "edge doubtful" not in {finding.kind for finding in sure.findings}


def test_doubt_is_read_from_the_status_of_the_edges():
    lines = [shapely.linestrings([[0.0, y, 10.0], [9.0, y, 10.0]]) for y in (0.0, 5.0, 9.0)]
    columns = {"kind": ["kerb"] * 3, "status": ["measured", "doubtful", "doubtful"], "reason": ["", "hidden", None]}
    assert [line.doubt for line in kerb_edge_lines(lines, {}, columns)] == ["", "hidden", "doubtful"]
    assert [line.doubt for line in kerb_edge_lines(lines, {}, {"kind": ["kerb"] * 3})] == [""] * 3


@pytest.mark.parametrize(("stop", "cuts"), [
    ([(8.0, -4.0), (8.0, 0.0)], 1), ([(21.0, -4.0), (21.0, 0.0)], 0), ([(8.0, -4.0), (8.0, 0.0), (8.0, -4.0)], 0)],
    ids=["before the junction", "beyond the end of the road", "back to its begin"])
def test_only_a_stop_line_on_the_road_cuts_it(stop, cuts):
    cross = shapely.union(shapely.box(-20, -4, 20, 4), shapely.box(-4, -20, 4, 20))
    found = junction_cuts(cross, [shapely.LineString(stop)])
    assert len(found.junctions) == 1 and sum(cut.at_stop_line for cut in found.cuts) == cuts


def test_findings_are_drawn_at_their_places():
    findings = [RoadFinding("a", "", 110.0, 240.0), RoadFinding("b", "", 900.0, 240.0)]
    drawn = plan_picture((100.0, 200.0, 140.0, 260.0), 400, [], [], findings)
    assert drawn.count("<circle") == 1 and '<circle cx="100.0" cy="200.0"' in drawn and ">1</text>" in drawn
