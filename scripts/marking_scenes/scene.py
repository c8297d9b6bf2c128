"""A whole made-up scene, and the image that a camera takes of it."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from .canvas import CELL, SIDE, Canvas
from .streets import Street, lay_street, paint_street, street_look
from .things import draw_vehicle, draw_wire, grow_tree, lay_lot

PIXELS = (0.08, 0.2)
"""Sides of pixels, m."""


@dataclass(frozen=True)
class MadeScene:
    """An image (rows, columns, 3) uint8 with pixels of a side in m, and the share of paint in each pixel (float32)."""

    image: np.ndarray
    pixel: float
    paint: np.ndarray


def make_marking_scene(seed: int) -> MadeScene:
    """A scene of a seed."""
    rng = np.random.default_rng(seed)
    canvas = Canvas(rng)
    look = street_look(rng)
    bearing, length = rng.uniform(0, 2 * np.pi), rng.uniform(0.3, 1.6)
    sun = length * np.array([np.cos(bearing), np.sin(bearing)]), rng.choice([0.0, 0.25, 0.55, 0.75, 0.85])
    streets = _streets(rng)
    _lay_lots(canvas, streets, look, sun)
    for street in streets:
        lay_street(canvas, street, look)
    for street in streets:
        paint_street(canvas, street, look, [-other.at if street.axis == 0 else other.at
                                            for other in streets if other.axis != street.axis])
        _traffic(canvas, street, sun)
    for _ in range(rng.poisson(25)):
        grow_tree(canvas, rng.uniform(-SIDE / 2, SIDE / 2, 2) * 1.3, sun)
    for draw in canvas.low:
        draw()
    dark = 1 - canvas.shade[..., None]
    canvas.colour *= 1 - dark + dark * np.float32([-0.03, 0.0, 0.06])
    for draw in canvas.high:
        draw()
    for _ in range(rng.poisson(3)):
        draw_wire(canvas)
    return _photographed(canvas)


def _streets(rng: np.random.Generator) -> list[Street]:
    made = []
    for axis in (0, 1):
        at = rng.uniform(-30, -5)
        for _ in range(rng.integers(1 if axis == 0 else 0, 3)):
            half = rng.choice([2.8, 3.5, 5.0, 7.0, 9.5, 12.0])
            made.append(Street(axis, at, half, rng.uniform(0, 4)))
            at += half + rng.uniform(25, 40)
    return made


def _lay_lots(canvas: Canvas, streets: list[Street], look, sun) -> None:
    """Lots on a grid whose lines avoid the streets."""
    rng = canvas.rng
    cuts = []
    for axis in (1, 0):  # cuts along x lie at streets of axis 1, whose plan x is - at
        places = [(-s.at if axis else s.at, s.half + s.pavement) for s in streets if s.axis == axis]
        lines, largest = [-0.72 * SIDE], rng.choice([28, 28, 50])
        while lines[-1] < 0.72 * SIDE:
            lines.append(lines[-1] + rng.uniform(10, largest))
        cuts.append(sorted([*lines, *(at + sign * wide for at, wide in places for sign in (-1, 1))]))
    for left, right in zip(cuts[0][:-1], cuts[0][1:]):
        for low, high in zip(cuts[1][:-1], cuts[1][1:]):
            if right - left > 3 and high - low > 3 and not _on_street((left + right) / 2, (low + high) / 2, streets):
                lay_lot(canvas, np.array([left, low, right, high]), look, sun)


def _on_street(x: float, y: float, streets: list[Street]) -> bool:
    return any(abs((y if s.axis == 0 else -x) - s.at) < s.half + s.pavement for s in streets)


def _traffic(canvas: Canvas, street: Street, sun) -> None:
    rng = canvas.rng
    for _ in range(rng.poisson(rng.choice([2, 8, 16]))):
        across = rng.uniform(-street.half + 1, street.half - 1)
        place = street.to_plan(rng.uniform(-50, 50), across)
        angle = (0 if street.axis == 0 else np.pi / 2) + rng.normal(0, 0.03)
        canvas.low.append(lambda place=place, angle=angle: draw_vehicle(canvas, place, angle, sun))
    if rng.random() < 0.35:
        _parked(canvas, street, sun)


def _parked(canvas: Canvas, street: Street, sun) -> None:
    """Rows of vehicles along both kerbs."""
    rng = canvas.rng
    for sign in (-1, 1):
        for at in np.arange(-50, 50, 5.8):
            if rng.random() < 0.6:
                place = street.to_plan(at, sign * (street.half - rng.uniform(1.0, 1.4)))
                angle = 0 if street.axis == 0 else np.pi / 2
                canvas.low.append(lambda place=place, angle=angle: draw_vehicle(canvas, place, angle, sun))


def _photographed(canvas: Canvas) -> MadeScene:
    """What a camera of any kind makes of a scene."""
    rng = canvas.rng
    pixel = float(np.exp(rng.uniform(*np.log(PIXELS))))
    size = int(SIDE / pixel)
    blur = rng.uniform(0.25, 0.9) * pixel / CELL
    image = cv2.GaussianBlur(canvas.colour, (0, 0), blur)
    image = cv2.resize(image, (size, size), interpolation=cv2.INTER_AREA)
    paint = cv2.resize(cv2.GaussianBlur(canvas.paint, (0, 0), blur), (size, size), interpolation=cv2.INTER_AREA)
    image = 255 * np.clip(image / 255, 0, None) ** rng.uniform(0.7, 1.4)
    image *= rng.uniform(0.7, 1.25) * (1 + rng.normal(0, 0.04, 3)).astype(np.float32)
    image += rng.uniform(0, 1) ** 2 * rng.uniform(0, 60) * np.float32([0.95, 1, 1.06])
    image += rng.standard_normal(image.shape, np.float32) * rng.choice([0.5, 1.5, 3, 6])
    image += rng.standard_normal(image.shape[:2], np.float32)[..., None] * rng.choice([0.0, 1.5, 4, 8])
    if rng.random() < 0.55:
        soft = cv2.GaussianBlur(image, (0, 0), rng.uniform(0.8, 2))
        image += rng.uniform(0.3, 2.0) * (image - soft)
    if rng.random() < 0.06:
        image = np.repeat(image.mean(axis=2, keepdims=True), 3, axis=2)
    image = np.clip(np.rint(image), 0, 255).astype(np.uint8)
    if rng.random() < 0.7:
        quality = [cv2.IMWRITE_JPEG_QUALITY, int(rng.integers(50, 96))]
        coded = cv2.imencode(".jpg", image[..., ::-1], quality)[1]
        image = cv2.imdecode(coded, cv2.IMREAD_COLOR)[..., ::-1]
    return MadeScene(np.ascontiguousarray(image), pixel, paint)
