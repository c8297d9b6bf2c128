"""A lane map as ASAM OpenDRIVE 1.7 (ASAM OpenDRIVE 1.7.0, 2021)."""

from __future__ import annotations

import os
import warnings
import xml.etree.ElementTree as ET  # nosec B405 # writes, reads nothing
from dataclasses import dataclass
from typing import cast

import numpy as np
import pyproj
import shapely

from ...errors import InputError
from ...io.files.atomic import written_beside
from ...io.reference.system_parts import plan_part
from ...wording import say
from ..map_objects import signals_of_stop_lines
from ..map_records import Bound, MapArea, VectorMap
from .drive_objects import add_drive_objects
from .opendrive_tags import COLOURS, DriveNode
from .plan_view import CubicPiece, PlanElement, along_plan, fit_plan_view, fit_profile, plan_length
from .road_layout import LaneRoad, RoadLayout, bounds_along_ways, road_layout, with_straight_ends

STATION = 1.0
"""Widths and heights are taken at stations so far apart, m."""

REACH = 60.0
"""Bounds are looked for so far from the reference line, m."""

BOLD = 0.22
"""Wider lines are bold road marks, m."""


@dataclass(frozen=True)
class _Shape:
    """A road's geometry: elements of the plan, stations (n,), and offsets (bounds, n) to the left of the axis, m."""

    plan: list[PlanElement]
    s: np.ndarray
    offsets: np.ndarray
    height: np.ndarray

    def local(self, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Chainage and offset to the left (n,) of places (n, 2)."""
        fine = np.linspace(0.0, self.s[-1], max(int(self.s[-1] / 0.25), 2))
        places, heading = along_plan(self.plan, fine)
        nearest = np.argmin(np.linalg.norm(places[None] - xy[:, None], axis=2), axis=1)
        offset, turn = xy - places[nearest], heading[nearest]
        along = offset[:, 0] * np.cos(turn) + offset[:, 1] * np.sin(turn)
        return fine[nearest] + along, offset[:, 1] * np.cos(turn) - offset[:, 0] * np.sin(turn)


def opendrive_tree(built: VectorMap, crs_wkt: str,
                   speed_limit: float | None = None) -> tuple[ET.ElementTree, list[str]]:
    """A lane map as OpenDRIVE elements, and a sentence for each connection of lanes that OpenDRIVE has no room for.

    Coordinates are those of the CRS less the header's offset, in m. Heights that are not known are left out.

    Parameters
    ----------
    speed_limit : km/h, for lanes that have none of their own.

    Raises
    ------
    InputError : the CRS cannot be written as a PROJ string.
    """
    built = bounds_along_ways(built)
    layout = road_layout(built)
    built = with_straight_ends(built, layout)
    nodes = np.array(built.nodes)
    origin = np.floor(nodes[:, :2].min(axis=0) / 100.0) * 100.0
    root = DriveNode(("OpenDRIVE",), {})
    _add_header(root, crs_wkt, origin, nodes[:, :2] - origin)
    shapes = [_shape(built, road, origin) for road in layout.roads]
    things = _things_by_road(built, layout)
    roads = []
    for number, (road, shape) in enumerate(zip(layout.roads, shapes)):
        element = _add_road(root, built, layout, number, shape, speed_limit)
        roads.append(element)
        _add_crosswalks(element, built, shape, [thing for kind, thing in things[number] if kind == "crosswalk"], origin)
        _add_stop_lines(element, built, road, shape, [thing for kind, thing in things[number] if kind == "stop"],
                        origin)
    beside = add_drive_objects(roads, built, layout, shapes, origin)
    _add_references(roads, built, layout, shapes, origin)
    for number in range(len(layout.junctions)):
        _add_junction(root, built, layout, number)
    notes = [say("{number} objects stand beside no road of the map: they are missing in the OpenDRIVE file.",
                 number=beside)] if beside else []
    return ET.ElementTree(root), notes + [
        say("Lane {one} leads to lane {other}, but OpenDRIVE knows one road or junction at the end of a road: the "
            "connection is missing in the OpenDRIVE file.", one=one, other=other) for one, other in layout.untold]


def write_opendrive(path: str | os.PathLike, tree: ET.ElementTree) -> None:
    """Write an OpenDRIVE file; it appears at `path` when it is whole."""
    ET.indent(tree)
    with written_beside(path) as temporary:
        tree.write(temporary, encoding="utf-8", xml_declaration=True)


def _proj_string(crs_wkt: str) -> str:
    """A CRS as a PROJ string, which holds less: the format asks for it; "" where it cannot be written as one."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return plan_part(pyproj.CRS.from_wkt(crs_wkt)).to_proj4()
        except pyproj.exceptions.ProjError:  # older ones give ""
            return ""


def _add_header(root: DriveNode, crs_wkt: str, origin: np.ndarray, local: np.ndarray) -> None:
    reference = _proj_string(crs_wkt)
    if not reference:
        raise InputError(say("The lines' CRS cannot be written as a PROJ string, which OpenDRIVE needs: assign a "
                             "projected CRS known to PROJ."))
    low, high = local.min(axis=0), local.max(axis=0)
    header = root.add("header", north=high[1], south=low[1],
                      east=high[0], west=low[0])
    header.add("geoReference").text = reference
    header.add("offset", x=origin[0], y=origin[1])


def _shape(built: VectorMap, road: LaneRoad, origin: np.ndarray) -> _Shape:
    """Plan of the reference line, and where its cross-sections meet the bounds."""
    paths = [built.bound_points(built.bounds[bound]) - [*origin, 0.0] for bound in road.bounds]
    axis = paths[road.axis]
    sections = [paths[-1][tip, :2] - paths[0][tip, :2] for tip in (0, -1)]
    # Roads that meet have one cross-section there: with it at right angles to both, their lanes meet without a gap.
    plan = fit_plan_view(axis[:, :2], ends=tuple(np.array([across[1], -across[0]]) / np.linalg.norm(across)
                                                 for across in sections))
    length = plan_length(plan)
    s = np.linspace(0.0, length, max(int(np.ceil(length / STATION)) + 1, 2))
    places, heading = along_plan(plan, s)
    normal = np.column_stack([-np.sin(heading), np.cos(heading)])
    cuts = shapely.linestrings(np.stack([places - REACH * normal, places + REACH * normal], axis=1))
    offsets = np.zeros((len(paths), len(s)))
    for number, path in enumerate(paths):
        if number != road.axis:
            offsets[number] = _met(path[:, :2], places, normal, cuts, s)
            offsets[number, [0, -1]] = [(path[tip, :2] - places[tip]) @ normal[tip] for tip in (0, -1)]
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(axis[:, :2], axis=0), axis=1))])
    return _Shape(plan, s, offsets, np.interp(s / length, at / at[-1], axis[:, 2]))


