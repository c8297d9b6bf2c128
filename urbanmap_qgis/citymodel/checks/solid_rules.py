"""Rules on solids and composite surfaces, and on which polygons they are made of (L14, L16, L18, L-bldg-02 to -09)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_SQUARE, ROUNDING
from ...io.files.rule_table import CheckRule
from .checked_file import CityBlock
from .city_rule_table import Violation, city_rule, violation
from .feature_walk import CityBody, CityFeature, CityThing
from .geometry_rules import NEAREST, PLANE

OUTER_SURFACES = ("bldg:RoofSurface", "bldg:WallSurface", "bldg:GroundSurface", "bldg:OuterFloorSurface",
                  "bldg:OuterCeilingSurface", "bldg:ClosureSurface")
INNER_SURFACES = ("bldg:CeilingSurface", "bldg:InteriorWallSurface", "bldg:FloorSurface", "bldg:ClosureSurface")
OPENINGS = ("bldg:Door", "bldg:Window")

_NO_CORNER = 0.1
"""Bodies that lie side by side along less meet at a corner, m."""
_ONE_PLANE = 1.0 - 1e-6
"""Cosine of the angle of two polygons' planes from which on they are one: 1.4 mm a metre."""

SolidCheck = Callable[..., Any]
"""Function from a body (vertices, faces) to its problems, such as that of the building models (val3dity's codes)."""

_WHY = {303: ("a side or vertex belongs to more faces than two",
              "境界面が立体を分断しています（多様体ではありません）"),
        305: ("it falls into parts", "境界面が複数の部分に分かれています"),
        306: ("faces cross or overlap", "境界面が交差又は重複しています"),
        307: ("a face looks inwards", "境界面の向きが外側を向いていません"),
        405: ("all faces look inwards", "境界面の向きが外側を向いていません"),
        301: ("it has fewer than four faces", "境界面が4面未満です")}


@dataclass(frozen=True, eq=False)
class _Faces:
    """The faces of a solid in a block: numbers of its polygons and whether each is turned over."""

    thing: CityThing
    body: CityBody
    polygons: np.ndarray
    flipped: np.ndarray


@dataclass(frozen=True, eq=False)
class _FacedBody:
    """What the check of solids takes."""

    vertices: np.ndarray
    faces: tuple[tuple[tuple[int, ...], ...], ...]


def member_polygons(thing: CityThing, body: CityBody, deep: int = 0) -> list[tuple[int, bool]] | None:
    """Polygons of a body, in the thing's list, with whether they are turned over; None where one is not there."""
    found: list[tuple[int, bool]] = []
    for member, flipped in body.members:
        if isinstance(member, int):
            found.append((member, flipped))
        elif member in thing.polygon_numbers:
            found.append((thing.polygon_numbers[member], flipped))
        else:
            other = next((one for one in thing.bodies if one.id == member and one is not body), None)
            inner = member_polygons(thing, other, deep + 1) if other is not None and deep < 4 else None
            if not inner:
                return None
            found += [(number, flipped != turned) for number, turned in inner]
    return found


def _bodies(block: CityBlock, *kinds: str) -> list[_Faces]:
    """Bodies of some kinds whose polygons are all there and can be read."""
    found = []
    shapes = block.shapes
    for thing in block.things:
        for body in thing.bodies:
            if body.kind not in kinds:
                continue
            members = member_polygons(thing, body)
            numbers = [shapes.number.get(id(thing.polygons[number])) for number, _ in members or ()]
            if numbers and None not in numbers:
                found.append(_Faces(thing, body, np.array(numbers, int),
                                    np.array([turned for _, turned in members or ()], bool)))
    return found


@dataclass(frozen=True, eq=False)
class _Edges:
    """How often sides of faces meet: (B,) numbers of sides with one face, with more than two, and with two faces that
    turn alike there, for each body."""

    single: np.ndarray
    several: np.ndarray
    alike: np.ndarray


