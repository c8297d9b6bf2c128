"""Drives that keep to the other side of the centre line than the traffic does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...wording import say
from ..map_records import Finding
from .lane_strips import DRIVEN, Strip, colour_of, strip_middle
from .road_sections import RoadSection


def wrong_side_findings(section: RoadSection, strips: Sequence[Strip], left_hand: bool | None) -> list[Finding]:
    """Findings where a drive has a centre line, with an undriven strip across it, on the side of its kerb.

    The drive is believed all the same: yellow lines also part lanes of one direction. Where the side of the traffic is
    not known (`left_hand` None) nothing is told.
    """
    found: dict[tuple[int, int], Strip] = {}
    for strip in strips if left_hand is not None else ():
        if strip.source != DRIVEN or not strip.sign:
            continue
        to_left = (strip.sign > 0) == left_hand  # the side of the section's axis on which the kerb ought to be
        kerb, middle = (_centre_line(strip, strips, section, side) for side in (to_left, not to_left))
        if kerb is not None and kerb.sign == 0 and middle is None:
            found.setdefault((strip.right, strip.left), strip)
    text = say("The drive keeps to the other direction's side of the centre line here; the lane was made as it was "
               "driven.")
    return [Finding("direction contradicts", text, *strip_middle(section, strip)) for strip in found.values()]


def _centre_line(strip: Strip, strips: Sequence[Strip], section: RoadSection, to_left: bool) -> Strip | None:
    """The first strip across a yellow or double line to the left or right of one, None where there is none."""
    for track, beyond in _beside(strip, strips, to_left):
        line = section.tracks[track]
        if colour_of(line) == "yellow" or line.double:
            return beyond
    return None


def _beside(strip: Strip, strips: Sequence[Strip], to_left: bool) -> Iterator[tuple[int, Strip]]:
    """The strips beside one, from it outwards, each with the number of the track before it."""
    while True:
        track = strip.left if to_left else strip.right
        onward = [one for one in strips if one.start == strip.start
                  and (one.right if to_left else one.left) == track]
        if not onward:
            return
        strip = onward[0]
        yield track, strip
