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
    """All patterns as rasters about the window's middle, transformed for correlation; `tail` (n,) m ahead of it."""

    kinds: tuple[str, ...]
    shapes: tuple[shapely.Geometry, ...]
    flanks: tuple[tuple[shapely.Geometry, ...], ...]
    branches: tuple[tuple[tuple[shapely.Geometry, shapely.Geometry], ...], ...]
    backwards: np.ndarray
    tail: np.ndarray
    area: np.ndarray
    pattern: np.ndarray
    grown: np.ndarray
    around: np.ndarray


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
                 rasters.sum(axis=(1, 2)),
                 *(np.conj(scipy.fft.rfft2(one)) for one in (rasters, grown, around)))


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
    bank = _bank()
    spectrum = scipy.fft.rfft2(raster(paint))
    overlap = _correlation(spectrum, bank.pattern)
    wanted = np.float32(least_complete) * bank.area
    painted = np.flatnonzero(overlap.max(axis=1) >= wanted)
    overlap = overlap[painted]
    row, shift = np.nonzero(overlap >= wanted[painted, None])  # few of the places
    if tails is not None:
        up, right = _offsets(shift)
        ahead = up * CELL + bank.tail[painted[row]]
        inside = (right * CELL >= tails[0]) & (right * CELL <= tails[1]) & (ahead >= tails[2]) & (ahead <= tails[3])
        row, shift = row[inside], shift[inside]
    if not len(row):
        return []
    complete = np.clip(overlap[row, shift] / bank.area[painted[row]], 0.0, 1.0)
    inside, at_all = (_correlation(spectrum, one[painted])[row, shift] for one in (bank.grown, bank.around))
    precise = np.clip(inside / np.maximum(at_all, 1.0), 0.0, 1.0)
    score = 2 * complete * precise / np.maximum(complete + precise, 1e-6)
    found: dict[tuple[str, bool], int] = {}
    for place in _best_of_each(row, score):
        number = painted[row[place]]
        key = bank.kinds[number], bool(bank.backwards[number])
        if score[place] > max(least_score, 0.0) and (key not in found or score[place] > score[found[key]]):
            found[key] = place
    matches = [_match(bank, float(score[k]), int(painted[row[k]]), int(shift[k]), float(complete[k]), float(precise[k]))
            for k in found.values()]
    return sorted(matches, key=lambda match: -match.score)


def _best_of_each(row: np.ndarray, score: np.ndarray) -> np.ndarray:
    """Places of the highest score of each row, the first of equal ones; `row` (n,) is in order."""
    order = np.lexsort((np.arange(len(row)), -score, row))
    return order[np.r_[True, np.diff(row[order]) > 0]]


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


def _correlation(spectrum: np.ndarray, patterns: np.ndarray) -> np.ndarray:
    """Sum over the window of cells (by their `spectrum`) times each pattern, by its shift, circular (row by row, of
    `ROWS` x `COLUMNS`), (n, shifts)."""
    return scipy.fft.irfft2(spectrum * patterns, s=(ROWS, COLUMNS), overwrite_x=True).reshape(len(patterns), -1)
