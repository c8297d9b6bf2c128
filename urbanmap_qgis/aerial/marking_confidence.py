"""How surely a bright narrow thing is paint on a road: by the ground beside it and by its own contrast.

Paint lies on asphalt or concrete, which is smooth, grey and wide; grass, earth, leaves and shingle are not. All of it
has bounded reach (`REACH`), so that large images can be worked on in tiles.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np


@dataclass(frozen=True)
class ConfidenceSettings:
    """What the ground beside paint is like. Each pair is a ramp: no confidence at the first value, full at the second.

    The values were tuned on three drone photographs (SiteB, SiteD, SiteF of The-DRIFT) and the labels of a fourth.

    Parameters
    ----------
    max_texture : standard deviation over `texture_lag`, grey values after level adjustment, that smooth ground has at
    most; in noisy images `noise_factor` times the image's own noise.
    max_warmth, max_green : (red - blue) and |green - mean of red and blue| as shares of the brightness that grey ground
    has at most.
    max_step : difference from the mean brightness of such ground within 4 m, as a share of it.
    beside : share of smooth grey ground within 0.7 m of the paint. around : the same within 5 m.
    both_sides : the same on the poorer of two opposite sides, 0.8 m away: kerbs, rails, roof edges and banks have a
    road on one side only. worn : times the limits above for that ground: cracks and worn strips. open_ground : as a
    share of all ground; it stands in for `beside` where all is too near to paint to be looked at.
    contrast : of the top-hat, in thresholds; `faint` is the confidence at the first, as worn paint lies there.
    warmer : how much warmer than the ground paint is: white is neutral, yellow warm, asphalt never warmer than either.
    blue_contrast, blue : contrast and (blue - red) as a share of the brightness from which it may be bluer than the
    ground, as lines of bus lanes are; less is glass or metal.
    """

    max_texture: float = 5.0
    noise_factor: float = 3.0
    texture_lag: float = 0.2
    max_warmth: float = 0.06
    max_green: float = 0.07
    max_step: float = 0.5
    worn: float = 1.2
    beside: tuple[float, float] = (0.1, 0.5)
    both_sides: tuple[float, float] = (0.2, 0.55)
    around: tuple[float, float] = (0.25, 0.6)
    open_ground: tuple[float, float] = (0.15, 0.5)
    contrast: tuple[float, float] = (1.4, 4.0)
    faint: float = 0.4
    warmer: tuple[float, float] = (-0.06, -0.01)
    blue_contrast: tuple[float, float] = (4.5, 7.0)
    blue: tuple[float, float] = (0.1, 0.15)


REACH = 14.0
"""m round a pixel that its confidence depends on: half the boxes below, one after the other."""

_CLEAR_OF_PAINT = 0.2
_TEXTURE_BOX, _BRIGHTNESS_BOX, _AROUND_BOX, _BESIDE_BOX, _BESIDE, _MEAN_BOX = 1.2, 8.0, 10.0, 2.4, 0.7, 2.5
_SIDE, _SIDE_BOX = 0.8, 0.6
_STEP_SLACK = 6  # grey values: dark ground may differ by these whatever its share
_MIN_PAIRS = 0.02
_MAX_DIFFERENCE = 100.0  # grey values; keeps sums of squares whole
_PRIOR = np.float32(0.03)  # share of the box that weighs as much as the stand-in
_SIDE_PRIOR = np.float32(0.1)  # the same for a side, whose box is small


@dataclass(frozen=True)
class GroundBeside:
    """The ground round markings; all (rows, columns).

    Attributes
    ----------
    clear : float32, 1 where ground is seen and no bright thing is near. even : float32, 1 where that may be a worn
        road. smooth : float32, 1 where it is smooth, grey and about as bright as such ground around.
    brightness : float32, mean of the smooth ground within 4 m.
        warmth : likewise; None for grey images.
    """

    clear: np.ndarray
    even: np.ndarray
    smooth: np.ndarray
    brightness: np.ndarray
    warmth: np.ndarray | None


def texture(image: np.ndarray, clear: np.ndarray, pixel: float, lag: float) -> np.ndarray:
    """Standard deviation of brightness between pixels `lag` metres apart, clear ground only; infinite where there is
    hardly any, (rows, columns) float32."""
    step = max(round(lag / pixel), 1)
    squares, pairs = np.zeros_like(image), np.zeros_like(image)
    for one, other in ((np.s_[step:], np.s_[:-step]), (np.s_[:, step:], np.s_[:, :-step])):
        weight = clear[one] * clear[other]
        difference = np.clip(image[one] - image[other], -_MAX_DIFFERENCE, _MAX_DIFFERENCE)
        squares[one] += np.rint(difference * difference) * weight
        pairs[one] += weight
    squares, pairs = (_box(values, _TEXTURE_BOX, pixel) for values in (squares, pairs))
    # Sums over boxes that run along leave rounding errors below 0.
    found = np.sqrt(np.maximum(squares, 0) / np.maximum(2 * pairs, np.float32(1e-3)))
    return np.where(pairs > _MIN_PAIRS, found, np.float32(np.inf))


def clear_of_paint(bright: np.ndarray, seen: np.ndarray, pixel: float) -> np.ndarray:
    """Where ground is seen and nothing bright is near, (rows, columns) float32 of 0 and 1."""
    side = 2 * max(round(_CLEAR_OF_PAINT / pixel), 1) + 1
    near = cv2.dilate(bright.astype(np.uint8), cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side)))
    return (seen & (near == 0)).astype(np.float32)


def ground_beside(bands: np.ndarray, image: np.ndarray, road: np.ndarray, bright: np.ndarray, seen: np.ndarray,
                  pixel: float, noise: float, settings: ConfidenceSettings) -> GroundBeside:
    """The smooth grey ground of a piece of image.

    Parameters
    ----------
    bands : (1 or 3 and more, rows, columns), red, green, blue first. image : levelled brightness. road : the same
    without what is as narrow as paint. bright : bool, what may be paint. seen : bool. noise : texture of the image's
    smoothest ground.
    """
    clear = clear_of_paint(bright, seen, pixel)
    rough = texture(image, clear, pixel, settings.texture_lag)
    limit = max(settings.max_texture, settings.noise_factor * noise)
    smooth, even = clear * (rough < limit), clear * (rough < settings.worn * limit)
    warmth = None
    if len(bands) >= 3:
        warmth, green = colours_of(bands, clear)
        smooth *= (warmth < settings.max_warmth) & (np.abs(green) < settings.max_green)
        even *= (warmth < settings.worn * settings.max_warmth) & (np.abs(green) < settings.worn * settings.max_green)
    mean = _mean_where(road, smooth, _BRIGHTNESS_BOX, pixel)
    smooth *= np.abs(road - mean) < settings.max_step * np.abs(mean) + _STEP_SLACK
    mean = _mean_where(road, smooth, _BRIGHTNESS_BOX, pixel)
    if warmth is not None:
        warmth = _mean_where(warmth, smooth, _BRIGHTNESS_BOX, pixel, 200)
    return GroundBeside(clear, even, smooth, mean, warmth)


def colours_of(bands: np.ndarray, weight: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Warmth (red - blue) and green (less the mean of red and blue) as shares of the brightness, over 3 x 3 pixels
    (5 x 5 of those with a weight), because JPEG spreads colours; (rows, columns) float32 each."""
    red, green, blue = (band.astype(np.float32) for band in bands[:3])
    if weight is None:
        red, green, blue = (cv2.blur(band, (3, 3), borderType=cv2.BORDER_REPLICATE) for band in (red, green, blue))
    else:
        share = np.maximum(cv2.blur(weight, (5, 5), borderType=cv2.BORDER_REPLICATE), np.float32(1e-3))
        red, green, blue = (cv2.blur(band * weight, (5, 5), borderType=cv2.BORDER_REPLICATE) / share
                            for band in (red, green, blue))
    brightness = np.maximum((red + green + blue) / 3, np.float32(1e-3))
    return (red - blue) / brightness, (green - (red + blue) / 2) / brightness


