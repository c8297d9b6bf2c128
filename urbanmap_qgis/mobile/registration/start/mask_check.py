"""Whether a raster that is given as the reference is a mask of road markings at all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....errors import InputError, InsufficientDataError
from ....io.raster import RasterSampler
from ....wording import say


@dataclass(frozen=True)
class MaskCheckLimits:
    """Limits of mask check, each with its unit."""

    most_values: int = 8  # Different values that a mask may have; an image has dozens in any small part.
    most_marked: float = 0.5  # Share of the cells that may be marked: paint covers a few per cent of a road.
    block: int = 512
    blocks: int = 25


LIMITS = MaskCheckLimits()


def refuse_unless_mask(source: RasterSampler) -> None:
    """Refuse an image, a surface or an empty mask as the reference markings.

    Up to 25 blocks spread over the raster are read; the whole of it only where none of them holds a marking.

    Raises
    ------
    InputError : it has three bands or more, many values, or is marked nearly everywhere.
    InsufficientDataError : it holds no marking.
    """
    advice = "make one with “Road markings from orthophoto”"
    if source.bands > 2:
        raise InputError(say("{path} has {bands} bands and is an image, no mask of road markings: {advice}.",
                             path=source.path.name, bands=source.bands, advice=advice))
    values, marked, valid = np.zeros(0, np.float32), 0, 0
    for block in _spread(source):
        block = block[np.isfinite(block)]
        values = np.union1d(values, block)
        marked, valid = marked + int((block > 0).sum()), valid + len(block)
        if len(values) > LIMITS.most_values:
            raise InputError(say("{path} has many different values and is an image or a surface, no mask of road "
                                 "markings: {advice}.", path=source.path.name, advice=advice))
    if marked > LIMITS.most_marked * max(valid, 1):
        raise InputError(say("{path} is above 0 in {marked:.0f} % of its cells, so that it is no mask of road "
                             "markings: {advice}.", path=source.path.name, marked=100 * marked / valid, advice=advice))
    if not marked and not any((block > 0).any() for block in _blocks(source)):
        raise InsufficientDataError(say("{path} holds no road marking: no cell is above 0; {advice}, or give that of "
                                        "another place.", path=source.path.name, advice=advice))


def _spread(source: RasterSampler):
    """Blocks at regular distances over the raster."""
    side = int(LIMITS.blocks**0.5)
    starts = [np.unique(np.linspace(0, max(length - LIMITS.block, 0), side).astype(int))
              for length in source.grid.shape]
    for top in starts[0]:
        for left in starts[1]:
            yield _block(source, int(top), int(left))


def _blocks(source: RasterSampler):
    """All blocks of the raster."""
    for top in range(0, source.grid.rows, LIMITS.block):
        for left in range(0, source.grid.columns, LIMITS.block):
            yield _block(source, top, left)


def _block(source: RasterSampler, top: int, left: int) -> np.ndarray:
    return source.read(slice(top, min(top + LIMITS.block, source.grid.rows)),
                       slice(left, min(left + LIMITS.block, source.grid.columns)))
