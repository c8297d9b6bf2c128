"""Reference systems and height systems as text: old and new names, codes, parts, refusals."""

import re

import pytest
from pyproj import CRS

from urbanmap_qgis.citymodel.named_reference import given_reference, named_reference
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.reference.crs_text import (
    datum_key,
    horizontal_part,
    parse_wkt,
    same_horizontal,
    vertical_part,
    wkt_text,
)
from urbanmap_qgis.io.reference.height_systems import (
    ELLIPSOIDAL,
    UNKNOWN,
    carried_heights,
    height_system,
    height_unit,
    heights_of,
    japanese,
    refuse_other_heights,
    same_heights,
    stating_heights,
    stating_heights_of,
)

FORMS = ("WKT2_2019", "WKT2_2015", "WKT1_GDAL")
PLANE = CRS.from_epsg(6677).to_wkt()
ZONE_EPSG = {zone: 6668 + zone for zone in (1, 2, 6, 9, 13, 19)}


def renamed(wkt: str) -> str:
    """A system as databases from 2026 on write it: the same codes, JGD2024 in the names."""
    return wkt.replace("JGD2011", "JGD2024").replace("Geodetic Datum 2011", "Geodetic Datum 2024").replace(
        "Geodetic_Datum_2011", "Geodetic_Datum_2024")


def without_codes(wkt: str) -> str:
    return re.sub(r',(?:ID|AUTHORITY)\["EPSG",[^\]]*\]', "", wkt)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("code", [*ZONE_EPSG.values(), 6668])
def test_old_and_new_names_of_one_system_are_equal(code, form):
    old = CRS.from_epsg(code).to_wkt(form)
    new = renamed(old)
    assert new != old
    for one in (old, without_codes(old)):
        for other in (new, without_codes(new)):
            assert same_horizontal(one, other)


@pytest.mark.parametrize("form", FORMS)
def test_other_zones_and_datums_are_not_equal(form):
    for code in (6676, 2451, 30169, 32654):
        other = CRS.from_epsg(code).to_wkt(form)
        assert not same_horizontal(PLANE, other)
        assert not same_horizontal(without_codes(PLANE), without_codes(other)), code
    assert not same_horizontal(CRS.from_epsg(4326).to_wkt(), CRS.from_epsg(6668).to_wkt())


def test_degrees_are_equal_in_two_and_in_three_dimensions():
    assert same_horizontal(CRS.from_epsg(6668).to_wkt(), CRS.from_epsg(6667).to_wkt())
    assert same_horizontal(CRS.from_epsg(6668).to_wkt(), CRS.from_epsg(6697).to_wkt())


@pytest.mark.parametrize("code", [6677, 6697, 10168, 7415, 28992, 8353, 3857, 2154, 4979])
def test_text_is_parsed_and_written_without_loss(code):
    for form in FORMS[:2]:
        text = CRS.from_epsg(code).to_wkt(form)
        assert CRS.from_wkt(wkt_text(parse_wkt(text))).equals(CRS.from_wkt(text))


@pytest.mark.parametrize("text", ["", "PROJCRS", 'PROJCRS["a"', "EPSG:6677", 'A["b"]]', "+proj=tmerc", '"x"[1]',
                                  "[" * 99, "A[" * 999])
def test_what_is_no_text_of_a_system_is_refused(text):
    with pytest.raises(InputError):
        parse_wkt(text)


@pytest.mark.parametrize("form", ["WKT2_2019", "WKT1_GDAL", "WKT1_ESRI"])
@pytest.mark.parametrize(("code", "kind"), [(6697, "JGD2011"), (6695, "JGD2011"), (6694, "JGD2000"), (6696, "JGD2000"),
                                            (10162, "JGD2011"), (10174, "JGD2011"), (6677, "unknown"),
                                            (7415, "other")])
def test_height_system_of_known_codes(code, kind, form):
    assert heights_of(CRS.from_epsg(code).to_wkt(form)).kind == kind


@pytest.mark.parametrize("code", [11317, 11318, 11330, 11333, 11336, 11434, 11442, 11445])
def test_new_codes_are_known_though_the_database_lacks_them(code):
    assert height_system(f"EPSG:{code}") == japanese("JGD2024")


