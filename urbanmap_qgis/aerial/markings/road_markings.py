"""Road markings in an orthophoto by adaptive thresholding (J 3.2.2), one piece of the image at a time.

All of it has bounded reach: a pixel's result depends on the image within `margin_pixels` of it, so that large images
can be worked on in overlapping tiles without seams.
"""

from __future__ import annotations

import math
from dataclasses import astuple, dataclass, field, replace
from functools import lru_cache

import cv2
import numpy as np

from ...errors import InputError
from ...settings.aerial import MarkingThreshold
from ...wording import say
from .disc_opening import disc_kernel, disc_opened
from .image_strips import grown, row_strips, within
from .marking_evidence import SearchTally
from .marking_filter import Candidates, Cleaned, CleanSettings, remove_non_markings
from .paint_figures import cell_pixels
from .road_model import RoadModel, clear_of_paint, colours_of, texture


@dataclass(frozen=True)
class RoadMarkingsLimits:
    """Limits of road markings, each with its unit."""

    # How much of red less blue is added to red: yellow paint on light paving is no brighter than it, but warmer.
    yellow_weight: float = 0.5
    # In shade paint stands out less, in proportion; the threshold follows down to this share of itself.
    shade_floor: float = 0.35
    edge_spread: float = 0.25  # m round a marking's pixels in which its edge is looked for, and its own brightness.
    # Times the ground's brightness: what is brighter, and wider than paint can be, is a surface of its own.
    brighter: float = 1.2
    # Paint whose warmth (red less blue), less that of the ground beside it, exceeds this share of its red is
    # yellow.
    yellow_share: float = 0.15
    rounded: int = 16  # pixels by which boxes and discs, one after the other, are wider than their sizes in m
    no_paint: float = -1e3  # grey values: of the field far from paint


LIMITS = RoadMarkingsLimits()

DOUBTFUL = 0.2, 0.4
"""Confidence of what is worth a look: from the first up to the least of markings, or the second where that is more."""

MIN_RANGE = 1.5
"""Least range of the levels, in medians of the brightness; new paint is two to three times as bright as asphalt."""


@dataclass(frozen=True)
class MarkingSettings(MarkingThreshold):
    """How markings are told from the road.

    Parameters
    ----------
    paper : whether the plain adaptive threshold of J 3.2.2 is taken, see `thresholded`; `cleaning` is None then.
    cleaning : rules for what is no marking; None keeps all that passes the threshold.
    levels : of the image that this one is a part of, so that its parts do not differ; None takes them of this one.
    """

    paper: bool = False
    cleaning: CleanSettings | None = field(default_factory=CleanSettings)
    levels: LevelAdjustment | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.paper and self.cleaning is not None:
            raise ValueError("The paper's threshold is not cleaned.")

    @property
    def doubtful(self) -> MarkingSettings:
        """Those by which only what is worth a look is found: below the least confidence, or `DOUBTFUL[1]`."""
        low, high = DOUBTFUL
        return replace(self, cleaning=replace(self.cleaning, min_confidence=low,
                                              below=max(self.cleaning.min_confidence, high)))

PAPER_MARKINGS = MarkingSettings(paper=True, cleaning=None)
"""J 3.2.2 with the values of Table 3-2."""


@dataclass(frozen=True)
class LevelAdjustment:
    """Level adjustment: brightness `low` becomes 0, `high` 255; `middle` is the median after it.

    road : the image's own road, see `ground_figures`.
    """

    low: float
    high: float
    middle: float
    road: RoadModel = field(default_factory=RoadModel)

    @property
    def text(self) -> str:
        """The seven numbers, to the last bit."""
        return " ".join(repr(value) for value in (self.low, self.high, self.middle, *astuple(self.road)))

    @classmethod
    def of_text(cls, text: str) -> LevelAdjustment | None:
        """What `text` gave; None of an empty one. Raises `InputError` where it holds no such numbers."""
        try:
            numbers = [float(word) for word in text.split()]
        except ValueError:
            numbers = []
        if not text.strip():
            return None
        if len(numbers) != 7 or not np.isfinite(numbers).all() or numbers[1] <= numbers[0]:
            raise InputError(say("Levels are seven numbers, low, high, middle and the road's texture, warmth, green "
                                 "and brightness, the second above the first: give those, or none."))
        return cls(*numbers[:3], RoadModel(*numbers[3:]))


