"""Directions of all lanes of a map, by what tells most first: drives, arrows and stop lines, neighbours, road axes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...settings.roadmap import MapSettings
from ..map_records import Finding, MapArea
from .beyond_junctions import directions_beyond
from .lane_strips import Strip, add_arrows, add_stops, middle_offset
from .road_axes import RoadAxis, add_axes
from .road_sections import RoadSection
from .strip_directions import settle_directions, spread_directions

SectionWork = tuple[RoadSection, list[Strip], list[np.ndarray]]
"""A section, its strips with the drives counted in them, and the stop lines (n, 3) in it."""


def give_directions(worked: Sequence[SectionWork], arrows: Sequence[MapArea], axes: Sequence[RoadAxis],
                    left_hand: bool | None) -> list[Finding]:
    """Give the strips of all sections a direction where anything shows it; findings tell what contradicts itself.

    `left_hand` is the side of the traffic, None where it is not known.
    """
    findings = []
    rule = left_hand is not False
    for section, strips, stops in worked:
        add_arrows(strips, section, arrows)
        add_stops(strips, section, stops, left_hand)
        findings += settle_directions(strips, section)
        findings += spread_directions(strips, section, rule)
        add_axes(strips, section, axes, left_hand)
        findings += spread_directions(strips, section, rule)
    if directions_beyond([(section, strips) for section, strips, _ in worked]):
        for section, strips, _ in worked:
            findings += spread_directions(strips, section, rule)
    return findings


def keeps_left(worked: Sequence[SectionWork], settings: MapSettings) -> bool | None:
    """Whether traffic keeps to the left: as told, else as strips driven both ways show; None where none do."""
    if settings.traffic != "auto":
        return settings.traffic == "left"
    votes = 0.0
    for section, strips, _ in worked:
        for one in strips:
            for other in strips:
                if one.start != other.start or one.forward <= one.backward or other.backward <= other.forward:
                    continue
                separation = middle_offset(section, one, one.start) - middle_offset(section, other, one.start)
                votes += np.sign(separation) * min(one.forward, other.backward)
    return None if votes == 0 else bool(votes > 0)
