"""Every wish of the dock planned from the sample city's folder and run to its end, one after the other in one job."""

from __future__ import annotations

from pathlib import Path

import pytest
import shapely

RESULTS = {
    "survey": {"reference_report.html", "survey_1.laz", "survey_1_trajectory.csv", "survey_1_images.csv",
               "acceptance_1.gpkg", "acceptance_1_report.html", "acceptance_1_errors.html"},
    "lanemap": {"lanes_lanelet2.osm", "lanes_opendrive.xodr", "lanes_report.html", "lanes_lanes.gpkg"},
    "walls": {"buildings.gpkg", "walls.gpkg", "merged.gpkg", "merged_cityjson.city.json", "merged_report.html"},
    "accuracymap": {"localisation.gpkg", "localisation_report.html"},
    "reference": {"reference.tif", "reference_polygons.gpkg"}, "buildings": {"buildings_report.html"},
    "roadmodel": {"roads.gpkg", "roads_axes.gpkg", "roads_report.html", "roads_citygml"},
    "measuredroads": {"edges_1.gpkg", "edges_1_tops.gpkg", "lines.gpkg", "lanes_1_lanes.gpkg", "roads_1.gpkg",
                      "roads_1_areas.gpkg", "roads_1_report.html", "roads_1_citygml"},
    "roadspace": {"space_1.gpkg", "space_1_areas.gpkg", "space_1_objects.gpkg", "space_1_report.html",
                  "space_1_citygml", "space_1_furniture", "space_1_object_report.html"},
    "streetobjects": {"objects_1.gpkg", "objects_1_rails.gpkg", "objects_1_report.html", "objects_1_citygml"}}
"""Files among the results of each wish, in the order in which they are wished for."""

KEPT = {"lanemap": 3, "walls": 3, "accuracymap": 5, "reference": 1, "buildings": 1, "streetobjects": 3,
        "measuredroads": 3, "roadspace": 3}
"""Steps that a wish finds done by those before it."""


@pytest.mark.once
@pytest.mark.slow
def test_every_wish_runs_to_its_end(run, plugin, small_city, save_outlines, tmp_path):
    recognise, roles, chains, files = (plugin(f"urbanmap_qgis.job.{name}") for name in (
        "recognition.contents", "roles", "chain_plan", "job_file"))
    # One survey of the two: the second would only take as long once more.
    cross = shapely.box(0, 40, 100, 46).union(shapely.box(47, 0, 53, 90))
    given = [small_city, save_outlines(tmp_path / "交差点.gpkg", [cross])]
    facts = [item for item in recognise.recognise_files(given) if not item.path.name.startswith("survey_02")]
    said = {item.source: "roads" for item in facts if item.path.name == "交差点.gpkg"}
    facts = roles.put_to_use(facts, said)
    parts, place, job = roles.parts_of(facts), tmp_path / "job.urbanmap.json", None
    assert set(RESULTS) == set(chains.WISHES)
    for wish, expected in RESULTS.items():
        plan = chains.plan_chain(wish, parts, "EPSG:6677")
        assert plan.steps and not plan.missing
        job = files.planned_job(wish, parts.inputs, plan.steps, before=job)
        files.write_job(place, job)
        done = run("urbanmap:runjob", {"JOB": str(place)})
        job = files.read_job(place)
        assert {step.state for step in job.steps} == {"done"} and done["STEPS_KEPT"] == KEPT.get(wish, 0), wish
        assert expected <= {path.name for path in Path(done["RESULTS"]).iterdir()}, wish
        reported = [step for step in job.steps if any(name.endswith("REPORT") for name in step.outputs)]
        assert reported and all(step.verdict and step.grade in ("good", "look") for step in reported), wish
    laid = {step.id: step for step in job.steps}
    assert laid["survey_1"].outputs["MEDIAN_SIGMA"] > 0.0 and laid["objects_1"].outputs["OBJECTS"] > 0
    assert laid["objects_1"].outputs["MEDIAN_SIGMA"] >= laid["survey_1"].outputs["MEDIAN_SIGMA"]
    assert job.aside and not any(path.name.startswith(".") for path in Path(done["RESULTS"]).iterdir())
