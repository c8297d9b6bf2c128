"""Classes written into LAZ files whose other layers are copied: what laspy reads, and the bytes that it would write."""

from __future__ import annotations

import laspy
import lazrs
import numpy as np
import pytest

from urbanmap_qgis.io.points.class_layers import class_writer, layers_can_stay
from urbanmap_qgis.io.points.pointcloud import PointLayout, can_be_entered, cloud_writer, iter_chunks, open_cloud
from urbanmap_qgis.mobile.gps_time import time_range
from urbanmap_qgis.mobile.markings.survey_points import sampled_span

N = 120_345
"""More than two chunks of 50,000 points."""


def attributes(rng, point_format):
    """Values that change from point to point in all layers, with several scanners' channels."""
    returns = rng.integers(1, 6, N)
    values = {"gps_time": np.cumsum(rng.integers(0, 3, N) * 1e-5), "intensity": rng.integers(0, 65_536, N),
              "number_of_returns": returns, "return_number": 1 + (returns * rng.random(N)).astype(int),
              "scanner_channel": rng.integers(0, 4, N), "classification": rng.integers(0, 12, N),
              "user_data": rng.integers(0, 3, N), "scan_angle": rng.integers(-9000, 9000, N),
              "point_source_id": rng.integers(0, 4, N), "edge_of_flight_line": rng.integers(0, 2, N),
              "withheld": rng.integers(0, 2, N), "overlap": rng.integers(0, 2, N)}
    for name in {7: ("red", "green", "blue"), 8: ("red", "nir")}.get(point_format, ()):
        values[name] = rng.integers(0, 65_536, N)
    return values


def places(rng):
    return rng.uniform(0, 300, N), rng.uniform(0, 300, N), rng.normal(20, 5, N)


def given_classes(cloud, output, of, piece, shape_only=True):
    """Write a cloud in pieces with the classes `of` (n,)."""
    start = 0
    with class_writer(output, cloud) as writer:
        for chunk in iter_chunks(cloud, chunk_points=piece, shape_only=shape_only, timed=shape_only):
            writer.write(chunk, of[start:start + len(chunk)])
            start += len(chunk)


def assert_same_but_classes(before, after, classes):
    for name in before.point_format.dimension_names:
        expected = classes if name == "classification" else before[name]
        assert np.array_equal(expected, after[name]), name


@pytest.mark.parametrize("point_format", [6, 7, 8])
@pytest.mark.parametrize("extra", [None, {"number": np.arange(N)}])
def test_all_layers_but_the_classes_stay_and_the_bytes_are_those_of_packing_all(tmp_path, make_cloud, point_format,
                                                                                extra):
    rng = np.random.default_rng(point_format)
    path = make_cloud(tmp_path / "all.laz", *places(rng), point_format=point_format, extra=extra,
                      **attributes(rng, point_format))
    cloud, classes = open_cloud([path]), rng.integers(0, 256, N).astype(np.uint8)
    assert layers_can_stay(cloud, tmp_path / "made.laz")
    given_classes(cloud, tmp_path / "made.laz", classes, 100_000)
    assert_same_but_classes(laspy.read(path), laspy.read(tmp_path / "made.laz"), classes)
    layout, start = PointLayout(cloud), 0
    with cloud_writer(tmp_path / "whole.laz", layout) as writer:
        for chunk in iter_chunks(cloud, chunk_points=100_000):
            view = layout.view(layout.adapt(chunk, np.ones(len(chunk), bool)))
            view.classification = classes[start:start + len(chunk)]
            start += len(chunk)
            writer.write(view.array)
    assert (tmp_path / "made.laz").read_bytes() == (tmp_path / "whole.laz").read_bytes()


