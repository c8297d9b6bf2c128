"""Lines of sight from places to their cameras, followed through what may block them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR

BEFORE_CAMERA = 1.0
"""The last part of a line, m, is not tested."""


def sight_lines(places: np.ndarray, cameras: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit directions (n, 3) and lengths (n,), m, of the lines from places (n, 3) to cameras (n, 3)."""
    vector = cameras - places
    length = np.linalg.norm(vector, axis=1)
    return vector / np.maximum(length, LEAST_DIVISOR)[:, None], length


def blocked_lines(places: np.ndarray, lines: tuple[np.ndarray, np.ndarray], start: np.ndarray, top: float, step: float,
                  blocks: Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]) -> np.ndarray:
    """Mask (n,) of the lines of sight that are blocked somewhere.

    Parameters
    ----------
    places : (n, 3), m.
    lines : as `sight_lines` gives them.
    start : (n,) m from the place from where a line is followed, in steps of `step` m, up to the height `top`, m.
    blocks : of points (k, 3) on the lines with the numbers `left` (k,), `along` (k,) m from their places: which block.
    """
    direction, length = lines
    end = length - BEFORE_CAMERA
    rising = direction[:, 2] > 1e-6
    end[rising] = np.minimum(end[rising], np.maximum(top - places[rising, 2], 0.0) / direction[rising, 2])
    blocked = np.zeros(len(places), bool)
    for number in range(int(np.ceil(max((end - start).max(initial=0.0), 0.0) / step))):
        along = start + number * step
        left = np.flatnonzero(~blocked & (along < end))
        if not len(left):
            break
        blocked[left] = blocks(places[left] + along[left, None] * direction[left], left, along[left])
    return blocked
