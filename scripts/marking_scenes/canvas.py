"""A canvas in metres on which surfaces, paint and things are drawn."""

from __future__ import annotations

from collections.abc import Callable
from statistics import NormalDist

import cv2
import numpy as np

SIDE = 72.0
"""Side of a scene, m."""

CELL = 0.07
"""Cells in which it is drawn, m."""

_SHIFT = 5
_SPREAD = 0.93  # standard deviation of what decides where paint is worn off


class Canvas:
    """Colours (rows, columns, 3) float32, where paint is, what light shadows leave, and the frame in which streets run
    along x and y. What draws vehicles waits in `low`, on which shadows fall; what draws roofs and trees in `high`.

    Parameters
    ----------
    rng : for all that is random.
    """

    def __init__(self, rng: np.random.Generator):
        self.rng = rng
        self.size = int(SIDE / CELL)
        self.colour = np.full((self.size, self.size, 3), 110, np.float32)
        self.paint = np.zeros((self.size, self.size), np.float32)
        self.shade = np.ones((self.size, self.size), np.float32)
        self.low: list[Callable[[], None]] = []
        self.high: list[Callable[[], None]] = []
        angle = rng.uniform(0, 2 * np.pi)
        self._turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        self.noise = [self.field(size) for size in (CELL, 0.14, 0.3, 1.0, 4.0)]

    def field(self, size: float) -> np.ndarray:
        """Smooth random field with spots of so many metres, standard deviation 1."""
        side = max(int(SIDE / size) + 3, 4)
        small = self.rng.standard_normal((min(side, self.size),) * 2, np.float32)
        made = cv2.resize(small, (self.size, self.size), interpolation=cv2.INTER_CUBIC)
        return made / made.std()

    def pixels(self, points: np.ndarray) -> np.ndarray:
        """Places in cells (columns, rows) of points in the streets' frame, whose origin is the middle."""
        return (np.asarray(points, float) @ self._turn.T + SIDE / 2) / CELL - 0.5

    def area(self, *rings: np.ndarray) -> tuple[tuple[slice, slice], np.ndarray]:
        """Rows and columns round polygons, and what share of each cell there they cover."""
        placed = [self.pixels(ring) for ring in rings]
        points = np.concatenate(placed)
        low = np.maximum(np.floor(points.min(axis=0)).astype(int) - 1, 0)
        high = np.minimum(np.ceil(points.max(axis=0)).astype(int) + 2, self.size)
        high = np.maximum(high, low)
        place = slice(low[1], high[1]), slice(low[0], high[0])
        cover = np.zeros((high[1] - low[1], high[0] - low[0]), np.uint8)
        if cover.size:
            for ring in placed:
                cv2.fillPoly(cover, [np.rint((ring - low) * 2 ** _SHIFT).astype(np.int32)], 255, cv2.LINE_AA, _SHIFT)
        return place, cover.astype(np.float32) / 255

    def fill(self, ring: np.ndarray, tone: np.ndarray, grain: tuple[float, ...] = ()) -> None:
        """Lay a surface of a tone whose brightness varies by shares `grain`, one for each of the noise fields."""
        place, cover = self.area(ring)
        self.lay(place, cover, tone, grain)

    def lay(self, place: tuple[slice, slice], cover: np.ndarray, tone: np.ndarray, grain: tuple[float, ...] = ()
            ) -> None:
        """Lay a surface where cells are covered; paint below it vanishes."""
        if not cover.size:
            return
        factor = np.ones(cover.shape, np.float32)
        for share, noise in zip(grain, self.noise):
            if share:
                factor += share * noise[place]
        layer = np.maximum(factor, 0.1)[..., None] * np.float32(tone)
        self.colour[place] += cover[..., None] * (layer - self.colour[place])
        self.paint[place] *= 1 - cover

    def line(self, points: np.ndarray, width: float, tone: np.ndarray, share: float = 1.0) -> None:
        """Draw a line of a width in m over what lies there, paint or not."""
        for start, end in zip(points[:-1], points[1:]):
            place, cover = self.area(band(start, end, width))
            if cover.size:
                self.colour[place] += share * cover[..., None] * (np.float32(tone) - self.colour[place])

    def mark(self, ring: np.ndarray, tone: np.ndarray, wear: float = 0.0, true: bool = True) -> None:
        """Paint a polygon; the share `wear` of it is worn off."""
        place, cover = self.area(ring)
        if not cover.size:
            return
        if wear > 0:
            noise = 0.5 * self.noise[1][place] + 0.6 * self.noise[2][place] + 0.5 * self.noise[3][place]
            cover = cover * np.clip(2 * noise - 2 * _SPREAD * NormalDist().inv_cdf(wear) + 0.5, 0, 1)
        self.colour[place] += cover[..., None] * (np.float32(tone) - self.colour[place])
        if true:
            self.paint[place] = np.maximum(self.paint[place], cover)

    def shadow(self, ring: np.ndarray, toward: np.ndarray, depth: float) -> None:
        """Darken what the shadow of a polygon reaches, that is moved by `toward`."""
        steps = np.linspace(0, 1, 4)
        parts = [ring + step * toward for step in steps]
        hull = cv2.convexHull(np.concatenate(parts).astype(np.float32))[:, 0]
        place, cover = self.area(hull)
        if cover.size:
            self.shade[place] = np.minimum(self.shade[place], 1 - depth * cover)


def band(start: np.ndarray, end: np.ndarray, width: float) -> np.ndarray:
    """Corners (4, 2) of a straight stroke."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    along = (end - start) / max(float(np.hypot(*(end - start))), 1e-9)
    side = 0.5 * width * np.array([-along[1], along[0]])
    return np.array([start - side, end - side, end + side, start + side])


def box(left: float, low: float, right: float, high: float) -> np.ndarray:
    """Corners (4, 2) of a rectangle."""
    return np.array([(left, low), (right, low), (right, high), (left, high)])


def turned(ring: np.ndarray, angle: float, at: np.ndarray) -> np.ndarray:
    """A polygon round the origin, turned (radians) and moved."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return ring @ turn.T + at
