"""What lane maps say to input that they cannot use: it is right all the same, marked, or refused in one sentence."""

from __future__ import annotations

import laspy
import numpy as np
import pyproj
import pytest
import rasterio
import shapely

EAST, NORTH = -7000.0, -34000.0


def bar(x0, x1, y, width=0.15):
    return shapely.box(EAST + x0, NORTH + y - width / 2, EAST + x1, NORTH + y + width / 2)


def paint(length=60):
    """Two lanes each way, dashes between those of one direction, and the colours."""
    bars = [bar(0, length, y) for y in (-6.5, 0.0, 6.5)]
    bars += [bar(x, x + 3, y) for y in (-3.25, 3.25) for x in range(2, length - 2, 8)]
    return bars, ["white", "yellow", "white"] + ["white"] * (len(bars) - 3)


def wkts(shapes):
    return [shape.wkt for shape in shapes]


@pytest.fixture
def markings(polygon_layer):
    """`markings(more, epsg, length)`: the layer, with more bars in white."""

    def make(more=(), epsg=6677, length=60):
        bars, colours = paint(length)
        return polygon_layer(wkts([*bars, *more]), f"EPSG:{epsg}" if epsg else "",
                             {"colour": colours + ["white"] * len(more)})

    return make


@pytest.fixture
def drive(tmp_path):
    """`drive(y, sign, length)`: a trajectory 5 m a step of a second, eastwards with sign 1."""

    def make(y=4.9, sign=1, length=60, times=None):
        t = np.arange(0, length / 5 + 0.1, 0.5) if times is None else np.array(times)
        x = 5 * t if sign > 0 else length - 5 * t
        rows = [f"{a},{EAST + b},{NORTH + y},13.5,0,0,{180 - 90 * sign}" for a, b in zip(t, x)]
        path = tmp_path / f"drive_{y}_{sign}.csv"
        path.write_text("time,x,y,z,roll,pitch,heading\n" + "\n".join(rows) + "\n", encoding="utf-8")
        return str(path)

    return make


@pytest.fixture
def raster(tmp_path):
    """`raster(first, last, height, epsg)`: ground between two places along the road."""

    def make(first=-20, last=80, height=12.0, epsg=6677):
        path = tmp_path / "ground.tif"
        with rasterio.open(path, "w", driver="GTiff", width=2 * (last - first), height=80, count=1, dtype="float32",
                           nodata=float("nan"), crs=f"EPSG:{epsg}",
                           transform=rasterio.Affine(0.5, 0, EAST + first, 0, -0.5, NORTH + 20)) as ground:
            ground.write(np.full((80, 2 * (last - first)), height, np.float32), 1)
        return str(path)

    return make


@pytest.fixture
def cloud(tmp_path):
    """`cloud(places, epsg)`: points without intensity."""

    def make(places, epsg=6677):
        header = laspy.LasHeader(point_format=6, version="1.4")
        header.scales, header.offsets = [0.001] * 3, [EAST, NORTH, 0.0]
        header.add_crs(pyproj.CRS.from_epsg(epsg))
        points = laspy.LasData(header)
        points.x, points.y, points.z = places[:, 0], places[:, 1], np.full(len(places), 12.0)
        points.gps_time = (places[:, 0] - places[:, 0].min()) / 5.0
        path = tmp_path / "points.laz"
        points.write(path)
        return str(path)

    return make


@pytest.fixture
def made(run, read_layer, tmp_path):
    """`made(algorithm, ...)`: the results, and the findings as (kind, text)."""

    def make(algorithm="lanemap", **parameters):
        files = {"OUTPUT_LANES": "lanes.gpkg", "OUTPUT_BOUNDS": "bounds.gpkg", "OUTPUT_FINDINGS": "findings.gpkg",
                 "OUTPUT_LANELET2": "map.osm", "OUTPUT_OPENDRIVE": "map.xodr"}
        results = run(f"urbanmap:{algorithm}", {
            **{name: str(tmp_path / file) for name, file in files.items()}, **parameters})
        return results, [(row.attributes["kind"], row.attributes["text"])
                         for row in read_layer(results["OUTPUT_FINDINGS"])]

    return make


