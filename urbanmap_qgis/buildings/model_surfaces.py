"""The surfaces of a building's model as its figures of fit need them: roofs in plan with heights, walls, ground."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ..geometry.solid import GROUND, INNER_WALL, OUTER_WALL, ROOF, Solid, surfaces
from ..geometry.solid_faces import face_normal
from .quality import RoofCell


@dataclass(frozen=True)
class ModelSurfaces:
    """Surfaces of one building's solids.

    Attributes
    ----------
    cells : roofs in plan with heights.
    walls : see `wall_rectangles`.
    ground_area : of the ground faces, m2.
    """

    cells: list[RoofCell]
    walls: np.ndarray
    ground_area: float

    @classmethod
    def of(cls, solids: tuple[Solid, ...]) -> ModelSurfaces:
        """The surfaces of solids."""
        return cls(roof_cells(solids), wall_rectangles(solids), ground_area(solids))


def roof_cells(solids: tuple[Solid, ...]) -> list[RoofCell]:
    """Roofs of solids as plan polygons with heights."""
    cells = []
    for solid in solids:
        roofs = [(face, roof_id) for kind, face, roof_id in zip(solid.surface_type, solid.faces, solid.roof_id)
                 if kind == ROOF]
        for polygon, (face, roof_id) in zip(shapely.force_2d(surfaces(solid, ROOF)), roofs):
            corners = solid.vertices[list(face[0])]
            place, gradient = corners[0].tolist(), (0.0, 0.0)
            if (corners[:, 2] != corners[0, 2]).any():
                normal = face_normal(solid.vertices, face)
                gradient = float(-normal[0] / normal[2]), float(-normal[1] / normal[2])
            cells.append(RoofCell(polygon, place[2], roof_id, gradient, (place[0], place[1])))
    return cells


def wall_rectangles(solids: tuple[Solid, ...]) -> np.ndarray:
    """Walls of solids (w, 8): x and y of both ends, lowest z at both, highest z at both."""
    rows = [_wall_rectangle(solid.vertices[list(face[0])].tolist())
            for solid in solids
            for face, kind in zip(solid.faces, solid.surface_type) if kind in (OUTER_WALL, INNER_WALL)]
    return np.array(rows, dtype=float).reshape(-1, 8)


def _wall_rectangle(corners: list[list[float]]) -> list[float]:
    """The row of one wall, from its few corners: plain numbers are faster here than arrays."""
    x0, y0, _ = corners[0]
    along = [(x - x0, y - y0) for x, y, _ in corners]
    length2 = [dx * dx + dy * dy for dx, dy in along]
    far = length2.index(max(length2))
    near_z, far_z = [], []
    for (dx, dy), (_, _, z) in zip(along, corners):
        (far_z if dx * along[far][0] + dy * along[far][1] > 0.5 * length2[far] else near_z).append(z)
    return [x0, y0, corners[far][0], corners[far][1], min(near_z), min(far_z), max(near_z), max(far_z)]


def ground_area(solids: tuple[Solid, ...]) -> float:
    """Plan area of solids, m2."""
    return float(sum(shapely.area(surfaces(solid, GROUND)).sum() for solid in solids))
