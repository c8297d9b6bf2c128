"""Radius outlier removal against counts by brute force."""

import numpy as np
import pytest

from urbanmap_qgis.buildings.polygons.radius_outliers import EXPECTED_NEIGHBOURS, default_radius, remove_radius_outliers
from urbanmap_qgis.errors import InputError


@pytest.mark.paper("J 5.3.3, 1")
def test_counts_agree_with_all_pairs():
    xy = np.random.default_rng(1).uniform(0, 10, (300, 2))
    near = np.hypot(*(xy[:, None] - xy[None]).transpose(2, 0, 1)) <= 0.7
    expected = near.sum(axis=1) - 1 >= 4
    assert 0 < expected.sum() < 300
    np.testing.assert_array_equal(remove_radius_outliers(xy, 0.7, 4), expected)


def test_lone_points_leave_and_corners_of_a_roof_stay():
    density = 8.0
    rng = np.random.default_rng(2)
    roof = rng.uniform(0, 20, (int(400 * density), 2))
    keep = remove_radius_outliers(np.vstack([roof, [[30.0, 30.0], [40.0, 5.0]]]), default_radius(density))
    assert not keep[-2:].any()
    assert keep[:-2].mean() > 0.999


def test_default_radius_holds_the_expected_number():
    assert np.pi * default_radius(7.0) ** 2 * 7.0 == pytest.approx(EXPECTED_NEIGHBOURS)


def test_empty_and_wrong_input():
    assert remove_radius_outliers(np.zeros((0, 2)), 1.0).shape == (0,)
    with pytest.raises(InputError):
        remove_radius_outliers(np.zeros((3, 2)), 0.0)
    with pytest.raises(InputError):
        default_radius(0.0)
