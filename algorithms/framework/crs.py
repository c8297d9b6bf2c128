"""Checks of coordinate reference systems (CRS): one sentence each, naming the parameter by its label."""

from __future__ import annotations

import re

from qgis.core import QgsCoordinateReferenceSystem, QgsUnitTypes

from ...urbanmap_qgis.errors import InputError
from ...urbanmap_qgis.io.renamed_crs import known_wkt
from .parameters import tr

_HORIZONTAL = re.compile(r"\b(PROJCS|PROJCRS|PROJECTEDCRS|GEOGCS|GEOGCRS|GEODCRS)\[")
_NONE = re.compile(r"^Undefined (geographic|[Cc]artesian) (SRS|coordinate reference system)")
_COMPOUND = re.compile(r"^\s*(COMPD_CS|COMPOUNDCRS)\[")


def wkt_of(crs: QgsCoordinateReferenceSystem) -> str:
    """A CRS as WKT, the form in which it is handed to the core."""
    return known_wkt(crs.toWkt(QgsCoordinateReferenceSystem.WktVariant.WKT_PREFERRED)) if crs.isValid() else ""


def crs_from(crs: QgsCoordinateReferenceSystem | str | None) -> QgsCoordinateReferenceSystem:
    """A QGIS CRS from WKT (as core functions give it) or from a QGIS CRS; an invalid one from nothing.

    A GeoPackage layer without a CRS has one by name; older releases of GDAL hand it on as if it were one.
    """
    if isinstance(crs, QgsCoordinateReferenceSystem):
        return QgsCoordinateReferenceSystem() if _NONE.match(crs.description()) else crs
    return QgsCoordinateReferenceSystem.fromWkt(known_wkt(crs)) if crs else QgsCoordinateReferenceSystem()


def horizontal(crs: QgsCoordinateReferenceSystem | str | None) -> QgsCoordinateReferenceSystem:
    """The horizontal part of a CRS that may also state a height system."""
    wkt = wkt_of(crs_from(crs))
    if not _COMPOUND.match(wkt):
        return crs_from(crs)
    start = _HORIZONTAL.search(wkt).start()
    depth = 0
    for place in range(wkt.index("[", start), len(wkt)):
        depth += {"[": 1, "]": -1}.get(wkt[place], 0)
        if depth == 0:
            return QgsCoordinateReferenceSystem.fromWkt(wkt[start:place + 1])
    return crs_from(crs)


def crs_name(crs: QgsCoordinateReferenceSystem | str | None) -> str:
    """Name of a CRS for messages, such as "EPSG:6677 (JGD2011 / Japan Plane Rectangular CS IX)"."""
    found = crs_from(crs)
    if not found.isValid():
        return tr("no CRS")
    return f"{found.authid()} ({found.description()})" if found.authid() else found.description() or tr("unnamed")


def metres_per_unit(crs: QgsCoordinateReferenceSystem | str) -> float:
    """Length in metres of one unit of a projected CRS (0.3048 for international feet)."""
    plane = horizontal(crs)
    # QGIS takes the US survey foot for the international one; the WKT knows better.
    stated = re.findall(r'LENGTHUNIT\["[^"]*",([0-9.eE+-]+)', wkt_of(plane).rpartition("CS[Cartesian")[2])
    if stated:
        return float(stated[0])
    unit = plane.mapUnits()
    return QgsUnitTypes.fromUnitToUnitFactor(unit, QgsUnitTypes.DistanceUnit.DistanceMeters)


def require_projected(label: str, crs: QgsCoordinateReferenceSystem | str | None) -> None:
    """Refuse a CRS that is missing, geographic or not in metres.

    Raises
    ------
    InputError : with what to do.
    """
    found = crs_from(crs)
    if not found.isValid():
        raise InputError(tr("{0}: the coordinate reference system is missing; assign the one that the data are in "
                            "(for a layer: Layer > Set CRS).").format(label))
    if horizontal(found).isGeographic():
        raise InputError(tr("{0}: coordinates are degrees in {1}; reproject to a projected CRS in metres, such as "
                            "the local plane rectangular or UTM zone.").format(label, crs_name(found)))
    factor = metres_per_unit(found)
    if abs(factor - 1.0) > 1e-9:
        raise InputError(tr("{0}: {1} counts in units of {2:.4f} m; reproject to a CRS in metres.").format(
            label, crs_name(found), factor))


def same_crs(label_a: str, crs_a: QgsCoordinateReferenceSystem | str | None,
             label_b: str, crs_b: QgsCoordinateReferenceSystem | str | None) -> None:
    """Refuse two inputs in different horizontal CRS; heights systems are not compared.

    Raises
    ------
    InputError : they differ, or one has none.
    """
    for label, crs in ((label_a, crs_a), (label_b, crs_b)):
        if not crs_from(crs).isValid():
            raise InputError(tr("{0}: the coordinate reference system is missing; assign the one that the data "
                                "are in.").format(label))
    if not _equal(horizontal(crs_a), horizontal(crs_b)):
        raise InputError(tr("{0} is in {1}, but {2} is in {3}; reproject one of them.").format(
            label_a, crs_name(crs_a), label_b, crs_name(crs_b)))


def _equal(a: QgsCoordinateReferenceSystem, b: QgsCoordinateReferenceSystem) -> bool:
    if a == b:
        return True
    if a.authid() and b.authid():
        return a.authid() == b.authid()
    return a.toProj() == b.toProj() and _datum(a) == _datum(b)


def _datum(crs: QgsCoordinateReferenceSystem) -> str:
    found = re.search(r'\b(?:DATUM|ENSEMBLE)\["(?:D_)?([^"]+)"', wkt_of(crs))
    return re.sub(r"[^a-z0-9]", "", found.group(1).lower()) if found else ""
