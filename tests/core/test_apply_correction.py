"""Points and images moved by a corrected trajectory: known movements, everything else kept, honest counts."""

from __future__ import annotations

import datetime

import laspy
import numpy as np
import pytest
from pyproj import CRS

from urbanmap_qgis.errors import Cancelled, InputError
from urbanmap_qgis.mobile.apply_correction import apply_correction, apply_to_images
from urbanmap_qgis.mobile.pose_correction import correction_between
from urbanmap_qgis.mobile.trajectory import Trajectory, move_points, rotations
from urbanmap_qgis.progress import Progress

X0, Y0 = -7000.0, -34000.0


def drive(step=0.01, seconds=20.0, bend=25.0):
    """A drive round a bend of `bend` m at 8 m/s, nodding and rolling."""
    time = 1000.0 + np.arange(0.0, seconds + step / 2, step)
    angle = 8.0 * (time - 1000.0) / bend
    place = np.column_stack([X0 + bend * (1 - np.cos(angle)), Y0 + bend * np.sin(angle), 12 + 0.3 * np.sin(time)])
    return Trajectory(time, place, np.column_stack([np.sin(time), np.cos(1.3 * time), np.degrees(angle)]))


def corrected(reported, shift=(0.8, -0.5, -0.7), turn=(0.1, -0.08, 0.15), drift=0.02):
    since = (reported.time - reported.time[0])[:, None]
    return Trajectory(reported.time, reported.place + np.array(shift) + drift * since * [1.0, -1.0, 0.3],
                      reported.angles + np.array(turn) * (1 + 0.05 * since))


def rigid(points, time, reported, other):
    """T_corrected T_reported^-1, epoch by epoch, written as matrices."""
    out = np.empty_like(points)
    for row, (p, t) in enumerate(zip(points, time)):
        pose = []
        for trajectory in (reported, other):
            values = [np.interp(t, trajectory.time, axis) for axis in (*trajectory.place.T, *trajectory.angles.T)]
            pose.append((np.array(values[:3]), rotations(np.array([values[3:]]))[0]))
        (p0, r0), (p1, r1) = pose
        out[row] = p1 + r1 @ r0.T @ (p - p0)
    return out


@pytest.fixture
def survey(tmp_path):
    """A LAZ with extra dimensions, own VLR and EVLR, and its reported trajectory."""
    reported = drive()
    rng = np.random.default_rng(5)
    n = 5000
    header = laspy.LasHeader(point_format=7, version="1.4")
    header.scales, header.offsets = [0.001, 0.001, 0.0005], [X0, Y0, 0.0]
    header.add_extra_dim(laspy.ExtraBytesParams("reflectance", np.float32, "dB"))
    header.add_extra_dim(laspy.ExtraBytesParams("ring", np.uint8))
    header.add_crs(CRS.from_epsg(6677))
    header.vlrs.append(laspy.VLR("survey_co", 7, "notes", b"kept as it is"))
    header.evlrs = laspy.vlrs.vlrlist.VLRList()
    header.evlrs.append(laspy.VLR("survey_co", 8, "more", b"also kept" * 50))
    header.system_identifier, header.creation_date = "scanner 12", datetime.date(2020, 2, 29)
    las = laspy.LasData(header)
    time = rng.uniform(1000.0, 1020.0, n)  # in no order
    las.x, las.y, las.z = X0 + rng.uniform(-60, 60, n), Y0 + rng.uniform(-60, 60, n), rng.uniform(8, 40, n)
    las.gps_time = time
    for name, top in (("intensity", 65535), ("red", 65535), ("point_source_id", 4), ("user_data", 255),
                      ("classification", 255), ("scan_angle", 3000), ("ring", 255)):
        las[name] = rng.integers(0, top, n)
    las["reflectance"] = rng.normal(size=n).astype(np.float32)
    path = tmp_path / "測量.laz"
    las.write(path)
    return path, reported


