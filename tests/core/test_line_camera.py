"""Line cameras: rays of pixels and places in strips against formulas and searches written here anew."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.mobile.calibration import MountedCamera
from urbanmap_qgis.mobile.lines.line_camera import LineCamera, StripImage, pixel_rays, project_to_strip
from urbanmap_qgis.mobile.trajectory import Trajectory

TO_MAP = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1.0]])
MOUNT = MountedCamera("1", np.array([-0.6, -0.5, -0.4]), np.array([1.0, -2.0, -85.0]))
CAMERA = LineCamera(MOUNT, 640, 270.0, 319.5)


def course(seconds=40.0, turn=0.0, speed=8.0, wobble=0.3, seed=0):
    """A drive at 100 Hz from (0, 0) to the north that turns by `turn` degrees in the middle, with wobbling angles."""
    time = np.arange(0.0, seconds, 0.01)
    heading = turn / (1 + np.exp(-(time - seconds / 2) / 0.8))
    step = 0.01 * speed * np.column_stack([np.sin(np.radians(heading)), np.cos(np.radians(heading))])
    place = np.column_stack([np.cumsum(step, axis=0), 20 + np.sin(time / 7)])
    phase = np.random.default_rng(seed).uniform(0, 6, 3)
    angles = wobble * np.sin(time[:, None] * [1.1, 0.9, 0.7] + phase)
    return Trajectory(time + 5000.0, place, angles + np.column_stack([0 * time, 0 * time, heading]))


def strip(seconds=40.0, hertz=50.0, camera=CAMERA):
    return StripImage(camera, 5000.0 + np.arange(0.0, seconds - 0.05, 1 / hertz))


def rotation(trajectory, time):
    angles = [np.interp(time, trajectory.time, trajectory.angles[:, k]) for k in (2, 1, 0)]
    return TO_MAP @ Rotation.from_euler("ZYX", np.column_stack(angles), degrees=True).as_matrix()


@pytest.mark.paper("Z 2.1, eq. 2, 3")
def test_rows_and_angles_follow_the_fish_eye_of_equation_2():
    rows = np.array([0.0, 100.5, 319.5, 639.0])
    angles = CAMERA.angles(rows)
    np.testing.assert_allclose(np.sin(angles / 2), (rows - 319.5) / 540.0, atol=1e-15)
    np.testing.assert_allclose(CAMERA.rows_of(angles), rows, atol=1e-10)
    assert angles[0] < 0 < angles[3] and angles[2] == 0
    assert CAMERA.sees(np.array([-0.6, -0.4, 639.4, 639.6])).tolist() == [False, True, True, False]
    assert LineCamera(MOUNT, 640, 270.0, 319.5, 50).sees(np.array([49.0, 49.6, 589.6])).tolist() == [False, True, False]


@pytest.mark.paper("Z 2.1, eq. 2, 3")
def test_rays_equal_equation_3_in_our_axes_and_in_the_paper_s():
    """Z: (0, -cos w, sin w) in axes x, y, z of the camera that are our y, -x and z; HISS is x forward, y left, z up."""
    trajectory, image = course(turn=80.0), strip()
    rng = np.random.default_rng(1)
    columns, rows = rng.uniform(0, image.columns - 1, 50), rng.uniform(0, 639, 50)
    origin, direction = pixel_rays(image, trajectory, columns, rows)
    time = image.times_of(columns)
    body = rotation(trajectory, time)
    place = np.column_stack([np.interp(time, trajectory.time, axis) for axis in trajectory.place.T])
    np.testing.assert_allclose(origin, place + body @ MOUNT.lever_arm, atol=1e-9)
    mount = Rotation.from_euler("ZYX", MOUNT.angles[::-1], degrees=True).as_matrix()
    w = 2 * np.arcsin((rows - 319.5) / 2 / 270)
    ours = np.column_stack([np.cos(w), 0 * w, np.sin(w)])
    np.testing.assert_allclose(direction, np.einsum("nij,nj->ni", body @ mount, ours), atol=1e-12)

    to_hiss = np.diag([1.0, -1.0, -1.0])
    paper_axes = np.array([[0, -1.0, 0], [1.0, 0, 0], [0, 0, 1.0]])
    t_ch = to_hiss @ mount @ paper_axes
    omega, psi, kappa = (np.interp(time, trajectory.time, trajectory.angles[:, k]) for k in range(3))
    paper = np.column_stack([0 * w, -np.cos(w), np.sin(w)])
    for k in range(len(w)):
        np.testing.assert_allclose(hiss_rotation(omega[k], psi[k], 90 - kappa[k]) @ t_ch @ paper[k], direction[k],
                                   atol=1e-12)


def hiss_rotation(omega, psi, kappa):
    """R_kappa R_psi R_omega as printed with Z eq. 4, degrees."""
    (so, sp, sk), (co, cp, ck) = np.sin(np.radians([omega, psi, kappa])), np.cos(np.radians([omega, psi, kappa]))
    return (np.array([[ck, -sk, 0], [sk, ck, 0], [0, 0, 1]]) @ np.array([[cp, 0, -sp], [0, 1, 0], [sp, 0, cp]])
            @ np.array([[1, 0, 0], [0, co, -so], [0, so, co]]))


@pytest.mark.parametrize(("turn", "hertz"), [(0.0, 50.0), (-90.0, 50.0), (100.0, 7.0)])
def test_places_are_found_where_their_ray_passed(turn, hertz):
    trajectory, image = course(turn=turn), strip(hertz=hertz)
    rng = np.random.default_rng(2)
    columns, rows = rng.uniform(1, image.columns - 2, 5000), rng.uniform(0, 639, 5000)
    origin, direction = pixel_rays(image, trajectory, columns, rows)
    distance = rng.uniform(2, 80, 5000)
    found = project_to_strip(origin + distance[:, None] * direction, image, trajectory, 120.0)
    error = np.hypot(found.column - columns[found.point_index], found.row - rows[found.point_index])
    best = np.full(5000, np.inf)
    np.minimum.at(best, found.point_index, error)
    # Where a turn brings the plane to a halt on a place, it touches without passing: the nearest column is given.
    assert np.mean(best < 1e-3) > (0.999 if turn == 0 else 0.99) and best.max() < 1.5
    assert (np.diff(found.point_index) >= 0).all()
    same = np.diff(found.point_index) == 0
    assert (np.diff(found.time)[same] > 0).all()
    start, ray = pixel_rays(image, trajectory, found.column, found.row)
    reached = start + found.distance[:, None] * ray
    np.testing.assert_allclose(reached, (origin + distance[:, None] * direction)[found.point_index], atol=3e-3)


def test_all_solutions_of_a_turn_are_those_of_a_dense_search():
    trajectory, image = course(turn=-90.0, wobble=0.0), strip()
    rng = np.random.default_rng(3)
    points = np.column_stack([rng.uniform(-90, 20, 400), rng.uniform(40, 260, 400), rng.uniform(15, 30, 400)])
    found = project_to_strip(points, image, trajectory, 60.0)
    time = np.linspace(image.times[0], image.times[-1], 20 * image.columns)
    body = rotation(trajectory, time)
    axes = body @ Rotation.from_euler("ZYX", MOUNT.angles[::-1], degrees=True).as_matrix()
    place = np.column_stack([np.interp(time, trajectory.time, axis) for axis in trajectory.place.T])
    place = place + body @ MOUNT.lever_arm
    count = np.bincount(found.point_index, minlength=400)
    several = 0
    for k, point in enumerate(points):
        local = np.einsum("nji,nj->ni", axes, point - place)
        turned = np.flatnonzero((local[:-1, 1] < 0) != (local[1:, 1] < 0))
        row = 319.5 + 540 * np.sin(np.arctan2(local[turned, 2], local[turned, 0]) / 2)
        near = np.linalg.norm(point - place[turned], axis=1)
        if np.any((np.abs(near - 60) < 0.5) | (np.abs(np.abs(row - 319.5) - 320) < 2)):
            continue
        expected = time[turned[(row > -0.5) & (row < 639.5) & (near < 60)]]
        if len(expected) > 1 and np.diff(expected).min() < 0.03:
            continue
        assert count[k] == len(expected)
        np.testing.assert_allclose(found.time[found.point_index == k], expected, atol=2e-3)
        several += len(expected) > 1
    assert several > 10


def test_straight_drive_is_exact():
    """North at 8 m/s, camera square to the left: the column is the northing, the row the angle."""
    trajectory = Trajectory(np.array([0.0, 100.0]), np.array([[0, 0, 10.0], [0, 800.0, 10.0]]), np.zeros((2, 3)))
    camera = LineCamera(MountedCamera("a", np.zeros(3), np.array([0, 0, -90.0])), 640, 270.0, 319.5)
    image = StripImage(camera, np.arange(0.0, 100.0, 0.5))
    found = project_to_strip([[-5.0, 123.4, 10.0], [-3.0, 400.0, 13.0], [4.0, 100.0, 10.0], [-5.0, 900.0, 10.0]], image,
                             trajectory, 50.0)
    assert found.point_index.tolist() == [0, 1]
    np.testing.assert_allclose(found.column, [123.4 / 4, 100.0], atol=1e-6)
    np.testing.assert_allclose(found.row, [319.5, 319.5 - 540 * np.sin(np.pi / 8)], atol=1e-6)
    np.testing.assert_allclose(found.distance, [5.0, np.sqrt(18.0)], atol=1e-6)


def test_a_standing_vehicle_shows_a_place_once():
    time = np.arange(0.0, 60.0, 0.01)
    way = np.interp(time, [0, 20, 40, 60], [0, 100.0, 100.0, 200.0])
    noise = np.random.default_rng(4).normal(0, 0.002, len(time))
    trajectory = Trajectory(time, np.column_stack([0 * time, way + noise, 0 * time]), np.zeros((len(time), 3)))
    mount = MountedCamera("a", np.zeros(3), np.array([0, 0, -90.0]))
    image = StripImage(LineCamera(mount, 640, 270.0, 319.5), time[::2])
    found = project_to_strip([[-6.0, 100.0, 1.0], [-6.0, 50.0, 1.0]], image, trajectory)
    assert len(found) <= 3 and np.count_nonzero(found.point_index == 1) == 1


def test_nothing_is_swept_over_a_gap_in_the_times():
    trajectory = course(wobble=0.0)
    times = np.concatenate([np.arange(0, 10, 0.02), np.arange(25, 39, 0.02)]) + 5000.0
    found = project_to_strip(np.column_stack([np.full(300, -5.0), np.linspace(5, 300, 300), np.full(300, 20.0)]),
                             StripImage(CAMERA, times), trajectory)
    assert len(found) > 100 and not np.any((found.time > 5010) & (found.time < 5025))


def test_strip_outside_the_trajectory_is_refused_and_partly_outside_is_used():
    trajectory = course()
    with pytest.raises(InputError, match="one survey"):
        project_to_strip([[0.0, 0.0, 0.0]], StripImage(CAMERA, np.arange(10.0)), trajectory)
    partly = StripImage(CAMERA, 4990.0 + np.arange(0, 40, 0.02))
    found = project_to_strip([[-5.0, 80.0, 20.0]], partly, trajectory)
    assert len(found) == 1 and found.column[0] == pytest.approx((found.time[0] - 4990.0) / 0.02)
    assert len(project_to_strip(np.empty((0, 3)), partly, trajectory)) == 0
    assert len(project_to_strip([[5000.0, 80.0, 20.0]], partly, trajectory)) == 0
