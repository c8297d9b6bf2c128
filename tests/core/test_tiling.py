"""Tiles: every point, pixel and feature is one tile's own, and what was done is known again."""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import rasterio
import shapely
from pyproj import CRS

from tests.small_disk import small_disk
from urbanmap_qgis.citymodel.tiles.tile_content import TileBuilding
from urbanmap_qgis.citymodel.tiles.tile_scratch import append_building, stored_buildings
from urbanmap_qgis.errors import InputError, OutputError
from urbanmap_qgis.geometry.grid import Grid
from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all
from urbanmap_qgis.io.raster import read_raster, write_raster
from urbanmap_qgis.tiling.journal import (
    DONE,
    FAILED,
    TileRecord,
    checksum,
    damaged_output,
    fingerprint,
    kept_record,
    new_tile_folder,
    only_run,
    publish,
    require_room,
    tile_folder,
)
from urbanmap_qgis.tiling.mosaic_tiles import mosaic_tiles, write_tile_raster
from urbanmap_qgis.tiling.outline_sets import buffers_needed
from urbanmap_qgis.tiling.point_pieces import (
    FileIndex,
    all_inside,
    keep_own_points,
    point_file,
    sorted_into_pieces,
    write_tile_points,
)
from urbanmap_qgis.tiling.report import write_tiles_report
from urbanmap_qgis.tiling.result_counts import ResultCounts
from urbanmap_qgis.tiling.stretches import StretchGrid
from urbanmap_qgis.tiling.tile_grid import TileGrid

ROOT = Path(__file__).resolve().parents[2]
WKT = CRS.from_epsg(6677).to_wkt()
BOX = (-133.0, -71.0, 152.0, 214.0)


def random_points(count=4000, seed=3):
    """Points in the box, some of them exactly on corners and edges of 50 m tiles."""
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(BOX[0], BOX[2], count), rng.uniform(BOX[1], BOX[3], count)
    x[:20], y[10:30] = 50.0, -50.0
    return x.round(2), y.round(2), rng.uniform(0, 20, count).round(2)


def test_every_point_is_owned_by_one_tile():
    x, y, _ = random_points()
    grid = TileGrid(50.0, 7.0)
    tiles = grid.covering(BOX)
    owners = np.sum([tile.owns(x, y) for tile in tiles], axis=0)
    assert (owners == 1).all()
    column, row = grid.numbers(x, y)
    for tile in tiles:
        assert np.array_equal(tile.owns(x, y), (column == tile.column) & (row == tile.row))
        assert np.count_nonzero(tile.reads(x, y)) >= np.count_nonzero(tile.owns(x, y))
    assert len({tile.name for tile in tiles}) == len(tiles) == 7 * 7


@pytest.mark.parametrize(("size", "buffer"), [(0.0, 1.0), (10.5, 1.0), (50.0, -1.0), (float("nan"), 1.0)])
def test_grids_that_cannot_be_are_refused(size, buffer):
    with pytest.raises(InputError, match="whole number"):
        TileGrid(size, buffer)


def test_absurd_extents_are_refused():
    with pytest.raises(InputError, match="larger tiles"):
        TileGrid(10.0, 0.0).covering((0, 0, 1e7, 1e7))
    with pytest.raises(InputError, match="not a number"):
        TileGrid(10.0, 0.0).covering((0, 0, np.inf, 1))


@pytest.mark.slow
@pytest.mark.parametrize("sort", [False, True])
def test_a_tile_gets_its_points_and_all_own_points_are_all_points(make_cloud, tmp_path, sort):
    x, y, z = random_points()
    half = len(x) // 2
    files = [point_file(make_cloud(tmp_path / f"{name}.laz", x[part], y[part], z[part]))
             for name, part in (("東", slice(0, half)), ("west", slice(half, None)))]
    grid = TileGrid(50.0, 7.0)
    if sort:
        folders = [tmp_path / str(number) for number in range(2)]
        for folder in folders:
            folder.mkdir()
        files = [piece for file, folder in zip(files, folders) for piece in sorted_into_pieces(file, grid, folder)]
        assert sum(file.points for file in files) == len(x)
    own = 0
    for tile in grid.covering(BOX):
        path = tmp_path / f"tile {tile.name}.laz"
        count = write_tile_points(FileIndex(files).meeting(tile.outer), tile, path)
        assert count == np.count_nonzero(tile.reads(x, y))
        if not count:
            assert not path.exists()
            continue
        found = read_all(open_cloud([path]), ("x", "y", "z"))
        inside = tile.reads(x, y)
        assert np.allclose(np.sort(found["x"] * 1e5 + found["y"]), np.sort(x[inside] * 1e5 + y[inside]), atol=1e-3)
        own += keep_own_points(path, tile)
    assert own == len(x)


