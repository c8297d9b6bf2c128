"""Planes and nodes of a divided plan adjusted together, so that planes that nearly meet at a node meet there exactly.

More planes may meet at a node than a move of that node can bring together. Then the planes themselves give way, by
least squares: a roof that was bent at such a node would fall into triangles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from ...execution import checkpoint
from ...geometry.tolerances import LEAST_DIVISOR, LEAST_FACE, UNITS
from ..solids.half_edges import HalfEdges
from ..solids.sloped_solid import FLAT, LEAST_STEP


@dataclass(frozen=True)
class MeetingPlanesLimits:
    """Limits of meeting planes, each with its unit."""

    rounds: int = 6  # Linear steps at most: where a node is changes what a turn of its planes does there.
    enough: float = 1e-4  # Planes that miss each other by less than this (m) meet.
    # Weight of a metre that a node moves, beside a metre of height over a square metre of roof.
    move: float = 0.5
    rule: float = 1e4  # Weight, beside the same, of a rule: planes meet, level ones stay level, nodes on the outline.
    straight: float = 0.02  # Sine of the turn of the outline up to which a node of it may move along it.
    farthest: float = 0.25  # A node moves no farther than this, m.
    most_change: float = 0.05  # No plane changes by more than this at any of its nodes, m.


LIMITS = MeetingPlanesLimits()


@dataclass(frozen=True)
class _Plan:
    """Nodes and planes of a plan.

    Attributes
    ----------
    xy : (n, 2) nodes, m.
    planes : (c, 3) as they are given.
    node, cell : (p,) every pair of a node and a cell round it.
    area : (c,) of the cells, m2.
    held : (k, 3) node and unit vector of a way that it may not move.
    """

    xy: np.ndarray
    planes: np.ndarray
    node: np.ndarray
    cell: np.ndarray
    area: np.ndarray
    held: np.ndarray


class _Equations:
    """Rows of a sparse system, one below the other."""

    def __init__(self) -> None:
        self.count = 0
        self.rows: list[np.ndarray] = []
        self.columns: list[np.ndarray] = []
        self.values: list[np.ndarray] = []
        self.right: list[np.ndarray] = []

    def add(self, columns: list[np.ndarray], values: list[np.ndarray], right: np.ndarray, weight) -> None:
        """Equations (m,): the sum of values (m,) times the unknowns of columns (m,) is `right` (m,)."""
        m = len(right)
        weight = np.broadcast_to(weight, m)
        for column, value in zip(columns, values):
            self.rows.append(np.arange(self.count, self.count + m))
            self.columns.append(column)
            self.values.append(np.broadcast_to(value, m) * weight)
        self.right.append(right * weight)
        self.count += m

    def solved(self, unknowns: int) -> np.ndarray:
        """The unknowns (u,) of the least sum of squares."""
        matrix = coo_matrix((np.concatenate(self.values), (np.concatenate(self.rows), np.concatenate(self.columns))),
                            shape=(self.count, unknowns)).tocsc()
        return spsolve((matrix.T @ matrix).tocsc(), matrix.T @ np.concatenate(self.right))


def adjust_meeting(edges: HalfEdges, planes: np.ndarray) -> np.ndarray | None:
    """Planes (c, 3) of the cells that meet at every node where they nearly did; nodes of `edges` are moved in place.

    None, with nothing moved, where all meet already or where larger changes than the limits are asked. A level plane
    stays level.

    Parameters
    ----------
    edges : the plan, cell i under plane i.
    planes : (c, 3) a, b, c of z = a x + b y + c, x and y as those of the nodes, m.
    """
    plan = _plan(edges, planes)
    pairs = _meetings(plan)
    off = np.count_nonzero(_missed(plan.xy, planes, pairs) > FLAT)
    if not off:
        return None
    changed, xy = planes, plan.xy
    for _ in range(LIMITS.rounds):
        checkpoint()
        changed, xy = _step(plan, pairs, changed, xy)
        if np.abs(_missed(xy, changed, pairs)).max() < LIMITS.enough:
            break
    difference = (changed - planes)[plan.cell]
    change = (difference[:, :2] * plan.xy[plan.node]).sum(axis=1) + difference[:, 2]
    left = np.count_nonzero(np.abs(_missed(xy, changed, pairs)) > FLAT)
    if not (np.hypot(*(xy - plan.xy).T).max() <= LIMITS.farthest and np.abs(change).max() <= LIMITS.most_change
            and left < off):
        return None
    edges.x[:], edges.y[:] = np.rint(xy * UNITS).astype(np.int64).T.tolist()
    return changed


def _plan(edges: HalfEdges, planes: np.ndarray) -> _Plan:
    """Nodes, and cells round each."""
    xy = np.column_stack([edges.x, edges.y]) / UNITS
    start, end = np.array(list(edges.cell)).T
    owner = np.array(list(edges.cell.values()))
    twice = np.bincount(owner, xy[start, 0] * xy[end, 1] - xy[start, 1] * xy[end, 0], len(planes))
    pair = np.unique(np.column_stack([np.concatenate([start, end]), np.concatenate([owner, owner])]), axis=0)
    return _Plan(xy, planes, pair[:, 0], pair[:, 1], twice / 2, _held(edges, xy))


def _held(edges: HalfEdges, xy: np.ndarray) -> np.ndarray:
    """Node and way (k, 3) that it may not move: across the outline, and along it at its corners."""
    across: dict[int, np.ndarray] = {}
    held = []
    for a, b in edges.cell:
        if (b, a) in edges.cell:
            continue
        way = (xy[b] - xy[a]) / max(np.hypot(*(xy[b] - xy[a])), LEAST_DIVISOR)
        for node in (a, b):
            if node not in across:
                across[node] = np.array([-way[1], way[0]])
                held.append([node, *across[node]])
            elif abs(across[node] @ way) > LIMITS.straight:
                held.append([node, -across[node][1], across[node][0]])
    return np.array(held).reshape(-1, 3)


def _meetings(plan: _Plan) -> np.ndarray:
    """Node, lower and higher cell (k, 3) of planes that follow each other in height at a node and nearly meet."""
    height = (plan.xy[plan.node] * plan.planes[plan.cell, :2]).sum(axis=1) + plan.planes[plan.cell, 2]
    order = np.lexsort((height, plan.node))
    node, cell, height = plan.node[order], plan.cell[order], height[order]
    near = (node[1:] == node[:-1]) & (np.diff(height) < LEAST_STEP)
    return np.column_stack([node[1:], cell[:-1], cell[1:]])[near]


def _missed(xy: np.ndarray, planes: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    """Height (k,) by which planes miss each other where they are to meet, m."""
    node, low, high = pairs.T
    between = planes[high] - planes[low]
    return (xy[node] * between[:, :2]).sum(axis=1) + between[:, 2]


def _step(plan: _Plan, pairs: np.ndarray, planes: np.ndarray, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Planes and nodes after one linear step towards meeting that leaves them near to those of the plan."""
    c, n = planes.shape[0], len(xy)
    system = _Equations()
    node, low, high = pairs.T
    (x, y), slope = xy[node].T, (planes[high] - planes[low])[:, :2].T
    place = 3 * c + 2 * node
    system.add([3 * high, 3 * high + 1, 3 * high + 2, 3 * low, 3 * low + 1, 3 * low + 2, place, place + 1],
               [x, y, 1.0, -x, -y, -1.0, *slope], -_missed(xy, planes, pairs), LIMITS.rule)
    _stay(system, plan, planes, xy)
    shift = system.solved(3 * c + 2 * n)
    turned, moved = shift[:3 * c].reshape(c, 3), shift[3 * c:].reshape(n, 2)
    turned[(plan.planes[:, :2] == 0).all(axis=1), :2] = 0.0  # to the last digit, too
    return planes + turned, xy + moved


