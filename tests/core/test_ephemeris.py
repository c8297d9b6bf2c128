"""Places of satellites from broadcast orbits, and the frames in which they are told."""

from __future__ import annotations

import numpy as np
import pyproj
import pytest
from scipy.integrate import solve_ivp

from tests.core.test_rinex_navigation import glonass, header
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.gnss.orbits.earth_fixed import MapFrame, directions, elevation_azimuth
from urbanmap_qgis.gnss.orbits.ephemeris import (
    NO_EPHEMERIS,
    OK,
    UNHEALTHY,
    Navigation,
    geometric_ranges,
    glonass_states,
    kepler_states,
    read_navigation,
    satellite_states,
    sky_at,
)
from urbanmap_qgis.gnss.rinex.navigation import GlonassRecords, KeplerRecords, read_navigation_files

C = 299792458.0
TURN = 7.2921151467e-5
START = 2033 * 604800.0
GM = {"G": 3.986005e14, "E": 3.986004418e14, "C": 3.986004418e14, "J": 3.986005e14}
BASE = {
    "af0": 1.25e-4, "af1": -3.5e-12, "af2": 1e-18, "crs": -41.5, "delta_n": 4.5e-9, "m0": 1.125, "cuc": -2.5e-6,
    "e": 8.75e-3, "cus": 4.75e-6, "sqrt_a": 5153.75, "cic": -9.5e-8, "omega0": -2.25, "cis": 8.5e-8, "i0": 0.9625,
    "crc": 295.5, "omega": 0.6875, "omega_dot": -8.0e-9, "i_dot": 1.025e-10, "source": 517.0, "health": 0.0,
    "delay_a": 5.5e-9, "delay_b": -7.25e-9}


def kepler(*rows: dict) -> KeplerRecords:
    """Records with the base's elements; each row tells its satellite, `toe` (s of the week) and what differs."""
    table = []
    for row in rows:
        own = row.get("toe", 7200.0)
        shift = 14.0 if row["satellite"][0] == "C" else 0.0
        table.append(BASE | {"toe_own": own, "toc": START + own + shift} | row | {"toe": START + own + shift})
    names = KeplerRecords.__dataclass_fields__
    return KeplerRecords(**{name: np.array([row[name] for row in table]) for name in names})


def navigation(records: KeplerRecords, glonass: GlonassRecords | None = None) -> Navigation:
    empty = read_navigation_files([])
    return Navigation(records, glonass or empty.glonass, (), (), ())


def turn_z(a: float) -> np.ndarray:
    return np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])


def turn_x(a: float) -> np.ndarray:
    return np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])


def by_matrices(row: dict, since: float, turn: float, still: bool) -> tuple[np.ndarray, float]:
    """Kepler's equation by bisection and turn matrices; the tilted frame of BeiDou's geostationary satellites."""
    v = BASE | {"toe": 7200.0} | row
    gm = GM[v["satellite"][0]]
    mean = v["m0"] + (np.sqrt(gm) / v["sqrt_a"] ** 3 + v["delta_n"]) * since
    low, high = mean - 1, mean + 1
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if middle - v["e"] * np.sin(middle) < mean else (low, middle)
    x, y = np.cos(middle) - v["e"], np.sqrt(1 - v["e"] ** 2) * np.sin(middle)
    angle = np.arctan2(y, x) + v["omega"]
    c2, s2 = np.cos(2 * angle), np.sin(2 * angle)
    radius = v["sqrt_a"] ** 2 * np.hypot(x, y) + v["crc"] * c2 + v["crs"] * s2
    tilt = v["i0"] + v["i_dot"] * since + v["cic"] * c2 + v["cis"] * s2
    inertial = turn_z(v["omega0"] + v["omega_dot"] * since - turn * v["toe"]) @ turn_x(tilt) @ turn_z(
        angle + v["cuc"] * c2 + v["cus"] * s2) @ [radius, 0, 0]
    place = turn_z(-turn * since) @ (turn_x(np.radians(5.0)) @ inertial if still else inertial)
    clock = v["af0"] + v["af1"] * since + v["af2"] * since ** 2
    return place, clock - 2 * np.sqrt(gm) * v["sqrt_a"] * v["e"] * np.sin(middle) / C ** 2


