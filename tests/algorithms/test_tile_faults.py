"""What goes wrong at night: a full disk, a share that vanishes, a fault of ours. A sentence, and nothing is lost."""

from __future__ import annotations

import json
import os
import signal
from collections import Counter

import numpy as np
import pytest

from tests.small_disk import mount, small_disk

SIDE = 40

pytestmark = pytest.mark.once


@pytest.fixture(scope="module")
def town(qgis_app, synthetic, make_cloud, save_outlines, tmp_path_factory):
    """Four plain buildings, one a tile, in a folder that can vanish."""
    folder = tmp_path_factory.mktemp("share") / "入力"
    folder.mkdir()
    blocks = [synthetic.flat(synthetic.rectangle(SIDE * column + 12, 12, 14, 12), 8.0 + column) for column in range(4)]
    points, _ = synthetic.Scene(blocks, noise=0.02).points()
    files = [make_cloud(folder / f"{number}.laz", *part.T, number_of_returns=1, return_number=1)
             for number, part in enumerate(np.array_split(points[np.argsort(points[:, 0])], 4))]
    outlines = save_outlines(folder.parent / "outlines.gpkg", [block.outline for block in blocks])
    return {"POINTS": [str(file) for file in files], "FOOTPRINTS": str(outlines), "folder": folder}


def run_tiles(run, town, folder, **more):
    return run("urbanmap:tiledrun", {
        "ALGORITHM": "buildingsfromals", "POINTS": town["POINTS"], "FOOTPRINTS": town["FOOTPRINTS"], "TILE": SIDE,
        "BUFFER": 10, "SETTINGS": "MIN_ROOF_AREA=20", "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_FOLDER": str(folder),
        **more})


def run_with_failures(run, town, folder, **more):
    """Counts of the tiles' statuses after a run that must end with an error, its results in their places."""
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="of 4 tiles failed; all others are in"):
        run_tiles(run, town, folder, **more)
    return Counter(json.loads(path.read_text(encoding="utf-8"))["status"] for path in folder.glob("tiles/*/tile.json"))


@pytest.fixture
def after_first_tile(plugin, monkeypatch):
    """`after_first_tile(action)`: done when the first tile is."""
    pool = plugin("algorithms.framework.tiles.tile_pool")

    def arrange(action):
        work, done = pool.work_on_tile, []

        def and_then(*arguments):
            record = work(*arguments)
            if not done:
                action()
            done.append(record.name)
            return record

        monkeypatch.setattr(pool, "work_on_tile", and_then)

    yield arrange


def test_a_full_disk_ends_the_run_and_more_room_lets_it_go_on(run, town, tmp_path):
    from qgis.core import QgsProcessingException

    folder = tmp_path / "disk"
    with small_disk(folder, "900k"):
        with pytest.raises(QgsProcessingException, match="room"):
            run_tiles(run, town, folder)
        whole = list(folder.glob("tiles/*/tile.json"))
        assert not list(folder.glob("tiles/*.part")) and not (folder / "merged" / "output.gpkg").exists()
        mount("-o", "remount,size=64m", str(folder))
        results = run_tiles(run, town, folder)
        assert (results["DONE"], results["FAILED"]) == (4, 0) and results["KEPT"] >= len(whole)


def test_inputs_that_vanish_fail_their_tiles_alone(run, town, tmp_path, after_first_tile, monkeypatch):
    away = town["folder"].with_name("away")
    after_first_tile(lambda: town["folder"].rename(away))
    try:
        count = run_with_failures(run, town, tmp_path / "run", OUTPUT=str(tmp_path / "tiles.gpkg"))
    finally:
        away.rename(town["folder"])
    assert count == {"done": 1, "failed": 3}
    assert (tmp_path / "tiles.gpkg").is_file() and (tmp_path / "run" / "merged" / "output.gpkg").is_file()
    assert sum("入力" in text or ".laz" in text for text in run.feedback.warnings) >= 3
    monkeypatch.undo()
    again = run_tiles(run, town, tmp_path / "run")
    assert (again["KEPT"], again["DONE"], again["FAILED"]) == (1, 4, 0)


