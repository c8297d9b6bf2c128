"""What line scanners and line cameras make of the sample city stays as it is (see tests/figures.py)."""

from __future__ import annotations

import json

import numpy as np
import pytest
import shapely
from pyproj import CRS

from tests.figures import stays
from urbanmap_qgis.imagery.objects.image_outlines import image_outlines
from urbanmap_qgis.imagery.objects.object_stage import objects_from_outlines
from urbanmap_qgis.imagery.textures.texture_files import write_textured
from urbanmap_qgis.imagery.textures.texture_stage import buildings_of, texture_buildings
from urbanmap_qgis.imagery.views.views import strip_sources
from urbanmap_qgis.io.points.pointcloud import open_cloud
from urbanmap_qgis.io.raster import RasterSampler
from urbanmap_qgis.mobile.calibration import read_calibration
from urbanmap_qgis.mobile.gps_time import time_shift
from urbanmap_qgis.mobile.lines.georeferencing import georeference_scans
from urbanmap_qgis.mobile.lines.rectification import rectify
from urbanmap_qgis.mobile.lines.rectification_report import write_report
from urbanmap_qgis.mobile.lines.reference_corners import outline_corners
from urbanmap_qgis.mobile.lines.tie_point_proposals import propose_tie_points
from urbanmap_qgis.mobile.lines.tie_points import read_tie_points
from urbanmap_qgis.mobile.trajectory_files import read_trajectory
from urbanmap_qgis.settings.lines import METHODS, RectifySettings, ScanSettings, TextureSettings

WKT = CRS.from_epsg(6677).to_wkt()


@pytest.fixture(scope="module")
def models(small_city):
    """The delivered models as faces of blocks."""
    features = json.loads((small_city / "models" / "buildings.geojson").read_text(encoding="utf-8"))["features"]
    return np.array([block(item["geometry"]["coordinates"][0], item["properties"]["z_base"],
                           item["properties"]["z_top"]) for item in features], dtype=object)


def block(ring: list, low: float, high: float) -> shapely.MultiPolygon:
    """Walls and roof of a block."""
    walls = [shapely.Polygon([(*a, low), (*b, low), (*b, high), (*a, high)]) for a, b in zip(ring[:-1], ring[1:])]
    return shapely.MultiPolygon([*walls, shapely.Polygon([(*corner, high) for corner in ring])])


@pytest.fixture(scope="module")
def drive(small_city):
    """The trajectory as reported."""
    return read_trajectory(small_city / "lines" / "trajectory.csv").trajectory


@pytest.fixture(scope="module")
def cloud(small_city, drive, tmp_path_factory):
    """The scans' points placed with the true trajectory."""
    path = tmp_path_factory.mktemp("cloud") / "cloud.laz"
    true = read_trajectory(small_city / "truth" / "lines_trajectory.csv").trajectory
    georeference_scans([small_city / "lines" / "scans.csv.gz"], true,
                       read_calibration(small_city / "lines" / "calibration.json"), path, WKT)
    return path


@pytest.mark.slow
def test_georeferenced_scans_stay(small_city, drive, tmp_path):
    placed = georeference_scans([small_city / "lines" / "scans.csv.gz"], drive,
                                read_calibration(small_city / "lines" / "calibration.json"), tmp_path / "cloud.laz",
                                WKT, ScanSettings(30.0, 1.0))
    stays("lines_scans", {"made": placed, "files": tmp_path})


@pytest.mark.parametrize("method", METHODS)
def test_rectified_trajectory_stays(small_city, drive, tmp_path, method):
    ties = read_tie_points(small_city / "lines" / "tie_points.csv")
    settings = RectifySettings(method=method)
    with RasterSampler(small_city / "truth" / "ground.tif") as ground:
        made = rectify(drive, ties, None if method == "paper" else ground.sample, settings)
    write_report(tmp_path / "report.html", drive, made, ["said"])
    stays(f"lines_rectified_{method}", {"made": made, "figures": made.figures(),
                                        "report": (tmp_path / "report.html").read_text(encoding="utf-8")})


def test_proposed_tie_points_stay(small_city, drive, cloud):
    features = json.loads((small_city / "models" / "buildings.geojson").read_text(encoding="utf-8"))["features"]
    outlines = [shapely.Polygon(item["geometry"]["coordinates"][0]) for item in features]
    survey = open_cloud([cloud])
    made = propose_tie_points(survey, drive, outline_corners(outlines), 60.0, 2.5, 1.5, time_shift(survey, drive))
    stays("lines_tie_points", made)


@pytest.mark.slow
def test_textures_stay(small_city, cloud, models, tmp_path):
    true = read_trajectory(small_city / "truth" / "lines_trajectory.csv").trajectory
    sources = strip_sources(sorted((small_city / "lines").glob("camera_*.png")), true,
                            small_city / "lines" / "calibration.json")
    made = texture_buildings(buildings_of(list(range(len(models))), models), sources, TextureSettings())
    records = write_textured(made, tmp_path / "model.city.json", None, epsg=6677, crs="EPSG:6677")
    stays("textures", {"records": records, "model": tmp_path / "model.city.json",
                       "images": sorted(tmp_path.rglob("*.png"))})


def test_objects_stay(small_city, cloud):
    true = read_trajectory(small_city / "truth" / "lines_trajectory.csv").trajectory
    sources = strip_sources(sorted((small_city / "lines").glob("camera_*.png")), true,
                            small_city / "lines" / "calibration.json")
    drawn = np.array([shapely.box(200.0 + 40 * k, -260.0, 216.0 + 40 * k, -230.0) for k in range(12)], dtype=object)
    outlines = image_outlines(drawn, None, sources)
    stays("objects", objects_from_outlines(outlines, open_cloud([cloud]), 30.0))
