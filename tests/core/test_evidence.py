"""Building evidence of points whose truth is known."""

import gc
import pickle
import weakref

import numpy as np
import pytest
import shapely

from urbanmap_qgis.buildings.outlines.evidence import EvidenceAccumulator, evidence_cell
from urbanmap_qgis.buildings.quality import RoofCell, height_differences, model_fit
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.geometry.kept_answers import Kept
from urbanmap_qgis.geometry.ring_products import cross_with_next

GRID = Grid.covering(0, 0, 39.9, 39.9, 0.5)


def scene(seed=1, density=8):
    """Flat ground, a gable roof on x 8..18, y 8..20 and a tree on x 25..33, y 10..18: points, classes, returns."""
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(0, 40, (2, 1600 * density))
    roof = (x > 8) & (x < 18) & (y > 8) & (y < 20)
    tree = (x > 25) & (x < 33) & (y > 10) & (y < 18)
    z = rng.normal(0, 0.03, len(x))
    z = np.where(roof, 8 - 0.8 * np.abs(x - 13) + rng.normal(0, 0.03, len(x)), z)
    z = np.where(tree, rng.uniform(3, 9, len(x)), z)
    classes = np.where(roof, 6, np.where(tree, 5, 2))
    return x, y, z, classes, np.where(tree, 3, 1)


def evidence_of(x, y, z, classes=None, returns=None, chunks=1):
    accumulator = EvidenceAccumulator(GRID)
    for part in np.array_split(np.arange(len(x)), chunks):
        accumulator.add(x[part], y[part], z[part], None if classes is None else classes[part], None,
                        None if returns is None else returns[part])
    return accumulator, accumulator.evidence(np.zeros(GRID.shape, np.float32))


def regions():
    x, y = np.meshgrid(*GRID.centres())
    roof = (x > 9) & (x < 17) & (y > 9) & (y < 19)
    tree = (x > 26) & (x < 32) & (y > 11) & (y < 17)
    street = (x < 7) | (y < 7)
    return roof, tree, street


@pytest.mark.parametrize("classed", [True, False])
@pytest.mark.parametrize("density", [8, 2])
def test_roof_street_and_tree_are_told_apart(classed, density):
    x, y, z, classes, returns = scene(density=density)
    _, evidence = evidence_of(x, y, z, classes if classed else None, returns)
    roof, tree, street = regions()
    assert evidence.dtype == np.float32 and np.abs(evidence).max() <= 1
    assert evidence[roof].mean() > 0.7
    assert evidence[street].mean() < -0.95
    assert evidence[tree].mean() < 0.1


def test_a_tree_is_foliage_also_when_returns_are_unknown():
    x, y, z, _, _ = scene()
    _, evidence = evidence_of(x, y, z)
    roof, tree, _ = regions()
    assert evidence[tree].mean() < 0.15 < 0.9 < evidence[roof].mean()


def test_chunks_and_order_do_not_matter():
    x, y, z, classes, returns = scene()
    order = np.random.default_rng(2).permutation(len(x))
    whole = evidence_of(x, y, z, classes, returns)[1]
    cut = evidence_of(x[order], y[order], z[order], classes[order], returns[order], chunks=7)[1]
    assert np.array_equal(whole, cut)


def test_a_wall_shows_where_in_the_cell_it_stands():
    x = np.r_[np.linspace(0.01, 0.37, 37), np.linspace(0.38, 0.49, 12)]
    accumulator = EvidenceAccumulator(GRID)
    accumulator.add(x, np.full(len(x), 0.25), np.where(x < 0.375, 5.0, 0.0), np.where(x < 0.375, 6, 2))
    assert accumulator.evidence(np.zeros(GRID.shape))[-1, 0] == pytest.approx((37 - 12) / 49)


def test_no_points_is_no_evidence():
    accumulator = EvidenceAccumulator(GRID)
    accumulator.add(*np.zeros((3, 0)))
    accumulator.add(np.array([1000.0, np.nan, 3.0]), np.array([5.0, 5.0, np.inf]), np.array([1.0, 1.0, 1.0]))
    assert not accumulator.evidence(np.zeros(GRID.shape)).any()
    assert np.isnan(accumulator.surface).all()


