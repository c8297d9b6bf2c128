"""Profiles over distance or time as SVG, for reports: curves, bands and shaded intervals."""

from __future__ import annotations

import html
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR
from ...wording import known
from .svg import drawing, round_values

COLOURS = ("#2f6f8f", "#d7263d", "#3a9d5d", "#8a5fb0", "#e09a2b")

_MOST_POINTS = 1200
_MARGIN = (52, 14, 12, 40)  # left, right, top, bottom


@dataclass(frozen=True)
class Series:
    """One curve: values (n,) over the profile's x, NaN where there is none; `dots` draws points instead of a line."""

    name: str
    values: np.ndarray
    colour: str = COLOURS[0]
    dots: bool = False


@dataclass(frozen=True)
class ShadedInterval:
    """A shaded part of the profile, from x `start` to `end`."""

    start: float
    end: float
    colour: str
    name: str


def profile(x: np.ndarray, series: Sequence[Series], x_label: str, y_label: str,
            band: tuple[np.ndarray, np.ndarray] | None = None, intervals: Sequence[ShadedInterval] = (),
            width: int = 900, height: int = 240) -> str:
    """An SVG chart of curves over x (n,), with intervals behind them and a shaded band: a curve and its sigma."""
    left, right, top, bottom = _MARGIN
    x = np.asarray(x, float)
    x_low, x_high = float(x.min()), max(float(x.max()), float(x.min()) + LEAST_DIVISOR)
    edges = [] if band is None else [band[0] - band[1], band[0] + band[1]]
    y_low, y_high = _limits([item.values for item in series] + edges)

    def to_picture(x_values, y_values):
        return (left + (np.asarray(x_values) - x_low) / (x_high - x_low) * (width - left - right),
                height - bottom - (np.asarray(y_values) - y_low) / (y_high - y_low) * (height - top - bottom))

    parts = [_shaded_interval(item, to_picture, (x_low, x_high), (y_low, y_high)) for item in intervals]
    keep = _thinned(len(x))
    if edges:
        parts.append(_band(x[keep], edges[0][keep], edges[1][keep], to_picture))
    parts += [_curve(x, item, to_picture, keep) for item in series]
    parts.append(_axes(to_picture, (x_low, x_high), (y_low, y_high), width, height, x_label, y_label))
    parts.append(_legend(series, intervals, height))
    return drawing(width, height + 22, "".join(parts))


def _limits(values: list[np.ndarray]) -> tuple[float, float]:
    """Lowest and highest finite value, with 0 among them and a little room."""
    finite = np.concatenate([np.asarray(item, float).ravel() for item in values] or [np.zeros(1)])
    finite = finite[np.isfinite(finite)]
    low, high = (min(float(finite.min()), 0.0), max(float(finite.max()), 0.0)) if len(finite) else (0.0, 1.0)
    room = 0.05 * max(high - low, 1e-6)
    return (low - room if low < 0 else low), high + room


def _thinned(count: int) -> np.ndarray:
    return np.unique(np.linspace(0, count - 1, min(count, _MOST_POINTS)).astype(int))


def _curve(x: np.ndarray, item: Series, place, keep: np.ndarray) -> str:
    values = np.asarray(item.values, float)
    if item.dots:
        shown = np.flatnonzero(np.isfinite(values))
        shown = shown[_thinned(len(shown))] if len(shown) else shown
        places = np.column_stack(place(x[shown], values[shown]))
        return "".join(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="1.8" fill="{item.colour}"/>' for a, b in places)
    places = np.column_stack(place(x[keep], values[keep]))
    pieces, drawing = [], False
    for a, b in places:
        if np.isfinite(b):
            pieces.append(f"{'L' if drawing else 'M'}{a:.1f} {b:.1f}")
        drawing = bool(np.isfinite(b))
    return f'<path d="{"".join(pieces)}" fill="none" stroke="{item.colour}" stroke-width="1.5"/>'


def _band(x: np.ndarray, low: np.ndarray, high: np.ndarray, place) -> str:
    known = np.isfinite(low) & np.isfinite(high)
    if not known.any():
        return ""
    upper, back = (np.column_stack(place(x[known], side[known])) for side in (high, low))
    corners = " ".join(f"{a:.1f},{b:.1f}" for a, b in np.vstack([upper, back[::-1]]))
    return f'<polygon points="{corners}" fill="#9ec5d8" fill-opacity="0.5"/>'


def _shaded_interval(item: ShadedInterval, place, x_span: tuple[float, float], y_span: tuple[float, float]) -> str:
    (start, end), (bottom, top) = place(np.clip([item.start, item.end], *x_span), y_span)
    return (f'<rect x="{start:.1f}" y="{top:.1f}" width="{max(end - start, 1):.1f}" height="{bottom - top:.1f}" '
            f'fill="{item.colour}" fill-opacity="0.25"/>')


def _axes(place, x_span, y_span, width: int, height: int, x_label: str, y_label: str) -> str:
    left, right, top, bottom = _MARGIN
    parts = [f'<path d="M{left} {top}V{height - bottom}H{width - right}" fill="none" stroke="#444"/>']
    for value in round_values(*x_span):
        x = place(value, 0.0)[0]
        parts.append(f'<text x="{x:.0f}" y="{height - bottom + 14}" text-anchor="middle">{value:g}</text>')
    for value in round_values(*y_span):
        y = place(x_span[0], value)[1]
        parts.append(f'<path d="M{left} {y:.1f}H{width - right}" stroke="#ddd"/>'
                     f'<text x="{left - 5}" y="{y + 4:.1f}" text-anchor="end">{value:g}</text>')
    middle = (top + height - bottom) / 2
    parts.append(f'<text x="{(left + width - right) / 2:.0f}" y="{height - bottom + 30}" text-anchor="middle">'
                 f'{html.escape(known(x_label))}</text><text x="12" y="{middle:.0f}" text-anchor="middle" '
                 f'transform="rotate(-90 12 {middle:.0f})">{html.escape(known(y_label))}</text>')
    return "".join(parts)


def _legend(series: Sequence[Series], intervals: Sequence[ShadedInterval], height: int) -> str:
    named = {item.name: (item.colour, 1.0) for item in series}
    named.update({item.name: (item.colour, 0.4) for item in intervals})
    parts, x = [], _MARGIN[0]
    for word, (colour, opacity) in named.items():
        name = known(word)
        parts.append(f'<rect x="{x}" y="{height + 4}" width="12" height="12" fill="{colour}" '
                     f'fill-opacity="{opacity}"/><text x="{x + 16}" y="{height + 14}">{html.escape(name)}</text>')
        x += 30 + 7 * len(name)
    return "".join(parts)
