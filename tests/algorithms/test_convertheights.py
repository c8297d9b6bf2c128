"""Convert heights through Processing: points, rasters, layers, by grids that lie as GSI's do, and refusals."""

from __future__ import annotations

import laspy
import numpy as np
import pytest
import shapely
from pyproj import CRS, Transformer

ALGORITHM = "urbanmap:convertheights"
EAST, NORTH = -6950.0, -34100.0


def correction(longitude, latitude):
    """A plane of corrections, as of JGD2024 against JGD2011, m."""
    return 0.25 + 0.5 * (longitude - 139.75) - 0.3 * (latitude - 35.69)


@pytest.fixture
def grid(tmp_path):
    """A text grid in the form of the International Service for the Geoid, as GSI writes it, steps of a minute."""
    south, west, step, rows, columns = 35.0, 139.0, 1 / 60, 61, 61
    heights = [" ".join(f"{correction(west + column * step, south + row * step):10.4f}" for column in range(columns))
               for row in reversed(range(rows))]
    head = ("begin_of_head ====\nmodel name : test\nlat min = 35°00'00\"\nlat max = 36°00'00\"\nlon min = 139°00'00\"\n"
            "lon max = 140°00'00\"\ndelta lat = 0°01'00\"\ndelta lon = 0°01'00\"\nnrows = 61\nncols = 61\n"
            "nodata = -9999.0000\nISG format = 2.0\nend_of_head ====\n")
    path = tmp_path / "corrections.isg"
    path.write_text(head + "\n".join(heights) + "\n", encoding="utf-8")
    return path


def expected(x, y):
    return correction(*Transformer.from_crs(6677, 6668, always_xy=True).transform(x, y))


@pytest.fixture
def cloud(tmp_path, plugin):
    """Points with heights in JGD2011, stated as WKT."""
    heights = plugin("urbanmap_qgis.io.reference.height_systems")
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = [0.001] * 3, [EAST, NORTH, 0]
    header.add_crs(CRS.from_wkt(heights.stating_heights(CRS.from_epsg(6677).to_wkt(), heights.japanese("JGD2011"))))
    las = laspy.LasData(header)
    random = np.random.default_rng(3)
    las.x, las.y, las.z = EAST + random.uniform(0, 900, 500), NORTH + random.uniform(0, 900, 500), np.full(500, 30.0)
    las.classification = np.full(500, 6)
    las.write(tmp_path / "points.las")
    return tmp_path / "points.las"


def test_points_get_the_correction_and_state_the_new_system(run, plugin, cloud, grid, tmp_path):
    result = run(ALGORITHM, {"POINTS": [str(cloud)], "GRID": str(grid), "TARGET_HEIGHTS": "JGD2024",
                             "OUTPUT_POINTS": str(tmp_path / "new.laz")})
    las = laspy.read(tmp_path / "new.laz")
    x, y, z = (np.asarray(las[name]) for name in "xyz")
    assert np.abs(z - 30.0 - expected(x, y)).max() < 0.0011
    assert set(las.classification) == {6}
    heights = plugin("urbanmap_qgis.io.reference.height_systems")
    opened = plugin("urbanmap_qgis.io.points.pointcloud").open_cloud([tmp_path / "new.laz"])
    assert heights.heights_of(opened.crs_wkt).kind == "JGD2024"
    assert result["LEAST"] <= result["MEAN"] <= result["LARGEST"] and 0.2 < result["MEAN"] < 0.3
    assert any("500 heights changed" in text for text in run.feedback.infos)
    for said in (True, False):
        back = run(ALGORITHM, {"POINTS": [result["OUTPUT_POINTS"]], "GRID": str(grid), "TARGET_HEIGHTS": "JGD2011",
                               "REVERSE": said, "OUTPUT_POINTS": str(tmp_path / f"old_{said}.laz")})
        assert np.abs(np.asarray(laspy.read(back["OUTPUT_POINTS"]).z) - 30.0).max() < 0.0011
    with pytest.raises(Exception, match="older heights"):
        run(ALGORITHM, {"POINTS": [str(cloud)], "GRID": str(grid), "TARGET_HEIGHTS": "JGD2024", "REVERSE": True,
                        "OUTPUT_POINTS": str(tmp_path / "wrong.laz")})


def test_older_point_formats_state_the_system_too(run, plugin, make_las_1_2, grid, tmp_path):
    run(ALGORITHM, {"POINTS": [str(make_las_1_2)], "SOURCE_HEIGHTS": "JGD2011", "GRID": str(grid),
                    "OUTPUT_POINTS": str(tmp_path / "new.laz")})
    heights = plugin("urbanmap_qgis.io.reference.height_systems")
    opened = plugin("urbanmap_qgis.io.points.pointcloud").open_cloud([tmp_path / "new.laz"])
    assert heights.heights_of(opened.crs_wkt).kind == "JGD2024"


