"""Coordinate reference systems that EPSG has renamed, under the names that every release of PROJ knows."""

from __future__ import annotations

import re

# Since 2026 EPSG calls the horizontal systems JGD2011 (codes 6666 to 6692) JGD2024. Newer databases know the old names
# too, older ones do not know the new. Names of heights, "JGD2024 (vertical) height", are other systems and stay.
_NAMES = (
    (re.compile(r'"JGD2024(?="| / | \+ )'), '"JGD2011'),
    (re.compile(r'"(?:D_)?Japanese[ _]Geodetic[ _]Datum[ _]2024"'), '"Japanese Geodetic Datum 2011"'),
)


def known_wkt(wkt: str) -> str:
    """WKT of a CRS in which Japan's horizontal systems have the names from before they were renamed."""
    if "2024" not in wkt:
        return wkt
    for pattern, name in _NAMES:
        wkt = pattern.sub(name, wkt)
    return wkt
