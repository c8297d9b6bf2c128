"""Rails and walls at the road: upright faces that run along as lines, told by their height and what is behind them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ...settings.roadmap import EdgeSettings
from ...wording import say
from .courses import STATION
from .edge_points import EdgeTile
from .edge_records import DOUBTFUL, MEASURED, RAIL, WALL, Course, EdgeCandidates, RoadEdge, joined_candidates

CELL = 0.1
"""m."""

LOWEST, BAND = 0.2, 1.3
"""m above the ground between which rails and walls show."""

RAIL_HEIGHTS = (0.35, 1.4)  # m; what is higher is a wall.
# m that a cell's points cover in height, and their number
RISE = 0.2
FEWEST = 3
# m round a cell whose neighbours tell its direction, and their spread across, of that along
AROUND = 0.6
THIN = 0.12
# m about a station; m within which a face's points lie
HALF_LENGTH = 0.4
ACROSS = 0.35
SKIN = 0.12
ROUGH = 0.05  # m; vegetation scatters more
GROUND_BAND = (0.04, 0.2)  # m; walls reach the ground, the sides of vehicles do not
# shares of a rail's stations that reach the ground; m, longer than vehicles
FOOTED = (0.1, 0.5)
LONG = 12.0
# m between the quartiles of a rail's height; share of stations
UNEVEN = 0.15
BACKED = 0.25
BEHIND = 1.2  # m; what is taller right behind a rail may be a vehicle's cabin
BROKEN = 0.6  # m; a gap in height above which what follows is something else
NOISE = 0.006  # m
BRIDGED = 2  # stations
PARTED = 15.0  # m between pieces of one rail
SHORTEST = 5  # stations


@dataclass
class Uprights:
    """What was measured at the stations of upright faces, NaN where nothing was; as `Stations`, in arrays (n,).

    `across` m from the station, `ground` and `height` m, `sigma`, `sigma_z` m, `points`, `passes`; `footed` whether
    it reaches the ground, `backed` whether something taller is right behind it.
    """

    course: np.ndarray
    place: np.ndarray
    normal: np.ndarray
    across: np.ndarray
    ground: np.ndarray
    height: np.ndarray
    sigma: np.ndarray
    sigma_z: np.ndarray
    points: np.ndarray
    passes: np.ndarray
    footed: np.ndarray
    backed: np.ndarray

    @classmethod
    def of(cls, courses: list[Course]) -> Uprights:
        """Stations of the courses, nothing measured."""
        number = sum(len(course.seen) for course in courses)
        return cls(np.repeat(np.arange(len(courses)), [len(course.seen) for course in courses]),
                   np.concatenate([np.zeros((0, 2)), *(course.place for course in courses)]),
                   np.concatenate([np.zeros((0, 2)), *(course.normal for course in courses)]),
                   *[np.full(number, np.nan) for _ in range(5)], np.zeros(number, np.int64),
                   np.zeros(number, np.int64), np.zeros(number, bool), np.zeros(number, bool))


def upright_candidates(tile: EdgeTile, height: np.ndarray, path: cKDTree) -> EdgeCandidates:
    """Cells of a tile in which points stand above each other, with normals that look away from the path.

    Parameters
    ----------
    height : (n,) of the tile's points above the ground, m.
    path : places of the vehicle.
    """
    band = (height > LOWEST) & (height < BAND)
    points, up = tile.points[band], height[band]
    if len(points) < FEWEST:
        return joined_candidates([])
    column, row = (np.floor(points[name] / CELL).astype(np.int64) for name in "xy")
    flat = (column - column.min()) * (int(np.ptp(row)) + 1) + row - row.min()
    order = np.argsort(flat, kind="stable")
    starts = np.flatnonzero(np.diff(flat[order], prepend=-1))
    count = np.diff(np.append(starts, len(order)))
    rise = np.maximum.reduceat(up[order], starts) - np.minimum.reduceat(up[order], starts)
    tall = (rise >= RISE) & (count >= FEWEST)
    if np.count_nonzero(tall) < FEWEST:
        return joined_candidates([])
    place = np.column_stack([np.add.reduceat(points[name][order], starts)[tall] / count[tall] for name in "xy"])
    normal, thin = _directions(place)
    mine = thin & tile.owns(place)
    if not mine.any():
        return joined_candidates([])
    place, normal, rise = place[mine], normal[mine], rise[tall][mine]
    away = place - path.data[path.query(place)[1]]
    return EdgeCandidates(place, normal * np.where((normal * away).sum(axis=1) < 0, -1.0, 1.0)[:, None], rise, rise)


def _directions(place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Normals (n, 2) of lines through the places round each one, and whether these are thin lines (n,)."""
    pairs = cKDTree(place).query_pairs(AROUND, output_type="ndarray")
    first, second = np.concatenate([pairs, pairs[:, ::-1]]).T
    offset = place[second] - place[first]
    number = np.bincount(first, minlength=len(place)) + 1.0
    sums = [np.bincount(first, weights=value, minlength=len(place)) / number
            for value in (offset[:, 0], offset[:, 1], offset[:, 0]**2, offset[:, 1]**2, offset[:, 0] * offset[:, 1])]
    xx, yy, xy = sums[2] - sums[0]**2, sums[3] - sums[1]**2, sums[4] - sums[0] * sums[1]
    angle = 0.5 * np.arctan2(2 * xy, xx - yy)
    half, mean = np.hypot(0.5 * (xx - yy), xy), 0.5 * (xx + yy)
    thin = (number >= 4) & (mean - half < THIN**2 * (mean + half)) & (mean + half > 0.2**2)
    return np.column_stack([-np.sin(angle), np.cos(angle)]), thin


