"""Applying a correction, landmark updating and the check at control points through Processing."""

from __future__ import annotations

import laspy
import numpy as np
import pytest

X0, Y0 = -7000.0, -34000.0


@pytest.fixture
def survey(make_cloud, tmp_path):
    """A straight drive with points and control points; the survey lies 0.6 m east and 0.2 m too high."""
    time = np.arange(100.0, 120.05, 0.1)
    lines = ["time,x,y,z,roll,pitch,heading"]
    lines += [f"{t:.2f},{X0 + 8 * (t - 100):.4f},{Y0:.4f},12.0,0,0,90" for t in time]
    (tmp_path / "軌跡.csv").write_text("\n".join(lines), encoding="utf-8")
    moved = [f"{t:.2f},{X0 + 8 * (t - 100) - 0.6:.4f},{Y0:.4f},11.8,0,0,90" for t in time]
    (tmp_path / "corrected.csv").write_text("\n".join([lines[0], *moved]), encoding="utf-8")
    control = ["id,x,y,z,time,x_mms,y_mms,z_mms"]
    control += [f"P{t},{X0 + 8 * (t - 100) - 0.6},{Y0 + 3},9.8,{t},{X0 + 8 * (t - 100)},{Y0 + 3},10.0"
                for t in range(102, 119, 2)]
    (tmp_path / "control.csv").write_text("\n".join(control), encoding="utf-8")
    cloud = make_cloud(tmp_path / "survey.laz", X0 + 8 * np.arange(19.0), np.full(19, Y0), np.full(19, 10.0),
                       gps_time=101.0 + np.arange(19.0), intensity=np.arange(19))
    return {"TRAJECTORY": str(tmp_path / "軌跡.csv"), "CORRECTED": str(tmp_path / "corrected.csv"),
            "CONTROL": str(tmp_path / "control.csv"), "POINTS": [str(cloud)]}


def given(survey, *names, **more):
    return {**{name: survey[name] for name in names}, **more}


def test_points_and_images_are_moved(run, survey, tmp_path):
    (tmp_path / "images.csv").write_text(f"id,time,x,y,z,roll,pitch,heading\na,105,{X0},{Y0},12,0,0,90\n",
                                         encoding="utf-8")
    result = run("urbanmap:applytrajectory", given(
        survey, "POINTS", "TRAJECTORY", "CORRECTED", IMAGES=str(tmp_path / "images.csv"),
        OUTPUT=str(tmp_path / "out.laz"), OUTPUT_IMAGES=str(tmp_path / "new.csv")))
    before, after = laspy.read(survey["POINTS"][0]), laspy.read(result["OUTPUT"])
    assert np.allclose(np.array(after.xyz) - np.array(before.xyz), [-0.6, 0.0, -0.2], atol=1e-3)
    assert np.array_equal(before.intensity, after.intensity)
    assert result["POINT_COUNT"] == 19 and result["POINTS_OUTSIDE"] == result["POINTS_IN_GAPS"] == 0
    assert result["MEAN_MOVEMENT"] == pytest.approx(np.hypot(0.6, 0.2), abs=1e-3)
    assert f"a,105.0000,{X0 - 0.6:.4f},{Y0:.4f},11.8000" in (tmp_path / "new.csv").read_text()


