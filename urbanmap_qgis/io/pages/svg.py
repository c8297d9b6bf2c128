"""Small charts and maps as SVG, for reports."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence

import numpy as np
import shapely

from ...wording import known, say

RAMP = ("#1a9850", "#91cf60", "#fee08b", "#fc8d59", "#d73027")
"""Colours from good to bad."""

UNKNOWN = "#bbbbbb"


def drawing(width: int, height: int, content: str, letters: float = 11) -> str:
    """SVG of a size in pixels; `letters`: height of its texts."""
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" role="img" '
            f'font-family="sans-serif" font-size="{letters:g}">{content}</svg>')


def bars(counts: np.ndarray, edges: np.ndarray, label: str, width: int = 460, height: int = 200) -> str:
    """An SVG bar chart with a labelled axis, `width` by `height` pixels."""
    left, bottom = 46, 40
    plot_width, plot_height = width - left - 10, height - bottom - 12
    tallest = max(int(counts.max()), 1)
    step = plot_width / len(counts)
    bars = "".join(
        f'<rect x="{left + i * step + 0.5:.1f}" y="{12 + plot_height * (1 - count / tallest):.1f}" '
        f'width="{max(step - 1, 1):.1f}" height="{plot_height * count / tallest:.1f}" fill="#2f6f8f"/>'
        for i, count in enumerate(counts.tolist()))
    low, high = float(edges[0]), float(edges[-1])
    ticks = "".join(
        f'<text x="{left + (value - low) / (high - low) * plot_width:.0f}" y="{height - bottom + 16}" '
        f'text-anchor="middle">{value:g}</text>' for value in round_values(low, high))
    return drawing(width, height, f'{bars}<path d="M{left} {height - bottom}H{width - 10}" stroke="#444"/>'
                   f'{ticks}<text x="{left - 6}" y="20" text-anchor="end">{tallest}</text>'
                   f'<text x="{left - 6}" y="{height - bottom}" text-anchor="end">0</text>'
                   f'<text x="{left + plot_width / 2:.0f}" y="{height - 6}" text-anchor="middle">'
                   f"{html.escape(known(label))}</text>")


def agreement(predicted: np.ndarray, observed: np.ndarray, span: tuple[float, float], colour: np.ndarray,
              label: str) -> str:
    """Values (n,), m, against their predictions within a span, coloured, with the line on which they are equal."""
    size, left, foot, (low, high) = 460, 52.0, 420.0, span
    scale = (size - left - 12) / (high - low)
    ticks = "".join(f'<text x="{left + (v - low) * scale:.0f}" y="{foot + 16:.0f}" text-anchor="middle">{v:g}</text>'
                    f'<text x="{left - 6:.0f}" y="{foot - (v - low) * scale + 4:.0f}" text-anchor="end">{v:g}</text>'
                    for v in round_values(low, high))
    axes = (f'<path d="M{left:.0f} 12V{foot:.0f}H{size - 10}" stroke="#444" fill="none"/>'
            f'<path d="M{left:.0f} {foot:.0f}L{size - 12} {left + 12 + foot - size:.0f}" stroke="#999"/>')
    words = (f'<text x="{size / 2:.0f}" y="{size - 6}" text-anchor="middle">{say("predicted, m")}</text>'
             f'<text x="12" y="{size / 2:.0f}" text-anchor="middle" transform="rotate(-90 12 {size / 2:.0f})">'
             f'{label}</text>')
    return drawing(size, size, axes + ticks + dots(left + (predicted - low) * scale, foot - (
        np.clip(observed, low, high) - low) * scale, colour, 2.0) + words)


def dots(x: np.ndarray, y: np.ndarray, colour: np.ndarray, radius: float) -> str:
    """Points (n,) of a radius, pixels, one path a colour."""
    return "".join(
        f'<path d="{"".join(f"M{a:.1f} {b:.1f}h.1" for a, b in zip(x[colour == one], y[colour == one]))}" '
        f'stroke="{one}" stroke-width="{2 * radius}" stroke-linecap="round"/>' for one in np.unique(colour))


def round_values(low: float, high: float) -> list[float]:
    """Round values between two limits, about five."""
    raw = (high - low) / 5
    power = 10.0 ** np.floor(np.log10(raw))
    step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= raw)
    return [float(np.round(k * step, 10)) for k in range(int(np.ceil(low / step)), int(np.floor(high / step)) + 1)]


def plan_map(polygons: Sequence[shapely.Geometry | None], values: np.ndarray, limits: Sequence[float], unit: str,
             labels: Mapping[int, str], width: int = 900) -> str:
    """An SVG map of polygons, coloured by the class of their value, with a legend, a scale bar and labels.

    Parameters
    ----------
    polygons : (n,) in plan, m; missing ones are left out.
    values : (n,), NaN is drawn grey.
    limits : the four values between the five classes, from good to bad.
    labels : texts to write on polygons, by row.
    """
    shapes = np.array(polygons, dtype=object)
    present = np.flatnonzero(~shapely.is_missing(shapes))
    x_min, y_min, x_max, y_max = shapely.total_bounds(shapes[present])
    scale = (width - 20) / max(x_max - x_min, (y_max - y_min) * 1.2, 1.0)
    height = int((y_max - y_min) * scale) + 60
    tolerance = 0.5 / scale

    def to_picture(xy: np.ndarray) -> np.ndarray:
        return np.column_stack([10 + (xy[:, 0] - x_min) * scale, 10 + (y_max - xy[:, 1]) * scale])

    classes = np.digitize(values, limits)
    parts = [f'<path d="{_path(shapely.simplify(shapes[row], tolerance), to_picture)}" fill-rule="evenodd" '
             f'fill="{RAMP[classes[row]] if np.isfinite(values[row]) else UNKNOWN}" stroke="#333" stroke-width="0.5"/>'
             for row in present]
    for row, text in labels.items():
        if shapes[row] is not None:
            x, y = to_picture(shapely.get_coordinates(shapely.point_on_surface(shapes[row])))[0]
            parts.append(f'<text x="{x:.1f}" y="{y + 4:.1f}" text-anchor="middle" font-weight="bold" stroke="#fff" '
                         f'stroke-width="3" paint-order="stroke">{html.escape(text)}</text>')
    parts.append(_legend(limits, unit, height - 30))
    parts.append(scale_bar(scale, width, height - 14))
    return drawing(width, height, "".join(parts))


def _path(shape: shapely.Geometry, place) -> str:
    """SVG path of a polygon or multipolygon, holes included."""
    rings = [ring for part in shapely.get_parts(shape) for ring in (part.exterior, *part.interiors)]
    return "".join("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in place(shapely.get_coordinates(ring))) + "Z"
                   for ring in rings)


def _legend(limits: Sequence[float], unit: str, y: int) -> str:
    """Coloured squares with the classes' limits."""
    names = [f"< {limits[0]:g}", *(f"{a:g} – {b:g}" for a, b in zip(limits, limits[1:])), f"> {limits[-1]:g} {unit}",
             say("not known")]
    return "".join(f'<rect x="{10 + 92 * i}" y="{y}" width="12" height="12" fill="{colour}" stroke="#333" '
                   f'stroke-width="0.5"/><text x="{26 + 92 * i}" y="{y + 10}">{html.escape(name)}</text>'
                   for i, (colour, name) in enumerate(zip((*RAMP, UNKNOWN), names)))


def scale_bar(scale: float, width: int, y: int) -> str:
    """A bar of a round length, at most a quarter of the map's width."""
    longest = width / 4 / scale
    power = 10.0 ** np.floor(np.log10(longest))
    length = max(step * power for step in (1, 2, 5) if step * power <= longest)
    return (f'<path d="M{width - 10 - length * scale:.1f} {y}H{width - 10}" stroke="#333" stroke-width="3"/>'
            f'<text x="{width - 14 - length * scale:.1f}" y="{y + 4}" text-anchor="end">{length:g} m</text>')
