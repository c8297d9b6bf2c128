"""Walls from a mobile survey, merged models and meshes through Processing."""

from __future__ import annotations

import json

import numpy as np
import pytest

X0, Y0, GROUND = -8_000.0, -34_000.0, 10.0
WALLS, MERGE, MESH = "urbanmap:wallsfrommms", "urbanmap:mergebuildingmodels", "urbanmap:mesh25d"


def square(x, y, width, depth):
    corners = [(x, y), (x + width, y), (x + width, y + depth), (x, y + depth), (x, y)]
    return "Polygon ((" + ", ".join(f"{X0 + a} {Y0 + b}" for a, b in corners) + "))"


def block(x, y, width, depth, height):
    """WKT of a block's faces."""
    west, south, east, north = X0 + x, Y0 + y, X0 + x + width, Y0 + y + depth
    a, b, c, d = (west, south), (east, south), (east, north), (west, north)
    low, high = GROUND, GROUND + height
    faces = [[(*p, low) for p in (a, d, c, b)], [(*p, high) for p in (a, b, c, d)]]
    faces += [[(*p, low), (*q, low), (*q, high), (*p, high)] for p, q in ((a, b), (b, c), (c, d), (d, a))]
    rings = ("((" + ", ".join(" ".join(map(str, p)) for p in [*face, face[0]]) + "))" for face in faces)
    return f"MultiPolygonZ ({', '.join(rings)})"


@pytest.fixture
def survey(make_cloud, tmp_path):
    """The south and west fronts of a block of 20 x 12 m and 30 m height, and the street before them."""
    def make(name="測量.laz", **attributes):
        rng = np.random.default_rng(1)
        n = 9_000
        south = np.column_stack([rng.uniform(0, 20, n), rng.normal(0, 0.01, n), rng.uniform(0, 26, n)])
        west = np.column_stack([rng.normal(0, 0.01, n), rng.uniform(0, 12, n), rng.uniform(0, 26, n)])
        street = np.column_stack([rng.uniform(-8, 28, n), rng.uniform(-9, -0.1, n), np.zeros(n)])
        x, y, z = np.concatenate([south, west, street]).T
        return make_cloud(tmp_path / name, X0 + x, Y0 + y, GROUND + z, gps_time=np.linspace(0, 60, 3 * n), **attributes)
    return make


@pytest.fixture
def models(polygon_layer):
    """The block as modelled from the air: 0.4 m off to the south, 0.5 m to the west; and another far away."""
    return polygon_layer([block(-0.5, -0.4, 20.5, 12.4, 30.0), block(300, 0, 10, 10, 9.0)],
                         fields={"building_id": [5, 8], "owner": ["甲", "乙"]}, kind="MultiPolygonZ")


def rows_of(features):
    return [feature.attributes for feature in features]


def test_with_the_drives_each_wall_tells_what_beams_went_through(run, survey, models, read_layer, tmp_path):
    """Two drives one after the other; one of another day is refused in a sentence."""
    from qgis.core import QgsProcessingException

    def drive(first, last, name):
        time = np.linspace(first, last, 60)
        rows = [f"{t:.3f},{X0 - 5 + t / 2:.3f},{Y0 - 8:.3f},{GROUND + 2:.3f},0,0,90" for t in time]
        path = tmp_path / name
        path.write_text("\n".join(["time,x,y,z,roll,pitch,heading", *rows]) + "\n", encoding="utf-8")
        return str(path)

    given = {"POINTS": [str(survey())], "BUILDINGS": models, "OUTPUT": str(tmp_path / "walls.gpkg")}
    found = run(WALLS, {**given, "TRAJECTORY": [drive(0, 29.9, "走行1.csv"), drive(30, 60, "走行2.csv")]})
    rows = rows_of(read_layer(found["OUTPUT"]))
    for row in rows:
        assert row["coverage"] + row["hidden"] + row["unseen"] + row["through"] == pytest.approx(1.0, abs=1e-6)
    assert {row["status"] for row in rows} == {"ok"}
    without = rows_of(read_layer(run(WALLS, given)["OUTPUT"]))
    assert not any(isinstance(row["through"], float) for row in without) and len(without) == len(rows)
    with pytest.raises(QgsProcessingException, match="but the points were measured from"):
        run(WALLS, {**given, "TRAJECTORY": [drive(90_000, 90_060, "other.csv")]})


