"""An algorithm run over tiles: the same as in one piece, gone on with after an end, honest about what failed."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

SIDE = 60


@pytest.fixture(scope="module")
def town(qgis_app, synthetic, make_cloud, save_outlines, tmp_path_factory):
    """Six plain buildings over tiles of 60 m, some of them across the tiles' edges."""
    folder = tmp_path_factory.mktemp("街区")
    corners = [(x, y) for x in (5.0, 58.0, 125.0) for y in (-20.0, 55.0)]
    heights = [8.0 + 1.5 * number for number in range(len(corners))]
    blocks = [synthetic.flat(synthetic.rectangle(x, y, 14, 12), height) for (x, y), height in zip(corners, heights)]
    points, _ = synthetic.Scene(blocks, noise=0.02).points()
    third = len(points) // 3
    files = [make_cloud(folder / f"点群 {number}.laz", *part.T, number_of_returns=1, return_number=1)
             for number, part in enumerate((points[:third], points[third:]))]
    outlines = save_outlines(folder / "外周.gpkg", [block.outline for block in blocks],
                             {"building_id": [f"家-{number}" for number in range(len(blocks))]})
    return {"files": files, "outlines": outlines, "folder": folder,
            "heights": {f"家-{number}": height for number, height in enumerate(heights)}}


def run_tiles(run, town, folder, **more):
    folder.mkdir(exist_ok=True)
    return run("urbanmap:tiledrun", {
        "ALGORITHM": "buildingsfromals", "POINTS": [str(file) for file in town["files"]],
        "FOOTPRINTS": str(town["outlines"]), "TILE": SIDE, "BUFFER": 30, "SETTINGS": "MIN_ROOF_AREA=20",
        "OUTPUT": str(folder / "tiles.gpkg"), "OUTPUT_FOLDER": str(folder / "run"),
        "OUTPUT_REPORT": str(folder / "report.html"), **more})


def test_buildings_over_tiles_are_those_of_one_run(run, town, read_layer, tmp_path):
    results = run_tiles(run, town, tmp_path)
    run("urbanmap:buildingsfromals", {
        "POINTS": [str(file) for file in town["files"]], "FOOTPRINTS": str(town["outlines"]), "MIN_ROOF_AREA": 20,
        "OUTPUT": str(tmp_path / "whole.gpkg"), "OUTPUT_REPORT": None, "OUTPUT_CITYJSON": None})
    whole = {row.attributes["building_id"]: row for row in read_layer(tmp_path / "whole.gpkg")}
    tiled = {row.attributes["building_id"]: row for row in read_layer(tmp_path / "run" / "merged" / "output.gpkg")}
    assert set(tiled) == set(whole) == set(town["heights"])
    assert len(read_layer(tmp_path / "run" / "merged" / "output.gpkg")) == len(tiled)
    for name, row in tiled.items():
        assert row.attributes["status"] == whole[name].attributes["status"]
        assert row.attributes["volume"] == pytest.approx(whole[name].attributes["volume"], rel=0.01)
    assert results["DONE"] == 6 and results["FAILED"] == 0 and results["KEPT"] == 0
    tiles = read_layer(tmp_path / "tiles.gpkg")
    assert {row.attributes["status"] for row in tiles} <= {"done", "empty"}
    assert all(row.geometry.area() == SIDE * SIDE for row in tiles)
    report = (tmp_path / "report.html").read_text(encoding="utf-8")
    good = sum(row.attributes["status"] == "ok" for row in tiled.values())
    sentence = f"{len(tiled)} buildings: {good} ok, {len(tiled) - good} doubtful, 0 failed."
    assert sentence in report and "tiles are done" in report and sentence in " ".join(run.feedback.infos)


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="this system does not list a process's open files")
def test_no_layer_of_a_tile_stays_open(run, town, tmp_path):
    """Thousands of tiles come to an end neither by open files nor by the memory that QGIS keeps for each."""
    run_tiles(run, town, tmp_path, WORKERS=1)
    assert len(list((tmp_path / "run").rglob("*.gpkg"))) > 6
    gone = " (deleted)"
    still = {str(Path(link).readlink()).removesuffix(gone) for link in Path("/proc/self/fd").iterdir()
             if link.is_symlink()}
    assert not [name for name in still if name.startswith(str(tmp_path / "run"))]


@pytest.mark.once
def test_a_later_run_does_only_what_is_missing(run, town, read_layer, tmp_path):
    first = run_tiles(run, town, tmp_path)
    merged = tmp_path / "run" / "merged" / "output.gpkg"
    before = merged.read_bytes()
    broken = sorted((tmp_path / "run" / "tiles").glob("*/output.gpkg"))[0]
    broken.write_bytes(broken.read_bytes()[:1000])
    again = run_tiles(run, town, tmp_path)
    assert again["KEPT"] == first["TILES"] - 1
    assert again["DONE"] == first["DONE"]
    assert merged.read_bytes() == before
    changed = run_tiles(run, town, tmp_path, SETTINGS="MIN_ROOF_AREA=30")
    assert changed["KEPT"] == 0