def test_points_go_where_the_poses_put_them_and_nothing_else_changes(survey, tmp_path):
    path, reported = survey
    moved = apply_correction([path], reported, corrected(reported), tmp_path / "out.laz")
    before, after = laspy.read(path), laspy.read(tmp_path / "out.laz")
    expected = rigid(np.array(before.xyz), np.asarray(before.gps_time), reported, corrected(reported))
    assert np.abs(np.array(after.xyz) - expected).max() < 0.0011
    assert moved.points == 5000 and moved.outside == 0 and moved.in_gaps == 0
    lengths = np.linalg.norm(expected - np.array(before.xyz), axis=1)
    assert moved.mean == pytest.approx(lengths.mean(), abs=1e-4)
    assert moved.largest == pytest.approx(lengths.max(), abs=1e-4)
    assert list(after.point_format.dimension_names) == list(before.point_format.dimension_names)
    for name in set(before.point_format.dimension_names) - {"X", "Y", "Z"}:
        assert np.array_equal(before[name], after[name]), name
    assert [(v.user_id, v.record_id, v.record_data_bytes()) for v in after.header.vlrs] == [
        (v.user_id, v.record_id, v.record_data_bytes()) for v in before.header.vlrs]
    assert [(v.user_id, v.record_data_bytes()) for v in after.header.evlrs] == [("survey_co", b"also kept" * 50)]
    assert after.header.system_identifier == "scanner 12" and after.header.creation_date.year == 2020
    assert np.array_equal(after.header.scales, before.header.scales)
    assert np.array_equal(after.header.offsets, before.header.offsets)


def test_records_named_in_japanese_are_kept(survey, tmp_path):
    path, reported = survey
    name = "測量".encode("shift_jis")
    content = path.read_bytes()
    for old in (b"notes", b"more"):  # of a record and of an extended one
        assert content.count(old) == 1
        content = content.replace(old, name.ljust(len(old), b"\0") if len(old) > len(name) else name)
    path.write_bytes(content)
    apply_correction([path], reported, corrected(reported), tmp_path / "out.laz")
    before, after = (laspy.open(one) for one in (path, tmp_path / "out.laz"))
    with before, after:
        assert [record.description for record in before.header.vlrs if record.user_id == "survey_co"] == [name]
        for records in ("vlrs", "evlrs"):
            assert [record.description for record in getattr(after.header, records) if record.user_id == "survey_co"] \
                == [name]


def test_same_trajectory_moves_nothing(survey, tmp_path):
    path, reported = survey
    moved = apply_correction([path], reported, reported, tmp_path / "out.laz")
    assert moved.largest == 0.0
    assert np.array_equal(laspy.read(path).points.array, laspy.read(tmp_path / "out.laz").points.array)


def test_table_is_as_exact_as_interpolation_for_coarse_epochs():
    reported = drive(step=1.0)
    other = corrected(drive(step=0.25))
    rng = np.random.default_rng(0)
    time = rng.uniform(1000.0, 1020.0, 2000)
    points = np.array([X0, Y0, 30.0]) + rng.uniform(-80, 80, (2000, 3))
    moved = points + correction_between(reported, other).translations(points, time)
    assert np.abs(moved - move_points(points, time, reported, other)).max() < 1e-4


def test_points_outside_and_in_gaps_are_counted_and_told(survey, tmp_path):
    path, reported = survey
    keep = (reported.time > 1002.0) & ((reported.time < 1010.0) | (reported.time > 1012.0))
    short = Trajectory(reported.time[keep], reported.place[keep], reported.angles[keep])
    warnings = []
    moved = apply_correction([path], short, corrected(short), tmp_path / "out.laz",
                             progress=Progress(warn=warnings.append))
    time = np.asarray(laspy.read(path).gps_time)
    assert moved.outside == np.count_nonzero(time < short.time[0])
    assert moved.in_gaps == pytest.approx(np.count_nonzero((time > 1010) & (time < 1012)), abs=5)
    assert "outside the trajectory's time" in warnings[0] and "in gaps" in warnings[1]
    apply_correction([path], short, corrected(short), tmp_path / "kept.laz", "keep")
    before, kept = laspy.read(path), laspy.read(tmp_path / "kept.laz")
    early = time < short.time[0]
    assert np.array_equal(before.X[early], kept.X[early]) and (before.X[~early] != kept.X[~early]).all()
    with pytest.raises(InputError, match="outside the trajectory"):
        apply_correction([path], short, corrected(short), tmp_path / "refused.laz", "refuse")
    assert not list(tmp_path.glob("*refused*"))


def test_coarse_steps_are_refined_and_far_offsets_moved(make_cloud, tmp_path):
    reported = drive()
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = [0.1, 1e-5, 0.1], [0.0, 0.0, 0.0]  # y: the corner of what 32 bits hold
    las = laspy.LasData(header)
    las.x, las.z = np.array([X0, X0 + 1]), np.array([10.0, 11.0])
    las.gps_time = [1001.0, 1002.0]
    las.y = np.array([-21474.8, -21470.0])
    las.write(tmp_path / "coarse.las")
    shifted = Trajectory(reported.time, reported.place + np.array([0.034, -3.0, 0.012]), reported.angles)
    warnings = []
    apply_correction([tmp_path / "coarse.las"], reported, shifted, tmp_path / "fine.las",
                     progress=Progress(warn=warnings.append))
    after = laspy.read(tmp_path / "fine.las")
    assert np.allclose(np.array(after.xyz) - np.array(laspy.read(tmp_path / "coarse.las").xyz), [0.034, -3.0, 0.012],
                       atol=6e-4)
    assert "too coarse" in warnings[0]


