"""Work sent to a real Dask cluster of two processes: the same bytes, and a sentence where it cannot be."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

pytestmark = [pytest.mark.once, pytest.mark.skipif(importlib.util.find_spec("distributed") is None,
                                                   reason="distributed is not installed")]

NO_OUTPUTS = {"OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_BUILDINGS": "TEMPORARY_OUTPUT"}

SERVE = """
import sys
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=int(sys.argv[1]), threads_per_worker=1, processes=True, dashboard_address=None,
                      host=sys.argv[2], protocol=sys.argv[2].partition(":")[0]) as cluster:
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()
"""


@pytest.fixture(scope="module")
def serve(tmp_path_factory):
    """`serve(workers)`: address of a cluster that ends with the module; `config`: folder of Dask's configuration."""
    script = tmp_path_factory.mktemp("cluster") / "serve.py"
    script.write_text(SERVE, encoding="utf-8")
    started = []

    def start(workers, host="tcp://127.0.0.1", config=""):
        process = subprocess.Popen([sys.executable, str(script), str(workers), host], stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, text=True, cwd=script.parent,
                                   env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path),
                                        **({"DASK_CONFIG": str(config)} if config else {})})
        started.append(process)
        return process.stdout.readline().strip()

    start.started = started
    yield start
    for process in started:
        if process.poll() is None:
            process.communicate("", timeout=60)


@pytest.fixture(scope="module")
def pair(serve):
    """Address of a cluster of two workers, for tests that leave it as it is."""
    return serve(2)


@pytest.fixture(scope="module")
def town(synthetic, make_cloud, save_outlines, tmp_path_factory):
    folder = tmp_path_factory.mktemp("町")
    blocks = [synthetic.flat(synthetic.rectangle(40 * number, 0, 15, 12), 8.0 + number) for number in range(6)]
    points, _ = synthetic.Scene(blocks, noise=0.02).points()
    cloud = make_cloud(folder / "点群.laz", *points.T, number_of_returns=1, return_number=1)
    return {"POINTS": [str(cloud)],
            "FOOTPRINTS": str(save_outlines(folder / "外周.gpkg", [block.outline for block in blocks]))}


def test_a_cluster_gives_the_same_bytes(run, pair, town, tmp_path):
    for name, scheduler in (("here", ""), ("there", pair)):
        run("urbanmap:buildingsfromals", {
            **town, "OUTPUT": str(tmp_path / f"{name}.gpkg"), "SCHEDULER": scheduler, "OUTPUT_REPORT": None,
            "OUTPUT_CITYJSON": str(tmp_path / f"{name}.city.json")})
    here, there = ((tmp_path / f"{name}.city.json").read_text(encoding="utf-8") for name in ("here", "there"))
    assert here == there
    assert "building-6" in here
    from distributed import Client

    with Client(pair, set_as_default=False) as client:
        loaded = client.run(lambda: [name for name in __import__("sys").modules if name.endswith("model_stage")])
    assert any(loaded.values())  # the pieces did run there


def test_workers_with_other_sources_are_refused(plugin):
    cluster = plugin("algorithms.framework.running.cluster")
    errors = plugin("urbanmap_qgis.errors")

    class Stale:
        @staticmethod
        def run(_function):
            return {"tcp://elsewhere:1": "an older mark"}

    with pytest.raises(errors.InputError, match="restart the workers"):
        cluster._compare_sources(Stale)


def test_the_core_is_sent_once_with_its_mark(plugin, serve, monkeypatch):
    """A second run at the same time leaves the zip that workers import from as it is."""
    from distributed import Client

    cluster, packed = plugin("algorithms.framework.running.cluster"), []
    pack = cluster._pack_core

    def noted(archive, mark):
        pack(archive, mark)
        with zipfile.ZipFile(archive) as sent:
            name, = [name for name in sent.namelist() if name.endswith("urbanmap_qgis/sources_mark.txt")]
            packed.append((sent.read(name).decode(), mark))

    monkeypatch.setattr(cluster, "_pack_core", noted)
    address = serve(1)
    with Client(address, set_as_default=False) as first, Client(address, set_as_default=False) as second:
        cluster._send_core(first)
        cluster._send_core(second)
        cluster._compare_sources(second)
    (written, mark), = packed
    assert written == mark


