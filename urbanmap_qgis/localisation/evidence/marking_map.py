"""Road markings as a camera or a laser's intensity sees them, and what they tell of a place (J 6.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...geometry.tolerances import LEAST_DIVISOR
from ..localisation_settings import LocalisationSettings
from ..walls.wall_scan import WallScan
from .information import Evidence, SharedError, surface_rows

SAMPLE = 0.5
STRAIGHT = 0.02
DASH = 20.0
OTHER_END = 0.5
LEVEL = 5.0  # Markings higher or lower than the road by more than this, m, are on another road.


@dataclass(frozen=True)
class MarkingMap:
    """Samples of the edges of markings.

    Attributes
    ----------
    xy : (k, 2) m.
    normal : (k, 2) across the edge.
    length : (k,) m of edge that each stands for.
    marking : (k,) row of the marking.
    sigma : (k,) standard deviation of the marking's place, m.
    height : (k,) m; NaN where the markings have none.
    """

    xy: np.ndarray
    normal: np.ndarray
    length: np.ndarray
    marking: np.ndarray
    sigma: np.ndarray
    height: np.ndarray


def marking_map(shapes: Sequence[shapely.Geometry | None], sigma: np.ndarray) -> MarkingMap:
    """Edges of markings.

    Polygons have the edges of their outlines: long ones tell the place across, short ones that along. A line tells
    that across; one shorter than 20 m also that along at its ends, as long as no other line goes on there. Longer
    lines may end where somebody stopped to draw.

    Parameters
    ----------
    shapes : (n,) polygons or lines.
    sigma : (n,) m.
    """
    edges, owner, heights = [], [], np.full(len(shapes), np.nan)
    for row, shape in enumerate(shapes):
        if shape is None or shape.is_empty:
            continue
        heights[row] = shapely.get_coordinates(shape, include_z=True)[:, 2].mean()
        for part in shapely.get_parts(shapely.simplify(shapely.force_2d(shape), STRAIGHT)):
            part_edges = _outline_edges(part) if part.geom_type == "Polygon" else _line_edges(part)
            edges.append(part_edges)
            owner.append(np.full(len(part_edges), row))
    found = np.concatenate(edges) if edges else np.zeros((0, 5))
    owner = np.concatenate(owner) if owner else np.zeros(0, np.int64)
    found, owner = _free_ends(found, owner)
    xy, normal, length, edge = _edge_samples(found)
    return MarkingMap(xy, normal, length, owner[edge], np.asarray(sigma, float)[owner[edge]], heights[owner[edge]])


def visible_markings(markings: MarkingMap, tree: cKDTree, place: np.ndarray, heading: np.ndarray, scan: WallScan | None,
                     settings: LocalisationSettings) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Which samples are within sight from places (n, 3): in range, in view, before the walls, on the same level.

    Returns
    -------
    of, number : rows of the places and numbers of the samples.
    other_level : (n,) number of samples that only their height keeps out.
    """
    found = tree.query_ball_point(place[:, :2], settings.marking_range)
    count = np.array([len(each) for each in found])
    of = np.repeat(np.arange(len(place)), count)
    number = np.concatenate([np.asarray(each, np.int64) for each in found]) if count.sum() else np.zeros(0, np.int64)
    off = markings.xy[number] - place[of, :2]
    distance, azimuth = np.hypot(off[:, 0], off[:, 1]), np.arctan2(off[:, 0], off[:, 1])
    turned = np.abs((azimuth - heading[of] + np.pi) % (2 * np.pi) - np.pi)
    seen = (turned <= np.radians(settings.marking_view) / 2) & (distance > 0.5)
    if scan is not None:
        azimuths = scan.reach.shape[1]
        ray = np.round(azimuth / (2 * np.pi) * azimuths).astype(np.int64) % azimuths
        seen &= distance < scan.reach[of, ray]
    other = np.abs(markings.height[number] - place[of, 2]) > LEVEL
    return of[seen & ~other], number[seen & ~other], np.bincount(of[seen & other], minlength=len(place))


def marking_evidence(markings: MarkingMap, of: np.ndarray, number: np.ndarray, place: np.ndarray,
                     settings: LocalisationSettings) -> Evidence:
    """Rows of the samples of markings seen from places (n, 3); each marking may be displaced as a whole, and all
    of them together."""
    off = markings.xy[number] - place[of, :2]
    noise = settings.marking_noise * np.maximum(np.hypot(off[:, 0], off[:, 1]) / 10.0, 1.0)
    sigma, normal = markings.sigma[number], markings.normal[number]
    # A sample stands for the points along its stretch, of which the detection rate is found.
    points = settings.detection * np.maximum(markings.length[number] / SAMPLE, 0.1)
    common, one = np.full(len(of), settings.marking_common), np.zeros(len(of), np.int64)
    shared = tuple(SharedError(group, normal[:, axis], spread) for axis in range(2)
                   for group, spread in ((markings.marking[number], sigma), (one, common)))
    return Evidence(of, surface_rows(normal, off), points / (sigma ** 2 + noise ** 2), noise / np.sqrt(points), shared)


def _outline_edges(polygon: shapely.Polygon) -> np.ndarray:
    """Edges (m, 5) of an outline: two ends, and 0, as no edge is a free end."""
    rings = []
    for ring in (polygon.exterior, *polygon.interiors):
        corners = shapely.get_coordinates(ring)
        rings.append(np.column_stack([corners[:-1], corners[1:], np.zeros(len(corners) - 1)]))
    return np.concatenate(rings)


def _line_edges(line: shapely.LineString) -> np.ndarray:
    """Edges (m, 5) of a line, and across its ends, marked 1, those of a paint stroke 0.15 m wide."""
    points = shapely.get_coordinates(line)
    edges = [np.column_stack([points[:-1], points[1:], np.zeros(len(points) - 1)])]
    if line.length <= DASH:
        for end, before in ((points[0], points[1]), (points[-1], points[-2])):
            along = end - before
            across = np.array([-along[1], along[0]]) / max(np.hypot(*along), LEAST_DIVISOR) * 0.075
            edges.append(np.array([[*(end - across), *(end + across), 1.0]]))
    return np.concatenate(edges)


def _free_ends(edges: np.ndarray, owner: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The edges without the ends at which another line goes on."""
    ends = np.flatnonzero(edges[:, 4] == 1)
    if not len(ends):
        return edges, owner
    middle = (edges[ends, :2] + edges[ends, 2:4]) / 2
    near = cKDTree(middle).query_pairs(OTHER_END, output_type="ndarray")
    touching = near[owner[ends[near[:, 0]]] != owner[ends[near[:, 1]]]].ravel()
    free = np.ones(len(edges), bool)
    free[ends[touching]] = False
    return edges[free], owner[free]


def _edge_samples(edges: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Middles of stretches of edges, their normals and lengths, and the number of the edge."""
    direction = edges[:, 2:4] - edges[:, :2]
    length = np.hypot(direction[:, 0], direction[:, 1])
    count = np.where(length > 1e-3, np.maximum(np.round(length / SAMPLE), 1), 0).astype(np.int64)
    edge = np.repeat(np.arange(len(edges)), count)
    share = (np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[edge]
    unit = direction[edge] / length[edge, None]
    return (edges[edge, :2] + share[:, None] * direction[edge], np.column_stack([-unit[:, 1], unit[:, 0]]),
            length[edge] / count[edge], edge)
