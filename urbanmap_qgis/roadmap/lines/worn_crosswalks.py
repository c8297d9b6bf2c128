"""Worn crosswalks: bars in pieces, and ends without paint, by what the sure crosswalks of the area show.

Crosswalks of an area repeat each other: the bars' distance, width and length are those of a standard, and those across
one street begin and end at the same kerbs. What is told so has a low share of paint (`BarRow.fill`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from .crosswalk_extent import BarRow, bar_fill, painted_run
from .strokes import Stroke


@dataclass(frozen=True)
class WornCrosswalksLimits:
    """Limits of worn crosswalks, each with its unit."""

    alike: float = 0.05  # Two crosswalks are of one pattern where their bars' distances differ by less, of them,
    alike_length: float = 0.5  # and their lengths by less, m.
    least_piece: float = 0.3  # Pieces of bars, m.
    straight: float = 0.7  # So much of a piece's length lies between its ends at least.
    least_anchor: float = 0.35  # A piece so long, of a bar's length, is looked around for others.
    turn: float = 6.0  # Bars run within so many degrees of it.
    lean: float = 15.0  # Worn pieces lean by so much at most.
    together: float = 0.5  # Share of the pieces that must lie at regular distances.
    reach: int = 8  # Bars beside it that are looked for.
    least_fill: float = 0.2  # A bar is there where its place holds so much more paint than those beside it, 0 to 1.
    # The same, of all bars of a row, times the share of them that show: letters are less even.
    least_mean_fill: float = 0.3
    fewest: int = 4  # Bars that show,
    fewest_faced: int = 2  # and where a row across the same street says how far the bars reach,
    least_faced_fill: float = 0.45  # with so much more paint at their places than beside them.
    most_between: float = 0.5  # No place between the bars or beside the last holds more, of the bars' paint.
    beyond: float = 0.5  # Before and behind the bars there is so much of their paint at most,
    margin: float = 1.0  # as far as this, m.
    # Rows across one street: so far apart along it, m, on both sides of a junction and at both ends of a block, turned
    # by so many degrees there; where they begin or end on one line, to so many metres, both reach as far as the longer
    # one.
    facing: tuple[float, float, float] = (6.0, 30.0, 70.0)
    facing_turn: tuple[float, float] = (2.5, 1.0)
    same_edge: float = 0.4
    least_long_fill: float = 0.15  # Paint at all its bars' places, with those that only the other one shows.


LIMITS = WornCrosswalksLimits()


@dataclass(frozen=True)
class BarPattern:
    """Distance, half width and length of bars, m."""

    pitch: float
    half: float
    length: float


def bar_patterns(rows: Sequence[BarRow]) -> list[BarPattern]:
    """The patterns that two rows or more share."""
    left, found = [(row.pitch, row.half, row_length(row)) for row in rows], []
    while left:
        pitch, _, length = left[0]
        same = [one for one in left if abs(one[0] - pitch) <= LIMITS.alike * pitch
                and abs(one[2] - length) <= LIMITS.alike_length]
        if len(same) > 1:
            found.append(BarPattern(*np.median(same, axis=0).tolist()))
        left = [one for one in left if one not in same]
    return found


def row_length(row: BarRow) -> float:
    """Length of a row's bars at its middle, m."""
    middle = row.first + (row.count - 1) * row.pitch / 2.0
    return float((row.far[0] - row.near[0]) * middle + row.far[1] - row.near[1])


def worn_rows(strokes: Sequence[Stroke], rows: Sequence[BarRow], paint: shapely.STRtree) -> list[BarRow]:
    """Further rows of the patterns of the sure ones, `rows`, of which at least two bars show, also in pieces.

    Parameters
    ----------
    paint : tree over the polygons of the markings.
    """
    found: list[BarRow] = []
    for pattern in bar_patterns(rows):
        pieces = _Pieces.of(strokes, pattern)
        used = pieces.within([*rows, *found])
        for k in np.argsort(-pieces.length, kind="stable"):
            if pieces.length[k] < LIMITS.least_anchor * pattern.length:
                break
            row = None if used[k] else _row_about(pieces, int(k), ~used, pattern, paint)
            if row is not None and not any(row.area.intersects(other.area) for other in [*rows, *found]):
                found.append(row)
                used |= pieces.within([row])
    return found


