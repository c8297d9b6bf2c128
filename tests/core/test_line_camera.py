"""The line camera, its strips, the places on them, and ranges to scanners."""

from __future__ import annotations

import json
import sqlite3

import cv2
import numpy as np
import pytest
import shapely
from scipy.spatial.transform import Rotation

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.raster import RasterSampler
from urbanmap_qgis.mobile.calibration import Calibration, MountedCamera, MountedScanner, read_calibration
from urbanmap_qgis.mobile.lines.line_camera import LineCamera, StripImage, pixel_rays, project_to_strip
from urbanmap_qgis.mobile.lines.strip_images import read_columns, read_strips, sample_pixels
from urbanmap_qgis.mobile.markings.ranges import Tracks, ranges
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.mobile.trajectory_files import read_trajectory

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


ARM = np.array([0.9, -0.4, -0.6])


def turning(rate=20.0, epochs=10.0):
    """A trajectory on a circle, rolling and pitching."""
    time = np.arange(0.0, 20.0, 1 / epochs)
    heading = rate * time
    turn = np.radians(heading)
    place = np.column_stack([100 + 30 * np.sin(turn), 200 + 30 * np.cos(turn), 0.1 * time])
    return Trajectory(time, place, np.column_stack([3 * np.sin(time), 2 * np.cos(time), heading]))


def scanner_place(trajectory, time, arm):
    """p + R arm by rotation matrices written out one by one."""
    place = np.array([np.interp(time, trajectory.time, axis) for axis in trajectory.place.T])
    roll, pitch, heading = (np.radians(np.interp(time, trajectory.time, axis)) for axis in trajectory.angles.T)
    rx = np.array([[1, 0, 0], [0, np.cos(roll), -np.sin(roll)], [0, np.sin(roll), np.cos(roll)]])
    ry = np.array([[np.cos(pitch), 0, np.sin(pitch)], [0, 1, 0], [-np.sin(pitch), 0, np.cos(pitch)]])
    rz = np.array([[np.cos(heading), -np.sin(heading), 0], [np.sin(heading), np.cos(heading), 0], [0, 0, 1]])
    north, east, down = rz @ ry @ rx @ arm
    return place + np.array([east, north, -down])


def calibration(*numbers):
    return Calibration(tuple(MountedScanner(f"s{number}", ARM * (1 + i), np.zeros(3), number, 40.0)
                             for i, number in enumerate(numbers)))


@pytest.mark.parametrize("epochs", [1.0, 10.0, 100.0])
def test_range_is_the_distance_to_the_scanners_place(epochs):
    trajectory = turning(epochs=epochs)
    track = Tracks(trajectory, calibration(7)).of(7)
    rng = np.random.default_rng(1)
    time = rng.uniform(0, trajectory.time[-1], 300)
    points = rng.normal([100, 200, 0], 10, (300, 3))
    expected = [np.linalg.norm(point - scanner_place(trajectory, at, ARM)) for point, at in zip(points, time)]
    assert np.abs(ranges(*points.T, track.interpolate(time)) - expected).max() < 0.003
    assert track.max_range == 40.0


def test_without_calibration_from_the_body():
    trajectory = turning()
    track = Tracks(trajectory, None).of(1234)
    x, y, z = track.interpolate(np.array([5.0]))
    assert np.allclose([x[0], y[0], z[0]], trajectory.place[50])


def test_scanners_are_told_apart_and_one_stands_for_all():
    tracks = Tracks(turning(), calibration(1, 2))
    assert tracks.of(1) is tracks.of(1) and tracks.of(1) is not tracks.of(2)
    single = Tracks(turning(), calibration(None))
    assert single.of(0) is single.of(17)
    with pytest.raises(InputError, match="no scanner with point source id 3"):
        tracks.of(3)


ENTRY = {"id": 1, "lever_arm_m": [0, 0, 0], "rows": 8, "focal_length_px": 5.0, "centre_px": 3.5}


