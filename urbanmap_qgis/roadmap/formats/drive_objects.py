"""Street objects in an OpenDRIVE file: posts, trees, rails as objects, signals, boards as signals (1.7.0, 13 and 14).

A signal stands in the file as one only where its stop line is known; else its post is an object alone. What a sign
says was not read: its type is -1, none.
"""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import shapely

from ..map_objects import SIGN, TREE, RoadsideObject, signals_of_stop_lines
from ..map_records import VectorMap
from .plan_view import along_plan
from .road_layout import LaneRoad, RoadLayout

FARTHEST = 25.0
"""Objects belong to the nearest road, up to so far from its reference line, m."""

BEYOND = 0.5
"""m past the end of a road: what stands farther is beside another one, or beside none."""

LIGHT = ("OpenDRIVE", "1000001")
"""Country and type of a traffic light with three lamps in the catalogue of ASAM OpenDRIVE."""


def add_drive_objects(roads: list, built: VectorMap, layout: RoadLayout, shapes: list, origin: np.ndarray) -> int:
    """Add what stands beside the roads.

    Parameters
    ----------
    roads : elements of the roads.
    shapes : their geometry, which tells chainage and offset of places.
    origin : (2,) m, of the file's coordinates.

    Returns
    -------
    Number of objects and rails that stand beside no road and are left out.
    """
    stop_of = {number: stop for stop, numbers in signals_of_stop_lines(built)[0].items() for number in numbers}
    objects, signals = _by_road(built, layout, shapes, origin, stop_of)
    rails = _rails_by_road(built, layout, shapes, origin)
    for road, element in enumerate(roads):
        group = _group(element, "objects", bool(objects[road] or rails[road]))
        for number, s, t in objects[road]:
            _add_post(group, number, built.objects[number], s, t, shapes[road])
        for number in rails[road]:
            _add_rail(group, number, built.rails[number], shapes[road], origin)
        group = _group(element, "signals", bool(signals[road]))
        for number, s, t in signals[road]:
            _add_signal(group, built, layout.roads[road], number, (s, t), shapes[road], stop_of.get(number))
            if number in stop_of:
                _put(group[-1], built.objects[number], s, shapes[road], origin)
    return len(built.objects) + len(built.rails) - sum(map(len, objects.values())) - sum(map(len, rails.values()))


def _by_road(built: VectorMap, layout: RoadLayout, shapes: list, origin: np.ndarray,
             stop_of: dict[int, int]) -> tuple[dict[int, list], dict[int, list]]:
    """Objects, and boards and signals, of each road: number, chainage and offset, m."""
    objects, signals = defaultdict(list), defaultdict(list)
    for number, thing in enumerate(built.objects):
        at = _nearest(shapes, layout, thing.foot[:2] - origin)
        if at is not None:
            objects[at[0]].append((number, *at[1:]))
            if thing.kind == SIGN and np.isfinite([*thing.board, thing.azimuth]).all():
                signals[at[0]].append((number, *at[1:]))
    for number, stop in stop_of.items():
        road = next(k for k, one in enumerate(layout.roads)
                    if any(stop in built.lanes[lane].stop_lines for lane in one.lanes))
        (s,), (t,) = shapes[road].local(built.objects[number].head[None, :2] - origin)
        signals[road].append((number, float(np.clip(s, 0.0, shapes[road].s[-1])), float(t)))
    return objects, signals


def _rails_by_road(built: VectorMap, layout: RoadLayout, shapes: list, origin: np.ndarray) -> dict[int, list[int]]:
    """Numbers of the rails of each road."""
    rails = defaultdict(list)
    for number, rail in enumerate(built.rails):
        middle = shapely.line_interpolate_point(shapely.linestrings(rail[:, :2] - origin), 0.5, normalized=True)
        if (at := _nearest(shapes, layout, shapely.get_coordinates(middle)[0])) is not None:
            rails[at[0]].append(number)
    return rails


def _put(signal, thing: RoadsideObject, s: float, shape, origin: np.ndarray) -> None:
    """Where a signal beyond the end of its lanes' road hangs: it counts for them, but stands elsewhere."""
    place = thing.head - np.array([*origin, 0.0])
    foot = along_plan(shape.plan, np.array([s]))[0][0]
    if np.isfinite(place[2]) and not 0.0 < s < shape.s[-1] and np.hypot(*(place[:2] - foot)) > BEYOND:
        signal.add("positionInertial", x=place[0], y=place[1], z=place[2],
                   hdg=float(np.radians(90.0 - thing.azimuth)))


