"""Old buildings against new points: each kind of change on a made street, and the models that are spliced."""

from __future__ import annotations

import json

import numpy as np
import pytest
import shapely

from tests.laser_blocks import block_points, write_block
from urbanmap_qgis.buildings.quality import RoofCell
from urbanmap_qgis.buildings.update.building_change import OldBuilding
from urbanmap_qgis.buildings.update.epoch_offset import epoch_offset
from urbanmap_qgis.buildings.update.update_stage import city_changes
from urbanmap_qgis.buildings.update.update_table import new_ids
from urbanmap_qgis.citymodel.spliced import write_updated
from urbanmap_qgis.citymodel.spliced_gml import members_of
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.points.pointcloud import open_cloud

PLANS = [shapely.box(x, y, x + 10, y + 9) for y in (10, 40, 70) for x in (8, 38, 68)]
HEIGHTS = [6.0, 7.0, 8.0, 6.0, 7.0, 8.0, 6.0, 7.0, 8.0]


def old_buildings():
    return [OldBuilding(plan, [RoofCell(plan, height, 0, (0.0, 0.4), plan.bounds[:2])], 0.05)
            for plan, height in zip(PLANS, HEIGHTS)]


def changes_of(folder, roofs, crowns=(), without=None, shift=(0.0, 0.0, 0.0)):
    points, number, count = block_points(10.0, roofs=roofs, crowns=crowns)
    if without is not None:
        keep = ~shapely.contains_xy(without, points[:, 0], points[:, 1])
        points, number, count = points[keep], number[keep], count[keep]
    path = write_block(folder / "new.laz", points + np.array(shift), number, count)
    return city_changes(old_buildings(), open_cloud([path], "EPSG:28992"))


def street(*changed):
    """Roofs as of old but for some rows: (row, outline, height)."""
    roofs = {row: (plan, height, 0.4) for row, (plan, height) in enumerate(zip(PLANS, HEIGHTS))}
    for row, outline, height in changed:
        roofs[row] = (outline, height, 0.4)
        if outline is None:
            del roofs[row]
    return list(roofs.values())


def test_each_kind_of_change_is_told(tmp_path):
    added, built_on = shapely.box(25, 25, 33, 33), shapely.box(48, 42, 54, 47)
    half = shapely.box(68, 40, 73, 49)
    roofs = [*street((0, None, 0), (1, PLANS[1], 10.0), (2, PLANS[2], 5.0), (5, half, 8.0)),
             (added, 5.0, 0.0), (built_on, 4.0, 0.0)]
    found = changes_of(tmp_path, roofs, crowns=[(PLANS[7].centroid.x, PLANS[7].centroid.y, 14.0)],
                       without=PLANS[8].buffer(1.0), shift=(0.0, 0.0, 0.08))
    kinds = [change.change for change in found.changes]
    assert kinds == ["gone", "raised", "lowered", "same", "extended", "reduced", "same", "same", "unseen"]
    assert found.changes[1].height_change == pytest.approx(3.0, abs=0.1)
    assert found.changes[4].area_change == pytest.approx(30.0, abs=8.0)
    assert found.changes[5].area_change == pytest.approx(-45.0, abs=12.0)
    assert [change.change for change in found.additions] == ["new"]
    assert found.additions[0].area_change == pytest.approx(64.0, abs=8.0)
    assert found.offset.shift[2] == pytest.approx(0.08, abs=0.02)


def test_a_block_is_no_change_of_a_pitched_roof(tmp_path):
    path = write_block(tmp_path / "new.laz", *block_points(10.0, roofs=street()))
    blocks = [OldBuilding(plan, [RoofCell(plan, height + 2.0)]) for plan, height in zip(PLANS, HEIGHTS)]
    found = city_changes(blocks, open_cloud([path], "EPSG:28992"))
    assert {change.change for change in found.changes} == {"same"}


def test_the_offset_of_epochs_is_found_with_its_sigma():
    rng = np.random.default_rng(3)
    slope = rng.choice([-0.5, 0.0, 0.5], (2000, 2))
    difference = 0.1 - slope @ [0.3, -0.2] + rng.normal(0, 0.05, 2000)
    difference[:300] += 3.0  # a tenth and a half was raised
    found = epoch_offset(difference, slope)
    assert np.abs(np.subtract(found.shift, (0.3, -0.2, 0.1))).max() < 4 * max(found.sigma) < 0.04


