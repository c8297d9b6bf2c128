#!/usr/bin/env python3
"""Write the styles of layers, resources/styles/*.qml, with QGIS's own classes.

    python3 scripts/make_styles.py

Written by the oldest QGIS that the plugin supports (3.22), they are read by all later ones. Needs a Python that
sees QGIS.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from qgis import _3d as engine
from qgis.core import (
    Qgis,
    QgsApplication,
    QgsArrowSymbolLayer,
    QgsCategorizedSymbolRenderer,
    QgsColorRampShader,
    QgsFillSymbol,
    QgsGeometryGeneratorSymbolLayer,
    QgsGraduatedSymbolRenderer,
    QgsLineSymbol,
    QgsMapLayer,
    QgsMarkerSymbol,
    QgsPalettedRasterRenderer,
    QgsRasterLayer,
    QgsRasterShader,
    QgsRendererCategory,
    QgsRendererRange,
    QgsRuleBasedRenderer,
    QgsSingleBandPseudoColorRenderer,
    QgsSingleSymbolRenderer,
    QgsUnitTypes,
    QgsVectorLayer,
)
from qgis.PyQt.QtGui import QColor

STYLES = Path(__file__).resolve().parent.parent / "resources" / "styles"

EDGE = "#5a4a42"
"""Colour of the edges of models."""

MODEL_STATUS = {
    "ok": ("ok", "#e9dcc6"),
    "small": ("small", "#d9d2e9"),
    "few points": ("few points", "#c9b8d8"),
    "partly unseen": ("part of the plan without points", "#b3b8c4"),
    "partly modelled": ("part of the outline without model", "#9aa5b8"),
    "ground unknown": ("ground assumed", "#8fc1d9"),
    "low": ("low", "#6fb7a8"),
    "lost roofs": ("lost roofs", "#f6d55c"),
    "points not explained": ("points not explained", "#e8743b"),
    "simplified": ("simplified", "#f2c14e"),
    "plain block": ("plain block", "#f08a4b"),
}
"""Label and colour of the models' status; those not modelled have no geometry and are kept apart."""

NOT_MODELLED = ("not modelled (see table)", "#d7263d")

SURFACES = {
    "ground": ("ground", "#8d9486"),
    "roof": ("roof", "#b5533c"),
    "outer wall": ("outer wall", "#e3e1dc"),
    "inner wall": ("inner wall", "#a9a49b"),
}
"""Label and colour of each surface type, from the lowest in plan to the uppermost."""

HEIGHT_COLOURS = ("#3b4a8c", "#2f7f9e", "#44a883", "#a5c75a", "#f2d75c", "#f29d50", "#d1574a")
HEIGHT_SHARE = ('coalesce(sqrt(("height" - minimum("height")) / '
                'nullif(maximum("height") - minimum("height"), 0)), 0)')
"""Place of a roof between the lowest (0) and the highest (1): the root, so that one tower does not level the rest."""


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
    symbol = engine.QgsPolygon3DSymbol()
    if hasattr(symbol, "setMaterialSettings"):  # QGIS 3.30 and later
        symbol.setMaterialSettings(material)
        symbol.setAltitudeClamping(Qgis.AltitudeClamping.Absolute)
    else:
        symbol.setMaterial(material)
        symbol.setAltitudeClamping(engine.Qgs3DTypes.AltClampAbsolute)
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


def segmented_buildings(layer) -> None:
    """Outlines by what was found; of a moved one also its old place, dashed, and an arrow."""
    moved = fill("243,156,18,60", "#d35400", 0.46)
    old_place = QgsGeometryGeneratorSymbolLayer.create(
        {"geometryModifier": 'translate($geometry, -"shift_x", -"shift_y")', "SymbolType": "Fill"})
    old_place.setSubSymbol(fill("0,0,0,0", "#7a7a7a", 0.26, "dash", "no"))
    way = arrow_along('make_line(translate(point_on_surface($geometry), -"shift_x", -"shift_y"), '
                      'point_on_surface($geometry))', "#d35400")
    moved.insertSymbolLayer(0, old_place)
    moved.appendSymbolLayer(way)
    enough = "\"status\" = 'ok' AND \"shift_status\" = '{}'"
    rules(layer, (
            ("in its place", enough.format("kept"), fill("39,174,96,50", "#1e8449", 0.46)),
            ("moved to its points", enough.format("moved"), moved),
            ("place not observable", enough.format("not observable"), fill("127,140,141,60", "#616a6b", 0.46)),
            ("too few points", "\"status\" = 'too few points'", fill("155,89,182,60", "#8e44ad", 0.46)),
            ("no points", "ELSE", fill("215,38,61,40", "#d7263d", 0.46, "dash"))))
    layer.setMapTipTemplate(
        "<b>Building [% \"building_id\" %]</b>: [% \"status\" %]<br>[% \"points\" %] points, "
        "[% round(\"density\", 1) %] a m²<br>[% \"shift_status\" %]"
        "[% if(\"shift_status\" = 'moved', format(' by %1 m (σ %2 m)', "
        "round(sqrt(\"shift_x\"^2 + \"shift_y\"^2), 2), round(\"shift_sigma\", 2)), '') %]")


