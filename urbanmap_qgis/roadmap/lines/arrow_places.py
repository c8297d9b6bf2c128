"""Where arrows stand: at usual distances before crosswalks, never in the course of a line or among letters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from .crosswalks import Crosswalk
from .strokes import Stroke


@dataclass(frozen=True)
class ArrowPlacesLimits:
    """Limits of the places of arrows, each with its unit."""

    # Behind its tail and ahead of its tip an arrow is bare for so far, m: a piece of a line has half of that painted
    # by strokes so wide (m) at most, in its course (cosine) and so near beside it, m.
    bare: tuple[float, float] = (0.1, 2.6)
    painted: float = 0.4
    width: float = 0.35
    shortest: float = 0.4
    course: float = 0.97
    beside: float = 0.2
    # Other paint so near, m, covers no more than this share of its own area.
    about: float = 0.3
    among: float = 0.25
    before: float = 45.0  # Arrows stand so far before a crosswalk at most, m.
    across: float = 0.95  # Cosine of the angle between an arrow and the bars.


LIMITS = ArrowPlacesLimits()


class ArrowSurroundings:
    """Narrow strokes, which lines are made of, and paint that is no arrow's, such as yellow letters.

    Parameters
    ----------
    others : polygons of that paint.
    """

    def __init__(self, strokes: Sequence[Stroke], others: Sequence[shapely.Polygon]):
        self._others = shapely.STRtree(others)
        self._strokes = [one for one in strokes if one.width <= LIMITS.width and one.length >= LIMITS.shortest]
        self._ends = np.array([one.axis[[0, -1]] for one in self._strokes]).reshape(-1, 2, 2)
        self._tree = shapely.STRtree(shapely.linestrings(self._ends))

    def deny(self, area: shapely.Geometry, tail: np.ndarray, course: np.ndarray, own: Sequence[int]) -> bool:
        """Whether what was taken for an arrow is a piece of a line that goes on, or of letters.

        Parameters
        ----------
        area, tail, course : its paint, the end (2,) at which it begins and its direction (2,).
        own : numbers of its polygons.
        """
        along = (shapely.get_coordinates(area) - tail) @ course
        near, far = LIMITS.bare
        spans = [(along.min() - far, along.min() - near), (along.max() + near, along.max() + far)]
        return self._among(area) or any(self._painted(tail, course, span, own) >= LIMITS.painted for span in spans)

    def _among(self, area: shapely.Geometry) -> bool:
        """Whether other paint lies close about it."""
        about = area.buffer(LIMITS.about)
        near = self._others.geometries[self._others.query(about, predicate="intersects")]
        return shapely.area(shapely.intersection(near, about)).sum() > LIMITS.among * area.area

    def _painted(self, tail: np.ndarray, course: np.ndarray, span: tuple[float, float], own: Sequence[int]) -> float:
        """Share of a span (m ahead of the tail) along which other strokes lie."""
        line = shapely.LineString([tail + at * course for at in span])
        near = [k for k in self._tree.query(line, predicate="dwithin", distance=LIMITS.beside)
                if self._strokes[k].polygon not in own]
        ends = self._ends[near] - tail
        along, across = np.sort(ends @ course, axis=1), ends @ [-course[1], course[0]]
        chord = np.diff(ends, axis=1)[:, 0]
        straight = np.abs(chord @ course) > LIMITS.course * np.linalg.norm(chord, axis=1)
        pieces = along[straight & (np.abs(across).min(axis=1) <= LIMITS.beside)].clip(*span)
        pieces = pieces[np.argsort(pieces[:, 0])]
        reached = np.maximum.accumulate(np.append(span[0], pieces[:, 1]))
        return float((np.maximum(reached[1:], pieces[:, 0]) - np.maximum(reached[:-1], pieces[:, 0])).sum() /
                     (span[1] - span[0]))


def before_crosswalks(tails: np.ndarray, courses: np.ndarray, crosswalks: Sequence[Crosswalk]) -> np.ndarray:
    """Distances (n,) from tails (n, 2) to the crosswalks that arrows of directions (n, 2) lead to, m, NaN without."""
    reach = shapely.linestrings(np.stack([tails, tails + LIMITS.before * courses], axis=1).reshape(-1, 2, 2))
    nearest = np.full(len(reach), np.nan)
    for row in crosswalks:
        met = np.flatnonzero(shapely.intersects(reach, row.area) & (np.abs(courses @ row.direction) > LIMITS.across))
        inside = shapely.intersection(reach[met], row.area)
        nearest[met] = np.fmin(nearest[met], shapely.distance(shapely.points(tails[met]), inside))
    return nearest


def crosswalk_ahead(place: np.ndarray, crosswalks: Sequence[Crosswalk]) -> np.ndarray | None:
    """Direction (2,) of the bars of the nearest crosswalk ahead of or behind a place (2,), None without one."""
    best, nearest = None, LIMITS.before
    for row in crosswalks:
        along = shapely.LineString([place - nearest * row.direction, place + nearest * row.direction])
        apart = row.area.distance(shapely.Point(place))
        if apart < nearest and along.intersects(row.area):
            best, nearest = row.direction, apart
    return best


def usual_values(values: np.ndarray, same: float, fewest: int) -> list[float]:
    """The values (n,) that at least `fewest` of them share to `same`, the most usual one first."""
    left, usual = np.sort(values), []
    while len(left):
        first = np.searchsorted(left, left - same, side="right")
        after = np.searchsorted(left, left + same, side="left")
        best = int(np.argmax(after - first))
        if after[best] - first[best] < fewest:
            break
        usual.append(float(np.median(left[first[best]:after[best]])))
        left = np.concatenate([left[:first[best]], left[after[best]:]])
    return usual
