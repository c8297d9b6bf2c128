"""From outlines as surveyed to one valid polygon a building: rings of lines, duplicates, repairs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ...wording import say

Attributes = dict  # name -> list of values, one for each geometry


@dataclass(frozen=True)
class Buildings:
    """Geometries (polygons, or lines on the way there) and as many values of each attribute."""

    polygons: np.ndarray
    attributes: Attributes

    def taken(self, index: np.ndarray) -> Buildings:
        """The members at `index` (integers or a mask)."""
        chosen = np.arange(len(self.polygons))[index].tolist()
        return Buildings(self.polygons[index],
                         {name: [values[i] for i in chosen] for name, values in self.attributes.items()})


def concatenated(first: Buildings, second: Buildings) -> Buildings:
    """Both, one after the other."""
    return Buildings(np.concatenate([first.polygons, second.polygons]),
                     {name: values + second.attributes[name] for name, values in first.attributes.items()})


def one_of_each(objects: Buildings) -> tuple[Buildings, int]:
    """Keep the first of objects with the same fid and the same geometry; also how many were dropped.

    The point at which a ring starts and the direction in which it runs make no difference.
    """
    keys = zip(objects.attributes["fid"], shapely.to_wkb(shapely.normalize(objects.polygons)))
    first: dict[tuple, int] = {}
    for index, key in enumerate(keys):
        first.setdefault(key, index)
    rows = np.fromiter(first.values(), dtype=np.intp, count=len(first))
    if len(rows) == len(objects.polygons):
        return objects, 0
    return objects.taken(rows), len(objects.polygons) - len(rows)


def buildings_from_lines(lines: Buildings, notes: list[str]) -> Buildings:
    """Polygons from outlines given as lines (BldL).

    A closed line is a building, or the courtyard of the building of the same type in which it lies.
    Open lines that close rings together become buildings too, with the attributes of the first of them in
    the file; the rest is counted in `notes`.
    """
    closed = shapely.is_closed(lines.polygons) & (shapely.get_num_points(lines.polygons) >= 4)
    rings, courtyards = _with_courtyards(lines.taken(closed))
    if courtyards:
        notes.append(say("{courtyards} closed outlines (BldL) inside another of the same type were taken as "
                         "courtyards.", courtyards=courtyards))
    loose = lines.taken(~closed)
    if len(loose.polygons) == 0:
        return rings
    faces, used = _faces(loose)
    if used.any():
        notes.append(say("{sum} open outlines (BldL) that close rings together became {polygons_count} buildings: "
                         "check them, a ring may also lie between buildings.", sum=used.sum(),
                         polygons_count=len(faces.polygons)))
    if not used.all():
        notes.append(say("{sum} open outlines (BldL) close no ring and are missing in the result: give the "
                         "neighbouring map sheets too, or BldA files.", sum=(~used).sum()))
    return concatenated(rings, faces)


def without_known(objects: Buildings, areas: Buildings) -> tuple[Buildings, int]:
    """Drop lines that lie wholly on or in an area, and polygons whose inner point does; also how many."""
    if len(objects.polygons) == 0 or len(areas.polygons) == 0:
        return objects, 0
    areal = shapely.get_type_id(objects.polygons) == shapely.GeometryType.POLYGON
    probes = np.where(areal, shapely.point_on_surface(objects.polygons), objects.polygons)
    known = np.unique(shapely.STRtree(areas.polygons).query(probes, predicate="covered_by")[0])
    if len(known) == 0:
        return objects, 0
    keep = np.ones(len(probes), dtype=bool)
    keep[known] = False
    return objects.taken(keep), len(known)


def repaired(buildings: Buildings) -> tuple[Buildings, int]:
    """Make invalid polygons valid; also how many were. Each part of one that falls apart is a building."""
    bad = np.flatnonzero(~shapely.is_valid(buildings.polygons))
    if len(bad) == 0:
        return buildings, 0
    geometries = buildings.polygons.copy()
    geometries[bad] = shapely.make_valid(geometries[bad])
    parts, owner = shapely.get_parts(geometries, return_index=True)
    parts, nested = shapely.get_parts(parts, return_index=True)  # multipolygons in a collection
    owner = owner[nested]
    areal = (shapely.get_type_id(parts) == shapely.GeometryType.POLYGON) & (shapely.area(parts) > 0)
    whole = buildings.taken(owner[areal])
    return Buildings(parts[areal], whole.attributes), len(bad)


def _with_courtyards(rings: Buildings) -> tuple[Buildings, int]:
    """Polygons of closed lines; every second level of nesting within a type is a hole, not a building."""
    if len(rings.polygons) == 0:
        return rings, 0
    coordinates, of_ring = shapely.get_coordinates(rings.polygons, return_index=True)
    polygons = shapely.polygons(shapely.linearrings(coordinates, indices=of_ring))
    outlines = Buildings(polygons, rings.attributes)
    valid = shapely.is_valid(polygons)
    kinds = np.array([kind or "" for kind in rings.attributes["type"]], dtype=object)
    inner, outer = shapely.STRtree(polygons).query(shapely.point_on_surface(polygons), predicate="within")
    separate = (inner != outer) & valid[inner] & valid[outer] & (kinds[inner] == kinds[outer])
    inner, outer = inner[separate], outer[separate]
    contained = shapely.covers(polygons[outer], polygons[inner]) & (
        shapely.area(polygons[outer]) > shapely.area(polygons[inner]))
    inner, outer = inner[contained], outer[contained]
    depth = np.bincount(inner, minlength=len(polygons))
    hole = depth % 2 == 1
    if not hole.any():
        return outlines, 0
    # The owner of a hole is the innermost ring around it, the one exactly a level up.
    owned = hole[inner] & (depth[outer] == depth[inner] - 1)
    polygons = polygons.copy()
    for owner in np.unique(outer[owned]):
        polygons[owner] = shapely.difference(
            polygons[owner], shapely.union_all(polygons[inner[owned & (outer == owner)]]))
    return Buildings(polygons, rings.attributes).taken(~hole), int(hole.sum())


def _faces(lines: Buildings) -> tuple[Buildings, np.ndarray]:
    """Polygons that open lines enclose together, and which of the lines have part in one."""
    polygons = shapely.get_parts(shapely.polygonize(lines.polygons))
    used = np.zeros(len(lines.polygons), dtype=bool)
    if len(polygons) == 0:
        return Buildings(polygons, {name: [] for name in lines.attributes}), used
    face, line = shapely.STRtree(lines.polygons).query(shapely.boundary(polygons), predicate="covers")
    used[line] = True
    first = np.full(len(polygons), len(lines.polygons))
    np.minimum.at(first, face, line)
    order = np.argsort(first, kind="stable")
    return Buildings(polygons[order], lines.taken(first[order]).attributes), used
