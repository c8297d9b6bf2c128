"""Ground points by cloth simulation (Zhang et al. 2016; J 3.2.3.1).

A cloth is drawn up against the cloud from below: it rests against the ground and stays taut under buildings,
trees and vehicles. Points within a threshold of it are ground.

Zhang lets the cloth move in time steps and stops after a number of them. Here its equilibrium is computed
directly: the taut surface with u <= z everywhere and, where it does not touch, curvature = -weight (a membrane
over an obstacle), by projected relaxation from coarse to fine. It is the same for every cut of the data, does
not depend on a time step, and is reached in tens of sweeps. Three things are added to the paper's filter:
a stiff trend surface carries the cloth, so that slopes need no slack; points alone below the ground are left
out; and the slope step of the paper (lift the cloth to ground that continues without a jump) is repeated
until nothing changes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from ..errors import InsufficientDataError
from ..geometry.grid import Grid
from ..geometry.linked_groups import linked_groups
from ..geometry.sampling import Bilinear
from ..progress import SILENT, Progress
from ..settings.terrain import ClothSettings
from ..wording import say
from .delaunay import extreme_in_cells
from .lowest_heights import NEIGHBOUR_STEP, PIT_DEPTH, LowestHeights, lowest_heights, node_of_points
from .outliers import isolation_limit, plausible
from .trend import trend_surface

# Curvature of the free cloth, 1/m, by rigidness: 1 steep slopes, 2 hills, 3 flat towns. At 0.002 it sags 1.5 m
# under a hall of 100 m by 100 m.
_CURVATURE = {1: 0.02, 2: 0.006, 3: 0.002}

CONVERGED = 0.002
STEP = 0.3
LAYER = 0.2
PIT_RADIUS = 4
PIT_CELLS = 12
PIT_ROUNDS = 30
FIRM = 0.1
LIFTS = 20

JAVANMARDI = ClothSettings()
"""The settings of J Table 3-2."""


def classify_ground(x: np.ndarray, y: np.ndarray, z: np.ndarray, settings: ClothSettings = JAVANMARDI,
                    progress: Progress = SILENT) -> np.ndarray:
    """Which points are ground, (n,) bool.

    Parameters
    ----------
    x, y, z : (n,) metres; points that are not finite or of absurd height are not ground.

    Raises
    ------
    InsufficientDataError : no usable point.
    """
    usable = _usable(x, y, z)
    _, heights, bottom = converged_cloth(x[usable], y[usable], z[usable], settings, progress)
    ground = bottom.points[np.abs(bottom.z - bottom.place.heights(heights)) <= settings.threshold]
    mask = np.zeros(len(z), dtype=bool)
    mask[ground if isinstance(usable, slice) else np.flatnonzero(usable)[ground]] = True
    return mask


def _usable(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray | slice:
    """What picks the plausible points: all of them, or a mask."""
    usable = plausible(x, y, z)
    if not usable.any():
        raise InsufficientDataError(say("The cloud has no point with a usable height."))
    return slice(None) if usable.all() else usable


def converged_cloth(x: np.ndarray, y: np.ndarray, z: np.ndarray, settings: ClothSettings,
                    progress: Progress) -> tuple[Grid, np.ndarray, BottomPoints]:
    """The grid of the cloth's nodes (its cell centres), its heights (rows, columns), m, without gaps, and the points
    near the bottom of each cell; x, y, z (n,) are plausible, m."""
    grid = Grid.covering(x.min(), y.min(), x.max(), y.max(), settings.resolution)
    # One cell more: bilinear places need two in each direction.
    grid = Grid(grid.x_min, grid.y_max, grid.cell, grid.rows + 1, grid.columns + 1)
    levels = lowest_heights(x, y, z, grid, isolation_limit(len(z), float(np.ptp(x) * np.ptp(y)) or 1.0))
    progress.step(0.4)
    first, trend, lowest = first_cloth(levels, settings, progress.part(0.4, 0.5))
    bottom = bottom_points(x, y, z, grid, lowest)
    lowest = lowest_layer(bottom, first)
    progress.step(0.7)
    return grid, final_cloth(lowest, trend, settings, progress.part(0.7, 0.9)), bottom


@dataclass(frozen=True)
class BottomPoints:
    """The believed points near the bottom of their cell: all that can become ground.

    Attributes
    ----------
    points : (m,) their indices.
    cell : (m,) flat cell numbers.
    z : (m,) heights.
    place : where they lie between the cell centres.
    """

    points: np.ndarray
    cell: np.ndarray
    z: np.ndarray
    place: Bilinear


def bottom_points(x: np.ndarray, y: np.ndarray, z: np.ndarray, grid: Grid, lowest: np.ndarray) -> BottomPoints:
    """Points up to two cell widths (a slope of 60 degrees) above the lowest believed height of their cell.

    Parameters
    ----------
    x, y, z : (n,) metres, all on the grid.
    lowest : (rows, columns) from `first_cloth`.
    """
    cell = node_of_points(x, y, grid)
    height = z - lowest.ravel()[cell]
    points = np.flatnonzero((height >= 0) & (height < 2 * grid.cell))
    return BottomPoints(points, cell[points], z[points], Bilinear.of(grid, x[points], y[points]))


def lowest_layer(bottom: BottomPoints, cloth: np.ndarray) -> np.ndarray:
    """Height of the lowest layer of each cell at its centre, (rows, columns), inf where there is none.

    The mean, over the points within 0.2 m of the lowest one, of their height above the first cloth, added to
    the cloth's height at the centre: a sloping cell is then not represented by its lower edge, nor level
    ground by its noise. A cell's answer depends on its own points only.
    """
    above = bottom.z - bottom.place.heights(cloth)
    lowest = extreme_in_cells(bottom.cell, above, cloth.size, highest=False)
    layer = np.flatnonzero(above <= lowest[bottom.cell] + LAYER)
    cell = bottom.cell[layer]
    count = np.bincount(cell, minlength=cloth.size)
    total = np.bincount(cell, weights=above[layer], minlength=cloth.size)
    mean = np.divide(total, count, out=np.full(cloth.size, np.inf), where=count > 0)
    return cloth + mean.reshape(cloth.shape)


def first_cloth(levels: LowestHeights, settings: ClothSettings,
         progress: Progress = SILENT) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The first cloth, with pits below the ground left out.

    A pit is a small patch that holds the cloth down, whose cells have few points, or most of them more than a
    metre above, and that has no firm cell at its level within some cells: multipath in numbers. A real courtyard
    has cells full of ground points. The cells of a pit fall back to their second level, and the cloth is hung
    again.

    Returns
    -------
    cloth, trend and believed lowest heights, (rows, columns) each.
    """
    lowest, second, support = levels.lowest, levels.second, levels.support
    if not np.isfinite(lowest).any():
        raise InsufficientDataError(say("The cloud has no points that could be ground."))
    filled = support[support > 0]
    firm = support >= max(FIRM * float(np.median(filled)), 1.0) if len(filled) else support > 0
    # Pits must not tilt the trend. Under dense forest hardly any cell is firm: there all must serve.
    enough = np.count_nonzero(firm) > FIRM * np.count_nonzero(np.isfinite(lowest))
    trend = trend_surface(np.where(firm, lowest, np.inf) if enough else lowest, settings.resolution)
    for _ in range(PIT_ROUNDS):
        obstacle = lowest - trend
        cloth = _equilibrium(obstacle, settings, np.zeros(lowest.shape, dtype=bool), progress)
        pit = _pits(obstacle, _grow(obstacle, obstacle - cloth <= PIT_DEPTH), firm)
        if not pit.any():
            break
        lowest = np.where(pit, second, lowest)
        # What turns out to be a pit again has no further level: the cell counts as empty.
        second = np.where(pit, np.inf, second)
        if not np.isfinite(lowest).any():
            raise InsufficientDataError(say("The cloud has no points that could be ground."))
    return trend + cloth, trend, lowest


