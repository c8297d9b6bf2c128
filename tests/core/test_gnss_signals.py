"""What signals tell of the antenna, and the passes that they belong to."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from pyproj import CRS

from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.geometry.grouped_median import grouped_median
from urbanmap_qgis.gnss.signals.antenna_height import (
    estimate_height,
    strong_scatter,
    strong_signals,
    tukey,
)
from urbanmap_qgis.gnss.signals.passes import load_passes
from urbanmap_qgis.gnss.signals.tables import Epochs, Signals, join_signals
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

OFFSET = {"G": 0.0, "E": 1.5, "C": -7.0}


def made(seed: int = 1, epochs: int = 120, satellites: int = 12, noise: float = 0.6, files: int = 1,
         height: float = 0.0, late: float = 0.0) -> tuple[Signals, np.ndarray, np.ndarray]:
    """Signals, their true clocks (n,) and which are late (n,); `height` : the antenna was put too low by this."""
    rng = np.random.default_rng(seed)
    names = np.array([f"{'GEC'[i % 3]}{i + 1:02d}" for i in range(satellites)])
    azimuth = np.tile(np.linspace(0, 300, satellites), files * epochs)
    elevation = np.tile(np.linspace(15, 80, satellites), files * epochs)
    epoch = np.repeat(np.arange(files * epochs), satellites)
    source = np.repeat(np.arange(files), epochs)
    clock = 1000.0 * source[epoch] + 3.0 * epoch + rng.normal(0, 30, files * epochs)[epoch]
    satellite = np.tile(names, files * epochs)
    system = satellite.astype("U1")
    clock = clock + np.array([OFFSET[name] for name in system])
    delayed = rng.random(len(epoch)) < late
    el, az = np.radians(elevation), np.radians(azimuth)
    direction = np.column_stack([np.cos(el) * np.sin(az), np.cos(el) * np.cos(az), np.sin(el)])
    residual = clock + rng.normal(0, noise, len(epoch)) + delayed * rng.exponential(25.0, len(epoch))
    residual -= height * direction[:, 2]
    time = 40000.0 + np.arange(files * epochs, dtype=float)
    places = np.zeros((files * epochs, 3))
    cn0 = 44.0 - 7.0 * (1 - np.sin(el)) - 12.0 * delayed + rng.normal(0, 1, len(epoch))
    zero = np.zeros(len(epoch))
    signals = Signals(Epochs(time, time, places, source), epoch, time[epoch], satellite, system, 2e7 + zero, cn0,
                      places[epoch], direction, elevation, azimuth, residual, 1.0 + zero, zero, zero, zero,
                      np.zeros(files), 0.0)
    return signals, clock, delayed


def test_grouped_median():
    value = np.array([5.0, 1.0, 3.0, 10.0, 20.0])
    found = grouped_median(value, np.array([0, 0, 0, 2, 2]), 4)
    assert found == pytest.approx([3.0, np.nan, 15.0, np.nan], nan_ok=True)


def test_tukeys_weights():
    assert tukey(np.array([0.0, 4.7, 100.0, np.nan])).tolist() == [1.0, 0.0, 0.0, 0.0]
    assert tukey(np.array([2.35])) == pytest.approx(0.5625)


@pytest.mark.parametrize("noise", [0.5, 2.0, 40.0])
def test_how_far_the_strongest_signals_contradict_each_other(noise):
    """Late weak signals do not count, nor do clocks and the offsets of systems and files."""
    signals, _, _ = made(noise=noise, files=2, late=0.3)
    assert strong_scatter(signals) == pytest.approx(noise, rel=0.15)


def test_too_few_strong_signals_tell_no_scatter():
    assert np.isnan(strong_scatter(made(epochs=3)[0]))


def test_without_strengths_high_satellites_count():
    signals, _, _ = made(epochs=10)
    strong = strong_signals(replace(signals, cn0=np.full(len(signals), np.nan)))
    assert np.array_equal(strong, signals.elevation >= 50)


@pytest.mark.parametrize("height", [-30.0, -1.5, 0.0, 2.0, 37.0])
def test_height_of_the_antenna(height):
    signals, _, _ = made(height=height, noise=1.0, files=2)
    found, sigma = estimate_height(signals)
    assert found == pytest.approx(height, abs=0.4) and 0.7 <= sigma < 1.0


def test_height_is_found_among_late_signals():
    signals, _, delayed = made(height=36.0, noise=1.0, late=0.3)
    strong = strong_signals(signals)
    assert np.mean(delayed[strong]) < 0.02 and np.mean(strong[~delayed]) > 0.6
    found, sigma = estimate_height(signals, strong)
    assert abs(found - 36.0) < 3 * sigma


def test_raising_the_antenna_takes_the_height_out():
    signals, _, _ = made(height=12.0)
    raised = signals.raised(12.0)
    assert raised.geoid_separation == 12.0 and abs(estimate_height(raised)[0]) < 0.5
    assert raised.place is signals.place


def test_height_without_enough_to_tell_it():
    signals, _, _ = made(epochs=5)
    with pytest.raises(InsufficientDataError, match="Too few satellites"):
        estimate_height(signals)
    signals, _, _ = made()
    with pytest.raises(InsufficientDataError, match="elevations"):
        estimate_height(signals, (signals.elevation > 40) & (signals.elevation < 46))


def test_joining_drives():
    one, _, _ = made(seed=1, epochs=20)
    two, _, _ = made(seed=2, epochs=30, files=2)
    both = join_signals([one, two])
    assert len(both) == len(one) + len(two) and len(both.epochs) == 80
    assert np.array_equal(both.time, both.epochs.time[both.epoch])
    assert sorted(set(both.epochs.source.tolist())) == [0, 1, 2] and len(both.clock_datum) == 3
    assert np.array_equal(both.residual, np.concatenate([one.residual, two.residual]))
    assert join_signals([one]) is one


def test_joining_brings_estimated_heights_together():
    one, two = (replace(made(seed)[0], geoid_separation=value, geoid_sigma=sigma)
                for seed, value, sigma in ((1, 36.0, 0.5), (2, 38.0, 1.0)))
    both = join_signals([one, two])
    assert both.geoid_separation == pytest.approx(36.4)
    assert both.residual[:len(one)] == pytest.approx(one.residual + 0.4 * one.direction[:, 2])
    assert both.residual[len(one):] == pytest.approx(two.residual - 1.6 * two.direction[:, 2])


WKT = CRS.from_epsg(6677).to_wkt()
WEEK = 604800.0


@pytest.fixture(scope="module")
def drives(small_city):
    folder = small_city / "gnss"
    return ([folder / f"pass_{n:02d}.obs" for n in (1, 2)], [folder / "satellites.nav"],
            [read_trajectory(folder / f"pass_{n:02d}_trajectory.csv").trajectory for n in (1, 2)])


def load(drives, trajectories):
    return load_passes(*drives[:2], trajectories, ["one", "two"], WKT, 36.6)


def test_trajectories_in_any_order_and_in_different_times_give_the_same_signals(drives):
    whole = load(drives, drives[2])
    assert len(np.unique(whole.epochs.source)) == 2
    swapped = load(drives, drives[2][::-1])
    assert np.array_equal(whole.residual, swapped.residual)
    # One of them in full GPS seconds: the two have no time in common, and each file goes with its own.
    one, two = drives[2]
    full = Trajectory(two.time + 2310 * WEEK, two.place, two.angles)
    apart = load(drives, [one, full])
    assert np.allclose(apart.residual, whole.residual, atol=1e-3)
    assert np.array_equal(apart.epochs.source, whole.epochs.source)


def test_files_without_or_with_two_trajectories_are_refused(drives):
    one, two = drives[2]
    other = Trajectory(one.time - 5000.0, one.place, one.angles)
    with pytest.raises(InputError, match=r"pass_02\.obs is of the time of none"):
        load(drives, [one, other])
    with pytest.raises(InputError, match="may belong to one and two"):
        load(drives, [Trajectory(np.r_[one.time, two.time], np.r_[one.place, two.place], np.r_[one.angles, two.angles]),
                      two])
