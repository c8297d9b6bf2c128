"""Which measured wall belongs to which edge of a model's plan, and where the edge goes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from ...settings.buildings import MergeSettings
from ...wording import mark, say
from .plan_edges import Line, OuterEdge

MOVED, KEPT, NOT_SEEN, TOO_FAR, NEIGHBOUR, FOLDED = (
    mark("moved"), mark("fits"), mark("not seen"), mark("too far"), mark("neighbour"), mark("does not fit"))
"""What became of an edge: on the measured wall; it lay there already; no wall along it; the wall is beyond the limits;
it would run into a neighbour; the plan would fold."""

SAME = 0.01
SHORT = 0.5
LONG = 4.0
MAX_BEND = 0.3
SMALL_ROTATION = 1.0
FACING = 0.94
COPLANAR = 0.1  # Walls whose ends lie this near to the line of a larger one, m, are of its plane.
OVER = 0.3  # Share of a wall's own length times height from which on another lies over it.
STEP = 0.3  # Walls whose depth differs by more than this, m, have a step between them.
STEP_REACH = 3.0  # Walls up to this far beyond the maximum offset, m, tell where a facade steps.
# A step is looked for in gaps between walls up to this wide, m: in a wider one its place is not known.
STEP_GAP = 2.0
# Length of an edge, m, that must have been measured, and of the pieces into which steps cut it.
MIN_PIECE = 1.0


@dataclass(frozen=True, eq=False)
class MeasuredWall:
    """A wall of the survey as the plan sees it.

    Attributes
    ----------
    number : row in the layer; -1 where satellites tell the wall.
    point, normal : (2,) of its trace in plan at half its height, the normal outwards.
    left, right : extent along its trace from the point, m, seen from in front.
    foot, top : heights, m.
    area : m2.
    rmse, sigma : m, NaN where unknown.
    tilt : degrees.
    points : number of points on it, 0 where unknown.
    """

    number: int
    point: np.ndarray
    normal: np.ndarray
    left: float
    right: float
    foot: float
    top: float
    area: float
    rmse: float
    sigma: float
    tilt: float
    points: int = 0

    @property
    def along(self) -> np.ndarray:
        """Unit vector (2,) to the right, seen from in front: the building lies at its left."""
        return np.array([-self.normal[1], self.normal[0]])


def measured_wall(number: int, polygon: shapely.Polygon, rmse: float = math.nan,
                  sigma: float = math.nan, points: int = 0) -> MeasuredWall | None:
    """A wall from its contour with z, counterclockwise seen from in front; None where it is no upright face."""
    ring = shapely.get_coordinates(polygon.exterior, include_z=True)[:-1]
    if len(ring) < 3 or not np.isfinite(ring).all():
        return None
    centre = ring.mean(axis=0)
    area = np.cross(ring - centre, np.roll(ring - centre, -1, axis=0)).sum(axis=0) / 2
    size = float(np.linalg.norm(area))
    if size < 0.01 or abs(area[2]) > 0.35 * size:
        return None
    # The ring is planar: its area vector is the normal, free of the noise of single corners.
    normal = area / size
    level = normal[:2] / np.hypot(*normal[:2])
    foot, top = float(ring[:, 2].min()), float(ring[:, 2].max())
    middle = (foot + top) / 2
    on_trace = centre[:2] + level * ((centre[2] - middle) * normal[2] / np.hypot(*normal[:2]))
    along = np.array([-level[1], level[0]])
    extent = (ring[:, :2] - on_trace) @ along
    holes = sum(shapely.Polygon(_flat(hole, along)).area for hole in polygon.interiors)
    return MeasuredWall(number, on_trace, level, float(extent.min()), float(extent.max()), foot, top,
                        max(size - holes, 0.0), rmse, sigma, float(np.degrees(np.arcsin(normal[2]))), points)


def _flat(ring: shapely.LinearRing, along: np.ndarray) -> np.ndarray:
    xyz = shapely.get_coordinates(ring, include_z=True)
    return np.column_stack([xyz[:, :2] @ along, xyz[:, 2]])


class WallIndex:
    """Measured walls by place."""

    def __init__(self, walls: Sequence[MeasuredWall]):
        self.walls = list(walls)
        self.tree = shapely.STRtree([shapely.LineString([wall.point + wall.left * wall.along,
                                                         wall.point + wall.right * wall.along])
                                     for wall in self.walls])

    def near(self, edge: OuterEdge, max_distance: float) -> list[MeasuredWall]:
        """Walls within a distance (m) of an edge, in the order of the layer."""
        found = self.tree.query(shapely.LineString(edge.ends), predicate="dwithin", distance=max_distance)
        return [self.walls[number] for number in sorted(found)]


@dataclass(frozen=True, eq=False)
class EdgeMatch:
    """What is known of an edge.

    Attributes
    ----------
    status : see the constants.
    note : in words.
    wall : the wall, None without one.
    line : where the edge goes, None where it stays.
    offset : of the wall outwards from the edge, m.
    rotation : degrees.
    measured : share of the edge's length along which the wall was measured.
    """

    status: str
    note: str = ""
    wall: MeasuredWall | None = None
    line: Line | None = None
    offset: float = math.nan
    rotation: float = math.nan
    measured: float = 0.0


@dataclass(frozen=True, eq=False)
class WallsAlong:
    """Measured walls of one plane along an edge, summed.

    Attributes
    ----------
    wall : all of them as one wall, numbered as the largest.
    spans : (k, 2) m along the edge, apart from each other.
    offset : outwards from the edge, m.
    rotation : degrees.
    measured : share of the edge's length.
    """

    wall: MeasuredWall
    spans: np.ndarray
    offset: float
    rotation: float
    measured: float

    @property
    def area_along(self) -> float:
        """Area of the walls before the edge, m2."""
        length = self.wall.right - self.wall.left
        return self.wall.area * min(float(np.diff(self.spans, axis=1).sum()) / max(length, LEAST_DIVISOR), 1.0)


def walls_along(edge: OuterEdge, walls: WallIndex, base: float, top: float, settings: MergeSettings,
                reach: float = 1.0) -> list[WallsAlong]:
    """What was measured along an edge between heights `base` and `top` (m), plane by plane, the largest first.

    `reach` : m beyond the maximum offset up to which walls are looked for.
    """
    near = [wall for wall in walls.near(edge, settings.max_offset + reach)
            if not (math.isfinite(wall.rmse) and wall.rmse > settings.max_rmse)
            and _along(edge, wall, base, top) is not None]
    found = []
    while near:
        first = max(near, key=lambda wall: (wall.area, -wall.number))
        coplanar = [wall for wall in near if wall is first or _coplanar(first, wall)]
        near = [wall for wall in near if not any(wall is one for one in coplanar)]
        whole = _summed(first, coplanar)
        offset, rotation = _along(edge, whole, base, top)[1:]
        line = edge.line
        spans = np.array([np.clip(np.sort([(wall.point + end * wall.along - edge.ends[0]) @ line.along
                                           for end in (wall.left, wall.right)]), 0.0, edge.length)
                          for wall in coplanar])
        spans = _union(spans)
        found.append(WallsAlong(whole, spans, offset, rotation, float(np.diff(spans, axis=1).sum() / edge.length)))
    return found


def _coplanar(first: MeasuredWall, other: MeasuredWall) -> bool:
    """Whether a wall lies on the line of a larger one that faces the same way."""
    ends = np.array([other.point + end * other.along for end in (other.left, other.right)])
    away = np.abs((ends - first.point) @ first.normal).max()
    return bool(first.normal @ other.normal > FACING and away < COPLANAR)


def _summed(first: MeasuredWall, parts: Sequence[MeasuredWall]) -> MeasuredWall:
    """Walls of one plane as one: the line through those that do not lie over each other, weighted by their areas.

    Of walls over each other that with most points holds the line: panes in their frames send few beams back, and are
    at a depth of their own.
    """
    if len(parts) == 1:
        return first
    first = max(parts, key=lambda wall: (wall.points, wall.area, -wall.number))
    holding = _apart(first, parts)
    shares = np.linspace(0.0, 1.0, 9)
    places = np.concatenate([wall.point + np.outer(wall.left + shares * (wall.right - wall.left), wall.along)
                             for wall in holding])
    weight = np.repeat([wall.area for wall in holding], len(shares))
    centre = (weight[:, None] * places).sum(axis=0) / weight.sum()
    away = places - centre
    along = np.linalg.eigh(np.einsum("n,ni,nj->ij", weight, away, away))[1][:, 1]
    along = along if along @ first.along > 0 else -along
    extent = np.concatenate([(wall.point + end * wall.along - centre)[None] @ along for wall in parts
                             for end in (wall.left, wall.right)])
    area = np.array([wall.area for wall in parts])
    return replace(first, point=centre, normal=np.array([along[1], -along[0]]), left=float(extent.min()),
                   right=float(extent.max()), foot=min(wall.foot for wall in parts),
                   top=max(wall.top for wall in parts), area=float(area.sum()),
                   rmse=float(np.sqrt(np.average([wall.rmse**2 for wall in parts], weights=area))))


def _apart(first: MeasuredWall, parts: Sequence[MeasuredWall]) -> list[MeasuredWall]:
    """The strongest wall, and those of which stronger ones cover less than a good part, each by its length and height.
    """
    holding: list[MeasuredWall] = []
    boxes: list[shapely.Polygon] = []
    for wall in sorted(parts, key=lambda wall: (-wall.points, -wall.area, wall.number)):
        ends = [float((wall.point + end * wall.along - first.point) @ first.along) for end in (wall.left, wall.right)]
        box = shapely.box(min(ends), wall.foot, max(ends), wall.top)
        if not boxes or shapely.intersection(box, shapely.union_all(boxes)).area <= OVER * box.area:
            holding.append(wall)
            boxes.append(box)
    return holding


def _union(spans: np.ndarray) -> np.ndarray:
    """Intervals (k, 2) in order, those that overlap merged."""
    union: list[list[float]] = []
    for low, high in spans[np.argsort(spans[:, 0], kind="stable")].tolist():
        if union and low <= union[-1][1]:
            union[-1][1] = max(union[-1][1], high)
        else:
            union.append([low, high])
    return np.array(union)


def steps_along(edge: OuterEdge, walls: WallIndex, base: float, top: float, settings: MergeSettings) -> list[float]:
    """Where the facade along an edge steps (bay, recess), m from its start: between walls of different depth.

    Of walls that lie over each other the larger one has the place. Walls beyond the maximum offset count: the piece of
    the edge before them stays, but does not go with the rest.
    """
    free = [(0.0, edge.length)]
    pieces: list[tuple[float, float, int]] = []
    found = [one for one in walls_along(edge, walls, base, top, settings, STEP_REACH)
             if abs(one.rotation) <= settings.max_rotation]
    ordered = sorted(found, key=lambda one: -one.area_along)
    for number, one in enumerate(ordered):
        free_spans = [(max(low, start), min(high, end)) for low, high in one.spans for start, end in free
                      if min(high, end) - max(low, start) >= MIN_PIECE]
        pieces += [(low, high, number) for low, high in free_spans]
        for low, high in free_spans:
            free = [part for start, end in free for part in ((start, min(low, end)), (max(high, start), end))
                    if part[1] > part[0]]
    depth = [one.offset for one in ordered]
    pieces.sort()
    breaks = [(before[1] + after[0]) / 2 for before, after in zip(pieces[:-1], pieces[1:])
              if abs(depth[before[2]] - depth[after[2]]) > STEP and after[0] - before[1] < STEP_GAP]
    ends = [0.0, *breaks, edge.length]
    return breaks if breaks and min(np.diff(ends)) >= MIN_PIECE else []


def match_edge(edge: OuterEdge, walls: WallIndex, base: float, top: float, settings: MergeSettings) -> EdgeMatch:
    """The measured wall of an edge between heights `base` and `top` (m), and what follows."""
    found: list[WallsAlong] = []
    far = None
    for one in walls_along(edge, walls, base, top, settings):
        if one.measured < settings.min_share or one.measured * edge.length < MIN_PIECE:
            continue
        if abs(one.offset) > settings.max_offset or abs(one.rotation) > settings.max_rotation:
            if far is None or abs(one.offset) < abs(far.offset):
                far = _match(TOO_FAR, _far_note(one.offset, one.rotation, settings), one)
            continue
        found.append(one)
    if not found:
        return far or EdgeMatch(NOT_SEEN, say("no measured wall runs along it"))
    # What is longer but low stands before the facade: a canopy, a sign, a garden wall, a hoarding.
    best = max(found, key=lambda one: (round(one.area_along, 1), one.measured))
    others = [one for one in found
              if one is not best and abs(one.offset - best.offset) > STEP and one.measured > 0.25]
    note = say("{others_count} more wall{value} at another depth along it", others_count=len(others),
               value="s" * (len(others) > 1)) if others else ""
    line = _new_line(edge, best.wall, best.measured, best.rotation)
    if best.measured < SHORT and _walls_off_line(edge, line, walls, best.wall, base, top, settings):
        return _match(TOO_FAR, say("the facade along it is not straight"), best)
    ends = np.array([line.foot(end) for end in edge.ends]) - edge.ends
    if np.hypot(*ends.T).max() < SAME:
        return _match(KEPT, note, best)
    if np.hypot(*ends.T).max() > 1.5 * settings.max_offset:
        return _match(TOO_FAR, say("an end would move too far"), best)
    return _match(MOVED, note, best, line)


def _match(status: str, note: str, walls: WallsAlong, line: Line | None = None) -> EdgeMatch:
    return EdgeMatch(status, note, walls.wall, line, walls.offset, walls.rotation, walls.measured)


def _walls_off_line(edge: OuterEdge, line: Line, walls: WallIndex, chosen: MeasuredWall, base: float, top: float,
                    settings: MergeSettings) -> bool:
    """Whether other walls before the edge, however oriented, lie off the line that one of them gives."""
    for wall in walls.near(edge, settings.max_offset):
        if (_coplanar(chosen, wall) or wall.normal @ line.outward < 0.5
                or min(wall.top, top) - max(wall.foot, base) < 0.5):
            continue
        middle = wall.point + (wall.left + wall.right) / 2 * wall.along
        extent = (middle - edge.ends[0]) @ edge.line.along
        if 0 < extent < edge.length and abs((middle - line.point) @ line.outward) > MAX_BEND:
            return True
    return False


def _along(edge: OuterEdge, wall: MeasuredWall, base: float, top: float) -> tuple[float, float, float] | None:
    """Share of the edge that a wall runs along, its offset outwards (m) and rotation (degrees); None where it does
    not."""
    line = edge.line
    cosine = float(line.outward @ wall.normal)
    if cosine < FACING or min(wall.top, top) - max(wall.foot, base) < 0.5:
        return None
    ends = np.array([wall.point + extent * wall.along for extent in (wall.left, wall.right)])
    extent = np.sort((ends - edge.ends[0]) @ line.along)
    low, high = max(extent[0], 0.0), min(extent[1], edge.length)
    if high <= low:
        return None
    middle = edge.ends[0] + (low + high) / 2 * line.along
    offset = float(((wall.point - middle) @ wall.normal) / cosine)
    rotation = math.degrees(math.atan2(line.along[0] * wall.along[1] - line.along[1] * wall.along[0],
                                       float(line.along @ wall.along)))
    return (high - low) / edge.length, offset, rotation


def _new_line(edge: OuterEdge, wall: MeasuredWall, measured: float, rotation: float) -> Line:
    """The wall's trace; an edge of which little was measured, on a wall that is short or rotated, keeps its
    direction."""
    if measured >= SHORT or (wall.right - wall.left >= LONG and abs(rotation) < SMALL_ROTATION):
        return Line(wall.point, wall.along)
    line = edge.line
    ends = np.array([wall.point + extent * wall.along for extent in (wall.left, wall.right)])
    extent = np.clip((ends - edge.ends[0]) @ line.along, 0.0, edge.length)
    middle = edge.ends[0] + extent.mean() * line.along
    shift = ((wall.point - middle) @ wall.normal) / float(line.outward @ wall.normal)
    return Line(edge.ends[0] + shift * line.outward, line.along)


def _far_note(offset: float, rotation: float, settings: MergeSettings) -> str:
    if abs(offset) > settings.max_offset:
        return say("the wall was measured {offset:.2f} m {value} of it", offset=abs(offset),
                   value=say("outside") if offset > 0 else say("inside"))
    return say("the measured wall is rotated by {rotation:.1f} degrees against it", rotation=abs(rotation))

JAVANMARDI = MergeSettings()
"""The height of J 5.7, and limits for models of airborne scanning."""
