"""What a product of a map level must keep: limits of the standard deviation of its positions.

Source: Japan's rules for public surveys (作業規程の準則), positional accuracy of digital topographic maps; the rows of
500, 1000 and 2500 are also tables P01, P02 and P05 to P08 of the PLATEAU specification 5.0, chapter 6.3.3.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Limits:
    """Greatest standard deviation in plan and in height, m; None: not asked for."""

    plan: float | None
    height: float | None


MAP_LEVELS = {
    250: Limits(0.12, 0.25),
    500: Limits(0.25, 0.25),
    1000: Limits(0.70, 0.33),
    2500: Limits(1.75, 0.66),
    5000: Limits(3.50, 1.66),
}
"""Limits by map level (地図情報レベル)."""
