"""The receiver's clock and the antenna's height from made-up residuals with a known answer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.gnss.receiver_clock import estimate_clocks, estimate_height, grouped_median, strong_signals
from urbanmap_qgis.gnss.signals import ClockSettings, Epochs, Signals, join

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


@pytest.mark.parametrize("joined", [True, False])
def test_clocks_and_their_sigma(joined):
    """The clock errors scatter as their sigma says, and the sigma of the signals is set right by the unit weight."""
    signals, true, _ = made()
    found = estimate_clocks(signals, np.ones(len(signals), bool), ClockSettings(joined=joined))
    assert found.unit_weight == pytest.approx(0.6, rel=0.1)
    first = np.unique(signals.epoch, return_index=True)[1]
    error = (found.clock - true)[first] if joined else (found.clock - true)
    error = error - (np.median(error) if joined else 0.0)
    scaled = error / (found.sigma[first] if joined else found.sigma)
    assert 0.8 < np.std(scaled) < 1.25
    expected = 0.6 / np.sqrt(12) if joined else 0.6 / np.sqrt(4)
    assert np.median(found.sigma) == pytest.approx(expected, rel=0.15)
    assert np.all(found.count == (12 if joined else 4))
    assert found.corrected == pytest.approx(signals.residual - found.clock)


def test_offsets_of_systems_and_files():
    signals, true, _ = made(files=3)
    found = estimate_clocks(signals, np.ones(len(signals), bool))
    for file in range(3):
        for name in "GEC":
            own = (signals.system == name) & (signals.epochs.source[signals.epoch] == file)
            assert np.mean((found.clock - true)[own]) == pytest.approx(0.0, abs=0.05)


@pytest.mark.parametrize("joined", [True, False])
def test_late_signals_that_pass_for_line_of_sight_do_not_pull(joined):
    signals, true, _late = made(late=0.15)
    found = estimate_clocks(signals, np.ones(len(signals), bool), ClockSettings(joined=joined))
    error = found.clock - true
    assert abs(np.nanmedian(error)) < 0.15
    assert np.percentile(np.abs(error[np.isfinite(error)]), 90) < (0.8 if joined else 2.0)


def test_only_signals_in_line_of_sight_count():
    signals, true, delayed = made(late=0.5)
    found = estimate_clocks(signals, ~delayed)
    error = (found.clock - true)[np.isfinite(found.clock)]
    assert np.abs(error).max() < 1.5 and abs(np.mean(error)) < 0.05
    # The excess of the late ones comes out.
    excess = found.corrected[delayed & np.isfinite(found.corrected)]
    assert np.mean(excess) == pytest.approx(25.0, rel=0.1)


def test_a_system_without_line_of_sight_takes_the_others_clock():
    signals, true, _ = made()
    seen = ~((signals.system == "C") & (signals.epoch >= 60))
    joined = estimate_clocks(signals, seen)
    lost = ~seen
    assert np.abs((joined.clock - true)[lost]).max() < 1.0 and np.all(joined.count[lost] == 8)
    alone = estimate_clocks(signals, seen, ClockSettings(joined=False))
    assert np.isnan(alone.clock[lost]).all() and np.isnan(alone.corrected[lost]).all()


def test_systems_that_were_never_seen_together_are_not_linked():
    signals, true, _ = made()
    seen = np.where(signals.epoch < 60, signals.system != "C", signals.system == "C")
    found = estimate_clocks(signals, seen)
    known = np.isfinite(found.clock)
    assert np.array_equal(known, np.where(signals.epoch < 60, signals.system != "C", signals.system == "C"))
    assert np.abs((found.clock - true)[known]).max() < 1.5


@pytest.mark.parametrize("least, known", [(3, True), (4, False)])
def test_too_few_satellites_give_no_clock(least, known):
    signals, _, _ = made()
    seen = (signals.epoch >= 20) | np.isin(signals.satellite, ["G01", "E02", "C03"])
    found = estimate_clocks(signals, seen, ClockSettings(least_satellites=least))
    assert np.isfinite(found.clock[signals.epoch < 20]).all() == known
    assert np.isfinite(found.clock[signals.epoch >= 20]).all()


def test_without_any_line_of_sight_nothing_is_known():
    signals, _, _ = made(epochs=5)
    found = estimate_clocks(signals, np.zeros(len(signals), bool))
    assert np.isnan(found.clock).all() and np.isnan(found.sigma).all() and not found.count.any()


def test_grouped_median():
    value = np.array([5.0, 1.0, 3.0, 10.0, 20.0])
    found = grouped_median(value, np.array([0, 0, 0, 2, 2]), 4)
    assert found == pytest.approx([3.0, np.nan, 15.0, np.nan], nan_ok=True)


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
    both = join([one, two])
    assert len(both) == len(one) + len(two) and len(both.epochs) == 80
    assert np.array_equal(both.time, both.epochs.time[both.epoch])
    assert sorted(set(both.epochs.source.tolist())) == [0, 1, 2] and len(both.clock_datum) == 3
    assert np.array_equal(both.residual, np.concatenate([one.residual, two.residual]))
    assert join([one]) is one


def test_joining_brings_estimated_heights_together():
    one, two = (replace(made(seed)[0], geoid_separation=value, geoid_sigma=sigma)
                for seed, value, sigma in ((1, 36.0, 0.5), (2, 38.0, 1.0)))
    both = join([one, two])
    assert both.geoid_separation == pytest.approx(36.4)
    assert both.residual[:len(one)] == pytest.approx(one.residual + 0.4 * one.direction[:, 2])
    assert both.residual[len(one):] == pytest.approx(two.residual - 1.6 * two.direction[:, 2])


def test_taking_rows():
    signals, _, _ = made(epochs=10)
    some = signals.take(signals.system == "E")
    assert set(some.system) == {"E"} and some.epochs is signals.epochs and len(some.residual) == len(some)
