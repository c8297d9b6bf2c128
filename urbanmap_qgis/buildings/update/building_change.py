"""What became of one building: its old roofs against the new points inside its outline."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy import ndimage

from ...geometry.grouped_median import grouped_median
from ...geometry.tolerances import SIGMA_OF_MAD
from ...settings.buildings import UpdateSettings
from ...wording import say
from ..quality import RoofCell, height_differences, points_over

SAME, NEW, GONE, RAISED, LOWERED, REBUILT, EXTENDED, REDUCED, UNSEEN = (
    "same", "new", "gone", "raised", "lowered", "rebuilt", "extended", "reduced", "unseen")

SIGMAS = 3.0
"""A cell differs from the old roof from this many standard deviations on."""
WHOLE = 0.6
"""Share of the roof that a change of the building as a whole takes."""
ONE_WAY = 0.2
"""Area of what changed the other way, as a share, below which a roof was raised or lowered and not rebuilt."""
RANGE = (0.05, 0.95)
"""Shares of a roof between which its heights are taken to lie, chimneys and gutters apart."""
DRAIN_FALL = 0.02
"""Slope (m a m) that flat roofs have for their drains."""
LEAST_SEEN = 0.5
"""Share of the outline's cells in which the new cloud shows roof or ground, below which nothing is said."""


@dataclass(frozen=True)
class OldBuilding:
    """A building of the old model: its outline in plan, its roofs (none: the outline alone is known), and the standard
    deviation of its heights (m; NaN: not known)."""

    outline: shapely.Geometry
    roofs: Sequence[RoofCell]
    sigma: float = float("nan")

    @property
    def is_block(self) -> bool:
        """Whether it is one level body, whose height stands for a roof of any shape."""
        return len({round(roof.height, 2) for roof in self.roofs}) == 1 and not any(map(_slopes, self.roofs))


@dataclass(frozen=True)
class Change:
    """What became of a building.

    Attributes
    ----------
    change : one of the kinds above; reason : in words.
    height_change : m, mean over the changed part of the roof (of all of it where nothing changed); NaN: not known.
    area_change : m2.
    significance : height change, or area change by its own sigma, in standard deviations.
    seen : share of the outline that the new cloud shows.
    """

    change: str
    reason: str
    height_change: float
    area_change: float
    significance: float
    seen: float


@dataclass(frozen=True)
class PlanCells:
    """Square cells of a building in plan, those inside its outline; per cell (rows, columns):

    Attributes
    ----------
    inside : whether it belongs to the building.
    difference : median height of the new points over the old roof, m; NaN without points or roof.
    ground : whether the new points are on the ground; `seen` : whether there are any.
    slope : (rows, columns, 2) of the old roof.
    side : m.
    """

    inside: np.ndarray
    difference: np.ndarray
    ground: np.ndarray
    seen: np.ndarray
    slope: np.ndarray
    side: float


