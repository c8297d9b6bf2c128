"""Orthorectification and vehicle filter through Processing."""

from __future__ import annotations

import json

import numpy as np
import pytest

ALGORITHM = "urbanmap:orthorectifyframes"
SIDE = 200


def write_image(path, image, **place):
    import rasterio

    with rasterio.open(path, "w", driver="GTiff", width=image.shape[1], height=image.shape[0], count=3,
                       dtype="uint8", **place) as target:
        target.write(np.moveaxis(image, -1, 0))
    return str(path)


def read(path):
    import rasterio

    with rasterio.open(path) as source:
        return source.read(), source


@pytest.fixture
def block(tmp_path, plugin):
    """Two level frames over a grey plain with a white vehicle in each, at another place."""
    raster, grid = plugin("urbanmap_qgis.io.raster"), plugin("urbanmap_qgis.geometry.grid")
    import rasterio

    crs = rasterio.crs.CRS.from_epsg(6677).to_wkt()
    place = grid.Grid(-8020.0, -33980.0, 0.5, 80, 80)
    raster.write_raster(tmp_path / "地盤.tif", np.full(place.shape, 10.0, np.float32), place, crs)
    images = np.full((2, SIDE, SIDE, 3), 90, np.uint8)
    images[0, 60:80, 130:140], images[1, 120:140, 60:70] = 250, 250
    (tmp_path / "camera.json").write_text(json.dumps({
        "focal_length_mm": 20.0, "pixel_pitch_mm": 0.01, "image_width": SIDE, "image_height": SIDE,
        "principal_point_mm": [0, 0]}))
    (tmp_path / "exterior.csv").write_text("image,x,y,z,omega,phi,kappa\n一.tif,-8000,-34000,210,0,0,0\n"
                                           "b.tif,-8001,-34000,210,0,0,0\n", encoding="utf-8")
    return {"FRAMES": [write_image(tmp_path / "一.tif", images[0]), write_image(tmp_path / "b.tif", images[1])],
            "CAMERA": str(tmp_path / "camera.json"), "EXTERIOR": str(tmp_path / "exterior.csv"),
            "GROUND": str(tmp_path / "地盤.tif"), "RESOLUTION": 0.1, "OUTPUT": str(tmp_path / "正射.tif")}


@pytest.mark.parametrize("method", ["vote", "darkest"])
def test_vehicles_go_where_two_frames_see_the_road(run, block, tmp_path, method):
    result = run(ALGORITHM, {**block, "METHOD": method, "FILTER_VEHICLES": True,
                             "OUTPUT_COUNT": str(tmp_path / "count.tif")})
    image, source = read(result["OUTPUT"])
    count, _ = read(result["OUTPUT_COUNT"])
    assert source.crs.to_epsg() == 6677 and source.nodata == 0
    assert count.max() == 2 and np.abs(image[:, count[0] == 2].astype(int) - 90).max() < 25
    assert result["FRAMES_USED"] == 2 and result["SHARE_SEEN"] == 1.0 and result["HOLE_AREA"] == 0.0


def test_without_the_filter_vehicles_stay(run, block):
    image, _ = read(run(ALGORITHM, {**block, "FILTER_VEHICLES": False})["OUTPUT"])
    assert (image > 200).any()


@pytest.mark.parametrize(("change", "words"), [
    ({"image_width": 300}, "300 x 200"),
    ({"focal_length_mm": "x"}, "focal_length_mm"),
])
def test_a_camera_that_does_not_fit(run, block, tmp_path, change, words):
    camera = json.loads((tmp_path / "camera.json").read_text())
    (tmp_path / "camera.json").write_text(json.dumps({**camera, **change}))
    with pytest.raises(Exception, match=words):
        run(ALGORITHM, block)
    assert not (tmp_path / "正射.tif").exists()


def test_a_frame_without_a_pose(run, block, tmp_path):
    (tmp_path / "exterior.csv").write_text("image,x,y,z,omega,phi,kappa\nb.tif,-8001,-34000,210,0,0,0\n")
    with pytest.raises(Exception, match=r"一\.tif"):
        run(ALGORITHM, block)


