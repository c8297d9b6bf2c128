"""Heights of the surfaces at the nodes of their borders, where the mesh's walls will stand."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial import cKDTree

from ...geometry.tolerances import UNITS
from ..solids.half_edges import OUTSIDE, HalfEdges
from .surface_plan import SurfacePlan

NEIGHBOURS = 12
LEVEL = 1.0  # Weight (m2 a point) with which a plane is held level: decides where the points tell no slope.
BEYOND = 0.3
SAME = 0.05  # Surfaces whose heights at a node differ by less than this (m) meet there.

Heights = dict[tuple[int, int], int]
"""Height of each surface at each node of its border: (surface, node) -> units."""


def border_heights(plan: SurfacePlan, cells: list[np.ndarray], base: float, spacing: float,
                   tolerance: float) -> Heights:
    """Put nodes on the borders where the surfaces bend, and give every surface its heights at its nodes.

    Parameters
    ----------
    plan : changed in place: its edges get more nodes.
    cells : (k, 3) places and heights (m) of the measured cells of each surface.
    base : height of the ground, m: all heights are above it.
    spacing : between nodes that are tried, m.
    tolerance : how far a border may pass its surface's heights, m.
    """
    chains = _densified(plan.edges, spacing)
    heights = _fitted(plan, cells, base)
    for chain in chains:
        _simplify_chain(plan.edges, chain, heights, round(tolerance * UNITS))
    _equalise_heights(plan.edges, heights, round(base * UNITS))
    _add_crossings(plan.edges, heights)
    _fill_dips(plan.edges, heights, round(base * UNITS))
    return heights


def _densified(edges: HalfEdges, spacing: float) -> list[list[int]]:
    """Cut long edges; the chains of nodes that stand for one edge each."""
    chains = []
    for a, b in sorted({(min(pair), max(pair)) for pair in edges.cell}):
        parts = int(edges.length(a, b) / spacing)
        if parts < 2:
            continue
        chain = [a]
        for k in range(1, parts):
            chain.append(edges.add_node(*(round(start + (end - start) * k / parts)
                                          for start, end in ((edges.x[a], edges.x[b]), (edges.y[a], edges.y[b])))))
        chain.append(b)
        _replace(edges, [a, b], chain)
        chains.append(chain)
    return chains


def _replace(edges: HalfEdges, old: list[int], new: list[int]) -> None:
    """Let the edges along the nodes `new` stand where those along `old` stood, in both directions."""
    for before, after in ((old, new), (old[::-1], new[::-1])):
        cell = edges.cell.get((before[0], before[1]))
        if cell is None:
            continue
        for pair in zip(before, before[1:]):
            del edges.cell[pair]
        for pair in zip(after, after[1:]):
            edges.cell[pair] = cell


def _fitted(plan: SurfacePlan, cells: list[np.ndarray], base: float) -> Heights:
    """Heights by planes through the nearest cells of each surface, held level where those lie on a line."""
    heights: Heights = {}
    nodes_of: dict[int, set[int]] = {}
    for (a, b), surface in plan.edges.cell.items():
        nodes_of.setdefault(surface, set()).update((a, b))
    lowest = round(base * UNITS) + UNITS // 10
    for surface, nodes in nodes_of.items():
        names = sorted(nodes)
        fitted = local_heights(cells[surface], plan.edges.coordinates(names))
        for node, height in zip(names, fitted.tolist()):
            heights[surface, node] = max(round(height * UNITS), lowest)
    return heights


def local_heights(cells: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Heights (n,) at places (n, 2) by planes through the nearest of cells (k, 3)."""
    count = min(NEIGHBOURS, len(cells))
    near = cKDTree(cells[:, :2]).query(places, count)[1].reshape(len(places), count)
    points = cells[near]
    middle = np.median(points[:, :, 2], axis=1)
    weight = 1.0 / (1.0 + ((points[:, :, 2] - middle[:, None]) / 0.5) ** 2)
    total = weight.sum(axis=1)
    centre = (points * weight[..., None]).sum(axis=1) / total[:, None]
    away = points - centre[:, None]
    normal = np.einsum("nk,nki,nkj->nij", weight, away[..., :2], away[..., :2])
    normal += np.eye(2) * (LEVEL * 0.02 * total)[:, None, None]
    right = np.einsum("nk,nki,nk->ni", weight, away[..., :2], away[..., 2])
    slope = np.linalg.solve(normal, right[..., None])[..., 0]
    height = centre[:, 2] + ((places - centre[:, :2]) * slope).sum(axis=1)
    return np.clip(height, points[:, :, 2].min(axis=1) - BEYOND, points[:, :, 2].max(axis=1) + BEYOND)