@dataclass(frozen=True)
class _Pieces:
    """Strokes that may be bars or pieces of bars: their ends (n, 2, 2), lengths (n,) and a tree over them, m."""

    ends: np.ndarray
    length: np.ndarray
    tree: shapely.STRtree

    @classmethod
    def of(cls, strokes: Sequence[Stroke], pattern: BarPattern) -> _Pieces:
        """Those that the bars of a pattern may have left."""
        length = np.array([stroke.length for stroke in strokes])
        width = np.array([stroke.width for stroke in strokes])
        ends = np.array([stroke.axis[[0, -1]] for stroke in strokes])
        chord = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        good = (length >= LIMITS.least_piece) & (length <= 1.2 * pattern.length) & (width <= 3.0 * pattern.half)
        good &= chord >= LIMITS.straight * length
        return cls(ends[good], length[good], shapely.STRtree(shapely.linestrings(ends[good])))

    def within(self, rows: Sequence[BarRow]) -> np.ndarray:
        """Mask (n,) of those that lie in rows."""
        inside = self.tree.query([row.area.buffer(0.3) for row in rows], predicate="intersects")[1]
        return np.isin(np.arange(len(self.length)), inside)


def _row_about(pieces: _Pieces, anchor: int, free: np.ndarray, pattern: BarPattern,
               paint: shapely.STRtree) -> BarRow | None:
    """The row that a piece of a bar and the free ones around it belong to, None where too little of it shows."""
    near = pieces.tree.query(pieces.tree.geometries[anchor], predicate="dwithin", distance=LIMITS.reach * pattern.pitch)
    near = near[free[near]]
    origin = pieces.ends[anchor].mean(axis=0)
    chord = pieces.ends[anchor, 1] - pieces.ends[anchor, 0]
    chords = pieces.ends[near] - origin
    beside = _beside(chords, chord / np.linalg.norm(chord), pattern.length)
    chords, length = chords[beside], pieces.length[near][beside]
    turns = np.arctan2(chord[1], chord[0]) + np.radians(np.arange(-LIMITS.turn, LIMITS.turn + 0.1, 0.5))
    normals = np.stack([-np.sin(turns), np.cos(turns)])
    places = np.stack([chords[:, 0], chords.mean(axis=1), chords[:, 1]])  # ends too: they tell the direction
    swing = np.exp(2j * np.pi * (places @ normals) / pattern.pitch).mean(axis=0)
    waves = (length[:, None] * swing).sum(axis=0)
    best = int(np.argmax(np.abs(waves)))
    # Pieces that lie at a comb's places swing together; half of what is there must.
    least = max(LIMITS.fewest_faced * LIMITS.least_faced_fill * pattern.length, LIMITS.together * length.sum())
    if np.abs(waves[best]) < least:
        return None
    direction, normal = np.array([normals[1, best], -normals[0, best]]), normals[:, best]
    first = origin @ normal + float(np.angle(waves[best])) / (2 * np.pi) * pattern.pitch
    level = origin @ direction
    start = BarRow(direction, first, pattern.pitch, 1, pattern.half, (0.0, level), (0.0, level + pattern.length))
    return _placed(start, pattern, paint)


def _beside(chords: np.ndarray, direction: np.ndarray, length: float) -> np.ndarray:
    """Mask (n,) of the chords (n, 2, 2) that run along a direction and lie beside the origin, within a bar's length."""
    chord = chords[:, 1] - chords[:, 0]
    lean = np.abs(chord[:, 0] * direction[1] - chord[:, 1] * direction[0]) / np.linalg.norm(chord, axis=1)
    return (lean < np.sin(np.radians(LIMITS.lean))) & (np.abs(chords.mean(axis=1) @ direction) < length)


