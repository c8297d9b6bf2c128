"""Where roads meet, and where each of their arms is cut.

Source: Project PLATEAU, standard working procedure of 3D city models, annex D, D.3.1.2.1 (junctions of three, four and
more arms, with and without corner cut-offs; junctions that overlap are one), and the standard product specification,
4.3.2 (tran:lod1MultiSurface: at cut-offs far apart along the road, across the road at the farther one).
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field

import numpy as np
import shapely

from ..geometry.tolerances import ROUNDING
from .road_axis import Branch, Ring, Skeleton

# What contacts and cuts go by.
CORNER = 35.0  # least turn from one arm's edge to the next arm's edge at which their edges touch, degrees.
FAINT = 12.0  # least turn at which an arm is cut that has no corner otherwise, degrees.
TURN = 18.0  # an edge that leaves the direction of the road's other edge by more is one of a cut-off, degrees.
BEND = 8.0  # least turn at the end of a cut-off, degrees.
CUT_OFF = 1.5  # longest edge of a cut-off, in widths of the wider arm.
# a cut from contact to contact leaves the road's cross direction by less, degrees; else it runs across the road from
# the farther contact.
SKEW = 50.0
OVERLAP = 0.1  # cuts of neighbouring junctions nearer to each other overlap, in widths of the road.
REACH = 0.8  # farthest place of a corner from the foot of the node on the boundary, in distances of that foot.


@dataclass(frozen=True, eq=False)
class Arm:
    """A road that leaves a junction: its branch seen from the junction, and the branch's number and end (0, 1)."""

    branch: Branch
    number: int
    end: int

    @property
    def key(self) -> tuple[int, int]:
        """What it is known by."""
        return self.number, self.end


@dataclass(frozen=True, eq=False)
class Cut:
    """A line across an arm.

    Attributes
    ----------
    left, right : points (2,) on the boundary as seen from the junction, m.
    place : where it crosses the arm's middle line, m from the junction's node.
    arm : number of the branch and the end at which the junction stands.
    kind : "contacts" from contact to contact, "across" from one contact.
    """

    left: np.ndarray
    right: np.ndarray
    place: float
    arm: tuple[int, int]
    kind: str


@dataclass(eq=False)
class Junction:
    """Nodes that are one meeting of roads, with their places (n, 2), its arms, and the cuts of those that have one."""

    nodes: frozenset[int]
    point: np.ndarray
    places: np.ndarray
    arms: list[Arm]
    cuts: list[Cut] = field(default_factory=list)
    uncut: list[Arm] = field(default_factory=list)


def junctions_of(skeleton: Skeleton) -> list[Junction]:
    """The junctions of a surface with their cuts; those that overlap are one."""
    groups = _near_nodes(skeleton)
    known: dict[frozenset[int], Junction] = {}
    while True:
        known = {key: known.get(key) or _junction(skeleton, key) for key in map(frozenset, groups)}
        merged = _overlapping(skeleton, list(known.values()))
        if not merged:
            return list(known.values())
        groups = _joined(groups, merged)


def _near_nodes(skeleton: Skeleton) -> list[set[int]]:
    """Nodes at which three or more lines meet; those within the widest circle of another are one."""
    groups = [{node} for node, branches in skeleton.nodes.items() if len(branches) > 2]
    near = [(branch.start, branch.end) for branch in skeleton.branches
            if branch.start != branch.end and len(skeleton.nodes[branch.start]) > 2
            and len(skeleton.nodes[branch.end]) > 2
            and branch.length < max(branch.clearance[0], branch.clearance[-1])]
    return _joined(groups, near)


def _joined(groups: list[set[int]], pairs: list[tuple[int, int]]) -> list[set[int]]:
    of_node = {node: group for group in groups for node in group}
    for one, other in pairs:
        if of_node[one] is not of_node[other]:
            of_node[one] |= of_node[other]
            for node in of_node[other]:
                of_node[node] = of_node[one]
    return list({id(group): group for group in of_node.values()}.values())