def roof_polygons(layer) -> None:
    """Roofs from low (blue) to high (red), whatever the heights of the place."""
    count = len(HEIGHT_COLOURS)
    labels = ["lowest roofs", *[""] * (count - 2), "highest roofs"]
    labels[count // 2] = "…"
    ranges = [QgsRendererRange(place / count, (place + 1) / count, fill(colour, "#3c3c3c", 0.2), labels[place])
              for place, colour in enumerate(HEIGHT_COLOURS)]
    layer.setRenderer(QgsGraduatedSymbolRenderer(HEIGHT_SHARE, ranges))
    layer.setRenderer3D(engine.QgsVectorLayer3DRenderer(solid_symbol(SURFACES["roof"][1])))
    layer.setMapTipTemplate(
        "<b>Building [% \"building_id\" %], roof [% \"roof_id\" %]</b>: [% \"status\" %]<br>"
        "height [% round(\"height\", 2) %] m, area [% round($area, 1) %] m²<br>"
        "[% \"points\" %] points, RMSE [% round(\"rmse\", 2) %] m, covered to [% round(100 * \"coverage\") %] %")


def building_models(layer) -> None:
    """Whole buildings by the status of their model."""
    categories = [QgsRendererCategory(value, fill(colour), label) for value, (label, colour) in MODEL_STATUS.items()]
    categories.append(QgsRendererCategory("not modelled", fill(NOT_MODELLED[1]), NOT_MODELLED[0]))
    layer.setRenderer(QgsCategorizedSymbolRenderer("status", categories))
    colours = {value: colour for value, (_, colour) in MODEL_STATUS.items()}
    layer.setRenderer3D(renderer_3d(colours, "status", MODEL_STATUS["ok"][1]))
    layer.setMapTipTemplate(
        "<b>Building [% \"building_id\" %]</b>: [% \"status\" %]<br>[% \"reason\" %]<br>"
        "[% \"roofs\" %] roofs, height [% round(\"height\", 1) %] m, [% round(\"area\") %] m², "
        "[% round(\"volume\") %] m³<br>"
        "RMSE z (95 %) [% round(\"rmse_z95\", 2) %] m, [% round(\"density\", 1) %] points a m²")


def building_surfaces(layer) -> None:
    """Surfaces by type; in plan, roofs lie on the ground's surfaces and walls are lines on top."""
    categories = []
    for level, (value, (label, colour)) in enumerate(SURFACES.items()):
        symbol = fill(colour) if "wall" not in value else fill(colour, "#6d6257" if value == "inner wall" else EDGE,
                                                               0.2 if value == "inner wall" else 0.4)
        symbol.symbolLayer(0).setRenderingPass(level)
        categories.append(QgsRendererCategory(value, symbol, label))
    renderer = QgsCategorizedSymbolRenderer("surface_type", categories)
    renderer.setUsingSymbolLevels(True)
    layer.setRenderer(renderer)
    colours = {value: colour for value, (_, colour) in SURFACES.items()}
    layer.setRenderer3D(renderer_3d(colours, "surface_type", SURFACES["outer wall"][1]))
    layer.setMapTipTemplate("Building [% \"building_id\" %], [% \"surface_type\" %][% if(\"surface_type\" = 'ground', "
                            "'', format(' of roof %1', \"roof_id\")) %]")


WALL_STATUS = {
    "ok": ("seen well", "#2f9e6e"),
    "partly seen": ("seen in part", "#f2c14e"),
    "rough": ("rough", "#f08a4b"),
    "few points": ("few points", "#d7263d"),
    "inside": ("inside the outline", "#7f8fb5"),
}
"""Label and colour of each status of a measured wall."""


def facade_walls(layer) -> None:
    """Measured walls by status: in plan lines, as they stand upright."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("status", [
        QgsRendererCategory(value, fill(colour, colour, 0.7), label)
        for value, (label, colour) in WALL_STATUS.items()]))
    layer.setRenderer3D(renderer_3d({value: colour for value, (_, colour) in WALL_STATUS.items()}, "status",
                                    WALL_STATUS["ok"][1]))
    layer.setMapTipTemplate(
        "<b>Building [% \"building_id\" %], wall [% \"wall_id\" %]</b>: [% \"status\" %]<br>[% \"note\" %]<br>"
        "[% round(\"area\", 1) %] m², facing [% round(\"azimuth\") %]°, [% \"points\" %] points<br>"
        "RMSE [% round(100 * \"rmse\", 1) %] cm, σ [% round(100 * \"sigma\", 1) %] cm<br>"
        "seen [% round(100 * \"coverage\") %] %, perhaps hidden [% round(100 * \"hidden\") %] %")


FACADE_STATUS = {"textured": ("textured", "#2f9e6e"), "partly seen": ("seen in part", "#f2c14e"),
                 "not seen": ("not seen", "#9aa5ad")}
"""Label and colour of each status of a facade with or without texture."""


def facades(layer) -> None:
    """Facades by whether images show them: in plan lines, as they stand upright."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("status", [
        QgsRendererCategory(value, fill(colour, colour, 0.7), label)
        for value, (label, colour) in FACADE_STATUS.items()]))
    layer.setRenderer3D(renderer_3d({value: colour for value, (_, colour) in FACADE_STATUS.items()}, "status",
                                    FACADE_STATUS["not seen"][1]))
    layer.setMapTipTemplate(
        "<b>Building [% \"building_id\" %], facade [% \"facade\" %]</b>: [% \"status\" %]<br>[% \"reason\" %]<br>"
        "[% round(\"area\", 1) %] m², seen [% round(100 * \"seen\") %] %, image pixels of "
        "[% round(100 * \"detail\") %] cm<br>[% \"images\" %]")


