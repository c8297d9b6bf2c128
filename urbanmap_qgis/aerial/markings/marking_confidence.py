"""How surely a bright narrow thing is paint on a road: by the ground beside it and by its own contrast.

Paint lies on asphalt or concrete, which is smooth, grey and wide; grass, earth, leaves and shingle are not. All of it
has bounded reach, so that large images can be worked on in tiles.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from .image_strips import STRIP, row_strips
from .road_model import RoadModel


@dataclass(frozen=True)
class ConfidenceSettings:
    """What the ground beside paint is like. Each pair is a ramp: no confidence at the first value, full at the second.

    The values were tuned on three drone photographs (SiteB, SiteD, SiteF of The-DRIFT) and the labels of a fourth.

    Parameters
    ----------
    texture_factor, texture_less : standard deviation over `texture_lag`, grey values after level adjustment, that
        smooth ground has at most: so many times that of the image's own road, less so much; `min_texture` where that is
        less, as in soft light.
    max_warmth, max_green : (red - blue) and |green - mean of red and blue| as shares of the brightness that grey ground
        has at most.
    warmer_than_road : in hard light, where that texture is exceeded, it may be warmer than the image's own road by so
        much.
    max_step : difference from the mean brightness of such ground within 4 m, as a share of it.
    beside : share of smooth grey ground within 0.7 m of the paint.
    around : the same within 5 m.
    both_sides : the same on the poorer of two opposite sides, 0.8 m away: kerbs, rails, roof edges and banks have a
        road on one side only.
    worn : times the limits above for that ground: cracks and worn strips.
    open_ground : as a share of all ground; it stands in for `beside` where all is too near to paint to be looked at.
    contrast : of the top-hat, in thresholds; `faint` is the confidence at the first, as worn paint lies there.
    warmer : how much warmer than the ground paint is: white is neutral, yellow warm, asphalt never warmer than either.
    blue_contrast, blue : contrast and (blue - red) as a share of the brightness from which it may be bluer than the
        ground, as lines of bus lanes are; less is glass or metal.
    surely : confidence from which only its colour speaks against paint.
    """

    texture_factor: float = 3.5
    texture_less: float = 5.0
    min_texture: float = 5.0
    texture_lag: float = 0.2
    max_warmth: float = 0.06
    warmer_than_road: float = 0.12
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
    surely: float = 0.5

    def max_texture(self, model: RoadModel) -> float:
        """Texture that smooth ground of an image has at most, grey values after level adjustment."""
        return max(self.min_texture, self.texture_factor * model.texture - self.texture_less)

    def hard_light(self, model: RoadModel) -> bool:
        """Whether an image's own road is as rough as in hard light or sharpened images."""
        return self.max_texture(model) > self.min_texture


GROUND_REACH = 9.2
"""m round a pixel that the ground beside it is told by: half the boxes below for its texture and, twice, brightness."""


@dataclass(frozen=True)
class MarkingConfidenceLimits:
    """Limits of marking confidence, each with its unit."""

    clear_of_paint: float = 0.2
    texture_box: float = 1.2
    brightness_box: float = 8.0
    around_box: float = 10.0
    beside_box: float = 2.4
    beside: float = 0.7
    mean_box: float = 2.5
    side: float = 0.8
    side_box: float = 0.6
    # m round a pixel that it is judged by, ground given: the largest of the boxes, halved, and slack
    reach_round: float = 6.0
    step_slack: int = 6  # grey values: dark ground may differ by these whatever its share
    min_pairs: float = 0.02
    max_difference: float = 100.0  # grey values; keeps sums of squares whole


LIMITS = MarkingConfidenceLimits()

ALONG_REACH = LIMITS.mean_box / 2
"""m round a pixel of a long piece over which its confidence is a mean."""

_PRIOR = np.float32(0.03)  # share of the box that weighs as much as the stand-in
_SIDE_PRIOR = np.float32(0.1)  # the same for a side, whose box is small

