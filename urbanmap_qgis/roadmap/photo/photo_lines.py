"""Lines of a lane map completed by an orthophoto: edges of roads, worn lines, and none where no road is (J 6.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.ndimage import uniform_filter1d

from ...progress import SILENT, Progress
from ...settings.roadmap import MapSettings
from ...wording import say
from ..given_bounds import rejoined
from ..lanes.lane_strips import lane_strips
from ..lanes.road_sections import BoundTrack, RoadSection
from ..lanes.section_preparation import prepared_sections
from ..map_records import Finding, MapArea, MapLine
from .photo_edges import REACH, PhotoEdge, photo_edges
from .photo_edges import SIGMA as EDGE_SIGMA
from .road_surface import road_likeness, surface_features, surface_model
from .straight_photo import ColourImage, StraightPhoto, straight_photo, straight_places
from .worn_lines import SIGMA as WORN_SIGMA
from .worn_lines import worn_lines

ALONG = 0.25  # Steps of the image along and across the road, m.
ACROSS = 0.1
LONGEST = 400.0  # Longer sections are looked at in such stretches, m.
LEAST = 15.0  # Sections and lines in them are so long, m.
BESIDE = 1.2  # Ground so near to the outermost lines is the road's, m.
MAIN = 0.5  # Lines seen over such a share of the longest one lie on the road.
BOUND = 0.3  # Lines seen over such a share of the section are bounds that lanes are reckoned from.
SAME = 0.5  # Lines so near to each other are one, m.
AROUND = 1.2  # Ground so wide across a line tells whether it lies on road, m.
OFF_ROAD = 0.6  # A line is left out where such a share of it lies beyond an edge.
USUAL = 2.6, 4.0  # Lanes of such widths tell how wide one is, m.
STANDARD = 3.25  # Width of a lane where none does, m.
SYMBOLS = 0.3  # Paint of symbols reaches so far beyond their outlines, m.
AT_EDGE = 0.3  # Lines so far beyond an edge still lie within it, m.
SIMPLIFIED = 0.03  # Points of lines that lie nearer to the others' course are left out, m.


@dataclass
class _Looked:
    """A section, the image along it, its lines that are seen longest and the offsets (2, n) of the outermost ones."""

    section: RoadSection
    photo: StraightPhoto
    main: list[BoundTrack]
    outermost: np.ndarray

    @property
    def inside(self) -> np.ndarray:
        low, high = self.outermost[:, :, None]
        return (self.photo.offset > low - BESIDE) & (self.photo.offset < high + BESIDE)


def lines_with_photo(lines: Sequence[MapLine], areas: Sequence[MapArea], image: ColourImage, settings: MapSettings,
                     progress: Progress = SILENT) -> tuple[list[MapLine], list[Finding]]:
    """Lines with those that an orthophoto adds, without those that it shows to lie off the road, and findings on both.

    Edges are "road border" lines where the surface between the lines ends; worn lines have as confidence the share of
    their length that shows paint.
    """
    sections = prepared_sections(rejoined(lines), areas, settings)
    looked = [one for section, _ in sections for one in _looked_at(section, image)]
    if not looked:
        return list(lines), []
    model = surface_model([surface_features(one.photo.colours)[one.inside] for one in looked])
    symbols = shapely.union_all([area.polygon for area in areas if area.kind != "unknown"]).buffer(SYMBOLS)
    shapely.prepare(symbols)
    usual = _usual_width(sections, settings)
    added, left_out, findings = [], [], []
    for number, one in enumerate(looked):
        like, lit = road_likeness(one.photo, one.inside, model)
        edges = photo_edges(one.photo, like, lit, _on_road(one, like))
        left_out += _off_road(one, like, edges)
        found = [_line(one, edge.offset, (edge.first, edge.last), "road border", EDGE_SIGMA, edge.shown)
                 for edge in edges]
        last = len(one.photo.chainage) - 1
        found += [_line(one, np.full(last + 1, worn.offset), (0, last), worn.kind, WORN_SIGMA, worn.painted)
                  for worn in worn_lines(image, one.photo, like, _bounds(one, edges), usual, symbols)]
        for line in found:
            if not _is_there(line, [*lines, *added]):
                added.append(line)
                findings.append(_finding(line))
        progress.step((number + 1) / len(looked))
    return _without(lines, left_out) + added, findings


def _looked_at(section: RoadSection, image: ColourImage) -> list[_Looked]:
    """The image along a section, in stretches where it is long; none along short ones or where the image shows none."""
    low, high = min(track.start for track in section.tracks), max(track.end for track in section.tracks)
    longest = max(track.seen for track in section.tracks)
    if longest < LEAST:
        return []
    found = []
    for part in np.array_split(np.arange(low, high, ALONG), int((high - low) / LONGEST) + 1):
        main = [track for track in section.tracks if track.seen >= MAIN * longest]
        outer = _outermost(main, part)
        if outer is None:
            continue
        across = np.arange(outer[0].min() - REACH, outer[1].max() + REACH, ACROSS)
        photo = straight_photo(image, section.axis, part, across)
        one = _Looked(section, photo, main, outer)
        if np.isfinite(photo.colours[one.inside]).any():
            found.append(one)
    return found


def _outermost(tracks: Sequence[BoundTrack], chainage: np.ndarray) -> np.ndarray | None:
    """Offsets (2, n) of the tracks that are outermost on the right and on the left; None where they cover little."""
    offsets = np.array([track.interpolate(chainage) for track in tracks]).reshape(len(tracks), -1)
    known = np.isfinite(offsets).any(axis=0)
    if known.sum() * ALONG < LEAST:
        return None
    ends = [end(offsets[:, known], axis=0) for end in (np.nanmin, np.nanmax)]
    return np.array([np.interp(chainage, chainage[known], end) for end in ends])


def _around(one: _Looked, track: BoundTrack, like: np.ndarray) -> np.ndarray:
    """Mean likeness to road across a track, (n,), NaN where it is not."""
    near = uniform_filter1d(like, int(AROUND / ACROSS) | 1, axis=1)
    place = track.interpolate(one.photo.chainage)
    columns = one.photo.column(np.where(np.isfinite(place), place, 0.0))
    return np.where(np.isfinite(place), near[np.arange(len(place)), columns], np.nan)


def _on_road(one: _Looked, like: np.ndarray) -> np.ndarray:
    """Offsets (2, n) of the outermost lines that lie on road: rows of paving beside it are lines too."""
    tracks = [track for track in one.main if np.nanmean(_around(one, track, like)) > 0]
    within = _outermost(tracks, one.photo.chainage) if tracks else None
    return one.outermost if within is None else within


def _usual_width(sections: Sequence[tuple[RoadSection, list[np.ndarray]]], settings: MapSettings) -> float:
    """Median width of the lanes that lines show, m."""
    widths = [strip.width for section, stops in sections for strip in lane_strips(section, stops, settings)]
    fitting = [width for width in widths if USUAL[0] < width < USUAL[1]]
    return float(np.median(fitting)) if fitting else STANDARD


def _bounds(one: _Looked, edges: Sequence[PhotoEdge]) -> list[float]:
    """Offsets of the edges of a section and of the lines between them that are seen well."""
    chainage = one.photo.chainage
    length = chainage[-1] - chainage[0]
    found = [float(np.median(track.offset)) for track in one.section.tracks if track.seen > BOUND * length]
    for edge in edges:
        found = [offset for offset in found if edge.side * (offset - edge.usual) < AT_EDGE]
    return [*found, *(edge.usual for edge in edges)]


def _line(one: _Looked, offset: np.ndarray, rows: tuple[int, int], kind: str, sigma: float, share: float) -> MapLine:
    """A line at offsets (n,) of the photo's rows, at the heights of the section's longest line."""
    part = slice(rows[0], rows[1] + 1)
    chainage = one.photo.chainage[part]
    plan = straight_places(one.section.axis, chainage, offset[part][:, None])[:, 0]
    plan = shapely.get_coordinates(shapely.LineString(plan).simplify(SIMPLIFIED))
    longest = max(one.section.tracks, key=lambda track: track.seen)
    height = np.interp(one.section.axis.chainage(plan), longest.chainage, longest.points[:, 2])
    return MapLine(np.column_stack([plan, height]), kind, "" if kind == "road border" else "white", np.nan, sigma,
                   confidence=share)


def _is_there(line: MapLine, others: Sequence[MapLine]) -> bool:
    """Whether others run beside a line, as near as if they were it, over half of its length."""
    plan = shapely.LineString(line.points[:, :2])
    near = [shapely.LineString(one.points[:, :2]).buffer(SAME) for one in others if one.kind != "stop line"]
    beside = [zone for zone in near if zone.intersects(plan)]
    return plan.intersection(shapely.union_all(beside)).length > 0.5 * plan.length


def _finding(line: MapLine) -> Finding:
    """What a line of the image is, in its middle."""
    middle = shapely.LineString(line.points[:, :2]).interpolate(0.5, normalized=True)
    if line.kind == "road border":
        return Finding("edge from the image", say(
            "The edge of the road is the border of its surface in the orthophoto, not a kerb that was measured (sigma "
            "{sigma:.2f} m).", sigma=line.sigma), middle.x, middle.y)
    return Finding("faint line", say("A line nearly worn away, taken from faint paint where the width of the lanes "
                                     "asks for one: look at it."), middle.x, middle.y)


def _off_road(one: _Looked, like: np.ndarray, edges: Sequence[PhotoEdge]) -> list[MapLine]:
    """Lines of a section that lie beyond one of its edges, on what does not look like road: paving, tree pits."""
    chainage = one.photo.chainage
    found = []
    for track in one.section.tracks:
        place = track.interpolate(chainage)
        for edge in edges:
            rows = np.flatnonzero(np.isfinite(place[edge.first:edge.last + 1])) + edge.first
            if len(rows) * ALONG < OFF_ROAD * (track.end - track.start):
                continue
            beyond = edge.side * (place[rows] - edge.offset[rows]) > SAME
            if beyond.mean() > OFF_ROAD and np.mean(_around(one, track, like)[rows]) < 0:
                # What is a bound of an earlier map was looked at before, and by the user.
                found += [line for *_, line in track.pieces if line is not None and line.identifier < 0]
    return found


def _without(lines: Sequence[MapLine], left_out: Sequence[MapLine]) -> list[MapLine]:
    """Lines without those of which more than half is among others, which may be parts of them."""
    gone = shapely.union_all([shapely.LineString(line.points[:, :2]).buffer(0.01) for line in left_out])
    plans = [shapely.LineString(line.points[:, :2]) for line in lines]
    return [line for line, plan in zip(lines, plans)
            if gone.is_empty or plan.intersection(gone).length <= OFF_ROAD * plan.length]
