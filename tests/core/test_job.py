"""What fits together, which file plays which part, the chain for a wish, and the job's file."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
import shapely
from pyproj import CRS

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.conversion.reprojection import epsg_wkt
from urbanmap_qgis.io.pages.report import LOOK, Report
from urbanmap_qgis.job.agreement import common_system, disagreements, extent_in_degrees
from urbanmap_qgis.job.chain_plan import WISHES, PlannedStep, plan_chain, roles_taken, wishes
from urbanmap_qgis.job.file_facts import POINTS, FileFacts
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
from urbanmap_qgis.job.roles import Parts, parts_of, put_to_use, use_name, uses_of

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
    used = facts("u.csv", "trajectory", times=(90.0, 210.0))
    told, = disagreements([cloud, used, drive])  # another day's among the right ones
    assert told.startswith("t.csv: nothing else was measured")
    observed = facts("o.obs", "observations", times=(1.39e9, 1.39e9 + 60.0))
    nav = facts("n.nav", "navigation", times=(1.38e9, 1.38e9 + 86_400.0))
    assert "navigation file of its day" in disagreements([observed, nav])[0]


def test_of_several_orientations_the_one_beside_the_frames_is_taken():
    found = [facts("a/other.csv", "exterior"), facts("b/frames/e.csv", "exterior"), facts("b/frames/1.tif", "frame"),
             facts("a/camera.json", "camera"), facts("b/camera.json", "camera")]
    inputs = parts_of(found).inputs
    assert inputs["exterior"] == ("/data/b/frames/e.csv",) and inputs["camera"] == ("/data/b/camera.json",)


def test_of_several_outlines_those_at_the_place_of_the_points_are_taken():
    cloud = facts("als.laz", "points")
    near, beside = facts("c.gpkg", "outlines"), facts("b.gpkg", "outlines", extent=(95.0, 0.0, 195.0, 100.0))
    far = facts("a.gpkg", "outlines", epsg_wkt(28992), (84000.0, 447000.0, 84100.0, 447100.0))
    parts = parts_of([far, beside, near, cloud])
    assert parts.inputs["footprints"] == ("/data/c.gpkg",) and "c.gpkg, a.gpkg, b.gpkg" in parts.choices["footprints"]
    # What the user says goes before, and a place that is not known before one that is another.
    assert parts_of([replace(far, use="footprints"), near, cloud]).inputs["footprints"] == ("/data/a.gpkg",)
    assert parts_of([far, replace(near, extent=None), cloud]).inputs["footprints"] == ("/data/c.gpkg",)
    assert parts_of([far, beside, near]).inputs["footprints"] == ("/data/a.gpkg",)


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
    assert "2 files could be taken" in city_parts.choices["footprints"]
    assert "footprints" in roles_taken(plan_chain("buildings", city_parts).steps)
    assert roles_taken(plan_chain("reference", city_parts).steps) >= {"frames", "als"}


SURVEYED = ("georeferencemms", "acceptance")
MEASURED = ("roadedges", "vectormap", "roadmodel")
ALGORITHMS = {
    "reference": ["aerialmarkings"], "buildings": ["buildingsfromals"],
    "survey": ["aerialmarkings", *SURVEYED, *SURVEYED],
    "walls": ["buildingsfromals", "aerialmarkings", *SURVEYED, *SURVEYED, "wallsfrommms", "mergebuildingmodels"],
    "lanemap": ["aerialmarkings", *SURVEYED, *SURVEYED, "lanemap"],
    "accuracymap": ["buildingsfromals", "aerialmarkings", *SURVEYED, *SURVEYED, "lanemap", "localisationaccuracy"],
    "streetobjects": ["aerialmarkings", *SURVEYED, *SURVEYED, "streetobjects", "streetobjects"],
    "measuredroads": ["aerialmarkings", *SURVEYED, *SURVEYED, "markinglines", *MEASURED, *MEASURED],
    "roadspace": ["aerialmarkings", *SURVEYED, *SURVEYED, "roadspace", "roadspace"]}


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
    for needed in ("roadmodel", "streetobjects", "roadspace"):
        assert needed not in wishes({"lanemap"}) and needed in wishes({needed})
    assert "measuredroads" in wishes({"roadmodel"}) and "measuredroads" not in wishes({"roadspace"})


def test_objects_are_those_of_the_survey_laid_on_its_reference_or_as_it_is(city_parts):
    laid = plan_chain("streetobjects", city_parts).steps[-1].parameters
    assert laid["POINTS"] == {"step": "survey_2", "output": "OUTPUT"}
    assert laid["TRAJECTORY"]["step"] == laid["SIGMA"]["step"] == "survey_2"
    alone = Parts({"survey_1": ("/s.laz",), "trajectory_1": ("/t.csv",)}, (1,), unplaced=frozenset({"survey_1"}))
    plan = plan_chain("streetobjects", alone, "EPSG:6677")
    (step,) = plan.steps
    assert step.algorithm == "streetobjects" and step.parameters["POINTS"] == {"input": "survey_1"}
    assert "SIGMA" not in step.parameters and step.parameters["POINTS_CRS"] == "EPSG:6677" and not plan.missing
    assert any("Standard deviation of the survey" in note for note in plan.notes)
    # Frames without their orientation are meant to be a reference: what is missing is said, not left out.
    half = plan_chain("streetobjects", replace(alone, inputs={**alone.inputs, "frames": ("/f.tif",)}))
    assert half.missing and [item.algorithm for item in half.steps][-1] == "streetobjects"


def test_measured_roads_take_edges_lanes_and_lines_of_one_survey(city_parts):
    parts = replace(city_parts, inputs={**city_parts.inputs, "roads": ("/r.gpkg",)})
    steps = {step.id: step.parameters for step in plan_chain("measuredroads", parts).steps}
    roads = steps["roads_2"]
    assert {name: roads[name]["step"] for name in ("EDGES", "TOPS", "LANES", "STOP_LINES")} == {
        "EDGES": "edges_2", "TOPS": "edges_2", "LANES": "lanes_2", "STOP_LINES": "lines"}
    assert roads["TOPS"]["output"] == "OUTPUT_TOPS" and roads["LOD"] == "3.3" and roads["ROADS"] == {"input": "roads"}
    assert steps["edges_2"]["SIGMA"] == {"step": "survey_2", "output": "MEDIAN_SIGMA"}
    assert steps["lanes_2"]["EDGES"]["step"] == "edges_2"
    space = plan_chain("roadspace", parts).steps[-1].parameters
    assert space["SIGMA"]["step"] == space["POINTS"]["step"] == "survey_2" and space["MARKINGS"]["step"] == "reference"
    polar = replace(parts, in_degrees=frozenset({"roads"}))
    assert all(any("count in degrees" in text for text in plan_chain(wish, polar).missing)
               for wish in ("measuredroads", "roadspace"))


def test_control_points_adjust_cloud_and_frames_before_all_else(city_parts):
    parts = replace(city_parts, inputs={**city_parts.inputs, "als_control": ("/a.csv",), "frame_control": ("/f.csv",)})
    plan = plan_chain("accuracymap", parts)
    steps = {step.id: step for step in plan.steps}
    assert [step.algorithm for step in plan.steps].count("adjustals") == 1
    assert steps["adjusted_als"].parameters["CONTROL"] == {"input": "als_control"}
    assert steps["buildings"].parameters["POINTS"] == steps["reference"].parameters["ALS"] == {
        "step": "adjusted_als", "output": "OUTPUT"}
    assert steps["adjusted_frames"].algorithm == "adjustframes"
    assert steps["reference"].parameters["EXTERIOR"]["step"] == "adjusted_frames"
    names = list(steps)
    assert names.index("adjusted_als") < names.index("buildings") < names.index("reference") > names.index(
        "adjusted_frames")
    assert any("shifted to the control points" in note for note in plan.notes)
    # Without the points themselves there is nothing to adjust, and what is missing stays said.
    assert plan_chain("buildings", Parts({"als_control": ("/a.csv",)})).missing


def test_roads_are_told_by_their_name_and_used_when_said():
    from urbanmap_qgis.job.recognition.layer_kind import LayerSample, kind_of_layer

    line, area = shapely.LineString([(0, 0), (50, 0)]), shapely.box(0, 0, 50, 6)
    assert kind_of_layer(LayerSample(("a.gpkg", "RdEdg"), ("fid",), "LineString", [line]), False)[0] == "roads"
    assert kind_of_layer(LayerSample(("a.gpkg", "道路構成線"), (), "Polygon", [area]), False)[0] == "roads"
    assert kind_of_layer(LayerSample(("a.gpkg", "road_edges"), (), "LineString", [line]), False)[0] == "lines"
    for kind in ("lines", "areas", "roads"):
        assert "roads" in uses_of(facts("r.gpkg", kind))
    used = put_to_use([facts("r.gpkg", "lines")], {facts("r.gpkg", "lines").source: "roads"})
    plan = plan_chain("roadmodel", parts_of(used))
    assert [step.algorithm for step in plan.steps] == ["roadmodel"] and not plan.missing


def test_given_markings_and_official_outlines_change_the_chain():
    parts = Parts({"als": ("/a.laz",), "gsi_footprints": ("/b.xml",), "marking_mask": ("/m.tif",),
                   "survey_1": ("/s.laz",), "trajectory_1": ("/t.csv",)}, (1,))
    assert [step.algorithm for step in plan_chain("buildings", parts, "EPSG:6677").steps] == [
        "loadgsi", "buildingsfromals"]
    survey = plan_chain("survey", parts)
    assert [step.algorithm for step in survey.steps] == ["surfacefromals", "georeferencemms"] and len(survey.notes) == 3
    official = plan_chain("survey", replace(parts, inputs={**{role: given for role, given in parts.inputs.items()
                                                              if role != "als"}, "gsi_ground": ("/d.xml",)}))
    assert [step.algorithm for step in official.steps] == ["loadgsi", "georeferencemms"]
    assert any("polygons are missing" in sentence for sentence in plan_chain("lanemap", parts).missing)


def test_clouds_without_a_system_get_the_common_one_or_a_note():
    parts = Parts({"als": ("/a.laz",), "marking_mask": ("/m.tif",), "survey_1": ("/s.laz",),
                   "trajectory_1": ("/t.csv",)}, (1,), unplaced=frozenset({"survey_1"}))
    given = {step.id: step.parameters.get("POINTS_CRS") for step in plan_chain("survey", parts, "EPSG:6677").steps}
    assert given == {"surface": None, "survey_1": "EPSG:6677"}
    assert any("No file states the reference system" in note for note in plan_chain("survey", parts).notes)


@pytest.fixture(scope="module")
def city_facts(small_city):
    return recognise_files([small_city])


def source_of(facts, name):
    item, = [item for item in facts if item.path.name == name and "truth" not in item.path.parts]
    return item.source


def test_files_are_used_as_the_user_says(city_facts, city_parts):
    survey, second = (source_of(city_facts, f"survey_0{number}.laz") for number in (1, 2))
    classified = source_of(city_facts, "als_classified.laz")
    official, = city_parts.inputs["gsi_footprints"]
    said = {survey: "als", classified: "als", official: "gsi_footprints", second: "frames"}
    parts = parts_of(put_to_use(city_facts, said))
    assert set(parts.inputs["als"]) == {survey, classified} and parts.inputs["survey_1"] == (second,)
    assert parts.surveys == (1,) and "footprints" not in parts.inputs  # “frames” does not fit a cloud
    steps = [step.algorithm for step in plan_chain("buildings", parts, "EPSG:6677").steps]
    assert steps == ["loadgsi", "buildingsfromals"]
    photo = source_of(city_facts, "ortho.tif")
    parts = parts_of(put_to_use(city_facts, {photo: "orthophoto"}))
    assert [step.algorithm for step in plan_chain("reference", parts).steps] == [
        "surfacefromals", "roadmarkingsfromorthophoto"]
    parts = parts_of(put_to_use(city_facts, {source_of(city_facts, "als.laz"): "survey"}))
    assert any("no trajectory covers its times" in note for note in parts.notes) and "als" not in parts.inputs


def test_what_is_against_its_name_and_in_truth_is_used_when_said(tmp_path):
    areas = facts("plan.gpkg", "areas")
    assert not areas.usable and "footprints" not in parts_of([areas]).inputs
    assert uses_of(areas) == ("footprints", "markings", "roads") and uses_of(facts("x.txt", "other")) == ()
    assert parts_of(put_to_use([areas], {areas.source: "footprints"})).inputs == {"footprints": (areas.source,)}
    true = replace(facts("truth/b.gpkg", "outlines"), path=Path("/data/truth/b.gpkg"))
    both = [facts("a.gpkg", "outlines"), true]
    assert parts_of(both).inputs["footprints"] == ("/data/a.gpkg",)
    chosen = parts_of(put_to_use(both, {true.source: "footprints"}))
    assert chosen.inputs["footprints"] == (true.source,) and not chosen.choices
    assert uses_of(replace(areas, problem="It is damaged.")) == ()


def test_outlines_in_degrees_are_told_to_be_exported():
    polar = facts("o.kml", "outlines", crs=epsg_wkt(4326), extent=(139.0, 35.0, 139.1, 35.1))
    cloud = facts("a.laz", "points")
    plan = plan_chain("buildings", parts_of([cloud, polar]), "EPSG:6677")
    assert plan.missing == ["Building outlines count in degrees: open the layer in QGIS, save it with “Export” in "
                            "EPSG:6677, and add that file."]
    assert not plan_chain("buildings", parts_of([cloud, polar, facts("o.gpkg", "outlines")])).missing
    marks = facts("m.kml", "markings", crs=epsg_wkt(4326))
    assert any("Road markings count in degrees" in text for text in plan_chain("survey", parts_of([marks])).missing)


def test_parts_have_names():
    assert use_name("survey_2") == "Mobile survey 2" and use_name("gsi_ground") == "Elevation model (GSI)"
    assert use_name("something") == "something"


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
    assert refreshed_job(again).step("one").state == DONE
    (moved / "b").mkdir()
    (moved / "b" / "a.laz").write_bytes(b"points")  # another file of the same name
    other = again.with_inputs({"als": (str(moved / "b" / "a.laz"),)})
    assert refreshed_job(other).step("one").state == PLANNED
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
    with pytest.raises(InputError, match=r"needs OUTPUT of step “one”, which gave none"):
        resolved_parameters(job.with_step(replace(job.step("one"), state=DONE)), job.step("two"))
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


def test_another_wish_and_back_leaves_what_was_done(job, tmp_path):
    done = finished(job, tmp_path)
    other = planned_job("lanemap", done.inputs, STEPS[1:], before=done)
    assert [step.id for step in other.steps] == ["two"] and [step.id for step in other.aside] == ["one"]
    write_job(tmp_path / "j.json", other)
    back = planned_job("buildings", done.inputs, STEPS, before=read_job(tmp_path / "j.json"))
    assert back.step("one") == done.step("one") and not back.aside
    assert refreshed_job(back).step("one").state == DONE


def test_a_new_plan_drops_what_it_does_not_name_any_more(job):
    """A file that is left out is no input of a step any more; what the user set himself stays."""
    bare = replace(STEPS[1], parameters={"POINTS": [{"input": "als"}], "OUTPUT_REPORT": {"wanted": True}})
    assert "GROUND" not in planned_job("x", job.inputs, [bare], before=job).step("two").parameters
    own = job.with_step(replace(job.step("two"), parameters={**job.step("two").parameters, "POINTS": "/my.laz"},
                                own=("POINTS",)))
    kept = planned_job("x", job.inputs, [bare], before=own).step("two").parameters
    assert kept == {"POINTS": "/my.laz", "OUTPUT_REPORT": {"wanted": True}}


def test_uses_are_kept_in_the_file(job, tmp_path):
    source = job.inputs["als"][0]
    write_job(tmp_path / "j.json", replace(job, used_as={source: "survey"}, left_out=(source,)))
    assert json.loads((tmp_path / "j.json").read_text(encoding="utf-8"))["used_as"] == {"a.laz": "survey"}
    assert read_job(tmp_path / "j.json").used_as == {source: "survey"}
    again = planned_job("x", job.inputs, STEPS, before=read_job(tmp_path / "j.json"))
    assert again.used_as == {source: "survey"} and again.left_out == (source,)


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


@pytest.mark.parametrize("extent, known", [((139.0, 35.0, 140.0, 36.0), True), ((-10.0, -90.0, 360.0, 90.0), True),
                                           ((0.0, 0.0, 9.0, 91.0), False), ((0.0, 0.0, 361.0, 9.0), False)])
def test_degrees_off_the_earth_are_no_extent(extent, known):
    facts = FileFacts(Path("a.csv"), POINTS, crs_wkt=CRS.from_epsg(4326).to_wkt(), extent=extent)
    assert extent_in_degrees(facts) == (extent if known else None)
