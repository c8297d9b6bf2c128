"""Lines, crosswalks and symbols from marking polygons that are drawn here, whole, worn and curved."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
import shapely.affinity
from shapely import affinity

from urbanmap_qgis.mobile.registration.matching.subpixel import MarkingField, field_terms
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.roadmap.lines.crosswalks import find_crosswalks
from urbanmap_qgis.roadmap.lines.dash_consensus import with_common_patterns
from urbanmap_qgis.roadmap.lines.dash_pattern import Section, line_sections
from urbanmap_qgis.roadmap.lines.line_chains import StrokeChain
from urbanmap_qgis.roadmap.lines.line_fit import fit_centre_line
from urbanmap_qgis.roadmap.lines.line_width import line_widths
from urbanmap_qgis.roadmap.lines.line_work import line_work, with_ground_heights
from urbanmap_qgis.roadmap.lines.short_lines import supported_chains
from urbanmap_qgis.roadmap.lines.strokes import all_strokes, polygon_strokes
from urbanmap_qgis.roadmap.lines.symbol_patterns import CELL, raster


def dashes(length, dash, gap, y=0.0, start=0.0):
    return [shapely.box(x, y - 0.075, x + dash, y + 0.075) for x in np.arange(start, length - dash, dash + gap)]


def placed(shapes, angle=23.0, offset=(-7000.0, -34000.0)):
    """Shapes turned and moved to where maps have their coordinates."""
    return [affinity.translate(affinity.rotate(shape, angle, origin=(0, 0)), *offset) for shape in shapes]


def back(points, angle=23.0, offset=(-7000.0, -34000.0)):
    moved = affinity.rotate(affinity.translate(shapely.LineString(points[:, :2]), -offset[0], -offset[1]), -angle,
                            origin=(0, 0))
    return shapely.get_coordinates(moved)


def work_of(shapes, colours=None):
    return line_work(placed(shapes), colours or ["white"] * len(shapes))


def test_straight_rectangle_is_one_stroke_with_its_axis_and_width():
    (stroke,) = polygon_strokes(placed([shapely.box(0, -0.075, 9, 0.075)])[0])
    ends = back(stroke.axis)
    assert np.allclose(np.sort(ends[:, 0]), [0.0, 9.0], atol=1e-6)
    assert np.allclose(ends[:, 1], 0.0, atol=1e-6)
    assert stroke.width == pytest.approx(0.15, abs=1e-6)


def test_stop_line_that_touches_an_edge_line_is_a_stroke_of_its_own():
    joined = shapely.union_all([shapely.box(0, -0.075, 12, 0.075), shapely.box(11.55, 0, 12, 3.2)])
    strokes = polygon_strokes(placed([joined])[0])
    lengths = sorted(stroke.length for stroke in strokes if stroke.length > 1.0)
    assert len(lengths) == 2
    assert lengths[1] == pytest.approx(11.8, abs=0.3) and lengths[0] == pytest.approx(3.0, abs=0.3)


def test_dashes_are_one_line_with_period_and_ends():
    (line,) = work_of(dashes(60.0, 3.0, 4.5)).lines
    assert line.kind == "dashed"
    assert line.period == pytest.approx(7.5, abs=0.05) and line.dash == pytest.approx(3.0, abs=0.15)
    assert len(line.dashes) == 8
    assert np.allclose(np.diff(line.dashes, axis=1), 3.0, atol=0.12)
    assert np.abs(back(line.points)[:, 1]).max() < 0.005
    assert line.bridged < 0.5


def test_missing_dash_is_bridged_and_told():
    (line,) = work_of([dash for k, dash in enumerate(dashes(75.0, 3.0, 4.5)) if k != 4]).lines
    assert line.kind == "dashed" and line.plan.length == pytest.approx(70.5, abs=0.3)
    assert line.bridged == pytest.approx(3.0, abs=0.6)


def test_dashes_of_a_motorway_keep_no_phase_and_are_one_dashed_line():
    starts = np.arange(45) * 12.0 + np.cumsum(np.random.default_rng(3).normal(0.0, 0.12, 45))
    (line,) = work_of([shapely.box(x, -0.075, x + 2.6, 0.075) for x in starts]).lines
    assert line.kind == "dashed" and len(line.dashes) == 45
    assert line.period == pytest.approx(12.0, abs=0.15) and line.dash == pytest.approx(2.6, abs=0.15)


def test_worn_end_of_a_dash_is_placed_by_its_neighbours_and_marked():
    boxes = dashes(60.0, 3.0, 4.5)
    boxes[3] = shapely.box(22.5, -0.075, 24.3, 0.075)
    boxes[5] = shapely.box(38.2, -0.075, 40.5, 0.075)
    (line,) = work_of(boxes).lines
    assert line.dashes == pytest.approx(np.arange(0, 60 - 3, 7.5)[:, None] + [[0, 3]], abs=0.06)
    assert np.array(line.placed) == pytest.approx([25.5, 37.5], abs=0.06)


def test_end_is_left_where_no_whole_dashes_tell():
    lengths = (3, 2, 2.6, 1.6, 2.3)
    boxes = [shapely.box(7.5 * k, -0.075, 7.5 * k + length, 0.075) for k, length in enumerate(lengths)]
    assert all(not line.placed for line in work_of(boxes).lines)


def test_worn_solid_line_stays_solid_and_its_gaps_are_told():
    rng = np.random.default_rng(4)
    starts = np.cumsum(rng.uniform(2.0, 6.0, 14))
    pieces = [shapely.box(a, -0.075, b - gap, 0.075)
              for a, b, gap in zip(starts[:-1], starts[1:], rng.uniform(0.3, 1.6, 13))]
    (line,) = work_of(pieces).lines
    assert line.kind == "solid"
    painted = sum(shapely.length(piece) / 2 - 0.15 for piece in pieces)
    assert line.bridged == pytest.approx(line.plan.length - painted, abs=1.5)


def test_solid_stretch_before_the_stop_line_is_a_section_that_meets_the_dashes():
    shapes = [*dashes(50.0, 3.0, 4.5), shapely.box(52.5, -0.075, 61.5, 0.075)]
    lines = sorted(work_of(shapes).lines, key=lambda line: back(line.points)[:, 0].min())
    assert [line.kind for line in lines] == ["dashed", "solid"]
    assert lines[0].chain == lines[1].chain
    ends = np.array([line.points[[0, -1], :2] for line in lines])
    assert np.linalg.norm(ends[0][:, None] - ends[1][None], axis=2).min() < 0.01


def test_curved_line_stays_within_two_centimetres_of_its_arc():
    radius = 40.0
    arc = shapely.LineString([(radius * np.sin(t), radius * (1 - np.cos(t))) for t in np.linspace(0, 1.2, 200)])
    (line,) = work_of([arc.buffer(0.075, cap_style="flat")]).lines
    points = back(shapely.get_coordinates(line.plan.segmentize(0.2)))
    off = np.abs(np.hypot(points[:, 0], points[:, 1] - radius) - radius)
    assert off.max() < 0.02


def test_edge_line_that_goes_on_through_bends_is_a_line_however_long_and_a_bright_yard_is_none():
    """420 m of paint, 63 m2 in one piece."""
    along = np.linspace(0, 420, 600)
    course = shapely.LineString(np.column_stack([along, 30 * np.sin(along / 60)]))
    yard = shapely.Point(200, 80).buffer(5.0).union(shapely.box(200, 79, 212, 81))
    lines = work_of([course.buffer(0.075, cap_style="flat"), yard]).lines
    assert {line.kind for line in lines} == {"solid"}
    (true,) = placed([course])
    assert sum(line.plan.length for line in lines) == pytest.approx(course.length, rel=0.01)
    assert all(shapely.hausdorff_distance(line.plan, line.plan.intersection(true.buffer(0.02))) < 0.1 for line in lines)


def test_lines_beside_each_other_are_partners_of_a_double_line():
    shapes = [shapely.box(0, y - 0.075, 40, y + 0.075) for y in (0.0, 0.35)]
    pair = [line for line in work_of([*shapes, shapely.box(0, 3.425, 40, 3.575)]).lines if line.partner >= 0]
    assert len(pair) == 2 and {pair[0].partner, pair[1].partner} == {pair[0].chain, pair[1].chain}


def test_zebra_is_a_crosswalk_with_its_bounds_and_lines_do_not_run_through():
    bars = [shapely.box(20.0, y, 24.0, y + 0.45) for y in np.arange(-4.0, 4.0, 0.9)]
    lines = [shapely.box(a, -0.075, b, 0.075) for a, b in ((0.0, 18.0), (26.0, 44.0))]
    work = work_of([*bars, *lines])
    (zebra,) = [area for area in work.areas if area.kind == "crosswalk"]
    truth = placed([shapely.box(20.0, -4.0, 24.0, 3.65)])[0]
    assert zebra.polygon.intersection(truth).area / zebra.polygon.union(truth).area > 0.95
    assert len(work.lines) == 2


def test_three_bars_or_bars_at_random_distances_are_no_crosswalk():
    places = np.cumsum([0.0, 0.7, 1.7, 1.0, 1.4, 0.75, 1.65, 0.9, 1.3])
    few = [shapely.box(0, y, 4.0, y + 0.45) for y in (0.0, 0.9, 1.8)]
    at_random = [shapely.box(0, y, 4.0, y + 0.3) for y in places]
    assert find_crosswalks(all_strokes(few), few) == []
    assert find_crosswalks(all_strokes(at_random), at_random) == []


def zebra_of(bars):
    return [area for area in work_of(bars).areas if area.kind == "crosswalk"]


def overlap(one, other):
    return one.intersection(other).area / one.union(other).area


def test_bars_cut_by_a_shadow_are_one_crosswalk_of_their_whole_length():
    lit = [shapely.box(0.0, y, 1.5, y + 0.45) for y in np.arange(-4.0, 4.0, 0.9)]
    shaded = [shapely.box(1.7, y, 4.0, y + 0.45) for y in np.arange(-4.0, 4.0, 0.9)]
    (zebra,) = zebra_of([*lit, *shaded])
    assert overlap(zebra.polygon, placed([shapely.box(0.0, -4.0, 4.0, 3.65)])[0]) > 0.9


def test_worn_bars_are_counted_and_hidden_ones_bridged():
    whole = [shapely.box(0.0, y, 4.0, y + 0.45) for y in np.arange(0.0, 12.0, 0.9)]
    flakes = [shapely.box(x, y, x + 0.9, y + 0.4) for y in np.arange(2.7, 4.5, 0.9) for x in (0.3, 2.2)]
    (zebra,) = zebra_of([*whole[:3], *flakes, *whole[7:]])
    assert overlap(zebra.polygon, placed([shapely.box(0.0, 0.0, 4.0, 12.15)])[0]) > 0.9
    assert zebra.score < 0.9


def test_strip_some_way_beyond_the_bars_is_no_part_of_the_crosswalk():
    bars = [shapely.box(0.0, y, 4.0, y + 0.45) for y in np.arange(0.0, 8.0, 0.9)]
    (zebra,) = zebra_of([*bars, shapely.box(-20.0, 10.8, 20.0, 11.1)])
    assert overlap(zebra.polygon, placed([shapely.box(0.0, 0.0, 4.0, 7.65)])[0]) > 0.9


def test_bar_across_the_end_of_lines_is_a_stop_line_one_across_their_course_is_not():
    lines = [shapely.box(0, y - 0.075, 40, y + 0.075) for y in (0.0, 3.25)]
    work = work_of([*lines, shapely.box(40.3, 0.1, 40.75, 3.1), shapely.box(20.0, -1.0, 20.5, 6.0)])
    (stop,) = [line for line in work.lines if line.kind == "stop line"]
    assert back(stop.points)[:, 0] == pytest.approx(40.525, abs=0.03)
    assert stop.width == pytest.approx(0.45, abs=0.03)


def test_stop_line_that_lane_lines_and_wear_cut_is_one():
    lines = [shapely.box(0, y - 0.075, 40, y + 0.075) for y in (0.0, 3.25, 6.5)]
    work = work_of([*lines, shapely.box(40.3, 0.1, 40.75, 3.1), shapely.box(40.3, 3.4, 40.75, 6.4)])
    (stop,) = [line for line in work.lines if line.kind == "stop line"]
    assert np.ptp(back(stop.points)[:, 1]) == pytest.approx(6.3, abs=0.1)
    assert 0.6 < stop.confidence <= 0.7


def test_worn_stop_line_in_narrow_and_slanting_pieces_is_one():
    lines = [shapely.box(0, y - 0.075, 40, y + 0.075) for y in (0.0, 3.25)]
    pieces = [affinity.rotate(shapely.box(40.3, 0.15, 40.7, 1.55), 6.0), shapely.box(40.45, 1.8, 40.65, 2.3),
              affinity.rotate(shapely.box(40.3, 2.45, 40.65, 3.15), -4.0)]
    (stop,) = [line for line in work_of([*lines, *pieces]).lines if line.kind == "stop line"]
    assert np.ptp(back(stop.points)[:, 1]) == pytest.approx(3.0, abs=0.15)
    assert back(stop.points)[:, 0] == pytest.approx(40.5, abs=0.12)
    assert not [line for line in work_of([*lines, *pieces[1:2], pieces[2]]).lines if line.kind == "stop line"]


def test_a_piece_beside_a_worn_stop_line_does_not_shorten_it_and_one_across_does_not_lengthen_it():
    lines = [shapely.box(0, y - 0.075, 40, y + 0.075) for y in (0.0, 3.25)]
    pieces = [shapely.box(40.3, 0.15, 40.6, 3.1), shapely.box(40.63, 0.6, 40.75, 1.6),
              shapely.box(40.2, 3.6, 40.6, 3.7)]
    (stop,) = [line for line in work_of([*lines, *pieces]).lines if line.kind == "stop line"]
    assert np.ptp(back(stop.points)[:, 1]) == pytest.approx(2.95, abs=0.1)


def test_stop_line_before_a_crosswalk_needs_no_line_and_a_short_bar_alone_is_none():
    bars = [shapely.box(20.0, y, 24.0, y + 0.45) for y in np.arange(-4.0, 4.0, 0.9)]
    (stop,) = work_of([*bars, shapely.box(17.5, -3.8, 17.95, -0.4)]).lines
    assert stop.kind == "stop line" and stop.confidence == pytest.approx(0.7, abs=0.02)
    lines = [shapely.box(0, y - 0.075, 40, y + 0.075) for y in (0.0, 3.25)]
    assert all(line.kind == "solid" for line in work_of([*lines, shapely.box(40.3, 0.5, 40.75, 2.2)]).lines)


def arrow(kind):
    """Arrows as drawn in a Japanese street, tail at 0, 0, read along x."""
    if kind == "straight":
        ring = [(-0.075, 0), (0.075, 0), (0.075, 3.2), (0.35, 3.2), (0, 5), (-0.35, 3.2), (-0.075, 3.2)]
    else:
        ring = [(0.375, 0), (0.525, 0), (0.525, 3.6), (-0.1, 3.6), (-0.1, 4.1), (-0.75, 3.4), (-0.1, 2.7), (-0.1, 3.2),
                (0.375, 3.2)]
    shape = shapely.Polygon(ring)
    return affinity.rotate(affinity.scale(shape, -1, 1, origin=(0, 0)) if kind == "right" else shape, -90,
                           origin=(0, 0))


@pytest.mark.parametrize("kind", ["straight", "left", "right"])
def test_arrow_is_known_by_kind_and_heading(kind):
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-1.6, 1.6)]
    work = work_of([*lines, arrow(kind)])
    (area,) = work.areas
    assert area.kind == f"arrow {kind}"
    assert area.heading == pytest.approx([np.cos(np.radians(23)), np.sin(np.radians(23))], abs=0.02)


@pytest.mark.parametrize("kind", ["straight", "left", "right"])
def test_arrow_whose_shaft_is_worn_off_its_head_is_known_and_a_bar_beside_it_stays_out(kind):
    """The shaft alone is a straight bar, as a dash is."""
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-1.6, 1.6)]
    worn = shapely.get_parts(arrow(kind).difference(shapely.box(2.35, -2, 2.65, 2)))
    dash = shapely.box(-1, 1.0, 2, 1.15)
    (area,) = [area for area in work_of([*lines, dash, *worn]).areas if area.kind != "unknown"]
    assert area.kind == f"arrow {kind}"
    assert area.heading == pytest.approx([np.cos(np.radians(23)), np.sin(np.radians(23))], abs=0.02)
    assert area.polygon.area == pytest.approx(shapely.union_all(worn).area, rel=0.02)


def test_worn_pieces_of_an_arrow_without_a_whole_head_are_an_arrow():
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-1.6, 1.6)]
    scratches = [shapely.box(x, -2, x + 0.12, 2) for x in np.arange(0.5, 5.0, 0.42)]
    worn = shapely.get_parts(arrow("straight").difference(shapely.union_all(scratches)).difference(
        shapely.box(3.0, -0.04, 5.0, 0.04)))
    (area,) = [area for area in work_of([*lines, *worn]).areas if area.kind != "unknown"]
    assert area.kind in ("arrow straight", "arrow, kind unknown")  # so much is bare that a head may be
    assert area.heading == pytest.approx([np.cos(np.radians(23)), np.sin(np.radians(23))], abs=0.02)


def worn_arrow(y):
    """An arrow in the lane at y with one side of its head and most of its shaft left."""
    return list(shapely.get_parts(affinity.translate(arrow("straight").difference(shapely.union_all([
        shapely.box(1.0, -1, 1.6, 1), shapely.box(2.9, -1, 6, -0.02)])), 0.0, y)))


def test_worn_arrow_is_known_in_a_row_with_another_one_only():
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-4.85, -1.6, 1.6)]
    along = pytest.approx([np.cos(np.radians(23)), np.sin(np.radians(23))], abs=0.02)
    alone, in_row, before = ([area for area in work_of([*lines, *worn_arrow(-3.25), *more]).areas
                              if area.kind.startswith("arrow")]
                             for more in ([], [arrow("straight")], [affinity.translate(arrow("straight"), 3.0)]))
    assert not alone and [area.kind for area in before] == ["arrow straight"]
    assert sorted(area.kind for area in in_row) == ["arrow straight", "arrow, kind unknown"]
    assert all(area.heading == along for area in in_row)


def test_worn_edge_line_beside_a_row_of_arrows_is_no_arrow():
    """What is left of it has a wide place, as one side of a head; but it is longer than an arrow."""
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-1.6, 1.6)]
    (left,) = [piece for piece in worn_arrow(-3.25) if piece.bounds[2] > 4.0]
    for begin, end, found in ((0.0, 5.0, 2), (-2.5, 7.0, 1)):
        edge = shapely.union(left, shapely.box(begin, -3.325, end, -3.175))
        areas = work_of([*lines, arrow("straight"), edge]).areas
        assert len([area for area in areas if area.kind.startswith("arrow")]) == found


def repeated(*lanes):
    """Arrows 14 m from each other in the lanes at y, the later one as given, and the lines of the lanes."""
    lines = [shapely.box(-20, y - 0.075, 50, y + 0.075) for y in (-14.6, -11.35, -4.85, -1.6, 1.6, 4.85)]
    drawn = [affinity.translate(shape, x, y) for y, *pair in lanes for x, shape in zip((0.0, 14.0), pair)]
    return [*lines, *(part for shape in drawn for part in shapely.get_parts(shape))]


HEADLESS = arrow("straight").difference(shapely.union_all([
    shapely.box(1.0, -1, 1.5, 1), shapely.box(3.1, 0.1, 6, 1), shapely.box(3.1, -1, 6, -0.1)]))
"""What is left of an arrow without the sides of its head."""


def test_arrow_without_a_head_is_known_where_it_repeats_a_sure_one_as_others_are_repeated():
    whole, along = arrow("straight"), pytest.approx([np.cos(np.radians(23)), np.sin(np.radians(23))], abs=0.02)
    others = [(0.0, whole, whole), (-3.25, whole, whole)]
    for pair, steps, told in (((whole, HEADLESS), others, 6), ((whole, HEADLESS), [], 1),
                              ((HEADLESS, HEADLESS), others, 4)):
        areas = [area for area in work_of(repeated(*steps, (-13.0, *pair))).areas if area.kind.startswith("arrow")]
        assert len(areas) == told and all(area.kind == "arrow straight" for area in areas)
        assert all(area.heading == along for area in areas)


def test_an_open_kind_is_that_of_the_arrow_that_it_repeats():
    worn = broad("straight left").difference(shapely.box(0.9, -2, 1.5, 2)).difference(shapely.box(0.9, 0.15, 2.6, 2))
    pairs = [(y, broad(kind), broad(kind)) for y, kind in ((0.0, "straight"), (-3.25, "straight left"))]
    kinds = [[area.kind for area in work_of(repeated(*pairs, (-13.0, one, worn))).areas if area.kind.startswith("arrow")
              and back(shapely.get_coordinates(area.polygon))[0, 1] < -10.0] for one in (broad("straight left"), worn)]
    assert kinds == [["arrow straight left"] * 2, ["arrow, kind unknown"] * 2]


def test_bar_without_a_head_is_no_arrow_in_a_row():
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-4.85, -1.6, 1.6)]
    work = work_of([*lines, arrow("straight"), shapely.box(0.0, -3.33, 3.4, -3.17)])
    assert [area.kind for area in work.areas if area.kind.startswith("arrow")] == ["arrow straight"]


@pytest.mark.parametrize("length, half", [(2.6, 0.4), (2.8, 0.45), (2.6, 0.35)])
def test_a_wedge_of_light_between_shadows_is_no_arrow(length, half):
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-1.6, 1.6)]
    wedge = shapely.Polygon([(0, -0.03), (0, 0.03), (0.9 * length, half), (length, 0.9 * half), (length, -0.8 * half),
                             (0.92 * length, -half)])
    assert not any(area.kind.startswith("arrow") for area in work_of([*lines, wedge]).areas)


def test_yellow_paint_is_no_arrow():
    """Worn paving for the blind may have the shape of one."""
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-1.6, 1.6)]
    for colour, found in (("yellow", []), ("white", ["arrow straight"]), ("", ["arrow straight"])):
        work = work_of([*lines, arrow("straight")], ["white", "white", colour])
        assert [area.kind for area in work.areas if area.kind.startswith("arrow")] == found


@pytest.mark.parametrize("colour", ["yellow", "white"])
def test_a_wide_yellow_line_between_lines_of_the_road_is_no_guiding_strip_and_one_beside_them_is(colour):
    """The image's blur makes a centre line of 0.2 m as wide as 0.27 m."""
    edges = [shapely.box(-20, y - 0.1, 30, y + 0.1) for y in (-6.0, 6.0)]
    centre, strip = (shapely.box(-20, y - width / 2, 30, y + width / 2) for y, width in ((0.0, 0.27), (9.0, 0.36)))
    work = work_of([*edges, centre, strip], ["white", "white", colour, colour])
    kinds = {round(back(line.points[:, :2])[:, 1].mean()): line.kind for line in work.lines}
    assert kinds == {-6: "solid", 0: "solid", 6: "solid", 9: "guiding strip" if colour == "yellow" else "solid"}


