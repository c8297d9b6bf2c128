"""Lines that are nearly worn away, where the widths of the lanes beside them ask for one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.ndimage import uniform_filter1d

from ...geometry.tolerances import LEAST_DIVISOR, SIGMA_OF_MAD
from .straight_photo import ColourImage, StraightPhoto, straight_photo, straight_places

ALONG = 0.1  # Steps of the image along and across the road, m.
ACROSS = 0.05
WIDTH = 0.15  # Of a line, m.
BESIDE = 0.3  # Distance to the ground on both sides of it that it must be brighter than, m.
CONTRAST = 0.06  # Log brightness at which a pixel counts whole.
DASH = 2.0  # Length of the pieces of which the best fifth is looked at, m.
PIECE = 0.3  # Mean of such a piece that is paint.
COVERED = 0.4  # A row of pixels is looked at where so much of it shows the road's surface.
BODY = 2.0, 1.5  # Likeness to road is taken over so many metres along and across the road,
HIDDEN = -0.1  # and what has less is a vehicle.
ROOM = 2.4  # A line leaves so much to the bounds beside it, m.
WIDTHS = 2.7, 3.9  # A lane between it and the nearer-fitting one is so wide, m.
DOUBT = 0.5  # A width that differs by so much, m, costs one scatter.
LEAST = 1.8  # Scatters of the rows of pixels by which it must stand out.
PAINTED = 0.2  # So much of its length is paint at least: rows of noise have none.
SOLID = 0.5  # It is solid where so much of its length is paint: dashes are shorter than their gaps.

SIGMA = 0.15
"""Standard deviation of a worn line across the road, m: its own width."""

DIVIDED = 5.2
"""Two bounds farther apart may have a line between them, m."""


@dataclass(frozen=True)
class WornLine:
    """A line at one distance from the axis: offset (m), "solid" or "dashed", and share of its length that is paint."""

    offset: float
    kind: str
    painted: float


def worn_lines(image: ColourImage, photo: StraightPhoto, like: np.ndarray, bounds: Sequence[float], usual: float,
               symbols: shapely.Geometry) -> list[WornLine]:
    """Lines between bounds too far apart for one lane.

    Each stands out of all rows of pixels along the road, and leaves on one side a lane as wide as others.

    Parameters
    ----------
    photo, like : the section and its likeness to road, see `road_likeness`.
    bounds : offsets of the bounds that are known, m.
    usual : width of a lane, m.
    symbols : paint that is no line.
    """
    known = sorted(bounds)
    if len(known) < 2 or max(np.diff(known)) < DIVIDED:
        return []
    offset, evidence, painted = _rows_of_pixels(image, photo, like, (known[0] - 0.5, known[-1] + 0.5), symbols)
    found: list[WornLine] = []
    while True:
        best = (LEAST, -1)
        for right, left in zip(known[:-1], known[1:]):
            if left - right < DIVIDED:
                continue
            to_sides = np.stack([offset - right, left - offset])
            width = np.take_along_axis(to_sides, np.abs(to_sides - usual).argmin(axis=0)[None], axis=0)[0]
            likely = evidence - ((width - usual) / DOUBT) ** 2
            fits = (to_sides.min(axis=0) >= ROOM) & (width >= WIDTHS[0]) & (width <= WIDTHS[1])
            likely[~fits | (painted < PAINTED)] = -9.0
            best = max(best, (float(likely.max()), int(likely.argmax())))
        if best[1] < 0:
            return found
        place, share = float(offset[best[1]]), float(painted[best[1]])
        found.append(WornLine(place, "solid" if share > SOLID else "dashed", share))
        known = sorted([*known, place])


def _rows_of_pixels(image: ColourImage, photo: StraightPhoto, like: np.ndarray, between: tuple[float, float],
                    symbols: shapely.Geometry) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Offsets of rows of pixels along the road, by how many scatters each stands out, and its painted share."""
    chainage = np.arange(photo.chainage[0], photo.chainage[-1], ALONG)
    offset = np.arange(*between, ACROSS)
    fine = straight_photo(image, photo.axis, chainage, offset)
    level = np.log(np.maximum(np.nan_to_num(fine.colours.mean(axis=-1), nan=1.0), 1.0))
    level = uniform_filter1d(level, round(WIDTH / ACROSS), axis=1)
    apart = round(BESIDE / ACROSS)
    ridge = level - np.maximum(np.roll(level, apart, axis=1), np.roll(level, -apart, axis=1))
    paint = np.clip(ridge / CONTRAST, -1.0, 1.0)
    seen = _seen(photo, like, chainage, offset) & np.isfinite(fine.colours).all(axis=-1)
    places = straight_places(photo.axis, chainage, offset)
    seen &= ~shapely.contains_xy(symbols, places[..., 0], places[..., 1])
    seen[:, :apart], seen[:, -apart:] = False, False
    pieces = uniform_filter1d(np.where(seen, paint, 0.0), round(DASH / ALONG) | 1, axis=0)
    count = seen.sum(axis=0)
    mean = np.where(seen, paint, 0.0).sum(axis=0) / np.maximum(count, 1)
    best = np.array([np.percentile(column[mask], 80) if mask.any() else 0.0 for column, mask in zip(pieces.T, seen.T)])
    painted = ((pieces > PIECE) & seen).sum(axis=0) / np.maximum(count, 1)
    road = count > COVERED * len(chainage)
    return offset, (_standing_out(mean, road) + _standing_out(best, road)) / 2.0, painted


def _seen(photo: StraightPhoto, like: np.ndarray, chainage: np.ndarray, offset: np.ndarray) -> np.ndarray:
    """Where no vehicle stands, (n, m) bool at finer chainages and offsets."""
    steps = photo.chainage[1] - photo.chainage[0], photo.offset[1] - photo.offset[0]
    for axis, (length, step) in enumerate(zip(BODY, steps)):
        like = uniform_filter1d(like, int(length / step) | 1, axis=axis)
    rows = np.clip(np.round((chainage - photo.chainage[0]) / steps[0]).astype(int), 0, len(photo.chainage) - 1)
    return like[np.ix_(rows, photo.column(offset))] > HIDDEN


def _standing_out(values: np.ndarray, road: np.ndarray) -> np.ndarray:
    """By how many robust scatters values differ from their median on the road; -9 beside it."""
    if not road.any():
        return np.full(len(values), -9.0)
    middle = np.median(values[road])
    scatter = SIGMA_OF_MAD * np.median(np.abs(values[road] - middle))
    return np.where(road, (values - middle) / max(scatter, LEAST_DIVISOR), -9.0)
