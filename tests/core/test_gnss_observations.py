"""From files to code residuals, against the truth of the sample city; and what is refused."""

from __future__ import annotations

import csv
import gzip
import json
import shutil
from dataclasses import replace
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError
from urbanmap_qgis.gnss.orbits.ephemeris import Navigation, read_navigation, satellite_states
from urbanmap_qgis.gnss.rinex.gnss_time import (
    WEEK,
    calendar_seconds,
    calendar_text,
    leap_seconds,
    nearest_week,
    span_text,
    to_gps,
)
from urbanmap_qgis.gnss.signals.antenna_height import estimate_height
from urbanmap_qgis.gnss.signals.observations import load_observations, trajectory_shift
from urbanmap_qgis.gnss.signals.tables import Signals
from urbanmap_qgis.gnss.walls.receiver_clock import pass_clocks
from urbanmap_qgis.gnss.walls.residuals import corrected_residuals
from urbanmap_qgis.mobile.trajectory import Trajectory, joined_trajectory
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.settings.gnss import SignalSettings

CRS = "EPSG:6677"
SEPARATION = 36.6
PASS = 3


@pytest.fixture(scope="module")
def gnss(small_city) -> Path:
    return small_city / "gnss"


def drive(folder: Path, number: int = PASS) -> Trajectory:
    table = np.loadtxt(folder / f"pass_{number:02d}_trajectory.csv", delimiter=",", skiprows=1)
    return Trajectory(table[:, 0], table[:, 1:4], np.unwrap(table[:, 4:7], axis=0, period=360.0))


def load(folder: Path, number: int = PASS, trajectory: Trajectory | None = None, separation: float | None = SEPARATION,
         **settings) -> Signals:
    return load_observations([folder / f"pass_{number:02d}.obs"], [folder / "satellites.nav"],
                             trajectory or drive(folder, number), CRS, separation, SignalSettings(**settings))


@pytest.fixture(scope="module")
def signals(gnss) -> Signals:
    return load(gnss)


@pytest.fixture(scope="module")
def truth(small_city) -> dict[tuple[float, str], dict]:
    with gzip.open(small_city / "truth" / "gnss_signals.csv.gz", "rt") as file:
        return {(float(row["time"]), row["satellite"]): row for row in csv.DictReader(file)
                if row["pass"] == str(PASS) and row["tracked"] == "1"}


def columns(signals: Signals, truth: dict, *names: str) -> list[np.ndarray]:
    rows = [truth[round(float(time), 3), str(name)] for time, name in zip(signals.time, signals.satellite)]
    return [np.array([float(row[name]) for row in rows]) for name in names]


def test_directions_and_strengths(signals, truth):
    elevation, azimuth, cn0, code = columns(signals, truth, "elevation", "azimuth", "cn0", "code")
    assert np.abs(signals.elevation - elevation).max() < 0.01
    turn = (signals.azimuth - azimuth + 180) % 360 - 180
    assert np.abs(turn * np.cos(np.radians(elevation))).max() < 0.01
    el, az = np.radians(signals.elevation), np.radians(signals.azimuth)
    assert signals.direction == pytest.approx(np.column_stack([np.cos(el) * np.sin(az), np.cos(el) * np.cos(az),
                                                               np.sin(el)]))
    assert np.abs(signals.cn0 - cn0).max() < 1e-3 and np.abs(signals.code - code).max() < 2e-3


def test_residuals_hold_clock_and_errors_only(signals, truth):
    """What the simulation added, clock, excess path and noise, is what is left; the air's mapping differs a little."""
    expected = sum(columns(signals, truth, "clock", "excess_path", "multipath", "late", "noise"))
    left = signals.residual + signals.clock_datum[0] - expected
    high = signals.elevation > 30
    # The trajectory's noise of some centimetres, the sky's 5 cm of mapping at 30 degrees.
    assert np.abs(left[high]).max() < 0.3 and np.abs(np.median(left)) < 0.1
    assert np.abs(left).max() < 0.8


