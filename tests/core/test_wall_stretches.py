"""Stretches whose walls want the markings elsewhere: a known shift of a known stretch comes back, chance does not."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.mobile.registration.walls.stretches import WallReadings, shifted_stretches

EAVES = (0.1, 0.3)  # m, mean and standard deviation of how far facades stand inside the outlines


def readings(seed, change=(0.0, 0.0), begin=0.0, end=0.0, length=600.0, every=4.0):
    """Walls of both sides and of crossing streets, 0.1 m inside their outlines; in a stretch the markings are off."""
    rng = np.random.default_rng(seed)
    chainage = np.arange(0.0, length, every)
    outward = np.array([[0.0, 1.0], [0.0, -1.0], [1.0, 0.0], [-1.0, 0.0]])[np.arange(len(chainage)) % 4]
    off = np.where(((chainage >= begin) & (chainage < end))[:, None], change, 0.0)
    outside = (outward * off).sum(axis=1) - 0.1 + rng.normal(0.0, 0.03, len(chainage))
    return WallReadings(chainage, outward, outside, np.full(len(chainage), 0.05), 0.04)


@pytest.mark.parametrize("seed", range(3))
def test_a_shifted_stretch_comes_back(seed):
    item, = shifted_stretches(readings(seed, (0.3, -0.2), 200.0, 400.0), EAVES)
    assert item.change == pytest.approx([0.3, -0.2], abs=0.04)
    # It reaches on until walls have denied it: some walls' length beyond its true ends.
    assert 140.0 < item.begin < 210.0 and 390.0 < item.end < 460.0
    assert item.square > 16.0 and np.sqrt(np.diag(item.covariance)).max() < 0.06


@pytest.mark.parametrize("seed", range(3))
def test_without_a_shift_there_is_no_stretch(seed):
    assert shifted_stretches(readings(seed), EAVES) == []


def test_short_stretches_and_few_walls_say_nothing():
    """Of 40 m no stretch is made, nor of four walls in 200 m."""
    assert shifted_stretches(readings(1, (0.3, -0.2), 0.0, 40.0, length=40.0), EAVES) == []
    assert shifted_stretches(readings(1, (0.3, -0.2), 0.0, 200.0, length=200.0, every=50.0), EAVES) == []
    assert len(shifted_stretches(readings(1, (0.3, -0.2), 0.0, 200.0, length=200.0), EAVES)) == 1
