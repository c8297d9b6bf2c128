"""Edges that may be none: rails and walls that may be the sides of vehicles, as on a road with kerbs they stand before
the kerb; short kerbs lower than the steps that the survey shows."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...wording import say
from .edge_records import DOUBTFUL, KERB, LOWERED, MEASURED, RAIL, WALL, RoadEdge

TALLEST_VEHICLE = 4.2  # m; higher walls are none.
KERBED = 0.5  # m of kerb for each m of path from which a road is one with kerbs.
# m
CAR_HEIGHT = 1.7
CAR_LENGTH = 6.5
RIGHT_AT = 0.3  # m; a rail may stand on the kerb itself
LOW_LENGTH = 10.0  # m; scatter along one line of the scanner makes lower steps, but no longer ones

_BEFORE = 0.5  # share of an edge's stations


def with_doubts(edges: list[RoadEdge], path: np.ndarray, path_length: float) -> list[RoadEdge]:
    """The edges, rails and walls that may be vehicles called doubtful.

    Parameters
    ----------
    path : (k, 2) places of the vehicle, m, in the coordinates of the edges.
    """
    kerbs = _kerbs(edges)
    if not len(kerbs) or shapely.length(kerbs).sum() < KERBED * path_length:
        return edges
    tree, places = shapely.STRtree(kerbs), cKDTree(path)
    return [_judged(edge, tree, path[places.query(edge.foot[:, :2])[1]])
            if edge.kind in (RAIL, WALL) and edge.status == MEASURED and edge.height < TALLEST_VEHICLE else edge
            for edge in edges]


def with_low_doubts(edges: list[RoadEdge], least_step: float) -> list[RoadEdge]:
    """The edges, kerbs called doubtful whose step the survey does not show surely and that are short.

    Parameters
    ----------
    least_step : m, the lowest step that shows; NaN where that is not known.
    """
    highest: dict[int, float] = defaultdict(float)
    lengths: dict[int, float] = defaultdict(float)
    for edge in edges:
        if edge.kind in (KERB, LOWERED):
            highest[edge.chain] = max(highest[edge.chain], edge.height)
            lengths[edge.chain] += edge.length
    reason = say("it is short and lower than the steps that show surely in this survey")
    return [replace(edge, status=DOUBTFUL, reason=reason)
            if edge.kind in (KERB, LOWERED) and edge.status == MEASURED and highest[edge.chain] < least_step
            and lengths[edge.chain] < LOW_LENGTH else edge for edge in edges]


def _kerbs(edges: list[RoadEdge]) -> np.ndarray:
    """Lines of kerbs and, across what hides them, between the parts of one chain."""
    some = [edge for edge in edges if edge.kind in (KERB, LOWERED)]
    gaps = [(edge.foot[-1, :2], following.foot[0, :2]) for edge, following in zip(some, some[1:])
            if edge.chain == following.chain and edge.gap > 0]
    return np.array([*(shapely.linestrings(edge.foot[:, :2]) for edge in some),
                     *(shapely.linestrings(np.array(gap)) for gap in gaps)], dtype=object)


def _judged(edge: RoadEdge, kerbs: shapely.STRtree, path: np.ndarray) -> RoadEdge:
    """The edge, doubtful where no kerb lies between it and its places (n, 2) on the path."""
    ways = shapely.linestrings(np.stack([edge.foot[:, :2], path], axis=1))
    behind = np.zeros(len(ways), bool)
    behind[kerbs.query(ways, predicate="dwithin", distance=RIGHT_AT)[0]] = True
    if np.mean(~behind) > _BEFORE:
        return replace(edge, status=DOUBTFUL, reason=say("no kerb lies before it: it may be the side of a vehicle"))
    if edge.kind == WALL and edge.height < CAR_HEIGHT and edge.length < CAR_LENGTH:
        return replace(edge, status=DOUBTFUL, reason=say("it is as long and high as a car"))
    return edge