@pytest.mark.once
def test_one_failed_tile_does_not_end_the_run(run, town, make_cloud, read_layer, tmp_path):
    cloud = make_cloud(tmp_path / "damaged.laz", *np.random.default_rng(1).uniform(0, 50, (3, 20000)))
    data = bytearray(cloud.read_bytes())
    middle = len(data) // 2
    data[middle:middle + 4000] = bytes(4000)
    cloud.write_bytes(data)
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="4 of 6 tiles failed; all others are in"):
        run_tiles(run, town, tmp_path, POINTS=[*map(str, town["files"]), str(cloud)])
    rows = [row.attributes for row in read_layer(tmp_path / "tiles.gpkg")]
    failed = [row for row in rows if row["status"] == "failed"]
    assert len(failed) == 4 and sum(row["status"] == "done" for row in rows) == 2
    merged = [row.attributes for row in read_layer(tmp_path / "run" / "merged" / "output.gpkg")]
    assert sorted(row["building_id"] for row in merged) == sorted(town["heights"])  # as many rows as outlines
    lost = [row for row in merged if row["status"] == "not modelled"]
    assert lost and all("damaged.laz" in row["reason"] for row in lost)
    assert all("damaged.laz" in row["reason"] for row in failed)
    assert any("failed" in text for text in run.feedback.warnings)
    assert "tiles failed" in (tmp_path / "report.html").read_text(encoding="utf-8")
    repaired = run_tiles(run, town, tmp_path)
    assert (repaired["FAILED"], repaired["KEPT"]) == (0, 2)


@pytest.mark.once
def test_a_try_says_what_all_will_take(run, town, tmp_path):
    results = run_tiles(run, town, tmp_path, ESTIMATE=2)
    assert results["TILES"] == 2
    report = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "estimate from 2 of" in report and "Work of all tiles" in report


@pytest.mark.once
def test_the_ground_over_tiles_is_that_of_one_run(run, town, tmp_path):
    from urbanmap_qgis.io.raster import read_raster

    points = [str(file) for file in town["files"]]
    run("urbanmap:tiledrun", {"ALGORITHM": "surfacefromals", "POINTS": points, "TILE": SIDE, "BUFFER": 30,
                              "SETTINGS": "RESOLUTION=1\nOUTPUT_GROUND=yes\n# a remark", "OUTPUT": "TEMPORARY_OUTPUT",
                              "OUTPUT_FOLDER": str(tmp_path / "run")})
    run("urbanmap:surfacefromals", {"POINTS": points, "RESOLUTION": 1, "OUTPUT": str(tmp_path / "dsm.tif"),
                                    "OUTPUT_GROUND": str(tmp_path / "ground.tif")})
    for tiled, whole in (("output.tif", "dsm.tif"), ("output_ground.tif", "ground.tif")):
        values, grid, _ = read_raster(tmp_path / "run" / "merged" / tiled)
        expected, place, _ = read_raster(tmp_path / whole)
        assert grid == place
        both = np.isfinite(values) & np.isfinite(expected)
        assert both.sum() > 0.98 * np.isfinite(expected).sum()
        assert np.quantile(np.abs(values - expected)[both], 0.99) < 0.05


def test_what_cannot_be_is_said_before_the_run(run, town, tmp_path):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="NAME=VALUE"):
        run_tiles(run, town, tmp_path, SETTINGS="MIN_ROOF=2")
    with pytest.raises(QgsProcessingException, match="outlines"):
        run_tiles(run, town, tmp_path, FOOTPRINTS=None)
    with pytest.raises(QgsProcessingException, match="tile by tile"):
        run_tiles(run, town, tmp_path, SETTINGS="OUTPUT_CITYJSON=yes")


def test_an_area_without_anything_is_said(run, town, make_cloud, tmp_path):
    from qgis.core import QgsProcessingException

    far = make_cloud(tmp_path / "far.laz", *(np.random.default_rng(1).uniform(0, 50, (3, 200)) + 5000))
    with pytest.raises(QgsProcessingException, match="empty"):
        run_tiles(run, town, tmp_path, POINTS=[str(far)])


@pytest.mark.once
def test_records_tell_time_and_outputs(run, town, tmp_path):
    run_tiles(run, town, tmp_path, ESTIMATE=1)
    record, = (json.loads(path.read_text(encoding="utf-8")) for path in Path(tmp_path).glob("run/tiles/*/tile.json"))
    assert record["seconds"] > 0 and record["outputs"]["output.gpkg"] > 0
    assert record["figures"]["BUILDINGS"] >= 1
    assert not list(Path(tmp_path).glob("run/tiles/*/inputs"))