def test_points_of_a_building_go_with_their_building(make_cloud, tmp_path):
    tile = TileGrid(50.0, 10.0).tile(0, 0)
    x = np.array([10.0, 49.0, 52.0, 53.0, 20.0])
    path = make_cloud(tmp_path / "buildings.laz", x, np.full(5, 25.0), np.zeros(5),
                      extra={"building_id": np.array([1, 2, 1, 0, 0], np.uint32)})
    assert keep_own_points(path, tile, [1]) == 3
    assert sorted(read_all(open_cloud([path]), ("x",))["x"].tolist()) == [10.0, 20.0, 52.0]


@pytest.mark.slow
@pytest.mark.parametrize("cell", [0.5, 0.3, 1.7])
def test_a_raster_cut_into_tiles_is_put_together_as_it_was(tmp_path, cell):
    grid = Grid(-40.25, 61.7, cell, 170, 211)
    values = np.random.default_rng(5).normal(10, 3, grid.shape).astype(np.float32)
    values[30:50, 40:90] = np.nan
    write_raster(tmp_path / "whole.tif", values, grid, WKT)
    parts = []
    for tile in TileGrid(25.0, 4.0).covering(grid.bounds):
        path = tmp_path / f"{tile.name}.tif"
        if write_tile_raster(tmp_path / "whole.tif", tile.outer, path):
            parts.append((path, tile))
    mosaic_tiles(parts, tmp_path / "again.tif")
    again, place, crs = read_raster(tmp_path / "again.tif")
    assert place.shape == grid.shape
    assert np.allclose(place.bounds, grid.bounds, atol=1e-6)
    assert np.array_equal(again, values, equal_nan=True)
    assert CRS.from_wkt(crs).to_epsg() == 6677


def test_colour_images_are_cut_with_all_bands(tmp_path):
    pixels = np.random.default_rng(1).integers(0, 255, (3, 60, 80), np.uint8)
    with rasterio.open(tmp_path / "photo.tif", "w", driver="GTiff", width=80, height=60, count=3, dtype="uint8",
                       crs=CRS.from_epsg(6677).to_wkt(), transform=rasterio.Affine(0.5, 0, 0, 0, -0.5, 30)) as target:
        target.write(pixels)
    assert write_tile_raster(tmp_path / "photo.tif", (10.0, 5.0, 20.0, 15.0), tmp_path / "cut.tif")
    with rasterio.open(tmp_path / "cut.tif") as cut:
        assert np.array_equal(cut.read(), pixels[:, 30:50, 20:40])
    assert not write_tile_raster(tmp_path / "photo.tif", (100.0, 5.0, 120.0, 15.0), tmp_path / "none.tif")
    assert not (tmp_path / "none.tif").exists()


def test_rasters_whose_cells_do_not_meet_are_refused(tmp_path):
    write_raster(tmp_path / "a.tif", np.zeros((10, 10), np.float32), Grid(0, 10, 1.0, 10, 10), WKT)
    write_raster(tmp_path / "b.tif", np.zeros((10, 10), np.float32), Grid(10.4, 10, 1.0, 10, 10), WKT)
    with pytest.raises(InputError, match="other cells"):
        mosaic_tiles([(tmp_path / f"{name}.tif", TileGrid(10.0, 0.0).tile(column, 0))
                      for column, name in enumerate("ab")], tmp_path / "c.tif")
    assert not (tmp_path / "c.tif").exists()


def done_tile(folder, tile, state="s", status=DONE):
    (folder / "tiles").mkdir(exist_ok=True)
    with new_tile_folder(folder, tile) as made:
        (made / "output.gpkg").write_bytes(b"12345")
        record = TileRecord(tile.name, status, fingerprint=state, outputs={"output.gpkg": 5},
                            checksums={"output.gpkg": checksum(made / "output.gpkg")})
        publish(folder, tile, record, made)
    return record


