"""A building's plan divided among its roof planes (in place of J 5.3.3): polygons at their planes' heights."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from scipy.sparse import coo_matrix

from ...geometry.linked_groups import linked_groups
from ..polygons.partition_lines import edge_rows
from ..polygons.piece_labels import without_small_parts
from ..polygons.plan_arrangement import dissolve
from ..polygons.regularisation import main_directions
from .candidate_segments import candidate_segments
from .label_raster import LabelRaster, label_raster
from .low_patches import LowPatches, high_patches, low_patches
from .plan_faces import SMOOTHNESS, PlanFaces, label_faces, plan_faces, seen_heights
from .plan_nodes import meeting_polygons
from .plane_moments import moments
from .plane_regularisation import regular_planes


@dataclass(frozen=True)
class PlanePartitionLimits:
    """Limits of plane partition, each with its unit."""

    least_area: float = 2.0  # Smaller pieces of a roof (m2) join the neighbour that fits best.
    # Width (m) up to which, and slope (rise over run) from which, a plane is no roof: points of a facade or of
    # the side of a parapet, which lie in a strip along it.
    strip_width: float = 0.5
    strip_slope: float = 0.1
    # A smaller piece stays where its neighbours would miss its points by so much more (m3).
    strong: float = 0.5
    # Times that patches are looked for, and faces of a plan above which none are: it would be divided anew.
    patch_rounds: int = 3
    patch_faces: int = 10_000
    # Points of one building that lines are placed and planes are chosen by; of more a regular choice is taken.
    most_points: int = 100_000


LIMITS = PlanePartitionLimits()

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


@dataclass(frozen=True, eq=False)
class PlanePoints:
    """A building's points on planes, on a local origin.

    Attributes
    ----------
    origin : x and y, m: the south-west corner of the outline's box, in whole metres.
    xyz : (n, 3) points, m.
    numbers : (k,) of the planes, ascending.
    plane : (n,) row of each point's plane, -1 on none.
    """

    origin: np.ndarray
    xyz: np.ndarray
    numbers: np.ndarray
    plane: np.ndarray

    @classmethod
    def of(cls, outline: shapely.Geometry, points: np.ndarray, roof: np.ndarray) -> PlanePoints:
        """Points as `partition_planes` takes them."""
        origin = np.floor(outline.bounds[:2])
        roof = without_steep_strips(points, roof)
        numbers, rows = np.unique(roof[roof > 0], return_inverse=True)
        plane = np.full(len(roof), -1)
        plane[roof > 0] = rows.ravel()
        return cls(origin, points - np.array([*origin, 0.0]), numbers, plane)

    @property
    def moments(self) -> np.ndarray:
        """Moments (k, 10) of the planes' points."""
        return moments(self.xyz, self.plane, len(self.numbers))


def building_axes(edges: np.ndarray) -> np.ndarray:
    """Unit vectors (d, 2) of the main directions of edges (n, 2) of outlines, and across them."""
    angle = np.radians(main_directions(edges))
    return np.concatenate([np.column_stack([np.cos(angle), np.sin(angle)]),
                           np.column_stack([-np.sin(angle), np.cos(angle)])])


