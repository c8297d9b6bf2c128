"""GSI building outlines: geometry against known coordinates, attributes, packings and bad files."""

import io
import zipfile
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from pyproj import CRS, Transformer

from urbanmap_qgis.errors import Cancelled, InputError
from urbanmap_qgis.io.official.gsi import fitting_zone, read_gsi_buildings, reproject
from urbanmap_qgis.io.official.gsi_sources import opened
from urbanmap_qgis.progress import Progress

LAT, LON = 35.69, 139.76
STEP = 0.0001
SQUARE = ((0, 0), (0, 1), (1, 1), (1, 0), (0, 0))  # north, east in steps


def positions(corners):
    return "\n".join(f"{LAT + STEP * north:.9f} {LON + STEP * east:.9f}" for north, east in corners)


def curve(corners, segment="LineStringSegment"):
    return (f"<gml:Curve><gml:segments><gml:{segment}><gml:posList>\n{positions(corners)}\n</gml:posList>"
            f"</gml:{segment}></gml:segments></gml:Curve>")


def ring(*members):
    members = "".join(f"<gml:curveMember>{curve(member)}</gml:curveMember>" for member in members)
    return f"<gml:Ring>{members}</gml:Ring>"


def area(*rings, name="a", kind="普通建物", srs="fguuid:jgd2011.bl", more=""):
    inner = "".join(f"<gml:interior>{one}</gml:interior>" for one in rings[1:])
    return (f'<BldA gml:id="{name}"><fid>fid-{name}</fid>'
            f'<lfSpanFr gml:id="{name}-1"><gml:timePosition>2015-09-18</gml:timePosition></lfSpanFr>'
            f'<devDate gml:id="{name}-2"><gml:timePosition>2016-01-02</gml:timePosition></devDate>'
            f'<orgGILvl>2500</orgGILvl><area><gml:Surface gml:id="{name}-g" srsName="{srs}"><gml:patches>'
            f"<gml:PolygonPatch><gml:exterior>{rings[0]}</gml:exterior>{inner}</gml:PolygonPatch></gml:patches>"
            f"</gml:Surface></area><type>{kind}</type>{more}</BldA>")


def line(corners, name="l", kind="普通建物"):
    body = curve(corners).replace("<gml:Curve>", '<gml:Curve srsName="fguuid:jgd2011.bl">')
    return f'<BldL gml:id="{name}"><fid>fid-{name}</fid><loc>{body}</loc><type>{kind}</type></BldL>'


def dataset(*objects, encoding="UTF-8"):
    return (f'<?xml version="1.0" encoding="{encoding}"?>\n'
            '<Dataset xmlns:gml="http://www.opengis.net/gml/3.2" '
            'xmlns="http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema" gml:id="Dataset1">\n'
            f'<gml:name>基盤地図情報</gml:name>\n{"".join(objects)}\n</Dataset>\n')


def zipped(entries):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries.items():
            archive.writestr(name, content)
    return buffer.getvalue()


@pytest.fixture
def read(tmp_path):
    """Read objects through a file."""
    def reader(*objects, **options):
        path = tmp_path / "FG-GML-533946-BldA-20240401-0001.xml"
        path.write_text(dataset(*objects), encoding="utf-8")
        return read_gsi_buildings(path, **options)
    return reader


def corners(polygon):
    """Exterior in steps north and east of the origin."""
    lon_lat = np.array(polygon.exterior.coords)
    return [tuple(pair) for pair in np.rint((lon_lat[:, ::-1] - [LAT, LON]) / STEP).astype(int).tolist()]


def square(north=0, east=0, size=1):
    return tuple((north + size * n, east + size * e) for n, e in SQUARE)


def test_longitude_first_attributes_kept(read):
    buildings = read(area(ring(SQUARE), name="b1", more="<name>市役所</name><orgMDId>M1</orgMDId>"))
    assert len(buildings) == 1 and buildings.crs == CRS.from_epsg(6668)
    assert buildings.geometries[0].bounds == pytest.approx((LON, LAT, LON + STEP, LAT + STEP), abs=1e-12)
    assert {name: values[0] for name, values in buildings.attributes.items()} == {
        "gml_id": "b1", "fid": "fid-b1", "lfSpanFr": "2015-09-18", "lfSpanTo": None, "devDate": "2016-01-02",
        "orgGILvl": "2500", "orgMDId": "M1", "type": "普通建物", "name": "市役所",
        "source": "FG-GML-533946-BldA-20240401-0001.xml"}
    assert buildings.notes == ()


