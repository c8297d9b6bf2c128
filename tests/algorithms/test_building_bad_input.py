"""What the building algorithms say to input that they cannot use, and that it costs no earlier result."""

from __future__ import annotations

import json
from datetime import date

import laspy
import numpy as np
import pytest
import shapely
import shapely.affinity

EAST, NORTH = -7000.0, -35000.0
HOUSE = shapely.box(EAST, NORTH, EAST + 12, NORTH + 15)
OTHER = shapely.box(EAST + 30, NORTH, EAST + 40, NORTH + 15)


@pytest.fixture(scope="module")
def points(synthetic):
    """Points (n, 3) of a house at 12.3 m and one at 9 m."""
    scene = synthetic.Scene([synthetic.flat(HOUSE, 12.3), synthetic.flat(OTHER, 9.0)], spacing=0.6)
    return scene.points()[0]


@pytest.fixture(scope="module")
def good(qgis_app, points, make_cloud, save_outlines, tmp_path_factory):
    """Files of every stage as they should be, by parameter name of the stage that reads them."""
    import processing

    folder = tmp_path_factory.mktemp("good")
    cloud = str(make_cloud(folder / "cloud.laz", *points.T))
    outlines = str(save_outlines(folder / "outlines.gpkg", [HOUSE, OTHER]))
    stages = {"cloud": cloud, "outlines": outlines}
    found = processing.run("urbanmap:segmentbuildings", {
        "POINTS": [cloud], "FOOTPRINTS": outlines, "OUTPUT": str(folder / "buildings.laz"),
        "OUTPUT_BUILDINGS": str(folder / "buildings.gpkg")})
    stages.update(building_points=found["OUTPUT"], buildings=found["OUTPUT_BUILDINGS"])
    found = processing.run("urbanmap:segmentroofs", {
        "POINTS": [stages["building_points"]], "FOOTPRINTS": stages["buildings"], "OUTPUT": str(folder / "roofs.laz"),
        "OUTPUT_ROOFS": str(folder / "roofs.gpkg")})
    stages.update(roof_points=found["OUTPUT"], roofs=found["OUTPUT_ROOFS"])
    found = processing.run("urbanmap:roofpolygons", {
        "POINTS": [stages["roof_points"]], "FOOTPRINTS": stages["buildings"],
        "OUTPUT": str(folder / "polygons.gpkg")})
    return {**stages, "polygons": found["OUTPUT"]}


def parameters_of(algorithm, good, folder):
    """Parameters with which an algorithm runs, all its outputs asked for."""
    inputs = {
        "segmentbuildings": {"POINTS": [good["cloud"]], "FOOTPRINTS": good["outlines"]},
        "segmentroofs": {"POINTS": [good["building_points"]], "FOOTPRINTS": good["buildings"]},
        "roofpolygons": {"POINTS": [good["roof_points"]], "FOOTPRINTS": good["buildings"]},
        "buildingmodels": {"ROOFS": good["polygons"], "FOOTPRINTS": good["buildings"],
                           "POINTS": [good["roof_points"]]},
        "buildingsfromals": {"POINTS": [good["cloud"]], "FOOTPRINTS": good["outlines"]},
    }
    return {**inputs[algorithm], **{name: str(folder / file) for name, file in OUTPUTS[algorithm].items()}}


MODEL_FILES = {"OUTPUT": "models.gpkg", "OUTPUT_SURFACES": "surfaces.gpkg", "OUTPUT_CITYJSON": "models.city.json",
               "OUTPUT_MESH": "models.obj", "OUTPUT_REPORT": "report.html"}
OUTPUTS = {
    "segmentbuildings": {"OUTPUT": "points.laz", "OUTPUT_BUILDINGS": "buildings.gpkg"},
    "segmentroofs": {"OUTPUT": "points.laz", "OUTPUT_ROOFS": "roofs.gpkg"},
    "roofpolygons": {"OUTPUT": "polygons.gpkg"},
    "buildingmodels": MODEL_FILES,
    "buildingsfromals": MODEL_FILES,
}


