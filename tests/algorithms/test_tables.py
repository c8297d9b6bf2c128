"""How the tables of result layers look: words with units, decimals, results before the user's own columns."""

from __future__ import annotations

import re
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

SQUARE = "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))"


@pytest.fixture
def styles(plugin):
    return plugin("algorithms.framework.layers.styles")


def test_results_come_first_and_have_units(styles, qgis_app):
    from qgis.core import QgsVectorLayer
    from qgis.PyQt.QtXml import QDomDocument

    layer = QgsVectorLayer("Polygon?crs=EPSG:6677&field=owner:string&field=height:double&field=sigma:double&"
                           "field=points:int", "table", "memory")
    names = [field.name() for field in layer.fields()]
    document = QDomDocument()
    document.setContent(styles.style_text("", names, ("sigma", "points")))
    read, message = layer.importNamedStyle(document)
    assert read, message
    assert [layer.attributeAlias(index) for index in range(4)] == ["", "", "standard deviation (m)", "points"]
    assert layer.editorWidgetSetup(2).config()["Precision"] == 3
    columns = [column.name for column in layer.attributeTableConfig().columns()]
    assert columns[:4] == ["sigma", "points", "owner", "height"]


def test_a_geopackage_keeps_the_words_of_results_only(styles, plugin, qgis_app, tmp_path):
    from qgis.core import QgsVectorFileWriter, QgsVectorLayer

    made = QgsVectorLayer("Point?crs=EPSG:6677&field=height:double&field=sigma:double", "t", "memory")
    path = tmp_path / "t.gpkg"
    options = QgsVectorFileWriter.SaveVectorOptions()
    QgsVectorFileWriter.writeAsVectorFormatV3(made, str(path), made.transformContext(), options)
    styles.save_style(path, "", ("sigma",), plugin("urbanmap_qgis.progress").SILENT)
    layer = QgsVectorLayer(str(path), "t", "ogr")
    assert layer.attributeAlias(layer.fields().indexOf("sigma")) == "standard deviation (m)"
    assert layer.attributeAlias(layer.fields().indexOf("height")) == ""
    with closing(sqlite3.connect(path)) as database:
        assert database.execute("SELECT count(*) FROM layer_styles").fetchone() == (1,)


def test_fields_of_the_user_carry_no_mark_into_the_file(plugin, qgis_app):
    layers = plugin("algorithms.framework.layers.layers")
    base = layers.make_fields(("owner", "text"))
    _, base = layers.own_fields(base)
    own, plain = layers.own_fields(layers.make_fields(("sigma", "real"), base=base))
    assert own == ("sigma",)
    assert [item.alias() for item in plain] == ["", ""]


def test_words_of_an_earlier_step_stay_and_the_user_s_are_not_touched(qgis_app, run, small_city, tmp_path):
    """Outlines found in the points by one run, used by the next; the user's field has the name of one of ours."""
    from qgis.core import QgsVectorLayer

    outlines = tmp_path / "outlines.gpkg"
    run("native:fieldcalculator", {"INPUT": str(small_city / "footprints" / "gsi_buildings.gpkg"), "FIELD_TYPE": 0,
                                   "FIELD_NAME": "height", "FORMULA": "1", "OUTPUT": str(outlines)})
    points = [str(small_city / "als" / "als.laz")]
    found, meshes = tmp_path / "found.gpkg", tmp_path / "meshes.gpkg"
    run("urbanmap:segmentbuildings", {"POINTS": points, "FOOTPRINTS": str(outlines), "OUTPUT_BUILDINGS": str(found),
                                      "OUTPUT": str(tmp_path / "found.laz"), "WORKERS": 1})
    run("urbanmap:mesh25d", {"POINTS": [str(tmp_path / "found.laz")], "FOOTPRINTS": str(found), "OUTPUT": str(meshes),
                             "WORKERS": 1})
    first, layer = QgsVectorLayer(str(found), "f", "ogr"), QgsVectorLayer(str(meshes), "t", "ogr")
    names = [item.name() for item in layer.fields()]
    assert first.attributeAlias(first.fields().indexOf("height")) == ""
    assert layer.attributeAlias(names.index("shift_x")) == "shift east (m)"
    assert layer.editorWidgetSetup(names.index("shift_x")).config()["Precision"] == 3
    assert layer.attributeAlias(names.index("orgGILvl")) == ""
    shown = [item.name for item in layer.attributeTableConfig().columns() if not item.hidden]
    assert shown.index("triangles") < shown.index("shift_x") < shown.index("orgGILvl")


