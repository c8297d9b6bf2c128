"""Pictures of a lane map and of its junctions, as SVG."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ..geometry.tolerances import LEAST_DIVISOR
from .map_records import DrivenPath, VectorMap

FILLS = {"lane": "#f5e9b8", "virtual": "#f6cfcf"}
STROKES = {"white": "#333333", "yellow": "#c98a00", "": "#333333"}
JOIN = 8.0
"""Virtual lanes so near to each other are of one junction, m."""

Extent = tuple[float, float, float, float]


def junction_extents(built: VectorMap, margin: float = 15.0) -> list[Extent]:
    """Windows (x min, y min, x max, y max) about the map's junctions, from west to east."""
    areas = [built.area(number) for number, lane in enumerate(built.lanes) if lane.kind == "virtual"]
    clusters = shapely.get_parts(shapely.union_all([shapely.make_valid(area).buffer(JOIN) for area in areas]))
    return sorted(one.buffer(margin).bounds for one in clusters)


def whole_extent(built: VectorMap, margin: float = 10.0) -> Extent:
    """Window about the whole map."""
    nodes = np.array(built.nodes)[:, :2]
    return (*(nodes.min(axis=0) - margin), *(nodes.max(axis=0) + margin))


def map_picture(built: VectorMap, drives: Sequence[DrivenPath], extent: Extent, width: int = 760) -> str:
    """Lanes with their directions, bounds, stop lines, crosswalks, drives and numbered findings within a window."""
    scale = width / (extent[2] - extent[0])
    height = round((extent[3] - extent[1]) * scale)
    window = shapely.box(*extent)

    def path(points: np.ndarray, closed: bool = False) -> str:
        screen = np.column_stack([(points[:, 0] - extent[0]) * scale, (extent[3] - points[:, 1]) * scale])
        return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in screen) + ("Z" if closed else "")

    parts = [f'<rect width="{width}" height="{height}" fill="#ffffff"/>']
    parts += _lanes(built, window, path)
    parts += [f'<path d="{path(shapely.get_coordinates(walk.polygon.exterior), True)}" fill="none" stroke="#3a8f8f" '
              'stroke-width="1.2"/>' for walk in built.crosswalks if window.intersects(walk.polygon)]
    for bound in built.bounds:
        points = built.bound_points(bound)[:, :2]
        if window.intersects(shapely.LineString(points)):
            dashes = {"dashed": "7 4", "virtual": "2 3"}.get(bound.kind, "")
            parts.append(f'<path d="{path(points)}" fill="none" stroke="{STROKES.get(bound.colour, "#333333")}" '
                         f'stroke-width="{0.8 if bound.kind == "virtual" else 1.6}"'
                         + (f' stroke-dasharray="{dashes}"' if dashes else "") + "/>")
    parts += [f'<path d="{path(stop[:, :2])}" fill="none" stroke="#a0208f" stroke-width="3"/>'
              for stop in built.stop_lines if window.intersects(shapely.LineString(stop[:, :2]))]
    for drive in drives:
        course = shapely.intersection(shapely.LineString(drive.places[:, :2]).simplify(0.1), window)
        parts += [f'<path d="{path(shapely.get_coordinates(part))}" fill="none" stroke="#2f6f8f" stroke-width="0.8" '
                  'stroke-dasharray="1 3"/>' for part in shapely.get_parts(course) if part.geom_type == "LineString"]
    for number, finding in enumerate(built.findings):
        if window.contains(shapely.Point(finding.x, finding.y)):
            x, y = (finding.x - extent[0]) * scale, (extent[3] - finding.y) * scale
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="#d7263d"/>'
                         f'<text x="{x + 6:.1f}" y="{y + 4:.1f}">{number + 1}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" role="img" '
            f'font-family="sans-serif" font-size="11">{"".join(parts)}</svg>')


def _lanes(built: VectorMap, window: shapely.Polygon, path) -> list[str]:
    """Areas of the lanes, and an arrow in the middle of each for its direction."""
    areas = [built.area(number) for number in range(len(built.lanes))]
    shown = [number for number, area in enumerate(areas) if window.intersects(area)]
    parts = [f'<path d="{path(shapely.get_coordinates(areas[number].exterior), True)}" '
             f'fill="{FILLS[built.lanes[number].kind]}"/>' for number in shown]
    for number in shown:
        line = shapely.LineString(built.lanes[number].centre[:, :2])
        tip, tail = (shapely.get_coordinates(line.interpolate(min(line.length / 2.0 + step, line.length)))[0]
                     for step in (1.2, -1.2))
        course = (tip - tail) / max(np.linalg.norm(tip - tail), LEAST_DIVISOR)
        across = 0.7 * np.array([-course[1], course[0]])
        parts.append(f'<path d="{path(np.array([tip, tail + across, tail - across]), True)}" fill="#c23b22"/>')
    return parts
