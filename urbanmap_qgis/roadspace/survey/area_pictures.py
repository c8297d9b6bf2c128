"""Pictures of a surveyed road model and of its junctions, as SVG."""

from __future__ import annotations

import numpy as np
import shapely

from ..road_pictures import Extent
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
    scale = width / (extent[2] - extent[0])
    height = round((extent[3] - extent[1]) * scale)
    window = shapely.box(*extent)

    def path(points: np.ndarray) -> str:
        screen = np.column_stack([(points[:, 0] - extent[0]) * scale, (extent[3] - points[:, 1]) * scale])
        return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in screen)

    parts = [f'<rect width="{width}" height="{height}" fill="#ffffff"/>']
    for area in sorted(model.areas, key=lambda area: area.kind != UNDIVIDED):
        if window.intersects(area.polygon):
            rings = "".join(path(shapely.get_coordinates(ring)) + "Z"
                            for ring in (area.polygon.exterior, *area.polygon.interiors))
            parts.append(f'<path d="{rings}" fill="{FILLS[area.kind]}" fill-rule="evenodd" stroke="#333333" '
                         'stroke-width="0.6"/>')
    parts += [f'<path d="{path(step.ring[:, :2])}" fill="none" stroke="#d7263d" stroke-width="1.6"/>'
              for step in model.steps if window.intersects(shapely.linestrings(step.ring[:, :2]))]
    for number, finding in enumerate(model.findings, 1):
        if extent[0] <= finding.x <= extent[2] and extent[1] <= finding.y <= extent[3]:
            x, y = (finding.x - extent[0]) * scale, (extent[3] - finding.y) * scale
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="8" fill="#d7263d"/><text x="{x:.1f}" '
                         f'y="{y + 3.5:.1f}" font-size="10" text-anchor="middle" fill="#ffffff">{number}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
            f'height="{height}">{"".join(parts)}</svg>')
