"""The offset between two maps, robust against what changed."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ...geometry.tolerances import LEAST_DIVISOR, SIGMA_OF_MAD
from .comparison_records import MapOffset
from .cross_sections import LineMatches, LineSamples
from .difference_noise import BOTH, EFFICIENCY, FLOOR, limit_of, robust_scale

BLOCK = 20.0
"""Differences along a line are taken together over this length, m."""

FARTHEST, GRID, NEAR = 2.0, 0.5, 0.35
"""Offsets tried first: up to this, in steps of this; a place fits within about this, m."""

PLACES = 2000
"""Of so many places of the old map."""

ROUNDS = 30
TUKEY = 4.685
"""Differences of more robust sigmas than this count nothing (Tukey's biweight)."""

SHOWN = 0.02
"""A direction is shown by differences whose mean square part in it is at least this."""


def coarse_offset(old: np.ndarray, new: np.ndarray) -> np.ndarray:
    """Offset (2,) on a coarse grid at which most places (n, 2) of the old map lie on places of the new one, m.

    No offset where none fits clearly better: lanes repeat each other.
    """
    places = old[np.linspace(0, len(old) - 1, min(len(old), PLACES)).astype(int)]
    tree = cKDTree(new)
    steps = np.arange(-FARTHEST, FARTHEST + GRID / 2, GRID)
    tried = np.array([(0.0, 0.0)] + [(x, y) for x in steps for y in steps if np.hypot(x, y) <= FARTHEST])
    fits = np.array([np.exp(-0.5 * (tree.query(places + one, distance_upper_bound=4 * NEAR)[0] / NEAR) ** 2).mean()
                     for one in tried])
    best = int(np.argmax(fits))
    return tried[best] if fits[best] > 1.1 * fits[0] else tried[0]


def line_blocks(samples: LineSamples, matches: LineMatches) -> tuple[np.ndarray, ...]:
    """Differences taken together along lines.

    Returns
    -------
    Index of the sample in the middle, median of across (m), mean normal (n, 2), and the pair of lines, of each block.
    """
    at = np.flatnonzero(matches.other >= 0)
    keys = np.column_stack([samples.line[at], matches.other[at], (samples.along[at] / BLOCK).astype(int)])
    _, block = np.unique(keys, axis=0, return_inverse=True)
    block = block.reshape(-1)
    order = np.argsort(block, kind="stable")
    parts = np.split(at[order], np.flatnonzero(np.diff(block[order])) + 1) if len(at) else []
    middle = np.array([part[len(part) // 2] for part in parts], int)
    across = np.array([np.median(matches.across[part]) for part in parts])
    normals = np.array([samples.normals[part].mean(axis=0) for part in parts]).reshape(-1, 2)
    pairs = np.column_stack([samples.line[middle], matches.other[middle]])
    return middle, across, normals, pairs


def robust_offset(normals: np.ndarray, across: np.ndarray, share: np.ndarray, independent: float) -> MapOffset:
    """Offset that differences (n,) along unit vectors (n, 2) have in common, m.

    Parameters
    ----------
    share : (n,) what each counts: those of one line together 1, for they may err together.
    independent : how many of the differences are taken as independent where their spread is found.
    """
    if not len(across):
        return MapOffset()
    values, axes = np.linalg.eigh(normals.T @ normals / len(normals))
    axes = axes[:, values >= SHOWN]
    rows, weights, offset = normals @ axes, share, np.zeros(axes.shape[1])
    for _ in range(ROUNDS):
        weighted = rows * weights[:, None]
        inverse = np.linalg.inv(weighted.T @ rows + LEAST_DIVISOR * np.eye(axes.shape[1]))
        offset = inverse @ (weighted.T @ across)
        rest = np.abs(across - rows @ offset)
        scale = max(SIGMA_OF_MAD * float(np.median(rest)), FLOOR)
        weights = share * np.maximum(1.0 - (rest / (TUKEY * scale)) ** 2, 0.0) ** 2
    spread = max(robust_scale(across - rows @ offset), FLOOR)
    covariance = inverse * spread ** 2
    limit = limit_of(EFFICIENCY * (independent - len(offset))) * (BOTH if len(offset) > 1 else 1.0)
    significant = bool(offset @ np.linalg.solve(covariance, offset) > limit ** 2)
    whole = axes @ covariance @ axes.T
    shown = (axes ** 2).sum(axis=1) >= 0.5
    sigma = np.where(shown, np.sqrt(np.diag(whole)), np.nan)
    east, north = axes @ offset
    return MapOffset(float(east), float(north), float(sigma[0]), float(sigma[1]), significant)
