"""Shapes of city objects as GML 3.1.1: solids, multi surfaces, semantic surfaces, textures.

Source: OGC 12-019 (CityGML 2.0), its building and appearance modules.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..model import (
    FITTINGS,
    FOOTPRINT,
    FURNITURE,
    INNER_INSTALLATION,
    INSTALLATION,
    MULTI_SURFACE,
    OPENINGS,
    ROAD,
    ROOF_EDGE,
    SOLID,
    STREET_KINDS,
    WALL_SURFACE,
    CityObject,
    CityShape,
    CitySurface,
)
from .attribute_writer import generic_attribute
from .schema import (
    ANY_GEOMETRY,
    BOUNDARY_PROPERTY,
    GEOMETRY,
    GEOMETRY_NAMES,
    LAST_BEFORE_BOUNDARIES,
    OPENING_PROPERTY,
    THEMES,
)

Places = Callable[[np.ndarray], list[str]]
"""Function from corners (n, 3) to a text of three numbers each."""

INSTALLATIONS = "installations"
"""Where the schema has the installations of a building, before its boundary surfaces."""

_ANY_KIND = (INSTALLATION, INNER_INSTALLATION, FURNITURE, *STREET_KINDS)
"""Objects whose properties hold geometry of any kind."""

_ORDER = (*(entry for name in GEOMETRY for entry in (
    (name, INSTALLATIONS, BOUNDARY_PROPERTY) if name == LAST_BEFORE_BOUNDARIES else (name,))), *ANY_GEOMETRY)


@dataclass
class ObjectGeometry:
    """XML of an object's geometry, and what its polygons are covered by.

    Attributes
    ----------
    xml : elements in the schema's order.
    textured : by image: id of the polygon, and of each ring its id and the places of its corners in the image.
    """

    xml: str = ""
    textured: dict[str, list[tuple[str, list[tuple[str, np.ndarray]]]]] = field(default_factory=dict)


def object_geometry(item: CityObject, identifier: str, places: Places, installations: str = "") -> ObjectGeometry:
    """All shapes of one object that CityGML 2.0 can hold.

    Of several shapes of one level (1.2 and 1.3) the plainer one is written, where there is a level 2, else the more
    detailed one. Interiors are of level 4 in CityGML 2.0, installations of level 2 at least, whatever level a source
    gives them.

    Parameters
    ----------
    identifier : starts the ids of polygons that have none.
    installations : XML of the object's installations, which the schema has in the middle of the geometry.
    """
    writer = _ShapeWriter(identifier, places, item.type)
    elements: dict[str, list[str]] = {name: [] for name in _ORDER}
    for level, shapes in _written_levels(item).items():
        writer.add(level, shapes, elements)
    for level, members in _area_polygons(item).items():
        name = f"tran:lod{level}MultiSurface"
        elements[GEOMETRY_NAMES[level, MULTI_SURFACE]].append(
            f"<{name}><gml:MultiSurface>{members}</gml:MultiSurface></{name}>")
    elements[INSTALLATIONS].append(installations)
    elements[BOUNDARY_PROPERTY] += writer.boundaries()
    if item.type in _ANY_KIND:  # their schema has the boundary surfaces last
        elements[BOUNDARY_PROPERTY], last = [], elements[BOUNDARY_PROPERTY]
        elements[next(reversed(elements))] += last
    writer.made.xml = "".join(text for texts in elements.values() for text in texts)
    return writer.made


def _area_polygons(item: CityObject) -> dict[str, str]:
    """Of a road that is divided into areas: references to their polygons by level, as its own surface is made of
    them."""
    if item.type != ROAD:
        return {}
    found: dict[str, str] = {}
    own = {shape.lod[:1] for shape in item.shapes}
    for area in item.fittings:
        for shape in area.shapes:
            found[shape.lod[:1]] = found.get(shape.lod[:1], "") + "".join(
                f'<gml:surfaceMember xlink:href="#{surface.id}"/>' for surface in shape.surfaces if surface.id)
    return {level: members for level, members in found.items() if members and level not in own}


def _written_levels(item: CityObject) -> dict[str, list[CityShape]]:
    """Shapes to write by the level of CityGML 2.0 that they are written at."""
    chosen = _chosen(item.shapes)
    if item.type not in FITTINGS:
        return chosen
    least = "2" if item.type == INSTALLATION else "4"
    return {max(level, least): chosen[level] for level in sorted(chosen)}


def _chosen(shapes: Sequence[CityShape]) -> dict[str, list[CityShape]]:
    """Shapes to write by level "0" to "4", those of one decimal level each."""
    by_level: dict[str, dict[str, list[CityShape]]] = {}
    for shape in shapes:
        by_level.setdefault(shape.lod[:1], {}).setdefault(shape.lod, []).append(shape)
    chosen = {}
    for level, found in by_level.items():
        plain = level == "1" and "2" in by_level
        chosen[level] = found[min(found) if plain else max(found)] if level != "0" else [
            shape for same in found.values() for shape in same]
    return chosen


@dataclass
class _Boundary:
    """A boundary surface or an opening: its first polygon, and polygons with their ids by level."""

    first: CitySurface
    levels: dict[str, list[tuple[CitySurface, str]]] = field(default_factory=dict)


class _ShapeWriter:
    """Writes shapes of one object; polygons get ids where something refers to them."""

    def __init__(self, identifier: str, places: Places, kind: str):
        self.identifier, self.places, self.module = identifier, places, THEMES[kind]
        self.any_kind = kind in _ANY_KIND
        self.made = ObjectGeometry()
        self._groups: dict[str, _Boundary] = {}
        self._count = 0

    def add(self, level: str, shapes: list[CityShape], elements: dict[str, list[str]]) -> None:
        """Write the shapes of a level; their semantic surfaces wait for `boundaries`."""
        for kind in (FOOTPRINT, ROOF_EDGE):
            name = GEOMETRY_NAMES["0", kind]
            surfaces = [surface for shape in shapes if shape.kind == kind for surface in shape.surfaces]
            if level == "0" and surfaces:
                elements[name].append(f"<bldg:{name}>{self._multi_surface(surfaces)}</bldg:{name}>")
        if level not in "1234":
            return
        semantic = level in "234"
        solids = [self._solid(shape, level, semantic) for shape in shapes if shape.kind == SOLID]
        loose = [surface for shape in shapes if shape.kind == MULTI_SURFACE for surface in shape.surfaces]
        plain = [surface for surface in loose if not (semantic and surface.kind)]
        for surface in loose:
            if semantic and surface.kind:
                self._bound(surface, level)
        found = {}
        if solids:
            found[SOLID] = solids[0] if len(solids) == 1 else (
                "<gml:CompositeSolid>" + "".join(f"<gml:solidMember>{text}</gml:solidMember>" for text in solids)
                + "</gml:CompositeSolid>")
        if plain:
            found[MULTI_SURFACE] = self._multi_surface(plain)
        for name, text in self._properties(level, found):
            elements[name].append(f"<{self.module}:{name}>{text}</{self.module}:{name}>")

    def _properties(self, level: str, found: dict[str, str]) -> list[tuple[str, str]]:
        """Names and values of the properties that hold geometry, by its kind; of any kind there is one only."""
        if not self.any_kind or not found:
            return [(GEOMETRY_NAMES[level, kind], text) for kind, text in found.items()]
        members = "".join(f"<gml:geometryMember>{text}</gml:geometryMember>" for text in found.values())
        one = next(iter(found.values())) if len(found) == 1 else f"<gml:MultiGeometry>{members}</gml:MultiGeometry>"
        return [(f"lod{level}Geometry", one)]

    def _multi_surface(self, surfaces: Sequence[CitySurface]) -> str:
        members = "".join(f"<gml:surfaceMember>{self._polygon(surface)}</gml:surfaceMember>" for surface in surfaces)
        return f"<gml:MultiSurface>{members}</gml:MultiSurface>"

    def _solid(self, shape: CityShape, level: str, semantic: bool) -> str:
        """A solid; its semantic surfaces are referred to."""
        shells = []
        for shell in shape.shells:
            members = []
            for surface in shell:
                if not semantic or not surface.kind:
                    members.append(f"<gml:surfaceMember>{self._polygon(surface)}</gml:surfaceMember>")
                else:
                    members.append(f'<gml:surfaceMember xlink:href="#{self._bound(surface, level)}"/>')
            shells.append(f"<gml:CompositeSurface>{''.join(members)}</gml:CompositeSurface>")
        named = f' gml:id="{shape.id}"' if shape.id else ""
        inner = "".join(f"<gml:interior>{shell}</gml:interior>" for shell in shells[1:])
        return f"<gml:Solid{named}><gml:exterior>{shells[0]}</gml:exterior>{inner}</gml:Solid>"

    def _bound(self, surface: CitySurface, level: str) -> str:
        """Put a surface into its group; the id of its polygon. Openings below level 3 are part of their wall."""
        identifier = surface.id or self._next()
        if surface.kind in OPENINGS and level < "3":
            surface = replace(surface, kind=WALL_SURFACE, group=surface.parent or surface.group, parent="")
        group = self._groups.setdefault(surface.group or f"{identifier}_b", _Boundary(surface))
        group.levels.setdefault(level, []).append((surface, identifier))
        return identifier

    def boundaries(self) -> list[str]:
        """Elements of all boundary surfaces with the openings in them."""
        openings: dict[str, list[str]] = {}
        for name, group in self._groups.items():
            if group.first.kind in OPENINGS:
                parent = group.first.parent if group.first.parent in self._groups else f"{name}_wall"
                openings.setdefault(parent, []).append(
                    f"<bldg:{OPENING_PROPERTY}>{self._boundary(name, group)}</bldg:{OPENING_PROPERTY}>")
        without_openings = {name: group for name, group in self._groups.items() if group.first.kind not in OPENINGS}
        # An opening whose wall is not there has a wall without faces, as the schema wants one.
        walls = {name: _Boundary(CitySurface((), WALL_SURFACE)) for name in openings if name not in without_openings}
        return [f"<bldg:{BOUNDARY_PROPERTY}>{self._boundary(name, group, ''.join(openings.get(name, ())))}"
                f"</bldg:{BOUNDARY_PROPERTY}>" for name, group in {**without_openings, **walls}.items()]

    def _boundary(self, name: str, group: _Boundary, openings: str = "") -> str:
        """A boundary surface or an opening with its attributes and polygons, level by level."""
        attributes = "".join(generic_attribute(key, value) for key, value in group.first.attributes.items()
                             if value is not None)
        texts = []
        for level, members in sorted(group.levels.items()):
            polygons = "".join(f"<gml:surfaceMember>{self._polygon(surface, identifier)}</gml:surfaceMember>"
                               for surface, identifier in members)
            place = GEOMETRY_NAMES[level, MULTI_SURFACE]
            texts.append(f"<bldg:{place}><gml:MultiSurface>{polygons}</gml:MultiSurface></bldg:{place}>")
        kind = group.first.kind
        return f'<bldg:{kind} gml:id="{name}">{attributes}{"".join(texts)}{openings}</bldg:{kind}>'

    def _polygon(self, surface: CitySurface, identifier: str = "") -> str:
        identifier = identifier or surface.id or (self._next() if surface.texture else "")
        rings = []
        for number, ring in enumerate(surface.rings):
            texts = self.places(ring)
            tag = "exterior" if number == 0 else "interior"
            named = f' gml:id="{identifier}_r{number}"' if surface.texture else ""
            rings.append(f"<gml:{tag}><gml:LinearRing{named}><gml:posList>{' '.join([*texts, texts[0]])}</gml:posList>"
                         f"</gml:LinearRing></gml:{tag}>")
        if surface.texture:
            rows = [(f"{identifier}_r{number}", np.asarray(uv)) for number, uv in enumerate(surface.texture.uv)]
            self.made.textured.setdefault(surface.texture.image, []).append((identifier, rows))
        named = f' gml:id="{identifier}"' if identifier else ""
        return f"<gml:Polygon{named}>{''.join(rings)}</gml:Polygon>"

    def _next(self) -> str:
        self._count += 1
        return f"{self.identifier}_{self._count}"
