"""Road surfaces cut at their junctions: crossings drawn by hand, whose cuts the working procedure tells."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate

from tests.core.surveyed_scene import HALF_EAST, HALF_NORTH, REACH, carriageway, crossing, edge, official, road_height
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.roadspace.road_cuts import cut_surface
from urbanmap_qgis.roadspace.road_model import Structures, build_road_model, with_functions
from urbanmap_qgis.roadspace.road_surface import surface_of
from urbanmap_qgis.roadspace.survey.area_records import CARRIAGEWAY, CROSSING, ISLAND, SIDEWALK, EdgeLine
from urbanmap_qgis.roadspace.survey.given_roads import laid_on_kerbs
from urbanmap_qgis.roadspace.survey.survey_roads import SurveyInputs, surveyed_roads

FAR = 60.0


def model(*shapes, **structures):
    return build_road_model(surface_of(list(shapes)), Structures(**structures))


def cuts_of(built):
    """Edges that two surfaces share, as sorted ends in centimetres."""
    polygons = [piece.polygon for piece in built.pieces]
    found = set()
    for number, one in enumerate(polygons):
        for other in polygons[number + 1:]:
            for line in shapely.get_parts(shapely.line_merge(shapely.intersection(one.boundary, other.boundary))):
                if line.length > 0:
                    ends = shapely.get_coordinates(line)[[0, -1]]
                    found.add(tuple(sorted(map(tuple, np.rint(ends * 100).astype(int).tolist()))))
    return found


def metres(*lines):
    return {tuple(sorted(tuple(round(value * 100) for value in point) for point in line)) for line in lines}


def share_all_edges(built, whole):
    """Whether the surfaces fill the whole without gap and overlap, to the bit."""
    polygons = [piece.polygon for piece in built.pieces]
    assert all(polygon.is_valid and polygon.exterior.is_ccw and polygon.area >= 0.05 for polygon in polygons)
    assert sum(polygon.area for polygon in polygons) == pytest.approx(whole.area, abs=1e-6)
    seen = {}
    for polygon in polygons:
        for ring in (polygon.exterior, *polygon.interiors):
            points = list(map(tuple, np.asarray(ring.coords)))
            for pair in zip(points, points[1:]):
                seen[pair] = seen.get(pair, 0) + 1
    assert set(seen.values()) == {1}  # no pair twice in one sense
    inner = [pair for pair in seen if (pair[1], pair[0]) in seen]
    outline = sum(shapely.length(shapely.linestrings(pair)) for pair in seen if (pair[1], pair[0]) not in seen)
    assert outline == pytest.approx(whole.length, abs=1e-6) and len(inner) % 2 == 0


def road(x0, y0, x1, y1, width):
    """A road along one axis."""
    half = width / 2
    return shapely.box(x0 - half, y0, x0 + half, y1) if x0 == x1 else shapely.box(x0, y0 - half, x1, y0 + half)


EAST_WEST = road(-FAR, 0, FAR, 0, 6)


def test_crossing_without_cut_offs_is_cut_from_corner_to_corner():
    whole = shapely.union(EAST_WEST, road(0, -FAR, 0, FAR, 4))
    built = model(whole)
    assert cuts_of(built) == metres([(-2, -3), (2, -3)], [(-2, 3), (2, 3)], [(-2, -3), (-2, 3)], [(2, -3), (2, 3)])
    junction, = (piece for piece in built.pieces if piece.kind == "junction")
    assert junction.arms == 4 and junction.status == "made" and junction.polygon.area == pytest.approx(24.0)
    assert sorted(piece.width for piece in built.pieces if piece.kind == "road") == pytest.approx([4, 4, 6, 6], rel=0.1)
    share_all_edges(built, whole)


def test_crossing_with_cut_offs_is_cut_at_their_ends():
    plus = shapely.union(EAST_WEST, road(0, -FAR, 0, FAR, 4))
    chamfers = [shapely.Polygon([(2 * a, 3 * b), (5 * a, 3 * b), (2 * a, 6 * b)]) for a in (1, -1) for b in (1, -1)]
    whole = shapely.union_all([plus, *chamfers])
    built = model(whole)
    assert cuts_of(built) == metres([(-2, -6), (2, -6)], [(-2, 6), (2, 6)], [(-5, -3), (-5, 3)], [(5, -3), (5, 3)])
    share_all_edges(built, whole)


def test_three_arms_are_cut_across_at_the_contacts():
    whole = shapely.union(EAST_WEST, shapely.box(-2, -FAR, 2, 0))
    built = model(whole)
    assert cuts_of(built) == metres([(-2, -3), (2, -3)], [(-2, -3), (-2, 3)], [(2, -3), (2, 3)])
    share_all_edges(built, whole)


def test_road_that_a_sheet_cuts_off_beside_a_junction_is_an_arm():
    """Two metres of the road to the south, and of the one to the east, are in the data."""
    whole = shapely.union_all([shapely.box(-FAR, -3, 4, 3), shapely.box(-2, -5, 2, FAR)])
    built = model(whole)
    assert cuts_of(built) == metres([(-2, -3), (2, -3)], [(-2, 3), (2, 3)], [(-2, -3), (-2, 3)], [(2, -3), (2, 3)])
    junction, = (piece for piece in built.pieces if piece.kind == "junction")
    assert junction.arms == 4 and junction.status == "made"
    share_all_edges(built, whole)


@pytest.mark.parametrize("half, depth, arms", [(2.0, 1.0, 3), (8.0, 2.0, 0), (8.0, 4.0, 0)])
def test_bay_wider_than_a_road_is_no_arm(half, depth, arms):
    whole = shapely.union(EAST_WEST, shapely.box(-half, -3 - depth, half, 0))
    built = model(whole)
    assert [piece.arms for piece in built.pieces if piece.kind == "junction"] == [arms] * (arms > 0)
    share_all_edges(built, whole)


def test_of_three_arms_the_outer_cut_is_taken():
    whole = shapely.union_all([EAST_WEST, shapely.box(-2, -FAR, 2, 0), shapely.Polygon([(2, -3), (5, -3), (2, -7)])])
    built = model(whole)
    assert cuts_of(built) == metres([(-2, -7), (2, -7)], [(-2, -3), (-2, 3)], [(5, -3), (5, 3)])
    share_all_edges(built, whole)


@pytest.mark.parametrize("angle", [17.0, 45.0, 200.0])
def test_cuts_do_not_depend_on_the_direction_of_the_roads(angle):
    whole = shapely.union(EAST_WEST, shapely.box(-2, -FAR, 2, 0))
    built = model(rotate(whole, angle, origin=(0, 0)))
    turned = [rotate(piece.polygon, -angle, origin=(0, 0)) for piece in built.pieces if piece.kind == "junction"]
    assert len(turned) == 1 and turned[0].symmetric_difference(shapely.box(-2, -3, 2, 3)).area < 0.05


def test_staggered_junctions_apart_stay_two_and_overlapping_ones_are_one():
    def staggered(apart, cut_off):
        arms = [shapely.box(-2, -FAR, 2, 0), shapely.box(apart - 2, 0, apart + 2, FAR)]
        corner = shapely.Polygon([(2, -3), (2 + cut_off, -3), (2, -3 - cut_off)])
        return model(shapely.union_all([EAST_WEST, *arms, corner]))

    apart = staggered(12.0, 2.0)
    assert apart.count("junction") == 2
    assert metres([(4, -3), (4, 3)], [(10, -3), (10, 3)]) <= cuts_of(apart)
    together = staggered(6.5, 4.0)
    assert together.count("junction") == 1 and len(together.pieces) == 5


def test_roundabout_is_cut_where_its_roads_come_in():
    ring = shapely.Point(0, 0).buffer(20, 64).difference(shapely.Point(0, 0).buffer(12, 64))
    whole = shapely.union_all([ring, *(rotate(shapely.box(14, -3, 80, 3), angle, origin=(0, 0))
                                       for angle in (0, 120, 240))])
    built = model(whole)
    assert built.count("junction") == 3 and built.count("road") == 6
    share_all_edges(built, whole)


def test_bridges_and_tunnels_are_cut_and_named():
    bridge, tunnel = shapely.box(20, -5, 32, 5), shapely.box(-40, -5, -25, 5)
    whole = shapely.union(EAST_WEST, shapely.box(-2, -FAR, 2, 0))
    built = model(whole, bridges=[bridge], tunnels=[tunnel])
    kinds = {kind: [piece for piece in built.pieces if piece.kind == kind] for kind in ("bridge", "tunnel", "road")}
    assert [len(pieces) for pieces in kinds.values()] == [1, 1, 5]
    assert kinds["bridge"][0].polygon.symmetric_difference(shapely.box(20, -3, 32, 3)).area < 1e-6
    share_all_edges(built, whole)


def test_parts_that_were_cut_elsewhere_are_dissolved_first():
    whole = shapely.union(EAST_WEST, shapely.box(-2, -FAR, 2, 0))
    parts = [shapely.intersection(whole, shapely.box(x, -FAR, x + 9, FAR)) for x in range(-63, 63, 9)]
    assert cuts_of(model(*parts)) == cuts_of(model(whole))


def test_a_square_has_no_junction_and_a_bend_none():
    assert [piece.kind for piece in model(shapely.box(0, 0, 40, 40)).pieces] == ["road"]
    bend = shapely.union(shapely.box(0, 0, 60, 6), shapely.box(0, 0, 6, 60))
    assert [piece.kind for piece in model(bend).pieces] == ["road"]


def test_middle_lines_keep_the_same_distance_from_both_edges():
    built = model(EAST_WEST)
    points = np.vstack([axis.points for axis in built.axes])
    assert np.abs(points[:, 1]).max() < 1e-6 and np.ptp(points[:, 0]) > 2 * FAR - 12


def edges_of(polygon):
    """Edges of a road surface as lines, open at the ends of the roads."""
    ends = shapely.union_all([shapely.box(FAR - 0.01, -9, FAR + 1, 9), shapely.box(-FAR - 1, -9, -FAR + 0.01, 9),
                              shapely.box(-9, -FAR - 1, 9, -FAR + 0.01)])
    return list(shapely.get_parts(shapely.line_merge(shapely.difference(polygon.boundary, ends))))


def test_lines_along_both_edges_are_closed_to_the_surface():
    whole = shapely.union(EAST_WEST, shapely.box(-2, -FAR, 2, 0))
    lines = edges_of(whole)
    assert len(lines) == 3
    surface = surface_of(lines)
    assert not surface.findings
    assert sum(one.area for one in surface.polygons) == pytest.approx(whole.area, abs=0.2)
    assert build_road_model(surface).count("junction") == 1


def test_blocks_between_roads_are_no_road():
    blocks = [shapely.box(x, y, x + 40, y + 40) for x in (3, 49) for y in (3, 49)]
    outline = shapely.box(-3, -3, 95, 95)
    surface = surface_of([outline.exterior, *(block.exterior for block in blocks)])
    assert sum(one.area for one in surface.polygons) == pytest.approx(98 * 98 - 4 * 1600)


def test_what_is_wrong_with_the_edges_is_told():
    lines = edges_of(EAST_WEST)
    surface = surface_of([*lines, shapely.LineString([(200, 0), (300, 0)])])
    assert {one.kind for one in surface.findings} == {"edge not closed"}
    bow_tie = shapely.Polygon([(0, 0), (40, 6), (40, 0), (0, 6)])
    assert [one.kind for one in surface_of([bow_tie]).findings] == ["surface repaired"]
    with pytest.raises(InputError, match="enclose no surface"):
        surface_of([shapely.LineString([(0, 0), (300, 0)])])
    with pytest.raises(InputError, match="no polygons or lines"):
        surface_of([None, shapely.Point(1, 2)])
    for bad in (np.nan, 1e308, -1e15):
        with pytest.raises(InputError, match="no numbers or off the earth"):
            surface_of([shapely.Polygon([(0, 0), (10, bad), (10, 10)])])


def test_functions_are_those_of_the_surfaces_that_cover_most():
    surfaces = [EAST_WEST, shapely.box(-2, -FAR, 2, -3), shapely.Point(0, 0)]
    built = with_functions(model(*surfaces[:2]), surfaces, ["3", "4", "2"])
    assert sorted(piece.function for piece in built.pieces) == ["3", "3", "3", "4"]
    assert {piece.function for piece in with_functions(built, surfaces, [None, "", "2"]).pieces} == {"3", "4"}


# Surfaces cut by lines: known areas, shared edges to the bit, slivers given away


SQUARE = shapely.box(0.0, 0.0, 10.0, 10.0)


def areas(pieces):
    return sorted(piece.area for piece in pieces)


def test_a_cut_keeps_its_bends():
    """Bent up by 2 m in its middle, the cut gives the lower piece a triangle of 10 m2."""
    pieces = cut_surface(SQUARE, [np.array([[0.0, 5.0], [5.0, 7.0], [10.0, 5.0]])])
    assert areas(pieces) == pytest.approx([40.0, 60.0])
    shared = shapely.intersection(*pieces)
    assert shared.length == pytest.approx(2 * np.hypot(5.0, 2.0))
    assert [5.0, 7.0] in shapely.get_coordinates(shared).tolist()


def test_ends_are_put_onto_the_boundary_and_onto_corners_near_them():
    pieces = cut_surface(SQUARE, [np.array([[0.01, -0.3], [9.99, 10.4]])])
    assert areas(pieces) == pytest.approx([50.0, 50.0])
    assert {tuple(place) for piece in pieces for place in shapely.get_coordinates(piece)} == {
        (0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)}
    assert all(piece.exterior.is_ccw for piece in pieces)


def test_a_sliver_goes_to_the_neighbour_with_the_longest_edge():
    lines = [np.array([[4.0, 0.0], [4.0, 10.0]]), np.array([[4.004, 0.0], [4.004, 10.0]])]
    assert len(cut_surface(SQUARE, lines, sliver=0.0)) == 3
    pieces = cut_surface(SQUARE, lines)
    assert len(pieces) == 2 and sum(areas(pieces)) == pytest.approx(100.0, abs=1e-9)


# A bridge over a street: its edges cross those of the street in plan


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


# Given roads a metre beside the measured kerbs, as edges of a map at 1:2500 lie


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


# Low edges of a tram's tracks amid a measured carriageway


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
