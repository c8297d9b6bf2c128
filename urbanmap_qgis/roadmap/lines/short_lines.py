"""Short and worn pieces of lines that the well-seen lines of the same road show to be ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import LEAST_DIVISOR
from .line_chains import StrokeChain


@dataclass(frozen=True)
class ShortLineLimits:
    """Limits of short lines, each with its unit."""

    least_painted: float = 1.5  # Of a piece, m.
    lane: tuple[float, float] = (2.2, 5.0)  # Lines of one road lie so far from each other, m.
    beside: float = 6.0  # Two lines show a width of this town's lanes where they run beside each other so far, m.
    alike: float = 0.12  # Distances that differ by no more are one width, m.
    onwards: float = 15.0  # A well-seen line tells of pieces so far beyond its end, m.
    width_ratio: float = 1.6  # Pieces are as wide as the line that tells of them to within this factor.
    painted_share: float = 0.25  # Of the piece's length.


LIMITS = ShortLineLimits()


def supported_chains(chains: Sequence[StrokeChain], axes: Sequence[np.ndarray],
                     widths: Sequence[float]) -> list[StrokeChain]:
    """The chains too short for a line by themselves that lie where the lines beside them ask for one.

    A chain is taken where it continues a line, or where it runs beside one at a distance that other lines of the area
    keep from each other; lines at less than a lane's width rule it out, for between the lines of a lane are symbols.

    Parameters
    ----------
    chains : candidates, m.
    axes : (n, 2) of the lines that are sure, m.
    widths : of their paint, m.
    """
    able = [chain for chain in chains if chain.painted >= max(LIMITS.least_painted,
                                                             LIMITS.painted_share * chain.length)]
    if not able or not len(axes):
        return []
    plans = [shapely.LineString(axis).simplify(0.03) for axis in axes]
    long = [shapely.LineString(_prolonged(shapely.get_coordinates(plan))) for plan in plans]
    lane_widths = _lane_widths(plans)
    tree = shapely.STRtree(long)
    return [chain for chain in able if _is_supported(chain, long, tree, widths, lane_widths)]


def _prolonged(axis: np.ndarray) -> np.ndarray:
    """A path with `LIMITS.onwards` straight on at both ends, in the direction of its last 8 m."""
    line = shapely.LineString(axis)
    span = min(8.0, line.length)
    inner = shapely.get_coordinates(shapely.line_interpolate_point(line, [span, line.length - span]))
    ends = [tip + LIMITS.onwards * (tip - before) / max(np.linalg.norm(tip - before), LEAST_DIVISOR)
            for tip, before in ((axis[0], inner[0]), (axis[-1], inner[1]))]
    return np.vstack([ends[0], axis, ends[1]])


def _lane_widths(plans: Sequence[shapely.LineString]) -> np.ndarray:
    """Distances (n,) that neighbouring lines keep from each other, m."""
    tree, found = shapely.STRtree(plans), []
    for number, plan in enumerate(plans):
        places = shapely.line_interpolate_point(plan, np.arange(0.5, plan.length, 1.0))
        for other in tree.query(plan, predicate="dwithin", distance=LIMITS.lane[1]):
            foot = shapely.line_locate_point(plans[other], places)
            inner = (foot > 0.01) & (foot < plans[other].length - 0.01)
            widths = shapely.distance(places, plans[other])[inner]
            if other == number or len(widths) < LIMITS.beside or np.ptp(widths) > 2.0 * LIMITS.alike:
                continue
            if LIMITS.lane[0] <= np.median(widths) <= LIMITS.lane[1]:
                found.append(float(np.median(widths)))
    return np.array(found)


def _is_supported(chain: StrokeChain, lines: Sequence[shapely.LineString], tree: shapely.STRtree,
                  widths: Sequence[float], lane_widths: np.ndarray) -> bool:
    """Whether lines about a chain show it to be one."""
    plan = shapely.LineString(chain.axis)
    places = shapely.line_interpolate_point(plan, np.linspace(0.0, 1.0, 5), normalized=True)
    near = tree.query(plan, predicate="dwithin", distance=LIMITS.lane[1])
    shown = False
    for other in near:
        distances = shapely.distance(places, lines[other])
        if np.ptp(distances) > 2.0 * LIMITS.alike:
            if distances.min() < LIMITS.lane[0] and lines[other].crosses(plan):
                return False
            continue
        alike = max(widths[other], chain.width) <= LIMITS.width_ratio * min(widths[other], chain.width)
        middle = float(np.median(distances))
        if LIMITS.alike < middle < LIMITS.lane[0]:
            return False
        continues = middle <= LIMITS.alike
        at_width = len(lane_widths) and np.abs(lane_widths - middle).min() <= LIMITS.alike
        shown |= bool(alike and (continues or at_width))
    return shown