def marking_confidence(core: np.ndarray, bands: np.ndarray, relief: np.ndarray, ground: GroundBeside,
                       roads: np.ndarray | None, pixel: float, settings: ConfidenceSettings) -> np.ndarray:
    """Confidence, 0 to 1, that bright pixels are paint on a road, (rows, columns) float32.

    Without known roads it is 0 where no bright pixel is: bright ones are few, and only they are worked out.

    Parameters
    ----------
    core : bool, pixels that may be paint. relief : their top-hat in thresholds. ground : round them. roads : bool,
    known roads, in which the ground needs no proof; None for unknown.
    """
    if roads is not None:
        return 0.5 + 0.5 * _ramp(relief, settings.contrast)
    inside = np.flatnonzero(core)
    relief = relief.take(inside)
    confidence = settings.faint + (1 - settings.faint) * _ramp(relief, settings.contrast)
    if ground.warmth is not None:
        warmth = colours_of(bands)[0].take(inside)
        blue = np.minimum(_ramp(relief, settings.blue_contrast), _ramp(-warmth, settings.blue))
        confidence *= np.maximum(_ramp(warmth - ground.warmth.take(inside), settings.warmer), blue)
    confidence *= _on_road(core, inside, ground, pixel, settings)
    made = np.zeros(core.shape, np.float32)
    made.ravel()[inside] = confidence
    return made


