"""Styles of roads: markings, lines, lanes, edges, faults of maps, shifts between frames."""

from __future__ import annotations

from qgis.core import (
    QgsCategorizedSymbolRenderer,
    QgsLineSymbol,
    QgsPalettedRasterRenderer,
    QgsRendererCategory,
    QgsSingleSymbolRenderer,
)
from qgis.PyQt.QtGui import QColor

from .symbols import arrow_along, by_class, fill, line_symbol, marker, rules


def road_markings(layer) -> None:
    """Markings in the colour of their paint, dark at the edge so that they show on light paving too."""
    colours = {"white": "#ffffff", "yellow": "#ffb000"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("colour", [
        QgsRendererCategory(value, fill(colour, "#0b6e4f", 0.26), value) for value, colour in colours.items()]))
    layer.setMapTipTemplate(
        "[% \"colour\" %] marking, [% round(\"area\", 2) %] m²<br>length [% round(\"length\", 2) %] m, width "
        "[% round(\"width\", 2) %] m<br>[% round(\"contrast\") %] grey values above the road")


def doubtful_markings(layer) -> None:
    """Markings to be answered: those without an answer stand out, the others show theirs."""
    rules(layer, [("yes", '"paint" = 1', fill("#66ffffff", "#0b6e4f", 0.5)),
                  ("no", '"paint" = 0', fill("#33ffffff", "#777777", 0.3, pen="dash")),
                  ("not answered", '"paint" IS NULL', fill("#33ffb000", "#d7263d", 0.6))])
    layer.setMapTipTemplate(
        "is it paint? confidence [% round(\"confidence\", 2) %]<br>length [% round(\"length\", 2) %] m, width "
        "[% round(\"width\", 2) %] m")


def marking_lines(layer) -> None:
    """Lines by kind, dashed ones dashed."""
    by_class(layer, {"solid": line_symbol("#2b4c7e", 0.7), "dashed": line_symbol("#2b4c7e", 0.7, "dash"),
                     "stop line": line_symbol("#d7263d", 1.2), "guiding strip": line_symbol("#c9a227", 0.7, "dot")})
    layer.setMapTipTemplate(
        "[% \"class\" %] [% \"colour\" %], [% round(\"length\", 1) %] m, width [% round(\"width\", 2) %] m<br>"
        "sigma [% round(\"sigma\", 3) %] m, bridged [% round(\"bridged\", 1) %] m")


def marking_areas(layer) -> None:
    """Crosswalks and symbols in colours, unknown paint in grey."""
    arrows = ("straight", "left", "right", "straight left", "straight right")
    by_class(layer, {"crosswalk": fill("#2f7f9e"), "diamond": fill("#8a6bb0"), "unknown": fill("#b5b5b5"),
                     **{f"arrow {kind}": fill("#3f8f63") for kind in arrows}, "arrow, kind unknown": fill("#a3c9b0")})


