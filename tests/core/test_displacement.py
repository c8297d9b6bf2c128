"""Outlines put back to their places in scenes whose truth is known."""


import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.outlines import displacement, displacement_search
from urbanmap_qgis.buildings.outlines.displacement import estimate_displacements, shifted_outlines
from urbanmap_qgis.buildings.outlines.displacement_boundary import edges_of, pieces_of, row_sums, sums_inside
from urbanmap_qgis.buildings.outlines.displacement_pairs import MASK_CELL, meeting_tables, overlap_tables, walls_between
from urbanmap_qgis.buildings.outlines.displacement_search import shift_lattice
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid

GRID = Grid.covering(-20, -20, 99.9, 59.9, 0.5)


def turned(polygons, degrees=31.0):
    angle = np.radians(degrees)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return shapely.transform(polygons, lambda points: points @ turn)


def terrace():
    """A row of seven houses of differing width and depth, one with a hole, and two sheds."""
    edges = np.cumsum([10, 5.5, 6.1, 5.2, 7.0, 5.8, 6.4, 5.5])
    depth = [9.0, 9.0, 11.5, 10.0, 10.0, 12.0, 9.5]
    houses = [shapely.box(a, -10, b, -10 + d) for a, b, d in zip(edges[:-1], edges[1:], depth)]
    houses[2] = houses[2].difference(shapely.box(22.6, -5, 25, -2))
    sheds = [shapely.box(20, 8, 23, 12), shapely.box(40, 7, 44, 10)]
    return turned(np.array(houses + sheds, dtype=object))


def evidence_of(polygons, grid=GRID):
    """+1 in a building, -1 outside, a boundary cell by its share."""
    x, y = grid.centres()
    fine = (np.arange(5) - 2) * grid.cell / 5
    share = np.zeros(grid.shape)
    united = shapely.union_all(polygons)
    shapely.prepare(united)
    for u in fine:
        for v in fine:
            share += shapely.contains_xy(united, *np.meshgrid(x + u, y + v)) / 25
    return (2 * share - 1).astype(np.float32)


def shifted(polygons, shifts):
    points, owner = shapely.get_coordinates(polygons, return_index=True)
    return shapely.set_coordinates(polygons.copy(), points + np.asarray(shifts)[owner])


def random_shifts(n, length, seed):
    angle = np.random.default_rng(seed).uniform(0, 2 * np.pi, n)
    return length * np.column_stack((np.cos(angle), np.sin(angle)))


def found(displacements):
    return np.column_stack((displacements.dx, displacements.dy))


def test_sum_over_a_polygon_with_a_hole_is_its_area():
    ring = shapely.Polygon([(0, 0), (30, 4), (26, 22), (3, 17)], [[(8, 8), (12, 8), (12, 13), (8, 13)]])
    other = shapely.MultiPolygon([shapely.box(40, 0, 45, 5), shapely.box(50, 3, 51, 19)])
    polygons = np.array([ring, other], dtype=object)
    sums = row_sums(np.ones(GRID.shape), GRID.cell)
    area = sums_inside(pieces_of(edges_of(polygons)), np.array([[[0, 0], [1.3, -0.7]]] * 2), sums, GRID)
    assert area == pytest.approx(np.repeat(shapely.area(polygons)[:, None], 2, axis=1), rel=1e-9)


def test_overlap_tables_agree_with_shapely():
    polygons = terrace()[1:4]
    pairs = np.array([[0, 1], [0, 2], [1, 2]])
    tables = overlap_tables(polygons, pieces_of(edges_of(polygons)), pairs, 5.0)
    for u, v in [(0, 0), (5, -8), (-12, 3), (20, 20)]:
        away = shifted(polygons, np.tile([u * MASK_CELL, v * MASK_CELL], (3, 1)))
        truth = shapely.area(shapely.intersection(polygons[pairs[:, 0]], away[pairs[:, 1]]))
        assert tables[:, 20 + v, 20 + u] == pytest.approx(truth, abs=0.8)


