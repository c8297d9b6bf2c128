"""Symbols and renderers that the styles of layers are made of."""

from __future__ import annotations

from qgis import _3d as engine
from qgis.core import (
    Qgis,
    QgsArrowSymbolLayer,
    QgsCategorizedSymbolRenderer,
    QgsFillSymbol,
    QgsGeometryGeneratorSymbolLayer,
    QgsLineSymbol,
    QgsMarkerSymbol,
    QgsRendererCategory,
    QgsRuleBasedRenderer,
    QgsUnitTypes,
)
from qgis.PyQt.QtGui import QColor

EDGE = "#5a4a42"
"""Colour of the edges of models."""


def fill(colour: str, outline: str = EDGE, width_mm: float = 0.2, pen: str = "solid", brush: str = "solid"):
    """A plain fill symbol."""
    return QgsFillSymbol.createSimple({
        "color": colour, "outline_color": outline, "outline_width": str(width_mm), "outline_style": pen,
        "style": brush, "joinstyle": "round"})


def solid_symbol(colour: str):
    """3D symbol for surfaces that have their heights in them: one colour, lit, with edges."""
    material = engine.QgsPhongMaterialSettings()
    # Much ambient light, so that walls that the light from above misses stay bright; roofs are not dazzling then.
    material.setDiffuse(QColor(colour).darker(125))
    material.setAmbient(QColor(colour).darker(180))
    material.setSpecular(QColor("black"))
    return edged(surface_3d(material))


def surface_3d(material: engine.QgsPhongMaterialSettings) -> engine.QgsPolygon3DSymbol:
    """3D symbol of a material for surfaces that have their heights in them."""
    symbol = engine.QgsPolygon3DSymbol()
    if hasattr(symbol, "setMaterialSettings"):  # QGIS 3.30 and later
        symbol.setMaterialSettings(material)
        symbol.setAltitudeClamping(Qgis.AltitudeClamping.Absolute)
    else:
        symbol.setMaterial(material)
        symbol.setAltitudeClamping(engine.Qgs3DTypes.AltClampAbsolute)
    return symbol


def edged(symbol: engine.QgsPolygon3DSymbol) -> engine.QgsPolygon3DSymbol:
    """The symbol with its edges drawn."""
    symbol.setEdgesEnabled(True)
    symbol.setEdgeColor(QColor(EDGE))
    symbol.setEdgeWidth(1)
    return symbol


def renderer_3d(colours: dict[str, str], field: str, other: str):
    """3D renderer with a colour for each value of a field, and `other` for the rest."""
    rule = engine.QgsRuleBased3DRenderer.Rule
    root = rule(None)
    for value, colour in colours.items():
        root.appendChild(rule(solid_symbol(colour), f"\"{field}\" = '{value}'", value))
    known = ", ".join(f"'{value}'" for value in colours)
    root.appendChild(rule(solid_symbol(other), f'"{field}" IS NULL OR "{field}" NOT IN ({known})', "other"))
    return engine.QgsRuleBased3DRenderer(root)


def arrow_along(line: str, colour: str):
    """Symbol layer: a straight arrow along a line that an expression gives."""
    way = QgsGeometryGeneratorSymbolLayer.create({"geometryModifier": line, "SymbolType": "Line"})
    arrow = QgsArrowSymbolLayer()
    arrow.setIsCurved(False)
    arrow.setArrowWidth(0.4)
    arrow.setArrowStartWidth(0.4)
    arrow.setHeadLength(1.4)
    arrow.setHeadThickness(0.9)
    for setter in (arrow.setArrowWidthUnit, arrow.setArrowStartWidthUnit, arrow.setHeadLengthUnit,
                   arrow.setHeadThicknessUnit):
        setter(QgsUnitTypes.RenderUnit.RenderMillimeters)
    arrow.setSubSymbol(fill(colour, colour, 0.1))
    symbol = QgsLineSymbol()
    symbol.changeSymbolLayer(0, arrow)
    way.setSubSymbol(symbol)
    return way


def marker(colour: str, size_mm: float = 1.8, outline: str = "#333333", shape: str = "circle"):
    """A plain point symbol."""
    return QgsMarkerSymbol.createSimple({"name": shape, "color": colour, "size": str(size_mm),
                                         "outline_color": outline, "outline_width": "0.1"})


def rules(layer, entries) -> None:
    """Draw a layer by rules: label, condition and symbol of each."""
    root = QgsRuleBasedRenderer.Rule(None)
    for label, condition, symbol in entries:
        root.appendChild(QgsRuleBasedRenderer.Rule(symbol, 0, 0, condition, label))
    layer.setRenderer(QgsRuleBasedRenderer(root))


def line_symbol(colour: str, width_mm: float, pen: str = "solid"):
    """A plain line symbol."""
    return QgsLineSymbol.createSimple({"line_color": colour, "line_width": str(width_mm), "line_style": pen,
                                       "capstyle": "flat"})


def by_class(layer, symbols: dict) -> None:
    """One symbol for each value of the field class."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("class", [
        QgsRendererCategory(kind, symbol, kind) for kind, symbol in symbols.items()]))
