"""Boresights and lever arms by least squares: planes that two scanners or two passes saw must coincide.

A point is P = p(t) + R(t) (l + R_bs s). A small rotation d of the scanner about the body's axes and a shift dl of its
lever arm move it by R (dl + d x v), v the vector from the scanner to the point in the body. The trajectory of each pass
is off too: nodes along it move what was measured near them in the map, and rotate it in the body, as a random walk.
Planes give one equation each, along their normal. What the drive does not determine keeps its prior uncertainty and is
called so.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

from ...settings.lines import BoresightSettings
from ...wording import mark
from .plane_patches import PlanePatches, group_pairs

PARAMETERS = (mark("forward"), mark("right"), mark("down"), mark("roll"), mark("pitch"), mark("heading"))
"""Of each scanner: lever arm (m) and rotation (degrees) about the body's axes."""

_SIZE = len(PARAMETERS)

# m, between the centroids of planes that are compared, round after round.
GATES = (1.5, 0.6, 0.3, 0.2, 0.2)
MAX_ANGLE = 12.0  # degrees between their normals
GROSS = 3.0  # standard deviations
REWEIGHTED = 8
FLOOR = 0.004  # m, of a plane's place: roughness that is not noise


@dataclass(frozen=True)
class PatchPoses:
    """How the vehicle stood when planes were measured, in the mean of each plane's points.

    Attributes
    ----------
    scanner : (n,) number.
    node : (n,) number of the pass's node, counted over all passes.
    rotation : (n, 3, 3), R from body to map.
    from_body, from_scanner : (n, 3, 3), R [b]x and R [v]x, m, of the vectors b from the body and v from the scanner to
        the points, in the body's axes.
    """

    scanner: np.ndarray
    node: np.ndarray
    rotation: np.ndarray
    from_body: np.ndarray
    from_scanner: np.ndarray


@dataclass(frozen=True)
class Boresights:
    """What was found.

    Attributes
    ----------
    value, sigma : (scanners, 6) corrections in the order of `PARAMETERS`, m and degrees, and standard deviations.
    determined : (scanners, 6) bool.
    pairs : planes compared.
    rms_before, rms_after : m, of their distances (weighted), before with the trajectories' corrections alone.
    place_rms : m, RMS of the places' corrections about their mean.
    """

    value: np.ndarray
    sigma: np.ndarray
    determined: np.ndarray
    pairs: int
    rms_before: float
    rms_after: float
    place_rms: float


def adjust_boresights(patches: PlanePatches, poses: PatchPoses, node_pass: np.ndarray, scanners: int,
                      settings: BoresightSettings) -> Boresights:
    """Adjust scanners and trajectories to where planes coincide; planes are paired anew in each round.

    Parameters
    ----------
    node_pass : (k,) number of the pass of each node; the nodes of a pass follow each other.
    """
    state = np.zeros(_SIZE * (scanners + len(node_pass)))
    prior = _prior(node_pass, scanners, settings)
    jacobian = _displacements(poses, scanners, len(node_pass))
    for gate in GATES:
        moved = patches.centroid + (jacobian @ state).reshape(-1, 3)
        first, second = _pairs(patches, moved, gate)
        if not len(first):
            break
        normal = _common_normals(patches, first, second)
        distance = np.einsum("ni,ni->n", normal, patches.centroid[first] - patches.centroid[second])
        rows = _along(normal, jacobian, first) - _along(normal, jacobian, second)
        sigma = np.sqrt(patches.sigma[first] ** 2 + patches.sigma[second] ** 2 + FLOOR**2)
        state, covariance, weight = _solved(rows, -distance, sigma, prior, _SIZE * scanners)
        after = rows @ state + distance
    if not len(first):
        nothing = np.zeros((scanners, _SIZE))
        return Boresights(nothing, nothing + np.sqrt(1.0 / _prior_of_scanner(settings)) / _units(), nothing > 0, 0,
                          np.nan, np.nan, np.nan)
    before = rows[:, _SIZE * scanners:] @ state[_SIZE * scanners:] + distance
    value = state[:_SIZE * scanners].reshape(scanners, _SIZE) / _units()
    spread = np.sqrt(np.diag(covariance)).reshape(scanners, _SIZE) / _units()
    place = state[_SIZE * scanners:].reshape(-1, _SIZE)[:, :3]
    extent = float(np.sqrt(np.mean(np.sum((place - place.mean(axis=0)) ** 2, axis=1))))
    limit = np.repeat([settings.determined_arm, settings.determined_angle], 3)
    return Boresights(value, spread, spread <= limit, len(first), _weighted_rms(before, weight),
                      _weighted_rms(after, weight), extent)


def _units() -> np.ndarray:
    """(6,) radians in the degrees of the angles, 1 for the lever arm."""
    return np.array([1.0] * 3 + [np.radians(1.0)] * 3)


def _prior_of_scanner(settings: BoresightSettings) -> np.ndarray:
    """(6,) weights of a scanner's parameters, m and radians."""
    return np.repeat([settings.lever_arm, np.radians(settings.boresight)], 3) ** -2.0