@dataclass(frozen=True)
class Markings:
    """Markings of a piece of image; all arrays (rows, columns).

    Attributes
    ----------
    mask : bool, pixel centres on paint.
    field : float32, brightness less that half-way between paint and road: its zero line is the paint's edge.
    contrast : float32, grey values above the road.
    yellow : bool.
    confidence : float32, 0 to 1 that it is paint; NaN where it is not measured.
    evidence : of the rows and columns that were wanted.
    """

    mask: np.ndarray
    field: np.ndarray
    contrast: np.ndarray
    yellow: np.ndarray
    confidence: np.ndarray
    evidence: SearchTally = field(default_factory=SearchTally)

    def part(self, place: tuple[slice, slice]) -> Markings:
        """Those of some rows and columns."""
        return Markings(*(values[place] for values in (
            self.mask, self.field, self.contrast, self.yellow, self.confidence)))


def image_brightness(bands: np.ndarray, settings: MarkingSettings) -> np.ndarray:
    """Brightness that is levelled and compared, (rows, columns) float32: grey in the paper."""
    if not settings.paper:
        return paint_brightness(bands)
    bands = bands.astype(np.float32)
    return bands[0] if len(bands) < 3 else cv2.cvtColor(np.moveaxis(bands[:3], 0, -1), cv2.COLOR_RGB2GRAY)


def paint_brightness(bands: np.ndarray) -> np.ndarray:
    """Brightness in which white, yellow and blue paint stand out, (rows, columns) float32.

    Blue paint reflects little red: there the mean of the colours is the brighter.

    `bands` is (1, rows, columns) grey or (3 or more, rows, columns) with red, green, blue first.
    """
    if len(bands) < 3:
        return bands[0].astype(np.float32)
    red, green, blue = (band.astype(np.float32) for band in bands[:3])
    mean = red + green
    mean += blue
    mean /= np.float32(3)
    blue -= red
    blue *= np.float32(-LIMITS.yellow_weight)
    red += blue
    return np.maximum(red, mean, out=mean)


def level_adjustment_of(brightness: np.ndarray, min_range: float = MIN_RANGE) -> LevelAdjustment:
    """Levels of a sample of valid brightness values, (n,), from its darkest and brightest 0.5 %.

    The range is at least `min_range` medians: a street with hardly any paint must not have its noise stretched.
    Values beyond the levels are kept, as cutting them would shift the edges of bright paint.
    """
    low, middle, high = np.percentile(brightness, [0.5, 50.0, 99.5])
    high = max(high, low + min_range * abs(middle), low + 1e-6)
    return LevelAdjustment(float(low), float(high), float((middle - low) * 255 / (high - low)))


def margin_pixels(pixel: float, settings: MarkingSettings) -> int:
    """How far, in pixels of side `pixel` (m), the result at a pixel looks round itself."""
    reach = settings.block_size / 2 + 4 * LIMITS.edge_spread
    reach += settings.cleaning.reach if settings.cleaning else CleanSettings().max_width
    return math.ceil(reach / pixel) + LIMITS.rounded


def tile_step(pixel: float, settings: MarkingSettings) -> int:
    """Pixels of side `pixel` (m) of which the sides of tiles are multiples, so that coarse cells fall alike in all."""
    if not settings.cleaning:
        return 1
    return cell_pixels(pixel)