def lanes(layer) -> None:
    """Lanes of lines and those that only drives show through junctions."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("kind", [
        QgsRendererCategory("lane", fill("#f5e9b8"), "lane"),
        QgsRendererCategory("virtual", fill("#f2c9c0", pen="dash"), "virtual, through a junction")]))
    layer.setMapTipTemplate(
        "lane [% \"lane_id\" %], [% round(\"length\", 1) %] m, width [% round(\"width\", 2) %] m<br>"
        "direction by [% \"evidence\" %]<br>leads to [% coalesce(\"successors\", 'nothing known') %]")


def lane_centres(layer) -> None:
    """Arrows in the direction of traffic."""
    symbol = QgsLineSymbol()
    symbol.changeSymbolLayer(0, arrow_along("$geometry", "#d7263d"))
    layer.setRenderer(QgsSingleSymbolRenderer(symbol))


def lane_bounds(layer) -> None:
    """Bounds by kind."""
    by_class(layer, {"solid": line_symbol("#2b4c7e", 0.6), "dashed": line_symbol("#2b4c7e", 0.6, "dash"),
                     "road border": line_symbol("#5a4a42", 0.6), "virtual": line_symbol("#8fa9c9", 0.4, "dot")})


def road_edges(layer) -> None:
    """Edges by kind; doubtful ones dotted."""
    colours = {"kerb": "#3f8f63", "lowered kerb": "#4a8fe7", "road border": "#c9a227", "guard rail": "#8a6bb0",
               "wall": "#5a4a42"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("\"kind\" || ', ' || \"status\"", [
        QgsRendererCategory(f"{kind}, {status}", line_symbol(colour, 0.7, pen), f"{kind}, {status}")
        for kind, colour in colours.items() for status, pen in (("measured", "solid"), ("doubtful", "dot"))]))
    layer.setMapTipTemplate(
        "[% \"kind\" %], [% round(\"height\", 2) %] m high<br>sigma [% round(\"sigma\", 3) %] m, in height "
        "[% round(\"sigma_z\", 3) %] m<br>[% \"status\" %]")


def street_objects(layer) -> None:
    """Objects by kind, doubtful ones hollow."""
    colours = {"pole": "#222222", "lamp post": "#e0a800", "signal": "#d7263d", "sign": "#2b5fb8", "tree": "#3f8f63",
               "bollard": "#8a5a2b", "other upright": "#8a6bb0"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("\"kind\" || ', ' || \"status\"", [
        QgsRendererCategory(f"{kind}, {status}", marker(fill_colour, 2.6, colour), f"{kind}, {status}")
        for kind, colour in colours.items() for status, fill_colour in (
            ("measured", colour), ("doubtful", "#ffffff"))]))
    layer.setMapTipTemplate(
        "<b>[% \"kind\" %]</b>, [% round(\"height\", 1) %] m high, diameter [% round(\"diameter\", 2) %] m<br>"
        "sigma [% round(\"sigma\", 3) %] m, [% \"points\" %] points<br>[% \"status\" %] [% \"reason\" %]")


def street_rails(layer) -> None:
    """Guard rails, doubtful ones dotted."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("status", [
        QgsRendererCategory(status, line_symbol("#8a6bb0", 0.7, pen), status)
        for status, pen in (("measured", "solid"), ("doubtful", "dot"))]))
    layer.setMapTipTemplate("guard rail, [% round(\"height\", 2) %] m high<br>sigma [% round(\"sigma\", 3) %] m")


def map_findings(layer) -> None:
    """Points by what was found."""
    kinds = {"no lane made": "#e09a2b", "open end": "#4a8fe7", "bound not seen": "#b8b03a",
             "direction contradicts": "#d7263d", "driven without lane": "#d7263d", "no drive": "#8a6bb0",
             "stop line without lane": "#9a9a9a", "too narrow": "#d7263d", "way not drawn": "#d7263d",
             "way drawn by width": "#b8b03a", "no height": "#9a9a9a", "way possible": "#4a8fe7",
             "right of way inferred": "#e09a2b"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("kind", [
        QgsRendererCategory(kind, marker(colour, 2.4), kind) for kind, colour in kinds.items()]
        + [QgsRendererCategory("", marker("#d7263d", 2.4), "others")]))
    layer.setMapTipTemplate("[% \"kind\" %]<br>[% \"text\" %]")


def road_surfaces(layer) -> None:
    """Road surfaces by kind, those to be looked at with a red edge."""
    colours = {"road": "#e3e3e3", "junction": "#f6c48f", "bridge": "#a9cbe6", "tunnel": "#c3b3d9"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("\"kind\" || if(\"status\" = 'made', '', ', to look at')", [
        QgsRendererCategory(kind + more, fill(colour, edge, width), kind + more)
        for more, edge, width in (("", "#333333", 0.26), (", to look at", "#d7263d", 0.8))
        for kind, colour in colours.items()]))
    layer.setMapTipTemplate("[% \"kind\" %] [% \"road_id\" %], [% round(\"area\", 1) %] m², mean width "
                            "[% round(\"width\", 2) %] m<br>[% \"status\" %] [% \"finding\" %]")


def road_areas(layer) -> None:
    """Areas of a surveyed road by kind, as the specification draws them; dashed edges where not all was measured."""
    colours = {"carriageway": "#c8c8c8", "junction": "#f6c48f", "lane": "#abdcea", "sidewalk": "#bddcaa",
               "island": "#6aa55e", "road, not surveyed": "#f0f0f0"}
    layer.setRenderer(QgsCategorizedSymbolRenderer(
        "\"kind\" || if(\"source\" in ('continued', 'doubtful'), ', ' || \"source\", '')", [
        QgsRendererCategory(kind + more, fill(colour, pen=pen), kind + more)
        for more, pen in (("", "solid"), (", continued", "dash"), (", doubtful", "dot"))
        for kind, colour in colours.items()]))
    layer.setMapTipTemplate(
        "[% \"kind\" %] [% \"area_id\" %], [% round(\"area\", 1) %] m², width [% round(\"width\", 2) %] m<br>"
        "[% \"source\" %], sigma [% round(\"sigma\", 3) %] m, step [% round(\"step\", 3) %] m")


