"""Answers to doubtful markings of an orthophoto, and what is learned from them: only tiles with answers are read."""

from __future__ import annotations

import os
from contextlib import ExitStack
from dataclasses import dataclass

import numpy as np
import shapely
from rasterio.features import rasterize
from rasterio.transform import Affine

from ...errors import InputError
from ...io.raster import own_gdal
from ...progress import SILENT, Progress
from ...wording import say
from .image_strips import within
from .learning.answered_pieces import AnsweredCells, LearnedAnswers, learned_from, spread_of
from .marking_files import TILE, image_tiles, open_orthophoto, tile_window
from .marking_filter import confidence_and_figures
from .marking_polygons import CACHE
from .orthophoto_reader import OrthophotoReader, SearchArea
from .road_markings import LevelAdjustment, MarkingSettings, candidates_of, tile_step
from .sampled_levels import sampled_levels

DOUBTFUL = 0.3, 0.7
"""Confidence of markings that are worth a question."""

_SOME = 20_000
"""Cells of a tile at most that tell how figures are spread."""


@dataclass(frozen=True)
class MarkingAnswers:
    """Polygons (n,) in the orthophoto's CRS, and whether each is paint, bool."""

    polygons: np.ndarray
    paint: np.ndarray


def learned_from_orthophoto(path: str | os.PathLike, answers: MarkingAnswers, places: SearchArea | None = None,
                            settings: MarkingSettings | None = None, metres_per_unit: float = 1.0,
                            progress: Progress = SILENT) -> LearnedAnswers:
    """Correction of the confidence of an orthophoto's markings by answers.

    Parameters are those of `markings_from_orthophoto`.

    Raises
    ------
    InputError : the orthophoto cannot be used, roads are given (the confidence does not ask for the ground then),
        nothing is cleaned, or there are too few answers of either kind.
    """
    settings, places = settings or MarkingSettings(), places or SearchArea()
    if settings.cleaning is None:
        raise InputError(say("Nothing is learned from answers where nothing is left out: clean the markings, and do "
                             "not take the paper's method."))
    if places.roads is not None:
        raise InputError(say("Where roads are given, the confidence does not ask for the ground, and nothing is "
                             "learned from answers: leave out the roads, or the answers."))
    with own_gdal(CACHE), ExitStack() as stack:
        scene = open_orthophoto(path, places, settings, metres_per_unit, stack)
        levels = sampled_levels(scene, settings, progress.part(0.0, 0.2))
        tree, parts = shapely.STRtree(answers.polygons), []
        step = tile_step(scene.pixel, settings)
        for rows, columns, done in image_tiles(scene, max(TILE // scene.factor, 1), step):
            progress.part(0.2, 1.0).step(done)
            near = tree.query(shapely.Polygon(_corners(scene, rows, columns)), predicate="intersects")
            if levels is not None and len(near):
                parts.append(_of_tile(scene, rows, columns, levels, settings, answers, np.sort(near)))
    return learned_from(_joined([part for part in parts if part is not None], answers.paint),
                        "trained" if settings.cleaning.trained else "profile")


def doubtful_markings(confidence: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Numbers of markings by their confidence (n,) and area (n,) that are worth a question, those with the most area in
    doubt first: its variance, were all of a marking paint or none. Specks, which the eye can hardly tell, come last."""
    chosen = np.flatnonzero((confidence >= DOUBTFUL[0]) & (confidence <= DOUBTFUL[1]))
    doubt = area[chosen] * confidence[chosen] * (1 - confidence[chosen])
    return chosen[np.argsort(-doubt, kind="stable")]


def _corners(scene: OrthophotoReader, rows: slice, columns: slice) -> list[tuple[float, float]]:
    place = scene.transform
    return [(place.a * column + place.b * row + place.c, place.d * column + place.e * row + place.f)
            for column, row in ((columns.start, rows.start), (columns.stop, rows.start), (columns.stop, rows.stop),
                                (columns.start, rows.stop))]


def _of_tile(scene: OrthophotoReader, rows: slice, columns: slice, levels: LevelAdjustment, settings: MarkingSettings,
             answers: MarkingAnswers, near: np.ndarray) -> AnsweredCells | None:
    """Cells of a tile with answers, whose numbers are `near`; None where nothing bright and narrow is in it."""
    window = tile_window(scene, rows, columns, settings)
    bands, seen, _ = scene.read(*window)
    if not seen.any():
        return None
    found = candidates_of(scene.balanced(bands, *window, levels.cast), seen, None, scene.pixel, levels, settings)
    inner = within((rows, columns), window)
    places, confidence, figures = confidence_and_figures(found, scene.pixel, settings.cleaning, inner)
    if not len(figures.pixels):
        return None
    corner = scene.transform * Affine.translation(window[1].start, window[0].start)
    number = np.zeros(seen.shape, np.int32)
    inside = rasterize([(answers.polygons[k], int(k) + 1) for k in near], seen.shape, transform=corner, dtype="int32",
                       all_touched=True)
    number[inner] = inside[inner]
    answer, count = _answer_of_cells(number.take(places), figures.cell, len(figures.pixels))
    answered = count > 0
    table = np.column_stack(list(figures.values.values()))
    return AnsweredCells(tuple(figures.values), table[answered], confidence[answered], answer[answered], answers.paint,
                         count[answered], spread_of(table[::max(len(table) // _SOME, 1)].T))


def _answer_of_cells(number: np.ndarray, cell: np.ndarray, cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Answer of each cell (from 0) by that (from 1; 0 for none) of most of its pixels' (n,), and how many these are."""
    answered = np.flatnonzero(number)
    pairs, pixels = np.unique(np.stack([cell[answered], number[answered]]), axis=1, return_counts=True)
    order = np.argsort(pixels, kind="stable")  # the most frequent comes last, and stays
    answer, count = np.zeros(cells, np.intp), np.zeros(cells, np.intp)
    answer[pairs[0][order]] = pairs[1][order] - 1
    count[pairs[0][order]] = pixels[order]
    return answer, count


def _joined(parts: list[AnsweredCells], paint: np.ndarray) -> AnsweredCells:
    """Cells of all tiles; figures are spread as on the average of these."""
    if not parts:
        empty = np.empty((0, 0))
        return AnsweredCells((), empty, np.empty(0), np.empty(0, np.intp), paint, np.empty(0), np.ones((2, 0)))
    joined = (np.concatenate([getattr(part, name) for part in parts])
              for name in ("figures", "confidence", "answer", "pixels"))
    figures, confidence, answer, pixels = joined
    return AnsweredCells(parts[0].names, figures, confidence, answer, paint, pixels,
                         np.mean([part.spread_of for part in parts], axis=0))