def test_a_field_that_one_input_has_without_words_stays_without(plugin, qgis_app, monkeypatch):
    from types import SimpleNamespace

    from qgis.core import QgsVectorLayer

    module = plugin("algorithms.framework.layers.earlier_words")
    inputs = {"USER": QgsVectorLayer("Point?field=sigma:double&field=owner:string", "theirs", "memory"),
              "STEP": QgsVectorLayer("Point?field=sigma:double&field=up:double", "ours", "memory")}
    algorithm = SimpleNamespace(
        parameterDefinitions=lambda: [SimpleNamespace(name=lambda n=n: n, type=lambda: "source") for n in inputs],
        parameterAsVectorLayer=lambda parameters, name, context: inputs[name])
    found = iter(({}, {"sigma": "words", "up": "words"}))
    monkeypatch.setattr(module, "words_in_file", lambda path: next(found))
    assert module.earlier_words(algorithm, dict.fromkeys(inputs, "given"), None) == (("up", "words"),)


def test_words_are_read_from_a_style(plugin, qgis_app, tmp_path):
    module = plugin("algorithms.framework.layers.earlier_words")
    words = plugin("algorithms.framework.layers.field_words").FieldWords
    styled = """<!DOCTYPE qgis><qgis><aliases><alias index="0" field="sigma" name="sigma (m)"/>
        <alias index="1" field="owner" name=""/></aliases><fieldConfiguration><field name="sigma"><editWidget>
        <config><Option type="Map"><Option name="Precision" value="3"/></Option></config></editWidget></field>
        </fieldConfiguration></qgis>"""
    assert module.words_in_style(styled) == {"sigma": words("sigma (m)", 3)}
    bomb = styled.replace("<qgis", '<!DOCTYPE qgis [<!ENTITY a "b">]><qgis', 1)
    assert "ENTITY" in bomb and module.words_in_style(bomb) == {}
    assert module.words_in_style("no style") == {} == module.words_in_file(tmp_path / "none.gpkg")


def test_fields_have_the_kinds_of_their_words(plugin):
    """What a layer holds cannot be left without words: a field that has none is refused."""
    make_fields = plugin("algorithms.framework.layers.layers").make_fields
    real, whole, text, truth = (make_fields(("own", kind))[0].type() for kind in ("real", "int", "text", "bool"))
    assert [item.type() for item in make_fields("sigma", "points", "status", "valid")] == [real, whole, text, truth]
    assert [item.type() for item in make_fields("turn", "before")] == [real, real]
    assert [item.type() for item in make_fields("turn", "before", style="lanes")] == [text, real]
    with pytest.raises(KeyError, match="no words for unheard"):
        make_fields("unheard")


def test_words_in_the_layers_of_a_style_are_of_a_style_that_there_is(plugin):
    module = plugin("algorithms.framework.layers.field_words")
    for style, field in module._OF_STYLE:
        assert (ROOT / "resources" / "styles" / f"{style}.qml").is_file(), style
        assert module.words_of(field, style) != module.words_of(field), (style, field)


def test_what_has_a_unit_has_decimals_and_no_more_than_mean_something(plugin):
    """Lengths, angles and shares: at most millimetres or thousandths."""
    module = plugin("algorithms.framework.layers.field_words")
    for words in (*module._WORDS.values(), *module._OF_STYLE.values()):
        unit = re.search(r"\((m|m²|m³|s|MB|°|km/h)\)$", words.words) or words.words.endswith("0 to 1")
        assert not unit or words.decimals is not None, words
        assert words.decimals is None or words.decimals <= (4 if "unit beside" in words.words else 3), words


@pytest.mark.parametrize("path", sorted((ROOT / "resources" / "styles").glob("*.qml")), ids=lambda path: path.stem)
def test_styles_name_no_font(path):
    """A font that a machine lacks would be replaced, with a warning: texts take the application's."""
    assert not re.search(r'fontFamily|font-family|fontName="[^"]', path.read_text(encoding="utf-8"))
