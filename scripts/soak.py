"""A run over tiles that is not left in peace: killed whole or a worker, its disk full, results damaged, inputs changed.

    python scripts/soak.py FOLDER                     half an hour
    python scripts/soak.py FOLDER --minutes 240       a night's part
    python scripts/soak.py FOLDER --rounds 5          a short one, as the tests do

A small town is run over tiles once without any trouble. The same run is then begun again and again in a folder of its
own, each time with a misfortune drawn by a seeded generator; in the end it is let go on, and the merged layer must
hold the same bytes, as after every run in between that ends as if all were well. The folder is a disk of its own in
memory where the system permits that, so that it can be full; elsewhere files are limited in size. Runs go through
`scripts/urbanmap`. Exit code 1 where layers differ, or where a run fails without a sentence.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import laspy
import numpy as np
import shapely
import shapely.geometry

ROOT = Path(__file__).resolve().parent.parent
TILE, BUFFER, WAIT = 40, 20, 900.0
SMALL = 60_000
"""Bytes that a file may have where the disk cannot be filled: less than a layer of one tile."""
DISK = "48m"
ROOM = 1_500_000
"""Bytes left on a disk that is full, at most: a few tiles find room."""


def make_town(folder: Path, side: int) -> dict[str, object]:
    """A flat-roofed house a tile on a plain, side by side tiles, in files of one column each."""
    folder.mkdir(parents=True, exist_ok=True)
    chance, plans, files = np.random.default_rng(1), [], []
    for column in range(side):
        x, y = chance.uniform(0, TILE, 8000 * side) + TILE * column, chance.uniform(0, TILE * side, 8000 * side)
        z = np.zeros(len(x))
        for row in range(side):
            plan = shapely.box(TILE * column + 10, TILE * row + 10, TILE * column + 26, TILE * row + 24)
            z[shapely.contains_xy(plan, x, y)] = 6.0 + column + 0.5 * row
            plans.append(plan)
        header = laspy.LasHeader(point_format=6, version="1.4")
        header.scales, header.offsets = (0.001,) * 3, (0.0,) * 3
        cloud = laspy.LasData(header)
        cloud.x, cloud.y, cloud.z = x, y, z + chance.normal(0, 0.02, len(x))
        cloud.return_number = cloud.number_of_returns = np.ones(len(x), np.uint8)
        files.append(folder / f"{column}.laz")
        cloud.write(files[-1])
    outlines = folder / "outlines.geojson"
    outlines.write_text(json.dumps({
        "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::6677"}},
        "features": [{"type": "Feature", "properties": {"name": number}, "geometry": shapely.geometry.mapping(plan)}
                     for number, plan in enumerate(plans)]}), encoding="utf-8")
    return {"POINTS": files, "FOOTPRINTS": outlines}


@contextlib.contextmanager
def own_disk(folder: Path) -> Iterator[bool]:
    """In the block, `folder` is a disk of its own in memory; False where that is not permitted."""
    folder.mkdir(parents=True, exist_ok=True)
    mounted = not subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK}", "none", str(folder)],
                                 capture_output=True, check=False).returncode
    try:
        yield mounted
    finally:
        if mounted:
            subprocess.run(["umount", "--lazy", str(folder)], check=True)


def descendants(process: int) -> list[int]:
    """Processes that a process has started, and those that these have."""
    try:
        lists = [task.read_text().split() for task in Path(f"/proc/{process}/task").glob("*/children")]
    except OSError:
        return []
    children = [int(number) for numbers in lists for number in numbers]
    return [found for child in children for found in (child, *descendants(child))]


class Soak:
    """One run that is begun again and again in the folder `run`.

    Attributes
    ----------
    met : number of misfortunes by kind. ends : exit codes of the troubled runs, -1 where they were killed.
    expected : bytes of the merged layer, where they are known. filled : whether the disk can be filled.
    """

    def __init__(self, folder: Path, inputs: dict[str, object], seed: int, expected: bytes | None = None,
                 filled: bool = False):
        self.folder, self.inputs, self.expected, self.filled = folder, inputs, expected, filled
        self.chance, self.met, self.ends, self.lasted = random.Random(seed), Counter(), Counter(), 20.0

    def command(self, workers: int) -> list[str]:
        """Arguments of a run."""
        files = [f"POINTS={path}" for path in self.inputs["POINTS"]]
        return [str(ROOT / "scripts" / "urbanmap"), "tiledrun", "ALGORITHM=buildingsfromals", *files,
                f"FOOTPRINTS={self.inputs['FOOTPRINTS']}", "POINTS_CRS=EPSG:6677", "MIN_ROOF_AREA=20", f"TILE={TILE}",
                f"BUFFER={BUFFER}", f"WORKERS={workers}", f"OUTPUT={self.folder / 'tiles.gpkg'}",
                f"OUTPUT_FOLDER={self.folder / 'run'}"]

    def start(self, limit: int | None = None) -> subprocess.Popen:
        """Begin a run; `limit` : bytes that a file may have."""
        def small() -> None:
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        self.folder.mkdir(parents=True, exist_ok=True)
        return subprocess.Popen(self.command(self.chance.choice((1, 2))), stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, start_new_session=True, preexec_fn=small)

    @property
    def merged(self) -> Path:
        """The layer that the tiles make together."""
        return self.folder / "run" / "merged" / "output.gpkg"

    def ended(self, process: subprocess.Popen, killed: bool = False, same: bool = True) -> int:
        """Wait for a run. One that fails must say why, one that ends well must have made the expected layer.

        Parameters
        ----------
        killed : a signal was sent, it may say nothing. same : the inputs are those of the expected layer.
        """
        out, _ = process.communicate(timeout=WAIT)
        code = process.returncode
        self.ends["killed" if killed else f"code {code}"] += 1
        if not killed and code and ("Traceback" in out or "ERROR" not in out):
            sys.exit(f"exit code {code} without a sentence:\n{out[-3000:]}")
        if code == 0 and same and self.expected not in (None, self.merged.read_bytes()):
            sys.exit(f"a run ended as if all were well with another layer:\n{out[-3000:]}")
        return code

    def round(self) -> None:
        """One misfortune."""
        kind = self.chance.choice(("kill", "end", "worker", "full", "results", "record", "place", "inputs"))
        self.met[kind] += 1
        getattr(self, f"_{kind}")()

    def _begun(self) -> subprocess.Popen:
        """A run, some time after its begin: it may have ended."""
        process = self.start()
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(self.chance.uniform(0.1, 1.0) * self.lasted)
        return process

    def _interrupted(self, number: int, same: bool = True) -> None:
        process = self._begun()
        killed = process.poll() is None
        if killed:
            os.killpg(process.pid, number)
        self.ended(process, killed, same)

    def _kill(self) -> None:
        self._interrupted(signal.SIGKILL)

    def _end(self) -> None:
        self._interrupted(signal.SIGTERM)

    def _worker(self) -> None:
        """One of the processes that a run has started is killed, as the system does where memory is short."""
        process = self._begun()
        workers = descendants(process.pid)
        if process.poll() is None and workers:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.chance.choice(workers), signal.SIGKILL)
        self.ended(process)

    def _full(self) -> None:
        """Little room is left on the disk; some of it, or all, is taken by another file."""
        self._damage()
        if not self.filled:
            self.ended(self.start(SMALL))
            return
        system = os.statvfs(self.folder)
        free = system.f_bavail * system.f_frsize
        other = self.folder / "other"
        other.write_bytes(bytes(max(free - self.chance.randrange(ROOM), 0)))
        try:
            self.ended(self.start())
        finally:
            other.unlink()

    def _damage(self) -> None:
        """Some tiles are to be made again."""
        for _ in range(self.chance.randrange(1, 6)):
            self._results()

    def _made(self, pattern: str) -> Path | None:
        found = sorted(self.folder.glob(f"run/tiles/{pattern}"))
        return self.chance.choice(found) if found else None

    def _results(self) -> None:
        path = self._made("*/output.gpkg")
        if path is not None:
            data = bytearray(path.read_bytes())
            start = self.chance.randrange(len(data))
            data[start:start + 50_000] = bytes(len(data[start:start + 50_000]))
            path.write_bytes(data)

    def _record(self) -> None:
        path = self._made("*/tile.json")
        if path is not None:
            text = path.read_text(encoding="utf-8")
            path.write_text(self.chance.choice((text[:len(text) // 2], "[]", '{"outputs": 5}', "")), encoding="utf-8")

    def _place(self) -> None:
        path = self._made("*")
        if path is not None:
            path.rename(self.folder / f"away-{self.met['place']}")
            path.write_bytes(b"x")

    def _inputs(self) -> None:
        """Other points for a part of a run, then those of before."""
        path = self.chance.choice(self.inputs["POINTS"])
        before = path.read_bytes()
        cloud = laspy.read(path)
        cloud.z = np.asarray(cloud.z) * 1.5
        cloud.write(path)
        self._interrupted(signal.SIGTERM, same=False)
        path.write_bytes(before)


def main() -> None:
    """Begin, trouble, go on, compare."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--side", type=int, default=4, help="tiles along a side of the town")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    inputs = make_town(given.folder / "inputs", given.side)
    whole, begun = Soak(given.folder / "whole", inputs, given.seed), time.monotonic()
    if whole.ended(whole.start()):
        sys.exit("the run without trouble failed")
    with own_disk(given.folder / "soak") as filled:
        troubled = Soak(given.folder / "soak", inputs, given.seed, whole.merged.read_bytes(), filled)
        troubled.lasted = time.monotonic() - begun
        done = soak(troubled, given)
        code = troubled.ended(troubled.start())
        same = code == 0 and whole.merged.read_bytes() == troubled.merged.read_bytes()
    print(f"{done} misfortunes ({_counts(troubled.met)}), ends of the runs ({_counts(troubled.ends)}): "
          f"{'the same bytes' if same else 'NOT the same'}")
    sys.exit(0 if same else 1)


def soak(troubled: Soak, given: argparse.Namespace) -> int:
    """Misfortunes until the time is over or their number is reached; how many."""
    until, done = time.monotonic() + 60.0 * given.minutes, 0
    while done < given.rounds if given.rounds is not None else time.monotonic() < until:
        troubled.round()
        done += 1
        print(f"{done}: {_counts(troubled.met)}", flush=True)
    return done


def _counts(counted: Counter) -> str:
    return ", ".join(f"{count} {kind}" for kind, count in sorted(counted.items()))


if __name__ == "__main__":
    main()
