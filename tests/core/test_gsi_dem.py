"""Elevation models of the GSI: cells where the specification puts them, gaps, editions, packings, bad files."""

import io
import zipfile

import numpy as np
import pytest
import rasterio
from pyproj import Transformer

from tests.core import gsi_dem_writer as writer
from urbanmap_qgis.errors import InputError
from urbanmap_qgis.io.conversion.reprojection import epsg_wkt, plane_transform
from urbanmap_qgis.io.official.gsi_dem import read_gsi_dem
from urbanmap_qgis.io.official.gsi_dem_raster import dem_bounds, dem_zone, write_dem
from urbanmap_qgis.io.raster import own_gdal, read_raster
from urbanmap_qgis.io.reference.height_systems import heights_of

CODE, EAST_OF_IT, SECOND = "53394611", "53394612", "533946"
ROWS, COLUMNS = 150, 225  # of a 5 m mesh
DEGREES = 0.2 / 3600


def slope(latitude, longitude):
    """A plane in the ground: 1 m in 100 to the east, 1 in 50 to the south."""
    south, west = writer.third_mesh_corner(CODE)
    return 40.0 + 900.0 * (longitude - west) - 2200.0 * (latitude - south)


def five(code=CODE, **options):
    return writer.dem_xml(code, writer.plane_lines(code, ROWS, COLUMNS, slope), ROWS, COLUMNS, **options)


def put(folder, name, text):
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def test_cells_lie_from_the_north_west_row_by_row(tmp_path):
    mesh, = read_gsi_dem(put(tmp_path, "FG-GML-5339-46-11-DEM5A-20161001.xml", five())).meshes
    assert (mesh.code, mesh.product, mesh.date, mesh.system) == (CODE, "5A", "20161001", "JGD2011")
    south, west = writer.third_mesh_corner(CODE)
    assert (mesh.west, mesh.north) == pytest.approx((west, south + 1 / 120), abs=1e-9)
    assert mesh.cell == pytest.approx(DEGREES) and mesh.heights.shape == (ROWS, COLUMNS)
    assert mesh.heights[0, 0] == pytest.approx(slope(mesh.north - DEGREES / 2, west + DEGREES / 2), abs=0.006)
    assert mesh.heights[-1, -1] == pytest.approx(
        slope(south + DEGREES / 2, west + (COLUMNS - 0.5) * DEGREES), abs=0.006)


def test_file_may_begin_late_and_end_early(tmp_path):
    lines = ["地表面,1.00", "地表面,2.00", "地表面,3.00"]
    mesh, = read_gsi_dem(put(tmp_path, "FG-GML-5339-46-11-DEM5B-20200101.xml",
                             writer.dem_xml(CODE, lines, ROWS, COLUMNS, start=(223, 4)))).meshes
    filled = np.argwhere(np.isfinite(mesh.heights)).tolist()
    assert filled == [[4, 223], [4, 224], [5, 0]]
    assert mesh.heights[[4, 4, 5], [223, 224, 0]].tolist() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(("order", "where"), [("+x-y", (0, 1)), ("-x-y", (0, 3)), ("+x+y", (2, 1)), ("-y+x", (1, 0)),
                                              ("+y+x", (1, 0))])
def test_order_of_the_cells_is_that_of_the_file(tmp_path, order, where):
    lines = [f"地表面,{number}.00" for number in range(15)]
    text = writer.dem_xml(CODE, lines, 3, 5, order=order)
    south, west = writer.third_mesh_corner(CODE)
    text = text.replace(f"{south + 1 / 120:.9f} {west + 1 / 80:.9f}",
                        f"{south + 3 * DEGREES:.9f} {west + 5 * DEGREES:.9f}")
    mesh, = read_gsi_dem(put(tmp_path, "FG-GML-5339-46-11-DEM5A-20161001.xml", text)).meshes
    assert mesh.heights[where] == 1.0


@pytest.mark.parametrize("text", ["データなし,-9999.", "データなし,-9999.00", "内水面,-9999.", "海水面,-9999.00",
                                  "その他,-9999", "地表面,-9999.", "データなし,0.00", "表層面,-9999.00", "海水面,"])
def test_every_spelling_of_no_data_is_none(tmp_path, text):
    lines = ["地表面,1.00", text, "内水面,2.50", "地表面,-3.10"]
    mesh, = read_gsi_dem(put(tmp_path, "FG-GML-5339-46-11-DEM5A-20161001.xml",
                             writer.dem_xml(CODE, lines, ROWS, COLUMNS))).meshes
    row = mesh.heights[0, :4]
    assert np.isnan(row[1])
    assert row[[0, 2, 3]].tolist() == pytest.approx([1.0, 2.5, -3.1])