def test_walls_meet_best_where_the_houses_were_drawn():
    polygons = terrace()[:2]
    offset = np.array([0.8, -1.1])
    walls = walls_between(edges_of(shifted(polygons, [[0, 0], offset])), np.array([[0, 1]]), 5.0)
    places = np.stack(np.meshgrid(np.arange(-2, 2.01, 0.1), np.arange(-2, 2.01, 0.1)), -1).reshape(-1, 2)
    best = places[meeting_tables(walls, 1, places, 0.15)[0].argmax()]
    assert best == pytest.approx(-offset, abs=1e-6)


@pytest.mark.parametrize("length", [1.0, 2.0])
def test_outlines_shifted_at_random_come_back(length):
    truth = terrace()
    shifts = random_shifts(len(truth), length, seed=4)
    result = estimate_displacements(shifted(truth, shifts), evidence_of(truth), GRID)
    assert np.hypot(*(found(result) + shifts).T) == pytest.approx(np.zeros(len(truth)), abs=0.2)
    assert set(result.status) == {"moved"}
    assert (np.hypot(*(found(result) + shifts).T) < 3 * result.sigma).all()


def test_a_sheet_shifted_as_a_whole_comes_back_as_a_whole():
    truth = terrace()
    shifts = np.tile([-1.3, 0.9], (len(truth), 1))
    result = estimate_displacements(shifted(truth, shifts), evidence_of(truth), GRID)
    assert found(result) == pytest.approx(-shifts, abs=0.1)
    assert np.ptp(found(result), axis=0) == pytest.approx([0, 0], abs=1e-9)


def test_outlines_at_their_places_stay():
    truth = terrace()
    result = estimate_displacements(truth, evidence_of(truth), GRID)
    assert not found(result).any() and set(result.status) == {"kept"}
    assert np.array_equal(shifted_outlines(truth, result), truth)


def test_no_order_and_no_company_matters():
    truth = terrace()
    polygons = shifted(truth, random_shifts(len(truth), 1.5, seed=8))
    far = shifted(polygons[:1], [[-25.0, 40.0]])
    evidence = evidence_of(truth)
    unary = found(estimate_displacements(polygons, evidence, GRID))
    order = np.random.default_rng(1).permutation(len(polygons))
    assert np.array_equal(found(estimate_displacements(polygons[order], evidence, GRID)), unary[order])
    company = found(estimate_displacements(np.concatenate((far, polygons)), evidence, GRID))
    assert np.array_equal(company[1:], unary)


def test_pieces_of_work_do_not_matter(monkeypatch):
    truth = terrace()
    polygons, evidence = shifted(truth, random_shifts(len(truth), 1.5, seed=8)), evidence_of(truth)
    whole = found(estimate_displacements(polygons, evidence, GRID))
    monkeypatch.setattr(displacement_search, "PAIRS_AT_ONCE", 3)
    monkeypatch.setattr("urbanmap_qgis.buildings.outlines.displacement_pairs.PAIRS_AT_ONCE", 2)
    monkeypatch.setattr("urbanmap_qgis.buildings.outlines.displacement_boundary.LOOKUPS", 1000)
    monkeypatch.setattr(displacement, "OUTLINES_AT_ONCE", 1)
    assert np.array_equal(found(estimate_displacements(polygons, evidence, GRID)), whole)


def test_houses_with_a_narrow_gap_stay_apart():
    houses = turned(np.array([shapely.box(0, 0, 18, 25), shapely.box(18.5, 0, 36, 25.4)], dtype=object))
    result = estimate_displacements(houses, evidence_of(houses), GRID)
    assert not found(result).any()


def test_an_outline_cut_by_the_end_of_the_points_stays():
    truth = np.array([shapely.box(-14, 0, 6, 12), shapely.box(6, 0, 16, 12)], dtype=object)
    evidence, surface = evidence_of(truth), np.zeros(GRID.shape)
    x = GRID.centres()[0]
    evidence[:, x < 0] = 0
    surface[:, x < 0] = np.nan
    assert not found(estimate_displacements(truth, evidence, GRID, surface)).any()


