"""Pictures of two lane maps and their changes, as SVG."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from .comparison_records import ADDED, MOVED, REMOVED, REPAINTED, MapChange
from .map_elements import LINE, MapElement

COLOURS = {MOVED: "#e09a2b", ADDED: "#1a9850", REMOVED: "#d7263d", REPAINTED: "#4a6fd7"}
MARGIN = 15.0
"""Of pictures about what they show, m."""

Extent = tuple[float, float, float, float]


def whole_map(elements: Sequence[MapElement]) -> Extent:
    """Window (x min, y min, x max, y max) about a map, m."""
    points = np.concatenate([one.points for one in elements])
    (x_min, y_min), (x_max, y_max) = points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN
    return float(x_min), float(y_min), float(x_max), float(y_max)


def change_extents(changes: Sequence[MapChange], most: int = 6) -> list[Extent]:
    """Windows about places with changes, those with the most changes first."""
    places = [shapely.Point(one.middle) for one in changes if len(one.points)]
    areas = [place.buffer(2 * MARGIN) for place in places]
    clusters = [one for one in shapely.get_parts(shapely.union_all(areas)) if not one.is_empty]
    counts = [int(shapely.contains(one, places).sum()) for one in clusters]
    order = sorted(range(len(clusters)), key=lambda k: (-counts[k], clusters[k].bounds))
    return [clusters[k].bounds for k in order[:most]]


def change_picture(old: Sequence[MapElement], new: Sequence[MapElement], changes: Sequence[MapChange],
                   extent: Extent, width: int = 760) -> str:
    """The old map pale, the new one dark, changes in colours with their numbers in the list, within a window."""
    scale = width / (extent[2] - extent[0])
    height = max(round((extent[3] - extent[1]) * scale), 1)
    window = shapely.box(*extent)

    def path(points: np.ndarray) -> str:
        return "M" + "L".join(f"{(x - extent[0]) * scale:.1f} {(extent[3] - y) * scale:.1f}" for x, y in points)

    parts = [f'<rect width="{width}" height="{height}" fill="#ffffff"/>']
    for elements, colour, size in ((old, "#c4c9cf", 2.6), (new, "#444444", 0.8)):
        for one in elements:
            if window.intersects(one.plan):
                dash = ' stroke-dasharray="5 3"' if one.element == LINE and "dashed" in one.kind else ""
                parts.append(f'<path d="{path(one.points)}" fill="none" stroke="{colour}" '
                             f'stroke-width="{size}"{dash}/>')
    for number, change in enumerate(changes):
        if len(change.points) and window.intersects(shapely.linestrings(change.points)):
            colour = COLOURS[change.kind]
            x, y = np.clip(change.middle, extent[:2], extent[2:])
            parts.append(f'<path d="{path(change.points)}" fill="none" stroke="{colour}" stroke-width="3" '
                         'stroke-opacity="0.8"/>'
                         f'<text x="{(x - extent[0]) * scale + 4:.1f}" y="{(extent[3] - y) * scale - 3:.1f}" '
                         f'fill="{colour}">{number + 1}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" role="img" '
            f'font-family="sans-serif" font-size="11">{"".join(parts)}</svg>')
