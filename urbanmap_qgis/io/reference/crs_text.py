"""Coordinate reference systems as text (WKT 1 and 2): their parts, codes and what makes two of them the same.

Nothing is looked up in a database of reference systems: today's databases know JGD2024 under different names, or not at
all, and a file's text must mean the same with each of them. Source: OGC 18-010r7 (WKT 2), OGC 01-009 (WKT 1).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from ...errors import InputError
from ...wording import say

HORIZONTAL = ("PROJCRS", "PROJECTEDCRS", "PROJCS", "GEOGCRS", "GEOGRAPHICCRS", "GEODCRS", "GEODETICCRS", "GEOGCS")
VERTICAL = ("VERTCRS", "VERTICALCRS", "VERT_CS", "VERTCS")
_COMPOUND = "COMPOUNDCRS"
_DATUMS = ("DATUM", "GEODETICDATUM", "TRF", "ENSEMBLE", "VDATUM", "VERTICALDATUM", "VRF", "VERT_DATUM")
_TOKEN = re.compile(r'\s*(?:"((?:[^"]|"")*)"|([A-Za-z_][A-Za-z0-9_]*)|([-+0-9.][-+0-9.eE]*)|([\[\](),]))')
_DEEPEST = 64

# One datum under several names: since 2026 EPSG calls JGD2011 JGD2024 under the same codes (6666 to 6692, datum 1128),
# as the revision of 2025 changed heights only; ESRI writes D_ before its datums.
_SAME_DATUM = {"jgd2024": "jgd2011", "japanesegeodeticdatum2024": "jgd2011", "japanesegeodeticdatum2011": "jgd2011",
               "japanesegeodeticdatum2000": "jgd2000", "worldgeodeticsystem1984": "wgs1984",
               "worldgeodeticsystem1984ensemble": "wgs1984", "wgs84": "wgs1984"}
_DATUM_CODES = {1128: "jgd2011", 6612: "jgd2000", 6326: "wgs1984"}


@dataclass(frozen=True)
class WktNode:
    """A word of WKT with what stands in its brackets: texts, numbers and further nodes, in order."""

    word: str
    values: tuple

    @property
    def name(self) -> str:
        """The first text: the name of the thing."""
        return next((value for value in self.values if isinstance(value, str)), "")

    def children(self, *words: str) -> list[WktNode]:
        """Nodes directly inside whose word is one of `words` (all, where none is given)."""
        return [value for value in self.values if isinstance(value, WktNode) and (not words or value.word in words)]

    def child(self, *words: str) -> WktNode | None:
        """First node directly inside whose word is one of `words`."""
        found = self.children(*words)
        return found[0] if found else None

    def walk(self) -> Iterator[WktNode]:
        """The node and all below it."""
        yield self
        for item in self.children():
            yield from item.walk()

    @property
    def epsg(self) -> int | None:
        """The node's own EPSG code; None where it states none."""
        for item in self.children("ID", "AUTHORITY"):
            if item.name.upper() == "EPSG" and len(item.values) > 1:
                text = str(item.values[1]).split(".")[0]
                return int(text) if text.isdigit() else None
        return None


def parse_wkt(text: str) -> WktNode:
    """WKT 1 or 2 as a tree.

    Raises
    ------
    InputError : it is no WKT.
    """
    tokens = list(_TOKEN.finditer(text))
    if not tokens or "".join(found.group(0) for found in tokens).strip() != text.strip():
        raise InputError(say("The coordinate reference system is no WKT that can be understood: set another one."))
    try:
        node, end = _node(tokens, 0, 0)
        if end < len(tokens) and tokens[end].group(4) == ",":
            # ESRI writes the vertical system behind the horizontal one.
            vertical, end = _node(tokens, end + 1, 0)
            node = WktNode(_COMPOUND, (f"{node.name} + {vertical.name}", node, vertical))
    except IndexError as error:
        raise InputError(say("The coordinate reference system is cut off: set another one.")) from error
    if end != len(tokens):
        raise InputError(say("The coordinate reference system is no WKT that can be understood: set another one."))
    return node


def _node(tokens: list, place: int, depth: int) -> tuple[WktNode, int]:
    """The node whose word is the token at `place`, and the place behind it."""
    word = tokens[place].group(2)
    if word is None or depth > _DEEPEST or tokens[place + 1].group(4) not in ("[", "("):
        raise IndexError
    values, place = [], place + 2
    while True:
        quoted, bare, number, mark = tokens[place].groups()
        if mark in ("]", ")"):
            return WktNode(word.upper(), tuple(values)), place + 1
        if quoted is not None:
            values.append(quoted.replace('""', '"'))
        elif number is not None:
            values.append(_number(number))
        elif bare is not None:
            if tokens[place + 1].group(4) in ("[", "("):
                node, place = _node(tokens, place, depth + 1)
                values.append(node)
                continue
            values.append(bare)
        place += 1


def _number(text: str) -> float | int:
    try:
        return int(text)
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        raise IndexError from None


def horizontal_part(node: WktNode) -> WktNode | None:
    """The projected or geographic system of a system that may be compound or bound to another; None without one."""
    for item in node.walk():
        if item.word in HORIZONTAL:
            return item
    return None


