"""Reference systems as city models name them: codes in addresses and URNs, with the order of their axes.

Source: OGC 07-092r1 (URNs of reference systems), OGC 11-135r2 (addresses of them), GeoInfoDok 7.1 of the AdV (names
that German surveys write).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from pyproj import CRS
from pyproj.exceptions import CRSError

from ..errors import InputError
from ..io.reference.height_systems import HeightSystem, height_system, heights_of
from ..io.reference.system_parts import horizontal_part, parsed_crs, plan_part
from ..wording import say
from .model import CityReference
from .reference import GEOGRAPHIC, GEOGRAPHIC_2024, JGD2024

_CODES = re.compile(r"EPSG(?:\.xml#|[/: _]+(?:[a-z]\w*:)?(?:[\d.]*[/:])?)(\d{4,6})(?:\+(?:EPSG:)?(\d{4,6}))?",
                    re.IGNORECASE)
_EAST_FIRST = re.compile(r"EPSG[: _]|.*\.xml#", re.IGNORECASE)
_CRS84 = re.compile(r"\bCRS:?84(h?)\Z", re.IGNORECASE)
_ADV = "urn:adv:crs:"
_ADV_PLANES = {
    "etrs89_utm31": 25831, "etrs89_utm32": 25832, "etrs89_utm33": 25833, "de_dhdn_3gk2": 31466, "de_dhdn_3gk3": 31467,
    "de_dhdn_3gk4": 31468, "de_dhdn_3gk5": 31469, "de_42-83_3gk3": 2397, "de_42-83_3gk4": 2398, "de_42-83_3gk5": 2399,
    "de_rd-83_3gk4": 3398, "de_rd-83_3gk5": 3399, "etrs89_lat-lon-h": 4937, "etrs89_lat-lon": 4258,
    "de_dhdn_lat-lon": 4314}
"""EPSG codes of the AdV's systems in plan; the names of a land's own realisations have more behind ("_NW101")."""

_ADV_HEIGHTS = {"de_dhhn12": 7699, "de_dhhn85": 5784, "de_dhhn92": 5783, "de_dhhn2016": 7837, "de_snn76": 5785}
"""EPSG codes of the AdV's height systems; behind the names stands the kind of height ("_NH")."""


@dataclass(frozen=True)
class NamedReference:
    """A reference, and whether the first coordinate in the file is the northern one."""

    reference: CityReference
    swapped: bool


def named_reference(name: str, where: str, given: CityReference | None = None) -> NamedReference:
    """The reference that a name means: "http://www.opengis.net/def/crs/EPSG/0/6697", "urn:ogc:def:crs,crs:EPSG::25832,
    crs:EPSG::5783", "EPSG:6677", "EPSG:25832+7837", "urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH", "OGC:CRS84".

    Addresses and URNs have the axes in the order of EPSG; the short form, "epsg.xml#6677" and the AdV's count east
    first.

    Parameters
    ----------
    given : counts where the name is not known.

    Raises
    ------
    InputError : the name or its code is not known here, and none is given.
    """
    try:
        return _known_reference(name.strip(), where)
    except InputError:
        if given is None:
            raise
        return NamedReference(given, False)


def _known_reference(name: str, where: str) -> NamedReference:
    codes, ordered = _codes(name)
    if not codes:
        raise InputError(say("{where}: the coordinate reference system {name} is not known; give the one that it is "
                             "in.", where=where, name=name))
    if codes[0] == GEOGRAPHIC_2024:
        reference = CityReference(_wkt(GEOGRAPHIC, where).to_wkt(), GEOGRAPHIC, True, JGD2024)
        return NamedReference(reference, ordered)
    crs = _wkt(codes[0], where)
    heights = height_system(f"EPSG:{codes[1]}") if len(codes) > 1 else _coded_heights(crs)
    plane = plan_part(crs)
    epsg = plane.to_epsg() or codes[0]
    first = plane.axis_info[0].direction.lower() if plane.axis_info else "east"
    return NamedReference(CityReference(plane.to_wkt(), epsg, plane.is_geographic, heights.word),
                          ordered and first == "north")


def _codes(name: str) -> tuple[list[int], bool]:
    """EPSG codes in a name, of the plane and maybe of the heights, and whether axes have the order of EPSG."""
    if name.lower().startswith(_ADV):
        plane, *heights = name[len(_ADV):].lower().split("*")
        return [*_of_table(plane, _ADV_PLANES),
                *(code for part in heights for code in _of_table(part, _ADV_HEIGHTS))], "lat-lon" in plane
    own = _CRS84.search(name)
    if own:
        return [4979 if own[1] else 4326], False
    if re.fullmatch(r"\d{4,6}", name):
        return [int(name)], False
    return [int(code) for found in _CODES.findall(name) for code in found if code], not _EAST_FIRST.match(name)


def _of_table(name: str, codes: dict[str, int]) -> list[int]:
    """The code of the entry that a name starts with, as a list of one; empty where none is."""
    return [code for word, code in codes.items() if re.match(re.escape(word) + r"(?![0-9a-z])", name)][:1]


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
    plane = horizontal_part(wkt)
    if plane is None:
        raise InputError(say("The coordinate reference system has no horizontal part: choose another."))
    return CityReference(plane.to_wkt(), plane.to_epsg(), plane.is_geographic,
                         _coded_heights(parsed_crs(wkt)).word)
