"""Models of all buildings merged with the measured walls below a height (J 5.7, figure 5-12).

Below the height the plan's outer edges lie on the measured walls, above it the model from the air stays as it was;
what stands out or back at the height becomes a level overhang or ledge. Sloped roofs go on to the moved walls where a
building lies below the height as a whole, and stay as they were where they lie above it as a whole: the cut is made
below the lowest of them. Every result is checked like any other solid; a building that
cannot be merged keeps its model and says why.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import shapely

from ...errors import InputError, InsufficientDataError
from ...execution import in_order
from ...geometry.short_sides import without_short_sides
from ...geometry.solid import Solid
from ...geometry.solid_faces import solids_of
from ...progress import SILENT, Progress
from ...settings.buildings import MergeSettings
from ...wording import mark, say
from ..solids.sloped_solid import SlopedCell, sloped_solids
from ..solids.validity import check_solid
from .cut_solid import cut_height, on_the_grid, with_sloped_top
from .layered_solid import Prism, layered_solids, solid_volume
from .model_parts import ModelParts, model_parts
from .plan_edges import Line, PlanEdges
from .satellite_walls import SatelliteIndex, SatelliteWall, with_satellites
from .wall_match import (
    FOLDED,
    JAVANMARDI,
    KEPT,
    MOVED,
    NEIGHBOUR,
    EdgeMatch,
    MeasuredWall,
    WallIndex,
    match_edge,
    steps_along,
)

MERGED, UNCHANGED, NOT_MERGED = "merged", "unchanged", mark("not merged")
"""Status of a building: on measured walls; no wall moved it (or all fitted); kept as it was, as it cannot be merged."""

# A roof up to this far above the height (m) belongs below it: no thin slice of the old plan stays on top.
LOW = 0.5
# Neighbours may share a strip this wide (m) more than before: walls are measured to no less.
TOUCH = 0.02
# Those that overlap already do so by what their outlines are rough: two walls of 0.02 m each, two sigma, are this.
TURN = 0.05
MAX_ITERATIONS = 20
LIFT = 0.01


@dataclass(frozen=True, eq=False)
class EdgeResult:
    """One outer edge of a model: its wall below the height as PolygonZ, what was measured of it, its heights, m."""

    wall: shapely.Polygon
    match: EdgeMatch
    length: float


@dataclass(frozen=True, eq=False)
class MergedBuilding:
    """A building after merging.

    Attributes
    ----------
    building_id : its number.
    solids : closed solids; the old ones where it could not be merged, empty without a model.
    status, reason : in words.
    base : of the ground, m.
    edges : all outer edges.
    valid : whether the solids passed the check.
    volume, volume_before : m3.
    """

    building_id: int
    solids: tuple[Solid, ...]
    status: str
    reason: str
    base: float = math.nan
    edges: tuple[EdgeResult, ...] = ()
    valid: bool = False
    volume: float = math.nan
    volume_before: float = math.nan


@dataclass(frozen=True, eq=False)
class _Plan:
    """A building while it is being merged; `cut`: the height (m) above which its sloped roofs stay as they are."""

    building_id: int
    geometry: shapely.Geometry | None
    parts: ModelParts
    edges: PlanEdges | None = None
    matches: tuple[EdgeMatch, ...] = ()
    reason: str = ""
    cut: float | None = None

    @property
    def lines(self) -> dict[int, Line]:
        """Edges that move, with their new lines."""
        return {number: match.line for number, match in enumerate(self.matches) if match.status == MOVED}

    def stopped(self, numbers: Sequence[int], status: str, note: str) -> _Plan:
        """The same with some edges left where they are."""
        matches = list(self.matches)
        for number in numbers:
            matches[number] = replace(matches[number], status=status, note=note)
        return replace(self, matches=tuple(matches))


def merge_models(ids: Sequence[int], models: Sequence[shapely.Geometry | None], walls: Sequence[MeasuredWall],
                 settings: MergeSettings = JAVANMARDI, executor: Executor | None = None,
                 progress: Progress = SILENT, satellites: Sequence[SatelliteWall] = ()) -> list[MergedBuilding]:
    """Merge models with measured walls, in the order given.

    Parameters
    ----------
    ids, models : number of each building and all faces of its solids (MultiPolygonZ), None without a model.
    walls : measured walls in the same CRS.
    satellites : walls by satellites, which move edges along which nothing was measured.

    Raises
    ------
    InputError : two buildings have the same number, or one has no heights.
    InsufficientDataError : there is no wall, or no wall lies near any model.
    """
    if len(set(ids)) < len(ids):
        raise InputError(say("Two buildings have the same building_id: give each building its own."))
    if not walls:
        raise InsufficientDataError(say("There are no measured walls: run “Walls from a mobile survey” first and "
                                        "check that it found any."))
    flat = [number for number, model in zip(ids, models) if model is not None and not model.has_z]
    if flat:
        raise InputError(say("Building {flat} has no heights: give building models (MultiPolygonZ), not outlines.",
                             flat=flat[0]))
    index, weak = WallIndex(walls), SatelliteIndex(satellites)
    boxes = [shapely.box(*model.bounds) for model in models if model is not None and not model.is_empty]
    if boxes and not len(index.tree.query(boxes, predicate="dwithin", distance=settings.max_offset)[0]):
        raise InsufficientDataError(say("No measured wall lies near any model: check that both are of the same "
                                        "place, and that the survey has been put on the map."))
    plans = []
    work = partial(_matched, index=index, weak=weak, settings=settings)
    for number, plan in enumerate(in_order(work, zip(ids, models), executor, progress.check)):
        plans.append(plan)
        progress.step(0.4 * number / len(ids))
    plans = _clear_of_neighbours(plans, progress.part(0.4, 0.5))
    merged = []
    for number, building in enumerate(in_order(partial(_merged, settings=settings), plans, executor, progress.check)):
        merged.append(building)
        progress.step(0.5 + 0.5 * number / len(ids))
    return merged


def _matched(piece: tuple[int, shapely.Geometry | None], index: WallIndex, weak: SatelliteIndex,
             settings: MergeSettings) -> _Plan:
    """A building's plan with what was measured of each outer edge; edges that would fold the plan are left."""
    building_id, geometry = piece
    if geometry is None or geometry.is_empty:
        return _Plan(building_id, None, ModelParts(math.nan, ()), reason=say("it has no model"))
    parts = model_parts(list(shapely.get_parts(shapely.get_parts(geometry))))
    if parts.problem:
        return _Plan(building_id, geometry, parts, reason=parts.problem)
    cut = None
    if parts.sloped and max(cell.height for cell in parts.cells) > parts.base + settings.height + LOW:
        cut = cut_height(parts, parts.base + settings.height)
        if cut is None:
            return _Plan(building_id, geometry, parts, reason=say("it has sloped roofs and is higher than the walls "
                                                                  "are taken"))
        parts = replace(parts, cells=tuple(replace(cell, polygon=on_the_grid(cell.polygon)) for cell in parts.cells))
        settings = replace(settings, height=cut - parts.base)
    edges = PlanEdges(parts.cells)
    heights = [min(top, parts.base + settings.height) for top in _tops(edges, parts)]
    breaks = [edge.ends[0] + at * edge.line.along for edge, top in zip(edges.edges, heights)
              for at in steps_along(edge, index, parts.base, top, settings)]
    if breaks:
        edges = PlanEdges(parts.cells, np.array(breaks))
        heights = [min(top, parts.base + settings.height) for top in _tops(edges, parts)]
    matches = tuple(with_satellites(edge, match_edge(edge, index, parts.base, top, settings), weak, settings)
                    for edge, top in zip(edges.edges, heights))
    plan = _Plan(building_id, geometry, parts, edges, matches, cut=cut)
    while plan.lines and edges.moved_polygons(plan.lines) is None:
        weakest = _weakest(plan)
        plan = plan.stopped([weakest], FOLDED, "the plan would fold over itself")
    return plan


