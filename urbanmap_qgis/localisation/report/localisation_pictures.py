"""Drawings of the report on localisation accuracy as SVG: plans with ellipses to scale, predicted against observed."""

from __future__ import annotations

import numpy as np

from ...io.pages.svg import agreement, drawing
from ...wording import say
from ..accuracy_records import AccuracyMap, LocalisationMap
from ..places.place_status import GOOD, NONE, POOR, USABLE

COLOUR_OF_CLASS = {GOOD: "#1a9850", USABLE: "#e0b03a", POOR: "#d73027", NONE: "#8c8c8c"}
_MOST_SEGMENTS = 6000


def accuracy_plan(city: LocalisationMap, accuracy: AccuracyMap, rows: np.ndarray, enlarged: float, width: int = 900,
                  around: float = 20.0) -> str:
    """Plan of walls and markings with the places in `rows` and their error ellipses, `enlarged` times.

    `around` : m drawn beyond the places.
    """
    xy = accuracy.places.place[rows, :2]
    low, high = xy.min(axis=0) - around, xy.max(axis=0) + around
    scale = min(width / (high[0] - low[0]), 0.7 * width / (high[1] - low[1]))
    size = (high - low) * scale

    def to_picture(points: np.ndarray) -> np.ndarray:
        return np.column_stack([(points[:, 0] - low[0]) * scale, (high[1] - points[:, 1]) * scale])

    parts = [_markings(city, to_picture, low, high), _walls(city, to_picture, low, high)]
    for row, (x, y) in zip(rows, to_picture(xy)):
        colour = COLOUR_OF_CLASS[accuracy.kind[row]]
        major, minor = enlarged * accuracy.ellipse.major[row] * scale, enlarged * accuracy.ellipse.minor[row] * scale
        if np.isfinite(major):
            parts.append(f'<ellipse cx="{x:.1f}" cy="{y:.1f}" rx="{minor:.1f}" ry="{major:.1f}" fill="{colour}" '
                         f'fill-opacity="0.3" stroke="{colour}" transform="rotate({accuracy.ellipse.bearing[row]:.0f} '
                         f'{x:.1f} {y:.1f})"/>')
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.6" fill="{colour}"/>')
    return drawing(round(size[0]), round(size[1]), f'<rect width="100%" height="100%" fill="#fafafa"/>{"".join(parts)}')


def agreement_plot(predicted: np.ndarray, observed: np.ndarray) -> str:
    """Observed against predicted root mean square errors, m, with the line on which they are equal."""
    top = float(max(np.quantile(observed, 0.97), predicted.max(), 0.05)) * 1.1
    return agreement(predicted, observed, (0.0, top), np.full(len(predicted), "#2166ac"), say("observed, m"))


def _walls(city: LocalisationMap, at, low: np.ndarray, high: np.ndarray) -> str:
    if city.walls is None:
        return ""
    walls = city.walls.walls
    near = ((np.maximum(walls.start, walls.end) > low) & (np.minimum(walls.start, walls.end) < high)).all(axis=1)
    rows = np.flatnonzero(near)[:_MOST_SEGMENTS]
    lines = "".join(f"M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}"
                    for a, b in zip(at(walls.start[rows]), at(walls.end[rows])))
    return f'<path d="{lines}" stroke="#333" stroke-width="1.4" fill="none"/>'


def _markings(city: LocalisationMap, at, low: np.ndarray, high: np.ndarray) -> str:
    if city.markings is None:
        return ""
    xy = city.markings.xy
    rows = np.flatnonzero(((xy > low) & (xy < high)).all(axis=1))
    half = (0.25 * np.column_stack([-city.markings.normal[rows, 1], city.markings.normal[rows, 0]])
            * np.minimum(city.markings.length[rows] / 0.5, 1.0)[:, None])
    lines = "".join(f"M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}"
                    for a, b in zip(at(xy[rows] - half), at(xy[rows] + half)))
    return f'<path d="{lines}" stroke="#b8b03a" stroke-width="1" fill="none"/>'
