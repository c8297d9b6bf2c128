"""Fills the blocks between the streets with buildings: flat roofs on several levels, parapets, some gables, one round.

Plans are laid out in the local frame of the streets; heights are orthometric.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import shapely
from shapely import affinity

from .faces import inset, ring_of
from .ground import Ground
from .model import Building, RoofPart, Structure

STOREY = 3.5

HALF_ROW = 34.0  # Blocks deeper than this are built up in two rows, m.
WALLS = ((178, 170, 158), (150, 146, 140), (196, 190, 182), (128, 112, 100),
                                        (104, 108, 116), (168, 150, 134))
ROOFS = ((132, 134, 132), (112, 116, 114), (152, 150, 144), (98, 122, 108),
                                        (140, 128, 120))
TILES = ((96, 62, 52), (70, 74, 84), (84, 92, 80))


@dataclass(frozen=True)
class Lot:
    """A plot of a block: rectangle of the local frame; `tall` on the main streets, `corner` at the main crossing."""

    west: float
    south: float
    east: float
    north: float
    tall: bool
    corner: bool

    @property
    def width(self) -> float:
        return self.east - self.west

    @property
    def depth(self) -> float:
        return self.north - self.south

    def box(self, west: float, south: float, east: float, north: float) -> shapely.Polygon:
        """Rectangle given in shares of the lot, 0 to 1."""
        return shapely.box(self.west + self.width * west, self.south + self.depth * south,
                           self.west + self.width * east, self.south + self.depth * north)


def make_buildings(ground: Ground, size: float, scene: str,
                   rng: np.random.Generator) -> tuple[tuple[Building, ...], tuple[shapely.Polygon, ...]]:
    """Buildings, and the lots left for parking (projected coordinates)."""
    lots = [lot for block in _blocks(ground, size) for lot in _lots(block, rng)]
    shapes = _shapes(lots, rng)
    buildings, parking = [], []
    for lot, shape in zip(lots, shapes):
        if shape == "parking":
            parking.append(ground.plan_to_world(lot.box(0.0, 0.0, 1.0, 1.0)))
            continue
        parts = _SHAPES[shape](lot, rng)
        rotation = float(rng.uniform(-4.0, 4.0)) if shape in ("gable", "curved") else 0.0
        buildings.append(_raised(ground, scene, lot, len(buildings) + 1, shape, parts, rotation, rng))
    return tuple(buildings), tuple(parking)


def _blocks(ground: Ground, size: float) -> list[tuple[float, float, float, float]]:
    """Rectangles (west, south, east, north) between the pavements, cut at the city's border."""
    spans = []
    for along in ("v", "u"):
        streets = sorted((s for s in ground.streets if s.along == along), key=lambda s: s.at)
        low = [-size / 2, *(s.at + s.half_width + s.pavement for s in streets)]
        high = [*(s.at - s.half_width - s.pavement for s in streets), size / 2]
        spans.append([(a, b) for a, b in zip(low, high) if b - a > 9.0])
    return [(west, south, east, north) for west, east in spans[0] for south, north in spans[1]]


def _lots(block: tuple[float, float, float, float], rng: np.random.Generator) -> list[Lot]:
    """Lots of a block, in one or two rows with a gap of 1 m between."""
    west, south, east, north = block
    rows = [(south, north)]
    if north - south > HALF_ROW:
        middle = south + (north - south) * float(rng.uniform(0.45, 0.55))
        rows = [(south, middle - 0.5), (middle + 0.5, north)]
    lots = []
    for low, high in rows:
        cuts = _cuts(west, east, rng)
        for a, b in zip(cuts[:-1], cuts[1:]):
            main = min(abs(low), abs(high)) < 14.0 or min(abs(a), abs(b)) < 11.0
            corner = min(abs(low), abs(high)) < 14.0 and min(abs(a), abs(b)) < 11.0
            lots.append(Lot(a, low, b, high, main, corner))
    return lots


def _cuts(west: float, east: float, rng: np.random.Generator) -> np.ndarray:
    """Borders of the lots along a row, 13 to 28 m apart."""
    count = max(1, round((east - west) / 20.0))
    widths = rng.uniform(0.75, 1.3, count)
    return west + (east - west) * np.concatenate([[0.0], np.cumsum(widths) / widths.sum()])


