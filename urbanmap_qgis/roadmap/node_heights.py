"""Heights of a lane map's nodes where none was measured: taken along the road from those that were."""

from __future__ import annotations

import numpy as np
import shapely
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.sparse.linalg import spsolve

from .lanes.lane_assembly import centre_line
from .map_records import VectorMap

GRADE_CHANGE = 0.02
"""A road's grade changes by about so much: sigma of a filled height over the distance to the nearest known one."""


def fill_heights(built: VectorMap) -> int:
    """Give every node that has no height one between those known along its bounds and across its lanes.

    The heights are the harmonic ones: each is the mean of its neighbours', weighted by nearness, so that none lies
    beyond the known ones and no step is made. Parts of the map without any known height take the nearest node's.
    `built.height_sigmas` tells the filled nodes with a sigma that grows with the distance along the road.

    Returns
    -------
    Number of nodes filled; 0 where no height is known at all.
    """
    places = np.array(built.nodes, float).reshape(-1, 3)
    unknown = ~np.isfinite(places[:, 2])
    if unknown.all():
        return 0
    if unknown.any():
        _fill_nodes(built, places, unknown)
    # Ends of stop lines and crosswalks may lie beyond a raster's rim where all nodes lie within it.
    _fill_others(built, places)
    return int(unknown.sum())


def _fill_nodes(built: VectorMap, places: np.ndarray, unknown: np.ndarray) -> None:
    """Put heights into the `unknown` (n,) rows of the nodes' places (n, 3), m."""
    graph = _graph(built, places)
    away = dijkstra(graph, directed=False, indices=np.flatnonzero(~unknown), min_only=True)
    lonely = unknown & ~np.isfinite(away)
    if lonely.any():
        known = np.flatnonzero(~lonely & ~unknown)
        nearest = shapely.STRtree(shapely.points(places[known, :2])).nearest(shapely.points(places[lonely, :2]))
        away[lonely] = np.linalg.norm(places[lonely, :2] - places[known[nearest], :2], axis=1)
        places[lonely, 2] = places[known[nearest], 2]
    _solve(graph, places, unknown & ~lonely)
    for number in np.flatnonzero(unknown):
        built.nodes[number] = places[number]
        built.height_sigmas[int(number)] = float(GRADE_CHANGE * away[number])


def _graph(built: VectorMap, places: np.ndarray) -> coo_matrix:
    """Distances (m) between nodes that follow each other on a bound or lie across a lane."""
    pairs = [pair for bound in built.bounds for pair in zip(bound.nodes[:-1], bound.nodes[1:])]
    for lane in built.lanes:
        left, right = built.bounds[lane.left].nodes, built.bounds[lane.right].nodes
        distances = np.linalg.norm(places[left, None, :2] - places[None, right, :2], axis=2)
        pairs += [(node, right[k]) for node, k in zip(left, distances.argmin(axis=1))]
        pairs += [(node, left[k]) for node, k in zip(right, distances.argmin(axis=0))]
    pairs = np.unique(np.sort(np.array([pair for pair in pairs if pair[0] != pair[1]], int), axis=1), axis=0)
    length = np.maximum(np.linalg.norm(places[pairs[:, 0], :2] - places[pairs[:, 1], :2], axis=1), 0.01)
    return coo_matrix((length, (pairs[:, 0], pairs[:, 1])), shape=(len(places), len(places))).tocsr()


def _solve(graph, places: np.ndarray, wanted: np.ndarray) -> None:
    """Put harmonic heights into the rows that are wanted."""
    if not wanted.any():
        return
    weights = graph.copy()
    weights.data = 1.0 / weights.data
    weights = weights + weights.T
    inner = weights[wanted][:, wanted]
    known = np.where(np.isfinite(places[:, 2]) & ~wanted, places[:, 2], 0.0)
    beside = weights[wanted] @ known
    total = np.asarray(weights[wanted].sum(axis=1)).ravel()
    system = coo_matrix((total, (np.arange(len(total)),) * 2), shape=inner.shape).tocsc() - inner
    places[wanted, 2] = np.atleast_1d(spsolve(system.tocsc(), beside))


def _fill_others(built: VectorMap, places: np.ndarray) -> None:
    """Heights of centre lines, stop lines and crosswalks that follow from the nodes."""
    for number, lane in enumerate(built.lanes):
        if not np.isfinite(lane.centre[:, 2]).all():
            lane.centre = centre_line(built.coordinates(number, "left"), built.coordinates(number, "right"))
    tree = shapely.STRtree(shapely.points(places[:, :2]))

    def filled(points: np.ndarray) -> np.ndarray:
        raised = np.column_stack([points, np.full(len(points), np.nan)]) if points.shape[1] == 2 else points.copy()
        low = ~np.isfinite(raised[:, 2])
        raised[low, 2] = places[tree.nearest(shapely.points(raised[low, :2])), 2] if low.any() else raised[low, 2]
        return raised

    built.stop_lines = [filled(np.asarray(stop, float)) for stop in built.stop_lines]
    built.crosswalk_rings = [filled(shapely.get_coordinates(area.polygon.exterior, include_z=True))
                             for area in built.crosswalks]
