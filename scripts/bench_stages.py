"""Cost of whole runs on the command line beside what reading their data costs alone: a part of `make bench`.

Each run is a `qgis_process` of its own: CPU seconds (user and system, its workers with it) and greatest memory. The
reference beside it is what any program must do at least: LAZ is decoded by laspy, an image copied by GDAL, QGIS
started without the plugin. The ratio of the two lasts from machine to machine.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import laspy

from scripts.bench_table import print_table

ROOT = Path(__file__).resolve().parents[1]

DATA = ROOT.parent / "shared" / "data"
URBANMAP = ROOT / "scripts" / "urbanmap"
HEADER = ("work", "CPU s", "MB", "reference", "reference CPU s", "CPU / reference")


@contextmanager
def city(data: Path) -> Iterator[Path]:
    """Folder of the independent city, or of a sample city made for the purpose."""
    if data.is_dir():
        yield data
        return
    from urbanmap_qgis.samplecity.write import make_city

    with tempfile.TemporaryDirectory() as folder:
        make_city(Path(folder) / "city", 120, seed=1)
        yield Path(folder) / "city"


@dataclass(frozen=True)
class Work:
    """One run: its name in the table, the algorithm with its parameters, and the files whose reading it is held to."""

    name: str
    algorithm: str
    parameters: dict[str, object]
    inputs: tuple[Path, ...]

    def makes_what(self, other: Work) -> bool:
        """Whether another run reads what this one writes."""
        made = {value for name, value in self.parameters.items() if name.startswith("OUTPUT")}
        return any(value in made for name, value in other.parameters.items()
                   if not name.startswith("OUTPUT") and isinstance(value, Path))


_MEASURE = """
import os, subprocess, sys
process = subprocess.Popen(sys.argv[2:])
_, status, usage = os.wait4(process.pid, 0)
figures = usage.ru_utime + usage.ru_stime, usage.ru_maxrss, os.waitstatus_to_exitcode(status)
os.write(int(sys.argv[1]), " ".join(map(repr, figures)).encode())
"""
"""A process begins with the greatest memory of the one that starts it: this one is small, `make bench` is not."""


def cost(command: list[object], environment: dict[str, str] | None = None) -> tuple[float, float]:
    """CPU seconds and greatest memory (MB, that of this process is not in it) of a program and what it starts.

    Raises
    ------
    SystemExit : the program fails.
    """
    result, told_to = os.pipe()
    with open(result, encoding="ascii") as figures:
        with subprocess.Popen([sys.executable, "-I", "-S", "-c", _MEASURE, str(told_to), *map(str, command)],
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              env=compiling(environment), pass_fds=(told_to,)) as process:
            os.close(told_to)
            told = process.stdout.read().decode(errors="replace")
        measured = figures.read().split()
    if not measured or int(measured[2]):
        ended = measured[2] if measured else process.returncode
        raise SystemExit(f"{' '.join(map(str, command[:3]))} ended with {ended}:\n{told[-2000:]}")
    return float(measured[0]), float(measured[1]) / 1024


def compiling(environment: dict[str, str] | None) -> dict[str, str]:
    """The environment, in which Python keeps what it has compiled: users' runs do not compile anew each time."""
    return {name: value for name, value in (os.environ if environment is None else environment).items()
            if name != "PYTHONDONTWRITEBYTECODE"}


def run_cost(algorithm: str, parameters: dict[str, object]) -> tuple[float, float]:
    """CPU seconds and memory (MB) of a run; a list gives its parameter several times."""
    given = [f"{name}={one}" for name, value in parameters.items()
             for one in (value if isinstance(value, (list, tuple)) else [value])]
    return cost([URBANMAP, algorithm, *given])


def reading_cost(paths: Iterable[Path]) -> tuple[str, float]:
    """What reading the files alone is called and costs in CPU seconds."""
    paths = list(paths)
    start = time.process_time()
    if paths[0].suffix == ".laz":
        for path in paths:
            laspy.read(path)
        return "LAZ decoded", time.process_time() - start
    from osgeo import gdal

    gdal.UseExceptions()
    with tempfile.TemporaryDirectory() as folder:
        for path in paths:
            gdal.Translate(str(Path(folder, "copy.tif")), str(path))
    return "GDAL copy", time.process_time() - start


