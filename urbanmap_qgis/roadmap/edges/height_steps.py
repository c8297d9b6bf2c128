"""Places where the ground steps: two smooth sides whose lines miss each other, in strips of four directions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter1d

from ...settings.roadmap import EdgeSettings
from .edge_points import EdgeTile
from .edge_records import EdgeCandidates, joined_candidates

STRIP = 0.5
"""Width of a strip, m: the length of edge that one candidate stands for."""

CELL = 0.1
"""Length of a cell along a strip, m."""

DIRECTIONS = 4
"""Directions in which strips run, over half a turn."""

# Cells left out at the step, and cells to which each side reaches: near the vehicle, and where points are
# sparse.
SPANS = ((1, 7), (1, 17))
# what a side's slope may be without being seen, and a point's height error, m
SLOPE_SIGMA = 0.04
NOISE = 0.01
SMOOTH = 0.03  # m: a rougher side is no made surface
ROUGH_SHARE = 0.35  # of the step, at most as rough
SIGNIFICANT = 4.0
FEWEST = 3  # points of a side
SEPARATION = 4  # cells between two candidates of a strip


@dataclass(frozen=True)
class Side:
    """Lines fitted to one side of each place of the strips: height there, its sigma and the residual, m."""

    height: np.ndarray
    sigma: np.ndarray
    rough: np.ndarray
    number: np.ndarray


def step_candidates(tile: EdgeTile, near_ground: np.ndarray, settings: EdgeSettings
                    ) -> tuple[EdgeCandidates, np.ndarray]:
    """Candidates of a tile, in each pass for itself, and the least steps (n,), m, that its places would show.

    Parameters
    ----------
    near_ground : (n,) which of the tile's points lie at the ground or a kerb's height above it.
    """
    found, least = [], [np.zeros(0)]
    points = tile.points[near_ground]
    for drive in np.unique(points["drive"]).tolist():
        place = np.column_stack([points[name][points["drive"] == drive] for name in "xyz"])
        for number in range(DIRECTIONS):
            angle = np.pi * number / DIRECTIONS
            along = np.array([np.cos(angle), np.sin(angle)])
            candidates, shown = _in_strips(place, along, settings)
            found.append(candidates)
            least.append(shown)
    every = joined_candidates(found)
    mine = tile.owns(every.place)
    return (EdgeCandidates(every.place[mine], every.normal[mine], every.height[mine], every.score[mine]),
            np.concatenate(least))


@dataclass(frozen=True)
class Strips:
    """Points in strips that run along a direction (2,): moments (6, strips, borders) and the first cell and strip."""

    along: np.ndarray
    sums: np.ndarray
    first: float
    first_strip: float

    @classmethod
    def of(cls, place: np.ndarray, along: np.ndarray) -> Strips:
        """Strips of points (n, 3), at the same places of the map whatever the points are."""
        a, b = place[:, :2] @ along, place[:, :2] @ np.array([-along[1], along[0]])
        first, first_strip = np.floor(a.min() / CELL), np.floor(b.min() / STRIP)
        sums = _moments(a - first * CELL, np.floor(b / STRIP) - first_strip, place[:, 2])
        return cls(along, sums, first, first_strip)

    def sides(self, left_out: int, reach: int) -> tuple[Side, Side]:
        """Lines fitted before and after each border, in cells from `left_out` to `reach` off it."""
        last = self.sums.shape[2] - 1
        border = np.arange(last + 1)
        return (_side(self.sums, np.maximum(border - reach, 0), np.maximum(border - left_out, 0)),
                _side(self.sums, np.minimum(border + left_out, last), np.minimum(border + reach, last)))

    def peaks(self, value: np.ndarray, score: np.ndarray) -> EdgeCandidates:
        """Candidates where the score (strips, borders) is greatest; the sign of `value` tells to which side."""
        peak = (score > 0) & (score >= maximum_filter1d(score, 2 * SEPARATION + 1, axis=1, mode="constant"))
        strip, cell = np.nonzero(peak)
        middle = (self.first_strip + strip + 0.5) * STRIP
        across = np.array([-self.along[1], self.along[0]])
        of_peak = value[strip, cell]
        return EdgeCandidates(((self.first + cell) * CELL)[:, None] * self.along + middle[:, None] * across,
                              np.sign(of_peak)[:, None] * self.along, np.abs(of_peak), score[strip, cell])


def _in_strips(place: np.ndarray, along: np.ndarray, settings: EdgeSettings) -> tuple[EdgeCandidates, np.ndarray]:
    """Candidates of points (n, 3) whose normals run along the direction (2,) or against it, and the least steps (k,)
    that would show."""
    if len(place) < 4 * FEWEST:
        return joined_candidates([]), np.zeros(0)
    strips = Strips.of(place, along)
    height, score, least = _steps(*strips.sides(*SPANS[0]), settings)
    for span in SPANS[1:]:
        # A wider span only speaks where the narrower one has too few points.
        wide_height, wide_score, wide_least = _steps(*strips.sides(*span), settings)
        score, least = (np.where(np.isnan(height), wide, narrow)
                        for narrow, wide in ((score, wide_score), (least, wide_least)))
        height = np.where(np.isnan(height), wide_height, height)
    return strips.peaks(height, score), least[np.isfinite(least)]


def _moments(a: np.ndarray, strip: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Running sums (6, strips, borders) of 1, a, z, a², az, z² over the cells before each border of a cell."""
    cell = np.floor(a / CELL).astype(np.int64)
    shape = (int(strip.max()) + 1, int(cell.max()) + 1)
    flat = strip.astype(np.int64) * shape[1] + cell
    z = z - np.median(z)
    sums = np.zeros((6, shape[0], shape[1] + 1))
    for number, value in enumerate((None, a, z, a * a, a * z, z * z)):
        total = np.bincount(flat, weights=value, minlength=shape[0] * shape[1]).reshape(shape)
        np.cumsum(total, axis=1, out=sums[number, :, 1:])
    return sums


