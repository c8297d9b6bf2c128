"""The dock in the hands of a stranger: folders with blanks, runs over loaded files, stopped, moved, updated, closed."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.gui.sitting import NEEDS_DESKTOP, profile_with_packages, windows

pytestmark = [pytest.mark.slow, NEEDS_DESKTOP]


@pytest.fixture(scope="module")
def sitting(small_city, tmp_path_factory):
    """The report of one sitting, its folder, and how QGIS ended ("" if well)."""
    folder = tmp_path_factory.mktemp("stranger")
    city = folder / "現場 データ" / "第 3 工区 (東)"
    shutil.copytree(small_city, city)
    profile = profile_with_packages(folder)
    (folder / "task.json").write_text(json.dumps({
        "city": str(city), "moved": str(folder / "移動先 2" / "第 3 工区"), "report": str(folder / "report.json"),
        "helpers": str(Path(__file__).parent)}), encoding="utf-8")
    ended, started = "", time.monotonic()
    try:
        windows().open_desktop(Path(__file__).with_name("stranger_journey.py"), folder, profile,
                               longest=400.0, URBANMAP_STRANGER=str(folder / "task.json"))
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as error:
        ended = str(error)
    print(f"{time.monotonic() - started:.0f} s", ended)
    return json.loads((folder / "report.json").read_text(encoding="utf-8")), folder, ended


@pytest.fixture
def told(sitting):
    def step(name: str) -> dict:
        report = sitting[0]
        assert name in report, f"QGIS ended before the step {name}"
        assert "error" not in report[name], report[name]["error"]
        return report[name]

    return step


def test_the_dock_is_there_once_however_often_it_is_opened(told):
    assert told("twice")["seen"] == [[True], [False], [True], [False], [True]]


def test_a_folder_with_blanks_and_no_system_of_the_project(told):
    found = told("bare")
    assert found["states"] == {"buildings": "done"} and found["told"].startswith("All steps are done.")
    (name, size, file, crs), = found["layers"]
    assert name == "Building models" and size > 5 and "第 3 工区 (東)" in file and crs == "EPSG:6677"
    assert found["job"].endswith("第 3 工区 (東).urbanmap.json")


def test_a_run_over_loaded_files_shows_the_new_ones(told):
    found = told("over_itself")
    assert found["between"] == {"buildings": "planned"} and found["states"] == {"buildings": "done"}
    (name, size, _, crs), = found["layers"]
    assert name == "Building models" and size > 5 and crs == "EPSG:6677"


def test_relative_paths_are_of_the_folder_that_qgis_works_in(told):
    found = told("by_relative_paths")
    assert found["found"] == ["結果 1.gpkg", "結果 1.laz"]


def test_stopped_in_the_middle_it_goes_on_later(told):
    found = told("stopped_and_resumed")
    assert found["stopped"] == {"buildings": "planned"} and found["told"] == "Stopped." and found["hidden"] == []
    assert found["states"] == {"buildings": "done"} and found["again"].startswith("All steps are done.")


def test_a_job_moves_with_its_data(told):
    found = told("moved_with_its_data")
    assert found["opened"] == found["states"] == {"buildings": "done"}
    assert found["elsewhere"] == [] and found["there"] and found["outputs"] >= 3


def test_the_plugin_is_updated_while_a_step_runs(told):
    found = told("updated_while_running")
    assert found["busy"] and found["docks"] == [True] and found["opened"] == {"buildings": "planned"}
    assert found["states"] == {"buildings": "done"} and found["told"].startswith("All steps are done.")


def test_the_plugin_is_updated_with_open_dialogs(told):
    # QGIS 3.40 ended with signal 11 where a hidden dialog asked its algorithm for the provider that was gone.
    assert told("updated_with_open_dialogs") == {"before": 0, "busy": True, "left": 0, "states": {"buildings": "done"}}


def test_qgis_ends_while_a_step_runs(sitting, told):
    folder = sitting[1]
    found = told("closed_while_running")
    assert found["busy"] and len(found["asked"]) == 1 and found["told"] == "Stopped."
    job, = (folder / "移動先 2").glob("*/*.urbanmap.json")
    assert [step["state"] for step in json.loads(job.read_text(encoding="utf-8"))["steps"]] == ["planned"]
    assert not [path for path in job.parent.rglob(".*") if path.is_file()]


def test_qgis_ends_well(sitting, told):
    # QGIS 3.40.6 alone ends with signal 11 after such threads; the plugin ends them before (its pooled_threads.py).
    assert told("logins_asked_for") == {"shortened": sys.version_info >= (3, 13), "raised": []}
    assert not sitting[2]


def test_nothing_was_raised(sitting):
    assert sitting[0]["raised"] == []
