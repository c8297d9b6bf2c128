"""Roofs that no piece of a plan's arrangement went to, cut into the plan on their own: none is lost."""

from __future__ import annotations

import numpy as np
import shapely
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from .partition_lines import MIN_FILL
from .plan_arrangement import GRID

MIN_PIECE = 0.5
"""Smaller pieces (m2) that are cut off from their roof join a neighbour."""


def roof_patch(xy: np.ndarray, cell: float, axes: np.ndarray) -> shapely.Geometry:
    """Polygon of one roof from the centres (n, 2) of its cells, m: the largest connected part of them.

    A rectangle along `axes` (2, 2; unit vectors as rows) where the cells fill one, else the cells' outline without
    its stairs.
    """
    xy = _largest_part(xy, cell)
    low, high = (xy @ axes.T).min(axis=0) - 0.5 * cell, (xy @ axes.T).max(axis=0) + 0.5 * cell
    if len(xy) * cell**2 >= MIN_FILL * np.prod(high - low):
        corners = np.array([low, (high[0], low[1]), high, (low[0], high[1])])
        return shapely.Polygon(corners @ axes)
    squares = shapely.box(*(xy - 0.5 * cell).T, *(xy + 0.5 * cell).T)
    return shapely.make_valid(shapely.simplify(shapely.union_all(squares, grid_size=GRID), cell))


def _largest_part(xy: np.ndarray, cell: float) -> np.ndarray:
    """Cells (m, 2) of the largest group connected by sides."""
    place = np.rint((xy - xy.min(axis=0)) / cell).astype(np.int64)
    width = int(place[:, 0].max()) + 2
    code = place[:, 1] * width + place[:, 0]
    order = np.argsort(code)
    links = []
    for step in (1, width):
        at = np.minimum(np.searchsorted(code[order], code + step), len(code) - 1)
        beside = code[order][at] == code + step
        links.append(np.column_stack([np.flatnonzero(beside), order[at[beside]]]))
    links = np.concatenate(links)
    group = connected_components(coo_matrix((np.ones(len(links)), links.T), (len(xy), len(xy))), directed=False)[1]
    return xy[group == np.bincount(group).argmax()]


def insert_roof_patches(polygons: list, labels: np.ndarray, patches: list[tuple[int, shapely.Geometry]],
                        outline: shapely.Geometry) -> tuple[np.ndarray, np.ndarray]:
    """Pieces of a plan with patches cut into it: pieces that share exact nodes, and the label of each.

    Parameters
    ----------
    polygons, labels : the plan before, without gaps or overlaps.
    patches : label and polygon of each patch; where two overlap, the later one has the plan.
    """
    shapes = [shapely.intersection(patch, outline) for _, patch in patches]
    lines = shapely.boundary(np.array([*polygons, *shapes], dtype=object))
    pieces = shapely.get_parts(shapely.polygonize([shapely.union_all(lines, grid_size=GRID)]))
    inside = shapely.point_on_surface(pieces)
    label = np.full(len(pieces), -1)
    for shape, number in [*zip(polygons, labels), *((shape, number) for shape, (number, _) in zip(shapes, patches))]:
        shapely.prepare(shape)
        label[shapely.contains(shape, inside)] = number
    labelled = label >= 0
    return pieces[labelled], _without_slivers(pieces[labelled], label[labelled])


def _without_slivers(pieces: np.ndarray, label: np.ndarray) -> np.ndarray:
    """Label (n,) of each piece, slivers that a patch cut off given to the neighbour along most of their border."""
    label = label.copy()
    tree = shapely.STRtree(pieces)
    for sliver in np.flatnonzero(shapely.area(pieces) < MIN_PIECE):
        beside = tree.query(pieces[sliver], predicate="intersects")
        beside = beside[beside != sliver]
        border = shapely.boundary(pieces[sliver])
        shared = shapely.length(shapely.intersection(border, shapely.boundary(pieces[beside])))
        if len(beside) and not (shared[label[beside] == label[sliver]] > GRID).any():
            label[sliver] = label[beside[np.argmax(shared)]]
    return label
