"""Who yields where ways cross in a junction: by turns, stop lines, the number of lanes, and the side one comes from.

Japan's Road Traffic Act, articles 36 and 37: who turns across the oncoming traffic lets it pass; a priority road or a
clearly wider one comes first; between equal roads who comes from the left (where traffic keeps to the right: from the
right). Signs and lights are not in the markings, so all of it is inferred.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from ...wording import mark
from ..map_records import VectorMap


@dataclass(frozen=True)
class RightOfWayLimits:
    """Limits of the decision, each with its unit."""

    # Ways that have this share of either's area in common meet; less is a touch of their borders.
    common: float = 0.10
    touch: float = 1e-4
    opposite: float = -0.7  # Cosine between directions that are opposite.
    wider: float = 1.5  # A road is clearly wider from this ratio of the widths of its lanes on.


LIMITS = RightOfWayLimits()

ACROSS, STOP_LINE, LANES, WIDTH, SIDE = (
    mark("turns across the oncoming traffic"), mark("stop line"), mark("fewer lanes"), mark("narrower road"),
    mark("side it comes from"))
"""Why a way yields."""


@dataclass(frozen=True)
class _Way:
    """A way through a junction.

    Attributes
    ----------
    source : lane that it comes from.
    turn : "straight", "left" or "right".
    course : unit direction (2,) in which it begins.
    area : what it covers.
    """

    source: int
    turn: str
    course: np.ndarray
    area: shapely.Polygon


@dataclass(frozen=True)
class _Road:
    """The approaches of a junction that lie along one axis: number and width (m) of the lanes of the larger one,
    whether both are in the map and how many have a stop line."""

    lanes: int
    width: float
    approaches: int
    stop_lines: int


def rights_of_way(built: VectorMap, numbers: Sequence[int]) -> dict[tuple[int, int], str]:
    """Pairs (who yields, to whom) of the virtual lanes `numbers` of one junction with the reason; pairs that nothing
    decides are not among them."""
    sources = {way: number for number, lane in enumerate(built.lanes) for way in lane.successors}
    ways = {number: _Way(sources.get(number, -1), built.lanes[number].turn, _heading(built.lanes[number].centre),
                         built.area(number)) for number in numbers}
    roads = _roads(built, ways)
    decided = {}
    for one, other in _meeting(ways):
        last, reason = _decision(ways, roads, one, other, built.left_hand is not False)
        if reason:
            decided[last, other if last == one else one] = reason
    return decided


def complete_rights(built: VectorMap, numbers: Sequence[int],
                    decided: dict[tuple[int, int], str]) -> dict[int, list[int]]:
    """Lanes that yield, by the lane that has the way before all that it meets; one that waits for somebody has none."""
    ways = [number for number, lane in enumerate(built.lanes) if lane.kind == "virtual"]
    areas, begins = {way: built.area(way) for way in ways}, {way: _begin(built, way) for way in ways}
    found = {}
    for one in numbers:
        yielding = [other for other in numbers if (other, one) in decided]
        # Also those that no area covers: nothing is decided for them.
        meets = [other for other in ways if begins[other] != begins[one]
                 and _common(areas[one], areas[other]) > LIMITS.common]
        if yielding and all((other, one) in decided for other in meets) and not any(
                (one, other) in decided for other in numbers):
            found[one] = yielding
    return found


def _meeting(ways: dict[int, _Way]) -> list[tuple[int, int]]:
    """Pairs of ways from different lanes that have an area in common."""
    numbers = list(ways)
    first, second = shapely.STRtree([ways[number].area for number in numbers]).query(
        [ways[number].area for number in numbers], predicate="intersects")
    pairs = [(numbers[a], numbers[b]) for a, b in zip(first.tolist(), second.tolist()) if a < b]
    return [(one, other) for one, other in pairs if ways[one].source != ways[other].source
            and _common(ways[one].area, ways[other].area) > LIMITS.touch]


def _common(one: shapely.Polygon, other: shapely.Polygon) -> float:
    """Share of the smaller area that two have in common."""
    return one.intersection(other).area / max(min(one.area, other.area), LEAST_DIVISOR)


def _begin(built: VectorMap, number: int) -> tuple[int, int]:
    """Nodes at which a lane begins."""
    lane = built.lanes[number]
    left, right = built.bounds[lane.left].nodes, built.bounds[lane.right].nodes
    return left[0 if lane.left_forward else -1], right[0 if lane.right_forward else -1]


def _decision(ways: dict[int, _Way], roads: dict[int, _Road], one: int, other: int,
              left_hand: bool) -> tuple[int, str]:
    """Which of two ways yields, and why; "" where nothing decides."""
    first, second = ways[one], ways[other]
    across = "right" if left_hand else "left"
    along = float(first.course @ second.course)
    if along < LIMITS.opposite:
        if (first.turn == across) == (second.turn == across):
            return one, ""
        return (one if first.turn == across else other), ACROSS
    if along > -LIMITS.opposite:
        return one, ""  # side by side: the lanes' own bound tells
    reason = _minor(roads[one], roads[other])
    if reason:
        return one, reason
    reason = _minor(roads[other], roads[one])
    if reason:
        return other, reason
    # Who comes from the left heads to the right of the other's course.
    from_left = first.course[0] * second.course[1] - first.course[1] * second.course[0] < 0.0
    return (one if from_left == left_hand else other), SIDE


def _minor(one: _Road, other: _Road) -> str:
    """Why a road has to wait for another; "" where it does not by what is known of them."""
    # One arm alone may have lost its line to wear: the other road must lack it on both.
    if one.stop_lines == one.approaches and other.approaches == 2 and not other.stop_lines:
        return STOP_LINE
    if other.stop_lines == other.approaches and one.approaches == 2 and not one.stop_lines:
        return ""
    if one.lanes != other.lanes:
        return LANES if one.lanes < other.lanes else ""
    return WIDTH if other.width > LIMITS.wider * one.width else ""


def _roads(built: VectorMap, ways: dict[int, _Way]) -> dict[int, _Road]:
    """The road that each way comes from: its own approach with the one on the other side of the junction."""
    approaches = {number: _approach(built, way.source) for number, way in ways.items()}
    roads = {}
    for number, way in ways.items():
        along = {approaches[other] for other, one in ways.items() if abs(way.course @ one.course) > -LIMITS.opposite}
        lanes = max(len(row) for row in along)
        width = max(sum(built.lanes[lane].width for lane in row) for row in along)
        lined = sum(any(built.lanes[lane].stop_lines for lane in row) for row in along)
        roads[number] = _Road(lanes, width, len(along), lined)
    return roads


def _approach(built: VectorMap, lane: int) -> tuple[int, ...]:
    """Lanes side by side of one direction, a lane's own among them."""
    row = [lane] if lane >= 0 else []
    for side in ("left_neighbour", "right_neighbour"):
        beside = getattr(built.lanes[lane], side) if row else -1
        while beside >= 0 and beside not in row:
            row.append(beside)
            beside = getattr(built.lanes[beside], side)
    return tuple(sorted(row))


def _heading(centre: np.ndarray) -> np.ndarray:
    """Unit direction (2,) in which a lane begins."""
    step = centre[1, :2] - centre[0, :2]
    return step / max(np.linalg.norm(step), LEAST_DIVISOR)
