"""Tie points proposed from corners of buildings, for the user to confirm (Z 3.2 assigns them by hand).

Where points of the survey stand over each other there is a wall. At every corner of a building the two walls are
looked for in the survey, parallel to its edges and near them; lines through them meet in the survey's
corner. A corner may fit several walls: what its neighbours in time are shifted by decides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ...errors import InsufficientDataError
from ...io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ...progress import SILENT, Progress
from ...wording import say
from ..trajectory import Trajectory, interpolate
from .reference_corners import BuildingCorners, near_course
from .tie_points import TiePoints

CELL = 0.25
"""m, side of the cells in plan in which points stand over each other."""

PASS_LIMIT = 10.0  # s: points of one wall measured within this time are one view of it.
MIN_WALL_HEIGHT = 1.2  # m from the lowest to the highest point of a wall's cell
MIN_POINTS = 4
WALL = 10.0  # m of a wall looked at from the corner
# m, of the search across and of coverage along
BIN = 0.1
ALONG = 0.5
MIN_BINS = 4  # bins along
PEAKS = 3
NEAR_LINE = 0.3  # m
MAX_RMS = 0.12  # m
FROM_CORNER = 3.0  # m between the corner and what is seen of each wall
NEIGHBOURS = 15.0  # s
AGREE = 0.35
SET_SECONDS = 4.0
BASELINE = 4.0

LOWEST, HIGHEST = -0.5, 8.0
"""m above the body's origin: walls are looked at between these heights."""

_MIN_DIRECTION_COSINE = np.cos(np.radians(5.0))


@dataclass(frozen=True)
class WallCells:
    """Cells with points over each other, (k,) each: mean place (k, 2), mean time, points."""

    place: np.ndarray
    time: np.ndarray
    count: np.ndarray


@dataclass(frozen=True)
class Proposals:
    """Tie points proposed, in the order of time.

    Attributes
    ----------
    ties : in sets of two.
    support : (n,) how many other corners within 15 s are shifted likewise.
    fit : (n,) root mean square distance of the walls' points from their lines, m.
    corners, found : corners near the course, and those that were found in the survey.
    """

    ties: TiePoints
    support: np.ndarray
    fit: np.ndarray
    corners: int
    found: int


@dataclass(frozen=True)
class _Candidate:
    """A corner as the survey may show it."""

    corner: int
    time: float
    place: np.ndarray
    shift: np.ndarray
    fit: float


def propose_tie_points(cloud: PointCloud, trajectory: Trajectory, reference: BuildingCorners,
                       max_distance: float = 30.0, search: float = 2.5, agreement: float = 0.5, shift: float = 0.0,
                       progress: Progress = SILENT) -> Proposals:
    """Corners of buildings that the survey shows, gathered in sets of two.

    Parameters
    ----------
    cloud : the survey with gps_time, placed with the trajectory.
    reference : corners by outlines or by a surface (`outline_corners`, `surface_corners`).
    max_distance : corners farther from the course are left out, m.
    search : how far survey and reference may lie apart, m.
    agreement : shifts of corners that differ by less agree with each other, m: how good the reference is.
    shift : s to add to the cloud's gps_time (see `gps_time.time_shift`).

    Raises
    ------
    InsufficientDataError : no corner near the course, no wall in the survey, or no two corners that agree.
    """
    corners = near_course(reference, trajectory, max_distance)
    if not len(corners.place):
        raise InsufficientDataError(say("No corner of a building lies within {max_distance:.0f} m of the course: "
                                        "give outlines or a surface of the same place and coordinate reference "
                                        "system.", max_distance=max_distance))
    cells = wall_cells(cloud, trajectory, max_distance + 2 * search, shift, progress.part(0.0, 0.7))
    candidates = _candidates(cells, corners, search, progress.part(0.7, 0.95))
    chosen, support = _agreeing(candidates, agreement)
    rows = _in_sets(chosen, trajectory)
    if not rows:
        raise InsufficientDataError(say("Of {place_count} corners near the course no two were found in the survey "
                                        "close enough to each other: assign tie points by hand.",
                                        place_count=len(corners.place)))
    flat = [k for pair in rows for k in pair]
    ties = TiePoints(np.repeat(np.arange(1, len(rows) + 1), 2).astype(str), np.array([chosen[k].time for k in flat]),
                     np.array([chosen[k].place for k in flat]),
                     np.array([chosen[k].place + chosen[k].shift for k in flat]))
    return Proposals(ties, support[flat], np.array([chosen[k].fit for k in flat]), len(corners.place),
                     len({item.corner for item in chosen}))


