"""Solid or dashed: which periodic pattern, if any, the paint along a line follows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR


@dataclass(frozen=True)
class DashPatternLimits:
    """Limits of dash pattern, each with its unit."""

    shortest_gap: float = 0.8  # Of a dashed line, m.
    longest_period: float = 22.0  # Dash and gap together, m.
    # Longer lines are compared with patterns stretch by stretch, m: dashes keep no phase for hundreds of metres.
    stretch: float = 90.0
    advantage: float = 0.08  # By so much more a dashed pattern must explain of the paint than a solid one.
    nearest_whole: float = 2.5  # Whole dashes tell of the ends of others up to so many periods away.


LIMITS = DashPatternLimits()

WHOLE, WORN = 0.12, 0.15
"""Lengths of whole dashes are alike to within the first; an end that lies farther inwards than the second of where its
neighbours ask for it is worn, m."""


@dataclass(frozen=True)
class Section:
    """A stretch of a line of one kind.

    Attributes
    ----------
    start, end : chainages, m.
    kind : "solid" or "dashed".
    dashes : begins and ends (n, 2) of the dashes seen, m; of a solid line its painted stretches.
    period, dash : lengths of dash and gap together and of the dash, m; NaN for solid.
    agreement : share of the pattern and the paint that both have (intersection over union).
    """

    start: float
    end: float
    kind: str
    dashes: np.ndarray
    period: float
    dash: float
    agreement: float


def painted_intervals(covered: np.ndarray, step: float, bridge: float = 0.5) -> np.ndarray:
    """Begins and ends (n, 2) of the painted stretches, m, from a mask of stations; holes up to `bridge` are closed."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], covered.astype(np.int8), [0]])))
    if not len(edges):
        return np.zeros((0, 2))
    runs = edges.reshape(-1, 2) * step - np.array([step / 2, step / 2])
    keep = np.concatenate([[True], runs[1:, 0] - runs[:-1, 1] > bridge])
    first = np.flatnonzero(keep)
    return np.column_stack([runs[first, 0], runs[np.append(first[1:], len(runs)) - 1, 1]])


def line_sections(covered: np.ndarray, step: float) -> list[Section]:
    """Sections of a line by its kind, from the mask of stations with paint `step` apart.

    Long painted stretches beside dashes are solid sections of their own, as before stop lines.
    """
    runs = painted_intervals(covered, step)
    runs = runs[runs[:, 1] - runs[:, 0] >= 0.3]
    if not len(runs):
        return []
    pattern = _pattern(runs)
    if pattern is None:
        return [_solid(runs)]
    period, dash, _ = pattern
    lengths = runs[:, 1] - runs[:, 0]
    long = lengths > max(1.7 * dash, dash + 1.5)
    if not long.any():
        return [_section(runs)]
    sections = []
    borders = np.flatnonzero(np.diff(long.astype(int)) != 0) + 1
    for part in np.split(np.arange(len(runs)), borders):
        sections.append(_solid(runs[part]) if long[part[0]] else _section(runs[part], (period, dash)))
    return sections


def with_worn_ends(dashes: np.ndarray, period: float, dash: float) -> tuple[np.ndarray, np.ndarray]:
    """Worn ends of dashes moved to where the whole dashes beside them ask for them.

    Parameters
    ----------
    dashes : begins and ends (n, 2) of the painted stretches in their order, m.
    period, dash : about, m.

    Returns
    -------
    dashes (n, 2), m, and which ends were moved (n, 2) bool: none where fewer than two dashes are whole, or where these
    do not lie at one distance.
    """
    untouched = dashes, np.zeros(dashes.shape, bool)
    length, middle = dashes[:, 1] - dashes[:, 0], dashes.mean(axis=1)
    alike = np.abs(length - dash) <= 3 * WHOLE
    usual = float(np.median(length[alike])) if alike.any() else np.nan
    whole = np.flatnonzero(np.abs(length - usual) <= WHOLE)
    if len(whole) < 2:
        return untouched
    number = np.concatenate([[0], np.cumsum(np.round(np.diff(middle[whole]) / period))])
    if (np.diff(number) < 1).any():
        return untouched
    period, first = np.polyfit(number, middle[whole], 1)
    if np.abs(number * period + first - middle[whole]).max() > WORN:
        return untouched
    moved, placed = dashes.copy(), np.zeros(dashes.shape, bool)
    place = np.round((middle - first) / period)
    near = np.abs(middle[:, None] - middle[whole]).min(axis=1) <= LIMITS.nearest_whole * period
    for k in np.unique(place[near]):
        members = np.flatnonzero(place == k)
        wanted = first + k * period + usual * np.array([-0.5, 0.5])
        seen = np.array([dashes[members[0], 0], dashes[members[-1], 1]])
        inwards = (seen - wanted) * [1, -1]
        if inwards.min() < -WORN or seen[1] - seen[0] < 0.3 * usual:
            continue
        for side, member in ((0, members[0]), (1, members[-1])):
            if inwards[side] > WORN:
                moved[member, side], placed[member, side] = wanted[side], True
    return moved, placed


