"""Road sections: lines side by side, as offsets from one axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely

from ...geometry.linked_groups import linked_members
from ...geometry.tolerances import LEAST_DIVISOR
from ...settings.roadmap import MapSettings
from ..map_records import MapLine
from .street_corners import cut_at_corners
from .winding_roads import unwound_roads

STEP = 0.5
"""Distance of the stations of a section's axis, m."""

PARALLEL = np.radians(15.0)
LEAST_BESIDE, LEAST_BESIDE_SHORT = 4.0, 3.0
"""Lines run beside each other over so many metres at least; the second where one is shorter than twice the first."""

SAME = 0.15
"""Lines beside each other no farther apart are one bound of which each shows a part, m: double lines are farther.
It is their RMS; single places may be twice as far: points of lines drawn by hand scatter."""

WIDE = 1.0
"""An outermost lane may be wider by so much between its line and the edge of the road, m."""

JOIN = 0.35
"""Ends of lines so near to each other's prolongation are one bound, m."""


@dataclass
class BoundTrack:
    """One bound of a section: lines in a row, by chainage along the axis.

    Attributes
    ----------
    points : (n, 3) in the axis' direction.
    chainage, offset : (n,) of the points along the axis and to its left, m.
    pieces : (start, end, line or None) by chainage; None where nothing was seen and the bound is drawn through.
    double : it is the middle of a double line.
    """

    points: np.ndarray
    chainage: np.ndarray
    offset: np.ndarray
    pieces: list[tuple[float, float, MapLine | None]]
    double: bool = False

    @property
    def start(self) -> float:
        return float(self.chainage[0])

    @property
    def end(self) -> float:
        return float(self.chainage[-1])

    @property
    def seen(self) -> float:
        """Length of its lines, m."""
        return sum(end - start for start, end, line in self.pieces if line is not None)

    @property
    def painted(self) -> float:
        """Length of its lines less what their paint lacks, m."""
        return sum((end - start) * line.confidence for start, end, line in self.pieces if line is not None)

    def interpolate(self, chainage: np.ndarray) -> np.ndarray:
        """Offsets at chainages (m,); NaN beyond the ends."""
        return np.interp(chainage, self.chainage, self.offset, left=np.nan, right=np.nan)

    def nearest_line(self, chainage: float) -> MapLine:
        """The line whose seen piece is nearest to a chainage."""
        seen = [piece for piece in self.pieces if piece[2] is not None]
        return min(seen, key=lambda piece: max(piece[0] - chainage, chainage - piece[1], 0.0))[2]

    def point(self, chainage: float) -> np.ndarray:
        """Place (3,) at a chainage; straight on beyond the ends."""
        if self.start <= chainage <= self.end:
            return np.array([np.interp(chainage, self.chainage, column) for column in self.points.T])
        tip, inner = (0, min(8, len(self.points) - 1)) if chainage < self.start else (-1, -min(9, len(self.points)))
        slope = (self.points[tip] - self.points[inner]) / (self.chainage[tip] - self.chainage[inner])
        return self.points[tip] + slope * (chainage - self.chainage[tip])


