"""Shapes of arrows and diamonds on roads, and how well paint agrees with them wherever they may lie."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
import scipy.fft
import shapely
from shapely import affinity

CELL = 0.1
"""Of the rasters that paint and patterns are compared on, m."""

ROWS, COLUMNS = 128, 64
"""Of a window, cells: 12.8 m along, 6.4 m across."""

_FINER, _FULL = 4, 240
"""A cell is filled in so many parts each way, by a number that the parts of a cell divide: means are exact."""

TOLERANCE, AROUND = 0.1, 0.7
"""By so much paint may lie beside the pattern; so far around it paint speaks against it, m."""

SHAFT = 0.32
"""Blurred paint of a shaft or a line may be so wide, m."""

LESS, MORE = ("arrow straight", "arrow left", "arrow right"), "arrow straight "
"""Arrows with one head, each part of one of those with two, whose names begin with the last."""

BLUR, BESIDE, OFF = 0.12, 0.45, 0.055
"""Paint of one head may reach so far beyond it; paint so near a second head tells whether that can be seen; a pattern
may lie so far beside its paint, m."""

HALF = 2.5
"""Of a pattern's length in its usual size, m: tails lie so far behind the middle."""

SCALES = (0.9, 1.0, 1.15)
"""Sizes of symbols against the usual ones."""

# Metres, (right, forward) of the tail. A slim and a broad form, as both are painted.
_SLIM_SHAFT = [(-0.075, 0.0), (0.075, 0.0), (0.075, 3.3), (-0.075, 3.3)]
_SLIM_HEAD = [(-0.35, 3.2), (0.35, 3.2), (0.0, 5.0)]
_SLIM_TURN = [(-0.075, 0.0), (0.075, 0.0), (0.075, 3.2), (0.55, 3.2), (0.55, 2.7), (1.2, 3.4), (0.55, 4.1), (0.55, 3.6),
              (-0.075, 3.6)]
_BROAD_SHAFT = [(-0.085, 0.0), (0.085, 0.0), (0.085, 3.1), (-0.085, 3.1)]
_BROAD_HEAD = [(-0.45, 3.0), (0.45, 3.0), (0.0, 5.0)]
_BROAD_TURN = [(-0.08, 0.0), (0.08, 0.0), (0.09, 2.64), (0.45, 2.83), (0.45, 2.36), (1.15, 3.35), (0.45, 3.86),
               (0.45, 3.34), (-0.08, 3.16)]
_BRANCH = [(0.0, 1.2), (0.09, 1.24), (0.455, 1.43), (0.455, 0.94), (1.15, 1.94), (0.455, 2.44), (0.455, 1.93),
           (0.09, 1.785), (0.0, 1.7)]


@dataclass(frozen=True)
class PatternMatch:
    """Where a pattern agrees best with paint.

    Attributes
    ----------
    kind : of the pattern.
    score : 0 to 1, harmonic mean of the next two.
    complete : share of the pattern that is painted.
    precise : share of the paint about it that lies in it.
    shape : the pattern at its place.
    backwards : read against the direction given.
    flanks : the two sides of each arrow's head, beyond the width of a shaft.
    tail : place (2,) of the end at which it begins.
    branches : what each arrow ahead and to a side has more at this place, and the part of `shape` beside that; none
        where `shape` is such an arrow itself.
    """

    kind: str
    score: float
    complete: float
    precise: float
    shape: shapely.Geometry
    backwards: bool
    flanks: tuple[shapely.Geometry, ...]
    tail: np.ndarray
    branches: tuple[tuple[shapely.Geometry, shapely.Geometry], ...] = ()