@pytest.mark.parametrize("name, turn, still, more", [
    ("G05", TURN, False, {}), ("E11", TURN, False, {"sqrt_a": 5440.6}),
    ("J02", TURN, False, {"sqrt_a": 6493.5, "e": 0.075}),
    ("C13", 7.292115e-5, False, {"sqrt_a": 6493.4}), ("C03", 7.292115e-5, True, {"sqrt_a": 6493.4, "i0": 0.1}),
    ("C60", 7.292115e-5, True, {"sqrt_a": 6493.4, "i0": 0.1})])
def test_keplerian_orbits_of_all_systems(name, turn, still, more):
    row = {"satellite": name} | more
    for since in (-3600.0, -1.5, 0.0, 1234.567, 7199.0):
        records = kepler(row)
        place, clock = kepler_states(records, records.toe + since)
        expected, ticks = by_matrices(row, since, turn, still)
        # Seconds since 1980 in 64 bits resolve 0.1 microseconds, half a millimetre of orbit.
        assert np.abs(place[0] - expected).max() < 2e-3
        assert clock[0] == pytest.approx(ticks, abs=1e-12)


def glonass_record(**more) -> GlonassRecords:
    values = {"satellite": np.array(["R07"]), "toe": np.array([START + 918.0]), "clock": np.array([6.25e-5]),
              "drift": np.array([1e-12]), "health": np.zeros(1), "channel": np.array([-4.0]),
              "place": np.array([[8498.5e3, 19647.25e3, -13877.75e3]]),
              "velocity": np.array([[-1125.0, -1500.0, -2875.0]]), "acceleration": np.array([[1.5e-6, 0.0, 2.5e-6]])}
    return GlonassRecords(**(values | more))


@pytest.mark.parametrize("since", [-1500.0, -7.25, 0.0, 30.5, 899.0, 1800.0])
def test_glonass_against_integration_in_the_inertial_frame(since):
    """Motion without turning axes, by another integrator; sun's and moon's pull turns with the earth."""
    record = glonass_record()
    omega = 7.292115e-5
    spin = np.array([0, 0, omega])
    place, velocity = record.place[0], record.velocity[0]

    def motion(t, state):
        x = state[:3]
        r = np.linalg.norm(x)
        # Gradient of the potential of a flattened earth, mu/r (1 - J2 (a/r)^2 (3 z^2/r^2 - 1)/2).
        mu, j2, a = 3.9860044e14, 1.0826257e-3, 6378136.0
        k = 1.5 * j2 * mu * a * a / r**5
        pull = -mu / r**3 * x - k * x * np.array([1, 1, 3]) + 5 * k * x[2]**2 / r**2 * x
        return np.concatenate([state[3:], pull + turn_z(omega * t) @ record.acceleration[0]])

    start = np.concatenate([place, velocity + np.cross(spin, place)])
    end = start if since == 0 else solve_ivp(motion, (0, since), start, rtol=1e-12, atol=1e-6).y[:, -1]
    found, clock = glonass_states(record, record.toe + since)
    assert np.abs(found[0] - turn_z(-omega * since) @ end[:3]).max() < 2e-3
    assert clock[0] == pytest.approx(6.25e-5 + 1e-12 * since, abs=1e-15)


def test_the_nearest_ephemeris_is_taken_and_none_too_old():
    records = kepler({"satellite": "G05", "toe": 0.0, "af0": 1e-5}, {"satellite": "G05", "toe": 7200.0, "af0": 2e-5},
                     {"satellite": "G05", "toe": 14400.0, "af0": 3e-5})
    time = START + np.array([-8000.0, 3500.0, 3700.0, 10900.0, 20000.0, 23000.0])
    states = satellite_states(navigation(records), np.array(["G05"] * 6), time)
    assert states.status.tolist() == [NO_EPHEMERIS, OK, OK, OK, OK, NO_EPHEMERIS]
    assert np.round(states.clock[1:5] * 1e5).tolist() == [1, 2, 3, 3]
    assert states.age[1:5].tolist() == [3500.0, 3500.0, 3500.0, 5600.0]
    assert np.isnan(states.place[[0, 5]]).all() and np.isfinite(states.place[1:5]).all()


def test_unhealthy_and_missing_satellites():
    records = kepler({"satellite": "G05"}, {"satellite": "G06", "health": 63.0}, {"satellite": "J02", "health": 1.0},
                     {"satellite": "E11", "health": 8.0}, {"satellite": "E12", "health": 1.0},
                     {"satellite": "C06", "health": 1.0})
    sick = glonass_record(health=np.ones(1))
    names = ["G05", "G06", "J02", "E11", "E12", "C06", "R07", "G09", "R08", "S20"]
    states = satellite_states(navigation(records, sick), np.array(names), np.full(len(names), START + 2500.0))
    assert dict(zip(names, states.status)) == {
        "G05": OK, "G06": UNHEALTHY, "J02": OK, "E11": OK, "E12": UNHEALTHY, "C06": UNHEALTHY, "R07": UNHEALTHY,
        "G09": NO_EPHEMERIS, "R08": NO_EPHEMERIS, "S20": NO_EPHEMERIS}
    assert np.isfinite(states.place).all(axis=1).tolist() == [status == OK for status in states.status]


