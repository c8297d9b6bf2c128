"""Figures that tell whether a result is still what it was: counts, means, spreads and quantiles of its arrays.

`stays(name, result)` compares a result with the figures in tests/core/figures/<name>.json. A change that is meant to
change results gets new figures with `URBANMAP_NEW_FIGURES=1 .venv/bin/python -m pytest ...`; the difference in git then
shows what it changed.
"""

from __future__ import annotations

import dataclasses
import gzip
import json
import os
import re
import sqlite3
from collections.abc import Mapping
from contextlib import closing
from pathlib import Path

import laspy
import numpy as np
import rasterio
import shapely

FOLDER = Path(__file__).resolve().parent / "core" / "figures"
QUANTILES = (0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99)
NUMBER = re.compile(r"-?\d+\.?\d*(?:[eEdD][-+]?\d+)?")
STYLE = re.compile(r"<style.*?</style>", re.DOTALL)  # how a page looks is no result
TOLERANCE = 2e-4  # of the spread (of the size where there is none): what other releases of numpy may change
COLUMNS = 16  # arrays of no more columns (coordinates, tables) are taken column by column
ENVELOPES = (0, 32, 48, 48, 64)  # bytes of a GeoPackage geometry's envelope, by its code


def stays(name: str, result, tolerance: float = TOLERANCE) -> None:
    """Fail where a result's figures are no longer those stored under `name`."""
    now = {place: figures(values) for place, values in sorted(arrays(result))}
    path = FOLDER / f"{name}.json"
    if os.environ.get("URBANMAP_NEW_FIGURES"):
        path.parent.mkdir(exist_ok=True)
        rows = ",\n".join(f"{json.dumps(place)}: {json.dumps(row)}" for place, row in now.items())
        path.write_text(f"{{\n{rows}\n}}\n", encoding="utf-8")
    stored = json.loads(path.read_text(encoding="utf-8"))
    assert sorted(now) == sorted(stored)
    changed = {place: (stored[place], row) for place, row in now.items() if not alike(stored[place], row, tolerance)}
    assert not changed, f"changed (stored, now; see tests/figures.py): {changed}"


def figures(values: np.ndarray) -> list[float]:
    """Number of finite and of other values, mean, standard deviation and quantiles of an array of numbers."""
    values = np.asarray(values, dtype=float).ravel()
    known = values[np.isfinite(values)]
    if not len(known):
        return [0, len(values)]
    # Without the first value large coordinates keep their digits.
    apart = known - known[0]
    spread = [float(known[0] + apart.mean()), float(apart.std()), *(known[0] + np.quantile(apart, QUANTILES)).tolist()]
    return [len(known), len(values) - len(known), *(float(f"{figure:.10g}") for figure in spread)]


def alike(stored: list[float], now: list[float], tolerance: float) -> bool:
    """Whether two rows of figures are the same but for rounding."""
    if len(stored) != len(now):
        return False
    if len(stored) == 2:
        return stored == now
    counts, rest = np.abs(np.subtract(stored[:2], now[:2])), np.abs(np.subtract(stored[2:], now[2:]))
    size = np.max(np.abs(stored[2:]))
    limit = tolerance * (stored[3] if stored[3] > 1e-9 * size else size) + 1e-9 * max(size, 1.0)
    return bool((counts <= tolerance * stored[0]).all() and (rest <= limit).all())


