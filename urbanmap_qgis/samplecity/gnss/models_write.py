"""Writes building models of blocks as GeoJSON and CityJSON."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from ..scene.faces import ring_of
from .displaced_walls import Block


def write_block_geojson(path: Path, crs: str, blocks: list[Block]) -> None:
    """Polygons with `building`, `part`, `z_base`, `z_top` (m); `crs` such as EPSG:6677."""
    features = [{"type": "Feature",
                 "properties": {"building": block.building, "part": block.part, "z_base": round(block.z_base, 3),
                                "z_top": round(block.z_top, 3)},
                 "geometry": {"type": "Polygon", "coordinates": [_closed(ring_of(block.plan))]}} for block in blocks]
    collection = {"type": "FeatureCollection", "name": path.stem,
                  "crs": {"type": "name", "properties": {"name": f"urn:ogc:def:crs:EPSG::{crs.split(':')[1]}"}},
                  "features": features}
    path.write_text(json.dumps(collection, separators=(",", ":")) + "\n", encoding="utf-8")


def write_block_cityjson(path: Path, crs: str, blocks: list[Block]) -> None:
    """CityJSON 1.1 with a `Building` for each building and a `BuildingPart` (LoD 1.3 solid) for each block."""
    objects: dict[str, dict] = {}
    vertices: dict[tuple[int, int, int], int] = {}
    corners = np.vstack([ring_of(block.plan) for block in blocks])
    origin = [*np.floor(corners.min(axis=0)).tolist(), float(np.floor(min(block.z_base for block in blocks)))]

    def index(point: np.ndarray, z: float) -> int:
        key = tuple(round((value - low) * 1000) for value, low in zip((*point, z), origin))
        return vertices.setdefault(key, len(vertices))

    for block in blocks:
        name, part = f"building-{block.building}", f"building-{block.building}-{block.part}"
        ring = ring_of(block.plan)
        low, high = ([index(point, z) for point in ring] for z in (block.z_base, block.z_top))
        around = range(len(ring))
        sides = [[[low[i], low[i - len(ring) + 1], high[i - len(ring) + 1], high[i]]] for i in around]
        objects.setdefault(name, {"type": "Building", "children": [],
                                  "attributes": {"building": block.building}})["children"].append(part)
        objects[part] = {"type": "BuildingPart", "parents": [name],
                         "attributes": {"z_base": round(block.z_base, 3), "z_top": round(block.z_top, 3)},
                         "geometry": [{"type": "Solid", "lod": "1.3", "boundaries": [[[high], [low[::-1]], *sides]]}]}
    model = {"type": "CityJSON", "version": "1.1",
             "transform": {"scale": [0.001, 0.001, 0.001], "translate": origin},
             "metadata": {"referenceSystem": f"https://www.opengis.net/def/crs/EPSG/0/{crs.split(':')[1]}"},
             "CityObjects": objects, "vertices": [list(key) for key in vertices]}
    path.write_text(json.dumps(model, separators=(",", ":")) + "\n", encoding="utf-8")


def _closed(ring: np.ndarray) -> list[list[float]]:
    return [[round(float(x), 3), round(float(y), 3)] for x, y in (*ring, ring[0])]
