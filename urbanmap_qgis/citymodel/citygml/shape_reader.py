"""Geometry of CityGML objects: polygons, solids with references between them, semantic surfaces.

Source: OGC 03-105r1 (GML 3.1.1), OGC 12-019 (CityGML 2.0).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from xml.etree.ElementTree import Element  # nosec B405 # elements alone, no parser

import numpy as np

from ...geometry.solid import FaceTexture
from ...wording import say
from ..model import BOUNDARY_KINDS, MULTI_SURFACE, OPENINGS, SOLID, CityShape, CitySurface
from ..objects import unmatched_edges
from .schema import (
    ANY_GEOMETRY,
    BOUNDARY_PROPERTY,
    GEOMETRY,
    GML,
    IMPLICIT_GEOMETRY,
    MODULE_OBJECTS,
    OPENING_PROPERTY,
    XLINK_HREF,
)
from .value_reader import Meaning, generic_value, id_of, leaf_value, split_tag

_DEEPEST = 24


@dataclass(frozen=True)
class GmlTextures:
    """What covers polygons: image by polygon id, and places in the image by (polygon id, ring id or "")."""

    images: Mapping[str, str] = field(default_factory=dict)
    places: Mapping[tuple[str, str], np.ndarray] = field(default_factory=dict)


@dataclass
class ShapeReader:
    """Reads the shapes of one building or part.

    Attributes
    ----------
    swapped : whether the file's first coordinate is the northern one.
    textures : of the whole file.
    digits : of plane coordinates that tell corners apart, 3 of metres and 9 of degrees.
    owner : id of the object.
    prototypes : surfaces of prototypes met in the file, in their own coordinates, by id.
    elsewhere : ids of surfaces that belong to areas of the object: its own references to them are no surfaces more.
    problems : what was found wrong.
    unread : elements that the record has no place for, by name.
    """

    swapped: bool
    textures: GmlTextures
    meaning: Meaning
    digits: int = 9
    owner: str = "building"
    prototypes: dict[str, tuple[CitySurface, ...]] = field(default_factory=dict)
    elsewhere: set[str] = field(default_factory=set)
    problems: list[str] = field(default_factory=list)
    unread: Counter = field(default_factory=Counter)
    _unnamed: int = 0

    def shapes(self, element: Element) -> list[CityShape]:
        """All shapes of an object, semantic surfaces where a boundary says what they are."""
        known: dict[str, CitySurface] = {}
        boundaries: dict[str, list[CitySurface]] = {}
        for bounded in _children(element, "bldg", BOUNDARY_PROPERTY):
            for surface in bounded:
                self._boundary(surface, known, boundaries)
        shapes: list[CityShape] = []
        used: set[int] = set()
        for child in element:
            prefix, name = split_tag(child.tag)
            if prefix not in MODULE_OBJECTS or not name.startswith("lod"):
                continue
            if name in IMPLICIT_GEOMETRY:
                shapes += self._prototype(child, IMPLICIT_GEOMETRY[name])
                continue
            found = GEOMETRY.get(name)
            lod = ANY_GEOMETRY.get(name) if found is None else found.lod
            if lod is None:
                self.unread[name] += 1
            for part in child.findall(f".//{{{GML}}}geometryMember") or [child] if lod else ():
                solid = found.kind == SOLID if found else part.find(f".//{{{GML}}}Solid") is not None
                shapes += self._solids(part, lod, known, used) if solid else self._loose(
                    part, lod, found.kind if found else MULTI_SURFACE, known)
        for level, surfaces in boundaries.items():
            rest = tuple(surface for surface in surfaces if id(surface) not in used)
            if rest:
                shapes.append(CityShape(level, MULTI_SURFACE, (rest,)))
        return sorted(shapes, key=lambda shape: shape.lod)

    def _boundary(self, element: Element, known: dict[str, CitySurface],
                  boundaries: dict[str, list[CitySurface]], parent: str = "") -> None:
        """One roof, wall or ground surface with its polygons, and the openings in it; of `parent` an opening."""
        prefix, kind = split_tag(element.tag)
        if prefix != "bldg" or kind not in (OPENINGS if parent else BOUNDARY_KINDS):
            self.unread[kind] += 1
            return
        group, attributes = id_of(element), {}
        openings = [opening for holder in _children(element, "bldg", OPENING_PROPERTY) for opening in holder]
        if openings and not group:
            self._unnamed += 1
            group = f"{self.owner}_s{self._unnamed}"
        for opening in openings:
            self._boundary(opening, known, boundaries, group)
        for child in element:
            prefix, name = split_tag(child.tag)
            if prefix == "gen":
                attributes[child.get("name") or ""] = generic_value(child, self.meaning)
            elif prefix == "gml" and name in ("name", "description"):
                attributes[name] = leaf_value(child, self.meaning)
            elif prefix == "bldg" and name in GEOMETRY and GEOMETRY[name].kind == MULTI_SURFACE:
                for surface in self._surfaces(child, known):
                    boundary = replace(surface, kind=kind, attributes=attributes, group=group, parent=parent)
                    boundaries.setdefault(GEOMETRY[name].lod, []).append(boundary)
                    if boundary.id:
                        known[boundary.id] = boundary
            elif (prefix, name) != ("bldg", OPENING_PROPERTY):
                self.unread[name] += 1

    def _loose(self, element: Element, lod: str, kind: str, known: dict[str, CitySurface]) -> list[CityShape]:
        surfaces = tuple(self._surfaces(element, known))
        first = next(iter(element), None)
        return [CityShape(lod, kind, (surfaces,), id_of(first) if first is not None else "")] if surfaces else []

    def _prototype(self, element: Element, lod: str) -> list[CityShape]:
        """Surfaces of a prototype where it stands (OGC 12-019, 8.2): its own coordinates by the matrix, then the point.

        Prototypes in files of their own, and those of files in degrees, are counted as unread.
        """
        parts = {split_tag(item.tag)[1]: item for implicit in element for item in implicit}
        surfaces = self._prototype_surfaces(parts.get("relativeGMLGeometry"))
        matrix = _numbers(parts.get("transformationMatrix"), 16)
        point = _numbers(next(parts["referencePoint"].iter(f"{{{GML}}}pos"), None)
                         if "referencePoint" in parts else None, 3)
        if not surfaces or point is None or ("transformationMatrix" in parts and matrix is None) or self.digits != 3:
            self.unread[split_tag(element.tag)[1]] += 1
            return []
        turn = np.eye(4) if matrix is None else matrix.reshape(4, 4)

        def standing(ring: np.ndarray) -> np.ndarray:
            corners = ring @ turn[:3, :3].T + turn[:3, 3] + point
            return corners[:, [1, 0, 2]] if self.swapped else corners

        placed = tuple(replace(surface, rings=tuple(map(standing, surface.rings))) for surface in surfaces)
        return [CityShape(lod, MULTI_SURFACE, (placed,))]

    def _prototype_surfaces(self, holder: Element | None) -> tuple[CitySurface, ...]:
        """Surfaces of a prototype in its own coordinates, or of the one met before that it refers to."""
        if holder is None:
            return ()
        reference = holder.get(XLINK_HREF) or ""
        if reference:
            return self.prototypes.get(reference.lstrip("#"), ())
        reader = ShapeReader(False, self.textures, self.meaning, owner=self.owner)
        surfaces = tuple(reader._surfaces(holder, {}))
        self.problems += reader.problems
        for item in holder:
            if id_of(item):
                self.prototypes[id_of(item)] = surfaces
        return surfaces

    def _solids(self, element: Element, lod: str, known: dict[str, CitySurface], used: set[int]) -> list[CityShape]:
        """Solids of one property; their faces are the polygons that boundaries gave, where they refer to them."""
        shapes = []
        for solid in (found for found in element.iter() if split_tag(found.tag) == ("gml", "Solid")):
            shells = []
            for side in solid:
                if split_tag(side.tag)[1] in ("exterior", "interior"):
                    faces = tuple(self._surfaces(side, known))
                    used.update(map(id, faces))
                    shells.append(faces)
            if shells and shells[0]:
                shapes.append(CityShape(lod, SOLID, tuple(shell for shell in shells if shell), id_of(solid)))
                gaps = sum(unmatched_edges(shell, self.digits) for shell in shells)
                if gaps:
                    self.problems.append(say("its solid of level {lod} is not closed ({gaps} edges without a "
                                             "neighbour)", lod=lod, gaps=gaps))
            else:
                self.problems.append(say("its solid of level {lod} has no usable face", lod=lod))
        return shapes

    def _surfaces(self, element: Element, known: Mapping[str, CitySurface], turned: bool = False,
                  depth: int = 0) -> Iterator[CitySurface]:
        """Polygons below an element, also those that it refers to by their ids."""
        if depth > _DEEPEST:
            self.problems.append(say("its surfaces are nested too deep"))
            return
        for child in element:
            name = split_tag(child.tag)[1]
            reference = child.get(XLINK_HREF) or ""
            if reference:
                found = known.get(reference.rpartition("#")[2]) if reference.startswith("#") else None
                if found is None and reference.startswith("#") and reference[1:] in self.elsewhere:
                    continue
                if found is None:
                    self.problems.append(say("it refers to the surface {reference}, which it does not have",
                                             reference=reference[:60]))
                else:
                    yield _turned(found) if turned else found
            elif name in ("Polygon", "Triangle", "Rectangle", "PolygonPatch"):
                surface = self._polygon(child)
                if surface is not None:
                    yield _turned(surface) if turned else surface
            else:
                against = name == "OrientableSurface" and child.get("orientation") == "-"
                yield from self._surfaces(child, known, turned ^ against, depth + 1)

    def _polygon(self, element: Element) -> CitySurface | None:
        identifier = id_of(element)
        rings, names = [], []
        for side in element:
            if split_tag(side.tag)[1] not in ("exterior", "interior", "outerBoundaryIs", "innerBoundaryIs"):
                continue
            ring = next(iter(side), None)
            corners = self._ring(ring) if ring is not None else None
            if corners is None and not rings:
                self.problems.append("a polygon has no usable outer ring")
                return None
            if corners is not None:
                rings.append(corners)
                names.append(id_of(ring))
        if not rings:
            self.problems.append("a polygon has no usable outer ring")
            return None
        return CitySurface(tuple(rings), id=identifier, texture=self._texture(identifier, names, rings))

    def _ring(self, element: Element) -> np.ndarray | None:
        """Corners (n, 3) of a ring: x east, y north, not closed; None where there are fewer than three."""
        numbers, dimension = [], 3
        for child in element.iter():
            name = split_tag(child.tag)[1]
            if name in ("posList", "pos", "coordinates"):
                dimension = int(child.get("srsDimension") or element.get("srsDimension") or dimension)
                numbers += (child.text or "").replace(",", " ").split()
        try:
            values = np.array(numbers, dtype=float)
        except ValueError:
            return None
        if len(values) % dimension:
            dimension = 2 if dimension == 3 else 3
        if dimension not in (2, 3) or len(values) % dimension or not np.isfinite(values).all():
            return None
        corners = values.reshape(-1, dimension)
        if dimension == 2:
            corners = np.column_stack([corners, np.zeros(len(corners))])
        if len(corners) > 1 and (corners[0] == corners[-1]).all():
            corners = corners[:-1]
        if len(corners) < 3:
            return None
        return corners[:, [1, 0, 2]] if self.swapped else corners

    def _texture(self, identifier: str, names: list[str], rings: list[np.ndarray]) -> FaceTexture | None:
        image = self.textures.images.get(identifier)
        if image is None:
            return None
        found = [self.textures.places.get((identifier, name)) for name in names]
        if any(uv is None or len(uv) < len(ring) for uv, ring in zip(found, rings)):
            self.problems.append(say("the texture of polygon {identifier} does not fit its corners and was left out",
                                     identifier=identifier))
            return None
        return FaceTexture(image, tuple(uv[:len(ring)] for uv, ring in zip(found, rings)))


def _turned(surface: CitySurface) -> CitySurface:
    texture = surface.texture
    if texture is not None:
        texture = replace(texture, uv=tuple(places[::-1] for places in texture.uv))
    return replace(surface, rings=tuple(ring[::-1] for ring in surface.rings), texture=texture)


def _numbers(element: Element | None, count: int) -> np.ndarray | None:
    """Finite numbers in an element; None where there are not so many."""
    try:
        values = np.array((element.text or "").split() if element is not None else [], dtype=float)
    except ValueError:
        return None
    return values if len(values) == count and np.isfinite(values).all() else None


def _children(element: Element, prefix: str, name: str) -> Iterator[Element]:
    return (child for child in element if split_tag(child.tag) == (prefix, name))
