"""The image's own road: how rough, warm and bright its smooth grey ground in the light is.

A drone photo under clouds and a sharpened one in the sun differ by five times in the texture of the same asphalt, and
films, haze and cameras cast colours: limits are told from what the image itself shows.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

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


LIMITS = RoadModelLimits()


@dataclass(frozen=True)
class RoadModel:
    """Smooth grey ground of an image.

    Attributes
    ----------
    texture : that of its smoothest seventh, grey values after level adjustment, see `marking_confidence.texture`.
    warmth, green : its median colour, shares of the brightness, see `marking_confidence.colours_of`.
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
