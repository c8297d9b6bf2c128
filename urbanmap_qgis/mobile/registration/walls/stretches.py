"""Stretches of a drive whose walls all want it elsewhere than its markings: one shift of the reference explains them.

A trajectory that markings hold is smooth to centimetres, so that walls over hundreds of metres can be compared with
one shift of the markings, however much single outlines are off.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class StretchesLimits:
    """Limits of stretches, each with its unit."""

    every: float = 20.0  # m of path between the ends of the stretches that are tried
    shortest: float = 60.0  # m
    walls: int = 5  # of a stretch
    proof: float = 4.0  # standard deviations of a shift that is believed: many stretches are tried
    least: float = 0.06  # m
    most: float = 1.0  # m, standard deviation of a shift before any wall is seen
    soft: float = 2.5  # standard deviations from which a wall loses weight
    rounds: int = 3
    # Log-likelihood by which walls beside a stretch deny its shift; standard deviations that one wall has at most.
    denied: float = 4.5
    most_denied: float = 3.0


LIMITS = StretchesLimits()


@dataclass(frozen=True)
class WallReadings:
    """What each wall says: how far outside of its outline it lies, by the markings' correction.

    Attributes
    ----------
    chainage : (w,) m, where it was seen, not falling.
    outward : (w, 2).
    outside, sigma : (w,) m.
    shared : m, that the outlines of a neighbourhood are off by alike.
    """

    chainage: np.ndarray
    outward: np.ndarray
    outside: np.ndarray
    sigma: np.ndarray
    shared: float

    def select(self, which: np.ndarray | slice) -> WallReadings:
        """Some of them."""
        return replace(self, chainage=self.chainage[which], outward=self.outward[which], outside=self.outside[which],
                       sigma=self.sigma[which])


@dataclass(frozen=True)
class ShiftedStretch:
    """A stretch of chainage, m, whose markings lie by `change` (2,) m off the place that the walls want them at.

    `covariance` : (2, 2); `square` : chi square of no shift.
    """

    begin: float
    end: float
    change: np.ndarray
    covariance: np.ndarray
    square: float


def shifted_stretches(walls: WallReadings, eaves: tuple[float, float]) -> list[ShiftedStretch]:
    """Stretches that a shift explains and chance does not, the surest first; they reach as far as no walls deny them.

    `eaves` : m, mean and standard deviation of how far facades stand inside the outlines.
    """
    if len(walls.chainage) < LIMITS.walls:
        return []
    first, last = walls.chainage[0], walls.chainage[-1]
    ends = np.append(np.arange(first, last, LIMITS.every), last + 1e-6)
    found = [item for number, begin in enumerate(ends)
             for item in _believed(walls, float(begin), ends[number + 1:], eaves)]
    chosen: list[ShiftedStretch] = []
    for item in sorted(found, key=lambda item: -item.square):
        if not any(item.begin < other.end and other.begin < item.end for other in chosen):
            chosen.append(_extended(item, walls, eaves))
    return _without_remnants(chosen, float(first), float(last))


def _believed(walls: WallReadings, begin: float, ends: np.ndarray,
              eaves: tuple[float, float]) -> list[ShiftedStretch]:
    """Stretches from one chainage to others (e,) that a shift explains and chance does not; all are solved at once."""
    first, stop = np.searchsorted(walls.chainage, begin), np.searchsorted(walls.chainage, ends)
    tried = (ends - begin >= LIMITS.shortest) & (stop - first >= LIMITS.walls)
    if not tried.any():
        return []
    ends, walls = ends[tried], walls.select(slice(first, None))
    change, covariance, _ = _shifts(walls, np.arange(len(walls.chainage)) < (stop[tried] - first)[:, None], eaves)
    square = (change * np.linalg.solve(covariance, change[:, :, None])[:, :, 0]).sum(axis=1)
    believed = (square > LIMITS.proof**2) & (np.hypot(*change.T) > LIMITS.least)
    return [ShiftedStretch(begin, float(ends[row]), change[row], covariance[row], float(square[row]))
            for row in np.flatnonzero(believed)]


def _without_remnants(stretches: list[ShiftedStretch], first: float, last: float) -> list[ShiftedStretch]:
    """Stretches that reach over what is left before, between and after them where walls could not clear it alone."""
    ordered = sorted(stretches, key=lambda item: item.begin)
    for number, item in enumerate(ordered):
        before = ordered[number - 1].end if number else first
        if item.begin - before < LIMITS.shortest:
            ordered[number] = replace(item, begin=min(item.begin, before if number else -np.inf))
    if ordered and last - ordered[-1].end < LIMITS.shortest:
        ordered[-1] = replace(ordered[-1], end=np.inf)
    return sorted(ordered, key=lambda item: -item.square)


def _extended(item: ShiftedStretch, walls: WallReadings, eaves: tuple[float, float]) -> ShiftedStretch:
    """A stretch to either side as far as no walls deny its shift: the step lies somewhere before these."""
    inside = (walls.chainage >= item.begin) & (walls.chainage <= item.end)
    behind = float(_shifts(walls.select(inside), np.ones((1, np.count_nonzero(inside)), bool), eaves)[2][0])
    off = [(walls.outside + behind - shift) / walls.sigma for shift in (0.0, walls.outward @ item.change)]
    without, shifted = (np.minimum(np.abs(part), LIMITS.most_denied) ** 2 for part in off)
    gain, ends = 0.5 * (without - shifted), []
    for rows in (np.flatnonzero(walls.chainage < item.begin)[::-1], np.flatnonzero(walls.chainage > item.end)):
        denied = np.flatnonzero(np.cumsum(gain[rows]) < -LIMITS.denied)
        ends.append(walls.chainage[rows[denied[0]]] if len(denied) else np.inf * (-1.0 if not ends else 1.0))
    return replace(item, begin=float(ends[0]), end=float(ends[1]))


def _shifts(walls: WallReadings, inside: np.ndarray,
            eaves: tuple[float, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The shift (e, 2) that the walls `inside` (e, w) each of e stretches want, together with the eaves of all; its
    covariance (e, 2, 2), and these eaves (e,), m.
    """
    outside, sigma = walls.outside, walls.sigma
    rows = np.column_stack([walls.outward, -np.ones(len(outside))])
    products = (rows[:, :, None] * rows[:, None, :]).reshape(-1, 9)
    prior = np.diag([LIMITS.most**-2, LIMITS.most**-2, eaves[1] ** -2])
    pull = np.array([0.0, 0.0, eaves[0] / eaves[1] ** 2])
    off = np.zeros(inside.shape)
    for _ in range(LIMITS.rounds):
        share = inside * sigma**-2 / (1.0 + (off / LIMITS.soft) ** 2)
        inverse = np.linalg.inv((share @ products).reshape(-1, 3, 3) + prior)
        solution = np.einsum("eij,ej->ei", inverse, share @ (rows * outside[:, None]) + pull)
        off = (outside - solution @ rows.T) / sigma
    return solution[:, :2], inverse[:, :2, :2] + walls.shared**2 * np.eye(2), solution[:, 2]