def _junction(skeleton: Skeleton, nodes: frozenset[int]) -> Junction:
    """One junction with the cuts of its arms."""
    arms, corners = [], []
    for node in nodes:
        for number in dict.fromkeys(skeleton.nodes[node]):
            branch = skeleton.branches[number]
            if branch.start in nodes and branch.end in nodes and not _leaves(branch):
                continue
            if branch.start == node:
                arms.append(Arm(branch, number, 0))
            if branch.end == node:
                arms.append(Arm(branch.turned(), number, 1))
    for arm in arms:
        corners.append(arm.branch.points[0])
    result = Junction(nodes, np.mean(corners, axis=0), np.unique(corners, axis=0), arms)
    contacts = _contacts(skeleton.rings, arms, CORNER)
    if (None, None) in contacts.values():  # every arm is cut: where no corner is clear, a faint one is
        faint = _contacts(skeleton.rings, arms, FAINT)
        contacts = {key: faint[key] if found == (None, None) else found for key, found in contacts.items()}
    for arm in arms:
        cut = _cut(skeleton.rings, arm, *contacts[arm.key], len(arms))
        if cut is None:
            result.uncut.append(arm)
        else:
            result.cuts.append(cut)
    return result


def _leaves(branch: Branch) -> bool:
    """Whether a line between two nodes of one junction is a road of its own that leads back to it."""
    away = np.hypot(*(branch.points - branch.points[0]).T).max()
    return away > 3 * max(branch.clearance[0], branch.clearance[-1])


Contact = tuple[int, float]
"""Ring and place along it, m."""


def _contacts(rings: tuple[Ring, ...], arms: list[Arm], least: float
              ) -> dict[tuple[int, int], tuple[Contact | None, Contact | None]]:
    """Where the edges of each arm touch those of its neighbours: on its left and on its right, None for nowhere."""
    left: dict[tuple[int, int], Contact | None] = {}
    right: dict[tuple[int, int], Contact | None] = {}
    starts = defaultdict(list)
    for arm in arms:
        starts[int(arm.branch.right[0, 0])].append((float(arm.branch.right[0, 1]), arm))
    for arm in arms:
        ring = int(arm.branch.left[0, 0])
        place = float(arm.branch.left[0, 1])
        length = rings[ring].length
        following = min(starts[ring], key=lambda item: (item[0] - place + 1e-6) % length, default=None)
        if following is None:
            continue
        gap = (following[0] - place + 1e-6) % length - 1e-6
        one, other = _corner(rings, ring, arm, following[1], place, place + gap, least)
        left[arm.key] = None if one is None else (ring, one)
        right[following[1].key] = None if other is None else (ring, other)
    return {arm.key: (left.get(arm.key), right.get(arm.key)) for arm in arms}


def _corner(rings: tuple[Ring, ...], number: int, arm: Arm, following: Arm, start: float, end: float,
            least: float) -> tuple[float | None, float | None]:
    """Places of the contacts of an arm's left edge and of the next arm's right edge; None where the corner is none.

    start, end : places along the ring between which the corner's middle lies.
    """
    ring = rings[number]
    before, after = _width(arm), _width(following)
    reach = REACH * max(arm.branch.clearance[0], following.branch.clearance[0])
    points = _points_around(ring, start - reach - 4 * before, end + reach + 4 * after)
    near = [item for item in points if start - reach <= item[0] <= end + reach]
    core = min(near, key=lambda item: item[1], default=(0.0, 0.0))
    if core[1] >= 0:
        return None, None
    longest = CUT_OFF * max(before, after)
    last = _flare_end(ring, [item for item in points if item[0] >= core[0]], _edge(rings, following.branch.left),
                      longest)
    first = _flare_end(ring, [item for item in reversed(points) if item[0] <= core[0]],
                       _edge(rings, arm.branch.right), longest)
    chain = [turn for place, turn in points if first - ROUNDING <= place <= last + ROUNDING]
    if sum(chain) > -np.radians(least):
        return None, None
    return first, last


def _flare_end(ring: Ring, points: list[tuple[float, float]], opposite: shapely.LineString, longest: float) -> float:
    """Place of the point from which on an edge runs beside the opposite one.

    points : places and turns, from the corner outwards; longest : edge that is still one of a cut-off, m.
    """
    places = [points[0][0], *(place for place, turn in points[1:] if abs(turn) > np.radians(1.0))]
    widths = shapely.distance(shapely.points(np.array([ring.points_at(place) for place in places])), opposite)
    turns = [0.0, *(turn for _, turn in points[1:] if abs(turn) > np.radians(1.0))]
    found = 0
    for number in range(1, len(places)):
        edge = abs(places[number] - places[number - 1])
        taper = (widths[number - 1] - widths[number]) / edge
        if taper < np.sin(np.radians(TURN)) or edge > longest:
            break
        if turns[number] < -np.radians(BEND):
            found = number
    return places[found]


