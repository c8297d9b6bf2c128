"""urbanmap:comparemaps through Processing."""

from __future__ import annotations

import pytest
from qgis.core import QgsFeature, QgsGeometry, QgsVectorLayer

ALGORITHM = "urbanmap:comparemaps"
KINDS = {"left": "solid", "lane": "dashed", "right": "solid"}


def lines_layer(shift=0.0, kinds=KINDS, crs="EPSG:6677", sigma=0.02, north=0.0):
    """Three lines of 100 m to the north; the lane line moved to the east."""
    layer = QgsVectorLayer(f"LineString?crs={crs}&field=line_id:integer&field=class:string&field=sigma:double", "lines",
                           "memory")
    made = []
    for number, (name, x) in enumerate((("left", 0.0), ("lane", 3.0), ("right", 6.0), ("stop", None))):
        if name not in kinds:
            continue
        feature = QgsFeature(layer.fields())
        x = x + shift * (name == "lane")
        feature.setGeometry(QgsGeometry.fromWkt(f"LINESTRING({x} {north}, {x} {north + 100.0})"))
        feature.setAttributes([number, kinds[name], sigma])
        made.append(feature)
    layer.dataProvider().addFeatures(made)
    return layer


def areas_layer(shift=0.0):
    layer = QgsVectorLayer("Polygon?crs=EPSG:6677&field=area_id:integer&field=class:string&field=heading:double",
                           "areas", "memory")
    made = []
    for number, kind in enumerate(("crosswalk", "arrow left", "unknown")):
        feature = QgsFeature(layer.fields())
        y = 20.0 * number + 10.0 + shift * (kind != "unknown")
        feature.setGeometry(QgsGeometry.fromWkt(f"POLYGON((1 {y}, 2 {y}, 2 {y + 4}, 1 {y + 4}, 1 {y}))"))
        feature.setAttributes([number, kind, 0.0])
        made.append(feature)
    layer.dataProvider().addFeatures(made)
    return layer


OSM = '<?xml version="1.0"?><osm version="0.6">{nodes}{ways}</osm>'


def osm_map(path, shift=0.0, degrees=True):
    """Three ways of 100 m; the middle one moved to the east."""
    nodes, ways = "", ""
    for number, (x, subtype) in enumerate(((0.0, "solid"), (3.0, "dashed"), (6.0, "solid"))):
        x += shift * (number == 1)
        for end, y in enumerate((0.0, 100.0)):
            place = (f'lat="{35.69 + y / 110940.0:.9f}" lon="{139.75 + x / 90640.0:.9f}"' if degrees
                     else 'lat="" lon=""')
            nodes += (f'<node id="{10 * number + end + 1}" {place}><tag k="local_x" v="{x}"/>'
                      f'<tag k="local_y" v="{y}"/></node>')
        ways += (f'<way id="{100 + number}"><nd ref="{10 * number + 1}"/><nd ref="{10 * number + 2}"/>'
                 f'<tag k="type" v="line_thin"/><tag k="subtype" v="{subtype}"/><tag k="sigma" v="0.02"/></way>')
    path.write_text(OSM.format(nodes=nodes, ways=ways), encoding="utf-8")
    return str(path)


def test_changes_of_layers_are_told_with_their_size(run, read_layer, tmp_path):
    results = run(ALGORITHM, {"OLD_LINES": lines_layer(), "NEW_LINES": lines_layer(0.2, {**KINDS, "left": "dashed"}),
                              "OUTPUT": str(tmp_path / "changes.gpkg"), "OUTPUT_REPORT": str(tmp_path / "report.html")})
    assert (results["MOVED"], results["ADDED"], results["REMOVED"], results["REPAINTED"]) == (1, 0, 0, 1)
    assert results["COMPARED"] == pytest.approx(300.0) and results["SAME"] == pytest.approx(100.0)
    moved, painted = sorted((row.attributes for row in read_layer(results["OUTPUT"])), key=lambda row: row["kind"])
    assert (moved["old_id"], moved["new_id"], moved["element"]) == ("1", "1", "line")
    assert moved["shift"] == pytest.approx(0.2) and moved["azimuth"] == pytest.approx(90.0)
    assert moved["across"] == pytest.approx(-0.2) and moved["significance"] == pytest.approx(0.2 / 0.0283, rel=0.01)
    assert (painted["before"], painted["after"]) == ("solid", "dashed")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "33.3% of 300 m" in page and "stated by both maps" in page and "<svg" in page


