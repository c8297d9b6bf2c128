"""Outlines of a 2.5D surface in a frame, and what they enclose.

Filling every triangle of a surface costs as much as all its triangles. Neighbours that face the camera share a side
that one runs forwards and the other backwards, so these sides cancel: only the sides where the surface ends or turns
away remain. The number of triangles over a pixel is the number of remaining sides that pass it on the left, those
running down the image counted up and those running up counted down. The union of the triangles is where that number
is not 0, exactly as if each had been filled.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class SilhouetteEdges:
    """Directed sides in a frame, pixels: from (column_a, row_a) to (column_b, row_b), all (n,)."""

    column_a: np.ndarray
    row_a: np.ndarray
    column_b: np.ndarray
    row_b: np.ndarray

    def __len__(self) -> int:
        return len(self.row_a)

    @classmethod
    def joined(cls, parts: list[SilhouetteEdges]) -> SilhouetteEdges:
        """All sides of several sets."""
        if not parts:
            return cls(*(np.zeros(0) for _ in range(4)))
        return cls(*(np.concatenate([getattr(part, name) for part in parts])
                     for name in ("column_a", "row_a", "column_b", "row_b")))

    def within(self, width: int, height: int) -> SilhouetteEdges:
        """Those that can matter to a frame: not above, below or right of it, and not along a row."""
        top, bottom = np.minimum(self.row_a, self.row_b), np.maximum(self.row_a, self.row_b)
        keep = ((np.ceil(bottom) > np.maximum(np.ceil(top), 0)) & (top <= height - 1)
                & (np.minimum(self.column_a, self.column_b) <= width - 1))
        return SilhouetteEdges(self.column_a[keep], self.row_a[keep], self.column_b[keep], self.row_b[keep])


def silhouette_edges(column: np.ndarray, row: np.ndarray, z: np.ndarray, high: np.ndarray) -> SilhouetteEdges:
    """Sides that remain of the triangles of a grid that face the camera and have a high corner.

    Each cell of four neighbouring vertices is cut along the diagonal with the smaller difference of height, which
    follows eaves better than a fixed one.

    Parameters
    ----------
    column, row : (m, n) where the grid's vertices, row 0 northernmost and column 0 westernmost, appear in the frame;
        NaN where they do not.
    z : (m, n) their heights.
    high : (m, n) whether they count as raised.
    """
    falling = np.abs(z[:-1, :-1] - z[1:, 1:]) <= np.abs(z[:-1, 1:] - z[1:, :-1])
    first, last = slice(None, -1), slice(1, None)
    nw, ne, sw, se = (first, first), (first, last), (last, first), (last, last)

    def shown(a, b, c):
        """Triangles a, b, c, counterclockwise from above, that are high and face the camera."""
        turn = ((column[b] - column[a]) * (row[c] - row[a]) - (row[b] - row[a]) * (column[c] - column[a]))
        return (turn < 0) & (high[a] | high[b] | high[c])

    with np.errstate(invalid="ignore"):
        west = np.where(falling, shown(nw, sw, se), shown(nw, sw, ne))
        east = np.where(falling, shown(nw, se, ne), shown(sw, se, ne))
    south, north = np.where(falling, west, east), np.where(falling, east, west)

    parts = [
        # The diagonal belongs to the western triangle in one sense and to the eastern one in the other.
        _sides(column, row, falling & west & ~east, se, nw), _sides(column, row, falling & east & ~west, nw, se),
        _sides(column, row, ~falling & west & ~east, sw, ne), _sides(column, row, ~falling & east & ~west, ne, sw)]
    across = (slice(None), first), (slice(None), last)
    above, below = _framed(south, axis=0)[:-1], _framed(north, axis=0)[1:]
    parts += [_sides(column, row, above & ~below, *across), _sides(column, row, below & ~above, *across[::-1])]
    down = (first, slice(None)), (last, slice(None))
    left, right = _framed(east, axis=1)[:, :-1], _framed(west, axis=1)[:, 1:]
    parts += [_sides(column, row, right & ~left, *down), _sides(column, row, left & ~right, *down[::-1])]
    return SilhouetteEdges.joined(parts)


def _framed(flags: np.ndarray, axis: int) -> np.ndarray:
    """Flags with a line of False before and after along an axis."""
    return np.pad(flags, [(1, 1) if k == axis else (0, 0) for k in (0, 1)])


def _sides(column: np.ndarray, row: np.ndarray, chosen: np.ndarray, start: tuple, stop: tuple) -> SilhouetteEdges:
    """Sides of the chosen cells or lines between two corners given as slices."""
    down, across = np.divmod(np.flatnonzero(chosen), chosen.shape[1])
    place = down * column.shape[1] + across
    begin, end = (place + (rows.start or 0) * column.shape[1] + (columns.start or 0)
                  for rows, columns in (start, stop))
    return SilhouetteEdges(column.take(begin), row.take(begin), column.take(end), row.take(end))


def fill_silhouette(sides: SilhouetteEdges, width: int, first_row: int, rows: int) -> np.ndarray:
    """Pixels of a strip of rows that the sides enclose: (rows, width) bool.

    A pixel belongs where its centre lies; a centre on a side belongs to what is right of or below it.
    """
    down = sides.row_b > sides.row_a
    # From the upper end, so that a side gives the same pixels whichever way it runs.
    top, bottom = np.where(down, sides.row_a, sides.row_b), np.where(down, sides.row_b, sides.row_a)
    column_top = np.where(down, sides.column_a, sides.column_b)
    start = np.maximum(np.ceil(top), first_row).astype(np.int64)
    stop = np.minimum(np.ceil(bottom), first_row + rows).astype(np.int64)
    touched = np.flatnonzero(stop > start)
    count = (stop - start)[touched]
    owner = np.repeat(touched, count)
    row = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count - start[touched], count)
    slope = (sides.column_b[touched] - sides.column_a[touched]) / (sides.row_b[touched] - sides.row_a[touched])
    column = column_top[owner] + (row - top[owner]) * np.repeat(slope, count)
    place = (row - first_row) * (width + 1) + np.clip(np.ceil(column), 0, width).astype(np.int64)
    change = np.zeros((rows, width + 1), np.int32)
    if len(place):
        # Few places change; counting into all of them would take longer than all else.
        order = np.argsort(place, kind="stable")
        place = place[order]
        first = np.flatnonzero(np.diff(place, prepend=-1))
        change.ravel()[place[first]] = np.add.reduceat(np.where(down[owner[order]], 1, -1), first)
    return np.cumsum(change, axis=1, out=change)[:, :width] != 0
