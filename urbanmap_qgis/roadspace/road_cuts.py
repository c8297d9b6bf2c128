"""A surface cut by lines into pieces that share their edges to the bit."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import shapely

SAME_POINT = 0.02
"""An end of a cut so near to a point of the boundary is that point, m: less than any accuracy of a map."""

SLIVER = 0.05
"""Smaller pieces are none of their own, m2."""


def cut_surface(surface: shapely.Polygon, lines: list[np.ndarray], sliver: float = SLIVER) -> list[shapely.Polygon]:
    """Pieces of a surface between lines (n, 2) whose ends are put onto its boundary, m; the outer rings run left.

    A piece smaller than `sliver`, m2, goes to the neighbour with the longest edge in common.
    """
    rings = [shapely.get_coordinates(ring)[:-1] for ring in (surface.exterior, *surface.interiors)]
    placed, inserted = [], defaultdict(list)
    for line in lines:
        ends = [_on_boundary(rings, line[0]), _on_boundary(rings, line[-1])]
        for ring, edge, share, point in ends:
            if share > 0:
                inserted[ring, edge].append((share, tuple(point)))
        placed.append(np.vstack([ends[0][3], line[1:-1], ends[1][3]]))
    noded = [_with_points(ring, number, inserted) for number, ring in enumerate(rings)]
    closed = [shapely.linestrings(np.vstack([ring, ring[:1]])) for ring in noded]
    edges = shapely.union_all([*closed, *(shapely.linestrings(line) for line in placed if (line[0] != line[-1]).any())])
    shapely.prepare(surface)
    pieces = [piece for piece in shapely.get_parts(shapely.polygonize(shapely.get_parts(edges)))
              if shapely.intersects(surface, shapely.point_on_surface(piece))]
    return [shapely.geometry.polygon.orient(piece) for piece in _without_slivers(pieces, sliver)]


def _on_boundary(rings: list[np.ndarray], point: np.ndarray) -> tuple[int, int, float, np.ndarray]:
    """The place of the boundary nearest to a point: ring, edge, share of the edge (0 at its start), point (2,)."""
    best = (np.inf, 0, 0, 0.0, point)
    for number, ring in enumerate(rings):
        start, along = ring, np.roll(ring, -1, axis=0) - ring
        squares = np.maximum((along**2).sum(axis=1), 1e-18)
        share = np.clip(((point - start) * along).sum(axis=1) / squares, 0.0, 1.0)
        feet = start + along * share[:, None]
        distance = np.hypot(*(feet - point).T)
        edge = int(np.argmin(distance))
        if distance[edge] < best[0]:
            best = (float(distance[edge]), number, edge, float(share[edge]), feet[edge])
    _, number, edge, share, foot = best
    ring = rings[number]
    for corner in (edge, (edge + 1) % len(ring)):
        if np.hypot(*(ring[corner] - foot)) <= SAME_POINT:
            return number, corner, 0.0, ring[corner]
    return number, edge, share, foot


def _with_points(ring: np.ndarray, number: int, inserted: dict) -> np.ndarray:
    """A ring (n, 2) with further points on its edges."""
    points = []
    for edge, corner in enumerate(ring):
        points.append(tuple(corner))
        points += [point for _, point in sorted(set(inserted.get((number, edge), ())))]
    return np.array(points)


def _without_slivers(pieces: list[shapely.Polygon], sliver: float) -> list[shapely.Polygon]:
    """Pieces with those too small given to a neighbour."""
    pieces = list(pieces)
    while True:
        small = next((number for number, piece in enumerate(pieces) if piece.area < sliver), None)
        if small is None or len(pieces) == 1:
            return pieces
        shared = [0.0 if number == small else shapely.length(shapely.intersection(pieces[small].boundary,
                                                                                 piece.boundary))
                  for number, piece in enumerate(pieces)]
        neighbour = int(np.argmax(shared))
        if shared[neighbour] <= 0:
            return [piece for piece in pieces if piece.area >= sliver]
        whole = shapely.union(pieces[small], pieces[neighbour])
        pieces = [piece for number, piece in enumerate(pieces) if number not in (small, neighbour)] + [whole]
