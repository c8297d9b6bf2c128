"""Lots beside streets and what stands on them: roofs, gardens, car parks, water, vehicles, trees, wires."""

from __future__ import annotations

import numpy as np

from .canvas import SIDE, Canvas, band, box, turned
from .streets import Look

GREEN = np.array([78, 98, 58], float)
ROUGH = (0.16, 0.18, 0.16, 0.12, 0.1)


def lay_lot(canvas: Canvas, lot: np.ndarray, look: Look, sun: tuple[np.ndarray, float]) -> None:
    """Fill a lot (left, low, right, high) with something."""
    kind = canvas.rng.choice(["roof", "roof", "roof", "garden", "cars", "bare", "water", "paved", "rails", "beds"],
                             p=[0.2, 0.15, 0.15, 0.13, 0.15, 0.08, 0.04, 0.05, 0.02, 0.03])
    {"roof": _roof, "garden": _garden, "cars": _car_park, "bare": _bare, "water": _water, "paved": _paved,
     "rails": _rails, "beds": _beds}[kind](canvas, lot, look, sun)


def _inner(rng: np.random.Generator, lot: np.ndarray, most: float) -> np.ndarray:
    left, low, right, high = lot
    off = rng.uniform(0.3, most, 4)
    return np.array([left + off[0], low + off[1], right - off[2], high - off[3]])


def _tone(rng: np.random.Generator, low: float, high: float, tint: float = 0.03) -> np.ndarray:
    return rng.uniform(low, high) * (1 + rng.normal(0, tint, 3))


def _roof(canvas: Canvas, lot: np.ndarray, look: Look, sun: tuple[np.ndarray, float]) -> None:
    """A building: flat with parapet and plant, ribbed metal, tiles in two slopes, or with solar panels; its wall may
    lean into the image."""
    rng = canvas.rng
    canvas.fill(box(*lot), rng.choice([GREEN, look.pavement, look.road]) * rng.uniform(0.7, 1.2), ROUGH)
    left, low, right, high = _inner(rng, lot, 4.0)
    if right - left < 4 or high - low < 4:
        return
    height = rng.uniform(3, 18)
    canvas.shadow(box(left, low, right, high), sun[0] * height, sun[1])
    canvas.high.append(lambda: _draw_roof(canvas, (left, low, right, high), height))


def _draw_roof(canvas: Canvas, place: tuple, height: float) -> None:
    rng = canvas.rng
    left, low, right, high = place
    if rng.random() < 0.5:
        lean = rng.normal(0, 0.12 * height, 2)
        _facade(canvas, box(*place), lean)
        left, right, low, high = left + lean[0], right + lean[0], low + lean[1], high + lean[1]
    tone = _tone(rng, 40, 235)
    kind = rng.choice(["flat", "ribs", "gable", "solar", "sheds"])
    canvas.fill(box(left, low, right, high), tone,
                tuple(rng.uniform(0, 2.5) * np.array([0.05, 0.04, 0.03, 0.05, 0.08])))
    if kind == "flat":
        rim = np.array([(left, low), (right, low), (right, high), (left, high), (left, low)])
        canvas.line(rim, rng.uniform(0.1, 0.5), np.minimum(tone * rng.uniform(0.6, 2.2), 250))
        _plant(canvas, left, low, right, high, tone)
    elif kind == "ribs":
        step = rng.uniform(0.3, 1.5)
        for at in np.arange(left, right, step):
            canvas.line(np.array([(at, low), (at, high)]), rng.uniform(0.06, 0.25),
                        np.minimum(tone * rng.choice([0.6, 0.8, 1.25, 1.6]), 250), 0.8)
    elif kind == "gable":
        middle = (left + right) / 2
        canvas.fill(box(middle, low, right, high), tone * rng.uniform(0.5, 1.6), (0.06, 0.05, 0.03, 0.02, 0.03))
        canvas.line(np.array([(middle, low), (middle, high)]), rng.uniform(0.1, 0.35), np.minimum(tone * 1.5, 250))
        for at in np.arange(low, high, rng.uniform(0.3, 0.6)):
            canvas.line(np.array([(left, at), (right, at)]), 0.06, tone * rng.uniform(0.7, 1.3), 0.5)
    elif kind == "solar":
        _panels(canvas, left, low, right, high)
    else:
        for at in np.arange(low, high, rng.uniform(3, 6)):
            canvas.fill(box(left, at, right, min(at + 1.2, high)), np.minimum(tone * rng.uniform(1.3, 2), 250))


