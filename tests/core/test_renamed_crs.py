"""Systems under the names that newer databases give them are the ones that older databases know."""

from __future__ import annotations

import laspy
import numpy as np
import pytest
from pyproj import CRS

from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.io.reference.renamed_crs import known_wkt


def renamed(epsg):
    """A system as a database of 2026 writes it: the same code, other names of what is horizontal."""
    wkt = CRS.from_epsg(epsg).to_wkt()
    for old, new in (('"JGD2011"', '"JGD2024"'), ('"JGD2011 /', '"JGD2024 /'), ('"JGD2011 +', '"JGD2024 +'),
                     ('"Japanese Geodetic Datum 2011"', '"Japanese Geodetic Datum 2024"')):
        wkt = wkt.replace(old, new)
    return wkt


@pytest.mark.parametrize("epsg", [6668, 6677, 6691, 6697])
def test_renamed_systems_are_known(epsg):
    wkt = renamed(epsg)
    assert "JGD2024" in wkt
    assert CRS.from_wkt(known_wkt(wkt)).to_epsg() == epsg
    assert known_wkt(known_wkt(wkt)) == known_wkt(wkt)


def test_heights_keep_their_names():
    heights = 'VERTCRS["JGD2024 (vertical) height",VDATUM["Japanese Geodetic Datum 2024 (vertical)"],CS[vertical,1]]'
    assert known_wkt(heights) == heights
    assert known_wkt(CRS.from_epsg(2451).to_wkt()) == CRS.from_epsg(2451).to_wkt()


def test_clouds_under_both_names_are_one(make_cloud, tmp_path):
    axis = np.arange(10.0)
    first = make_cloud(tmp_path / "a.laz", axis, axis, axis)
    second = make_cloud(tmp_path / "b.laz", axis, axis, axis, epsg=None)
    cloud = laspy.read(second)
    cloud.header.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr(renamed(6677)))
    cloud.header.global_encoding.wkt = True
    cloud.write(second)
    assert "JGD2024" in laspy.open(second).header.parse_crs().name
    assert CRS.from_wkt(open_cloud([second]).crs_wkt).to_epsg() == 6677
    assert open_cloud([second, first]).point_count == 20
