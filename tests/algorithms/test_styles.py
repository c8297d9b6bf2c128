"""The styles of the building layers: read whole, in 2D and 3D, and every value that the layers hold has its symbol."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from urbanmap_qgis.buildings import model_status
from urbanmap_qgis.buildings.outlines import displacement
from urbanmap_qgis.geometry import solid

STYLES = Path(__file__).resolve().parents[2] / "resources" / "styles"
STATUS = [status for status in model_status.STATUSES if status != model_status.NOT_MODELLED]
LAYERS = {
    "segmented_buildings": ("MultiPolygon", "status:string shift_status:string shift_x:double shift_y:double"),
    "roof_polygons": ("PolygonZ", "building_id:integer height:double"),
    "building_models": ("MultiPolygonZ", "status:string"),
    "building_surfaces": ("MultiPolygonZ", "surface_type:string"),
}


@pytest.fixture
def styled(qgis_app):
    """`styled(name, rows)`: a layer of squares with these attributes, in one of the plugin's styles."""
    from qgis import _3d as engine
    from qgis.core import QgsFeature, QgsGeometry, QgsVectorLayer
    from qgis.PyQt.QtXml import QDomDocument

    engine.Qgs3D.initialize()
    kept = []  # renderers go with their layers

    def make(name, rows=()):
        kind, fields = LAYERS[name]
        layer = QgsVectorLayer(f"{kind}?crs=EPSG:6677&" + "&".join(f"field={item}" for item in fields.split()),
                               name, "memory")
        for place, row in enumerate(rows):
            feature = QgsFeature(layer.fields())
            feature.setAttributes(list(row))
            x = 10 * place
            feature.setGeometry(QgsGeometry.fromWkt(
                f"PolygonZ (({x} 0 5, {x + 8} 0 5, {x + 8} 8 5, {x} 8 5, {x} 0 5))"))
            layer.dataProvider().addFeature(feature)
        layer.updateExtents()
        kept.append(layer)
        document = QDomDocument()
        document.setContent((STYLES / f"{name}.qml").read_text(encoding="utf-8"))
        read, message = layer.importNamedStyle(document)
        assert read, message
        return layer

    yield make


def symbols_of(layer):
    """Colour of the symbol that each feature is drawn with, in the order of the features; None: not drawn."""
    from qgis.core import QgsExpressionContext, QgsExpressionContextUtils, QgsRenderContext

    context = QgsRenderContext()
    context.setExpressionContext(QgsExpressionContext(QgsExpressionContextUtils.globalProjectLayerScopes(layer)))
    renderer = layer.renderer().clone()
    renderer.startRender(context, layer.fields())
    colours = []
    for feature in layer.getFeatures():
        context.expressionContext().setFeature(feature)
        symbols = renderer.symbolsForFeature(feature, context)
        last = symbols[0].symbolLayerCount() - 1 if symbols else 0
        colours.append(symbols[0].symbolLayer(min(1, last)).strokeColor().name() + symbols[0].color().name()
                       if symbols else None)
    renderer.stopRender(context)
    return colours


def rules_of(layer):
    """Values and colours of a layer's rule-based 3D renderer."""
    from qgis.core import QgsReadWriteContext
    from qgis.PyQt.QtXml import QDomDocument

    document = QDomDocument()
    element = document.createElement("renderer")
    document.appendChild(element)
    layer.renderer3D().writeXml(element, QgsReadWriteContext())
    rules = [rule for rule in ElementTree.fromstring(document.toString()).iter("rule") if rule.get("description")]
    return {rule.get("description"): next(rule.iter("material")).get("diffuse") for rule in rules}


def test_every_output_style_is_there():
    assert {path.stem for path in STYLES.glob("*.qml")} >= set(LAYERS)


def test_each_status_of_a_model_has_its_own_colour(styled):
    colours = symbols_of(styled("building_models", [(word,) for word in [*STATUS, model_status.NOT_MODELLED]]))
    assert None not in colours
    assert len(set(colours)) == len(colours)


def test_each_status_of_a_model_has_its_own_colour_in_3d(styled):
    rules = rules_of(styled("building_models"))
    assert set(STATUS) <= set(rules)
    assert len({rules[word] for word in STATUS}) == len(STATUS)


def test_each_surface_type_has_its_own_colour_in_2d_and_3d(styled):
    types = [solid.ROOF, solid.OUTER_WALL, solid.INNER_WALL, solid.GROUND]
    layer = styled("building_surfaces", [(word,) for word in types])
    colours = symbols_of(layer)
    assert None not in colours and len(set(colours)) == 4
    rules = rules_of(layer)
    assert len({rules[word] for word in types}) == 4


def test_ground_surfaces_are_drawn_below_roofs_and_roofs_below_walls(styled):
    renderer = styled("building_surfaces").renderer()
    assert renderer.usingSymbolLevels()
    level = {item.value(): item.symbol().symbolLayer(0).renderingPass() for item in renderer.categories()}
    assert level[solid.GROUND] < level[solid.ROOF] < level[solid.INNER_WALL]
    assert level[solid.ROOF] < level[solid.OUTER_WALL]


def test_outlines_show_what_was_found(styled):
    rows = [("ok", displacement.KEPT, 0, 0), ("ok", displacement.MOVED, 0.5, 1),
            ("ok", displacement.NOT_OBSERVABLE, 0, 0), ("too few points", displacement.KEPT, 0, 0),
            ("no points", displacement.NOT_OBSERVABLE, 0, 0)]
    colours = symbols_of(styled("segmented_buildings", rows))
    assert None not in colours and len(set(colours)) == 5


def test_a_moved_outline_points_from_its_old_place(styled):
    from qgis.core import QgsExpression, QgsExpressionContext, QgsExpressionContextUtils

    layer = styled("segmented_buildings", [("ok", displacement.MOVED, 3.0, -4.0)])
    root = layer.renderer().rootRule()
    rule = next(rule for rule in root.children() if "moved" in rule.filterExpression())
    ways = [part.geometryExpression() for part in rule.symbol().symbolLayers()
            if part.layerType() == "GeometryGenerator" and "make_line" in part.geometryExpression()]
    context = QgsExpressionContext(QgsExpressionContextUtils.globalProjectLayerScopes(layer))
    context.setFeature(next(layer.getFeatures()))
    line = QgsExpression(ways[0]).evaluate(context).asPolyline()
    assert (line[1].x() - line[0].x(), line[1].y() - line[0].y()) == pytest.approx((3.0, -4.0))


@pytest.mark.parametrize("heights", [(3.0, 12.0, 250.0), (7.0, 7.0), (-4.0, 0.0)])
def test_roofs_of_any_heights_are_coloured_from_low_to_high(styled, heights):
    colours = symbols_of(styled("roof_polygons", [(1, height) for height in heights]))
    assert None not in colours
    assert len(set(colours)) == len(set(heights))


@pytest.mark.parametrize("name", ["roof_polygons", "building_models", "building_surfaces"])
def test_layers_with_heights_stand_at_their_heights_in_3d(styled, name):
    text = (STYLES / f"{name}.qml").read_text(encoding="utf-8")
    assert styled(name).renderer3D() is not None
    assert 'alt-clamping="absolute"' in text
    assert 'extrusion-height="0"' in text


@pytest.mark.parametrize("name", LAYERS)
def test_styles_carry_no_path_of_the_machine_that_wrote_them(name):
    text = (STYLES / f"{name}.qml").read_text(encoding="utf-8")
    assert "/home/" not in text and "/tmp/" not in text and "\\Users\\" not in text
