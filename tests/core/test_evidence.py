"""Building evidence of points whose truth is known."""

import numpy as np
import pytest

from urbanmap_qgis.buildings.outlines.evidence import EvidenceAccumulator, evidence_cell
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid

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