def test_a_folder_of_the_run_that_vanishes_ends_it(run, town, tmp_path, after_first_tile, monkeypatch):
    from qgis.core import QgsProcessingException

    folder, away = tmp_path / "run", tmp_path / "away"
    after_first_tile(lambda: folder.rename(away))
    with pytest.raises(QgsProcessingException, match="not there any more"):
        run_tiles(run, town, folder)
    assert not folder.exists()  # a local disk is not filled in the place of the share
    away.rename(folder)
    monkeypatch.undo()
    again = run_tiles(run, town, folder)
    assert (again["KEPT"], again["DONE"]) == (1, 4)


def test_a_fault_of_ours_fails_one_tile(run, plugin, town, tmp_path, monkeypatch):
    work = plugin("algorithms.framework.tiles.tile_work")
    make = work._make

    def faulty(job, *arguments):
        if job.tile.column == 2:
            raise TypeError("no such thing")
        return make(job, *arguments)

    monkeypatch.setattr(work, "_make", faulty)
    assert run_with_failures(run, town, tmp_path / "run") == {"done": 3, "failed": 1}
    assert any("fault.txt in the tile" in text for text in run.feedback.warnings)
    fault, = tmp_path.glob("run/tiles/*/fault.txt")
    assert "TypeError" in fault.read_text(encoding="utf-8")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT for one process")
def test_a_signal_inside_a_tile_ends_the_run(run, plugin, town, tmp_path, monkeypatch, number):
    """The tile is a run in the run: its handler must not be the only one that hears."""
    from qgis.core import QgsProcessingException

    stage = plugin("algorithms.buildings.segmentroofs").SegmentRoofs
    compute, done = stage.compute, []

    def interrupted(self, *arguments):
        done.append(1)
        if len(done) == 2:
            os.kill(os.getpid(), number)
        return compute(self, *arguments)

    before = signal.getsignal(number)
    monkeypatch.setattr(stage, "compute", interrupted)
    with pytest.raises(QgsProcessingException, match="cancelled"):
        run_tiles(run, town, tmp_path / "run")
    assert signal.getsignal(number) is before
    assert len(list(tmp_path.glob("run/tiles/*/tile.json"))) == 1 and not list(tmp_path.glob("run/tiles/*.part"))
    monkeypatch.undo()
    again = make_run(run)(town, tmp_path / "run")
    assert (again["KEPT"], again["DONE"], again["FAILED"]) == (1, 4, 0)


def make_run(run):
    """Runs with a feedback that nobody has cancelled."""
    import processing

    from .conftest import make_feedback

    return lambda town, folder: run_tiles(lambda name, parameters: processing.run(
        name, parameters, feedback=make_feedback()), town, folder)


def zero(path):
    """Fifty kilobytes of a file gone, its size the same."""
    data = bytearray(path.read_bytes())
    start = min(len(data) // 3, max(len(data) - 50_000, 0))
    data[start:start + 50_000] = bytes(len(data[start:start + 50_000]))
    path.write_bytes(data)


def test_a_kept_tile_with_lost_bytes_is_done_again(run, town, read_layer, tmp_path):
    folder = tmp_path / "run"
    run_tiles(run, town, folder)
    merged = folder / "merged" / "output.gpkg"
    before = merged.read_bytes()
    zero(sorted(folder.glob("tiles/*/output.gpkg"))[1])
    again = run_tiles(run, town, folder)
    assert (again["KEPT"], again["DONE"]) == (3, 4) and merged.read_bytes() == before


def test_bytes_lost_before_the_end_are_seen_when_tiles_are_put_together(run, town, tmp_path, after_first_tile,
                                                                       read_layer, monkeypatch):
    folder = tmp_path / "run"
    after_first_tile(lambda: zero(next(folder.glob("tiles/*/output.gpkg"))))
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="1 of 4 tiles failed"):
        run_tiles(run, town, folder, OUTPUT=str(tmp_path / "tiles.gpkg"))
    statuses = {row.attributes["status"]: row.attributes["reason"] for row in read_layer(tmp_path / "tiles.gpkg")}
    assert "not as it was written" in statuses["failed"]
    merged = [row.attributes for row in read_layer(folder / "merged" / "output.gpkg")]
    assert len(merged) == 4  # as many rows as outlines
    assert sum("not as it was written" in (row["reason"] or "") for row in merged) == 1
    monkeypatch.undo()
    again = run_tiles(run, town, folder)
    assert (again["KEPT"], again["DONE"], again["FAILED"]) == (3, 4, 0)