@dataclass(frozen=True)
class _Bank:
    """All patterns as rasters about the window's middle; `tail` (n,) m ahead of it.

    `columns` (n, COLUMNS) is what each has in each column; `pattern` (n, 1, ...) and `grown_around` (n, 2, ...) are
    transformed for correlation.
    """

    kinds: tuple[str, ...]
    shapes: tuple[shapely.Geometry, ...]
    flanks: tuple[tuple[shapely.Geometry, ...], ...]
    branches: tuple[tuple[tuple[shapely.Geometry, shapely.Geometry], ...], ...]
    backwards: np.ndarray
    tail: np.ndarray
    area: np.ndarray
    columns: np.ndarray
    pattern: np.ndarray
    grown_around: np.ndarray


def _mirrored(ring: list[tuple[float, float]]) -> list[tuple[float, float]]:
    return [(-x, y) for x, y in ring]


def _forms() -> list[tuple[str, shapely.Geometry, list]]:
    """Kinds with their shapes in metres, read along +y, and the corners (base, base, tip) of the heads."""
    def of(*rings):
        return shapely.union_all([shapely.Polygon(ring) for ring in rings])

    diamond = shapely.Polygon([(0, 0), (0.75, 2.5), (0, 5), (-0.75, 2.5)])
    forms = [("arrow straight", of(_SLIM_SHAFT, _SLIM_HEAD), [_SLIM_HEAD]),
             ("arrow straight", of(_BROAD_SHAFT, _BROAD_HEAD), [_BROAD_HEAD]),
             ("diamond", diamond.difference(affinity.scale(diamond, 0.72, 0.72, origin=(0, 2.5))), [])]
    for side, turned in (("right", list), ("left", _mirrored)):
        slim, broad, branch = ([turned(ring)[k] for k in at] for ring, at in (
            (_SLIM_TURN, (4, 6, 5)), (_BROAD_TURN, (4, 6, 5)), (_BRANCH, (3, 5, 4))))
        forms += [(f"arrow {side}", of(turned(_SLIM_TURN)), [slim]),
                  (f"arrow {side}", of(turned(_BROAD_TURN)), [broad]),
                  (f"arrow straight {side}", of(_SLIM_SHAFT, _SLIM_HEAD, turned(_BRANCH)), [_SLIM_HEAD, branch]),
                  (f"arrow straight {side}", of(_BROAD_SHAFT, _BROAD_HEAD, turned(_BRANCH)), [_BROAD_HEAD, branch])]
    return forms


def _flanks(head: list[tuple[float, float]]) -> list[shapely.Geometry]:
    """The two sides of a head (base, base, tip) beyond a shaft along its middle."""
    one, other, tip = np.array(head, float)
    base = (one + other) / 2.0
    along = shapely.LineString([base - (tip - base), tip + (tip - base)]).buffer(SHAFT / 2.0, cap_style="flat")
    return list(shapely.get_parts(shapely.Polygon(head).difference(along)))


def _branch(shape: shapely.Geometry, more: shapely.Geometry) -> tuple[shapely.Geometry, shapely.Geometry]:
    """What a shape with more heads has beyond `shape`, and the part of `shape` beside that."""
    extra = more.difference(shape.buffer(BLUR))
    return extra, shape.buffer(-OFF).intersection(extra.buffer(BESIDE))


@lru_cache(maxsize=1)
def _bank() -> _Bank:
    kinds, shapes, flanks, backwards, sizes = [], [], [], [], []
    for kind, form, heads in _forms():
        sides = [side for head in heads for side in _flanks(head)]
        for scale in SCALES:
            placed = [affinity.translate(affinity.scale(one, scale, scale, origin=(0, 0)), 0.0, -HALF * scale)
                      for one in (form, *sides)]
            for turned in (False, True) if kind != "diamond" else (False,):
                shape, *beside = (affinity.rotate(one, 180.0, origin=(0, 0)) if turned else one for one in placed)
                kinds.append(kind)
                shapes.append(shape)
                flanks.append(tuple(beside))
                backwards.append(turned)
                sizes.append(scale)
    branches = [tuple(_branch(shapes[n], shapes[k]) for k in range(len(kinds)) if kinds[k].startswith(MORE) and
                      (sizes[k], backwards[k]) == (sizes[n], backwards[n])) if kinds[n] in LESS else ()
                for n in range(len(kinds))]
    rasters = np.stack([raster([shape]) for shape in shapes])
    grown = np.stack([raster([shape.buffer(TOLERANCE)]) for shape in shapes])
    around = np.stack([raster([shape.buffer(AROUND)]) for shape in shapes])
    return _Bank(tuple(kinds), tuple(shapes), tuple(flanks), tuple(branches), np.array(backwards),
                 np.array(sizes) * np.where(backwards, HALF, -HALF),
                 rasters.sum(axis=(1, 2)), rasters.sum(axis=1),
                 *(np.conj(_spectrum(np.stack(ones, axis=1))) for ones in ((rasters,), (grown, around))))


