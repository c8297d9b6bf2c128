"""Planes grown on the points of one building: from the smoothest places outwards while points fit."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ...execution import checkpoint
from .plane_moments import moments_of, plane_distances, solve

RADIUS = 0.8  # Wanted radius of the neighbourhood a normal is fitted to, m.
NEIGHBOURS = (5, 12)  # Fewest and most neighbours of it; the density decides between them.
STEEPEST = math.tan(math.radians(72.5))  # Steeper places are walls.
# Cosine of the largest angle between the normal of a point and its plane.
MAX_ANGLE = math.cos(math.radians(30.0))
PROMISING = 6  # A seed with fewer points on its plane among its neighbours' neighbours is not grown.
ROUNDS = 6
SEED_TRIES = 150


@dataclass(frozen=True)
class Surroundings:
    """Neighbours (n, k) of each point, itself first; slope (n, 2) and roughness (n,), m, of the smoothest
    neighbourhood that holds the point."""

    neighbours: np.ndarray
    slope: np.ndarray
    roughness: np.ndarray


def surroundings(points: np.ndarray, density: float) -> Surroundings:
    """Neighbours and normals of points (n, 3), local coordinates in m, at `density` points/m2."""
    wanted = round(math.pi * RADIUS**2 * density)
    k = min(min(max(wanted, NEIGHBOURS[0]), NEIGHBOURS[1]) + 1, len(points))
    near = cKDTree(points).query(points, k)[1].reshape(len(points), k)
    away = points[near] - points[:, None, :]
    x, y, z = away[..., 0], away[..., 1], away[..., 2]
    sums = [np.full(len(points), float(k)), x.sum(1), y.sum(1), z.sum(1)]
    sums += [np.einsum("nk,nk->n", *pair) for pair in ((x, x), (x, y), (y, y), (x, z), (y, z), (z, z))]
    planes, squares = solve(np.stack(sums, axis=1))
    steep = 1.0 + planes[:, 0]**2 + planes[:, 1]**2
    roughness = np.sqrt(squares / np.maximum(k - 3, 1) / steep)
    # At an edge the own neighbourhood folds over it; one beside it that holds the point does not.
    off = _off_neighbours_planes(planes, near, points)
    best = np.argmin(roughness[near] + off, axis=1)
    chosen = near[np.arange(len(points)), best]
    return Surroundings(near, planes[chosen, :2], roughness[chosen])


def _off_neighbours_planes(planes: np.ndarray, near: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Distance (n, k) of each point from the planes fitted at its neighbours, m."""
    away = points[:, None, :] - points[near]
    plane = planes[near]
    off = away[..., 2] - plane[..., 0] * away[..., 0] - plane[..., 1] * away[..., 1] - plane[..., 2]
    return np.abs(off) / np.sqrt(1.0 + plane[..., 0]**2 + plane[..., 1]**2)


def grow_planes(points: np.ndarray, around: Surroundings, tolerance: float, fewest: int) -> np.ndarray:
    """Plane number (n,) of each point, -1 for none.

    Parameters
    ----------
    points : (n, 3), local coordinates in m.
    tolerance : farthest distance of a point from its plane, m.
    fewest : points of the smallest plane.
    """
    label = np.full(len(points), -1)
    free = np.hypot(*around.slope.T) < STEEPEST
    normals = _normals(around.slope)
    tried = np.zeros(len(points), bool)
    number = failures = 0
    for seed in np.argsort(around.roughness, kind="stable").tolist():
        checkpoint()
        if not free[seed] or tried[seed] or around.roughness[seed] > tolerance:
            continue
        members = _grown(points, around, normals, free, seed, tolerance, fewest)
        if len(members) < fewest:
            tried[members] = tried[seed] = True
            failures += 1
            if failures > SEED_TRIES:
                break
            continue
        label[members] = number
        free[members] = False
        number += 1
    return label


def _grown(points: np.ndarray, around: Surroundings, normals: np.ndarray, free: np.ndarray, seed: int,
           tolerance: float, fewest: int) -> np.ndarray:
    """Points of the plane that grows from one seed; fewer than `fewest` where none does."""
    plane = np.array([*around.slope[seed], 0.0])
    plane[2] = points[seed, 2] - plane[:2] @ points[seed, :2]
    near = np.unique(around.neighbours[around.neighbours[seed]])
    near = near[free[near] & (np.abs(plane_distances(plane, points[near])) < tolerance)]
    if np.count_nonzero(normals[near] @ normals[seed] > MAX_ANGLE) < min(fewest, PROMISING):
        return near[:0]
    members = np.intersect1d(near, around.neighbours[seed])
    for _ in range(ROUNDS):
        if len(members) >= 3:
            plane = solve(moments_of(points[members]))[0]
        fits = free & (np.abs(plane_distances(plane, points)) < tolerance)
        fits &= normals @ _normals(plane[None, :2])[0] > MAX_ANGLE
        if not fits[seed]:
            return members[:0]
        before, members = members, connected(around.neighbours, fits, seed)
        if len(before) == len(members) and (before == members).all():
            break
    return members


def connected(neighbours: np.ndarray, allowed: np.ndarray, seed: int) -> np.ndarray:
    """Numbers of the allowed points that are reached from `seed` over neighbours."""
    reached = np.zeros(len(allowed), bool)
    reached[seed] = True
    front = np.array([seed])
    while len(front):
        beside = neighbours[front].ravel()
        fresh = np.zeros(len(allowed), bool)
        fresh[beside] = True
        fresh &= allowed & ~reached
        reached |= fresh
        front = np.flatnonzero(fresh)
    return np.flatnonzero(reached)


def _normals(slope: np.ndarray) -> np.ndarray:
    """Unit normals (n, 3) of slopes (n, 2)."""
    up = np.column_stack([-slope, np.ones(len(slope))])
    return up / np.linalg.norm(up, axis=1, keepdims=True)
