"""Sides shorter than city models have them, taken out of surfaces that share them."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.core.surveyed_scene import crossing, edge, official, road_height
from urbanmap_qgis.geometry.short_sides import SHORTEST, without_short_edges, without_short_sides
from urbanmap_qgis.roadspace.survey.area_records import LANE
from urbanmap_qgis.roadspace.survey.survey_roads import SurveyInputs, surveyed_roads


def shortest_side(polygons):
    rings = [shapely.get_coordinates(ring) for polygon in polygons for ring in (polygon.exterior, *polygon.interiors)]
    return min(float(np.hypot(*np.diff(ring, axis=0).T).min()) for ring in rings)


def test_corners_a_few_millimetres_apart_become_one_in_all_that_share_them():
    left = shapely.Polygon([(0, 0), (4, 0), (4, 2), (4, 2.004), (4, 5), (0, 5)])
    right = shapely.Polygon([(4, 0), (8, 0), (8, 5), (4, 5), (4, 2.004), (4, 2)])
    beside = shapely.Polygon([(10, 0), (11, 0), (11, 1)])
    made = without_short_sides([left, right, beside])
    assert shortest_side(made) >= 1.0 and made[2] is beside
    assert shapely.union_all(made[:2]).area == shapely.area(made[:2]).sum() == 40.0


def test_a_dense_curve_keeps_its_shape():
    angle = np.linspace(0.0, 2.0 * np.pi, 3000)[:-1]
    circle = shapely.Polygon(2.0 * np.column_stack([np.cos(angle), np.sin(angle)]))
    (made,) = without_short_sides([circle])
    assert shortest_side([made]) >= SHORTEST
    assert shapely.hausdorff_distance(made, circle) < SHORTEST


def test_what_would_be_nothing_is_left():
    sliver = shapely.Polygon([(0, 0), (5, 0), (5, 0.004)])
    assert without_short_sides([sliver]) == [sliver]


def test_a_hole_of_which_nothing_is_left_goes():
    """Three lines met in a triangle of millimetres: the other corners of the surface round it kept theirs too."""
    hole = [(2, 2), (2.001, 2), (2.001, 2.001)]
    (made,) = without_short_sides([shapely.Polygon([(0, 0), (4, 0), (4, 4), (4, 4.004), (0, 4)], [hole])])
    assert not made.interiors and shortest_side([made]) > 3.0


def test_a_needle_between_two_others_goes_into_them():
    """A lane reaches 9 m between an island and the next lane, 8 mm wide at its root."""
    tip, upper, lower = (-9.0, -1.0), (0.0, 0.0), (0.006, -0.006)
    lane = shapely.Polygon([tip, lower, (3, -0.2), (3, 0.2), upper])
    next_lane = shapely.Polygon([tip, upper, (3, 0.2), (3, 4), (-9, 4)])
    island = shapely.Polygon([tip, (-9, -4), (3, -4), (3, -0.2), lower])
    made = without_short_sides([lane, next_lane, island])
    places = shapely.get_coordinates(made[0].exterior)[:-1]
    assert len(places) == 3 and np.hypot(*(places[:, None] - places[None])[np.triu_indices(3, 1)].T).min() > 0.3
    assert shapely.union_all(made).area == pytest.approx(shapely.area(made).sum(), abs=1e-12)
    assert shapely.union_all(made).equals(shapely.union_all([lane, next_lane, island]))


def test_a_face_of_a_centimetre_goes_into_those_beside_it():
    below, strip, above = shapely.box(0, 0, 5, 2), shapely.box(0, 2, 5, 2.01), shapely.box(0, 2.01, 5, 4)
    one, gone, other = without_short_edges([below, strip, above])
    assert gone is None and shapely.union_all([one, other]).area == one.area + other.area == 20.0
    assert without_short_edges([below]) == [below]


def test_faces_that_would_lie_over_each_other_stay():
    """One has a corner on the other's side, which turns when its end goes a centimetre down."""
    end, near = (5, -1), (5, -1.01)
    faces = [shapely.Polygon([(0, 0), (5, 0), end, (0, -1)]),
             shapely.Polygon([(0, -1), (2.5, -1), end, near, (5, -2), (0, -2)]),
             shapely.Polygon([(5, 0), (6, 0), (6, -1.01), near, end]),
             shapely.Polygon([near, (6, -1.01), (6, -2), (5, -2)])]
    assert without_short_edges(faces) == faces
    faces[1] = shapely.Polygon([(0, -1), end, near, (5, -2), (0, -2)])
    assert shortest_side(without_short_edges(faces)) > 0.9


