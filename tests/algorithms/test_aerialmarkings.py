"""The chain from frames and ALS to road markings: a flat street seen straight from above."""

from __future__ import annotations

import json

import numpy as np
import pytest

ALGORITHM = "urbanmap:aerialmarkings"
X0, Y0, GROUND, PIXEL, SIDE = -7000.0, -34000.0, 10.0, 0.12, 400
DASHES = 5


@pytest.fixture
def survey(make_cloud, tmp_path):
    """Frames, camera, orientation and points of a street of 48 m with five dashes of 3.6 m."""
    from osgeo import gdal

    rng = np.random.default_rng(0)
    x, y = rng.random((2, 8000)) * 60 - 30
    cloud = make_cloud(tmp_path / "als.laz", X0 + x, Y0 + y, np.full(8000, GROUND))
    rows, poses = np.arange(80, 80 + 50 * DASHES, 50), ["image,x,y,z,omega,phi,kappa"]
    frames = []
    for number, shift in enumerate((0, 20)):
        image = 90 + rng.normal(0, 2, (SIDE, SIDE))
        for row in rows:
            image[row:row + 3, 180 - shift:210 - shift] = 210
        path = tmp_path / f"写真{number}.tif"
        out = gdal.GetDriverByName("GTiff").Create(str(path), SIDE, SIDE, 3, gdal.GDT_Byte)
        for band in (1, 2, 3):
            out.GetRasterBand(band).WriteArray(image.astype(np.uint8))
        out.FlushCache()
        poses.append(f"{path.name},{X0 + shift * PIXEL},{Y0},{GROUND + 120},0,0,0")
        frames.append(str(path))
    (tmp_path / "exterior.csv").write_text("\n".join(poses), encoding="utf-8")
    (tmp_path / "camera.json").write_text(json.dumps({
        "focal_length_mm": 50.0, "pixel_pitch_mm": 0.05, "image_width": SIDE, "image_height": SIDE,
        "principal_point_mm": [0.0, 0.0]}), encoding="utf-8")
    return {"FRAMES": frames, "CAMERA": str(tmp_path / "camera.json"), "EXTERIOR": str(tmp_path / "exterior.csv"),
            "ALS": [str(cloud)]}


def test_markings_lie_where_the_frames_show_them(run, survey, tmp_path):
    from qgis.core import QgsVectorLayer

    result = run(ALGORITHM, {**survey, "OUTPUT": str(tmp_path / "mask.tif"),
                             "OUTPUT_POLYGONS": str(tmp_path / "markings.gpkg"),
                             "OUTPUT_GROUND": str(tmp_path / "ground.tif")})
    layer = QgsVectorLayer(result["OUTPUT_POLYGONS"], "markings", "ogr")
    assert result["COUNT"] == layer.featureCount() == DASHES
    assert (tmp_path / "ground.tif").is_file() and "OUTPUT_ORTHOPHOTO" not in result
    centres = sorted((item.geometry().centroid().asPoint() for item in layer.getFeatures()), key=lambda p: -p.y())
    middle = (SIDE - 1) / 2
    for number, point in enumerate(centres):
        row = 80 + 50 * number + 1
        assert point.x() == pytest.approx(X0 + (194.5 - middle) * PIXEL, abs=0.3 * PIXEL)
        assert point.y() == pytest.approx(Y0 + (middle - row) * PIXEL, abs=0.3 * PIXEL)
    heights = [vertex.z() for item in layer.getFeatures() for vertex in item.geometry().vertices()]
    assert np.allclose(heights, GROUND, atol=0.01)


def test_a_step_that_fails_says_why(run, survey, tmp_path):
    from qgis.core import QgsProcessingException

    (tmp_path / "camera.json").write_text("{}", encoding="utf-8")
    with pytest.raises(QgsProcessingException, match=r"camera\.json"):
        run(ALGORITHM, {**survey, "OUTPUT": str(tmp_path / "mask.tif")})
    assert not (tmp_path / "mask.tif").exists()


def test_report_and_shifts(run, survey, tmp_path):
    """The dashes lie where both frames say; the report tells so and that no roads were given."""
    from qgis.core import QgsVectorLayer

    result = run(ALGORITHM, {**survey, "OUTPUT": str(tmp_path / "mask.tif"),
                             "OUTPUT_REPORT": str(tmp_path / "report.html"),
                             "OUTPUT_SHIFTS": str(tmp_path / "shifts.gpkg")})
    layer = QgsVectorLayer(result["OUTPUT_SHIFTS"], "shifts", "ogr")
    assert layer.featureCount() >= 5 and {row["status"] for row in layer.getFeatures()} == {"agree"}
    assert result["LARGEST_SHIFT"] < 0.03
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "写真0.tif" in page and "No roads were given" in page and "data:image/png" in page


def test_the_angles_unit_is_passed_on(run, survey, tmp_path):
    """A heading of 400 gon, a whole turn, is no angle in degrees, and is taken when said."""
    from qgis.core import QgsProcessingException

    text = (tmp_path / "exterior.csv").read_text(encoding="utf-8").splitlines()
    turned = [text[0], text[1].rsplit(",", 1)[0] + ",0", text[2].rsplit(",", 1)[0] + ",400"]
    (tmp_path / "exterior.csv").write_text("\n".join(turned), encoding="utf-8")
    with pytest.raises(QgsProcessingException, match="gon"):
        run(ALGORITHM, {**survey, "OUTPUT": str(tmp_path / "mask.tif")})
    assert run(ALGORITHM, {**survey, "ANGLE_UNIT": "gon", "OUTPUT": str(tmp_path / "mask.tif")})["COUNT"] == DASHES


def test_paper_runs_whole(run, survey, tmp_path):
    """Each step is asked for the paper's way: the result is that of the steps run one by one."""
    outputs = {"OUTPUT": str(tmp_path / "mask.tif"), "OUTPUT_ORTHOPHOTO": str(tmp_path / "ortho.tif"),
               "OUTPUT_GROUND": str(tmp_path / "ground.tif")}
    result = run(ALGORITHM, {**survey, **outputs, "METHOD": "paper"})
    alone = run("urbanmap:roadmarkingsfromorthophoto", {"INPUT": result["OUTPUT_ORTHOPHOTO"], "METHOD": "paper",
                                                        "OUTPUT": str(tmp_path / "alone.tif")})
    ours = run("urbanmap:roadmarkingsfromorthophoto", {"INPUT": result["OUTPUT_ORTHOPHOTO"],
                                                       "OUTPUT": str(tmp_path / "ours.tif")})
    from osgeo import gdal

    masks = [gdal.Open(made["OUTPUT"]).ReadAsArray() for made in (result, alone, ours)]
    assert (masks[0] == masks[1]).all() and (masks[0] != masks[2]).any()
    assert result["COUNT"] >= DASHES
