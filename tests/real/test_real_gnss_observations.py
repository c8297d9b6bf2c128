"""GNSS observations of Hong Kong and Berlin: files, residuals in line of sight, clocks."""

from __future__ import annotations

import sqlite3

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.orbits.ephemeris import read_navigation, sagnac_corrected
from urbanmap_qgis.gnss.rays.tracing import WallObstacles
from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.gnss.rinex.observation_file import read_observations
from urbanmap_qgis.gnss.signals.antenna_height import estimate_height, strong_signals
from urbanmap_qgis.gnss.signals.observations import expected_code_noise, expected_sigma, load_observations
from urbanmap_qgis.gnss.signals.tables import Epochs, Signals
from urbanmap_qgis.gnss.walls.receiver_clock import pass_clocks
from urbanmap_qgis.gnss.walls.residuals import corrected_residuals
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.settings.gnss import SignalSettings

CRS = "EPSG:32650"


def files(real_data, name: str) -> tuple[list, list, object]:
    folder = real_data / "gnss" / name
    return (sorted(folder.glob("*.obs")), sorted(folder.glob("hksc*")),
            read_trajectory(folder / "trajectory.csv").trajectory)


@pytest.fixture(scope="module")
def obstacles(real_data):
    """Walls by the rings drawn round the streets, tops above the ellipsoid."""
    base = sqlite3.connect(real_data / "gnss" / "buildings_tst" / "buildings.gpkg")
    table, column = base.execute("SELECT table_name, column_name FROM gpkg_geometry_columns").fetchone()
    rows = base.execute(f"SELECT {column}, roof_height_ellipsoidal FROM {table}").fetchall()
    base.close()
    envelope = (0, 32, 48, 48, 64)
    shapes = [shapely.from_wkb(blob[8 + envelope[blob[3] >> 1 & 7]:]) for blob, _ in rows]
    return WallObstacles.of(building_walls(shapes, top=np.array([top for _, top in rows], float)))


@pytest.mark.parametrize("name, epochs, systems", [("tst_2019", 1760, "GC"), ("tst_2020", 986, "GRECJ")])
def test_every_file_is_read(real_data, name, epochs, systems):
    observed, navigation, _ = files(real_data, name)
    found = read_observations(observed[0])
    text = observed[0].read_bytes()
    assert len(found.time) == epochs == text.count(b"\n>") and set(found.bands) == set(systems)
    assert not found.notes and np.all((found.code > 1.8e7) & (found.code < 4.3e7))
    assert np.isfinite(found.cn0).all()
    assert all(len(read_navigation([path]).satellites()) > 5 for path in navigation)


@pytest.mark.parametrize("name", ["tst_2019", "tst_2020"])
def test_rtklib_reads_the_same(real_data, name):
    """Every code on the first band, at its time, by another reader."""
    rtk = pytest.importorskip("pyrtklib", reason="pyrtklib, a cross-check for tests only, is not installed")
    path = files(real_data, name)[0][0]
    theirs, navigation, station = rtk.obs_t(), rtk.nav_t(), rtk.sta_t()
    assert rtk.readrnx(str(path), 1, "", theirs, navigation, station) == 1
    systems = {"G": rtk.SYS_GPS, "E": rtk.SYS_GAL, "J": rtk.SYS_QZS, "C": rtk.SYS_CMP, "R": rtk.SYS_GLO}
    ours = read_observations(path)
    number = {str(one): rtk.satno(systems[one[0]], int(one[1:]) + (192 if one[0] == "J" else 0))
              for one in np.unique(ours.satellite)}
    mine = {(round(float(ours.time[e]) * 1000), number[str(one)]): code
            for e, one, code in zip(ours.epoch, ours.satellite, ours.code)}
    found = {}
    for i in range(theirs.n):
        row = theirs.data[i]
        if row.P[0] > 0:
            found[round((row.time.time - 315964800 + row.time.sec) * 1000), row.sat] = row.P[0]
    assert len(found) > 20000 and mine.keys() == found.keys()
    assert max(abs(mine[key] - found[key]) for key in found) < 1e-3