BROAD = {"straight": [(0.085, 0), (0.085, 3), (0.45, 3), (0, 5), (-0.45, 3), (-0.085, 3), (-0.085, 0)],
         "straight left": [(0.085, 0), (0.085, 3), (0.45, 3), (0, 5), (-0.45, 3), (-0.085, 3), (-0.085, 1.785),
                           (-0.455, 1.93), (-0.455, 2.44), (-1.15, 1.94), (-0.455, 0.94), (-0.455, 1.43), (-0.09, 1.24),
                           (-0.085, 0)]}


def broad(kind, x=0.0):
    return affinity.translate(affinity.rotate(shapely.Polygon(BROAD[kind]), -90, origin=(0, 0)), x)


@pytest.mark.parametrize("kind", list(BROAD))
def test_broad_arrow_is_known_by_kind_also_where_worn(kind):
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-1.6, 1.6)]
    bare = shapely.union_all([shapely.box(x, -2, x + 0.3, 2) for x in (0.2, 3.4)])
    worn = shapely.get_parts(broad(kind).difference(bare))
    (area,) = [area for area in work_of([*lines, *worn]).areas if area.kind != "unknown"]
    assert area.kind == f"arrow {kind}" and 0.7 < area.score < 1.0
    assert area.heading == pytest.approx([np.cos(np.radians(23)), np.sin(np.radians(23))], abs=0.02)


