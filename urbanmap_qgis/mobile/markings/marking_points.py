"""Which ground points lie on road markings: adaptive threshold on calibrated intensity (J 3.2.3.3).

The points are laid on a fine grid of the ground. Paint is brighter than the Gaussian mean of a block (as on the aerial
side, J 3.2.2) and than the ground on both sides of it; where paint and ground meet, a point is paint if its intensity
lies above the middle between the two, so that the edge is not moved by the beam's width: a beam half on paint counts
by the half that its middle lies on. Kerbs, feet of walls and specks are told by height, size and shape.

A point's answer depends on the points within `MarkingPointSettings.reach` of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from ...geometry.grid import Grid
from ...settings.mobile import StrokeRules
from ...terrain.delaunay import extreme_in_cells

CELL = 0.05
"""m, side of the grid's cells."""

SPACINGS = (1.0, 2.0, 4.0, 8.0)
SUPPORT = 0.02
COARSEST = 8
STAND_OUT = 1.25
CLEAR = 5.0
NEAR_CORE = 0.12
PAINT_REACH = 0.25
STEP_REACH = 0.12
FOOT_REACH = 0.4
FOOT = 0.1
STEP_SHARE = 0.3
STEP_SIGMAS = 7.0
ROUGH_CELL = 0.2
ROUGH_POINTS = 5
MIN_POINTS = 50


@dataclass(frozen=True)
class MarkingPointSettings(StrokeRules):
    """How marking points are told; lengths in m.

    Parameters
    ----------
    step : a point this far above lower ground beside it lies on a kerb or at a wall's foot; or, where heights scatter
        (`roughness`), so far that scatter does not explain it.
    min_length, min_points : smaller pieces are specks.
    join : gaps in a piece of marking, and between its points.
    longest : pieces of this length or more are not judged by their size.
    """

    step: float = 0.03
    min_points: int = 8
    join: float = 0.3
    longest: float = 3.0

    @property
    def reach(self) -> float:
        """How far, m, the answer for a point looks round it."""
        blur = 4 * max(SPACINGS) * CELL
        return self.block_size + 2 * self.max_width + 2 * blur + self.longest + 2 * self.join + 1.0


@dataclass(frozen=True)
class MarkingAnswer:
    """What is found for n points.

    Attributes
    ----------
    paint : (n,) bool.
    weight : (n,) float32, 0 to 1: how far above the middle between ground and paint; 0 off paint.
    contrast : (n,) float32, intensity over that of the ground round the point; for points on paint, else NaN.
    """

    paint: np.ndarray
    weight: np.ndarray
    contrast: np.ndarray


@dataclass(frozen=True)
class Noise:
    """What single points scatter by.

    Parameters
    ----------
    height : standard deviation of heights of neighbouring ground points, m (`roughness`).
    brightness : standard deviation of asphalt's brightness, as a share of it.
    """

    height: float = 0.0
    brightness: float = 0.0