def test_folders_that_workers_do_not_see_are_refused(plugin, serve, monkeypatch):
    cluster = plugin("algorithms.framework.running.cluster")
    errors = plugin("urbanmap_qgis.errors")

    class Blind:
        @staticmethod
        def run(_function, *_arguments):
            return {"tcp://elsewhere:1": False}

    with pytest.raises(errors.InputError, match="does not see the folder"):
        cluster._compare_storage(Blind, ["/"])


def test_other_packages_are_refused(plugin):
    cluster = plugin("algorithms.framework.running.cluster")
    errors = plugin("urbanmap_qgis.errors")

    class Older:
        @staticmethod
        def run(function, names):
            return {"tcp://elsewhere:1": {**function(names), "numpy": "1.0"}}

    with pytest.raises(errors.InputError, match=f"numpy 1.0 .{np.__version__}"):
        cluster._compare_versions(Older)


def test_nobody_at_the_address_is_one_sentence(run, plugin, town, monkeypatch):
    from qgis.core import QgsProcessingException

    monkeypatch.setattr(plugin("algorithms.framework.running.cluster"), "PATIENCE", 2)
    for address in ("tcp://127.0.0.1:9", "nonsense"):
        with pytest.raises(QgsProcessingException, match="No Dask scheduler"):
            run("urbanmap:segmentbuildings", {**town, **NO_OUTPUTS, "SCHEDULER": address})


def test_a_cluster_without_workers_is_refused(run, serve, town):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="no workers"):
        run("urbanmap:segmentbuildings", {**town, **NO_OUTPUTS, "SCHEDULER": serve(0)})


@pytest.fixture
def certificates(tmp_path):
    """Dask's settings `distributed.comm.tls`, with a certificate that nobody else has."""
    pytest.importorskip("cryptography", reason="cryptography, which makes the certificates, is not installed")
    from distributed.security import Security

    made, files = Security.temporary(), {}
    for name in ("tls_ca_file", "tls_client_cert", "tls_client_key"):
        files[name] = tmp_path / f"{name}.pem"
        files[name].write_text(getattr(made, name), encoding="ascii")
    pair = {"cert": str(files["tls_client_cert"]), "key": str(files["tls_client_key"])}
    return {"ca-file": str(files["tls_ca_file"]), "scheduler": pair, "worker": pair, "client": pair}


def test_a_cluster_with_tls_works_and_nobody_else_is_let_in(run, serve, town, certificates, tmp_path):
    """What the page on tiles advises: `tls://`, the certificates in Dask's configuration."""
    import dask
    from qgis.core import QgsProcessingException

    page = (Path(__file__).resolve().parents[2] / "docs" / "tiles.md").read_text(encoding="utf-8")
    assert all(word in page for word in ("without TLS runs whatever anybody sends", "`tls://host:8786`",
                                         "`distributed.comm.tls`", "never open its port to the internet"))
    settings = {"distributed": {"comm": {"tls": certificates}}}
    (tmp_path / "dask.yaml").write_text(json.dumps(settings), encoding="utf-8")
    address = serve(1, "tls://127.0.0.1", tmp_path / "dask.yaml")
    assert address.startswith("tls://")
    with dask.config.set({"distributed.comm.tls.ca-file": certificates["ca-file"],
                          **{f"distributed.comm.tls.client.{name}": certificates["client"][name]
                             for name in ("cert", "key")}}):
        found = run("urbanmap:segmentbuildings", {**town, **NO_OUTPUTS, "SCHEDULER": address})
    assert found["BUILDINGS"] == 6
    with pytest.raises(QgsProcessingException, match=r"no certificates here .*distributed\.comm\.tls"):
        run("urbanmap:segmentbuildings", {**town, **NO_OUTPUTS, "SCHEDULER": address})
    with pytest.raises(QgsProcessingException, match="No Dask scheduler answers"):
        run("urbanmap:segmentbuildings", {**town, **NO_OUTPUTS, "SCHEDULER": address.replace("tls:", "tcp:")})