@pytest.mark.parametrize("bare", [[0.9, 1.5], [1.2, 2.6]])
def test_arrow_whose_second_head_may_be_worn_away_is_of_unknown_kind(bare):
    lines = [shapely.box(-20, y - 0.075, 30, y + 0.075) for y in (-1.6, 1.6)]
    worn = broad("straight left").difference(shapely.box(bare[0], -2, bare[1], 2)).difference(
        shapely.box(0.9, 0.15, 2.6, 2))
    kinds = [area.kind for area in work_of([*lines, *shapely.get_parts(worn)]).areas if area.kind != "unknown"]
    assert kinds == ["arrow, kind unknown"]


def test_arrow_takes_no_part_in_a_line_that_it_lies_in():
    work = work_of([broad("straight"), *dashes(60.0, 3.0, 4.5, start=9.0), shapely.box(-9, 1.6, 60, 1.75)])
    assert [area.kind for area in work.areas] == ["arrow straight"]
    assert all(back(line.points)[:, 0].min() > 8.0 for line in work.lines if line.kind == "dashed")


@pytest.mark.parametrize("wide", [0.2, 0.32, 0.45])
def test_strokes_and_bars_are_no_arrows(wide):
    edge = shapely.box(-20, 1.6, 60, 1.75)
    ragged = shapely.union_all([shapely.box(0, 0, 4.6, wide), shapely.box(3.1, -0.06, 3.9, wide + 0.06)])
    assert not [area for area in work_of([edge, ragged]).areas if area.kind.startswith("arrow")]


