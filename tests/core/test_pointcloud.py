"""Reading and writing point clouds."""

import os
from types import SimpleNamespace

import laspy
import numpy as np
import pytest

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError, OutputError
from urbanmap_qgis.io.files.read_once import once, read_once
from urbanmap_qgis.io.points import decoded_points
from urbanmap_qgis.io.points.decoded_points import decoded_once
from urbanmap_qgis.io.points.pointcloud import (
    PointLayout,
    can_be_entered,
    cloud_writer,
    iter_chunks,
    open_cloud,
    read_all,
    valid_points,
)
from urbanmap_qgis.io.points.whole_records import copied_records, joined_records, put_records, record_rows
from urbanmap_qgis.mobile.packed_points import PackedPoints
from urbanmap_qgis.mobile.passes import SurveyPasses
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.progress import Progress


@pytest.fixture
def points():
    rng = np.random.default_rng(1)
    return rng.uniform(0, 100, 5000).round(3), rng.uniform(0, 100, 5000).round(3), rng.uniform(0, 9, 5000).round(3)


def copy(source, target, **kwargs):
    cloud = open_cloud([source])
    layout = PointLayout(cloud, **kwargs)
    with cloud_writer(target, layout) as writer:
        for chunk in iter_chunks(cloud, chunk_points=1700):
            writer.write(layout.adapt(chunk, np.ones(len(chunk), bool)))
    return laspy.read(target)


def test_copy_keeps_every_attribute_and_the_order(tmp_path, make_cloud, points):
    source = make_cloud(tmp_path / "街区.laz", *points, intensity=np.arange(5000), gps_time=np.arange(5000) / 7,
                        extra={"part": np.arange(5000)[::-1]}, classification=6)
    before, after = laspy.read(source), copy(source, tmp_path / "出力.laz", extra=[("building_id", "number")])
    for name in before.point_format.dimension_names:
        assert np.array_equal(before[name], after[name]), name
    assert not np.asarray(after["building_id"]).any()
    assert after.header.parse_crs().to_epsg() == 6677


def test_files_of_different_formats_and_scales_become_one_cloud(tmp_path, make_cloud, points):
    first = make_cloud(tmp_path / "a.las", *points, point_format=1, gps_time=5.0, intensity=77)
    second = make_cloud(tmp_path / "b.laz", *points, point_format=7, red=9, extra={"part": 3})
    cloud = open_cloud([first, second])
    layout = PointLayout(cloud)
    with cloud_writer(tmp_path / "both.laz", layout) as writer:
        for chunk in iter_chunks(cloud):
            writer.write(layout.adapt(chunk, np.ones(len(chunk), bool)))
    both = laspy.read(tmp_path / "both.laz")
    assert len(both) == 10000
    assert np.abs(np.asarray(both.x) - np.tile(points[0], 2)).max() < 1e-6
    assert set(np.asarray(both.intensity)[:5000]) == {77} and set(np.asarray(both["part"])[5000:]) == {3}


def test_noise_withheld_and_absurd_points_are_not_usable(tmp_path, make_cloud):
    path = make_cloud(tmp_path / "n.las", [0, 1, 2, 3, 4], [0] * 5, [1, 1, 1, 1, 2e5],
                      classification=[1, 7, 18, 6, 6], withheld=[0, 0, 0, 1, 0])
    chunk = next(iter_chunks(open_cloud([path])))
    assert valid_points(chunk).tolist() == [True, False, False, False, False]


