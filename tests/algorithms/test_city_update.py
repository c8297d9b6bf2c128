"""buildingoutlines and updatebuildings as a user runs them: outlines, models of them, and a street that changes."""

from __future__ import annotations

import json

import pytest
import shapely

from tests.laser_blocks import CRS, block_points, write_block

HOUSES = [shapely.box(x, y, x + 12, y + 10) for y in (20, 60) for x in (10, 40, 70)]


def cloud(folder, name, roofs, seed):
    return str(write_block(folder / f"{name}.laz", *block_points(10.0, roofs=roofs, seed=seed)))


@pytest.fixture(scope="module")
def epochs(tmp_path_factory):
    """Two clouds of a street: in the second a house is gone, one is higher, and one is new."""
    folder = tmp_path_factory.mktemp("点群")
    old = [(house, 7.0, 0.3) for house in HOUSES[:5]]
    new = [*old[1:4], (HOUSES[4], 10.0, 0.3), (HOUSES[5], 6.0, 0.0)]
    return cloud(folder, "old", old, 1), cloud(folder, "new", new, 2)


def rows(place):
    from qgis.core import QgsVectorLayer

    layer = QgsVectorLayer(place, "result", "ogr")
    return [({field.name(): feature[field.name()] for field in layer.fields()}, feature.geometry())
            for feature in layer.getFeatures()]


def test_outlines_become_models_and_the_models_are_updated(run, epochs, tmp_path):
    old, new = epochs
    found = run("urbanmap:buildingoutlines", {
        "POINTS": [old], "POINTS_CRS": CRS, "OUTPUT": str(tmp_path / "outlines.gpkg"),
        "OUTPUT_REPORT": str(tmp_path / "r.html")})
    assert (found["BUILDINGS"], found["OTHERS"]) == (5, 0)
    assert found["AREA"] == pytest.approx(600, rel=0.06)
    assert "5" in (tmp_path / "r.html").read_text(encoding="utf-8")
    run("urbanmap:buildingsfromals", {"POINTS": [old], "FOOTPRINTS": found["OUTPUT"], "MAX_DISPLACEMENT": 0,
                                      "OUTPUT": str(tmp_path / "models.gpkg")})
    made = run("urbanmap:updatebuildings", {
        "BUILDINGS": str(tmp_path / "models.gpkg"), "POINTS": [new], "DATE": "2026-04-01",
        "OUTPUT": str(tmp_path / "updated.gpkg"), "OUTPUT_CITYJSON": str(tmp_path / "updated.city.json"),
        "OUTPUT_REPORT": str(tmp_path / "update.html")})
    assert {name: made[name] for name in ("NEW", "GONE", "CHANGED", "SAME", "UNSEEN")} == {
        "NEW": 1, "GONE": 1, "CHANGED": 1, "SAME": 3, "UNSEEN": 0}
    before = {row["building_id"]: geometry.asWkb() for row, geometry in rows(str(tmp_path / "models.gpkg"))}
    after = {row["building_id"]: (row, geometry) for row, geometry in rows(made["OUTPUT"])}
    kinds = {number: row["change"] for number, (row, _) in after.items()}
    same = [number for number, kind in kinds.items() if kind == "same"]
    assert all(after[number][1].asWkb() == before[number] for number in same)
    raised, = [row for row, _ in after.values() if row["change"] == "raised"]
    assert raised["height_change"] == pytest.approx(3.0, abs=0.1) and raised["surveyed"] == "2026-04-01"
    objects = json.loads((tmp_path / "updated.city.json").read_text(encoding="utf-8"))["CityObjects"]
    gone, = [str(number) for number, kind in kinds.items() if kind == "gone"]
    assert {str(number) for number in kinds} - set(objects) == {gone}


def test_one_old_model_is_asked_for(run, epochs, tmp_path):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="Give either"):
        run("urbanmap:updatebuildings", {"POINTS": [epochs[1]], "OUTPUT": str(tmp_path / "none.gpkg")})