def test_walls_then_merged_models(run, survey, models, read_layer, tmp_path):
    found = run(WALLS, {"POINTS": [str(survey())], "BUILDINGS": models, "OUTPUT": str(tmp_path / "壁.gpkg")})
    assert found["WALLS"] == 2 and found["BUILDINGS_WITH_WALLS"] == 1 and found["MEDIAN_SIGMA"] < 0.01
    walls = read_layer(found["OUTPUT"])
    rows = rows_of(walls)
    assert {row["building_id"] for row in rows} == {5} and {row["status"] for row in rows} == {"ok"}
    assert sorted(round(row["azimuth"]) % 360 for row in rows) == [180, 270]
    assert sorted(row["area"] for row in rows) == pytest.approx([240, 400], rel=0.06)
    offset = {round(row["azimuth"]): row["offset"] for row in rows}
    assert offset[180] == pytest.approx(-0.4, abs=0.01) and offset[270] == pytest.approx(-0.5, abs=0.01)
    assert all(row["coverage"] > 0.9 and row["rmse"] < 0.015 for row in rows)

    merged = run(MERGE, {"MODELS": models, "WALLS": found["OUTPUT"], "OUTPUT": str(tmp_path / "merged.gpkg"),
                         "OUTPUT_WALLS": str(tmp_path / "walls.gpkg"), "OUTPUT_CITYJSON": str(tmp_path / "m.city.json"),
                         "OUTPUT_MESH": str(tmp_path / "m.obj")})
    assert (merged["BUILDINGS"], merged["MERGED"], merged["NOT_MERGED"], merged["VALID"]) == (2, 1, 0, 2)
    assert merged["WALLS_MOVED"] == 2
    first, second = rows_of(read_layer(merged["OUTPUT"]))
    assert first["status"] == "merged" and second["status"] == "unchanged" and first["owner"] == "甲"
    assert first["volume_change"] == pytest.approx((20 * 12 - 20.5 * 12.4) * 20, abs=1.0)
    states = [row["status"] for row in rows_of(read_layer(merged["OUTPUT_WALLS"]))]
    assert sorted(states) == ["moved", "moved", *["not seen"] * 6]
    city = json.loads((tmp_path / "m.city.json").read_text(encoding="utf-8"))
    surfaces = city["CityObjects"]["building-5"]["geometry"][0]["semantics"]["surfaces"]
    assert "OuterCeilingSurface" in {surface["type"] for surface in surfaces}
    assert "g building-5" in (tmp_path / "m.obj").read_text()

    again = run(MERGE, {"MODELS_CITYJSON": str(tmp_path / "m.city.json"), "WALLS": found["OUTPUT"], "HEIGHT": 20.0,
                        "OUTPUT": "TEMPORARY_OUTPUT"})
    assert again["NOT_MERGED"] == 1, "a merged model with an overhang is no plain model any more"
    assert again["VALID"] == 2


def test_walls_by_gnss_move_what_the_street_did_not_show(run, survey, models, polygon_layer, read_layer, tmp_path):
    """The east front, 0.6 m inside by likely observations; known to a decimetre it hardly moves."""
    from qgis.core import QgsProcessingException

    walls = run(WALLS, {"POINTS": [str(survey())], "BUILDINGS": models, "OUTPUT": str(tmp_path / "walls.gpkg")})
    line = f"LineStringZ ({X0 + 19.4} {Y0} {GROUND}, {X0 + 19.4} {Y0 + 12} {GROUND})"
    gnss = polygon_layer([line, line], fields={"status": ["not observable", "likely"], "sigma": [0.1, 0.4]},
                         kind="LineStringZ")
    given = {"MODELS": models, "WALLS": walls["OUTPUT"], "GNSS_WALLS": gnss, "OUTPUT": str(tmp_path / "merged.gpkg"),
             "OUTPUT_WALLS": str(tmp_path / "merged_walls.gpkg")}
    moved = []
    for sigma in (1.0, 0.1):
        made = run(MERGE, {**given, "MODEL_SIGMA": sigma})
        assert made["WALLS_MOVED"] == 3 and made["VALID"] == 2
        row, = (row for row in rows_of(read_layer(made["OUTPUT_WALLS"])) if "by satellites (likely)" in row["note"])
        assert row["status"] == "moved" and "sigma 0.40 m" in row["note"]
        moved.append((row["offset"], row["sigma"]))
    assert moved[0] == pytest.approx((-0.6, 0.4), abs=1e-6)
    assert -0.05 < moved[1][0] < -0.02 and moved[1][1] < 0.1
    with pytest.raises(QgsProcessingException, match="no walls with status and sigma"):
        run(MERGE, {**given, "GNSS_WALLS": walls["OUTPUT"]})


def test_outlines_without_heights_and_a_lower_limit(run, survey, polygon_layer, read_layer):
    outlines = polygon_layer([square(0.3, -0.6, 20, 12)])
    found = run(WALLS, {"POINTS": [str(survey())], "BUILDINGS": outlines, "MAX_HEIGHT": 8.0,
                        "OUTPUT": "TEMPORARY_OUTPUT"})
    assert found["WALLS"] == 2 and any("no heights" in line for line in run.feedback.infos)
    assert all(7 < row["height"] < 8.5 for row in rows_of(read_layer(found["OUTPUT"])))


