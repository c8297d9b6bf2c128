"""Wall points of a building cut into planes (J 5.7).

Planes grow from seeds: a voxel on a flat upright surface, then all that is connected on its plane within a growing
circle, fitted anew each time. Seeds that agree with an edge of the outline come first, but nothing binds them to it:
bays, setbacks and walls that the outline does not have grow from the seeds that are left.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from scipy import ndimage

from ..geometry.tolerances import LEAST_DIVISOR, LEAST_SQUARE, SIGMA_OF_MAD
from ..io.points.point_buckets import stable_order
from ..progress import SILENT, Progress
from ..settings.facades import WallSettings
from .normals import NormalVoxels, voxel_normals
from .plane_fit import WallPlane, component, least_squares_plane, robust_plane
from .statistical_outliers import statistical_outliers

_SEED_COSINE = np.cos(np.radians(25.0))
_EDGE_COSINE = np.cos(np.radians(12.0))
_GROWTH = (1.2, 2.5, 5.0, 10.0, 20.0, np.inf)

POINT_TOLERANCE = 0.12
SLICE = 20_000
SEEDS = 3000
# Beside a large wall the normals of a narrow one are bent; with the points of the large one gone they are
# not.
PASSES = 2

DEFAULTS = WallSettings()


@dataclass(frozen=True, eq=False)
class Segment:
    """Points of one wall: their plane, its normal outwards, and their numbers (k,)."""

    plane: WallPlane
    points: np.ndarray


def wall_segments(points: np.ndarray, time: np.ndarray, edges: np.ndarray, outward: np.ndarray,
                  settings: WallSettings = DEFAULTS, progress: Progress = SILENT) -> list[Segment]:
    """Planes of a building's walls, the largest first.

    Parameters
    ----------
    points : (n, 3) near the building, m.
    time : (n,) GPS seconds.
    edges : (k, 2, 2) outline edges, m.
    outward : (k, 2) unit normals.
    """
    segments: list[Segment] = []
    left = np.arange(len(points))
    for _ in range(PASSES):
        found, taken = _one_pass(points[left], time[left], edges, outward, settings, progress)
        segments += [Segment(segment.plane, left[segment.points]) for segment in found]
        if not found:
            break
        left = left[~taken]
    return sorted(segments, key=lambda segment: -len(segment.points))


def _one_pass(points: np.ndarray, time: np.ndarray, edges: np.ndarray, outward: np.ndarray, settings: WallSettings,
              progress: Progress) -> tuple[list[Segment], np.ndarray]:
    """Walls among points, and which points lie on one (n,) bool."""
    nothing = [], np.zeros(len(points), bool)
    if len(points) < 10:
        return nothing
    voxels = voxel_normals(points)
    wall = np.flatnonzero(voxels.upright)
    if len(wall) < 3:
        return nothing
    wall = wall[~statistical_outliers(voxels.mean[wall])]
    grown = _grow_all(voxels, wall, edges, outward, settings, progress)
    if not grown:
        return nothing
    owner = _claim(points, voxels, grown, settings)
    segments = []
    for number, (_centre, normal, _mask) in enumerate(grown):
        members = np.flatnonzero(owner == number)
        plane = robust_plane(points[members], time[members], normal)
        if plane is None:
            continue
        near = members[np.abs(plane.distance(points[members])) < max(4 * plane.rmse, 0.03)]
        segments.append(Segment(plane, near))
    return segments, owner >= 0


@dataclass(eq=False)
class _Mask:
    """Cells of a plane that a wall covers: axes, lower corner, size of a cell and which are filled."""

    axes: tuple[np.ndarray, np.ndarray]
    low: np.ndarray
    cell: float
    filled: np.ndarray

    def holds(self, points: np.ndarray) -> np.ndarray:
        """Whether points (n, 3) lie over filled cells."""
        place = np.floor((np.column_stack([component(points, axis) for axis in self.axes]) - self.low) / self.cell)
        inside = ((place >= 0) & (place < self.filled.shape)).all(axis=1)
        covered = np.zeros(len(points), bool)
        row, column = place[inside].astype(np.int64).T
        covered[inside] = self.filled[row, column]
        return covered


def _grow_all(voxels: NormalVoxels, wall: np.ndarray, edges: np.ndarray, outward: np.ndarray, settings: WallSettings,
              progress: Progress) -> list[tuple[np.ndarray, np.ndarray, _Mask]]:
    """Planes (point, normal, mask) grown from seeds until no seed is left."""
    mean, normal, weight = voxels.mean[wall], voxels.normal[wall], voxels.count[wall].astype(float)
    free = np.ones(len(wall), bool)
    tried = np.zeros(len(wall), bool)
    guided = _agrees(mean, normal, edges, outward)
    # The flattest first: half a centimetre is a class, within which more points win.
    order = np.lexsort((-voxels.support[wall], np.round(voxels.thickness[wall] / 0.005), ~guided))
    grown = []
    tries = 0
    for seed in order:
        if not free[seed] or tried[seed]:
            continue
        tries += 1
        if tries > SEEDS:
            break
        progress.check()
        found = _grow(seed, mean, normal, weight, free, settings, voxels.size)
        tried[seed] = True
        if found is None:
            continue
        centre, facing, members, mask = found
        if _area(mask) < settings.min_area:
            tried[members] = True
            continue
        free[members] = False
        # What lies on the plane with another normal (edges, reveals) starts no wall of its own.
        close = free & (np.abs(component(mean - centre, facing)) < settings.tolerance)
        close[close] = mask.holds(mean[close])
        tried[close] = True
        grown.append((centre, _outwards(centre, facing, mean[members], edges, outward), mask))
    return grown


def _agrees(mean: np.ndarray, normal: np.ndarray, edges: np.ndarray, outward: np.ndarray) -> np.ndarray:
    """Whether the nearest outline edge of voxels faces as they do, (v,) bool."""
    if not len(edges):
        return np.zeros(len(mean), bool)
    level = normal[:, :2] / np.maximum(np.hypot(*normal[:, :2].T), LEAST_DIVISOR)[:, None]
    agrees = np.zeros(len(mean), bool)
    for start in range(0, len(mean), SLICE):
        part = slice(start, start + SLICE)
        near = edge_distance(mean[part, :2], edges).argmin(axis=1)
        agrees[part] = np.abs((level[part] * outward[near]).sum(axis=1)) > _EDGE_COSINE
    return agrees


def edge_distance(xy: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Distances (n, k) of places (n, 2) to edges (k, 2, 2), m."""
    start, run = edges[:, 0], edges[:, 1] - edges[:, 0]
    away = xy[:, None, :] - start
    share = np.clip((away * run).sum(axis=2) / np.maximum((run**2).sum(axis=1), LEAST_SQUARE), 0.0, 1.0)
    return np.linalg.norm(away - share[..., None] * run, axis=2)


