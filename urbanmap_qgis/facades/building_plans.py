"""Plans and heights of buildings, from outlines or from solids with upright walls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ..errors import InputError, InsufficientDataError
from ..geometry.tolerances import LEAST_FACE, MILLIMETRE
from ..wording import say


@dataclass(frozen=True, eq=False)
class BuildingPlans:
    """Buildings as the facades see them, arrays (n,).

    Attributes
    ----------
    ids : int64.
    plan : (Multi)Polygon in plan, None where the building has no usable geometry.
    base, top : lowest and highest z, m; NaN where the geometry has no heights.
    """

    ids: np.ndarray
    plan: np.ndarray
    base: np.ndarray
    top: np.ndarray

    def __len__(self) -> int:
        return len(self.ids)


def building_plans(geometries: Sequence[shapely.Geometry | None], ids: Sequence[int]) -> BuildingPlans:
    """Plans of outlines (polygons) or solids (MultiPolygonZ whose parts are faces).

    Upright faces have no plan and are left out; the others are joined. A geometry whose z are all equal is an
    outline: it tells no height.

    Raises
    ------
    InputError : two buildings have the same id.
    InsufficientDataError : no building has a usable plan.
    """
    ids = np.asarray(ids, np.int64)
    if len(np.unique(ids)) < len(ids):
        raise InputError(say("Two buildings have the same building_id: give each building its own."))
    plan = np.full(len(ids), None, object)
    base, top = np.full(len(ids), np.nan), np.full(len(ids), np.nan)
    for row, geometry in enumerate(geometries):
        if geometry is None or geometry.is_empty:
            continue
        plan[row] = _plan(geometry)
        z = shapely.get_coordinates(geometry, include_z=True)[:, 2]
        if geometry.has_z and np.isfinite(z).all() and np.ptp(z) > 0:
            base[row], top[row] = z.min(), z.max()
    if shapely.is_missing(plan).all():
        raise InsufficientDataError(say("No building has a polygon: choose a layer of outlines or building models."))
    return BuildingPlans(ids, plan, base, top)


def _plan(geometry: shapely.Geometry) -> shapely.Geometry | None:
    """What a geometry covers in plan."""
    parts = shapely.get_parts(shapely.get_parts(shapely.force_2d(geometry)))
    parts = parts[(shapely.get_type_id(parts) == 3)]
    parts = parts[shapely.area(parts) > LEAST_FACE]
    if not len(parts):
        return None
    bad = ~shapely.is_valid(parts)
    parts[bad] = shapely.make_valid(parts[bad])
    union = shapely.union_all(parts, grid_size=MILLIMETRE)  # no hair lines are left between faces
    pieces = shapely.get_parts(union)
    pieces = pieces[shapely.get_type_id(pieces) == 3]
    return None if not len(pieces) else pieces[0] if len(pieces) == 1 else shapely.multipolygons(pieces)


def outline_edges(plan: shapely.Geometry) -> tuple[np.ndarray, np.ndarray]:
    """Straight edges of a plan.

    Returns
    -------
    (k, 2, 2) ends, the building at the left, and (k, 2) unit vectors outwards. Edges run on over nodes at which
    they do not turn.
    """
    rings = shapely.get_rings(shapely.get_parts(shapely.normalize(shapely.simplify(plan, 0.005))))
    ends, outward = [], []
    for ring in rings:
        xy = shapely.get_coordinates(ring)
        ends.append(np.stack([xy[:-1], xy[1:]], axis=1))
    ends = np.concatenate(ends)
    along = ends[:, 1] - ends[:, 0]
    length = np.hypot(*along.T)
    ends, along = ends[length > 0], along[length > 0] / length[length > 0, None]
    # Normalised polygons have clockwise outer rings and counterclockwise holes: the inside lies at the right.
    ends, along = ends[:, ::-1], -along
    outward = np.column_stack([along[:, 1], -along[:, 0]])
    return ends, outward
