"""urbanmap:runjob: a job's steps run, kept, run again where something changed, repeated on other files, and failing."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

RUN = "urbanmap:runjob"


@pytest.fixture
def job(small_city, tmp_path, plugin):
    """A job of two short steps beside its own copy of the data."""
    shutil.copy(small_city / "als/als.laz", tmp_path / "als.laz")
    steps = plugin("urbanmap_qgis.job.chain_plan").PlannedStep
    files = plugin("urbanmap_qgis.job.job_file")
    chain = [steps("surface", "surfacefromals", {"POINTS": {"input": "als"}, "RESOLUTION": 2.0}),
             steps("outlines", "loadgsibuildings", {"INPUT": {"input": "gsi_footprints"}, "CRS": "EPSG:6677"})]
    official, = (small_city / "footprints").glob("*.xml")
    place = tmp_path / "j.urbanmap.json"
    inputs = {"als": (str(tmp_path / "als.laz"),), "gsi_footprints": (str(official),)}
    files.write_job(place, files.planned_job("reference", inputs, chain))
    return place


def states(place):
    return {step["id"]: step["state"] for step in json.loads(place.read_text(encoding="utf-8"))["steps"]}


def test_runs_once_then_only_what_changed(run, job):
    report = job.with_name("job.html")
    results = run(RUN, {"JOB": str(job), "OUTPUT_REPORT": str(report)})
    assert (results["STEPS_RUN"], results["STEPS_KEPT"], results["JOB_FILE"]) == (2, 0, str(job))
    folder = job.with_name("j_results")
    assert {path.name for path in folder.iterdir()} == {"surface.tif", "outlines.gpkg"}
    assert states(job) == {"surface": "done", "outlines": "done"} and "outlines" in report.read_text(encoding="utf-8")
    made = (folder / "outlines.gpkg").stat().st_mtime_ns

    assert run(RUN, {"JOB": str(job)})["STEPS_RUN"] == 0
    content = json.loads(job.read_text(encoding="utf-8"))
    content["steps"][0]["parameters"]["RESOLUTION"] = 4.0
    job.write_text(json.dumps(content), encoding="utf-8")
    assert run(RUN, {"JOB": str(job)})["STEPS_RUN"] == 1
    assert (folder / "outlines.gpkg").stat().st_mtime_ns == made
    (folder / "surface.tif").unlink()
    assert run(RUN, {"JOB": str(job), "STEPS": "outlines"})["STEPS_RUN"] == 0
    assert run(RUN, {"JOB": str(job)})["STEPS_RUN"] == 1
    assert run(RUN, {"JOB": str(job), "AGAIN": True, "STEPS": "outlines"})["STEPS_RUN"] == 1


def test_repeats_on_other_files_in_another_folder(run, job, small_city, tmp_path):
    before = job.read_bytes()
    given = {"JOB": str(job), "STEPS": "surface", "FOLDER": str(tmp_path / "second"),
             "INPUTS": f"als={small_city / 'als/als_classified.laz'}"}
    results = run(RUN, given)
    kept = tmp_path / "second" / "j.urbanmap.json"
    assert results["JOB_FILE"] == str(kept) and job.read_bytes() == before
    assert states(kept) == {"surface": "done", "outlines": "planned"}
    assert "als_classified.laz" in kept.read_text(encoding="utf-8")
    assert run(RUN, given)["STEPS_RUN"] == 0


@pytest.mark.parametrize(("given", "says"), [
    ({"INPUTS": "als=als.laz"}, "give also a folder"),
    ({"INPUTS": "alz=als.laz", "FOLDER": "out"}, "no input “alz”"),
    ({"INPUTS": "als", "FOLDER": "out"}, "no line ROLE=FILE"),
    ({"INPUTS": "als=none.laz", "FOLDER": "out"}, "does not exist"),
    ({"STEPS": "surface,walls"}, "no step “walls”")])
def test_wrong_settings_get_a_sentence(run, job, tmp_path, given, says):
    from qgis.core import QgsProcessingException

    given = {name: str(tmp_path / value) if name == "FOLDER" else value for name, value in given.items()}
    with pytest.raises(QgsProcessingException, match=says):
        run(RUN, {"JOB": str(job), **given})


def test_a_step_that_fails_is_named_and_kept_as_failed(run, job, tmp_path):
    from qgis.core import QgsProcessingException

    (tmp_path / "als.laz").write_bytes((tmp_path / "als.laz").read_bytes()[:3000])
    with pytest.raises(QgsProcessingException, match=r"Step “surface” \(.*\) failed: .*als.laz"):
        run(RUN, {"JOB": str(job), "OUTPUT_REPORT": str(tmp_path / "r.html")})
    assert states(job) == {"surface": "failed", "outlines": "planned"}
    assert run(RUN, {"JOB": str(job), "STEPS": "outlines"})["STEPS_RUN"] == 1


def test_strange_jobs_get_a_sentence(run, job, tmp_path):
    from qgis.core import QgsProcessingException

    content = json.loads(job.read_text(encoding="utf-8"))
    for change, says in (({"algorithm": "nothing"}, "no algorithm of this version"),
                         ({"parameters": {"COLOUR": 1}}, "has no parameter COLOUR"),
                         ({"parameters": {"POINTS": {"input": "frames"}}}, "no input “frames”"),
                         ({"parameters": {"INPUT": {"input": "als"}}, "algorithm": "loadgsibuildings"}, "takes one")):
        changed = {**content, "inputs": {"als": ["als.laz", "b.laz"]},
                   "steps": [{**content["steps"][0], **change}]}
        job.write_text(json.dumps(changed), encoding="utf-8")
        with pytest.raises(QgsProcessingException, match=says):
            run(RUN, {"JOB": str(job)})


def test_model_with_the_job_as_one_step_runs(run, job):
    """What the modeller exports: the job inside a model."""
    from qgis.core import (
        QgsProcessingModelAlgorithm,
        QgsProcessingModelChildAlgorithm,
        QgsProcessingModelChildParameterSource,
    )

    model = QgsProcessingModelAlgorithm("onejob", "trials")
    child = QgsProcessingModelChildAlgorithm(RUN)
    child.setChildId("step")
    for name, value in (("JOB", str(job)), ("STEPS", "outlines")):
        child.addParameterSources(name, [QgsProcessingModelChildParameterSource.fromStaticValue(value)])
    model.addChildAlgorithm(child)
    run(model, {})
    assert states(job) == {"surface": "planned", "outlines": "done"}
    assert Path(job.with_name("j_results") / "outlines.gpkg").is_file()
