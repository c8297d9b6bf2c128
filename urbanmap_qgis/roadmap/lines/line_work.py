"""Line work of a road's paint: lines with their kind, stop lines, crosswalks, symbols (J 6.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...geometry.tolerances import LEAST_DIVISOR
from ...progress import SILENT, Progress
from ...settings.roadmap import LineSettings
from .crosswalks import Crosswalk, find_crosswalks
from .dash_consensus import with_common_patterns
from .dash_pattern import Section, line_sections, painted_intervals, with_worn_ends
from .line_chains import StrokeChain, link_strokes
from .line_fit import STATION, FittedLine, fit_centre_line, polyline
from .line_width import line_widths
from .short_lines import supported_chains
from .stop_lines import LIMITS as STOPS
from .stop_lines import joined_bars, stop_line_confidence
from .strokes import Stroke, all_strokes
from .symbols import find_symbols
from .worn_stop_lines import worn_stop_lines

DOUBLE = (0.22, 0.65)
"""Distance of the two lines of a double line, m."""

ROAD_HALF, PLACES = 10.0, 19
"""Two of the widest lanes, m, within which a road has lines beside its middle; places of a line that are looked at."""


@dataclass(frozen=True)
class RoadLine:
    """One line of one kind.

    Attributes
    ----------
    points : (n, 3) centre line, m; heights NaN where unknown.
    kind : "solid", "dashed", "stop line" or "guiding strip".
    width, width_sigma : of the paint and its standard deviation, m; NaN where it cannot be told to 3 cm.
    colour : "white", "yellow" or "".
    sigma : of its place across it, m (mean along the line).
    dashes : begins and ends (n, 2) of the painted stretches, m along it.
    period, dash : lengths of dash and gap together and of the dash, m; NaN unless dashed.
    bridged : length without paint that wear or vehicles left in a solid line, or where dashes are missing, m.
    chain : number of the continuous line that this is a section of.
    partner : number of the chain that makes it a double line, -1 where it is single.
    confidence : 0 to 1: of a line the share of the paint that should be there and is seen; of a stop line that share,
        less where only lines' ends or only a crosswalk show that it is one.
    placed : ends among `dashes` that are worn and lie where the whole dashes beside them ask for them, m along it.
    sigmas : of its place across it at the points (n,), m, growing with the distance to the paint.
    """

    points: np.ndarray
    kind: str
    width: float
    colour: str
    sigma: float
    dashes: np.ndarray
    period: float
    dash: float
    bridged: float
    chain: int
    partner: int = -1
    confidence: float = 1.0
    placed: tuple[float, ...] = ()
    sigmas: tuple[float, ...] = ()
    width_sigma: float = np.nan

    @property
    def plan(self) -> shapely.LineString:
        return shapely.LineString(self.points[:, :2])


@dataclass(frozen=True)
class RoadArea:
    """A crosswalk, a symbol or paint that is none of what is known.

    Attributes
    ----------
    polygon : its outline.
    kind : "crosswalk", a symbol's kind, or "unknown".
    heading : direction (2,) in which it is read or crossed by traffic, NaN where unknown.
    score : how well paint and pattern agree, 0 to 1; NaN where not judged.
    colour : as the polygons'.
    """

    polygon: shapely.Geometry
    kind: str
    heading: np.ndarray
    score: float
    colour: str

    @property
    def multipolygon(self) -> shapely.MultiPolygon:
        """The outline as a multipolygon, with heights where it has them."""
        return shapely.multipolygons([part for part in shapely.get_parts(self.polygon) if part.geom_type == "Polygon"])


def grid_heading(direction: np.ndarray) -> float:
    """Degrees clockwise from grid north of a direction (2,) in the plane; NaN stays."""
    return float(np.degrees(np.arctan2(direction[0], direction[1])) % 360.0)


@dataclass(frozen=True)
class LineWork:
    """All that was made of the markings."""

    lines: tuple[RoadLine, ...]
    areas: tuple[RoadArea, ...]
    polygons: int = 0
    notes: tuple[str, ...] = field(default=())

    def share_without_heights(self) -> float:
        """Share of the lines' vertices whose height is not known; 0 where there are no lines."""
        heights = np.concatenate([np.zeros(0), *(line.points[:, 2] for line in self.lines)])
        return float(np.isnan(heights).mean()) if len(heights) else 0.0