@pytest.fixture
def folder(tmp_path):
    pixels = np.random.default_rng(0).integers(0, 255, (8, 20, 3), dtype=np.uint8)
    (tmp_path / "左.png").write_bytes(cv2.imencode(".png", pixels[:, :, ::-1])[1].tobytes())
    write_times(tmp_path / "左_times.csv", range(20))
    return tmp_path, pixels


def write_times(path, columns, step=0.5):
    path.write_text("column,time\n" + "".join(f"{c},{100 + step * c}\n" for c in columns), encoding="utf-8")


def strip_calibration(folder, *entries):
    path = folder / "calibration.json"
    path.write_text(json.dumps({"cameras": entries or [ENTRY]}), encoding="utf-8")
    return read_calibration(path)


def test_image_times_and_pixels(folder):
    path, pixels = folder
    strip, = read_strips([path / "左.png"], strip_calibration(path))
    assert strip.columns == 20 and strip.camera.rows == 8
    np.testing.assert_allclose(strip.times, 100 + 0.5 * np.arange(20))
    np.testing.assert_allclose(strip.times_of([0.0, 2.5, 19.0, 19.4]), [100, 101.25, 109.5, 109.7])
    np.testing.assert_array_equal(read_columns(strip), pixels)
    np.testing.assert_array_equal(read_columns(strip, 5, 9), pixels[:, 5:9])


def test_the_calibration_names_image_and_times(folder):
    path, _ = folder
    write_times(path / "other.csv", reversed(range(20)), step=0.25)
    made = strip_calibration(path, {**ENTRY, "id": 2}, {**ENTRY, "image": "左.png", "times": "other.csv"})
    strip, = read_strips([path / "左.png"], made)
    assert strip.camera.mount.id == "1" and strip.times[1] == 100.25


def test_pixels_are_bilinear():
    pixels = np.arange(12, dtype=float).reshape(3, 4, 1)
    np.testing.assert_allclose(sample_pixels(pixels, [0, 1.5, 3, 9], [0, 1, 1.5, 9])[:, 0], [0, 5.5, 9, 11])


@pytest.mark.parametrize(("content", "sentence"), [
    (None, "no times for 左.png"), ("a,b\n1,2\n", "columns column and time"), ("column,time\n0,x\n", "no number"),
    ("column,time\n0,1\n1,2\n", "2 columns, 左.png has 20"),
    ("column,time\n" + "".join(f"{c},{5 if c == 7 else c}\n" for c in range(20)), "time of column 7"),
])
def test_bad_times(folder, content, sentence):
    path, _ = folder
    (path / "左_times.csv").unlink()
    if content:
        (path / "左_times.csv").write_text(content, encoding="utf-8")
    with pytest.raises(InputError, match=sentence):
        read_strips([path / "左.png"], strip_calibration(path))


@pytest.mark.parametrize(("entry", "sentence"), [
    ({"focal_length_px": "x"}, "focal_length_px"), ({"rows": None}, "rows"), ({"rows": 9}, "has 8 rows"),
    ({"focal_length_px": -1}, "cannot be right"),
])
def test_bad_cameras(folder, entry, sentence):
    path, _ = folder
    with pytest.raises(InputError, match=sentence):
        read_strips([path / "左.png"], strip_calibration(path, {**ENTRY, **entry}))


def test_a_damaged_camera_is_told_to_who_needs_it(folder):
    path, _ = folder
    damaged = {**ENTRY, "lever_arm_m": "lost"}
    with pytest.raises(InputError, match="lever_arm_m"):
        read_strips([path / "左.png"], strip_calibration(path, damaged))
    with pytest.raises(InputError, match="lever_arm_m"):
        read_strips([path / "左.png"], strip_calibration(path, damaged, {**ENTRY, "id": 6}))


def test_images_that_are_none_and_cameras_that_cannot_be_told(folder):
    path, _ = folder
    with pytest.raises(InputError, match="which camera took"):
        read_strips([path / "左.png"], strip_calibration(path, {**ENTRY, "id": 5}, {**ENTRY, "id": 6}))
    with pytest.raises(InputError, match="does not exist"):
        read_strips([path / "none.png"], strip_calibration(path))
    (path / "bad.png").write_text("no image")
    with pytest.raises(InputError, match="cannot be read as an image"):
        read_strips([path / "bad.png"], strip_calibration(path))
    with pytest.raises(InputError, match="No strip image"):
        read_strips([], strip_calibration(path))


