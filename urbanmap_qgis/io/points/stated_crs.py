"""Where a point cloud lies by its own statements: the WKT record, the GeoTIFF keys, and the bit that says which counts.

LAS 1.0 to 1.4 may hold both (ASPRS LAS 1.4, 2.4 and 3). GeoTIFF 1.1, 7.3 to 7.5: the keys of the vertical system and of
the units beside the projected system, which laspy does not read.
"""

from __future__ import annotations

import os
from pathlib import Path

import laspy
from laspy.vlrs.known import GeoKeyDirectoryVlr, WktCoordinateSystemVlr
from pyproj import CRS
from pyproj.exceptions import CRSError

from ...errors import InputError
from ...progress import notice
from ...wording import say
from ..reference.height_systems import HeightSystem, height_system, stating_heights
from ..reference.renamed_crs import known_wkt
from ..reference.system_parts import same_horizontal

_PLAN_UNITS, _VERTICAL, _VERTICAL_UNITS = 3076, 4096, 4099
_CODES = range(1024, 32767)
"""Values that are EPSG codes (GeoTIFF 1.1, 7.4 and 7.5)."""

_METRES = {9001: 1.0, 9002: 0.3048, 9003: 1200 / 3937}
"""Metres of a unit of length by its EPSG code."""

_ELLIPSOIDS = range(5001, 5034)
"""Codes of old files for heights above an ellipsoid, which no compound system states."""


def stated_crs(path: str | os.PathLike, header: laspy.LasHeader) -> CRS | None:
    """The reference system that a file states, with its heights where it states these too; None where it states none.

    Of a WKT and of GeoTIFF keys that differ, that one counts which the header's bit “WKT” says, and the user is told.

    Raises
    ------
    InputError : what is stated cannot be understood, or its units contradict it.
    """
    path = Path(path)
    wkt, keys = (_records(header, kind) for kind in (WktCoordinateSystemVlr, GeoKeyDirectoryVlr))
    found = [_understood(path, read, records[-1]) for read, records in ((_of_wkt, wkt), (_of_keys, keys)) if records]
    first = 0 if header.global_encoding.wkt or not keys else len(found) - 1
    usable = [crs for crs in (found[first:] + found[:first]) if crs is not None]
    if not usable:
        return None
    for other in usable[1:]:
        if not same_horizontal(other.to_wkt(), usable[0].to_wkt()):
            notice(say("{path} states two reference systems: {crs} counts, as its header says, and not {other}.",
                       path=path.name, crs=usable[0].name, other=other.name))
    return usable[0]


def _records(header: laspy.LasHeader, kind: type) -> list:
    return [record for record in [*header.vlrs, *(header.evlrs or [])] if isinstance(record, kind)]


def _understood(path: Path, read, record) -> CRS | None:
    try:
        return read(path, record)
    except CRSError as error:
        raise InputError(say("The coordinate reference system in {path} cannot be understood: set it right in the "
                             "file.", path=path.name)) from error


def _of_wkt(_path: Path, record: WktCoordinateSystemVlr) -> CRS | None:
    """The system of a WKT record; None of one that ties its coordinates to no place on earth."""
    text = known_wkt(record.string.strip("\0 \n"))
    crs = CRS.from_wkt(text) if text else None
    return None if crs is None or crs.is_engineering else crs


def _of_keys(path: Path, record: GeoKeyDirectoryVlr) -> CRS | None:
    crs = record.parse_crs()
    if crs is None:
        return None
    keys = {key.id: key.value_offset for key in record.geo_keys if key.tiff_tag_location == 0}
    unit = _METRES.get(keys.get(_PLAN_UNITS, 0))
    if unit and crs.is_projected and abs(crs.axis_info[0].unit_conversion_factor / unit - 1.0) > 1e-9:
        raise InputError(say("{path} contradicts itself: {crs} counts in units of {own:.4f} m, and the file says that "
                             "its units are {unit:.4f} m. Give the reference system that it is in.",
                             path=path.name, crs=crs.name, own=crs.axis_info[0].unit_conversion_factor, unit=unit))
    return _with_heights(crs, keys.get(_VERTICAL, 0), _METRES.get(keys.get(_VERTICAL_UNITS, 0)))


def _with_heights(plan: CRS, code: int, unit: float | None) -> CRS:
    """The system with the heights that the keys state: their EPSG code, and metres of their unit."""
    if code not in _CODES or code in _ELLIPSOIDS:
        return plan if unit in (None, 1.0) else CRS.from_wkt(stating_heights(
            plan.to_wkt(), HeightSystem("other", None, "heights"), unit=unit))
    system = height_system(f"EPSG:{code}")
    try:
        own = CRS.from_epsg(code)
        system = system if system.name else HeightSystem(system.kind, code, own.name)
        unit = unit or own.axis_info[0].unit_conversion_factor
    except CRSError:  # a code that this release of PROJ does not know is carried as such
        unit = unit or 1.0
    return CRS.from_wkt(stating_heights(plan.to_wkt(), system, unit=unit))
