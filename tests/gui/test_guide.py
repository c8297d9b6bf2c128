"""The dock in QGIS's desktop: the sample city dropped on it, buildings wished for, run, loaded, opened again."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.gui.sitting import NEEDS_DESKTOP, profile_with_packages, windows

pytestmark = [pytest.mark.slow, NEEDS_DESKTOP]


@pytest.fixture(scope="module")
def told(small_city, tmp_path_factory):
    """What the steps of one sitting gave, by name."""
    folder = tmp_path_factory.mktemp("guide")
    shutil.copytree(small_city, folder / "city")
    profile = profile_with_packages(folder)
    (folder / "task.json").write_text(json.dumps({
        "city": str(folder / "city"), "report": str(folder / "report.json"),
        "helpers": str(Path(__file__).parent)}), encoding="utf-8")
    try:
        windows().open_desktop(Path(__file__).with_name("guide_journey.py"), folder, profile,
                               URBANMAP_GUIDE=str(folder / "task.json"))
    except subprocess.CalledProcessError as error:
        print(error)  # the steps that it came to are in the report; the others fail
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))

    def step(name: str) -> dict:
        assert name in report, f"QGIS ended before the step {name}"
        assert "error" not in report[name], report[name]["error"]
        return report[name]

    return step


def test_dropped_folder_is_told(told):
    assert told("opened") == {"visible": True, "steps": {}}
    found = told("dropped")
    assert {"Point cloud (4)", "Camera (1)", "GNSS navigation (1)"} <= set(found["groups"])
    assert found["boxes"] > 50 and "all fits together" in found["fit"]


def test_chain_is_planned_and_kept_beside_the_data(told):
    found = told("planned")
    assert found["steps"] == {"buildings": ["to run", ""]} and found["missing"].startswith("Nothing is missing.")
    assert found["kept"] and found["job"].endswith("city/city.urbanmap.json")
    assert found["first"] == [True, ""]


def test_run_loads_results_with_style_and_verdict(told):
    found = told("ran")
    state, verdict = found["steps"]["buildings"]
    assert state == "done" and "buildings" in verdict and found["moves"] > 2 and found["report"]
    (name, size, renderer), = found["layers"]
    assert name == "Building models" and size > 5 and renderer == "categorizedSymbol"
    assert "1 of 1: Buildings from ALS" in found["told"][0] and found["told"][1:] == [
        f"All steps are done.\n{verdict}"] * 2


def test_results_viewer_leaves_the_steps_their_room(told):
    found = told("listed")
    assert found["opened"] and not found["hidden"] and found["after"] > 0.9 * found["before"]


def test_opened_again_nothing_is_done_anew(told):
    found = told("reopened")
    assert found["empty"] == {} and found["steps"]["buildings"][0] == found["after"]["buildings"][0] == "done"
    assert len(found["layers"]) == 1


def test_step_opens_filled_in_and_keeps_settings(told):
    found = told("tuned")
    assert "als.laz" in found["filled"]["POINTS"] and "gsi_buildings.gpkg" in found["filled"]["FOOTPRINTS"]
    assert found["untouched"] == {} and found["kept"] == 30.0
    assert found["steps"]["buildings"][0] == "to run"


def test_cancel_stops_and_nothing_counts_as_done(told):
    found = told("cancelled")
    assert len(found["before"]) > 2 and all(state == "to run" for state, _ in found["after"].values())
    assert found["told"] == "Stopped." and found["seconds"] < 30


def test_what_is_unticked_is_missing(told):
    found = told("unticked")
    assert "Airborne laser points" in found["missing"] and not found["run"] and found["left_out"] == 2


def test_a_file_is_used_as_the_user_says(told):
    found = told("used")
    assert not found["before"] and found["offered"] == ["as recognised", "Airborne laser points", "Mobile survey"]
    assert found["played"] == "Mobile survey 1"
    played, kept, missing, can_run = found["said"]
    assert played == "Airborne laser points" and list(kept.values()) == ["als"] and can_run
    assert missing.startswith("Nothing is missing.") and [Path(source).name for source in kept] == ["survey_01.laz"]
    played, kept, missing, can_run = found["again"]
    assert played == "Mobile survey 1" and kept == {} and "Airborne laser points" in missing and not can_run


def test_table_of_another_program_is_imported(told):
    found = told("imported")
    encoding, delimiter, skip, columns = found["guessed"]
    assert (encoding, delimiter, skip) == ("cp932", ";", 1) and "heading" not in columns and len(columns) == 6
    assert not found["refused"][0] and "No column is chosen for heading" in found["refused"][1]
    assert found["written"] and found["given"] == 1 and found["head"] == "time,x,y,z,roll,pitch,heading"
    assert len(found["kept"]) == 7


def test_table_in_degrees_is_laid_into_the_system_of_the_job(told):
    found = told("placed")
    assert found["offered"] == "EPSG:6677" and "m east" in found["place"]
    assert found["shown"] == [True, True, True, False, True]
    assert not found["refused"][0] and "what the heights count from" in found["refused"][1]
    assert found["written"] and "above the ellipsoid" in found["told"]
    assert max(map(abs, found["off"])) < 0.001


def test_a_table_that_only_the_user_can_tell_is_opened_from_the_list(told):
    found = told("previewed")
    assert "Cannot be used:" in found["said"] and "may count north or east" in found["said"]
    assert found["target"] == "als_control" and found["told"].startswith("X座標 is taken as counting north")
    assert found["place"] == "First place: -7000.500 m east, -34000.500 m north."
    assert found["written"] and found["lines"] == ["id,x,y,z,role", "A,-7000.5,-34000.5,3,標定点"]


def test_a_job_that_another_window_changed_is_not_written_over(told):
    found = told("changed_elsewhere")
    assert found["kept"] and "was changed by another window" in found["told"]


def test_plugin_goes_with_the_dock_open(told):
    assert told("unloaded") == {"left": [], "again": True}


def test_nothing_was_raised(told):
    assert told("raised") == []
