"""Where the survey lies within a few metres: correlation of markings, and the best path through all of the survey.

For each block of driven path the score of every shift is found by correlation with the reference. Since the error of
a trajectory drifts slowly, the shifts of blocks that follow each other are nearly the same: the best sequence of
shifts is found by dynamic programming, forwards and backwards, which also tells by how much it beats the best sequence
that takes another place at a block. That is what tells a slip by one dash from the truth.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from .reference import Coverage

CELL = 0.2
"""m, step of the shifts."""

OBSERVATION_AREA = 0.15
"""m2 of paint (1 m of a lane line) that count as one independent observation."""

_BLUR = 0.2
_SIGMAS = 3.0


@dataclass(frozen=True)
class ScoreImage:
    """What a point scores where it falls on the reference.

    Attributes
    ----------
    left, top : whole numbers of cells (of `CELL`) from the CRS's origin, east and south, of the first column and row.
    score : (rows, columns) float32.
    """

    left: int
    top: int
    score: np.ndarray


def score_image(coverage: Coverage, background: float) -> ScoreImage:
    """log(1 + coverage / background) on cells of 0.2 m, blurred so that neighbouring shifts see each other's peaks."""
    grid = coverage.grid
    smooth = cv2.GaussianBlur(coverage.share, (0, 0), _BLUR / grid.cell, borderType=cv2.BORDER_CONSTANT)
    x_min, y_min, x_max, y_max = grid.bounds
    left, right = math.floor(x_min / CELL), math.ceil(x_max / CELL)
    top, bottom = math.floor(-y_max / CELL), math.ceil(-y_min / CELL)
    step = CELL / grid.cell
    shift_x = ((left + 0.5) * CELL - grid.x_min) / grid.cell - 0.5
    shift_y = ((top + 0.5) * CELL + grid.y_max) / grid.cell - 0.5
    share = cv2.warpAffine(smooth, np.array([[step, 0, shift_x], [0, step, shift_y]]), (right - left, bottom - top),
                           flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP, borderMode=cv2.BORDER_CONSTANT)
    return ScoreImage(left, top, np.log1p(np.maximum(share, 0) / background).astype(np.float32))


def shift_scores(x: np.ndarray, y: np.ndarray, weight: np.ndarray, image: ScoreImage, max_shift: int) -> np.ndarray:
    """Score of all shifts of a point set, (2 max_shift + 1, 2 max_shift + 1) float32: rows north, columns east.

    Parameters
    ----------
    x, y : (m,) m.
    weight : (m,) evidence of each point.
    max_shift : largest shift, cells.
    """
    column = np.floor(x / CELL).astype(np.int64) - image.left
    row = np.floor(-y / CELL).astype(np.int64) - image.top
    size = 2 * max_shift + 1
    rows, columns = image.score.shape
    inside = (column >= -max_shift) & (column < columns + max_shift) & (row >= -max_shift) & (row < rows + max_shift)
    if not inside.any():
        return np.zeros((size, size), dtype=np.float32)
    column, row, weight = column[inside], row[inside], weight[inside]
    left, top = column.min(), row.min()
    width, height = column.max() - left + 1, row.max() - top + 1
    template = np.bincount((row - top) * width + column - left, weight, width * height).astype(np.float32)
    if template.size > 20 * len(column):  # sparse: sum over its filled cells
        return _sparse_scores(template, width, left, top, image, max_shift)[::-1]
    part = _part(image.score, top - max_shift, left - max_shift, height + 2 * max_shift, width + 2 * max_shift)
    return cv2.matchTemplate(part, template.reshape(height, width), cv2.TM_CCORR)[::-1]


def _part(score: np.ndarray, top: int, left: int, rows: int, columns: int) -> np.ndarray:
    """A window of an image, 0 beyond its edges."""
    part = np.zeros((rows, columns), dtype=np.float32)
    y0, y1 = max(top, 0), min(top + rows, score.shape[0])
    x0, x1 = max(left, 0), min(left + columns, score.shape[1])
    if y0 < y1 and x0 < x1:
        part[y0 - top:y1 - top, x0 - left:x1 - left] = score[y0:y1, x0:x1]
    return part


