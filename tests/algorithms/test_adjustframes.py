"""Frames of the small city, put off and brought back by control points, through Processing."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest

_SPEC = importlib.util.spec_from_file_location("image_points_of_a_city", Path(__file__).with_name("every_algorithm.py"))
every_algorithm = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(every_algorithm)

ALGORITHM = "urbanmap:adjustframes"


def rows_of(path):
    header, *rows = path.read_text(encoding="utf-8").splitlines()
    return header, [row.split(",") for row in rows]


@pytest.fixture
def inputs(small_city, tmp_path):
    """The city's orientations 0.3 m and 0.05 degrees off, and points on the ground as its frames show them."""
    header, rows = rows_of(small_city / "aerial/exterior.csv")
    off = [0.3, -0.3, 0.3, 0.05, -0.05, 0.05]
    moved = [[row[0], *(f"{float(value) + error:.6f}" for value, error in zip(row[1:], off))] for row in rows]
    exterior = tmp_path / "外部標定.csv"
    exterior.write_text("\n".join([header, *(",".join(row) for row in moved)]) + "\n", encoding="utf-8")
    every_algorithm.write_image_points(small_city, tmp_path / "写真上の点.csv", 60.0)
    return {"CAMERA": str(small_city / "aerial/camera.json"), "EXTERIOR": str(exterior), "CRS": "EPSG:6677",
            "CONTROL": str(tmp_path / "写真上の点.csv"), "OUTPUT": str(tmp_path / "補正.csv")}


def test_frames_come_back(run, small_city, inputs, read_layer, tmp_path):
    result = run(ALGORITHM, {**inputs, "OUTPUT_POINTS": str(tmp_path / "points.gpkg"),
                             "OUTPUT_REPORT": str(tmp_path / "report.html")})
    true, made = (np.array([[float(value) for value in row[1:7]] for row in rows_of(path)[1]])
                  for path in (small_city / "aerial/exterior.csv", tmp_path / "補正.csv"))
    assert np.abs(made - true)[:, :3].max() < 0.1 and np.abs(made - true)[:, 3:].max() < 0.01
    assert result["RMS_BEFORE"] > 0.3 and result["RMS_AFTER"] < 0.02 and result["RMS_LEFT_OUT"] < 0.03
    rows = [row.attributes for row in read_layer(result["OUTPUT_POINTS"])]
    assert len(rows) == result["POINTS"] >= 5 and {row["role"] for row in rows} == {"control"}
    assert "left out in turn" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_points_in_images_that_are_not_there_are_refused(run, inputs, tmp_path):
    path = tmp_path / "写真上の点.csv"
    path.write_text(path.read_text(encoding="utf-8").replace("frame_02.tif", "frame_99.tif"), encoding="utf-8")
    with pytest.raises(Exception, match="frame_99.tif, which the exterior orientation does not name"):
        run(ALGORITHM, inputs)
    assert not (tmp_path / "補正.csv").exists()
