"""What hangs on a stem and what stands round it: crowns, and boxes round all else, which tell its kind."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from .object_records import HangingThing, StemAxis


@dataclass(frozen=True)
class HangingPartsLimits:
    """Limits of hanging parts, each with its unit."""

    voxel: float = 0.3  # m: what is farther apart does not hang together
    reach: float = 5.5  # m from the axis; what goes on beyond is no part of a post
    hanging: float = 1.0  # m above the ground; below it stand cars, hedges and people
    skin: tuple[float, float] = (0.03, 0.2)  # m, and of its diameter, that a stem's points lie outside its radius
    sectors: int = 8  # of directions, and those of them that a crown fills
    filled: int = 5
    crown: float = 0.45  # m from the axis, where crowns begin and arms are thin
    crown_voxels: int = 25  # of a crown, at least
    crown_low: tuple[float, float] = (1.6, 0.1)  # m above the ground below which crowns have this share at most
    wall: float = 1.0  # m from the axis: what hangs on a post so far out, at its own heights, is a wall
    straight: float = 0.15  # spread of a wall across, of that along
    wall_top: float = 4.0  # m above the ground; arms hang higher
    cell: float = 0.15  # m: side of the columns and the slabs of height that tell heads and boards from arms
    tall: float = 0.28  # m, of a column that is more than an arm
    few: int = 6  # points of a thing, and
    share: float = 0.1  # of all off the stem
    edges: float = 2.0  # % of its points left out at either end of a side
    turn: float = 3.0  # degrees from one direction of its sides to the next that is tried
    arm: float = 0.4  # m, shortest arm
    end: float = 0.9  # m, of an arm's end, longer than lamps are


LIMITS = HangingPartsLimits()


@dataclass(frozen=True)
class HangingParts:
    """What hangs on a stem.

    Attributes
    ----------
    top : highest point of all that hangs together, m above the ground.
    crown : diameter of a crown, m; 0 without one.
    things : heads, boards and ends of arms.
    wall : points of what hangs on it at its own heights like a wall, and whether it is as straight as one.
    """

    top: float
    crown: float = 0.0
    things: tuple[HangingThing, ...] = ()
    wall: int = 0
    straight: bool = False


def hanging_parts(place: np.ndarray, height: np.ndarray, axis: StemAxis, stem_top: float) -> HangingParts:
    """What hangs on a stem.

    Parameters
    ----------
    place : (n, 3) points within `reach` of the axis, m.
    height : (n,) above the ground, m.
    stem_top : m above the ground, up to which the stem is thin.
    """
    offset = place[:, :2] - axis.plan_at(place[:, 2])
    away = np.hypot(*offset.T)
    rows = np.flatnonzero(_hanging(offset, height, away))
    offset, away, up = offset[rows], away[rows], height[rows]
    if not len(up):
        return HangingParts(stem_top)
    top = float(max(stem_top, np.percentile(up, 99.5)))
    crown = _crown(offset, away, up)
    if crown:
        return HangingParts(top, crown)
    wall = (away > LIMITS.wall) & (up < min(stem_top, LIMITS.wall_top))
    off = np.flatnonzero(away > off_stem(axis))
    things = _things(offset[off], up[off], rows[off]) if len(off) else ()
    return HangingParts(top, 0.0, things, int(np.count_nonzero(wall)), _straight(offset[wall]))


def off_stem(axis: StemAxis) -> float:
    """m from an axis, from which points are none of its stem's."""
    return axis.diameter / 2.0 + LIMITS.skin[0] + LIMITS.skin[1] * axis.diameter


def _hanging(offset: np.ndarray, height: np.ndarray, away: np.ndarray) -> np.ndarray:
    """Mask (n,) of points that hang together with the stem, above what stands on the ground."""
    near = (away < LIMITS.reach) & (height > LIMITS.hanging)
    if not near.any():
        return near
    part = linked_parts(np.column_stack([offset[near], height[near]]), LIMITS.voxel)
    at_stem = part[away[near] < LIMITS.voxel]
    mine = near.copy()
    mine[near] = np.isin(part, np.unique(at_stem))
    return mine