def _prior(node_pass: np.ndarray, scanners: int, settings: BoresightSettings) -> csc_matrix:
    """Normal matrix of what is known before: priors of scanners, and passes whose error is a random walk."""
    angles = np.radians([settings.tilt, settings.tilt, settings.heading])
    start = np.concatenate([np.full(3, settings.place), angles]) ** -2.0
    walk = np.repeat([settings.place_walk, np.radians(settings.attitude_walk)], 3) ** -2.0
    rows, columns, values = [], [], []

    def add(row: np.ndarray, column: np.ndarray, weights: np.ndarray) -> None:
        rows.append(row)
        columns.append(column)
        values.append(weights)

    parameters = np.arange(_SIZE * scanners)
    add(parameters, parameters, np.tile(_prior_of_scanner(settings), scanners))
    for node, number in enumerate(node_pass):
        block = _SIZE * (scanners + node) + np.arange(_SIZE)
        if node == 0 or node_pass[node - 1] != number:
            add(block, block, start)
            continue
        for row, column, sign in ((block, block, 1), (block - _SIZE, block - _SIZE, 1), (block, block - _SIZE, -1),
                                  (block - _SIZE, block, -1)):
            add(row, column, sign * walk)
    size = _SIZE * (scanners + len(node_pass))
    return coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                      shape=(size, size)).tocsc()


def _displacements(poses: PatchPoses, scanners: int, nodes: int) -> csc_matrix:
    """Matrix (3 n, parameters): how the centroids move with each parameter, m and radians."""
    n = len(poses.node)
    from_scanner = np.concatenate([poses.rotation, -poses.from_scanner], axis=2)
    # The place is off in the map, the attitude in the body: a misaligned inertial unit turns with the vehicle.
    from_node = np.concatenate([np.broadcast_to(np.eye(3), (n, 3, 3)), -poses.from_body], axis=2)
    row = np.broadcast_to(3 * np.arange(n)[:, None, None] + np.arange(3)[:, None], (n, 3, _SIZE))
    parts = []
    for number, block in ((poses.scanner, from_scanner), (scanners + poses.node, from_node)):
        column = np.broadcast_to(_SIZE * number[:, None, None] + np.arange(_SIZE), (n, 3, _SIZE))
        parts.append(coo_matrix((block.ravel(), (row.ravel(), column.ravel())),
                                shape=(3 * n, _SIZE * (scanners + nodes))))
    return (parts[0] + parts[1]).tocsr()


def skew(vectors: np.ndarray) -> np.ndarray:
    """(n, 3, 3) matrices that take a vector w to v x w."""
    x, y, z = vectors.T
    zero = np.zeros(len(vectors))
    return np.stack([np.stack([zero, -z, y], -1), np.stack([z, zero, -x], -1), np.stack([-y, x, zero], -1)], -2)


def _pairs(patches: PlanePatches, moved: np.ndarray, gate: float) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of planes of different groups that face alike and lie near each other, each with its nearest."""
    least = np.cos(np.radians(MAX_ANGLE))
    found: list[tuple[np.ndarray, np.ndarray]] = [(np.zeros(0, int), np.zeros(0, int))]
    members = {number: np.flatnonzero(patches.group == number) for number in np.unique(patches.group).tolist()}
    trees = {number: cKDTree(moved[rows]) for number, rows in members.items()}
    for first, second in group_pairs(patches.group):
        distance, nearest = trees[second].query(moved[members[first]], distance_upper_bound=gate)
        near = np.isfinite(distance)
        a, b = members[first][near], members[second][nearest[near]]
        alike = np.abs(np.einsum("ni,ni->n", patches.normal[a], patches.normal[b])) >= least
        found.append((a[alike], b[alike]))
    return tuple(np.concatenate(parts) for parts in zip(*found))


def _common_normals(patches: PlanePatches, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """(m, 3) mean normals of pairs."""
    one, two = patches.normal[first], patches.normal[second]
    total = one + two * np.sign(np.einsum("ni,ni->n", one, two))[:, None]
    return total / np.linalg.norm(total, axis=1, keepdims=True)


def _along(normal: np.ndarray, jacobian: csc_matrix, rows: np.ndarray) -> csc_matrix:
    """(m, parameters): movement of planes along the normals."""
    return sum(coo_matrix((normal[:, axis], (np.arange(len(rows)), np.arange(len(rows))))).tocsr()
               @ jacobian[3 * rows + axis] for axis in range(3))


def _solved(rows: csc_matrix, value: np.ndarray, sigma: np.ndarray, prior: csc_matrix, wanted: int):
    """Robust solution, covariance of the first `wanted` parameters, and weights."""
    weight, noise = np.ones(len(value)), 1.0
    for _ in range(REWEIGHTED):
        scaled = weight / (noise * sigma**2)
        normal = (rows.T @ rows.multiply(scaled[:, None]) + prior).tocsc()
        factors = splu(normal, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        state = factors.solve(rows.T @ (scaled * value))
        misfit = ((value - rows @ state) / sigma) ** 2
        noise = max(1.0, float(np.median(misfit)) / 0.455)  # the median of a chi square of 1
        weight = 1.0 / (1.0 + misfit / (noise * GROSS**2))
    right = np.zeros((normal.shape[0], wanted))
    right[np.arange(wanted), np.arange(wanted)] = 1.0
    return state, factors.solve(right)[:wanted], weight


def _weighted_rms(distance: np.ndarray, weight: np.ndarray) -> float:
    return float(np.sqrt(np.sum(weight * distance**2) / np.sum(weight)))
