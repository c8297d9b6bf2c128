"""GeoPackage and Shapefile: layers, extents and counts from their tables and headers, kinds by a few features."""

from __future__ import annotations

import sqlite3
import struct
from collections.abc import Iterator, Sequence
from contextlib import closing
from pathlib import Path
from urllib.parse import quote

import numpy as np
import shapely

from ...citymodel.named_reference import named_reference
from ...errors import InputError, InsufficientDataError
from ...io.conversion.reprojection import epsg_wkt
from ...io.files.guard import read_text
from ...io.reference.height_systems import heights_of
from ...io.reference.renamed_crs import known_wkt
from ...io.reference.system_parts import is_geographic, parsed_crs
from ...wording import say
from ..file_facts import TABLE, UNKNOWN_HEIGHTS, FileFacts, without_system
from .layer_kind import LayerSample, kind_of_layer

SAMPLE = 200
"""Features of a layer that are looked at."""

_ENVELOPES = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}
"""Bytes of a GeoPackage geometry's envelope by its code (OGC 12-128r18, 2.1.3)."""

_CONTENTS = """SELECT c.table_name, c.min_x, c.min_y, c.max_x, c.max_y, c.srs_id, g.column_name, g.geometry_type_name
FROM gpkg_contents c LEFT JOIN gpkg_geometry_columns g ON g.table_name = c.table_name
WHERE c.data_type IN ('features', 'attributes') ORDER BY c.table_name"""


def geopackage_facts(path: Path, _head: bytes) -> list[FileFacts]:
    """What the layers of a GeoPackage are.

    Raises
    ------
    InputError : it is damaged, or a database of another kind.
    """
    try:
        with closing(sqlite3.connect(f"file:{quote(str(path.resolve()))}?mode=ro&immutable=1", uri=True)) as base:
            if not base.execute("SELECT 1 FROM sqlite_master WHERE name = 'gpkg_contents'").fetchone():
                raise InputError(say("{name} is a database but no GeoPackage: export its layers to a GeoPackage.",
                                     name=path.name))
            rows = base.execute(_CONTENTS).fetchall()
            found = [_layer(path, base, row, len(rows) > 1) for row in rows]
    except sqlite3.DatabaseError as error:
        raise InputError(say("{name} cannot be read as a GeoPackage ({error}): it is damaged or cut off; copy or "
                             "export it again.", name=path.name, error=error)) from error
    if not found:
        raise InsufficientDataError(say("{name} holds no layer: export it again.", name=path.name))
    return found


def _layer(path: Path, base: sqlite3.Connection, row: Sequence, several: bool) -> FileFacts:
    table, *box, srs, geometry, type_name = row
    quoted = table.replace('"', '""')
    count = base.execute(f'SELECT count(*) FROM "{quoted}"').fetchone()[0]  # nosec B608 # the file's own table name
    fields = tuple(item[1] for item in base.execute(f'PRAGMA table_info("{quoted}")'))
    name = table if several else ""
    if geometry is None:
        return FileFacts(path, TABLE, layer=name, count=count)
    crs = _crs_of(base, srs)
    query = f'SELECT "{geometry}" FROM "{quoted}" LIMIT {SAMPLE}'  # nosec B608 # the file's own names
    shapes = [shapely.from_wkb(blob[8 + _ENVELOPES[(blob[3] >> 1) & 7]:])
              for (blob,) in base.execute(query) if blob and blob[:2] == b"GP"]
    extent = tuple(map(float, box)) if None not in box else _bounds(shapes)
    return layer_facts(path, name, LayerSample((path.stem, table), fields, type_name, shapes), crs, extent, count)


def _crs_of(base: sqlite3.Connection, srs: int) -> str:
    row = base.execute("SELECT organization, organization_coordsys_id, definition FROM gpkg_spatial_ref_sys "
                       "WHERE srs_id = ?", (srs,)).fetchone()
    if row is None or srs in (0, -1):
        return ""
    if str(row[0]).upper() == "EPSG":
        try:
            return epsg_wkt(int(row[1]))
        except InputError:  # a code newer than the database here: the file says it in full
            return known_wkt(row[2])
    return known_wkt(row[2]) if row[2] and row[2] != "undefined" else ""


def layer_facts(path: Path, layer: str, sample: LayerSample, crs: str, extent, count: int) -> FileFacts:
    """Facts of a vector layer; `extent` in its own system or None."""
    kind, doubt = kind_of_layer(sample, is_geographic(crs))
    problem = "" if count else say("{name} holds no feature: choose another file.", name=layer or path.name)
    return FileFacts(path, kind, layer=layer, crs_wkt=crs, heights=heights_of(crs).word, extent=extent, count=count,
                     detail=sample.type_name, doubt=doubt, notes=without_system(path.name, crs), problem=problem)


