"""Buildings whose walls are moved along their normals and which stay closed.

In plan a building is a net of lines: walls in one plane are on one line, whichever side they face, and move together.
Corners go to where the moved lines meet, so neighbouring edges follow; heights stay. As no corner is added or taken
away, a closed solid stays closed; whether it stays valid and keeps clear of its neighbours is checked, and walls whose
move does not pass are left where they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...buildings.solids.validity import check_solid
from ...geometry.solid_faces import solids_of
from ...geometry.tolerances import LEAST_DIVISOR, LEAST_FACE
from ...progress import SILENT, Progress
from ..rays.wall_faces import WallPieces, is_solid

NODE = 2e-3  # Corners nearer than this in plan are one, m.
SAME_LINE = 0.05
CROSSING = 0.03  # 1 - cos of the least angle (14 degrees) at which two lines fix a corner between them.
SHORTEST_EDGE = 0.1  # Length that an edge must keep, m (or what it had, if less).
OVERLAP = 0.05  # Area by which a building may run into others more than before, m2.
ON_EDGE = 0.05  # Corners of a shape this near to a wall, and at no node, follow the wall, m.

_PARALLEL = np.cos(np.radians(1.0))


@dataclass(frozen=True)
class PlanNet:
    """Corners and lines of buildings in plan.

    Attributes
    ----------
    node : (m, 2) corners, m.
    building : (m,) row of the building of each.
    start, end : (n,) nodes of the pieces of the walls.
    line : (walls,) line of each wall.
    facing : (walls,) 1 if the wall faces along the line's normal, else -1.
    normal : (lines, 2) unit vectors.
    """

    node: np.ndarray
    building: np.ndarray
    start: np.ndarray
    end: np.ndarray
    line: np.ndarray
    facing: np.ndarray
    normal: np.ndarray

    @classmethod
    def of(cls, walls: WallPieces) -> PlanNet:
        """Net of walls."""
        ends = np.concatenate([walls.start, walls.end])
        owner = np.tile(walls.building, 2)
        cells = np.column_stack([owner, np.round(ends / NODE)]).astype(np.int64)
        _, first, number = np.unique(cells, axis=0, return_index=True, return_inverse=True)
        number = _joined(ends[first], owner[first])[number.ravel()]
        _, first, number = np.unique(number, return_index=True, return_inverse=True)
        line, facing, normal = _lines(walls)
        return cls(ends[first], owner[first], number[:len(walls)], number[len(walls):], line, facing, normal)

    def displacement(self, walls: WallPieces, outwards: np.ndarray, weight: np.ndarray) -> np.ndarray:
        """How corners move, (m, 2), m.

        Parameters
        ----------
        outwards : (walls,) m by which walls are to move.
        weight : (walls,) how much each has to say about the line it is on; a line none of whose walls has any stays.
        """
        total = np.bincount(self.line, weight, len(self.normal))
        shift = np.bincount(self.line, weight * outwards * self.facing, len(self.normal))
        shift = np.divide(shift, total, out=np.zeros_like(shift), where=total > 0)
        line = self.line[walls.wall]
        pairs = np.unique(np.column_stack([np.r_[self.start, self.end], np.r_[line, line]]), axis=0)
        normal = self.normal[pairs[:, 1]]
        matrix, right = np.zeros((len(self.node), 2, 2)), np.zeros((len(self.node), 2))
        np.add.at(matrix, pairs[:, 0], normal[:, :, None] * normal[:, None, :])
        np.add.at(right, pairs[:, 0], normal * shift[pairs[:, 1], None])
        size, axis = np.linalg.eigh(matrix)
        along = np.einsum("nij,ni->nj", axis, right)
        # Lines that hardly cross do not fix a corner along themselves: there it keeps its place.
        along = np.divide(along, size, out=np.zeros_like(along), where=size > CROSSING)
        return np.einsum("nij,nj->ni", axis, along)


def moved_walls(walls: WallPieces, net: PlanNet, displacement: np.ndarray) -> WallPieces:
    """The pieces of walls between moved corners, numbered as before."""
    start, end = walls.start + displacement[net.start], walls.end + displacement[net.end]
    edge = end - start
    length = np.hypot(edge[:, 0], edge[:, 1])
    normal = np.column_stack([edge[:, 1], -edge[:, 0]]) / np.maximum(length, LEAST_DIVISOR)[:, None]
    normal = np.where((length > 1e-3)[:, None], normal, walls.normal)
    offset = np.einsum("ij,ij->i", normal, (start + end) / 2)
    return WallPieces(start, end, walls.low, walls.top, normal, offset, walls.building, walls.wall)


def applied_offsets(walls: WallPieces, net: PlanNet, displacement: np.ndarray) -> np.ndarray:
    """(walls,) how far walls have moved outwards in the mean over their length, m."""
    length = np.linalg.norm(walls.end - walls.start, axis=1)
    by = np.einsum("ij,ij->i", (displacement[net.start] + displacement[net.end]) / 2, walls.normal)
    return np.bincount(walls.wall, by * length) / np.bincount(walls.wall, length)


def move_buildings(shapes: Sequence[shapely.Geometry | None], row: np.ndarray, walls: WallPieces, net: PlanNet,
                   outwards: np.ndarray, weight: np.ndarray, progress: Progress = SILENT
                   ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Move walls as far as the buildings stay valid and clear of each other.

    Parameters
    ----------
    shapes : (n,) solids or outlines, not changed.
    row : (n,) row of the building that each is part of.
    outwards, weight : (walls,) as in `PlanNet.displacement`; those of weight 0 do not move by themselves.

    Returns
    -------
    The moved shapes (n,), the displacement of the corners (m, 2), and (walls,) which walls were held back.
    """
    bodies = np.array(shapes, dtype=object)
    current = bodies.copy()
    displacement = np.zeros_like(net.node)
    immovable = np.zeros(len(outwards), bool)
    home = walls.building[np.unique(walls.wall, return_index=True)[1]]
    plans = [_plan(shape) for shape in shapes]
    tree = shapely.STRtree([plan if plan is not None else shapely.Polygon() for plan in plans])
    wanted = np.unique(home[(weight > 0) & (outwards != 0)])
    for number, building in enumerate(wanted):
        progress.step(number / len(wanted))
        members = np.flatnonzero(row == building)
        movable = np.flatnonzero((home == building) & (weight > 0))
        check = _MoveCheck(bodies[members], _neighbours(tree, plans, current, members),
                           np.flatnonzero(net.building == building))
        together = _movable_together(check, walls, net, outwards, weight, movable)
        immovable[np.setdiff1d(movable, together)] = True
        chosen = np.zeros_like(weight)
        chosen[together] = weight[together]
        by = net.displacement(walls, outwards, chosen)
        displacement[check.nodes] = by[check.nodes]
        current[members] = check.translated(walls, net, by)
    return current, displacement, immovable