@pytest.mark.parametrize(("attributes", "words"), [
    ({"epsg": 6668}, "degrees"), ({"epsg": 6676}, "No point of the survey"),
    ({"classification": 7}, "No point of the survey"),
])
def test_surveys_that_do_not_fit(run, survey, models, tmp_path, attributes, words):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match=words):
        run(WALLS, {"POINTS": [str(survey(**attributes))], "BUILDINGS": models, "OUTPUT": str(tmp_path / "w.gpkg")})
    assert not (tmp_path / "w.gpkg").exists()


def test_merging_refuses_what_it_cannot_use(run, survey, models, polygon_layer, tmp_path):
    from qgis.core import QgsProcessingException

    empty = polygon_layer([], kind="PolygonZ")
    flat = polygon_layer([square(0, 0, 5, 5)])
    for parameters, words in (({"MODELS": models, "WALLS": empty}, "no measured walls"),
                              ({"MODELS": models, "WALLS": flat}, "no heights"),
                              ({"WALLS": flat}, "either as a layer or as a CityJSON"),
                              ({"MODELS": polygon_layer([block(0, 0, 5, 5, 5)], crs="EPSG:6676",
                                                        kind="MultiPolygonZ"),
                                "WALLS": polygon_layer([block(0, 0, 5, 5, 5)], kind="MultiPolygonZ")}, "reproject")):
        with pytest.raises(QgsProcessingException, match=words):
            run(MERGE, {**parameters, "OUTPUT": str(tmp_path / "m.gpkg")})
    assert not (tmp_path / "m.gpkg").exists()


@pytest.fixture
def roofs(make_cloud, tmp_path):
    """Points of a gable and of a flat roof, all class 6."""
    rng = np.random.default_rng(2)
    x, y = rng.uniform(0, 20, 2_000), rng.uniform(0, 12, 2_000)
    z = 9.0 - 0.7 * np.abs(y - 6)
    flat = np.column_stack([rng.uniform(40, 52, 1_200), rng.uniform(0, 12, 1_200), np.full(1_200, 15.0)])
    points = np.concatenate([np.column_stack([x, y, z]), flat])
    return make_cloud(tmp_path / "屋根.laz", X0 + points[:, 0], Y0 + points[:, 1], GROUND + points[:, 2],
                      classification=6)


def test_meshes(run, roofs, polygon_layer, read_layer, tmp_path):
    outlines = polygon_layer([square(0, 0, 20, 12), square(40, 0, 12, 12), square(90, 0, 5, 5)],
                             fields={"building_id": [3, 4, 9], "ground": [GROUND, GROUND, GROUND]})
    made = run(MESH, {"POINTS": [str(roofs)], "FOOTPRINTS": outlines, "OUTPUT": str(tmp_path / "網.gpkg"),
                      "OUTPUT_MESH": str(tmp_path / "mesh.obj"), "OUTPUT_PLY": str(tmp_path / "mesh.ply")})
    assert (made["BUILDINGS"], made["MESHED"], made["WATERTIGHT"]) == (3, 2, 2)
    assert made["WITHIN"] > 0.95 and made["RMSE"] < 0.2
    rows = rows_of(read_layer(made["OUTPUT"]))
    assert [row["status"] for row in rows] == ["ok", "ok", "not modelled"]
    assert rows[1]["height"] == pytest.approx(15.0, abs=0.05) and rows[0]["height"] == pytest.approx(9.0, abs=0.3)
    assert any("have no mesh" in line for line in run.feedback.warnings)

    from qgis.core import QgsMeshLayer

    mesh = QgsMeshLayer(made["OUTPUT_PLY"], "mesh", "mdal")
    assert mesh.isValid() and mesh.dataProvider().faceCount() == made["TRIANGLES"]


def test_cancelling_leaves_nothing(run, feedback, survey, models, roofs, polygon_layer, tmp_path):
    feedback.cancel_at = 10
    run(WALLS, {"POINTS": [str(survey())], "BUILDINGS": models, "OUTPUT": str(tmp_path / "w.gpkg")})
    assert not (tmp_path / "w.gpkg").exists()
    run(MESH, {"POINTS": [str(roofs)], "FOOTPRINTS": polygon_layer([square(0, 0, 20, 12)]),
               "OUTPUT": str(tmp_path / "m.gpkg")})
    assert not (tmp_path / "m.gpkg").exists()
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".laz", ".laz"]


def test_walls_that_do_not_tell_how_well_they_were_measured_are_refused(run, polygon_layer, tmp_path):
    from qgis.core import QgsProcessingException

    wall = polygon_layer(["POLYGON Z((0 0 0, 20 0 0, 20 0 10, 0 0 10, 0 0 0))"], kind="PolygonZ")
    models = polygon_layer(["POLYGON((0 0, 20 0, 20 10, 0 10, 0 0))"], fields={"building_id": [1]})
    with pytest.raises(QgsProcessingException, match="have no field status"):
        run(MERGE, {"MODELS": models, "WALLS": wall, "OUTPUT": str(tmp_path / "m.gpkg")})
