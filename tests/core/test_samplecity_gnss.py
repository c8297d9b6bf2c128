"""GNSS of the sample city, checked by formulas and parsers of its own."""

from __future__ import annotations

import csv
import gzip
import json
from collections import defaultdict
from datetime import datetime
from pathlib import Path

import numpy as np
import pyproj
import pytest
import shapely

from tests.core.rinex_by_hand import SYSTEM_GM, TURN, C, read_navigation, read_observations, state
from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity.gnss.atmosphere import klobuchar_delay, saastamoinen_delay
from urbanmap_qgis.samplecity.gnss.displaced_walls import deliver
from urbanmap_qgis.samplecity.gnss.earth_fixed import GEOID_SEPARATION, CityFrame
from urbanmap_qgis.samplecity.gnss.orbits import (
    Orbits,
    eccentric_anomaly,
    make_constellation,
    simulated_satellite_states,
)
from urbanmap_qgis.samplecity.gnss.passes import DAY_START, WEEK
from urbanmap_qgis.samplecity.gnss.rays import WAVE_LENGTH, edge_excess, edge_loss, path_through_crowns
from urbanmap_qgis.samplecity.gnss.rinex_write import calendar
from urbanmap_qgis.samplecity.gnss.stage import write_gnss
from urbanmap_qgis.samplecity.scene.model import GROUND, Crowns, FaceKind
from urbanmap_qgis.samplecity.scene.world import CRS, make_scene

SEED = 5


@pytest.fixture(scope="module")
def scene():
    return make_scene(80.0, "canyon", 3)


@pytest.fixture(scope="module")
def city(scene, tmp_path_factory):
    folder = tmp_path_factory.mktemp("gnss")
    summary = write_gnss(scene, folder, np.random.SeedSequence(SEED), SILENT)
    return folder, summary


@pytest.fixture(scope="module")
def signals(city):
    with gzip.open(city[0] / "truth" / "gnss_signals.csv.gz", "rt") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def walls(city):
    with open(city[0] / "truth" / "wall_offsets.csv") as file:
        return {int(row["wall"]): row for row in csv.DictReader(file)}


@pytest.fixture(scope="module")
def navigation(city):
    return read_navigation(city[0] / "gnss" / "satellites.nav")


def true_antenna(folder: Path, number: int, times: np.ndarray) -> np.ndarray:
    table = np.loadtxt(folder / "truth" / f"gnss_pass_{number:02d}_trajectory.csv", delimiter=",", skiprows=1)
    return np.column_stack([np.interp(times, table[:, 0], table[:, k]) for k in (1, 2, 3)])


def earth_fixed(xyz: np.ndarray) -> np.ndarray:
    """By PROJ's own geocentric conversion."""
    lon, lat = pyproj.Transformer.from_crs(CRS, "EPSG:6668", always_xy=True).transform(xyz[:, 0], xyz[:, 1])
    cart = pyproj.Transformer.from_pipeline("+proj=cart +ellps=GRS80")
    return np.column_stack(cart.transform(lon, lat, xyz[:, 2] + GEOID_SEPARATION))


def clock_of(row: dict) -> float:
    """Receiver clock (m) without the offset of the system."""
    return float(row["clock"]) - {"G": 0.0, "E": 1.4, "J": 0.4, "C": -7.5}[row["satellite"][0]]


def antenna_of(folder: Path, row: dict) -> np.ndarray:
    return true_antenna(folder, int(row["pass"]), np.array([float(row["time"]) - clock_of(row) / C]))[0]


def direction_of(row: dict) -> np.ndarray:
    el, az = np.radians(float(row["elevation"])), np.radians(float(row["azimuth"]))
    return np.array([np.cos(el) * np.sin(az), np.cos(el) * np.cos(az), np.sin(el)])


def sample(rows: list[dict], count: int) -> list[dict]:
    return [rows[i] for i in np.random.default_rng(1).choice(len(rows), min(count, len(rows)), replace=False)]


# Satellites