def _met(path: np.ndarray, places: np.ndarray, normal: np.ndarray, cuts: np.ndarray, s: np.ndarray) -> np.ndarray:
    """Offsets (n,) at which cross-sections meet a bound, which goes straight on beyond its ends."""
    tips = [path[0] + (path[0] - path[1]) / np.linalg.norm(path[0] - path[1]) * 5.0,
            path[-1] + (path[-1] - path[-2]) / np.linalg.norm(path[-1] - path[-2]) * 5.0]
    line = shapely.LineString(np.vstack([tips[0], path, tips[1]]))
    met = shapely.intersection(cuts, line)
    offsets, last = np.full(len(s), np.nan), float((path[0] - places[0]) @ normal[0])
    for k, shape in enumerate(met):
        points = shapely.get_coordinates(shape)
        if len(points):
            across = (points - places[k]) @ normal[k]
            last = offsets[k] = across[np.argmin(np.abs(across - last))]
    known = np.isfinite(offsets)
    if not known.any():
        return np.interp(s, s[[0, -1]], [(path[0] - places[0]) @ normal[0], (path[-1] - places[-1]) @ normal[-1]])
    return np.interp(s, s[known], offsets[known])


def _add_road(root: DriveNode, built: VectorMap, layout: RoadLayout, number: int, shape: _Shape,
              speed_limit: float | None) -> DriveNode:
    road = layout.roads[number]
    element = root.add("road", length=shape.s[-1], id=number + 1, junction=_junction_id(road.junction),
                       rule="LHT" if built.left_hand is not False else "RHT")
    link = element.add("link")
    for name, end in (("predecessor", road.before), ("successor", road.behind)):
        if end is not None:
            at = None if end[0] == "junction" else _contact(built, layout, number, end[1], name == "predecessor")
            link.add(name, elementType=end[0], elementId=_junction_id(end[1]) if at is None else end[1] + 1,
                     contactPoint=at)
    _add_type(element, [built.lanes[lane].speed_limit for lane in road.lanes], speed_limit)
    plan = element.add("planView")
    for one in shape.plan:
        geometry = plan.add("geometry", s=one.s, x=one.x, y=one.y, hdg=one.heading, length=one.length)
        if one.kind == "cubic":
            (au, bu, cu, du), (av, bv, cv, dv) = one.u, one.v
            geometry.add("paramPoly3", aU=au, bU=bu, cU=cu, dU=du, aV=av, bV=bv, cV=cv, dV=dv)
        else:
            geometry.add(one.kind, **({"curvature": one.curvature} if one.kind == "arc" else {}))
    if np.isfinite(shape.height).all():
        profile = element.add("elevationProfile")
        for piece in fit_profile(shape.s, shape.height):
            _add_cubic(profile, "elevation", "s", piece)
    _add_lanes(element, built, layout, number, shape, speed_limit)
    return element


