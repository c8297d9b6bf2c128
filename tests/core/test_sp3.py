"""Precise orbits: files written here by the columns of SP3-c and SP3-d, places on a known orbit."""

from __future__ import annotations

import gzip
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.orbits.ephemeris import OK, read_navigation, satellite_states
from urbanmap_qgis.gnss.orbits.sp3 import interpolate_orbits, is_sp3, read_sp3

FIRST = datetime(2018, 12, 23)
START = 2033 * 604800.0
STEP = 900.0
NAMES = ("G05", "E11", "R07")


def place(name: str, since: np.ndarray) -> np.ndarray:
    """An orbit of our own in the turning frame: circle tilted by 55 degrees, radius 26 560 km, m."""
    phase = np.asarray(since) * 2 * np.pi / 43080.0 + NAMES.index(name)
    flat = np.stack([np.cos(phase), np.sin(phase) * np.cos(0.96), np.sin(phase) * np.sin(0.96)], axis=-1) * 26.56e6
    turn = -7.2921151467e-5 * np.asarray(since)
    return np.stack([np.cos(turn) * flat[..., 0] - np.sin(turn) * flat[..., 1],
                     np.sin(turn) * flat[..., 0] + np.cos(turn) * flat[..., 1], flat[..., 2]], axis=-1)


def clock(name: str, since: np.ndarray) -> np.ndarray:
    return 1e-5 * (1 + NAMES.index(name)) + 2e-11 * np.asarray(since)


def text_of(epochs: int = 40, version: str = "d", scale: str = "GPS", missing: tuple = (), no_clock: tuple = ()) -> str:
    lines = [f"#{version}P2018 12 23  0  0  0.00000000      {epochs:2d} ORBIT IGS14 HLM  OWN",
             f"+    {len(NAMES)}   {''.join(NAMES)}",
             f"%c M  cc {scale} ccc cccc cccc cccc cccc ccccc ccccc ccccc ccccc",
             "/* made for a test"]
    for i in range(epochs):
        time = FIRST + timedelta(seconds=STEP * i)
        lines.append(f"*  {time:%Y} {time.month:2d} {time.day:2d} {time.hour:2d} {time.minute:2d} {time.second:11.8f}")
        for name in NAMES:
            x, y, z = (0.0, 0.0, 0.0) if (name, i) in missing else place(name, STEP * i) / 1e3
            tick = 999999.999999 if (name, i) in no_clock else 1e6 * clock(name, STEP * i)
            lines.append(f"P{name}{x:14.6f}{y:14.6f}{z:14.6f}{tick:14.6f}")
    return "\n".join([*lines, "EOF"]) + "\n"


def write(folder: Path, text: str) -> Path:
    path = folder / "own.sp3"
    path.write_bytes(text.encode())
    return path


@pytest.mark.parametrize("version", ["c", "d"])
def test_places_between_the_epochs(tmp_path, version):
    orbits = read_sp3(write(tmp_path, text_of(version=version)))
    assert orbits.satellite.tolist() == sorted(NAMES) and orbits.time[0] == START and len(orbits.time) == 40
    since = np.random.default_rng(1).uniform(6 * STEP, 33 * STEP, 200)
    for name in NAMES:
        row = np.full(len(since), orbits.satellite.tolist().index(name))
        found, ticks = interpolate_orbits(orbits, row, START + since)
        assert np.linalg.norm(found - place(name, since), axis=1).max() < 0.01
        assert np.abs(ticks - clock(name, since)).max() < 1e-12
        # At the ends of the file the polynomial swings more.
        ends, _ = interpolate_orbits(orbits, row[:2], START + np.array([0.3 * STEP, 38.7 * STEP]))
        assert np.linalg.norm(ends - place(name, np.array([0.3 * STEP, 38.7 * STEP])), axis=1).max() < 0.5


def test_nothing_outside_the_file_and_over_gaps(tmp_path):
    orbits = read_sp3(write(tmp_path, text_of(missing=(("G05", 20),), no_clock=(("E11", 20),))))
    rows = {name: orbits.satellite.tolist().index(name) for name in NAMES}
    times = START + np.array([-1.0, 39.01 * STEP, 20.5 * STEP, 30.5 * STEP])
    found, ticks = interpolate_orbits(orbits, np.full(4, rows["G05"]), times)
    assert np.isnan(found).any(axis=1).tolist() == [True, True, True, False]
    found, ticks = interpolate_orbits(orbits, np.full(4, rows["E11"]), times)
    assert np.isnan(ticks).tolist() == [True, True, True, False] and np.isfinite(found[2:]).all()


def test_a_missing_epoch_is_no_short_step(tmp_path):
    text = text_of()
    marks = [i for i, line in enumerate(text.splitlines()) if line.startswith("*")]
    lines = text.splitlines()
    del lines[marks[20]:marks[21]]
    orbits = read_sp3(write(tmp_path, "\n".join(lines) + "\n"))
    found, ticks = interpolate_orbits(orbits, np.array([0, 0]), START + np.array([20.5, 32.5]) * STEP)
    assert np.isnan(found[0]).all() and np.isfinite(found[1]).all() and np.isnan(ticks[0])


def test_time_scales_and_packing(tmp_path):
    path = tmp_path / "own.sp3.gz"
    path.write_bytes(gzip.compress(text_of(scale="UTC").encode()))
    assert is_sp3(path) and read_sp3(path).time[0] == START + 18.0
    assert read_sp3(write(tmp_path, text_of(scale="BDT"))).time[0] == START + 14.0


def test_states_hold_the_relativity_of_the_orbit(tmp_path):
    navigation = read_navigation([write(tmp_path, text_of())])
    since = np.array([10.3, 20.7]) * STEP
    states = satellite_states(navigation, np.array(["G05", "G05"]), START + since)
    assert states.status.tolist() == [OK, OK] and states.age.tolist() == [0.0, 0.0]
    speed = (place("G05", since + 0.01) - place("G05", since - 0.01)) / 0.02
    relativity = -2 * np.einsum("ij,ij->i", place("G05", since), speed) / 299792458.0 ** 2
    assert states.clock == pytest.approx(clock("G05", since) + relativity, abs=1e-11)
    assert navigation.span() == (START, START + 39 * STEP) and set(navigation.satellites()) == set(NAMES)


def test_a_cut_file_is_read_up_to_there(tmp_path):
    text = text_of()
    orbits = read_sp3(write(tmp_path, text[:len(text) // 2 + 25]))
    assert 15 < len(orbits.time) < 25
    found, _ = interpolate_orbits(orbits, np.array([0]), orbits.time[[8]] + 1.0)
    assert np.linalg.norm(found[0] - place(str(orbits.satellite[0]), orbits.time[8] + 1.0 - START)) < 0.01


@pytest.mark.parametrize("text, words", [
    ("#aP2018\n", "not an SP3 file of version c or d"), ("nothing\n", "not an SP3 file"),
    (text_of(2, scale="XYZ"), "counts time"), (text_of(2)[:200], "no satellite position")])
def test_files_that_cannot_be_used(tmp_path, text, words):
    with pytest.raises(InputError, match=words):
        read_sp3(write(tmp_path, text.replace("#aP", "#bP")))
