"""Boresights of simulated scanners in a street with walls, against the angles that were put in."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError, InsufficientDataError
from urbanmap_qgis.mobile.boresight.stage import calibrate_scanners
from urbanmap_qgis.mobile.calibration import Calibration, MountedScanner
from urbanmap_qgis.mobile.trajectory import Trajectory, body_to_map, interpolate, rotations
from urbanmap_qgis.settings.lines import BoresightSettings

ARM = np.array([0.9, 0.1, -0.3])
SCANNERS = (MountedScanner("a", ARM, np.array([0.0, -25.0, 0.0]), 1), MountedScanner("b", ARM * [1, -1, 1],
                                                                                     np.array([0.0, 25.0, 0.0]), 2))
TRUE = np.array([0.15, -0.2, 0.25])
"""Degrees about the body's axes by which scanner b really sits."""


def drive(heading: float, start: float) -> Trajectory:
    """80 m of street at 8 m/s, north or south, with a slight bend."""
    time = start + np.arange(0.0, 10.01, 0.05)
    along = 8.0 * (time - start) - 40.0
    sign = 1.0 if heading == 0 else -1.0
    place = np.column_stack([np.full(len(time), 1000.0 + sign * -2.0), 2000.0 + sign * along, np.full(len(time), 52.0)])
    return Trajectory(time, place, np.column_stack([np.zeros((len(time), 2)), np.full(len(time), heading)]))


def hits(trajectory: Trajectory, scanner: MountedScanner, rotation: np.ndarray, seed: int):
    """Points (n, 3), times (n,), rays in the body (n, 3) and ranges (n,) of a scanner that sits as `rotation` says."""
    random = np.random.default_rng(seed)
    time = np.sort(random.uniform(trajectory.time[0], trajectory.time[-1], 200_000))
    angle = random.uniform(0, 2 * np.pi, len(time))
    line = np.column_stack([np.zeros(len(time)), np.cos(angle), np.sin(angle)])
    pitch = np.radians(scanner.angles[1])
    turn = np.array([[np.cos(pitch), 0, np.sin(pitch)], [0, 1, 0], [-np.sin(pitch), 0, np.cos(pitch)]])
    body = line @ (rotation @ turn).T
    pose = interpolate(trajectory, time)
    origin = body_to_map(trajectory, time, scanner.lever_arm)
    ray = np.einsum("nij,nj->ni", rotations(pose.angles), body)
    distance = first_hits(origin, ray)
    near = distance < 40.0
    points = origin + (distance + random.normal(0, 0.01, len(time)))[:, None] * ray
    return points[near], time[near], body[near], distance[near]


def first_hits(origin: np.ndarray, ray: np.ndarray) -> np.ndarray:
    """Distances (n,) to a road at 50 m, walls 8 m to either side, and piers 1.5 m deep every 10 m of both walls."""
    distance = np.full(len(ray), np.inf)
    def everywhere(x, y):
        return np.ones(len(x), bool)

    def before_piers(x, y):
        return np.abs(y) <= 1.0

    def beside_piers(x, y):
        return np.abs(x) > 6.5

    planes = [(2, 50.0, everywhere)]
    planes += [(0, 1000.0 + side * 8.0, everywhere) for side in (-1, 1)]
    planes += [(0, 1000.0 + side * 6.5, before_piers) for side in (-1, 1)]
    planes += [(1, 2000.0 + 10.0 * k + side, beside_piers) for k in range(-6, 7) for side in (-1.0, 1.0)]
    for axis, offset, there in planes:
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (offset - origin[:, axis]) / ray[:, axis]
        x, y = ((origin + t[:, None] * ray)[:, :2] - [1000.0, 2000.0]).T
        here = there(x, np.mod(y + 5.0, 10.0) - 5.0)
        distance = np.where((t > 0.5) & (t < distance) & here, t, distance)
    return distance


def rotation_of(degrees: np.ndarray) -> np.ndarray:
    """Rotation of the body by a small vector of angles about its axes."""
    x, y, z = np.radians(degrees)
    return np.eye(3) + np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


