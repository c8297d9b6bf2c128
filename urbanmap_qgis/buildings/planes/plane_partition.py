"""A building's plan divided among its roof planes (in place of J 5.3.3): polygons at their planes' heights."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ..polygons.plan_arrangement import dissolve
from .candidate_segments import candidate_segments
from .label_raster import LabelRaster, label_raster
from .low_patches import LowPatches, high_patches, low_patches
from .plan_faces import PlanFaces, label_faces, plan_faces
from .plan_nodes import meeting_polygons
from .plane_moments import moments
from .plane_regularisation import regular_planes

# Times that patches are looked for, and faces of a plan above which none are: it would be divided anew.
PATCH_ROUNDS = 3
PATCH_FACES = 10_000
# Points of one building that lines are placed and planes are chosen by; of more a regular choice is taken.
MOST_POINTS = 100_000

OK, ONE_PLANE = "ok", "one plane"


@dataclass(frozen=True)
class PlanePartition:
    """Polygons (k) with z that fill an outline, edge by edge beside each other.

    Attributes
    ----------
    polygons : at the heights of their planes, m, in the outline's coordinates.
    roof_numbers : (k,) the plane's number as the points have it.
    planes : (k, 3) a, b, c of z = a (x - origin x) + b (y - origin y) + c.
    origin : x and y, m.
    coverage : (k,) share of the area with points.
    status : "ok" or "one plane".
    """

    polygons: tuple[shapely.Polygon, ...]
    roof_numbers: np.ndarray
    planes: np.ndarray
    origin: np.ndarray
    coverage: np.ndarray
    status: str


def partition_planes(outline: shapely.Geometry, points: np.ndarray, roof: np.ndarray,
                     planes: np.ndarray | None = None) -> PlanePartition:
    """Divide an outline among the planes of the points in and round it.

    Parameters
    ----------
    outline : Polygon or MultiPolygon, courtyards as holes, m.
    points : (n, 3) of the building, m.
    roof : (n,) number of the plane of each, 0 = none; at least one has a plane.
    planes : (k, 3) in the order of their numbers where they are known already, on the south-west corner of the
        outline's box, in whole metres.
    """
    origin = np.floor(outline.bounds[:2])
    numbers, rows = np.unique(roof[roof > 0], return_inverse=True)
    of_point = np.full(len(roof), -1)
    of_point[roof > 0] = rows.ravel()
    points = points - np.array([*origin, 0.0])
    local = shapely.transform(shapely.force_2d(outline), lambda c: c - origin)
    if planes is None:
        planes = regular_planes(moments(points, of_point, len(numbers)))
    density = max(np.count_nonzero(of_point >= 0) / local.area, 0.3)
    raster = label_raster(points, of_point, local, density)
    step = -(-len(points) // MOST_POINTS)
    polygons, labels, planes, number = _divided(local, raster, planes, points[::step], of_point[::step])
    shift = np.array([*origin, 0.0])
    moved = tuple(shapely.set_coordinates(polygon, shapely.get_coordinates(polygon, include_z=True) + shift)
                  for polygon in meeting_polygons(polygons, planes[labels]))
    status = ONE_PLANE if len(planes) == 1 else OK
    return PlanePartition(moved, numbers[number][labels], planes[labels], origin, _coverage(raster, polygons), status)


def _divided(outline: shapely.Geometry, raster: LabelRaster, planes: np.ndarray, points: np.ndarray,
             label: np.ndarray) -> tuple[list[shapely.Polygon], np.ndarray, np.ndarray, np.ndarray]:
    """Polygons that fill the outline, the plane of each, all planes with patches, and the plane each is or was."""
    faces, chosen = _labelled(outline, raster, planes, points, label)
    count = len(planes)
    number = np.arange(count)
    for _ in range(PATCH_ROUNDS):
        found = _patches(raster, planes, points, label, faces.polygons, chosen, count)
        if found is None:
            break
        raster, planes, label = found.raster, found.planes, found.label
        number = np.concatenate([number, number[found.taken_from]])
        faces, chosen = _labelled(outline, raster, planes, points, label, range(count, len(planes)))
    return *dissolve(faces.polygons, chosen, outline), planes, number


def _patches(raster: LabelRaster, planes: np.ndarray, points: np.ndarray, label: np.ndarray, polygons: np.ndarray,
             chosen: np.ndarray, count: int) -> LowPatches | None:
    """Low patches of a divided plan, high ones where there are no low ones, None in plans of many faces."""
    if len(polygons) > PATCH_FACES:
        return None
    given = (raster, planes, points, label, polygons, chosen, count)
    found = low_patches(*given)
    return high_patches(*given) if found is None else found


def _labelled(outline: shapely.Geometry, raster: LabelRaster, planes: np.ndarray, points: np.ndarray,
              label: np.ndarray, patches: Sequence[int] = ()) -> tuple[PlanFaces, np.ndarray]:
    """Faces of an outline, and the plane of each."""
    if len(planes) == 1:
        parts = shapely.get_parts(outline)
        whole = PlanFaces(parts, np.zeros((0, 2), np.int64), np.zeros(0), np.zeros((0, 2, 2)))
        return whole, np.zeros(len(parts), np.int64)
    faces = plan_faces(outline, candidate_segments(raster, planes, outline, points, label, patches))
    return faces, label_faces(faces, raster, planes, points, label)


def _coverage(raster: LabelRaster, polygons: list[shapely.Polygon]) -> np.ndarray:
    """Share (k,) of the cells of each polygon that hold points."""
    row, column = np.nonzero(raster.inside)
    places = shapely.points(raster.x[column], raster.y[row])
    place, polygon = shapely.STRtree(polygons).query(places, predicate="intersects")
    cells = np.bincount(polygon, minlength=len(polygons))
    return np.bincount(polygon, raster.seen[row, column][place], len(polygons)) / np.maximum(cells, 1)