def test_only_a_whole_tile_of_the_same_settings_is_kept(tmp_path):
    tile = TileGrid(50.0, 0.0).tile(1, -2)
    assert kept_record(tmp_path, tile, "s") is None
    record = done_tile(tmp_path, tile)
    assert kept_record(tmp_path, tile, "s") == record
    assert kept_record(tmp_path, tile, "other") is None
    (tile_folder(tmp_path, tile) / "output.gpkg").write_bytes(b"123")
    assert kept_record(tmp_path, tile, "s") is None
    done_tile(tmp_path, tile, status=FAILED)
    assert kept_record(tmp_path, tile, "s") is None
    (tile_folder(tmp_path, tile) / "tile.json").write_text("{", encoding="utf-8")
    assert kept_record(tmp_path, tile, "s") is None
    done_tile(tmp_path, tile)
    path = tile_folder(tmp_path, tile) / "tile.json"
    path.write_text(path.read_text(encoding="utf-8").replace('"seconds": 0.0', '"seconds": ' + "9" * 400))
    assert "999" in path.read_text(encoding="utf-8") and kept_record(tmp_path, tile, "s") is None


def record_text(**changes):
    made = {"name": "50_-100", "status": "done", "fingerprint": "s", "outputs": {"output.gpkg": 5},
            "checksums": {"output.gpkg": hashlib.sha256(b"12345").hexdigest()}, **changes}
    return json.dumps({name: value for name, value in made.items() if value != "gone"})


@pytest.mark.parametrize("text", [
    "", "[]", "5", "null", '"x"', "[" * 100_000, "\x00" * 400, "{}", record_text(outputs=5), record_text(outputs=[]),
    record_text(outputs=None), record_text(outputs={"output.gpkg": "5"}), record_text(outputs={"../x": 5}),
    record_text(checksums="gone"), record_text(checksums={"output.gpkg": 5}),
    record_text(checksums={"output.gpkg": "0"}),
    record_text(figures=[1]), record_text(figures={"a": "b"}),
    record_text(figures={"a": float("-inf")}), record_text(cpu=float("nan")), record_text(seconds="long"),
    record_text(memory=None), record_text(status=["done"]), record_text(reason=None), record_text(name="0_0"),
    record_text(more=1)])
def test_a_record_that_is_damaged_is_a_tile_not_done(tmp_path, text):
    tile = TileGrid(50.0, 0.0).tile(1, -2)
    done_tile(tmp_path, tile)
    place = tile_folder(tmp_path, tile) / "tile.json"
    place.write_text(record_text(), encoding="utf-8")
    assert kept_record(tmp_path, tile, "s") is not None
    place.write_text(text, encoding="utf-8")
    assert kept_record(tmp_path, tile, "s") is None
    place.unlink()
    place.mkdir()
    assert kept_record(tmp_path, tile, "s") is None
    done_tile(tmp_path, tile)  # and it can be done again
    assert kept_record(tmp_path, tile, "s") is not None


def test_a_file_in_the_place_of_a_folder(tmp_path):
    tile = TileGrid(50.0, 0.0).tile(1, -2)
    done_tile(tmp_path, tile)
    folder = tile_folder(tmp_path, tile)
    shutil.rmtree(folder)
    folder.write_bytes(b"x")
    folder.with_name(folder.name + ".part").write_bytes(b"x")
    assert kept_record(tmp_path, tile, "s") is None
    done_tile(tmp_path, tile)
    assert kept_record(tmp_path, tile, "s") is not None
    for name in ("merged", "inputs", "pieces"):
        (tmp_path / name).write_bytes(b"a letter of the user's")
        with pytest.raises(OutputError, match="is a file where the run needs a folder"), only_run(tmp_path):
            pass
        (tmp_path / name).unlink()


def test_results_of_the_same_size_but_other_bytes_are_seen(tmp_path):
    tile = TileGrid(50.0, 0.0).tile(1, -2)
    record = done_tile(tmp_path, tile)
    assert damaged_output(tmp_path, tile, record) == ""
    (tile_folder(tmp_path, tile) / "output.gpkg").write_bytes(b"12\x0045")
    assert damaged_output(tmp_path, tile, record) == "output.gpkg"
    assert kept_record(tmp_path, tile, "s") is None