def named_system(name: str, path: Path) -> tuple[str, str]:
    """WKT in plan and heights, in a word, of a system that a file names; "" and "unknown" where it is not known."""
    try:
        reference = named_reference(name, path.name).reference
    except InputError:  # the reader of such files says so
        return "", UNKNOWN_HEIGHTS
    return reference.wkt, reference.heights


def _bounds(shapes: Sequence[shapely.Geometry]) -> tuple[float, float, float, float] | None:
    box = shapely.total_bounds(np.array(shapes, dtype=object)) if shapes else np.full(4, np.nan)
    x_min, y_min, x_max, y_max = map(float, box)
    return (x_min, y_min, x_max, y_max) if np.isfinite(box).all() else None


_SHAPES = {1: "Point", 3: "LineString", 5: "Polygon", 8: "MultiPoint", 11: "PointZ", 13: "LineStringZ",
           15: "PolygonZ", 18: "MultiPointZ", 23: "LineStringM", 25: "PolygonM", 31: "MultiPatch"}


def shapefile_facts(path: Path, head: bytes) -> list[FileFacts]:
    """What a shapefile (.shp) is. Source: ESRI Shapefile Technical Description, 1998.

    Raises
    ------
    InputError : it is shorter than it says.
    """
    if len(head) < 100:
        raise InputError(say("{name} is cut off: copy or download it again.", name=path.name))
    words, = struct.unpack(">i", head[24:28])
    if 2 * words > path.stat().st_size:
        raise InputError(say("{name} is cut off: it says that it has {said} bytes, but has {bytes}; copy or "
                             "download it again.", name=path.name, said=2 * words, bytes=path.stat().st_size))
    kind, = struct.unpack("<i", head[32:36])
    extent = struct.unpack("<4d", head[36:68])
    prj, table = path.with_suffix(".prj"), path.with_suffix(".dbf")
    crs = _prj_wkt(prj) if prj.is_file() else ""
    count, fields = _dbf_head(table) if table.is_file() else (None, ())
    try:
        shapes = list(_shapes(path)) if kind in (5, 15, 25) else []
    except shapely.errors.GEOSException as error:
        raise InputError(say("{name} has a polygon with corners that are no numbers: it is damaged; copy or export it "
                             "again.", name=path.name)) from error
    sample = LayerSample((path.stem,), fields, _SHAPES.get(kind, "?"), shapes)
    facts = layer_facts(path, "", sample, crs, extent, count or len(shapes) or 1)
    if table.is_file():
        return [facts]
    return [FileFacts(path, facts.kind, crs_wkt=crs, extent=extent, problem=say(
        "{name} lies alone: put its .dbf and .shx beside it.", name=path.name))]


def _prj_wkt(path: Path) -> str:
    try:
        return parsed_crs(read_text(path, "a reference system (.prj)").strip()).to_wkt()
    except InputError:
        return ""


def _dbf_head(path: Path) -> tuple[int, tuple[str, ...]]:
    """Number of records and names of the fields."""
    data = path.read_bytes()[:8192]
    count, = struct.unpack("<I", data[4:8])
    names, at = [], 32
    while at + 32 <= len(data) and data[at] != 0x0d:
        names.append(data[at:at + 11].split(b"\0")[0].decode("cp932", "replace"))
        at += 32
    return count, tuple(names)


def _shapes(path: Path) -> Iterator[shapely.Geometry]:
    """The first polygons of a shapefile, each by its rings; heights are left out."""
    with path.open("rb") as stream:
        stream.seek(100)
        for _ in range(SAMPLE):
            header = stream.read(8)
            if len(header) < 8:
                return
            record = stream.read(2 * struct.unpack(">i", header[4:])[0])
            if len(record) < 44 or struct.unpack("<i", record[:4])[0] == 0:
                continue
            parts, points = struct.unpack("<2i", record[36:44])
            starts = [*struct.unpack(f"<{parts}i", record[44:44 + 4 * parts]), points]
            places = np.frombuffer(record, "<f8", 2 * points, 44 + 4 * parts).reshape(-1, 2)
            yield shapely.multipolygons([shapely.polygons(places[a:b]) for a, b in zip(starts[:-1], starts[1:])
                                         if b - a >= 4])
