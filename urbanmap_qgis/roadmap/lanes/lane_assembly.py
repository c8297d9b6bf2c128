"""Lanes of a road section with the bounds and nodes that they share."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR, SAME_PLACE
from ...wording import say
from ..map_records import Bound, Finding, MapLane, MapLine, VectorMap
from .lane_strips import Strip, strip_middle
from .road_sections import BoundTrack, RoadSection
from .wrong_side import wrong_side_findings

NEAREST = 0.15
"""Nodes of a bound do not lie nearer than this, m (validators refuse points that fall together)."""

BACK = -0.5
"""Cosine of the turn, 120 degrees, from which on a node of a bound is left out: lines drawn over each other go back."""


def add_section(built: VectorMap, section: RoadSection, strips: Sequence[Strip]) -> None:
    """Put the strips whose direction is known into the map as lanes; the others become findings.

    So does a drive on the other direction's side of the centre line.
    """
    built.findings += wrong_side_findings(section, strips, built.left_hand)
    nodes: dict[tuple[int, float], int] = {}
    bounds: dict[tuple[int, float], int] = {}
    lane_of_strip: dict[int, int] = {}
    for number, strip in enumerate(strips):
        if strip.sign == 0:
            x, y = strip_middle(section, strip)
            built.findings.append(Finding(
                "no lane made", say("A strip of lane width ({width:.1f} m wide, {end:.0f} m long) shows neither "
                                    "drive nor arrow nor a lane line to a lane beside it; no lane was made.",
                                    width=strip.width, end=strip.end - strip.start), x, y))
            continue
        for track in (strip.right, strip.left):
            if (track, strip.start) not in bounds:
                bounds[track, strip.start] = _bound(built, section.tracks[track], strip, track, nodes)
        if strip.wide:
            built.findings.append(Finding("wide lane", say(
                "This lane is {width:.1f} m wide between its line and the edge of the road: it may be two, or have "
                "room to stop beside it.", width=strip.width), *strip_middle(section, strip)))
        lane_of_strip[number] = _lane(built, strip, bounds[strip.right, strip.start], bounds[strip.left, strip.start])
    _relate(built, section, strips, lane_of_strip)


def _bound(built: VectorMap, track: BoundTrack, strip: Strip, number: int, nodes: dict[tuple[int, float], int]) -> int:
    """A new bound: the track between two cross-sections. Nodes at cross-sections are shared."""
    ends = []
    for at in (strip.start, strip.end):
        if (number, at) not in nodes:
            nodes[number, at] = _node(built, track.point(at))
        ends.append(nodes[number, at])
    inner = (track.chainage > strip.start + NEAREST) & (track.chainage < strip.end - NEAREST)
    points = _needed(track, strip, inner)
    middle = [_node(built, point) for point in points]
    line, seen = _main_line(track, strip)
    built.bounds.append(Bound([ends[0], *middle, ends[1]], line.kind, line.colour, line.width, line.sigma, track.double,
                              float(strip.end - strip.start - seen)))
    unseen = strip.end - strip.start - seen
    if unseen > 1.0:
        x, y = track.point((strip.start + strip.end) / 2.0)[:2]
        built.findings.append(Finding("bound not seen", say("The bound is drawn through {unseen:.1f} m without a "
                                                            "line.", unseen=unseen),
                                      float(x), float(y)))
    return len(built.bounds) - 1


def _needed(track: BoundTrack, strip: Strip, inner: np.ndarray) -> np.ndarray:
    """Points (n, 3) of a track within a stretch that its shape needs, and none too near to the last."""
    points = track.points[inner]
    if not len(points):
        return points
    path = np.vstack([track.point(strip.start), points, track.point(strip.end)])
    corners = shapely.get_coordinates(shapely.LineString(path[:, :2]).simplify(0.01))
    rows = [int(np.argmin(np.linalg.norm(path[:, :2] - place, axis=1))) for place in corners[1:-1]]
    # A long straight bound keeps a node each 10 m for its heights.
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path[:, :2], axis=0), axis=1))])
    borders = [0, *rows, len(path) - 1]
    filled = [int(np.argmin(np.abs(at - place))) for a, b in zip(borders[:-1], borders[1:])
              for place in np.arange(at[a] + 10.0, at[b] - 5.0, 10.0)]
    rows = sorted({*rows, *filled} - {0, len(path) - 1})
    spaced: list[int] = []
    for row in rows:
        if at[row] - at[spaced[-1] if spaced else 0] > NEAREST and at[-1] - at[row] > NEAREST:
            spaced.append(row)
    return without_turning_back(path[[0, *spaced, -1]])[1:-1]


def without_turning_back(path: np.ndarray) -> np.ndarray:
    """A path (n, 3) without the inner points at which it turns back on its course in plan."""
    while len(path) > 2:
        steps = np.diff(path[:, :2], axis=0)
        length = np.linalg.norm(steps, axis=1)
        back = np.flatnonzero((steps[1:] * steps[:-1]).sum(axis=1) < BACK * length[1:] * length[:-1])
        if not len(back):
            break
        path = np.delete(path, back[0] + 1, axis=0)
    return path


def _node(built: VectorMap, place: np.ndarray) -> int:
    built.nodes.append(np.asarray(place, float))
    return len(built.nodes) - 1


def _main_line(track: BoundTrack, strip: Strip) -> tuple[MapLine, float]:
    """The line that makes most of a stretch of a track, else the nearest one, and the length that any is seen on it."""
    best, most, seen = track.nearest_line((strip.start + strip.end) / 2.0), 0.0, 0.0
    length: dict[str, float] = {}
    for start, end, line in track.pieces:
        overlap = min(strip.end, end) - max(strip.start, start)
        if line is None or overlap <= 0:
            continue
        seen += overlap
        length[line.kind] = length.get(line.kind, 0.0) + overlap
        if length[line.kind] > most:
            best, most = line, length[line.kind]
    return best, min(seen, strip.end - strip.start)


def _lane(built: VectorMap, strip: Strip, right: int, left: int) -> int:
    """A new lane; one against the axis has its sides exchanged and its bounds reversed."""
    along = strip.sign > 0
    lane = MapLane(left if along else right, right if along else left, along, along, np.zeros((0, 3)), strip.width,
                strip.narrowest, "lane", strip.source, arrows=tuple(sorted(set(strip.arrows))))
    built.lanes.append(lane)
    number = len(built.lanes) - 1
    lane.centre = centre_line(built.coordinates(number, "left"), built.coordinates(number, "right"))
    return number


def centre_line(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Middle (n, 3) between two bounds, taken at equal shares of their lengths."""
    shares = np.unique(np.concatenate([_shares(left), _shares(right)]))
    shares = shares[np.concatenate([[True], np.diff(shares) > 1e-3])]
    shares[-1] = 1.0
    return (_at_shares(left, shares) + _at_shares(right, shares)) / 2.0