def vertical_part(node: WktNode) -> WktNode | None:
    """The vertical system of a compound one (or of one that is vertical only); None where it states none."""
    for item in node.walk():
        if item.word in VERTICAL:
            return item
    return None


def is_ellipsoidal(node: WktNode) -> bool:
    """Whether the system counts heights over the ellipsoid: a geographic or projected one with three axes."""
    part = horizontal_part(node)
    if part is None or vertical_part(node) is not None:
        return False
    axes = [str(item.values[1]).lower() for item in part.children("AXIS") if len(item.values) > 1]
    return "up" in axes


def wkt_text(node: WktNode) -> str:
    """A node as WKT."""
    return f"{node.word}[{','.join(map(_value_text, node.values))}]"


# Words that stand without quotation marks in WKT: they follow the name, or are directions of axes.
_BARE = re.compile(r"^(north|south|east|west|up|down|ellipsoidal|Cartesian|vertical|geocentric[XYZ]|other)$",
                   re.IGNORECASE)


def _value_text(value) -> str:
    if isinstance(value, WktNode):
        return wkt_text(value)
    if isinstance(value, str):
        return value if _BARE.match(value) else '"' + value.replace('"', '""') + '"'
    return repr(value)


def same_horizontal(first: str, second: str) -> bool:
    """Whether two systems (WKT) give the same place the same two coordinates, the order of axes aside.

    Equal codes of EPSG are equal whatever the names; different ones are not. Without codes on both sides the datum (its
    old and new names are one), the ellipsoid, the projection's method and each of its parameters decide.
    """
    one, other = horizontal_part(parse_wkt(first)), horizontal_part(parse_wkt(second))
    if one is None or other is None:
        return False
    if one.epsg and other.epsg and (one.epsg == other.epsg or _projected(one)):
        return one.epsg == other.epsg
    if _projected(one) != _projected(other) or datum_key(one) != datum_key(other):
        return False
    return _close(_ellipsoid(one), _ellipsoid(other)) and _same_projection(one, other)


def datum_key(node: WktNode) -> str:
    """One word for the datum of a system, the same for its old and new names and with or without its code."""
    for item in node.walk():
        if item.word in _DATUMS:
            if item.epsg in _DATUM_CODES:
                return _DATUM_CODES[item.epsg]
            plain = re.sub(r"[^a-z0-9]", "", re.sub(r"^D_", "", item.name).lower())
            return _SAME_DATUM.get(plain, plain)
    return ""


def _projected(node: WktNode) -> bool:
    return node.word.startswith("PROJ")


def _ellipsoid(node: WktNode) -> tuple[float, ...]:
    for item in node.walk():
        if item.word in ("ELLIPSOID", "SPHEROID"):
            return tuple(float(value) for value in item.values[1:3])
    return ()


_PARAMETERS = {
    "latitudeofnaturalorigin": "latitudeoforigin", "latitudeoffalseorigin": "latitudeoforigin",
    "latitudeofcenter": "latitudeoforigin", "longitudeofnaturalorigin": "centralmeridian",
    "longitudeoffalseorigin": "centralmeridian", "longitudeoforigin": "centralmeridian",
    "longitudeofcenter": "centralmeridian", "scalefactoratnaturalorigin": "scalefactor",
    "eastingatfalseorigin": "falseeasting", "northingatfalseorigin": "falsenorthing",
    "latitudeof1ststandardparallel": "standardparallel1", "latitudeof2ndstandardparallel": "standardparallel2",
}


def _same_projection(one: WktNode, other: WktNode) -> bool:
    if not _projected(one):
        return True
    first, second = _projection(one), _projection(other)
    return (first.keys() == second.keys() and _method(one) == _method(other)
            and all(_close((first[name],), (second[name],)) for name in first)
            and _close((_unit(one),), (_unit(other),)))


def _method(node: WktNode) -> str:
    for item in node.walk():
        if item.word in ("METHOD", "PROJECTION"):
            plain = re.sub(r"[^a-z0-9]", "", item.name.lower())
            return "transversemercator" if plain == "gausskruger" else plain
    return ""


def _projection(node: WktNode) -> dict[str, float]:
    """Parameters by plain names; those that are zero are left out, as some programs do not write them."""
    found = {}
    for item in node.walk():
        if item.word == "PARAMETER" and len(item.values) > 1:
            plain = re.sub(r"[^a-z0-9]", "", item.name.lower())
            if item.values[1]:
                found[_PARAMETERS.get(plain, plain)] = float(item.values[1])
    return found


def _unit(node: WktNode) -> float:
    """Metres a unit of a projected system's axes."""
    lengths = [float(item.values[1]) for item in node.children("UNIT", "LENGTHUNIT") if len(item.values) > 1]
    if not lengths:
        lengths = [float(unit.values[1]) for axis in node.children("AXIS") for unit in axis.children("LENGTHUNIT")]
    return lengths[0] if lengths else 1.0


def _close(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    return len(one) == len(other) and all(math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9) for a, b in zip(one, other))
