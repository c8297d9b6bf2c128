"""Known answers for the height histogram of J 5.3.2."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urbanmap_qgis.buildings.roofs.height_histogram import height_histogram, height_peaks, minimum_points
from urbanmap_qgis.errors import InputError


def level(height, n, spread=0.0):
    """n heights spread evenly over height +- spread."""
    return height + np.linspace(-spread, spread, n)


@pytest.mark.paper("J 5.3.2, alpha", "J 5.4.2")
def test_alpha_of_the_paper():
    assert minimum_points(50.0, 7.0) == 350.0


@pytest.mark.paper("J 5.3.2, histogram")
def test_bins_are_half_a_metre_wide_and_overlap_by_eighty_percent():
    centre, count = height_histogram(np.array([10.0]))
    np.testing.assert_allclose(np.diff(centre), 0.1)
    assert count.sum() == 5  # one point lies in five overlapping bins
    np.testing.assert_allclose(centre[count == 1], [9.85, 9.95, 10.05, 10.15, 10.25])
    assert count[0] == count[-1] == 0


def test_a_bin_holds_its_lower_end_only():
    centre, count = height_histogram(np.array([0.3, 0.8]), 0.5, 0.5)
    assert dict(zip(centre.round(2), count))[0.25] == 1
    assert dict(zip(centre.round(2), count))[0.75] == 1
    centre, count = height_histogram(np.arange(10) / 10, 0.1, 0.1)
    assert count.sum() == 10 and count.max() == 1


@given(st.lists(st.floats(-50, 400), min_size=1, max_size=200))
@settings(max_examples=50, deadline=None)
def test_histogram_counts_every_point_the_same_number_of_times(z):
    _, count = height_histogram(np.array(z), 0.5, 0.1)
    assert count.sum() == 5 * len(z)


def test_every_level_of_alpha_points_is_a_roof():
    z = np.concatenate([level(12.0, 351, 0.1), level(25.0, 2000, 0.1), level(40.0, 349, 0.1)])
    peaks = height_peaks(z, alpha=minimum_points(50.0, 7.0))
    np.testing.assert_allclose(peaks.height, [12.0, 25.0], atol=0.15)
    np.testing.assert_array_equal(peaks.count, [351, 2000])
    assert 12.1 < peaks.upper[0] == peaks.lower[1] < 24.9
    assert peaks.lower[0] == -np.inf and peaks.upper[-1] == np.inf


@pytest.mark.paper("J 5.3.2, alpha")
def test_exactly_alpha_points_are_enough():
    assert len(height_peaks(level(12.0, 350), alpha=350)) == 1
    assert len(height_peaks(level(12.0, 349), alpha=350)) == 0


@pytest.mark.paper("J 5.3.2, beta")
def test_maxima_join_where_the_minimum_between_is_more_than_beta():
    # Roof, hits on the inner side of the parapet, parapet: 400, 60 and 400 points.
    z = np.concatenate([level(20.0, 400, 0.05), level(20.5, 60, 0.01), level(21.0, 400, 0.05)])
    joined = height_peaks(z, alpha=350, beta=59)
    apart = height_peaks(z, alpha=350, beta=60)
    assert len(joined) == 1 and len(apart) == 2
    np.testing.assert_allclose(apart.height, [20.0, 21.0], atol=0.15)
    assert set(joined.assign(z)) == {0}
    assert joined.count[0] >= 400


def test_default_beta_is_a_share_of_the_smaller_maximum():
    def building(between):
        return np.concatenate([level(20.0, 1000, 0.05), level(20.5, between, 0.01), level(21.0, 400, 0.05)])

    assert len(height_peaks(building(110), alpha=350)) == 2
    assert len(height_peaks(building(130), alpha=350)) == 1


def test_an_even_slope_is_one_roof_of_the_paper():
    rng = np.random.default_rng(4)
    assert len(height_peaks(rng.uniform(5, 10, 3000), alpha=100)) == 1


def test_a_plateau_is_one_maximum_at_its_middle():
    peaks = height_peaks(np.full(10, 10.0), alpha=1)
    np.testing.assert_allclose(peaks.height, [10.05], atol=1e-9)


def test_points_go_to_the_roof_of_their_height():
    z = np.concatenate([level(10.0, 100, 0.1), level(14.0, 100, 0.1)])
    peaks = height_peaks(z, alpha=50)
    heights = np.array([-5.0, 10.0, 11.5, 12.5, 14.0, 90.0])
    np.testing.assert_array_equal(peaks.assign(heights), [0, 0, 0, 1, 1, 1])


def test_order_of_points_does_not_matter():
    rng = np.random.default_rng(1)
    z = np.r_[rng.normal(10, 0.1, 500), rng.normal(15, 0.5, 500)]
    first, second = height_peaks(z, alpha=50), height_peaks(rng.permutation(z), alpha=50)
    for name in ("height", "count", "lower", "upper"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))


def test_no_points_no_roofs():
    peaks = height_peaks(np.empty(0), alpha=1)
    assert len(peaks) == 0
    np.testing.assert_array_equal(peaks.assign(np.array([1.0, 2.0])), [-1, -1])


@pytest.mark.parametrize(
    "z, width, shift",
    [([1.0, np.nan], 0.5, 0.1), ([1.0], 0.0, 0.1), ([1.0], 0.5, -1.0), ([0.0, 1e9], 0.5, 0.1)],
)
def test_bad_input_is_refused(z, width, shift):
    with pytest.raises(InputError):
        height_histogram(np.array(z), width, shift)