@pytest.mark.once
def test_tiles_on_meshes_carry_their_codes(run, town, read_layer, tmp_path):
    results = run_tiles(run, town, tmp_path, GRID="mesh250m", SETTINGS="MIN_ROOF_AREA=20")
    tiles = read_layer(tmp_path / "tiles.gpkg")
    assert results["FAILED"] == 0 and len(tiles) >= 1
    for row in tiles:  # the origin of system 9 is 36 degrees north, 139 degrees 50 minutes east
        assert row.attributes["tile"][:8] in ("54390606", "53397696")
        assert len(row.attributes["tile"]) == 10
    merged = read_layer(tmp_path / "run" / "merged" / "output.gpkg")
    assert sorted(row.attributes["building_id"] for row in merged) == sorted(town["heights"])


@pytest.mark.once
def test_tiles_on_map_sheets_carry_their_codes(run, town, read_layer, tmp_path):
    run_tiles(run, town, tmp_path, GRID="sheet500")
    assert {row.attributes["tile"] for row in read_layer(tmp_path / "tiles.gpkg")} == {"09JE9090", "09KE0000"}


def test_what_cannot_be_cut_is_named_with_the_reason(run, plugin):
    from qgis.core import QgsApplication, QgsProcessingContext

    tables = plugin("algorithms.framework.tiles.tiled_algorithms")
    known = {item.name() for item in QgsApplication.processingRegistry().providerById("urbanmap").algorithms()}
    assert set(tables.CUTTABLE) | set(tables.WHOLE) <= known and not set(tables.CUTTABLE) & set(tables.WHOLE)
    stage = QgsApplication.processingRegistry().createAlgorithmById("urbanmap:tiledrun")
    for name in ("registermms", "urbanmap:markinglines"):
        accepted, message = stage.checkParameterValues({"ALGORITHM": name}, QgsProcessingContext())
        assert not accepted and "cannot be run over tiles: " in message


def street(path, side=60.0, pixel=0.2):
    """An orthophoto of asphalt with an edge line from end to end and dashes of 3 m."""
    import rasterio
    from pyproj import CRS

    count = round(side / pixel)
    grey = np.random.default_rng(3).normal(80, 3, (count, count))
    for line, gaps in ((int(20.9 / pixel), 1e9), (int(30.1 / pixel), 6.0)):
        for column in range(count):
            if (column * pixel) % gaps < 3.0 or gaps > side:
                grey[line - 1:line + 1, column] = 210
    place = rasterio.Affine(pixel, 0, 0, 0, -pixel, side)
    with rasterio.open(path, "w", driver="GTiff", width=count, height=count, count=1, dtype="uint8", transform=place,
                       crs=CRS.from_epsg(6677).to_wkt()) as file:
        file.write(grey.clip(0, 255).astype(np.uint8), 1)
    return path


@pytest.mark.once
def test_markings_across_tiles_are_there_once_and_whole(run, read_layer, tmp_path):
    from urbanmap_qgis.io.raster import read_raster

    image = street(tmp_path / "street.tif")
    run("urbanmap:roadmarkingsfromorthophoto", {"INPUT": str(image), "OUTPUT": str(tmp_path / "mask.tif"),
                                                "OUTPUT_POLYGONS": str(tmp_path / "whole.gpkg")})
    run("urbanmap:tiledrun", {"ALGORITHM": "roadmarkingsfromorthophoto", "INPUT": str(image), "TILE": 20, "BUFFER": 8,
                              "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_FOLDER": str(tmp_path / "run")})
    whole = read_layer(tmp_path / "whole.gpkg")
    tiled = read_layer(tmp_path / "run" / "merged" / "output_polygons.gpkg")
    assert len(tiled) == len(whole) > 6
    masks = [read_raster(path)[0] for path in (tmp_path / "mask.tif", tmp_path / "run" / "merged" / "output.tif")]
    assert masks[0].any() and np.array_equal(*masks)
    longest = max(tiled, key=lambda row: row.geometry.area())
    assert longest.geometry.boundingBox().width() == pytest.approx(60.0, abs=0.5)
    assert longest.attributes["seam"] == "joined" and not any(row.attributes["seam"] == "cut" for row in tiled)
    assert longest.attributes["area"] == pytest.approx(longest.geometry.area(), rel=0.01)
    total = [sum(row.geometry.area() for row in rows) for rows in (whole, tiled)]
    assert total[1] == pytest.approx(total[0], rel=0.02)


