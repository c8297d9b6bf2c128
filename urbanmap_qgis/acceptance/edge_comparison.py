"""Edges of building models compared with laser points: residuals across each edge and in height, and what they say of
the unit of inspection.

Source of the criteria: PLATEAU specification 5.0, tables P01, P02 and P05 to P08. The points show where an edge lies
across itself, not along: the standard deviation in plan is put together from edges of different directions.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from ..geometry.tolerances import ROUNDING
from ..io.points.pointcloud import PointCloud
from ..progress import SILENT, Progress
from .criteria import HEIGHT, PASSED, PLAN, Criterion
from .edge_measurement import (
    ABSENT,
    FEW,
    LEAST_DROP,
    OPEN,
    REASONS,
    ROOF_DEPTH,
    SHOWN,
    VAGUE,
    WALLS,
    MeasuredEdge,
    PointsAboutEdge,
    height_at_edge,
    roof_edge,
    wall_edge,
)
from .edge_points import EdgeFrame, ModelSurface, points_of_windows
from .edge_sampling import EDGES_OF_UNIT, MIN_LENGTH, SampledEdges
from .error_figures import ErrorFigures, across_figures, signed_figures
from .map_levels import Limits

EDGES_DRAWN = 4 * EDGES_OF_UNIT
"""Edges drawn of each unit for laser points, of which many are shared with a neighbour or not shown."""

SAME_POINTS, ABSENT_EDGES = "same points", "absent edges"

_MOST_ABSENT = 0.1  # of the edges that the points cover: with more, what is left out could be the worst
_REACH = 2.0  # m, or twice the limit where that is more: what is farther off is told as no edge
_INSIDE = 0.3  # m inside an edge at which the model's roof is taken
_MARGIN = 1.0  # m from the ends of an edge, at most a quarter of it, where the corner's other side would count
_EAVE = (0.1, 1.5)  # m inside the roof's edge between which its height is compared


@dataclass(frozen=True)
class ComparedEdges:
    """n drawn edges with what the points say of them.

    Attributes
    ----------
    drawn : the edges.
    normal : (n, 2) unit vectors outward.
    measured : (n,) by the points.
    """

    drawn: SampledEdges
    normal: np.ndarray
    measured: tuple[MeasuredEdge, ...]

    def __len__(self) -> int:
        return len(self.measured)

    @property
    def shown(self) -> np.ndarray:
        """(n,) which edges the points show."""
        return np.array([one.reason == SHOWN for one in self.measured], bool)

    @property
    def across(self) -> np.ndarray:
        """(n,) model less points across the edge, outward, m; NaN where not shown."""
        return np.array([-one.outward for one in self.measured])

    @property
    def up(self) -> np.ndarray:
        """(n,) model less points in height, m; NaN where not shown."""
        return np.array([-one.higher for one in self.measured])

    @property
    def units(self) -> tuple[str, ...]:
        """Names of the units, in their order."""
        return tuple(self.drawn.available)

    def of_unit(self, unit: str) -> np.ndarray:
        """(n,) which edges are of a unit."""
        return np.array([name == unit for name in self.drawn.unit], bool)

    def count(self, reason: str, rows: np.ndarray) -> int:
        """How many of some edges have this reason."""
        return sum(self.measured[row].reason == reason for row in np.flatnonzero(rows))


def compare_edges(drawn: SampledEdges, models: Sequence[shapely.Geometry | None], cloud: PointCloud, limits: Limits,
                  shown_by: str, progress: Progress = SILENT) -> ComparedEdges:
    """Find the drawn edges in laser points.

    Parameters
    ----------
    models : (m,) all faces of each building, which the edges were drawn from.
    cloud : points in the models' CRS, m.
    limits : of the map level: how far edges are looked for, and how sharply they must be shown.
    shown_by : ROOFS (airborne points: where roofs end) or WALLS (points from the street: faces of walls, no heights).
    """
    surface = ModelSurface(models)
    reach = max(_REACH, 2.0 * (limits.plan or 0.0))
    frames = [EdgeFrame.of(ends) for ends in drawn.ends]
    free = [_free_part(frame, surface, reach) for frame in frames]
    windows = [frame.window(reach + ROOF_DEPTH, reach) for frame, _ in filter(None, free)]
    found = iter(points_of_windows(cloud, windows, progress) if windows else [])
    measured = [MeasuredEdge(reason=OPEN) if part is None
                else _measured(part[0], part[1], next(found), surface, limits, shown_by) for part in free]
    return ComparedEdges(drawn, np.array([frame.outward for frame in frames]).reshape(-1, 2), tuple(measured))


def _free_part(frame: EdgeFrame, surface: ModelSurface, reach: float) -> tuple[EdgeFrame, float] | None:
    """The longest part of an edge, with the reach, beside which no model stands as high; None for none of
    `MIN_LENGTH`, or of half the edge where that is less."""
    margin = min(_MARGIN, frame.length / 4)
    places = np.linspace(margin, frame.length - margin, max(int(2 * (frame.length - 2 * margin)) + 1, 3))
    inside = surface.heights(frame.world(places, np.full(len(places), -_INSIDE)))
    for width in (reach, reach / 2):
        away = np.arange(_INSIDE, width + 0.25, 0.5)
        beside = surface.heights(frame.world(np.repeat(places, len(away)), np.tile(away, len(places))))
        highest = np.fmax.reduce(beside.reshape(len(places), -1), axis=1)
        first, last = _longest_run(np.isfinite(inside) & ~(highest > inside - LEAST_DROP))
        if last > first and places[last] - places[first] >= min(MIN_LENGTH, frame.length / 2) - ROUNDING:
            start = frame.world(places[first:first + 1], np.zeros(1))[0]
            return replace(frame, origin=start, length=float(places[last] - places[first])), width
    return None


def _longest_run(mask: np.ndarray) -> tuple[int, int]:
    """First and last place of the longest run of True; (0, -1) for none."""
    bounds = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(int)))
    if not len(bounds):
        return 0, -1
    starts, ends = bounds[::2], bounds[1::2]
    best = int(np.argmax(ends - starts))
    return int(starts[best]), int(ends[best]) - 1


def _measured(frame: EdgeFrame, reach: float, points: np.ndarray, surface: ModelSurface, limits: Limits,
              shown_by: str) -> MeasuredEdge:
    """What the points (n, 3) about an edge say of it."""
    if not len(points):
        return MeasuredEdge(reason=FEW)
    along, outward = frame.local(points[:, :2])
    level = surface.heights(frame.world(np.linspace(0.0, frame.length, 9), np.full(9, -_INSIDE)))
    roof = float(np.nanmedian(level)) if np.isfinite(level).any() else np.nan
    if not np.isfinite(roof):
        return MeasuredEdge(reason=FEW)
    above = points[:, 2] - _surface_at(frame, surface, along, outward, roof)
    about = PointsAboutEdge(along, outward, points[:, 2], above, reach, frame.length, roof)
    found = wall_edge(about) if shown_by == WALLS else roof_edge(about)
    if found.reason != SHOWN:
        return found
    most = np.inf if limits.plan is None else limits.plan / np.sqrt(8.0)  # half of one component's share
    if found.sigma > most:
        return replace(found, outward=np.nan, reason=VAGUE)
    return found if shown_by == WALLS else _with_height(found, frame, about, surface, limits)


def _surface_at(frame: EdgeFrame, surface: ModelSurface, along: np.ndarray, outward: np.ndarray,
                roof: float) -> np.ndarray:
    """Heights (n,) of the model's roof, m, going on outside the edge with its slope; `roof` where there is none."""
    inside = np.minimum(outward, -_INSIDE)
    heights = surface.heights(frame.world(along, inside))
    eave = np.full(len(along), -_INSIDE)
    rise = (surface.heights(frame.world(along, eave)) - surface.heights(frame.world(along, eave - 0.5))) / 0.5
    beyond = np.where(outward > -_INSIDE, np.nan_to_num(rise) * (outward + _INSIDE), 0.0)
    return np.where(np.isfinite(heights), heights + np.clip(beyond, -5.0, 5.0), roof)


