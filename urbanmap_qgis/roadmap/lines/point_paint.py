"""Paint as mobile scanners saw it: marking points as polygons, alone or joined with those of images."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import shapely
from rasterio.features import shapes
from rasterio.transform import Affine

from ...errors import InputError
from ...io.points.pointcloud import open_cloud, read_all
from ...progress import SILENT, Progress
from ...wording import say

CELL = 0.05
"""Of the raster of the points, m."""

TILE = 1000
"""Cells a side of the tiles that are rastered one by one."""


@dataclass(frozen=True)
class PointPaintLimits:
    """Limits of point paint, each with its unit."""

    # Cells: gaps between points are closed up to twice that, as between the scans of a drive. Lines that have no
    # 0.3 m between them may become one.
    closed: int = 2
    least_area: float = 0.02  # Smaller pieces are scatter, m2.
    # The border is drawn on cells so much finer, blurred by so many of them.
    finer: int = 2
    blur: float = 1.2
    # Points are no marking points where more than the second of what they cover lies farther than the first (m)
    # inside.
    surface: float = 0.6
    most_surface: float = 0.3
    apart: float = 50.0  # Points of the markings' own place lie nearer to their box, m.
    stairs: float = 0.025  # The border follows the cells' edges to within so much, m.


LIMITS = PointPaintLimits()

BORDER = 0.1
"""Paint of points so near to that of images is the same, m."""


def point_polygons(places: np.ndarray) -> list[shapely.Polygon]:
    """Outlines of the paint that marking points lie on.

    Parameters
    ----------
    places : (n, 2) in a projected CRS, m.

    Returns
    -------
    Polygons without overlaps; gaps between points up to 0.2 m are closed, pieces below 0.02 m2 left out.

    Raises
    ------
    InputError : the points cover whole surfaces.
    """
    if not len(places):
        return []
    cells = np.unique(np.floor(np.asarray(places, float) / CELL).astype(np.int64), axis=0)
    tiles = np.unique(cells // TILE, axis=0)
    margin = 2 * LIMITS.closed + 1
    pieces = []
    for tile in tiles:
        low = tile * TILE - margin
        in_tile = cells[((cells >= low) & (cells < low + TILE + 2 * margin)).all(axis=1)] - low
        pieces += _tile_pieces(in_tile, low, margin)
    joined = shapely.get_parts(shapely.union_all(pieces))  # in whole cells: tiles meet without a slit
    joined = shapely.transform(joined, lambda cell: cell * (CELL / LIMITS.finer))
    smooth = shapely.simplify(joined[shapely.area(joined) >= LIMITS.least_area], LIMITS.stairs)
    # Of the smooth outlines: the stairs of the cells take ten times as long.
    inside = shapely.area(shapely.buffer(smooth, -LIMITS.surface, quad_segs=2)).sum()
    if inside > LIMITS.most_surface * shapely.area(joined).sum():
        raise InputError(say("The points cover whole surfaces, not paint: give marking points, as road markings from "
                             "mobile surveys make them, not the survey itself."))
    return [shape for shape in smooth if shape.geom_type == "Polygon" and shape.is_valid and not shape.is_empty]


def drive_points(paths: Sequence[Path], progress: Progress = SILENT) -> list[np.ndarray]:
    """Marking points (n, 2) of each file: each is a drive of its own, or part of one."""
    drives = []
    for number, path in enumerate(paths):
        part = progress.part(number / len(paths), (number + 1) / len(paths))
        read = read_all(open_cloud([path]), ("x", "y"), part)
        drives.append(np.column_stack([read["x"], read["y"]]))
    return drives


def check_same_place(polygons: Sequence[shapely.Polygon], drives: Sequence[np.ndarray]) -> None:
    """Refuse marking points (n, 2) that lie nowhere near the polygons of the markings: one of both is of another place.

    Raises
    ------
    InputError : no point lies within the box of all polygons, widened by `LIMITS.apart`.
    """
    if not len(polygons) or not any(len(points) for points in drives):
        return
    low_x, low_y, high_x, high_y = shapely.total_bounds(np.asarray(polygons, object))
    low, high = np.array([low_x, low_y]) - LIMITS.apart, np.array([high_x, high_y]) + LIMITS.apart
    if not any(((points >= low) & (points <= high)).all(axis=1).any() for points in drives):
        raise InputError(say("No marking point lies near the road markings: check that both are of the same place and "
                             "that their coordinate reference systems are right."))


def drive_polygons(drives: Sequence[np.ndarray]) -> list[shapely.Polygon]:
    """`point_polygons` of the points (n, 2) of all drives together."""
    return point_polygons(np.concatenate([np.zeros((0, 2)), *drives]))


def _tile_pieces(cells: np.ndarray, low: np.ndarray, margin: int) -> list[shapely.Polygon]:
    """Closed cells (column, row) of one tile, counted from `low`, as polygons in units of the finer cells."""
    painted = np.zeros((TILE + 2 * margin, TILE + 2 * margin), np.uint8)
    painted[cells[:, 1], cells[:, 0]] = 1
    disk = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * LIMITS.closed + 1, 2 * LIMITS.closed + 1))
    closed = cv2.morphologyEx(painted, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))  # the disk dents thin paint
    closed = cv2.morphologyEx(closed, cv2.MORPH_CLOSE, disk)
    fine = cv2.GaussianBlur(closed.repeat(LIMITS.finer, axis=0).repeat(LIMITS.finer, axis=1) * np.float32(1), (0, 0),
                            LIMITS.blur)
    inner = slice(margin * LIMITS.finer, -margin * LIMITS.finer)
    closed = (fine[inner, inner] > 0.5).astype(np.uint8)
    place = Affine(1.0, 0.0, (low[0] + margin) * LIMITS.finer, 0.0, 1.0, (low[1] + margin) * LIMITS.finer)
    return [shapely.geometry.shape(outline) for outline, _ in shapes(closed, closed.astype(bool), 4, place)]


def hidden_paint(polygons: Sequence[shapely.Polygon], added: Sequence[shapely.Polygon]) -> list[shapely.Polygon]:
    """Parts of the polygons of points (`added`) that those of images do not show: no paint is there twice.

    What lies within 0.1 m of the images' paint is its border, seen at another place by a few centimetres.
    """
    if not len(added) or not len(polygons):
        return list(added)
    bodies = np.asarray(added, object)
    around = shapely.buffer(np.asarray(polygons, object), BORDER, quad_segs=2)
    which, over = shapely.STRtree(around).query(bodies, predicate="intersects")
    left = bodies.copy()
    for k in np.unique(which):
        left[k] = bodies[k].difference(shapely.union_all(around[over[which == k]]))
    parts = shapely.get_parts(left)
    return [part for part in parts if part.geom_type == "Polygon" and part.area >= LIMITS.least_area]
