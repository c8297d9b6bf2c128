"""What hangs on a stem and what stands round it: crowns, boards, arms and heads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from scipy import ndimage

from .object_records import Board, StemAxis
from .overhead_boards import LIMITS as OVERHEAD
from .overhead_boards import overhead_face


@dataclass(frozen=True)
class HangingPartsLimits:
    """Limits of hanging parts, each with its unit."""

    voxel: float = 0.3  # m: what is farther apart does not hang together
    reach: float = 5.5  # m from the axis; what goes on beyond is no part of a post
    hanging: float = 1.0  # m above the ground; below it stand cars, hedges and people
    skin: float = 0.12  # m that a stem's points lie outside its radius
    frame: float = 0.03  # m outside a stem's radius from which points are a board's
    sectors: int = 8  # of directions, and those of them that a crown fills
    filled: int = 5
    crown: float = 0.45  # m from the axis, where crowns begin and arms are thin
    crown_voxels: int = 25  # of a crown, at least
    crown_low: tuple[float, float] = (1.6, 0.1)  # m above the ground below which crowns have this share at most
    wall: float = 1.0  # m from the axis: what hangs on a post so far out, at its own heights, is a wall
    straight: float = 0.15  # spread of a wall across, of that along
    wall_top: float = 4.0  # m above the ground; arms hang higher
    thick: float = 0.03  # m, of a board (standard deviation) with what its frame adds
    upright: float = 0.35  # vertical part of a board's unit normal, at most
    board: tuple[float, float] = (0.25, 3.0)  # m, sides of a board
    wide: float = 0.15  # m that a board reaches beyond the stem's surface
    board_points: int = 12
    beside_post: float = 0.08  # m between an edge of a board and the face of its post, where the post may hide the rest
    off_post: float = 0.06  # m to either side of a post's face, where points may be its own
    emptier: float = 0.15  # points on one side of the post, of those on the other, of a board that shows by one half
    shade: float = 0.12  # m from its face, that a post reaches behind a board
    arm: float = 0.4  # m, shortest arm
    flat: float = 0.9  # m, height over which an arm's points spread, with its head


LIMITS = HangingPartsLimits()


@dataclass(frozen=True)
class HangingParts:
    """What hangs on a stem.

    Attributes
    ----------
    top : highest point of all that hangs together, m above the ground.
    crown : diameter of a crown, m; 0 without one.
    board : or None.
    arm : length of an arm, m; 0 without one.
    arm_azimuth, arm_height : degrees, and m above the ground; NaN without an arm.
    head : m, width across and height of the thing at the arm's end.
    wall : points of what hangs on it at its own heights like a wall, and whether it is as straight as one.
    overhead : whether the board hangs over the road, on a beam or a long arm.
    """

    top: float
    crown: float
    board: Board | None
    arm: float
    arm_azimuth: float
    arm_height: float
    head: tuple[float, float]
    wall: int = 0
    straight: bool = False
    overhead: bool = False


def hanging_parts(place: np.ndarray, height: np.ndarray, axis: StemAxis, stem_top: float,
                 seen_from: np.ndarray) -> HangingParts:
    """What hangs on a stem.

    Parameters
    ----------
    place : (n, 3) points within `reach` of the axis, m.
    height : (n,) above the ground, m.
    stem_top : m above the ground, up to which the stem is thin.
    seen_from : (2,) where the survey passed, m: boards are told from this side.
    """
    offset = place[:, :2] - axis.plan_at(place[:, 2])
    away = np.hypot(*offset.T)
    hanging = _hanging(offset, height, away)
    offset, away, up, place = offset[hanging], away[hanging], height[hanging], place[hanging]
    if not len(up):
        return HangingParts(stem_top, 0.0, None, 0.0, np.nan, np.nan, (0.0, 0.0))
    top = float(max(stem_top, np.percentile(up, 99.5)))
    crown = _crown(offset, away, up)
    if crown:
        return HangingParts(top, crown, None, 0.0, np.nan, np.nan, (0.0, 0.0))
    beside = away > axis.diameter / 2.0 + LIMITS.skin
    wall = (away > LIMITS.wall) & (up < min(stem_top, LIMITS.wall_top))
    aside = away > axis.diameter / 2.0 + LIMITS.frame
    board = _board(place[aside], away[aside] - axis.diameter / 2.0, up[aside], axis, seen_from)
    # What hangs at the post's own heights like a wall goes on above them, and is no board there.
    over = None if wall.any() else _overhead_board(place, offset, up, axis, seen_from)
    if over is not None:
        return HangingParts(top, 0.0, over, 0.0, np.nan, np.nan, (0.0, 0.0), overhead=True)
    return HangingParts(top, 0.0, board, *_arm(offset[beside], away[beside], up[beside]),
                        int(np.count_nonzero(wall)), _straight(offset[wall]))


def _hanging(offset: np.ndarray, height: np.ndarray, away: np.ndarray) -> np.ndarray:
    """Mask (n,) of points that hang together with the stem, above what stands on the ground."""
    near = (away < LIMITS.reach) & (height > LIMITS.hanging)
    if not near.any():
        return near
    cells = np.floor(np.column_stack([offset[near], height[near]]) / LIMITS.voxel).astype(np.int64)
    low = cells.min(axis=0)
    full = np.zeros(cells.max(axis=0) - low + 1, bool)
    full[tuple((cells - low).T)] = True
    part = ndimage.label(full, np.ones((3, 3, 3), bool))[0][tuple((cells - low).T)]
    at_stem = part[away[near] < LIMITS.voxel]
    mine = near.copy()
    mine[near] = np.isin(part, np.unique(at_stem))
    return mine


def _straight(offset: np.ndarray) -> bool:
    """Whether places in plan lie along a straight line."""
    if len(offset) < 3:
        return False
    low, high = np.linalg.eigvalsh(np.cov(offset.T))
    return bool(low < LIMITS.straight**2 * high)


def _crown(offset: np.ndarray, away: np.ndarray, up: np.ndarray) -> float:
    """Diameter of a crown, m: leaves fill the room on all sides of the stem; 0 where they do not."""
    leaves = away > LIMITS.crown
    if np.count_nonzero(leaves) < LIMITS.crown_voxels or np.mean(
            up[leaves] < LIMITS.crown_low[0]) > LIMITS.crown_low[1]:
        return 0.0
    cells = np.floor(np.column_stack([offset, up])[leaves] / LIMITS.voxel).astype(np.int64)
    sector = ((np.arctan2(offset[leaves, 1], offset[leaves, 0]) / (2.0 * np.pi) + 0.5)
              * LIMITS.sectors).astype(np.int64) % LIMITS.sectors
    cells -= cells.min(axis=0)
    voxels = len(np.unique(np.ravel_multi_index(cells.T, cells.max(axis=0) + 1)))
    filled = np.count_nonzero(np.bincount(sector, minlength=LIMITS.sectors) >= 3)
    if voxels < LIMITS.crown_voxels or filled < LIMITS.filled:
        return 0.0
    return float(2.0 * np.percentile(away[leaves], 90.0))


def _board(place: np.ndarray, beyond: np.ndarray, up: np.ndarray, axis: StemAxis,
           seen_from: np.ndarray) -> Board | None:
    """The largest flat upright face at the stem; None without one. `beyond` (n,) m from the stem's surface."""
    near = np.flatnonzero(beyond < LIMITS.board[1])
    if len(near) < LIMITS.board_points:
        return None
    wide = _wide_slabs(beyond[near], up[near])
    near = near[wide]
    if len(near) < LIMITS.board_points:
        return None
    middle = np.median(place[near], axis=0)
    for _ in range(4):
        centred = place[near] - middle
        spread, axes = np.linalg.eigh(centred.T @ centred / len(near))
        normal = axes[:, 0]
        distance = np.abs(centred @ normal)
        keep = distance < max(2.5 * float(np.median(distance)), LIMITS.thick)
        if keep.all() or np.count_nonzero(keep) < LIMITS.board_points:
            break
        near = near[keep]
        middle = place[near].mean(axis=0)
    if np.sqrt(max(spread[0], 0.0)) > LIMITS.thick or abs(normal[2]) > LIMITS.upright:
        return None
    return outlined_board(place[near], normal, axis, seen_from)


