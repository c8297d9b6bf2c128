"""Small changes of a plan that keep the solid over it free of non-manifold edges.

Round a plan node the roofs' heights must rise to one top and fall to one bottom. Where they rise twice
(two high roofs touching only in the node, a courtyard touching the outline), four walls would meet in one
vertical edge. The corner of a low cell is then cut off and given to the high cell beside it (or the other
way round), a triangle of about a centimetre.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from .half_edges import OUTSIDE, HalfEdges

Height = Callable[[int, int], int]
"""Height of a cell at a node, in the unit of the base."""

CORNER_SIZE = 0.01  # Wanted length of the legs of a cut corner, m.
LARGEST_CORNER = 0.1
SHORTEST_EDGE = 0.0015
WIDEST_CORNER = math.radians(170)
# Lattice steps that must lie between the edges of a corner where one of them gets a new, rounded node.
ROUNDING = 2.5


@dataclass(frozen=True)
class _Corner:
    """Sector of a cell at a node, between the directions to `right` and, counterclockwise, to `left`."""

    right: int
    left: int
    cell: int
    height: int
    angle: float


@dataclass(frozen=True)
class _Repair:
    """Corners at one node that would change to another cell; `narrowest`: angle of theirs or beside them."""

    corners: tuple[_Corner, ...]
    target: int
    narrowest: float


def cut_corners(edges: HalfEdges, height: Height, base: int) -> tuple[int, list[int]]:
    """Cut corners at every node where heights rise twice; return how many, and the nodes where none could be.

    `height` gives the height of a cell at a node.
    """
    done, failed = 0, []
    around = _neighbours(edges)
    # With fewer than four edges heights cannot rise twice; nodes that a cut adds have three or fewer.
    for node in sorted(node for node, others in around.items() if len(others) > 3):
        for _ in around:
            repairs = list(_possible_repairs(_corners(edges, node, around[node], height, base)))
            if not repairs:
                break
            if not any(_cut(edges, node, repair) for repair in sorted(repairs, key=_reluctance)):
                failed.append(node)
                break
            done += 1
            around = _neighbours(edges)
    return done, failed


def _neighbours(edges: HalfEdges) -> dict[int, set[int]]:
    """Nodes that each node has an edge to."""
    neighbours: dict[int, set[int]] = {}
    for a, b in edges.cell:
        neighbours.setdefault(a, set()).add(b)
        neighbours.setdefault(b, set()).add(a)
    return neighbours


def _corners(edges: HalfEdges, node: int, around: set[int], height: Height, base: int) -> list[_Corner]:
    """Corners round a node, counterclockwise."""
    spokes = sorted((edges.direction(node, other), other) for other in around)
    corners = []
    for (angle, right), (next_angle, left) in zip(spokes, [*spokes[1:], spokes[0]]):
        cell = edges.cell.get((node, right), OUTSIDE)
        top = base if cell == OUTSIDE else height(cell, node)
        corners.append(_Corner(right, left, cell, top, (next_angle - angle) % (2 * math.pi)))
    return corners


def _possible_repairs(corners: list[_Corner]) -> Iterator[_Repair]:
    """Every way to take away one of several tops: fill a dip between two, or cut one down; none if all is well."""
    yield from _fill_dips(corners, 1)
    yield from _fill_dips(corners, -1)


def _fill_dips(corners: list[_Corner], sign: int) -> Iterator[_Repair]:
    """Repairs that raise the dip between neighbouring tops to the lower top (`sign` -1: upside down)."""
    n = len(corners)
    height = [sign * corner.height for corner in corners]
    tops = [i for i in range(n) if height[i] > height[i - 1] and _falls_after(height, i)]
    if len(tops) < 2:
        return
    for start, end in zip(tops, [*tops[1:], tops[0] + n]):
        level = min(height[start], height[end % n])
        between = [i % n for i in range(start, end + 1) if height[i % n] < level]
        # The corner beside the dip on the lower top's side: the top itself, or an equally high one next to it.
        target = between[0] - 1 if height[start] == level else (between[-1] + 1) % n
        concerned = [between[0] - 1, *between, (between[-1] + 1) % n]
        yield _Repair(tuple(corners[i] for i in between), corners[target].cell,
                    min(corners[i].angle for i in concerned))


def _falls_after(height: list[int], i: int) -> bool:
    """Whether the heights fall after the plateau that begins at `i`."""
    n = len(height)
    after = next((height[(i + k) % n] for k in range(1, n) if height[(i + k) % n] != height[i]), height[i])
    return after < height[i]


def _reluctance(repair: _Repair) -> tuple:
    """Sorting key: opening a building to the outside comes last, few wide corners come first."""
    return (repair.target == OUTSIDE, len(repair.corners), -repair.narrowest)


def _cut(edges: HalfEdges, node: int, repair: _Repair) -> bool:
    """Carry a repair out; False, with nothing changed, where a corner is too wide or too narrow for the room."""
    narrowest = min(corner.angle for corner in repair.corners)
    needed = max(SHORTEST_EDGE, SHORTEST_EDGE / (2 * math.sin(min(narrowest, math.pi) / 2)),
                 ROUNDING * edges.resolution / repair.narrowest)
    leg = min(max(CORNER_SIZE, needed), 0.4 * _clearance(edges, node) * edges.resolution, LARGEST_CORNER)
    if leg < needed or max(corner.angle for corner in repair.corners) > WIDEST_CORNER:
        return False
    steps = leg / edges.resolution
    split: dict[int, int] = {}
    for corner in repair.corners:
        for end in (corner.right, corner.left):
            if end not in split:
                split[end] = _split(edges, node, end, steps)
    for corner in repair.corners:
        _move_corner(edges, node, split[corner.right], split[corner.left], corner.cell, repair.target)
    return True


def _clearance(edges: HalfEdges, node: int) -> float:
    """Distance from a node to the nearest other node or edge that does not end in it, lattice units."""
    px, py = edges.x[node], edges.y[node]
    nearest = math.inf
    for a, b in edges.cell:
        if a == node or b == node:
            other = b if a == node else a
            nearest = min(nearest, math.hypot(edges.x[other] - px, edges.y[other] - py))
            continue
        ax, ay = edges.x[a] - px, edges.y[a] - py
        dx, dy = edges.x[b] - edges.x[a], edges.y[b] - edges.y[a]
        along = min(max(-(ax * dx + ay * dy) / (dx * dx + dy * dy), 0.0), 1.0)
        nearest = min(nearest, math.hypot(ax + along * dx, ay + along * dy))
    return nearest


def _split(edges: HalfEdges, node: int, end: int, steps: float) -> int:
    """Put a new node on the edge from `node` to `end`, `steps` lattice units from `node`."""
    dx, dy = edges.x[end] - edges.x[node], edges.y[end] - edges.y[node]
    share = steps / math.hypot(dx, dy)
    middle = edges.add_node(edges.x[node] + round(dx * share), edges.y[node] + round(dy * share))
    for a, b in ((node, end), (end, node)):
        cell = edges.cell.pop((a, b), None)
        if cell is not None:
            edges.cell[a, middle] = edges.cell[middle, b] = cell
    return middle


def _move_corner(edges: HalfEdges, node: int, right: int, left: int, cell: int, target: int) -> None:
    """Move the triangle node, right, left from `cell` to `target`, and drop edges between equal cells."""
    for edge in ((left, node), (node, right)):
        _set(edges, edge, target)
    _set(edges, (left, right), cell)
    _set(edges, (right, left), target)
    for a, b in ((node, right), (node, left)):
        if edges.cell.get((a, b), OUTSIDE) == edges.cell.get((b, a), OUTSIDE):
            edges.cell.pop((a, b), None)
            edges.cell.pop((b, a), None)


def _set(edges: HalfEdges, edge: tuple[int, int], cell: int) -> None:
    """Say what lies at the left of a directed edge."""
    if cell == OUTSIDE:
        edges.cell.pop(edge, None)
    else:
        edges.cell[edge] = cell
