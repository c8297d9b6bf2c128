"""Objects of GSI Fundamental Geospatial Data (JPGIS 2014 GML) read as a stream, one object at a time."""

from __future__ import annotations

import sys
from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.etree.ElementTree import Element  # nosec B405 # elements alone, no parser

from ...progress import SILENT, Progress
from ...wording import say
from .gsi_sources import XmlSource
from .xml_stream import root_children

FGD = "{http://fgd.gsi.go.jp/spec/2008/FGD_GMLSchema}"
GML = "{http://www.opengis.net/gml/3.2}"
ATTRIBUTES = ("gml_id", "fid", "lfSpanFr", "lfSpanTo", "devDate", "orgGILvl", "orgMDId", "type", "name",
              "source")

_LARGEST_OBJECT = 2**26
# Two ends closer than this are one point: 1e-9 degrees, the last digit the GSI gives, is 0.1 mm.
_SAME_DEGREES = 1.5e-9
# Latitude and longitude between which all of Japan lies (EPSG's area of use of JGD2011, with a margin).
_JAPAN = (17.0, 47.0, 122.0, 158.0)


@dataclass
class Outlines:
    """What was read: flat coordinates and how they are cut into rings or lines and into objects.

    Attributes
    ----------
    coordinates : latitude and longitude in turn, degrees.
    parts : number of points of each ring (or line).
    rings : number of rings of each object, the outer one first; always 1 for a line.
    attributes : one list for each name of `ATTRIBUTES`, a value for each object; None where not given.
    """

    coordinates: array = field(default_factory=lambda: array("d"))
    parts: list[int] = field(default_factory=list)
    rings: list[int] = field(default_factory=list)
    attributes: dict[str, list[str | None]] = field(default_factory=lambda: {name: [] for name in ATTRIBUTES})

    def add(self, parts: list[list[float]], attributes: dict[str, str | None]) -> None:
        """Add one object."""
        for part in parts:
            self.coordinates.extend(part)
            self.parts.append(len(part) // 2)
        self.rings.append(len(parts))
        for name, values in self.attributes.items():
            values.append(attributes.get(name))


@dataclass
class Harvest:
    """Everything read so far: areas (BldA), lines (BldL), reference systems met, and what was not plain."""

    areas: Outlines = field(default_factory=Outlines)
    lines: Outlines = field(default_factory=Outlines)
    srs_names: set[str] = field(default_factory=set)
    unusable: list[str] = field(default_factory=list)
    gaps: list[float] = field(default_factory=list)
    other_segments: set[str] = field(default_factory=set)
    curved_objects: int = 0
    not_gsi: list[str] = field(default_factory=list)
    other_objects: dict[str, int] = field(default_factory=dict)


class _Unusable(Exception):
    """An object without a geometry that can be used; the text says why."""


def read_source(source: XmlSource, harvest: Harvest, progress: Progress = SILENT) -> None:
    """Read all building outlines of one XML file into `harvest`; memory does not grow with the file.

    Raises
    ------
    InputError : see `root_children`.
    """
    for root, element in root_children(source, "GSI data", _LARGEST_OBJECT, progress):
        if root.tag != FGD + "Dataset":
            harvest.not_gsi.append(source.name)
            return
        _add_object(element, source.short_name, harvest)


def _add_object(element: Element, source: str, harvest: Harvest) -> None:
    """Take in one finished object of the data set."""
    if element.tag not in (FGD + "BldA", FGD + "BldL"):
        if element.tag.startswith(FGD):
            kind = element.tag[len(FGD):]
            harvest.other_objects[kind] = harvest.other_objects.get(kind, 0) + 1
        return
    attributes = _attributes(element, source)
    try:
        if element.tag == FGD + "BldA":
            patches = [_patch(patch, harvest) for patch in element.iter(GML + "PolygonPatch")]
            if not patches:
                raise _Unusable(say("it has no surface"))
            for rings in patches:
                harvest.areas.add(rings, attributes)
        else:
            harvest.lines.add([_line(element, harvest)], attributes)
    except _Unusable as error:
        harvest.unusable.append(f"{attributes['gml_id'] or attributes['fid']} ({error})")
        return
    for geometry in element.iter(GML + ("Surface" if element.tag == FGD + "BldA" else "Curve")):
        if geometry.get("srsName"):
            harvest.srs_names.add(geometry.get("srsName"))
            break


def _attributes(element: Element, source: str) -> dict[str, str | None]:
    values: dict[str, str | None] = {"gml_id": element.get(GML + "id"), "source": source}
    for child in element:
        name = child.tag[len(FGD):] if child.tag.startswith(FGD) else ""
        if name not in ATTRIBUTES:
            continue
        text = child.text if len(child) == 0 else child.findtext(f".//{GML}timePosition")
        if text and text.strip():
            # Dates, levels and types repeat on every building: keep one string of each.
            values[name] = text.strip() if name == "fid" else sys.intern(text.strip())
    return values


def _patch(patch: Element, harvest: Harvest) -> list[list[float]]:
    """Rings of a polygon patch, outer first, each a closed list of latitude and longitude in turn."""
    outer = patch.find(GML + "exterior")
    if outer is None:
        raise _Unusable(say("its surface has no exterior"))
    return [_ring(boundary, harvest) for boundary in (outer, *patch.findall(GML + "interior"))]


def _ring(boundary: Element, harvest: Harvest) -> list[float]:
    members = [points for points in _curves(boundary, harvest) if points]
    if not members:
        raise _Unusable(say("a ring has no coordinates"))
    ring = members[0] if len(members) == 1 else _joined(members, harvest)
    if ring[:2] != ring[-2:]:
        gap = _distance(ring[-2:], ring[:2])
        if gap > _SAME_DEGREES:
            harvest.gaps.append(gap)
            ring += ring[:2]
        else:
            ring[-2:] = ring[:2]
    if len(ring) < 8:
        raise _Unusable(say("a ring has fewer than three corners"))
    return ring


def _line(element: Element, harvest: Harvest) -> list[float]:
    segments = [points for points in _curves(element, harvest) if points]
    if not segments:
        raise _Unusable(say("its line has no coordinates"))
    line = segments[0] if len(segments) == 1 else _joined(segments, harvest)
    if len(line) < 4:
        raise _Unusable(say("its line has a single point"))
    return line


def _curves(parent: Element, harvest: Harvest) -> Iterator[list[float]]:
    """Points of every curve segment below an element, in order of appearance."""
    for segments in parent.iter(GML + "segments"):
        for segment in segments:
            if segment.tag != GML + "LineStringSegment":
                harvest.other_segments.add(segment.tag.rpartition("}")[2])
                harvest.curved_objects += 1
            for positions in segment:
                if positions.tag == GML + "posList":
                    yield _points(positions.text, positions.get("srsDimension"))
                    break
            else:
                yield [value for position in segment.iter(GML + "pos")
                       for value in _points(position.text, position.get("srsDimension"))]


def _points(text: str | None, dimension: str | None) -> list[float]:
    try:
        values = [float(value) for value in (text or "").split()]
    except ValueError as error:
        raise _Unusable(say("a coordinate is not a number")) from error
    if dimension == "3":
        del values[2::3]
    if len(values) % 2:
        raise _Unusable(say("a latitude has no longitude"))
    if values:
        latitudes, longitudes = values[::2], values[1::2]
        inside = (min(latitudes) >= _JAPAN[0] and max(latitudes) <= _JAPAN[1]
                  and min(longitudes) >= _JAPAN[2] and max(longitudes) <= _JAPAN[3])
        # min() and max() can pass over a NaN, a sum cannot.
        if not inside or sum(values) != sum(values):
            raise _Unusable(say("it lies outside Japan"))
    return values


def _joined(members: list[list[float]], harvest: Harvest) -> list[float]:
    """Join curves in their order to one line; a curve that runs backwards is turned round.

    The first one is turned if only its start touches the second curve; every other one if its end lies
    nearer to the line so far than its start.
    """
    first, second = members[0], members[1]
    ends = (second[:2], second[-2:])
    if min(_distance(first[:2], end) for end in ends) < min(_distance(first[-2:], end) for end in ends):
        first = _reversed(first)
    line = list(first)
    for member in members[1:]:
        if _distance(line[-2:], member[-2:]) < _distance(line[-2:], member[:2]):
            member = _reversed(member)
        gap = _distance(line[-2:], member[:2])
        if gap > _SAME_DEGREES:
            harvest.gaps.append(gap)
            line += member
        else:
            line += member[2:]
    return line


def _reversed(points: list[float]) -> list[float]:
    turned = points[::-1]
    turned[::2], turned[1::2] = turned[1::2], turned[::2]
    return turned


def _distance(one: list[float], other: list[float]) -> float:
    """Larger of the differences in latitude and longitude, degrees."""
    return max(abs(one[0] - other[0]), abs(one[1] - other[1]))