def test_flakes_and_blobs_stay_unknown():
    work = work_of([shapely.Point(3, 3).buffer(0.4), shapely.box(8, 8, 10.5, 10.5)])
    assert not work.lines
    assert [area.kind for area in work.areas] == ["unknown", "unknown"]


def test_heights_come_from_the_function_given():
    work = with_ground_heights(work_of(dashes(40.0, 3.0, 4.5)), lambda x, y: 10.0 + 0.01 * (x + 7000.0))
    points = work.lines[0].points
    assert np.allclose(points[:, 2], 10.0 + 0.01 * (points[:, 0] + 7000.0))


def test_nothing_covered_has_no_sections():
    assert line_sections(np.zeros(100, bool), 0.1) == []


def test_half_a_stroke_covers_a_line_and_does_not_draw_it():
    """20 m of paint 0.15 m wide along y = 0, of which the upper half is left for 4 m: its middle lies 4 cm up."""
    paint = [shapely.box(0, -0.075, 8, 0.075), shapely.box(8, 0.005, 12, 0.075), shapely.box(12, -0.075, 20, 0.075)]
    line = fit_centre_line(np.array([[0.0, 0.0], [20.0, 0.0]]), 0.15, shapely.STRtree(paint))
    assert line.covered.all() and np.abs(line.axis[:, 1]).max() < 0.005 and line.width == pytest.approx(0.15, abs=0.001)


