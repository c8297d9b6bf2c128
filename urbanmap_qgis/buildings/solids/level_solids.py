"""From level roofs to solids, and what the check says against them: plan, solids, check in one step."""

from __future__ import annotations

import numpy as np
import shapely

from ...geometry.solid import Solid
from .plan_partition import partition_plan
from .solid import building_solids
from .validity import check_solid


def checked_level_solids(outline: shapely.Geometry | None, polygons: np.ndarray, heights: np.ndarray, ids: np.ndarray,
                         base: float) -> tuple[tuple[Solid, ...], list[str]]:
    """Solids over roofs' polygons (n,) at their heights (n,), m, and what the check says against them."""
    plan = partition_plan(outline, list(polygons), heights.tolist(), ids.tolist(), limit="roofs")
    solids = building_solids(plan.cells, base)
    return solids, [f"{problem.code} {problem.name}" for solid in solids for problem in check_solid(solid)]
