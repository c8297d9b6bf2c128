"""Pictures of a surveyed road model and of its junctions, as SVG."""

from __future__ import annotations

import shapely

from ..road_pictures import Extent, plan_picture
from ..road_records import JUNCTION
from .area_records import CARRIAGEWAY, CROSSING, ISLAND, LANE, SIDEWALK, UNDIVIDED, SurveyedRoads

FILLS = {CARRIAGEWAY: "#c8c8c8", CROSSING: "#f6c48f", LANE: "#abdcea", SIDEWALK: "#bddcaa", ISLAND: "#6aa55e",
         UNDIVIDED: "#f0f0f0"}
MARGIN = 8.0
"""Around what a picture shows, m."""


def areas_extent(model: SurveyedRoads) -> Extent:
    """Window about all that was surveyed, m."""
    shapes = [area.polygon for area in model.areas if area.kind != UNDIVIDED] or [a.polygon for a in model.areas]
    low_x, low_y, high_x, high_y = shapely.total_bounds(shapes).tolist()
    return low_x - MARGIN, low_y - MARGIN, high_x + MARGIN, high_y + MARGIN


def junction_windows(model: SurveyedRoads) -> list[Extent]:
    """Windows about the junctions, m; those to look at first."""
    pieces = sorted((piece for piece in model.pieces if piece.kind == JUNCTION),
                    key=lambda piece: piece.status == "made")
    return [(a - MARGIN, b - MARGIN, c + MARGIN, d + MARGIN)
            for a, b, c, d in (piece.polygon.bounds for piece in pieces)]


def area_picture(model: SurveyedRoads, extent: Extent, width: int = 760) -> str:
    """Areas by kind, steps and numbered findings within a window."""
    ordered = sorted(model.areas, key=lambda area: area.kind != UNDIVIDED)
    return plan_picture(extent, width, [(area.polygon, FILLS[area.kind], 0.6) for area in ordered],
                        [(step.ring[:, :2], 'stroke="#d7263d" stroke-width="1.6"') for step in model.steps],
                        model.findings)