def test_a_ring_of_paint_keeps_its_hole_and_what_lies_beside_it():
    ring = shapely.box(-1.0, -1.0, 1.0, 1.0).difference(shapely.box(-0.5, -0.5, 0.5, 0.5))
    bar = shapely.box(2.0, -1.0, 2.5, 1.0)
    for shapes in ([ring], [bar, ring], [ring, bar]):
        assert raster(shapes).sum() * CELL**2 == pytest.approx(sum(one.area for one in shapes), rel=0.1)


def test_the_gap_of_a_line_is_known_worse_than_its_paint():
    paint = shapely.STRtree([shapely.box(0.0, -0.075, 15.0, 0.075), shapely.box(27.0, -0.075, 42.0, 0.075)])
    found = fit_centre_line(np.array([[0.0, 0.0], [42.0, 0.0]]), 0.15, paint)
    gap = (found.chainage > 20.0) & (found.chainage < 22.0)
    assert not found.covered[gap].any() and found.sigma[gap].min() > 0.03
    assert found.sigma[(found.chainage > 3.0) & (found.chainage < 12.0)].max() < 0.02


# Points on narrow reference lines count as lying on a marking, whatever the blur of the coverage


@pytest.mark.parametrize("blur", [0.0, 0.05, 0.15])
@pytest.mark.parametrize("width", [0.1, 0.15, 0.3, 0.5])
def test_points_on_and_beside_a_line(width, blur):
    line = shapely.LineString([(0.03, 0.02), (30.0, 7.3)]).buffer(width / 2, cap_style="flat")
    coverage = Reference.from_polygons([line]).coverage(-5.0, -5.0, 35.0, 15.0)
    field = MarkingField.of(coverage, blur, 0.05)
    along, normal = np.array([29.97, 7.28]) / np.hypot(29.97, 7.28), np.array([-7.28, 29.97]) / np.hypot(29.97, 7.28)
    middle = np.array([0.03, 0.02]) + np.linspace(2.0, 28.0, 200)[:, None] * along
    found = field_terms(field, *middle.T).on_marking.mean()
    assert found > (0.85 if width == 0.1 else 0.95)  # 0.1 m is drawn two cells wide
    for side in (-1, 1):
        beside = middle + side * (width / 2 + 0.25 + blur) * normal
        assert not field_terms(field, *beside.T).on_marking.any()


