"""Rules on lines, rings and polygons (L06 to L13, L15, L17; L10 also on what must look up)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from ...io.files.rule_table import CheckRule
from .checked_file import CityBlock
from .city_rule_table import Violation, city_rule, violation

NEAREST = 0.01
"""Neighbouring vertices lie at least so far apart, m (L07)."""
PLANE, PLANE_LOD1 = 0.03, 0.01
"""Farthest that a vertex may lie off its polygon's plane, m: L12's tolerance; L11 asks for a plane, which coordinates
keep to the distance at which vertices count as one (L07)."""
_LATITUDES, _LONGITUDES, _HEIGHTS = (20.0, 46.0), (122.0, 154.0), (-1000.0, 5000.0)
_ROUNDING = np.array([1e-8, 1e-8, 1e-3])
"""What the envelope's coordinates may have been rounded by: about 1 mm."""
_FACING_UP = ("tran:Road", "tran:TrafficArea", "tran:AuxiliaryTrafficArea", "tran:Railway", "tran:Track",
              "tran:Square")


@city_rule("L02.coordinates")
def _unreadable(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for polygon in block.shapes.unreadable:
        yield violation(polygon.feature, polygon.lod)


@city_rule("L06")
def _outside(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    low, high = block.file.low, block.file.high
    if low is None or high is None:
        return
    slack = _ROUNDING if block.file.geographic else 1e-3
    shapes = block.shapes
    off = ((shapes.raw < low - slack) | (shapes.raw > high + slack)).any(axis=1)
    reported = set()
    for place in np.flatnonzero(off):
        polygon = shapes.polygons[shapes.polygon[shapes.ring_of_place[place]]]
        key = (id(polygon.feature), polygon.name)
        if key not in reported:
            reported.add(key)
            yield violation(polygon.feature, polygon.lod, tuple(shapes.raw[place, :2]), name=polygon.name)
    for line in (line for thing in block.things for line in thing.lines):
        places = _places(line.text)
        if places is not None and ((places < low - slack) | (places > high + slack)).any():
            yield violation(line.feature, line.lod, tuple(places[0, :2]), name="gml:LineString")


@city_rule("L06.earth")
def _off_the_earth(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    if "EPSG/0/6697" not in block.file.system:
        return
    shapes = block.shapes
    low, high = np.array([_LATITUDES, _LONGITUDES, _HEIGHTS]).T
    reported = set()
    for place in np.flatnonzero(((shapes.raw < low) | (shapes.raw > high)).any(axis=1)):
        polygon = shapes.polygons[shapes.polygon[shapes.ring_of_place[place]]]
        if id(polygon) not in reported:
            reported.add(id(polygon))
            yield violation(polygon.feature, polygon.lod, where=" ".join(map(repr, shapes.raw[place].tolist())))


@city_rule("L07")
def _too_near(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    shapes = block.shapes
    if len(shapes.start) > 1:
        shortest = np.fmin.reduceat(shapes.side_lengths, shapes.start[:-1])
        for ring in np.flatnonzero(~(shortest >= NEAREST)):
            polygon = shapes.polygons[shapes.polygon[ring]]
            if polygon.lod != 4:  # LOD4 comes from BIM models, which L07 leaves out
                yield _at(block, int(shapes.polygon[ring]), distance=f"{np.nan_to_num(shortest[ring]):.4f}")
    for line in (line for thing in block.things for line in thing.lines):
        places = _places(line.text)
        if places is None or len(places) < 2:
            yield violation(line.feature, line.lod, distance="-")


@city_rule("L08")
def _line_crosses_itself(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for line in (line for thing in block.things for line in thing.lines):
        places = _places(line.text)
        if places is not None and len(places) > 2:
            # in plan two parts of a line may lie over each other: seen from three sides at least one shows them apart
            views = (shapely.linestrings(places[:, axes]) for axes in ([0, 1], [0, 2], [1, 2]))
            if not any(shapely.is_simple(view) and shapely.length(view) > 0 for view in views):
                yield violation(line.feature, line.lod, tuple(places[0, :2]))


@city_rule("L09")
def _ring(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    """Polygons with a faulty ring; those whose inner rings lie wrong are told as L13, with the ring's fault."""
    holed = _faulty_holes(block)
    for number, (why, why_ja) in _faulty_rings(block).items():
        if number not in holed:
            yield _at(block, number, why=why, why_ja=why_ja)


def _faulty_rings(block: CityBlock) -> dict[int, tuple[str, str]]:
    """Polygons with a ring that is not closed, crosses or touches itself, or has no area: what it does in two
    languages."""
    shapes = block.shapes
    found: dict[int, tuple[str, str]] = {}
    if not len(shapes.polygon):
        return found
    simple = np.ones(len(shapes.polygon), bool)
    present = ~shapely.is_missing(shapes.ring_lines)
    simple[present] = shapely.is_simple(shapes.ring_lines[present])
    twice = np.bincount(shapes.ring_of_place[shapes.side_lengths == 0.0], minlength=len(simple)) > 0
    for ring in np.flatnonzero(~shapes.closed | ~shapes.whole | ~simple | shapes.thin | twice):
        if not shapes.whole[ring] or (shapes.thin[ring] and simple[ring]):
            fault = "has no area", "面積をもちません（縮退しています）"
        elif not simple[ring]:
            fault = "crosses or touches itself", "自己交差又は自己接触しています"
        elif twice[ring]:
            fault = "has the same place twice in a row", "同じ座標が連続しています"
        else:
            fault = "does not end where it begins", "閉じていません（始終点が一致しません）"
        found.setdefault(int(shapes.polygon[ring]), fault)
    return found


@city_rule("L10")
def _turn(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    """Inner rings turn against the outer one; outlines of LOD0 and roads look up."""
    shapes = block.shapes
    if not len(shapes.polygon):
        return
    along = (shapes.area_vectors * shapes.normals[shapes.polygon]).sum(axis=1)
    for ring in np.flatnonzero(~shapes.outer & (along > 0)):
        yield _at(block, int(shapes.polygon[ring]), what="hole", what_ja="内周")
    level = np.abs(shapes.normals[:, 2]) > 0.1
    up = np.array([one.lod == 0 or one.feature.type in _FACING_UP for one in shapes.polygons], bool)
    for number in np.flatnonzero(up & level & (shapes.normals[:, 2] < 0)):
        yield _at(block, int(number), what="surface that looks up", what_ja="上向きの面")


@city_rule("L11")
def _not_plane_1(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    yield from _not_plane(block, (1,), PLANE_LOD1)


@city_rule("L12")
def _not_plane_2(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    yield from _not_plane(block, (2, 3), PLANE)


def _not_plane(block: CityBlock, levels: tuple[int, ...], limit: float) -> Iterator[Violation]:
    shapes = block.shapes
    if not len(shapes.polygon):
        return
    for number in np.flatnonzero(np.isin(shapes.lods, levels) & (shapes.out_of_plane > limit)):
        yield _at(block, int(number), distance=f"{shapes.out_of_plane[number]:.3f}")


@city_rule("L13")
def _holes(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    faulty = _faulty_rings(block)
    for number, (why, why_ja) in _faulty_holes(block).items():
        ring = faulty.get(number)
        yield _at(block, number, why=why + (f"; a ring {ring[0]} (L09)" if ring else ""),
                  why_ja=why_ja + (f"。また輪が{ring[1]}（L09）" if ring else ""))


def _faulty_holes(block: CityBlock) -> dict[int, tuple[str, str]]:
    """Polygons whose inner rings lie wrong, with how in two languages."""
    shapes = block.shapes
    found = {}
    for number in np.unique(shapes.polygon[~shapes.outer]).tolist() if len(shapes.polygon) else ():
        lines = shapes.ring_lines[np.flatnonzero(shapes.polygon == number)]
        if not any(line is None for line in lines):
            fault = _hole_fault(lines[0], lines[1:])
            if fault:
                found[number] = fault
    return found


def _hole_fault(outer: shapely.LinearRing, inner: np.ndarray) -> tuple[str, str] | None:
    """What is wrong with the inner rings of a polygon, in two languages; None where nothing is."""
    around, holes = shapely.make_valid(shapely.polygons(outer)), shapely.make_valid(shapely.polygons(inner))
    if not shapely.covers(around, holes).all():
        return "is not within the outer ring", "外周に含まれていないか、外周と交差しています"
    for k in range(len(holes)):
        if (shapely.area(shapely.intersection(holes[k], holes[k + 1:])) > 0).any():
            return "overlaps or holds another one", "他の内周と重なっているか、包含関係にあります"
    simple = shapely.is_simple(outer) and shapely.is_simple(inner).all()
    if simple and not shapely.is_valid(shapely.polygons(outer, inner)):
        return "touches the outer ring so that the polygon falls into parts", "外周と接し、面を分断しています"
    return None


@city_rule("L15")
def _no_triangle(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for number, polygon in enumerate(block.shapes.polygons):
        if polygon.kind == "Triangle":
            ring = block.shapes.outer_ring[number]
            count = int(np.diff(block.shapes.start)[ring])
            if count != 4 or len(polygon.rings) > 1 or not block.shapes.closed[ring]:
                yield _at(block, number, count=count)


@city_rule("L17")
def _curve_falls_apart(block: CityBlock, rule: CheckRule) -> Iterator[Violation]:
    for thing in block.things:
        for number, body in enumerate(thing.bodies):
            if body.kind != "CompositeCurve":
                continue
            lines = [_places(line.text) for line in thing.lines if line.group == number]
            if any(one is None or two is None or not np.array_equal(one[-1], two[0])
                   for one, two in zip(lines, lines[1:])):
                yield violation(body.feature, body.lod)


def _at(block: CityBlock, number: int, **fields: object) -> Violation:
    """A polygon that breaks a rule, with its place."""
    polygon = block.shapes.polygons[number]
    return violation(polygon.feature, polygon.lod, block.shapes.first_place(number), **fields)


def _places(text: str) -> np.ndarray | None:
    """Places (n, 3) of a line; None where its coordinates are no numbers or not three a place."""
    try:
        values = np.array(text.split(), float)
    except ValueError:
        return None
    return values.reshape(-1, 3) if len(values) and len(values) % 3 == 0 else None
