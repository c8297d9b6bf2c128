"""urbanmap:markinglines through Processing."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

ALGORITHM = "urbanmap:markinglines"
EAST, NORTH = -7000.0, -34000.0


def rectangle(x, y, length, width):
    return shapely.box(EAST + x, NORTH + y - width / 2, EAST + x + length, NORTH + y + width / 2).wkt


@pytest.fixture
def street(polygon_layer):
    solid = [rectangle(0, 0, 45, 0.15)]
    dashed = [rectangle(x, 3.25, 3, 0.15) for x in np.arange(0, 45, 7.5)]
    zebra = [rectangle(50, y, 4, 0.45) for y in np.arange(-1.0, 5.0, 0.9)]
    return polygon_layer([*solid, *dashed, *zebra], "EPSG:6677", {"colour": ["yellow"] + ["white"] * (6 + len(zebra))})


def test_lines_and_areas_with_their_fields(run, read_layer, street, tmp_path):
    results = run(ALGORITHM, {"MARKINGS": street, "SIGMA": 0.05, "OUTPUT": str(tmp_path / "lines.gpkg"),
                              "OUTPUT_AREAS": str(tmp_path / "areas.gpkg")})
    rows = [row.attributes for row in read_layer(results["OUTPUT"])]
    by_class = {row["class"]: row for row in rows}
    assert set(by_class) == {"solid", "dashed"} and results["LINES"] == 2
    assert by_class["solid"]["colour"] == "yellow" and by_class["dashed"]["colour"] == "white"
    assert by_class["dashed"]["period"] == pytest.approx(7.5, abs=0.05)
    assert len(by_class["dashed"]["dashes"].split(";")) == 6
    assert all(0.05 <= row["sigma"] < 0.06 for row in rows)
    assert results["CROSSWALKS"] == 1 and results["UNKNOWN_SHARE"] == 0.0


def test_ground_of_another_system_is_refused(run, street, tmp_path):
    import rasterio
    from rasterio.transform import from_origin

    path = tmp_path / "ground.tif"
    with rasterio.open(path, "w", driver="GTiff", width=9, height=9, count=1, dtype="float32", crs="EPSG:32654",
                       transform=from_origin(EAST, NORTH, 1, 1)) as file:
        file.write(np.zeros((1, 9, 9), np.float32))
    with pytest.raises(Exception, match="Ground elevation"):
        run(ALGORITHM, {"MARKINGS": street, "GROUND": str(path), "OUTPUT": "memory:", "OUTPUT_AREAS": "memory:"})


def test_polygons_without_lines_say_so(run, polygon_layer, feedback):
    layer = polygon_layer([shapely.box(EAST, NORTH, EAST + 9, NORTH + 9).wkt], "EPSG:6677", {})
    results = run(ALGORITHM, {"MARKINGS": layer, "OUTPUT": "memory:", "OUTPUT_AREAS": "memory:"})
    assert results["LINES"] == 0 and results["UNKNOWN_SHARE"] == pytest.approx(1.0)
    assert any("No line was found" in text for text in feedback.warnings)


def scanned_dashes(make_cloud, path, epsg=6677):
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0, 60, 0.06), np.arange(-0.06, 0.07, 0.03)))
    on = x % 7.5 < 3.0
    return str(make_cloud(path, EAST + x[on], NORTH + y[on], np.zeros(on.sum()), epsg))


def test_marking_points_alone_and_with_polygons(run, read_layer, polygon_layer, make_cloud, tmp_path):
    points = scanned_dashes(make_cloud, tmp_path / "marking.laz")
    outputs = {"OUTPUT": "memory:", "OUTPUT_AREAS": "memory:"}
    alone = run(ALGORITHM, {"POINTS": [points], **outputs})
    seen = polygon_layer([rectangle(x, 0, 3, 0.15) for x in (0, 7.5, 37.5, 45, 52.5)], "EPSG:6677", {})
    for results in (alone, run(ALGORITHM, {"MARKINGS": seen, "POINTS": [points], **outputs})):
        (line,) = [row.attributes for row in read_layer(results["OUTPUT"])]
        assert line["class"] == "dashed" and len(line["dashes"].split(";")) == 8 and not line["placed"]
        assert line["period"] == pytest.approx(7.5, abs=0.05) and line["bridged"] < 0.5


def test_markings_or_points_must_be_given_and_in_one_system(run, street, make_cloud, tmp_path):
    outputs = {"OUTPUT": "memory:", "OUTPUT_AREAS": "memory:"}
    with pytest.raises(Exception, match="Neither road markings nor marking points"):
        run(ALGORITHM, outputs)
    with pytest.raises(Exception, match="whole surfaces"):
        x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0, 8, 0.06), np.arange(0, 8, 0.06)))
        cloud = make_cloud(tmp_path / "all.laz", EAST + x, NORTH + y, 0 * x)
        run(ALGORITHM, {"MARKINGS": street, "POINTS": [str(cloud)], **outputs})
