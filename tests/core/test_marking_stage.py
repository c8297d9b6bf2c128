"""Road markings from the files of a made-up drive whose paint is known."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import laspy
import numpy as np
import pytest

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.mobile.calibration import Calibration, MountedScanner
from urbanmap_qgis.mobile.markings import marking_stage, survey_points
from urbanmap_qgis.mobile.markings.curve_report import doubts, facts_of, write_curve_report
from urbanmap_qgis.mobile.markings.extraction import ExtractionSettings
from urbanmap_qgis.mobile.markings.marking_stage import extract_markings
from urbanmap_qgis.mobile.markings.markings_file import markings_to_file
from urbanmap_qgis.mobile.trajectory import Trajectory
from urbanmap_qgis.progress import Progress

X0, Y0 = -7000.0, -34000.0
ARM = np.array([1.0, 0.2, -0.3])
HEIGHT = 2.3
SPEED = 10.0


@dataclass
class Drive:
    """Points in arrays (n,), whether they lie on paint, and the trajectory."""

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    time: np.ndarray
    intensity: np.ndarray
    paint: np.ndarray
    trajectory: Trajectory

    def take(self, which):
        return Drive(*(getattr(self, name)[which] for name in ("x", "y", "z", "time", "intensity", "paint")),
                     self.trajectory)


def drive(length=70.0, start=1000.0, seed=1, lift=0.0, shift=0.0, wait=0.0):
    """A drive to the east at 10 m/s past dashes, a line, a crossing and walls, with a wait in the middle."""
    rng = np.random.default_rng(seed)
    scans = np.arange(0.0, length / SPEED, 1 / 80)
    angle = np.radians(np.arange(-78, 78, 0.6))
    scan, angle = (part.ravel() for part in np.meshgrid(scans, angle, indexing="ij"))
    u = SPEED * scan
    v = HEIGHT * np.tan(angle) + rng.normal(0, 0.004, len(angle))
    z = np.zeros(len(u))
    wall = np.abs(v) > 7
    z[wall] = HEIGHT * (1 - 7 / np.abs(v[wall]))
    v[wall] = 7 * np.sign(v[wall])
    distance = np.sqrt(v ** 2 + (HEIGHT - z) ** 2)
    paint = ~wall & (((np.abs(v - 1.5) < 0.075) & (np.mod(u, 7.5) < 3)) | (np.abs(v + 3.0) < 0.075)
                     | ((u > 60) & (u < 63) & (np.mod(v, 0.9) < 0.45) & (np.abs(v) < 4)))
    brightness = np.where(paint, 3.5, np.where(wall, 2.5, 1.0))
    intensity = brightness * (200 + 60_000 * distance ** -2.0) * np.exp(0.08 * rng.standard_normal(len(u)))
    time = start + scan + np.where(u > length / 2, wait, 0.0)
    epochs = np.arange(-0.5, length / SPEED + wait + 0.5, 0.02)
    middle = length / 2 / SPEED
    way = SPEED * np.where(epochs > middle, np.maximum(epochs - wait, middle), epochs)
    place = np.column_stack([X0 + way, np.full(len(way), Y0), np.full(len(way), 10 + HEIGHT + ARM[2])])
    place += [-ARM[0], ARM[1], lift]
    trajectory = Trajectory(start + epochs, place, np.tile([0.0, 0.0, 90.0], (len(way), 1)))
    height = 10 + z + lift + rng.normal(0, 0.003, len(u))
    return Drive(X0 + u, Y0 + v + shift, height, time, intensity, paint, trajectory)


CALIBRATION = Calibration((MountedScanner("front", ARM, np.zeros(3), 1, 60.0),))


@pytest.fixture
def write(make_cloud, tmp_path):
    def make(made, name="測量.laz", **attributes):
        attributes = {"intensity": np.round(made.intensity), "gps_time": made.time, "point_source_id": 1, **attributes}
        return make_cloud(tmp_path / name, made.x, made.y, made.z, **attributes)
    return make


def extract(path, made, calibration=CALIBRATION, **settings):
    return extract_markings(open_cloud([path]), made.trajectory, calibration, ExtractionSettings(**settings))


def score(numbers, paint):
    hit = paint[numbers].sum()
    return hit / max(len(numbers), 1), hit / paint.sum()


@pytest.mark.slow
def test_markings_with_all_their_attributes(write, tmp_path):
    made = drive()
    number = np.arange(len(made.x))
    path = write(made, extra={"number": number}, user_data=number % 200, scan_angle=number % 90)
    output = tmp_path / "標示.laz"
    found = markings_to_file([path], output, made.trajectory, CALIBRATION)
    precision, recall = score(found.number, made.paint)
    assert precision > 0.97 and recall > 0.95
    assert found.points.time == pytest.approx(made.time[found.number])
    before, after = laspy.read(path), laspy.read(output)
    assert np.array_equal(after["number"], found.number)
    for name in before.point_format.dimension_names:
        assert np.array_equal(before[name][found.number], after[name]), name
    assert np.array_equal(after["calibrated_intensity"], found.intensity)
    paint = made.paint[found.number]
    assert np.median(found.intensity[paint]) / found.reference == pytest.approx(3.5, rel=0.06)
    assert after["marking_weight"].min() >= 0 and after["marking_weight"].max() <= 1
    assert after.header.parse_crs() == before.header.parse_crs()
    assert set(found.curves) == {1} and not found.failed
    curve = found.curves[1]
    r = np.linspace(2.5, 7.0, 20)
    assert np.abs(curve.intensity(r) / (200 + 60_000 * r ** -2.0) - 1).max() < 0.05
    facts = facts_of(found)
    assert facts["POINTS_READ"] == len(number) and facts["MARKING_POINTS"] == len(found.number)
    assert facts["PAINT_CONTRAST"] == pytest.approx(3.5, rel=0.1) and facts["MARKED_WAY"] == 1.0
    assert not doubts(found)


@pytest.mark.slow
def test_the_order_of_the_points_the_files_and_the_workers_do_not_matter(write):
    made = drive(40.0)
    expected = extract(write(made), made).number
    turn = np.random.default_rng(5).permutation(len(made.x))
    shuffled = extract(write(made.take(turn), "shuffled.laz"), made)
    assert np.array_equal(np.sort(turn[shuffled.number]), expected)
    half = len(made.x) // 2
    paths = [write(made.take(slice(half, None)), "b.laz"), write(made.take(slice(0, half)), "a.laz")]
    with ThreadPoolExecutor(2) as executor:
        two = extract_markings(open_cloud(paths), made.trajectory, CALIBRATION, executor=executor)
    assert np.array_equal(np.sort((two.number + half) % len(made.x)), expected)


@pytest.mark.slow
def test_no_seams_between_stretches(write, monkeypatch):
    made = drive(100.0)
    path = write(made)
    whole = extract(path, made).number
    monkeypatch.setattr(marking_stage, "_MAX_UNITS", 2)
    cut = extract(path, made).number
    assert len(np.setxor1d(whole, cut)) < 0.002 * len(whole)


@pytest.mark.slow
def test_classified_ground_is_taken_as_it_is(write):
    made = drive(40.0)
    ground = np.abs(made.y - Y0) < 6.9
    classes = np.where(ground & (made.x < X0 + 25), 2, 1)
    found = extract(write(made, classification=classes), made)
    assert found.ground_method == "classes"
    assert found.points.x.max() < X0 + 25
    assert extract(write(made, classification=classes), made, ground="cloth").points.x.max() > X0 + 25


def test_a_street_driven_twice_is_not_mixed(write):
    first, second = drive(40.0), drive(40.0, start=1100.0, seed=2, lift=0.7, shift=0.4)
    both = Drive(*(np.concatenate([getattr(first, name), getattr(second, name)])
                   for name in ("x", "y", "z", "time", "intensity", "paint")),
                 Trajectory(*(np.concatenate([getattr(first.trajectory, name), getattr(second.trajectory, name)])
                              for name in ("time", "place", "angles"))))
    found = extract(write(both), both)
    precision, recall = score(found.number, both.paint)
    assert precision > 0.97 and recall > 0.94


@pytest.mark.slow
def test_a_wait_is_left_out_and_times_outside_are_told(write):
    made = drive(40.0, wait=20.0)
    rng = np.random.default_rng(1)
    again = np.flatnonzero(np.abs(made.x - X0 - 20) < 0.2)
    again = np.repeat(again, 20)
    waiting = made.take(np.concatenate([np.arange(len(made.x)), again]))
    waiting.time[len(made.x):] = 1000 + 2 + rng.uniform(1.5, 19.5, len(again))
    found = extract(write(waiting), waiting)
    assert found.standing == len(again)
    assert score(found.number, made.paint)[1] > 0.93
    early = made.take(slice(None))
    early.time[:500] = 900.0
    warned = []
    found = extract_markings(open_cloud([write(early)]), made.trajectory, CALIBRATION,
                             progress=Progress(warn=warned.append))
    assert found.outside == 500 and "500 of" in warned[0]


def test_points_in_a_gap_of_the_trajectory_are_left_out(write):
    made = drive(40.0)
    time = made.trajectory.time
    keep = (time < 1001.5) | (time > 1003)
    gap = Trajectory(*(getattr(made.trajectory, name)[keep] for name in ("time", "place", "angles")))
    found = extract_markings(open_cloud([write(made)]), gap, CALIBRATION)
    inside = (found.points.time > 1001.6) & (found.points.time < 1002.9)
    assert found.outside > 0 and not inside.any() and len(inside) > 500


@pytest.mark.slow
def test_week_seconds_and_adjusted_time_meet(write):
    made = drive(40.0, start=300_000.0)
    expected = extract(write(made), made)
    moved = made.take(slice(None))
    moved.time = made.time + 2_300 * 604_800.0 - 1e9
    found = extract(write(moved, "adjusted.laz"), made)
    assert len(np.setxor1d(found.number, expected.number)) < 0.01 * len(expected.number)
    assert found.points.time == pytest.approx(made.time[found.number], abs=1e-3)


@pytest.mark.slow
def test_without_calibration_and_without_markings(write, tmp_path):
    made = drive(40.0)
    found = extract(write(made), made, None)
    precision, recall = score(found.number, made.paint)
    assert precision > 0.97 and recall > 0.9
    bare = made.take(~made.paint)
    found = markings_to_file([write(bare, "bare.laz")], tmp_path / "none.laz", made.trajectory, CALIBRATION)
    assert not len(found.points) and len(laspy.read(tmp_path / "none.laz").points) == 0
    assert "No marking points" in doubts(found)[0]
    assert np.isnan(facts_of(found)["PAINT_CONTRAST"])


@pytest.mark.slow
def test_a_scanner_that_sees_no_road_is_left_out(write):
    made = drive(40.0)
    wall = np.abs(made.y - Y0) > 6.9
    calibration = Calibration((*CALIBRATION.scanners, MountedScanner("up", ARM, np.zeros(3), 2, 60.0)))
    found = extract(write(made, point_source_id=np.where(wall, 2, 1)), made, calibration)
    assert set(found.curves) == {1}
    assert score(found.number, made.paint)[1] > 0.93


@pytest.mark.slow
def test_sweep_numbers_are_no_scanners(write):
    made = drive(40.0)
    sweeps = ((made.time - 1000) * 10).astype(int)
    found = extract(write(made, point_source_id=sweeps), made, None)
    assert set(found.curves) == {0}
    single = Calibration((MountedScanner("spinning", ARM, np.zeros(3)),))
    found = extract(write(made, point_source_id=sweeps), made, single)
    assert set(found.curves) == {0} and score(found.number, made.paint)[1] > 0.93


def test_page_of_the_fit(write, tmp_path):
    made = drive(40.0)
    found = extract(write(made), made)
    write_curve_report(tmp_path / "曲線.html", found, ["測量.laz"])
    page = (tmp_path / "曲線.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 1 and "測量.laz" in page and "Scanner 1" in page
    assert f"{found.curves[1].r2:.2f}" in page and "nan" not in page.lower().replace("finance", "")


@pytest.mark.parametrize(("attributes", "words"), [
    ({"intensity": 0}, "no intensity"),
    ({"intensity": 700}, "All points .* have the intensity 700"),
    ({"intensity": np.arange(260 * 480) % 3 % 2}, "All points .* have the intensity 0, 1,"),
    ({"gps_time": 0.0}, "GPS times .* are zero"),
    ({"point_source_id": 5}, "no scanner with point source id 5"),
    ({"gps_time": 5000.0 + np.arange(260 * 480) * 1e-5}, "trajectory runs from"),
])
def test_one_sentence_for_what_cannot_be_used(write, attributes, words):
    made = drive(40.0)
    attributes = {key: value[:len(made.x)] if np.ndim(value) else value for key, value in attributes.items()}
    with pytest.raises(InputError, match=words):
        extract(write(made, **attributes), made)


def test_more_that_cannot_be_used(write, make_cloud, tmp_path):
    made = drive(40.0)
    untimed = make_cloud(tmp_path / "untimed.las", made.x, made.y, made.z, point_format=0, intensity=made.intensity)
    with pytest.raises(InputError, match="carry no GPS time"):
        extract(untimed, made)
    lifted = made.take(slice(None))
    lifted.z = made.z + 36.0
    with pytest.raises(InputError, match=r"they lie \+3\d m above the scanner"):
        extract(write(lifted), made)
    wall = made.take(np.abs(made.y - Y0) > 6.9)
    with pytest.raises(InsufficientDataError):
        extract(write(wall), made)
    with pytest.raises(InsufficientDataError, match="no ground points"):
        extract(write(made, classification=6), made)
    whole = write(made)
    broken = tmp_path / "broken.laz"
    broken.write_bytes(whole.read_bytes()[:-60_000])
    with pytest.raises(InputError, match="truncated|cannot be read"):
        extract(broken, made)


@pytest.mark.slow
@pytest.mark.parametrize("at", [0.05, 0.55, 0.72])
def test_cancel_leaves_nothing(write, tmp_path, at):
    made = drive(40.0)
    path, seen = write(made), []
    progress = Progress(report=seen.append, cancelled=lambda: bool(seen) and seen[-1] >= at)
    with pytest.raises(Cancelled):
        markings_to_file([path], tmp_path / "m.laz", made.trajectory, CALIBRATION, progress=progress)
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_long_stops():
    made = drive(40.0, wait=20.0)
    stops = survey_points.long_stops(made.trajectory, survey_points.path_chainage(made.trajectory))
    assert stops == pytest.approx([1012.0], abs=0.6)
    slow = drive(40.0).trajectory
    assert not len(survey_points.long_stops(slow, survey_points.path_chainage(slow)))


def test_a_share_of_ground_that_cannot_be_right_is_refused():
    with pytest.raises(InsufficientDataError, match=r"Only 50 of 10,000 points near the vehicle of a\.laz"):
        survey_points.require_points(50, 10_000, "a.laz")
    survey_points.require_points(150, 10_000, "a.laz")
    survey_points.require_points(50, 0, "a.laz")  # ground by class is the user's own word
