"""The reference's coverage as a smooth field, and the sums of the points' terms."""

import numpy as np
import pytest
import shapely
from pyproj import CRS

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.raster import write_raster
from urbanmap_qgis.mobile.registration.matching.correction_curve import CorrectionCurve, curve_covariance, curve_step
from urbanmap_qgis.mobile.registration.matching.ndt_match import RigidMotion
from urbanmap_qgis.mobile.registration.matching.patch_sums import PLANE, SPACE, PatchSums, point_gradients, sum_points
from urbanmap_qgis.mobile.registration.matching.subpixel import MarkingField, field_terms
from urbanmap_qgis.mobile.registration.start.patch_points import PatchPoints
from urbanmap_qgis.mobile.registration.start.reference import Coverage, Reference
from urbanmap_qgis.mobile.trajectory import Trajectory, attitude_angles, move_points, rotations

BACKGROUND = 0.1
CRS_WKT = CRS.from_epsg(6677).to_wkt()


def bar_coverage():
    share = np.zeros((80, 90), dtype=np.float32)
    share[30:34, 20:60] = 1.0
    share[10:50, 70:72] = 0.7
    return Coverage(Grid(500.0, 900.0, 0.12, 80, 90), share)


def test_full_coverage_and_far_outside():
    full = MarkingField.of(Coverage(Grid(0, 12, 0.12, 100, 100), np.ones((100, 100), np.float32)), 0.0, BACKGROUND)
    terms = field_terms(full, np.array([6.0, 5000.0]), np.array([6.0, 6.0]))
    assert terms.share[0] == pytest.approx(1.0, abs=1e-6)
    assert terms.value[0] == pytest.approx(np.log(1 + 1 / BACKGROUND), abs=1e-6)
    assert abs(terms.gx[0]) < 1e-5
    assert terms.share[1] == 0 and terms.value[1] == 0 and terms.gx[1] == 0


@pytest.mark.parametrize("blur", [0.0, 0.15])
def test_derivatives_equal_differences(blur):
    field = MarkingField.of(bar_coverage(), blur, BACKGROUND)
    rng = np.random.default_rng(1)
    x, y = rng.uniform(501.5, 509.5, 500), rng.uniform(893, 899, 500)
    h, terms = 1e-3, field_terms(field, x, y)
    east, west = field_terms(field, x + h, y), field_terms(field, x - h, y)
    north, south = field_terms(field, x, y + h), field_terms(field, x, y - h)
    for found, up, down in ((terms.gx, east.value, west.value), (terms.gy, north.value, south.value),
                            (terms.hxx, east.gx, west.gx), (terms.hxy, north.gx, south.gx),
                            (terms.hyy, north.gy, south.gy)):
        assert np.allclose(found, (up - down) / (2 * h), atol=0.004 * np.abs(found).max())


def test_a_line_tells_nothing_along_itself():
    share = np.zeros((400, 60), dtype=np.float32)
    share[:, 30] = 1.0
    field = MarkingField.of(Coverage(Grid(0, 48, 0.12, 400, 60), share), 0.0, BACKGROUND)
    y = np.random.default_rng(2).uniform(5, 40, 3000)
    terms = field_terms(field, np.full(3000, 3.66), y)
    assert np.abs(terms.gy).max() < 1e-4 and np.abs(terms.hyy).max() < 1e-2
    assert (-terms.hxx).min() > 10


def test_reference_from_mask_and_from_polygons_agree(tmp_path):
    box = shapely.box(501.2, 893.0, 504.08, 896.0)
    grid = Grid(500.0, 900.0, 0.12, 100, 100)
    x, y = grid.centres()
    mask = ((x > 501.2) & (x < 504.08))[None, :] & ((y > 893.0) & (y < 896.0))[:, None]
    write_raster(tmp_path / "mask.tif", mask.astype(np.uint8) * 255, grid, CRS_WKT, nodata=None)
    by_mask, by_polygon = Reference.from_mask(tmp_path / "mask.tif"), Reference.from_polygons([box])
    for reference in (by_mask, by_polygon):
        cover = reference.coverage(495.0, 889.0, 508.0, 899.0)
        area = cover.share.sum() * cover.grid.cell ** 2
        assert area == pytest.approx(box.area, rel=0.02)
        assert np.allclose(cover.points().mean(axis=0), [box.centroid.x, box.centroid.y], atol=0.06)
        assert not reference.has_heights
    assert not by_mask.coverage(100.0, 100.0, 110.0, 110.0).share.any()  # off the raster


def test_reference_heights_from_polygons_with_z_and_refusals(tmp_path):
    ring = [(0, 0, 10.0), (4, 0, 10.4), (4, 1, 10.4), (0, 1, 10.0)]
    reference = Reference.from_polygons([shapely.Polygon(ring)])
    assert reference.has_heights
    height = reference.heights(np.array([2.0, 50.0]), np.array([0.5, 50.0]))
    assert 10.1 < height[0] < 10.3 and np.isnan(height[1])
    with pytest.raises(InputError):
        Reference.from_polygons([shapely.LineString([(0, 0), (1, 1)])])
    with pytest.raises(InputError):
        Reference.from_polygons([])
    write_raster(tmp_path / "coarse.tif", np.ones((5, 5), np.uint8), Grid(0, 5, 1.0, 5, 5), CRS_WKT, nodata=None)
    with pytest.raises(InputError):
        Reference.from_mask(tmp_path / "coarse.tif")


