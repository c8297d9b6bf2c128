"""What a lane map consists of: nodes, bounds, lanes, crosswalks, stop lines, and findings with a place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely

from ..errors import InputError
from ..geometry.tolerances import OFF_THE_EARTH
from ..wording import say

LONGEST_SIDE = 100_000.0
"""No line of a road runs straight on for longer, m; lines are followed metre by metre."""

TURNS = ("straight", "left", "right")
"""Ways on through a junction, as Lanelet2 names them."""


@dataclass(frozen=True)
class MapLine:
    """A line of the line work as the map takes it.

    Attributes
    ----------
    points : (n, 3) m, heights NaN where unknown.
    kind : "solid", "dashed", "stop line", "guiding strip" or "road border".
    colour : "white", "yellow" or "".
    width, sigma : m.
    chain : number of the continuous line.
    partner : of the other line of a double line, or -1.
    identifier : of the bound that it was in an earlier map, or -1.
    confidence : share of the paint that should be there and is seen, 0 to 1.
    sigmas : at the points (n,), m; empty where only `sigma` is known.
    double : it is the middle of a double line.
    joints : places (x, y) at which bounds of the earlier map begin and end in it.
    """

    points: np.ndarray
    kind: str
    colour: str = ""
    width: float = 0.15
    sigma: float = np.nan
    chain: int = -1
    partner: int = -1
    identifier: int = -1
    confidence: float = 1.0
    sigmas: tuple[float, ...] = ()
    double: bool = False
    joints: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class MapArea:
    """A crosswalk or an arrow: outline, kind and the direction (2,) in which it is read or crossed."""

    polygon: shapely.Geometry
    kind: str
    heading: np.ndarray


@dataclass(frozen=True)
class DrivenPath:
    """The path of a survey: places (n, 3) in m, in the order in which they were driven."""

    places: np.ndarray


@dataclass(frozen=True)
class Finding:
    """Something that the user must look at: what kind, a sentence, and where (x, y)."""

    kind: str
    text: str
    x: float
    y: float


@dataclass
class Bound:
    """One side of lanes.

    Attributes
    ----------
    nodes : numbers of its nodes, in the direction of the road section's axis.
    kind : "solid", "dashed", "road border" or "virtual".
    colour, width, sigma : of the line.
    double : the line is a double one.
    unseen : length without evidence, m.
    sigmas : standard deviations at the nodes, m, growing with the distance to a line; empty where unknown.
    """

    nodes: list[int]
    kind: str
    colour: str = ""
    width: float = np.nan
    sigma: float = np.nan
    double: bool = False
    unseen: float = 0.0
    sigmas: list[float] = field(default_factory=list)


@dataclass
class MapLane:
    """A lane between two bounds.

    Attributes
    ----------
    left, right : numbers of the bounds; their direction is the lane's where `left_forward`, `right_forward`.
    centre : (n, 3) centre line in the direction of traffic.
    width : mean.
    narrowest : minimum, m.
    kind : "lane", or "virtual" through a junction.
    evidence : what its direction comes from.
    turn : "straight", "left" or "right" of a virtual lane.
    arrows : kinds of the arrows in it.
    successors, left_neighbour, right_neighbour : numbers of lanes, -1 where there is none; neighbours have the same
        direction, `opposite` is the neighbour across the line that has the other one.
    speed_limit : km/h, NaN where unknown.
    yields_to : why it waits, by the number of each virtual lane that has the way before it.
    confidence : that a virtual lane is a movement that is allowed, 0 to 1; NaN for other lanes.
    """

    left: int
    right: int
    left_forward: bool
    right_forward: bool
    centre: np.ndarray
    width: float
    narrowest: float
    kind: str
    evidence: str
    turn: str = ""
    arrows: tuple[str, ...] = ()
    successors: list[int] = field(default_factory=list)
    left_neighbour: int = -1
    right_neighbour: int = -1
    opposite: int = -1
    stop_lines: list[int] = field(default_factory=list)
    crosswalks: list[int] = field(default_factory=list)
    speed_limit: float = np.nan
    yields_to: dict[int, str] = field(default_factory=dict)
    confidence: float = np.nan


@dataclass(frozen=True)
class Intersection:
    """Ways through a junction.

    Attributes
    ----------
    ring : numbers of the nodes about it, in their order.
    lanes : numbers of the virtual lanes within.
    yields : lanes that wait, by the lane that has the right of way.
    """

    ring: list[int]
    lanes: list[int]
    yields: dict[int, list[int]]


@dataclass
class VectorMap:
    """A lane map.

    Attributes
    ----------
    nodes : list of (x, y, z).
    bounds, lanes : see there.
    stop_lines : (n, 3) arrays.
    crosswalks : polygons with the direction of the traffic that crosses them.
    findings : what to look at.
    left_hand : traffic keeps to the left; None where nothing tells.
    height_sigmas : sigma (m) of each node whose height was taken from along the road, by its number.
    intersections : ways through junctions that lie together, with their area.
    crosswalk_rings : outlines (n, 3) of the crosswalks with heights; empty where the crosswalks hold them.
    objects, rails : what stands beside the lanes: `RoadsideObject`s, and lines (n, 4) of rails' feet and heights, m.
    """

    nodes: list[np.ndarray] = field(default_factory=list)
    bounds: list[Bound] = field(default_factory=list)
    lanes: list[MapLane] = field(default_factory=list)
    stop_lines: list[np.ndarray] = field(default_factory=list)
    crosswalks: list[MapArea] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    left_hand: bool | None = None
    height_sigmas: dict[int, float] = field(default_factory=dict)
    intersections: list[Intersection] = field(default_factory=list)
    crosswalk_rings: list[np.ndarray] = field(default_factory=list)
    objects: list = field(default_factory=list)
    rails: list[np.ndarray] = field(default_factory=list)

    def crosswalk_ring(self, number: int) -> np.ndarray:
        """Outline (n, 3) of a crosswalk, closed; heights NaN where unknown."""
        if self.crosswalk_rings:
            return self.crosswalk_rings[number]
        return shapely.get_coordinates(self.crosswalks[number].polygon.exterior, include_z=True)

    def coordinates(self, lane: int, side: str) -> np.ndarray:
        """Points (n, 3) of a lane's "left" or "right" bound in its direction."""
        one = self.lanes[lane]
        number, forward = (one.left, one.left_forward) if side == "left" else (one.right, one.right_forward)
        nodes = self.bounds[number].nodes
        return np.array([self.nodes[n] for n in (nodes if forward else nodes[::-1])])

    def bound_points(self, bound: Bound) -> np.ndarray:
        """Points (n, 3) of a bound."""
        return np.array([self.nodes[n] for n in bound.nodes])

    def has_heights(self) -> bool:
        """Whether every node has a height."""
        return bool(len(self.nodes)) and bool(np.isfinite(np.array(self.nodes)[:, 2]).all())

    def driven_length(self) -> float:
        """Length of the lanes' centre lines without the virtual ones, m."""
        return float(sum(shapely.LineString(lane.centre[:, :2]).length for lane in self.lanes if lane.kind == "lane"))

    def area(self, lane: int) -> shapely.Polygon:
        """The lane's area in plan."""
        ring = np.vstack([self.coordinates(lane, "left"), self.coordinates(lane, "right")[::-1]])[:, :2]
        return shapely.Polygon(ring)