def test_inner_rings(read):
    building = read(area(ring(square(size=9)), ring(square(1, 1, 2)), ring(square(5, 5, 3)))).geometries[0]
    assert len(building.interiors) == 2
    assert building.area / STEP**2 == pytest.approx(81 - 4 - 9, abs=1e-3)


@pytest.mark.parametrize("members", [
    (((0, 0), (0, 1), (1, 1)), ((1, 1), (1, 0), (0, 0))),
    (((0, 0), (0, 1), (1, 1)), ((0, 0), (1, 0), (1, 1))),  # second one backwards
    (((1, 1), (0, 1), (0, 0)), ((1, 1), (1, 0), (0, 0))),  # both start at the same point
    (((0, 1), (0, 0)), ((0, 1), (1, 1)), ((1, 0), (1, 1)), ((1, 0), (0, 0))),
])
def test_ring_of_several_curves(read, members):
    buildings = read(area(ring(*members)))
    assert sorted(set(corners(buildings.geometries[0]))) == [(0, 0), (0, 1), (1, 0), (1, 1)]
    assert buildings.geometries[0].area / STEP**2 == pytest.approx(1, abs=1e-4)
    assert buildings.notes == ()


def test_gap_is_closed_and_said(read):
    buildings = read(area(ring(SQUARE[:-1])))
    assert buildings.geometries[0].area / STEP**2 == pytest.approx(1, abs=1e-4)
    assert "1 gaps" in buildings.notes[0] and "11 m" in buildings.notes[0]


def test_other_curve_segments_are_said(read):
    text = area(ring(SQUARE)).replace("LineStringSegment", "ArcString")
    assert "ArcString" in read(text).notes[0]


def test_crossing_outline_becomes_its_valid_parts(read):
    buildings = read(area(ring(((0, 0), (1, 1), (1, 0), (0, 1), (0, 0)))))
    assert len(buildings) == 2 and shapely.is_valid(buildings.geometries).all()
    assert buildings.attributes["gml_id"] == ["a", "a"] and "repaired" in buildings.notes[0]


def test_unusable_building_is_named(read):
    broken = [area(ring(SQUARE), name="bad1").replace(f"{LAT:.9f}", "xx"),
              area(ring(((0, 0), (0, 1), (0, 0))), name="bad2"),
              area(ring(SQUARE), name="bad3").replace(f"{LON:.9f}", "39.76"),
              area(ring(SQUARE), name="bad4").replace(f"{LON:.9f}", "nan")]
    buildings = read(area(ring(SQUARE), name="good"), *broken)
    assert buildings.attributes["gml_id"] == ["good"]
    assert "4 buildings have no usable outline" in buildings.notes[0] and "bad1" in buildings.notes[0]
    with pytest.raises(InputError, match="bad1"):
        read(*broken)


def test_same_building_in_two_sheets_once(tmp_path):
    turned = SQUARE[2:-1] + SQUARE[:3]
    (tmp_path / "FG-GML-1-BldA-20240401-0001.xml").write_text(
        dataset(area(ring(SQUARE)), area(ring(square(5)), name="only1")), encoding="utf-8")
    (tmp_path / "FG-GML-2-BldA-20240401-0001.xml").write_text(
        dataset(area(ring(turned)), area(ring(square(6)), name="a")), encoding="utf-8")
    buildings = read_gsi_buildings(tmp_path)
    assert buildings.attributes["fid"] == ["fid-a", "fid-only1", "fid-a"]  # same fid, other place: kept
    assert "1 objects" in buildings.notes[0]


def test_closed_lines_are_buildings_and_courtyards(read):
    buildings = read(line(square(size=9), "outer"), line(square(2, 2, 5), "yard"), line(square(4, 4, 1), "in yard"),
                     line(square(0.5, 0.5, 1), "shed", kind="普通無壁舎"), line(square(0, 20), "apart"))
    by_name = dict(zip(buildings.attributes["gml_id"], buildings.geometries))
    assert set(by_name) == {"outer", "in yard", "shed", "apart"}
    assert by_name["outer"].area / STEP**2 == pytest.approx(81 - 25, abs=1e-3)
    assert "1 closed outlines" in buildings.notes[0]