def test_without_evidence_nothing_moves():
    truth = terrace()
    result = estimate_displacements(truth, np.zeros(GRID.shape, np.float32), GRID)
    assert not found(result).any() and set(result.status) == {"not observable"}
    assert (result.sigma == 2.5).all()


def test_missing_empty_and_distant_outlines_keep_their_row():
    far = shapely.box(5000, 5000, 5010, 5010)
    polygons = np.array([None, shapely.Polygon(), far, *terrace()], dtype=object)
    result = estimate_displacements(polygons, evidence_of(terrace()), GRID)
    assert list(result.status[:3]) == ["not observable"] * 3
    assert len(result.dx) == len(polygons)
    assert shifted_outlines(polygons, result)[0] is None


def test_no_outline_at_all():
    result = estimate_displacements(np.array([], dtype=object), np.zeros(GRID.shape), GRID)
    assert len(result.dx) == len(shifted_outlines(np.array([], dtype=object), result)) == 0


def test_heights_of_the_outline_are_kept():
    solid = shapely.Polygon([(0, 0, 3), (8, 0, 4), (8, 9, 5), (0, 9, 6)])
    flat = shapely.box(20, 0, 28, 9)
    truth = np.array([solid, flat], dtype=object)
    result = estimate_displacements(shifted(np.array([shapely.force_2d(solid), flat]), [[1, 1], [1, 1]]),
                                    evidence_of(truth), GRID)
    there = shifted_outlines(truth, result)
    assert shapely.get_coordinates(there[0], include_z=True)[:, 2].tolist() == [3, 4, 5, 6, 3]
    assert list(shapely.has_z(there)) == [True, False]


def test_two_outlines_above_one_another_do_not_repel():
    truth = np.array([shapely.box(0, 0, 10, 12), shapely.box(0, 0, 10, 12)], dtype=object)
    result = estimate_displacements(truth, evidence_of(truth), GRID)
    assert not found(result).any()


def test_equal_sheds_side_by_side_do_not_change_places():
    row = turned(np.array([shapely.box(2.4 * k, 0, 2.4 * (k + 1), 3) for k in range(6)], dtype=object))
    noise = np.random.default_rng(6).normal(0, 0.4, GRID.shape)
    result = estimate_displacements(row, np.clip(evidence_of(row) + noise, -1, 1), GRID)
    assert not found(result).any()


def test_an_outline_without_points_is_not_observable():
    truth = terrace()
    surface = np.full(GRID.shape, 5.0)
    x, y = np.meshgrid(*GRID.centres())
    shapely.prepare(truth[0])
    surface[shapely.contains_xy(truth[0], x, y)] = np.nan
    result = estimate_displacements(truth, evidence_of(truth), GRID, surface)
    assert result.status[0] == "not observable" and set(result.status[1:]) == {"kept"}


def test_bad_input_is_refused():
    with pytest.raises(InputError, match="same rows and columns"):
        estimate_displacements(terrace(), np.zeros((3, 3)), GRID)
    with pytest.raises(InputError, match="longest shift"):
        estimate_displacements(terrace(), np.zeros(GRID.shape), GRID, max_shift=0)


def test_an_outline_on_bare_ground_stays():
    bare = np.full(GRID.shape, -1.0, np.float32)
    bare[:, GRID.columns // 2:] = 0.0  # the survey ends here
    x = GRID.x_min + GRID.columns / 2 * GRID.cell
    y = GRID.y_max - GRID.rows / 2 * GRID.cell
    unary = np.array([shapely.box(x - 5, y - 5, x + 5, y + 5)], dtype=object)
    result = estimate_displacements(unary, bare, GRID)
    assert found(result).tolist() == [[0.0, 0.0]] and result.status.tolist() == ["not observable"]


def test_lattice_of_shifts_holds_what_lies_at_the_very_reach():
    lattice = shift_lattice(0.1, 0.3)  # three steps of 0.1 are a little more than 0.3 in floating point
    assert {(3, 0), (-3, 0), (0, 3), (0, -3)} <= set(map(tuple, lattice.tolist())) and np.abs(lattice).max() == 3