def _pits(obstacle: np.ndarray, ground: np.ndarray, firm: np.ndarray) -> np.ndarray:
    """Cells of small patches of ground without a firm cell at their level nearby, (rows, columns) bool."""
    suspect = ground & ~firm
    row, column = np.nonzero(suspect)
    if not len(row):
        return suspect
    support = np.pad(np.where(ground & firm, obstacle, np.nan), PIT_RADIUS, constant_values=np.nan)
    level = obstacle[row, column]
    supported = np.zeros(len(row), dtype=bool)
    for down in range(2 * PIT_RADIUS + 1):
        for right in range(2 * PIT_RADIUS + 1):
            supported |= np.abs(support[row + down, column + right] - level) < NEIGHBOUR_STEP
    patch, count = ndimage.label(ndimage.binary_dilation(suspect, np.ones((5, 5), dtype=bool)), np.ones((3, 3)))
    patch = np.where(suspect, patch, 0)
    cells = np.bincount(patch.ravel(), minlength=count + 1)
    is_pit = cells <= PIT_CELLS
    is_pit[patch[row[supported], column[supported]]] = False
    is_pit[0] = False
    return is_pit[patch]


def final_cloth(lowest: np.ndarray, trend: np.ndarray, settings: ClothSettings,
           progress: Progress = SILENT) -> np.ndarray:
    """Cloth in equilibrium against `lowest`, lifted to all ground that continues without a jump.

    Parameters
    ----------
    lowest : (rows, columns) metres, inf where there is no point.
    trend : (rows, columns), see `trend_surface`.

    Returns
    -------
    (rows, columns) metres, nowhere above `lowest`.
    """
    obstacle = lowest - trend
    pinned = np.zeros(lowest.shape, dtype=bool)
    cloth = _equilibrium(obstacle, settings, pinned, progress)
    for _ in range(LIFTS):
        progress.check()
        grown = _grow(obstacle, pinned | (obstacle - cloth <= settings.threshold))
        if np.array_equal(grown, pinned):
            break
        pinned = grown
        cloth = _equilibrium(obstacle, settings, pinned, progress, start=np.where(pinned, obstacle, cloth))
    return trend + cloth


