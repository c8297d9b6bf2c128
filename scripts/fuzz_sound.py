"""Sound files of every format that the core reads, from a sample city or made here: a part of `fuzz.py`.

Each function has the file's place and the folder of the city, and returns the place.
"""

from __future__ import annotations

import gzip
import shutil
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))


def written_cloud(path: Path, city: Path, point_format: int) -> Path:
    import laspy
    import numpy as np

    with laspy.open(city / "mms/survey_01.laz") as source:
        points = source.read_points(3000)
    header = laspy.LasHeader(point_format=point_format, version="1.4" if point_format > 5 else "1.2")
    header.scales, header.offsets = source.header.scales, source.header.offsets
    header.add_extra_dim(laspy.ExtraBytesParams("building_id", np.uint32))
    las = laspy.LasData(header)
    las.x, las.y, las.z = points.x, points.y, points.z
    las.gps_time, las.intensity = points.gps_time, points.intensity
    las.write(path)
    return path


def copied(place: str) -> Callable[[Path, Path], Path]:
    return lambda path, city: Path(shutil.copy(city / place, path))


def gsi(path: Path, city: Path) -> Path:
    source = next((city / "footprints").glob("FG-GML-*.xml")).read_bytes()
    return Path(shutil.copy(next((city / "footprints").glob("FG-GML-*.xml")), path)) if len(source) < 2**22 else path


def gsi_zip(path: Path, city: Path) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.write(next((city / "footprints").glob("FG-GML-*.xml")), "FG-GML-533946-BldA-20240401-0001.xml")
    return path


def japanese_points(path: Path, _city: Path) -> Path:
    """Points as a Japanese spreadsheet saves them: code page 932, a head, X as the northing."""
    rows = [f"A{k},{-34000.5 - k},{-7000.25 + k},{3 + k},{'検証点' if k % 3 else '標定点'}" for k in range(20)]
    path.write_bytes("\r\n".join(["基準点成果表", "点名,X座標,Y座標,標高,区分", *rows]).encode("cp932"))
    return path


def sbet(path: Path, city: Path) -> Path:
    import numpy as np

    records = np.zeros((500, 17))
    records[:, 0] = np.arange(500) * 0.1
    records[:, 1] = np.radians(35.6) + np.arange(500) * 1e-7
    records[:, 2] = np.radians(139.7)
    records[:, 9] = 0.3
    records.astype("<f8").tofile(path)
    return path


def head(place: str, lines: int) -> Callable[[Path, Path], Path]:
    def make(path: Path, city: Path) -> Path:
        opener = gzip.open if place.endswith(".gz") else open
        with opener(city / place, "rb") as file:
            text = b"".join(file.readline() for _ in range(lines))
        path.write_bytes(gzip.compress(text) if path.suffix == ".gz" else text)
        return path

    return make


def sp3(path: Path, city: Path) -> Path:
    lines = ["#cP2019  4 28  0  0  0.00000000       8 ORBIT IGS14 HLM  IGS", "## 2051      0.00000000   900.00000000 "
             "58601 0.0000000000000", "+    2   G01G02" + "  0" * 15, "++         0  0" + "  0" * 15,
             "%c G  cc GPS ccc cccc cccc cccc cccc ccccc ccccc ccccc ccccc"]
    for epoch in range(12):
        lines.append(f"*  2019  4 28  {epoch // 4}  {15 * (epoch % 4)}  0.00000000")
        lines += [f"PG0{number}{15000 + 100 * epoch:14.6f}{-20000.0:14.6f}{9000.0:14.6f}{12.5:14.6f}"
                  for number in (1, 2)]
    path.write_text("\n".join([*lines, "EOF", ""]))
    return path


def image(place: str, rows: int, columns: int) -> Callable[[Path, Path], Path]:
    """The upper left part of an image of the city with its place, in the format of the path's ending."""

    def make(path: Path, city: Path) -> Path:
        import rasterio

        with rasterio.open(city / place) as source:
            pixels = source.read(window=rasterio.windows.Window(0, 0, columns, rows))
            profile = {"crs": source.crs, "transform": source.transform} if source.crs else {}
        with rasterio.open(path, "w", driver="JPEG" if path.suffix == ".jpg" else "GTiff", count=len(pixels),
                           height=rows, width=columns, dtype=pixels.dtype.name, **profile) as target:
            target.write(pixels)
        return path

    return make