def test_two_body_motion_by_numerical_integration():
    base = make_constellation(DAY_START, np.random.default_rng(2))
    zero = {name: np.zeros(len(base)) for name in ("delta_n", "omega_dot", "i_dot", "cuc", "cus", "crc", "crs", "cic",
                                                   "cis")}
    kept = {name: getattr(base, name) for name in Orbits.__dataclass_fields__}
    orbits = Orbits(**(kept | zero))
    rate, gm = orbits.constant(TURN), orbits.constant(SYSTEM_GM)

    def inertial(time):
        place, _ = simulated_satellite_states(orbits, np.full(len(orbits), time))
        angle = rate * (time - orbits.toe)
        return np.column_stack([np.cos(angle) * place[:, 0] - np.sin(angle) * place[:, 1],
                                np.sin(angle) * place[:, 0] + np.cos(angle) * place[:, 1], place[:, 2]])

    def pull(x):
        return -gm[:, None] * x / np.linalg.norm(x, axis=1, keepdims=True) ** 3

    start, step = DAY_START + 500.0, 30.0
    place = inertial(start)
    speed = (8 * (inertial(start + 0.5) - inertial(start - 0.5)) - (inertial(start + 1) - inertial(start - 1))) / 6
    for _ in range(120):
        k1, l1 = speed, pull(place)
        k2, l2 = speed + step / 2 * l1, pull(place + step / 2 * k1)
        k3, l3 = speed + step / 2 * l2, pull(place + step / 2 * k2)
        k4, l4 = speed + step * l3, pull(place + step * k3)
        place = place + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        speed = speed + step / 6 * (l1 + 2 * l2 + 2 * l3 + l4)
    assert np.abs(place - inertial(start + 120 * step)).max() < 0.05


def test_eccentric_anomaly_solves_keplers_equation():
    mean, e = np.meshgrid(np.linspace(-7, 7, 101), [0.0, 0.01, 0.1, 0.3])
    eccentric = eccentric_anomaly(mean, e)
    assert np.abs(eccentric - e * np.sin(eccentric) - mean).max() < 1e-12


def test_constellation_is_plausible():
    orbits = make_constellation(DAY_START, np.random.default_rng(4))
    names = orbits.satellite.tolist()
    assert len(set(names)) == len(names) == 76
    assert [sum(name[0] == system for name in names) for system in "GEJC"] == [24, 24, 4, 24]
    period = 2 * np.pi * orbits.sqrt_a**3 / np.sqrt(orbits.constant(SYSTEM_GM)) / 3600
    expected = np.array([{"G": 11.97, "E": 14.08, "J": 23.934, "C": 12.89}[name[0]] for name in names])
    assert np.abs(period - expected).max() < 0.02
    places, _ = simulated_satellite_states(orbits, np.arange(0, 86400, 600.0)[:, None] + DAY_START)
    zenith = np.array([-0.6191, 0.5247, 0.5842])
    quasi = places[:, [names.index(name) for name in ("J02", "J03", "J04")]]
    towards = quasi - 6371e3 * zenith
    high = np.einsum("ijk,k->ij", towards, zenith) / np.linalg.norm(towards, axis=2)
    assert np.degrees(np.arcsin(high.max(axis=1))).min() > 55
    still = places[:, names.index("J07")]
    longitude = np.degrees(np.arctan2(still[:, 1], still[:, 0]))
    assert np.abs(longitude - 127).max() < 1.5 and np.abs(still[:, 2]).max() < 1e5


def test_records_of_other_times_describe_the_same_orbits():
    base = make_constellation(DAY_START, np.random.default_rng(4))
    one, two = base.moved_to(DAY_START + 7200), base.moved_to(DAY_START + 14400)
    time = np.full(len(base), DAY_START + 10000.0)
    (place_1, clock_1), (place_2, clock_2) = simulated_satellite_states(one, time), simulated_satellite_states(two,
                                                                                                               time)
    assert np.abs(place_1 - place_2).max() < 1e-3
    assert np.abs(clock_1 - clock_2).max() * C < 1e-3


def test_frame_agrees_with_proj():
    xyz = np.array([[-6950.0, -34100.0, 12.0], [-6800.0, -34250.0, 60.0], [-7100.0, -33900.0, 3.0]])
    frame = CityFrame.of(CRS, *xyz[0])
    assert np.abs(frame.earth_fixed(xyz) - earth_fixed(xyz)).max() < 1e-4
    assert np.abs(frame.grid @ frame.grid.T - np.eye(3)).max() < 1e-6
    true = np.degrees(frame.true_azimuth(frame.grid[1]))
    convergence = np.degrees(frame.longitude - np.radians(139 + 50 / 60)) * np.sin(frame.latitude)
    assert true == pytest.approx(convergence, abs=1e-4)


# Files

