"""Levels and road of a whole image, from small pieces spread over it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Optional, Protocol

import numpy as np

from ...progress import Progress
from .road_markings import LevelAdjustment, MarkingSettings, ground_figures, image_brightness, level_adjustment_of
from .road_model import road_model_of

_SAMPLES, _SIDE = 16, 128
"""Pieces along each side of the image at most, and pixels of a piece's side."""


Sample = tuple[np.ndarray, np.ndarray, Optional[np.ndarray]]
"""Bands of a small piece of the image, where ground is seen, and roads or None."""


class PieceReader(Protocol):
    """What reads pieces of an image."""

    rows: int
    columns: int
    pixel: float

    def read(self, rows: slice, columns: slice) -> Sample:
        """One piece."""


def sampled_levels(scene: PieceReader, settings: MarkingSettings, progress: Progress) -> LevelAdjustment | None:
    """Levels and road from small pieces spread over the image; None where there is nothing to look at.

    They are taken once for the whole image, so that tiles do not differ.
    """
    if settings.levels is not None:
        return settings.levels
    samples = list(_samples(scene, progress.part(0.0, 0.8)))  # a few megapixels at most: read once
    levels = _levels_of(samples, settings)
    if levels is None or settings.cleaning is None:
        return levels
    ground = [ground_figures(bands, seen, scene.pixel, levels, settings) for bands, seen, _roads in samples]
    return replace(levels, road=road_model_of(ground))


def _levels_of(samples: Sequence[Sample], settings: MarkingSettings) -> LevelAdjustment | None:
    """Levels of samples; None where there is nothing to look at."""
    values = np.concatenate([image_brightness(bands, settings)[seen if roads is None else seen & roads]
                             for bands, seen, roads in samples])
    if not len(values):
        return None
    return level_adjustment_of(values, 0.0) if settings.paper else level_adjustment_of(values)


def _samples(scene: PieceReader, progress: Progress) -> Iterator[Sample]:
    """Small pieces spread over the image."""
    side = _SIDE
    across = _spread(scene.columns, side)
    for number, row in enumerate(_spread(scene.rows, side)):
        progress.step(number / _SAMPLES)
        for column in across:
            place = slice(row, min(row + side, scene.rows)), slice(column, min(column + side, scene.columns))
            yield scene.read(*place)


def _spread(length: int, side: int) -> list[int]:
    """Starts of at most `_SAMPLES` pieces spread evenly over a length."""
    count = min(-(-length // side), _SAMPLES)
    return [int(start) for start in np.linspace(0, max(length - side, 0), count)]