def strip_image(path: Path, city: Path) -> Path:
    """A strip image; calibration and times lie beside it, and where the damaged ones will be."""
    (path.parent / "damaged").mkdir(exist_ok=True)
    for folder in (path.parent, path.parent / "damaged"):
        for name in ("calibration.json", "camera_1_times.csv"):
            shutil.copy(city / "lines" / name, folder)
    return Path(shutil.copy(city / "lines/camera_1.png", path))


def citygml(path: Path, city: Path) -> Path:
    """The city's models as CityGML."""
    from urbanmap_qgis.citymodel.citygml.writer import write_citygml
    from urbanmap_qgis.citymodel.cityjson.reader import open_cityjson
    from urbanmap_qgis.citymodel.reading_notes import ReadingNotes

    folder = path.parent / "gml"
    folder.mkdir()
    write_citygml(folder, open_cityjson(city / "models/buildings.city.json", ReadingNotes()))
    return Path(shutil.copy(next(iter(sorted(folder.rglob("*.gml")))), path))


def dem(path: Path, city: Path) -> Path:
    head = (ROOT / "tests" / "core" / "gsi_dem_writer.py").read_text(encoding="utf-8")
    scope: dict = {}
    exec(compile(head, "gsi_dem_writer", "exec"), scope)
    path.write_text(scope["dem_xml"]("53394611", ["\u5730\u8868\u9762,12.50"] * (150 * 225), 150, 225),
                    encoding="utf-8")
    return path


def geoid(path: Path, city: Path) -> Path:
    """A small grid as GSI writes its geoid."""
    rows = ["36.0 139.0 0.016667 0.025 40 30 1 ver1"]
    rows += [" ".join(f"{36 + 0.01 * (row + column):.4f}" for column in range(30)) for row in range(40)]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def image_points(path: Path, city: Path) -> Path:
    """Points measured in frames: with coordinates, to check, and to tie frames."""
    rows = ["point,image,column,row,x,y,z,role"]
    for number in range(40):
        place = f"{-6950.0 + number},{-34100.0 - number},{30 + 0.1 * number}" if number % 4 else ",,"
        role = "check" if number % 8 == 1 else ""
        rows += [f"P{number},frame_0{frame}.tif,{20 * number + frame},{30 * number},{place},{role}" for frame in (1, 2)]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def cloud_points() -> str:
    """Control points of laser points, half of them found in the cloud."""
    rows = [f"P{number},{number}.5,{2 * number}.25,{number % 7}.125,"
            + (f"{number}.7,{2 * number}.2,{number % 7}.3" if number % 2 else ",,") + ("," if number % 3 else ",check")
            for number in range(1, 40)]
    return "\n".join(["id,x,y,z,x_als,y_als,z_als,role", *rows, ""])


def poses(path: Path, city: Path) -> Path:
    return head("mms/survey_01_images.csv", 60)(path, city)


def written(text: Callable[[], str]) -> Callable[[Path, Path], Path]:
    """A text that a function makes."""

    def make(path: Path, city: Path) -> Path:
        path.write_text(text(), encoding="utf-8")
        return path

    return make


def kml(path: Path, city: Path) -> Path:
    """A building's outline, a path and a place."""
    ring = "139.70,35.60,0 139.7002,35.60,0 139.7002,35.6002,0 139.70,35.6002,0 139.70,35.60,0"
    path.write_text(
        '<?xml version="1.0" encoding="UTF-8"?>\n<kml xmlns="http://www.opengis.net/kml/2.2"><Document>\n'
        "<Placemark><name>house</name><Polygon><outerBoundaryIs><LinearRing><coordinates>"
        f"{ring}</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>\n"
        "<Placemark><LineString><coordinates>139.70,35.60 139.71,35.61</coordinates></LineString></Placemark>\n"
        "<Placemark><Point><coordinates>139.70,35.60</coordinates></Point></Placemark>\n</Document></kml>\n",
        encoding="utf-8")
    return path


def text_points(path: Path, city: Path) -> Path:
    """Points as rows of three numbers and an intensity, without names."""
    import numpy as np

    rng = np.random.default_rng(1)
    rows = np.column_stack((rng.uniform(0, 50, (40, 2)), rng.uniform(10, 20, 40), rng.integers(0, 900, 40)))
    np.savetxt(path, rows, "%.3f %.3f %.3f %d")
    return path


