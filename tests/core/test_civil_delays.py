"""L5 beside L1: with the group delays of CNAV messages, and without them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.core.test_measured_ionosphere import drive, relative
from tests.core.test_rinex_navigation import header, kepler, klobuchar, message, number, write
from tests.core.test_rinex_observations import epoch_3, field, header_3
from urbanmap_qgis.gnss.orbits.ephemeris import read_navigation, satellite_states
from urbanmap_qgis.gnss.rinex.navigation import read_navigation_files
from urbanmap_qgis.gnss.rinex.observation_file import read_observations
from urbanmap_qgis.gnss.signals.measured_ionosphere import measure_ionosphere
from urbanmap_qgis.gnss.signals.observations import load_observations
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.samplecity.gnss import rinex_write, signals
from urbanmap_qgis.samplecity.gnss.stage import write_gnss
from urbanmap_qgis.samplecity.scene.world import make_scene
from urbanmap_qgis.settings.gnss import SignalSettings

LIGHT = 299792458.0
L1, L2, L5 = 1575.42e6, 1227.60e6, 1176.45e6
GAMMA = (L1 / L5) ** 2
TGD, L1CA, L2C, L5I, L5Q = 4.0e-9, 0.7e-9, -3.0e-9, -6.0e-9, -5.6e-9


def civil(name: str, kind: str = "CNAV", hour: int = 2, tgd: float | None = TGD,
          corrections: tuple[float | None, ...] = (L1CA, L2C, L5I, L5Q)) -> str:
    """A CNAV or CNV2 message of RINEX 4 by its published columns; None leaves a field blank. Its orbit is no orbit."""
    blank = " " * 19
    fields = ["".join(number(0.5) for _ in range(4)) for _ in range(5)]
    fields.append(number(0.0) * 2 + (blank if tgd is None else number(tgd)) + number(0.0))
    fields.append("".join(blank if value is None else number(value) for value in corrections))
    fields += [number(1e-9) * 2] * (kind == "CNV2") + [number(7200.0) + number(2033.0)]
    rows = "".join(f"    {row}\n" for row in fields)
    return message("EPH", name, kind) + f"{name} 2018 12 23 {hour:02d} 00 00" + number(1e-4) * 3 + "\n" + rows


def navigation_4(folder: Path, *more: str) -> Path:
    text = header(4.01, "N") + "".join(message("EPH", name, "LNAV") + kepler(name) for name in ("G07", "J02"))
    return write(folder, text + "".join(more), "four.rnx")


@pytest.mark.parametrize("kind", ["CNAV", "CNV2"])
def test_messages_are_read_by_their_columns(tmp_path, kind):
    records = read_navigation_files([navigation_4(tmp_path, civil("G07", kind), civil("J02", kind))])
    found = records.civil
    assert found.satellite.tolist() == ["G07", "J02"] and found.time.tolist() == records.kepler.toc.tolist()
    told = np.column_stack([found.tgd, found.isc_l1ca, found.isc_l2c, found.isc_l5i5, found.isc_l5q5])
    assert told == pytest.approx(np.array([[TGD, L1CA, L2C, L5I, L5Q]] * 2), rel=1e-12)
    assert found.isc_l5 == pytest.approx([(L5I + L5Q) / 2] * 2, rel=1e-12)


def test_delays_that_are_not_available(tmp_path):
    """Blank fields, and the most negative number, which the satellites send where they know none."""
    found = read_navigation_files([navigation_4(
        tmp_path, civil("G07", corrections=(L1CA, None, None, L5Q)),
        civil("J02", corrections=(-(2.0**-23), L2C, -(2.0**-23), -(2.0**-23))))]).civil
    assert found.isc_l5[0] == pytest.approx(L5Q) and np.isnan(found.isc_l2c[0]) and np.isnan(found.isc_l5i5[0])
    assert np.isnan(found.isc_l5[1]) and np.isnan(found.isc_l1ca[1])
    assert not len(read_navigation_files([navigation_4(tmp_path)]).civil.satellite)


@pytest.mark.parametrize("first, frequency, own", [("1", L1, L1CA), ("2", L2, L2C)])
def test_codes_without_the_ionosphere_as_the_interface_document_has_them(tmp_path, first, frequency, own):
    """IS-GPS-705, 20.3.3.3.1.2.2: PR = ((PR5 - g PR1) + c (ISC5 - g ISC1)) / (1 - g) - c TGD, whatever the delay."""
    navigation = read_navigation([navigation_4(tmp_path, civil("G07", corrections=(L1CA, L2C, L5Q, L5Q)))])
    time = navigation.kepler.toe[:1] + 60.0
    states = satellite_states(navigation, np.array(["G07"]), time, {"G": first}, {"G": "5"})
    g = (frequency / L5) ** 2
    for one, five in ((2.2e7, 2.2e7 + 9.5), (2.1e7, 2.1e7 - 3.0)):
        slant = (five - one - LIGHT * states.second_delay[0]) / (g - 1)
        ours = one - LIGHT * states.delay[0] - slant
        assert ours == pytest.approx(((five - g * one) + LIGHT * (L5Q - g * own)) / (1 - g) - LIGHT * TGD, abs=1e-6)


def test_l5_without_its_delays_is_not_taken_for_l2(tmp_path):
    navigation = read_navigation([navigation_4(tmp_path, civil("J02"))])
    time = navigation.kepler.toe + 60.0
    names = np.array(["G07", "J02"])
    five = satellite_states(navigation, names, time, {"G": "1", "J": "1"}, {"G": "5", "J": "5"})
    assert np.isnan(five.second_delay[0]) and np.isfinite(five.second_delay[1])
    two = satellite_states(navigation, names, time, {"G": "1", "J": "1"}, {"G": "2", "J": "2"})
    assert two.second_delay == pytest.approx(((L1 / L2) ** 2 - 1) * navigation.kepler.delay_a, rel=1e-9)
    assert five.delay[0] == two.delay[0] == navigation.kepler.delay_a[0]


@pytest.mark.parametrize("kinds, first, second", [
    (["C1C", "C2L", "C5Q"], "1", "2"), (["C1C", "C5Q"], "1", "5"), (["C2L", "C5X"], "2", "5")])
def test_l2_goes_before_l5_and_l5_is_never_alone(tmp_path, kinds, first, second):
    path = tmp_path / "some.obs"
    path.write_text(header_3({"G": kinds}) + epoch_3(0.0, ["G05" + "".join(
        field(2.1e7 + k) for k in range(len(kinds)))]))
    found = read_observations(path)
    assert found.bands == {"G": first} and found.second_bands == {"G": second}
    assert found.second_code[0] - found.code[0] == pytest.approx(1.0)


def test_a_satellites_unknown_delay_is_not_taken_for_ionosphere():
    """Delays between the bands of GPS as receivers meet them (5 ns), broadcast for the other systems only."""
    inside, left, wrong, modelled = [], [], [], []
    for seed in range(25):
        rng = np.random.default_rng(seed)
        drawn, true = drive(rng, deviation=0.4, count=15)
        gps = drawn.satellite.astype("U1") == "G"
        names, number = np.unique(drawn.satellite, return_inverse=True)
        delay = rng.normal(0.0, 5e-9 * LIGHT, len(names))[number.ravel()]
        drawn = replace(drawn, difference=drawn.difference + np.where(gps, delay, 0.0))
        found = measure_ionosphere(replace(drawn, known=~gps))
        assert (found.satellites, found.calibrated) == (15, 10)
        off = relative(found.delay - true, drawn.satellite)[gps]
        inside.append(np.abs(off) < 2 * found.sigma[gps])
        left.append(off)
        wrong.append(relative(measure_ionosphere(drawn).delay - true, drawn.satellite)[gps])
        modelled.append(relative(drawn.modelled - true, drawn.satellite)[gps])
    left, wrong, modelled = (float(np.std(np.concatenate(part))) for part in (left, wrong, modelled))
    assert left < 0.5 * wrong and left < 0.6 * modelled
    assert 0.9 < np.concatenate(inside).mean() <= 1.0


def with_civil_messages(path: Path) -> None:
    """Turn a navigation file of the sample city, whose L5 is late by GAMMA times the delay of L1, into RINEX 4 with
    CNAV messages that say so, T_GD counted from another signal."""
    head, body = path.read_text().split("END OF HEADER" + " " * 7 + "\n")
    lines, out = body.splitlines(), []
    starts = [k for k, line in enumerate(lines) if line[:1].isalpha()] + [len(lines)]
    for k, end in zip(starts, starts[1:]):
        name = lines[k][:3]
        kind = {"G": "LNAV", "J": "LNAV", "E": "INAV", "C": "D1"}[name[0]]
        out.append(message("EPH", name, kind) + "\n".join(lines[k:end]) + "\n")
        if name[0] in "GJ":
            delay, own = float(lines[k + 6][42:61].replace("D", "E")), 1e-9 * (int(name[1:]) % 4)
            five = delay + own - GAMMA * delay
            text = civil(name, tgd=delay + own, corrections=(own, None, five - 1e-10, five + 1e-10))
            out.append(text.replace(text.splitlines()[1][:23], lines[k][:23]))
    path.write_text(head.replace("     3.04", "     4.01") + "END OF HEADER" + " " * 7 + "\n" + "".join(out))


@pytest.fixture(scope="module")
def five(tmp_path_factory):
    """A city's observations on L1 and L5 on a day of the solar maximum."""
    folder = tmp_path_factory.mktemp("five")
    with pytest.MonkeyPatch.context() as patch:
        for name in "GJ":
            patch.setitem(signals.SECOND_FREQUENCY, name, L5)
            patch.setitem(rinex_write.SECOND_CODES, name, "C5Q")
        write_gnss(make_scene(80.0, "canyon", 3), folder, np.random.SeedSequence(5),
                   day=signals.Sky(True, 2.5, 0.3, 0.6))
    return folder


