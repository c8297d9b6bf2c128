"""A city object of a CityGML file as the rules look at it: its features, values, references and geometries in one walk.

Source: OGC 12-019 (CityGML 2.0), GML 3.1.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from xml.etree.ElementTree import Element  # nosec B405 # elements alone, no parser

from ..citygml.schema import CITYGML_SPACE, GML, XLINK_HREF, module_of

_GML_ID = f"{{{GML}}}id"
_LOD = re.compile(r"lod([0-4])")
_RINGED = {"Polygon", "Triangle", "Rectangle"}
_LINES = {"LineString"}
_GROUPS = {"Solid", "CompositeSurface", "MultiSurface", "TriangulatedSurface", "Tin", "CompositeCurve", "MultiCurve",
           "OrientableSurface", "Surface", "CompositeSolid", "MultiSolid", "MultiPoint", "Point", "MultiGeometry"}
GEOMETRIES = frozenset(_RINGED | _LINES | _GROUPS | {"LinearRing"})
_GROUPED = {"CompositeSurface", "TriangulatedSurface", "Tin", "CompositeCurve"}
_FACES = ("MultiSurface", "lod4MultiSurface")
_OF_FACES = ("bldg:Building", "bldg:BuildingPart", "bldg:Room")
"""What must refer to faces of its boundary surfaces: a multi-surface of LOD4 of its own is kept with its members."""
_MEMBERS = {"surfaceMember", "baseSurface", "exterior", "interior", "surfaceMembers", "patches", "trianglePatches"}


@lru_cache(maxsize=4096)
def tag_name(tag: str) -> tuple[str, str]:
    """The usual prefix ("bldg", "tran", "gml", "uro"; "" where none is known) and local name of a tag."""
    space, _, name = tag[1:].rpartition("}") if tag.startswith("{") else ("", "", tag)
    if space.startswith(GML):
        return "gml", name
    if space.startswith(CITYGML_SPACE):
        return module_of(space) or "core", name
    found = re.search(r"/(uro|urf|urc)/", f"{space}/")
    return (found.group(1) if found else "", name)


@dataclass(eq=False)
class CityFeature:
    """A feature: a city object or one that it holds.

    Attributes
    ----------
    element : of the file.
    type : such as "bldg:Building".
    id : its gml:id.
    parent : the feature that holds it.
    geometry : names of its properties with a geometry (lod1Solid) with the kinds of geometry in each.
    place : first place of its geometry as it stands in the file; None without.
    """

    element: Element
    type: str
    id: str
    parent: CityFeature | None
    geometry: dict[str, list[str]] = field(default_factory=dict)
    place: tuple[float, ...] | None = None

    @property
    def top(self) -> CityFeature:
        """The city object that it belongs to."""
        return self if self.parent is None else self.parent.top

    def children(self, *names: str) -> Iterator[Element]:
        """Child elements of some names, without prefix."""
        return (child for child in self.element if tag_name(child.tag)[1] in names)

    @property
    def lods(self) -> set[int]:
        """Levels of detail that it has a geometry of."""
        return {int(found.group(1)) for name in self.geometry if (found := _LOD.match(name))}


@dataclass(eq=False)
class CityPolygon:
    """A polygon, triangle or rectangle: the texts of its rings' coordinates, the outer one first.

    Attributes
    ----------
    owner : number of its solid in the object's list, None outside of solids.
    group : number of its composite surface or triangulated surface.
    outer_rings : how many exterior rings the file gives.
    """

    feature: CityFeature
    name: str
    lod: int | None
    id: str
    kind: str
    rings: list[str]
    owner: int | None
    group: int | None
    outer_rings: int = 1


@dataclass(eq=False)
class CityLine:
    """A line string: the text of its coordinates, the number of its composite curve (None without)."""

    feature: CityFeature
    lod: int | None
    text: str
    group: int | None


@dataclass(eq=False)
class CityBody:
    """A solid, composite surface or the like: kind, and its polygons, own ones by number and referred ones by id."""

    feature: CityFeature
    name: str
    lod: int | None
    id: str
    kind: str
    members: list[tuple[int | str, bool]] = field(default_factory=list)


@dataclass(eq=False)
class CityLink:
    """An xlink: its address, the tag that holds it (prefix, name), and the property with geometry about it."""

    feature: CityFeature
    target: str
    tag: tuple[str, str]
    name: str


@dataclass(eq=False)
class CityThing:
    """All that a city object of a file holds, in the order of the file.

    Attributes
    ----------
    features : itself first.
    codes : values with a list of codes: (feature, element, its parent).
    ids : (id, tag, feature) of everything that has one.
    """

    features: list[CityFeature] = field(default_factory=list)
    polygons: list[CityPolygon] = field(default_factory=list)
    lines: list[CityLine] = field(default_factory=list)
    bodies: list[CityBody] = field(default_factory=list)
    references: list[CityLink] = field(default_factory=list)
    codes: list[tuple[CityFeature, Element, Element]] = field(default_factory=list)
    ids: list[tuple[str, tuple[str, str], CityFeature]] = field(default_factory=list)

    @cached_property
    def polygon_numbers(self) -> dict[str, int]:
        """Numbers of its polygons in their list, by their ids."""
        return {polygon.id: number for number, polygon in enumerate(self.polygons) if polygon.id}


@dataclass(frozen=True)
class _Where:
    """What holds for an element and all below it."""

    feature: CityFeature
    name: str = ""
    lod: int | None = None
    solid: int | None = None
    group: int | None = None
    flipped: bool = False


def walk(element: Element) -> CityThing:
    """A city object with all that it holds."""
    found = CityThing()
    _feature(element, None, found)
    return found


def _feature(element: Element, parent: CityFeature | None, found: CityThing) -> None:
    prefix, name = tag_name(element.tag)
    feature = CityFeature(element, f"{prefix}:{name}", element.get(_GML_ID) or "", parent)
    found.features.append(feature)
    if feature.id:
        found.ids.append((feature.id, (prefix, name), feature))
    where = _Where(feature)
    for child in element:
        _property(child, element, where, found)


def _property(element: Element, parent: Element, where: _Where, found: CityThing) -> None:
    """A property of a feature or of a data type: a value, features, a geometry."""
    prefix, name = tag_name(element.tag)
    if prefix == "app":
        return
    _noted(element, parent, (prefix, name), where, found)
    level = _LOD.match(name)
    if level:
        where = _Where(where.feature, name, int(level.group(1)))
    for child in element:
        _object(child, element, where, found)


def _object(element: Element, parent: Element, where: _Where, found: CityThing) -> None:
    """What stands in a property: a feature, a data type or a geometry."""
    prefix, name = tag_name(element.tag)
    if prefix == "gml" and name in GEOMETRIES:
        if where.name:
            where.feature.geometry.setdefault(where.name, []).append(name)
        _geometry(element, where, found)
    elif (prefix != "gml" and element.get(_GML_ID) and name[:1].isupper()) or _is_feature(prefix, name):
        _feature(element, where.feature, found)
    else:
        _noted(element, parent, (prefix, name), where, found)
        for child in element:
            _property(child, element, where, found)


_NAMED = {"BuildingPart", "Room", "RoofSurface", "WallSurface", "GroundSurface", "OuterCeilingSurface",
          "OuterFloorSurface", "ClosureSurface", "InteriorWallSurface", "CeilingSurface", "FloorSurface", "Window",
          "Door", "BuildingInstallation", "IntBuildingInstallation", "BuildingFurniture", "TrafficArea",
          "AuxiliaryTrafficArea"}


def _is_feature(prefix: str, name: str) -> bool:
    """Features are told by their ids; these also without."""
    return prefix in ("bldg", "tran") and name in _NAMED


def _noted(element: Element, parent: Element, tag: tuple[str, str], where: _Where, found: CityThing) -> None:
    """Keep the attributes of an element that rules ask for."""
    target = element.get(XLINK_HREF)
    if target is not None:
        found.references.append(CityLink(where.feature, target, tag, where.name or tag[1]))
    if element.get("codeSpace") is not None and not len(element):
        found.codes.append((where.feature, element, parent))
    identifier = element.get(_GML_ID)
    if identifier:
        found.ids.append((identifier, tag, where.feature))


def _geometry(element: Element, where: _Where, found: CityThing) -> None:
    """A geometry with all below it."""
    prefix, name = tag_name(element.tag)
    _noted(element, element, (prefix, name), where, found)
    if name in _RINGED:
        _polygon(element, name, where, found)
        return
    if name in _LINES:
        text = _coordinates(element)
        found.lines.append(CityLine(where.feature, where.lod, text, where.group))
        _place(where.feature, text)
        return
    if name == "Solid":
        where = _with(where, solid=len(found.bodies), group=None)
    elif name in _GROUPED or ((name, where.name) == _FACES and where.feature.type in _OF_FACES):
        where = _with(where, group=len(found.bodies))
    if name in _GROUPS:
        found.bodies.append(CityBody(where.feature, where.name, where.lod, element.get(_GML_ID) or "", name))
    if name == "OrientableSurface" and element.get("orientation") == "-":
        where = _with(where, flipped=not where.flipped)
    for child in element:
        _member(child, element, where, found)


def _member(element: Element, parent: Element, where: _Where, found: CityThing) -> None:
    """A property of a geometry: parts, or coordinates."""
    prefix, name = tag_name(element.tag)
    _noted(element, parent, (prefix, name), where, found)
    target = element.get(XLINK_HREF)
    if target is not None and name in _MEMBERS:
        for number in {where.solid, where.group} - {None}:
            found.bodies[number].members.append((target.lstrip("#"), where.flipped))
    if name in ("pos", "coordinates") and element.text:
        _place(where.feature, element.text)
    for child in element:
        if tag_name(child.tag)[0] == "gml":
            _geometry(child, where, found)


def _polygon(element: Element, kind: str, where: _Where, found: CityThing) -> None:
    outer, inner = [], []
    for side in element:
        name = tag_name(side.tag)[1]
        for ring in side:
            if name in ("exterior", "interior", "outerBoundaryIs", "innerBoundaryIs"):
                (outer if name in ("exterior", "outerBoundaryIs") else inner).append(_coordinates(ring))
                if ring.get(_GML_ID):
                    found.ids.append((ring.get(_GML_ID) or "", ("gml", "LinearRing"), where.feature))
    number = len(found.polygons)
    for body in {where.solid, where.group} - {None}:
        found.bodies[body].members.append((number, where.flipped))
    found.polygons.append(CityPolygon(where.feature, where.name, where.lod, element.get(_GML_ID) or "", kind,
                                  outer + inner, where.solid, where.group, len(outer)))
    if outer:
        _place(where.feature, outer[0])


def _coordinates(element: Element) -> str:
    """The coordinates of a ring or line as one text."""
    texts = [item.text or "" for item in element.iter() if tag_name(item.tag)[1] in ("posList", "pos", "coordinates")]
    return texts[0] if len(texts) == 1 else " ".join(texts)


def _place(feature: CityFeature | None, text: str) -> None:
    """Keep the first place of a feature and of those that hold it."""
    while feature is not None and feature.place is None:
        try:
            feature.place = tuple(map(float, text.split(None, 3)[:3]))
        except ValueError:
            return
        feature = feature.parent


def _with(where: _Where, **changes: object) -> _Where:
    values = {"feature": where.feature, "name": where.name, "lod": where.lod, "solid": where.solid,
              "group": where.group, "flipped": where.flipped}
    return _Where(**{**values, **changes})
