"""Levels, road and cast of colour of a whole image, from small pieces spread over it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from ...progress import Progress
from .colour_cast import ColourCast, colour_cast_of
from .road_markings import LevelAdjustment, MarkingSettings, ground_figures, image_brightness, level_adjustment_of
from .road_model import lit_and_grey, road_model_of, smooth_texture

_SAMPLES, _SIDE = 16, 128
"""Pieces along each side of the image at most, and pixels of a piece's side."""

_FOR_CAST = 64
"""Pieces: a smaller image shows too few streets and roofs to tell a cast from how they lie."""

_EACH = 20
"""Every so many places of the ground are enough for its cast."""


class PieceReader(Protocol):
    """What reads pieces of an image."""

    rows: int
    columns: int
    pixel: float

    def read(self, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
        """Bands, where ground is seen, and roads or None."""

    def places(self, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray]:
        """x and y of the pixels' centres."""

    def balanced(self, bands: np.ndarray, rows: slice, columns: slice, cast: ColourCast | None) -> np.ndarray:
        """Bands without a cast."""


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
    ground = _ground_of(scene, samples, levels, settings)
    cast = _cast(scene, samples, ground)
    if cast is not None:
        samples = [replace(one, bands=scene.balanced(one.bands, *one.place, cast)) for one in samples]
        levels = _levels_of(samples, settings)
        ground = _ground_of(scene, samples, levels, settings)
    return replace(levels, road=road_model_of(ground), cast=cast)


@dataclass(frozen=True)
class _Sample:
    """A small piece of the image: its rows and columns, bands, where ground is seen, and roads or None."""

    place: tuple[slice, slice]
    bands: np.ndarray
    seen: np.ndarray
    roads: np.ndarray | None


def _levels_of(samples: Sequence[_Sample], settings: MarkingSettings) -> LevelAdjustment | None:
    """Levels of samples; None where there is nothing to look at."""
    values = np.concatenate([image_brightness(one.bands, settings)[one.seen if one.roads is None
                                                                   else one.seen & one.roads] for one in samples])
    if not len(values):
        return None
    return level_adjustment_of(values, 0.0) if settings.paper else level_adjustment_of(values)


def _ground_of(scene: PieceReader, samples: Sequence[_Sample], levels: LevelAdjustment,
               settings: MarkingSettings) -> list[np.ndarray]:
    """Figures of the clear ground of each sample, see `ground_figures`."""
    return [ground_figures(one.bands, one.seen, scene.pixel, levels, settings) for one in samples]


def _cast(scene: PieceReader, samples: Sequence[_Sample], ground: Sequence[np.ndarray]) -> ColourCast | None:
    """The cast of colour that varies over the samples' ground; None where there is none."""
    if len(samples[0].bands) < 3 or len(samples) < _FOR_CAST:
        return None
    placed = []
    for one, figures in zip(samples, ground):
        x, y = (float(values.mean()) for values in scene.places(*one.place))
        placed.append(np.column_stack((figures, np.broadcast_to((x, y), (len(figures), 2))))[::_EACH])
    rows = np.concatenate(placed)
    lit = lit_and_grey(rows)
    if not lit.any():
        return None
    return colour_cast_of(rows[lit][:, [0, 1, 2, 4, 5]], smooth_texture(rows[lit][:, 0]))


def _samples(scene: PieceReader, progress: Progress) -> Iterator[_Sample]:
    """Small pieces spread over the image."""
    side = _SIDE
    across = _spread(scene.columns, side)
    for number, row in enumerate(_spread(scene.rows, side)):
        progress.step(number / _SAMPLES)
        for column in across:
            place = slice(row, min(row + side, scene.rows)), slice(column, min(column + side, scene.columns))
            yield _Sample(place, *scene.read(*place))


def _spread(length: int, side: int) -> list[int]:
    """Starts of at most `_SAMPLES` pieces spread evenly over a length."""
    count = min(-(-length // side), _SAMPLES)
    return [int(start) for start in np.linspace(0, max(length - side, 0), count)]