@dataclass(frozen=True)
class _Line:
    """A chain that was fitted, with its sections."""

    chain: StrokeChain
    fit: FittedLine
    sections: list[Section]


def line_work(polygons: Sequence[shapely.Polygon], colours: Sequence[str], settings: LineSettings | None = None,
              progress: Progress = SILENT, drives: Sequence[np.ndarray] = ()) -> LineWork:
    """Lines, crosswalks and symbols of marking polygons.

    Parameters
    ----------
    polygons : outlines of the markings, in metres.
    colours : "white", "yellow" or "" for each.
    drives : marking points (n, 2) of each drive, m: they tell how wide lines are.

    Returns
    -------
    Line work with heights NaN. Paint that is no line, crosswalk or symbol stays as area of kind "unknown".
    """
    settings = settings or LineSettings()
    strokes = all_strokes(polygons)
    progress.step(0.4)
    crosswalks = find_crosswalks(strokes, polygons)
    in_rows = _in_crosswalks(strokes, crosswalks)
    bare = {stroke.polygon for stroke in strokes if stroke.whole and len(stroke.axis) == 2 and stroke.length >= 2.0}
    # Arrows and diamonds are white; yellow are lines and paving for the blind.
    yellow = {n for n, colour in enumerate(colours) if colour == "yellow"}
    symbols = find_symbols(polygons, strokes, yellow | {strokes[n].polygon for n in in_rows}, bare, crosswalks)
    of_symbols = {number for symbol in symbols for number in symbol.polygons}
    numbers = [n for n, stroke in enumerate(strokes) if n not in in_rows and stroke.polygon not in of_symbols and
               stroke.width <= settings.max_width and stroke.length >= 0.25]
    chains = link_strokes(strokes, numbers, [row.area for row in crosswalks])
    progress.step(0.6)
    paint = shapely.STRtree(polygons)
    bars = joined_bars([chain for chain in chains if chain.width >= settings.stop_width and
                        0.6 <= chain.length <= 16.0],
                       [chain for chain in chains if chain.width < settings.stop_width and
                        0.25 <= chain.length <= 4.0])
    long = [chain for chain in chains if _is_line(chain, strokes, settings) and not
            (chain.width >= settings.stop_width and chain.length <= 8.0)]
    lines = [line for line in (_fitted(chain, paint) for chain in long) if line is not None]
    progress.step(0.8)
    stops, sure = _stop_lines(bars, lines, crosswalks, paint)
    free = [n for n in numbers if strokes[n].polygon not in yellow]
    white = shapely.STRtree([polygon for n, polygon in enumerate(polygons) if n not in yellow])
    worn = worn_stop_lines([line.chain for line in stops], crosswalks, strokes, free, white)
    fitted = [line for line in (_fitted_bar(chain, paint) for chain in worn) if line is not None]
    stops += fitted
    sure += [STOPS.one_evidence * line.chain.painted / line.chain.length for line in fitted]
    of_stops = {n for line in stops for n in line.chain.strokes}
    lines = [line for line in lines if not of_stops.issuperset(line.chain.strokes)]
    lines += _short_lines(chains, lines, of_stops, paint, settings)
    common = with_common_patterns([line.sections for line in lines])
    lines = [replace(line, sections=sections) for line, sections in zip(lines, common)]
    pieces = _sections_of(lines, strokes, colours, settings)
    pieces += [replace(_whole(line, strokes, colours, settings, len(lines) + k), confidence=sure[k])
               for k, line in enumerate(stops)]
    pieces = _with_widths(_with_partners(pieces), drives)
    left = [n for n in _left_over(polygons, strokes, in_rows, [*lines, *stops]) if n not in of_symbols]
    areas = [RoadArea(row.area, "crosswalk", row.direction, row.fill, "white") for row in crosswalks]
    areas += [RoadArea(symbol.area, symbol.kind, symbol.heading, symbol.score, colours[symbol.polygons[0]])
              for symbol in symbols]
    areas += [RoadArea(polygons[n], "unknown", np.full(2, np.nan), np.nan, colours[n]) for n in left]
    progress.step(1.0)
    return LineWork(tuple(pieces), tuple(areas), len(polygons))