def test_tiles_whose_pieces_go_to_a_cluster_are_the_same_bytes(run, pair, town, tmp_path, plugin, monkeypatch):
    cluster = plugin("algorithms.framework.running.cluster")
    connected = []
    monkeypatch.setattr(cluster, "_client", lambda address, make=cluster._client: connected.append(1) or make(address))
    for name, scheduler in (("here", ""), ("there", pair)):
        results = run("urbanmap:tiledrun", {
            **town, "ALGORITHM": "buildingsfromals", "TILE": 80, "BUFFER": 30, "SCHEDULER": scheduler,
            "OUTPUT": str(tmp_path / f"{name}.gpkg"), "OUTPUT_FOLDER": str(tmp_path / name)})
        assert (results["DONE"], results["FAILED"]) == (3, 0)
    here, there = (tmp_path / name / "merged" / "output.gpkg" for name in ("here", "there"))
    assert here.read_bytes() == there.read_bytes()
    assert len(connected) == 1  # one connection for the four stages of all tiles
    again = run("urbanmap:tiledrun", {
        **town, "ALGORITHM": "buildingsfromals", "TILE": 80, "BUFFER": 30, "OUTPUT": "TEMPORARY_OUTPUT",
        "OUTPUT_FOLDER": str(tmp_path / "there")})
    assert again["KEPT"] == 3  # where pieces were worked on is no matter for what is kept


def test_a_run_over_tiles_without_its_cluster_does_not_begin(run, plugin, town, tmp_path, monkeypatch):
    from qgis.core import QgsProcessingException

    monkeypatch.setattr(plugin("algorithms.framework.running.cluster"), "PATIENCE", 2)
    with pytest.raises(QgsProcessingException, match="No Dask scheduler"):
        run("urbanmap:tiledrun", {**town, "ALGORITHM": "buildingsfromals", "SCHEDULER": "tcp://127.0.0.1:9",
                                  "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_FOLDER": str(tmp_path / "run")})
    assert not (tmp_path / "run").exists()


def test_a_scheduler_that_is_lost_in_the_middle_ends_the_run(run, serve, town, tmp_path, plugin, monkeypatch):
    """Not every tile of the night waits for it and fails: the run ends, and a later one goes on."""
    from qgis.core import QgsProcessingException

    pool = plugin("algorithms.framework.tiles.tile_pool")
    cluster = plugin("algorithms.framework.running.cluster")
    address, work, connected = serve(2), pool.work_on_tile, []

    def and_then_lost(*arguments):
        record = work(*arguments)
        serve.started[-1].kill()
        serve.started[-1].wait()
        return record

    monkeypatch.setattr(pool, "work_on_tile", and_then_lost)
    monkeypatch.setattr(cluster, "PATIENCE", 3)
    monkeypatch.setattr(cluster, "_client", lambda address, make=cluster._client: connected.append(1) or make(address))
    settings = {**town, "ALGORITHM": "buildingsfromals", "TILE": 80, "BUFFER": 30, "OUTPUT": "TEMPORARY_OUTPUT",
                "OUTPUT_FOLDER": str(tmp_path / "run")}
    with pytest.raises(QgsProcessingException, match="(?s)cluster was lost.*run again"):
        run("urbanmap:tiledrun", {**settings, "SCHEDULER": address})
    assert len(list(tmp_path.glob("run/tiles/*/tile.json"))) == 1
    assert len(connected) <= 3  # at the start, by the tile that was at work, and to see whether all is lost
    monkeypatch.undo()
    again = run("urbanmap:tiledrun", settings)
    assert (again["KEPT"], again["DONE"], again["FAILED"]) == (1, 3, 0)