@pytest.fixture
def refuse(run, good, tmp_path):
    """`refuse(algorithm, **changes)`: the sentence of a run that must fail, and leave earlier results alone."""

    def refused(algorithm, **changes):
        from qgis.core import QgsProcessingException

        folder = tmp_path / "results"
        folder.mkdir(exist_ok=True)
        for file in OUTPUTS[algorithm].values():
            (folder / file).write_bytes(b"an earlier result")
        with pytest.raises(QgsProcessingException) as caught:
            run(f"urbanmap:{algorithm}", {**parameters_of(algorithm, good, folder), **changes})
        assert {path.name for path in folder.iterdir()} == set(OUTPUTS[algorithm].values())
        assert {path.read_bytes() for path in folder.iterdir()} == {b"an earlier result"}
        sentence = str(caught.value).removeprefix("Unable to execute algorithm").strip()
        print(f"\n{algorithm}: {sentence}")
        assert "\n" not in sentence
        assert "Traceback" not in "".join([sentence, *run.feedback.errors])
        return sentence

    return refused


@pytest.fixture
def cloud(make_cloud, points, tmp_path):
    """`cloud(change, **options)`: a file of the points after a change of their coordinates."""

    def make(change=lambda array: array, name="cloud.laz", **options):
        return str(make_cloud(tmp_path / name, *change(points.copy()).T, **options))

    return make


# Coordinate systems

@pytest.mark.parametrize("algorithm", ["segmentbuildings", "buildingsfromals"])
@pytest.mark.parametrize(("epsg", "words"), [
    (6668, "are no degrees"), (2263, "no transformation"), (6676, "do not overlap"), (None, "is missing")])
def test_outlines_in_an_unsuitable_crs(refuse, save_outlines, tmp_path, algorithm, epsg, words):
    outlines = save_outlines(tmp_path / "o.gpkg", [HOUSE], epsg=epsg)
    assert words in refuse(algorithm, FOOTPRINTS=str(outlines))


@pytest.mark.parametrize("epsg", [6668, 2263])
def test_points_in_an_unsuitable_crs(refuse, cloud, epsg):
    assert "Point clouds" in refuse("segmentbuildings", POINTS=[cloud(epsg=epsg)])


@pytest.mark.parametrize("epsg", [6668, 6676, 32654, 6697])
def test_outlines_in_degrees_or_another_zone_are_taken_to_the_points_and_said_so(run, good, save_outlines, tmp_path,
                                                                                epsg):
    """The same house, wherever its outline was drawn, gets the same points."""
    from pyproj import Transformer

    to = Transformer.from_crs(6677, epsg, always_xy=True)
    there = shapely.transform(HOUSE, lambda xy: np.column_stack(to.transform(xy[:, 0], xy[:, 1])))
    found = {}
    for name, outline, code in (("here", HOUSE, 6677), ("there", there, epsg)):
        parameters = parameters_of("segmentbuildings", good, tmp_path)
        outlines = save_outlines(tmp_path / f"{name}.gpkg", [outline], epsg=code)
        result = run("urbanmap:segmentbuildings", {**parameters, "FOOTPRINTS": str(outlines), "MAX_DISPLACEMENT": 0})
        layer = points_and_areas(result["OUTPUT_BUILDINGS"])
        found[name] = (layer, result)
    assert found["there"][0] == found["here"][0]
    told = "".join(run.feedback.warnings)
    assert "reprojected from" in told and ("accurate to 1 m" in told) == (epsg == 32654)


def points_and_areas(path):
    """Points and area of each building of a layer."""
    from qgis.core import QgsVectorLayer

    layer = QgsVectorLayer(str(path), "buildings", "ogr")
    return [(item["points"], round(item.geometry().area(), 3)) for item in layer.getFeatures()]


def test_point_files_in_two_crs(refuse, cloud):
    assert "one coordinate reference system" in refuse("segmentbuildings", POINTS=[cloud(), cloud(
        name="other.laz", epsg=6676)])


