"""Registration of a mobile survey through Processing, on a small sample city with its true markings as reference."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

ALGORITHM = "urbanmap:registermms"


@pytest.fixture(scope="module")
def markings(qgis_app, small_city, tmp_path_factory):
    """Marking points of the first survey."""
    import processing

    path = str(tmp_path_factory.mktemp("markings") / "路面標示.laz")
    return processing.run("urbanmap:roadmarkingsfrommms", given(small_city, POINTS=[survey(small_city)], OUTPUT=path,
                                                                CALIBRATION=str(small_city / "mms/calibration.json"),
                                                                OUTPUT_CURVE=None))["OUTPUT"]


def survey(city):
    return str(city / "mms/survey_01.laz")


def reference(city):
    return f"{city / 'truth/markings.gpkg'}|layername=aerial"


def given(city, **more):
    return {"TRAJECTORY": str(city / "mms/survey_01_trajectory.csv"), **more}


def columns(path, names):
    with open(path, encoding="utf-8") as file:
        return np.array([[float(row[name]) for name in names] for row in csv.DictReader(file)])


def test_trajectory_patches_and_report(run, small_city, markings, read_layer, tmp_path):
    result = run(ALGORITHM, given(
        small_city, POINTS=[markings], MARKINGS=reference(small_city), GROUND=str(small_city / "truth/ground.tif"),
        OUTPUT=str(tmp_path / "新.csv"), OUTPUT_PATCHES=str(tmp_path / "patches.gpkg"),
        OUTPUT_REPORT=str(tmp_path / "report.html")))
    names = ("x", "y", "z")
    true, got = (columns(path, names) for path in (small_city / "truth/survey_01_trajectory.csv", result["OUTPUT"]))
    reported = columns(small_city / "mms/survey_01_trajectory.csv", names)
    assert np.linalg.norm(reported - true, axis=1).mean() > 0.5
    assert np.linalg.norm(got - true, axis=1).mean() < 0.06
    assert result["REGISTERED_SHARE"] > 0.7 and result["MEDIAN_SIGMA"] < 0.05
    assert result["REGISTERED_SHARE"] + result["BRIDGED_SHARE"] + result["DISTRUSTED_SHARE"] == pytest.approx(1.0)
    rows = read_layer(result["OUTPUT_PATCHES"])
    assert len(rows) == pytest.approx(result["WAY"] / 0.5, abs=1)
    assert {row.attributes["status"] for row in rows} <= {"registered", "bridged", "not to be trusted"}
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "of the path is registered" in text and text.count("data:image/png") >= 3
    middle, largest = result["MEDIAN_SIGMA"], result["MAX_SIGMA"]  # one figure in verdict, table, log and results
    assert f"over the whole path is {100 * middle:.1f} cm (median)" in text
    assert f"median and maximum (m)</th><td>{middle:.3f}, {largest:.3f}</td>" in text
    assert f"over the whole path {100 * middle:.1f} cm (median)" in " ".join(run.feedback.infos)
    assert np.median([row.attributes["sigma"] for row in rows]) == pytest.approx(middle)

    from qgis.core import QgsVectorLayer

    layer = QgsVectorLayer(result["OUTPUT_PATCHES"], "patches", "ogr")
    assert layer.crs().authid() == "EPSG:6677" and layer.renderer().type() == "RuleRenderer"


def test_without_heights_only_the_plan_changes(run, small_city, markings, tmp_path):
    import processing

    flat = processing.run("native:dropmzvalues", {"INPUT": reference(small_city), "DROP_M_VALUES": True,
                                                  "DROP_Z_VALUES": True, "OUTPUT": str(tmp_path / "flat.gpkg")})
    result = run(ALGORITHM, given(small_city, POINTS=[markings], MARKINGS=flat["OUTPUT"],
                                  OUTPUT=str(tmp_path / "new.csv"), OUTPUT_PATCHES=None, OUTPUT_REPORT=None))
    names = ("z", "roll", "pitch")
    before, after = (columns(path, names) for path in (small_city / "mms/survey_01_trajectory.csv", result["OUTPUT"]))
    assert np.array_equal(before, after)
    true, got = (columns(path, ("x", "y")) for path in (small_city / "truth/survey_01_trajectory.csv",
                                                        result["OUTPUT"]))
    assert np.hypot(*(got - true).T).mean() < 0.06
    assert "OUTPUT_PATCHES" not in result and "OUTPUT_REPORT" not in result


def test_chain_gives_the_survey_itself(run, small_city, read_layer):
    result = run("urbanmap:georeferencemms", given(
        small_city, POINTS=[survey(small_city)], CALIBRATION=str(small_city / "mms/calibration.json"),
        MARKINGS=reference(small_city), GROUND=str(small_city / "truth/ground.tif"),
        IMAGES=str(small_city / "mms/survey_01_images.csv"), OUTPUT="TEMPORARY_OUTPUT",
        OUTPUT_TRAJECTORY="TEMPORARY_OUTPUT", OUTPUT_IMAGES="TEMPORARY_OUTPUT", OUTPUT_PATCHES="TEMPORARY_OUTPUT",
        OUTPUT_REPORT="TEMPORARY_OUTPUT"))
    checked = run("urbanmap:checkaccuracy", given(
        small_city, CONTROL=str(small_city / "truth/control_survey_01.csv"), CORRECTED=result["OUTPUT_TRAJECTORY"],
        OUTPUT="TEMPORARY_OUTPUT"))
    assert checked["MEAN_2D"] < 0.05 and checked["MEAN_3D"] < 0.06
    import laspy

    with laspy.open(survey(small_city)) as before, laspy.open(result["OUTPUT"]) as after:
        assert before.header.point_count == after.header.point_count
    assert all(Path(result[name]).is_file() for name in ("OUTPUT_IMAGES", "OUTPUT_REPORT"))
    assert read_layer(result["OUTPUT_PATCHES"])


@pytest.mark.once
@pytest.mark.parametrize("heights", [False, True])
def test_the_papers_method_moves_each_patch_by_its_window(run, small_city, markings, read_layer, tmp_path, heights):
    # The letter finds heights that are a few centimetres off: cells of a level road are thin.
    true, got = (columns(path, ("z",)) for path in (small_city / "truth/survey_01_trajectory.csv",
                                                    small_city / "mms/survey_01_trajectory.csv"))
    polygons = {"GROUND": lifted(small_city, tmp_path, float((got - true).mean()))} if heights else {}
    reference_file = reference(small_city)
    if not heights:
        import processing

        reference_file = processing.run("native:dropmzvalues", {
            "INPUT": reference_file, "DROP_M_VALUES": True, "DROP_Z_VALUES": True,
            "OUTPUT": str(tmp_path / "flat.gpkg")})["OUTPUT"]
    result = run(ALGORITHM, given(small_city, POINTS=[markings], MARKINGS=reference_file, METHOD="paper", **polygons,
                                  OUTPUT=str(tmp_path / "new.csv"), OUTPUT_PATCHES=str(tmp_path / "patches.gpkg"),
                                  OUTPUT_REPORT=str(tmp_path / "report.html")))
    assert result["BRIDGED_SHARE"] == 0 and 0 <= result["REGISTERED_SHARE"] <= 1
    rows = read_layer(result["OUTPUT_PATCHES"])
    assert {row.attributes["status"] for row in rows} <= {"registered", "not to be trusted"}
    assert all((row.attributes["status"] == "registered") == (not row.attributes["reason"]) for row in rows)
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "between patches there are steps" in text and "Drift, times" not in text
    names = ("z", "roll", "pitch")
    before, after = (columns(path, names) for path in (small_city / "mms/survey_01_trajectory.csv", result["OUTPUT"]))
    assert np.array_equal(before, after) != heights


@pytest.mark.once
@pytest.mark.paper("J 3.2.4, input")
def test_the_papers_method_takes_the_papers_markings_of_a_survey(run, small_city, tmp_path):
    calibration = str(small_city / "mms/calibration.json")
    markings = run("urbanmap:roadmarkingsfrommms", given(
        small_city, POINTS=[survey(small_city)], CALIBRATION=calibration, METHOD="paper",
        OUTPUT=str(tmp_path / "paper.laz"), OUTPUT_CURVE=None))["OUTPUT"]
    places = []
    for points in (markings, survey(small_city)):
        result = run(ALGORITHM, given(small_city, POINTS=[points], CALIBRATION=calibration, METHOD="paper",
                                      MARKINGS=reference(small_city), OUTPUT=str(tmp_path / "new.csv"),
                                      OUTPUT_REPORT=None))
        places.append(columns(result["OUTPUT"], ("x", "y")))
    assert np.allclose(*places, atol=1e-3)


@pytest.mark.parametrize("algorithm", ["georeferencemms", "georeferencemms_model"])
def test_image_poses_that_are_wanted_and_not_given_are_told_before_the_work(run, small_city, tmp_path, algorithm):
    from qgis.core import QgsProcessingException

    calls = {f"applytrajectory:{name}" if algorithm.endswith("model") else name: str(tmp_path / file)
             for name, file in (("OUTPUT", "new.laz"), ("OUTPUT_IMAGES", "images.csv"))}
    trajectory = "registermms:OUTPUT_TRAJECTORY" if algorithm.endswith("model") else "OUTPUT_TRAJECTORY"
    with pytest.raises(QgsProcessingException, match="no image poses are given"):
        run(f"urbanmap:{algorithm}", given(
            small_city, POINTS=[survey(small_city)], CALIBRATION=str(small_city / "mms/calibration.json"),
            MARKINGS=reference(small_city), **calls, **{trajectory: str(tmp_path / "new.csv")}))
    assert not [text for text in run.feedback.infos if "Step" in text or "Running" in text]


@pytest.mark.parametrize(("change", "words"), [
    ({"MARKINGS": "far"}, "reference markings lie .* from the path of the survey"),
    ({"GROUND": "elsewhere"}, "ground elevation lies .* from the path of the survey"),
    ({"GROUND": "ellipsoid"}, "heights above the ellipsoid"),
    ({"TRAJECTORY": "later"}, "give those of one survey"),
    ({"MARKINGS": "other crs"}, "reproject one of them"),
    ({"MARKINGS": "table"}, "neither a raster nor a polygon layer"),
])
@pytest.mark.parametrize("algorithm", [ALGORITHM, "urbanmap:georeferencemms"])
def test_bad_input_in_one_sentence(run, small_city, markings, polygon_layer, feedback, tmp_path, change, words,
                                   algorithm):
    """The chain says so before it works for minutes: no step of it begins."""
    from qgis.core import QgsProcessingException, QgsProject

    summary = json.loads((small_city / "truth/summary.json").read_text(encoding="utf-8"))
    assert summary["crs"] == "EPSG:6677"
    bad = {"far": lambda: polygon_layer(["POLYGON((0 0,9 0,9 9,0 0))"], name="far"),
           "other crs": lambda: polygon_layer(["POLYGON((0 0,9 0,9 9,0 0))"], crs="EPSG:6676", name="other"),
           "table": lambda: str(small_city / "truth/control_survey_01.csv"),
           "later": lambda: later(small_city, tmp_path), "ellipsoid": lambda: lifted(small_city, tmp_path),
           "elsewhere": lambda: lifted(small_city, tmp_path, 0.0, 5000.0)}
    (name, kind), = change.items()
    value = bad[kind]()
    if not isinstance(value, str):
        QgsProject.instance().addMapLayer(value)
    outputs = {"OUTPUT": str(tmp_path / "new.csv")}
    if algorithm != ALGORITHM:
        outputs = {"OUTPUT": str(tmp_path / "new.laz"), "OUTPUT_TRAJECTORY": str(tmp_path / "new.csv")}
    points = [markings] if algorithm == ALGORITHM else [survey(small_city)]
    parameters = given(small_city, POINTS=points, MARKINGS=reference(small_city), **outputs)
    with pytest.raises(QgsProcessingException, match=words):
        run(algorithm, {**parameters, name: value})
    assert not list(tmp_path.glob("new.*")) and not any("Step:" in text for text in feedback.infos)
    if not isinstance(value, str):
        QgsProject.instance().removeMapLayer(value.id())


def later(city, folder):
    """The trajectory of another time of the day."""
    lines = (city / "mms/survey_01_trajectory.csv").read_text().splitlines()
    rows = [line.split(",") for line in lines[1:]]
    moved = [",".join([f"{float(row[0]) + 7000:.2f}", *row[1:]]) for row in rows]
    (folder / "later.csv").write_text("\n".join([lines[0], *moved]))
    return str(folder / "later.csv")


def lifted(city, folder, by=37.0, away=0.0):
    """The ground, by default with heights above an ellipsoid; or `away` m to the east."""
    import rasterio

    with rasterio.open(city / "truth/ground.tif") as source:
        heights, profile = source.read(1), source.profile
    old = profile["transform"]
    profile["transform"] = rasterio.transform.Affine(old.a, old.b, old.c + away, old.d, old.e, old.f)
    with rasterio.open(folder / "lifted.tif", "w", **profile) as target:
        target.write(np.where(heights == profile["nodata"], heights, heights + by).astype(heights.dtype), 1)
    return str(folder / "lifted.tif")


@pytest.mark.parametrize(("kind", "words"), [
    ("orthophoto", "bands and is an image"), ("grey orthophoto", "many different values"),
    ("ground", "many different values"), ("empty mask", "holds no road marking"), ("all marked", "100 % of its cells")])
def test_raster_that_is_no_mask_is_refused(run, small_city, markings, tmp_path, kind, words):
    """An image as the reference moved a survey by metres."""
    import rasterio
    from qgis.core import QgsProcessingException

    with rasterio.open(small_city / "aerial/ortho.tif") as source:
        image, profile = source.read(1), {**source.profile, "count": 1, "photometric": "minisblack"}
    profile = {key: value for key, value in profile.items() if key not in ("interleave", "nodata")}
    values = {"grey orthophoto": image, "empty mask": 0 * image, "all marked": 0 * image + 255}
    path = {"orthophoto": small_city / "aerial/ortho.tif", "ground": small_city / "truth/ground.tif"}.get(kind)
    if path is None:
        path = tmp_path / "given.tif"
        with rasterio.open(path, "w", **{**profile, "compress": "deflate"}) as file:
            file.write(values[kind], 1)
    with pytest.raises(QgsProcessingException, match=words):
        run(ALGORITHM, given(small_city, POINTS=[markings], MARKINGS=str(path), OUTPUT=str(tmp_path / "new.csv")))
    assert not (tmp_path / "new.csv").exists()


def test_survey_of_which_nothing_is_registered_is_no_result(run, small_city, markings, polygon_layer, tmp_path):
    """Blots where the survey is, but not its markings."""
    import shapely
    from qgis.core import QgsProcessingException

    place = columns(small_city / "mms/survey_01_trajectory.csv", ("x", "y"))
    random = np.random.default_rng(3)
    blots = place[random.integers(0, len(place), 25)] + random.uniform(-8, 8, (25, 2))
    layer = polygon_layer([shapely.Point(*blot).buffer(0.3).wkt for blot in blots])
    with pytest.raises(QgsProcessingException, match="could be registered|no reference marking"):
        run(ALGORITHM, given(small_city, POINTS=[markings], MARKINGS=layer, OUTPUT=str(tmp_path / "new.csv")))
    assert not (tmp_path / "new.csv").exists()


def test_walls_are_a_second_witness(run, small_city, markings, read_layer, tmp_path):
    result = run(ALGORITHM, given(
        small_city, POINTS=[markings], SURVEY=[survey(small_city)], MARKINGS=reference(small_city),
        BUILDINGS=str(small_city / "footprints/gsi_buildings.gpkg"), GROUND=str(small_city / "truth/ground.tif"),
        OUTPUT=str(tmp_path / "new.csv"), OUTPUT_PATCHES=str(tmp_path / "patches.gpkg"), OUTPUT_REPORT=None))
    true, got = (columns(path, ("x", "y")) for path in (small_city / "truth/survey_01_trajectory.csv",
                                                        result["OUTPUT"]))
    assert np.hypot(*(got - true).T).mean() < 0.06 and result["REGISTERED_SHARE"] > 0.7
    shares = np.array([[row.attributes[name] for name in ("paint", "walls")]
                       for row in read_layer(result["OUTPUT_PATCHES"])])
    assert shares.sum(axis=1) == pytest.approx(1.0) and (shares[:, 1] > 0).mean() > 0.8
    assert np.median(shares[:, 1]) < 0.5  # rough outlines know less than paint does


def test_walls_of_airborne_points_are_one_too(run, small_city, markings, read_layer, tmp_path):
    result = run(ALGORITHM, given(
        small_city, POINTS=[markings], SURVEY=[survey(small_city)], MARKINGS=reference(small_city),
        ALS=[str(small_city / "als/als.laz")], GROUND=str(small_city / "truth/ground.tif"),
        OUTPUT=str(tmp_path / "new.csv"), OUTPUT_PATCHES=str(tmp_path / "patches.gpkg"), OUTPUT_REPORT=None))
    true, got = (columns(path, ("x", "y")) for path in (small_city / "truth/survey_01_trajectory.csv",
                                                        result["OUTPUT"]))
    assert np.hypot(*(got - true).T).mean() < 0.06 and result["REGISTERED_SHARE"] > 0.7
    walls = np.array([row.attributes["walls"] for row in read_layer(result["OUTPUT_PATCHES"])])
    assert (walls > 0).mean() > 0.5


def test_kerbs_on_the_lines_of_a_map_are_one_too(run, small_city, markings, read_layer, tmp_path):
    result = run(ALGORITHM, given(
        small_city, POINTS=[markings], SURVEY=[survey(small_city)], MARKINGS=reference(small_city),
        ROAD_EDGES=f"{small_city / 'truth/edges.gpkg'}|layername=kerbs",
        GROUND=str(small_city / "truth/ground.tif"), OUTPUT=str(tmp_path / "new.csv"),
        OUTPUT_PATCHES=str(tmp_path / "patches.gpkg"), OUTPUT_REPORT=None))
    true, got = (columns(path, ("x", "y")) for path in (small_city / "truth/survey_01_trajectory.csv",
                                                        result["OUTPUT"]))
    assert np.hypot(*(got - true).T).mean() < 0.06 and result["REGISTERED_SHARE"] > 0.7
    walls = np.array([row.attributes["walls"] for row in read_layer(result["OUTPUT_PATCHES"])])
    assert (walls > 0).mean() > 0.5


@pytest.mark.parametrize("first", ["BUILDINGS", "ALS"])
def test_walls_and_kerbs_are_laid_on_one_thing(run, small_city, markings, tmp_path, first):
    from qgis.core import QgsProcessingException

    sides = {"BUILDINGS": str(small_city / "footprints/gsi_buildings.gpkg"), "ALS": [str(small_city / "als/als.laz")],
             "ROAD_EDGES": f"{small_city / 'truth/edges.gpkg'}|layername=kerbs"}
    both = {name: sides[name] for name in list(sides)[list(sides).index(first):][:2]}
    with pytest.raises(QgsProcessingException, match="give one of both"):
        run(ALGORITHM, given(small_city, POINTS=[markings], MARKINGS=reference(small_city), **both,
                             OUTPUT=str(tmp_path / "new.csv"), OUTPUT_PATCHES=None, OUTPUT_REPORT=None))


@pytest.mark.parametrize(("change", "words"), [
    ({"FEATURES": "walls"}, "walls alone need buildings"),
    ({"FEATURES": "all", "METHOD": "paper"}, "the paper's method knows no walls"),
    ({"FEATURES": "all"}, "shows no facade"),  # the markings alone
])
def test_walls_that_cannot_be_used(run, small_city, markings, tmp_path, change, words):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match=words):
        run(ALGORITHM, given(small_city, POINTS=[markings], MARKINGS=reference(small_city), **change,
                             OUTPUT=str(tmp_path / "new.csv"), OUTPUT_PATCHES=None, OUTPUT_REPORT=None))


def test_where_nothing_disagrees_the_layers_of_it_are_empty(run, small_city, markings, tmp_path):
    from qgis.core import QgsVectorLayer

    result = run(ALGORITHM, given(
        small_city, POINTS=[markings], MARKINGS=reference(small_city), OUTPUT=str(tmp_path / "new.csv"),
        OUTPUT_STEPS=str(tmp_path / "steps.gpkg"), OUTPUT_AREAS=str(tmp_path / "areas.gpkg"), OUTPUT_PATCHES=None,
        OUTPUT_REPORT=None))
    layers = [QgsVectorLayer(result[name], "", "ogr") for name in ("OUTPUT_STEPS", "OUTPUT_AREAS")]
    assert all(layer.isValid() and layer.featureCount() == 0 for layer in layers)
    assert [field.name() for field in layers[1].fields()][1:] == ["begin", "end", "kind", "size", "direction", "sigma"]
