"""A cast of colour that varies over an image, as vignetting and haze make it, and its removal.

Told from what should be alike everywhere, the image's smooth grey ground: the colour of most of it is taken for a
surface of the second degree over the image (least absolute deviations, then Tukey's biweight). Of an image without such
a cast nothing is changed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class ColourCastLimits:
    """Limits of colour cast; warmth and green are shares of the brightness."""

    # A cast is one where so many times as much ground lies within `alike` of its surface as of one colour, and the
    # median deviation falls to this share. Five images without one: less than one of the two; six with one: 1.41 or
    # more, and 0.69 or less.
    gathered: float = 1.35
    nearer: float = 0.75
    alike: float = 0.05
    least: float = 0.15  # what the surface differs by over the ground
    fewest: int = 2000  # places
    slack: float = 0.005  # deviations below this weigh alike
    biweight: float = 0.08  # deviation from which a place is no road
    most: float = 0.35  # what a cast may be, so that no gain runs away where there is no ground
    rounds: int = 20


LIMITS = ColourCastLimits()

_TERMS = 6


@dataclass(frozen=True)
class ColourCast:
    """What warmth and green of grey ground are above their mean over the image, as surfaces.

    Attributes
    ----------
    x, y : middle, in the image's CRS.
    reach : in units of the CRS; the surfaces are of places less the middle, divided by this.
    warmth, green : six coefficients each: constant, x, y, x², xy, y².
    """

    x: float
    y: float
    reach: float
    warmth: tuple[float, ...]
    green: tuple[float, ...]

    @property
    def numbers(self) -> tuple[float, ...]:
        """All of it, for `of_numbers`."""
        return (self.x, self.y, self.reach, *self.warmth, *self.green)

    @classmethod
    def of_numbers(cls, numbers: list[float]) -> ColourCast:
        """From fifteen numbers."""
        return cls(*numbers[:3], tuple(numbers[3:3 + _TERMS]), tuple(numbers[3 + _TERMS:]))

    def evaluated(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Cast in warmth and green at places that go together, float32."""
        across, up = ((values - middle) / self.reach for values, middle in ((x, self.x), (y, self.y)))
        across, up = np.asarray(across, np.float32), np.asarray(up, np.float32)
        found = []
        for one in (self.warmth, self.green):
            constant, first, second, square, mixed, other = (np.float32(value) for value in one)
            surface = constant + across * (first + square * across) + up * (second + other * up) + mixed * across * up
            found.append(np.clip(surface, -LIMITS.most, LIMITS.most))
        return found[0], found[1]

    def removed(self, bands: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Bands (3 and more, rows, columns) without the cast; whole numbers stay whole. `x`, `y` of the pixels,
        (rows, columns) or what broadcasts to it."""
        warmth, green = self.evaluated(x, y)
        corrected = bands.copy()
        kind = bands.dtype
        for band, gain in enumerate((1 - green / 3 + warmth / 2, 1 + 2 * green / 3, 1 - green / 3 - warmth / 2)):
            values = bands[band] / gain
            if kind.kind in "iu":
                np.rint(values, out=values)
                np.minimum(values, np.iinfo(kind).max, out=values)
            corrected[band] = values
        return corrected


def colour_cast_of(ground: np.ndarray, texture: float) -> ColourCast | None:
    """Cast from (n, 5) texture, warmth, green, x and y of clear ground; None where there is none worth removing.

    Ground of at most that texture counts.
    """
    smooth = ground[ground[:, 0] <= texture]
    if len(smooth) < LIMITS.fewest:
        return None
    low, high = smooth[:, 3:].min(axis=0), smooth[:, 3:].max(axis=0)
    middle, reach = (low + high) / 2, float(np.max(high - low)) / 2
    if not reach > 0:
        return None
    across, up = ((smooth[:, 3:] - middle) / reach).T
    terms = np.column_stack((np.ones_like(across), across, up, across ** 2, across * up, up ** 2))
    warmth, green = (_surface(terms, smooth[:, band]) for band in (1, 2))
    if not warmth.any() and not green.any():
        return None
    return ColourCast(float(middle[0]), float(middle[1]), reach, tuple(map(float, warmth)), tuple(map(float, green)))


def _surface(terms: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Coefficients of what most of the values are above their median; zeros where one colour tells as much."""
    found = _robust_fit(terms, values)
    middle = np.median(values)
    before, after = np.abs(values - middle), np.abs(values - terms @ found)
    gathered = (after < LIMITS.alike).mean() >= LIMITS.gathered * (before < LIMITS.alike).mean()
    gathered &= np.ptp(terms @ found) >= LIMITS.least
    if not gathered or np.median(after) > LIMITS.nearer * np.median(before):
        return np.zeros_like(found)
    found[0] -= middle
    return found


def _robust_fit(terms: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Coefficients of most of the values, by weights that are told from the deviations again and again."""
    found = np.zeros(terms.shape[1])
    found[0] = np.median(values)
    for number in range(2 * LIMITS.rounds):
        off = np.abs(values - terms @ found)
        weight = 1 / np.maximum(off, LIMITS.slack)
        if number >= LIMITS.rounds:
            weight = np.maximum(1 - (off / LIMITS.biweight) ** 2, 0) ** 2
        scaled = terms * weight[:, None]
        found = np.linalg.solve(scaled.T @ terms + 1e-9 * weight.sum() * np.eye(terms.shape[1]), scaled.T @ values)
    return found
