"""Heights of building models in cells, and what they hide from a camera."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from rasterio.features import rasterize
from rasterio.transform import Affine
from scipy.ndimage import minimum_filter

from ...io.raster import own_gdal
from ..views.sight_lines import blocked_lines, sight_lines

CELL = 0.25
"""Side of a cell where the area allows it, m."""

_MOST_CELLS = 16_000_000
_BELOW = 0.3  # m that a ray must run below a roof to be blocked
_BESIDE = np.array([[0, 1, 0], [1, 1, 1], [0, 1, 0]], bool)  # a cell and those it shares a side with
_UP = 0.1  # faces whose normals rise less are walls


@dataclass(frozen=True, eq=False)
class RoofHeights:
    """Heights of roofs: `top` (rows, columns) from the south-west corner `low` (2,) northwards, else -inf."""

    low: np.ndarray
    cell: float
    top: np.ndarray

    def hidden(self, places: np.ndarray, cameras: np.ndarray, clearance: float) -> np.ndarray:
        """Mask (n,) of places (n, 3) that a building hides from their cameras (n, 3).

        The first `clearance` m of the ray are not tested: there lies what the place itself belongs to.
        """
        highest = float(self.top.max(initial=-np.inf))
        if not len(places) or not np.isfinite(highest):
            return np.zeros(len(places), bool)

        def blocks(at: np.ndarray, left: np.ndarray, along: np.ndarray) -> np.ndarray:
            return self._heights(at) > at[:, 2] + _BELOW

        return blocked_lines(places, sight_lines(places, cameras), np.full(len(places), clearance), highest, self.cell,
                             blocks)

    def _heights(self, at: np.ndarray) -> np.ndarray:
        column, row = np.floor((at[:, :2] - self.low) / self.cell).astype(int).T
        rows, columns = self.top.shape
        inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        found = np.full(len(at), -np.inf)
        found[inside] = self.top[row[inside], column[inside]]
        return found


NO_ROOFS = RoofHeights(np.zeros(2), CELL, np.empty((0, 0), np.float32))


def roof_heights(geometries: Sequence[shapely.Geometry | None]) -> RoofHeights:
    """Heights of the upward faces of models (polygons in space); where several lie above each other, the highest.

    Each cell has the lowest of its own and the heights beside it, so that none reaches out of its building: a ray
    along a wall, as to an upright edge of the silhouette, would run through such cells for metres.
    """
    parts = shapely.get_parts([item for item in geometries if item is not None and not shapely.is_empty(item)])
    planes, faces = [], []
    for face in parts[(shapely.get_type_id(parts) == 3) & shapely.has_z(parts)] if len(parts) else ():
        corners = shapely.get_coordinates(face.exterior, include_z=True)
        middle = corners[:-1].mean(axis=0)
        _, _, axes = np.linalg.svd(corners[:-1] - middle, full_matrices=False)
        normal = axes[2] if len(axes) == 3 else np.zeros(3)
        if abs(normal[2]) > _UP:
            slope = -normal[:2] / normal[2]
            planes.append((*slope, middle[2] - slope @ middle[:2], corners[:, 2].max()))
            faces.append(shapely.force_2d(face))
    if not faces:
        return NO_ROOFS
    plane = np.array(planes)
    low_x, low_y, high_x, high_y = shapely.total_bounds(faces)
    cell = max(CELL, np.sqrt((high_x - low_x) * (high_y - low_y) / _MOST_CELLS))
    low = np.floor(np.array([low_x, low_y]) / cell) * cell
    shape = (int(np.ceil((high_y - low[1]) / cell)) + 1, int(np.ceil((high_x - low[0]) / cell)) + 1)
    order = np.argsort(plane[:, 3], kind="stable")
    with own_gdal():
        owner = rasterize([(faces[k], int(k) + 1) for k in order], shape, fill=0, dtype="int32",
                          transform=Affine(cell, 0.0, low[0], 0.0, cell, low[1]))
    row, column = np.nonzero(owner)
    found = plane[owner[row, column] - 1]
    x, y = low[0] + (column + 0.5) * cell, low[1] + (row + 0.5) * cell
    top = np.full(shape, -np.inf, np.float32)
    top[row, column] = found[:, 0] * x + found[:, 1] * y + found[:, 2]
    return RoofHeights(low, cell, minimum_filter(top, footprint=_BESIDE, mode="constant", cval=-np.inf))