def _weakest(plan: _Plan) -> int:
    """The moved edge with the least evidence: measured length, then area."""
    return min(plan.lines, key=lambda number: (plan.matches[number].measured * plan.edges.edges[number].length,
                                               plan.matches[number].wall.area, number))


def _tops(edges: PlanEdges, parts: ModelParts) -> list[float]:
    """Highest roof along each outer edge, m."""
    tops = []
    for edge in edges.edges:
        cells = {edges.owner[pair] for pair in zip(edge.nodes[:-1], edge.nodes[1:]) if pair in edges.owner}
        tops.append(max((parts.cells[cell].height for cell in cells), default=parts.base))
    return tops


def _clear_of_neighbours(plans: list[_Plan], progress: Progress) -> list[_Plan]:
    """Leave edges in their places that would run into a neighbour, moved or not."""
    rows = [row for row, plan in enumerate(plans) if plan.geometry is not None and plan.edges is not None]
    before = {row: shapely.union_all([cell.polygon for cell in plans[row].parts.cells]) for row in rows}
    after = {row: _union(plans[row]) for row in rows}
    for _ in range(MAX_ITERATIONS):
        changed = False
        tree = shapely.STRtree([shapely.union(before[row], after[row]) for row in rows])
        pairs = tree.query(tree.geometries, predicate="intersects")
        for i, j in pairs.T.tolist():
            progress.check()
            one, two = rows[i], rows[j]
            if i == j or not plans[one].lines:
                continue
            # Above the height the plans are as they were: only what lies below can run into each other.
            gained = _gained(before[one], before[two], after[one], after[two])
            if gained.is_empty:
                continue
            intruding = _intruding(plans[one], gained)
            if intruding:
                plans[one] = plans[one].stopped(intruding, NEIGHBOUR, say("the measured wall lies in the neighbour "
                                                                          "{building_id}",
                                                                          building_id=plans[two].building_id))
                after[one] = _union(plans[one])
                changed = True
        if not changed:
            return plans
    return plans


