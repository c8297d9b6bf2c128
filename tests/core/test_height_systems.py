"""Reference systems and height systems as text: old and new names, codes, parts, refusals."""

from __future__ import annotations

import re

import laspy
import numpy as np
import pytest
from pyproj import CRS

from urbanmap_qgis.citymodel.named_reference import given_reference, named_reference
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.points.pointcloud import open_cloud
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
from urbanmap_qgis.io.reference.plane_rectangular import TOWNS, ZONE_NAMES, zone_epsg, zone_numbers
from urbanmap_qgis.io.reference.renamed_crs import known_wkt
from urbanmap_qgis.io.reference.system_parts import (
    datum_key,
    horizontal_part,
    own_code,
    parsed_crs,
    same_horizontal,
    vertical_part,
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


@pytest.mark.parametrize("text", ["", "PROJCRS", 'PROJCRS["a"', 'A["b"]]', '"x"[1]',
                                  "[" * 99, "A[" * 999])
def test_what_is_no_text_of_a_system_is_refused(text):
    with pytest.raises(InputError):
        parsed_crs(text)


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
    assert vertical_part(stating_heights(stated, UNKNOWN)) is None
    assert own_code(horizontal_part(stated)) == 6677


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
    assert {datum_key(parsed_crs(CRS.from_epsg(code).to_wkt(form))) for code in (6668, 6677, 6697)
            for form in (*FORMS, "WKT1_ESRI")} == {"jgd2011"}
    assert datum_key(parsed_crs(renamed(without_codes(PLANE)))) == "jgd2011"


@pytest.mark.parametrize(("system", "unit"), [
    ("EPSG:6677", 1.0), ("EPSG:2225", 1.0), ("EPSG:6677+6695", 1.0), ("EPSG:6677+8228", 0.3048),
    ("EPSG:26911+6360", 1200 / 3937)])
@pytest.mark.parametrize("version", ["WKT2_2019", "WKT1_GDAL"])
def test_the_unit_of_heights_is_that_of_the_vertical_system(system, unit, version):
    """Feet of the plan (EPSG:2225) say nothing of heights."""
    assert height_unit(CRS.from_user_input(system).to_wkt(version)) == pytest.approx(unit, abs=1e-9)
    assert height_unit("") == 1.0


@pytest.mark.parametrize("text", ["", '§LOCAL_CS["a"]'])
def test_text_with_what_is_no_wkt_is_refused(text):
    with pytest.raises(InputError, match="cannot be understood"):
        parsed_crs(text)


# Systems under the names that newer databases give them are the ones that older databases know


def renamed_wkt(epsg):
    """A system as a database of 2026 writes it: the same code, other names of what is horizontal."""
    wkt = CRS.from_epsg(epsg).to_wkt()
    for old, new in (('"JGD2011"', '"JGD2024"'), ('"JGD2011 /', '"JGD2024 /'), ('"JGD2011 +', '"JGD2024 +'),
                     ('"Japanese Geodetic Datum 2011"', '"Japanese Geodetic Datum 2024"')):
        wkt = wkt.replace(old, new)
    return wkt


@pytest.mark.parametrize("epsg", [6668, 6677, 6691, 6697])
def test_renamed_systems_are_known(epsg):
    wkt = renamed_wkt(epsg)
    assert "JGD2024" in wkt
    assert CRS.from_wkt(known_wkt(wkt)).to_epsg() == epsg
    assert known_wkt(known_wkt(wkt)) == known_wkt(wkt)


def test_heights_keep_their_names():
    heights = 'VERTCRS["JGD2024 (vertical) height",VDATUM["Japanese Geodetic Datum 2024 (vertical)"],CS[vertical,1]]'
    assert known_wkt(heights) == heights
    assert known_wkt(CRS.from_epsg(2451).to_wkt()) == CRS.from_epsg(2451).to_wkt()


def test_clouds_under_both_names_are_one(make_cloud, tmp_path):
    axis = np.arange(10.0)
    first = make_cloud(tmp_path / "a.laz", axis, axis, axis)
    second = make_cloud(tmp_path / "b.laz", axis, axis, axis, epsg=None)
    cloud = laspy.read(second)
    cloud.header.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr(renamed_wkt(6677)))
    cloud.header.global_encoding.wkt = True
    cloud.write(second)
    assert "JGD2024" in laspy.open(second).header.parse_crs().name
    assert CRS.from_wkt(open_cloud([second]).crs_wkt).to_epsg() == 6677
    assert open_cloud([second, first]).point_count == 20


# Zones of the Japan Plane Rectangular CS: the law's zones, and EPSG's parameters of them


# Origins in the notification: latitude, longitude.
ORIGINS = [(33, 129.5), (33, 131), (36, 132 + 10 / 60), (33, 133.5), (36, 134 + 20 / 60), (36, 136),
           (36, 137 + 10 / 60), (36, 138.5), (36, 139 + 50 / 60), (40, 140 + 50 / 60), (44, 140.25), (44, 142.25),
           (44, 144.25), (26, 142), (26, 127.5), (26, 124), (26, 131), (20, 136), (26, 154)]

