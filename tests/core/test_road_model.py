"""Road surfaces cut at their junctions: crossings drawn by hand, whose cuts the working procedure tells."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.roadspace.road_model import Structures, build_road_model, with_functions
from urbanmap_qgis.roadspace.road_surface import surface_of

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
            for edge in zip(points, points[1:]):
                seen[edge] = seen.get(edge, 0) + 1
    assert set(seen.values()) == {1}  # no edge twice in one sense
    inner = [edge for edge in seen if (edge[1], edge[0]) in seen]
    outline = sum(shapely.length(shapely.linestrings(edge)) for edge in seen if (edge[1], edge[0]) not in seen)
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
