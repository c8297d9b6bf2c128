"""Settings of markings in mobile surveys."""

from __future__ import annotations

from dataclasses import dataclass

from .declaration import Settings, setting
from .terrain import ground_source_setting


@dataclass(frozen=True)
class StrokeRules(Settings):
    """What of a survey's points is paint (J 3.2.3)."""

    block_size: float = setting(
        2.5, "Block size", "Side in metres of the block whose mean a marking exceeds.", "m", 0.5, 20.0, advanced=True)
    contrast: float = setting(
        0.35, "Contrast", "How much brighter than the ground a marking is, as a share of the ground's intensity.", "",
        0.05, 5.0, advanced=True)
    max_width: float = setting(
        0.8, "Maximum stroke width", "What is wider in both directions, in metres, is no marking but ground.", "m", 0.2,
        5.0, advanced=True)
    min_length: float = setting(
        0.4, "Minimum length", "Shorter pieces, in metres, are left out.", "m", 0.0, 10.0, advanced=True)


@dataclass(frozen=True)
class ReachRules(Settings):
    """Which points are looked at."""

    max_range: float = setting(
        25.0, "Maximum range", "Points farther from the scanner, in metres, are left out. The range up to which the "
        "curve holds (R2) may be shorter.", "m", 1.0, 200.0, advanced=True)
    ground: str = ground_source_setting(advanced=True)
