"""Nodes of a divided plan put where the planes around them meet, and the heights of every plane there."""

from __future__ import annotations

import numpy as np
import shapely

from ...geometry.linked_groups import linked_groups
from ...geometry.tolerances import UNITS
from ..solids.half_edges import HalfEdges, half_edges, trace_rings

SHORTEST_EDGE = 0.03  # Nodes nearer to each other than this (m) along an edge are one.
MEETING = 0.06  # Planes whose heights at a node differ by less than this (m) are to meet there.
HOLD = 1e-3
OUTLINE = 0.05  # Weights of a node's own place and of the outline beside those of the planes.

FARTHEST = 0.25
"""A node is moved no farther than this, m."""


def meeting_polygons(polygons: list[shapely.Polygon], planes: np.ndarray) -> list[shapely.Polygon]:
    """Polygons with z at their planes' heights, their common nodes moved to where the planes meet.

    Parameters
    ----------
    polygons : a plan's, edge by edge beside each other, on a local origin, m.
    planes : (n, 3) plane of each.
    """
    edges = half_edges(np.array(polygons, dtype=object), (0.0, 0.0), 1 / UNITS)
    edges = _collapsed(edges) or edges
    _move_nodes(edges, planes)
    edges = _collapsed(edges) or edges  # nodes that moved onto each other
    shapes = _shapes(edges, len(polygons)) or polygons  # where moving its nodes would fold this plan, small steps stay
    return [_lifted(shape, plane) for shape, plane in zip(shapes, planes)]


def _shapes(edges: HalfEdges, count: int) -> list[shapely.Polygon] | None:
    """Polygons of all cells, None where one is no valid polygon."""
    by_cell: dict[int, list[tuple[int, int]]] = {}
    for edge, cell in edges.cell.items():
        by_cell.setdefault(cell, []).append(edge)
    shapes = [_polygon(edges, by_cell.get(number, [])) for number in range(count)]
    return None if any(shape is None for shape in shapes) else shapes


def _polygon(edges: HalfEdges, directed: list[tuple[int, int]]) -> shapely.Polygon | None:
    """Polygon of a cell's directed edges, None where they make no valid one."""
    if len(directed) < 3:
        return None
    rings = trace_rings(edges, directed)
    outer = [ring for ring in rings if edges.twice_area(ring) > 0]
    if len(outer) != 1:
        return None
    holes = [ring for ring in rings if edges.twice_area(ring) < 0]
    polygon = shapely.Polygon(edges.coordinates(outer[0]), [edges.coordinates(ring) for ring in holes])
    return polygon if polygon.is_valid else None


def _lifted(polygon: shapely.Polygon, plane: np.ndarray) -> shapely.Polygon:
    """The polygon with the heights of a plane."""
    xy = shapely.get_coordinates(polygon)
    return shapely.set_coordinates(shapely.force_3d(polygon), np.column_stack([xy, xy @ plane[:2] + plane[2]]))


def _collapsed(edges: HalfEdges) -> HalfEdges | None:
    """The plan with the ends of very short edges made one node; None where that would not leave a plan."""
    short = [edge for edge in edges.cell if edges.length(*edge) < SHORTEST_EDGE]
    if not short:
        return edges
    _, group = linked_groups(*np.array(short).T, len(edges.x))
    first = np.unique(group, return_index=True)[1][group].tolist()
    owners: dict[tuple[int, int], list[int]] = {}
    for (a, b), cell in edges.cell.items():
        a, b = first[a], first[b]
        if a != b:
            owners.setdefault((a, b), []).append(cell)
    left_cell: dict[tuple[int, int], int] = {}
    for (a, b), cells in owners.items():
        left = list(cells)
        for cell in owners.get((b, a), ()):
            if cell in left:
                left.remove(cell)
        if len(left) > 1:
            return None
        if left:
            left_cell[a, b] = left[0]
    return HalfEdges(edges.origin, edges.resolution, list(edges.x), list(edges.y), left_cell)


def _move_nodes(edges: HalfEdges, planes: np.ndarray) -> None:
    """Move every node to where the planes that nearly meet there meet exactly, and along the outline otherwise."""
    around: dict[int, set[int]] = {}
    outline: dict[int, list[int]] = {}
    for (a, b), cell in edges.cell.items():
        around.setdefault(a, set()).add(cell)
        around.setdefault(b, set()).add(cell)
        if (b, a) not in edges.cell:
            outline.setdefault(a, []).append(b)
            outline.setdefault(b, []).append(a)
    places = {}
    for node, cells in around.items():
        if len(cells) < 2:
            continue
        position = np.array([edges.x[node], edges.y[node]]) / UNITS
        rows, right = _meeting_equations(planes[sorted(cells)], position)
        if not rows:
            continue
        for other in outline.get(node, ()):
            away = np.array([edges.x[other], edges.y[other]]) / UNITS - position
            rows.append(np.array([-away[1], away[0]]) / np.hypot(*away) * OUTLINE)
            right.append(0.0)
        rows += [np.array([HOLD, 0.0]), np.array([0.0, HOLD])]
        right += [0.0, 0.0]
        shift = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)[0]
        if np.hypot(*shift) <= FARTHEST:
            places[node] = position + shift
    for node, (x, y) in places.items():
        edges.x[node], edges.y[node] = round(x * UNITS), round(y * UNITS)


def _meeting_equations(planes: np.ndarray, position: np.ndarray) -> tuple[list[np.ndarray], list[float]]:
    """Rows and right sides, in metres of plan, that say: planes of nearly one height here meet."""
    height = planes[:, :2] @ position + planes[:, 2]
    order = np.argsort(height, kind="stable")
    rows, right = [], []
    for low, high in zip(order, order[1:]):
        if height[high] - height[low] >= MEETING:
            continue
        slope = planes[high, :2] - planes[low, :2]
        steep = float(np.hypot(*slope))
        if steep > 0.02:
            rows.append(slope / steep)
            right.append(float(height[low] - height[high]) / steep)
    return rows, right