def with_ground_heights(work: LineWork, heights_at) -> LineWork:
    """The line work with the heights that `heights_at(x, y)` gives (NaN where it has none)."""
    lines = []
    for line in work.lines:
        points = np.column_stack([line.points[:, :2], heights_at(line.points[:, 0], line.points[:, 1])])
        lines.append(replace(line, points=points))
    areas = []
    for area in work.areas:
        flat = shapely.force_2d(area.polygon)
        areas.append(replace(area, polygon=shapely.transform(
            shapely.force_3d(flat), lambda xyz: np.column_stack([xyz[:, :2], heights_at(xyz[:, 0], xyz[:, 1])]),
            include_z=True)))
    return replace(work, lines=tuple(lines), areas=tuple(areas))


def _in_crosswalks(strokes: Sequence[Stroke], crosswalks: Sequence[Crosswalk]) -> set[int]:
    """Numbers of the strokes that belong to crosswalks or lie in them."""
    used = {n for row in crosswalks for n in row.strokes}
    if not crosswalks:
        return used
    middles = shapely.points([stroke.axis[[0, -1]].mean(axis=0) for stroke in strokes])
    _, inside = shapely.STRtree(middles).query([row.area.buffer(0.3) for row in crosswalks], predicate="intersects")
    return used | {int(n) for n in inside if strokes[n].length < 6.0}


def _is_line(chain: StrokeChain, strokes: Sequence[Stroke], settings: LineSettings) -> bool:
    """Whether a chain has the length and the paint of a line, and is no row of flakes."""
    if chain.length < settings.min_length or chain.painted < settings.min_painted:
        return False
    pieces = [strokes[n].length for n in chain.strokes]
    if chain.painted < 0.6 * chain.length and sum(length >= 1.0 for length in pieces) < 3:
        return False  # two arrows' shafts in a row are no line
    return chain.painted >= 0.25 * chain.length or max(pieces) >= 2.5


def _fitted(chain: StrokeChain, paint: shapely.STRtree) -> _Line | None:
    fit = fit_centre_line(chain.axis, chain.width, paint)
    if fit is None:
        return None
    sections = line_sections(fit.covered, STATION)
    return _Line(chain, fit, sections) if sections else None


def _stop_lines(bars: Sequence[StrokeChain], lines: Sequence[_Line], crosswalks: Sequence[Crosswalk],
                paint: shapely.STRtree) -> tuple[list[_Line], list[float]]:
    """Stop lines among the bars, and how sure they are."""
    known = [(line.chain, line.fit) for line in lines]
    stops, sure = [], []
    for chain in bars:
        confidence = stop_line_confidence(chain, known, crosswalks)
        line = _fitted_bar(chain, paint) if confidence > 0.0 else None
        if line is not None:
            stops.append(line)
            sure.append(confidence)
    return stops, sure


def _fitted_bar(chain: StrokeChain, paint: shapely.STRtree) -> _Line | None:
    fit = fit_centre_line(chain.axis, chain.width, paint)
    return None if fit is None else _Line(chain, fit, [_bar(fit)])


