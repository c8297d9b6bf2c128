"""What is bright but no road marking: edges of paving and roofs, vehicles, specks (after J 3.2.2).

Rules look at brightness within a few metres and at connected pixels of limited size, so that the result of a tile
does not depend on how an image is cut: pieces of `max_length` or more are judged by the local rules alone.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
import numpy as np

from .marking_confidence import REACH, ConfidenceSettings, along_strokes, ground_beside, marking_confidence


@dataclass(frozen=True)
class CleanSettings:
    """Rules for what is no marking; lengths in m, areas in m2.

    Parameters
    ----------
    max_width : strokes of paint are narrower; what is wider in both directions (paving, roofs, vehicles) is ground.
    top_hat_ratio : paint is this many thresholds brighter than the ground on both sides.
    min_area : smaller pieces are specks. min_length : shorter pieces too.
    vehicle_width, vehicle_area : widest and smallest bright body that counts as a vehicle.
    body_ratio, body_width, body_area, rim : nothing is paint within `rim` of a body that is so many thresholds brighter
    than the ground, so wide and so large: a vehicle's own edges lie there. Arrow heads are narrower.
    vehicle_gap, vehicle_share : short pieces with this share this near to a vehicle belong to it. line_length : longer
    ones are lines beside it.
    wear_gap : flakes of worn paint this near to each other are one piece.
    border_share : pieces with this share of pixels along the edge of what is hidden are roof edges that a mask left.
    max_length : pieces of this length or more are not judged by their shape.
    min_confidence : pieces (parts of long ones) with less confidence that they are paint on a road are left out.
    confidence : how it is measured. fill_width : paint up to this width, such as arrow heads, is filled.
    """

    max_width: float = 0.8
    top_hat_ratio: float = 1.4
    min_area: float = 0.06
    min_length: float = 0.4
    vehicle_width: float = 3.2
    vehicle_area: float = 1.0
    vehicle_gap: float = 0.7
    vehicle_share: float = 0.3
    body_ratio: float = 3.5
    body_width: float = 1.3
    body_area: float = 2.0
    rim: float = 0.5
    line_length: float = 2.5
    wear_gap: float = 0.36
    border_share: float = 0.6
    max_length: float = 12.0
    min_confidence: float = 0.2
    confidence: ConfidenceSettings = field(default_factory=ConfidenceSettings)
    fill_width: float = 1.5

    @property
    def reach(self) -> float:
        """How far, m, the result at a pixel looks round itself."""
        return (2 * self.max_length + 2 * self.max_width + 2 * self.vehicle_width + self.vehicle_gap + REACH
                + 2 * self.fill_width)


@dataclass(frozen=True)
class Candidates:
    """Bright pixels of a piece of image and what they are judged by; all but `bands` (rows, columns).

    Attributes
    ----------
    core : bool, bright pixels. bands : (1 or 3 and more, rows, columns). image : levelled brightness. road : the same
    without all that is narrower than `max_width`. threshold : grey values that paint stands out by. seen : bool, where
    ground is seen. roads : bool, None where unknown. noise : of the image, see `marking_confidence.texture`.
    """

    core: np.ndarray
    bands: np.ndarray
    image: np.ndarray
    road: np.ndarray
    threshold: np.ndarray
    seen: np.ndarray
    roads: np.ndarray | None
    noise: float


@dataclass(frozen=True)
class Cleaned:
    """What is paint: `core` (bool), its `confidence` (float32, 0 where no core), the `ground` brightness round it and
    `vehicles`, bright bodies wider than paint with their rims (bool); all (rows, columns)."""

    core: np.ndarray
    confidence: np.ndarray
    ground: np.ndarray
    vehicles: np.ndarray


def disc_kernel(diameter: float, pixel: float) -> np.ndarray:
    """Round structuring element of a diameter in m, at least 3 pixels."""
    side = max(round(diameter / pixel) | 1, 3)
    return cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))


def remove_non_markings(found: Candidates, pixel: float, settings: CleanSettings) -> Cleaned:
    """Pixels of the candidates that are paint."""
    relief = (found.image - found.road) / found.threshold
    narrow = found.core & (relief > settings.top_hat_ratio)
    ground = ground_beside(found.bands, found.image, found.road, found.core, found.seen, pixel,
                           found.noise, settings.confidence)
    confidence = marking_confidence(narrow, found.bands, relief, ground, found.roads, pixel, settings.confidence)
    vehicles, bodies = vehicle_zones(found, ground.brightness, pixel, settings)
    narrow &= ~bodies
    inner = cv2.erode(found.seen.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    kept, confidence = filtered_components(narrow, vehicles, found.seen & ~inner, confidence, pixel, settings)
    return Cleaned(kept, confidence, ground.brightness, bodies)


def vehicle_zones(found: Candidates, ground: np.ndarray, pixel: float, settings: CleanSettings
                  ) -> tuple[np.ndarray, np.ndarray]:
    """What is near to bright bodies as large as a vehicle, and bodies far brighter than the ground with their rims;
    bool (rows, columns)."""
    road, threshold = found.road, found.threshold
    around = _opened_coarsely(road, disc_pixel=settings.vehicle_width / pixel)
    bodies = (road - around > settings.top_hat_ratio * threshold).astype(np.uint8)
    _count, labels, boxes, _centres = cv2.connectedComponentsWithStats(bodies, connectivity=4)
    length = np.hypot(boxes[:, cv2.CC_STAT_WIDTH], boxes[:, cv2.CC_STAT_HEIGHT]) * pixel
    vehicle = (boxes[:, cv2.CC_STAT_AREA] * pixel ** 2 >= settings.vehicle_area) & (length < settings.max_length)
    vehicle[0] = False
    near = cv2.dilate(vehicle[labels].astype(np.uint8), disc_kernel(2 * settings.vehicle_gap, pixel)) > 0
    # What is not seen holds the mean of the paint beside it.
    bright = found.seen & (road - np.maximum(around, ground) > settings.body_ratio * threshold)
    return near, _with_rims(bright, pixel, settings)


def _with_rims(bright: np.ndarray, pixel: float, settings: CleanSettings) -> np.ndarray:
    """Bodies wider than any paint, no longer than vehicles, and their rims, bool (rows, columns)."""
    wide = cv2.morphologyEx(bright.astype(np.uint8), cv2.MORPH_OPEN, disc_kernel(settings.body_width, pixel))
    _count, labels, boxes, _centres = cv2.connectedComponentsWithStats(wide, connectivity=4)
    body = np.hypot(boxes[:, cv2.CC_STAT_WIDTH], boxes[:, cv2.CC_STAT_HEIGHT]) * pixel < settings.max_length
    body &= boxes[:, cv2.CC_STAT_AREA] * pixel ** 2 >= settings.body_area
    body[0] = False
    return cv2.dilate(body[labels].astype(np.uint8), disc_kernel(2 * settings.rim, pixel)) > 0


def _opened_coarsely(image: np.ndarray, disc_pixel: float) -> np.ndarray:
    """Opening by a disc of many pixels, on an image shrunk so that the disc has about 13.

    Rows and columns are taken by fixed steps from the first; the caller keeps tiles on multiples of `coarse_step`.
    """
    step = coarse_step(disc_pixel)
    small = cv2.erode(image, np.ones((step, step), np.uint8), anchor=(0, 0),
                      borderType=cv2.BORDER_REPLICATE)[::step, ::step]
    small = cv2.morphologyEx(small, cv2.MORPH_OPEN, disc_kernel(disc_pixel / step, 1.0),
                             borderType=cv2.BORDER_REPLICATE)
    return np.repeat(np.repeat(small, step, axis=0), step, axis=1)[:image.shape[0], :image.shape[1]]


def coarse_step(disc_pixel: float) -> int:
    """Pixels that are taken together where a disc of a diameter in pixels opens an image."""
    return max(int(disc_pixel / 13), 1)


def filtered_components(mask: np.ndarray, vehicles: np.ndarray, border: np.ndarray, confidence: np.ndarray,
                        pixel: float, settings: CleanSettings) -> tuple[np.ndarray, np.ndarray]:
    """Pieces of `mask` that are large enough, sure enough, no vehicle's, and not just along a border.

    `vehicles` and `border` are bool (rows, columns): near to a vehicle, and at the edge of what is hidden.
    `confidence` is that of pixels.

    Returns
    -------
    The kept pixels, bool, and their confidence: that of their piece, or of the part of a long one; 0 elsewhere.
    """
    joined = cv2.dilate(mask.astype(np.uint8), disc_kernel(settings.wear_gap, pixel))
    count, labels, boxes, _centres = cv2.connectedComponentsWithStats(joined, connectivity=8)
    inside = np.nonzero(mask)
    labels = labels[inside]
    size, at_vehicle, at_border, sure = (np.bincount(labels, values, minlength=count) for values in (
        None, vehicles[inside], border[inside], confidence[inside]))
    length = np.hypot(boxes[:, cv2.CC_STAT_WIDTH], boxes[:, cv2.CC_STAT_HEIGHT]) * pixel
    own_length = length - settings.wear_gap
    kept = (size * pixel ** 2 >= settings.min_area) & (own_length >= settings.min_length)
    kept &= (at_vehicle < settings.vehicle_share * size) | (own_length > settings.line_length)
    kept &= at_border < settings.border_share * size
    long = length >= settings.max_length
    kept |= long
    kept[0] = False
    value = np.where(long[labels], along_strokes(confidence, mask, pixel)[inside],
                     (sure / np.maximum(size, 1))[labels].astype(np.float32))
    good = kept[labels] & (value >= settings.min_confidence)
    chosen, values = np.zeros(mask.shape, bool), np.zeros(mask.shape, np.float32)
    chosen[inside], values[inside] = good, np.where(good, value, 0)
    return chosen, values