def _shapes(lots: list[Lot], rng: np.random.Generator) -> list[str]:
    """A shape for each lot, every kind in turn, so that even a small city has most of them."""
    order = ["L", "rectangle", "podium", "T", "levels", "U", "rectangle", "gable"]
    shapes, turn = [], int(rng.integers(len(order)))
    for lot in lots:
        shape = order[turn % len(order)]
        if min(lot.width, lot.depth) < 11.0 or (shape == "gable" and lot.tall):
            shape = "gable" if not lot.tall else "rectangle"
        shapes.append(shape)
        turn += 1
    corners = [i for i, lot in enumerate(lots) if lot.corner and min(lot.width, lot.depth) > 14.0]
    if corners:
        shapes[corners[int(rng.integers(len(corners)))]] = "curved"
    inner = [i for i, lot in enumerate(lots) if not lot.tall and shapes[i] != "gable" and lot.width > 12.0]
    if len(inner) > 2:
        shapes[inner[int(rng.integers(len(inner)))]] = "parking"
    return shapes


def _flat(*plans_and_levels: tuple[shapely.Polygon, float]) -> list[RoofPart]:
    """Parts of relative height: `z_roof` holds the share of the building's full height for the moment."""
    return [RoofPart(plan, level) for plan, level in plans_and_levels]


def _rectangle(lot: Lot, rng: np.random.Generator) -> list[RoofPart]:
    gap = 0.0 if rng.random() < 0.5 else 0.5 / lot.width
    return _flat((lot.box(gap, 0.02, 1 - gap, 0.97), 1.0))


def _levels(lot: Lot, rng: np.random.Generator) -> list[RoofPart]:
    cut = float(rng.uniform(0.4, 0.6))
    lower = lot.box(cut, 0.02, 1.0, 0.97)
    return _flat((lot.box(0.0, 0.02, cut, 0.97), 1.0), (lower, float(rng.uniform(0.5, 0.8))))


def _l_shape(lot: Lot, rng: np.random.Generator) -> list[RoofPart]:
    gap, cut, wing = 0.4 / lot.width, float(rng.uniform(0.5, 0.6)), float(rng.uniform(0.4, 0.55))
    main, side = lot.box(gap, 0.02, 1 - gap, cut), lot.box(gap, cut, wing, 0.97)
    if rng.random() < 0.5:
        return _flat((_one(main, side), 1.0))
    return _flat((main, 1.0), (side, float(rng.uniform(0.5, 0.85))))


def _t_shape(lot: Lot, rng: np.random.Generator) -> list[RoofPart]:
    cut = float(rng.uniform(0.45, 0.55))
    bar, stem = lot.box(0.0, 0.02, 1.0, cut), lot.box(0.28, cut, 0.72, 0.97)
    if rng.random() < 0.5:
        return _flat((_one(bar, stem), 1.0))
    return _flat((bar, 1.0), (stem, float(rng.uniform(0.5, 0.8))))


def _u_shape(lot: Lot, rng: np.random.Generator) -> list[RoofPart]:
    gap, cut = 0.4 / lot.width, float(rng.uniform(0.4, 0.5))
    back = lot.box(gap, 0.02, 1 - gap, cut)
    left, right = lot.box(gap, cut, 0.34, 0.97), lot.box(0.66, cut, 1 - gap, 0.97)
    if rng.random() < 0.5:
        return _flat((_one(back, left, right), 1.0))
    return _flat((back, 1.0), (_one(left), float(rng.uniform(0.6, 0.85))), (_one(right), float(rng.uniform(0.5, 0.6))))


def _podium(lot: Lot, rng: np.random.Generator) -> list[RoofPart]:
    gap, left, top = 0.3 / lot.width, float(rng.uniform(0.2, 0.3)), float(rng.uniform(0.7, 0.8))
    tower = lot.box(left, 0.02, 0.85, top)
    base = lot.box(gap, 0.02, 1 - gap, 0.97).difference(tower)
    return _flat((tower, 1.0), (_one(base), float(rng.uniform(0.3, 0.45))))


def _gable(lot: Lot, rng: np.random.Generator) -> list[RoofPart]:
    width, depth = min(lot.width - 2.5, 13.0), min(lot.depth - 2.5, 9.0 + 3.0 * float(rng.random()))
    x, y = (lot.west + lot.east) / 2, (lot.south + lot.north) / 2
    plan = shapely.box(x - width / 2, y - depth / 2, x + width / 2, y + depth / 2)
    return [RoofPart(plan, 0.0, z_ridge=0.0)]