def test_an_interrupted_tile_leaves_nothing(tmp_path):
    tile = TileGrid(50.0, 0.0).tile(0, 0)
    done_tile(tmp_path, tile)
    with pytest.raises(KeyboardInterrupt), new_tile_folder(tmp_path, tile) as made:
        (made / "output.gpkg").write_bytes(b"half")
        raise KeyboardInterrupt
    assert kept_record(tmp_path, tile, "s") is not None
    assert [item.name for item in (tmp_path / "tiles").iterdir()] == [tile.name]


def test_a_vanished_folder_of_the_run_is_not_made_again(tmp_path):
    tile = TileGrid(50.0, 0.0).tile(0, 0)
    with pytest.raises(OutputError, match="not there any more"), new_tile_folder(tmp_path / "share", tile):
        pass
    with pytest.raises(OutputError, match="no room"):
        require_room(tmp_path / "share")
    assert not (tmp_path / "share").exists()


def test_room_is_seen(tmp_path):
    (tmp_path / "tiles").mkdir()
    require_room(tmp_path)
    with pytest.raises(OutputError, match="kept"), small_disk(tmp_path / "tiles", "512k"):
        require_room(tmp_path)
    assert not list((tmp_path / "tiles").iterdir())


def test_the_fingerprint_follows_files_and_settings(tmp_path):
    file = tmp_path / "a.txt"
    file.write_text("a")
    first = fingerprint({"TILE": 500}, [file])
    assert fingerprint({"TILE": 500}, [file]) == first
    assert fingerprint({"TILE": 400}, [file]) != first
    file.write_text("ab")
    assert fingerprint({"TILE": 500}, [file]) != first


def test_two_runs_in_one_folder_are_refused(tmp_path):
    hold = ("import sys\nfrom pathlib import Path\nfrom urbanmap_qgis.tiling.journal import only_run\n"
            "with only_run(Path(sys.argv[1])):\n    print('held', flush=True)\n    sys.stdin.read()\n")
    with subprocess.Popen([sys.executable, "-c", hold, str(tmp_path)], cwd=ROOT, stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE) as other:
        assert other.stdout.readline().strip() == b"held"
        with pytest.raises(OutputError, match="Another run"), only_run(tmp_path):
            pass
        other.communicate(b"")
    with only_run(tmp_path):
        pass


def test_files_are_met_by_their_boxes(make_cloud, tmp_path):
    near = point_file(make_cloud(tmp_path / "near.laz", np.array([1.0, 9.0]), np.array([1.0, 9.0]), np.zeros(2)))
    far = point_file(make_cloud(tmp_path / "far.laz", np.array([101.0, 109.0]), np.array([1.0, 9.0]), np.zeros(2)))
    assert FileIndex([near, far]).meeting((0, 0, 50, 50)) == [near]
    assert FileIndex([near, far]).meeting((20, 20, 50, 50)) == []


# Outlines that are moved together, and the buffer that holds them