def _short_lines(chains: Sequence[StrokeChain], lines: Sequence[_Line], of_stops: set[int], paint: shapely.STRtree,
                 settings: LineSettings) -> list[_Line]:
    """Lines too short by themselves where the sure ones (`lines`) show them to be some."""
    used = of_stops | {n for line in lines for n in line.chain.strokes}
    free = [chain for chain in chains if chain.width < settings.stop_width and used.isdisjoint(chain.strokes)]
    found = supported_chains(free, [line.fit.axis for line in lines], [line.fit.width for line in lines])
    return [line for line in (_fitted(chain, paint) for chain in found) if line is not None]


def _sections_of(lines: Sequence[_Line], strokes, colours, settings: LineSettings) -> list[RoadLine]:
    """The lines cut into sections of one kind; a section of dashes reaches to the solid ones beside it."""
    pieces = []
    told = [_colour(line.chain, strokes, colours) for line in lines]
    wide = [colour == "yellow" and line.fit.width >= settings.guide_width for line, colour in zip(lines, told)]
    road = shapely.MultiLineString([line.fit.axis for line, strip in zip(lines, wide) if not strip])
    for number, (line, colour) in enumerate(zip(lines, told)):
        # The blur of an image makes a centre line as wide as a strip: that one runs beside a road, not in it.
        guiding = wide[number] and not _within_road(line.fit.axis, road)
        sections = line.sections
        for k, section in enumerate(sections):
            start = sections[k - 1].end if k and section.kind == "dashed" else section.start
            end = sections[k + 1].start if k + 1 < len(sections) and section.kind == "dashed" else section.end
            if k and section.kind == sections[k - 1].kind:
                start = sections[k - 1].end
            pieces.append(_piece(line, section, start, end, "guiding strip" if guiding else section.kind, colour,
                                 number, settings))
    return [line for line in pieces if line is not None]


def _within_road(axis: np.ndarray, road: shapely.MultiLineString) -> bool:
    """Whether most of a line (n, 2) has others of the road to both sides of it, m."""
    plan = shapely.LineString(axis)
    at = np.linspace(0.05, 0.95, PLACES)
    ends = [shapely.get_coordinates(shapely.line_interpolate_point(plan, at + step, normalized=True))
            for step in (-0.05, 0.0, 0.05)]
    side = (ends[2] - ends[0])[:, ::-1] * [-1.0, 1.0]
    side *= ROAD_HALF / np.maximum(np.linalg.norm(side, axis=1, keepdims=True), LEAST_DIVISOR)
    both = np.ones(len(at), bool)
    for way in (side, -side):
        both &= shapely.intersects(shapely.linestrings(np.stack([ends[1], ends[1] + way], axis=1)), road)
    return bool(both.mean() > 0.5)


def _whole(line: _Line, strokes, colours, settings: LineSettings, number: int) -> RoadLine:
    """A stop line."""
    (section,) = line.sections
    colour = _colour(line.chain, strokes, colours)
    return _piece(line, section, section.start, section.end, "stop line", colour, number, settings)


def _bar(fit: FittedLine) -> Section:
    """The one section of a stop line."""
    runs = painted_intervals(fit.covered, STATION)
    return Section(runs[0, 0], runs[-1, 1], "solid", runs, np.nan, np.nan, np.nan)


