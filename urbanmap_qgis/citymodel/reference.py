"""Codes of reference systems that say plane and heights together."""

from __future__ import annotations

from ..errors import InputError
from ..io.reference.height_systems import height_system, heights_of, same_heights
from ..io.reference.system_parts import horizontal_part, own_code
from ..wording import say
from .model import CityReference

JGD2011, JGD2024 = "JGD2011", "JGD2024"
PLANE_ZONES = range(6669, 6688)
"""EPSG codes of Japan's plane rectangular zones I to XIX; JGD2011 and JGD2024 have the same."""

_COMPOUND_2011 = range(10162, 10175)
"""Codes with heights in JGD2011, zones I to XIII."""

GEOGRAPHIC, GEOGRAPHIC_2011, GEOGRAPHIC_2024 = 6668, 6697, 11318
"""Codes of latitude and longitude, and with heights in JGD2011 and JGD2024."""

PLATEAU_SYSTEMS = frozenset({*PLANE_ZONES, GEOGRAPHIC, GEOGRAPHIC_2011, GEOGRAPHIC_2024})
"""Codes of systems whose models are written as PLATEAU has them."""


def compound_epsg(reference: CityReference) -> int | None:
    """Code of plane and heights together where EPSG has one, else the plane's; None where that has none."""
    code = reference.epsg
    if code in (GEOGRAPHIC, GEOGRAPHIC_2011, GEOGRAPHIC_2024):
        return {JGD2011: GEOGRAPHIC_2011, JGD2024: GEOGRAPHIC_2024}.get(reference.heights, code)
    if reference.heights == JGD2011 and code in PLANE_ZONES and code - PLANE_ZONES[0] < len(_COMPOUND_2011):
        return _COMPOUND_2011[code - PLANE_ZONES[0]]
    return code


def city_reference(wkt: str, heights: str = "") -> CityReference:
    """Reference of coordinates by its WKT, and of heights by a word where the WKT does not state them.

    Parameters
    ----------
    heights : "JGD2011", "JGD2024", "ellipsoidal", "EPSG:<code>" ...; empty for what the WKT says.

    Raises
    ------
    InputError : the word names no height system, or another one than the WKT.
    """
    stated, given = heights_of(wkt), height_system(heights)
    if given.known and stated.known and not same_heights(given, stated):
        raise InputError(say("The models state heights in {stated}, not in {given}: convert them first, or leave the "
                             "height system out.", stated=stated, given=given))
    plane = horizontal_part(wkt)
    system = stated if stated.known else given
    return CityReference(wkt, None if plane is None else own_code(plane),
                         plane is not None and not plane.is_projected, system.word)