def road_steps(layer) -> None:
    """Steps, wider where they are high."""
    rules(layer, [(label, condition, line_symbol("#d7263d", width)) for label, condition, width in (
        ("under 15 cm", "\"height\" < 0.14", 0.35), ("15 cm and more", "\"height\" >= 0.14", 0.9))])
    layer.setMapTipTemplate("step of [% round(\"height\", 3) %] m")


def loaded_roads(layer) -> None:
    """Roads of a city model by the code of their kind of section."""
    kinds = {"1": ("#e3e3e3", "ordinary section"), "2": ("#a9cbe6", "viaduct"), "3": ("#a9cbe6", "bridge"),
             "4": ("#f6c48f", "junction"), "5": ("#c3b3d9", "underpass"), "6": ("#c3b3d9", "tunnel"),
             "": ("#f2efe6", "others")}
    layer.setRenderer(QgsCategorizedSymbolRenderer("section", [
        QgsRendererCategory(code, fill(colour), name) for code, (colour, name) in kinds.items()]))
    layer.setMapTipTemplate("[% \"road_id\" %]<br>function [% \"function\" %], section [% \"section\" %]")


def loaded_street_objects(layer) -> None:
    """City furniture and trees of a city model."""
    kinds = {"furniture": "#7a6a9b", "tree": "#5d9b4c"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("kind", [
        QgsRendererCategory(kind, fill(colour), kind) for kind, colour in kinds.items()]))
    layer.setMapTipTemplate("[% \"kind\" %] [% \"object_id\" %]<br>function [% \"function\" %], "
                            "[% round(\"height\", 1) %] m")


def road_axes(layer) -> None:
    """Middle lines of roads, thin through junctions."""
    kinds = {"road": 0.5, "bridge": 0.5, "tunnel": 0.5, "junction": 0.25}
    layer.setRenderer(QgsCategorizedSymbolRenderer("kind", [
        QgsRendererCategory(kind, line_symbol("#2b4c7e", width, "dash"), kind) for kind, width in kinds.items()]))


def road_findings(layer) -> None:
    """Points by what is to be looked at."""
    surveyed = {"edge continued": "#e09a2b", "edge doubtful": "#e09a2b",
                "end of the survey": "#8c8c8c", "not surveyed": "#8c8c8c",
                "no sidewalks": "#8c8c8c", "no lanes": "#8c8c8c", "no stop line": "#e09a2b",
                "island not shown": "#d7263d", "island's height": "#e09a2b", "junction not cut": "#d7263d",
                "other edge not seen": "#e09a2b", "edge without a carriageway": "#8c8c8c",
                "edge beside another": "#8c8c8c", "tram track": "#e09a2b",
                "road above a road": "#d7263d", "given roads moved": "#e09a2b"}
    kinds = {**surveyed, "arm not cut": "#d7263d", "junctions not parted": "#e09a2b", "edge not closed": "#4a8fe7",
             "sides contradict": "#8a6bb0", "surface repaired": "#b8b03a"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("kind", [
        QgsRendererCategory(kind, marker(colour, 2.4), kind) for kind, colour in kinds.items()]
        + [QgsRendererCategory("", marker("#d7263d", 2.4), "others")]))
    layer.setMapTipTemplate("[% \"kind\" %]<br>[% \"text\" %]")


def map_faults(layer) -> None:
    """Points by severity."""
    colours = {"error": "#d7263d", "warning": "#e09a2b", "info": "#4a8fe7"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("severity", [
        QgsRendererCategory(value, marker(colour, 2.4), value) for value, colour in colours.items()]))
    layer.setMapTipTemplate("[% \"rule\" %], [% \"element\" %]<br>[% \"text\" %]")