def _facade(canvas: Canvas, foot: np.ndarray, lean: np.ndarray) -> None:
    """Walls between the foot and the moved roof, with rows of windows."""
    rng, tone = canvas.rng, _tone(canvas.rng, 70, 220)
    for start, end in zip(foot, np.roll(foot, -1, axis=0)):
        canvas.fill(np.array([start, end, end + lean, start + lean]), tone * rng.uniform(0.5, 1.1))
        for level in np.linspace(0.1, 0.9, max(int(np.hypot(*lean) / 0.5), 1)):
            canvas.line(np.array([start + level * lean, end + level * lean]), rng.uniform(0.08, 0.25),
                        np.minimum(tone * rng.choice([0.4, 1.4]), 250), 0.8)


def _plant(canvas: Canvas, left: float, low: float, right: float, high: float, tone: np.ndarray) -> None:
    rng = canvas.rng
    for _ in range(rng.poisson(8)):
        at = np.array([rng.uniform(left, right - 1), rng.uniform(low, high - 1)])
        size = rng.uniform(0.3, 2.5, 2)
        end = np.minimum(at + size, (right, high))
        canvas.fill(box(*(at + 0.4), *(end + 0.4)), tone * 0.45)
        canvas.fill(box(*at, *end), _tone(rng, 90, 245))
    for _ in range(rng.poisson(3)):
        start = np.array([rng.uniform(left, right), rng.uniform(low, high)])
        end = np.array([rng.uniform(left, right), start[1]]) if rng.random() < 0.5 else np.array(
            [start[0], rng.uniform(low, high)])
        canvas.line(np.array([start, end]), rng.uniform(0.08, 0.3), np.minimum(tone * rng.uniform(0.5, 2), 250))


def _panels(canvas: Canvas, left: float, low: float, right: float, high: float) -> None:
    rng = canvas.rng
    dark = np.array([45, 55, 80]) * rng.uniform(0.6, 1.4)
    for x in np.arange(left + 0.8, right - 1.8, 1.05):
        for y in np.arange(low + 0.8, high - 2.4, 1.7):
            canvas.fill(box(x, y, x + 0.98, y + 1.62), dark)
            canvas.line(np.array([(x, y + 0.8), (x + 0.98, y + 0.8)]), 0.06, dark * 2.2, 0.6)


def _garden(canvas: Canvas, lot: np.ndarray, look: Look, sun: tuple[np.ndarray, float]) -> None:
    """Grass with light paths, walls, furniture and beds."""
    rng = canvas.rng
    canvas.fill(box(*lot), GREEN * rng.uniform(0.6, 1.5) * (1 + rng.normal(0, 0.08, 3)),
                tuple(rng.uniform(0.3, 1.4) * np.array(ROUGH)))
    left, low, right, high = lot
    for _ in range(rng.poisson(3)):
        points = np.column_stack([rng.uniform(left, right, 3), rng.uniform(low, high, 3)])
        canvas.line(points, rng.uniform(0.2, 1.6), _tone(rng, 120, 220))
    for _ in range(rng.poisson(8)):
        at = np.array([rng.uniform(left, right), rng.uniform(low, high)])
        canvas.fill(turned(box(-1, -0.3, 1, 0.3) * rng.uniform(0.3, 1.2), rng.uniform(0, 3), at), _tone(rng, 60, 240))
    if rng.random() < 0.5:
        rim = np.array([(left, low), (right, low), (right, high), (left, high), (left, low)])
        canvas.line(rim, rng.uniform(0.08, 0.3), _tone(rng, 110, 230))


def _car_park(canvas: Canvas, lot: np.ndarray, look: Look, sun: tuple[np.ndarray, float]) -> None:
    """Asphalt with painted bays and vehicles in some."""
    rng = canvas.rng
    left, low, right, high = lot
    canvas.fill(box(*lot), look.road * rng.uniform(0.7, 1.3), look.grain)
    painted, wear = rng.random() < 0.75, max(look.wear + rng.normal(0, 0.1), 0)
    tone = look.yellow if rng.random() < 0.2 else look.white
    double, joined, slant = rng.random() < 0.25, rng.random() < 0.35, rng.choice([0.0, 0.0, 1.5])
    for row in np.arange(low + 0.8, high - 5.5, rng.uniform(10.5, 13)):
        stop = left + 0.8
        for at in np.arange(left + 0.8, right - 2.4 - slant, 2.5 + 0.4 * double):
            for off in (0, 0.4)[:1 + double] if painted else ():
                canvas.mark(band((at + off, row), (at + off + slant, row + 5), 0.12), tone, wear)
            if rng.random() < 0.45:
                place = np.array([at + 1.3 + slant / 2, row + 2.5])
                canvas.low.append(lambda place=place: draw_vehicle(canvas, place, np.pi / 2 - slant / 5, sun))
            elif painted and rng.random() < 0.06:
                for step in np.arange(0.4, 4, 0.7):
                    canvas.mark(band((at, row + step), (at + 2.4, row + step + 0.8), 0.12), tone, wear)
            stop = at + 2.5
        if painted and joined:
            canvas.mark(box(left + 0.8, row - 0.06, stop, row + 0.06), tone, wear)
    if rng.random() < 0.4:
        canvas.line(np.array([(left, low), (right, low), (right, high), (left, high), (left, low)]), 0.15,
                    _tone(rng, 120, 220))