_SHADES = np.float32(200)  # steps of warmth in 1: whole numbers are summed


@dataclass(frozen=True)
class GroundBeside:
    """The ground round markings; all (rows, columns).

    Attributes
    ----------
    clear : uint8, 1 where ground is seen and no bright thing is near.
    even : uint8, 1 where that may be a worn road.
    smooth : uint8, 1 where it is smooth, grey and about as bright as such ground around.
    brightness : float32, mean of the smooth ground within 4 m.
    shades : int16, warmth of the ground in `_SHADES`; None for grey images.
    """

    clear: np.ndarray
    even: np.ndarray
    smooth: np.ndarray
    brightness: np.ndarray
    shades: np.ndarray | None

    def rows(self, rows: slice) -> GroundBeside:
        """That of some rows."""
        return GroundBeside(*(None if values is None else values[rows] for values in (
            self.clear, self.even, self.smooth, self.brightness, self.shades)))


def texture(image: np.ndarray, clear: np.ndarray, pixel: float, lag: float) -> np.ndarray:
    """Standard deviation of brightness between pixels `lag` metres apart, clear ground only; infinite where there is
    hardly any, (rows, columns) float32."""
    step = _lag_pixels(lag, pixel)
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


def _lag_pixels(lag: float, pixel: float) -> int:
    return max(round(lag / pixel), 1)


def clear_of_paint(bright: np.ndarray, seen: np.ndarray, pixel: float) -> np.ndarray:
    """Where ground is seen and nothing bright is near, (rows, columns) float32 of 0 and 1."""
    return _clear(bright, seen, pixel).astype(np.float32)


def _clear(bright: np.ndarray, seen: np.ndarray, pixel: float) -> np.ndarray:
    """The same as uint8."""
    side = 2 * max(round(LIMITS.clear_of_paint / pixel), 1) + 1
    near = cv2.dilate(bright.view(np.uint8), cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side)))
    near ^= 1
    near &= seen.view(np.uint8)
    return near