def test_open_lines_close_rings_together_and_the_rest_is_counted(read):
    buildings = read(line(((5, 5), (5, 6)), "alone"), line(((0, 0), (0, 1), (1, 1)), "east"),
                     line(((0, 0), (1, 0), (1, 1)), "west"))
    assert buildings.attributes["gml_id"] == ["east"]
    assert buildings.geometries[0].area / STEP**2 == pytest.approx(1, abs=1e-4)
    assert any(note.startswith("2 open outlines") for note in buildings.notes)
    assert any(note.startswith("1 open outlines") for note in buildings.notes)


def test_only_open_lines_are_refused(read):
    with pytest.raises(InputError, match="closes to a polygon"):
        read(line(((0, 0), (0, 1), (1, 1))))


def test_outline_of_a_known_area_is_left_out(read):
    buildings = read(area(ring(SQUARE), name="a"), line(SQUARE, "same"), line(square(0, 3), "other"))
    assert buildings.attributes["gml_id"] == ["a", "other"]
    assert "1 outlines (BldL)" in buildings.notes[0]


def test_outline_of_a_known_area_need_not_be_whole_nor_the_same(read):
    courtyard = ring(square(2, 2, 2))
    nearly = ((0, 0), (0, 8.9), (8.9, 9), (9, 0), (0, 0))
    buildings = read(area(ring(square(size=9)), courtyard, name="a"), line(((0, 0), (0, 9), (9, 9)), "part"),
                     line(square(2, 2, 2), "yard"), line(nearly, "nearly"))
    assert buildings.attributes["gml_id"] == ["a"]
    assert len(buildings.notes) == 1 and "3 outlines (BldL)" in buildings.notes[0]


@pytest.mark.parametrize(("srs", "epsg", "said"), [
    ("fguuid:jgd2011.bl", 6668, 0), ("fguuid:jgd2000.bl", 4612, 0), ("fguuid:jgd2024.bl", 6668, 1)])
def test_reference_systems(read, srs, epsg, said):
    buildings = read(area(ring(SQUARE), srs=srs))
    assert buildings.crs == CRS.from_epsg(epsg) and len(buildings.notes) == said


def test_unknown_or_mixed_reference_systems_are_refused(read):
    with pytest.raises(InputError, match="tokyo"):
        read(area(ring(SQUARE), srs="fguuid:tokyo.bl"))
    with pytest.raises(InputError, match="separate runs"):
        read(area(ring(SQUARE)), area(ring(SQUARE), srs="fguuid:jgd2000.bl"))


@pytest.mark.parametrize("encoding", ["UTF-8", "Shift_JIS", "UTF-16", "EUC-JP", "iso-2022-jp"])
def test_declared_encoding_is_honoured(tmp_path, encoding):
    path = tmp_path / "建物.xml"
    path.write_bytes(dataset(area(ring(SQUARE)), encoding=encoding).encode(encoding))
    assert read_gsi_buildings(path).attributes["type"] == ["普通建物"]


def test_wrong_or_unknown_encoding(tmp_path):
    path = tmp_path / "a.xml"
    path.write_bytes(dataset(area(ring(SQUARE))).encode("shift_jis"))
    with pytest.raises(InputError, match=r"a\.xml holds bytes"):
        read_gsi_buildings(path)
    path.write_text(dataset(area(ring(SQUARE)), encoding="klingon"), encoding="utf-8")
    with pytest.raises(InputError, match="unknown encoding klingon"):
        read_gsi_buildings(path)


