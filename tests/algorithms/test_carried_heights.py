"""The height system of the points goes along: outlines, models and files made of them state it; others are refused."""

import json

import laspy
import numpy as np
import pytest
import shapely
from pyproj import CRS

EAST, NORTH = -6950.0, -34100.0
HOUSE = shapely.box(EAST, NORTH, EAST + 12, NORTH + 15)


@pytest.fixture
def stated(plugin):
    """WKT of zone IX with a height system."""
    heights = plugin("urbanmap_qgis.io.reference.height_systems")
    return lambda kind: heights.stating_heights(CRS.from_epsg(6677).to_wkt(), heights.japanese(kind))


@pytest.fixture
def cloud(tmp_path, synthetic, stated):
    """A house and the ground round it; the file states heights in JGD2024."""
    points, classes = synthetic.Scene([synthetic.flat(HOUSE, 12.3)], spacing=0.6).points()[:2]
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = [0.001] * 3, np.floor(points.min(axis=0))
    header.add_crs(CRS.from_wkt(stated("JGD2024")))
    las = laspy.LasData(header)
    las.x, las.y, las.z = points.T
    las.classification = classes
    las.write(tmp_path / "points.las")
    return str(tmp_path / "points.las")


def test_models_state_the_heights_of_the_points(run, plugin, polygon_layer, cloud, tmp_path):
    from qgis.core import QgsVectorLayer

    files = {name: str(tmp_path / name) for name in ("models.gpkg", "surfaces.gpkg", "models.city.json")}
    run("urbanmap:buildingsfromals", {
        "POINTS": [cloud], "FOOTPRINTS": polygon_layer([HOUSE.wkt], "EPSG:6677"), "OUTPUT": files["models.gpkg"],
        "OUTPUT_SURFACES": files["surfaces.gpkg"], "OUTPUT_CITYJSON": files["models.city.json"]})
    crs = plugin("algorithms.framework.layers.crs")
    for name in ("models.gpkg", "surfaces.gpkg"):
        found = QgsVectorLayer(files[name], name, "ogr").crs()
        # Later releases have no code for heights in JGD2024, and take compound systems by their codes alone.
        assert crs.heights(found).kind == ("unknown" if hasattr(found, "verticalCrs") else "JGD2024"), name
        assert crs.horizontal(found).authid() == "EPSG:6677"
    metadata = json.loads((tmp_path / "models.city.json").read_text(encoding="utf-8"))["metadata"]
    assert metadata["referenceSystem"].endswith("/6677") and "JGD2024" in metadata["title"]


def test_ground_in_other_heights_is_refused(run, polygon_layer, cloud, stated, tmp_path):
    from qgis.core import QgsProcessingException

    from urbanmap_qgis.geometry.grid import Grid
    from urbanmap_qgis.io.raster import write_raster

    place = Grid(EAST - 100, NORTH + 100, 10.0, 20, 20)
    write_raster(tmp_path / "ground.tif", np.zeros(place.shape, np.float32), place, stated("JGD2011"))
    with pytest.raises(QgsProcessingException, match="Ground.*JGD2011.*JGD2024.*Convert heights"):
        run("urbanmap:segmentbuildings", {
            "POINTS": [cloud], "FOOTPRINTS": polygon_layer([HOUSE.wkt], "EPSG:6677"),
            "GROUND": str(tmp_path / "ground.tif"), "OUTPUT": str(tmp_path / "o.laz"),
            "OUTPUT_BUILDINGS": str(tmp_path / "b.gpkg")})
