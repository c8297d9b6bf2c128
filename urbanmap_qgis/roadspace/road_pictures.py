"""Pictures of a road model and of its junctions, as SVG."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import shapely

from .road_records import BRIDGE, JUNCTION, ROAD, TUNNEL, RoadFinding, RoadSurfaceModel

FILLS = {ROAD: "#e3e3e3", JUNCTION: "#f6c48f", BRIDGE: "#a9cbe6", TUNNEL: "#c3b3d9"}

Extent = tuple[float, float, float, float]


def model_extent(model: RoadSurfaceModel, margin: float = 10.0) -> Extent:
    """Window (x min, y min, x max, y max) about the whole model, m."""
    low_x, low_y, high_x, high_y = shapely.total_bounds([piece.polygon for piece in model.pieces]).tolist()
    return low_x - margin, low_y - margin, high_x + margin, high_y + margin


def doubtful_extents(model: RoadSurfaceModel, margin: float = 15.0) -> list[Extent]:
    """Windows about the pieces that are to be looked at, m."""
    found = [piece.polygon.bounds for piece in model.pieces if piece.status != "made"]
    return [(a - margin, b - margin, c + margin, d + margin) for a, b, c, d in found]


def road_picture(model: RoadSurfaceModel, extent: Extent, width: int = 760) -> str:
    """Surfaces by kind, middle lines and numbered findings within a window."""
    return plan_picture(
        extent, width, [(piece.polygon, FILLS[piece.kind], 0.8) for piece in model.pieces],
        [(axis.points, 'stroke="#2b4c7e" stroke-width="0.7" stroke-dasharray="5 3"') for axis in model.axes],
        model.findings)


def plan_picture(extent: Extent, width: int, areas: Iterable[tuple[shapely.Polygon, str, float]],
                 lines: Iterable[tuple[np.ndarray, str]], findings: Sequence[RoadFinding]) -> str:
    """What lies within a window, as SVG of a width in pixels.

    Parameters
    ----------
    areas : polygons, each with its fill and the width of its edge, pixels.
    lines : points (n, 2) of each line, m, and its stroke as SVG's attributes.
    findings : numbered in their order, from 1.
    """
    scale = width / (extent[2] - extent[0])
    height = round((extent[3] - extent[1]) * scale)
    window = shapely.box(*extent)

    def path(points: np.ndarray) -> str:
        screen = np.column_stack([(points[:, 0] - extent[0]) * scale, (extent[3] - points[:, 1]) * scale])
        return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in screen)

    parts = [f'<rect width="{width}" height="{height}" fill="#ffffff"/>']
    for polygon, fill, edge in areas:
        if window.intersects(polygon):
            rings = "".join(path(shapely.get_coordinates(ring)) + "Z"
                            for ring in (polygon.exterior, *polygon.interiors))
            parts.append(f'<path d="{rings}" fill="{fill}" fill-rule="evenodd" stroke="#333333" '
                         f'stroke-width="{edge}"/>')
    parts += [f'<path d="{path(points)}" fill="none" {stroke}/>' for points, stroke in lines
              if window.intersects(shapely.linestrings(points))]
    for number, finding in enumerate(findings, 1):
        if extent[0] <= finding.x <= extent[2] and extent[1] <= finding.y <= extent[3]:
            x, y = (finding.x - extent[0]) * scale, (extent[3] - finding.y) * scale
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="8" fill="#d7263d"/><text x="{x:.1f}" '
                         f'y="{y + 3.5:.1f}" font-size="10" text-anchor="middle" fill="#ffffff">{number}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
            f'height="{height}">{"".join(parts)}</svg>')
