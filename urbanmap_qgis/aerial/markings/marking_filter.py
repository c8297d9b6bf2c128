"""What is bright but no road marking: edges of paving and roofs, vehicles, specks (after J 3.2.2).

Rules look at brightness within a few metres and at connected pixels of limited size, so that the result of a tile
does not depend on how an image is cut: pieces of `max_length` or more are judged by the local rules alone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import cv2
import numpy as np

from ...settings.aerial import PaintRules
from .disc_opening import coarse_step, disc_kernel, disc_opened
from .image_strips import STRIP, flat_places, grown, row_strips, shifted_places, within
from .marking_confidence import (
    ALONG_REACH,
    GROUND_REACH,
    ConfidenceSettings,
    GroundBeside,
    along_strokes,
    contrast_confidence,
    ground_beside,
    marking_confidence,
)
from .marking_evidence import SearchTally, evidence_of_pieces
from .marking_pieces import (
    MarkingPieces,
    PieceFigures,
    PieceImage,
    marking_pieces_of,
    piece_figures,
)
from .paint_model import HARD_LIGHT, SOFT_LIGHT, KindOfLight, paint_model
from .road_model import RoadModel
from .signs.crossing_bars import BARS_REACH, crossing_bars
from .signs.crossing_bars import CONFIDENCE as OF_BARS
from .surroundings import REACH, road_share


@dataclass(frozen=True)
class CleanSettings(PaintRules):
    """Rules for what is no marking; lengths in m, areas in m2.

    Parameters
    ----------
    top_hat_ratio : paint is this many thresholds brighter than the ground on both sides.
    min_length : shorter pieces too.
    vehicle_width, vehicle_area : widest and smallest bright body that counts as a vehicle.
    body_ratio, body_width, body_area, rim : nothing is paint within `rim` of a body that is so many thresholds brighter
        than the ground, so wide and so large: a vehicle's own edges lie there. Arrow heads are narrower.
    vehicle_gap, vehicle_share : short pieces with this share this near to a vehicle belong to it.
    line_length : longer ones are lines beside it.
    wear_gap : flakes of worn paint this near to each other are one piece.
    border_share : pieces with this share of pixels along the edge of what is hidden are roof edges that a mask left.
    max_length : pieces of this length or more are not judged by their shape.
    doubtful, sure, company, company_reach : what the ground beside gives less confidence than `doubtful` goes where
        less than `company` m2 with a confidence of `sure` lies within `company_reach`: paint is seldom alone; reeds and
        parts of roofs and vehicles are.
    own_length : shorter pieces are no company to themselves.
    least_road, bars_near : it goes too where less of the ground round it can be a road and no bars lie so near.
    confidence : how it is measured.
    trained : whether the confidence is told by the trained model, see `paint_model`, or by rules alone; see also
        `of_image`.
    """

    top_hat_ratio: float = 1.4
    min_length: float = 0.4
    vehicle_width: float = 3.2
    vehicle_area: float = 1.0
    vehicle_gap: float = 0.4
    vehicle_share: float = 0.3
    body_ratio: float = 3.5
    body_width: float = 1.3
    body_area: float = 2.0
    rim: float = 0.5
    line_length: float = 2.5
    wear_gap: float = 0.36
    border_share: float = 0.6
    max_length: float = 12.0
    doubtful: float = 0.6
    sure: float = 0.75
    company: float = 2.0
    company_reach: float = 10.0
    own_length: float = 5.0
    least_road: float = 0.2
    bars_near: float = 20.0
    confidence: ConfidenceSettings = field(default_factory=ConfidenceSettings)
    trained: bool = False

    def of_image(self, model: RoadModel) -> CleanSettings:
        """Rules for an image by its own road: in hard light the trained model tells the confidence, as it finds as much
        paint there with less else."""
        return replace(self, trained=True) if self.confidence.hard_light(model) else self

    @property
    def reach(self) -> float:
        """How far, m, the result at a pixel looks round itself.

        Its piece reaches so far, a body at that piece so much farther, and the ground or all that is wider than a
        vehicle, by which the body is told, from there on.
        """
        body = self.max_length + self.body_width + max(self.vehicle_gap, self.rim)
        beyond = body + max(GROUND_REACH, self.vehicle_width)
        if self.trained:
            beyond = max(beyond, REACH + GROUND_REACH)
        return self.piece_reach + beyond + self.max_width + 2 * self.fill_width

    @property
    def piece_reach(self) -> float:
        """How far, m, from a pixel its piece and what is company to it or vouches for it reach."""
        return max(self.max_length + self.wear_gap, BARS_REACH + max(self.company_reach, self.bars_near))


@dataclass(frozen=True)
class Candidates:
    """Bright pixels of a piece of image and what they are judged by; all but `bands` (rows, columns).

    Attributes
    ----------
    core : bool, bright pixels.
    bands : (1 or 3 and more, rows, columns).
    image : levelled brightness.
    road : the same without all that is narrower than `max_width`.
    threshold : grey values that paint stands out by.
    seen : bool, where ground is seen.
    roads : bool, None where unknown.
    model : the image's own road.
    scale : levelled grey values in one of the bands' steps.
    contrast : grey values that paint stands out by in the light.
    """

    core: np.ndarray
    bands: np.ndarray
    image: np.ndarray
    road: np.ndarray
    threshold: np.ndarray
    seen: np.ndarray
    roads: np.ndarray | None
    model: RoadModel
    scale: float
    contrast: float


@dataclass(frozen=True)
class Cleaned:
    """What is paint: `core` (bool), its `confidence` (float32, 0 where no core), the `ground` brightness round it and
    `vehicles`, bright bodies wider than paint with their rims (bool); all (rows, columns). `evidence` is of the rows
    and columns counted."""

    core: np.ndarray
    confidence: np.ndarray
    ground: np.ndarray
    vehicles: np.ndarray
    evidence: SearchTally = field(default_factory=SearchTally)


def remove_non_markings(found: Candidates, pixel: float, settings: CleanSettings,
                        wanted: tuple[slice, slice] | None = None, counted: tuple[slice, slice] | None = None
                        ) -> Cleaned:
    """Pixels of the candidates that are paint, for the rows and columns wanted, by default all, and evidence of those
    counted, by default the same."""
    wanted = wanted or (slice(0, found.core.shape[0]), slice(0, found.core.shape[1]))
    counted = counted or wanted
    judged = judged_pieces(found, pixel, settings, wanted)
    near, ground, mask, pieces = judged.near, judged.ground, judged.mask, judged.pieces
    rules = values = _of_pieces(judged, judged.by_rules, pixel)
    accepted = judged.accepted[pieces.labels]
    if found.roads is None:
        bars = crossing_bars(pieces, judged.accepted, mask.shape[1], pixel, settings.max_width)[pieces.labels]
        if settings.trained:
            values = _by_model(judged, found, pixel, settings, rules, within(wanted, near))
        else:
            places = shifted_places(pieces.inside, near, found.core.shape)
            roads = road_share(places, found.bands, found.image, ground, found.model, pixel, found.scale)
            values = np.where(_alone(judged, bars, roads, pixel, settings), np.float32(0), values)
        values = np.maximum(values, np.where(bars, np.float32(OF_BARS), 0))
    good = accepted & (values >= settings.min_confidence)
    evidence = SearchTally(colder=judged.colder, clear=np.count_nonzero(ground.clear[counted]),
                           smooth=np.count_nonzero(ground.smooth[counted]))
    evidence += _tally(judged, accepted & (rules >= settings.min_confidence), good, within(counted, near), pixel)
    markings, confidence = np.zeros(mask.shape, bool), np.zeros(mask.shape, np.float32)
    markings.ravel()[pieces.inside] = good
    confidence.ravel()[pieces.inside] = np.where(good, values, 0)
    window = within(wanted, near)
    return Cleaned(markings[window], confidence[window], ground.brightness[wanted], judged.bodies, evidence)


@dataclass(frozen=True)
class JudgedPieces:
    """Pieces of bright narrow pixels, before their confidence is asked for.

    Attributes
    ----------
    near : rows and columns that `mask` covers.
    mask : bool, pixels of the pieces.
    pieces : of them.
    accepted : (m,) bool, pieces that are large enough, no vehicle's and not just along a border.
    relief : (n,) top-hat in thresholds of the mask's pixels.
    by_rules : (n,) float32, their confidence by rules for the ground beside, see `marking_confidence`.
    colder : how many bright narrow pixels are no paint by these rules for their colour alone.
    narrow : bool, bright narrow pixels of the whole.
    ground : of the whole.
    bodies : bool, of the rows and columns wanted.
    """

    near: tuple[slice, slice]
    mask: np.ndarray
    pieces: MarkingPieces
    accepted: np.ndarray
    relief: np.ndarray
    by_rules: np.ndarray
    colder: int
    narrow: np.ndarray
    ground: GroundBeside
    bodies: np.ndarray


def judged_pieces(found: Candidates, pixel: float, settings: CleanSettings, wanted: tuple[slice, slice]
                  ) -> JudgedPieces:
    """Pieces that reach into the rows and columns wanted."""
    narrow = _narrow(found, settings.top_hat_ratio)
    # A piece is shorter than this, or long; farther off nothing matters any more.
    near = grown(wanted, math.ceil(settings.piece_reach / pixel) + 4, found.core.shape)
    ground = ground_beside(found.bands, found.image, found.road, found.core, found.seen, pixel, found.model,
                           settings.confidence)
    vehicles, bodies = vehicle_zones(found, ground.brightness, pixel, settings)
    mask = narrow[near] & ~bodies[near]
    inner = cv2.erode(found.seen.view(np.uint8), np.ones((5, 5), np.uint8))[near] > 0
    joined = cv2.dilate(mask.view(np.uint8), disc_kernel(settings.wear_gap, pixel))
    pieces = marking_pieces_of(mask, joined, pixel, settings.max_length)
    accepted = _accepted(pieces, vehicles[near], found.seen[near] & ~inner, pixel, settings)
    places = shifted_places(pieces.inside, near, found.core.shape)
    relief = (found.image.take(places) - found.road.take(places)) / found.threshold.take(places)
    by_rules, colder = _by_rules(found, narrow, ground, pixel, settings, near)
    return JudgedPieces(near, mask, pieces, accepted, relief, by_rules[~bodies[near][narrow[near]]], colder, narrow,
                        ground, bodies[wanted])


def _by_rules(found: Candidates, narrow: np.ndarray, ground: GroundBeside, pixel: float, settings: CleanSettings,
              near: tuple[slice, slice]) -> tuple[np.ndarray, int]:
    """Confidence (n,) by rules of the bright narrow pixels of some rows and columns, and how many are too blue."""
    inside = flat_places(narrow, near)
    relief = (found.image.take(inside) - found.road.take(inside)) / found.threshold.take(inside)
    colder = np.zeros(len(relief), bool)
    confidence = marking_confidence(narrow, found.bands, relief, ground, found.roads, pixel, settings.confidence, near,
                                    colder)
    return confidence, int(np.count_nonzero(colder))


def figures_of_pieces(judged: JudgedPieces, found: Candidates, pixel: float, counts: np.ndarray) -> PieceFigures:
    """Figures of the cells of the pieces' pixels that count, bool (n,)."""
    places = shifted_places(judged.pieces.inside[counts], judged.near, found.core.shape)
    image = PieceImage(found.bands, found.image, judged.narrow, judged.ground, found.model, found.scale, found.contrast)
    return piece_figures(image, places, judged.relief[counts], judged.by_rules[counts], judged.pieces,
                         judged.pieces.labels[counts], pixel)


