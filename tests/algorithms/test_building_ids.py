"""A building's own id, of any type, comes back in every output; names that a shapefile cuts are known again."""

from __future__ import annotations

import json

import numpy as np
import pytest
import shapely

IDS = {
    "text": (["NL.IMBAG.Pand.0503100000012869-0", "13101-bldg-365"], str),
    "numbers that point clouds cannot hold": ([0, -7], int),
    "digits with zeros before them": (["0012", "0005"], str),
    "fractions": ([1.5, 2.5], str),
    "numbers": ([12, 5], int),
}


@pytest.fixture
def cloud(make_cloud, tmp_path):
    """Two blocks of 12 and 9 m on level ground."""
    axis = np.arange(0.0, 60.0, 0.5)
    x, y = (grid.ravel() for grid in np.meshgrid(axis, axis))
    z = np.where((abs(x - 15) < 8) & (abs(y - 15) < 8), 12.0, 0.0)
    z = np.where((abs(x - 42) < 7) & (abs(y - 40) < 7), 9.0, z)
    return make_cloud(tmp_path / "cloud.laz", x, y, z, classification=np.where(z > 0, 6, 2))


@pytest.mark.parametrize("kind", IDS)
@pytest.mark.parametrize("suffix", ["gpkg", "shp"])
def test_ids_come_back_in_every_output(run, read_layer, save_outlines, cloud, tmp_path, kind, suffix):
    ids, back = IDS[kind]
    outlines = save_outlines(tmp_path / "outlines.gpkg", [shapely.box(7, 7, 23, 23), shapely.box(35, 33, 49, 47)],
                             {"building_id": ids})
    expected = {back(value) for value in ids}

    def path(name):
        return str(tmp_path / f"{name}.{suffix}")

    def ids_in(layer):
        rows = [item.attributes for item in read_layer(layer)]
        assert all(("bldg_no" in row) == (kind != "numbers") for row in rows)
        return {row.get("building_id", row.get("building_i")) for row in rows}

    first = run("urbanmap:segmentbuildings", {"POINTS": [str(cloud)], "FOOTPRINTS": str(outlines), "WORKERS": 1,
                                              "OUTPUT": str(tmp_path / "b.laz"), "OUTPUT_BUILDINGS": path("b")})
    assert first["WITHOUT_POINTS"] == 0 and ids_in(first["OUTPUT_BUILDINGS"]) == expected
    # In another order, as after a user's sorting: the number goes with the building, not with the place.
    sorting = {"INPUT": first["OUTPUT_BUILDINGS"], "EXPRESSION": "$area", "ASCENDING": True}
    turned = run("native:orderbyexpression", {**sorting, "OUTPUT": str(tmp_path / f"turned.{suffix}")})["OUTPUT"]
    roofs = run("urbanmap:segmentroofs", {"POINTS": [first["OUTPUT"]], "FOOTPRINTS": turned,
                                          "OUTPUT": str(tmp_path / "r.laz"), "OUTPUT_ROOFS": str(tmp_path / "r.gpkg")})
    assert ids_in(roofs["OUTPUT_ROOFS"]) == expected
    polygons = run("urbanmap:roofpolygons", {"POINTS": [roofs["OUTPUT"]], "FOOTPRINTS": turned, "OUTPUT": path("p")})
    assert polygons["WITHOUT_ROOFS"] == 0 and ids_in(polygons["OUTPUT"]) == expected
    models = run("urbanmap:buildingmodels", {
        "ROOFS": polygons["OUTPUT"], "FOOTPRINTS": turned, "POINTS": [roofs["OUTPUT"]],
        "OUTPUT": str(tmp_path / "m.gpkg"),
        "OUTPUT_SURFACES": str(tmp_path / "s.gpkg"), "OUTPUT_CITYJSON": str(tmp_path / "m.city.json"),
        "OUTPUT_MESH": str(tmp_path / "m.obj"), "OUTPUT_REPORT": str(tmp_path / "m.html")})
    assert models["MODELLED"] == 2
    assert ids_in(models["OUTPUT"]) == ids_in(models["OUTPUT_SURFACES"]) == expected
    heights = {row.attributes.get("building_id", row.attributes.get("building_i")): row.attributes["height"]
               for row in read_layer(models["OUTPUT"])}
    assert [heights[back(value)] for value in ids] == pytest.approx([12.0, 9.0], abs=0.2)
    names = {f"building-{value}" if kind == "numbers" else str(value) for value in ids}
    assert set(json.loads((tmp_path / "m.city.json").read_text())["CityObjects"]) == names
    assert all(f"g {name}\n" in (tmp_path / "m.obj").read_text() for name in names)
    meshes = run("urbanmap:mesh25d", {"POINTS": [str(cloud)], "FOOTPRINTS": turned,
                                         "OUTPUT": str(tmp_path / "t.gpkg")})
    assert ids_in(meshes["OUTPUT"]) == expected


def test_merged_models_keep_the_ids(run, read_layer, polygon_layer, tmp_path):
    box = shapely.box(0, 0, 20, 10)
    faces = [shapely.force_3d(box, 10.0), shapely.force_3d(box.reverse(), 0.0)]
    ring = list(box.exterior.coords)
    faces += [shapely.Polygon([(*a, 0), (*b, 0), (*b, 10), (*a, 10)]) for a, b in zip(ring, ring[1:])]
    models = polygon_layer([shapely.MultiPolygon(faces).wkt], fields={"building_id": ["A-1"]}, kind="MultiPolygonZ")
    walls = polygon_layer([shapely.Polygon([(0, -0.3, 0), (20, -0.3, 0), (20, -0.3, 10), (0, -0.3, 10)]).wkt],
                          fields={"rmse": [0.02], "status": ["ok"]}, kind="PolygonZ")
    made = run("urbanmap:mergebuildingmodels", {
        "MODELS": models, "WALLS": walls, "OUTPUT": str(tmp_path / "m.gpkg"),
        "OUTPUT_WALLS": str(tmp_path / "w.gpkg"), "OUTPUT_CITYJSON": str(tmp_path / "m.city.json")})
    for name in ("OUTPUT", "OUTPUT_WALLS"):
        assert {row.attributes["building_id"] for row in read_layer(made[name])} == {"A-1"}
    (objects,) = json.loads((tmp_path / "m.city.json").read_text())["CityObjects"].items()
    assert objects[0] == "A-1" and objects[1]["attributes"]["building_id"] == "A-1"