def _add_type(element: DriveNode, limits: list[float], speed_limit: float | None) -> None:
    """The road's type with the highest limit of its lanes, where one is known."""
    kind = element.add("type")
    known = [limit for limit in limits if np.isfinite(limit)] or ([speed_limit] if speed_limit is not None else [])
    if known:
        kind.add("speed", max=max(known))


def _junction_id(number: int) -> int:
    """Junctions are numbered beside the roads, from 100000 on; -1 is none."""
    return -1 if number < 0 else 100000 + number


def _contact(built: VectorMap, layout: RoadLayout, number: int, other: int, begin: bool) -> str:
    """At which of its ends another road touches the begin (or end) of this one."""
    for place, lane in enumerate(layout.roads[number].lanes):
        into = layout.roads[number].ahead[place] == begin  # what touches there leads into the lane, or out of it
        met = ([k for k, one in enumerate(built.lanes) if lane in one.successors] if into
               else built.lanes[lane].successors)
        for one in met:
            road, at = layout.of_lane[one]
            if road == other:
                return "end" if layout.roads[road].ahead[at] == into else "start"
    return "start"


def _add_cubic(parent: DriveNode, name: str, at: str, piece: CubicPiece) -> None:
    parent.add(name, **{at: piece.s}, a=piece.a, b=piece.b, c=piece.c, d=piece.d)


def _add_lanes(element: DriveNode, built: VectorMap, layout: RoadLayout, number: int, shape: _Shape,
               speed_limit: float | None) -> None:
    road = layout.roads[number]
    section = element.add("lanes").add("laneSection")
    places = range(len(road.lanes))
    for name, members in (("left", [place for place in places if road.lane_id(place) > 0][::-1]), ("center", None),
                          ("right", [place for place in places if road.lane_id(place) < 0][::-1])):
        if members is None:
            middle = section.add("center").add("lane", id=0, type="none")
            _add_mark(middle, built.bounds[road.bounds[road.axis]])
        elif members:
            side = section.add(name)
            for place in members:
                _add_lane(side, built, layout, number, place, shape, speed_limit)


def _add_lane(side: DriveNode, built: VectorMap, layout: RoadLayout, number: int, place: int, shape: _Shape,
              speed_limit: float | None) -> None:
    road = layout.roads[number]
    lane = built.lanes[road.lanes[place]]
    identifier = road.lane_id(place)
    element = side.add("lane", id=identifier, type="driving")
    link = element.add("link")
    into = [k for k, one in enumerate(built.lanes) if road.lanes[place] in one.successors]
    before, behind = (into, lane.successors) if road.ahead[place] else (lane.successors, into)
    for name, end, met in (("predecessor", road.before, before), ("successor", road.behind, behind)):
        for one in met:
            other, at = layout.of_lane[one]
            if end == ("road", other):
                link.add(name, id=layout.roads[other].lane_id(at))
    width = np.maximum(shape.offsets[place + 1] - shape.offsets[place], 0.0)
    for piece in fit_profile(shape.s, width):
        _add_cubic(element, "width", "sOffset", piece)
    _add_mark(element, built.bounds[road.bounds[place + 1 if identifier > 0 else place]])
    limit = lane.speed_limit if np.isfinite(lane.speed_limit) else speed_limit
    if limit is not None:
        element.add("speed", max=limit)


def _add_mark(lane: DriveNode, bound: Bound) -> None:
    """The road mark of a bound; border and virtual bounds have no paint."""
    if bound.kind not in ("solid", "dashed"):
        lane.add("roadMark", type="edge" if bound.kind == "road border" else "none")
        return
    kind = "solid" if bound.kind == "solid" else "broken"
    lane.add("roadMark", type=f"{kind} {kind}" if bound.double else kind,
             weight="bold" if bound.width > BOLD else "standard",
             color=bound.colour if bound.colour in COLOURS else None,
         width=bound.width if np.isfinite(bound.width) else None, laneChange="none" if kind == "solid" else "both")