MERGED_STATUS = {
    "merged": ("on measured walls", "#9fc8a8"),
    "unchanged": ("unchanged", "#e9dcc6"),
    "not merged": ("not merged (see table)", "#f08a4b"),
}
"""Label and colour of each status of a merged model."""

MERGED_WALLS = {
    "moved": ("on the measured wall", "#2f9e6e"),
    "fits": ("lay on it already", "#57c4a0"),
    "not seen": ("not seen", "#b8b2a6"),
    "too far": ("beyond the limits", "#d7263d"),
    "neighbour": ("would cross a neighbour", "#8e44ad"),
    "does not fit": ("does not fit the plan", "#f08a4b"),
}
"""Label and colour of what became of each wall of a merged model."""


def merged_models(layer) -> None:
    """Merged models by status."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("status", [
        QgsRendererCategory(value, fill(colour), label) for value, (label, colour) in MERGED_STATUS.items()]))
    layer.setRenderer3D(renderer_3d({value: colour for value, (_, colour) in MERGED_STATUS.items()}, "status",
                                    MERGED_STATUS["unchanged"][1]))
    layer.setMapTipTemplate(
        "<b>Building [% \"building_id\" %]</b>: [% \"status\" %]<br>[% \"reason\" %]<br>"
        "[% \"walls_moved\" %] of [% \"walls\" %] walls moved, by [% round(\"mean_offset\", 2) %] m in the mean<br>"
        "[% round(100 * \"measured\") %] % of the walls' length lies on measured walls")


def merged_walls(layer) -> None:
    """Walls of merged models by what became of them: in plan lines, as they stand upright."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("status", [
        QgsRendererCategory(value, fill(colour, colour, 0.7), label)
        for value, (label, colour) in MERGED_WALLS.items()]))
    layer.setRenderer3D(renderer_3d({value: colour for value, (_, colour) in MERGED_WALLS.items()}, "status",
                                    MERGED_WALLS["not seen"][1]))
    layer.setMapTipTemplate(
        "<b>Building [% \"building_id\" %], wall [% \"edge\" %]</b>: [% \"status\" %]<br>[% \"note\" %]<br>"
        "offset [% round(\"offset\", 3) %] m, turn [% round(\"turn\", 1) %]°, seen [% round(100 * \"seen\") %] %<br>"
        "σ [% round(100 * \"sigma\", 1) %] cm")