def ground_beside(bands: np.ndarray, image: np.ndarray, road: np.ndarray, bright: np.ndarray, seen: np.ndarray,
                  pixel: float, model: RoadModel, settings: ConfidenceSettings) -> GroundBeside:
    """The smooth grey ground of a piece of image.

    Parameters
    ----------
    bands : (1 or 3 and more, rows, columns), red, green, blue first.
    image : levelled brightness.
    road : the same without what is as narrow as paint.
    bright : bool, what may be paint.
    seen : bool.
    model : the image's own road.
    """
    clear = _clear(bright, seen, pixel)
    smooth, even, shades = _grey_and_smooth(bands, image, clear, pixel, model, settings)
    smooth = _as_bright_as_around(road, smooth, pixel, settings)
    brightness = np.empty(road.shape, np.float32)
    for strip, wide, inner in row_strips(len(road), _box_pixels(LIMITS.brightness_box, pixel) // 2, 2 * STRIP):
        weight = smooth[wide].astype(np.float32)
        brightness[strip] = _mean_with(np.rint(road[wide]), weight, _share_of(weight, pixel), pixel)[inner]
    return GroundBeside(clear, even, smooth, brightness, shades)


def _grey_and_smooth(bands: np.ndarray, image: np.ndarray, clear: np.ndarray, pixel: float, model: RoadModel,
                     settings: ConfidenceSettings) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Clear ground with a texture below the limit and without colour, likewise with wider limits, uint8 (rows,
    columns); its warmth in whole shades, int16, None for grey images."""
    smooth, even = np.empty_like(clear), np.empty_like(clear)
    shades = np.empty(clear.shape, np.int16) if len(bands) >= 3 else None
    halo = _box_pixels(LIMITS.texture_box, pixel) // 2 + _lag_pixels(settings.texture_lag, pixel)
    limit = settings.max_texture(model)
    warmest = max(settings.max_warmth, model.warmth + settings.warmer_than_road)
    for strip, wide, inner in row_strips(len(clear), max(halo, 2)):
        weight = clear[wide].astype(np.float32)
        rough = texture(image[wide], weight, pixel, settings.texture_lag)[inner]
        calm, fair = rough < limit, rough < settings.worn * limit
        if shades is not None:
            warmth, green = (values[inner] for values in colours_of(bands[:, wide], weight))
            np.abs(green, out=green)
            calm &= warmth < warmest
            calm &= green < settings.max_green
            fair &= warmth < settings.worn * warmest
            fair &= green < settings.worn * settings.max_green
            warmth *= _SHADES
            np.rint(warmth, out=warmth)
            shades[strip] = np.maximum(warmth, np.float32(-32000), out=warmth)  # the colder ones are no ground
        np.bitwise_and(clear[strip], calm.view(np.uint8), out=smooth[strip])
        np.bitwise_and(clear[strip], fair.view(np.uint8), out=even[strip])
    return smooth, even, shades


def _as_bright_as_around(road: np.ndarray, smooth: np.ndarray, pixel: float, settings: ConfidenceSettings
                         ) -> np.ndarray:
    """Smooth ground that is about as bright as the mean of such ground within 4 m, uint8."""
    ground = np.empty_like(smooth)
    for strip, wide, inner in row_strips(len(road), _box_pixels(LIMITS.brightness_box, pixel) // 2, 2 * STRIP):
        weight = smooth[wide].astype(np.float32)
        mean = _mean_with(np.rint(road[wide]), weight, _share_of(weight, pixel), pixel)[inner]
        difference = road[strip] - mean
        np.abs(difference, out=difference)
        np.abs(mean, out=mean)
        mean *= settings.max_step
        mean += LIMITS.step_slack
        np.bitwise_and(smooth[strip], (difference < mean).view(np.uint8), out=ground[strip])
    return ground


def _share_of(weight: np.ndarray, pixel: float) -> np.ndarray:
    """Share of what has a weight within 4 m, to divide by."""
    share = _box(weight, LIMITS.brightness_box, pixel)
    return np.maximum(share, np.float32(1e-4), out=share)


def _mean_with(values: np.ndarray, weight: np.ndarray, share: np.ndarray, pixel: float,
               steps: np.float32 | None = None) -> np.ndarray:
    """Mean of whole numbers (changed by this) with a weight of 0 or 1 within 4 m, in units of `steps`; `share` of it
    from `_share_of`."""
    values *= weight
    total = _box(values, LIMITS.brightness_box, pixel)
    if steps is not None:
        total /= steps
    total /= share
    return total


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


def marking_confidence(core: np.ndarray, bands: np.ndarray, relief: np.ndarray, ground: GroundBeside,
                       roads: np.ndarray | None, pixel: float, settings: ConfidenceSettings,
                       wanted: tuple[slice, slice] | None = None, colder: np.ndarray | None = None) -> np.ndarray:
    """Confidence, 0 to 1, that bright pixels are paint on a road, (n,) float32 in the order of `core[wanted]`'s.

    Bright pixels are few, and only they are worked out.

    Parameters
    ----------
    core : bool, pixels that may be paint.
    relief : (n,) their top-hat in thresholds.
    ground : round them.
    roads : bool, known roads, in which the ground needs no proof; None for unknown.
    wanted : rows and columns, by default all; what they depend on lies within 6 m of them.
    colder : (n,) bool, is set where all but the colour speaks for paint: where it is bluer than the ground.
    """
    if roads is not None:
        return np.float32(0.5) + np.float32(0.5) * _ramp(relief, settings.contrast)
    wanted = wanted or (slice(0, core.shape[0]), slice(0, core.shape[1]))
    halo = math.ceil(LIMITS.reach_round / pixel) + 2
    confidence, done = np.empty(len(relief), np.float32), 0
    for strip, _, _ in row_strips(wanted[0].stop - wanted[0].start, 0, 3 * STRIP):
        rows = slice(strip.start + wanted[0].start, strip.stop + wanted[0].start)
        wide = slice(max(rows.start - halo, 0), min(rows.stop + halo, len(core)))
        row, column = _places(core[rows, wanted[1]])
        row += rows.start - wide.start
        column += wanted[1].start
        part = slice(done, done + len(row))
        found, colour = _confidence_at(row, column, core[wide], bands[:, wide], relief[part], ground.rows(wide), pixel,
                                       settings)
        confidence[part] = found * colour
        if colder is not None:
            np.logical_and(found > settings.surely, colour < 0.5, out=colder[part])
        done = part.stop
    return confidence


def _places(flags: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows and columns of the flags set; as `np.nonzero`, in a fifth of the time."""
    return np.divmod(np.flatnonzero(np.ascontiguousarray(flags)), flags.shape[1])


def _confidence_at(rows: np.ndarray, columns: np.ndarray, core: np.ndarray, bands: np.ndarray, relief: np.ndarray,
                   ground: GroundBeside, pixel: float, settings: ConfidenceSettings) -> tuple[np.ndarray, np.ndarray]:
    """Confidence (n,) of bright pixels at rows and columns of a strip, but for their colour, and by that."""
    confidence = contrast_confidence(relief, settings)
    if ground.shades is not None:
        inside = rows * bands.shape[2] + columns
        warmth = shares_of_colour(*(mean_over(band, 3).take(inside) for band in bands[:3]))[0]
        blue = np.minimum(_ramp(relief, settings.blue_contrast), _ramp(-warmth, settings.blue))
        warmer = warmth - _warmth_of_ground(ground, rows, columns, pixel)
        colour = np.maximum(_ramp(warmer, settings.warmer), blue)
    else:
        colour = np.ones_like(confidence)
    confidence *= _on_road(core, rows, columns, ground, pixel, settings)
    return confidence, colour


def contrast_confidence(relief: np.ndarray, settings: ConfidenceSettings) -> np.ndarray:
    """Confidence (n,) by how far bright pixels stand out alone, by their top-hats in thresholds."""
    return settings.faint + (1 - settings.faint) * _ramp(relief, settings.contrast)


def _warmth_of_ground(ground: GroundBeside, rows: np.ndarray, columns: np.ndarray, pixel: float) -> np.ndarray:
    """Mean warmth (n,) of the smooth ground within 4 m of pixels."""
    inside = rows * ground.smooth.shape[1] + columns
    share = _share_at(ground.smooth, LIMITS.brightness_box, pixel, inside)
    total = _share_at(ground.shades * ground.smooth, LIMITS.brightness_box, pixel, inside)
    total /= _SHADES
    total /= np.maximum(share, np.float32(1e-4))
    return total


def _on_road(core: np.ndarray, rows: np.ndarray, columns: np.ndarray, ground: GroundBeside, pixel: float,
             settings: ConfidenceSettings) -> np.ndarray:
    """Confidence (n,) that bright pixels at rows and columns lie on a road, by the smooth grey ground beside and around
    them."""
    side = 2 * max(round(LIMITS.beside / pixel), 1) + 1
    ring = cv2.dilate(core.view(np.uint8), cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side)))
    ring &= ground.clear
    inside = rows * core.shape[1] + columns

    def near(flags: np.ndarray, side: float) -> np.ndarray:
        return _share_at(flags, side, pixel, inside)

    smooth = near(ground.smooth, LIMITS.around_box)
    around = smooth / np.maximum(near(ground.clear, LIMITS.around_box), np.float32(0.05))
    # Between the bars of a crossing no ground is clear: smooth ground around then stands in for what lies beside.
    stand_in = _ramp(smooth, settings.open_ground)
    beside = ((near(ring & ground.smooth, LIMITS.beside_box) + _PRIOR * stand_in)
              / (near(ring, LIMITS.beside_box) + _PRIOR))
    sides = _poorer_side(rows, columns, ground, stand_in, pixel)
    return _ramp(beside, settings.beside) * _ramp(around, settings.around) * _ramp(sides, settings.both_sides)


