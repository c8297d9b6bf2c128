"""How the tables of result layers look: words with units, decimals, results before the user's own columns."""

from __future__ import annotations

import sqlite3
from contextlib import closing

import pytest

SQUARE = "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))"


@pytest.fixture
def styles(plugin):
    return plugin("algorithms.framework.styles")


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
    layers = plugin("algorithms.framework.layers")
    base = layers.make_fields(("owner", "text"))
    _, base = layers.own_fields(base)
    own, plain = layers.own_fields(layers.make_fields(("sigma", "real"), base=base))
    assert own == ("sigma",)
    assert [item.alias() for item in plain] == ["", ""]
