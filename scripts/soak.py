"""A run over tiles that is not left in peace: killed, ended, its disk full, results damaged, inputs changed.

    python scripts/soak.py FOLDER                     half an hour
    python scripts/soak.py FOLDER --minutes 240       a night's part
    python scripts/soak.py FOLDER --rounds 5          a short one, as the tests do

A small town is run over tiles once without any trouble. The same run is then begun again and again in a folder of its
own, each time with a misfortune drawn by a seeded generator; in the end it is let go on, and the merged layer must
hold the same bytes. Runs go through `scripts/urbanmap`. Exit code 1 where they differ, or where a run says nothing.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import laspy
import numpy as np
import shapely
import shapely.geometry

ROOT = Path(__file__).resolve().parent.parent
TILE, BUFFER, WAIT = 40, 20, 900.0
SMALL = 60_000
"""Bytes that a file may have where the disk is to be full: less than a layer of one tile."""


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


class Soak:
    """One run that is begun again and again in the folder `run`."""

    def __init__(self, folder: Path, inputs: dict[str, object], seed: int):
        self.folder, self.inputs, self.chance, self.met = folder, inputs, random.Random(seed), Counter()

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

    def ended(self, process: subprocess.Popen, told: bool = True) -> int:
        """Wait for a run; one that fails must say why."""
        out, _ = process.communicate(timeout=WAIT)
        if told and process.returncode and ("Traceback" in out or "ERROR" not in out):
            sys.exit(f"exit code {process.returncode} without a sentence:\n{out[-3000:]}")
        return process.returncode

    def round(self) -> None:
        """One misfortune."""
        kind = self.chance.choice(("kill", "end", "full", "results", "record", "place", "inputs"))
        self.met[kind] += 1
        getattr(self, f"_{kind}")()

    def _interrupted(self, number: int) -> None:
        process = self.start()
        until = time.monotonic() + self.chance.uniform(1.0, 20.0)
        while process.poll() is None and time.monotonic() < until:
            time.sleep(0.1)
        if process.poll() is None:
            os.killpg(process.pid, number)
        self.ended(process, told=False)

    def _kill(self) -> None:
        self._interrupted(signal.SIGKILL)

    def _end(self) -> None:
        self._interrupted(signal.SIGTERM)

    def _full(self) -> None:
        if self.ended(self.start(SMALL), told=False) == 0 and not self._all_kept():
            sys.exit("a run on a full disk ended as if all were well")

    def _all_kept(self) -> bool:
        return (self.folder / "run" / "merged" / "output.gpkg").is_file()

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
        self._interrupted(signal.SIGTERM)
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
    whole, troubled = Soak(given.folder / "whole", inputs, given.seed), Soak(given.folder / "soak", inputs, given.seed)
    if whole.ended(whole.start()):
        sys.exit("the run without trouble failed")
    until, done = time.monotonic() + 60.0 * given.minutes, 0
    while done < given.rounds if given.rounds is not None else time.monotonic() < until:
        troubled.round()
        done += 1
    code = troubled.ended(troubled.start())
    one, other = (item.folder / "run" / "merged" / "output.gpkg" for item in (whole, troubled))
    same = code == 0 and one.read_bytes() == other.read_bytes()
    print(f"{done} misfortunes ({', '.join(f'{count} {kind}' for kind, count in sorted(troubled.met.items()))}): "
          f"{'the same bytes' if same else 'NOT the same'}")
    sys.exit(0 if same else 1)


if __name__ == "__main__":
    main()