def _share_at(values: np.ndarray, side: float, pixel: float, inside: np.ndarray) -> np.ndarray:
    """Mean (n,) of small whole numbers over a box with a side in m round pixels, by their place in the flat image; as
    `_box` has it."""
    return _as_mean(_totals(values, side, pixel).take(inside), side, pixel)


def _totals(values: np.ndarray, side: float, pixel: float) -> np.ndarray:
    """Sums over a box with a side in m, (rows, columns) float32."""
    pixels = _box_pixels(side, pixel)
    return cv2.boxFilter(values, cv2.CV_32F, (pixels, pixels), normalize=False, borderType=cv2.BORDER_REPLICATE)


def _as_mean(totals: np.ndarray, side: float, pixel: float) -> np.ndarray:
    return (totals.astype(np.float64) * (1.0 / _box_pixels(side, pixel) ** 2)).astype(np.float32)


def _poorer_side(rows: np.ndarray, columns: np.ndarray, ground: GroundBeside, stand_in: np.ndarray, pixel: float
                 ) -> np.ndarray:
    """Share (n,) of smooth ground on the poorer of two opposite sides of bright pixels, in the best of four directions.

    Across a line on a road both sides are road; no direction has that at a kerb.

    Parameters
    ----------
    rows, columns : of the pixels.
    stand_in : (n,) share for sides where all is too near to paint.
    """
    height, width = ground.clear.shape
    even, clear = (_as_mean(_totals(flags, LIMITS.side_box, pixel), LIMITS.side_box, pixel)
                   for flags in (ground.even, ground.clear))
    stand_in = _SIDE_PRIOR * stand_in
    best = np.zeros(len(rows), np.float32)
    for angle in np.deg2rad((0, 45, 90, 135)):
        down, across = round(LIMITS.side * np.sin(angle) / pixel), round(LIMITS.side * np.cos(angle) / pixel)
        sides = []
        for sign in (1, -1):
            place = (np.clip(rows + sign * down, 0, height - 1) * width
                     + np.clip(columns + sign * across, 0, width - 1))
            sides.append((even.take(place) + stand_in) / (clear.take(place) + _SIDE_PRIOR))
        best = np.maximum(best, np.minimum(*sides))
    return best