def _simplify_chain(edges: HalfEdges, chain: list[int], heights: Heights, tolerance: int) -> None:
    """Take nodes out of a chain while the heights of the surfaces at both sides stay within tolerance."""
    sides = [surface for surface in (edges.cell.get((chain[0], chain[1])), edges.cell.get((chain[1], chain[0])))
             if surface is not None]
    profile = np.array([[heights[surface, node] for node in chain] for surface in sides], float)
    keep = {0, len(chain) - 1}
    waiting = [(0, len(chain) - 1)]
    while waiting:
        start, end = waiting.pop()
        if end - start < 2:
            continue
        share = np.arange(1, end - start) / (end - start)
        line = profile[:, start, None] + (profile[:, end] - profile[:, start])[:, None] * share
        off = np.abs(profile[:, start + 1:end] - line).max(axis=0)
        if off.max() > tolerance:
            middle = start + 1 + int(off.argmax())
            keep.add(middle)
            waiting += [(start, middle), (middle, end)]
    _replace(edges, chain, [chain[place] for place in sorted(keep)])


def _sectors(edges: HalfEdges) -> dict[int, list[int]]:
    """Surfaces round each node counterclockwise, `OUTSIDE` among them; each as often as it touches the node."""
    around: dict[int, set[int]] = {}
    for a, b in edges.cell:
        around.setdefault(a, set()).add(b)
        around.setdefault(b, set()).add(a)
    return {node: [edges.cell.get((node, other), OUTSIDE)
                   for other in sorted(others, key=lambda other: edges.direction(node, other))]
            for node, others in around.items()}


def _equalise_heights(edges: HalfEdges, heights: Heights, base: int) -> None:
    """Give surfaces of nearly one height at a node the same height there."""
    for node, surfaces in sorted(_sectors(edges).items()):
        names = sorted({surface for surface in surfaces if surface != OUTSIDE}, key=lambda s: heights[s, node])
        group: list[int] = []
        for surface in [*names, None]:
            if surface is not None and (not group
                                        or heights[surface, node] - heights[group[-1], node] < SAME * UNITS):
                group.append(surface)
                continue
            level = round(sum(heights[name, node] for name in group) / len(group))
            for name in group:
                heights[name, node] = level
            group = [surface] if surface is not None else []


def _add_crossings(edges: HalfEdges, heights: Heights) -> None:
    """Put a node where the surfaces beside an edge cross each other."""
    for a, b in sorted({(min(pair), max(pair)) for pair in edges.cell}):
        left, right = edges.cell.get((a, b)), edges.cell.get((b, a))
        if left is None or right is None:
            continue
        start = heights[left, a] - heights[right, a]
        end = heights[left, b] - heights[right, b]
        if start * end >= 0:
            continue
        share = start / (start - end)
        x, y = (round(one + (two - one) * share) for one, two in ((edges.x[a], edges.x[b]), (edges.y[a], edges.y[b])))
        if min(math.hypot(x - edges.x[n], y - edges.y[n]) for n in (a, b)) * edges.resolution < 0.02:
            node = a if share < 0.5 else b
            heights[left, node] = heights[right, node] = round((heights[left, node] + heights[right, node]) / 2)
            continue
        node = edges.add_node(x, y)
        _replace(edges, [a, b], [a, node, b])
        level = round(heights[left, a] + (heights[left, b] - heights[left, a]) * share)
        heights[left, node] = heights[right, node] = level


def _fill_dips(edges: HalfEdges, heights: Heights, base: int) -> None:
    """Let heights round every node rise once and fall once: a dip between two tops is filled, at the node alone."""
    for node, surfaces in sorted(_sectors(edges).items()):
        if len(surfaces) < 4:
            continue
        for _ in surfaces:
            level = [base if s == OUTSIDE else heights[s, node] for s in surfaces]
            dip = _dip(level)
            if dip is None:
                break
            start, end = dip
            top = min(level[start], level[end % len(level)])
            between = [surfaces[k % len(level)] for k in range(start + 1, end)]
            if OUTSIDE in between:
                break
            for surface in between:
                heights[surface, node] = max(heights[surface, node], top)


def _dip(level: list[int]) -> tuple[int, int] | None:
    """Two neighbouring tops with the shallowest dip between (places, the second may pass the end); None with one."""
    n = len(level)
    tops = []
    for k in range(n):
        if level[k] > level[k - 1]:
            after = next((level[(k + j) % n] for j in range(1, n) if level[(k + j) % n] != level[k]), level[k])
            if after < level[k]:
                tops.append(k)
    if len(tops) < 2:
        return None
    pairs = list(zip(tops, [*tops[1:], tops[0] + n]))
    return min(pairs, key=lambda pair: min(level[pair[0]], level[pair[1] % n])
               - min(level[k % n] for k in range(pair[0], pair[1] + 1)))