def _width(arm: Arm) -> float:
    """Width of an arm where it has left the junction, m."""
    branch = arm.branch
    away = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(branch.points, axis=0).T))])
    first = 2 * branch.clearance[0]
    outside = (away > first) & (away < 3 * first)
    return 2 * float(np.median(branch.clearance[outside] if outside.any() else branch.clearance[len(away) // 2:]))


def _points_around(ring: Ring, start: float, end: float) -> list[tuple[float, float]]:
    """Place and turn of the ring's points between two places, which may run over its ends."""
    found = []
    for lap in range(int(np.floor(start / ring.length)), int(np.floor(end / ring.length)) + 1):
        places = ring.places[:-1] + lap * ring.length
        found += [(float(places[number]), float(ring.turns[number]))
                  for number in np.flatnonzero((places >= start) & (places <= end))]
    return found


def _cut(rings: tuple[Ring, ...], arm: Arm, left: Contact | None, right: Contact | None, arms: int) -> Cut | None:
    """The cut of an arm by its contacts; None where it has none."""
    if left is None and right is None:
        return None
    one = None if left is None else rings[left[0]].points_at(left[1])
    other = None if right is None else rings[right[0]].points_at(right[1])
    if one is not None and other is not None:
        direct = _placed(arm, one, other, "contacts")
        if direct is not None and arms > 3 and _skew(arm, direct) < SKEW:
            return direct
        found = [cut for cut in (_across(rings, arm, one, None), _across(rings, arm, None, other)) if cut is not None]
        return max(found, key=lambda cut: cut.place, default=direct)
    return _across(rings, arm, one, other)


def _across(rings: tuple[Ring, ...], arm: Arm, left: np.ndarray | None, right: np.ndarray | None) -> Cut | None:
    """The shortest line from a contact on one side to the arm's other edge."""
    opposite = _edge(rings, arm.branch.right if right is None else arm.branch.left)
    contact = left if right is None else right
    foot = shapely.get_coordinates(shapely.shortest_line(opposite, shapely.points(contact)))[0]
    ends = (contact, foot) if right is None else (foot, contact)
    return _placed(arm, *ends, "across")


def _edge(rings: tuple[Ring, ...], side: np.ndarray) -> shapely.LineString:
    """The boundary along one side of a branch."""
    points = np.empty((len(side), 2))
    for number in np.unique(side[:, 0]).astype(int):
        on_ring = side[:, 0] == number
        points[on_ring] = rings[number].points_at(side[on_ring, 1])
    return shapely.linestrings(points if len(points) > 1 else np.repeat(points, 2, axis=0))


def _placed(arm: Arm, left: np.ndarray, right: np.ndarray, kind: str) -> Cut | None:
    """A cut where it crosses the middle line, or beside its end; None where it is none."""
    if np.hypot(*(left - right)) == 0:
        return None
    line = shapely.linestrings(arm.branch.points)
    cross = shapely.intersection(line, shapely.linestrings([left, right]))
    point = shapely.points((left + right) / 2) if cross.is_empty else shapely.centroid(cross)
    return Cut(left, right, float(shapely.line_locate_point(line, point)), arm.key, kind)


def _skew(arm: Arm, cut: Cut) -> float:
    """By how much a cut leaves the cross direction of its arm, degrees."""
    line = shapely.linestrings(arm.branch.points)
    width = 2 * float(np.median(arm.branch.clearance))
    chord = shapely.get_coordinates(shapely.line_interpolate_point(line, [cut.place, cut.place + width]))
    along, across = chord[1] - chord[0], cut.left - cut.right
    if not along.any():
        return 0.0
    sine = abs(along @ across) / (np.hypot(*along) * np.hypot(*across))
    return float(np.degrees(np.arcsin(min(sine, 1.0))))


def _overlapping(skeleton: Skeleton, found: list[Junction]) -> list[tuple[int, int]]:
    """Pairs of nodes of junctions whose cuts of the road between them pass each other."""
    cuts = {cut.arm: (cut, junction) for junction in found for cut in junction.cuts}
    pairs = []
    for number, branch in enumerate(skeleton.branches):
        one, other = cuts.get((number, 0)), cuts.get((number, 1))
        if one is None or other is None or one[1] is other[1]:
            continue
        lines = [shapely.linestrings([cut.left, cut.right]) for cut, _ in (one, other)]
        near = OVERLAP * min(line.length for line in lines)
        if one[0].place + other[0].place >= branch.length or shapely.distance(*lines) <= near:
            pairs.append((branch.start, branch.end))
    return pairs
