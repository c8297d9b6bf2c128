"""Names of coordinate reference systems in the user's language; codes are kept by who shows them."""

from __future__ import annotations

import re
from collections.abc import Callable

from ...wording import known, mark

_ROMAN = {"I": 1, "V": 5, "X": 10}
_PATTERNS: tuple[tuple[re.Pattern[str], str, Callable[[str], object]], ...] = (
    (re.compile(r"(?P<datum>[^/+]+?) / Japan Plane Rectangular CS (?P<zone>[IVX]+)\b"),
     mark("{datum} / Japan Plane Rectangular CS {zone}"), lambda zone: _number(zone)),
    (re.compile(r"(?P<datum>[^/+]+?) / UTM zone (?P<zone>\d+)N\b"), mark("{datum} / UTM zone {zone}N"), str),
    (re.compile(r"(?P<datum>[^/+]+?)(?P<zone>) \(vertical\) height\b"), mark("{datum} (vertical) height"), str),
)
"""Names of EPSG's register, what of them is said in other languages, and how a zone is written there."""


def local_name(name: str) -> str:
    """A system's name in EPSG's register, or a text that holds it, as the user's language has it; else as it is.

    >>> local_name("JGD2011 / Japan Plane Rectangular CS IX")
    'JGD2011 / Japan Plane Rectangular CS IX'
    """
    for pattern, words, zone_of in _PATTERNS:
        local = known(words)
        if local != words:
            def localised(found: re.Match, local: str = local, zone_of: Callable = zone_of) -> str:
                return local.format(datum=found["datum"], zone=zone_of(found["zone"]))

            name = pattern.sub(localised, name)
    return name


def _number(roman: str) -> int:
    """A Roman numeral up to XXXIX as a number."""
    values = [_ROMAN[letter] for letter in roman]
    return sum(-value if value < max(values[place:]) else value for place, value in enumerate(values))