def find_markings(bands: np.ndarray, seen: np.ndarray, roads: np.ndarray | None, pixel: float, levels: LevelAdjustment,
                  settings: MarkingSettings, wanted: tuple[slice, slice] | None = None) -> Markings:
    """Markings of a piece of orthophoto.

    Parameters
    ----------
    bands : (1 or more, rows, columns), see `paint_brightness`.
    seen : bool, where the image shows ground: all else does not enter the mean.
    roads : bool, where markings may be; None for everywhere.
    pixel : side, m.
    wanted : rows and columns for which they are wanted, by default all; what lies `margin_pixels` round them, or up to
        the image's edge, must be there.
    """
    wanted = wanted or (slice(0, seen.shape[0]), slice(0, seen.shape[1]))
    allowed = seen if roads is None else seen & roads
    if settings.paper:
        return thresholded(_levelled(bands, levels, settings), bands, seen, allowed, pixel, settings).part(wanted)
    found = candidates_of(bands, seen, roads, pixel, levels, settings)
    image, road = found.image, found.road
    if not settings.cleaning:
        unknown = np.full(seen.shape, np.nan, np.float32)
        return _refined(found.core, image, road, bands, allowed, pixel, unknown).part(wanted)
    near = grown(wanted, math.ceil((2 * settings.cleaning.fill_width + 4 * LIMITS.edge_spread) / pixel) + 4, seen.shape)
    cleaned = remove_non_markings(found, pixel, settings.cleaning, near, wanted)
    image, road, allowed, bands = image[near], road[near], allowed[near], bands[:, near[0], near[1]]
    del found  # large pieces of image: each array counts
    core, road = _filled(cleaned, image, road, allowed, pixel, settings.cleaning)
    confidence, evidence = cleaned.confidence, cleaned.evidence
    del cleaned
    markings = _refined(core, image, road, bands, allowed, pixel, confidence).part(within(wanted, near))
    return replace(markings, evidence=evidence)


def candidates_of(bands: np.ndarray, seen: np.ndarray, roads: np.ndarray | None, pixel: float,
                  levels: LevelAdjustment, settings: MarkingSettings) -> Candidates:
    """Bright pixels of a piece of image, and what they are judged by; parameters as of `find_markings`."""
    image, threshold, core = _bright(bands, seen, pixel, levels, settings)
    core &= seen if roads is None else seen & roads
    width = settings.cleaning.max_width if settings.cleaning else CleanSettings().max_width
    road = disc_opened(image, disc_kernel(width, pixel))
    return Candidates(core, bands, image, road, threshold, seen, roads, levels.road,
                      255.0 / (levels.high - levels.low), settings.contrast)


def _levelled(bands: np.ndarray, levels: LevelAdjustment, settings: MarkingSettings) -> np.ndarray:
    """Brightness from 0 to 255 and beyond, (rows, columns) float32."""
    image = image_brightness(bands, settings)
    image -= np.float32(levels.low)
    image *= np.float32(255.0 / (levels.high - levels.low))
    return image