def _movable_together(check: _MoveCheck, walls: WallPieces, net: PlanNet, outwards: np.ndarray, weight: np.ndarray,
                      movable: np.ndarray) -> np.ndarray:
    """Those of the movable walls that can be moved together: all, or the surest ones one after another."""

    def passes(chosen: np.ndarray) -> bool:
        only = np.zeros_like(weight)
        only[chosen] = weight[chosen]
        return check.accepts(walls, net, net.displacement(walls, outwards, only))

    if passes(movable):
        return movable
    together = np.zeros(0, np.int64)
    for wall in movable[np.argsort(-weight[movable], kind="stable")]:
        trial = np.append(together, wall)
        if passes(trial):
            together = trial
    return np.sort(together)


@dataclass(frozen=True)
class _MoveCheck:
    """Tests whether a building may be moved: its shapes, what stands beside it, its nodes."""

    shapes: np.ndarray
    beside: shapely.Geometry
    nodes: np.ndarray

    def translated(self, walls: WallPieces, net: PlanNet, displacement: np.ndarray) -> np.ndarray:
        """The shapes with their corners moved."""
        follow = _Follower(walls, net, displacement, self.nodes)
        result = np.empty(len(self.shapes), dtype=object)
        for i, shape in enumerate(self.shapes):
            result[i] = None if shape is None else shapely.transform(shape, follow, include_z=shape.has_z)
        return result

    def accepts(self, walls: WallPieces, net: PlanNet, displacement: np.ndarray) -> bool:
        """Whether edges keep their direction, shapes their validity, and no building is run into."""
        pieces = np.flatnonzero(np.isin(net.start, self.nodes))
        edge = walls.end[pieces] - walls.start[pieces]
        length = np.linalg.norm(edge, axis=1)
        after = edge + displacement[net.end[pieces]] - displacement[net.start[pieces]]
        along = np.einsum("ij,ij->i", after, edge) / length
        if (along < np.minimum(SHORTEST_EDGE, length) - 1e-6).any():
            return False
        moved = self.translated(walls, net, displacement)
        return all(_sound(before, after) for before, after in zip(self.shapes, moved)) and (
            self._overlap(moved) <= self._overlap(self.shapes) + OVERLAP)

    def _overlap(self, shapes: np.ndarray) -> float:
        """Area in common with other buildings and between its own parts, m2."""
        plans = [plan for plan in map(_plan, shapes) if plan is not None]
        union = shapely.union_all(plans)
        return sum(plan.area for plan in plans) - union.area + shapely.intersection(union, self.beside).area