MESH_STATUS = {
    "ok": ("ok", "#d8c3a5"),
    "error exceeded": ("error exceeded", "#f2c14e"),
    "ground unknown": ("ground assumed", "#8fc1d9"),
}
"""Label and colour of each status of a mesh."""


def building_meshes(layer) -> None:
    """Meshes by status."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("status", [
        QgsRendererCategory(value, fill(colour, EDGE, 0.1), label) for value, (label, colour) in MESH_STATUS.items()]))
    layer.setRenderer3D(renderer_3d({value: colour for value, (_, colour) in MESH_STATUS.items()}, "status",
                                    MESH_STATUS["ok"][1]))
    layer.setMapTipTemplate(
        "<b>Building [% \"building_id\" %]</b>: [% \"status\" %]<br>[% \"reason\" %]<br>"
        "[% \"triangles\" %] triangles, [% \"surfaces\" %] surfaces, [% \"points\" %] points<br>"
        "[% round(100 * \"within\", 1) %] % of them within the error, RMSE [% round(\"rmse\", 2) %] m")


LOADED = {"": ("sound", "#9fb4c7"), "noted": ("with a note", "#d98c5f")}
"""Label and colour of loaded buildings without and with a note."""


def loaded_buildings(layer) -> None:
    """Outlines of a city model; those in which something is wrong stand out."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("if(coalesce(\"note\", '') = '', '', 'noted')", [
        QgsRendererCategory(value, fill(colour), label) for value, (label, colour) in LOADED.items()]))
    layer.setMapTipTemplate("<b>[% \"building_id\" %]</b><br>levels [% \"lod\" %], "
                            "height [% round(\"height\", 1) %] m<br>[% \"note\" %]")


def loaded_models(layer) -> None:
    """Solids of a city model, likewise."""
    loaded_buildings(layer)
    rule = engine.QgsRuleBased3DRenderer.Rule
    root = rule(None)
    for condition, key in (("coalesce(\"note\", '') = ''", ""), ("coalesce(\"note\", '') <> ''", "noted")):
        root.appendChild(rule(solid_symbol(LOADED[key][1]), condition, LOADED[key][0]))
    layer.setRenderer3D(engine.QgsRuleBased3DRenderer(root))


def road_markings(layer) -> None:
    """Markings in the colour of their paint, dark at the edge so that they show on light paving too."""
    colours = {"white": "#ffffff", "yellow": "#ffb000"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("colour", [
        QgsRendererCategory(value, fill(colour, "#0b6e4f", 0.26), value) for value, colour in colours.items()]))
    layer.setMapTipTemplate(
        "[% \"colour\" %] marking, [% round(\"area\", 2) %] m²<br>length [% round(\"length\", 2) %] m, width "
        "[% round(\"width\", 2) %] m<br>[% round(\"contrast\") %] grey values above the road")


def line_symbol(colour: str, width_mm: float, pen: str = "solid"):
    """A plain line symbol."""
    return QgsLineSymbol.createSimple({"line_color": colour, "line_width": str(width_mm), "line_style": pen,
                                       "capstyle": "flat"})