def test_surface_in_another_crs(run, block, tmp_path, plugin):
    import rasterio

    raster, grid = plugin("urbanmap_qgis.io.raster"), plugin("urbanmap_qgis.geometry.grid")
    place = grid.Grid(-8020.0, -33980.0, 0.5, 80, 80)
    raster.write_raster(tmp_path / "dsm.tif", np.full(place.shape, 10.0, np.float32), place,
                        rasterio.crs.CRS.from_epsg(6676).to_wkt())
    with pytest.raises(Exception, match="Surface"):
        run(ALGORITHM, {**block, "DSM": str(tmp_path / "dsm.tif")})


def test_vehicles_of_two_orthophotos(run, tmp_path):
    import rasterio

    place = {"crs": "EPSG:6677", "transform": rasterio.transform.from_origin(-8000, -34000, 0.2, 0.2)}
    images = np.full((2, 100, 100, 3), 90, np.uint8)
    images[0, 20:30, 20:40], images[1, 60:70, 60:80] = 250, 10
    paths = [write_image(tmp_path / f"写真{k}.tif", image, **place) for k, image in enumerate(images)]
    result = run("urbanmap:filtervehicles", {"ORTHOPHOTOS": paths, "OUTPUT": str(tmp_path / "out.tif")})
    image, source = read(result["OUTPUT"])
    assert (image == 90).all() and result["SHARE_SEEN"] == 1.0 and source.crs.to_epsg() == 6677
    with pytest.raises(Exception, match="two or more"):
        run("urbanmap:filtervehicles", {"ORTHOPHOTOS": paths[:1], "OUTPUT": str(tmp_path / "one.tif")})


def test_shifts_are_a_layer(run, tmp_path, make_frames_of_dashes):
    """Two frames of the same dashes, one of which says it stood 0.6 m farther east."""
    from qgis.core import QgsVectorLayer

    result = run(ALGORITHM, {**make_frames_of_dashes(0.6), "OUTPUT_SHIFTS": str(tmp_path / "shifts.gpkg")})
    layer = QgsVectorLayer(result["OUTPUT_SHIFTS"], "shifts", "ogr")
    rows = list(layer.getFeatures())
    assert len(rows) >= 5 and result["LARGEST_SHIFT"] == pytest.approx(0.6, abs=0.05)
    assert all(abs(row["pair_east"] - 0.6) < 0.05 and abs(row["pair_north"]) < 0.05 for row in rows)
    assert {row["status"] for row in rows} == {"apart"} and {row["first"] for row in rows} == {"a.tif"}
    assert layer.crs().authid() == "EPSG:6677"


def test_frames_that_agree_are_told_so(run, feedback, tmp_path, make_frames_of_dashes):
    from qgis.core import QgsVectorLayer

    result = run(ALGORITHM, {**make_frames_of_dashes(0.0), "OUTPUT_SHIFTS": str(tmp_path / "shifts.gpkg")})
    layer = QgsVectorLayer(result["OUTPUT_SHIFTS"], "shifts", "ogr")
    assert {row["status"] for row in layer.getFeatures()} == {"agree"} and result["LARGEST_SHIFT"] < 0.05


@pytest.fixture
def make_frames_of_dashes(tmp_path, block):
    """Function of the error (m, east) of the second pose: two frames of dashes on the ground of `block`."""
    def make(error):
        camera = json.loads((tmp_path / "camera.json").read_text())
        width, height = camera["image_width"], camera["image_height"]
        pixel = 200.0 * camera["pixel_pitch_mm"] / camera["focal_length_mm"]
        rng = np.random.default_rng(3)
        spots = rng.uniform((-12, -12), (12, 12), (90, 2))
        rows = ["image,x,y,z,omega,phi,kappa"]
        for name, east, stated in (("a.tif", 0.0, 0.0), ("b.tif", 3.0, 3.0 + error)):
            image = np.full((height, width, 3), 70, np.uint8)
            for x, y in spots:
                column, row = round((x - east) / pixel + (width - 1) / 2), round(-y / pixel + (height - 1) / 2)
                image[max(row, 0):max(row + 4, 0), max(column, 0):max(column + 5, 0)] = 210
            write_image(tmp_path / name, image)
            rows.append(f"{name},{-8000 + stated},-34000,210,0,0,0")
        (tmp_path / "exterior.csv").write_text("\n".join(rows), encoding="utf-8")
        return {**block, "FRAMES": [str(tmp_path / "a.tif"), str(tmp_path / "b.tif")]}
    return make


