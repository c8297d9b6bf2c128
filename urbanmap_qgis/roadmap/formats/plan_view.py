"""Paths as lines, arcs and cubic polynomials, and values along them as cubics: the geometry of ASAM OpenDRIVE 1.7."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR, SAME_PLACE

SAME_HEADING = 0.001
"""A stretch is a line where it leaves and enters within this angle of its chord, rad."""

SAME_BEND = 0.001
"""It is an arc where the angles between chord and path at both ends differ by no more, rad."""

OBLIQUE = 0.3
"""Directions of ends are taken where the cosine to the path's own is larger."""


@dataclass(frozen=True)
class PlanElement:
    """A stretch of a reference line.

    Attributes
    ----------
    s : chainage of its begin, m.
    x, y : m.
    heading : of its begin, rad from the x axis.
    length : m.
    kind : "line", "arc" or "cubic".
    curvature : of an arc, 1/m.
    u, v : (4,) coefficients of a cubic in its own frame, over p from 0 to 1 (paramPoly3, normalized).
    """

    s: float
    x: float
    y: float
    heading: float
    length: float
    kind: str
    curvature: float = 0.0
    u: tuple[float, ...] = ()
    v: tuple[float, ...] = ()

    def pose(self, ds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places (n, 2) and headings (n,) at distances from its begin."""
        ds = np.asarray(ds, float)
        if self.kind == "cubic":
            p = ds / self.length
            along, across = (np.polynomial.polynomial.polyval(p, one) for one in (self.u, self.v))
            slope = [np.polynomial.polynomial.polyval(p, np.polynomial.polynomial.polyder(one))
                     for one in (self.u, self.v)]
            turn = np.arctan2(slope[1], slope[0])
        elif self.kind == "arc":
            turn = self.curvature * ds
            along, across = np.sin(turn) / self.curvature, (1.0 - np.cos(turn)) / self.curvature
        else:
            along, across, turn = ds, np.zeros_like(ds), np.zeros_like(ds)
        cosine, sine = np.cos(self.heading), np.sin(self.heading)
        return np.column_stack([self.x + cosine * along - sine * across,
                                self.y + sine * along + cosine * across]), self.heading + turn


@dataclass(frozen=True)
class CubicPiece:
    """a + b ds + c ds^2 + d ds^3 from chainage s on."""

    s: float
    a: float
    b: float = 0.0
    c: float = 0.0
    d: float = 0.0


def fit_plan_view(points: np.ndarray, tolerance: float = 0.02,
                  ends: tuple[np.ndarray | None, np.ndarray | None] = (None, None)) -> list[PlanElement]:
    """Elements along a path (n, 2) that stay within `tolerance` (m) of it and go through its ends.

    The path is taken whole where it is one element; otherwise it is halved. Headings of neighbouring elements agree.

    Parameters
    ----------
    ends : unit directions (2,) of the path's begin and end, where they are known.
    """
    points = np.asarray(points, float)[:, :2]
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    points = points[np.concatenate([[True], steps > SAME_PLACE])]
    tangents, at = _tangents(points), _chainage(points)
    for tip, given in zip((0, -1), ends):
        if given is not None and given @ tangents[tip] > OBLIQUE:
            tangents[tip] = given
    elements: list[PlanElement] = []
    spans = [(0, len(points) - 1)]
    while spans:
        first, last = spans.pop()
        element = _element(points[first:last + 1], tangents[first], tangents[last], tolerance, last - first == 1)
        if element is None:
            middle = first + int(np.argmin(np.abs(at[first + 1:last] - (at[first] + at[last]) / 2.0))) + 1
            spans += [(middle, last), (first, middle)]
        else:
            elements.append(element)
    starts = np.concatenate([[0.0], np.cumsum([one.length for one in elements])])
    return [PlanElement(float(s), one.x, one.y, one.heading, one.length, one.kind, one.curvature, one.u, one.v)
            for s, one in zip(starts, elements)]


def plan_length(elements: Sequence[PlanElement]) -> float:
    """Length of a reference line, m."""
    return elements[-1].s + elements[-1].length


def along_plan(elements: Sequence[PlanElement], s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 2) and headings (n,) of a reference line at chainages."""
    s = np.asarray(s, float)
    which = np.clip(np.searchsorted([one.s for one in elements], s, side="right") - 1, 0, len(elements) - 1)
    places, headings = np.zeros((len(s), 2)), np.zeros(len(s))
    for number in np.unique(which):
        rows = which == number
        places[rows], headings[rows] = elements[number].pose(s[rows] - elements[number].s)
    return places, headings


def fit_profile(s: np.ndarray, values: np.ndarray, tolerance: float = 0.01) -> list[CubicPiece]:
    """Cubics with common values and slopes at their joints that stay within `tolerance` of values (n,) at s (n,).

    The first and the last value are kept; one straight piece is taken where it is enough.
    """
    s, values = np.asarray(s, float), np.asarray(values, float)
    slope = (values[-1] - values[0]) / (s[-1] - s[0])
    if np.abs(values[0] + slope * (s - s[0]) - values).max() <= tolerance:
        return [CubicPiece(float(s[0]), float(values[0]), float(slope))]
    slopes = np.gradient(values, s) if len(s) > 2 else np.full(len(s), (values[-1] - values[0]) / (s[-1] - s[0]))
    pieces: list[CubicPiece] = []
    spans = [(0, len(s) - 1)]
    while spans:
        first, last = spans.pop()
        piece = _hermite(s[first], s[last], values[first], values[last], slopes[first], slopes[last])
        ds = s[first:last + 1] - s[first]
        fitted = piece.a + ds * (piece.b + ds * (piece.c + ds * piece.d))
        if last - first > 1 and np.abs(fitted - values[first:last + 1]).max() > tolerance:
            spans += [((first + last) // 2, last), (first, (first + last) // 2)]
        else:
            pieces.append(piece)
    return pieces


def _hermite(s0, s1, v0, v1, m0, m1) -> CubicPiece:
    """The cubic through two values with two slopes."""
    length = s1 - s0
    rise = (v1 - v0) / length
    return CubicPiece(float(s0), float(v0), float(m0), float((3 * rise - 2 * m0 - m1) / length),
                      float((m0 + m1 - 2 * rise) / length ** 2))


def _chainage(points: np.ndarray) -> np.ndarray:
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def _tangents(points: np.ndarray) -> np.ndarray:
    """Unit directions (n, 2) at the points of a path, as of the parabola through a point and those beside it."""
    chords = np.diff(points, axis=0)
    length = np.linalg.norm(chords, axis=1, keepdims=True)
    unit = chords / length
    if len(points) == 2:
        return np.vstack([unit, unit])
    inner = (unit[:-1] * length[1:] + unit[1:] * length[:-1]) / (length[1:] + length[:-1])
    inner /= np.maximum(np.linalg.norm(inner, axis=1, keepdims=True), LEAST_DIVISOR)
    ends = [2.0 * (unit[k] @ inner[k]) * unit[k] - inner[k] for k in (0, -1)]
    return np.vstack([ends[0], inner, ends[1]])


def _stray(points: np.ndarray, line: shapely.LineString) -> float:
    """Largest distance of points from a line."""
    return float(shapely.distance(shapely.points(points), line).max())


def _element(points: np.ndarray, begin: np.ndarray, end: np.ndarray, tolerance: float,
             always: bool) -> PlanElement | None:
    """A line, an arc or a cubic along a stretch of a path with given directions at its ends; None where none fits.

    Between two points (`always`) the cubic is taken whatever its distance.
    """
    chord = points[-1] - points[0]
    length, heading = float(np.linalg.norm(chord)), float(np.arctan2(chord[1], chord[0]))
    leave, enter = _angle(begin, chord), _angle(chord, end)
    if max(abs(leave), abs(enter)) < SAME_HEADING and _stray(points, shapely.LineString(points[[0, -1]])) <= tolerance:
        return PlanElement(0.0, *points[0], heading, length, "line")
    half = (leave + enter) / 2.0
    if SAME_HEADING < abs(half) < 1.4 and abs(leave - enter) < SAME_BEND:
        curvature = 2.0 * np.sin(half) / length
        arc = PlanElement(0.0, *points[0], heading - half, float(length * half / np.sin(half)), "arc",
                          float(curvature))
        if _fits(arc, points, tolerance):
            return arc
    reach = float(_chainage(points)[-1])
    turned = np.arctan2(begin[1], begin[0])
    frame = np.array([[begin[0], begin[1]], [-begin[1], begin[0]]])
    goal, slope = frame @ chord, reach * (frame @ end)
    start = np.array([reach, 0.0])
    u, v = ((0.0, start[k], 3 * goal[k] - 2 * start[k] - slope[k], start[k] + slope[k] - 2 * goal[k]) for k in (0, 1))
    p = np.linspace(0.0, 1.0, 65)
    curve = np.column_stack([np.polynomial.polynomial.polyval(p, one) for one in (u, v)])
    cubic = PlanElement(0.0, points[0][0], points[0][1], float(turned), float(_chainage(curve)[-1]), "cubic",
                        u=tuple(map(float, u)), v=tuple(map(float, v)))
    return cubic if always or _fits(cubic, points, tolerance) else None


def _fits(element: PlanElement, points: np.ndarray, tolerance: float) -> bool:
    """Whether an element and a path keep within the tolerance of each other."""
    places, _ = element.pose(np.linspace(0.0, element.length, 40))
    return (_stray(points, shapely.LineString(places)) <= tolerance
            and _stray(places, shapely.LineString(points)) <= tolerance)


def _angle(one: np.ndarray, other: np.ndarray) -> float:
    """Signed angle from one direction to another, rad."""
    return float(np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other))