def _matters(judged: JudgedPieces, window: tuple[slice, slice], pixel: float) -> np.ndarray:
    """Which of the pieces' pixels the result in a window of the mask depends on, bool (n,): pieces that reach into it,
    and of those too long to be judged as one what lies at it."""
    pieces = judged.pieces
    wide = grown(window, math.ceil(ALONG_REACH / pixel) + 1, judged.mask.shape)
    rows, columns = np.divmod(pieces.inside, judged.mask.shape[1])
    at = ((rows >= wide[0].start) & (rows < wide[0].stop) & (columns >= wide[1].start) & (columns < wide[1].stop))
    reaching = np.bincount(pieces.labels, at, minlength=len(pieces.size)) > 0
    return np.where(pieces.long[pieces.labels], at, reaching[pieces.labels])


def _light(found: Candidates, settings: CleanSettings) -> KindOfLight:
    return HARD_LIGHT if settings.confidence.hard_light(found.model) else SOFT_LIGHT


def _by_model(judged: JudgedPieces, found: Candidates, pixel: float, settings: CleanSettings, rules: np.ndarray,
              window: tuple[slice, slice]) -> np.ndarray:
    """Confidence (n,) of the pieces' pixels by the trained model; of those that do not matter in a window of the mask,
    and of those to which the rules (n,) give next to none, it may be 0."""
    light = _light(found, settings)
    counts = judged.accepted[judged.pieces.labels] & (rules >= light.least_rules)
    counts &= _matters(judged, window, pixel)
    figures = figures_of_pieces(judged, found, pixel, counts)
    evidence = np.zeros(len(counts), np.float32)
    evidence[counts] = paint_model().evidence_of(figures.values, len(figures.pixels), light)[figures.cell]
    return paint_model().probability(_of_pieces(judged, evidence, pixel, counts), light)