def _piece(line: _Line, section: Section, start: float, end: float, kind: str, colour: str, number: int,
           settings: LineSettings) -> RoadLine | None:
    """A stretch of a fitted line between two chainages."""
    axis, at = line.fit.axis, np.arange(len(line.fit.axis)) * STATION
    start, end = max(start, 0.0), min(end, at[-1])
    if end - start < 0.5:
        return None
    inner = (at > start) & (at < end)
    ends = [np.array([np.interp(edge, at, axis[:, k]) for k in (0, 1)]) for edge in (start, end)]
    course = np.vstack([ends[0], axis[inner], ends[1]])
    plan = polyline(course)
    # The fit shortens a ragged chain: what was counted by stations is told in metres along the line.
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(course, axis=0), axis=1))])
    along *= shapely.LineString(plan).length / max(along[-1], LEAST_DIVISOR)
    within = np.interp(np.clip(section.dashes, start, end), np.concatenate([[start], at[inner], [end]]), along)
    painted = float((within[:, 1] - within[:, 0]).sum())
    missing, placed = along[-1] - painted, ()
    if section.kind == "dashed":
        whole = round((along[-1] + section.period - section.dash) / section.period)  # it begins and ends with a dash
        missing = max(0.0, whole * section.dash - painted)
        within, worn = with_worn_ends(within, section.period, section.dash)
        within = np.clip(within, 0.0, along[-1])
        placed = tuple(within[worn].tolist())
    sigma = float(np.hypot(line.fit.sigma[inner].mean() if inner.any() else line.fit.residual, settings.source_sigma))
    points = np.column_stack([plan, np.full(len(plan), np.nan)])
    nearest = cKDTree(course).query(plan)[1]
    by_station = np.interp(np.concatenate([[start], at[inner], [end]]), at, line.fit.sigma)
    return RoadLine(points, kind, line.fit.width, colour, sigma, within, section.period, section.dash, missing, number,
                    confidence=painted / max(painted + missing, LEAST_DIVISOR), placed=placed,
                    sigmas=tuple(np.hypot(by_station[nearest], settings.source_sigma).tolist()),
                    width_sigma=line.fit.ragged)


def _colour(chain: StrokeChain, strokes: Sequence[Stroke], colours: Sequence[str]) -> str:
    """The colour of most of a chain's length."""
    length: dict[str, float] = {}
    for n in chain.strokes:
        name = colours[strokes[n].polygon]
        length[name] = length.get(name, 0.0) + strokes[n].length
    return max(length, key=length.get)


def _with_partners(lines: Sequence[RoadLine]) -> list[RoadLine]:
    """The lines, those that run beside another one in the distance of a double line marked with it."""
    plans = [line.plan for line in lines]
    tree = shapely.STRtree(plans)
    paired = []
    for k, line in enumerate(lines):
        partner = -1
        places = shapely.line_interpolate_point(plans[k], np.linspace(0.1, 0.9, 9), normalized=True)
        for other in tree.query(plans[k], predicate="dwithin", distance=DOUBLE[1]):
            if lines[other].chain == line.chain or "stop line" in (line.kind, lines[other].kind):
                continue
            distance = shapely.distance(places, plans[other])
            if ((distance >= DOUBLE[0]) & (distance <= DOUBLE[1])).mean() >= 0.6:
                partner = lines[other].chain
        paired.append(replace(line, partner=partner))
    return paired


def _with_widths(lines: Sequence[RoadLine], drives: Sequence[np.ndarray]) -> list[RoadLine]:
    """The lines with the width of their paint in place of that of its outlines, where it can be told."""
    widths = line_widths([line.points[:, :2] for line in lines], np.array([line.width for line in lines]),
                         np.array([line.width_sigma for line in lines]), drives)
    return [replace(line, width=width, width_sigma=sigma) for line, (width, sigma) in zip(lines, widths.tolist())]


def _left_over(polygons: Sequence[shapely.Polygon], strokes: Sequence[Stroke], in_rows: set[int],
               lines: Sequence[_Line]) -> list[int]:
    """Polygons of which neither a line nor a crosswalk has taken at least half."""
    taken = np.zeros(len(polygons))
    total = np.zeros(len(polygons))
    used = in_rows | {n for line in lines for n in line.chain.strokes}
    for n, stroke in enumerate(strokes):
        total[stroke.polygon] += stroke.length
        taken[stroke.polygon] += stroke.length if n in used else 0.0
    beside = shapely.union_all([shapely.LineString(line.fit.axis).buffer(0.25) for line in lines])
    shapely.prepare(beside)
    covered = shapely.covers(beside, np.asarray(polygons, object)) if lines else np.zeros(len(polygons), bool)
    return [n for n in range(len(polygons)) if taken[n] < 0.5 * total[n] + (total[n] == 0) and not covered[n]]