def test_height_systems_are_the_same_under_several_spellings():
    nap = [heights_of(CRS.from_epsg(7415).to_wkt(form)) for form in ("WKT2_2019", "WKT1_GDAL", "WKT1_ESRI")]
    assert all(same_heights(one, other) for one in nap for other in nap)
    assert not same_heights(nap[0], japanese("JGD2011"))
    assert not same_heights(UNKNOWN, UNKNOWN)
    assert heights_of(CRS.from_epsg(4979).to_wkt()) == ELLIPSOIDAL == height_system("ellipsoidal")
    assert [height_system(word).word for word in ("jgd2024", "6695", "EPSG:5709", "unknown", "")] == [
        "JGD2024", "JGD2011", "EPSG:5709", "unknown", "unknown"]
    with pytest.raises(InputError, match="JGD2000, JGD2011, JGD2024"):
        height_system("TP")


@pytest.mark.parametrize(("code", "heights"), [(7415, "EPSG:5709"), (5698, "EPSG:5720"), (6697, "JGD2011")])
def test_compound_systems_that_city_models_name_keep_the_code_of_their_heights(code, heights):
    assert named_reference(f"urn:ogc:def:crs:EPSG::{code}", "file").reference.heights == heights
    assert given_reference(CRS.from_epsg(code).to_wkt()).heights == heights


@pytest.mark.parametrize("word", ["unknown", "ellipsoidal", "JGD2024", "EPSG:5709", "NAP height"])
def test_a_word_for_heights_comes_back_also_where_it_is_a_mere_name(word):
    assert carried_heights(word).word == word


@pytest.mark.parametrize("kind", ["JGD2000", "JGD2011", "JGD2024"])
def test_stated_heights_come_back_from_every_form(kind):
    stated = stating_heights(PLANE, japanese(kind))
    crs = CRS.from_wkt(stated)
    assert crs.is_compound
    for form in FORMS:
        again = crs.to_wkt(form)
        assert heights_of(again) == japanese(kind), form
        assert same_horizontal(again, PLANE)
    assert vertical_part(parse_wkt(stating_heights(stated, UNKNOWN))) is None
    assert horizontal_part(parse_wkt(stated)).epsg == 6677


def test_result_states_the_heights_of_what_it_was_made_from():
    points = stating_heights(PLANE, japanese("JGD2024"))
    assert heights_of(stating_heights_of(PLANE, "", points)) == japanese("JGD2024")
    assert stating_heights_of(points, stating_heights(PLANE, japanese("JGD2011"))) == points
    assert stating_heights_of(PLANE, PLANE) == PLANE
    assert stating_heights_of("", points) == ""


def test_different_heights_are_refused_in_one_sentence_and_unknown_ones_are_not():
    old, new = (stating_heights(PLANE, japanese(kind)) for kind in ("JGD2011", "JGD2024"))
    with pytest.raises(InputError, match=r"^Ground has heights in JGD2011 .*, but Points in JGD2024 .*: convert one"):
        refuse_other_heights("Ground", old, "Points", new)
    refuse_other_heights("Ground", old, "Points", PLANE)
    refuse_other_heights("Ground", old, "Points", renamed(stating_heights(PLANE, japanese("JGD2011"))).replace(
        "JGD2024 (vertical)", "JGD2011 (vertical)"))
    refuse_other_heights("Ground", "", "Points", "")


def test_datum_is_one_word_under_all_its_names():
    assert {datum_key(parse_wkt(CRS.from_epsg(code).to_wkt(form))) for code in (6668, 6677, 6697)
            for form in (*FORMS, "WKT1_ESRI")} == {"jgd2011"}
    assert datum_key(parse_wkt(renamed(without_codes(PLANE)))) == "jgd2011"


@pytest.mark.parametrize(("system", "unit"), [
    ("EPSG:6677", 1.0), ("EPSG:2225", 1.0), ("EPSG:6677+6695", 1.0), ("EPSG:6677+8228", 0.3048),
    ("EPSG:26911+6360", 1200 / 3937)])
@pytest.mark.parametrize("version", ["WKT2_2019", "WKT1_GDAL"])
def test_the_unit_of_heights_is_that_of_the_vertical_system(system, unit, version):
    """Feet of the plan (EPSG:2225) say nothing of heights."""
    assert height_unit(CRS.from_user_input(system).to_wkt(version)) == pytest.approx(unit, abs=1e-9)
    assert height_unit("") == 1.0


@pytest.mark.parametrize("text", ["", 'LOCAL_CS["a"] € ¥', '§LOCAL_CS["a"]'])
def test_text_with_what_is_no_wkt_is_refused(text):
    with pytest.raises(InputError, match="no WKT"):
        parse_wkt(text)
