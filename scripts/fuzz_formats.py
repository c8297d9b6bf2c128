"""Every format that the core reads: a sound file of it and the function that reads it: a part of `fuzz.py`."""

from __future__ import annotations

import dataclasses
import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts import fuzz_sound as sound  # noqa: E402

FRAME = 240, 320  # rows, columns


# Readers: what is given back is searched for values that are not finite

def _trajectory(path: Path):
    from pyproj import CRS

    from urbanmap_qgis.mobile.trajectory_files import read_trajectory

    made = read_trajectory(path, CRS.from_epsg(6677).to_wkt())
    return made.trajectory


def _cloud(path: Path):
    from urbanmap_qgis.io.points.pointcloud import open_cloud, read_all

    return read_all(open_cloud([path]), ("x", "y", "z", "intensity"))


def _of(module: str, name: str, listed: bool = False) -> Callable[[Path], object]:
    def read(path: Path):
        function = getattr(__import__(f"urbanmap_qgis.{module}", fromlist=[name]), name)
        return function([path] if listed else path)

    return read


def _scans(path: Path):
    from urbanmap_qgis.mobile.lines.range_scans import read_scans

    return [(part.time, part.angle) for part in read_scans([path])]


def _observations(path: Path):
    from urbanmap_qgis.gnss.rinex.observation_file import read_observations

    found = read_observations(path)
    return found.time, found.code


def _navigation(path: Path):
    from urbanmap_qgis.gnss.orbits.ephemeris import read_navigation

    return read_navigation([path]).spans()


def _times(path: Path):
    from urbanmap_qgis.mobile.lines.strip_images import read_times

    return read_times(path, 400)


def _buildings(path: Path):
    from urbanmap_qgis.io.official.gsi import read_gsi_buildings

    return [geometry.bounds for geometry in read_gsi_buildings(path).geometries]


def _raster(path: Path):
    from urbanmap_qgis.io.raster import read_raster

    return read_raster(path)[1:]


def _sampled(path: Path):
    import numpy as np

    from urbanmap_qgis.io.raster import RasterSampler

    with RasterSampler(path) as source:
        x_min, y_min, x_max, y_max = source.grid.bounds
        source.sample(np.linspace(x_min, x_max, 500), np.linspace(y_min, y_max, 500))
        return source.grid


def _frame(path: Path):
    from types import SimpleNamespace

    from urbanmap_qgis.aerial.frames.frame_images import FrameImage

    with FrameImage(path, SimpleNamespace(width=FRAME[1], height=FRAME[0])) as image:
        image.valid(slice(0, image.height), slice(0, image.width))
        image.read()


def _strip(path: Path):
    from urbanmap_qgis.mobile.calibration import read_calibration
    from urbanmap_qgis.mobile.lines.strip_images import read_columns, read_strips

    strip, = read_strips([path], read_calibration(path.with_name("calibration.json")))
    read_columns(strip)
    return strip.times


def _orthophoto(path: Path):
    from urbanmap_qgis.aerial.orthophotos.vehicle_filter import OrthophotoSource
    from urbanmap_qgis.geometry.grid import Grid

    with OrthophotoSource(path) as source:
        grid = source.grid
        source.view(Grid(grid.x_min, grid.y_max, grid.cell, min(grid.rows, 512), min(grid.columns, 512)))
        return grid


def _city(path: Path):
    from contextlib import ExitStack

    from urbanmap_qgis.citymodel.citygml.reader import ROADS, STREET_THINGS, open_citygml
    from urbanmap_qgis.citymodel.cityjson.reader import open_cityjson
    from urbanmap_qgis.citymodel.reading_notes import ReadingNotes

    with ExitStack() as stack:
        model = (open_citygml(path, stack, ReadingNotes(), more=ROADS | STREET_THINGS) if path.suffix == ".gml"
                 else open_cityjson(path, ReadingNotes()))
        return [building.shapes for building in model.buildings]


