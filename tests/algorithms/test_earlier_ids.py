"""Ids of earlier versions: hidden from toolbox and modeller, run as before, and name what does their work now.

That each runs and gives the same again is seen by the runs of every_algorithm.py.
"""

from __future__ import annotations

import pytest

SHOWN = 48
MERGED = {"loadgsibuildings": "loadgsi", "loadgsidem": "loadgsi", "checkvectormap": "checkmodel",
          "checkcitymodel": "checkmodel", "checkaccuracy": "acceptance", "filtervehicles": "orthorectifyframes",
          "satellitevisibility": "localisationaccuracy", "landmarkupdate": "adjustsurveys", "mesh25d": "buildingmodels"}
ELSEWHERE = {"runjob", "aerialmarkings_model", "buildingsfromals_model", "georeferencemms_model", "lanemap_model",
             "roadspace_model"}
"""Not in the toolbox, but in the guide and in the menu."""


@pytest.fixture
def listed(qgis_app):
    from qgis.core import QgsApplication

    return {item.name(): item for item in QgsApplication.processingRegistry().providerById("urbanmap").algorithms()}


def test_the_toolbox_shows_one_algorithm_for_one_task(listed):
    shown = {name for name, item in listed.items() if not item.flags() & item.Flag.FlagHideFromToolbox}
    assert len(shown) <= SHOWN
    assert set(listed) - shown == set(MERGED) | ELSEWHERE


@pytest.mark.parametrize(("earlier", "today"), MERGED.items())
def test_each_earlier_id_names_its_successor(listed, feedback, plugin, earlier, today):
    algorithm = listed[earlier].create()
    assert today == algorithm.SUCCESSOR and not listed[today].create().SUCCESSOR
    assert algorithm.flags() & algorithm.Flag.FlagDeprecated == algorithm.Flag.FlagDeprecated
    sentence, = plugin("algorithms.framework.declaring.retired").succession(algorithm, feedback)
    assert f"urbanmap:{earlier}" in sentence and f"urbanmap:{today}" in sentence


def test_a_run_says_once_what_does_its_work_now(run, tmp_path):
    (tmp_path / "map.osm").write_text('<osm version="0.6"/>', encoding="utf-8")
    with pytest.raises(Exception, match="no lanelets"):
        run("urbanmap:checkvectormap", {"INPUT": str(tmp_path / "map.osm"), "OUTPUT": "memory:"})
    assert [text for text in run.feedback.warnings if "earlier versions" in text] == [
        "urbanmap:checkvectormap is an id of earlier versions: “Check city model or lane map” (urbanmap:checkmodel) "
        "does this now; give that."]


def test_parameters_of_earlier_ids_are_those_of_the_contract(listed):
    taken = {"loadgsibuildings": {"INPUT", "CRS", "OUTPUT"}, "loadgsidem": {"INPUT", "CRS", "OUTPUT"},
             "checkvectormap": {"INPUT", "OUTPUT", "OUTPUT_REPORT"},
             "checkcitymodel": {"INPUT", "EXCLUDE", "OUTPUT", "OUTPUT_REPORT"},
             "checkaccuracy": {"CONTROL", "TRAJECTORY", "CORRECTED", "OUTPUT", "OUTPUT_REPORT"}}
    for name, wanted in taken.items():
        algorithm = listed[name].create()
        assert wanted <= {item.name() for item in algorithm.parameterDefinitions()}, name
        required = {item.name() for item in algorithm.parameterDefinitions()
                    if not item.flags() & item.Flag.FlagOptional}
        assert "OUTPUT" in required, name


def test_gsi_data_of_both_kinds_are_loaded_in_one_run(run, small_city, tmp_path):
    """Each kind as its own id loads it; of a file of one kind the other is left out."""
    from tests.core import gsi_dem_writer as writer

    folder = tmp_path / "gsi"
    folder.mkdir()
    outlines = small_city / "footprints" / "FG-GML-533946-BldA-20240401-0001.xml"
    (folder / outlines.name).write_bytes(outlines.read_bytes())
    (folder / "FG-GML-5339-46-11-DEM5A-20161001.xml").write_text(
        writer.dem_xml("53394611", ["地表面,12.50"] * (150 * 225), 150, 225), encoding="utf-8")
    both = run("urbanmap:loadgsi", {"INPUT_FOLDER": str(folder), "OUTPUT_BUILDINGS": str(tmp_path / "both.gpkg"),
                                    "OUTPUT_GROUND": str(tmp_path / "both.tif")})
    alone = run("urbanmap:loadgsibuildings", {"INPUT": str(outlines), "OUTPUT": str(tmp_path / "alone.gpkg")})
    ground = run("urbanmap:loadgsidem", {"INPUT": str(folder), "OUTPUT": str(tmp_path / "alone.tif")})
    assert (both["BUILDINGS"], both["MESHES"]) == (alone["BUILDINGS"], ground["MESHES"]) == (both["BUILDINGS"], 1)
    assert (tmp_path / "both.tif").read_bytes() == (tmp_path / "alone.tif").read_bytes()
    one = run("urbanmap:loadgsi", {"INPUT": str(outlines), "OUTPUT_BUILDINGS": str(tmp_path / "one.gpkg"),
                                   "OUTPUT_GROUND": str(tmp_path / "one.tif")})
    assert one["BUILDINGS"] == alone["BUILDINGS"] and "MESHES" not in one


def test_a_survey_is_judged_by_its_control_points_in_one_run(run, small_city, tmp_path):
    """As in two runs of earlier versions: residuals first, then the judgement on them."""
    drive = {"TRAJECTORY": str(small_city / "mms" / "survey_01_trajectory.csv"), "CRS": "EPSG:6677"}
    control = next((small_city / "control").glob("*.csv"), None) or next(small_city.rglob("*control*.csv"))
    first = run("urbanmap:checkaccuracy", {**drive, "CONTROL": str(control), "OUTPUT": str(tmp_path / "r.gpkg")})
    second = run("urbanmap:acceptance", {"INPUT": first["OUTPUT"], "OUTPUT_CSV": str(tmp_path / "two.csv")})
    once = run("urbanmap:acceptance", {**drive, "INPUT": str(control), "OUTPUT_CSV": str(tmp_path / "one.csv")})
    assert once["MEAN_2D"] == first["MEAN_2D"] and once["POINTS_USED"] == first["POINTS_USED"]
    assert once["RMSE_PLAN"] == pytest.approx(second["RMSE_PLAN"], abs=1e-9) and once["OUTCOME"] == second["OUTCOME"]
    assert (tmp_path / "one.csv").read_bytes() == (tmp_path / "two.csv").read_bytes()