def test_several_files_and_adjusted_time(make_cloud, tmp_path):
    reported = drive()
    week = Trajectory(reported.time + 2200 * 604800.0 - 1e9, reported.place, reported.angles)
    paths = [make_cloud(tmp_path / f"{name}.laz", X0 + np.arange(10.0), np.full(10, Y0), np.full(10, 10.0),
                        point_format=point_format, gps_time=1001.0 + np.arange(10.0), intensity=number)
             for number, (name, point_format) in enumerate((("a", 6), ("b", 6), ("c", 1)))]
    moved = apply_correction(paths[:2], week, corrected(week), tmp_path / "both.laz")
    both = laspy.read(tmp_path / "both.laz")
    assert moved.points == 20 and list(both.intensity) == [0] * 10 + [1] * 10
    assert np.asarray(both.gps_time)[0] == 1001.0  # as stored
    expected = rigid(np.array(laspy.read(paths[0]).xyz), 1001.0 + np.arange(10.0), reported, corrected(reported))
    assert np.abs(np.array(both.xyz)[:10] - expected).max() < 0.002


def test_bad_input_in_one_sentence(survey, make_cloud, tmp_path):
    path, reported = survey
    later = Trajectory(reported.time + 5000.0, reported.place, reported.angles)
    with pytest.raises(InputError, match="give those of one survey"):
        apply_correction([path], later, corrected(later), tmp_path / "out.laz")
    with pytest.raises(InputError, match="give two of one survey"):
        apply_correction([path], reported, later, tmp_path / "out.laz")
    no_time = make_cloud(tmp_path / "no_time.laz", [X0], [Y0], [1.0], point_format=0)
    with pytest.raises(InputError, match="no GPS time"):
        apply_correction([no_time], reported, reported, tmp_path / "out.laz")
    with pytest.raises(InputError, match="must end in"):
        apply_correction([path], reported, reported, tmp_path / "out.txt")


def test_cancel_leaves_nothing(survey, tmp_path):
    path, reported = survey
    with pytest.raises(Cancelled):
        apply_correction([path], reported, reported, tmp_path / "out.laz", progress=Progress(cancelled=lambda: True))
    assert sorted(item.name for item in tmp_path.iterdir()) == [path.name]


def test_images_move_like_the_body(survey, tmp_path):
    path, reported = survey
    moved = apply_correction([path], reported, reported, tmp_path / "out.laz")
    (tmp_path / "images.csv").write_text(
        "id,time,x,y,z,roll,pitch,heading,file\n"
        f"a,1005.0,{X0},{Y0},12,0,0,30,a.jpg\nb,990.0,{X0},{Y0},12,0,0,30,b.jpg\n", encoding="utf-8")
    lifted = Trajectory(reported.time, reported.place + np.array([0.0, 0.0, 0.5]), reported.angles)
    warnings = []
    result = apply_to_images(tmp_path / "images.csv", reported, lifted, tmp_path / "new.csv", moved,
                             Progress(warn=warnings.append))
    rows = (tmp_path / "new.csv").read_text().splitlines()
    assert rows[1].startswith("a,1005.0000") and rows[1].endswith("a.jpg")
    assert float(rows[1].split(",")[4]) == pytest.approx(12.5, abs=1e-4)
    assert rows[2].startswith("b,990.0000") and float(rows[2].split(",")[4]) == pytest.approx(12.5, abs=1e-4)
    assert (result.images, result.images_outside) == (2, 1) and "1 of 2 images" in warnings[0]


def test_a_correction_of_another_time_says_both_spans():
    early, late = (Trajectory(np.linspace(first, first + 10.0, 11), np.zeros((11, 3)), np.zeros((11, 3)))
                   for first in (0.0, 50.0))
    with pytest.raises(InputError, match=r"runs from 50\.0 to 60\.0 s, the reported one from 0\.0 to 10\.0 s"):
        correction_between(early, late)
    with pytest.raises(InputError, match=r"runs from 0\.0 to 10\.0 s, the reported one from 50\.0 to 60\.0 s"):
        correction_between(late, early)