# Widths of lines: from marking points, from lines alike, from sharp outlines, else unknown


LENGTH = 30.0


def course(north: float) -> np.ndarray:
    """A bent line of about 30 m."""
    x = np.linspace(0.0, LENGTH, 61)
    return np.column_stack([x, north + 0.004 * (x - LENGTH / 2.0) ** 2])


def points(north: float, width: float, rng: np.random.Generator, beside: float = 0.0, count: int = 1500) -> np.ndarray:
    """Marking points evenly over the paint of such a line, as a drive measures them: `beside` it and scattered."""
    x = rng.uniform(0.0, LENGTH, count)
    slope = 0.008 * (x - LENGTH / 2.0)
    across = rng.uniform(-width / 2.0, width / 2.0, count) + rng.normal(0.0, 0.004, count) + beside
    normal = np.column_stack([-slope, np.ones(count)]) / np.hypot(1.0, slope)[:, None]
    return np.column_stack([x, north + 0.004 * (x - LENGTH / 2.0) ** 2]) + across[:, None] * normal


@pytest.mark.parametrize("width", [0.10, 0.15, 0.20, 0.45])
def test_points_of_two_drives_tell_the_width_that_outlines_do_not(width):
    rng = np.random.default_rng(1)
    drives = [points(0.0, width, rng, 0.03), points(0.0, width, rng, -0.03, 3000)]
    ((found, sigma),) = line_widths([course(0.0)], np.array([width + 0.05]), np.array([0.03]), drives)
    assert found == pytest.approx(width, abs=0.01) and abs(found - width) <= 2.0 * sigma <= 0.06