def test_maps_without_changes(run, tmp_path):
    results = run(ALGORITHM, {"OLD_LINES": lines_layer(), "NEW_LINES": lines_layer(), "OLD_AREAS": areas_layer(),
                              "NEW_AREAS": areas_layer(), "OUTPUT": "memory:",
                              "OUTPUT_REPORT": str(tmp_path / "report.html")})
    assert not any(results[kind] for kind in ("MOVED", "ADDED", "REMOVED", "REPAINTED"))
    assert 'class="verdict good"' in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_lanelet2_files_and_layers(run, read_layer, tmp_path):
    old, new = osm_map(tmp_path / "old.osm"), osm_map(tmp_path / "new.osm", 0.5)
    results = run(ALGORITHM, {"OLD": old, "NEW": new, "OUTPUT": str(tmp_path / "changes.gpkg")})
    (row,) = read_layer(results["OUTPUT"])
    assert row.attributes["shift"] == pytest.approx(0.5, abs=0.01) and row.attributes["old_id"] == "101"
    # Files with local coordinates alone are compared in them.
    local = [osm_map(tmp_path / f"local_{name}.osm", shift, False) for name, shift in (("old", 0.0), ("new", 0.5))]
    assert run(ALGORITHM, {"OLD": local[0], "NEW": local[1], "OUTPUT": "memory:"})["MOVED"] == 1
    with pytest.raises(Exception, match="only local coordinates"):
        run(ALGORITHM, {"OLD": local[0], "NEW": new, "OUTPUT": "memory:"})
    with pytest.raises(Exception, match="only local coordinates"):
        run(ALGORITHM, {"OLD": local[0], "NEW_LINES": lines_layer(), "OUTPUT": "memory:"})
    with pytest.raises(Exception, match="do not overlap"):
        run(ALGORITHM, {"OLD": old, "NEW_LINES": lines_layer(), "OUTPUT": "memory:"})


def test_settings_and_an_area(run):
    maps = {"OLD_LINES": lines_layer(sigma=None), "NEW_LINES": lines_layer(0.2, sigma=None), "OUTPUT": "memory:"}
    assert run(ALGORITHM, {**maps, "OLD_SIGMA": 0.02, "NEW_SIGMA": 0.02})["MOVED"] == 1
    assert run(ALGORITHM, {**maps, "OLD_SIGMA": 0.2, "NEW_SIGMA": 0.02})["MOVED"] == 0
    assert run(ALGORITHM, {**maps, "OLD_SIGMA": 0.02, "NEW_SIGMA": 0.02, "LEAST_SHIFT": 0.3})["MOVED"] == 0
    far = run(ALGORITHM, {**maps, "OLD_SIGMA": 0.02, "NEW_SIGMA": 0.02, "REACH": 0.15})
    assert (far["MOVED"], far["ADDED"], far["REMOVED"]) == (0, 1, 1)
    area = QgsVectorLayer("Polygon?crs=EPSG:6677", "area", "memory")
    feature = QgsFeature()
    feature.setGeometry(QgsGeometry.fromWkt("POLYGON((-9 -9, 9 -9, 9 50, -9 50, -9 -9))"))
    area.dataProvider().addFeatures([feature])
    only = {**KINDS}
    del only["lane"]
    results = run(ALGORITHM, {"OLD_LINES": lines_layer(), "NEW_LINES": lines_layer(kinds=only), "AREA": area,
                              "OUTPUT": "memory:"})
    assert results["REMOVED"] == 1


@pytest.mark.parametrize("given, words", [
    ({"OLD_LINES": lines_layer}, "Give the new map"), ({"NEW_LINES": lines_layer}, "Give the old map"),
    ({"OLD_LINES": lines_layer, "NEW_LINES": lambda: lines_layer(crs="EPSG:6676")}, "reproject one of them"),
    ({"OLD_LINES": lines_layer, "NEW_LINES": lambda: lines_layer(crs="EPSG:4326")}, "projected"),
    ({"OLD_LINES": lines_layer, "NEW_LINES": lambda: lines_layer(kinds={})}, "new map has no lines"),
    ({"OLD_LINES": lines_layer, "NEW_LINES": lambda: lines_layer(north=5000.0)}, "do not overlap"),
    ({"OLD_LINES": lines_layer, "NEW_LINES": lambda: QgsVectorLayer("LineString?crs=EPSG:6677", "x", "memory")},
     "no field class")])
def test_maps_that_cannot_be_compared(run, given, words):
    with pytest.raises(Exception, match=words):
        run(ALGORITHM, {**{name: make() for name, make in given.items()}, "OUTPUT": "memory:"})
