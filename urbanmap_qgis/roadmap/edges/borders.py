"""Borders of a road without a kerb: where its smooth surface gives way to a rough one, such as grass or gravel."""

from __future__ import annotations

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...geometry.tolerances import SIGMA_OF_MAD
from ...settings.roadmap import EdgeSettings
from ...wording import say
from .courses import STATION
from .edge_points import EdgeTile
from .edge_records import BORDER, DOUBTFUL, MEASURED, EdgeCandidates, RoadEdge, joined_candidates
from .height_steps import DIRECTIONS, Strips
from .profile import HALF_LENGTH, most_likely_change
from .stations import Stations

SPAN = (0, 8)  # Cells to either side whose smoothness is compared.
SHORTEST = 5.0  # m; shorter borders are left out.
BESIDE = 1.5  # m from a kerb, rail or wall within which the ground's roughness tells nothing new.
# m; the same of neighbouring points; what scatters more is no ground
ROUGH = 0.015
ROUGHEST = 0.08
REACH = 1.0  # m
FEWEST = 12  # points of a side
NOISE = 0.004  # m
MODEL = 0.03  # m; grass does not end on a line
UNSURE = 0.15  # m
BRIDGED = 4  # stations

SMOOTHEST_ROUGH, RATIO = 0.02, 2.5
"""m that a rough surface scatters at least, and how many times what the road beside it does."""


def border_candidates(tile: EdgeTile, near_ground: np.ndarray, path: cKDTree) -> EdgeCandidates:
    """Places of a tile where the surface becomes rough away from the path, in each pass for itself.

    Parameters
    ----------
    near_ground : (n,) which of the tile's points lie at the ground.
    path : places of the vehicle.
    """
    found = []
    points = tile.points[near_ground]
    for drive in np.unique(points["drive"]).tolist():
        place = np.column_stack([points[name][points["drive"] == drive] for name in "xyz"])
        if len(place) < 4 * FEWEST:
            continue
        for number in range(DIRECTIONS):
            angle = np.pi * number / DIRECTIONS
            strips = Strips.of(place, np.array([np.cos(angle), np.sin(angle)]))
            before, after = strips.sides(*SPAN)
            low, high = (np.maximum(f(before.rough, after.rough), NOISE) for f in (np.minimum, np.maximum))
            enough = (before.number >= FEWEST) & (after.number >= FEWEST)
            clear = enough & (high >= SMOOTHEST_ROUGH) & (high > RATIO * low)
            found.append(strips.peaks(after.rough - before.rough, np.where(clear, np.log(high / low), 0.0)))
    every = joined_candidates(found)
    mine = tile.owns(every.place)
    if not mine.any():
        return joined_candidates([])
    away = every.place - path.data[path.query(every.place)[1]]
    mine &= (away * every.normal).sum(axis=1) > 0
    return EdgeCandidates(every.place[mine], every.normal[mine], every.height[mine], every.score[mine])


def measure_borders(stations: Stations, tile: EdgeTile, near_ground: np.ndarray) -> None:
    """Find the border in the profiles of the stations that belong to a tile."""
    mine = np.flatnonzero(tile.owns(stations.place))
    points = tile.points[near_ground]
    if not len(mine) or not len(points):
        return
    place = np.column_stack([points["x"], points["y"]])
    around = cKDTree(place).query_ball_point(stations.place[mine], REACH + HALF_LENGTH)
    for row, rows in zip(mine.tolist(), around):
        rows = np.array(rows, int)
        offset, normal = place[rows] - stations.place[row], stations.normal[row]
        across = offset @ normal
        close = (np.abs(offset @ np.array([-normal[1], normal[0]])) <= HALF_LENGTH) & (np.abs(across) <= REACH)
        _measure(stations, row, across[close], points[rows[close]])


def _measure(stations: Stations, row: int, across: np.ndarray, points: np.ndarray) -> None:
    order = np.argsort(across)
    a, z = across[order], points["z"][order]
    smooth, rough = a < -0.4, a > 0.4
    if min(np.count_nonzero(smooth), np.count_nonzero(rough)) < FEWEST:
        return
    line = np.polyfit(a[smooth], z[smooth], 1)
    beyond = np.polyfit(a[rough], z[rough], 1)
    noise = max(float(np.std(z[smooth] - np.polyval(line, a[smooth]))), NOISE)
    # Of neighbours: a step makes a few of their differences large, grass all.
    scatter = SIGMA_OF_MAD * float(np.median(np.abs(np.diff(z[rough])))) / np.sqrt(2.0)
    if scatter < max(ROUGH, RATIO * noise) or np.std(z[rough] - np.polyval(beyond, a[rough])) > ROUGHEST:
        return
    before = 0.5 * ((z - np.polyval(line, a)) / noise)**2 + np.log(noise)
    after = 0.5 * ((z - np.polyval(beyond, a)) / scatter)**2 + np.log(scatter)
    edge, sigma = most_likely_change(a, np.minimum(before, 50.0), np.minimum(after, 50.0), REACH)
    stations.foot[row] = stations.top[row] = edge
    stations.z_foot[row] = stations.z_top[row] = np.polyval(line, edge)
    stations.sigma[row] = np.hypot(sigma, MODEL)
    stations.sigma_z[row] = max(noise / np.sqrt(np.count_nonzero(smooth)), NOISE)
    stations.points[row], stations.passes[row] = len(a), len(np.unique(points["drive"]))


def border_lines(stations: Stations, others: list[RoadEdge], path: np.ndarray, settings: EdgeSettings,
                 corner: np.ndarray, first_chain: int) -> list[RoadEdge]:
    """Borders where no other edge is near them or between them and the path (k, 2); moved by `corner` (3,)."""
    plan = stations.place + np.nan_to_num(stations.foot)[:, None] * stations.normal
    alone = np.isfinite(stations.foot)
    if others and alone.any():
        tree = shapely.STRtree([shapely.linestrings(edge.foot[:, :2] - corner[:2]) for edge in others])
        ways = shapely.linestrings(np.stack([plan, path[cKDTree(path).query(plan)[1]]], axis=1))
        alone[tree.query(ways, predicate="intersects")[0]] = False
        alone[tree.query(shapely.points(plan), predicate="dwithin", distance=BESIDE)[0]] = False
    edges = []
    for course in np.unique(stations.course).tolist():
        rows = np.flatnonzero((stations.course == course) & alone)
        for part in np.split(rows, np.flatnonzero(np.diff(rows) > BRIDGED + 1) + 1):
            if STATION * (len(part) - 1) >= max(SHORTEST, settings.min_length):
                edges.append(_edge(stations, part, plan, corner, first_chain + course))
    return edges


def _edge(stations: Stations, part: np.ndarray, plan: np.ndarray, corner: np.ndarray, chain: int) -> RoadEdge:
    foot = np.column_stack([plan[part], stations.z_foot[part]]) + corner
    sigma, sigma_z = (float(np.sqrt(np.mean(values[part]**2))) for values in (stations.sigma, stations.sigma_z))
    sure = sigma <= UNSURE
    return RoadEdge(BORDER, foot, foot.copy(), 0.0, sigma, sigma_z, int(stations.points[part].sum()),
                    int(stations.passes[part].max()), len(part) / (int(part[-1] - part[0]) + 1), chain, 0.0,
                    MEASURED if sure else DOUBTFUL, "" if sure else say("the surface changes gradually"))
