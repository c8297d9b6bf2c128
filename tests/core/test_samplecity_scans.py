"""What the sample city's scanners and line cameras measure."""

from __future__ import annotations

import gzip
import json

import cv2
import laspy
import numpy as np
import pytest
import shapely
from scipy.spatial.transform import Rotation

from urbanmap_qgis.progress import SILENT
from urbanmap_qgis.samplecity.drive import lines
from urbanmap_qgis.samplecity.drive.motion import drive
from urbanmap_qgis.samplecity.drive.trajectory import SimulatedTrajectory
from urbanmap_qgis.samplecity.laser import als
from urbanmap_qgis.samplecity.scene.model import FaceKind, Material
from urbanmap_qgis.samplecity.scene.world import make_scene


@pytest.fixture(scope="module")
def city():
    return make_scene(60, "canyon", 3)


@pytest.fixture(scope="module")
def scanned(city):
    return als.simulate_strips(city, np.random.SeedSequence(9))


def test_true_points_lie_on_the_true_surfaces(city, scanned):
    points, _ = scanned
    ground = points.classification == 2
    x, y, z = points.true[ground].T
    gap = np.abs(z - city.ground_height(x, y))
    assert np.mean(gap < 1e-5) > 0.995 and gap.max() < 0.2
    x, y, z = points.true[points.classification == 6].T
    roof = np.full(len(x), np.nan)
    for building in city.buildings:
        for part in building.parts:
            inner = part.plan.buffer(-part.parapet_width - 1e-6)
            shapely.prepare(inner)
            inside = shapely.contains_xy(inner, x, y)
            for structure in part.structures:
                inside &= ~shapely.contains_xy(structure.plan.buffer(1e-6), x, y)
            if part.z_ridge is None:
                roof[inside] = part.z_roof
    known = np.isfinite(roof) & (z > roof - 0.01) & (z < roof + 0.01)
    assert np.count_nonzero(known) > 2000
    assert np.abs(z - roof)[known].max() < 1e-6


def test_noise_is_what_is_stated(scanned):
    points, shifts = scanned
    good = points.classification != 7
    for strip in (1, 2):
        error = (points.xyz - points.true)[good & (points.strip == strip)]
        np.testing.assert_allclose(error.mean(axis=0), shifts[strip - 1], atol=0.005)
        np.testing.assert_allclose(error.std(axis=0), [als.PLAN_JITTER, als.PLAN_JITTER, als.HEIGHT_JITTER], rtol=0.05)


def test_density_strips_and_returns(city, scanned):
    points, _ = scanned
    area = city.extent.buffer(als.MARGIN, join_style="mitre").area
    assert len(points) / area == pytest.approx(als.DENSITY, rel=0.1)
    assert (np.diff(points.time) >= 0).all()
    assert set(points.strip) == {1, 2}
    assert {1, 2, 5, 6} <= set(points.classification)
    several = points.returns > 1
    assert several.any() and (points.return_number <= points.returns).all()
    first = several & (points.return_number == 1)
    assert (points.classification[first & (points.classification != 7)] == 5).all()


def test_points_lie_on_the_line_of_their_pulse(city, scanned):
    points, _ = scanned
    pulses = als.strip_pulses(city, 1)
    rows = np.searchsorted(pulses.time, points.time[points.strip == 2])
    away = points.true[points.strip == 2] - pulses.origin[rows]
    off = np.linalg.norm(np.cross(away, pulses.direction[rows]), axis=1)
    assert off.max() < 1e-6
    np.testing.assert_allclose(np.linalg.norm(pulses.direction, axis=1), 1.0)


def test_elevated_road_has_its_class():
    points, _ = als.simulate_strips(make_scene(60, "elevated road", 3), np.random.SeedSequence(9))
    assert np.count_nonzero(points.classification == 17) > 0.05 * len(points)