def _tally(judged: JudgedPieces, by_rules: np.ndarray, good: np.ndarray, counted: tuple[slice, slice], pixel: float
           ) -> SearchTally:
    """Evidence of the pieces: what rules for the ground beside leave out, and what is taken in the end."""
    inside, labels = judged.pieces.inside, judged.pieces.labels
    accepted, shape = judged.accepted[labels], judged.mask.shape
    tally = evidence_of_pieces(inside, labels, accepted, by_rules, shape, counted, pixel)
    if np.array_equal(by_rules, good):
        return tally
    return replace(tally, painted=evidence_of_pieces(inside, labels, accepted, good, shape, counted, pixel).painted)


def _accepted(pieces: MarkingPieces, vehicles: np.ndarray, border: np.ndarray, pixel: float, settings: CleanSettings
              ) -> np.ndarray:
    """Pieces (m,) that are large enough, no vehicle's, and not just along a border, bool; long ones as they are.

    `vehicles` and `border` are bool (rows, columns): near to a vehicle, and at the edge of what is hidden.
    """
    size, own_length = pieces.size, pieces.length - settings.wear_gap
    at_vehicle, at_border = (np.bincount(pieces.labels, flags.take(pieces.inside), minlength=len(size))
                             for flags in (vehicles, border))
    accepted = (size * pixel ** 2 >= settings.min_area) & (own_length >= settings.min_length)
    accepted &= (at_vehicle < settings.vehicle_share * size) | (own_length > settings.line_length)
    accepted &= at_border < settings.border_share * size
    accepted |= pieces.long
    accepted[0] = False
    return accepted