def _stay(system: _Equations, plan: _Plan, planes: np.ndarray, xy: np.ndarray) -> None:
    """Equations that say: planes as they were at their nodes, each by its area; nodes as they were."""
    c = len(planes)
    x, y = plan.xy[plan.node].T
    off = (plan.planes - planes)[plan.cell]
    # Nodes of one line, or fewer than three, leave a plane's turn open: a little of each parameter is kept, too.
    weight = np.sqrt(np.maximum(plan.area, LEAST_FACE) / np.bincount(plan.cell, minlength=c))[plan.cell]
    at = 3 * plan.cell
    system.add([at, at + 1, at + 2], [x, y, 1.0], off[:, 0] * x + off[:, 1] * y + off[:, 2], weight)
    every = np.arange(3 * c)
    system.add([every], [1.0], (plan.planes - planes).ravel(), LEAST_FACE)
    level = np.flatnonzero((plan.planes[:, :2] == 0).all(axis=1))
    for axis in range(2):
        system.add([3 * level + axis], [1.0], np.zeros(len(level)), LIMITS.rule)
        system.add([3 * c + axis + 2 * np.arange(len(xy))], [1.0], (plan.xy - xy)[:, axis], LIMITS.move)
    place = 3 * c + 2 * plan.held[:, 0].astype(np.int64)
    system.add([place, place + 1], list(plan.held[:, 1:].T), np.zeros(len(place)), LIMITS.rule)