def _overhead_board(place: np.ndarray, offset: np.ndarray, up: np.ndarray, axis: StemAxis,
                    seen_from: np.ndarray) -> Board | None:
    """The board on a beam over the road; None without one."""
    face = overhead_face(offset, up)
    if face is None:
        return None
    board = outlined_board(place[face[0]], face[1], None, seen_from)
    return board if board is not None and board.width * board.height > OVERHEAD.area else None


def _wide_slabs(beyond: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Mask (n,) of points at heights where something reaches beside the stem."""
    slab = np.floor(up / LIMITS.voxel).astype(np.int64)
    slab -= slab.min()
    farthest = np.zeros(slab.max() + 1)
    np.maximum.at(farthest, slab, beyond)
    return farthest[slab] > LIMITS.wide


def outlined_board(place: np.ndarray, normal: np.ndarray, axis: StemAxis | None, seen_from: np.ndarray) -> Board | None:
    """The board in which points of a plane lie; None where they make none. `axis` of its post, None without one."""
    level = np.array([normal[0], normal[1]]) / np.hypot(*normal[:2])
    middle = place.mean(axis=0)
    if level @ (seen_from - middle[:2]) < 0:
        level = -level
    across = (place[:, :2] - middle[:2]) @ np.array([-level[1], level[0]])
    up = place[:, 2] - middle[2]
    side = np.array([-level[1], level[0]])
    post = None if axis is None else axis.plan_at(middle[2])
    at_post = 0.0 if post is None else (post - middle[:2]) @ side
    # The post's own points go on under a board, and tell none of its edges.
    aside = up if axis is None else up[np.abs(across - at_post) > axis.diameter / 2.0 + LIMITS.off_post]
    low, high = np.percentile(aside if len(aside) >= LIMITS.board_points else up, [1, 99])
    # What ends at its post on one side and reaches far out on the other is often hidden by the post from behind.
    for rows in [np.arange(len(across))] if axis is None else _by_halves(across - at_post, axis.diameter / 2.0):
        left, right = np.percentile(across[rows], [1, 99])
        if axis is not None:
            left, right = min(left, at_post), max(right, at_post)
        one_sided = axis is not None and (
            min(abs(left - at_post), abs(right - at_post)) < axis.diameter / 2.0 + LIMITS.beside_post)
        shaded = one_sided and _shaded(left - at_post, right - at_post, side, level, seen_from - post)
        if shaded:
            break
    hull = shapely.convex_hull(shapely.multipoints(np.column_stack([across, up])[rows]))
    if hull.area < 0.5 * (right - left) * (high - low):
        return None
    if shaded:
        reach = max(abs(left - at_post), abs(right - at_post))
        left, right = at_post - reach, at_post + reach
    width, tall = right - left, high - low
    if not all(LIMITS.board[0] <= size <= LIMITS.board[1] for size in (width, tall)):
        return None
    centre = middle + np.array([*(side * (left + right) / 2.0), (low + high) / 2.0])
    return Board(centre, float(np.degrees(np.arctan2(level[0], level[1])) % 360.0), float(width), float(tall),
                 not one_sided)


def _by_halves(across: np.ndarray, radius: float) -> list[np.ndarray]:
    """Rows of the points of a board: first without the side of its post on which few are beside many on the other, as
    where the post hid that half from one drive; then all. `across` (n,) from the axis, `radius` of the post, m."""
    post = radius + LIMITS.off_post
    left, right = across < -post, across > post
    few, many = sorted([left, right], key=np.count_nonzero)
    every = np.arange(len(across))
    return [np.flatnonzero(~few), every] if np.count_nonzero(few) < LIMITS.emptier * np.count_nonzero(many) else [every]


def _shaded(left: float, right: float, side: np.ndarray, level: np.ndarray, view: np.ndarray) -> bool:
    """Whether the post hides the other half of a board that shows from `left` to `right` of it, m: the survey looked
    along the face (`side`, `level` (2,): along and across it) from the half that shows; `view` (2,) to the survey."""
    reach = right if abs(right) > abs(left) else left
    along, off = float(view @ side), float(abs(view @ level))
    return along * reach > 0.0 and off * abs(reach) < LIMITS.shade * abs(along)


def _arm(offset: np.ndarray, away: np.ndarray, up: np.ndarray) -> tuple[float, float, float, tuple[float, float]]:
    """Length, azimuth, height of an arm, and the size of what is at its end."""
    none = 0.0, np.nan, np.nan, (0.0, 0.0)
    if len(away) < 4:
        return none
    length = float(np.percentile(away, 98.0))
    if length < LIMITS.arm:
        return none
    out = away > 0.5 * length
    direction = offset[out].mean(axis=0)
    if np.hypot(*direction) < 0.7 * away[out].mean() or np.ptp(np.percentile(up[out], [5, 95])) > LIMITS.flat:
        return none  # on several sides, or no arm but a wall
    direction /= np.hypot(*direction)
    head = away > length - 1.0
    beside = (offset @ np.array([-direction[1], direction[0]]))[head]
    width, tall = (float(np.ptp(np.percentile(values, [2, 98]))) for values in (beside, up[head]))
    return length, float(np.degrees(np.arctan2(*direction)) % 360.0), float(np.median(up[out])), (width, tall)