def linked_parts(place: np.ndarray, cell: float) -> np.ndarray:
    """Number (n,), from 1, of the part of points (n, 3) that hangs together in cells of a side, m."""
    cells = np.floor(place / cell).astype(np.int64)
    cells -= cells.min(axis=0)
    full = np.zeros(cells.max(axis=0) + 1, bool)
    full[tuple(cells.T)] = True
    return ndimage.label(full, np.ones((3, 3, 3), bool))[0][tuple(cells.T)]


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


def _things(offset: np.ndarray, up: np.ndarray, rows: np.ndarray) -> tuple[HangingThing, ...]:
    """Boxes round what is taller than an arm, and round the ends of arms that hold none of these.

    Parameters
    ----------
    offset, up : (n, 2) from the axis, and (n,) above the ground, of the points off the stem, m.
    rows : (n,) their numbers.
    """
    tall = _in_tall_columns(offset, up)
    place = np.column_stack([offset, up])
    things = [box_round(place[part], rows[part]) for part in _groups(place, np.flatnonzero(tall))]
    for part in _groups(place, np.flatnonzero(~tall)):
        away = np.hypot(*offset[part].T)
        tip = float(np.percentile(away, 100.0 - LIMITS.edges))
        end = part[away > tip - LIMITS.end]
        held = any(np.linalg.norm(thing.middle - place[part], axis=1).min() < LIMITS.voxel + max(thing.sides) / 2.0
                   for thing in things if thing.away > LIMITS.arm)
        if tip > LIMITS.arm and not held and len(end) >= LIMITS.few:
            things.append(box_round(place[end], rows[end]))
    return tuple(thing for thing in things if len(thing.rows) > LIMITS.share * len(rows))


def _in_tall_columns(offset: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Mask (n,) of points in columns of points without a gap that are taller than an arm."""
    column = np.unique(np.floor(offset / LIMITS.cell).astype(np.int64), axis=0, return_inverse=True)[1].ravel()
    order = np.lexsort((up, column))
    starts = (np.diff(column[order], prepend=-1) != 0) | (np.diff(up[order], prepend=-np.inf) > 2.0 * LIMITS.cell)
    run = np.cumsum(starts) - 1
    first = np.flatnonzero(starts)
    last = np.append(first[1:], len(order)) - 1
    tall = np.zeros(len(up), bool)
    tall[order] = (up[order][last] - up[order][first] > LIMITS.tall)[run]
    return tall


def _groups(place: np.ndarray, some: np.ndarray) -> list[np.ndarray]:
    """Those of some rows (m,) of points (n, 3) that hang together, of each thing."""
    if not len(some):
        return []
    part = linked_parts(place[some], LIMITS.voxel)
    return [some[part == number] for number in np.flatnonzero(np.bincount(part) >= LIMITS.few)]


def box_round(place: np.ndarray, rows: np.ndarray) -> HangingThing:
    """The smallest upright box round points (n, 3) in plan from an axis and above the ground, m."""
    turn = np.radians(np.arange(0.0, 90.0, LIMITS.turn))
    ways = np.stack([np.column_stack([np.sin(turn), np.cos(turn)]), np.column_stack([np.cos(turn), -np.sin(turn)])], 1)
    low, high = np.percentile(ways @ place[:, :2].T, [LIMITS.edges, 100.0 - LIMITS.edges], axis=2)
    best = int(np.argmin((high - low).prod(axis=1)))
    bottom, top = np.percentile(place[:, 2], [LIMITS.edges, 100.0 - LIMITS.edges])
    middle = np.array([*((low[best] + high[best]) / 2.0) @ ways[best], (bottom + top) / 2.0])
    thin, long = np.argsort(high[best] - low[best])
    longer, shorter = (high[best] - low[best])[[long, thin]]
    aside = abs(float(middle[:2] @ ways[best, thin]))
    return HangingThing(rows, middle, (float(longer), float(shorter), float(top - bottom)), aside)
