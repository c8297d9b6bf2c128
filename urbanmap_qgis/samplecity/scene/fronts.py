"""What stands before the fronts of buildings towards a street: canopies, signs, garden walls, hoardings, balconies,
storeys on columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from .faces import ring_of
from .ground import Ground
from .model import Building, FaceKind, Furniture, Material, StandingBefore

KINDS = ("canopy", "sign band", "garden wall", "hoarding", "balcony", "awning", "pilotis")
"""What may stand before a front; each front has one of them. Of pilotis the storeys over the columns are the facade."""

# Measures of fronts, m.
WIDTH = 8.0  # Smallest front.
HEIGHT = 6.0
GAP = (1.0, 14.0)  # Between a front and the kerb of its street.
CLEAR = 0.4  # Between what stands before a front and the kerb.
STOREY = 3.0
HIGHEST = 20.0  # Balconies end here.
SLAB = 0.2
GATE = 1.5
SINK = 0.2  # Walls on the ground go so deep into it.
CLOTH = 0.05
FALL = 0.4  # Of an awning, m per m.
COLUMN = 0.4
BAY = 5.0  # Widest between columns.


@dataclass(frozen=True)
class _Front:
    """A front: its left end seen from the street (x, y), directions along and outwards, width, foot, top and the gap
    to the kerb, m."""

    building: int
    start: np.ndarray
    along: np.ndarray
    outwards: np.ndarray
    width: float
    foot: float
    top: float
    gap: float

    def plan(self, left: float, right: float, near: float, far: float) -> shapely.Polygon:
        """Rectangle between places along the front, from `near` to `far` m before it."""
        return shapely.Polygon([self.start + a * self.along + b * self.outwards
                                for a, b in ((left, near), (right, near), (right, far), (left, far))])

    def line(self, left: float, right: float, before: float, z: float) -> shapely.LineString:
        """Line along the front, so far before it, at a height."""
        ends = [self.start + a * self.along + before * self.outwards for a in (left, right)]
        return shapely.LineString([[*end, z] for end in ends])


def standing_before(ground: Ground, buildings: Sequence[Building], rng: np.random.Generator
                    ) -> tuple[StandingBefore, ...]:
    """What stands before the fronts, one kind after another."""
    fronts = [front for building in buildings for front in _fronts(ground, building, buildings)]
    first = int(rng.integers(len(KINDS)))
    made = {"canopy": _canopy, "sign band": _sign_band, "garden wall": _garden_wall, "hoarding": _hoarding,
            "balcony": _balconies, "awning": _awning, "pilotis": _pilotis}
    return tuple(thing for number, front in enumerate(fronts)
                 for thing in made[KINDS[(first + number) % len(KINDS)]](front, rng))


def _fronts(ground: Ground, building: Building, buildings: Sequence[Building]) -> Iterator[_Front]:
    """Straight fronts of a building along a street, with nothing between them and its kerb."""
    ring = ring_of(building.outline)  # anticlockwise: outside lies to the right
    others = [other.outline for other in buildings if other.id != building.id]
    for start, end in zip(ring, np.roll(ring, -1, axis=0)):
        width = float(np.hypot(*(end - start)))
        if width < WIDTH:
            continue
        along = (end - start) / width
        outwards = np.array([along[1], -along[0]])
        gap = _gap(ground, (start + end) / 2, outwards)
        top = _top(building, start + along * width / 2 - 0.1 * outwards)
        foot = float(ground.height(*((start + end) / 2)))
        if gap is None or not GAP[0] + CLEAR <= gap <= GAP[1] or top - foot < HEIGHT:
            continue
        front = _Front(building.id, start, along, outwards, width, foot, top, gap)
        strip = front.plan(0.0, width, 0.05, gap)
        if not any(shapely.intersects(strip, other) for other in [*others, shapely.buffer(building.outline, -0.1)]):
            yield front


def _gap(ground: Ground, middle: np.ndarray, outwards: np.ndarray) -> float | None:
    """Distance from a front to the kerb of the street that it looks at, m; None where it looks at none."""
    u, v = ground.to_local(*middle)
    ahead_u, ahead_v = ground.to_local(*(middle + outwards))
    gaps = []
    for street in ground.streets:
        place, step = (float(v), float(ahead_v - v)) if street.along == "u" else (float(u), float(ahead_u - u))
        if abs(step) > 0.999 and (street.at - place) * step > 0:
            gaps.append(abs(street.at - place) - street.half_width)
    return min((gap for gap in gaps if gap > 0), default=None)


def _top(building: Building, inside: np.ndarray) -> float:
    """Top of the part of a building that holds a place; that of its lowest part where none does."""
    place = shapely.Point(inside)
    return min([part.z_top for part in building.parts if shapely.contains(part.plan, place)]
               or [part.z_top for part in building.parts])


def _depth(front: _Front, least: float, greatest: float, rng: np.random.Generator) -> float:
    """How far something stands out, m, clear of the kerb."""
    most = max(min(greatest, front.gap - CLEAR), 0.5 * least)
    return float(rng.uniform(min(least, most), most))


def _span(front: _Front, rng: np.random.Generator) -> tuple[float, float]:
    return float(rng.uniform(0.0, 0.15) * front.width), float(rng.uniform(0.8, 1.0) * front.width)


def _made(front: _Front, kind: str, lines: list[tuple[float, float]], before: float, z: tuple[float, float],
          boxes: list[Furniture]) -> StandingBefore:
    geometry = shapely.MultiLineString([front.line(*line, before, z[0]) for line in lines])
    return StandingBefore(front.building, kind, geometry, before, *z, tuple(boxes))


def _box(front: _Front, left: float, right: float, near: float, far: float, low: float, high: float,
         material: Material = Material.FACADE) -> Furniture:
    return Furniture(front.plan(left, right, near, far), low, high, material, FaceKind.FRONT)


def _canopy(front: _Front, rng: np.random.Generator) -> Iterator[StandingBefore]:
    """A flat roof over the ground floor with a fascia."""
    before, (left, right) = _depth(front, 0.8, 3.0, rng), _span(front, rng)
    low = front.foot + float(rng.uniform(2.6, 3.6))
    high = low + float(rng.uniform(0.35, 1.0))
    yield _made(front, "canopy", [(left, right)], before, (low, high),
                [_box(front, left, right, 0.02, before, low, high, Material.METAL)])


def _sign_band(front: _Front, rng: np.random.Generator) -> Iterator[StandingBefore]:
    """A sign along the front over the ground floor."""
    before, (left, right) = _depth(front, 0.35, 1.0, rng), _span(front, rng)
    low = front.foot + float(rng.uniform(2.7, 3.4))
    high = low + float(rng.uniform(0.7, 1.6))
    yield _made(front, "sign band", [(left, right)], before, (low, high),
                [_box(front, left, right, 0.02, before, low, high)])


def _garden_wall(front: _Front, rng: np.random.Generator) -> Iterator[StandingBefore]:
    """A block wall on the border of the plot, with a gate."""
    before, high = _depth(front, 0.8, 3.0, rng), float(rng.uniform(1.2, 1.8))
    gate = float(rng.uniform(0.1, 0.7)) * front.width
    pieces = [(0.0, gate), (gate + GATE, front.width)]
    yield _made(front, "garden wall", pieces, before, (front.foot, front.foot + high),
                [_box(front, *piece, before - 0.12, before, front.foot - SINK, front.foot + high)
                 for piece in pieces])


def _hoarding(front: _Front, rng: np.random.Generator) -> Iterator[StandingBefore]:
    """A closed fence of a building site."""
    before, high = _depth(front, 0.8, 2.5, rng), float(rng.uniform(2.0, 3.0))
    yield _made(front, "hoarding", [(0.0, front.width)], before, (front.foot, front.foot + high),
                [_box(front, 0.0, front.width, before - 0.05, before, front.foot - SINK, front.foot + high,
                      Material.METAL)])


def _balconies(front: _Front, rng: np.random.Generator) -> Iterator[StandingBefore]:
    """A parapet on a slab before every upper storey."""
    before, (left, right) = _depth(front, 1.0, 1.8, rng), _span(front, rng)
    high = float(rng.uniform(1.0, 1.3))
    for z in np.arange(front.foot + STOREY, min(front.top, front.foot + HIGHEST) - 1.5, STOREY):
        low, floor, top = float(z - SLAB), float(z), float(z + high)
        yield _made(front, "balcony", [(left, right)], before, (low, top), [
            _box(front, left, right, 0.02, before, low, floor),
            _box(front, left, right, before - 0.15, before, floor, top)])


def _awning(front: _Front, rng: np.random.Generator) -> Iterator[StandingBefore]:
    """A cloth that slopes away from the front."""
    before, (left, right) = _depth(front, 0.9, 1.8, rng), _span(front, rng)
    low = front.foot + float(rng.uniform(2.2, 2.6))
    middle = low + FALL * before / 2
    fall = -FALL * front.outwards
    yield _made(front, "awning", [(left, right)], before, (low, low + FALL * before + CLOTH), [
        Furniture(front.plan(left, right, 0.02, before), middle, middle + CLOTH, Material.WOOD, FaceKind.FRONT,
                  (float(fall[0]), float(fall[1])))])


def _pilotis(front: _Front, rng: np.random.Generator) -> Iterator[StandingBefore]:
    """Upper storeys on columns along the whole front, up to its top; the ground floor is the building's own wall."""
    before = _depth(front, 0.8, 1.6, rng)
    low = front.foot + float(rng.uniform(2.7, 3.3))
    bays = int(np.ceil(front.width / BAY))
    columns = [_box(front, left, left + COLUMN, before - COLUMN, before, front.foot - SINK, low)
               for left in np.linspace(0.0, front.width - COLUMN, bays + 1)]
    yield _made(front, "pilotis", [(0.0, front.width)], before, (low, front.top),
                [_box(front, 0.0, front.width, 0.02, before, low, front.top), *columns])