def by_class(layer, symbols: dict) -> None:
    """One symbol for each value of the field class."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("class", [
        QgsRendererCategory(kind, symbol, kind) for kind, symbol in symbols.items()]))


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


def map_findings(layer) -> None:
    """Points by what was found."""
    kinds = {"no lane made": "#e09a2b", "open end": "#4a8fe7", "bound not seen": "#b8b03a",
             "direction contradicts": "#d7263d", "driven without lane": "#d7263d", "no drive": "#8a6bb0",
             "stop line without lane": "#9a9a9a", "too narrow": "#d7263d", "way not drawn": "#d7263d",
             "way drawn by width": "#b8b03a", "no height": "#9a9a9a"}
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
                                  ("displaced by heights", "height", "#8c8c8c")):
        symbol = marker(colour, 1.2)
        symbol.insertSymbolLayer(0, arrow_along(line, colour))
        entries.append((label, f"\"status\" = '{status}'", symbol))
    rules(layer, entries)
    layer.setMapTipTemplate(
        "<b>[% \"second\" %]</b> against [% \"first\" %]: [% \"status\" %]<br>here [% round(\"length\", 2) %] m, "
        "σ [% round(\"sigma\", 2) %] m<br>all [% \"patches\" %] places [% round(\"pair_length\", 2) %] m, "
        "σ [% round(\"pair_sigma\", 3) %] m<br>(arrows 100 times enlarged)")


def tiles(layer) -> None:
    """Tiles of a run by what became of them."""
    entries = [("done", "\"status\" = 'done'", fill("#5fa777")), ("empty", "\"status\" = 'empty'", fill("#d5d9dc")),
               ("failed (see table)", "\"status\" = 'failed'", fill("#c8443a"))]
    rules(layer, entries)
    layer.setMapTipTemplate("<b>[% \"tile\" %]</b> [% \"status\" %]<br>[% coalesce(\"reason\", '') %]<br>"
                            "[% round(\"seconds\", 1) %] s, [% round(\"memory\") %] MB")


def control_residuals(layer) -> None:
    """Control points by their error in plan, with an arrow that shows it enlarged."""
    east, north, plan = (f'coalesce("{name}_after", "{name}_before")' for name in ("east", "north", "plan"))
    scale = 'if("plan_after" IS NULL, 10, 100)'
    line = f"make_line($geometry, translate($geometry, {scale} * {east}, {scale} * {north}))"
    limits = (0.0, 0.03, 0.10, 0.30, 1000.0)
    labels = ("error below 3 cm", "3 to 10 cm", "10 to 30 cm", "more than 30 cm")
    entries = []
    for low, high, label, colour in zip(limits, limits[1:], labels, ("#1a9850", "#a6d96a", "#fdae61", "#d73027")):
        symbol = marker(colour)
        symbol.insertSymbolLayer(0, arrow_along(line, colour))
        entries.append((label, f"{plan} >= {low} AND {plan} < {high}", symbol))
    rules(layer, entries)
    layer.setMapTipTemplate(
        "<b>[% \"id\" %]</b><br>in plan [% round(\"plan_before\", 3) %] m before"
        "[% if(\"plan_after\" IS NULL, '', format(', %1 m after', round(\"plan_after\", 3))) %]<br>"
        "(arrows: error 100 times enlarged, 10 times before a correction)")


def mms_patches(layer) -> None:
    """Patches of a survey: how their correction was found, and how sure it is."""
    registered = "\"status\" = 'registered' AND \"sigma\" {}"
    rules(layer, (
        ("registered, σ up to 3 cm", registered.format("<= 0.03"), marker("#1a9850", 1.4)),
        ("registered, σ 3 to 6 cm", registered.format("> 0.03 AND \"sigma\" <= 0.06"), marker("#91cf60", 1.4)),
        ("registered, σ above 6 cm", registered.format("> 0.06"), marker("#d9ef8b", 1.4)),
        ("bridged", "\"status\" = 'bridged'", marker("#fdae61", 1.8)),
        ("not to be trusted", "ELSE", marker("#d73027", 2.2))))
    layer.setMapTipTemplate(
        "<b>[% round(\"way\", 1) %] m: [% \"status\" %]</b><br>[% \"reason\" %]<br>correction east "
        "[% round(\"east\", 3) %], north [% round(\"north\", 3) %], up [% round(\"up\", 3) %] m<br>"
        "σ [% round(\"sigma\", 3) %] m in plan, window [% round(\"window\", 1) %] m")


def adjustment_ties(layer) -> None:
    """Ties, control points and reference of a network by what is left of them, with enlarged arrows."""
    line = 'make_line($geometry, translate($geometry, 200 * "east", 200 * "north"))'
    entries = []
    for label, condition, colour in (("residual below 2 cm", '"plan" < 0.02', "#1a9850"),
                                     ("2 to 5 cm", '"plan" < 0.05', "#a6d96a"),
                                     ("5 cm and more", '"plan" >= 0.05', "#fdae61")):
        symbol = marker(colour)
        symbol.insertSymbolLayer(0, arrow_along(line, colour))
        low = ' AND "plan" >= 0.02' if label.startswith("2") else ""
        entries.append((label, f'"weight" >= 0.3 AND {condition}{low}', symbol))
    entries.append(("without weight", "ELSE", marker("#d73027")))
    rules(layer, entries)
    layer.setMapTipTemplate(
        "<b>[% \"kind\" %]</b> [% \"drive\" %] [% coalesce(\"other\", '') %]<br>in plan [% round(\"plan\", 3) %] m, up "
        "[% round(\"up\", 3) %] m, weight [% round(\"weight\", 2) %]<br>(arrows: residual 200 times enlarged)")


def adjustment_nodes(layer) -> None:
    """Corrected paths by how they were placed."""
    rules(layer, (
        ("placed, σ up to 5 cm", "\"status\" = 'placed' AND \"sigma\" <= 0.05", marker("#1a9850", 1.4)),
        ("placed, σ above 5 cm", "\"status\" = 'placed' AND \"sigma\" > 0.05", marker("#d9ef8b", 1.4)),
        ("bridged", "\"status\" = 'bridged'", marker("#fdae61", 1.8)),
        ("relative only", "\"status\" = 'relative only'", marker("#6a51a3", 1.8)),
        ("not tied", "ELSE", marker("#d73027", 2.2))))
    layer.setMapTipTemplate(
        "<b>[% \"drive\" %], [% round(\"chainage\", 1) %] m: [% \"status\" %]</b><br>correction east "
        "[% round(\"east\", 3) %], north [% round(\"north\", 3) %], up [% round(\"up\", 3) %] m<br>"
        "σ [% round(\"sigma\", 3) %] m in plan")


SATELLITES = ((3, "below 4 satellites: no position", "#b2182b"), (5, "4 to 5 satellites", "#ef8a62"),
              (8, "6 to 8 satellites", "#fddbc7"), (12, "9 to 12 satellites", "#67a9cf"),
              (1000, "13 satellites and more", "#2166ac"))
"""Upper limit, label and colour of the classes of visible satellites."""


def tie_point_proposals(layer) -> None:
    """Proposed tie points: an arrow from the survey to the outline's corner."""
    symbol = QgsLineSymbol()
    symbol.changeSymbolLayer(0, arrow_along("$geometry", "#8a6bb0"))
    rules(layer, (("survey to outline", "TRUE", symbol),))
    layer.setMapTipTemplate("<b>[% \"set\" %]</b>: [% round(\"length\", 2) %] m, σ of the fit "
                            "[% round(\"fit\", 3) %] m, [% \"support\" %] points")