def measure_uprights(stations: Uprights, tile: EdgeTile, height: np.ndarray) -> None:
    """Measure the stations that belong to a tile."""
    mine = np.flatnonzero(tile.owns(stations.place))
    rows = np.flatnonzero(height > 0.02)
    if not len(mine) or not len(rows):
        return
    place = np.column_stack([tile.points[name][rows] for name in "xy"])
    around = cKDTree(place).query_ball_point(stations.place[mine],
                                             np.hypot(HALF_LENGTH, BEHIND + ACROSS))
    for station, near in zip(mine.tolist(), around):
        near = np.array(near, int)
        offset, normal = place[near] - stations.place[station], stations.normal[station]
        close = np.abs(offset @ np.array([-normal[1], normal[0]])) <= HALF_LENGTH
        some = rows[near[close]]
        _measure(stations, station, (offset @ normal)[close], height[some], tile.points[some])


def _measure(stations: Uprights, station: int, across: np.ndarray, up: np.ndarray, points: np.ndarray) -> None:
    """Put one station's face into `stations`, unless it is no face."""
    band = (np.abs(across) < ACROSS) & (up > LOWEST) & (up < BAND)
    if np.count_nonzero(band) < 2 * FEWEST:
        return
    middle = float(np.median(across[band]))
    skin = np.abs(across - middle) < SKIN
    face = band & skin
    scatter = float(np.std(across[face])) if np.count_nonzero(face) >= 2 * FEWEST else np.inf
    if np.count_nonzero(face) < 0.6 * np.count_nonzero(band) or scatter > ROUGH:
        return
    column = np.sort(up[skin & (up > LOWEST)])
    broken = np.flatnonzero(np.diff(column) > BROKEN)
    top = float(column[broken[0]] if len(broken) else column[-1])
    number = int(np.count_nonzero(face))
    noise = max(scatter, NOISE)
    stations.across[station] = float(np.mean(across[face]))
    stations.ground[station] = float(np.median((points["z"] - up)[face]))
    stations.height[station] = top
    stations.sigma[station] = noise / np.sqrt(number)
    stations.sigma_z[station] = max((top - LOWEST) / max(np.count_nonzero(skin), 1) * 2.0, NOISE)
    stations.points[station] = number
    stations.passes[station] = len(np.unique(points["drive"][face]))
    low = skin & (up > GROUND_BAND[0]) & (up < GROUND_BAND[1])
    stations.footed[station] = np.count_nonzero(low) >= FEWEST
    taller = (across > middle + SKIN) & (across < middle + BEHIND) & (up > top + 0.1) & (up < 2.2)
    stations.backed[station] = np.count_nonzero(taller) >= FEWEST


def upright_lines(stations: Uprights, settings: EdgeSettings, corner: np.ndarray, first_chain: int) -> list[RoadEdge]:
    """Rails and walls of all courses; coordinates are moved by `corner` (3,)."""
    made = []
    for course in np.unique(stations.course).tolist():
        rows = np.flatnonzero(stations.course == course)
        made += [(edge, _stands(stations, kind, part) and _even(stations, kind, part)
                  and edge.length >= settings.min_length)
                 for kind, part in _runs(stations, rows)
                 if (edge := _edge(stations, kind, part, corner, first_chain + course)) is not None]
    rails = [edge for edge, alone in made if alone and edge.kind == RAIL]
    return [edge for edge, alone in made
            if alone or (edge.kind == RAIL and any(_continues(edge, rail) for rail in rails))]


