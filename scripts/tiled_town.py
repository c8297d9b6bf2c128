"""A town of any size out of one block, run over tiles: what `bench_goals.py` measures the cost of a tile on.

A square of the block, as large as a tile, is repeated on a square lattice, each copy a file of its own.
"""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np
import shapely
from shapely.geometry import shape

ROOT = Path(__file__).resolve().parent.parent

_OFFSETS, _BOX = 155, 179
"""Bytes at which a LAS header has the offsets of the coordinates, and their greatest and least values."""


@dataclass(frozen=True)
class Trial:
    """Sizes of a run: side of a tile and width of its buffer, m; processes."""

    tile: int
    buffer: int
    workers: int


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
            f"OUTPUT_REPORT={folder / 'report.html'}"]
