"""urbanmap:exportcitymodel through Processing: models of a layer in all formats."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely

from tests.city_models import PLACE, court, gable_house, town, wall_texture
from urbanmap_qgis.citymodel.city_files import write_city_files
from urbanmap_qgis.geometry.solid import multipolygon

from .conftest import make_feedback

SPACES = {"bldg": "http://www.opengis.net/citygml/building/2.0", "gml": "http://www.opengis.net/gml",
          "uro": "https://www.geospatial.jp/iur/uro/3.2", "app": "http://www.opengis.net/citygml/appearance/2.0"}


def layer(path, rows, crs="EPSG:6677", fields=(("building_id", "text"), ("lod", "text"), ("note", "text"))):
    """A GeoPackage of MultiPolygonZ: rows of a geometry and values."""
    from qgis.core import (
        QgsCoordinateReferenceSystem,
        QgsCoordinateTransformContext,
        QgsFeature,
        QgsField,
        QgsFields,
        QgsGeometry,
        QgsVectorFileWriter,
        QgsWkbTypes,
    )
    from qgis.PyQt.QtCore import QVariant

    made = QgsFields()
    for name, kind in fields:
        made.append(QgsField(name, {"text": QVariant.String, "int": QVariant.LongLong}[kind]))
    options = QgsVectorFileWriter.SaveVectorOptions()
    writer = QgsVectorFileWriter.create(str(path), made, QgsWkbTypes.Type.MultiPolygonZ,
                                        QgsCoordinateReferenceSystem(crs), QgsCoordinateTransformContext(), options)
    for geometry, *values in rows:
        feature = QgsFeature(made)
        feature.setAttributes(list(values))
        if geometry is not None:
            shape = QgsGeometry()
            shape.fromWkb(shapely.to_wkb(geometry))
            feature.setGeometry(shape)
        writer.addFeature(feature)
    del writer
    return str(path)


@pytest.fixture
def models(qgis_app, tmp_path):
    open_house = shapely.MultiPolygon(list(multipolygon([gable_house((60, 0, 0))]).geoms)[1:])
    return layer(tmp_path / "models.gpkg", [
        (multipolygon([gable_house()]), "家 1", "2.2", "a & b"),
        (multipolygon([gable_house((20, 0, 0)), gable_house((40, 0, 0))]), "b", "2.2", None),
        (multipolygon(court((0, 30))), "b", "1.3", None), (open_house, "open", "2.2", None),
        (None, None, "", "no model")])


def run(feedback=None, **parameters):
    import processing

    return processing.run("urbanmap:exportcitymodel", parameters, feedback=feedback)


def test_all_formats_from_one_layer(models, tmp_path):
    feedback = make_feedback()
    results = run(feedback, BUILDINGS=models, HEIGHTS="JGD2011", GEOID_HEIGHT=36.5, CITY_CODE="13101",
                  DATA_DATE="2026-04-01", OUTPUT=str(tmp_path / "out.gpkg"),
                  OUTPUT_CITYJSON=str(tmp_path / "out.city.json"), OUTPUT_CITYJSONSEQ=str(tmp_path / "out.city.jsonl"),
                  OUTPUT_CITYGML=str(tmp_path / "gml"), OUTPUT_TILES=str(tmp_path / "tiles"))
    assert (results["BUILDINGS_WRITTEN"], results["NOT_CLOSED"]) == (5, 1)
    content = json.loads((tmp_path / "out.city.json").read_text(encoding="utf-8"))
    objects = content["CityObjects"]
    assert [name for name, item in objects.items() if item["type"] == "Building"] == [
        "家 1", "b", "b-2", "open", "building-5"]
    assert objects["家 1"]["attributes"]["note"] == "a & b" and objects["家 1"]["attributes"]["roof_max"] == 7.0
    assert objects["家 1"]["attributes"]["data_date"] == "2026-04-01"
    assert [shape["lod"] for shape in objects["b-2"]["geometry"]] == ["0", "0", "1.2", "1.3"]
    assert objects["open"]["geometry"][-1]["type"] == "MultiSurface"
    assert "not closed" in objects["open"]["attributes"]["problems"]
    assert content["metadata"]["referenceSystem"].endswith("/10170")
    assert len((tmp_path / "out.city.jsonl").read_text(encoding="utf-8").splitlines()) == 6
    (path,) = (tmp_path / "gml" / "udx" / "bldg").glob("*.gml")
    root = ElementTree.parse(path).getroot()
    assert len(root.findall(".//bldg:Building", SPACES)) == 4
    assert root.find(".//uro:lod1HeightType", SPACES).text == "2"
    sources = [root.find(f".//uro:geometrySrcDescLod{level}", SPACES).text for level in "012"]
    assert sources == ["112", "112", "112"] and root.find(".//uro:lodType", SPACES).text == "2.0"
    assert (tmp_path / "gml" / "codelists" / "DataQualityAttribute_geometrySrcDesc.xml").is_file()
    assert root.find(".//uro:buildingID", SPACES).text == "13101-bldg-1"
    assert root.find(".//bldg:measuredHeight", SPACES).text == "7.0"
    tileset = json.loads((tmp_path / "tiles" / "tileset.json").read_text())
    assert tileset["root"]["boundingVolume"]["region"][4] == pytest.approx(PLACE[2] + 36.5, abs=0.01)
    said = "\n".join(feedback.warnings)
    assert "2 of 5 ids" in said and "1 of 5 buildings have a solid" in said and "no place in a mesh" in said
    assert "EPSG:6697" not in said and "ellipsoid" not in said


def test_the_layer_has_the_figures(models, tmp_path):
    from qgis.core import QgsVectorLayer

    run(BUILDINGS=models, OUTPUT=str(tmp_path / "out.gpkg"))
    rows = list(QgsVectorLayer(str(tmp_path / "out.gpkg")).getFeatures())
    assert [row["city_id"] for row in rows] == ["家 1", "b", "b-2", "open", "building-5"]
    assert rows[0]["volume_lod22"] == pytest.approx(440) and rows[0]["area_party_walls"] == 0
    assert rows[2]["area_ground"] == pytest.approx(128) and rows[2]["storeys_estimated"] == 2
    assert rows[4]["roof_max"] is None or rows[4]["roof_max"] != rows[4]["roof_max"] or not rows[4]["roof_max"]
    assert "302" in rows[3]["problems"] and rows[0]["note"] == "a & b"


def test_surfaces_tell_roofs(models, tmp_path):
    house = multipolygon([gable_house()])
    kinds = ["ground", *["outer wall"] * 4, "roof", "roof"]
    surfaces = layer(tmp_path / "s.gpkg", [(shapely.MultiPolygon([face]), "家 1", number, kind) for number, (face, kind)
                                           in enumerate(zip(house.geoms, kinds))],
                     fields=(("building_id", "text"), ("roof_id", "int"), ("surface_type", "text")))
    run(BUILDINGS=models, SURFACES=surfaces, OUTPUT_CITYJSON=str(tmp_path / "out.city.json"))
    objects = json.loads((tmp_path / "out.city.json").read_text(encoding="utf-8"))["CityObjects"]
    faces = objects["家 1"]["geometry"][-1]["semantics"]["surfaces"]
    assert [face["roof_id"] for face in faces if face["type"] == "RoofSurface"] == [5, 6]


def test_textures_go_along(models, tmp_path):
    from qgis.core import QgsProcessingException

    from tests.solid_files import write_solids
    from urbanmap_qgis.citymodel.solids import solid_object

    (tmp_path / "tex").mkdir()
    (tmp_path / "tex" / "a.jpg").write_bytes(b"\xff\xd8\xff\xe0 an image")
    house = gable_house()
    write_solids(tmp_path / "textured.city.json",
                   [solid_object("x", {}, [house], [wall_texture(house, 2, "tex/a.jpg")])])
    run(BUILDINGS=models, TEXTURES=str(tmp_path / "textured.city.json"), OUTPUT_CITYJSON=str(tmp_path / "o.city.json"),
        OUTPUT_CITYGML=str(tmp_path / "gml"))
    content = json.loads((tmp_path / "o.city.json").read_text(encoding="utf-8"))
    (texture,) = content["appearance"]["textures"]
    assert (tmp_path / texture["image"]).read_bytes() == (tmp_path / "tex" / "a.jpg").read_bytes()
    root = ElementTree.parse(next((tmp_path / "gml").rglob("*.gml"))).getroot()
    assert root.find(".//app:imageURI", SPACES).text == "53394630_bldg_6697_appearance/a.jpg"
    assert next((tmp_path / "gml").rglob("a.jpg")).read_bytes() == (tmp_path / "tex" / "a.jpg").read_bytes()
    (tmp_path / "no.city.json").write_text("{}")
    with pytest.raises(QgsProcessingException, match="not a CityJSON file"):
        run(BUILDINGS=models, TEXTURES=str(tmp_path / "no.city.json"), OUTPUT_CITYJSON=str(tmp_path / "o3.city.json"))
    (tmp_path / "tex" / "a.jpg").unlink()
    feedback = make_feedback()
    run(feedback, BUILDINGS=models, TEXTURES=str(tmp_path / "textured.city.json"),
        OUTPUT_CITYJSON=str(tmp_path / "o2.city.json"))
    assert any("images of textures are missing" in text for text in feedback.warnings)


def test_what_heights_count_from_is_said_or_asked_for(models, tmp_path):
    feedback = make_feedback()
    run(feedback, BUILDINGS=models, OUTPUT_CITYGML=str(tmp_path / "gml"), OUTPUT_TILES=str(tmp_path / "tiles"))
    said = "\n".join(feedback.warnings)
    assert "EPSG:6697" in said and "above the ellipsoid" in said


@pytest.mark.parametrize(("parameters", "sentence"), [
    ({"CITY_CODE": "13"}, "five digits"), ({"DATA_DATE": "spring"}, "is no day"),
    ({"HEIGHTS": "sea"}, "height system"), ({"GEOID_HEIGHT": 1.0, "GEOID": __file__}, "both given"),
    ({"ID_FIELD": "absent"}, "no field absent")])
def test_mistakes_get_one_sentence(models, tmp_path, parameters, sentence):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match=sentence):
        run(BUILDINGS=models, OUTPUT_CITYJSON=str(tmp_path / "out.city.json"), **parameters)
    assert not (tmp_path / "out.city.json").exists()


def test_images_outside_of_the_models_folder_are_refused(models, tmp_path):
    from qgis.core import QgsProcessingException

    from tests.solid_files import write_solids
    from urbanmap_qgis.citymodel.solids import solid_object

    house = gable_house()
    for number, name in enumerate(("../secret.jpg", "/etc/secret.jpg", "C:\\secret.jpg")):
        path = tmp_path / f"{number}.city.json"
        write_solids(path, [solid_object("x", {}, [house], [wall_texture(house, 2, name)])])
        with pytest.raises(QgsProcessingException, match="not in its own folder"):
            run(BUILDINGS=models, TEXTURES=str(path), OUTPUT_CITYJSON=str(tmp_path / "o.city.json"))


def test_folders_of_other_programs_are_refused(models, tmp_path):
    from qgis.core import QgsProcessingException

    for name, file, parameter in (("tiles", "tileset.json", "OUTPUT_TILES"), ("gml", "a.gml", "OUTPUT_CITYGML")):
        (tmp_path / name).mkdir()
        Path(tmp_path / name / file).write_text('{"asset": {"generator": "x"}}')
        with pytest.raises(QgsProcessingException, match="another program"):
            run(BUILDINGS=models, **{parameter: str(tmp_path / name)})
        assert [path.name for path in (tmp_path / name).iterdir()] == [file]


def test_outlines_are_no_models(qgis_app, tmp_path):
    from qgis.core import QgsProcessingException

    flat = str(tmp_path / "flat.geojson")
    Path(flat).write_text(json.dumps({"type": "FeatureCollection", "crs": {"type": "name", "properties": {
        "name": "EPSG:6677"}}, "features": [{"type": "Feature", "properties": {}, "geometry": {
            "type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]]}}]}))
    with pytest.raises(QgsProcessingException, match="no feature has faces with heights"):
        run(BUILDINGS=flat, OUTPUT_CITYJSON=str(tmp_path / "o.city.json"))


def test_geoparquet_where_gdal_has_it(models, tmp_path):
    from osgeo import ogr
    from qgis.core import QgsProcessingException

    if ogr.GetDriverByName("Parquet") is not None:
        run(BUILDINGS=models, OUTPUT=str(tmp_path / "o.parquet"))
        assert (tmp_path / "o.parquet").read_bytes()[:4] == b"PAR1"
        return
    with pytest.raises(QgsProcessingException, match="cannot write GeoParquet"):
        run(BUILDINGS=models, OUTPUT=str(tmp_path / "o.parquet"))


def test_nothing_asked_for_is_said(models):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="No output"):
        run(BUILDINGS=models)


def test_a_city_model_goes_from_format_to_format(models, tmp_path):
    run(BUILDINGS=models, HEIGHTS="JGD2011", CITY_CODE="13101", OUTPUT_CITYGML=str(tmp_path / "gml"),
        OUTPUT_CITYJSON=str(tmp_path / "first.city.json"))
    (path,) = (tmp_path / "gml" / "udx" / "bldg").glob("*.gml")
    results = run(CITY_MODEL=str(path), GEOID_HEIGHT=36.5, OUTPUT_CITYJSON=str(tmp_path / "second.city.json"),
                  OUTPUT_CITYGML=str(tmp_path / "again"), OUTPUT_TILES=str(tmp_path / "tiles"))
    assert results["BUILDINGS_WRITTEN"] == 4
    first, second = (json.loads((tmp_path / name).read_text(encoding="utf-8"))
                     for name in ("first.city.json", "second.city.json"))
    assert second["metadata"]["referenceSystem"] == first["metadata"]["referenceSystem"]
    assert second["metadata"]["geographicalExtent"] == pytest.approx(first["metadata"]["geographicalExtent"], abs=2e-4)
    house = second["CityObjects"]["家_1" if "家_1" in second["CityObjects"] else next(iter(second["CityObjects"]))]
    assert house["attributes"]["measuredHeight"] == 7.0 and house["attributes"]["gen:note"] == "a & b"
    (again,) = (tmp_path / "again" / "udx" / "bldg").glob("*.gml")
    assert again.name == path.name
    texts = [sorted(element.text for element in ElementTree.parse(file).getroot().iter() if element.text
                    and element.tag.endswith("posList")) for file in (path, again)]
    assert [[float(value) for value in text.split()] for text in texts[0]] == [
        [float(value) for value in text.split()] for text in texts[1]]


def street_space():
    """A road of a carriageway and an island, a post, a tree, and one of which no surface is known."""
    from urbanmap_qgis.citymodel.model import (
        AUXILIARY_AREA,
        CITY_FURNITURE,
        MULTI_SURFACE,
        ROAD,
        SINGLE_TREE,
        TRAFFIC_AREA,
        CityObject,
        CityShape,
        CitySurface,
        CodeValue,
    )

    def area(name, kind, west, east, function):
        corners = np.array([[west, -9, 3.0], [east, -9, 3.0], [east, -3, 3.0], [west, -3, 3.0]])
        ring = corners + PLACE
        shape = CityShape("3", MULTI_SURFACE, ((CitySurface((ring,), id=f"poly_{name}"),),))
        return CityObject(name, {"function": CodeValue(function)}, (shape,), kind)

    areas = area("lane", TRAFFIC_AREA, 0, 30, "1020"), area("island", AUXILIARY_AREA, 30, 34, "3000")
    whole = area("whole", TRAFFIC_AREA, 0, 34, "").shapes[0].surfaces[0].rings
    plain = CityShape("1", MULTI_SURFACE, ((CitySurface(whole),),))
    post = area("post", TRAFFIC_AREA, 40, 41, "").shapes[0].surfaces[0].rings
    return [CityObject("road", {}, (plain,), ROAD, fittings=areas),
            CityObject("post", {"gen:kind": "pole"}, (CityShape("2", MULTI_SURFACE, ((CitySurface(post),),)),),
                       CITY_FURNITURE),
            CityObject("tree", {"height": 4.5}, (plain,), SINGLE_TREE), CityObject("bare", {}, (), SINGLE_TREE)]


def city_of(tmp_path, objects):
    """A folder of CityGML of objects, outside of Japan, where what has no place is written too."""
    model = town(epsg=32633, heights="unknown")
    write_city_files(replace(model, buildings=objects), citygml=tmp_path / "city")
    return str(tmp_path / "city")


def test_roads_and_street_things_go_to_all_formats(qgis_app, tmp_path):
    city = city_of(tmp_path, street_space())
    feedback = make_feedback()
    results = run(CITY_MODEL=city, OUTPUT_CITYJSON=str(tmp_path / "a.city.json"), OUTPUT_TILES=str(tmp_path / "tiles"),
                  OUTPUT_CITYJSONSEQ=str(tmp_path / "a.city.jsonl"), OUTPUT_CITYGML=str(tmp_path / "gml"),
                  feedback=feedback)
    assert (results["BUILDINGS_WRITTEN"], results["NOT_CLOSED"]) == (0, 0)
    assert any("1 roads, 3 things" in line for line in feedback.infos)
    assert any("1 of the roads" in line for line in feedback.warnings)
    objects = json.loads((tmp_path / "a.city.json").read_text(encoding="utf-8"))["CityObjects"]
    assert {name: item["type"] for name, item in objects.items()} == {
        "road": "Road", "post": "CityFurniture", "tree": "SolitaryVegetationObject",
        "bare": "SolitaryVegetationObject"}
    plain, divided = objects["road"]["geometry"]
    assert (plain["lod"], len(plain["boundaries"]), divided["lod"], len(divided["boundaries"])) == ("1", 1, "3", 2)
    assert [(item["type"], item["id"], item["function"]) for item in divided["semantics"]["surfaces"]] == [
        ("TrafficArea", "lane", 1020), ("AuxiliaryTrafficArea", "island", 3000)]
    assert "problems" not in objects["road"]["attributes"] and objects["bare"]["geometry"] == []
    assert len((tmp_path / "a.city.jsonl").read_text(encoding="utf-8").splitlines()) == 5
    assert len(list((tmp_path / "tiles" / "tiles").glob("*_details.glb"))) == 1
    for name in ("roads.gml", "furniture.gml", "trees.gml"):
        first, second = ((Path(folder) / name).read_text(encoding="utf-8") for folder in (city, tmp_path / "gml"))
        assert second.partition("</gml:name>")[2] == first.partition("</gml:name>")[2]  # but for the title


def test_buildings_beside_roads_are_written_as_those_alone(qgis_app, tmp_path):
    buildings = list(town(epsg=32633, heights="unknown").buildings)
    alone, mixed = (city_of(tmp_path / name, objects) for name, objects in (
        ("alone", buildings), ("mixed", [*street_space(), *buildings])))
    found = []
    for name, city in (("alone", alone), ("mixed", mixed)):
        results = run(CITY_MODEL=city, OUTPUT_CITYJSON=str(tmp_path / f"{name}.city.json"), CITY_CODE="13101",
                      OUTPUT_CITYGML=str(tmp_path / f"{name}_gml"))
        assert results["BUILDINGS_WRITTEN"] == len(buildings)
        objects = json.loads((tmp_path / f"{name}.city.json").read_text(encoding="utf-8"))["CityObjects"]
        found.append({key for key, item in objects.items() if item["type"].startswith("Building")})
    assert found[0] == found[1] and found[0]
    assert (tmp_path / "alone_gml" / "buildings.gml").read_bytes() == (
        tmp_path / "mixed_gml" / "buildings.gml").read_bytes()
    assert b"bldgDataQuality" not in (tmp_path / "mixed_gml" / "roads.gml").read_bytes()


def test_either_a_layer_or_a_city_model(models, tmp_path):
    from qgis.core import QgsProcessingException

    for given in ({}, {"BUILDINGS": models, "CITY_MODEL": __file__}):
        with pytest.raises(QgsProcessingException, match="Give either"):
            run(OUTPUT_CITYJSON=str(tmp_path / "o.city.json"), **given)
    with pytest.raises(QgsProcessingException, match="Load city model"):
        run(CITY_MODEL=__file__, OUTPUT=str(tmp_path / "o.gpkg"))