def _stands(stations: Uprights, kind: str, part: np.ndarray) -> bool:
    """Whether a stretch reaches the ground somewhere, as no side of a vehicle does; parked ones hide that of rails."""
    return kind != RAIL or bool(stations.footed[part].mean() >= FOOTED[0])


def _even(stations: Uprights, kind: str, part: np.ndarray) -> bool:
    """Whether a stretch is as high all along, as rails are; what parked vehicles hide of one may be its top."""
    return kind != RAIL or bool(np.subtract(*np.percentile(stations.height[part], [75, 25])) <= UNEVEN)


def _continues(piece: RoadEdge, rail: RoadEdge) -> bool:
    """Whether a piece stands in the line of a rail, as high as it: parked cars part rails."""
    foot = rail.foot[:, :2]
    way = foot[-1] - foot[0]
    way = way / np.hypot(*way)
    off = piece.foot[[0, -1], :2] - foot.mean(axis=0)
    along, beside = np.abs(off @ way), np.abs(off @ [-way[1], way[0]])
    return bool(beside.max() < SKIN and along.min() < rail.length / 2.0 + PARTED
                and abs(piece.height - rail.height) < UNEVEN)


def _runs(stations: Uprights, rows: np.ndarray) -> list[tuple[str, np.ndarray]]:
    """Measured rows of each stretch of one kind; short gaps do not part stretches."""
    measured = rows[np.isfinite(stations.across[rows])]
    height = stations.height[measured]
    smooth = np.array([np.median(height[max(i - 2, 0):i + 3]) for i in range(len(height))])
    usable = smooth >= RAIL_HEIGHTS[0]
    measured, smooth = measured[usable], smooth[usable]
    if not len(measured):
        return []
    wall = smooth > RAIL_HEIGHTS[1]
    cuts = np.flatnonzero((np.diff(measured) > BRIDGED + 1) | (np.diff(wall.astype(int)) != 0)) + 1
    runs = [(WALL if wall[part[0]] else RAIL, _without_ends_aside(stations, measured[part]))
            for part in np.split(np.arange(len(measured)), cuts)]
    return [(kind, part) for kind, part in runs if len(part) >= SHORTEST]


def _without_ends_aside(stations: Uprights, part: np.ndarray) -> np.ndarray:
    """Stations of a run without the few at its ends where the face steps aside: a bollard or a post beside the end of
    a rail is no part of it."""
    plan = stations.place[part] + stations.across[part][:, None] * stations.normal[part]
    aside = np.abs((np.diff(plan, axis=0) * stations.normal[part][:-1]).sum(axis=1)) > SKIN
    groups = np.split(part, np.flatnonzero(aside) + 1)
    while len(groups) > 1 and len(groups[0]) < SHORTEST:
        groups.pop(0)
    while len(groups) > 1 and len(groups[-1]) < SHORTEST:
        groups.pop()
    return np.concatenate(groups)


def _edge(stations: Uprights, kind: str, part: np.ndarray, corner: np.ndarray, chain: int) -> RoadEdge | None:
    """The line of a stretch; None where it is the side of a vehicle."""
    footed, backed = float(stations.footed[part].mean()), float(stations.backed[part].mean())
    if kind == WALL and footed < 0.5:
        return None
    plan = stations.place[part] + stations.across[part][:, None] * stations.normal[part]
    foot = np.column_stack([plan, stations.ground[part]])
    top = foot + np.column_stack([np.zeros_like(plan), stations.height[part]])
    status, reason = MEASURED, ""
    if kind == RAIL:
        if backed > BACKED:
            status, reason = DOUBTFUL, say("something taller stands right behind it: it may be a row of vehicles")
        elif not _stands(stations, kind, part) or (footed < FOOTED[1] and STATION * len(part) < LONG):
            status, reason = DOUBTFUL, say("it does not reach the ground: it may be the side of a vehicle")
    sigma, sigma_z = (float(np.sqrt(np.mean(values[part]**2))) for values in (stations.sigma, stations.sigma_z))
    return RoadEdge(kind, foot + corner, top + corner, float(np.median(stations.height[part])), sigma, sigma_z,
                    int(stations.points[part].sum()), int(stations.passes[part].max()),
                    len(part) / (int(part[-1] - part[0]) + 1), chain, 0.0, status, reason)
