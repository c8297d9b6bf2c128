"""Tie points proposed from corners: blocks along a street whose survey is shifted, with clutter."""

import numpy as np
import pytest
import shapely

from urbanmap_qgis.errors import Cancelled, InsufficientDataError
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.lines.reference_corners import outline_corners
from urbanmap_qgis.mobile.lines.tie_point_proposals import propose_tie_points, wall_cells
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.progress import Progress

X0, Y0 = -7000.0, -34000.0
BLOCKS = [shapely.box(X0 + side, Y0 + 12 + 28 * k + 3 * (side < 0), X0 + side + 14, Y0 + 30 + 28 * k + 3 * (side < 0))
          for k in range(6) for side in (-24.0, 9.0)]


def drive():
    """North at 6 m/s."""
    time = np.arange(0.0, 32.0, 0.1)
    place = np.column_stack([X0 + 0 * time, Y0 + 6 * time, 12 + 0 * time])
    return Trajectory(time, place, np.zeros((len(time), 3)))


def walls(shift, rng, noise=0.02):
    """Points (n, 3) and times (n,) of the walls of the blocks that can be seen from the street, and of clutter."""
    points, times = [], []
    for block in BLOCKS:
        ring = shapely.get_coordinates(shapely.normalize(block).exterior)
        for start, end in zip(ring[:-1], ring[1:]):
            middle = (start + end) / 2
            length = np.hypot(*(end - start))
            # The far wall of a block is not seen; of a side wall the first eight metres.
            if abs(middle[0] - X0) > 20:
                continue
            along = np.arange(0.1, length, 0.35)
            plan = start + along[:, None] / length * (end - start)
            plan = plan[np.abs(plan[:, 0] - X0) < 17]
            heights = np.arange(10.5, 18, 0.25)
            points.append(np.column_stack([np.repeat(plan, len(heights), axis=0), np.tile(heights, len(plan))]))
            times.append(np.repeat((plan[:, 1] - Y0) / 6.0, len(heights)))
    low, high = [X0 - 25, Y0, 10], [X0 + 25, Y0 + 190, 17]
    clutter = rng.uniform(low, high, (3000, 3))
    poles = np.repeat(np.column_stack([X0 + rng.uniform(-8, 8, 25), Y0 + rng.uniform(0, 190, 25)]), 20, axis=0)
    poles = np.column_stack([poles, rng.uniform(10, 16, len(poles))])
    for more in (clutter, poles):
        points.append(more)
        times.append((more[:, 1] - Y0) / 6.0)
    points, times = np.concatenate(points), np.clip(np.concatenate(times), 0.0, 31.0)
    return points + rng.normal(0, noise, points.shape) + [*shift, 0.0], times


@pytest.fixture
def cloud(make_cloud, tmp_path):
    def made(shift=(1.1, -0.7), keep=None):
        points, times = walls(shift, np.random.default_rng(0))
        some = slice(None) if keep is None else keep(points)
        path = make_cloud(tmp_path / "s.laz", *points[some].T, gps_time=times[some])
        return open_cloud([path])
    return made


def test_corners_are_those_between_long_edges_of_blocks():
    corners = outline_corners([shapely.box(0, 0, 10, 10), shapely.box(10.01, 0, 20, 10), None,
                               shapely.box(50, 0, 52, 9), shapely.Point(70, 0).buffer(8)])
    np.testing.assert_allclose(sorted(map(tuple, np.round(corners.place, 1))), [(0, 0), (0, 10), (20, 0), (20, 10)])
    assert np.all(corners.length > 9)
    first = corners.place[:, 0] == corners.place[:, 0].min()
    assert np.all((corners.edge[first] @ [1.0, 0.0]).max(axis=1) > 0.99)


def test_corners_are_found_where_the_survey_shows_them(cloud):
    made = propose_tie_points(cloud(), drive(), outline_corners(BLOCKS))
    shift = made.ties.measured - made.ties.reference
    assert made.found >= 10 and len(made.ties) >= 8 and made.corners == 48
    np.testing.assert_allclose(np.median(shift, axis=0), [1.1, -0.7], atol=0.03)
    assert np.abs(shift - [1.1, -0.7]).max() < 0.15
    real = np.unique(np.concatenate([shapely.get_coordinates(block) for block in BLOCKS]), axis=0)
    assert np.abs(made.ties.reference[:, None] - real).sum(axis=2).min(axis=1).max() < 1e-6
    np.testing.assert_allclose(made.ties.time, (made.ties.reference[:, 1] - Y0) / 6.0, atol=1.0)
    assert np.all(made.support >= 2) and np.all(made.fit < 0.1)


def test_sets_are_two_near_in_time_and_apart_in_place(cloud):
    ties = propose_tie_points(cloud(), drive(), outline_corners(BLOCKS)).ties
    names, number = ties.numbers()
    assert np.all(np.bincount(number) == 2) and len(set(names)) == len(names)
    for k in range(len(names)):
        own = number == k
        assert np.ptp(ties.time[own]) <= 4.0
        seen = ties.measured[own] - np.column_stack([0 * ties.time[own] + X0, Y0 + 6 * ties.time[own]])
        assert np.hypot(*(seen[1] - seen[0])) >= 4.0


def test_times_may_be_counted_otherwise(cloud):
    plain = propose_tie_points(cloud(), drive(), outline_corners(BLOCKS))
    later = Trajectory(drive().time + 604800.0, drive().place, drive().angles)
    shifted = propose_tie_points(cloud(), later, outline_corners(BLOCKS), shift=604800.0)
    np.testing.assert_allclose(shifted.ties.time, plain.ties.time + 604800.0)


def test_walls_are_where_points_stand_over_each_other(cloud):
    cells = wall_cells(cloud(shift=(0.0, 0.0)), drive(), 40.0)
    lines = shapely.union_all([block.exterior for block in BLOCKS])
    away = shapely.distance(shapely.points(cells.place), lines)
    assert np.mean(away < 0.2) > 0.95 and len(cells.place) > 500


def test_what_cannot_be_found_is_said(cloud):
    with pytest.raises(InsufficientDataError, match="No corner of a building lies within 30 m"):
        propose_tie_points(cloud(), drive(), outline_corners([shapely.box(0, 0, 10, 10)]))
    with pytest.raises(InsufficientDataError, match="No corner"):
        propose_tie_points(cloud(), drive(), outline_corners([None]))
    with pytest.raises(InsufficientDataError, match="by hand"):
        propose_tie_points(cloud(shift=(9.0, 9.0)), drive(), outline_corners(BLOCKS))
    with pytest.raises(InsufficientDataError, match="no walls"):
        propose_tie_points(cloud(keep=lambda points: np.arange(len(points)) % 97 == 0), drive(),
                           outline_corners(BLOCKS))
    late = Trajectory(drive().time + 1e4, drive().place, drive().angles)
    with pytest.raises(InsufficientDataError, match="trajectory's time"):
        propose_tie_points(cloud(), late, outline_corners(BLOCKS))
    with pytest.raises(Cancelled):
        propose_tie_points(cloud(), drive(), outline_corners(BLOCKS), progress=Progress(cancelled=lambda: True))