def rectification_sets(layer) -> None:
    """Sets of tie points by what became of them, with an arrow that shows the shift ten times enlarged."""
    line = "make_line($geometry, translate($geometry, 10 * \"east\", 10 * \"north\"))"
    entries = []
    for label, condition, colour in (
            ("used", "\"status\" = 'used'", "#1a9850"),
            ("used for the position only", "\"status\" = 'position only'", "#a6d96a"),
            ("used, but hardly fits its neighbours", "\"status\" = 'suspect'", "#fdae61"),
            ("left out", "ELSE", "#d73027")):
        symbol = marker(colour, 2.4)
        symbol.insertSymbolLayer(0, arrow_along(line, colour))
        entries.append((label, condition, symbol))
    rules(layer, entries)
    layer.setMapTipTemplate(
        "<b>[% \"set\" %]</b>: [% \"status\" %]<br>[% round(\"before\", 2) %] m before, [% round(\"after\", 2) %] m "
        "after<br>(arrows: shift ten times enlarged)")


def rectification_epochs(layer) -> None:
    """Epochs of a rectified trajectory by their standard deviation in plan; those outside the sets apart."""
    between = "\"status\" = 'between sets' AND \"sigma\" {}"
    rules(layer, (
        ("σ up to 5 cm", between.format("<= 0.05"), marker("#1a9850", 1.2)),
        ("σ 5 to 20 cm", between.format("> 0.05 AND \"sigma\" <= 0.2"), marker("#a6d96a", 1.2)),
        ("σ above 20 cm", between.format("> 0.2"), marker("#fdae61", 1.2)),
        ("carried on before the first or after the last set", "ELSE", marker("#d73027", 1.4))))
    layer.setMapTipTemplate(
        "[% round(\"time\", 2) %] s: [% \"status\" %]<br>east [% round(\"east\", 3) %] m, north "
        "[% round(\"north\", 3) %] m, σ [% round(\"sigma\", 3) %] m")


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
    segmented_buildings: ("MultiPolygon", "building_id:integer status:string shift_status:string shift_x:double "
                          "shift_y:double shift_sigma:double points:integer density:double"),
    roof_polygons: ("PolygonZ", "building_id:integer roof_id:integer height:double status:string points:integer "
                    "rmse:double coverage:double"),
    building_models: ("MultiPolygonZ", "building_id:integer status:string reason:string roofs:integer height:double "
                      "area:double volume:double rmse_z95:double density:double"),
    building_surfaces: ("PolygonZ", "building_id:integer roof_id:integer surface_type:string"),
    control_residuals: ("PointZ", "id:string plan_before:double plan_after:double east_before:double east_after:double "
                        "north_before:double north_after:double"),
    mms_patches: ("PointZ", "status:string reason:string way:double sigma:double east:double north:double up:double "
                  "window:double"),
    adjustment_ties: ("PointZ", "kind:string drive:string other:string plan:double east:double north:double up:double "
                      "sigma:double weight:double"),
    adjustment_nodes: ("PointZ", "drive:string status:string chainage:double east:double north:double up:double "
                       "sigma:double"),
    facade_walls: ("PolygonZ", "building_id:integer wall_id:integer status:string note:string area:double "
                   "azimuth:double points:integer rmse:double sigma:double coverage:double hidden:double"),
    facades: ("PolygonZ", "building_id:integer facade:integer area:double seen:double detail:double images:string "
              "status:string reason:string"),
    merged_models: ("MultiPolygonZ", "building_id:integer status:string reason:string walls:integer "
                    "walls_moved:integer mean_offset:double measured:double"),
    merged_walls: ("PolygonZ", "building_id:integer edge:integer status:string note:string offset:double turn:double "
                   "seen:double sigma:double"),
    frame_shifts: ("Point", "first:string second:string east:double north:double length:double sigma:double "
                   "pair_length:double pair_sigma:double patches:integer status:string"),
    building_meshes: ("MultiPolygonZ", "building_id:integer status:string reason:string triangles:integer "
                      "surfaces:integer points:integer within:double rmse:double"),
    tie_point_proposals: ("LineString", "set:string time:double length:double support:integer fit:double"),
    rectification_sets: ("PointZ", "set:string status:string before:double after:double east:double north:double"),
    rectification_epochs: ("PointZ", "time:double status:string east:double north:double sigma:double"),
    marking_lines: ("LineStringZ", "class:string colour:string length:double width:double sigma:double bridged:double"),
    lanes: ("Polygon", "lane_id:integer kind:string evidence:string length:double width:double successors:string"),
    lane_centres: ("LineStringZ", "lane_id:integer kind:string width:double"),
    lane_bounds: ("LineStringZ", "bound_id:integer class:string"),
    road_edges: ("LineStringZ", "kind:string height:double sigma:double sigma_z:double status:string"),
    map_findings: ("Point", "kind:string text:string"),
    map_faults: ("Point", "rule:string severity:string text:string element:string"),
    marking_areas: ("MultiPolygonZ", "class:string score:double heading:double"),
    loaded_buildings: ("MultiPolygon", "building_id:string lod:string height:double note:string"),
    loaded_models: ("MultiPolygonZ", "building_id:string lod:string height:double note:string"),
    tiles: ("Polygon", "tile:string status:string reason:string seconds:double memory:double"),
    road_markings: ("Polygon", "area:double length:double width:double contrast:double colour:string"),
}


