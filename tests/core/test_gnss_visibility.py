"""Satellites in line of sight among walls of which the shadows are known."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError
from urbanmap_qgis.gnss.orbits.earth_fixed import MapFrame, directions, elevation_azimuth
from urbanmap_qgis.gnss.orbits.ephemeris import read_navigation, sky_at
from urbanmap_qgis.gnss.rays.tracing import WallObstacles
from urbanmap_qgis.gnss.rays.visibility import (
    SkySettings,
    area_grid,
    gps_time_of,
    level_ground,
    position_dilution,
    visibility_along,
    visibility_over,
    visible_satellites,
)
from urbanmap_qgis.gnss.rays.wall_faces import building_walls
from urbanmap_qgis.gnss.rinex.gnss_time import calendar_text
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.progress import Progress

CRS = "EPSG:6677"
EAST, NORTH = -6950.0, -34100.0
TIME = gps_time_of("2024-04-18T02:00:00Z")


@pytest.fixture(scope="module")
def navigation(small_city):
    return read_navigation([small_city / "gnss" / "satellites.nav"])


def street(width: float = 20.0, height: float = 30.0, length: float = 4000.0):
    """Walls of two very long buildings along a street from south to north, its middle at EAST."""
    boxes = [shapely.box(EAST + low, NORTH - length, EAST + high, NORTH + length)
             for low, high in ((-width / 2 - 30, -width / 2), (width / 2, width / 2 + 30))]
    return building_walls(boxes, top=np.full(2, height), low=np.zeros(2))


def sky(navigation, mask: float = 10.0) -> tuple[np.ndarray, np.ndarray]:
    here = MapFrame(CRS).places(np.array([[EAST, NORTH, 0.0]]))
    names, vectors = sky_at(navigation, TIME, here.earth_fixed[0], "GECJ")
    direction = directions(np.broadcast_to(here.axes, (len(names), 3, 3)), vectors)
    up = np.degrees(elevation_azimuth(direction)[0]) >= mask
    return names[up], direction[up]


@pytest.mark.parametrize("height, offset", [(30.0, 0.0), (60.0, -6.0), (12.0, 8.0)])
def test_a_street_hides_what_is_lower_than_its_edges(navigation, height, offset):
    """Across the street a satellite is seen where its slope exceeds the slope to the edge of the roof."""
    place = np.array([[EAST + offset, NORTH, 2.0]])
    found = visible_satellites(WallObstacles.of(street(height=height)), navigation, place, np.array(TIME), CRS, "GECJ")
    names, direction = sky(navigation)
    to_wall = np.where(direction[:, 0] > 0, 10.0 - offset, 10.0 + offset)
    free = direction[:, 2] * to_wall > (height - 2.0) * np.abs(direction[:, 0])
    assert found.satellites[0] == free.sum() and found.above[0] == len(names) and 0 < free.sum() < len(names)
    for name in "GECJ":
        assert found.by_system[name][0] == free[names.astype("U1") == name].sum()
    assert set(found.names) == set(names)


def test_open_sky_and_inside(navigation):
    obstacles = WallObstacles.of(street())
    place = np.array([[EAST + 500.0, NORTH, 2.0], [EAST + 20.0, NORTH, 2.0], [EAST + 20.0, NORTH, 31.0]])
    found = visible_satellites(obstacles, navigation, place, np.array(TIME), CRS, "GECJ")
    assert np.isnan(found.satellites[1]) and np.isnan(found.pdop[1])
    assert found.satellites[2] == found.above[2] and found.satellites[0] >= found.above[0] - 2
    assert 0.5 < found.pdop[2] < 2.5


def test_dilution_by_the_inverse_of_the_normal_matrix():
    rng = np.random.default_rng(3)
    direction = rng.normal(size=(9, 3))
    direction[:, 2] = np.abs(direction[:, 2])
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    system = np.array(list("GGGGGEEEC"))
    free = np.ones((6, 9), bool)
    free[1, 5:] = False          # GPS alone
    free[2, 8] = False           # without BeiDou
    free[3, 3:] = False          # three satellites
    free[4] = [1, 1, 1, 0, 0, 1, 0, 0, 1]   # five satellites, three clocks
    free[5] = False
    pdop = position_dilution(direction, system, free)
    for row in (0, 1, 2):
        seen = free[row]
        letters = sorted(set(system[seen]))
        design = np.hstack([direction[seen], (system[seen][:, None] == letters).astype(float)])
        assert pdop[row] == pytest.approx(np.sqrt(np.trace(np.linalg.inv(design.T @ design)[:3, :3])), rel=1e-9)
    assert np.isnan(pdop[3:]).all()


def test_satellites_on_one_cone_fix_nothing():
    azimuth = np.radians(np.arange(0, 360, 45))
    direction = np.column_stack([np.cos(0.7) * np.sin(azimuth), np.cos(0.7) * np.cos(azimuth), np.full(8, np.sin(0.7))])
    assert np.isnan(position_dilution(direction, np.array(["G"] * 8), np.ones((1, 8), bool))).all()


def test_along_a_drive(navigation):
    """From the street out into the open; times as seconds of week; the antenna on a mast."""
    seconds = TIME % 604800
    time = seconds + np.arange(0.0, 121.0, 2.0)
    place = np.column_stack([np.full(61, EAST), NORTH + 3880.0 + 5.0 * np.arange(61), np.full(61, 1.0)])
    drive = Trajectory(time, place, np.zeros((61, 3)))
    obstacles = WallObstacles.of(street(height=60.0))
    found_time, antenna, seen = visibility_along(obstacles, navigation, drive, CRS, SkySettings("GECJ"),
                                                 (0.5, 0.0, -1.5), 1.0)
    assert np.array_equal(found_time, seconds + np.arange(121.0))
    assert antenna[:, 2] == pytest.approx(np.full(121, 2.5)) and antenna[0, 1] == pytest.approx(NORTH + 3880.5)
    assert seen.satellites[-1] > seen.satellites[0] + 5
    direct = visible_satellites(obstacles, navigation, antenna[:1], np.array(TIME), CRS, "GECJ")
    assert direct.satellites[0] == seen.satellites[0]
    assert len(visibility_along(obstacles, navigation, drive, CRS, SkySettings("G"), every=10.0)[0]) == 13


def test_gaps_of_a_drive_are_left_out(navigation):
    time = TIME % 604800 + np.array([0.0, 1.0, 2.0, 60.0, 61.0])
    drive = Trajectory(time, np.column_stack([np.full(5, EAST), NORTH + np.arange(5.0), np.full(5, 2.0)]),
                       np.zeros((5, 3)))
    found, _, _ = visibility_along(WallObstacles.of(street()), navigation, drive, CRS, SkySettings())
    assert found.tolist() == time.tolist()


def test_over_an_area(navigation):
    walls = street(length=60.0)
    grid = area_grid((EAST - 60, NORTH - 80, EAST + 60, NORTH + 80), 10.0)
    antenna = np.full(grid.shape, level_ground(walls) + 2.0)
    antenna[0] = np.nan
    cells, place, seen = visibility_over(WallObstacles.of(walls), navigation, grid, antenna, TIME, CRS,
                                         SkySettings("GECJ"))
    x, y = grid.centres()
    assert np.array_equal(place[:, 0], x[cells[:, 1]]) and np.array_equal(place[:, 1], y[cells[:, 0]])
    assert (place[:, 2] == 2.0).all() and cells[:, 0].min() == 1
    hidden = (np.abs(place[:, 0] - EAST) > 10) & (np.abs(place[:, 0] - EAST) < 40) & (np.abs(place[:, 1] - NORTH) < 60)
    assert not hidden.any() and len(place) == (grid.rows - 1) * grid.columns - 6 * 12
    middle = (np.abs(place[:, 0] - EAST) < 10) & (np.abs(place[:, 1] - NORTH) < 30)
    corner = np.abs(place[:, 0] - EAST) > 50
    assert seen.satellites[middle].max() < seen.satellites[corner].max()


def test_the_cut_into_pieces_does_not_matter(navigation, monkeypatch):
    grid = area_grid((EAST - 30, NORTH - 30, EAST + 30, NORTH + 30), 5.0)
    arguments = (WallObstacles.of(street()), navigation, grid, np.full(grid.shape, 2.0), TIME, CRS, SkySettings())
    _, _, whole = visibility_over(*arguments)
    monkeypatch.setattr("urbanmap_qgis.gnss.rays.visibility._RAYS", 100)
    _, _, pieces = visibility_over(*arguments)
    assert np.array_equal(whole.satellites, pieces.satellites)
    assert whole.pdop == pytest.approx(pieces.pdop, rel=1e-9, nan_ok=True)


@pytest.mark.parametrize("text, expected", [
    ("2024-04-18 02:30:00", "2024-04-18 02:30:18"), ("2024-04-18T02:30:00Z", "2024-04-18 02:30:18"),
    ("2024-04-18T11:30:00+09:00", "2024-04-18 02:30:18"), ("2024-04-18", "2024-04-18 00:00:18")])
def test_times_in_utc(text, expected):
    assert calendar_text(gps_time_of(text)) == expected


def test_what_cannot_be_used(navigation):
    obstacles, place = WallObstacles.of(street()), np.array([[EAST, NORTH, 2.0]])
    with pytest.raises(InputError, match="is no time"):
        gps_time_of("noon")
    with pytest.raises(InsufficientDataError, match=r"can be placed at 2025-04-18 .* good for 2024-04-1"):
        visible_satellites(obstacles, navigation, place, np.array(gps_time_of("2025-04-18")), CRS)
    with pytest.raises(InsufficientDataError, match="GLONASS"):
        visible_satellites(obstacles, navigation, place, np.array(TIME), CRS, "R")
    with pytest.raises(InputError, match="million cells"):
        area_grid((0.0, 0.0, 2000.0, 2000.0), 1.0)
    with pytest.raises(InputError, match="give a ground raster"):
        level_ground(building_walls([shapely.box(0, 0, 9, 9)], top=np.array([9.0])))
    grid = area_grid((EAST + 15, NORTH - 5, EAST + 25, NORTH + 5), 5.0)
    with pytest.raises(InsufficientDataError, match="inside buildings"):
        visibility_over(obstacles, navigation, grid, np.full(grid.shape, 2.0), TIME, CRS, SkySettings())
    with pytest.raises(InsufficientDataError, match="ground height"):
        visibility_over(obstacles, navigation, grid, np.full(grid.shape, np.nan), TIME, CRS, SkySettings())
    drive = Trajectory(np.array([100.0, 160.0]), np.zeros((2, 3)), np.zeros((2, 3)))
    with pytest.raises(InputError, match="Trajectory and navigation files are not of one time"):
        visibility_along(obstacles, navigation, drive, CRS, SkySettings())
    with pytest.raises(Cancelled):
        visible_satellites(obstacles, navigation, place, np.array(TIME), CRS,
                           progress=Progress(cancelled=lambda: True))
