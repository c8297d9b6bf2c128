"""The image's own road: how rough, warm and bright its smooth grey ground in the light is.

A drone photo under clouds and a sharpened one in the sun differ by five times in the texture of the same asphalt, and
films, haze and cameras cast colours: limits are told from what the image itself shows.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np


@dataclass(frozen=True)
class RoadModelLimits:
    """Limits of road model, each with its unit."""

    lit: float = 0.6  # Times the median brightness: what is darker may be shade, whose texture says little.
    # Warmth and green, shares of the brightness, up to which ground may be a road in an image with a cast.
    grey: tuple[float, ...] = 0.35, 0.1
    smooth: float = 2.0  # Times the texture of smooth ground that a road's stays below.
    percentile: int = 15
    fewest: int = 100
    clear_of_paint: float = 0.2  # m
    texture_lag: float = 0.2  # m
    texture_box: float = 1.2  # m
    min_pairs: float = 0.02
    max_difference: float = 100.0  # grey values; keeps sums of squares whole


LIMITS = RoadModelLimits()


@dataclass(frozen=True)
class RoadModel:
    """Smooth grey ground of an image.

    Attributes
    ----------
    texture : that of its smoothest seventh, grey values after level adjustment, see `texture`.
    warmth, green : its median colour, shares of the brightness, see `colours_of`.
    brightness : its median, grey values after level adjustment.
    """

    texture: float = 0.0
    warmth: float = 0.0
    green: float = 0.0
    brightness: float = 0.0


def road_model_of(ground: Iterable[np.ndarray]) -> RoadModel:
    """Model from (n, 4) texture, warmth, green and brightness at places where ground is seen and no paint is near.

    With hardly any grey ground all of it stands for it; of no ground at all the model is that of a flat grey image.
    """
    rows = np.concatenate([np.empty((0, 4), np.float32), *ground])
    if not len(rows):
        return RoadModel()
    chosen = rows[lit_and_grey(rows)]
    if not len(chosen):
        chosen = rows
    rough = float(np.percentile(chosen[:, 0], LIMITS.percentile))
    _, warmth, green, brightness = np.median(chosen[chosen[:, 0] <= smooth_texture(chosen[:, 0])], axis=0)
    return RoadModel(rough, float(warmth), float(green), float(brightness))


def lit_and_grey(rows: np.ndarray) -> np.ndarray:
    """Which rows of `road_model_of` are ground in the light without much colour; with hardly any of it all that is lit,
    bool."""
    level = rows[:, 3]
    if not len(level):
        return np.zeros(0, bool)
    lit = level > LIMITS.lit * np.median(level)
    grey = lit & (np.abs(rows[:, 1]) < LIMITS.grey[0]) & (np.abs(rows[:, 2]) < LIMITS.grey[1])
    return grey if np.count_nonzero(grey) >= LIMITS.fewest else lit


def smooth_texture(texture: np.ndarray) -> float:
    """Texture up to which some ground counts as smooth."""
    return max(LIMITS.smooth * float(np.percentile(texture, LIMITS.percentile)), 1e-6)


def clear_of_paint(bright: np.ndarray, seen: np.ndarray, pixel: float) -> np.ndarray:
    """Where ground is seen and nothing bright is near, (rows, columns) uint8 of 0 and 1."""
    side = 2 * max(round(LIMITS.clear_of_paint / pixel), 1) + 1
    near = cv2.dilate(bright.view(np.uint8), cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side)))
    near ^= 1
    near &= seen.view(np.uint8)
    return near


def texture(image: np.ndarray, clear: np.ndarray, pixel: float) -> np.ndarray:
    """Standard deviation of brightness between pixels `texture_lag` metres apart, clear ground only; infinite where
    there is hardly any, (rows, columns) float32."""
    step = max(round(LIMITS.texture_lag / pixel), 1)
    squares, pairs = np.zeros_like(image), np.zeros_like(image)
    for one, other in ((np.s_[step:], np.s_[:-step]), (np.s_[:, step:], np.s_[:, :-step])):
        weight = clear[one] * clear[other]
        difference = image[one] - image[other]
        np.minimum(difference, LIMITS.max_difference, out=difference)
        np.maximum(difference, -LIMITS.max_difference, out=difference)
        difference *= difference
        np.rint(difference, out=difference)
        difference *= weight
        squares[one] += difference
        pairs[one] += weight
    found, pairs = (_box(values, LIMITS.texture_box, pixel) for values in (squares, pairs))
    few = pairs <= LIMITS.min_pairs
    pairs *= 2
    # Sums over boxes that run along leave rounding errors below 0.
    np.maximum(found, 0, out=found)
    found /= np.maximum(pairs, np.float32(1e-3), out=pairs)
    np.sqrt(found, out=found)
    found[few] = np.inf
    return found


def _box(values: np.ndarray, side: float, pixel: float) -> np.ndarray:
    """Mean over a box with a side in m."""
    pixels = max(round(side / pixel) | 1, 3)
    return cv2.blur(values, (pixels, pixels), borderType=cv2.BORDER_REPLICATE)


def colours_of(bands: np.ndarray, weight: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Warmth (red - blue) and green (less the mean of red and blue) as shares of the brightness, over 3 x 3 pixels
    (5 x 5 of those with a weight, 0 or 1), because JPEG spreads colours; (rows, columns) float32 each."""
    if weight is None:
        return shares_of_colour(*(mean_over(band, 3) for band in bands[:3]))
    share = np.maximum(mean_over(weight, 5), np.float32(1e-3))
    weight = weight.astype(bands.dtype)
    colours = [mean_over(band * weight, 5) for band in bands[:3]]
    for colour in colours:
        colour /= share
    return shares_of_colour(*colours)


def mean_over(band: np.ndarray, side: int) -> np.ndarray:
    """Mean of a band over so many pixels each way, (rows, columns) float32."""
    band = band if band.dtype == np.uint8 else band.astype(np.float32)
    return cv2.boxFilter(band, cv2.CV_32F, (side, side), borderType=cv2.BORDER_REPLICATE)


def shares_of_colour(red: np.ndarray, green: np.ndarray, blue: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Warmth and green of colours, which are used up."""
    brightness = red + green
    brightness += blue
    brightness /= 3
    np.maximum(brightness, np.float32(1e-3), out=brightness)
    other = red + blue
    other /= 2
    green -= other
    green /= brightness
    red -= blue
    red /= brightness
    return red, green