def _placed(start: BarRow, pattern: BarPattern, paint: shapely.STRtree) -> BarRow | None:
    """The row with the ends of its bars and its first and last bar where paint shows them."""
    step = 0.2
    steps = np.arange(-pattern.length, pattern.length, step) + step / 2 + start.near[1]
    places = np.arange(-LIMITS.reach, LIMITS.reach + 1)
    bars = bar_fill(start, places, steps, 0.0, 0.0, paint)
    gaps = bar_fill(start, np.arange(places[0], places[-1] + 2), steps, 0.0, -0.5, paint)
    between = (gaps[:-1] + gaps[1:]) / 2.0
    wide = round(pattern.length / step)
    near = np.abs(places) <= 3
    profile = np.clip(bars - between, 0.0, None)[near].sum(axis=0)
    sums = np.convolve(profile, np.ones(wide), "valid")
    tops = np.flatnonzero(sums >= sums.max() - 0.15)
    at = round(tops.mean())
    inside = np.zeros(len(steps), bool)
    inside[at:at + wide] = True
    striped, spaces = bars[:, inside].mean(axis=1), between[:, inside].mean(axis=1)
    known = painted_run(striped, spaces, places == 0, 3, LIMITS.least_fill)
    shown = known & (striped - spaces >= LIMITS.least_fill)
    even = (striped - spaces)[known].mean() * shown.sum() / known.sum()
    if shown.sum() < LIMITS.fewest_faced or even < (LIMITS.least_mean_fill if shown.sum() >= LIMITS.fewest else
                                                    LIMITS.least_faced_fill):
        return None
    first, last = places[known][[0, -1]] - places[0]
    if gaps[first:last + 2, inside].mean(axis=1).max() > LIMITS.most_between * striped[shown].mean():
        return None
    low = steps[at] - step / 2
    row = replace(start, first=start.first + places[known][0] * start.pitch, count=int(np.ptp(places[known])) + 1,
                  near=(0.0, low), far=(0.0, low + pattern.length), fill=float((striped - spaces)[known].mean()))
    return row if _ends(row, paint) else None


def _ends(row: BarRow, paint: shapely.STRtree) -> bool:
    """Whether the bars end where the pattern says: the paint at their places does not go on before and behind."""
    places = np.arange(row.count)
    for low in (row.near[1] - LIMITS.margin - 0.2, row.far[1] + 0.2):
        steps = np.arange(low, low + LIMITS.margin, 0.2)
        beyond = bar_fill(row, places, steps, 0.0, 0.0, paint).mean() - bar_fill(row, places, steps, 0.0, -0.5,
                                                                                paint).mean()
        if beyond > LIMITS.beyond * row.fill:
            return False
    return True


def faced_rows(rows: Sequence[BarRow]) -> list[BarRow]:
    """The rows as long as those across the same street, where these begin or end on the same line; those of fewer than
    four bars that nothing faces on the other side of the junction are left out."""
    for _ in range(2):  # A row that was made longer may face a third one.
        rows = [_as_long(row, [other for other in rows if other is not row and other.count >= LIMITS.fewest])
                for row in rows]
    return [row for row in rows if row.count >= LIMITS.fewest]


def _as_long(row: BarRow, others: Sequence[BarRow]) -> BarRow:
    """A row as long as the longest of those that face it, where enough of it shows and nothing else lies there."""
    spans = [_span_facing(row, other) for other in others]
    before, after = max(spans, key=sum, default=(0, 0))
    count = row.count + before + after
    longer = replace(row, first=row.first - before * row.pitch, count=count, fill=row.fill * row.count / count)
    bare = longer.fill < LIMITS.least_long_fill
    return row if bare or any(longer.area.intersects(other.area) for other in others) else longer


def _span_facing(row: BarRow, other: BarRow) -> tuple[int, int]:
    """How many bars more another row that faces this one has before its first and after its last; none where it does
    not face it."""
    turn = np.degrees(np.arcsin(min(abs(row.direction @ other.normal), 1.0)))
    if turn > LIMITS.facing_turn[0]:
        return 0, 0
    mean = row.direction + np.sign(row.direction @ other.direction) * other.direction
    mean /= np.linalg.norm(mean)
    normal = np.array([-mean[1], mean[0]])
    one, two = (shapely.get_coordinates(each.area.exterior)[:4] for each in (row, other))
    apart = abs((one.mean(axis=0) - two.mean(axis=0)) @ mean)
    one_junction, faint = apart <= LIMITS.facing[1], row.count < LIMITS.fewest
    far = LIMITS.facing[1] < apart <= LIMITS.facing[2] and not faint and turn <= LIMITS.facing_turn[1]
    if apart < LIMITS.facing[0] or not (one_junction or far):
        return 0, 0
    own, facing = (np.array([(each @ normal).min(), (each @ normal).max()]) for each in (one, two))
    off = facing - own
    same = (np.abs(off) <= LIMITS.same_edge).any()
    return (max(0, round(-off[0] / row.pitch)), max(0, round(off[1] / row.pitch))) if same else (0, 0)
