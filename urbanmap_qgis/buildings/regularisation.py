"""Main directions of a building, and outlines made parallel and square to them where the data say so."""

from __future__ import annotations

import numpy as np

DIRECTION_WIDTH = 4.0
"""Degrees; edges within this of a main direction support it."""
SECOND_DIRECTION_SHARE = 0.25
"""Share of the edges' length that a further main direction needs."""


def main_directions(edges: np.ndarray) -> np.ndarray:
    """Main directions of edges in degrees from the x axis, 0 to 90, the strongest first.

    A direction stands for itself and its perpendicular. Length decides; a second and third direction are
    given where at least `SECOND_DIRECTION_SHARE` of the length follows them and not the ones before.

    Parameters
    ----------
    edges : (n, 2) edge vectors in metres.
    """
    length = np.hypot(edges[:, 0], edges[:, 1])
    angle = np.degrees(np.arctan2(edges[:, 1], edges[:, 0])) % 90.0
    total = length.sum()
    free = length > 0
    found: list[float] = []
    while len(found) < 3 and free.any():
        apart = (angle[:, None] - angle[None, free] + 45.0) % 90.0 - 45.0
        support = np.where(np.abs(apart) < DIRECTION_WIDTH, length[free], 0.0).sum(axis=1) * free
        best = int(np.argmax(support))
        if found and support[best] < SECOND_DIRECTION_SHARE * total:
            break
        difference = (angle - angle[best] + 45.0) % 90.0 - 45.0
        near = free & (np.abs(difference) < DIRECTION_WIDTH)
        mean = angle[best] + np.average(difference[near], weights=length[near])
        # the squared lengths let the long walls, which are drawn best, decide the last tenth of a degree
        mean = angle[best] + np.average(difference[near], weights=length[near] ** 2) if near.any() else mean
        found.append(float(mean % 90.0))
        free &= np.abs((angle - mean + 45.0) % 90.0 - 45.0) >= DIRECTION_WIDTH
    return np.array(found)
