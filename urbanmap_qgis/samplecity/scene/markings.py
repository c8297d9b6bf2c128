"""Paints the streets: lines, crossings, stop lines, arrows; and repaints or thins them for some scenes.

Measures follow the usual Japanese ones: lines 15 cm wide, dashes of 3 m with gaps of 4.5 m, zebra bars and stop lines
45 cm wide. Everything is laid out in the local frame of the streets (u, v).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import shapely
from shapely import affinity

from .ground import Ground, Street
from .model import Marking
from .streets import BEYOND

LINE = 0.15
DASH, GAP = 3.0, 4.5
SOLID = 9.0
"""Before stop lines lane lines are solid for so long, m."""

BAR = 0.45
ZEBRA_NEAR, ZEBRA_FAR = 3.0, 7.0
"""Reach of a zebra crossing from the kerb line of the street crossed, m."""

STOP = 9.0
"""Place of the stop line from the same kerb line, m."""

# Shapes in metres: right, forward. Those of one thing are strokes that do not overlap.
_ARROWS = {
    "ahead": [(-0.075, 0), (0.075, 0), (0.075, 3.2), (0.35, 3.2), (0, 5), (-0.35, 3.2), (-0.075, 3.2)],
    "left": [(0.375, 0), (0.525, 0), (0.525, 3.6), (-0.1, 3.6), (-0.1, 4.1), (-0.75, 3.4), (-0.1, 2.7), (-0.1, 3.2),
             (0.375, 3.2)],
}
_CHEVRON = [(-0.3, 0), (-0.14, 0), (0, 0.45), (0.14, 0), (0.3, 0), (0.08, 0.75), (-0.08, 0.75)]
_FORTY = (
    [(-0.75, 1.4), (-0.1, 1.4), (-0.1, 0), (0.07, 0), (0.07, 5), (-0.1, 5), (-0.1, 1.7), (-0.58, 1.7), (-0.35, 5),
     (-0.52, 5), (-0.75, 1.9)],
    [(0.22, 2.5), (0.22, 0.4), (0.32, 0), (0.65, 0), (0.75, 0.4), (0.75, 2.5), (0.58, 2.5), (0.58, 0.35), (0.39, 0.35),
     (0.39, 2.5)],
    [(0.22, 2.5), (0.39, 2.5), (0.39, 4.65), (0.58, 4.65), (0.58, 2.5), (0.75, 2.5), (0.75, 4.6), (0.65, 5), (0.32, 5),
     (0.22, 4.6)],
)


def make_markings(ground: Ground, size: float, scene: str, rng: np.random.Generator) -> tuple[Marking, ...]:
    """All markings of both epochs, in projected coordinates."""
    local = []
    for street in ground.streets:
        crossings = sorted((other for other in ground.streets if other.along != street.along), key=lambda s: s.at)
        local += _street_markings(street, crossings, size / 2 + BEYOND, rng)
    local = [replace(marking, wear=float(np.clip(rng.beta(2.0, 5.0), 0.03, 0.75))) for marking in local]
    if scene == "few markings":
        local = _thinned(local, size)
    if scene == "repainted":
        local = _repainted(local, rng)
    local += [bay for lot in ground.parking for bay in _bays(ground, lot)]
    return tuple(replace(marking, plan=ground.plan_to_world(marking.plan)) for marking in local)


def _street_markings(street: Street, crossings: list[Street], half_extent: float,
                     rng: np.random.Generator) -> list[Marking]:
    """Markings of one street along u; a street along v is laid out along u first and then rotated."""
    main = street.name in ("A", "B")
    markings = list(_tactile(street, crossings, half_extent)) if main else []
    for start, end, low, high in _sections(street, crossings, half_extent):
        markings += _lines(street, start, end)
        for end_of, crossing, sign in ((start, low, 1.0), (end, high, -1.0)):
            if crossing is not None:
                markings += _approach(street, end_of, sign, rng)
    if street.along == "v":
        # u, v of the layout become the axis v and the axis -u: a rotation, so that left stays left.
        markings = [replace(m, plan=affinity.affine_transform(m.plan, [0, -1, 1, 0, 0, 0])) for m in markings]
        markings = [replace(m, plan=affinity.translate(m.plan, xoff=2 * street.at)) for m in markings]
    return markings


def _sections(street: Street, crossings: list[Street], half_extent: float) -> Iterator[tuple]:
    """(start, end, crossing before, crossing after) of the lengths between kerb lines of crossing streets."""
    borders = [(-half_extent, -half_extent, None), *((c.at - c.half_width, c.at + c.half_width, c) for c in crossings),
               (half_extent, half_extent, None)]
    for (_, start, low), (end, _, high) in zip(borders[:-1], borders[1:]):
        yield start, end, low, high


def _lines(street: Street, start: float, end: float) -> list[Marking]:
    """Centre line, lane lines and edge lines between two crossings."""
    first, last = start + STOP, end - STOP
    if last - first < 2.0:
        return []
    at, markings = street.at, []
    if street.lanes > 1 or street.name == "B":
        colour = "yellow" if street.lanes > 1 else "white"
        markings.append(Marking(shapely.box(first, at - LINE / 2, last, at + LINE / 2), "centre", colour))
    for side in (1, -1):
        for number in range(1, street.lanes):
            across = at + side * number * street.lane_width
            markings += [Marking(shapely.box(u, across - LINE / 2, u + DASH, across + LINE / 2), "lane")
                         for u in np.arange(first + SOLID + GAP, last - DASH - SOLID - GAP + 0.01, DASH + GAP)]
            markings += [Marking(shapely.box(a, across - LINE / 2, b, across + LINE / 2), "lane")
                         for a, b in ((first, first + SOLID), (last - SOLID, last)) if last - first > 2.5 * SOLID]
        across = at + side * (street.lanes * street.lane_width + (0.25 if street.half_width > 4 else 0.0))
        markings.append(Marking(shapely.box(first - 1.0, across - LINE / 2, last + 1.0, across + LINE / 2), "edge"))
        if street.name in ("A", "B"):
            # Traffic on the side of +v goes along +u; cyclists keep to the edge of the lane.
            markings += [_placed(_CHEVRON, u, across - side * 0.8, -side, "chevron")
                         for u in np.arange(first + 6.0, last - 4.0, 9.0)]
    return markings


def _placed(shape: list[tuple[float, float]], u: float, v: float, sign: float, kind: str,
            colour: str = "white") -> Marking:
    """A shape with its tail at u, v, for traffic that drives against `sign` of u."""
    right, forward = np.array(shape, float).T
    # Forward is -sign of u; right is then +sign of v.
    return Marking(shapely.Polygon(np.column_stack([u - sign * forward, v + sign * right])), kind, colour)


def _approach(street: Street, kerb: float, sign: float, rng: np.random.Generator) -> list[Marking]:
    """Zebra crossing, stop line, arrows, diamond and speed limit at the crossing whose kerb line lies at `kerb`.

    `sign` is the direction away from the crossing along u.
    """
    at, markings = street.at, []
    near, far = sorted((kerb + sign * ZEBRA_NEAR, kerb + sign * ZEBRA_FAR))
    markings += [Marking(shapely.box(near, v, far, v + BAR), "zebra")
                 for v in np.arange(at - street.half_width + 0.5, at + street.half_width - 0.7, 2 * BAR)]
    # Coming towards the crossing one drives in -sign of u, on the side of v = -sign.
    side, edge = -sign, street.lanes * street.lane_width
    stop = sorted((kerb + sign * STOP, kerb + sign * (STOP - BAR)))
    across = sorted((at + side * LINE, at + side * (edge - LINE)))
    markings.append(Marking(shapely.box(stop[0], across[0], stop[1], across[1]), "stop"))
    if street.name not in ("A", "B"):
        return markings
    for number in range(street.lanes):
        lane = at + side * (number + 0.5) * street.lane_width
        shape = "left" if number == street.lanes - 1 and rng.random() < 0.5 else "ahead"
        for back in (STOP + 4.0, STOP + 18.0):
            markings.append(_placed(_ARROWS[shape], kerb + sign * (back + 5.0), lane, sign, "arrow"))
        leaving = at - side * (number + 0.5) * street.lane_width
        markings += [_placed(stroke, kerb + sign * (STOP + 3.0), leaving, -sign, "text", "yellow") for stroke in _FORTY]
        markings += list(_diamond(kerb + sign * (STOP + 30.0), lane)) if number == 0 else []
    return markings


def _diamond(u: float, v: float) -> Iterator[Marking]:
    """The diamond that announces a zebra crossing, as four strokes."""
    tips = np.array([(u - 2.5, v), (u, v + 0.75), (u + 2.5, v), (u, v - 0.75)])
    outer, inner = shapely.Polygon(tips), shapely.Polygon((tips - (u, v)) * 0.72 + (u, v))
    ring = outer.difference(inner)
    for west in (True, False):
        half = shapely.box(u - 3, v - 1, u, v + 1) if west else shapely.box(u, v - 1, u + 3, v + 1)
        yield Marking(ring.intersection(half), "diamond")


def _tactile(street: Street, crossings: list[Street], half_extent: float) -> Iterator[Marking]:
    """Yellow guiding strips for the blind, 30 cm wide, on both pavements."""
    for start, end, _, _ in _sections(street, crossings, half_extent):
        for side in (1, -1):
            across = street.at + side * (street.half_width + 1.6)
            if end - start > 20.0:
                yield Marking(shapely.box(start + 7, across - 0.15, end - 7, across + 0.15), "tactile", "yellow")


def _thinned(markings: list[Marking], size: float) -> list[Marking]:
    """Only crossings, stop lines and what lies in the outer parts of the city are left; the middle runs bare."""
    def stays(marking: Marking) -> bool:
        along = max(abs(marking.plan.centroid.x), abs(marking.plan.centroid.y))
        length = max(np.ptp(shapely.get_coordinates(marking.plan), axis=0))
        return marking.kind in ("stop", "zebra", "tactile") or (along > 0.42 * size and length < 12.0)

    bare = [m for m in markings if stays(m)]
    zebras_west = [m for m in bare if m.kind == "zebra" and m.plan.centroid.x < 0]
    return [m for m in bare if m not in zebras_west]


def _repainted(markings: list[Marking], rng: np.random.Generator) -> list[Marking]:
    """Between the epochs a part of the markings was painted anew elsewhere, fresh; some went, some came."""
    changed = []
    for marking in markings:
        east = marking.plan.centroid.x > 0
        if marking.kind == "tactile" or not east or rng.random() < 0.25:
            changed.append(marking)
            continue
        shift = {"lane": (2.0, 0.3), "zebra": (0.8, 0.25), "arrow": (3.0, 0.0)}.get(marking.kind, (0.5, 0.2))
        changed.append(replace(marking, ground=False))
        if marking.kind not in ("diamond", "text"):
            plan = affinity.translate(marking.plan, *shift)
            changed.append(replace(marking, plan=plan, wear=0.03, aerial=False))
    return changed


def worn_and_patched(markings: tuple[Marking, ...], rng: np.random.Generator) -> tuple[Marking, ...]:
    """Two markings of five worn to a rest; patches of new asphalt took parts of every sixth away before the drives."""
    changed = []
    for marking in markings:
        worn, patched = rng.random() < 0.4, rng.random() < 1 / 6
        wear, side = rng.uniform(0.55, 0.9), rng.uniform(1.0, 3.0)
        corners = shapely.get_coordinates(marking.plan)
        at = corners[int(rng.integers(len(corners)))] + rng.uniform(-0.5, 0.5, 2)
        if marking.kind == "tactile" or marking.private:
            changed.append(marking)
            continue
        marking = replace(marking, wear=max(marking.wear, wear)) if worn else marking
        rest = marking.plan.difference(shapely.box(*(at - side), *(at + side))) if patched else marking.plan
        if rest.equals(marking.plan):
            changed.append(marking)
            continue
        changed.append(replace(marking, ground=False))
        changed += [replace(marking, plan=part, aerial=False) for part in shapely.get_parts(rest)
                    if marking.ground and part.geom_type == "Polygon" and part.area > 0.01]
    return tuple(changed)


def beside_islands(markings: tuple[Marking, ...], ground: Ground) -> tuple[Marking, ...]:
    """Markings without what islands stand on."""
    islands = ground.plan_to_world(shapely.union_all(list(ground.islands)))
    remaining = []
    for marking in markings:
        rest = marking.plan.difference(islands)
        remaining += [marking] if rest.equals(marking.plan) else [
            replace(marking, plan=part) for part in shapely.get_parts(rest)
            if part.geom_type == "Polygon" and part.area > 0.01]
    return tuple(remaining)


def _bays(ground: Ground, lot: shapely.Polygon) -> list[Marking]:
    """Lines between the bays of a parking lot: comb along its longer side."""
    u, v = ground.to_local(*shapely.get_coordinates(lot).T)
    west, east, south, north = u.min() + 0.6, u.max() - 0.6, v.min() + 0.6, v.max() - 0.6
    lines = [shapely.box(at - 0.05, south, at + 0.05, min(south + 5.0, north)) for at in np.arange(west, east, 2.5)]
    return [Marking(line, "bay", wear=0.3, private=True) for line in lines]