def _curved(lot: Lot, _rng: np.random.Generator) -> list[RoofPart]:
    """A cylinder of 28 sides."""
    radius = 0.46 * min(lot.width, lot.depth)
    angle = np.arange(28) * 2 * np.pi / 28
    x, y = (lot.west + lot.east) / 2, (lot.south + lot.north) / 2
    return _flat((shapely.Polygon(np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)])), 1.0))


_SHAPES: dict[str, Callable[[Lot, np.random.Generator], list[RoofPart]]] = {
    "rectangle": _rectangle, "levels": _levels, "L": _l_shape, "T": _t_shape, "U": _u_shape, "podium": _podium,
    "gable": _gable, "curved": _curved}


def _one(*plans: shapely.Polygon) -> shapely.Polygon:
    """The plans as one polygon without superfluous corners."""
    return shapely.simplify(shapely.set_precision(shapely.union_all(plans), 1e-4), 1e-3)


def _raised(ground: Ground, scene: str, lot: Lot, number: int, shape: str, parts: list[RoofPart], rotation: float,
            rng: np.random.Generator) -> Building:
    """The building with its heights, parapets and roof structures, in projected coordinates."""
    corners = np.vstack([ring_of(part.plan) for part in parts])
    base = float(ground.height(*ground.to_world(*corners.T)).min()) - 0.3
    low, high = _height_range(scene, lot)
    full = STOREY * round(float(rng.uniform(low, high)) / STOREY) + float(rng.uniform(0.3, 0.9))
    wall, roof = (list_[int(rng.integers(len(list_)))]
                  for list_ in (WALLS, TILES if shape == "gable" else ROOFS))
    middle = shapely.union_all([part.plan for part in parts]).centroid
    raised = []
    for part in parts:
        if shape == "gable":
            eaves = base + 0.3 + float(rng.uniform(5.5, 7.5))
            half = min(np.ptp(ring_of(part.plan), axis=0)) / 2
            part = replace(part, z_roof=eaves, z_ridge=eaves + half * float(rng.uniform(0.45, 0.75)))
        else:
            z_roof = base + STOREY * max(1, round(full * part.z_roof / STOREY)) + float(rng.uniform(0.0, 0.8))
            width, height = (0.0, 0.0) if rng.random() < 0.15 else (rng.uniform(0.2, 0.45), rng.uniform(0.4, 1.2))
            part = RoofPart(part.plan, z_roof, float(width), float(height), None,
                            _structures(part.plan, float(width), part.z_roof == 1.0, rng))
        rotated = affinity.rotate(part.plan, rotation, origin=middle)
        boxes = tuple(replace(s, plan=ground.plan_to_world(affinity.rotate(s.plan, rotation, origin=middle)))
                      for s in part.structures)
        raised.append(replace(part, plan=ground.plan_to_world(rotated), structures=boxes))
    return Building(number, shape, base, tuple(raised), wall, roof)


def _height_range(scene: str, lot: Lot) -> tuple[float, float]:
    """Least and greatest height of a building, m."""
    if scene == "canyon":
        return (28.0, 58.0) if lot.tall else (12.0, 34.0)
    return (18.0, 42.0) if lot.tall else (10.0, 26.0)


def _structures(plan: shapely.Polygon, parapet: float, penthouse: bool,
                rng: np.random.Generator) -> tuple[Structure, ...]:
    """Boxes within the parapet that do not touch one another: a penthouse on the main roof, some machines."""
    room = shapely.Polygon(inset(ring_of(plan), parapet + 0.8))
    if not room.is_valid:
        return ()
    west, south, east, north = room.bounds
    sizes = [(rng.uniform(4.5, 8.0), rng.uniform(4.0, 6.5), rng.uniform(2.8, 4.2))] if penthouse else []
    sizes += [(rng.uniform(1.2, 2.6), rng.uniform(1.0, 2.0), rng.uniform(0.9, 1.8)) for _ in range(rng.integers(2, 10))]
    placed: list[Structure] = []
    for width, depth, height in sizes:
        x, y = rng.uniform(west, east), rng.uniform(south, north)
        box = shapely.box(x, y, x + width, y + depth)
        if room.contains(box) and not any(box.dwithin(other.plan, 0.5) for other in placed):
            placed.append(Structure(box, float(height)))
    return tuple(placed)