class _Follower:
    """Moves coordinates (k, 2 or 3) with the corners of a building."""

    def __init__(self, walls: WallPieces, net: PlanNet, displacement: np.ndarray, nodes: np.ndarray):
        self._tree = cKDTree(net.node[nodes])
        self._by = displacement[nodes]
        pieces = np.flatnonzero(np.isin(net.start, nodes))
        self._edges = shapely.linestrings(np.stack([walls.start[pieces], walls.end[pieces]], axis=1))
        self._ends = displacement[net.start[pieces]], displacement[net.end[pieces]]

    def __call__(self, coordinates: np.ndarray) -> np.ndarray:
        moved = coordinates.copy()
        distance, nearest = self._tree.query(coordinates[:, :2])
        at_node = distance < 2 * NODE
        moved[at_node, :2] += self._by[nearest[at_node]]
        for corner in np.flatnonzero(~at_node):
            moved[corner, :2] += self._beside(shapely.Point(coordinates[corner, :2]))
        return moved

    def _beside(self, point: shapely.Point) -> np.ndarray:
        """How a corner moves that lies on an edge between nodes; one on no edge stays."""
        away = shapely.distance(self._edges, point)
        edge = int(away.argmin())
        if away[edge] > ON_EDGE:
            return np.zeros(2)
        share = shapely.line_locate_point(self._edges[edge], point, normalized=True)
        return (1 - share) * self._ends[0][edge] + share * self._ends[1][edge]


def _sound(before: shapely.Geometry | None, after: shapely.Geometry | None) -> bool:
    """Whether a moved shape has no fault that it did not have before, and at least half of its area."""
    if before is None:
        return True
    if is_solid(before):
        if _faults(after) - _faults(before):
            return False
    elif before.is_valid and not after.is_valid:
        return False
    return _plan(after).area > 0.5 * _plan(before).area


def _faults(shape: shapely.Geometry) -> set[int]:
    """Codes of what is wrong with the solids of a MultiPolygonZ."""
    return {problem.code for solid in solids_of(shape) for problem in check_solid(solid)}


def _plan(shape: shapely.Geometry | None) -> shapely.Geometry | None:
    """Ground plan of an outline or of the faces of a solid."""
    if shape is None or shape.is_empty:
        return None
    flat = shapely.get_parts(shapely.force_2d(shape))
    flat = flat[shapely.area(flat) > LEAST_FACE]
    return shapely.union_all(shapely.make_valid(flat))


def _neighbours(tree: shapely.STRtree, plans: list, current: np.ndarray, members: np.ndarray) -> shapely.Geometry:
    """Ground plan, as it is now, of what stands within 5 m of the shapes `members`."""
    area = shapely.union_all([shapely.buffer(plans[i], 5.0) for i in members if plans[i] is not None])
    near = np.setdiff1d(tree.query(area, predicate="intersects"), members)
    return shapely.union_all([_plan(current[i]) for i in near])


def _joined(node: np.ndarray, building: np.ndarray) -> np.ndarray:
    """For each corner the number of the first one of its building within the width of a node."""
    first = np.arange(len(node))
    for a, b in sorted(cKDTree(node).query_pairs(NODE)):
        if building[a] == building[b]:
            first[b] = min(first[b], first[a])
    return first


def _lines(walls: WallPieces) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Line of each wall, which side it faces, and the normals of the lines."""
    length = np.linalg.norm(walls.end - walls.start, axis=1)
    order = np.lexsort((-length, walls.wall))
    longest = order[np.searchsorted(walls.wall[order], np.arange(walls.count))]
    building, normal = walls.building[longest], walls.normal[longest]
    place = (walls.start[longest] + walls.end[longest]) / 2
    line, facing = np.full(walls.count, -1), np.ones(walls.count)
    normals: list[np.ndarray] = []
    for wall in np.argsort(-length[longest], kind="stable"):
        if line[wall] >= 0:
            continue
        cosine = normal @ normal[wall]
        same = (line < 0) & (building == building[wall]) & (np.abs(cosine) > _PARALLEL)
        same &= np.abs((place - place[wall]) @ normal[wall]) < SAME_LINE
        line[same], facing[same] = len(normals), np.sign(cosine[same])
        normals.append(normal[wall])
    return line, facing, np.array(normals)