@pytest.fixture
def make_las_1_2(tmp_path):
    """A file as GSI sells them: LAS 1.2, point format 3, its system as GeoTIFF keys, no heights stated."""
    header = laspy.LasHeader(point_format=3, version="1.2")
    header.scales, header.offsets = [0.001] * 3, [EAST, NORTH, 0]
    header.add_crs(CRS.from_epsg(6677))
    las = laspy.LasData(header)
    las.x, las.y, las.z = (np.array([value]) for value in (EAST, NORTH, 30.0))
    las.write(tmp_path / "old_format.las")
    return tmp_path / "old_format.las"


def test_raster_and_layer(run, read_layer, plugin, polygon_layer, grid, tmp_path):
    from urbanmap_qgis.geometry.grid import Grid
    from urbanmap_qgis.io.raster import read_raster, write_raster
    from urbanmap_qgis.io.reference.height_systems import heights_of

    place = Grid(EAST, NORTH + 100, 10.0, 10, 10)
    values = np.full(place.shape, 20.0, np.float32)
    values[0, 0] = np.nan
    write_raster(tmp_path / "dem.tif", values, place, CRS.from_epsg(6677).to_wkt())
    run(ALGORITHM, {"RASTER": str(tmp_path / "dem.tif"), "SOURCE_HEIGHTS": "JGD2011", "GRID": str(grid),
                    "OUTPUT_RASTER": str(tmp_path / "new.tif")})
    made, _, crs = read_raster(tmp_path / "new.tif")
    assert heights_of(crs).kind == "JGD2024" and np.isnan(made[0, 0])
    x, y = np.meshgrid(*place.centres())
    assert np.nanmax(np.abs(made - 20.0 - expected(x, y))) < 1e-4

    run(ALGORITHM, {"RASTER": str(tmp_path / "new.tif"), "TARGET_HEIGHTS": "JGD2011", "GRID": str(grid),
                    "OUTPUT_RASTER": str(tmp_path / "back.tif")})  # its heights are those that the file states
    back, _, crs = read_raster(tmp_path / "back.tif")
    assert heights_of(crs).kind == "JGD2011" and np.nanmax(np.abs(back - values)) < 1e-4

    ring = f"{EAST} {NORTH} 5,{EAST + 9} {NORTH} 5,{EAST + 9} {NORTH + 9} 7,{EAST} {NORTH} 5"
    layer = polygon_layer([f"POLYGONZ(({ring}))"], "EPSG:6677", {"ground": [5.0]})
    result = run(ALGORITHM, {"LAYER": layer, "SOURCE_HEIGHTS": "ellipsoidal", "TARGET_HEIGHTS": "JGD2011",
                             "CHANGE": 36.5, "OUTPUT_LAYER": str(tmp_path / "new.gpkg")})
    assert result["MEAN"] == -36.5
    item, = read_layer(result["OUTPUT_LAYER"])
    corners = shapely.get_coordinates(shapely.from_wkb(item.geometry.asWkb().data()), include_z=True)
    assert corners[:, 2].tolist() == [-31.5, -31.5, -29.5, -31.5]
    assert any("ground hold heights of before" in text for text in run.feedback.warnings)


@pytest.mark.parametrize(("given", "says"), [
    ({"TARGET_HEIGHTS": "JGD2011"}, "already"), ({"TARGET_HEIGHTS": "sea"}, "sea is not known"),
    ({"TARGET_HEIGHTS": "ellipsoidal"}, "give a geoid model"),
    ({"SOURCE_HEIGHTS": "JGD2000"}, "say that their heights"),
    ({"GRID": None, "CHANGE": 36.0}, "which is a geoid model"), ({"GRID": None}, "Give a grid, or one value"),
    ({"POINTS": None}, "one of them"), ({"TARGET_HEIGHTS": "unknown"}, "not known"),
])
def test_what_cannot_be_meant_is_refused(run, cloud, grid, tmp_path, given, says):
    from qgis.core import QgsProcessingException

    parameters = {"POINTS": [str(cloud)], "GRID": str(grid), "OUTPUT_POINTS": str(tmp_path / "new.laz"), **given}
    with pytest.raises(QgsProcessingException, match=says):
        run(ALGORITHM, {name: value for name, value in parameters.items() if value is not None})
    assert not (tmp_path / "new.laz").exists()


def test_heights_that_differ_are_refused_with_the_way_out(run, plugin, cloud, grid, tmp_path):
    """Two files of one cloud in different height systems."""
    from qgis.core import QgsProcessingException

    run(ALGORITHM, {"POINTS": [str(cloud)], "GRID": str(grid), "OUTPUT_POINTS": str(tmp_path / "new.laz")})
    with pytest.raises(QgsProcessingException, match="JGD2024.*, but .*JGD2011.*Convert heights"):
        run("urbanmap:surfacefromals", {"POINTS": [str(cloud), str(tmp_path / "new.laz")], "RESOLUTION": 5,
                                        "OUTPUT": str(tmp_path / "dsm.tif"),
                                        "OUTPUT_GROUND": str(tmp_path / "ground.tif")})
