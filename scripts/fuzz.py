"""Damaged files for every reader of the core: what becomes of them, as a table.

    .venv/bin/python scripts/fuzz.py --city FOLDER [--count 100] [--seed 1] [--format las] [--keep FOLDER]

`--city` is the folder of a sample city (scripts/urbanmap samplecity SIZE=60 OUTPUT=city). Each format's sound file is
damaged by a seeded generator (bytes flipped, cut out, doubled, cut off; numbers made huge, empty or not finite; deep
nesting) and read in a process of its own with 2 GB of memory to take and 10 s a file. Columns: read as if sound;
refused in a sentence; and what must not be: tracebacks, hangs, ends of the process, more memory than 2 GB, values that
are not finite. `--keep` keeps the files of the latter. The exit code is 1 where there is any.
"""

from __future__ import annotations

import argparse
import dataclasses
import gzip
import json
import os
import random
import resource
import selectors
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from scripts.fuzz_damage import damaged  # noqa: E402

SECONDS, MEMORY = 10.0, 2 << 30
OUTCOMES = ("read", "sentence", "traceback", "hang", "ended", "memory", "not finite")
GOOD = OUTCOMES[:2]
FRAME = 240, 320  # rows, columns


# Sound files

def _written_cloud(path: Path, city: Path, point_format: int) -> Path:
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


def _copied(place: str) -> Callable[[Path, Path], Path]:
    return lambda path, city: Path(shutil.copy(city / place, path))


def _gsi(path: Path, city: Path) -> Path:
    source = next((city / "footprints").glob("FG-GML-*.xml")).read_bytes()
    return Path(shutil.copy(next((city / "footprints").glob("FG-GML-*.xml")), path)) if len(source) < 2**22 else path


def _gsi_zip(path: Path, city: Path) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.write(next((city / "footprints").glob("FG-GML-*.xml")), "FG-GML-533946-BldA-20240401-0001.xml")
    return path


def _sbet(path: Path, city: Path) -> Path:
    import numpy as np

    records = np.zeros((500, 17))
    records[:, 0] = np.arange(500) * 0.1
    records[:, 1] = np.radians(35.6) + np.arange(500) * 1e-7
    records[:, 2] = np.radians(139.7)
    records[:, 9] = 0.3
    records.astype("<f8").tofile(path)
    return path


def _head(place: str, lines: int) -> Callable[[Path, Path], Path]:
    def make(path: Path, city: Path) -> Path:
        opener = gzip.open if place.endswith(".gz") else open
        with opener(city / place, "rb") as file:
            text = b"".join(file.readline() for _ in range(lines))
        path.write_bytes(gzip.compress(text) if path.suffix == ".gz" else text)
        return path

    return make


def _sp3(path: Path, city: Path) -> Path:
    lines = ["#cP2019  4 28  0  0  0.00000000       8 ORBIT IGS14 HLM  IGS", "## 2051      0.00000000   900.00000000 "
             "58601 0.0000000000000", "+    2   G01G02" + "  0" * 15, "++         0  0" + "  0" * 15,
             "%c G  cc GPS ccc cccc cccc cccc cccc ccccc ccccc ccccc ccccc"]
    for epoch in range(12):
        lines.append(f"*  2019  4 28  {epoch // 4}  {15 * (epoch % 4)}  0.00000000")
        lines += [f"PG0{number}{15000 + 100 * epoch:14.6f}{-20000.0:14.6f}{9000.0:14.6f}{12.5:14.6f}"
                  for number in (1, 2)]
    path.write_text("\n".join([*lines, "EOF", ""]))
    return path


def _image(place: str, rows: int, columns: int) -> Callable[[Path, Path], Path]:
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


def _strip_image(path: Path, city: Path) -> Path:
    """A strip image; calibration and times lie beside it, and where the damaged ones will be."""
    (path.parent / "damaged").mkdir(exist_ok=True)
    for folder in (path.parent, path.parent / "damaged"):
        for name in ("calibration.json", "camera_1_times.csv"):
            shutil.copy(city / "lines" / name, folder)
    return Path(shutil.copy(city / "lines/camera_1.png", path))


def _citygml(path: Path, city: Path) -> Path:
    """The city's models as CityGML."""
    from urbanmap_qgis.citymodel.citygml.writer import write_citygml
    from urbanmap_qgis.citymodel.cityjson.reader import open_cityjson
    from urbanmap_qgis.citymodel.reading_notes import ReadingNotes

    folder = path.parent / "gml"
    folder.mkdir()
    write_citygml(folder, open_cityjson(city / "models/buildings.city.json", ReadingNotes()))
    return Path(shutil.copy(next(iter(sorted(folder.rglob("*.gml")))), path))


