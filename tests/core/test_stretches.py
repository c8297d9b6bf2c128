"""Stretches of a drive: every point is one stretch's own by its time, also where the drive crosses itself."""

from __future__ import annotations

import numpy as np
import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all
from urbanmap_qgis.tiling.point_pieces import (
    FileIndex,
    all_inside,
    keep_own_points,
    point_file,
    sorted_into_pieces,
    write_tile_points,
)
from urbanmap_qgis.tiling.stretches import StretchGrid


def drive():
    """There and back on one street of 520 m at 10 m/s, with a stop of 20 s on the way; from the second 1000."""
    time = np.arange(0.0, 124.1, 0.1)
    way = np.interp(time, [0, 30, 50, 124], [0, 300, 300, 1040])
    x = np.where(way < 520, way, 1040 - way)
    return time + 1000.0, np.column_stack([x, np.zeros_like(x), np.zeros_like(x)])


def test_stretches_share_the_drive():
    grid = StretchGrid.along(*drive(), 200.0, 30.0)
    tiles = grid.covering((0.0, -5.0, 520.0, 5.0))
    assert [tile.name for tile in tiles] == [f"stretch_{number:05d}" for number in range(5)]
    assert tiles[0].core_times[0] == -np.inf and tiles[-1].core_times[1] == np.inf
    for before, after in zip(tiles, tiles[1:]):
        assert before.core_times[1] == after.core_times[0]
        assert after.read[0] == pytest.approx(after.core_times[0] - 3.0, abs=0.2)
    assert tiles[1].core_times == pytest.approx((1020.0, 1060.0), abs=0.2)  # with the stop in it
    assert tiles[4].core_times[0] == pytest.approx(1100.0, abs=0.2)  # 240 m: no stretch of 40 m is left over
    assert all(tile.square.area > 10 * 190 for tile in tiles[:1])


@pytest.mark.parametrize("sort", [False, True])
def test_points_go_by_their_time(make_cloud, tmp_path, sort):
    time, place = drive()
    rng = np.random.default_rng(4)
    when = np.concatenate([np.sort(rng.uniform(time[0], time[-1], 5000)), [time[0] - 0.5, time[-1] + 0.5]])
    x = np.interp(when, time, place[:, 0]) + rng.normal(0, 5, len(when))
    cloud = make_cloud(tmp_path / "survey.laz", x, rng.normal(0, 5, len(when)), np.zeros(len(when)), gps_time=when)
    grid, files = StretchGrid.along(time, place, 200.0, 30.0), [point_file(cloud)]
    if sort:
        (tmp_path / "pieces").mkdir()
        files = sorted_into_pieces(files[0], grid, tmp_path / "pieces")
        assert len(files) == 5 and sum(file.points for file in files) == len(when)
    own = []
    for tile in grid.covering(files[0].bounds if not sort else point_file(cloud).bounds):
        path = tmp_path / f"{tile.name}.laz"
        near = FileIndex(files).meeting(tile.outer)
        assert not all_inside(near, tile)
        count = write_tile_points(near, tile, path)
        assert count == np.count_nonzero((when >= tile.read[0]) & (when < tile.read[1]))
        keep_own_points(path, tile)
        own.append(read_all(open_cloud([path]), ("gps_time",))["gps_time"])
    assert np.allclose(np.sort(np.concatenate(own)), np.sort(when))


def test_a_short_drive_is_one_stretch():
    time, place = drive()
    tile, = StretchGrid.along(time, place, 5000.0, 10.0).covering((0, 0, 1, 1))
    assert tile.core_times == tile.read == (-np.inf, np.inf)


def test_points_without_times_are_told(make_cloud, tmp_path):
    cloud = make_cloud(tmp_path / "no_times.las", *np.zeros((3, 10)), point_format=0)
    grid = StretchGrid.along(*drive(), 200.0, 30.0)
    with pytest.raises(InputError, match="no GPS time"):
        write_tile_points([point_file(cloud)], grid.tile(0, 0), tmp_path / "out.laz")
