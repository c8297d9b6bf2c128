"""Walls that buildings share: where outer walls of two buildings stand against each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ..geometry.solid import OUTER_WALL, Solid
from ..geometry.tolerances import SAME_PLACE

REACH = 0.15
"""Distance (m) across up to which walls of two buildings stand against each other."""

PARALLEL = np.cos(np.radians(5.0))


def party_wall_areas(buildings: Sequence[Sequence[Solid]]) -> np.ndarray:
    """Area (n,) of the outer walls of each building that stand against another building's walls, m2."""
    owner, ends, shapes = _walls(buildings)
    areas = np.zeros(len(buildings))
    if not len(ends):
        return areas
    lines = shapely.linestrings(ends)
    tree = shapely.STRtree(lines)
    one, other = tree.query(lines, predicate="dwithin", distance=REACH)
    along = ends[:, 1] - ends[:, 0]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    # Outer walls look outwards, so that those of neighbours run against each other.
    meet = (owner[one] != owner[other]) & ((along[one] * along[other]).sum(axis=1) < -PARALLEL)
    one, other = one[meet], other[meet]
    for wall in np.unique(one):
        seen = [_upright(shapes[near], ends[wall, 0], along[wall]) for near in other[one == wall]]
        face = _upright(shapes[wall], ends[wall, 0], along[wall])
        areas[owner[wall]] += shapely.area(shapely.intersection(face, shapely.union_all(seen)))
    return areas


def _walls(buildings: Sequence[Sequence[Solid]]) -> tuple[np.ndarray, np.ndarray, list[np.ndarray]]:
    """Building (w,) of each upright outer wall, its ends in plan (w, 2, 2), its corners (n, 3)."""
    owner, ends, shapes = [], [], []
    for number, solids in enumerate(buildings):
        for solid in solids:
            for face, kind in zip(solid.faces, solid.surface_type):
                if kind != OUTER_WALL:
                    continue
                corners = solid.vertices[list(face[0])]
                start, end = _run(corners)
                if np.linalg.norm(end - start) > SAME_PLACE:
                    owner.append(number)
                    ends.append((start, end))
                    shapes.append(corners)
    return np.array(owner), np.array(ends).reshape(-1, 2, 2), shapes


def _run(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ends in plan of an upright face (n, 3), with its outside to the right of the way from start to end."""
    plan = corners[:, :2]
    far = plan[np.argmax(np.linalg.norm(plan - plan[0], axis=1))]
    near = plan[np.argmax(np.linalg.norm(plan - far, axis=1))]
    normal = np.cross(corners - corners[0], np.roll(corners, -1, axis=0) - corners[0]).sum(axis=0)
    way = far - near
    outside_right = way[1] * normal[0] - way[0] * normal[1] > 0
    return (near, far) if outside_right else (far, near)


def _upright(corners: np.ndarray, start: np.ndarray, along: np.ndarray) -> shapely.Geometry:
    """A wall (n, 3) on the upright plane through `start` along a direction: metres along, height."""
    flat = shapely.polygons(np.column_stack([(corners[:, :2] - start) @ along, corners[:, 2]]))
    return flat if shapely.is_valid(flat) else shapely.buffer(flat, 0.0)
