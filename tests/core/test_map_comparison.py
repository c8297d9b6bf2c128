"""Two lane maps compared: known changes are told with their size, and nothing else is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely
import shapely.ops

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.roadmap.comparison.comparison_records import ADDED, CHANGES, MOVED, OFFSET, REMOVED, REPAINTED
from urbanmap_qgis.roadmap.comparison.difference_noise import limit_of
from urbanmap_qgis.roadmap.comparison.map_comparison import compare_maps
from urbanmap_qgis.roadmap.comparison.map_elements import (
    CROSSWALK,
    LINE,
    STOP_LINE,
    SYMBOL,
    MapElement,
    elements_of_lines,
)
from urbanmap_qgis.settings.roadmap import ComparisonSettings

SIGMA = 0.02


def turned(points, heading):
    east, north = np.sin(heading), np.cos(heading)
    return np.asarray(points, float) @ np.array([[north, -east], [east, north]])


def line(name, points, kind="solid", **more):
    return MapElement(name, LINE, kind, np.asarray(points, float), sigma=SIGMA, **more)


def road(number, begin, heading, length=200.0):
    """Two edges, a dashed lane line, a double yellow centre line, a stop line, a crosswalk and arrows on a heading."""
    def placed(points):
        return turned(points, heading) + begin

    def along(x, kind, name, **more):
        return line(f"{number}{name}", placed([(x, y) for y in np.linspace(0.0, length, 11)]), kind, **more)

    def box(x, y, width, depth):
        return placed([(x, y), (x + width, y), (x + width, y + depth), (x, y + depth), (x, y)])

    ahead = np.array([np.sin(heading), np.cos(heading)])
    arrows = [MapElement(f"{number}arrow{y:.0f}", SYMBOL, "arrow straight", box(-4.9, y, 0.8, 5.0), sigma=SIGMA,
                         heading=ahead) for y in (60.0, 120.0, 170.0)]
    return [along(-6.4, "solid", "left"), along(-3.2, "dashed", "lane"), along(0.0, "solid", "a", colour="yellow"),
            along(0.3, "solid", "b", colour="yellow"), along(3.5, "solid", "right"),
            MapElement(f"{number}stop", STOP_LINE, "stop line", placed([(-6.2, 190.0), (-0.2, 190.0)]), sigma=SIGMA),
            MapElement(f"{number}walk", CROSSWALK, "crosswalk", box(-6.4, 193.0, 9.9, 4.0), sigma=SIGMA,
                       heading=ahead), *arrows]


def town():
    """Four roads of two directions, and a bend of 90 m radius."""
    bend = [(500.0 + 90.0 * np.cos(angle), 90.0 * np.sin(angle)) for angle in np.linspace(0.0, 1.5, 28)]
    return [*road("A", (0.0, 0.0), 0.0), *road("B", (60.0, 0.0), 0.0), *road("C", (0.0, 300.0), np.pi / 2),
            *road("D", (0.0, 400.0), np.pi / 2), line("bend", bend)]


def moved(elements, shift, *names):
    return [replace(one, points=one.points + shift) if not names or one.identifier in names else one
            for one in elements]


def told(found):
    """Changes as (kind, name)."""
    return sorted((one.kind, one.old_id or one.new_id) for one in found.changes)


def part(points, begin, end):
    """Stretch of a line of the town between two shares of its length."""
    whole = shapely.LineString(points)
    return shapely.get_coordinates(shapely.ops.substring(whole, begin, end, normalized=True))


def without(elements, *names):
    return [one for one in elements if one.identifier not in names]


def test_a_map_is_the_same_as_itself():
    found = compare_maps(town(), town())
    assert not found.changes and not found.offset.significant
    lines = sum(one.plan.length for one in town() if one.element == LINE)
    assert found.same == pytest.approx(lines) and found.compared == pytest.approx(lines)
    assert found.counts == {STOP_LINE: 4, CROSSWALK: 4, SYMBOL: 12}


def test_a_line_moved_by_two_decimetres():
    (change,) = compare_maps(town(), moved(town(), (0.2, 0.0), "Alane")).changes
    assert (change.kind, change.element, change.old_id) == (MOVED, LINE, "Alane")
    # The line runs north: to its left is west.
    assert (change.east, change.north) == pytest.approx((0.2, 0.0), abs=1e-6)
    assert change.across == pytest.approx(-0.2) and np.isnan(change.along)
    assert change.sigma == pytest.approx(SIGMA * np.sqrt(2)) and change.significance == pytest.approx(7.07, abs=0.01)
    assert change.length == pytest.approx(200.0, abs=0.5)
    assert shapely.LineString(change.points).distance(shapely.Point(-3.0, 100.0)) < 1e-6


def test_part_of_a_line_moved():
    old = town()
    bulge = replace(old[0], points=np.array([(-6.4, 0), (-6.4, 80), (-6.1, 85), (-6.1, 120), (-6.4, 125), (-6.4, 200)],
                                            float))
    (change,) = compare_maps(old, [bulge, *old[1:]]).changes
    assert change.kind == MOVED and 35.0 < change.length < 46.0 and 0.2 < change.shift <= 0.3
    assert change.points[:, 1].min() > 80.0 and change.points[:, 1].max() < 125.0


def test_less_than_three_sigma_is_the_same():
    assert not compare_maps(town(), moved(town(), (0.08, 0.0), "Alane")).changes
    assert compare_maps(town(), moved(town(), (0.09, 0.0), "Alane")).changes
    settings = ComparisonSettings(least_shift=0.1)
    assert not compare_maps(town(), moved(town(), (0.09, 0.0), "Alane"), settings).changes


def test_removed_and_added():
    found = compare_maps(without(town(), "Bright", "Cstop"), without(town(), "Ab", "Dwalk", "Aarrow60"))
    assert told(found) == [(ADDED, "Bright"), (ADDED, "Cstop"), (REMOVED, "Aarrow60"), (REMOVED, "Ab"),
                           (REMOVED, "Dwalk")]
    lines = {one.kind: one.length for one in found.changes if one.element == LINE}
    assert lines == pytest.approx({ADDED: 200.0, REMOVED: 200.0})
    assert found.of(ADDED, LINE)[0].before == "" and found.of(ADDED, LINE)[0].after == "solid"


def test_part_of_a_line_removed():
    old = town()
    (change,) = compare_maps(old, [replace(old[1], points=part(old[1].points, 0.0, 0.7)), *old[2:], old[0]]).changes
    assert (change.kind, change.old_id) == (REMOVED, "Alane") and change.length == pytest.approx(60.0, abs=1.0)
    assert change.points[:, 1].min() > 139.0


def test_dashed_became_solid_and_an_arrow_turned():
    new = [replace(one, kind="solid") if one.identifier == "Alane" else
           replace(one, colour="white") if one.identifier == "Ca" else
           replace(one, kind="arrow left") if one.identifier == "Barrow60" else one for one in town()]
    found = compare_maps(town(), new)
    assert told(found) == [(REPAINTED, "Alane"), (REPAINTED, "Barrow60"), (REPAINTED, "Ca")]
    words = {one.old_id: (one.before, one.after) for one in found.changes}
    assert words["Alane"] == ("dashed", "solid") and words["Ca"] == ("solid, yellow", "solid, white")


def test_the_whole_map_moved_is_one_finding():
    found = compare_maps(town(), moved(moved(town(), (0.3, -0.1)), (0.2, 0.0), "Alane"))
    whole, change = found.changes
    assert whole.kind == OFFSET and (whole.east, whole.north) == pytest.approx((0.3, -0.1), abs=0.003)
    assert (change.kind, change.old_id) == (MOVED, "Alane") and change.east == pytest.approx(0.2, abs=0.003)
    # It lies where the new map has it.
    assert shapely.LineString(change.points).distance(shapely.Point(-2.7, 100.0)) < 0.005
    assert found.offset.significant and found.offset.sigma_east < 0.01


def test_an_offset_beyond_the_reach_of_a_line():
    found = compare_maps(town(), moved(town(), (1.7, 0.8)))
    assert told(found) == [(OFFSET, "")] and found.offset.east == pytest.approx(1.7, abs=0.003)


def test_an_offset_along_all_lines_is_shown_by_their_symbols_alone():
    old = [*road("A", (0.0, 0.0), 0.0), *road("B", (60.0, 0.0), 0.0)]
    found = compare_maps(old, moved(old, (0.3, 0.5)))
    assert told(found) == [(OFFSET, "")] and found.offset.north == pytest.approx(0.5, abs=0.01)
    lines = [one for one in old if one.element == LINE]
    found = compare_maps(lines, moved(lines, (0.3, 0.5)))
    assert found.offset.east == pytest.approx(0.3, abs=0.003)
    assert found.offset.north == 0.0 and np.isnan(found.offset.sigma_north)


def test_outside_of_the_common_area_nothing_is_added_or_removed():
    old = [replace(one, points=part(one.points, 0.0, 0.7)) if one.element == LINE else one for one in town()]
    new = [replace(one, points=part(one.points, 0.35, 1.0)) if one.element == LINE else one for one in town()]
    old = [one for one in old if one.element == LINE or one.identifier[1:] in ("arrow60", "arrow120")]
    new = [one for one in new if one.element == LINE or one.identifier[1:] != "arrow60"]
    found = compare_maps(old, new)
    assert not found.changes
    assert found.outside_old == pytest.approx(0.35 * 4135, rel=0.02)
    assert found.outside_new == pytest.approx(0.3 * 4135, rel=0.02)


@pytest.mark.slow
def test_an_area_that_is_given_tells_what_is_gone():
    new = [one for one in town() if one.identifier[0] != "D"]
    assert not compare_maps(town(), new).changes
    found = compare_maps(town(), new, area=shapely.box(-50, -50, 700, 600))
    assert len(found.of(REMOVED, LINE)) == 5 and len(found.of(REMOVED)) == 10
    assert not compare_maps(town(), new, area=shapely.box(-50, -50, 700, 350)).changes


def test_direction_sampling_and_pieces_of_lines_do_not_matter():
    def redrawn(number, one):
        if one.element != LINE:
            return [replace(one, points=one.points[::-1])]
        if one.identifier == "bend":
            return [replace(one, points=one.points[::3])]
        cuts = (0.0, 0.31, 0.32, 0.8, 1.0)[:3 + number % 3]
        cuts = (*cuts[:-1], 1.0)
        pieces = [replace(one, identifier=f"{one.identifier}.{k}", points=part(one.points, a, b))
                  for k, (a, b) in enumerate(zip(cuts[:-1], cuts[1:]))]
        return [replace(piece, points=piece.points[::-1] if number % 2 else shapely.get_coordinates(
            shapely.segmentize(piece.plan, 0.7))) for piece in pieces]

    new = [piece for number, one in enumerate(town()) for piece in redrawn(number, one)]
    assert not compare_maps(town(), new).changes
    assert not compare_maps(new, town()).changes
    assert told(compare_maps(town(), moved(new, (0.2, 0.0), "Aleft.0"))) == [(MOVED, "Aleft")]


def test_the_same_line_twice_is_one():
    twice = [*town(), *(replace(one, identifier=f"{one.identifier}2") for one in town() if one.element == LINE)]
    assert not compare_maps(town(), twice).changes
    assert not compare_maps(twice, town()).changes


def test_two_lines_beside_each_other_that_move_together_keep_their_order():
    found = compare_maps(town(), moved(town(), (0.2, 0.0), "Aa", "Ab"))
    assert {(one.old_id, one.new_id, round(one.east, 3)) for one in found.changes} == {("Aa", "Aa", 0.2),
                                                                                      ("Ab", "Ab", 0.2)}


@pytest.mark.slow
def test_a_double_line_drawn_as_one_line():
    new = [replace(one, points=one.points + (0.15, 0.0) * (one.identifier[0] in "AB"), double=True, sigma=0.1)
           if one.identifier[1:] == "a" and one.identifier[0] in "AB" else one
           for one in town() if one.identifier not in ("Ab", "Bb")]
    assert not compare_maps(town(), new).changes and not compare_maps(new, town()).changes


def test_stop_lines_crosswalks_and_symbols_tell_shifts_along_the_road():
    new = moved(moved(moved(town(), (0.0, 1.0), "Astop"), (0.0, 0.4), "Bwalk"), (0.0, -0.3), "Carrow120")
    found = {one.old_id: one for one in compare_maps(town(), new).changes}
    assert set(found) == {"Astop", "Bwalk", "Carrow120"}
    assert found["Astop"].along == pytest.approx(1.0, abs=1e-6) and found["Astop"].north == pytest.approx(1.0)
    assert found["Bwalk"].along == pytest.approx(0.4) and found["Bwalk"].across == pytest.approx(0.0, abs=1e-9)
    # Road C runs east: to its left is north.
    assert found["Carrow120"].across == pytest.approx(-0.3) and found["Carrow120"].along == pytest.approx(0, abs=1e-9)


def test_what_was_seen_in_part_has_not_moved():
    short = {"Astop": [(-6.2, 190.0), (-3.0, 190.0)],
             "Bwalk": [(53.6, 193), (58, 193), (58, 197), (53.6, 197), (53.6, 193)]}
    new = [replace(one, points=np.array(short[one.identifier], float)) if one.identifier in short else one
           for one in town()]
    assert not compare_maps(town(), new).changes


def noisy(elements, random, sigma, stated):
    """Each element displaced by itself, as a whole and, along lines, in waves."""
    made = []
    for one in elements:
        points = one.points + random.normal(0.0, sigma, 2)
        made.append(replace(one, points=points, sigma=sigma if stated else np.nan))
    return made


@pytest.mark.parametrize("stated", [True, False])
@pytest.mark.slow
def test_noise_alone_is_told_in_less_than_three_of_a_thousand(stated):
    lines, shifts, things, shifted, offsets = 0.0, 0.0, 0, 0, 0
    for seed in range(20):
        random = np.random.default_rng(seed)
        maps = [noisy(town(), random, sigma, stated) for sigma in (0.02, 0.03)]
        found = compare_maps(*maps)
        assert {one.kind for one in found.changes} <= {MOVED, OFFSET}
        lines += found.compared
        shifts += sum(one.length for one in found.of(MOVED, LINE))
        things += sum(found.counts.values())
        shifted += len(found.of(MOVED)) - len(found.of(MOVED, LINE))
        offsets += found.offset.significant
    assert shifts / lines <= 0.003 and shifted / things <= 0.003 and offsets == 0


def test_changes_are_found_among_noise_that_no_map_states():
    random = np.random.default_rng(7)
    old, new = (noisy(town(), random, sigma, False) for sigma in (0.02, 0.03))
    new = without(moved(moved(new, (0.4, 0.0)), (0.3, 0.0), "Alane"), "Bleft")
    found = compare_maps(old, new)
    assert set(told(found)) == {(OFFSET, ""), (MOVED, "Alane"), (REMOVED, "Bleft")}
    noise = found.noises[LINE]
    assert noise.source == "estimated" and np.hypot(noise.old, noise.new) == pytest.approx(0.036, rel=0.5)
    assert noise.limit > 3.0


def test_sigma_of_one_map_is_estimated_where_only_the_other_states_it():
    random = np.random.default_rng(3)
    old, new = noisy(town(), random, 0.02, True), noisy(town(), random, 0.05, False)
    noise = compare_maps(old, new).noises[LINE]
    assert noise.new == pytest.approx(0.05, rel=0.5) and np.isnan(noise.old)
    given = compare_maps(old, new, ComparisonSettings(new_sigma=0.05)).noises[LINE]
    assert given.source == "given" and given.limit == 3.0


def test_too_small_a_sigma_is_enlarged_by_what_did_not_change():
    random = np.random.default_rng(5)
    old, new = (noisy(town(), random, 0.06, True) for _ in range(2))
    boast = [replace(one, sigma=0.01) for one in old], [replace(one, sigma=0.01) for one in new]
    found = compare_maps(*boast)
    assert found.noises[LINE].factor > 3.0
    assert sum(one.length for one in found.of(MOVED, LINE)) < 0.05 * found.compared


@pytest.mark.parametrize(("sigma", "same"), [(SIGMA, True), (1.0, False)])
def test_maps_that_know_their_places_to_metres_are_not_the_same(sigma, same):
    """No shift that is looked for would be significant: that nothing moved is not known."""
    lines = [replace(one, sigma=sigma) for one in town()]
    found = compare_maps(lines, lines)
    assert not found.changes and (found.same, found.unjudged)[not same] == pytest.approx(found.compared)
    assert (found.same, found.unjudged)[same] == 0.0


def test_limit_grows_where_sigma_is_known_from_few():
    assert limit_of(1e9) == pytest.approx(3.0, abs=1e-4)
    assert limit_of(10.0) == pytest.approx(3.957, abs=0.001) and limit_of(3.0) > 8.0


@pytest.mark.parametrize("old, new, words", [
    ([], town(), "old map has no lines"), (town(), [], "new map has no lines"),
    (town(), moved(town(), (5000.0, 0.0)), "do not overlap")])
def test_maps_that_cannot_be_compared(old, new, words):
    with pytest.raises(InputError, match=words):
        compare_maps(old, new)


def test_every_kind_of_change_is_named():
    assert CHANGES == (MOVED, ADDED, REMOVED, REPAINTED)


@pytest.mark.slow
def test_outlines_that_scatter_at_each_corner_have_not_moved():
    random = np.random.default_rng(2)
    def scattered(elements):
        return [replace(one, points=one.points + random.normal(0.0, 0.05, one.points.shape), sigma=np.nan)
                if one.element in (CROSSWALK, SYMBOL) else one for one in elements]
    for _ in range(10):
        assert not compare_maps(scattered(town()), scattered(town())).of(MOVED)


def test_a_symbol_whose_kind_and_heading_are_unknown_is_matched_and_not_repainted():
    new = [replace(one, kind="arrow, kind unknown", heading=np.full(2, np.nan)) if one.element == SYMBOL else one
           for one in town()]
    found = compare_maps(town(), new)
    assert not found.changes and found.counts[SYMBOL] == 12


@pytest.mark.parametrize(("columns", "name"), [({}, "2"), ({"id": [None, "a"]}, "a"), ({"bound_id": [1, None]}, "2"),
                                               ({"line_id": [1, 4], "id": ["x", "y"]}, "4")])
def test_lines_of_a_layer_are_named_by_their_ids_or_rows(columns, name):
    line = shapely.LineString([(0, 0), (9, 0)])
    (found,) = elements_of_lines([None, line], {"class": ["solid", "dashed"], "colour": ["", "yellow"], **columns})
    assert (found.identifier, found.kind, found.colour, found.double) == (name, "dashed", "yellow", None)
    assert np.isnan(found.sigma) and found.points.tolist() == [[0.0, 0.0], [9.0, 0.0]]