def raster(shapes: list[shapely.Geometry]) -> np.ndarray:
    """Share of each cell (ROWS, COLUMNS) float32 that shapes cover; 0, 0 is the middle of the window, rows go up."""
    fine = np.zeros((_FINER * ROWS, _FINER * COLUMNS), np.uint8)
    for part in shapely.get_parts(shapes):
        if part.geom_type != "Polygon":
            continue
        rings = [part.exterior, *part.interiors]
        middle = np.array((_FINER * COLUMNS, _FINER * ROWS)) / 2
        places = [(shapely.get_coordinates(ring) / CELL * _FINER + middle - 0.5) * 16 for ring in rings]
        mask = np.zeros_like(fine) if len(rings) > 1 else fine
        cv2.fillPoly(mask, [np.round(place).astype(np.int32) for place in places], _FULL, shift=4)
        if mask is not fine:
            np.maximum(fine, mask, out=fine)
    return cv2.resize(fine, (COLUMNS, ROWS), interpolation=cv2.INTER_AREA) / np.float32(_FULL)


def matches(paint: list[shapely.Geometry], least_complete: float, least_score: float = 0.0,
            tails: tuple[float, float, float, float] | None = None) -> list[PatternMatch]:
    """The best place of each kind of symbol, best first.

    Parameters
    ----------
    paint : in the window's frame, the road along +y, its middle at 0, 0.
    least_complete : places where less of the pattern is painted do not count, 0 to 1.
    least_score : kinds that agree less are left out.
    tails : least and greatest place to the right and ahead of patterns' tails; without it they may lie anywhere.
    """
    bank, painted = _bank(), raster(paint)
    spectrum, wanted = _spectrum(painted), np.float32(least_complete) * bank.area
    number, column = np.nonzero(_most_in_columns(painted.sum(axis=0), bank.columns) >= wanted[:, None])
    if tails is not None:
        right = _offsets(column)[1] * CELL
        near = (right >= tails[0]) & (right <= tails[1])
        number, column = number[near], column[near]
    overlap = _correlation(spectrum, bank.pattern, number, column)[0]
    pair, row = np.nonzero(overlap >= wanted[number, None])  # few of the places
    if tails is not None:
        ahead = _offsets(row * COLUMNS)[0] * CELL + bank.tail[number[pair]]
        near = (ahead >= tails[2]) & (ahead <= tails[3])
        pair, row = pair[near], row[near]
    if not len(pair):
        return []
    overlap = overlap[pair, row]
    kept, pair = np.unique(pair, return_inverse=True)
    number, column = number[kept], column[kept]
    inside, at_all = _correlation(spectrum, bank.grown_around, number, column)[:, pair, row]
    number, shift = number[pair], row * COLUMNS + column[pair]
    complete = np.clip(overlap / bank.area[number], 0.0, 1.0)
    precise = np.clip(inside / np.maximum(at_all, 1.0), 0.0, 1.0)
    score = 2 * complete * precise / np.maximum(complete + precise, 1e-6)
    found: dict[tuple[str, bool], int] = {}
    for place in _best_of_each(number, shift, score):
        key = bank.kinds[number[place]], bool(bank.backwards[number[place]])
        if score[place] > max(least_score, 0.0) and (key not in found or score[place] > score[found[key]]):
            found[key] = place
    matches = [_match(bank, float(score[k]), int(number[k]), int(shift[k]), float(complete[k]), float(precise[k]))
            for k in found.values()]
    return sorted(matches, key=lambda match: -match.score)