def test_files_that_end_in_the_middle_of_a_chunk_become_one_with_chunks_of_several_lengths(tmp_path, make_cloud):
    rng = np.random.default_rng(1)
    corner = [np.array([-50.0, 300.0])] * 3  # one place for the offsets
    paths = []
    for number in range(3):
        x, y, z = (np.concatenate([ends, values]) for ends, values in zip(corner, places(rng)))
        paths.append(make_cloud(tmp_path / f"{number}.laz", x, y, z, intensity=rng.integers(0, 60_000, N + 2),
                                gps_time=5000.0 + 1000.0 * number + 0.001 * np.arange(N + 2), classification=number))
    cloud, classes = open_cloud(paths), rng.integers(0, 3, 3 * (N + 2)).astype(np.uint8)
    assert layers_can_stay(cloud, tmp_path / "made.laz")
    given_classes(cloud, tmp_path / "made.laz", classes, 250_000)
    after = laspy.read(tmp_path / "made.laz")
    before = [laspy.read(path) for path in paths]
    for name in after.point_format.dimension_names:
        expected = classes if name == "classification" else np.concatenate([one[name] for one in before])
        assert np.array_equal(expected, after[name]), name
    assert np.array_equal(after.header.maxs, np.max([one.header.maxs for one in before], axis=0))
    assert after.header.point_count == 3 * (N + 2)
    made = open_cloud([tmp_path / "made.laz"])
    assert not can_be_entered(made.headers[0]) and can_be_entered(cloud.headers[0])
    assert sampled_span(made) == time_range(made) == (5000.0, after.gps_time[-1])


def test_one_class_in_a_chunk_before_and_after(tmp_path, make_cloud):
    rng = np.random.default_rng(2)
    path = make_cloud(tmp_path / "all.laz", *places(rng), classification=6)
    for wanted in (np.full(N, 6, np.uint8), np.full(N, 2, np.uint8), np.repeat(np.uint8([1, 2, 9]), N // 3)):
        given_classes(open_cloud([path]), tmp_path / "made.laz", wanted, N)
        assert_same_but_classes(laspy.read(path), laspy.read(tmp_path / "made.laz"), wanted)


@pytest.mark.parametrize("case", ["las", "to las", "format 3", "scales", "chunks of LASzip's first way"])
def test_where_layers_cannot_stay_all_is_packed(tmp_path, make_cloud, case):
    rng = np.random.default_rng(3)
    name = "all.las" if case == "las" else "all.laz"
    paths = [make_cloud(tmp_path / name, *places(rng), point_format=3 if case == "format 3" else 6,
                        intensity=rng.integers(0, 65_536, N), classification=1)]
    if case == "scales":
        other = laspy.read(paths[0])
        other.change_scaling(scales=[0.01] * 3)
        other.write(tmp_path / "other.laz")
        paths.append(tmp_path / "other.laz")
    output = tmp_path / ("made.las" if case == "to las" else "made.laz")
    if case == "chunks of LASzip's first way":
        content = bytearray(paths[0].read_bytes())
        place = content.index(b"laszip encoded") + 52
        kinds = lazrs.LazVlr.new_for_compression(6, 0).record_data()
        assert content[place:place + 40] == kinds
        content[place + 38] = 4  # another version of the packing, which this package does not write
        paths[0].write_bytes(content)
        assert not layers_can_stay(open_cloud(paths), output)
        return
    cloud = open_cloud(paths)
    assert not layers_can_stay(cloud, output)
    classes = rng.integers(0, 20, N * len(paths)).astype(np.uint8)
    given_classes(cloud, output, classes, 50_001, shape_only=False)
    after = laspy.read(output)
    assert np.array_equal(after.classification, classes)
    assert np.array_equal(after.intensity, np.concatenate([laspy.read(path).intensity for path in paths]))


@pytest.mark.parametrize("output", ["made.laz", "made.las"])
def test_a_record_named_in_japanese_is_kept(tmp_path, make_cloud, output):
    rng = np.random.default_rng(5)
    path = make_cloud(tmp_path / "all.laz", *places(rng), classification=1)
    content, name = path.read_bytes(), "座標系".encode("shift_jis")
    place = content.index(b"LASF_Projection") + 20  # behind user, number and length of the record
    path.write_bytes(content[:place] + name.ljust(32, b"\0") + content[place + 32:])
    cloud = open_cloud([path])
    given_classes(cloud, tmp_path / output, np.full(N, 2, np.uint8), N, shape_only=output.endswith("z"))
    with laspy.open(tmp_path / output) as reader:
        assert name in [record.description for record in reader.header.vlrs]
        assert reader.header.parse_crs() == cloud.headers[0].parse_crs()


def test_points_that_were_not_given_leave_no_file(tmp_path, make_cloud):
    rng = np.random.default_rng(4)
    cloud = open_cloud([make_cloud(tmp_path / "all.laz", *places(rng), classification=1)])
    with pytest.raises(ValueError, match="not given"), class_writer(tmp_path / "made.laz", cloud) as writer:
        writer.write(next(iter_chunks(cloud, chunk_points=70_000)), np.ones(70_000, np.uint8))
    assert [path.name for path in tmp_path.iterdir()] == ["all.laz"]
