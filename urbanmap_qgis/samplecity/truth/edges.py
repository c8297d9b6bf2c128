"""The true edges of the roads: kerbs with their heights, and rails."""

from __future__ import annotations

import numpy as np
import shapely

from ..scene.ground import KERB_HEIGHT, KERB_RADIUS
from ..scene.model import FaceKind
from ..scene.world import Scene
from .geopackage import Layer

BESIDE = 1e-3  # Heights of foot and top are taken so far before and behind the kerb line, m.
PIECE = 0.5  # Length of the pieces into which kerbs are cut, m.
BEYOND = 30.0  # m beyond the city's square
# m; no other furniture is so narrow and long
RAIL_WIDTH = 0.1
RAIL_LENGTH = 3.0
LOW = 0.6  # of the full height; below it a kerb counts as lowered


def true_kerbs(scene: Scene) -> Layer:
    """Kerb lines in pieces of half a metre: foot lines with the height of the step (m) and whether it is lowered."""
    ground = scene.ground
    reach = scene.size / 2 + BEYOND
    bands = [shapely.box(-2 * reach, s.at - s.half_width, 2 * reach, s.at + s.half_width) if s.along == "u"
             else shapely.box(s.at - s.half_width, -2 * reach, s.at + s.half_width, 2 * reach) for s in ground.streets]
    streets = shapely.union_all(bands).buffer(KERB_RADIUS, quad_segs=64).buffer(-KERB_RADIUS, quad_segs=64)
    lines = shapely.get_parts(shapely.line_merge(streets.boundary & shapely.box(-reach, -reach, reach, reach)))
    lines = [*lines, *(island.exterior for island in ground.islands)]
    plans, heights = [], []
    for line in lines:
        marks = np.linspace(0.0, line.length, max(int(np.ceil(line.length / PIECE)), 1) + 1)
        places = shapely.get_coordinates(shapely.line_interpolate_point(line, marks))
        direction = np.gradient(places, axis=0)
        normal = np.column_stack([-direction[:, 1], direction[:, 0]]) / np.hypot(*direction.T)[:, None]
        inside = [ground.height(*ground.to_world(*(places + side * BESIDE * normal).T)) for side in (1, -1)]
        foot, top = np.minimum(*inside), np.maximum(*inside)
        points = np.column_stack([*ground.to_world(*places.T), foot])
        plans += list(shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1)))
        heights.append((0.5 * (top - foot))[:-1] + (0.5 * (top - foot))[1:])
    height = np.concatenate(heights)
    return Layer("kerbs", plans, {"height": height.round(5),
                                  "lowered": (height < LOW * KERB_HEIGHT).astype(int)})


def true_rails(scene: Scene) -> Layer:
    """Middle lines of the guard rails at their foot, with their height (m)."""
    plans, heights = [], []
    for thing in scene.furniture:
        corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(thing.plan))
        sides = np.hypot(*np.diff(corners[:4], axis=0).T)
        narrow = min(sides[:2]) <= RAIL_WIDTH and max(sides[:2]) >= RAIL_LENGTH
        if not narrow or thing.kind == FaceKind.FRONT:
            continue
        first = 0 if sides[0] < sides[1] else 1
        ends = np.array([corners[first:first + 2].mean(axis=0), corners[first + 2:first + 4].mean(axis=0)])
        foot = scene.ground_height(*ends.T)
        plans.append(shapely.linestrings(np.column_stack([ends, foot])))
        heights.append(float(thing.z_high - foot.mean()))
    return Layer("rails", plans, {"height": heights})
