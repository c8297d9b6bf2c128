"""What PLATEAU asks of a delivery: ids, dates, lists, schemas; our own files pass our own check."""

from __future__ import annotations

import re
from dataclasses import replace
from datetime import date

import numpy as np
import pytest

from tests.city_models import town
from urbanmap_qgis.buildings.solids.validity import check_solid
from urbanmap_qgis.citymodel.checks.city_check import check_city
from urbanmap_qgis.citymodel.city_files import copy_schemas, write_city_files
from urbanmap_qgis.citymodel.citygml.plateau import PlateauDelivery, with_plateau_attributes
from urbanmap_qgis.citymodel.model import MULTI_SURFACE, CityShape, CitySurface, Measure
from urbanmap_qgis.citymodel.tables.building_table import TableNotes, building_rows
from urbanmap_qgis.citymodel.tables.table_store import TableStore
from urbanmap_qgis.errors import InputError

DELIVERY = PlateauDelivery(city_code="13101", map_level=500)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The buildings of one solid of a small town as a delivery."""
    folder = tmp_path_factory.mktemp("delivery") / "set"
    model = town()
    whole = tuple(item for item in model.buildings if not item.parts and any(item.shapes))
    write_city_files(replace(model, buildings=whole), citygml=folder, delivery=DELIVERY)
    return folder, whole


def test_own_delivery_passes_the_check(written):
    folder, whole = written
    found = check_city(folder, check_solid)
    assert found.objects == len(whole) == 2
    assert [(fault.rule, fault.text) for fault in found.faults] == []


def test_ids_are_uuids_made_of_the_earlier_ones(written):
    folder, whole = written
    text = next(folder.rglob("*.gml")).read_text(encoding="utf-8")
    ids = re.findall(r'<bldg:Building gml:id="([^"]*)"', text)
    assert all(re.fullmatch(r"bldg_[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}", one) for one in ids)
    assert ids[0] == with_plateau_attributes(whole[0], 7, DELIVERY).id, "the same in every run, whatever its number"
    assert ids[0] != with_plateau_attributes(whole[0], 7, replace(DELIVERY, city_code="13102")).id
    assert '<gen:stringAttribute name="source_id"><gen:value>家 1</gen:value>' in text
    own = replace(whole[0], id="bldg_00000000-0000-4000-8000-000000000001")
    made = with_plateau_attributes(own, 1, DELIVERY)
    assert made.id == own.id and "source_id" not in made.attributes
    assert with_plateau_attributes(whole[0], 1, replace(DELIVERY, city_code="")).id == whole[0].id


def test_files_say_where_schemas_and_lists_are(written):
    folder, _ = written
    text = next(folder.rglob("*.gml")).read_text(encoding="utf-8")
    assert "https://www.geospatial.jp/iur/uro/3.2 ../../schemas/iur/uro/3.2/urbanObject.xsd" in text
    assert "<core:creationDate>2026-04-01</core:creationDate>" in text
    listed = (folder / "codelists" / "Common_localPublicAuthorities.xml").read_text(encoding="utf-8")
    assert "<gml:description>東京都</gml:description><gml:name>13</gml:name>" in listed
    assert "<gml:name>13101</gml:name>" in listed


def test_date_of_the_building_stays(written):
    _, whole = written
    older = replace(whole[0], attributes={**whole[0].attributes, "creationDate": date(2020, 1, 2)})
    made = with_plateau_attributes(older, 1, replace(DELIVERY, created="2026-04-01"))
    assert made.attributes["creationDate"] == date(2020, 1, 2)


def test_schemas_of_the_version_go_along(tmp_path):
    source = tmp_path / "given"
    for module, name in (("uro", "urbanObject.xsd"), ("urf", "urbanFunction.xsd")):
        for version in ("3.1", "3.2"):
            place = source / "iur" / module / version / name
            place.parent.mkdir(parents=True)
            place.write_text(version, encoding="utf-8")
    copy_schemas(source, tmp_path / "set", "3.2")
    made = sorted(path.relative_to(tmp_path / "set").as_posix() for path in (tmp_path / "set").rglob("*.xsd"))
    assert made == ["schemas/iur/urf/3.2/urbanFunction.xsd", "schemas/iur/uro/3.2/urbanObject.xsd"]
    assert (tmp_path / "set" / made[1]).read_text(encoding="utf-8") == "3.2"
    with pytest.raises(InputError, match="2.0"):
        copy_schemas(source, tmp_path / "other", "2.0")


@pytest.mark.parametrize(("height", "told"), [("abc", "“abc” is no number"), (8.5, ""), (Measure(8.5, "m"), "")])
def test_measured_height_that_is_no_number_is_noted(height, told):
    item = next(iter(town().buildings))
    (row,) = building_rows(iter([replace(item, attributes={"measuredHeight": height})]), lambda corners: corners,
                           TableNotes())
    assert told in row.values["note"] and bool(row.values["note"]) == bool(told)


@pytest.mark.parametrize("far", [1e11, 2e4])
def test_corner_far_from_all_others_is_noted(far):
    item = next(iter(town().buildings))  # it has an attribute "note" of its own

    def moved(corners):
        return np.where(np.arange(len(corners))[:, None] == 0, corners + np.array([far, 0.0, 0.0]), corners)

    (row,) = building_rows(iter([item]), moved, TableNotes())
    assert f"{far / 1000:.0f} km apart" in row.values["note"]


def test_faces_without_a_kind_are_named_by_how_they_lie_wherever_they_are():
    """Turned squares of 2 cm, 4,000 km from the origin: sums lose no digit to the place."""
    turn = np.array([[0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
    flat = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]) @ turn
    standing = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1.0]]) @ turn
    place, rng = np.array([523_456.7, 3_987_654.3, 1234.5]), np.random.default_rng(0)
    squares = [0.02 * corners + place + rng.uniform(-1, 1, 3) for corners in [standing, flat, flat[::-1]] * 20]
    item = next(iter(town().buildings))
    shape = CityShape("2", MULTI_SURFACE, (tuple(CitySurface((corners,)) for corners in squares),))
    (row,) = building_rows(iter([replace(item, shapes=(shape,), parts=())]), lambda corners: corners, TableNotes())
    assert row.kinds == ["outer wall", "roof", "ground"] * 20


def test_columns_of_mixed_values_become_text_and_others_stay():
    with TableStore(False, False) as store:
        store.columns = {"mixed": [1, "a", None], "whole": [1, 2, None],
                         "FID": [1.5, None, 2.0], "yes": [True, None, False]}
        assert store.more_fields(["whole_"]) == [("mixed", "text"), ("whole", "int"), ("FID_", "real"), ("yes", "bool")]
        assert store.columns == {"mixed": ["1", "a", None], "whole": [1, 2, None], "FID_": [1.5, None, 2.0],
                                 "yes": [True, None, False]}