def map_changes(layer) -> None:
    """Changes between two maps by kind."""
    colours = {"moved": "#e09a2b", "added": "#1a9850", "removed": "#d7263d", "repainted": "#4a6fd7"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("kind", [
        QgsRendererCategory(kind, line_symbol(colour, 0.9), kind) for kind, colour in colours.items()]))
    layer.setMapTipTemplate(
        "<b>[% \"element\" %] [% \"kind\" %]</b><br>[% \"before\" %] → [% \"after\" %]<br>shift "
        "[% round(\"shift\", 3) %] m, [% round(\"significance\", 1) %] sigma")


def marking_mask(layer) -> None:
    """Markings in one strong colour, the rest transparent, to be laid over the orthophoto."""
    entry = QgsPalettedRasterRenderer.Class
    layer.setRenderer(QgsPalettedRasterRenderer(layer.dataProvider(), 1, [
        entry(0, QColor(0, 0, 0, 0), "no marking"), entry(255, QColor("#00c853"), "marking")]))


def frame_shifts(layer) -> None:
    """Shifts between overlapping frames: arrows a hundred times as long, red where the pair is apart, grey where
    heights may displace it."""
    line = "make_line($geometry, translate($geometry, 100 * \"east\", 100 * \"north\"))"
    entries = []
    for label, status, colour in (("agree to half a pixel", "agree", "#1a9850"), ("apart", "apart", "#d73027"),
                                  ("not alike", "not alike", "#7b3294"),
                                  ("displaced by heights", "height", "#8c8c8c")):
        symbol = marker(colour, 1.2)
        symbol.insertSymbolLayer(0, arrow_along(line, colour))
        entries.append((label, f"\"status\" = '{status}'", symbol))
    rules(layer, entries)
    layer.setMapTipTemplate(
        "<b>[% \"second\" %]</b> against [% \"first\" %]: [% \"status\" %]<br>here [% round(\"length\", 2) %] m, "
        "σ [% round(\"sigma\", 2) %] m<br>all [% \"patches\" %] places [% round(\"pair_length\", 2) %] m, "
        "σ [% round(\"pair_sigma\", 3) %] m<br>(arrows 100 times enlarged)")


FIELDS = {
    frame_shifts: ("Point", "first:string second:string east:double north:double length:double sigma:double "
                   "pair_length:double pair_sigma:double patches:integer status:string"),
    marking_lines: ("LineStringZ", "class:string colour:string length:double width:double sigma:double bridged:double"),
    lanes: ("Polygon", "lane_id:integer kind:string evidence:string length:double width:double successors:string"),
    lane_centres: ("LineStringZ", "lane_id:integer kind:string width:double"),
    lane_bounds: ("LineStringZ", "bound_id:integer class:string"),
    road_edges: ("LineStringZ", "kind:string height:double sigma:double sigma_z:double status:string"),
    street_objects: ("PointZ", "kind:string height:double diameter:double sigma:double points:integer status:string "
                     "reason:string"),
    street_rails: ("LineStringZ", "height:double sigma:double status:string"),
    road_surfaces: ("Polygon", "road_id:integer kind:string width:double area:double status:string finding:string"),
    road_areas: ("PolygonZ", "area_id:integer road_id:integer kind:string width:double area:double source:string "
                 "seen:double step:double sigma:double"),
    road_steps: ("LineStringZ", "area_id:integer height:double length:double"),
    loaded_roads: ("MultiPolygon", "road_id:string section:string function:string width:double"),
    loaded_street_objects: ("MultiPolygonZ", "object_id:string kind:string function:string height:double"),
    road_axes: ("LineString", "road_id:integer kind:string width:double length:double"),
    road_findings: ("Point", "kind:string text:string"),
    map_findings: ("Point", "kind:string text:string"),
    map_faults: ("Point", "rule:string severity:string text:string element:string"),
    map_changes: ("LineString", "kind:string element:string before:string after:string shift:double "
                  "significance:double"),
    marking_areas: ("MultiPolygonZ", "class:string score:double heading:double"),
    doubtful_markings: ("Polygon", "paint:integer confidence:double length:double width:double colour:string"),
    road_markings: ("Polygon", "area:double length:double width:double contrast:double colour:string"),
}
"""Kind of geometry and fields of the layer that each style is for."""

RASTERS = (marking_mask,)
"""Styles of rasters of one band."""