def _gained(before: shapely.Geometry, beside_before: shapely.Geometry, after: shapely.Geometry,
            beside_after: shapely.Geometry) -> shapely.Geometry:
    """Place that two neighbours share and did not share before; empty where they share no more in all, or a strip that
    is nowhere wider than `TOUCH`, or `TURN` where they overlap already: rough outlines overlap by
    metres, whose borders turn with the walls."""
    shared, common = shapely.intersection(before, beside_before), shapely.intersection(after, beside_after)
    gained = shapely.difference(common, shared)
    width = TOUCH if shared.area == 0.0 else TURN
    more = common.area > shared.area and not shapely.is_empty(shapely.buffer(gained, -width / 2))
    return gained if more else shapely.Polygon()


def _union(plan: _Plan) -> shapely.Geometry:
    """Plan of a building with its edges moved."""
    cells = plan.edges.moved_polygons(plan.lines)
    return shapely.union_all([cell.polygon for cell in plan.parts.cells] if cells is None else cells)


def _intruding(plan: _Plan, common: shapely.Geometry) -> list[int]:
    """The edge moved outwards that swept most of a place; all that moved outwards where none did."""
    outwards = [number for number in plan.lines if plan.matches[number].offset > 0]
    swept = {}
    for number in outwards:
        ends, line = plan.edges.edges[number].ends, plan.lines[number]
        strip = shapely.convex_hull(shapely.multipoints([*ends, *(line.foot(end) for end in ends)]))
        swept[number] = shapely.intersection(strip, common).area
    worst = max(swept, key=lambda number: (swept[number], -number), default=None)
    return [worst] if worst is not None and swept[worst] > 0 else outwards


def _merged(plan: _Plan, settings: MergeSettings) -> MergedBuilding:
    """The building's solids on the measured walls, or as they were."""
    if plan.geometry is None:
        return MergedBuilding(plan.building_id, (), NOT_MERGED, plan.reason)
    if plan.cut is not None:
        settings = replace(settings, height=plan.cut - plan.parts.base)
    old = tuple(solids_of(plan.geometry))
    before = sum(solid_volume(solid) for solid in old)
    if plan.edges is None:
        return MergedBuilding(plan.building_id, old, NOT_MERGED, plan.reason, plan.parts.base,
                              valid=_valid(old), volume=before, volume_before=before)
    trouble = ""
    while plan.lines:
        solids, problem = _checked(plan, settings)
        if not problem:
            return MergedBuilding(plan.building_id, solids, MERGED, trouble and "some walls stay, as no valid solid "
                                  "could be made with them", plan.parts.base, _edges(plan, settings), True,
                                  sum(solid_volume(solid) for solid in solids), before)
        trouble = trouble or problem
        plan = plan.stopped([_weakest(plan)], FOLDED, say("no valid solid could be made with it ({trouble})",
                                                          trouble=trouble))
    status, reason = (NOT_MERGED, say("no valid solid could be made with the measured walls ({trouble})",
                                      trouble=trouble)) if trouble \
        else (UNCHANGED, _why_unchanged(plan))
    return MergedBuilding(plan.building_id, old, status, reason, plan.parts.base, _edges(plan, settings),
                          _valid(old), before, before)


