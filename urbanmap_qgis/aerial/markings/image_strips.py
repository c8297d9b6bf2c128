"""Strips of rows in which images are worked on: what is made of a strip stays in the processor's cache."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

STRIP = 128
"""Rows. Of 3000 columns of float32 these are 1.5 MB."""


def row_strips(rows: int, halo: int = 0, height: int = STRIP) -> Iterator[tuple[slice, slice, slice]]:
    """Strips that cover `rows` rows: each strip's own rows, those with up to `halo` more on each side, and where its
    own lie in the latter."""
    for top in range(0, rows, height):
        strip = slice(top, min(top + height, rows))
        wide = slice(max(top - halo, 0), min(strip.stop + halo, rows))
        yield strip, wide, slice(strip.start - wide.start, strip.stop - wide.start)


def grown(place: tuple[slice, slice], by: int, shape: tuple[int, int]) -> tuple[slice, slice]:
    """Rows and columns of an image of a shape with so many more on each side, as far as the image goes."""
    rows, columns = (slice(max(part.start - by, 0), min(part.stop + by, size)) for part, size in zip(place, shape))
    return rows, columns


def within(place: tuple[slice, slice], whole: tuple[slice, slice]) -> tuple[slice, slice]:
    """Where rows and columns of an image lie in a part of it."""
    rows, columns = (slice(part.start - outer.start, part.stop - outer.start) for part, outer in zip(place, whole))
    return rows, columns


def flat_places(flags: np.ndarray, place: tuple[slice, slice]) -> np.ndarray:
    """Places in the flat image (n,) of the flags set in some rows and columns, in the order of rows."""
    rows, columns = place
    part = np.ascontiguousarray(flags[place])
    row, column = np.divmod(np.flatnonzero(part), part.shape[1])
    row += rows.start
    row *= flags.shape[1]
    row += column
    row += columns.start
    return row


def shifted_places(inside: np.ndarray, place: tuple[slice, slice], shape: tuple[int, int]) -> np.ndarray:
    """Places (n,) in a flat image of a shape of places in some of its rows and columns."""
    row, column = np.divmod(inside, place[1].stop - place[1].start)
    return (row + place[0].start) * shape[1] + column + place[1].start
