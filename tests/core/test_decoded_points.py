"""Points kept decoded: the same points as from the file, and only for as long as the file is the same."""

from types import SimpleNamespace

import laspy
import numpy as np
import pytest

from urbanmap_qgis.io.points import decoded_points
from urbanmap_qgis.io.points.decoded_points import decoded_once
from urbanmap_qgis.io.points.pointcloud import iter_chunks, open_cloud


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


def records(cloud, size=700):
    return np.concatenate([chunk.array for chunk in iter_chunks(cloud, chunk_points=size)])


def test_files_are_decoded_once_and_give_the_same_points(tmp_path, decodings):
    cloud = open_cloud([survey(tmp_path / "a.laz", 2000), survey(tmp_path / "b.laz", 900, 1)])
    expected = records(cloud)
    del decodings[:]
    with decoded_once():
        assert np.array_equal(records(cloud), expected)
        assert np.array_equal(records(cloud, 333), expected)
        chunk = next(iter(iter_chunks(cloud, chunk_points=500)))
    assert len(decodings) == 2
    assert np.array_equal(chunk.x, expected["X"][:500] * 0.001 + 1000.0)
    assert np.array_equal(records(cloud), expected) and len(decodings) == 4


def test_what_was_not_read_to_its_end_is_decoded_again(tmp_path, decodings):
    cloud = open_cloud([survey(tmp_path / "a.laz", 2000)])
    with decoded_once():
        next(iter(iter_chunks(cloud, chunk_points=500)))
        assert len(records(cloud)) == 2000
        assert len(records(cloud)) == 2000
    assert len(decodings) == 3  # the header, the first chunk, all


def test_a_file_that_was_changed_is_decoded_again(tmp_path):
    path = survey(tmp_path / "a.laz", 2000)
    with decoded_once():
        before = records(open_cloud([path]))
        survey(path, 1500, 5)
        assert len(records(open_cloud([path]))) == 1500 < len(before)


def test_a_full_disk_costs_time_only(tmp_path, monkeypatch):
    cloud = open_cloud([survey(tmp_path / "a.laz", 2000)])
    expected = records(cloud)
    full = SimpleNamespace(disk_usage=lambda _folder: SimpleNamespace(free=100))
    for where, name, value in ((decoded_points.DecodedPoints, "_append", lambda _self, _part: False),
                               (decoded_points, "shutil", full)):
        with decoded_once(), monkeypatch.context() as patched:
            patched.setattr(where, name, value)
            assert np.array_equal(records(cloud), expected)
            assert np.array_equal(records(cloud), expected)
            assert not decoded_points.decoded_points()._places


def test_blocks_inside_each_other_share_the_points(tmp_path):
    with decoded_once():
        outer = decoded_points.decoded_points()
        with decoded_once():
            assert decoded_points.decoded_points() is outer
        assert decoded_points.decoded_points() is outer
    assert decoded_points.decoded_points() is None
