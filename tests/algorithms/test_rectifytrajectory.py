"""Rectification of a trajectory through Processing."""

from __future__ import annotations

import numpy as np
import pytest

ALGORITHM = "urbanmap:rectifytrajectory"
X0, Y0 = -7_000.0, -34_000.0
SHIFT = np.array([1.2, -0.8])


@pytest.fixture
def survey(tmp_path):
    """North at 5 m/s for 200 s, reported 1.44 m off in plan and 0.6 m too high; four sets of two corners."""
    time = np.arange(0, 200.5, 0.5)
    none = 0 * time
    rows = np.column_stack([time, X0 - SHIFT[0] + none, Y0 - SHIFT[1] + 5 * time, 22.6 + none, none, none, none])
    np.savetxt(tmp_path / "t.csv", rows, "%.4f", ",", header="time,x,y,z,roll,pitch,heading", comments="")
    ties = []
    for name, moment in enumerate((20.0, 80.0, 130.0, 180.0), 1):
        for side, later in ((-9.0, 0.0), (8.0, 2.0)):
            true = np.array([X0 + side, Y0 + 5 * (moment + later) + 2.0])
            ties.append([name, moment + later, *(true - SHIFT), *true])
    write_ties(tmp_path / "角.csv", ties)
    return tmp_path, ties, {"TRAJECTORY": str(tmp_path / "t.csv"), "TIE_POINTS": str(tmp_path / "角.csv"),
                            "OUTPUT": str(tmp_path / "補正.csv"), "OUTPUT_REPORT": str(tmp_path / "r.html")}


def write_ties(path, rows):
    path.write_text("set,time,x_mms,y_mms,x_ref,y_ref\n" + "".join(",".join(map(str, row)) + "\n" for row in rows),
                    encoding="utf-8")


def read(path):
    return np.genfromtxt(path, delimiter=",", names=True, encoding="utf-8")


def test_plan_is_corrected_and_heights_stay(run, survey, read_layer):
    folder, _, parameters = survey
    result = run(ALGORITHM, {**parameters, "CRS": "EPSG:6677", "OUTPUT_SETS": str(folder / "sets.gpkg"),
                             "OUTPUT_EPOCHS": str(folder / "epochs.gpkg")})
    made = read(result["OUTPUT"])
    np.testing.assert_allclose(made["x"], X0, atol=0.01)
    np.testing.assert_allclose(made["y"], Y0 + 5 * made["time"], atol=0.01)
    np.testing.assert_allclose(made["z"], 22.6)
    assert (result["SETS"], result["SETS_USED"]) == (4, 4)
    assert result["BEFORE"] == pytest.approx(np.hypot(*SHIFT), abs=1e-3) and result["AFTER"] < 0.01
    assert 0 < result["MEAN_SIGMA"] <= result["MAX_SIGMA"] and result["HELD_SHARE"] == pytest.approx(0.19, abs=0.01)
    assert "HEIGHT_AFTER" not in result
    sets, epochs = read_layer(result["OUTPUT_SETS"]), read_layer(result["OUTPUT_EPOCHS"])
    assert [item.attributes["status"] for item in sets] == ["used"] * 4 and len(epochs) == 401
    assert sets[0].attributes["east"] == pytest.approx(SHIFT[0], abs=0.01)
    assert {item.attributes["status"] for item in epochs} == {"between sets", "carried on"}
    assert "<svg" in (folder / "r.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("method", ["relative", "iterative"])
def test_retired_methods_run_as_the_best_estimate_and_say_so(run, survey, method):
    _, _, parameters = survey
    best = read(run(ALGORITHM, parameters)["OUTPUT"])["x"]
    np.testing.assert_array_equal(read(run(ALGORITHM, {**parameters, "METHOD": method})["OUTPUT"])["x"], best)
    assert any(f"“{method}” was retired; the run takes “drift”" in text for text in run.feedback.warnings)


def test_heights_follow_the_ground(run, survey):
    import rasterio

    from urbanmap_qgis.geometry.grid import Grid
    from urbanmap_qgis.io.raster import write_raster

    folder, _, parameters = survey
    grid = Grid(X0 - 50, Y0 + 1050, 1.0, 1100, 100)
    wkt = rasterio.crs.CRS.from_epsg(6677).to_wkt()
    write_raster(folder / "g.tif", np.full(grid.shape, 20.0, np.float32), grid, wkt)
    result = run(ALGORITHM, {**parameters, "GROUND": str(folder / "g.tif"), "SENSOR_HEIGHT": 2.0})
    np.testing.assert_allclose(read(result["OUTPUT"])["z"], 22.0, atol=1e-3)
    assert result["HEIGHT_BEFORE"] == pytest.approx(0.6, abs=1e-3) and result["HEIGHT_AFTER"] < 1e-3
    run(ALGORITHM, {**parameters, "GROUND": str(folder / "g.tif")})
    assert any("mean height stays" in text for text in run.feedback.warnings)


def test_lines_from_survey_to_reference(run, survey, polygon_layer):
    _, ties, parameters = survey
    layer = polygon_layer([f"LINESTRING({a} {b},{c} {d})" for _, _, a, b, c, d in ties], "EPSG:6677",
                          {"set": [row[0] for row in ties], "time": [row[1] for row in ties]}, kind="LineString")
    result = run(ALGORITHM, {**parameters, "TIE_POINTS": layer})
    np.testing.assert_allclose(read(result["OUTPUT"])["x"], X0, atol=0.01)


def test_a_contradicting_set_is_warned_of_and_shown(run, survey, read_layer):
    folder, ties, parameters = survey
    ties[3][5] += 4.0
    write_ties(folder / "角.csv", ties)
    result = run(ALGORITHM, {**parameters, "OUTPUT_SETS": str(folder / "sets.gpkg")})
    assert (result["SETS"], result["SETS_USED"]) == (4, 3)
    assert any("Set 2 contradicts itself" in text for text in run.feedback.warnings)
    assert "Set 2 contradicts itself" in (folder / "r.html").read_text(encoding="utf-8")
    assert [item.attributes["status"] for item in read_layer(result["OUTPUT_SETS"])][1] == "contradicting"
    np.testing.assert_allclose(read(result["OUTPUT"])["x"], X0, atol=0.02)


@pytest.mark.parametrize(("rows", "sentence"), [
    ([[1, 900, X0, Y0, X0, Y0]], "one survey"), ([[1, 20, X0, Y0, 0, 0]], "apart"),
    ([[1, 20, "x", Y0, X0, Y0]], "number"), ([], "tie points"),
])
def test_bad_tie_points_are_told_in_a_sentence(run, survey, rows, sentence):
    from qgis.core import QgsProcessingException

    folder, _, parameters = survey
    write_ties(folder / "角.csv", rows)
    with pytest.raises(QgsProcessingException, match=sentence):
        run(ALGORITHM, parameters)


def test_cancel_writes_nothing(run, survey):
    folder, _, parameters = survey
    run.feedback.cancel_at = 1
    assert run(ALGORITHM, parameters) == {}
    assert not (folder / "補正.csv").exists()
