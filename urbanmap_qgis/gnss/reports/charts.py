"""Drawings of the GNSS reports as SVG: the sky, measured against predicted, a plan of walls."""

from __future__ import annotations

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_FACE
from ...io.pages.svg import agreement, dots, drawing
from ...wording import say
from ..rays.reflections import LOS, REFLECTED, SignalPaths
from ..rays.wall_faces import WallPieces
from ..signals.tables import Signals
from ..walls.adjustment import WallResult

_MOST = 4000
"""Points drawn at most."""

_GREEN, _ORANGE, _GREY, _BLUE, _RED = "#1a9850", "#e08a1e", "#999999", "#2166ac", "#b2182b"


def sky_plot(signals: Signals, paths: SignalPaths, size: int = 460) -> str:
    """Where the satellites were, coloured by the path of their signals; grid north up, the zenith in the middle."""
    middle, radius = size / 2, size / 2 - 26
    rows = _some(len(signals))
    away = radius * (90.0 - signals.elevation[rows]) / 90.0
    angle = np.radians(signals.azimuth[rows])
    x, y = middle + away * np.sin(angle), middle - away * np.cos(angle)
    colour = np.select([paths.kind[rows] == LOS, paths.kind[rows] == REFLECTED], [_GREEN, _ORANGE], _GREY)
    rings = "".join(f'<circle cx="{middle}" cy="{middle}" r="{radius * share:.1f}" fill="none" stroke="#ccc"/>'
                    for share in (1 / 3, 2 / 3, 1.0))
    names = "".join(f'<text x="{middle + (radius + 14) * dx:.0f}" y="{middle - (radius + 14) * dy + 4:.0f}" '
                    f'text-anchor="middle">{name}</text>' for name, dx, dy in (
                        ("N", 0, 1), ("E", 1, 0), ("S", 0, -1), ("W", -1, 0)))
    return drawing(size, size, rings + names + dots(x, y, colour, 1.6))


def scatter(predicted: np.ndarray, measured: np.ndarray, sure: np.ndarray) -> str:
    """Measured against predicted excess path, m, with the line on which they are equal."""
    high = float(np.ceil(max(np.quantile(predicted, 0.99), 30.0) / 10.0) * 10.0 + 20.0)
    rows = _some(len(predicted))
    return agreement(predicted[rows], measured[rows], (-10.0, high), np.where(sure[rows], _BLUE, "#a6bddb"),
                     say("measured, m"))


def wall_map(shapes: np.ndarray, before: WallPieces, after: WallPieces, walls: WallResult, width: int = 900) -> str:
    """Plan of buildings with the walls that were adjusted or observed; moves are drawn three times as large."""
    shown = walls.observations > 0
    corners = np.concatenate([before.start[shown[before.wall]], before.end[shown[before.wall]]]) if shown.any() else (
        np.concatenate([before.start, before.end]))
    (x_min, y_min), (x_max, y_max) = corners.min(axis=0) - 15.0, corners.max(axis=0) + 15.0
    scale = width / max(x_max - x_min, 1.0)
    height = (y_max - y_min) * scale

    def to_picture(xy: np.ndarray) -> np.ndarray:
        return np.column_stack([(xy[:, 0] - x_min) * scale, (y_max - xy[:, 1]) * scale])

    parts = [_outline(shape, to_picture) for shape in shapes if shape is not None]
    moved = walls.is_moved
    for piece in np.flatnonzero(shown[before.wall]):
        wall = before.wall[piece]
        old = np.stack([before.start[piece], before.end[piece]])
        if not moved[wall]:
            parts.append(_stroke(to_picture(old), _ORANGE, 2.0))
            continue
        new = old + 3.0 * (np.stack([after.start[piece], after.end[piece]]) - old)
        parts.append(_stroke(to_picture(old), "#333", 1.0, "4 3"))
        parts.append(_stroke(to_picture(new), _RED if walls.offset[wall] > 0 else _BLUE, 2.5))
    table = walls.table
    for wall in np.flatnonzero(moved):
        at = (table.start[wall] + table.end[wall]) / 2 + table.normal[wall] * (14.0 / scale + 3.0)
        x, y = to_picture(at[None])[0]
        parts.append(f'<text x="{x:.0f}" y="{y + 4:.0f}" text-anchor="middle" stroke="#fff" stroke-width="3" '
                     f'paint-order="stroke">{100 * walls.offset[wall]:+.0f}</text>')
    length = 50 if 50 * scale < width / 3 else 10
    parts.append(f'<path d="M{width - 10 - length * scale:.0f} {height - 10:.0f}H{width - 10}" stroke="#333" '
                 f'stroke-width="3"/><text x="{width - 14 - length * scale:.0f}" y="{height - 6:.0f}" '
                 f'text-anchor="end">{length} m {say("(moves: {third:.1f} m)", third=length / 3)}</text>')
    return drawing(width, int(height), "".join(parts))


def _outline(shape: shapely.Geometry, place) -> str:
    flat = shapely.get_parts(shapely.force_2d(shape))
    rings = [ring for part in flat[shapely.area(flat) > LEAST_FACE] for ring in (part.exterior, *part.interiors)]
    path = "".join("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in place(shapely.get_coordinates(ring))) + "Z"
                   for ring in rings)
    return f'<path d="{path}" fill="#e4e4e4" fill-rule="evenodd" stroke="#bbb" stroke-width="0.5"/>'


def _stroke(line: np.ndarray, colour: str, width: float, dashes: str = "") -> str:
    (x0, y0), (x1, y1) = line
    dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
    return f'<path d="M{x0:.1f} {y0:.1f}L{x1:.1f} {y1:.1f}" stroke="{colour}" stroke-width="{width}"{dashed}/>'


def _some(count: int) -> np.ndarray:
    """Rows to draw: all, or evenly picked ones."""
    return np.unique(np.linspace(0, count - 1, min(count, _MOST)).astype(np.int64))