def test_every_tracked_signal_is_there(signals, truth):
    assert {(round(float(time), 3), str(name)) for time, name in zip(signals.time, signals.satellite)} == set(truth)
    assert signals.left_out == {} and np.all(np.diff(signals.epoch) >= 0)
    assert np.array_equal(signals.system, signals.satellite.astype("U1"))
    assert np.array_equal(signals.place, signals.epochs.place[signals.epoch])


@pytest.mark.slow
def test_line_of_sight_centres_on_zero(small_city, gnss):
    """Over all passes: clock by truly visible satellites; reflected ones come late by their excess."""
    with gzip.open(small_city / "truth" / "gnss_signals.csv.gz", "rt") as file:
        rows = {(row["pass"], float(row["time"]), row["satellite"]): row for row in csv.DictReader(file)}
    whole = load_observations(sorted(gnss.glob("*.obs")), [gnss / "satellites.nav"],
                              joined_trajectory([drive(gnss, number) for number in range(1, 17)]), CRS, SEPARATION)
    number = whole.epochs.source[whole.epoch] + 1
    of = [rows[str(n), round(float(t), 3), str(s)] for n, t, s in zip(number, whole.time, whole.satellite)]
    free = np.array([row["class"] == "los" for row in of])
    corrected = corrected_residuals(whole, pass_clocks(whole, free))
    known = np.isfinite(corrected)
    low, middle, high = np.percentile(corrected[free & known], [25, 50, 75])
    assert known.mean() > 0.9 and abs(middle) < 0.1 and high - low < 1.2
    reflected = np.array([row["class"] == "reflected" for row in of]) & known
    late = np.array([float(row["excess_path"]) + float(row["late"]) for row in of])
    assert abs(np.median((corrected - late)[reflected])) < 0.3
    error = whole.residual - corrected + whole.clock_datum[number - 1] - np.array([float(row["clock"]) for row in of])
    assert np.sqrt(np.mean(error[known] ** 2)) < 0.4


def test_height_and_its_check(gnss):
    free = load(gnss, separation=None)
    assert abs(free.geoid_separation - SEPARATION) < 3 * free.geoid_sigma and free.geoid_sigma < 2.5
    assert any("geoid separation was not given" in note for note in free.notes)
    with pytest.raises(InputError, match=r"antenna is 3\d m higher .* separation of about 3\d m"):
        load(gnss, separation=0.0)
    wrong = load(gnss, separation=0.0, check_height=False)
    assert abs(estimate_height(wrong, wrong.cn0 > 40)[0] - SEPARATION) < 4.0


def shifted(trajectory: Trajectory, seconds: float) -> Trajectory:
    return replace(trajectory, time=trajectory.time + seconds)


@pytest.mark.parametrize("kind", ["week", "full", "standard", "unix", "next week"])
def test_times_of_the_trajectory_are_recognised(gnss, signals, kind):
    week = json.loads((gnss / "gnss.json").read_text())["gps_week"]
    start = week * 604800.0
    shift = {"week": 0.0, "full": start, "standard": start - 1e9, "unix": start + 315964800.0 - 18.0,
             "next week": 604800.0}[kind]
    found = load(gnss, trajectory=shifted(drive(gnss), shift))
    assert len(found) == len(signals) and np.abs(found.residual - signals.residual).max() < 1e-4
    assert found.time == pytest.approx(signals.time + shift)
    assert found.epochs.gps_time == pytest.approx(signals.time[0] + start + (
        found.epochs.gps_time - found.epochs.gps_time[0]))


def test_trajectory_of_another_time(gnss):
    with pytest.raises(InputError, match=r"trajectory covers \d+ to \d+ s of week, the observations cover .* GPS time"):
        load(gnss, trajectory=shifted(drive(gnss), -20000.0))
    full = Trajectory(np.array([1.0e9, 1.0e9 + 60]), np.zeros((2, 3)), np.zeros((2, 3)))
    with pytest.raises(InputError, match="covers 2011-09-14"):
        trajectory_shift(full, [(1.3e9, 1.3e9 + 60)])