def test_orthophotos_tell_their_shift(run, tmp_path, make_frames_of_dashes):
    """Each frame laid on the ground alone; the second says it stood 0.3 m farther east."""
    from qgis.core import QgsVectorLayer

    given, orthophotos = make_frames_of_dashes(0.3), []
    for number, frame in enumerate(given["FRAMES"]):
        orthophotos.append(str(tmp_path / f"{number}.tif"))
        run(ALGORITHM, {**given, "FRAMES": [frame], "OUTPUT": orthophotos[-1]})
    result = run("urbanmap:filtervehicles", {"ORTHOPHOTOS": orthophotos, "OUTPUT": str(tmp_path / "both.tif"),
                                             "OUTPUT_SHIFTS": str(tmp_path / "shifts.gpkg")})
    assert result["LARGEST_SHIFT"] == pytest.approx(0.3, abs=0.05)
    layer = QgsVectorLayer(result["OUTPUT_SHIFTS"], "shifts", "ogr")
    assert {(row["first"], row["second"], row["status"]) for row in layer.getFeatures()} == {
        ("0.tif", "1.tif", "apart")}


def test_heights_of_outlines_come_from_their_field(run, block, polygon_layer):
    """Two level frames see nothing behind a block of 60 m that the surface lacks; a field of text is refused."""
    ring = "POLYGON ((-8004 -34002, -8001 -34002, -8001 -33998, -8004 -33998, -8004 -34002))"
    plain = run(ALGORITHM, {**block, "FOOTPRINTS": polygon_layer([ring], "EPSG:6677", {"h": [60.0]})})
    high = run(ALGORITHM, {**block, "FOOTPRINTS": polygon_layer([ring], "EPSG:6677", {"h": [60.0]}),
                           "HEIGHT_FIELD": "h"})
    assert high["HOLE_AREA"] > plain["HOLE_AREA"] + 0.5
    with pytest.raises(Exception, match="must hold numbers"):
        run(ALGORITHM, {**block, "FOOTPRINTS": polygon_layer([ring], "EPSG:6677", {"h": ["tall"]}),
                        "HEIGHT_FIELD": "h"})


@pytest.mark.parametrize(("change", "words"), [
    ({"OCCLUSION": "frame"}, r"surface \(DSM\)"),
    ({"METHOD": "paper"}, r"surface \(DSM\)"),
    ({"MASKS": 1}, "1 are given for 2 frames"),
])
def test_maps_that_cannot_be_made_or_do_not_fit(run, block, tmp_path, change, words):
    if "MASKS" in change:
        change = {"MASKS": [write_image(tmp_path / "m.tif", np.zeros((SIDE, SIDE, 3), np.uint8))]}
    with pytest.raises(Exception, match=words):
        run(ALGORITHM, {**block, **change})
    assert not (tmp_path / "正射.tif").exists()


def test_masked_parts_are_taken_from_the_other_frame(run, block, tmp_path):
    """All of the first frame is masked: the vehicle of the second is all that is left."""
    masks = [write_image(tmp_path / f"m{k}.tif", np.full((SIDE, SIDE, 3), 255 * (1 - k), np.uint8)) for k in (0, 1)]
    result = run(ALGORITHM, {**block, "MASKS": masks, "METHOD": "darkest", "OUTPUT_COUNT": str(tmp_path / "c.tif")})
    image, _ = read(result["OUTPUT"])
    count, _ = read(result["OUTPUT_COUNT"])
    assert result["FRAMES_USED"] == 1 and count.max() == 1
    assert (image > 240).sum() == pytest.approx(3 * 20 * 10 * (0.01 * 200 / 20 / 0.1) ** 2, rel=0.3)
