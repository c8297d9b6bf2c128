"""Shapes of city objects as GML 3.1.1: solids, multi surfaces, semantic surfaces, textures.

Source: OGC 12-019 (CityGML 2.0), its building and appearance modules.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..model import FOOTPRINT, MULTI_SURFACE, ROOF_EDGE, SOLID, CityObject, CityShape, CitySurface
from .attribute_writer import generic_attribute
from .schema import BOUNDARY_PROPERTY, GEOMETRY, GEOMETRY_NAMES, LAST_BEFORE_BOUNDARIES, THEMES

Places = Callable[[np.ndarray], list[str]]
"""Function from corners (n, 3) to a text of three numbers each."""

_ORDER = tuple(entry for name in GEOMETRY for entry in (
    (name, BOUNDARY_PROPERTY) if name == LAST_BEFORE_BOUNDARIES else (name,)))


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


def object_geometry(item: CityObject, identifier: str, places: Places) -> ObjectGeometry:
    """All shapes of one object that CityGML 2.0 can hold.

    Of several shapes of one level (1.2 and 1.3) the plainer one is written, where there is a level 2, else the more
    detailed one. `identifier` starts the ids of polygons that have none.
    """
    writer = _ShapeWriter(identifier, places, THEMES[item.type])
    elements: dict[str, list[str]] = {name: [] for name in _ORDER}
    for level, shapes in _chosen(item.shapes).items():
        writer.add(level, shapes, elements)
    writer.made.xml = "".join(text for name in _ORDER for text in elements[name])
    return writer.made


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


class _ShapeWriter:
    """Writes shapes of one object; polygons get ids where something refers to them."""

    def __init__(self, identifier: str, places: Places, module: str):
        self.identifier, self.places, self.module = identifier, places, module
        self.made = ObjectGeometry()
        self._count = 0

    def add(self, level: str, shapes: list[CityShape], elements: dict[str, list[str]]) -> None:
        for kind in (FOOTPRINT, ROOF_EDGE):
            name = GEOMETRY_NAMES["0", kind]
            surfaces = [surface for shape in shapes if shape.kind == kind for surface in shape.surfaces]
            if level == "0" and surfaces:
                elements[name].append(f"<bldg:{name}>{self._multi_surface(surfaces)}</bldg:{name}>")
        if level not in "1234":
            return
        semantic = level in "234"
        groups: dict[str, list[tuple[CitySurface, str]]] = {}
        solids = [shape for shape in shapes if shape.kind == SOLID]
        loose = [surface for shape in shapes if shape.kind == MULTI_SURFACE for surface in shape.surfaces]
        if solids:
            name = GEOMETRY_NAMES[level, SOLID]
            inner = [self._solid(shape, groups if semantic else None) for shape in solids]
            one = inner[0] if len(inner) == 1 else (
                "<gml:CompositeSolid>" + "".join(f"<gml:solidMember>{text}</gml:solidMember>" for text in inner)
                + "</gml:CompositeSolid>")
            elements[name].append(f"<bldg:{name}>{one}</bldg:{name}>")
        plain = [surface for surface in loose if not (semantic and surface.kind)]
        for surface in loose:
            if semantic and surface.kind:
                self._bound(surface, groups)
        if plain:
            name = GEOMETRY_NAMES[level, MULTI_SURFACE]
            elements[name].append(f"<{self.module}:{name}>{self._multi_surface(plain)}</{self.module}:{name}>")
        elements[BOUNDARY_PROPERTY] += [self._boundary(group, members, level) for group, members in groups.items()]

    def _multi_surface(self, surfaces: Sequence[CitySurface]) -> str:
        members = "".join(f"<gml:surfaceMember>{self._polygon(surface)}</gml:surfaceMember>" for surface in surfaces)
        return f"<gml:MultiSurface>{members}</gml:MultiSurface>"

    def _solid(self, shape: CityShape, groups: dict | None) -> str:
        """A solid; its semantic surfaces go to `groups` and are referred to."""
        shells = []
        for shell in shape.shells:
            members = []
            for surface in shell:
                if groups is None or not surface.kind:
                    members.append(f"<gml:surfaceMember>{self._polygon(surface)}</gml:surfaceMember>")
                else:
                    members.append(f'<gml:surfaceMember xlink:href="#{self._bound(surface, groups)}"/>')
            shells.append(f"<gml:CompositeSurface>{''.join(members)}</gml:CompositeSurface>")
        named = f' gml:id="{shape.id}"' if shape.id else ""
        inner = "".join(f"<gml:interior>{shell}</gml:interior>" for shell in shells[1:])
        return f"<gml:Solid{named}><gml:exterior>{shells[0]}</gml:exterior>{inner}</gml:Solid>"

    def _bound(self, surface: CitySurface, groups: dict[str, list[tuple[CitySurface, str]]]) -> str:
        """Put a surface into its group; the id of its polygon."""
        identifier = surface.id or self._next()
        groups.setdefault(surface.group or f"{identifier}_b", []).append((surface, identifier))
        return identifier

    def _boundary(self, group: str, members: list[tuple[CitySurface, str]], level: str) -> str:
        first = members[0][0]
        attributes = "".join(generic_attribute(name, value) for name, value in first.attributes.items()
                             if value is not None)
        polygons = "".join(f"<gml:surfaceMember>{self._polygon(surface, identifier)}</gml:surfaceMember>"
                           for surface, identifier in members)
        name = GEOMETRY_NAMES[level, MULTI_SURFACE]
        return (f'<bldg:{BOUNDARY_PROPERTY}><bldg:{first.kind} gml:id="{group}">{attributes}<bldg:{name}>'
                f"<gml:MultiSurface>{polygons}</gml:MultiSurface></bldg:{name}></bldg:{first.kind}>"
                f"</bldg:{BOUNDARY_PROPERTY}>")

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