def test_ragged_outlines_alone_tell_no_width_and_sharp_ones_do():
    found = line_widths([course(0.0), course(4.0)], np.array([0.19, 0.15]), np.array([0.03, 0.002]), [])
    assert np.isnan(found[0]).all() and found[1] == pytest.approx([0.15, 0.002])


def test_a_line_without_points_is_as_wide_as_its_outlines_less_what_those_of_others_are_off_by():
    rng = np.random.default_rng(2)
    widths = [0.15, 0.15, 0.14, 0.15, 0.16, 0.15]
    outlined = np.array(widths) + 0.04
    drive = np.concatenate([points(4.0 * k, width, rng) for k, width in enumerate(widths[:5])])
    lines = [course(4.0 * k) for k in range(6)]
    found = line_widths(lines, outlined, np.full(6, 0.03), [drive])
    assert found[5, 0] == pytest.approx(0.15, abs=0.01) and found[5, 1] < 0.03
    # Too few lines alike say nothing of another: nor do lines of another width.
    assert np.isnan(line_widths(lines[2:], outlined[2:], np.full(4, 0.03), [drive])[3, 0])
    outlined[5] = 0.30
    assert np.isnan(line_widths(lines, outlined, np.full(6, 0.03), [drive])[5, 0])


@pytest.mark.parametrize("drive", [points(0.0, 0.15, np.random.default_rng(3), count=60),
                                   points(0.0, 1.5, np.random.default_rng(4), count=8000), np.zeros((0, 2))],
                         ids=["few", "surface", "none"])
def test_points_that_show_no_edges_tell_no_width(drive):
    assert np.isnan(line_widths([course(0.0)], np.array([0.19]), np.array([0.03]), [drive])).all()


def test_drives_that_disagree_are_no_sure_width():
    rng = np.random.default_rng(5)
    drives = [points(0.0, 0.12, rng), points(0.0, 0.24, rng)]
    ((found, sigma),) = line_widths([course(0.0)], np.array([0.2]), np.array([0.03]), drives)
    assert np.isnan(found) or 2.0 * sigma > 0.05


# Short pieces of lines beside sure ones: which are lines


ROAD = [np.array([(0.0, y), (50.0, y)]) for y in (0.0, 3.5, 7.0)]
WIDTHS = [0.15] * 3


def piece(x0, y0, x1, y1, painted=None, width=0.15):
    length = float(np.hypot(x1 - x0, y1 - y0))
    return StrokeChain(np.array([(x0, y0), (x1, y1)], float), [0], length if painted is None else painted, width)


def is_line(one, axes=ROAD, widths=WIDTHS):
    return supported_chains([one], axes, widths) == [one]


