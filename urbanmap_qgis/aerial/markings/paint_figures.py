"""Figures of bright narrow places and of what surrounds them, by which a trained model tells paint from what looks like
it.

All is summed up on cells of about a third of a metre, from whole numbers: sums of these are exact, and so the figures
do not depend on where a tile begins. Lengths are in m, brightness is relative to the ground near.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import cv2
import numpy as np

from .image_strips import STRIP, row_strips
from .marking_pieces import MarkingPieces, variances
from .road_model import RoadModel, mean_over, shares_of_colour


@dataclass(frozen=True)
class PaintFiguresLimits:
    """Limits of the figures, each with its unit."""

    cell: float = 0.36  # m
    steepest: int = 60  # grey values a pixel, that gradients are cut at
    highest: float = 15.0  # thresholds, that reliefs are cut at
    largest: float = 20.0  # m2, the same of areas
    coarsest: float = 4.0  # times the ground's own: figures are cut there
    near: tuple[float, ...] = (1.1, 2.6)  # m, half sides of boxes for the first round
    company: tuple[float, ...] = (1.1, 2.6, 6.0)  # m, and for the second
    side: float = 0.8  # m to either side of a stroke
    along: tuple[float, ...] = (1.5, 3.0, 4.5, 6.0, 8.0)  # m before and behind
    spacings: tuple[float, ...] = (2.2, 2.7, 3.2, 3.7, 4.2)  # m at which neighbouring lines lie
    bars: tuple[float, ...] = (0.8, 1.0, 1.2)  # m at which bars of crossings do
    turned: float = 40.0  # degrees, directions in which lines are looked for to compare


LIMITS = PaintFiguresLimits()

NEAR_REACH, FAR_REACH = 3.5, 9.0
"""m round a cell that the figures of the first and of the second round look."""


def cell_pixels(pixel: float) -> int:
    """Pixels along the side of a cell."""
    return max(round(LIMITS.cell / pixel), 1)


@dataclass(frozen=True)
class PaintImage:
    """A piece of image with bright narrow pixels; all but `bands` (rows, columns).

    Attributes
    ----------
    bands : (1 or 3 and more, rows, columns), red, green, blue first.
    image : levelled brightness.
    road : the same without what is as narrow as paint.
    core, narrow, clear : uint8: bright; of these, what stands out on both sides; ground that is seen with nothing
        bright near.
    model : the image's own road.
    scale : levelled grey values in one of the bands' steps.
    contrast : grey values that paint stands out by in the light.
    pixel : side, m.
    """

    bands: np.ndarray
    image: np.ndarray
    road: np.ndarray
    core: np.ndarray
    narrow: np.ndarray
    clear: np.ndarray
    model: RoadModel
    scale: float
    contrast: float
    pixel: float


def sums_over(values: np.ndarray, size: int) -> np.ndarray:
    """Sums (whole numbers, float32) over square cells of an image, beginning with its first pixel."""
    rows, columns = (-(-side // size) for side in values.shape)
    below, right = rows * size - values.shape[0], columns * size - values.shape[1]
    if below or right:
        values = cv2.copyMakeBorder(values, 0, below, 0, right, cv2.BORDER_REPLICATE)
    means = cv2.resize(values.astype(np.float32, copy=False), (columns, rows), interpolation=cv2.INTER_AREA)
    return np.rint(means * np.float32(size * size))


_ACROSS = np.float32([[-1, 0, 1]])


def _steps(whole: np.ndarray, kernel: np.ndarray) -> np.ndarray:
    """Gradients of whole grey values along a kernel, cut at the steepest."""
    steps = cv2.filter2D(whole, cv2.CV_32F, kernel, borderType=cv2.BORDER_REPLICATE)
    steepest = np.float32(LIMITS.steepest)
    return np.minimum(np.maximum(steps, -steepest, out=steps), steepest, out=steps)


def cell_sums(seen: PaintImage) -> dict[str, np.ndarray]:
    """Sums over cells, (rows, columns) float32 of whole numbers each.

    `clear`, `narrow` and `body` count pixels, the last of bright ones that are not narrow; `light`, `red`, `green` and
    `blue` are of the clear ground, `rough` its squared steps of brightness; `xx`, `yy`, `xy` products of gradients.
    """
    size = cell_pixels(seen.pixel)
    sums: dict[str, list[np.ndarray]] = {}
    for strip, wide, inner in row_strips(len(seen.image), 1, max(STRIP // size, 1) * size):
        clear = seen.clear[strip].astype(np.float32)
        whole = np.rint(seen.image[wide])
        np.minimum(np.maximum(whole, np.float32(-500), out=whole), np.float32(1000), out=whole)
        across, down = (_steps(whole, kernel)[inner] for kernel in (_ACROSS, _ACROSS.T))
        xy = across * down
        across *= across
        down *= down
        values = {"clear": clear, "narrow": seen.narrow[strip], "body": seen.core[strip] ^ seen.narrow[strip],
                  "light": whole[inner] * clear, "rough": (across + down) * clear, "xx": across, "yy": down, "xy": xy}
        for name, band in zip(("red", "green", "blue"), seen.bands if len(seen.bands) >= 3 else ()):
            values[name] = np.rint(band[strip].astype(np.float32) * np.float32(seen.scale)) * clear
        for name, value in values.items():
            sums.setdefault(name, []).append(sums_over(value, size))
    return {name: np.concatenate(parts) for name, parts in sums.items()}


@dataclass(frozen=True)
class StrokeCells:
    """Cells with bright narrow pixels.

    Attributes
    ----------
    sums : see `cell_sums`.
    rows, columns : (k,) of the cells.
    cell : (n,) number of the cell of each pixel that counts.
    pixels : (k,) how many there are in each.
    side : of a cell, m.
    size : the same in pixels.
    """

    sums: Mapping[str, np.ndarray]
    rows: np.ndarray
    columns: np.ndarray
    cell: np.ndarray
    pixels: np.ndarray
    side: float
    size: int

    @classmethod
    def of(cls, seen: PaintImage, places: np.ndarray) -> StrokeCells:
        """Those of pixels at places (n,) in the flat image."""
        size, sums = cell_pixels(seen.pixel), cell_sums(seen)
        rows, columns = np.divmod(places, seen.image.shape[1])
        shape = sums["clear"].shape
        cell = rows // size * shape[1] + columns // size
        total = np.bincount(cell, minlength=shape[0] * shape[1])
        filled = np.flatnonzero(total)
        number = np.zeros(len(total), np.intp)
        number[filled] = np.arange(len(filled))
        return cls(sums, *np.divmod(filled, shape[1]), number[cell], total[filled], size * seen.pixel, size)

    @property
    def flat(self) -> np.ndarray:
        """Places (k,) of the cells in the flat grid."""
        return self.rows * self.sums["clear"].shape[1] + self.columns

    def chosen(self, some: np.ndarray) -> StrokeCells:
        """Some of the cells, bool (k,), without their pixels."""
        return StrokeCells(self.sums, self.rows[some], self.columns[some], self.cell[:0], self.pixels[some], self.side,
                           self.size)

    def mean(self, values: np.ndarray) -> np.ndarray:
        """Means (k,) of values of the pixels (n,)."""
        return np.bincount(self.cell, values, minlength=len(self.pixels)) / self.pixels

    def total(self, values: np.ndarray, half: float) -> np.ndarray:
        """Sums over boxes of so many metres to each side, (rows, columns) float64."""
        side = 2 * max(round(half / self.side), 1) + 1
        return cv2.boxFilter(values, cv2.CV_64F, (side, side), normalize=False, borderType=cv2.BORDER_REPLICATE)

    def ground(self, name: str, half: float) -> np.ndarray:
        """Means (k,) of a sum of the clear ground's pixels in such boxes round the cells; 0 where there is none."""
        light, clear = (self.total(self.sums[one], half).take(self.flat) for one in (name, "clear"))
        return light / np.maximum(clear, 1)

    def box_pixels(self, half: float) -> float:
        """Pixels in such a box."""
        return float((2 * max(round(half / self.side), 1) + 1) * self.size) ** 2


