"""Tie points proposed through Processing, and taken by the rectification as they are."""

from __future__ import annotations

import numpy as np
import pytest

ALGORITHM = "urbanmap:tiepointproposals"
X0, Y0 = -7_000.0, -34_000.0
BLOCKS = [(X0 + side, Y0 + 12 + 28 * k, X0 + side + 14, Y0 + 30 + 28 * k) for k in range(4) for side in (-24.0, 9.0)]


@pytest.fixture
def survey(tmp_path, make_cloud, polygon_layer):
    """A drive north at 6 m/s between blocks, reported 1.3 m off."""
    time = np.arange(0.0, 22.0, 0.1)
    off = np.array([1.2, -0.5])
    rows = np.column_stack([time, X0 + off[0] + 0 * time, Y0 + off[1] + 6 * time, 12 + 0 * time, 0 * time, 0 * time,
                            0 * time])
    np.savetxt(tmp_path / "t.csv", rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
    walls = []
    for left, bottom, right, top in BLOCKS:
        face = right if right < X0 else left
        walls.append([(face, y) for y in np.arange(bottom + 0.1, top, 0.35)])
        for y in (bottom, top):
            walls.append([(x, y) for x in np.arange(left, right, 0.35) if abs(x - X0) < 17])
    plan = np.concatenate(walls)
    heights = np.arange(12.0, 18, 0.25)
    x, y = np.repeat(plan, len(heights), axis=0).T
    moment = np.clip((y - Y0) / 6.0, 0, 21.8)
    make_cloud(tmp_path / "s.laz", x + off[0], y + off[1], np.tile(heights, len(plan)), gps_time=moment)
    outlines = polygon_layer([f"POLYGON(({a} {b},{c} {b},{c} {d},{a} {d},{a} {b}))" for a, b, c, d in BLOCKS])
    return {"POINTS": [str(tmp_path / "s.laz")], "TRAJECTORY": str(tmp_path / "t.csv"), "BUILDINGS": outlines,
            "OUTPUT": str(tmp_path / "提案.gpkg")}


def test_lines_that_the_rectification_takes(run, survey, read_layer, tmp_path):
    result = run(ALGORITHM, survey)
    lines = read_layer(result["OUTPUT"])
    assert len(lines) == 2 * result["SETS"] >= 6 and result["FOUND"] <= result["CORNERS"]
    assert result["MEAN_LENGTH"] == pytest.approx(1.3, abs=0.05)
    assert {"set", "time", "length", "support", "fit"} <= set(lines[0].attributes)
    made = run("urbanmap:rectifytrajectory", {"TRAJECTORY": survey["TRAJECTORY"], "TIE_POINTS": result["OUTPUT"],
                                              "OUTPUT": str(tmp_path / "r.csv")})
    table = np.genfromtxt(made["OUTPUT"], delimiter=",", names=True)
    np.testing.assert_allclose(table["x"], X0, atol=0.1)
    np.testing.assert_allclose(table["y"], Y0 + 6 * table["time"], atol=0.1)


@pytest.fixture
def surface(tmp_path):
    """The blocks as a surface model of half metre cells, 8 m high on ground that rises, rough by 5 cm."""
    import rasterio
    from rasterio.transform import from_origin

    cell, rng = 0.5, np.random.default_rng(5)
    x, y = np.meshgrid(X0 - 60 + (np.arange(240) + 0.5) * cell, Y0 + 160 - (np.arange(360) + 0.5) * cell)
    heights = 12 + 0.02 * (y - Y0) + rng.normal(0, 0.05, x.shape)
    for a, b, c, d in BLOCKS:
        heights[(x > a) & (x < c) & (y > b) & (y < d)] += 8.0
    with rasterio.open(tmp_path / "dsm.tif", "w", driver="GTiff", width=240, height=360, count=1, dtype="float32",
                       crs="EPSG:6677", transform=from_origin(X0 - 60, Y0 + 160, cell, cell), nodata=-9999.0) as file:
        file.write(heights.astype(np.float32), 1)
    return str(tmp_path / "dsm.tif")


def test_corners_of_a_surface_serve_like_outlines(run, survey, surface, read_layer, tmp_path):
    result = run(ALGORITHM, {**survey, "BUILDINGS": None, "SURFACE": surface})
    assert len(read_layer(result["OUTPUT"])) == 2 * result["SETS"] >= 6
    assert result["MEAN_LENGTH"] == pytest.approx(1.3, abs=0.1)
    made = run("urbanmap:rectifytrajectory", {"TRAJECTORY": survey["TRAJECTORY"], "TIE_POINTS": result["OUTPUT"],
                                              "OUTPUT": str(tmp_path / "r.csv")})
    table = np.genfromtxt(made["OUTPUT"], delimiter=",", names=True)
    np.testing.assert_allclose(table["x"], X0, atol=0.25)
    np.testing.assert_allclose(table["y"], Y0 + 6 * table["time"], atol=0.25)


def test_one_reference_is_wanted(run, survey, surface):
    from qgis.core import QgsProcessingException

    for given in ({"SURFACE": surface}, {"BUILDINGS": None}):
        with pytest.raises(QgsProcessingException, match="Give either Buildings or Surface"):
            run(ALGORITHM, {**survey, **given})


def test_no_outline_near_the_course(run, survey, polygon_layer):
    from qgis.core import QgsProcessingException

    survey["BUILDINGS"] = polygon_layer(["POLYGON((0 0,9 0,9 9,0 9,0 0))"])
    with pytest.raises(QgsProcessingException, match="No corner of a building"):
        run(ALGORITHM, survey)


def test_outlines_in_another_crs_are_taken_into_that_of_the_points(run, survey, polygon_layer, feedback):
    from qgis.core import QgsProcessingException

    survey["BUILDINGS"] = polygon_layer(["POLYGON((0 0,9 0,9 9,0 9,0 0))"], "EPSG:6676")
    with pytest.raises(QgsProcessingException, match="No corner of a building"):
        run(ALGORITHM, survey)
    assert any("reprojected from EPSG:6676" in text for text in feedback.warnings)