def _edges(block: CityBlock, bodies: list[_Faces]) -> _Edges:
    shapes = block.shapes
    vertex = shapes.vertex_numbers
    following = np.arange(1, len(vertex) + 1)
    following[shapes.start[1:] - 1] = shapes.start[:-1]
    first = shapes.start[np.append(shapes.outer_ring, len(shapes.polygon))]
    polygons = np.concatenate([faces.polygons for faces in bodies])
    count = np.diff(first)[polygons]
    places = np.repeat(first[polygons] - (np.cumsum(count) - count), count) + np.arange(count.sum())
    owner = np.repeat(np.repeat(np.arange(len(bodies)), [len(faces.polygons) for faces in bodies]), count)
    turned = np.repeat(np.concatenate([faces.flipped for faces in bodies]), count)
    table = np.column_stack([owner, vertex[places], vertex[following[places]]])
    side = table[:, 1] != table[:, 2]  # of a closed ring the last place is the first
    table, turned = table[side], turned[side]
    sign = np.where((table[:, 1] < table[:, 2]) != turned, 1, -1)
    table[:, 1:].sort(axis=1)
    order = np.lexsort(table.T[::-1])
    table, sign = table[order], sign[order]
    begin = np.flatnonzero(np.r_[True, (np.diff(table, axis=0) != 0).any(axis=1)])
    count = np.diff(np.append(begin, len(table)))
    turn = np.add.reduceat(sign, begin)
    body = table[begin, 0]
    size = len(bodies)
    return _Edges(np.bincount(body[count == 1], minlength=size), np.bincount(body[count > 2], minlength=size),
                  np.bincount(body[(count == 2) & (turn != 0)], minlength=size))


def _volumes(block: CityBlock, bodies: list[_Faces]) -> np.ndarray:
    """Volume of each body, m3; negative where its faces look inwards."""
    shapes = block.shapes
    vectors = np.add.reduceat(shapes.area_vectors, shapes.outer_ring, axis=0)
    first = shapes.metres[shapes.start[shapes.outer_ring]]
    part = (vectors * first).sum(axis=1) / 3.0
    return np.array([np.sum(np.where(faces.flipped, -part[faces.polygons], part[faces.polygons]))
                     for faces in bodies])


def _plain_prism(block: CityBlock, faces: _Faces) -> bool:
    """Whether a closed body is one polygon pulled up: two heights, one bottom, one top, upright walls."""
    shapes = block.shapes
    upright = np.abs(shapes.normals[faces.polygons, 2])
    if not ((upright < 1e-6) | (upright > 1.0 - ROUNDING)).all() or (upright > 0.5).sum() != 2:
        return False
    first = shapes.start[shapes.outer_ring[faces.polygons]]
    last = shapes.start[np.append(shapes.outer_ring[1:], len(shapes.polygon))[faces.polygons]]
    heights = {height for begin, end in zip(first, last) for height in shapes.raw[begin:end, 2].tolist()}
    return len(heights) == 2


def solid_violations(block: CityBlock, check: SolidCheck) -> Iterator[tuple[str, Violation]]:
    """Solids that are not closed or whose boundary is not valid (L14), with the code of the rule.

    Parameters
    ----------
    check : judges what is no plain prism.
    """
    bodies = _bodies(block, "Solid")
    if not bodies:
        return
    edges, volumes = _edges(block, bodies), _volumes(block, bodies)
    for number, faces in enumerate(bodies):
        sound = not (edges.single[number] or edges.several[number] or edges.alike[number]) and volumes[number] > 0
        if sound and _plain_prism(block, faces):
            continue
        codes = {problem.code for problem in check(_faced(block, faces), planarity=PLANE, snap=NEAREST / 10)}
        place = block.shapes.first_place(int(faces.polygons[0]))
        if 302 in codes:
            count = int(edges.single[number]) or 1
            yield "L14.closed", violation(faces.body.feature, faces.body.lod, place, count=count)
        elif codes & set(_WHY):
            why, why_ja = _WHY[min(codes & set(_WHY))]
            yield "L14.boundary", violation(faces.body.feature, faces.body.lod, place, why=why, why_ja=why_ja)


def _faced(block: CityBlock, faces: _Faces) -> _FacedBody:
    """A body as the check of solids takes it."""
    shapes = block.shapes
    ends = np.append(shapes.outer_ring[1:], len(shapes.polygon))
    vertices, face_loops = [], []
    for polygon, turned in zip(faces.polygons, faces.flipped):
        loops = []
        for ring in range(shapes.outer_ring[polygon], ends[polygon]):
            places = shapes.metres[shapes.start[ring]:shapes.start[ring + 1]]
            places = places[:-1] if shapes.closed[ring] else places
            numbers = range(len(vertices), len(vertices) + len(places))
            vertices += list(places)
            loops.append(tuple(reversed(numbers)) if turned else tuple(numbers))
        face_loops.append(tuple(loops))
    corners, number = np.unique(np.array(vertices), axis=0, return_inverse=True)
    number = number.ravel()
    return _FacedBody(corners, tuple(tuple(tuple(int(number[k]) for k in loop) for loop in face)
                                     for face in face_loops))


