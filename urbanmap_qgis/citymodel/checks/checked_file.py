"""A file of a city model as the rules look at it: what name and head say, its lists of codes, its objects in blocks."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from xml.etree.ElementTree import Element  # nosec B405 # elements alone, no parser

import numpy as np

from ...errors import InputError
from ...io.files.named_files import CODE_LIST
from ...io.official.gsi_sources import XmlSource
from ...io.official.xml_stream import root_children
from ...progress import SILENT, Progress
from ...wording import say
from .block_shapes import BlockShapes
from .feature_walk import CityFeature, CityThing, tag_name, walk
from .standard_lists import standard_lists

PACKAGES = {
    "bldg": ("bldg:Building",), "tran": ("tran:Road",), "rwy": ("tran:Railway",), "trk": ("tran:Track",),
    "squr": ("tran:Square",), "wwy": ("uro:Waterway",), "luse": ("luse:LandUse",), "brid": ("brid:Bridge",),
    "tun": ("tun:Tunnel",), "cons": ("uro:OtherConstruction",), "frn": ("frn:CityFurniture",),
    "ubld": ("uro:UndergroundBuilding",), "veg": ("veg:SolitaryVegetationObject", "veg:PlantCover"),
    "dem": ("dem:ReliefFeature",), "wtr": ("wtr:WaterBody",), "fld": ("wtr:WaterBody",), "tnm": ("wtr:WaterBody",),
    "htd": ("wtr:WaterBody",), "ifld": ("wtr:WaterBody",), "rfld": ("wtr:WaterBody",),
    "gen": ("gen:GenericCityObject",)}
"""City objects of the application schemas by the prefix of files and folders (specification, tables 7-5 and 7-9)."""

FREE_PACKAGES = ("urf", "area", "lsld", "unf", "ext", "app")
"""Prefixes whose schemas have many city objects, or those of a city's own; which ones is not looked at."""

_NAME = re.compile(r"([0-9A-Za-z]+)_([a-z]+)_(\d+)(?:_([0-9A-Za-z-]+))?\Z")
_LARGEST_OBJECT = 2**28
_BLOCK = 2000
"""Polygons that are looked at together: some megabytes."""


@dataclass(eq=False)
class CheckedFile:
    """One file.

    Attributes
    ----------
    source, number : the file and its number in the run.
    delivery : whether it lies in the folders of a delivery.
    path : its name with the folders that tell it from the others.
    root : attributes of its root.
    system : name of its reference system, "" without.
    low, high : corners of its envelope as they stand there, None without.
    counts : features by type.
    broken : what the parser says of a file that is no whole XML.
    """

    source: XmlSource
    number: int
    delivery: bool = False
    path: str = ""
    root: dict[str, str] = field(default_factory=dict)
    root_name: str = ""
    system: str = ""
    low: np.ndarray | None = None
    high: np.ndarray | None = None
    counts: dict[str, int] = field(default_factory=dict)
    broken: str = ""
    _lists: dict[str, frozenset[str] | None] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Its name without folders."""
        return self.source.short_name

    @cached_property
    def parts(self) -> tuple[str, str, str, str] | None:
        """Mesh, prefix, reference system and option of its name (specification, 7.2.3); None of another form."""
        found = _NAME.match(re.sub(r"\.(gml|xml|citygml)(\.gz)?\Z", "", self.name, flags=re.IGNORECASE))
        return (found.group(1), found.group(2), found.group(3), found.group(4) or "") if found else None

    @cached_property
    def folder(self) -> str:
        """Name of the folder in which it lies; "" where it has none."""
        steps = re.split(r"[/\\]", self.source.name)
        return steps[-2] if len(steps) > 1 else ""

    @cached_property
    def package(self) -> str:
        """Prefix of its application schema by its name, else by its folders; "" where neither tells."""
        known = {*PACKAGES, *FREE_PACKAGES}
        if self.parts and self.parts[1] in known:
            return self.parts[1]
        steps = re.split(r"[/\\]", self.source.name)[:-1]
        return next((step for step in reversed(steps) if step in known), "")

    @property
    def geographic(self) -> bool:
        """Whether places are latitudes and longitudes: by the envelope, else as the specification has them."""
        if self.low is None or self.high is None:
            return True
        corners = np.abs(np.concatenate([self.low[:2], self.high[:2]]))
        return bool((corners <= 180.0).all()) or "EPSG/0/6697" in self.system

    def codes(self, space: str) -> frozenset[str] | None:
        """Codes of a list that the file names; empty for a list whose codes are not known, None for no such list."""
        if space not in self._lists:
            self._lists[space] = self._codes(space)
        return self._lists[space]

    def _codes(self, space: str) -> frozenset[str] | None:
        found = self.source.beside(space, CODE_LIST) if space.lower().endswith(".xml") else None
        if found is not None:
            try:
                return frozenset(_codes_of(found))
            except InputError:
                return None
        if self.lists_there:
            return None
        return standard_lists().get(re.split(r"[/\\]", space)[-1].removesuffix(".xml"))

    @cached_property
    def lists_there(self) -> bool:
        """Whether the data set brings its own lists of codes: one at least lies where the file says."""
        return any(self.source.beside(f"../../codelists/{name}.xml", CODE_LIST) is not None
                   for name in standard_lists())


@dataclass(eq=False)
class CityBlock:
    """Some city objects of a file, looked at together."""

    file: CheckedFile
    things: list[CityThing]

    @cached_property
    def shapes(self) -> BlockShapes:
        """Their polygons as arrays."""
        return BlockShapes(self.things, self.file.geographic)

    def features(self, *types: str) -> Iterator[CityFeature]:
        """Features of some types; of all without one."""
        return (feature for thing in self.things for feature in thing.features if not types or feature.type in types)


def blocks_of(file: CheckedFile, progress: Progress = SILENT) -> Iterator[CityBlock]:
    """The city objects of a file in blocks; fills what its head says, and `broken` where it cannot be read on."""
    things: list[CityThing] = []
    size = 0
    try:
        for root, member in root_children(file.source, say("a city model"), _LARGEST_OBJECT, progress):
            if not file.root_name:
                file.root_name, file.root = tag_name(root.tag)[1], dict(root.attrib)
            name = tag_name(member.tag)[1]
            if name == "boundedBy":
                _head(file, member)
            elif name in ("cityObjectMember", "featureMember"):
                for element in member:
                    things.append(walk(element))
                    size += 1 + len(things[-1].polygons)
            if size > _BLOCK:
                yield CityBlock(file, things)
                things, size = [], 0
    except InputError as error:
        file.broken = str(error)
    if things:
        yield CityBlock(file, things)


def _head(file: CheckedFile, member: Element) -> None:
    """What the envelope of a file says."""
    for item in member.iter():
        name = tag_name(item.tag)[1]
        if name == "Envelope":
            file.system = item.get("srsName") or ""
        elif name in ("lowerCorner", "upperCorner"):
            try:
                corner = np.array((item.text or "").split(), float)
            except ValueError:
                continue
            if len(corner) == 3:
                if name == "lowerCorner":
                    file.low = corner
                else:
                    file.high = corner


def _codes_of(source: XmlSource) -> Iterator[str]:
    """The codes of a list (gml:Dictionary): the names of its definitions."""
    for _, entry in root_children(source, say("a list of codes"), _LARGEST_OBJECT):
        if tag_name(entry.tag)[1] == "dictionaryEntry":
            yield from ((item.text or "").strip() for item in entry.iter() if tag_name(item.tag)[1] == "name")
