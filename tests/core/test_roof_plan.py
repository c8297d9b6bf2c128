"""Partition of a plan among its roofs: exact cover, straight shared edges, true borders."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.affinity import rotate, translate

from urbanmap_qgis.buildings.polygons.roof_plan import PartitionParameters, partition_roofs
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid

BOX = shapely.box
PLANS = {
    "two": [BOX(0, 0, 10, 12), BOX(10, 0, 20, 12)],
    "penthouse": [shapely.difference(BOX(0, 0, 30, 20), BOX(8, 6, 16, 14)), BOX(8, 6, 16, 14)],
    "ell": [BOX(0, 0, 20, 8), BOX(0, 8, 8, 18), BOX(20, 0, 26, 5)],
    "u": [BOX(0, 0, 30, 8), BOX(0, 8, 8, 24), BOX(22, 8, 30, 24)],
    "courtyard": [shapely.difference(BOX(0, 0, 30, 20), BOX(10, 6, 20, 14)) & BOX(0, 0, 15, 20),
                  shapely.difference(BOX(0, 0, 30, 20), BOX(10, 6, 20, 14)) & BOX(15, 0, 30, 20)],
    "six": [BOX(0, 0, 10, 10), BOX(10, 0, 20, 10), BOX(20, 0, 30, 10), BOX(0, 10, 10, 20),
            BOX(10, 10, 22, 20), BOX(22, 10, 30, 20)],
    "oblique": [shapely.Polygon([(0, 0), (18, 0), (10, 14), (0, 14)]),
                shapely.Polygon([(18, 0), (30, 0), (30, 14), (10, 14)])],
}


def labelled(roofs, density=8.0, cell=0.5, seed=1):
    """Outline, grid, empty raster and labelled random points of true roofs 1, 2, ..."""
    outline = shapely.union_all(roofs, grid_size=1e-6)
    x0, y0, x1, y1 = outline.bounds
    xy = np.random.default_rng(seed).uniform([x0, y0], [x1, y1], (int(density * (x1 - x0) * (y1 - y0)), 2))
    number = np.zeros(len(xy), int)
    for i, roof in enumerate(roofs):
        number[shapely.contains_xy(roof, xy)] = i + 1
    grid = Grid.covering(x0, y0, x1, y1, cell)
    return outline, grid, np.zeros(grid.shape, int), (xy[:, 0], xy[:, 1], number)


def of_roof(partition, number):
    return shapely.union_all([p for p, n in zip(partition.polygons, partition.roof_numbers) if n == number])


def check_cover(partition, outline):
    """Valid polygons that fill the outline to the rounding of the nodes, borders paired edge by edge."""
    assert all(p.is_valid and p.geom_type == "Polygon" for p in partition.polygons)
    assert shapely.symmetric_difference(shapely.union_all(partition.polygons), outline).area < 1e-3 * outline.length
    assert sum(p.area for p in partition.polygons) == pytest.approx(outline.area, abs=1e-3 * outline.length)
    edges = {}
    for polygon in partition.polygons:
        for ring in [polygon.exterior, *polygon.interiors]:
            for a, b in zip(ring.coords[:-1], ring.coords[1:]):
                key = (min(a, b), max(a, b))
                edges[key] = edges.get(key, 0) + 1
    assert max(edges.values()) <= 2
    for (a, b), times in edges.items():
        if times == 1:  # not shared, so it must lie on the outline
            middle = shapely.Point((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
            assert outline.boundary.distance(middle) < 1e-3


@pytest.mark.parametrize("name", sorted(PLANS))
@pytest.mark.parametrize("angle", [0.0, 23.0, 77.0])
def test_true_roofs_come_back(name, angle):
    roofs = [translate(rotate(r, angle, origin=(10, 10)), 84000.0, 447000.0) for r in PLANS[name]]
    outline, grid, labels, points = labelled(roofs)
    partition = partition_roofs(outline, grid, labels, points=points)
    check_cover(partition, outline)
    assert partition.status == "ok"
    assert len(partition.polygons) == len(roofs)
    for i, roof in enumerate(roofs):
        found = of_roof(partition, i + 1)
        assert shapely.intersection(found, roof).area / shapely.union(found, roof).area > 0.95
        # a border is straight: true corners, junctions with other roofs, and a few where a border is stepped
        assert len(shapely.get_coordinates(found)) <= 2 * len(shapely.get_coordinates(roof)) + 2
    assert (partition.boundary_rms < 0.5).all()


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 10_000), st.floats(0, 90))
def test_any_labels_give_an_exact_cover(seed, angle):
    rng = np.random.default_rng(seed)
    outline = rotate(shapely.difference(BOX(0, 0, 24, 16), BOX(8, 5, 14, 10)), angle)
    grid = Grid.covering(*outline.bounds, 0.5)
    coarse = rng.integers(0, 5, (grid.rows // 6 + 1, grid.columns // 6 + 1))
    labels = np.kron(coarse, np.ones((6, 6), int))[:grid.rows, :grid.columns]
    labels = np.where(rng.random(labels.shape) < 0.1, rng.integers(0, 5, labels.shape), labels)
    partition = partition_roofs(outline, grid, labels)
    check_cover(partition, outline)
    assert (shapely.area(partition.polygons) > 0.5).all()
    assert set(partition.roof_numbers.tolist()) <= {1, 2, 3, 4}


def test_border_near_a_step_of_the_outline_follows_it():
    outline = shapely.Polygon([(0, 0), (20, 0), (20, 8), (10, 8), (10, 16), (0, 16)])
    # the roofs meet at y = 8.3 in the points, 0.3 m off the outward step at y = 8
    roofs = [BOX(0, 0, 20, 8.3), BOX(0, 8.3, 10, 16)]
    _, grid, labels, points = labelled(roofs)
    partition = partition_roofs(outline, grid, labels, points=points)
    assert of_roof(partition, 1).equals(BOX(0, 0, 20, 8))
    assert of_roof(partition, 2).equals(BOX(0, 8, 10, 16))


def test_one_roof_is_the_outline_itself():
    outline = shapely.MultiPolygon([BOX(0, 0, 10, 10), BOX(20, 0, 25, 10)])
    grid = Grid.covering(*outline.bounds, 0.5)
    labels = np.full(grid.shape, 7)
    labels[:, 12:] = 0
    partition = partition_roofs(outline, grid, labels)
    assert partition.status == "one roof"
    assert partition.roof_numbers.tolist() == [7, 7]
    assert partition.polygons == tuple(outline.geoms)
    assert (partition.coverage > 0).all() and (partition.coverage < 1).all()


def test_no_label_at_all():
    outline = BOX(0, 0, 10, 10)
    grid = Grid.covering(*outline.bounds, 0.5)
    partition = partition_roofs(outline, grid, np.zeros(grid.shape, int))
    assert (partition.status, partition.coverage.tolist()) == ("no data", [0.0])
    assert partition.roof_numbers.tolist() == [0]


def test_part_without_data_goes_to_the_nearest_roof_and_is_told():
    outline, grid, labels, (x, y, number) = labelled(PLANS["two"])
    number = np.where(x > 15, 0, number)
    partition = partition_roofs(outline, grid, labels, points=(x, y, number))
    check_cover(partition, outline)
    assert of_roof(partition, 2).area == pytest.approx(120.0, rel=0.03)
    assert partition.coverage[partition.roof_numbers == 2][0] < 0.6


def test_speck_is_absorbed():
    outline, grid, labels, (x, y, number) = labelled(PLANS["two"])
    number = np.where(np.hypot(x - 5, y - 5) < 0.6, 3, number)
    partition = partition_roofs(outline, grid, labels, points=(x, y, number))
    assert sorted(partition.roof_numbers.tolist()) == [1, 2]


def test_same_input_same_output():
    case = labelled(PLANS["six"])
    one, two = (partition_roofs(*case[:3], points=case[3]) for _ in range(2))
    assert [p.wkb for p in one.polygons] == [p.wkb for p in two.polygons]


def test_heights_let_a_high_roof_win_against_roofs_of_like_height():
    outline, grid, labels, points = labelled(PLANS["two"])
    heights = np.full(grid.shape, np.nan)
    row, column, _ = grid.cells(points[0], points[1])
    heights[row, column] = np.where(points[2] == 2, 30.0, 10.0)
    partition = partition_roofs(outline, grid, labels, heights, PartitionParameters(), points)
    check_cover(partition, outline)
    assert of_roof(partition, 2).area == pytest.approx(120.0, rel=0.03)


def test_wrong_input():
    grid = Grid.covering(0, 0, 10, 10, 0.5)
    with pytest.raises(InputError):
        partition_roofs(BOX(0, 0, 10, 10), grid, np.zeros((3, 3), int))
    with pytest.raises(InputError):
        partition_roofs(shapely.Polygon(), grid, np.zeros(grid.shape, int))


def test_small_penthouse_with_ragged_sides_keeps_its_place():
    outline = BOX(0, 0, 24, 16)
    grid = Grid.covering(*outline.bounds, 0.5)
    x, y = np.meshgrid(*grid.centres())
    # sides of 3 m in which every other cell is missing give no run of boundaries long enough for a line
    ragged = ((x > 9.5) | (np.floor(y / 0.5) % 2 == 0)) & ((x < 13) | (np.floor(y / 0.5) % 3 == 0))
    inside = (x > 8.5) & (x < 14) & (y > 6) & (y < 9)
    labels = np.where(inside & ragged, 2, 1)
    partition = partition_roofs(outline, grid, labels)
    check_cover(partition, outline)
    assert partition.status == "ok"
    found = of_roof(partition, 2)
    assert found.area == pytest.approx(15.0, rel=0.2)
    assert len(shapely.get_coordinates(found)) == 5


@pytest.mark.parametrize("seed", [1, 2])
def test_more_small_roofs_than_lines_are_all_kept(seed):
    rng = np.random.default_rng(seed)
    rooms = [BOX(x, y, x + 3, y + 3) for x, y in
             ((7 * i + rng.uniform(0.5, 3), 7 * j + rng.uniform(0.5, 3)) for i in range(9) for j in range(6))]
    outline, grid, labels, points = labelled([shapely.difference(BOX(0, 0, 63, 42), shapely.union_all(rooms)), *rooms])
    heights = np.full(grid.shape, np.nan)
    partition = partition_roofs(outline, grid, labels, heights, points=points)
    assert partition.status == "ok"
    assert set(partition.roof_numbers.tolist()) == set(range(1, 56))
    check_cover(partition, outline)
    assert np.median([of_roof(partition, 2 + i).intersection(room).area / of_roof(partition, 2 + i).union(room).area
                      for i, room in enumerate(rooms)]) > 0.7