@pytest.mark.slow
def test_observation_files_hold_what_the_truth_tells(city, signals):
    folder, summary = city
    seen = defaultdict(dict)
    for row in signals:
        if row["tracked"] == "1":
            seen[int(row["pass"])][float(row["time"]), row["satellite"]] = (float(row["code"]), float(row["cn0"]))
    paths = sorted((folder / "gnss").glob("*.obs"))
    assert len(paths) == summary["passes"] >= 12
    for number, path in enumerate(paths, 1):
        found = read_observations(path)
        assert found.keys() == seen[number].keys()
        values, true = np.array([found[key] for key in found]), np.array([seen[number][key] for key in found])
        assert np.abs(values - true).max() < 0.0011


def test_navigation_covers_every_observed_satellite(signals, navigation):
    for row in signals[::50]:
        assert min(abs(record["toe"] - float(row["time"])) for record in navigation[row["satellite"]]) <= 3600 + 120
    assert {name[0] for name in navigation} == set("GEJC")


def test_facts_and_trajectories(city, scene):
    folder, _ = city
    facts = json.loads((folder / "gnss" / "gnss.json").read_text())
    assert facts["crs"] == CRS and facts["gps_week"] == WEEK and facts["geoid_separation_m"] == GEOID_SEPARATION
    assert calendar(WEEK, DAY_START) == datetime(2024, 4, 18)
    for entry in facts["passes"]:
        lines = (folder / "gnss" / entry["trajectory"]).read_text().splitlines()
        assert lines[0] == "time,x,y,z,roll,pitch,heading"
        table = np.loadtxt(lines[1:], delimiter=",")
        true = np.loadtxt(folder / "truth" / f"gnss_{entry['trajectory']}", delimiter=",", skiprows=1)
        error = table[:, 1:4] - true[:, 1:4]
        assert 0.005 < error.std() < 0.1 and np.abs(error).max() < 0.3
        height = true[:, 3] - scene.ground_height(true[:, 1], true[:, 2])
        assert np.abs(height - facts["antenna_above_road_m"]).max() < 1e-3
        times = [time for time, _ in read_observations(folder / "gnss" / entry["observations"])]
        assert table[0, 0] < min(times) and max(times) < table[-1, 0]


# Measurements

def test_code_range_is_geometry_clocks_and_stated_errors(city, signals, navigation):
    """By the nav file, the true trajectory and the truth's terms: what is left is the rounding."""
    folder, _ = city
    tracked = [row for row in signals if row["tracked"] == "1"]
    left = []
    for row in sample(tracked, 400):
        time, name = float(row["time"]), row["satellite"]
        record = min(navigation[name], key=lambda item: abs(item["toe"] - time))
        arrival = time - clock_of(row) / C
        antenna = earth_fixed(antenna_of(folder, row)[None])[0]
        sent = arrival - 0.08
        for _ in range(5):
            place, clock = state(name, record, sent)
            # The turn of the earth during the travel, as the usual first-order term.
            distance = np.linalg.norm(place - antenna) + TURN[name[0]] / C * (place[0] * antenna[1]
                                                                             - place[1] * antenna[0])
            sent = arrival - distance / C
        errors = sum(float(row[key]) for key in ("clock", "excess_path", "multipath", "late", "noise"))
        air = atmosphere(row, antenna, time)
        left.append(float(row["code"]) - (distance - C * clock + C * record["delay"] + errors + air))
    assert np.abs(left).max() < 0.02


def atmosphere(row: dict, antenna: np.ndarray, time: float) -> float:
    lat = np.arctan2(antenna[2], np.hypot(*antenna[:2]) * (1 - 0.00669438))
    lon = np.arctan2(antenna[1], antenna[0])
    el = np.radians(float(row["elevation"]))
    az = np.radians(float(row["azimuth"])) + (lon - np.radians(139 + 50 / 60)) * np.sin(lat)
    scale = (1575.42 / 1561.098) ** 2 if row["satellite"][0] == "C" else 1.0
    return saastamoinen_delay(lat, 12.0, el) + scale * klobuchar_delay(lat, lon, az, el, np.array(time))