def test_seconds_of_week_are_of_the_likeliest_span():
    """One record of a month before, as receivers write them into navigation files, is not the week of the drive."""
    week = 2050 * 604800.0
    drive = Trajectory(np.array([7000.0, 7600.0]), np.zeros((2, 3)), np.zeros((2, 3)))
    spans = [(week, week + 86400.0), (week - 30 * 86400.0, week - 30 * 86400.0 + 14400.0)]
    assert trajectory_shift(drive, spans, "navigation files") == week


@pytest.mark.parametrize("separation", [SEPARATION, None])
@pytest.mark.parametrize("seconds, words", [(-18.0, "18 s too early, as UTC is"), (18.0, "18 s too late")])
def test_leap_seconds_that_were_forgotten_are_noticed(gnss, separation, seconds, words):
    """Were the places of another time taken, every wall would be looked for elsewhere."""
    with pytest.raises(InputError, match=words):
        load(gnss, trajectory=shifted(drive(gnss), seconds), separation=separation)


def test_trajectory_of_another_place(gnss):
    here = drive(gnss)
    with pytest.raises(InputError, match="do not fit the trajectory .* of another drive"):
        load(gnss, trajectory=replace(here, place=here.place + np.array([3000.0, 1000.0, 0.0])))
    with pytest.raises(InputError, match="do not fit the trajectory"):
        load_observations([gnss / f"pass_{PASS:02d}.obs"], [gnss / "satellites.nav"], here, "EPSG:6678", SEPARATION)


def test_a_trajectory_that_fits_badly_is_told(gnss):
    """Places that wander by 20 m: nothing to refuse, something to say."""
    here = drive(gnss)
    wave = 20.0 * np.sin((here.time - here.time[0])[:, None] / [11.0, 7.0, 1e9])
    found = load(gnss, trajectory=replace(here, place=here.place + wave))
    assert any("contradict each other by" in note for note in found.notes)
    assert not any("contradict" in note for note in load(gnss).notes)


def test_epochs_outside_and_in_gaps_are_left_out(gnss, signals):
    whole = drive(gnss)
    first = signals.time[0]
    kept = (whole.time > first + 10) & ~((whole.time > first + 30) & (whole.time < first + 45))
    cut = Trajectory(whole.time[kept], whole.place[kept], whole.angles[kept])
    found = load(gnss, trajectory=cut)
    since = found.time - first
    assert since.min() > 10 and not np.any((since > 30) & (since < 45)) and np.any(since > 45)
    assert found.left_out["outside the trajectory or in a gap of it"] == len(signals) - len(found)
    assert len(load(gnss, trajectory=cut, max_gap=60.0)) > len(found)


def test_masks_and_systems(gnss, signals):
    found = load(gnss, elevation_mask=40.0, min_cn0=38.0, systems="GE")
    assert set(found.system) == {"G", "E"} and found.elevation.min() >= 40 and found.cn0.min() >= 38
    wanted = np.isin(signals.system, ["G", "E"]) & (signals.elevation >= 40) & (signals.cn0 >= 38)
    assert len(found) == wanted.sum()
    assert found.left_out["weaker than 38 dB-Hz"] == (np.isin(signals.system, ["G", "E"]) & (signals.cn0 < 38)).sum()


