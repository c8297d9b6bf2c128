"""Arrows and other symbols on the road, told by their shape."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import affinity

SPACING = 0.45
"""Pieces of one symbol lie no farther apart, m (worn paint falls into pieces)."""

TOLERANCE = 0.10
"""By so much paint may lie beside the pattern, m."""

LEAST_SCORE = 0.70
"""Mean (harmonic) of the shares of the paint in the pattern and of the pattern with paint."""

LEAST_LEAD = 0.06
"""By so much the best kind must be ahead of the next."""

SHAFT, HEAD = 0.08, 0.38
"""Half widths of an arrow's shaft and of its head, m."""

STROKE, LEAST_HEAD, LONGEST_HEAD = 0.28, 0.03, 2.6
"""Paint wider than the first (m) is no shaft; what is left of it when so much is taken off its edges is a head where it
has so much area (m2) and is no longer than the last (m)."""

LENGTHS = (4.0, 5.0, 6.0)
"""Usual lengths of arrows, m."""


@dataclass(frozen=True)
class Symbol:
    """A symbol on the road.

    Attributes
    ----------
    kind : such as "arrow straight", "arrow left", "diamond", "text" or "unknown".
    area : its paint. polygons : numbers of the polygons that it is made of.
    heading : direction (2,) in which it is read, NaN where unknown.
    score : 0 to 1, how well paint and pattern agree; NaN without a pattern.
    """

    kind: str
    area: shapely.Geometry
    polygons: tuple[int, ...]
    heading: np.ndarray
    score: float


def _arrow(*directions: str) -> shapely.Geometry:
    """Pattern of an arrow of unit length along y with heads to these sides."""
    parts = []
    if "straight" in directions:
        parts += [shapely.box(-SHAFT / 5, 0, SHAFT / 5, 0.66), shapely.Polygon(
            [(-HEAD / 5, 0.62), (HEAD / 5, 0.62), (0, 1.0)])]
    for side, sign in (("left", -1.0), ("right", 1.0)):
        if side in directions:
            root = 0.0 if "straight" in directions or len(directions) > 1 else -0.45 * sign / 5
            parts += [shapely.box(root - SHAFT / 5, 0, root + SHAFT / 5, 0.70),
                      shapely.Polygon([(root, 0.53), (root, 0.71), (root + sign * 0.11, 0.73),
                                       (root + sign * 0.11, 0.63)]),
                      shapely.Polygon([(root + sign * 0.09, 0.53), (root + sign * 0.09, 0.83),
                                       (root + sign * 0.24, 0.68)])]
    return shapely.union_all(parts)


def _patterns() -> dict[str, tuple[shapely.Geometry, bool]]:
    """Pattern of unit length and whether it reads the same from both ends, by kind."""
    arrows = {"arrow straight": ("straight",), "arrow left": ("left",), "arrow right": ("right",),
              "arrow straight left": ("straight", "left"), "arrow straight right": ("straight", "right")}
    diamond = shapely.Polygon([(0, 0), (0.15, 0.5), (0, 1), (-0.15, 0.5)])
    inner = affinity.scale(diamond, 0.72, 0.72, origin=(0, 0.5))
    return {**{kind: (_arrow(*sides), False) for kind, sides in arrows.items()},
            "diamond": (diamond.difference(inner), True)}


PATTERNS = _patterns()


def find_symbols(polygons: Sequence[shapely.Polygon], numbers: Sequence[int],
                 direction_near) -> list[Symbol]:
    """Symbols that the polygons of these numbers make; what is none becomes "unknown", piece by piece.

    Parameters
    ----------
    direction_near : function of a place (2,), direction of the road there (2,) or None.
    """
    found = []
    for cluster in _clusters([polygons[n] for n in numbers]):
        members = tuple(int(numbers[k]) for k in cluster)
        paint = shapely.union_all([polygons[n] for n in members])
        symbol = _recognised(paint, members, direction_near)
        if symbol is not None:
            found.append(symbol)
        else:
            found += [Symbol("unknown", polygons[n], (n,), np.full(2, np.nan), np.nan) for n in members]
    return found


