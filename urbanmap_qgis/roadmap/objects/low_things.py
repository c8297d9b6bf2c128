"""Low things that stand free beside a road: bollards, and boxes such as cabinets and post boxes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from .object_records import Stem
from .sweep_index import SweepIndex


@dataclass(frozen=True)
class LowThingLimits:
    """Limits of low things, each with its unit."""

    lowest: float = 0.3  # m above the ground
    begins: float = 0.5  # m above the ground, where a bollard shows at the latest
    bollard: tuple[float, float] = (0.5, 1.5)  # m, heights
    bollard_cell: float = 0.1  # m in plan: what is farther apart is not joined
    wide: float = 0.35  # m, extent of a bollard in plan
    few: int = 20  # points of a bollard
    level: float = 0.1  # m of height
    filled: float = 0.6  # share of its levels in which a bollard shows
    slant: float = 0.2  # m across for each metre up, from the lower to the upper third of a bollard
    about: float = 0.3  # m in plan and
    over: float = 0.6  # m of height over a bollard, where a post would go on
    goes_on: float = 0.25  # points there, of those of the bollard: it is a part of a post
    box: tuple[float, float] = (0.7, 2.0)  # m, heights
    box_cell: float = 0.1  # m in plan
    turn: float = 3.0  # degrees from one direction of its sides to the next that is tried
    stray: float = 1.0  # % of its points that may lie outside either of its sides
    box_few: int = 60  # points of a box
    side: tuple[float, float] = (0.2, 1.7)  # m, of a box; thinner are rails, longer vehicles
    face: float = 0.05  # m from its sides or its top, where the points of a box lie
    on_faces: float = 0.85  # of its points that lie there
    # m above the ground, from which on boxes are looked for: from the ground, and over bollards and rails before them
    box_from: tuple[float, float] = (0.3, 0.9)
    box_begins: float = 0.5  # m over that, where a box shows at the latest
    box_rise: float = 0.3  # m over that, to which it goes on at least
    same: float = 0.5  # m between the middles of boxes that are one


LIMITS = LowThingLimits()


@dataclass(frozen=True)
class UprightBox:
    """An upright box on the ground.

    Attributes
    ----------
    rows : (n,) of its tile's points.
    centre : (2,) m, of its plan.
    width : m, of its longer sides.
    azimuth : degrees from north, clockwise, to which a longer side faces; the opposite is as good.
    high : m above the ground.
    """

    rows: np.ndarray
    centre: np.ndarray
    width: float
    azimuth: float
    high: float


def bollards(place: np.ndarray, height: np.ndarray, index: SweepIndex, where: np.ndarray) -> list[Stem]:
    """Thin things that stand up from the ground and end at the height of a bollard.

    Parameters
    ----------
    place : (n, 3) points, m, as in the index.
    height : (n,) above the ground, m.
    where : (n,) mask of points that are looked at.
    """
    band = np.flatnonzero(where & (height > LIMITS.lowest) & (height < LIMITS.bollard[1] + LIMITS.level))
    found = []
    for rows in _parts(place, band, LIMITS.bollard_cell, LIMITS.few, LIMITS.wide):
        low, high = float(height[rows].min()), float(height[rows].max())
        if not LIMITS.bollard[0] < high < LIMITS.bollard[1] or low > LIMITS.begins:
            continue
        levels = np.unique(np.floor((height[rows] - LIMITS.lowest) / LIMITS.level)).size
        filled = min(levels * LIMITS.level / (high - LIMITS.lowest), 1.0)
        if _slant(place[rows, :2], height[rows]) > LIMITS.slant:
            continue
        near = height[index.near(place[rows, :2].mean(axis=0), LIMITS.about)]
        over = np.count_nonzero((near > high + LIMITS.level / 2.0) & (near < high + LIMITS.over))
        if filled > LIMITS.filled and over < LIMITS.goes_on * len(rows):
            found.append(Stem(rows, low, high, filled))
    return found


def _slant(plan: np.ndarray, height: np.ndarray) -> float:
    """m that the middle of what is seen moves across for each metre up."""
    low, high = np.percentile(height, [33.3, 66.7])
    lower, upper = height <= low, height >= high
    rise = height[upper].mean() - height[lower].mean()
    return float(np.hypot(*(plan[upper].mean(axis=0) - plan[lower].mean(axis=0))) / rise)


def boxes(place: np.ndarray, height: np.ndarray, where: np.ndarray) -> list[UprightBox]:
    """Things whose points lie on the upright sides and the top of a box; parameters as in `bollards`."""
    found: list[UprightBox] = []
    for lowest in LIMITS.box_from:
        band = np.flatnonzero(where & (height > lowest) & (height < LIMITS.box[1] + 2.0 * LIMITS.box_cell))
        for rows in _parts(place, band, LIMITS.box_cell, LIMITS.box_few, LIMITS.side[1]):
            high = float(height[rows].max())
            if (max(LIMITS.box[0], lowest + LIMITS.box_rise) < high < LIMITS.box[1]
                    and height[rows].min() < lowest + LIMITS.box_begins):
                box = _box(place[rows, :2], height[rows], rows)
                if box is not None and all(np.hypot(*(box.centre - one.centre)) > LIMITS.same for one in found):
                    found.append(box)
    return found


def _parts(place: np.ndarray, band: np.ndarray, cell: float, few: int, widest: float) -> list[np.ndarray]:
    """Rows of each part of the `band` (m,) that hangs together in plan, has enough points and is no wider, m."""
    if not len(band):
        return []
    cells = np.floor(place[band, :2] / cell).astype(np.int64)
    cells -= cells.min(axis=0)
    full = np.zeros(cells.max(axis=0) + 1, bool)
    full[tuple(cells.T)] = True
    part = ndimage.label(full, np.ones((3, 3), bool))[0][tuple(cells.T)]
    order = np.argsort(part, kind="stable")
    starts = np.flatnonzero(np.diff(part[order], prepend=-1))
    count = np.diff(np.append(starts, len(order)))
    low, high = (extreme.reduceat(place[band[order], :2], starts) for extreme in (np.minimum, np.maximum))
    good = np.flatnonzero((count >= few) & ((high - low).max(axis=1) <= widest))
    return [band[order[starts[k]:starts[k] + count[k]]] for k in good]


def _box(plan: np.ndarray, height: np.ndarray, rows: np.ndarray) -> UprightBox | None:
    """The box on whose sides and top most points lie, of those turned anyhow; None where too few do."""
    turn = np.radians(np.arange(0.0, 90.0, LIMITS.turn))
    middle = plan.mean(axis=0)
    # (directions, the two sides of each, points) of m.
    ways = np.stack([np.column_stack([np.sin(turn), np.cos(turn)]), np.column_stack([np.cos(turn), -np.sin(turn)])], 1)
    along = ways @ (plan - middle).T
    low, high = np.percentile(along, [LIMITS.stray, 100.0 - LIMITS.stray], axis=2)
    away = np.minimum(np.abs(along - low[..., None]), np.abs(along - high[..., None])).min(axis=1)
    share = ((away < LIMITS.face) | (height > height.max() - LIMITS.face)).mean(axis=1)
    best = int(np.argmax(share))
    length = high[best] - low[best]
    if share[best] < LIMITS.on_faces or length.min() < LIMITS.side[0] or length.max() > LIMITS.side[1]:
        return None
    centre = middle + ((low[best] + high[best]) / 2.0) @ ways[best]
    across = ways[best, int(np.argmin(length))]
    azimuth = float(np.degrees(np.arctan2(*across)) % 180.0)
    return UprightBox(rows, centre, float(length.max()), azimuth, float(height.max()))
