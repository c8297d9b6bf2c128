"""What heights count from: the height systems of Japan, of other countries and of the ellipsoid, as explicit data.

Japan's heights were renewed in April 2025: JGD2024 differs from JGD2011 by up to +57 and -67 cm while the plane
coordinates stayed. EPSG's codes: JGD2000 6694, JGD2011 6695, JGD2024 11317. Not every database of reference systems
knows the last, so that a system is written out in full where its code may be unknown.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from ...errors import InputError
from ...wording import say
from .system_parts import horizontal_part, own_code, parsed_crs, vertical_part

JAPANESE = {"JGD2000": 6694, "JGD2011": 6695, "JGD2024": 11317}
"""EPSG code of each of Japan's height systems."""

# EPSG's compound systems of Japan by the height systems in them; the zones of the plane coordinates are in the names.
_COMPOUND_OF = {"JGD2000": frozenset({6696}), "JGD2011": frozenset({6697, *range(10162, 10175)}),
                "JGD2024": frozenset({*range(11318, 11331), 11333, 11336, 11434, *range(11442, 11446)})}
_SPELT_OUT = "Heights in "
"""Begins the name of a vertical system that is written without its code."""

_YEAR = re.compile(r"(?:JGD|Japanese_?\s*Geodetic_?\s*Datum_?)\s*_?(2000|2011|2024)", re.IGNORECASE)


@dataclass(frozen=True)
class HeightSystem:
    """What heights count from.

    Attributes
    ----------
    kind : "unknown", "JGD2000", "JGD2011", "JGD2024", "ellipsoidal" or "other".
    epsg : code of the vertical system; None where it has none or it is not known.
    name : as the source calls it.
    """

    kind: str = "unknown"
    epsg: int | None = None
    name: str = ""

    @property
    def known(self) -> bool:
        """Whether anything is known of it."""
        return self.kind != "unknown"

    @property
    def word(self) -> str:
        """The system in one word, as models and fields carry it: "JGD2011", "ellipsoidal", "EPSG:5709", "unknown"."""
        if self.kind != "other":
            return self.kind
        return f"EPSG:{self.epsg}" if self.epsg else self.name or "unknown"

    def __str__(self) -> str:
        code = f" (EPSG:{self.epsg})" if self.epsg else ""
        return f"{self.name or self.kind}{code}" if self.kind == "other" else f"{self.kind}{code}"


UNKNOWN = HeightSystem()
ELLIPSOIDAL = HeightSystem("ellipsoidal", None, "ellipsoidal height")


def japanese(kind: str) -> HeightSystem:
    """One of Japan's height systems: "JGD2000", "JGD2011" or "JGD2024"."""
    return HeightSystem(kind, JAPANESE[kind], f"{kind} (vertical) height")


def height_system(word: str) -> HeightSystem:
    """The system that a word names: "unknown", "JGD2024", "ellipsoidal", "EPSG:6695", "11317".

    Raises
    ------
    InputError : the word names none.
    """
    plain = word.strip()
    if not plain or plain.lower() == "unknown":
        return UNKNOWN
    if plain.lower() == "ellipsoidal":
        return ELLIPSOIDAL
    if plain.upper() in JAPANESE:
        return japanese(plain.upper())
    code = re.fullmatch(r"(?:EPSG:)?(\d+)", plain, re.IGNORECASE)
    if code is None:
        raise InputError(say("The height system {word} is not known: give JGD2000, JGD2011, JGD2024, ellipsoidal or "
                             "the EPSG code of a vertical reference system.", word=word))
    return _coded(int(code.group(1)))


def carried_heights(word: str) -> HeightSystem:
    """The system that a `HeightSystem.word` stands for; a system without a code is carried by its name."""
    known = word in ("unknown", "ellipsoidal", *JAPANESE) or re.fullmatch(r"EPSG:\d+", word)
    return height_system(word) if known else HeightSystem("other", None, word)


def _coded(epsg: int, name: str = "") -> HeightSystem:
    for kind, vertical in JAPANESE.items():
        if epsg == vertical or epsg in _COMPOUND_OF[kind]:
            return japanese(kind)
    return HeightSystem("other", epsg, name)