def test_a_layer_that_cannot_be_read_to_its_end_is_refused(plugin, polygon_layer, tmp_path):
    """Merging reads features until QGIS gives no more, which it also does where a page is damaged."""
    from qgis.core import QgsVectorFileWriter

    merge = plugin("algorithms.framework.tiles.tile_merge")
    errors = plugin("urbanmap_qgis.errors")
    squares = [f"POLYGON (({x} 0, {x} 1, {x + 1} 1, {x + 1} 0, {x} 0))" for x in range(3000)]
    path = tmp_path / "output.gpkg"
    QgsVectorFileWriter.writeAsVectorFormat(polygon_layer(squares, fields={"a": ["x" * 40] * 3000}), str(path), "utf-8",
                                            driverName="GPKG")
    assert len(merge.features_in(path)) == 3000
    data = path.read_bytes()
    met = 0
    for start in range(40_000, len(data) - 60_000, 40_000):
        path.write_bytes(data[:start] + bytes(50_000) + data[start + 50_000:])
        try:
            met += len(merge.features_in(path)) != 3000
        except errors.OutputError:
            continue
    assert not met


def test_tiles_of_another_version_are_done_again(run, plugin, town, tmp_path, monkeypatch):
    run_tiles(run, town, tmp_path / "run")
    monkeypatch.setattr(plugin("algorithms.framework.tiles.tiled_inputs"), "sources_mark", lambda: "an older one")
    again = run_tiles(run, town, tmp_path / "run")
    assert (again["KEPT"], again["DONE"]) == (0, 4)


def test_damaged_records_do_not_end_a_run(run, town, tmp_path):
    folder = tmp_path / "run"
    run_tiles(run, town, folder)
    first, second, third, _ = sorted(folder.glob("tiles/*"))
    (first / "tile.json").write_text('{"name": 5, "outputs": 7}')
    (second / "tile.json").write_bytes(bytes(400))
    for file in third.iterdir():
        file.unlink()
    third.rmdir()
    third.write_bytes(b"x")
    again = run_tiles(run, town, folder)
    assert (again["KEPT"], again["DONE"], again["FAILED"]) == (1, 4, 0)


def test_outlines_that_a_buffer_parts_are_told(run, town, save_outlines, synthetic, tmp_path):
    """The four buildings stand 26 m apart: no row. Outlines with gaps of 3 m are one."""
    run_tiles(run, town, tmp_path / "apart")
    assert not any("moved together" in text for text in run.feedback.warnings)
    row = save_outlines(tmp_path / "row.gpkg", [synthetic.rectangle(SIDE * column + 2, 12, SIDE - 3, 12)
                                                for column in range(4)])
    run_tiles(run, {**town, "FOOTPRINTS": str(row)}, tmp_path / "row", OUTPUT_REPORT=str(tmp_path / "report.html"))
    told = [text for text in run.feedback.warnings if "moved together" in text]
    assert len(told) == 1 and "4 of 4 outlines" in told[0] and "a buffer of 119 m" in told[0]
    assert "4 / 4" in (tmp_path / "report.html").read_text(encoding="utf-8")