def test_antenna_beside_the_body(gnss, signals):
    """A lever arm forward and up moves the antenna with the heading."""
    found = load(gnss, lever_arm=(2.0, 0.0, -1.0))
    whole = drive(gnss)
    heading = np.radians(np.interp(found.epochs.time, whole.time, whole.angles[:, 2]))
    step = found.epochs.place - signals.epochs.place
    assert step[:, 2] == pytest.approx(np.ones(len(step)), abs=0.1)
    assert step[:, 0] == pytest.approx(2 * np.sin(heading), abs=0.1)
    assert step[:, 1] == pytest.approx(2 * np.cos(heading), abs=0.1)
    along = np.einsum("ij,ij->i", step[found.epoch], found.direction)
    change = found.residual + found.clock_datum[0] - signals.residual - signals.clock_datum[0]
    assert change == pytest.approx(along, abs=5e-3)


def test_packed_files_and_several_at_once(gnss, tmp_path, signals):
    for name in (f"pass_{PASS:02d}.obs", "satellites.nav"):
        with open(gnss / name, "rb") as source, gzip.open(tmp_path / f"{name}.gz", "wb") as target:
            shutil.copyfileobj(source, target)
    packed = load_observations([tmp_path / f"pass_{PASS:02d}.obs.gz"], [tmp_path / "satellites.nav.gz"], drive(gnss),
                               CRS, SEPARATION)
    assert np.array_equal(packed.residual, signals.residual)
    one, two = drive(gnss, 3), drive(gnss, 4)
    found = load_observations([gnss / "pass_03.obs", gnss / "pass_04.obs"], [gnss / "satellites.nav"],
                              joined_trajectory([one, two]), CRS, SEPARATION)
    assert set(found.epochs.source) == {0, 1} and len(found) == len(signals) + len(load(gnss, 4))
    assert np.abs(found.residual[:len(signals)] - signals.residual).max() < 1e-6


NO_CLOCK = 999999.999999  # as SP3 writes it


def write_sp3(path: Path, navigation: Navigation, first: float, epochs: int, step: float = 900.0) -> None:
    """Precise orbits that say what the broadcast ones say, without the relativity of the clock, as SP3 has it."""
    names = navigation.satellites()
    lines = ["#dP", "%c M  cc GPS ccc"]
    for k in range(epochs):
        time = np.full(len(names), first + k * step)
        states = satellite_states(navigation, names, time)
        speed = (satellite_states(navigation, names, time + 0.5).place
                 - satellite_states(navigation, names, time - 0.5).place)
        clock = states.clock + 2 * np.einsum("ij,ij->i", states.place, speed) / 299792458.0 ** 2
        moment = datetime(1980, 1, 6) + timedelta(seconds=float(time[0]))
        lines.append(f"*  {moment:%Y} {moment.month} {moment.day} {moment.hour} {moment.minute} {moment.second}.0")
        ticks = np.where(np.isfinite(clock), 1e6 * clock, NO_CLOCK)
        lines += [f"P{name}" + "".join(f"{value:14.6f}" for value in (*place / 1e3, tick))
                  for name, place, tick in zip(names, states.place, ticks) if np.isfinite(place).all()]
    path.write_text("\n".join([*lines, "EOF"]) + "\n")


def test_precise_orbits_in_place_of_broadcast_ones(gnss, tmp_path, signals):
    navigation = read_navigation([gnss / "satellites.nav"])
    middle = float(np.median(signals.epochs.gps_time))
    write_sp3(tmp_path / "own.sp3", navigation, 900.0 * round(middle / 900.0) - 6 * 900.0, 13)
    paths = [gnss / "satellites.nav", tmp_path / "own.sp3"]
    found = load_observations([gnss / f"pass_{PASS:02d}.obs"], paths, drive(gnss), CRS, SEPARATION)
    assert np.array_equal(found.satellite, signals.satellite) and (found.age == 0).mean() > 0.9
    change = found.residual + found.clock_datum[0] - signals.residual - signals.clock_datum[0]
    assert np.abs(change).max() < 0.05
    alone = load_observations([gnss / f"pass_{PASS:02d}.obs"], paths[1:], drive(gnss), CRS, SEPARATION)
    assert any("group delays" in note for note in alone.notes) and any("ionosphere" in note for note in alone.notes)


# What cannot be used