def _grow(obstacle: np.ndarray, ground: np.ndarray) -> np.ndarray:
    """Ground nodes and all that are joined to them by steps below 0.3 m, (rows, columns) bool."""
    number = np.arange(obstacle.size).reshape(obstacle.shape)
    joined = []
    with np.errstate(invalid="ignore"):
        for first, second in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
            smooth = np.abs(obstacle[first] - obstacle[second]) < STEP
            joined.append((number[first][smooth], number[second][smooth]))
    start, end = (np.concatenate(ends) for ends in zip(*joined))
    count, label = linked_groups(start, end, obstacle.size)
    reached = np.zeros(count, dtype=bool)
    reached[label[ground.ravel()]] = True
    return reached[label].reshape(obstacle.shape)


def _equilibrium(obstacle: np.ndarray, settings: ClothSettings, pinned: np.ndarray, progress: Progress,
          start: np.ndarray | None = None) -> np.ndarray:
    """Membrane in equilibrium below `obstacle` (inf: none), held to it where `pinned`.

    Without a start, the equilibrium on a grid twice as coarse is the start.
    """
    finite = np.isfinite(obstacle)
    if not finite.any():
        raise InsufficientDataError(say("The cloud has no point with a usable height."))
    if start is None:
        if min(obstacle.shape) <= 4:
            start = np.full(obstacle.shape, obstacle[finite].min())
        else:
            coarse = ClothSettings(settings.resolution * 2, settings.threshold, settings.iterations,
                                   settings.rigidness)
            pooled = _lowest_of_four(obstacle)
            start = _equilibrium(pooled, coarse, np.zeros(pooled.shape, dtype=bool), progress)
            start = start.repeat(2, axis=0).repeat(2, axis=1)[:obstacle.shape[0], :obstacle.shape[1]]
    return _relax(start, obstacle, np.where(finite, _sag(settings), 0.0), pinned, settings.iterations, progress)


def _sag(settings: ClothSettings) -> float:
    """Height that weight adds in one relaxation of a free node, m."""
    return _CURVATURE[settings.rigidness] * settings.resolution ** 2 / 4


def _lowest_of_four(obstacle: np.ndarray) -> np.ndarray:
    """Obstacle on a grid twice as coarse."""
    rows, columns = obstacle.shape
    padded = np.pad(obstacle, ((0, rows % 2), (0, columns % 2)), constant_values=np.inf)
    return padded.reshape(padded.shape[0] // 2, 2, padded.shape[1] // 2, 2).min(axis=(1, 3))


def _relax(start: np.ndarray, obstacle: np.ndarray, sag: np.ndarray, pinned: np.ndarray, iterations: int,
           progress: Progress) -> np.ndarray:
    """Projected over-relaxation in checkerboard order until no node moves by more than 2 mm in a sweep."""
    rows, columns = start.shape
    cloth = np.pad(np.minimum(start, obstacle), 1, mode="edge")
    floor = np.where(pinned, obstacle, -np.inf)
    quarters = [(slice(i, rows, 2), slice(j, columns, 2)) for i, j in ((0, 0), (1, 1), (0, 1), (1, 0))
                if i < rows and j < columns]
    parts = [(q, np.ascontiguousarray(obstacle[q]), np.ascontiguousarray(sag[q]),
              np.ascontiguousarray(floor[q])) for q in quarters]
    inner = cloth[1:-1, 1:-1]
    north, south, west, east = cloth[:-2, 1:-1], cloth[2:, 1:-1], cloth[1:-1, :-2], cloth[1:-1, 2:]
    factor = 1.7
    for sweep in range(iterations):
        moved = 0.0
        for quarter, ceiling, weight, hold in parts:
            old = inner[quarter]
            new = north[quarter] + south[quarter]
            new += west[quarter]
            new += east[quarter]
            new *= 0.25
            new += weight
            new -= old
            new *= factor
            new += old
            np.minimum(new, ceiling, out=new)
            np.maximum(new, hold, out=new)
            moved = max(moved, float(np.abs(new - old).max()))
            inner[quarter] = new
        cloth[0], cloth[-1] = cloth[1], cloth[-2]
        cloth[:, 0], cloth[:, -1] = cloth[:, 1], cloth[:, -2]
        if moved < CONVERGED:
            break
        if sweep % 50 == 49:
            progress.check()
    return inner.copy()
