"""Matching points to normal distributions: Gaussian plus uniform mixture, exact derivatives, Newton's method.

J eq. 8 to 12 and chapter 4 eq. 4 to 7 after Magnusson (2009), in 2D (x, y, heading) and 3D (six parameters).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ....geometry.tolerances import LEAST_SQUARE
from .ndt_map import NdtMap


@dataclass(frozen=True)
class Mixture:
    """Gaussian and uniform distribution together, approximated by a Gaussian: value = height exp(-sharpness q / 2).

    J eq. 10 and 11: `height` is -d1 and `sharpness` d2 of Magnusson 2009, eq. 6.8 and after.
    """

    height: float
    sharpness: float

    @classmethod
    def of(cls, outlier_share: float, cell: float, dimensions: int) -> Mixture:
        """For an expected share of outliers and cells of a side, m."""
        inlier, outlier = 10.0 * (1.0 - outlier_share), outlier_share / cell ** dimensions
        d3 = -math.log(outlier)
        d1 = -math.log(inlier + outlier) - d3
        d2 = -2.0 * math.log((-math.log(inlier * math.exp(-0.5) + outlier) - d3) / d1)
        return cls(-d1, d2)


@dataclass(frozen=True)
class PointTerms:
    """What each point adds to the score when it is moved.

    Attributes
    ----------
    value : (m,).
    gradient : (m, d) by the point's coordinates, 1/m.
    hessian : (m, d, d), 1/m2.
    """

    value: np.ndarray
    gradient: np.ndarray
    hessian: np.ndarray


def ndt_terms(ndt: NdtMap, points: np.ndarray, mixture: Mixture, cells: str = "neighbours", bound: bool = False
              ) -> PointTerms:
    """Score of points (m, d) in the map with its exact first and second derivatives (J eq. 11).

    `cells` : "closest" as in eq. 11; "own" or "neighbours", summed over these cells.

    With `bound` the second derivatives are those of the parabola that touches the score from below: never curved
    upwards, so that a step to its top never makes the score worse.
    """
    d = ndt.dimensions
    local = points - ndt.origin
    value, gradient = np.zeros(len(points)), np.zeros((d, len(points)))
    pairs = [(a, b) for a in range(d) for b in range(a, d)]
    hessian = {pair: np.zeros(len(points)) for pair in pairs}
    if not len(ndt):
        return _terms(value, gradient, hessian)
    d2 = mixture.sharpness
    for rows, number in ndt.distributions(local, cells):
        off = [local[rows, a] - ndt.mean[number, a] for a in range(d)]
        inverse = {pair: ndt.inverse[number, pair[0], pair[1]] for pair in pairs}
        weighted = [sum(inverse[min(a, b), max(a, b)] * off[b] for b in range(d)) for a in range(d)]
        distance = sum(off[a] * weighted[a] for a in range(d))
        weight = mixture.height * np.exp(-0.5 * d2 * distance)
        value[rows] += weight
        weight *= d2
        for a in range(d):
            gradient[a, rows] -= weight * weighted[a]
        for a, b in pairs:
            hessian[a, b][rows] += weight * ((0.0 if bound else d2 * weighted[a] * weighted[b]) - inverse[a, b])
    return _terms(value, gradient, hessian)


def _terms(value: np.ndarray, gradient: np.ndarray, hessian: dict) -> PointTerms:
    d = len(gradient)
    full = np.empty((len(value), d, d))
    for (a, b), values in hessian.items():
        full[:, a, b] = full[:, b, a] = values
    return PointTerms(value, gradient.T, full)


@dataclass(frozen=True)
class Derivatives:
    """Score of a set of points as a function of its movement.

    Attributes
    ----------
    value : the score.
    gradient : (p,).
    hessian : (p, p). p = 3 (x, y, turn about up) or 6 (x, y, z, turns about the three axes of the map), m and radians,
        about a centre.
    """

    value: float
    gradient: np.ndarray
    hessian: np.ndarray


def rigid_derivatives(points: np.ndarray, centre: np.ndarray, terms: PointTerms) -> Derivatives:
    """Exact derivatives by a rigid motion to centre + translation + exp(rotation) (point - centre), at zero."""
    r = points - centre
    g, h = terms.gradient, terms.hessian
    if points.shape[1] == 2:
        rotation = np.stack([-r[:, 1], r[:, 0]], axis=1)
        rotated_hessian = np.einsum("nij,nj->ni", h, rotation)
        gradient = np.concatenate([g.sum(axis=0), [np.einsum("ni,ni->", g, rotation)]])
        hessian = np.zeros((3, 3))
        hessian[:2, :2] = h.sum(axis=0)
        hessian[:2, 2] = hessian[2, :2] = rotated_hessian.sum(axis=0)
        hessian[2, 2] = np.einsum("ni,ni->", rotated_hessian, rotation) - np.einsum("ni,ni->", g, r)
        return Derivatives(float(terms.value.sum()), gradient, hessian)
    rotation = cross_matrices(r)
    rotated_hessian = np.einsum("nij,njk->nik", h, rotation)
    gradient = np.concatenate([g.sum(axis=0), np.einsum("ni,nij->j", g, rotation)])
    hessian = np.zeros((6, 6))
    hessian[:3, :3] = h.sum(axis=0)
    hessian[:3, 3:] = rotated_hessian.sum(axis=0)
    hessian[3:, :3] = hessian[:3, 3:].T
    outer = np.einsum("na,nb->ab", g, r)
    hessian[3:, 3:] = (np.einsum("nji,njk->ik", rotation, rotated_hessian) + (outer + outer.T) / 2
                       - np.trace(outer) * np.eye(3))
    return Derivatives(float(terms.value.sum()), gradient, hessian)


def cross_matrices(r: np.ndarray) -> np.ndarray:
    """(m, 3, 3) by which a small rotation (3,) moves points at r (m, 3): rotation x r."""
    zero = np.zeros(len(r))
    x, y, z = r.T
    return np.stack([np.stack([zero, z, -y], axis=1), np.stack([-z, zero, x], axis=1),
                     np.stack([y, -x, zero], axis=1)], axis=1)


def rotation_matrix(rotation: np.ndarray) -> np.ndarray:
    """(..., 3, 3) rotation by a vector (..., 3), radians (Rodrigues)."""
    rotation = np.asarray(rotation, dtype=np.float64)
    angle = np.linalg.norm(rotation, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(rotation, -1, 0)
    zero = np.zeros_like(x)
    cross = np.stack([np.stack([zero, -z, y], -1), np.stack([z, zero, -x], -1), np.stack([-y, x, zero], -1)], -2)
    return np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * (cross @ cross)


@dataclass(frozen=True)
class RigidMotion:
    """A rigid movement of points about a centre: centre + translation + rotation (p - centre).

    Attributes
    ----------
    centre : (d,) m.
    translation : (d,) m.
    rotation : (d, d) rotation.
    """

    centre: np.ndarray
    translation: np.ndarray
    rotation: np.ndarray

    @classmethod
    def identity(cls, centre: np.ndarray, translation: np.ndarray | None = None) -> RigidMotion:
        """No rotation; by default no translation either."""
        centre = np.asarray(centre, dtype=np.float64)
        zero = np.zeros(len(centre))
        return cls(centre, zero if translation is None else np.asarray(translation, float), np.eye(len(centre)))

    def transform(self, points: np.ndarray) -> np.ndarray:
        """Points (m, d) after the movement."""
        return (points - self.centre) @ self.rotation.T + (self.centre + self.translation)

    def after(self, step: np.ndarray) -> RigidMotion:
        """This movement, then a small one (3 or 6 parameters) about the moved centre."""
        d = len(self.centre)
        rotation = rotation_matrix(np.array([0.0, 0.0, step[2]]))[:2, :2] if d == 2 else rotation_matrix(step[3:])
        return RigidMotion(self.centre, self.translation + step[:d], rotation @ self.rotation)


@dataclass(frozen=True)
class Match:
    """Where Newton's method converged.

    Attributes
    ----------
    pose : the movement.
    derivatives : at it.
    steps : taken.
    converged : whether it did.
    """

    pose: RigidMotion
    derivatives: Derivatives
    steps: int
    converged: bool


_TOLERANCE = np.array([5e-4, 5e-4, 5e-4, 2e-5, 2e-5, 2e-5])  # m and radians
_STEP_LIMIT = 0.5  # of a cell


def match_points(points: np.ndarray, start: RigidMotion, ndt: NdtMap, mixture: Mixture, iterations: int = 30,
                 cells: str = "neighbours") -> Match:
    """Move points (m, d) so that their score in the map is largest: Newton's method with line search (J eq. 12)."""
    pose = start
    count = 3 if ndt.dimensions == 2 else 6
    tolerance = _TOLERANCE[[0, 1, 3]] if count == 3 else _TOLERANCE
    extent = max(float(np.sqrt(((points - start.centre) ** 2).sum(axis=1).mean())), 1.0) if len(points) else 1.0

    def derivatives_at(pose: RigidMotion) -> Derivatives:
        moved = pose.transform(points)
        return rigid_derivatives(moved, pose.centre + pose.translation, ndt_terms(ndt, moved, mixture, cells))

    now = derivatives_at(pose)
    for done in range(iterations):
        step = newton_step(now.gradient, now.hessian, extent)
        largest = np.abs(step[:-1] if count == 3 else step[:3]).max()
        step *= min(1.0, _STEP_LIMIT * ndt.cell / max(largest, LEAST_SQUARE))
        for _ in range(6):
            trial = pose.after(step)
            candidate = derivatives_at(trial)
            if candidate.value >= now.value:
                break
            step = step / 2
        else:
            return Match(pose, now, done, bool((np.abs(step) < 64 * tolerance).all()))
        pose, now = trial, candidate
        if (np.abs(step) < tolerance).all():
            return Match(pose, now, done + 1, True)
    return Match(pose, now, iterations, False)


def newton_step(gradient: np.ndarray, hessian: np.ndarray, extent: float = 1.0) -> np.ndarray:
    """Newton's step towards a maximum; where the score is not curved downwards, absolute curvatures are taken.

    `extent` : m, size of the point set, which makes rotations and translations comparable.
    """
    d = 2 if len(gradient) == 3 else 3
    scale = np.concatenate([np.ones(d), np.full(len(gradient) - d, 1.0 / extent)])
    values, vectors = np.linalg.eigh(-(hessian * scale * scale[:, None]))
    least = 1e-4 * max(np.abs(values).max(), LEAST_SQUARE)
    inverse = 1.0 / np.maximum(np.abs(values), least)
    return scale * (vectors @ (inverse * (vectors.T @ (scale * gradient))))