def _of_pieces(judged: JudgedPieces, values: np.ndarray, pixel: float, known: np.ndarray | None = None) -> np.ndarray:
    """Means (n,) of values of the pieces' pixels over their piece, or the part of a long one; there of those that are
    known, bool (n,), by default all."""
    pieces = judged.pieces
    mean = np.bincount(pieces.labels, values, minlength=len(pieces.size)) / np.maximum(pieces.size, 1)
    along = np.zeros(len(values), np.float32)
    if known is None:
        along = along_strokes(values, judged.mask, pixel)
    else:
        strokes = np.zeros(judged.mask.shape, bool)
        strokes.ravel()[pieces.inside[known]] = True
        along[known] = along_strokes(values[known], strokes, pixel)
    return np.where(pieces.long[pieces.labels], along, mean[pieces.labels].astype(np.float32))


def _alone(judged: JudgedPieces, bars: np.ndarray, roads: np.ndarray, pixel: float, settings: CleanSettings
           ) -> np.ndarray:
    """Which of the pieces' pixels (bool, n) lie on doubtful ground and have hardly any sure paint round them, nor bars
    of a crossing (bool, n), or lie where little can be a road (share, n) and no crossing is near."""
    pieces = judged.pieces
    sure = bars | (along_strokes(judged.by_rules, judged.mask, pixel) >= settings.sure)
    around = _paint_around(sure, pieces.inside, judged.mask.shape, pixel, settings.company_reach)
    crossing = _paint_around(bars, pieces.inside, judged.mask.shape, pixel, settings.bars_near)
    own = np.bincount(pieces.labels, sure, len(pieces.size)) * (pieces.length < settings.own_length + settings.wear_gap)
    few = (around - own[pieces.labels]) * pixel ** 2 < settings.company
    off = (_of_pieces(judged, roads, pixel) < settings.least_road) & (crossing * pixel ** 2 < settings.company)
    # Worn paint is faint, but lies on a road: it needs no company. A crossing shows a road where little is to be seen.
    by_ground = _of_pieces(judged, judged.by_rules / contrast_confidence(judged.relief, settings.confidence), pixel)
    return (by_ground < settings.doubtful) & (few | off)


