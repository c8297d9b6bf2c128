"""Checks of coordinate reference systems (CRS): one sentence each, naming the parameter by its label."""

from __future__ import annotations

import re

from qgis.core import QgsCoordinateReferenceSystem, QgsUnitTypes

from ....urbanmap_qgis.errors import InputError
from ....urbanmap_qgis.io.reference.renamed_crs import known_wkt
from ..declaring.parameters import tr

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
    return _from_wkt(crs) if crs else QgsCoordinateReferenceSystem()


def _from_wkt(wkt: str) -> QgsCoordinateReferenceSystem:
    """A QGIS CRS that keeps the heights where QGIS can.

    QGIS 3.22 knows of EPSG's compound systems the horizontal part only: they are spelt out for it. Releases that know
    vertical systems (3.38 and later) take compound systems by their codes; layers in one without a code come back from
    a GeoPackage with an empty CRS there, so of such a system only the horizontal part is taken.
    """
    from ....urbanmap_qgis.io.reference.height_systems import stating_heights

    found = QgsCoordinateReferenceSystem.fromWkt(known_wkt(wkt))
    if not _COMPOUND.match(wkt) or not found.isValid():
        return found
    if hasattr(found, "verticalCrs"):
        return QgsCoordinateReferenceSystem(found.authid()) if found.authid() else found.horizontalCrs()
    stated = heights(wkt)
    if not stated.known or heights(wkt_of(found)) == stated:
        return found
    compound = QgsCoordinateReferenceSystem.fromWkt(stating_heights(wkt_of(found), stated, coded=False))
    return compound if compound.isValid() else found


def heights(crs: QgsCoordinateReferenceSystem | str | None):
    """The height system that a CRS states, as the core's `HeightSystem`; `UNKNOWN` where it states none."""
    from ....urbanmap_qgis.io.reference.height_systems import UNKNOWN, heights_of

    if not isinstance(crs, QgsCoordinateReferenceSystem):
        return heights_of(crs or "")
    return heights_of(stated_wkt(crs)) if crs.isValid() else UNKNOWN


def stated_wkt(crs: QgsCoordinateReferenceSystem | str | None) -> str:
    """A CRS as WKT with all that it states of heights, also where QGIS keeps only the plane of a code that it knows."""
    if not isinstance(crs, QgsCoordinateReferenceSystem):
        return crs or ""
    code = re.fullmatch(r"EPSG:(\d+)", crs.authid())
    return stated_by_code(int(code.group(1))) or wkt_of(crs) if code else wkt_of(crs)


def stated_by_code(epsg: int) -> str:
    """WKT of a compound system by its code; empty for others and where the code is not known."""
    from pyproj import CRS
    from pyproj.exceptions import CRSError

    try:
        found = CRS.from_epsg(epsg)
    except CRSError:
        return ""
    return found.to_wkt() if found.is_compound else ""


def horizontal(crs: QgsCoordinateReferenceSystem | str | None) -> QgsCoordinateReferenceSystem:
    """The horizontal part of a CRS that may also state a height system."""
    wkt = wkt_of(crs_from(crs))
    if not _COMPOUND.match(wkt):
        return crs_from(crs)
    from ....urbanmap_qgis.io.reference.system_parts import horizontal_part, own_code

    part = horizontal_part(wkt)
    if part is None:
        return crs_from(crs)
    code = own_code(part)
    return QgsCoordinateReferenceSystem(f"EPSG:{code}") if code else QgsCoordinateReferenceSystem.fromWkt(
        part.to_wkt())


def crs_name(crs: QgsCoordinateReferenceSystem | str | None) -> str:
    """Name of a CRS for messages, such as "EPSG:6677 (JGD2011 / Japan Plane Rectangular CS IX)"."""
    from ....urbanmap_qgis.io.reference.system_names import local_name

    found = crs_from(crs)
    if not found.isValid():
        return tr("no CRS")
    name = local_name(found.description())
    return f"{found.authid()} ({name})" if found.authid() else name or tr("unnamed")


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
    """Refuse a CRS that is missing, geographic or not in metres, in plan or in the heights that it states.

    Raises
    ------
    InputError : with what to do.
    """
    from ....urbanmap_qgis.io.reference.height_systems import height_unit

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
    factor = height_unit(stated_wkt(crs))
    if abs(factor - 1.0) > 1e-9:
        raise InputError(tr("{0}: {1} counts heights in units of {2:.4f} m; convert them to metres and assign a CRS "
                            "that says so.").format(label, crs_name(found), factor))


def same_crs(label_a: str, crs_a: QgsCoordinateReferenceSystem | str | None,
             label_b: str, crs_b: QgsCoordinateReferenceSystem | str | None) -> None:
    """Refuse two inputs in different horizontal CRS, or whose heights are stated and differ.

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
    same_heights(label_a, crs_a, label_b, crs_b)


def same_heights(label_a: str, crs_a: QgsCoordinateReferenceSystem | str | None,
                 label_b: str, crs_b: QgsCoordinateReferenceSystem | str | None) -> None:
    """Refuse two inputs that both state a height system, but not the same.

    Raises
    ------
    InputError : they differ.
    """
    from ....urbanmap_qgis.io.reference.height_systems import refuse_other_heights

    refuse_other_heights(label_a, stated_wkt(crs_a), label_b, stated_wkt(crs_b))


def same_plan(a: QgsCoordinateReferenceSystem | str | None, b: QgsCoordinateReferenceSystem | str | None) -> bool:
    """Whether two CRS have the same horizontal part."""
    return _equal(horizontal(a), horizontal(b))


def _equal(a: QgsCoordinateReferenceSystem, b: QgsCoordinateReferenceSystem) -> bool:
    from ....urbanmap_qgis.io.reference.system_parts import datum_key, parsed_crs, same_horizontal

    if a == b:
        return True
    if a.authid() and b.authid() and not a.isGeographic():
        return a.authid() == b.authid()
    if same_horizontal(wkt_of(a), wkt_of(b)):
        return True
    # Parameters under other programs' names: PROJ knows them all, but not the datum.
    return a.toProj() == b.toProj() and datum_key(parsed_crs(wkt_of(a))) == datum_key(parsed_crs(wkt_of(b)))