def partition_planes(outline: shapely.Geometry, points: np.ndarray, roof: np.ndarray,
                     planes: np.ndarray | None = None) -> PlanePartition:
    """Divide an outline among the planes of the points in and round it.

    Parameters
    ----------
    outline : Polygon or MultiPolygon, courtyards as holes, m.
    points : (n, 3) of the building, m.
    roof : (n,) number of the plane of each, 0 = none; at least one has a plane.
    planes : (k, 3) where they are known already, as `PlanePoints` numbers them and on its origin.
    """
    found = PlanePoints.of(outline, points, roof)
    origin, points, numbers, of_point = found.origin, found.xyz, found.numbers, found.plane
    local = shapely.transform(shapely.force_2d(outline), lambda c: c - origin)
    if planes is None:
        planes = regular_planes(found.moments, building_axes(edge_rows(local)[:, 2:]))
    density = max(np.count_nonzero(of_point >= 0) / local.area, 0.3)
    raster = label_raster(points, of_point, local, density)
    raster, planes, capped = _with_caps(raster, planes, points, of_point)
    numbers = np.concatenate([numbers, numbers[capped]])
    step = -(-len(points) // LIMITS.most_points)
    polygons, labels, planes, number = _divided(local, raster, planes, points[::step], of_point[::step])
    numbers = numbers[number]
    lifted, met = meeting_polygons(polygons, planes[labels])
    shift = np.array([*origin, 0.0])
    moved = tuple(shapely.set_coordinates(polygon, shapely.get_coordinates(polygon, include_z=True) + shift)
                  for polygon in lifted)
    status = ONE_PLANE if len(planes) == 1 else OK
    return PlanePartition(moved, numbers[labels], met, origin, _coverage(raster, polygons), status)


def without_steep_strips(points: np.ndarray, roof: np.ndarray) -> np.ndarray:
    """Plane (n,) of each point, 0 for those of steep planes that are seen in a narrow strip alone.

    Where that would leave no plane, all stay.
    """
    left = roof.copy()
    order = np.argsort(roof, kind="stable")
    order = order[np.searchsorted(roof[order], 1):]
    for members in np.split(order, np.flatnonzero(np.diff(roof[order])) + 1) if len(order) else ():
        centred = points[members] - points[members].mean(axis=0)
        spread = np.linalg.eigvalsh(np.cov(centred[:, :2].T)) if len(centred) > 2 else np.zeros(2)
        slope = np.linalg.lstsq(centred[:, :2], centred[:, 2], rcond=1e-6)[0]
        # Evenly spread points lie on 3.5 standard deviations.
        if np.sqrt(12.0 * max(spread[0], 0.0)) < LIMITS.strip_width and np.hypot(*slope) > LIMITS.strip_slope:
            left[members] = 0
    return left if (left > 0).any() else roof


def _with_caps(raster: LabelRaster, planes: np.ndarray, points: np.ndarray,
               label: np.ndarray) -> tuple[LabelRaster, np.ndarray, np.ndarray]:
    """Level planes where a sloped one would rise far above its points, as over a slope that was not seen.

    Gives the raster and the planes with these added, and the planes that they cap.
    """
    low, high = seen_heights(planes, points, label, raster.cell)
    x, y = np.meshgrid(raster.x, raster.y)
    plane_at = planes[raster.label]
    height = plane_at[..., 0] * x + plane_at[..., 1] * y + plane_at[..., 2]
    unseen = raster.inside & ~raster.seen
    area = np.bincount(raster.label[unseen & (height > high[raster.label])], minlength=len(planes)) * raster.cell**2
    capped = np.flatnonzero((area > LIMITS.least_area) & np.isfinite(low))
    if not len(capped):
        return raster, planes, capped
    top = np.array([points[label == plane, 2].max() for plane in capped])
    caps = np.column_stack([np.zeros((len(capped), 2)), top])
    number = np.arange(len(planes))
    number[capped] = len(planes) + np.arange(len(capped))
    reached = np.full(len(planes), np.inf)
    reached[capped] = top
    labels = np.where(unseen & (height > reached[raster.label]), number[raster.label], raster.label)
    return replace(raster, label=labels), np.concatenate([planes, caps]), capped


def _divided(outline: shapely.Geometry, raster: LabelRaster, planes: np.ndarray, points: np.ndarray,
             label: np.ndarray) -> tuple[list[shapely.Polygon], np.ndarray, np.ndarray, np.ndarray]:
    """Polygons that fill the outline, the plane of each, all planes with patches, and the plane each is or was."""
    faces, chosen, cost = _labelled(outline, raster, planes, points, label)
    count = len(planes)
    number = np.arange(count)
    for _ in range(LIMITS.patch_rounds):
        found = _patches(raster, planes, points, label, faces.polygons, chosen, count)
        if found is None:
            break
        raster, planes, label = found.raster, found.planes, found.label
        number = np.concatenate([number, number[found.taken_from]])
        faces, chosen, cost = _labelled(outline, raster, planes, points, label, range(count, len(planes)))
    chosen = without_steep_slivers(chosen, cost, faces, planes)
    chosen = without_small_parts(chosen, cost, faces.pairs, faces.length * SMOOTHNESS, shapely.area(faces.polygons),
                                 LIMITS.least_area, LIMITS.strong)
    return *dissolve(faces.polygons, chosen, outline), planes, number


def _patches(raster: LabelRaster, planes: np.ndarray, points: np.ndarray, label: np.ndarray, polygons: np.ndarray,
             chosen: np.ndarray, count: int) -> LowPatches | None:
    """Low patches of a divided plan, high ones where there are no low ones, None in plans of many faces."""
    if len(polygons) > LIMITS.patch_faces:
        return None
    given = (raster, planes, points, label, polygons, chosen, count)
    found = low_patches(*given)
    return high_patches(*given) if found is None else found


def _labelled(outline: shapely.Geometry, raster: LabelRaster, planes: np.ndarray, points: np.ndarray,
              label: np.ndarray, patches: Sequence[int] = ()) -> tuple[PlanFaces, np.ndarray, np.ndarray]:
    """Faces of an outline, the plane of each, and the cost of every plane in it."""
    if len(planes) == 1:
        parts = shapely.get_parts(outline)
        whole = PlanFaces(parts, np.zeros((0, 2), np.int64), np.zeros(0), np.zeros((0, 2, 2)))
        return whole, np.zeros(len(parts), np.int64), np.zeros((len(parts), 1))
    faces = plan_faces(outline, candidate_segments(raster, planes, outline, points, label, patches))
    return faces, *label_faces(faces, raster, planes, points, label)


def without_steep_slivers(chosen: np.ndarray, cost: np.ndarray, faces: PlanFaces, planes: np.ndarray) -> np.ndarray:
    """Plane (n,) of each face; steep parts narrower than `LIMITS.strip_width` go to the best plane beside them."""
    steep = np.hypot(planes[:, 0], planes[:, 1]) > LIMITS.strip_slope
    n, one, two = len(chosen), *faces.pairs.T
    graph = coo_matrix((np.ones(len(one), bool), (one, two)), shape=(n, n)).tocsr()
    graph = graph + graph.T
    same = chosen[one] == chosen[two]
    count, part = linked_groups(one[same], two[same], n)
    members = np.split(np.argsort(part, kind="stable"), np.cumsum(np.bincount(part, minlength=count))[:-1])
    chosen = chosen.copy()
    for number, group in enumerate(members):
        if not steep[chosen[group[0]]]:
            continue
        whole = shapely.coverage_union_all(faces.polygons[group])
        if not shapely.is_empty(shapely.buffer(whole, -LIMITS.strip_width / 2)):
            continue
        touching = graph[group].indices
        beside = np.unique(chosen[touching[part[touching] != number]])
        beside = beside[~steep[beside]] if (~steep[beside]).any() else beside
        if len(beside):
            chosen[group] = beside[np.argmin(cost[group][:, beside].sum(axis=0))]
    return chosen


def _coverage(raster: LabelRaster, polygons: list[shapely.Polygon]) -> np.ndarray:
    """Share (k,) of the cells of each polygon that hold points."""
    row, column = np.nonzero(raster.inside)
    places = shapely.points(raster.x[column], raster.y[row])
    place, polygon = shapely.STRtree(polygons).query(places, predicate="intersects")
    cells = np.bincount(polygon, minlength=len(polygons))
    return np.bincount(polygon, raster.seen[row, column][place], len(polygons)) / np.maximum(cells, 1)
