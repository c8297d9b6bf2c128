"""Styles of buildings: segmented, roofs, models, walls, facades, meshes, loaded ones."""

from __future__ import annotations

from qgis import _3d as engine
from qgis.core import (
    QgsCategorizedSymbolRenderer,
    QgsGeometryGeneratorSymbolLayer,
    QgsGraduatedSymbolRenderer,
    QgsRendererCategory,
    QgsRendererRange,
)

from .symbols import EDGE, arrow_along, fill, marker, renderer_3d, rules, solid_symbol

MODEL_STATUS = {
    "ok": ("ok", "#e9dcc6"),
    "small": ("small", "#d9d2e9"),
    "few points": ("few points", "#c9b8d8"),
    "partly unseen": ("part of the plan without points", "#b3b8c4"),
    "cloud's edge": ("the cloud ends in it", "#7f8fb0"),
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
                            "'', format(' of roof %1', \"roof_id\")) %][% if(\"seen\" is null, '', "
                            "format(', %1 percent seen, expected error %2 m', round(100 * \"seen\"), "
                            "round(\"sigma\", 2))) %]")


WALL_STATUS = {
    "ok": ("seen well", "#2f9e6e"),
    "partly seen": ("seen in part", "#f2c14e"),
    "rough": ("rough", "#f08a4b"),
    "few points": ("few points", "#d7263d"),
    "inside": ("inside the outline", "#7f8fb5"),
    "before the facade": ("before the facade", "#9c6ade"),
    "undecided": ("undecided", "#8a8f98"),
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


DETECTED_STATUS = {"ok": ("building", "#2f9e6e"), "low": ("lower than a storey", "#f2c14e"),
                   "movable": ("vehicle or container", "#9c6ade"), "deck": ("bridge or ramp", "#7f8fb5"),
                   "no ground": ("no ground about it", "#d7263d")}
"""Label and colour of each status of an outline found in points."""


def detected_outlines(layer) -> None:
    """Outlines found in points, by status."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("status", [
        QgsRendererCategory(value, fill(colour, colour, 0.5), label)
        for value, (label, colour) in DETECTED_STATUS.items()]))
    layer.setMapTipTemplate(
        "<b>Building [% \"building_id\" %]</b>: [% \"status\" %] [% \"reason\" %]<br>"
        "[% round(\"area\") %] m², [% round(\"height\", 1) %] m high<br>"
        "σ of the edges [% round(100 * \"sigma\") %] cm, roof with [% round(100 * \"confidence\") %] %")


CHANGES = {"same": ("same", "#c9ccd1"), "new": ("new", "#2f9e6e"), "gone": ("gone", "#d7263d"),
           "raised": ("raised", "#f08a4b"), "lowered": ("lowered", "#4a8fe7"), "rebuilt": ("rebuilt", "#9c6ade"),
           "extended": ("extended", "#8bc34a"), "reduced": ("reduced", "#f2c14e"), "unseen": ("not seen", "#ffffff")}
"""Label and colour of each kind of change of a building."""


def updated_buildings(layer) -> None:
    """Buildings by what became of them."""
    layer.setRenderer(QgsCategorizedSymbolRenderer("change", [
        QgsRendererCategory(value, fill(colour, EDGE, 0.3), label) for value, (label, colour) in CHANGES.items()]))
    layer.setRenderer3D(renderer_3d({value: colour for value, (_, colour) in CHANGES.items()}, "change",
                                    CHANGES["same"][1]))
    layer.setMapTipTemplate("<b>Building [% \"building_id\" %]</b>: [% \"change\" %]<br>[% \"reason\" %]<br>"
                            "height [% round(\"height_change\", 1) %] m, area [% round(\"area_change\") %] m²")


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


def city_faults(layer) -> None:
    """Points by severity."""
    colours = {"error": "#d7263d", "warning": "#e09a2b", "info": "#4a8fe7"}
    layer.setRenderer(QgsCategorizedSymbolRenderer("severity", [
        QgsRendererCategory(value, marker(colour, 2.4), value) for value, colour in colours.items()]))
    layer.setMapTipTemplate("[% \"rule\" %], [% \"type\" %] [% \"gml_id\" %]<br>[% \"text\" %]")


FIELDS = {
    city_faults: ("Point", "rule:string severity:string text:string type:string gml_id:string"),
    segmented_buildings: ("MultiPolygon", "building_id:integer status:string shift_status:string shift_x:double "
                          "shift_y:double shift_sigma:double points:integer density:double"),
    detected_outlines: ("MultiPolygon", "building_id:integer status:string reason:string area:double height:double "
                        "sigma:double confidence:double"),
    updated_buildings: ("MultiPolygonZ", "building_id:string change:string reason:string height_change:double "
                        "area_change:double"),
    roof_polygons: ("PolygonZ", "building_id:integer roof_id:integer height:double status:string points:integer "
                    "rmse:double coverage:double"),
    building_models: ("MultiPolygonZ", "building_id:integer status:string reason:string roofs:integer height:double "
                      "area:double volume:double rmse_z95:double density:double"),
    building_surfaces: ("PolygonZ", "building_id:integer roof_id:integer surface_type:string seen:double "
                        "sigma:double"),
    facade_walls: ("PolygonZ", "building_id:integer wall_id:integer status:string note:string area:double "
                   "azimuth:double points:integer rmse:double sigma:double coverage:double hidden:double"),
    facades: ("PolygonZ", "building_id:integer facade:integer area:double seen:double detail:double images:string "
              "status:string reason:string"),
    merged_models: ("MultiPolygonZ", "building_id:integer status:string reason:string walls:integer "
                    "walls_moved:integer mean_offset:double measured:double"),
    merged_walls: ("PolygonZ", "building_id:integer edge:integer status:string note:string offset:double turn:double "
                   "seen:double sigma:double"),
    building_meshes: ("MultiPolygonZ", "building_id:integer status:string reason:string triangles:integer "
                      "surfaces:integer points:integer within:double rmse:double"),
    loaded_buildings: ("MultiPolygon", "building_id:string lod:string height:double note:string"),
    loaded_models: ("MultiPolygonZ", "building_id:string lod:string height:double note:string"),
}
"""Kind of geometry and fields of the layer that each style is for."""