def _elevations(path: Path):
    """NaN stands for nodes without a height; infinity for nothing."""
    import numpy as np

    from urbanmap_qgis.io.official.gsi_dem import read_gsi_dem

    return [(mesh.west, mesh.north, mesh.cell, np.where(np.isnan(mesh.heights), 0.0, mesh.heights))
            for mesh in read_gsi_dem(path).meshes]


def _heights(path: Path):
    from urbanmap_qgis.io.conversion.geoid import read_geoid

    made = read_geoid(path)
    return made.south, made.west, made.steps


def _cloud_times(path: Path):
    """Times of a cloud by its samples; then its extended records, which the correction of a survey keeps."""
    from urbanmap_qgis.io.points.pointcloud import open_cloud
    from urbanmap_qgis.mobile.apply_correction import _evlrs
    from urbanmap_qgis.mobile.gps_time import sampled_span

    cloud = open_cloud([path])
    _evlrs(cloud)
    return sampled_span(cloud)


def _lane_map(path: Path):
    from urbanmap_qgis.io.osm import read_osm
    from urbanmap_qgis.roadmap.checks.map_check import check_map

    return [fault.text for fault in check_map(read_osm(path))]


def _rules(path: Path):
    from tests.core.test_map_check import sound_map
    from urbanmap_qgis.roadmap.checks.map_check import check_map

    codes = path.read_bytes().decode("utf-8", errors="replace").split(",")
    return [fault.text for fault in check_map(sound_map(), [code.strip() for code in codes if code.strip()])]


def _city_files(path: Path):
    from contextlib import ExitStack

    from urbanmap_qgis.citymodel.city_sources import open_city_model
    from urbanmap_qgis.citymodel.images import with_images_there
    from urbanmap_qgis.citymodel.reading_notes import ReadingNotes

    with ExitStack() as stack:
        model = open_city_model(path, stack, ReadingNotes())
        model = dataclasses.replace(model, buildings=tuple(model.buildings))
        return [building.shapes for building in with_images_there(model).buildings]


def _tileset(path: Path):
    from urbanmap_qgis.citymodel.tiles.tiles_writer import tiles_folder_trouble

    return tiles_folder_trouble(path.parent)


def _checked(path: Path):
    from urbanmap_qgis.buildings.solids.validity import check_solid
    from urbanmap_qgis.citymodel.checks.city_check import check_city

    return [(fault.rule, fault.text) for fault in check_city(path, check_solid).faults]


def _gml_folder(path: Path):
    from urbanmap_qgis.citymodel.citygml.writer import gml_folder_trouble

    return gml_folder_trouble(path.parent)


def _updated(path: Path):
    from urbanmap_qgis.citymodel.spliced import write_updated

    with tempfile.TemporaryDirectory(prefix="urbanmap-fuzz-") as folder:
        changed = path.parent if path.suffix == ".gml" else path
        write_updated(path, changed, Path(folder) / ("a" if path.suffix == ".gml" else "a.json"), ["none"])


def _tile_record(path: Path):
    from types import SimpleNamespace

    from urbanmap_qgis.tiling.journal import TILES, kept_record

    with tempfile.TemporaryDirectory(prefix="urbanmap-fuzz-") as run:
        place = Path(run) / TILES / "tile"
        place.mkdir(parents=True)
        for file in (path, path.with_name("output.gpkg")):
            shutil.copy(file, place)
        return kept_record(Path(run), SimpleNamespace(name="tile"), "1234")


def _rms(path: Path):
    import numpy as np

    from urbanmap_qgis.mobile.trajectory_accuracy import sigma_of_rms_file

    return np.hstack(sigma_of_rms_file(path, np.arange(500) * 0.1))


def _image_points(path: Path):
    """Without the places of tie points, which have none."""
    from urbanmap_qgis.aerial.orientation.image_points import read_image_points

    found = read_image_points(path)
    return found.pixel, found.place[found.known]


