"""Streets with their paint, kerbs and pavements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .canvas import SIDE, Canvas, band, box

REACH = 0.72 * SIDE
"""Half the length of a street, m: it leaves the scene on both sides."""


@dataclass(frozen=True)
class Look:
    """How a scene's streets look: tones (3,) and shares."""

    road: np.ndarray
    grain: tuple[float, ...]
    pavement: np.ndarray
    kerb: np.ndarray
    white: np.ndarray
    yellow: np.ndarray
    wear: float
    line: float
    concrete: bool


def street_look(rng: np.random.Generator) -> Look:
    """A look by chance: asphalt old and new or concrete, paint fresh or worn."""
    concrete = rng.random() < 0.2
    grey = rng.uniform(130, 185) if concrete else rng.uniform(55, 135)
    tint = rng.normal(0, 0.02, 3) + np.array([0.01, 0, -0.01]) * rng.uniform(0, 4)
    road = grey * (1 + tint)
    fresh = min(grey * rng.uniform(1.25, 2.6) + 15, 250)
    rough = rng.uniform(0.3, 3.0)
    return Look(road, tuple(rough * np.array([0.04, 0.03, 0.015, 0.02, 0.05])),
                rng.uniform(105, 190) * (1 + rng.normal(0, 0.03, 3) + np.array([0.03, 0, -0.05]) * rng.uniform(0, 2)),
                rng.uniform(1.05, 1.8) * road, fresh * (1 + rng.normal(0, 0.01, 3)),
                fresh * np.array([1.0, rng.uniform(0.72, 0.86), rng.uniform(0.3, 0.6)]),
                rng.choice([0.0, 0.15, 0.35, 0.55], p=[0.4, 0.3, 0.2, 0.1]), rng.uniform(0.1, 0.2), concrete)


@dataclass(frozen=True)
class Street:
    """A street along an axis (0 x, 1 y) at a place across it, with half the width of its carriageway."""

    axis: int
    at: float
    half: float
    pavement: float

    def to_plan(self, along: float | np.ndarray, across: float | np.ndarray) -> np.ndarray:
        """Points in the scene's frame."""
        points = np.stack(np.broadcast_arrays(along, np.add(across, self.at)), axis=-1).astype(float)
        return points if self.axis == 0 else points[..., ::-1] * np.array([-1, 1])

    def ring(self, start: float, end: float, low: float, high: float) -> np.ndarray:
        """Corners of a rectangle along the street."""
        corners = box(start, low, end, high)
        return self.to_plan(corners[:, 0], corners[:, 1])


def lay_street(canvas: Canvas, street: Street, look: Look) -> None:
    """Carriageway, kerbs, pavements, wheel tracks, patches, joints and cracks of a street."""
    rng, half = canvas.rng, street.half
    verge = rng.random() < 0.3
    wide = half + street.pavement
    canvas.fill(street.ring(-REACH, REACH, -wide, wide), look.pavement, (0.04, 0.03, 0.02, 0.03, 0.04))
    if rng.random() < 0.5:
        _joints(canvas, street, look.pavement, half, wide, rng.uniform(0.6, 2.0))
    if verge:
        for sign in (-1, 1):
            canvas.fill(street.ring(-REACH, REACH, *sorted((sign * (half + 0.2), sign * (half + 1.2)))),
                        np.array([75, 92, 55]) * rng.uniform(0.6, 1.3), (0.2, 0.2, 0.15, 0.1, 0.1))
    if rng.random() < 0.8:
        edge = half + rng.uniform(0.1, 0.35)
        canvas.fill(street.ring(-REACH, REACH, -edge, edge), np.minimum(look.kerb, 235), (0.04, 0.04, 0.03, 0.03, 0.03))
    canvas.fill(street.ring(-REACH, REACH, -half, half), look.road, look.grain)
    if rng.random() < 0.25:
        gutter = look.road * rng.uniform(1.1, 1.5)
        for sign in (-1, 1):
            canvas.fill(street.ring(-REACH, REACH, *sorted((sign * half, sign * (half - rng.uniform(0.3, 0.6))))),
                        gutter, look.grain)
    _wear_of_traffic(canvas, street, look)