@pytest.fixture
def refused(run, tmp_path):
    """`refused(algorithm, ...)`: the one sentence of a run that must fail; nothing is left behind."""

    def refuse(algorithm="lanemap", **parameters):
        from qgis.core import QgsProcessingException

        folder = tmp_path / "results"
        folder.mkdir()
        with pytest.raises(QgsProcessingException) as caught:
            run(f"urbanmap:{algorithm}", {"OUTPUT_LANES": str(folder / "lanes.gpkg"),
                                          "OUTPUT_BOUNDS": str(folder / "bounds.gpkg"), **parameters})
        sentence = str(caught.value).removeprefix("Unable to execute algorithm").strip()
        assert "\n" not in sentence and "Traceback" not in "".join([sentence, *run.feedback.errors])
        assert not list(folder.iterdir())
        return sentence

    return refuse


# Heights

def test_markings_beyond_the_ground_take_heights_from_along_the_road(made, markings, drive, raster, feedback):
    results, findings = made(MARKINGS=markings(), TRAJECTORY=[drive()], GROUND=raster(-20, 30))
    assert results["LANES"] == 4 and "height filled" in dict(findings)
    assert any("no value at" in text and "of the lines' places" in text for text in feedback.warnings)


@pytest.mark.parametrize("place", [{"first": 5000, "last": 5050}, {"height": np.nan}])
def test_ground_without_a_value_at_any_line_is_refused(refused, markings, raster, place):
    assert "no value at any line" in refused(MARKINGS=markings(), GROUND=raster(**place))


@pytest.mark.parametrize(("heights", "kind"), [((np.nan,) * 3, "no height"), ((12.0, np.nan, 12.0), "height filled")])
def test_lines_with_heights_that_are_no_numbers_are_told(made, polygon_layer, drive, heights, kind):
    from qgis.core import QgsGeometry

    layer = polygon_layer([""] * 3, "EPSG:6677", {"class": ["solid", "dashed", "solid"]}, kind="LineStringZ")
    lines = [shapely.LineString([(EAST, NORTH + y, z), (EAST + 60, NORTH + y, z)])
             for y, z in zip((0.0, 3.25, 6.5), heights)]
    shapes = [QgsGeometry() for _ in lines]
    for shape, line in zip(shapes, lines):  # no WKT tells such heights
        shape.fromWkb(shapely.to_wkb(line, output_dimension=3))
    layer.dataProvider().changeGeometryValues({row + 1: shape for row, shape in enumerate(shapes)})
    results, findings = made("vectormap", LINES=layer, TRAJECTORY=[drive()])
    assert results["LANES"] == 2 and kind in dict(findings)


# Coordinate systems

@pytest.mark.parametrize(("epsg", "words"), [(6676, "reproject one of them"), (6668, "coordinates are degrees"),
                                             (None, "coordinate reference system is missing")])
def test_markings_in_another_system_than_the_ground(refused, markings, raster, epsg, words):
    assert words in refused(MARKINGS=markings(epsg=epsg), GROUND=raster())


@pytest.mark.parametrize("name", ["EDGES", "ROADS"])
def test_edges_and_axes_of_another_system_are_refused(refused, markings, polygon_layer, drive, name):
    lines = polygon_layer([f"LineString ({EAST} {NORTH + 7}, {EAST + 60} {NORTH + 7})"], "EPSG:6676",
                          kind="LineString")
    assert "reproject one of them" in refused(MARKINGS=markings(), TRAJECTORY=[drive()], **{name: lines})


def test_marking_points_of_another_place_are_refused(refused, markings, cloud):
    places = np.random.default_rng(1).uniform((EAST, NORTH), (EAST + 60, NORTH + 0.15), (4000, 2))
    assert "No marking point lies near" in refused(MARKINGS=markings(), POINTS=[cloud(places, 6676)])


# Drives

def test_drives_against_the_traffic_are_told_with_the_side_that_was_given(made, markings, drive):
    given = {"MARKINGS": markings(), "TRAFFIC": "left"}
    both, told = made(**given, TRAJECTORY=[drive(4.9, -1), drive(-4.9, 1)])
    assert both["LANES"] == 2 and any("wrong side of the road" in text for _, text in told)
    _, told = made(**given, TRAJECTORY=[drive(4.9, -1)])
    assert "other direction's side" in dict(told)["direction contradicts"]
    _, told = made(**given, TRAJECTORY=[drive(4.9, 1), drive(-4.9, -1)])
    assert "direction contradicts" not in dict(told)


def test_one_arm_of_a_junction_ends_openly(made, markings, drive):
    stop = shapely.box(EAST + 60.2, NORTH + 0.3, EAST + 60.65, NORTH + 6.2)
    results, findings = made(MARKINGS=markings([stop]), TRAJECTORY=[drive(4.9, 1, 90), drive(-4.9, -1, 90)])
    kinds = [kind for kind, _ in findings]
    assert results["LANES"] == 4 and kinds.count("open end") == 8 and kinds.count("driven without lane") == 2


