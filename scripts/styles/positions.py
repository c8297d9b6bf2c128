"""Styles of where a position can be had: satellites, localisation accuracy."""

from __future__ import annotations

from qgis.core import (
    QgsColorRampShader,
    QgsGeometryGeneratorSymbolLayer,
    QgsRasterShader,
    QgsSingleBandPseudoColorRenderer,
)
from qgis.PyQt.QtGui import QColor

from .symbols import fill, marker, rules

SATELLITES = ((3, "below 4 satellites: no position", "#b2182b"), (5, "4 to 5 satellites", "#ef8a62"),
              (8, "6 to 8 satellites", "#fddbc7"), (12, "9 to 12 satellites", "#67a9cf"),
              (1000, "13 satellites and more", "#2166ac"))
"""Upper limit, label and colour of the classes of visible satellites."""


def satellite_visibility(layer) -> None:
    """Places by the number of satellites in line of sight."""
    entries, low = [], -1
    for high, label, colour in SATELLITES:
        entries.append((label, f"\"satellites\" > {low} AND \"satellites\" <= {high}", marker(colour, 1.8)))
        low = high
    rules(layer, (*entries, ("inside a building", "ELSE", marker("#bbbbbb", 1.0))))
    layer.setMapTipTemplate(
        "<b>[% \"satellites\" %]</b> of [% \"above\" %] satellites in line of sight<br>GPS [% \"gps\" %], GLONASS "
        "[% \"glonass\" %], Galileo [% \"galileo\" %], BeiDou [% \"beidou\" %], QZSS [% \"qzss\" %]<br>"
        "[% if(\"pdop\" IS NULL, 'no position', format('PDOP %1', round(\"pdop\", 1))) %]")


def satellite_visibility_area(layer) -> None:
    """Cells by the number of satellites in line of sight, in the same classes."""
    shade = QgsColorRampShader(-1, 1000, None, QgsColorRampShader.Type.Discrete)
    shade.setColorRampItemList([QgsColorRampShader.ColorRampItem(high + 0.5, QColor(colour), label)
                                for high, label, colour in SATELLITES])
    shader = QgsRasterShader()
    shader.setRasterShaderFunction(shade)
    layer.setRenderer(QgsSingleBandPseudoColorRenderer(layer.dataProvider(), 1, shader))


LOCALISATION = (("good", "good", "#1a9850"), ("usable", "usable", "#fee08b"), ("poor", "poor", "#d73027"))


def localisation_accuracy(layer) -> None:
    """Places by class, with their error ellipses ten times as large as on the ground and turned as they lie."""
    entries = []
    for label, kind, colour in LOCALISATION:
        symbol = marker(colour, 1.2)
        ellipse = fill(colour, "#333333", 0.1)
        ellipse.setOpacity(0.35)
        drawn = QgsGeometryGeneratorSymbolLayer.create({"SymbolType": "Fill", "geometryModifier": (
            "make_ellipse($geometry, 10 * \"major\", 10 * \"minor\", \"weakest\")")})
        drawn.setSubSymbol(ellipse)
        symbol.insertSymbolLayer(0, drawn)
        entries.append((label, f"\"class\" = '{kind}'", symbol))
    rules(layer, (*entries, ("nothing can be said", "ELSE", marker("#8c8c8c", 1.4, shape="cross2"))))
    layer.setMapTipTemplate(
        "<b>[% \"class\" %]</b>: [% \"status\" %]<br>along [% round(\"sigma_along\", 2) %] m, across "
        "[% round(\"sigma_across\", 2) %] m, heading [% round(\"sigma_heading\", 2) %]°<br>walls [% \"n_walls\" %], "
        "horizon [% round(100 * \"horizon\") %] %, sky hidden [% round(100 * \"sky\") %] %<br>"
        "[% if(\"alias_share\" > 0.01, format('other place in %1 m: %2 %', round(\"alias_distance\"), "
        "round(100 * \"alias_share\")), '') %]<br>(ellipses 10 times enlarged)")


def localisation_raster(layer) -> None:
    """Cells by the sigma of the weakest direction, as traffic lights."""
    classes = ((0.1, "below 10 cm", "#1a9850"), (0.3, "10 to 30 cm", "#91cf60"), (0.5, "30 to 50 cm", "#fee08b"),
               (1.0, "50 cm to 1 m", "#fc8d59"), (1e6, "above 1 m", "#d73027"))
    shade = QgsColorRampShader(0, 1000, None, QgsColorRampShader.Type.Discrete)
    shade.setColorRampItemList([QgsColorRampShader.ColorRampItem(high, QColor(colour), label)
                                for high, label, colour in classes])
    shader = QgsRasterShader()
    shader.setRasterShaderFunction(shade)
    layer.setRenderer(QgsSingleBandPseudoColorRenderer(layer.dataProvider(), 1, shader))


FIELDS = {
    localisation_accuracy: ("PointZ", "class:string status:string sigma_along:double sigma_across:double "
                            "sigma_heading:double major:double minor:double weakest:double n_walls:integer "
                            "horizon:double sky:double alias_share:double alias_distance:double"),
    satellite_visibility: ("PointZ", "time:double satellites:integer gps:integer glonass:integer galileo:integer "
                           "beidou:integer qzss:integer above:integer pdop:double"),
}
"""Kind of geometry and fields of the layer that each style is for."""

RASTERS = (satellite_visibility_area, localisation_raster,)
"""Styles of rasters of one band."""
