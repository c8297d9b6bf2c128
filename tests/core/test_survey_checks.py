"""Points, trajectory and reference of different places, times and heights are told apart before any work."""

import re
from dataclasses import replace

import numpy as np
import pytest
import shapely
from pyproj import CRS

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.io.raster import write_raster
from urbanmap_qgis.mobile.registration.start.reference import Reference
from urbanmap_qgis.mobile.survey_checks import require_reference, require_survey, survey_span
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.progress import Progress, notices_to

X, Y, Z = 5000.0, -36000.0, 42.0


def drive():
    """200 m to the east in 100 s, 2 m above a road at 40 m."""
    time = 1000.0 + np.arange(101.0)
    place = np.column_stack([X + 2.0 * np.arange(101.0), np.full(101, Y), np.full(101, Z)])
    return Trajectory(time, place, np.tile([0.0, 0.0, 90.0], (101, 1)))


def cloud(make_cloud, folder, east=0.0, north=0.0, up=0.0, later=0.0, swapped=False):
    x, y = X + np.arange(201.0) + east, np.full(201, Y + 5.0) + north
    x, y = (y, x) if swapped else (x, y)
    return open_cloud([make_cloud(folder / "drive.laz", x, y, np.full(201, 40.0) + up,
                                  gps_time=1000.0 + 0.5 * np.arange(201.0) + later)])


def test_points_of_the_drive_are_accepted(make_cloud, tmp_path):
    made = cloud(make_cloud, tmp_path)
    require_survey(made, drive())
    assert survey_span(made, drive()) == pytest.approx((1000.0, 1100.0), abs=6.0)
    weeks = 1500 * 604_800.0
    later = cloud(make_cloud, tmp_path, later=weeks)
    assert survey_span(later, drive()) == pytest.approx((1000.0, 1100.0), abs=6.0)


@pytest.mark.parametrize(("change", "sentence"), [
    ({"east": 900.0}, r"lies 7\d\d m from where the vehicle was"),
    ({"north": 40_000.0}, "lies 40 km from"),
    ({"swapped": True}, "x and y are swapped"),
    ({"up": 37.0}, "more than 35 m above the trajectory"),
    ({"up": -37.0}, "more than 39 m below the trajectory"),
    ({"later": 5000.0}, "give those of one survey"),
])
def test_points_of_another_survey_are_refused(make_cloud, tmp_path, change, sentence):
    with pytest.raises(InputError, match=sentence):
        require_survey(cloud(make_cloud, tmp_path, **change), drive())


WEDNESDAY = 3 * 86_400.0


@pytest.mark.parametrize(("count", "sentence"), [
    (lambda time: time + WEDNESDAY + 315_964_800.0 + 2000 * 604_800.0, "Unix time"),
    (lambda time: 1e6 * (time + WEDNESDAY), "count microseconds"),
    (lambda time: time, "seconds of the day"),
    (lambda time: (time + WEDNESDAY) % 3600.0, "seconds of the hour"),
])
def test_times_of_another_count_are_named(make_cloud, tmp_path, count, sentence):
    """A drive on a Wednesday; the points' times as other programs count them, and the trajectory's likewise."""
    time, later = 7000.0 + np.arange(101.0), drive()
    points = cloud(make_cloud, tmp_path)
    path = make_cloud(points.paths[0], X + 2.0 * np.arange(101.0), np.full(101, Y + 5.0), np.full(101, 40.0),
                      gps_time=count(time))
    with pytest.raises(InputError, match=sentence):
        require_survey(open_cloud([path]), replace(later, time=WEDNESDAY + time))
    path = make_cloud(path, X + 2.0 * np.arange(101.0), np.full(101, Y + 5.0), np.full(101, 40.0),
                      gps_time=WEDNESDAY + time)
    with pytest.raises(InputError, match=f"the trajectory counts .*{sentence.split()[-1]}"):
        require_survey(open_cloud([path]), replace(later, time=count(time)))


@pytest.mark.parametrize(("later", "refused", "sentence"), [
    (0.0, False, ""), (3.0, False, "3 s earlier.*clocks"), (-3.0, False, "3 s later.*clocks"),
    (18.0, True, "UTC against GPS time"), (-37.0, True, "UTC against TAI")])
