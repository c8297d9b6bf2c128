"""How far a crosswalk reaches: paint at the places of its bars against paint between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR


@dataclass(frozen=True)
class CrosswalkExtentLimits:
    """Limits of crosswalk extent, each with its unit."""

    slice: float = 0.2  # Bars are looked at in slices of this length, m.
    # Bars are looked for so many places, and their ends so many metres, beyond those known.
    beyond_bars: int = 14
    beyond_ends: float = 4.0
    # A bar or a slice is there where so much of its place holds paint, and so much more than the places between
    # bars.
    least_fill: float = 0.25
    missing: int = 3  # So many bars in a row may be hidden or worn away.


LIMITS = CrosswalkExtentLimits()


@dataclass(frozen=True)
class BarRow:
    """A row of bars in its own frame: p across the bars, a along them.

    Attributes
    ----------
    direction : unit vector (2,) along the bars.
    first : p of the first bar's centre line, m.
    pitch : distance of bars, m.
    count : number of places.
    half : half a bar's width, m.
    near, far : (slope, level) of the lines a = slope p + level on which the bars begin and end.
    fill : share of paint at the bars' places less that between them, 0 to 1; NaN before it is measured.
    """

    direction: np.ndarray
    first: float
    pitch: float
    count: int
    half: float
    near: tuple[float, float]
    far: tuple[float, float]
    fill: float = np.nan

    @property
    def normal(self) -> np.ndarray:
        return np.array([-self.direction[1], self.direction[0]])

    @property
    def area(self) -> shapely.Polygon:
        """From the first bar to the last."""
        ends = self.first - self.half, self.first + (self.count - 1) * self.pitch + self.half
        ring = [(p, self.near[0] * p + self.near[1]) for p in ends]
        ring += [(p, self.far[0] * p + self.far[1]) for p in ends[::-1]]
        return shapely.Polygon([p * self.normal + a * self.direction for p, a in ring])


def extended(row: BarRow, paint: shapely.STRtree) -> BarRow:
    """The row with the bars and the ends of bars that paint at their places shows, and without those it does not.

    Parameters
    ----------
    paint : tree over the polygons of the markings.
    """
    slope = (row.near[0] + row.far[0]) / 2.0
    middle = row.first + (row.count - 1) * row.pitch / 2.0
    edges = np.array([side[0] * middle + side[1] - slope * middle for side in (row.near, row.far)])
    steps = np.arange(edges[0] - LIMITS.beyond_ends, edges[1] + LIMITS.beyond_ends, LIMITS.slice) + LIMITS.slice / 2
    places = np.arange(-LIMITS.beyond_bars, row.count + LIMITS.beyond_bars)
    bars = bar_fill(row, places, steps, slope, 0.0, paint)
    gaps = bar_fill(row, np.arange(places[0], places[-1] + 2), steps, slope, -0.5, paint)
    between = (gaps[:-1] + gaps[1:]) / 2.0
    known = (places >= 0) & (places < row.count)
    inside = (steps > edges[0]) & (steps < edges[1])
    for _ in range(3):
        known = painted_run(bars[:, inside].mean(axis=1), between[:, inside].mean(axis=1), known, LIMITS.missing)
        inside = painted_run(bars[known].mean(axis=0), between[known].mean(axis=0), inside, 2)
    if known.sum() < 2 or inside.sum() < 2:
        return row
    fill = float((bars - between)[known][:, inside].mean())
    low, high = _edge(bars[known].mean(axis=0), steps, inside)
    return BarRow(row.direction, row.first + places[known][0] * row.pitch, row.pitch, int(np.ptp(places[known])) + 1,
                  row.half, (slope, low), (slope, high), fill)


def bar_fill(row: BarRow, places: np.ndarray, steps: np.ndarray, slope: float, shift: float,
          paint: shapely.STRtree) -> np.ndarray:
    """Share of paint (places, steps) in the slices at the bars' places, `shift` pitches beside them."""
    across = row.first + (places + shift) * row.pitch
    inset = np.array([-0.5, 0.0, 0.5]) * row.half
    p, a, d = np.meshgrid(across, steps, inset, indexing="ij")
    p = p + d
    a = a + slope * p
    xy = p[..., None] * row.normal + a[..., None] * row.direction
    x, y = xy[..., 0].ravel(), xy[..., 1].ravel()
    hit = np.zeros(len(x), bool)
    near = paint.geometries[paint.query(shapely.box(x.min(), y.min(), x.max(), y.max()))]
    shapely.prepare(near)
    for polygon, (left, low, right, high) in zip(near, shapely.bounds(near)):
        within = np.flatnonzero((x >= left) & (x <= right) & (y >= low) & (y <= high))
        hit[within] |= shapely.intersects_xy(polygon, x[within], y[within])
    return hit.reshape(p.shape).mean(axis=2)


def painted_run(bar: np.ndarray, gap: np.ndarray, seed: np.ndarray, missing: int,
                least_fill: float | None = None) -> np.ndarray:
    """Places (n,) that belong to the row: those with paint that reach the seed over at most `missing` bare ones.

    Beyond bare places as many painted ones must follow: one stroke some way off is something else.
    """
    least = LIMITS.least_fill if least_fill is None else least_fill
    striped = (bar >= least) & (bar - gap >= least)
    start = striped & seed
    if not start.any():
        return seed
    first = last = int(np.flatnonzero(start)[np.count_nonzero(start) // 2])
    for step in (1, -1):
        at, bare, back = first, 0, 0
        while 0 <= at < len(bar) and bare <= missing:
            if striped[at]:
                back += 1
            else:
                bare, back = (bare + 1, 0) if back == 0 or back >= bare else (missing + 1, 0)
            if striped[at] and back >= bare:
                first, last, bare, back = min(first, at), max(last, at), 0, 0
            at += step
    covered = np.zeros(len(bar), bool)
    covered[first:last + 1] = True
    return covered


def _edge(profile: np.ndarray, steps: np.ndarray, inside: np.ndarray) -> tuple[float, float]:
    """Where the bars begin and end: the places at which their mean fill has half its usual value, m."""
    usual = float(np.median(profile[inside]))
    at = np.flatnonzero(inside)
    ends = []
    for tip, step in ((at[0], -1), (at[-1], 1)):
        share = 0.0
        for k in (tip, tip + step):
            share += float(np.clip(profile[k] / max(usual, LEAST_DIVISOR), 0.0, 1.0)) if 0 <= k < len(profile) else 0.0
        ends.append(steps[tip] + step * LIMITS.slice * (share - 0.5))
    return float(ends[0]), float(ends[1])
