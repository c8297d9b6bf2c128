"""What the command line says to input that it cannot use: one sentence, exit code 1, and earlier results whole.

All that can be wrong is gone through in tests/algorithms/test_building_bad_input.py; here is what a run of the
program adds: the exit code, what is printed, and what lies in the folder afterwards.
"""

from __future__ import annotations

import json
import os
import signal
import time
from pathlib import Path

import numpy as np
import pytest

EAST, NORTH = -7000.0, -35000.0
EARLIER = b"an earlier result"
FILES = {"OUTPUT": "models.gpkg", "OUTPUT_CITYJSON": "models.city.json", "OUTPUT_REPORT": "report.html"}


@pytest.fixture(scope="module")
def cloud(synthetic, make_cloud, tmp_path_factory):
    scene = synthetic.Scene([synthetic.flat(synthetic.rectangle(EAST, NORTH, 12, 15), 12.3)], spacing=0.6)
    return make_cloud(tmp_path_factory.mktemp("cloud") / "cloud.laz", *scene.points()[0].T)


def write_outlines(path, corner=(EAST, NORTH), size=(12.0, 15.0), epsg=6677):
    """A GeoJSON of one outline."""
    (x, y), (width, depth) = corner, size
    ring = [[x, y], [x + width, y], [x + width, y + depth], [x, y + depth], [x, y]]
    feature = {"type": "Feature", "properties": {"building_id": 1},
               "geometry": {"type": "Polygon", "coordinates": [ring]}}
    crs = {"type": "name", "properties": {"name": f"urn:ogc:def:crs:EPSG::{epsg}"}}
    path.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": [feature]}), encoding="utf-8")
    return path


def cut(path, source):
    path.write_bytes(source.read_bytes()[:source.stat().st_size // 2])
    return path


# Name: what to change of a good run (a function of the folder and the good cloud), and words of the answer.
CASES = {
    "another zone": (lambda folder, _: {"FOOTPRINTS": write_outlines(folder / "o.geojson", epsg=6676)},
                     "do not overlap"),
    "truncated": (lambda folder, cloud: {"POINTS": [cloud, cut(folder / "cut.laz", cloud)]}, "cut.laz"),
    "folder missing": (lambda folder, _: {"OUTPUT": folder / "missing" / "models.gpkg"}, "folder"),
}


@pytest.mark.parametrize("case", CASES)
def test_refusal(run_algorithm, cloud, tmp_path, case):
    change, words = CASES[case]
    folder = tmp_path / "results"
    folder.mkdir()
    for name in FILES.values():
        (folder / name).write_bytes(EARLIER)
    parameters = {"POINTS": [cloud], "FOOTPRINTS": write_outlines(tmp_path / "good.geojson"),
                  **{name: folder / file for name, file in FILES.items()}, **change(tmp_path, cloud)}
    done = run_algorithm("urbanmap:buildingsfromals", **parameters)
    assert done.code == 1
    assert words in done.err
    assert "Traceback" not in done.out + done.err
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == dict.fromkeys(FILES.values(), EARLIER)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGTERM for one process")
def test_ended_chain_leaves_earlier_results(linked_profile, make_cloud, tmp_path):
    random = np.random.default_rng(1)
    count = 3_000_000
    cloud = make_cloud(tmp_path / "cloud.las", EAST + random.uniform(0, 60, count),
                       NORTH + random.uniform(0, 60, count), random.uniform(0, 30, count))
    folder = tmp_path / "results"
    folder.mkdir()
    for name in FILES.values():
        (folder / name).write_bytes(EARLIER)
    outlines = write_outlines(tmp_path / "o.geojson", (EAST + 10, NORTH + 10), (40.0, 40.0))
    process = linked_profile().start(
        "run", "urbanmap:buildingsfromals", "--", f"POINTS={cloud}", f"FOOTPRINTS={outlines}",
        *(f"{name}={folder / file}" for name, file in FILES.items()))
    waited = ""
    while "Step: Segment buildings" not in waited and process.poll() is None:
        waited += process.stdout.readline()
    time.sleep(0.2)
    assert process.poll() is None, "the run ended before it could be interrupted"
    process.terminate()
    sent = time.monotonic()
    out, err = process.communicate(timeout=60)
    assert process.returncode == 1, out + err
    assert "The run was cancelled." in err
    assert "Traceback" not in out + err
    assert time.monotonic() - sent < 30
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == dict.fromkeys(FILES.values(), EARLIER)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no process groups with signals")
def test_ctrl_c_with_workers_ends_all_processes(linked_profile, make_cloud, tmp_path):
    """A terminal sends Ctrl-C to the workers too: they leave the answer to the main process and end with it."""
    random = np.random.default_rng(1)
    count = 2_000_000
    cloud = make_cloud(tmp_path / "cloud.las", EAST + random.uniform(0, 400, count),
                       NORTH + random.uniform(0, 400, count), random.uniform(0, 30, count))
    folder = tmp_path / "results"
    folder.mkdir()
    outlines = write_outlines(tmp_path / "o.geojson", (EAST + 10, NORTH + 10), (12.0, 300.0))
    process = linked_profile().start(
        "run", "urbanmap:segmentbuildings", "--", f"POINTS={cloud}", f"FOOTPRINTS={outlines}", "WORKERS=2",
        f"OUTPUT={folder / 'points.laz'}", f"OUTPUT_BUILDINGS={folder / 'buildings.gpkg'}", start_new_session=True)
    end = time.monotonic() + 60
    while not worker_runs(process.pid) and process.poll() is None and time.monotonic() < end:
        time.sleep(0.02)
    assert process.poll() is None, "the run ended before it could be interrupted"
    os.killpg(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 1, out + err
    assert "The run was cancelled." in err
    assert "Traceback" not in out + err
    assert list(folder.iterdir()) == []
    end = time.monotonic() + 20
    while group_runs(process.pid) and time.monotonic() < end:
        time.sleep(0.05)
    assert not group_runs(process.pid)


def worker_runs(group):
    """Whether a worker of a process group is at work on a piece: two processes spawned, and started."""
    spawned = 0
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command, own = (folder / "cmdline").read_text(errors="replace"), os.getpgid(int(folder.name))
        except OSError:  # it ended while being looked at
            continue
        spawned += own == group and "spawn_main" in command
    return spawned >= 2


def group_runs(group):
    """Whether a process of a group is there."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