@dataclass
class Axis:
    """A path with chainage, straight on beyond its ends."""

    points: np.ndarray
    line: shapely.LineString = field(init=False)

    def __post_init__(self):
        first, last = self.points[0] - self.points[1], self.points[-1] - self.points[-2]
        far = 300.0
        self._before = far
        before = self.points[0] + first / np.linalg.norm(first) * far
        after = self.points[-1] + last / np.linalg.norm(last) * far
        self.line = shapely.LineString(np.vstack([before, self.points, after]))

    def chainage(self, xy: np.ndarray) -> np.ndarray:
        """Chainage (n,) of places (n, 2)."""
        return shapely.line_locate_point(self.line, shapely.points(xy)) - self._before

    def local(self, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Chainage and offset to the left (n,) of places (n, 2)."""
        chainage = self.chainage(xy)
        foot, along = self.frame(chainage)
        offset = xy - foot
        return chainage, along[:, 0] * offset[:, 1] - along[:, 1] * offset[:, 0]

    def frame(self, chainage: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places (n, 2) and unit directions (n, 2) at chainages."""
        at = np.asarray(chainage, float) + self._before
        foot = shapely.get_coordinates(shapely.line_interpolate_point(self.line, at))
        ahead = shapely.get_coordinates(shapely.line_interpolate_point(self.line, at + 0.5))
        behind = shapely.get_coordinates(shapely.line_interpolate_point(self.line, np.maximum(at - 0.5, 0.0)))
        chord = ahead - behind
        return foot, chord / np.maximum(np.linalg.norm(chord, axis=1, keepdims=True), LEAST_DIVISOR)


@dataclass
class RoadSection:
    """Lines side by side between junctions: an axis and the bounds along it."""

    axis: Axis
    tracks: list[BoundTrack]


def is_pavement(section: RoadSection, right: int, left: int) -> bool:
    """Whether what lies between two tracks is the pavement: outermost, within a solid white line and an outer one that
    is not white, as guiding strips and rows of paving are."""
    middle = max(section.tracks[right].start, section.tracks[left].start) / 2.0 + \
        min(section.tracks[right].end, section.tracks[left].end) / 2.0
    offset = np.array([np.interp(middle, track.chainage, track.offset) for track in section.tracks])
    covers = np.array([track.start <= middle <= track.end for track in section.tracks])
    for outer, inner, sign in ((right, left, -1.0), (left, right, 1.0)):
        beyond = covers & (sign * (offset - offset[outer]) > SAME)
        seen = [(end - start, line) for start, end, line in section.tracks[outer].pieces if line is not None]
        white = sum(length for length, line in seen if line.colour == "white" or line.kind == "road border")
        edge = {(line.kind, line.colour) for *_, line in section.tracks[inner].pieces if line is not None}
        if not beyond.any() and white < 0.5 * sum(length for length, _ in seen) and edge == {("solid", "white")}:
            return True
    return False


def road_sections(lines: Sequence[MapLine], barriers: Sequence[shapely.Geometry],
                  settings: MapSettings) -> list[RoadSection]:
    """Sections of lines that run side by side.

    Parameters
    ----------
    lines : solid, dashed and border lines.
    barriers : crosswalks; no bound is drawn through one.
    """
    chains = _chains(cut_at_corners(lines))
    if not chains:
        return []
    paths = [np.vstack([line.points for line in chain]) for chain in chains]
    groups = _beside(paths, [chain[0].kind == "road border" for chain in chains], settings)
    sections = []
    for group in groups:
        longest = max(group, key=lambda k: shapely.LineString(paths[k][:, :2]).length)
        for points, members in unwound_roads(paths[longest][:, :2], [chains[k] for k in group]):
            axis = Axis(_coarse(points))
            tracks = [track for track in (_track(chain, axis) for chain in members) if track is not None]
            if tracks:
                sections.append(RoadSection(axis, _without_doubles(_joined(_united(tracks), barriers, settings))))
    return sections


def _coarse(points: np.ndarray) -> np.ndarray:
    """The path without repeated points and bends of centimetres."""
    return shapely.get_coordinates(shapely.LineString(points).simplify(0.05))


def _chains(lines: Sequence[MapLine]) -> list[list[MapLine]]:
    """Lines of one chain in their order along it."""
    by_chain: dict[int, list[MapLine]] = {}
    for number, line in enumerate(lines):
        by_chain.setdefault(line.chain if line.chain >= 0 else -1 - number - len(lines), []).append(line)
    ordered = []
    for members in by_chain.values():
        far = max(members, key=lambda line: shapely.LineString(line.points[:, :2]).length).points
        along = far[-1, :2] - far[0, :2]
        ordered.append(sorted(members, key=lambda line: float(line.points[:, :2].mean(axis=0) @ along)))
    return ordered


def _beside(paths: Sequence[np.ndarray], borders: Sequence[bool], settings: MapSettings) -> list[list[int]]:
    """Groups of paths that run side by side within a lane's width, at one height."""
    plans = [shapely.LineString(path[:, :2]) for path in paths]
    tree = shapely.STRtree(plans)
    links = []
    for k, plan in enumerate(plans):
        at = np.arange(0.5, plan.length, 1.0)
        if not len(at):
            continue
        places = shapely.line_interpolate_point(plan, at)
        for other in tree.query(plan, predicate="dwithin", distance=settings.max_width + WIDE + 0.5):
            if other == k:
                continue
            reach = settings.max_width + 0.5 + (WIDE if borders[k] or borders[other] else 0.0)
            distance = shapely.distance(places, plans[other])
            foot = shapely.line_locate_point(plans[other], places)
            inner = (foot > 0.01) & (foot < plans[other].length - 0.01)
            least = max(LEAST_BESIDE_SHORT, min(LEAST_BESIDE, min(plan.length, plans[other].length) // 2.0))
            if (inner & (distance <= reach)).sum() < least:
                continue
            near = np.flatnonzero(inner & (distance <= reach))
            turn = _turn(plan, plans[other], at[near], foot[near])
            if (turn < PARALLEL).sum() >= least and _level(paths[k], paths[other], settings):
                links.append((k, int(other)))
    return [group.tolist() for group in linked_members(*np.array(links, np.int64).reshape(-1, 2).T, len(paths))]


def _turn(plan: shapely.LineString, other: shapely.LineString, at: np.ndarray, foot: np.ndarray) -> np.ndarray:
    """Angles (n,) between two lines at given chainages, 0 to 90°."""
    directions = []
    for line, where in ((plan, at), (other, foot)):
        ends = [shapely.get_coordinates(shapely.line_interpolate_point(line, np.clip(where + step, 0, line.length)))
                for step in (-0.5, 0.5)]
        chord = ends[1] - ends[0]
        directions.append(chord / np.maximum(np.linalg.norm(chord, axis=1, keepdims=True), LEAST_DIVISOR))
    return np.arcsin(np.clip(np.abs(directions[0][:, 0] * directions[1][:, 1]
                                    - directions[0][:, 1] * directions[1][:, 0]), 0.0, 1.0))


def _level(one: np.ndarray, other: np.ndarray, settings: MapSettings) -> bool:
    """Whether two paths lie at one height where they are nearest; unknown heights do not part them."""
    line, target = shapely.LineString(one[:, :2]), shapely.LineString(other[:, :2])
    near = shapely.shortest_line(line, target)
    ends = shapely.get_coordinates(near)
    heights = [path[np.argmin(np.linalg.norm(path[:, :2] - end, axis=1)), 2] for path, end in zip((one, other), ends)]
    return not abs(heights[0] - heights[1]) > settings.height_gap


def _track(chain: Sequence[MapLine], axis: Axis) -> BoundTrack | None:
    """A chain as a bound, in the axis' direction."""
    points, pieces = [], []
    ends = axis.chainage(np.array([chain[0].points[0, :2], chain[-1].points[-1, :2]]))
    members = list(chain) if ends[0] <= ends[1] else list(chain)[::-1]
    for line in members:
        first, last = axis.chainage(line.points[[0, -1], :2])
        ordered = line.points if first <= last else line.points[::-1]
        points.append(_dense(ordered))
        pieces.append((min(first, last), max(first, last), line))
    stacked = np.vstack(points)
    chainage, offset = axis.local(stacked[:, :2])
    ahead = np.concatenate([[True], chainage[1:] > np.maximum.accumulate(chainage)[:-1] + 1e-4])
    if ahead.sum() < 2:
        return None
    return BoundTrack(stacked[ahead], chainage[ahead], offset[ahead], pieces, any(line.double for line in chain))


def _dense(points: np.ndarray) -> np.ndarray:
    """The points of a path with others between, at most 1 m apart, heights linear."""
    steps = np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    where = np.unique(np.concatenate([at, np.arange(0.0, at[-1], 1.0)]))
    return np.column_stack([np.interp(where, at, column) for column in points.T])


def _united(tracks: list[BoundTrack]) -> list[BoundTrack]:
    """Tracks that run within `SAME` of each other made one: the longer one, and what the other has beyond its ends."""
    united: list[BoundTrack] = []
    for track in sorted(tracks, key=lambda one: one.start - one.end):
        for number, longer in enumerate(united):
            at = np.arange(max(track.start, longer.start), min(track.end, longer.end), STEP)
            apart = np.abs(track.interpolate(at) - longer.interpolate(at))
            if len(at) * STEP >= LEAST_BESIDE and np.mean(apart ** 2) <= SAME ** 2 and apart.max() <= 2.0 * SAME:
                united[number] = _with_ends(longer, track)
                break
        else:
            united.append(track)
    return united


def _with_ends(track: BoundTrack, other: BoundTrack) -> BoundTrack:
    """A track with what another one in its course has before its begin and behind its end."""
    before, after = other.chainage < track.start - 1e-4, other.chainage > track.end + 1e-4
    parts = [(other, before), (track, np.ones(len(track.chainage), bool)), (other, after)]
    pieces = [(start, min(end, track.start), line) for start, end, line in other.pieces if start < track.start]
    pieces += track.pieces
    pieces += [(max(start, track.end), end, line) for start, end, line in other.pieces if end > track.end]
    return BoundTrack(np.vstack([one.points[rows] for one, rows in parts]),
                      np.concatenate([one.chainage[rows] for one, rows in parts]),
                      np.concatenate([one.offset[rows] for one, rows in parts]), pieces, track.double or other.double)


def _joined(tracks: list[BoundTrack], barriers: Sequence[shapely.Geometry], settings: MapSettings) -> list[BoundTrack]:
    """Tracks that continue each other joined; where nothing was seen between them, a piece without a line."""
    tracks = sorted(tracks, key=lambda track: track.start)
    tree = shapely.STRtree(list(barriers)) if len(barriers) else None
    while True:
        best = None
        for k, one in enumerate(tracks):
            for m, other in enumerate(tracks):
                gap = other.start - one.end
                if k == m or not -0.5 <= gap <= settings.bridge:
                    continue
                across = _lateral(one, other)
                if across > JOIN + 0.01 * max(gap, 0.0) or (best and gap >= best[0]):
                    continue
                link = shapely.LineString([one.points[-1, :2], other.points[0, :2]])
                if tree is None or not len(tree.query(link, predicate="intersects")):
                    best = (gap, k, m)
        if best is None:
            return tracks
        _, k, m = best
        joined = _concatenated(tracks[k], tracks[m])
        tracks = [track for n, track in enumerate(tracks) if n not in (k, m)] + [joined]


def _lateral(one: BoundTrack, other: BoundTrack) -> float:
    """Distance across between the prolongations of two tracks in the middle of the gap between them, m.

    Straight on, or at the same distance to the road's axis: what is nearer, for short tracks end in no sure direction.
    """
    middle = (one.end + other.start) / 2.0
    straight = float(np.linalg.norm((one.point(middle) - other.point(middle))[:2]))
    return min(straight, abs(float(one.offset[-1] - other.offset[0])))


def _concatenated(one: BoundTrack, other: BoundTrack) -> BoundTrack:
    keep = other.chainage > one.end + 1e-4
    unseen = [(one.end, other.start, None)] if other.start - one.end > 0.5 else []
    return BoundTrack(np.vstack([one.points, other.points[keep]]), np.concatenate([one.chainage, other.chainage[keep]]),
                 np.concatenate([one.offset, other.offset[keep]]), [*one.pieces, *unseen, *other.pieces],
                 one.double or other.double)


def _without_doubles(tracks: list[BoundTrack]) -> list[BoundTrack]:
    """One track for the two lines of a double line: the longer one, marked."""
    doubled: set[int] = set()
    for k, track in enumerate(tracks):
        partners = {line.partner for *_, line in track.pieces if line is not None and line.partner >= 0}
        for m, other in enumerate(tracks):
            chains = {line.chain for *_, line in other.pieces if line is not None}
            if m != k and partners & chains and m not in doubled and k not in doubled:
                shorter, longer = sorted((k, m), key=lambda n: tracks[n].end - tracks[n].start)
                doubled.add(shorter)
                tracks[longer].double = True
    return [track for k, track in enumerate(tracks) if k not in doubled]