def _shares(path: np.ndarray) -> np.ndarray:
    steps = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path[:, :2], axis=0), axis=1))])
    return steps / max(steps[-1], LEAST_DIVISOR)


def _at_shares(path: np.ndarray, shares: np.ndarray) -> np.ndarray:
    at = _shares(path)
    return np.column_stack([np.interp(shares, at, column) for column in path.T])


def _relate(built: VectorMap, section: RoadSection, strips: Sequence[Strip], lane_of_strip: dict[int, int]) -> None:
    """Successors along the section and neighbours across it."""
    for number, lane in lane_of_strip.items():
        strip = strips[number]
        for other_number, other_lane in lane_of_strip.items():
            other = strips[other_number]
            if (other.right, other.left) == (strip.right, strip.left) and other.sign == strip.sign and \
                    abs((other.start - strip.end) if strip.sign > 0 else (other.end - strip.start)) < SAME_PLACE:
                built.lanes[lane].successors.append(other_lane)
            if other.start != strip.start or (strip.left not in (other.right,) and strip.right not in (other.left,)):
                continue
            on_left = (other.right == strip.left) == (strip.sign > 0)
            if other.sign != strip.sign:
                built.lanes[lane].opposite = other_lane
            elif on_left:
                built.lanes[lane].left_neighbour = other_lane
            else:
                built.lanes[lane].right_neighbour = other_lane