def test_satellites_without_ephemeris_and_unhealthy_ones_are_counted(gnss, tmp_path, signals):
    lines = (gnss / "satellites.nav").read_text().splitlines(keepends=True)
    end = next(i for i, line in enumerate(lines) if "END OF HEADER" in line) + 1
    names = sorted(set(signals.satellite))
    gone, sick = names[0], names[1]
    text = "".join(lines[:end])
    for i in range(end, len(lines), 8):
        record = lines[i:i + 8]
        if record[0].startswith(gone):
            continue
        if record[0].startswith(sick):
            record[6] = record[6][:23] + f"{1:19.12E}".replace("E", "D") + record[6][42:]
        text += "".join(record)
    (tmp_path / "some.nav").write_text(text)
    found = load_observations([gnss / f"pass_{PASS:02d}.obs"], [tmp_path / "some.nav"], drive(gnss), CRS, SEPARATION)
    assert found.left_out == {"without an ephemeris": int((signals.satellite == gone).sum()),
                              "of unhealthy satellites": int((signals.satellite == sick).sum())}
    assert set(found.satellite) == set(names) - {gone, sick}
    assert [note for note in found.notes if "no ephemeris" in note and gone in note]
    assert [note for note in found.notes if "unhealthy" in note and sick in note]


def test_a_system_without_navigation_is_told(gnss, tmp_path, signals):
    text = (gnss / "satellites.nav").read_text().splitlines(keepends=True)
    end = next(i for i, line in enumerate(text) if "END OF HEADER" in line) + 1
    records = ["".join(text[i:i + 8]) for i in range(end, len(text), 8)]
    (tmp_path / "gps.nav").write_text("".join(text[:end]) + "".join(one for one in records if one[0] == "G"))
    found = load_observations([gnss / f"pass_{PASS:02d}.obs"], [tmp_path / "gps.nav"], drive(gnss), CRS, SEPARATION)
    assert set(found.system) == {"G"} and found.left_out["without an ephemeris"] == (signals.system != "G").sum()
    assert [note for note in found.notes if "Galileo" in note] and [note for note in found.notes if "BeiDou" in note]


def test_without_ionosphere_it_says_so_and_trusts_less(gnss, tmp_path, signals):
    text = "".join(line for line in (gnss / "satellites.nav").read_text().splitlines(keepends=True)
                   if "IONOSPHERIC" not in line)
    (tmp_path / "bare.nav").write_text(text)
    found = load_observations([gnss / f"pass_{PASS:02d}.obs"], [tmp_path / "bare.nav"], drive(gnss), CRS, SEPARATION)
    assert not found.ionosphere.any() and any("ionosphere" in note for note in found.notes)
    assert np.all(found.sigma > signals.sigma)


def test_navigation_of_another_day(gnss, tmp_path):
    text = (gnss / "satellites.nav").read_text().replace("2024 04 18", "2024 04 25").replace("2024 04 17", "2024 04 24")
    (tmp_path / "late.nav").write_text(text)
    with pytest.raises(InputError, match=r"was observed 2024-04-18 .* good for 2024-04-2.*same day"):
        load_observations([gnss / "pass_03.obs"], [tmp_path / "late.nav"], drive(gnss), CRS, SEPARATION)