def test_against_rtklib(city, signals, navigation):
    rtk = pytest.importorskip("pyrtklib", reason="pyrtklib, a cross-check for tests only, is not installed")
    nav, obs, station = rtk.nav_t(), rtk.obs_t(), rtk.sta_t()
    folder, _ = city
    assert rtk.readrnx(str(folder / "gnss" / "pass_03.obs"), 1, "", obs, nav, station) == 1
    assert rtk.readrnx(str(folder / "gnss" / "satellites.nav"), 1, "", obs, nav, station) == 1
    tracked = [row for row in signals if row["tracked"] == "1" and row["pass"] == "3"]
    assert obs.n == len(tracked)
    for row in sample(tracked, 60):
        name, time = row["satellite"], float(row["time"])
        prn = int(name[1:]) + (192 if name[0] == "J" else 0)
        number = rtk.satno({"G": rtk.SYS_GPS, "E": rtk.SYS_GAL, "J": rtk.SYS_QZS, "C": rtk.SYS_CMP}[name[0]], prn)
        records = [nav.eph[i] for i in range(nav.n) if nav.eph[i].sat == number]
        stamp = rtk.gpst2time(WEEK, time)
        eph = min(records, key=lambda item: abs(rtk.timediff(item.toe, stamp)))
        place, clock, variance = rtk.Arr1Ddouble(3), rtk.Arr1Ddouble(1), rtk.Arr1Ddouble(1)
        rtk.eph2pos(stamp, eph, place, clock, variance)
        own = min(navigation[name], key=lambda item: abs(item["toe"] - time))
        expected, offset = state(name, own, time)
        orbits = make_record(name, own)
        simulated, simulated_clock = simulated_satellite_states(orbits, np.array([time]))
        theirs = np.array([place[k] for k in range(3)])
        assert np.abs(theirs - simulated[0]).max() < 0.002 and np.abs(expected - simulated[0]).max() < 0.002
        assert abs(clock[0] - simulated_clock[0]) < 1e-11 and abs(offset - simulated_clock[0]) < 1e-11
        antenna = earth_fixed(antenna_of(folder, row)[None])
        check_air(rtk, nav, row, antenna[0], stamp, time)


def check_air(rtk, nav, row: dict, antenna: np.ndarray, stamp, time: float) -> None:
    position, sky, broadcast = rtk.Arr1Ddouble(3), rtk.Arr1Ddouble(2), rtk.Arr1Ddouble(8)
    ecef = rtk.Arr1Ddouble(3)
    for k in range(3):
        ecef[k] = antenna[k]
    rtk.ecef2pos(ecef, position)
    position[2] = position[2] - GEOID_SEPARATION
    for k in range(8):
        broadcast[k] = nav.ion_gps[k]
    convergence = (position[1] - np.radians(139 + 50 / 60)) * np.sin(position[0])
    sky[0], sky[1] = np.radians(float(row["azimuth"])) + convergence, np.radians(float(row["elevation"]))
    theirs = rtk.tropmodel(stamp, position, sky, 0.7)
    scale = (1575.42 / 1561.098) ** 2 if row["satellite"][0] == "C" else 1.0
    theirs += scale * rtk.ionmodel(stamp, broadcast, position, sky)
    assert atmosphere(row, antenna, time) == pytest.approx(theirs, abs=0.01)


def make_record(name: str, record: dict) -> Orbits:
    o = record["orbit"]
    names = ("crs", "delta_n", "m0", "cuc", "e", "cus", "sqrt_a", "cic", "omega0", "cis", "i0", "crc", "omega",
             "omega_dot", "i_dot")
    values = dict(zip(names, [*o[0][1:], *o[1], *o[2][1:], *o[3], o[4][0]]))
    values |= {"toe": record["toe"], "af0": record["clock"][0], "af1": record["clock"][1], "delay": record["delay"],
               "delay2": 0.0}
    return Orbits(satellite=np.array([name]), **{key: np.array([value]) for key, value in values.items()})


# Signals and walls

def test_reflections_obey_the_law_of_the_mirror(city, signals, walls):
    """Excess path 2 D cos(elevation) cos(azimuth difference), point of reflection on the wall."""
    folder, _ = city
    rows = [row for row in signals if row["class"] == "reflected"]
    assert len(rows) > 100
    for row in sample(rows, 300):
        wall = walls[int(row["wall"])]
        start, end, normal = (np.array([float(wall[key]) for key in keys]) for keys in (
            ("true_x0", "true_y0"), ("true_x1", "true_y1"), ("nx", "ny")))
        antenna, towards = antenna_of(folder, row), direction_of(row)
        distance = (antenna[:2] - start) @ normal
        azimuth = np.arctan2(normal[0], normal[1])
        excess = 2 * distance * np.cos(np.radians(float(row["elevation"]))) * np.cos(
            np.radians(float(row["azimuth"])) - azimuth)
        assert distance > 0 and float(row["excess_path"]) == pytest.approx(excess, abs=0.01)
        image = antenna - np.array([*(2 * distance * normal), 0.0])
        share = distance / (towards[:2] @ normal)
        point = image + share * towards
        along = (point[:2] - start) @ (end - start) / np.hypot(*(end - start))
        assert -0.02 < along < np.hypot(*(end - start)) + 0.02
        assert float(wall["z_low"]) - 0.02 < point[2] < float(wall["z_top"]) + 0.02