def _steps(before: Side, after: Side, settings: EdgeSettings) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Height of the step (strips, borders), m, NaN where points lack; its score, 0 where there is none; and the least
    step that would show there, m, NaN where points lack or the ground is no made surface."""
    enough = (before.number >= FEWEST) & (after.number >= FEWEST)
    height = np.where(enough, after.height - before.height, np.nan)
    size = np.abs(np.where(enough, height, 0.0))
    rough, sigma = np.maximum(before.rough, after.rough), np.hypot(before.sigma, after.sigma)
    asked = np.maximum(np.maximum(settings.min_height, SIGNIFICANT * sigma), rough / ROUGH_SHARE)
    good = enough & (size >= asked) & (size <= settings.max_height) & (rough < SMOOTH)
    # Noise makes half of the steps as high as is asked look lower: two sigma more are seen nearly always.
    least = np.where(enough & (rough < SMOOTH), asked + 2.0 * sigma, np.nan)
    return height, np.where(good, size / (0.01 + rough), 0.0), least


def _side(sums: np.ndarray, start: np.ndarray, end: np.ndarray) -> Side:
    """Lines fitted to the cells `start` to `end` of each border, extended to the border itself."""
    n, sum_a, sum_z, sum_aa, sum_az, sum_zz = sums[:, :, end] - sums[:, :, start]
    number = np.maximum(n, 1.0)
    mean_a, mean_z = sum_a / number, sum_z / number
    spread = np.maximum(sum_aa - n * mean_a**2, 0.0) + (NOISE / SLOPE_SIGMA)**2
    both = sum_az - n * mean_a * mean_z
    slope = both / spread
    rough = np.sqrt(np.maximum(sum_zz - n * mean_z**2 - slope * both, 0.0) / number)
    beyond = np.arange(sums.shape[2]) * CELL - mean_a
    noise = np.maximum(rough, NOISE)
    return Side(mean_z + slope * beyond, noise * np.sqrt(1.0 / number + beyond**2 / spread), rough, n)