def test_files_hold_the_points_and_the_same_seed_gives_the_same_bytes(city, scanned, tmp_path):
    points, _ = scanned
    als.write_als(city, tmp_path / "a", np.random.SeedSequence(9))
    als.write_als(city, tmp_path / "b", np.random.SeedSequence(9))
    for name in ("als.laz", "als_classified.laz"):
        assert (tmp_path / "a/als" / name).read_bytes() == (tmp_path / "b/als" / name).read_bytes()
    las = laspy.read(str(tmp_path / "a/als/als_classified.laz"))
    np.testing.assert_allclose(las.xyz, points.xyz, atol=0.00051)
    np.testing.assert_array_equal(las.classification, points.classification)
    assert las.header.parse_crs().to_epsg() == 6677
    assert set(laspy.read(str(tmp_path / "a/als/als.laz")).classification) == {1}


TO_EAST_NORTH_UP = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1.0]])


@pytest.fixture(scope="module")
def scene():
    return make_scene(60.0, "canyon", 3)


def write_short(scene, folder, seed):
    """Four seconds of the drive over a zebra crossing."""
    def four_seconds(*arguments):
        true = drive(*arguments)
        keep = slice(600, 1001)
        return SimulatedTrajectory(true.time[keep], true.place[keep], true.angles[keep])

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lines, "drive", four_seconds)
        return lines.write_lines(scene, folder, np.random.SeedSequence(seed), SILENT)


@pytest.fixture(scope="module")
def files(scene, tmp_path_factory):
    folder = tmp_path_factory.mktemp("city")
    return folder, write_short(scene, folder, 7)


def read(path):
    return np.genfromtxt(path, delimiter=",", names=True)


def pose(table, time):
    """Place and rotation from a trajectory's table, headings unwrapped, linear between epochs."""
    place = np.column_stack([np.interp(time, table["time"], table[c]) for c in "xyz"])
    angles = [np.interp(time, table["time"], np.unwrap(table[c], period=360.0)) for c in ("heading", "pitch", "roll")]
    turn = Rotation.from_euler("ZYX", np.column_stack(angles), degrees=True).as_matrix()
    return place, TO_EAST_NORTH_UP @ turn


def mount(sensor):
    return Rotation.from_euler("ZYX", [sensor["heading"], sensor["pitch"], sensor["roll"]], degrees=True).as_matrix()


def test_raw_scans_lie_on_the_true_surfaces(scene, files):
    folder, summary = files
    with gzip.open(folder / "lines" / "scans.csv.gz", "rt") as file:
        scans = np.genfromtxt(file, delimiter=",", names=True)
    assert scans.dtype.names == ("time", "angle", "range", "intensity", "scanner")
    assert len(scans) == summary["ranges"] > 20000
    calibration = json.loads((folder / "lines" / "calibration.json").read_text())
    truth = read(folder / "truth" / "lines_trajectory.csv")
    faces = scene.static_faces("ground")
    walls = np.flatnonzero(faces.kind == FaceKind.WALL)
    for scanner in calibration["scanners"]:
        own = scans[scans["scanner"] == scanner["id"]]
        place, rotation = pose(truth, own["time"])
        origin = place + rotation @ np.array(scanner["lever_arm_m"])
        angle = np.radians(own["angle"])
        beam = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(len(own))]) @ mount(scanner).T
        direction = np.einsum("nij,nj->ni", rotation, beam)
        point = origin + own["range"][:, None] * direction
        height = point[:, 2] - scene.ground_height(point[:, 0], point[:, 1])
        # Steep beams near the vehicle meet the road; the noise lies along them.
        down = (np.abs(own["angle"]) < 40) & (np.abs(scene.ground.kerb_distance(point[:, 0], point[:, 1])) > 0.2)
        down &= np.abs(height) < 0.15
        assert down.sum() > 3000
        assert np.std(height[down] / direction[down, 2]) == pytest.approx(0.03, rel=0.1)
        aside = (np.abs(own["angle"]) > 60) & (height > 1.0)
        with np.errstate(divide="ignore"):
            exact = ((faces.offset[walls] - origin[aside] @ faces.normal[walls].T)
                     / (direction[aside] @ faces.normal[walls].T))
        error = np.abs(own["range"][aside][:, None] - exact).min(axis=1)
        assert np.median(error) < 0.03


