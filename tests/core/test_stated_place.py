"""Names of reference systems, and what a stated place says."""

from __future__ import annotations

import laspy
import numpy as np
import pytest
from laspy.vlrs.known import GeoKeyDirectoryVlr, GeoKeyEntryStruct, WktCoordinateSystemVlr
from pyproj import CRS

from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.points.pointcloud import PointLayout, given_crs, open_cloud
from urbanmap_qgis.io.reference.height_systems import height_unit, heights_of
from urbanmap_qgis.io.reference.system_names import local_name
from urbanmap_qgis.io.reference.true_lengths import metric_zone, point_scale, require_true_lengths
from urbanmap_qgis.job.agreement import system_name
from urbanmap_qgis.progress import notices_to
from urbanmap_qgis.wording import use_catalogue

X, Y = -7000.0, -34000.0


def las(path, keys=(), wkt="", bit=False, scale=0.001, shift=0.0):
    """A LAS 1.4 file of 50 points that states its place by GeoTIFF keys (id, value), a WKT or both."""
    header = laspy.LasHeader(point_format=1, version="1.4")
    header.scales, header.offsets = [scale] * 3, [X, Y, 0.0]
    if keys:
        record = GeoKeyDirectoryVlr()
        record.geo_keys = [GeoKeyEntryStruct(id=key, tiff_tag_location=0, count=1, value_offset=value)
                           for key, value in keys]
        record.geo_keys_header.number_of_keys = len(record.geo_keys)
        header.vlrs.append(record)
    if wkt:
        header.vlrs.append(WktCoordinateSystemVlr(wkt))
    header.global_encoding.wkt = bit
    points = laspy.ScaleAwarePointRecord.zeros(50, header=header)
    rng = np.random.default_rng(1)
    points.x, points.y, points.z = (rng.uniform(0, 50, 50) + start for start in (X, Y + shift, 20.0))
    with laspy.open(path, "w", header=header) as writer:
        writer.write_points(points)
    return path


def opened(*paths):
    """The cloud and what was said on opening it."""
    said = []
    with notices_to(said.append):
        return open_cloud(paths), said


@pytest.mark.parametrize(("bit", "zone"), [(True, "X"), (False, "IX")])
def test_the_bit_says_which_of_two_statements_counts(tmp_path, bit, zone):
    cloud, said = opened(las(tmp_path / "a.las", [(3072, 6677)], CRS.from_epsg(6678).to_wkt("WKT1_GDAL"), bit))
    assert CRS.from_wkt(cloud.crs_wkt).name.endswith(f" CS {zone}")
    assert len(said) == 1 and "states two reference systems" in said[0]


def test_a_local_system_states_no_place(tmp_path):
    cloud, said = opened(las(tmp_path / "a.las", [(3072, 6677)], 'LOCAL_CS["unnamed",UNIT["metre",1]]', True))
    assert CRS.from_wkt(cloud.crs_wkt).to_epsg() == 6677 and not said


@pytest.mark.parametrize(("keys", "unit", "kind"), [
    ([(4096, 6360), (4099, 9003)], 1200 / 3937, "other"), ([(4096, 6695)], 1.0, "JGD2011"),
    ([(4099, 9002)], 0.3048, "other"), ([(4096, 11317)], 1.0, "JGD2024"),
    ([(4096, 5030), (4099, 9001)], 1.0, "unknown")])
def test_keys_state_the_heights_and_their_unit(tmp_path, keys, unit, kind):
    cloud, _ = opened(las(tmp_path / "a.las", [(3072, 6677), *keys]))
    assert height_unit(cloud.crs_wkt) == pytest.approx(unit, rel=1e-9) and heights_of(cloud.crs_wkt).kind == kind


def test_units_that_contradict_the_system_are_refused(tmp_path):
    with pytest.raises(InputError, match="contradicts itself"):
        opened(las(tmp_path / "a.las", [(3072, 6677), (3076, 9002)]))


