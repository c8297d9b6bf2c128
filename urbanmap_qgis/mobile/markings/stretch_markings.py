"""Ground and paint among the points of one stretch of the path, with those beside it in view."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...settings.terrain import ClothSettings
from ...terrain.cloth import classify_ground
from .marking_points import MarkingAnswer, MarkingPointSettings, Noise, marking_points, roughness
from .plain_threshold import PlainThreshold, plain_marking_points


def ground_of_stretch(piece: tuple[np.ndarray, np.ndarray], settings: ClothSettings,
                       by_class: bool) -> tuple[np.ndarray, float]:
    """Which of a stretch's own points are ground, (own,) bool, and how much their heights scatter, m."""
    records, in_stretch = piece
    x, y, z = (np.ascontiguousarray(records[name]) for name in "xyz")
    ground = records["ground"] if by_class else classify_ground(x, y, z, settings)
    mine = ground & in_stretch
    return ground[in_stretch], roughness(x[mine], y[mine], z[mine])


def markings_of_stretch(piece: tuple[np.ndarray, ...], noise: Noise,
                         settings: MarkingPointSettings) -> tuple[np.ndarray, ...]:
    """Rows among a stretch's own points that are paint, with weight, contrast and brightness."""
    return _answer_of_own(piece, settings.reach, lambda x, y, z, brightness: marking_points(
        x, y, z, brightness, noise, settings))


def plain_markings_of_stretch(piece: tuple[np.ndarray, ...], white: float,
                               settings: PlainThreshold) -> tuple[np.ndarray, ...]:
    """The same by the paper's threshold."""
    return _answer_of_own(piece, settings.reach, lambda x, y, _z, brightness: plain_marking_points(
        x, y, brightness, white, settings))


def _answer_of_own(piece: tuple[np.ndarray, ...], reach: float,
                   find: Callable[..., MarkingAnswer]) -> tuple[np.ndarray, ...]:
    """What `find` answers for a stretch's own points, from the points within `reach` m of them."""
    x, y, z, brightness, in_stretch = piece
    if not in_stretch.any():
        return np.empty(0, int), *(np.empty(0, np.float32) for _ in range(3))
    box = x[in_stretch].min(), x[in_stretch].max(), y[in_stretch].min(), y[in_stretch].max()
    near = ((x >= box[0] - reach) & (x <= box[1] + reach) & (y >= box[2] - reach) & (y <= box[3] + reach))
    answer = find(x[near], y[near], z[near], brightness[near])
    mine = in_stretch[near]
    rows = np.flatnonzero(answer.paint[mine])
    return rows, answer.weight[mine][rows], answer.contrast[mine][rows], brightness[in_stretch][rows]
