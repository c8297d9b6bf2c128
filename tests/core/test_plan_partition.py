"""The plan of a building cut into cells: known areas, exact edges, and a partition whatever the roofs."""

import numpy as np
import pytest
import shapely
from shapely import affinity, box

from urbanmap_qgis.buildings.solids.half_edges import half_edges
from urbanmap_qgis.buildings.solids.plan_partition import partition_plan
from urbanmap_qgis.errors import InputError, InsufficientDataError


def parts(outline, roofs, heights):
    return partition_plan(outline, roofs, heights, [f"r{i}" for i in range(len(roofs))])


def areas(cells):
    total = {}
    for cell in cells:
        total[cell.roof_id] = round(total.get(cell.roof_id, 0.0) + cell.polygon.area, 6)
    return total


def unpaired_length(cells, grid=0.01):
    """Length of cell edges that no other cell has in the opposite direction."""
    edges = half_edges(np.array([cell.polygon for cell in cells]), (0.0, 0.0), grid)
    return sum(edges.length(a, b) for a, b in edges.cell if (b, a) not in edges.cell)


def random_building(seed):
    """A footprint, sometimes with a courtyard, and boxes thrown over it at any angle."""
    rng = np.random.default_rng(seed)
    footprint = box(0, 0, 20, 15)
    if rng.random() < 0.5:
        x, y = rng.uniform(2, 10, 2)
        footprint = footprint.difference(box(x, y, x + rng.uniform(1, 8), y + rng.uniform(1, 8)))
    roofs = []
    for _ in range(rng.integers(1, 9)):
        x, y = rng.uniform(-2, 18), rng.uniform(-2, 13)
        roof = box(x, y, x + rng.uniform(1, 12), y + rng.uniform(1, 12))
        roofs.append(affinity.rotate(roof, rng.choice([0, 0, 5, 45, rng.uniform(0, 90)])))
    return footprint, roofs, rng.choice([3, 3, 4, 5, 6.5, 9, 12], len(roofs)).tolist()


def test_two_roofs_that_fit():
    partition = parts(box(0, 0, 10, 6), [box(0, 0, 4, 6), box(4, 0, 10, 6)], [5, 8])
    assert areas(partition) == {"r0": 24.0, "r1": 36.0}
    assert [cell.height for cell in partition] == [8.0, 5.0]


def test_overlap_goes_to_the_highest_roof_in_any_order():
    roofs, heights = [box(0, 0, 6, 6), box(4, 0, 10, 6)], [8, 5]
    partition = parts(box(0, 0, 10, 6), roofs, heights)
    assert areas(partition) == {"r0": 36.0, "r1": 24.0}
    again = partition_plan(box(0, 0, 10, 6), roofs[::-1], heights[::-1], ["r1", "r0"])
    assert [c.polygon.wkt for c in again] == [c.polygon.wkt for c in partition]


def test_gap_goes_to_the_longest_common_edge():
    roofs = [box(0, 0, 4, 6), box(5, 0, 10, 3), box(5, 3, 10, 6), box(4, 0, 5, 1), box(4, 5, 5, 6)]
    found = areas(parts(box(0, 0, 10, 6), roofs, [5, 8, 9, 3, 4]))
    assert found == {"r0": 24.0 + 4.0, "r1": 15.0, "r2": 15.0, "r3": 1.0, "r4": 1.0}


def test_a_roof_that_sticks_out_of_the_outline_is_kept():
    roofs = [box(-1, 0, 5, 6), box(5, 0, 11, 6)]
    for outline in (box(0, 0, 10, 6), None):
        assert areas(parts(outline, roofs, [5, 8])) == {"r0": 36.0, "r1": 36.0}


def test_courtyard_stays_open_and_missing_roof_in_the_outline_is_filled():
    frame = box(0, 0, 12, 12).difference(box(4, 4, 8, 8))
    assert areas(parts(frame, [frame], [5])) == {"r0": 128.0}
    assert areas(parts(box(0, 0, 12, 12), [frame], [5])) == {"r0": 144.0}
    assert areas(parts(None, [frame], [5])) == {"r0": 128.0}


