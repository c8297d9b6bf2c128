"""Normal distributions and matching to them, against plain formulas and differences."""

import numpy as np
import pytest

from urbanmap_qgis.mobile.registration.matching.ndt_map import build_ndt
from urbanmap_qgis.mobile.registration.matching.ndt_match import (
    Mixture,
    RigidMotion,
    match_points,
    ndt_terms,
    rigid_derivatives,
    rotation_matrix,
)


def blobs(dimensions, seed=3):
    rng = np.random.default_rng(seed)
    centres = rng.uniform(0, 12, (40, dimensions)) * ([1, 1, 0.2][:dimensions])
    return np.concatenate([c + rng.normal(0, 0.25, (60, dimensions)) * ([1, 0.4, 0.2][:dimensions]) for c in centres])


@pytest.mark.paper("J 3.2.4.1, eq. 5, 6")
@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_cell_holds_mean_and_covariance_of_its_points(dimensions):
    points = blobs(dimensions) + 1000.0
    ndt = build_ndt(points, 2.0, min_ratio=1e-12)
    cell = np.floor(points / 2.0)
    for number in range(len(ndt)):
        here = (cell == np.floor((ndt.mean[number] + ndt.origin) / 2.0)).all(axis=1)
        assert np.allclose(points[here].mean(axis=0), ndt.mean[number] + ndt.origin)
        if here.sum() < 10:
            continue  # nearly flat: the inverse has no digits to compare
        assert np.allclose(np.linalg.inv(ndt.inverse[number]), np.cov(points[here].T), rtol=1e-6, atol=1e-12)


def test_cells_with_few_points_and_points_on_a_line():
    line = np.column_stack([np.linspace(0.05, 0.95, 20), np.full(20, 0.5)])
    ndt = build_ndt(np.concatenate([line, [[5.5, 5.5], [5.6, 5.5]]]), 1.0)
    assert len(ndt) == 1  # two points are no distribution
    values = np.linalg.eigvalsh(np.linalg.inv(ndt.inverse[0]))
    assert values[0] == pytest.approx(1e-3 * values[1], rel=1e-6)


def test_no_points_at_all():
    ndt = build_ndt(np.zeros((0, 2)), 1.0)
    terms = ndt_terms(ndt, np.array([[3.0, 4.0]]), Mixture.of(0.3, 1.0, 2))
    assert len(ndt) == 0 and terms.value[0] == 0 and not terms.gradient.any()


@pytest.mark.paper("J 3.2.4.3, eq. 7, 10, 11")
@pytest.mark.parametrize(("share", "cell", "dimensions"), [(0.3, 1.0, 2), (0.55, 2.0, 3)])
def test_mixture_meets_the_log_likelihood_where_magnusson_fits_it(share, cell, dimensions):
    mixture = Mixture.of(share, cell, dimensions)
    c1, c2 = 10 * (1 - share), share / cell ** dimensions

    def exact(q):
        return -np.log(c1 * np.exp(-q / 2) + c2)

    floor = -np.log(c2)
    for q in (0.0, 1.0):
        assert floor - mixture.height * np.exp(-mixture.sharpness * q / 2) == pytest.approx(exact(q))
    assert exact(60.0) == pytest.approx(floor)


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("cells", ["neighbours", "own", "closest"])
def test_derivatives_of_points_equal_differences(dimensions, cells):
    ndt = build_ndt(blobs(dimensions), 1.0, 0.03)
    mixture = Mixture.of(0.35, 1.0, dimensions)
    rng = np.random.default_rng(5)
    points = blobs(dimensions)[rng.integers(0, 2400, 200)] + rng.normal(0, 0.1, (200, dimensions))
    inside = points - ndt.origin
    points = points[(np.abs(inside - np.round(inside)) > 1e-3).all(axis=1)]  # not on a cell's border
    step = 1e-5
    terms = ndt_terms(ndt, points, mixture, cells)
    for axis in range(dimensions):
        off = step * np.eye(dimensions)[axis]
        up, down = (ndt_terms(ndt, points + sign * off, mixture, cells) for sign in (1, -1))
        assert np.allclose((up.value - down.value) / (2 * step), terms.gradient[:, axis], atol=2e-4)
        assert np.allclose((up.gradient - down.gradient) / (2 * step), terms.hessian[:, axis], atol=2e-2, rtol=1e-4)


