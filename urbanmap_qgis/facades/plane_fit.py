"""Robust planes through wall points, with the accuracy of their place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class PlaneFitLimits:
    """Limits of plane fit, each with its unit."""

    tukey: float = 4.685
    min_noise: float = 0.003
    enough: int = 20_000  # Points on which a plane is found, evenly taken from all; its figures are those of all.
    # Points within a square of this side (m) share their errors: the accuracy counts squares, not points.
    block: float = 1.0
    pass_gap: float = 20.0  # Seconds without a point between two passes.


LIMITS = PlaneFitLimits()


@dataclass(frozen=True, eq=False)
class WallPlane:
    """An upright or nearly upright plane.

    Attributes
    ----------
    point : (3,) the points' centroid, on the plane.
    normal : (3,) unit.
    rmse : of the points that hold it, m.
    sigma : standard deviation of the plane's place at the centroid, m, from the scatter of square metres (and passes),
        not of points; it does not know the error of the survey's own place.
    points : number of points that hold it.
    passes : drives that saw it.
    pass_spread : standard deviation of the place between passes, m; NaN with one.
    """

    point: np.ndarray
    normal: np.ndarray
    rmse: float
    sigma: float
    points: int
    passes: int
    pass_spread: float

    def distance(self, points: np.ndarray) -> np.ndarray:
        """Signed distances (n,) of points (n, 3), m."""
        return component(points - self.point, self.normal)

    @property
    def axes(self) -> tuple[np.ndarray, np.ndarray]:
        """Unit vectors (3,) in the plane: level (to the right seen from in front) and up."""
        along = np.array([-self.normal[1], self.normal[0], 0.0])
        along /= np.linalg.norm(along)
        return along, np.cross(self.normal, along)

    @property
    def tilt(self) -> float:
        """Lean of the wall in degrees: 0 upright, above 0 where the wall leans back."""
        return float(np.degrees(np.arcsin(np.clip(self.normal[2], -1.0, 1.0))))

    def flipped(self) -> WallPlane:
        """The same plane, seen from the other side."""
        return WallPlane(self.point, -self.normal, self.rmse, self.sigma, self.points, self.passes, self.pass_spread)


def component(vectors: np.ndarray, direction: np.ndarray) -> np.ndarray:
    """Parts (n,) of vectors (n, d) along a direction (d,).

    Summed column by column: products of matrices are summed in another order by every number of threads, and a last
    digit decides which plane a point belongs to.
    """
    total = vectors[:, 0] * direction[0]
    for axis in range(1, len(direction)):
        total = total + vectors[:, axis] * direction[axis]
    return total


def least_squares_plane(points: np.ndarray, weights: np.ndarray, upright: bool) -> tuple[np.ndarray, np.ndarray]:
    """Centroid (3,) and unit normal (3,) of the plane with the least weighted squares; level normal if `upright`."""
    centre = (weights[:, None] * points).sum(axis=0) / weights.sum()
    away = points - centre
    size = 2 if upright else 3
    covariance = np.einsum("n,ni,nj->ij", weights, away[:, :size], away[:, :size])
    normal = np.zeros(3)
    normal[:size] = np.linalg.eigh(covariance)[1][:, 0]
    return centre, normal


def robust_plane(points: np.ndarray, time: np.ndarray, normal: np.ndarray, tilting: bool = True,
                 iterations: int = 7) -> WallPlane | None:
    """Plane through points (n, 3) by iterated weights (Tukey), its normal on the side of `normal`.

    It is upright, unless the points tell a lean of more than a quarter of a degree and three standard deviations.
    None with fewer than 10 points.
    """
    if len(points) < 10:
        return None
    some = points[::max(1, len(points) // LIMITS.enough)]
    plane = _described(points, time, normal, *_solved(some, True, iterations))
    if not tilting or np.ptp(points[:, 2]) < 2.0:
        return plane
    centre, leaning, scale = _solved(some, False, iterations)
    sigma_lean = plane.sigma / max(float(some[:, 2].std()), 0.1)
    lean = abs(float(np.arcsin(leaning[2])))
    if lean <= max(np.radians(0.25), 3 * sigma_lean):
        return plane
    return _described(points, time, normal, centre, leaning, scale)


def _solved(points: np.ndarray, upright: bool, iterations: int) -> tuple[np.ndarray, np.ndarray, float]:
    """Point and normal of the plane by iterated weights, and the noise (m) that they are judged by."""
    middle, scale = 0.0, np.inf
    centre, normal = least_squares_plane(points, np.ones(len(points)), upright)
    for _ in range(iterations):
        residual = component(points - centre, normal)
        inliers = residual[np.abs(residual - middle) < LIMITS.tukey * scale]
        middle = float(np.median(inliers))
        scale = max(1.4826 * float(np.median(np.abs(inliers - middle))), LIMITS.min_noise)
        centre, normal = least_squares_plane(points, _weights(residual, middle, scale), upright)
    return centre, normal, scale


def _described(points: np.ndarray, time: np.ndarray, side: np.ndarray, centre: np.ndarray, normal: np.ndarray,
               scale: float) -> WallPlane:
    """A plane with what is known of it from all points."""
    if normal @ side < 0:
        normal = -normal
    residual = component(points - centre, normal)
    inlier = np.abs(residual) < LIMITS.tukey * scale
    passes = pass_numbers(time[inlier])
    sigma, spread = _sigma(points[inlier], residual[inlier], passes, normal)
    return WallPlane(centre, normal, float(np.sqrt(np.mean(residual[inlier] ** 2))), sigma, int(inlier.sum()),
                     int(passes.max()) + 1, spread)


def _weights(residual: np.ndarray, middle: float, scale: float) -> np.ndarray:
    """Tukey's weights (n,)."""
    relative = np.clip((residual - middle) / (LIMITS.tukey * scale), -1.0, 1.0)
    return (1 - relative**2) ** 2


