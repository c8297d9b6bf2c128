"""Exposure of overlapping frames evened out."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.aerial.orthophotos.gain_compensation import (
    GainCorrection,
    RadiometricSamples,
    compensate_gains,
    robust_line,
)

GAINS = np.array([[1.0, 1.1, 0.9], [1.25, 1.0, 1.0], [0.8, 0.95, 1.2]])
OFFSETS = np.array([[0.0, 4.0, -6.0], [-10.0, 0.0, 3.0], [12.0, -5.0, 0.0]])


def taken(noise=2.0, moved=0.1, points=4000, seed=3):
    """Samples of three frames in a row: 0 and 2 have no ground in common; a share of the values shows vehicles."""
    rng = np.random.default_rng(seed)
    truth = rng.uniform(50, 180, (points, 3))
    parts = []
    for frame, sees in enumerate((slice(0, 2000), slice(1000, 3500), slice(2500, 4000))):
        point = np.arange(points)[sees]
        values = truth[sees] * GAINS[frame] + OFFSETS[frame] + rng.normal(0, noise, (len(point), 3))
        vehicle = rng.random(len(point)) < moved
        values[vehicle] = rng.uniform(0, 255, (vehicle.sum(), 3))
        parts.append((np.full(len(point), frame), point, values))
    return RadiometricSamples(*(np.concatenate(part) for part in zip(*parts))), truth


def test_frames_agree_after_evening():
    samples, _ = taken()
    exposure = compensate_gains(samples, 3)
    level = np.array([60.0, 110.0, 170.0])[:, None]
    evened = [exposure.apply(frame, (level * GAINS[frame] + OFFSETS[frame]).astype(np.float32)) for frame in range(3)]
    assert np.abs(evened[0] - evened[1]).max() < 2.0
    assert np.abs(evened[0] - evened[2]).max() < 3.0
    np.testing.assert_allclose(np.log(exposure.gain).mean(axis=0), 0, atol=1e-3)


def test_the_order_of_samples_does_not_matter():
    samples, _ = taken()
    mixed = np.random.default_rng(1).permutation(len(samples.frame))
    again = compensate_gains(RadiometricSamples(samples.frame[mixed], samples.point[mixed], samples.values[mixed]), 3)
    np.testing.assert_array_equal(again.gain, compensate_gains(samples, 3).gain)


def test_equal_frames_stay_as_they_are():
    values = np.random.default_rng(1).uniform(20, 200, (1000, 1))
    samples = RadiometricSamples(np.repeat([0, 1], 1000), np.tile(np.arange(1000), 2), np.concatenate((values, values)))
    exposure = compensate_gains(samples, 2)
    np.testing.assert_allclose(exposure.gain, 1, atol=1e-9)
    np.testing.assert_allclose(exposure.offset, 0, atol=1e-6)


@pytest.mark.parametrize("points", [0, 50])
def test_frames_without_common_ground_stay_as_they_are(points):
    values = np.random.default_rng(1).uniform(20, 200, (2 * points, 3))
    samples = RadiometricSamples(np.repeat([0, 1], points), np.tile(np.arange(points), 2), values)
    exposure = compensate_gains(samples, 2)
    assert (exposure.gain == 1).all() and (exposure.offset == 0).all()
    assert (GainCorrection.identity(2, 3).apply(1, np.full((2, 3), 7, np.uint8)) == 7).all()


def test_line_with_noise_on_both_sides_and_outliers():
    rng = np.random.default_rng(5)
    truth = rng.uniform(40, 160, 5000)
    x, y = truth + rng.normal(0, 6, 5000), 1.3 * truth - 20 + rng.normal(0, 8, 5000)
    y[:1000] = rng.uniform(0, 255, 1000)
    gain, offset = robust_line(x, y)
    assert gain == pytest.approx(1.3, abs=0.03)
    assert gain * 100 + offset == pytest.approx(110, abs=1)


def test_line_of_a_flat_surface_compares_the_level_only():
    assert robust_line(np.full(300, 50.0), np.full(300, 60.0)) == (1.0, 10.0)
