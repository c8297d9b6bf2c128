"""Outlines joined wall to wall, placed by least squares between the evidence and one another."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from ...geometry.tolerances import LEAST_DIVISOR
from .displacement_search import OutlineNetwork

PROBE = 0.3  # m, distance at which the evidence is probed around an outline
TIED = 0.25  # m, walls nearer than this are taken as one
STIFFNESS = 30.0  # weight of a metre of joined wall, against 2 of a metre of wall on the evidence's edge
MIN_STIFFNESS = 0.08  # weight of a metre of boundary that keeps an outline where it is
LONGEST_STEP = 0.4  # m

PASSES = 2


def adjust_to_walls(network: OutlineNetwork, shifts: np.ndarray) -> np.ndarray:
    """Shifts (n, 2) with joined walls brought together and whole rows of houses moved to the evidence.

    Newton's steps: the evidence gives each outline a slope and a curvature, each joined wall one
    observation of the difference of two shifts.
    """
    n = len(shifts)
    for _ in range(PASSES):
        slope, curvature = _evidence_gradient(network, shifts)
        i, j, misfit, weight = _wall_ties(network, shifts)
        joint = weight[:, None, None] * np.eye(2)
        index = np.arange(n)
        blocks = np.concatenate((curvature, joint, joint, -joint, -joint))
        row, column = np.concatenate((index, i, j, i, j)), np.concatenate((index, i, j, j, i))
        axis = np.arange(2)
        rows = np.broadcast_to(2 * row[:, None, None] + axis[:, None], blocks.shape)
        columns = np.broadcast_to(2 * column[:, None, None] + axis, blocks.shape)
        normal = coo_matrix((blocks.ravel(), (rows.ravel(), columns.ravel())), (2 * n, 2 * n)).tocsc()
        right = slope.copy()
        np.add.at(right, j, weight[:, None] * misfit)
        np.add.at(right, i, -weight[:, None] * misfit)
        step = spsolve(normal, right.ravel()).reshape(n, 2)
        length = np.hypot(*step.T)
        shifts = shifts + step * np.minimum(1, LONGEST_STEP / np.maximum(length, LEAST_DIVISOR))[:, None]
    return shifts


def _evidence_gradient(network: OutlineNetwork, shifts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Slope (n, 2) and curvature (n, 2, 2, positive definite) of the evidence that each outline covers."""
    offsets = PROBE * np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1)])
    o, e, w, n, s, ne, sw, se, nw = network.cover(shifts[:, None] + offsets).T
    slope = np.column_stack((e - w, n - s)) / (2 * PROBE)
    xx, yy = (e + w - 2 * o) / PROBE**2, (n + s - 2 * o) / PROBE**2
    xy = (ne + sw - se - nw) / (4 * PROBE**2)
    bend = -np.stack((np.stack((xx, xy), -1), np.stack((xy, yy), -1)), -2)
    value, vector = np.linalg.eigh(bend)
    value = np.maximum(value, MIN_STIFFNESS * network.perimeter[:, None])
    return slope, np.einsum("nij,nj,nkj->nik", vector, value, vector)


def _wall_ties(network: OutlineNetwork, shifts: np.ndarray) -> tuple[np.ndarray, ...]:
    """Joined walls: outlines i and j (m,), misfit (m, 2) m of their relative shift, weight (m,)."""
    walls = network.walls
    misfit = walls.meeting - network.relative(shifts)[walls.pair]
    joined = np.hypot(*misfit.T) < TIED
    return *network.pairs[walls.pair[joined]].T, misfit[joined], STIFFNESS * walls.length[joined]


def wall_snap_candidates(network: OutlineNetwork, shifts: np.ndarray, max_shift: float, most: int) -> np.ndarray:
    """Places (n, most, 2) where a wall meets a neighbour's exactly, the nearest first.

    The neighbour stays at its shift; an outline with fewer such places has its own shift repeated.
    """
    i, j = network.pairs[network.walls.pair].T
    outline = np.concatenate((j, i))
    place = np.concatenate((shifts[i] + network.walls.meeting, shifts[j] - network.walls.meeting))
    allowed = np.hypot(*place.T) <= max_shift
    outline, place = outline[allowed], place[allowed]
    order = np.lexsort((place[:, 1], place[:, 0], np.hypot(*(place - shifts[outline]).T), outline))
    outline, place = outline[order], place[order]
    rank = np.arange(len(outline)) - np.searchsorted(outline, outline)
    result = np.repeat(shifts[:, None], most, axis=1)
    use = rank < most
    result[outline[use], rank[use]] = place[use]
    return result
