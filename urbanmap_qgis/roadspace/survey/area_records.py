"""What a road model from a survey is made of: measured edges, areas of the road, steps between them.

Source: Project PLATEAU, standard product specification of 3D city models 5.0, 4.3.1.3 and 4.3.1.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import shapely

from ...errors import InputError
from ...wording import mark, say
from ..road_records import RoadFinding, RoadPiece

CARRIAGEWAY, CROSSING, LANE, SIDEWALK, ISLAND, UNDIVIDED = (
    mark("carriageway"), mark("junction"), mark("lane"), mark("sidewalk"), mark("island"), mark("road, not surveyed"))
KINDS = (CARRIAGEWAY, CROSSING, LANE, SIDEWALK, ISLAND, UNDIVIDED)

FUNCTIONS = {CARRIAGEWAY: "1000", LANE: "1010", CROSSING: "1020", SIDEWALK: "2000", ISLAND: "3000"}
"""Codes of `TrafficArea_function`; that of islands of `AuxiliaryTrafficArea_function`."""

MEASURED, DOUBTFUL, CONTINUED, OFFICIAL = mark("measured"), mark("doubtful"), mark("continued"), mark("official")
"""Where a border comes from: a survey, the survey's doubtful edges, drawn on where nothing was seen, or given edges of
roads."""

HIGHEST, LARGEST_NUMBER, LONGEST = 1e5, 1e12, 1e3
"""Height, m, that no edge of a road has (as of points of a cloud), what no number of its fields can be, and how far
apart, m, no two places lie that follow each other along an edge, whose stations are half a metre apart."""

TALLEST = 10.0
"""m, a step that no kerb is: platforms of trams and trucks stay below 1.5 m, and walls are no kerbs."""

LEVELS = ("2", "3.0", "3.1", "3.2", "3.3")
WITH_LANES = LEVELS[2:]
"""Levels that divide carriageways into lanes and cut junctions at stop lines."""

HARDLY_SEEN = 0.1
"""A model with a smaller share of its borders measured is none of a survey: snow, or a scanner that saw little."""

STEPS = {"3.2": 0.15, "3.3": 0.02}
"""Least step in height that is a face of its own, m, by level; levels without one have one height across."""


DIGITS = 6
"""Of coordinates, by which corners are the same."""


def corner_of(point: Sequence[float]) -> tuple[float, float]:
    """What a corner is known by."""
    return round(float(point[0]), DIGITS), round(float(point[1]), DIGITS)


@dataclass(frozen=True, eq=False)
class EdgeLine:
    """A measured edge of a carriageway.

    Attributes
    ----------
    foot, top : (n, 3) m; `top` is `foot` raised by `height` where it was not given.
    height : of the step, m; 0 of a border without one.
    sigma, sigma_z : m.
    chain : number that the parts of one edge share.
    gap : m to the next part of its chain; 0 where there is none.
    doubt : why the survey calls it doubtful; empty where it does not.
    """

    foot: np.ndarray
    top: np.ndarray
    height: float
    sigma: float
    sigma_z: float
    chain: int
    gap: float
    doubt: str = ""

    @property
    def plan(self) -> np.ndarray:
        """(n, 2) the middle of its face, m."""
        return (self.foot[:, :2] + self.top[:, :2]) / 2.0


@dataclass(frozen=True, eq=False)
class TrafficSurface:
    """A part of a road with one use.

    Attributes
    ----------
    polygon : in plan, m, outer ring counterclockwise; shares its corners with those beside it to the bit.
    kind : one of `KINDS`.
    road : number of the section or junction that it belongs to.
    source : `MEASURED`, `DOUBTFUL`, `CONTINUED` or `OFFICIAL`, the weakest of what more than a tenth of its border is.
    seen : share of its border that was measured without doubt.
    width : of a strip with the same area and border, m.
    heights : z (n,) of the polygon's corners by place, m; empty where there are none.
    sigma : of its border, m; NaN where nothing was measured.
    """

    polygon: shapely.Polygon
    kind: str
    road: int
    source: str
    seen: float
    width: float
    heights: dict[tuple[float, float], float]
    sigma: float

    def rings(self) -> list[np.ndarray]:
        """Its rings (n, 3) with the heights of their corners, closed, the outer one first, m."""
        return [np.array([(*corner, self.heights[corner_of(corner)]) for corner in
                          shapely.get_coordinates(ring).tolist()])
                for ring in (self.polygon.exterior, *self.polygon.interiors)]

    @property
    def raised(self) -> shapely.Polygon:
        """The polygon with the heights of its corners."""
        outer, *inner = self.rings()
        return shapely.Polygon(outer, inner)


@dataclass(frozen=True, eq=False)
class StepFace:
    """The face of a step: ring (n, 3), m, of the area that it belongs to, and its mean height, m."""

    ring: np.ndarray
    area: int
    height: float

    @property
    def upper(self) -> np.ndarray:
        """The line (2, 3) along its upper edge, m."""
        ends: dict[tuple[float, float], list[float]] = {}
        for point in self.ring.tolist():
            place = (point[0], point[1])
            if place not in ends or point[2] > ends[place][2]:
                ends[place] = point
        return np.array(list(ends.values()))

    @property
    def length(self) -> float:
        """In plan, m."""
        return float(np.hypot(*(self.upper[1] - self.upper[0])[:2]))


@dataclass(frozen=True, eq=False)
class SurveyedRoads:
    """Sections and junctions, their areas and steps, and what is to be looked at.

    Attributes
    ----------
    level : one of `LEVELS`.
    pieces : sections and junctions as surfaces of LOD1.
    areas, steps, findings : see there.
    """

    level: str
    pieces: tuple[RoadPiece, ...]
    areas: tuple[TrafficSurface, ...]
    steps: tuple[StepFace, ...]
    findings: tuple[RoadFinding, ...]

    def count(self, kind: str) -> int:
        """Number of areas of a kind."""
        return sum(area.kind == kind for area in self.areas)

    @property
    def seen(self) -> float:
        """Share of the borders of all surveyed areas but lanes that was measured without doubt, by length."""
        some = [area for area in self.areas if area.kind not in (LANE, UNDIVIDED)]
        lengths = np.array([area.polygon.length for area in some])
        return float(np.average([area.seen for area in some], weights=lengths)) if some else 0.0


def kerb_edge_lines(feet, tops, columns) -> list[EdgeLine]:
    """Kerbs, lowered kerbs and borders of a table of road edges.

    Parameters
    ----------
    feet : lines with heights along the foot, one a row; None for none.
    tops : likewise along the top by the edge's number (`edge_id`); empty where not given.
    columns : lists by field: kind, height, sigma, sigma_z, chain, gap, edge_id, status, reason; what is missing is not
        known.

    Raises
    ------
    InputError : a value is no number, or a height is none that an edge can have.
    """
    value = partial(_figure, columns)
    lines = []
    for row, shape in enumerate(feet):
        kind = str(columns["kind"][row]) if "kind" in columns else "kerb"
        if shape is None or kind not in ("kerb", "lowered kerb", "road border"):
            continue
        for part in shapely.get_parts(shape):
            foot = shapely.get_coordinates(part, include_z=True)
            if part.geom_type != "LineString" or len(foot) < 2 or part.length == 0:
                continue
            _require_places(row, foot)
            height = max(value("height", row, 0.0, TALLEST), 0.0) if kind != "road border" else 0.0
            other = tops.get(int(value("edge_id", row, -1)))
            top = None if other is None else shapely.get_coordinates(other, include_z=True)
            if top is None or len(top) != len(foot):
                top = foot + np.array([0.0, 0.0, height])
            top[:, 2] = np.where(np.isnan(top[:, 2]), foot[:, 2] + height, top[:, 2])
            _require_places(row, top)
            lines.append(EdgeLine(foot, top, height, value("sigma", row, np.nan), value("sigma_z", row, np.nan),
                                  int(value("chain", row, -1 - row)), value("gap", row, 0.0), _doubt(columns, row)))
    return lines


def _doubt(columns, row: int) -> str:
    """Why an edge is doubtful; empty where its status is another one or none."""
    status, reason = (columns[name][row] if name in columns else None for name in ("status", "reason"))
    return str(reason or DOUBTFUL) if status == DOUBTFUL else ""


def tops_by_number(columns, shapes) -> dict[int, shapely.Geometry]:
    """Upper edges by the number of their edge (`edge_id`); those without number or shape are left out.

    Raises
    ------
    InputError : a number is none.
    """
    numbers = (_figure(columns, "edge_id", row, -1) for row in range(len(shapes)))
    return {int(number): shape for number, shape in zip(numbers, shapes) if shape is not None and number >= 0}


def _figure(columns, name: str, row: int, otherwise: float, largest: float = LARGEST_NUMBER) -> float:
    """A number of a row, none beyond `largest`; `otherwise` where the field or its value is missing."""
    cell = columns[name][row] if name in columns else None
    if cell is None:
        return otherwise
    try:
        number = float(cell)
    except (TypeError, ValueError):
        number = np.inf
    if np.isnan(number):
        return otherwise
    if abs(number) > largest:
        raise InputError(say("Edge {row}: “{cell}” in the field {name} is no number that can be meant; repair the "
                             "layer of edges.", row=row + 1, cell=cell, name=name))
    return number


def _require_places(row: int, places: np.ndarray) -> None:
    """Refuse coordinates and heights that no place on the earth has; unknown heights (NaN) are let pass."""
    far = _off_the_map(places)
    if far.any():
        raise InputError(say("Edge {row} lies at x = {x:g}, y = {y:g}, where no map reaches; repair the layer of "
                             "edges.", row=row + 1, x=places[far][0, 0], y=places[far][0, 1]))
    longest = float(np.hypot(*np.diff(places[:, :2], axis=0).T).max())
    if longest > LONGEST:
        raise InputError(say("Edge {row}: two of its corners that follow each other lie {distance:.1f} km apart, which "
                             "no edge of a road does; repair the layer of edges.", row=row + 1,
                             distance=longest / 1000.0))
    if (np.abs(places[:, 2]) > HIGHEST).any():
        raise InputError(say("Edge {row} lies at a height of {height:g} m, where no road is; repair the layer of "
                             "edges.", row=row + 1, height=places[np.nanargmax(np.abs(places[:, 2])), 2]))


def _off_the_map(places: np.ndarray) -> np.ndarray:
    """Mask (n,) of places (n, 2 or more) whose x or y is no number, or one that no map has."""
    return ~(np.abs(places[:, :2]) <= LARGEST_NUMBER).all(axis=1)


def layer_parts(layer: str, shapes: Sequence[shapely.Geometry | None], kind: str) -> list[shapely.Geometry]:
    """Parts in plan, of a kind ("Polygon", "LineString"), of the shapes of a layer; polygons repaired.

    Raises
    ------
    InputError : a shape lies where no map reaches; the sentence names the layer and the row.
    """
    parts = []
    for row, shape in enumerate(shapes):
        if shape is None:
            continue
        if _off_the_map(shapely.get_coordinates(shape)).any():
            raise InputError(say("{layer}: shape {row} has a corner where no map reaches; repair the layer.",
                                 layer=layer, row=row + 1))
        # What touches itself at a line falls into parts of several kinds.
        valid = shapely.make_valid(shapely.force_2d(shape)) if kind == "Polygon" else shapely.force_2d(shape)
        parts += [part for one in shapely.get_parts(valid) for part in shapely.get_parts(one)
                  if part.geom_type == kind and not part.is_empty and part.length > 0]
    return parts
