"""urbanmap:checkcitymodel through Processing."""

from __future__ import annotations

import pytest

ALGORITHM = "urbanmap:checkcitymodel"
MODEL = """<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml"
 xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:uro="https://www.geospatial.jp/iur/uro/3.2">
<gml:boundedBy><gml:Envelope srsName="http://www.opengis.net/def/crs/EPSG/0/6697" srsDimension="3">
<gml:lowerCorner>35 139 0</gml:lowerCorner><gml:upperCorner>36 140 50</gml:upperCorner></gml:Envelope></gml:boundedBy>
<core:cityObjectMember><bldg:Building gml:id="bldg_00000000-0000-4000-8000-000000000001">
<core:creationDate>2026-04-01</core:creationDate><bldg:measuredHeight uom="m">{height}</bldg:measuredHeight>
<bldg:lod0RoofEdge><gml:MultiSurface><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>
35.655 139.76 0 35.655 139.7601 0 35.6551 139.7601 0 35.6551 139.76 0 35.655 139.76 0
</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod0RoofEdge>
<uro:buildingIDAttribute><uro:BuildingIDAttribute><uro:buildingID>13101-bldg-1</uro:buildingID><uro:city>13101</uro:city>
</uro:BuildingIDAttribute></uro:buildingIDAttribute>
<uro:bldgDataQualityAttribute><uro:DataQualityAttribute><uro:geometrySrcDescLod0>112</uro:geometrySrcDescLod0>
</uro:DataQualityAttribute></uro:bldgDataQualityAttribute></bldg:Building></core:cityObjectMember></core:CityModel>"""


@pytest.fixture
def model(tmp_path):
    path = tmp_path / "53394632_bldg_6697_op.gml"
    path.write_text(MODEL.format(height="abc"), encoding="utf-8")
    return path


def test_faults_are_told_with_their_places_tables_and_report(run, read_layer, model, tmp_path):
    results = run(ALGORITHM, {"INPUT": str(model), "EXCLUDE": "D-7.2.2.1", "OUTPUT": str(tmp_path / "f.gpkg"),
                              "OUTPUT_TABLE": str(tmp_path / "t.csv"), "OUTPUT_COUNTS": str(tmp_path / "c.csv"),
                              "OUTPUT_REPORT": str(tmp_path / "r.html")})
    assert (results["OBJECTS"], results["ERRORS"], results["WARNINGS"]) == (1, 1, 0)
    (row,) = read_layer(results["OUTPUT"])
    assert (row.attributes["rule"], row.attributes["requirement"]) == ("L02.value", "L02")
    assert row.attributes["gml_id"] == "bldg_00000000-0000-4000-8000-000000000001" and "abc" in row.attributes["text"]
    assert row.geometry.asPoint().x() == pytest.approx(139.76) and row.geometry.asPoint().y() == pytest.approx(35.655)
    assert "bldg:Building" in (tmp_path / "c.csv").read_text(encoding="utf-8-sig")
    assert "L02" in (tmp_path / "t.csv").read_text(encoding="utf-8-sig")
    assert "abc" in (tmp_path / "r.html").read_text(encoding="utf-8")


def test_sound_model_has_no_fault(run, model):
    model.write_text(MODEL.format(height="8.5"), encoding="utf-8")
    results = run(ALGORITHM, {"INPUT_FOLDER": str(model.parent), "EXCLUDE": "D-7.2.2.1", "OUTPUT": "memory:"})
    assert (results["ERRORS"], results["WARNINGS"]) == (0, 0)


def test_what_cannot_be_checked_is_refused(run, tmp_path):
    with pytest.raises(Exception, match="No file was given"):
        run(ALGORITHM, {"OUTPUT": "memory:"})
    other = tmp_path / "model.json"
    other.write_text("{}", encoding="utf-8")
    with pytest.raises(Exception, match="those of CityGML"):
        run(ALGORITHM, {"INPUT": str(other), "OUTPUT": "memory:"})