def _bright(bands: np.ndarray, seen: np.ndarray, pixel: float, levels: LevelAdjustment,
            settings: MarkingSettings) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The levelled image (the block's mean where ground is not seen), grey values that paint stands out by, and where
    the image does."""
    image, threshold = np.empty(seen.shape, np.float32), np.empty(seen.shape, np.float32)
    bright = np.empty(seen.shape, bool)
    for lines, wide, inner in row_strips(len(seen), _block_pixels(pixel, settings.block_size) // 2):
        strip = _levelled(bands[:, wide], levels, settings)
        mean = _mean_of_seen(strip, seen[wide], pixel, settings.block_size)[inner]
        image[lines] = strip[inner]
        if not seen[lines].all():
            np.copyto(image[lines], mean, where=~seen[lines])
        share = np.divide(mean, max(levels.middle, 1.0), out=threshold[lines])
        np.maximum(share, LIMITS.shade_floor, out=share)
        np.minimum(share, 1.0, out=share)
        share *= settings.contrast
        mean += share
        np.greater(image[lines], mean, out=bright[lines])
    return image, threshold, bright


def ground_figures(bands: np.ndarray, seen: np.ndarray, pixel: float, levels: LevelAdjustment,
                   settings: MarkingSettings) -> np.ndarray:
    """Texture, warmth, green and brightness (n, 4) of the clear ground of a sample, for `road_model_of`."""
    image, _, bright = _bright(bands, seen, pixel, levels, settings)
    clear = clear_of_paint(bright, seen, pixel).astype(np.float32)
    found = texture(image, clear, pixel)
    known = np.isfinite(found) & (clear > 0)
    warmth, green = colours_of(bands, clear) if len(bands) >= 3 else (np.zeros_like(found), np.zeros_like(found))
    return np.column_stack([values[known] for values in (found, warmth, green, image)])


def _filled(cleaned: Cleaned, image: np.ndarray, road: np.ndarray, allowed: np.ndarray, pixel: float,
            settings: CleanSettings) -> tuple[np.ndarray, np.ndarray]:
    """Paint wider than strokes (arrow heads, letters), and the road's brightness with the ground's in its place.

    Its rim is found as narrow; what the rim encloses and is as bright, up to `fill_width`, belongs to it.
    """
    if settings.fill_width <= settings.max_width:
        return cleaned.core, road
    side = max(round(settings.fill_width / pixel) | 1, 3)
    square = np.ones((side, side), np.uint8)
    closed = cv2.morphologyEx(cleaned.core.view(np.uint8), cv2.MORPH_CLOSE, square) > 0
    # Verges and paving are wider still: kerbs must not be filled towards them.
    lit = (image > LIMITS.brighter * cleaned.ground).view(np.uint8)
    closed &= cv2.morphologyEx(lit, cv2.MORPH_OPEN, square) == 0
    closed &= ~cleaned.core
    closed &= allowed
    if not closed.any():
        return cleaned.core, road
    paint = cv2.dilate(_where_core(image, cleaned.core), square)
    inside = np.flatnonzero(closed)
    wide = np.zeros(closed.shape, bool)
    wide.ravel()[inside] = road.take(inside) > 0.5 * (paint.take(inside) + cleaned.ground.take(inside))
    del paint
    near = np.flatnonzero(cv2.dilate(wide.view(np.uint8), disc_kernel(2 * LIMITS.edge_spread, pixel)))
    road = np.array(road)
    road.ravel()[near] = np.minimum(road.take(near), cleaned.ground.take(near))
    return cleaned.core | wide, road


def _where_core(image: np.ndarray, core: np.ndarray) -> np.ndarray:
    """The image where core is, 0 elsewhere."""
    return np.multiply(image, core.astype(np.float32))


def thresholded(image: np.ndarray, bands: np.ndarray, seen: np.ndarray, allowed: np.ndarray, pixel: float,
                settings: MarkingSettings) -> Markings:
    """Markings by the plain adaptive Gaussian threshold of a levelled image (J 3.2.2), as 8 bit numbers.

    Nothing else is done. The paper does not tell what the mean is where ground is not seen: there the mean of what is
    seen in the block stands in for the image. Outlines are those of the pixels.
    """
    side = _block_pixels(pixel, settings.block_size)
    mean = _mean_of_seen(image, seen, pixel, settings.block_size)
    levelled = np.clip(np.rint(np.where(seen, image, mean)), 0, 255).astype(np.uint8)
    mask = allowed & (cv2.adaptiveThreshold(levelled, 255, cv2.ADAPTIVE_THRESH_GAUSSIAN_C, cv2.THRESH_BINARY, side,
                                            -settings.contrast) > 0)
    yellow = np.zeros(mask.shape, dtype=bool)
    if len(bands) >= 3:
        red = bands[0].astype(np.float32)
        yellow = mask & (red - bands[2] > LIMITS.yellow_share * red)
    return Markings(mask, np.where(mask, np.float32(1), np.float32(-1)),
                    np.where(mask, image - mean, np.float32(0)), yellow, np.full(mask.shape, np.nan, np.float32))


def _block_pixels(pixel: float, block_size: float) -> int:
    """Side of the block in pixels, odd, at least 3."""
    return max(round(block_size / pixel) | 1, 3)


def _mean_of_seen(image: np.ndarray, seen: np.ndarray, pixel: float, block_size: float) -> np.ndarray:
    """Gaussian mean over a block, of seen pixels only."""
    side = _block_pixels(pixel, block_size)
    if seen.all():
        total = cv2.GaussianBlur(image, (side, side), 0, borderType=cv2.BORDER_REPLICATE)
        total /= max(_weight_of_block(side), np.float32(1e-3))
        return total
    weight = seen.astype(np.float32)
    total = cv2.GaussianBlur(image * weight, (side, side), 0, borderType=cv2.BORDER_REPLICATE)
    weight = cv2.GaussianBlur(weight, (side, side), 0, borderType=cv2.BORDER_REPLICATE)
    total /= np.maximum(weight, np.float32(1e-3), out=weight)
    return total


@lru_cache(maxsize=4)
def _weight_of_block(side: int) -> np.float32:
    """Sum of the weights of a block, 1 but for rounding."""
    ones = np.ones((2 * side, 2 * side), np.float32)
    return cv2.GaussianBlur(ones, (side, side), 0, borderType=cv2.BORDER_REPLICATE)[side, side]


def _refined(core: np.ndarray, image: np.ndarray, road: np.ndarray, bands: np.ndarray, allowed: np.ndarray,
             pixel: float, confidence: np.ndarray) -> Markings:
    """The paint round core pixels, up to half-way between the paint's brightness and the road's.

    The half-way line is where an edge lies whatever the blur; a threshold over the mean is not.
    """
    spread = disc_kernel(2 * LIMITS.edge_spread, pixel)
    narrower = disc_kernel(2 * max(LIMITS.edge_spread / 2, pixel), pixel)
    markings = Markings(np.zeros(core.shape, bool), np.full(core.shape, LIMITS.no_paint, np.float32),
                        np.zeros(core.shape, np.float32), np.zeros(core.shape, bool), np.zeros(core.shape, np.float32))
    for strip, wide, inner in row_strips(len(core), max(len(spread), len(narrower)) // 2):
        cores = core[wide]
        if not cores.any():
            continue
        near = cv2.dilate(cores.view(np.uint8), narrower)[inner] > 0
        near &= allowed[strip]
        paint = cv2.dilate(_where_core(image[wide], cores), spread)[inner]
        near &= paint > road[strip]
        paint += road[strip]
        paint *= 0.5
        np.subtract(image[strip], paint, out=markings.field[strip], where=near)
        mask = np.greater(markings.field[strip], 0, out=markings.mask[strip])
        np.subtract(image[strip], road[strip], out=markings.contrast[strip], where=mask)
        np.copyto(markings.confidence[strip], cv2.dilate(confidence[wide], spread)[inner], where=mask)
        if len(bands) >= 3:
            np.logical_and(mask, _yellow(bands[:, wide], spread)[inner], out=markings.yellow[strip])
    return markings


def _yellow(bands: np.ndarray, spread: np.ndarray) -> np.ndarray:
    """Where an image is warm, or warmer than the coldest that the disc reaches and not cold, bool."""
    red = bands[0].astype(np.float32)
    warmth = red - bands[2]
    ground = cv2.erode(warmth, spread)
    np.subtract(warmth, ground, out=ground)
    np.maximum(ground, warmth, out=ground)
    return (ground > LIMITS.yellow_share * red) & (warmth > 0.5 * LIMITS.yellow_share * red)