def test_new_ids_do_not_meet_old_ones():
    assert new_ids([3, 7], 2) == [8, 9]
    assert new_ids(["a", "new-1"], 2) == ["new-2", "new-3"]


GML = """<?xml version="1.0"?>
<core:CityModel xmlns:core="c" xmlns:bldg="b" xmlns:gml="http://www.opengis.net/gml">
<core:cityObjectMember><bldg:Building gml:id="A"><bldg:usage>1</bldg:usage><bldg:measuredHeight>3</bldg:measuredHeight>\
<bldg:lod1Solid gml:id="A1"/><bldg:address/></bldg:Building></core:cityObjectMember>
<core:cityObjectMember><bldg:Building gml:id="B"/></core:cityObjectMember> <!-- kept -->
<core:cityObjectMember><bldg:Building gml:id="C"  x = '1'/></core:cityObjectMember>
</core:CityModel>
"""
NEW_GML = """<m:CityModel xmlns:m="c" xmlns:bldg="b" xmlns:gml="http://www.opengis.net/gml">
<m:cityObjectMember><bldg:Building gml:id="A"><bldg:measuredHeight>9</bldg:measuredHeight><bldg:lod2Solid gml:id="A2"/>\
</bldg:Building></m:cityObjectMember><m:cityObjectMember><bldg:Building gml:id="N"/></m:cityObjectMember>
</m:CityModel>
"""


def test_a_citygml_keeps_every_byte_of_what_stayed(tmp_path):
    (tmp_path / "old.gml").write_text(GML, encoding="utf-8")
    (tmp_path / "new").mkdir()
    (tmp_path / "new" / "buildings.gml").write_text(NEW_GML, encoding="utf-8")
    write_updated(tmp_path / "old.gml", tmp_path / "new", tmp_path / "out", ["B"])
    text = (tmp_path / "out" / "old.gml").read_text(encoding="utf-8")
    assert GML.splitlines()[-2] in text and "<!-- kept -->" in text
    assert [name for name, _, _ in members_of(tmp_path / "out" / "old.gml")[0]] == ["A", "C", "N"]
    changed = text[text.index('gml:id="A"'):text.index("<!-- kept")]
    assert "A1" not in changed and "A2" in changed and ">9<" in changed and "usage>1<" in changed
    assert changed.index("A2") < changed.index("address")


def test_a_cityjson_keeps_every_value_of_what_stayed(tmp_path):
    def model(scale, **objects):
        return {"type": "CityJSON", "version": "2.0", "transform": {"scale": [scale] * 3, "translate": [10.0, 0, 0]},
                "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/28992"},
                "vertices": [[1, 2, 3]], "CityObjects": objects}

    shape = {"geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 0, 0]]]}]}
    old = model(0.001, A={"type": "Building", "attributes": {"use": "shop", "h": 1}, "children": ["A-1"], **shape},
                **{"A-1": {"type": "BuildingPart", "parents": ["A"]}}, B={"type": "Building", **shape})
    new = model(0.01, A={"type": "Building", "attributes": {"h": 9}, **shape}, N={"type": "Building", **shape})
    for name, each in (("old", old), ("new", new)):
        (tmp_path / f"{name}.json").write_text(json.dumps(each), encoding="utf-8")
    write_updated(tmp_path / "old.json", tmp_path / "new.json", tmp_path / "out.json", [])
    made = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))
    assert made["CityObjects"].keys() == {"A", "B", "N"}
    assert made["CityObjects"]["B"] == old["CityObjects"]["B"]
    assert made["CityObjects"]["A"]["attributes"] == {"use": "shop", "h": 9}
    assert made["CityObjects"]["N"]["geometry"][0]["boundaries"] == [[[1, 1, 1]]]
    assert made["vertices"] == [[1, 2, 3], [10, 20, 30]]


def test_a_document_type_is_refused(tmp_path):
    (tmp_path / "old.gml").write_text(GML.replace("<core:CityModel", '<!DOCTYPE a [<!ENTITY b "c">]><core:CityModel'))
    with pytest.raises(InputError, match="DOCTYPE"):
        write_updated(tmp_path / "old.gml", None, tmp_path / "out", ["B"])
