"""Writes the layers of the sample city as GeoPackage, without GDAL: tables of SQLite (OGC 12-128r17)."""

from __future__ import annotations

import sqlite3
import struct
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyproj
import shapely

from ..scene.world import CRS, SURVEYED

_SCHEMA = """
CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER NOT NULL PRIMARY KEY,
  organization TEXT NOT NULL, organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
CREATE TABLE gpkg_contents (table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE,
  description TEXT DEFAULT '', last_change DATETIME NOT NULL, min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE,
  srs_id INTEGER REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (table_name TEXT NOT NULL UNIQUE REFERENCES gpkg_contents(table_name),
  column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL, srs_id INTEGER NOT NULL, z TINYINT NOT NULL,
  m TINYINT NOT NULL, PRIMARY KEY (table_name, column_name));
"""
_TYPES = {int: "INTEGER", float: "DOUBLE", str: "TEXT", bool: "BOOLEAN"}
_ADD_COLUMN = {kind: f'ALTER TABLE "%w" ADD COLUMN "%w" {kind}' for kind in _TYPES.values()}


@dataclass(frozen=True)
class Layer:
    """A layer: geometries of one type and, for each field, as many values (int, float, str or bool)."""

    name: str
    geometries: Sequence[shapely.Geometry]
    fields: Mapping[str, Sequence]


def write_geopackage(path: Path, layers: Sequence[Layer], crs: str = CRS) -> None:
    """Write the layers into a new GeoPackage at `path`, in the CRS ("EPSG:...")."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with closing(sqlite3.connect(str(path))) as connection, connection:
        connection.executescript("PRAGMA application_id = 0x47504B47; PRAGMA user_version = 10300;" + _SCHEMA)
        srs = _write_crs(connection, crs)
        for layer in layers:
            _write_layer(connection, layer, srs)


def _write_crs(connection: sqlite3.Connection, crs: str) -> int:
    srs = int(crs.partition(":")[2])
    systems = [("Undefined Cartesian SRS", -1, "NONE", -1, "undefined", None),
               ("Undefined geographic SRS", 0, "NONE", 0, "undefined", None)]
    systems += [(pyproj.CRS.from_epsg(code).name, code, "EPSG", code,
                 pyproj.CRS.from_epsg(code).to_wkt("WKT1_GDAL"), None) for code in sorted({4326, srs})]
    connection.executemany("INSERT INTO gpkg_spatial_ref_sys VALUES (?, ?, ?, ?, ?, ?)", systems)
    return srs


def _write_layer(connection: sqlite3.Connection, layer: Layer, srs: int) -> None:
    geometries = np.asarray(layer.geometries, dtype=object)
    has_z = bool(shapely.has_z(geometries).any())
    kinds = {geometry.geom_type.upper() for geometry in geometries}
    _named(connection, 'CREATE TABLE "%w" (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom BLOB)', layer.name)
    for name, values in layer.fields.items():
        _named(connection, _ADD_COLUMN[_type_of(values)], layer.name, name)
    bounds = [float(edge) for edge in shapely.total_bounds(geometries)] if len(geometries) else [None] * 4
    connection.execute("INSERT INTO gpkg_contents VALUES (?, 'features', ?, '', ?, ?, ?, ?, ?, ?)",
                       (layer.name, layer.name, f"{SURVEYED.isoformat()}T00:00:00.000Z", *bounds, srs))
    connection.execute("INSERT INTO gpkg_geometry_columns VALUES (?, 'geom', ?, ?, ?, 0)",
                       (layer.name, kinds.pop() if len(kinds) == 1 else "GEOMETRY", srs, int(has_z)))
    header = b"GP\x00\x01" + struct.pack("<i", srs)
    blobs = [header + blob for blob in shapely.to_wkb(geometries, byte_order=1, flavor="iso")]
    plain = [[_plain(value) for value in values] for values in layer.fields.values()]
    names, marks = ', "%w"' * len(plain), ", ?" * len(plain)
    # SQLite itself quotes the names that `_statement` is given.
    pattern = 'INSERT INTO "%w" (geom' + names + ") VALUES (?" + marks + ")"  # nosec B608
    insert = _statement(connection, pattern, layer.name, *layer.fields)
    connection.executemany(insert, zip(blobs, *plain))


def _statement(connection: sqlite3.Connection, pattern: str, *names: str) -> str:
    """A statement in which SQLite has put names of tables and columns for each %w, quoted as it needs them."""
    marks = ", ".join("?" * len(names))
    (statement,) = connection.execute("SELECT printf(?, " + marks + ")", (pattern, *names)).fetchone()
    return statement


def _named(connection: sqlite3.Connection, pattern: str, *names: str) -> None:
    connection.execute(_statement(connection, pattern, *names))


def _type_of(values: Sequence) -> str:
    """SQL type of a column: that of its first value that is not None."""
    known = next((value for value in map(_plain, values) if value is not None), "")
    return _TYPES[type(known)]


def _plain(value: object) -> object:
    """The value as a plain Python number or text."""
    return value.item() if isinstance(value, np.generic) else value
