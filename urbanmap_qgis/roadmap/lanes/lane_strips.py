"""Strips of lane width between the bounds of a road section, and what shows in which direction they are driven."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR
from ...settings.roadmap import MapSettings
from ...wording import mark
from ..map_records import DrivenPath, MapArea
from .road_sections import STEP, WIDE, BoundTrack, RoadSection

SNAP = 9.0
"""Ends of lanes so near to each other along the road are one cross-section of it, m."""


@dataclass(frozen=True)
class LaneStripsLimits:
    """Limits of lane strips, each with its unit."""

    cover: float = 0.6  # Share of a cell that both bounds of a lane must cover.
    one_lane: float = 4.0  # Between two lines no farther apart there is one lane at the most, m.
    stop_reach: float = 6.0  # A stop line belongs to a lane that ends so near, m.
    one_row: float = 1.5  # Pieces of a stop line lie so near to each other along and across the road, m.
    half: float = 0.4  # A stop line stops a lane before more than such a share of which it lies: it may be worn.
    at_line: float = 0.6  # A stop line ends at a line that lies so near to its end, m.
    # Pieces of a stop line on one straight are one over what a vehicle hides, m apart, and m along the road.
    hidden: float = 4.0
    straight: float = 0.3
    # What a stop line on the other side of the road weighs, m driven: less than any evidence in the lane itself.
    away: float = 6.0


LIMITS = LaneStripsLimits()

BESIDE, ACROSS = mark("beside a dashed line"), mark("across the centre line")
ALONG_AXIS = mark("road axis")
BEYOND = mark("beyond the junction")
INFERRED = (BESIDE, ACROSS, ALONG_AXIS, BEYOND)
DRIVEN, PAINTED = mark("drive"), mark("arrow or stop line")

DRIVE_ANGLE = np.radians(25.0)


@dataclass
class Strip:
    """A part of the section between two cross-sections and two neighbouring tracks.

    Attributes
    ----------
    right, left : numbers of the tracks (left of the axis' direction is `left`).
    start, end : chainages, m.
    width, narrowest : m.
    forward, backward : evidence for the direction, in metres driven (an arrow or a stop line counts as 10 m).
    driven : length of the drives in it along and against the axis, m.
    sign : 1 along the axis, -1 against it, 0 where unknown.
    source : what the direction comes from.
    stopped : a stop line at its end tells of its direction.
    parted : numbers of its tracks at which that stop line ends: beyond them traffic does not come towards it.
    contradicted : its own evidence contradicts itself.
    outside : a stop line ends, away from the middle of the road, at the solid line between it and the lanes: pavement.
    wide : it is wider than a lane may be between two lines.
    arrows : kinds of the arrows in it.
    """

    right: int
    left: int
    start: float
    end: float
    width: float
    narrowest: float
    forward: float = 0.0
    backward: float = 0.0
    driven: tuple[float, float] = (0.0, 0.0)
    sign: int = 0
    source: str = ""
    stopped: bool = False
    parted: set[int] = field(default_factory=set)
    contradicted: bool = False
    outside: bool = False
    wide: bool = False
    arrows: list[str] = field(default_factory=list)


def lane_strips(section: RoadSection, stops: Sequence[np.ndarray], settings: MapSettings) -> list[Strip]:
    """Strips of lane width of a section, cut at common cross-sections, from right to left and along the axis.

    Parameters
    ----------
    stops : stop lines (n, 3); where one lies near, lanes end at it.
    """
    tracks = section.tracks
    if len(tracks) < 2:
        return []
    start, end = min(track.start for track in tracks), max(track.end for track in tracks)
    at = np.arange(np.floor(start / STEP), np.ceil(end / STEP) + 1) * STEP
    offset = np.array([_given_offsets(track, at) for track in tracks])
    pairs = _adjacent(offset, tracks, settings)
    runs = [(pair, at[span[0]], at[span[1] - 1]) for pair, mask in pairs.items() for span in _spans(mask)
            if (span[1] - span[0]) * STEP >= settings.min_length]
    if not runs:
        return []
    cuts = _cuts(runs, section, stops, settings)
    strips = []
    for first, last in zip(cuts[:-1], cuts[1:]):
        for pair in sorted({pair for pair, *_ in runs}, key=lambda one: np.nanmean(offset[list(one)])):
            within = (at >= first) & (at <= last)
            covered = sum(max(0.0, min(last, b) - max(first, a)) for one, a, b in runs if one == pair)
            if covered < LIMITS.cover * (last - first):
                continue
            wide = (offset[pair[1]] - offset[pair[0]])[within]
            wide = wide[np.isfinite(wide)]
            strips.append(Strip(pair[0], pair[1], float(first), float(last), float(wide.mean()), float(wide.min()),
                                wide=float(wide.mean()) > settings.max_width))
    return strips


def _given_offsets(track: BoundTrack, at: np.ndarray) -> np.ndarray:
    """Offsets of a track at chainages (n,); NaN beyond its ends and where it is unseen between or beyond bounds of an
    earlier map, which were drawn as far as they go."""
    offset = track.interpolate(at)
    seen = [piece for piece in track.pieces if piece[2] is not None]
    for start, end, line in track.pieces:
        if line is None and end - start > STEP:
            before, behind = ([piece[2] for piece in seen if beyond(piece)] for beyond in (
                lambda piece, start=start: piece[1] <= start, lambda piece, end=end: piece[0] >= end))
            beside = [*before[-1:], *behind[:1]]
            if beside and all(one.identifier >= 0 for one in beside):
                offset[(at > start) & (at < end)] = np.nan
    return offset


def _adjacent(offset: np.ndarray, tracks: Sequence[BoundTrack],
              settings: MapSettings) -> dict[tuple[int, int], np.ndarray]:
    """For each pair (right, left) of neighbouring tracks at lane width, the mask of stations (n,) where they are so.

    A track with less paint between two others that leaves no lane on either side (an arrow, a scar) is passed over,
    and so is one that leaves a lane on one side only within what is no more than one lane.
    """
    length = np.array([track.painted for track in tracks])
    border = [all(line is None or line.kind == "road border" for *_, line in track.pieces) for track in tracks]
    found: dict[tuple[int, int], np.ndarray] = {}
    for station in range(offset.shape[1]):
        present = [int(k) for k in np.argsort(offset[:, station]) if np.isfinite(offset[k, station])]
        place = offset[:, station]
        while True:
            drop = [present[n] for n in range(1, len(present) - 1)
                    if _too_narrow(place[present[n - 1]], place[present[n]], place[present[n + 1]], settings)
                    and settings.min_width <= place[present[n + 1]] - place[present[n - 1]] <= settings.max_width
                    and length[present[n]] < 0.7 * min(length[present[n - 1]], length[present[n + 1]])]
            if not drop:
                break
            present.remove(min(drop, key=lambda k: length[k]))
        for right, left in zip(present[:-1], present[1:]):
            widest = settings.max_width
            if (right == present[0] and border[right]) or (left == present[-1] and border[left]):
                widest += WIDE
            if settings.min_width <= place[left] - place[right] <= widest:
                found.setdefault((right, left), np.zeros(offset.shape[1], bool))[station] = True
    return found


def _too_narrow(right: float, middle: float, left: float, settings: MapSettings) -> bool:
    """Whether a bound between two others leaves no lane on either side, or none on one within one lane's width."""
    narrow = (middle - right < settings.min_width, left - middle < settings.min_width)
    return all(narrow) or (any(narrow) and left - right <= LIMITS.one_lane)


def _spans(mask: np.ndarray) -> np.ndarray:
    """Begins and ends (n, 2) of the runs of a mask; holes of a metre are closed."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(np.int8), [0]]))).reshape(-1, 2)
    if not len(edges):
        return edges
    breaks = np.flatnonzero(edges[1:, 0] - edges[:-1, 1] > 1.0 / STEP)
    return np.column_stack([edges[np.append(0, breaks + 1), 0], edges[np.append(breaks, len(edges) - 1), 1]])


def _cuts(runs, section: RoadSection, stops: Sequence[np.ndarray], settings: MapSettings) -> np.ndarray:
    """Chainages of the section's cross-sections: ends of lanes, stop lines, changes between solid and dashed."""
    runs = _with_paint(runs, section) or runs
    begins, ends = (np.array(sorted(run[side] for run in runs)) for side in (1, 2))
    used = {k for pair, *_ in runs for k in pair}
    changes = [piece[0] for k in used for piece in _changes(section.tracks[k], settings)]
    low, high = begins[0], ends[-1]
    groups = [np.split(edges, np.flatnonzero(np.diff(edges) > SNAP) + 1) for edges in (begins, ends)]
    cuts = _without_near([float(np.median(group)) for side in groups for group in side], settings.min_length)
    cuts[0], cuts[-1] = _outer(runs, groups[0][0], 1), _outer(runs, groups[1][-1], 2)
    joints = _joints([section.tracks[k] for k in sorted(used)], section, settings.min_length)
    cuts = sorted([cut for cut in cuts if all(abs(cut - joint) >= settings.min_length for joint in joints)] + joints)
    for stop in _across_lanes(runs, section, stops):
        near = int(np.argmin(np.abs(np.array(cuts) - stop)))
        if abs(cuts[near] - stop) <= SNAP:
            cuts[near] = stop
        elif low < stop < high:
            cuts.append(stop)
    for change in sorted(changes):
        if all(abs(change - cut) > settings.min_length for cut in cuts) and low < change < high:
            cuts.append(change)
    # A short lane of the earlier map stays one where an edit makes it a little shorter.
    return _spaced(np.unique(cuts), settings.min_length / (2.0 if joints else 1.0))


def _across_lanes(runs, section: RoadSection, stops: Sequence[np.ndarray]) -> list[float]:
    """Chainages of the stop lines that lie before lanes with more than half of their length, those before most last: a
    vehicle's edge beside the lanes may look like one."""
    across = []
    for level, low, high in _whole_stops(section, stops):
        beside = {pair for pair, start, end in runs if start - SNAP < level < end + SNAP}
        before = [min(left, high) - max(right, low) for right, left in (
            [offset_of(section, track, level) for track in pair] for pair in beside)]
        covered = sum(share for share in before if share > 0)
        if covered > (high - low) / 2.0:
            across.append((covered, level))
    return [level for _, level in sorted(across)]


def _joints(tracks: Sequence[BoundTrack], section: RoadSection, least: float) -> list[float]:
    """Chainages at which bounds of an earlier map end, those nearer than half of `least` to the next as one."""
    places = [place for track in tracks for *_, line in track.pieces if line is not None for place in line.joints]
    if not places:
        return []
    at = np.sort(section.axis.chainage(np.array(places)))
    return [float(np.median(group)) for group in np.split(at, np.flatnonzero(np.diff(at) > least / 2.0) + 1)]


def _spaced(cuts: np.ndarray, least: float) -> np.ndarray:
    """Chainages in their order without those nearer than `least` to one before them or to the last: a road ends where
    it ends, not where something begins shortly before."""
    kept = [cuts[0]]
    kept += [cut for before, cut in zip(cuts[:-2], cuts[1:-1]) if cut - before >= least and cuts[-1] - cut >= least]
    return np.array([*kept, *cuts[-1:]] if cuts[-1] - cuts[0] >= least else kept)


def _with_paint(runs, section: RoadSection) -> list:
    """Those between bounds one of which at least is painted: strips between kerbs and walls are pavements."""
    painted = [any(line is not None and line.kind != "road border" for _, _, line in track.pieces)
               for track in section.tracks]
    return [run for run in runs if painted[run[0][0]] or painted[run[0][1]]]


def _without_near(cuts: Sequence[float], least_distance: float) -> list[float]:
    """Chainages in their order, those that lie nearer to each other than `least_distance` replaced by their mean.

    The first and the last stay two: a section has two ends.
    """
    remaining = sorted(cuts)
    while len(remaining) > 2 and np.diff(remaining).min() < least_distance:
        k = int(np.argmin(np.diff(remaining)))
        remaining[k:k + 2] = [(remaining[k] + remaining[k + 1]) / 2.0]
    return remaining


def _outer(runs, group: np.ndarray, side: int) -> float:
    """The section's own end: the median of the ends of the longer half of the lanes that end there."""
    ending = [run for run in runs if group[0] <= run[side] <= group[-1]]
    long = sorted(ending, key=lambda run: run[1] - run[2])[:max(1, (len(ending) + 1) // 2)]
    return float(np.median([run[side] for run in long]))


def _changes(track: BoundTrack, settings: MapSettings):
    """Pieces of a track before which its kind changes, both long enough to be lanes' lengths."""
    seen = [piece for piece in track.pieces if piece[2] is not None]
    for before, after in zip(seen[:-1], seen[1:]):
        if before[2].kind != after[2].kind and min(before[1] - before[0], after[1] - after[0]) > settings.min_length:
            yield after


def add_drives(strips: Sequence[Strip], section: RoadSection, drives: Sequence[DrivenPath],
               settings: MapSettings) -> None:
    """Count for each strip how far it is driven along and against the axis."""
    for drive in drives:
        xy = drive.places[:, :2]
        chainage, offset = section.axis.local(xy)
        _, along = section.axis.frame(chainage)
        step = np.gradient(xy, axis=0)
        length = np.linalg.norm(step, axis=1)
        cosine = np.where(length > 0, (step * along).sum(axis=1) / np.maximum(length, LEAST_DIVISOR), 0.0)
        for strip in strips:
            inside = (chainage >= strip.start) & (chainage <= strip.end) & (np.abs(cosine) > np.cos(DRIVE_ANGLE))
            right, left = section.tracks[strip.right], section.tracks[strip.left]
            inside &= (offset > right.interpolate(chainage)) & (offset < left.interpolate(chainage))
            inside &= ~(np.abs(drive.places[:, 2] - _height(right, chainage)) > settings.height_gap + 2.0)
            ways = [float(length[inside & (sign * cosine > 0)].sum()) for sign in (1, -1)]
            strip.forward, strip.backward = strip.forward + ways[0], strip.backward + ways[1]
            strip.driven = (strip.driven[0] + ways[0], strip.driven[1] + ways[1])


def _height(track: BoundTrack, chainage: np.ndarray) -> np.ndarray:
    return np.interp(chainage, track.chainage, track.points[:, 2])


def add_arrows(strips: Sequence[Strip], section: RoadSection, areas: Sequence[MapArea]) -> None:
    """Count the arrows in each strip for their direction."""
    for area in areas:
        middle = np.array(area.polygon.centroid.coords[0])[None, :2]
        chainage, offset = section.axis.local(middle)
        _, along = section.axis.frame(chainage)
        for strip in strips:
            right, left = (section.tracks[side].interpolate(chainage)[0] for side in (strip.right, strip.left))
            if strip.start <= chainage[0] <= strip.end and right < offset[0] < left:
                strip.arrows.append(area.kind)
                strip.forward += 10.0 * float(area.heading @ along[0] > 0.7)
                strip.backward += 10.0 * float(area.heading @ along[0] < -0.7)


def add_stops(strips: Sequence[Strip], section: RoadSection, stops: Sequence[np.ndarray],
              left_hand: bool | None) -> None:
    """Count stop lines at the strips' ends that do not go across the whole road: traffic comes towards them.

    Where the side of the traffic is known, it leads away in the strip across the solid line at which a stop line ends.
    """
    for level, low, high in _whole_stops(section, stops):
        ending = [strip for strip in strips if min(abs(strip.start - level),
                                                   abs(strip.end - level)) < LIMITS.stop_reach]
        middles = {id(strip): middle_offset(section, strip, level) for strip in ending}
        covered = [strip for strip in ending if _share_covered(section, strip, (level, low, high)) > LIMITS.half]
        others = [strip for strip in ending if not low - 0.5 < middles[id(strip)] < high + 0.5 and strip not in covered]
        covered = covered or [strip for strip in ending if low - 0.3 < middles[id(strip)] < high + 0.3]
        if not covered or not others:
            continue
        _mark_outside(section, covered, ending, (level, low, high), left_hand)
        for strip in covered:
            at_end = abs(strip.end - level) < abs(strip.start - level)
            strip.forward += 10.0 * at_end
            strip.backward += 10.0 * (not at_end)
            strip.stopped = True
            strip.parted |= {track for track, end in ((strip.right, low), (strip.left, high))
                             if abs(end - offset_of(section, track, level)) < LIMITS.at_line}
            if left_hand is not None:
                _count_away(_across_solid(section, strip, others, (low, high), at_end == left_hand), level)


def _count_away(strip: Strip | None, level: float) -> None:
    """Count for a strip, if there is one, that traffic leads away from its end at a chainage."""
    if strip is not None:
        at_end = abs(strip.end - level) < abs(strip.start - level)
        strip.forward += LIMITS.away * (not at_end)
        strip.backward += LIMITS.away * at_end
        strip.stopped = True


def _share_covered(section: RoadSection, strip: Strip, stop: tuple[float, float, float]) -> float:
    """Share of a strip's width before which a stop line (chainage, two offsets) lies."""
    level, low, high = stop
    at = float(np.clip(level, strip.start, strip.end))
    right, left = offset_of(section, strip.right, at), offset_of(section, strip.left, at)
    return (min(left, high) - max(right, low)) / max(left - right, LEAST_DIVISOR)


def _whole_stops(section: RoadSection, stops: Sequence[np.ndarray]) -> list[tuple[float, float, float]]:
    """Chainage and both ends' offsets of stop lines; pieces in one row, one for each lane, are one stop line."""
    local = [section.axis.local(stop[:, :2]) for stop in stops]
    pieces = sorted((float(offset.min()), float(offset.max()), float(chainage.mean())) for chainage, offset in local)
    whole: list[tuple[float, float, float]] = []
    for low, high, level in pieces:
        for number, (at, right, left) in enumerate(whole):
            apart, gap = abs(at - level), low - left
            if (apart < LIMITS.one_row and gap < LIMITS.one_row) or (apart < LIMITS.straight and gap < LIMITS.hidden):
                whole[number] = (at, right, max(left, high))
                break
        else:
            whole.append((level, low, high))
    return [one for one in whole if not any(_is_within(one, other) for other in whole)]


def _is_within(stop: tuple[float, float, float], other: tuple[float, float, float]) -> bool:
    """Whether a stop line (chainage, two offsets) lies right before or behind one twice as long: a vehicle's bonnet."""
    return (other[2] - other[1] > 2.0 * (stop[2] - stop[1]) and abs(stop[0] - other[0]) < SNAP
            and other[1] - LIMITS.at_line < stop[1] and stop[2] < other[2] + LIMITS.at_line)


def _mark_outside(section: RoadSection, covered: Sequence[Strip], ending: Sequence[Strip],
                  stop: tuple[float, float, float], left_hand: bool | None) -> None:
    """Mark the strip outside of those that a stop line (chainage, two offsets) covers, across a solid line."""
    if left_hand is None or len({strip.right for strip in covered}) < 2:
        return
    level, low, high = stop
    for strip in covered:
        to_left = (abs(strip.end - level) < abs(strip.start - level)) == left_hand
        shared = strip.left if to_left else strip.right
        for other in ending:
            beyond = middle_offset(section, other, level)
            if (other.right if to_left else other.left) == shared and (beyond > high if to_left else beyond < low) \
                    and set(line_kinds(section.tracks[shared], other.start, other.end)) == {"solid"}:
                other.outside = True


def _across_solid(section: RoadSection, strip: Strip, others: Sequence[Strip], reach: tuple[float, float],
                  to_right: bool) -> Strip | None:
    """The strip to the right or left of one, across a solid line at which a stop line (two offsets) ends.

    Across a dashed one too where the road has no other strips: it is the line in the middle.
    """
    track = section.tracks[strip.right if to_right else strip.left]
    beside = [one for one in others if one.start == strip.start
              and (one.left == strip.right if to_right else one.right == strip.left)]
    kinds = line_kinds(track, strip.start, strip.end)
    at = np.interp((strip.start + strip.end) / 2.0, track.chainage, track.offset)
    beyond = (at - reach[0]) if to_right else (reach[1] - at)
    ends = -strip.width < beyond < LIMITS.at_line
    row = [one for one in others if one.start == strip.start]
    parts = set(kinds) == {"solid"} or len(row) == 1
    return beside[0] if beside and ends and parts else None


def offset_of(section: RoadSection, track: int, chainage: float) -> float:
    """Offset of a track at a chainage, held beyond its ends, m."""
    return float(np.interp(chainage, section.tracks[track].chainage, section.tracks[track].offset))


def middle_offset(section: RoadSection, strip: Strip, chainage: float) -> float:
    """Offset of a strip's middle at a chainage, held beyond its ends."""
    at = np.clip(chainage, strip.start, strip.end)
    return float(np.mean([np.interp(at, section.tracks[k].chainage, section.tracks[k].offset)
                          for k in (strip.right, strip.left)]))


def line_kinds(track: BoundTrack, start: float, end: float) -> dict[str, float]:
    """Length of each kind of line along a stretch of a track, m; of the nearest line where none is seen there."""
    found: dict[str, float] = {}
    for first, last, line in track.pieces:
        overlap = min(end, last) - max(start, first)
        if overlap > 0 and line is not None:
            found[line.kind] = found.get(line.kind, 0.0) + overlap
    return found or {track.nearest_line((start + end) / 2.0).kind: 0.0}


def colour_of(track: BoundTrack) -> str:
    """The colour of most of a track."""
    found: dict[str, float] = {}
    for first, last, line in track.pieces:
        if line is not None:
            found[line.colour] = found.get(line.colour, 0.0) + last - first
    return max(found, key=found.get) if found else ""


def strip_middle(section: RoadSection, strip: Strip) -> tuple[float, float]:
    """Plan place of the middle of a strip."""
    at = (strip.start + strip.end) / 2.0
    place = (section.tracks[strip.right].point(at) + section.tracks[strip.left].point(at)) / 2.0
    return float(place[0]), float(place[1])