def arrays(result, place: str = ""):
    """Pairs of place and array for all numbers in a result: arrays, geometries, texts, records and files of them.

    Fields of records are named by their order, so that a new name is no new figure.
    """
    if isinstance(result, Path):
        yield from arrays_of_path(result, place)
    elif isinstance(result, str):
        yield place, [float(number.lower().replace("d", "e")) for number in NUMBER.findall(STYLE.sub("", result))]
    elif isinstance(result, Mapping):
        for key in result:
            yield from arrays(result[key], f"{place}/{key}")
    elif dataclasses.is_dataclass(result):
        for number, field in enumerate(dataclasses.fields(result)):
            yield from arrays(getattr(result, field.name), f"{place}.{number}")
    elif isinstance(result, shapely.Geometry):
        yield from arrays(shapely.get_coordinates(result, include_z=True), place)
    elif isinstance(result, tuple) and all(isinstance(item, (int, float)) for item in result):
        yield from ((f"{place}|{number}", [float(item)]) for number, item in enumerate(result))
    elif isinstance(result, (list, tuple)) or (isinstance(result, np.ndarray) and result.dtype == object):
        yield from merged(result, place)
    elif isinstance(result, (np.ndarray, np.generic)) and result.dtype.kind in "US":
        yield place, [float(sum(map(ord, str(word)))) for word in np.ravel(result)]
    elif isinstance(result, np.ndarray) and result.ndim == 2 and result.shape[1] <= COLUMNS:
        yield from ((f"{place}|{column}", result[:, column]) for column in range(result.shape[1]))
    elif isinstance(result, (np.ndarray, np.generic, bool, int, float)):
        yield place, np.asarray(result, dtype=float).ravel()


def merged(items, place: str):
    """Arrays of the items of a sequence, those of the same place joined to one."""
    together: dict[str, list] = {}
    for item in items:
        for inner, values in arrays(item, f"{place}[]"):
            together.setdefault(inner, []).append(np.ravel(np.asarray(values, dtype=float)))
    yield f"{place}#", [float(len(items))]
    for inner, values in together.items():
        yield inner, np.concatenate(values)


def arrays_of_path(path: Path, place: str):
    """Arrays of a file, or of all files in a folder, where names that differ in digits alone count as one."""
    if path.is_dir():
        together: dict[str, list] = {}
        for file in sorted(inner for inner in path.rglob("*") if inner.is_file()):
            for inner, values in arrays_of_path(file, re.sub(r"\d+", "#", str(file.relative_to(path)))):
                together.setdefault(f"{place}{inner}", []).append(np.ravel(np.asarray(values, dtype=float)))
        yield from ((name, np.concatenate(values)) for name, values in together.items())
    elif path.suffix in {".las", ".laz"}:
        cloud = laspy.read(path)
        for name in ("x", "y", "z", *list(cloud.point_format.dimension_names)[3:]):
            yield f"{place}:{name}", np.asarray(cloud[name], dtype=float)
    elif path.suffix in {".tif", ".png"}:
        with rasterio.open(path) as raster:
            for band in range(1, raster.count + 1):
                yield f"{place}:{band}", raster.read(band)
    elif path.suffix == ".npz":
        with np.load(path) as stored:
            for name in stored.files:
                yield from arrays(stored[name], f"{place}:{name}")
    elif path.suffix == ".gpkg":
        yield from arrays_of_database(path, place)
    else:
        text = gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()
        is_table = path.suffixes[0] == ".csv"
        yield from (columns_of_text if is_table else arrays)(text.decode("utf-8"), place)


def columns_of_text(text: str, place: str):
    """Columns of a table of comma-separated values with a head."""
    head, *rows = (line.split(",") for line in text.splitlines())
    for number, name in enumerate(head):
        yield f"{place}:{name}", [float(found) for row in rows for found in NUMBER.findall(row[number])]


def arrays_of_database(path: Path, place: str):
    """Columns and geometries of a GeoPackage's layers."""
    with closing(sqlite3.connect(path)) as base:
        for (table,) in base.execute("SELECT table_name FROM gpkg_contents ORDER BY table_name").fetchall():
            rows = base.execute(f'SELECT * FROM "{table}"')
            names = [item[0] for item in rows.description]
            for name, values in zip(names, zip(*rows.fetchall())):
                geometries = [shapely.from_wkb(value[8 + ENVELOPES[value[3] >> 1 & 7]:]) if isinstance(value, bytes)
                              else value for value in values]
                yield from arrays([item for item in geometries if item is not None], f"{place}:{table}.{name}")