def _checked(plan: _Plan, settings: MergeSettings) -> tuple[tuple[Solid, ...], str]:
    """The solids of a plan with its edges moved, and what the check says against them, "" if nothing."""
    problem = ""
    lifts = (0.0,) if plan.parts.sloped and plan.cut is None else (0.0, LIFT)
    # Corners a centimetre apart are made one where a valid solid comes of it, else they stay.
    for short_sides, lift in itertools.product((False, True), lifts):
        try:
            solids = _plan_solids(plan, settings, lift, short_sides)
        except (InputError, ValueError) as error:
            if not short_sides:
                continue
            return (), str(error)
        problems = [problem for solid in solids for problem in check_solid(solid)]
        if not problems:
            return solids, ""
        problem = problem or f"{problems[0].code} {problems[0].name}"
    return (), problem


def _plan_solids(plan: _Plan, settings: MergeSettings, lift: float, short_sides: bool) -> tuple[Solid, ...]:
    """The solids of a plan with its edges moved: of level roofs, under sloped ones, or cut at a height."""
    if plan.cut is not None:
        return _cut_solids(plan, settings, lift, short_sides)
    if plan.parts.sloped:
        return _under_slopes(plan, short_sides)
    return layered_solids(_prisms(plan, settings), lift, short_sides)


def _cut_solids(plan: _Plan, settings: MergeSettings, lift: float, short_sides: bool) -> tuple[Solid, ...]:
    """Measured walls up to the cut, and above it the sloped roofs as they were."""
    parts, cut = plan.parts, plan.cut
    tall = [cell.height > cut for cell in parts.cells]
    level = tuple(replace(cell, height=cut + 4 * LOW) if high else cell for cell, high in zip(parts.cells, tall))
    lower = layered_solids(_prisms(replace(plan, parts=replace(parts, cells=level)), settings), lift, short_sides)
    roofs = [SlopedCell(piece, cell.roof_id, plane, parts.origin)
             for cell, plane, high in zip(parts.cells, parts.planes, tall) if high
             for piece in _pieces(cell.polygon)]
    return with_sloped_top(lower, roofs, cut)


def _valid(solids: Sequence[Solid]) -> bool:
    return bool(solids) and not any(check_solid(solid) for solid in solids)


def _why_unchanged(plan: _Plan) -> str:
    states = {match.status for match in plan.matches}
    if KEPT in states:
        return say("the measured walls fit the model")
    if states == {"not seen"}:
        return say("no measured wall runs along it")
    return say("its measured walls are beyond the limits")


def _under_slopes(plan: _Plan, short_sides: bool) -> tuple[Solid, ...]:
    """Solids under sloped roofs, whose planes go on to the moved walls."""
    moved = plan.edges.moved_polygons(plan.lines)
    if moved is None:
        raise InputError(say("the plan would fold over itself"))
    if not short_sides:
        moved = without_short_sides(moved)
    parts = plan.parts
    return sloped_solids([SlopedCell(piece, cell.roof_id, plane, parts.origin)
                          for polygon, cell, plane in zip(moved, parts.cells, parts.planes)
                          for piece in _pieces(polygon)], parts.base)


def _prisms(plan: _Plan, settings: MergeSettings) -> list[Prism]:
    """The building as prisms: measured plan below the height, old plan above, roofs that stand out as slabs."""
    base = plan.parts.base
    cut = base + settings.height
    below = plan.edges.moved_polygons(plan.lines)
    hanging = {number for number, match in enumerate(plan.matches)
               if match.status == MOVED and match.offset < -settings.overhang}
    roofs = plan.edges.moved_polygons({number: line for number, line in plan.lines.items() if number not in hanging})
    if below is None or roofs is None:
        raise InputError(say("the plan would fold over itself"))
    slabs = _slabs(plan, hanging, settings)
    prisms: list[Prism] = []
    for number, cell in enumerate(plan.parts.cells):
        old, name = _pieces(cell.polygon), (cell.roof_id,)
        if cell.height > cut + LOW:
            prisms += [Prism(piece, base, cut) for piece in _pieces(below[number])]
            prisms += [Prism(piece, cut, cell.height, *name) for piece in old]
            continue
        prisms += [Prism(piece, base, cell.height, *name) for piece in _pieces(below[number])]
        if number in slabs:
            foot = max(cell.height - slabs[number], base + 0.5 * (cell.height - base))
            prisms += [Prism(piece, foot, cell.height, *name) for piece in _pieces(roofs[number])]
    return prisms