def _section(runs: np.ndarray, usual: tuple[float, float] | None = None) -> Section:
    """A section of dashes; few ones take the period and the dash of the line around (`usual`)."""
    pattern = _pattern(runs) if len(runs) >= 3 else None
    if pattern is None and usual is None:
        return _solid(runs)
    period, dash = pattern[:2] if pattern else usual
    agreement = pattern[2] if pattern else np.nan
    return Section(runs[0, 0], runs[-1, 1], "dashed", runs, period, dash, agreement)


def _solid(runs: np.ndarray) -> Section:
    length = runs[-1, 1] - runs[0, 0]
    share = float((runs[:, 1] - runs[:, 0]).sum() / max(length, LEAST_DIVISOR))
    return Section(runs[0, 0], runs[-1, 1], "solid", runs, np.nan, np.nan, share)


def _pattern(runs: np.ndarray) -> tuple[float, float, float] | None:
    """Period, dash (m) and agreement of the best periodic pattern; None where a solid line explains the paint as well.

    Of a line longer than 1.5 `LIMITS.stretch` the medians of its stretches, where most pieces lie in dashed ones.
    """
    if runs[-1, 1] - runs[0, 0] <= 1.5 * LIMITS.stretch:
        return _pattern_of_stretch(runs)
    stretch = ((runs[:, 0] - runs[0, 0]) // LIMITS.stretch).astype(int)
    parts = [runs[stretch == k] for k in np.unique(stretch)]
    found = [(pattern, len(part)) for part in parts if (pattern := _pattern_of_stretch(part)) is not None]
    if sum(count for _, count in found) <= 0.5 * len(runs):
        return None
    period, dash, agreement = (float(value) for value in np.median([pattern for pattern, _ in found], axis=0))
    return period, dash, agreement


def _pattern_of_stretch(runs: np.ndarray) -> tuple[float, float, float] | None:
    """Period, dash (m) and agreement of the best periodic pattern; None where a solid line explains the paint as well.

    The intersection over union of paint and pattern is compared for all periods, dashes and phases on a grid of
    0.1 m. The paint of a solid line that is worn has gaps too, but not regular ones.
    """
    gaps = runs[1:, 0] - runs[:-1, 1]
    if (gaps >= LIMITS.shortest_gap).sum() < 2:
        return None
    step = 0.1
    count = int(np.ceil((runs[-1, 1] - runs[0, 0]) / step))
    at = runs[0, 0] + (np.arange(count) + 0.5) * step
    row = np.searchsorted(runs[:, 0], at, side="right") - 1
    paint = (at <= runs[np.maximum(row, 0), 1]).astype(float)
    solid = paint.mean()
    starts = runs[1:, 0] - runs[0, 0]
    guesses = np.unique(np.round(np.concatenate([np.diff(runs[:, 0]), np.diff(runs[:, 1]), starts / 2.0]), 1))
    near = (guesses[:, None] + np.arange(-0.2, 0.25, 0.05)).ravel()
    periods = np.unique(np.round(near[(near >= 1.5) & (near <= min(LIMITS.longest_period, count * step / 1.5))], 2))
    best = max((_agreement(paint, step, period) for period in periods), default=None)
    if best is None or best[0] < solid + LIMITS.advantage or best[0] < 0.5:
        return None
    return best[1], best[2], best[0]


def _agreement(paint: np.ndarray, step: float, period: float) -> tuple[float, float, float]:
    """(agreement, period, dash) of the best dash and phase for one period."""
    bins = max(round(period / step), 3)
    phase = ((np.arange(len(paint)) + 0.5) * step / period % 1.0 * bins).astype(int)
    hits, total = np.bincount(phase, paint, bins), np.bincount(phase, minlength=bins)
    twice_hits, twice_total = np.concatenate([[0], np.tile(hits, 2).cumsum()]), np.concatenate(
        [[0], np.tile(total, 2).cumsum()])
    dashes = np.arange(max(2, bins // 10), bins - int(np.ceil(0.5 * LIMITS.shortest_gap / step)))
    if not len(dashes):
        return -1.0, period, np.nan
    # By dash and phase: what lies on the dashes, of the paint and of all.
    inside, covered = (np.lib.stride_tricks.sliding_window_view(sums, bins)[dashes[0]:dashes[-1] + 1] - sums[:bins]
                       for sums in (twice_hits, twice_total))
    shares = (inside / (paint.sum() + covered - inside)).max(axis=1)
    best = int(shares.argmax())
    return float(shares[best]), period, int(dashes[best]) * step
