"""Heights of areas at their corners, and the faces of steps between them.

Source: Project PLATEAU, standard product specification of 3D city models 5.0, table 4-141: one height across the road
(LOD3.0, 3.1), steps from 15 cm (3.2) or 2 cm (3.3) as faces of the sidewalk or island.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...geometry.short_sides import SHORTEST
from .area_records import (
    CARRIAGEWAY,
    CROSSING,
    ISLAND,
    LANE,
    SIDEWALK,
    STEPS,
    EdgeLine,
    StepFace,
    TrafficSurface,
    corner_of,
)

Heights = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""Heights (m), NaN where unknown, of places x, y."""

STATION = 0.6  # m between measured places of an edge; a corner nearer to one lies on it
CLEAR = 0.5  # m from kerbs, where a raster mixes road and sidewalk
SIGMAS = 2.0  # by which a step may be measured too low
LEAST_SIGMA = 0.003  # m, of a step
NEIGHBOURS = 6


@dataclass(frozen=True, eq=False)
class EdgeHeights:
    """Measured places of edges (n, 2), heights of their foot and top (n,), m, and sigma of the steps (n,), m."""

    place: np.ndarray
    foot: np.ndarray
    top: np.ndarray
    sigma: np.ndarray

    @classmethod
    def of(cls, edges: Sequence[EdgeLine]) -> EdgeHeights:
        """All places of edges."""
        return cls(np.concatenate([edge.plan for edge in edges]),
                   np.concatenate([edge.foot[:, 2] for edge in edges]),
                   np.concatenate([edge.top[:, 2] for edge in edges]),
                   np.concatenate([np.full(len(edge.foot), edge.sigma_z) for edge in edges]))


def raised_areas(areas: Sequence[TrafficSurface], edges: EdgeHeights, level: str,
                 ground: Heights | None) -> tuple[list[TrafficSurface], list[StepFace]]:
    """Areas with the heights of their corners, and the faces of steps.

    Parameters
    ----------
    level : one of `LEVELS`; level 2 has no heights (0).
    ground : of the road's surface away from kerbs; without it heights are those of the edges, between them.
    """
    if level == "2":
        return [replace(area, heights=dict.fromkeys(_corners(area), 0.0)) for area in areas], []
    low, high = _Surface(edges, edges.foot, ground), _Surface(edges, edges.top, ground)
    borders = {border for area in areas if area.kind in (CARRIAGEWAY, CROSSING, LANE) for border in _borders(area)}
    road = {corner for border in borders for corner in border}
    least = STEPS.get(level)
    raised, steps = [], []
    for number, area in enumerate(areas):
        corners = list(_corners(area))
        foot = low.across(corners) if area.kind in (SIDEWALK, ISLAND) and least is None else low.heights_at(corners)
        if area.kind not in (SIDEWALK, ISLAND) or least is None:
            raised.append(replace(area, heights=dict(zip(corners, foot.tolist()))))
            continue
        top, sigma = high.heights_at(corners), low.sigma(corners)
        beside = np.array([corner in road for corner in corners], bool)
        step = beside & (top - foot >= np.maximum(
            least - np.maximum(SIGMAS * sigma, LEAST_SIGMA), SHORTEST))
        heights = np.where(beside & ~step, foot, top)
        raised.append(replace(area, heights=dict(zip(corners, heights.tolist()))))
        feet = dict(zip(corners, foot.tolist()))
        steps += [StepFace(ring, number, height) for ring, height in _faces(area, raised[-1].heights, feet, borders)]
    return raised, steps


def _corners(area: TrafficSurface) -> dict[tuple[float, float], None]:
    """Corners of an area, each once, in order."""
    return dict.fromkeys(map(corner_of, shapely.get_coordinates(area.polygon).tolist()))


def _sides(area: TrafficSurface) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Begin and end of each side of an area, in order."""
    sides = []
    for ring in (area.polygon.exterior, *area.polygon.interiors):
        corners = list(map(corner_of, shapely.get_coordinates(ring).tolist()))
        sides += list(zip(corners[:-1], corners[1:]))
    return sides


def _borders(area: TrafficSurface) -> set[frozenset]:
    """Sides of an area by their two corners."""
    return {frozenset(side) for side in _sides(area)}


def _faces(area: TrafficSurface, heights: dict, feet: dict, road: set[frozenset]) -> list[tuple[np.ndarray, float]]:
    """Upright faces (n, 3) below the borders of an area at which a carriageway lies lower, seen from the carriageway,
    with their mean height, m."""
    rings = []
    for start, end in _sides(area):
        if frozenset((start, end)) in road:
            points = [(*start, feet[start]), (*end, feet[end]), (*end, heights[end]), (*start, heights[start])]
            if heights[start] - feet[start] < 1e-3:
                points = points[:3]
            if heights[end] - feet[end] < 1e-3:
                points = [point for k, point in enumerate(points) if k != 2]
            if len(points) > 2:
                rings.append((np.array(points), (heights[start] - feet[start] + heights[end] - feet[end]) / 2.0))
    return rings


class _Surface:
    """Heights between measured places of edges: those of the edges near them, else of the ground or between them."""

    def __init__(self, edges: EdgeHeights, heights: np.ndarray, ground: Heights | None):
        known = np.isfinite(heights)
        self.tree, self.heights, self.ground = cKDTree(edges.place[known]), heights[known], ground
        self.sigmas = edges.sigma[known]

    def heights_at(self, corners: Sequence[tuple[float, float]]) -> np.ndarray:
        """Heights (n,), m."""
        places = np.array(corners).reshape(-1, 2)
        near, along = self._along_edges(places)
        if self.ground is None:
            return along
        ground = self.ground(*places.T)
        return np.where((near > CLEAR) & np.isfinite(ground), ground, along)

    def across(self, corners: Sequence[tuple[float, float]]) -> np.ndarray:
        """Heights of the edge nearest to each corner, m: one height across the road."""
        return self.heights[self.tree.query(np.array(corners).reshape(-1, 2))[1]]

    def sigma(self, corners: Sequence[tuple[float, float]]) -> np.ndarray:
        """Standard deviations of the nearest steps, m; 0 where unknown."""
        return np.nan_to_num(self.sigmas[self.tree.query(np.array(corners).reshape(-1, 2))[1]])

    def _along_edges(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Distance to the nearest measured place, and the mean of the heights about by the distances' squares."""
        count = min(NEIGHBOURS, len(self.heights))
        away, at = self.tree.query(places, k=count)
        away, at = away.reshape(len(places), count), at.reshape(len(places), count)
        # Near an edge only its own two stations count: those of another edge lie at its height.
        reach = np.where(away[:, :1] < STATION, 2.0 * STATION, np.inf)
        weight = np.where(away <= reach, 1.0 / np.maximum(away, 1e-3)**2, 0.0)
        return away[:, 0], (weight * self.heights[at]).sum(axis=1) / weight.sum(axis=1)