def _joints(canvas: Canvas, street: Street, tone: np.ndarray, low: float, high: float, step: float) -> None:
    """Joints of paving on both sides, darker or lighter than it."""
    change = canvas.rng.choice([0.7, 0.85, 1.15, 1.3])
    for place in np.arange(-REACH, REACH, step):
        for sign in (-1, 1):
            canvas.line(street.to_plan(np.full(2, place), sign * np.array([low, high])), 0.06, tone * change, 0.8)


def _wear_of_traffic(canvas: Canvas, street: Street, look: Look) -> None:
    rng, half = canvas.rng, street.half
    for lane in np.arange(-half + 1.6, half - 1, 3.2):
        for off in (-0.8, 0.8):
            canvas.line(street.to_plan(np.array([-REACH, REACH]), lane + off), 0.5, look.road * rng.uniform(0.8, 1.3),
                        0.25)
    for _ in range(rng.poisson(8)):
        along, across = rng.uniform(-REACH, REACH), rng.uniform(-half, half - 1)
        length, width = rng.uniform(0.8, 12), rng.uniform(0.5, 3.5)
        canvas.fill(street.ring(along, along + length, across, min(across + width, half)),
                    look.road * rng.uniform(0.6, 1.4), look.grain)
    if look.concrete or rng.random() < 0.15:
        _slabs(canvas, street, look)
    for _ in range(rng.poisson(6)):
        steps = rng.normal(0, 1, (30, 2)).cumsum(axis=0) * 0.4 + np.outer(np.arange(30), rng.normal(0, 0.5, 2))
        points = np.array([rng.uniform(-REACH, REACH), rng.uniform(-half, half)]) + steps
        points = points[np.abs(points[:, 1]) < half]
        if len(points) > 1:
            canvas.line(street.to_plan(*points.T), rng.uniform(0.03, 0.12),
                        look.road * rng.choice([0.4, 0.6, 1.25, 1.4]), 0.8)


def _slabs(canvas: Canvas, street: Street, look: Look) -> None:
    """Joints of slabs, darker or lighter."""
    rng, half = canvas.rng, street.half
    for place in np.arange(-REACH, REACH, rng.uniform(3, 7)):
        canvas.line(street.to_plan(np.full(2, place), np.array([-half, half])), rng.uniform(0.04, 0.15),
                    look.road * rng.choice([0.5, 0.7, 1.2, 1.35]), 0.8)
    for place in np.arange(-half, half, 3.6):
        canvas.line(street.to_plan(np.array([-REACH, REACH]), place), 0.08,
                    look.road * rng.choice([0.5, 0.7, 1.25]), 0.8)


def paint_street(canvas: Canvas, street: Street, look: Look, crossings: list[float]) -> None:
    """Lines, zebra crossings, stop lines, arrows and boxes of a street; none within crossings with other streets."""
    rng, half = canvas.rng, street.half
    free = _free(crossings, rng.uniform(8, 14))
    central = look.yellow if rng.random() < 0.4 else look.white
    if rng.random() < 0.85:
        _lengthwise(canvas, street, free, 0.0, central, look, rng.random() < 0.5)
        if rng.random() < 0.3:
            _lengthwise(canvas, street, free, 0.3, central, look, False)
    for lane in np.arange(rng.uniform(2.8, 3.6), half - 2, rng.uniform(2.8, 3.6)):
        for sign in (-1, 1):
            _lengthwise(canvas, street, free, sign * lane, look.white, look, rng.random() < 0.75)
    if rng.random() < 0.6:
        off = half - rng.choice([0.15, 0.25, 0.4, 0.6, 1.0, 2.2])
        for sign in (-1, 1):
            _lengthwise(canvas, street, free, sign * off, look.white, look, rng.random() < 0.1)
    for start, end in free:
        _crosswise(canvas, street, look, start, 1)
        _crosswise(canvas, street, look, end, -1)
        for _ in range(rng.poisson(1.5)):
            _symbol(canvas, street, look, rng.uniform(start, end), rng.choice([-1, 1]) * rng.uniform(1.2, half))
        if rng.random() < 0.25:
            _stalls(canvas, street, look, start, end)


def _free(crossings: list[float], gap: float) -> list[tuple[float, float]]:
    ends = [-REACH, *(place for at in sorted(crossings) for place in (at - gap, at + gap)), REACH]
    return [(start, end) for start, end in zip(ends[::2], ends[1::2]) if end - start > 6]


