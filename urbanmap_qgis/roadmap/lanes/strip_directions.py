"""In which direction strips of lane width are driven: by what is in them, then by what is beside and before them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...wording import say
from ..map_records import Finding
from .lane_strips import (
    ACROSS,
    BESIDE,
    DRIVEN,
    INFERRED,
    PAINTED,
    Strip,
    colour_of,
    line_kinds,
    offset_of,
    strip_middle,
)
from .road_sections import RoadSection, is_pavement


@dataclass(frozen=True)
class DirectionLimits:
    """Limits of directions, each with its unit."""

    clear_drive: float = 15.0  # Drives in one direction over so many metres are believed more than paint.
    # The outermost bound of a lane that only a dashed line tells of is seen along such a share of that line.
    mostly_seen: float = 0.5
    # Where no drive shows it, arrows tell a direction only between bounds so long, m: not in car parks, which have no
    # stop lines across a part of the road.
    least_undriven: float = 25.0
    # A drive shows a strip's direction where it runs in it for so long, m (or half of a shorter strip).
    least_drive: float = 5.0
    # A strip carries on another where their bounds that are not shared lie so near to each other, m: half a lane.
    carried_on: float = 1.5


LIMITS = DirectionLimits()


def settle_directions(strips: Sequence[Strip], section: RoadSection) -> list[Finding]:
    """Give each strip the direction that its own evidence shows, along its whole bounds; others stay at 0."""
    findings = []
    for pair in {(strip.right, strip.left): None for strip in strips}:
        members = [strip for strip in strips if (strip.right, strip.left) == pair]
        sign, source, contradicts = _own_direction(members)
        outside = is_pavement(section, *pair)
        if source == PAINTED and (outside or any(one.outside for one in members)):
            sign, source = 0, ""
        if contradicts:
            findings.append(_finding(section, members[0], "direction contradicts", contradicts))
        for one in members:
            one.sign, one.source, one.contradicted = sign, source, bool(contradicts) and not sign
    return findings


def spread_directions(strips: Sequence[Strip], section: RoadSection, left_hand: bool) -> list[Finding]:
    """Give strips without a direction one from their neighbours.

    Across a dashed line goes the same direction, and so does what carries on a strip at a cross-section. Across a
    yellow or double line lies the other direction, where the rule of the road allows it. What breaks that rule is taken
    back and told.
    """
    changed = True
    while changed:
        changed = False
        for strip in strips:
            if strip.sign == 0 and not strip.contradicted:
                strip.sign, strip.source = _from_neighbours(strip, strips, section, left_hand)
                changed |= strip.sign != 0
    return _against_the_rule(strips, section, left_hand)


def _against_the_rule(strips: Sequence[Strip], section: RoadSection, left_hand: bool) -> list[Finding]:
    """Take directions back where lanes side by side would keep to the wrong side; findings tell where.

    Those inferred from neighbours go first; where both have evidence of their own, only drives are believed.

    With traffic on the left, what leads along the axis lies to the left of what leads against it.
    """
    findings = []
    for right in strips:
        for left in strips:
            if left.start != right.start or left.right != right.left or right.sign * left.sign != -1:
                continue
            if (left.sign > 0) == left_hand:
                continue
            inferred = [one for one in (right, left) if one.source in INFERRED]
            doubted = inferred or [one for one in (right, left) if one.source != DRIVEN]
            findings.append(_finding(section, (doubted or [right])[0], "direction contradicts",
                                     "Lanes beside each other would keep to the wrong side of the road here" + (
                                         "; those that were not driven were not made." if doubted else ".")))
            for one in doubted:
                one.sign, one.source, one.contradicted = 0, "", True
    return findings


def _own_direction(members: Sequence[Strip]) -> tuple[int, str, str]:
    """Direction of the strips between two bounds by what is in them, its source, and what contradicts it."""
    ways = [sum(one.driven[way] for one in members) for way in (0, 1)]
    forward, backward = sum(one.forward for one in members), sum(one.backward for one in members)
    length = sum(one.end - one.start for one in members)
    contradicts = min(forward, backward) > 0.3 * max(forward, backward)
    if max(ways) >= LIMITS.clear_drive and min(ways) <= 0.1 * max(ways):
        return 1 if ways[0] > ways[1] else -1, DRIVEN, (
            say("Arrows or stop lines contradict the drives about the direction here; that of the drives was taken.")
            if contradicts else "")
    if contradicts:
        return 0, "", say("Drives, arrows or stop lines contradict each other about the direction here.")
    if max(forward, backward) >= min(LIMITS.least_drive,
                                     length / 2.0) and (
            max(ways) > 0 or length > LIMITS.least_undriven or any(one.stopped for one in members)):
        return 1 if forward > backward else -1, DRIVEN if max(ways) > 0 else PAINTED, ""
    return 0, "", ""


def _from_neighbours(strip: Strip, strips: Sequence[Strip], section: RoadSection, left_hand: bool) -> tuple[int, str]:
    """Direction of a strip from one beside it in the same cell, or before and behind it between the same bounds."""
    for other in strips:
        if other.sign == 0 or other is strip:
            continue
        if (other.right, other.left) == (strip.right, strip.left):
            return other.sign, other.source
        if other.start != strip.start:
            continue
        shared = strip.left if other.right == strip.left else strip.right if other.left == strip.right else None
        if shared is None:
            continue
        line = section.tracks[shared]
        kinds = line_kinds(line, strip.start, strip.end)
        pairs = (strip.right, strip.left), (other.right, other.left)
        parted = any(shared in one.parted for one in strips if (one.right, one.left) in pairs)
        if (max(kinds, key=kinds.get) == "dashed" and not parted and colour_of(line) != "yellow" and not line.double
                and _is_bounded(strip, shared, section)):
            return other.sign, BESIDE
        # With traffic on the left, what lies to the right of a lane is the other direction.
        to_right = (shared == strip.left) == (other.sign > 0)
        if (colour_of(line) == "yellow" or line.double) and to_right == left_hand:
            return -other.sign, ACROSS
    return _carried_on(strip, strips, section)


def _carried_on(strip: Strip, strips: Sequence[Strip], section: RoadSection) -> tuple[int, str]:
    """Direction of the strips that meet one at its cross-sections and share one bound with it, where they agree.

    The other bound is another line there: the kerb of an island where the centre line ends.
    """
    ways = {}
    for other in strips:
        if other.sign == 0 or (other.right == strip.right) == (other.left == strip.left):
            continue
        for level in {strip.start} & {other.end} | {strip.end} & {other.start}:
            step = (offset_of(section, other.left, level) - offset_of(section, strip.left, level)
                    + offset_of(section, other.right, level) - offset_of(section, strip.right, level))
            if abs(step) < LIMITS.carried_on:
                ways[other.sign] = other.source
    return next(iter(ways.items())) if len(ways) == 1 else (0, "")


def _is_bounded(strip: Strip, shared: int, section: RoadSection) -> bool:
    """Whether the far bound of a strip has another beyond it, or is seen well: no lane is made of scraps beside one."""
    far = section.tracks[strip.left if shared == strip.right else strip.right]
    at = np.array([(strip.start + strip.end) / 2.0])
    beyond = [track.interpolate(at)[0] for track in section.tracks if track is not far]
    place, near = far.interpolate(at)[0], section.tracks[shared].interpolate(at)[0]
    if any((one > place) == (place > near) for one in beyond if np.isfinite(one)):
        return True
    return far.seen >= LIMITS.mostly_seen * section.tracks[shared].seen


def _finding(section: RoadSection, strip: Strip, kind: str, text: str) -> Finding:
    x, y = strip_middle(section, strip)
    return Finding(kind, text, x, y)