def test_road_models_have_no_short_side_and_still_share_their_borders():
    """Lanes that end some millimetres beside a cut and beside each other."""
    lanes = [shapely.box(-35.0, 0.003, -18.0, 3.25), shapely.box(-35.003, -3.25, -18.004, -0.002)]
    stops = [shapely.linestrings(np.array([[-18.0, 0.0], [-18.0, 6.0]]))]
    model = surveyed_roads(crossing(), "3.3", SurveyInputs([official()], lanes, stops, road_height))
    assert model.count(LANE) == 2
    shapes = [area.polygon for area in model.areas]
    assert shortest_side([*shapes, *(piece.polygon for piece in model.pieces)]) >= SHORTEST
    assert shapely.union_all(shapes).area == pytest.approx(shapely.area(shapes).sum(), rel=1e-9)


def test_steps_lower_than_a_side_may_be_short_are_none():
    low = [edge(shapely.get_coordinates(shapely.linestrings(one.plan)), 0.008, one.chain) for one in crossing()]
    assert not surveyed_roads(low, "3.3", SurveyInputs([official()], ground=road_height)).steps


def test_strip_narrower_than_a_side_is_left_out_and_holds_no_other_back():
    """A section with a strip of 2 mm by 2 cm that its area does not have: its mouth closes, and the border does not go
    in and back; before, both kept all of their short sides."""
    area = shapely.Polygon([(0, 0), (4, 0), (4, 1), (4, 1.004), (4, 4), (2.002, 4), (2, 4), (0, 4)])
    section = shapely.Polygon([*area.exterior.coords[:6], (2.002, 4.02), (2, 4), (0, 4)])
    made = without_short_sides([section, area])
    assert all(polygon.is_valid for polygon in made) and shortest_side(made) > 0.9
    assert made[0].equals(made[1])


def test_a_corner_that_may_not_move_keeps_no_other_one():
    """Where a triangle would be nothing, what shares its corners keeps them, and loses the short side elsewhere."""
    sliver = shapely.Polygon([(4, 0), (4.004, 0), (4, 0.5)])
    beside = shapely.Polygon([(0, 0), (4, 0), (4, 0.5), (4, 5), (1.004, 5), (1, 5), (0, 5)])
    made = without_short_sides([sliver, beside])
    assert made[0] == sliver and len(made[1].exterior.coords) == len(beside.exterior.coords) - 1


@pytest.mark.parametrize("back", [[(4.006, 0)], [(4.005, 0.001), (4.006, 0)], [(4.004, 3.0), (4.006, 0)]])
def test_needles_go(back):
    """A strip of some millimetres that goes 5 m out and back again."""
    needle = shapely.Polygon([(0, 0), (4, 0), (4.003, 5), *back, (8, 0), (8, -5), (0, -5)])
    made, same = without_short_sides([needle, shapely.box(20, 0, 21, 1)])
    assert made.is_valid and made.bounds == (0, -5, 8, 0) and same.area == 1.0
    assert shortest_side([made]) > SHORTEST and made.area == pytest.approx(40.0, abs=0.01)


def test_a_part_that_hangs_on_a_neck_too_narrow_goes_where_it_is_thin():
    """The neck closes as its sides do: what is thin behind it goes, what is wide keeps the neck."""
    thin = shapely.Polygon([(0, 0), (4, 0), (4, 0.5), (4.008, 0.5), (4.004, 0), (8, 0), (8, -5), (0, -5)])
    made, = without_short_sides([thin])
    assert made.is_valid and made.bounds[3] == 0.0 and shortest_side([made]) > SHORTEST
    wide = shapely.Polygon([(0, 0), (4, 0), (3, 3), (5, 3), (4.004, 0), (8, 0), (8, -5), (0, -5)])
    kept, = without_short_sides([wide])
    assert kept.is_valid and kept.area == pytest.approx(wide.area, abs=0.02)