def wall_cells(cloud: PointCloud, trajectory: Trajectory, max_distance: float, shift: float = 0.0,
               progress: Progress = SILENT) -> WallCells:
    """Cells in plan, pass by pass, in which points of the survey stand over each other.

    Raises
    ------
    InsufficientDataError : there is none.
    """
    pieces = [_cell_sums(*found) for chunk in iter_chunks(cloud, progress)
              if (found := _at_wall_height(chunk, cloud, trajectory, max_distance, shift)) is not None]
    if not pieces:
        raise InsufficientDataError(say("No point of the survey lies at the height of walls near the course within "
                                        "the trajectory's time."))
    key, sums, low, high = (np.concatenate(column) for column in zip(*pieces))
    order = np.argsort(key, kind="stable")
    start = np.flatnonzero(np.diff(key[order], prepend=-1))
    sums = np.add.reduceat(sums[order], start)
    height = np.maximum.reduceat(high[order], start) - np.minimum.reduceat(low[order], start)
    wall = (height >= MIN_WALL_HEIGHT) & (sums[:, 3] >= MIN_POINTS)
    if not wall.any():
        raise InsufficientDataError(say("The survey shows no walls: its points nowhere stand over each other."))
    mean = sums[wall, :3] / sums[wall, 3:]
    return WallCells(mean[:, :2] + cloud.minimum[:2], mean[:, 2] + trajectory.time[0], sums[wall, 3].astype(int))


def _at_wall_height(chunk, cloud: PointCloud, trajectory: Trajectory, max_distance: float, shift: float):
    """Keys of cell and pass (n,), places and times from their origins (n, 3), and heights (n,); None without any."""
    time = np.asarray(chunk["gps_time"]) + shift
    keep = np.flatnonzero(valid_points(chunk) & trajectory.within(time))
    if not len(keep):
        return None
    place = np.column_stack([np.asarray(chunk[name])[keep] for name in "xyz"])
    body = interpolate(trajectory, time[keep]).place
    above = place[:, 2] - body[:, 2]
    some = (above > LOWEST) & (above < HIGHEST) & (np.hypot(*(place - body)[:, :2].T) < max_distance)
    if not some.any():
        return None
    place, time = place[some], time[keep][some] - trajectory.time[0]
    cell = np.floor((place[:, :2] - cloud.minimum[:2]) / CELL).astype(np.int64)
    size = np.floor((cloud.maximum[:2] - cloud.minimum[:2]) / CELL).astype(np.int64) + 2
    key = (np.floor(time / PASS_LIMIT).astype(np.int64) * size[0] + cell[:, 0]) * size[1] + cell[:, 1]
    return key, np.column_stack([place[:, :2] - cloud.minimum[:2], time]), place[:, 2]


def _cell_sums(key: np.ndarray, values: np.ndarray, height: np.ndarray) -> tuple[np.ndarray, ...]:
    """Of every cell and pass: key, sums of place, time and count (k, 4), lowest and highest point."""
    order = np.argsort(key, kind="stable")
    start = np.flatnonzero(np.diff(key[order], prepend=-1))
    sums = np.add.reduceat(np.column_stack([values, np.ones(len(key))])[order], start)
    return key[order][start], sums, np.minimum.reduceat(height[order], start), np.maximum.reduceat(height[order], start)


def _candidates(cells: WallCells, corners: BuildingCorners, search: float, progress: Progress) -> list[_Candidate]:
    """All places at which the survey may show corners."""
    tree = cKDTree(cells.place)
    found: list[_Candidate] = []
    for number in range(len(corners.place)):
        if number % 20 == 0:
            progress.step(number / len(corners.place))
        near = np.array(tree.query_ball_point(corners.place[number], WALL + search), int)
        if not len(near):
            continue
        near = near[np.argsort(cells.time[near])]
        for view in np.split(near, np.flatnonzero(np.diff(cells.time[near]) > SET_SECONDS) + 1):
            found += _corner_candidates(cells, view, corners, number, search)
    return found


def _corner_candidates(cells: WallCells, view: np.ndarray, corners: BuildingCorners, number: int,
                       search: float) -> list[_Candidate]:
    """The corner from all pairs of walls that one view of it shows along its two edges."""
    corner = corners.place[number]
    place = cells.place[view] - corner
    walls = [_wall_lines(place, corners.edge[number, k], min(corners.length[number, k], WALL), search)
             for k in (0, 1)]
    found = []
    for first in walls[0]:
        for second in walls[1]:
            where = _intersection(first, second)
            if np.hypot(*where) > search:
                continue
            distances = [np.hypot(*(place[wall.rows] - where).T) for wall in (first, second)]
            if max(distance.min() for distance in distances) > FROM_CORNER:
                continue
            rows = np.concatenate([wall.rows[distance < 2 * FROM_CORNER] for wall, distance in
                                   zip((first, second), distances)])
            time = cells.time[view[rows]]
            if np.ptp(time) <= 2 * SET_SECONDS:
                found.append(_Candidate(number, float(np.median(time)), corner + where, -where,
                                        max(first.fit, second.fit)))
    return found


@dataclass(frozen=True)
class _Line:
    """A wall's line in plan: a point on it, its direction, the rows of the cells on it, and their distance from it."""

    point: np.ndarray
    direction: np.ndarray
    rows: np.ndarray
    fit: float