def pass_numbers(time: np.ndarray) -> np.ndarray:
    """Number of the drive (n,) that each point belongs to: a pause of `LIMITS.pass_gap` seconds parts two."""
    if not np.isfinite(time).all():
        return np.zeros(len(time), np.int64)
    order = np.argsort(time, kind="stable")
    number = np.zeros(len(time), np.int64)
    number[order[1:]] = np.cumsum(np.diff(time[order]) > LIMITS.pass_gap)
    return number


def _sigma(points: np.ndarray, residual: np.ndarray, passes: np.ndarray, normal: np.ndarray) -> tuple[float, float]:
    """Standard deviation of a plane's place, and of its place between passes."""
    level = np.array([-normal[1], normal[0]]) / np.hypot(*normal[:2])
    beside, high = component(points[:, :2], level), points[:, 2]
    block = np.column_stack([np.floor(beside / LIMITS.block), np.floor(high / LIMITS.block), passes])
    block = (block - block.min(axis=0)).astype(np.int64)
    size = block.max(axis=0) + 1
    code = (block[:, 0] * size[1] + block[:, 1]) * size[2] + block[:, 2]
    _, of, count = np.unique(code, return_inverse=True, return_counts=True)
    means = np.bincount(of.ravel(), residual) / count
    full = count >= max(3, 0.1 * np.median(count))
    blocks = int(full.sum())
    scatter = means[full].std() if blocks > 1 else residual.std()
    # A square is worth one observation, however many points it has.
    sigma = max(scatter, residual.std()) / np.sqrt(max(blocks - 2, 1))
    drives = [residual[passes == number].mean() for number in range(int(passes.max()) + 1)]
    if len(drives) < 2:
        return float(sigma), float("nan")
    spread = float(np.std(drives, ddof=1))
    return float(max(sigma, spread / np.sqrt(len(drives)))), spread
