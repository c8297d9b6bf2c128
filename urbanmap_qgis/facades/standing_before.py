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

WALL, CANOPY, SIGN, BALCONY, GARDEN_WALL, HOARDING, POST, SETBACK, RECESS, UNCLEAR = (
    mark("wall"), mark("canopy"), mark("sign band"), mark("balcony"), mark("garden wall"), mark("hoarding"),
    mark("post"), mark("setback"), mark("recess"), mark("unclear"))
"""Kinds of walls; `SETBACK`: of storeys that stand back over a ground floor; `RECESS`: of a ground floor that stands
back under storeys on columns; `UNCLEAR`: it or another at a different depth is the facade."""

GROUND_FLOOR, UPPER_FLOORS = "ground floor", "upper floors"
"""On the way: a wall that ends below storeys that stand back; one of storeys that hang in the air."""

FACING = 0.94
BEFORE = 0.3  # What stands less than this before a wall, m, is of it.
SAME = 0.15  # Walls whose depths differ by less, m, are one at that depth.
STOREY = 2.2  # Lower than this, m, no room is: a strip of it is no storey, a wall up to it no house.
GROUND_FLOOR_HEIGHT = 3.6  # A wall from the ground up to here, m, can be a hoarding or a ground floor.
IN_AIR = 1.8  # What begins higher above the ground, m, hangs.
ON_GROUND = 1.0  # What begins lower above the ground, m, stands on it.
GOES_ON = 0.5  # The wall behind is seen below or above a strip by as much, m.
SHARE = 0.3  # Share of the length of what stands before along which the wall behind it is seen.
ROW = 0.25  # Rows, m, of which bands are made up.
FILLED = 0.5  # A row of a band is filled to this share.
POST_WIDTH = 1.2  # Width of a post, m.
LARGE = 4.0  # The wall behind posts, or above a band, is larger by this factor than one of them.
BEYOND = 1.0  # What runs on so far past the ends of the outline's edge, m, is not the building's own.
NEARER = 0.5  # One of two walls is the outline's where it lies nearer to it than the other by this, m.
CLOSED = 0.8  # Bands, panes and what else lies at one depth are a wall where they cover this of its height.
EDGE = 0.1  # Points so near to a band's edges, m, are of the band.
BALCONY_DEPTH = 2.5  # Depth of balconies, m.
GAP_POINTS = 20
ENOUGH = 40_000  # Points of a building by which gaps are judged, evenly taken from all.


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
        seen = members[np.minimum(self.high[members], high) - np.maximum(self.low[members], low) >= GOES_ON]
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
    points = points[::max(1, len(points) // ENOUGH)]
    kinds = [_kind(walls, row, _seen_from(wall.plane, corners, normals, facade), points)
             for row, wall in enumerate(walls)]
    _tell_those_behind(walls, kinds, corners, normals, facade)
    return kinds


def _tell_those_behind(walls: Sequence[PlacedWall], kinds: list[tuple[str, float]], corners: np.ndarray,
                       normals: np.ndarray, facade: np.ndarray) -> None:
    """Walls over a ground floor are set back; those behind what may be a hoarding or a ground floor are unclear too."""
    for row, (kind, _) in enumerate(list(kinds)):
        if kind not in (UNCLEAR, GROUND_FLOOR, UPPER_FLOORS):
            continue
        seen = _seen_from(walls[row].plane, corners, normals, facade)
        over = seen.behind & (seen.left < seen.right[row]) & (seen.right > seen.left[row])
        if kind == UPPER_FLOORS:
            behind_it = _recessed(row, np.flatnonzero(over), seen)
        elif kind == GROUND_FLOOR:
            behind_it = np.flatnonzero(over & (seen.low > seen.high[row] - GOES_ON))
        else:
            behind_it = np.append(np.flatnonzero(over), _stacked(walls[row], row, seen))  # panes of it are as unclear
        kinds[row] = (kind if kind == UNCLEAR else WALL, 0.0)
        for other in behind_it:
            if kinds[other][0] in (WALL, UPPER_FLOORS):
                kinds[other] = ({UPPER_FLOORS: RECESS, GROUND_FLOOR: SETBACK}.get(kind, UNCLEAR), 0.0)


def _recessed(row: int, over: np.ndarray, seen: _Seen) -> np.ndarray:
    """Those of the walls behind one that hangs (k,) that end below it, along half of their length, and do not go on."""
    ends = over[seen.high[over] < seen.low[row] + GOES_ON]
    common = np.minimum(seen.right[ends], seen.right[row]) - np.maximum(seen.left[ends], seen.left[row])
    ends = ends[common > 0.5 * (seen.right[ends] - seen.left[ends])]
    higher = over[seen.high[over] >= seen.low[row] + GOES_ON]
    goes_on = np.abs(seen.depth[ends][:, None] - seen.depth[higher]) < SAME
    return ends[~goes_on.any(axis=1)]


def _seen_from(plane: WallPlane, corners: np.ndarray, normals: np.ndarray, facade: np.ndarray) -> _Seen:
    """All walls in the plane of one."""
    flat = (corners - plane.point).reshape(-1, 3)
    along = component(flat, plane.axes[0]).reshape(-1, 4)
    depth = -component(flat, plane.normal).reshape(-1, 4).mean(axis=1)
    z = corners[..., 2]
    behind = (component(normals, plane.normal) > FACING) & (depth > BEFORE) & facade
    return _Seen(along.min(axis=1), along.max(axis=1), z.min(axis=1), z.max(axis=1), depth, behind)


def _kind(walls: Sequence[PlacedWall], row: int, seen: _Seen, points: np.ndarray) -> tuple[str, float]:
    """Kind of one wall: that of the nearest depth at which it has others behind it; bands may have none seen."""
    wall = walls[row]
    foot, top = seen.low[row] - wall.ground, seen.high[row] - wall.ground
    for depth in np.unique(seen.depth[seen.behind]):
        members = np.flatnonzero(seen.behind & (np.abs(seen.depth - depth) < SAME))
        members = members[(seen.left[members] < seen.right[row] + POST_WIDTH)
                          & (seen.right[members] > seen.left[row] - POST_WIDTH)]
        if not len(members):
            continue
        if _post(walls, row, members, seen):
            return POST, float(depth)
        kind = WALL
        if foot > IN_AIR:
            kind = _hanging(walls, row, members, seen)
        elif foot < ON_GROUND and top < GROUND_FLOOR_HEIGHT:
            kind = _standing(walls, row, members, seen)
        if kind != WALL:
            return kind, float(depth)
    return _storeys(wall, row, seen, points) if foot > IN_AIR else (WALL, 0.0)


def _storeys(wall: PlacedWall, row: int, seen: _Seen, points: np.ndarray) -> tuple[str, float]:
    """Kind of a wall in the air that is more than one band: balconies, or storeys."""
    stacked = _stacked(wall, row, seen)
    if seen.high[stacked].max() - seen.low[stacked].min() < STOREY:
        return WALL, 0.0
    going_on = _wall_behind_all(row, stacked, seen)
    behind = going_on if np.isfinite(going_on) else _behind_bands(wall, row, stacked, seen, points)
    if np.isnan(behind):
        return UPPER_FLOORS, 0.0
    return (BALCONY, behind) if np.isfinite(behind) else (UNCLEAR, 0.0)


def _post(walls: Sequence[PlacedWall], row: int, members: np.ndarray, seen: _Seen) -> bool:
    """Whether a narrow wall stands before a large one as high as it."""
    if seen.right[row] - seen.left[row] > POST_WIDTH:
        return False
    area = sum(walls[one].contour.polygon.area for one in members)
    low, high = seen.low[members].min(), seen.high[members].max()
    common = min(high, seen.high[row]) - max(low, seen.low[row])
    return bool(area > LARGE * walls[row].contour.polygon.area
                and common > 0.5 * (seen.high[row] - seen.low[row]))


def _hanging(walls: Sequence[PlacedWall], row: int, members: np.ndarray, seen: _Seen) -> str:
    """Kind of a wall that hangs in the air alone: a band with a wall behind it that is seen below it, or, where a
    hoarding hides it there, a storey above it and many times as large."""
    if seen.high[row] - seen.low[row] > STOREY or len(_stacked(walls[row], row, seen)) > 1:
        return WALL
    below = seen.covered(row, members, -np.inf, seen.low[row])
    higher = members[seen.high[members] > seen.high[row] + STOREY]
    area = sum(walls[one].contour.polygon.area for one in higher)
    above = seen.covered(row, higher, seen.high[row], np.inf) if (
        area > LARGE * walls[row].contour.polygon.area) else 0.0
    if max(below, above) < SHARE:
        return WALL
    return CANOPY if seen.depth[members].mean() > seen.high[row] - seen.low[row] else SIGN


def _stacked(wall: PlacedWall, row: int, seen: _Seen) -> np.ndarray:
    """Walls in the air at the depth of one (k,), over or under it, and itself."""
    return np.flatnonzero((np.abs(seen.depth) < SAME) & (seen.right > seen.left[row])
                          & (seen.left < seen.right[row]) & (seen.low > wall.ground + IN_AIR))


def _wall_behind_all(row: int, stacked: np.ndarray, seen: _Seen) -> float:
    """Distance (m) of a wall close behind strips (k,) that is seen from below the lowest to above the highest, so that
    they are balconies whatever is seen in the rooms; NaN for none."""
    strips = seen.high[stacked] - seen.low[stacked]
    if len(stacked) < 2 or strips.max() > STOREY:
        return np.nan
    through = np.flatnonzero(seen.behind & (seen.depth < BALCONY_DEPTH)
                             & (seen.low < seen.low[stacked].min() - GOES_ON)
                             & (seen.high > seen.high[stacked].max() + GOES_ON))
    common = np.minimum(seen.right[through], seen.right[row]) - np.maximum(seen.left[through], seen.left[row])
    through = through[common > SHARE * (seen.right[row] - seen.left[row])]
    return float(seen.depth[through].min()) if len(through) else np.nan


def _bands(wall: PlacedWall) -> np.ndarray:
    """Heights (k, 2) in the plane, m, between which the wall is filled along most of its length."""
    shape = wall.contour.measured
    left, low, right, high = shape.bounds
    rows = np.arange(low, high, ROW) + ROW / 2
    columns = np.linspace(left, right, 42)[1:-1]
    shapely.prepare(shape)
    filled = shapely.contains_xy(shape, *np.meshgrid(columns, rows)).mean(axis=1) > FILLED
    change = np.flatnonzero(np.diff(np.concatenate([[False], filled, [False]]).astype(np.int8)))
    return low + ROW * change.reshape(-1, 2)


def _behind_bands(wall: PlacedWall, row: int, stacked: np.ndarray, seen: _Seen, points: np.ndarray) -> float:
    """Distance (m) of the wall behind bands (k,) between which it is open; NaN where they are of a wall, infinite where
    too little was seen between them.

    Between balconies points lie on the soffits and on the wall behind; behind windows on the panes, on what is between
    them, and deep in the rooms.
    """
    tall = seen.high[row] - seen.low[row] > STOREY
    bands = _bands(wall) + wall.plane.point[2] if tall else np.array([[seen.low[row], seen.high[row]]])
    if len(stacked) + len(bands) < 3 or not len(bands) or np.diff(bands, axis=1).max() > STOREY:
        return np.nan
    flat = points - wall.plane.point
    along, away = component(flat, wall.plane.axes[0]), -component(flat, wall.plane.normal)
    z = points[:, 2]
    near = ((along > seen.left[row]) & (along < seen.right[row]) & (away > -BEFORE)
            & (z > seen.low[stacked].min()) & (z < seen.high[stacked].max()))
    others = np.column_stack([seen.low, seen.high])[stacked[stacked != row]]
    for low, high in np.concatenate([bands, others]):
        near &= (z < low - EDGE) | (z > high + EDGE)
    heights = np.arange(seen.low[stacked].min(), seen.high[stacked].max(), EDGE)
    covered = [(low <= heights) & (heights <= high) for low, high in np.concatenate([bands, others])]
    if np.any(covered, axis=0).mean() > CLOSED:
        return np.nan  # slits at its edges tell nothing
    away = away[near]
    between = away[(away > BEFORE) & (away < BALCONY_DEPTH)]
    if len(away) < GAP_POINTS:
        return np.inf
    return np.nan if len(between) < FILLED * len(away) else float(np.quantile(between, 0.9))


def _standing(walls: Sequence[PlacedWall], row: int, members: np.ndarray, seen: _Seen) -> str:
    """Kind of a low wall on the ground with higher ones behind it."""
    wall, top = walls[row], seen.high[row]
    higher = members[seen.high[members] > top + 2 * GOES_ON]
    if not len(higher) or seen.covered(row, higher, top, np.inf) < SHARE:
        return WALL
    if top - wall.ground < STOREY:
        return GARDEN_WALL
    if wall.ends is None or _runs_on(wall, seen.left[row], seen.right[row]):
        return HOARDING
    behind = np.nanmedian([walls[one].offset for one in higher])
    if abs(behind) + NEARER < abs(wall.offset):
        return HOARDING
    return GROUND_FLOOR if abs(wall.offset) + NEARER < abs(behind) else UNCLEAR


def _runs_on(wall: PlacedWall, left: float, right: float) -> bool:
    """Whether a wall runs on past the ends of the outline's edge."""
    edge = component(wall.ends - wall.plane.point[:2], wall.plane.axes[0][:2])
    return bool(left < edge.min() - BEYOND or right > edge.max() + BEYOND)
