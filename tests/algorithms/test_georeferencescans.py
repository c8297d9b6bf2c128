"""Range scans through Processing."""

from __future__ import annotations

import json

import pytest

ALGORITHM = "urbanmap:georeferencescans"


@pytest.fixture
def survey(tmp_path):
    """Two scanners on a vehicle that drives north; the beams look right (angle 90), 10 m."""
    (tmp_path / "軌跡.csv").write_text("time,x,y,z,roll,pitch,heading\n" + "".join(
        f"{t},{-7000},{-34000 + 5 * t},{20},0,0,0\n" for t in range(11)), encoding="utf-8")
    (tmp_path / "c.json").write_text(json.dumps({"scanners": [
        {"id": k, "point_source_id": k, "lever_arm_m": [0, 0, -1], "roll": 0, "pitch": -90, "heading": 0,
         "max_range": 50} for k in (1, 2)]}))
    (tmp_path / "s.csv").write_text("time,angle,range,intensity,scanner\n" + "".join(
        f"{0.1 * k},90,10,{k},{1 + k % 2}\n" for k in range(100)) + "5,0,80,1,1\n6,0,0,1,1\n70,0,5,1,1\n")
    return {"SCANS": str(tmp_path / "s.csv"), "TRAJECTORY": str(tmp_path / "軌跡.csv"),
            "CALIBRATION": str(tmp_path / "c.json"), "CRS": "EPSG:6677", "OUTPUT": str(tmp_path / "点.laz")}


def test_points_and_counts(run, survey):
    import laspy
    import numpy as np

    result = run(ALGORITHM, survey)
    las = laspy.read(result["OUTPUT"])
    np.testing.assert_allclose(las.x, -6990.0, atol=1e-3)
    np.testing.assert_allclose(las.y, -34000 + 5 * np.asarray(las.gps_time), atol=1e-3)
    np.testing.assert_allclose(las.z, 21.0, atol=1e-3)
    counts = {name: result[name] for name in ("RETURNS", "POINTS", "WITHOUT_RANGE", "BEYOND_RANGE", "OUTSIDE_TIME")}
    assert counts == {"RETURNS": 103, "POINTS": 100, "WITHOUT_RANGE": 1, "BEYOND_RANGE": 1, "OUTSIDE_TIME": 1}
    assert las.header.parse_crs().to_epsg() == 6677
    assert any("1 returns" in text for text in run.feedback.warnings)


def test_without_a_crs_it_says_so(run, survey):
    del survey["CRS"]
    run(ALGORITHM, survey)
    assert any("not known" in text for text in run.feedback.warnings)


def test_limits_of_range(run, survey):
    result = run(ALGORITHM, {**survey, "MAX_RANGE": 100})
    assert (result["POINTS"], result["BEYOND_RANGE"]) == (101, 0)


@pytest.mark.parametrize(("name", "text", "sentence"), [
    ("SCANS", "time,angle,range,scanner\n1,0,5,9\n", "no scanner with point source id 9"),
    ("SCANS", "a,b\n1,2\n", "no column time"),
    ("CALIBRATION", "{}", "no calibration"), ("TRAJECTORY", "time,x\n1,2\n", "no column"),
])
def test_bad_input_is_told_in_a_sentence(run, survey, name, text, sentence):
    from qgis.core import QgsProcessingException

    with open(survey[name], "w", encoding="utf-8") as file:
        file.write(text)
    with pytest.raises(QgsProcessingException, match=sentence):
        run(ALGORITHM, survey)


def test_a_crs_in_degrees_is_refused(run, survey):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException):
        run(ALGORITHM, {**survey, "CRS": "EPSG:4326"})


def test_several_files_are_placed_one_after_the_other(run, survey, tmp_path):
    (tmp_path / "more.csv").write_text("time,angle,range,scanner\n1,90,5,1\n2,90,5,2\n")
    result = run(ALGORITHM, {**survey, "SCANS": [survey["SCANS"], str(tmp_path / "more.csv")]})
    assert result["POINTS"] == 102


def test_a_file_that_is_not_there(run, survey, tmp_path):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="does not exist"):
        run(ALGORITHM, {**survey, "SCANS": str(tmp_path / "none.csv")})