def _with_height(found: MeasuredEdge, frame: EdgeFrame, about: PointsAboutEdge, surface: ModelSurface,
                 limits: Limits) -> MeasuredEdge:
    """The edge with how much higher its points are than the model as far from the model's edge."""
    inside = found.outward - about.outward
    use = (inside >= _EAVE[0]) & (inside <= _EAVE[1]) & (about.height > 0.5 * (about.roof + about.ground))
    model = surface.heights(frame.world(about.along[use], -inside[use]))
    higher, sigma = height_at_edge(about.height[use] - model)
    if limits.height is not None and sigma > limits.height / 2:
        return found
    return replace(found, higher=higher, sigma_height=sigma)


def edge_criteria(edges: ComparedEdges, limits: Limits, independent: bool) -> list[Criterion]:
    """The criteria of each unit, plan before height.

    Parameters
    ----------
    independent : whether the points are of another, more accurate survey than the models; if not, nothing is judged.
    """
    found = []
    for unit in edges.units:
        rows = edges.of_unit(unit)
        for component, figures, limit in ((PLAN, plan_figures(edges, rows), limits.plan),
                                          (HEIGHT, signed_figures(edges.up[rows]), limits.height)):
            if limit is not None:
                one = Criterion(unit, component, figures, limit, EDGES_OF_UNIT, figures.count, EDGES_OF_UNIT)
                found.append(replace(one, barred=_bar(edges, rows, one, independent)))
    return found