def test_a_cut_observation_file_is_used_up_to_there(gnss, tmp_path, signals):
    data = (gnss / f"pass_{PASS:02d}.obs").read_bytes()
    (tmp_path / "cut.obs").write_bytes(data[:len(data) * 2 // 3])
    found = load_observations([tmp_path / "cut.obs"], [gnss / "satellites.nav"], drive(gnss), CRS, SEPARATION)
    assert 0.4 < len(found) / len(signals) < 0.7
    assert any("cut.obs" in note for note in found.notes)
    whole = dict(zip(zip(signals.time, signals.satellite), signals.code))
    assert all(whole[key] == code for key, code in zip(zip(found.time, found.satellite), found.code))


def test_files_swapped_or_missing(gnss):
    observed, navigation = gnss / "pass_03.obs", gnss / "satellites.nav"
    with pytest.raises(InputError, match="holds no observations"):
        load_observations([navigation], [navigation], drive(gnss), CRS)
    with pytest.raises(InputError, match="holds observations: give a navigation file"):
        load_observations([observed], [observed], drive(gnss), CRS)
    with pytest.raises(InputError, match="No observation file"):
        load_observations([], [navigation], drive(gnss), CRS)
    with pytest.raises(InputError, match="No navigation file"):
        load_observations([observed], [], drive(gnss), CRS)
    with pytest.raises(InputError, match="no system of plane coordinates"):
        load_observations([observed], [navigation], drive(gnss), "EPSG:4326")


def test_nothing_left(gnss):
    with pytest.raises(InsufficientDataError, match=r"No observation can be used \(\d+ below 89 degrees"):
        load(gnss, elevation_mask=89.0)
    with pytest.raises(InsufficientDataError, match="no code observation of the chosen systems"):
        load(gnss, systems="R")


def test_cancel(gnss):
    with pytest.raises(Cancelled):
        load_observations([gnss / "pass_03.obs"], [gnss / "satellites.nav"], drive(gnss), CRS, SEPARATION,
                          progress=Progress(cancelled=lambda: True))


# Time scales against Python's calendar and published leap seconds


def by_calendar(*parts: int) -> float:
    return (datetime(*parts) - datetime(1980, 1, 6)).total_seconds()


def test_calendar_against_python():
    rng = np.random.default_rng(1)
    year, month, day = rng.integers(1980, 2079, 500), rng.integers(1, 13, 500), rng.integers(1, 29, 500)
    hour, minute, second = rng.integers(0, 24, 500), rng.integers(0, 60, 500), rng.integers(0, 60, 500)
    expected = [by_calendar(*(int(part) for part in parts)) for parts in zip(year, month, day, hour, minute, second)]
    assert np.array_equal(calendar_seconds(year, month, day, hour, minute, second + 0.25), np.array(expected) + 0.25)
    assert np.array_equal(calendar_seconds(year % 100, month, day, hour, minute, second), expected)


def test_seconds_and_minutes_run_over():
    assert calendar_seconds(2019, 12, 31, 23, 59, 60.0) == by_calendar(2020, 1, 1)


@pytest.mark.parametrize("day, leap", [((1980, 2, 1), 0), ((1999, 1, 1), 13), ((2005, 12, 31), 13), ((2006, 1, 1), 14),
                                       ((2016, 12, 31), 17), ((2017, 1, 1), 18), ((2024, 6, 1), 18)])
def test_leap_seconds(day, leap):
    utc = by_calendar(*day)
    assert leap_seconds(np.array([utc])) == leap
    assert to_gps(utc, "GLO") == utc + leap == to_gps(utc, "UTC")


def test_scales():
    assert to_gps(100.0, "BDT") == 114.0
    assert to_gps(100.0, "GAL") == to_gps(100.0, "QZS") == to_gps(100.0, "GPS") == 100.0
    with pytest.raises(KeyError):
        to_gps(100.0, "XYZ")


def test_nearest_week_over_its_end():
    near = np.array([2051 * WEEK + 10.0, 2051 * WEEK + WEEK - 10.0])
    assert np.array_equal(nearest_week(np.array([604799.0, 1.0]), near), [2051 * WEEK - 1.0, 2052 * WEEK + 1.0])


def test_texts():
    first = by_calendar(2019, 4, 28, 12, 44, 34)
    assert calendar_text(first + 0.9) == "2019-04-28 12:44:34"
    assert span_text(first, first + 60) == "2019-04-28 12:44:34 to 12:45:34"
    assert span_text(first, first + 86400) == "2019-04-28 12:44:34 to 2019-04-29 12:44:34"
