"""OSM files (XML) as lane maps use them: nodes, ways and relations with tags."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree.ElementTree import Element, XMLParser  # nosec B405 # fed by `decoded`, which refuses document types
from xml.sax.saxutils import quoteattr  # nosec B406 # writes, reads nothing

from ..errors import InputError
from ..wording import say
from .files.atomic import written_beside
from .files.guard import PARSER_ERRORS, reads, unreadable_part
from .files.packed import open_unpacked
from .official.xml_stream import decoded


@dataclass(frozen=True)
class OsmNode:
    """A place: latitude and longitude in degrees, NaN where the file has only local coordinates; heights are a tag."""

    identifier: int
    latitude: float
    longitude: float
    tags: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class OsmWay:
    """A line through nodes, by their ids."""

    identifier: int
    nodes: tuple[int, ...]
    tags: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class OsmRelation:
    """Members as (type, id, role), type "node", "way" or "relation"."""

    identifier: int
    members: tuple[tuple[str, int, str], ...]
    tags: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class OsmFile:
    """The elements of a file by their ids; `repeated` are the ids that more than one element of a kind has."""

    nodes: Mapping[int, OsmNode]
    ways: Mapping[int, OsmWay]
    relations: Mapping[int, OsmRelation]
    repeated: tuple[tuple[str, int], ...] = ()


@reads("an OSM file")
def read_osm(path: str | os.PathLike) -> OsmFile:
    """Read nodes, ways and relations of an OSM file, plain or gzipped.

    Raises
    ------
    InputError : it is no OSM XML, has a document type, or an element lacks something or has a number that is none.
    """
    parser = XMLParser()  # nosec B314 # `decoded` refuses document types
    with open_unpacked(path) as file:
        for text, _ in decoded(file, Path(path).name, "a lane map"):
            parser.feed(text)
    root = parser.close()
    if root.tag == "OpenDRIVE":
        raise InputError(say("{path} is an OpenDRIVE file, which is written here and not read: give the Lanelet2 file "
                             "(.osm) of the map.", path=Path(path).name))
    if root.tag != "osm":
        raise InputError(say("{path} is no OSM file: its outermost element is {tag}, not osm.", path=Path(path).name,
                             tag=root.tag))
    found: dict[str, dict] = {"node": {}, "way": {}, "relation": {}}
    repeated = []
    for number, element in enumerate(root, 1):
        if element.tag not in found or element.get("action") == "delete":
            continue
        try:
            identifier = int(element.attrib["id"])
            if identifier in found[element.tag]:
                repeated.append((element.tag, identifier))
            found[element.tag][identifier] = _element(element, identifier)
        except PARSER_ERRORS as error:
            raise unreadable_part(path, _part(element, number), error) from error
    return OsmFile(found["node"], found["way"], found["relation"], tuple(repeated))


def _part(element: Element, number: int) -> str:
    """An element by its id, or by its place in the file where it has none."""
    identifier = element.get("id", "")[:40]
    return f"{element.tag} {identifier}" if identifier else say("{tag} (element {number} of the file)", tag=element.tag,
                                                                number=number)


_NUMBERS = ("local_x", "local_y", "ele")
"""Tags of a node that are coordinates, m."""


def _element(element: Element, identifier: int) -> OsmNode | OsmWay | OsmRelation:
    tags = {tag.attrib["k"]: tag.attrib["v"] for tag in element.iter("tag")}
    if element.tag == "node":
        return OsmNode(identifier, *_degrees(element, tags), tags)
    if element.tag == "way":
        return OsmWay(identifier, tuple(int(part.attrib["ref"]) for part in element.iter("nd")), tags)
    members = tuple((part.attrib["type"], int(part.attrib["ref"]), part.get("role", ""))
                    for part in element.iter("member"))
    return OsmRelation(identifier, members, tags)


def _degrees(element: Element, tags: Mapping[str, str]) -> tuple[float, float]:
    """Latitude and longitude; NaN where the attributes are empty, as Vector Map Builder leaves them, and local
    coordinates stand in the tags."""
    others = [float(tags[name]) for name in _NUMBERS if name in tags]
    texts = element.attrib["lat"].strip(), element.attrib["lon"].strip()
    if texts == ("", "") and {"local_x", "local_y"} <= tags.keys():
        degrees = (math.nan, math.nan)
    else:
        degrees = (float(texts[0]), float(texts[1]))
        others += degrees
    if not all(map(math.isfinite, others)):
        raise ValueError("a coordinate that is not finite")
    return degrees


def write_osm(path: str | os.PathLike, content: OsmFile, meta: Mapping[str, str] | None = None) -> None:
    """Write an OSM file; it appears at `path` when it is whole.

    Parameters
    ----------
    meta : attributes of an element MetaInfo at the head, as Autoware's maps have it.
    """
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<osm version="0.6" generator="UrbanMap">']
    if meta:
        lines.append(f"  <MetaInfo {' '.join(f'{name}={quoteattr(value)}' for name, value in meta.items())}/>")
    for node in content.nodes.values():
        known = math.isfinite(node.latitude)
        place = f'lat="{node.latitude:.11f}" lon="{node.longitude:.11f}"' if known else 'lat="" lon=""'
        lines += _with_tags(f'  <node id="{node.identifier}" visible="true" version="1" {place}', [], node.tags, "node")
    for way in content.ways.values():
        inner = [f'    <nd ref="{number}"/>' for number in way.nodes]
        lines += _with_tags(f'  <way id="{way.identifier}" visible="true" version="1"', inner, way.tags, "way")
    for relation in content.relations.values():
        inner = [f'    <member type="{kind}" ref="{number}" role="{role}"/>'
                 for kind, number, role in relation.members]
        lines += _with_tags(f'  <relation id="{relation.identifier}" visible="true" version="1"', inner, relation.tags,
                            "relation")
    lines.append("</osm>")
    with written_beside(path) as temporary:
        temporary.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _with_tags(head: str, inner: list[str], tags: Mapping[str, str], name: str) -> list[str]:
    body = [*inner, *(f"    <tag k={quoteattr(key)} v={quoteattr(value)}/>" for key, value in tags.items())]
    return [f"{head}>", *body, f"  </{name}>"] if body else [f"{head}/>"]