def _group(road, name: str, wanted: bool):
    """The road's element of that name, a new one in its place in the file's order; None where none is wanted."""
    if not wanted:
        return None
    found = road.find(name)
    if found is not None:
        return found
    added = road.add(name)
    if name == "objects" and road.find("signals") is not None:
        road.remove(added)
        road.insert(list(road).index(road.find("signals")), added)
    return added


def _nearest(shapes: list, layout: RoadLayout, place: np.ndarray) -> tuple[int, float, float] | None:
    """Road beside which a place (2,) lies, chainage and offset, m; roads outside junctions first."""
    found = []
    for number, shape in enumerate(shapes):
        (s,), (t,) = shape.local(place[None])
        beyond = max(-s, s - shape.s[-1], 0.0)
        if beyond < BEYOND and abs(t) < FARTHEST:
            at = float(np.clip(s, 0.0, shape.s[-1]))
            found.append((layout.roads[number].junction >= 0, float(abs(t)), number, at, float(t)))
    return min(found)[2:] if found else None


def _lift(shape, s: float, z: float) -> float:
    """Height over the road, m; 0 where the road has none."""
    lift = z - float(np.interp(s, shape.s, shape.height))
    return lift if np.isfinite(lift) else 0.0


def _known(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _add_post(group, number: int, thing: RoadsideObject, s: float, t: float, shape) -> None:
    radius = _known(thing.diameter / 2.0)
    group.add("object", id=f"object{number}", type="tree" if thing.kind == TREE else "pole", name=thing.kind, s=s, t=t,
              zOffset=_lift(shape, s, thing.foot[2]), height=_known(thing.height), radius=radius)


def _add_rail(group, number: int, rail: np.ndarray, shape, origin: np.ndarray) -> None:
    """A rail as a barrier that goes on without a gap from station to station."""
    s, t = shape.local(rail[:, :2] - origin)
    order = np.argsort(s)
    s, t, foot = np.clip(s[order], 0.0, shape.s[-1]), t[order], rail[order]
    distinct = np.concatenate([[True], np.diff(s) > 0.01])
    s, t, foot = s[distinct], t[distinct], foot[distinct]
    if len(s) < 2:
        return
    height = _known(foot[0, 3])
    lifts = [_lift(shape, at, z) for at, z in zip(s.tolist(), foot[:, 2].tolist())]
    barrier = group.add("object", id=f"rail{number}", type="barrier", subtype="guardRail", name="guard rail",
                        s=float(s[0]), t=float(t[0]), zOffset=lifts[0], height=height)
    for k in range(len(s) - 1):
        barrier.add("repeat", s=float(s[k]), length=float(s[k + 1] - s[k]), tStart=float(t[k]), tEnd=float(t[k + 1]),
                    heightStart=height or 0.0, heightEnd=height or 0.0, zOffsetStart=lifts[k], zOffsetEnd=lifts[k + 1])


def _add_signal(group, built: VectorMap, road: LaneRoad, number: int, at: tuple[float, float], shape,
                stop: int | None) -> None:
    """A board without a type, or a signal for the lanes that end at its stop line."""
    thing = built.objects[number]
    if stop is None:
        width, height, middle = thing.board
        group.add("signal", id=f"sign{number}", name="sign, kind unknown", s=at[0], t=at[1], orientation="none",
                  zOffset=_lift(shape, at[0], middle - height / 2.0), country="OpenDRIVE", type="-1", height=height,
                  width=width)
        return
    places = [place for place, lane in enumerate(road.lanes) if stop in built.lanes[lane].stop_lines]
    signal = group.add("signal", id=f"signal{number}", name="traffic light", dynamic="yes", s=at[0], t=at[1],
                       orientation="+" if road.ahead[places[0]] else "-", zOffset=_lift(shape, at[0], thing.head[2]),
                       country=LIGHT[0], type=LIGHT[1])
    ids = sorted(road.lane_id(place) for place in places)
    signal.add("validity", fromLane=ids[0], toLane=ids[-1])
    signal.add("dependency", id=f"stop{stop}", type="stop line")