def test_clocks_that_differ_are_told(make_cloud, tmp_path, later, refused, sentence):
    """Points 5 m beside the path, where the vehicle was at their times; the clocks differ by some seconds."""
    fast, told = drive(), []
    fast = replace(fast, place=fast.place + np.column_stack([6.0 * np.arange(101.0), np.zeros((101, 2))]))
    path = make_cloud(tmp_path / "a.laz", X + 8.0 * np.arange(0.0, 100.0, 0.05), np.full(2000, Y + 5.0),
                      np.full(2000, 40.0), gps_time=1000.0 + np.arange(0.0, 100.0, 0.05) + later)
    with notices_to(told.append):
        if refused:
            with pytest.raises(InputError, match=sentence):
                require_survey(open_cloud([path]), fast)
        else:
            require_survey(open_cloud([path]), fast)
    assert len(told) == (bool(sentence) and not refused) and all(re.search(sentence, line) for line in told)


def test_a_scanner_that_looks_back_has_no_other_clock(make_cloud, tmp_path):
    """Points 8 m behind, 2 m beside a vehicle that speeds up from 2 to 6 m/s: 2 s earlier it was right beside them."""
    time, told = np.arange(0.0, 100.0, 0.05), []
    chainage = 2.0 * time + 0.02 * time**2
    steady = Trajectory(1000.0 + time, np.column_stack([X + chainage, np.full(2000, Y), np.full(2000, Z)]),
                        np.tile([0.0, 0.0, 90.0], (2000, 1)))
    path = make_cloud(tmp_path / "a.laz", X + chainage - 8.0, np.full(2000, Y + 2.0), np.full(2000, 40.0),
                      gps_time=1000.0 + time)
    with notices_to(told.append):
        require_survey(open_cloud([path]), steady)
    assert not told


@pytest.mark.parametrize(("factor", "sentence"), [
    (1000.0, "the trajectory is in millimetres; give it in metres"),
    (1 / 0.3048, "the trajectory is in feet; give it in metres"),
    (0.001, "the trajectory is in kilometres; give it in metres"),
])
def test_a_trajectory_in_other_units_is_told(make_cloud, tmp_path, factor, sentence):
    given = drive()
    with pytest.raises(InputError, match=sentence):
        require_survey(cloud(make_cloud, tmp_path), replace(given, place=factor * given.place))


def test_a_trajectory_in_degrees_is_told(make_cloud, tmp_path):
    given = drive()
    place = np.column_stack([139.7 + 1e-5 * np.arange(101.0), np.full(101, 35.6), np.full(101, Z)])
    with pytest.raises(InputError, match="latitudes and longitudes in degrees"):
        require_survey(cloud(make_cloud, tmp_path), replace(given, place=place))


def polygons(east):
    return Reference.from_polygons([shapely.box(X + east, Y - 3, X + east + 100, Y + 3)])


def test_references_of_a_part_and_of_another_place():
    told = []
    progress = Progress(warn=told.append)
    require_reference(drive(), None, Reference.from_polygons([shapely.box(X, Y, X + 200, Y + 3)]), progress)
    assert not told
    require_reference(drive(), None, polygons(0.0), progress)
    assert "cover 62 % of the path only" in told[0]
    require_reference(drive(), (1000.0, 1050.0), polygons(0.0), progress)
    assert len(told) == 1
    with pytest.raises(InputError, match="reference markings lie 2 km from the path"):
        require_reference(drive(), None, polygons(2200.0))


@pytest.mark.parametrize(("east", "height", "sentence"), [
    (0.0, 77.0, "35 m below the ground elevation"), (0.0, 3.0, "39 m above the ground elevation"),
    (5000.0, 40.0, "ground elevation lies 5 km from the path")])
def test_ground_of_another_place_or_height_system(tmp_path, east, height, sentence):
    def ground(east, height):
        grid = Grid(X + east - 20, Y + 20, 1.0, 40, 240)
        write_raster(tmp_path / "ground.tif", np.full(grid.shape, height, np.float32), grid,
                     CRS.from_epsg(6677).to_wkt())
        return Reference.from_polygons([shapely.box(X, Y, X + 200, Y + 3)], tmp_path / "ground.tif")

    require_reference(drive(), None, ground(0.0, 40.0))
    with pytest.raises(InputError, match=sentence):
        require_reference(drive(), None, ground(east, height))
