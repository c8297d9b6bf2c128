"""Closed solids from the cells of a plan: roofs at their heights, walls between them, one ground (J 5.3.4)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ...geometry.solid import Solid
from .plan_partition import Cell, partition_plan
from .sloped_solid import LEAST_STEP, SlopedCell, sloped_solids
from .validity import check_solid


def building_solids(cells: Sequence[Cell], base_height: float) -> tuple[Solid, ...]:
    """Raise the cells of a plan to solids, one for each part whose cells hang together by edges.

    Roofs nearer in height than `LEAST_STEP` become one level: laser heights do not show such steps, and validators join
    vertices of 1 mm.

    Parameters
    ----------
    cells : cells of one building, edge by edge beside each other (`partition_plan`).
    base_height : height of the ground face, m; a roof less than 10 cm above it is put there, and the solid counts them.

    Raises
    ------
    InputError : the base height is not finite, or cells overlap.
    """
    heights = np.array([cell.height for cell in cells])
    level = -np.inf
    for row in np.argsort(heights, kind="stable"):
        level = level if heights[row] - level < LEAST_STEP - 1e-9 else heights[row]
        heights[row] = level
    return sloped_solids([SlopedCell(cell.polygon, cell.roof_id, (0.0, 0.0, height))
                          for cell, height in zip(cells, heights.tolist())], base_height)


def checked_level_solids(outline: shapely.Geometry | None, polygons: np.ndarray, heights: np.ndarray, ids: np.ndarray,
                         base: float) -> tuple[tuple[Solid, ...], list[str]]:
    """Solids over roofs' polygons (n,) at their heights (n,), m, and what the check says against them."""
    plan = partition_plan(outline, list(polygons), heights.tolist(), ids.tolist())
    solids = building_solids(plan, base)
    return solids, [f"{problem.code} {problem.name}" for solid in solids for problem in check_solid(solid)]