ACROSS = np.arange(-0.24, 0.2401, 0.02)


def polygons(path, table):
    """Polygons of a GeoPackage layer, without GDAL."""
    with sqlite3.connect(path) as base:
        blobs = [row[0] for row in base.execute(f"select geom from {table}")]
    envelope = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}
    return shapely.get_parts([shapely.from_wkb(blob[8 + envelope[(blob[3] >> 1) & 7]:]) for blob in blobs])


def edge_profiles(polygon):
    """Places (s, d, 2) across each straight edge of more than a metre, from inside to outside."""
    ring = shapely.get_coordinates(shapely.orient_polygons(polygon).exterior if hasattr(shapely, "orient_polygons")
                                   else shapely.normalize(polygon).exterior)
    sense = 1.0 if shapely.is_ccw(shapely.linearrings(ring)) else -1.0
    for start, end in zip(ring[:-1], ring[1:]):
        length = np.hypot(*(end - start))
        if length > 1.0:
            along = (end - start) / length
            outwards = sense * np.array([along[1], -along[0]])
            base = start + np.arange(0.3, length - 0.3, 0.1)[:, None] * along
            yield base[:, None] + ACROSS[:, None] * outwards


def crossing(brightness):
    """Where the mean brightness (d,) across an edge falls through the half, m; None where it is no clear edge."""
    inside, outside = np.median(brightness[:5]), np.median(brightness[-5:])
    half = (inside + outside) / 2
    falls = np.flatnonzero((brightness[:-1] >= half) & (brightness[1:] < half))
    if inside - outside < 60 or len(falls) != 1:
        return None
    k = falls[0]
    return ACROSS[k] + 0.02 * (brightness[k] - half) / (brightness[k] - brightness[k + 1])


@pytest.fixture(scope="module")
def offsets(small_city):
    """Offsets in rows (n,) of all edges along the road that are seen clearly."""
    lines = small_city / "lines"
    strip, = read_strips([lines / "camera_1.png"], read_calibration(lines / "calibration.json"))
    true = read_trajectory(small_city / "truth" / "lines_trajectory.csv").trajectory
    grey = read_columns(strip).mean(axis=2, dtype=float)[:, :, None]
    course = shapely.LineString(true.place[::20, :2])
    edges = [places for polygon in polygons(small_city / "truth" / "markings.gpkg", "mms")
             if polygon.distance(course) < 10.0 for places in edge_profiles(polygon)]
    flat = np.concatenate([places.reshape(-1, 2) for places in edges])
    with RasterSampler(small_city / "truth" / "ground.tif") as ground:
        seen = project_to_strip(np.column_stack([flat, ground.sample(*flat.T)]), strip, true, 15.0)
    place = np.full((len(flat), 2), np.nan)
    place[seen.point_index[::-1]] = np.column_stack([seen.column, seen.row])[::-1]
    found, first = [], 0
    for places in edges:
        part = place[first:first + places[..., 0].size].reshape(places.shape)
        first += places[..., 0].size
        if np.isnan(part).any():
            continue
        column, row = part[..., 0], part[..., 1]
        colours = sample_pixels(grey, column.ravel(), row.ravel()).reshape(column.shape)
        off = crossing(colours.mean(axis=0))
        if off is not None:
            step = [np.abs(np.gradient(values, axis=1)).mean() / 0.02 for values in (column, row)]
            if step[1] > 3 * step[0]:
                found.append(off * step[1])
    return np.array(found)


@pytest.mark.slow
def test_edges_are_seen_where_they_are_projected(offsets):
    assert len(offsets) >= 5
    assert abs(np.median(offsets)) < 0.3 and np.median(np.abs(offsets)) < 0.4 and np.abs(offsets).max() < 1.5