def test_l5_serves_the_sample_city(five, tmp_path):
    gnss = five / "gnss"
    trajectory = read_trajectory(gnss / "pass_03_trajectory.csv").trajectory
    civil_file = tmp_path / "four.nav"
    civil_file.write_bytes((gnss / "satellites.nav").read_bytes())
    with_civil_messages(civil_file)
    truth = np.genfromtxt(five / "truth" / "gnss_signals.csv.gz", delimiter=",", names=True, dtype=None,
                          encoding="ascii")
    rows = {(round(float(row["time"])), row["satellite"]): row for row in truth if row["pass"] == 3 and row["tracked"]}
    left, inside = {}, {}
    for name, path, bands in (("one", gnss / "satellites.nav", False), ("LNAV", gnss / "satellites.nav", True),
                              ("CNAV", civil_file, True)):
        found = load_observations([gnss / "pass_03.obs"], [path], trajectory, "EPSG:6677", 36.6,
                                  SignalSettings(systems="GJ", two_bands=bands))
        known = np.array([sum(rows[round(float(time)), satellite][column] for column in
                              ("clock", "excess_path", "multipath", "late", "noise"))
                          for time, satellite in zip(found.time, found.satellite)])
        off = relative(found.residual + found.clock_datum[0] - known, found.satellite)
        left[name], inside[name] = np.sqrt(np.mean(off**2)), np.mean(np.abs(off) < 2 * found.sigma)
        assert any("L5" in note for note in found.notes) == (name == "LNAV")
        assert found.ionosphere_measured == (name == "CNAV")
    assert left["CNAV"] < 0.5 * left["one"] and left["LNAV"] < left["one"]
    assert min(inside["CNAV"], inside["LNAV"]) > 0.95


def test_klobuchar_goes_with_the_messages(tmp_path):
    alpha, beta = (1.1e-8, 7.4e-9, -5.9e-8, -1.1e-7), (90112.0, 16384.0, -196608.0, -65536.0)
    path = navigation_4(tmp_path, message("ION", "G01", "LNAV") + klobuchar(alpha, beta), civil("G07"))
    navigation = read_navigation([path])
    assert navigation.ionosphere[0].alpha == alpha and navigation.civil.satellite.tolist() == ["G07"]