def _cloud_points(path: Path):
    """Without the places of points that were not found in the cloud."""
    import numpy as np

    from urbanmap_qgis.aerial.orientation.cloud_points import read_cloud_points

    found = read_cloud_points(path)
    return found.true, found.found[np.isfinite(found.found).all(axis=1)]


def _check_points(path: Path):
    import csv
    import io

    from urbanmap_qgis.acceptance.check_points import check_points_from_columns
    from urbanmap_qgis.io.files.guard import read_text

    rows = list(csv.DictReader(io.StringIO(read_text(path, "check points (CSV)"))))
    columns = {name: [row[name] for row in rows] for name in (rows[0] if rows else ()) if name is not None}
    return check_points_from_columns(columns, None, "unit", path.name).errors[:, :2]


def _crs_text(path: Path):
    from urbanmap_qgis.io.reference.system_parts import parsed_crs

    return str(parsed_crs(path.read_text(encoding="utf-8", errors="replace")))


def _marked(path: Path):
    """An orthophoto in which markings are looked for, and as a mask upon itself."""
    from urbanmap_qgis.aerial.markings.marking_files import markings_from_orthophoto
    from urbanmap_qgis.aerial.markings.marking_report import frame_count_shares
    from urbanmap_qgis.aerial.markings.orthophoto_reader import SearchArea

    with tempfile.TemporaryDirectory(prefix="urbanmap-fuzz-") as folder:
        markings_from_orthophoto(path, Path(folder) / "mask.tif", SearchArea(mask=path))
    return frame_count_shares(path)


def _orthophoto_image(path: Path):
    from urbanmap_qgis.imagery.views.orthophoto_source import orthophoto_source

    image = orthophoto_source(path)
    columns, rows = image.size()
    image.window(0, 0, min(columns, 512), min(rows, 512))
    return image.grid


def _tiled_raster(path: Path):
    """A raster of which a tile is cut, and tiles of which are put together."""
    from urbanmap_qgis.io.raster import read_raster
    from urbanmap_qgis.tiling.mosaic_tiles import write_tile_raster

    grid = read_raster(path)[1]
    with tempfile.TemporaryDirectory(prefix="urbanmap-fuzz-") as folder:
        write_tile_raster(path, grid.bounds, Path(folder) / "tile.tif")
    return grid


def _recognised(path: Path):
    """What a file is found to be, and whether it is as it was."""
    from urbanmap_qgis.job.job_progress import file_state_of
    from urbanmap_qgis.job.recognition.contents import recognise_file

    return [facts.extent for facts in recognise_file(path)], file_state_of(str(path))


def _imported(path: Path):
    """A table of another program as the import dialog reads it, and the project's own that it becomes."""
    from urbanmap_qgis.job.table_guess import guessed_target, told_order
    from urbanmap_qgis.job.table_import import import_table, split_table

    how = guessed_target(path)
    split_table(path, how, 20)
    told_order(path, how)
    with tempfile.TemporaryDirectory(prefix="urbanmap-fuzz-") as folder:
        return import_table(path, how, Path(folder) / "trajectory.csv")


def _recognised_beside(path: Path):
    return _recognised(path.with_suffix(".shp"))