def _sparse_scores(template: np.ndarray, width: int, left: int, top: int, image: ScoreImage,
                   max_shift: int) -> np.ndarray:
    filled = np.flatnonzero(template)
    size = 2 * max_shift + 1
    part = _part(image.score, top - max_shift, left - max_shift, len(template) // width + 2 * max_shift,
                 width + 2 * max_shift)
    views = np.lib.stride_tricks.sliding_window_view(part, (size, size))
    return np.einsum("n,nij->ij", template[filled], views[filled // width, filled % width]).astype(np.float32)


@dataclass(frozen=True)
class BestPath:
    """The best sequence of shifts.

    Attributes
    ----------
    shift : (b, 2) whole steps of `CELL`, east and north.
    deficit : (b, s, s) float32: by how much each shift at each block (rows north, columns east) makes the whole
        sequence worse; 0 at the best.
    """

    shift: np.ndarray
    deficit: np.ndarray


def best_path(scores: np.ndarray, step_variance: np.ndarray, prior_sigma: float) -> BestPath:
    """Best sequence of shifts through blocks (b, s, s) of scores.

    Parameters
    ----------
    step_variance : (b - 1,) m2, variance of the error's change from each block to the next.
    prior_sigma : m, standard deviation of the whole error, which decides between places that fit alike.
    """
    count, size = len(scores), scores.shape[1]
    offset = (np.arange(size) - size // 2) * CELL
    total = np.empty_like(scores)
    ahead = -(offset[:, None] ** 2 + offset ** 2).astype(np.float32) / (2 * prior_sigma ** 2)
    for block in range(count):
        total[block] = ahead
        if block < count - 1:
            ahead = _propagated(ahead + scores[block], step_variance[block])
            ahead -= ahead.max()
    back = np.zeros((size, size), dtype=np.float32)
    for block in reversed(range(count)):
        total[block] += scores[block] + back
        if block:
            back = _propagated(back + scores[block], step_variance[block - 1])
            back -= back.max()
    best = total.reshape(count, -1).argmax(axis=1)
    deficit = total.reshape(count, -1).max(axis=1)[:, None, None] - total
    return BestPath(np.stack([best % size, best // size], axis=1) - size // 2, deficit)


def alternative_spread(path: BestPath, separation: float) -> np.ndarray:
    """(b, 2, 2) m2: how far the best path may be off because others over `separation` m away fit nearly as well."""
    offset = np.arange(path.deficit.shape[1]) - path.deficit.shape[1] // 2
    spread = np.zeros((len(path.deficit), 2, 2))
    for block, (east, north) in enumerate(path.shift):
        probability = np.exp(-path.deficit[block].astype(np.float64))
        probability /= probability.sum()
        to_east, to_north = np.meshgrid((offset - east) * CELL, (offset - north) * CELL)
        probability[np.maximum(np.abs(to_east), np.abs(to_north)) < separation] = 0.0  # that is the place itself
        cross = (probability * to_east * to_north).sum()
        spread[block] = [[(probability * to_east ** 2).sum(), cross], [cross, (probability * to_north ** 2).sum()]]
    return spread


def _propagated(score: np.ndarray, variance: float) -> np.ndarray:
    """Best score that can be reached at each shift from the others, a change d costing d2 / (2 variance)."""
    furthest = int(np.clip(math.ceil(_SIGMAS * math.sqrt(variance) / CELL), 1, len(score) - 1))
    cost = CELL ** 2 / (2 * max(variance, 1e-6)) * np.arange(furthest + 1, dtype=np.float32) ** 2
    for axis in (0, 1):
        score = np.moveaxis(score, axis, 0)
        spread = score.copy()
        for step in range(1, furthest + 1):
            np.maximum(spread[step:], score[:-step] - cost[step], out=spread[step:])
            np.maximum(spread[:-step], score[step:] - cost[step], out=spread[:-step])
        score = np.moveaxis(spread, 0, axis)
    return score


def centred(scores: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Scores (b, s, s) about each block's own shift (b, 2), 0 beyond what was searched."""
    size = scores.shape[1]
    result = np.zeros_like(scores)
    for number, (east, north) in enumerate(shift):
        y0, y1, x0, x1 = max(north, 0), size + min(north, 0), max(east, 0), size + min(east, 0)
        result[number, y0 - north:y1 - north, x0 - east:x1 - east] = scores[number, y0:y1, x0:x1]
    return result


def peaks(surface: np.ndarray, separation: int, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Highest local maxima of a surface (s, s): offsets (k, 2) from its middle (east, north, cells) and heights (k,).

    Maxima less than `separation` cells from the middle or from a higher one are left out.
    """
    size = surface.shape[0]
    middle = size // 2
    largest = cv2.dilate(surface, np.ones((3, 3), np.uint8))
    row, column = np.nonzero((surface >= largest) & (surface > 0))
    height = surface[row, column]
    order = np.argsort(-height, kind="stable")
    chosen: list[tuple[int, int]] = []
    heights = []
    for k in order:
        offset = (int(column[k]) - middle, int(row[k]) - middle)
        if all(max(abs(offset[0] - a), abs(offset[1] - b)) >= separation for a, b in [(0, 0), *chosen]):
            chosen.append(offset)
            heights.append(float(height[k]))
            if len(chosen) == most:
                break
    return np.array(chosen, dtype=np.int64).reshape(-1, 2), np.array(heights)
