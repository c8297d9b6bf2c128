"""Mobile surveys of the sample city against formulas written here anew."""

import csv
import json

import laspy
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity.drive import mms
from urbanmap_qgis.samplecity.drive.motion import survey_drive
from urbanmap_qgis.samplecity.drive.navigation_error import reported_trajectory
from urbanmap_qgis.samplecity.drive.scanner import simulate_scans, spot_reflectance
from urbanmap_qgis.samplecity.drive.trajectory import SimulatedTrajectory, body_to_world
from urbanmap_qgis.samplecity.laser.raycast import RayCaster
from urbanmap_qgis.samplecity.scene.model import REFLECTANCE, FaceKind, Material
from urbanmap_qgis.samplecity.scene.world import make_scene

START = 361400.0
TO_EAST_NORTH_UP = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1.0]])


def rotations(angles):
    """Body to east, north, up by scipy: intrinsic heading, pitch, roll in north, east, down."""
    north_east_down = Rotation.from_euler("ZYX", np.atleast_2d(angles)[:, ::-1], degrees=True).as_matrix()
    return TO_EAST_NORTH_UP @ north_east_down


def pose(trajectory, time):
    """Place and rotation at times, linear between epochs, by this test's own formula."""
    columns = np.column_stack([trajectory.place, trajectory.angles])
    first = np.clip(np.searchsorted(trajectory.time, time, side="right") - 1, 0, len(trajectory.time) - 2)
    share = (time - trajectory.time[first]) / (trajectory.time[first + 1] - trajectory.time[first])
    at = columns[first] + share[:, None] * (columns[first + 1] - columns[first])
    return at[:, :3], rotations(at[:, 3:])


def cut(trajectory, way, seconds):
    """The epochs of some seconds after the vehicle has driven `way` m."""
    start = trajectory.time[np.searchsorted(trajectory.chainage(), way)]
    keep = (trajectory.time >= start) & (trajectory.time <= start + seconds)
    return SimulatedTrajectory(trajectory.time[keep], trajectory.place[keep], trajectory.angles[keep])


@pytest.fixture(scope="module")
def scene():
    return make_scene(60.0, "canyon", 3)


@pytest.fixture(scope="module")
def true(scene):
    return survey_drive(scene, 0, START, np.random.default_rng(1))


@pytest.fixture(scope="module")
def stretch(scene, true):
    """Two seconds of the drive through the crossing: true and reported trajectory, what each scanner measured."""
    part = cut(true, 22.0, 2.0)
    reported = reported_trajectory(part, np.random.default_rng(2))
    caster = RayCaster(scene, "ground")
    returns = [simulate_scans(scene, caster, scanner, mms.recorded_scans(part, scanner), part, np.random.default_rng(4))
               for scanner in mms.SCANNERS]
    return part, reported, returns


def beams(trajectory, scanner, returns):
    """Origin and direction of each return's beam by this test's own formula (design, file formats)."""
    place, rotation = pose(trajectory, returns.time)
    mount = Rotation.from_euler("ZYX", [scanner.heading, scanner.pitch, scanner.roll], degrees=True).as_matrix()
    angle = np.radians(-90.0 + returns.beam * 180.0 / 360.0)
    beam = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(len(angle))]) @ mount.T
    return place + rotation @ np.array(scanner.lever_arm), np.einsum("nij,nj->ni", rotation, beam)


def test_body_turns_as_stated():
    angles = np.random.default_rng(0).uniform(-180, 180, (50, 3))
    np.testing.assert_allclose(body_to_world(angles), rotations(angles), atol=1e-12)
    nose_up = body_to_world(np.array([[0.0, 10.0, 90.0]]))[0] @ [1, 0, 0]
    np.testing.assert_allclose(nose_up, [np.cos(np.radians(10)), 0, np.sin(np.radians(10))], atol=1e-12)
    right_down = body_to_world(np.array([[5.0, 0.0, 0.0]]))[0] @ [0, 1, 0]
    assert right_down[0] > 0.9 and right_down[2] < 0


def test_ground_points_lie_on_the_true_ground(scene, stretch):
    part, _, returns = stretch
    origin, direction = beams(part, mms.SCANNERS[0], returns[0])
    point = origin + returns[0].distance[:, None] * direction
    x, y, z = point.T
    smooth = returns[0].ground & (np.abs(scene.ground.kerb_distance(x, y)) > 0.4)
    assert smooth.sum() > 20000
    # The error lies along the beam; on ground that slopes little its share of height is the beam's fall.
    noise = (z - scene.ground_height(x, y))[smooth] / -direction[smooth, 2]
    near = returns[0].distance[smooth] < 20
    assert np.std(noise[near]) == pytest.approx(0.01, rel=0.15)
    assert abs(np.mean(noise[near])) < 0.001
    assert np.abs(z - scene.ground_height(x, y))[smooth].max() < 0.06


