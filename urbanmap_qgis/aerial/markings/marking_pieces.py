"""Connected pieces of bright narrow pixels, and the figures by which a trained model judges them.

Pieces are judged cell by cell (a third of a metre), and short ones as a whole by the mean of their cells; of long ones
only what lies within a few metres counts, so that the result does not depend on how an image is cut.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from .marking_confidence import GroundBeside, mean_over, shares_of_colour
from .road_model import RoadModel
from .surroundings import cells_of, figures_at


@dataclass(frozen=True)
class MarkingPiecesLimits:
    """Limits of marking pieces, each with its unit."""

    highest: float = 15.0  # thresholds, that reliefs are cut at
    largest: float = 20.0  # m2, the same of areas


LIMITS = MarkingPiecesLimits()


@dataclass(frozen=True)
class MarkingPieces:
    """Connected pieces of flags.

    Attributes
    ----------
    inside : (n,) places of the flags in the flat image.
    labels : (n,) the piece that each belongs to, from 0 (none).
    size : (m,) flags of each piece.
    length : (m,) m, diagonal of its box with half the gap on all sides.
    long : (m,) bool, too long to be judged as one.
    """

    inside: np.ndarray
    labels: np.ndarray
    size: np.ndarray
    length: np.ndarray
    long: np.ndarray


def marking_pieces_of(mask: np.ndarray, joined: np.ndarray, pixel: float, max_length: float) -> MarkingPieces:
    """MarkingPieces of flags (bool) that hang together in `joined` (uint8), which holds them all; `max_length` in m."""
    count, labels, boxes, _centres = cv2.connectedComponentsWithStats(joined, connectivity=8)
    inside = np.flatnonzero(mask)
    labels = labels.take(inside)
    size = np.bincount(labels, minlength=count)
    length = np.hypot(boxes[:, cv2.CC_STAT_WIDTH], boxes[:, cv2.CC_STAT_HEIGHT]) * pixel
    return MarkingPieces(inside, labels, size, length, length >= max_length)


@dataclass(frozen=True)
class StrokeAxes:
    """Main axes of pieces, in pixels.

    Attributes
    ----------
    middle : (m, 2) row and column.
    direction : (m, 2) of the longer axis, of length 1.
    along, across : (m,) variances.
    """

    middle: np.ndarray
    direction: np.ndarray
    along: np.ndarray
    across: np.ndarray


def stroke_axes(labels: np.ndarray, rows: np.ndarray, columns: np.ndarray, size: np.ndarray) -> StrokeAxes:
    """StrokeAxes of pieces of sizes (m,), of pixels at rows and columns (n,) with labels."""
    some = np.maximum(size, 1)

    def mean(values: np.ndarray) -> np.ndarray:
        return np.bincount(labels, values, minlength=len(size)) / some

    row, column = mean(rows), mean(columns)
    down, across = rows - row[labels], columns - column[labels]
    first, second, mixed = mean(down * down), mean(across * across), mean(down * across)
    half, root = (first + second) / 2, np.hypot((first - second) / 2, mixed)
    angle = np.arctan2(2 * mixed, first - second) / 2
    return StrokeAxes(np.column_stack([row, column]), np.column_stack([np.cos(angle), np.sin(angle)]), half + root,
                      np.maximum(half - root, 0))


def variances(labels: np.ndarray, rows: np.ndarray, columns: np.ndarray, size: np.ndarray
              ) -> tuple[np.ndarray, np.ndarray]:
    """Variances (m,) along and across the main axes, see `stroke_axes`."""
    axes = stroke_axes(labels, rows, columns, size)
    return axes.along, axes.across


@dataclass(frozen=True)
class PieceFigures:
    """Figures of cells that hold pieces.

    Attributes
    ----------
    values : (k,) of each cell by name.
    cell : (n,) number of the cell of each pixel that counts.
    pixels : (k,) how many there are in each.
    """

    values: dict[str, np.ndarray]
    cell: np.ndarray
    pixels: np.ndarray


@dataclass(frozen=True)
class PieceImage:
    """An image with bright narrow pixels; all but `bands` (rows, columns).

    Attributes
    ----------
    bands : (1 or 3 and more, rows, columns).
    image : levelled brightness.
    narrow : bool.
    ground : round them.
    model : the image's own road.
    scale : levelled grey values in one of the bands' steps.
    contrast : grey values that paint stands out by.
    """

    bands: np.ndarray
    image: np.ndarray
    narrow: np.ndarray
    ground: GroundBeside
    model: RoadModel
    scale: float
    contrast: float


def piece_figures(seen: PieceImage, places: np.ndarray, relief: np.ndarray, by_rules: np.ndarray,
                  pieces: MarkingPieces, labels: np.ndarray, pixel: float) -> PieceFigures:
    """Figures of the cells with pixels of pieces.

    Parameters
    ----------
    places : (n,) of the pixels in the flat image.
    relief : (n,) their top-hat in thresholds.
    by_rules : (n,) their confidence by rules.
    labels : (n,) their pieces.
    pixel : side, m.
    """
    cells = cells_of(seen.bands, seen.image, seen.narrow, seen.ground, pixel, seen.scale)
    rows, columns = np.divmod(places, seen.image.shape[1])
    across = cells.clear.shape[1]
    cell = rows // cells.size * across + columns // cells.size
    total = np.bincount(cell, minlength=cells.clear.size)
    filled = np.flatnonzero(total)
    pixels = total[filled]

    def mean(values: np.ndarray) -> np.ndarray:
        return np.bincount(cell, values, minlength=len(total))[filled] / pixels

    values = figures_at(*np.divmod(filled, across), cells, seen.model, pixel, seen.contrast)
    values["relief"] = mean(np.rint(np.minimum(relief, LIMITS.highest) * 64)) / 64
    values["rules"] = mean(np.rint(by_rules * 256)) / 256
    values["paint"] = mean(np.rint(seen.image.take(places))) / max(seen.model.brightness, 1.0)
    if len(seen.bands) >= 3:
        warmth, green = shares_of_colour(*(mean_over(band, 3).take(places) for band in seen.bands[:3]))
        values["pwarm"] = mean(np.rint(warmth * 512)) / 512 - seen.model.warmth
        values["pgreen"] = mean(np.rint(green * 512)) / 512 - seen.model.green
        values["warmer"] = values["pwarm"] - values["warm2.6"]
    values |= {name: mean(figure[labels]) for name, figure in _shapes(pieces, labels, rows, columns, pixel).items()}
    number = np.zeros(len(total), np.intp)
    number[filled] = np.arange(len(filled))
    return PieceFigures(values, number[cell], pixels)


def _shapes(pieces: MarkingPieces, labels: np.ndarray, rows: np.ndarray, columns: np.ndarray, pixel: float
            ) -> dict[str, np.ndarray]:
    """Length, width, fullness and area (m,) of pieces, whose pixels lie at rows and columns; -1 of long ones."""
    long = pieces.long
    along, across = variances(labels, rows, columns, pieces.size)
    length, width = pixel * np.sqrt(12 * along + 1), pixel * np.sqrt(12 * across + 1)
    area = pieces.size * pixel ** 2
    return {"plen": np.where(long, 12.0, length), "pwid": np.where(long, -1.0, width),
            "pfill": np.where(long, -1.0, area / np.maximum(length * width, 0.01)),
            "parea": np.where(long, -1.0, np.minimum(area, LIMITS.largest))}