def test_slivers_join_their_neighbours():
    footprint = box(0, 0, 10, 6)
    roofs = [box(0, 0, 5, 6), box(5, 0, 10, 6), box(4.9, 0, 5, 6), box(8, 2, 8.5, 2.5)]
    partition = parts(footprint, roofs, [5, 8, 12, 20])
    assert set(areas(partition)) == {"r0", "r1"}
    assert sum(areas(partition).values()) == pytest.approx(60.0)


def test_t_junction_stands_on_both_sides():
    partition = parts(box(0, 0, 10, 10), [box(0, 0, 10, 5), box(0, 5, 4, 10), box(4, 5, 10, 10)], [3, 4, 5])
    low = next(cell for cell in partition if cell.roof_id == "r0")
    assert (4.0, 5.0) in list(low.polygon.exterior.coords)
    assert unpaired_length(partition) == pytest.approx(40.0)


def test_nodes_left_by_noding_are_removed():
    partition = parts(box(0, 0, 10, 10), [box(0, 0, 10, 10), box(2, 2, 5, 5)], [6, 3])
    assert len(partition) == 1
    assert len(partition[0].polygon.exterior.coords) == 5


def test_a_line_bent_by_rounding_is_straight_again_and_a_curve_stays():
    turned = affinity.rotate(box(0, 0, 40, 10), 33, origin=(0, 0))
    dips = [affinity.rotate(box(x, 0, x + 2, 10), 33, origin=(0, 0)) for x in range(3, 37, 4)]
    partition = parts(turned, [turned, *dips], [6] + [3] * len(dips))
    assert len(partition) == 1
    assert len(partition[0].polygon.exterior.coords) == 5
    round_house = shapely.Point(0, 0).buffer(20, quad_segs=64)
    cell = parts(round_house, [round_house], [5])[0]
    assert shapely.hausdorff_distance(cell.polygon, round_house, densify=0.1) < 0.025
    assert 60 < len(cell.polygon.exterior.coords) < 257


def test_invalid_and_multipart_input():
    bow_tie = shapely.Polygon([(0, 0), (10, 6), (10, 0), (0, 6)])
    partition = parts(box(0, 0, 10, 6), [bow_tie, box(0, 0, 10, 6)], [8, 5])
    assert areas(partition)["r1"] == pytest.approx(30.0)
    two = shapely.MultiPolygon([box(0, 0, 4, 4), box(10, 0, 14, 4)])
    assert areas(parts(None, [two], [8])) == {"r0": 32.0} and len(parts(None, [two], [8])) == 2


@pytest.mark.parametrize("seed", range(60))
def test_random_roofs_make_an_exact_partition(seed):
    outline, roofs, heights = random_building(seed)
    roofs = [roof & outline for roof in roofs]
    polygons = np.array([cell.polygon for cell in parts(outline, roofs, heights)])
    assert shapely.is_valid(polygons).all()
    union, plan = shapely.union_all(polygons), shapely.union_all(roofs)
    assert union.area == pytest.approx(shapely.area(polygons).sum(), abs=1e-6)
    assert shapely.difference(plan, union).area < 0.01 * plan.length
    assert shapely.difference(union, outline).area < 0.01 * plan.length + 1.0  # slivers between roofs


def test_national_coordinates_change_nothing():
    outline, roofs, heights = random_building(3)
    here = parts(outline, roofs, heights)
    moved = parts(affinity.translate(outline, 5e5, 5e6), [affinity.translate(r, 5e5, 5e6) for r in roofs], heights)
    for a, b in zip(here, moved):
        shift = shapely.get_coordinates(b.polygon) - shapely.get_coordinates(a.polygon) - (5e5, 5e6)
        assert np.abs(shift).max() < 1e-6


def test_refusals():
    roof = [box(0, 0, 1, 1)]
    with pytest.raises(InputError, match="differ in number"):
        partition_plan(box(0, 0, 1, 1), roof, [1, 2], ["a"])
    with pytest.raises(InputError, match="no height"):
        partition_plan(box(0, 0, 1, 1), roof, [np.nan], ["a"])
    with pytest.raises(InsufficientDataError, match="no roof"):
        partition_plan(box(0, 0, 1, 1), [], [], [])
    with pytest.raises(InsufficientDataError, match="has an area"):
        partition_plan(None, [shapely.Polygon([(0, 0), (1, 0), (2, 0)])], [1], ["a"])