@pytest.mark.once
def test_a_mobile_survey_goes_by_stretches(run, small_city, tmp_path):
    from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all

    survey = {"POINTS": [str(small_city / "mms" / "survey_01.laz")],
              "TRAJECTORY": str(small_city / "mms" / "survey_01_trajectory.csv"),
              "CALIBRATION": str(small_city / "mms" / "calibration.json")}
    results = run("urbanmap:tiledrun", {
        "ALGORITHM": "roadmarkingsfrommms", "POINTS": survey["POINTS"], "TILE": 40, "BUFFER": 15,
        "SETTINGS": "\n".join(f"{name}={survey[name]}" for name in ("TRAJECTORY", "CALIBRATION")),
        "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_FOLDER": str(tmp_path / "run")})
    assert results["DONE"] == 2 and results["FAILED"] == 0
    run("urbanmap:roadmarkingsfrommms", {**survey, "OUTPUT": str(tmp_path / "whole.laz")})
    whole = read_all(open_cloud([tmp_path / "whole.laz"]), ("gps_time",))["gps_time"]
    parts = [read_all(open_cloud([path]), ("gps_time",))["gps_time"]
             for path in sorted(tmp_path.glob("run/tiles/stretch_*/output.laz"))]
    assert len(parts) == 2 and parts[0].max() < parts[1].min()
    both = np.intersect1d(np.concatenate(parts), whole)
    assert len(both) > 0.99 * max(len(whole), sum(map(len, parts)))


def test_stretches_are_no_meshes(run, small_city, tmp_path):
    from qgis.core import QgsProcessingException

    with pytest.raises(QgsProcessingException, match="stretches of the drive"):
        run("urbanmap:tiledrun", {
            "ALGORITHM": "roadmarkingsfrommms", "POINTS": [str(small_city / "mms" / "survey_01.laz")],
            "SETTINGS": f"TRAJECTORY={small_city / 'mms' / 'survey_01_trajectory.csv'}", "GRID": "mesh250m",
            "OUTPUT": "TEMPORARY_OUTPUT", "OUTPUT_FOLDER": str(tmp_path / "run")})


@pytest.mark.once
def test_frames_over_tiles_are_the_mosaic_of_one_run(run, small_city, tmp_path):
    from qgis.core import QgsProcessingException

    from urbanmap_qgis.io.raster import read_raster

    aerial = small_city / "aerial"
    frames = {"FRAMES": [str(path) for path in sorted(aerial.glob("frame_*.tif"))],
              "CAMERA": str(aerial / "camera.json"), "EXTERIOR": str(aerial / "exterior.csv")}
    ground = str(small_city / "truth" / "ground.tif")
    run("urbanmap:orthorectifyframes", {**frames, "GROUND": ground, "RESOLUTION": 1,
                                        "OUTPUT": str(tmp_path / "one.tif")})
    given = {"ALGORITHM": "orthorectifyframes", "TILE": 100, "BUFFER": 20, "OUTPUT": "TEMPORARY_OUTPUT",
             "OUTPUT_FOLDER": str(tmp_path / "run")}
    lines = [f"{name}={';'.join(value) if isinstance(value, list) else value}" for name, value in frames.items()]
    lines.append(f"GROUND={ground}")
    with pytest.raises(QgsProcessingException, match="RESOLUTION"):
        run("urbanmap:tiledrun", {**given, "SETTINGS": "\n".join(lines)})
    results = run("urbanmap:tiledrun", {**given, "SETTINGS": "\n".join([*lines, "RESOLUTION=1"])})
    assert results["FAILED"] == 0 and results["DONE"] >= 4
    one, place, _ = read_raster(tmp_path / "one.tif")
    tiled, where, _ = read_raster(tmp_path / "run" / "merged" / "output.tif")
    assert np.allclose((where.bounds[0], where.bounds[3]), (place.bounds[0], place.bounds[3]))
    rows, columns = min(one.shape[0], tiled.shape[0]), min(one.shape[1], tiled.shape[1])
    assert np.mean(np.abs(one[:rows, :columns] - tiled[:rows, :columns]) > 3) < 0.01


def test_points_and_reports_are_made_by_tile_in_any_language(plugin, monkeypatch):
    """Dialogs show filters of files in the user's language."""
    parameters = plugin("algorithms.framework.declaring.parameters")
    words = {parameters.LAZ_FILTER: "LAZ点群 (*.laz);;LAS点群 (*.las)", parameters.HTML_FILTER: "HTML報告書 (*.html)"}
    monkeypatch.setattr(parameters, "tr", lambda text: words.get(text, text))
    stage = plugin("algorithms.buildings.segmentbuildings").SegmentBuildings().create()
    outputs = plugin("algorithms.framework.tiles.tiled_inputs")._outputs(stage, {})
    assert outputs["OUTPUT"] == "output.laz"
    stage = plugin("algorithms.workflows.buildingsfromals").BuildingsFromAls().create()
    outputs = plugin("algorithms.framework.tiles.tiled_inputs")._outputs(stage, {})
    assert outputs["OUTPUT_REPORT"] == "output_report.html" and "OUTPUT_CITYJSON" not in outputs
