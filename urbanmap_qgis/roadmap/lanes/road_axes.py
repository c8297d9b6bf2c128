"""Road axes of other maps as evidence: directions, numbers of lanes and speed limits, in OpenStreetMap's fields."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from ..map_records import MapLane, VectorMap
from .lane_strips import ALONG_AXIS, Strip, strip_middle
from .road_sections import RoadSection

REACH = 12.0
"""An axis belongs to a road whose lanes lie within so many metres of it: such axes are metres off."""

PARALLEL = np.cos(np.radians(15.0))
MILE = 1.609344

SPEED_FIELDS = ("speed_limit", "maxspeed")
YES, NO, BACK = {"yes", "true", "1", "t", "f"}, {"no", "false", "0"}, {"-1", "reverse", "b"}


@dataclass(frozen=True)
class RoadAxis:
    """The axis of a road.

    Attributes
    ----------
    plan : its course.
    oneway : 1 along it, -1 against it, 0 both ways, None where not told.
    lanes : number of lanes in both directions together, 0 where not told.
    speed_limit : km/h, NaN where not told.
    """

    plan: shapely.LineString
    oneway: int | None = None
    lanes: int = 0
    speed_limit: float = np.nan


def axes_of(geometries: Sequence[shapely.Geometry | None], columns: Mapping[str, Sequence]) -> list[RoadAxis]:
    """Axes of a table with the optional fields oneway, lanes and speed_limit or maxspeed (km/h, or "30 mph")."""
    axes = []
    for row, shape in enumerate(geometries):
        attributes = {name.lower(): values[row] for name, values in columns.items()}
        speeds = [_speed(attributes[name]) for name in SPEED_FIELDS if attributes.get(name) is not None]
        for part in shapely.get_parts(shape) if shape is not None else ():
            if part.geom_type == "LineString" and part.length > 0:
                axes.append(RoadAxis(shapely.force_2d(part), _oneway(attributes.get("oneway")),
                                     _count(attributes.get("lanes")), speeds[0] if speeds else np.nan))
    return axes


def _oneway(value) -> int | None:
    word = str(value).strip().lower().removesuffix(".0")
    return 1 if word in YES else -1 if word in BACK else 0 if word in NO else None


def _count(value) -> int:
    found = re.match(r"\s*(\d+)", str(value))
    return int(found.group(1)) if found else 0


def _speed(value) -> float:
    found = re.match(r"\s*(\d+(?:\.\d+)?)\s*(mph)?", str(value))
    return float(found.group(1)) * (MILE if found.group(2) else 1.0) if found else np.nan


def add_axes(strips: Sequence[Strip], section: RoadSection, axes: Sequence[RoadAxis], left_hand: bool | None) -> None:
    """Give strips that nothing else tells of the direction of their road.

    One-way roads give it to all strips. Two-way roads give it only where the side of the traffic is known and the
    strips side by side are as many as the road has lanes (two where that is not told), half for each direction: the
    place of such an axis is not trusted among lanes.
    """
    for start in sorted({strip.start for strip in strips}):
        row = [strip for strip in strips if strip.start == start]
        for group in _side_by_side(row, section):
            axis, along = _nearest(group, section, axes)
            if axis is None or axis.oneway is None:
                continue
            if axis.oneway:
                _give(group, along * axis.oneway)
            elif left_hand is not None and len(group) == (axis.lanes or 2) and len(group) % 2 == 0:
                half = len(group) // 2
                sign = 1 if left_hand else -1  # traffic along the section's axis keeps to its left, or right
                _give(group[:half], -sign)
                _give(group[half:], sign)


def _side_by_side(row: Sequence[Strip], section: RoadSection) -> list[list[Strip]]:
    """Strips that share their bounds, from right to left."""
    ordered = sorted(row, key=lambda strip: np.mean([np.interp(strip.start, section.tracks[k].chainage,
                                                               section.tracks[k].offset)
                                                     for k in (strip.right, strip.left)]))
    groups: list[list[Strip]] = []
    for strip in ordered:
        if groups and groups[-1][-1].left == strip.right:
            groups[-1].append(strip)
        else:
            groups.append([strip])
    return groups


def _nearest(group: Sequence[Strip], section: RoadSection,
             axes: Sequence[RoadAxis]) -> tuple[RoadAxis | None, int]:
    """The one axis that runs along strips side by side, and 1 or -1 for its direction along the section's axis.

    None where there is no axis, or where axes that differ lie there.
    """
    middle = np.mean([strip_middle(section, strip) for strip in group], axis=0)
    _, course = section.axis.frame(section.axis.chainage(middle[None]))
    near = []
    for axis in axes:
        place = shapely.Point(middle)
        distance = axis.plan.distance(place)
        if distance > REACH:
            continue
        cosine = _course(axis.plan, place) @ course[0]
        if abs(cosine) > PARALLEL:
            near.append((axis, 1 if cosine > 0 else -1))
    ways = {axis.oneway * along if axis.oneway is not None else None for axis, along in near}
    return near[0] if len(ways) == 1 else (None, 0)


def _course(plan: shapely.LineString, place: shapely.Point) -> np.ndarray:
    """Unit direction of a line where it is nearest to a place."""
    at = plan.project(place)
    ends = [shapely.get_coordinates(plan.interpolate(min(max(at + step, 0.0), plan.length)))[0] for step in (-1.0, 1.0)]
    return (ends[1] - ends[0]) / max(np.linalg.norm(ends[1] - ends[0]), LEAST_DIVISOR)


def _give(group: Sequence[Strip], sign: int) -> None:
    """The direction of the road to strips without evidence of their own."""
    for strip in group:
        if strip.sign == 0 and not strip.contradicted and strip.forward == strip.backward == 0:
            strip.sign, strip.source = sign, ALONG_AXIS


def add_speed_limits(built: VectorMap, axes: Sequence[RoadAxis]) -> None:
    """Give each lane the speed limit of the axis that runs along it; none where axes differ."""
    for lane in built.lanes:
        limits = {axis.speed_limit for axis in axes if np.isfinite(axis.speed_limit) and _runs_along(lane, axis)}
        if len(limits) == 1:
            lane.speed_limit = float(limits.pop())


def _runs_along(lane: MapLane, axis: RoadAxis) -> bool:
    middle = shapely.LineString(lane.centre[:, :2]).interpolate(0.5, normalized=True)
    if axis.plan.distance(middle) > REACH:
        return False
    return abs(_course(axis.plan, middle) @ _course(shapely.LineString(lane.centre[:, :2]), middle)) > PARALLEL
