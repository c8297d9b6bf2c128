"""What goes wrong at night: a full disk, a share that vanishes, a fault of ours. A sentence, and nothing is lost."""

from __future__ import annotations

import numpy as np
import pytest

from tests.small_disk import mount, small_disk

SIDE = 40


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
        results = run_tiles(run, town, tmp_path / "run")
    finally:
        away.rename(town["folder"])
    assert (results["DONE"], results["FAILED"]) == (1, 3)
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
    results = run_tiles(run, town, tmp_path / "run")
    assert (results["DONE"], results["FAILED"]) == (3, 1)
    assert any("no such thing" in text and "fault.txt" in text for text in run.feedback.warnings)
    fault, = tmp_path.glob("run/tiles/*/fault.txt")
    assert "TypeError" in fault.read_text(encoding="utf-8")