def _things_by_road(built: VectorMap, layout: RoadLayout) -> list[list[tuple[str, int]]]:
    """Crosswalks and stop lines of each road; each stands in the first road that it crosses."""
    things: list[list[tuple[str, int]]] = [[] for _ in layout.roads]
    placed: set[tuple[str, int]] = set()
    for number, road in enumerate(layout.roads):
        for lane in road.lanes:
            for one in (*(("stop", stop) for stop in built.lanes[lane].stop_lines),
                        *(("crosswalk", walk) for walk in built.lanes[lane].crosswalks)):
                if one not in placed:
                    placed.add(one)
                    things[number].append(one)
    return things


def _add_crosswalks(element: DriveNode, built: VectorMap, shape: _Shape, walks: list[int], origin) -> None:
    if not walks:
        return
    objects = element.add("objects")
    for walk in walks:
        area: MapArea = built.crosswalks[walk]
        ring = shapely.get_coordinates(area.polygon.exterior, include_z=True)[:-1] - [*origin, 0.0]
        middle = ring[:, :2].mean(axis=0)
        (s,), (t,) = shape.local(middle[None])
        s = float(np.clip(s, 0.0, shape.s[-1]))
        (foot,), (heading,) = along_plan(shape.plan, np.array([s]))
        frame = np.array([[np.cos(heading), np.sin(heading)], [-np.sin(heading), np.cos(heading)]])
        base = foot + frame[1] * t
        corners = (ring[:, :2] - base) @ frame.T
        extent = np.ptp(corners, axis=0)
        crosswalk = objects.add("object", id=f"crosswalk{walk}", s=s, t=t, length=extent[0], width=extent[1])
        outline = crosswalk.add("outlines").add("outline")
        for number, (u, v) in enumerate(corners):
            outline.add("cornerLocal", u=u, v=v, id=number)


def _add_stop_lines(element: DriveNode, built: VectorMap, road: LaneRoad, shape: _Shape, stops: list[int],
                    origin) -> None:
    if not stops:
        return
    signals = element.add("signals")
    for stop in stops:
        line = built.stop_lines[stop][:, :2] - origin
        s, t = shape.local(line)
        orientation, ids = _validity(built, road, stop)
        signal = signals.add("signal", s=float(np.clip(s.mean(), 0.0, shape.s[-1])), t=float(t.mean()),
                             id=f"stop{stop}", orientation=orientation, width=float(np.linalg.norm(line[-1] - line[0])))
        signal.add("validity", fromLane=ids[0], toLane=ids[-1])


def _validity(built: VectorMap, road: LaneRoad, stop: int) -> tuple[str, list[int]]:
    """For which direction of a road and which of its lanes, by id, a stop line holds; no lane where for none."""
    places = [place for place, lane in enumerate(road.lanes) if stop in built.lanes[lane].stop_lines]
    return ("+" if places and road.ahead[places[0]] else "-"), sorted(road.lane_id(place) for place in places)


def _add_references(roads: list[DriveNode], built: VectorMap, layout: RoadLayout, shapes: list[_Shape],
                    origin: np.ndarray) -> None:
    """Stop lines and traffic lights that hold for lanes of several roads: each is one signal, in its first road."""
    lights = signals_of_stop_lines(built)[0]
    for stop, line in enumerate(built.stop_lines):
        held = [number for number, road in enumerate(layout.roads) if _validity(built, road, stop)[1]]
        for number in held[1:]:
            orientation, ids = _validity(built, layout.roads[number], stop)
            found = cast("DriveNode | None", roads[number].find("signals"))
            group = roads[number].add("signals") if found is None else found
            places = {f"stop{stop}": line[:, :2].mean(axis=0),
                      **{f"signal{light}": built.objects[light].head[:2] for light in lights.get(stop, ())}}
            for name, place in places.items():
                (s,), (t,) = shapes[number].local(place[None] - origin)
                reference = group.add("signalReference", s=float(np.clip(s, 0.0, shapes[number].s[-1])), t=float(t),
                                      id=name, orientation=orientation)
                reference.add("validity", fromLane=ids[0], toLane=ids[-1])


def _add_junction(root: DriveNode, built: VectorMap, layout: RoadLayout, number: int) -> None:
    """One connection for each connecting road, which leads from one lane to one lane."""
    junction = root.add("junction", id=_junction_id(number))
    for count, road in enumerate(layout.junctions[number]):
        (lane,) = layout.roads[road].lanes
        for before in (k for k, one in enumerate(built.lanes) if lane in one.successors):
            incoming, place = layout.of_lane[before]
            connection = junction.add("connection", id=count, incomingRoad=incoming + 1, connectingRoad=road + 1)
            connection.add("laneLink", from_=layout.roads[incoming].lane_id(place),
                           to=layout.roads[road].lane_id(0))
