"""Roof planes of one building as the stage of roof segmentation writes them: a number a point, a row a plane."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ...settings.buildings import PlaneParameters
from .plane_detection import detect_planes, fitted_planes
from .plane_moments import azimuth_degrees, slope_degrees

OK, FEW_POINTS, NO_POINTS, NO_PLANES = "ok", "few points", "no roof points", "no planes"

# A building of whose points a smaller share lies on planes has no planes worth the name.
LEAST_EXPLAINED = 0.35
FEWEST_POINTS = 3
MOST_POINTS = 30_000  # Points of one building that planes are grown on; of more a regular choice is taken.


@dataclass(frozen=True)
class PlaneRow:
    """One roof plane, as `roof_segmentation.RoofTable` has the columns, with its slope and the azimuth it falls to
    (degrees, clockwise from north; NaN where level)."""

    number: int
    height: float
    height_max: float
    points: int
    area: float
    density: float
    rmse: float
    slope: float
    azimuth: float


@dataclass(frozen=True)
class PlaneSegmentation:
    """Plane number (n,) of each point, 0 = none; a row a plane; one of the words above."""

    roof_of_point: np.ndarray
    rows: tuple[PlaneRow, ...]
    status: str


def segment_planes(x: np.ndarray, y: np.ndarray, z: np.ndarray, outline: shapely.Geometry, ground: float,
                   density: float, parameters: PlaneParameters,
                   min_height: float | np.ndarray) -> PlaneSegmentation:
    """Roof planes of one building, numbered from low to high.

    Parameters
    ----------
    x, y, z : (n,) points of the building, m; may hold trees, walls, roof furniture and some ground.
    outline : the primary outline.
    ground : height of the ground, m.
    density : points/m2 of the cloud on roofs.
    min_height : least height of a roof above the ground, m, of all points or (n,) of each.
    """
    roof = np.zeros(len(z), np.int32)
    high = np.flatnonzero(z >= ground + min_height)
    if len(high) < FEWEST_POINTS:
        return PlaneSegmentation(roof, (), NO_POINTS)
    corner = np.floor([x[high].min(), y[high].min(), 0.0])
    points = np.column_stack([x[high], y[high], z[high]]) - corner
    step = -(-len(points) // MOST_POINTS)
    chosen = np.arange(0, len(points), step)
    label = detect_planes(points[chosen], density / step, parameters)
    if (label >= 0).mean() < LEAST_EXPLAINED:
        return PlaneSegmentation(roof, (), NO_PLANES)
    if step > 1:
        label = _spread(points, points[chosen], label, parameters.tolerance)
    shapely.prepare(outline)
    label = _seen_inside(label, shapely.contains_xy(outline, x[high], y[high]))
    if label.max(initial=-1) < 0:
        return PlaneSegmentation(roof, (), NO_PLANES)
    heights = [float(np.median(points[label == number, 2])) for number in range(label.max() + 1)]
    rank = np.argsort(np.argsort(heights, kind="stable"), kind="stable")
    label = np.where(label >= 0, rank[label], -1)
    roof[high] = label + 1
    return PlaneSegmentation(roof, _rows(points, label, density), OK)


def _seen_inside(label: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Labels without the planes that lie outside the outline, which are a neighbour's."""
    count = int(label.max(initial=-1)) + 1
    inner = np.bincount(label[(label >= 0) & inside], minlength=count)
    every = np.maximum(np.bincount(label[label >= 0], minlength=count), 1)
    keep = (inner >= 3) & (inner / every > 0.15)
    number = np.cumsum(keep) - 1
    return np.where((label >= 0) & keep[label], number[label], -1) if count else label


def _spread(points: np.ndarray, chosen: np.ndarray, label: np.ndarray, tolerance: float) -> np.ndarray:
    """Labels for all points from those of the chosen ones: the nearest's, where its plane fits."""
    from scipy.spatial import cKDTree

    nearest = label[cKDTree(chosen).query(points)[1]]
    planes = fitted_planes(chosen, label)[nearest]
    off = np.abs(points[:, 2] - planes[:, 0] * points[:, 0] - planes[:, 1] * points[:, 1] - planes[:, 2])
    return np.where((nearest >= 0) & (off / np.sqrt(1 + planes[:, 0]**2 + planes[:, 1]**2) < tolerance), nearest, -1)


def _rows(points: np.ndarray, label: np.ndarray, density: float) -> tuple[PlaneRow, ...]:
    """The table of the planes."""
    planes = fitted_planes(points, label)
    cell = max(1.0 / density, 0.16) ** 0.5
    rows = []
    for number, plane in enumerate(planes):
        members = points[label == number]
        cells = np.unique(np.floor(members[:, :2] / cell) @ np.array([1.0, 1e6]))
        area = len(cells) * cell**2
        off = members[:, 2] - members[:, :2] @ plane[:2] - plane[2]
        rows.append(PlaneRow(number + 1, float(np.median(members[:, 2])), float(members[:, 2].max()), len(members),
                             area, len(members) / area, float(np.sqrt(np.mean(off**2))), slope_degrees(plane),
                             azimuth_degrees(plane)))
    return tuple(rows)
