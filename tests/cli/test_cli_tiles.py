"""A run over tiles in real processes: workers that are killed, a cluster. Killed runs: test_cli_soak.py."""

from __future__ import annotations

import importlib.util
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import shapely

from .conftest import arguments_of

TILE = 40


@pytest.fixture(scope="module")
def town(synthetic, make_cloud, tmp_path_factory):
    """Six buildings, one a tile, in two files of half the area each."""
    folder = tmp_path_factory.mktemp("町")
    plans = [synthetic.rectangle(TILE * column + 12, TILE * row + 12, 16, 14)
             for column in range(3) for row in range(2)]
    blocks = [synthetic.flat(plan, 8.0 + number) for number, plan in enumerate(plans)]
    points, _ = synthetic.Scene(blocks, noise=0.02).points()
    clouds = [make_cloud(folder / f"{number}.laz", *part.T, return_number=1, number_of_returns=1)
              for number, part in enumerate(np.array_split(points[np.argsort(points[:, 0])], 2))]
    outlines = folder / "外周.geojson"
    outlines.write_text(json.dumps({
        "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::6677"}},
        "features": [{"type": "Feature", "properties": {"名": f"家{number}"},
                      "geometry": json.loads(shapely.to_geojson(plan))} for number, plan in enumerate(plans)]},
        ensure_ascii=False), encoding="utf-8")
    return {"POINTS": clouds, "FOOTPRINTS": outlines}


def settings(town, folder, workers):
    return {"ALGORITHM": "buildingsfromals", **town, "TILE": TILE, "BUFFER": 20, "WORKERS": workers,
            "MIN_ROOF_AREA": 20, "OUTPUT": folder / "tiles.gpkg", "OUTPUT_FOLDER": folder / "run"}


def workers_of(process):
    """Numbers of the processes that a run started for tiles, in Linux's list of processes."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            parent = int(re.search(r"^PPid:\s*(\d+)", (folder / "status").read_text(), re.MULTILINE).group(1))
            if parent == process and b"spawn_main" in (folder / "cmdline").read_bytes():
                found.append(int(folder.name))
        except (OSError, AttributeError):  # it has ended meanwhile
            continue
    return found


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the list of processes is Linux's")
def test_a_killed_worker_costs_no_tile(linked_profile, town, tmp_path):
    profile = linked_profile()
    process = profile.start("run", "urbanmap:tiledrun", "--", *arguments_of(settings(town, tmp_path, 2)),
                            start_new_session=True)
    until = time.monotonic() + 300
    while len(list(tmp_path.glob("run/tiles/*/tile.json"))) < 2:
        assert process.poll() is None and time.monotonic() < until
        time.sleep(0.05)
    os.kill(workers_of(process.pid)[0], signal.SIGKILL)
    _, err = process.communicate()
    assert process.returncode == 0, err
    records = [json.loads(path.read_text(encoding="utf-8")) for path in tmp_path.glob("run/tiles/*/tile.json")]
    assert [record["status"] for record in records] == ["done"] * 6


SERVE = """
import sys
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()
"""


@pytest.mark.once
@pytest.mark.skipif(importlib.util.find_spec("distributed") is None, reason="distributed is not installed")
def test_pieces_of_tiles_go_to_a_cluster_from_a_linked_folder(linked_profile, town, tmp_path):
    """Two processes of tiles here, each with its own way to the cluster's two workers."""
    script = tmp_path / "serve.py"
    script.write_text(SERVE, encoding="utf-8")
    cluster = subprocess.Popen([sys.executable, str(script)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                               cwd=tmp_path, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
    address = cluster.stdout.readline().strip()
    try:
        done = linked_profile().run_algorithm("urbanmap:tiledrun", **settings(town, tmp_path, 2), SCHEDULER=address,
                                              ESTIMATE=4)
    finally:
        cluster.communicate("", timeout=60)
    assert done.code == 0, done.err
    assert (done.results["DONE"], done.results["FAILED"]) == (4, 0)


def test_a_stage_without_the_setting_is_told(run_algorithm, town, tmp_path):
    done = run_algorithm("urbanmap:tiledrun", **{**settings(town, tmp_path, 1), "MIN_ROFF_AREA": 3, "ESTIMATE": 1})
    assert done.code == 0
    assert "MIN_ROFF_AREA" in done.out + done.err
    assert "Unknown parameter MIN_ROOF_AREA" not in done.out + done.err
