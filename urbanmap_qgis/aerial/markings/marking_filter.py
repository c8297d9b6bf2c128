"""Which bright pixels are paint: one trained model judges what is narrow by itself, its ground and its company.

It looks at brightness within a few metres and at connected pieces of limited size, so that the result of a tile does
not depend on how an image is cut: of long pieces each part is judged by what lies within a metre of it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...settings.aerial import PaintRules
from .image_strips import row_strips
from .marking_evidence import SearchTally
from .marking_pieces import ALONG_REACH, MarkingPieces, along_strokes, marking_pieces_of
from .paint_figures import FAR_REACH, NEAR_REACH, PaintImage, StrokeCells, company_figures, stroke_figures
from .paint_model import paint_model
from .road_model import RoadModel, clear_of_paint


@dataclass(frozen=True)
class CleanSettings(PaintRules):
    """What of all that is bright is no paint.

    Parameters
    ----------
    top_hat_ratio : paint is this many thresholds brighter than the ground on both sides.
    max_length : m, pieces of this length or more are not judged as one.
    road_odds : times the odds of paint elsewhere, those on roads that are given.
    below : what has this confidence or more is left out, too, so that only what is doubtful stays.
    """

    top_hat_ratio: float = 1.4
    max_length: float = 5.0
    road_odds: float = 6.0
    below: float = 2.0

    @property
    def reach(self) -> float:
        """How far, m, the result at a pixel looks round itself: over its piece to the farthest cell, and from that to
        the end of a piece near it."""
        return FAR_REACH + NEAR_REACH + 2 * self.max_length + self.max_width + 2 * self.fill_width + ALONG_REACH


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
    """What is paint: `core` (bool), its `confidence` (float32, 0 where no core) and the `ground` brightness near it, 0
    where none is seen; all (rows, columns). `evidence` is of the rows and columns counted."""

    core: np.ndarray
    confidence: np.ndarray
    ground: np.ndarray
    evidence: SearchTally = field(default_factory=SearchTally)


def remove_non_markings(found: Candidates, pixel: float, settings: CleanSettings,
                        wanted: tuple[slice, slice] | None = None, counted: tuple[slice, slice] | None = None
                        ) -> Cleaned:
    """Pixels of the candidates that are paint, for the rows and columns wanted, by default all, and evidence of those
    counted, by default the same."""
    wanted = wanted or (slice(0, found.core.shape[0]), slice(0, found.core.shape[1]))
    seen, pieces = paint_image(found, pixel, settings)
    cells = StrokeCells.of(seen, pieces.inside)
    likely = _judged(seen, cells, pieces, found.threshold.take(pieces.inside))
    values = paint_model().probability(of_pieces(likely, pieces, found.core.shape, pixel))
    if found.roads is not None:
        values = values * settings.road_odds / (values * settings.road_odds + 1 - values)
    confidence = np.zeros(found.core.shape, np.float32)
    confidence.ravel()[pieces.inside] = values
    inside = confidence[counted or wanted]
    good = inside >= settings.min_confidence
    evidence = SearchTally(narrow=np.count_nonzero(seen.narrow[counted or wanted]), likely=float(inside.sum()),
                           painted=np.count_nonzero(good & (inside > 0)), sure=float(inside[good].sum()))
    core = seen.narrow[wanted].view(bool) & (confidence[wanted] >= settings.min_confidence)
    core &= confidence[wanted] < settings.below
    return Cleaned(core, np.where(core, confidence[wanted], 0), _ground_near(cells, found.core.shape)[wanted], evidence)


def paint_image(found: Candidates, pixel: float, settings: CleanSettings) -> tuple[PaintImage, MarkingPieces]:
    """Candidates that stand out on both sides, and their pieces."""
    narrow = np.empty(found.core.shape, np.uint8)
    for strip, _, _ in row_strips(len(narrow)):
        relief = found.image[strip] - found.road[strip]
        relief /= found.threshold[strip]
        np.bitwise_and(found.core[strip], relief > settings.top_hat_ratio, out=narrow[strip].view(bool))
    pieces = marking_pieces_of(narrow, pixel, settings.min_area, settings.max_length)
    return PaintImage(found.bands, found.image, found.road, found.core.view(np.uint8), narrow,
                      clear_of_paint(found.core, found.seen, pixel), found.model, found.scale, found.contrast,
                      pixel), pieces


def _judged(seen: PaintImage, cells: StrokeCells, pieces: MarkingPieces, threshold: np.ndarray) -> np.ndarray:
    """How likely the pieces' pixels (n,) are paint by their cells, float32; what the first round leaves out has 0."""
    model, likely = paint_model(), np.zeros(len(cells.pixels), np.float32)
    if not len(likely):
        return likely
    near = stroke_figures(seen, cells, pieces.inside, threshold, pieces)
    first = model.first.likely(near, len(likely))
    chosen = first >= model.least
    if chosen.any():
        rest, grid = cells.chosen(chosen), likely_grid(cells, first)
        likely[chosen] = model.second.likely({**{name: values[chosen] for name, values in near.items()},
                                              **company_figures(rest, grid)}, len(rest.pixels))
    return likely[cells.cell]


def likely_grid(cells: StrokeCells, likely: np.ndarray) -> np.ndarray:
    """The likelihoods (k,) of the cells in a grid of all, float32, 0 elsewhere."""
    grid = np.zeros(cells.sums["clear"].shape, np.float32)
    grid.ravel()[cells.flat] = likely
    return grid


def of_pieces(values: np.ndarray, pieces: MarkingPieces, shape: tuple[int, int], pixel: float) -> np.ndarray:
    """Means (n,) of values of the pieces' pixels over their piece, or the part of a long one."""
    mean = np.bincount(pieces.labels, np.rint(values * 255), minlength=len(pieces.size)) / 255 / np.maximum(
        pieces.size, 1)
    return np.where(pieces.long[pieces.labels], along_strokes(values, pieces.inside, shape, pixel),
                    mean[pieces.labels]).astype(np.float32)


def _ground_near(cells: StrokeCells, shape: tuple[int, int]) -> np.ndarray:
    """Mean brightness of the clear ground within some metres of pixels of an image of a shape, float32."""
    light, clear = (cells.total(cells.sums[name], NEAR_REACH) for name in ("light", "clear"))
    ground = (light / np.maximum(clear, 1)).astype(np.float32)
    return ground.repeat(cells.size, axis=0)[:shape[0]].repeat(cells.size, axis=1)[:, :shape[1]]