def test_ranges_to_walls_are_true_but_for_the_noise(scene, stretch):
    part, _, returns = stretch
    faces = scene.static_faces("ground")
    walls = np.flatnonzero(faces.kind == FaceKind.WALL)
    for scanner, found in zip(mms.SCANNERS, returns):
        origin, direction = beams(part, scanner, found)
        facade = np.isin(found.material, [Material.FACADE, Material.GLASS]) & ~found.ground
        origin, direction, measured = (a[facade][::7] for a in (origin, direction, found.distance))
        with np.errstate(divide="ignore"):
            exact = (faces.offset[walls] - origin @ faces.normal[walls].T) / (direction @ faces.normal[walls].T)
        error = measured[:, None] - exact
        nearest = np.abs(error).argmin(axis=1)
        error = error[np.arange(len(error)), nearest]
        assert len(error) > 300
        assert np.abs(error).max() < 0.06
        assert np.std(error) == pytest.approx(0.01, rel=0.15)


def test_points_are_moved_by_reported_times_inverse_of_true(scene, stretch):
    part, reported, returns = stretch
    scanner, found = mms.SCANNERS[1], returns[1]
    on_true = scanner.placed(part, found.time, found.beam, found.distance)
    on_reported = scanner.placed(reported, found.time, found.beam, found.distance)
    place_true, turn_true = pose(part, found.time)
    place_reported, turn_reported = pose(reported, found.time)
    body = np.einsum("nji,nj->ni", turn_true, on_true - place_true)
    np.testing.assert_allclose(on_reported, place_reported + np.einsum("nij,nj->ni", turn_reported, body), atol=1e-6)
    assert np.linalg.norm(on_reported - on_true, axis=1).mean() > 0.5


@pytest.mark.parametrize("material", [Material.ASPHALT, Material.PAVEMENT])
def test_intensity_follows_the_stated_law(scene, stretch, material):
    part, _, returns = stretch
    found, scanner = returns[0], mms.SCANNERS[0]
    origin, direction = beams(part, scanner, found)
    x, y, _ = (origin + found.distance[:, None] * direction).T
    same = (found.material == material) & (np.abs(scene.ground.kerb_distance(x, y)) > 0.2)
    x, y, direction, distance = x[same], y[same], direction[same], found.distance[same]
    east, north = ((scene.ground_height(x + dx, y + dy) - scene.ground_height(x - dx, y - dy)) / 0.02
                   for dx, dy in ((0.01, 0.0), (0.0, 0.01)))
    cosine = (direction[:, 0] * east + direction[:, 1] * north - direction[:, 2]) / np.sqrt(1 + east**2 + north**2)
    law = scanner.response
    stated = law.gain * REFLECTANCE[material] * cosine**law.tilt / distance**law.fall + law.floor
    rings = [(distance >= low) & (distance < high) for low, high in ((5, 7), (7, 10), (10, 13), (13, 17), (17, 22))]
    rings = [ring for ring in rings if ring.sum() > 100]
    assert len(rings) >= 3
    for ring in rings:
        # A few spots lie half on paint: the median does not mind.
        assert np.median(found.intensity[same][ring] / stated[ring]) == pytest.approx(1.0, abs=0.03)


def test_spots_on_edges_of_paint_are_mixed(scene):
    """Across a stripe the reflectance goes from that of asphalt to that of paint within the width of the spot."""
    stripe = max((m for m in scene.markings_at("ground") if m.kind == "edge" and m.colour == "white"),
                 key=lambda m: m.plan.length)
    corners = np.array(stripe.plan.exterior.coords)[:-1]
    sides = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    a, b = corners[sides.argmax()], np.roll(corners, -1, axis=0)[sides.argmax()]
    along = (b - a) / np.linalg.norm(b - a)
    inward = np.array([stripe.plan.centroid.x, stripe.plan.centroid.y]) - a
    inward -= (inward @ along) * along
    inward /= np.linalg.norm(inward)
    shares = []
    for into in (-0.30, 0.0, 0.075):
        xy = a + along * np.linspace(1, np.linalg.norm(b - a) - 1, 400)[:, None] + into * inward
        point = np.column_stack([xy, np.zeros(400)])
        material = scene.ground_material(*xy.T, "ground")
        beam = np.tile([*inward * 0.8, -0.6], (400, 1))
        shares.append(spot_reflectance(scene, material, point, beam, np.full(400, 8.0), np.full(400, 0.6)).mean())
    bare, edge, middle = shares
    assert bare == pytest.approx(REFLECTANCE[Material.ASPHALT], rel=0.05)
    assert bare < edge < middle
    assert edge == pytest.approx((bare + middle) / 2, rel=0.25)


def test_scanners_fall_off_differently():
    distance = np.array([5.0, 40.0])
    down, up = (s.response.signal(np.full(2, 0.3), distance, np.ones(2)) for s in mms.SCANNERS)
    assert down[0] / down[1] < 0.8 * up[0] / up[1]