def test_bound_touches_from_below():
    ndt, mixture = build_ndt(blobs(2), 1.0, 0.03), Mixture.of(0.35, 1.0, 2)
    points = blobs(2)[::7] + 0.05
    terms = ndt_terms(ndt, points, mixture, bound=True)
    assert (np.linalg.eigvalsh(terms.hessian) <= 1e-9).all()
    off = np.array([0.004, -0.003])
    inside = points - ndt.origin
    stays = (np.floor(inside) == np.floor(inside + off)).all(axis=1)
    parabola = terms.value + terms.gradient @ off + 0.5 * np.einsum("i,nij,j->n", off, terms.hessian, off)
    assert (ndt_terms(ndt, points + off, mixture).value[stays] >= parabola[stays] - 1e-9).all()


@pytest.mark.parametrize("dimensions", [2, 3])
def test_derivatives_of_a_movement_equal_differences(dimensions):
    ndt, mixture = build_ndt(blobs(dimensions), 2.0, 0.05), Mixture.of(0.35, 2.0, dimensions)
    points = blobs(dimensions)[::9] + 0.01
    centre = np.full(dimensions, 4.0)
    count = 3 if dimensions == 2 else 6
    pose = RigidMotion.identity(centre)

    def at(step):
        moved = pose.after(step).transform(points)
        return ndt_terms(ndt, moved, mixture).value.sum()

    found = rigid_derivatives(points, centre, ndt_terms(ndt, points, mixture))
    h = 2e-4
    unit = np.eye(count) * h
    gradient = [(at(unit[k]) - at(-unit[k])) / (2 * h) for k in range(count)]
    hessian = [[(at(unit[a] + unit[b]) - at(unit[a] - unit[b]) - at(unit[b] - unit[a]) + at(-unit[a] - unit[b]))
                / (4 * h * h) for a in range(count)] for b in range(count)]
    assert np.allclose(found.gradient, gradient, rtol=1e-3, atol=np.abs(gradient).max() * 1e-3)
    assert np.allclose(found.hessian, hessian, rtol=2e-2, atol=np.abs(hessian).max() * 2e-3)


@pytest.mark.paper("J 3.2.4.3, eq. 12")
@pytest.mark.parametrize("dimensions", [2, 3])
def test_a_known_movement_is_found(dimensions):
    places = blobs(dimensions)
    ndt, mixture = build_ndt(places, 1.0, 0.03), Mixture.of(0.35, 1.0, dimensions)
    centre = places.mean(axis=0)
    step = np.array([0.15, -0.1, 0.02]) if dimensions == 2 else np.array([0.1, -0.08, 0.05, 0.01, -0.008, 0.015])
    moved = RigidMotion.identity(centre).after(step).transform(places)
    # Cells draw points a little: this is where they converge.
    fixed = match_points(places, RigidMotion.identity(centre), ndt, mixture)
    match = match_points(moved, RigidMotion.identity(centre), ndt, mixture)
    assert match.converged
    assert np.abs(match.pose.transform(moved) - fixed.pose.transform(places)).max() < 0.02
    assert np.abs(match.pose.transform(moved) - places).max() < 0.06


def test_turns_are_rotations():
    turn = np.array([[0.3, -0.2, 0.5], [0.0, 0.0, 0.0], [0.0, 0.0, np.pi / 2]])
    matrices = rotation_matrix(turn)
    assert np.allclose(matrices @ np.swapaxes(matrices, 1, 2), np.eye(3))
    assert np.allclose(matrices[2] @ [1, 0, 0], [0, 1, 0])
    assert np.allclose(matrices[0] @ turn[0], turn[0])


@pytest.mark.parametrize("dimensions", [2, 3])
def test_points_beyond_a_map_fall_on_its_outermost_empty_cells(dimensions):
    found = build_ndt(np.random.default_rng(2).uniform(0.0, 6.0, (400, dimensions)), 2.0)
    middle = np.array(found.shape) * found.cell / 2
    for axis in range(dimensions):
        for side, at in ((-1, 0), (1, found.shape[axis] - 1)):
            place = middle.copy()
            place[axis] += side * 100.0
            cell = np.unravel_index(found.cells_of(place[None]), found.shape)
            assert cell[axis] == at and found.number[found.cells_of(place[None])] == -1
