"""Scores of flat building models against laser points and true outlines, as the published comparison has them.

Only class 6 points 0.3 m or more inside the true outline count. Means are over buildings.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from urbanmap_qgis.buildings.point_assignment import PlanIndex
from urbanmap_qgis.buildings.quality import RoofCell, model_fit

INSET = 0.3


@dataclass(frozen=True)
class Score:
    """Figures of one building; NaN where it has no model or no points."""

    building: object
    points: int
    rmse_z: float
    rmse_z95: float
    median_dz: float
    rmse_3d: float
    coverage: float
    plan_iou: float
    roofs: int


def score_building(building: object, truth: shapely.Geometry, points: np.ndarray,
                   cells: list[RoofCell], walls: np.ndarray) -> Score:
    """Score one model: `points` (n, 3) well inside the true outline, `walls` (w, 6)."""
    fit = model_fit(*points.T, cells, walls)
    plan = shapely.union_all([cell.polygon for cell in cells]) if cells else shapely.Polygon()
    union = plan.union(truth).area
    return Score(building, len(points), fit.rmse_z, fit.rmse_z95, fit.median_dz, fit.rmse_3d, fit.coverage,
                 plan.intersection(truth).area / union if union else float("nan"), len(cells))


def points_inside(xyz: np.ndarray, outlines: np.ndarray) -> list[np.ndarray]:
    """Points (n, 3) that lie `INSET` m or more inside each outline."""
    index = PlanIndex(xyz[:, 0], xyz[:, 1])
    return [xyz[index.inside(outline)] for outline in shapely.buffer(outlines, -INSET)]


def summary(scores: list[Score]) -> dict[str, float]:
    """Means over the buildings that have a model, and how many have."""
    modelled = [score for score in scores if score.roofs]
    names = ("rmse_z", "rmse_z95", "median_dz", "rmse_3d", "coverage", "plan_iou")
    result = {name: float(np.nanmean([getattr(score, name) for score in modelled])) for name in names}
    result.update(buildings=len(scores), modelled=len(modelled), roofs=sum(score.roofs for score in modelled))
    return result
