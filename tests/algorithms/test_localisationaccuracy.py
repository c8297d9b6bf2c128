"""The map of localisation accuracy through Processing, on the sample city."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

ALGORITHM = "urbanmap:localisationaccuracy"
SOURCES = ("walls", "markings", "satellites")


@pytest.fixture
def inputs(small_city):
    return {"BUILDINGS": str(small_city / "models" / "buildings.geojson"), "OUTPUT": "TEMPORARY_OUTPUT"}


def values(rows, name):
    return np.array([np.nan if row[name] in (None, "NULL") or str(row[name]) == "NULL" else row[name] for row in rows],
                    float)


def test_along_roads_with_all_sources(run, read_layer, inputs, small_city, tmp_path):
    result = run(ALGORITHM, inputs | {
        "MARKINGS": f"{small_city / 'truth' / 'markings.gpkg'}|layername=mms",
        "ROADS": str(small_city / "truth" / "lanes.gpkg"),
        "NAVIGATION": [str(small_city / "gnss" / "satellites.nav")], "TIME": "2024-04-18 02:00:00", "SPACING": 8.0,
        "OUTPUT": str(tmp_path / "精度.gpkg"), "OUTPUT_RASTER": str(tmp_path / "accuracy.tif")})
    rows = [feature.attributes for feature in read_layer(result["OUTPUT"])]
    assert len(rows) == result["PLACES"] > 30
    for part in ("along", "across"):
        together = values(rows, f"sigma_{part}")
        each = np.stack([values(rows, f"{part}_{source}") for source in SOURCES])
        assert np.isfinite(together).all() and (together <= np.nanmin(each, axis=0) * 1.0001).all()
    assert (values(rows, "minor") <= values(rows, "major")).all()
    assert result["MEDIAN_SIGMA"] == pytest.approx(np.median(values(rows, "major")))
    total = sum(result[f"LENGTH_{name}"] for name in ("GOOD", "USABLE", "POOR", "NONE"))
    lines = read_layer(str(small_city / "truth" / "lanes.gpkg"))
    from qgis.core import QgsGeometry

    assert total == pytest.approx(sum(QgsGeometry.fromWkt(line.wkt).length() for line in lines), rel=0.01)
    from qgis.core import QgsRasterLayer

    assert QgsRasterLayer(result["OUTPUT_RASTER"], "accuracy").crs().authid() == "EPSG:6677"


def test_along_a_drive_and_over_an_area(run, read_layer, inputs, small_city):
    drive = run(ALGORITHM, inputs | {"TRAJECTORY": [str(small_city / "truth" / "survey_01_trajectory.csv")],
                                     "NAVIGATION": [str(small_city / "gnss" / "satellites.nav")], "SPACING": 10.0})
    rows = [feature.attributes for feature in read_layer(drive["OUTPUT"])]
    assert len(rows) > 5 and np.isfinite(values(rows, "along_walls")).all()
    area = run(ALGORITHM, inputs | {"SPACING": 10.0, "SCANNER": "multi-layer", "MATCHING": "ICP"})
    words = {feature.attributes["status"] for feature in read_layer(area["OUTPUT"])}
    assert "inside a building" in words and "ok" in words


def test_larger_sigmas_of_walls_make_larger_sigmas(run, inputs, small_city):
    drive = {"TRAJECTORY": [str(small_city / "truth" / "survey_01_trajectory.csv")], "SPACING": 10.0}
    small, large = (run(ALGORITHM, inputs | drive | {"WALL_SIGMA": sigma})["MEDIAN_SIGMA"] for sigma in (0.1, 0.4))
    assert 2.5 < large / small < 4.5


def test_measured_walls_count_where_the_map_has_them(run, inputs, small_city, tmp_path):
    models = json.loads(Path(inputs["BUILDINGS"]).read_text())
    edges = [list(edge) for feature in models["features"] for ring in feature["geometry"]["coordinates"]
             for edge in zip(ring, ring[1:])]

    def median(sigma, status):
        features = [{"type": "Feature", "geometry": {"type": "LineString", "coordinates": edge},
                     "properties": {"sigma": sigma, "status": status}} for edge in edges]
        walls = tmp_path / f"{status}.geojson"
        walls.write_text(json.dumps({**models, "features": features}))
        drive = {"TRAJECTORY": [str(small_city / "truth" / "survey_01_trajectory.csv")], "SPACING": 20.0}
        return run(ALGORITHM, inputs | drive | {"WALLS": str(walls)})["MEDIAN_SIGMA"]

    left = median(0.05, "not observable")
    assert median(0.05, "likely") < 0.5 * left
    assert median(0.9, "held") == pytest.approx(left)


def test_markings_alone(run, inputs, small_city):
    result = run(ALGORITHM, {"MARKINGS": f"{small_city / 'truth' / 'markings.gpkg'}|layername=mms",
                             "ROADS": str(small_city / "truth" / "lanes.gpkg"), "OUTPUT": "TEMPORARY_OUTPUT"})
    assert 0.01 < result["MEDIAN_SIGMA"] < 0.5


@pytest.mark.parametrize("change, words", [
    ({"BUILDINGS": None}, "Give buildings, markings or both"),
    ({"BUILDINGS": None, "MARKINGS": "MARKINGS", "SIMULATE": True}, "simulated of buildings"),
    ({"BUILDINGS": None, "MARKINGS": "MARKINGS", "NAVIGATION": "NAVIGATION"}, "satellites need buildings"),
    ({"ROADS": "ROADS", "TRAJECTORY": "DRIVE"}, "not both"),
    ({"NAVIGATION": ["nowhere.nav"]}, "does not exist"),
    ({"TOP_FIELD": "storeys"}, "no field storeys")])
def test_refusals_are_one_sentence(run, inputs, small_city, change, words):
    places = {"MARKINGS": f"{small_city / 'truth' / 'markings.gpkg'}|layername=mms",
              "NAVIGATION": [str(small_city / "gnss" / "satellites.nav")],
              "ROADS": str(small_city / "truth" / "lanes.gpkg"),
              "DRIVE": [str(small_city / "truth" / "survey_01_trajectory.csv")]}
    given = {name: places.get(value, value) if isinstance(value, str) else value for name, value in change.items()}
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match=words):
        run(ALGORITHM, inputs | given)


def test_roads_in_another_crs_are_refused(run, inputs):
    from qgis.core import QgsProcessingException, QgsVectorLayer

    roads = QgsVectorLayer("LineString?crs=EPSG:6676", "roads", "memory")
    with pytest.raises(QgsProcessingException, match=r"Roads.*Buildings|Buildings.*Roads"):
        run(ALGORITHM, inputs | {"ROADS": roads})


def test_simulated_scans_and_the_report(run, inputs, small_city, tmp_path):
    report = tmp_path / "report.html"
    result = run(ALGORITHM, inputs | {
        "TRAJECTORY": [str(small_city / "truth" / "survey_01_trajectory.csv")], "SPACING": 10.0, "SIMULATE": True,
        "SIMULATE_EVERY": 2, "DRAWS": 2, "OUTPUT_REPORT": str(report)})
    assert 0.5 <= result["INSIDE"] <= 1.0 and -1.0 <= result["RANK"] <= 1.0
    text = report.read_text(encoding="utf-8")
    assert "Predicted against observed" in text and "Worst stretches" in text
