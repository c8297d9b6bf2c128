"""How much of each roof the points have seen, and how far off its height may be where they have not."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...geometry.grid import Grid
from ...geometry.tolerances import LEAST_SQUARE
from ..quality import RoofCell, height_differences, points_over

# Error and growth were measured on Delft west with parts deleted.
SPACINGS = 2.0  # Spacings of the cloud's points from the nearest roof point within which a place is seen.
CELLS_PER_SPACING = 2.0  # Cells of the plan a spacing.
MOST_CELLS = 20_000  # Cells of one plan.
# Height error far from all points, as a share of the model's height there over the ground: of level roofs, whose
# unseen part may be an annex or a yard, and of sloped ones, whose planes go on.
LEVEL_ERROR = 0.40
SLOPED_ERROR = 0.28
SLOPE = 0.09  # Rise (m a m) from which a roof is sloped.
GROWTH = 3.0  # Distance (m) beyond what is seen in which the error grows to 63 % of that.
LEAST_HEIGHT = 0.1  # Height (m) over the ground at least.
# Share of the plan that may be unseen before the quality falls: the RMSE leaves as much out.
TOLERATED = 0.05
FEWEST_CELLS = 10  # Cells of a plan from which the share without points is told: on fewer it would be chance.


@dataclass(frozen=True)
class SeenRoofs:
    """What the points have seen of one building's k roofs.

    Attributes
    ----------
    unseen : share of the plan farther than `SPACINGS` from every roof point.
    doubt : expected height error of the plan by what is not seen, m.
    seen : (k,) share of each roof that is seen.
    sigma : (k,) expected height error of each roof, m: of its points, and of what is not seen.
    """

    unseen: float
    doubt: float
    seen: np.ndarray
    sigma: np.ndarray


def seen_roofs(cells: list[RoofCell], points: np.ndarray, density: float, base: float) -> SeenRoofs:
    """What points have seen of roofs.

    Parameters
    ----------
    cells : the roofs.
    points : (n, 3) points on roofs, m.
    density : points a m2 of the cloud about the building.
    base : height of the ground, m.
    """
    spacing = 1.0 / math.sqrt(density)
    place, owner, share = _plan_places(cells, spacing)
    distance = np.full(len(place), np.inf)
    if len(points):
        distance = cKDTree(points[:, :2]).query(place)[0]
    far = distance > SPACINGS * spacing
    error = np.where(far, _errors(cells, place, owner, distance - SPACINGS * spacing, base), 0.0)
    unseen = min(float(share @ far), 1.0)
    doubt = math.sqrt(float(share @ error**2)) * max(unseen - TOLERATED, 0.0) / max(unseen, TOLERATED)
    weight = np.maximum(np.bincount(owner, share, len(cells)), LEAST_SQUARE)
    seen = 1.0 - np.bincount(owner, share * far, len(cells)) / weight
    grown = np.bincount(owner, share * error**2, len(cells)) / weight
    return SeenRoofs(unseen, doubt, seen, np.sqrt(_squared_misfits(cells, points) + grown))


def _plan_places(cells: list[RoofCell], spacing: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places (n, 2) spread evenly over the roofs, the roof of each (n,), and the share of the plan it stands for (n,).

    A roof too small for a place has one.
    """
    areas = np.array([cell.polygon.area for cell in cells])
    side = max(spacing / CELLS_PER_SPACING, math.sqrt(areas.sum() / MOST_CELLS))
    places, owners, shares = [], [], []
    for number, (cell, area) in enumerate(zip(cells, areas.tolist())):
        x, y = (axis.ravel() for axis in np.meshgrid(*Grid.covering(*cell.polygon.bounds, side).centres()))
        shapely.prepare(cell.polygon)
        inside = shapely.contains_xy(cell.polygon, x, y)
        in_cell = np.column_stack([x, y])[inside]
        if not len(in_cell):
            in_cell = shapely.get_coordinates(shapely.point_on_surface(cell.polygon))
        places.append(in_cell)
        owners.append(np.full(len(in_cell), number))
        shares.append(np.full(len(in_cell), area / len(in_cell)))
    share = np.concatenate(shares)
    return np.concatenate(places), np.concatenate(owners), share / share.sum()


def _errors(cells: list[RoofCell], place: np.ndarray, owner: np.ndarray, beyond: np.ndarray,
            base: float) -> np.ndarray:
    """Expected height errors (n,) at places that lie so far beyond what is seen (m)."""
    height = np.concatenate([cell.heights(*place[owner == number].T) for number, cell in enumerate(cells)])
    sloped = np.array([math.hypot(*cell.gradient) >= SLOPE for cell in cells])[owner]
    most = np.where(sloped, SLOPED_ERROR, LEVEL_ERROR) * np.maximum(height - base, LEAST_HEIGHT)
    return most * -np.expm1(-np.maximum(beyond, 0.0) / GROWTH)


def _squared_misfits(cells: list[RoofCell], points: np.ndarray) -> np.ndarray:
    """Mean squared height difference (k,) of the points over each roof, m2; of all of them where a roof has none."""
    if not len(points):
        return np.full(len(cells), np.nan)
    below = points_over(points[:, 0], points[:, 1], cells)
    squares = height_differences(*points.T, cells, below) ** 2
    everywhere = float(np.nanmean(squares)) if np.isfinite(squares).any() else math.nan
    return np.array([float(np.nanmean(squares[rows])) if len(rows) else everywhere for rows in below])


def unseen_share(plan: shapely.Geometry, points: np.ndarray, density: float) -> float:
    """Share of a plan's area without points (n, 3), on cells in which `density` points/m2 give four on average."""
    if not len(points):
        return 1.0
    grid = Grid.covering(*plan.bounds, 2.0 / math.sqrt(density))
    hit = np.zeros(grid.shape, bool)
    row, column, inside = grid.cells(points[:, 0], points[:, 1])
    hit[row[inside], column[inside]] = True
    x, y = np.meshgrid(*grid.centres())
    shapely.prepare(plan)
    within = shapely.contains_xy(plan, x, y)
    return float(1.0 - hit[within].mean()) if within.sum() >= FEWEST_CELLS else 0.0
