"""The range-intensity curve on made-up histograms with a known law."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.mobile.markings.intensity_calibration import LEVEL, RangeHistogram, calibrated, fit_curve


def drawn(law, seed=1, points=200_000, near=5.0, far=25.0, scatter=0.1, shares=((1.0, 0.0, 1.0),), steps=None):
    """Histogram of ground points whose asphalt follows `law`.

    `shares`: (brightness in asphalt's, share near, share far) of each surface; the shares change linearly with range.
    Most points lie near the vehicle.
    """
    rng = np.random.default_rng(seed)
    r = near + (far - near) * rng.beta(1.0, 3.0, points)
    place = (r - near) / (far - near)
    weights = np.array([a + (b - a) * place for _, a, b in shares])
    weights /= weights.sum(axis=0)
    which = (rng.random(points) > np.cumsum(weights, axis=0)[:-1]).sum(axis=0)
    factor = np.array([surface for surface, _, _ in shares])[which]
    intensity = law(r) * factor * np.exp(scatter * rng.standard_normal(points))
    if steps:
        intensity = np.round(intensity / steps) * steps
    histogram = RangeHistogram(40.0)
    histogram.add(r, intensity)
    return histogram


def power(r):
    return 60_000 * r ** -1.5


def floored(r):
    return 250 + 250_000 * r ** -2.2


def worst(curve, law, low=None, high=None):
    """Greatest departure of a curve from a law between its limits, as a share."""
    r = np.linspace(low or curve.nearest + 0.25, high or curve.r2 - 0.25, 50)
    return np.abs(curve.intensity(r) / law(r) - 1).max()


ASPHALT = ((1.0, 1.0, 1.0),)
STREET = ((1.0, 0.85, 0.3), (3.5, 0.1, 0.1), (2.0, 0.05, 0.6))


@pytest.mark.paper("J 3.2.3.2, eq. 4")
@pytest.mark.parametrize("law", [power, floored, lambda r: 900.0 + 0 * r])
@pytest.mark.parametrize("shares", [ASPHALT, STREET])
def test_known_law_is_found(law, shares):
    curve = fit_curve(drawn(law, shares=shares))
    assert worst(curve, law) < 0.05
    assert curve.residual < 0.04
    assert 0.08 < curve.scatter < 0.16
    assert curve.r2 > 20 and curve.nearest < 5.5


def test_pavements_that_outnumber_asphalt_do_not_lead_the_curve_astray():
    curve = fit_curve(drawn(floored, shares=((1.0, 0.8, 0.2), (2.1, 0.2, 0.8))))
    assert worst(curve, floored, high=18.0) < 0.06


def test_loss_close_to_the_scanner():
    def law(r):
        return 80_000 * r ** -1.6 * -np.expm1(-((r / 6.0) ** 2))
    curve = fit_curve(drawn(law, near=2.5))
    assert curve.near > 0 and worst(curve, law) < 0.06


def test_eight_bits():
    curve = fit_curve(drawn(lambda r: 200 * r ** -1.0, steps=1.0, scatter=0.2, shares=STREET))
    assert worst(curve, lambda r: 200 * r ** -1.0, high=15.0) < 0.1


def test_the_floor_gives_r1():
    # 10 % above the floor of 500: where 500 000 r^-3.3 = 50.
    curve = fit_curve(drawn(lambda r: 500 + 500_000 * r ** -3.3, far=38.0, points=400_000, scatter=0.03))
    expected = (500_000 / 50) ** (1 / 3.3)
    assert curve.r1 == pytest.approx(expected, abs=3.0)
    assert curve.r2 > curve.r1
    beyond = np.linspace(curve.r1, curve.r2, 5)
    assert np.allclose(curve.intensity(beyond), curve.smallest)


def test_r2_is_where_paint_is_lost_in_the_scatter():
    rng = np.random.default_rng(1)
    r = rng.uniform(5, 38, 400_000)
    # A receiver's floor with a noise of its own: far off, asphalt's signal is smaller than that.
    intensity = 400 + 2e6 * r ** -3.5 + 120 * rng.standard_normal(len(r))
    histogram = RangeHistogram(40.0)
    histogram.add(r, intensity)
    curve = fit_curve(histogram)
    # Paint of 2.5 asphalts exceeds two standard deviations while 1.5 * 2e6 r^-3.5 > 240.
    assert curve.r2 == pytest.approx((1.5 * 2e6 / 240) ** (1 / 3.5), abs=2.5)


@pytest.mark.paper("J 3.2.3.2, eq. 4")
def test_equation_4():
    curve = fit_curve(drawn(floored, shares=STREET))
    r = np.array([6.0, 10.0, 15.0, curve.r2 - 0.1, curve.r2 + 0.1])
    out = calibrated(floored(r) * 3.0, r, curve, 1000.0)
    assert np.allclose(out[:3], 3000, rtol=0.06) and np.isfinite(out[3]) and np.isnan(out[4])


def test_no_signal_is_no_surface():
    histogram = drawn(power)
    histogram.add(np.random.default_rng(2).uniform(5, 25, 400_000), np.zeros(400_000))
    assert worst(fit_curve(histogram), power) < 0.05


def test_refusals():
    empty = RangeHistogram(40.0)
    with pytest.raises(InsufficientDataError, match="too few"):
        fit_curve(empty)
    one = RangeHistogram(40.0)
    one.add(np.full(5000, 7.1), np.full(5000, 300.0))
    with pytest.raises(InsufficientDataError, match="too few"):
        fit_curve(one)
    noise = RangeHistogram(40.0)
    rng = np.random.default_rng(4)
    noise.add(rng.uniform(5, 25, 20_000), np.exp(rng.uniform(0, 10, 20_000)))
    with pytest.raises(InsufficientDataError):
        fit_curve(noise)


def test_levels_stand_for_the_intensities_counted_in_them():
    """The logarithm of an intensity lies within half a level of the value that its level stands for."""
    for intensity in np.geomspace(1.0, 60_000.0, 60):
        histogram = RangeHistogram(40.0)
        histogram.add(np.array([5.0]), np.array([intensity]))
        level = int(histogram.counts.sum(axis=0).argmax())
        assert histogram.counts.sum() == 1
        assert histogram.level_values()[level] == pytest.approx(np.log(intensity), abs=0.5001 * LEVEL)
