"""What looks like the surface of the road: grey and as bright as what lies between the road's own lines."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.ndimage import median_filter

from ...geometry.tolerances import LEAST_DIVISOR
from .straight_photo import StraightPhoto

# Scatter of log brightness, warmth and green of a surface that is taken for the least, shares.
FLOOR = 0.05, 0.015, 0.012
QUANTILE = 0.3  # The scatter is taken from the nearer ones: paint and vehicles lie on the road too.
OWN = 4.0  # Times the scatter up to which a pixel between the lines tells of the road's brightness.
BRIGHT = 1.6  # The same for the brightness, times that of all roads of the image.
LIKE = 9.0  # Squared distance at which a pixel is as well road as not.
SHADE = 0.72  # What is darker, times the road's brightness, may be road in shade: it tells nothing.
GREEN = 6.0  # Times the scatter from which a pixel is green: crowns hang over roads,
CROWN = 0.4  # so it speaks against the road by such a share only.
ALONG = 12.0  # Brightness is that of so many metres along the road: light changes, vehicles are shorter.

_NORMAL = 0.385  # the quantile 0.3 of the size of a standard normal


def surface_features(colours: np.ndarray) -> np.ndarray:
    """Log brightness, warmth (red less blue) and green (less the others), (..., 3), the last two by brightness."""
    level = colours.mean(axis=-1)
    usual = float(np.nanmedian(level)) if np.isfinite(level).any() else 1.0
    level = np.maximum(level, 0.0) + max(0.01 * usual, LEAST_DIVISOR)
    red, green, blue = np.moveaxis(colours, -1, 0)
    return np.stack([np.log(level), (red - blue) / level, (green - (red + blue) / 2.0) / level], axis=-1)


def surface_model(samples: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Middle and scatter (3,) of the features of roads, from pixels (n, 3) between lines."""
    rows = np.concatenate([one[np.isfinite(one).all(axis=1)] for one in samples])
    middle = np.median(rows, axis=0)
    scatter = np.quantile(np.abs(rows - middle), QUANTILE, axis=0) / _NORMAL
    return middle, np.maximum(scatter, FLOOR)


def road_likeness(photo: StraightPhoto, inside: np.ndarray, model: tuple[np.ndarray, np.ndarray]
                  ) -> tuple[np.ndarray, np.ndarray]:
    """How much each pixel (n, m) looks like road: 1 as the road itself, -1 not at all, 0 where nothing tells; and its
    log brightness above the road's there.

    Parameters
    ----------
    inside : (n, m) bool, pixels between the road's lines.
    model : of the roads of the whole image, see `surface_model`.
    """
    features, (middle, scatter) = surface_features(photo.colours), model
    far = np.abs(features - middle) / scatter
    own = inside & (far[..., 1:] < OWN).all(axis=-1) & \
        (np.abs(features[..., 0] - middle[0]) < np.log(BRIGHT))
    level = np.array([np.median(row[mask]) if mask.any() else middle[0] for row, mask in zip(features[..., 0], own)])
    rows = int(ALONG / (photo.chainage[1] - photo.chainage[0])) | 1
    lit = features[..., 0] - median_filter(level, rows, mode="nearest")[:, None]
    squared = ((lit / scatter[0]) ** 2 + (far[..., 1:] ** 2).sum(axis=-1)) / 2.0
    like = np.clip(1.0 - squared / LIKE, -1.0, 1.0)
    like = np.where(lit < np.log(SHADE), 0.0, like)
    green = (features[..., 2] - middle[2] > GREEN * scatter[2]) & (like < 0)
    like = np.where(green, CROWN * like, like)
    return np.where(np.isfinite(features).all(axis=-1), like, 0.0), lit