def test_strip_shows_each_place_where_the_formula_says(scene, files):
    """A place of the road is found in the strip by its own time and angle (Z eq. 2), and has its paint's colour."""
    folder, _ = files
    camera = json.loads((folder / "lines" / "calibration.json").read_text())["cameras"][0]
    strip = cv2.imread(str(folder / "lines" / camera["image"]))[:, :, ::-1].astype(float)
    times = read(folder / "lines" / camera["times"])
    assert strip.shape[:2] == (camera["rows"], len(times))
    np.testing.assert_array_equal(times["column"], np.arange(len(times)))
    truth = read(folder / "truth" / "lines_trajectory.csv")
    place, rotation = pose(truth, times["time"])
    origin = place + rotation @ np.array(camera["lever_arm_m"])
    axes = rotation @ mount(camera)
    seen = []
    for along in np.arange(0.0, 1.0, 0.02):
        middle = origin[int(along * (len(times) - 1))]
        left = axes[int(along * (len(times) - 1)), :, 0]
        for reach in np.arange(0.9, 3.2, 0.05):
            x, y = middle[:2] + reach * left[:2]
            point = np.array([x, y, float(scene.ground_height(x, y))])
            local = np.einsum("nji,nj->ni", axes, point - origin)
            crossing = np.flatnonzero(local[:-1, 1] * local[1:, 1] <= 0)
            if not len(crossing):
                continue
            column = crossing[np.abs(local[crossing, 1]).argmin()]
            column += np.abs(local[column + 1, 1]) < np.abs(local[column, 1])
            angle = np.arctan2(local[column, 2], local[column, 0])
            row = camera["centre_px"] + 2 * camera["focal_length_px"] * np.sin(angle / 2)
            dx, dy = np.meshgrid([-0.08, 0, 0.08], [-0.08, 0, 0.08])
            kinds = scene.ground_material(x + dx.ravel(), y + dy.ravel(), "ground")
            if 0 <= row <= camera["rows"] - 1:
                share = np.mean(kinds == Material.PAINT_WHITE)
                seen.append((share, np.all(kinds == Material.ASPHALT), strip[round(row), column].mean()))
    share, asphalt, brightness = np.array(seen).T
    painted, bare = brightness[share > 0.85], brightness[asphalt == 1]
    assert len(painted) > 5 and len(bare) > 100
    assert np.median(painted) > 160 and np.median(bare) < 100
    assert np.mean(painted > 130) > 0.9 and np.mean(bare < 120) > 0.95


def test_tie_points_are_corners_moved_by_the_drift(scene, tmp_path):
    path = lines.corner_path(*lines.survey_lanes(scene)[0], scene.size / 2 + lines.RUN_IN)
    rng = np.random.default_rng(5)
    true = drive(scene, path, lines.chainage_over_time(path, lines.CRUISE, ()), lines.LINES_TIME, rng)
    reported = lines.reported_trajectory(true, rng, lines.MEAN_ERROR, lines.HEADING_ERROR)
    rows = lines.tie_points(scene, lines.RayCaster(scene, "ground"), true, reported)
    number, time = rows[:, 0], rows[:, 1]
    assert len(rows) >= 4 and np.array_equal(number, np.repeat(np.arange(1, len(rows) // 2 + 1), 2))
    assert (time[1::2] - time[::2]).max() <= lines.TIE_SECONDS
    assert np.hypot(*(rows[1::2, 4:] - rows[::2, 4:]).T).min() >= lines.TIE_SPACING
    vertices = np.concatenate([np.array(part.plan.exterior.coords) for b in scene.buildings for part in b.parts])
    assert np.hypot(*(rows[:, None, 4:] - vertices[None]).transpose(2, 0, 1)).min(axis=1).max() < 0.01
    tables = []
    for trajectory in (true, reported):
        trajectory.write(tmp_path / "trajectory.csv")
        tables.append(read(tmp_path / "trajectory.csv"))
    (p, r), (q, s) = (pose(table, time) for table in tables)
    corner = np.column_stack([rows[:, 4:], scene.ground_height(rows[:, 4], rows[:, 5]) + lines.TIE_HEIGHT])
    body = np.einsum("nji,nj->ni", r, corner - p)
    np.testing.assert_allclose(rows[:, 2:4], (q + np.einsum("nij,nj->ni", s, body))[:, :2], atol=1e-3)
