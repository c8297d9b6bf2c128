"""One town paints its dashes alike: patterns that regular lines show decide what worn lines are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR
from .dash_pattern import Section


@dataclass(frozen=True)
class DashConsensusLimits:
    """Limits of dash consensus, each with its unit."""

    alike: float = 0.2  # Dashes of one pattern differ in length by up to this share.
    in_step: float = 0.06  # Distances of dashes differ from multiples of the period by up to this share of it.
    # A section is regular where so much of its paint lies in dashes of one length in step; below the second it is
    # no dashed line, but a solid one with gaps worn into it.
    regular: float = 0.7
    irregular: float = 0.5
    multiples: int = 3  # Dashes up to so many periods apart are in step: those between may be hidden.


LIMITS = DashConsensusLimits()

LEAST = 3
"""Dashes in step that show a pattern."""


def with_common_patterns(lines: Sequence[Sequence[Section]]) -> list[list[Section]]:
    """The sections of lines with dashes only where the dashes keep a pattern that a regular line shows.

    Of each dashed section, the pattern (period, dash) among those of regular sections is taken that explains most of
    its paint; runs in step with it stay dashes, the others are solid. Where none explains any, the section stays as it
    is if half of its paint is in step by its own pattern, and is solid otherwise.
    """
    patterns = _patterns(lines)
    return [_resolved(sections, patterns) for sections in lines]


def _patterns(lines: Sequence[Sequence[Section]]) -> list[tuple[float, float]]:
    """Periods and dashes (m) of the regular sections."""
    found = []
    for section in (one for sections in lines for one in sections if one.kind == "dashed"):
        members = _in_step(section.dashes, section.period, _usual(section))
        if members.sum() >= LEAST and _share(section.dashes, members) >= LIMITS.regular:
            found.append((section.period, _usual(section)))
    return found


def _usual(section: Section) -> float:
    """The dash of a section: the median of its dashes near the pattern's own, m."""
    length = section.dashes[:, 1] - section.dashes[:, 0]
    near = np.abs(length - section.dash) <= LIMITS.alike * section.dash
    return float(np.median(length[near])) if near.any() else section.dash


def _in_step(runs: np.ndarray, period: float, dash: float) -> np.ndarray:
    """Which runs (n,) are as long as a dash and lie in step with another such run."""
    alike = np.abs(runs[:, 1] - runs[:, 0] - dash) <= LIMITS.alike * dash
    periods = np.abs(runs.mean(axis=1)[:, None] - runs.mean(axis=1)) / period
    number = np.round(periods)
    near = (number >= 1) & (number <= LIMITS.multiples)
    near &= np.abs(periods - number) <= LIMITS.in_step * np.sqrt(np.maximum(number, 1))
    return alike & (near & alike).any(axis=1)


def _share(runs: np.ndarray, members: np.ndarray) -> float:
    """Share of the paint that lies in the runs held."""
    length = runs[:, 1] - runs[:, 0]
    return float(length[members].sum() / max(length.sum(), LEAST_DIVISOR))


def _resolved(sections: Sequence[Section], patterns: Sequence[tuple[float, float]]) -> list[Section]:
    """The sections of one line by the common patterns; neighbours of one kind are one."""
    runs, owner = [], []
    for section in sections:
        found = _best(section, patterns) if section.kind == "dashed" else (np.zeros(len(section.dashes), bool), None)
        members, pattern = found
        runs += list(section.dashes)
        owner += [pattern if one else None for one in members]
    if not runs:
        return list(sections)
    runs = np.array(runs)
    borders = [0, *(k for k in range(1, len(owner)) if owner[k] != owner[k - 1]), len(owner)]
    return [_section(runs[a:b], owner[a]) for a, b in zip(borders[:-1], borders[1:])]


def _best(section: Section, patterns: Sequence[tuple[float, float]]) -> tuple[np.ndarray, tuple[float, float] | None]:
    """Runs of a dashed section that stay dashes, and the pattern they keep."""
    tried = [(_in_step(section.dashes, *pattern), pattern) for pattern in patterns]
    members, pattern = max(tried, key=lambda one: _share(section.dashes, one[0]), default=(np.zeros(1, bool), None))
    if members.any():
        return _with_worn(section.dashes, members, *pattern), pattern
    usual = section.period, _usual(section)
    regular = _share(section.dashes, _in_step(section.dashes,
                                              *usual)) >= LIMITS.irregular or len(section.dashes) < LEAST
    return np.full(len(section.dashes), regular), usual


def _with_worn(runs: np.ndarray, members: np.ndarray, period: float, dash: float) -> np.ndarray:
    """The runs held, and shorter ones beside such a one that lie where a dash in step with them would."""
    middle = runs.mean(axis=1)
    periods = (middle[:, None] - middle[members]) / period
    off = np.abs(periods - np.round(periods)) * period
    near = np.abs(periods) <= LIMITS.multiples + 0.5
    near &= off <= (dash * (1 + LIMITS.alike) - (runs[:, 1] - runs[:, 0]))[:, None] / 2
    beside = np.append(members[1:], False) | np.append(False, members[:-1])
    return members | (near.any(axis=1) & beside)


def _section(runs: np.ndarray, pattern: tuple[float, float] | None) -> Section:
    length = runs[-1, 1] - runs[0, 0]
    if pattern is None:
        return Section(runs[0, 0], runs[-1, 1], "solid", runs, np.nan, np.nan,
                       float((runs[:, 1] - runs[:, 0]).sum() / max(length, LEAST_DIVISOR)))
    return Section(runs[0, 0], runs[-1, 1], "dashed", runs, *pattern, np.nan)
