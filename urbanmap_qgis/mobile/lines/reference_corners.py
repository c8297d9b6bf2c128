"""Corners of buildings that tie points refer to, by outlines: what a survey's walls are laid on (Z 3.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...geometry.tolerances import LEAST_DIVISOR
from ..trajectory import Trajectory

MERGE_GAP = 0.05  # m: outlines nearer than this are one block
# degrees between the edges of a corner
MIN_ANGLE = 50.0
MAX_ANGLE = 130.0
MIN_EDGE = 3.0  # m


@dataclass(frozen=True)
class BuildingCorners:
    """Corners of buildings: place (m, 2), unit vectors along both edges away from it (m, 2, 2), lengths (m, 2)."""

    place: np.ndarray
    edge: np.ndarray
    length: np.ndarray


def outline_corners(outlines: Sequence[shapely.Geometry | None]) -> BuildingCorners:
    """Corners between long edges of outlines; outlines that touch are one block."""
    shapes = [shape for shape in outlines if shape is not None and not shape.is_empty]
    merged = shapely.union_all([shape.buffer(MERGE_GAP, join_style="mitre") for shape in shapes])
    rings = []
    for polygon in shapely.get_parts(shapely.buffer(merged, -MERGE_GAP, join_style="mitre")):
        if polygon.geom_type == "Polygon" and not polygon.is_empty:
            rings += [shapely.get_coordinates(shapely.simplify(ring, 0.1))[:-1, :2]
                      for ring in (polygon.exterior, *polygon.interiors)]
    return joined_corners([ring_corners(ring) for ring in rings])


def ring_corners(ring: np.ndarray) -> BuildingCorners:
    """Corners of a closed ring (n, 2), not closed by its first point again, between edges long enough."""
    edges = np.stack([np.roll(ring, 1, axis=0) - ring, np.roll(ring, -1, axis=0) - ring], axis=1)
    length = np.linalg.norm(edges, axis=2)
    unit = edges / np.maximum(length, LEAST_DIVISOR)[..., None]
    angle = np.degrees(np.arccos(np.clip((unit[:, 0] * unit[:, 1]).sum(axis=1), -1, 1)))
    good = (angle > MIN_ANGLE) & (angle < MAX_ANGLE) & (length.min(axis=1) >= MIN_EDGE)
    return BuildingCorners(ring[good], unit[good], length[good])


def joined_corners(parts: Sequence[BuildingCorners]) -> BuildingCorners:
    """Corners of several places as one."""
    nothing = BuildingCorners(np.empty((0, 2)), np.empty((0, 2, 2)), np.empty((0, 2)))
    return BuildingCorners(*(np.concatenate([getattr(part, name) for part in (nothing, *parts)])
                             for name in ("place", "edge", "length")))


def near_course(corners: BuildingCorners, trajectory: Trajectory, max_distance: float) -> BuildingCorners:
    """The corners within `max_distance` metres of the course."""
    distance, _ = cKDTree(trajectory.place[:, :2]).query(corners.place, distance_upper_bound=max_distance)
    near = np.isfinite(distance)
    return BuildingCorners(corners.place[near], corners.edge[near], corners.length[near])
