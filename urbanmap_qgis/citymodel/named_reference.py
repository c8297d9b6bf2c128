"""Reference systems as city models name them: codes in addresses and URNs, with the order of their axes.

Source: OGC 07-092r1 (URNs of reference systems), OGC 11-135r2 (addresses of them).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from pyproj import CRS
from pyproj.exceptions import CRSError

from ..errors import InputError
from ..io.reference.crs_text import horizontal_part, parse_wkt, wkt_text
from ..io.reference.height_systems import HeightSystem, height_system, heights_of
from ..wording import say
from .model import CityReference
from .reference import GEOGRAPHIC, GEOGRAPHIC_2024, JGD2024

_CODES = re.compile(r"EPSG(?:/|:)+(?:[\d.]*(?:/|:))?(\d{4,6})", re.IGNORECASE)


@dataclass(frozen=True)
class NamedReference:
    """A reference, and whether the first coordinate in the file is the northern one."""

    reference: CityReference
    swapped: bool


def named_reference(name: str, where: str) -> NamedReference:
    """The reference that a name means: "http://www.opengis.net/def/crs/EPSG/0/6697", "urn:ogc:def:crs,crs:EPSG::25832,
    crs:EPSG::5783", "EPSG:6677".

    Addresses and URNs have the axes in the order of EPSG; the short form counts east first.

    Raises
    ------
    InputError : the name or its code is not known here.
    """
    codes = [int(code) for code in _CODES.findall(name)]
    if not codes:
        raise InputError(say("{where}: the coordinate reference system {name} is not known; give the one that it is "
                             "in.", where=where, name=name))
    ordered = not re.match(r"\s*EPSG:", name, re.IGNORECASE)
    if codes[0] == GEOGRAPHIC_2024:
        reference = CityReference(_wkt(GEOGRAPHIC, where).to_wkt(), GEOGRAPHIC, True, JGD2024)
        return NamedReference(reference, ordered)
    crs = _wkt(codes[0], where)
    heights = height_system(f"EPSG:{codes[1]}") if len(codes) > 1 else _coded_heights(crs)
    plane = CRS.from_wkt(wkt_text(horizontal_part(parse_wkt(crs.to_wkt()))))
    epsg = plane.to_epsg() or codes[0]
    first = plane.axis_info[0].direction.lower() if plane.axis_info else "east"
    return NamedReference(CityReference(plane.to_wkt(), epsg, plane.is_geographic, heights.word),
                          ordered and first == "north")


def _coded_heights(crs: CRS) -> HeightSystem:
    """Height system of a CRS, with its code: the text of a compound system names its parts without theirs."""
    heights = heights_of(crs.to_wkt())
    if heights.kind != "other" or heights.epsg:
        return heights
    return replace(heights, epsg=next((part.to_epsg() for part in crs.sub_crs_list if part.is_vertical), None))


def _wkt(code: int, where: str) -> CRS:
    try:
        return CRS.from_epsg(code)
    except CRSError as error:
        raise InputError(say("{where}: the coordinate reference system EPSG:{code} is not known here; give the one "
                             "that it is in.", where=where, code=code)) from error


def given_reference(wkt: str) -> CityReference:
    """The reference that a user gives for files that name none; x is taken to be east.

    Raises
    ------
    InputError : it is no horizontal system.
    """
    part = horizontal_part(parse_wkt(wkt))
    if part is None:
        raise InputError(say("The coordinate reference system has no horizontal part: choose another."))
    plane = CRS.from_wkt(wkt_text(part))
    return CityReference(plane.to_wkt(), plane.to_epsg(), plane.is_geographic,
                         _coded_heights(CRS.from_wkt(wkt)).word)
