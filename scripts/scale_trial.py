"""A town of any size out of one block: run over tiles, killed twice and gone on with, equal to one run that was not.

    python scripts/scale_trial.py POINTS.laz OUTLINES.geojson FOLDER --blocks 100
    python scripts/scale_trial.py POINTS.laz OUTLINES.geojson FOLDER --sizes 1 4 16

The block, of less than a tile, is repeated on a square lattice, each copy a file of its own. The first form prints
how many tiles each killed run left, time on processors, memory and disk, and whether the merged layers are the same
bytes in the end; the second the cost of a tile against the number of tiles. Runs go through `scripts/urbanmap`.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import subprocess
import time
from pathlib import Path

import laspy
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
TILE, BUFFER, WORKERS = 300, 40, 2
KILLS = (0.3, 0.6)
"""Shares of the tiles after which the run is killed."""


def make_town(points: Path, outlines: Path, blocks: int, folder: Path) -> dict[str, object]:
    """Write copies of a block, shifted by whole tiles, and their outlines; inputs of the run."""
    folder.mkdir(parents=True, exist_ok=True)
    side = int(np.ceil(np.sqrt(blocks)))
    cloud, features = laspy.read(points), []
    block = json.loads(outlines.read_text(encoding="utf-8"))
    x, y = np.array(cloud.x), np.array(cloud.y)
    files = []
    for number in range(blocks):
        shift = np.array([number % side * TILE, number // side * TILE], float)
        copy = laspy.LasData(laspy.LasHeader(point_format=cloud.header.point_format, version=cloud.header.version))
        copy.header.scales, copy.header.offsets = cloud.header.scales, cloud.header.offsets + np.array([*shift, 0])
        copy.header.add_crs(cloud.header.parse_crs())
        copy.points = laspy.ScaleAwarePointRecord(cloud.points.array.copy(), cloud.header.point_format,
                                                  copy.header.scales, copy.header.offsets)
        copy.x, copy.y = x + shift[0], y + shift[1]
        files.append(folder / f"block_{number:05d}.laz")
        copy.write(files[-1])
        for feature in block["features"]:
            rings = [[[*(np.array(place[:2]) + shift)] for place in ring]
                     for ring in _first_polygon(feature["geometry"])]
            features.append({"type": "Feature", "properties": {"block": number},
                             "geometry": {"type": "Polygon", "coordinates": rings}})
    town = folder / "outlines.geojson"
    town.write_text(json.dumps({**block, "features": features}), encoding="utf-8")
    return {"POINTS": files, "FOOTPRINTS": town}


def _first_polygon(geometry: dict) -> list:
    return geometry["coordinates"][0] if geometry["type"] == "MultiPolygon" else geometry["coordinates"]


def command(inputs: dict[str, object], folder: Path) -> list[str]:
    """Arguments of a run over tiles."""
    points = [f"POINTS={path}" for path in inputs["POINTS"]]
    return [str(ROOT / "scripts" / "urbanmap"), "tiledrun", "ALGORITHM=buildingsfromals", *points,
            f"FOOTPRINTS={inputs['FOOTPRINTS']}", f"TILE={TILE}", f"BUFFER={BUFFER}", f"WORKERS={WORKERS}",
            f"OUTPUT={folder / 'tiles.gpkg'}", f"OUTPUT_FOLDER={folder / 'run'}",
            f"OUTPUT_REPORT={folder / 'report.html'}"]


def records(folder: Path) -> list[dict]:
    """Records of the tiles that are whole."""
    return [json.loads(path.read_text(encoding="utf-8")) for path in folder.glob("run/tiles/*/tile.json")
            if not path.parent.name.endswith(".part")]


def run(inputs: dict[str, object], folder: Path, until: int | None = None) -> None:
    """Run to the end, or kill the run and its workers when so many tiles are whole."""
    folder.mkdir(exist_ok=True)
    process = subprocess.Popen(command(inputs, folder), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               stdin=subprocess.DEVNULL, start_new_session=True)
    while until is not None and process.poll() is None and len(records(folder)) < until:
        time.sleep(0.2)
    if until is not None and process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
    if process.wait() and until is None:
        raise SystemExit(f"the run in {folder} ended with {process.returncode}")


def tell(name: str, folder: Path, seconds: float) -> float:
    """Print what a finished run took; processor time of a tile, s."""
    done = [record for record in records(folder) if record["status"] == "done"]
    each = sum(record["cpu"] for record in done) / len(done)
    disk = sum(file.stat().st_size for file in (folder / "run").rglob("*") if file.is_file())
    buildings = sum(record["figures"].get("BUILDINGS", 0) for record in done)
    print(f"{name}: {len(done)} tiles, {buildings:.0f} buildings read, {seconds:.0f} s, {each:.2f} s of processor "
          f"a tile, {max(record['memory'] for record in done):.0f} MB, {disk / 1e6:.0f} MB on disk", flush=True)
    return each


def main() -> None:
    """Run the trial that the arguments ask for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("points", type=Path)
    parser.add_argument("outlines", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--blocks", type=int, default=16)
    parser.add_argument("--sizes", type=int, nargs="+")
    given = parser.parse_args()
    for blocks in given.sizes or [given.blocks]:
        inputs = make_town(given.points, given.outlines, blocks, given.folder / f"town_{blocks}")
        whole = given.folder / f"whole_{blocks}"
        start = time.monotonic()
        run(inputs, whole)
        tell(f"{blocks} blocks in one go", whole, time.monotonic() - start)
        if given.sizes:
            continue
        cut, total = given.folder / f"killed_{blocks}", len(records(whole))
        for share in KILLS:
            run(inputs, cut, int(share * total))
            print(f"killed with {len(records(cut))} of {total} tiles whole", flush=True)
        start = time.monotonic()
        run(inputs, cut)
        tell("gone on with to the end", cut, time.monotonic() - start)
        same = all((cut / "run" / "merged" / file.name).read_bytes() == file.read_bytes()
                   for file in (whole / "run" / "merged").iterdir())
        print(f"merged results the same bytes: {'yes' if same else 'NO'}")


if __name__ == "__main__":
    main()
