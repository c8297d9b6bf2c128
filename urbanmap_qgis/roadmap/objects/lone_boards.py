"""Boards of signs found by their faces alone: their posts are hidden, too thin to show, or stand in leaves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

from ...geometry.tolerances import LEAST_DIVISOR
from .boards import outlined_board
from .object_records import Board, StemAxis
from .sweep_index import SweepIndex


@dataclass(frozen=True)
class LoneBoardsLimits:
    """Limits of lone boards, each with its unit."""

    low: float = 1.3  # m above the ground; below it are the sides of cars
    high: float = 4.5  # m above the ground; higher up hang the heads of signals
    cell: float = 0.6  # m, in which points are asked for a plane
    few: int = 15  # points in the fullest layer of a cell
    share: float = 0.3  # of a cell's points in its fullest layer
    turn: float = 12.0  # degrees from one direction of a layer to the next
    layer: float = 0.02  # m; three of them are as thick as a board in noise
    wall: tuple[float, float] = (1.1, 2.0)  # m: a plane that goes on so far away is a wall, or the side of a vehicle
    one_plane: float = 0.2  # m off each other's planes, whose directions are known to half a step
    reach: float = 1.5  # m about a cell, in which its plane is looked for
    face: float = 1.0  # m in plan about the middle of the plane, in which its face lies
    off: float = 0.25  # m outside its face, that this middle may be
    beside: tuple[float, float] = (0.07, 0.16)  # m before and behind a face, where leaves would go on
    full: float = 0.12  # m, side of the cells of a face
    taken: int = 7  # of a cell and the eight about it that hold points, where the cell is within a face
    cells: int = 4  # within a face, that hang together by their sides
    denser: float = 4.0  # than what lies before and behind it, for the same thickness
    flat: float = 0.02  # m, standard deviation of its points
    same: float = 0.4  # m between middles of boards that are one
    aside: float = 0.25  # m from the axis of a post to the face of its board
    side: tuple[float, float] = (0.3, 1.3)  # m, of a board
    longer: float = 2.5  # than wide, or wider than long, that a board is at most; trunks are longer
    thin: float = 0.03  # m to either side of its plane, that a board's points lie in
    frame: tuple[float, float] = (0.08, 0.4)  # m outside its edges, where a board does not go on
    thinner: float = 0.5  # points beyond an edge, of those for the same area of the board
    bottom: float = 1.6  # m above the ground, of a board whose post is not seen; below it are windows of vehicles
    alone: float = 0.2  # points about such a board, of those on it
    at_post: float = 0.15  # m in plan from the middle of the board, where its post may show
    fuller: float = 2.5  # a plane than what lies before and behind it, to be looked at
    core: float = 0.8  # m, side of the middle of a plane, of which it is asked whether it goes on
    farther: tuple[float, float] = (0.3, 0.8)  # m beyond that, where a wall goes on to both sides


LIMITS = LoneBoardsLimits()

_NONE = np.zeros(0, np.int64)


def lone_boards(place: np.ndarray, height: np.ndarray, index: SweepIndex, seen_from: np.ndarray,
                where: np.ndarray) -> list[Board]:
    """Boards among a tile's points.

    Parameters
    ----------
    place : (n, 3) points, m, as in the index.
    height : (n,) above the ground, m.
    seen_from : (n, 2) where each was measured from, m.
    where : (n,) mask of points that are looked at for boards.
    """
    found: list[Board] = []
    tried: list[np.ndarray] = []
    for middle, normal in zip(*_seeds(place[where], height[where])):
        if any(np.linalg.norm(other - middle) < LIMITS.same for other in tried):
            continue
        tried.append(middle)
        near = index.near(middle[:2], LIMITS.reach)
        near = near[(np.abs(place[near, 2] - middle[2]) < LIMITS.reach) & (height[near] > LIMITS.low)]
        core = _plane_of_board(place[near] - middle, normal)
        if not len(core):
            continue
        face = face_of(place[near], middle, core)
        if face is None:
            continue
        rows = near[face[0]]
        board = outlined_board(place[rows], face[1], None, seen_from[rows].mean(axis=0))
        if board is None or any(np.linalg.norm(other.centre - board.centre) < LIMITS.same for other in found):
            continue
        tried.append(board.centre)
        if well_shaped(board) and ends(place[near], board):
            found.append(board)
    return found


def stands_alone(place: np.ndarray, height: np.ndarray, board: Board) -> bool:
    """Whether a board hangs high enough and nothing is about it but a post: parts of vehicles and fronts have others
    beside them. `place` (n, 3) of all points, m, `height` (n,) above the ground, m."""
    azimuth = np.radians(board.azimuth)
    off = place - board.centre
    level = np.array([np.sin(azimuth), np.cos(azimuth)])
    depth, along = np.abs(off[:, :2] @ level), np.abs(off[:, :2] @ [-level[1], level[0]])
    side, up = along - board.width / 2.0, np.abs(off[:, 2]) - board.height / 2.0
    on = (depth < LIMITS.frame[0]) & (side < LIMITS.frame[0]) & (up < LIMITS.frame[0])
    about = (depth < LIMITS.frame[1]) & (side < LIMITS.frame[1]) & (up < LIMITS.frame[1])
    about &= ~on & (np.hypot(off[:, 0], off[:, 1]) > LIMITS.at_post)
    high = np.min(height[on], initial=np.inf) > LIMITS.bottom
    return bool(high and np.count_nonzero(about) < LIMITS.alone * np.count_nonzero(on))


def well_shaped(board: Board) -> bool:
    """Whether a face has the shape of a board, not of a trunk or a wall."""
    low, high = sorted((board.width, board.height))
    return LIMITS.side[0] <= low <= high <= LIMITS.side[1] and high <= LIMITS.longer * low


def ends(place: np.ndarray, board: Board) -> bool:
    """Whether the plane of a board ends at each of its edges, as no wall does. `place` (n, 3) about it, m."""
    azimuth = np.radians(board.azimuth)
    level = np.array([np.sin(azimuth), np.cos(azimuth)])
    return max(_beyond(place - board.centre, level, (board.width, board.height), LIMITS.frame)) < LIMITS.thinner


def _beyond(off: np.ndarray, level: np.ndarray, size: tuple[float, float], frame: tuple[float, float]) -> list[float]:
    """Points in one plane for the same area beyond each edge of a board (left, right, under, over), of those on it.

    Parameters
    ----------
    off : (n, 3) from the board's middle, m.
    level : (2,) unit vector across the plane.
    size : width and height, m.
    frame : m outside the edges, between which is counted.
    """
    flat = np.column_stack([off[:, :2] @ [-level[1], level[0]], off[:, 2]])[np.abs(off[:, :2] @ level) < LIMITS.thin]
    half = np.array(size) / 2.0
    inside = np.abs(flat) < half
    on = max(int(inside.all(axis=1).sum()), 1) / (size[0] * size[1])
    found = []
    for axis in (0, 1):
        for sign in (-1.0, 1.0):
            out = sign * flat[:, axis] - half[axis]
            strip = np.count_nonzero(inside[:, 1 - axis] & (out > frame[0]) & (out < frame[1]))
            found.append(strip / (size[1 - axis] * (frame[1] - frame[0])) / on)
    return found


def board_on(boards: list[Board], axis: StemAxis) -> Board | None:
    """The board that stands before or behind an axis; None where none does."""
    for board in boards:
        azimuth = np.radians(board.azimuth)
        level = np.array([np.sin(azimuth), np.cos(azimuth)])
        off = axis.plan_at(board.centre[2]) - board.centre[:2]
        if abs(off @ level) < LIMITS.aside and abs(off @ [-level[1], level[0]]) < board.width / 2.0:
            return board
    return None


def _plane_of_board(off: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Rows (m,) in the middle of a plane that is fuller than what lies before and behind it, as leaves are not, and
    does not go on to both sides, as a wall does; none of another: most places are told so at little cost.

    Parameters
    ----------
    off : (n, 3) of points from the plane's middle, m.
    normal : (3,) of the plane, to some degrees.
    """
    core = off[(np.abs(off @ normal) < 2.0 * LIMITS.thin) & (np.linalg.norm(off, axis=1) < LIMITS.core / 2.0)]
    if len(core) < LIMITS.few:
        return _NONE
    middle = core.mean(axis=0)
    own = np.linalg.eigh(np.cov((core - middle).T))[1][:, 0]
    level = own[:2] / max(np.hypot(*own[:2]), LEAST_DIVISOR)
    off = off - middle
    inner = np.flatnonzero(np.linalg.norm(off, axis=1) < LIMITS.core / 2.0)
    away = np.abs(off[inner] @ own)
    near, far = LIMITS.beside
    leaves = np.count_nonzero((away > near) & (away < far)) / (far - near)
    if np.count_nonzero(away < LIMITS.thin) / LIMITS.thin < LIMITS.fuller * leaves:
        return _NONE
    left, right, under, over = _beyond(off, level, (LIMITS.core, LIMITS.core), LIMITS.farther)
    wall = max(min(left, right), min(under, over)) > LIMITS.thinner
    return _NONE if wall else inner[away < LIMITS.thin]


