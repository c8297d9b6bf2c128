"""Surface and ground rasters of points in memory, and the choice of ground points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..errors import InputError, InsufficientDataError
from ..geometry.grid import Grid
from ..geometry.sampling import sample
from ..progress import SILENT, Progress
from ..settings.terrain import ClothSettings
from ..wording import say
from .cloth import JAVANMARDI, classify_ground
from .delaunay import highest_in_cells, triangulate
from .outliers import plausible
from .rasterise import rasterise

__all__ = ["ground_mask", "ground_raster", "ground_source", "sample", "thin_highest", "thin_mean"]

GROUND_CLASSES = (2, 8, 10, 11)
"""LAS classes that are ground: ground, key points of it, rail beds, roads. Water (9) is left out: it lies below
the quays and would pull the ground under waterside buildings down."""

NOISE_CLASSES = (7, 18)
UNDECIDED = (0, 1)
BUILDING = 6
ENOUGH = 0.01
FRAME_STEPS = 16


@dataclass(frozen=True)
class GroundSource:
    """Where ground points come from: `classes` (LAS classes) or `cloth` (the cloth filter), and why."""

    method: str
    reason: str


def ground_source(class_counts: np.ndarray, wanted: str = "automatic") -> GroundSource:
    """Choose how ground points are told.

    Parameters
    ----------
    class_counts : (256,) number of points of each LAS class, noise left out.
    wanted : "automatic", "classes" or "cloth". Automatic takes the classes where at least 1 % of the points
        are of a ground class, otherwise the cloth if at least 1 % are undecided (classes 0 and 1).

    Raises
    ------
    InsufficientDataError : there are no ground points to be had: for example only points of buildings.
    """
    total = int(class_counts.sum())
    if not total:
        raise InsufficientDataError(say("The cloud holds no usable points: all are noise or have no valid height."))
    ground = int(class_counts[list(GROUND_CLASSES)].sum())
    undecided = int(class_counts[list(UNDECIDED)].sum())
    if wanted not in ("automatic", "classes", "cloth"):
        raise InputError(say("The ground source must be automatic, classes or cloth, not {wanted}.", wanted=wanted))
    if wanted == "classes" and not ground:
        raise InsufficientDataError(say("The cloud has no ground points (class 2): choose the cloth filter instead."))
    if wanted == "classes" or (wanted == "automatic" and ground >= ENOUGH * total):
        return GroundSource("classes", say("{ground:,} of {total:,} points have a ground class", ground=ground,
                                           total=total))
    if undecided + ground < ENOUGH * total:
        raise InsufficientDataError(say("The cloud has no ground points, only points classified as something else "
                                        "(such as buildings): give the whole cloud with its ground."))
    return GroundSource("cloth", say("{undecided:,} of {total:,} points are unclassified", undecided=undecided,
                                     total=total))


def ground_mask(x: np.ndarray, y: np.ndarray, z: np.ndarray, classification: np.ndarray | None,
                settings: ClothSettings = JAVANMARDI, wanted: str = "automatic",
                progress: Progress = SILENT) -> np.ndarray:
    """Which points are ground, (n,) bool: by class where the cloud has ground classes, else by the cloth.

    Parameters
    ----------
    x, y, z : (n,) metres.
    classification : (n,) LAS classes, or None for an unclassified cloud.

    Raises
    ------
    InsufficientDataError : no ground points can be had (see `ground_source`).
    """
    if classification is None:
        classification = np.ones(len(z), dtype=np.uint8)
    usable = plausible(x, y, z) & ~np.isin(classification, NOISE_CLASSES)
    counts = np.bincount(classification[usable], minlength=256)
    mask = np.zeros(len(z), dtype=bool)
    if ground_source(counts, wanted).method == "classes":
        mask = usable & np.isin(classification, GROUND_CLASSES)
    else:
        mask[usable] = classify_ground(x[usable], y[usable], z[usable], settings, progress)
        mask &= classification != BUILDING
    if not mask.any():
        raise InsufficientDataError(say("No ground points were found: check that the cloud shows the ground."))
    return mask


def ground_raster(x: np.ndarray, y: np.ndarray, z: np.ndarray, classification: np.ndarray | None, grid: Grid,
                  progress: Progress = SILENT) -> np.ndarray:
    """Ground heights without gaps, (rows, columns) float32.

    Parameters
    ----------
    x, y, z : (n,) metres.
    classification : (n,) LAS classes, or None for an unclassified cloud.
    grid : the raster's place.

    Returns
    -------
    The Delaunay surface of the ground points (their mean in each cell), which also spans buildings; beyond the
    outermost ground points the nearest of them continues outwards.

    Raises
    ------
    InsufficientDataError : no ground points can be had.
    """
    ground = ground_mask(x, y, z, classification, progress=progress)
    px, py, pz = thin_mean(x[ground], y[ground], z[ground], grid.cell)
    px, py, pz, triangles = with_frame(px, py, pz, grid.bounds)
    raster = np.full(grid.shape, np.nan, dtype=np.float32)
    rasterise(px, py, pz, triangles, grid, raster)
    return raster


def shorter(x: np.ndarray, y: np.ndarray, triangles: np.ndarray, max_edge: float) -> np.ndarray:
    """Triangles (m, 3) whose sides are all at most `max_edge` metres long in plan; all of them if it is 0."""
    if not max_edge > 0:
        return triangles
    following = triangles[:, [1, 2, 0]]
    length = np.hypot(x[triangles] - x[following], y[triangles] - y[following])
    return triangles[length.max(axis=1) <= max_edge]


def plan_cells(x: np.ndarray, y: np.ndarray, cell: float) -> tuple[np.ndarray, int, int, int]:
    """Number of the cell (on multiples of `cell`) of each point, and first column, first row and columns."""
    column, row = np.floor(x / cell).astype(np.int64), np.floor(y / cell).astype(np.int64)
    first_column, first_row = (int(column.min()), int(row.min())) if len(x) else (0, 0)
    columns = int(column.max()) - first_column + 1 if len(x) else 0
    return (row - first_row) * columns + (column - first_column), first_column, first_row, columns


def thin_highest(x: np.ndarray, y: np.ndarray, z: np.ndarray, cell: float) -> np.ndarray:
    """Indices of the highest point of each cell of the plan, ordered by cell (rows from the south)."""
    number, *_ = plan_cells(x, y, cell)
    if not len(number):
        return np.empty(0, dtype=np.int64)
    return highest_in_cells(number, z, int(number.max()) + 1, tie=(x, y))


def thin_mean(x: np.ndarray, y: np.ndarray, z: np.ndarray,
              cell: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Centres of gravity x, y, z of the points of each cell of the plan, ordered by cell."""
    if not len(z):
        return x, y, z
    number, *_ = plan_cells(x, y, cell)
    count = np.bincount(number)
    filled = count > 0
    # Taken about a near origin: sums of large coordinates would lose digits.
    origin = np.floor(x.min()), np.floor(y.min())
    sums = [np.bincount(number, weights=values)[filled] / count[filled]
            for values in (x - origin[0], y - origin[1], z)]
    return sums[0] + origin[0], sums[1] + origin[1], sums[2]