def test_newest_file_of_a_mesh_wins_and_is_told(tmp_path):
    for date, height in (("20161001", 1), ("20240301", 2), ("20190101", 3)):
        put(tmp_path, f"FG-GML-5339-46-11-DEM5A-{date}.xml",
            writer.dem_xml(CODE, [f"地表面,{height}.00"], ROWS, COLUMNS))
    put(tmp_path, "renamed.xml", writer.dem_xml(CODE, ["地表面,9.00"], ROWS, COLUMNS, date="2010-01-01"))
    found = read_gsi_dem(tmp_path)
    assert [mesh.heights[0, 0] for mesh in found.meshes] == [2.0]
    assert any("3 older files" in note for note in found.notes)


def test_zip_of_zips_is_read_and_other_data_passed_over(tmp_path):
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("FG-GML-5339-46-11-DEM5A-20161001.xml", five())
        archive.writestr("../../FG-GML-5339-46-12-DEM5A-20161001.xml", five(EAST_OF_IT))
        archive.writestr("fmdid15-3101.xml", "<MD_Metadata/>")
    with zipfile.ZipFile(tmp_path / "PackDLMap.zip", "w") as archive:
        archive.writestr("FG-GML-5339-46-DEM5A.zip", inner.getvalue())
        archive.writestr("FG-GML-533946-BldA-20230101-0001.xml", "not opened")
    found = read_gsi_dem(tmp_path / "PackDLMap.zip")
    assert sorted(mesh.code for mesh in found.meshes) == [CODE, EAST_OF_IT]
    assert len(found.notes) == 2
    assert sorted(path.name for path in tmp_path.parent.glob("FG-*")) == []


def test_raster_in_the_zone_has_the_ground_at_its_place(tmp_path):
    for code, tag in ((CODE, "11"), (EAST_OF_IT, "12")):
        put(tmp_path, f"FG-GML-5339-46-{tag}-DEM5A-20161001.xml", five(code, srs="fguuid:jgd2024.bl"))
    meshes = read_gsi_dem(tmp_path)
    assert dem_zone(meshes) == 6677
    target = epsg_wkt(6677)
    made = write_dem(tmp_path / "dem.tif", meshes, target, plane_transform(epsg_wkt(6668), target, dem_bounds(meshes)))
    heights, grid, crs = read_raster(tmp_path / "dem.tif")
    assert heights_of(crs).kind == "JGD2024" and grid.cell == 5.0
    assert made.empty == pytest.approx(np.isnan(heights).mean())
    x, y = grid.centres()
    x, y = (places.ravel() for places in np.meshgrid(x, y))
    longitude, latitude = Transformer.from_crs(6677, 6668, always_xy=True).transform(x, y)
    south, west = writer.third_mesh_corner(CODE)
    margin = DEGREES
    inside = ((longitude > west + margin) & (longitude < west + 2 / 80 - margin) & (latitude > south + margin)
              & (latitude < south + 1 / 120 - margin))
    error = heights.ravel()[inside] - slope(latitude[inside], longitude[inside])
    # The seam between the meshes lies inside; heights in the files are rounded to centimetres.
    assert np.isfinite(error).all() and np.abs(error).max() < 0.006
    far = (longitude < west - margin) | (latitude > south + 1 / 120 + margin)
    assert np.isnan(heights.ravel()[far]).all()


def test_raster_in_degrees_holds_the_cells_of_the_file(tmp_path):
    lines = writer.plane_lines(CODE, ROWS, COLUMNS, slope)
    lines[225 * 10 + 7] = "データなし,-9999."
    put(tmp_path, "FG-GML-5339-46-11-DEM5A-20161001.xml", writer.dem_xml(CODE, lines, ROWS, COLUMNS))
    meshes = read_gsi_dem(tmp_path)
    write_dem(tmp_path / "dem.tif", meshes, epsg_wkt(6668), None)
    with own_gdal(), rasterio.open(tmp_path / "dem.tif") as source:
        assert source.shape == (ROWS, COLUMNS)
        south, west = writer.third_mesh_corner(CODE)
        assert source.transform.c == pytest.approx(west, abs=1e-9)
        assert source.transform.f == pytest.approx(south + 1 / 120, abs=1e-9)
        heights = source.read(1, masked=True)
    assert heights.mask.sum() == 1 and heights.mask[10, 7]
    assert np.abs(heights - meshes.meshes[0].heights).max() < 1e-4


