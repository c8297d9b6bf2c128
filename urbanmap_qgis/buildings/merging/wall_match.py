"""Which measured wall belongs to which edge of a model's plan, and where the edge goes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...errors import InputError
from .plan_edges import Line, OuterEdge

MOVED, KEPT, NOT_SEEN, TOO_FAR, NEIGHBOUR, FOLDED = (
    "moved", "fits", "not seen", "too far", "neighbour", "does not fit")
"""What became of an edge: on the measured wall; it lay there already; no wall along it; the wall is beyond the limits;
it would run into a neighbour; the plan would fold."""

_SAME = 0.01
_SHORT = 0.5
_LONG = 4.0
_BENT = 0.3
_SMALL_ROTATION = 1.0


@dataclass(frozen=True)
class MergeSettings:
    """Limits within which walls of models follow measured walls.

    Parameters
    ----------
    height : up to which height above the model's ground walls are taken from the survey, m (J 5.7: 20 m).
    max_offset : maximum distance by which a wall moves, m. max_rotation : maximum rotation, degrees.
    min_share : minimum share of a wall's length that must have been measured; at least a metre.
    overhang : a roof that stands out over the measured wall by more than this stays as it is, m; below, it follows.
    slab : height of the roof's edge over an overhang, m, where the top of the measured wall does not tell it.
    max_rmse : walls whose points scatter more are not used, m.
    """

    height: float = 20.0
    max_offset: float = 1.5
    max_rotation: float = 5.0
    min_share: float = 0.3
    overhang: float = 0.3
    slab: float = 0.3
    max_rmse: float = 0.1

    def __post_init__(self) -> None:
        if not (self.height > 0 and self.max_offset > 0 and 0 < self.max_rotation <= 20 and 0 < self.min_share <= 1):
            raise InputError("Height, maximum offset and rotation (up to 20 degrees) and the share of a wall must be "
                             "greater than 0.")


@dataclass(frozen=True, eq=False)
class MeasuredWall:
    """A wall of the survey as the plan sees it.

    Attributes
    ----------
    number : row in the layer. point, normal : (2,) of its trace in plan at half its height, the normal outwards.
    left, right : extent along its trace from the point, m, seen from in front. foot, top : heights, m.
    area : m2. rmse, sigma : m, NaN where unknown. tilt : degrees.
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

    @property
    def along(self) -> np.ndarray:
        """Unit vector (2,) to the right, seen from in front: the building lies at its left."""
        return np.array([-self.normal[1], self.normal[0]])


def measured_wall(number: int, polygon: shapely.Polygon, rmse: float = math.nan,
                  sigma: float = math.nan) -> MeasuredWall | None:
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
                        max(size - holes, 0.0), rmse, sigma, float(np.degrees(np.arcsin(normal[2]))))


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
    status : see the constants. note : in words. wall : the wall, None without one.
    line : where the edge goes, None where it stays. offset : of the wall outwards from the edge, m. rotation : degrees.
    measured : share of the edge's length along which the wall was measured.
    """

    status: str
    note: str = ""
    wall: MeasuredWall | None = None
    line: Line | None = None
    offset: float = math.nan
    rotation: float = math.nan
    measured: float = 0.0


def match_edge(edge: OuterEdge, walls: WallIndex, base: float, top: float, settings: MergeSettings) -> EdgeMatch:
    """The measured wall of an edge between heights `base` and `top` (m), and what follows."""
    found, far = [], None
    for wall in walls.near(edge, settings.max_offset + 1.0):
        extent = _along(edge, wall, base, top)
        if extent is None:
            continue
        measured, offset, rotation = extent
        if measured < settings.min_share or measured * edge.length < 1.0:
            continue
        if math.isfinite(wall.rmse) and wall.rmse > settings.max_rmse:
            continue
        if abs(offset) > settings.max_offset or abs(rotation) > settings.max_rotation:
            if far is None or abs(offset) < abs(far.offset):
                far = EdgeMatch(TOO_FAR, _far_note(offset, rotation, settings), wall, None, offset, rotation, measured)
            continue
        found.append((wall, measured, offset, rotation))
    if not found:
        return far or EdgeMatch(NOT_SEEN, "no measured wall runs along it")
    wall, measured, offset, rotation = max(found, key=lambda item: (round(item[1], 2), item[0].area))
    others = [item for item in found if item[0] is not wall and abs(item[2] - offset) > 0.3 and item[1] > 0.25]
    note = f"{len(others)} more wall{'s' * (len(others) > 1)} at another depth along it" if others else ""
    line = _new_line(edge, wall, measured, rotation)
    if measured < _SHORT and _bent(edge, line, walls, wall, base, top, settings):
        return EdgeMatch(TOO_FAR, "the facade along it is not straight", wall, None, offset, rotation, measured)
    ends = np.array([line.foot(end) for end in edge.ends]) - edge.ends
    if np.hypot(*ends.T).max() < _SAME:
        return EdgeMatch(KEPT, note, wall, None, offset, rotation, measured)
    if np.hypot(*ends.T).max() > 1.5 * settings.max_offset:
        return EdgeMatch(TOO_FAR, "an end would move too far", wall, None, offset, rotation, measured)
    return EdgeMatch(MOVED, note, wall, line, offset, rotation, measured)


def _bent(edge: OuterEdge, line: Line, walls: WallIndex, chosen: MeasuredWall, base: float, top: float,
          settings: MergeSettings) -> bool:
    """Whether other walls before the edge, however oriented, lie off the line that one of them gives."""
    for wall in walls.near(edge, settings.max_offset):
        if wall is chosen or wall.normal @ line.outward < 0.5 or min(wall.top, top) - max(wall.foot, base) < 0.5:
            continue
        middle = wall.point + (wall.left + wall.right) / 2 * wall.along
        extent = (middle - edge.ends[0]) @ edge.line.along
        if 0 < extent < edge.length and abs((middle - line.point) @ line.outward) > _BENT:
            return True
    return False


def _along(edge: OuterEdge, wall: MeasuredWall, base: float, top: float) -> tuple[float, float, float] | None:
    """Share of the edge that a wall runs along, its offset outwards (m) and rotation (degrees); None where it does
    not."""
    line = edge.line
    cosine = float(line.outward @ wall.normal)
    if cosine < 0.94 or min(wall.top, top) - max(wall.foot, base) < 0.5:
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
    if measured >= _SHORT or (wall.right - wall.left >= _LONG and abs(rotation) < _SMALL_ROTATION):
        return Line(wall.point, wall.along)
    line = edge.line
    ends = np.array([wall.point + extent * wall.along for extent in (wall.left, wall.right)])
    extent = np.clip((ends - edge.ends[0]) @ line.along, 0.0, edge.length)
    middle = edge.ends[0] + extent.mean() * line.along
    shift = ((wall.point - middle) @ wall.normal) / float(line.outward @ wall.normal)
    return Line(edge.ends[0] + shift * line.outward, line.along)


def _far_note(offset: float, rotation: float, settings: MergeSettings) -> str:
    if abs(offset) > settings.max_offset:
        return f"the wall was measured {abs(offset):.2f} m {'outside' if offset > 0 else 'inside'} of it"
    return f"the measured wall is rotated by {abs(rotation):.1f} degrees against it"


JAVANMARDI = MergeSettings()
"""The height of J 5.7, and limits for models of airborne scanning."""
