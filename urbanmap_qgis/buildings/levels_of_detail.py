"""Levels of detail 0, 1.2 and 1.3 of a building from its solids, and the heights of its roofs.

Source: F. Biljecki, H. Ledoux and J. Stoter, "An improved LOD specification for 3D building models" (2016): 1.2 is one
block, 1.3 has a height for each part between steps.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import chain

import numpy as np
import shapely

from ..geometry.kept_answers import Kept
from ..geometry.linked_groups import linked_members
from ..geometry.solid import GROUND, ROOF, Solid, surfaces
from ..geometry.tolerances import MILLIMETRE, ROUNDING
from ..geometry.triangulation import Triangle, triangulate_face
from .solids.plan_partition import Cell, partition_plan
from .solids.solid import building_solids
from .solids.validity import check_solid

BLOCK_SHARE = 0.5
"""Share of the roof's plan area that lies below the height of a block: the median, as Japan's LOD1 has it."""


@Kept
def _triangles_of_roofs(solid: Solid) -> dict[int, list[Triangle]]:
    """Triangles of vertices by the number of their roof face."""
    return {number: triangulate_face(solid.vertices, face)
            for number, (face, kind) in enumerate(zip(solid.faces, solid.surface_type)) if kind == ROOF}


def roof_triangles(solids: Sequence[Solid]) -> np.ndarray:
    """Corners (t, 3, 3) of triangles that cover all roofs of solids, m."""
    found = [solid.vertices[np.array([*chain.from_iterable(_triangles_of_roofs(solid).values())], int).reshape(-1, 3)]
             for solid in solids]
    return np.concatenate(found) if found else np.empty((0, 3, 3))


def height_quantiles(triangles: np.ndarray, shares: Sequence[float]) -> np.ndarray:
    """Heights (n,) below which given shares (n,) of the plan area of triangles (t, 3, 3) lie, m.

    Exact for sloped triangles: the share of one below a height is a quadratic function of the height.
    """
    triangles = np.asarray(triangles, float)
    edges = triangles[:, 1:] - triangles[:, :1]
    area = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]) / 2.0
    triangles, area = triangles[area > 0], area[area > 0]
    if not len(area):
        return np.full(len(shares), np.nan)
    z, levels = np.sort(triangles[:, :, 2], axis=1), np.unique(triangles[:, :, 2])
    return np.array([_quantile(z, area / area.sum(), levels, float(share)) for share in shares])


def _quantile(z: np.ndarray, weight: np.ndarray, levels: np.ndarray, share: float) -> float:
    """Height below which a share lies: between two corners' heights the share is a quadratic function of the height."""
    def below(height: float) -> float:
        return float(_share_below(z, np.array([height]))[0] @ weight)

    low, high = 0, len(levels) - 1
    if share <= 0.0 or not high:
        return float(levels[0])
    while low < high:  # the first corner's height up to which the share lies
        middle = (low + high) // 2
        low, high = (low, middle) if below(levels[middle]) >= min(share, 1.0) - ROUNDING else (middle + 1, high)
    if low == 0:
        return float(levels[0])
    start, length = float(levels[low - 1]), float(levels[low] - levels[low - 1])
    at0, at1, at2 = (below(start + part * length) for part in (0.0, 1 / 3, 2 / 3))
    square, linear = 4.5 * (at0 - 2.0 * at1 + at2), 1.5 * (4.0 * at1 - 3.0 * at0 - at2)
    root = math.sqrt(max(linear * linear + 4.0 * square * (share - at0), 0.0))
    place = 2.0 * (share - at0) / (linear + root) if linear + root > 0 else 1.0
    return start + min(max(place, 0.0), 1.0) * length


def _share_below(z: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Share (k, t) of each triangle's area below heights (k,); `z` (t, 3) are its heights in order."""
    low, middle, high = z.T
    height = heights[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        rising = (height - low) ** 2 / ((high - low) * (middle - low))
        falling = 1.0 - (high - height) ** 2 / ((high - low) * (high - middle))
    return np.where(height >= high, 1.0, np.where(height <= low, 0.0, np.where(height < middle, rising, falling)))


@Kept
def block_height(solid: Solid) -> float:
    """Median height of the roofs of a solid over their plan, m."""
    return float(height_quantiles(roof_triangles([solid]), [BLOCK_SHARE])[0])


@Kept
def roof_steps(solid: Solid) -> list[tuple[shapely.Geometry, float]]:
    """The roofs of a solid between its steps, which meet along edges in space: plan and median height over it, m."""
    faces = [face for face, kind in enumerate(solid.surface_type) if kind == ROOF]
    plans = shapely.force_2d(surfaces(solid)[faces])
    steps = []
    for rows in _joined_roofs(solid, faces):
        triangles = solid.vertices[[triangle for row in rows for triangle in _triangles_of_roofs(solid)[faces[row]]]]
        height = float(height_quantiles(triangles, [BLOCK_SHARE])[0])
        steps.append((plans[rows[0]] if len(rows) == 1 else shapely.union_all(plans[rows]), height))
    return steps


def block_solid(solid: Solid) -> tuple[Solid, ...]:
    """Level of detail 1.2 of a solid: its plan raised to the median height of its roofs; empty where not valid."""
    height = block_height(solid)
    return _raised(solid, [(plan, 0, height) for plan in _ground_plans(solid)])


def stepped_solids(solid: Solid) -> tuple[Solid, ...]:
    """Level of detail 1.3 of a solid: roofs that meet along an edge have one height, their median; steps stay.

    A solid of level roofs is its own level 1.3. Empty where no valid solid comes of it.
    """
    if all(np.ptp(solid.vertices[list(face[0]), 2]) < MILLIMETRE for face, kind in zip(solid.faces, solid.surface_type)
           if kind == ROOF):
        return (solid,)
    return _raised(solid, [(plan, number, height) for number, (plan, height) in enumerate(roof_steps(solid))])


def _raised(solid: Solid, cells: list[tuple[shapely.Geometry, int, float]]) -> tuple[Solid, ...]:
    """Solids of plans, their numbers and heights (m) over the ground of a solid; empty where one is not valid."""
    base = float(solid.vertices[:, 2].min())
    polygons, numbers, heights = (list(column) for column in zip(*cells))
    if len(cells) == 1 and polygons[0].geom_type == "Polygon":
        plan: tuple[Cell, ...] = (Cell(polygons[0], numbers[0], heights[0]),)
    else:
        plan = partition_plan(None, polygons, heights, numbers)
    solids = building_solids(plan, base)
    return () if any(check_solid(one) for one in solids) else solids


def _ground_plans(solid: Solid) -> list[shapely.Polygon]:
    """Plan polygons of the ground faces."""
    faces = [face for face, kind in enumerate(solid.surface_type) if kind == GROUND]
    return list(shapely.force_2d(surfaces(solid)[faces]))


def _joined_roofs(solid: Solid, faces: Sequence[int]) -> list[list[int]]:
    """Rows of the roofs of each group: roofs with a common edge in space are of one."""
    owner: dict[tuple[int, int], int] = {}
    links = [(row, owner.setdefault((min(edge), max(edge)), row)) for row, face in enumerate(faces)
             for ring in solid.faces[face] for edge in zip(ring, (*ring[1:], ring[0]))]
    return [group.tolist() for group in linked_members(*np.array(links, np.int64).reshape(-1, 2).T, len(faces))]
