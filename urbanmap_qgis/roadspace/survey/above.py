"""Roads above roads: edges that cross in plan with a height between them that no kerb has."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ...wording import say
from ..road_records import RoadFinding
from .area_records import EdgeLine

HEIGHT = 2.0  # m between edges that cross; ramps and walls beside roads stay below where kerbs meet
PLACE = 15.0  # m: crossings nearer to each other are one place, the four of two roads among them


def roads_above(edges: Sequence[EdgeLine]) -> list[RoadFinding]:
    """A finding for each place at which edges run above other ones."""
    lines = np.array([shapely.linestrings(edge.foot) for edge in edges], dtype=object)
    found: list[tuple[float, float, float]] = []
    for one, other in zip(*(side.tolist() for side in shapely.STRtree(lines).query(lines, predicate="crosses"))):
        if one >= other:
            continue
        for point in shapely.get_parts(shapely.intersection(*shapely.force_2d(lines[[one, other]]))):
            place = shapely.centroid(point)
            height = float(np.abs(np.diff([_height(lines[number], place) for number in (one, other)])).item())
            if height > HEIGHT:
                found.append((*shapely.get_coordinates(place)[0].tolist(), height))
    places: list[tuple[float, float, float]] = []
    for x, y, height in sorted(found):
        if all(np.hypot(x - a, y - b) > PLACE for a, b, _ in places):
            places.append((x, y, height))
    return [RoadFinding("road above a road", say(
        "Edges cross here with {height:.1f} m between them: one road runs above another, and the surfaces here are a "
        "mixture of both. Give the edges of each road in a run of its own.", height=height), x, y)
        for x, y, height in places]


def _height(line: shapely.LineString, place: shapely.Point) -> float:
    """Height of a line above a place on it, m; NaN where it has none."""
    return float(shapely.get_z(shapely.line_interpolate_point(line, shapely.line_locate_point(line, place))))
