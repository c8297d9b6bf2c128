"""Laser points of the small city, put off and brought back by control points, through Processing."""

from __future__ import annotations

import laspy
import numpy as np
import pytest
import rasterio

ALGORITHM = "urbanmap:adjustals"
OFF = (0.4, -0.3, 0.25)


@pytest.fixture
def inputs(small_city, tmp_path):
    """The city's laser points shifted by OFF, and points on its streets, the last two of them to check."""
    las = laspy.read(small_city / "als/als_classified.laz")
    las.header.offsets = las.header.offsets + OFF
    las.points.offsets = las.header.offsets
    las.write(tmp_path / "点群.laz")
    ground = np.column_stack([las.x, las.y])[np.asarray(las.classification) == 2] - OFF[:2]
    with rasterio.open(small_city / "truth/ground.tif") as raster:
        corners = ground[[np.argmin(ground @ way) for way in ((1, 1), (1, -1), (-1, 1), (-1, -1), (1, 0), (0, 1))]]
        inner = corners + 0.15 * (ground.mean(axis=0) - corners)
        places = ground[[np.hypot(*(ground - one).T).argmin() for one in inner]]
        heights = [value[0] for value in raster.sample(places)]
    rows = [f"P{k},{x:.3f},{y:.3f},{z:.3f},{x + OFF[0]:.3f},{y + OFF[1]:.3f},{'check' if k > 3 else ''}"
            for k, ((x, y), z) in enumerate(zip(places, heights))]
    (tmp_path / "調整点.csv").write_text("id,x,y,z,x_als,y_als,role\n" + "\n".join(rows) + "\n", encoding="utf-8")
    return {"POINTS": [str(tmp_path / "点群.laz")], "CONTROL": str(tmp_path / "調整点.csv"),
            "OUTPUT": str(tmp_path / "補正.laz")}


def test_the_cloud_comes_back(run, small_city, inputs, read_layer, tmp_path):
    result = run(ALGORITHM, {**inputs, "OUTPUT_POINTS": str(tmp_path / "points.gpkg"),
                             "OUTPUT_REPORT": str(tmp_path / "report.html")})
    true, made = laspy.read(small_city / "als/als_classified.laz"), laspy.read(tmp_path / "補正.laz")
    off = np.median(made.xyz - true.xyz, axis=0)
    assert np.abs(off[:2]).max() < 0.01 and abs(off[2]) < 0.06
    assert result["RMS_BEFORE"] > 0.15 and result["RMS_AFTER"] < 0.06 and result["RMS_CHECK"] < 0.1
    assert result["SHIFT_EAST"] == pytest.approx(-OFF[0], abs=0.01) and result["WRONG"] == 0
    assert np.array_equal(made.classification, true.classification) and np.array_equal(made.gps_time, true.gps_time)
    roles = [row.attributes["role"] for row in read_layer(result["OUTPUT_POINTS"])]
    assert roles == ["control"] * 4 + ["check"] * 2


def test_points_of_another_place_are_refused(run, inputs, tmp_path):
    (tmp_path / "調整点.csv").write_text("id,x,y,z\nA,0,0,0\n", encoding="utf-8")
    with pytest.raises(Exception, match="no ground around any control point"):
        run(ALGORITHM, inputs)
    assert not (tmp_path / "補正.laz").exists()