def test_zip_of_zips_folder_and_japanese_names(tmp_path):
    folder = tmp_path / "建物データ" / "東京"
    folder.mkdir(parents=True)
    xml = {letter: dataset(area(ring(square(0, 2 * i)), name=letter)) for i, letter in enumerate("abc")}
    roads = dataset('<RdEdg gml:id="r"><fid>r</fid></RdEdg>')
    inner = zipped({"FG-GML-533945-BldA-20240401-0001.xml": xml["b"], "FG-GML-533945-RdEdg-20240401-0001.xml": roads})
    (folder / "まとめ.zip").write_bytes(zipped({"東京/FG-GML-533945.zip": inner, "説明.txt": "x"}))
    (folder / "FG-GML-533944-BldA-20240401-0001.XML").write_text(xml["a"], encoding="utf-8")
    (tmp_path / "建物データ" / "other.xml").write_text("<metadata><title/></metadata>", encoding="utf-8")
    single = tmp_path / "c.xml"
    single.write_text(xml["c"], encoding="utf-8")
    buildings = read_gsi_buildings([tmp_path / "建物データ", single])
    assert sorted(buildings.attributes["gml_id"]) == ["a", "b", "c"]
    assert any("RdEdg" in note for note in buildings.notes) and any("not GSI" in note for note in buildings.notes)


def test_zip_entry_names_in_cp932(tmp_path):
    # A name that the zip does not mark as Unicode comes from Python as cp437.
    raw = "東京_建物.xml".encode("cp932")
    content = zipped({"x" * len(raw) + "": dataset(area(ring(SQUARE)))}).replace(b"x" * len(raw), raw)
    path = tmp_path / "a.zip"
    path.write_bytes(content)
    assert read_gsi_buildings(path).attributes["source"] == ["東京_建物.xml"]


def test_order_is_that_of_the_names(tmp_path):
    objects = {f"{letter}.xml": dataset(area(ring(square(0, i)), name=letter)) for i, letter in enumerate("abc")}
    for order in ("abc", "cab"):
        path = tmp_path / f"{order}.zip"
        path.write_bytes(zipped({f"{letter}.xml": objects[f"{letter}.xml"] for letter in order}))
        assert read_gsi_buildings(path).attributes["gml_id"] == ["a", "b", "c"]


def encrypted(content):
    """Set the flag of encryption in the central directory."""
    at = content.index(b"PK\x01\x02") + 8
    return content[:at] + bytes([content[at] | 1]) + content[at + 1:]


WHOLE = dataset(area(ring(SQUARE)))


@pytest.mark.parametrize(("name", "content", "says"), [
    ("cut.xml", WHOLE[:-200], "not whole"),
    ("empty.xml", "", "not whole"),
    ("text.xml", "just text", "not whole"),
    ("page.xml", "<html><body/></html>", "not GSI"),
    ("roads.xml", dataset('<RdEdg gml:id="r"><fid>r</fid></RdEdg>'), "but RdEdg"),
    ("none.xml", dataset(), "holds no buildings"),
    ("bomb.xml", '<?xml version="1.0"?><!DOCTYPE b [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]>' + WHOLE[38:],
     "document type"),
    ("late.xml", "<?xml version='1.0'?><!--" + "x" * 2**18 + "--><!DOCTYPE b []><b/>", "document type"),
    ("empty.zip", zipped({}), "holds no .xml"),
    ("readme.zip", zipped({"readme.txt": "x"}), "holds no .xml"),
    ("roads.zip", zipped({"FG-GML-533946-RdEdg-20240401-0001.xml": "<x/>"}), "no building outlines"),
    ("cut.zip", zipped({"a.xml": WHOLE})[:-30], "damaged"),
    ("notazip.zip", "text", "damaged"),
    ("inner.zip", zipped({"b.zip": "text"}), "damaged"),
    ("locked.zip", encrypted(zipped({"a.xml": WHOLE})), "encrypted"),
], ids=lambda value: value if isinstance(value, str) and value.endswith((".xml", ".zip")) else "")
def test_bad_files_are_refused_by_name(tmp_path, name, content, says):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
    with pytest.raises(InputError, match=says) as caught:
        read_gsi_buildings(path)
    assert name in str(caught.value) and "\n" not in str(caught.value)


def test_damage_inside_a_zip_entry(tmp_path):
    content = bytearray(zipped({"a.xml": WHOLE * 1}))
    content[60] ^= 0xFF
    path = tmp_path / "a.zip"
    path.write_bytes(bytes(content))
    with pytest.raises(InputError, match=r"a\.zip"):
        read_gsi_buildings(path)


def test_missing_path_and_empty_folder(tmp_path):
    with pytest.raises(InputError, match="does not exist"):
        read_gsi_buildings(tmp_path / "nowhere.xml")
    with pytest.raises(InputError, match=r"holds no \.xml"):
        read_gsi_buildings(tmp_path)
    with pytest.raises(InputError, match="No file"):
        read_gsi_buildings([])


