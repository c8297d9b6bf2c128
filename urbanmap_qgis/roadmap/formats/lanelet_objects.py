"""Street objects as elements of a Lanelet2 map: poles, boards, rails, and signals with the stop line they govern.

What a sign says was not read: it is a board without a type, and no rule. Trees have no type in Lanelet2.
"""

from __future__ import annotations

import numpy as np

from ..map_objects import SIGN, TREE, RoadsideObject, signals_of_stop_lines
from ..map_records import VectorMap

HEAD = 0.5
"""m of a signal's arm before its end that is taken for its head."""


def add_objects(elements, built: VectorMap, stops: dict[int, int], lanelets: list[int]) -> None:
    """Add what stands beside the lanes.

    Parameters
    ----------
    elements : of the map under construction.
    stops : ways of the stop lines by their numbers.
    lanelets : ids of the lanes' lanelets.
    """
    for thing in built.objects:
        if thing.kind != TREE:
            _add_pole(elements, thing)
        if thing.kind == SIGN and np.isfinite([*thing.board, thing.azimuth]).all():
            width, height, middle = thing.board
            elements.way(_across(elements, thing.foot[:2], thing.facing, width, middle - height / 2.0),
                         {"type": "traffic_sign", "height": f"{height:.2f}"})
    for rail in built.rails:
        height = {"height": f"{rail[0, 3]:.2f}"} if np.isfinite(rail[0, 3]) else {}
        elements.way([elements.node(place) for place in rail[:, :3]], {"type": "guard_rail", **height})
    for stop, signals in signals_of_stop_lines(built)[0].items():
        if stop not in stops:
            continue
        heads = [_add_head(elements, built.objects[number]) for number in signals]
        before = [lanelets[number] for number, lane in enumerate(built.lanes) if stop in lane.stop_lines]
        elements.rule([*(("way", head, "refers") for head in heads), ("way", stops[stop], "ref_line")],
                      "traffic_light", before)


def _add_pole(elements, thing: RoadsideObject) -> None:
    """A post from its foot to its top, or its foot alone where its height is not known."""
    nodes = [elements.node(thing.foot)]
    if np.isfinite(thing.height):
        nodes.append(elements.node(thing.foot + np.array([0.0, 0.0, thing.height])))
    if len(nodes) > 1:
        elements.way(nodes, {"type": "pole"} | (
            {"width": f"{thing.diameter:.2f}"} if np.isfinite(thing.diameter) else {}))


def _add_head(elements, thing: RoadsideObject) -> int:
    """The end of a signal's arm."""
    inner = thing.head - HEAD * np.array([*thing.facing, 0.0])
    height = {"height": f"{thing.head_height:.2f}"} if np.isfinite(thing.head_height) else {}
    return elements.way([elements.node(inner), elements.node(thing.head)], {"type": "traffic_light", **height})


def _across(elements, place: np.ndarray, facing: np.ndarray, width: float, low: float) -> list[int]:
    """The lower edge of a board, from left to right as who looks at its face sees it."""
    right = np.array([-facing[1], facing[0]])  # seen from the front, which looks against the face's direction
    ends = [place + side * right * width / 2.0 for side in (-1.0, 1.0)]
    return [elements.node(np.array([*end, low])) for end in ends]