def test_accuracy_before_and_after(run, survey, read_layer, tmp_path):
    before = run("urbanmap:checkaccuracy", given(survey, "CONTROL", "TRAJECTORY", CRS="EPSG:6677",
                                                 OUTPUT=str(tmp_path / "before.gpkg")))
    assert before["MEAN_2D"] == pytest.approx(0.6, abs=1e-3)
    assert before["MAX_3D"] == pytest.approx(np.hypot(0.6, 0.2), abs=1e-3)
    after = run("urbanmap:checkaccuracy", given(survey, "CONTROL", "TRAJECTORY", "CORRECTED", CRS="EPSG:6677",
                                                OUTPUT=str(tmp_path / "after.gpkg"),
                                                OUTPUT_REPORT=str(tmp_path / "report.html")))
    assert after["MAX_2D"] < 1e-3 and after["MAX_3D"] < 1e-3 and after["POINTS_USED"] == 9
    rows = read_layer(after["OUTPUT"])
    assert len(rows) == 9 and rows[0].attributes["id"] == "P102"
    assert rows[0].attributes["plan_before"] == pytest.approx(0.6, abs=1e-3)
    assert rows[0].geometry.constGet().z() == pytest.approx(9.8)
    assert "as reported" in (tmp_path / "report.html").read_text(encoding="utf-8")

    from qgis.core import QgsVectorLayer

    layer = QgsVectorLayer(after["OUTPUT"], "residuals", "ogr")
    assert layer.crs().authid() == "EPSG:6677" and layer.renderer().type() == "RuleRenderer"


def test_a_table_as_a_japanese_spreadsheet_saves_it_is_read(run, survey, tmp_path):
    """Code page 932, a head, X as the northing: QGIS itself opens no such table."""
    rows = [line.split(",") for line in (tmp_path / "control.csv").read_text(encoding="utf-8").splitlines()[1:]]
    rows = [[i, y, x, z, t, y_mms, x_mms, z_mms, "検証点"] for i, x, y, z, t, x_mms, y_mms, z_mms in rows]
    path = tmp_path / "成果　表.csv"
    text = ["検証点成果表", "", "点名,X座標(北),Y座標(東),標高,時刻,計測X,計測Y,計測標高,区分", *map(",".join, rows)]
    path.write_bytes("\r\n".join(text).encode("cp932"))
    found = run("urbanmap:checkaccuracy", given(survey, "TRAJECTORY", CONTROL=str(path), CRS="EPSG:6677",
                                                OUTPUT=str(tmp_path / "out.gpkg")))
    assert found["MEAN_2D"] == pytest.approx(0.6, abs=1e-3) and found["POINTS_USED"] == 9


def test_landmark_update_meets_the_control_points(run, survey, tmp_path):
    result = run("urbanmap:landmarkupdate", given(survey, "CONTROL", "TRAJECTORY", OUTPUT=str(tmp_path / "new.csv")))
    assert result["POINTS_USED"] == 9
    assert (tmp_path / "new.csv").read_text().splitlines()[0] == "time,x,y,z,roll,pitch,heading"
    checked = run("urbanmap:checkaccuracy", given(survey, "CONTROL", "TRAJECTORY", CORRECTED=result["OUTPUT"],
                                                  OUTPUT="TEMPORARY_OUTPUT"))
    assert checked["MAX_3D"] < 1e-3


@pytest.mark.parametrize(("algorithm", "change", "words"), [
    ("applytrajectory", {"CORRECTED": "control"}, "no column roll"),
    ("applytrajectory", {"OUTPUT": "out.txt"}, "must end in"),
    ("checkaccuracy", {"CONTROL": "trajectory"}, "no column x_mms"),
    ("landmarkupdate", {"CONTROL": "trajectory"}, "no column x_mms"),
])
def test_bad_input_in_one_sentence(run, survey, tmp_path, algorithm, change, words):
    from qgis.core import QgsProcessingException

    files = {"control": survey["CONTROL"], "trajectory": survey["TRAJECTORY"], "out.txt": str(tmp_path / "out.txt")}
    parameters = {**survey, "OUTPUT": str(tmp_path / ("out.laz" if algorithm == "applytrajectory" else "out.gpkg"))}
    if algorithm != "applytrajectory":
        parameters.pop("POINTS")
    parameters.update({name: files[value] for name, value in change.items()})
    with pytest.raises(QgsProcessingException, match=words):
        run(f"urbanmap:{algorithm}", parameters)
    assert not list(tmp_path.glob("out.*"))