def _bare(canvas: Canvas, lot: np.ndarray, look: Look, sun: tuple[np.ndarray, float]) -> None:
    """Earth, gravel or rubble with light lumps and heaps."""
    rng = canvas.rng
    canvas.fill(box(*lot), _tone(rng, 90, 185) * np.array([1.08, 1, 0.85]),
                tuple(rng.uniform(0.2, 1.3) * np.array([0.14, 0.14, 0.1, 0.1, 0.12])))
    left, low, right, high = lot
    for _ in range(rng.poisson(30)):
        at = np.array([rng.uniform(left, right), rng.uniform(low, high)])
        canvas.fill(turned(box(-0.6, -0.15, 0.6, 0.15) * rng.uniform(0.3, 2.5), rng.uniform(0, 3), at),
                    _tone(rng, 80, 240))


def _water(canvas: Canvas, lot: np.ndarray, look: Look, sun: tuple[np.ndarray, float]) -> None:
    """Smooth dark water with reeds, ripples and a light bank."""
    rng = canvas.rng
    canvas.fill(box(*lot), _tone(rng, 30, 95, 0.1), (0.01, 0.01, 0.01, 0.02, 0.06))
    left, low, right, high = lot
    canvas.line(np.array([(left, low), (right, low), (right, high), (left, high), (left, low)]), rng.uniform(0.2, 0.8),
                _tone(rng, 100, 200))
    for _ in range(rng.poisson(60)):
        at = np.array([rng.choice([left, right, rng.uniform(left, right)]), rng.uniform(low, high)])
        angle, length = rng.normal(1.2, 0.5), rng.uniform(0.3, 2)
        end = at + length * np.array([np.cos(angle), np.sin(angle)])
        canvas.line(np.array([at, end]), rng.uniform(0.06, 0.2), np.array([150, 145, 105]) * rng.uniform(0.6, 1.3), 0.8)


def _paved(canvas: Canvas, lot: np.ndarray, look: Look, sun: tuple[np.ndarray, float]) -> None:
    """A place with slabs and lighter or darker bands."""
    rng, tone = canvas.rng, look.pavement * canvas.rng.uniform(0.7, 1.2)
    canvas.fill(box(*lot), tone, (0.04, 0.04, 0.03, 0.03, 0.04))
    left, low, right, high = lot
    step, change = rng.uniform(0.8, 5), rng.choice([0.7, 0.85, 1.2, 1.4])
    for at in np.arange(left, right, step):
        canvas.line(np.array([(at, low), (at, high)]), rng.uniform(0.06, 0.5), np.minimum(tone * change, 250), 0.8)
    for at in np.arange(low, high, step):
        canvas.line(np.array([(left, at), (right, at)]), rng.uniform(0.06, 0.3), np.minimum(tone * change, 250), 0.8)


def _rails(canvas: Canvas, lot: np.ndarray, look: Look, sun: tuple[np.ndarray, float]) -> None:
    rng = canvas.rng
    canvas.fill(box(*lot), _tone(rng, 80, 150) * np.array([1.05, 1, 0.92]), (0.12, 0.12, 0.08, 0.05, 0.05))
    left, low, right, high = lot
    for track in np.arange(left + 2, right - 2, 4.5):
        for at in np.arange(low, high, 0.6):
            canvas.line(np.array([(track - 0.5, at), (track + 1.9, at)]), 0.22, _tone(rng, 60, 130), 0.7)
        for off in (0, 1.435):
            canvas.line(np.array([(track + off, low), (track + off, high)]), 0.12, _tone(rng, 140, 240))