def _on_road(core: np.ndarray, inside: np.ndarray, ground: GroundBeside, pixel: float, settings: ConfidenceSettings
             ) -> np.ndarray:
    """Confidence (n,) that bright pixels, `inside` by their place in the flat image, lie on a road, by the smooth grey
    ground beside and around them."""
    side = 2 * max(round(_BESIDE / pixel), 1) + 1
    ring = cv2.dilate(core.astype(np.uint8), cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))) > 0
    ring = ring * ground.clear

    def near(values: np.ndarray, side: float) -> np.ndarray:
        return _box(values, side, pixel).take(inside)

    smooth = near(ground.smooth, _AROUND_BOX)
    around = smooth / np.maximum(near(ground.clear, _AROUND_BOX), np.float32(0.05))
    # Between the bars of a crossing no ground is clear: smooth ground around then stands in for what lies beside.
    stand_in = _ramp(smooth, settings.open_ground)
    beside = ((near(ring * ground.smooth, _BESIDE_BOX) + _PRIOR * stand_in) / (near(ring, _BESIDE_BOX) + _PRIOR))
    sides = _poorer_side(inside, ground, stand_in, pixel)
    return _ramp(beside, settings.beside) * _ramp(around, settings.around) * _ramp(sides, settings.both_sides)


def _poorer_side(inside: np.ndarray, ground: GroundBeside, stand_in: np.ndarray, pixel: float) -> np.ndarray:
    """Share (n,) of smooth ground on the poorer of two opposite sides of bright pixels, in the best of four directions.

    Across a line on a road both sides are road; no direction has that at a kerb. `inside` : see `_on_road`.
    `stand_in` : (n,) share for sides where all is too near to paint.
    """
    height, width = ground.clear.shape
    rows, columns = np.divmod(inside, width)
    even, clear = (_box(values, _SIDE_BOX, pixel) for values in (ground.even, ground.clear))
    stand_in = _SIDE_PRIOR * stand_in
    best = np.zeros(len(inside), np.float32)
    for angle in np.deg2rad((0, 45, 90, 135)):
        down, across = round(_SIDE * np.sin(angle) / pixel), round(_SIDE * np.cos(angle) / pixel)
        sides = []
        for sign in (1, -1):
            place = (np.clip(rows + sign * down, 0, height - 1) * width
                     + np.clip(columns + sign * across, 0, width - 1))
            sides.append((even.take(place) + stand_in) / (clear.take(place) + _SIDE_PRIOR))
        best = np.maximum(best, np.minimum(*sides))
    return best


def along_strokes(confidence: np.ndarray, core: np.ndarray, pixel: float) -> np.ndarray:
    """Mean of the confidence over the bright pixels within 1.25 m, for strokes too long to be judged as one."""
    return _mean_where(confidence, core.astype(np.float32), _MEAN_BOX, pixel, 255)


def _ramp(values: np.ndarray, ends: tuple[float, float]) -> np.ndarray:
    low, high = ends
    return np.clip((values - np.float32(low)) / np.float32(high - low), 0, 1)


def _box(values: np.ndarray, side: float, pixel: float) -> np.ndarray:
    """Mean over a box with a side in m. Whole numbers are given: their running sums are exact, and so the result does
    not depend on where a tile begins."""
    pixels = max(round(side / pixel) | 1, 3)
    return cv2.blur(values, (pixels, pixels), borderType=cv2.BORDER_REPLICATE)


def _mean_where(values: np.ndarray, weight: np.ndarray, side: float, pixel: float, steps: int = 1) -> np.ndarray:
    """Mean of the values with a weight of 0 or 1 over a box; 0 where there are none. Values count in 1 / `steps`."""
    total = _box(np.rint(values * np.float32(steps)) * weight, side, pixel)
    return total / np.float32(steps) / np.maximum(_box(weight, side, pixel), np.float32(1e-4))
