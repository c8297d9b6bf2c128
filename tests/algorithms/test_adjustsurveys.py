"""Two drives of a small sample city adjusted at once, through Processing."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.once

ALGORITHM = "urbanmap:adjustsurveys"
SURVEYS = ("survey_01", "survey_02")


@pytest.fixture(scope="module")
def markings(qgis_app, small_city, tmp_path_factory):
    """Marking points of both surveys."""
    import processing

    folder = tmp_path_factory.mktemp("二つの走行")
    return [processing.run("urbanmap:roadmarkingsfrommms", {
        "POINTS": [str(small_city / f"mms/{name}.laz")], "TRAJECTORY": str(small_city / f"mms/{name}_trajectory.csv"),
        "CALIBRATION": str(small_city / "mms/calibration.json"), "OUTPUT": str(folder / f"{name}.laz"),
        "OUTPUT_CURVE": None})["OUTPUT"] for name in SURVEYS]


def given(city, markings, folder, **more):
    return {"POINTS": markings, "TRAJECTORY": [str(city / f"mms/{name}_trajectory.csv") for name in SURVEYS],
            "OUTPUT": str(folder / "corrected"), **more}


def places(path):
    with open(path, encoding="utf-8") as file:
        return np.array([[float(row[name]) for name in "xyz"] for row in csv.DictReader(file)])


def errors(city, folder):
    """Corrected less true places of both drives, (n, 3) m each."""
    return [places(folder / f"{name}_trajectory.csv") - places(city / f"truth/{name}_trajectory.csv")
            for name in SURVEYS]


def first_control(city, path, count=5):
    """A few control points of the first survey alone."""
    lines = (city / "truth/control_survey_01.csv").read_text(encoding="utf-8").splitlines()
    chosen = np.linspace(1, len(lines) - 1, count).astype(int)
    path.write_text("\n".join([lines[0], *(lines[k] for k in chosen)]), encoding="utf-8")
    return str(path)


def test_control_of_one_drive_places_both(run, small_city, markings, read_layer, tmp_path):
    result = run(ALGORITHM, given(small_city, markings, tmp_path, CRS="EPSG:6677",
                                  CONTROL=first_control(small_city, tmp_path / "control.csv"),
                                  OUTPUT_TIES=str(tmp_path / "ties.gpkg"), OUTPUT_NODES=str(tmp_path / "nodes.gpkg"),
                                  OUTPUT_REPORT=str(tmp_path / "report.html")))
    for error in errors(small_city, tmp_path / "corrected"):
        assert np.median(np.hypot(error[:, 0], error[:, 1])) < 0.10  # the ends lie beyond all markings
    assert result["RELATIVE"] == 0 and result["TIES"] >= 5 and result["MEDIAN_SIGMA"] < 0.10
    kinds = [row.attributes["kind"] for row in read_layer(result["OUTPUT_TIES"])]
    assert kinds.count("tie") == result["TIES"] and kinds.count("control point") == 5
    assert {row.attributes["status"] for row in read_layer(result["OUTPUT_NODES"])} <= {"placed", "bridged"}
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "standard deviation of" in text and "control point" in text and "survey_02_trajectory" in text


def test_surveys_themselves_are_tied_by_planes_too(run, small_city, tmp_path):
    result = run(ALGORITHM, {
        "POINTS": [str(small_city / f"mms/{name}.laz") for name in SURVEYS],
        "TRAJECTORY": [str(small_city / f"mms/{name}_trajectory.csv") for name in SURVEYS],
        "CALIBRATION": str(small_city / "mms/calibration.json"), "OUTPUT": str(tmp_path / "corrected")})
    assert result["TIES"] >= 5 and result["PLANE_TIES"] >= 5
    first, second = errors(small_city, tmp_path / "corrected")
    assert np.hypot(*(first[:, :2].mean(axis=0) - second[:, :2].mean(axis=0))) < 0.10


def test_without_control_the_drives_agree_and_the_place_is_called_relative(run, small_city, markings, feedback,
                                                                           read_layer, tmp_path):
    """All results go into temporary places."""
    places = dict.fromkeys(("OUTPUT", "OUTPUT_TIES", "OUTPUT_NODES", "OUTPUT_REPORT"), "TEMPORARY_OUTPUT")
    result = run(ALGORITHM, given(small_city, markings, tmp_path, **places))
    assert Path(result["OUTPUT_REPORT"]).is_file() and not list(tmp_path.iterdir())
    assert read_layer(result["OUTPUT_TIES"]) and read_layer(result["OUTPUT_NODES"])
    assert result["RELATIVE"] == 1 and result["MEDIAN_SIGMA"] > 0.5
    assert any("only relative" in text for text in feedback.warnings)
    first, second = errors(small_city, Path(result["OUTPUT"]))
    assert np.hypot(*(first[:, :2].mean(axis=0) - second[:, :2].mean(axis=0))) < 0.10


def test_reference_markings_place_the_drives(run, small_city, markings, tmp_path):
    result = run(ALGORITHM, given(small_city, markings, tmp_path, GROUND=str(small_city / "truth/ground.tif"),
                                  MARKINGS=f"{small_city / 'truth/markings.gpkg'}|layername=aerial"))
    assert result["RELATIVE"] == 0
    for error in errors(small_city, tmp_path / "corrected"):
        assert np.median(np.linalg.norm(error, axis=1)) < 0.06


def test_a_drive_without_its_points_is_refused(run, small_city, markings, tmp_path):
    with pytest.raises(Exception, match="No point cloud was measured along survey_02_trajectory"):
        run(ALGORITHM, given(small_city, markings[:1], tmp_path))
    assert not list((tmp_path / "corrected").glob("*"))


def test_given_trajectories_are_not_replaced(run, small_city, markings, tmp_path):
    with pytest.raises(Exception, match="would be written over another trajectory"):
        run(ALGORITHM, {**given(small_city, markings, tmp_path), "OUTPUT": str(small_city / "mms")})


@pytest.mark.parametrize("side", ["BUILDINGS", "ALS"])
def test_walls_place_the_drives_without_control(run, small_city, read_layer, tmp_path, side):
    sides = {"BUILDINGS": f"{small_city / 'truth/footprints.gpkg'}|layername=wall_footprints",
             "ALS": [str(small_city / "als/als.laz")]}
    result = run(ALGORITHM, {
        "POINTS": [str(small_city / f"mms/{name}.laz") for name in SURVEYS], "PLANES": False,
        "TRAJECTORY": [str(small_city / f"mms/{name}_trajectory.csv") for name in SURVEYS],
        "CALIBRATION": str(small_city / "mms/calibration.json"), "OUTPUT": str(tmp_path / "corrected"),
        side: sides[side], "OUTPUT_TIES": str(tmp_path / "ties.gpkg"),
        "OUTPUT_REPORT": str(tmp_path / "report.html")})
    for error in errors(small_city, tmp_path / "corrected"):
        assert np.median(np.hypot(error[:, 0], error[:, 1])) < 0.15
    assert result["RELATIVE"] == 0 and result["WALLS"] >= 10 and result["MEDIAN_SIGMA"] < 0.2
    kinds = [row.attributes["kind"] for row in read_layer(result["OUTPUT_TIES"])]
    assert kinds.count("wall") == result["WALLS"]
    assert "wall (%)" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_walls_alone_need_buildings(run, small_city, markings, tmp_path):
    with pytest.raises(Exception, match="walls alone need buildings"):
        run(ALGORITHM, given(small_city, markings, tmp_path, FEATURES="walls"))
