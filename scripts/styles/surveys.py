"""Styles of surveys: accuracy, registration, adjustment, rectified trajectories, tiles."""

from __future__ import annotations

from qgis.core import (
    QgsLineSymbol,
)

from .symbols import arrow_along, fill, marker, rules


def tiles(layer) -> None:
    """Outlines of a run's tiles by what became of them: the results show through."""
    entries = [("done", "\"status\" = 'done'", fill("#5fa777", "#2f7d4a", 0.4, brush="no")),
               ("empty", "\"status\" = 'empty'", fill("#d5d9dc", "#8a9299", 0.3, "dash", "no")),
               ("failed (see table)", "\"status\" = 'failed'", fill("#c8443a", "#c8443a", 0.6, brush="b_diagonal"))]
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


def mms_areas(layer) -> None:
    """Road on which reference and survey disagree, by kind; what lies below shows through."""
    entries = [("changed markings", "\"kind\" = 'changed markings'", fill("215,48,39,70", "#d73027", 0.46)),
               ("hidden step", "\"kind\" = 'hidden step'", fill("77,77,77,60", "#4d4d4d", 0.46, "dash")),
               ("reference and survey disagree", "ELSE", fill("123,50,148,60", "#7b3294", 0.46))]
    rules(layer, entries)
    layer.setMapTipTemplate("<b>[% round(\"begin\", 1) %] to [% round(\"end\", 1) %] m: [% \"kind\" %]</b><br>"
                            "[% round(\"size\", 3) %] m towards [% round(\"direction\") %]°, "
                            "σ [% round(\"sigma\", 3) %] m")


def mms_steps(layer) -> None:
    """Places where reference and survey disagree, with arrows 20 times the step."""
    line = 'make_line($geometry, translate($geometry, 20 * "east", 20 * "north"))'
    entries = []
    for label, rule, colour in (("changed markings", "\"kind\" = 'changed markings'", "#d73027"),
                                ("reference and survey disagree", "ELSE", "#7b3294"),
                                ("hidden step", "\"kind\" = 'hidden step'", "#4d4d4d")):
        symbol = marker(colour, 3.0)
        symbol.insertSymbolLayer(0, arrow_along(line, colour))
        entries.append((label, rule, symbol))
    rules(layer, tuple(entries))
    layer.setMapTipTemplate("<b>[% round(\"way\", 1) %] m: [% \"kind\" %]</b><br>[% round(\"size\", 3) %] m towards "
                            "[% round(\"direction\") %]°, σ [% round(\"sigma\", 3) %] m")


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


FIELDS = {
    control_residuals: ("PointZ", "id:string plan_before:double plan_after:double east_before:double east_after:double "
                        "north_before:double north_after:double"),
    mms_steps: ("PointZ", "way:double time:double kind:string size:double direction:double east:double north:double "
                "sigma:double"),
    mms_areas: ("Polygon", "begin:double end:double kind:string size:double direction:double sigma:double"),
    mms_patches: ("PointZ", "status:string reason:string way:double sigma:double east:double north:double up:double "
                  "window:double"),
    adjustment_ties: ("PointZ", "kind:string drive:string other:string plan:double east:double north:double up:double "
                      "sigma:double weight:double"),
    adjustment_nodes: ("PointZ", "drive:string status:string chainage:double east:double north:double up:double "
                       "sigma:double"),
    tie_point_proposals: ("LineString", "set:string time:double length:double support:integer fit:double"),
    rectification_sets: ("PointZ", "set:string status:string before:double after:double east:double north:double"),
    rectification_epochs: ("PointZ", "time:double status:string east:double north:double sigma:double"),
    tiles: ("Polygon", "tile:string status:string reason:string seconds:double memory:double"),
}
"""Kind of geometry and fields of the layer that each style is for."""
