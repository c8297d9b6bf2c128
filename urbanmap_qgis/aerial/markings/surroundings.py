"""Figures of what surrounds bright narrow places, by which a trained model tells paint from what looks like it.

The ground is summed up on cells of about a third of a metre, from whole numbers: sums of these are exact, and so the
figures do not depend on where a tile begins. Lengths are in m, brightness is relative to the image's own road.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from .image_strips import STRIP, row_strips
from .marking_confidence import GroundBeside
from .road_model import RoadModel


@dataclass(frozen=True)
class SurroundingsLimits:
    """Limits of surroundings, each with its unit."""

    cell: float = 0.36  # m
    steepest: int = 60  # grey values a pixel, that gradients are cut at
    coarsest: float = 4.0  # times the road's own: figures are cut there
    sides: tuple[float, ...] = (0.8, 1.5, 2.6)  # m to either side of a stroke
    along: tuple[float, ...] = (2.0, 3.5, 5.0, 7.0, 9.0, 11.0, 14.0)  # m before and behind
    spacings: tuple[float, ...] = (2.2, 2.7, 3.2, 3.7, 4.2)  # m at which neighbouring lines lie
    bars: tuple[float, ...] = (0.8, 1.0, 1.2)  # m at which bars of crossings do
    turned: float = 40.0  # degrees, directions in which lines are looked for to compare
    dark: float = 0.55  # times the road's brightness
    light: float = 1.4
    road_light: tuple[float, float] = 0.45, 1.8  # times it: ground that can be a road
    road_warmth: float = 0.13  # shares of the brightness, off the road's colour
    road_green: float = 0.08
    road_reach: float = 10.0  # m round a cell that its share of such ground is told in


LIMITS = SurroundingsLimits()

REACH = 16.0
"""m round a cell that its figures are told by."""

_BOXES = (1.1, 2.6, 6.0, 14.0)
"""Half sides of boxes, m."""

_SHADES = 200.0


def cell_pixels(pixel: float) -> int:
    """Pixels along the side of a cell."""
    return max(round(LIMITS.cell / pixel), 1)


@dataclass(frozen=True)
class Cells:
    """Sums over the pixels of cells; all (rows, columns) float32 of whole numbers.

    Attributes
    ----------
    size : pixels along a side.
    clear, smooth, narrow : pixels of clear ground; of smooth ground; of bright narrow things.
    light : sum of the clear ground's brightness.
    red, green, blue : of its colours; None for grey images.
    rough : sum of the clear ground's squared steps of brightness.
    xx, yy, xy : sums of products of the brightness' gradients.
    """

    size: int
    clear: np.ndarray
    smooth: np.ndarray
    narrow: np.ndarray
    light: np.ndarray
    rough: np.ndarray
    xx: np.ndarray
    yy: np.ndarray
    xy: np.ndarray
    red: np.ndarray | None = None
    green: np.ndarray | None = None
    blue: np.ndarray | None = None


def sums_over(values: np.ndarray, size: int) -> np.ndarray:
    """Sums (whole numbers, float32) over square cells of an image, beginning with its first pixel."""
    rows, columns = (-(-side // size) for side in values.shape)
    below, right = rows * size - values.shape[0], columns * size - values.shape[1]
    if below or right:
        values = cv2.copyMakeBorder(values, 0, below, 0, right, cv2.BORDER_REPLICATE)
    means = cv2.resize(values.astype(np.float32, copy=False), (columns, rows), interpolation=cv2.INTER_AREA)
    return np.rint(means * np.float32(size * size))


def cells_of(bands: np.ndarray, image: np.ndarray, narrow: np.ndarray, ground: GroundBeside, pixel: float,
             scale: float) -> Cells:
    """Sums over cells of a piece of image.

    Parameters
    ----------
    bands : (1 or 3 and more, rows, columns), red, green, blue first.
    image : levelled brightness.
    narrow : bool, bright narrow pixels.
    ground : round them.
    pixel : side, m.
    scale : levelled grey values in one of the bands' steps.
    """
    size = cell_pixels(pixel)
    names = ["clear", "smooth", "narrow", "light", "rough", "xx", "yy", "xy"]
    names += ["red", "green", "blue"] if len(bands) >= 3 else []
    shape = tuple(-(-side // size) for side in image.shape)
    sums = {name: np.empty(shape, np.float32) for name in names}
    for strip, wide, inner in row_strips(len(image), 1, max(STRIP // size, 1) * size):
        clear = ground.clear[strip].astype(np.float32)
        whole = np.rint(image[wide])
        np.minimum(np.maximum(whole, np.float32(-500), out=whole), np.float32(1000), out=whole)
        across, down = (_steps(whole, kernel)[inner] for kernel in (_ACROSS, _ACROSS.T))
        xy = across * down
        across *= across
        down *= down
        values = {"clear": clear, "smooth": ground.smooth[strip], "narrow": narrow[strip].view(np.uint8),
                  "light": whole[inner] * clear, "rough": (across + down) * clear, "xx": across, "yy": down, "xy": xy}
        for name, band in zip(names[8:], bands):
            values[name] = band[strip].astype(np.float32)
            values[name] *= np.float32(scale)
            np.rint(values[name], out=values[name])
            values[name] *= clear
        place = slice(strip.start // size, -(-strip.stop // size))
        for name in names:
            sums[name][place] = sums_over(values[name], size)
    return Cells(size, **sums)


def road_share(places: np.ndarray, bands: np.ndarray, image: np.ndarray, ground: GroundBeside, model: RoadModel,
               pixel: float, scale: float) -> np.ndarray:
    """Share (n,) of the surroundings of places in the flat image that can be a road: smooth, and about as bright and of
    the colour as the image's own road; paint and what else hides little of such ground counts as it.

    Parameters as in `cells_of`.
    """
    size, wide = cell_pixels(pixel), image.shape[1]
    parts = []
    for strip, _, _ in row_strips(len(image), 0, max(STRIP // size, 1) * size):
        clear, colours = ground.clear[strip], bands[:3, strip] if len(bands) >= 3 else ()
        values = (clear, ground.smooth[strip], np.rint(image[strip]) * clear,
                  *(np.rint(band * np.float32(scale)) * clear for band in colours))
        parts.append([sums_over(value, size) for value in values])
    clear, smooth, light, *colours = (np.concatenate(sums) for sums in zip(*parts))
    some = np.maximum(clear, 1)
    light /= some * max(model.brightness, 1.0)
    like = (smooth > some / 2) & (light > LIMITS.road_light[0]) & (light < LIMITS.road_light[1])
    if colours:
        red, green, blue = colours
        value = np.maximum((red + green + blue) / 3, 1)
        like &= np.abs((red - blue) / value - model.warmth) < LIMITS.road_warmth
        like &= np.abs((green - (red + blue) / 2) / value - model.green) < LIMITS.road_green
    beside = cv2.boxFilter(like.view(np.uint8), cv2.CV_32F, (3, 3), normalize=False, borderType=cv2.BORDER_REPLICATE)
    like |= (clear < 0.3 * size ** 2) & (beside > 2)
    closed = cv2.morphologyEx(cv2.medianBlur(like.view(np.uint8), 3), cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
    side = 2 * round(LIMITS.road_reach / (size * pixel)) + 1
    total = cv2.boxFilter(closed, cv2.CV_32F, (side, side), normalize=False, borderType=cv2.BORDER_REPLICATE)
    rows, columns = np.divmod(places, wide)
    return total[rows // size, columns // size] / side ** 2


_ACROSS = np.float32([[-1, 0, 1]])


def _steps(whole: np.ndarray, kernel: np.ndarray) -> np.ndarray:
    """Gradients of whole grey values along a kernel, cut at the steepest."""
    steps = cv2.filter2D(whole, cv2.CV_32F, kernel, borderType=cv2.BORDER_REPLICATE)
    steepest = np.float32(LIMITS.steepest)
    return np.minimum(np.maximum(steps, -steepest, out=steps), steepest, out=steps)


class _Around:
    """Means of cells over boxes."""

    def __init__(self, cells: Cells, pixel: float):
        self._cells, self._side = cells, cells.size * pixel
        self._whole = cells.size ** 2

    def total(self, values: np.ndarray, half: float) -> np.ndarray:
        """Sums over boxes of so many metres to each side, (rows, columns) float64."""
        side = 2 * max(round(half / self._side), 1) + 1
        return cv2.boxFilter(values, cv2.CV_64F, (side, side), normalize=False, borderType=cv2.BORDER_REPLICATE)

    def pixels(self, half: float) -> float:
        """Pixels in such a box."""
        side = 2 * max(round(half / self._side), 1) + 1
        return side * side * self._whole


def figures_at(rows: np.ndarray, columns: np.ndarray, cells: Cells, model: RoadModel, pixel: float,
               threshold: float) -> dict[str, np.ndarray]:
    """Figures (n,) by name of cells at rows and columns."""
    around = _Around(cells, pixel)
    flat = rows * cells.clear.shape[1] + columns
    figures = _of_ground(flat, cells, around, model)
    figures |= _of_edges(flat, cells, around)
    across, down, firm = _across(flat, cells, around)
    figures["firm"] = firm
    figures |= _of_sides(rows, columns, across, down, cells, around, model, pixel, threshold)
    figures |= _of_lines(rows, columns, across, down, cells, around, pixel)
    return figures


def _of_ground(flat: np.ndarray, cells: Cells, around: _Around, model: RoadModel) -> dict[str, np.ndarray]:
    """Shares, brightness, colour and roughness of the ground in boxes round cells."""
    figures = {}
    level = max(model.brightness, 1.0)
    mean = cells.light / np.maximum(cells.clear, 1) / level
    dark = np.where(cells.clear > 0, cells.clear * (mean < LIMITS.dark), 0).astype(np.float32)
    light = np.where(cells.clear > 0, cells.clear * (mean > LIMITS.light), 0).astype(np.float32)
    squares = np.rint(cells.light * mean * 16).astype(np.float32)
    for half in _BOXES:
        name = f"{half:g}"

        def box_total(values: np.ndarray, half: float = half) -> np.ndarray:
            return around.total(values, half).take(flat)

        clear, whole = box_total(cells.clear), around.pixels(half)
        some = np.maximum(clear, 1)
        figures["clear" + name] = clear / whole
        figures["narrow" + name] = box_total(cells.narrow) / whole
        figures["smooth" + name] = box_total(cells.smooth) / some
        bright = box_total(cells.light) / some / level
        figures["light" + name] = np.minimum(bright, LIMITS.coarsest)
        figures["dark" + name], figures["bright" + name] = box_total(dark) / some, box_total(light) / some
        figures["uneven" + name] = np.sqrt(np.maximum(box_total(squares) / 16 / some / level - bright * bright, 0))
        rough = np.sqrt(box_total(cells.rough) / some) / (2 + 2 * model.texture)
        figures["rough" + name] = np.minimum(rough, 2 * LIMITS.coarsest)
        if cells.red is not None:
            red, green, blue = box_total(cells.red), box_total(cells.green), box_total(cells.blue)
            value = np.maximum((red + green + blue) / 3, 1e-6)
            figures["warm" + name] = np.clip((red - blue) / value - model.warmth, -1, 1)
            figures["green" + name] = np.clip((green - (red + blue) / 2) / value - model.green, -1, 1)
    return figures


def _of_edges(flat: np.ndarray, cells: Cells, around: _Around) -> dict[str, np.ndarray]:
    """How much the edges in boxes round cells run one way, and at right angles."""
    figures = {}
    turned, other, strength = _doubled(cells)
    two, two_other = _doubled_again(turned, other, strength)
    for half in (1.1, 3.0, 8.0):
        whole = np.maximum(around.total(strength, half).take(flat), 1)
        figures[f"ordered{half:g}"] = np.hypot(around.total(turned, half).take(flat),
                                               around.total(other, half).take(flat)) / whole
        figures[f"square{half:g}"] = np.hypot(around.total(two, half).take(flat),
                                              around.total(two_other, half).take(flat)) / whole
    return figures


def _doubled(cells: Cells) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Gradients as vectors of twice their angle, and their strength."""
    return cells.xx - cells.yy, 2 * cells.xy, cells.xx + cells.yy


