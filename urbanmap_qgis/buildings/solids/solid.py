"""Closed solids from the cells of a plan: roofs at their heights, walls between them, one ground (J 5.3.4)."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from ...geometry.solid import INNER_WALL, OUTER_WALL, ROOF, Solid
from ...geometry.tolerances import UNITS
from .face_collector import FaceCollector, edges_of_cells
from .half_edges import HalfEdges, connected_cells
from .manifold import PlanRepair, repair_plan
from .plan_partition import Cell

MIN_STEP = 0.05
"""Roofs nearer in height than this (m) become one level: no step or inner wall below it is kept. Laser heights do not
show such steps, and validators join vertices of 1 mm."""


def building_solids(cells: Sequence[Cell], base_height: float, *, least_height: float = 0.1,
                    least_step: float = MIN_STEP) -> tuple[Solid, ...]:
    """Raise the cells of a plan to solids, one for each part whose cells hang together by edges.

    Parameters
    ----------
    cells : cells of one building, edge by edge beside each other (`partition_plan`).
    base_height : height of the ground face, m.
    least_height : a roof less than this above the base is put there (m); the solid counts them.
    least_step : roofs whose heights differ by less than this (m) get the same height.

    Raises
    ------
    InputError : the base height is not finite, or cells overlap.
    """
    edges = edges_of_cells(cells, base_height)
    if edges is None:
        return ()
    base = round(base_height * UNITS)
    heights, raised = _levels([cell.height for cell in cells], base, least_height, least_step)
    solids = []
    for part in connected_cells(edges, len(cells)):
        directed = {edge: cell for edge, cell in edges.cell.items() if cell in part}
        piece = HalfEdges(edges.origin, edges.resolution, edges.x, edges.y, directed)
        repair = repair_plan(piece, heights, base)
        faces = _LevelFaces(piece, heights, base, [cell.roof_id for cell in cells])
        solids.append(faces.solid(repair, sum(raised[cell] for cell in part)))
    return tuple(solids)


def _levels(heights: Sequence[float], base: int, least_height: float, least_step: float):
    """Heights in lattice units: `least_height` or more over the base, `least_step` or more apart; which were raised."""
    lowest = base + max(round(least_height * UNITS), 1)
    units = [round(height * UNITS) for height in heights]
    raised = [unit < lowest for unit in units]
    units = [max(unit, lowest) for unit in units]
    level: dict[int, int] = {}
    last = None
    for unit in sorted(set(units)):
        if last is None or unit - last >= round(least_step * UNITS):
            last = unit
        level[unit] = last
    return [level[unit] for unit in units], raised


class _LevelFaces(FaceCollector):
    """The faces under level roofs."""

    def __init__(self, edges: HalfEdges, heights: Sequence[int], base: int, roof_ids: Sequence[Hashable]):
        super().__init__(edges, base)
        self.heights, self.roof_ids = heights, roof_ids

    def solid(self, repair: PlanRepair, raised: int) -> Solid:
        """The finished solid: ground, roofs, walls."""
        self.add_ground()
        for cell, directed in self.cells().items():
            for rings in self.shapes(directed):
                self.add([[(node, self.heights[cell]) for node in ring] for ring in rings], ROOF, self.roof_ids[cell])
        self._walls()
        return Solid(self.vertices(), tuple(self.faces), tuple(self.types), tuple(self.ids),
                     repair.cut_nodes, repair.levelled_cells, repair.unrepaired_nodes, raised)

    def _walls(self) -> None:
        """One rectangle for each plan edge, its sides split where other walls end at the same node."""
        cell, heights = self.edges.cell, self.heights
        walls = []
        stops: dict[int, set[int]] = {}
        for (a, b), high in sorted(cell.items()):
            low = cell.get((b, a))
            bottom, top = self.base if low is None else heights[low], heights[high]
            if top > bottom:
                walls.append((a, b, bottom, top, high, OUTER_WALL if low is None else INNER_WALL))
                for node in (a, b):
                    stops.setdefault(node, set()).update((bottom, top))
        ordered = {node: sorted(levels) for node, levels in stops.items()}
        for a, b, bottom, top, high, surface_type in walls:
            rising = [(b, level) for level in ordered[b] if bottom <= level <= top]
            falling = [(a, level) for level in reversed(ordered[a]) if bottom <= level <= top]
            self.add([[*rising, *falling]], surface_type, self.roof_ids[high])