@pytest.fixture(scope="module")
def street(make_cloud, tmp_path_factory):
    """Files of two passes in opposite directions, placed with the nominal calibration while scanner b is off."""
    folder = tmp_path_factory.mktemp("street")
    trajectories, files = [drive(0.0, 100.0), drive(180.0, 500.0)], []
    for number, trajectory in enumerate(trajectories):
        parts = []
        for k, scanner in enumerate(SCANNERS):
            off = rotation_of(TRUE) if k else np.eye(3)
            _, time, body, distance = hits(trajectory, scanner, off, 10 * number + k)
            pose = interpolate(trajectory, time)
            nominal = np.einsum("ij,nj->ni", off.T, body) * distance[:, None] + scanner.lever_arm
            placed = pose.place + np.einsum("nij,nj->ni", rotations(pose.angles), nominal)
            parts.append((placed, time, np.full(len(time), scanner.point_source_id)))
        placed, time, source = (np.concatenate(values) for values in zip(*parts))
        files.append([make_cloud(folder / f"pass{number}.laz", *placed.T, gps_time=time, point_source_id=source)])
    return files, trajectories


@pytest.mark.slow
def test_the_difference_of_two_scanners_is_found(street):
    files, trajectories = street
    found = calibrate_scanners(files, trajectories, Calibration(SCANNERS)).boresights
    difference = (found.value[1, 3:] - found.value[0, 3:])[[0, 2]]
    assert difference == pytest.approx(TRUE[[0, 2]], abs=0.03)
    assert found.rms_after < 0.5 * found.rms_before


@pytest.mark.slow
def test_values_lie_within_their_standard_deviations(street):
    files, trajectories = street
    made = calibrate_scanners(files, trajectories, Calibration(SCANNERS))
    found, true = made.boresights, np.zeros((2, 6))
    true[1, 3:] = TRUE
    assert (np.abs(found.value - true) < 3.0 * found.sigma)[found.determined].all()
    assert found.determined[:, 3].all()
    assert made.calibration.scanners[1].angles[0] == pytest.approx(found.value[1, 3], abs=0.1)


@pytest.mark.slow
def test_a_flat_street_between_walls_along_it_does_not_determine_the_pitch(street):
    files, trajectories = street
    found = calibrate_scanners(files, trajectories, Calibration(SCANNERS)).boresights
    assert not found.determined[:, 4].any() and (found.sigma[:, 4] > 0.3).all()


def test_one_pass_leaves_the_common_rotation_undetermined(street):
    files, trajectories = street
    found = calibrate_scanners(files[:1], trajectories[:1], Calibration(SCANNERS)).boresights
    assert not found.determined[:, 3:].any()


def test_one_scanner_in_one_pass_is_refused(street):
    files, trajectories = street
    both = replace(SCANNERS[0], point_source_id=None)
    with pytest.raises(InsufficientDataError, match="Only 0 planes"):
        calibrate_scanners(files[:1], trajectories[:1], Calibration((both,)))


@pytest.mark.slow
def test_passes_that_only_seem_apart_are_held_together(street):
    """Loose courses soak up some of what scanner b is off by: held tightly they fit as well."""
    files, trajectories = street
    loose = calibrate_scanners(files, trajectories, Calibration(SCANNERS)).boresights
    limit = 0.9 * loose.place_rms
    held = calibrate_scanners(files, trajectories, Calibration(SCANNERS), BoresightSettings(max_apart=limit)).boresights
    assert held.place_rms < limit < loose.place_rms
    assert held.value[1, [3, 5]] == pytest.approx(TRUE[[0, 2]], abs=0.03)


@pytest.mark.slow
def test_passes_that_lie_apart_are_refused(street, make_cloud, tmp_path):
    import laspy

    files, (first, second) = street
    cloud = laspy.read(files[1][0])
    moved = make_cloud(tmp_path / "moved.laz", np.array(cloud.x), np.array(cloud.y), np.array(cloud.z) + 1.0,
                       gps_time=np.array(cloud.gps_time), point_source_id=np.array(cloud.point_source_id))
    lifted = Trajectory(second.time, second.place + np.array([0.0, 0.0, 1.0]), second.angles)
    with pytest.raises(InputError, match="m apart"):
        calibrate_scanners([files[0], [moved]], [first, lifted], Calibration(SCANNERS))
