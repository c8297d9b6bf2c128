"""Strokes of paint that continue each other are one line: links across dashes' gaps, wear and vehicles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...geometry.tolerances import LEAST_DIVISOR
from .strokes import Stroke


@dataclass(frozen=True)
class LineChainsLimits:
    """Limits of line chains, each with its unit."""

    # A gap of at most so many metres may be bridged between lines at least so long, m; round by round, near ones
    # first, so that far ones are joined by good directions.
    shortest_for_gap: tuple[tuple[float, ...], ...] = ((0.6, 0.25), (2.0, 0.6), (5.0, 1.0), (7.5, 1.5), (10.0, 2.0),
                                                       (13.0, 2.5))
    # Lateral distance allowed between a line's prolongation and the next piece, m, beside what its direction
    # leaves.
    offset: float = 0.12
    direction_length: float = 8.0  # The direction of a line at its end is that of its last so many metres.
    width_ratio: float = 1.8  # Lines continue each other where their widths differ by no more than this factor.


LIMITS = LineChainsLimits()

BEND = np.radians(2.5)
"""Change of direction allowed beyond what the directions' accuracy leaves, per end."""


@dataclass
class StrokeChain:
    """Strokes in a row.

    Attributes
    ----------
    axis : (n, 2) from the first stroke's tip to the last one's.
    strokes : numbers of the strokes in this order.
    painted : length of the strokes, m.
    width : their mean width by length, m.
    """

    axis: np.ndarray
    strokes: list[int]
    painted: float
    width: float

    @cached_property
    def length(self) -> float:
        """Along the axis with the gaps, m."""
        return float(np.linalg.norm(np.diff(self.axis, axis=0), axis=1).sum())

    @cached_property
    def tips(self) -> tuple[tuple[np.ndarray, np.ndarray, float], ...]:
        """Place, outward direction and its uncertainty at the first tip and at the last: asked in every round."""
        return _tip(self.axis[::-1]), _tip(self.axis)


def link_strokes(strokes: Sequence[Stroke], numbers: Sequence[int], barriers: Sequence[shapely.Geometry] = (),
                 colours: Sequence[str] | None = None) -> list[StrokeChain]:
    """Chains of the strokes with these numbers.

    Parameters
    ----------
    barriers : areas that no gap may cross, such as crosswalks.
    colours : by stroke; strokes of two known colours are not linked.
    """
    chains = [StrokeChain(strokes[n].axis, [n], strokes[n].length, strokes[n].width) for n in numbers]
    tree = shapely.STRtree(list(barriers)) if len(barriers) else None
    for longest, shortest in LIMITS.shortest_for_gap:
        while True:
            links = _best_links(chains, longest, shortest, tree, colours)
            if not links:
                break
            chains = _joined(chains, links)
    return chains


def _ends(chains: Sequence[StrokeChain]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Place (2n, 2), outward direction (2n, 2) and uncertainty of the direction (2n,), tips of chain k at 2k, 2k+1."""
    tips = [tip for chain in chains for tip in chain.tips]
    return tuple(np.array(values) for values in zip(*tips))


def _tip(axis: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Place (2,) of the end of an axis, the direction (2,) in which it ends and how uncertain this is."""
    steps = np.linalg.norm(np.diff(axis, axis=0), axis=1)
    behind = np.concatenate([np.cumsum(steps[::-1])[::-1], [0.0]])
    start = max(0, int(np.searchsorted(-behind, -LIMITS.direction_length, side="right")) - 1)
    chord = axis[-1] - axis[start]
    length = max(np.linalg.norm(chord), 1e-6)
    return axis[-1], chord / length, np.arctan(0.06 / length)


def _best_links(chains: list[StrokeChain], longest: float, shortest: float, barriers, colours) -> list[tuple[int, int]]:
    """Pairs of tips to join, the best first, each tip once."""
    able = [k for k, chain in enumerate(chains) if chain.length >= shortest]
    if len(able) < 2:
        return []
    place, outward, doubt = _ends([chains[k] for k in able])
    tips = np.array([(2 * k, 2 * k + 1) for k in able]).ravel()
    pairs = cKDTree(place).query_pairs(longest, output_type="ndarray")
    pairs = pairs[tips[pairs[:, 0]] // 2 != tips[pairs[:, 1]] // 2]
    if not len(pairs):
        return []
    cost = _link_cost(place, outward, doubt, pairs)
    width = np.array([chains[k].width for k in able])[pairs // 2]
    fits = np.isfinite(cost) & (width.max(axis=1) <= LIMITS.width_ratio * width.min(axis=1))
    pairs, cost = pairs[fits], cost[fits]
    order = np.argsort(cost, kind="stable")
    used: set[int] = set()
    links = []
    for a, b in pairs[order]:
        one, other = int(tips[a]), int(tips[b])
        if one in used or other in used or not _same_colour(chains[one // 2], chains[other // 2], colours):
            continue
        if barriers is not None and len(barriers.query(shapely.LineString([place[a], place[b]]), "intersects")):
            continue
        used |= {one, one ^ 1, other, other ^ 1}  # a chain takes part in one link a round
        links.append((one, other))
    return links


def _link_cost(place: np.ndarray, outward: np.ndarray, doubt: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    """Cost (n,) of joining each pair of tips, m; infinite where the one does not continue the other."""
    a, b = pairs.T
    gap = place[b] - place[a]
    distance = np.linalg.norm(gap, axis=1)
    cost = distance.copy()
    for tip, towards in ((a, gap), (b, -gap)):
        along = (towards * outward[tip]).sum(axis=1)
        across = np.abs(towards[:, 0] * outward[tip, 1] - towards[:, 1] * outward[tip, 0])
        allowed = LIMITS.offset + distance * np.tan(doubt[tip] + BEND)
        cost += 2.0 * across
        cost[(along < -0.3) | (across > allowed)] = np.inf
    turn = np.arccos(np.clip(-(outward[a] * outward[b]).sum(axis=1), -1.0, 1.0))
    cost[turn > doubt[a] + doubt[b] + 2.0 * BEND] = np.inf
    return cost


def _same_colour(one: StrokeChain, other: StrokeChain, colours) -> bool:
    """Whether the colours of two chains, those of their longest strokes, do not contradict each other."""
    if colours is None:
        return True
    first, second = colours[one.strokes[0]], colours[other.strokes[0]]
    return not first or not second or first == second


def _joined(chains: list[StrokeChain], links: list[tuple[int, int]]) -> list[StrokeChain]:
    """The chains after joining the tips."""
    gone: set[int] = set()
    joined = []
    for one, other in links:
        first, second = chains[one // 2], chains[other // 2]
        axis = first.axis if one % 2 else first.axis[::-1]
        numbers = first.strokes if one % 2 else first.strokes[::-1]
        after = second.axis[::-1] if other % 2 else second.axis
        after_numbers = second.strokes[::-1] if other % 2 else second.strokes
        painted = first.painted + second.painted
        width = (first.painted * first.width + second.painted * second.width) / max(painted, LEAST_DIVISOR)
        joined.append(StrokeChain(np.vstack([axis, after]), [*numbers, *after_numbers], painted, width))
        gone |= {one // 2, other // 2}
    return [chain for k, chain in enumerate(chains) if k not in gone] + joined