def _paint_around(sure: np.ndarray, inside: np.ndarray, shape: tuple[int, int], pixel: float,
                  reach: float) -> np.ndarray:
    """How many sure pixels (float32, n) lie within `reach` m by rows and columns of each pixel of pieces.

    Parameters
    ----------
    sure : (n,) bool, pixels that are paint for sure.
    inside : (n,) places of the pixels in the flat image of the shape (rows, columns).
    pixel : m.
    """
    flags = np.zeros(shape, np.uint8)
    flags.ravel()[inside] = sure
    side = 2 * round(reach / pixel) + 1
    around = cv2.boxFilter(flags, cv2.CV_32F, (side, side), normalize=False, borderType=cv2.BORDER_CONSTANT)
    return around.take(inside)


def _narrow(found: Candidates, ratio: float) -> np.ndarray:
    """Candidates that stand out on both sides, by so many thresholds, from what is as wide as ground, bool."""
    narrow = np.empty(found.core.shape, bool)
    for strip, _, _ in row_strips(len(narrow)):
        relief = found.image[strip] - found.road[strip]
        relief /= found.threshold[strip]
        np.greater(relief, ratio, out=narrow[strip])
        narrow[strip] &= found.core[strip]
    return narrow


def vehicle_zones(found: Candidates, ground: np.ndarray, pixel: float, settings: CleanSettings
                  ) -> tuple[np.ndarray, np.ndarray]:
    """What is near to bright bodies as large as a vehicle, and bodies far brighter than the ground with their rims;
    bool (rows, columns).

    Bodies are wide: they are told on a grid of `coarse_step` pixels.
    """
    step, shape = coarse_step(settings.vehicle_width / pixel), found.core.shape
    cell = step * pixel
    bodies, bright = _bright_bodies(found, ground, step, pixel, settings)
    near = _large_pieces(bodies, cell, settings.vehicle_area, settings.max_length)
    wide = cv2.morphologyEx(bright, cv2.MORPH_OPEN, disc_kernel(settings.body_width, cell))
    rims = _large_pieces(wide, cell, settings.body_area, settings.max_length)
    return (_round_cells(near, step, shape, disc_kernel(2 * settings.vehicle_gap, pixel)),
            _round_cells(rims, step, shape, disc_kernel(2 * settings.rim, pixel)))