def _beds(canvas: Canvas, lot: np.ndarray, look: Look, sun: tuple[np.ndarray, float]) -> None:
    """Fields in rows: crops, plastic sheets, earth."""
    rng = canvas.rng
    canvas.fill(box(*lot), np.array([120, 105, 80]) * rng.uniform(0.6, 1.3), ROUGH)
    left, low, right, high = lot
    tone = GREEN * rng.uniform(0.7, 1.4) if rng.random() < 0.6 else _tone(rng, 150, 235)
    for at in np.arange(left, right, rng.uniform(0.6, 1.6)):
        canvas.line(np.array([(at, low), (at, high)]), rng.uniform(0.2, 0.7), tone, 0.9)


def draw_vehicle(canvas: Canvas, at: np.ndarray, angle: float, sun: tuple[np.ndarray, float]) -> None:
    """A car, van or lorry: body with light rims, dark windows, its shadow."""
    rng = canvas.rng
    long = rng.random() < 0.12
    length, width = (rng.uniform(6, 12), 2.5) if long else (rng.uniform(3.8, 5), rng.uniform(1.65, 1.95))
    body = turned(box(-length / 2, -width / 2, length / 2, width / 2), angle, at)
    tone = _tone(rng, 20, 110, 0.1) if rng.random() < 0.5 else _tone(rng, 140, 250, 0.03)
    if rng.random() < 0.15:
        tone = np.array([rng.uniform(90, 180), 30, 35])[rng.permutation(3)]
    place, cover = canvas.area(body + sun[0] * rng.uniform(1.2, 2.5))
    canvas.lay(place, cover * sun[1], canvas.colour[place].mean(axis=(0, 1)) * 0.3 if cover.size else tone)
    canvas.fill(body, tone)
    light = np.minimum(tone * rng.uniform(1.1, 2.2) + 25, 252)
    closed = np.concatenate([body, body[:1]])
    for side in rng.permutation(4)[:rng.integers(1, 4)]:
        canvas.line(closed[side:side + 2], rng.uniform(0.06, 0.25), light, 0.9)
    if not long:
        for low, high in ((0.08, 0.24), (-0.38, -0.24)):
            canvas.fill(turned(box(low * length, -0.42 * width, high * length, 0.42 * width), angle, at),
                        _tone(rng, 20, 90))
        canvas.fill(turned(box(-0.2 * length, -0.36 * width, 0.05 * length, 0.36 * width), angle, at),
                    np.minimum(tone * rng.uniform(0.9, 1.4), 252))


def grow_tree(canvas: Canvas, at: np.ndarray, sun: tuple[np.ndarray, float]) -> None:
    """A crown of leaves with its shadow, light towards the sun, or bare branches; not to be seen through."""
    rng, radius = canvas.rng, canvas.rng.uniform(1, 5)
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    ring = at + (radius * (1 + 0.15 * rng.normal(size=24)))[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    bare = rng.random() < 0.12
    canvas.shadow(ring, sun[0] * radius * 1.5, sun[1] * (0.3 if bare else 0.9))
    canvas.high.append(lambda: _draw_branches(canvas, at, radius) if bare else _draw_leaves(canvas, ring, at, sun))


def _draw_branches(canvas: Canvas, at: np.ndarray, radius: float) -> None:
    rng = canvas.rng
    for angle in rng.uniform(0, 6.3, 25):
        end = at + radius * rng.uniform(0.4, 1) * np.array([np.cos(angle), np.sin(angle)])
        canvas.line(np.array([at, end]), 0.08, _tone(rng, 60, 180), 0.7)


def _draw_leaves(canvas: Canvas, ring: np.ndarray, at: np.ndarray, sun: tuple[np.ndarray, float]) -> None:
    rng = canvas.rng
    tone = np.array([70, 92, 50]) * rng.uniform(0.4, 1.5) * (1 + rng.normal(0, 0.1, 3))
    if rng.random() < 0.15:
        tone = np.array([150, 120, 70]) * rng.uniform(0.6, 1.2)
    grain = tuple(rng.uniform(0.6, 1.8) * np.array([0.12, 0.22, 0.3, 0.2, 0.05]))
    canvas.fill(ring, tone * (1 - 0.6 * sun[1]), grain)
    canvas.fill(at + 0.75 * (ring - at) - 0.25 * sun[0] / max(np.hypot(*sun[0]), 0.1), tone, grain)


def draw_wire(canvas: Canvas) -> None:
    """An overhead wire or pole across everything."""
    rng = canvas.rng
    start = rng.uniform(-SIDE / 2, SIDE / 2, 2)
    angle = rng.uniform(0, np.pi)
    end = start + rng.uniform(5, 80) * np.array([np.cos(angle), np.sin(angle)])
    place, cover = canvas.area(band(start, end, rng.uniform(0.06, 0.15)))
    canvas.lay(place, cover * 0.7, _tone(rng, 30, 220))
