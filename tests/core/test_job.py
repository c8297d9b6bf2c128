"""What fits together, which file plays which part, the chain for a wish, and the job's file."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.conversion.reprojection import epsg_wkt
from urbanmap_qgis.io.pages.report import LOOK, Report
from urbanmap_qgis.job.agreement import common_system, disagreements, extent_in_degrees
from urbanmap_qgis.job.chain_plan import WISHES, PlannedStep, plan_chain, wishes
from urbanmap_qgis.job.file_facts import FileFacts
from urbanmap_qgis.job.job_file import DONE, FAILED, PLANNED, JobStep, planned_job, read_job, write_job
from urbanmap_qgis.job.job_progress import (
    done_step,
    failed_step,
    file_state_of,
    is_up_to_date,
    refreshed_job,
    resolved_parameters,
    time_remaining,
    verdict_of,
)
from urbanmap_qgis.job.job_report import write_job_report
from urbanmap_qgis.job.recognition.contents import recognise_files
from urbanmap_qgis.job.roles import Parts, parts_of

TOKYO, OSAKA = epsg_wkt(6677), epsg_wkt(6674)


def facts(name, kind, crs=TOKYO, extent=(0.0, 0.0, 100.0, 100.0), **more):
    return FileFacts(Path("/data") / name, kind, crs_wkt=crs, extent=extent, **more)


def test_what_fits_gives_no_sentence(small_city):
    assert disagreements(recognise_files([small_city])) == []


def test_systems_places_and_heights_that_differ_are_told():
    home = [facts("a.laz", "points"), facts("b.gpkg", "outlines"), facts("t.csv", "trajectory", crs="")]
    assert disagreements(home) == []
    far = facts("far.laz", "points", extent=(9000.0, 0.0, 9100.0, 100.0))
    told, = disagreements([*home, far])
    assert "far.laz" in told and "9 km" in told
    systems = disagreements([*home, facts("o.gpkg", "outlines", crs=OSAKA)])
    assert any("o.gpkg is in EPSG:6674" in sentence and "6677" in sentence for sentence in systems)
    assert any("not where the other files are" in sentence for sentence in systems)
    heights = [replace(home[0], heights="JGD2011"), facts("s.out", "trajectory", heights="ellipsoidal")]
    assert any("ellipsoidal" in sentence and "JGD2011" in sentence for sentence in disagreements(heights))


def test_places_in_degrees_meet_those_in_metres():
    plan = facts("a.laz", "points", extent=(-7000.0, -34200.0, -6900.0, -34100.0))
    west, south, east, north = extent_in_degrees(plan)
    assert (west, south) == pytest.approx((139.756, 35.692), abs=2e-3)
    gsi = facts("g.xml", "gsi_outlines", crs=epsg_wkt(6668), extent=(west, south, east, north))
    assert disagreements([plan, gsi]) == []
    assert common_system([gsi, plan]) == plan.crs_wkt and common_system([gsi]) == ""


def test_times_that_differ_are_told():
    cloud = facts("a.laz", "points", times=(100.0, 200.0))
    drive = facts("t.csv", "trajectory", times=(5000.0, 6000.0))
    assert "times of the trajectories" in disagreements([cloud, drive])[0]
    assert disagreements([cloud, replace(drive, times=(604_890.0, 605_010.0))]) == []
    observed = facts("o.obs", "observations", times=(1.39e9, 1.39e9 + 60.0))
    nav = facts("n.nav", "navigation", times=(1.38e9, 1.38e9 + 86_400.0))
    assert "navigation file of its day" in disagreements([observed, nav])[0]


def test_frames_without_a_pose_and_another_camera_are_told(small_city, tmp_path):
    found = recognise_files([small_city / "aerial"])
    lines = (small_city / "aerial/exterior.csv").read_text(encoding="utf-8").splitlines()
    (tmp_path / "exterior.csv").write_text("\n".join(lines[:2]), encoding="utf-8")
    camera = json.loads((small_city / "aerial/camera.json").read_text(encoding="utf-8"))
    (tmp_path / "camera.json").write_text(json.dumps({**camera, "image_width": 77}), encoding="utf-8")
    frames = [item for item in found if item.kind == "frame"]
    told = disagreements([*frames, *recognise_files([tmp_path])])
    assert any("not named in the exterior orientation" in sentence for sentence in told)
    assert any("the camera 77 x" in sentence for sentence in told)


@pytest.fixture(scope="module")
def city_parts(small_city):
    return parts_of(recognise_files([small_city]))


def test_parts_of_the_sample_city(city_parts):
    inputs = {role: [Path(source.partition("|")[0]).name for source in sources]
              for role, sources in city_parts.inputs.items()}
    assert inputs["als"] == ["als.laz"] and inputs["footprints"] == ["gsi_buildings.gpkg"]
    assert inputs["survey_2"] == ["survey_02.laz"] and inputs["trajectory_2"] == ["survey_02_trajectory.csv"]
    assert inputs["calibration_1"] == ["calibration.json"] and inputs["control_1"] == ["control_survey_01.csv"]
    assert "mms" in city_parts.inputs["calibration_1"][0] and "truth" not in city_parts.inputs["trajectory_1"][0]
    assert "markings" not in inputs and "ground" not in inputs  # those of the folder truth are to check against
    assert any("hold the same points" in note for note in city_parts.notes)


ALGORITHMS = {
    "reference": ["aerialmarkings"], "buildings": ["buildingsfromals"],
    "survey": ["aerialmarkings", "georeferencemms", "checkaccuracy", "georeferencemms", "checkaccuracy"],
    "walls": ["buildingsfromals", "aerialmarkings", "georeferencemms", "checkaccuracy", "georeferencemms",
              "checkaccuracy", "wallsfrommms", "mergebuildingmodels"],
    "lanemap": ["aerialmarkings", "georeferencemms", "checkaccuracy", "georeferencemms", "checkaccuracy", "lanemap"]}


@pytest.mark.parametrize("wish", ALGORITHMS)
def test_chains_of_the_sample_city(city_parts, wish):
    plan = plan_chain(wish, city_parts)
    assert [step.algorithm for step in plan.steps] == ALGORITHMS[wish] and not plan.missing
    before: set[str] = set()
    for step in plan.steps:  # every step takes only what is given or what was made before it
        values = (value if isinstance(value, list) else [value] for value in step.parameters.values())
        for item in (one for several in values for one in several):
            assert "input" not in item or item["input"] in city_parts.inputs
            assert "step" not in item or item["step"] in before
        before.add(step.id)


def test_what_is_missing_is_said_with_where_to_get_it():
    nothing = Parts({})
    assert "GSI" in " ".join(plan_chain("buildings", nothing).missing)
    assert len(plan_chain("buildings", nothing).missing) == 2
    assert any("trajectory" in sentence for sentence in plan_chain("survey", nothing).missing)
    for wish in WISHES:
        assert plan_chain(wish, nothing).missing, wish
    assert "roadmodel" not in wishes({"lanemap"}) and "roadmodel" in wishes({"roadspace"})


def test_given_markings_and_official_outlines_change_the_chain():
    parts = Parts({"als": ("/a.laz",), "gsi_footprints": ("/b.xml",), "marking_mask": ("/m.tif",),
                   "survey_1": ("/s.laz",), "trajectory_1": ("/t.csv",)}, (1,))
    assert [step.algorithm for step in plan_chain("buildings", parts, "EPSG:6677").steps] == [
        "loadgsibuildings", "buildingsfromals"]
    survey = plan_chain("survey", parts)
    assert [step.algorithm for step in survey.steps] == ["surfacefromals", "georeferencemms"] and len(survey.notes) == 2
    assert any("polygons are missing" in sentence for sentence in plan_chain("lanemap", parts).missing)


STEPS = [PlannedStep("one", "surfacefromals", {"POINTS": {"input": "als"}, "RESOLUTION": 2.0}),
         PlannedStep("two", "buildingsfromals", {"POINTS": [{"input": "als"}], "GROUND": {"step": "one",
                                                                                        "output": "OUTPUT"}})]


@pytest.fixture
def job(tmp_path):
    (tmp_path / "a.laz").write_bytes(b"points")
    return planned_job("buildings", {"als": (str(tmp_path / "a.laz"),)}, STEPS, (str(tmp_path),))


def finished(job, folder):
    """The job with its first step done."""
    page = Report("r")
    page.verdict(LOOK, "Mind the <edge> & more.")
    page.write(folder / "r.html")
    (folder / "s.tif").write_bytes(b"heights")
    step = job.step("one")
    results = {"OUTPUT": str(folder / "s.tif"), "OUTPUT_REPORT": str(folder / "r.html"), "SHARE": 0.5, "ODD": object()}
    return job.with_step(done_step(step, resolved_parameters(job, step), results, 12.34))


def test_file_comes_back_as_it_was_also_when_moved(job, tmp_path):
    done = finished(job, tmp_path)
    write_job(tmp_path / "j.urbanmap.json", done)
    assert read_job(tmp_path / "j.urbanmap.json") == done
    text = (tmp_path / "j.urbanmap.json").read_text(encoding="utf-8")
    assert str(tmp_path) not in text and json.loads(text)["urbanmap_job"] == 1
    moved = tmp_path.with_name(f"{tmp_path.name}-moved")
    tmp_path.rename(moved)
    again = read_job(moved / "j.urbanmap.json")
    assert again.inputs["als"] == (str(moved / "a.laz"),)
    assert again.step("one").outputs["OUTPUT"] == str(moved / "s.tif")
    moved.rename(tmp_path)


def test_done_steps_stay_done_until_something_changes(job, tmp_path):
    done = finished(job, tmp_path)
    step = done.step("one")
    assert (step.state, step.grade, step.verdict, step.seconds) == (DONE, "look", "Mind the <edge> & more.", 12.3)
    assert is_up_to_date(done, step) and "ODD" not in step.outputs
    assert resolved_parameters(done, done.step("two")) == {"POINTS": [[str(tmp_path / "a.laz")]],
                                                          "GROUND": str(tmp_path / "s.tif")}
    changed = done.with_step(replace(step, parameters={**step.parameters, "RESOLUTION": 1.0}))
    assert refreshed_job(changed).step("one").state == PLANNED
    (tmp_path / "s.tif").unlink()
    assert refreshed_job(done).step("one").state == PLANNED
    done = finished(job, tmp_path)
    (tmp_path / "a.laz").write_bytes(b"other points")
    assert refreshed_job(done).step("one").state == PLANNED


def test_steps_that_cannot_run_say_why(job):
    with pytest.raises(InputError, match=r"needs what “one” makes"):
        resolved_parameters(job, job.step("two"))
    with pytest.raises(InputError, match=r"no input “als”"):
        resolved_parameters(replace(job, inputs={}), job.step("one"))
    with pytest.raises(InputError, match=r"no step “three”"):
        job.step("three")
    with pytest.raises(InputError, match=r"no input “alz”; it has als"):
        job.with_inputs({"alz": ("/x.laz",)})
    failed = failed_step(job.step("one"), "No points.", 3.0)
    assert (failed.state, failed.message, failed.outputs) == (FAILED, "No points.", {})


def test_a_new_plan_keeps_settings_and_states(job, tmp_path):
    done = finished(job, tmp_path)
    tuned = done.with_step(replace(done.step("two"), parameters={**done.step("two").parameters, "ROOFS": "level"}))
    again = planned_job("buildings", done.inputs, STEPS, before=tuned)
    assert again.step("one").state == DONE and again.step("two").parameters["ROOFS"] == "level"
    other = planned_job("buildings", done.inputs, [replace(STEPS[0], algorithm="mesh25d")], before=tuned)
    assert other.step("one").state == PLANNED


@pytest.mark.parametrize(("text", "says"), [
    ("{}", "is no UrbanMap job"), ("[1]", "is no UrbanMap job"), ('{"urbanmap_job": 99}', "later version"),
    ('{"urbanmap_job": 1}', "steps cannot be read"), ("no json", "cannot be read as a job"),
    ('{"urbanmap_job": 1, "inputs": {}, "steps": [{"id": "a"}]}', "step 1 cannot be read"),
    ('{"urbanmap_job": 1, "inputs": {}, "steps": [{"id": "a", "algorithm": "x"}, {"id": "a", "algorithm": "x"}]}',
     "twice")])
def test_damaged_job_files_get_a_sentence(tmp_path, text, says):
    (tmp_path / "j.json").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=says):
        read_job(tmp_path / "j.json")


def test_a_geopackage_that_is_only_opened_has_not_changed(small_city, tmp_path):
    import os
    import shutil
    import sqlite3

    path = tmp_path / "o.gpkg"
    shutil.copy(small_city / "footprints/gsi_buildings.gpkg", path)
    before = file_state_of(str(path))
    os.utime(path, (1, 1))
    assert file_state_of(str(path)) == before
    with sqlite3.connect(path) as base:
        base.execute("UPDATE gpkg_contents SET last_change = '2030-01-01T00:00:00.000Z'")
    assert file_state_of(str(path)) != before and file_state_of(str(tmp_path / "none")) == []


def test_time_remaining_is_said_only_where_something_is_known():
    steps = [JobStep("a", "x", seconds=100.0), JobStep("b", "y", seconds=50.0)]
    assert time_remaining(steps, 20.0, 0.0) == pytest.approx(130.0)
    assert time_remaining(steps, 30.0, 0.5) == pytest.approx(80.0)
    assert time_remaining([JobStep("a", "x")], 30.0, 0.5) == pytest.approx(30.0)
    assert time_remaining([JobStep("a", "x")], 30.0, 0.01) is None
    assert time_remaining([*steps, JobStep("c", "z")], 30.0, 0.5) is None


def test_report_shows_the_worst(job, tmp_path):
    done = finished(job, tmp_path)
    write_job_report(tmp_path / "job.html", done, {"surfacefromals": "Surface"})
    assert verdict_of(tmp_path / "job.html") == ("look", "1 of 2 steps have not run yet.")
    bad = done.with_step(failed_step(done.step("two"), "No outlines.", 1.0))
    write_job_report(tmp_path / "job.html", bad, {})
    assert verdict_of(tmp_path / "job.html") == ("bad", "Step “two” failed: No outlines.")
    assert "Mind the &lt;edge&gt;" in (tmp_path / "job.html").read_text(encoding="utf-8")
    assert verdict_of(tmp_path / "none.html") == ("", "")