def test_drive_of_one_epoch_is_refused(refused, markings, drive):
    assert "at least two" in refused(MARKINGS=markings(), TRAJECTORY=[drive(times=[0.0])])


# Layers

def test_nothing_to_work_on_is_told(refused, made, polygon_layer, drive, feedback):
    assert "no polygons to work on" in refused(MARKINGS=polygon_layer([], "EPSG:6677"))
    none = polygon_layer([], "EPSG:6677", {"class": [""]}, kind="LineString")
    results, _ = made("vectormap", LINES=none, TRAJECTORY=[drive()])
    assert results["LANES"] == 0 and any("There are no marking lines" in text for text in feedback.warnings)


def test_one_line_alone_makes_no_lane(made, polygon_layer, drive, feedback):
    results, findings = made(MARKINGS=polygon_layer([bar(0, 60, 0).wkt], "EPSG:6677"), TRAJECTORY=[drive()])
    assert results["LANES"] == 0 and [kind for kind, _ in findings] == ["driven without lane"]
    assert any("No lane was made" in text for text in feedback.warnings)


def test_feature_without_geometry_is_told_and_the_rest_is_right(made, polygon_layer, drive, feedback):
    bars, colours = paint()
    layer = polygon_layer([*wkts(bars), ""], "EPSG:6677", {"colour": [*colours, "white"]})
    results, _ = made(MARKINGS=layer, TRAJECTORY=[drive(), drive(-4.9, -1)])
    assert results["LANES"] == 4 and any("1 of 18 polygons are empty" in text for text in feedback.warnings)


@pytest.mark.parametrize("kind", ["LineString", "Point"])
def test_markings_that_are_no_polygons_are_refused(refused, polygon_layer, kind):
    wkt = {"LineString": f"LineString ({EAST} {NORTH}, {EAST + 60} {NORTH})", "Point": f"Point ({EAST} {NORTH})"}[kind]
    assert "choose a polygon layer" in refused(MARKINGS=polygon_layer([wkt], "EPSG:6677", kind=kind))


def test_lines_and_edges_that_are_points_and_unknown_classes_are_refused(run, polygon_layer, tmp_path):
    points = polygon_layer([f"Point ({EAST} {NORTH})"], "EPSG:6677", {"class": ["solid"]}, kind="Point")
    lines, other = (polygon_layer([f"LineString ({EAST} {NORTH + y}, {EAST + 60} {NORTH + y})" for y in (0.0, 3.25)],
                                  "EPSG:6677", {"class": [word] * 2}, kind="LineString") for word in ("solid", "paint"))
    for given, words in (({"LINES": points}, "choose a line layer"), ({"LINES": other}, "none of the words solid"),
                         ({"LINES": lines, "EDGES": points}, "choose a line layer")):
        with pytest.raises(Exception, match=words):
            run("urbanmap:vectormap", {**given, "OUTPUT_LANES": str(tmp_path / "lanes.gpkg"),
                                       "OUTPUT_BOUNDS": str(tmp_path / "bounds.gpkg")})
    assert not (tmp_path / "lanes.gpkg").exists()


# Surveys and size

def test_survey_without_intensity(run, made, markings, cloud, drive, tmp_path):
    """As a survey it is refused; marking points need none, they are all paint."""
    rng = np.random.default_rng(2)
    with pytest.raises(Exception, match="has no intensity"):
        run("urbanmap:roadmarkingsfrommms", {
            "POINTS": [cloud(rng.uniform((EAST, NORTH - 12), (EAST + 60, NORTH + 12), (20000, 2)))],
            "TRAJECTORY": drive(0.0), "OUTPUT": str(tmp_path / "found.laz")})
    places = rng.uniform((EAST, NORTH + 6.43), (EAST + 60, NORTH + 6.57), (9000, 2))
    results, _ = made(MARKINGS=markings(), POINTS=[cloud(places)], TRAJECTORY=[drive(), drive(-4.9, -1)])
    assert results["LANES"] == 4


@pytest.mark.once
@pytest.mark.slow
def test_ten_kilometres_of_lanes_are_four_lanes(made, markings, drive):
    results, _ = made(MARKINGS=markings(length=2500), TRAJECTORY=[drive(4.9, 1, 2500), drive(-4.9, -1, 2500)])
    assert results["LANES"] == 4 and results["LENGTH"] == pytest.approx(10000.0, rel=0.01)