def roof_differences(old: OldBuilding, points: np.ndarray, side: float) -> PlanCells:
    """Cells of a building with the new points (records `ROOF`) inside its outline; `side` in m."""
    west, south, east, north = old.outline.bounds
    columns, rows = int(np.ceil((east - west) / side)), int(np.ceil((north - south) / side))
    x, y = np.meshgrid(west + (np.arange(columns) + 0.5) * side, south + (np.arange(rows) + 0.5) * side)
    inner = old.outline.buffer(-side / 2.0)
    inside = shapely.contains_xy(inner if not inner.is_empty else old.outline, x, y)
    number = (np.clip((points["y"] - south) // side, 0, rows - 1) * columns
              + np.clip((points["x"] - west) // side, 0, columns - 1)).astype(np.int64)
    above = height_differences(points["x"], points["y"], points["z"], list(old.roofs))
    known = np.isfinite(above)
    difference = grouped_median(above[known], number[known], rows * columns)
    roofs = np.bincount(number, points["roof"], rows * columns)
    total = np.bincount(number, minlength=rows * columns)
    return PlanCells(inside, difference.reshape(rows, columns), (roofs < total / 2.0).reshape(rows, columns),
                     (total > 0).reshape(rows, columns), _slope_at(old.roofs, x, y), side)


def open_area(cells: PlanCells) -> float:
    """Area (m2) of the largest part of a building that is open ground now."""
    return float(_largest(cells.inside & cells.seen & cells.ground) * cells.side ** 2)


def building_change(old: OldBuilding, cells: PlanCells, noise: float, settings: UpdateSettings) -> Change:
    """Kind and size of the change of one building.

    Parameters
    ----------
    cells : with the offset of the epochs taken off.
    noise : standard deviation of a cell's height over all roofs, m.
    """
    inside = cells.inside & cells.seen
    seen = float(inside.sum() / max(cells.inside.sum(), 1))
    if seen < LEAST_SEEN:
        return Change(UNSEEN, say("The new points show {seen:.0%} of it.", seen=seen), np.nan, np.nan, 0.0, seen)
    cell = cells.side ** 2
    open_ground = inside & cells.ground
    lost = open_area(cells)
    if open_ground.sum() >= WHOLE * inside.sum():
        area = float(old.outline.area)
        return Change(GONE, say("Ground lies where it stood."), np.nan, -area, area / settings.min_area * SIGMAS, seen)
    roof = inside & ~cells.ground & np.isfinite(cells.difference)
    sigma = float(np.hypot(noise, old.sigma if np.isfinite(old.sigma) else 0.0))
    if not old.roofs or not roof.any():
        found = _reduced(lost, settings, seen)
        return found or Change(SAME, "" if old.roofs else say("Its old heights are not known."), np.nan, 0.0, 0.0, seen)
    values = cells.difference[roof]
    limit = max(SIGMAS * sigma, settings.min_height_change)
    if old.is_block:
        return _block_change(values, limit, sigma, lost, settings, seen)
    far = np.zeros_like(roof)
    far[roof] = np.abs(values) > limit
    up, down = far & (np.where(roof, cells.difference, 0.0) > 0), far & (np.where(roof, cells.difference, 0.0) < 0)
    areas = np.array([_largest(up), _largest(down)]) * cell
    if max(areas) < settings.min_area:
        return _reduced(lost, settings, seen) or Change(SAME, "", float(np.median(values)), 0.0,
                                                        abs(float(np.median(values))) / sigma, seen)
    return _roof_change(values, (up, down), cells, areas, limit, sigma, seen)


def _roof_change(values: np.ndarray, sides: tuple[np.ndarray, np.ndarray], cells: PlanCells, areas: np.ndarray,
                 limit: float, sigma: float, seen: float) -> Change:
    """Change of a roof of which at least one part of the least area differs."""
    height = float(np.median(cells.difference[sides[int(np.argmax(areas))]]))
    share = float(areas.sum() / max(len(values) * cells.side ** 2, 1e-9))
    significance = abs(height) / sigma
    one_way = min(areas) < ONE_WAY * max(areas)
    text = say("{area:.0f} m2 of its roof differ by {height:+.1f} m.", area=float(areas.sum()), height=height)
    if one_way and share < WHOLE:
        return Change(RAISED if height > 0 else LOWERED, text, height, 0.0, significance, seen)
    spread = SIGMA_OF_MAD * float(np.median(np.abs(values - np.median(values))))
    if one_way and spread < limit:
        return Change(RAISED if height > 0 else LOWERED, text, float(np.median(values)), 0.0, significance, seen)
    return Change(REBUILT, text, height, 0.0, significance, seen)


def _block_change(values: np.ndarray, limit: float, sigma: float, lost: float, settings: UpdateSettings,
                  seen: float) -> Change:
    """Change of a building that is known as one level block: its height has to lie within those of the roof."""
    low, high = np.quantile(values, RANGE)
    if low > limit or high < -limit:
        height = float(low if low > 0 else high)
        return Change(RAISED if height > 0 else LOWERED,
                      say("All of its roof lies {height:+.1f} m or more off the block.", height=height),
                      float(np.median(values)), 0.0, abs(height) / sigma, seen)
    return _reduced(lost, settings, seen) or Change(SAME, "", float(np.median(values)), 0.0, 0.0, seen)


def _reduced(lost: float, settings: UpdateSettings, seen: float) -> Change | None:
    """Change of a building of which a part of the least area is open ground now."""
    if lost < settings.min_area:
        return None
    return Change(REDUCED, say("Ground lies under {area:.0f} m2 of it.", area=lost), np.nan, -lost,
                  SIGMAS * lost / settings.min_area, seen)


def _largest(mask: np.ndarray) -> int:
    """Cells of the largest part of a mask without what is one cell wide."""
    opened = ndimage.binary_opening(mask, np.ones((2, 2), bool))
    label, _ = ndimage.label(opened)
    return int(np.bincount(label.ravel())[1:].max(initial=0))


def _slopes(roof: RoofCell) -> bool:
    """Whether a roof rises by more than a drain's fall."""
    return bool(np.hypot(*roof.gradient) > DRAIN_FALL)


def _slope_at(roofs: Sequence[RoofCell], x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Rise (rows, columns, 2) of the roofs at places, 0 where there is none."""
    slope = np.zeros((*x.shape, 2))
    flat = slope.reshape(-1, 2)
    for roof, rows in zip(roofs, points_over(x.ravel(), y.ravel(), list(roofs))):
        flat[rows] = roof.gradient
    return slope