def test_static_receiver_of_2020(real_data, obstacles):
    """Four systems: in line of sight the residuals centre on zero, quartiles 1.2 m apart with the ionosphere measured
    on two bands and 1.5 m with that of the model; hidden signals come late."""
    modelled = load_observations(*files(real_data, "tst_2020"), CRS, 0.0, SignalSettings(two_bands=False))
    signals = load_observations(*files(real_data, "tst_2020"), CRS, 0.0)
    assert any("QZSS" in note for note in signals.notes) and signals.left_out["without an ephemeris"] > 3000
    free = obstacles.free(signals.place, signals.direction)
    corrected = corrected_residuals(signals, pass_clocks(signals, free))
    low, middle, high = np.percentile(corrected[free & np.isfinite(corrected)], [25, 50, 75])
    by_model = corrected_residuals(modelled, pass_clocks(modelled, free))
    quartiles = np.percentile(by_model[free & np.isfinite(by_model)], [25, 75])
    assert abs(middle) < 0.2 and high - low < 1.3 < 1.4 < quartiles[1] - quartiles[0]
    hidden = ~free & np.isfinite(corrected)
    assert np.median(corrected[hidden]) > 20 and np.mean(corrected[hidden] > -5) > 0.95
    height, sigma = estimate_height(signals, free)
    assert abs(height) < 3 * sigma < 4.0


def test_car_of_2019(real_data, obstacles):
    """A single-frequency receiver in a car among towers: wider, and one-sided where signals are hidden."""
    signals = load_observations(*files(real_data, "tst_2019"), CRS, 0.0)
    free = obstacles.free(signals.place, signals.direction)
    clear = free & (signals.cn0 >= 35)
    corrected = corrected_residuals(signals, pass_clocks(signals, clear))
    low, middle, high = np.percentile(corrected[clear & np.isfinite(corrected)], [25, 50, 75])
    assert abs(middle) < 0.4 and high - low < 3.2
    hidden = ~free & np.isfinite(corrected)
    assert np.median(corrected[hidden]) > 15


@pytest.mark.parametrize("name", ["tst_2019", "tst_2020"])
def test_heights_of_another_kind_are_noticed(real_data, name):
    """The trajectories are above the ellipsoid; with a separation of some other country they do not fit."""


    with pytest.raises(InputError, match=r"antenna is \d\d m lower"):
        load_observations(*files(real_data, name), CRS, 40.0)
    free = load_observations(*files(real_data, name), CRS, None)
    assert abs(free.geoid_separation) < 3 * free.geoid_sigma + 3.0


def test_clock_on_corrected_ranges_of_berlin(real_data):
    """Ranges corrected by others, satellites and truth earth-fixed: the clock is found and residuals centre on zero."""
    folder = real_data / "gnss" / "smartloc_berlin"
    lines = [line.split() for line in next(folder.glob("*Input.txt")).read_text().splitlines()]
    rows = np.array([line[1:] for line in lines if line[0] == "pseudorange3"], float)
    truth = np.array([line.split()[1:5] for line in next(folder.glob("*GT.txt")).read_text().splitlines()], float)
    time, epoch = np.unique(rows[:, 0], return_inverse=True)
    epoch = epoch.ravel()
    antenna = np.column_stack([np.interp(time, truth[:, 0], truth[:, k]) for k in (1, 2, 3)])
    vector, distance = sagnac_corrected(rows[:, 3:6], antenna[epoch])
    up = antenna / np.linalg.norm(antenna, axis=1, keepdims=True)
    lift = np.einsum("ij,ij->i", vector / distance[:, None], up[epoch])
    assert np.degrees(np.arcsin(lift)) == pytest.approx(rows[:, 8], abs=1.5)
    letters = np.array([{1: "G", 4: "R"}[int(code)] for code in rows[:, 7]])
    names = np.array([f"{letter}{int(number) % 100:02d}" for letter, number in zip(letters, rows[:, 6])])
    zero = np.zeros(len(rows))
    elevation = np.radians(rows[:, 8])
    sigma = expected_sigma(expected_code_noise(rows[:, 9], letters), elevation, zero)
    residual = rows[:, 1] - distance
    signals = Signals(Epochs(time, time, antenna, np.zeros(len(time), int)), epoch, time[epoch], names, letters,
                      rows[:, 1], rows[:, 9], antenna[epoch], np.column_stack([zero, np.cos(elevation), lift]),
                      rows[:, 8], zero, residual - np.median(residual), sigma, zero, zero, zero, np.zeros(1), 0.0)
    # The truth is a point of the vehicle some metres from the antenna; which one is not told.
    height, _ = estimate_height(signals, strong_signals(signals))
    raised = signals.raised(height)
    seen = strong_signals(raised)
    corrected = corrected_residuals(raised, pass_clocks(raised, seen))
    low, middle, high = np.percentile(corrected[seen & np.isfinite(corrected)], [25, 50, 75])
    assert abs(height) < 8 and abs(middle) < 0.3 and high - low < 5.0
    weak = ~seen & np.isfinite(corrected)
    assert np.percentile(corrected[weak], 90) > 4 * -np.percentile(corrected[weak], 10)