def _clusters(polygons: list[shapely.Polygon]) -> list[list[int]]:
    """Places of the polygons that lie together."""
    if not polygons:
        return []
    blobs = shapely.get_parts(shapely.union_all(shapely.buffer(polygons, SPACING / 2, quad_segs=2)))
    blob, polygon = shapely.STRtree(polygons).query(blobs, predicate="intersects")
    return [polygon[blob == one].tolist() for one in np.unique(blob)]


def _recognised(paint: shapely.Geometry, members: tuple[int, ...], direction_near) -> Symbol | None:
    """The symbol whose pattern the paint follows, None where none does clearly."""
    frame = shapely.minimum_rotated_rectangle(paint)
    if frame.geom_type != "Polygon" or not 2.5 <= _sides(frame)[0] <= 7.5 or _sides(frame)[1] > 2.6:
        return None
    road = direction_near(np.array(frame.centroid.coords[0]))
    along = _long_side(frame) if road is None else np.asarray(road, float)
    scores = sorted(((*_best_match(paint, pattern, along, both), kind) for kind, (pattern, both) in PATTERNS.items()),
                    key=lambda one: -one[0])
    (score, heading, kind), (second, _, _) = scores[:2]
    if score < LEAST_SCORE or score < second + LEAST_LEAD or (kind.startswith("arrow") and not _has_head(paint)):
        return None
    return Symbol(kind, paint, members, heading, score)


def _has_head(paint: shapely.Geometry) -> bool:
    """Whether a part of the paint, and not all of its length, is too wide for a shaft: a plain stroke is no arrow."""
    head = paint.buffer(-STROKE / 2.0, quad_segs=2)
    if head.area < LEAST_HEAD:
        return False
    x_min, y_min, x_max, y_max = head.bounds
    return bool(np.hypot(x_max - x_min, y_max - y_min) < LONGEST_HEAD)


def _best_match(paint: shapely.Geometry, pattern: shapely.Geometry, along: np.ndarray, both: bool) -> tuple:
    """Best score of a pattern over lengths, headings and places, and its heading (2,)."""
    best = (0.0, np.full(2, np.nan))
    for heading in (along,) if both else (along, -along):
        angle = np.degrees(np.arctan2(heading[1], heading[0])) - 90.0
        upright = affinity.rotate(paint, -angle, origin=(0, 0))
        x_min, y_min, x_max, y_max = upright.bounds
        for length in {*LENGTHS, float(np.clip(y_max - y_min, 3.0, 7.0))}:
            scale_x = 5.0 if length < 5.5 else length
            shape = affinity.scale(pattern, scale_x, length, origin=(0, 0))
            p_min, _, p_max, _ = shape.bounds
            for y in (y_min, y_max - length):
                for x in ((x_min + x_max - p_min - p_max) / 2, x_min - p_min, x_max - p_max):
                    score = _agreement(upright, affinity.translate(shape, x, y))
                    if score > best[0]:
                        best = (score, np.full(2, np.nan) if both else heading)
    return best


def _agreement(paint: shapely.Geometry, pattern: shapely.Geometry) -> float:
    """Harmonic mean of the share of paint in the (grown) pattern and of the pattern in the (grown) paint."""
    precise = paint.intersection(pattern.buffer(TOLERANCE, quad_segs=2)).area / paint.area
    if precise < 0.4:
        return 0.0
    complete = pattern.intersection(paint.buffer(TOLERANCE, quad_segs=2)).area / pattern.area
    return 2.0 * precise * complete / max(precise + complete, 1e-9)


def _sides(frame: shapely.Polygon) -> tuple[float, float]:
    """Long and short side of a rectangle, m."""
    corners = shapely.get_coordinates(frame.exterior)
    first, second = np.linalg.norm(corners[1] - corners[0]), np.linalg.norm(corners[2] - corners[1])
    return float(max(first, second)), float(min(first, second))


def _long_side(frame: shapely.Polygon) -> np.ndarray:
    """Unit vector (2,) along a rectangle's long side."""
    corners = shapely.get_coordinates(frame.exterior)
    sides = np.diff(corners[:3], axis=0)
    side = sides[np.argmax(np.linalg.norm(sides, axis=1))]
    return side / np.linalg.norm(side)
