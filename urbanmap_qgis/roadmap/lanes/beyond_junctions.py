"""Directions of lanes from the same road on the other side of a junction, where its middle goes straight on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .lane_strips import BEYOND, Strip, colour_of
from .road_sections import RoadSection, is_pavement


@dataclass(frozen=True)
class BeyondJunctionLimits:
    """Limits of directions from beyond a junction, each with its unit."""

    longest: float = 60.0  # Between the ends of the two roads, m.
    angle: float = np.radians(4.0)
    # The line that parts the directions leads to a line of the other road within the first, m, and the second of the
    # length between.
    beside: float = 0.4
    growth: float = 0.01
    lane: float = 0.6  # Lanes on both sides lie in one course to within so much, m.


LIMITS = BeyondJunctionLimits()


@dataclass(frozen=True)
class _End:
    """Strips side by side at an end of a section.

    Attributes
    ----------
    section, strips : from right to left along the section's axis.
    outward : unit direction (2,) in which the road ends.
    along : 1 where that is the axis' direction, -1 where not.
    at : chainage, m.
    """

    section: RoadSection
    strips: list[Strip]
    outward: np.ndarray
    along: int
    at: float

    def track_end(self, track: int) -> np.ndarray:
        """Place (2,) at which a track ends here."""
        return self.section.tracks[track].point(self.at)[:2]

    def middle(self, strip: Strip) -> np.ndarray:
        return (self.track_end(strip.right) + self.track_end(strip.left)) / 2.0


def directions_beyond(sections: Sequence[tuple[RoadSection, Sequence[Strip]]]) -> int:
    """Give strips without a direction that of the lane in their course on the other side of a junction.

    Both directions must be known there, from more than such a guess, and the line between them must lead to a line of
    this road: to the yellow or double one, where it has any. Only strips in the course of a lane take its direction.
    Returns the number of strips that took one.
    """
    ends = [end for section, strips in sections for end in _ends(section, strips)]
    taken = 0
    for known in ends:
        parting = _parting_track(known)
        if parting is None:
            continue
        for end in ends:
            if end.section is not known.section and _opposite(known, end, parting):
                taken += _take(known, end)
    return taken


def _ends(section: RoadSection, strips: Sequence[Strip]) -> list[_End]:
    """Both ends of a section."""
    if not strips:
        return []
    found = []
    for along, at in ((-1, min(strip.start for strip in strips)), (1, max(strip.end for strip in strips))):
        row = [strip for strip in strips if (strip.start if along < 0 else strip.end) == at]
        row.sort(key=lambda strip: np.interp(at, section.tracks[strip.right].chainage,
                                             section.tracks[strip.right].offset))
        _, course = section.axis.frame(np.array([at]))
        found.append(_End(section, row, along * course[0], along, at))
    return found


def _parting_track(end: _End) -> int | None:
    """The one track with lanes of both directions beside it, each known by more than a guess from beyond a junction."""
    found = [right.left for right in end.strips for left in end.strips
             if right.left == left.right and right.sign * left.sign == -1 and BEYOND not in (right.source, left.source)]
    return found[0] if len(found) == 1 else None


def _opposite(known: _End, end: _End, parting: int) -> bool:
    """Whether an end lies straight across, with a line where the one between the directions leads."""
    if known.outward @ end.outward > -np.cos(LIMITS.angle):
        return False
    begin = known.track_end(parting)
    normal = np.array([-known.outward[1], known.outward[0]])
    tracks = sorted({track for strip in end.strips for track in (strip.right, strip.left)})
    middles = [track for track in tracks if colour_of(end.section.tracks[track]) == "yellow"
               or end.section.tracks[track].double]
    inner = [track for track in middles if any(strip.left == track for strip in end.strips)
             and any(strip.right == track for strip in end.strips)]
    for track in inner or tracks:
        way = end.track_end(track) - begin
        gap = way @ known.outward
        if 0.0 < gap < LIMITS.longest and abs(way @ normal) < LIMITS.beside + LIMITS.growth * gap:
            return True
    return False


def _take(known: _End, end: _End) -> int:
    """Let strips of an end take the direction of the lane in their course; returns their number."""
    normal = np.array([-known.outward[1], known.outward[0]])
    lanes = [(known.middle(strip) @ normal, strip.sign * known.along) for strip in known.strips if strip.sign]
    taken = 0
    for strip in end.strips:
        if strip.sign or strip.contradicted or is_pavement(end.section, strip.right, strip.left):
            continue
        across = end.middle(strip) @ normal
        signs = {sign for place, sign in lanes if abs(place - across) < LIMITS.lane}
        if len(signs) == 1:
            # Along the known road's outward direction is against the other's.
            strip.sign, strip.source = -signs.pop() * end.along, BEYOND
            taken += 1
    return taken
