"""Calibration of scanners through Processing, on a small sample city placed by its true trajectories."""

from __future__ import annotations

import json
from pathlib import Path

import laspy
import numpy as np
import pytest

pytestmark = pytest.mark.once

ALGORITHM = "urbanmap:calibratescanner"
SURVEYS = ("survey_01", "survey_02")


@pytest.fixture(scope="module")
def placed(qgis_app, small_city, tmp_path_factory):
    """Both surveys where the true trajectories place them."""
    import processing

    folder = tmp_path_factory.mktemp("検定")
    return [processing.run("urbanmap:applytrajectory", {
        "POINTS": [str(small_city / f"mms/{name}.laz")], "TRAJECTORY": str(small_city / f"mms/{name}_trajectory.csv"),
        "CORRECTED": str(small_city / f"truth/{name}_trajectory.csv"), "OUTPUT": str(folder / f"{name}.laz")})["OUTPUT"]
        for name in SURVEYS]


def given(city, points, tmp_path, kind="truth", **more):
    return {"POINTS": points, "TRAJECTORY": [str(city / f"{kind}/{name}_trajectory.csv") for name in SURVEYS],
            "CALIBRATION": str(city / "mms/calibration.json"), "OUTPUT": str(tmp_path / "calibration.json"), **more}


def test_an_exact_calibration_stays(run, small_city, placed, read_layer, tmp_path):
    result = run(ALGORITHM, given(small_city, placed, tmp_path, OUTPUT_TABLE=str(tmp_path / "table.gpkg"),
                                  OUTPUT_REPORT=str(tmp_path / "report.html")))
    before = json.loads((small_city / "mms/calibration.json").read_text(encoding="utf-8"))
    after = json.loads((tmp_path / "calibration.json").read_text(encoding="utf-8"))
    for old, new in zip(before["scanners"], after["scanners"]):
        assert new["lever_arm_m"] == pytest.approx(old["lever_arm_m"], abs=0.06)
        assert [new[key] for key in ("roll", "pitch", "heading")] == pytest.approx(
            [old.get(key, 0.0) for key in ("roll", "pitch", "heading")], abs=0.12)
        assert set(new["calibrated"]) == {"forward", "right", "down", "roll", "pitch", "heading"}
    rows = [row.attributes for row in read_layer(result["OUTPUT_TABLE"])]
    assert len(rows) == 6 * len(before["scanners"])
    assert sum(row["status"] == "determined" for row in rows) == result["DETERMINED"] > 0
    assert all(abs(row["correction"]) < 3 * row["sigma"] for row in rows if row["status"] == "determined")
    assert "not determined" in (tmp_path / "report.html").read_text(encoding="utf-8")


def turned(path, trajectory, scanner, degrees, target):
    """The points as a scanner gives them that sits `degrees` (3,) about the body's axes off its calibration."""
    from urbanmap_qgis.mobile.trajectory import interpolate, rotations

    las = laspy.read(path)
    pose = interpolate(trajectory, np.asarray(las.gps_time))
    turn, points = rotations(pose.angles), np.column_stack([las.x, las.y, las.z])
    ray = np.einsum("nji,nj->ni", turn, points - pose.place) - scanner.lever_arm
    of_scanner = (np.asarray(las.point_source_id) == scanner.point_source_id)[:, None]
    points -= of_scanner * np.einsum("nij,nj->ni", turn, np.cross(np.radians(degrees), ray))
    las.x, las.y, las.z = points.T
    las.write(target)
    return str(target)


def test_a_scanner_that_sits_off_is_found(run, small_city, placed, read_layer, tmp_path):
    """Turns of the drive, where planes are seen from two sides, once gave a pitch 4 standard deviations off.

    All results go into temporary places.
    """
    from urbanmap_qgis.mobile.calibration import read_calibration
    from urbanmap_qgis.mobile.trajectory_files import read_trajectory

    degrees = (0.2, 0.2, 0.2)
    scanner = read_calibration(small_city / "mms/calibration.json").scanners[0]
    points = [turned(path, read_trajectory(small_city / f"truth/{name}_trajectory.csv").trajectory, scanner, degrees,
                     tmp_path / f"{name}.laz") for path, name in zip(placed, SURVEYS)]
    places = dict.fromkeys(("OUTPUT", "OUTPUT_TABLE", "OUTPUT_REPORT"), "TEMPORARY_OUTPUT")
    result = run(ALGORITHM, given(small_city, points, tmp_path, **places))
    assert Path(result["OUTPUT"]).is_file() and Path(result["OUTPUT_REPORT"]).is_file()
    rows = [row.attributes for row in read_layer(result["OUTPUT_TABLE"])]
    assert all(abs(row["correction"] - true) < 2 * row["sigma"]
               for row, true in zip(rows, [0.0, 0.0, 0.0, *degrees, *[0.0] * 6]))
    assert rows[3]["status"] == "determined"


def test_surveys_that_lie_apart_are_refused(run, small_city, tmp_path):
    points = [str(small_city / f"mms/{name}.laz") for name in SURVEYS]
    with pytest.raises(Exception, match="m apart"):
        run(ALGORITHM, given(small_city, points, tmp_path, kind="mms"))
    assert not (tmp_path / "calibration.json").exists()