def _grow(seed: int, mean: np.ndarray, normal: np.ndarray, weight: np.ndarray, free: np.ndarray,
          settings: WallSettings, voxel: float):
    """The plane that grows from a seed: point, normal, its voxels, its mask; None where it dies."""
    centre, facing = mean[seed], normal[seed]
    members = np.array([seed])
    candidates = np.flatnonzero(free)
    place, facings = mean[candidates], normal[candidates]
    away = np.linalg.norm(place - mean[seed], axis=1)
    for radius in (*_GROWTH, np.inf):
        level = np.flatnonzero(np.abs(component(place - centre, facing)) < settings.tolerance)
        level = level[np.abs(component(facings[level], facing)) > _SEED_COSINE]
        near = away[level] < radius
        if np.count_nonzero(near) < 3:
            return None
        mask, found = _connected(seed, candidates[level[near]], mean, facing, settings.max_gap, voxel)
        if len(found) < 3:
            return None
        if near.all() and np.array_equal(found, members):
            break  # no further circle holds more
        members = found
        centre, facing = _fit(mean[members], weight[members])
    return centre, facing, members, mask


def _fit(places: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Plane of voxels: two iterations, the second without those far off."""
    upright = np.ptp(places[:, 2]) < 3.0
    centre, normal = least_squares_plane(places, weight, upright)
    residual = np.abs(component(places - centre, normal))
    inlier = residual <= max(3 * SIGMA_OF_MAD * np.median(residual), 0.01)
    return least_squares_plane(places[inlier], weight[inlier], upright)


def _connected(seed: int, near: np.ndarray, mean: np.ndarray, facing: np.ndarray, gap: float,
               voxel: float) -> tuple[_Mask, np.ndarray]:
    """Those of `near` that are connected with the seed in the plane over gaps up to `gap`, and their cells."""
    level = np.array([-facing[1], facing[0], 0.0])
    level /= np.linalg.norm(level)
    axes = level, np.cross(facing, level)
    flat = np.column_stack([component(mean[near], axis) for axis in axes])
    cell = 1.5 * voxel
    pad = int(np.ceil(gap / cell)) + 1
    low = flat.min(axis=0) - pad * cell
    place = np.floor((flat - low) / cell).astype(np.int64)
    filled = np.zeros(tuple(place.max(axis=0) + pad + 1), bool)
    filled[place[:, 0], place[:, 1]] = True
    closed = filled
    if gap > 0:
        closed = cv2.dilate(filled.view(np.uint8), _disc(gap / 2 + cell / 2, cell), borderValue=0)
    _, label = cv2.connectedComponents(closed.view(np.uint8), connectivity=8)
    labels = label[place[:, 0], place[:, 1]]
    start = labels[np.searchsorted(near, seed)] if seed in near else labels[0]
    chosen = labels == start
    mask = np.zeros_like(filled)
    mask[place[chosen, 0], place[chosen, 1]] = True
    return _Mask(axes, low, cell, mask), near[chosen]


@lru_cache(maxsize=64)
def _disc(radius: float, cell: float) -> np.ndarray:
    """Cells of a side `cell`, m, whose middles lie within a radius, m, of that of the one in the middle; uint8."""
    reach = int(radius / cell) + 1
    row, column = np.ogrid[-reach:reach + 1, -reach:reach + 1]
    return (np.sqrt(row * row + column * column) * cell <= radius).astype(np.uint8)


def _area(mask: _Mask) -> float:
    """Area of a mask's filled cells, m2."""
    return float(mask.filled.sum()) * mask.cell**2


def _outwards(centre: np.ndarray, facing: np.ndarray, places: np.ndarray, edges: np.ndarray,
              outward: np.ndarray) -> np.ndarray:
    """The plane's normal, on the side of most of the outline edges near the wall face."""
    if not len(edges):
        return facing
    some = places[:: max(1, len(places) // 200), :2]
    near = edge_distance(some, edges)
    agreement = (outward @ facing[:2])[near.argmin(axis=1)]
    # Edges across the wall say nothing: only those that run with it count.
    agreement = agreement[np.abs(agreement) > 0.7]
    if not len(agreement):
        best = np.argmin(near.mean(axis=0) - np.abs(outward @ facing[:2]) * 2.0)
        agreement = outward[best] @ facing[:2]
    return facing if np.sum(np.sign(agreement)) >= 0 else -facing


def _claim(points: np.ndarray, voxels: NormalVoxels, grown: list, settings: WallSettings) -> np.ndarray:
    """Number of the plane that each point lies on, (n,), -1 for none: the nearest of those that cover its place."""
    owner = np.full(len(points), -1, np.int32)
    best = np.full(len(points), POINT_TOLERANCE)
    order = stable_order(voxels.of_point)
    starts = np.cumsum(voxels.count) - voxels.count
    for number, (centre, normal, mask) in enumerate(grown):
        distance = POINT_TOLERANCE + voxels.size
        near = np.flatnonzero(np.abs(component(voxels.mean - centre, normal)) < distance)
        grownmask = _Mask(mask.axes, mask.low, mask.cell, ndimage.binary_dilation(mask.filled, np.ones((3, 3))))
        near = near[grownmask.holds(voxels.mean[near])]
        if not len(near):
            continue
        count = voxels.count[near]
        members = order[np.repeat(starts[near] - np.cumsum(count) + count, count) + np.arange(count.sum())]
        distance = np.abs(component(points[members] - centre, normal))
        closer = distance < best[members]
        members, distance = members[closer], distance[closer]
        owner[members], best[members] = number, distance
    return owner