def test_visibility_against_every_face(city, scene, signals, walls):
    folder, _ = city
    faces = scene.static_faces(GROUND)
    opaque = np.isin(faces.kind, [FaceKind.WALL, FaceKind.ROOF, FaceKind.PARAPET_TOP, FaceKind.STRUCTURE,
                                  FaceKind.BRIDGE])
    triangles = np.concatenate([faces.corners[opaque][:, [0, 1, 2]], faces.corners[opaque][:, [0, 2, 3]]])
    for row in sample(signals, 400):
        antenna, towards = antenna_of(folder, row), direction_of(row)
        nearest = hit_distance(triangles, antenna, towards)
        if row["class"] != "los" and not np.isfinite(nearest):
            # On the edge itself the four decimals of the angles decide.
            azimuth, elevation = float(row["azimuth"]), float(row["elevation"])
            shift = [direction_of(row | {"azimuth": azimuth + a, "elevation": elevation + b})
                     for a in (-2e-3, 2e-3) for b in (-2e-3, 2e-3)]
            assert any(np.isfinite(hit_distance(triangles, antenna, one)) for one in shift)
        if row["class"] == "los" and np.isfinite(nearest):
            assert np.isinf(hit_distance(triangles, antenna, direction_of(
                row | {"elevation": float(row["elevation"]) + 2e-3})))
        if row["class"] == "reflected":
            wall = walls[int(row["wall"])]
            normal = np.array([float(wall["nx"]), float(wall["ny"]), 0.0])
            distance = (antenna[:2] - [float(wall["true_x0"]), float(wall["true_y0"])]) @ normal[:2]
            arriving = towards - 2 * (towards @ normal) * normal
            way = distance / (towards @ normal)
            assert hit_distance(triangles, antenna, arriving) == pytest.approx(way, abs=0.02)
            assert np.isinf(hit_distance(triangles, antenna + (way - 0.01) * arriving, towards))


def hit_distance(triangles: np.ndarray, start: np.ndarray, direction: np.ndarray) -> float:
    """Distance to the first triangle on the ray (Moeller and Trumbore), infinite if there is none."""
    a, ab, ac = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    p = np.cross(direction, ac)
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = 1 / np.einsum("ij,ij->i", ab, p)
        u = np.einsum("ij,ij->i", start - a, p) * scale
        q = np.cross(start - a, ab)
        v, t = q @ direction * scale, np.einsum("ij,ij->i", ac, q) * scale
        hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-6) & np.isfinite(scale)
    return float(t[hit].min(initial=np.inf))


def test_path_through_crowns():
    """Through the middle of a crown, beside it, from within it, and with the crown behind."""
    crowns = Crowns(np.array([[10.0, 0.0, 5.0]]), np.array([[2.0, 2.0, 3.0]]), np.array([1.6]))
    start = np.array([[0.0, 0, 5], [0.0, 2.1, 5], [10.0, 0, 5], [20.0, 0, 5], [0.0, 1.2, 5]])
    ahead = np.tile([1.0, 0, 0], (5, 1))
    assert path_through_crowns(crowns, start, ahead) == pytest.approx([4.0, 0.0, 2.0, 0.0, 3.2])


def test_edges_bend_signals():
    """6 dB on the edge; about 17 dB where v = 1.6 (ITU-R P.526, figure 9); the longer way by Pythagoras."""
    direction = np.array([[0.8, 0.0, 0.6]] * 3)
    away = np.full(3, 16.0)
    v_one_six = 1.6 / (0.8 * np.sqrt(2 / (WAVE_LENGTH * 20.0)))
    above = np.array([0.0, v_one_six, np.inf])
    loss = edge_loss(above, away, direction)
    assert loss[:2] == pytest.approx([6.0, 17.0], abs=0.6) and np.isinf(loss[2])
    excess = edge_excess(np.array([5.0, 0.0, np.inf]), away, direction)
    # The edge is 17 m up and 16 m away; seen along the ray it lies at 20 + 5 * 0.6 m.
    assert excess[:2] == pytest.approx([np.hypot(16.0, 17.0) - 23.0, 0.0]) and np.isinf(excess[2])


