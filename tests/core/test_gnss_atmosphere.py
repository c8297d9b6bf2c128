"""Delays in the atmosphere against published values and RTKLIB."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.gnss.rinex.navigation import Ionosphere
from urbanmap_qgis.gnss.signals.atmosphere import ionosphere, klobuchar, klobuchar_beidou, nearest_model, troposphere

ALPHA = (1.1176e-08, 2.2352e-08, -5.9605e-08, -1.1921e-07)
BETA = (9.6256e+04, 1.3107e+05, -6.5536e+04, -5.8982e+05)


def test_zenith_delay_of_the_troposphere():
    """2.3 m dry at the sea and 0.1 to 0.2 m wet; a third less at 4000 m."""
    zenith = troposphere(np.radians(45.0), np.array([0.0, 4000.0]), np.pi / 2, humidity=0.0)
    assert zenith[0] == pytest.approx(2.307, abs=0.005) and 0.55 < zenith[1] / zenith[0] < 0.68
    wet = troposphere(np.radians(45.0), 0.0, np.pi / 2, 0.7) - zenith[0]
    assert 0.08 < wet < 0.2


@pytest.mark.parametrize("degrees, factor", [(90.0, 1.0), (30.0, 1.994), (15.0, 3.80), (10.0, 5.60)])
def test_mapping_of_the_troposphere(degrees, factor):
    """Niell's mapping functions at mid latitude, hydrostatic, within 0.5 %."""
    slant = troposphere(0.6, 0.0, np.radians(degrees)) / troposphere(0.6, 0.0, np.pi / 2)
    assert slant == pytest.approx(factor, rel=5e-3)


def test_heights_out_of_the_air_are_held():
    high = troposphere(0.6, np.array([9000.0, 50000.0, -1000.0, -200.0]), np.pi / 2)
    assert high[0] == high[1] and high[2] == high[3] and np.isfinite(high).all()


def test_ionosphere_at_night_and_noon():
    lat, lon = np.radians(35.7), np.radians(139.8)
    night = klobuchar(ALPHA, BETA, lat, lon, 0.0, np.pi / 2, np.array(57600.0))
    assert night == pytest.approx(299792458.0 * 5e-9, rel=1e-2)
    noon = klobuchar(ALPHA, BETA, lat, lon, 0.0, np.pi / 2, np.array(14 * 3600.0 - lon / np.pi * 43200.0))
    assert 2.0 < noon < 15.0
    low = klobuchar(ALPHA, BETA, lat, lon, 0.0, np.radians(10.0), np.array(57600.0))
    # The obliquity of IS-GPS-200 at 10 degrees.
    assert low / night == pytest.approx((1 + 16 * (0.53 - 1 / 18) ** 3) / (1 + 16 * 0.03 ** 3), rel=1e-6)


def test_the_day_does_not_matter():
    one, two = (klobuchar(ALPHA, BETA, 0.6, 2.4, 1.0, 0.7, np.array(time)) for time in (12345.0, 12345.0 + 9 * 86400))
    assert one == pytest.approx(two, rel=1e-12)


def test_beidous_model_is_geometry_at_375_km():
    flat = (2e-8, 0.0, 0.0, 0.0)
    zenith = klobuchar_beidou(flat, BETA, 0.6, 2.4, 0.0, np.pi / 2, np.array(50400.0 - 43200.0 * 2.4 / np.pi))
    assert zenith == pytest.approx(299792458.0 * 2.5e-8, rel=1e-9)
    slant = klobuchar_beidou((0.0,) * 4, BETA, 0.6, 2.4, 1.0, np.radians(20.0), np.array(0.0))
    # Angle at the shell by the law of sines.
    angle = np.arcsin(np.cos(np.radians(20.0)) * 6378 / 6753)
    assert slant == pytest.approx(299792458.0 * 5e-9 / np.cos(angle), rel=1e-9)


def test_delay_falls_with_the_square_of_the_frequency():
    system = np.array(["G", "C", "E", "R", "C"])
    args = (np.full(5, 0.6), np.full(5, 2.4), np.full(5, 1.0), np.full(5, 0.7), np.full(5, 40000.0))
    bands = {"G": "1", "C": "2", "E": "7", "R": "1"}
    delay = ionosphere(Ionosphere("GPS", ALPHA, BETA, 0.0), system, bands, *args)
    frequency = np.array([1575.42, 1561.098, 1207.14, 1602.0, 1561.098])
    assert delay * frequency ** 2 == pytest.approx(np.full(5, delay[0] * 1575.42 ** 2), rel=1e-12)
    beidou = ionosphere(Ionosphere("BDS", ALPHA, BETA, 0.0), system, bands, *args)
    assert beidou[1] == pytest.approx(klobuchar_beidou(ALPHA, BETA, *(value[1] for value in args)), rel=1e-12)


def test_coefficients_of_the_day():
    models = [Ionosphere("BDS", ALPHA, BETA, 100.0), Ionosphere("GPS", ALPHA, BETA, 9e5),
              Ionosphere("GPS", ALPHA, BETA, 300.0)]
    assert nearest_model(models, 100.0) is models[2] and nearest_model(models[:1], 5.0) is models[0]
    assert nearest_model([], 5.0) is None


def test_against_rtklib():
    rtk = pytest.importorskip("pyrtklib", reason="pyrtklib, a cross-check for tests only, is not installed")
    position, sky, coefficients = rtk.Arr1Ddouble(3), rtk.Arr1Ddouble(2), rtk.Arr1Ddouble(8)
    for k, value in enumerate(ALPHA + BETA):
        coefficients[k] = value
    rng = np.random.default_rng(2)
    for _ in range(50):
        lat, lon, height = rng.uniform(-1.2, 1.2), rng.uniform(-3, 3), rng.uniform(0, 2000)
        azimuth, elevation, time = rng.uniform(0, 6.28), rng.uniform(0.2, 1.57), float(rng.uniform(0, 604800))
        position[0], position[1], position[2] = lat, lon, height
        sky[0], sky[1] = azimuth, elevation
        stamp = rtk.gpst2time(2033, time)
        theirs = rtk.ionmodel(stamp, coefficients, position, sky)
        assert klobuchar(ALPHA, BETA, lat, lon, azimuth, elevation, np.array(time)) == pytest.approx(theirs, abs=1e-4)
        sky[1] = np.pi / 2
        zenith = rtk.tropmodel(stamp, position, sky, 0.7)
        assert troposphere(lat, height, np.pi / 2, 0.7) == pytest.approx(zenith, abs=0.01)
