"""Bounds that go on beside their parallel neighbour where their own paint is worn or hidden."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import SAME_PLACE
from ...settings.roadmap import MapSettings
from .road_sections import Axis, BoundTrack


@dataclass(frozen=True)
class BoundContinuationLimits:
    """Limits of bound continuation, each with its unit."""

    # A bound is continued where it is seen over so many metres, and beside its neighbour over so many.
    least_seen: float = 5.0
    # The same for a bound between two others, which a lane's width on both sides shows to be one.
    least_seen_between: float = 3.0
    parallel: float = 0.10  # Its distance to the neighbour varies by no more there (standard deviation), m.
    # The same for a bound with none beyond it, which may be no road's: kerbs and paving are yellow lines too.
    outermost: float = 2.0
    same_bound: float = 0.5  # What lies so near to where a bound would go on is the same bound, m.


LIMITS = BoundContinuationLimits()

FARTHEST = 4.0
"""It is continued by no more than so many times the length over which it is seen."""

STEP = 1.0
"""Distance of the points that are made, m."""


def continued(tracks: Sequence[BoundTrack], axis: Axis, barriers: Sequence[shapely.Geometry],
              settings: MapSettings) -> list[BoundTrack]:
    """Tracks drawn on at a constant distance to the nearest parallel one that reaches farther.

    What is added is unseen, as a gap is. It ends at crosswalks, at other bounds, and where a lane beside it would be
    too narrow. Short marks and what is not parallel are left as they are.
    """
    extended = list(tracks)
    tree = shapely.STRtree(list(barriers)) if len(barriers) else None
    for number in sorted(range(len(extended)), key=lambda k: extended[k].start - extended[k].end):
        for ahead in (False, True):
            others = [track for k, track in enumerate(extended) if k != number]
            # Where the nearest neighbour ends, as an island's kerb does, the next one may lead farther.
            while (added := _beyond(extended[number], others, axis, ahead, tree, settings)) is not None:
                extended[number] = _longer(extended[number], *added, ahead)
    return extended


def _beyond(track: BoundTrack, others: Sequence[BoundTrack], axis: Axis, ahead: bool, tree: shapely.STRtree | None,
            settings: MapSettings) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Points (n, 3), chainages and offsets (n,) by which a track goes on at one of its ends; None where it does not."""
    end, seen = track.end if ahead else track.start, track.seen
    least = LIMITS.least_seen_between if _is_between(track, others, settings) else LIMITS.least_seen
    best = None
    for other in others:
        reach = (other.end - end) if ahead else (end - other.start)
        at = np.arange(max(track.start, other.start), min(track.end, other.end), STEP / 2.0)
        if reach < STEP or len(at) * STEP / 2.0 < least or seen < least:
            continue
        separation = track.interpolate(at) - other.interpolate(at)
        wide = abs(float(np.median(separation)))
        if separation.std() > LIMITS.parallel or not settings.min_width <= wide <= 2.0 * settings.max_width:
            continue
        if best is None or wide < best[0]:
            best = (wide, float(np.median(separation)), other, reach)
    if best is None:
        return None
    _, separation, other, reach = best
    beside = [other.interpolate(np.array([end]))[0] - (track.offset[-1] if ahead else track.offset[0])
              for other in others]
    inner = np.nanmin([*beside, 0.0]) < 0.0 < np.nanmax([*beside, 0.0])
    sign = 1.0 if ahead else -1.0
    onward = end + sign * np.arange(STEP, reach, STEP)
    if any((np.abs(track.interpolate(onward) - other.interpolate(onward) - separation) < LIMITS.same_bound).any()
           for track in others):
        return None  # the bound itself goes on there: that gap was too long to be drawn through
    most = min(settings.bridge, (FARTHEST if inner else LIMITS.outermost) * seen) - _unseen_end(track, ahead)
    length = min(reach, most)
    if length < STEP:
        return None
    chainage = end + sign * np.append(np.arange(STEP, length, STEP), length)
    offset = other.interpolate(chainage) + separation
    foot, along = axis.frame(chainage)
    plan = foot + offset[:, None] * np.column_stack([-along[:, 1], along[:, 0]])
    free = _free(chainage, offset, plan, others, tree, settings)
    if free < 2:
        return None
    tip = track.points[-1 if ahead else 0]
    height = np.interp(chainage, other.chainage, other.points[:, 2]) + tip[2]
    height -= np.interp(end, other.chainage, other.points[:, 2])
    kept = _onward(tip[:2], plan[:free], sign * along[:free])
    return (np.column_stack([plan, height])[kept], chainage[kept], offset[kept]) if len(kept) > 1 else None


def _onward(tip: np.ndarray, plan: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Rows of the places (n, 2) that lie ahead of the last one kept, the first of an end (2,), in the road's direction.

    Far from a bent axis its cross-sections meet: places of greater chainage may lie behind.
    """
    kept: list[int] = []
    for row, (place, direction) in enumerate(zip(plan, along)):
        if (place - tip) @ direction > SAME_PLACE:
            kept.append(row)
            tip = place
    return np.array(kept, int)


def _unseen_end(track: BoundTrack, ahead: bool) -> float:
    """Length by which a track goes on unseen at one of its ends, m."""
    length = 0.0
    for start, end, line in (reversed(track.pieces) if ahead else track.pieces):
        if line is not None:
            break
        length += end - start
    return length


def _is_between(track: BoundTrack, others: Sequence[BoundTrack], settings: MapSettings) -> bool:
    """Whether a track has another one at a lane's width on both of its sides."""
    middle = (track.start + track.end) / 2.0
    offsets = [float(other.interpolate(np.array([middle]))[0] - np.interp(middle, track.chainage, track.offset))
               for other in others]
    return all(any(settings.min_width <= side * one <= settings.max_width for one in offsets) for side in (1.0, -1.0))


def _free(chainage: np.ndarray, offset: np.ndarray, plan: np.ndarray, others: Sequence[BoundTrack],
          tree: shapely.STRtree | None, settings: MapSettings) -> int:
    """How many of the points lie clear of crosswalks and leave room for a lane to all other bounds."""
    blocked = np.zeros(len(chainage), bool)
    for other in others:
        blocked |= np.abs(other.interpolate(chainage) - offset) < settings.min_width  # NaN beyond its ends is no block
    if tree is not None:
        blocked[np.unique(tree.query(shapely.points(plan), predicate="intersects")[0])] = True
    return int(np.argmax(blocked)) if blocked.any() else len(blocked)


def _longer(track: BoundTrack, points: np.ndarray, chainage: np.ndarray, offset: np.ndarray,
            ahead: bool) -> BoundTrack:
    """The track with points added behind its end or before its begin, as an unseen piece."""
    if ahead:
        piece = (track.end, float(chainage[-1]), None)
        return BoundTrack(np.vstack([track.points, points]), np.append(track.chainage, chainage),
                          np.append(track.offset, offset), [*track.pieces, piece], track.double)
    piece = (float(chainage[-1]), track.start, None)
    return BoundTrack(np.vstack([points[::-1], track.points]), np.append(chainage[::-1], track.chainage),
                      np.append(offset[::-1], track.offset), [piece, *track.pieces], track.double)