def test_unknown_ground_is_no_evidence_without_classes():
    x, y, z, _, _ = scene()
    accumulator, _ = evidence_of(x, y, z)
    assert not accumulator.evidence(np.full(GRID.shape, np.nan)).any()


def test_ground_of_another_grid_is_refused():
    with pytest.raises(InputError, match="same grid"):
        EvidenceAccumulator(GRID).evidence(np.zeros((3, 3)))


def test_cell_follows_the_density():
    assert evidence_cell(16) == 0.5
    assert evidence_cell(1.5) == pytest.approx(np.sqrt(1 / 1.5))
    assert evidence_cell(0.1) == 1.0
    with pytest.raises(InputError, match="density"):
        evidence_cell(0)


# Fit of points to flat models


WALLS = np.array([[0, 0, 10, 0, 0, 5], [10, 0, 10, 10, 0, 5], [10, 10, 0, 10, 0, 5], [0, 10, 0, 0, 0, 5.0]])
BOX = [RoofCell(shapely.box(0, 0, 10, 10), 5.0)]


def test_distances_to_roof_wall_and_edge():
    x, y, z = np.array([[5, 5, 7], [5, 5, 4], [12, 5, 2], [13, 5, 9], [9.5, 5, 3]], float).T
    fit = model_fit(x, y, z, BOX, WALLS)
    # over the roof by 2, under it by 1, 2 beside a wall, 3-4-5 off the edge, 0.5 inside a wall
    assert fit.rmse_3d == pytest.approx(np.sqrt((4 + 1 + 4 + 25 + 0.25) / 5))
    assert fit.coverage == pytest.approx(3 / 5)
    assert fit.rmse_z == pytest.approx(np.sqrt((4 + 1 + 4) / 3))
    assert fit.median_dz == pytest.approx(2)


def test_trimmed_rmse_leaves_out_the_worst_twentieth():
    x = np.linspace(1, 9, 100)
    z = np.full(100, 5.1)
    z[:5] = 50
    fit = model_fit(x, x, z, BOX, WALLS)
    assert fit.rmse_z95 == pytest.approx(0.1) and fit.rmse_z > 9


def test_the_upper_of_two_overlapping_roofs_counts():
    cells = [RoofCell(shapely.box(0, 0, 4, 4), 9.0), *BOX]
    dz = height_differences(np.array([1.0, 6.0, 20.0]), np.array([1.0, 6.0, 20.0]), np.full(3, 9.0), cells)
    assert dz[:2].tolist() == [0.0, 4.0] and np.isnan(dz[2])


def test_no_points_or_no_model_gives_no_figures():
    none = np.zeros(0)
    assert np.isnan(model_fit(none, none, none, BOX, WALLS).rmse_z)
    fit = model_fit(np.ones(2), np.ones(2), np.ones(2), [], WALLS[:0])
    assert fit.coverage == 0 and np.isnan(fit.rmse_3d)


# Answers kept with the thing they were given for, and products of rings


class Thing:
    def __init__(self, value):
        self.value = value


def test_each_thing_is_worked_on_once_and_forgotten_with_the_thing():
    asked = []

    @Kept
    def double(thing):
        """Twice its value."""
        asked.append(thing.value)
        return 2 * thing.value

    first, same = Thing(3), Thing(3)
    assert [double(first), double(first), double(same)] == [6, 6, 6] and asked == [3, 3]
    assert double.__name__ == "double" and double.__doc__ == "Twice its value."
    gone = weakref.ref(first)
    del first
    gc.collect()
    assert gone() is None
    assert pickle.loads(pickle.dumps(same)).value == 3


@pytest.mark.parametrize("corners", [1, 3, 8, 50])
def test_products_of_a_ring_are_numpys_to_the_last_digit(corners):
    ring = np.random.default_rng(corners).uniform(-1e5, 1e5, (corners, 3))
    assert np.array_equal(cross_with_next(ring), np.cross(ring, np.roll(ring, -1, axis=0)))