def test_zip_in_zip_without_end(tmp_path):
    content = zipped({"a.xml": WHOLE})
    for _ in range(6):
        content = zipped({"deeper.zip": content})
    path = tmp_path / "a.zip"
    path.write_bytes(content)
    with pytest.raises(InputError, match="nested"):
        read_gsi_buildings(path)


def test_cancel_and_progress(read):
    fractions = []
    read(area(ring(SQUARE)), progress=Progress(report=fractions.append))
    assert fractions == sorted(fractions) and fractions[-1] == 1.0
    with pytest.raises(Cancelled):
        read(area(ring(SQUARE)), progress=Progress(cancelled=lambda: True))


def test_reproject_into_the_fitting_zone(read):
    buildings = read(area(ring(SQUARE)))
    assert fitting_zone(buildings) == 6677
    projected = reproject(buildings)
    transformer = Transformer.from_crs("EPSG:6668", "EPSG:6677")  # latitude in, northing out first
    expected = [transformer.transform(LAT + STEP * n, LON + STEP * e)[::-1] for n, e in SQUARE]
    assert projected.crs == CRS.from_epsg(6677)
    np.testing.assert_allclose(shapely.get_coordinates(projected.geometries), expected, atol=1e-4)
    assert projected.geometries[0].area == pytest.approx(11.1 * 9.05, rel=0.01)


def test_reproject_into_a_chosen_system(read):
    buildings = read(area(ring(SQUARE)))
    assert reproject(buildings, "EPSG:32654").crs == CRS.from_epsg(32654)
    assert reproject(buildings, CRS.from_epsg(6677).to_wkt()).crs.name.endswith("CS IX")
    with pytest.raises(InputError, match="not known"):
        reproject(buildings, "EPSG:1")


def test_movement_of_2011_is_said(read):
    warned = []
    buildings = read(area(ring(SQUARE), srs="fguuid:jgd2000.bl"))
    projected = reproject(buildings, progress=Progress(warn=warned.append))
    assert "PatchJGD" in projected.notes[-1] and warned == [projected.notes[-1]]
    assert reproject(buildings, "EPSG:2451").notes == ()


def test_buildings_in_two_zones_are_said(read):
    far = area(ring(SQUARE), name="far").replace("139.76", "137.38").replace("35.69", "34.77")
    projected = reproject(read(area(ring(SQUARE)), area(ring(square(3)), name="b"), far))
    assert projected.crs == CRS.from_epsg(6677) and "1 of 3 buildings" in projected.notes[0]
    assert "in VII:" in projected.notes[0]


@pytest.mark.parametrize(("error", "said"), [(PermissionError(13, "Permission denied"), r"\(Permission denied\)"),
                                             (OSError("device gone"), r"\(device gone\)")])
def test_why_a_file_cannot_be_read_is_said_in_the_systems_words(error, said):
    def refuse():
        raise error

    with pytest.raises(InputError, match=f"a.xml cannot be read {said}: check the file"), opened(
            SimpleNamespace(name="a.xml", open=refuse)):
        pass


def test_a_damaged_zip_in_a_zip(tmp_path):
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w") as archive:
        archive.writestr("a.xml", "<a/>")
    for number, content in enumerate((b"PK\x03\x04 no zip at all", inner.getvalue()[:-9], b"")):
        with zipfile.ZipFile(tmp_path / f"{number}.zip", "w") as archive:
            archive.writestr("inner.zip", content)
        with pytest.raises(InputError, match=r"inner\.zip is damaged or not a zip file"):
            read_gsi_buildings(tmp_path / f"{number}.zip")


def test_buildings_of_two_zones_are_told_by_the_names_of_both():
    tokyo, osaka = shapely.box(139.7, 35.6, 139.701, 35.601), shapely.box(135.5, 34.6, 135.501, 34.601)
    notes = []
    assert fitting_zone(SimpleNamespace(geometries=np.array([tokyo, tokyo, osaka], object)), notes) == 6677
    assert len(notes) == 1 and "zone IX," in notes[0] and "in VI:" in notes[0] and notes[0].startswith("1 of 3")