# Seats of municipalities, with the zone of their prefecture by law; none of them need be in the table of towns.
# Positions: localgovjp (CC0), github.com/code4fukui/localgovjp.
SEATS = {
    "Shikabe": (42.0266, 140.8317, 11), "Nakasatsunai": (42.6979, 143.1344, 13),
    "Hamanaka": (43.0763, 145.1310, 13), "Goshogawara": (40.8078, 140.4461, 10), "Nagai": (38.1061, 140.0339, 10),
    "Koori": (37.8547, 140.5209, 9), "Nishiaizu": (37.5874, 139.6493, 9), "Naganohara": (36.5443, 138.6498, 9),
    "Toshima": (35.7261, 139.7167, 9), "Hachijo": (33.1128, 139.7891, 9), "Kashiwazaki": (37.3649, 138.5578, 8),
    "Neba": (35.2553, 137.5818, 8), "Miyota": (36.3227, 138.5065, 8), "Tarui": (35.3663, 136.5379, 7),
    "Nomi": (36.4469, 136.5540, 7), "Shitara": (35.0973, 137.5712, 7), "Inabe": (35.1584, 136.5167, 6),
    "Takahama": (35.4879, 135.5460, 6), "Kyotamba": (35.1700, 135.4193, 6), "Nishiwaki": (34.9834, 134.9797, 5),
    "Kofu (Tottori)": (35.2760, 133.4790, 5), "Minamiawaji": (34.2944, 134.7800, 5),
    "Tsuwano": (34.5420, 131.8351, 3), "Nishinoshima": (36.0918, 133.0135, 3),
    "Jinsekikogen": (34.7036, 133.2517, 3), "Tonosho": (34.4867, 134.1886, 4), "Awa": (34.1021, 134.2975, 4),
    "Niyodogawa": (33.5753, 133.1710, 4), "Chikushino": (33.4874, 130.5260, 2), "Takeo": (33.1949, 130.0216, 2),
    "Shibushi": (31.4776, 131.0998, 2), "Yakushima": (30.3899, 130.6511, 2), "Amagi": (27.8117, 128.8977, 1),
    "Yoron": (27.0449, 128.4217, 1), "Naha": (26.2123, 127.6792, 15), "Ishigaki": (24.3444, 124.1852, 16),
    "Miyakojima": (24.7900, 125.2948, 16),
}
PLACES = {
    "Tokyo": (35.69, 139.76, 9), "Sapporo": (43.06, 141.35, 12), "Osaka": (34.69, 135.52, 6),
    "Nagoya": (35.17, 136.91, 7), "Fukuoka": (33.59, 130.42, 2), "Takamatsu": (34.35, 134.05, 4),
    "Fukuyama": (34.49, 133.37, 3), "Chichijima": (27.09, 142.19, 14), "Iwo To": (24.78, 141.32, 14),
    "Minamitorishima": (24.29, 153.98, 19), "Okinotorishima": (20.42, 136.08, 18), "Minamidaito": (25.83, 131.23, 17),
    "Iheya": (27.04, 127.97, 15), "Kikai": (28.32, 129.94, 1),
}


@pytest.mark.parametrize("zone", range(1, 20))
def test_epsg_code_of_each_zone_has_the_origin_of_the_law(zone):
    crs = CRS.from_epsg(zone_epsg(zone))
    values = {parameter.name: parameter.value for parameter in crs.coordinate_operation.params}
    # EPSG's databases from 2026 on call the same systems JGD2024.
    assert crs.name.replace("JGD2024", "JGD2011") == f"JGD2011 / Japan Plane Rectangular CS {ZONE_NAMES[zone - 1]}"
    assert (values["Latitude of natural origin"], values["Longitude of natural origin"]) == pytest.approx(
        ORIGINS[zone - 1])


@pytest.mark.parametrize(("latitude", "longitude", "zone"), [*SEATS.values(), *PLACES.values()],
                         ids=[*SEATS, *PLACES])
def test_place_lies_in_the_zone_of_the_law(latitude, longitude, zone):
    assert zone_numbers(longitude, latitude).tolist() == [zone]


@pytest.mark.parametrize("zone", sorted(TOWNS))
def test_towns_lie_within_epsgs_area_of_use(zone):
    area = CRS.from_epsg(zone_epsg(zone)).area_of_use
    # EPSG's boxes leave out Shodoshima (Kagawa), Cape Erimo and the northern islands, which the law names.
    beyond = {"Tonosho", "Uchinomi", "Erimo", "Etorofu", "Shikotan"}
    for name, (latitude, longitude) in TOWNS[zone].items():
        if name not in beyond:
            assert area.south - 0.02 <= latitude <= area.north + 0.02, name
            assert area.west - 0.02 <= longitude <= area.east + 0.02, name


def test_many_places_at_once():
    rows = np.array(list(PLACES.values()))
    assert zone_numbers(rows[:, 1], rows[:, 0]).tolist() == rows[:, 2].tolist()