def test_piece_at_the_width_of_the_lanes_beside_is_a_line():
    assert is_line(piece(20, 10.5, 23, 10.5))


@pytest.mark.parametrize("one", [
    piece(20, 10.0, 23, 10.0),  # at no width that lanes have here
    piece(20, 5.25, 23, 5.25),  # between the lines of a lane: a symbol's shaft
    piece(20, 10.5, 23, 11.2),  # askew
    piece(20, 10.5, 21, 10.5),  # too little paint
    piece(20, 10.5, 30, 10.5, painted=1.6),  # scraps in a row
    piece(20, 10.5, 23, 10.5, width=0.26),  # of another width
    piece(20, 40.0, 23, 40.0),  # far from all lines
], ids=["width", "within", "askew", "little", "scraps", "broad", "far"])
def test_other_pieces_are_none(one):
    assert not is_line(one)


def test_piece_that_continues_a_line_is_one_near_its_end_only():
    assert is_line(piece(55, 3.5, 58, 3.5))
    assert not is_line(piece(80, 3.5, 83, 3.5))


def test_one_line_alone_tells_of_no_width():
    assert not is_line(piece(20, 3.5, 23, 3.5), ROAD[:1], WIDTHS[:1])
    assert is_line(piece(55, 0.0, 58, 0.0), ROAD[:1], WIDTHS[:1])


def test_without_sure_lines_none_is_taken():
    assert supported_chains([piece(0, 0, 3, 0)], [], []) == []


# What lines of one town say of each other's dashes, and lines that are large because they are long


def dashed(starts, lengths, period, dash):
    runs = np.column_stack([starts, np.add(starts, lengths)]).astype(float)
    return Section(runs[0, 0], runs[-1, 1], "dashed", runs, period, dash, 0.8)


def regular(count=6, period=7.5, dash=3.0):
    rng = np.random.default_rng(3)
    return dashed(np.arange(count) * period + rng.normal(0, 0.05, count), dash + rng.normal(0, 0.05, count), period,
                  dash)


WORN = dashed([0, 2.1, 7.5, 13.1, 14.5], [1.0, 4.3, 5.0, 0.6, 4.4], 5.3, 4.0)
"""A solid line with gaps worn into it, which a pattern of its own explained well enough."""


def test_worn_edge_is_solid_beside_regular_dashes():
    sections = with_common_patterns([[regular()], [WORN]])
    assert [one.kind for one in sections[0]] == ["dashed"] and [one.kind for one in sections[1]] == ["solid"]
    assert sections[0][0].period == pytest.approx(7.5) and len(sections[0][0].dashes) == 6
    assert (sections[1][0].start, sections[1][0].end) == (WORN.start, WORN.end)


def test_worn_edge_alone_is_solid_too():
    assert [one.kind for one in with_common_patterns([[WORN]])[0]] == ["solid"]


def test_line_that_is_solid_before_and_dashed_behind_is_cut_where_it_changes():
    starts, lengths = [0.0, 9.7, 12.0, 17.0, 24.5, 32.0, 39.5], [8.8, 1.8, 4.4, 3.0, 2.9, 3.1, 3.0]
    mixed = dashed(starts, lengths, 14.6, 8.0)
    found = with_common_patterns([[regular()], [mixed]])[1]
    assert [one.kind for one in found] == ["solid", "dashed"]
    assert found[1].dashes[:, 0].tolist() == starts[3:] and found[1].period == pytest.approx(7.5)


def test_worn_dash_in_step_stays_a_dash():
    starts, lengths = [0.0, 7.5, 15.4, 22.5, 30.0], [3.0, 3.0, 1.2, 3.0, 3.0]
    found = with_common_patterns([[dashed(starts, lengths, 7.5, 3.0)]])[0]
    assert [one.kind for one in found] == ["dashed"] and len(found[0].dashes) == 5


def test_solid_lines_and_two_dashes_stay_as_they_are():
    solid = Section(0.0, 50.0, "solid", np.array([[0.0, 50.0]]), np.nan, np.nan, 1.0)
    pair = dashed([0.0, 8.0], [3.0, 2.9], 8.0, 3.0)
    found = with_common_patterns([[solid], [pair]])
    assert [one.kind for one in found[0]] == ["solid"] and [one.kind for one in found[1]] == ["dashed"]


def test_long_curved_line_gives_its_stroke_and_a_bright_yard_none():
    turn = np.linspace(0.0, 1.05, 200)
    arc = shapely.LineString(400.0 * np.column_stack([np.sin(turn), 1.0 - np.cos(turn)]))
    longest = polygon_strokes(arc.buffer(0.075, cap_style="flat"))[0]
    assert longest.polygon == 0 and 400.0 * 1.05 * 0.15 > 60.0
    assert longest.length == pytest.approx(420.0, abs=1.0) and longest.width == pytest.approx(0.15, abs=0.02)
    yard = shapely.box(0, 0, 12, 10).difference(shapely.box(4, 4, 6, 6))
    assert polygon_strokes(yard) == []