def zipped(name: str, make: Callable[[Path, Path], Path], within: str = "") -> Callable[[Path, Path], Path]:
    """A zip that holds a sound file under a name; `within` : name of a zip in the zip that holds it."""

    def zip_of(path: Path, city: Path) -> Path:
        folder = path.parent / "packed"
        folder.mkdir()
        member = make(folder / Path(name).name, city)
        if within:
            with zipfile.ZipFile(folder / within, "w", zipfile.ZIP_DEFLATED) as inner:
                inner.write(member, name)
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.write(folder / within if within else member, within or name)
        return path

    return zip_of


def rms(path: Path, city: Path) -> Path:
    """An Applanix RMS file of the times of `sbet`."""
    import numpy as np

    records = np.full((500, 10), 0.02)
    records[:, 0] = np.arange(500) * 0.1
    records.astype("<f8").tofile(path)
    return path


def observations_2() -> str:
    """RINEX 2.11 of the tests."""
    from tests.core.test_rinex_observations import epoch_2, field, header_2

    names = [f"G{number:02d}" for number in range(1, 15)]
    return header_2(["C1", "L1", "D1", "S1", "P2", "L2"]) + "".join(
        epoch_2(30.0 * epoch, names, [[field(2.1e7 + 500.0 * epoch + 3.5 * kind, " 5") for kind in range(6)]
                                      for _ in names]) for epoch in range(25))


def observations_4() -> str:
    """RINEX 4 of the tests' columns."""
    from tests.core.test_rinex_observations import epoch_3, field, header_3

    return header_3({"G": ["C1C", "L1C", "S1C"], "E": ["C1X", "S1X"]}, 4.02) + "".join(
        epoch_3(30.0 * epoch, ["G01" + "".join(field(2.0e7 + 731.25 * epoch) for _ in range(3)),
                               "E12" + field(2.4e7 + 300.0 * epoch) + field(41.0)]) for epoch in range(40))


def compact() -> str:
    """Compact RINEX 3, worked by hand, with many epochs."""
    from tests.core.test_rinex_compact import EXAMPLE
    from tests.core.test_rinex_observations import header_3

    return EXAMPLE.format(header=header_3({"G": ["C1C", "L1C", "S1C"]})) + "".join(
        f"                    {epoch % 10}\n\n{epoch} -{epoch} {3 * epoch}\n" for epoch in range(4, 60))


def navigation_2() -> str:
    """Broadcast orbits of RINEX 2.11."""
    from tests.core.test_rinex_navigation import header, kepler

    return header(2.11, "NAVIGATION DATA") + "".join(kepler(f"G{number:02d}", 2) for number in range(1, 13))


def navigation_4() -> str:
    """Broadcast orbits of RINEX 4."""
    from tests.core.test_rinex_navigation import header, kepler

    return header(4.02, "NAVIGATION DATA     M") + "".join(
        f"> EPH G{number:02d} LNAV\n" + kepler(f"G{number:02d}") for number in range(1, 13))


def lane_map(path: Path, city: Path) -> Path:
    """The sound Lanelet2 map of the tests."""
    from tests.core.test_map_check import sound_map
    from urbanmap_qgis.io.osm import write_osm

    write_osm(path, sound_map())
    return path


def rule_list() -> str:
    """Codes of rules that are left out."""
    from urbanmap_qgis.roadmap.checks.rule_table import map_rules

    return ", ".join(map_rules())


def _town(folder: Path):
    """Buildings with a texture and attributes of PLATEAU; the image is put into a folder."""
    from tests.city_models import town
    from urbanmap_qgis.citymodel.model import AttributeGroup, CodeValue

    folder.mkdir(parents=True, exist_ok=True)
    image = folder / "wall.jpg"
    image.write_bytes(b"\xff\xd8\xff" + bytes(range(200)) + b"\xff\xd9")
    quality = AttributeGroup("uro:BuildingIDAttribute", {"buildingID": "13101-bldg-1", "city": "13101"})
    return town(images={"textures/wall.jpg": image}, usage=CodeValue("411", "../../codelists/Building_usage.xml"),
                measuredHeight=7.0, **{"uro:buildingIDAttribute": quality})