FORMATS: dict[str, tuple[str, Callable, Callable]] = {
    "LAS": ("a.las", lambda path, city: sound.written_cloud(path, city, 3), _cloud),
    "LAS 1.4": ("a.las", lambda path, city: sound.written_cloud(path, city, 6), _cloud),
    "LAZ": ("a.laz", lambda path, city: sound.written_cloud(path, city, 3), _cloud),
    "LAZ 1.4": ("a.laz", lambda path, city: sound.written_cloud(path, city, 7), _cloud),
    "trajectory CSV": ("a.csv", sound.head("mms/survey_01_trajectory.csv", 200), _trajectory),
    "SBET": ("a.sbet", sound.sbet, _trajectory),
    "image poses": ("a.csv", sound.poses, _of("mobile.image_poses", "read_image_poses")),
    "control points": ("a.csv", sound.copied("truth/control_survey_01.csv"), _of("mobile.control", "read_control")),
    "control points of a Japanese spreadsheet": ("a.csv", sound.japanese_points, _imported),
    "tie points": ("a.csv", sound.copied("lines/tie_points.csv"), _of("mobile.lines.tie_points", "read_tie_points")),
    "times of columns": ("a.csv", sound.head("lines/camera_1_times.csv", 401), _times),
    "range scans CSV": ("a.csv", sound.head("lines/scans.csv.gz", 500), _scans),
    "range scans gz": ("a.csv.gz", sound.head("lines/scans.csv.gz", 500), _scans),
    "calibration": ("a.json", sound.copied("mms/calibration.json"), _of("mobile.calibration", "read_calibration")),
    "camera": ("a.json", sound.copied("aerial/camera.json"), _of("aerial.frames.camera", "read_camera")),
    "exterior orientation": ("a.csv", sound.copied("aerial/exterior.csv"),
                             _of("aerial.frames.exterior_files", "read_exterior")),
    "image points": ("a.csv", sound.image_points, _image_points),
    "laser control points": ("a.csv", sound.written(sound.cloud_points), _cloud_points),
    "CityJSON": ("a.city.json", sound.copied("models/buildings.city.json"),
                 _of("citymodel.cityjson.reader", "read_cityjson")),
    "GSI XML": ("FG-GML-533946-BldA-20240401-0001.xml", sound.gsi, _buildings),
    "GSI zip": ("a.zip", sound.gsi_zip, _buildings),
    "CityGML": ("a.gml", sound.citygml, _city),
    "city model CityJSON": ("a.city.json", sound.copied("models/buildings.city.json"), _city),
    "GSI DEM": ("FG-GML-5339-46-11-DEM5A-20161001.xml", sound.dem, _elevations),
    "geoid grid": ("a.asc", sound.geoid, _heights),
    "RINEX observations": ("a.obs", sound.head("gnss/pass_01.obs", 400), _observations),
    "RINEX navigation": ("a.nav", sound.head("gnss/satellites.nav", 400), _navigation),
    "SP3": ("a.sp3", sound.sp3, _navigation),
    "GeoTIFF": ("a.tif", sound.copied("truth/ground.tif"), _raster),
    "GeoTIFF in parts": ("a.tif", sound.copied("truth/ground.tif"), _sampled),
    "orthophoto": ("a.tif", sound.image("aerial/ortho.tif", 300, 400), _orthophoto),
    "frame TIFF": ("a.tif", sound.image("aerial/frame_01.tif", *FRAME), _frame),
    "frame JPEG": ("a.jpg", sound.image("aerial/frame_01.tif", *FRAME), _frame),
    "strip image": ("camera_1.png", sound.strip_image, _strip),
    "RINEX observations 2": ("a.obs", sound.written(sound.observations_2), _observations),
    "RINEX observations 4": ("a.obs", sound.written(sound.observations_4), _observations),
    "RINEX observations gz": ("a.obs.gz", sound.head("gnss/pass_01.obs", 400), _observations),
    "compact RINEX": ("a.crx", sound.written(sound.compact), _observations),
    "RINEX navigation 2": ("a.nav", sound.written(sound.navigation_2), _navigation),
    "RINEX navigation 4": ("a.nav", sound.written(sound.navigation_4), _navigation),
    "RMS of an SBET": ("smrmsg_a.out", sound.rms, _rms),
    "times of a cloud": ("a.laz", lambda path, city: sound.written_cloud(path, city, 6), _cloud_times),
    "CityGML of PLATEAU": ("a.gml", sound.plateau, _city_files),
    "CityGML zip": ("a.zip", sound.zipped("udx/bldg/a.gml", sound.citygml), _city_files),
    "CityGML of PLATEAU zip": ("a.zip", sound.plateau_zip, _city_files),
    "CityGML in a zip's zip": ("a.zip", sound.zipped("udx/bldg/a.gml", sound.citygml, "b.zip"), _city_files),
    "CityGML, checked": ("a.gml", sound.plateau, _checked),
    "city furniture": ("a.gml", sound.furniture, _city),
    "trees": ("a.gml", sound.trees, _city),
    "city furniture, checked": ("a.gml", sound.furniture, _checked),
    "trees, checked": ("a.gml", sound.trees, _checked),
    "roads of PLATEAU": ("a.gml", sound.roads, _city_files),
    "roads, checked": ("a.gml", sound.roads, _checked),
    "CityGML of a folder": ("a.gml", sound.citygml, _gml_folder),
    "CityGML that is updated": ("a.gml", sound.citygml, _updated),
    "CityJSON that is updated": ("a.city.json", sound.copied("models/buildings.city.json"), _updated),
    "CityJSONSeq": ("a.city.jsonl", sound.sequence, _city_files),
    "textured CityJSON": ("a.city.json", sound.textured, _of("citymodel.cityjson.textured_faces",
                                                             "read_textured_faces")),
    "3D Tiles of a folder": ("tileset.json", sound.city_tiles, _tileset),
    "GSI DEM zip": ("a.zip", sound.zipped("FG-GML-5339-46-11-DEM5A-20161001.xml", sound.dem), _elevations),
    "Lanelet2 map": ("a.osm", sound.lane_map, _lane_map),
    "rules left out": ("a.txt", sound.written(sound.rule_list), _rules),
    "record of a tile": ("tile.json", sound.tile_record, _tile_record),
    "check points": ("a.csv", sound.written(sound.check_points), _check_points),
    "text of a CRS": ("a.wkt", sound.written(sound.crs_text), _crs_text),
    "geoid ISG": ("a.isg", sound.geoid_isg, _heights),
    "geoid GeoTIFF": ("a.tif", sound.geoid_raster, _heights),
    "orthophoto's markings": ("a.tif", sound.image("aerial/ortho.tif", 300, 400), _marked),
    "orthophoto to draw on": ("a.tif", sound.image("aerial/ortho.tif", 300, 400), _orthophoto_image),
    "raster of tiles": ("a.tif", sound.copied("truth/ground.tif"), _tiled_raster),
    "job": ("a.json", sound.job, _of("job.job_file", "read_job")),
    "verdict of a report": ("a.html", sound.report, _of("job.job_progress", "verdict_of")),
    "table to import": ("a.csv", sound.head("mms/survey_01_trajectory.csv", 200), _imported),
    "ways of reading tables": ("a.json", sound.ways_of_reading, _of("job.table_import", "remembered_imports")),
    "KML": ("a.kml", sound.kml, _recognised),
    "KMZ": ("a.kmz", sound.zipped("doc.kml", sound.kml), _recognised),
    "points as text": ("a.xyz", sound.text_points, _recognised),
    "shapefile": ("a.shp", sound.shapefile(".shp"), _recognised),
    "shapefile's table": ("a.dbf", sound.shapefile(".dbf"), _recognised_beside),
    "shapefile's system": ("a.prj", sound.shapefile(".prj"), _recognised_beside),
    "GeoPackage": ("a.gpkg", sound.copied("footprints/gsi_buildings.gpkg"), _recognised),
}
RECOGNISED = ("LAZ", "trajectory CSV", "SBET", "range scans gz", "calibration", "camera", "CityJSON", "CityJSONSeq",
              "GSI XML", "GSI DEM", "CityGML", "CityGML zip", "CityGML in a zip's zip", "Lanelet2 map", "job",
              "check points", "RINEX observations", "RINEX navigation", "compact RINEX", "SP3", "orthophoto",
              "frame JPEG")
"""Formats that are told by their content."""

FORMATS.update({f"{name}, recognised": (*FORMATS[name][:2], _recognised) for name in RECOGNISED})