def test_strengths_and_errors(signals, city):
    _, summary = city
    assert 0.2 < summary["los"] < 0.7 and summary["reflected"] > 0.05 and summary["blocked"] > 0.1
    assert 0 < summary["diffracted"] < 0.12
    of = {kind: [row for row in signals if row["class"] == kind and row["tracked"] == "1"]
          for kind in ("los", "reflected", "diffracted", "blocked")}
    assert not of["blocked"]

    def column(kind, name):
        return np.array([float(row[name]) for row in of[kind]])

    assert np.median(column("reflected", "cn0")) < np.median(column("los", "cn0")) - 8
    late = column("reflected", "late")
    assert late.min() == 0 and 0.05 < np.mean(late > 0) < 0.3 and not column("los", "late").any()
    assert abs(np.median(column("los", "noise"))) < 0.15 and 0.2 < column("los", "noise").std() < 1.0
    assert column("reflected", "noise").std() > column("los", "noise").std()
    assert np.percentile(np.abs(column("los", "multipath")), 95) < 1.0
    assert not column("los", "excess_path").any() and column("diffracted", "excess_path").max() < 2.0


@pytest.mark.parametrize("size, name, seed",
                         [(100.0, "canyon", 2), (200.0, "canyon", 2), (140.0, "elevated road", 7),
                          (60.0, "repainted", 1)])
def test_delivered_models_are_valid_and_apart(size, name, seed):
    scene = make_scene(size, name, seed)
    faces = scene.static_faces(GROUND)
    blocks, walls, wall_of_face = deliver(scene.buildings, faces, np.random.default_rng(seed))
    plans = np.array([block.plan for block in blocks])
    assert shapely.is_valid(plans).all() and shapely.area(plans).min() > 10
    first, second = shapely.STRtree(plans).query(plans, predicate="intersects")
    apart = first < second
    assert shapely.area(shapely.intersection(plans[first[apart]], plans[second[apart]])).max(initial=0) < 0.05
    for building in scene.buildings:
        own = [block.plan for block in blocks if block.building == building.id]
        whole = shapely.union_all(own)
        assert whole.geom_type == "Polygon" and not whole.interiors
    offsets = np.array([wall.offset for wall in walls])
    moved = np.abs(offsets[offsets != 0])
    assert moved.min() >= 0.7 and moved.max() <= 1.3 and len(moved) > 0.65 * len(offsets)
    for wall in walls:
        moved = wall.true - wall.delivered[0]
        assert moved @ wall.normal == pytest.approx(np.full(2, wall.offset), abs=2e-3)
    is_wall = faces.kind == FaceKind.WALL
    assert (wall_of_face[is_wall] > 0).all() and not wall_of_face[~is_wall].any()


def test_model_files(city, walls):
    folder, _ = city
    collection = json.loads((folder / "models" / "buildings.geojson").read_text())
    assert collection["crs"]["properties"]["name"] == "urn:ogc:def:crs:EPSG::6677"
    rings = {(item["properties"]["building"], item["properties"]["part"]): item for item in collection["features"]}
    for wall in walls.values():
        item = rings[int(wall["building"]), int(wall["part"])]
        plan = shapely.Polygon(item["geometry"]["coordinates"][0])
        line = shapely.LineString([[float(wall["x0"]), float(wall["y0"])], [float(wall["x1"]), float(wall["y1"])]])
        assert plan.exterior.buffer(0.003).contains(line)
        assert item["properties"]["z_top"] > item["properties"]["z_base"]
    model = json.loads((folder / "models" / "buildings.city.json").read_text())
    vertices = np.array(model["vertices"]) * model["transform"]["scale"] + model["transform"]["translate"]
    parts = {key: item for key, item in model["CityObjects"].items() if item["type"] == "BuildingPart"}
    assert len(parts) == len(rings)
    for part in parts.values():
        shell = part["geometry"][0]["boundaries"][0]
        edges = [(a, b) for (ring,) in shell for a, b in zip(ring, ring[1:] + ring[:1])]
        assert len(set(edges)) == len(edges) and {(b, a) for a, b in edges} == set(edges)
        plan = shapely.Polygon(vertices[shell[0][0]][:, :2])
        volume = sum(np.dot(vertices[ring[0]], np.cross(vertices[ring[i]], vertices[ring[i + 1]])) / 6
                     for (ring,) in shell for i in range(1, len(ring) - 1))
        height = part["attributes"]["z_top"] - part["attributes"]["z_base"]
        assert volume == pytest.approx(plan.area * height, rel=1e-2)
