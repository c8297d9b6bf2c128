"""Styles of walls, merged models and meshes: every status that the layers hold has its own colour."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from urbanmap_qgis.buildings.merging import merge_stage, wall_match
from urbanmap_qgis.buildings.mesh25d import mesh_stage
from urbanmap_qgis.facades import wall_stage

STYLES = Path(__file__).resolve().parents[2] / "resources" / "styles"
STATUS = {
    "facade_walls": (wall_stage.OK, wall_stage.PARTLY, wall_stage.ROUGH, wall_stage.FEW, wall_stage.INSIDE,
                     wall_stage.BEFORE, wall_stage.UNDECIDED),
    "merged_models": (merge_stage.MERGED, merge_stage.UNCHANGED, merge_stage.NOT_MERGED),
    "merged_walls": (wall_match.MOVED, wall_match.KEPT, wall_match.NOT_SEEN, wall_match.TOO_FAR, wall_match.NEIGHBOUR,
                     wall_match.FOLDED),
    "building_meshes": (mesh_stage.OK, mesh_stage.COARSE, mesh_stage.GROUND_UNKNOWN),
}


@pytest.mark.parametrize("name", STATUS)
def test_each_status_has_its_colour_in_2d_and_3d(name):
    root = ElementTree.parse(STYLES / f"{name}.qml").getroot()
    categories = {item.get("value"): item.get("symbol") for item in root.iter("category")}
    assert set(categories) == set(STATUS[name])
    colours = {symbol.get("name"): next(option.get("value") for option in symbol.iter("Option")
                                        if option.get("name") == "color")
               for symbol in root.find("renderer-v2").find("symbols")}
    assert len({colours[number] for number in categories.values()}) == len(categories)
    rules = {rule.get("description") for rule in root.iter("rule") if rule.get("description")}
    assert set(STATUS[name]) <= rules
