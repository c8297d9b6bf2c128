"""Normals from voxels and statistical outliers."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.facades.normals import voxel_normals
from urbanmap_qgis.facades.statistical_outliers import statistical_outliers


def wall(rng, n, azimuth, lean=0.0, noise=0.01):
    """Points of a wall of 10 x 6 m through a far place, and its normal."""
    turn, tilt = np.radians(azimuth), np.radians(lean)
    normal = np.array([np.sin(turn) * np.cos(tilt), np.cos(turn) * np.cos(tilt), np.sin(tilt)])
    along = np.array([-np.cos(turn), np.sin(turn), 0.0])
    up = np.cross(along, normal)
    uv = rng.uniform([0, 0], [10, 6], (n, 2))
    points = np.array([-7000.0, -34000.0, 20.0]) + uv[:, :1] * along + uv[:, 1:] * up
    return points + rng.normal(0, noise, (n, 1)) * normal, normal


@pytest.mark.paper("J 5.7, normals")
@pytest.mark.parametrize(("azimuth", "lean"), [(0, 0), (37, 0), (200, 8), (271, -12)])
def test_normals_of_walls(azimuth, lean):
    rng = np.random.default_rng(azimuth)
    points, normal = wall(rng, 6000, azimuth, lean)
    voxels = voxel_normals(points)
    angle = np.degrees(np.arccos(np.minimum(np.abs(voxels.normal @ normal), 1)))
    assert np.median(angle) < 1.0 and np.quantile(angle, 0.95) < 4.0
    assert voxels.upright.mean() > 0.97
    assert np.median(voxels.thickness) == pytest.approx(0.01, abs=0.002)


def test_voxels_hold_their_points():
    rng = np.random.default_rng(2)
    points = rng.uniform([-7000, 5000, 3], [-6995, 5004, 6], (3000, 3))
    voxels = voxel_normals(points)
    assert voxels.count.sum() == 3000
    for voxel in (0, 11, len(voxels.count) - 1):
        own = points[voxels.of_point == voxel]
        assert own.mean(axis=0) == pytest.approx(voxels.mean[voxel], abs=1e-6)
        assert (np.ptp(own, axis=0) <= voxels.size + 1e-6).all()
    # The covariance of a neighbourhood against numpy's own.
    at = int(np.argmax(voxels.support))
    around = np.abs(voxels.index - voxels.index[at]).max(axis=1) <= 1
    near = points[np.isin(voxels.of_point, np.flatnonzero(around))]
    assert len(near) == voxels.support[at]
    values = np.sqrt(np.linalg.eigvalsh(np.cov(near.T, bias=True)))
    assert [voxels.thickness[at], voxels.extent[at]] == pytest.approx(values[:2].tolist(), rel=1e-6)


@pytest.mark.paper("J 5.7, normals")
def test_roofs_ground_and_foliage_are_no_walls():
    rng = np.random.default_rng(4)
    flat = np.column_stack([rng.uniform(0, 10, (5000, 2)), 3 + rng.normal(0, 0.01, 5000)])
    assert not voxel_normals(flat).upright.any()
    bank = wall(rng, 5000, 77, 50)[0]
    assert not voxel_normals(bank).upright.any() and np.isnan(voxel_normals(bank).normal).mean() > 0.9
    leaves = rng.uniform(0, 4, (5000, 3))
    assert voxel_normals(leaves).upright.mean() < 0.02


def test_voxels_grow_where_points_are_thin():
    rng = np.random.default_rng(6)
    dense, thin = wall(rng, 6000, 20)[0], wall(rng, 250, 20)[0]
    assert voxel_normals(dense).size < voxel_normals(thin).size
    assert voxel_normals(thin).upright.mean() > 0.8


@pytest.mark.paper("J 5.7, outliers")
def test_outliers_are_lonely_points():
    rng = np.random.default_rng(7)
    places = np.concatenate([rng.uniform(0, 5, (2000, 3)) * (1, 1, 0.01), [[2, 2, 3.0], [9, 9, 9.0]]])
    found = statistical_outliers(places)
    assert found[-2:].all() and found[:-2].mean() < 0.02


def test_few_points_have_no_outliers_and_bad_settings_are_refused():
    assert not statistical_outliers(np.eye(3)).any()
