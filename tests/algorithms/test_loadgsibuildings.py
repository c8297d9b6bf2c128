"""Load GSI buildings through Processing."""

from __future__ import annotations

import pytest

ALGORITHM = "urbanmap:loadgsibuildings"
POSITIONS = "35.69 139.76 35.69 139.7601 35.6901 139.7601 35.6901 139.76 35.69 139.76"


def building(name, shift=0.0, srs="fguuid:jgd2011.bl"):
    """A BldA object of about 9 x 11 m; `shift` moves it east, degrees."""
    positions = [float(text) for text in POSITIONS.split()]
    positions[1::2] = [value + shift for value in positions[1::2]]
    text = " ".join(f"{value:.9f}" for value in positions)
    return (f'<BldA gml:id="{name}"><fid>fid-{name}</fid><devDate><gml:timePosition>2024-04-01</gml:timePosition>'
            f'</devDate><orgGILvl>2500</orgGILvl><area><gml:Surface srsName="{srs}"><gml:patches>'
            "<gml:PolygonPatch><gml:exterior><gml:Ring><gml:curveMember><gml:Curve><gml:segments>"
            f"<gml:LineStringSegment><gml:posList>{text}</gml:posList></gml:LineStringSegment></gml:segments>"
            "</gml:Curve></gml:curveMember></gml:Ring></gml:exterior></gml:PolygonPatch></gml:patches></gml:Surface>"
            "</area><type>普通建物</type></BldA>")


def dataset(*objects):
    return ('<?xml version="1.0" encoding="UTF-8"?><Dataset xmlns:gml="http://www.opengis.net/gml/3.2" '
            f'xmlns="http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema">{"".join(objects)}</Dataset>')


@pytest.fixture
def outlines(tmp_path):
    """A file of two buildings in a folder with a Japanese name."""
    folder = tmp_path / "基盤地図情報"
    folder.mkdir()
    path = folder / "FG-GML-533946-BldA-20240401-0001.xml"
    path.write_text(dataset(building("b1"), building("b2", 0.001)), encoding="utf-8")
    return path


def test_file_to_geopackage_in_the_fitting_zone(run, read_layer, outlines, tmp_path):
    target = tmp_path / "建物.gpkg"
    result = run(ALGORITHM, {"INPUT": str(outlines), "OUTPUT": str(target)})
    assert result["BUILDINGS"] == 2 and result["CRS_NAME"] == "EPSG:6677"
    features = read_layer(result["OUTPUT"])
    assert [item.attributes["building_id"] for item in features] == [1, 2]
    assert features[0].geometry.area() == pytest.approx(9.05 * 11.1, rel=0.01)
    values = features[0].attributes
    assert (values["gml_id"], values["gsi_fid"], values["type"]) == ("b1", "fid-b1", "普通建物")
    assert values["source"] == outlines.name and values["devDate"] == "2024-04-01"
    assert not values["lfSpanTo"]

    from qgis.core import QgsVectorLayer

    layer = QgsVectorLayer(str(target), "stored", "ogr")
    assert layer.crs().authid() == "EPSG:6677"
    assert layer.fields().at(1).name() == "building_id" or layer.fields().at(0).name() == "building_id"
    assert layer.renderer().type() == "categorizedSymbol"


@pytest.mark.parametrize("parameter", ["INPUT", "INPUT_FOLDER"])
def test_folder_in_either_parameter(run, read_layer, outlines, parameter):
    for folder in (str(outlines.parent), f"{outlines.parent}/"):
        result = run(ALGORITHM, {parameter: folder, "OUTPUT": "memory:"})
        assert result["BUILDINGS"] == 2


def test_chosen_crs(run, read_layer, outlines):
    result = run(ALGORITHM, {"INPUT": str(outlines), "CRS": "EPSG:32654", "OUTPUT": "memory:"})
    assert result["OUTPUT"].crs().authid() == "EPSG:32654" and result["CRS_NAME"] == "EPSG:32654"


def test_agrees_with_qgis_own_transformation(run, read_layer, outlines):
    from qgis.core import QgsCoordinateReferenceSystem, QgsCoordinateTransform, QgsProject

    transform = QgsCoordinateTransform(QgsCoordinateReferenceSystem("EPSG:6668"),
                                       QgsCoordinateReferenceSystem("EPSG:6677"), QgsProject.instance())
    expected = transform.transform(139.76, 35.69)
    box = read_layer(run(ALGORITHM, {"INPUT": str(outlines), "OUTPUT": "memory:"})["OUTPUT"])[0].geometry
    assert box.vertexAt(0).distance(expected.x(), expected.y()) < 1e-4


def test_what_was_changed_is_told(run, outlines):
    outlines.write_text(dataset(building("b1", srs="fguuid:jgd2000.bl")), encoding="utf-8")
    run(ALGORITHM, {"INPUT": str(outlines), "OUTPUT": "memory:"})
    assert any("PatchJGD" in text for text in run.feedback.warnings)


@pytest.mark.parametrize(("content", "says"), [
    (dataset(building("b1"))[:-40], "not whole"), (dataset("<RdEdg/>"), "no building outlines")])
def test_bad_file_is_one_sentence_and_keeps_the_earlier_result(run, outlines, tmp_path, content, says):
    from qgis.core import QgsProcessingException

    target = tmp_path / "kept.gpkg"
    run(ALGORITHM, {"INPUT": str(outlines), "OUTPUT": str(target)})
    before = target.read_bytes()
    outlines.write_text(content, encoding="utf-8")
    with pytest.raises(QgsProcessingException, match=says) as caught:
        run(ALGORITHM, {"INPUT": str(outlines), "OUTPUT": str(target)})
    assert outlines.name in str(caught.value)
    assert target.read_bytes() == before


def test_nothing_given_is_refused_before_the_run(qgis_app):
    from qgis.core import QgsApplication, QgsProcessingContext

    algorithm = QgsApplication.processingRegistry().createAlgorithmById(ALGORITHM)
    accepted, message = algorithm.checkParameterValues({"OUTPUT": "memory:"}, QgsProcessingContext())
    assert not accepted and "No file was given" in message


def test_every_parameter_and_output_is_explained(qgis_app):
    from qgis.core import QgsApplication

    algorithm = QgsApplication.processingRegistry().createAlgorithmById(ALGORITHM)
    assert all(item.help() for item in algorithm.parameterDefinitions())
    text = algorithm.shortHelpString()
    for item in algorithm.outputDefinitions():
        assert item.description() in text
