"""What hid a wall and where beams went through it, against walls, hedges and glass of exact geometry."""

import laspy
import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.facades import wall_stage
from urbanmap_qgis.facades.beam_checks import BeamFacts, check_beams, check_start
from urbanmap_qgis.facades.building_plans import building_plans
from urbanmap_qgis.facades.facade_points import FacadePoints
from urbanmap_qgis.facades.laser_beams import LaserBeams, crossed_cells, laser_beams
from urbanmap_qgis.facades.plane_fit import WallPlane
from urbanmap_qgis.facades.wall_contours import Contour, wall_coverage
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.progress import Progress

CELL, SHAPE = 0.25, (40, 80)  # 10 m high, 20 m long
CORNER = (0.0, 0.0)


def wall():
    """A wall along x at y = 0 that faces south, where the vehicle drives; its axes' origin is its lower left end."""
    return WallPlane(np.array([0.0, 0.0, 0.0]), np.array([0.0, -1.0, 0.0]), 0.01, 0.001, 100, 1, float("nan"))


def middles(mask):
    """x and z (k, 2) of the middles of the cells of a mask."""
    row, column = np.nonzero(mask)
    return np.column_stack([(column + 0.5) * CELL, (row + 0.5) * CELL])


def test_a_hedge_hides_what_lies_behind_it_from_where_the_scanner_was():
    """From 10 m off and 2 m up, a hedge 5 m off from x 8 to 10 m, 3 m high, hides x 6 to 10 from x = 10, up to 4 m."""
    x, z = np.meshgrid(np.arange(8.0, 10.01, 0.25), np.arange(0.0, 3.01, 0.25))
    hedge = np.column_stack([x.ravel(), np.full(x.size, -5.0), z.ravel()])
    origin = np.tile([10.0, -10.0, 2.0], (len(hedge), 1))
    hidden, through = crossed_cells(LaserBeams(origin, hedge, 0.25), wall(), CORNER, SHAPE, CELL)
    places = middles(hidden)
    assert not through.any()
    assert places.min(axis=0) == pytest.approx([6.0, 0.0], abs=0.45) and places.max(axis=0) == pytest.approx(
        [10.0, 4.0], abs=0.45)
    # The shadow is whole: two steps of the hedge are one and a half cells of it apart.
    assert hidden.sum() * CELL**2 == pytest.approx(4.0 * 4.0, abs=3.5)


def test_beams_that_end_in_a_room_went_through_their_window():
    x, z = np.meshgrid(np.linspace(4.0, 6.0, 30), np.linspace(1.0, 2.0, 30))
    pane = np.column_stack([x.ravel(), np.zeros(x.size), z.ravel()])
    origin = np.tile([5.0, -8.0, 1.5], (len(pane), 1))
    back = origin + (pane - origin) * (8.0 + 3.0) / 8.0
    hidden, through = crossed_cells(LaserBeams(origin, back, 0.1), wall(), CORNER, SHAPE, CELL)
    assert not hidden.any() and through.sum() == 8 * 4
    assert middles(through).min(axis=0) == pytest.approx([4.125, 1.125]) and middles(through).max(axis=0) == \
        pytest.approx([5.875, 1.875])


def test_what_lies_on_the_wall_or_was_measured_from_behind_tells_nothing():
    places = np.array([[5.0, -0.1, 2.0], [5.0, 0.2, 2.0], [5.0, 4.0, 2.0], [5.0, -4.0, 2.0]])
    origin = np.array([[5.0, -9.0, 2.0], [5.0, -9.0, 2.0], [5.0, 9.0, 2.0], [5.0, 9.0, 2.0]])
    for mask in crossed_cells(LaserBeams(origin, places, 0.5), wall(), CORNER, SHAPE, CELL):
        assert not mask.any()
    for mask in crossed_cells(LaserBeams(np.zeros((0, 3)), np.zeros((0, 3)), 0.5), wall(), CORNER, SHAPE, CELL):
        assert mask.shape == SHAPE and not mask.any()


def test_a_shadow_that_few_beams_would_have_to_fill_is_left_out():
    """A cube of 0.5 m a metre before the scanner, 20 m from the wall, stands for 10 m of it: too thin to tell."""
    lines = LaserBeams(np.array([[10.0, -20.0, 2.0]]), np.array([[10.0, -19.0, 2.0]]), 0.5)
    assert not crossed_cells(lines, wall(), CORNER, SHAPE, CELL)[0].any()
    near = LaserBeams(lines.origin, np.array([[10.0, -10.0, 2.0]]), 0.5)
    assert crossed_cells(near, wall(), CORNER, SHAPE, CELL)[0].sum() == 16  # a square of 1 m


def test_poses_come_by_time_and_none_is_made_up_in_gaps():
    time = np.array([0.0, 0.5, 1.0, 5.0, 5.5])
    drive = Trajectory(time, np.column_stack([10 * time, np.zeros(5), np.full(5, 2.0)]), np.zeros((5, 3)))
    asked = np.array([np.nan, -0.1, 0.25, 1.0, 3.0, 5.0, 5.25, 9.0])
    target = np.column_stack([asked, asked, asked])
    lines = laser_beams(target, asked, drive, 0.5)
    assert len(lines) == 4 and lines.origin[:, 0] == pytest.approx([2.5, 10.0, 50.0, 52.5])
    assert lines.target[:, 0] == pytest.approx([0.25, 1.0, 5.0, 5.25])


