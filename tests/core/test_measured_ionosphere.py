"""The ionosphere by codes on two bands: known layers come back, standing receivers are not believed too much."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.core.test_rinex_observations import epoch_3, field, header_3
from urbanmap_qgis.gnss.orbits.ephemeris import read_navigation, satellite_states
from urbanmap_qgis.gnss.rinex.observation_file import MEGAHERTZ, read_observations
from urbanmap_qgis.gnss.signals.measured_ionosphere import TwoBands, layer_mapping, measure_ionosphere
from urbanmap_qgis.gnss.signals.observations import load_observations
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.samplecity.gnss.signals import Sky
from urbanmap_qgis.samplecity.gnss.stage import write_gnss
from urbanmap_qgis.samplecity.scene.world import make_scene
from urbanmap_qgis.settings.gnss import SignalSettings

BANDS, SECOND = {"G": "1", "E": "1", "C": "2"}, {"G": "2", "E": "5", "C": "7"}


def drive(rng, vertical=8.0, modelled=4.0, deviation=0.0, noise=0.3, seconds=600, speed=10.0, count=12):
    """Signals of satellites that stand still in the sky above a vehicle, and their true delays on the first band."""
    elevation, azimuth = rng.uniform(0.3, 1.5, count), rng.uniform(0, 2 * np.pi, count)
    names = np.array([f"{'GEC'[k % 3]}{k + 1:02d}" for k in range(count)])
    own = np.array([MEGAHERTZ[name[0]][BANDS[name[0]]] for name in names])
    ratio = (own / np.array([MEGAHERTZ[name[0]][SECOND[name[0]]] for name in names])) ** 2
    scale = (1575.42 / own) ** 2
    true = scale * (vertical * layer_mapping(elevation) + rng.normal(0, deviation, count))
    bias = np.array([{"G": 2.0, "E": -3.0, "C": 5.0}[name[0]] for name in names])
    time = np.repeat(np.arange(0.0, seconds, 5.0), count)
    n = len(time) // count
    difference = np.tile((ratio - 1) * true + bias, n) + rng.normal(0, noise, len(time))
    place = np.column_stack([speed * time, 0 * time, 0 * time])
    return TwoBands(time, place, np.tile(names, n), np.tile(elevation, n), np.tile(azimuth, n),
                    np.tile(scale * modelled * layer_mapping(elevation), n), True, difference, np.full(len(time), 0.3),
                    BANDS, SECOND), np.tile(true, n)


def relative(values, satellite):
    """Values less the mean of their system: the rest is the clock's."""
    system = satellite.astype("U1")
    return values - np.array([values[system == name].mean() for name in system])


def test_mapping_at_the_zenith_and_low():
    assert layer_mapping(np.array([np.pi / 2])) == pytest.approx(1.0)
    # At 10 degrees a layer 350 km up is met at asin(6371 / 6721 cos 10) = 69.0 degrees from its zenith.
    assert layer_mapping(np.radians([10.0])) == pytest.approx(1 / np.cos(np.radians(68.992)), rel=1e-3)


def test_a_layer_twice_the_models_is_found():
    signals, true = drive(np.random.default_rng(1))
    found = measure_ionosphere(signals)
    assert found.satellites == 12 and found.modelled == pytest.approx(4.0)
    assert abs(found.vertical - 8.0) < 3 * found.vertical_sigma < 4.5
    off = relative(found.delay - true, signals.satellite)
    by_model = relative(signals.modelled - true, signals.satellite)
    assert np.std(off) < 0.15 < 1.0 < np.std(by_model)


def test_satellites_that_deviate_are_found_with_sigma():
    rng = np.random.default_rng(2)
    scaled = []
    for _ in range(40):
        signals, true = drive(rng, deviation=1.0)
        found = measure_ionosphere(signals)
        off = relative(found.delay - true, signals.satellite)
        scaled.append(off[:12] / found.sigma[:12])
    inside = np.abs(np.concatenate(scaled)) < 2.0
    assert 0.9 < inside.mean() <= 1.0
    assert np.std(off) < 0.5


def test_a_standing_receiver_is_one_piece_of_evidence():
    moving, _ = drive(np.random.default_rng(3), deviation=1.0)
    standing = replace(moving, place=np.zeros_like(moving.place))
    assert np.median(measure_ionosphere(standing).sigma) > 1.5 * np.median(measure_ionosphere(moving).sigma)