def random_terms(count, patches, seed=3):
    rng = np.random.default_rng(seed)
    r = rng.uniform(-30, 30, (count, 3))
    g = rng.normal(size=(count, 3))
    h = rng.normal(size=(count, 3, 3))
    h = h + np.swapaxes(h, 1, 2)
    return r, g, h, np.sort(rng.integers(0, patches, count))


def test_sums_are_those_of_the_movement_about_any_centre():
    r, g, h, patch = random_terms(500, 7)
    hessian = {(a, b): h[:, a, b] for a in range(3) for b in range(a, 3)}
    sums = sum_points(r, (g[:, 0], g[:, 1], g[:, 2]), hessian, patch, 7)
    centre = np.array([4.0, -3.0, 1.5])
    moved = sums.about(np.tile(centre, (7, 1)))
    for number in range(7):
        here = patch == number
        jacobian = np.zeros((here.sum(), 3, 6))
        for k in range(3):
            jacobian[:, k, k] = 1.0
            turn = np.eye(3)[k]
            jacobian[:, :, 3 + k] = np.cross(turn, r[here] - centre)
        assert np.allclose(moved.gradient[number], np.einsum("nij,ni->j", jacobian, g[here]))
        assert np.allclose(moved.information[number], -np.einsum("nki,nkl,nlj->ij", jacobian, h[here], jacobian))
    windows = sums.windows(np.array([1, 0]), np.array([3, 6]))
    assert np.allclose(windows.gradient[0], sums.gradient[1:4].sum(axis=0))
    assert np.allclose(windows.information[1], sums.information.sum(axis=0))
    assert np.allclose(point_gradients(r, (g[:, 0], g[:, 1], g[:, 2])).sum(axis=0), sums.gradient.sum(axis=0))


@pytest.mark.parametrize("active", [PLANE, SPACE])
def test_course_step_and_covariance_equal_the_dense_solution(active):
    rng = np.random.default_rng(6)
    count = 12
    curve = CorrectionCurve(np.arange(count) * 0.5, np.r_[np.zeros(6), np.full(6, 8.0)], rng.normal(0, 0.1, (count, 3)),
                    rng.normal(0, 1e-3, (count, 3)))
    half = rng.normal(size=(count, 6, 6)) * np.array([20, 20, 20, 500, 500, 500])[:, None]
    sums = PatchSums(rng.normal(0, 50, (count, 6)), half @ np.swapaxes(half, 1, 2))
    step = curve_step(curve, sums, active)
    covariance = curve_covariance(curve, sums.information, active)
    # The same system at once, from the random walk's definition.
    from urbanmap_qgis.mobile.registration.matching import correction_curve as module

    pick, size = list(active), len(active)
    dense = np.zeros((count * size, count * size))
    right = np.zeros((count, size))
    state = np.concatenate([curve.translation, curve.rotation], axis=1)[:, pick]
    for k in range(count):
        block = slice(k * size, (k + 1) * size)
        hold = np.diag(1 / (module._PRIOR_SIGMA[pick] ** 2 * count))
        dense[block, block] += sums.information[k][np.ix_(pick, pick)] + hold
        right[k] += sums.gradient[k, pick] - np.diag(hold) * state[k]
    for k in range(count - 1):
        wait = curve.stop_time[k + 1] - curve.stop_time[k]
        stiff = 1 / (module.DRIFT[pick] ** 2 * 0.5 + module.STANDING_DRIFT[pick] ** 2 * wait)
        for i, j, sign in ((k, k, 1), (k + 1, k + 1, 1), (k, k + 1, -1), (k + 1, k, -1)):
            dense[i * size:(i + 1) * size, j * size:(j + 1) * size] += sign * np.diag(stiff)
        right[k] += stiff * (state[k + 1] - state[k])
        right[k + 1] -= stiff * (state[k + 1] - state[k])
    assert np.allclose(step[:, pick].ravel(), np.linalg.solve(dense, right.ravel()), rtol=1e-6, atol=1e-9)
    inverse = np.linalg.inv(dense)
    for k in range(count):
        block = slice(k * size, (k + 1) * size)
        assert np.allclose(covariance[k][np.ix_(pick, pick)], inverse[block, block], rtol=1e-5, atol=1e-12)


def test_a_course_moves_points_as_the_corrected_trajectory_does():
    rng = np.random.default_rng(9)
    time = np.arange(0, 10, 0.5)
    place = np.column_stack([5.0 * time, 2.0 * time, np.full_like(time, 3.0)]) + np.array([-7000, -34000, 0])
    angles = np.column_stack([np.full_like(time, 1.0), np.full_like(time, -2.0), 60 + time])
    reported = Trajectory(time, place, angles)
    turn, shift = rng.normal(0, 2e-3, (len(time), 3)), rng.normal(0, 0.8, (len(time), 3))
    still = RigidMotion.identity(np.zeros(3))
    turned = [attitude_angles(still.after(np.r_[0, 0, 0, t]).rotation[None] @ rotations(a[None]))[0]
              for t, a in zip(turn, angles)]
    corrected = Trajectory(time, place + shift, np.array(turned))
    at = rng.uniform(0, 9.5, 300)
    chainage = np.hypot(5.0, 2.0) * time
    body = np.column_stack([np.interp(at, time, place[:, k]) for k in range(3)])
    points = body + rng.uniform(-15, 15, (300, 3))
    curve = CorrectionCurve(chainage, np.zeros(len(chainage)), shift, turn)
    order = np.argsort(at)
    moved = curve.transform(PatchPoints(points[order], (points - body)[order], np.interp(at, time, chainage)[order],
                                     np.zeros(300, int), np.ones(300)))
    assert np.abs(moved - move_points(points, at, reported, corrected)[order]).max() < 1e-3