def test_shares_of_a_wall_add_up_and_through_counts_before_hidden():
    """Half of a wall is seen; of the rest a quarter by beams into the room, an overlapping half lies behind a hedge."""
    plane = wall()
    seen = shapely.box(0.0, 0.0, 10.0, 10.0)
    contour = Contour(seen, 100, 0.0, shapely.union(seen, shapely.box(19.99, 0.0, 20.0, 10.0)))
    assert contour.measured.bounds == (0.0, 0.0, 20.0, 10.0)

    def beams(left, right, depth):
        x, z = np.meshgrid(np.arange(left + 0.1, right, 0.2), np.arange(0.1, 10.0, 0.2))
        pane = np.column_stack([x.ravel(), np.zeros(x.size), z.ravel()])
        away = np.array([0.0, 1.0, 0.0])  # along the normal: no beam is spread
        return pane - 100.0 * away, pane + depth * away

    parts = [beams(10.0, 15.0, 3.0), beams(13.0, 18.0, -2.0)]
    lines = LaserBeams(*(np.concatenate(columns) for columns in zip(*parts)), 0.2)
    shares = wall_coverage(plane, [contour], 0.0, 10.0, np.zeros((0, 3)), lines)
    assert shares.coverage == pytest.approx(0.5, abs=0.02)
    assert shares.through == pytest.approx(0.25, abs=0.02) and shares.hidden == pytest.approx(0.15, abs=0.02)
    assert shares.coverage + shares.hidden + shares.unseen + shares.through == pytest.approx(1.0)


def facts(east, up, first=0.0):
    """Of a street measured from x = 0 to 50 m in five seconds, by a trajectory off by `east`, `up` (m) and in time."""
    time = np.linspace(0.0, 5.0, 101)
    places = np.column_stack([10 * time, np.full(101, 4.0), np.zeros(101)])
    drive = Trajectory(time + first, places + np.array([east, -4.0, 2.0 + up]), np.zeros((101, 3)))
    points = FacadePoints(places, time, places, time, np.zeros(3), np.zeros(2))
    return BeamFacts.of(laser_beams(places, time, drive, 0.5), points), drive


def test_a_trajectory_that_is_not_that_of_the_points_is_refused_or_told():
    warned = []
    progress = Progress(warn=warned.append)
    good, drive = facts(0.0, 0.0)
    assert (good.places, good.known) == (101, 101) and good.height == pytest.approx(2.0)
    assert good.distance == pytest.approx(np.hypot(4.0, 2.0))
    check_beams([good], drive, progress)
    assert not warned
    with pytest.raises(InputError, match="coordinate reference system"):
        check_beams([facts(400_000.0, 0.0)[0]], drive, progress)
    with pytest.raises(InputError, match="no point near a building"):
        check_beams([facts(0.0, 0.0, 1000.0)[0]], drive, progress)
    check_beams([facts(0.0, 37.0)[0]], drive, progress)
    check_beams([good, facts(0.0, 0.0, 2.0)[0]], drive, progress)
    assert len(warned) == 2 and "39 m above" in warned[0] and "1 buildings" in warned[1]


@pytest.mark.parametrize("east, late, words", [
    (0.0, 1e6, "1000000 to 1000005 s, but the points were measured from"),
    (400_000.0, 0.0, r"3999\d\d m from what was measured at its times"),
])
def test_a_wrong_trajectory_is_refused_before_the_points_are_read(tmp_path, monkeypatch, east, late, words):
    monkeypatch.setattr(wall_stage, "facade_points", lambda *_: pytest.fail("the points were read"))
    time = np.linspace(0.0, 5.0, 101)
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales = np.full(3, 0.001)
    las = laspy.LasData(header)
    las.x, las.y, las.z, las.gps_time = 10 * time, np.full(101, 4.0), np.zeros(101), time
    las.write(tmp_path / "street.laz")
    las.gps_time = time + 50.0
    las.write(tmp_path / "later.laz")
    drive = Trajectory(time + late, np.column_stack([10 * time + east, np.zeros(101), np.full(101, 2.0)]),
                       np.zeros((101, 3)))
    plans = building_plans([shapely.box(0.0, 4.0, 50.0, 14.0)], [1])
    cloud = open_cloud([tmp_path / "street.laz", tmp_path / "later.laz"])
    with pytest.raises(InputError, match=words):
        wall_stage.find_walls(cloud, plans, trajectory=drive)


def test_the_trajectory_of_one_file_of_several_is_taken(tmp_path):
    time = np.linspace(0.0, 5.0, 101)
    las = laspy.LasData(laspy.LasHeader(version="1.4", point_format=6))
    las.x, las.y, las.z = 10 * time, np.full(101, 4.0), np.zeros(101)
    paths = [tmp_path / f"{number}.las" for number in range(30)]
    for number, path in enumerate(paths):
        las.gps_time = time + 100.0 * number
        las.write(path)
    places = np.column_stack([10 * time, np.zeros(101), np.full(101, 2.0)])
    check_start(open_cloud(paths), Trajectory(time + 2900.0, places, np.zeros((101, 3))))
    with pytest.raises(InputError, match="give the trajectory of this survey"):
        check_start(open_cloud(paths), Trajectory(time + 2910.0, places, np.zeros((101, 3))))