def lines_of(geometries: Sequence[shapely.Geometry | None], columns: Mapping[str, Sequence],
             kind_field: str | None = "class") -> list[MapLine]:
    """Lines of a table: parts of one feature apart, missing fields unknown.

    Parameters
    ----------
    kind_field : field with the kind; None makes every line a road border.

    Raises
    ------
    InputError : a line has a corner whose place is no number or off the earth, or so far off that no road leads there
        straight.
    """
    def value(name: str, row: int, otherwise):
        cell = columns[name][row] if name in columns else None
        return otherwise if cell is None else cell

    lines = []
    for row, shape in enumerate(geometries):
        for part in shapely.get_parts(shape) if shape is not None else ():
            points = shapely.get_coordinates(part, include_z=True)
            if part.geom_type != "LineString" or len(points) < 2 or part.length == 0:
                continue
            if not (np.abs(points[:, :2]) < OFF_THE_EARTH).all():
                raise InputError(say("Line {row} of the layer has a corner whose east or north is no number or off the "
                                     "earth: mend the corner or delete the line.", row=row + 1))
            side = float(np.hypot(*np.diff(points[:, :2], axis=0).T).max())
            if side > LONGEST_SIDE:
                raise InputError(say("Line {row} of the layer has a straight side of {side:.0f} km, longer than any "
                                     "road's: mend its corners or delete the line.", row=row + 1, side=side / 1000.0))
            kind = "road border" if kind_field is None else str(columns[kind_field][row])
            chain = int(value("chain", row, -1)) if kind_field is not None else -1
            lines.append(MapLine(points, kind, str(value("colour", row, "")), float(value("width", row, 0.15)),
                                 float(value("sigma", row, np.nan)), chain, int(value("partner", row, -1)),
                                 _bound_id(value("bound_id", row, -1)) if kind_field is not None else -1,
                                 float(value("confidence", row, 1.0)),
                                 _numbers(value("sigmas", row, ""), len(points)),
                                 kind_field is not None and value("double", row, False) in (True, 1)))
    return lines


def _numbers(cell: object, count: int) -> tuple[float, ...]:
    """Numbers with commas between them; none where there are not as many as points, after an edit by hand."""
    try:
        numbers = tuple(float(word) for word in str(cell).split(",") if word.strip())
    except ValueError:
        return ()
    return numbers if len(numbers) == count and all(0.0 <= number < np.inf for number in numbers) else ()


def _bound_id(cell: object) -> int:
    """An id as “Lane map” gives it; -1 for what others keep in a field of that name."""
    return int(cell) if isinstance(cell, (int, np.integer)) and not isinstance(cell, bool) else -1


def areas_of(geometries: Sequence[shapely.Geometry | None], columns: Mapping[str, Sequence]) -> list[MapArea]:
    """Crosswalks and arrows of a table with the fields class and heading (degrees from grid north)."""
    areas = []
    for row, shape in enumerate(geometries):
        heading = columns["heading"][row]
        if shape is None or heading is None or not np.isfinite(heading):
            continue
        parts = shapely.get_parts(shape)
        angle = np.radians(heading)
        area = parts[0] if len(parts) == 1 else shape
        areas.append(MapArea(area, str(columns["class"][row]), np.array([np.sin(angle), np.cos(angle)])))
    return areas
