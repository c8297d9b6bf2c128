"""The laser points that lie behind outlines drawn on images (Z 4.2: laser points projected onto line images)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from .image_outlines import POLYGON, ImageOutline

SNAP = 4.0
"""Points this many pixels from a line or a point drawn belong to it."""

_SIDE = 1.0
"""Points this far (m) beside the rays of an outline are still projected."""

_MOST_POINTS = 200_000


@dataclass(frozen=True, eq=False)
class OutlinePoints:
    """Laser points behind an outline, (n,) each.

    Attributes
    ----------
    place : (n, 3) m.
    column, row : pixels.
    distance : from the camera, m.
    """

    place: np.ndarray
    column: np.ndarray
    row: np.ndarray
    distance: np.ndarray

    def __len__(self) -> int:
        return len(self.distance)

    def subset(self, keep: np.ndarray) -> OutlinePoints:
        """Those of a mask or of numbers."""
        return OutlinePoints(self.place[keep], self.column[keep], self.row[keep], self.distance[keep])


def outline_points(outlines: Sequence[ImageOutline], chunks: Iterable[np.ndarray],
                   max_range: float) -> list[OutlinePoints]:
    """Laser points behind each outline, up to `max_range` m from the camera, from chunks (n, 3) of points."""
    beams = [_beam(outline, max_range) for outline in outlines]
    parts: list[list[OutlinePoints]] = [[] for _ in outlines]
    for points in chunks:
        for number, (outline, beam) in enumerate(zip(outlines, beams)):
            candidates = points[_within(points, beam)]
            if len(candidates):
                parts[number].append(_behind(outline, candidates, max_range))
    return [_joined(some) for some in parts]


def _beam(outline: ImageOutline, max_range: float) -> shapely.Polygon:
    """Plan of the rays of an outline's pixels."""
    pixels = shapely.get_coordinates(shapely.segmentize(outline.pixels, 20.0))
    origin, direction = outline.source.rays(*pixels.T)
    max_range = outline.source.image_range(max_range)
    ends = np.vstack([origin[:, :2], (origin + max_range * direction)[:, :2]])
    plan = shapely.MultiPoint(ends).convex_hull.buffer(_SIDE)
    shapely.prepare(plan)
    return plan


def _within(points: np.ndarray, beam: shapely.Polygon) -> np.ndarray:
    """Numbers of the points (n, 3) over a beam's plan."""
    left, low, right, high = beam.bounds
    near = np.flatnonzero((points[:, 0] >= left) & (points[:, 0] <= right) & (points[:, 1] >= low)
                          & (points[:, 1] <= high))
    return near[shapely.contains_xy(beam, points[near, 0], points[near, 1])]


def _behind(outline: ImageOutline, points: np.ndarray, max_range: float) -> OutlinePoints:
    """Those of the points (n, 3) that lie behind an outline in its image."""
    left, top, right, bottom = outline.pixels.buffer(SNAP).bounds
    index, column, row, distance = outline.source.pixels(points, (left, top, right, bottom), max_range)
    if outline.kind == POLYGON:
        keep = shapely.contains_xy(outline.pixels, column, row)
    else:
        keep = shapely.distance(outline.pixels, shapely.points(column, row)) <= SNAP
    return OutlinePoints(points[index[keep]], column[keep], row[keep], distance[keep])


def _joined(parts: Sequence[OutlinePoints]) -> OutlinePoints:
    """All parts as one; of very many points every so manieth."""
    if not parts:
        return OutlinePoints(np.empty((0, 3)), *(np.empty(0) for _ in range(3)))
    joined = OutlinePoints(*(np.concatenate([getattr(part, name) for part in parts])
                             for name in ("place", "column", "row", "distance")))
    step = -(-len(joined) // _MOST_POINTS)
    return joined.subset(np.arange(0, len(joined), step)) if step > 1 else joined