def _doubled_again(turned: np.ndarray, other: np.ndarray, strength: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same of four times their angle, in whole numbers: edges at right angles agree."""
    some = np.maximum(strength, 1)
    return np.rint((turned * turned - other * other) / some), np.rint(2 * turned * other / some)


def _across(flat: np.ndarray, cells: Cells, around: _Around) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Unit vector (columns, rows) across the stroke at cells, and how surely it is that, 0 to 1."""
    turned, other, strength = (around.total(values, 1.1).take(flat) for values in _doubled(cells))
    angle = 0.5 * np.arctan2(other, turned)
    return np.cos(angle), np.sin(angle), np.hypot(turned, other) / np.maximum(strength, 1)


def _of_sides(rows: np.ndarray, columns: np.ndarray, across: np.ndarray, down: np.ndarray, cells: Cells,
              around: _Around, model: RoadModel, pixel: float, threshold: float) -> dict[str, np.ndarray]:
    """How the ground on both sides of a stroke differs, and the poorer side's share of smooth ground."""
    figures = {}
    near = _Shifted(rows, columns, cells.size * pixel)
    clear, smooth, light, rough = (near.grid(cv2.boxFilter(values, cv2.CV_64F, (3, 3), normalize=False,
                                                           borderType=cv2.BORDER_REPLICATE))
                                   for values in (cells.clear, cells.smooth, cells.light, cells.rough))
    whole = 9.0 * cells.size ** 2
    for distance in LIMITS.sides:
        name = f"{distance:g}"
        two = []
        for place in near.both_ways(distance * across, distance * down):
            some = np.maximum(clear.take(place), 1)
            two.append((clear.take(place) / whole, smooth.take(place) / some, light.take(place) / some,
                        np.sqrt(rough.take(place) / some)))
        (clear_a, smooth_a, light_a, rough_a), (clear_b, smooth_b, light_b, rough_b) = two
        known = np.minimum(clear_a, clear_b) > 0.05
        figures["sided" + name] = np.where(known, np.abs(light_a - light_b) / threshold, -1)
        figures["poorer" + name] = np.where(known, np.minimum(smooth_a, smooth_b), -1)
        figures["rougher" + name] = np.where(known, np.maximum(rough_a, rough_b) / (2 + 2 * model.texture), -1)
        figures["hidden" + name] = np.minimum(clear_a, clear_b)
        figures["lighter" + name] = np.where(known, np.maximum(light_a, light_b) / max(model.brightness, 1.0), -1)
    return figures


def _of_lines(rows: np.ndarray, columns: np.ndarray, across: np.ndarray, down: np.ndarray, cells: Cells,
              around: _Around, pixel: float) -> dict[str, np.ndarray]:
    """Whether strokes of the same direction lie before and behind, and beside, and how that is in other directions."""
    turned, other, strength = (around.total(values, 0.4) for values in _doubled(cells))
    narrow = around.total(cells.narrow, 0.4) > 0
    scale = np.maximum(strength, 1)
    near = _Shifted(rows, columns, cells.size * pixel)
    strokes = near.grid(((turned + 1j * other) / scale * narrow).astype(np.complex64))
    direction = (across * across - down * down).astype(np.float32), (2 * across * down).astype(np.float32)
    across, down = across.astype(np.float32), down.astype(np.float32)

    def like(right: np.ndarray, below: np.ndarray) -> list[np.ndarray]:
        """How much strokes so many metres off, and as many the other way, run the same way, 0 to 1."""
        found = (strokes.take(place) for place in near.both_ways(right, below))
        return [np.maximum(one.real * direction[0] + one.imag * direction[1], np.float32(0)) for one in found]

    def row(turn: float) -> tuple[np.ndarray, np.ndarray]:
        """Of strokes both ways in a direction so many degrees off the own: mean, and that of the better half."""
        cosine, sine = np.float32(np.cos(np.deg2rad(turn))), np.float32(np.sin(np.deg2rad(turn)))
        right, below = -down * cosine - across * sine, across * cosine - down * sine
        ways = [sum(way) / np.float32(len(LIMITS.along)) for way in zip(*(
            like(np.float32(far) * right, np.float32(far) * below) for far in LIMITS.along))]
        return (ways[0] + ways[1]) / 2, np.maximum(*ways)

    def best(distances: tuple[float, ...]) -> list[np.ndarray]:
        """Of strokes beside, at the likest of some distances to each side."""
        return [np.max(way, axis=0) for way in zip(*(
            like(np.float32(far) * across, np.float32(far) * down) for far in distances))]

    mean, better = row(0.0)
    elsewhere = 0.5 * (row(LIMITS.turned)[0] + row(-LIMITS.turned)[0])
    beside, bars = best(LIMITS.spacings), best(LIMITS.bars)
    return {"inline": mean, "inline_one_way": better, "inline_elsewhere": elsewhere,
            "beside_both": np.minimum(*beside), "beside_one": np.maximum(*beside),
            "bars_both": np.minimum(*bars), "bars_one": np.maximum(*bars)}


class _Shifted:
    """Cells that lie so far from others, in grids that go on beyond their edges with these."""

    def __init__(self, rows: np.ndarray, columns: np.ndarray, side: float):
        self._rows, self._columns, self._side = rows, columns, np.float32(side)
        self._rim = int(max(*LIMITS.along, *LIMITS.spacings, *LIMITS.sides) / side) + 2
        self._across, self._start = 0, rows

    def grid(self, values: np.ndarray) -> np.ndarray:
        """Values with a rim, to take places from; all grids are of one shape."""
        self._across = values.shape[1] + 2 * self._rim
        self._start = (self._rows + self._rim) * self._across + self._columns + self._rim
        return np.pad(values, self._rim, mode="edge")

    def both_ways(self, right: np.ndarray, below: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places in the flat grid of cells so many metres off (n,), and as many the other way."""
        step = np.rint(below / self._side).astype(np.intp)
        step *= self._across
        step += np.rint(right / self._side).astype(np.intp)
        return self._start + step, self._start - step