def roughness(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> float:
    """Scatter of the heights of ground points (n,), m: the median of the standard deviations in small cells.

    NaN where the points are too few to tell.
    """
    if len(x) < MIN_POINTS:
        return float("nan")
    column = np.floor(x / ROUGH_CELL).astype(np.int64)
    row = np.floor(y / ROUGH_CELL).astype(np.int64)
    columns = int(np.ptp(column)) + 1
    _cells, cell = np.unique((row - row.min()) * columns + column - column.min(), return_inverse=True)
    count = np.bincount(cell)
    offset = z - (np.bincount(cell, weights=z) / count)[cell]
    spread = np.bincount(cell, weights=offset ** 2)[count >= ROUGH_POINTS]
    if len(spread) < MIN_POINTS:
        return float("nan")
    return float(np.median(np.sqrt(spread / (count[count >= ROUGH_POINTS] - 1))))


def marking_points(x: np.ndarray, y: np.ndarray, z: np.ndarray, brightness: np.ndarray, noise: Noise = Noise(),
                   settings: MarkingPointSettings = MarkingPointSettings()) -> MarkingAnswer:
    """Which ground points lie on paint.

    Parameters
    ----------
    x, y, z : (n,) m.
    brightness : (n,) calibrated intensity in units of asphalt's.
    noise : of the points; where it is large paint must stand out more.
    """
    n = len(x)
    if not n:
        return MarkingAnswer(np.zeros(0, bool), np.zeros(0, np.float32), np.zeros(0, np.float32))
    grid = _grid(x, y)
    row, column, _inside = grid.cells(x, y)
    cell = row * grid.columns + column
    image, share = _image(cell, brightness, grid)
    ground = _ground_level(image, settings)
    share *= np.float32(CLEAR * noise.brightness)
    contrast = np.maximum(share, np.float32(max(settings.contrast, STAND_OUT * noise.brightness)), out=share)
    core = _core(image, ground, contrast, settings)
    if not core.any():
        return MarkingAnswer(np.zeros(n, bool), np.zeros(n, np.float32), np.full(n, np.nan, np.float32))
    near = cv2.dilate(core.astype(np.uint8), _disc(NEAR_CORE)).ravel()[cell] > 0
    some = np.flatnonzero(near)
    bright, paint_level = _above_middle(some, cell, brightness, image, ground, core, grid)
    bright &= ~_on_steps(some, cell, z, bright, grid, max(settings.step, STEP_SIGMAS * noise.height))
    bright &= _large_enough(some, cell, bright, grid, settings)
    return _answer(n, some[bright], brightness, ground.ravel()[cell[some[bright]]], paint_level[bright])


def _grid(x: np.ndarray, y: np.ndarray) -> Grid:
    """Grid round points, its corners on multiples of the coarsest cells."""
    coarse = Grid.covering(x.min() - 0.5, y.min() - 0.5, x.max() + 0.5, y.max() + 0.5, CELL * COARSEST)
    return Grid(coarse.x_min, coarse.y_max, CELL, coarse.rows * COARSEST, coarse.columns * COARSEST)


def _image(cell: np.ndarray, brightness: np.ndarray, grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    """Brightness of the ground on the grid, smoothed over the points' spacing, NaN where there are no points near.

    Also, of the same shape, by what share of a single point's its noise is.
    """
    count, total = _cell_sums(cell, None, grid), _cell_sums(cell, brightness, grid)
    image, number = np.full(grid.shape, np.nan, dtype=np.float32), np.ones(grid.shape, dtype=np.float32)
    empty, open_ = np.ones(grid.shape, dtype=bool), np.empty(grid.shape, dtype=bool)
    weight, value = np.empty_like(count), np.empty_like(count)
    for spacing in SPACINGS:
        _blurred(count, spacing, weight)
        _blurred(total, spacing, value)
        np.greater(weight, SUPPORT, out=open_)
        open_ &= empty
        empty ^= open_
        np.divide(value, weight, out=image, where=open_)
        # Of n evenly spread points a cell, 4 pi sigma^2 n enter a Gaussian mean with full weight.
        weight *= 4 * np.pi * spacing ** 2
        np.maximum(weight, 1.0, out=number, where=open_)
    np.sqrt(number, out=number)
    return image, np.divide(np.float32(1.0), number, out=number)


def _cell_sums(cell: np.ndarray, values: np.ndarray | None, grid: Grid) -> np.ndarray:
    """Sum of values (n,) of the points of each cell, or their number, (rows, columns) float32."""
    return np.bincount(cell, values, grid.rows * grid.columns).astype(np.float32).reshape(grid.shape)


def _few_sums(cell: np.ndarray, values: np.ndarray | None, grid: Grid) -> np.ndarray:
    """The same of points that are few beside the grid's cells."""
    filled, number = np.unique(cell, return_inverse=True)
    sums = np.zeros(grid.rows * grid.columns, np.float32)
    sums[filled] = np.bincount(number, values, len(filled))
    return sums.reshape(grid.shape)


def _blurred(layer: np.ndarray, sigma: float, out: np.ndarray | None = None) -> np.ndarray:
    """Gaussian mean with a standard deviation in cells; wide ones are taken on a grid that is coarser accordingly.

    `out` is where it goes: new memory for each mean costs as much as the mean.
    The caller's grid must lie on multiples of 8 cells, so that the coarse one does not depend on its extent.
    """
    step = int(min(max(2 ** np.floor(np.log2(sigma / 1.5)), 1), COARSEST))
    if step == 1:
        return cv2.GaussianBlur(layer, (0, 0), sigma, dst=out, borderType=cv2.BORDER_CONSTANT)
    rows, columns = layer.shape
    coarse = cv2.resize(layer, (columns // step, rows // step), interpolation=cv2.INTER_AREA)
    coarse = cv2.GaussianBlur(coarse, (0, 0), sigma / step, borderType=cv2.BORDER_CONSTANT)
    return cv2.resize(coarse, (columns, rows), dst=out, interpolation=cv2.INTER_LINEAR)


def _ground_level(image: np.ndarray, settings: MarkingPointSettings) -> np.ndarray:
    """Brightness of the ground without all that is narrower than `max_width`."""
    filled = np.where(np.isnan(image), np.float32(1e6), image)
    kernel = _disc(settings.max_width / 2)
    low = cv2.erode(filled, kernel, borderType=cv2.BORDER_CONSTANT, borderValue=1e6)
    low[low > 1e5] = -1.0
    return cv2.dilate(low, kernel, dst=filled, borderType=cv2.BORDER_CONSTANT, borderValue=-1.0)


def _core(image: np.ndarray, ground: np.ndarray, contrast: np.ndarray, settings: MarkingPointSettings) -> np.ndarray:
    """Cells that are surely paint, bool; `contrast` is used up."""
    sigma = 0.15 * settings.block_size / CELL
    seen = ~np.isnan(image)
    level, weight = _blurred(np.where(seen, image, np.float32(0)), sigma), _blurred(seen.astype(np.float32), sigma)
    level /= np.maximum(weight, 1e-3, out=weight)
    del weight  # the images of a stretch are what takes most memory
    margin = np.multiply(contrast, ground, out=contrast)
    with np.errstate(invalid="ignore"):
        level += margin
        seen &= image > level
        margin += ground
        seen &= image > margin
        # Corners of wide bright surfaces: there the ground beside is as bright.
        beside = cv2.dilate(ground, _disc(PAINT_REACH), dst=level)
        beside *= np.float32(1.0 + 0.5 * settings.contrast)
        seen &= image > beside
    return seen


def _disc(radius: float) -> np.ndarray:
    """Round structuring element of a radius in m."""
    side = 2 * max(round(radius / CELL), 1) + 1
    return cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))


def _above_middle(some: np.ndarray, cell: np.ndarray, brightness: np.ndarray, image: np.ndarray, ground: np.ndarray,
                  core: np.ndarray, grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    """Which of some points are brighter than the middle between ground and the paint near them; that paint's level."""
    highest = cv2.dilate(np.where(core, image, np.float32(0)), _disc(PAINT_REACH)).ravel()
    base = ground.ravel()[cell[some]]
    value = brightness[some]
    bright = value > 0.5 * (highest[cell[some]] + base)
    bright_cell = cell[some[bright]]
    sigma = PAINT_REACH / CELL / 1.5
    count, total = (_blurred(_few_sums(bright_cell, values, grid), sigma).ravel()[cell[some]]
                    for values in (None, value[bright]))
    level = np.where(count > 1e-6, total / np.maximum(count, 1e-6), highest[cell[some]])
    return value > 0.5 * (level + base), level


def _on_steps(some: np.ndarray, cell: np.ndarray, z: np.ndarray, bright: np.ndarray, grid: Grid,
              step: float) -> np.ndarray:
    """Which of some points lie above lower ground beside them, as on a kerb or a wall, or among bright ones that do."""
    height = (z - z.min()).astype(np.float32)
    low = extreme_in_cells(cell, height, grid.rows * grid.columns, highest=False)
    low[np.isinf(low)] = 1e6
    low = low.reshape(grid.shape)
    beside, around = (cv2.erode(low, _disc(reach)).ravel()[cell[some]]
                      for reach in (STEP_REACH, FOOT_REACH))
    above = (height[some] - beside > step) | (height[some] - around > max(step, FOOT))
    counts = [cv2.GaussianBlur(_few_sums(cell[some[part]], None, grid), (0, 0), 1.5).ravel()[cell[some]]
              for part in (bright & above, bright)]
    return above | (counts[0] > STEP_SHARE * counts[1])


def _large_enough(some: np.ndarray, cell: np.ndarray, bright: np.ndarray, grid: Grid,
                  settings: MarkingPointSettings) -> np.ndarray:
    """Which of some points belong to pieces of bright points that are no specks."""
    mask = np.zeros(grid.rows * grid.columns, np.uint8)
    mask[cell[some[bright]]] = 1
    joined = cv2.dilate(mask.reshape(grid.shape), _disc(settings.join / 2))
    count, labels, boxes, _centres = cv2.connectedComponentsWithStats(joined, connectivity=8)
    label = labels.ravel()[cell[some]]
    points = np.bincount(label[bright], minlength=count)
    size = boxes[:, [cv2.CC_STAT_WIDTH, cv2.CC_STAT_HEIGHT]] * CELL - settings.join
    length = np.hypot(*size.T)
    large = ((points >= settings.min_points) & (length >= settings.min_length)) | (length >= settings.longest)
    large[0] = False
    return large[label]


def _answer(n: int, paint: np.ndarray, brightness: np.ndarray, ground: np.ndarray, level: np.ndarray) -> MarkingAnswer:
    mask = np.zeros(n, bool)
    mask[paint] = True
    weight = np.zeros(n, np.float32)
    contrast = np.full(n, np.nan, np.float32)
    middle = 0.5 * (level + ground)
    weight[paint] = np.clip((brightness[paint] - middle) / np.maximum(level - middle, 1e-6), 0.0, 1.0)
    contrast[paint] = brightness[paint] / np.maximum(ground, 1e-6)
    return MarkingAnswer(mask, weight, contrast)
