"""The true lanes of the avenue and the street, between the lines where traffic stops."""

from __future__ import annotations

import numpy as np
import shapely

from ..scene.markings import STOP
from ..scene.streets import BEYOND
from ..scene.world import Scene
from .geopackage import Layer

EDGE = 0.25
"""The edge line lies so far outside the outermost lane, m."""

SHORTEST = 5.0
"""Lanes between two crossings that leave less are not given, m."""


def true_lanes(scene: Scene) -> Layer:
    """Middle lines of the marked lanes in the direction of traffic, at the ground's height.

    `left` and `right` are the distances to the lines on both sides, m. Side streets have no centre line and are left
    out. `driven` tells the roads (between two crossings) on which a survey drives.
    """
    rows, plans = [], []
    streets = {street.name: street for street in scene.ground.streets if street.name in ("A", "B")}
    for lane in scene.lanes:
        street = streets.get(lane.street)
        if street is None:
            continue
        (u, v) = scene.ground.to_local(*np.array([lane.start, lane.end]).T)
        along, across = (u, v[0]) if street.along == "u" else (v, u[0])
        sign = np.sign(along[1] - along[0])
        outermost = abs(across - street.at) > (street.lanes - 1) * street.lane_width
        for first, last in _between_crossings(scene, street):
            ends = np.array([first, last])[:: int(sign)]
            place = (ends, np.full(2, across)) if street.along == "u" else (np.full(2, across), ends)
            x, y = scene.ground.to_world(*place)
            plans.append(shapely.linestrings(np.column_stack([x, y, scene.ground_height(x, y)])))
            half = lane.width / 2.0
            rows.append((lane.street, half + EDGE * outermost, half, int(_is_driven(scene, x, y))))
    return Layer("lanes", plans, dict(zip(("street", "left", "right", "driven"), zip(*rows))))


def _between_crossings(scene: Scene, street) -> list[tuple[float, float]]:
    """Begins and ends along a street of the stretches between the stop lines of its crossings, m."""
    reach = scene.size / 2 + BEYOND
    crossings = sorted((other for other in scene.ground.streets if other.along != street.along), key=lambda s: s.at)
    edges = [-reach, *(edge for other in crossings
                       for edge in (other.at - other.half_width - STOP, other.at + other.half_width + STOP)), reach]
    return [(a, b) for a, b in zip(edges[::2], edges[1::2]) if b - a >= SHORTEST]


def _is_driven(scene: Scene, x: np.ndarray, y: np.ndarray) -> bool:
    """Whether a lane's stretch lies on one of the two roads that the surveys drive: the west of A, the north of B."""
    u, v = scene.ground.to_local(np.mean(x), np.mean(y))
    return bool((u < 0.0 and abs(v) < 10.0) or (v > 0.0 and abs(u) < 10.0))