def _round_cells(cells: np.ndarray, step: int, shape: tuple[int, int], disc: np.ndarray) -> np.ndarray:
    """Pixels of an image of a shape within a disc round cells (uint8) of so many pixels, bool."""
    if not cells.any():
        return np.zeros(shape, bool)
    fine = cv2.resize(cells, None, fx=step, fy=step, interpolation=cv2.INTER_NEAREST)[:shape[0], :shape[1]]
    return cv2.dilate(np.ascontiguousarray(fine), disc).view(bool)


def _bright_bodies(found: Candidates, ground: np.ndarray, step: int, pixel: float, settings: CleanSettings
                   ) -> tuple[np.ndarray, np.ndarray]:
    """Cells of so many pixels that are brighter than all that is wider than a vehicle, and that are far brighter than
    that and the ground; uint8, 0 or 1. A cell is what its middle pixel is."""
    road, threshold, under, seen = (_middles(values, step) for values in (
        found.road, found.threshold, ground, found.seen))
    around = _opened_coarsely(found.road, settings.vehicle_width / pixel)[1]
    bodies = road - around > settings.top_hat_ratio * threshold
    np.maximum(around, under, out=around)
    bright = road - around > settings.body_ratio * threshold
    # What is not seen holds the mean of the paint beside it.
    bright &= seen
    return bodies.view(np.uint8), bright.view(np.uint8)


def _middles(values: np.ndarray, step: int) -> np.ndarray:
    """Values of the middle pixels of cells of so many, beginning with the first; at the ends the last there are."""
    rows, columns = (np.minimum(np.arange(0, side, step) + step // 2, side - 1) for side in values.shape)
    return values[rows][:, columns]


def _large_pieces(flags: np.ndarray, pixel: float, least: float, max_length: float) -> np.ndarray:
    """Connected pieces of flags (uint8) of `least` m2 or more, their box's diagonal shorter than `max_length` m."""
    _count, labels, boxes, _centres = cv2.connectedComponentsWithStats(flags, connectivity=4)
    size = boxes[:, cv2.CC_STAT_AREA] * pixel ** 2
    large = (size >= least) & (np.hypot(boxes[:, cv2.CC_STAT_WIDTH], boxes[:, cv2.CC_STAT_HEIGHT]) * pixel < max_length)
    large[0] = False
    pieces = np.zeros(flags.shape, np.uint8)
    for number in np.flatnonzero(large):
        left, top, width, height = boxes[number, :4]
        place = slice(top, top + height), slice(left, left + width)
        pieces[place] |= labels[place] == number
    return pieces


def _opened_coarsely(image: np.ndarray, disc_pixel: float) -> tuple[int, np.ndarray]:
    """Opening by a disc of many pixels, of an image shrunk so that the disc has about 10; by how much, and the opened
    one.

    Rows and columns are taken by fixed steps from the first; the caller keeps tiles on multiples of `coarse_step`.
    """
    step = coarse_step(disc_pixel)
    small = np.empty((-(-image.shape[0] // step), -(-image.shape[1] // step)), np.float32)
    square = np.ones((step, step), np.uint8)
    for strip, wide, inner in row_strips(len(image), step, -(-STRIP // step) * step):
        lowest = cv2.erode(image[wide], square, anchor=(0, 0), borderType=cv2.BORDER_REPLICATE)[inner]
        small[strip.start // step:-(-strip.stop // step)] = lowest[::step, ::step]
    return step, disc_opened(small, disc_kernel(disc_pixel / step, 1.0))
