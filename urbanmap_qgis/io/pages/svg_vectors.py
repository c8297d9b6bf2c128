"""Maps of vectors at points as SVG, for reports: errors drawn larger than the map, with their scale."""

from __future__ import annotations

import html
import unicodedata
from collections.abc import Sequence

import numpy as np

from ...wording import say
from .svg import drawing, scale_bar

_LONGEST = 60.0  # pixels of the vector that the scale is chosen by
_MARGIN, _SCALES = _LONGEST + 14, 30  # pixels around the points, and for the scale bars below
_LETTER, _LINE, _BESIDE = 11.0, 12.0, 5.0  # pixels: height of letters, of their lines, from a point to its name
_GOOD, _BAD = "#2f6f8f", "#d7263d"


def vector_map(places: np.ndarray, vectors: np.ndarray, names: Sequence[str], limit: float | None = None,
               width: int = 720, height: int | None = None) -> str:
    """An SVG map of points with a vector each, north up, with scale bars of the map and of the vectors.

    Parameters
    ----------
    places : (n, 2) m.
    vectors : (n, 2) m.
    names : (n,) written beside the points where there is room.
    limit : vectors longer than this, m, are red; None: all alike.
    width, height : of the drawing, pixels; the map is as large as it can be in it. By default as high as the places ask
        for, up to a square.
    """
    height = height or round(width * min(vector_map_shape(places, width), 1.0))
    lowest, highest = places.min(axis=0), places.max(axis=0)
    room = np.array([width - 2 * _MARGIN, height - 2 * _MARGIN - _SCALES])
    scale = float((room / np.maximum(highest - lowest, 1.0)).min())
    middle = (lowest + highest) / 2
    pixels = (places - middle) * (scale, -scale) + (width / 2, (height - _SCALES) / 2)
    lengths = np.hypot(*vectors.T)
    typical = float(np.quantile(lengths, 0.9)) or 0.01
    magnified = _LONGEST / 1.5 / max(typical, 1e-6)
    parts = _coordinate_lines(middle, scale, width, height)
    parts += [_arrow(start, vector * (magnified, -magnified), _BAD if limit is not None and length > limit else _GOOD)
             for start, vector, length in zip(pixels, vectors, lengths)]
    parts += [f'<text x="{left:.1f}" y="{pixels[row, 1] - 5:.1f}" fill="#444">{html.escape(names[row])}</text>'
              for row, left in _places_of_names(pixels, names, width).items()]
    parts.append(scale_bar(scale, width, height - 12))
    if lengths.any():
        parts.append(_vector_scale(typical, magnified, height - 12))
    return drawing(width, height, f'<rect width="{width}" height="{height}" fill="#fbfbf9" stroke="#ccc"/>'
                   f'{"".join(parts)}', _LETTER)


def vector_map_shape(places: np.ndarray, width: int = 720) -> float:
    """Height by width of a map of places (n, 2), m, that is `width` pixels wide and leaves no empty bands; 0.75 where
    none is known."""
    known = places[np.isfinite(places).all(axis=1)]
    if not len(known):
        return 0.75
    east, north = np.maximum(known.max(axis=0) - known.min(axis=0), 1.0)
    return float(((width - 2 * _MARGIN) * north / east + 2 * _MARGIN + _SCALES) / width)


def _coordinate_lines(middle: np.ndarray, scale: float, width: int, height: int) -> list[str]:
    """Lines of round coordinates, about 150 pixels apart, with their values at the upper and the left edge."""
    step = 10.0 ** np.floor(np.log10(150 / scale))
    step *= max(factor for factor in (1, 2, 5) if factor * step <= 150 / scale)
    below = height - _SCALES
    parts = []
    for axis, (size, half) in enumerate(((width, width / 2), (below, below / 2))):
        first = np.ceil((middle[axis] - half / scale) / step)
        for value in (first + np.arange(int(size / (step * scale)) + 1)) * step:
            at = half + (value - middle[axis]) * scale * (1 if axis == 0 else -1)
            line = f"M{at:.1f} 1V{below}" if axis == 0 else f"M1 {at:.1f}H{width - 1}"
            place = f'x="{at + 3:.1f}" y="11"' if axis == 0 else f'x="3" y="{at - 3:.1f}"'
            if 45 < at < size - 30:
                parts.append(f'<path d="{line}" stroke="#ddd"/><text {place} fill="#999">{value:.10g}</text>')
    return parts


def _arrow(start: np.ndarray, vector: np.ndarray, colour: str) -> str:
    """A point and a line from it with a head; the line ends at five times the typical length."""
    length = float(np.hypot(*vector))
    if length > 5 * _LONGEST:
        vector = vector * (5 * _LONGEST / length)
    x, y = start
    ex, ey = start + vector
    head = ""
    if length > 4:
        along = vector / np.hypot(*vector)
        across = np.array([-along[1], along[0]])
        corners = [(ex, ey), *((ex, ey) - 6 * along + side * 3 * across for side in (1, -1))]
        head = f'<path d="M{"L".join(f"{a:.1f} {b:.1f}" for a, b in corners)}Z" fill="{colour}"/>'
    return (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.2" fill="#222"/>'
            f'<path d="M{x:.1f} {y:.1f}L{ex:.1f} {ey:.1f}" stroke="{colour}" stroke-width="1.6"/>{head}')


def _places_of_names(pixels: np.ndarray, names: Sequence[str], width: int) -> dict[int, float]:
    """Where the names begin that have room, by row, pixels: right of their point, else left of it, on the drawing and
    clear of the names of points before them."""
    shown: dict[int, tuple[float, float]] = {}
    for row, (x, y) in enumerate(pixels):
        length = _length_of(names[row])
        for left in (x + _BESIDE, x - _BESIDE - length):
            if 0 <= left <= width - length and all(
                    abs(y - pixels[other, 1]) > _LINE or left > end or left + length < begin
                    for other, (begin, end) in shown.items()):
                shown[row] = (left, left + length)
                break
    return {row: begin for row, (begin, _) in shown.items()}


def _length_of(text: str) -> float:
    """About how long a text is, pixels: letters of East Asian scripts are as wide as high."""
    return sum(_LETTER if unicodedata.east_asian_width(letter) in "WFA" else 0.62 * _LETTER for letter in text)


def _vector_scale(typical: float, magnified: float, y: int) -> str:
    """A vector of a round length with its length in centimetres."""
    power = 10.0 ** np.floor(np.log10(typical))
    length = max(step * power for step in (1, 2, 5) if step * power <= typical * 1.0001)
    end = 12 + length * magnified
    text = html.escape(say("error {length:g} cm", length=round(100 * length, 6)))
    return (f'<path d="M12 {y}H{end:.1f}" stroke="{_GOOD}" stroke-width="3"/>'
            f'<text x="{end + 6:.1f}" y="{y + 4}">{text}</text>')
