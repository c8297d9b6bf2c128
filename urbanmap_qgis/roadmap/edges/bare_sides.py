"""Stretches of a drive beside which no kerb was found: where a kerb may be too low to be seen."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from .edge_records import KERB, LOWERED, RoadEdge

STATION = 1.0
"""Distance of the places along the path at which kerbs are looked for, m."""


def bare_sides(edges: Sequence[RoadEdge], path: np.ndarray, width: float) -> tuple[float, float]:
    """Lengths (left, right) of a path (n, 2 or 3), m, beside which no kerb lies within `width` m."""
    line = shapely.LineString(path[:, :2])
    at = np.arange(STATION / 2.0, line.length, STATION)
    if not len(at):
        return 0.0, 0.0
    places, ahead = (shapely.get_coordinates(shapely.line_interpolate_point(line, chainage))
                     for chainage in (at, np.minimum(at + STATION / 2.0, line.length)))
    behind = shapely.get_coordinates(shapely.line_interpolate_point(line, at - STATION / 2.0))
    along = ahead - behind
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), LEAST_DIVISOR)
    left = width * np.column_stack([-along[:, 1], along[:, 0]])
    kerbs = shapely.STRtree([shapely.LineString(edge.foot[:, :2]) for edge in edges if edge.kind in (KERB, LOWERED)])
    bare = []
    for side in (left, -left):
        across = shapely.linestrings(np.stack([places, places + side], axis=1))
        met = np.unique(kerbs.query(across, predicate="intersects")[0])
        bare.append(line.length * (1.0 - len(met) / len(at)))
    return bare[0], bare[1]