def test_a_given_system_counts_and_is_written(tmp_path):
    path = las(tmp_path / "a.las", [(3072, 6678)])
    with given_crs(CRS.from_epsg(6677).to_wkt(), [path]):
        cloud, said = opened(path)
        header = PointLayout(cloud).header
    assert CRS.from_wkt(cloud.crs_wkt).to_epsg() == 6677 and "which was given for it" in said[0]
    assert header.parse_crs().to_epsg() == 6677
    with given_crs(CRS.from_epsg(6677).to_wkt()):  # for files that state none
        assert CRS.from_wkt(opened(path)[0].crs_wkt).to_epsg() == 6678


def test_a_box_that_does_not_hold_the_points_is_found_anew(tmp_path):
    path = las(tmp_path / "a.las", [(3072, 6677)])
    content = bytearray(path.read_bytes())
    content[179:227] = bytes(48)  # largest and least x, y, z
    path.write_bytes(content)
    cloud, said = opened(path)
    assert X <= cloud.minimum[0] <= cloud.maximum[0] <= X + 50 and "box in the header" in said[0]


def test_files_far_apart_get_a_scale_in_which_both_fit(tmp_path):
    far = [las(tmp_path / f"{shift}.las", [(3072, 6677)], scale=1e-5, shift=shift) for shift in (0.0, -20000.0)]
    near = PointLayout(opened(far[0])[0]).header
    both = PointLayout(opened(*far)[0]).header
    assert near.scales == pytest.approx([1e-5] * 3) and both.scales == pytest.approx([1e-5] * 3)
    path = las(tmp_path / "far.las", [(3072, 6677)], scale=1e-5)
    content = bytearray(path.read_bytes())
    content[163:171] = np.float64(Y - 45000.0).tobytes()  # offset of y, and what the box says of it
    for place in (195, 203):
        content[place:place + 8] = np.float64(np.frombuffer(bytes(content[place:place + 8]))[0] - 45000.0).tobytes()
    path.write_bytes(content)
    cloud, _ = opened(far[0], path)
    header = PointLayout(cloud).header
    assert header.scales == pytest.approx([1e-5, 1e-4, 1e-5])
    assert ((cloud.maximum - header.offsets) / header.scales < 2**31).all()


def test_scale_of_projections():
    """Web Mercator stretches by 1 / cos(latitude) on its sphere; a UTM zone has 0.9996 at its meridian."""
    scale, _, latitude = point_scale(CRS.from_epsg(3857).to_wkt(), 15_560_000.0, 4_257_000.0)
    assert latitude == pytest.approx(35.69, abs=0.02)
    assert scale == pytest.approx(1 / np.cos(np.radians(latitude)), rel=4e-3)
    assert point_scale(CRS.from_epsg(32654).to_wkt(), 500_000.0, 3_900_000.0)[0] == pytest.approx(0.9996, abs=1e-6)
    assert point_scale(CRS.from_epsg(6677).to_wkt(), X, Y)[0] == pytest.approx(0.9999, abs=1e-5)
    assert point_scale(CRS.from_epsg(6668).to_wkt(), 139.0, 35.0) is None


def test_lengths_that_are_none_are_refused_with_a_zone_that_fits():
    with pytest.raises(InputError, match=r"1\.23.* EPSG:6677"):
        require_true_lengths("ortho.tif", CRS.from_epsg(3857).to_wkt(), (15_550_000, 4_256_000, 15_570_000, 4_258_000))
    said = []
    with notices_to(said.append):
        require_true_lengths("a", CRS.from_epsg(2154).to_wkt(), (870_000, 6_618_000, 871_000, 6_619_000))
        require_true_lengths("b", CRS.from_epsg(6677).to_wkt(), (X, Y, X + 500, Y + 500))
    assert len(said) == 1 and said[0].startswith("a: in ") and "0.999" in said[0]
    assert "UTM zone 31N" in metric_zone(2.3, 48.9) and "zone 56S" in metric_zone(151.2, -33.9)


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