def _bar(edges: ComparedEdges, rows: np.ndarray, one: Criterion, independent: bool) -> str:
    """Why a criterion is not judged although there are edges enough; "" for nothing."""
    if not independent:
        return SAME_POINTS
    absent, shown = edges.count(ABSENT, rows), edges.count(SHOWN, rows)
    return ABSENT_EDGES if one.outcome == PASSED and absent > _MOST_ABSENT * (absent + shown) else ""


def plan_figures(edges: ComparedEdges, rows: np.ndarray) -> ErrorFigures:
    """Figures in plan of some edges (mask), from the residuals across them."""
    use = rows & edges.shown
    return across_figures(edges.normal[use], edges.across[use])


def shared_shift(edges: ComparedEdges, rows: np.ndarray) -> np.ndarray:
    """(3,) east, north and up, m, that the models of some edges (mask) lie off on the whole; NaN where not shown."""
    use = rows & edges.shown
    normal, across, up = edges.normal[use], edges.across[use], edges.up[use]
    known = up[np.isfinite(up)]
    height = float(np.mean(known)) if len(known) else np.nan
    if len(across) < 3 or np.linalg.cond(normal.T @ normal) > 1e3:
        return np.array([np.nan, np.nan, height])
    return np.array([*np.linalg.lstsq(normal, across, rcond=None)[0], height])


def compared_rows(edges: ComparedEdges) -> Iterator[tuple]:
    """Every drawn edge: number, building, unit, its middle (3 values, m), error across, east, north and up, sigma
    across and in height (m; NaN where not shown), points, and why it was left out."""
    middle = edges.drawn.ends.mean(axis=1)
    for row, one in enumerate(edges.measured):
        east, north = -one.outward * edges.normal[row]
        yield (row + 1, edges.drawn.building[row], edges.drawn.unit[row], *map(float, middle[row]), -one.outward,
               float(east), float(north), -one.higher, one.sigma, one.sigma_height, one.points,
               REASONS.get(one.reason, ""))
