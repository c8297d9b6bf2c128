"""Checked solids from roof polygons whose z says where their planes lie."""

from __future__ import annotations

import numpy as np
import shapely

from ...errors import InputError
from ...geometry.polygon_rings import polygon_rings
from ...geometry.solid import Solid
from ...geometry.tolerances import SAME_PLACE
from ...wording import say
from ..solids.plan_partition import partition_plan
from ..solids.sloped_solid import SlopedCell, sloped_solids
from ..solids.validity import check_solid

_SAME = 0.02
"""The outer edges of polygons that lie edge by edge beside each other are as long as their union's border, m."""


def checked_sloped_solids(outline: shapely.Geometry | None, polygons: np.ndarray, roof_ids: np.ndarray,
                          base: float) -> tuple[tuple[Solid, ...], list[str]]:
    """Solids on the planes of roof polygons (k) with z, and what the check says against them.

    Polygons that do not lie edge by edge beside each other, as after work by hand, are first cut so.
    """
    origin = np.floor(shapely.total_bounds(polygons)[:2])
    planes = [polygon_plane(polygon, origin) for polygon in polygons]
    ids = roof_ids.tolist()
    problems = [say("the roof polygons overlap or leave gaps")]
    solids: tuple[Solid, ...] = ()
    if is_coverage(polygons):
        cells = [SlopedCell(polygon, number, plane, tuple(origin))
                 for polygon, number, plane in zip(polygons, ids, planes)]
        solids, problems = _checked(cells, base)
    if problems:
        heights = [float(shapely.get_coordinates(polygon, include_z=True)[:, 2].mean()) for polygon in polygons]
        plan = partition_plan(outline, list(polygons), heights, list(range(len(polygons))))
        cells = [SlopedCell(cell.polygon, ids[cell.roof_id], planes[cell.roof_id], tuple(origin))
                 for cell in plan]
        solids, problems = _checked(cells, base)
    return solids, problems


def _checked(cells: list[SlopedCell], base: float) -> tuple[tuple[Solid, ...], list[str]]:
    """Solids of cells, and what the check says against them."""
    try:
        solids = sloped_solids(cells, base)
    except InputError as error:
        return (), [str(error)]
    except (shapely.errors.GEOSException, ValueError) as error:
        return (), [say("a roof cannot be cut into triangles: {error}", error=error)]
    return solids, [f"{problem.code} {problem.name}" for solid in solids for problem in check_solid(solid)]


def polygon_plane(polygon: shapely.Polygon, origin: np.ndarray) -> tuple[float, float, float]:
    """Plane a, b, c of z = a x + b y + c, x and y from `origin`, that fits a polygon's corners best."""
    corners = shapely.get_coordinates(polygon, include_z=True)[:-1]
    if np.ptp(corners[:, 2]) < SAME_PLACE:
        return 0.0, 0.0, float(corners[0, 2])
    middle = corners.mean(axis=0)
    away = corners - middle
    slope = np.linalg.lstsq(away[:, :2], away[:, 2], rcond=None)[0]
    a, b = slope.tolist()
    return a, b, float(middle[2] - slope @ (middle[:2] - origin))


def is_sloped(polygon: shapely.Geometry) -> bool:
    """Whether a polygon has heights that differ by a millimetre or more."""
    return bool(shapely.has_z(polygon)) and np.ptp(shapely.get_coordinates(polygon, include_z=True)[:, 2]) > 1e-3


def is_coverage(polygons: np.ndarray) -> bool:
    """Whether polygons lie edge by edge beside each other, with common nodes and without overlap."""
    flat = shapely.force_2d(polygons)
    xy, ring = shapely.get_coordinates(polygon_rings(flat)[0], return_index=True)
    same = ring[1:] == ring[:-1]
    start, end = xy[:-1][same], xy[1:][same]
    low, high = np.minimum(start, end), np.maximum(start, end)
    turned = (start[:, 0] > end[:, 0]) | ((start[:, 0] == end[:, 0]) & (start[:, 1] > end[:, 1]))
    key = np.where(turned[:, None], np.column_stack([end, start]), np.column_stack([start, end]))
    _, first, count = np.unique(np.rint(key * 1e4).astype(np.int64), axis=0, return_index=True, return_counts=True)
    if (count > 2).any():
        return False
    outer = np.hypot(*(high - low)[first[count == 1]].T).sum()
    try:
        whole = shapely.union_all(flat)
    except shapely.errors.GEOSException:
        return False  # edges that cross each other: no plan of polygons beside each other
    return bool(abs(shapely.length(shapely.boundary(whole)) - outer) < _SAME
                and abs(shapely.area(flat).sum() - whole.area) < _SAME)