def heights_of(wkt: str) -> HeightSystem:
    """The height system that a coordinate reference system (WKT) states; `UNKNOWN` where it states none.

    Raises
    ------
    InputError : it is no WKT.
    """
    if not wkt or not wkt.strip():
        return UNKNOWN
    code, vertical = own_code(parsed_crs(wkt)), vertical_part(wkt)
    if code and any(code in codes for codes in _COMPOUND_OF.values()):
        return _coded(code)
    if vertical is None:
        plan = horizontal_part(wkt)
        return ELLIPSOIDAL if plan is not None and any(axis.direction == "up" for axis in plan.axis_info) else UNKNOWN
    name = vertical.name.removeprefix(_SPELT_OUT)
    if own_code(vertical):
        return _coded(own_code(vertical), name)
    # EPSG's databases call 6695 "JGD2011 (vertical) height"; a text without code is told by its name.
    year = _YEAR.search(name)
    if year:
        return japanese(f"JGD{year.group(1)}")
    if name.lower().startswith(("ellipsoid", "wgs 84", "wgs_1984")):
        return ELLIPSOIDAL
    return HeightSystem("other", None, name)


def height_unit(wkt: str) -> float:
    """Metres of the unit in which a coordinate reference system (WKT) counts heights; 1 where it states none.

    Raises
    ------
    InputError : it is no WKT.
    """
    vertical = vertical_part(wkt)
    return 1.0 if vertical is None else float(vertical.axis_info[0].unit_conversion_factor)


def same_heights(first: HeightSystem, second: HeightSystem) -> bool:
    """Whether heights of both count from the same surface; what is not known is not the same as anything."""
    if not first.known:
        return False
    if first.kind != "other" or second.kind != "other":
        return first.kind == second.kind
    return first.epsg == second.epsg if first.epsg and second.epsg else _plain(first.name) == _plain(second.name)


def _plain(name: str) -> str:
    """A name without the words that some programs leave out: "NAP height" is "NAP"."""
    return re.sub(r"[^a-z0-9]|height|vertical", "", name.lower())


def refuse_other_heights(label_a: str, wkt_a: str, label_b: str, wkt_b: str) -> None:
    """Refuse two inputs that state different height systems; where one states none, nothing can be said.

    Raises
    ------
    InputError : they differ; the sentence names both and what to do.
    """
    first, second = heights_of(wkt_a), heights_of(wkt_b)
    if first.known and second.known and not same_heights(first, second):
        raise InputError(say("{label_a} has heights in {first}, but {label_b} in {second}: convert one of them with "
                             "“Convert heights” and the correction or geoid grid for it.", label_a=label_a, first=first,
                             label_b=label_b, second=second))


def stating_heights(wkt: str, system: HeightSystem, coded: bool = True, unit: float = 1.0) -> str:
    """A horizontal system (WKT 2) with a height system: compound where there is something to say.

    `coded=False` leaves the vertical system's code out and puts a word in front of its name: programs that look a
    compound system up and keep its horizontal part only (QGIS 3.22) then do not know it, and keep it whole.

    `unit` : metres of a unit of the heights. What the system said of heights before is replaced. Ellipsoidal heights
    and systems without a name cannot be said in a compound system; the horizontal part alone is given then.
    """
    plan = horizontal_part(wkt)
    if plan is None or not system.known or system.kind == "ellipsoidal" or not (system.name or system.epsg):
        return wkt if plan is None else plan.to_wkt()
    # Written out, so that a database that does not know the code can read it.
    own = (system.name or f"EPSG:{system.epsg}").replace('"', '""')
    name = own if coded else f"{_SPELT_OUT}{own}"
    datum = f"Japanese Geodetic Datum {system.kind[3:]} (vertical)" if system.kind in JAPANESE else own
    length = f'"foot",{unit!r}' if unit != 1.0 else '"metre",1'
    code = f',ID["EPSG",{system.epsg}]' if system.epsg and coded else ""
    return (f'COMPOUNDCRS["{plan.name} + {name}",{plan.to_wkt()},VERTCRS["{name}",VDATUM["{datum}"],CS[vertical,1],'
            f'AXIS["gravity-related height (H)",up,LENGTHUNIT[{length}]]{code}]]')


def stating_heights_of(wkt: str, *others: str) -> str:
    """A system (WKT) with the height system that it states, or else the first that one of `others` states.

    So that a result in the outlines' plane system states the heights of the points it was made from.
    """
    if not wkt or heights_of(wkt).known:
        return wkt
    for other in others:
        system = heights_of(other or "")
        if system.known and system.kind != "ellipsoidal":
            return stating_heights(wkt, system)
    return wkt