def stroke_figures(seen: PaintImage, cells: StrokeCells, places: np.ndarray, threshold: np.ndarray,
                   pieces: MarkingPieces) -> dict[str, np.ndarray]:
    """Figures (k,) of the first round: the strokes themselves, and the ground near.

    Parameters
    ----------
    places : (n,) of the pixels in the flat image, which are those of `pieces`.
    threshold : (n,) grey values that paint stands out by there.
    """
    relief = np.minimum((seen.image.take(places) - seen.road.take(places)) / threshold, LIMITS.highest)
    relief = np.rint(relief * 64)
    bright = cells.mean(np.rint(seen.image.take(places)))
    depth = cv2.distanceTransform(seen.narrow, cv2.DIST_L1, 3).take(places)
    figures = {"relief": cells.mean(relief) / 64, "depth": cells.mean(depth) * seen.pixel,
               "filled": cells.pixels / cells.size ** 2}
    edges = (cells.sums["xx"] + cells.sums["yy"]).take(cells.flat)
    figures["sharp"] = np.sqrt(edges / cells.pixels) / np.maximum(figures["relief"] * seen.contrast, 1)
    figures |= _of_ground(cells, seen.model)
    beside, around = (cells.ground("light", half) for half in LIMITS.near)
    beside = np.where(beside > 0, beside, around)
    figures["brighter"], figures["brightest"] = (np.clip(bright / np.maximum(ground, 5), 0, LIMITS.coarsest)
                                                 for ground in (beside, around))
    figures["darker"] = np.clip(beside / np.maximum(around, 5), 0, LIMITS.coarsest)
    if len(seen.bands) >= 3:
        warmth, green = shares_of_colour(*(mean_over(band, 3).take(places) for band in seen.bands[:3]))
        ground = shares_of_colour(*(cells.ground(name, LIMITS.near[-1]) for name in ("red", "green", "blue")))
        for name, own, other, usual in (("warm", warmth, ground[0], seen.model.warmth),
                                        ("green", green, ground[1], seen.model.green)):
            own = cells.mean(np.rint(own * 512)) / 512
            figures["p" + name], figures[name + "er"] = own - usual, np.clip(own - other, -1, 1)
    rows, columns = np.divmod(places, seen.image.shape[1])
    figures |= {name: cells.mean(values[pieces.labels]) for name, values in _shapes(
        pieces, rows, columns, relief, seen.pixel).items()}
    across, down, figures["firm"] = _across(cells)
    return figures | _of_sides(cells, across, down, seen)


