"""Kinds of images, and faults of images, made of a photograph in which the truth is known.

Each kind is a function of red, green, blue (rows, columns, 3) uint8 and the pixel's side in m; random parts have fixed
seeds. What lies where is the same in all of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np


@dataclass(frozen=True)
class ImageKind:
    """A kind of image: what is done to the colours, and by how much the pixel's side is said to be larger."""

    change: Callable[[np.ndarray, float], np.ndarray]
    pixel_factor: float = 1.0


def _whole(image: np.ndarray) -> np.ndarray:
    return np.clip(np.rint(image), 0, 255).astype(np.uint8)


def _noise(shape: tuple[int, ...], sigma: float, seed: int = 7) -> np.ndarray:
    return np.random.default_rng(seed).normal(0, sigma, shape).astype(np.float32)


def _patches(shape: tuple[int, ...], pixel: float, size: float, seed: int = 3) -> np.ndarray:
    """Smooth random field of patches of a size in m, standard deviation 1, (rows, columns)."""
    rows, columns = (max(int(side * pixel / size) + 2, 2) for side in shape[:2])
    small = _noise((rows, columns), 1.0, seed)
    return cv2.resize(small, shape[1::-1], interpolation=cv2.INTER_CUBIC)


def as_it_is(image: np.ndarray, pixel: float) -> np.ndarray:
    """The photograph."""
    return image


def channels_swapped(image: np.ndarray, pixel: float) -> np.ndarray:
    """Blue, green, red."""
    return np.ascontiguousarray(image[..., ::-1])


def black_margin(image: np.ndarray, pixel: float) -> np.ndarray:
    """A quarter of the image, beyond a slanting border, is black without a no-data value."""
    rows, columns = np.indices(image.shape[:2], np.float32)
    margin = columns / image.shape[1] + 0.3 * rows / image.shape[0] < 0.4
    return np.where(margin[..., None], np.uint8(0), image)


def noisy(image: np.ndarray, pixel: float) -> np.ndarray:
    """Sensor noise of 20 grey values."""
    return _whole(image + _noise(image.shape, 20))


def night(image: np.ndarray, pixel: float) -> np.ndarray:
    """A tenth of the light, warm pools of lamps, noise of the sensor."""
    lamps = 0.08 + 0.12 * np.clip(_patches(image.shape, pixel, 25), 0, 1)
    return _whole(image * lamps[..., None] * np.float32([1.2, 1.0, 0.7]) + _noise(image.shape, 4))


def half_snow(image: np.ndarray, pixel: float) -> np.ndarray:
    """Snow with drifts lies over half of the image in patches."""
    cover = cv2.GaussianBlur((_patches(image.shape, pixel, 12) > 0).astype(np.float32), (0, 0), 0.4 / pixel)
    snow = 225 + 8 * _patches(image.shape, pixel, 1.5, 5)
    snow = np.repeat(snow[..., None], 3, axis=2) + _noise(image.shape, 3)
    return _whole(image + cover[..., None] * (snow - image))


def concrete_with_joints(image: np.ndarray, pixel: float) -> np.ndarray:
    """Ground as light as concrete, paint hardly lighter, light joints 0.12 m wide every 5 m."""
    light = 255 * (image / np.float32(255)) ** 0.4
    rows, columns = np.indices(image.shape[:2], np.float32)
    turn = np.deg2rad(20)
    across = (columns * np.cos(turn) + rows * np.sin(turn)) * pixel % 5
    along = (rows * np.cos(turn) - columns * np.sin(turn)) * pixel % 5
    joints = cv2.GaussianBlur(((across < 0.12) | (along < 0.12)).astype(np.float32), (0, 0), 0.7)
    return _whole(light + 45 * joints[..., None])


def blurred(image: np.ndarray, pixel: float) -> np.ndarray:
    """Out of focus by 0.3 m."""
    return cv2.GaussianBlur(image, (0, 0), 0.3 / pixel)


def over_exposed(image: np.ndarray, pixel: float) -> np.ndarray:
    """Twice the light and a half more."""
    return _whole(image.astype(np.float32) * 2.5)


def grey(image: np.ndarray, pixel: float) -> np.ndarray:
    """No colour."""
    return np.repeat(cv2.cvtColor(image, cv2.COLOR_RGB2GRAY)[..., None], 3, axis=2)


def infrared(image: np.ndarray, pixel: float) -> np.ndarray:
    """Near infrared, red and green shown as red, green and blue: leaves are bright in the first."""
    red, green, blue = np.moveaxis(image.astype(np.float32), -1, 0)
    leaves = np.clip(8 * (green - np.maximum(0.97 * red, blue)) / np.maximum(red + green + blue, 1), 0, 1)
    return _whole(np.stack([red * (1 + 1.2 * leaves), red, green], axis=-1))


def vignetted(image: np.ndarray, pixel: float) -> np.ndarray:
    """Half of the light at the corners, and a cast that turns from warm to cold across the image."""
    rows, columns = np.indices(image.shape[:2], np.float32)
    x, y = 2 * columns / image.shape[1] - 1, 2 * rows / image.shape[0] - 1
    light = 1 - 0.25 * (x * x + y * y)
    warm = 0.15 * x
    return _whole(image * np.stack([light * (1 + warm), light, light * (1 - warm)], axis=-1))


def sharpened(image: np.ndarray, pixel: float) -> np.ndarray:
    """As web tiles are: an unsharp mask of 1.5 pixels, once and a half over."""
    soft = cv2.GaussianBlur(image, (0, 0), 1.5).astype(np.float32)
    return _whole(image + 1.5 * (image - soft))


def wet(image: np.ndarray, pixel: float) -> np.ndarray:
    """Dark ground with patches that mirror the sky."""
    pools = np.clip(_patches(image.shape, pixel, 4, 11) - 0.8, 0, 1)[..., None]
    dark = 255 * (image / np.float32(255)) ** 1.5
    return _whole(dark * (1 - 0.6 * pools) + 0.6 * pools * np.float32([150, 155, 165]))


KINDS = {
    "as it is": ImageKind(as_it_is),
    "pixel said x 2": ImageKind(as_it_is, 2.0),
    "pixel said / 2": ImageKind(as_it_is, 0.5),
    "channels swapped": ImageKind(channels_swapped),
    "black margin": ImageKind(black_margin),
    "noise": ImageKind(noisy),
    "night": ImageKind(night),
    "half snow": ImageKind(half_snow),
    "concrete with joints": ImageKind(concrete_with_joints),
    "blur": ImageKind(blurred),
    "over-exposed": ImageKind(over_exposed),
    "grey": ImageKind(grey),
    "infrared": ImageKind(infrared),
    "vignetted": ImageKind(vignetted),
    "sharpened": ImageKind(sharpened),
    "wet": ImageKind(wet),
}
"""Kinds by name."""
