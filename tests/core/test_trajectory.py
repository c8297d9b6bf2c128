"""Trajectory: poses between epochs, turns against matrices written anew, way driven, gaps and jumps."""

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.trajectory import (
    Trajectory,
    attitude_angles,
    body_to_map,
    gaps,
    interpolate,
    jumps,
    move_points,
    path_chainage,
    rotations,
)


def straight(speed=10.0, seconds=10.0, rate=10.0):
    time = 100.0 + np.arange(int(seconds * rate) + 1) / rate
    place = np.column_stack([speed * (time - 100.0), np.zeros(len(time)), np.full(len(time), 5.0)])
    return Trajectory(time, place, np.tile([0.0, 0.0, 90.0], (len(time), 1)))


def matrix(roll, pitch, heading):
    """Rz(heading) Ry(pitch) Rx(roll) in north, east, down, then as east, north, up."""
    r, p, h = np.radians([roll, pitch, heading])
    about_x = np.array([[1, 0, 0], [0, np.cos(r), -np.sin(r)], [0, np.sin(r), np.cos(r)]])
    about_y = np.array([[np.cos(p), 0, np.sin(p)], [0, 1, 0], [-np.sin(p), 0, np.cos(p)]])
    about_z = np.array([[np.cos(h), -np.sin(h), 0], [np.sin(h), np.cos(h), 0], [0, 0, 1]])
    return np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]]) @ about_z @ about_y @ about_x


def test_axes_of_the_body():
    level_east = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.tile([0.0, 0.0, 90.0], (2, 1)))
    ahead, right, down = body_to_map(level_east, np.full(3, 0.5), np.eye(3))
    assert np.allclose(ahead, [1, 0, 0])
    assert np.allclose(right, [0, -1, 0])
    assert np.allclose(down, [0, 0, -1])


def test_nose_up_and_right_side_down():
    up = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.tile([0.0, 10.0, 0.0], (2, 1)))
    assert body_to_map(up, np.array([0.5]), np.array([1.0, 0, 0]))[0, 2] > 0.17
    leaning = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.tile([10.0, 0.0, 0.0], (2, 1)))
    assert body_to_map(leaning, np.array([0.5]), np.array([0, 1.0, 0]))[0, 2] < -0.17


def test_turns_are_those_of_the_matrices():
    rng = np.random.default_rng(1)
    angles = rng.uniform([-60, -80, 0], [60, 80, 360], (50, 3))
    expected = np.array([matrix(*row) for row in angles])
    assert np.allclose(rotations(angles), expected, atol=1e-12)
    assert np.allclose(attitude_angles(expected), angles, atol=1e-9)
    body = rng.normal(size=(50, 3))
    still = [Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.tile(row, (2, 1))) for row in angles]
    turned = np.array([body_to_map(one, np.array([0.3]), b)[0] for one, b in zip(still, body)])
    assert np.allclose(turned, np.einsum("nij,nj->ni", expected, body), atol=1e-12)


def test_between_epochs_and_outside():
    drive = straight()
    pose = interpolate(drive, np.array([100.05, 109.99]))
    assert np.allclose(pose.place[:, 0], [0.5, 99.9])
    with pytest.raises(InputError, match=r"runs from 100.000 to 110.000 s, but a pose is needed at 111.000"):
        interpolate(drive, np.array([101.0, 111.0]))
    assert np.allclose(interpolate(drive, np.array([111.0]), "hold").place[0], [100.0, 0, 5])
    assert np.isnan(interpolate(drive, np.array([99.0]), "nan").place).all()


def test_heading_through_north_is_the_short_way():
    drive = Trajectory(np.array([0.0, 1.0]), np.zeros((2, 3)), np.array([[0, 0, 350.0], [0, 0, 370.0]]))
    assert interpolate(drive, np.array([0.5])).angles[0, 2] == pytest.approx(360.0)


def test_points_move_with_the_body():
    rng = np.random.default_rng(2)
    reported = straight()
    corrected = Trajectory(reported.time, reported.place + np.array([1.0, -2.0, 0.5]),
                           reported.angles + np.array([1.0, -0.5, 3.0]))
    time = rng.uniform(100.0, 110.0, 200)
    body = rng.normal(scale=10.0, size=(200, 3))
    moved = move_points(body_to_map(reported, time, body), time, reported, corrected)
    assert np.allclose(moved, body_to_map(corrected, time, body), atol=1e-9)
    back = move_points(moved, time, corrected, reported)
    assert np.allclose(back, body_to_map(reported, time, body), atol=1e-9)


def test_way_leaves_out_the_wander_of_a_standing_vehicle():
    rng = np.random.default_rng(3)
    drive, noise = straight(seconds=10.0), 0.003
    stand = np.tile(drive.place[-1], (600, 1)) + noise * rng.standard_normal((600, 3))
    time = np.concatenate([drive.time, drive.time[-1] + 0.1 * np.arange(1, 601)])
    waits = Trajectory(time, np.vstack([drive.place, stand]), np.tile(drive.angles[0], (len(time), 1)))
    assert path_chainage(waits)[-1] == pytest.approx(100.0, abs=0.3)
    assert (np.diff(path_chainage(waits)) >= 0).all()


def test_gaps_and_jumps_are_found():
    drive = straight()
    kept = np.r_[0:30, 55:len(drive)]
    holed = Trajectory(drive.time[kept], drive.place[kept], drive.angles[kept])
    assert np.allclose(gaps(holed), [[102.9, 105.5]])
    place = drive.place.copy()
    place[50:] += [0.0, 30.0, 0.0]
    assert np.allclose(jumps(Trajectory(drive.time, place, drive.angles)), [[104.9, 105.0]])
    assert len(gaps(drive)) == len(jumps(drive)) == 0


def test_rotations_do_not_depend_on_where_results_lie_in_memory():
    """numpy's sine of a column of a table differed in its last digit where the result came to lie just behind it."""
    rng = np.random.default_rng(5)
    angles = rng.normal(size=(237, 3)) * [1, 1, 100]
    kept, made = [], set()
    for _ in range(1500):
        kept.append(np.empty(int(rng.integers(1, 3000))))
        if len(kept) > 50:
            kept.pop(int(rng.integers(0, 50)))
        made.add(rotations(angles).tobytes())
    assert len(made) == 1