def _shapes(pieces: MarkingPieces, rows: np.ndarray, columns: np.ndarray, relief: np.ndarray, pixel: float
            ) -> dict[str, np.ndarray]:
    """Length, width, fullness, area, mean relief and its spread (m,) of pieces, whose pixels lie at rows and columns;
    -1 of long ones."""
    some = np.maximum(pieces.size, 1)
    along, across = variances(pieces.labels, rows, columns, pieces.size)
    length, width = pixel * np.sqrt(12 * along + 1), pixel * np.sqrt(12 * across + 1)
    area = pieces.size * pixel ** 2
    mean, square = (np.bincount(pieces.labels, values, minlength=len(some)) / some for values in (relief, relief ** 2))
    found = {"plen": length, "pwid": width, "pfill": area / np.maximum(length * width, 0.01),
             "parea": np.minimum(area, LIMITS.largest), "prelief": mean / 64,
             "pspread": np.sqrt(np.maximum(square - mean ** 2, 0)) / np.maximum(mean, 1)}
    return {name: np.where(pieces.long, -1.0, values) for name, values in found.items()}


def _of_ground(cells: StrokeCells, model: RoadModel) -> dict[str, np.ndarray]:
    """Shares, unevenness, roughness and order of edges of what is in boxes round cells.

    How light and warm the ground is says little: roads are dark and grey in one place, light or brown in another.
    """
    figures, sums = {}, cells.sums
    squares = np.rint(sums["light"] * (sums["light"] / np.maximum(sums["clear"], 1)) / 16).astype(np.float32)
    turned, other, strength = _doubled(sums)
    two, two_other = _doubled_again(turned, other, strength)
    for half in LIMITS.near:
        def box(values: np.ndarray, half: float = half) -> np.ndarray:
            return cells.total(values, half).take(cells.flat)

        clear, whole, ground = box(sums["clear"]), cells.box_pixels(half), cells.ground("light", half)
        some, edges = np.maximum(clear, 1), np.maximum(box(strength), 1)
        spread = np.sqrt(np.maximum(box(squares) * 16 / some - ground ** 2, 0))
        rough = np.sqrt(box(sums["rough"]) / some) / (2 + 2 * model.texture)
        found = {"clear": clear / whole, "narrow": box(sums["narrow"]) / whole, "body": box(sums["body"]) / whole,
                 "uneven": np.clip(spread / np.maximum(ground, 5), 0, LIMITS.coarsest),
                 "rough": np.minimum(rough, 2 * LIMITS.coarsest), "ordered": np.hypot(box(turned), box(other)) / edges,
                 "square": np.hypot(box(two), box(two_other)) / edges}
        figures |= {f"{name}{half:g}": values for name, values in found.items()}
    return figures


