"""A town of any size out of one block: run over tiles, killed twice and gone on with, equal to one run that was not.

    python scripts/scale_trial.py POINTS.laz OUTLINES.geojson FOLDER --blocks 2000 --tile 80 --watch 100
    python scripts/scale_trial.py POINTS.laz OUTLINES.geojson FOLDER --sizes 1 4 16
    python scripts/scale_trial.py POINTS.laz OUTLINES.geojson FOLDER --blocks 16 --cluster 2

A square of the block, as large as a tile, is repeated on a square lattice, each copy a file of its own. The first
form prints how many tiles each killed run left, time, memory and disk, and whether the merged layers hold the same in
the end, with --watch also the memory of the run and of each of its workers after every so many tiles; the second the
cost of a tile against the number of tiles; the third compares a run on this machine with one on a Dask cluster of so
many processes. Runs go through `scripts/urbanmap`.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import sqlite3
import struct
import subprocess
import sys
import time
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np
import shapely
from shapely.geometry import shape

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from scripts.soak import descendants  # noqa: E402

PAGE = os.sysconf("SC_PAGE_SIZE")
KILLS = (0.3, 0.6)
"""Shares of the tiles after which the run is killed."""
_OFFSETS, _BOX = 155, 179
"""Bytes at which a LAS header has the offsets of the coordinates, and their greatest and least values."""


@dataclass(frozen=True)
class Trial:
    """Sizes of a trial: side of a tile and width of its buffer, m; processes; more parameters of the run; tiles after
    which the memory of all processes is told, 0 for never."""

    tile: int
    buffer: int
    workers: int
    more: tuple[str, ...] = ()
    watch: int = 0


def make_town(points: Path, outlines: Path, blocks: int, folder: Path, tile: int) -> dict[str, object]:
    """Write copies of the square at the middle of a block, one a tile, and their outlines; inputs of the run."""
    folder.mkdir(parents=True, exist_ok=True)
    square, place = cut_square(points, folder / "square.laz", tile)
    block = json.loads(outlines.read_text(encoding="utf-8"))
    inside = shapely.box(*place, place[0] + tile, place[1] + tile)
    whole = [shape(feature["geometry"]) for feature in block["features"]]
    whole = [shapely.force_2d(polygon) for polygon in whole if inside.contains(polygon)]
    side, start = int(np.ceil(np.sqrt(blocks))), np.floor(place / tile) * tile
    features, files = [], []
    for number in range(blocks):
        shift = start + np.array([number % side, number // side]) * tile - place
        files.append(folder / f"block_{number:05d}.laz")
        files[-1].write_bytes(shifted(square, shift))
        moved = shapely.transform(whole, lambda corners, by=shift: corners + by)
        features += [{"type": "Feature", "properties": {"block": number}, "geometry": json.loads(
            shapely.to_geojson(polygon))} for polygon in moved]
    town = folder / "outlines.geojson"
    town.write_text(json.dumps({**block, "features": features}), encoding="utf-8")
    with laspy.open(folder / "square.laz") as cut:
        print(f"{blocks} blocks of {cut.header.point_count} points and {len(whole)} outlines", flush=True)
    return {"POINTS": files, "FOOTPRINTS": town}


def cut_square(points: Path, path: Path, tile: int) -> tuple[bytes, np.ndarray]:
    """Write the points in the middle of a cloud, in a square of so many metres; the file and its lower left corner."""
    cloud = laspy.read(points)
    x, y = np.array(cloud.x), np.array(cloud.y)
    place = np.round((np.array([x.min() + x.max(), y.min() + y.max()]) - tile) / 2)
    keep = (x >= place[0]) & (x < place[0] + tile) & (y >= place[1]) & (y < place[1] + tile)
    cloud.points = cloud.points[keep]
    cloud.write(path)
    return path.read_bytes(), place


def shifted(file: bytes, shift: np.ndarray) -> bytes:
    """A LAS or LAZ file moved in plan, by its header alone."""
    x, y = shift
    data = bytearray(file)
    for place, steps in ((_OFFSETS, (x, y)), (_BOX, (x, x, y, y))):
        for number, step in enumerate(steps):
            value, = struct.unpack_from("<d", data, place + 8 * number)
            struct.pack_into("<d", data, place + 8 * number, value + step)
    return bytes(data)


def command(inputs: dict[str, object], folder: Path, trial: Trial) -> list[str]:
    """Arguments of a run over tiles."""
    points = [f"POINTS={path}" for path in inputs["POINTS"]]
    return [str(ROOT / "scripts" / "urbanmap"), "tiledrun", "ALGORITHM=buildingsfromals", *points,
            f"FOOTPRINTS={inputs['FOOTPRINTS']}", f"TILE={trial.tile}", f"BUFFER={trial.buffer}",
            f"WORKERS={trial.workers}", f"OUTPUT={folder / 'tiles.gpkg'}", f"OUTPUT_FOLDER={folder / 'run'}",
            f"OUTPUT_REPORT={folder / 'report.html'}", *trial.more]


def records(folder: Path) -> list[dict]:
    """Records of the tiles that are whole."""
    return [json.loads(path.read_text(encoding="utf-8")) for path in folder.glob("run/tiles/*/tile.json")
            if not path.parent.name.endswith(".part")]


def whole_tiles(folder: Path) -> int:
    """How many tiles are whole, without reading their records."""
    tiles = folder / "run" / "tiles"
    return sum(not name.endswith(".part") for name in os.listdir(tiles)) if tiles.is_dir() else 0


def run(inputs: dict[str, object], folder: Path, trial: Trial, until: int | None = None
        ) -> tuple[float, float, float]:
    """Run to the end, or kill the run and its workers when so many tiles are whole.

    Returns time and time on processors of all processes, s, and the memory of the greatest, MB.
    """
    folder.mkdir(exist_ok=True)
    start = time.monotonic()
    with (folder / "log.txt").open("ab") as log:
        process = subprocess.Popen(command(inputs, folder, trial), stdout=log, stderr=log, stdin=subprocess.DEVNULL,
                                   start_new_session=True)
        told, ended = trial.watch, 0
        while not ended:
            time.sleep(0.2)
            ended, status, used = os.wait4(process.pid, os.WNOHANG)
            whole = whole_tiles(folder)
            if not ended and until is not None and whole >= until:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                return time.monotonic() - start, 0.0, 0.0
            if not ended and trial.watch and whole >= told:
                told = whole - whole % trial.watch + trial.watch
                print(f"{whole} tiles: {resident(process.pid)} MB", flush=True)
    if status:
        raise SystemExit(f"the run in {folder} ended with {status}: see log.txt there")
    return time.monotonic() - start, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def resident(process: int) -> list[int]:
    """Memory of a process and of all that it has started, MB."""
    found = []
    for number in (process, *descendants(process)):
        with suppress(OSError):  # it has just ended
            found.append(int(Path(f"/proc/{number}/statm").read_text(encoding="ascii").split()[1]) * PAGE >> 20)
    return found


def tell(name: str, folder: Path, took: tuple[float, float, float]) -> float:
    """Print what a finished run took; processor time of a tile, s."""
    done = [record for record in records(folder) if record["status"] == "done"]
    each = sum(record["cpu"] for record in done) / len(done)
    disk = sum(file.stat().st_size for file in (folder / "run").rglob("*") if file.is_file())
    buildings = sum(record["figures"].get("BUILDINGS", 0) for record in done)
    print(f"{name}: {len(done)} tiles, {buildings:.0f} buildings read, {took[0]:.0f} s, {each:.2f} s of processor "
          f"a tile, {took[1]:.0f} s in all, greatest process {took[2]:.0f} MB, of a worker "
          f"{max(record['memory'] for record in done):.0f} MB, {disk / 1e6:.0f} MB on disk", flush=True)
    return each


def same_content(one: Path, other: Path) -> bool:
    """Whether two merged results hold the same: tables row by row, all else by bytes."""
    if one.suffix != ".gpkg" or one.read_bytes() == other.read_bytes():
        return one.read_bytes() == other.read_bytes()
    return _rows(one) == _rows(other)


def _rows(path: Path) -> dict[str, list]:
    with closing(sqlite3.connect(path)) as database:
        names = [name for name, in database.execute("SELECT table_name FROM gpkg_contents")]
        return {name: database.execute(f'SELECT * FROM "{name}" ORDER BY 1').fetchall() for name in names}


def compare(one: Path, other: Path) -> None:
    """Print whether the merged results of two runs are the same bytes, and whether they hold the same."""
    for file in sorted((one / "run" / "merged").iterdir()):
        again = other / "run" / "merged" / file.name
        equal = again.is_file() and same_content(file, again)
        print(f"{file.name}: {'the same content' if equal else 'OTHER CONTENT'}, "
              f"{'the same bytes' if equal and file.read_bytes() == again.read_bytes() else 'other bytes'}", flush=True)


_SERVE = """
import sys
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=int(sys.argv[1]), threads_per_worker=1, dashboard_address=None) as cluster:
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()
"""


@contextmanager
def local_cluster(workers: int, folder: Path):
    """Address of a Dask cluster of processes on this machine that ends with the block."""
    script = folder / "serve.py"
    script.write_text(_SERVE, encoding="utf-8")
    process = subprocess.Popen([sys.executable, str(script), str(workers)], stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE, text=True, cwd=folder)
    try:
        yield process.stdout.readline().strip()
    finally:
        process.communicate("", timeout=60)


def killed_twice(inputs: dict[str, object], folder: Path, blocks: int, trial: Trial) -> None:
    """One run in one go, and one that is killed twice and gone on with."""
    whole, cut = folder / f"whole_{blocks}", folder / f"killed_{blocks}"
    tell(f"{blocks} blocks in one go", whole, run(inputs, whole, trial))
    total = whole_tiles(whole)
    for share in KILLS:
        seconds, *_ = run(inputs, cut, trial, int(share * total))
        print(f"killed after {seconds:.0f} s with {whole_tiles(cut)} of {total} tiles whole", flush=True)
    tell("gone on with to the end", cut, run(inputs, cut, trial))
    compare(whole, cut)


def on_cluster(inputs: dict[str, object], folder: Path, blocks: int, trial: Trial, workers: int) -> None:
    """One run on this machine and one whose pieces go to a cluster."""
    here, there = folder / f"here_{blocks}", folder / f"there_{blocks}"
    tell(f"{blocks} blocks on this machine", here, run(inputs, here, trial))
    with local_cluster(workers, folder) as address:
        sent = Trial(trial.tile, trial.buffer, trial.workers, (*trial.more, f"SCHEDULER={address}"))
        tell(f"{blocks} blocks on a cluster of {workers}", there, run(inputs, there, sent))
    compare(here, there)


def main() -> None:
    """Run the trial that the arguments ask for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("points", type=Path)
    parser.add_argument("outlines", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--blocks", type=int, default=16)
    parser.add_argument("--sizes", type=int, nargs="+")
    parser.add_argument("--tile", type=int, default=150)
    parser.add_argument("--buffer", type=int, default=30)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--cluster", type=int, default=0)
    parser.add_argument("--watch", type=int, default=0)
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    trial = Trial(given.tile, given.buffer, given.workers, watch=given.watch)
    for blocks in given.sizes or [given.blocks]:
        inputs = make_town(given.points, given.outlines, blocks, given.folder / f"town_{blocks}", given.tile)
        if given.sizes:
            whole = given.folder / f"whole_{blocks}"
            tell(f"{blocks} blocks", whole, run(inputs, whole, trial))
        elif given.cluster:
            on_cluster(inputs, given.folder, blocks, trial, given.cluster)
        else:
            killed_twice(inputs, given.folder, blocks, trial)


if __name__ == "__main__":
    main()
