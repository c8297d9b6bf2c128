"""Exact intersection of rays with the ground's formula, kerbs included."""

from __future__ import annotations

import numpy as np

from ..scene.ground import Ground

STEP = 0.4
"""Level distance in which a ray is followed while it may meet the ground, m."""

EXACT = 1e-7
"""Accuracy of the intersection, m."""


def ground_distance(ground: Ground, origin: np.ndarray, direction: np.ndarray, max_range: float) -> np.ndarray:
    """Distance (n,) at which rays that start above the ground's relief meet it, infinite where they do not.

    A ray is followed only where it may meet the ground: between the general plane's highest and lowest relief.
    """
    x, y, z = origin.T
    above = z - ground.plane(x, y)
    fall = ground.plane(x + direction[:, 0], y + direction[:, 1]) - ground.plane(x, y) - direction[:, 2]
    low, high = ground.bounds_of_relief()
    result = np.full(len(direction), np.inf)
    down = np.flatnonzero(fall > 1e-9)
    start = np.maximum((above[down] - high) / fall[down], 0.0)
    end = np.minimum((above[down] - low) / fall[down] + EXACT, max_range)
    step = STEP / np.maximum(np.hypot(direction[down, 0], direction[down, 1]), 1e-6)
    near = start < end
    rays, start, end, step = (column[near] for column in (down, start, end, step))
    gap_before = _gap(ground, origin, direction, rays, start)
    while len(rays):
        reach = np.minimum(start + step, end)
        gap = _gap(ground, origin, direction, rays, reach)
        met = gap <= 0
        result[rays[met]] = _refine(ground, origin[rays[met]], direction[rays[met]], start[met], reach[met],
                                    gap_before[met], gap[met])
        on = ~met & (reach < end)
        rays, start, end, step, gap_before = rays[on], reach[on], end[on], step[on], gap[on]
    return result


def ground_normal(ground: Ground, point: np.ndarray) -> np.ndarray:
    """Unit normals (n, 3) of the ground at points (n, 3); the face of a kerb looks sideways."""
    x, y = point[:, 0], point[:, 1]
    reach = 0.002
    height = ground.height(x, y)
    east, north = (ground.height(x + reach, y) - height) / reach, (ground.height(x, y + reach) - height) / reach
    normal = np.column_stack([-east, -north, np.ones(len(x))])
    return normal / np.linalg.norm(normal, axis=1, keepdims=True)


def _gap(ground: Ground, origin, direction, rays, distance) -> np.ndarray:
    """Height of the rays above the ground at the distances."""
    point = origin[rays] + distance[:, None] * direction[rays]
    return point[:, 2] - ground.height(point[:, 0], point[:, 1])


def _refine(ground: Ground, origin, direction, start, end, gap_start, gap_end) -> np.ndarray:
    """Distance between start (above) and end (below) where the gap vanishes or, at a kerb, jumps.

    False position with halving (Illinois), which needs few steps on smooth ground; bisection for what is left.
    """
    result = end.copy()
    open_, turn, halvings = np.arange(len(start)), np.zeros(len(start), np.int8), 0
    while len(open_):
        if halvings < 10:
            share = gap_start / np.maximum(gap_start - gap_end, 1e-300)
            middle = start + (end - start) * np.clip(share, 0.0, 1.0)
        else:
            middle = (start + end) / 2
        gap = _gap(ground, origin, direction, open_, middle)
        over = gap > 0
        gap_end = np.where(over, np.where(turn == 1, gap_end / 2, gap_end), gap)
        gap_start = np.where(over, gap, np.where(turn == -1, gap_start / 2, gap_start))
        start, end = np.where(over, middle, start), np.where(over, end, middle)
        turn = np.where(over, 1, -1).astype(np.int8)
        result[open_] = middle
        on = (np.abs(gap) > EXACT * 0.1) & (end - start > EXACT)
        open_, start, end, gap_start, gap_end, turn = (
            column[on] for column in (open_, start, end, gap_start, gap_end, turn))
        halvings += 1
    return result