def test_a_row_across_tiles_needs_a_buffer_to_its_end():
    grid = TileGrid(100.0, 20.0)
    row = [shapely.box(x, 40, x + 10, 50) for x in range(60, 250, 14)]  # gaps of 4 m, to x = 252
    alone = [shapely.box(20, 20, 30, 30), None, shapely.Polygon(), shapely.box(930, 930, 940, 940)]
    outlines = np.array([*row, *alone], dtype=object)
    tiles = [grid.tile(column, 0) for column in range(3)]
    needed = buffers_needed(outlines, grid, tiles, 5.0)
    end = max(shape.bounds[2] for shape in row)
    by_tile = (end - 100, max(100 - 60, end - 200), 200 - 60)
    expected = [by_tile[int(shape.centroid.x // 100)] for shape in row]
    assert np.allclose(needed[:len(row)], expected)
    assert needed[len(row)] == 0 and np.isnan(needed[len(row) + 1:]).all()
    assert (buffers_needed(outlines, grid, tiles, 3.0)[:len(row)] <= 10).all()


def test_the_order_of_outlines_does_not_matter():
    generator = np.random.default_rng(3)
    corners = generator.uniform(0, 300, (80, 2))
    outlines = shapely.box(*corners.T, *(corners + 9).T)
    grid = TileGrid(100.0, 10.0)
    tiles = grid.covering((0, 0, 310, 310))
    order = generator.permutation(80)
    assert np.array_equal(buffers_needed(outlines, grid, tiles, 5.0)[order],
                          buffers_needed(outlines[order], grid, tiles, 5.0))


# Counts of a run over tiles: what is good, doubtful and missing, in the verdict of its report


def verdict_of(tmp_path, results, statuses=(DONE, DONE)):
    grid = TileGrid(10.0, 0.0)
    tiles = grid.covering((0.5, 0.5, 19.5, 9.5))
    assert len(tiles) == 2
    records = [TileRecord(tile.name, status, seconds=1.0) for tile, status in zip(tiles, statuses)]
    write_tiles_report(tmp_path / "report.html", "Run", {}, grid, tiles, records, 0, {}, results)
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    return re.search(r'<p class="verdict (\w+)">(.*?)</p>', text).groups()


@pytest.mark.parametrize("statuses, grade, words", [
    ({"ok": 5}, "good", "5 buildings: 5 ok, 0 doubtful, 0 failed. All 2 tiles are done."),
    ({"ok": 4, "low": 2, "not modelled": 1}, "look", "7 buildings: 4 ok, 2 doubtful, 1 failed. The field “status”"),
    ({"not modelled": 3}, "bad", "3 buildings: 0 ok, 0 doubtful, 3 failed."),
])
def test_the_verdict_is_about_buildings(tmp_path, statuses, grade, words):
    found = verdict_of(tmp_path, ResultCounts.of("buildings", statuses, ("ok",), ("not modelled",)))
    assert found[0] == grade and words in found[1]


def test_a_failed_tile_is_told_behind_the_buildings(tmp_path):
    results = ResultCounts.of("walls", {"ok": 2}, ("ok",), ())
    grade, text = verdict_of(tmp_path, results, (DONE, FAILED))
    assert grade == "bad" and text.startswith("2 walls: 2 ok, 0 doubtful.") and "1 of 2 tiles failed" in text


def test_results_without_a_status_tell_of_the_tiles_alone(tmp_path):
    assert verdict_of(tmp_path, None) == ("good", "All 2 tiles are done.")


# Buildings of tiles in scratch files: what comes back is what went in


def building(seed):
    random = np.random.default_rng(seed)
    attributes = {"id": f"棟 {seed}", "height": 0.1 + 0.2, "floors": 2**40, "known": None, "flat": True,
                  "uses": ["住宅", {"type": "店舗"}], "far": float("inf")}
    return TileBuilding(attributes, {"roof": random.normal(4e6, 1e6, (seed, 3, 3)),
                                     "image:a b.jpg": np.ones((2, 3, 3))},
                        {"image:a b.jpg": random.random((2, 3, 2))})


def test_buildings_come_back_as_they_went_in(tmp_path):
    path = tmp_path / "cell"
    for seed in (3, 1, 2, 0):
        append_building(path, building(seed))
    append_building(path, TileBuilding({}, {}, {}))
    found = list(stored_buildings(path))
    assert found[-1].attributes == {} and found[-1].triangles == {}
    for seed, read in zip((3, 1, 2, 0), found):
        made = building(seed)
        assert read.attributes == made.attributes
        assert list(read.triangles) == list(made.triangles) and list(read.places) == list(made.places)
        for look in made.triangles:
            assert np.array_equal(read.triangles[look], made.triangles[look])
        assert np.array_equal(read.places["image:a b.jpg"], made.places["image:a b.jpg"])


@pytest.mark.parametrize("left", [2, 40, -1])
def test_a_file_that_is_cut_off_is_told(tmp_path, left):
    path = tmp_path / "cell"
    append_building(path, building(2))
    path.write_bytes(path.read_bytes()[:left])
    with pytest.raises(OutputError, match="cut off"):
        list(stored_buildings(path))


# Stretches of a drive: every point is one stretch's own by its time, also where the drive crosses itself


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