def write(style) -> Path:
    """Write the style that a function gives to a layer; the file has its name."""
    geometry, fields = FIELDS[style]
    text = "&".join(f"field={field}" for field in fields.split())
    layer = QgsVectorLayer(f"{geometry}?crs=EPSG:6677&{text}", style.__name__, "memory")
    style(layer)
    return save(layer, style)


def write_raster_style(style) -> Path:
    """The same for a raster of one band."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "pixel.asc"
        file.write_text("ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n255\n", encoding="ascii")
        layer = QgsRasterLayer(str(file), style.__name__)
        style(layer)
        return save(layer, style)


def save(layer, style) -> Path:
    """Save the style of a layer under the name of the function that gave it."""
    path = STYLES / f"{style.__name__}.qml"
    categories = QgsMapLayer.StyleCategory
    message, written = layer.saveNamedStyle(
        str(path), categories.Symbology | categories.Symbology3D | categories.MapTips)
    if not written:
        sys.exit(f"{path}: {message}")
    return path


def main() -> None:
    """Write all styles."""
    application = QgsApplication([], True)
    application.initQgis()
    engine.Qgs3D.initialize()
    for style in FIELDS:
        print(write(style).relative_to(STYLES.parent.parent))
    for style in (marking_mask, satellite_visibility_area, localisation_raster):
        print(write_raster_style(style).relative_to(STYLES.parent.parent))
    application.exitQgis()


if __name__ == "__main__":
    main()