def _pieces(plan: shapely.Geometry) -> list[shapely.Polygon]:
    return [part for part in shapely.get_parts(plan) if part.geom_type == "Polygon" and part.area > 0]


def _slabs(plan: _Plan, hanging: set[int], settings: MergeSettings) -> dict[int, float]:
    """Height of the roof's edge over the overhangs of each low cell that has any, m."""
    heights: dict[int, list[float]] = {}
    for number in hanging:
        edge, wall = plan.edges.edges[number], plan.matches[number].wall
        for pair in zip(edge.nodes[:-1], edge.nodes[1:]):
            cell = plan.edges.owner.get(pair)
            if cell is not None:
                left = plan.parts.cells[cell].height - wall.top
                heights.setdefault(cell, []).append(left if 0.1 <= left <= 1.5 else settings.slab)
    return {cell: float(min(values)) for cell, values in heights.items()}


def _edges(plan: _Plan, settings: MergeSettings) -> tuple[EdgeResult, ...]:
    """The outer edges where they lie now, as walls from the ground to the roof or the height."""
    results = []
    tops = _tops(plan.edges, plan.parts)
    places = plan.edges.ends_after(plan.lines)
    for edge, match, top, (start, end) in zip(plan.edges.edges, plan.matches, tops, places):
        low, high = plan.parts.base, min(top, plan.parts.base + settings.height)
        corners = [(*start, low), (*end, low), (*end, high), (*start, high)]
        results.append(EdgeResult(shapely.Polygon(corners), match, edge.length))
    return tuple(results)


MODEL_COLUMNS = ("building_id", "status", "reason", "valid", "walls", "walls_moved", "measured", "mean_offset",
                 "max_offset", "base", "height", "volume", "volume_change")
"""Names of the columns of merged models."""

EDGE_COLUMNS = ("building_id", "edge", "status", "note", "wall", "length", "offset", "turn", "seen", "rmse", "sigma")
"""Names of the columns of a merged model's walls."""


def merged_columns(buildings: Sequence[MergedBuilding]) -> dict[str, list]:
    """Columns of `MODEL_COLUMNS`: measured is the share of the outer walls' length that lies on measured walls;
    offsets are those of the moved walls, m; volume_change in m3."""
    rows = []
    for building in buildings:
        moved = [edge for edge in building.edges if edge.match.status == MOVED]
        on_walls = sum(edge.length for edge in building.edges
                       if edge.match.status in (MOVED, KEPT) and edge.match.wall.number >= 0)
        whole = sum(edge.length for edge in building.edges)
        offsets = [abs(edge.match.offset) for edge in moved]
        top = max((float(solid.vertices[:, 2].max()) for solid in building.solids), default=math.nan)
        rows.append((building.building_id, building.status, building.reason, building.valid, len(building.edges),
                     len(moved), on_walls / whole if whole else math.nan,
                     float(np.mean(offsets)) if offsets else math.nan, max(offsets, default=math.nan), building.base,
                     top - building.base, building.volume, building.volume - building.volume_before))
    return _columns(MODEL_COLUMNS, rows)


def edge_columns(buildings: Sequence[MergedBuilding]) -> dict[str, list]:
    """Columns of `EDGE_COLUMNS`, one entry an outer edge; `wall` is the row of the measured wall, from 1, empty
    where satellites tell it."""
    rows = []
    for building in buildings:
        for number, edge in enumerate(building.edges, 1):
            match, wall = edge.match, edge.match.wall
            rows.append((building.building_id, number, match.status, match.note,
                         wall.number + 1 if wall and wall.number >= 0 else None, edge.length, match.offset,
                         match.rotation, match.measured, wall.rmse if wall else math.nan,
                         wall.sigma if wall else math.nan))
    return _columns(EDGE_COLUMNS, rows)


def _columns(names: Sequence[str], rows: Sequence[tuple]) -> dict[str, list]:
    return {name: [row[place] for row in rows] for place, name in enumerate(names)}
