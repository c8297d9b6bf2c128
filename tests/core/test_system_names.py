"""Names of reference systems in the user's language: what EPSG's register calls them, told as surveyors write it."""

import pytest
from pyproj import CRS

from urbanmap_qgis.io.reference.system_names import local_name
from urbanmap_qgis.job.agreement import system_name
from urbanmap_qgis.wording import use_catalogue

TRANSLATED = """<TS language="ja"><context><name>UrbanMap</name>
<message><source>{datum} / Japan Plane Rectangular CS {zone}</source>
<translation>{datum} / 平面直角座標系 第{zone}系</translation></message>
<message><source>{datum} (vertical) height</source><translation>{datum} 標高</translation></message>
</context></TS>"""


@pytest.fixture
def japanese(tmp_path):
    path = tmp_path / "urbanmap_ja.ts"
    path.write_text(TRANSLATED, encoding="utf-8")
    use_catalogue(path)
    yield
    use_catalogue(None)


def test_all_zones_have_their_number(japanese):
    # EPSG 6669 to 6687 are zones 1 to 19 of JGD2011.
    for zone in range(1, 20):
        said = system_name(CRS.from_epsg(6668 + zone).to_wkt())
        assert said == f"EPSG:{6668 + zone} JGD2011 / 平面直角座標系 第{zone}系"


def test_compound_names_are_told_part_by_part(japanese):
    assert local_name("JGD2011 / Japan Plane Rectangular CS IX + JGD2011 (vertical) height") == \
        "JGD2011 / 平面直角座標系 第9系 + JGD2011 標高"


def test_what_has_no_words_stays(japanese):
    assert local_name("JGD2011 / UTM zone 54N") == "JGD2011 / UTM zone 54N"
    assert local_name("Amersfoort / RD New") == "Amersfoort / RD New"


def test_english_is_as_the_register_has_it():
    assert system_name(CRS.from_epsg(6677).to_wkt()) == "EPSG:6677 JGD2011 / Japan Plane Rectangular CS IX"
