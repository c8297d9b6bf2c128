"""Candidates that continue each other, as courses of stations: along straights and round the corners of junctions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.spatial import cKDTree

from ...geometry.tolerances import LEAST_DIVISOR, SAME_PLACE
from .edge_records import Course, EdgeCandidates

STATION = 0.5
"""m between stations."""

LONGEST_MISS = 1.5  # m of way without candidates after which a course ends.
LONGEST_GAP = 12.0  # m between the ends of two courses that are looked at as one edge with a gap.
# m about a station in which candidates support it
ALONG = 0.45
ACROSS = 0.25
WIDER = 0.1  # m across for each m without candidates
TAKEN = 0.45  # m beside a course in which no other one starts
BACK = 4  # stations that tell the direction
FEWEST = 4  # stations
STRAY = 0.3  # m
BEYOND = 2  # stations beyond the ends of courses that are looked at

_TURN = np.cos(np.radians(50.0))  # candidates know their normal to an eighth of a turn
_BEND, _BESIDE, _BESIDE_SHARE = np.cos(np.radians(20.0)), 0.3, 0.04  # of courses that a gap parts
_SHORT, _CURVE, _CURVE_SHARE = 3.5, np.cos(np.radians(60.0)), 0.5  # m; the same where the gap is short


class _Walk:
    """Follows candidates from a place in one direction."""

    def __init__(self, candidates: EdgeCandidates, tree: cKDTree, used: np.ndarray):
        self.candidates, self.tree, self.used = candidates, tree, used

    def support(self, place: np.ndarray, normal: np.ndarray, across: float) -> tuple[np.ndarray, np.ndarray]:
        """Candidates that lie about a station, and how far across (m) towards the normal each does."""
        rows = np.array(self.tree.query_ball_point(place, 0.7), int)
        if not len(rows):
            return rows, np.zeros(0)
        offset = self.candidates.place[rows] - place
        beside = offset @ normal
        ahead = np.abs(offset @ np.array([-normal[1], normal[0]]))
        good = (ahead <= ALONG) & (np.abs(beside) <= across) & (self.candidates.normal[rows] @ normal >= _TURN)
        return rows[good], beside[good]

    def follow(self, start: np.ndarray, normal: np.ndarray, side: int) -> list[tuple[np.ndarray, bool]]:
        """Stations after the first (place, seen), with the higher side left (1) or right (-1) of the way."""
        way = side * np.array([normal[1], -normal[0]])
        stations, seen, missed = [], [start], 0.0
        place = start
        while missed <= LONGEST_MISS:
            place = place + STATION * way
            normal = side * np.array([-way[1], way[0]])
            rows, beside = self.support(place, normal, ACROSS + WIDER * missed)
            rows, beside = rows[~self.used[rows]], beside[~self.used[rows]]
            if len(rows):
                place = place + normal * np.average(beside, weights=self.candidates.score[rows])
                missed = 0.0
                seen.append(place)
                base = place - seen[max(-BACK - 1, -len(seen))]
                if len(seen) >= 3:
                    way = base / np.hypot(*base)
            else:
                missed += STATION
            stations.append((place, bool(len(rows))))
        while stations and (not stations[-1][1] or _turns_off(stations)):
            stations.pop()
        return stations


def _turns_off(stations: list[tuple[np.ndarray, bool]]) -> bool:
    """Whether the last station lies beside the line of those before it: a stray candidate where the edge ends."""
    places = np.array([place for place, _ in stations[-BACK - 1:]])
    if len(places) <= BACK:
        return False
    way = places[-2] - places[0]
    off = places[-1] - places[-2]
    return abs(way[0] * off[1] - way[1] * off[0]) > STRAY * np.hypot(*way)


def find_courses(candidates: EdgeCandidates) -> list[Course]:
    """Courses along candidates, the best supported ones first; candidates that nothing continues are left out."""
    if not len(candidates):
        return []
    order = np.lexsort((candidates.place[:, 1], candidates.place[:, 0], -candidates.score))
    used = np.zeros(len(candidates), bool)
    walk = _Walk(candidates, cKDTree(candidates.place), used)
    found = []
    for row in order.tolist():
        if used[row]:
            continue
        start, normal = _start(walk, row)
        back, ahead = walk.follow(start, normal, -1), walk.follow(start, normal, 1)
        stations = [*back[::-1], (start, True), *ahead]
        used[row] = True
        if sum(seen for _, seen in stations) < FEWEST:
            continue
        course = _course(stations, normal, len(back))
        for place, across in zip(course.place, course.normal):
            rows, _ = walk.support(place, across, TAKEN)
            used[rows] = True
        found.append(course)
    return found


def _start(walk: _Walk, row: int) -> tuple[np.ndarray, np.ndarray]:
    """Place and normal of a first station: of the line through the candidates about it."""
    candidates = walk.candidates
    place, normal = candidates.place[row], candidates.normal[row]
    near = np.array(walk.tree.query_ball_point(place, 1.5), int)
    near = near[(candidates.normal[near] @ normal >= _TURN) & ~walk.used[near]]
    weight = candidates.score[near]
    middle = np.average(candidates.place[near], axis=0, weights=weight)
    offset = candidates.place[near] - middle
    value, vector = np.linalg.eigh((offset * weight[:, None]).T @ offset)
    if len(near) < 3 or value[1] < 4.0 * value[0]:
        return place, normal
    across = vector[:, 0] * np.sign(vector[:, 0] @ normal)
    if across @ normal < _TURN:
        return place, normal
    return place + across * ((middle - place) @ across), across


def _course(stations: list[tuple[np.ndarray, bool]], normal: np.ndarray, first: int) -> Course:
    """Stations in their order, with normals from the way between neighbours."""
    place = np.array([place for place, _ in stations])
    seen = np.array([seen for _, seen in stations])
    way = np.gradient(_smoothed(place), axis=0)
    across = np.column_stack([-way[:, 1], way[:, 0]])
    across /= np.maximum(np.hypot(*across.T), LEAST_DIVISOR)[:, None]
    return Course(place, across * (1.0 if across[first] @ normal >= 0 else -1.0), seen)


def _smoothed(place: np.ndarray) -> np.ndarray:
    """Places averaged with their neighbours; the ends stay."""
    if len(place) < 3:
        return place
    middle = 0.25 * place[:-2] + 0.5 * place[1:-1] + 0.25 * place[2:]
    return np.concatenate([place[:1], middle, place[-1:]])


def linked(courses: list[Course]) -> list[Course]:
    """Courses that continue each other over a gap, as one; stations across the gap are not `seen`."""
    parts = dict(enumerate(courses))
    for _, a, a_end, b, b_end in sorted(_links(courses)):
        first, second = _owner(parts, courses, a, a_end), _owner(parts, courses, b, b_end)
        if first is None or second is None or first[0] == second[0]:
            continue
        one = parts[first[0]] if first[1] else _turned(parts[first[0]])
        other = _turned(parts[second[0]]) if second[1] else parts[second[0]]
        parts[first[0]] = _bridged(one, other)
        del parts[second[0]]
    return list(parts.values())


def _owner(parts: dict[int, Course], courses: list[Course], number: int, at_end: bool) -> tuple[int, bool] | None:
    """Part whose open end (True: its last station) is that end of a course; None where it is joined already."""
    place = courses[number].place[-1 if at_end else 0]
    for name, part in parts.items():
        for end in (False, True):
            if np.array_equal(part.place[-1 if end else 0], place):
                return name, end
    return None


def _links(courses: list[Course]) -> Iterator[tuple[float, int, bool, int, bool]]:
    """Pairs of ends that may be one edge: (gap, course, at its end, other course, at its end)."""
    ends = [(number, end) for number in range(len(courses)) for end in (False, True)]
    place = np.array([courses[number].place[-1 if end else 0] for number, end in ends])
    if len(place) < 2:
        return
    for i, j in sorted(cKDTree(place).query_pairs(LONGEST_GAP)):
        (a, a_end), (b, b_end) = ends[i], ends[j]
        if a == b:
            continue
        gap = place[j] - place[i]
        length = float(np.hypot(*gap))
        out, into = _outward(courses[a], a_end), -_outward(courses[b], b_end)
        normals = _end_normal(courses[a], a_end) @ _end_normal(courses[b], b_end)
        bend, share = (_CURVE, _CURVE_SHARE) if length <= _SHORT else (_BEND, _BESIDE_SHARE)
        if length < SAME_PLACE or out @ into < bend or normals < bend or gap @ out < -STATION:
            continue
        beside = max(abs(gap[0] * way[1] - gap[1] * way[0]) for way in (out, into))
        if beside <= _BESIDE + share * length:
            yield length, a, a_end, b, b_end


def _outward(course: Course, at_end: bool) -> np.ndarray:
    """Direction (2,) in which a course leaves through its end."""
    place = course.place if at_end else course.place[::-1]
    way = place[-1] - place[max(-1 - BACK, -len(place))]
    return way / np.hypot(*way)


def _end_normal(course: Course, at_end: bool) -> np.ndarray:
    return course.normal[-1 if at_end else 0]


def _turned(course: Course) -> Course:
    return Course(course.place[::-1], course.normal[::-1], course.seen[::-1])


def _bridged(one: Course, other: Course) -> Course:
    """Two courses and stations between them, on the curve that leaves both in their directions."""
    gap = other.place[0] - one.place[-1]
    length = float(np.hypot(*gap))
    number = max(round(length / STATION) - 1, 0)
    share = (np.arange(number)[:, None] + 1.0) / (number + 1.0)
    leaving, arriving = length * _outward(one, True), -length * _outward(other, False)
    bend = share * (1 - share) * ((1 - share) * (leaving - gap) - share * (arriving - gap))
    normal = (1 - share) * one.normal[-1] + share * other.normal[0]
    normal /= np.maximum(np.hypot(*normal.T), LEAST_DIVISOR)[:, None]
    return Course(np.concatenate([one.place, one.place[-1] + share * gap + bend, other.place]),
                  np.concatenate([one.normal, normal, other.normal]),
                  np.concatenate([one.seen, np.zeros(number, bool), other.seen]))


def lengthened(course: Course) -> Course:
    """The course with some more stations straight ahead at both ends, not `seen`."""
    steps = STATION * np.arange(1, BEYOND + 1)[:, None]
    before = course.place[0] + steps[::-1] * _outward(course, False)
    after = course.place[-1] + steps * _outward(course, True)
    return Course(np.concatenate([before, course.place, after]),
                  np.pad(course.normal, ((BEYOND, BEYOND), (0, 0)), mode="edge"),
                  np.pad(course.seen, BEYOND))