def _doubled(sums: Mapping[str, np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Gradients as vectors of twice their angle, and their strength."""
    return sums["xx"] - sums["yy"], 2 * sums["xy"], sums["xx"] + sums["yy"]


def _doubled_again(turned: np.ndarray, other: np.ndarray, strength: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same of four times their angle, in whole numbers: edges at right angles agree."""
    some = np.maximum(strength, 1)
    return np.rint((turned * turned - other * other) / some), np.rint(2 * turned * other / some)


def _across(cells: StrokeCells) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Unit vector (columns, rows) across the stroke at cells, and how surely it is that, 0 to 1."""
    turned, other, strength = (cells.total(values, 0.7).take(cells.flat) for values in _doubled(cells.sums))
    angle = 0.5 * np.arctan2(other, turned)
    return np.cos(angle), np.sin(angle), np.hypot(turned, other) / np.maximum(strength, 1)


def _of_sides(cells: StrokeCells, across: np.ndarray, down: np.ndarray, seen: PaintImage) -> dict[str, np.ndarray]:
    """How the ground on both sides of a stroke differs."""
    near, two = _Shifted(cells), []
    clear, body, light, rough = (near.grid(cells.total(cells.sums[name], cells.side)) for name in (
        "clear", "body", "light", "rough"))
    whole = cells.box_pixels(cells.side)
    for place in near.both_ways(LIMITS.side * across, LIMITS.side * down):
        some = np.maximum(clear.take(place), 1)
        two.append((clear.take(place) / whole, body.take(place) / whole, light.take(place) / some,
                    np.sqrt(rough.take(place) / some)))
    (clear_a, body_a, light_a, rough_a), (clear_b, body_b, light_b, rough_b) = two
    known = np.minimum(clear_a, clear_b) > 0.05
    return {"sided": np.where(known, np.abs(light_a - light_b) / seen.contrast, -1),
            "rougher": np.where(known, np.maximum(rough_a, rough_b) / (2 + 2 * seen.model.texture), -1),
            "hidden": np.minimum(clear_a, clear_b), "bodied": np.maximum(body_a, body_b)}


_STEPS = 255.0
"""Steps of a likelihood: whole numbers are summed."""


def company_figures(cells: StrokeCells, likely: np.ndarray) -> dict[str, np.ndarray]:
    """Figures (k,) of the second round: whether a stroke runs as what the first took for paint round it, and whether
    strokes, and such as are paint, lie in line and side by side.

    Parameters
    ----------
    likely : (rows, columns) float32 of all cells, 0 to 1, how likely their bright pixels are paint.
    """
    across, down, _ = _across(cells)
    narrow = cells.sums["narrow"]
    paint = np.rint(likely * np.float32(_STEPS)) * narrow
    turned, other, strength = (np.rint(cells.total(values, 0.4)).astype(np.float32) for values in _doubled(cells.sums))
    some, figures = np.maximum(strength, 1), {}
    one, two = (np.rint(paint * values / some) for values in (turned, other))
    for half in LIMITS.company:
        whole, right, below = (cells.total(values, half).take(cells.flat) for values in (paint, one, two))
        figures[f"aligned{half:g}"] = (right * (across * across - down * down) + below * 2 * across * down
                                       ) / np.maximum(whole, 1)
    strokes = (turned + 1j * other) / some
    share = np.minimum(cells.total(paint, cells.side) / (_STEPS * cells.size), 1)
    figures |= _of_lines(cells, across, down, strokes * (cells.total(narrow, cells.side) > 0))
    return figures | {f"l{name}": values for name, values in _of_lines(cells, across, down, strokes * share).items()}


def _of_lines(cells: StrokeCells, across: np.ndarray, down: np.ndarray, strokes: np.ndarray) -> dict[str, np.ndarray]:
    """Whether strokes of the same direction lie before and behind, and beside, and how that is in other directions.

    `strokes` (rows, columns) complex holds vectors of twice their angle, as long as there is a stroke, 0 to 1.
    """
    near = _Shifted(cells)
    grid = near.grid(strokes.astype(np.complex64))
    direction = (across * across - down * down).astype(np.float32), (2 * across * down).astype(np.float32)
    across, down = across.astype(np.float32), down.astype(np.float32)

    def like(right: np.ndarray, below: np.ndarray) -> list[np.ndarray]:
        """How much strokes so many metres off, and as many the other way, run the same way, 0 to 1."""
        found = (grid.take(place) for place in near.both_ways(right, below))
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

    def __init__(self, cells: StrokeCells):
        self._side = np.float32(cells.side)
        self._rim = int(max(*LIMITS.along, *LIMITS.spacings) / cells.side) + 2
        self._across = cells.sums["clear"].shape[1] + 2 * self._rim
        self._start = (cells.rows + self._rim) * self._across + cells.columns + self._rim

    def grid(self, values: np.ndarray) -> np.ndarray:
        """Values with a rim, to take places from."""
        return np.pad(values, self._rim, mode="edge")

    def both_ways(self, right: np.ndarray, below: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places in the flat grid of cells so many metres off (k,), and as many the other way."""
        step = np.rint(below / self._side).astype(np.intp)
        step *= self._across
        step += np.rint(right / self._side).astype(np.intp)
        return self._start + step, self._start - step