def along_strokes(confidence: np.ndarray, core: np.ndarray, pixel: float) -> np.ndarray:
    """Mean of the confidence over the bright pixels within 1.25 m, (n,) for each of them in the order of rows, for
    strokes too long to be judged as one.

    Parameters
    ----------
    confidence : (n,) of the bright pixels.
    core : bool (rows, columns), where they are.
    """
    inside = np.flatnonzero(core)
    values = np.zeros(core.shape, np.uint8)
    values.ravel()[inside] = np.rint(confidence * np.float32(255))
    total = _share_at(values, LIMITS.mean_box, pixel, inside)
    weight = _share_at(core.view(np.uint8), LIMITS.mean_box, pixel, inside)
    return total / np.float32(255) / np.maximum(weight, np.float32(1e-4))


def _ramp(values: np.ndarray, ends: tuple[float, float]) -> np.ndarray:
    low, high = ends
    return np.clip((values - np.float32(low)) / np.float32(high - low), 0, 1)


def _box(values: np.ndarray, side: float, pixel: float) -> np.ndarray:
    """Mean over a box with a side in m. Whole numbers are given: their running sums are exact, and so the result does
    not depend on where a tile begins."""
    pixels = _box_pixels(side, pixel)
    return cv2.blur(values, (pixels, pixels), borderType=cv2.BORDER_REPLICATE)


def _box_pixels(side: float, pixel: float) -> int:
    """Pixels of the side of a box, odd."""
    return max(round(side / pixel) | 1, 3)
