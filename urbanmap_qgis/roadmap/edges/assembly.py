"""Lines from measured stations: kerbs and lowered places as sections, gaps left open."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...settings.roadmap import EdgeSettings
from ...wording import say
from .courses import STATION
from .edge_records import DOUBTFUL, KERB, LOWERED, MEASURED, RoadEdge
from .stations import Stations

BRIDGED = 2
"""Stations without a measurement over which a line is drawn; over more it has a gap."""


@dataclass(frozen=True)
class EdgesAssemblyLimits:
    """Limits of edges assembly, each with its unit."""

    lowered_share: float = 0.55  # A kerb is lowered where it is lower than this share of its usual height.
    shortest_lowered: float = 1.5  # m.
    window: int = 6  # stations to either side that tell where a station ought to lie
    stray: float = 0.08  # m; a station farther from its neighbours' line is none of theirs
    stray_end: float = 0.15  # m; the same at the ends of a course, which may bend
    unsure: float = 0.03  # m; sigma from which an edge is doubtful
    tallest: float = 1.2  # share of the highest kerb
    fewest: int = 3  # stations
    low: float = 0.06  # m; so low a step hardly shows where it is
    high_share: float = 0.2  # With fewer sure stations higher than that a kerb is low all along.
    carried: float = 0.02  # m, least sigma of a place that is carried over from the kerb beside
    few: float = 0.6  # completeness
    scale: float = 1.3  # profiles of neighbouring stations share points and the shape of the road


LIMITS = EdgesAssemblyLimits()

GAP, FULL, LOW, UNSURE = 0, 1, 2, 3


def kerb_lines(stations: Stations, settings: EdgeSettings, corner: np.ndarray, first_chain: int = 0
               ) -> list[RoadEdge]:
    """Kerbs of all courses; coordinates are moved by `corner` (3,)."""
    edges = []
    for course in np.unique(stations.course).tolist():
        rows = np.flatnonzero(stations.course == course)
        parts = list(_sections(stations, rows, settings))
        found = [_edge(stations, kind, part, corner, first_chain + course) for kind, part in parts]
        sure = sum(edge.length for edge in found if edge.status == MEASURED and edge.kind == KERB)
        if sure > 0 and sum(edge.length for edge in found) >= settings.min_length:
            edges += _with_gaps(found)
    return edges


def _sections(stations: Stations, rows: np.ndarray, settings: EdgeSettings) -> Iterator[tuple[int, np.ndarray]]:
    """Sections of a course: FULL, LOW or UNSURE, and their rows; neighbouring ones share a station."""
    stations.foot[rows[stations.height[rows] > LIMITS.tallest * settings.max_height]] = np.nan
    _carry_low(stations, rows)
    _leave_out_strays(stations, rows)
    kinds = _kinds(stations, rows, settings)
    starts = np.flatnonzero(np.diff(kinds, prepend=-1))
    ends = np.append(starts[1:], len(kinds))
    for start, end in zip(starts.tolist(), ends.tolist()):
        if kinds[start] == GAP:
            continue
        goes_on = end < len(kinds) and kinds[end] != GAP
        part = rows[start:end + 1 if goes_on else end]
        if np.count_nonzero(np.isfinite(stations.foot[part])) >= LIMITS.fewest:
            yield int(kinds[start]), part


def _kinds(stations: Stations, rows: np.ndarray, settings: EdgeSettings) -> np.ndarray:
    """GAP, FULL, LOW or UNSURE of each station; short stretches of the others belong to what is beside them."""
    height, measured, sigma = stations.height[rows], np.isfinite(stations.foot[rows]), stations.sigma[rows]
    known = measured & stations.seen[rows]
    usual = np.nanmedian(height[known]) if known.any() else np.nan
    low = measured & (height < max(LIMITS.lowered_share * usual, settings.min_height))
    unsure = measured & ~(sigma < LIMITS.unsure)
    kinds = np.where(measured, np.where(unsure, UNSURE, np.where(low, LOW, FULL)), GAP)
    for kind, longest in ((GAP, BRIDGED), (UNSURE, BRIDGED), (LOW, int(LIMITS.shortest_lowered / STATION) - 1),
                          (FULL, 1)):
        kinds = _absorbed(kinds, kind, longest)
    # A station that says less than its neighbours is no corner of their line.
    stations.foot[rows[unsure & (kinds != UNSURE)]] = np.nan
    return kinds


def _absorbed(kinds: np.ndarray, kind: int, longest: int) -> np.ndarray:
    """Runs of a kind of no more stations than `longest`, between two others, become what is before them."""
    kinds = kinds.copy()
    starts = np.flatnonzero(np.diff(kinds, prepend=-1))
    ends = np.append(starts[1:], len(kinds))
    for start, end in zip(starts.tolist(), ends.tolist()):
        inside = start > 0 and end < len(kinds) and kinds[start - 1] != GAP and kinds[end] != GAP
        if kinds[start] == kind and end - start <= longest and inside:
            kinds[start:end] = kinds[start - 1]
    return kinds


def _expected(stations: Stations, rows: np.ndarray, number: int, use: np.ndarray, column: np.ndarray) -> float:
    """Where a station of a course ought to lie across, by its neighbours; NaN where they are too few or turn away.

    `use` (k,) which of the course's stations may tell. Offsets across are taken along the station's own normal.
    """
    near = np.arange(max(number - LIMITS.window, 0), min(number + LIMITS.window + 1, len(rows)))
    near = near[use[near] & (near != number)]
    row, others = rows[number], rows[near]
    normal = stations.normal[row]
    offset = stations.place[others] + column[others, None] * stations.normal[others] - stations.place[row]
    along, across = offset @ np.array([-normal[1], normal[0]]), offset @ normal
    if len(near) < 4 or np.ptp(across) > 0.25 * np.ptp(along):
        return np.nan
    if along.min() < 0 < along.max():
        order = np.argsort(along)
        return float(np.interp(0.0, along[order], across[order]))
    return float(np.polyval(np.polyfit(along, across, 1), 0.0))


def _carry_low(stations: Stations, rows: np.ndarray) -> None:
    """Steps too low to show their place lie where the kerb beside them leads; a kerb that is low all along lies where
    its own profiles show it."""
    middle = 0.5 * (stations.foot + stations.top)
    height = stations.height
    sure = np.isfinite(stations.sigma[rows]) & (height[rows] >= LIMITS.low) & (stations.sigma[rows] < LIMITS.carried)
    if sure.sum() < LIMITS.high_share * np.isfinite(stations.foot[rows]).sum():
        own = stations.sigma[rows]
        stations.sigma[rows] = np.where(np.isnan(own), 2 * LIMITS.unsure, np.fmax(own, LIMITS.carried))
        return
    for number in np.flatnonzero(np.isfinite(stations.foot[rows]) & ~sure & (height[rows] < LIMITS.low)).tolist():
        row = rows[number]
        wide = np.flatnonzero(sure)
        before, after = wide[wide < number][-4:], wide[wide > number][:4]
        if len(before) < 2 or len(after) < 2 or after[0] - before[-1] > 24:
            stations.sigma[row] = np.fmax(stations.sigma[row], 2 * LIMITS.unsure)
            continue
        others = rows[np.concatenate([before, after])]
        normal = stations.normal[row]
        offset = stations.place[others] + middle[others, None] * stations.normal[others] - stations.place[row]
        along, across = offset @ np.array([-normal[1], normal[0]]), offset @ normal
        line = np.polyfit(along, across, 1)
        stations.foot[row] = stations.top[row] = line[1]
        stations.sigma[row] = max(float(np.std(across - np.polyval(line, along))), LIMITS.carried)


def _leave_out_strays(stations: Stations, rows: np.ndarray) -> None:
    """Take out stations that lie beside the line of their neighbours."""
    middle = 0.5 * (stations.foot + stations.top)
    use = np.isfinite(stations.foot[rows])
    for number in np.flatnonzero(use).tolist():
        expected = _expected(stations, rows, number, use, middle)
        inside = use[:number].any() and use[number + 1:].any()
        limit = max(LIMITS.stray if inside else LIMITS.stray_end, 3 * np.nan_to_num(stations.sigma[rows[number]]))
        if np.isfinite(expected) and abs(middle[rows[number]] - expected) > limit:
            stations.foot[rows[number]] = stations.top[rows[number]] = np.nan


def _edge(stations: Stations, kind: int, part: np.ndarray, corner: np.ndarray, chain: int) -> RoadEdge:
    """A line of stations; those without a measurement are left out of it."""
    measured = part[np.isfinite(stations.foot[part])]
    sides = []
    for name in ("foot", "top"):
        across, z = getattr(stations, name)[measured], getattr(stations, f"z_{name}")[measured]
        plan = stations.place[measured] + across[:, None] * stations.normal[measured]
        sides.append(np.column_stack([plan, z]) + corner)
    sigma = LIMITS.scale * float(np.sqrt(np.mean(stations.sigma[measured]**2)))
    completeness = len(measured) / len(part)
    status, reason = MEASURED, ""
    if kind == UNSURE:
        status, reason = DOUBTFUL, say("its face is not seen: it lies between the last points before and the first "
                                       "behind")
    elif completeness < LIMITS.few:
        status, reason = DOUBTFUL, say("most of it is hidden")
    height = float(np.median(stations.height[measured]))
    lowered = kind == LOW or (kind == UNSURE and height < LIMITS.low)
    return RoadEdge(LOWERED if lowered else KERB, *sides, height, sigma,
                    LIMITS.scale * float(np.sqrt(np.mean(stations.sigma_z[measured]**2))),
                    int(stations.points[measured].sum()), int(stations.passes[measured].max()), completeness, chain,
                    0.0, status, reason)


def _with_gaps(edges: list[RoadEdge]) -> list[RoadEdge]:
    """The same with the way from each to the next one of its chain."""
    with_gaps = []
    for edge, following in zip(edges, [*edges[1:], None]):
        gap = 0.0 if following is None else float(np.hypot(*(following.foot[0] - edge.foot[-1])[:2]))
        with_gaps.append(RoadEdge(**{**edge.__dict__, "gap": gap}))
    return with_gaps