@pytest.mark.parametrize("epsg", [6677, None])
def test_points_that_count_x_to_the_north(refuse, cloud, epsg):
    assert "swapped" in refuse("segmentbuildings", POINTS=[cloud(lambda xyz: xyz[:, [1, 0, 2]], epsg=epsg)])


def test_points_without_crs_take_that_of_the_outlines_and_say_so(run, good, cloud, tmp_path):
    from urbanmap_qgis.io.points.pointcloud import open_cloud

    parameters = parameters_of("segmentbuildings", good, tmp_path)
    result = run("urbanmap:segmentbuildings", {**parameters, "POINTS": [cloud(epsg=None)]})
    assert "EPSG:6677" in "".join(run.feedback.warnings)
    assert "Japan Plane Rectangular CS IX" in open_cloud([result["OUTPUT"]]).crs_wkt


def test_outlines_younger_than_the_flight_say_so(run, good, save_outlines, make_cloud, tmp_path):
    """The flight is of 2020-05-02 by its times; one outline is younger, one had ended, one holds nothing."""
    seconds = (date(2020, 5, 2) - date(1980, 1, 6)).days * 86_400 + 36_000 - 1e9
    las = laspy.read(good["cloud"])
    las.gps_time = np.full(len(las.points), seconds)
    las.header.global_encoding.gps_time_type = laspy.header.GpsTimeType.STANDARD
    las.write(tmp_path / "flown.laz")
    nothing = shapely.transform(HOUSE, lambda xy: np.add(xy, (0.0, 15.0)))
    outlines = save_outlines(tmp_path / "dated.gpkg", [HOUSE, OTHER, nothing], {
        "lfSpanFr": ["2001-01-01", "1990", "2021-03-01"], "lfSpanTo": ["", "2019-01-01", ""]})
    result = run("urbanmap:segmentbuildings", {
        **parameters_of("segmentbuildings", good, tmp_path), "POINTS": [str(tmp_path / "flown.laz")],
        "FOOTPRINTS": str(outlines)})
    from qgis.core import QgsVectorLayer

    notes = [item["note"] or "" for item in QgsVectorLayer(result["OUTPUT_BUILDINGS"], "b", "ogr").getFeatures()]
    assert notes[0] == "" and "ended on 2019-01-01, before the flight of 2020-05-02" in notes[1]
    assert "dated 2021-03-01, after the flight" in notes[2]
    assert "1 of 3 outlines are dated after it" in "".join(run.feedback.infos)


# Points

def test_points_elsewhere(refuse, cloud):
    assert "do not overlap" in refuse("segmentbuildings", POINTS=[cloud(lambda array: array + np.full(3, 5000.0))])


@pytest.mark.parametrize("share", [0.01, 0.5, 0.95])
@pytest.mark.parametrize("suffix", ["laz", "las"])
def test_truncated_points(refuse, cloud, tmp_path, share, suffix):
    whole = (tmp_path / cloud(name=f"whole.{suffix}")).read_bytes()
    cut = tmp_path / f"cut.{suffix}"
    cut.write_bytes(whole[:int(share * len(whole))])
    assert "cut." in refuse("segmentbuildings", POINTS=[str(cut)])


