"""Robust planes through wall points, with the accuracy of their place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..geometry.tolerances import SIGMA_OF_MAD
from .normals import numbered_cells

TUKEY = 4.685
MIN_NOISE = 0.003
ITERATIONS = 7
ENOUGH = 20_000  # Points on which a plane is found, evenly taken from all; its figures are those of all.
# Points within a square of this side (m) share their errors: the accuracy counts squares, not points.
BLOCK = 1.0
PASS_GAP = 20.0  # Seconds without a point between two passes.

_PAIRS = {size: [(i, j) for i in range(size) for j in range(i, size)] for size in (2, 3)}
"""Which two coordinates of two or three are multiplied, in order."""


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
    middle, products = _products(np.ascontiguousarray(points.T), upright)
    return _plane_of_products(middle, products, weights, upright)


def _products(columns: np.ndarray, upright: bool) -> tuple[np.ndarray, np.ndarray]:
    """Middle (3,) of points (3, n); their coordinates from it and the products of these, (6 or 9, n)."""
    middle = columns.mean(axis=1)  # so that squares stay small
    away = columns - middle[:, None]
    size = 2 if upright else 3
    return middle, np.concatenate([away] + [away[i:i + 1] * away[i:size] for i in range(size)])


def _plane_of_products(middle: np.ndarray, products: np.ndarray, weights: np.ndarray,
                       upright: bool) -> tuple[np.ndarray, np.ndarray]:
    """The plane from `_products`, which stay the same for all weights; no BLAS: see `component`."""
    sums = np.einsum("kn,n->k", products, weights) / weights.sum()
    size = 2 if upright else 3
    covariance = np.empty((size, size))
    for (i, j), total in zip(_PAIRS[size], sums[3:]):
        covariance[i, j] = covariance[j, i] = total - sums[i] * sums[j]
    normal = np.zeros(3)
    normal[:size] = np.linalg.eigh(covariance)[1][:, 0]
    return middle + sums[:3], normal


def robust_plane(points: np.ndarray, time: np.ndarray, normal: np.ndarray) -> WallPlane | None:
    """Plane through points (n, 3) by iterated weights (Tukey), its normal on the side of `normal`.

    It is upright, unless the points tell a lean of more than a quarter of a degree and three standard deviations.
    None with fewer than 10 points.
    """
    if len(points) < 10:
        return None
    columns = np.ascontiguousarray(points.T)
    some = np.ascontiguousarray(columns[:, ::max(1, len(points) // ENOUGH)])
    plane = _described(columns, time, normal, *_solved(some, True))
    if np.ptp(columns[2]) < 2.0:
        return plane
    centre, leaning, scale = _solved(some, False)
    sigma_lean = plane.sigma / max(float(some[2].std()), 0.1)
    lean = abs(float(np.arcsin(leaning[2])))
    if lean <= max(np.radians(0.25), 3 * sigma_lean):
        return plane
    return _described(columns, time, normal, centre, leaning, scale)


def _residual(columns: np.ndarray, centre: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Signed distances (n,) of points (3, n) from a plane, m: as `component` sums them."""
    total = (columns[0] - centre[0]) * normal[0]
    for axis in (1, 2) if normal[2] else (1,):
        total += (columns[axis] - centre[axis]) * normal[axis]
    return total


def _solved(columns: np.ndarray, upright: bool) -> tuple[np.ndarray, np.ndarray, float]:
    """Point and normal of the plane by iterated weights, and the noise (m) that they are judged by."""
    middle, scale = 0.0, np.inf
    origin, products = _products(columns, upright)
    centre, normal = _plane_of_products(origin, products, np.ones(columns.shape[1]), upright)
    for _ in range(ITERATIONS):
        residual = _residual(products, centre - origin, normal)
        inliers = residual[np.abs(residual - middle) < TUKEY * scale]
        middle = float(np.median(inliers))
        scale = max(SIGMA_OF_MAD * float(np.median(np.abs(inliers - middle))), MIN_NOISE)
        centre, normal = _plane_of_products(origin, products, _weights(residual, middle, scale), upright)
    return centre, normal, scale


def _described(columns: np.ndarray, time: np.ndarray, side: np.ndarray, centre: np.ndarray, normal: np.ndarray,
               scale: float) -> WallPlane:
    """A plane with what is known of it from all points (3, n)."""
    if normal @ side < 0:
        normal = -normal
    residual = _residual(columns, centre, normal)
    inlier = np.flatnonzero(np.abs(residual) < TUKEY * scale)
    passes = pass_numbers(time[inlier])
    residual = residual[inlier]
    sigma, spread = _sigma(columns[:, inlier], residual, passes, normal)
    return WallPlane(centre, normal, float(np.sqrt(np.mean(residual ** 2))), sigma, len(inlier),
                     int(passes.max()) + 1, spread)


def _weights(residual: np.ndarray, middle: float, scale: float) -> np.ndarray:
    """Tukey's weights (n,)."""
    weights = residual - middle
    weights /= TUKEY * scale
    weights *= weights
    np.minimum(weights, 1.0, out=weights)
    np.subtract(1.0, weights, out=weights)
    weights *= weights
    return weights


def pass_numbers(time: np.ndarray) -> np.ndarray:
    """Number of the drive (n,) that each point belongs to: a pause of `PASS_GAP` seconds parts two."""
    if not np.isfinite(time).all():
        return np.zeros(len(time), np.int64)
    order = np.argsort(time, kind="stable")
    number = np.zeros(len(time), np.int64)
    number[order[1:]] = np.cumsum(np.diff(time[order]) > PASS_GAP)
    return number


def _sigma(columns: np.ndarray, residual: np.ndarray, passes: np.ndarray, normal: np.ndarray) -> tuple[float, float]:
    """Standard deviation of a plane's place, and of its place between passes."""
    level = np.array([-normal[1], normal[0]]) / np.hypot(*normal[:2])
    beside = columns[0] * level[0] + columns[1] * level[1]
    code = np.zeros(len(residual), np.int64)
    for place in (np.floor(beside / BLOCK), np.floor(columns[2] / BLOCK), passes):
        place = (place - place.min()).astype(np.int64)
        code = code * (int(place.max()) + 1) + place
    _, of, count = numbered_cells(code)
    means = np.bincount(of, residual) / count
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