@city_rule("L16")
def _closed_surface(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    bodies = _bodies(block, "TriangulatedSurface", "Tin")
    for number in np.flatnonzero(_edges(block, bodies).single == 0) if bodies else ():
        yield violation(bodies[number].body.feature, bodies[number].body.lod)


@city_rule("L18")
def _surface_falls_apart(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    """Composite surfaces outside of solids, whose edges L14 judges: polygons that overlap, or touch no other."""
    shapes = block.shapes
    for faces in _bodies(block, "CompositeSurface"):
        if len(faces.polygons) < 2 or any(shapes.polygons[number].owner is not None for number in faces.polygons):
            continue
        place = shapes.first_place(int(faces.polygons[0]))
        if _overlapping(block, faces):
            yield violation(faces.body.feature, faces.body.lod, place, why="polygons that overlap",
                            why_ja="重なる多角形があります")
        elif any(not _touches(block, faces, k) for k in _without_common_corner(block, faces)):
            yield violation(faces.body.feature, faces.body.lod, place, why="a polygon that touches no other",
                            why_ja="他のいずれとも接していない多角形があります")


def _plan(block: CityBlock, number: int) -> shapely.Polygon:
    """Outer ring of a polygon in plan, m."""
    shapes = block.shapes
    ring = shapes.outer_ring[number]
    return shapely.Polygon(shapes.metres[shapes.start[ring]:shapes.start[ring + 1], :2])


def _without_common_corner(block: CityBlock, faces: _Faces) -> list[int]:
    """Numbers in a surface of the polygons whose outer ring has no place of another one's."""
    shapes = block.shapes
    rings = shapes.outer_ring[faces.polygons]
    corners = [np.unique(shapes.vertex_numbers[shapes.start[ring]:shapes.start[ring + 1]]) for ring in rings]
    numbers, owners = np.unique(np.concatenate(corners), return_counts=True)
    shared = set(numbers[owners > 1].tolist())
    return [k for k, one in enumerate(corners) if shared.isdisjoint(one.tolist())]


def _touches(block: CityBlock, faces: _Faces, k: int) -> bool:
    """Whether a polygon lies at another one of its surface without a common vertex."""
    own, others = closed_rings(block, [faces.polygons[k]]), closed_rings(block, np.delete(faces.polygons, k))
    return bool(near_lines(np.vstack(own), others).any() or near_lines(np.vstack(others), own).any())


def _overlapping(block: CityBlock, faces: _Faces) -> bool:
    """Whether two polygons of a surface lie in one plane and share more than a border."""
    shapes = block.shapes
    normals = shapes.normals[faces.polygons]
    first = shapes.metres[shapes.start[shapes.outer_ring[faces.polygons]]]
    waiting = np.ones(len(normals), bool)
    while waiting.any():
        k = int(np.argmax(waiting))
        plane = waiting & (np.abs(normals @ normals[k]) > _ONE_PLANE)
        plane &= np.abs((first - first[k]) @ normals[k]) < NEAREST
        plane[k] = True
        waiting &= ~plane
        if plane.sum() > 1 and _share_area(block, faces.polygons[plane], normals[k]):
            return True
    return False


def _share_area(block: CityBlock, numbers: np.ndarray, normal: np.ndarray) -> bool:
    """Whether any two polygons of a plane overlap by more than `NEAREST` across, seen along its steepest axis."""
    axes = np.delete(np.arange(3), np.argmax(np.abs(normal)))
    low, high = (corners[numbers][:, axes] for corners in block.shapes.boxes)
    boxes = shapely.box(*low.T, *high.T)
    one, other = shapely.STRtree(boxes).query(boxes)
    wide = (np.minimum(high[one], high[other]) - np.maximum(low[one], low[other]) > NEAREST).all(axis=1)
    one, other = one[wide & (one < other)], other[wide & (one < other)]
    seen = np.full(len(numbers), None, object)
    for number in {*one.tolist(), *other.tolist()}:
        outer, *holes = (ring[:, axes] for ring in closed_rings(block, [numbers[number]]))
        seen[number] = shapely.make_valid(shapely.Polygon(outer, holes))
    drawn = seen[~shapely.is_missing(seen)]
    if shapely.area(drawn).sum() - shapely.area(shapely.union_all(drawn)) < NEAREST ** 2:
        return False  # most surfaces: sooner known than pair by pair
    common = shapely.intersection(seen[one], seen[other])
    return not shapely.is_empty(shapely.buffer(common, -NEAREST / 2.0)).all()


def closed_rings(block: CityBlock, numbers: Sequence[int] | np.ndarray) -> list[np.ndarray]:
    """Places (n, 3) m of all rings of polygons, closed."""
    shapes = block.shapes
    ends = np.append(shapes.outer_ring[1:], len(shapes.polygon))
    found = []
    for number in numbers:
        for ring in range(shapes.outer_ring[number], ends[number]):
            places = shapes.metres[shapes.start[ring]:shapes.start[ring + 1]]
            found.append(places if shapes.closed[ring] else np.vstack([places, places[:1]]))
    return found


def near_lines(points: np.ndarray, rings: list[np.ndarray]) -> np.ndarray:
    """Which points (n, 3) lie on sides of rings, within `NEAREST` m."""
    near = np.zeros(len(points), bool)
    for ring in rings:
        start, step = ring[:-1], np.diff(ring, axis=0)
        length = np.maximum((step ** 2).sum(axis=1), LEAST_SQUARE)
        share = np.clip(np.einsum("pij,ij->pi", points[:, None] - start, step) / length, 0.0, 1.0)
        away = points[:, None] - start - share[:, :, None] * step
        near |= ((away ** 2).sum(axis=2) <= NEAREST ** 2).any(axis=1)
    return near


@city_rule("L-bldg-02")
def _parts_apart(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for thing in block.things:
        parts = [one for one in thing.features if one.type == "bldg:BuildingPart"]
        if len(parts) < 2:
            continue
        for level in (2, 3, 4):
            boxes = [extent_of(block, thing, body) for body in thing.bodies
                     if body.kind == "Solid" and body.lod == level and body.feature in parts]
            known = [box for box in boxes if box is not None]
            if len(known) > 1 and not _connected(known):
                yield violation(thing.features[0], level)


def extent_of(block: CityBlock, thing: CityThing,
              body: CityBody) -> tuple[shapely.Geometry, float, float] | None:
    """Plan of a solid and its lowest and highest place, m; None where a polygon is not there."""
    numbers = [block.shapes.number.get(id(thing.polygons[k])) for k, _ in member_polygons(thing, body) or ()]
    if not numbers or None in numbers:
        return None
    shapes = block.shapes
    places = np.vstack([shapes.metres[slice(*shapes.start[[ring, ring + 1]])] for ring in shapes.outer_ring[numbers]])
    level = [number for number in numbers if abs(shapes.normals[number, 2]) > 0.1]
    plan = shapely.union_all(shapely.make_valid(np.array([_plan(block, number) for number in level], object)))
    return plan, float(places[:, 2].min()), float(places[:, 2].max())


def _connected(boxes: list[tuple[shapely.Geometry, float, float]]) -> bool:
    """Whether all bodies hang together by bodies that share a face."""
    reached, waiting = {0}, [0]
    while waiting:
        plan, low, high = boxes[waiting.pop()]
        for number, (other, floor, roof) in enumerate(boxes):
            if number not in reached and _share_a_face(plan, other, min(high, roof) - max(low, floor)):
                reached.add(number)
                waiting.append(number)
    return len(reached) == len(boxes)


def _share_a_face(plan: shapely.Geometry, other: shapely.Geometry, height: float) -> bool:
    """Whether two bodies whose heights overlap by `height` (m) lie side by side, or one above the other; a corner in
    common is no face."""
    if height <= -NEAREST or shapely.distance(plan, other) >= NEAREST:
        return False
    if shapely.area(shapely.intersection(plan, other)) > _NO_CORNER * NEAREST:
        return True
    side = shapely.area(shapely.intersection(shapely.buffer(plan, NEAREST / 2), shapely.buffer(other, NEAREST / 2)))
    return height > NEAREST and bool(side > _NO_CORNER * NEAREST)


@city_rule("L-bldg-03")
def _opening_outside(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    shapes = block.shapes
    owners: dict[tuple[int, int], list[int]] = {}
    for number, polygon in enumerate(shapes.polygons):
        owners.setdefault((id(polygon.feature), polygon.lod or 0), []).append(number)
    for feature in block.features(*OPENINGS):
        for level in sorted(feature.lods):
            inner, around = owners.get((id(feature), level)), owners.get((id(feature.parent), level))
            if inner and around and not _covered(block, inner, around):
                yield violation(feature, level, shapes.first_place(inner[0]))


def _axes_of(normal: np.ndarray) -> np.ndarray:
    """Two axes (3, 2) at right angles to a normal."""
    helper = np.array([1.0, 0.0, 0.0]) if abs(normal[2]) > 0.5 else np.array([0.0, 0.0, 1.0])
    first = np.cross(helper, normal)
    first /= max(float(np.linalg.norm(first)), ROUNDING)
    return np.column_stack([first, np.cross(normal, first)])


def _covered(block: CityBlock, inner: list[int], around: list[int]) -> bool:
    """Whether polygons, seen along the normal of those around them, lie within their outer rings."""
    shapes = block.shapes
    axes = _axes_of(shapes.normals[around[0]])

    def seen(number: int) -> shapely.Geometry:
        ring = shapes.outer_ring[number]
        return shapely.make_valid(shapely.Polygon(shapes.metres[shapes.start[ring]:shapes.start[ring + 1]] @ axes))

    wall = shapely.union_all([seen(number) for number in around])
    return bool(shapely.covers(shapely.buffer(wall, PLANE), shapely.union_all([seen(number) for number in inner])))


def boundary_ids(thing: CityThing, holder: CityFeature, surfaces: tuple[str, ...], level: int) -> set[str]:
    """Ids of the polygons of a level in the boundary surfaces of a feature and of its installations, with openings."""
    def is_below(feature: CityFeature) -> bool:
        above = feature.parent
        if feature.type in OPENINGS:
            return above is not None and is_below(above)
        return feature.type in surfaces and above is not None and (above is holder or (
            above.type.endswith("BuildingInstallation") and above.parent is holder))

    return {polygon.id for polygon in thing.polygons if polygon.lod == level and polygon.id
            and is_below(polygon.feature)}


def _foreign_faces(block: CityBlock, types: tuple[str, ...], names: tuple[str, ...], surfaces: tuple[str, ...],
                   ) -> Iterator[Violation]:
    """Solids with a face that is none of the boundary surfaces' polygons."""
    for thing in block.things:
        for body in thing.bodies:
            if body.kind not in ("Solid", "MultiSurface") or body.name not in names or body.feature.type not in types:
                continue
            members = member_polygons(thing, body) or []
            known = boundary_ids(thing, body.feature, surfaces, body.lod or 0)
            for _ in _elsewhere(thing, body):
                yield violation(body.feature, body.lod, level=body.lod)
            for number, _ in members:
                if thing.polygons[number].id not in known:
                    yield violation(body.feature, body.lod, level=body.lod)


def _elsewhere(thing: CityThing, body: CityBody) -> list[str]:
    """Ids that a body refers to and that its city object does not have."""
    own = {one.id for one in thing.bodies}
    return [member for member, _ in body.members
            if isinstance(member, str) and member not in thing.polygon_numbers and member not in own]


@city_rule("L-bldg-06")
def _no_boundary_surface(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    yield from _foreign_faces(block, ("bldg:Building", "bldg:BuildingPart"), ("lod2Solid", "lod3Solid"),
                              OUTER_SURFACES)


@city_rule("L-bldg-08")
def _no_boundary_surface_4(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    yield from _foreign_faces(block, ("bldg:Building", "bldg:BuildingPart"), ("lod4Solid", "lod4MultiSurface"),
                              OUTER_SURFACES)


@city_rule("L-bldg-09")
def _no_room_surface(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    yield from _foreign_faces(block, ("bldg:Room",), ("lod4Solid",), INNER_SURFACES)


@city_rule("L-tran-03")
def _area_not_referred(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for thing in block.things:
        road = thing.features[0]
        if road.type != "tran:Road":
            continue
        referred = {link.target.lstrip("#") for link in thing.references if link.feature is road}
        for feature in thing.features[1:]:
            if feature.type not in ("tran:TrafficArea", "tran:AuxiliaryTrafficArea"):
                continue
            for level in sorted(feature.lods & {2, 3}):
                polygons = [polygon for polygon in thing.polygons
                            if polygon.feature is feature and polygon.lod == level]
                named = {polygon.id for polygon in polygons} | {body.id for body in thing.bodies
                                                                if body.feature is feature}
                if polygons and not named & referred:
                    yield violation(road, level, level=level, area=feature.id)