def works(data: Path, out: Path) -> list[Work]:
    """The runs on a city, in an order in which each finds what it reads; results go to the folder `out`."""
    als = data / "als" / "als.laz"
    frames, outlines = sorted((data / "aerial").glob("frame_*.tif")), data / "footprints" / "gsi_buildings.gpkg"
    camera = {"CAMERA": data / "aerial" / "camera.json", "EXTERIOR": data / "aerial" / "exterior.csv"}
    flat = {"ROOFS": "levels", "OUTPUT_CITYJSON": out / "models.json", "OUTPUT": out / "models.gpkg"}
    return [
        Work("surface and ground", "surfacefromals", {
            "POINTS": als, "OUTPUT": out / "dsm.tif", "OUTPUT_GROUND": out / "ground.tif"}, (als,)),
        Work("occlusion map, one frame", "occlusionmap", {
            "FRAME": frames[0], **camera, "DSM": out / "dsm.tif", "GROUND": out / "ground.tif",
            "OUTPUT": out / "mask.tif"}, (frames[0],)),
        Work("markings from an orthophoto", "roadmarkingsfromorthophoto", {
            "INPUT": data / "aerial" / "ortho.tif", "OUTPUT": out / "marks.tif",
            "OUTPUT_POLYGONS": out / "marks.gpkg"}, (data / "aerial" / "ortho.tif",)),
        Work(f"aerial markings, {len(frames)} frames", "aerialmarkings", {
            "FRAMES": frames, **camera, "ALS": als, "FOOTPRINTS": outlines, "OUTPUT": out / "aerial.tif",
            "OUTPUT_POLYGONS": out / "aerial.gpkg"}, tuple(frames)),
        Work("buildings, level roofs", "buildingsfromals", {"POINTS": als, "FOOTPRINTS": outlines, **flat}, (als,)),
        Work("buildings, roof planes", "buildingsfromals", {
            "POINTS": als, "FOOTPRINTS": outlines, **flat, "ROOFS": "planes"}, (als,)),
    ]


def start_row(folder: Path) -> tuple:
    """The start of QGIS's command line with the plugin, beside the same with an empty profile: the least of five."""
    scale = [(cost([URBANMAP, "help", "segmentroofs"]), _bare_start(folder)) for _ in range(5)]
    (spent, memory), (bare, _) = min(one for one, _ in scale), min(two for _, two in scale)
    return "start of qgis_process", spent, round(memory), "without plugin", bare, spent / bare


def _bare_start(folder: Path) -> tuple[float, float]:
    """CPU seconds and memory (MB) of `qgis_process help` for one of QGIS's own algorithms, with an empty profile."""
    environment = {**os.environ, "QGIS_CUSTOM_CONFIG_PATH": str(folder / "empty"), "QT_QPA_PLATFORM": "offscreen",
                   "XDG_RUNTIME_DIR": str(folder), "LC_ALL": os.environ.get("LC_ALL", "C.UTF-8")}
    environment.pop("QGIS_PLUGINPATH", None)
    names = [place / name for name in ("qgis_process.bin", "qgis_process") for place in map(
        Path, os.environ.get("PATH", "/usr/bin").split(os.pathsep)) if (place / name).is_file()]
    return cost([names[0], "help", "native:buffer"], environment)


def stage_tables(only: str = "") -> None:
    """Print the costs of the runs whose names hold `only`."""
    rows = []
    with city(DATA / "city") as data, tempfile.TemporaryDirectory() as folder:
        given = works(data, Path(folder))
        wanted = [work for work in given if only in work.name]
        for work in given:
            if work in wanted:
                name, reference = reading_cost(work.inputs)
                spent, memory = run_cost(work.algorithm, work.parameters)
                rows.append((work.name, spent, round(memory), name, reference, spent / reference))
            elif any(work.makes_what(other) for other in wanted):
                run_cost(work.algorithm, work.parameters)
    print_table("Whole runs on the command line, each with a start of QGIS, beside reading their data alone", HEADER,
                rows)