def face_of(place: np.ndarray, seed: np.ndarray, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Rows of the points of the face in whose plane some `rows` (m,) lie, and its unit normal (3,); None where it is
    not flat and thin: leaves go on before and behind any layer.

    Parameters
    ----------
    place : (n, 3) m.
    seed : (3,) a place at the face, m.
    """
    near = np.flatnonzero(np.hypot(*(place[:, :2] - seed[:2]).T) < LIMITS.face)
    for _ in range(3):
        middle = place[rows].mean(axis=0)
        normal = np.linalg.eigh(np.cov((place[rows] - middle).T))[1][:, 0]
        level = np.array([*normal[:2], 0.0]) / max(np.hypot(*normal[:2]), LEAST_DIVISOR)
        across = np.array([-level[1], level[0], 0.0])
        flat = (place[near] - middle) @ np.column_stack([across, [0.0, 0.0, 1.0]])
        away = (place[near] - middle) @ normal
        part = _full_part(flat, np.flatnonzero(np.abs(away) < LIMITS.thin))
        if not len(part):
            return None
        rows = near[part]
    low, high = np.percentile(flat[part], [2, 98], axis=0)
    framed = ((flat >= low) & (flat <= high)).all(axis=1)
    on = np.count_nonzero(framed & (np.abs(away) < LIMITS.thin)) / (2.0 * LIMITS.thin)
    first, last = LIMITS.beside
    off = np.count_nonzero(framed & (np.abs(away) > first) & (np.abs(away) < last)) / (2.0 * (last - first))
    covers = low[0] - LIMITS.off < (seed - middle) @ across < high[0] + LIMITS.off
    thin = np.std(away[part]) <= LIMITS.flat and on >= LIMITS.denser * off
    return (rows, normal) if thin and covers else None


def _full_part(flat: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Those of some rows (m,) of places (n, 2) along and up a plane that lie in its largest part full everywhere."""
    if len(rows) < LIMITS.taken:
        return _NONE
    cells = np.floor(flat[rows] / LIMITS.full).astype(np.int64)
    cells += 1 - cells.min(axis=0)
    taken = np.zeros(cells.max(axis=0) + 2, np.int8)
    taken[tuple(cells.T)] = 1
    part, count = ndimage.label(ndimage.convolve(taken, np.ones((3, 3), np.int8), mode="constant") >= LIMITS.taken)
    sizes = np.bincount(part.ravel(), minlength=count + 1)[1:]
    if not count or sizes.max() < LIMITS.cells:
        return _NONE
    face = ndimage.binary_dilation(part == 1 + np.argmax(sizes), np.ones((3, 3), bool))
    return rows[face[tuple(cells.T)]]


def _seeds(place: np.ndarray, height: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Middles (m, 3) and normals (m, 3) of the fullest layers of cells that hold a small upright plane, the fullest
    first."""
    none = np.zeros((0, 3)), np.zeros((0, 3))
    band = np.flatnonzero((height > LIMITS.low) & (height < LIMITS.high))
    if len(band) < LIMITS.few:
        return none
    cells = np.floor(np.column_stack([place[band, :2], height[band]]) / LIMITS.cell).astype(np.int64)
    cells -= cells.min(axis=0)
    shape = cells.max(axis=0) + 1
    flat = np.ravel_multi_index(cells.T, shape)
    count = np.bincount(flat, minlength=int(np.prod(shape)))
    full = np.flatnonzero(count >= LIMITS.few)
    number = np.full(len(count), -1)
    number[full] = np.arange(len(full))
    own = number[flat]
    band, own = band[own >= 0], own[own >= 0]
    if not len(band):
        return none
    middle = np.column_stack([np.bincount(own, weights=place[band, axis]) for axis in range(3)]) / count[full][:, None]
    most, at, direction = _fullest_layers(place[band, :2] - middle[own, :2], own, len(full))
    flatly = (most >= LIMITS.few) & (most > LIMITS.share * count[full])
    kept = np.flatnonzero(flatly)
    kept = kept[np.argsort(-most[kept], kind="stable")]
    normal = np.column_stack([np.cos(direction[kept]), np.sin(direction[kept]), np.zeros(len(kept))])
    seeds = middle[kept] + at[kept, None] * normal
    if not len(seeds):
        return none
    alone = ~_goes_on(seeds, normal)
    return seeds[alone], normal[alone]


def _goes_on(middle: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Mask (n,) of planes that go on in another cell farther away than a board reaches: walls, sides of vehicles."""
    pairs = cKDTree(middle).query_pairs(LIMITS.wall[1], output_type="ndarray")
    between = middle[pairs[:, 1]] - middle[pairs[:, 0]]
    own, other = normal[pairs[:, 0]], normal[pairs[:, 1]]
    on = (np.linalg.norm(between, axis=1) > LIMITS.wall[0]) & (np.abs((own * other).sum(axis=1)) > np.cos(
        np.radians(1.5 * LIMITS.turn)))
    for plane in (own, other):
        on &= np.abs((between * plane).sum(axis=1)) < LIMITS.one_plane
    wall = np.zeros(len(middle), bool)
    wall[pairs[on].ravel()] = True
    return wall


def _fullest_layers(offset: np.ndarray, cell: np.ndarray, cells: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points in the fullest upright layer of each cell, its distance from the cell's middle, m, and the direction of
    its normal, radians. `offset` (n, 2) from the middle of its `cell` (n,)."""
    most, at, direction = np.zeros(cells), np.zeros(cells), np.zeros(cells)
    bins = 2 * int(np.ceil(LIMITS.cell / LIMITS.layer)) + 3
    for angle in np.radians(np.arange(0.0, 180.0, LIMITS.turn)):
        layer = np.floor(offset @ [np.cos(angle), np.sin(angle)] / LIMITS.layer).astype(np.int64) + bins // 2
        filled = np.bincount(cell * bins + layer, minlength=cells * bins).reshape(cells, bins)
        three = filled[:, :-2] + filled[:, 1:-1] + filled[:, 2:]
        best = np.argmax(three, axis=1)
        value = three[np.arange(cells), best]
        more = value > most
        most[more], at[more] = value[more], (best[more] + 1.5 - bins // 2) * LIMITS.layer
        direction[more] = angle
    return most, at, direction