def _wall_lines(place: np.ndarray, edge: np.ndarray, length: float, search: float) -> list[_Line]:
    """Walls parallel to an edge from the origin, those that cover most of it first."""
    along, across = place @ edge, place @ np.array([-edge[1], edge[0]])
    rows = np.flatnonzero((along > -search) & (along < length + search) & (np.abs(across) < search))
    if len(rows) < MIN_BINS:
        return []
    column = np.floor((across[rows] + search) / BIN).astype(int)
    row = np.floor((along[rows] + search) / ALONG).astype(int)
    grid = np.zeros((int(2 * search / BIN) + 3, int((length + 2 * search) / ALONG) + 2), bool)
    grid[column + 1, row] = True
    # Walls are a little rotated against the outline: three bins together.
    covered = (grid[:-2] | grid[1:-1] | grid[2:]).sum(axis=1)
    lines = []
    for _ in range(PEAKS):
        peak = int(np.argmax(covered))
        if covered[peak] < MIN_BINS:
            break
        near = rows[np.abs(across[rows] - ((peak + 0.5) * BIN - search)) < NEAR_LINE]
        line = _fitted(place, near, edge)
        if line is not None:
            lines.append(line)
        covered[max(peak - 5, 0):peak + 6] = 0
    return lines


def _fitted(place: np.ndarray, rows: np.ndarray, edge: np.ndarray) -> _Line | None:
    """The line through cells, the far ones left out; None where it is no wall along the edge."""
    for limit in (NEAR_LINE, 2 * MAX_RMS, MAX_RMS * 1.5):
        if len(rows) < MIN_BINS:
            return None
        centre = place[rows].mean(axis=0)
        _, axes = np.linalg.eigh(np.cov((place[rows] - centre).T))
        direction = axes[:, 1]
        away = (place[rows] - centre) @ np.array([-direction[1], direction[0]])
        rows = rows[np.abs(away) <= limit]
    if len(rows) < MIN_BINS or abs(direction @ edge) < _MIN_DIRECTION_COSINE:
        return None
    fit = float(np.sqrt(np.mean(away[np.abs(away) <= limit] ** 2)))
    return _Line(centre, direction, rows, fit) if fit <= MAX_RMS else None


def _intersection(first: _Line, second: _Line) -> np.ndarray:
    """Where two lines along the edges of a corner meet."""
    crossed = first.direction[0] * second.direction[1] - first.direction[1] * second.direction[0]
    vector = second.point - first.point
    return first.point + first.direction * (vector[0] * second.direction[1] - vector[1] * second.direction[0]) / crossed


def _agreeing(candidates: list[_Candidate], limit: float) -> tuple[list[_Candidate], np.ndarray]:
    """Of every corner and view the candidate with most neighbours shifted likewise, in the order of time; how many."""
    if not candidates:
        return [], np.empty(0, int)
    candidates = sorted(candidates, key=lambda item: item.time)
    time = np.array([item.time for item in candidates])
    shift = np.array([item.shift for item in candidates])
    corner = np.array([item.corner for item in candidates])
    best: dict[tuple[int, int], tuple[int, float, int]] = {}
    for k, item in enumerate(candidates):
        near = np.flatnonzero((np.abs(time - time[k]) < NEIGHBOURS) & (corner != corner[k]))
        alike = near[np.hypot(*(shift[near] - shift[k]).T) < limit]
        support, around = len(np.unique(corner[alike])), len(np.unique(corner[near]))
        key = (item.corner, int(time[k] // PASS_LIMIT))
        if support >= 2 and support >= AGREE * around and (support, -item.fit) > best.get(key, (0, 0.0, 0))[:2]:
            best[key] = support, -item.fit, k
    chosen = sorted(entry[2] for entry in best.values())
    supporters = {entry[2]: entry[0] for entry in best.values()}
    return [candidates[k] for k in chosen], np.array([supporters[k] for k in chosen], int)


def _in_sets(chosen: list[_Candidate], trajectory: Trajectory) -> list[tuple[int, int]]:
    """Pairs of rows, each used once: within four seconds, and four metres apart as seen from the vehicle."""
    if not chosen:
        return []
    time = np.array([item.time for item in chosen])
    seen = np.array([item.place for item in chosen]) - interpolate(trajectory, time, "hold").place[:, :2]
    free, pairs = np.ones(len(chosen), bool), []
    for k in range(len(chosen)):
        others = np.flatnonzero(free & (time >= time[k]) & (time - time[k] <= SET_SECONDS))
        others = others[others > k]
        if not free[k] or not len(others):
            continue
        baseline = np.hypot(*(seen[others] - seen[k]).T)
        if baseline.max() >= BASELINE:
            partner = int(others[baseline.argmax()])
            free[[k, partner]] = False
            pairs.append((k, partner))
    return pairs