def _best_of_each(number: np.ndarray, shift: np.ndarray, score: np.ndarray) -> np.ndarray:
    """Places of the highest score of each number, the least shift of equal ones; `number` (n,) is in order."""
    first = np.flatnonzero(np.r_[True, np.diff(number) > 0])
    highest = np.repeat(np.maximum.reduceat(score, first), np.diff(np.r_[first, len(number)]))
    best = np.flatnonzero(score == highest)
    best = best[np.lexsort((shift[best], number[best]))]
    return best[np.r_[True, np.diff(number[best]) > 0]]


def _offsets(shift: np.ndarray | int) -> tuple[np.ndarray, np.ndarray]:
    """Cells ahead and to the right that shifts of a correlation stand for."""
    row, column = np.divmod(shift, COLUMNS)
    return (row + ROWS // 2) % ROWS - ROWS // 2, (column + COLUMNS // 2) % COLUMNS - COLUMNS // 2


def _match(bank: _Bank, score: float, number: int, shift: int, complete: float, precise: float) -> PatternMatch:
    """A pattern of the bank at a shift."""
    up, right = (int(cells) for cells in _offsets(shift))
    flanks, branches = bank.flanks[number], bank.branches[number]
    parts = np.array([bank.shapes[number], *flanks, *(part for pair in branches for part in pair)], object)
    shape, *placed = shapely.transform(parts, lambda xy: np.add(xy, (right * CELL, up * CELL)))
    beside, rest = tuple(placed[:len(flanks)]), placed[len(flanks):]
    return PatternMatch(bank.kinds[number], score, complete, precise, shape, bool(bank.backwards[number]), beside,
                        np.array([right * CELL, up * CELL + bank.tail[number]]), tuple(zip(rest[::2], rest[1::2])))


def _spectrum(cells: np.ndarray) -> np.ndarray:
    """Of rasters (..., ROWS, COLUMNS), by frequency across and, half of them, along."""
    return scipy.fft.rfft2(np.ascontiguousarray(np.swapaxes(cells, -1, -2)))


def _most_in_columns(cells: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """No shift along makes the paint in patterns more than this, by the shift across, (n, COLUMNS): in each column it
    is no more than what the paint (`cells`, COLUMNS) and what the pattern (`columns`) has there."""
    used = np.flatnonzero(columns.any(axis=0))
    moved = cells[(used + np.arange(COLUMNS)[:, None]) % COLUMNS]
    return np.minimum(moved[None], columns[:, None, used]).sum(axis=2)


_ACROSS = (np.exp(2j * np.pi / COLUMNS * np.outer(np.arange(COLUMNS), np.arange(COLUMNS))) / COLUMNS).astype(
    np.complex64)
"""Back from frequencies across to columns."""


def _correlation(spectrum: np.ndarray, patterns: np.ndarray, number: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Sum over the window of cells (by their `spectrum`) times patterns, by their shift, circular.

    Of each pattern only some shifts across are worth the transform back: `number` (p,), in order, and `column` (p,)
    tell which. By what `patterns` (n, k, ...) hold, by pair, by shift along: (k, p, ROWS).
    """
    along = np.empty((patterns.shape[1], len(number), spectrum.shape[-1]), np.complex64)
    borders = np.searchsorted(number, np.arange(len(patterns) + 1))
    for one, first, last in zip(patterns, borders[:-1], borders[1:]):
        if last > first:
            along[:, first:last] = _ACROSS[column[first:last]] @ (spectrum * one)
    return scipy.fft.irfft(along, n=ROWS, axis=-1, overwrite_x=True)