@pytest.mark.slow
def test_finer_product_lies_over_the_coarser_which_fills_its_gaps(tmp_path):
    lines = ["地表面,5.00"] * (ROWS * COLUMNS)
    for place in range(225 * 40, 225 * 60):
        lines[place] = "データなし,-9999."
    put(tmp_path, "FG-GML-5339-46-11-DEM5A-20161001.xml", writer.dem_xml(CODE, lines, ROWS, COLUMNS))
    put(tmp_path, "FG-GML-5339-46-dem10b-20161001.xml",
        writer.dem_xml(SECOND, ["地表面,10.00"] * (750 * 1125), 750, 1125, name="10mメッシュ(標高)"))
    meshes = read_gsi_dem(tmp_path)
    target = epsg_wkt(6677)
    transform = plane_transform(epsg_wkt(6668), target, dem_bounds(meshes))
    made = write_dem(tmp_path / "dem.tif", meshes, target, transform, 20)
    assert made.products == ("5A", "10B")
    assert (made.lowest, made.highest) == (5.0, 10.0)
    heights, grid, _ = read_raster(tmp_path / "dem.tif")
    south, west = writer.third_mesh_corner(CODE)
    to_plane = Transformer.from_crs(6668, 6677, always_xy=True)
    for row, height in ((20, 5.0), (50, 10.0), (80, 5.0)):
        x, y = to_plane.transform(west + 1 / 160, south + 1 / 120 - (row + 0.5) * DEGREES)
        there, column, _ = grid.cells([x], [y])
        assert heights[there[0], column[0]] == pytest.approx(height)


def test_mixed_heights_are_refused(tmp_path):
    put(tmp_path, "FG-GML-5339-46-11-DEM5A-20161001.xml", five())
    put(tmp_path, "FG-GML-5339-46-12-DEM5A-20260101.xml", five(EAST_OF_IT, srs="fguuid:jgd2024.bl"))
    with pytest.raises(InputError, match="JGD2011 and others in JGD2024.*separate runs"):
        read_gsi_dem(tmp_path)


GOOD = writer.dem_xml(CODE, ["地表面,1.00"], ROWS, COLUMNS)


@pytest.mark.parametrize(("text", "says"), [
    (GOOD.replace("fguuid:jgd2011.bl", "fguuid:tokyo.bl"), "tokyo.bl is not known"),
    (GOOD[:-30], "not whole, valid XML"),
    (GOOD.replace("地表面,1.00", "地表面,eins"), "a height is no number"),
    (GOOD.replace("地表面,1.00", "地表面 1.00"), "is no kind with a height"),
    (GOOD.replace(f"{COLUMNS - 1} {ROWS - 1}", "224"), "high does not hold two numbers"),
    (GOOD.replace(f"{COLUMNS - 1} {ROWS - 1}", "99999999 99999999"), "cannot be"),
    (GOOD.replace(f"{COLUMNS - 1} {ROWS - 1}", f"{COLUMNS - 1} 74"), "not as high as wide"),
    (GOOD.replace("<gml:startPoint>0 0", "<gml:startPoint>224 149").replace("地表面,1.00", "地表面,1\n地表面,2"),
     "more heights than"),
    (GOOD.replace("<gml:startPoint>0 0", "<gml:startPoint>-1 0"), "more heights than"),
    (GOOD.replace("+x-y", "spiral"), "order .spiral. that is not known"),
    (GOOD.replace("<Dataset", '<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]><Dataset'), "document type"),
    ("<a/>", "no elevation model"),
    ("", "not whole, valid XML"),
    (GOOD.replace("<coverage ", "<other ").replace("</coverage>", "</other>"), "no coverage"),
])
def test_bad_files_are_refused_in_a_sentence(tmp_path, text, says):
    with pytest.raises(InputError, match=says):
        read_gsi_dem(put(tmp_path, "FG-GML-5339-46-11-DEM5A-20161001.xml", text))


def test_places_without_a_transformation_are_refused():
    with pytest.raises(InputError, match="PatchJGD"):
        plane_transform(epsg_wkt(4612), epsg_wkt(6677), (139.7, 35.6, 139.8, 35.7))
    assert plane_transform(epsg_wkt(4612), epsg_wkt(6670), (130.4, 33.5, 130.5, 33.6)).accuracy == 1.0
    with pytest.raises(InputError, match="TKY2JGD"):
        plane_transform(epsg_wkt(4301), epsg_wkt(6677))
    assert plane_transform(epsg_wkt(6668), epsg_wkt(6677)).accuracy == 0.0
    assert plane_transform(epsg_wkt(6677), epsg_wkt(6677)) is None