def test_signals_on_one_band_get_the_layer():
    signals, true = drive(np.random.default_rng(4))
    alone = signals.satellite == "G01"
    found = measure_ionosphere(replace(signals, difference=np.where(alone, np.nan, signals.difference)))
    whole = measure_ionosphere(signals)
    assert found.satellites == 11 and found.sigma[alone].min() > whole.sigma[alone].max()
    assert abs(relative(found.delay - true, signals.satellite)[alone]).max() < 3 * found.sigma[alone].max()


def test_without_a_model():
    signals, true = drive(np.random.default_rng(5))
    found = measure_ionosphere(replace(signals, modelled=np.zeros(len(true)), has_model=False))
    assert abs(found.vertical - 8.0) < 3 * found.vertical_sigma


def test_too_few_satellites_measure_nothing():
    signals, _ = drive(np.random.default_rng(6))
    three = np.isin(signals.satellite, ["G01", "E02", "C03", "G04"])
    assert measure_ionosphere(replace(signals, difference=np.where(three, signals.difference, np.nan))) is None
    assert measure_ionosphere(replace(signals, difference=np.full(len(three), np.nan))) is None


def test_second_codes_are_read(tmp_path):
    path = tmp_path / "two.obs"
    rows = ["G05" + field(2.1e7) + field(45.0) + field(2.1e7 + 3.5), "G07" + field(2.2e7) + field(40.0)]
    path.write_text(header_3({"G": ["C1C", "S1C", "C2L"]}) + epoch_3(0.0, rows))
    found = read_observations(path)
    assert found.bands == {"G": "1"} and found.second_bands == {"G": "2"}
    assert found.second_code[0] == pytest.approx(2.1e7 + 3.5) and np.isnan(found.second_code[1])


@pytest.fixture(scope="module")
def maximum(tmp_path_factory):
    """A city's observations on a day of the solar maximum, with a receiver of two bands."""
    folder = tmp_path_factory.mktemp("maximum")
    write_gnss(make_scene(80.0, "canyon", 3), folder, np.random.SeedSequence(5), day=Sky(True, 2.5, 0.3, 0.6))
    return folder


def test_delays_between_bands_are_those_broadcast(maximum):
    """TGD (IS-GPS-200), BGD and TGD1, TGD2 as the navigation file has them, column by column."""
    navigation = read_navigation([maximum / "gnss" / "satellites.nav"])
    names = np.unique(navigation.kepler.satellite)
    time = np.full(len(names), np.median(navigation.kepler.toe))
    states = satellite_states(navigation, names, time, BANDS | {"J": "1"}, SECOND | {"J": "2"})
    expected = {"G": lambda a, b: ((77 / 60) ** 2 - 1) * a, "J": lambda a, b: ((77 / 60) ** 2 - 1) * a,
                "E": lambda a, b: ((154 / 115) ** 2 - 1) * a, "C": lambda a, b: b - a}
    for name, delay in zip(names, states.second_delay):
        rows = np.flatnonzero(navigation.kepler.satellite == name)
        if np.isnan(delay) or not len(rows):
            continue
        a, b = navigation.kepler.delay_a[rows[0]], navigation.kepler.delay_b[rows[0]]
        assert delay == pytest.approx(expected[name[0]](a, b), abs=1e-15)
    assert np.isfinite(states.second_delay).sum() > 20
    assert np.isnan(satellite_states(navigation, names, time).second_delay).all()


def test_two_bands_halve_what_the_model_leaves(maximum):
    gnss = maximum / "gnss"
    trajectory = read_trajectory(gnss / "pass_03_trajectory.csv").trajectory
    left = []
    for two_bands in (False, True):
        signals = load_observations([gnss / "pass_03.obs"], [gnss / "satellites.nav"], trajectory, "EPSG:6677", 36.6,
                                    SignalSettings(two_bands=two_bands))
        truth = np.genfromtxt(maximum / "truth" / "gnss_signals.csv.gz", delimiter=",", names=True, dtype=None,
                              encoding="ascii")
        rows = {(round(float(row["time"])), row["satellite"]): row for row in truth
                if row["pass"] == 3 and row["tracked"]}
        known = np.array([sum(rows[round(float(time)), name][column] for column in
                              ("clock", "excess_path", "multipath", "late", "noise"))
                          for time, name in zip(signals.time, signals.satellite)])
        off = relative(signals.residual + signals.clock_datum[0] - known, signals.satellite)
        left.append(np.sqrt(np.mean(off**2)))
        assert not two_bands or np.mean(np.abs(off) < 2 * signals.sigma) > 0.95
        assert signals.ionosphere_measured == two_bands == any("two bands in 1 of 1" in note for note in signals.notes)
    assert left[1] < 0.5 * left[0]