def plateau(path: Path, city: Path) -> Path:
    """CityGML as PLATEAU has it: attributes of i-UR, a texture, its image beside it and beside the damaged one."""
    from urbanmap_qgis.citymodel.citygml.writer import write_citygml

    folder = path.parent / "plateau"
    write_citygml(folder, _town(path.parent / "images"))
    model, = folder.rglob("*.gml")
    for place in (path.parent, path.parent / "damaged"):
        shutil.copytree(model.parent, place, dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.gml"))
    return Path(shutil.copy(model, path))


def _one_file(folder: Path, pattern: str, path: Path) -> Path:
    """One of the files of a folder, moved to its place."""
    model, = folder.rglob(pattern)
    return Path(shutil.move(model, path))


def furniture(path: Path, city: Path) -> Path:
    """Posts, a lamp and a sign as city furniture of PLATEAU."""
    return _one_file(_street_objects(path.parent / "objects"), "*_frn_*.gml", path)


def trees(path: Path, city: Path) -> Path:
    """Trees as vegetation of PLATEAU."""
    return _one_file(_street_objects(path.parent / "objects"), "*_veg_*.gml", path)


def _street_objects(folder: Path) -> Path:
    import numpy as np

    from tests.core.test_object_city import PLACE, thing
    from urbanmap_qgis.roadmap.objects.object_city import write_object_citygml
    from urbanmap_qgis.roadmap.objects.object_records import LAMP, SIGN, TREE, Board

    board = Board(np.add(PLACE, (10.0, -0.06, 2.4)), 180.0, 0.9, 0.6)
    write_object_citygml(folder, [thing(SIGN, 10.0, 2.7, azimuth=180.0, board=board),
                                  thing(LAMP, 20.0, 8.0, azimuth=90.0, arm=(1.5, 7.9)),
                                  thing(TREE, 40.0, 6.0, crown=3.2)], crs_text(), "2026-04-01")
    return folder


def roads(path: Path, city: Path) -> Path:
    """A crossing as roads of PLATEAU."""
    import shapely

    from urbanmap_qgis.roadspace.road_city import RoadDelivery, write_road_citygml
    from urbanmap_qgis.roadspace.road_model import build_road_model
    from urbanmap_qgis.roadspace.road_surface import surface_of

    plan = shapely.union(shapely.box(-5060, -35003, -4940, -34997), shapely.box(-5002, -35060, -4998, -35000))
    write_road_citygml(path.parent / "roads", build_road_model(surface_of([plan])), crs_text(),
                       RoadDelivery(created="2026-04-01"))
    return _one_file(path.parent / "roads", "*.gml", path)


def plateau_zip(path: Path, city: Path) -> Path:
    """The same as a zip, with the image."""
    folder = path.parent / "udx"
    folder.mkdir()
    model = plateau(folder / "a.gml", city)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in (model, *(item for item in folder.rglob("*") if item.suffix == ".jpg")):
            archive.write(file, Path("udx") / file.relative_to(folder))
    return path


def textured(path: Path, city: Path) -> Path:
    """CityJSON with a texture; its image lies beside it, and where the damaged ones will be."""
    from urbanmap_qgis.citymodel.cityjson.writer import write_model_cityjson

    model = _town(path.parent / "images")
    for place in (path.parent, path.parent / "damaged"):
        (place / "textures").mkdir(parents=True, exist_ok=True)
        shutil.copy(next(iter(model.images.values())), place / "textures" / "wall.jpg")
    write_model_cityjson(path, model)
    return path


def sequence(path: Path, city: Path) -> Path:
    """The city's models as CityJSONSeq."""
    from urbanmap_qgis.citymodel.cityjson.reader import open_cityjson
    from urbanmap_qgis.citymodel.cityjson.writer import write_model_cityjsonseq
    from urbanmap_qgis.citymodel.reading_notes import ReadingNotes

    write_model_cityjsonseq(path, open_cityjson(city / "models/buildings.city.json", ReadingNotes()))
    return path


def city_tiles(path: Path, city: Path) -> Path:
    """The tileset of 3D Tiles of an earlier run."""
    from urbanmap_qgis.citymodel.tiles.tiles_writer import write_tiles

    write_tiles(path.parent / "tiles", _town(path.parent / "images"))
    return Path(shutil.copy(path.parent / "tiles" / "tileset.json", path))


def tile_record(path: Path, city: Path) -> Path:
    """The record of a tile that is done, with its results beside it and beside the damaged one."""
    from urbanmap_qgis.tiling.journal import DONE, TileRecord, checksum, write_record

    for folder in (path.parent, path.parent / "damaged"):
        folder.mkdir(exist_ok=True)
        (folder / "output.gpkg").write_bytes(bytes(range(256)))
    write_record(path.parent, TileRecord("tile", DONE, "", "1234", 3.5, 2.5, 120.0, {"output.gpkg": 256},
                                         {"output.gpkg": checksum(path.parent / "output.gpkg")}, {"BUILDINGS": 7.0}))
    return path


def check_points() -> str:
    """Check points of an acceptance, as a table."""
    rows = [f"P{number},{number}.5,{2 * number}.25,{number % 7}.125,{number}.52,{2 * number}.22,{number % 7}.1,"
            f"{('check', 'adjusted')[number % 5 == 0]},mesh" for number in range(1, 40)]
    return "\n".join(["id,x,y,z,x_product,y_product,z_product,role,unit", *rows, ""])


def crs_text() -> str:
    """The text of a reference system."""
    from pyproj import CRS

    return CRS.from_epsg(6677).to_wkt()


def geoid_raster(path: Path, city: Path) -> Path:
    """A small geoid as a raster in degrees."""
    import numpy as np
    import rasterio

    heights = 36.0 + 0.01 * np.add.outer(np.arange(40.0), np.arange(30.0)).astype("float32")
    with rasterio.open(path, "w", driver="GTiff", width=30, height=40, count=1, dtype="float32", crs="EPSG:6668",
                       transform=rasterio.Affine(0.025, 0, 139.0, 0, -0.0166667, 36.6)) as target:
        target.write(heights, 1)
    return path


def geoid_isg(path: Path, city: Path) -> Path:
    """A small geoid in the text format of the International Service for the Geoid."""
    entries = {"model name": "test", "lat min": "36.0", "lat max": "36.39", "lon min": "139.0", "lon max": "139.29",
               "delta lat": "0.01", "delta lon": "0.01", "nrows": "40", "ncols": "30", "nodata": "-9999.0"}
    rows = [" ".join(f"{36 + 0.01 * (row + column):.4f}" for column in range(30)) for row in range(40)]
    path.write_text("\n".join(["begin_of_head", *(f"{name:<10} : {value}" for name, value in entries.items()),
                               "end_of_head", *rows, ""]), encoding="utf-8")
    return path


def shapefile(ending: str) -> Callable[[Path, Path], Path]:
    """One part of a shapefile by its ending; the others lie beside it, and where the damaged ones will be."""

    def make(path: Path, city: Path) -> Path:
        from tests.core.test_recognition import shapefile as written_shapefile

        written_shapefile(path.with_suffix(".shp"))
        path.with_suffix(".prj").write_text(crs_text(), encoding="utf-8")
        (path.parent / "damaged").mkdir()
        for other in path.parent.glob("a.*"):
            shutil.copy(other, path.parent / "damaged")
        return path.with_suffix(ending)

    return make


def job(path: Path, city: Path) -> Path:
    """A job that has run in part."""
    from urbanmap_qgis.job.job_file import DONE, FAILED, JobStep, planned_job, write_job

    steps = [JobStep("outlines", "loadgsi", {"INPUT": str(city / "footprints")}, DONE, "abc",
                     {"OUTPUT": str(path.parent / "outlines.gpkg"), "BUILDINGS": 12}),
             JobStep("models", "buildingsfromals", {"MIN_ROOF_AREA": 20.0, "LEVELS": [1, 2]}, FAILED, message="why")]
    write_job(path, planned_job("buildings", {"points": (str(city / "als/als.laz"),)}, steps, (str(city),)))
    return path


def ways_of_reading(path: Path, city: Path) -> Path:
    """Two ways of reading the tables of other programs, kept by name."""
    from urbanmap_qgis.job.table_import import TableImport, remember_import

    remember_import(path, "office", TableImport("trajectory", "cp932", ";", 3, {"time": 0, "x": 2, "y": 1}))
    remember_import(path, "other", TableImport("exterior", columns={"file": 0}, length="ft"))
    return path


def report(path: Path, city: Path) -> Path:
    """A report with a verdict."""
    from urbanmap_qgis.io.pages.report import LOOK, Report

    page = Report("Report")
    page.verdict(LOOK, "Look at the parts.")
    page.write(path)
    return path
