"""Road markings of a mobile survey through Processing, on a sample city."""

from __future__ import annotations

import json
from pathlib import Path

import laspy
import numpy as np
import pytest

ALGORITHM = "urbanmap:roadmarkingsfrommms"


@pytest.fixture
def inputs(small_city, tmp_path):
    """Parameters of a run on the sample city's first survey."""
    mms = small_city / "mms"
    return {"POINTS": [str(mms / "survey_01.laz")], "TRAJECTORY": str(mms / "survey_01_trajectory.csv"),
            "CALIBRATION": str(mms / "calibration.json"), "OUTPUT": str(tmp_path / "標示.laz"),
            "OUTPUT_CURVE": str(tmp_path / "曲線.html")}


def test_markings_and_the_page_of_the_fit(run, inputs, small_city, tmp_path):
    result = run(ALGORITHM, inputs)
    before, after = laspy.read(inputs["POINTS"][0]), laspy.read(result["OUTPUT"])
    truth = np.load(small_city / "truth" / "survey_01_labels.npz")["material"]
    assert result["MARKING_POINTS"] == len(after.points) and result["POINTS_READ"] == len(before.points)
    # Points are told by time and place, which no two of them share.
    keys = {name: np.rec.fromarrays([np.asarray(las.gps_time), las.X, las.Y]) for name, las in (("b", before),
                                                                                                ("a", after))}
    number = np.flatnonzero(np.isin(keys["b"], keys["a"]))
    assert len(number) == len(after.points)
    assert np.array_equal(np.asarray(before.intensity)[number], after.intensity)
    assert np.mean(truth[number] == 2) > 0.85
    assert result["SCANNERS"] == 1 and result["FIT_RESIDUAL"] < 0.05 and result["FIT_SCATTER"] < 0.2
    assert result["PAINT_CONTRAST"] > 2.0 and 0.02 < result["MARKING_SHARE"] < 0.3
    assert 10 < result["FARTHEST_RANGE"] <= 25 and 0.5 < result["MARKED_WAY"] <= 1
    assert {"calibrated_intensity", "marking_weight"} <= set(after.point_format.dimension_names)
    page = (tmp_path / "曲線.html").read_text(encoding="utf-8")
    assert "<svg" in page and "Scanner 1" in page


def test_the_papers_threshold_keeps_more(run, inputs, tmp_path):
    full = run(ALGORITHM, inputs)
    paper = run(ALGORITHM, {**inputs, "METHOD": "paper", "OUTPUT": str(tmp_path / "paper.laz")})
    assert paper["MARKING_POINTS"] != full["MARKING_POINTS"] and paper["FARTHEST_RANGE"] == full["FARTHEST_RANGE"]
    weight = np.asarray(laspy.read(paper["OUTPUT"])["marking_weight"])
    assert (weight == 1).all()


def test_the_page_and_the_calibration_may_be_left_out(run, inputs, tmp_path):
    del inputs["CALIBRATION"], inputs["OUTPUT_CURVE"]
    result = run(ALGORITHM, {**inputs, "MAX_RANGE": 12.0, "CONTRAST": 0.6, "MIN_LENGTH": 1.0})
    assert result["FARTHEST_RANGE"] <= 12.0 and result["MARKING_POINTS"] > 1000 and "OUTPUT_CURVE" not in result
    assert [path.name for path in tmp_path.iterdir()] == ["標示.laz"]


def other_numbers(inputs, folder):
    content = json.loads(Path(inputs["CALIBRATION"]).read_text())
    for scanner in content["scanners"]:
        scanner["point_source_id"] += 10
    (folder / "other.json").write_text(json.dumps(content))
    return {"CALIBRATION": str(folder / "other.json")}


def other_time(inputs, folder):
    rows = Path(inputs["TRAJECTORY"]).read_text().splitlines()
    late = [rows[0], *(f"{float(row.split(',', 1)[0]) + 5000:.3f},{row.split(',', 1)[1]}" for row in rows[1:])]
    (folder / "other.csv").write_text("\n".join(late))
    return {"TRAJECTORY": str(folder / "other.csv")}


def dark(inputs, folder, intensity=0):
    las = laspy.read(inputs["POINTS"][0])
    las.intensity[:] = intensity
    las.write(folder / "dark.laz")
    return {"POINTS": [str(folder / "dark.laz")]}


def cut(inputs, folder):
    whole = Path(inputs["POINTS"][0]).read_bytes()
    (folder / "cut.laz").write_bytes(whole[:len(whole) // 2])
    return {"POINTS": [str(folder / "cut.laz")]}


@pytest.mark.parametrize(("wrong", "words"), [
    (other_numbers, "no scanner with point source id"),
    (other_time, "trajectory runs from"),
    (dark, "has no intensity"),
    (lambda inputs, folder: dark(inputs, folder, 500), "have the intensity 500"),
    (cut, "truncated|cannot be read"),
    (lambda inputs, folder: {"OUTPUT": str(folder / "m.csv")}, "must end in .laz or .las"),
])
def test_one_sentence_for_what_cannot_be_done(run, inputs, tmp_path, tmp_path_factory, wrong, words):
    from qgis.core import QgsProcessingException

    parameters = {**inputs, **wrong(inputs, tmp_path_factory.mktemp("wrong"))}
    with pytest.raises(QgsProcessingException, match=words):
        run(ALGORITHM, parameters)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("at", [20, 60, 70])
def test_cancel_leaves_nothing(run, feedback, inputs, tmp_path, at):
    feedback.cancel_at = at
    run(ALGORITHM, inputs)
    assert not list(tmp_path.iterdir())
