"""Trajectories as parameters: CSV files, vector files and layers in, the same kind out."""

from __future__ import annotations

import numpy as np
import pytest

ROWS = [(10.0, 1.0, 2.0, 3.0, 0.5, -0.5, 359.0), (10.1, 2.0, 2.0, 3.0, 0.5, -0.5, 1.0),
        (10.2, 3.0, 2.0, 3.0, 0.0, 0.0, 3.0)]
NAMES = ("time", "x", "y", "z", "roll", "pitch", "heading")


@pytest.fixture
def shift(plugin):
    """An algorithm that moves a trajectory a metre to the east."""
    base = plugin("algorithms.framework.base")

    class Shift(base.UrbanMapAlgorithm):
        ID = "shift"
        NAME = "Shift"
        HELP = "Moves."

        def declare(self):
            self.add_trajectory()
            self.add_trajectory_output()

        def compute(self, parameters, context, feedback):
            trajectory = plugin("urbanmap_qgis.mobile.trajectory")
            read = self.read_trajectory(parameters, "TRAJECTORY", context, progress=self.progress(feedback))
            old = read.trajectory
            moved = trajectory.Trajectory(old.time, old.place + np.array([1.0, 0.0, 0.0]), old.angles)
            return {"OUTPUT": self.write_trajectory(parameters, "OUTPUT", context, read, moved)}

    return Shift()


@pytest.fixture
def points(polygon_layer):
    """A layer of the epochs, which has the heights in a field and the plan in its points."""
    fields = {name: [float(row[NAMES.index(name)]) for row in ROWS] for name in NAMES if name not in "xy"}
    return polygon_layer([f"Point({row[1]} {row[2]})" for row in ROWS], fields=dict(fields, mode=["a", "b", "c"]),
                         kind="Point", name="epochs")


def test_csv_comes_back_as_csv(run, shift, tmp_path):
    path = tmp_path / "走行.csv"
    path.write_text(",".join(NAMES) + "\n" + "\n".join(",".join(map(str, row)) for row in ROWS), encoding="utf-8")
    result = run(shift, {"TRAJECTORY": str(path), "OUTPUT": str(tmp_path / "補正.csv")})
    table = np.loadtxt(result["OUTPUT"], delimiter=",", skiprows=1, encoding="utf-8")
    assert np.allclose(table, np.array(ROWS) + np.eye(7)[1])


def test_layer_comes_back_as_layer_with_its_fields(run, shift, points, read_layer, tmp_path):
    from qgis.core import QgsProject

    QgsProject.instance().addMapLayer(points, False)
    try:
        result = run(shift, {"TRAJECTORY": points.id(), "OUTPUT": str(tmp_path / "out.gpkg")})
    finally:
        QgsProject.instance().removeMapLayer(points.id())
    features = read_layer(result["OUTPUT"])
    assert [feature.attributes["x"] for feature in features] == [2.0, 3.0, 4.0]
    assert [feature.attributes["mode"] for feature in features] == ["a", "b", "c"]
    again = run(shift, {"TRAJECTORY": result["OUTPUT"], "OUTPUT": str(tmp_path / "twice.gpkg")})
    assert [feature.attributes["x"] for feature in read_layer(again["OUTPUT"])] == [3.0, 4.0, 5.0]


def test_repeated_epochs_are_told(run, shift, tmp_path):
    path = tmp_path / "t.csv"
    path.write_text(",".join(NAMES) + "\n" + "\n".join(",".join(map(str, row)) for row in [*ROWS, ROWS[-1]]))
    run(shift, {"TRAJECTORY": str(path), "OUTPUT": str(tmp_path / "out.csv")})
    assert any("repeated" in text for text in run.feedback.warnings)


@pytest.mark.parametrize(("name", "sentence"), [("missing.csv", "does not exist"), ("a.laz", "has no column time")])
def test_what_is_no_trajectory_is_refused(run, shift, tmp_path, name, sentence):
    from qgis.core import QgsProcessingException

    if name == "a.laz":
        (tmp_path / name).write_bytes(b"LASF")
    with pytest.raises(QgsProcessingException, match=sentence):
        run(shift, {"TRAJECTORY": str(tmp_path / name), "OUTPUT": str(tmp_path / "out.csv")})