def test_group_delays_by_system_and_band():
    records = kepler({"satellite": "G05"}, {"satellite": "C06"}, {"satellite": "E11"}, {"satellite": "J02"})
    names, time = np.array(["G05", "C06", "E11", "J02"]), np.full(4, START + 7300.0)
    a, b = BASE["delay_a"], BASE["delay_b"]
    first = satellite_states(navigation(records), names, time).delay
    assert first == pytest.approx([a, a, b, a], rel=1e-12)
    second = satellite_states(navigation(records), names, time, {"G": "2", "C": "7", "E": "7", "J": "2"}).delay
    gamma = (1575.42 / 1227.60) ** 2
    assert second == pytest.approx([gamma * a, b, (1575.42 / 1207.14) ** 2 * b, gamma * a], rel=1e-9)
    assert satellite_states(navigation(records), names[1:2], time[:1], {"C": "6"}).delay[0] == 0.0


def test_galileos_message_is_chosen_by_the_band():
    records = kepler({"satellite": "E11", "source": 258.0, "af0": 1e-5},
                     {"satellite": "E11", "source": 517.0, "af0": 2e-5})
    swapped = KeplerRecords(*(getattr(records, name)[::-1] for name in KeplerRecords.__dataclass_fields__))
    for some in (records, swapped):
        for band, clock, delay in (("1", 2.0, BASE["delay_b"]), ("5", 1.0, (154 / 115) ** 2 * BASE["delay_a"])):
            states = satellite_states(navigation(some), np.array(["E11"]), np.array([START + 7300.0]), {"E": band})
            assert round(states.clock[0] * 1e5, 1) == clock and states.delay[0] == pytest.approx(delay, rel=1e-9)


def test_signal_paths_solve_the_light_equation():
    """A code made forwards: sent by the satellite's wrong clock, received where the light meets the turning antenna."""
    records = kepler({"satellite": "G05"})
    antenna = np.array([-3.95e6, 3.35e6, 3.70e6])
    spin = np.array([0, 0, TURN])
    for receiver_clock in (0.0, 0.4e-3, -20e-3):
        sent = START + 8000.25
        place, clock = kepler_states(records, np.array([sent]))
        travel = 0.08
        for _ in range(20):
            # Inertial axes that agree with the earth's at transmission.
            travel = np.linalg.norm(turn_z(spin[2] * travel) @ antenna - place[0]) / C
        delay = BASE["delay_a"]
        code = C * (travel + receiver_clock - clock[0] + delay)
        stamped = sent + travel + receiver_clock
        paths = geometric_ranges(navigation(records), np.array(["G05"]), np.array([stamped]), np.array([code]),
                                 antenna[None])
        left = code - paths.distance[0] + C * (paths.states.clock[0] - paths.states.delay[0])
        assert left == pytest.approx(C * receiver_clock, abs=2e-3)
        arrival = turn_z(-spin[2] * travel) @ place[0] - antenna
        assert paths.vector[0] == pytest.approx(arrival, abs=5e-3)


def test_sky_holds_the_healthy_satellites_only():
    records = kepler({"satellite": "G05"}, {"satellite": "G06", "health": 1.0}, {"satellite": "E11", "m0": 2.0})
    names, vectors = sky_at(navigation(records), START + 7300.0, np.array([-3.95e6, 3.35e6, 3.70e6]), "GE")
    assert names.tolist() == ["E11", "G05"] and vectors.shape == (2, 3)
    assert sky_at(navigation(records), START + 7300.0, np.zeros(3), "E")[0].tolist() == ["E11"]


def test_span_of_navigation():
    records = kepler({"satellite": "G05", "toe": 0.0}, {"satellite": "E11", "toe": 7200.0})
    first, last = navigation(records).span()
    assert first == min(START - 7500.0, START + 7200.0 - 14400.0) and last == START + 7200.0 + 14400.0


def test_no_navigation_file():
    with pytest.raises(InputError, match="No navigation file"):
        read_navigation([])


# Against RTKLIB