def test_damaged_files_are_refused_in_one_sentence(tmp_path, make_cloud, points):
    whole = make_cloud(tmp_path / "whole.laz", *points).read_bytes()
    for name, content in {"half": whole[:len(whole) // 2], "text": b"not a cloud", "empty": b""}.items():
        path = tmp_path / f"{name}.laz"
        path.write_bytes(content)
        with pytest.raises(InputError, match=name) as caught:
            list(iter_chunks(open_cloud([path])))
        assert "\n" not in str(caught.value)
    with pytest.raises(InputError, match="does not exist"):
        open_cloud([tmp_path / "missing.laz"])


def test_truncated_las_is_told_from_a_whole_one(tmp_path, make_cloud, points):
    path = make_cloud(tmp_path / "cut.las", *points)
    path.write_bytes(path.read_bytes()[:-30 * 2000])
    with pytest.raises(InputError, match="truncated"):
        list(iter_chunks(open_cloud([path])))


def test_no_points_and_mixed_crs_are_refused(tmp_path, make_cloud, points):
    with pytest.raises(InsufficientDataError, match="no points"):
        open_cloud([make_cloud(tmp_path / "none.las", [], [], [])])
    with pytest.raises(InputError, match="one coordinate reference system"):
        open_cloud([make_cloud(tmp_path / "a.las", *points), make_cloud(tmp_path / "b.las", *points, epsg=6678)])


def test_failed_or_cancelled_writing_leaves_the_old_result(tmp_path, make_cloud, points):
    source, target = make_cloud(tmp_path / "a.laz", *points), tmp_path / "result.laz"
    target.write_text("precious")
    layout = PointLayout(open_cloud([source]))
    with pytest.raises(Cancelled), cloud_writer(target, layout):
        list(iter_chunks(open_cloud([source]), Progress(cancelled=lambda: True)))
    assert target.read_text() == "precious"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.laz", "result.laz"]
    with pytest.raises(OutputError, match="does not exist"), cloud_writer(tmp_path / "no" / "x.laz", layout):
        pass


@pytest.mark.parametrize("output", ["made.laz", "made.las"])
def test_a_record_named_in_japanese_is_kept(tmp_path, make_cloud, points, output):
    path = make_cloud(tmp_path / "all.laz", *points)
    content, name = path.read_bytes(), "座標系".encode("shift_jis")
    place = content.index(b"LASF_Projection") + 20  # behind user, number and length of the record
    path.write_bytes(content[:place] + name.ljust(32, b"\0") + content[place + 32:])
    copy(path, tmp_path / output)
    with laspy.open(tmp_path / output) as reader:
        assert name in [record.description for record in reader.header.vlrs]
        assert reader.header.parse_crs() == open_cloud([path]).headers[0].parse_crs()


def test_read_all_gives_scaled_coordinates(tmp_path, make_cloud, points):
    read = read_all(open_cloud([make_cloud(tmp_path / "a.laz", *points)]), ["x", "z"])
    assert np.allclose(read["x"], points[0], atol=1e-6) and np.allclose(read["z"], points[2], atol=1e-6)


def pointwise(source, target):
    """A LAZ of one chunk as LASzip's first versions wrote it: one stream (compressor 1), without a table of chunks."""
    data = bytearray(source.read_bytes())
    start = int.from_bytes(data[96:100], "little")
    table = int.from_bytes(data[start:start + 8], "little")
    record = data.index(b"laszip encoded") - 2 + 54
    data[record:record + 2] = (1).to_bytes(2, "little")
    target.write_bytes(data[:start] + data[start + 8:table])
    return target


def test_a_stream_without_chunks_is_read(tmp_path, make_cloud):
    x, y, z = np.random.default_rng(5).uniform(0, 60, (3, 4000))
    time = np.sort(z)
    made = make_cloud(tmp_path / "chunks.laz", x, y, z, point_format=1, gps_time=time)
    cloud = open_cloud([pointwise(made, tmp_path / "stream.laz")])
    read = read_all(cloud, ("x", "gps_time"))
    assert np.allclose(read["x"], x, atol=1e-3) and np.array_equal(read["gps_time"], time)
    assert not can_be_entered(cloud.headers[0]) and can_be_entered(open_cloud([made]).headers[0])


def cloud_file(path, offset, point_format, vlr=None):
    header_of = laspy.LasHeader(point_format=point_format, version="1.4")
    header_of.scales, header_of.offsets = [0.001] * 3, offset
    if vlr:
        header_of.vlrs.append(laspy.VLR(vlr, 7, "note", b"content"))
    las = laspy.LasData(header_of)
    las.x, las.y, las.z = np.array([1000.25, 1001.5]), np.array([2000.75, 2002.0]), np.array([30.125, 31.0])
    las.intensity = np.array([5, 6], np.uint16)
    las.write(path)
    return path


@pytest.mark.parametrize("offset", [[0.0, 0.0, 0.0], [900.0, 1900.0, 10.0]])
@pytest.mark.parametrize("point_format", [6, 7])
def test_points_keep_their_place_in_a_layout_of_another_format_or_offset(tmp_path, offset, point_format):
    cloud = open_cloud([cloud_file(tmp_path / "a.las", [0.0] * 3, 7),
                        cloud_file(tmp_path / "b.las", offset, point_format)])
    layout = PointLayout(cloud)
    for chunk in iter_chunks(cloud):
        made = layout.view(layout.adapt(chunk, np.array([False, True])))
        assert (made.x[0], made.y[0], made.z[0]) == pytest.approx((1001.5, 2002.0, 31.0), abs=1e-6)
        assert made.intensity.tolist() == [6]


# Points packed for sorting: the same coordinates and passes as the files give


def packable(scale, offset, count=500, seed=0):
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = np.full(3, scale), np.array([offset, 2 * offset, 0.0])
    rng = np.random.default_rng(seed)
    made = laspy.ScaleAwarePointRecord.zeros(count, header=header)
    for name in "XYZ":
        made[name] = rng.integers(-2**31, 2**31, count)
    return header, made


@pytest.mark.parametrize("kinds", [[(0.001, -6863.0)], [(0.001, -6863.0), (0.0025, 0.1)]])
def test_coordinates_come_back_to_the_last_digit(kinds):
    given = [packable(*kind, seed=seed) for seed, kind in enumerate(kinds)]
    packing = PackedPoints([header for header, _ in given])
    records = np.concatenate([packing.packed(made, np.zeros(len(made))) for _, made in given])
    rows = np.array([3, 1, len(records) - 1])
    for name in "xyz":
        expected = np.concatenate([np.asarray(made[name]) for _, made in given])
        assert np.array_equal(packing.column(records, name), expected)
        assert np.array_equal(packing.column(records, name, rows), expected[rows])
        assert packing.extent(records, name, rows) == (expected[rows].min(), expected[rows].max())
    assert packing.dtype.itemsize == (16 if len(kinds) == 1 else 20)


def test_passes_are_those_of_the_times_themselves():
    header, made = packable(0.001, 0.0, 9)
    time = np.array([3e8, 3e8 + 59.999, 3e8 + 60.0, 3e8 + 60.5, 3e8 - 2.5, 3e8 + 200.0, -1e300, 1e300, np.nan])
    passes = SurveyPasses(np.array([3e8 + 60.0, 3e8 + 200.0]))
    packing = PackedPoints([header])
    records = packing.packed(made, time)
    assert packing.passes(records, passes).tolist() == passes.of(time).tolist() == [0, 0, 1, 1, 0, 2, 0, 2, 2]
    assert packing.passes(records, SurveyPasses(np.empty(0))).tolist() == [0] * 9


# What a run has read is kept for its length, and only while the file is the same


def test_nothing_is_kept_outside_a_block_nor_after_it():
    answers = iter(range(9))
    assert [once("a", lambda: next(answers)) for _ in range(2)] == [0, 1]
    with read_once():
        assert [once(key, lambda: next(answers)) for key in "aab"] == [2, 2, 3]
        with read_once():
            assert once("a", lambda: next(answers)) == 2
        assert once("a", lambda: next(answers)) == 2
    assert once("a", lambda: next(answers)) == 4


def test_a_trajectory_is_read_again_where_its_file_has_changed(tmp_path):
    path = tmp_path / "way.csv"

    def write(step):
        rows = "\n".join(f"{t},{step * t},0,0,0,0,90" for t in range(5))
        path.write_text(f"time,x,y,z,roll,pitch,heading\n{rows}\n", encoding="utf-8")

    write(1.0)
    with read_once():
        first = read_trajectory(path)
        assert read_trajectory(path) is first
        write(2.0)
        os.utime(path, ns=(1, 1))
        assert np.array_equal(read_trajectory(path).trajectory.place[:, 0], 2 * first.trajectory.place[:, 0])
    assert read_trajectory(path) is not read_trajectory(path)


# Rows of structured arrays moved whole are what numpy's own ways give


KINDS = {
    "packed": np.dtype([("X", "<i4"), ("flag", "u1"), ("time", "<f8"), ("rgb", "<u2", (3,))]),
    "padded": np.dtype([("flag", "u1"), ("time", "<f8")], align=True),
    "one field": np.dtype([("z", "<f8")]),
}


def made(kind: np.dtype, count: int, seed: int = 0) -> np.ndarray:
    records = np.zeros(count, kind)
    rng = np.random.default_rng(seed)
    for name in kind.names:
        records[name] = rng.integers(0, 200, records[name].shape)
    return records


@pytest.fixture(params=KINDS.values(), ids=KINDS)
def records(request) -> np.ndarray:
    return made(request.param, 50)


def test_rows_by_number_and_by_mask(records):
    rows = np.array([3, 3, 49, -1, 0])
    assert (record_rows(records, rows) == records[rows]).all() and record_rows(records, rows).dtype == records.dtype
    mask = np.arange(50) % 3 == 1
    assert (record_rows(records, mask) == records[mask]).all()
    assert len(record_rows(records, rows[:0])) == 0
    with pytest.raises(IndexError):
        record_rows(records, np.array([50]))


def test_what_is_given_back_is_a_copy(records):
    for copy in (record_rows(records, np.arange(50)), copied_records(records), joined_records([records])):
        before = records.copy()
        copy[records.dtype.names[0]] = 250
        assert (records == before).all()


def test_pieces_of_a_strided_array(records):
    every_other = records[::2]
    assert (copied_records(every_other) == every_other).all()
    assert (joined_records([every_other, records, records[:0]]) == np.concatenate([every_other, records])).all()


def test_put_tells_the_place_behind(records):
    target = made(records.dtype, 80, 1)
    wanted = target.copy()
    wanted[10:60] = records
    assert put_records(target, 10, records) == 60 and put_records(target, 60, records[:0]) == 60
    assert (target == wanted).all()


def test_what_does_not_fit_is_refused(records):
    with pytest.raises(ValueError, match="broadcast"):
        put_records(made(records.dtype, 20), 0, records)


# Points kept decoded: the same points as from the file, and only for as long as the file is the same


def survey(path, count, seed=0):
    """A LAZ file of `count` points."""
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = np.full(3, 0.001), np.array([1000.0, 2000.0, 0.0])
    rng = np.random.default_rng(seed)
    points = laspy.LasData(header)
    points.x, points.y, points.z = rng.uniform(0, 100, (3, count)) + np.array([[1000.0], [2000.0], [0.0]])
    points.gps_time = np.sort(rng.uniform(0, 50, count))
    points.write(path)
    return path


@pytest.fixture
def decodings(monkeypatch):
    """The files that are decoded, in order."""
    opened, original = [], laspy.open
    monkeypatch.setattr(laspy, "open", lambda path, *rest, **named: opened.append(str(path)) or original(
        path, *rest, **named))
    return opened


def all_records(cloud, size=700):
    return np.concatenate([chunk.array for chunk in iter_chunks(cloud, chunk_points=size)])


def test_files_are_decoded_once_and_give_the_same_points(tmp_path, decodings):
    cloud = open_cloud([survey(tmp_path / "a.laz", 2000), survey(tmp_path / "b.laz", 900, 1)])
    expected = all_records(cloud)
    del decodings[:]
    with decoded_once():
        assert np.array_equal(all_records(cloud), expected)
        assert np.array_equal(all_records(cloud, 333), expected)
        chunk = next(iter(iter_chunks(cloud, chunk_points=500)))
    assert len(decodings) == 2
    assert np.array_equal(chunk.x, expected["X"][:500] * 0.001 + 1000.0)
    assert np.array_equal(all_records(cloud), expected) and len(decodings) == 4


def test_what_was_not_read_to_its_end_is_decoded_again(tmp_path, decodings):
    cloud = open_cloud([survey(tmp_path / "a.laz", 2000)])
    with decoded_once():
        next(iter(iter_chunks(cloud, chunk_points=500)))
        assert len(all_records(cloud)) == 2000
        assert len(all_records(cloud)) == 2000
    assert len(decodings) == 4  # the header, the first points, the first chunk, all


def test_a_file_that_was_changed_is_decoded_again(tmp_path):
    path = survey(tmp_path / "a.laz", 2000)
    with decoded_once():
        before = all_records(open_cloud([path]))
        survey(path, 1500, 5)
        assert len(all_records(open_cloud([path]))) == 1500 < len(before)


def test_a_full_disk_costs_time_only(tmp_path, monkeypatch):
    cloud = open_cloud([survey(tmp_path / "a.laz", 2000)])
    expected = all_records(cloud)
    full = SimpleNamespace(disk_usage=lambda _folder: SimpleNamespace(free=100))
    for where, name, value in ((decoded_points.DecodedPoints, "_append", lambda _self, _part: False),
                               (decoded_points, "shutil", full)):
        with decoded_once(), monkeypatch.context() as patched:
            patched.setattr(where, name, value)
            assert np.array_equal(all_records(cloud), expected)
            assert np.array_equal(all_records(cloud), expected)
            assert not decoded_points.decoded_points()._places


def test_blocks_inside_each_other_share_the_points(tmp_path):
    with decoded_once():
        outer = decoded_points.decoded_points()
        with decoded_once():
            assert decoded_points.decoded_points() is outer
        assert decoded_points.decoded_points() is outer
    assert decoded_points.decoded_points() is None


def test_records_of_others_stay_in_a_layout(tmp_path):
    layout = PointLayout(open_cloud([cloud_file(tmp_path / "a.las", [0.0] * 3, 6, "somebody")]))
    assert [(vlr.user_id, vlr.record_data_bytes()) for vlr in layout.header.vlrs] == [("somebody", b"content")]
    packed = cloud_file(tmp_path / "b.laz", [0.0] * 3, 6, "copc")
    assert not PointLayout(open_cloud([packed])).header.vlrs
