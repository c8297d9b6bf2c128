"""Reading and writing point clouds."""

import laspy
import numpy as np
import pytest

from urbanmap_qgis.errors import Cancelled, InputError, InsufficientDataError, OutputError
from urbanmap_qgis.io.points.pointcloud import (
    PointLayout,
    can_be_entered,
    cloud_writer,
    iter_chunks,
    open_cloud,
    read_all,
    valid_points,
)
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
