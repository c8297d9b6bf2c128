"""Codes of reference systems that say plane and heights together."""

from __future__ import annotations

from .model import CityReference

JGD2011, JGD2024 = "JGD2011", "JGD2024"
PLANE_ZONES = range(6669, 6688)
"""EPSG codes of Japan's plane rectangular zones I to XIX; JGD2011 and JGD2024 have the same."""

_COMPOUND_2011 = range(10162, 10175)
"""Codes with heights in JGD2011, zones I to XIII."""

GEOGRAPHIC, GEOGRAPHIC_2011, GEOGRAPHIC_2024 = 6668, 6697, 11318
"""Codes of latitude and longitude, and with heights in JGD2011 and JGD2024."""


def compound_epsg(reference: CityReference) -> int | None:
    """Code of plane and heights together where EPSG has one, else the plane's; None where that has none."""
    code = reference.epsg
    if code in (GEOGRAPHIC, GEOGRAPHIC_2011, GEOGRAPHIC_2024):
        return {JGD2011: GEOGRAPHIC_2011, JGD2024: GEOGRAPHIC_2024}.get(reference.heights, code)
    if reference.heights == JGD2011 and code in PLANE_ZONES and code - PLANE_ZONES[0] < len(_COMPOUND_2011):
        return _COMPOUND_2011[code - PLANE_ZONES[0]]
    return code
