"""What stands before a facade: canopies, signs, balconies, garden walls, hoardings and posts, told by form and place.

A strip in the air is no storey, nor is what ends below a person's height; with a wall behind it that goes on it stands
before that wall. Where a low wall and a set-back storey look alike the outline decides, or nobody.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ..wording import mark
from .plane_fit import WallPlane, component
from .wall_contours import Contour, on_map

WALL, CANOPY, SIGN, BALCONY, GARDEN_WALL, HOARDING, POST, SETBACK, UNCLEAR = (
    mark("wall"), mark("canopy"), mark("sign band"), mark("balcony"), mark("garden wall"), mark("hoarding"),
    mark("post"), mark("setback"), mark("unclear"))
"""Kinds of walls; `SETBACK`: of storeys that stand back over a ground floor; `UNCLEAR`: it or another at a different
depth is the facade."""

GROUND_FLOOR = "ground floor"
"""On the way: a wall that ends below storeys that stand back."""


@dataclass(frozen=True)
class StandingBeforeLimits:
    """Limits of standing before, each with its unit."""

    facing: float = 0.94
    before: float = 0.3  # What stands less than this before a wall, m, is of it.
    same: float = 0.15  # Walls whose depths differ by less, m, are one at that depth.
    storey: float = 2.2  # Lower than this, m, no room is: a strip of it is no storey, a wall up to it no house.
    ground_floor: float = 3.6  # A wall from the ground up to here, m, can be a hoarding or a ground floor.
    in_air: float = 1.8  # What begins higher above the ground, m, hangs.
    on_ground: float = 1.0  # What begins lower above the ground, m, stands on it.
    goes_on: float = 0.5  # The wall behind is seen below or above a strip by as much, m.
    share: float = 0.3  # Share of the length of what stands before along which the wall behind it is seen.
    row: float = 0.25  # Rows, m, of which bands are made up.
    filled: float = 0.5  # A row of a band is filled to this share.
    post: float = 1.2  # Width of a post, m.
    post_area: float = 4.0  # The wall behind posts is larger by this factor than one of them.
    beyond: float = 1.0  # What runs on so far past the ends of the outline's edge, m, is not the building's own.
    nearer: float = 0.5  # One of two walls is the outline's where it lies nearer to it than the other by this, m.
    gap_points: int = 20


LIMITS = StandingBeforeLimits()


@dataclass(frozen=True, eq=False)
class PlacedWall:
    """A contour on a plane of a building.

    Attributes
    ----------
    plane, contour : where it is.
    offset : distance outwards from the outline's edge that it runs along, m; NaN for none.
    ends : (2, 2) of that edge, None for none.
    facade : whether it may be a facade: no deeper inside the outline than outlines may be off.
    ground : height of the ground before it, m.
    """

    plane: WallPlane
    contour: Contour
    offset: float
    ends: np.ndarray | None
    facade: bool
    ground: float


@dataclass(frozen=True, eq=False)
class _Seen:
    """All walls of a building seen in the plane of one, arrays (n,): extent along it, heights, depth behind it, m."""

    left: np.ndarray
    right: np.ndarray
    low: np.ndarray
    high: np.ndarray
    depth: np.ndarray
    behind: np.ndarray

    def covered(self, row: int, members: np.ndarray, low: float, high: float) -> float:
        """Share of the length of wall `row` along which walls (k,) are seen between two heights (m)."""
        seen = members[np.minimum(self.high[members], high) - np.maximum(self.low[members], low) >= LIMITS.goes_on]
        spans = [(max(self.left[one], self.left[row]), min(self.right[one], self.right[row])) for one in seen]
        lines = [shapely.LineString([(a, 0.0), (b, 0.0)]) for a, b in spans if b > a]
        length = self.right[row] - self.left[row]
        return float(shapely.length(shapely.union_all(lines))) / length if lines else 0.0


def kinds_of_walls(walls: Sequence[PlacedWall], points: np.ndarray) -> list[tuple[str, float]]:
    """Kind of each wall of a building, and how far it stands before the wall behind it, m (0 for walls).

    Parameters
    ----------
    points : (n, 3) of the building.
    """
    corners = np.array([shapely.get_coordinates(on_map(wall.plane, shapely.box(*wall.contour.measured.bounds)),
                                                include_z=True)[:4] for wall in walls]).reshape(-1, 4, 3)
    normals = np.array([wall.plane.normal for wall in walls]).reshape(-1, 3)
    facade = np.array([wall.facade for wall in walls], bool)
    kinds = [(WALL, 0.0)] * len(walls)
    for row, wall in enumerate(walls):
        seen = _seen_from(wall.plane, corners, normals, facade)
        if seen.behind.any():
            kinds[row] = _kind(walls, row, seen, points)
    _tell_those_behind(walls, kinds, corners, normals, facade)
    return kinds


def _tell_those_behind(walls: Sequence[PlacedWall], kinds: list[tuple[str, float]], corners: np.ndarray,
                       normals: np.ndarray, facade: np.ndarray) -> None:
    """Walls over a ground floor are set back; those behind what may be a hoarding or a ground floor are unclear too."""
    for row, (kind, _) in enumerate(list(kinds)):
        if kind not in (UNCLEAR, GROUND_FLOOR):
            continue
        seen = _seen_from(walls[row].plane, corners, normals, facade)
        higher = seen.behind & (seen.high > seen.high[row] + 2 * LIMITS.goes_on)
        higher &= (seen.left < seen.right[row]) & (seen.right > seen.left[row])
        if kind == GROUND_FLOOR:
            kinds[row] = (WALL, 0.0)
            higher &= seen.low > seen.high[row] - LIMITS.goes_on
        for other in np.flatnonzero(higher):
            if kinds[other][0] == WALL:
                kinds[other] = (UNCLEAR if kind == UNCLEAR else SETBACK, 0.0)


def _seen_from(plane: WallPlane, corners: np.ndarray, normals: np.ndarray, facade: np.ndarray) -> _Seen:
    """All walls in the plane of one."""
    flat = (corners - plane.point).reshape(-1, 3)
    along = component(flat, plane.axes[0]).reshape(-1, 4)
    depth = -component(flat, plane.normal).reshape(-1, 4).mean(axis=1)
    z = corners[..., 2]
    behind = (component(normals, plane.normal) > LIMITS.facing) & (depth > LIMITS.before) & facade
    return _Seen(along.min(axis=1), along.max(axis=1), z.min(axis=1), z.max(axis=1), depth, behind)


def _kind(walls: Sequence[PlacedWall], row: int, seen: _Seen, points: np.ndarray) -> tuple[str, float]:
    """Kind of one wall that has others behind it: that of the nearest depth at which it has one."""
    wall = walls[row]
    for depth in np.unique(seen.depth[seen.behind]):
        members = np.flatnonzero(seen.behind & (np.abs(seen.depth - depth) < LIMITS.same))
        members = members[(seen.left[members] < seen.right[row] + LIMITS.post)
                          & (seen.right[members] > seen.left[row] - LIMITS.post)]
        if not len(members):
            continue
        foot, top = seen.low[row] - wall.ground, seen.high[row] - wall.ground
        if _post(walls, row, members, seen):
            return POST, float(depth)
        kind = WALL
        if foot > LIMITS.in_air:
            kind = _hanging(wall, row, members, seen, points)
        elif foot < LIMITS.on_ground and top < LIMITS.ground_floor:
            kind = _standing(walls, row, members, seen)
        if kind != WALL:
            return kind, float(depth)
    return WALL, 0.0


def _post(walls: Sequence[PlacedWall], row: int, members: np.ndarray, seen: _Seen) -> bool:
    """Whether a narrow wall stands before a large one as high as it."""
    if seen.right[row] - seen.left[row] > LIMITS.post:
        return False
    area = sum(walls[one].contour.polygon.area for one in members)
    low, high = seen.low[members].min(), seen.high[members].max()
    common = min(high, seen.high[row]) - max(low, seen.low[row])
    return bool(area > LIMITS.post_area * walls[row].contour.polygon.area
                and common > 0.5 * (seen.high[row] - seen.low[row]))


def _hanging(wall: PlacedWall, row: int, members: np.ndarray, seen: _Seen, points: np.ndarray) -> str:
    """Kind of a wall that hangs in the air before others: one band, or bands with what lies behind between them."""
    bands = _bands(wall)
    depth = float(seen.depth[members].mean())
    if not len(bands) or np.diff(bands, axis=1).max() > LIMITS.storey:
        return WALL
    if seen.covered(row, members, -np.inf, seen.low[row]) < LIMITS.share:
        return WALL
    stacked = ((np.abs(seen.depth) < LIMITS.same) & (seen.right > seen.left[row]) & (seen.left < seen.right[row])
               & (seen.low > wall.ground + LIMITS.in_air))
    if len(bands) == 1 and np.count_nonzero(stacked) == 1:
        return CANOPY if depth > float(np.diff(bands[0])[0]) else SIGN
    return WALL if _closed(wall, row, np.flatnonzero(stacked), seen, points, depth) else BALCONY


def _bands(wall: PlacedWall) -> np.ndarray:
    """Heights (k, 2) in the plane, m, between which the wall is filled along most of its length."""
    shape = wall.contour.measured
    left, low, right, high = shape.bounds
    rows = np.arange(low, high, LIMITS.row) + LIMITS.row / 2
    columns = np.linspace(left, right, 42)[1:-1]
    shapely.prepare(shape)
    filled = shapely.contains_xy(shape, *np.meshgrid(columns, rows)).mean(axis=1) > LIMITS.filled
    change = np.flatnonzero(np.diff(np.concatenate([[False], filled, [False]]).astype(np.int8)))
    return low + LIMITS.row * change.reshape(-1, 2)


def _closed(wall: PlacedWall, row: int, bands: np.ndarray, seen: _Seen, points: np.ndarray, depth: float) -> bool:
    """Whether the space between bands (k,), this one among them, is a wall's: on their plane or beyond the one behind.

    Between balconies they lie on the soffits and on the wall behind, behind windows on the panes and in the rooms.
    """
    flat = points - wall.plane.point
    along, away = component(flat, wall.plane.axes[0]), -component(flat, wall.plane.normal)
    near = (along > seen.left[row]) & (along < seen.right[row]) & (points[:, 2] > seen.low[bands].min())
    near &= (points[:, 2] < seen.high[bands].max()) & (away > -LIMITS.before)
    local = points[:, 2] - wall.plane.point[2]
    for low, high in _bands(wall):
        near &= (local < low) | (local > high)
    for one in bands[bands != row]:
        near &= (points[:, 2] < seen.low[one]) | (points[:, 2] > seen.high[one])
    away = away[near]
    between = np.count_nonzero((away > LIMITS.before) & (away < depth + LIMITS.same))
    return bool(len(away) < LIMITS.gap_points or between < 0.5 * len(away))


def _standing(walls: Sequence[PlacedWall], row: int, members: np.ndarray, seen: _Seen) -> str:
    """Kind of a low wall on the ground with higher ones behind it."""
    wall, top = walls[row], seen.high[row]
    higher = members[seen.high[members] > top + 2 * LIMITS.goes_on]
    if not len(higher) or seen.covered(row, higher, top, np.inf) < LIMITS.share:
        return WALL
    if top - wall.ground < LIMITS.storey:
        return GARDEN_WALL
    if wall.ends is None or _runs_on(wall, seen.left[row], seen.right[row]):
        return HOARDING
    behind = np.nanmedian([walls[one].offset for one in higher])
    if abs(behind) + LIMITS.nearer < abs(wall.offset):
        return HOARDING
    return GROUND_FLOOR if abs(wall.offset) + LIMITS.nearer < abs(behind) else UNCLEAR


def _runs_on(wall: PlacedWall, left: float, right: float) -> bool:
    """Whether a wall runs on past the ends of the outline's edge."""
    edge = component(wall.ends - wall.plane.point[:2], wall.plane.axes[0][:2])
    return bool(left < edge.min() - LIMITS.beyond or right > edge.max() + LIMITS.beyond)