def test_second_file_truncated_in_the_chain(refuse, good, cloud, tmp_path):
    whole = (tmp_path / cloud(name="whole.laz")).read_bytes()
    (tmp_path / "cut.laz").write_bytes(whole[:len(whole) // 2])
    assert "cut.laz" in refuse("buildingsfromals", POINTS=[good["cloud"], str(tmp_path / "cut.laz")])


@pytest.mark.parametrize("name", ["empty.las", "empty.laz"])
def test_no_points_in_the_file(refuse, make_cloud, tmp_path, name):
    empty = make_cloud(tmp_path / name, [], [], [])
    assert "holds no points" in refuse("segmentbuildings", POINTS=[str(empty)])


@pytest.mark.parametrize(("name", "content"), [
    ("text.laz", b"x y z\n1 2 3\n"), ("nothing.laz", b""), ("text.las", b"LASF and then nothing"),
    ("noise.laz", bytes(range(256)) * 40)])
def test_other_content_under_the_name_of_points(refuse, tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    assert name in refuse("segmentbuildings", POINTS=[str(tmp_path / name)])


@pytest.mark.parametrize(("given", "words"), [
    ("missing.laz", "does not exist"), ("points.xyz", "no LAS, LAZ or COPC file"), ("", "is a folder"),
    (None, "")])
def test_points_that_are_no_point_file(refuse, tmp_path, given, words):
    (tmp_path / "points.xyz").write_text("1 2 3")
    assert words in refuse("segmentbuildings", POINTS=[str(tmp_path / given)] if given is not None else None)


def rewrite_header(path, **values):
    """The same file with other scales and offsets in its header (doubles at 131 and 155)."""
    data = bytearray(path.read_bytes())
    for name, start in (("scales", 131), ("offsets", 155), ("bounds", 179)):
        if name in values:
            numbers = np.asarray(values[name], "<f8").tobytes()
            data[start:start + len(numbers)] = numbers
    path.write_bytes(data)
    return str(path)


@pytest.mark.parametrize("values", [
    {"scales": [0.001, 0.001, float("nan")]}, {"scales": [float("nan")] * 3},
    {"offsets": [0.0, 0.0, float("nan")]}, {"offsets": [EAST, NORTH, 1e300]}, {"offsets": [EAST, NORTH, 1e7]},
    {"offsets": [float("inf"), NORTH, 0.0]}, {"scales": [1e300, 1e300, 0.001]},
    {"bounds": [float("nan")] * 6}])
@pytest.mark.parametrize("suffix", ["las", "laz"])
@pytest.mark.filterwarnings("error")
def test_coordinates_beyond_reason(refuse, cloud, tmp_path, values, suffix):
    path = rewrite_header(tmp_path / cloud(name=f"odd.{suffix}"), **values)
    refuse("segmentbuildings", POINTS=[path])


@pytest.mark.parametrize(("algorithm", "file", "attribute"), [
    ("segmentroofs", "cloud", "building_id"), ("roofpolygons", "building_points", "roof_id"),
    ("roofpolygons", "cloud", "building_id"), ("buildingmodels", "building_points", "roof_id")])
def test_points_of_an_earlier_stage(refuse, good, algorithm, file, attribute):
    assert f"has no attribute {attribute}" in refuse(algorithm, POINTS=[good[file]])


# Outlines

@pytest.mark.parametrize("algorithm", ["segmentbuildings", "segmentroofs", "roofpolygons", "buildingmodels"])
@pytest.mark.parametrize(("ids", "words"), [
    ([5, 5], "more than once"), (["A", "A"], "more than once"), (["A", " "], "is empty")])
def test_unsuitable_building_ids(refuse, save_outlines, tmp_path, algorithm, ids, words):
    outlines = save_outlines(tmp_path / "o.gpkg", [HOUSE, OTHER], {"building_id": ids})
    assert words in refuse(algorithm, FOOTPRINTS=str(outlines))


def test_building_id_with_an_empty_value(refuse, polygon_layer):
    layer = polygon_layer([HOUSE.wkt, OTHER.wkt], fields={"building_id": [1, None]})
    assert "building_id" in refuse("segmentbuildings", FOOTPRINTS=layer)


@pytest.mark.parametrize(("kind", "wkts"), [
    ("Point", [f"POINT ({EAST} {NORTH})"]), ("LineString", [f"LINESTRING ({EAST} {NORTH}, {EAST + 5} {NORTH})"])])
def test_layer_without_polygons(refuse, polygon_layer, kind, wkts):
    assert "polygon" in refuse("segmentbuildings", FOOTPRINTS=polygon_layer(wkts, kind=kind))


@pytest.mark.parametrize("wkts", [[], [None], ["POLYGON EMPTY"], [f"POLYGON (({EAST} {NORTH}, {EAST} {NORTH + 5}, "
                                                                   f"{EAST} {NORTH}))"]])
def test_no_usable_outline(refuse, polygon_layer, wkts):
    assert "polygon" in refuse("segmentbuildings", FOOTPRINTS=polygon_layer(wkts))


@pytest.mark.parametrize("algorithm", ["segmentbuildings", "buildingsfromals"])
def test_outlines_that_do_not_exist(refuse, tmp_path, algorithm):
    assert "missing.gpkg" in refuse(algorithm, FOOTPRINTS=str(tmp_path / "missing.gpkg"))


def test_each_odd_outline_keeps_its_row(run, good, polygon_layer, tmp_path):
    """Bow-tie, missing, without area, far away: rows with reasons; the sound ones are modelled as ever."""
    e, n = EAST + 30, NORTH
    bow_tie = f"POLYGON (({e} {n}, {e + 10} {n + 15}, {e + 10} {n}, {e} {n + 15}, {e} {n}))"
    sliver = f"POLYGON (({EAST} {NORTH + 40}, {EAST + 5} {NORTH + 40}, {EAST} {NORTH + 40}))"
    layer = polygon_layer([HOUSE.wkt, bow_tie, None, sliver], fields={"name": ["house", "bow tie", "none", "sliver"]})
    files = parameters_of("buildingsfromals", good, tmp_path)
    result = run("urbanmap:buildingsfromals", {**files, "FOOTPRINTS": layer})
    from qgis.core import QgsVectorLayer

    found = {feature["name"]: feature for feature in QgsVectorLayer(result["OUTPUT"], "models", "ogr").getFeatures()}
    assert (result["BUILDINGS"], result["MODELLED"]) == (4, 2)
    assert found["house"]["status"] == "ok"
    assert found["house"]["volume"] == pytest.approx(12 * 15 * 9.3, rel=0.02)
    assert found["bow tie"]["status"] == "ok" and "repaired" in found["bow tie"]["reason"]
    for name in ("none", "sliver"):
        assert found[name]["status"] == "not modelled"
        assert "no polygon" in found[name]["reason"] or "outline" in found[name]["reason"]


def test_outline_of_two_parts_is_one_building_of_two_solids(run, good, polygon_layer, tmp_path):
    from qgis.core import QgsVectorLayer

    from tests.solid_files import read_solids

    layer = polygon_layer([shapely.MultiPolygon([HOUSE, OTHER]).wkt], kind="MultiPolygon")
    result = run("urbanmap:buildingsfromals", {**parameters_of("buildingsfromals", good, tmp_path),
                                               "FOOTPRINTS": layer})
    (row,) = QgsVectorLayer(result["OUTPUT"], "models", "ogr").getFeatures()
    assert row["area"] == pytest.approx(330.0, rel=0.01)
    assert row["volume"] == pytest.approx(180 * 9.3 + 150 * 6.0, rel=0.02)
    (building,) = read_solids(result["OUTPUT_CITYJSON"])
    assert len(building.solids) == 2


def test_town_without_any_building_keeps_its_rows(run, good, points, make_cloud, tmp_path):
    """Nothing but ground: rows with reasons, not a failure that speaks of a temporary file."""
    level = make_cloud(tmp_path / "level.laz", points[:, 0], points[:, 1], np.full(len(points), 3.0))
    result = run("urbanmap:buildingsfromals", {**parameters_of("buildingsfromals", good, tmp_path),
                                               "POINTS": [str(level)]})
    assert (result["BUILDINGS"], result["MODELLED"]) == (2, 0)
    assert result.get("RMSE_Z95") is None


# Fields

def test_roofs_without_height(refuse, good):
    assert "the field roof_id is missing" in refuse("buildingmodels", ROOFS=good["buildings"])


@pytest.mark.parametrize(("field", "values"), [
    ("height", ["high", "low"]), ("height", [5.0, None]), ("building_id", [7, 8])])
def test_unsuitable_roof_fields(refuse, polygon_layer, field, values):
    fields = {"building_id": [1, 2], "roof_id": [1, 1], "height": [12.3, 9.0], field: values}
    assert field in refuse("buildingmodels", ROOFS=polygon_layer([HOUSE.wkt, OTHER.wkt], fields=fields))


@pytest.mark.parametrize("algorithm", ["buildingmodels", "buildingsfromals"])
def test_base_field_of_words(refuse, polygon_layer, algorithm):
    layer = polygon_layer([HOUSE.wkt, OTHER.wkt], fields={"building_id": [1, 2], "name": ["a", "b"]})
    assert "name" in refuse(algorithm, FOOTPRINTS=layer, BASE_FIELD="name")


@pytest.mark.parametrize("algorithm", ["segmentbuildings", "buildingmodels", "buildingsfromals"])
def test_ground_that_is_no_raster(refuse, good, algorithm):
    assert "GROUND" in refuse(algorithm, GROUND=good["outlines"])


def test_bins_further_apart_than_wide(refuse):
    assert "at most the width" in refuse("segmentroofs", BIN_WIDTH=0.1, BIN_SHIFT=5.0)


# Outputs

@pytest.mark.parametrize(("algorithm", "output"), [(key, name) for key, files in OUTPUTS.items() for name in files])
@pytest.mark.parametrize("place", ["missing/{}", "file/{}", "/dev/null/{}"])
def test_output_in_a_place_that_cannot_be_written(refuse, tmp_path, algorithm, output, place):
    (tmp_path / "file").write_bytes(b"a file, no folder")
    target = str(tmp_path / place.format(OUTPUTS[algorithm][output]))
    assert "folder" in refuse(algorithm, **{output: target})


@pytest.mark.parametrize("algorithm", ["segmentbuildings", "segmentroofs"])
def test_output_of_another_kind(refuse, tmp_path, algorithm):
    assert ".laz" in refuse(algorithm, OUTPUT=str(tmp_path / "out.txt"))


# Cancel

@pytest.mark.parametrize("algorithm", OUTPUTS)
@pytest.mark.parametrize("at", [0, 40, 90])
def test_cancel_leaves_earlier_results(run, good, tmp_path, capfd, algorithm, at):
    for file in OUTPUTS[algorithm].values():
        (tmp_path / file).write_bytes(b"an earlier result")
    run.feedback.cancel_at = at
    if at == 0:
        run.feedback.cancel()
    assert run(f"urbanmap:{algorithm}", parameters_of(algorithm, good, tmp_path)) == {}
    assert run.feedback.isCanceled()
    assert {path.name for path in tmp_path.iterdir()} == set(OUTPUTS[algorithm].values())
    assert {path.read_bytes() for path in tmp_path.iterdir()} == {b"an earlier result"}
    assert "readonly database" not in capfd.readouterr().err


def test_files_of_different_precision_go_together(run, good, points, make_cloud, tmp_path):
    """A coarse file without offsets beside a fine one: coordinates of both fit into one file of 32 bit numbers."""
    import laspy

    from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all

    half = len(points) // 2
    far = points + np.array([0.0, 6_800_000.0 - NORTH, 0.0])
    coarse = laspy.LasData(laspy.LasHeader(point_format=6, version="1.4"))
    coarse.header.scales, coarse.header.offsets = [0.01] * 3, [0.0] * 3
    coarse.x, coarse.y, coarse.z = far[:half].T
    coarse.write(tmp_path / "coarse.laz")
    fine = make_cloud(tmp_path / "fine.laz", *far[half:].T, epsg=None)
    layer_file = tmp_path / "o.geojson"
    layer_file.write_text(json.dumps({
        "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::2154"}},
        "features": [{"type": "Feature", "properties": {}, "geometry": shapely.geometry.mapping(
            shapely.affinity.translate(HOUSE, 0.0, 6_800_000.0 - NORTH))}]}))
    result = run("urbanmap:segmentbuildings", {
        **parameters_of("segmentbuildings", good, tmp_path), "FOOTPRINTS": str(layer_file),
        "POINTS": [str(tmp_path / "coarse.laz"), str(fine)]})
    z = read_all(open_cloud([result["OUTPUT"]]), ["z"])["z"]
    assert len(z) == result["POINT_COUNT"] > 400
    assert np.allclose(z, 12.3, atol=0.006)