def _wear(canvas: Canvas, look: Look) -> float:
    return float(np.clip(look.wear + canvas.rng.normal(0, 0.1), 0, 0.8)) if look.wear else 0.0


def _lengthwise(canvas: Canvas, street: Street, free: list, across: float, tone: np.ndarray, look: Look,
                dashed: bool) -> None:
    rng = canvas.rng
    dash, gap = (rng.choice([1.0, 2.0, 3.0, 5.0, 6.0]), rng.choice([1.0, 2.0, 3.0, 5.0, 9.0])) if dashed else (7.0, 0.0)
    wear = _wear(canvas, look)
    for start, end in free:
        for place in np.arange(start, end - 0.5, dash + gap):
            stop = min(place + dash, end)
            canvas.mark(street.ring(place, stop, across - look.line / 2, across + look.line / 2), tone, wear)


def _crosswise(canvas: Canvas, street: Street, look: Look, at: float, sign: int) -> None:
    rng, half, wear = canvas.rng, street.half, _wear(canvas, look)
    kind = rng.choice(["zebra", "ladder", "lines", "none"], p=[0.35, 0.2, 0.2, 0.25])
    low, high = sorted((at - sign * rng.uniform(3.5, 5.0), at - sign * 1.0))
    if kind in ("zebra", "ladder"):
        bar, gap = rng.uniform(0.3, 0.6), rng.uniform(0.35, 1.6 if kind == "ladder" else 0.7)
        for place in np.arange(-half + 0.3, half - bar, bar + gap):
            canvas.mark(street.ring(low, high, place, place + bar), look.white, wear)
    if kind in ("lines", "ladder"):
        for place in (low, high):
            canvas.mark(street.ring(place, place + rng.uniform(0.2, 0.4), -half + 0.2, half - 0.2), look.white, wear)
    if rng.random() < 0.6:
        span = (0.1, half - 0.3) if sign > 0 else (-half + 0.3, -0.1)
        canvas.mark(street.ring(at + sign * 1.0 - 0.2, at + sign * 1.0 + 0.2, *span), look.white, wear)


def _symbol(canvas: Canvas, street: Street, look: Look, along: float, across: float) -> None:
    """Arrow, letters, diamond or hatching in a lane."""
    rng, wear = canvas.rng, _wear(canvas, look)
    if abs(across) > street.half - 1:
        return
    kind, tone = rng.integers(0, 4), look.yellow if rng.random() < 0.15 else look.white
    if kind == 0:
        canvas.mark(street.ring(along, along + 3, across - 0.08, across + 0.08), tone, wear)
        canvas.mark(street.to_plan(along + np.array([3, 3, 4.6]), across + np.array([-0.4, 0.4, 0])), tone, wear)
    elif kind == 1:
        for _ in range(rng.integers(3, 12)):
            start = np.array([along + rng.uniform(0, 3.5), across + rng.uniform(-0.8, 0.5)])
            end = start + (np.array([rng.uniform(0.4, 1.5), 0]) if rng.random() < 0.5
                           else np.array([0, rng.uniform(0.3, 0.9)]))
            canvas.mark(street.to_plan(*band(start, end, 0.15).T), tone, wear)
    elif kind == 2:
        corners = np.array([(0, 0), (2, -0.7), (4, 0), (2, 0.7), (0, 0)])
        for start, end in zip(corners[:-1], corners[1:]):
            canvas.mark(street.to_plan(*np.add(band(start, end, 0.2), (along, across)).T), tone, wear)
    else:
        for step in np.arange(0, rng.uniform(4, 12), rng.uniform(0.9, 1.6)):
            canvas.mark(street.to_plan(*band((along + step, across - 0.9), (along + step + 1, across + 0.9), 0.3).T),
                        tone, wear)


def _stalls(canvas: Canvas, street: Street, look: Look, start: float, end: float) -> None:
    """Parking bays along a kerb."""
    rng, wear = canvas.rng, _wear(canvas, look)
    outer, inner = street.half - 0.2, street.half - 2.2
    sign = rng.choice([-1, 1])
    for place in np.arange(start + 2, end - 2, 5.5):
        canvas.mark(street.ring(place, place + 0.12, *sorted((sign * inner, sign * outer))), look.white, wear)
