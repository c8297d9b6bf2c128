"""The sample city's folder as a whole: truth, order, cancel, refusals. (The sensors have tests of their own.)"""

import json
import sqlite3
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
import rasterio
import shapely

from urbanmap_qgis.errors import Cancelled, InputError, OutputError
from urbanmap_qgis.progress import Progress
from urbanmap_qgis.samplecity import write
from urbanmap_qgis.samplecity.scene.world import make_scene

QUICK = ("als", "footprints")


@pytest.fixture
def quick(monkeypatch):
    """Only the quick sensors."""
    monkeypatch.setattr(write, "SENSORS", {name: write.SENSORS[name] for name in QUICK})


def files(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.slow
def test_same_files_whoever_makes_them(quick, tmp_path):
    """Also in a folder that is there already, and empty."""
    told: list[float] = []
    (tmp_path / "alone").mkdir()
    write.make_city(tmp_path / "alone", 60, seed=3, progress=Progress(report=told.append))
    assert told == sorted(told) and told[-1] == 1.0 and len(told) > 4
    alone = files(tmp_path / "alone")
    assert {"README.txt", "als/als.laz", "truth/ground.tif", "truth/markings.gpkg", "truth/roofs.gpkg"} <= set(alone)
    for name, pool in (("threads", ThreadPoolExecutor(2)),
                       ("process", ProcessPoolExecutor(1, mp_context=get_context("spawn")))):
        with pool:
            write.make_city(tmp_path / name, 60, seed=3, executor=pool)
        assert alone == files(tmp_path / name)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["alone", "process", "threads"]


@pytest.mark.slow
@pytest.mark.parametrize("together", [False, True])
def test_cancel_leaves_nothing(quick, tmp_path, together):
    def cancelled():
        return any(tmp_path.glob(".*/als"))

    with ThreadPoolExecutor(2) as executor, pytest.raises(Cancelled):
        write.make_city(tmp_path / "city", 60, progress=Progress(cancelled=cancelled),
                        executor=executor if together else None)
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@pytest.mark.parametrize("together", [False, True])
def test_an_error_of_one_sensor_stops_all_and_leaves_nothing(quick, tmp_path, monkeypatch, together):
    def fail(*_):
        raise OutputError("The disk is full: make room.")

    sensors = {**write.SENSORS, "footprints": write.Sensor(fail, 1, 0.1, "fails")}
    monkeypatch.setattr(write, "SENSORS", sensors)
    with ThreadPoolExecutor(2) as executor, pytest.raises(OutputError, match="disk is full"):
        write.make_city(tmp_path / "city", 60, executor=executor if together else None)
    assert not list(tmp_path.iterdir())


def test_messages_of_workers_arrive(quick, tmp_path, monkeypatch):
    def talk(_scene, _folder, _seed, progress):
        progress.message("one\nline")
        progress.warn("注意")
        return {"building_of": {}}

    monkeypatch.setattr(write, "SENSORS", {"footprints": write.Sensor(talk, 1, 1.0, "talks")})
    messages, warnings = [], []
    with ThreadPoolExecutor(2) as executor:
        write.make_city(tmp_path / "city", 60, progress=Progress(message=messages.append, warn=warnings.append),
                        executor=executor)
    assert messages == ["one line"] and warnings == ["注意"]


def test_places_that_cannot_be_used_are_refused(quick, tmp_path):
    full = tmp_path / "full"
    full.mkdir()
    (full / "mine.txt").write_text("keep")
    (tmp_path / "file").write_text("keep")
    for folder in (full, tmp_path / "file", tmp_path / "missing" / "city", tmp_path / "file" / "city"):
        with pytest.raises(OutputError):
            write.make_city(folder, 60)
    assert (full / "mine.txt").read_text() == "keep"
    with pytest.raises(InputError):
        write.make_city(tmp_path / "city", -5)


@pytest.mark.slow
def test_truth_is_the_scene_s(quick, tmp_path):
    write.make_city(tmp_path / "city", 60, "repainted", 3)
    scene = make_scene(60, "repainted", 3)
    truth = tmp_path / "city" / "truth"
    with rasterio.open(truth / "ground.tif") as raster:
        heights, west, north, cell = raster.read(1), raster.transform.c, raster.transform.f, raster.transform.a
        assert raster.crs.to_epsg() == 6677
    row, column = np.random.default_rng(1).integers(0, min(heights.shape), (2, 1000))
    expected = scene.ground_height(west + (column + 0.5) * cell, north - (row + 0.5) * cell)
    np.testing.assert_allclose(heights[row, column], expected, atol=1e-5)
    with sqlite3.connect(truth / "markings.gpkg") as connection:
        counts = [connection.execute(f"SELECT COUNT(*) FROM {name}").fetchone()[0] for name in ("aerial", "mms")]
    assert counts == [len(scene.markings_at("aerial")), len(scene.markings_at("ground"))]
    with sqlite3.connect(truth / "areas.gpkg") as connection:
        blobs = dict(connection.execute("SELECT kind, geom FROM areas"))
    road = shapely.from_wkb(blobs["carriageway"][8:])
    x, y = np.random.default_rng(2).uniform(-30, 30, (2, 20000)) + np.array(scene.ground.origin)[:, None]
    clear = np.abs(scene.ground.kerb_distance(x, y)) > 0.01
    np.testing.assert_array_equal(shapely.contains_xy(road, x, y)[clear], (scene.surface_kind(x, y) == 1)[clear])
    facts = json.loads((truth / "summary.json").read_text(encoding="utf-8"))
    assert facts["city"]["buildings"] == len(scene.buildings) and facts["scene"] == "repainted"
