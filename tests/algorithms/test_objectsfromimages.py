"""urbanmap:objectsfromimages in QGIS: painted markings drawn on a strip image come back to their places."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.lines.line_camera import project_to_strip
from urbanmap_qgis.mobile.lines.strip_images import read_strips
from urbanmap_qgis.mobile.trajectory_files import read_trajectory


@pytest.fixture(scope="module")
def placed_scans(qgis_app, small_city, tmp_path_factory):
    """The raw scans placed with the true trajectory."""
    import processing

    path = tmp_path_factory.mktemp("scans") / "点群.laz"
    processing.run("urbanmap:georeferencescans", {
        "SCANS": str(small_city / "lines/scans.csv.gz"), "TRAJECTORY": str(small_city / "truth/lines_trajectory.csv"),
        "CALIBRATION": str(small_city / "lines/calibration.json"), "CRS": "EPSG:6677", "OUTPUT": str(path)})
    return path


@pytest.fixture(scope="module")
def drawn(small_city):
    """Markings as a user would draw them on the strip image (column, -row), and their true corners."""
    from qgis.core import QgsVectorLayer

    trajectory = read_trajectory(small_city / "truth/lines_trajectory.csv").trajectory
    strip, = read_strips([small_city / "lines/camera_1.png"], read_calibration(small_city / "lines/calibration.json"))
    layer = QgsVectorLayer(f"{small_city / 'truth/markings.gpkg'}|layername=mms", "markings", "ogr")
    pairs = []
    for feature in layer.getFeatures():
        part = shapely.get_parts(shapely.from_wkb(bytes(feature.geometry().asWkb())))[0]
        corners = shapely.get_coordinates(part.exterior, include_z=True)[:-1]
        if not part.has_z or len(corners) > 40 or part.area < 0.2:
            continue
        found = project_to_strip(corners, strip, trajectory, 20.0)
        if np.array_equal(found.point_index, np.arange(len(corners))) and np.ptp(found.column) < 150:
            pairs.append((shapely.Polygon(np.column_stack([found.column + 0.5, -found.row - 0.5])), corners))
    assert len(pairs) >= 3
    return pairs


def given(small_city, placed_scans, layer, folder, **others):
    return {"POINTS": [str(placed_scans)], "IMAGES": [str(small_city / "lines/camera_1.png")],
            "TRAJECTORY": str(small_city / "truth/lines_trajectory.csv"),
            "CALIBRATION": str(small_city / "lines/calibration.json"), "OUTLINES": layer,
            "OUTPUT": str(folder / "objects.gpkg"), **others}


def test_drawn_markings_lie_where_they_were_painted(run, small_city, placed_scans, drawn, polygon_layer, tmp_path,
                                                    read_layer):
    layer = polygon_layer([pair[0].wkt for pair in drawn], crs="", fields={
        "class": [f"paint {number}" for number in range(len(drawn))]})
    result = run("urbanmap:objectsfromimages", given(small_city, placed_scans, layer, tmp_path))
    features = read_layer(result["OUTPUT"])
    assert len(features) == result["OBJECTS"] == len(drawn)
    assert [item.attributes["class"] for item in features] == [f"paint {number}" for number in range(len(drawn))]
    errors = []
    for item, (_, corners) in zip(features, drawn):
        if item.attributes["status"] == "measured":
            made = shapely.get_coordinates(shapely.from_wkt(item.wkt), include_z=True)[:len(corners)]
            errors.append(np.linalg.norm(made - corners, axis=1).max() / max(item.attributes["sigma"], 0.02))
    assert len(errors) >= 0.6 * len(drawn) and np.median(errors) < 2.0
    assert result["MEASURED"] >= len(errors) and 0 < result["SIGMA"] < 0.3


def test_bad_input_is_one_sentence(run, small_city, placed_scans, polygon_layer, tmp_path):
    from qgis.core import QgsProcessingException

    outside = polygon_layer(["POLYGON((10 10, 20 10, 20 20, 10 10))"], crs="")
    with pytest.raises(QgsProcessingException, match="lies outside camera_1.png"):
        run("urbanmap:objectsfromimages", given(small_city, placed_scans, outside, tmp_path))
    with pytest.raises(QgsProcessingException, match="No image was given"):
        run("urbanmap:objectsfromimages", given(small_city, placed_scans, outside, tmp_path, IMAGES=None))
    empty = polygon_layer([], crs="")
    with pytest.raises(QgsProcessingException, match="No outline was drawn"):
        run("urbanmap:objectsfromimages", given(small_city, placed_scans, empty, tmp_path))