@pytest.mark.parametrize("seed", range(8))
def test_navigation_error_has_the_stated_size_and_pace(true, seed):
    reported = reported_trajectory(true, np.random.default_rng(seed))
    error = reported.place - true.place
    plan = np.hypot(error[:, 0], error[:, 1])
    assert 0.75 < plan.mean() < 1.11 and plan.max() <= 2.001
    assert np.abs(error[:, 2]).mean() > 0.1 and np.abs(error[:, 2]).max() <= 1.001
    turn = np.abs(reported.angles - true.angles).max(axis=0)
    assert turn[0] < 0.025 and turn[1] < 0.025 and turn[2] < 0.05
    second = np.linalg.norm(error[100:] - error[:-100], axis=1)
    assert second.max() < 0.3
    speed = np.gradient(true.chainage(), true.time)
    waiting = error[speed < 0.01]
    assert np.ptp(waiting, axis=0).max() > 0.01


def test_drive_is_smooth_and_keeps_to_the_road(scene):
    drives = [survey_drive(scene, number, START, np.random.default_rng(number)) for number in (0, 1)]
    for true in drives:
        x, y, z = true.place.T
        assert scene.ground.kerb_distance(x, y).max() < -0.9
        speed = np.gradient(true.chainage(), true.time)
        assert speed[0] > 2.0 and speed[-1] > 2.0 and speed.max() < 8.7
        assert (speed < 0.05).sum() > 600
        assert np.abs(np.gradient(speed, true.time)).max() < 2.5
        assert np.abs(z - scene.ground_height(x, y) - 1.95).max() < 0.06
        np.testing.assert_allclose(np.diff(true.time), 0.01, atol=1e-6)
        moving = speed[:-1] > 2.0
        course = np.degrees(np.arctan2(np.diff(x), np.diff(y)))
        off = (course - true.angles[:-1, 2] + 180.0) % 360.0 - 180.0
        assert np.abs(off[moving]).max() < 1.5
    turned = (drives[1].angles[0, 2] - drives[0].angles[-1, 2]) % 360.0
    assert turned == pytest.approx(180.0, abs=3.0)


@pytest.fixture
def short(monkeypatch):
    """Surveys of less than a second each."""
    monkeypatch.setattr(mms, "survey_drive", lambda *arguments: cut(survey_drive(*arguments), 22.0, 0.8))


def test_files_keep_the_formats(scene, short, tmp_path):
    summary = mms.write_mms(scene, tmp_path, np.random.SeedSequence(7), SILENT)
    calibration = json.loads((tmp_path / "mms" / "calibration.json").read_text())
    assert [s["point_source_id"] for s in calibration["scanners"]] == [1, 2]
    assert calibration["scanners"][0]["pitch"] == pytest.approx(-25, abs=0.5)
    assert calibration["scanners"][1]["pitch"] == pytest.approx(25, abs=0.5)
    for name in ("survey_01", "survey_02"):
        cloud = laspy.read(tmp_path / "mms" / f"{name}.laz")
        labels = np.load(tmp_path / "truth" / f"{name}_labels.npz")
        assert len(cloud) == len(labels["ground"]) == len(labels["material"]) == summary[name]["points"]
        assert cloud.header.point_format.id == 6
        assert "6677" in cloud.header.vlrs[0].string or "Plane Rectangular CS IX" in cloud.header.vlrs[0].string
        assert np.all(np.diff(cloud.gps_time) >= -0.03)
        for folder in ("mms", "truth"):
            table = np.genfromtxt(tmp_path / folder / f"{name}_trajectory.csv", delimiter=",", names=True)
            assert table.dtype.names == ("time", "x", "y", "z", "roll", "pitch", "heading")
            assert table["time"][0] <= cloud.gps_time.min() and cloud.gps_time.max() <= table["time"][-1]
        assert (tmp_path / "mms" / f"{name}_images.csv").read_text().startswith("id,time,x,y,z,roll,pitch,heading\n")


def test_control_points_fit_both_trajectories(scene, true, tmp_path):
    part = cut(true, 16.0, 8.0)
    reported = reported_trajectory(part, np.random.default_rng(2))
    corners = mms.marking_corners(scene)
    sightings = mms.visible_corners(RayCaster(scene, "ground"), corners, part)
    path = tmp_path / "control.csv"
    count = mms.write_control(path, corners, sightings, part, reported)
    with path.open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == count > 8
    place, shown = (np.array([[float(row[axis + end]) for axis in "xyz"] for row in rows]) for end in ("", "_mms"))
    time = np.array([float(row["time"]) for row in rows])
    (p, r), (q, s) = pose(part, time), pose(reported, time)
    body = np.einsum("nji,nj->ni", r, place - p)
    np.testing.assert_allclose(shown, q + np.einsum("nij,nj->ni", s, body), atol=3e-4)
    np.testing.assert_allclose(place[:, 2], scene.ground_height(place[:, 0], place[:, 1]), atol=1e-4)
    scanner = mms.SCANNERS[0]
    mount = Rotation.from_euler("ZYX", [scanner.heading, scanner.pitch, scanner.roll], degrees=True)
    in_scanner = mount.inv().apply(body - scanner.lever_arm)
    assert np.abs(in_scanner[:, 2]).max() < 1e-3 and in_scanner[:, 0].min() > 0
    vertices = np.concatenate([np.array(m.plan.exterior.coords) for m in scene.markings_at("ground")])
    gaps = np.hypot(*(place[:, None, :2] - vertices[None]).transpose(2, 0, 1)).min(axis=1)
    assert gaps.max() < 1e-3