def _dem(path: Path, city: Path) -> Path:
    head = (ROOT / "tests" / "core" / "gsi_dem_writer.py").read_text(encoding="utf-8")
    scope: dict = {}
    exec(compile(head, "gsi_dem_writer", "exec"), scope)
    path.write_text(scope["dem_xml"]("53394611", ["\u5730\u8868\u9762,12.50"] * (150 * 225), 150, 225),
                    encoding="utf-8")
    return path


def _geoid(path: Path, city: Path) -> Path:
    """A small grid as GSI writes its geoid."""
    rows = ["36.0 139.0 0.016667 0.025 40 30 1 ver1"]
    rows += [" ".join(f"{36 + 0.01 * (row + column):.4f}" for column in range(30)) for row in range(40)]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def _poses(path: Path, city: Path) -> Path:
    return _head("mms/survey_01_images.csv", 60)(path, city)


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

    from urbanmap_qgis.citymodel.citygml.reader import open_citygml
    from urbanmap_qgis.citymodel.cityjson.reader import open_cityjson
    from urbanmap_qgis.citymodel.reading_notes import ReadingNotes

    with ExitStack() as stack:
        model = (open_citygml(path, stack, ReadingNotes()) if path.suffix == ".gml"
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


FORMATS: dict[str, tuple[str, Callable, Callable]] = {
    "LAS": ("a.las", lambda path, city: _written_cloud(path, city, 3), _cloud),
    "LAS 1.4": ("a.las", lambda path, city: _written_cloud(path, city, 6), _cloud),
    "LAZ": ("a.laz", lambda path, city: _written_cloud(path, city, 3), _cloud),
    "LAZ 1.4": ("a.laz", lambda path, city: _written_cloud(path, city, 7), _cloud),
    "trajectory CSV": ("a.csv", _head("mms/survey_01_trajectory.csv", 200), _trajectory),
    "SBET": ("a.sbet", _sbet, _trajectory),
    "image poses": ("a.csv", _poses, _of("mobile.image_poses", "read_image_poses")),
    "control points": ("a.csv", _copied("truth/control_survey_01.csv"), _of("mobile.control", "read_control")),
    "tie points": ("a.csv", _copied("lines/tie_points.csv"), _of("mobile.lines.tie_points", "read_tie_points")),
    "times of columns": ("a.csv", _head("lines/camera_1_times.csv", 401), _times),
    "range scans CSV": ("a.csv", _head("lines/scans.csv.gz", 500), _scans),
    "range scans gz": ("a.csv.gz", _head("lines/scans.csv.gz", 500), _scans),
    "calibration": ("a.json", _copied("mms/calibration.json"), _of("mobile.calibration", "read_calibration")),
    "camera": ("a.json", _copied("aerial/camera.json"), _of("aerial.frames.camera", "read_camera")),
    "exterior orientation": ("a.csv", _copied("aerial/exterior.csv"), _of("aerial.frames.camera", "read_exterior")),
    "CityJSON": ("a.city.json", _copied("models/buildings.city.json"),
                 _of("citymodel.cityjson.reader", "read_cityjson")),
    "GSI XML": ("FG-GML-533946-BldA-20240401-0001.xml", _gsi, _buildings),
    "GSI zip": ("a.zip", _gsi_zip, _buildings),
    "CityGML": ("a.gml", _citygml, _city),
    "city model CityJSON": ("a.city.json", _copied("models/buildings.city.json"), _city),
    "GSI DEM": ("FG-GML-5339-46-11-DEM5A-20161001.xml", _dem, _elevations),
    "geoid grid": ("a.asc", _geoid, _heights),
    "RINEX observations": ("a.obs", _head("gnss/pass_01.obs", 400), _observations),
    "RINEX navigation": ("a.nav", _head("gnss/satellites.nav", 400), _navigation),
    "SP3": ("a.sp3", _sp3, _navigation),
    "GeoTIFF": ("a.tif", _copied("truth/ground.tif"), _raster),
    "GeoTIFF in parts": ("a.tif", _copied("truth/ground.tif"), _sampled),
    "orthophoto": ("a.tif", _image("aerial/ortho.tif", 300, 400), _orthophoto),
    "frame TIFF": ("a.tif", _image("aerial/frame_01.tif", *FRAME), _frame),
    "frame JPEG": ("a.jpg", _image("aerial/frame_01.tif", *FRAME), _frame),
    "strip image": ("camera_1.png", _strip_image, _strip),
}


# A process that reads

def _not_finite(value: object, depth: int = 0) -> bool:
    """Whether NaN or infinity is in what a reader gave back; a limit may be infinite (max_range)."""
    import numpy as np

    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return any(_not_finite(getattr(value, item.name), depth + 1) for item in dataclasses.fields(value)
                   if item.name not in ("max_range", "place_mms", "true", "surveyed"))
    if isinstance(value, np.ndarray):
        return bool(value.dtype.kind == "f" and not np.isfinite(value).all())
    if isinstance(value, dict):
        return any(_not_finite(item, depth + 1) for item in value.values())
    if isinstance(value, (list, tuple)) and depth < 8:
        return any(_not_finite(item, depth + 1) for item in value)
    return isinstance(value, float) and not np.isfinite(value)


def serve(name: str) -> None:
    """Read the files whose paths come by standard input; answer with the outcome of each."""
    import warnings

    from urbanmap_qgis.errors import UrbanMapError

    warnings.simplefilter("ignore")
    reader = FORMATS[name][2]
    answers = os.fdopen(os.dup(1), "w")
    print("ready", file=answers, flush=True)
    reader_ready = False
    for line in sys.stdin:
        path = Path(line.rstrip("\n"))
        try:
            outcome, told = ("not finite" if _not_finite(reader(path)) else "read"), ""
        except UrbanMapError as error:
            outcome, told = "sentence", str(error)
            cause = error.__cause__
            outcome = "memory" if isinstance(cause, MemoryError) else outcome
        except MemoryError:
            outcome, told = "memory", ""
        except BaseException as error:  # what a panic is, too
            outcome, told = "traceback", f"{type(error).__name__}: {error}"[:200]
        print(json.dumps([outcome, told]), file=answers, flush=True)
        if not reader_ready:  # the first file is the sound one: by now everything is loaded
            limit = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize() + MEMORY
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
            reader_ready = True


class Server:
    """The reading process of a format, started again when it ends."""

    def __init__(self, name: str, sound: Path):
        self.name, self.sound = name, sound
        self._start()

    def _start(self) -> None:
        self.process = subprocess.Popen([sys.executable, __file__, "--serve", self.name], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                        env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1"})
        self.process.stdout.readline()
        outcome, told = self.read(self.sound, 60.0)
        if outcome != "read":
            sys.exit(f"{self.name}: the sound file gives {outcome}: {told}")

    def read(self, path: Path, seconds: float = SECONDS) -> tuple[str, str]:
        """Outcome and words for one file."""
        self.process.stdin.write(f"{path}\n")
        self.process.stdin.flush()
        with selectors.DefaultSelector() as selector:
            selector.register(self.process.stdout, selectors.EVENT_READ)
            there = selector.select(seconds)
        line = self.process.stdout.readline() if there else ""
        if line:
            return tuple(json.loads(line))
        outcome = "ended" if there else "hang"
        self.close()
        told = f"exit code {self.process.returncode}"
        self._start()
        return outcome, told

    def close(self) -> None:
        self.process.kill()
        self.process.wait()


def trial(name: str, city: Path, count: int, seed: int, folder: Path, keep: Path | None) -> tuple[Counter, list[str]]:
    """Outcomes of one format, and a line on each that must not be."""
    file, make, _ = FORMATS[name]
    sound = make(folder / file, city)
    data = sound.read_bytes()
    (folder / "damaged").mkdir(exist_ok=True)
    target, found, lines = folder / "damaged" / file, Counter(), []
    server = Server(name, sound)
    for number in range(count):
        target.write_bytes(damaged(data, random.Random(f"{name}-{seed}-{number}")))
        outcome, told = server.read(target)
        found[outcome] += 1
        if outcome not in GOOD:
            lines.append(f"{name}, seed {seed}, file {number}: {outcome} {told}")
            if keep is not None:
                keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(target, keep / f"{name.replace(' ', '_')}-{seed}-{number}-{file}")
    server.close()
    return found, lines


def main() -> None:
    """Try all formats, or those that are named."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--city", type=Path)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--format", action="append", choices=list(FORMATS))
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--serve", choices=list(FORMATS))
    given = parser.parse_args()
    if given.serve:
        serve(given.serve)
        return
    if given.city is None:
        parser.error("--city is needed")
    print(f"{'format':<22}" + "".join(f"{outcome:>12}" for outcome in OUTCOMES))
    bad = []
    for name in given.format or FORMATS:
        with tempfile.TemporaryDirectory(prefix="urbanmap-fuzz-") as folder:
            found, lines = trial(name, given.city, given.count, given.seed, Path(folder), given.keep)
        print(f"{name:<22}" + "".join(f"{found[outcome]:>12}" for outcome in OUTCOMES), flush=True)
        bad += lines
    print("\n".join(bad))
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