def rtklib_differences(paths: list, number: int) -> dict[str, list[tuple[float, float]]]:
    """Distance (m) and clock difference (s) to RTKLIB by system, of records taken at random."""
    rtk = pytest.importorskip("pyrtklib", reason="pyrtklib, a cross-check for tests only, is not installed")
    theirs, observations, station = rtk.nav_t(), rtk.obs_t(), rtk.sta_t()
    for path in paths:
        rtk.readrnx(str(path), 1, "", observations, theirs, station)
    ours = read_navigation_files(paths)
    systems = {"G": rtk.SYS_GPS, "E": rtk.SYS_GAL, "J": rtk.SYS_QZS, "C": rtk.SYS_CMP, "R": rtk.SYS_GLO}
    place, clock, variance = rtk.Arr1Ddouble(3), rtk.Arr1Ddouble(1), rtk.Arr1Ddouble(1)
    rng = np.random.default_rng(4)
    found: dict[str, list[tuple[float, float]]] = {}
    for records, listed, compute, states, reach in (
            (ours.kepler, [theirs.eph[i] for i in range(theirs.n)], rtk.eph2pos, kepler_states, 7000.0),
            (ours.glonass, [theirs.geph[i] for i in range(theirs.ng)], rtk.geph2pos, glonass_states, 1800.0)):
        kind = type(records)
        for row in rng.choice(len(records), min(number, len(records)), replace=False):
            name = str(records.satellite[row])
            satellite = rtk.satno(systems[name[0]], int(name[1:]) + (192 if name[0] == "J" else 0))
            offset = records.af0[row] if kind is KeplerRecords else records.clock[row]
            same = [one for one in listed if one.sat == satellite
                    and abs(one.toe.time + one.toe.sec - records.toe[row] - 315964800) < 1e-3
                    and abs((one.f0 if kind is KeplerRecords else -one.taun) - offset) < 1e-15]
            assert same, f"RTKLIB has no record of {name}"
            time = records.toe[row] + rng.uniform(-reach, reach)
            compute(rtk.gpst2time(int(time // 604800), time % 604800), same[0], place, clock, variance)
            one = kind(*(getattr(records, field)[[row]] for field in kind.__dataclass_fields__))
            mine, ticks = states(one, np.array([time]))
            apart = np.linalg.norm(mine[0] - [place[k] for k in range(3)])
            found.setdefault(name[0], []).append((apart, abs(ticks[0] - clock[0])))
    return found


def assert_same(found: dict, systems: str) -> None:
    assert set(found) == set(systems)
    for differences in found.values():
        apart, ticks = np.array(differences).T
        assert apart.max() < 0.01 and ticks.max() < 1e-9


def test_against_rtklib_on_the_sample_city(small_city):
    assert_same(rtklib_differences([small_city / "gnss" / "satellites.nav"], 120), "GEJC")


@pytest.mark.parametrize("folder, systems", [("tst_2019", "GC"), ("tst_2020", "GREC")])
def test_against_rtklib_on_real_files(real_data, folder, systems):
    paths = sorted((real_data / "gnss" / folder).glob("hksc*"))
    assert_same(rtklib_differences(paths, 150), systems)


def test_a_stale_record_makes_no_span_of_months(small_city):
    """A navigation file of a day with one record of another month is good for these two times, not for all between."""
    from dataclasses import replace

    from urbanmap_qgis.gnss.orbits.ephemeris import read_navigation

    navigation = read_navigation([small_city / "gnss/satellites.nav"])
    (span,) = navigation.spans()
    assert span == navigation.span()
    toe = navigation.kepler.toe.copy()
    toe[0] -= 86 * 86400.0
    spans = replace(navigation, kepler=replace(navigation.kepler, toe=toe)).spans()
    assert len(spans) == 2 and spans[0][0] > toe[0] + 80 * 86400.0 and spans[1][0] < toe[0] < spans[1][1]


@pytest.mark.parametrize("characters", [1, 8, 15, 22])
def test_a_state_vector_that_is_cut_within_its_last_line_is_left_out(tmp_path, characters):
    """Its z would be of fewer digits: 1387 km for -13877.75 km."""
    whole = header(3.04, "N: GNSS NAV DATA    M") + glonass("R01")
    path = tmp_path / "a.nav"
    cut = (whole + glonass("R05")).rstrip("\n").rpartition("\n")
    path.write_text(cut[0] + "\n" + cut[2][:characters])
    assert read_navigation_files([path]).glonass.satellite.tolist() == ["R01"]


CASES = [("EPSG:6677", -6950.0, -34100.0), ("EPSG:32650", 209212.8, 2468743.1), ("EPSG:25833", 391000.0, 5819000.0),
         ("EPSG:2193", 1750000.0, 5427000.0), ("EPSG:31983", 333000.0, 7394000.0)]


@pytest.mark.parametrize("crs, east, north", CASES)
def test_earth_fixed_against_proj(crs, east, north):
    place = np.array([[east, north, 12.5], [east + 800.0, north - 650.0, 60.0]])
    found = MapFrame(crs, 36.6).places(place)
    lon, lat = pyproj.Transformer.from_crs(crs, "EPSG:4326", always_xy=True).transform(place[:, 0], place[:, 1])
    cart = pyproj.Transformer.from_pipeline("+proj=cart +ellps=WGS84")
    expected = np.column_stack(cart.transform(lon, lat, place[:, 2] + 36.6))
    assert np.abs(found.earth_fixed - expected).max() < 1e-4
    assert np.degrees(found.latitude) == pytest.approx(lat) and np.degrees(found.longitude) == pytest.approx(lon)


@pytest.mark.parametrize("crs, east, north", CASES)
def test_axes_are_the_maps(crs, east, north):
    """A step along the map's axes goes along the axes given, and the convergence is PROJ's."""
    frame = MapFrame(crs)
    here = np.array([[east, north, 50.0]])
    found = frame.places(here)
    assert found.axes[0] @ found.axes[0].T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(found.axes[0]) == pytest.approx(1.0)
    for k in range(3):
        step = frame.places(here + 5.0 * np.eye(3)[k]).earth_fixed - found.earth_fixed
        assert directions(found.axes, step)[0] == pytest.approx(np.eye(3)[k], abs=1e-4)
    factors = pyproj.Proj(crs).get_factors(np.degrees(found.longitude[0]), np.degrees(found.latitude[0]))
    # PROJ counts the convergence from grid to true north or back by its projections' habit: the size is certain.
    assert abs(np.degrees(found.convergence[0])) == pytest.approx(abs(factors.meridian_convergence), abs=1e-4)


def test_sign_of_the_convergence():
    """East of the central meridian on the northern half grid north points east of true north."""
    east, west = (MapFrame("EPSG:25833").places(np.array([[x, 5819000.0, 0.0]])).convergence[0] for x in (6e5, 4e5))
    assert east > 0.01 and west == pytest.approx(-east)


def test_directions_to_known_azimuths():
    frame = MapFrame("EPSG:25833")
    here = frame.places(np.array([[391000.0, 5819000.0, 50.0]]))
    for azimuth, height in ((0.0, 0.0), (90.0, 30.0), (215.0, 100.0), (300.0, 200.0)):
        angle = np.radians(azimuth)
        there = np.array([[391000.0 + 300 * np.sin(angle), 5819000.0 + 300 * np.cos(angle), 50.0 + height]])
        direction = directions(here.axes, frame.places(there).earth_fixed - here.earth_fixed)
        elevation, found = np.degrees(elevation_azimuth(direction))
        assert (found[0] - azimuth + 180) % 360 - 180 == pytest.approx(0.0, abs=0.01)
        assert elevation[0] == pytest.approx(np.degrees(np.arctan2(height, 300.0)), abs=0.03)


def test_compound_crs_and_wkt():
    place = np.array([[-6950.0, -34100.0, 12.5]])
    wkt = pyproj.CRS("EPSG:6677+6695").to_wkt()
    assert MapFrame(wkt).places(place).earth_fixed == pytest.approx(MapFrame("EPSG:6677").places(place).earth_fixed)


def test_another_datum_is_transformed():
    """The Tokyo datum lies some 450 m from the world's; the same numbers are another place."""
    place = np.array([[-6950.0, -34100.0, 12.5]])
    old, new = (MapFrame(crs).places(place).earth_fixed[0] for crs in ("EPSG:30169", "EPSG:6677"))
    assert 300 < np.linalg.norm(old - new) < 600


@pytest.mark.parametrize("crs, words", [("EPSG:4326", "in metres"), ("", "states no"), ("nonsense", "understood"),
                                        ("EPSG:2263", "in metres")])
def test_crs_that_cannot_be_used(crs, words):
    with pytest.raises(InputError, match=words):
        MapFrame(crs)


def test_places_outside_the_crs():
    with pytest.raises(InputError, match="outside the area"):
        MapFrame("EPSG:32650").places(np.array([[1e12, 1e12, 0.0]]))