def frame_points(x: np.ndarray, y: np.ndarray, z: np.ndarray,
                 bounds: tuple[float, float, float, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points on a rectangle round all points, each at the height of the nearest point."""
    x_min, y_min, x_max, y_max = bounds
    margin = 0.05 * max(x_max - x_min, y_max - y_min) + 1.0
    west, east = min(x_min, x.min()) - margin, max(x_max, x.max()) + margin
    south, north = min(y_min, y.min()) - margin, max(y_max, y.max()) + margin
    along = np.linspace(0.0, 1.0, FRAME_STEPS, endpoint=False)
    fx = np.concatenate((west + along * (east - west), np.full(FRAME_STEPS, east),
                         east - along * (east - west), np.full(FRAME_STEPS, west)))
    fy = np.concatenate((np.full(FRAME_STEPS, south), south + along * (north - south),
                         np.full(FRAME_STEPS, north), north - along * (north - south)))
    _distance, nearest = cKDTree(np.column_stack((x, y))).query(np.column_stack((fx, fy)))
    return fx, fy, z[nearest]


def with_frame(x: np.ndarray, y: np.ndarray, z: np.ndarray, bounds: tuple[float, float, float, float]
               ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Points and triangles of a surface that covers the whole rectangle `bounds`."""
    fx, fy, fz = frame_points(x, y, z, bounds)
    x, y, z = (np.concatenate(pair) for pair in ((x, fx), (y, fy), (z, fz)))
    return x, y, z, triangulate(x, y)
