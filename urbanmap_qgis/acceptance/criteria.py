"""Criteria of acceptance: each figure against its limit, unit by unit, and what they say together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..wording import mark
from .check_points import CheckPoints
from .edge_sampling import measured_edges
from .error_figures import ErrorFigures, point_figures
from .map_levels import Limits

PASSED, FAILED, NOT_CHECKED = "passed", "failed", "not checked"
OUTCOMES = {PASSED: mark("passed"), FAILED: mark("failed"), NOT_CHECKED: mark("not checked")}

PLAN, HEIGHT = mark("position in plan"), mark("height")


@dataclass(frozen=True)
class Criterion:
    """One figure against its limit.

    Attributes
    ----------
    unit : of inspection, "" where there is one only.
    component : PLAN or HEIGHT.
    figures : of the errors.
    limit : greatest standard deviation, m.
    needed : least number of points.
    edges : edges of buildings with both points measured, None where points are of no edges.
    needed_edges : least number of these.
    barred : why it is not judged although there are enough of them; "" where it is.
    """

    unit: str
    component: str
    figures: ErrorFigures
    limit: float
    needed: int
    edges: int | None = None
    needed_edges: int = 0
    barred: str = ""

    @property
    def outcome(self) -> str:
        """PASSED, FAILED, or NOT_CHECKED where there are fewer points or edges than needed, or it is barred."""
        if self.barred:
            return NOT_CHECKED
        if self.edges is not None and self.edges < self.needed_edges:
            return NOT_CHECKED
        if self.figures.count < max(self.needed, 1) or not np.isfinite(self.figures.rmse):
            return NOT_CHECKED
        return PASSED if self.figures.rmse <= self.limit else FAILED

    @property
    def is_certain(self) -> bool:
        """With so many points the limit is kept with a confidence of 95 %, not only by these points."""
        return self.outcome == PASSED and self.figures.bound <= self.limit


def criteria(points: CheckPoints, limits: Limits, needed: int = 1, needed_edges: int = 0) -> list[Criterion]:
    """The criteria of each unit of inspection, plan before height; those without a limit are left out.

    `needed` and `needed_edges` are the fewest points, and edges with both points measured, that a unit is judged by.
    """
    found = []
    edges = measured_edges(points.edge, points.unit) if points.edge else {}
    for unit in dict.fromkeys(points.unit):
        figures = point_figures(points.of_unit(unit).errors)
        for component, values, limit in ((PLAN, figures.plan, limits.plan), (HEIGHT, figures.height, limits.height)):
            if limit is not None:
                found.append(Criterion(unit, component, values, limit, needed, edges.get(unit), needed_edges))
    return found


def outcome(found: Sequence[Criterion]) -> str:
    """FAILED where one failed, else NOT_CHECKED where one could not be checked or there is none, else PASSED."""
    outcomes = {criterion.outcome for criterion in found}
    return FAILED if FAILED in outcomes else PASSED if outcomes == {PASSED} else NOT_CHECKED
