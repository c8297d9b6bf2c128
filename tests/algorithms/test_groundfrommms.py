"""Ground of a mobile survey through Processing."""

from __future__ import annotations

import laspy
import numpy as np
import pytest

ALGORITHM = "urbanmap:groundfrommms"
X0, Y0 = -8_000.0, -34_000.0


@pytest.fixture
def street(make_cloud, tmp_path):
    """A level street of 60 m with walls of 10 m along both sides; unclassified. Gives the path and what is ground."""
    def make(name="測量.laz", **attributes):
        rng = np.random.default_rng(1)
        u, v = rng.uniform(0, 60, 20_000), rng.uniform(-8, 8, 20_000)
        wall = np.arange(20_000) % 4 == 0
        v[wall] = 8 * np.sign(v[wall])
        z = 10 + np.where(wall, rng.uniform(0.5, 10, 20_000), 0.0)
        return make_cloud(tmp_path / name, X0 + u, Y0 + v, z, **{"gps_time": 1000 + u / 10, **attributes}), ~wall
    return make


def test_ground_is_class_2(run, street, tmp_path):
    path, ground = street()
    result = run(ALGORITHM, {"POINTS": [str(path)], "OUTPUT": str(tmp_path / "地面.laz")})
    assert np.array_equal(np.asarray(laspy.read(result["OUTPUT"]).classification) == 2, ground)
    assert result["POINTS_READ"] == result["POINTS_USED"] == 20_000
    assert result["GROUND_POINTS"] == ground.sum() and result["GROUND_SHARE"] == pytest.approx(0.75)
    assert result["PASSES"] == 1


def test_parameters_reach_the_filter(run, street, tmp_path):
    path, ground = street()
    result = run(ALGORITHM, {"POINTS": [str(path), str(street("b.laz")[0])], "THRESHOLD": 1.5, "CLOTH_RESOLUTION": 3.0,
                             "ITERATIONS": 500, "RIGIDNESS": 2, "OUTPUT": str(tmp_path / "g.las")})
    assert result["POINTS_READ"] == 40_000
    assert 2.05 * ground.sum() < result["GROUND_POINTS"] < 2.2 * ground.sum()


@pytest.mark.parametrize(("attributes", "output", "words"), [
    ({"classification": 7}, "g.laz", "no usable points"),
    ({"epsg": None}, "g.laz", "coordinate reference system"),
    ({"epsg": 6668}, "g.laz", "degrees"),
    ({}, "g.txt", "must end in .laz or .las"),
])
def test_one_sentence_for_what_cannot_be_done(run, street, tmp_path, attributes, output, words):
    from qgis.core import QgsProcessingException

    path, _ground = street(**attributes)
    with pytest.raises(QgsProcessingException, match=words):
        run(ALGORITHM, {"POINTS": [str(path)], "OUTPUT": str(tmp_path / output)})
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_cancel_leaves_nothing(run, feedback, street, tmp_path):
    feedback.cancel_at = 30
    path, _ground = street()
    run(ALGORITHM, {"POINTS": [str(path)], "OUTPUT": str(tmp_path / "g.laz")})
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]
